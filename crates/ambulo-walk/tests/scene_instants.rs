//! Rows of a scene belong to their instant: efforts, energies, and which integrator a scene has.
//!
//! The arm has two uniform links and hangs at angles of zero. Lagrange's equations of its angles q and r, with the
//! masses m, half lengths c, moments of inertia I, and a = I₁ + I₂ + m₁ c₁² + m₂ (l₁² + c₂²), b = m₂ l₁ c₂ and
//! d = I₂ + m₂ c₂²:
//!
//!   τ₁ = (a + 2 b cos r) q̈ + (d + b cos r) r̈ - b sin r (2 q̇ ṙ + ṙ²) + (m₁ c₁ + m₂ l₁) g sin q + m₂ c₂ g sin(q + r)
//!   τ₂ = (d + b cos r) q̈ + d r̈ + b sin r q̇² + m₂ c₂ g sin(q + r)

use ambulo_walk::engine::Integrator;
use ambulo_walk::findings::{Code, Findings};
use ambulo_walk::scene::{IntegratorReason, Scene, SceneFile, SceneSettings};
use std::f64::consts::TAU;

const G: f64 = 9.80665;
/// Length [m], mass [kg] and amplitude [rad] of both links, and frequency [Hz].
const LENGTH: [f64; 2] = [0.35, 0.3];
const MASS: [f64; 2] = [2.5, 1.5];
const SWING: [(f64, f64); 2] = [(1.5, 1.3), (1.2, 1.7)];

fn scene(text: &str) -> (Scene, Findings) {
    let mut findings = Findings::default();
    let mut no_files = |path: &str| Err(format!("{path}: no file"));
    let file = SceneFile::parse(text).unwrap_or_else(|error| panic!("{error}"));
    let scene = Scene::build(&file, SceneSettings::default(), &mut no_files, &mut findings);
    (scene.unwrap_or_else(|error| panic!("{error}")), findings)
}

/// The arm with what acts on shoulder and elbow; one row per step.
fn arm(integrator: Integrator, step_s: f64, duration_s: f64, acting: [&str; 2]) -> Scene {
    let inertia = |k: usize| MASS[k] * LENGTH[k] * LENGTH[k] / 12.0;
    let body = |k: usize, y: f64| {
        let (m, i) = (MASS[k], inertia(k));
        format!("[[body]]\nname = \"{k}\"\nmass = {m}\ninertia = [{i}, {i}, {i}]\nposition = [0, {y}, 0]\n")
    };
    let joint = |name: &str, parent: &str, k: usize, y: f64| {
        format!(
            "[[joint]]\nname = \"{name}\"\nkind = \"revolute\"\nparent = \"{parent}\"\nchild = \"{k}\"\nat = \
             [0, {y}, 0]\naxis = [0, 0, 1]\ncoordinate = {{ {} }}\n",
            acting[k]
        )
    };
    let [l, m] = LENGTH;
    let text = format!(
        "step = {step_s}\nduration = {duration_s}\noutput_rate = {}\nintegrator = \"{}\"\n{}{}{}{}",
        1.0 / step_s,
        integrator.word(),
        body(0, -0.5 * l),
        body(1, -l - 0.5 * m),
        joint("shoulder", "world", 0, 0.0),
        joint("elbow", "0", 1, -l)
    );
    scene(&text).0
}

/// Both angles driven along their sines.
fn driven(integrator: Integrator, step_s: f64, duration_s: f64) -> Scene {
    let drive = |(a, f): (f64, f64)| format!("drive = {{ sine = {{ amplitude = {a}, frequency_hz = {f} }} }}");
    let [shoulder, elbow] = SWING.map(drive);
    arm(integrator, step_s, duration_s, [&shoulder, &elbow])
}

/// Moments of shoulder and elbow from angles with their first and second derivatives.
fn inverse_dynamics([q, qd, qdd]: [f64; 3], [r, rd, rdd]: [f64; 3]) -> [f64; 2] {
    let ([m1, m2], [l1, l2]) = (MASS, LENGTH);
    let (c1, c2) = (0.5 * l1, 0.5 * l2);
    let d = m2 * l2 * l2 / 12.0 + m2 * c2 * c2;
    let a = m1 * l1 * l1 / 12.0 + m1 * c1 * c1 + m2 * l1 * l1 + d;
    let b = m2 * l1 * c2;
    let weight = m2 * c2 * G * (q + r).sin();
    [
        (a + 2.0 * b * r.cos()) * qdd + (d + b * r.cos()) * rdd - b * r.sin() * (2.0 * qd * rd + rd * rd)
            + (m1 * c1 + m2 * l1) * G * q.sin()
            + weight,
        (d + b * r.cos()) * qdd + d * rdd + b * r.sin() * qd * qd + weight,
    ]
}

/// The moments that the drives need at an instant [s].
fn needed(t: f64) -> [f64; 2] {
    let [q, r] = SWING.map(|(a, f)| {
        let (w, (sin, cos)) = (TAU * f, (TAU * f * t).sin_cos());
        [a * sin, a * w * cos, -a * w * w * sin]
    });
    inverse_dynamics(q, r)
}

/// Largest difference of a moment from the one that is needed `shift` steps later, as a share of the largest.
fn worst(rows: &[(f64, [f64; 2])], shift_s: f64) -> f64 {
    let of = |k: usize| {
        let pairs = rows.iter().map(|(t, found)| (found[k], needed(t + shift_s)[k]));
        let [off, most] = pairs.fold([0.0_f64; 2], |[off, most], (found, expected)| {
            [off.max((found - expected).abs()), most.max(expected.abs())]
        });
        off / most
    };
    of(0).max(of(1))
}

fn rows(scene: &mut Scene) -> Vec<(f64, [f64; 2])> {
    let mut rows = Vec::new();
    scene
        .run(&mut Findings::default(), |frame| {
            let efforts = &frame.forces.as_ref().unwrap().efforts;
            rows.push((frame.scene.state().time_s, [efforts[0][0], efforts[1][0]]));
        })
        .unwrap();
    rows
}

/// The multipliers of each step, with the time of its start, after the first ten.
fn multipliers(scene: &mut Scene, steps: usize) -> Vec<(f64, [f64; 2])> {
    let mut next = || {
        let start_s = scene.state().time_s;
        scene.step(&mut Findings::default()).unwrap();
        let efforts = scene.forces().efforts;
        (start_s, [efforts[0][0], efforts[1][0]])
    };
    (0..steps).map(|_| next()).collect::<Vec<_>>().split_off(10)
}

#[test]
fn the_efforts_of_a_row_are_those_of_inverse_dynamics_at_its_time_in_all_integrators() {
    for integrator in [Integrator::Impulse, Integrator::Midpoint, Integrator::RungeKutta] {
        let errors = [4e-3, 2e-3, 1e-3].map(|h| {
            let rows = rows(&mut driven(integrator, h, 1.2));
            assert_eq!(
                rows.len(),
                (1.2 / h).round() as usize + 1,
                "a row at the start, and one at the end of each step"
            );
            [worst(&rows, 0.0), worst(&rows, -0.5 * h)]
        });
        let plain = [4e-3, 2e-3, 1e-3]
            .map(|h| worst(&multipliers(&mut driven(integrator, h, 1.2), (1.2 / h).round() as usize), 0.0));
        let order = |coarse: f64, fine: f64| (coarse / fine).log2();
        println!(
            "{}: rows off by {:.1e}, {:.1e}, {:.1e} of the largest moment at 4, 2, 1 ms (half a step earlier: {:.1e} \
             at 1 ms); multipliers of the steps by {:.1e}, {:.1e}, {:.1e}, order {:.2}, {:.2}",
            integrator.word(),
            errors[0][0],
            errors[1][0],
            errors[2][0],
            errors[2][1],
            plain[0],
            plain[1],
            plain[2],
            order(plain[0], plain[1]),
            order(plain[1], plain[2])
        );
        // Rounding of sums of ten terms, and of second derivatives.
        assert!(errors.iter().all(|[off, _]| *off < 1e-9), "{errors:?}");
        assert!(errors[2][1] > 3e-3, "a time that is off by half a step must show: {errors:?}");
        if integrator == Integrator::Impulse {
            assert!((0.9..1.1).contains(&order(plain[1], plain[2])), "{plain:?}");
        }
    }
}

/// Effort of the shoulder and force on the upper link at an instant of a swing with a spring and a damper.
fn swinging(integrator: Integrator, step_s: f64) -> [f64; 3] {
    let acting = ["rate = 3, spring = { stiffness = 20, damping = 0.1, rest = 0.4 }", "rate = -5"];
    let mut last = [0.0; 3];
    arm(integrator, step_s, 0.4, acting)
        .run(&mut Findings::default(), |frame| {
            let forces = frame.forces.as_ref().unwrap();
            last = [forces.efforts[0][0], forces.joints[0].force.x, forces.joints[0].force.y];
        })
        .unwrap();
    last
}

#[test]
fn efforts_and_reactions_of_a_swinging_arm_converge_with_the_order_of_the_integrator() {
    let best = swinging(Integrator::RungeKutta, 1.25e-4);
    for (integrator, order) in [(Integrator::Impulse, 1.0), (Integrator::Midpoint, 2.0)] {
        let errors = [4e-3, 2e-3, 1e-3].map(|h| {
            let found = swinging(integrator, h);
            found.iter().zip(best).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt()
        });
        let orders = [0, 1].map(|k| (errors[k] / errors[k + 1]).log2());
        println!("{}: {errors:?} N.m, N off at 4, 2, 1 ms: orders {orders:?}", integrator.word());
        assert!((orders[1] - order).abs() < 0.25, "{} {orders:?}", integrator.word());
    }
}

#[test]
fn the_work_of_the_drives_between_rows_is_the_change_of_the_energy() {
    let worst = |h: f64| {
        let (mut work, mut last, mut off, mut most) = (0.0, None, 0.0_f64, 0.0_f64);
        let mut scene = driven(Integrator::Impulse, h, 1.0);
        scene
            .run(&mut Findings::default(), |frame| {
                let (state, forces) = (frame.scene.state(), frame.forces.as_ref().unwrap());
                let power: f64 =
                    (0..2).map(|k| forces.efforts[k][0] * state.rates(&frame.scene.world().joints[k])[0]).sum();
                let energy = frame.energy.total();
                let (start, before) = *last.get_or_insert((energy, power));
                work += 0.5 * h * (before + power);
                last = Some((start, power));
                off = off.max((energy - start - work).abs());
                most = most.max((energy - start).abs());
            })
            .unwrap();
        off / most
    };
    let errors = [worst(4e-3), worst(2e-3), worst(1e-3)];
    println!("work off by {errors:?} of the largest change of the energy");
    // The trapezoidal rule of the sum is of second order.
    assert!(errors[2] < 1e-4 && (3.5..4.5).contains(&(errors[1] / errors[2])), "{errors:?}");
}

/// A rod of 1 m let go at 150 degrees, and what else is in the scene.
fn rod(more: &str) -> String {
    format!(
        "step = 0.001\nduration = 6\n[[body]]\nname = \"rod\"\nmass = 1\ninertia = [0.0833333, 0.0001, 0.0833333]\n\
         position = [0.25, 0.4330127, 0]\nrotation = {{ axis = [0, 0, 1], angle_deg = 150 }}\n{more}\
         [[joint]]\nname = \"hinge\"\nkind = \"revolute\"\nparent = \"world\"\nchild = \"rod\"\nat = [0, 0, 0]\n\
         axis = [0, 0, 1]\ncoordinate = {{ start_deg = 150 }}\n"
    )
}

#[test]
fn free_motion_keeps_its_energy_by_default() {
    let loss = |text: &str| {
        let (mut scene, mut findings) = scene(text);
        let (mut start, mut worst, mut kinetic) = (None, 0.0_f64, 0.0_f64);
        scene
            .run(&mut findings, |frame| {
                let start = *start.get_or_insert(frame.energy.total());
                worst = worst.max((frame.energy.total() - start).abs());
                kinetic = kinetic.max(frame.energy.kinetic);
            })
            .unwrap();
        worst / kinetic
    };
    let (free, impulses) = (loss(&rod("")), loss(&format!("integrator = \"impulse\"\n{}", rod(""))));
    println!("a rod for 6 s: energy off by {free:.1e} of the largest kinetic energy; with impulses {impulses:.1e}");
    assert!(free < 1e-3 && impulses > 0.05);
}

#[test]
fn the_integrator_follows_from_what_is_in_the_scene() {
    let of = |text: &str| {
        let scene = scene(text).0;
        (scene.settings().integrator, scene.integrator_reason())
    };
    let shape = "shape = { kind = \"sphere\", radius = 0.1 }\n";
    let floor = "[[obstacle]]\nname = \"floor\"\nkind = \"plane\"\nat = [0, -2, 0]\n";
    assert_eq!(of(&rod("")), (Integrator::Midpoint, IntegratorReason::FreeMotion));
    assert_eq!(of(&rod(shape)), (Integrator::Midpoint, IntegratorReason::FreeMotion), "it has nothing to touch");
    assert_eq!(of(&rod(&format!("{shape}{floor}"))), (Integrator::Impulse, IntegratorReason::MayTouch));
    let stated = format!("integrator = \"runge-kutta\"\n{}", rod(""));
    assert_eq!(of(&stated), (Integrator::RungeKutta, IntegratorReason::Stated));
    let driven = rod("").replace("start_deg = 150", "drive_deg = 150");
    assert_eq!(of(&driven), (Integrator::Impulse, IntegratorReason::Driven));
}

#[test]
fn only_a_contradiction_of_more_than_one_per_cent_of_the_velocities_is_reported() {
    let warned = |speed: f64| {
        let moving = rod(&format!("velocity = [{}, {}, 0]\nangular_velocity = [0, 0, 1]\n", -0.4330127 * speed, 0.25));
        let (mut scene, mut findings) = scene(&moving);
        scene.run(&mut findings, |_| ()).unwrap();
        findings.has(Code::StartContradictory)
    };
    assert!(!warned(1.0) && !warned(1.001), "rounded numbers");
    assert!(warned(1.1), "ten per cent");
}
