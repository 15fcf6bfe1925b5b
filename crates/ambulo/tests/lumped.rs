//! Bodies whose joints follow, solved as one with what carries them: the same motions and forces as without that.

use crate::common::graphs::{METHODS, random_contacts, random_six, settings, solved};
use crate::common::random::Random;
use ambulo::dynamics::{ConstraintGraph, Link, Method, Six};

/// The graph with every hinge between bodies held at a separate motion.
fn followed(graph: &ConstraintGraph, r: &mut Random) -> ConstraintGraph {
    let mut held = graph.clone();
    held.links.clear();
    held.terms.directions.clear();
    held.efforts.clear();
    held.rotors.clear();
    let mut coordinate = 0;
    for (body, link) in graph.links.iter().enumerate() {
        let own = coordinate..coordinate + link.freedom;
        coordinate = own.end;
        if link.parent.is_some() {
            held.links.push(Link { freedom: 0, ..*link });
            held.terms.offset[body] = random_six(r);
        } else {
            held.links.push(*link);
            held.terms.directions.extend_from_slice(&graph.terms.directions[own.clone()]);
            held.efforts.extend_from_slice(&graph.efforts[own.clone()]);
            held.rotors.extend_from_slice(&graph.rotors[own]);
        }
    }
    held
}

/// Largest wrench of a free body's joint, which nothing holds.
fn left_over(graph: &ConstraintGraph, wrenches: &[Six]) -> f64 {
    let free = graph.links.iter().zip(wrenches).filter(|(link, _)| link.freedom == 6);
    free.map(|(_, wrench)| wrench.amax()).fold(0.0, f64::max)
}

#[test]
fn bodies_that_follow_move_as_a_solver_says_that_knows_them_one_by_one() {
    let (mut compared, mut carried) = (0, 0);
    for seed in 0..300 {
        let mut r = Random::new(seed);
        // Without friction the motion is unique.
        let graph = followed(&random_contacts(&mut r, 0.0), &mut r);
        let found = METHODS.map(|method| solved(&graph, &settings(method, 1e-11, 2000)));
        let [(one, workspace), (other, _)] = &found;
        if !(one.convergence.converged && other.convergence.converged) {
            continue;
        }
        compared += 1;
        carried += usize::from(graph.links.iter().any(|link| link.freedom == 0));
        let speed = one.motions.iter().map(Six::amax).fold(1.0, f64::max);
        for (a, b) in one.motions.iter().zip(&other.motions) {
            assert!((a - b).amax() < 1e-6 * speed, "seed {seed}: {a:?} {b:?}");
        }
        // Newton's law of each tree as a whole.
        let force = one.lambda.iter().fold(1.0_f64, |m, l| m.max(l.abs()));
        let wrenches = graph.joint_wrenches(workspace.outwards(), one);
        assert!(left_over(&graph, &wrenches) < 1e-7 * force, "seed {seed}");
    }
    assert!(compared > 200 && carried > 100, "{compared} compared, {carried} with bodies that follow");
}

#[test]
fn joints_that_follow_keep_to_what_they_prescribe() {
    for seed in 0..100 {
        let mut r = Random::new(seed);
        let graph = followed(&random_contacts(&mut r, 0.5), &mut r);
        let (solution, _) = solved(&graph, &settings(Method::Newton, 1e-10, 200));
        for (body, link) in graph.links.iter().enumerate() {
            let (Some(parent), 0) = (link.parent, link.freedom) else { continue };
            let (a, p, arm) = (&solution.motions[body], &solution.motions[parent], &graph.terms.arm[body]);
            let turn = ambulo::spatial::Vec3::new(p[0], p[1], p[2]);
            let v = ambulo::spatial::Vec3::new(p[3], p[4], p[5]) + turn.cross(arm);
            let relative = a - Six::new(p[0], p[1], p[2], v.x, v.y, v.z);
            let off = (relative - graph.terms.offset[body]).amax();
            assert!(off < 1e-9 * (1.0 + a.amax()), "seed {seed}, body {body}: {off:e}");
        }
    }
}
