//! Prints muscle forces.

use super::print_line;
use ambulo::numerics::{Order, counted, mean};
use ambulo_results::{EmgSummary, MuscleOrigin, MuscleSummary, QuantitySummary, SpreadSummary};
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
    print_emg(&found.emg)
}

/// The mean agreement of EMG with activations, and the muscles in which it is least and greatest.
fn print_emg(channels: &[EmgSummary]) -> Result<()> {
    let mut known: Vec<(f64, &EmgSummary)> = channels.iter().filter_map(|emg| Some((emg.r?, emg))).collect();
    known.sort_by_number(|(r, _)| *r);
    let (Some((low, least)), Some((high, most))) = (known.first(), known.last()) else { return Ok(()) };
    let mean = mean(&known.iter().map(|(r, _)| *r).collect::<Vec<_>>());
    print_line(&format!(
        "  EMG       r with activations {mean:.2} in the mean of {}, from {low:.2} ({} {}) to {high:.2} ({} {})",
        counted(known.len(), "channel"),
        least.muscle,
        least.side,
        most.muscle,
        most.side
    ))
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
