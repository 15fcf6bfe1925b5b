//! Steps by the midpoint rule: energy, order, and the laws of contact and friction.

use crate::common::turn;
use crate::common::worlds::{
    G, O, Run, add_ball, add_body, add_box, add_closure, add_floor, add_hinge, add_joint, along, drive, empty,
    of_material, of_rigid, sine, turned, v,
};
use ambulo::simulation::{
    ContactLaw, Integrator, JointKind, Material, Motor, Signal, Spring, World, energy, largest_joint_error,
};
use ambulo::spatial::{Pose, Twist, Vec3};

fn midpoint(world: World, step_s: f64) -> Run {
    let mut run = Run::new(world, step_s);
    run.settings.integrator = Integrator::Midpoint;
    run
}

/// A chain of links of 0.2 m and 1 kg, level, joined to each other and to the world.
fn chain(count: usize, kind: JointKind) -> World {
    let mut world = empty();
    for i in 0..count {
        let body = add_body(&mut world, 1.0, [0.002, 0.004, 0.005], Pose::at(v(0.2 * i as f64 + 0.1, 0.0, 0.0)));
        let before = i.checked_sub(1);
        let at = if before.is_some() { v(0.1, 0.0, 0.0) } else { O };
        add_joint(&mut world, kind, body, before, [Pose::at(at), Pose::at(v(-0.1, 0.0, 0.0))]);
    }
    world
}

/// Largest change of the energy [J] until a time [s], and the largest kinetic energy [J].
fn drift(run: &mut Run, time_s: f64) -> [f64; 2] {
    let start = energy(&run.world, &run.state).total();
    let (mut drift, mut kinetic) = (0.0_f64, 0.0_f64);
    run.watch(time_s, |run| {
        let now = energy(&run.world, &run.state);
        kinetic = kinetic.max(now.kinetic);
        drift = drift.max((now.total() - start).abs());
    });
    [drift, kinetic]
}

/// Asserts that the distance of an end from the one with a small step falls to a quarter as the step does to half.
#[track_caller]
fn assert_second_order(end: impl Fn(u32) -> Vec3, steps: u32) {
    let best = end(64 * steps);
    let errors = [1, 2, 4].map(|finer| (end(finer * steps) - best).norm());
    println!("{errors:?} off with {steps}, {}, {} steps", 2 * steps, 4 * steps);
    for pair in errors.windows(2) {
        assert!((3.7..4.3).contains(&(pair[0] / pair[1])), "{errors:?}");
    }
}

#[test]
fn a_whipping_chain_of_twenty_links_keeps_its_energy_to_a_thousandth() {
    for kind in [JointKind::Revolute, JointKind::Ball] {
        let mut run = midpoint(chain(20, kind), 1e-3);
        let [drift, kinetic] = drift(&mut run, 10.0);
        let open = largest_joint_error(&run.world, &run.state);
        println!("{kind:?}, 10 s at 1 ms: energy off by {drift:.1e} J of {kinetic:.0} J, joints open by {open:.1e} m");
        assert!(drift < 1e-3 * kinetic && open < 1e-12, "{drift} of {kinetic}");
    }
    // What the comparison would not notice if it were weaker: steps of impulses.
    let mut run = Run::new(chain(20, JointKind::Revolute), 1e-3);
    let [drift, kinetic] = drift(&mut run, 1.0);
    assert!(drift > 1e-3 * kinetic, "{drift} of {kinetic}");
}

#[test]
fn pendulums_in_the_plane_and_in_space_converge_at_second_order() {
    let in_plane = |steps: u32| {
        let mut run = midpoint(chain(2, JointKind::Revolute), 0.5 / f64::from(steps));
        run.to(0.5).place(1)
    };
    assert_second_order(in_plane, 50);
    let in_space = |steps: u32| {
        let mut world = chain(3, JointKind::Ball);
        let spin = v(10.0, 3.0, -4.0);
        world.bodies[2].twist = Twist { angular: spin, linear: spin.cross(&v(0.1, 0.0, 0.0)) };
        let mut run = midpoint(world, 0.5 / f64::from(steps));
        run.to(0.5).place(2)
    };
    assert_second_order(in_space, 50);
}

/// A body alone that tumbles about its middle axis of inertia, without gravity.
fn tumbling(spin: f64) -> Run {
    let mut world = World { gravity: O, ..empty() };
    add_body(&mut world, 1.0, [0.01, 0.02, 0.03], Pose::IDENTITY);
    world.bodies[0].twist = Twist { angular: v(0.1, spin, 0.1), linear: O };
    midpoint(world, 1e-3)
}

#[test]
fn a_tumbling_body_keeps_energy_and_angular_momentum() {
    let mut run = tumbling(20.0);
    let start = run.momentum().1;
    let [drift, kinetic] = drift(&mut run, 10.0);
    let turned = (run.momentum().1 - start).norm() / start.norm();
    println!("tumbling: energy off by {drift:.1e} J of {kinetic:.1} J, angular momentum by a share of {turned:.1e}");
    // (h ω)² of a step is 4e-4; energy is kept to the error of the second solution, (h ω)⁴.
    assert!(drift < 1e-8 * kinetic && turned < 4e-4, "{drift} {turned}");
}

#[test]
fn a_spin_too_fast_for_the_step_keeps_its_energy() {
    for spin in [450.0, 3000.0, 20_000.0] {
        let mut run = tumbling(spin);
        let start = energy(&run.world, &run.state).kinetic;
        run.watch(5.0, |run| {
            let now = energy(&run.world, &run.state).kinetic;
            assert!((now / start - 1.0).abs() < 1e-9, "{spin} rad/s: {now} J of {start} J");
        });
    }
}

#[test]
fn a_closed_loop_keeps_its_energy_and_stays_closed() {
    // Two arms of 0.2 m hang from a beam 0.3 m apart, joined by a bar, let go at 45 degrees.
    let mut world = empty();
    let slant = turned(-std::f64::consts::FRAC_PI_4, O);
    let along_arm = |at: Vec3, share: f64| Pose { translation: at + slant.rotation * v(share, 0.0, 0.0), ..slant };
    let rod = [0.001, 0.004, 0.004];
    let arms = [O, v(0.3, 0.0, 0.0)].map(|pivot| add_body(&mut world, 1.0, rod, along_arm(pivot, 0.1)));
    let bar = add_body(&mut world, 0.5, rod, Pose::at(along_arm(O, 0.2).translation + v(0.15, 0.0, 0.0)));
    for (arm, pivot) in arms.into_iter().zip([O, v(0.3, 0.0, 0.0)]) {
        add_hinge(&mut world, arm, None, pivot, v(-0.1, 0.0, 0.0));
    }
    add_hinge(&mut world, bar, Some(arms[0]), v(0.1, 0.0, 0.0), v(-0.15, 0.0, 0.0));
    let ends = [v(0.15, 0.0, 0.0), v(0.1, 0.0, 0.0)].map(Pose::at);
    add_closure(&mut world, JointKind::Ball, bar, Some(arms[1]), ends);
    let mut run = midpoint(world, 1e-3);
    let [drift, kinetic] = drift(&mut run, 10.0);
    let open = largest_joint_error(&run.world, &run.state);
    println!("four-bar, 10 s: open by {open:.1e} m, energy off by {drift:.1e} J of {kinetic:.2} J");
    assert!(open < 1e-9 && drift < 1e-4 * kinetic, "{open} {drift}");
}

/// A mass of 2 kg on a vertical slide.
fn on_slide(speed: f64) -> World {
    let mut world = empty();
    let body = add_body(&mut world, 2.0, [0.1; 3], Pose::IDENTITY);
    world.bodies[body].twist.linear = v(0.0, speed, 0.0);
    let frame = along(Vec3::y(), O);
    add_joint(&mut world, JointKind::Prismatic, body, None, [frame, frame]);
    world
}

#[test]
fn a_spring_keeps_its_energy_and_a_damper_takes_what_the_rule_says() {
    let (stiffness, damping, mass, h) = (2e4, 30.0, 2.0, 1e-3);
    let mut world = on_slide(1.0);
    world.joints[0].coordinates[0].spring = Some(Spring { stiffness, damping: 0.0, rest: 0.0 });
    let mut run = midpoint(world, h);
    let [drift, kinetic] = drift(&mut run, 10.0);
    println!("spring of 100 rad/s, 10 s at 1 ms: energy off by {drift:.1e} J of {kinetic:.2} J");
    assert!(drift < 1e-10 * kinetic, "{drift}");
    let mut world = World { gravity: O, ..on_slide(1.0) };
    world.joints[0].coordinates[0].spring = Some(Spring { stiffness: 0.0, damping, rest: 0.0 });
    let mut run = midpoint(world, h);
    let a = 0.5 * h * damping / mass;
    run.to(0.1);
    assert!((run.velocity(0).y - ((1.0 - a) / (1.0 + a)).powi(100)).abs() < 1e-12);
}

#[test]
fn a_limit_stops_a_fall_and_then_bears_the_weight() {
    let mut world = on_slide(0.0);
    world.joints[0].coordinates[0].limits = (Some(-0.1), None);
    let mut run = midpoint(world, 1e-3);
    let mut lowest = 0.0_f64;
    run.watch(1.0, |run| lowest = lowest.min(run.q(0, 0)));
    // The last step before the limit may go beyond it by a quarter of its length.
    assert!(lowest > -0.1 - 0.25 * 1e-3 * (2.0 * G * 0.1_f64).sqrt(), "{lowest}");
    assert!((run.q(0, 0) + 0.1).abs() < 1e-9 && run.velocity(0).norm() < 1e-9, "{}", run.q(0, 0));
    assert!((run.forces().efforts[0][0] - 2.0 * G).abs() < 1e-8, "{:?}", run.forces().efforts);
}

#[test]
fn dry_friction_of_a_coordinate_stops_a_slide_where_it_should() {
    // 2 kg at 1 m/s against 4 N: at rest after 0.5 s and v² m / (2 F) = 0.25 m.
    let mut world = World { gravity: O, ..on_slide(1.0) };
    world.joints[0].coordinates[0].friction = 4.0;
    let mut run = midpoint(world, 1e-3);
    run.to(0.25);
    assert!((run.q(0, 0) - 0.1875).abs() < 1e-9 && (run.velocity(0).y - 0.5).abs() < 1e-9, "{}", run.q(0, 0));
    assert!((run.forces().efforts[0][0] + 4.0).abs() < 1e-9, "friction acts against the motion");
    run.to(1.0);
    assert!((run.q(0, 0) - 0.25).abs() < 1e-9 && run.velocity(0).norm() < 1e-9, "{}", run.q(0, 0));
}

#[test]
fn a_motor_swings_as_the_spring_and_damper_that_it_is() {
    let (kp, kd) = (800.0, 5.0);
    let mut by_spring = World { gravity: O, ..on_slide(1.0) };
    let mut by_motor = by_spring.clone();
    by_spring.joints[0].coordinates[0].spring = Some(Spring { stiffness: kp, damping: kd, rest: 0.0 });
    let target = Signal::Constant(0.0);
    by_motor.joints[0].coordinates[0].motor = Some(Motor { target, kp, kd, max: 1e6 });
    let (mut spring, mut motor) = (midpoint(by_spring, 1e-3), midpoint(by_motor, 1e-3));
    spring.to(0.3);
    motor.to(0.3);
    assert!(spring.q(0, 0).abs() > 1e-3 && (spring.q(0, 0) - motor.q(0, 0)).abs() < 1e-9, "{}", motor.q(0, 0));
}

fn block_on_slope(angle: f64, friction: f64) -> Run {
    let mut world = of_rigid(friction, 0.0);
    add_floor(&mut world, turned(angle, O));
    let up = turn(Vec3::z(), angle) * v(0.0, 0.1, 0.0);
    add_box(&mut world, 2.0, Vec3::repeat(0.1), turned(angle, up));
    midpoint(world, 1e-3)
}

#[test]
fn a_block_sticks_or_slides_exactly_as_coulomb_says() {
    for angle in [0.1_f64, 0.45] {
        let mut run = block_on_slope(angle, 0.5);
        let start = run.place(0);
        run.to(10.0);
        assert!((run.place(0) - start).norm() < 1e-9, "{angle} rad: {}", (run.place(0) - start).norm());
    }
    let mut run = block_on_slope(0.7, 0.5);
    let start = run.place(0);
    run.to(1.0);
    let acceleration = G * (0.7_f64.sin() - 0.5 * 0.7_f64.cos());
    // Second order: a constant acceleration is exact.
    assert!(((run.place(0) - start).norm() - 0.5 * acceleration).abs() < 1e-8);
    let contacts = run.forces().contacts;
    let weight = 2.0 * G * 0.7_f64.cos();
    assert!((contacts.iter().map(|c| c.normal_force).sum::<f64>() - weight).abs() < 1e-8 * weight);
    for contact in contacts {
        let along = contact.force - contact.normal * contact.normal_force;
        let opposite = along + contact.slip.normalize() * 0.5 * contact.normal_force;
        assert!(opposite.norm() < 1e-8 * weight, "{opposite}");
        assert!((contact.slip.norm() - acceleration).abs() < 1e-8, "the slip is that of the end of the step");
    }
}

/// Heights [m] of the first bounces of a ball that falls from 1 m, and its lowest height.
fn bounces(restitution: f64, step_s: f64) -> (Vec<f64>, f64) {
    let mut world = of_rigid(0.5, restitution);
    add_floor(&mut world, Pose::IDENTITY);
    add_ball(&mut world, 1.0, 0.1, v(0.0, 1.1, 0.0));
    let mut run = midpoint(world, step_s);
    let (mut tops, mut before, mut lowest) = (Vec::new(), 0.0, 1.0_f64);
    run.watch(3.0, |run| {
        let speed = run.velocity(0).y;
        if before > 0.0 && speed <= 0.0 {
            tops.push(run.place(0).y - 0.1);
        }
        (before, lowest) = (speed, lowest.min(run.place(0).y - 0.1));
    });
    if restitution == 0.0 {
        assert!((run.place(0).y - 0.1).abs() < 1e-9 && run.velocity(0).norm() < 1e-9);
    }
    (tops, lowest)
}

#[test]
fn a_ball_bounces_with_its_restitution_and_rests_without() {
    let speed = (2.0 * G).sqrt();
    for (restitution, step_s) in [(0.8_f64, 1e-3), (0.8, 1e-4), (1.0, 1e-3), (0.0, 1e-3)] {
        let (tops, lowest) = bounces(restitution, step_s);
        println!("restitution {restitution}, {step_s} s: {tops:?} m, lowest {lowest:.1e} m");
        assert_eq!(tops.is_empty(), restitution == 0.0);
        for (bounce, top) in tops.iter().enumerate() {
            let expected = restitution.powi(2 * (bounce as i32 + 1));
            // The instant of the impact is known to a step.
            assert!((top - expected).abs() < 2.0 * step_s, "{bounce}: {top} for {expected}");
        }
        assert!(lowest > -speed * step_s, "{lowest}");
    }
}

#[test]
fn a_floor_of_springs_throws_a_ball_back_as_high_as_it_fell_from() {
    let law = ContactLaw::Regularised { stiffness: 2e4, damping: 0.0 };
    let mut world = of_material(Material { law, friction: 0.0, restitution: 0.0 });
    add_floor(&mut world, Pose::IDENTITY);
    add_ball(&mut world, 1.0, 0.125, v(0.0, 0.325, 0.0));
    let mut run = midpoint(world, 1e-4);
    run.to(5.0);
    let mut top = 0.0_f64;
    run.watch(6.0, |run| top = top.max(run.place(0).y - 0.125));
    println!("after 5 s of bounces on springs: {top} of 0.2 m");
    assert!((top - 0.2).abs() < 1e-3, "{top}");
}

#[test]
fn a_loop_that_an_event_closes_in_flight_is_closed_by_an_impulse() {
    let mut world = World { gravity: O, ..empty() };
    for x in [-0.5, 0.5] {
        add_body(&mut world, 1.0, [0.01; 3], Pose::at(v(x, 0.0, 0.0)));
    }
    world.bodies[0].twist.linear = v(0.0, 1.0, 0.0);
    add_closure(&mut world, JointKind::Weld, 0, Some(1), [v(0.5, 0.0, 0.0), v(-0.5, 0.0, 0.0)].map(Pose::at));
    let mut run = midpoint(world, 1e-3);
    run.watch(0.5, |run| assert!((run.spin(0) - run.spin(1)).norm() < 1e-4, "{} {}", run.spin(0), run.spin(1)));
    let (momentum, _) = run.momentum();
    assert!((momentum - v(0.0, 1.0, 0.0)).norm() < 1e-9, "{momentum}");
}

#[test]
fn driven_worlds_take_steps_of_impulses() {
    let mut world = chain(1, JointKind::Revolute);
    drive(&mut world, 0, 0, sine(0.5, 1.0, 0.0, 0.0));
    let (mut by_rule, mut by_impulses) = (midpoint(world.clone(), 1e-3), Run::new(world, 1e-3));
    assert_eq!(by_rule.to(0.2).state, by_impulses.to(0.2).state);
}
