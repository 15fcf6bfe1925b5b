//! Prints the outcome of `calibrate`.

use super::{print_json, print_line, quoted};
use crate::args::PrintArgs;
use ambulo::ground::predict::{KNOTS, PersonalErrors, StanceCurve};
use anyhow::Result;
use serde_json::json;
use std::path::Path;

/// Prints the size of the errors that repeat.
pub(crate) fn calibrate(person: &PersonalErrors, trials: usize, output: &Path, print: PrintArgs) -> Result<()> {
    if print.quiet {
        return Ok(());
    }
    let feet = person.errors.iter().map(|(side, errors)| {
        let [forward, up, outwards] = errors.force.map(|curve| 100.0 * largest(&curve));
        let along_mm = 1e3 * person.stature_m * largest(&errors.center[0]);
        (side, person.stances[side], [up, forward, outwards], along_mm)
    });
    if print.json {
        let feet: serde_json::Map<String, serde_json::Value> = feet
            .map(|(side, stances, [up, forward, outwards], along_mm)| {
                let foot = json!({
                    "stances": stances,
                    "largest_mean_error_percent_bw": { "vertical": up, "fore_aft": forward, "outwards": outwards },
                    "largest_mean_error_center_along_mm": along_mm,
                });
                (side.to_string(), foot)
            })
            .collect();
        let all = json!({
            "trials": trials,
            "mass_kg": person.mass_kg,
            "stature_m": person.stature_m,
            "feet": feet,
            "written": output.display().to_string(),
        });
        return print_json(&all);
    }
    print_line(&format!("  person    {:.1} kg, {:.3} m; trials {trials}", person.mass_kg, person.stature_m))?;
    for (side, stances, [up, forward, outwards], along_mm) in feet {
        let word = format!("{side} foot");
        if stances == 0 {
            print_line(&format!(
                "  {word:<11}no stance on a separate plate: the mirror image of the other foot is used"
            ))?;
            continue;
        }
        print_line(&format!(
            "  {word:<11}stances {stances}; mean error at most: vertical {up:.1}, fore-aft {forward:.1}, sideways \
             {outwards:.1} % of body weight; centre of pressure along {along_mm:.0} mm"
        ))?;
    }
    print_line(&format!("  written   {}", quoted(output)))?;
    print_line(&format!("  next      ambulo forces OTHER_TRIAL --person {} ...", quoted(output)))
}

/// Largest size of a curve.
fn largest(curve: &StanceCurve) -> f64 {
    KNOTS.iter().map(|knot| curve.at(*knot).abs()).fold(0.0, f64::max)
}
