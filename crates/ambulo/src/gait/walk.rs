//! A gait on a leg: joint angles with velocity and acceleration at any time.
//!
//! All angles come from two numbers, the phase of the right foot and the dimensionless speed, both C² in time while speed
//! changes ([`SpeedChange`]); the left leg is half a cycle behind. Sub-cycles and states are synchronised by construction: their
//! bounds are read at the speed of the moment. Pinned by: tests/gait_walk.rs, tests/gait_speed.rs.

use super::arms::ArmCurves;
use super::curve_check::check;
use super::cyclic_curve::{CyclicCurve, Knot};
use super::error::GaitError;
use super::jet::Jet;
use super::joint::{Joint, STANDING_TILT};
use super::laws::{Laws, LegCurves, checked_speeds};
use super::request::{Gait, KnotChange, Pace, Pelvis, Speed};
use super::speed_plan::{Clock, SpeedChange, SpeedPlan};
use super::stride::{StrideLaw, walking_speeds};
use super::style::Style;
use crate::findings::Findings;

/// Leg lengths of people who walk [m].
const LEG_LENGTHS: [f64; 2] = [0.25, 1.5];
/// Relative error within which three numbers still agree that any two of them determine.
const AGREEMENT: f64 = 1e-6;

/// A gait resolved on a leg length.
#[derive(Debug, Clone, PartialEq)]
pub struct Walk {
    plan: SpeedPlan,
    laws: Laws,
    arms: ArmCurves,
    pelvis: Pelvis,
    style: Style,
    name: String,
}

/// Angles of one leg [rad].
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct LegAngles {
    /// Flexion of the thigh against the pelvis.
    pub hip: Jet,
    /// Flexion.
    pub knee: Jet,
    /// Dorsiflexion.
    pub ankle: Jet,
}

/// All angles at one instant, clinical signs [rad].
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct WalkPosture {
    /// Right leg.
    pub right: LegAngles,
    /// Left leg.
    pub left: LegAngles,
    /// Anterior tilt of the pelvis.
    pub pelvis_tilt: Jet,
    /// Tilt of the pelvis in upright standing, against which a model's pelvis counts; 0 where the pelvis is held vertical.
    pub standing_tilt: f64,
    /// Forward lean of the trunk against the vertical.
    pub trunk_lean: Jet,
    /// Flexion of right and left shoulder.
    pub shoulders: [Jet; 2],
    /// Flexion of right and left elbow.
    pub elbows: [Jet; 2],
    /// Where in the cycle the legs are.
    pub phases: Phases,
}

/// Where in their cycles the legs are.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Phases {
    /// Phase of right and left foot since contact, 0 to 1.
    pub cycle: [f64; 2],
    /// Whether the right and the left foot stand.
    pub stance: [bool; 2],
    /// Foot off as a share of the cycle, at the speed of the moment.
    pub foot_off: f64,
}

impl Walk {
    /// A gait on a leg, hip to floor [m], at constant speed.
    ///
    /// # Errors
    /// Numbers that no gait can have, contradictions, curves that joints cannot follow.
    pub fn new(gait: &Gait, leg_length: f64, findings: &mut Findings) -> Result<Walk, GaitError> {
        let (law, law_speed) = resolve(gait, leg_length)?;
        let mut laws = Laws::built_in(gait.style)?;
        for (joint, own) in Joint::ALL.into_iter().zip(&gait.curves) {
            if let Some(curve) = own {
                *laws.legs.of_mut(joint) = curve.clone();
            }
            let curve = changed(laws.legs.of(joint), joint, &gait.changes)?;
            *laws.legs.of_mut(joint) = scaled(&curve, joint, law.length_scale, gait.step_height);
            refuse_faults(laws.legs.of(joint), joint, gait.style, &laws)?;
        }
        report_range(law.speed(law_speed), leg_length, findings);
        let plan = SpeedPlan::constant(law, law_speed);
        let (pelvis, style, name) = (gait.pelvis, gait.style, gait.name.clone());
        Ok(Walk { plan, laws, arms: ArmCurves::new(), pelvis, style, name })
    }

    /// The same walk with one more change of speed, after all others.
    ///
    /// # Errors
    /// A speed that is not above zero, a duration that is not, a start before the end of the change before.
    pub fn with_speed_change(mut self, change: SpeedChange, findings: &mut Findings) -> Result<Walk, GaitError> {
        above_zero("speed after a change [m/s]", change.speed)?;
        above_zero("duration of a change of speed [s]", change.duration_s)?;
        let finite = "a time, zero or more";
        if !(change.start_s >= 0.0 && change.start_s.is_finite()) {
            return Err(number("start of a change of speed [s]", change.start_s, finite));
        }
        if let Some(earliest_s) = self.plan.end_s().filter(|end| change.start_s < *end) {
            return Err(GaitError::OverlappingChange { start_s: change.start_s, earliest_s });
        }
        report_range(change.speed, self.leg_length(), findings);
        self.plan.add(change.start_s, change.duration_s, self.plan.law().law_speed(change.speed));
        Ok(self)
    }

    /// Name of the gait.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Style of the gait.
    #[must_use]
    pub fn style(&self) -> Style {
        self.style
    }

    /// Leg length, hip to floor [m].
    #[must_use]
    pub fn leg_length(&self) -> f64 {
        self.plan.law().leg_length
    }

    /// How steps and frequency share speed.
    #[must_use]
    pub fn stride(&self) -> &StrideLaw {
        self.plan.law()
    }

    /// The laws of this walk, changed and scaled as the gait asks.
    #[must_use]
    pub fn laws(&self) -> &Laws {
        &self.laws
    }

    /// The curves of a leg.
    #[must_use]
    pub fn legs(&self) -> &LegCurves {
        &self.laws.legs
    }

    /// The curves of an arm.
    #[must_use]
    pub fn arms(&self) -> &ArmCurves {
        &self.arms
    }

    /// Walking speed at the start [m/s].
    #[must_use]
    pub fn speed(&self) -> f64 {
        self.speed_at(0.0)
    }

    /// Walking speed [m/s].
    #[must_use]
    pub fn speed_at(&self, time_s: f64) -> f64 {
        self.plan.law().speed(self.plan.at(time_s).law_speed.value)
    }

    /// V/√(gL) at the start.
    #[must_use]
    pub fn dimensionless_speed(&self) -> f64 {
        self.speed() / self.plan.law().unit_speed()
    }

    /// Duration of a cycle at the start [s].
    #[must_use]
    pub fn cycle_s(&self) -> f64 {
        1.0 / self.plan.at(0.0).phase.rate
    }

    /// Step length at the start [m].
    #[must_use]
    pub fn step_length(&self) -> f64 {
        self.plan.law().step_length(self.plan.at(0.0).law_speed.value)
    }

    /// Phase and law speed at a time [s]; phase 0 is the right foot's contact.
    #[must_use]
    pub fn clock(&self, time_s: f64) -> Clock {
        self.plan.at(time_s)
    }

    /// The speed at which curves are read: the law speed, held where the data end.
    #[must_use]
    pub fn curve_speed(&self, clock: &Clock) -> Jet {
        self.laws.range.held(clock.law_speed)
    }

    /// All angles at a time [s].
    #[must_use]
    pub fn at(&self, time_s: f64) -> WalkPosture {
        self.posture(&self.plan.at(time_s))
    }

    /// All angles at a phase and law speed.
    #[must_use]
    pub fn posture(&self, clock: &Clock) -> WalkPosture {
        let speed = self.curve_speed(clock);
        let phases = [clock.phase, clock.phase + 0.5];
        let [right, left] = phases.map(|phase| self.leg(phase, speed));
        WalkPosture {
            right,
            left,
            pelvis_tilt: self.pelvis_tilt(clock.phase, speed),
            standing_tilt: self.standing_tilt(),
            trunk_lean: self.trunk_lean(clock.phase, speed),
            shoulders: phases.map(|phase| ArmCurves::shoulder(phase, speed)),
            elbows: phases.map(|phase| self.arms.elbow().at(phase, speed)),
            phases: self.phases(clock),
        }
    }

    fn leg(&self, phase: Jet, speed: Jet) -> LegAngles {
        let legs = &self.laws.legs;
        LegAngles {
            hip: legs.hip.at(phase, speed) - self.hip_offset(speed),
            knee: legs.knee.at(phase, speed),
            ankle: legs.ankle.at(phase, speed),
        }
    }

    /// What is taken from the hip's curve because the pelvis is held vertical.
    #[must_use]
    pub fn hip_offset(&self, speed: Jet) -> Jet {
        match self.pelvis {
            Pelvis::Moving => Jet::ZERO,
            Pelvis::Vertical => self.laws.pelvis_tilt.mean.jet(speed),
        }
    }

    /// Anterior tilt of the pelvis [rad].
    #[must_use]
    pub fn pelvis_tilt(&self, phase: Jet, speed: Jet) -> Jet {
        match self.pelvis {
            Pelvis::Moving => self.laws.pelvis_tilt.at(phase, speed),
            Pelvis::Vertical => Jet::ZERO,
        }
    }

    /// Forward lean of the trunk [rad].
    #[must_use]
    pub fn trunk_lean(&self, phase: Jet, speed: Jet) -> Jet {
        match self.pelvis {
            Pelvis::Moving => self.laws.trunk_lean.at(phase, speed),
            Pelvis::Vertical => Jet::ZERO,
        }
    }

    fn standing_tilt(&self) -> f64 {
        match self.pelvis {
            Pelvis::Moving => STANDING_TILT,
            Pelvis::Vertical => 0.0,
        }
    }

    /// Where in their cycles the legs are.
    #[must_use]
    pub fn phases(&self, clock: &Clock) -> Phases {
        let foot_off = self.foot_off(clock);
        let cycle = [clock.phase.value, clock.phase.value + 0.5].map(|phase| phase - phase.floor());
        Phases { cycle, stance: cycle.map(|phase| phase < foot_off), foot_off }
    }

    /// Foot off as a share of the cycle: support duration is linear in cycle duration.
    #[must_use]
    pub fn foot_off(&self, clock: &Clock) -> f64 {
        self.laws.support.share(1.0 / (clock.phase.rate * self.plan.law().leg_time()))
    }
}

/// Speed, step length and frequency of a gait on a leg, and the law speed.
fn resolve(gait: &Gait, leg_length: f64) -> Result<(StrideLaw, f64), GaitError> {
    if !(LEG_LENGTHS[0]..=LEG_LENGTHS[1]).contains(&leg_length) {
        return Err(number("leg length [m]", leg_length, "0.25 m to 1.5 m"));
    }
    let exponent = gait.cadence_exponent();
    if !(0.0..1.0).contains(&exponent) {
        return Err(number("cadence exponent", exponent, "a share of speed from 0 to below 1"));
    }
    let pace = &gait.pace;
    for (what, factor) in [
        ("factor on the step length", pace.length_scale),
        ("factor on the step frequency", pace.cadence_scale),
        ("factor on the step height", gait.step_height),
    ] {
        above_zero(what, factor)?;
    }
    let preferred = StrideLaw { leg_length, exponent, length_scale: 1.0, cadence_scale: 1.0 };
    let (law_speed, length, cadence) = share(pace, gait.style, &preferred)?;
    let length_scale = length * pace.length_scale;
    let cadence_scale = cadence * pace.cadence_scale;
    Ok((StrideLaw { length_scale, cadence_scale, ..preferred }, law_speed))
}

/// Law speed, and step length and frequency against the preferred ones there.
fn share(pace: &Pace, style: Style, preferred: &StrideLaw) -> Result<(f64, f64, f64), GaitError> {
    let speed = match pace.speed {
        Some(Speed::MetersPerSecond(speed)) => Some(above_zero("speed [m/s]", speed)?),
        Some(Speed::Dimensionless(speed)) => Some(above_zero("dimensionless speed", speed)? * preferred.unit_speed()),
        None => None,
    };
    let step = pace.step_length.map(|length| above_zero("step length [m]", length)).transpose()?;
    let frequency = pace.step_frequency.map(|rate| above_zero("step frequency [steps/s]", rate)).transpose()?;
    let frequency_at = |law_speed: f64| 2.0 * preferred.cycle_rate(Jet::constant(law_speed)).value;
    let (step, frequency) = match (speed, step, frequency) {
        (None, None, None) => return Ok((Gait::DEFAULT_SPEED, 1.0, 1.0)),
        (Some(speed), None, None) => return Ok((preferred.law_speed(speed), 1.0, 1.0)),
        (None, Some(step), None) => return Ok((preferred.law_speed_of_step(step), 1.0, 1.0)),
        (None, None, Some(frequency)) => {
            let expected = "above 0 if step frequency alone is given, or a speed beside it";
            let law_speed = preferred.law_speed_of_frequency(frequency);
            return Ok((law_speed.ok_or(number("cadence exponent", preferred.exponent, expected))?, 1.0, 1.0));
        }
        // A change of frequency leaves the angles alone: in the paper's style they follow the step.
        (None, Some(step), Some(frequency)) if style == Style::Paper1997 => {
            let law_speed = preferred.law_speed_of_step(step);
            return Ok((law_speed, 1.0, frequency / frequency_at(law_speed)));
        }
        (None, Some(step), Some(frequency)) => (step, frequency),
        (Some(speed), Some(step), None) => (step, speed / step),
        (Some(speed), None, Some(frequency)) => (speed / frequency, frequency),
        (Some(speed), Some(step), Some(frequency)) => agreed(speed, step, frequency)?,
    };
    let law_speed = preferred.law_speed(step * frequency);
    Ok((law_speed, step / preferred.step_length(law_speed), frequency / frequency_at(law_speed)))
}

/// Step length and frequency of all three, which must agree.
fn agreed(speed: f64, step_length: f64, step_frequency: f64) -> Result<(f64, f64), GaitError> {
    if (step_length * step_frequency - speed).abs() > AGREEMENT * speed {
        return Err(GaitError::Contradiction { speed, step_length, step_frequency });
    }
    Ok((step_length, step_frequency))
}

fn changed(curve: &CyclicCurve, joint: Joint, changes: &[KnotChange]) -> Result<CyclicCurve, GaitError> {
    let mut curve = curve.clone();
    for change in changes.iter().filter(|change| change.joint == joint) {
        if !curve.knots().iter().any(|knot| knot.name == change.knot) {
            let known: Vec<&str> = curve.knots().iter().map(|knot| knot.name.as_str()).collect();
            let (knot, known) = (change.knot.clone(), known.join(", "));
            return Err(GaitError::UnknownKnot { joint: joint.name(), knot, known });
        }
        curve = curve.mapped(|knot| if knot.name == change.knot { moved(knot, change) } else { knot.clone() });
    }
    Ok(curve)
}

fn moved(knot: &Knot, change: &KnotChange) -> Knot {
    let scaled = knot.scaled_about(change.joint.neutral(), change.scale);
    Knot {
        phase: scaled.phase.plus(change.phase),
        angle: scaled.angle.plus(change.angle),
        slope: scaled.slope.plus(change.slope),
        curvature: scaled.curvature.plus(change.curvature),
        ..scaled
    }
}

/// Step length scales every local state alike, step height each by its share.
fn scaled(curve: &CyclicCurve, joint: Joint, length: f64, height: f64) -> CyclicCurve {
    curve.mapped(|knot| {
        let factor = length * (1.0 + knot.height_share * (height - 1.0));
        knot.scaled_about(joint.neutral(), factor)
    })
}

fn refuse_faults(curve: &CyclicCurve, joint: Joint, style: Style, laws: &Laws) -> Result<(), GaitError> {
    check(curve, joint, style, &checked_speeds(&laws.range)).map_err(|fault| GaitError::Curve {
        joint: joint.name(),
        knot: curve.knots()[fault.knot].name.clone(),
        message: fault.message,
    })
}

fn report_range(speed: f64, leg_length: f64, findings: &mut Findings) {
    let [slowest, fastest] = walking_speeds(leg_length);
    if !(slowest..=fastest).contains(&speed) {
        findings.warn(
            "gait.speed_range",
            format!(
                "a speed of {speed:.2} m/s is outside walking on a leg of {leg_length:.2} m, {slowest:.2} to {fastest:.2} m/s; the \
                 joint curves are those of the nearest speed of the data"
            ),
        );
    }
}

fn above_zero(what: &'static str, value: f64) -> Result<f64, GaitError> {
    if value > 0.0 && value.is_finite() { Ok(value) } else { Err(number(what, value, "a number above zero")) }
}

fn number(what: &'static str, found: f64, expected: &'static str) -> GaitError {
    GaitError::Number { what, found, expected }
}
