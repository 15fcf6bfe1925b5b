//! The motion that was found.

use super::instant::Instant;
use super::layout::Layout;
use super::problem::{Problem, Transcription};
use super::solve::Progress;
use crate::dynamics::CurvedJointError;

/// A motion that solves a problem.
#[derive(Debug, Clone)]
pub struct Solution {
    problem: Problem,
    layout: Layout,
    unknowns: Vec<f64>,
    extended: Vec<f64>,
    instants: Vec<Instant>,
    /// Course of the solution, one entry per stage.
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

    /// The unknowns, for the start of a similar problem.
    #[must_use]
    pub fn unknowns(&self) -> &[f64] {
        &self.unknowns
    }

    /// Writes coordinates, rates and accelerations at a time [s]; a repeated motion goes on for ever.
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

    /// Forces at the root that nothing supplies, at `per_knot` instants of each knot interval: root mean square and largest
    /// [body weights, body weights × length]. With more instants than the problem has, this is what is left between them.
    ///
    /// # Errors
    /// None for a problem that was solved.
    pub fn root_forces(&self, per_knot: usize) -> Result<(f64, f64), CurvedJointError> {
        let finer = Problem { instants_per_knot: per_knot, terms: Vec::new(), ..self.problem.clone() };
        let mut transcription = Transcription::new(&finer)?;
        transcription.evaluate(&self.unknowns);
        Ok(transcription.root_forces())
    }

    /// Generalised forces at the instants of the problem [N.m or N].
    pub fn forces(&self) -> impl Iterator<Item = &[f64]> {
        self.instants.iter().map(|instant| instant.forces.as_slice())
    }

    /// Force of the ground on some spheres together at the instants of the problem, along x, y, z [N].
    pub fn ground_force<'a>(&'a self, spheres: &'a [usize]) -> impl Iterator<Item = [f64; 3]> + 'a {
        self.instants.iter().map(|instant| {
            [0, 1, 2].map(|axis| spheres.iter().map(|&s| instant.contacts[s].values[axis]).sum())
        })
    }
}
