//! Solves constraint graphs with a chosen method; holds the scratch memory that the methods share.
//!
//! [`Method::Newton`] factors trees and rows together: loops cost some fill-in, contacts one factorisation each time
//! that one opens, sticks or slips. [`Method::ConjugateGradient`] factors the trees once and refines the forces of the
//! rows by tree solves. tests/constraint_graph.rs counts the tree solves and factorisations of both on ladders, tables,
//! walls and towers.

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

/// A row is determined if less than this share of a random probe remains in it: regular rows leave 1e-12, a duplicated
/// row leaves 1/2, and a row that occurs k times (k-1)/k.
const UNDETERMINED: f64 = 1e-6;

/// Scratch memory of the solver. Nothing is allocated while the structure of the graph is unchanged.
#[derive(Debug, Clone, Default)]
pub struct GraphWorkspace {
    /// All links, and all bodies with their parents, parents first.
    all_links: Vec<Link>,
    outwards: Vec<(usize, Option<usize>)>,
    lumped: LumpedGraph,
    /// Whether the last graph was solved in its lumped form.
    pub(crate) is_lumped: bool,
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

/// Solves the graph. On entry, `solution.lambda` is a guess of the forces, for example from the last time step: it
/// determines which contacts are first treated as loaded and as slipping, and where conjugate gradient starts. The
/// guess of a new contact is a positive normal force without friction.
///
/// If rows contradict each other (a drive against a wall), [`Convergence::converged`](super::Convergence::converged) is
/// false and the row with the largest departure is reported; forces stay within their bounds.
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

/// Displacements that bring the rows active at the last solution to `targets` with the least motion of mass: M δ = Jᵀ
/// ν, J δ = targets, within the free directions of the joints. Uses the last factorisation and the last method.
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

/// Active rows of the last solution whose forces the motion does not determine, because some combination of them with
/// others moves nothing (a flat foot on four points, a planar loop closed by spatial rows). Uses the last
/// factorisation.
///
/// The rows get a probe z of random targets. The part of it that no force can produce lies in the null space of J A⁻¹
/// Jᵀ, and appears with probability one in exactly the rows that the null space involves. Costs a few tree solves with
/// Newton's method, as many as a solution with conjugate gradient.
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
