//! A gait for a leg length: joint angles with velocity and acceleration at any time.
//!
//! All angles are functions of the phase of the right foot and the pace. Both are C² in time while the pace changes
//! ([`PaceChange`]). The left leg is half a cycle behind. Sub-cycles and states remain synchronised because their
//! bounds are evaluated at the current speed. Between walking and standing, every angle is
//!
//! ```text
//! angle = standing + w (walking - standing),    leg joints in walking = neutral + l (curve - neutral)
//! ```
//!
//! with the share of walking w and the relative step length l of the [`Clock`]. Pinned by: tests/gait_walk.rs,
//! tests/gait_speed.rs.

use super::arms;
use super::curve_check::check;
use super::cyclic_curve::{CyclicCurve, Knot};
use super::error::GaitError;
use super::gait_settings::{Gait, JointChange, KnotChange, Pace, Pelvis, Speed, Style};
use super::jet::Jet;
use super::joint::{LegJoint, STANDING_TILT, WalkPart};
use super::laws::{Laws, LegCurves, checked_speeds};
use super::machine::{Driven, MachineSettings};
use super::pace::{number, resolve};
use super::pace_plan::{Clock, PaceChange, PacePlan, SteadyPace, whole_cycles};
use super::stride::{StrideLaw, walking_speeds};
use crate::findings::{Code, Findings};
use crate::model::{BySide, Side};

/// Latest start and longest duration of a change of pace [s].
const LATEST_CHANGE_S: f64 = 300.0;
/// Instants of a cycle at which changed joints are checked.
const CHECKED_PHASES: u32 = 100;
/// Shortest duration of a change of pace [s].
const SHORTEST_CHANGE_S: f64 = 0.1;

/// A gait for a leg length.
#[derive(Debug, Clone, PartialEq)]
pub struct Walk {
    plan: PacePlan,
    laws: Laws,
    elbow: CyclicCurve,
    /// Settings of the walk.
    gait: Gait,
    /// Time at which the machines of the gait begin [s].
    machines_begin_s: f64,
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
    /// A gait for a leg length, hip to floor [m], with the gait's changes of pace.
    ///
    /// # Errors
    /// Numbers that are not possible, contradictions, curves outside of the range of a joint, changes of pace that
    /// overlap.
    pub fn new(gait: &Gait, leg_length: f64, findings: &mut Findings) -> Result<Walk, GaitError> {
        let stands = gait.pace.speed == Some(Speed::MetersPerSecond(0.0));
        let (law, law_speed) = at_pace(gait, &gait.pace_at_start()?, leg_length)?;
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
        let initial = SteadyPace { walks: !stands, ..relative_pace((law, law_speed), &law) };
        let plan = PacePlan::constant(law, initial, 0.0);
        let mut walk = Walk { plan, laws, elbow: arms::elbow(), gait: gait.clone(), machines_begin_s: 0.0 };
        if stands {
            // The right leg swings first.
            let off = walk.foot_off(&walk.clock(0.0));
            walk.plan = PacePlan::constant(law, initial, off);
        }
        for change in &gait.pace_changes {
            walk.add_change(change, findings)?;
        }
        walk.refuse_far_angles()?;
        Ok(walk)
    }

    /// Adds a change of pace after all others.
    pub(super) fn add_change(&mut self, change: &PaceChange, findings: &mut Findings) -> Result<(), GaitError> {
        if !(0.0..=LATEST_CHANGE_S).contains(&change.start_s) {
            let expected = "0 to 300 s, because a walk at constant pace repeats itself";
            return Err(number("start of a change of pace [s]", change.start_s, expected));
        }
        if let Some(earliest_s) = self.plan.end_s().filter(|end| change.start_s < *end) {
            return Err(GaitError::OverlappingChange { start_s: change.start_s, earliest_s });
        }
        let before = self.plan.last();
        let to = if change.is_halt() {
            SteadyPace { walks: false, ..before }
        } else {
            let pace = self.gait.pace.with(change.speed, change.step_length, change.step_frequency);
            let (law, law_speed) = at_pace(&self.gait, &pace, self.leg_length())?;
            let to = relative_pace((law, law_speed), self.plan.law());
            for joint in LegJoint::ALL {
                let curve = self.laws.legs.of(joint);
                let longer = curve.mapped(|knot| knot.scaled_about(joint.neutral(), to.length));
                refuse_faults(&longer, joint, &self.laws)?;
            }
            report_range(law.speed(law_speed), self.leg_length(), findings);
            to
        };
        let paced = if before.walks { before } else { to };
        // The later foot off of the two paces, so that both have single support in the same part of the cycle.
        let off = |pace: SteadyPace| self.foot_off(&self.steady(pace).clock(0.0));
        let foot_off = off(before).max(off(to));
        let duration_s = match change.duration_s {
            Some(duration_s) if (SHORTEST_CHANGE_S..=LATEST_CHANGE_S).contains(&duration_s) => duration_s,
            Some(duration_s) => {
                let expected = "0.1 to 300 s, because a change of pace takes at least a tenth of a second";
                return Err(number("duration of a change of pace [s]", duration_s, expected));
            }
            None if before.walks && !to.walks => self.plan.halt_s(change.start_s, foot_off),
            None if before.walks => 1.0 / self.plan.rate_in_walking(paced),
            None => 2.0 / self.plan.rate_in_walking(paced),
        };
        self.plan.add(change.start_s, duration_s, to, foot_off);
        Ok(())
    }

    /// Whether every cycle is like the others: the pace never changes, and the gait has no machines.
    #[must_use]
    pub(crate) fn is_steady(&self) -> bool {
        self.plan.is_constant() && self.gait.machines.is_empty()
    }

    /// The same walk with another time at which the machines of the gait begin [s]; before it the curves of the gait
    /// are followed.
    #[must_use]
    pub(crate) fn with_machines_from(mut self, begin_s: f64) -> Walk {
        self.machines_begin_s = begin_s;
        self
    }

    /// Time at which the machines of the gait begin [s].
    #[must_use]
    pub(crate) fn machines_begin_s(&self) -> f64 {
        self.machines_begin_s
    }

    /// End of the last change of pace [s].
    #[must_use]
    pub(crate) fn last_change_s(&self) -> Option<f64> {
        self.plan.end_s()
    }

    /// The constant paces before, between and after the changes as gaits without changes, and for each change its start
    /// and duration [s]. While the figure stands, the gait of the change from or to standing.
    #[doc(hidden)]
    #[must_use]
    pub fn pace_ramps(&self) -> Vec<PaceRamp> {
        let ramps = self.plan.ramps();
        ramps
            .map(|(start_s, duration_s, from, to)| PaceRamp {
                start_s,
                duration_s,
                paces: [from, to].map(|pace| self.steady(pace)),
            })
            .collect()
    }

    /// The last change of [`Walk::pace_ramps`] that has begun at a time [s], and how much of it the angles have taken,
    /// 0 to 1; `None` before the first change.
    #[must_use]
    pub(crate) fn change_progress(&self, time_s: f64) -> Option<(usize, Jet)> {
        self.plan.progress(time_s)
    }

    /// This walk at a constant pace, in walking, from a right foot strike.
    fn steady(&self, pace: SteadyPace) -> Walk {
        let plan = PacePlan::constant(*self.plan.law(), SteadyPace { walks: true, ..pace }, 0.0);
        Walk { plan, ..self.clone() }
    }

    /// Name of the gait.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.gait.name
    }

    /// Style of the gait.
    #[must_use]
    pub fn style(&self) -> Style {
        self.gait.style
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

    /// The curve of an elbow.
    #[must_use]
    pub fn elbow(&self) -> &CyclicCurve {
        &self.elbow
    }

    /// Walking speed at the start [m/s].
    #[must_use]
    pub fn speed(&self) -> f64 {
        let pace = self.plan.at(0.0);
        self.plan.law().speed(pace.law_speed.value) * pace.walking.value
    }

    /// Step length × step frequency at a time [m/s].
    #[must_use]
    pub fn speed_at(&self, time_s: f64) -> f64 {
        self.step_length_at(time_s) * 2.0 * self.plan.at(time_s).phase.rate
    }

    /// Step length at a time [m].
    #[must_use]
    pub fn step_length_at(&self, time_s: f64) -> f64 {
        let clock = self.plan.at(time_s);
        self.plan.law().step_length(clock.law_speed.value) * clock.length.value * clock.walking.value
    }

    /// V/√(gL) at the start.
    #[must_use]
    pub fn dimensionless_speed(&self) -> f64 {
        self.speed() / self.plan.law().unit_speed()
    }

    /// Duration of a cycle at the start [s]; if the figure stands at the start, of the first cycles after it.
    #[must_use]
    pub fn cycle_s(&self) -> f64 {
        1.0 / self.plan.rate_in_walking(self.first_pace())
    }

    /// Duration of a cycle after all changes [s]; if the figure then stands, of the last cycles before it.
    #[must_use]
    pub fn last_cycle_s(&self) -> f64 {
        1.0 / self.plan.rate_in_walking(self.plan.last())
    }

    /// The first pace at which the figure walks.
    fn first_pace(&self) -> SteadyPace {
        let first = self.plan.ramps().next().map(|(_, _, from, _)| from);
        first.unwrap_or_else(|| self.plan.last())
    }

    /// Step length at the start [m].
    #[must_use]
    pub fn step_length(&self) -> f64 {
        self.step_length_at(0.0)
    }

    /// Phase and law speed at a time [s]; phase 0 is the foot strike of the right foot.
    #[must_use]
    pub fn clock(&self, time_s: f64) -> Clock {
        self.plan.at(time_s)
    }

    /// The clock of the first pace at which the figure walks, at a foot strike of the right foot.
    pub(super) fn first_clock(&self) -> Clock {
        self.steady(self.first_pace()).clock(0.0)
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

    /// All angles at a phase and pace.
    #[must_use]
    pub fn posture(&self, clock: &Clock) -> WalkPosture {
        let speed = self.curve_speed(clock);
        let legs = Side::BOTH.map(|side| self.leg(side, clock.phase_of(side), speed, clock));
        let of_arms = |part: fn(Side) -> WalkPart| Side::BOTH.map(|side| self.part_angle(part(side), clock));
        WalkPosture {
            right: legs[0],
            left: legs[1],
            pelvis_tilt: self.pelvis_tilt(clock),
            standing_tilt: self.standing_tilt(),
            trunk_lean: self.trunk_lean(clock),
            shoulders: of_arms(WalkPart::Shoulder),
            elbows: of_arms(WalkPart::Elbow),
            phases: self.phases(clock),
        }
    }

    fn leg(&self, side: Side, phase: Jet, speed: Jet, clock: &Clock) -> LegAngles {
        let legs = &self.laws.legs;
        let angle = |joint: LegJoint| self.leg_angle(side, joint, legs.of(joint).at(phase, speed), clock);
        LegAngles { hip: angle(LegJoint::Hip), knee: angle(LegJoint::Knee), ankle: angle(LegJoint::Ankle) }
    }

    /// The angle [rad] of a joint of a leg, from the value of its curve.
    pub(super) fn leg_angle(&self, side: Side, joint: LegJoint, curve: Jet, clock: &Clock) -> Jet {
        let neutral = joint.neutral();
        let long = self.edited(WalkPart::Leg(side, joint), neutral, between(neutral, curve, clock.length));
        match joint {
            LegJoint::Hip => {
                let standing = neutral - STANDING_TILT + self.standing_tilt();
                between(standing, long - self.hip_offset(self.curve_speed(clock)), clock.walking)
            }
            LegJoint::Knee | LegJoint::Ankle => between(neutral, long, clock.walking),
        }
    }

    /// The angle [rad] of a joint of an arm, from the value of its curve; arms hang in standing.
    pub(super) fn arm_angle(&self, part: WalkPart, curve: Jet, clock: &Clock) -> Jet {
        between(0.0, self.edited(part, 0.0, curve), clock.walking)
    }

    /// An angle in walking [rad] with the changes of this joint.
    fn edited(&self, part: WalkPart, neutral: f64, angle: Jet) -> Jet {
        let changes = self.gait.joints.iter().filter(|change| change.part == part);
        changes.fold(angle, |angle, JointChange { scale, angle: offset, .. }| {
            (angle - neutral) * *scale + (neutral + offset)
        })
    }

    /// The angle [rad] of a part at a clock.
    #[must_use]
    pub(crate) fn part_angle(&self, part: WalkPart, clock: &Clock) -> Jet {
        let (phase, speed) = (clock.phase_of(part.side()), self.curve_speed(clock));
        match part {
            WalkPart::Leg(side, joint) => self.leg_angle(side, joint, self.laws.legs.of(joint).at(phase, speed), clock),
            WalkPart::Pelvis => self.pelvis_tilt(clock),
            WalkPart::Trunk => self.trunk_lean(clock),
            WalkPart::Shoulder(_) => self.arm_angle(part, arms::shoulder(phase, speed), clock),
            WalkPart::Elbow(_) => self.arm_angle(part, self.elbow.at(phase, speed), clock),
        }
    }

    /// The angle of a part at a clock, with its distance from upright standing scaled and an offset [rad].
    pub(super) fn altered_angle(&self, part: WalkPart, clock: &Clock, scale: f64, offset: f64) -> Jet {
        let upright = self.upright_angle(part);
        (self.part_angle(part, clock) - upright) * scale + (upright + offset)
    }

    /// Refuses changes of whole joints, and activities of machines that scale a curve, that no joint can follow at the
    /// first pace.
    fn refuse_far_angles(&self) -> Result<(), GaitError> {
        let changed = self.gait.joints.iter().map(|change| (change.part, 1.0, 0.0));
        let driven = self.gait.machines.iter().flat_map(MachineSettings::altered_curves);
        for (part, scale, offset) in changed.chain(driven) {
            let [low, high] = part.plausible();
            for k in 0..CHECKED_PHASES {
                let phase = Jet::constant(f64::from(k) / f64::from(CHECKED_PHASES));
                let clock = Clock { phase, ..self.first_clock() };
                let angle = self.altered_angle(part, &clock, scale, offset).value;
                if !(low..=high).contains(&angle) {
                    let (joint, allowed_deg) = (part.name(), [low, high].map(f64::to_degrees));
                    return Err(GaitError::JointAngle { joint, found_deg: angle.to_degrees(), allowed_deg });
                }
            }
        }
        Ok(())
    }

    /// The angle of a part in upright standing [rad].
    #[must_use]
    pub(crate) fn upright_angle(&self, part: WalkPart) -> f64 {
        match part {
            WalkPart::Leg(_, LegJoint::Hip) => LegJoint::Hip.neutral() - STANDING_TILT + self.standing_tilt(),
            WalkPart::Pelvis => self.standing_tilt(),
            _ => 0.0,
        }
    }

    /// Whether the figure stands still at some time, or a machine may halt it.
    pub(super) fn may_stand(&self) -> bool {
        !self.plan.is_constant() || self.gait.machines.iter().any(|machine| machine.drives == Driven::Pace)
    }

    /// Whether left and right do the same half a cycle apart, without machines or changes of single joints that make
    /// them differ.
    #[must_use]
    pub fn is_symmetric(&self) -> bool {
        self.gait.is_symmetric()
    }

    /// The gait of the walk.
    #[must_use]
    pub fn gait(&self) -> &Gait {
        &self.gait
    }

    /// The angle [rad] that is subtracted from the curve of the hip because the pelvis is held vertical.
    #[must_use]
    pub fn hip_offset(&self, speed: Jet) -> Jet {
        match self.gait.pelvis {
            Pelvis::Moving => Jet::ZERO,
            Pelvis::Vertical => self.laws.pelvis_tilt.mean.jet(speed),
        }
    }

    /// Anterior tilt of the pelvis [rad].
    #[must_use]
    pub fn pelvis_tilt(&self, clock: &Clock) -> Jet {
        match self.gait.pelvis {
            Pelvis::Moving => {
                let tilt = self.laws.pelvis_tilt.at(clock.phase, self.curve_speed(clock));
                between(STANDING_TILT, self.edited(WalkPart::Pelvis, STANDING_TILT, tilt), clock.walking)
            }
            Pelvis::Vertical => Jet::ZERO,
        }
    }

    /// Forward lean of the trunk [rad].
    #[must_use]
    pub fn trunk_lean(&self, clock: &Clock) -> Jet {
        match self.gait.pelvis {
            Pelvis::Moving => {
                let lean = self.laws.trunk_lean.at(clock.phase, self.curve_speed(clock));
                between(0.0, self.edited(WalkPart::Trunk, 0.0, lean), clock.walking)
            }
            Pelvis::Vertical => Jet::ZERO,
        }
    }

    /// Tilt of the pelvis in upright standing [rad]; 0 if the pelvis is held vertical.
    #[must_use]
    pub fn standing_tilt(&self) -> f64 {
        match self.gait.pelvis {
            Pelvis::Moving => STANDING_TILT,
            Pelvis::Vertical => 0.0,
        }
    }

    /// Phases of the legs.
    #[must_use]
    pub fn phases(&self, clock: &Clock) -> Phases {
        let foot_off = self.foot_off(clock);
        let cycle =
            BySide { right: clock.phase.value, left: clock.phase.value + 0.5 }.map(|phase| phase - whole_cycles(phase));
        Phases { cycle, stance: cycle.map(|phase| clock.stands() || phase < foot_off), foot_off }
    }

    /// Foot off as a share of the cycle: the duration of stance is linear in the duration of the cycle.
    #[must_use]
    pub fn foot_off(&self, clock: &Clock) -> f64 {
        let rate = self.plan.cycle_rate(clock.law_speed).value * clock.cadence.value;
        self.laws.support.share(1.0 / (rate * self.plan.law().leg_time()))
    }
}

/// A change of pace, for those who need the walks before and after it.
#[derive(Debug, Clone, PartialEq)]
pub struct PaceRamp {
    /// Start [s].
    pub start_s: f64,
    /// Duration [s].
    pub duration_s: f64,
    /// The walk at the pace before and at the pace after the change. Where the figure stands, the pace on the other
    /// side of the change.
    pub paces: [Walk; 2],
}

/// standing + share (walking - standing), exactly the angle of walking where the share is 1.
fn between(standing: f64, walking: Jet, share: Jet) -> Jet {
    if share == Jet::constant(1.0) { walking } else { (walking - standing) * share + standing }
}

/// A pace of a gait in walking: the law of steps on this leg [m], and the speed at which it is evaluated.
fn at_pace(gait: &Gait, pace: &Pace, leg_length: f64) -> Result<(StrideLaw, f64), GaitError> {
    resolve(&Gait { pace: *pace, ..gait.clone() }, leg_length)
}

/// The pace of a law at a speed, relative to the first law of a walk.
fn relative_pace((law, law_speed): (StrideLaw, f64), first: &StrideLaw) -> SteadyPace {
    SteadyPace {
        law_speed,
        length: law.length_scale / first.length_scale,
        cadence: law.cadence_scale / first.cadence_scale,
        walks: true,
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
                "a speed of {speed:.2} m/s is outside walking on a leg of {leg_length:.2} m, {slowest:.2} to \
                 {fastest:.2} m/s; the \
                 joint curves are those of the nearest speed of the data"
            ),
        );
    }
}
