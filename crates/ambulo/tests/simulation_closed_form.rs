//! The velocity-level stepper against motions and forces known in closed form, without contacts.
//!
//! The scheme is v⁺ from the forces at x, then x⁺ = x + h v⁺: first order. Where a motion is smooth its error must
//! halve with the step; where the scheme itself has a closed form (constant force, linear spring) it must be met to
//! rounding.

use crate::common::random::Random;
use crate::common::worlds::{
    G, O, Run, add_body, add_closure, add_hinge, add_joint, along, assert_first_order, drive, empty, sine, turned, v,
};
use crate::common::{assert_near, derivatives, turn};
use ambulo::simulation::{JointKind, Motor, Signal, Spring, World, energy, largest_joint_error};
use ambulo::spatial::{Mat3, Pose, Twist, Vec3, Wrench};
use std::f64::consts::{PI, TAU};

/// What sums of a thousand rounded numbers of order one miss, generously.
const ROUNDING: f64 = 1e-11;

// ---- free bodies ----

#[test]
fn a_free_body_falls_by_g_t_in_speed_and_half_g_t_squared_in_height() {
    let fall = |gravity: f64, h: f64| {
        let mut world = World { gravity: v(0.0, -gravity, 0.0), ..empty() };
        let body = add_body(&mut world, 3.0, [0.1, 0.2, 0.3], Pose::IDENTITY);
        world.bodies[body].twist.linear = v(1.0, 2.0, 0.0);
        let mut run = Run::new(world, h);
        run.to(1.0);
        (run.velocity(0) - v(1.0, 2.0 - G, 0.0), run.place(0) - v(1.0, 2.0 - 0.5 * G, 0.0))
    };
    for h in [4e-3, 2e-3, 1e-3] {
        let (speed, place) = fall(G, h);
        assert!(speed.norm() < ROUNDING, "{speed}");
        // Σ h² g k = g t²/2 + g t h/2: the second term is the scheme's own error, exactly.
        assert_near(place.y, -0.5 * G * h, ROUNDING, "height");
        assert!(place.xz().norm() < ROUNDING);
    }
    let (speed, _) = fall(9.8, 1e-3);
    assert!(speed.norm() > 5e-3, "another gravity must show");
}

#[test]
fn a_load_changes_momentum_at_its_own_rate() {
    let r = &mut Random::new(7);
    let mut world = empty();
    let body = add_body(&mut world, 2.0, [0.1, 0.1, 0.1], Pose::IDENTITY);
    let load = Wrench { moment: r.vector(0.1), force: r.vector(5.0) };
    world.bodies[body].load = load;
    let weight = world.gravity * 2.0;
    let mut run = Run::new(world, 1e-3);
    run.to(1.0);
    // A ball-like inertia has no gyroscopic moment: both rates are constant and the scheme sums them exactly.
    assert!((run.velocity(0) * 2.0 - load.force - weight).norm() < ROUNDING);
    assert!((run.spin(0) * 0.1 - load.moment).norm() < ROUNDING);
}

/// Angular momentum after a second of tumbling, without and with a small moment.
fn tumbled(h: f64, moment: Vec3) -> (Vec3, Vec3) {
    let mut world = World { gravity: O, ..empty() };
    let body = add_body(&mut world, 1.0, [0.02, 0.05, 0.06], Pose::IDENTITY);
    world.bodies[body].twist.angular = v(2.0, 3.0, -1.5);
    world.bodies[body].load.moment = moment;
    let mut run = Run::new(world, h);
    let before = run.momentum().1;
    run.to(1.0);
    (before, run.momentum().1)
}

#[test]
fn torque_free_rotation_keeps_angular_momentum_to_first_order() {
    let error = |h: f64| {
        let (before, after) = tumbled(h, O);
        (after - before).norm() / before.norm()
    };
    let errors = assert_first_order(1e-3, error);
    println!("angular momentum lost in 1 s: {errors:?}");
    // One step turns the body by h ω and misses L by at most |L| (h ω)²/2; 1/h steps of ω = 3.9 rad/s add up to 7.6 h.
    assert!(errors[0] < 7.6e-3);
    let (before, after) = tumbled(2.5e-4, v(0.0, 0.01, 0.0));
    assert!((after - before).norm() > 5e-3, "a moment of 0.01 N.m must show");
}

// ---- pendulum and top ----

/// A compound pendulum of 2 kg, its mass centre 0.5 m from the hinge, at this angle.
fn pendulum(angle: f64) -> World {
    let mut world = empty();
    let pose = turned(angle, turn(Vec3::z(), angle) * v(0.0, -0.5, 0.0));
    let bob = add_body(&mut world, 2.0, [0.05, 0.02, 0.03], pose);
    add_hinge(&mut world, bob, None, O, v(0.0, 0.5, 0.0));
    world
}
/// Its moment of inertia about the hinge, and m g l.
const ABOUT_HINGE: f64 = 0.03 + 2.0 * 0.25;
const M_G_L: f64 = 2.0 * G * 0.5;

/// π/2 / agm(1, cos(θ/2)): the complete elliptic integral of modulus sin(θ/2).
fn quarter_period(amplitude: f64) -> f64 {
    let (mut a, mut b) = (1.0, (0.5 * amplitude).cos());
    for _ in 0..8 {
        (a, b) = (0.5 * (a + b), f64::sqrt(a * b));
    }
    PI / 2.0 / a * (ABOUT_HINGE / M_G_L).sqrt()
}

/// When the angle first crosses zero, between steps on a straight line (which misses h²).
fn first_crossing(mut run: Run) -> f64 {
    loop {
        let before = run.q(0, 0);
        run.step();
        let after = run.q(0, 0);
        if after <= 0.0 {
            return run.state.time_s - run.settings.step_s * after / (after - before);
        }
    }
}

#[test]
fn a_pendulum_swings_with_the_period_of_the_elliptic_integral() {
    let amplitude = 1.2;
    let exact = quarter_period(amplitude);
    let found = |h: f64| first_crossing(Run::new(pendulum(amplitude), h));
    let errors = assert_first_order(2e-3, |h| (found(h) - exact).abs());
    println!("quarter period {exact} s, missed by {errors:?}");
    // The first value extrapolated by its halving is of second order: (ω h)² is 6e-5.
    assert_near(2.0 * found(1e-3) - found(2e-3), exact, 6e-5 * exact, "extrapolated quarter period");
    let small = PI / 2.0 * (ABOUT_HINGE / M_G_L).sqrt();
    assert!((found(5e-4) - small).abs() > 0.05 * exact, "the period of small swings must not pass");
}

/// How far the axis of a heavy top is, after 0.5 s of steady precession, from where it should be.
fn precessed(h: f64, sense: f64) -> Vec3 {
    let (mass, l, tilt, precession) = (1.0, 0.05, 0.5_f64, 3.0);
    let (across, axial) = (3e-4, 2e-3);
    // Moments about the pivot: I₃ ω₃ Ω - I₁ Ω² cos θ = m g l.
    let about_pivot = across + mass * l * l;
    let spin = (about_pivot * precession * tilt.cos() + mass * G * l / precession) / axial;
    let mut world = World { gravity: v(0.0, 0.0, -G), ..empty() };
    let rotation = turn(Vec3::y(), tilt);
    let axis: Vec3 = rotation.column(2).into();
    let top = add_body(&mut world, mass, [across, across, axial], Pose { rotation, translation: axis * l });
    let angular = Vec3::z() * precession * sense + axis * (spin - precession * tilt.cos()) * sense;
    world.bodies[top].twist = Twist { angular, linear: angular.cross(&(axis * l)) };
    add_joint(&mut world, JointKind::Ball, top, None, [Pose::IDENTITY, Pose::at(v(0.0, 0.0, -l))]);
    let mut run = Run::new(world, h);
    run.to(0.5);
    let expected = turn(Vec3::z(), precession * 0.5) * axis;
    run.place(0) / l - expected
}

#[test]
fn a_symmetric_top_precesses_steadily() {
    let errors = assert_first_order(4e-4, |h| precessed(h, 1.0).norm());
    println!("axis of the top off by {errors:?}");
    // A step turns the top by h ω₃ = 0.034 rad and misses the angular momentum by (h ω₃)²/2 of it at most; 1250 such
    // steps add up to 0.73. Extrapolated by its halving the error is of second order: the square of the errors at the
    // two steps.
    assert!(errors[0] < 0.73);
    let extrapolated = precessed(1e-4, 1.0) * 2.0 - precessed(2e-4, 1.0);
    println!("extrapolated: {}", extrapolated.norm());
    assert!(extrapolated.norm() < errors[1] * errors[1]);
    assert!(precessed(1e-4, -1.0).norm() > 0.5, "a top that spins the other way precesses the other way");
}

// ---- constraints and free motions of joints ----

/// Constraint error of a child and motion of its free coordinates, both from T = P⁻¹ C.
fn error_and_motion(kind: JointKind, t: &Pose) -> (f64, f64) {
    let (r, p) = (t.rotation, t.translation);
    let tilt = r.column(2).xy().norm();
    let turned = (r - Mat3::identity()).norm();
    match kind {
        JointKind::Weld => (turned.max(p.norm()), f64::INFINITY),
        JointKind::Revolute => (tilt.max(p.norm()), turned),
        JointKind::Prismatic => (turned.max(p.xy().norm()), p.z.abs()),
        // x of P stays across y of C.
        JointKind::Universal => (r[(0, 1)].abs().max(p.norm()), r[(2, 1)].abs().min(r[(0, 2)].abs())),
        JointKind::Ball => (p.norm(), tilt.min(r[(1, 0)].abs())),
        JointKind::Planar => (tilt.max(p.z.abs()), p.xy().abs().min().min(turned)),
        JointKind::Free => (0.0, tilt.min(p.abs().min())),
    }
}

const KINDS: [JointKind; 7] = [
    JointKind::Weld,
    JointKind::Revolute,
    JointKind::Prismatic,
    JointKind::Universal,
    JointKind::Ball,
    JointKind::Planar,
    JointKind::Free,
];

/// Two bodies in the air with a joint between them, and random loads on both.
fn joined(kind: JointKind, closing: bool, r: &mut Random) -> (World, [Pose; 2]) {
    let mut world = empty();
    let frames = [0, 1].map(|_| Pose { rotation: r.rotation(), translation: r.vector(0.3) });
    let parent = Pose { rotation: r.rotation(), translation: r.vector(1.0) };
    let child = parent * frames[0] * frames[1].inverse();
    for pose in [parent, child] {
        let body = add_body(&mut world, r.between(0.5, 2.0), [0.03, 0.04, 0.05], pose);
        world.bodies[body].load = Wrench { moment: r.vector(0.5), force: r.vector(10.0) };
    }
    if closing {
        add_closure(&mut world, kind, 1, Some(0), [frames[1], frames[0]]);
    } else {
        add_joint(&mut world, kind, 1, Some(0), frames);
    }
    (world, frames)
}

fn assert_joint(closing: bool, tolerance: f64) {
    for kind in KINDS {
        for seed in 0..4 {
            let (world, frames) = joined(kind, closing, &mut Random::new(seed));
            let pull: Vec3 = world.bodies.iter().map(|b| b.load.force + world.gravity * b.mass).sum();
            let mut run = Run::new(world, 1e-3);
            run.to(0.3);
            let [parent, child] = [0, 1].map(|b| run.state.poses[b]);
            let t = (parent * frames[0]).inverse() * (child * frames[1]);
            let (held, gone) = error_and_motion(kind, &t);
            assert!(held < tolerance, "{kind:?} (closing: {closing}), seed {seed}: held directions gave by {held:e}");
            assert!(gone > 1e-3, "{kind:?} (closing: {closing}), seed {seed}: free directions moved by {gone:e} only");
            // Whatever acts between the two leaves the sum of momenta to the loads.
            let gained = run.momentum().0 - pull * 0.3;
            assert!(gained.norm() < 1e-8, "{kind:?} (closing: {closing}), seed {seed}: momentum {gained}");
        }
    }
}

#[test]
fn every_kind_of_tree_joint_has_its_constraints_and_free_motions() {
    // Children are seated by their coordinates: only rounding of the poses, 1e-15, remains.
    assert_joint(false, 1e-12);
}

#[test]
fn whatever_turns_inside_a_tree_its_mass_centre_flies_freely() {
    let missed = |kind: JointKind, pull: Vec3| {
        let r = &mut Random::new(7);
        let (mut world, _) = joined(kind, false, r);
        for body in &mut world.bodies {
            body.twist = Twist { angular: r.vector(8.0), linear: r.vector(2.0) };
            body.load = Wrench { moment: r.vector(0.5), force: pull };
        }
        let mass: f64 = world.bodies.iter().map(|b| b.mass).sum();
        let center = |poses: &[Pose]| -> Vec3 {
            world.bodies.iter().zip(poses).map(|(body, pose)| pose.translation * body.mass).sum::<Vec3>() / mass
        };
        let start: Vec<Pose> = world.bodies.iter().map(|b| b.pose).collect();
        let velocity = world.bodies.iter().map(|b| b.twist.linear * b.mass).sum::<Vec3>() / mass;
        let (h, t) = (1e-3, 0.3);
        let mut run = Run::new(world.clone(), h);
        run.to(t);
        let expected = center(&start) + velocity * t - v(0.0, 0.5 * G * t * (t + h), 0.0);
        (center(&run.state.poses) - expected).norm()
    };
    for kind in KINDS {
        let missed = missed(kind, O);
        assert!(missed < ROUNDING, "{kind:?}: {missed:e}");
    }
    assert!(missed(JointKind::Ball, v(0.0, 0.0, 1e-3)) > 1e-6, "a force of 1 mN must show");
}

#[test]
fn joints_stay_closed_however_fast_bodies_turn() {
    for kind in KINDS {
        let r = &mut Random::new(3);
        let (mut world, _) = joined(kind, false, r);
        for body in &mut world.bodies {
            body.twist.angular = r.vector(300.0);
        }
        let mut run = Run::new(world, 1e-3);
        run.to(0.1);
        let error = largest_joint_error(&run.world, &run.state);
        assert!(error < 1e-12, "{kind:?}: {error:e}");
    }
}

#[test]
fn every_kind_of_closure_has_its_constraints_and_free_motions() {
    // A step turns bodies by h ω < 0.03 rad and leaves (h ω)² r/2 of drift, of which the linearised projection leaves
    // the square again: 2e-7.
    assert_joint(true, 2e-7);
}

#[test]
fn a_driven_joint_of_every_kind_follows_its_signals() {
    for kind in KINDS {
        let (mut world, frames) = joined(kind, false, &mut Random::new(11));
        let signal = |k: usize| sine(0.3 + 0.05 * k as f64, 0.8 + 0.3 * k as f64, 0.0, 0.0);
        for k in 0..kind.freedom() {
            drive(&mut world, 0, k, signal(k));
        }
        let mut run = Run::new(world, 1e-3);
        let mut worst = 0.0_f64;
        run.watch(0.5, |run| {
            let [parent, child] = [0, 1].map(|b| run.state.poses[b]);
            let t = (parent * frames[0]).inverse() * (child * frames[1]);
            let q: Vec<f64> = (0..kind.freedom()).map(|k| signal(k).at(run.state.time_s)[0]).collect();
            let seat = placed(kind, &q);
            worst = worst.max((t.rotation - seat.rotation).norm()).max((t.translation - seat.translation).norm());
        });
        println!("{kind:?} driven: off by {worst:e}");
        assert!(worst < 1e-12, "{kind:?}: {worst:e}");
    }
}

#[test]
fn rotation_vectors_of_driven_balls_grow_beyond_half_a_turn() {
    for kind in [JointKind::Ball, JointKind::Free] {
        let (mut world, _) = joined(kind, false, &mut Random::new(5));
        for k in 0..3 {
            let stops = vec![(0.0, 0.0), (1.0, [1.5, -2.5, 2.0][k])];
            drive(&mut world, 0, k, Signal::Stops(stops));
        }
        let mut run = Run::new(world, 1e-3);
        run.to(1.0);
        // |(1.5, -2.5, 2)| = 3.5 rad, more than half a turn.
        let q = v(run.q(0, 0), run.q(0, 1), run.q(0, 2));
        assert!((q - v(1.5, -2.5, 2.0)).norm() < 1e-9, "{kind:?}: {q}");
        assert!(run.findings.as_slice().is_empty());
    }
}

/// T of coordinates as in the documentation of the joints.
fn placed(kind: JointKind, q: &[f64]) -> Pose {
    let vector = |w: Vec3| if w.norm() > 0.0 { turn(w, w.norm()) } else { Mat3::identity() };
    let at = |rotation: Mat3, translation: Vec3| Pose { rotation, translation };
    match kind {
        JointKind::Weld => Pose::IDENTITY,
        JointKind::Revolute => at(turn(Vec3::z(), q[0]), O),
        JointKind::Prismatic => Pose::at(v(0.0, 0.0, q[0])),
        JointKind::Universal => at(turn(Vec3::x(), q[0]) * turn(Vec3::y(), q[1]), O),
        JointKind::Ball => at(vector(v(q[0], q[1], q[2])), O),
        JointKind::Planar => at(turn(Vec3::z(), q[2]), v(q[0], q[1], 0.0)),
        JointKind::Free => at(vector(v(q[0], q[1], q[2])), v(q[3], q[4], q[5])),
    }
}

// ---- what acts on coordinates ----

/// A mass of 2 kg on a level slide, pulled along it.
fn slider(pull: f64) -> World {
    let mut world = empty();
    let body = add_body(&mut world, 2.0, [0.1; 3], Pose::IDENTITY);
    let frame = along(Vec3::x(), O);
    add_joint(&mut world, JointKind::Prismatic, body, None, [frame, frame]);
    world.bodies[body].load.force = v(pull, 0.0, 0.0);
    world
}

#[test]
fn a_limit_stops_and_then_bears_the_load() {
    let mut world = slider(3.0);
    world.joints[0].coordinates[0].limits = (Some(-0.1), Some(0.2));
    let mut run = Run::new(world, 1e-3);
    let mut furthest = f64::NEG_INFINITY;
    run.watch(1.0, |run| furthest = furthest.max(run.q(0, 0)));
    // The row asks q + h q̇ ≤ limit: met to the solver's 1e-10 of the step's motion.
    assert_near(furthest, 0.2, 1e-12, "furthest");
    assert!(run.velocity(0).norm() < 1e-9);
    assert_near(run.forces().efforts[0][0], -3.0, 3e-9, "force of the upper limit");
    run.world.bodies[0].load.force = v(-3.0, 0.0, 0.0);
    run.to(2.0);
    assert_near(run.q(0, 0), -0.1, 1e-12, "at the lower limit");
    assert_near(run.forces().efforts[0][0], 3.0, 3e-9, "force of the lower limit");
    run.world.joints[0].coordinates[0].limits = (None, None);
    run.to(2.1);
    assert!(run.q(0, 0) < -0.1 - 5e-3, "without limits it must go on");
}

#[test]
fn a_body_that_rests_on_a_limit_does_not_creep_through_it() {
    // The other limit is far: neither its distance may loosen the solver, nor what the solver leaves add up.
    let mut world = slider(3.0);
    world.joints[0].coordinates[0].limits = (Some(-1000.0), Some(0.0));
    let mut run = Run::new(world, 1e-3);
    run.to(10.0);
    println!("beyond the limit by {:e} m", run.q(0, 0));
    // A step ends at the limit to the solver's 1e-10 of g h² = 1e-5 m.
    assert!(run.q(0, 0).abs() < 1e-12, "{:e}", run.q(0, 0));
}

#[test]
fn a_spring_oscillates_with_its_period() {
    let (mass, k, start) = (2.0, 50.0, 0.3);
    let omega = f64::sqrt(k / mass);
    let swing = |h: f64| {
        let mut world = slider(0.0);
        world.bodies[0].pose.translation.x = start;
        world.joints[0].coordinates[0].spring = Some(Spring { stiffness: k, damping: 0.0, rest: 0.1 });
        let mut run = Run::new(world, h);
        let mut worst = 0.0_f64;
        run.watch(TAU / omega, |run| {
            let exact = 0.1 + (start - 0.1) * (omega * run.state.time_s).cos();
            worst = worst.max((run.q(0, 0) - exact).abs());
        });
        // Implicit Euler in closed form: each step multiplies the complex amplitude by 1/(1 - i ω h).
        let n = run.state.time_s / h;
        let amplitude = (1.0 + (omega * h).powi(2)).powf(-0.5 * n);
        let phase = n * (omega * h).atan();
        assert_near(run.q(0, 0), 0.1 + (start - 0.1) * amplitude * phase.cos(), 1e-10, "implicit Euler");
        worst
    };
    let errors = assert_first_order(2e-3, swing);
    println!("spring off by {errors:?} m of {} m", start - 0.1);
}

#[test]
fn a_damper_takes_speed_at_its_rate() {
    let mut world = slider(0.0);
    world.bodies[0].twist.linear.x = 1.0;
    world.joints[0].coordinates[0].spring = Some(Spring { stiffness: 0.0, damping: 4.0, rest: 0.0 });
    let mut run = Run::new(world, 1e-3);
    run.to(0.5);
    // m v̇ = -d v, each step divides by 1 + h d/m.
    assert_near(run.velocity(0).x, 1.002_f64.powi(-500), ROUNDING, "speed");
    assert_near(run.velocity(0).x, (-1.0_f64).exp(), 1e-3, "e^(-d t/m), first order in h d/m t = 1e-3");
}

#[test]
fn a_motor_saturates_far_from_its_target_and_yields_by_load_over_gain_near_it() {
    let mut world = slider(0.0);
    let motor = Motor { target: Signal::Constant(1.0), kp: 400.0, kd: 60.0, max: 5.0 };
    world.joints[0].coordinates[0].motor = Some(motor);
    let mut run = Run::new(world, 1e-3);
    run.to(0.2);
    // It wants 400 N and has 5: a = 5/2 exactly.
    assert_near(run.velocity(0).x, 0.2 * 2.5, 1e-9, "speed at full force");
    assert_near(run.forces().efforts[0][0], 5.0, 1e-8, "full force");
    run.to(6.0);
    run.world.bodies[0].load.force.x = -2.0;
    run.to(12.0);
    // At rest kp (target - q) = load; the slowest pole, (60 - sqrt(60² - 4·2·400))/4 = 10/s, has long decayed.
    assert_near(run.q(0, 0), 1.0 - 2.0 / 400.0, 1e-9, "offset under load");
}

#[test]
fn dry_friction_holds_and_then_slips() {
    let pulled = |pull: f64| {
        let mut world = slider(pull);
        world.joints[0].coordinates[0].friction = 4.0;
        let mut run = Run::new(world, 1e-3);
        run.to(1.0);
        (run.velocity(0).x, run.q(0, 0), run.forces().efforts[0][0])
    };
    let (speed, gone, force) = pulled(3.9);
    assert!(speed.abs() < 1e-9 && gone.abs() < 1e-9, "held at {speed:e}");
    assert_near(force, -3.9, 1e-8, "friction at rest");
    let (speed, gone, force) = pulled(5.0);
    // Constant a = (5 - 4)/2, exact in speed.
    assert_near(speed, 0.5, 1e-9, "speed in slip");
    assert!(gone > 0.2);
    assert_near(force, -4.0, 1e-8, "friction in slip");
}

#[test]
fn a_rotor_adds_to_the_mass_of_its_coordinate() {
    let speed = |rotor: f64| {
        let mut world = slider(3.0);
        world.joints[0].coordinates[0].rotor = rotor;
        let mut run = Run::new(world, 1e-3);
        run.to(1.0);
        run.velocity(0).x
    };
    assert_near(speed(4.0), 3.0 / (2.0 + 4.0), ROUNDING, "speed with a rotor");
    assert_near(speed(0.0), 3.0 / 2.0, ROUNDING, "speed without");
}

// ---- drives and their efforts ----

#[test]
fn a_driven_pendulum_tracks_its_sine_exactly_with_the_effort_of_inverse_dynamics() {
    let signal = sine(0.7, 0.9, 0.3, 0.2);
    let worst = |h: f64, mgl: f64| {
        let mut world = pendulum(signal.at(0.0)[0]);
        drive(&mut world, 0, 0, signal.clone());
        let mut run = Run::new(world, h);
        let (mut off, mut effort) = (0.0_f64, 0.0_f64);
        // The first step jumps to the signal's speed.
        run.to(0.1).watch(1.0, |run| {
            let [q, _, qdd] = signal.at(run.state.time_s);
            let place = turn(Vec3::z(), q) * v(0.0, -0.5, 0.0);
            off = off.max((run.q(0, 0) - q).abs()).max((run.place(0) - place).norm());
            let expected = ABOUT_HINGE * qdd + mgl * q.sin();
            effort = effort.max((run.forces().efforts[0][0] - expected).abs());
        });
        assert!(off < 1e-12, "off the signal by {off:e}");
        effort
    };
    let errors = assert_first_order(2e-3, |h| worst(h, M_G_L));
    println!("effort of the driven pendulum off by {errors:?} N.m");
    // d/dt of the effort is at most (I ω² + m g l) A ω = 107 N.m/s; the time of a step is uncertain by at most h.
    assert!(errors[0] < 0.22);
    assert!(worst(5e-4, -M_G_L) > 1.0, "gravity of the wrong sign must show");
}

/// A four-bar linkage in the plane: crank on A = 0, rocker on D, coupler between them; bars uniform, of 3 kg/m.
struct FourBar {
    d: f64,
    lengths: [f64; 3],
}

impl FourBar {
    const IT: FourBar = FourBar { d: 0.5, lengths: [0.2, 0.5, 0.4] };

    fn mass(&self, bar: usize) -> f64 {
        3.0 * self.lengths[bar]
    }

    fn inertia(&self, bar: usize) -> f64 {
        self.mass(bar) * self.lengths[bar].powi(2) / 12.0
    }

    /// Middle and angle of crank, coupler and rocker at a crank angle: C is where the two circles meet above.
    fn places(&self, crank: f64) -> [(Vec3, f64); 3] {
        let [a, b, c] = self.lengths;
        let joint = v(a * crank.cos(), a * crank.sin(), 0.0);
        let foot = v(self.d, 0.0, 0.0);
        let base = foot - joint;
        let r = base.norm();
        let along = (b * b - c * c + r * r) / (2.0 * r);
        let across = (b * b - along * along).sqrt();
        let e = base / r;
        let meet = joint + e * along + v(-e.y, e.x, 0.0) * across;
        let bar = |from: Vec3, to: Vec3| ((from + to) / 2.0, f64::atan2(to.y - from.y, to.x - from.x));
        [bar(O, joint), bar(joint, meet), bar(foot, meet)]
    }

    fn world(&self, crank: f64) -> World {
        let mut world = empty();
        for (bar, (middle, angle)) in self.places(crank).into_iter().enumerate() {
            let i = self.inertia(bar);
            add_body(&mut world, self.mass(bar), [i, i, i], turned(angle, middle));
        }
        let [a, b, c] = self.lengths.map(|l| v(l / 2.0, 0.0, 0.0));
        // The coordinate of the hinge to ground is the angle of the crank itself.
        add_hinge(&mut world, 0, None, O, -a);
        add_hinge(&mut world, 1, Some(0), a, -b);
        add_hinge(&mut world, 2, None, v(self.d, 0.0, 0.0), -c);
        add_closure(&mut world, JointKind::Revolute, 1, Some(2), [Pose::at(b), Pose::at(c)]);
        world
    }

    /// Energy at an instant of a crank angle given as a function of time, from geometry.
    fn energy(&self, crank: &impl Fn(f64) -> f64, gravity: f64, t: f64) -> f64 {
        let flat = |t: f64| self.places(crank(t)).iter().flat_map(|(m, a)| [m.x, m.y, *a]).collect::<Vec<f64>>();
        let (x, (rates, _)) = (flat(t), derivatives(flat, t, 1e-3, 1e-15));
        (0..3)
            .map(|bar| {
                let [vx, vy, w] = [0, 1, 2].map(|k| rates[3 * bar + k]);
                let lift = self.mass(bar) * gravity * x[3 * bar + 1];
                lift + 0.5 * self.mass(bar) * (vx * vx + vy * vy) + 0.5 * self.inertia(bar) * w * w
            })
            .sum()
    }
}

#[test]
fn the_drive_of_a_four_bar_linkage_does_the_work_that_its_energy_needs() {
    let signal = sine(0.6, 0.5, 0.0, 1.2);
    let crank = |t: f64| signal.at(t)[0];
    let worst = |h: f64, gravity: f64| {
        let mut world = FourBar::IT.world(crank(0.0));
        drive(&mut world, 0, 0, signal.clone());
        let mut run = Run::new(world, h);
        let (mut off, mut effort) = (0.0_f64, 0.0_f64);
        run.to(0.05).watch(0.35, |run| {
            let t = run.state.time_s;
            for (body, (middle, _)) in FourBar::IT.places(crank(t)).iter().enumerate() {
                off = off.max((run.place(body) - middle).norm());
            }
            // τ q̇ = dE/dt.
            let (power, _) = derivatives(|t| vec![FourBar::IT.energy(&crank, gravity, t)], t, 2e-3, 1e-12);
            effort = effort.max((run.forces().efforts[0][0] - power[0] / signal.at(t)[1]).abs());
        });
        assert!(run.findings.as_slice().is_empty(), "{:?}", run.findings);
        (off, effort)
    };
    let errors = assert_first_order(2e-3, |h| worst(h, G).1);
    let (off, _) = worst(5e-4, G);
    println!("four-bar: places off by {off:e} m, effort by {errors:?} N.m");
    // Bars turn by h ω < 1e-3 rad a step: drift (h ω)² l/2 = 2.5e-7 m before projection, its square over l after.
    assert!(off < 1e-9);
    println!("without gravity the effort differs by {} N.m", worst(5e-4, 0.0).1);
    assert!(worst(5e-4, 0.0).1 > 50.0 * errors[2], "without gravity the work must differ");
}

// ---- rows that come and go ----

#[test]
fn a_body_let_go_by_its_closure_or_joint_flies_on_ballistically() {
    for closing in [false, true] {
        let mut world = pendulum(1.0);
        world.bodies[0].inertia = Mat3::identity() * 0.03;
        if closing {
            world.joints.clear();
            add_closure(&mut world, JointKind::Revolute, 0, None, [Pose::at(v(0.0, 0.5, 0.0)), Pose::IDENTITY]);
        }
        let mut run = Run::new(world, 1e-3);
        run.to(0.4);
        assert!(run.velocity(0).norm() > 1.0);
        assert!(largest_joint_error(&run.world, &run.state) < 1e-9);
        if closing {
            run.world.closures[0].active = false;
        } else {
            run.world.joints.clear();
            run.state.coordinates.clear();
        }
        let (velocity, spin) = (run.velocity(0), run.spin(0));
        run.to(0.7);
        assert!((run.velocity(0) - velocity - v(0.0, -G * 0.3, 0.0)).norm() < ROUNDING);
        assert!((run.spin(0) - spin).norm() < ROUNDING);
    }
}

#[test]
fn a_closure_taken_up_in_flight_keeps_momentum_and_holds() {
    let mut world = World { gravity: O, ..empty() };
    for x in [-0.5, 0.5] {
        let body = add_body(&mut world, 1.0, [0.02; 3], Pose::at(v(x, 0.0, 0.0)));
        world.bodies[body].twist.linear = v(-x, x, 0.2);
    }
    let frames = [v(0.5, 0.0, 0.0), v(-0.5, 0.0, 0.0)].map(Pose::at);
    add_closure(&mut world, JointKind::Ball, 0, Some(1), frames);
    world.closures[0].active = false;
    let mut run = Run::new(world, 1e-3);
    run.to(0.01);
    let (before, gap) = (run.momentum(), (run.place(1) - run.place(0)).norm() - 1.0);
    assert!(gap < -5e-3, "nothing must hold yet");
    run.world.closures[0].active = true;
    run.to(0.5);
    let after = run.momentum();
    assert!((after.0 - before.0).norm() < ROUNDING);
    // Pulling together 1e-2 m moves the bodies without momentum: L changes by p x 5e-3 at most; then first order, as a
    // joint's force acts along the step's start.
    assert!((after.1 - before.1).norm() < 1e-2, "{} {}", after.1, before.1);
    let error = largest_joint_error(&run.world, &run.state);
    println!("closure taken up in flight: off by {error:e} m");
    // ω = 1 rad/s: the square of (h ω)²/2.
    assert!(error < 1e-9);
    assert!(energy(&run.world, &run.state).kinetic < 0.6);
}
