//! Impedances of joints, and the derivatives of time steps of a figure.
//!
//! Derivatives are differences of one step each, also where feet touch the soft ground: a difference over many steps
//! would jump over the instants at which spheres begin to carry load. They are forward differences, which along a
//! walk differ from central ones, of twice the cost, by a share of about 1e-5, and where contact sets in by up to 1e-3;
//! gains do so too.
//!
//! Between the instants at which contacts set in or end, maps change slowly. So a fifth to a third of them is computed,
//! the others are linear in between: a span of time steps is halved while the map in its middle is not the mean of
//! those at its ends. Gains of a walk and of movements then differ from those of all maps by a share of about 1e-3, and
//! where a foot strikes by up to 3e-2.

use super::figure::FigureWorld;
use super::plan::{CyclePlan, PlannedStep};
use super::riccati::StepMap;
use super::settings::ControlError;
use crate::engine::{Motor, Signal};
use crate::findings::Findings;
use crate::optimal::{ECCENTRIC, StrengthCurve};
use crate::walking::WalkingError;
use nalgebra::{DMatrix, DVector};

/// Differences of coordinates [rad or m], rates [rad/s or m/s] and torques [N.m] by which maps are made.
pub const DIFFERENCES: [f64; 3] = [1e-7, 1e-6, 1e-3];

/// Most time steps between two maps that are computed.
const SPARSE: usize = 16;
/// Largest difference of a map from the mean of two others at which it is taken as linear between them: a share of what
/// the step makes of the rates.
const LINEAR: f64 = 0.01;

/// Muscles need clearly more than they have from this share of their strength on. Push-off takes the ankle to its
/// strength in every step.
const OVERLOAD: f64 = 1.2;
/// Damping of a figure that has fallen, over its damping while it walks.
const LIMP: f64 = 0.25;

/// Stiffness, damping and strength of the motor of a coordinate; no motor where the stiffness is zero.
#[derive(Debug, Clone, PartialEq)]
pub struct Impedance {
    /// [N.m/rad].
    pub stiffness: f64,
    /// [N.m.s/rad].
    pub damping: f64,
    /// Strength of the muscles.
    pub strength: StrengthCurve,
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

    /// A motor that only damps, of a figure that has fallen: with the whole damping its limbs would sink so slowly
    /// that they seem to stand.
    pub(super) fn limp(&self, [q, _]: [f64; 2]) -> Motor {
        let max = [1.0, -1.0].map(|sign| self.isometric(q, sign)).into_iter().fold(f64::INFINITY, f64::min);
        Motor { target: Signal::Constant(0.0), kp: 0.0, kd: LIMP * self.damping, max }
    }

    /// Whether a motor would need clearly more than its muscles have in a state.
    pub(super) fn is_overloaded(motor: &Motor, [q, rate]: [f64; 2]) -> bool {
        (motor.kp * (motor.target.at(0.0)[0] - q) - motor.kd * rate).abs() >= OVERLOAD * motor.max
    }

    /// The motor whose torque at the target value and rate is `torque`. Its limit is the strength at the angle and the
    /// rate of `now`, in the direction in which it acts there.
    pub(super) fn motor(&self, [target, target_rate]: [f64; 2], torque: f64, now: [f64; 2]) -> Motor {
        let [q, rate] = now;
        let ahead = (self.damping * target_rate + torque) / self.stiffness;
        let acts = self.stiffness * (target + ahead - q) - self.damping * rate;
        let max = self.available(now, acts);
        Motor { target: Signal::Constant(target + ahead), kp: self.stiffness, kd: self.damping, max }
    }
}

impl FigureWorld {
    /// The maps of all time steps of a plan from state and torque of the joints to the next state. Where the second
    /// half of the cycle is the mirror image of the first, so are its maps.
    pub fn maps(&mut self, plan: &CyclePlan, impedances: &[Impedance]) -> Result<Vec<StepMap>, ControlError> {
        let count = plan.steps.len();
        let first = if plan.mirror.is_some() { count / 2 } else { count };
        let mut maps = self.first_maps(plan, impedances, first)?;
        if let Some(mirror) = &plan.mirror {
            let images: Vec<StepMap> = maps.iter().map(|map| mirrored(map, plan, mirror)).collect();
            maps.extend(images);
        }
        Ok(maps)
    }

    /// The maps of the first time steps, computed where they are not linear between others.
    fn first_maps(
        &mut self,
        plan: &CyclePlan,
        impedances: &[Impedance],
        count: usize,
    ) -> Result<Vec<StepMap>, ControlError> {
        let Some(last) = count.checked_sub(1) else { return Ok(Vec::new()) };
        let places = plan.places().len();
        let mut map = |step| self.map(plan, impedances, step, DIFFERENCES);
        let mut maps = vec![map(0)?];
        for from in (0..last).step_by(SPARSE) {
            let to = (from + SPARSE).min(last);
            // The ends of spans that still have to be looked at, the earliest one last. `maps` reaches to the first of
            // them.
            let mut ends = vec![(to, map(to)?)];
            while let Some((to, end)) = ends.pop() {
                let from = maps.len() - 1;
                let start = &maps[from];
                let middle = from.midpoint(to);
                let in_middle = if middle > from { Some(map(middle)?) } else { None };
                match in_middle {
                    Some(in_middle) if !in_middle.is_between(start, &end, middle - from, to - from, places) => {
                        ends.push((to, end));
                        ends.push((middle, in_middle));
                    }
                    in_middle => {
                        let known = in_middle.map(|map| (middle, map)).into_iter().chain([(to, end)]);
                        known.for_each(|(step, map)| extend(&mut maps, step, map));
                    }
                }
            }
        }
        Ok(maps)
    }

    /// The map of one time step, by given differences.
    pub fn map(
        &mut self,
        plan: &CyclePlan,
        impedances: &[Impedance],
        step: usize,
        differences: [f64; 3],
    ) -> Result<StepMap, ControlError> {
        let (places, joints) = (plan.places(), plan.joints());
        let (width, states) = (impedances.len(), places.len() + impedances.len());
        let planned = &plan.steps[step];
        let mut probe = |moved, torque| self.probe(planned, impedances, &places, moved, torque);
        let planned_next = probe(None, None)?;
        let by = |size: f64, next: DVector<f64>| (next - &planned_next) / size;
        let mut by_state = DMatrix::zeros(states, states);
        for i in 0..states {
            let moved = if i < places.len() { places[i] } else { width + i - places.len() };
            let size = differences[usize::from(i >= places.len())];
            by_state.set_column(i, &by(size, probe(Some((moved, size)), None)?));
        }
        let mut by_input = DMatrix::zeros(states, joints.len());
        for (i, joint) in joints.iter().enumerate() {
            let size = differences[2];
            by_input.set_column(i, &by(size, probe(None, Some((*joint, size)))?));
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

/// Adds the map of a time step, and before it those that are linear between the last one and it.
fn extend(maps: &mut Vec<StepMap>, step: usize, map: StepMap) {
    let from = maps.len() - 1;
    let start = maps[from].clone();
    maps.extend((from + 1..step).map(|k| start.mixed(&map, (k - from) as f64 / (step - from) as f64)));
    maps.push(map);
}

impl StepMap {
    /// Whether this map of the `k`-th of `count` time steps is linear between two others, as far as rates after the
    /// step are concerned. They follow `places` coordinates in the state.
    fn is_between(&self, start: &StepMap, end: &StepMap, k: usize, count: usize, places: usize) -> bool {
        let mean = start.mixed(end, k as f64 / count as f64);
        let states = self.by_state.nrows();
        let still = DMatrix::identity(states, states);
        let parts = [
            (&self.by_state, &mean.by_state, 0..places),
            (&(&self.by_state - &still), &(&mean.by_state - &still), places..states),
            (&self.by_input, &mean.by_input, 0..self.by_input.ncols()),
        ];
        parts.into_iter().all(|(own, mean, columns)| {
            let [own, mean] =
                [own, mean].map(|map| map.view((places, columns.start), (states - places, columns.len())));
            (own - mean).norm() <= LINEAR * own.norm()
        })
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
/// A motor acts by the value q at the start of a step and the rate q̇⁺ at its end: τ = c - k q - (k h + d) q̇⁺. With
/// the changes Δk and Δd, and the torques u = e - Δk q - (Δk h + Δd) q̇⁺ =: e - V x - W x⁺ in x⁺ = A x + B u,
///
///   S = I + W B      A' = A - B S⁻¹ (V + W A)      B' = B S⁻¹
pub fn with_impedances(
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
