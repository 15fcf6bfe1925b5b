//! Forward simulation of a solution: joints follow the planned motion, and the root moves freely under the resulting
//! forces.
//!
//! With the residual forces τ_r at the root for the planned accelerations, the accelerations of the root change by a,
//! where
//!
//!   M_rr a = -τ_r        M_rr = ∂τ_r/∂q̈_r
//!
//! They are integrated by the Runge-Kutta method of order 4. Nothing corrects the root, so residual forces, both at the
//! instants of the problem and between them, appear as drift.

use super::instant::{Evaluator, Instant};
use super::solution::Solution;
use crate::dynamics::CurvedJointError;
use crate::numerics::ProfileMatrix;

/// Maximum difference between a forward simulation and the planned motion.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Drift {
    /// Distance of the root from its planned position [m].
    pub place_m: f64,
    /// Difference of an angle of the root [rad].
    pub angle_rad: f64,
}

/// Positions and velocities of the root, one entry per coordinate.
type RootState = [Vec<f64>; 2];

impl Solution {
    /// Simulates the motion from its first state for a duration, in steps of `step_s`, with driven joints and a free
    /// root. Returns the maximum difference from the planned motion.
    ///
    /// # Errors
    /// Does not fail for a solved problem.
    pub fn forward(&self, duration_s: f64, step_s: f64) -> Result<Drift, CurvedJointError> {
        let problem = self.problem();
        let root = problem.root();
        let mut simulated = Rollout {
            solution: self,
            evaluator: Evaluator::new(&problem.model, &problem.soles, &problem.levels_m)?,
            instant: [self.instant(0.0)],
            root: root.iter().map(|(id, _)| id.index()).collect(),
        };
        let mut state = simulated.planned(0.0);
        let steps = (duration_s / step_s).round() as usize;
        let mut drift = Drift::default();
        for step in 0..steps {
            state = simulated.step(step as f64 * step_s, step_s, &state);
            let planned = simulated.planned((step + 1) as f64 * step_s);
            let mut square = 0.0;
            for ((value, plan), (_, turns)) in state[0].iter().zip(&planned[0]).zip(&root) {
                let apart = (value - plan).abs();
                if *turns {
                    drift.angle_rad = drift.angle_rad.max(apart);
                } else {
                    square += apart * apart;
                }
            }
            drift.place_m = drift.place_m.max(square.sqrt());
        }
        Ok(drift)
    }
}

struct Rollout<'a> {
    solution: &'a Solution,
    evaluator: Evaluator,
    instant: [Instant; 1],
    /// Coordinates of the root.
    root: Vec<usize>,
}

impl Rollout<'_> {
    fn planned(&mut self, time_s: f64) -> RootState {
        self.solution.write(time_s, &mut self.instant[0].posture);
        [0, 1].map(|part| self.root.iter().map(|&c| self.instant[0].posture[part][c]).collect())
    }

    /// Accelerations of the root at a time and in a state.
    fn accelerations(&mut self, time_s: f64, [place, velocity]: &RootState) -> Vec<f64> {
        self.solution.write(time_s, &mut self.instant[0].posture);
        let posture = &mut self.instant[0].posture;
        for (k, &c) in self.root.iter().enumerate() {
            posture[0][c] = place[k];
            posture[1][c] = velocity[k];
        }
        self.evaluator.evaluate(&self.solution.problem().shoes, &mut self.instant);
        let at = &self.instant[0];
        let count = at.forces.len();
        let mut mass = ProfileMatrix::zeros(vec![0; self.root.len()]);
        for (i, &row) in self.root.iter().enumerate() {
            for (j, &column) in self.root.iter().enumerate().take(i + 1) {
                mass.add(i, j, at.slopes[(3 * row + 2) * count + column]);
            }
        }
        let mut change: Vec<f64> = self.root.iter().map(|&c| -at.forces[c]).collect();
        if let Some(factor) = mass.factor() {
            factor.solve(&mut change);
        }
        self.root.iter().zip(change).map(|(&c, change)| at.posture[2][c] + change).collect()
    }

    fn step(&mut self, time_s: f64, step_s: f64, state: &RootState) -> RootState {
        let moved = |by: f64, rates: &RootState| -> RootState {
            [0, 1].map(|part| state[part].iter().zip(&rates[part]).map(|(x, rate)| x + by * rate).collect())
        };
        let mut rates = |time_s: f64, at: &RootState| -> RootState { [at[1].clone(), self.accelerations(time_s, at)] };
        let first = rates(time_s, state);
        let second = rates(time_s + 0.5 * step_s, &moved(0.5 * step_s, &first));
        let third = rates(time_s + 0.5 * step_s, &moved(0.5 * step_s, &second));
        let fourth = rates(time_s + step_s, &moved(step_s, &third));
        let mean = [0, 1].map(|part| {
            (0..self.root.len())
                .map(|k| (first[part][k] + 2.0 * (second[part][k] + third[part][k]) + fourth[part][k]) / 6.0)
                .collect()
        });
        moved(step_s, &mean)
    }
}
