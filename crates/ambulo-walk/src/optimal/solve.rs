//! The solution: Levenberg and Marquardt's method inside an augmented Lagrangian.
//!
//! A step solves (A + λ diag A) Δ = -b with the normal equations A, b of the residuals. The damping λ changes with the
//! ratio of the decrease of the cost to the decrease of its quadratic model, -bᵀΔ + λ Δᵀ diag A Δ (Levenberg 1944,
//! Marquardt 1963; unverified).
//!
//! A multiplier m stands for the force m / s² of its constraint, where s is the slack. This force is kept from stage to
//! stage, so m changes with s².

use super::error::OptimalWalkError;
use super::normal::{NormalEquations, empty_matrix};
use super::observer::Observer;
use super::problem::{Problem, Stage, Transcription};
use super::solution::{Progress, Solution};
use crate::contact::HuntCrossley;
use crate::dynamics::CurvedJointError;
use crate::model::CoordinateId;

/// One stage of a solution: an easier problem whose solution starts the next one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Continuation {
    /// Factor of the stiffness of the shoes.
    pub stiffness: f64,
    /// Factor of the speed at which their friction sets in.
    pub creep: f64,
    /// Factor of the deviation of slip that costs 1.
    pub slip: f64,
    /// Force at the root that costs one [body weights, body weights × length].
    pub slack: f64,
    /// Largest number of updates of the multipliers. They end when no force at the root is above the slack.
    pub updates: usize,
    /// Largest number of steps before each update.
    pub steps: usize,
    /// A step that lowers the cost by less than this share is the last one before an update.
    pub gain: f64,
}

impl Continuation {
    /// The last one of some stages, with more updates; none without stages.
    pub(super) fn on(stages: &[Continuation]) -> Vec<Continuation> {
        stages.last().map(|last| Continuation { updates: LATER_UPDATES, ..*last }).into_iter().collect()
    }
}

const FIRST_DAMPING: f64 = 1e-3;
const LEAST_DAMPING: f64 = 1e-7;
/// Factor of the damping after a step that does not lower the cost.
const MORE_DAMPING: f64 = 10.0;
/// Factors of the damping after a step, and the ratios of decrease and predicted decrease above which they are used.
const LESS_DAMPING: [(f64, f64); 2] = [(0.75, 0.1), (0.25, 0.5)];
/// Entry of the diagonal of an unknown that keeps its value: it then moves by less than rounding.
const HELD: f64 = 1e40;
/// Attempts per step to lower the cost.
const TRIES: usize = 12;
/// Accuracy of the first height over the ground, a share of the length of the body.
const SETTLED: f64 = 1e-7;
/// Largest force and moment at the root that count as none [body weights, body weights × leg length].
pub const NO_ROOT_FORCE: f64 = 1e-4;
/// Updates of the multipliers in a stage that is solved on.
const LATER_UPDATES: usize = 10;

impl Problem {
    /// Solves the problem from a first guess, stage by stage.
    ///
    /// # Errors
    /// If the model has joints that are not hinges or slides, or the observer stops the solver.
    pub fn solve(&self, guess: &[f64], stages: &[Continuation]) -> Result<Solution, OptimalWalkError> {
        self.solve_keeping(guess, stages, &[])
    }

    /// As [`Problem::solve`], but the unknowns with the numbers `kept` keep the value of the first guess.
    ///
    /// # Errors
    /// As [`Problem::solve`].
    pub(crate) fn solve_keeping(
        &self,
        guess: &[f64],
        stages: &[Continuation],
        kept: &[usize],
    ) -> Result<Solution, OptimalWalkError> {
        let mut method = Method::new(self, kept)?;
        let mut unknowns = guess.to_vec();
        let (mut progress, mut slack) = (Vec::new(), 1.0);
        method.transcription.evaluate(&unknowns);
        for stage in stages {
            method.transcription.stage = Stage {
                shoes: HuntCrossley {
                    stiffness: self.shoes.stiffness * stage.stiffness,
                    transition_velocity: self.shoes.transition_velocity * stage.creep,
                    ..self.shoes
                },
                slack: stage.slack,
                slip: stage.slip,
            };
            method.transcription.scale_multipliers((stage.slack / slack).powi(2));
            slack = stage.slack;
            let (from, mut steps) = (method.cost(&unknowns), 0);
            for update in 0..=stage.updates {
                if update > 0 {
                    if method.transcription.root_forces().1 <= slack {
                        break;
                    }
                    method.transcription.update_multipliers();
                }
                steps += method.minimise(&mut unknowns, stage)?;
            }
            let (cost, root) = (method.transcription.cost(), method.transcription.root_forces());
            progress.push(Progress { steps, from, cost, root });
        }
        let instants = method.transcription.instants().to_vec();
        Ok(Solution::new(self, unknowns, instants, progress))
    }
}

impl Problem {
    /// A solution as it is, or solved on by one attempt after the other while it leaves forces at the root. Its
    /// progress covers all attempts.
    pub(super) fn balanced(
        &self,
        mut solution: Solution,
        attempts: &[&[Continuation]],
        kept: &[usize],
    ) -> Result<Solution, OptimalWalkError> {
        for stages in attempts {
            if solution.unbalanced(NO_ROOT_FORCE).is_none() {
                break;
            }
            let mut next = self.solve_keeping(solution.unknowns(), stages, kept)?;
            next.progress.splice(0..0, solution.progress);
            solution = next;
        }
        Ok(solution)
    }

    /// The cost of each term at given unknowns, with its name.
    #[must_use]
    pub fn costs(&self, unknowns: &[f64]) -> Vec<(String, f64)> {
        let Ok(mut transcription) = Transcription::new(self) else { return Vec::new() };
        transcription.evaluate(unknowns);
        transcription.costs()
    }

    /// The motion of given unknowns, which are not changed.
    ///
    /// # Errors
    /// If the model has joints that are not hinges or slides.
    pub fn at(&self, unknowns: &[f64]) -> Result<Solution, CurvedJointError> {
        let mut transcription = Transcription::new(self)?;
        transcription.evaluate(unknowns);
        let (cost, root) = (transcription.cost(), transcription.root_forces());
        let progress = vec![Progress { steps: 0, from: cost, cost, root }];
        Ok(Solution::new(self, unknowns.to_vec(), transcription.instants().to_vec(), progress))
    }

    /// Moves a coordinate, the height of the body, until the ground carries the body's weight on average.
    ///
    /// # Errors
    /// If the model has joints that are not hinges or slides.
    pub fn settle(&self, unknowns: &mut [f64], height: CoordinateId) -> Result<(), CurvedJointError> {
        let mut transcription = Transcription::new(self)?;
        let width = self.model.coordinates().len();
        let (mut low, mut high) = (-0.2 * self.length_m, 0.2 * self.length_m);
        let start: Vec<f64> = unknowns.to_vec();
        while high - low > SETTLED * self.length_m {
            let middle = 0.5 * (low + high);
            for (x, from) in unknowns.iter_mut().zip(&start).skip(height.index()).step_by(width) {
                *x = from + middle;
            }
            transcription.evaluate_forces(unknowns);
            if transcription.mean_load() > self.weight_n() { low = middle } else { high = middle }
        }
        Ok(())
    }
}

struct Method<'a> {
    /// Numbers of the unknowns that keep their value.
    kept: &'a [usize],
    observer: &'a Observer,
    transcription: Transcription<'a>,
    normal: NormalEquations,
    damping: f64,
}

impl<'a> Method<'a> {
    fn new(problem: &'a Problem, kept: &'a [usize]) -> Result<Method<'a>, CurvedJointError> {
        let transcription = Transcription::new(problem)?;
        let normal = NormalEquations::new(&transcription.layout);
        Ok(Method { kept, observer: &problem.observer, transcription, normal, damping: FIRST_DAMPING })
    }

    fn cost(&mut self, unknowns: &[f64]) -> f64 {
        self.transcription.evaluate(unknowns);
        self.transcription.cost()
    }

    /// Improves the unknowns; returns the number of steps taken. Before and after, the instants belong to the unknowns.
    fn minimise(&mut self, unknowns: &mut [f64], stage: &Continuation) -> Result<usize, OptimalWalkError> {
        self.damping = self.damping.min(FIRST_DAMPING);
        let mut cost = self.transcription.cost();
        for step in 0..stage.steps {
            self.observer.step().map_err(|steps| OptimalWalkError::Stopped { steps })?;
            let Some(after) = self.step(unknowns, cost) else { return Ok(step) };
            let gain = cost - after;
            cost = after;
            if gain < stage.gain * cost {
                return Ok(step + 1);
            }
        }
        Ok(stage.steps)
    }

    /// A step that lowers the cost, and the lower cost.
    fn step(&mut self, unknowns: &mut [f64], cost: f64) -> Option<f64> {
        let layout = self.transcription.layout.clone();
        self.transcription.linearise(&mut self.normal);
        let mut matrix = empty_matrix(&layout);
        let mut right = vec![0.0; unknowns.len()];
        self.normal.fold(&layout, &mut matrix, &mut right);
        for &k in self.kept {
            matrix.add(k, k, HELD);
            right[k] = 0.0;
        }
        let diagonal = matrix.diagonal();
        self.transcription.exchange_base();
        for _ in 0..TRIES {
            let mut damped = matrix.clone();
            damped.raise_diagonal(self.damping, f64::EPSILON);
            if let Some(factor) = damped.factor() {
                let mut change = right.clone();
                factor.solve(&mut change);
                let predicted: f64 =
                    (0..change.len()).map(|i| change[i] * (right[i] + self.damping * diagonal[i] * change[i])).sum();
                let moved = |change: &[f64]| -> Vec<f64> { unknowns.iter().zip(change).map(|(x, d)| x - d).collect() };
                let plain = moved(&change);
                self.transcription.evaluate_forces(&plain);
                let plain_cost = self.transcription.cost();
                // The forces at the root bend along the step; a second step takes them back.
                let negative: Vec<f64> = change.iter().map(|d| -d).collect();
                self.transcription.curvature_of_root(&negative, &mut self.normal);
                let mut bend = self.normal.fold_right(&layout);
                self.kept.iter().for_each(|&k| bend[k] = 0.0);
                factor.solve(&mut bend);
                for (d, b) in change.iter_mut().zip(&bend) {
                    *d += b;
                }
                let bent = moved(&change);
                let bent_cost = self.cost(&bent);
                let (next, after) = if bent_cost <= plain_cost { (bent, bent_cost) } else { (plain, plain_cost) };
                if after < cost {
                    if bent_cost > plain_cost {
                        self.transcription.evaluate(&next);
                    }
                    let ratio = (cost - after) / predicted;
                    let less = LESS_DAMPING.iter().find(|(above, _)| ratio > *above).map_or(1.0, |(_, factor)| *factor);
                    self.damping = (self.damping * less).max(LEAST_DAMPING);
                    unknowns.copy_from_slice(&next);
                    return Some(after);
                }
            }
            self.damping *= MORE_DAMPING;
        }
        self.transcription.evaluate(unknowns);
        None
    }
}
