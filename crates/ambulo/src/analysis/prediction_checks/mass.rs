//! Compares the model's mass with the mass on the force plates; the motion alone does not determine the mass.

use super::CheckedPrediction;
use super::judgement::{Criterion, Judgement, TimedValue};
use crate::analysis::predicted::PredictedAnalysis;
use crate::model::Model;
use crate::motion::Window;

pub(super) const NAME: &str = "mass";
/// Allowed difference of the masses, as a share.
const SHARE: f64 = 0.05;
/// Shorter instrumented windows do not determine the mass [s].
const SHORTEST_S: f64 = 0.3;
/// Error of the velocity change over less than a cycle [m/s]; divided by the duration it is the error of the mean force
/// per mass. Measured: 0.36 m/s for a turning child, less than 0.1 m/s for three walkers.
const VELOCITY_ERROR_M_S: f64 = 0.4;

/// Body mass measured by force plates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlateMass {
    /// Mass [kg].
    pub kg: f64,
    /// Measurement of the mass.
    pub(crate) by: Weighing,
}

/// How force plates measured the body mass.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Weighing {
    /// During an instrumented window: the model's mass times the mean measured vertical force over the one that the
    /// motion needs.
    Walking {
        /// Duration of the window [s].
        duration_s: f64,
    },
    /// A standing trial.
    Standing,
}

impl PlateMass {
    /// Mass from the measured forces alongside a prediction, over the instrumented window; `None` if it is too short.
    #[must_use]
    pub fn of_plates(analysis: &PredictedAnalysis, model: &Model, [from_s, to_s]: [f64; 2]) -> Option<PlateMass> {
        let measured = analysis.measured.as_ref()?;
        let (grid, up) = (measured.trajectory.grid(), model.up());
        let (first, frames) = grid.inside(Window { from_s: Some(from_s), to_s: Some(to_s) });
        let duration_s = (frames as f64) * grid.step_s;
        if duration_s < SHORTEST_S {
            return None;
        }
        let plates = |i: usize| measured.ground.bodies.iter().map(|body| body.force[i].dot(&up)).sum::<f64>();
        let needed = |i: usize| analysis.prediction.total[i].force.dot(&up);
        let [plates, needed]: [f64; 2] =
            [(first..first + frames).map(plates).sum(), (first..first + frames).map(needed).sum()];
        let by = Weighing::Walking { duration_s };
        (needed > 0.0).then(|| PlateMass { kg: model.mass() * plates / needed, by })
    }

    /// The most accurate mass: from plates over a whole cycle, else from a standing trial, else from plates for a
    /// shorter time.
    pub(super) fn best(analysis: &PredictedAnalysis, plates: Option<Self>, standing_kg: Option<f64>) -> Option<Self> {
        let standing = standing_kg.map(|kg| PlateMass { kg, by: Weighing::Standing });
        let cycles = analysis.analysis.cycles.iter().map(|cycle| cycle.end_s - cycle.start_s);
        let cycle_s = cycles.fold(f64::INFINITY, f64::min);
        match plates {
            Some(PlateMass { by: Weighing::Walking { duration_s }, .. }) if duration_s >= cycle_s => plates,
            _ => standing.or(plates),
        }
    }
}

pub(super) fn check(evidence: &CheckedPrediction<'_>, judgement: &mut Judgement<'_>) {
    let criterion = |share: f64| Criterion { name: NAME, allowed: [1.0 - share, 1.0 + share], unit: "1" };
    let Some(PlateMass { kg, by }) = evidence.plate_mass else {
        return judgement.skip(criterion(SHARE), "no force plate measured the mass");
    };
    let is_part_of_a_cycle = |s: f64| evidence.cycles.iter().all(|cycle| cycle.end_s - cycle.start_s > s);
    let share = match by {
        Weighing::Walking { duration_s } if is_part_of_a_cycle(duration_s) => {
            let gravity = evidence.model.gravity().norm();
            SHARE + VELOCITY_ERROR_M_S / (gravity * duration_s)
        }
        Weighing::Standing | Weighing::Walking { .. } => SHARE,
    };
    let grid = evidence.trajectory.grid();
    let found = TimedValue { value: kg / evidence.model.mass(), time_s: [grid.start_s, grid.end_s()] };
    // `study` reports a mass that disagrees, for measured and predicted forces alike.
    judgement.take(criterion(share), found);
}
