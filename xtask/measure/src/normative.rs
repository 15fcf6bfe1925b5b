//! Curves of Schwartz, Rozumalski, Trost 2008, read from the tables next to the workspace.

use crate::workspace;
use std::fs;

/// Names of the speeds in the tables, slowest first.
pub(crate) const NAMES: [&str; 5] = ["VerySlow", "Slow", "Free", "Fast", "VeryFast"];
/// Dimensionless speeds V/√(gL) (data README, from the workbook).
pub(crate) const SPEEDS: [f64; 5] = [0.172, 0.290, 0.429, 0.560, 0.694];
/// Dimensionless step frequencies f √(L/g) at these speeds (literature.md 1.5, from the same workbook).
pub(crate) const CADENCES: [f64; 5] = [0.337, 0.455, 0.565, 0.662, 0.758];
/// Samples in a column: 0 % to 100 %, every 2 %.
pub(crate) const SAMPLES: usize = 51;

/// One quantity at five speeds, 51 samples each, in the unit of its table.
pub(crate) type Curves = [Vec<f64>; 5];

/// A table of curves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Sheet {
    /// Joints and trunk [deg].
    Angles,
    /// Internal moments [N.m/kg].
    Moments,
    /// Powers of the joints [W/kg].
    Powers,
    /// Ground forces [body weights].
    Forces,
}

impl Sheet {
    fn file(self) -> &'static str {
        match self {
            Sheet::Angles => "schwartz2008_angles.csv",
            Sheet::Moments => "schwartz2008_moments.csv",
            Sheet::Powers => "schwartz2008_powers.csv",
            Sheet::Forces => "schwartz2008_grf.csv",
        }
    }
}

/// Mean and standard deviation of a quantity at one speed.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Band {
    pub(crate) mean: Vec<f64>,
    /// In some columns of the tables it is negative, because mean minus and mean plus deviation are exchanged.
    pub(crate) sd: Vec<f64>,
}

/// A quantity at all speeds.
pub(crate) fn bands(sheet: Sheet, quantity: &str) -> Result<[Band; 5], String> {
    let text = read(sheet.file())?;
    let mut bands: [Band; 5] = Default::default();
    for line in text.lines().skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        let [name, speed, _, mean, sd] = cells[..] else {
            return Err(format!("{}: found the line `{line}`; expected 5 cells", sheet.file()));
        };
        if name == quantity
            && let Some(i) = NAMES.iter().position(|known| *known == speed)
        {
            let number = |cell: &str| {
                cell.parse::<f64>().map_err(|e| format!("{}: found `{cell}` in `{line}`: {e}", sheet.file()))
            };
            bands[i].mean.push(number(mean)?);
            bands[i].sd.push(number(sd)?.abs());
        }
    }
    match bands.iter().find(|band| band.mean.len() != SAMPLES) {
        Some(band) => Err(format!("{quantity}: found {} samples; expected {SAMPLES}", band.mean.len())),
        None => Ok(bands),
    }
}

/// The mean curves of a quantity.
pub(crate) fn curves(sheet: Sheet, quantity: &str) -> Result<Curves, String> {
    Ok(bands(sheet, quantity)?.map(|band| band.mean))
}

/// Mean curves of a quantity in two laboratories, children at self-selected speed: Pinzone, Schwartz, Thomason,
/// Baker 2014.
pub(crate) fn two_laboratories(quantity: &str) -> Result<[Vec<f64>; 2], String> {
    const FILE: &str = "pinzone2014.csv";
    let mut means: [Vec<f64>; 2] = Default::default();
    for line in read(FILE)?.lines().skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        let [_, name, _, first, _, second, _] = cells[..] else {
            return Err(format!("{FILE}: found the line `{line}`; expected 7 cells"));
        };
        if name == quantity {
            for (mean, cell) in means.iter_mut().zip([first, second]) {
                mean.push(cell.parse().map_err(|e| format!("{FILE}: found `{cell}` in `{line}`: {e}"))?);
            }
        }
    }
    match means.iter().find(|mean| mean.len() != SAMPLES) {
        Some(mean) => Err(format!("{FILE}, {quantity}: found {} samples; expected {SAMPLES}", mean.len())),
        None => Ok(means),
    }
}

/// Foot off of the curve's own foot [share of the cycle] at five speeds.
pub(crate) fn foot_off() -> Result<[f64; 5], String> {
    event("Ipsilateral Foot Off")
}

/// Time of an event at five speeds [share of the cycle].
pub(crate) fn event(name: &str) -> Result<[f64; 5], String> {
    Ok(event_band(name)?.0)
}

/// Mean and standard deviation of an event's time at five speeds [share of the cycle]; the table has negative
/// deviations.
pub(crate) fn event_band(name: &str) -> Result<([f64; 5], [f64; 5]), String> {
    const FILE: &str = "schwartz2008_cycle_events.csv";
    let text = read(FILE)?;
    let line = text.lines().find(|line| line.starts_with(name));
    let line = line.ok_or_else(|| format!("{FILE}: found no row `{name}`"))?;
    let every_other = |first: usize| -> Result<[f64; 5], String> {
        let cells: Vec<f64> = line.split(',').skip(first).step_by(2).filter_map(|cell| cell.parse().ok()).collect();
        cells.try_into().map_err(|cells: Vec<f64>| format!("{FILE}: found {} of `{name}`; expected 5", cells.len()))
    };
    Ok((every_other(1)?, every_other(2)?.map(f64::abs)))
}

fn read(name: &str) -> Result<String, String> {
    let path = workspace::data().join("data/normative").join(name);
    fs::read_to_string(&path).map_err(|e| format!("{}: {e}; see CONTRIBUTING.md on recordings", path.display()))
}
