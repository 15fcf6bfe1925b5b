//! The example that writes out the algorithm of the 1997 paper finds the accelerations and forces of the engine.

use ambulo_walk::dynamics::{Method, SolverSettings};
use ambulo_walk::engine::{
    Closure, JointCoordinate, JointDrive, JointKind, RigidBody, StepWorkspace, TreeJoint, World, WorldState,
    accelerations,
};
use ambulo_walk::spatial::{Mat3, Pose, Twist, Vec3, Wrench, rotation};

#[path = "../examples/three_steps.rs"]
mod example;

use example::{DRIVE, LENGTHS, Linkage, MASSES};

/// The linkage for the engine: a tree of three hinges, and a closure where coupler and rocker meet.
fn world(linkage: &Linkage) -> World {
    let [crank, coupler, rocker] = linkage.half;
    let centers = [crank, crank * 2.0 + coupler, coupler * 2.0 + rocker];
    let mut world = World::default();
    for (k, parent) in [None, Some(0), None].into_iter().enumerate() {
        let along = linkage.half[k];
        let rotation = rotation(&(Vec3::z() * along.y.atan2(along.x)));
        let [x, y, turning] = [0, 1, 2].map(|n| linkage.v[3 * k + n]);
        world.bodies.push(RigidBody {
            name: k.to_string(),
            mass: MASSES[k],
            inertia: Mat3::identity() * linkage.mass[3 * k + 2],
            pose: Pose { rotation, translation: centers[k] },
            twist: Twist { angular: Vec3::z() * turning, linear: Vec3::new(x, y, 0.0) },
            load: Wrench::ZERO,
        });
        let at = [0.0, LENGTHS[0] / 2.0, LENGTHS[1]][k];
        let frames = [at, -LENGTHS[k] / 2.0].map(|x| Pose::at(Vec3::x() * x));
        world.joints.push(TreeJoint::free(k.to_string(), JointKind::Revolute, k, parent, frames));
    }
    let drive = Some(JointDrive { signal: DRIVE, max: None });
    world.joints[0].coordinates[0] = JointCoordinate { drive, ..JointCoordinate::default() };
    let [first_from_joint, second_from_joint] = [1, 2].map(|k| Pose::at(Vec3::x() * LENGTHS[k] / 2.0));
    world.closures.push(Closure {
        name: "loop".to_owned(),
        first: 1,
        second: Some(2),
        first_from_joint,
        second_from_joint,
        kind: JointKind::Ball,
        active: true,
    });
    world
}

/// Largest difference, as a share of the largest number.
fn off(found: &[f64], expected: &[f64]) -> f64 {
    let most = expected.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    found.iter().zip(expected).fold(0.0_f64, |off, (a, b)| off.max((a - b).abs())) / most
}

#[test]
fn the_three_steps_of_the_paper_give_the_accelerations_and_forces_of_the_engine() {
    let linkage = Linkage::new();
    let (found, lambda) = linkage.solve();
    for method in [Method::Newton, Method::ConjugateGradient] {
        let world = world(&linkage);
        let (state, mut w) = (WorldState::new(&world), StepWorkspace::default());
        let solver = SolverSettings { method, tolerance: 1e-14, ..SolverSettings::default() };
        let twists = accelerations(&world, &state, &solver, &mut w).unwrap();
        let expected: Vec<f64> = twists.iter().flat_map(|t| [t.linear.x, t.linear.y, t.angular.z]).collect();
        let forces = w.forces(&world);
        let pin = forces.closing[0].1.force;
        let [motion, force] = [off(&found, &expected), off(&lambda[6..], &[pin.x, pin.y, forces.efforts[0][0]])];
        println!("{method:?}: accelerations differ by {motion:.1e}, forces of loop and drive by {force:.1e}");
        assert!(motion < 1e-12 && force < 1e-12, "{method:?}: {motion} {force}");
        let without_loop = off(&lambda[6..], &[0.0, 0.0, forces.efforts[0][0]]);
        assert!(without_loop > 1e-3, "a force of the loop that is missing must show");
    }
    example::main();
}
