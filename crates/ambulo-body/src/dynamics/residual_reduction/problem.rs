//! The least-squares problem of residual reduction, solved by the Gauss-Newton method.

use super::adjustable_body::AdjustableBody;
use super::bordered::BorderedSystem;
use super::frame::{FootPose, FrameEvaluator, FrameSlopes, root_slope, six};
use super::settings::{ResidualReductionError, ResidualReductionSettings};
use super::splines::{CorrectionSplines, Instant, Region, SplineWeights};
use crate::dynamics::{BodyLoad, LoadSeries, Workspace};
use crate::kinematics::Trajectory;
use crate::numerics::elementary::powi;
use crate::spatial::Wrench;

/// Step of the finite differences by parameters of the body [share or m].
const NUDGE: f64 = 1e-4;
/// Iterations end when the cost falls by less than this share.
const SETTLED: f64 = 1e-6;
/// Maximum number of halvings of a step that does not lower the cost.
const HALVINGS: usize = 6;

/// All terms of the cost.
pub(super) struct ReductionProblem<'a> {
    pub(super) trajectory: &'a Trajectory,
    pub(super) loads: &'a [LoadSeries],
    pub(super) region: Region,
    pub(super) splines: CorrectionSplines,
    pub(super) body: AdjustableBody<'a>,
    pub(super) evaluator: FrameEvaluator,
    /// Foot poses of the recorded motion, one entry per frame of the region.
    pub(super) recorded_feet: Vec<Vec<FootPose>>,
    /// Standard deviations: force and moment at the root; displacement and rotation of a foot.
    pub(super) root_scale: [f64; 6],
    pub(super) foot_scale: [f64; 6],
    pub(super) settings: ResidualReductionSettings,
}

/// The unknowns.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Unknowns {
    /// Spline coefficients.
    pub(super) coefficients: Vec<f64>,
    /// Parameters of the body.
    pub(super) numbers: Vec<f64>,
}

/// How the iteration ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Termination {
    pub(super) iterations: usize,
    pub(super) converged: bool,
}

impl ReductionProblem<'_> {
    /// Gauss-Newton iterations; a step that raises the cost is halved.
    pub(super) fn solve(&self) -> Result<(Unknowns, Termination), ResidualReductionError> {
        let mut at =
            Unknowns { coefficients: vec![0.0; self.splines.unknowns()], numbers: vec![0.0; self.body.count()] };
        let mut cost = self.cost(&at)?;
        for iteration in 1..=self.settings.most_iterations {
            let equations = self.linearise(&at)?;
            let ranges: Vec<[f64; 2]> = at.numbers.iter().enumerate().map(|(k, x)| self.range(k, *x)).collect();
            let (dx, dy) = equations.solve(&ranges).ok_or(ResidualReductionError::Singular { iteration })?;
            let Some((better, lower)) = self.along(&at, cost, &dx, &dy)? else {
                return Ok((at, Termination { iterations: iteration, converged: self.splines.is_small(&dx) }));
            };
            let settled = cost - lower <= SETTLED * cost;
            (at, cost) = (better, lower);
            if settled {
                return Ok((at, Termination { iterations: iteration, converged: true }));
            }
        }
        Ok((at, Termination { iterations: self.settings.most_iterations, converged: false }))
    }

    /// Range of the next step of a parameter of the body.
    fn range(&self, number: usize, at: f64) -> [f64; 2] {
        let [_, most] = self.body.tolerance_and_most(number);
        [-most - at, most - at]
    }

    /// Weight of a parameter of the body. Errors of a motion vary little along a trial (skin, marker placement,
    /// lengths), and a wrong parameter acts in every frame: it costs as much as a constant offset of a coordinate
    /// throughout the window.
    fn trust(&self, number: usize) -> f64 {
        self.region.window.len() as f64 * self.body.tolerance_and_most(number)[0].powi(-2)
    }

    /// The first point along a step that lowers the cost, with its cost.
    fn along(
        &self,
        at: &Unknowns,
        cost: f64,
        dx: &[f64],
        dy: &[f64],
    ) -> Result<Option<(Unknowns, f64)>, ResidualReductionError> {
        for halving in 0..HALVINGS {
            let share = powi(0.5_f64, halving as i32);
            let moved = |x: &[f64], d: &[f64]| x.iter().zip(d).map(|(x, d)| x + share * d).collect();
            let there = Unknowns { coefficients: moved(&at.coefficients, dx), numbers: moved(&at.numbers, dy) };
            let there_cost = self.cost(&there)?;
            if there_cost < cost {
                return Ok(Some((there, there_cost)));
            }
        }
        Ok(None)
    }

    /// Sum of squares at a point.
    fn cost(&self, at: &Unknowns) -> Result<f64, ResidualReductionError> {
        let mut workspace = Workspace::new(&self.body.with(&at.numbers)?);
        let mut instant = Instant::zeros(self.trajectory.columns().len());
        let mut loads = Vec::new();
        let mut cost = 0.0;
        for (recorded_feet, frame) in self.recorded_feet.iter().zip(self.region.frames.clone()) {
            self.splines.write(self.trajectory, frame, &at.coefficients, &mut instant);
            self.loads_at(frame, &mut loads);
            let (root, feet) = self.evaluator.evaluate(&mut workspace, &instant, &loads);
            if self.region.window.contains(&frame) {
                cost += squares(&six(&root), &self.root_scale);
            }
            for (place, before) in feet.iter().zip(recorded_feet) {
                cost += squares(&place.displacement_from(before), &self.foot_scale);
            }
            let spline = self.splines.at(frame);
            for (k, [value, acceleration]) in self.splines.tolerances(frame).enumerate() {
                let [change, _, second] = self.splines.change(&spline, &at.coefficients, k);
                cost += (change / value).powi(2) + (second / acceleration).powi(2);
            }
        }
        let prior = |(k, x): (usize, &f64)| self.trust(k) * x * x;
        Ok(cost + at.numbers.iter().enumerate().map(prior).sum::<f64>())
    }

    /// The loads of a frame; none outside the window, where they may not be finite.
    fn loads_at(&self, frame: usize, loads: &mut Vec<BodyLoad>) {
        loads.clear();
        if self.region.window.contains(&frame) {
            loads.extend(self.loads.iter().map(|load| load.at(frame)));
        }
    }

    /// Residual wrench at the root in each frame of the window.
    pub(super) fn root_residuals(&self, at: &Unknowns) -> Result<Vec<Wrench>, ResidualReductionError> {
        let mut workspace = Workspace::new(&self.body.with(&at.numbers)?);
        let mut instant = Instant::zeros(self.trajectory.columns().len());
        let mut loads = Vec::new();
        let mut list = Vec::with_capacity(self.region.window.len());
        for frame in self.region.window.clone() {
            self.splines.write(self.trajectory, frame, &at.coefficients, &mut instant);
            self.loads_at(frame, &mut loads);
            list.push(self.evaluator.evaluate(&mut workspace, &instant, &loads).0);
        }
        Ok(list)
    }

    /// The normal equations, linearised at a point.
    fn linearise(&self, at: &Unknowns) -> Result<BorderedSystem, ResidualReductionError> {
        let numbers = self.body.count();
        let mut equations = BorderedSystem::zeros(self.splines.unknowns(), self.splines.bands(), numbers);
        let mut workspace = Workspace::new(&self.body.with(&at.numbers)?);
        let mut nudged = self.nudged(at)?;
        let mut instant = Instant::zeros(self.trajectory.columns().len());
        let (mut loads, mut slopes, mut local) = (Vec::new(), FrameSlopes::default(), FrameEquations::default());
        for (recorded_feet, frame) in self.recorded_feet.iter().zip(self.region.frames.clone()) {
            self.splines.write(self.trajectory, frame, &at.coefficients, &mut instant);
            self.loads_at(frame, &mut loads);
            let spline = self.splines.at(frame);
            let enforced = self.region.window.contains(&frame);
            local.clear(spline.count * self.splines.coordinates.len(), numbers);
            let (root, feet) = self.evaluator.evaluate(&mut workspace, &instant, &loads);
            self.evaluator.slopes(
                &mut workspace,
                &self.splines,
                &mut instant,
                &loads,
                if enforced { 3 } else { 1 },
                &mut slopes,
            );
            if enforced {
                let of_body: Vec<[f64; 6]> = nudged
                    .iter_mut()
                    .map(|other| root_slope(&root, &self.evaluator.evaluate(other, &instant, &loads).0, NUDGE))
                    .collect();
                local.add_root(&spline, &six(&root), &slopes.root, &of_body, &self.root_scale);
            }
            for (foot, (place, before)) in slopes.feet.iter().zip(feet.iter().zip(recorded_feet)) {
                local.add_foot(&spline, &place.displacement_from(before), foot, &self.foot_scale);
            }
            for (k, tolerances) in self.splines.tolerances(frame).enumerate() {
                let change = self.splines.change(&spline, &at.coefficients, k);
                local.add_change(&spline, change, tolerances, k, self.splines.coordinates.len());
            }
            local.spread(spline.first * self.splines.coordinates.len(), &mut equations);
        }
        for (k, x) in at.numbers.iter().enumerate() {
            let weight = self.trust(k);
            equations.corner[(k, k)] += weight;
            equations.corner_right[k] -= weight * x;
        }
        Ok(equations)
    }

    /// Workspaces of the model with each parameter increased by a small step.
    fn nudged(&self, at: &Unknowns) -> Result<Vec<Workspace>, ResidualReductionError> {
        let one = |k: usize| {
            let mut numbers = at.numbers.clone();
            numbers[k] += NUDGE;
            Ok(Workspace::new(&self.body.with(&numbers)?))
        };
        (0..self.body.count()).map(one).collect()
    }
}

fn squares(values: &[f64; 6], scale: &[f64; 6]) -> f64 {
    values.iter().zip(scale).map(|(x, s)| (x / s).powi(2)).sum()
}

/// Normal equations of the unknowns of one frame and the parameters of the body.
#[derive(Debug, Clone, Default)]
struct FrameEquations {
    size: usize,
    numbers: usize,
    /// Lower triangle by rows, the parameters of the body last.
    matrix: Vec<f64>,
    right: Vec<f64>,
    row: Vec<f64>,
}

impl FrameEquations {
    fn clear(&mut self, size: usize, numbers: usize) {
        let whole = size + numbers;
        (self.size, self.numbers) = (size, numbers);
        for (list, length) in [(&mut self.matrix, whole * whole), (&mut self.right, whole), (&mut self.row, whole)] {
            list.clear();
            list.resize(length, 0.0);
        }
    }

    /// Adds one residual whose derivatives are in `row`.
    fn add_row(&mut self, residual: f64) {
        let whole = self.size + self.numbers;
        for i in 0..whole {
            let a = self.row[i];
            self.right[i] -= a * residual;
            for (m, b) in self.matrix[i * whole..=i * whole + i].iter_mut().zip(&self.row) {
                *m += a * b;
            }
        }
    }

    fn add_root(
        &mut self,
        at: &SplineWeights,
        root: &[f64; 6],
        slopes: &[Vec<[f64; 6]>; 3],
        of_body: &[[f64; 6]],
        scale: &[f64; 6],
    ) {
        let n = slopes[0].len();
        for k in 0..6 {
            for (spline, place) in (0..at.count).flat_map(|s| (0..n).map(move |p| (s, p))) {
                let slope: f64 = (0..3).map(|d| at.weights[d][spline] * slopes[d][place][k]).sum();
                self.row[spline * n + place] = slope / scale[k];
            }
            for (entry, slope) in self.row[self.size..].iter_mut().zip(of_body) {
                *entry = slope[k] / scale[k];
            }
            self.add_row(root[k] / scale[k]);
        }
    }

    fn add_foot(&mut self, at: &SplineWeights, away: &[f64; 6], slopes: &[[f64; 6]], scale: &[f64; 6]) {
        let n = slopes.len();
        self.row[self.size..].fill(0.0);
        for k in 0..6 {
            for (spline, place) in (0..at.count).flat_map(|s| (0..n).map(move |p| (s, p))) {
                self.row[spline * n + place] = at.weights[0][spline] * slopes[place][k] / scale[k];
            }
            self.add_row(away[k] / scale[k]);
        }
    }

    /// Adds the cost of a correction of one coordinate and its acceleration.
    fn add_change(&mut self, at: &SplineWeights, change: [f64; 3], tolerances: [f64; 2], place: usize, n: usize) {
        let whole = self.size + self.numbers;
        for (d, tolerance) in [(0, tolerances[0]), (2, tolerances[1])] {
            let weight = tolerance.powi(-2);
            for i in 0..at.count {
                let (row, a) = (i * n + place, at.weights[d][i]);
                self.right[row] -= weight * a * change[d];
                for j in 0..=i {
                    self.matrix[row * whole + j * n + place] += weight * a * at.weights[d][j];
                }
            }
        }
    }

    /// Adds these equations to the equations of the motion, where the unknowns of this frame begin at `first`.
    fn spread(&self, first: usize, equations: &mut BorderedSystem) {
        let whole = self.size + self.numbers;
        for i in 0..self.size {
            equations.right[first + i] += self.right[i];
            for j in 0..=i {
                equations.band.add(first + i, first + j, self.matrix[i * whole + j]);
            }
        }
        for k in 0..self.numbers {
            let row = &self.matrix[(self.size + k) * whole..][..whole];
            equations.corner_right[k] += self.right[self.size + k];
            for (entry, a) in equations.border[k][first..].iter_mut().zip(&row[..self.size]) {
                *entry += a;
            }
            for l in 0..=k {
                equations.corner[(k, l)] += row[self.size + l];
                if l < k {
                    equations.corner[(l, k)] += row[self.size + l];
                }
            }
        }
    }
}
