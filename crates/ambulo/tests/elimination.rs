//! The block elimination of trees and loops: against a dense solve of the same equations, against inverse dynamics, and
//! forwards again.

mod common;

use ambulo::dynamics::{
    Acting, BodyTerms, Constraint, ConstraintGraph, ConstraintGroup, Elimination, GraphSolution, GraphWorkspace, Law,
    Link, LinkError, Six, SolverSettings, Workspace, inverse_frame, solve_graph,
};
use ambulo::kinematics::{BodyMotion, Posture, body_motion};
use ambulo::model::{BodyId, Model};
use ambulo::spatial::{Mat3, Vec3, Wrench};
use common::random::{Random, Recipe, model, state};
use common::{State, distance, largest};
use nalgebra::{DMatrix, DVector, Matrix6};

fn random_six(r: &mut Random) -> Six {
    Six::from_iterator(r.list(6, 1.0))
}

/// Random trees: most bodies on another one, with 0 to 6 free directions, and `loops` closing groups of 1 to 3 rows.
fn random_graph(r: &mut Random, bodies: usize, loops: usize) -> ConstraintGraph {
    let mut graph = ConstraintGraph::default();
    for child in 0..bodies {
        let turn = r.rotation();
        let diagonal = Vec3::new(r.between(0.1, 1.0), r.between(0.1, 1.0), r.between(0.1, 1.0));
        let inertia = turn * Mat3::from_diagonal(&diagonal) * turn.transpose();
        graph.bodies.push(BodyTerms { mass: r.between(0.5, 20.0), inertia });
        graph.wrenches.push(random_six(r) * 50.0);
        let freedom = r.below(7);
        let parent = (child > 0 && r.chance(0.9)).then(|| r.below(child));
        graph.links.push(Link { parent, freedom });
        graph.terms.arm.push(r.vector(0.5));
        graph.terms.offset.push(random_six(r));
        for _ in 0..freedom {
            graph.terms.directions.push(random_six(r));
            graph.efforts.push(r.within(5.0));
            graph.rotors.push(r.between(0.0, 0.1));
        }
    }
    for _ in 0..loops {
        let first = r.below(bodies);
        let second = Some(r.below(bodies)).filter(|s| *s != first);
        let count = 1 + r.below(3);
        let start = graph.rows.len();
        for _ in 0..count {
            graph.rows.push(Constraint {
                on_first: random_six(r),
                on_second: random_six(r),
                target: r.within(5.0),
                compliance: 0.0,
            });
        }
        let on = Acting::Bodies { first, second };
        graph.groups.push(ConstraintGroup { on, rows: start..start + count, law: Law::HELD });
    }
    graph
}

/// X of a joint: a_c = X a_p + ...
fn transport(arm: &Vec3) -> Matrix6<f64> {
    let mut x = Matrix6::identity();
    x.fixed_view_mut::<3, 3>(3, 0).copy_from(&-arm.cross_matrix());
    x
}

/// Motions (6 a body), coordinates, then the closing rows' multipliers, by one dense factorisation of
///
///   M a - λ + Σ Xᵀ λ_child - J̃ᵀ ν = b      a - X a_p - S q = w      Sᵀ λ - rotor q = -τ ... J̃ a = c
fn dense(graph: &ConstraintGraph) -> Vec<f64> {
    let (n, coordinates, rows) = (6 * graph.bodies.len(), graph.efforts.len(), graph.rows.len());
    let size = 2 * n + coordinates + rows;
    let (joint, q0, nu) = (n, 2 * n, 2 * n + coordinates);
    let mut matrix = DMatrix::zeros(size, size);
    let mut right = DVector::zeros(size);
    let mut coordinate = 0;
    for (i, link) in graph.links.iter().enumerate() {
        let at = 6 * i;
        let body = &graph.bodies[i];
        matrix.view_mut((at, at), (3, 3)).copy_from(&body.inertia);
        matrix.view_mut((at + 3, at + 3), (3, 3)).copy_from(&(Mat3::identity() * body.mass));
        matrix.view_mut((at, joint + at), (6, 6)).copy_from(&-Matrix6::identity());
        matrix.view_mut((joint + at, at), (6, 6)).copy_from(&Matrix6::identity());
        right.rows_mut(at, 6).copy_from(&graph.wrenches[i]);
        right.rows_mut(joint + at, 6).copy_from(&graph.terms.offset[i]);
        if let Some(parent) = link.parent {
            let x = transport(&graph.terms.arm[i]);
            matrix.view_mut((joint + at, 6 * parent), (6, 6)).copy_from(&-x);
            matrix.view_mut((6 * parent, joint + at), (6, 6)).copy_from(&x.transpose());
        }
        for _ in 0..link.freedom {
            let s = graph.terms.directions[coordinate];
            matrix.view_mut((joint + at, q0 + coordinate), (6, 1)).copy_from(&-s);
            matrix.view_mut((q0 + coordinate, joint + at), (1, 6)).copy_from(&s.transpose());
            matrix[(q0 + coordinate, q0 + coordinate)] = graph.rotors[coordinate];
            right[q0 + coordinate] = graph.efforts[coordinate];
            coordinate += 1;
        }
    }
    for group in &graph.groups {
        let Acting::Bodies { first, second } = group.on else { panic!("bodies only") };
        for row in group.rows.clone() {
            let terms = &graph.rows[row];
            for (body, j) in [(Some(first), terms.on_first), (second, terms.on_second)] {
                let Some(body) = body else { continue };
                matrix.view_mut((nu + row, 6 * body), (1, 6)).copy_from(&j.transpose());
                matrix.view_mut((6 * body, nu + row), (6, 1)).copy_from(&-j);
            }
            right[nu + row] = terms.target;
        }
    }
    let x = matrix.lu().solve(&right).unwrap_or_else(|| panic!("singular"));
    let parts = [x.rows(0, n), x.rows(q0, coordinates), x.rows(nu, rows)];
    parts.iter().flat_map(|p| p.iter().copied().collect::<Vec<_>>()).collect()
}

fn solved(graph: &ConstraintGraph) -> GraphSolution {
    let mut solution = GraphSolution::default();
    let settings = SolverSettings { tolerance: 1e-13, max_iterations: 12, ..SolverSettings::default() };
    solve_graph(graph, &settings, &mut GraphWorkspace::default(), &mut solution).unwrap_or_else(|e| panic!("{e}"));
    solution
}

fn flat(solution: &GraphSolution) -> Vec<f64> {
    let motions = solution.motions.iter().flat_map(|a| a.iter().copied().collect::<Vec<_>>());
    motions.chain(solution.coordinates.iter().copied()).chain(solution.lambda.iter().copied()).collect()
}

#[test]
fn random_trees_of_one_to_two_hundred_bodies_agree_with_a_dense_solve() {
    let mut worst = 0.0_f64;
    for (bodies, repeats) in [(1, 20), (2, 20), (5, 20), (20, 10), (60, 3), (200, 1)] {
        for seed in 0..repeats {
            let graph = random_graph(&mut Random::new(1000 * bodies as u64 + seed), bodies, 0);
            let (expected, found) = (dense(&graph), flat(&solved(&graph)));
            let error = distance(&found, &expected) / largest(expected.iter().copied());
            assert!(error < 1e-9, "{bodies} bodies, seed {seed}: {error:e}");
            worst = worst.max(error);
        }
    }
    println!("largest difference from the dense solve, relative: {worst:.1e}");
}

#[test]
fn random_loops_agree_with_a_dense_solve() {
    let mut worst = 0.0_f64;
    for (bodies, loops, repeats) in [(2, 1, 20), (6, 2, 20), (20, 5, 10), (60, 12, 3)] {
        for seed in 0..repeats {
            let mut graph = random_graph(&mut Random::new(77 * bodies as u64 + seed), bodies, loops);
            // Enough freedom that the loops can close.
            graph.links[0].parent = None;
            let graph = freed(graph);
            let (expected, solution) = (dense(&graph), solved(&graph));
            let error = distance(&flat(&solution), &expected) / largest(expected.iter().copied());
            assert!(error < 1e-7, "{bodies} bodies, seed {seed}: {error:e} {:?}", solution.convergence);
            worst = worst.max(error);
        }
    }
    println!("largest difference from the dense solve with loops, relative: {worst:.1e}");
}

/// The same with at least three free directions at each joint.
fn freed(mut graph: ConstraintGraph) -> ConstraintGraph {
    let mut r = Random::new(5);
    graph.terms.directions.clear();
    graph.efforts.clear();
    graph.rotors.clear();
    for link in &mut graph.links {
        link.freedom = link.freedom.max(3);
        for _ in 0..link.freedom {
            graph.terms.directions.push(random_six(&mut r));
            graph.efforts.push(r.within(5.0));
            graph.rotors.push(r.between(0.0, 0.1));
        }
    }
    graph
}

#[test]
fn a_target_changed_in_the_dense_solve_is_noticed() {
    let graph = random_graph(&mut Random::new(7), 5, 0);
    let mut other = graph.clone();
    other.terms.offset[4][2] += 1.0;
    assert!(distance(&flat(&solved(&graph)), &dense(&other)) > 1e-3);
}

#[test]
fn trees_need_no_off_diagonal_block_and_a_ladder_keeps_few() {
    let chain: Vec<Link> = (0..100_usize).map(|i| Link { parent: i.checked_sub(1), freedom: 1 }).collect();
    let blocks = |links: &[Link], couplings: &[(usize, usize)]| {
        Elimination::new(links, couplings).unwrap_or_else(|e| panic!("{e}")).blocks()
    };
    assert_eq!(blocks(&chain, &[]), 0);
    // Two rails with a rung on the left one, closed on the right one.
    let (mut ladder, mut closing) = (Vec::new(), Vec::new());
    for i in 0..100_usize {
        ladder.push(Link { parent: i.checked_sub(1).map(|_| 3 * i - 3), freedom: 1 });
        ladder.push(Link { parent: i.checked_sub(1).map(|_| 3 * i - 2), freedom: 1 });
        ladder.push(Link { parent: Some(3 * i), freedom: 1 });
        closing.push((3 * i + 2, 3 * i + 1));
    }
    assert!(blocks(&ladder, &closing) <= 300, "{}", blocks(&ladder, &closing));
}
