//! Names in messages: lists of known names, and the name that was probably meant.

/// At most this many names are listed in a message; the longest table of keys has 17.
const LISTED: usize = 20;

/// Names in back quotes, the first few.
pub fn listed<'n>(names: impl Iterator<Item = &'n str>) -> String {
    let mut quoted: Vec<String> = names.take(LISTED + 1).map(|name| format!("`{name}`")).collect();
    if quoted.len() > LISTED {
        quoted[LISTED] = "…".into();
    }
    quoted.join(", ")
}

/// The most similar name, if at most a third of its letters differ.
pub fn nearest<'n>(name: &str, names: impl Iterator<Item = &'n str>) -> Option<&'n str> {
    const LONGEST: usize = 64;
    let near = |other: &&str| other.chars().count() <= LONGEST;
    if !near(&name) {
        return None;
    }
    let rated = names.filter(near).map(|other| (slips(name, other), other));
    rated.filter(|(slips, other)| 3 * slips <= other.chars().count().max(3)).min().map(|(_, other)| other)
}

/// Letters to insert, delete, replace or swap with their neighbour to turn one word into the other (optimal string
/// alignment).
fn slips(a: &str, b: &str) -> usize {
    let (a, b): (Vec<char>, Vec<char>) = (a.chars().collect(), b.chars().collect());
    // cost[i][j]: from the first i letters to the first j.
    let mut cost = vec![vec![0; b.len() + 1]; a.len() + 1];
    for i in 0..=a.len() {
        for j in 0..=b.len() {
            cost[i][j] = match (i, j) {
                (0, _) | (_, 0) => i + j,
                _ => {
                    let replaced = cost[i - 1][j - 1] + usize::from(a[i - 1] != b[j - 1]);
                    let swaps = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
                    let swapped = if swaps { cost[i - 2][j - 2] + 1 } else { usize::MAX };
                    replaced.min(swapped).min(cost[i - 1][j] + 1).min(cost[i][j - 1] + 1)
                }
            };
        }
    }
    cost[a.len()][b.len()]
}
