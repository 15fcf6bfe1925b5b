//! Targets of a walk at some instants: normative curves, and targets of the machines of its gait.
//!
//! Where the pace changes, targets follow the clock of the walk ([`Clock`]). With w the share of walking between
//! standing (0) and walking (1), a foot carries w f + (1 - w) s body weights. Here f is the normative force of walking,
//! and s is the share of the foot in the load of both: the normative share while the figure moves, and one half where
//! it almost stands.

use crate::gait::machine::WalkMachine;
use crate::gait::{
    Clock, GroundForceLaws, Jet, JointMomentLaws, JointMoments, OtherPlaneLaws, Walk, WalkCoordinates, WalkPosture,
};
use crate::model::anthropometry::Human;
use crate::model::{Model, Movement, Side};
use crate::toml_reader::TomlError;

/// Clearance is required from the first share of the cycle after foot off until the second share before the next foot
/// strike: heel, ball, toes.
const SWING_MARGINS: [[f64; 2]; 3] = [[0.03, 0.025], [0.03, 0.04], [0.03, 0.04]];
/// Smallest height of a swinging sole while the figure walks [m]. It is less with the square of the share of walking,
/// as the height to which the gait lifts the sole is.
const CLEARANCE: f64 = 0.008;
/// Share of walking below which both feet carry the load of standing.
const STANDS_BELOW: f64 = 0.2;
/// Largest extension of the toes in the first guess [rad].
const TOES_LIMIT: f64 = 0.8;
/// Longest step of machines that remember what was [s].
const MACHINE_STEP_S: f64 = 2e-3;

/// Cycles until machines of a gait file repeat what they do.
const SETTLED_CYCLES: f64 = 4.0;

/// A time at which the right foot strikes and the machines of a walk repeat what they do in every cycle [s].
pub(super) fn settled_s(walk: &Walk) -> f64 {
    if walk.gait().machines.is_empty() { 0.0 } else { SETTLED_CYCLES * walk.cycle_s() }
}

/// Targets at one instant.
#[derive(Debug, Clone)]
pub(super) struct Target {
    /// Coordinates, rates and accelerations. The height is the leg's.
    pub(super) posture: [Vec<f64>; 3],
    /// Ground force of the right and of the left foot: forward, up [body weights].
    pub(super) forces: [[f64; 2]; 2],
    /// Moments at the joints of the right and of the left leg.
    pub(super) moments: [JointMoments; 2],
    /// Extension of the toes, right and left [rad].
    pub(super) toes: [f64; 2],
    /// While heel, ball and toes of the right and of the left foot swing: their smallest height [m], and the share of
    /// [`super::WalkCosts::lift`] that is added to it.
    pub(super) clearance: [[Option<[f64; 2]>; 3]; 2],
}

/// Source of the targets of a walk.
pub(super) struct Targets<'a> {
    human: &'a Human,
    walk: &'a Walk,
    forces: GroundForceLaws,
    planes: OtherPlaneLaws,
    moments: JointMomentLaws,
    coordinates: WalkCoordinates,
    machine: WalkMachine,
    /// Time of the last step of the machine [s].
    stepped_s: Option<f64>,
}

impl<'a> Targets<'a> {
    pub(super) fn new(human: &'a Human, walk: &'a Walk) -> Result<Targets<'a>, TomlError> {
        Ok(Targets {
            human,
            walk,
            forces: GroundForceLaws::built_in()?,
            planes: OtherPlaneLaws::built_in()?,
            moments: JointMomentLaws::built_in()?,
            coordinates: WalkCoordinates::of(&human.model),
            machine: WalkMachine::new(walk),
            stepped_s: None,
        })
    }

    /// Targets at some times [s], in their order.
    pub(super) fn at(&mut self, times_s: &[f64]) -> Vec<Target> {
        times_s.iter().map(|time_s| self.target(*time_s)).collect()
    }

    /// The posture that the machines of the gait plan. Machines of a gait file have a state, so they are stepped from
    /// their beginning on.
    fn asked(&mut self, time_s: f64) -> WalkPosture {
        if !self.walk.gait().machines.is_empty() {
            let from_s = self.stepped_s.unwrap_or_else(|| self.walk.machines_begin_s());
            let steps = ((time_s - from_s) / MACHINE_STEP_S).ceil().max(1.0) as usize;
            for step in 0..steps {
                self.machine.step(from_s + (time_s - from_s) * step as f64 / steps as f64);
            }
            self.stepped_s = Some(time_s);
        }
        self.machine.step(time_s)
    }

    fn target(&mut self, time_s: f64) -> Target {
        let model = &self.human.model;
        let count = model.coordinates().len();
        let mut posture = [vec![0.0; count], vec![0.0; count], vec![0.0; count]];
        let clock = self.walk.clock(time_s);
        let at = self.asked(time_s);
        let [q, qd, qdd] = &mut posture;
        self.coordinates.write(&at, q, qd, qdd);
        if model.anatomy().coordinate(Movement::PelvisRight, None).is_some() {
            trunk_with_pelvis(model, &mut posture);
            let planes = self.planes.at(clock.phase, self.walk.curve_speed(&clock));
            write_planes(model, &planes, clock.walking, &mut posture);
        }
        if let Some((id, _)) = model.anatomy().coordinate(Movement::PelvisUp, None) {
            posture[0][id.index()] = self.human.dimensions.leg_length;
        }
        let mut toes = Side::BOTH.map(|side| toes_of(&at, side));
        self.drive(&mut posture, &mut toes);
        Target {
            posture,
            forces: self.forces(&at, &clock),
            moments: Side::BOTH.map(|side| self.joint_moments(&at, &clock, side)),
            toes,
            clearance: Side::BOTH.map(|side| clearance(&at, &clock, side)),
        }
    }

    fn speed(&self, clock: &Clock) -> f64 {
        self.walk.curve_speed(clock).value
    }

    /// Ground forces of the right and of the left foot, forward and up [body weights].
    fn forces(&self, at: &WalkPosture, clock: &Clock) -> [[f64; 2]; 2] {
        let walking = clock.walking.value;
        let of_people = Side::BOTH.map(|side| self.forces.at(at.phases.cycle[side], self.speed(clock)));
        let both: f64 = of_people.iter().map(|[up, _]| up).sum();
        let moves = (walking / STANDS_BELOW).min(1.0);
        of_people.map(|[up, fore]| {
            let carried = moves * up / both + 0.5 * (1.0 - moves);
            [walking * fore, walking * up + (1.0 - walking) * carried]
        })
    }

    /// Moments of a leg; in standing they are unknown and small.
    fn joint_moments(&self, at: &WalkPosture, clock: &Clock, side: Side) -> JointMoments {
        let share = clock.walking.value;
        let JointMoments { hip_extension, knee_extension, plantarflexion, hip_abduction } =
            self.moments.at(at.phases.cycle[side], self.speed(clock));
        JointMoments {
            hip_extension: share * hip_extension,
            knee_extension: share * knee_extension,
            plantarflexion: share * plantarflexion,
            hip_abduction: share * hip_abduction,
        }
    }

    /// Writes coordinates that machines drive.
    fn drive(&self, posture: &mut [Vec<f64>; 3], toes: &mut [f64; 2]) {
        let model = &self.human.model;
        for (name, jet) in self.machine.coordinates() {
            let Some(id) = model.coordinate(name) else { continue };
            let start = model.coordinates()[id.index()].default_value;
            for (values, part) in posture.iter_mut().zip([start + jet.value, jet.rate, jet.acceleration]) {
                values[id.index()] = part;
            }
            let meaning = model.anatomy().meaning(id).filter(|meaning| meaning.movement == Movement::ToeExtension);
            if let Some(side) = meaning.and_then(|meaning| meaning.side) {
                toes[usize::from(side == Side::Left)] = start + jet.value;
            }
        }
    }
}

/// Extension of the toes while the foot stands, so that they lie on the ground [rad].
fn toes_of(at: &WalkPosture, side: Side) -> f64 {
    let leg = if side == Side::Right { &at.right } else { &at.left };
    let pitch = leg.hip.value - at.pelvis_tilt.value - leg.knee.value + leg.ankle.value;
    let stands = at.phases.cycle[side] < at.phases.foot_off;
    if stands { (-pitch).clamp(0.0, TOES_LIMIT) } else { 0.0 }
}

/// The smallest height of heel, ball and toes while they must be clear of the ground [m], and a parabola over this
/// time, 1 in its middle.
fn clearance(at: &WalkPosture, clock: &Clock, side: Side) -> [Option<[f64; 2]>; 3] {
    let place = at.phases.cycle[side];
    let walking = clock.walking.value.powi(2);
    SWING_MARGINS.map(|[after, before]| {
        let (start, end) = (at.phases.foot_off + after, 1.0 - before);
        let share = (place - start) / (end - start);
        (!clock.stands() && place > start && place < end)
            .then_some([CLEARANCE * walking, 4.0 * share * (1.0 - share) * walking])
    })
}

/// Adds the tilt of the pelvis to the target of the lumbar joint, because the trunk angles of the tables are relative
/// to the pelvis, while the gait takes trunk lean as relative to the world. (In the other two planes, the third
/// harmonics of trunk and pelvis cancel, as they do if the trunk is relative to the pelvis.)
fn trunk_with_pelvis(model: &Model, posture: &mut [Vec<f64>; 3]) {
    let of = |movement: Movement| model.anatomy().coordinate(movement, None).map(|(id, _)| id.index());
    if let (Some(tilt), Some(lumbar)) = (of(Movement::PelvicTilt), of(Movement::TrunkLean)) {
        for values in posture {
            values[lumbar] += values[tilt];
        }
    }
}

/// Writes the angles of pelvis, trunk and hips outside the sagittal plane, times the share of walking.
fn write_planes(model: &Model, planes: &crate::gait::OtherPlanes, walking: Jet, posture: &mut [Vec<f64>; 3]) {
    let anatomy = model.anatomy();
    let mut put = |movement: Movement, side: Option<Side>, angle: Jet| {
        if let Some((id, sign)) = anatomy.coordinate(movement, side) {
            let angle = angle * walking;
            for (values, part) in posture.iter_mut().zip([angle.value, angle.rate, angle.acceleration]) {
                values[id.index()] = sign * part;
            }
        }
    };
    let [obliquity, rotation] = planes.pelvis;
    put(Movement::PelvicObliquity, None, obliquity);
    put(Movement::PelvicRotation, None, rotation);
    put(Movement::TrunkObliquity, None, planes.trunk[0]);
    put(Movement::TrunkRotation, None, planes.trunk[1]);
    for (side, [adduction, rotation]) in Side::BOTH.into_iter().zip(planes.hips) {
        put(Movement::HipAdduction, Some(side), adduction);
        put(Movement::HipRotation, Some(side), rotation);
    }
}
