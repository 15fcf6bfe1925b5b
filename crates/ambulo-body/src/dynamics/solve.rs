//! Solves constraint graphs with a chosen method; holds the scratch memory that the methods share.
//!
//! [`Method::Newton`] factors trees and rows together: loops cost some fill-in, contacts one factorisation each time that one
//! opens, sticks or slips. [`Method::ConjugateGradient`] factors the trees once and refines the forces of the rows by tree
//! solves. tests/constraint_graph.rs counts the tree solves and factorisations of both on ladders, tables, walls and towers.

use super::block::Six;
use super::conjugate_gradient::{self, ConjugateWorkspace};
use super::constraint::{ActsOn, ConstraintGraph, ConstraintGroup, GraphSolution};
use super::departure::Departures;
use super::elimination::EliminationWorkspace;
use super::elimination_order::{Elimination, Link, LinkError, outwards};
use super::lumped::LumpedGraph;
use super::problem::{Method, Problem, SolverSettings};
use super::proximal::{self, NewtonWorkspace};
use std::collections::BTreeMap;

/// A row is determined if less than this share of a random probe remains in it: regular rows leave 1e-12, a duplicated row
/// leaves 1/2, and a row that occurs k times (k-1)/k.
const UNDETERMINED: f64 = 1e-6;

/// Scratch memory of the solver. Nothing is allocated while the structure of the graph is unchanged.
#[derive(Debug, Clone, Default)]
pub struct GraphWorkspace {
    /// All links, and all bodies with their parents, parents first.
    all_links: Vec<Link>,
    outwards: Vec<(usize, Option<usize>)>,
    lumped: LumpedGraph,
    /// Whether the last graph was solved in its lumped form.
    is_lumped: bool,
    /// Links of the solved graph.
    links: Vec<Link>,
    /// Bodies that each group couples.
    shape: Vec<Option<(usize, usize)>>,
    elimination: Option<Elimination>,
    /// Off-diagonal block of each group that couples two bodies, and whether it is transposed.
    blocks: Vec<Option<(usize, bool)>>,
    /// Settings of the last solution.
    settings: SolverSettings,
    pub(super) factors: EliminationWorkspace,
    pub(super) departures: Departures,
    newton: NewtonWorkspace,
    conjugate: ConjugateWorkspace,
}

/// Solves the graph. On entry, `solution.lambda` is a guess of the forces, for example those of the last time step: it determines
/// which contacts are first treated as loaded and as slipping, and where conjugate gradient starts. The guess of a new contact is
/// a positive normal force without friction.
///
/// If rows contradict each other (a drive against a wall), [`Convergence::converged`](super::Convergence::converged) is false and
/// the row with the largest departure is reported; forces stay within their bounds.
///
/// # Errors
/// Links that do not form trees.
pub fn solve_graph(
    graph: &ConstraintGraph,
    settings: &SolverSettings,
    workspace: &mut GraphWorkspace,
    solution: &mut GraphSolution,
) -> Result<(), LinkError> {
    workspace.settings = *settings;
    solution.lambda.resize(graph.rows.len(), 0.0);
    workspace.order_bodies(&graph.links)?;
    let mut lumped = std::mem::take(&mut workspace.lumped);
    workspace.is_lumped = settings.method == Method::Newton && lumped.take(graph, &workspace.outwards);
    let done = if workspace.is_lumped {
        std::mem::swap(&mut lumped.solution.lambda, &mut solution.lambda);
        let done = workspace.solve(&lumped.graph, &mut lumped.solution);
        std::mem::swap(&mut lumped.solution.lambda, &mut solution.lambda);
        lumped.spread(&lumped.solution.motions, &mut solution.motions);
        solution.coordinates.clone_from(&lumped.solution.coordinates);
        solution.convergence = lumped.solution.convergence;
        done
    } else {
        workspace.solve(graph, solution)
    };
    workspace.lumped = lumped;
    done
}

/// Displacements that bring the rows active at the last solution to `targets` with the least motion of mass: M δ = Jᵀ ν,
/// J δ = targets, within the free directions of the joints. Uses the last factorisation and the last method.
pub fn project_displacements(
    graph: &ConstraintGraph,
    targets: &[f64],
    workspace: &mut GraphWorkspace,
    motions: &mut Vec<Six>,
    coordinates: &mut Vec<f64>,
) {
    coordinates.clear();
    coordinates.resize(graph.efforts.len(), 0.0);
    if workspace.is_lumped {
        let mut lumped = std::mem::take(&mut workspace.lumped);
        lumped.begin_displacements();
        let LumpedGraph { graph: less, displacements, .. } = &mut lumped;
        workspace.with_problem(less, |mut problem, newton, _| {
            proximal::project(&mut problem, newton, targets, displacements, coordinates);
        });
        lumped.spread(&lumped.displacements, motions);
        workspace.lumped = lumped;
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

/// Active rows of the last solution whose forces the motion does not determine, because some combination of them with others
/// moves nothing (a flat foot on four points, a planar loop closed by spatial rows). Uses the last factorisation.
///
/// The rows get a probe z of random targets. The part of it that no force can produce lies in the null space of J A⁻¹ Jᵀ, and
/// appears with probability one in exactly the rows that the null space involves. Costs a few tree solves with Newton's
/// method, as many as a solution with conjugate gradient.
#[must_use]
pub fn undetermined_rows(graph: &ConstraintGraph, workspace: &mut GraphWorkspace) -> Vec<usize> {
    let mut left = probe(graph.rows.len());
    let lumped = std::mem::take(&mut workspace.lumped);
    let solved = if workspace.is_lumped { &lumped.graph } else { graph };
    workspace.with_problem(solved, |mut problem, newton, conjugate| match problem.settings.method {
        Method::Newton => proximal::without_range(&mut problem, newton, &mut left),
        Method::ConjugateGradient => conjugate_gradient::without_range(&mut problem, conjugate, &mut left),
    });
    workspace.lumped = lumped;
    (0..left.len()).filter(|row| left[*row].abs() > UNDETERMINED).collect()
}

/// Fixed pseudo-random numbers between 1/2 and 3/2: fractional parts of a quadratic in multiples of the golden ratio.
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
    /// Updates the order of the bodies if links have changed.
    fn order_bodies(&mut self, links: &[Link]) -> Result<(), LinkError> {
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

    /// Prepares the elimination for this graph; it is rebuilt only if links or couplings have changed.
    fn prepare(&mut self, graph: &ConstraintGraph) -> Result<(), LinkError> {
        let method = self.settings.method;
        let pair = |group: &ConstraintGroup| match group.on {
            ActsOn::Bodies { first, second: Some(second) } if method == Method::Newton => Some((first, second)),
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

    /// The bodies of the last graph with their parents, parents first.
    #[inline]
    #[must_use]
    pub fn outwards(&self) -> &[(usize, Option<usize>)] {
        &self.outwards
    }

    /// Calls `work` with the problem; does nothing before the first solution.
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
    use crate::dynamics::block::transport;
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
        let on = ActsOn::Bodies { first: 0, second: Some(1) };
        graph.groups.push(ConstraintGroup { on, rows: 0..3, law: Law::EQUALITY });
        let on = ActsOn::Bodies { first: 1, second: None };
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
                    // Rows have a stiffness of 1e6; drift only needs to be corrected.
                    assert!((reading - targets[row]).abs() < 1e-8, "{method:?}, row {row}: {reading}");
                }
            }
            found.push(motions);
        }
        for (one, other) in found[0].iter().zip(&found[1]) {
            // Each method departs from its targets by 1e-6 of them.
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
        let on = ActsOn::Bodies { first: 2, second: None };
        graph.groups.push(ConstraintGroup { on, rows: 4..5, law: Law::EQUALITY });
        graph
    }

    #[test]
    fn displacements_of_bodies_that_follow_are_those_of_a_method_that_knows_them_one_by_one() {
        let graph = carrying();
        let targets = [1e-3, -2e-3, 5e-4, 3e-3, -1e-3];
        let mut found = Vec::new();
        for method in [Method::Newton, Method::ConjugateGradient] {
            let settings = SolverSettings { method, ..SolverSettings::default() };
            let (mut workspace, mut solution) = (GraphWorkspace::default(), GraphSolution::default());
            solve_graph(&graph, &settings, &mut workspace, &mut solution).unwrap();
            assert_eq!(workspace.is_lumped, method == Method::Newton);
            let (mut motions, mut coordinates) = (Vec::new(), Vec::new());
            project_displacements(&graph, &targets, &mut workspace, &mut motions, &mut coordinates);
            // The offset of the motion is none of the displacement.
            let arm = graph.terms.arm[2];
            assert!((motions[2] - transport(&motions[1], &arm)).norm() < 1e-15);
            found.push(motions);
        }
        for (one, other) in found[0].iter().zip(&found[1]) {
            // With a stiffness of 1e6 per row, 1e-5 of 3 mm remain where rows share a body.
            assert!((one - other).norm() < 3e-7, "{one:?} {other:?}");
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
