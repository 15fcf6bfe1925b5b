//! What the ground does to the feet, from the motion alone.
//!
//! Newton's and Euler's laws for the whole body give the total wrench of the ground ([`total_wrench`]); the feet's own motion says when
//! each stands ([`super::footfalls`]); what people's feet carry who walk at this speed says what to expect of a stance. The likeliest curves
//! under all of this are the answer, with their deviations ([`estimate`]); docs/GROUND_FORCES.md tells the method, its accuracy and its
//! weak points. While both feet stand six equations face twelve unknowns: the rule that decides is named in every result.
//! Pinned by: tests/ground_predict.rs

mod calibration;
mod center_path;
mod estimate;
mod expected;
mod geometry;
mod known;
mod loads;
mod samples;
mod stance_curves;
mod stances;
mod system;
mod taps;
mod total;
mod unilateral;
mod unknowns;
mod weights;

use super::footfalls::{Footfall, Footfalls, footfalls};
use super::{BodyForces, GroundForces, upward};
use crate::findings::Findings;
use crate::kinematics::Trajectory;
use crate::model::anatomy::Sole;
use crate::model::{BySide, Model, Side};
use crate::motion::TimeGrid;
use crate::spatial::{Vec3, Wrench};
pub use calibration::{Calibration, Spread};
use estimate::estimate;
use geometry::Geometry;
pub use known::Known;
use samples::Evidence;
use stance_curves::StanceCurves;
use stances::{Measure, stances};
use std::ops::Range;
pub use total::total_wrench;
use unilateral::keep_on_the_ground;
pub use weights::Weights;

/// Less gravity holds nobody on the ground [m/s²].
const LEAST_GRAVITY: f64 = 0.1;
/// The name of the rule that divides double support.
const RULE: &str = "likeliest curves of all stances: lever rule, curves of people by speed, smoothness";

/// Forces under the feet that no plate measured.
#[derive(Debug, Clone, PartialEq)]
pub struct Prediction {
    /// What the ground does: one entry a foot, right and left.
    pub ground: GroundForces,
    /// How far it may be off: right and left.
    pub deviations: Vec<FootDeviation>,
    /// When the feet stand.
    pub footfalls: Footfalls,
    /// Of the ground on the body, by Newton's law alone: force [N] and moment about the world's origin [N.m], one entry a frame.
    pub total: Vec<Wrench>,
    /// How double support was divided, in words.
    pub rule: &'static str,
}

/// Standard deviations of what was predicted for a foot, one entry a frame; zero while it does not stand.
#[derive(Debug, Clone, PartialEq)]
pub struct FootDeviation {
    /// Which foot.
    pub side: Side,
    /// Of the force [N].
    pub force: Vec<Vec3>,
    /// Of the centre of pressure [m].
    pub center: Vec<Vec3>,
    /// Of the free moment [N.m].
    pub free_moment: Vec<f64>,
}

impl Prediction {
    /// What the ground does to a foot, and how far it may be off.
    #[must_use]
    pub fn foot(&self, side: Side) -> (&BodyForces, &FootDeviation) {
        let index = usize::from(side == Side::Left);
        (&self.ground.bodies[index], &self.deviations[index])
    }

    /// Some of its frames, those of `grid`; stances that reach beyond are cut there.
    #[must_use]
    pub(crate) fn within(&self, frames: Range<usize>, grid: TimeGrid) -> Prediction {
        let deviation = |of: &FootDeviation| FootDeviation {
            side: of.side,
            force: of.force[frames.clone()].to_vec(),
            center: of.center[frames.clone()].to_vec(),
            free_moment: of.free_moment[frames.clone()].to_vec(),
        };
        let (first, last) = (grid.start_s, grid.end_s());
        let overlaps = |fall: &&Footfall| {
            fall.strike_s.is_none_or(|strike| strike < last) && fall.off_s.is_none_or(|off| off > first)
        };
        let cut = |fall: &Footfall| Footfall {
            strike_s: fall.strike_s.filter(|strike| *strike >= first),
            off_s: fall.off_s.filter(|off| *off <= last),
            ..*fall
        };
        let falls = self.footfalls.falls.iter().filter(overlaps).map(cut).collect();
        let bodies = self.ground.bodies.iter().map(|body| body.within(frames.clone())).collect();
        Prediction {
            ground: GroundForces { bodies },
            deviations: self.deviations.iter().map(deviation).collect(),
            footfalls: Footfalls { falls, ..self.footfalls.clone() },
            total: self.total[frames.clone()].to_vec(),
            rule: self.rule,
        }
    }
}

/// How forces are predicted.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct PredictSettings {
    /// What is known from elsewhere and need not be found.
    pub known: Known,
    /// How much each piece of evidence counts.
    pub weights: Weights,
}

/// Why no forces can be predicted.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PredictError {
    /// A model without feet.
    #[error(
        "the model `{model}` has no two legs with hip, knee, ankle and foot; expected feet for the ground to act on"
    )]
    NoFeet {
        /// Its name.
        model: String,
    },
    /// A foot without a sole.
    #[error("the {side} sole of the model `{model}` is not known; expected the soles of both feet")]
    NoSole {
        /// Its name.
        model: String,
        /// Which foot.
        side: Side,
    },
    /// A model that weighs nothing.
    #[error(
        "the model `{model}` has a mass of {mass} kg; expected bodies with masses. hint: from motion alone every force scales with the mass"
    )]
    NoMass {
        /// Its name.
        model: String,
        /// Its mass [kg].
        mass: f64,
    },
    /// A model that nothing presses to the ground.
    #[error("the model `{model}` has a gravity of {gravity} m/s²; expected at least 0.1")]
    NoGravity {
        /// Its name.
        model: String,
        /// Its gravity [m/s²].
        gravity: f64,
    },
    /// The crate's own curves.
    #[error("the curves of stances cannot be read: {message}")]
    Curves {
        /// Why.
        message: String,
    },
    /// More than memory should hold.
    #[error(
        "the equations of the forces would take {found_mb:.0} MB; expected {most_mb:.0} MB at most. hint: use a shorter range; feet that strike many times per second are a sign of noise"
    )]
    TooLarge {
        /// What they would take.
        found_mb: f64,
        /// What they may take.
        most_mb: f64,
    },
    /// Stances that are known and cannot be.
    #[error(
        "a known stance of the {side} foot at {time_s} s ends before it begins, or before the one before it has ended; expected stances in order of time"
    )]
    Footfalls {
        /// Which foot.
        side: Side,
        /// When it strikes, or leaves [s].
        time_s: f64,
    },
    /// The motion's numbers.
    #[error("the equations of the forces have no solution; expected finite numbers in the motion")]
    NoSolution,
    /// What is known has another number of frames than the motion.
    #[error("the known {what} has {found} frames; expected {expected}, as many as the motion")]
    Shape {
        /// What is known.
        what: &'static str,
        /// How many frames it has.
        found: usize,
        /// How many it should have.
        expected: usize,
    },
}

/// Predicts the forces under both feet, on the bodies that carry the rear ends of the soles.
///
/// # Errors
/// A model without feet or soles, known numbers of another length than the motion: see [`PredictError`].
pub fn predict(
    model: &Model,
    trajectory: &Trajectory,
    soles: &BySide<Option<Sole>>,
    settings: &PredictSettings,
    findings: &mut Findings,
) -> Result<Prediction, PredictError> {
    let name = || model.name().to_owned();
    if soles.values().all(Option::is_none) {
        return Err(PredictError::NoFeet { model: name() });
    }
    let sole = |side: Side| soles[side].ok_or_else(|| PredictError::NoSole { model: name(), side });
    let soles = BySide { right: sole(Side::Right)?, left: sole(Side::Left)? };
    settings.known.check(trajectory.grid().frames)?;
    let footfalls = match &settings.known.footfalls {
        Some(known) => known.clone(),
        None => footfalls(model, trajectory, &soles.map(Some), findings),
    };
    let total = settings.known.total(total_wrench(model, trajectory));
    let up = upward(model);
    let stature = model.stature();
    let gravity = model.gravity().norm();
    if model.mass() <= 0.0 {
        return Err(PredictError::NoMass { model: name(), mass: model.mass() });
    }
    if gravity < LEAST_GRAVITY {
        return Err(PredictError::NoGravity { model: name(), gravity });
    }
    let measure = Measure {
        up,
        weight_n: model.mass() * gravity,
        leg_time_s: (stature.leg_length_m / gravity).sqrt(),
        leg_speed_m_s: (stature.leg_length_m * gravity).sqrt(),
        height_m: stature.height_m,
    };
    let curves = StanceCurves::built_in().map_err(|e| PredictError::Curves { message: e.to_string() })?;
    let geometry = Geometry::new(model, trajectory, &soles);
    let stances = stances(&footfalls, trajectory.grid(), &geometry, &measure, curves);
    let evidence = Evidence {
        grid: trajectory.grid(),
        geometry: &geometry,
        half_widths: soles.map(|sole| sole.half_width),
        stances: &stances,
        total: &total,
        measure: &measure,
        weights: &settings.weights,
        known: &settings.known,
    };
    let mut feet = estimate(&evidence, curves)?;
    keep_on_the_ground(&mut feet, up, &settings.known);
    let deviations = feet.values().map(|foot| foot.deviation.clone()).collect();
    let ground = feet.iter().map(|(side, foot)| {
        let body = soles[side].points[0].body;
        let moment: Vec<Vec3> =
            (0..foot.force.len()).map(|i| foot.center[i].cross(&foot.force[i]) + up * foot.free_moment[i]).collect();
        BodyForces::on_ground(body, &foot.force, &moment, up, &foot.height)
    });
    let ground = GroundForces { bodies: ground.collect() };
    Ok(Prediction { ground, deviations, footfalls, total, rule: RULE })
}
