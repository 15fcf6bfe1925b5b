//! Solving a constraint graph: which method, how far, and the scratch that methods share.
//!
//! [`Method::Newton`] factors trees and rows together: loops cost a little fill-in, contacts a factorisation each time
//! that one opens, sticks or slips. [`Method::ConjugateGradient`] factors the trees alone, once, and refines the rows'
//! forces by tree solves. Measured on ladders, tables, walls and towers in tests/constraint_graph.rs (tree solves and
//! factorisations of both).

use super::carried::Carried;
use super::conjugate_gradient::{self, ConjugateWorkspace};
use super::constraint::{Acting, ConstraintGraph, ConstraintGroup, GraphSolution, Six};
use super::departure::Departures;
use super::elimination::{Elimination, EliminationWorkspace, Link, LinkError, outwards};
use super::proximal::{self, NewtonWorkspace};
use std::collections::BTreeMap;

/// A row whose reading of a probe that nothing can balance is below this share of the probe is determined: regular rows
/// leave 1e-12 of it, a row that stands twice one half, and one that stands k times (k-1)/k.
const UNDETERMINED: f64 = 1e-6;

/// How closing rows and contacts are solved.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Method {
    /// Newton steps on an augmented Lagrangian. A guess of the forces has no part in the result beyond rounding, so that
    /// redundant rows share least-squares forces whatever came before.
    #[default]
    Newton,
    /// Conjugate gradient, as in the paper. Begins at the guess; redundant rows get the forces nearest to it, which for no
    /// guess are the least-squares ones.
    ConjugateGradient,
}

/// How far to iterate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SolverSettings {
    /// By which method.
    pub method: Method,
    /// Largest residual accepted; see [`Convergence::residual`](super::Convergence::residual).
    pub tolerance: f64,
    /// Most tree solves. Newton needs few whatever the scene; conjugate gradient up to some multiple of the number of
    /// rows.
    pub max_iterations: usize,
}

impl Default for SolverSettings {
    fn default() -> Self {
        SolverSettings { method: Method::Newton, tolerance: 1e-10, max_iterations: 100 }
    }
}

/// Scratch of the solver. Nothing is allocated while the graph keeps its shape.
#[derive(Debug, Clone, Default)]
pub struct GraphWorkspace {
    /// All links, and their bodies with their parents, parents first.
    all_links: Vec<Link>,
    outwards: Vec<(usize, Option<usize>)>,
    carried: Carried,
    /// Whether the graph was last solved as what its bodies carry.
    carries: bool,
    /// Links of the graph that is solved.
    links: Vec<Link>,
    /// Bodies that each group couples.
    shape: Vec<Option<(usize, usize)>>,
    elimination: Option<Elimination>,
    /// Off-diagonal block of each group that couples two bodies, and whether it is transposed.
    blocks: Vec<Option<(usize, bool)>>,
    /// As last solved with.
    settings: SolverSettings,
    pub(super) factors: EliminationWorkspace,
    pub(super) departures: Departures,
    newton: NewtonWorkspace,
    conjugate: ConjugateWorkspace,
}

/// What a method works on.
pub(super) struct Problem<'a> {
    pub(super) graph: &'a ConstraintGraph,
    pub(super) elimination: &'a Elimination,
    pub(super) settings: SolverSettings,
    pub(super) blocks: &'a [Option<(usize, bool)>],
    pub(super) factors: &'a mut EliminationWorkspace,
    pub(super) departures: &'a mut Departures,
}

impl Problem<'_> {
    /// The inertias of bodies and coordinates, not yet factored.
    pub(super) fn begin(&mut self) {
        self.factors.begin(self.elimination, &self.graph.bodies);
        for body in 0..self.graph.links.len() {
            for coordinate in self.elimination.coordinates_of(body) {
                let rotor = self.graph.rotors[coordinate];
                self.factors.add_to_coordinate(self.elimination, coordinate, body, rotor);
            }
        }
    }
}

/// Solves the graph. `solution.lambda` holds a guess of the forces, as of the last step: from it comes which contacts are
/// first taken as pushing and which as slipping, and where conjugate gradient begins. A contact without a past gets a
/// positive normal force and no other.
///
/// Rows whose laws contradict each other (a drive against a wall) leave
/// [`Convergence::converged`](super::Convergence::converged) false, with the row that departs most; forces stay within their
/// bounds.
///
/// # Errors
/// A graph whose links are no forest.
pub fn solve_graph(
    graph: &ConstraintGraph,
    settings: &SolverSettings,
    workspace: &mut GraphWorkspace,
    solution: &mut GraphSolution,
) -> Result<(), LinkError> {
    workspace.settings = *settings;
    solution.lambda.resize(graph.rows.len(), 0.0);
    workspace.hang(&graph.links)?;
    let mut carried = std::mem::take(&mut workspace.carried);
    workspace.carries = settings.method == Method::Newton && carried.take(graph, &workspace.outwards);
    let done = if workspace.carries {
        std::mem::swap(&mut carried.solution.lambda, &mut solution.lambda);
        let done = workspace.solve(&carried.graph, &mut carried.solution);
        std::mem::swap(&mut carried.solution.lambda, &mut solution.lambda);
        carried.spread(&carried.solution.motions, &mut solution.motions);
        solution.coordinates.clone_from(&carried.solution.coordinates);
        solution.convergence = carried.solution.convergence;
        done
    } else {
        workspace.solve(graph, solution)
    };
    workspace.carried = carried;
    done
}

/// Displacements that carry the rows that hold at the last solution to `targets`, with the least mass moved: M δ = Jᵀ ν,
/// J δ = targets, and the joints' offsets as they stand in the graph. Uses the last factor and the last method.
pub(crate) fn project_displacements(
    graph: &ConstraintGraph,
    targets: &[f64],
    workspace: &mut GraphWorkspace,
    motions: &mut Vec<Six>,
    coordinates: &mut Vec<f64>,
) {
    coordinates.clear();
    coordinates.resize(graph.efforts.len(), 0.0);
    if workspace.carries {
        let mut carried = std::mem::take(&mut workspace.carried);
        carried.begin_displacements(graph, &workspace.outwards, targets);
        let Carried { graph: less, displacements, targets, .. } = &mut carried;
        workspace.with_problem(less, |mut problem, newton, _| {
            proximal::project(&mut problem, newton, targets, displacements, coordinates);
        });
        carried.spread(&carried.displacements, motions);
        workspace.carried = carried;
        return;
    }
    motions.clear();
    motions.resize(graph.bodies.len(), Six::zeros());
    workspace.with_problem(graph, |mut problem, newton, conjugate| match problem.settings.method {
        Method::Newton => proximal::project(&mut problem, newton, targets, motions, coordinates),
        Method::ConjugateGradient => {
            conjugate_gradient::project(&mut problem, conjugate, targets, motions, coordinates);
        }
    });
}

/// The same for bodies that have already been placed, `off` from where their motion takes them: displacements of all from
/// the places where they are, with the least mass moved from where their motion takes them. Of a graph that was solved as
/// what its bodies carry.
pub(crate) fn project_placed(
    graph: &ConstraintGraph,
    off: &[Six],
    targets: &[f64],
    workspace: &mut GraphWorkspace,
    motions: &mut Vec<Six>,
    coordinates: &mut Vec<f64>,
) {
    coordinates.clear();
    coordinates.resize(graph.efforts.len(), 0.0);
    let mut carried = std::mem::take(&mut workspace.carried);
    carried.begin_placed(graph, off);
    let Carried { graph: less, displacements, .. } = &mut carried;
    workspace.with_problem(less, |mut problem, newton, _| {
        proximal::project(&mut problem, newton, targets, displacements, coordinates);
    });
    carried.spread(&carried.displacements, motions);
    workspace.carried = carried;
}

/// Rows that hold at the last solution and whose forces the motion does not determine: some combination of them with
/// others moves nothing (a flat foot on four points, a loop in the plane closed by rows for space). Uses the last factor.
///
/// A probe z of random targets is asked of the rows. What no force can bring about is its part in the null space of
/// J A⁻¹ Jᵀ; with probability one it shows in exactly the rows that the null space touches. Costs a few tree solves with
/// Newton's method, as many as a solution with conjugate gradient.
#[must_use]
pub fn undetermined_rows(graph: &ConstraintGraph, workspace: &mut GraphWorkspace) -> Vec<usize> {
    let mut left = probe(graph.rows.len());
    let carried = std::mem::take(&mut workspace.carried);
    let solved = if workspace.carries { &carried.graph } else { graph };
    workspace.with_problem(solved, |mut problem, newton, conjugate| match problem.settings.method {
        Method::Newton => proximal::without_range(&mut problem, newton, &mut left),
        Method::ConjugateGradient => conjugate_gradient::without_range(&mut problem, conjugate, &mut left),
    });
    workspace.carried = carried;
    (0..left.len()).filter(|row| left[*row].abs() > UNDETERMINED).collect()
}

/// Numbers between 1/2 and 3/2 without a pattern, the same ones each time: fractions of multiples of the golden section's
/// square, bent.
fn probe(count: usize) -> Vec<f64> {
    let golden = 0.618_033_988_749_895;
    (0..count)
        .map(|k| {
            let x = (k as f64 * golden * (1.0 + golden * k as f64)).fract();
            0.5 + x
        })
        .collect()
}

impl GraphWorkspace {
    /// Sorts out who hangs on whom, if that has changed.
    fn hang(&mut self, links: &[Link]) -> Result<(), LinkError> {
        if self.all_links == links && !self.outwards.is_empty() {
            return Ok(());
        }
        let order = outwards(links)?;
        self.all_links.clear();
        self.all_links.extend_from_slice(links);
        self.outwards.clear();
        self.outwards.extend(order.into_iter().map(|body| (body, links[body].parent)));
        Ok(())
    }

    fn solve(&mut self, graph: &ConstraintGraph, solution: &mut GraphSolution) -> Result<(), LinkError> {
        self.prepare(graph)?;
        self.departures.measure(graph);
        self.with_problem(graph, |mut problem, newton, conjugate| match problem.settings.method {
            Method::Newton => proximal::solve(&mut problem, newton, solution),
            Method::ConjugateGradient => conjugate_gradient::solve(&mut problem, conjugate, solution),
        });
        Ok(())
    }

    /// The elimination for this graph, made anew only if its shape has changed.
    fn prepare(&mut self, graph: &ConstraintGraph) -> Result<(), LinkError> {
        let method = self.settings.method;
        let pair = |group: &ConstraintGroup| match group.on {
            Acting::Bodies { first, second: Some(second) } if method == Method::Newton => Some((first, second)),
            _ => None,
        };
        let shape = graph.groups.iter().map(pair);
        if self.elimination.is_some() && self.links == graph.links && shape.clone().eq(self.shape.iter().copied()) {
            return Ok(());
        }
        self.elimination = None;
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

    /// Whether the last graph was solved as what its bodies carry.
    pub(crate) fn carries(&self) -> bool {
        self.carries
    }

    /// Bodies with their parents, parents first, as last solved.
    #[must_use]
    pub fn outwards(&self) -> &[(usize, Option<usize>)] {
        &self.outwards
    }

    /// Nothing happens before the first solution.
    fn with_problem(
        &mut self,
        graph: &ConstraintGraph,
        work: impl FnOnce(Problem<'_>, &mut NewtonWorkspace, &mut ConjugateWorkspace),
    ) {
        let GraphWorkspace { elimination, settings, blocks, factors, departures, newton, conjugate, .. } = self;
        if let Some(elimination) = elimination {
            work(Problem { graph, elimination, settings: *settings, blocks, factors, departures }, newton, conjugate);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::{BodyTerms, Constraint, Law};
    use crate::spatial::{Mat3, Vec3};

    /// Two free bodies, three rows between them and one to ground.
    fn pair() -> ConstraintGraph {
        let mut graph = ConstraintGraph::default();
        for mass in [1.0, 3.0] {
            graph.links.push(Link { parent: None, freedom: 6 });
            graph.bodies.push(BodyTerms { mass, inertia: Mat3::identity() * (0.2 * mass) });
            graph.wrenches.push(Six::new(0.3, 0.1, -0.2, 1.0, 0.0, -9.81 * mass));
            graph.terms.arm.push(Vec3::zeros());
            graph.terms.offset.push(Six::zeros());
            graph.terms.directions.extend((0..6).map(|k| Six::ith(k, 1.0)));
            graph.efforts.extend([0.0; 6]);
            graph.rotors.extend([0.0; 6]);
        }
        for k in 0..3 {
            let on_first = Six::ith(3 + k, 1.0) + Six::ith(k, 0.3);
            graph.rows.push(Constraint { on_first, on_second: -Six::ith(3 + k, 1.0), target: 0.0, compliance: 0.0 });
        }
        let upright = Six::ith(5, 1.0);
        graph.rows.push(Constraint { on_first: upright, on_second: Six::zeros(), target: 0.0, compliance: 0.0 });
        let on = Acting::Bodies { first: 0, second: Some(1) };
        graph.groups.push(ConstraintGroup { on, rows: 0..3, law: Law::HELD });
        let on = Acting::Bodies { first: 1, second: None };
        let pushes = Law::Bounded { least: 0.0, most: f64::INFINITY };
        graph.groups.push(ConstraintGroup { on, rows: 3..4, law: pushes });
        graph
    }

    #[test]
    fn displacements_carry_rows_that_hold_to_their_targets_by_either_method() {
        let graph = pair();
        let targets = [1e-3, -2e-3, 5e-4, 3e-3];
        let mut found = Vec::new();
        for method in [Method::Newton, Method::ConjugateGradient] {
            let settings = SolverSettings { method, ..SolverSettings::default() };
            let (mut workspace, mut solution) = (GraphWorkspace::default(), GraphSolution::default());
            solve_graph(&graph, &settings, &mut workspace, &mut solution).unwrap();
            assert!(solution.convergence.converged && solution.lambda[3] > 0.0);
            let (mut motions, mut coordinates) = (Vec::new(), Vec::new());
            project_displacements(&graph, &targets, &mut workspace, &mut motions, &mut coordinates);
            for group in &graph.groups {
                for row in group.rows.clone() {
                    let reading = graph.reading(group, row, &motions, &coordinates);
                    // A stiffness of 1e6, and drift that needs only be undone.
                    assert!((reading - targets[row]).abs() < 1e-8, "{method:?}, row {row}: {reading}");
                }
            }
            found.push(motions);
        }
        for (one, other) in found[0].iter().zip(&found[1]) {
            // Either departs from its targets by 1e-6 of them.
            assert!((one - other).norm() < 1e-7, "the least mass moved is one: {:e}", (one - other).norm());
        }
    }

    /// The pair, with a third body that follows the second one.
    fn carrying() -> ConstraintGraph {
        let mut graph = pair();
        graph.links.push(Link { parent: Some(1), freedom: 0 });
        graph.bodies.push(BodyTerms { mass: 2.0, inertia: Mat3::identity() * 0.3 });
        graph.wrenches.push(Six::new(0.1, -0.4, 0.2, 0.5, 0.0, -19.62));
        graph.terms.arm.push(Vec3::new(0.4, -0.3, 0.2));
        graph.terms.offset.push(Six::new(0.02, -0.01, 0.03, 0.05, 0.01, -0.02));
        let up = Six::new(0.1, 0.2, 0.0, 0.0, 0.3, 1.0);
        graph.rows.push(Constraint { on_first: up, on_second: Six::zeros(), target: 0.1, compliance: 0.0 });
        let on = Acting::Bodies { first: 2, second: None };
        graph.groups.push(ConstraintGroup { on, rows: 4..5, law: Law::HELD });
        graph
    }

    #[test]
    fn displacements_of_bodies_that_follow_are_those_of_a_method_that_knows_them_one_by_one() {
        let mut graph = carrying();
        let targets = [1e-3, -2e-3, 5e-4, 3e-3, -1e-3];
        let mut found = Vec::new();
        for method in [Method::Newton, Method::ConjugateGradient] {
            let settings = SolverSettings { method, ..SolverSettings::default() };
            let (mut workspace, mut solution) = (GraphWorkspace::default(), GraphSolution::default());
            solve_graph(&graph, &settings, &mut workspace, &mut solution).unwrap();
            assert_eq!(workspace.carries(), method == Method::Newton);
            // Offsets of the displacements are others than those of the motion.
            graph.terms.offset[2] = Six::new(0.0, 1e-4, 0.0, 2e-4, 0.0, 3e-4);
            let (mut motions, mut coordinates) = (Vec::new(), Vec::new());
            project_displacements(&graph, &targets, &mut workspace, &mut motions, &mut coordinates);
            found.push(motions);
            graph.terms.offset[2] = carrying().terms.offset[2];
        }
        for (one, other) in found[0].iter().zip(&found[1]) {
            // A stiffness of 1e6 of single rows leaves 1e-5 of 3 mm where rows share what moves.
            assert!((one - other).norm() < 3e-7, "{one:?} {other:?}");
        }
    }

    #[test]
    fn bodies_already_placed_are_shifted_as_if_they_were_not() {
        // To first order it is the same to say where a body is off, or to have it drawn back by its joint.
        let mut graph = carrying();
        let targets = [0.0; 5];
        let (mut workspace, mut solution) = (GraphWorkspace::default(), GraphSolution::default());
        solve_graph(&graph, &SolverSettings::default(), &mut workspace, &mut solution).unwrap();
        let off = Six::new(0.0, 0.0, 0.0, 2e-4, 1e-4, 3e-4);
        graph.terms.offset[2] = off;
        let (mut drawn, mut coordinates) = (Vec::new(), Vec::new());
        project_displacements(&graph, &targets, &mut workspace, &mut drawn, &mut coordinates);
        let mut placed = Vec::new();
        let shifts = [Six::zeros(), Six::zeros(), off];
        // Its own row is then off by as much.
        let left = [0.0, 0.0, 0.0, 0.0, -graph.rows[4].on_first.dot(&off)];
        project_placed(&graph, &shifts, &left, &mut workspace, &mut placed, &mut coordinates);
        for (body, (one, other)) in drawn.iter().zip(&placed).enumerate() {
            assert!((one - (other + shifts[body])).norm() < 1e-9, "body {body}: {one:?} {other:?}");
        }
    }

    #[test]
    fn displacements_leave_alone_the_rows_that_do_not_hold() {
        let mut graph = pair();
        // Pulled up, the limit is not met.
        graph.wrenches[1][5] = 50.0;
        for method in [Method::Newton, Method::ConjugateGradient] {
            let settings = SolverSettings { method, ..SolverSettings::default() };
            let (mut workspace, mut solution) = (GraphWorkspace::default(), GraphSolution::default());
            solve_graph(&graph, &settings, &mut workspace, &mut solution).unwrap();
            assert!(solution.lambda[3].abs() <= 0.0, "{method:?}: {}", solution.lambda[3]);
            let (mut motions, mut coordinates) = (Vec::new(), Vec::new());
            let targets = [0.0, 0.0, 0.0, 1e-3];
            project_displacements(&graph, &targets, &mut workspace, &mut motions, &mut coordinates);
            assert!(motions.iter().all(|d| d.norm() < 1e-12), "{method:?}: {motions:?}");
        }
    }
}
