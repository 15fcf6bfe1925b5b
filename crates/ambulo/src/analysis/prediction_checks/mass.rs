//! The model's mass against what plates carried: the motion alone cannot tell it.

use super::CheckedPrediction;
use super::judgement::{Found, Judgement, Looked};
use crate::analysis::predicted::PredictedAnalysis;
use crate::ground::upward;
use crate::model::Model;
use crate::motion::Window;

pub(super) const NAME: &str = "mass";
/// Model and plates may differ by this share.
const SHARE: f64 = 0.05;
/// Plates that measured every foot for less than this say nothing of the mass [s]: the mean force over a time T is as wrong as the
/// velocities at its ends over g T, 2 % for 0.05 m/s.
const SHORTEST_S: f64 = 0.3;

/// Body mass by plates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum CarriedMass {
    /// Beside the prediction: the model's mass times the plates' mean vertical force over that of the motion [kg].
    Plates {
        /// Mass [kg].
        kg: f64,
    },
    /// In a standing trial.
    Standing {
        /// Mass [kg].
        kg: f64,
    },
}

impl CarriedMass {
    /// By the plates beside a prediction, over the time in which they measured every foot; `None` if it is too short.
    #[must_use]
    pub fn of_plates(analysis: &PredictedAnalysis, model: &Model, [from_s, to_s]: [f64; 2]) -> Option<CarriedMass> {
        let measured = analysis.measured.as_ref()?;
        let (grid, up) = (measured.trajectory.grid(), upward(model));
        let (first, frames) = grid.inside(Window { from_s: Some(from_s), to_s: Some(to_s) });
        if (frames as f64) * grid.step_s < SHORTEST_S {
            return None;
        }
        let plates = |i: usize| measured.ground.bodies.iter().map(|body| body.force[i].dot(&up)).sum::<f64>();
        let needed = |i: usize| analysis.prediction.total[i].force.dot(&up);
        let [plates, needed]: [f64; 2] =
            [(first..first + frames).map(plates).sum(), (first..first + frames).map(needed).sum()];
        (needed > 0.0).then(|| CarriedMass::Plates { kg: model.mass() * plates / needed })
    }
}

pub(super) fn check(evidence: &CheckedPrediction<'_>, judgement: &mut Judgement<'_>) {
    let looked = Looked { name: NAME, allowed: [1.0 - SHARE, 1.0 + SHARE], unit: "1" };
    let (kg, source) = match evidence.carried {
        Some(CarriedMass::Plates { kg }) => (kg, "the plates beside the prediction"),
        Some(CarriedMass::Standing { kg }) => (kg, "the plates of the standing trial"),
        None => return judgement.skip(looked, "no plate carried the body"),
    };
    let (grid, model) = (evidence.trajectory.grid(), evidence.model.mass());
    let found = Found { value: kg / model, time_s: [grid.start_s, grid.end_s()] };
    if !judgement.take(looked, found) {
        let message = format!(
            "{source} carry {kg:.1} kg, the model has {model:.1} kg: every predicted force is {:.0} % {}. hint: --mass KG, or a model scaled to this person",
            100.0 * (model / kg - 1.0).abs(),
            if model > kg { "too large" } else { "too small" }
        );
        judgement.warn("prediction.mass", message);
    }
}
