//! Solves constraint graphs with a chosen method; holds the scratch memory that the methods share.

use ambulo_body::dynamics::{
    ActsOn, BodyTerms, Constraint, ConstraintGraph, ConstraintGroup, GraphSolution, GraphWorkspace, Law, Link, Method,
    Six, SolverSettings, project_displacements, solve_graph,
};
use ambulo_body::internals::{is_lumped, transport};
use ambulo_body::spatial::{Mat3, Vec3};

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
        assert_eq!(is_lumped(&workspace), method == Method::Newton);
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
