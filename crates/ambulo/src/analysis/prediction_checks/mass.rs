//! The model's mass against what plates carried: the motion alone cannot tell it.

use super::CheckedPrediction;
use super::judgement::{Found, Judgement, Looked};
use crate::analysis::predicted::PredictedAnalysis;
use crate::findings::Code;
use crate::ground::upward;
use crate::model::Model;
use crate::motion::Window;

pub(super) const NAME: &str = "mass";
/// Model and plates may differ by this share.
const SHARE: f64 = 0.05;
/// Plates that measured every foot for less than this say nothing of the mass [s].
const SHORTEST_S: f64 = 0.3;
/// Over less than a cycle, velocities at both ends are wrong by up to this [m/s], the mean force by as much over its duration: a turning
/// child's by 0.36 m/s, three walkers' by less than 0.1.
const VELOCITY_ERROR_M_S: f64 = 0.4;

/// Body mass by plates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CarriedMass {
    /// Mass [kg].
    pub kg: f64,
    /// How it was weighed.
    pub by: CarriedBy,
}

/// How plates weighed a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum CarriedBy {
    /// Beside a prediction, while they measured every foot: the model's mass times their mean vertical force over that of the motion.
    Walking {
        /// For how long [s].
        duration_s: f64,
    },
    /// In a standing trial.
    Standing,
}

impl CarriedMass {
    /// By the plates beside a prediction, over the time in which they measured every foot; `None` if it is too short.
    #[must_use]
    pub fn of_plates(analysis: &PredictedAnalysis, model: &Model, [from_s, to_s]: [f64; 2]) -> Option<CarriedMass> {
        let measured = analysis.measured.as_ref()?;
        let (grid, up) = (measured.trajectory.grid(), upward(model));
        let (first, frames) = grid.inside(Window { from_s: Some(from_s), to_s: Some(to_s) });
        let duration_s = (frames as f64) * grid.step_s;
        if duration_s < SHORTEST_S {
            return None;
        }
        let plates = |i: usize| measured.ground.bodies.iter().map(|body| body.force[i].dot(&up)).sum::<f64>();
        let needed = |i: usize| analysis.prediction.total[i].force.dot(&up);
        let [plates, needed]: [f64; 2] =
            [(first..first + frames).map(plates).sum(), (first..first + frames).map(needed).sum()];
        let by = CarriedBy::Walking { duration_s };
        (needed > 0.0).then(|| CarriedMass { kg: model.mass() * plates / needed, by })
    }

    /// What says most of the mass: plates under a whole cycle, then a standing trial, then plates for a shorter time.
    pub(super) fn best(analysis: &PredictedAnalysis, plates: Option<Self>, standing_kg: Option<f64>) -> Option<Self> {
        let standing = standing_kg.map(|kg| CarriedMass { kg, by: CarriedBy::Standing });
        let cycles = analysis.analysis.cycles.iter().map(|cycle| cycle.end_s - cycle.start_s);
        let cycle_s = cycles.fold(f64::INFINITY, f64::min);
        match plates {
            Some(CarriedMass { by: CarriedBy::Walking { duration_s }, .. }) if duration_s >= cycle_s => plates,
            _ => standing.or(plates),
        }
    }
}

pub(super) fn check(evidence: &CheckedPrediction<'_>, judgement: &mut Judgement<'_>) {
    let looked = |share: f64| Looked { name: NAME, allowed: [1.0 - share, 1.0 + share], unit: "1" };
    let Some(CarriedMass { kg, by }) = evidence.carried else {
        return judgement.skip(looked(SHARE), "no plate carried the body");
    };
    let is_part_of_a_cycle = |s: f64| evidence.cycles.iter().all(|cycle| cycle.end_s - cycle.start_s > s);
    let (source, share) = match by {
        CarriedBy::Standing => ("of the standing trial", SHARE),
        CarriedBy::Walking { duration_s } if is_part_of_a_cycle(duration_s) => {
            let gravity = evidence.model.gravity().norm();
            ("beside the prediction", SHARE + VELOCITY_ERROR_M_S / (gravity * duration_s))
        }
        CarriedBy::Walking { .. } => ("beside the prediction", SHARE),
    };
    let (grid, model) = (evidence.trajectory.grid(), evidence.model.mass());
    let found = Found { value: kg / model, time_s: [grid.start_s, grid.end_s()] };
    if !judgement.take(looked(share), found) {
        let message = format!(
            "the plates {source} carry {kg:.1} kg, the model has {model:.1} kg: every predicted force is {:.0} % {}. hint: give the right mass, or scale the model to this person",
            100.0 * (model / kg - 1.0).abs(),
            if model > kg { "too large" } else { "too small" }
        );
        judgement.report(Code::PredictionMass, message);
    }
}
