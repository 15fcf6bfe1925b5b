//! Motions and constraint forces of a graph with loops and contacts: Newton steps on an augmented Lagrangian.
//!
//! With A the inertias on the trees' own coordinates, rows u = J a + R λ - c and laws that confine the forces to a set K:
//!
//!   λ = Π_K( (λ° - ρ (J a - c)) / (1 + ρ R) )                                                     (1)
//!   A a = b + Jᵀ λ                                                                                 (2)
//!
//! λ° is the last estimate. A Newton step on (2) with (1) put in solves (A + Jᵀ H J) Δ = b + Jᵀ λ - A a, where H = -∂λ/∂(J a) is
//! at most 3 x 3 for each contact and diagonal else: rows on one body only add to that body's block, rows between two
//! bodies couple them, and [`Elimination`] does the rest. When (2) holds, λ° := λ; the departure of rigid rows then falls by
//! 1/(1 + ρ W) each time, W = J A⁻¹ Jᵀ. Redundant rows do no harm: starting at λ° = 0 every λ° stays in the range of J, so the
//! forces of a table on four legs are the least-squares ones.
//!
//! Coulomb's law is no gradient. The disc of friction, |λ_t| ≤ r, takes its radius r = μ λ_n from the normal force of the step
//! before; for a fixed radius (1), (2) are the stationarity of a convex function φ, on which a line search guards each step.
//!
//! | code        | symbol | unit            | shape                         |
//! | `lambda`    | λ      | N.m, N          | one a row                     |
//! | `center`    | λ°     | N.m, N          | one a row                     |
//! | `u`         | J a - c |  as the motion | one a row                     |
//! | `rho`       | ρ      | kg, kg.m²       | one number                    |
//! | `radius`    | r      | N               | one a group                   |
//! | `curvature` | H      | kg, kg.m²       | 3 x 3 a contact, diagonal else |
//!
//! Source: proximal handling of constraints on articulated bodies as in Carpentier, Budhiraja, Mansard 2021, "Proximal
//! and sparse resolution of constrained dynamic equations" (unverified page); friction disc of lagged radius after
//! Panagiotopoulos (unverified). The equations are derived above.
//! Cost: one factorisation when contacts change between open, sticking and slipping; one solve else.
//! Pinned by: tests/constraint_graph.rs

use super::block::Block;
use super::constraint::{Acting, ConstraintGraph, ConstraintGroup, Convergence, GraphSolution, Law, Six};
use super::elimination::{Elimination, EliminationWorkspace, Link, LinkError, Offsets};
use std::collections::BTreeMap;

/// ρ times the mobility of rows: large, so that two or three rounds suffice; far from 1/ε, so that the sum A + Jᵀ H J keeps
/// the digits of A.
const STIFFNESS: f64 = 1e6;
/// Least scale of departures, as a share of the velocities that a row compares: what these cancel to is known to 1e-16 of
/// them, a tolerance of 1e-10 must stay above.
const SMALLEST_SCALE: f64 = 1e-4;
/// Where forces are not unique, those of contacts that stick are kept within this share of their cone.
const WITHIN: f64 = 0.95;
/// Halvings in finding how far that allows to go.
const SHARE_HALVINGS: usize = 20;
/// Iterations within which friction follows normal forces at once. After them it does so only where the motion for the last
/// radii has been found: what this converges to is slower to come, but no cycle, and dissipates wherever it is left.
const PATIENCE: usize = 15;
/// Halvings of the line search; the slope of a convex function changes sign within them.
const HALVINGS: usize = 30;

/// How far to iterate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SolverSettings {
    /// Largest residual accepted; see [`Convergence::residual`].
    pub tolerance: f64,
    /// Most tree solves.
    pub max_iterations: usize,
}

impl Default for SolverSettings {
    fn default() -> Self {
        SolverSettings { tolerance: 1e-10, max_iterations: 100 }
    }
}

/// Scratch of the solver. Nothing is allocated while the graph keeps its shape.
#[derive(Debug, Clone, Default)]
pub struct GraphWorkspace {
    links: Vec<Link>,
    /// Bodies that each group joins.
    shape: Vec<Option<(usize, usize)>>,
    pub(crate) elimination: Option<Elimination>,
    pub(crate) factors: EliminationWorkspace,
    /// Off-diagonal block of each group that joins two bodies.
    blocks: Vec<Option<(usize, bool)>>,
    u: Vec<f64>,
    /// J Δ.
    change: Vec<f64>,
    center: Vec<f64>,
    /// Forces with which (2) holds.
    predicted: Vec<f64>,
    /// The guess.
    before: Vec<f64>,
    mobility: Vec<f64>,
    radius: Vec<f64>,
    curvature: Vec<Curvature>,
    factored: Vec<Curvature>,
    step: Vec<Six>,
    step_coordinates: Vec<f64>,
    last: Iterate,
}

/// The last motion that solves the problem for some radii of friction: it dissipates, which those between do not.
#[derive(Debug, Clone, Default)]
struct Iterate {
    /// Zero if there is none.
    iterations: usize,
    residual: f64,
    worst: Option<usize>,
    motions: Vec<Six>,
    coordinates: Vec<f64>,
    lambda: Vec<f64>,
}

impl Iterate {
    fn keep(&mut self, convergence: &Convergence, motions: &[Six], coordinates: &[f64], lambda: &[f64]) {
        if convergence.iterations <= PATIENCE {
            return;
        }
        (self.iterations, self.residual, self.worst) =
            (convergence.iterations, convergence.residual, convergence.worst);
        self.motions.clear();
        self.motions.extend_from_slice(motions);
        for (mine, theirs) in [(&mut self.coordinates, coordinates), (&mut self.lambda, lambda)] {
            mine.clear();
            mine.extend_from_slice(theirs);
        }
    }

    fn give(&self, convergence: &mut Convergence, motions: &mut [Six], coordinates: &mut [f64], lambda: &mut [f64]) {
        if self.iterations > 0 {
            (convergence.residual, convergence.worst) = (self.residual, self.worst);
            motions.copy_from_slice(&self.motions);
            coordinates.copy_from_slice(&self.coordinates);
            lambda.copy_from_slice(&self.lambda);
        }
    }
}

/// H of a group: 3 x 3 for a contact; for other laws the diagonal, on up to six rows.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Curvature {
    Diagonal([f64; 6]),
    /// Normal; then the tangential xx, xy, yy.
    Contact(f64, [f64; 3]),
}

impl GraphWorkspace {
    /// The elimination for this graph, made anew only if its shape has changed.
    pub(crate) fn prepare(&mut self, graph: &ConstraintGraph, with_rows: bool) -> Result<(), LinkError> {
        let pair = |group: &ConstraintGroup| match group.on {
            Acting::Bodies { first, second: Some(second) } if with_rows => Some((first, second)),
            _ => None,
        };
        let shape = graph.groups.iter().map(pair);
        if self.elimination.is_some() && self.links == graph.links && shape.clone().eq(self.shape.iter().copied()) {
            return Ok(());
        }
        self.shape.clear();
        self.shape.extend(shape);
        self.links.clone_from(&graph.links);
        let mut numbers = BTreeMap::new();
        let mut couplings = Vec::new();
        self.blocks.clear();
        for pair in &self.shape {
            self.blocks.push(pair.map(|(first, second)| {
                let block = *numbers.entry((first.min(second), first.max(second))).or_insert_with(|| {
                    couplings.push((first, second));
                    couplings.len() - 1
                });
                (block, first > second)
            }));
        }
        self.elimination = Some(Elimination::new(&graph.links, &couplings)?);
        Ok(())
    }

    /// Bodies with their parents, parents first, as last prepared.
    #[must_use]
    pub fn outwards(&self) -> Vec<(usize, Option<usize>)> {
        self.elimination.iter().flat_map(Elimination::outwards).collect()
    }

    fn resize(&mut self, graph: &ConstraintGraph) {
        let rows = graph.rows.len();
        for list in [&mut self.u, &mut self.change, &mut self.center, &mut self.predicted, &mut self.mobility] {
            list.clear();
            list.resize(rows, 0.0);
        }
        self.radius.clear();
        self.radius.resize(graph.groups.len(), f64::INFINITY);
        self.curvature.clear();
        self.curvature.resize(graph.groups.len(), Curvature::Diagonal([0.0; 6]));
        self.factored.clone_from(&self.curvature);
        self.step.resize(graph.bodies.len(), Six::zeros());
        self.step_coordinates.resize(graph.efforts.len(), 0.0);
    }
}

/// Solves the graph. `solution.lambda` holds a guess of the forces, as of the last step; it decides only which contacts are
/// first taken as pushing and which as slipping. A contact without a past gets a positive normal force and no other.
///
/// Rows whose laws contradict each other (a drive against a wall) leave [`Convergence::converged`] false, with the row that
/// departs most; forces stay within their bounds.
///
/// # Errors
/// A graph whose links are no forest.
pub fn solve_graph(
    graph: &ConstraintGraph,
    settings: &SolverSettings,
    workspace: &mut GraphWorkspace,
    solution: &mut GraphSolution,
) -> Result<(), LinkError> {
    workspace.prepare(graph, true)?;
    workspace.resize(graph);
    solution.lambda.resize(graph.rows.len(), 0.0);
    let Some(elimination) = workspace.elimination.take() else { return Ok(()) };
    Newton { graph, elimination: &elimination, settings, w: workspace, rho: 0.0, scale: 0.0 }.run(solution);
    workspace.elimination = Some(elimination);
    Ok(())
}

/// Displacements that carry the rows that hold at the last solution to `targets`, with the least mass moved: M δ = Jᵀ ν,
/// J δ = targets, and the joints' offsets as they stand in the graph. Uses the last factor.
pub(crate) fn project_displacements(
    graph: &ConstraintGraph,
    targets: &[f64],
    workspace: &GraphWorkspace,
    motions: &mut Vec<Six>,
    coordinates: &mut Vec<f64>,
) {
    motions.clear();
    motions.resize(graph.bodies.len(), Six::zeros());
    coordinates.clear();
    coordinates.resize(graph.efforts.len(), 0.0);
    let Some(elimination) = &workspace.elimination else { return };
    let mut lambda = vec![0.0; graph.rows.len()];
    for (group, curvature) in graph.groups.iter().zip(&workspace.factored) {
        let start = group.rows.start;
        match curvature {
            Curvature::Diagonal(h) => group.rows.clone().for_each(|row| lambda[row] = h[row - start] * targets[row]),
            Curvature::Contact(normal, _) => lambda[start] = normal * targets[start],
        }
    }
    graph.push(&lambda, motions, coordinates);
    elimination.solve(&graph.terms, Offsets::Prescribed, motions, coordinates, &workspace.factors);
}

struct Newton<'a> {
    graph: &'a ConstraintGraph,
    elimination: &'a Elimination,
    settings: &'a SolverSettings,
    w: &'a mut GraphWorkspace,
    rho: f64,
    /// Largest departure of a row without constraint forces.
    scale: f64,
}

impl Newton<'_> {
    fn run(&mut self, solution: &mut GraphSolution) {
        let GraphSolution { motions, coordinates, lambda, convergence } = solution;
        *convergence = Convergence::default();
        self.w.last.iterations = 0;
        self.measure();
        self.w.before.clone_from(lambda);
        self.guess(lambda);
        self.factor(convergence);
        self.first_solve(motions, coordinates, lambda);
        convergence.iterations = 1;
        if self.graph.rows.is_empty() {
            convergence.converged = true;
            return;
        }
        self.refine(motions, coordinates, lambda);
        convergence.iterations = 2;
        let mut convex = true;
        loop {
            self.read(motions, coordinates);
            // With these forces (2) holds; if (1) does, too, this is the solution.
            lambda.copy_from_slice(&self.w.predicted);
            let settled = self.settle(lambda, convergence);
            if !settled && convex {
                self.w.last.keep(convergence, motions, coordinates, lambda);
            }
            if settled || convergence.iterations >= self.settings.max_iterations {
                if !settled {
                    self.w.last.give(convergence, motions, coordinates, lambda);
                }
                self.confine(lambda);
                break;
            }
            if convex || convergence.iterations < PATIENCE {
                self.update_radii(lambda);
            }
            self.evaluate(lambda);
            let largest = self.w.change.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
            convex = self.w.curvature == self.w.factored || largest <= self.settings.tolerance * self.scale;
            if convex {
                self.recenter(lambda);
            }
            if self.w.curvature != self.w.factored {
                self.factor(convergence);
            }
            self.newton_step(motions, coordinates, lambda);
            convergence.iterations += 1;
        }
    }

    /// ρ from the rows' mobilities; the scale of departures.
    fn measure(&mut self) {
        let (mut least, mut most) = (f64::INFINITY, 0.0_f64);
        let free = |body: usize| {
            let (terms, b) = (&self.graph.bodies[body], &self.graph.wrenches[body]);
            let mean = terms.inertia.trace() / 3.0;
            let share = |x: f64, inertia: f64| if inertia > 0.0 { x / inertia } else { 0.0 };
            let (m, i) = (terms.mass, mean);
            Six::new(share(b[0], i), share(b[1], i), share(b[2], i), share(b[3], m), share(b[4], m), share(b[5], m))
        };
        for group in &self.graph.groups {
            for row in group.rows.clone() {
                let mobility = self.graph.mobility(group, row);
                self.w.mobility[row] = mobility;
                if mobility > 0.0 {
                    (least, most) = (least.min(mobility), most.max(mobility));
                }
                let terms = &self.graph.rows[row];
                let [first, second] = match group.on {
                    Acting::Coordinate { body, coordinate } => {
                        let s = &self.graph.terms.directions[coordinate];
                        [(s.dot(&self.graph.wrenches[body]) + self.graph.efforts[coordinate]) * mobility, 0.0]
                    }
                    Acting::Bodies { first, second } => {
                        [terms.on_first.dot(&free(first)), second.map_or(0.0, |s| terms.on_second.dot(&free(s)))]
                    }
                };
                let departure = unforced(group, row, first + second - terms.target, mobility);
                let size = first.abs() + second.abs() + terms.target.abs();
                self.scale = self.scale.max(departure).max(SMALLEST_SCALE * size);
            }
        }
        self.rho = if most > 0.0 { STIFFNESS / (least * most).sqrt() } else { STIFFNESS };
        if self.scale <= 0.0 {
            self.scale = 1.0;
        }
    }

    /// Curvatures by the guess: pushing contacts stick, or slip where they slipped.
    fn guess(&mut self, lambda: &[f64]) {
        for (number, group) in self.graph.groups.iter().enumerate() {
            let first = group.rows.start;
            let h = |row: usize| self.rho / (1.0 + self.rho * self.graph.rows[row].compliance);
            self.w.curvature[number] = match group.law {
                Law::HELD => diagonal(group, h),
                Law::Bounded { least, most } => {
                    diagonal(group, |row| if lambda[row] > least && lambda[row] < most { h(row) } else { 0.0 })
                }
                Law::Contact { friction, .. } => {
                    let tangential = lambda[first + 1].hypot(lambda[first + 2]);
                    let pushing = lambda[first] > 0.0;
                    let slips = tangential >= friction * lambda[first] * (1.0 - 1e-9);
                    let normal = if pushing { h(first) } else { 0.0 };
                    let rho = if pushing && !slips { self.rho } else { 0.0 };
                    self.w.radius[number] = if slips || !pushing { tangential } else { f64::INFINITY };
                    Curvature::Contact(normal, [rho, 0.0, rho])
                }
            };
        }
    }

    /// A + Jᵀ H J, factored.
    fn factor(&mut self, convergence: &mut Convergence) {
        convergence.factorizations += 1;
        let GraphWorkspace { factors, curvature, factored, blocks, .. } = &mut *self.w;
        factors.begin(self.elimination, &self.graph.bodies);
        for link in 0..self.graph.links.len() {
            for coordinate in self.elimination.coordinates_of(link) {
                let rotor = self.graph.rotors[coordinate];
                factors.add_to_coordinate(self.elimination, coordinate, link, rotor);
            }
        }
        for (number, group) in self.graph.groups.iter().enumerate() {
            add_group(self.graph, self.elimination, group, &curvature[number], blocks[number], factors);
        }
        factored.clone_from(curvature);
        self.elimination.factor(&self.graph.terms, factors);
    }

    /// Without an earlier motion: b + Jᵀ (H c), and the friction of slipping contacts.
    fn first_solve(&mut self, motions: &mut Vec<Six>, coordinates: &mut Vec<f64>, lambda: &mut [f64]) {
        motions.clone_from(&self.graph.wrenches);
        coordinates.clone_from(&self.graph.efforts);
        for (number, group) in self.graph.groups.iter().enumerate() {
            let start = group.rows.start;
            for row in group.rows.clone() {
                let target = self.graph.rows[row].target;
                lambda[row] = match self.w.curvature[number] {
                    Curvature::Diagonal(h) if h[row - start] > 0.0 => h[row - start] * target,
                    Curvature::Diagonal(_) => clamp_to(group.law, lambda[row]),
                    Curvature::Contact(normal, _) if row == start => normal * target,
                    Curvature::Contact(_, h) if h[0] > 0.0 => h[0] * target,
                    Curvature::Contact(normal, _) => if normal > 0.0 { lambda[row] } else { 0.0 },
                };
            }
        }
        self.graph.push(lambda, motions, coordinates);
        self.elimination.solve(&self.graph.terms, Offsets::Prescribed, motions, coordinates, &self.w.factors);
        self.read(motions, coordinates);
        self.respond(lambda);
    }

    /// One round with everything as guessed: small forces beside large ones are not yet right after the first, and would be
    /// taken to slip or to pull.
    ///
    /// Where forces are not unique, the first round has found the least-squares ones; they may lie outside their cones where
    /// others do not. So λ° goes from the guess as far towards them as all cones allow.
    fn refine(&mut self, motions: &mut [Six], coordinates: &mut [f64], lambda: &mut [f64]) {
        let share = self.share_of_least_squares(lambda);
        for group in &self.graph.groups {
            let start = group.rows.start;
            for row in group.rows.clone() {
                let (before, now) = (self.w.before[row], lambda[row]);
                self.w.center[row] = if before == 0.0 { now } else { before + share * (now - before) };
            }
            if let (Law::Contact { friction, .. }, false) = (group.law, known(group, &self.w.before)) {
                let center = &mut self.w.center[start..start + 3];
                center[0] = center[0].max(0.0);
                let (length, radius) = (center[1].hypot(center[2]), WITHIN * friction * center[0]);
                if length > radius {
                    center[1..].iter_mut().for_each(|x| *x *= radius / length);
                }
            }
        }
        self.respond(lambda);
        self.increment(motions, coordinates, lambda);
        self.advance(motions, coordinates, 1.0);
        self.predict(lambda, 1.0);
    }

    /// The forces with which (2) holds after a step s Δ, to rounding: s (λ - H J Δ), and 1 - s of those before. What (1)
    /// makes of the new motion is known less well: there ρ multiplies the rounding of u.
    fn predict(&mut self, lambda: &[f64], s: f64) {
        for (group, curvature) in self.graph.groups.iter().zip(&self.w.factored) {
            let start = group.rows.start;
            for row in group.rows.clone() {
                let c = |k: usize| self.w.change[start + k];
                let fall = match curvature {
                    Curvature::Diagonal(h) => h[row - start] * c(row - start),
                    Curvature::Contact(normal, [xx, xy, yy]) => match row - start {
                        0 => normal * c(0),
                        1 => xx * c(1) + xy * c(2),
                        _ => xy * c(1) + yy * c(2),
                    },
                };
                self.w.predicted[row] = s * (lambda[row] - fall) + (1.0 - s) * self.w.predicted[row];
            }
        }
    }

    /// Forces that are within the tolerance of their laws, within them.
    fn confine(&self, lambda: &mut [f64]) {
        for group in &self.graph.groups {
            let start = group.rows.start;
            match group.law {
                Law::Bounded { least, most } => {
                    group.rows.clone().for_each(|row| lambda[row] = lambda[row].clamp(least, most));
                }
                Law::Contact { friction, bound } => {
                    lambda[start] = lambda[start].clamp(0.0, bound);
                    let (length, radius) = (lambda[start + 1].hypot(lambda[start + 2]), friction * lambda[start]);
                    if length > radius {
                        lambda[start + 1] *= radius / length;
                        lambda[start + 2] *= radius / length;
                    }
                }
            }
        }
    }

    /// The largest share, up to all, of the way from the guess to `lambda` on which no contact that sticks leaves its cone.
    fn share_of_least_squares(&self, lambda: &[f64]) -> f64 {
        let mut share = 1.0_f64;
        for (group, curvature) in self.graph.groups.iter().zip(&self.w.factored) {
            let (Law::Contact { friction, .. }, Curvature::Contact(normal, h)) = (group.law, curvature) else { continue };
            if *normal <= 0.0 || h[0] <= 0.0 || !known(group, &self.w.before) {
                continue;
            }
            let start = group.rows.start;
            let at = |s: f64| [0, 1, 2].map(|k| {
                let before = self.w.before[start + k];
                before + s * (lambda[start + k] - before)
            });
            let inside = |s: f64| {
                let [n, x, y] = at(s);
                x.hypot(y) <= WITHIN * friction * n
            };
            if inside(share) {
                continue;
            }
            // The cone is convex: by halving.
            let (mut low, mut high) = (0.0, share);
            for _ in 0..SHARE_HALVINGS {
                let middle = 0.5 * (low + high);
                if inside(middle) { low = middle } else { high = middle }
            }
            share = low;
        }
        share
    }

    /// λ° - H u, without regard to laws; rows without curvature keep their force.
    fn respond(&self, lambda: &mut [f64]) {
        for (group, curvature) in self.graph.groups.iter().zip(&self.w.factored) {
            let start = group.rows.start;
            for row in group.rows.clone() {
                let h = match curvature {
                    Curvature::Diagonal(h) => h[row - start],
                    Curvature::Contact(normal, _) if row == start => *normal,
                    Curvature::Contact(_, h) => h[0],
                };
                if h > 0.0 {
                    lambda[row] = self.w.center[row] / self.softening(row) - h * self.w.u[row];
                }
            }
        }
    }

    /// 1 + ρ R.
    fn softening(&self, row: usize) -> f64 {
        1.0 + self.rho * self.graph.rows[row].compliance
    }

    /// u = J a - c.
    fn read(&mut self, motions: &[Six], coordinates: &[f64]) {
        for group in &self.graph.groups {
            for row in group.rows.clone() {
                self.w.u[row] =
                    self.graph.reading(group, row, motions, coordinates) - self.graph.rows[row].target;
            }
        }
    }

    fn update_radii(&mut self, lambda: &[f64]) {
        for (number, group) in self.graph.groups.iter().enumerate() {
            if let Law::Contact { friction, .. } = group.law {
                // A guess that turns out to pull has no friction.
                self.w.radius[number] = friction * lambda[group.rows.start].max(0.0);
            }
        }
    }

    /// λ by (1) and H at the present motion.
    fn evaluate(&mut self, lambda: &mut [f64]) {
        for (number, group) in self.graph.groups.iter().enumerate() {
            self.w.curvature[number] =
                project(self.graph, group, self.rho, self.w.radius[number], &self.w.center, |row| self.w.u[row], lambda);
            if let (Law::Contact { friction, .. }, true) = (group.law, self.w.radius[number] <= 0.0) {
                // A contact that begins to push may stick at once.
                let normal = lambda[group.rows.start];
                if normal > 0.0 {
                    self.w.radius[number] = friction * normal;
                    self.w.curvature[number] = project(
                        self.graph,
                        group,
                        self.rho,
                        self.w.radius[number],
                        &self.w.center,
                        |row| self.w.u[row],
                        lambda,
                    );
                }
            }
        }
    }

    /// The residual of the laws, at unit step 1/W; true if it is within the tolerance.
    fn settle(&mut self, lambda: &[f64], convergence: &mut Convergence) -> bool {
        let (mut worst, mut at) = (0.0_f64, None);
        for group in &self.graph.groups {
            for row in group.rows.clone() {
                let departure = self.departure(group, row, lambda);
                // Not a number counts as the worst.
                if !(departure <= worst) || at.is_none() {
                    (worst, at) = (departure, Some(row));
                }
            }
        }
        convergence.residual = worst / self.scale;
        convergence.worst = at;
        convergence.converged = convergence.residual <= self.settings.tolerance;
        convergence.converged
    }

    /// How far a row is from its law, in units of motion: W |λ - Π(λ - u/W)|.
    fn departure(&self, group: &ConstraintGroup, row: usize, lambda: &[f64]) -> f64 {
        let start = group.rows.start;
        let w = self.w.mobility[row].max(f64::MIN_POSITIVE);
        let whole = |row: usize| self.w.u[row] + self.graph.rows[row].compliance * lambda[row];
        match group.law {
            Law::Bounded { least, most } => w * (lambda[row] - (lambda[row] - whole(row) / w).clamp(least, most)).abs(),
            Law::Contact { bound, .. } if row == start => {
                w * (lambda[row] - (lambda[row] - whole(row) / w).clamp(0.0, bound)).abs()
            }
            Law::Contact { friction, .. } => {
                let radius = friction * lambda[start];
                let z = [1, 2].map(|k| lambda[start + k] - self.w.u[start + k] / w);
                let length = z[0].hypot(z[1]);
                let shrink = if length > radius { radius / length } else { 1.0 };
                w * (lambda[row] - z[row - start - 1] * shrink).abs()
            }
        }
    }

    /// λ° := λ, and λ, H for it at the same motion.
    fn recenter(&mut self, lambda: &mut [f64]) {
        self.w.center.copy_from_slice(lambda);
        self.evaluate(lambda);
    }

    /// Δ, guarded by a line search, added to the motion.
    fn newton_step(&mut self, motions: &mut [Six], coordinates: &mut [f64], lambda: &[f64]) {
        self.increment(motions, coordinates, lambda);
        let length = self.step_length(motions, coordinates, lambda);
        self.advance(motions, coordinates, length);
        self.predict(lambda, length);
    }

    /// (A + Jᵀ H J) Δ = b + Jᵀ λ - A a.
    fn increment(&mut self, motions: &[Six], coordinates: &[f64], lambda: &[f64]) {
        let GraphWorkspace { step, step_coordinates, factors, .. } = &mut *self.w;
        let known = self.graph.bodies.iter().zip(&self.graph.wrenches);
        for (r, ((body, b), a)) in step.iter_mut().zip(known.zip(motions)) {
            *r = b - body.times(a);
        }
        let known = self.graph.efforts.iter().zip(&self.graph.rotors);
        for (r, ((effort, rotor), q)) in step_coordinates.iter_mut().zip(known.zip(coordinates)) {
            *r = effort - rotor * q;
        }
        self.graph.push(lambda, step, step_coordinates);
        self.elimination.solve(&self.graph.terms, Offsets::None, step, step_coordinates, factors);
        for group in &self.graph.groups {
            for row in group.rows.clone() {
                self.w.change[row] = self.graph.reading(group, row, &self.w.step, &self.w.step_coordinates);
            }
        }
    }

    /// a += s Δ.
    fn advance(&self, motions: &mut [Six], coordinates: &mut [f64], length: f64) {
        for (a, step) in motions.iter_mut().zip(&self.w.step) {
            a.axpy(length, step, 1.0);
        }
        for (q, step) in coordinates.iter_mut().zip(&self.w.step_coordinates) {
            *q += length * step;
        }
    }

    /// Where φ along Δ is least: φ'(s) = Δᵀ(A a - b) + s Δᵀ A Δ - (J Δ)ᵀ λ(s), which rises with s.
    fn step_length(&mut self, motions: &[Six], coordinates: &[f64], lambda: &[f64]) -> f64 {
        if self.graph.groups.iter().all(|g| g.law == Law::HELD) {
            return 1.0;
        }
        let (mut constant, mut linear) = (0.0, 0.0);
        for (i, d) in self.w.step.iter().enumerate() {
            let body = &self.graph.bodies[i];
            constant += d.dot(&(body.times(&motions[i]) - self.graph.wrenches[i]));
            linear += d.dot(&body.times(d));
        }
        for (k, d) in self.w.step_coordinates.iter().enumerate() {
            constant += d * (self.graph.rotors[k] * coordinates[k] - self.graph.efforts[k]);
            linear += d * d * self.graph.rotors[k];
        }
        let work = |lambda: &[f64]| -> f64 { lambda.iter().zip(&self.w.change).map(|(l, c)| l * c).sum() };
        let start = constant - work(lambda);
        let mut trial = lambda.to_vec();
        let mut slope = |s: f64| {
            for (number, group) in self.graph.groups.iter().enumerate() {
                let u = |row: usize| self.w.u[row] + s * self.w.change[row];
                project(self.graph, group, self.rho, self.w.radius[number], &self.w.center, u, &mut trial);
            }
            constant + s * linear - work(&trial)
        };
        if slope(1.0) <= 0.5 * start.abs() {
            return 1.0;
        }
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            let here = slope(middle);
            if here.abs() <= 0.1 * start.abs() {
                return middle;
            }
            if here > 0.0 { high = middle } else { low = middle }
        }
        0.5 * (low + high)
    }
}

/// How far a row without force is from its law at a motion u: limits and contacts that are open ask for nothing.
fn unforced(group: &ConstraintGroup, row: usize, u: f64, mobility: f64) -> f64 {
    match group.law {
        Law::HELD => u.abs(),
        Law::Bounded { least, most } if mobility > 0.0 => mobility * (-u / mobility).clamp(least, most).abs(),
        Law::Contact { .. } if row == group.rows.start => (-u).max(0.0),
        _ => u.abs(),
    }
}

fn diagonal(group: &ConstraintGroup, h: impl Fn(usize) -> f64) -> Curvature {
    let mut values = [0.0; 6];
    for (value, row) in values.iter_mut().zip(group.rows.clone()) {
        *value = h(row);
    }
    Curvature::Diagonal(values)
}

/// Whether a contact has a past: more than the mark of a new one.
fn known(group: &ConstraintGroup, before: &[f64]) -> bool {
    before[group.rows.start] > f64::MIN_POSITIVE
}

fn clamp_to(law: Law, lambda: f64) -> f64 {
    match law {
        Law::Bounded { least, most } => lambda.clamp(least, most),
        Law::Contact { .. } => lambda,
    }
}

/// λ of one group by (1), and its H.
#[inline]
fn project(
    graph: &ConstraintGraph,
    group: &ConstraintGroup,
    rho: f64,
    radius: f64,
    center: &[f64],
    u: impl Fn(usize) -> f64,
    lambda: &mut [f64],
) -> Curvature {
    let start = group.rows.start;
    // One row confined to [least, most].
    let clamped = |row: usize, least: f64, most: f64| {
        let soft = 1.0 + rho * graph.rows[row].compliance;
        let z = (center[row] - rho * u(row)) / soft;
        if z <= least {
            (least, 0.0)
        } else if z >= most {
            (most, 0.0)
        } else {
            (z, rho / soft)
        }
    };
    match group.law {
        Law::Bounded { least, most } => {
            let mut h = [0.0; 6];
            for row in group.rows.clone() {
                (lambda[row], h[row - start]) = clamped(row, least, most);
            }
            Curvature::Diagonal(h)
        }
        Law::Contact { bound, .. } => {
            let (normal, h) = clamped(start, 0.0, bound);
            lambda[start] = normal;
            let z = [1, 2].map(|k| center[start + k] - rho * u(start + k));
            let length = z[0].hypot(z[1]);
            if length <= radius {
                (lambda[start + 1], lambda[start + 2]) = (z[0], z[1]);
                return Curvature::Contact(h, [rho, 0.0, rho]);
            }
            let (x, y) = (z[0] / length, z[1] / length);
            (lambda[start + 1], lambda[start + 2]) = (radius * x, radius * y);
            let across = rho * radius / length;
            Curvature::Contact(h, [across * y * y, -across * x * y, across * x * x])
        }
    }
}

/// Adds Jᵀ H J of one group.
fn add_group(
    graph: &ConstraintGraph,
    elimination: &Elimination,
    group: &ConstraintGroup,
    curvature: &Curvature,
    block: Option<(usize, bool)>,
    factors: &mut EliminationWorkspace,
) {
    let start = group.rows.start;
    let (first, second) = match group.on {
        Acting::Coordinate { body, coordinate } => {
            if let Curvature::Diagonal(h) = curvature {
                factors.add_to_coordinate(elimination, coordinate, body, h[0]);
            }
            return;
        }
        Acting::Bodies { first, second } => (first, second),
    };
    let mut add = |m: usize, n: usize, h: f64| {
        if h == 0.0 {
            return;
        }
        let (one, other) = (&graph.rows[start + m], &graph.rows[start + n]);
        factors.diagonal_mut(first).add_outer(&one.on_first, &other.on_first, h);
        if let (Some(second), Some((block, swapped))) = (second, block) {
            factors.diagonal_mut(second).add_outer(&one.on_second, &other.on_second, h);
            let place: &mut Block = factors.off_mut(block);
            if swapped {
                place.add_outer(&one.on_second, &other.on_first, h);
            } else {
                place.add_outer(&one.on_first, &other.on_second, h);
            }
        }
    };
    match curvature {
        Curvature::Diagonal(h) => (0..group.rows.len()).for_each(|k| add(k, k, h[k])),
        Curvature::Contact(normal, [xx, xy, yy]) => {
            add(0, 0, *normal);
            add(1, 1, *xx);
            add(1, 2, *xy);
            add(2, 1, *xy);
            add(2, 2, *yy);
        }
    }
}
