//! Laws as the TOML files that the library reads (docs/GAITS.md).

use super::knots::KnotLaws;
use std::fmt::Write;

/// Height share of a bound of the paper's style that does not clear the ground: all local states change with step
/// height.
const LEAST_SHARE: f64 = 0.2;

/// `[[joint.knot]]` tables.
pub(crate) fn knots(text: &mut String, joint: &str, knots: &[KnotLaws]) {
    for knot in knots {
        let _ = write!(text, "\n[[{joint}.knot]]\nname = \"{}\"\n", knot.name);
        if !knot.begins.is_empty() {
            let _ = writeln!(text, "begins = \"{}\"", knot.begins);
        }
        let _ = writeln!(text, "at_percent = {}", law(&knot.at, 3));
        for (key, law_of, digits) in
            [("angle_deg", &knot.ends[0], 3), ("slope_deg", &knot.ends[1], 1), ("curvature_deg", &knot.ends[2], 0)]
        {
            let _ = writeln!(text, "{key} = {}", law(law_of, digits));
        }
        if knot.height_share > 0.0 {
            let _ = writeln!(text, "height_share = {}", knot.height_share);
        }
    }
}

/// `[[joint.sub_cycle]]` tables between the knots that begin one.
pub(crate) fn sub_cycles(text: &mut String, joint: &str, knots: &[KnotLaws]) {
    for (k, from) in knots.iter().enumerate() {
        let to = &knots[(k + 1) % knots.len()];
        let _ = write!(text, "\n[[{joint}.sub_cycle]]\nname = \"{}\"\nend = \"{}\"\n", from.begins, to.name);
        let percents = [("from_percent", &from.at), ("to_percent", &to.at)];
        let angles = [("from_deg", &from.ends[0]), ("to_deg", &to.ends[0])];
        for (key, numbers) in percents.into_iter().chain(angles) {
            let _ = writeln!(text, "{key} = {}", law(numbers, 3));
        }
        let share = if to.height_share > 0.0 { to.height_share } else { LEAST_SHARE };
        let _ = writeln!(text, "height_share = {share}");
    }
}

/// `[c0, c1, ..]`.
pub(crate) fn law(coefficients: &[f64], digits: usize) -> String {
    let numbers: Vec<String> = coefficients.iter().map(|c| number(*c, digits)).collect();
    format!("[{}]", numbers.join(", "))
}

/// A number without a minus before zero, and with a point.
fn number(value: f64, digits: usize) -> String {
    let text = format!("{value:.*}", digits.max(1));
    if text.trim_start_matches('-').parse() == Ok(0.0) { "0.0".into() } else { text }
}
