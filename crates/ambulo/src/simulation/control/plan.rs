//! The planned walk at the time steps of the simulator.

use super::settings::ControlError;
use crate::model::anthropometry::Human;
use crate::model::{Model, Side};
use crate::optimal::{Sample, Solution};
use std::f64::consts::TAU;

/// Fewest and most time steps of a cycle.
const STEPS: [usize; 2] = [100, 5000];

/// Share of the body weight at which a foot strikes.
pub(super) const STRIKE: f64 = 0.05;

/// Coordinates, rates and torques of the plan in one time step.
#[derive(Debug, Clone)]
pub(super) struct PlannedStep {
    /// Coordinates and rates at its start.
    pub(super) state: [Vec<f64>; 2],
    /// Coordinates and rates in its middle, the targets of the impedance.
    pub(super) target: [Vec<f64>; 2],
    /// Torques in its middle [N.m], one per coordinate.
    pub(super) torques: Vec<f64>,
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
pub(super) struct CyclePlan {
    pub(super) steps: Vec<PlannedStep>,
    /// Numbers of the steps in which the right and the left foot strike: their load passes [`STRIKE`].
    pub(super) strikes: [usize; 2],
    pub(super) root: Root,
}

/// Numbers of the coordinates of the root.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Root {
    pub(super) forward: usize,
    pub(super) up: usize,
    /// To the right; a planar figure has none.
    pub(super) sideways: Option<usize>,
    /// Rotations.
    pub(super) turns: Vec<usize>,
}

impl Root {
    pub(super) fn of(model: &Model) -> Root {
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
    pub(super) fn new(human: &Human, solution: &Solution, step_s: f64) -> Result<CyclePlan, ControlError> {
        let cycle_s = solution.cycle_s();
        let found = (cycle_s / step_s).round() as usize;
        if !(STEPS[0]..=STEPS[1]).contains(&found) {
            return Err(ControlError::Steps { found, least: STEPS[0], most: STEPS[1] });
        }
        // The cycle becomes a whole number of steps, which changes its duration by less than half a step.
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
        Ok(CyclePlan { steps: steps.collect(), strikes, root: Root::of(&human.model) })
    }

    /// Replaces the torques by their mean and the first `count` harmonics.
    pub(super) fn keep_harmonics(&mut self, count: usize) {
        let steps = self.steps.len() as f64;
        let wave = |k: usize, harmonic: usize| (TAU * harmonic as f64 * (k as f64 + 0.5) / steps).sin_cos();
        for c in 0..self.steps[0].torques.len() {
            let torques: Vec<f64> = self.steps.iter().map(|step| step.torques[c]).collect();
            let mut kept = vec![torques.iter().sum::<f64>() / steps; torques.len()];
            for harmonic in 1..=count {
                let part = |of: fn((f64, f64)) -> f64| {
                    torques.iter().enumerate().map(|(k, torque)| torque * of(wave(k, harmonic))).sum::<f64>() * 2.0
                        / steps
                };
                let (sine, cosine) = (part(|wave| wave.0), part(|wave| wave.1));
                for (k, kept) in kept.iter_mut().enumerate() {
                    let (sin, cos) = wave(k, harmonic);
                    *kept += sine * sin + cosine * cos;
                }
            }
            self.steps.iter_mut().zip(kept).for_each(|(step, kept)| step.torques[c] = kept);
        }
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
    pub(super) fn joints(&self) -> Vec<usize> {
        (0..self.steps[0].torques.len()).filter(|c| !self.root.contains(*c)).collect()
    }

    /// The coordinates of the state: all but the place along the ground.
    pub(super) fn places(&self) -> Vec<usize> {
        (0..self.steps[0].torques.len()).filter(|c| *c != self.root.forward).collect()
    }
}
