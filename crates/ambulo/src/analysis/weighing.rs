//! Body mass from the mean vertical force over a gait cycle or in a standing trial.

use super::events::{Event, EventKind};
use super::predicted::PredictedAnalysis;
use super::recording::{Analysis, Mass, MassSource, WHOLE_BODY_SHARE};
use crate::model::{Model, Side};
use crate::motion::Window;

/// Sets the body mass from one gait cycle anywhere inside the `instrumented` window, if no cycle from strike to strike
/// gave it: walking is periodic, so the mean vertical force over a cycle is m g from any instant on.
pub(crate) fn weighed_within(analysis: Analysis, model: &Model, instrumented: Window) -> Analysis {
    let mass = cycle_mass_kg(&analysis, model, instrumented).map(|kg| Mass { kg, source: MassSource::Plates });
    with_mass(analysis, mass)
}

/// Sets the body mass of the standing trial [kg], if no whole gait cycle gave it.
pub(crate) fn weighed_standing(analysis: Analysis, standing_kg: Option<f64>) -> Analysis {
    with_mass(analysis, standing_kg.map(|kg| Mass { kg, source: MassSource::Standing }))
}

impl PredictedAnalysis {
    /// Sets the body mass from the force plates: over a whole gait cycle inside the instrumented window [s], otherwise
    /// in a standing trial [kg]. Without either, the mass of the model remains.
    #[must_use]
    pub fn weighed(self, model: &Model, window_s: Option<[f64; 2]>, standing_kg: Option<f64>) -> PredictedAnalysis {
        let PredictedAnalysis { mut analysis, prediction, measured } = self;
        let measured = measured.map(|measured| {
            let measured = match window_s {
                Some([from, to]) => weighed_within(measured, model, Window { from_s: Some(from), to_s: Some(to) }),
                None => measured,
            };
            weighed_standing(measured, standing_kg)
        });
        let by_plates = measured.as_ref().map(|measured| measured.mass);
        if let Some(mass) = by_plates.filter(|mass| mass.source != MassSource::Model) {
            analysis.mass = mass;
        }
        PredictedAnalysis { analysis: weighed_standing(analysis, standing_kg), prediction, measured }
    }
}

/// Mean vertical force over g, over one mean gait cycle from the beginning of a window [kg]; `None` if the window is
/// shorter.
fn cycle_mass_kg(analysis: &Analysis, model: &Model, window: Window) -> Option<f64> {
    let (from, to) = (window.from_s?, window.to_s?);
    let strikes = |side: Side| {
        let of_side = move |e: &&Event| e.side == side && e.kind == EventKind::Strike;
        analysis.events.iter().filter(of_side).map(|e| e.time_s).collect::<Vec<f64>>()
    };
    let overlapping = |pair: &[f64]| (pair[0] < to && pair[1] > from).then_some(pair[1] - pair[0]);
    let periods: Vec<f64> = Side::BOTH
        .into_iter()
        .flat_map(|side| strikes(side).windows(2).filter_map(overlapping).collect::<Vec<_>>())
        .collect();
    let period = periods.iter().sum::<f64>() / periods.len() as f64;
    let grid = analysis.trajectory.grid();
    let (first, frames) = grid.inside(Window { from_s: Some(from), to_s: Some(from + period) });
    let has_a_cycle = period <= to - from;
    if !has_a_cycle || frames == 0 {
        return None;
    }
    let up = model.up();
    let vertical = |i: usize| analysis.ground.bodies.iter().map(|b| b.force[i].dot(&up)).sum::<f64>();
    let mean = (first..first + frames).map(vertical).sum::<f64>() / frames as f64;
    Some(mean / model.gravity().norm())
}

/// Replaces the model's mass. A mass that differs by more than 5 % is rejected: part of the weight was not on the
/// plates, or the model is of another person.
fn with_mass(analysis: Analysis, mass: Option<Mass>) -> Analysis {
    let accepted = mass.filter(|mass| {
        analysis.mass.source == MassSource::Model && (mass.kg / analysis.mass.kg - 1.0).abs() <= WHOLE_BODY_SHARE
    });
    Analysis { mass: accepted.unwrap_or(analysis.mass), ..analysis }
}
