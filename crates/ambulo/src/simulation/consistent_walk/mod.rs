//! Walks that need no hand to hold them: the smallest change of a synthetic walk that obeys dynamics on soft shoes.
//!
//! A walk put together from joint curves asks for forces that no ground can give: averages of many people do not belong to one body.
//! [`make_consistent_walk`] adds a smooth periodic change to the pelvis' path, to pelvis and trunk, to hip, knee, ankle and
//! toes, such that the forces that the soles' compression and creep give on flat ground are those that the motion needs:
//!
//!   find c:   M q̈ + h = Σ Jᵀ f(q, q̇)   in the three coordinates of the root (x, y, pitch), which no muscle drives
//!
//! with f the law of soft contact ([`crate::contact::HuntCrossley`]) at heel, ball and toes, while the motion stays near the joint
//! curves, the ground forces near those of people at that speed, and joint moments change as little as possible (minimum
//! torque change; Uno, Kawato, Suzuki 1989, unverified). All of it is one problem of nonlinear least squares, solved by
//! Levenberg and Marquardt's method ([`minimise`]) on ever stiffer shoes. Left and right are the same half a cycle apart,
//! so half a cycle is looked at; periodicity is built into the splines.
//!
//! No joint moment of people enters the problem.
//!
//! Cost: about 120 iterations, each 72 inverse dynamics an instant; a second in all.
//! Not handled: motion out of the sagittal plane; turning; changes of speed.
//! Pinned by: tests/consistent_walk.rs

mod adjustment;
mod problem;
mod response;
mod settings;
mod targets;
mod unknowns;
mod walk;

pub use adjustment::{Adjustment, Magnitude};
pub use settings::{ConsistentWalkSettings, Deviations, SOFT_SHOES};

use crate::contact::HuntCrossley;
use crate::gait::Walk;
use crate::model::anthropometry::Human;
use crate::numerics::{Progress, minimise};
use crate::toml_reader::TomlError;
use problem::{Problem, Stage};
use unknowns::Layout;

/// A walk whose forces come from the ground alone.
#[derive(Debug, Clone)]
pub struct ConsistentWalk {
    walk: Walk,
    layout: Layout,
    coefficients: Vec<f64>,
    /// How the solver got there.
    pub progress: Vec<Progress>,
}

/// Why no walk can be made consistent.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ConsistentWalkError {
    /// A coordinate that the model lacks.
    #[error("the model has no coordinate `{name}`; expected a figure of `model::anthropometry`")]
    Coordinate {
        /// Its name.
        name: String,
    },
    /// The laws of the ground forces.
    #[error(transparent)]
    Laws(#[from] TomlError),
}

/// Shoes get stiffer, friction steeper and dynamics stricter from stage to stage.
const STAGES: [Stage; 9] = [
    Stage { stiffness: 0.25, creep: 50.0, root: 25.0, iterations: 30 },
    Stage { stiffness: 0.5, creep: 25.0, root: 10.0, iterations: 30 },
    Stage { stiffness: 1.0, creep: 16.0, root: 5.0, iterations: 30 },
    Stage { stiffness: 1.0, creep: 10.0, root: 3.0, iterations: 30 },
    Stage { stiffness: 1.0, creep: 6.0, root: 2.0, iterations: 30 },
    Stage { stiffness: 1.0, creep: 4.0, root: 1.0, iterations: 30 },
    Stage { stiffness: 1.0, creep: 2.5, root: 1.0, iterations: 30 },
    Stage { stiffness: 1.0, creep: 1.6, root: 1.0, iterations: 30 },
    Stage { stiffness: 1.0, creep: 1.0, root: 1.0, iterations: 80 },
];

/// Changes a walk at constant speed until its forces come from the ground alone.
///
/// # Errors
/// What the gait's data cannot give.
pub fn make_consistent_walk(
    human: &Human,
    walk: &Walk,
    settings: &ConsistentWalkSettings,
) -> Result<ConsistentWalk, ConsistentWalkError> {
    let layout = Layout::new(&human.model, settings.splines);
    let mut problem = Problem::new(human, walk, settings, &layout)?;
    let mut coefficients = problem.first_guess();
    let mut progress = Vec::new();
    for stage in STAGES {
        problem.enter(stage);
        progress.push(minimise(&mut problem, &mut coefficients, stage.iterations));
    }
    Ok(ConsistentWalk { walk: walk.clone(), layout, coefficients, progress })
}

impl ConsistentWalk {
    /// The walk that was changed.
    #[must_use]
    pub fn walk(&self) -> &Walk {
        &self.walk
    }

    /// How many numbers were adjusted.
    #[must_use]
    pub fn parameters(&self) -> usize {
        self.coefficients.len()
    }

    /// Coordinates, rates and accelerations of the model at a time [s]; arrays as long as the model has coordinates.
    pub fn write(&self, time_s: f64, q: &mut [f64], qd: &mut [f64], qdd: &mut [f64]) {
        unknowns::reference(&self.walk, &self.layout, time_s, q, qd, qdd);
        self.layout.add(&self.coefficients, time_s / self.walk.cycle_s(), self.walk.cycle_s(), q, qd, qdd);
    }
}

/// Forces that the plan itself gives at an instant, before any simulation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlannedForces {
    /// What the root lacks: fore-aft and up [N], pitch [N.m].
    pub root: [f64; 3],
    /// Moments of hip, knee and ankle [N.m], signs of the model; right, left.
    pub moments: [[f64; 3]; 2],
    /// Fore-aft and vertical force on each foot [N].
    pub feet: [[f64; 2]; 2],
}

impl ConsistentWalk {
    /// The plan's forces at a time [s].
    ///
    /// # Errors
    /// A figure that lacks a coordinate.
    pub fn planned(
        &self,
        human: &Human,
        shoes: &HuntCrossley,
        time_s: f64,
    ) -> Result<PlannedForces, ConsistentWalkError> {
        let count = human.model.coordinates().len();
        let mut posture = [vec![0.0; count], vec![0.0; count], vec![0.0; count]];
        let [q, qd, qdd] = &mut posture;
        self.write(time_s, q, qd, qdd);
        response::planned(human, shoes, &posture)
    }
}
