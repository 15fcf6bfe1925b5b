//! The planned walk at the time steps of the simulator.

use super::settings::{ControlError, TorqueCurves};
use crate::model::anthropometry::Human;
use crate::model::{Model, Side};
use crate::numerics::Harmonics;
use crate::optimal::{Sample, Solution, mirror};

/// Fewest and most time steps of a cycle.
const STEPS: [usize; 2] = [100, 5000];

/// Postures and rates [rad, m, rad/s, m/s] and torques [N.m] of mirror images differ by less.
const MIRRORED: [f64; 2] = [1e-6, 1e-3];

/// Cycles whose durations differ by a smaller share are the same.
const SAME_CYCLE: f64 = 0.005;

/// Share of the body weight at which a foot strikes.
pub(super) const STRIKE: f64 = 0.05;

/// Coordinates, rates and torques of the plan in one time step.
#[derive(Debug, Clone)]
pub struct PlannedStep {
    /// Coordinates and rates at its start.
    pub state: [Vec<f64>; 2],
    /// Coordinates and rates in its middle, the targets of the impedance.
    pub target: [Vec<f64>; 2],
    /// Torques in its middle [N.m], one per coordinate.
    pub torques: Vec<f64>,
}

impl PlannedStep {
    /// (1 - w) times this step plus w times another one.
    pub(super) fn blended(&self, other: &PlannedStep, w: f64) -> PlannedStep {
        let mix = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (1.0 - w) * a + w * b).collect::<Vec<f64>>();
        let both = |a: &[Vec<f64>; 2], b: &[Vec<f64>; 2]| [mix(&a[0], &b[0]), mix(&a[1], &b[1])];
        PlannedStep {
            state: both(&self.state, &other.state),
            target: both(&self.target, &other.target),
            torques: mix(&self.torques, &other.torques),
        }
    }
}

/// A cycle of the plan.
#[derive(Debug, Clone)]
pub struct CyclePlan {
    /// All steps of the cycle.
    pub steps: Vec<PlannedStep>,
    /// Numbers of the steps in which the right and the left foot strike: their load passes `STRIKE`.
    pub strikes: [usize; 2],
    /// The coordinates of the root.
    pub root: Root,
    /// The coordinate on the other side and its sign, if the second half of the cycle is the mirror image of the first.
    pub mirror: Option<Vec<(usize, f64)>>,
}

/// Numbers of the coordinates of the root.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Root {
    /// Along x.
    pub forward: usize,
    /// Along y.
    pub up: usize,
    /// Coordinate to the right; a planar figure has none.
    pub sideways: Option<usize>,
    /// Rotations.
    pub turns: Vec<usize>,
}

impl Root {
    /// The root coordinates of a model of a figure.
    pub fn of(model: &Model) -> Root {
        let named = |name: &str| model.coordinate(name).map(|id| id.index());
        let turns = ["pelvis_tilt", "pelvis_list", "pelvis_rotation"].into_iter().filter_map(named).collect();
        let place = |name: &str| named(name).unwrap_or(0);
        Root { forward: place("pelvis_tx"), up: place("pelvis_ty"), sideways: named("pelvis_tz"), turns }
    }

    fn contains(&self, c: usize) -> bool {
        c == self.forward || c == self.up || Some(c) == self.sideways || self.turns.contains(&c)
    }
}

impl CyclePlan {
    /// The time steps of a solved walk or movement.
    pub fn new(human: &Human, solution: &Solution, step_s: f64) -> Result<CyclePlan, ControlError> {
        let cycle_s = solution.cycle_s();
        // An even number, so that halves of the cycle can be compared.
        let found = 2 * (0.5 * cycle_s / step_s).round() as usize;
        if !(STEPS[0]..=STEPS[1]).contains(&found) {
            return Err(ControlError::Steps { found, least: STEPS[0], most: STEPS[1] });
        }
        // The cycle becomes a whole number of steps, which changes its duration by at most one step.
        let at = |shift: f64| (0..found).map(|k| cycle_s * (k as f64 + shift) / found as f64).collect::<Vec<f64>>();
        let (starts, middles) = (solution.samples(&at(0.0))?, solution.samples(&at(0.5))?);
        let weight_n = human.model.mass() * human.model.gravity().norm();
        let strikes = Side::BOTH.map(|side| {
            let of_side = |sample: &Sample| {
                let contacts = human.soles.iter().zip(&sample.contacts);
                contacts.filter(|(sole, _)| sole.side == side).map(|(_, contact)| contact.force.y).sum::<f64>()
            };
            let bears: Vec<bool> = starts.iter().map(|sample| of_side(sample) > STRIKE * weight_n).collect();
            (0..found).find(|&k| bears[k] && !bears[(k + found - 1) % found]).unwrap_or(0)
        });
        let two = |[q, qd, _]: [Vec<f64>; 3]| [q, qd];
        let steps = starts.into_iter().zip(middles).map(|(start, middle)| PlannedStep {
            state: two(start.posture),
            target: two(middle.posture),
            torques: middle.forces,
        });
        let mut plan = CyclePlan { steps: steps.collect(), strikes, root: Root::of(&human.model), mirror: None };
        plan.find_mirror(&human.model);
        Ok(plan)
    }

    /// A plan of other steps of the same figure, which need not be a cycle.
    pub(super) fn with_steps(&self, steps: Vec<PlannedStep>) -> CyclePlan {
        CyclePlan { steps, strikes: [0; 2], root: self.root.clone(), mirror: None }
    }

    /// Looks whether the second half of the cycle is the mirror image of the first.
    fn find_mirror(&mut self, model: &Model) {
        let mirror = mirror(model);
        let half = self.steps.len() / 2;
        let differ = |a: &[f64], b: &[f64], tolerance: f64| {
            let apart = |c: usize| (a[c] - mirror[c].1 * b[mirror[c].0]).abs() > tolerance;
            (0..a.len()).any(|c| c != self.root.forward && apart(c))
        };
        let is_image = |(first, second): (&PlannedStep, &PlannedStep)| {
            let postures = |step: &PlannedStep| [step.state.clone(), step.target.clone()].concat();
            let moved = postures(second).iter().zip(&postures(first)).any(|(b, a)| differ(b, a, MIRRORED[0]));
            !moved && !differ(&second.torques, &first.torques, MIRRORED[1])
        };
        let (first, second) = self.steps.split_at(half);
        self.mirror = first.iter().zip(second).all(is_image).then_some(mirror);
    }

    /// Shares of the cycle in the middle of each step.
    pub(super) fn middles(&self) -> Vec<f64> {
        let count = self.steps.len();
        (0..count).map(|k| (k as f64 + 0.5) / count as f64).collect()
    }

    /// Replaces the torque of a coordinate by a function of the share of the cycle.
    fn replace_torque(&mut self, c: usize, torque: impl Fn(f64) -> f64) {
        let middles = self.middles();
        self.steps.iter_mut().zip(middles).for_each(|(step, middle)| step.torques[c] = torque(middle));
    }

    /// Torques of a coordinate in all steps [N.m].
    pub(super) fn torques(&self, c: usize) -> Vec<f64> {
        self.steps.iter().map(|step| step.torques[c]).collect()
    }

    /// Replaces the torques of the plan as the settings ask.
    pub(super) fn set_torques(
        &mut self,
        model: &Model,
        cycle_s: f64,
        curves: &TorqueCurves,
    ) -> Result<(), ControlError> {
        match curves {
            TorqueCurves::Plan => {}
            TorqueCurves::Harmonics(count) => {
                let middles = self.middles();
                for c in 0..self.steps[0].torques.len() {
                    let kept = Harmonics::of(&middles, &self.torques(c), *count);
                    self.replace_torque(c, |phase| kept.at(phase));
                }
            }
            TorqueCurves::Given(all) => {
                for series in all {
                    let joint = model.coordinate(&series.coordinate).map(|id| id.index());
                    let Some(c) = joint.filter(|c| !self.root.contains(*c)) else {
                        return Err(ControlError::TorqueOf { coordinate: series.coordinate.clone() });
                    };
                    if (series.cycle_s / cycle_s - 1.0).abs() > SAME_CYCLE {
                        return Err(ControlError::TorqueCycle { found_s: series.cycle_s, cycle_s });
                    }
                    let scale = model.mass() / series.body_kg;
                    self.replace_torque(c, |phase| scale * series.at(phase));
                }
            }
        }
        self.find_mirror(model);
        Ok(())
    }

    /// The number of the step at a share of the cycle.
    pub(super) fn step_at(&self, phase: f64) -> usize {
        // The phase is a sum of shares of a step, and must not fall short of a step by rounding.
        const ROUNDING: f64 = 1e-6;
        (phase * self.steps.len() as f64 + ROUNDING) as usize % self.steps.len()
    }

    /// Share of the cycle at which a foot strikes.
    pub(super) fn strike(&self, foot: usize) -> f64 {
        self.strikes[foot] as f64 / self.steps.len() as f64
    }

    /// The coordinates that joints move.
    pub fn joints(&self) -> Vec<usize> {
        (0..self.steps[0].torques.len()).filter(|c| !self.root.contains(*c)).collect()
    }

    /// The coordinates of the state: all but the place along the ground.
    pub(super) fn places(&self) -> Vec<usize> {
        (0..self.steps[0].torques.len()).filter(|c| *c != self.root.forward).collect()
    }
}
