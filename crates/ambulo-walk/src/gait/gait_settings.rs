//! The settings of a gait: style, pace, posture of the trunk, changes of the curves; and the built-in gaits.

use super::cyclic_curve::CyclicCurve;
use super::error::GaitError;
use super::joint::{LegJoint, WalkPart};
use super::machine::{Condition, Driven, MachineSettings};
use super::pace_plan::PaceChange;
use super::stride::{ADULT_EXPONENT, EXPONENT_1997, FREE_SPEED};
use crate::model::Side;
use crate::toml_reader::nearest;

/// The settings of a gait; [`Walk::new`](super::Walk::new) applies them to a leg length.
#[derive(Debug, Clone, PartialEq)]
pub struct Gait {
    /// Name.
    pub name: String,
    /// Interpolation of the curves.
    pub style: Style,
    /// Speed and steps.
    pub pace: Pace,
    /// Step height relative to the natural one; scales the lift of the swinging foot.
    pub step_height: f64,
    /// Whether pelvis and trunk move.
    pub pelvis: Pelvis,
    /// Changes of single knots, in order.
    pub changes: Vec<KnotChange>,
    /// Curves of hip, knee and ankle; `None` for the curve of the style.
    pub curves: [Option<CyclicCurve>; 3],
    /// Changes of the pace while walking, in the order of their times.
    pub pace_changes: Vec<PaceChange>,
    /// Changes of whole joints, of one side or both.
    pub joints: Vec<JointChange>,
    /// Machines that drive joints or the pace instead of the curves of the gait.
    pub machines: Vec<MachineSettings>,
}

/// Speed, step length and step frequency, as far as they are given. With V = step length × frequency, two of them
/// determine the third; if one is given, the cadence exponent determines the others; none means free walking.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pace {
    /// Walking speed.
    pub speed: Option<Speed>,
    /// Step length [m], from the foot strike of one foot to the foot strike of the other.
    pub step_length: Option<f64>,
    /// Step frequency [steps/s].
    pub step_frequency: Option<f64>,
    /// Exponent b of step frequency ~ V^b; `None` for the exponent of the style.
    pub cadence_exponent: Option<f64>,
    /// Factor on the resulting step length; also scales the angles and the speed.
    pub length_scale: f64,
    /// Factor on the resulting step frequency; scales the speed and does not change the angles.
    pub cadence_scale: f64,
}

impl Pace {
    /// This pace with other speed [m/s], step length [m] and step frequency [steps/s]. If one of them is given, all
    /// three are replaced; the factors remain in force, so the results have the given values.
    #[must_use]
    pub fn with(self, speed: Option<f64>, step_length: Option<f64>, step_frequency: Option<f64>) -> Pace {
        if speed.is_none() && step_length.is_none() && step_frequency.is_none() {
            return self;
        }
        let (long, quick) = (self.length_scale, self.cadence_scale);
        Pace {
            speed: speed.map(|speed| Speed::MetersPerSecond(speed / (long * quick))),
            step_length: step_length.map(|length| length / long),
            step_frequency: step_frequency.map(|frequency| frequency / quick),
            ..self
        }
    }
}

/// A walking speed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Speed {
    /// Speed in m/s.
    MetersPerSecond(f64),
    /// V/√(gL).
    Dimensionless(f64),
}

/// Motion of pelvis and trunk.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Pelvis {
    /// The pelvis tilts and the trunk leans as measured; hip angles are relative to the pelvis.
    Moving,
    /// Pelvis and trunk are held upright; hip angles are relative to the vertical: reduced by the mean pelvic tilt at
    /// that speed.
    Vertical,
}

/// A change of one knot in both legs: angle, slope and curvature are scaled about upright standing, then the offsets
/// are added.
#[derive(Debug, Clone, PartialEq)]
pub struct KnotChange {
    /// Joint.
    pub joint: LegJoint,
    /// Name of the knot; in style 1997, of the bound at which a sub-cycle ends.
    pub knot: String,
    /// Factor on slope, curvature and the distance of the angle from standing.
    pub scale: f64,
    /// Added to the angle [rad].
    pub angle: f64,
    /// Added to the slope [rad/cycle].
    pub slope: f64,
    /// Added to the curvature [rad/cycle²].
    pub curvature: f64,
    /// Added to the time [cycles].
    pub phase: f64,
}

impl KnotChange {
    /// A change of nothing, to be completed.
    #[must_use]
    pub fn of(joint: LegJoint, knot: &str) -> KnotChange {
        KnotChange { joint, knot: knot.to_owned(), scale: 1.0, angle: 0.0, slope: 0.0, curvature: 0.0, phase: 0.0 }
    }
}

/// A change of the whole curve of a joint: the distance from upright standing is scaled, then the offset is added.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointChange {
    /// The joint.
    pub part: WalkPart,
    /// Factor on the distance from upright standing.
    pub scale: f64,
    /// Added to the angle [rad].
    pub angle: f64,
}

impl Default for Pace {
    fn default() -> Pace {
        Pace {
            speed: None,
            step_length: None,
            step_frequency: None,
            cadence_exponent: None,
            length_scale: 1.0,
            cadence_scale: 1.0,
        }
    }
}

/// Interpolation of joint curves between their knots.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Style {
    /// Knots with angle, velocity and acceleration, at extremes and velocity peaks.
    Knots,
    /// The interpolation of the 1997 paper: sub-cycles between extremes, zero velocity and acceleration at their
    /// bounds, linear laws.
    Paper1997,
}

impl Style {
    /// Default motion of pelvis and trunk in this style; the paper holds the trunk at a constant angle.
    #[must_use]
    pub fn pelvis(self) -> Pelvis {
        match self {
            Style::Knots => Pelvis::Moving,
            Style::Paper1997 => Pelvis::Vertical,
        }
    }

    /// Names in files and commands.
    pub const WORDS: [(&'static str, Style); 2] = [("knots", Style::Knots), ("1997", Style::Paper1997)];

    /// Name of the style.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Style::Knots => "knots",
            Style::Paper1997 => "1997",
        }
    }
}

/// V* of slow and fast walking: the speeds with these names in the data.
const SLOW_SPEED: f64 = 0.290;
const FAST_SPEED: f64 = 0.560;
/// Speed and period of the paper's standard walk (section 4.2: "an average velocity of 1.5 m/s"; 4.1: "one second").
const STANDARD_SPEED: f64 = 1.5;
const STANDARD_PERIOD_S: f64 = 1.0;
/// Periods of the paper's other gaits (section 4.5).
const SHORT_PERIOD_S: f64 = 0.62;
const GOOSE_PERIOD_S: f64 = 0.82;
/// Long steps: the paper gives no length. A fifth longer than standard, 0.90 m: near the longest step for which the
/// linear laws keep every joint within the measured range of fast walking (hip 45°, knee 62°).
const LONG_STEP: f64 = 1.2;
/// Goose step: section 2.2 makes gaits from step length, frequency and height. The paper gives the period alone; a
/// goose step is a high step, here half as high again as the standard one, of the standard length.
const GOOSE_HEIGHT: f64 = 1.5;
/// Parade step, which is not in the paper: nearly straight knees (a fifth of their flexion) and twice the largest hip
/// flexion, which comes 10 % of the cycle earlier, so that the leg is not lowered faster than raised. It is a slow
/// march, 72 steps a minute of 0.7 times the standard length: from about 96 steps a minute on, straight legs cannot be
/// swung and set down without flight (`ambulo walk`, mode `corrected`).
const PARADE_KNEE: f64 = 0.2;
const PARADE_HIP: f64 = 2.0;
const PARADE_EARLIER: f64 = 0.10;
const PARADE_STEP: f64 = 0.7;
const PARADE_PERIOD_S: f64 = 5.0 / 3.0;

impl Gait {
    /// Names of the built-in gaits.
    pub const NAMES: [&'static str; 8] = ["standard", "long", "short", "goose", "parade", "slow", "free", "fast"];

    /// A built-in gait.
    ///
    /// # Errors
    /// [`GaitError::UnknownGait`].
    pub fn named(name: &str) -> Result<Gait, GaitError> {
        let at_speed = |speed: f64| Gait {
            pace: Pace { speed: Some(Speed::Dimensionless(speed)), ..Pace::default() },
            ..Gait::new(name, Style::Knots)
        };
        let standard = || {
            let pace = Pace {
                speed: Some(Speed::MetersPerSecond(STANDARD_SPEED)),
                step_frequency: Some(2.0 / STANDARD_PERIOD_S),
                ..Pace::default()
            };
            Gait { pace, ..Gait::new(name, Style::Paper1997) }
        };
        let paced = |length_scale: f64, period_s: f64| {
            let standard = standard();
            let pace = Pace { length_scale, cadence_scale: STANDARD_PERIOD_S / period_s, ..standard.pace };
            Gait { pace, ..standard }
        };
        match name {
            "slow" => Ok(at_speed(SLOW_SPEED)),
            "free" => Ok(at_speed(FREE_SPEED)),
            "fast" => Ok(at_speed(FAST_SPEED)),
            "standard" => Ok(standard()),
            "long" => Ok(paced(LONG_STEP, STANDARD_PERIOD_S)),
            // The paper gives no length. At the mean speed of `standard`, the step length is proportional to the
            // period.
            "short" => Ok(paced(SHORT_PERIOD_S / STANDARD_PERIOD_S, SHORT_PERIOD_S)),
            "goose" => Ok(Gait { step_height: GOOSE_HEIGHT, ..paced(1.0, GOOSE_PERIOD_S) }),
            "parade" => Ok(Gait { changes: parade_changes(), ..paced(PARADE_STEP, PARADE_PERIOD_S) }),
            _ => Err(unknown_gait(name)),
        }
    }

    /// Free walking in a style.
    #[must_use]
    pub fn new(name: &str, style: Style) -> Gait {
        Gait {
            name: name.to_owned(),
            style,
            pace: Pace::default(),
            step_height: 1.0,
            pelvis: style.pelvis(),
            changes: Vec::new(),
            curves: [None, None, None],
            pace_changes: Vec::new(),
            joints: Vec::new(),
            machines: Vec::new(),
        }
    }

    /// The same gait in another style, with the motion of the pelvis of that style.
    #[must_use]
    pub fn in_style(self, style: Style) -> Gait {
        Gait { style, pelvis: style.pelvis(), ..self }
    }

    /// The first pace at which the figure walks: the pace of the first change if it stands before.
    pub(super) fn pace_at_start(&self) -> Result<Pace, GaitError> {
        if self.pace.speed != Some(Speed::MetersPerSecond(0.0)) {
            return Ok(self.pace);
        }
        let first = self.pace_changes.first().filter(|change| !change.is_halt());
        let first = first.ok_or(GaitError::StandsForever)?;
        Ok(self.pace.with(first.speed, first.step_length, first.step_frequency))
    }

    /// The machine that drives the pace.
    #[must_use]
    pub fn machine_of_the_pace(&self) -> Option<&MachineSettings> {
        self.machines.iter().find(|machine| machine.drives == Driven::Pace)
    }

    /// Names of the signals that machines read.
    pub fn signals(&self) -> impl Iterator<Item = &str> {
        self.machines.iter().flat_map(MachineSettings::conditions).filter_map(|condition| match condition {
            Condition::Signal(name, ..) => Some(name.as_str()),
            _ => None,
        })
    }

    /// Whether a transition of a machine reads a value that exists only in a simulation, such as the loads on the feet.
    #[must_use]
    pub(crate) fn machines_read_simulation(&self) -> bool {
        let mut conditions = self.machines.iter().flat_map(|machine| &machine.transitions);
        conditions.any(|transition| transition.when.reads_simulation())
    }

    /// Whether left and right do the same half a cycle apart: no machine drives a joint, and both sides have the same
    /// changes of joints.
    #[must_use]
    pub fn is_symmetric(&self) -> bool {
        let changes = |side: Side| {
            let own = self.joints.iter().filter(move |change| change.part.side() == side);
            own.map(|change| (change.part.name().split_once(' ').map(|(_, joint)| joint), change.scale, change.angle))
                .filter(|(joint, ..)| joint.is_some())
                .collect::<Vec<_>>()
        };
        changes(Side::Right) == changes(Side::Left)
            && !self.machines.iter().any(|machine| machine.drives.moves_a_joint())
    }

    /// Whether joint angles are the normative curves at the speed of the gait, without a change of curve, joint or
    /// step; the pace may differ.
    #[must_use]
    pub(crate) fn follows_people(&self) -> bool {
        let pace = Pace { length_scale: 1.0, cadence_scale: 1.0, ..self.pace };
        let pace_changes = self.pace_changes.clone();
        *self == Gait { pace, pace_changes, ..Gait::new(&self.name, Style::Knots) }
    }

    /// Exponent b of step frequency ~ V^b.
    #[must_use]
    pub fn cadence_exponent(&self) -> f64 {
        self.pace.cadence_exponent.unwrap_or(match self.style {
            Style::Knots => ADULT_EXPONENT,
            Style::Paper1997 => EXPONENT_1997,
        })
    }

    /// Dimensionless speed if the pace gives nothing.
    pub(super) const DEFAULT_SPEED: f64 = FREE_SPEED;
}

fn parade_changes() -> Vec<KnotChange> {
    let scaled = |joint: LegJoint, knot: &str, scale: f64| KnotChange { scale, ..KnotChange::of(joint, knot) };
    let knees = ["stance peak", "stance minimum", "swing peak", "terminal minimum"];
    let mut changes: Vec<KnotChange> = knees.iter().map(|knot| scaled(LegJoint::Knee, knot, PARADE_KNEE)).collect();
    changes.push(KnotChange { phase: -PARADE_EARLIER, ..scaled(LegJoint::Hip, "largest flexion", PARADE_HIP) });
    changes
}

fn unknown_gait(name: &str) -> GaitError {
    let hint = match nearest(name, Gait::NAMES.into_iter()) {
        Some(near) => format!(". hint: did you mean `{near}`?"),
        None => String::from(", or a TOML file (docs/GAITS.md)"),
    };
    GaitError::UnknownGait { name: name.to_owned(), known: Gait::NAMES.join(", "), hint }
}
