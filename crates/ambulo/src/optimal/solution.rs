//! The solution of a problem: motion, forces and contacts at any time.

use super::instant::{Evaluator, HEIGHT, Instant, SLIP};
use super::layout::Layout;
use super::problem::{Problem, Transcription};
use crate::dynamics::CurvedJointError;
use crate::spatial::Vec3;

/// State of the solver at the end of a stage.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Progress {
    /// Steps of the solver.
    pub steps: usize,
    /// Sum of squares, including that of the constraints.
    pub cost: f64,
    /// Residual forces at the root: root mean square and maximum [body weights, body weights × length].
    pub root: (f64, f64),
}

/// One instant of a motion.
#[derive(Debug, Clone, PartialEq)]
pub struct Sample {
    /// Time from the start of the span [s].
    pub time_s: f64,
    /// Coordinates [rad or m], their rates and their accelerations.
    pub posture: [Vec<f64>; 3],
    /// Generalised force per coordinate [N.m or N]; those of the root are residual forces.
    pub forces: Vec<f64>,
    /// Contact with the ground per sphere of the problem.
    pub contacts: Vec<SoleContact>,
}

/// Contact of one sphere with the ground.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SoleContact {
    /// Position of the contact point [m].
    pub place: Vec3,
    /// Force of the ground on the foot [N].
    pub force: Vec3,
    /// Height of the sphere's lowest point [m].
    pub height_m: f64,
    /// Velocity of the contact point along x and z [m/s].
    pub slip: [f64; 2],
}

impl Sample {
    /// Sum of the ground forces on some spheres [N].
    #[must_use]
    pub fn ground_force(&self, spheres: &[usize]) -> Vec3 {
        spheres.iter().fold(Vec3::zeros(), |sum, &s| sum + self.contacts[s].force)
    }
}

/// A motion that solves a problem.
#[derive(Debug, Clone)]
pub struct Solution {
    problem: Problem,
    layout: Layout,
    unknowns: Vec<f64>,
    extended: Vec<f64>,
    instants: Vec<Instant>,
    /// State of the solver after each stage.
    pub progress: Vec<Progress>,
}

impl Solution {
    pub(super) fn new(
        problem: &Problem,
        unknowns: Vec<f64>,
        instants: Vec<Instant>,
        progress: Vec<Progress>,
    ) -> Solution {
        let layout = problem.layout();
        let extended = layout.extended(&unknowns);
        Solution { problem: problem.clone(), layout, unknowns, extended, instants, progress }
    }

    /// The problem.
    #[must_use]
    pub fn problem(&self) -> &Problem {
        &self.problem
    }

    /// The unknowns; a similar problem can start from them.
    #[must_use]
    pub fn unknowns(&self) -> &[f64] {
        &self.unknowns
    }

    /// Writes coordinates, rates and accelerations at a time [s]. A repeated motion has no end.
    pub fn write(&self, time_s: f64, posture: &mut [Vec<f64>; 3]) {
        let spans = time_s / self.problem.duration_s;
        let whole = if self.layout.span == super::Span::Single { 0.0 } else { spans.floor() };
        let share = (spans - whole).clamp(0.0, 1.0);
        let interval = ((share * self.layout.knots as f64) as usize).min(self.layout.knots - 1);
        let weights = self.layout.weights(share, interval);
        let rate = 1.0 / self.problem.duration_s;
        let mirrored = self.layout.span == super::Span::MirroredHalfCycle && whole.rem_euclid(2.0) > 0.5;
        for ((values, weights), factor) in posture.iter_mut().zip(&weights.values).zip([1.0, rate, rate * rate]) {
            for c in 0..self.layout.width {
                let (from, sign) = if mirrored { self.layout.mirrored(c) } else { (c, 1.0) };
                let blocks = self.extended.chunks(self.layout.width).skip(interval);
                values[c] = sign * factor * weights.iter().zip(blocks).map(|(w, block)| w * block[from]).sum::<f64>();
            }
        }
        self.problem.add_travel(whole + share, posture);
    }

    /// The posture at a time, without forces.
    pub(super) fn instant(&self, time_s: f64) -> Instant {
        let empty = || vec![0.0; self.layout.width];
        let mut posture = [empty(), empty(), empty()];
        self.write(time_s, &mut posture);
        Instant { posture, ..Instant::default() }
    }

    /// Residual forces at the root at `per_knot` instants per knot interval: root mean square and maximum
    /// [body weights, body weights × length]. With more instants than the problem has, this includes the residual between its instants.
    ///
    /// # Errors
    /// Does not fail for a solved problem.
    pub fn root_forces(&self, per_knot: usize) -> Result<(f64, f64), CurvedJointError> {
        let finer = Problem { instants_per_knot: per_knot, terms: Vec::new(), ..self.problem.clone() };
        let mut transcription = Transcription::new(&finer)?;
        transcription.evaluate(&self.unknowns);
        Ok(transcription.root_forces())
    }

    /// Motion and forces at given times [s].
    ///
    /// # Errors
    /// Does not fail for a solved problem.
    pub fn samples(&self, times_s: &[f64]) -> Result<Vec<Sample>, CurvedJointError> {
        let mut instants: Vec<Instant> = times_s.iter().map(|&time_s| self.instant(time_s)).collect();
        Evaluator::new(&self.problem.model, &self.problem.soles)?.evaluate(&self.problem.shoes, &mut instants);
        let sample = |(at, &time_s): (Instant, &f64)| {
            let contact = |c: &super::instant::Contact| SoleContact {
                place: c.place,
                force: Vec3::new(c.values[0], c.values[1], c.values[2]),
                height_m: c.values[HEIGHT],
                slip: [c.values[SLIP], c.values[SLIP + 1]],
            };
            let contacts = at.contacts.iter().map(contact).collect();
            Sample { time_s, posture: at.posture, forces: at.forces, contacts }
        };
        Ok(instants.into_iter().zip(times_s).map(sample).collect())
    }

    /// Generalised forces at the instants of the problem [N.m or N].
    pub fn forces(&self) -> impl Iterator<Item = &[f64]> {
        self.instants.iter().map(|instant| instant.forces.as_slice())
    }

    /// Sum of the ground forces on some spheres at the instants of the problem, along x, y, z [N].
    pub fn ground_force<'a>(&'a self, spheres: &'a [usize]) -> impl Iterator<Item = [f64; 3]> + 'a {
        self.instants
            .iter()
            .map(|instant| [0, 1, 2].map(|axis| spheres.iter().map(|&s| instant.contacts[s].values[axis]).sum()))
    }
}
