//! The simulator against MuJoCo 4.0.0 on a human of 37 degrees of freedom: accelerations under joint torques, and 1 s
//! of motion. The numbers and how they were made are in tests/testdata.
//!
//! Joints of two and three hinges at one place are built from hinges here too, with bodies without mass between them.

use ambulo::dynamics::SolverSettings;
use ambulo::findings::Findings;
use ambulo::simulation::{
    Integrator, JointCoordinate, JointKind, RigidBody, StepSettings, StepWorkspace, TreeJoint, World, WorldState,
    accelerations, step,
};
use ambulo::spatial::{Mat3, Pose, Twist, Vec3, Wrench};
use serde_json::Value;

/// What a joint's rows and the elimination round to, relative to the largest acceleration (some 1e4 rad/s² of a toe).
const ACCELERATION_TOLERANCE: f64 = 1e-8;
/// Asked for; MuJoCo's own trajectories at 1 ms and 0.25 ms differ by 1e-9 to 1e-12 m.
const TRAJECTORY_TOLERANCE_M: f64 = 1e-5;

fn golden() -> Value {
    serde_json::from_str(include_str!("testdata/mujoco_human.json")).unwrap()
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect()
}

fn vector(value: &Value) -> Vec3 {
    Vec3::from_column_slice(&numbers(value))
}

/// Rotation of a quaternion w, x, y, z.
fn turned(value: &Value) -> Mat3 {
    let q = numbers(value);
    let length = q.iter().map(|x| x * x).sum::<f64>().sqrt();
    let [w, x, y, z] = [0, 1, 2, 3].map(|k| q[k] / length);
    Mat3::new(
        1.0 - 2.0 * (y * y + z * z),
        2.0 * (x * y - w * z),
        2.0 * (x * z + w * y),
        2.0 * (x * y + w * z),
        1.0 - 2.0 * (x * x + z * z),
        2.0 * (y * z - w * x),
        2.0 * (x * z - w * y),
        2.0 * (y * z + w * x),
        1.0 - 2.0 * (x * x + y * y),
    )
}

/// The human in one of the states; efforts on hinges. Also the world's body of each segment.
fn human(golden: &Value, state: &Value, tau: &[f64]) -> (World, Vec<usize>) {
    let mut world = World { gravity: vector(&golden["gravity"]), ..World::default() };
    let (q, qd) = (numbers(&state["q"]), numbers(&state["qd"]));
    let hinges = golden["joints"].as_array().unwrap();
    let segments = golden["bodies"].as_array().unwrap();
    let mut of_segment: Vec<usize> = Vec::new();
    let mut next = 0;
    for segment in segments {
        let name = segment["name"].as_str().unwrap();
        let (mass, com) = (segment["mass"].as_f64().unwrap(), vector(&segment["com"]));
        let inertia = Mat3::from_diagonal(&vector(&segment["inertia"]));
        let parent = segments.iter().position(|s| s["name"] == segment["parent"]);
        let Some(parent) = parent else {
            let root = &state["root"];
            let rotation = turned(&root["quaternion"]);
            let angular = rotation * vector(&root["angular_velocity"]);
            let linear = vector(&root["velocity"]) + angular.cross(&(rotation * com));
            let pose = Pose { rotation, translation: vector(&root["position"]) + rotation * com };
            of_segment.push(add(&mut world, name, mass, inertia, pose, Twist { angular, linear }));
            continue;
        };
        // Place of the joint, in the body that carries the next hinge.
        let mut carrier = of_segment[parent];
        let mut at = vector(&segment["position"]) - vector(&segments[parent]["com"]);
        let own: Vec<usize> = (0..hinges.len()).filter(|h| hinges[*h]["body"] == segment["name"]).collect();
        for (number, hinge) in own.iter().enumerate() {
            assert_eq!(*hinge, next, "hinges stand in the order of segments");
            next += 1;
            let last = number + 1 == own.len();
            let axis = vector(&hinges[*hinge]["axis"]);
            let frame = along(&axis);
            let child_com = if last { com } else { Vec3::zeros() };
            let before = (world.bodies[carrier].pose, world.bodies[carrier].twist);
            let rotation = before.0.rotation * about(&axis, q[*hinge]);
            let joint_at = before.0.place(at);
            let arm = rotation * child_com;
            let angular = before.1.angular + before.0.rotation * axis * qd[*hinge];
            let linear = before.1.velocity_at(joint_at - before.0.translation) + angular.cross(&arm);
            let pose = Pose { rotation, translation: joint_at + arm };
            let (m, i) = if last { (mass, inertia) } else { (0.0, Mat3::zeros()) };
            let child = add(&mut world, name, m, i, pose, Twist { angular, linear });
            world.joints.push(TreeJoint {
                name: hinges[*hinge]["name"].as_str().unwrap().to_owned(),
                child,
                parent: Some(carrier),
                parent_from_joint: Pose { rotation: frame, translation: at },
                child_from_joint: Pose { rotation: frame, translation: -child_com },
                kind: JointKind::Revolute,
                coordinates: vec![JointCoordinate { effort: tau[*hinge], ..JointCoordinate::default() }],
                follows: None,
            });
            (carrier, at) = (child, Vec3::zeros());
        }
        of_segment.push(carrier);
    }
    (world, of_segment)
}

fn add(world: &mut World, name: &str, mass: f64, inertia: Mat3, pose: Pose, twist: Twist) -> usize {
    world.bodies.push(RigidBody { name: name.to_owned(), mass, inertia, pose, twist, load: Wrench::ZERO });
    world.bodies.len() - 1
}

/// Axes with z along one of the coordinate axes.
fn along(axis: &Vec3) -> Mat3 {
    Mat3::from_columns(&[Vec3::new(axis.z, axis.x, axis.y), Vec3::new(axis.y, axis.z, axis.x), *axis])
}

/// Rotation about a unit axis (Rodrigues).
fn about(axis: &Vec3, angle: f64) -> Mat3 {
    let k = axis.cross_matrix();
    Mat3::identity() + k * angle.sin() + k * k * (1.0 - angle.cos())
}

/// Largest difference of accelerations from MuJoCo's, relative to the largest of them.
fn acceleration_error(golden: &Value, state: &Value, tau: &[f64]) -> f64 {
    let (world, of_segment) = human(golden, state, tau);
    let start = WorldState::new(&world);
    let found = accelerations(&world, &start, &SolverSettings::default(), &mut StepWorkspace::default()).unwrap();
    let (mut error, mut scale) = (0.0_f64, 0.0_f64);
    for (segment, body) in of_segment.iter().enumerate() {
        let linear = vector(&state["bodies"]["com_acceleration"][segment]);
        let angular = vector(&state["bodies"]["angular_acceleration"][segment]);
        error = error.max((found[*body].linear - linear).amax()).max((found[*body].angular - angular).amax());
        scale = scale.max(linear.amax()).max(angular.amax());
    }
    error / scale
}

#[test]
fn accelerations_under_joint_torques_equal_mujocos() {
    let golden = golden();
    for state in golden["states"].as_array().unwrap() {
        let error = acceleration_error(&golden, state, &numbers(&state["tau"]));
        println!("largest difference of accelerations from MuJoCo, relative: {error:.1e}");
        assert!(error < ACCELERATION_TOLERANCE, "{error:e}");
    }
}

#[test]
fn a_torque_of_the_wrong_sign_is_noticed() {
    let golden = golden();
    let state = &golden["states"][0];
    let mut tau = numbers(&state["tau"]);
    tau[3] = -tau[3];
    assert!(acceleration_error(&golden, state, &tau) > 1e-3);
}

/// Largest distance of a mass centre from MuJoCo's over the trajectory [m].
fn trajectory_error(golden: &Value, trajectory: &Value, integrator: Integrator, step_s: f64) -> f64 {
    let state = &golden["states"][usize::try_from(trajectory["start_state"].as_u64().unwrap()).unwrap()];
    let (world, of_segment) = human(golden, state, &numbers(&trajectory["tau"]));
    let settings = StepSettings { step_s, integrator, ..StepSettings::default() };
    let (mut now, mut workspace, mut findings) =
        (WorldState::new(&world), StepWorkspace::default(), Findings::default());
    let times = numbers(&trajectory["times_s"]);
    let mut error = 0.0_f64;
    let mut steps = 0;
    for (sample, time) in times.iter().enumerate() {
        while (f64::from(steps) + 0.5) * step_s < *time {
            step(&world, &mut now, &settings, &mut workspace, &mut findings).unwrap();
            steps += 1;
        }
        for (segment, body) in of_segment.iter().enumerate() {
            let expected = vector(&trajectory["com"][sample][segment]);
            error = error.max((now.poses[*body].translation - expected).norm());
        }
    }
    assert!(findings.as_slice().is_empty(), "{findings:?}");
    error
}

#[test]
fn one_second_of_motion_equals_mujocos() {
    let golden = golden();
    for trajectory in golden["trajectories"].as_array().unwrap() {
        let error = trajectory_error(&golden, trajectory, Integrator::RungeKutta, 1e-3);
        println!("largest distance from MuJoCo's trajectory `{}`: {error:.1e} m", trajectory["name"]);
        assert!(error < TRAJECTORY_TOLERANCE_M, "{error:e}");
    }
}

#[test]
fn steps_by_impulses_come_nearer_to_mujocos_motion_in_proportion_to_the_step() {
    let golden = golden();
    let trajectory = &golden["trajectories"][1];
    let [coarse, fine] = [1e-3, 5e-4].map(|h| trajectory_error(&golden, trajectory, Integrator::Impulse, h));
    println!("steps by impulses: {coarse:.2e} m at 1 ms, {fine:.2e} m at 0.5 ms");
    // First order: half, give or take what is of second order.
    assert!(fine < 0.6 * coarse && fine > 0.4 * coarse, "{coarse:e} {fine:e}");
}
