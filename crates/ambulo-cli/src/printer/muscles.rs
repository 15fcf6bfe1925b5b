//! Prints muscle forces.

use super::print_line;
use ambulo_results::{MuscleOrigin, MuscleSummary, QuantitySummary, SpreadSummary};
use anyhow::Result;

/// Prints whose muscles were used, what motors added, the peaks of the loads in stance, and how EMG agrees.
pub(super) fn print_muscles(found: &MuscleSummary) -> Result<()> {
    let origin = match found.source {
        MuscleOrigin::Model => "of the model",
        MuscleOrigin::BuiltIn => "of the built-in body",
    };
    let reserve = found.largest_reserve.as_ref().map_or_else(String::new, |reserve| {
        let share = 100.0 * reserve.share;
        format!("; motors add at most {:.1} {} ({share:.0} %) at {}", reserve.largest, reserve.unit, reserve.coordinate)
    });
    print_line(&format!("  muscles   {} {origin}{reserve}", found.muscles))?;
    for load in ["knee", "knee_medial", "hip", "ankle"] {
        if let Some(peaks) = peaks(found, load) {
            print_line(&format!("            {} {peaks}", load.replace('_', " ")))?;
        }
    }
    let compared: Vec<String> =
        found.emg.iter().filter_map(|emg| emg.r.map(|r| format!("{} {} {r:.2}", emg.muscle, emg.side))).collect();
    match compared.is_empty() {
        true => Ok(()),
        false => print_line(&format!("  EMG       r with activations: {}", compared.join(", "))),
    }
}

/// The two peaks of a load in stance: `3.1 and 4.2 BW right, 3.0 and 4.1 BW left`.
fn peaks(found: &MuscleSummary, load: &str) -> Option<String> {
    let quantity = |part: &str| found.contact_loads.iter().find(|known| known.quantity == format!("{load}_{part}"));
    let (first, second) = (quantity("first_peak")?, quantity("second_peak")?);
    let mean = |of: &Option<SpreadSummary>| of.as_ref().map(|spread| spread.mean);
    let side = |pick: fn(&QuantitySummary) -> &Option<SpreadSummary>, name: &str| {
        let (first, second) = (mean(pick(first))?, mean(pick(second))?);
        Some(format!("{first:.1} and {second:.1} BW {name}"))
    };
    let sides = [side(|known| &known.right, "right"), side(|known| &known.left, "left")];
    Some(sides.into_iter().flatten().collect::<Vec<_>>().join(", "))
}
