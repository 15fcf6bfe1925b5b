//! What a gait is asked to be: style, pace, posture of the trunk, changes of the curves.

use super::error::GaitError;
use super::joint::Joint;
use super::stride::{ADULT_EXPONENT, EXPONENT_1997};
use super::style::Style;
use crate::gait::CyclicCurve;

/// A gait as asked for; [`Walk::new`](super::Walk::new) resolves it on a leg.
#[derive(Debug, Clone, PartialEq)]
pub struct Gait {
    /// Name.
    pub name: String,
    /// How curves run between their knots.
    pub style: Style,
    /// How fast, with which steps.
    pub pace: Pace,
    /// What step height is of the natural one; scales what lifts the swinging foot.
    pub step_height: f64,
    /// Whether pelvis and trunk move.
    pub pelvis: Pelvis,
    /// Changes of single knots, in order.
    pub changes: Vec<KnotChange>,
    /// Curves of its own, for the joints hip, knee and ankle; where there is none, those of the style.
    pub curves: [Option<CyclicCurve>; 3],
}

/// Speed, step length and frequency, as far as they are asked for. With V = step length × frequency two of them give the third;
/// one alone leaves the rest to the cadence exponent; none is free walking.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pace {
    /// Walking speed.
    pub speed: Option<Speed>,
    /// Step length [m], contact of one foot to contact of the other.
    pub step_length: Option<f64>,
    /// Step frequency [steps/s].
    pub step_frequency: Option<f64>,
    /// Share of speed that frequency takes when speed changes; `None`: the style's own.
    pub cadence_exponent: Option<f64>,
    /// Factor on the step length that the rest gives; scales the angles, and speed with them.
    pub length_scale: f64,
    /// Factor on the frequency that the rest gives; leaves the angles alone, and scales speed.
    pub cadence_scale: f64,
}

/// A walking speed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Speed {
    /// In m/s.
    MetersPerSecond(f64),
    /// V/√(gL).
    Dimensionless(f64),
}

/// What pelvis and trunk do.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Pelvis {
    /// The pelvis tilts and the trunk leans as in people; hips are measured against the pelvis.
    Moving,
    /// Pelvis and trunk are held upright; hips are measured against the vertical: less the mean tilt at that speed.
    Vertical,
}

/// A change of one knot, both legs alike: angle, slope and curvature are scaled about upright standing, then added to.
#[derive(Debug, Clone, PartialEq)]
pub struct KnotChange {
    /// Joint.
    pub joint: Joint,
    /// Name of the knot; in style 1997 the bound at which a sub-cycle ends.
    pub knot: String,
    /// Factor on angle (what goes beyond standing), slope and curvature.
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
    /// No change yet.
    #[must_use]
    pub fn of(joint: Joint, knot: &str) -> KnotChange {
        KnotChange { joint, knot: knot.to_owned(), scale: 1.0, angle: 0.0, slope: 0.0, curvature: 0.0, phase: 0.0 }
    }
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

/// V* of free walking.
const FREE_SPEED: f64 = 0.429;
/// V* of the paper's slow and fast walkers: the data's own slow and fast.
const SLOW_SPEED: f64 = 0.290;
const FAST_SPEED: f64 = 0.560;
/// Speed and period of the paper's standard walk (section 4.2: "an average velocity of 1.5 m/s"; 4.1: "one second").
const STANDARD_SPEED: f64 = 1.5;
const STANDARD_PERIOD_S: f64 = 1.0;
/// Periods of the paper's other gaits (section 4.5).
const SHORT_PERIOD_S: f64 = 0.62;
const GOOSE_PERIOD_S: f64 = 0.82;
/// Long steps: the paper gives no length. A fifth longer than standard, 0.90 m: near the longest step at which the linear laws keep
/// every joint inside what people show at their fastest (hip 45°, knee 62°).
const LONG_STEP: f64 = 1.2;
/// Goose step: the paper gives no angles. Nearly stiff knees (a fifth of their flexion) and hips that swing 1.6 times as high; the
/// highest point comes 8 % of the cycle earlier, so that the leg is not thrown down faster than up (100 and 80 rad/s² at the hip).
const GOOSE_KNEE: f64 = 0.2;
const GOOSE_HIP: f64 = 1.6;
const GOOSE_EARLIER: f64 = 0.08;

impl Gait {
    /// Names of the built-in gaits.
    pub const NAMES: [&'static str; 7] = ["standard", "long", "short", "goose", "slow", "free", "fast"];

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
            // The paper gives no length: at the standard's mean speed, steps are shorter as the period is.
            "short" => Ok(paced(SHORT_PERIOD_S / STANDARD_PERIOD_S, SHORT_PERIOD_S)),
            "goose" => Ok(Gait { changes: goose_changes(), ..paced(1.0, GOOSE_PERIOD_S) }),
            _ => Err(GaitError::unknown(name)),
        }
    }

    /// Free walking in a style, with nothing else asked for.
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
        }
    }

    /// The same gait in another style, on the pelvis that goes with it.
    #[must_use]
    pub fn in_style(self, style: Style) -> Gait {
        Gait { style, pelvis: style.pelvis(), ..self }
    }

    /// Share of speed that frequency takes.
    #[must_use]
    pub fn cadence_exponent(&self) -> f64 {
        self.pace.cadence_exponent.unwrap_or(match self.style {
            Style::Knots => ADULT_EXPONENT,
            Style::Paper1997 => EXPONENT_1997,
        })
    }

    /// Dimensionless speed of a pace that asks for nothing.
    pub(super) const DEFAULT_SPEED: f64 = FREE_SPEED;
}

fn goose_changes() -> Vec<KnotChange> {
    let scaled = |joint: Joint, knot: &str, scale: f64| KnotChange { scale, ..KnotChange::of(joint, knot) };
    let knees = ["stance peak", "stance minimum", "swing peak", "terminal minimum"];
    let mut changes: Vec<KnotChange> = knees.iter().map(|knot| scaled(Joint::Knee, knot, GOOSE_KNEE)).collect();
    changes.push(KnotChange { phase: -GOOSE_EARLIER, ..scaled(Joint::Hip, "largest flexion", GOOSE_HIP) });
    changes
}
