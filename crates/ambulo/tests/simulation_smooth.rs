//! The fourth-order integrator: closed forms, its order, energy, and the instants at which surfaces meet.

use crate::common::worlds::{
    G, O, Run, add_ball, add_body, add_closure, add_floor, add_joint, drive, empty, of_rigid, sine, turned, v,
};
use ambulo::simulation::{Integrator, JointKind, energy};
use ambulo::spatial::{Mat3, Pose, Twist, Vec3};

fn smooth(world: ambulo::simulation::World, step_s: f64) -> Run {
    let mut run = Run::new(world, step_s);
    run.settings.integrator = Integrator::RungeKutta;
    run
}

/// A chain of links of 0.2 m and 1 kg, level, hinged about z.
fn chain(count: usize) -> ambulo::simulation::World {
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

#[test]
fn a_bouncing_ball_rises_by_the_square_of_its_restitution() {
    let (restitution, height) = (0.8_f64, 1.0);
    let mut world = of_rigid(0.0, restitution);
    add_floor(&mut world, Pose::IDENTITY);
    let ball = add_ball(&mut world, 2.0, 0.1, v(0.0, 0.1 + height, 0.0));
    let mut run = smooth(world, 1e-3);
    let mut heights = Vec::new();
    let mut before = (0.0, 0.0);
    run.watch(2.5, |run| {
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
