//! References with a closed form: pendulums, a gyroscope, balls and boxes on the ground, drives of the 1997 paper.

use super::series::{Signal, Wave, column, csv, model_file, motion_file, seconds, storage};
use ambulo::numerics::elementary::{cos, powi, sin};

/// Gravity in every case [m/s²].
pub(super) const G: f64 = 9.80665;

/// Files of a case: its folder, then name and content of each.
pub(super) type Files = (&'static str, Vec<(&'static str, Vec<u8>)>);

pub(super) fn all() -> Vec<Files> {
    let dynamics = [pendulum(), double_pendulum(), gyroscope()];
    let contact = [drop(), bounce(), slide(), slope(), roll(), stack()];
    let paper = [quintics(), closed_loop(), landing(), table_1()];
    dynamics.into_iter().chain(contact).chain(paper).collect()
}

fn body(name: &str, mass: f64, center: &str, inertia: &str) -> String {
    format!(
        "<Body name=\"{name}\"><mass>{mass}</mass><mass_center>{center}</mass_center>\
         <inertia>{inertia} 0 0 0</inertia></Body>"
    )
}

fn pin(name: &str, parent: &str, at: &str, child: &str, coordinate: &str) -> String {
    joint("PinJoint", name, parent, at, child, &[coordinate], "")
}

fn joint(kind: &str, name: &str, parent: &str, at: &str, child: &str, coordinates: &[&str], axes: &str) -> String {
    let coordinates: String = coordinates.iter().map(|one| format!("<Coordinate name=\"{one}\"/>")).collect();
    let path = if parent == "ground" { "/ground".to_owned() } else { format!("/bodyset/{parent}") };
    format!(
        "<{kind} name=\"{name}\"><socket_parent_frame>{parent}_offset</socket_parent_frame>\
         <socket_child_frame>{child}_offset</socket_child_frame><coordinates>{coordinates}</coordinates><frames>\
         <PhysicalOffsetFrame name=\"{parent}_offset\"><socket_parent>{path}</socket_parent>\
         <translation>{at}</translation><orientation>0 0 0</orientation></PhysicalOffsetFrame>\
         <PhysicalOffsetFrame name=\"{child}_offset\"><socket_parent>/bodyset/{child}</socket_parent>\
         <translation>0 0 0</translation><orientation>0 0 0</orientation></PhysicalOffsetFrame></frames>{axes}</{kind}>"
    )
}

/// I q̈ + m g l sin q of a rod about its end.
fn pendulum() -> Files {
    let (mass, length, inertia) = (2.0, 0.3, 0.06);
    let swing = Wave { offset: 0.2, amplitude: 0.9, frequency_hz: 0.8, phase: 0.4 };
    let about_pivot = inertia + mass * length * length;
    let moment = |t: f64| about_pivot * swing.at(t)[2] + mass * G * length * sin(swing.at(t)[0]);
    let bodies = body("rod", mass, "0 -0.3 0", "0.06 0.001 0.06");
    let model = model_file("pendulum", &bodies, &pin("pivot", "ground", "0 0 0", "rod", "swing"));
    (
        "inverse-dynamics/pendulum",
        dynamics_files(model, &[("swing", Signal::Wave(swing))], &[("swing_moment", &moment)]),
    )
}

/// Lagrange's equations of two rods; the second angle is relative to the first rod.
fn double_pendulum() -> Files {
    let (m1, c1, l1, i1) = (3.0, 0.2, 0.45, 0.05);
    let (m2, c2, i2) = (1.5, 0.18, 0.02);
    let first = Wave { offset: 0.1, amplitude: 0.7, frequency_hz: 0.7, phase: 0.0 };
    let second = Wave { offset: -0.5, amplitude: 0.6, frequency_hz: 1.3, phase: 1.1 };
    let moments = move |t: f64| {
        let ([q1, d1, a1], [q2, d2, a2]) = (first.at(t), second.at(t));
        let (a, b, c) = (i1 + m1 * c1 * c1 + m2 * l1 * l1, i2 + m2 * c2 * c2, m2 * l1 * c2);
        let tail = m2 * G * c2 * sin(q1 + q2);
        let coriolis = c * sin(q2) * (2.0 * d1 * d2 + d2 * d2);
        let upper = (a + b + 2.0 * c * cos(q2)) * a1 + (b + c * cos(q2)) * a2 - coriolis;
        let lower = (b + c * cos(q2)) * a1 + b * a2 + c * sin(q2) * d1 * d1;
        [upper + (m1 * c1 + m2 * l1) * G * sin(q1) + tail, lower + tail]
    };
    let bodies = body("upper", m1, "0 -0.2 0", "0.05 0.002 0.05") + &body("lower", m2, "0 -0.18 0", "0.02 0.001 0.02");
    let joints = pin("shoulder", "ground", "0 0 0", "upper", "upper_angle")
        + &pin("elbow", "upper", "0 -0.45 0", "lower", "lower_angle");
    let model = model_file("double_pendulum", &bodies, &joints);
    let motion = [("upper_angle", Signal::Wave(first)), ("lower_angle", Signal::Wave(second))];
    let columns: [(&str, &dyn Fn(f64) -> f64); 2] =
        [("upper_angle_moment", &|t| moments(t)[0]), ("lower_angle_moment", &|t| moments(t)[1])];
    ("inverse-dynamics/double-pendulum", dynamics_files(model, &motion, &columns))
}

/// A spinning disc on an axle along x that turns about y (precession) and z (elevation).
///
/// T = ½ A (θ̇² + ψ̇² cos²θ) + ½ C (φ̇ + ψ̇ sin θ)², V = m g l sin θ
fn gyroscope() -> Files {
    let (mass, length, spin_inertia, across) = (1.2, 0.25, 0.009, 0.005);
    let about_pivot = across + mass * length * length;
    let turn = Wave { offset: 0.0, amplitude: 0.8, frequency_hz: 0.6, phase: 0.3 };
    let rise = Wave { offset: 0.3, amplitude: 0.35, frequency_hz: 0.9, phase: 0.0 };
    let spin = Wave { offset: 0.0, amplitude: 6.0, frequency_hz: 0.5, phase: 0.0 };
    let forces = move |t: f64| {
        let ([_, psi_d, psi_a], [theta, theta_d, theta_a], [_, phi_d, phi_a]) = (turn.at(t), rise.at(t), spin.at(t));
        let (s, c) = (sin(theta), cos(theta));
        let rate = phi_d + psi_d * s;
        let rate_change = phi_a + psi_a * s + psi_d * c * theta_d;
        let precession = about_pivot * (psi_a * c * c - 2.0 * psi_d * c * s * theta_d)
            + spin_inertia * (rate_change * s + rate * c * theta_d);
        let elevation = about_pivot * (theta_a + psi_d * psi_d * s * c) - spin_inertia * rate * psi_d * c;
        [precession, elevation + mass * G * length * c, spin_inertia * rate_change]
    };
    let axis = |number: usize, coordinate: &str, axis: &str| {
        format!(
            "<TransformAxis name=\"rotation{number}\"><coordinates>{coordinate}</coordinates><axis>{axis}</axis>\
             <LinearFunction name=\"function\"><coefficients>1 0</coefficients></LinearFunction></TransformAxis>"
        )
    };
    let fixed = |number: usize, axis: &str| {
        format!(
            "<TransformAxis name=\"translation{number}\"><coordinates></coordinates><axis>{axis}</axis>\
             <Constant name=\"function\"><value>0</value></Constant></TransformAxis>"
        )
    };
    let axes = axis(1, "precession", "0 1 0") + &axis(2, "elevation", "0 0 1") + &axis(3, "spin", "1 0 0");
    let axes = axes + &fixed(1, "1 0 0") + &fixed(2, "0 1 0") + &fixed(3, "0 0 1");
    let names = ["precession", "elevation", "spin"];
    let axes = format!("<SpatialTransform>{axes}</SpatialTransform>");
    let joints = joint("CustomJoint", "pivot", "ground", "0 0 0", "disc", &names, &axes);
    let model = model_file("gyroscope", &body("disc", mass, "0.25 0 0", "0.009 0.005 0.005"), &joints);
    let waves = [turn, rise, spin].map(Signal::Wave);
    let motion: Vec<(&str, Signal)> = names.into_iter().zip(waves).collect();
    let columns: [(&str, &dyn Fn(f64) -> f64); 3] = [
        ("precession_moment", &|t| forces(t)[0]),
        ("elevation_moment", &|t| forces(t)[1]),
        ("spin_moment", &|t| forces(t)[2]),
    ];
    ("inverse-dynamics/gyroscope", dynamics_files(model, &motion, &columns))
}

fn dynamics_files(
    model: Vec<u8>,
    motion: &[(&str, Signal)],
    moments: &[(&str, &dyn Fn(f64) -> f64)],
) -> Vec<(&'static str, Vec<u8>)> {
    let reference: Vec<(String, Vec<f64>)> =
        moments.iter().map(|(name, moment)| column(name, &seconds(0.1, 0.01, 61), moment)).collect();
    let reference = storage("reference", &seconds(0.1, 0.01, 61), reference, 1e-6);
    vec![("model.osim", model), ("motion.mot", motion_file(motion)), ("reference.sto", reference)]
}

// ---- Contact ----

fn sampled(folder: &'static str, step: f64, rows: usize, columns: &[(&str, &dyn Fn(f64) -> f64)]) -> Files {
    let times = seconds(0.0, step, rows);
    let columns = columns.iter().map(|(name, value)| column(name, &times, value)).collect();
    (folder, vec![("reference.csv", csv(&times, columns))])
}

/// Height above rest of a ball that was let go and keeps this share of its speed in each impact.
fn bouncing(height: f64, restitution: f64, t: f64) -> f64 {
    let fall = (2.0 * height / G).sqrt();
    if t < fall {
        return height - 0.5 * G * t * t;
    }
    let (mut begin, mut speed) = (fall, restitution * G * fall);
    while speed > 0.0 && t > begin + 2.0 * speed / G {
        begin += 2.0 * speed / G;
        speed *= restitution;
    }
    speed * (t - begin) - if speed > 0.0 { 0.5 * G * powi(t - begin, 2) } else { 0.0 }
}

fn drop() -> Files {
    sampled("contact/drop", 0.05, 20, &[("ball/py", &|t| 0.1 + bouncing(1.0, 0.0, t))])
}

fn bounce() -> Files {
    sampled("contact/bounce", 0.05, 29, &[("ball/py", &|t| 0.1 + bouncing(0.5, 0.8, t))])
}

/// Way of a body that a constant deceleration brings to rest.
fn stopping(speed: f64, deceleration: f64, t: f64) -> f64 {
    let t = t.min(speed / deceleration);
    speed * t - 0.5 * deceleration * t * t
}

fn slide() -> Files {
    sampled(
        "contact/slide",
        0.05,
        20,
        &[("box/px", &|t| stopping(2.0, 0.3 * G, t)), ("box/py", &|_| 0.05), ("box/pz", &|_| 0.0)],
    )
}

fn slope() -> Files {
    let angle = 20.0_f64.to_radians();
    let (s, c) = (sin(angle), cos(angle));
    let way = move |t: f64| 0.5 * G * (s - 0.2 * c) * t * t;
    let (x, y) = (0.05 * s, 0.05 * c);
    sampled(
        "contact/slope",
        0.05,
        20,
        &[
            ("staying/px", &|_| x),
            ("staying/py", &|_| y),
            ("sliding/px", &|t| x + way(t) * c),
            ("sliding/py", &|t| y - way(t) * s),
        ],
    )
}

/// Sliding ends at t = 2 v / (7 μ g), with 5/7 of the speed.
fn roll() -> Files {
    let (speed, deceleration) = (2.0, 0.2 * G);
    let rolls_from = 2.0 * speed / (7.0 * deceleration);
    let way =
        move |t: f64| stopping(speed, deceleration, t.min(rolls_from)) + 5.0 / 7.0 * speed * (t - rolls_from).max(0.0);
    let spin = move |t: f64| -2.5 * deceleration / 0.05 * t.min(rolls_from);
    sampled("contact/roll", 0.05, 20, &[("ball/px", &way), ("ball/wz", &spin)])
}

fn stack() -> Files {
    let times = seconds(0.3, 0.05, 4);
    let columns = [("lower/floor/fy", 4.5 * G), ("upper/lower/fy", 1.5 * G), ("lower/floor/fx", 0.0)];
    let columns = columns.iter().map(|(name, force)| column(name, &times, |_: f64| *force)).collect();
    ("contact/stack", vec![("reference.csv", csv(&times, columns))])
}

// ---- The paper ----

/// A polynomial of degree five from rest to rest: value, rate, acceleration.
fn quintic(from: [f64; 2], to: [f64; 2], t: f64) -> [f64; 3] {
    let (length, delta) = (to[0] - from[0], to[1] - from[1]);
    let u = (t - from[0]) / length;
    let (u2, u3) = (u * u, u * u * u);
    [
        from[1] + delta * u3 * (10.0 - 15.0 * u + 6.0 * u2),
        delta * 30.0 * u2 * (1.0 - 2.0 * u + u2) / length,
        delta * 60.0 * u * (1.0 - 3.0 * u + 2.0 * u2) / (length * length),
    ]
}

fn quintics() -> Files {
    let stops = [[0.0, 0.0], [0.16, -18.0], [0.42, -4.0], [0.72, -62.0], [1.0, 0.0]];
    let stops = stops.map(|[t, angle]: [f64; 2]| [t, angle.to_radians()]);
    let at = move |t: f64| {
        let next = stops.iter().position(|stop| t < stop[0]).unwrap_or(stops.len() - 1);
        quintic(stops[next - 1], stops[next], t)
    };
    let torque = move |t: f64| {
        let [angle, _, acceleration] = at(t);
        (0.0614 + 3.76 * 0.2214 * 0.2214) * acceleration + 3.76 * G * 0.2214 * sin(angle)
    };
    sampled(
        "paper/quintics",
        0.02,
        50,
        &[("knee/value", &|t| at(t)[0]), ("knee/rate", &|t| at(t)[1]), ("knee/effort", &torque)],
    )
}

/// Crank and rocker have the same angle, and the coupler moves without turning.
fn closed_loop() -> Files {
    let [offset, amplitude] = [60.0_f64.to_radians(), 35.0_f64.to_radians()];
    let drive = Wave { offset, amplitude, frequency_hz: 0.8, phase: 0.0 };
    let (crank, coupler, rocker, length) = (1.0, 2.0, 1.5, 0.3);
    let torque = move |t: f64| {
        let [angle, _, acceleration] = drive.at(t);
        let inertia = (crank + rocker) * length * length / 3.0 + coupler * length * length;
        inertia * acceleration + (0.5 * (crank + rocker) + coupler) * G * length * cos(angle)
    };
    sampled("paper/closed-loop", 0.02, 50, &[("motor/value", &|t| drive.at(t)[0]), ("motor/effort", &torque)])
}

fn landing() -> Files {
    let lands_at = (2.0 * 0.2 / G).sqrt();
    let way = move |t: f64| 2.0 * t.min(lands_at) + 5.0 / 7.0 * 2.0 * (t - lands_at).max(0.0);
    let columns: [(&str, &dyn Fn(f64) -> f64); 2] = [("ball/px", &way), ("ball/py", &|t| 0.1 + bouncing(0.2, 0.0, t))];
    sampled("paper/landing", 0.05, 16, &columns)
}

/// Table 1 of the paper, mass of the segments in percent, for its body of 80 kg.
fn table_1() -> Files {
    let segments = [
        ("femur_r", 7.92),
        ("femur_l", 7.92),
        ("tibia_r", 4.70),
        ("tibia_l", 4.70),
        ("humerus_r", 2.96),
        ("humerus_l", 2.96),
    ];
    let columns = segments.map(|(name, percent)| (format!("{name}/mass_kg"), vec![0.8 * percent])).to_vec();
    ("paper/figure", vec![("reference.csv", csv(&[0.0], columns))])
}
