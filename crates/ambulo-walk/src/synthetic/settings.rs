//! Settings of a synthetic walk.

use crate::control::ControlError;
use crate::findings::Findings;
use crate::gait::machine::repeats;
use crate::gait::{Gait, GaitError, Walk, walking_speeds};
use crate::kinematics::TrajectoryError;
use crate::model::anthropometry::{Build, BuildError};
use crate::numerics::Shown;
use crate::optimal::OptimalWalkError;
use crate::walking::WalkingError;
use std::fmt;
use std::ops::RangeInclusive;

/// How a walk is computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SyntheticMode {
    /// In three dimensions, found by optimal motion on soft shoes: only joint forces and ground forces act.
    Optimal,
    /// In three dimensions, predicted: minimises muscle effort instead of following normative curves.
    Predicted,
    /// In the sagittal plane, dynamically consistent, on soft shoes.
    Corrected,
    /// As in the 1997 paper: rigid soles, and the trunk is held upright.
    Paper,
    /// In three dimensions, on soft shoes, by torques of a controller that follows the optimal walk; the figure may
    /// fall.
    Physical,
}

impl SyntheticMode {
    /// The default mode of a gait: optimal for a steady normative gait on a figure with toe joints, in the range of
    /// walking speeds and with steps near the preferred length; the paper's for a gait whose machines move joints
    /// otherwise from cycle to cycle; else corrected.
    #[must_use]
    pub fn of(gait: &Gait, build: &Build, leg_length: f64) -> SyntheticMode {
        let is_optimal = gait.follows_people() && gait.pace_changes.is_empty() && build.toe_joint;
        if is_optimal && has_usual_steps(gait, leg_length).unwrap_or(false) {
            SyntheticMode::Optimal
        } else if has_equal_cycles(gait, leg_length) {
            SyntheticMode::Corrected
        } else {
            SyntheticMode::Paper
        }
    }

    /// Name of the mode in files and options.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            SyntheticMode::Optimal => "optimal",
            SyntheticMode::Predicted => "predict",
            SyntheticMode::Corrected => "corrected",
            SyntheticMode::Paper => "paper",
            SyntheticMode::Physical => "physical",
        }
    }
}

/// Steps that optimal walks can have, as shares of the preferred step at the same speed. Figures with longer ones hop;
/// shorter ones were not tried.
const STEPS: RangeInclusive<f64> = 0.7..=1.12;

/// Whether a gait does the same in every cycle, apart from changes of pace.
fn has_equal_cycles(gait: &Gait, leg_length: f64) -> bool {
    // A gait that is no walk is refused later, whatever its mode.
    Walk::new(gait, leg_length, &mut Findings::default()).map_or(gait.is_symmetric(), |walk| repeats(&walk))
}

/// Whether speed and steps of a gait are in the range of optimal walks.
fn has_usual_steps(gait: &Gait, leg_length: f64) -> Result<bool, GaitError> {
    let walk = Walk::new(gait, leg_length, &mut Findings::default())?;
    let preferred = Gait { pace: gait.pace.with(Some(walk.speed()), None, None), ..gait.clone() };
    let preferred = Walk::new(&preferred, leg_length, &mut Findings::default())?;
    let [slowest, fastest] = walking_speeds(leg_length);
    Ok((slowest..=fastest).contains(&walk.speed()) && STEPS.contains(&(walk.step_length() / preferred.step_length())))
}

impl fmt::Display for SyntheticMode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// Settings of a synthetic walk.
#[derive(Debug, Clone, Copy)]
pub struct SyntheticWalkSettings<'a> {
    /// The gait.
    pub gait: &'a Gait,
    /// Size and mass of the figure.
    pub build: Build,
    /// How the walk is computed.
    pub mode: SyntheticMode,
    /// Number of whole cycles of each foot.
    pub cycles: usize,
    /// Frame rate of the motion [Hz].
    pub rate_hz: f64,
}

/// Largest number of cycles.
pub const MOST_CYCLES: usize = 1000;
/// Smallest and largest frame rate [Hz].
pub const RATES_HZ: [f64; 2] = [20.0, 5000.0];
/// Smallest step rate of the simulator [Hz].
const SLOWEST_STEPS_HZ: f64 = 1000.0;

impl SyntheticWalkSettings<'_> {
    pub(super) fn check(&self) -> Result<(), SyntheticError> {
        if !(1..=MOST_CYCLES).contains(&self.cycles) {
            return Err(SyntheticError::Cycles { found: self.cycles });
        }
        if !(RATES_HZ[0]..=RATES_HZ[1]).contains(&self.rate_hz) {
            return Err(SyntheticError::Rate { found_hz: self.rate_hz });
        }
        Ok(())
    }

    /// Steps of the simulator per frame of the motion.
    pub(super) fn steps_per_frame(&self) -> usize {
        (SLOWEST_STEPS_HZ / self.rate_hz - 1e-9).ceil().max(1.0) as usize
    }

    /// Time step of the simulator [s].
    pub(super) fn step_s(&self) -> f64 {
        1.0 / (self.rate_hz * self.steps_per_frame() as f64)
    }
}

/// Why a walk could not be computed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SyntheticError {
    /// A number of cycles outside the allowed range.
    #[error("found {found} cycles; expected 1 to {MOST_CYCLES}, because a walk repeats its cycles")]
    Cycles {
        /// Number of cycles.
        found: usize,
    },
    /// A frame rate outside the allowed range.
    #[error("found a frame rate of {} Hz; expected {} to {} Hz, because a slower rate misses foot strikes and a faster \
        one needs too much memory", Shown(*found_hz), RATES_HZ[0], RATES_HZ[1])]
    Rate {
        /// Frame rate [Hz].
        found_hz: f64,
    },
    /// An optimal walk repeats one cycle.
    #[error(
        "the gait `{gait}`: found machines, changes of pace or sides that differ; expected equal cycles and sides half \
         a cycle apart, because an optimal walk is computed for half a cycle. hint: use the mode `corrected` or `paper`"
    )]
    Changing {
        /// Name of the gait.
        gait: String,
    },
    /// Optimal walks follow normative forces, which belong to the normative joint curves.
    #[error(
        "the gait `{gait}`: found curves, joints or steps that are changed; expected the normative curves (style \
         knots), because an optimal walk also follows normative forces. hint: use the mode `corrected`"
    )]
    NotOfPeople {
        /// Name of the gait.
        gait: String,
    },
    /// Predicted walks follow no curves.
    #[error(
        "the gait `{gait}`: found machines, changes of pace, or curves, joints or steps that are changed; expected a \
         gait of healthy people at constant pace, because a predicted walk takes its speed and steps and follows none \
         of its curves. hint: give another gait; sides differ where their strengths or devices do"
    )]
    Predicted {
        /// Name of the gait.
        gait: String,
    },
    /// A free cadence is found, not given.
    #[error(
        "the gait `{gait}`: found a length or a frequency of its steps, and a free cadence; expected one of them, \
         because a free cadence and its step length follow from the speed. hint: give the speed alone, or do not ask \
         for a free cadence"
    )]
    GivenSteps {
        /// Name of the gait.
        gait: String,
    },
    /// A controller follows one gait and changes its speed.
    #[error(
        "the gait `{gait}`: found machines, sides that differ, standing at the start, or changes of step length or \
         step frequency; expected equal cycles and changes of speed alone, because a controller follows optimal walks. \
         hint: use the mode `corrected` or `paper`"
    )]
    NotControlled {
        /// Name of the gait.
        gait: String,
    },
    /// There is no controller for the walk.
    #[error(transparent)]
    Control(#[from] ControlError),
    /// Figures in three dimensions have toe joints.
    #[error(
        "found a figure without toe joints; expected toe joints, because the figure in three dimensions has them. \
         hint: the modes `corrected` and `paper` need none, on level ground and without loads, weak joints and devices"
    )]
    NoToeJoint,
    /// Torques of one cycle cannot replay a gait whose cycles differ.
    #[error(
        "the gait `{gait}`: found machines or changes of pace; expected equal cycles, because the torques are those of \
         one cycle"
    )]
    Replay {
        /// Name of the gait.
        gait: String,
    },
    /// The figure could not be built.
    #[error(transparent)]
    Build(#[from] BuildError),
    /// The gait is invalid.
    #[error(transparent)]
    Gait(#[from] GaitError),
    /// No optimal walk was found, or the gait could not be made dynamically consistent.
    #[error(transparent)]
    Optimal(#[from] OptimalWalkError),
    /// The walk could not be simulated.
    #[error(transparent)]
    Walking(#[from] WalkingError),
    /// The simulated motion is not finite.
    #[error(transparent)]
    Trajectory(#[from] TrajectoryError),
}
