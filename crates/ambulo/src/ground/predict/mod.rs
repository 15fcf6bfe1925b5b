//! Predicts the ground reaction forces on both feet from the motion alone.
//!
//! Newton's and Euler's laws for the whole body give the total wrench of the ground ([`total_wrench`]); the motion of
//! the feet gives the stances ([`super::footfalls`]); normative curves at the same walking speed give a prior for each
//! stance. Who walks backwards is played back (`played_back`). The result is the maximum a posteriori estimate with its
//! standard deviations ([`estimate`]); docs/GROUND_FORCES.md describes the method, its accuracy and its limits. In
//! double support twelve unknowns have six equations: every result names the rule that divides the forces. Pinned by:
//! tests/ground_predict.rs

pub(crate) mod center_path;
pub(crate) mod deviation_calibration;
mod estimate;
pub(crate) mod evidence_filter;
mod expected;
mod fitted_parameters;
pub(crate) mod forefoot;
pub(crate) mod geometry;
mod loads;
mod misfit;
mod normal_equations;
mod personal;
mod played_back;
mod prescribed;
mod samples;
pub(crate) mod stance_curves;
mod stance_errors;
pub(crate) mod stance_traits;
pub(crate) mod stances;
pub(crate) mod strike_descent;
mod total;
pub(crate) mod unilateral;
pub(crate) mod unknowns;
pub(crate) mod zero_moment_point;

use super::footfalls::{Footfall, Footfalls, OffSpeed, SignalFrame, Signals, detect};
use super::{BodyForces, GroundForces};
use crate::findings::Findings;
use crate::kinematics::{Trajectory, each_body_motion};
use crate::model::anatomy::Sole;
use crate::model::{BySide, Model, Side};
use crate::motion::TimeGrid;
use crate::motion::filter::LowPass;
use crate::spatial::{Vec3, Wrench};
pub use deviation_calibration::{ByFifth, DeviationCalibration, DeviationScaling, scaling_at};
use estimate::estimate;
pub(crate) use evidence_filter::SMOOTHED_HZ;
pub use evidence_filter::is_smoothed;
pub use fitted_parameters::{FittedParameters, checksum};
pub(super) use geometry::{Geometry, GeometryFrame};
pub use personal::{OtherPerson, PersonalErrors};
use played_back::range_played_back;
pub use prescribed::Prescribed;
use samples::EstimateInputs;
use stance_curves::StanceCurves;
pub(crate) use stance_errors::outwards_sign;
pub use stance_errors::{Ends, ErrorSample, ErrorsByTraits, KNOTS, REPEATS, StanceCurve, StanceErrors, trusted};
pub(crate) use stance_traits::stance_traits;
pub use stance_traits::{HASTE, TRAITS, Traits};
use stances::{BodyScale, stances};
use std::ops::Range;
pub use total::total_wrench;
use unilateral::enforce_unilateral_contact;

/// Smallest accepted gravity [m/s²].
const LEAST_GRAVITY: f64 = 0.1;
/// How forces are divided between the feet in double support.
const RULE: &str = "maximum a posteriori estimate (lever rule, normative curves by speed, smoothness)";
/// Name of the rule with the calibration of a person.
const RULE_OF_PERSON: &str = "maximum a posteriori estimate (lever rule, normative curves by speed, smoothness), \
    calibrated for the person on force plates";

/// Ground reaction forces predicted from motion alone, with standard deviations, the stances of both feet, and the
/// total wrench by Newton's law that they add up to.
#[derive(Debug, Clone, PartialEq)]
pub struct Prediction {
    /// Ground reaction forces on the right and the left foot.
    pub ground: GroundForces,
    /// Standard deviations for the right and the left foot.
    pub deviations: Vec<FootDeviation>,
    /// Stances of the feet.
    pub footfalls: Footfalls,
    /// Total ground force [N] and moment about the world's origin [N.m] that the motion requires, one entry per frame.
    pub total: Vec<Wrench>,
    /// How forces were divided between the feet in double support, in words.
    pub rule: &'static str,
    /// The bandwidth of the recorded motion [Hz]; `None` where it is not known.
    pub motion_bandwidth_hz: Option<f64>,
}

/// Standard deviations of the prediction for one foot, one entry per frame; zero in swing.
#[derive(Debug, Clone, PartialEq)]
pub struct FootDeviation {
    /// Side of the foot.
    pub side: Side,
    /// Standard deviation of the force [N].
    pub force: Vec<Vec3>,
    /// Standard deviation of the centre of pressure [m].
    pub center: Vec<Vec3>,
    /// Standard deviation of the free moment [N.m].
    pub free_moment: Vec<f64>,
}

impl Prediction {
    /// Ground reaction force on a foot and its standard deviation.
    #[must_use]
    pub fn foot(&self, side: Side) -> (&BodyForces, &FootDeviation) {
        let index = usize::from(side == Side::Left);
        (&self.ground.bodies[index], &self.deviations[index])
    }

    /// A range of the frames, whose time grid is `grid`; stances are cut at its ends.
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
            motion_bandwidth_hz: self.motion_bandwidth_hz,
        }
    }
}

/// Settings of [`predict`].
#[derive(Debug, Clone, Default, PartialEq)]
pub struct PredictSettings {
    /// Quantities that are given and not estimated.
    pub prescribed: Prescribed,
    /// Standard deviations of prior and evidence.
    pub parameters: FittedParameters,
    /// Calibration of the person by trials on force plates.
    pub person: Option<PersonalErrors>,
    /// The low-pass filter that the motion has passed; `None` if it was not filtered.
    pub motion_filter: Option<LowPass>,
    /// The bandwidth of the recorded motion before that filter [Hz]; `None` if it is not known.
    pub motion_bandwidth_hz: Option<f64>,
}

/// Why forces cannot be predicted.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PredictError {
    /// A model without feet.
    #[error("the model `{model}` has no two legs with hip, knee, ankle and foot; expected both legs")]
    NoFeet {
        /// Name of the model.
        model: String,
    },
    /// A foot without a sole.
    #[error("the {side} sole of the model `{model}` is not known; expected the soles of both feet")]
    NoSole {
        /// Name of the model.
        model: String,
        /// Side of the foot.
        side: Side,
    },
    /// A model without mass.
    #[error(
        "the model `{model}` has a mass of {mass} kg; expected bodies with masses. hint: from motion alone every force \
         scales with the mass"
    )]
    NoMass {
        /// Name of the model.
        model: String,
        /// Mass of the model [kg].
        mass: f64,
    },
    /// A model without gravity.
    #[error("the model `{model}` has a gravity of {gravity} m/s²; expected at least 0.1")]
    NoGravity {
        /// Name of the model.
        model: String,
        /// Gravity of the model [m/s²].
        gravity: f64,
    },
    /// A calibration of another person.
    #[error(transparent)]
    OtherPerson(#[from] OtherPerson),
    /// A calibration that belongs to another estimate.
    #[error(
        "the calibration of the person has the errors of another estimate ({found:016x}); expected those of this one \
         ({expected:016x})"
    )]
    OtherEstimator {
        /// Fingerprint of its parameters.
        found: u64,
        /// Fingerprint of the parameters in use.
        expected: u64,
    },
    /// Built-in curves that cannot be read.
    #[error("the built-in normative curves cannot be read: {message}")]
    Curves {
        /// Why.
        message: String,
    },
    /// Equations that need too much memory.
    #[error(
        "the estimate of the ground forces would need {found_mb:.0} MB; expected {most_mb:.0} MB at most. hint: use a \
         shorter range; many foot strikes per second are a sign of noise"
    )]
    TooLarge {
        /// Memory that they need [MB].
        found_mb: f64,
        /// Memory limit [MB].
        most_mb: f64,
    },
    /// Prescribed stances that overlap or end before they begin.
    #[error(
        "a prescribed stance of the {side} foot at {time_s} s ends before it begins or overlaps the previous one; \
         expected stances in order of time"
    )]
    Footfalls {
        /// Side of the foot.
        side: Side,
        /// Foot strike or foot off of the stance [s].
        time_s: f64,
    },
    /// Equations without a solution.
    #[error("the estimate of the ground forces has no solution; expected finite numbers in the motion")]
    NoSolution,
    /// A prescribed series of another length than the motion.
    #[error("the prescribed {what} has {found} frames; expected {expected}, as many as the motion")]
    Shape {
        /// The series.
        what: &'static str,
        /// Number of frames found.
        found: usize,
        /// Number of frames of the motion.
        expected: usize,
    },
}

/// Predicts the ground reaction forces on both feet. They act on the bodies with the rear points of the soles.
///
/// # Errors
/// A model without feet or soles, prescribed series of another length than the motion: see [`PredictError`].
///
/// The predicted vertical force of a synthetic walk is on average what Newton's law requires:
///
/// ```
/// use ambulo::analysis::feasibility::Person;
/// use ambulo::findings::Findings;
/// use ambulo::gait::Gait;
/// use ambulo::ground::predict::{PredictSettings, predict, total_wrench};
/// use ambulo::model::anthropometry::{Build, SegmentTable};
/// use ambulo::simulation::synthetic::{SyntheticMode, SyntheticWalkSettings, synthesise};
///
/// let mut findings = Findings::default();
/// let build = Build { table: SegmentTable::DeLevaMale, mass: 72.6, height: 1.80, toe_joint: false };
/// let gait = Gait::named("free")?;
/// let mode = SyntheticMode::Paper;
/// let settings = SyntheticWalkSettings { gait: &gait, build, mode, cycles: 1, rate_hz: 100.0 };
/// let walk = synthesise(&settings, &mut findings)?;
/// let (model, soles) = (&walk.human.model, Person::of_human(&walk.human).soles);
/// let prediction = predict(model, &walk.trajectory, &soles, &PredictSettings::default(), &mut findings)?;
/// let predicted: f64 = prediction.ground.bodies.iter().flat_map(|foot| &foot.force).map(|force| force.y).sum();
/// let required: f64 = total_wrench(model, &walk.trajectory).iter().map(|wrench| wrench.force.y).sum();
/// assert!((predicted / required - 1.0).abs() < 0.05, "{predicted} instead of {required}");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn predict(
    model: &Model,
    trajectory: &Trajectory,
    soles: &BySide<Option<Sole>>,
    settings: &PredictSettings,
    findings: &mut Findings,
) -> Result<Prediction, PredictError> {
    let soles = both_soles(model, soles)?;
    settings.prescribed.check(trajectory.grid().frames)?;
    let grid = trajectory.grid();
    let all_soles = soles.map(Some);
    let mut signals = Signals::empty(model, grid, &all_soles);
    let mut geometry = Geometry::with_capacity(grid.frames);
    each_body_motion(model, trajectory, |_, bodies| {
        signals.push(&SignalFrame::of(model, &all_soles, bodies));
        geometry.push(&GeometryFrame::of(model, &soles, bodies));
    });
    let footfalls = match &settings.prescribed.footfalls {
        Some(prescribed) => prescribed.clone(),
        None => detect(&signals, OffSpeed::default(), findings),
    };
    drop(signals);
    let total = settings.prescribed.total(total_wrench(model, trajectory));
    predict_frames(model, &soles, KnownMotion { grid, geometry, total, footfalls }, settings, 0..grid.frames)
}

/// The soles of both feet.
pub(super) fn both_soles(model: &Model, soles: &BySide<Option<Sole>>) -> Result<BySide<Sole>, PredictError> {
    let name = || model.name().to_owned();
    if soles.values().all(Option::is_none) {
        return Err(PredictError::NoFeet { model: name() });
    }
    let sole = |side: Side| soles[side].ok_or_else(|| PredictError::NoSole { model: name(), side });
    Ok(BySide { right: sole(Side::Right)?, left: sole(Side::Left)? })
}

/// Quantities of a motion that a prediction uses, one entry per frame.
pub(super) struct KnownMotion {
    pub(super) grid: TimeGrid,
    pub(super) geometry: Geometry,
    /// Total ground force and moment about the world's origin.
    pub(super) total: Vec<Wrench>,
    pub(super) footfalls: Footfalls,
}

/// As [`predict`], but only in the `wanted` frames; the forces and deviations of the others are zero. Where these are
/// not all frames, only the part of the motion on which they depend is evaluated ([`estimate`]).
pub(super) fn predict_frames(
    model: &Model,
    soles: &BySide<Sole>,
    motion: KnownMotion,
    settings: &PredictSettings,
    wanted: Range<usize>,
) -> Result<Prediction, PredictError> {
    if !motion.is_backwards(model.up()) {
        return predict_forwards(model, soles, motion, settings, wanted);
    }
    let (footfalls, frames) = (motion.footfalls.clone(), motion.grid.frames);
    let settings = PredictSettings { prescribed: settings.prescribed.played_back(), ..settings.clone() };
    let wanted = range_played_back(&wanted, frames);
    let forwards = predict_forwards(model, soles, motion.played_back(), &settings, wanted)?;
    Ok(forwards.played_back(footfalls))
}

/// The forces under a person who does not walk backwards.
fn predict_forwards(
    model: &Model,
    soles: &BySide<Sole>,
    motion: KnownMotion,
    settings: &PredictSettings,
    wanted: Range<usize>,
) -> Result<Prediction, PredictError> {
    let body_scale = body_scale(model)?;
    let KnownMotion { grid, geometry, total, footfalls } = motion;
    if let Some(person) = &settings.person {
        person.check(model)?;
        let (found, expected) = (person.estimator, settings.parameters.fingerprint());
        if found != expected {
            return Err(PredictError::OtherEstimator { found, expected });
        }
    }
    let curves = StanceCurves::built_in().map_err(|e| PredictError::Curves { message: e.to_string() })?;
    let stances = stances(&footfalls, grid, &geometry, &body_scale, curves);
    let inputs = EstimateInputs {
        grid,
        geometry: &geometry,
        half_widths: soles.as_ref().map(|sole| sole.half_width),
        stances: &stances,
        total: &total,
        body_scale: &body_scale,
        parameters: &settings.parameters,
        prescribed: &settings.prescribed,
        person: settings.person.as_ref(),
        motion_filter: settings.motion_filter,
        motion_bandwidth_hz: settings.motion_bandwidth_hz,
    };
    let mut feet = estimate(&inputs, curves, wanted)?;
    let up = body_scale.up;
    enforce_unilateral_contact(&mut feet, up, &settings.prescribed);
    let deviations = feet.values().map(|foot| foot.deviation.clone()).collect();
    let ground = feet.iter().map(|(side, foot)| {
        let body = soles[side].points[0].body;
        let moment: Vec<Vec3> =
            (0..foot.force.len()).map(|i| foot.center[i].cross(&foot.force[i]) + up * foot.free_moment[i]).collect();
        BodyForces::on_ground(body, &foot.force, &moment, up, &foot.height)
    });
    let ground = GroundForces { bodies: ground.collect() };
    let rule = if settings.person.is_some() { RULE_OF_PERSON } else { RULE };
    Ok(Prediction { ground, deviations, footfalls, total, rule, motion_bandwidth_hz: settings.motion_bandwidth_hz })
}

/// Mass, size and gravity of a model.
fn body_scale(model: &Model) -> Result<BodyScale, PredictError> {
    let name = || model.name().to_owned();
    let (stature, gravity) = (model.stature(), model.gravity().norm());
    if model.mass() <= 0.0 {
        return Err(PredictError::NoMass { model: name(), mass: model.mass() });
    }
    if gravity < LEAST_GRAVITY {
        return Err(PredictError::NoGravity { model: name(), gravity });
    }
    Ok(BodyScale {
        up: model.up(),
        weight_n: model.mass() * gravity,
        leg_time_s: (stature.leg_length_m / gravity).sqrt(),
        leg_speed_m_s: (stature.leg_length_m * gravity).sqrt(),
        height_m: stature.height_m,
    })
}
