//! Mean curves of Schwartz, Rozumalski, Trost 2008, as the tables beside the workspace have them.

use crate::workspace;
use std::fs;

/// Names of the speeds in the tables, slowest first.
const NAMES: [&str; 5] = ["VerySlow", "Slow", "Free", "Fast", "VeryFast"];
/// Dimensionless speeds V/√(gL) (data README, from the workbook).
pub(crate) const SPEEDS: [f64; 5] = [0.172, 0.290, 0.429, 0.560, 0.694];
/// Dimensionless step frequencies f √(L/g) at these speeds (literature.md 1.5, from the same workbook).
pub(crate) const CADENCES: [f64; 5] = [0.337, 0.455, 0.565, 0.662, 0.758];
/// Samples in a column: 0 % to 100 %, every 2 %.
pub(crate) const SAMPLES: usize = 51;

/// One quantity at five speeds [deg], 51 samples each.
pub(crate) type Curves = [Vec<f64>; 5];

/// The mean curves of a quantity of `schwartz2008_angles.csv`.
pub(crate) fn curves(quantity: &str) -> Result<Curves, String> {
    let text = read("schwartz2008_angles.csv")?;
    let mut curves: Curves = Default::default();
    for line in text.lines().skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        let [name, speed, _, mean, _] = cells[..] else {
            return Err(format!("found the line `{line}`; expected 5 cells"));
        };
        if name == quantity
            && let Some(i) = NAMES.iter().position(|known| *known == speed)
        {
            curves[i].push(mean.parse().map_err(|e| format!("found `{mean}`: {e}"))?);
        }
    }
    match curves.iter().find(|curve| curve.len() != SAMPLES) {
        Some(curve) => Err(format!("{quantity}: found {} samples; expected {SAMPLES}", curve.len())),
        None => Ok(curves),
    }
}

/// Foot off of the curve's own foot [share of the cycle] at five speeds.
pub(crate) fn foot_off() -> Result<[f64; 5], String> {
    let text = read("schwartz2008_cycle_events.csv")?;
    let line = text.lines().find(|line| line.starts_with("Ipsilateral Foot Off"));
    let line = line.ok_or("schwartz2008_cycle_events.csv: found no row `Ipsilateral Foot Off`")?;
    let cells: Vec<f64> = line.split(',').skip(1).step_by(2).filter_map(|cell| cell.parse().ok()).collect();
    cells.try_into().map_err(|cells: Vec<f64>| format!("found {} foot offs; expected 5", cells.len()))
}

fn read(name: &str) -> Result<String, String> {
    let path = workspace::data().join("data/normative").join(name);
    fs::read_to_string(&path).map_err(|e| format!("{}: {e}; see CONTRIBUTING.md on recordings", path.display()))
}
