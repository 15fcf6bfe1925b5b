//! The block elimination of trees and loops: against a dense solve of the same equations, against inverse dynamics, and
//! forwards again.

use crate::common::graphs::{add_hinged, add_rows, random_six, relative_rows, six};
use crate::common::random::{Random, Recipe, model, state};
use crate::common::{State, distance, largest};
use ambulo::dynamics::{
    ActsOn, BodyTerms, Constraint, ConstraintGraph, ConstraintGroup, Elimination, EliminationWorkspace, GraphSolution,
    GraphWorkspace, JointReaction, Law, Link, LinkError, Offsets, Six, SolverSettings, Workspace, inverse_frame,
    solve_graph,
};
use ambulo::kinematics::{BodyMotion, Posture, body_motion};
use ambulo::model::{BodyId, JointSpeeds, Model};
use ambulo::spatial::{Mat3, Vec3};
use nalgebra::{DMatrix, DVector, Matrix6};

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
        let on = ActsOn::Bodies { first, second };
        graph.groups.push(ConstraintGroup { on, rows: start..start + count, law: Law::EQUALITY });
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
        let ActsOn::Bodies { first, second } = group.on else { panic!("bodies only") };
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
fn random_trees_of_one_to_a_hundred_bodies_agree_with_a_dense_solve() {
    let mut worst = 0.0_f64;
    for (bodies, repeats) in [(1, 20), (2, 20), (5, 20), (20, 10), (40, 3), (100, 1)] {
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

/// Motions and coordinates of a graph of trees alone, with the number of directions that move no mass.
fn by_tree(graph: &ConstraintGraph) -> (Vec<Six>, Vec<f64>, usize) {
    let elimination = Elimination::new(&graph.links, &[]).unwrap_or_else(|e| panic!("{e}"));
    let mut workspace = EliminationWorkspace::default();
    workspace.begin(&elimination, &graph.bodies);
    elimination.factor(&graph.terms, &mut workspace);
    let (mut motions, mut coordinates) = (graph.wrenches.clone(), graph.efforts.clone());
    elimination.solve(&graph.terms, Offsets::Prescribed, &mut motions, &mut coordinates, &workspace);
    (motions, coordinates, workspace.inertialess())
}

/// A random model in motion, with its joint reactions and generalised forces from inverse dynamics without loads.
struct InMotion {
    model: Model,
    state: State,
    motion: Vec<BodyMotion>,
    reactions: Vec<JointReaction>,
    generalized: Vec<f64>,
}

fn in_motion(seed: u64) -> InMotion {
    let mut r = Random::new(seed);
    let model = model(&mut r, Recipe::ANY);
    let state = state(&mut r, &model);
    let mut workspace = Workspace::new(&model);
    let forces = inverse_frame(&mut workspace, state.posture(), &[]);
    let reactions = model.body_ids().map(|id| forces.reaction(id)).collect();
    let generalized = forces.generalized().to_vec();
    let motion = body_motion(&model, state.posture());
    InMotion { model, state, motion, reactions, generalized }
}

fn acceleration(motion: &BodyMotion) -> Six {
    six(motion.acceleration.angular, motion.acceleration.linear)
}

fn velocity(motion: &BodyMotion) -> Six {
    six(motion.twist.angular, motion.twist.linear)
}

/// A body's motion less its parent's, carried along.
fn relative(model: &Model, at: &[BodyMotion], body: usize, of: impl Fn(usize) -> Six) -> Six {
    match model.bodies()[body].joint.parent.map(BodyId::index) {
        None => of(body),
        Some(parent) => of(body) - transport(&(at[body].center - at[parent].center)) * of(parent),
    }
}

/// The bodies of a model with gravity and the gyroscopic moment, all six directions of every joint held.
fn held(case: &InMotion) -> ConstraintGraph {
    let mut graph = ConstraintGraph::default();
    for (i, (body, m)) in case.model.bodies().iter().zip(&case.motion).enumerate() {
        let (turn, omega, mass) = (m.pose.rotation, m.twist.angular, body.inertia.mass());
        let inertia = turn * body.inertia.about_center() * turn.transpose();
        let parent = body.joint.parent.map(BodyId::index);
        graph.bodies.push(BodyTerms { mass, inertia });
        graph.wrenches.push(six(-omega.cross(&(inertia * omega)), case.model.gravity() * mass));
        graph.links.push(Link { parent, freedom: 0 });
        graph.terms.arm.push(parent.map_or(Vec3::zeros(), |p| m.center - case.motion[p].center));
        graph.terms.offset.push(relative(&case.model, &case.motion, i, |b| acceleration(&case.motion[b])));
    }
    graph
}

/// The graph with every joint as free as the model has it, under these efforts.
fn freed_as_in_the_model(case: &InMotion) -> ConstraintGraph {
    let mut graph = held(case);
    let InMotion { model, state, .. } = case;
    let zeros = vec![0.0; state.q.len()];
    let coasting = body_motion(model, Posture { q: &state.q, qd: &state.qd, qdd: &zeros });
    for (i, body) in model.bodies().iter().enumerate() {
        graph.terms.offset[i] = relative(model, &coasting, i, |b| acceleration(&coasting[b]));
        graph.links[i].freedom = body.joint.coordinates().len();
        for id in body.joint.coordinates() {
            let mut rate = zeros.clone();
            rate[id.index()] = 1.0;
            let turned = body_motion(model, Posture { q: &state.q, qd: &rate, qdd: &zeros });
            let s = relative(model, &turned, i, |b| velocity(&turned[b]));
            graph.terms.directions.push(s);
            graph.efforts.push(effort(case, i, &s, case.generalized[id.index()]));
            graph.rotors.push(0.0);
        }
    }
    graph
}

/// The work of a joint's reaction per unit of motion along s: its generalised force. (Ball joints report the moment
/// about their axes instead, which is not what their angles' rates multiply.)
fn effort(case: &InMotion, body: usize, s: &Six, generalized: f64) -> f64 {
    let JointReaction { center, wrench } = case.reactions[body];
    let moment = wrench.moment + (center - case.motion[body].center).cross(&wrench.force);
    let work = s.dot(&six(moment, wrench.force));
    if case.model.bodies()[body].joint.speeds == JointSpeeds::Rates {
        let size = moment.norm() + wrench.force.norm();
        assert!((work - generalized).abs() <= 1e-11 * size, "{work} and {generalized}");
    }
    work
}

#[test]
fn with_every_joint_driven_its_wrench_is_the_reaction_of_inverse_dynamics() {
    let mut worst = 0.0_f64;
    for seed in 0..300 {
        let case = in_motion(seed);
        let graph = held(&case);
        let mut workspace = GraphWorkspace::default();
        let mut solution = GraphSolution::default();
        solve_graph(&graph, &SolverSettings::default(), &mut workspace, &mut solution).unwrap();
        let wrenches = graph.joint_wrenches(workspace.outwards(), &solution);
        let (mut found, mut expected) = (Vec::new(), Vec::new());
        for ((wrench, reaction), m) in wrenches.iter().zip(&case.reactions).zip(&case.motion) {
            let force = Vec3::new(wrench[3], wrench[4], wrench[5]);
            let moment = Vec3::new(wrench[0], wrench[1], wrench[2]) + (m.center - reaction.center).cross(&force);
            found.extend(moment.iter().chain(force.iter()));
            expected.extend(reaction.wrench.moment.iter().chain(reaction.wrench.force.iter()));
        }
        let error = distance(&found, &expected) / largest(expected.iter().copied());
        assert!(error < 1e-9, "seed {seed}: {error:e}");
        worst = worst.max(error);
    }
    println!("largest difference from inverse dynamics, relative: {worst:.1e}");
}

#[test]
fn applying_the_moments_of_inverse_dynamics_gives_the_accelerations_back() {
    let (mut worst, mut tested) = (0.0_f64, 0);
    for seed in 0..200 {
        let case = in_motion(seed);
        let graph = freed_as_in_the_model(&case);
        let (motions, coordinates, inertialess) = by_tree(&graph);
        if inertialess > 0 || singular(&graph) {
            continue;
        }
        let expected: Vec<f64> = case.motion.iter().flat_map(|m| acceleration(m).as_slice().to_vec()).collect();
        let found: Vec<f64> = motions.iter().flat_map(|a| a.as_slice().to_vec()).collect();
        let error = distance(&found, &expected) / largest(expected.iter().copied());
        // Random trees of ill-placed inertias have systems of condition 1e6 and worse.
        assert!(error < 1e-7, "seed {seed}: {error:e}");
        let ids = case.model.bodies().iter().flat_map(|b| b.joint.coordinates());
        let qdd: Vec<f64> = ids.map(|id| case.state.qdd[id.index()]).collect();
        assert!(distance(&coordinates, &qdd) < 1e-5 * largest(qdd.iter().copied()), "seed {seed}");
        (worst, tested) = (worst.max(error), tested + 1);
    }
    assert!(tested > 50, "{tested} models without singular joints or inertias");
    println!("largest error of the accelerations over {tested} models, relative: {worst:.1e}");
}

/// Whether a joint's coordinates move alike.
fn singular(graph: &ConstraintGraph) -> bool {
    let mut first = 0;
    graph.links.iter().any(|link| {
        let columns = &graph.terms.directions[first..first + link.freedom];
        first += link.freedom;
        !columns.is_empty() && DMatrix::from_fn(6, columns.len(), |i, k| columns[k][i]).singular_values().min() < 1e-3
    })
}

#[test]
fn moments_of_inverse_dynamics_without_gravity_do_not_give_the_accelerations_back() {
    let case = in_motion(1);
    let mut graph = freed_as_in_the_model(&case);
    for (wrench, body) in graph.wrenches.iter_mut().zip(case.model.bodies()) {
        let weight = case.model.gravity() * body.inertia.mass();
        *wrench -= six(Vec3::zeros(), weight);
    }
    let (motions, ..) = by_tree(&graph);
    let error = motions.iter().zip(&case.motion).map(|(a, m)| (a - acceleration(m)).norm()).fold(0.0, f64::max);
    assert!(error > 1e-2, "{error}");
}

#[test]
fn massless_bodies_within_a_tree_agree_with_a_dense_solve() {
    for seed in 0..20 {
        let mut graph = random_graph(&mut Random::new(seed), 8, 0);
        let carried = |body: usize| graph.links.iter().any(|l| l.parent == Some(body));
        // A massless body needs a child to resist its joint, and no more freedom than the child's joint leaves.
        let Some(body) = (0..8).find(|b| carried(*b) && graph.links[*b].parent.is_some()) else { continue };
        let at: usize = graph.links[..body].iter().map(|l| l.freedom).sum();
        let freedom = graph.links[body].freedom;
        for list in [&mut graph.efforts, &mut graph.rotors] {
            list.drain(at..at + freedom);
        }
        graph.terms.directions.drain(at..at + freedom);
        graph.links[body].freedom = 0;
        graph.bodies[body] = BodyTerms { mass: 0.0, inertia: Mat3::zeros() };
        let (expected, found) = (dense(&graph), flat(&solved(&graph)));
        let error = distance(&found, &expected) / largest(expected.iter().copied());
        assert!(error < 1e-9, "seed {seed}: {error:e}");
    }
}

#[test]
fn a_joint_that_moves_no_mass_stands_still_and_is_counted() {
    let mut graph = ConstraintGraph::default();
    let body = BodyTerms { mass: 2.0, inertia: Mat3::identity() };
    let arms = (Vec3::zeros(), Vec3::x());
    let carrier = add_hinged(&mut graph, None, arms, Vec3::z(), body);
    let nothing = BodyTerms { mass: 0.0, inertia: Mat3::zeros() };
    add_hinged(&mut graph, Some(carrier), arms, Vec3::z(), nothing);
    graph.efforts = vec![6.0, 1.0];
    let (motions, coordinates, inertialess) = by_tree(&graph);
    assert_eq!((inertialess, coordinates[1]), (1, 0.0));
    // Moment about the hinge over the inertia about it: the idle joint passes its effort on to nothing.
    assert!((coordinates[0] - 6.0 / (1.0 + 2.0)).abs() < 1e-12, "{coordinates:?}");
    assert!(motions.iter().all(|a| a.iter().all(|x| x.is_finite())));
}

#[test]
fn links_that_are_no_forest_are_refused_in_words() {
    let link = |parent, freedom| Link { parent, freedom };
    let refusal =
        |links: &[Link], couplings: &[(usize, usize)]| Elimination::new(links, couplings).map(|_| ()).unwrap_err();
    let error = refusal(&[link(None, 1), link(Some(5), 1)], &[]);
    assert_eq!(error, LinkError::NoBody { body: 1, parent: 5, bodies: 2 });
    assert_eq!(error.to_string(), "body 1 has body 5 as parent; expected a number below 2");
    let error = refusal(&[link(None, 1), link(Some(2), 1), link(Some(1), 1)], &[]);
    assert_eq!(error, LinkError::Circle { body: 1 });
    assert_eq!(error.to_string(), "body 1 is its own ancestor; expected trees. hint: close loops with constraint rows");
    let error = refusal(&[link(None, 7)], &[]);
    assert_eq!(error.to_string(), "body 0 has 7 free directions; expected at most 6");
    let error = refusal(&[link(None, 1), link(None, 1)], &[(1, 1)]);
    assert_eq!(error, LinkError::Coupling { first: 1, second: 1, bodies: 2 });
    assert_eq!(error.to_string(), "bodies 1 and 1 cannot be coupled; expected two different bodies below 2");
}

/// The graph with body i in place `to[i]`.
fn permuted(graph: &ConstraintGraph, to: &[usize]) -> ConstraintGraph {
    let mut from = vec![0; to.len()];
    to.iter().enumerate().for_each(|(i, place)| from[*place] = i);
    let first = |body: usize| graph.links[..body].iter().map(|l| l.freedom).sum::<usize>();
    let mut other = ConstraintGraph { rows: graph.rows.clone(), ..ConstraintGraph::default() };
    for &body in &from {
        let Link { parent, freedom } = graph.links[body];
        other.links.push(Link { parent: parent.map(|p| to[p]), freedom });
        other.bodies.push(graph.bodies[body]);
        other.wrenches.push(graph.wrenches[body]);
        other.terms.arm.push(graph.terms.arm[body]);
        other.terms.offset.push(graph.terms.offset[body]);
        let range = first(body)..first(body) + freedom;
        other.terms.directions.extend_from_slice(&graph.terms.directions[range.clone()]);
        other.efforts.extend_from_slice(&graph.efforts[range.clone()]);
        other.rotors.extend_from_slice(&graph.rotors[range]);
    }
    for group in &graph.groups {
        let ActsOn::Bodies { first, second } = group.on else { panic!("bodies only") };
        let on = ActsOn::Bodies { first: to[first], second: second.map(|s| to[s]) };
        other.groups.push(ConstraintGroup { on, ..group.clone() });
    }
    other
}

#[test]
fn the_order_of_bodies_does_not_matter() {
    for seed in 0..20 {
        let mut r = Random::new(seed);
        let graph = freed(random_graph(&mut r, 12, 3));
        let mut to: Vec<usize> = (0..12).collect();
        (1..12).for_each(|i| to.swap(i, r.below(i + 1)));
        let (one, other) = (solved(&graph), solved(&permuted(&graph, &to)));
        let size = one.motions.iter().map(|a| a.norm()).fold(0.0, f64::max);
        for (body, place) in to.iter().enumerate() {
            let error = (one.motions[body] - other.motions[*place]).norm() / size;
            // Twice what separates loops from a dense solve.
            assert!(error < 1e-8, "seed {seed}, body {body}: {error:e}");
        }
    }
}

#[test]
fn figures_beside_each_other_do_not_know_of_each_other() {
    let (a, b) = (random_graph(&mut Random::new(1), 7, 0), random_graph(&mut Random::new(2), 9, 0));
    let mut both = a.clone();
    both.links.extend(b.links.iter().map(|l| Link { parent: l.parent.map(|p| p + 7), ..*l }));
    both.bodies.extend(b.bodies.iter());
    both.wrenches.extend(b.wrenches.iter());
    both.efforts.extend(b.efforts.iter());
    both.rotors.extend(b.rotors.iter());
    both.terms.arm.extend(b.terms.arm.iter());
    both.terms.offset.extend(b.terms.offset.iter());
    both.terms.directions.extend(b.terms.directions.iter());
    let (a, b, both) = (by_tree(&a), by_tree(&b), by_tree(&both));
    assert_eq!(both.0[..7], a.0);
    assert_eq!(both.0[7..], b.0);
}

/// A four-bar linkage in the plane of x and z, hinged about y at four points; three bars, cut open at one of the
/// joints.
fn four_bar(cut: usize) -> ConstraintGraph {
    let corners = [Vec3::zeros(), Vec3::new(0.2, 0.0, 1.0), Vec3::new(1.3, 0.0, 1.2), Vec3::new(1.5, 0.0, 0.1)];
    let center = |bar: usize| 0.5 * (corners[bar] + corners[bar + 1]);
    let terms =
        |bar: usize| BodyTerms { mass: 1.0 + bar as f64, inertia: Mat3::identity() * (0.1 * (1.0 + bar as f64)) };
    let mut graph = ConstraintGraph::default();
    // Bars before the cut hang on the first corner, the others on the last; corner k joins bars k - 1 and k.
    let mut place = [0; 3];
    let mut parent = None;
    for bar in 0..cut.min(3) {
        let from_parent = parent.map_or(Vec3::zeros(), |_| corners[bar] - center(bar.max(1) - 1));
        let arms = (from_parent, center(bar) - corners[bar]);
        place[bar] = add_hinged(&mut graph, parent, arms, Vec3::y(), terms(bar));
        parent = Some(place[bar]);
    }
    parent = None;
    for bar in (cut..3).rev() {
        let from_parent = parent.map_or(Vec3::zeros(), |_| corners[bar + 1] - center(bar + 1));
        let arms = (from_parent, center(bar) - corners[bar + 1]);
        place[bar] = add_hinged(&mut graph, parent, arms, Vec3::y(), terms(bar));
        parent = Some(place[bar]);
    }
    let on = match cut {
        3 => ActsOn::Bodies { first: place[2], second: None },
        k => ActsOn::Bodies { first: place[k - 1], second: Some(place[k]) },
    };
    let from_second = if cut == 3 { Vec3::zeros() } else { corners[cut] - center(cut) };
    let rows = relative_rows([Vec3::x(), Vec3::y(), Vec3::z()], center(cut - 1) - corners[cut], from_second);
    add_rows(&mut graph, on, &[rows[3], rows[5]], Law::EQUALITY);
    // In the order of bars, whoever hangs on whom.
    let mut to = [0; 3];
    place.iter().enumerate().for_each(|(bar, p)| to[*p] = bar);
    permuted(&graph, &to)
}

#[test]
fn cutting_a_loop_elsewhere_changes_nothing() {
    let expected = solved(&four_bar(3)).motions;
    assert!(expected.iter().all(|a| a.norm() > 0.1), "it moves: {expected:?}");
    for cut in [1, 2] {
        let error = distance(
            &solved(&four_bar(cut)).motions.iter().flat_map(|a| a.as_slice().to_vec()).collect::<Vec<_>>(),
            &expected.iter().flat_map(|a| a.as_slice().to_vec()).collect::<Vec<_>>(),
        );
        assert!(error < 1e-9, "cut at corner {cut}: {error:e}");
    }
}

#[test]
fn a_loop_left_open_is_noticed() {
    let mut open = four_bar(3);
    open.rows.clear();
    open.groups.clear();
    let apart = |bar: usize| (solved(&open).motions[bar] - solved(&four_bar(3)).motions[bar]).norm();
    assert!(apart(2) > 0.1, "{}", apart(2));
}

#[test]
fn two_hinges_on_one_line_with_nothing_between_count_as_one() {
    let mut r = Random::new(4);
    for _ in 0..50 {
        let (axis, point) = (r.unit(), r.vector(1.0));
        let mut graph = ConstraintGraph::default();
        let first = add_hinged(
            &mut graph,
            None,
            (Vec3::zeros(), Vec3::zeros()),
            axis,
            BodyTerms { mass: 0.0, inertia: Mat3::zeros() },
        );
        let turn = r.rotation();
        let inertia = turn * Mat3::from_diagonal(&Vec3::new(0.3, 0.5, 0.7)) * turn.transpose();
        add_hinged(&mut graph, Some(first), (r.within(1.0) * axis, point), axis, BodyTerms { mass: 2.0, inertia });
        let (motions, q, inertialess) = by_tree(&graph);
        assert_eq!((inertialess, q[0]), (1, 0.0));
        // The outer hinge turns as if it hung on ground.
        let arm = point - point.dot(&axis) * axis;
        let moment = axis.dot(&(inertia * axis)) + 2.0 * arm.norm_squared();
        let expected = axis.dot(&point.cross(&Vec3::new(0.0, 0.0, -2.0 * 9.81))) / moment;
        assert!((q[1] - expected).abs() < 1e-12 * expected.abs().max(1.0), "{} and {expected}", q[1]);
        assert!((motions[1].fixed_rows::<3>(0) - axis * expected).norm() < 1e-10);
    }
}

#[test]
fn a_chain_of_ten_thousand_links_loses_no_joint_to_rounding() {
    let mut graph = ConstraintGraph::default();
    let mut parent = None;
    let link = BodyTerms { mass: 1.0, inertia: Mat3::identity() * 0.1 };
    for i in 0..10_000 {
        let arm = Vec3::new(0.5, 0.1, 0.2);
        let axis = if i % 2 == 0 { Vec3::y() } else { Vec3::z() };
        parent = Some(add_hinged(&mut graph, parent, (arm, arm), axis, link));
    }
    assert_eq!(by_tree(&graph).2, 0);
}
