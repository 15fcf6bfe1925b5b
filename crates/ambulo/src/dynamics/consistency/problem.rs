//! The least-squares problem of a consistent motion, and Gauss and Newton's method on it.

use super::body::Body;
use super::bordered::Bordered;
use super::curves::{AtFrame, Curves, Instant, Region};
use super::frame::{Eyes, Place, Slopes, root_slope, six};
use super::{ConsistencyError, ConsistencySettings};
use crate::dynamics::{BodyLoad, LoadSeries, Workspace};
use crate::kinematics::Trajectory;
use crate::spatial::Wrench;

/// Numbers of the body are nudged by this to see what follows [share or m].
const NUDGE: f64 = 1e-4;
/// Iterations end when none of them lowers the cost by more than this share.
const SETTLED: f64 = 1e-6;
/// A step that does not help is halved so many times before the search ends.
const HALVINGS: usize = 6;

/// All that the cost is made of.
pub(super) struct Problem<'a> {
    pub(super) trajectory: &'a Trajectory,
    pub(super) loads: &'a [LoadSeries],
    pub(super) region: Region,
    pub(super) curves: Curves,
    pub(super) body: Body<'a>,
    pub(super) eyes: Eyes,
    /// Where feet were before any change, one entry a frame of the region.
    pub(super) stood: Vec<Vec<Place>>,
    /// What counts one at the root: force and moment; at a foot: displacement and rotation.
    pub(super) root_scale: [f64; 6],
    pub(super) foot_scale: [f64; 6],
    pub(super) settings: ConsistencySettings,
}

/// What is looked for.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Unknowns {
    /// Of the curves.
    pub(super) coefficients: Vec<f64>,
    /// Of the body.
    pub(super) numbers: Vec<f64>,
}

/// How the search ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Ending {
    pub(super) iterations: usize,
    pub(super) converged: bool,
}

impl Problem<'_> {
    /// Gauss and Newton's method; a step that makes things worse is halved.
    pub(super) fn solve(&self) -> Result<(Unknowns, Ending), ConsistencyError> {
        let mut at =
            Unknowns { coefficients: vec![0.0; self.curves.unknowns()], numbers: vec![0.0; self.body.count()] };
        let mut cost = self.cost(&at)?;
        for iteration in 1..=self.settings.most_iterations {
            let equations = self.linearise(&at)?;
            let ranges: Vec<[f64; 2]> = at.numbers.iter().enumerate().map(|(k, x)| self.range(k, *x)).collect();
            let (dx, dy) = equations.solve(&ranges).ok_or(ConsistencyError::Singular { iteration })?;
            let Some((better, lower)) = self.along(&at, cost, &dx, &dy)? else {
                return Ok((at, Ending { iterations: iteration, converged: self.curves.is_small(&dx) }));
            };
            let settled = cost - lower <= SETTLED * cost;
            (at, cost) = (better, lower);
            if settled {
                return Ok((at, Ending { iterations: iteration, converged: true }));
            }
        }
        Ok((at, Ending { iterations: self.settings.most_iterations, converged: false }))
    }

    /// How far a number of the body may go from where it is.
    fn range(&self, number: usize, at: f64) -> [f64; 2] {
        let [_, most] = self.body.tolerance_and_most(number);
        [-most - at, most - at]
    }

    /// What a number of the body costs. What is wrong with a motion hardly varies along a trial (skin, places of markers, lengths), and a
    /// number of the body is wrong in every frame: it counts like an equal offset of a coordinate throughout the window.
    fn trust(&self, number: usize) -> f64 {
        self.region.window.len() as f64 * self.body.tolerance_and_most(number)[0].powi(-2)
    }

    /// The first point along a step that costs less, with its cost.
    fn along(
        &self,
        at: &Unknowns,
        cost: f64,
        dx: &[f64],
        dy: &[f64],
    ) -> Result<Option<(Unknowns, f64)>, ConsistencyError> {
        for halving in 0..HALVINGS {
            let share = 0.5_f64.powi(halving as i32);
            let moved = |x: &[f64], d: &[f64]| x.iter().zip(d).map(|(x, d)| x + share * d).collect();
            let there = Unknowns { coefficients: moved(&at.coefficients, dx), numbers: moved(&at.numbers, dy) };
            let there_cost = self.cost(&there)?;
            if there_cost < cost {
                return Ok(Some((there, there_cost)));
            }
        }
        Ok(None)
    }

    /// Sum of squares.
    fn cost(&self, at: &Unknowns) -> Result<f64, ConsistencyError> {
        let mut workspace = Workspace::new(&self.body.with(&at.numbers)?);
        let mut instant = Instant::zeros(self.trajectory.columns().len());
        let mut loads = Vec::new();
        let mut cost = 0.0;
        for (stood, frame) in self.stood.iter().zip(self.region.frames.clone()) {
            self.curves.write(self.trajectory, frame, &at.coefficients, &mut instant);
            self.loads_at(frame, &mut loads);
            let sight = self.eyes.see(&mut workspace, &instant, &loads);
            if self.region.window.contains(&frame) {
                cost += squares(&six(&sight.root), &self.root_scale);
            }
            for (place, before) in sight.feet.iter().zip(stood) {
                cost += squares(&place.away_from(before), &self.foot_scale);
            }
            let spline = self.curves.at(frame);
            for (k, [value, acceleration]) in self.curves.tolerances(frame).enumerate() {
                let [change, _, second] = self.curves.change(&spline, &at.coefficients, k);
                cost += (change / value).powi(2) + (second / acceleration).powi(2);
            }
        }
        let prior = |(k, x): (usize, &f64)| self.trust(k) * x * x;
        Ok(cost + at.numbers.iter().enumerate().map(prior).sum::<f64>())
    }

    /// The loads of a frame; none outside of the window, where they may be no numbers.
    fn loads_at(&self, frame: usize, loads: &mut Vec<BodyLoad>) {
        loads.clear();
        if self.region.window.contains(&frame) {
            loads.extend(self.loads.iter().map(|load| load.at(frame)));
        }
    }

    /// What is lacking at the root in each frame of the window, for a body and a motion.
    pub(super) fn lacking(&self, at: &Unknowns) -> Result<Vec<Wrench>, ConsistencyError> {
        let mut workspace = Workspace::new(&self.body.with(&at.numbers)?);
        let mut instant = Instant::zeros(self.trajectory.columns().len());
        let mut loads = Vec::new();
        let mut list = Vec::with_capacity(self.region.window.len());
        for frame in self.region.window.clone() {
            self.curves.write(self.trajectory, frame, &at.coefficients, &mut instant);
            self.loads_at(frame, &mut loads);
            list.push(self.eyes.see(&mut workspace, &instant, &loads).root);
        }
        Ok(list)
    }

    /// The normal equations around a point.
    fn linearise(&self, at: &Unknowns) -> Result<Bordered, ConsistencyError> {
        let numbers = self.body.count();
        let mut equations = Bordered::zeros(self.curves.unknowns(), self.curves.bands(), numbers);
        let mut workspace = Workspace::new(&self.body.with(&at.numbers)?);
        let mut nudged = self.nudged(at)?;
        let mut instant = Instant::zeros(self.trajectory.columns().len());
        let (mut loads, mut slopes, mut local) = (Vec::new(), Slopes::default(), Local::default());
        for (stood, frame) in self.stood.iter().zip(self.region.frames.clone()) {
            self.curves.write(self.trajectory, frame, &at.coefficients, &mut instant);
            self.loads_at(frame, &mut loads);
            let spline = self.curves.at(frame);
            let obeys = self.region.window.contains(&frame);
            local.clear(spline.count * self.curves.coordinates.len(), numbers);
            let sight = self.eyes.see(&mut workspace, &instant, &loads);
            self.eyes.slopes(&mut workspace, &self.curves, &mut instant, &loads, obeys, &mut slopes);
            if obeys {
                let of_body: Vec<[f64; 6]> = nudged
                    .iter_mut()
                    .map(|other| root_slope(&sight.root, &self.eyes.see(other, &instant, &loads).root, NUDGE))
                    .collect();
                local.add_root(&spline, &six(&sight.root), &slopes.root, &of_body, &self.root_scale);
            }
            for (foot, (place, before)) in slopes.feet.iter().zip(sight.feet.iter().zip(stood)) {
                local.add_foot(&spline, &place.away_from(before), foot, &self.foot_scale);
            }
            for (k, tolerances) in self.curves.tolerances(frame).enumerate() {
                let change = self.curves.change(&spline, &at.coefficients, k);
                local.add_change(&spline, change, tolerances, k, self.curves.coordinates.len());
            }
            local.spread(spline.first * self.curves.coordinates.len(), &mut equations);
        }
        for (k, x) in at.numbers.iter().enumerate() {
            let weight = self.trust(k);
            equations.corner[(k, k)] += weight;
            equations.corner_right[k] -= weight * x;
        }
        Ok(equations)
    }

    /// Workspaces of the body with each number a little larger.
    fn nudged(&self, at: &Unknowns) -> Result<Vec<Workspace>, ConsistencyError> {
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

/// Normal equations of one frame's unknowns and the body's numbers.
#[derive(Debug, Clone, Default)]
struct Local {
    size: usize,
    numbers: usize,
    /// Lower triangle by rows, the body's numbers last.
    matrix: Vec<f64>,
    right: Vec<f64>,
    row: Vec<f64>,
}

impl Local {
    fn clear(&mut self, size: usize, numbers: usize) {
        let whole = size + numbers;
        (self.size, self.numbers) = (size, numbers);
        for (list, length) in [(&mut self.matrix, whole * whole), (&mut self.right, whole), (&mut self.row, whole)] {
            list.clear();
            list.resize(length, 0.0);
        }
    }

    /// One residual with the slopes in `row`.
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
        at: &AtFrame,
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

    fn add_foot(&mut self, at: &AtFrame, away: &[f64; 6], slopes: &[[f64; 6]], scale: &[f64; 6]) {
        let n = slopes.len();
        self.row[self.size..].fill(0.0);
        for k in 0..6 {
            for (spline, place) in (0..at.count).flat_map(|s| (0..n).map(move |p| (s, p))) {
                self.row[spline * n + place] = at.weights[0][spline] * slopes[place][k] / scale[k];
            }
            self.add_row(away[k] / scale[k]);
        }
    }

    /// What a change of one coordinate, and its acceleration, costs.
    fn add_change(&mut self, at: &AtFrame, change: [f64; 3], tolerances: [f64; 2], place: usize, n: usize) {
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

    /// Adds these equations to the whole, whose unknowns of this frame begin at `first`.
    fn spread(&self, first: usize, equations: &mut Bordered) {
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
