//! The tree solve: against a dense solve of the same equations, against inverse dynamics, and forwards again.

mod common;

use ambulo::dynamics::{
    BodyTerms, Constraint, Forest, ForestError, ForestWorkspace, Link, Six, Workspace, inverse_frame, relative_rows,
};
use ambulo::kinematics::{BodyMotion, Posture, body_motion};
use ambulo::model::{BodyId, Model};
use ambulo::spatial::{Mat3, Vec3, Wrench};
use common::random::{Random, Recipe, model, state};
use common::{State, distance, largest};
use nalgebra::{DMatrix, DVector};

/// Bodies, joints and rows of one problem.
struct Problem {
    bodies: Vec<BodyTerms>,
    links: Vec<Link>,
    rows: Vec<Constraint>,
}

fn random_six(r: &mut Random) -> Six {
    Six::from_iterator(r.list(6, 1.0))
}

/// Random trees: `bodies` bodies, most on another one, with 0 to 6 random rows.
fn random_problem(r: &mut Random, bodies: usize) -> Problem {
    let mut problem = Problem { bodies: Vec::new(), links: Vec::new(), rows: Vec::new() };
    for child in 0..bodies {
        let turn = r.rotation();
        let diagonal = Vec3::new(r.between(0.1, 1.0), r.between(0.1, 1.0), r.between(0.1, 1.0));
        problem.bodies.push(BodyTerms {
            mass: r.between(0.5, 20.0),
            inertia: turn * Mat3::from_diagonal(&diagonal) * turn.transpose(),
            wrench: Wrench { moment: r.vector(10.0), force: r.vector(100.0) },
        });
        let rows = r.below(7);
        let parent = (child > 0 && r.chance(0.9)).then(|| r.below(child));
        problem.links.push(Link { child, parent, rows });
        for _ in 0..rows {
            let (on_child, on_parent) = (random_six(r), random_six(r));
            problem.rows.push(Constraint { on_child, on_parent, target: r.within(5.0) });
        }
    }
    problem
}

/// Accelerations (6 a body), then multipliers, by one dense factorisation of the whole system.
fn dense(problem: &Problem) -> Vec<f64> {
    let (n, rows) = (6 * problem.bodies.len(), problem.rows.len());
    let mut matrix = DMatrix::zeros(n + rows, n + rows);
    let mut right = DVector::zeros(n + rows);
    for (i, body) in problem.bodies.iter().enumerate() {
        matrix.view_mut((6 * i, 6 * i), (3, 3)).copy_from(&body.inertia);
        matrix.view_mut((6 * i + 3, 6 * i + 3), (3, 3)).copy_from(&(Mat3::identity() * body.mass));
        right.rows_mut(6 * i, 3).copy_from(&body.wrench.moment);
        right.rows_mut(6 * i + 3, 3).copy_from(&body.wrench.force);
    }
    let mut number = 0;
    for link in &problem.links {
        for row in &problem.rows[number..number + link.rows] {
            for (body, j) in std::iter::once((link.child, row.on_child)).chain(link.parent.map(|p| (p, row.on_parent)))
            {
                matrix.view_mut((n + number, 6 * body), (1, 6)).copy_from(&j.transpose());
                matrix.view_mut((6 * body, n + number), (6, 1)).copy_from(&-j);
            }
            right[n + number] = row.target;
            number += 1;
        }
    }
    matrix.lu().solve(&right).map_or_else(Vec::new, |x| x.iter().copied().collect())
}

/// The same by the tree solve, with the counts of redundant rows and of directions without inertia.
fn by_tree(problem: &Problem) -> (Vec<f64>, usize, usize) {
    let forest = Forest::new(problem.bodies.len(), &problem.links).unwrap_or_else(|e| panic!("{e}"));
    let mut workspace = ForestWorkspace::new(&forest);
    forest.factor(&problem.bodies, &problem.rows, &mut workspace);
    let solution = forest.solve(&problem.bodies, &problem.rows, &mut workspace);
    let mut all = Vec::new();
    for body in 0..problem.bodies.len() {
        let a = solution.acceleration(body);
        all.extend(a.angular.iter().chain(a.linear.iter()));
    }
    all.extend_from_slice(solution.lambda);
    (all, solution.redundant, solution.inertialess)
}

#[test]
fn random_trees_of_one_to_two_hundred_bodies_agree_with_a_dense_solve() {
    let mut worst = 0.0_f64;
    for (bodies, repeats) in [(1, 20), (2, 20), (5, 20), (20, 10), (60, 3), (200, 1)] {
        for seed in 0..repeats {
            let problem = random_problem(&mut Random::new(1000 * bodies as u64 + seed), bodies);
            let (expected, (found, _, _)) = (dense(&problem), by_tree(&problem));
            let error = distance(&found, &expected) / largest(expected.iter().copied());
            assert!(error < 1e-9, "{bodies} bodies, seed {seed}: {error:e}");
            worst = worst.max(error);
        }
    }
    println!("largest difference from the dense solve, relative: {worst:.1e}");
}

#[test]
fn a_row_left_out_of_the_dense_solve_is_noticed() {
    let problem = random_problem(&mut Random::new(7), 5);
    let mut other = random_problem(&mut Random::new(7), 5);
    let last = other.rows.len() - 1;
    other.rows[last].target += 1.0;
    assert!(distance(&by_tree(&problem).0, &dense(&other)) > 1e-3);
}

/// A model's bodies and six rows for every joint, at a posture; targets zero.
fn driven(model: &Model, motion: &[BodyMotion], centers: &[Vec3]) -> Problem {
    let mut problem = Problem { bodies: Vec::new(), links: Vec::new(), rows: Vec::new() };
    for (child, (body, m)) in model.bodies().iter().zip(motion).enumerate() {
        let turn = m.pose.rotation;
        let inertia = turn * body.inertia.about_center() * turn.transpose();
        let omega = m.twist.angular;
        let wrench = Wrench { moment: -omega.cross(&(inertia * omega)), force: model.gravity() * body.inertia.mass() };
        problem.bodies.push(BodyTerms { mass: body.inertia.mass(), inertia, wrench });
        let parent = body.joint.parent.map(BodyId::index);
        problem.links.push(Link { child, parent, rows: 6 });
        let parent_center = parent.map_or(Vec3::zeros(), |p| motion[p].center);
        let axes = [Vec3::x(), Vec3::y(), Vec3::z()];
        problem.rows.extend(relative_rows(axes, m.center - centers[child], centers[child] - parent_center));
    }
    problem
}

fn acceleration(motion: &BodyMotion) -> Six {
    let (a, l) = (motion.acceleration.angular, motion.acceleration.linear);
    Six::new(a.x, a.y, a.z, l.x, l.y, l.z)
}

fn velocity(motion: &BodyMotion) -> Six {
    let (a, l) = (motion.twist.angular, motion.twist.linear);
    Six::new(a.x, a.y, a.z, l.x, l.y, l.z)
}

/// What a row makes of the motion of its child and parent.
fn applied(row: &Constraint, link: &Link, of: impl Fn(usize) -> Six) -> f64 {
    row.on_child.dot(&of(link.child)) + link.parent.map_or(0.0, |p| row.on_parent.dot(&of(p)))
}

/// A random model in motion: its motion, joint reactions and joint centres from inverse dynamics without loads.
fn in_motion(seed: u64) -> (Model, State, Vec<BodyMotion>, Vec<Wrench>, Vec<Vec3>) {
    let mut r = Random::new(seed);
    let model = model(&mut r, Recipe::ANY);
    let state = state(&mut r, &model);
    let mut workspace = Workspace::new(&model);
    let forces = inverse_frame(&mut workspace, state.posture(), &[]);
    let reactions: Vec<_> = model.body_ids().map(|id| forces.reaction(id)).collect();
    let motion = body_motion(&model, state.posture());
    let (wrenches, centers) = reactions.iter().map(|r| (r.wrench, r.center)).unzip();
    (model, state, motion, wrenches, centers)
}

#[test]
fn with_every_joint_driven_the_multipliers_are_the_reactions_of_inverse_dynamics() {
    let mut worst = 0.0_f64;
    for seed in 0..300 {
        let (model, _, motion, wrenches, centers) = in_motion(seed);
        let mut problem = driven(&model, &motion, &centers);
        for (i, row) in problem.rows.iter_mut().enumerate() {
            row.target = applied(row, &problem.links[i / 6], |b| acceleration(&motion[b]));
        }
        let (found, redundant, inertialess) = by_tree(&problem);
        assert_eq!((redundant, inertialess), (0, 0), "seed {seed}");
        let lambda = &found[6 * motion.len()..];
        let expected: Vec<f64> =
            wrenches.iter().flat_map(|w| w.moment.iter().chain(w.force.iter()).copied().collect::<Vec<_>>()).collect();
        let error = distance(lambda, &expected) / largest(expected.iter().copied());
        assert!(error < 1e-9, "seed {seed}: {error:e}");
        worst = worst.max(error);
    }
    println!("largest difference from inverse dynamics, relative: {worst:.1e}");
}

/// Columns that span a joint's motion in its six rows, one for each coordinate, from unit rates.
fn freedom(model: &Model, state: &State, problem: &Problem, child: usize) -> DMatrix<f64> {
    let coordinates = model.bodies()[child].joint.coordinates();
    let zeros = vec![0.0; state.q.len()];
    let mut s = DMatrix::zeros(6, coordinates.len());
    for (k, id) in coordinates.iter().enumerate() {
        let mut rate = zeros.clone();
        rate[id.index()] = 1.0;
        let motion = body_motion(model, Posture { q: &state.q, qd: &rate, qdd: &zeros });
        for row in 0..6 {
            s[(row, k)] = applied(&problem.rows[6 * child + row], &problem.links[child], |b| velocity(&motion[b]));
        }
    }
    s
}

#[test]
fn applying_the_moments_of_inverse_dynamics_gives_the_accelerations_back() {
    let (mut worst, mut tested) = (0.0_f64, 0);
    for seed in 0..200 {
        let (model, state, motion, wrenches, centers) = in_motion(seed);
        let full = driven(&model, &motion, &centers);
        let zeros = vec![0.0; state.q.len()];
        let coasting = body_motion(&model, Posture { q: &state.q, qd: &state.qd, qdd: &zeros });
        let mut forward = Problem { bodies: full.bodies.clone(), links: Vec::new(), rows: Vec::new() };
        let mut regular = true;
        for (child, link) in full.links.iter().enumerate() {
            let s = freedom(&model, &state, &full, child);
            let w =
                DVector::from_iterator(6, wrenches[child].moment.iter().chain(wrenches[child].force.iter()).copied());
            let onto = onto(&s);
            regular &= onto.is_some();
            let Some(onto) = onto else { break };
            // The part of the reaction that does work is applied; the rest must come out as multipliers.
            apply(&mut forward, &full, child, &(&onto * w));
            let projector = DMatrix::identity(6, 6) - onto;
            let before = forward.rows.len();
            forward.rows.extend(constraining(&full, child, &projector, &coasting));
            forward.links.push(Link { rows: forward.rows.len() - before, ..*link });
        }
        if !regular {
            continue;
        }
        let (found, _, inertialess) = by_tree(&forward);
        if inertialess > 0 {
            continue;
        }
        let expected: Vec<f64> =
            motion.iter().flat_map(|m| acceleration(m).iter().copied().collect::<Vec<_>>()).collect();
        let error = distance(&found[..expected.len()], &expected) / largest(expected.iter().copied());
        (worst, tested) = (worst.max(error), tested + 1);
        // Random trees of ill-placed inertias have systems of condition 1e6 and worse.
        assert!(error < 1e-7, "seed {seed}: {error:e}");
    }
    assert!(tested > 50, "{tested} models without singular joints or inertias");
    println!("largest error of the accelerations over {tested} models, relative: {worst:.1e}");
}

/// The projection onto a joint's freedom; `None` where two of its coordinates move alike.
fn onto(freedom: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    if freedom.ncols() == 0 {
        return Some(DMatrix::zeros(6, 6));
    }
    let svd = freedom.clone().svd(true, true);
    let regular = svd.singular_values.iter().all(|x| *x > 1e-3);
    regular.then(|| freedom * svd.pseudo_inverse(1e-9).unwrap_or_else(|e| panic!("{e}")))
}

/// Adds a joint's wrench (six numbers in its rows) to the child, and its opposite to the parent.
fn apply(forward: &mut Problem, full: &Problem, child: usize, wrench: &DVector<f64>) {
    let link = full.links[child];
    for (row, share) in full.rows[6 * child..6 * child + 6].iter().zip(wrench.iter()) {
        for (body, j) in std::iter::once((link.child, row.on_child)).chain(link.parent.map(|p| (p, row.on_parent))) {
            let push = j * *share;
            forward.bodies[body].wrench.moment += Vec3::new(push[0], push[1], push[2]);
            forward.bodies[body].wrench.force += Vec3::new(push[3], push[4], push[5]);
        }
    }
}

/// Rows for the directions in which a joint does not move, with the acceleration that the velocities alone give.
fn constraining(full: &Problem, child: usize, projector: &DMatrix<f64>, coasting: &[BodyMotion]) -> Vec<Constraint> {
    let own = &full.rows[6 * child..6 * child + 6];
    let row = |u: &DVector<f64>| {
        let mut row = Constraint { on_child: Six::zeros(), on_parent: Six::zeros(), target: 0.0 };
        for (part, share) in own.iter().zip(u.iter()) {
            row.on_child += part.on_child * *share;
            row.on_parent += part.on_parent * *share;
        }
        row.target = applied(&row, &full.links[child], |b| acceleration(&coasting[b]));
        row
    };
    range(projector).iter().map(row).collect()
}

/// An orthonormal basis of a projection's range: columns, the one with most left over first (Gram and Schmidt).
fn range(projector: &DMatrix<f64>) -> Vec<DVector<f64>> {
    let mut left = projector.clone();
    let mut basis: Vec<DVector<f64>> = Vec::new();
    while basis.len() < 6 {
        let column = left.column_iter().max_by(|a, b| a.norm().total_cmp(&b.norm())).map(|c| c.into_owned());
        let Some(column) = column.filter(|c| c.norm() > 1e-6) else { break };
        let unit = column.normalize();
        left -= &unit * (unit.transpose() * &left);
        basis.push(unit);
    }
    basis
}

#[test]
fn a_row_that_stands_twice_is_counted_and_changes_no_acceleration() {
    let mut r = Random::new(3);
    let mut problem = random_problem(&mut r, 1);
    problem.links[0].rows = 3;
    problem.rows =
        (0..3).map(|_| Constraint { on_child: random_six(&mut r), on_parent: Six::zeros(), target: 1.0 }).collect();
    let (alone, none, _) = by_tree(&problem);
    problem.links[0].rows = 4;
    problem.rows.push(problem.rows[1]);
    let (doubled, one, _) = by_tree(&problem);
    assert_eq!((none, one), (0, 1));
    assert!(distance(&alone[..6], &doubled[..6]) < 1e-10);
}

#[test]
fn a_light_body_on_a_heavy_chain_and_the_reverse_lose_no_more_than_their_ratio() {
    for (first, second) in [(1e3, 1e-3), (1e-3, 1e3)] {
        let mut problem = random_problem(&mut Random::new(11), 2);
        for (body, mass) in problem.bodies.iter_mut().zip([first, second]) {
            body.mass = mass;
            body.inertia = Mat3::identity() * (0.01 * mass);
        }
        let (expected, (found, _, _)) = (dense(&problem), by_tree(&problem));
        let error = distance(&found, &expected) / largest(expected.iter().copied());
        // Eliminating a body of 1e-3 kg beside one of 1e3 kg loses their ratio times 1e-16, thrice for good measure.
        assert!(error < 3e-10, "{first} and {second} kg: {error:e}");
    }
}

#[test]
fn links_that_are_no_forest_are_refused() {
    let link = |child, parent, rows| Link { child, parent, rows };
    let refusal = |links: &[Link]| Forest::new(3, links).map(|_| ()).unwrap_err();
    assert_eq!(refusal(&[link(3, None, 1)]), ForestError::NoBody { link: 0, body: 3, bodies: 3 });
    assert_eq!(refusal(&[link(0, None, 1), link(0, Some(1), 1)]), ForestError::TwoParents { body: 0, link: 1 });
    assert_eq!(refusal(&[link(1, Some(2), 1), link(2, Some(1), 1)]), ForestError::Circle { body: 1 });
    assert_eq!(refusal(&[link(0, None, 7)]), ForestError::Rows { link: 0, rows: 7 });
}

#[test]
fn one_factorisation_serves_any_wrenches_and_targets() {
    let mut r = Random::new(21);
    let problem = random_problem(&mut r, 12);
    let forest = Forest::new(problem.bodies.len(), &problem.links).unwrap();
    let mut workspace = ForestWorkspace::new(&forest);
    forest.factor(&problem.bodies, &problem.rows, &mut workspace);
    for _ in 0..3 {
        let mut other =
            Problem { bodies: problem.bodies.clone(), links: problem.links.clone(), rows: problem.rows.clone() };
        for body in &mut other.bodies {
            body.wrench = Wrench { moment: r.vector(10.0), force: r.vector(100.0) };
        }
        for row in &mut other.rows {
            row.target = r.within(5.0);
        }
        let lambda = forest.solve(&other.bodies, &other.rows, &mut workspace).lambda.to_vec();
        // The same arithmetic on the same factors.
        assert_eq!(lambda, by_tree(&other).0[6 * other.bodies.len()..]);
    }
}

#[test]
fn figures_beside_each_other_do_not_know_of_each_other() {
    let (a, b) = (random_problem(&mut Random::new(1), 7), random_problem(&mut Random::new(2), 9));
    let both = Problem {
        bodies: [a.bodies.clone(), b.bodies.clone()].concat(),
        links: a
            .links
            .iter()
            .copied()
            .chain(b.links.iter().map(|l| Link { child: l.child + 7, parent: l.parent.map(|p| p + 7), ..*l }))
            .collect(),
        rows: [a.rows.clone(), b.rows.clone()].concat(),
    };
    let (a, b, both) = (by_tree(&a).0, by_tree(&b).0, by_tree(&both).0);
    assert_eq!(both[..42], a[..42]);
    assert_eq!(both[42..96], b[..54]);
}
