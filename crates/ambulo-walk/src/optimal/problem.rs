//! A problem of optimal motion: a body on soft shoes, a span of time, an objective; and its transcription.
//!
//! The unknowns are the spline coefficients x of all coordinates ([`Layout`]). With instants t_p, p = 0 .. P, the
//! motion minimises
//!
//!   1/P Σ_p Σ_terms ((quantity - target) / deviation)²     subject to     c_p = τ_root(t_p) / scale = 0
//!
//! where τ_root are the residual forces at the root. The augmented Lagrangian adds 1/P Σ |c_p + m_p|² / s² with the
//! multipliers m and the slack s; after each minimisation m grows by c (Hestenes 1969, Powell 1969; unverified).

mod bending;

use super::instant::{Evaluator, Instant};
use super::layout::{Layout, Span, Weights};
use super::normal::{InstantSums, IntervalRows, NormalEquations, empty_matrix};
use super::objective::{Quantity, Row, Term};
use super::observer::Observer;
use crate::contact::HuntCrossley;
use crate::dynamics::CurvedJointError;
use crate::model::anthropometry::ContactSphere;
use crate::model::{CoordinateId, CoordinateKind, Model};

/// A body with contacts, a span of time, and the objective of its motion.
#[derive(Debug, Clone)]
pub struct Problem {
    /// The body. No force drives the coordinates of its root.
    pub model: Model,
    /// Spheres under its feet.
    pub soles: Vec<ContactSphere>,
    /// Height of the level surface that each sphere touches [m], for spheres above a chair or a step; the ground, 0,
    /// where there is none.
    pub levels_m: Vec<f64>,
    /// Contact law between the spheres and these surfaces.
    pub shoes: HuntCrossley,
    /// How the motion continues after the span.
    pub span: Span,
    /// Duration of the span [s].
    pub duration_s: f64,
    /// Coordinate of forward motion and its increase over the span [m]. A constant velocity is added to its spline.
    pub travel: Option<(CoordinateId, f64)>,
    /// Knot intervals of the splines.
    pub knots: usize,
    /// Instants of each knot interval.
    pub instants_per_knot: usize,
    /// Length by which residual moments are divided, to compare them with residual forces [m].
    pub length_m: f64,
    /// The objective.
    pub terms: Vec<Term>,
    /// Follows the steps of the solver and may stop them.
    pub observer: Observer,
}

/// Properties of the problem that change from stage to stage of the solution.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stage {
    /// The law of contact.
    pub shoes: HuntCrossley,
    /// Slack s of the residual forces at the root [body weights, body weights × length]: the residual at which an
    /// instant costs 1.
    pub slack: f64,
    /// Factor of the deviation of slip.
    pub slip: f64,
}

impl Stage {
    /// The deviation of a term that costs 1.
    pub fn deviation(&self, term: &Term) -> f64 {
        let factor = if matches!(term.quantity, Quantity::Slip { .. }) { self.slip } else { 1.0 };
        factor * term.deviation
    }

    /// (value - target) / deviation at an instant; `None` if it does not count.
    pub fn residual(&self, term: &Term, index: usize, at: &Instant) -> Option<f64> {
        let residual = term.residual(index, term.quantity.value(index, at))?;
        Some(residual * (term.deviation / self.deviation(term)))
    }
}

/// A problem as residuals and normal equations at its instants.
pub(super) struct Transcription<'a> {
    problem: &'a Problem,
    pub(super) layout: Layout,
    evaluator: Evaluator,
    pub(super) stage: Stage,
    /// Coordinates of the root, and the scale of their forces.
    root: Vec<(usize, f64)>,
    /// Multipliers, one per instant and coordinate of the root.
    multipliers: Vec<f64>,
    instants: Vec<Instant>,
    /// The instants at which the normal equations were computed.
    base: Vec<Instant>,
    sums: InstantSums,
    rows: Rows,
    rates: Vec<Rates<'a>>,
}

/// Full rows of an instant, with their residuals.
#[derive(Debug, Default)]
struct Rows {
    residuals: Vec<f64>,
    slopes: Vec<f64>,
}

/// Rates of forces that depend on the same coordinates.
#[derive(Debug)]
struct Rates<'a> {
    terms: Vec<(CoordinateId, &'a Term)>,
    rows: IntervalRows,
}

impl Problem {
    /// Number of instants at which terms have targets, including both ends of the span.
    #[must_use]
    pub fn instants(&self) -> usize {
        self.layout().instants()
    }

    /// Instants as shares of the span, from 0 to 1.
    #[must_use]
    pub fn shares(&self) -> Vec<f64> {
        let layout = self.layout();
        (0..layout.instants()).map(|index| layout.instant(index).0).collect()
    }

    /// Unknowns of the least-squares fit to coordinates that are given at all instants, without forward motion.
    #[must_use]
    pub fn fitted(&self, coordinates: &[Vec<f64>]) -> Vec<f64> {
        let layout = self.layout();
        let mut normal = NormalEquations::new(&layout);
        let mut sums = InstantSums::new(layout.width);
        for (index, values) in coordinates.iter().enumerate() {
            let (share, interval) = layout.instant(index);
            sums.clear();
            for (c, value) in values.iter().enumerate() {
                sums.add_entries(-value, &[(c, 1.0)]);
                // Keeps splines without own instants on a straight line.
                sums.add_entries(0.0, &[(2 * layout.width + c, 1e-6)]);
            }
            normal.add_instant(&layout.weights(share, interval), &mut sums);
        }
        let mut matrix = empty_matrix(&layout);
        let mut unknowns = vec![0.0; layout.blocks() * layout.width];
        normal.fold(&layout, &mut matrix, &mut unknowns);
        matrix.raise_diagonal(0.0, 1e-12);
        if let Some(factor) = matrix.factor() {
            factor.solve(&mut unknowns);
        }
        for x in &mut unknowns {
            *x = -*x;
        }
        unknowns
    }

    /// The same problem with every second instant of each knot interval.
    pub(super) fn every_second(&self) -> Problem {
        let mut terms = self.terms.clone();
        for term in &mut terms {
            term.targets = term.targets.iter().step_by(2).copied().collect();
        }
        Problem { terms, instants_per_knot: self.instants_per_knot / 2, ..self.clone() }
    }

    pub(super) fn layout(&self) -> Layout {
        Layout::new(&self.model, self.span, self.knots, self.instants_per_knot)
    }

    /// Coordinates of the root, and whether they are rotations.
    #[must_use]
    pub fn root(&self) -> Vec<(CoordinateId, bool)> {
        let roots = self.model.bodies().iter().filter(|body| body.joint.parent.is_none());
        let turns = |id: CoordinateId| self.model.coordinates()[id.index()].kind == CoordinateKind::Rotation;
        roots.flat_map(|body| body.joint.coordinates()).map(|id| (id, turns(id))).collect()
    }

    /// Coordinates of the root, and the force that counts as one at each [N or N.m].
    pub(super) fn root_scales(&self) -> Vec<(CoordinateId, f64)> {
        let weight = self.weight_n();
        let scale = |turns: bool| if turns { weight * self.length_m } else { weight };
        self.root().into_iter().map(|(id, turns)| (id, scale(turns))).collect()
    }

    pub(super) fn weight_n(&self) -> f64 {
        self.model.mass() * self.model.gravity().norm()
    }

    /// Terms of rates of forces, with the coordinates of these forces.
    fn forces_by_rate(&self) -> impl Iterator<Item = (CoordinateId, &Term)> {
        self.terms.iter().filter_map(|term| Some((term.quantity.is_rate_of_force()?, term)))
    }

    /// The same terms, grouped by the coordinates on which the forces depend.
    fn rates(&self, evaluator: &Evaluator) -> Vec<Rates<'_>> {
        let mut groups: Vec<Rates<'_>> = Vec::new();
        for (id, term) in self.forces_by_rate() {
            let related = evaluator.related(id.index());
            match groups.iter_mut().find(|group| group.rows.coordinates() == related) {
                Some(group) => group.terms.push((id, term)),
                None => groups.push(Rates { terms: vec![(id, term)], rows: IntervalRows::new(related) }),
            }
        }
        groups
    }

    /// Adds forward motion, which the splines do not include.
    pub(super) fn add_travel(&self, share: f64, posture: &mut [Vec<f64>; 3]) {
        if let Some((id, distance)) = self.travel {
            posture[0][id.index()] += distance * share;
            posture[1][id.index()] += distance / self.duration_s;
        }
    }
}

impl<'a> Transcription<'a> {
    pub(super) fn new(problem: &'a Problem) -> Result<Transcription<'a>, CurvedJointError> {
        let layout = problem.layout();
        let root = problem.root_scales().into_iter().map(|(id, scale)| (id.index(), scale)).collect::<Vec<_>>();
        let evaluator = Evaluator::new(&problem.model, &problem.soles, &problem.levels_m)?;
        Ok(Transcription {
            rates: problem.rates(&evaluator),
            evaluator,
            stage: Stage { shoes: problem.shoes, slack: 1.0, slip: 1.0 },
            multipliers: vec![0.0; layout.instants() * root.len()],
            instants: vec![Instant::default(); layout.instants()],
            base: vec![Instant::default(); layout.instants()],
            sums: InstantSums::new(layout.width),
            rows: Rows::default(),
            root,
            layout,
            problem,
        })
    }

    /// Evaluates all instants, with derivatives.
    pub(super) fn evaluate(&mut self, unknowns: &[f64]) {
        self.place(unknowns);
        self.evaluator.evaluate(&self.stage.shoes, &mut self.instants);
    }

    /// Evaluates all instants without derivatives, in less time: for the cost, not for normal equations.
    pub(super) fn evaluate_forces(&mut self, unknowns: &[f64]) {
        self.place(unknowns);
        self.evaluator.evaluate_forces(&self.stage.shoes, &mut self.instants);
    }

    /// Sets the postures of all instants.
    fn place(&mut self, unknowns: &[f64]) {
        let extended = self.layout.extended(unknowns);
        for index in 0..self.instants.len() {
            let (share, first) = self.layout.instant(index);
            let weights = self.weights(index);
            let posture = &mut self.instants[index].posture;
            for (values, weights) in posture.iter_mut().zip(&weights.values) {
                values.clear();
                values.resize(self.layout.width, 0.0);
                for (weight, block) in weights.iter().zip(extended.chunks(self.layout.width).skip(first)) {
                    for (value, coefficient) in values.iter_mut().zip(block) {
                        *value += weight * coefficient;
                    }
                }
            }
            self.problem.add_travel(share, posture);
        }
    }

    /// Weights of an instant, with derivatives by time.
    fn weights(&self, index: usize) -> Weights {
        let (share, interval) = self.layout.instant(index);
        self.timed(self.layout.weights(share, interval))
    }

    fn timed(&self, weights: Weights) -> Weights {
        let rate = 1.0 / self.problem.duration_s;
        weights.scaled([1.0, rate, rate * rate])
    }

    /// Number of instants in the sums. In a repeated motion the last instant equals the first one and is left out.
    fn counted(&self) -> usize {
        self.instants.len() - usize::from(self.layout.span != Span::Single)
    }

    /// Square root of the weight of an instant in the mean over the span.
    fn share(&self) -> f64 {
        (1.0 / (self.instants.len() - 1) as f64).sqrt()
    }

    /// The sum of squares at the instants that were evaluated.
    pub(super) fn cost(&self) -> f64 {
        let share = self.share();
        let mut cost = 0.0;
        for index in 0..self.counted() {
            let at = &self.instants[index];
            for term in self.problem.terms.iter().filter(|term| term.quantity.is_rate_of_force().is_none()) {
                cost += self.stage.residual(term, index, at).map_or(0.0, |r| (r * share).powi(2));
            }
            for k in 0..self.root.len() {
                cost += (self.root_residual(index, k) * share).powi(2);
            }
        }
        for (id, term) in self.problem.forces_by_rate() {
            for index in 0..self.instants.len() - 1 {
                cost += self.rate_residual(id, term, index).map_or(0.0, |r| (r * share).powi(2));
            }
        }
        cost
    }

    /// The cost of each term.
    pub(super) fn costs(&self) -> Vec<(String, f64)> {
        let share = self.share();
        let of = |term: &Term| -> f64 {
            let square = |r: f64| (r * share).powi(2);
            match term.quantity.is_rate_of_force() {
                Some(id) => {
                    (0..self.instants.len() - 1).filter_map(|k| self.rate_residual(id, term, k)).map(square).sum()
                }
                None => (0..self.counted())
                    .filter_map(|k| term.residual(k, term.quantity.value(k, &self.instants[k])))
                    .map(square)
                    .sum(),
            }
        };
        self.problem.terms.iter().map(|term| (term.name.clone(), of(term))).collect()
    }

    fn rate_residual(&self, id: CoordinateId, term: &Term, index: usize) -> Option<f64> {
        let [here, there] = [index, index + 1].map(|i| self.instants[i].forces[id.index()]);
        term.residual(index, (there - here) * self.per_second())
    }

    fn per_second(&self) -> f64 {
        (self.instants.len() - 1) as f64 / self.problem.duration_s
    }

    fn root_residual(&self, index: usize, k: usize) -> f64 {
        let (coordinate, scale) = self.root[k];
        (self.instants[index].forces[coordinate] / scale + self.multipliers[index * self.root.len() + k])
            / self.stage.slack
    }

    /// Residual forces at the root over the span [body weights, body weights × length]: root mean square and maximum.
    pub(super) fn root_forces(&self) -> (f64, f64) {
        let all = (0..self.counted()).flat_map(|index| {
            self.root.iter().map(move |(coordinate, scale)| (self.instants[index].forces[*coordinate] / scale).abs())
        });
        let (mut sum, mut count, mut largest) = (0.0, 0.0, 0.0_f64);
        for value in all {
            sum += value * value;
            count += 1.0;
            largest = largest.max(value);
        }
        ((sum / count).sqrt(), largest)
    }

    /// Mean force of the ground on all feet [N].
    pub(super) fn mean_load(&self) -> f64 {
        let load = |at: &Instant| at.contacts.iter().map(|contact| contact.values.force.y).sum::<f64>();
        self.instants[..self.counted()].iter().map(load).sum::<f64>() / self.counted() as f64
    }

    /// Adds the residual forces at the root to the multipliers.
    pub(super) fn update_multipliers(&mut self) {
        for index in 0..self.counted() {
            for (k, (coordinate, scale)) in self.root.iter().enumerate() {
                self.multipliers[index * self.root.len() + k] += self.instants[index].forces[*coordinate] / scale;
            }
        }
    }

    pub(super) fn scale_multipliers(&mut self, factor: f64) {
        for multiplier in &mut self.multipliers {
            *multiplier *= factor;
        }
    }

    /// Normal equations at the instants that were evaluated.
    pub(super) fn linearise(&mut self, normal: &mut NormalEquations) {
        normal.clear();
        for index in 0..self.counted() {
            self.instant_rows(index, normal);
            let weights = self.weights(index);
            normal.add_instant(&weights, &mut self.sums);
        }
        self.rate_rows(normal);
    }

    /// Exchanges the evaluated instants with those at which the normal equations were computed, so that a trial does
    /// not overwrite these.
    pub(super) fn exchange_base(&mut self) {
        std::mem::swap(&mut self.instants, &mut self.base);
    }

    /// Sets the right-hand side to the second-order part of the residual forces at the root: their values now, minus
    /// the linear prediction from the base for a change of the unknowns.
    pub(super) fn curvature_of_root(&self, change: &[f64], normal: &mut NormalEquations) {
        let (n, width) = (self.layout.width, 3 * self.layout.width);
        let extended = self.layout.extended(change);
        let factor = (self.share() / self.stage.slack).powi(2);
        normal.clear_right();
        for index in 0..self.counted() {
            let weights = self.weights(index);
            let (base, now) = (&self.base[index], &self.instants[index]);
            let mut moved = vec![0.0; width];
            for (part, values) in weights.values.iter().enumerate() {
                for (weight, block) in values.iter().zip(extended.chunks(n).skip(weights.first)) {
                    for (sum, value) in moved[part * n..(part + 1) * n].iter_mut().zip(block) {
                        *sum += weight * value;
                    }
                }
            }
            let mut right = vec![0.0; width];
            for (coordinate, scale) in &self.root {
                let row = &base.slopes[coordinate * width..(coordinate + 1) * width];
                let predicted: f64 = row.iter().zip(&moved).map(|(a, b)| a * b).sum();
                let beyond = now.forces[*coordinate] - base.forces[*coordinate] - predicted;
                for (sum, slope) in right.iter_mut().zip(row) {
                    *sum += slope * beyond * factor / (scale * scale);
                }
            }
            normal.add_right(&weights, &right);
        }
    }

    fn instant_rows(&mut self, index: usize, normal: &NormalEquations) {
        let share = self.share();
        self.sums.clear();
        self.rows.residuals.clear();
        self.rows.slopes.clear();
        for term in self.problem.terms.iter().filter(|term| term.quantity.is_rate_of_force().is_none()) {
            let at = &self.instants[index];
            let Some(residual) = self.stage.residual(term, index, at) else { continue };
            match term.quantity.row(index, at, self.stage.deviation(term) / share, &mut self.rows.slopes) {
                Row::Entries(mut entries) => {
                    entries.sort_unstable_by_key(|(place, _)| *place);
                    self.sums.add_entries(residual * share, &entries);
                }
                Row::Full => self.rows.residuals.push(residual * share),
            }
        }
        let width = 3 * self.layout.width;
        for (k, (coordinate, scale)) in self.root.iter().enumerate() {
            let scale = scale * self.stage.slack / share;
            self.rows.residuals.push(self.root_residual(index, k) * share);
            let slopes = &self.instants[index].slopes[coordinate * width..(coordinate + 1) * width];
            self.rows.slopes.extend(slopes.iter().map(|slope| slope / scale));
        }
        normal.add_rows(&mut self.sums, &self.rows.residuals, &self.rows.slopes);
    }

    /// Rows of the rates of forces, each between two instants of one interval.
    fn rate_rows(&mut self, normal: &mut NormalEquations) {
        let mut groups = std::mem::take(&mut self.rates);
        for interval in 0..self.layout.knots {
            for group in &mut groups {
                group.rows.clear();
                for index in interval * self.layout.per_knot..(interval + 1) * self.layout.per_knot {
                    self.rates_after(index, group);
                }
                normal.add_interval(interval, &group.rows);
            }
        }
        self.rates = groups;
    }

    /// Adds the rows of rates between an instant and the next one.
    fn rates_after(&self, index: usize, Rates { terms, rows }: &mut Rates<'a>) {
        let (width, share) = (3 * self.layout.width, self.share());
        let (from, interval) = self.layout.instant(index);
        let (until, _) = self.layout.instant(index + 1);
        let ends = [from, until].map(|at| self.timed(self.layout.weights(at, interval)));
        for (id, term) in terms {
            let Some(residual) = self.rate_residual(*id, term, index) else { continue };
            let factor = share * self.per_second() / term.deviation;
            let slopes = [index, index + 1].map(|i| &self.instants[i].slopes[id.index() * width..][..width]);
            let weights = [ends[0].scaled([-factor; 3]), ends[1].scaled([factor; 3])];
            rows.add(residual * share, [(&weights[0], slopes[0]), (&weights[1], slopes[1])]);
        }
    }

    pub(super) fn instants(&self) -> &[Instant] {
        &self.instants
    }
}
