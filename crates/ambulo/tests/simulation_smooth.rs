//! The fourth-order integrator: closed forms, its order, energy, and the instants at which surfaces meet.

use crate::common::turn;
use crate::common::worlds::{
    G, O, Run, add_ball, add_body, add_closure, add_floor, add_joint, along, drive, empty, of_material, of_rigid, sine,
    turned, v,
};
use ambulo::dynamics::SolverSettings;
use ambulo::findings::Code;
use ambulo::simulation::{
    ContactLaw, Integrator, JointKind, Material, StepWorkspace, World, WorldState, accelerations, energy,
};
use ambulo::spatial::{Mat3, Pose, Twist, Vec3};

fn smooth(world: World, step_s: f64) -> Run {
    let mut run = Run::new(world, step_s);
    run.settings.integrator = Integrator::RungeKutta;
    run
}

/// A chain of links of 0.2 m and 1 kg, level, hinged about z.
fn chain(count: usize) -> World {
    let mut world = empty();
    for i in 0..count {
        let body = add_body(&mut world, 1.0, [0.002, 0.004, 0.004], Pose::at(v(0.2 * i as f64 + 0.1, 0.0, 0.0)));
        let before = i.checked_sub(1);
        let at = if before.is_some() { v(0.1, 0.0, 0.0) } else { O };
        let frames = [Pose::at(at), Pose::at(v(-0.1, 0.0, 0.0))];
        add_joint(&mut world, JointKind::Revolute, body, before, frames);
    }
    world
}

/// Complete elliptic integral K(k) by the arithmetic-geometric mean.
fn elliptic(k: f64) -> f64 {
    let (mut a, mut b) = (1.0, (1.0 - k * k).sqrt());
    for _ in 0..12 {
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    std::f64::consts::FRAC_PI_2 / a
}

/// Angle from hanging of a rod released horizontally, after a quarter of its period, where one step ends.
fn quarter_period_error(steps: u32) -> f64 {
    // Compound pendulum: T/4 = K(sin(θ₀/2)) √(I/(m g l)), θ₀ = 90 degrees.
    let (inertia, arm) = (0.004 + 0.1 * 0.1, 0.1);
    let quarter = elliptic(0.5_f64.sqrt()) * (inertia / (G * arm)).sqrt();
    let mut run = smooth(chain(1), quarter / f64::from(steps));
    (0..steps).for_each(|_| {
        run.step();
    });
    (run.q(0, 0) + std::f64::consts::FRAC_PI_2).abs()
}

#[test]
fn a_pendulum_keeps_the_period_of_the_elliptic_integral_and_errors_fall_sixteenfold_with_half_the_step() {
    let errors = [40, 80, 160].map(quarter_period_error);
    println!("quarter period: {errors:?} rad off with 40, 80, 160 steps");
    // Fourth order: 16, give or take the fifth.
    for pair in errors.windows(2) {
        assert!(pair[0] / pair[1] > 12.0 && pair[0] / pair[1] < 22.0, "{errors:?}");
    }
    // 400 steps of 1 ms: (1/10)⁴ of 40 steps.
    assert!(quarter_period_error(400) < 1e-9);
}

#[test]
fn a_double_pendulum_converges_at_fourth_order() {
    let end = |steps: u32| {
        let mut run = smooth(chain(2), 0.5 / f64::from(steps));
        (0..steps).for_each(|_| {
            run.step();
        });
        (run.q(0, 0), run.q(1, 0))
    };
    let best = end(3200);
    let errors = [100, 200, 400].map(|steps| (end(steps).0 - best.0).hypot(end(steps).1 - best.1));
    println!("double pendulum: {errors:?}");
    for pair in errors.windows(2) {
        assert!(pair[0] / pair[1] > 12.0 && pair[0] / pair[1] < 22.0, "{errors:?}");
    }
}

#[test]
fn a_symmetric_top_precesses_at_the_steady_rate() {
    // Steady precession Ω at lean θ: I₁ Ω² cos θ - I₃ ω₃ Ω + m g l = 0, ω₃ the spin about the axis.
    let (mass, arm, lean, spin) = (0.5, 0.05, 0.5_f64, 90.0);
    let (about_axis, across) = (8e-4, 5e-4 + mass * arm * arm);
    let a = across * lean.cos();
    let half = about_axis * spin;
    let rate = (half - (half * half - 4.0 * a * mass * G * arm).sqrt()) / (2.0 * a);
    let mut world = empty();
    let pose = turned(-lean, Vec3::zeros());
    let pose = Pose { translation: pose.rotation * v(0.0, arm, 0.0), ..pose };
    let body = add_body(&mut world, mass, [5e-4, about_axis, 5e-4], pose);
    let axis = pose.rotation * Vec3::y();
    let angular = Vec3::y() * rate + axis * (spin - rate * lean.cos());
    world.bodies[body].twist = Twist { angular, linear: angular.cross(&pose.translation) };
    add_joint(&mut world, JointKind::Ball, body, None, [Pose::IDENTITY, Pose::at(v(0.0, -arm, 0.0))]);
    let error = |step_s: f64| {
        let mut run = smooth(world.clone(), step_s);
        run.to(0.5);
        let p = run.place(body);
        let turned = f64::atan2(-p.z, p.x) - rate * 0.5;
        (turned - std::f64::consts::TAU * (turned / std::f64::consts::TAU).round()).abs()
    };
    let errors = [1e-3, 5e-4];
    let errors = errors.map(error);
    println!("precession: {errors:?} rad off after 0.5 s at 1 and 0.5 ms");
    // The spin turns 0.09 rad in a step of 1 ms: h⁴ of it, over 500 steps.
    assert!(errors[0] < 1e-4 && errors[0] / errors[1] > 12.0, "{errors:?}");
}

#[test]
fn a_whipping_chain_of_twenty_links_keeps_its_energy_to_a_thousandth() {
    let mut run = smooth(chain(20), 1e-3);
    let start = energy(&run.world, &run.state).total();
    let (mut kinetic, mut drift) = (0.0_f64, 0.0_f64);
    run.watch(10.0, |run| {
        let now = energy(&run.world, &run.state);
        kinetic = kinetic.max(now.kinetic);
        drift = drift.max((now.total() - start).abs());
    });
    println!("chain of 20, 10 s at 1 ms: energy off by {drift:.1e} J of {kinetic:.0} J");
    assert!(drift < 1e-3 * kinetic, "{drift} of {kinetic}");
}

/// Height of a point that falls from `height` and bounces, after a time [s].
fn height_of_bounces(height: f64, restitution: f64, time_s: f64) -> f64 {
    let (mut speed, mut since) = ((2.0 * G * height).sqrt(), time_s - (2.0 * height / G).sqrt());
    if since < 0.0 {
        return height - 0.5 * G * time_s * time_s;
    }
    loop {
        speed *= restitution;
        let flight = 2.0 * speed / G;
        if since < flight {
            return since * (speed - 0.5 * G * since);
        }
        since -= flight;
    }
}

#[test]
fn a_bouncing_ball_rises_by_the_square_of_its_restitution() {
    let (restitution, height) = (0.8_f64, 1.0);
    let mut world = of_rigid(0.0, restitution);
    add_floor(&mut world, Pose::IDENTITY);
    let ball = add_ball(&mut world, 2.0, 0.1, v(0.0, 0.1 + height, 0.0));
    let mut run = smooth(world, 1e-3);
    let mut heights = Vec::new();
    let mut before = (0.0, 0.0);
    let mut steps = 0;
    run.watch(2.5, |run| {
        steps += 1;
        assert!(
            (run.state.time_s - f64::from(steps) * 1e-3).abs() < 1e-9,
            "a step with an impact takes as long as any"
        );
        let expected = 0.1 + height_of_bounces(height, restitution, run.state.time_s);
        assert!((run.place(ball).y - expected).abs() < 1e-7, "{} for {expected}", run.state.time_s);
        let speed = run.velocity(ball).y;
        let top = run.place(ball).y - 0.1 + speed * speed / (2.0 * G);
        if before.1 > 0.0 && speed <= 0.0 {
            heights.push(top);
        }
        before = (top, speed);
    });
    println!("heights: {heights:?}");
    assert!(heights.len() >= 3);
    for (bounce, found) in heights.iter().enumerate() {
        let expected = height * restitution.powi(2 * (bounce as i32 + 1));
        // The instant of contact is found to 1e-10 m.
        assert!((found - expected).abs() < 1e-8, "{bounce}: {found} for {expected}");
    }
}

#[test]
fn spin_and_place_do_not_change_the_bounces_of_a_smooth_ball() {
    // Without friction only the velocity along the normal counts, which a spin does not change at the lowest point of a
    // ball.
    for spin in [-20.0, 20.0] {
        let mut world = of_rigid(0.0, 0.8);
        add_floor(&mut world, Pose::IDENTITY);
        let ball = add_ball(&mut world, 2.0, 0.1, v(3.0, 0.6, 0.0));
        world.bodies[ball].twist.angular = v(0.0, 0.0, spin);
        let mut run = smooth(world, 1e-3);
        run.watch(1.5, |run| {
            let expected = 0.1 + height_of_bounces(0.5, 0.8, run.state.time_s);
            assert!((run.place(ball).y - expected).abs() < 1e-7, "{} for {expected}", run.state.time_s);
        });
        assert!((run.spin(ball).z - spin).abs() < 1e-9);
    }
}

#[test]
fn a_closed_loop_stays_closed_and_keeps_its_energy() {
    // Two arms of 0.2 m hang from a beam 0.3 m apart, joined by a bar, let go at 45 degrees.
    let mut world = empty();
    let slant = turned(-std::f64::consts::FRAC_PI_4, O);
    let along_arm = |at: Vec3, share: f64| Pose { translation: at + slant.rotation * v(share, 0.0, 0.0), ..slant };
    let rod = [0.001, 0.004, 0.004];
    let arms = [O, v(0.3, 0.0, 0.0)].map(|pivot| add_body(&mut world, 1.0, rod, along_arm(pivot, 0.1)));
    let end = along_arm(O, 0.2).translation;
    let bar = add_body(&mut world, 0.5, [0.001, 0.004, 0.004], Pose::at(end + v(0.15, 0.0, 0.0)));
    for (arm, pivot) in arms.into_iter().zip([O, v(0.3, 0.0, 0.0)]) {
        add_joint(&mut world, JointKind::Revolute, arm, None, [Pose::at(pivot), Pose::at(v(-0.1, 0.0, 0.0))]);
    }
    let tip = Pose::at(v(0.1, 0.0, 0.0));
    add_joint(&mut world, JointKind::Revolute, bar, Some(arms[0]), [tip, Pose::at(v(-0.15, 0.0, 0.0))]);
    add_closure(&mut world, JointKind::Ball, bar, Some(arms[1]), [Pose::at(v(0.15, 0.0, 0.0)), tip]);
    let mut run = smooth(world, 1e-3);
    let start = energy(&run.world, &run.state).total();
    run.to(2.0);
    let drift = (energy(&run.world, &run.state).total() - start).abs();
    let open = ambulo::simulation::largest_joint_error(&run.world, &run.state);
    println!("four-bar: open by {open:.1e} m, energy off by {drift:.1e} J");
    assert!(open < 1e-9 && drift < 1e-6, "{open:e} {drift:e}");
}

#[test]
fn a_driven_pendulum_takes_the_effort_of_its_equation_of_motion() {
    let mut world = chain(1);
    drive(&mut world, 0, 0, sine(0.7, 1.5, 0.3, -0.2));
    let mut run = smooth(world, 1e-3);
    run.state.coordinates[0][0] = 0.7 * 0.3_f64.sin() - 0.2;
    let omega = std::f64::consts::TAU * 1.5;
    for _ in 0..500 {
        let t = run.state.time_s;
        run.step();
        let (q, acceleration) = (0.7 * (omega * t + 0.3).sin() - 0.2, -0.7 * omega * omega * (omega * t + 0.3).sin());
        let expected = (0.004 + 0.01) * acceleration + G * 0.1 * q.cos();
        let effort = run.forces().efforts[0][0];
        // Forces are those at the start of the step: rounding of 2 N.m.
        assert!((effort - expected).abs() < 1e-10, "{effort} for {expected} at {t}");
    }
}

#[test]
fn a_rotation_turned_the_wrong_way_is_noticed() {
    let mut run = smooth(chain(1), 1e-3);
    run.to(0.1);
    let turned: Mat3 = run.state.poses[0].rotation;
    assert!(run.q(0, 0) < -1e-3 && (turned[(1, 0)] - run.q(0, 0).sin()).abs() < 1e-12);
}

#[test]
fn a_rod_that_is_let_go_level_falls_at_the_rate_of_its_moment_of_inertia() {
    let world = chain(1);
    let state = WorldState::new(&world);
    let found = accelerations(&world, &state, &SolverSettings::default(), &mut StepWorkspace::default()).unwrap();
    let expected = -G * 0.1 / (0.004 + 0.1 * 0.1);
    assert_eq!(found.len(), 1);
    assert!((found[0].angular - v(0.0, 0.0, expected)).norm() < 1e-12 * G, "{:?}", found[0]);
    assert!((found[0].linear - v(0.0, 0.1 * expected, 0.0)).norm() < 1e-12 * G, "{:?}", found[0]);
}

/// A mass of 2 kg on a level slide along x, at a speed.
fn slide(speed: f64) -> World {
    let mut world = empty();
    let body = add_body(&mut world, 2.0, [0.1; 3], Pose::IDENTITY);
    world.bodies[body].twist.linear = v(speed, 0.0, 0.0);
    let frame = along(Vec3::x(), O);
    add_joint(&mut world, JointKind::Prismatic, body, None, [frame, frame]);
    world
}

#[test]
fn dry_friction_stops_a_slide_and_holds_it() {
    let (speed, friction, mass) = (1.0, 4.0, 2.0);
    let mut world = slide(speed);
    world.joints[0].coordinates[0].friction = friction;
    let mut run = smooth(world, 1e-3);
    let stop = mass * speed / friction;
    run.watch(0.8, |run| {
        let t = run.state.time_s.min(stop);
        let expected = speed * t - 0.5 * friction / mass * t * t;
        // A step of impulses moves with the velocity of its end: F/m h t/2 off at time t.
        let first_order = 0.5 * friction / mass * 1e-3 * t;
        assert!((run.q(0, 0) - expected).abs() < first_order + 1e-9, "{} for {expected}", run.q(0, 0));
    });
    assert!(run.velocity(0).norm() < 1e-9);
}

#[test]
fn a_ball_joint_follows_its_rotation_vector_wherever_that_turns() {
    // The axis of the rotation vector turns, so its rate is not the angular velocity.
    let signals = [sine(1.0, 0.8, 0.0, 0.0), sine(1.0, 1.1, 0.5, 0.0), sine(1.0, 0.5, 1.0, 0.0)];
    let start = v(0.0, 0.5_f64.sin(), 1.0_f64.sin());
    let mut world = empty();
    let pose = Pose { rotation: turn(start, start.norm()), translation: O };
    add_body(&mut world, 1.0, [0.01, 0.02, 0.03], pose);
    add_joint(&mut world, JointKind::Ball, 0, None, [Pose::IDENTITY; 2]);
    signals.iter().enumerate().for_each(|(k, signal)| drive(&mut world, 0, k, signal.clone()));
    let mut run = smooth(world, 1e-3);
    run.watch(1.0, |run| {
        let q = Vec3::from_iterator(signals.iter().map(|signal| signal.at(run.state.time_s)[0]));
        let off = (run.state.poses[0].rotation - turn(q, q.norm())).norm();
        assert!(off < 1e-12, "{off:e} at {}", run.state.time_s);
    });
}

/// A ball of 1 kg over a floor, its lowest point at this height, with this speed upwards; their contact is a spring
/// [N/m].
fn ball_on_springs(stiffness: f64, height: f64, speed: f64) -> World {
    // Those of ball and floor act in series.
    let law = ContactLaw::Regularised { stiffness: 2.0 * stiffness, damping: 0.0 };
    let mut world = of_material(Material { law, friction: 0.0, restitution: 0.0 });
    add_floor(&mut world, Pose::IDENTITY);
    let ball = add_ball(&mut world, 1.0, 0.125, v(0.0, 0.125 + height, 0.0));
    world.bodies[ball].twist.linear = v(0.0, speed, 0.0);
    world
}

#[test]
fn a_floor_of_springs_throws_a_ball_back_as_high_as_it_fell_from() {
    let (height, stiffness) = (0.2, 1e4_f64);
    let mut run = smooth(ball_on_springs(stiffness, height, 0.0), 1e-4);
    let fall = (2.0 * height / G).sqrt();
    run.watch(0.9 * fall, |run| {
        // Before contact: a parabola, exact for the fourth-order integrator.
        let expected = 0.125 + height - 0.5 * G * run.state.time_s.powi(2);
        assert!((run.place(0).y - expected).abs() < 1e-12);
    });
    let (mut deepest, mut top) = (0.0_f64, 0.0_f64);
    run.watch(0.6, |run| {
        let above = run.place(0).y - 0.125;
        deepest = deepest.min(above);
        assert!(run.workspace.impacts().is_empty(), "springs push over time, in no instant");
        top = if deepest < 0.0 { top.max(above) } else { 0.0 };
    });
    let depth = (2.0 * G * height / stiffness).sqrt() + G / stiffness;
    println!("springs: {deepest} deep for {depth}, back to {top} of {height}");
    // Springs taken implicitly lose the share π ω h = 3 % of their energy in half a cycle (ω = 100 rad/s); m g adds 1 %
    // to the depth.
    assert!((deepest + depth).abs() < 0.02 * depth, "{deepest} for -{depth}");
    assert!(top > 0.95 * height && top < height, "{top} of {height}");
}

#[test]
fn a_ball_thrown_up_from_a_floor_of_springs_flies_its_parabola_from_the_first_step_on() {
    let mut run = smooth(ball_on_springs(1e4, 0.0, 2.0), 1e-3);
    run.watch(0.4, |run| {
        let t = run.state.time_s;
        let expected = 0.125 + 2.0 * t - 0.5 * G * t * t;
        assert!((run.place(0).y - expected).abs() < 1e-12, "{} for {expected} at {t}", run.place(0).y);
    });
}

#[test]
fn a_slide_stops_at_either_limit_and_before_it_keeps_its_order() {
    for (sign, limits) in [(1.0, (None, Some(0.2))), (-1.0, (Some(-0.2), None))] {
        let mut world = slide(0.0);
        world.joints[0].coordinates[0].limits = limits;
        world.bodies[0].load.force = v(3.0 * sign, 0.0, 0.0);
        let mut run = smooth(world, 1e-3);
        run.watch(1.0, |run| {
            let expected = (0.5 * 1.5 * run.state.time_s.powi(2)).min(0.2);
            assert!((run.q(0, 0) * sign - expected).abs() < 1e-9, "{} for {expected}", run.q(0, 0));
        });
        assert!(run.velocity(0).norm() < 1e-9);
        assert!((run.forces().efforts[0][0] + 3.0 * sign).abs() < 1e-8, "{:?}", run.forces().efforts);
    }
}

#[test]
fn a_drive_below_its_limit_keeps_its_order_and_beyond_it_gives_way() {
    // A slide of 2 kg driven with A sin(ω t + π/2) needs m A ω² at most: 2 N.
    let signal = sine(0.25, 1.0 / std::f64::consts::PI, std::f64::consts::FRAC_PI_2, 0.0);
    let driven = |max: f64| {
        let mut world = slide(0.0);
        drive(&mut world, 0, 0, signal.clone());
        world.joints[0].coordinates[0].drive.as_mut().unwrap().max = Some(max);
        let mut run = smooth(world, 1e-3);
        run.state.coordinates[0][0] = 0.25;
        run.state.poses[0].translation.x = 0.25;
        run
    };
    let mut strong = driven(2.1);
    strong.watch(1.0, |run| {
        let needed = 2.0 * signal.at(run.state.time_s - 1e-3)[2];
        let effort = run.forces().efforts[0][0];
        // Forces are those at the start of the step.
        assert!((effort - needed).abs() < 1e-9, "{effort} for {needed}");
    });
    assert!(strong.findings.as_slice().is_empty());
    let mut weak = driven(1.5);
    let mut most = 0.0_f64;
    weak.watch(0.2, |run| most = most.max(run.forces().efforts[0][0].abs()));
    assert!(most < 1.5 + 1e-9, "{most} N");
    // It gets 1.5 of the 2 N, so it falls behind by a quarter of 1 m/s² at least at first.
    let behind = weak.q(0, 0) - signal.at(0.2)[0];
    assert!(behind > 0.4 * 0.25 * 0.2 * 0.2, "{behind}");
    assert!(weak.findings.as_slice().iter().any(|finding| finding.code == Code::DriveAtLimit));
}
