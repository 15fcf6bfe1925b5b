//! A gait for a leg length: joint angles with velocity and acceleration at any time.
//!
//! All angles are functions of two numbers, the phase of the right foot and the dimensionless speed. Both are C² in time while the speed
//! changes ([`SpeedChange`]). The left leg is half a cycle behind. Sub-cycles and states remain synchronised because their bounds are
//! evaluated at the current speed. Pinned by: tests/gait_walk.rs, tests/gait_speed.rs.

use super::arms::ArmCurves;
use super::curve_check::check;
use super::cyclic_curve::{CyclicCurve, Knot};
use super::error::GaitError;
use super::gait_settings::{Gait, KnotChange, Pelvis, Style};
use super::jet::Jet;
use super::joint::{LegJoint, STANDING_TILT};
use super::laws::{Laws, LegCurves, checked_speeds};
use super::pace::{above_zero, check_steps, number, resolve};
use super::speed_plan::{Clock, SpeedChange, SpeedPlan};
use super::stride::{StrideLaw, walking_speeds};
use crate::findings::{Code, Findings};
use crate::model::BySide;

/// A gait for a leg length.
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
    /// Flexion of the thigh relative to the pelvis.
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
    /// Tilt of the pelvis in upright standing, the zero of a model's pelvis; 0 if the pelvis is held vertical.
    pub standing_tilt: f64,
    /// Forward lean of the trunk from the vertical.
    pub trunk_lean: Jet,
    /// Flexion of right and left shoulder.
    pub shoulders: [Jet; 2],
    /// Flexion of right and left elbow.
    pub elbows: [Jet; 2],
    /// Phases of the legs.
    pub phases: Phases,
}

/// Phases of both legs.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Phases {
    /// Phase of each foot since foot strike, 0 to 1.
    pub cycle: BySide<f64>,
    /// Whether the foot is in stance.
    pub stance: BySide<bool>,
    /// Foot off as a share of the cycle, at the current speed.
    pub foot_off: f64,
}

impl Walk {
    /// A gait for a leg length, hip to floor [m], at constant speed.
    ///
    /// # Errors
    /// Numbers that are not possible, contradictions, curves outside of the range of a joint.
    pub fn new(gait: &Gait, leg_length: f64, findings: &mut Findings) -> Result<Walk, GaitError> {
        let (law, law_speed) = resolve(gait, leg_length)?;
        let mut laws = Laws::built_in(gait.style)?;
        for (joint, own) in LegJoint::ALL.into_iter().zip(&gait.curves) {
            if let Some(curve) = own {
                *laws.legs.of_mut(joint) = curve.clone();
            }
            let curve = changed(laws.legs.of(joint), joint, &gait.changes)?;
            *laws.legs.of_mut(joint) = scaled(&curve, joint, law.length_scale, gait.step_height);
            refuse_faults(laws.legs.of(joint), joint, &laws)?;
        }
        report_range(law.speed(law_speed), leg_length, findings);
        let plan = SpeedPlan::constant(law, law_speed);
        let (pelvis, style, name) = (gait.pelvis, gait.style, gait.name.clone());
        Ok(Walk { plan, laws, arms: ArmCurves::new(), pelvis, style, name })
    }

    /// The same walk with another change of speed, after all others.
    ///
    /// # Errors
    /// A speed outside of the range of walking, a duration that is not above zero, or a start before the end of the previous change.
    pub fn with_speed_change(mut self, change: SpeedChange, findings: &mut Findings) -> Result<Walk, GaitError> {
        above_zero("speed after a change [m/s]", change.speed)?;
        above_zero("duration of a change of speed [s]", change.duration_s)?;
        let finite = "a time of zero or more";
        if !(change.start_s >= 0.0 && change.start_s.is_finite()) {
            return Err(number("start of a change of speed [s]", change.start_s, finite));
        }
        if let Some(earliest_s) = self.plan.end_s().filter(|end| change.start_s < *end) {
            return Err(GaitError::OverlappingChange { start_s: change.start_s, earliest_s });
        }
        let law_speed = self.plan.law().law_speed(change.speed);
        check_steps(self.plan.law(), law_speed)?;
        report_range(change.speed, self.leg_length(), findings);
        self.plan.add(change.start_s, change.duration_s, law_speed);
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

    /// The law of step length and step frequency.
    #[must_use]
    pub fn stride(&self) -> &StrideLaw {
        self.plan.law()
    }

    /// The laws of this walk, with the changes and scaling of the gait.
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

    /// Phase and law speed at a time [s]; phase 0 is the foot strike of the right foot.
    #[must_use]
    pub fn clock(&self, time_s: f64) -> Clock {
        self.plan.at(time_s)
    }

    /// The speed at which curves are evaluated: the law speed, limited to the range of the data.
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

    /// The angle [rad] that is subtracted from the curve of the hip because the pelvis is held vertical.
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

    /// Tilt of the pelvis in upright standing [rad]; 0 if the pelvis is held vertical.
    #[must_use]
    pub fn standing_tilt(&self) -> f64 {
        match self.pelvis {
            Pelvis::Moving => STANDING_TILT,
            Pelvis::Vertical => 0.0,
        }
    }

    /// Phases of the legs.
    #[must_use]
    pub fn phases(&self, clock: &Clock) -> Phases {
        let foot_off = self.foot_off(clock);
        let cycle =
            BySide { right: clock.phase.value, left: clock.phase.value + 0.5 }.map(|phase| phase - phase.floor());
        Phases { cycle, stance: cycle.map(|phase| phase < foot_off), foot_off }
    }

    /// Foot off as a share of the cycle: the duration of stance is linear in the duration of the cycle.
    #[must_use]
    pub fn foot_off(&self, clock: &Clock) -> f64 {
        self.laws.support.share(1.0 / (clock.phase.rate * self.plan.law().leg_time()))
    }
}

/// A curve with the changes for its joint.
pub(super) fn changed(curve: &CyclicCurve, joint: LegJoint, changes: &[KnotChange]) -> Result<CyclicCurve, GaitError> {
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

/// Scales a curve: step length acts on all knots alike, step height according to the share of each knot.
fn scaled(curve: &CyclicCurve, joint: LegJoint, length: f64, height: f64) -> CyclicCurve {
    curve.mapped(|knot| {
        let factor = length * (1.0 + knot.height_share * (height - 1.0));
        knot.scaled_about(joint.neutral(), factor)
    })
}

fn refuse_faults(curve: &CyclicCurve, joint: LegJoint, laws: &Laws) -> Result<(), GaitError> {
    check(curve, joint, &checked_speeds(&laws.range)).map_err(|fault| GaitError::Curve {
        joint: joint.name(),
        knot: curve.knots()[fault.knot].name.clone(),
        message: fault.message,
    })
}

fn report_range(speed: f64, leg_length: f64, findings: &mut Findings) {
    let [slowest, fastest] = walking_speeds(leg_length);
    if !(slowest..=fastest).contains(&speed) {
        findings.report(
            Code::GaitSpeedRange,
            format!(
                "a speed of {speed:.2} m/s is outside walking on a leg of {leg_length:.2} m, {slowest:.2} to {fastest:.2} m/s; the \
                 joint curves are those of the nearest speed of the data"
            ),
        );
    }
}
