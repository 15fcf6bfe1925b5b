//! How much of a step to take along a convex function, from its slope alone.

/// The slope may fall to this share of the first slope before a step is short enough.
const FLAT: f64 = 0.1;
/// Halvings of the bracket.
const MOST_CUTS: usize = 60;

/// The share of a step after which a convex function is lower. The whole step is taken unless it passes the minimum;
/// then a place before the minimum, where the slope has risen to a tenth of the first one.
pub(super) fn share_of_step(slope: impl Fn(f64) -> f64) -> f64 {
    let first = slope(0.0);
    let last = slope(1.0);
    if first >= 0.0 || last <= FLAT * first.abs() {
        return 1.0;
    }
    let (mut low, mut high) = ([0.0, first], [1.0, last]);
    for cut in 0..MOST_CUTS {
        if low[1] >= FLAT * first && low[0] > 0.0 {
            break;
        }
        // The chord's root, and the middle where that makes slow progress.
        let chord = low[0] + (high[0] - low[0]) * low[1] / (low[1] - high[1]);
        let share = if cut % 3 == 2 { 0.5 * (low[0] + high[0]) } else { chord };
        let found = [share, slope(share)];
        if found[1] <= 0.0 {
            low = found;
        } else {
            high = found;
        }
    }
    if low[0] > 0.0 { low[0] } else { high[0] }
}
