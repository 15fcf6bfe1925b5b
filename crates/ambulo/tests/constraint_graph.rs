//! Closing rows, bounds and contacts: laws checked row by row, redundancy against dense least squares, contradictions
//! named, and what both methods cost.

use crate::common::graphs::{
    METHODS, PLANE, SPACE, add_contact, add_free, add_rows, box_inertia, box_on, corners, fresh, ladder,
    random_contacts, relative_rows, settings, solved, tower,
};
use crate::common::largest;
use crate::common::random::Random;
use ambulo::dynamics::{
    ActsOn, Constraint, ConstraintGraph, ConstraintGroup, GraphSolution, GraphWorkspace, Law, Method, Six,
    SolverSettings, solve_graph, undetermined_rows,
};
use ambulo::spatial::{Mat3, Vec3};
use nalgebra::{DMatrix, DVector};

const TIGHT: f64 = 1e-12;
const TABLE: Vec3 = Vec3::new(1.0, 0.6, 0.7);

fn reading(graph: &ConstraintGraph, group: &ConstraintGroup, row: usize, solution: &GraphSolution) -> f64 {
    let terms = &graph.rows[row];
    let there = match group.on {
        ActsOn::Coordinate { coordinate, .. } => solution.coordinates[coordinate],
        ActsOn::Bodies { first, second } => {
            terms.on_first.dot(&solution.motions[first])
                + second.map_or(0.0, |s| terms.on_second.dot(&solution.motions[s]))
        }
    };
    there - terms.target
}

/// The motion that rows leave without their forces sets the scale.
fn unforced(graph: &ConstraintGraph) -> f64 {
    let free = ConstraintGraph { rows: Vec::new(), groups: Vec::new(), ..graph.clone() };
    let (solution, _) = solved(&free, &SolverSettings::default());
    let each = graph.groups.iter().flat_map(|g| g.rows.clone().map(move |row| (g, row)));
    largest(each.map(|(group, row)| reading(graph, group, row, &solution)))
}

/// Largest departures of a solution from the laws, each as a share of the scene's motion V, force F, or both.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Departures {
    /// -u_n / V and -λ_n / F: overlapping, pulling.
    one_sided: f64,
    /// u λ_n / F V.
    complementary: f64,
    /// (|λ_t| - μ λ_n) / F.
    cone: f64,
    /// (μ λ_n - |λ_t|) |u_t| / F V: slipping within the cone.
    slip: f64,
    /// | |u_t| λ_t + |λ_t| u_t | / F V: friction not opposite to slip.
    direction: f64,
    /// M a - b - Jᵀ λ along the joints' free directions / F.
    newton: f64,
}

impl Departures {
    fn of(graph: &ConstraintGraph, solution: &GraphSolution, workspace: &GraphWorkspace) -> Departures {
        let (v, f) = (unforced(graph), largest(solution.lambda.iter().copied()).max(1.0));
        let mut d =
            Departures { one_sided: 0.0, complementary: 0.0, cone: 0.0, slip: 0.0, direction: 0.0, newton: 0.0 };
        let up = |of: &mut f64, value: f64| *of = of.max(value);
        for group in &graph.groups {
            let start = group.rows.start;
            let u = |k: usize| reading(graph, group, start + k, solution);
            let force = &solution.lambda[group.rows.clone()];
            match group.law {
                Law::Contact { friction, .. } => {
                    let normal = u(0) + graph.rows[start].compliance * force[0];
                    up(&mut d.one_sided, (-normal / v).max(-force[0] / f));
                    up(&mut d.complementary, (normal * force[0]).abs() / (f * v));
                    let (slip, rub) = (u(1).hypot(u(2)), force[1].hypot(force[2]));
                    up(&mut d.cone, (rub - friction * force[0]) / f);
                    up(&mut d.slip, (friction * force[0] - rub) * slip / (f * v));
                    let across = (slip * force[1] + rub * u(1)).hypot(slip * force[2] + rub * u(2));
                    up(&mut d.direction, across / (f * v));
                }
                Law::Bounded { least, most } => {
                    for (k, l) in force.iter().enumerate() {
                        let whole = u(k) + graph.rows[start + k].compliance * l;
                        let room = if whole > 0.0 { l - least } else { most - l };
                        up(&mut d.one_sided, (l - most).max(least - l) / f);
                        let free = room.is_infinite();
                        up(&mut d.complementary, if free { whole.abs() / v } else { (room * whole).abs() / (f * v) });
                    }
                }
            }
        }
        let wrenches = graph.joint_wrenches(workspace.outwards(), solution);
        let mut coordinate = 0;
        for (link, wrench) in graph.links.iter().zip(&wrenches) {
            for _ in 0..link.freedom {
                let pushed = pushed(graph, coordinate, &solution.lambda);
                let inert = graph.rotors[coordinate] * solution.coordinates[coordinate];
                let left = graph.terms.directions[coordinate].dot(wrench) + inert - graph.efforts[coordinate] - pushed;
                up(&mut d.newton, left.abs() / f);
                coordinate += 1;
            }
        }
        d
    }

    fn worst(&self) -> f64 {
        let all = [self.one_sided, self.complementary, self.cone, self.slip, self.direction, self.newton];
        all.into_iter().fold(0.0, f64::max)
    }
}

/// Forces of rows that act on a coordinate.
fn pushed(graph: &ConstraintGraph, coordinate: usize, lambda: &[f64]) -> f64 {
    let on = |group: &ConstraintGroup| match group.on {
        ActsOn::Coordinate { coordinate: c, .. } if c == coordinate => lambda[group.rows.start],
        _ => 0.0,
    };
    graph.groups.iter().map(on).sum()
}

/// How many of so many random scenes are solved, and what that took; each solution obeys the laws.
fn lawful(method: Method, friction: f64, scenes: u64, max_iterations: usize) -> (usize, String) {
    let (mut iterations, mut worst) = (Vec::new(), 0.0_f64);
    for seed in 0..scenes {
        let graph = random_contacts(&mut Random::new(seed), friction);
        let (solution, workspace) = solved(&graph, &settings(method, TIGHT, max_iterations));
        assert!(solution.lambda.iter().all(|l| l.is_finite()), "seed {seed}");
        assert!(solution.motions.iter().all(|a| a.iter().all(|x| x.is_finite())), "seed {seed}");
        if solution.convergence.converged {
            let departures = Departures::of(&graph, &solution, &workspace);
            assert!(departures.worst() < 1e-8, "seed {seed}, {method:?}: {departures:?}");
            worst = worst.max(departures.worst());
            iterations.push(solution.convergence.iterations);
        }
    }
    iterations.sort_unstable();
    let at = |share: f64| iterations[((iterations.len() - 1) as f64 * share) as usize];
    let line = format!(
        "{method:?}, friction up to {friction}: {} of {scenes} solved; tree solves: median {}, nine of ten {}, most \
         {}; \
         largest departure {worst:.1e}",
        iterations.len(),
        at(0.5),
        at(0.9),
        at(1.0)
    );
    (iterations.len(), line)
}

#[test]
fn in_random_scenes_without_friction_newton_finds_the_laws_obeyed() {
    // One scene of these squeezes a body from both sides.
    let (solved, line) = lawful(Method::Newton, 0.0, 1000, 100);
    println!("{line}");
    assert!(solved >= 998, "{solved}");
}

#[test]
fn in_random_scenes_without_friction_conjugate_gradient_finds_the_laws_obeyed() {
    let (solved, line) = lawful(Method::ConjugateGradient, 0.0, 1000, 3000);
    println!("{line}");
    assert!(solved >= 990, "{solved}");
}

#[test]
fn in_random_scenes_with_friction_what_newton_calls_converged_obeys_the_laws() {
    // Coulomb's law is no convex problem; scenes of up to 18 contacts on random sides are harder than any gait.
    let (solved, line) = lawful(Method::Newton, 0.3, 1000, 200);
    println!("{line}");
    assert!(solved >= 950, "{solved}");
    let (solved, line) = lawful(Method::Newton, 1.0, 1000, 200);
    println!("{line}");
    assert!(solved >= 800, "{solved}");
}

#[test]
fn in_random_scenes_with_friction_what_conjugate_gradient_calls_converged_obeys_the_laws() {
    let (solved, line) = lawful(Method::ConjugateGradient, 0.3, 1000, 3000);
    println!("{line}");
    assert!(solved >= 930, "{solved}");
    let (solved, line) = lawful(Method::ConjugateGradient, 1.0, 1000, 3000);
    println!("{line}");
    assert!(solved >= 750, "{solved}");
}

#[test]
fn a_solution_with_one_friction_force_turned_around_departs_from_the_laws() {
    let mut graph = box_on(20.0, TABLE, &corners(TABLE), 0.5);
    graph.wrenches[0][3] = 200.0;
    let (mut solution, workspace) = solved(&graph, &settings(Method::Newton, TIGHT, 100));
    assert!(Departures::of(&graph, &solution, &workspace).worst() < 1e-8);
    solution.lambda[1] = -solution.lambda[1];
    solution.lambda[2] = -solution.lambda[2];
    let departures = Departures::of(&graph, &solution, &workspace);
    assert!(departures.direction > 1e-2 && departures.newton > 1e-2, "{departures:?}");
}

#[test]
fn both_methods_find_the_same_motion_where_it_is_unique() {
    for seed in 0..300 {
        let graph = random_contacts(&mut Random::new(seed), 0.0);
        let [one, other] = METHODS.map(|method| solved(&graph, &settings(method, TIGHT, 3000)).0);
        if one.convergence.converged && other.convergence.converged {
            let size = one.motions.iter().map(|a| a.norm()).fold(unforced(&graph), f64::max);
            let error = one.motions.iter().zip(&other.motions).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
            // Tolerance times the condition of random scenes, up to 1e4.
            assert!(error < 1e-8 * size, "seed {seed}: {error:e} of {size}");
        }
    }
}

/// A box of 20 kg on its four corners, pushed level with them so that it does not lean.
fn pushed_box(push: f64, friction: f64) -> ConstraintGraph {
    let mut graph = box_on(20.0, TABLE, &corners(TABLE), friction);
    graph.wrenches[0][3] = push;
    graph.wrenches[0][1] = -push * 0.5 * TABLE.z;
    graph
}

#[test]
fn a_pushed_box_sticks_below_the_cone_and_beyond_it_slides_against_its_friction() {
    let weight = 20.0 * 9.81;
    for method in METHODS {
        let stands = solved(&pushed_box(0.45 * weight, 0.5), &settings(method, TIGHT, 200)).0;
        assert!(stands.motions[0].norm() < 1e-9, "{method:?}: {:?}", stands.motions[0]);
        let slides = solved(&pushed_box(0.8 * weight, 0.5), &settings(method, TIGHT, 200)).0;
        // a = (F - μ m g) / m.
        let expected = (0.8 - 0.5) * 9.81;
        assert!((slides.motions[0][3] - expected).abs() < 1e-9 * expected, "{method:?}: {}", slides.motions[0][3]);
        for contact in slides.lambda.chunks(3) {
            let rub = contact[1].hypot(contact[2]);
            assert!((rub - 0.5 * contact[0]).abs() < 1e-9 * weight, "{method:?}: {contact:?}");
        }
    }
}

#[test]
fn a_box_pushed_past_the_cone_does_not_stick() {
    for method in METHODS {
        let slides = solved(&pushed_box(0.51 * 20.0 * 9.81, 0.5), &settings(method, TIGHT, 200)).0;
        assert!(slides.motions[0][3] > 0.05, "{method:?}: {}", slides.motions[0][3]);
    }
}

/// Of all forces on these rows of one body that balance its wrench, those of least squares: J (Jᵀ J)⁻¹ (-b), dense.
fn least_squares(graph: &ConstraintGraph) -> DVector<f64> {
    let j = DMatrix::from_fn(graph.rows.len(), 6, |row, k| graph.rows[row].on_first[k]);
    let b = DVector::from_column_slice(graph.wrenches[0].as_slice());
    j.transpose().svd(true, true).solve(&-b, 1e-10).unwrap_or_else(|e| panic!("{e}"))
}

/// Points around the mass centre, none far from the others' pull.
fn legs(count: usize, seed: u64) -> Vec<Vec3> {
    let mut r = Random::new(seed);
    let at = |k: usize, r: &mut Random| {
        let angle = (k as f64 + r.within(0.3)) * std::f64::consts::TAU / count as f64;
        let radius = r.between(0.4, 0.5);
        Vec3::new(radius * angle.cos(), radius * angle.sin(), -0.35)
    };
    (0..count).map(|k| at(k, &mut r)).collect()
}

#[test]
fn redundant_legs_share_the_weight_as_least_squares_would() {
    for (count, seed) in [(4, 1), (5, 2), (8, 3), (12, 4)] {
        let graph = box_on(20.0, TABLE, &legs(count, seed), 2.0);
        let expected = least_squares(&graph);
        for method in METHODS {
            let (solution, _) = solved(&graph, &settings(method, TIGHT, 200));
            let error = largest(solution.lambda.iter().zip(expected.iter()).map(|(x, y)| x - y));
            assert!(error < 1e-8 * expected.amax(), "{count} legs, {method:?}: {error:e}");
        }
    }
}

#[test]
fn legs_that_share_by_another_rule_are_noticed() {
    let graph = box_on(20.0, TABLE, &legs(5, 2), 2.0);
    let expected = least_squares(&graph);
    let (solution, _) = solved(&graph, &SolverSettings::default());
    // Equal shares carry the weight, too, but not where it is.
    let equal = 20.0 * 9.81 / 5.0;
    assert!(solution.lambda.chunks(3).any(|contact| (contact[0] - equal).abs() > 1e-2 * expected.amax()));
}

#[test]
fn conjugate_gradient_stays_with_the_forces_nearest_to_its_guess_and_newton_forgets_them() {
    let graph = box_on(20.0, TABLE, &corners(TABLE), 2.0);
    let expected = least_squares(&graph);
    // Two legs press more, two less: a set of forces that moves nothing.
    let null: Vec<f64> =
        (0..12).map(|row| [5.0, -5.0, 5.0, -5.0][row / 3] * f64::from(u8::from(row % 3 == 0))).collect();
    for (method, kept) in [(Method::Newton, 0.0), (Method::ConjugateGradient, 1.0)] {
        let lambda = expected.iter().zip(&null).map(|(e, n)| 0.9 * e + n).collect();
        let mut solution = GraphSolution { lambda, ..GraphSolution::default() };
        solve_graph(&graph, &settings(method, TIGHT, 200), &mut GraphWorkspace::default(), &mut solution).unwrap();
        for row in 0..12 {
            let due = expected[row] + kept * null[row];
            assert!((solution.lambda[row] - due).abs() < 1e-7, "{method:?}, row {row}: {}", solution.lambda[row]);
        }
    }
}

#[test]
fn a_row_that_stands_twice_moves_nothing_else_and_each_bears_half() {
    for method in METHODS {
        let once = ladder(3, &PLANE);
        let mut twice = once.clone();
        let (group, row) = (once.groups[1].clone(), once.rows[once.groups[1].rows.start]);
        add_rows(&mut twice, group.on, &[row], Law::EQUALITY);
        let [one, two] = [&once, &twice].map(|graph| solved(graph, &settings(method, TIGHT, 200)).0);
        for (a, b) in one.motions.iter().zip(&two.motions) {
            assert!((a - b).norm() < 1e-9, "{method:?}");
        }
        let start = group.rows.start;
        let [first, second] = [two.lambda[start], two.lambda[twice.rows.len() - 1]];
        assert!((first - second).abs() < 1e-9 && (2.0 * first - one.lambda[start]).abs() < 1e-8, "{method:?}");
    }
}

#[test]
fn rows_that_stand_twice_are_told_from_those_that_do_not() {
    for method in METHODS {
        let found = |graph: &ConstraintGraph| {
            let (_, mut workspace) = solved(graph, &settings(method, 1e-10, 500));
            undetermined_rows(graph, &mut workspace)
        };
        assert_eq!(found(&ladder(10, &PLANE)), Vec::<usize>::new(), "{method:?}");
        // Of rows for space (turns about x and z, shifts along x, z, y), a ladder in the plane needs the shifts in it.
        let expected: Vec<usize> = (0..50).filter(|row| ![2, 3].contains(&(row % 5))).collect();
        assert_eq!(found(&ladder(10, &SPACE)), expected, "{method:?}");
        let mut twice = ladder(3, &PLANE);
        let (group, row) = (twice.groups[1].clone(), twice.rows[twice.groups[1].rows.start]);
        add_rows(&mut twice, group.on, &[row], Law::EQUALITY);
        assert_eq!(found(&twice), [2, 6], "{method:?}");
        // Three legs without friction are what it takes.
        let three: Vec<Vec3> = legs(3, 1);
        assert_eq!(found(&box_on(20.0, TABLE, &three, 0.0)), Vec::<usize>::new(), "{method:?}");
        assert_eq!(found(&box_on(20.0, TABLE, &corners(TABLE), 0.0)), [0, 3, 6, 9], "{method:?}");
    }
}

#[test]
fn rows_that_contradict_each_other_are_named_and_the_rest_is_solved() {
    for method in METHODS {
        let mut graph = ladder(2, &PLANE);
        let body = add_free(&mut graph, 2.0, Mat3::identity());
        let along = Six::ith(3, 1.0);
        let row = |target: f64| Constraint { on_first: along, on_second: Six::zeros(), target, compliance: 0.0 };
        let on = ActsOn::Bodies { first: body, second: None };
        let first = add_rows(&mut graph, on, &[row(1.0)], Law::EQUALITY);
        add_rows(&mut graph, on, &[row(4.0)], Law::EQUALITY);
        let (solution, _) = solved(&graph, &settings(method, 1e-10, 100));
        let convergence = solution.convergence;
        assert!(!convergence.converged && convergence.residual > 0.01, "{method:?}: {convergence:?}");
        assert!(convergence.worst.is_some_and(|row| row >= first), "{method:?}: {convergence:?}");
        assert!(solution.lambda.iter().all(|l| l.is_finite()), "{method:?}");
        // Half way between what the two ask for.
        assert!((solution.motions[body][3] - 2.5).abs() < 1e-4, "{method:?}: {}", solution.motions[body][3]);
        let (alone, _) = solved(&ladder(2, &PLANE), &settings(method, 1e-10, 100));
        for (a, b) in alone.motions.iter().zip(&solution.motions) {
            assert!((a - b).norm() < 1e-6, "{method:?}");
        }
    }
}

#[test]
fn forces_stay_within_their_bounds_and_give_way_there() {
    for method in METHODS {
        let with = |least: f64, most: f64, target: f64| {
            let mut graph = ConstraintGraph::default();
            let body = add_free(&mut graph, 2.0, Mat3::identity());
            let on_first = Six::ith(5, 1.0);
            let row = Constraint { on_first, on_second: Six::zeros(), target, compliance: 0.0 };
            add_rows(&mut graph, ActsOn::Bodies { first: body, second: None }, &[row], Law::Bounded { least, most });
            let (solution, _) = solved(&graph, &settings(method, TIGHT, 50));
            assert!(solution.convergence.converged, "{method:?}");
            (solution.lambda[0], solution.motions[0][5])
        };
        let near = |(l, a): (f64, f64), (force, motion): (f64, f64)| {
            assert!((l - force).abs() < 1e-9 && (a - motion).abs() < 1e-9, "{method:?}: {l}, {a}");
        };
        let weight = 2.0 * 9.81;
        near(with(-100.0, 100.0, 0.0), (weight, 0.0));
        near(with(-100.0, 10.0, 0.0), (10.0, 5.0 - 9.81));
        near(with(-5.0, 100.0, -20.0), (-5.0, -9.81 - 2.5));
        near(with(0.0, f64::INFINITY, -20.0), (0.0, -9.81));
    }
}

#[test]
fn a_limit_of_a_coordinate_holds_it_and_lets_it_go_the_other_way() {
    for method in METHODS {
        for (effort, moves) in [(-3.0, 0.0), (3.0, 1.0)] {
            let mut graph = ladder(1, &PLANE);
            graph.groups.clear();
            graph.rows.clear();
            for wrench in &mut graph.wrenches {
                *wrench = Six::zeros();
            }
            graph.efforts[0] = effort;
            let blank = Constraint { on_first: Six::zeros(), on_second: Six::zeros(), target: 0.0, compliance: 0.0 };
            let on = ActsOn::Coordinate { body: 0, coordinate: 0 };
            add_rows(&mut graph, on, &[blank], Law::Bounded { least: 0.0, most: f64::INFINITY });
            let (solution, workspace) = solved(&graph, &settings(method, TIGHT, 50));
            assert!(Departures::of(&graph, &solution, &workspace).worst() < 1e-9, "{method:?}");
            let q = solution.coordinates[0];
            assert!(if moves > 0.0 { q > 0.1 } else { q.abs() < 1e-9 }, "{method:?}: {q}");
            assert!((solution.lambda[0] - if moves > 0.0 { 0.0 } else { 3.0 }).abs() < 1e-9, "{method:?}");
        }
    }
}

#[test]
fn a_row_yields_by_its_compliance_times_its_force() {
    for method in METHODS {
        for compliance in [1e-9, 1e-3, 0.5, 100.0] {
            let mut graph = ladder(3, &PLANE);
            let first = graph.groups[1].rows.start;
            graph.rows[first].compliance = compliance;
            let (solution, _) = solved(&graph, &settings(method, TIGHT, 100));
            assert!(solution.convergence.converged, "{method:?}, {compliance}");
            let u = reading(&graph, &graph.groups[1], first, &solution);
            let left = u + compliance * solution.lambda[first];
            assert!(left.abs() < 1e-10, "{method:?}, {compliance}: {left:e}");
            assert!(compliance < 1e-2 || u.abs() > 1e-3, "it yields: {u}");
        }
    }
}

#[test]
fn masses_of_one_to_a_thousand_stand_on_each_other_either_way() {
    for method in METHODS {
        for masses in [[1.0, 1000.0], [1000.0, 1.0]] {
            let graph = tower(&masses, 0.5);
            let (solution, workspace) = solved(&graph, &settings(method, TIGHT, 200));
            assert!(solution.convergence.converged, "{method:?}, {masses:?}: {:?}", solution.convergence);
            assert!(Departures::of(&graph, &solution, &workspace).worst() < 1e-8, "{method:?}, {masses:?}");
            for (level, expected) in [(0, masses[0] + masses[1]), (1, masses[1])] {
                let normals: f64 = solution.lambda.chunks(3).skip(4 * level).take(4).map(|c| c[0]).sum();
                assert!(
                    (normals - 9.81 * expected).abs() < 1e-8 * 9.81 * expected,
                    "{method:?}, {masses:?}: {normals}"
                );
            }
        }
    }
}

/// A heavy box on a light one that is itself pushed: the ratio of masses with friction at work.
#[test]
fn a_light_box_pushed_from_under_a_heavy_one_obeys_the_laws() {
    for method in METHODS {
        let mut graph = tower(&[1.0, 1000.0], 0.3);
        graph.wrenches[0][3] = 7000.0;
        let (solution, workspace) = solved(&graph, &settings(method, TIGHT, 2000));
        assert!(solution.convergence.converged, "{method:?}: {:?}", solution.convergence);
        let departures = Departures::of(&graph, &solution, &workspace);
        assert!(departures.worst() < 1e-8, "{method:?}: {departures:?}");
    }
}

/// A box on a thousand points.
fn on_a_thousand() -> ConstraintGraph {
    let mut r = Random::new(1);
    let points: Vec<Vec3> = (0..1000).map(|_| Vec3::new(r.within(0.5), r.within(0.3), -0.35)).collect();
    box_on(20.0, TABLE, &points, 0.5)
}

#[test]
fn a_box_on_a_thousand_points_stands_slides_and_turns_by_the_laws() {
    for method in METHODS {
        for (push, turn) in [(0.0, 0.0), (70.0, 0.0), (130.0, 20.0)] {
            let mut graph = on_a_thousand();
            (graph.wrenches[0][3], graph.wrenches[0][2]) = (push, turn);
            let (solution, workspace) = solved(&graph, &settings(method, 1e-11, 1000));
            assert!(solution.convergence.converged, "{method:?}, {push}: {:?}", solution.convergence);
            let departures = Departures::of(&graph, &solution, &workspace);
            assert!(departures.worst() < 1e-8, "{method:?}, {push}: {departures:?}");
        }
    }
}

#[test]
fn a_tower_of_two_hundred_and_fifty_boxes_stands() {
    for method in METHODS {
        let graph = tower(&vec![1.0; 250], 0.5);
        let (solution, workspace) = solved(&graph, &settings(method, 1e-10, 1000));
        assert!(solution.convergence.converged, "{method:?}: {:?}", solution.convergence);
        assert!(Departures::of(&graph, &solution, &workspace).worst() < 1e-8, "{method:?}");
        let normals: f64 = solution.lambda.chunks(3).take(4).map(|c| c[0]).sum();
        // The tolerance of motion, times a mass of 250 kg on a motion of 9.81.
        assert!((normals - 250.0 * 9.81).abs() < 1e-8 * 250.0 * 9.81, "{method:?}: {normals}");
    }
}

/// A body that is pressed between two walls closer than it can be: no force helps.
#[test]
fn a_body_squeezed_between_walls_is_not_called_solved() {
    for method in METHODS {
        let mut graph = ConstraintGraph::default();
        let body = add_free(&mut graph, 1.0, box_inertia(1.0, Vec3::repeat(0.2)));
        for normal in [Vec3::x(), -Vec3::x()] {
            let row = add_contact(&mut graph, (body, -0.1 * normal), None, normal, 0.5);
            graph.rows[row].target = 1.0;
        }
        let (solution, _) = solved(&graph, &settings(method, 1e-10, 100));
        assert!(!solution.convergence.converged, "{method:?}: {:?}", solution.convergence);
        assert!(solution.convergence.worst.is_some_and(|row| row % 3 == 0), "{method:?}: {:?}", solution.convergence);
        assert!(solution.lambda.iter().all(|l| l.is_finite()), "{method:?}");
        assert!(solution.motions[0].norm() < 1e3, "{method:?}: {:?}", solution.motions[0]);
    }
}

#[test]
fn the_same_graph_gives_the_same_bits_in_a_workspace_that_has_seen_others() {
    for method in METHODS {
        let settings = settings(method, 1e-10, 500);
        let mut workspace = GraphWorkspace::default();
        let mut used = GraphSolution::default();
        for seed in 0..20 {
            let graph = random_contacts(&mut Random::new(seed), 0.5);
            used.lambda = fresh(&graph).lambda;
            solve_graph(&graph, &settings, &mut workspace, &mut used).unwrap();
            let (alone, _) = solved(&graph, &settings);
            assert_eq!((&used.lambda, &used.motions), (&alone.lambda, &alone.motions), "{method:?}, seed {seed}");
        }
    }
}

#[test]
fn contacts_between_hinged_bodies_couple_them_as_one_row_says() {
    // The same row as a contact without friction that pushes, and as a row that holds.
    for method in METHODS {
        let mut held = ladder(2, &PLANE);
        let all = relative_rows([Vec3::x(), Vec3::y(), Vec3::z()], Vec3::new(0.1, 0.0, 0.2), Vec3::new(0.3, 0.0, 0.1));
        let on = ActsOn::Bodies { first: 2, second: Some(4) };
        let mut touching = held.clone();
        let start = add_rows(&mut held, on, &all[3..4], Law::EQUALITY);
        let (expected, _) = solved(&held, &settings(method, TIGHT, 100));
        let push = expected.lambda[start].signum();
        let turned: Vec<Constraint> = all[3..6]
            .iter()
            .map(|row| Constraint { on_first: row.on_first * push, on_second: row.on_second * push, ..*row })
            .collect();
        add_rows(&mut touching, on, &turned, Law::Contact { friction: 0.0, bound: f64::INFINITY });
        let (found, _) = solved(&touching, &settings(method, TIGHT, 100));
        for (a, b) in expected.motions.iter().zip(&found.motions) {
            assert!((a - b).norm() < 1e-9, "{method:?}");
        }
    }
}

/// What both methods cost; not asserted tightly, but shown: `cargo test -- --show-output tree_solves`.
#[test]
fn tree_solves_of_both_methods_stay_within_what_was_measured() {
    let slide = |mut graph: ConstraintGraph, push: f64, turn: f64| {
        (graph.wrenches[0][3], graph.wrenches[0][2]) = (push, turn);
        graph
    };
    let table = || box_on(20.0, TABLE, &corners(TABLE), 0.5);
    let topple = |levels: usize| {
        let mut graph = tower(&vec![1.0; levels], 0.5);
        graph.wrenches[levels - 1][3] = 8.0;
        graph
    };
    let scenes = [
        ("table on four legs", table(), 3, 5),
        ("table, pushed, stands", slide(table(), 50.0, 0.0), 5, 20),
        ("table, pushed, slides", slide(table(), 200.0, 0.0), 10, 80),
        ("table, slides and turns", slide(table(), 200.0, 30.0), 15, 100),
        ("ladder of 1 loop", ladder(1, &PLANE), 3, 6),
        ("ladder of 10 loops", ladder(10, &PLANE), 3, 20),
        ("ladder of 100 loops", ladder(100, &PLANE), 3, 50),
        ("ladder of 1000 loops", ladder(1000, &PLANE), 3, 50),
        ("ladder of 100, redundant rows", ladder(100, &SPACE), 4, 50),
        ("box on 1000 points", on_a_thousand(), 3, 40),
        ("box on 1000 points, slides", slide(on_a_thousand(), 130.0, 20.0), 20, 200),
        ("tower of 50", tower(&[1.0; 50], 0.5), 6, 80),
        ("tower of 250", tower(&[1.0; 250], 0.5), 8, 300),
        ("tower of 50, top pushed away", topple(50), 20, 1200),
        ("tower of 250, top pushed away", topple(250), 40, 20_000),
        ("masses 1 under 1000", tower(&[1.0, 1000.0], 0.5), 5, 10),
    ];
    println!("{:32} Newton: cold (factorisations), warm    conjugate gradient: cold, warm", "");
    for (name, graph, newton_most, gradient_most) in scenes {
        let mut line = format!("{name:32}");
        for (method, most) in [(Method::Newton, newton_most), (Method::ConjugateGradient, gradient_most)] {
            let settings = settings(method, 1e-10, 20_000);
            let (cold, mut workspace) = solved(&graph, &settings);
            // All loads one per cent larger, as between two steps.
            let mut later = graph.clone();
            later.wrenches.iter_mut().for_each(|w| *w *= 1.01);
            let mut warm = cold.clone();
            solve_graph(&later, &settings, &mut workspace, &mut warm).unwrap();
            assert!(cold.convergence.converged && warm.convergence.converged, "{name}, {method:?}");
            let (solves, factorizations) = (cold.convergence.iterations, cold.convergence.factorizations);
            assert!(solves <= most, "{name}, {method:?}: {solves}");
            line += &format!(" {solves:6} ({factorizations:2}) {:6}", warm.convergence.iterations);
        }
        println!("{line}");
    }
}
