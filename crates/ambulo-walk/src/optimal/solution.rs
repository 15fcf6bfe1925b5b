//! The solution of a problem: motion, forces and contacts at any time.

use super::instant::{Evaluator, Instant, SIDE_BY_SIDE};
use super::layout::Layout;
use super::objective::Quantity;
use super::problem::{Problem, Transcription};
use crate::dynamics::CurvedJointError;
use crate::model::CoordinateKind;
use crate::spatial::Vec3;
use std::fmt;

/// State of the solver at the end of a stage.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Progress {
    /// Steps of the solver.
    pub steps: usize,
    /// Sum of squares at the start, including constraints.
    pub from: f64,
    /// Sum of squares at the end, including constraints.
    pub cost: f64,
    /// Residual forces at the root: root mean square and maximum [body weights, body weights × length].
    pub root: (f64, f64),
}

/// The largest force at the root that nothing supplies.
#[derive(Debug, Clone, PartialEq)]
pub struct Unbalanced {
    /// Name of the coordinate of the root.
    pub coordinate: String,
    /// Time from the start of the span [s].
    pub time_s: f64,
    /// Generalised force [N or N.m].
    pub force: f64,
    /// Largest force that counts as none, in the same unit.
    pub allowed: f64,
    /// Whether the force is a moment.
    pub is_moment: bool,
}

impl fmt::Display for Unbalanced {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Unbalanced { coordinate, time_s, force, allowed, is_moment } = self;
        let unit = if *is_moment { "N.m" } else { "N" };
        write!(f, "at {time_s:.2} s `{coordinate}` needs {force:.2} {unit}; expected at most {allowed:.2} {unit}")
    }
}

/// One instant of a motion.
#[derive(Debug, Clone, PartialEq)]
pub struct Sample {
    /// Time from the start of the span [s].
    pub time_s: f64,
    /// Coordinates [rad or m], their rates and their accelerations.
    pub posture: [Vec<f64>; 3],
    /// Generalised force per coordinate [N.m or N]; forces of the root are residual forces.
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

    /// Duration of a cycle [s]; of a single movement, its own duration.
    #[must_use]
    pub fn cycle_s(&self) -> f64 {
        let half = self.layout.span == super::Span::MirroredHalfCycle;
        if half { 2.0 * self.problem.duration_s } else { self.problem.duration_s }
    }

    /// Mean speed of the travel [m/s].
    #[must_use]
    pub fn speed(&self) -> f64 {
        self.problem.travel.map_or(0.0, |(_, distance_m)| distance_m / self.problem.duration_s)
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
    /// [body weights, body weights × length]. With more instants than the problem has, this includes the residual
    /// between its instants.
    ///
    /// # Errors
    /// Does not fail for a solved problem.
    pub fn root_forces(&self, per_knot: usize) -> Result<(f64, f64), CurvedJointError> {
        let finer = Problem { instants_per_knot: per_knot, terms: Vec::new(), ..self.problem.clone() };
        let mut transcription = Transcription::new(&finer)?;
        transcription.evaluate_forces(&self.unknowns);
        Ok(transcription.root_forces())
    }

    /// The largest force at the root at the instants of the problem, if it exceeds `share` [body weights, body weights
    /// × length].
    #[must_use]
    pub fn unbalanced(&self, share: f64) -> Option<Unbalanced> {
        let step_s = self.problem.duration_s / (self.instants.len() - 1) as f64;
        let at = |(k, instant): (usize, &Instant)| {
            let forces =
                self.problem.root_scales().into_iter().map(|(id, scale)| (id, instant.forces[id.index()], scale));
            let worst = forces.max_by(|a, b| (a.1.abs() / a.2).total_cmp(&(b.1.abs() / b.2)))?;
            Some((k, worst))
        };
        let worst = self.instants.iter().enumerate().filter_map(at);
        let (k, (id, force, scale)) = worst.max_by(|(_, a), (_, b)| (a.1.abs() / a.2).total_cmp(&(b.1.abs() / b.2)))?;
        let coordinate = &self.problem.model.coordinates()[id.index()];
        let is_small = force.abs() <= share * scale;
        (!is_small).then(|| Unbalanced {
            coordinate: coordinate.name.clone(),
            time_s: step_s * k as f64,
            force,
            allowed: share * scale,
            is_moment: coordinate.kind == CoordinateKind::Rotation,
        })
    }

    /// Motion and forces at given times [s].
    ///
    /// # Errors
    /// Does not fail for a solved problem.
    pub fn samples(&self, times_s: &[f64]) -> Result<Vec<Sample>, CurvedJointError> {
        let mut evaluator = Evaluator::new(&self.problem.model, &self.problem.soles, &self.problem.levels_m)?;
        Ok(times_s.chunks(SIDE_BY_SIDE).flat_map(|times_s| self.block(&mut evaluator, times_s)).collect())
    }

    fn block(&self, evaluator: &mut Evaluator, times_s: &[f64]) -> Vec<Sample> {
        let mut instants: Vec<Instant> = times_s.iter().map(|&time_s| self.instant(time_s)).collect();
        evaluator.evaluate_forces(&self.problem.shoes, &mut instants);
        let sample = |(at, &time_s): (Instant, &f64)| {
            let contact = |c: &super::instant::Contact| SoleContact {
                place: c.place,
                force: c.values.force,
                height_m: c.values.height,
                slip: c.values.slip,
            };
            let contacts = at.contacts.iter().map(contact).collect();
            Sample { time_s, posture: at.posture, forces: at.forces, contacts }
        };
        instants.into_iter().zip(times_s).map(sample).collect()
    }

    /// Values of a quantity at the instants of the problem.
    pub fn values<'a>(&'a self, quantity: &'a Quantity) -> impl Iterator<Item = f64> + 'a {
        self.instants.iter().enumerate().map(|(index, at)| quantity.value(index, at))
    }

    /// Generalised forces at the instants of the problem [N.m or N].
    pub fn forces(&self) -> impl Iterator<Item = &[f64]> {
        self.instants.iter().map(|instant| instant.forces.as_slice())
    }

    /// Sum of the ground forces on some spheres at the instants of the problem, along x, y, z [N].
    pub fn ground_force<'a>(&'a self, spheres: &'a [usize]) -> impl Iterator<Item = [f64; 3]> + 'a {
        self.instants
            .iter()
            .map(|instant| [0, 1, 2].map(|axis| spheres.iter().map(|&s| instant.contacts[s].values.force[axis]).sum()))
    }
}
