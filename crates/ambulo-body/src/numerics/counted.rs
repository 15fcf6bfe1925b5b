//! Counts and angles in messages, with their noun in the singular or plural.

/// A count with its noun: `1 frame`, `3 frames`.
#[must_use]
pub fn counted(count: usize, noun: &str) -> String {
    if count == 1 { format!("1 {noun}") } else { format!("{count} {noun}s") }
}

/// An angle [deg] without decimals: `1 degree`, `20 degrees`.
#[must_use]
pub fn degrees(angle_deg: f64) -> String {
    match format!("{angle_deg:.0}").as_str() {
        "-0" => "0 degrees".to_owned(),
        one @ ("1" | "-1") => format!("{one} degree"),
        shown => format!("{shown} degrees"),
    }
}
