//! The search for gains: generations of candidates, and the choice among their means.

use super::gain::Gain;
use super::outcome::TrialOutcome;
use super::problem::TuningProblem;
use super::push::{Push, PushSettings, PushUse};
use crate::control::ControlSettings;
use crate::numerics::Cma;
use serde::{Deserialize, Serialize};

/// Standard deviation of the natural logarithm of each gain at the start: a gain changes by a third.
const FIRST_SIGMA: f64 = 0.3;

/// The state of a search. It can be saved; the search then continues with the same results.
///
/// Candidates of a generation are compared by pushes that no other generation has. The mean of each generation is
/// judged by one set of pushes that is always the same, and the mean that costs least there is the result; the first
/// mean is the start itself. So gains that are not better than those at the start are not chosen.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Tuning {
    pushes: PushSettings,
    optimiser: Cma,
    evaluations: usize,
    start: Option<Validated>,
    best: Option<Validated>,
}

/// A mean that was judged.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Validated {
    /// The point of the search ([`TuningProblem::settings_at`]).
    pub point: Vec<f64>,
    /// Outcome of the pushes that choose the result.
    pub outcome: TrialOutcome,
}

/// Something to be tried; tasks do not depend on each other.
#[derive(Debug, Clone, PartialEq)]
pub struct Task {
    /// The point of the search.
    pub point: Vec<f64>,
    /// Settings of the controller at this point.
    pub settings: ControlSettings,
    /// Pushes to simulate.
    pub pushes: Vec<Push>,
    /// Cost of the point for being outside the bounds.
    outside: f64,
}

impl Tuning {
    /// Starts a search at the settings of a problem.
    #[must_use]
    pub fn new(gains: &[Gain], pushes: PushSettings) -> Tuning {
        let optimiser = Cma::new(&vec![0.0; gains.len()], FIRST_SIGMA, pushes.seed);
        Tuning { pushes, optimiser, evaluations: 0, start: None, best: None }
    }

    /// Number of tasks of a generation of a search for so many gains: candidates and their mean.
    #[must_use]
    pub fn tasks(gains: usize) -> usize {
        Cma::candidates(gains) + 1
    }

    /// Whether a search that was read from a file has the numbers of a search for so many gains.
    #[must_use]
    pub fn is_valid(&self, gains: usize) -> bool {
        let known = [&self.start, &self.best].into_iter().flatten();
        let is_point = |point: &[f64]| point.len() == gains && point.iter().all(|x| x.is_finite());
        self.optimiser.is_valid(gains) && known.into_iter().all(|validated| is_point(&validated.point))
    }

    /// How pushes are drawn.
    #[must_use]
    pub fn pushes(&self) -> PushSettings {
        self.pushes
    }

    /// Number of tasks so far.
    #[must_use]
    pub fn evaluations(&self) -> usize {
        self.evaluations
    }

    /// Number of generations so far.
    #[must_use]
    pub fn generations(&self) -> u64 {
        self.optimiser.generations()
    }

    /// The start, once it was judged.
    #[must_use]
    pub fn start(&self) -> Option<&Validated> {
        self.start.as_ref()
    }

    /// The best mean so far.
    #[must_use]
    pub fn best(&self) -> Option<&Validated> {
        self.best.as_ref()
    }

    /// The mean of the present distribution, to be judged.
    #[must_use]
    pub fn mean(&self, problem: &TuningProblem) -> Task {
        self.task(problem, self.optimiser.mean().to_vec(), PushUse::Choice)
    }

    /// The tasks of the next generation: the mean first, which takes longest.
    pub fn ask(&mut self, problem: &TuningProblem) -> Vec<Task> {
        let mean = self.mean(problem);
        let of = PushUse::Search { generation: self.optimiser.generations() };
        let candidates = self.optimiser.ask();
        let candidates = candidates.into_iter().map(|point| self.task(problem, point, of));
        [mean].into_iter().chain(candidates).collect()
    }

    /// Takes the outcomes of the tasks of [`Tuning::ask`], in their order.
    pub fn tell(&mut self, tasks: &[Task], outcomes: &[TrialOutcome]) {
        let ([mean, candidates @ ..], [of_mean, of_candidates @ ..]) = (tasks, outcomes) else { return };
        self.judge(mean, *of_mean);
        let points: Vec<Vec<f64>> = candidates.iter().map(|task| task.point.clone()).collect();
        let costs = candidates.iter().zip(of_candidates).map(|(task, outcome)| outcome.cost + task.outside);
        self.optimiser.tell(&points, &costs.collect::<Vec<f64>>());
        self.evaluations += tasks.len();
    }

    /// Takes the outcome of [`Tuning::mean`].
    pub fn judge(&mut self, mean: &Task, outcome: TrialOutcome) {
        let judged = Validated { point: mean.point.clone(), outcome };
        // A cost that is not a number is not lower.
        if self.best.as_ref().is_none_or(|best| judged.outcome.cost < best.outcome.cost || best.outcome.cost.is_nan()) {
            self.best = Some(judged.clone());
        }
        self.start.get_or_insert(judged);
    }

    /// The pushes of the report, all with one force, a share of the largest one.
    #[must_use]
    pub fn report(&self, problem: &TuningProblem, point: &[f64], share: f64) -> Task {
        let mut task = self.task(problem, point.to_vec(), PushUse::Report);
        task.pushes.iter_mut().for_each(|push| push.force_n = self.pushes.force_n * share);
        task
    }

    fn task(&self, problem: &TuningProblem, point: Vec<f64>, of: PushUse) -> Task {
        let (settings, outside) = problem.settings_at(&point);
        Task { point, settings, pushes: self.pushes.pushes(of), outside }
    }
}
