//! Impedances of joints, and the derivatives of time steps of a figure.
//!
//! Derivatives are central differences of one step each, so they are exact to rounding also where feet touch the soft ground: a difference over many
//! steps would jump over the instants at which spheres begin to carry load.

use super::figure::FigureWorld;
use super::plan::{CyclePlan, PlannedStep};
use super::riccati::StepMap;
use super::settings::ControlError;
use crate::engine::{Motor, Signal};
use crate::findings::Findings;
use crate::optimal::{ECCENTRIC, StrengthCurve};
use crate::walking::WalkingError;
use nalgebra::{DMatrix, DVector};

/// Differences of coordinates [rad or m], rates [rad/s or m/s] and torques [N.m].
const DIFFERENCES: [f64; 3] = [1e-6, 1e-5, 1e-2];

/// Muscles need clearly more than they have from this share of their strength on. Push-off takes the ankle to its strength in every step.
const OVERLOAD: f64 = 1.2;

/// Stiffness, damping and strength of the motor of a coordinate; no motor where the stiffness is zero.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Impedance {
    /// [N.m/rad].
    pub(super) stiffness: f64,
    /// [N.m.s/rad].
    pub(super) damping: f64,
    /// Of the muscles.
    pub(super) strength: StrengthCurve,
}

impl Impedance {
    /// Largest torque in the direction of `sign` at an angle and a rate [N.m].
    fn available(&self, [q, rate]: [f64; 2], sign: f64) -> f64 {
        self.strength.available(q, rate, sign, ECCENTRIC)
    }

    /// Largest torque in the direction of `sign` at an angle, at rest [N.m].
    pub(super) fn isometric(&self, q: f64, sign: f64) -> f64 {
        self.available([q, 0.0], sign)
    }

    /// A motor that only damps, of a figure that has fallen.
    pub(super) fn limp(&self, [q, _]: [f64; 2]) -> Motor {
        let max = [1.0, -1.0].map(|sign| self.isometric(q, sign)).into_iter().fold(f64::INFINITY, f64::min);
        Motor { target: Signal::Constant(0.0), kp: 0.0, kd: self.damping, max }
    }

    /// Whether a motor would need clearly more than its muscles have in a state.
    pub(super) fn is_overloaded(motor: &Motor, [q, rate]: [f64; 2]) -> bool {
        (motor.kp * (motor.target.at(0.0)[0] - q) - motor.kd * rate).abs() >= OVERLOAD * motor.max
    }

    /// The motor whose torque at the target value and rate is `torque`. Its limit is the strength at the angle and the rate of `now`, in the direction in
    /// which it acts there.
    pub(super) fn motor(&self, [target, target_rate]: [f64; 2], torque: f64, now: [f64; 2]) -> Motor {
        let [q, rate] = now;
        let ahead = (self.damping * target_rate + torque) / self.stiffness;
        let acts = self.stiffness * (target + ahead - q) - self.damping * rate;
        let max = self.available(now, acts);
        Motor { target: Signal::Constant(target + ahead), kp: self.stiffness, kd: self.damping, max }
    }
}

impl FigureWorld {
    /// The maps of all time steps of a plan from state and torque of the joints to the next state. Where the second half of the cycle is the mirror image
    /// of the first, so are its maps.
    pub(crate) fn maps(&mut self, plan: &CyclePlan, impedances: &[Impedance]) -> Result<Vec<StepMap>, ControlError> {
        let count = plan.steps.len();
        let first = if plan.mirror.is_some() { count / 2 } else { count };
        let mut maps = (0..first).map(|k| self.map(plan, impedances, k)).collect::<Result<Vec<_>, _>>()?;
        if let Some(mirror) = &plan.mirror {
            let images: Vec<StepMap> = maps.iter().map(|map| mirrored(map, plan, mirror)).collect();
            maps.extend(images);
        }
        Ok(maps)
    }

    /// The map of one time step.
    fn map(&mut self, plan: &CyclePlan, impedances: &[Impedance], step: usize) -> Result<StepMap, ControlError> {
        let (places, joints) = (plan.places(), plan.joints());
        let (width, states) = (impedances.len(), places.len() + impedances.len());
        let planned = &plan.steps[step];
        let mut probe = |place: Option<(usize, f64)>, torque: Option<(usize, f64)>| {
            self.probe(planned, impedances, &places, place, torque)
        };
        let mut by_state = DMatrix::zeros(states, states);
        for i in 0..states {
            let moved = if i < places.len() { places[i] } else { width + i - places.len() };
            let size = DIFFERENCES[usize::from(i >= places.len())];
            let [up, down] = [size, -size].map(|size| probe(Some((moved, size)), None));
            by_state.set_column(i, &((up? - down?) / (2.0 * size)));
        }
        let mut by_input = DMatrix::zeros(states, joints.len());
        for (i, joint) in joints.iter().enumerate() {
            let [up, down] = [DIFFERENCES[2], -DIFFERENCES[2]].map(|size| probe(None, Some((*joint, size))));
            by_input.set_column(i, &((up? - down?) / (2.0 * DIFFERENCES[2])));
        }
        Ok(StepMap { by_state, by_input })
    }

    /// The state after one step from the plan, with a change of one coordinate or rate, or of one torque.
    fn probe(
        &mut self,
        planned: &PlannedStep,
        impedances: &[Impedance],
        places: &[usize],
        moved: Option<(usize, f64)>,
        torque: Option<(usize, f64)>,
    ) -> Result<DVector<f64>, ControlError> {
        let [mut q, mut qd] = planned.state.clone();
        if let Some((place, size)) = moved {
            let width = q.len();
            if place < width { q[place] += size } else { qd[place - width] += size }
        }
        self.place(&q, &qd);
        for (c, impedance) in impedances.iter().enumerate().filter(|(_, impedance)| impedance.stiffness > 0.0) {
            let more = torque.filter(|(joint, _)| *joint == c).map_or(0.0, |(_, size)| size);
            let target = [planned.target[0][c], planned.target[1][c]];
            let mut motor = impedance.motor(target, planned.torques[c] + more, [q[c], qd[c]]);
            motor.max = f64::INFINITY;
            self.drive(c, motor);
        }
        self.step(&mut Findings::default()).map_err(WalkingError::from)?;
        let now = self.read();
        let all = places.iter().map(|c| now[*c][0]).chain(now.iter().map(|now| now[1]));
        Ok(DVector::from_iterator(places.len() + now.len(), all))
    }
}

/// The map of the same step half a cycle later.
fn mirrored(map: &StepMap, plan: &CyclePlan, mirror: &[(usize, f64)]) -> StepMap {
    // Row or column and sign of the mirror image of each one.
    let image = |coordinates: &[usize]| {
        let place = |c: usize| coordinates.iter().position(|other| *other == c).unwrap_or(0);
        coordinates.iter().map(|c| (place(mirror[*c].0), mirror[*c].1)).collect::<Vec<(usize, f64)>>()
    };
    let places = image(&plan.places());
    let all: Vec<usize> = (0..mirror.len()).collect();
    let rates = image(&all).into_iter().map(|(c, sign)| (places.len() + c, sign));
    let states: Vec<(usize, f64)> = places.iter().copied().chain(rates).collect();
    let inputs = image(&plan.joints());
    let of = |matrix: &DMatrix<f64>, columns: &[(usize, f64)]| {
        DMatrix::from_fn(states.len(), columns.len(), |i, j| {
            states[i].1 * columns[j].1 * matrix[(states[i].0, columns[j].0)]
        })
    };
    StepMap { by_state: of(&map.by_state, &states), by_input: of(&map.by_input, &inputs) }
}

/// The maps of a figure whose joints have other impedances, from those with the impedances `before`.
///
/// A motor acts by the value q at the start of a step and the rate q̇⁺ at its end: τ = c - k q - (k h + d) q̇⁺. With the changes Δk and Δd, and the torques
/// u = e - Δk q - (Δk h + Δd) q̇⁺ =: e - V x - W x⁺ in x⁺ = A x + B u,
///
///   S = I + W B      A' = A - B S⁻¹ (V + W A)      B' = B S⁻¹
pub(super) fn with_impedances(
    maps: &[StepMap],
    plan: &CyclePlan,
    [before, after]: [&[Impedance]; 2],
    step_s: f64,
) -> Option<Vec<StepMap>> {
    let (places, joints) = (plan.places(), plan.joints());
    let states = places.len() + before.len();
    let (mut by_value, mut by_rate) = (DMatrix::zeros(joints.len(), states), DMatrix::zeros(joints.len(), states));
    for (row, &joint) in joints.iter().enumerate() {
        let stiffer = after[joint].stiffness - before[joint].stiffness;
        let damped = after[joint].damping - before[joint].damping;
        if let Some(place) = places.iter().position(|place| *place == joint) {
            by_value[(row, place)] = stiffer;
        }
        by_rate[(row, places.len() + joint)] = stiffer * step_s + damped;
    }
    let changed = |StepMap { by_state, by_input }: &StepMap| {
        let inverse = (DMatrix::identity(joints.len(), joints.len()) + &by_rate * by_input).try_inverse()?;
        let by_input = by_input * inverse;
        let by_state = by_state - &by_input * (&by_value + &by_rate * by_state);
        Some(StepMap { by_state, by_input })
    };
    maps.iter().map(changed).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::HuntCrossley;
    use crate::control::plan::Root;
    use crate::dynamics::{Workspace, inverse_frame};
    use crate::engine::StepSettings;
    use crate::kinematics::Posture;
    use crate::model::anthropometry::{Build, SegmentTable};
    use crate::model::full_body::full_body;
    use crate::optimal::mirror;

    /// The strength of a giant.
    fn strong() -> StrengthCurve {
        StrengthCurve { angles: vec![0.0], positive: vec![1e3], negative: vec![1e3], hill: None }
    }

    #[test]
    fn maps_of_the_second_half_of_a_cycle_are_mirror_images_of_those_of_the_first() {
        let build = Build { table: SegmentTable::DeLevaMale, mass: 75.0, height: 1.75, toe_joint: true };
        let human = full_body(&build).unwrap();
        let (count, mirror) = (human.model.coordinates().len(), mirror(&human.model));
        let root = Root::of(&human.model);
        let first: Vec<f64> = (0..count).map(|k| 0.2 * (1.0 + 1.7 * k as f64).sin()).collect();
        let second: Vec<f64> = mirror.iter().map(|(c, sign)| sign * first[*c]).collect();
        let on_the_ground = |q: &[f64]| {
            let mut q = q.to_vec();
            q[root.up] = 0.9;
            q
        };
        let step = |q: &[f64]| PlannedStep {
            state: [on_the_ground(q), q.to_vec()],
            target: [on_the_ground(q), q.to_vec()],
            torques: q.iter().map(|q| 50.0 * q).collect(),
        };
        let steps = vec![step(&first), step(&second)];
        let plan = CyclePlan { steps, strikes: [0; 2], root: root.clone(), mirror: Some(mirror) };
        let impedance = |stiffness: f64| Impedance { stiffness, damping: 5.0, strength: strong() };
        let joints = plan.joints();
        let impedances: Vec<Impedance> =
            (0..count).map(|c| impedance(if joints.contains(&c) { 50.0 } else { 0.0 })).collect();
        let mut figure = FigureWorld::new(&human, HuntCrossley::SOFT_SHOES, StepSettings::default()).unwrap();
        let image = figure.maps(&plan, &impedances).unwrap().remove(1);
        let found = figure.map(&plan, &impedances, 1).unwrap();
        let [by_state, by_input] = [(&found.by_state, &image.by_state), (&found.by_input, &image.by_input)]
            .map(|(a, b)| (a - b).amax() / a.amax());
        assert!(by_state < 1e-6 && by_input < 1e-6, "{by_state} {by_input}");
    }

    /// In the air, a torque e of one joint changes the rates by Δ with (M + h d + h² k) Δ = h e, and M Δ is what inverse dynamics says.
    #[test]
    fn derivatives_by_torque_agree_with_inverse_dynamics() {
        let build = Build { table: SegmentTable::DeLevaMale, mass: 75.0, height: 1.75, toe_joint: true };
        let human = full_body(&build).unwrap();
        let count = human.model.coordinates().len();
        let root = Root::of(&human.model);
        let wave = |k: usize, size: f64| size * (1.0 + 1.7 * k as f64).sin();
        let mut q: Vec<f64> = (0..count).map(|k| wave(k, 0.3)).collect();
        q[root.up] = 3.0;
        // At rest: rates after a step are those of its posture at the end.
        let qd = vec![0.0; count];
        let step =
            PlannedStep { state: [q.clone(), qd.clone()], target: [q.clone(), qd.clone()], torques: vec![0.0; count] };
        let plan = CyclePlan { steps: vec![step], strikes: [0; 2], root, mirror: None };
        let impedance = |stiffness: f64| Impedance { stiffness, damping: 0.1 * stiffness, strength: strong() };
        let impedances: Vec<Impedance> =
            (0..count).map(|c| impedance(if plan.joints().contains(&c) { 50.0 + c as f64 } else { 0.0 })).collect();
        let settings = StepSettings::default();
        let mut figure = FigureWorld::new(&human, HuntCrossley::SOFT_SHOES, settings).unwrap();
        let map = figure.maps(&plan, &impedances).unwrap().remove(0);
        let mut workspace = Workspace::new(&human.model);
        let mut torques = |qdd: &[f64]| {
            let still = vec![0.0; count];
            inverse_frame(&mut workspace, Posture { q: &q, qd: &still, qdd }, &[]).generalized().to_vec()
        };
        let weight = torques(&vec![0.0; count]);
        let h = settings.step_s;
        for (column, joint) in plan.joints().into_iter().enumerate() {
            let change: Vec<f64> = (0..count).map(|c| map.by_input[(count - 1 + c, column)]).collect();
            let inertial = torques(&change);
            for c in 0..count {
                let yields = (h * impedances[c].damping + h * h * impedances[c].stiffness) * change[c];
                let expected = if c == joint { h } else { 0.0 };
                let found = inertial[c] - weight[c] + yields;
                assert!((found - expected).abs() < 1e-6 * h.max(1e-3), "{joint}, {c}: {found} instead of {expected}");
            }
        }
    }

    /// In the air and at rest nothing moves the joints, whatever their impedance, so both maps belong to the same torques.
    #[test]
    fn maps_of_another_impedance_follow_from_those_of_one() {
        let build = Build { table: SegmentTable::DeLevaMale, mass: 75.0, height: 1.75, toe_joint: true };
        let human = build.human().unwrap();
        let count = human.model.coordinates().len();
        let root = Root::of(&human.model);
        let mut q: Vec<f64> = (0..count).map(|k| 0.3 * (1.0 + 1.7 * k as f64).sin()).collect();
        q[root.up] = 3.0;
        let mut figure = FigureWorld::new(&human, HuntCrossley::SOFT_SHOES, StepSettings::default()).unwrap();
        let state = [q, vec![0.0; count]];
        let step = PlannedStep { state: state.clone(), target: state, torques: vec![0.0; count] };
        let plan = CyclePlan { steps: vec![step], strikes: [0; 2], root, mirror: None };
        let with = |stiffness: f64, damping: f64| -> Vec<Impedance> {
            let joints = plan.joints();
            let driven = |c: usize| if joints.contains(&c) { 1.0 } else { 0.0 };
            let of = |c: usize| Impedance {
                stiffness: driven(c) * (stiffness + c as f64),
                damping: driven(c) * damping,
                strength: strong(),
            };
            (0..count).map(of).collect()
        };
        let [soft, stiff] = [with(20.0, 1.0), with(250.0, 30.0)];
        let own = figure.maps(&plan, &soft).unwrap();
        let direct = figure.maps(&plan, &stiff).unwrap().remove(0);
        let found = with_impedances(&own, &plan, [&soft, &stiff], StepSettings::default().step_s).unwrap().remove(0);
        for (name, found, direct, other) in [
            ("state", found.by_state, direct.by_state, &own[0].by_state),
            ("input", found.by_input, direct.by_input, &own[0].by_input),
        ] {
            let (apart, change) = ((found - &direct).amax(), (other - &direct).amax());
            println!("{name}: {apart:.1e} of a change of {change:.1e}");
            assert!(apart < 1e-5 * change, "{name}: {apart} of a change of {change}");
        }
    }
}
