//! The joint whose child is at the end of an arc: elementary geometry, energy, and markers that are fitted back.

use ambulo::dynamics::{Workspace, inverse_frame};
use ambulo::findings::Findings;
use ambulo::kinematics::marker_fit::{FitSettings, fit_markers};
use ambulo::kinematics::{Posture, body_motion};
use ambulo::model::{Model, from_osim, to_osim};
use ambulo::motion::{MarkerPath, MarkerRecording};
use ambulo::spatial::{Mat3, Vec3};
use ambulo_formats::osim::OsimModel;

const LENGTH: f64 = 0.4;

/// Ground - pin - base - arc - top, with rotated frames at the arc if `turned`.
fn spine(turned: bool) -> Model {
    let at = |place: &str, turn: &str| match turned {
        true => format!("<translation>{place}</translation><orientation>{turn}</orientation>"),
        false => String::new(),
    };
    let body = |name: &str, kg: f64| {
        format!(
            "<Body name=\"{name}\"><mass>{kg}</mass><mass_center>0.03 0.1 0.02</mass_center><inertia>0.02 0.03 0.04 \
             0.001 -0.002 0.003</inertia></Body>"
        )
    };
    let marker = |name: &str, place: &str| {
        format!(
            "<Marker \
             name=\"{name}\"><socket_parent_frame>/bodyset/top</socket_parent_frame><location>{place}</location>\
             </Marker>"
        )
    };
    let text = format!(
        "<OpenSimDocument Version=\"40500\"><Model name=\"spine\"><gravity>0 -9.81 \
         0</gravity><BodySet><objects>{}{}</objects></BodySet><JointSet><objects>\
         <PinJoint \
         name=\"root\"><socket_parent_frame>/ground</socket_parent_frame><socket_child_frame>\
         /bodyset/base</socket_child_frame>\
         <coordinates><Coordinate name=\"r\"/></coordinates></PinJoint>\
         <ConstantCurvatureJoint \
         name=\"arc\"><socket_parent_frame>p</socket_parent_frame><socket_child_frame>c</socket_child_frame>\
         <coordinates><Coordinate name=\"a\"/><Coordinate name=\"b\"/><Coordinate name=\"c\"/></coordinates><frames>\
         <PhysicalOffsetFrame name=\"p\"><socket_parent>/bodyset/base</socket_parent>{}</PhysicalOffsetFrame>\
         <PhysicalOffsetFrame name=\"c\"><socket_parent>/bodyset/top</socket_parent>{}</PhysicalOffsetFrame></frames>\
         <neutral_angle_x_z_y>{}</neutral_angle_x_z_y><length>{LENGTH}</length></ConstantCurvatureJoint></objects>\
         </JointSet>\
         <MarkerSet><objects>{}{}{}{}</objects></MarkerSet></Model></OpenSimDocument>",
        body("base", 3.0),
        body("top", 2.0),
        at("0.1 -0.2 0.3", "0.2 -0.3 0.4"),
        at("0.05 0.1 -0.02", "-0.1 0.2 0.15"),
        if turned { "0.1 -0.2 0.05" } else { "0 0 0" },
        marker("m1", "0.1 0 0"),
        marker("m2", "0 0.2 0"),
        marker("m3", "0 0 0.15"),
        marker("m4", "-0.1 0.1 -0.1"),
    );
    from_osim(&OsimModel::read(text.as_bytes()).unwrap(), &mut Findings::default()).unwrap()
}

fn about(axis: Vec3, angle: f64) -> Mat3 {
    *nalgebra::Rotation3::new(axis * angle).matrix()
}

#[test]
fn the_child_is_at_the_end_of_an_arc_and_turned_about_x_z_y() {
    let model = spine(false);
    let still = [0.0; 4];
    for [a, b, c] in [
        [0.0, 0.0, 0.0],
        [0.4, -0.3, 0.5],
        [1.2, 0.2, -0.4],
        [1e-5, 0.0, 0.3],
        [0.0, 0.19999, 0.0],
        [0.0, 0.20001, 0.0],
    ] {
        let q = [0.0, a, b, c];
        let top = body_motion(&model, Posture { q: &q, qd: &still, qdd: &still })[1].pose;
        let rotation = about(Vec3::x(), a) * about(Vec3::z(), b) * about(Vec3::y(), c);
        assert!((top.rotation - rotation).amax() < 1e-14);
        // An arc of the radius d / θ in the plane of y and the end's direction.
        let n = rotation * Vec3::y();
        let across = (n - Vec3::y() * n.y).try_normalize(1e-12).unwrap_or(Vec3::x());
        let angle = n.dot(&across).atan2(n.y);
        let expected = match angle < 1e-4 {
            true => across * (0.5 * LENGTH * angle) + Vec3::y() * LENGTH,
            false => (across * (1.0 - angle.cos()) + Vec3::y() * angle.sin()) * (LENGTH / angle),
        };
        // Where the rod is straight, the expected place is off by its square, 1e-10.
        assert!((top.translation - expected).norm() < 2e-10, "{a} {b} {c}: {} for {expected}", top.translation);
    }
}

/// A motion with all derivatives.
fn motion(t: f64) -> [Vec<f64>; 3] {
    let wave = |k: usize| (0.3 + 0.1 * k as f64, 1.0 + 0.7 * k as f64, 0.4 * k as f64);
    let of = |f: &dyn Fn((f64, f64, f64)) -> f64| (0..4).map(|k| f(wave(k))).collect();
    [
        of(&|(size, rate, phase)| size * (rate * t + phase).sin()),
        of(&|(size, rate, phase)| size * rate * (rate * t + phase).cos()),
        of(&|(size, rate, phase)| -size * rate * rate * (rate * t + phase).sin()),
    ]
}

/// Kinetic and potential energy.
fn energy(model: &Model, t: f64) -> f64 {
    let [q, qd, qdd] = motion(t);
    let moving = body_motion(model, Posture { q: &q, qd: &qd, qdd: &qdd });
    let of = |(body, moving): (&ambulo::model::Body, &ambulo::kinematics::BodyMotion)| {
        let (mass, rotation) = (body.inertia.mass(), moving.pose.rotation);
        let inertia = rotation * body.inertia.about_center() * rotation.transpose();
        let (omega, v) = (moving.twist.angular, moving.twist.linear);
        let center = moving.pose.place(body.inertia.center());
        0.5 * (mass * v.norm_squared() + omega.dot(&(inertia * omega))) - mass * model.gravity().dot(&center)
    };
    model.bodies().iter().zip(&moving).map(of).sum()
}

#[test]
fn generalised_forces_have_the_power_that_changes_the_energy() {
    let model = spine(true);
    let mut workspace = Workspace::new(&model);
    const STEP: f64 = 1e-3;
    for i in 0..20 {
        let t = 0.3 * f64::from(i);
        let [q, qd, qdd] = motion(t);
        let tau = inverse_frame(&mut workspace, Posture { q: &q, qd: &qd, qdd: &qdd }, &[]).generalized().to_vec();
        let power: f64 = tau.iter().zip(&qd).map(|(tau, rate)| tau * rate).sum();
        // Differences of fourth order: their error is some STEP⁴.
        let e = |k: f64| energy(&model, t + k * STEP);
        let rate = (8.0 * (e(1.0) - e(-1.0)) - (e(2.0) - e(-2.0))) / (12.0 * STEP);
        assert!((power - rate).abs() < 1e-8 * (1.0 + rate.abs()), "{t} s: {power} W for {rate} W");
    }
}

#[test]
fn velocities_and_accelerations_are_derivatives_of_the_place() {
    let model = spine(true);
    let top = |t: f64| {
        let [q, qd, qdd] = motion(t);
        body_motion(&model, Posture { q: &q, qd: &qd, qdd: &qdd }).remove(1)
    };
    let center = |t: f64| top(t).pose.place(model.bodies()[1].inertia.center());
    const STEP: f64 = 1e-3;
    for i in 0..20 {
        let t = 0.3 * f64::from(i);
        let difference = |f: &dyn Fn(f64) -> Vec3| {
            (8.0 * (f(t + STEP) - f(t - STEP)) - (f(t + 2.0 * STEP) - f(t - 2.0 * STEP))) / (12.0 * STEP)
        };
        assert!((top(t).twist.linear - difference(&center)).norm() < 1e-9);
        assert!((top(t).acceleration.linear - difference(&|t| top(t).twist.linear)).norm() < 1e-8);
    }
}

#[test]
fn markers_on_the_arc_are_fitted_back() {
    let model = spine(true);
    let postures: Vec<Vec<f64>> = (0..6).map(|i| motion(0.2 * f64::from(i))[0].clone()).collect();
    let still = [0.0; 4];
    let path = |marker: &ambulo::model::Marker| {
        let place =
            |q: &Vec<f64>| body_motion(&model, Posture { q, qd: &still, qdd: &still })[1].pose.place(marker.location);
        MarkerPath { name: marker.name.clone(), positions: postures.iter().map(place).collect() }
    };
    let times = (0..6).map(|i| 0.2 * f64::from(i)).collect();
    let markers = model.markers().iter().map(path).collect();
    let recording = MarkerRecording { name: "spine".into(), rate_hz: 5.0, times, markers };
    // The pin and the arc together have a direction that four markers on one body determine well enough.
    let fit = fit_markers(&model, &recording, &FitSettings::default(), &mut Findings::default()).unwrap();
    assert!(fit.rms_m.iter().all(|rms| *rms < 1e-6), "{:?}", fit.rms_m);
}

#[test]
fn an_arc_is_written_and_scaled() {
    let model = spine(true);
    let again = OsimModel::read(&to_osim(&model).unwrap().write().unwrap()).unwrap();
    let again = from_osim(&again, &mut Findings::default()).unwrap();
    let place = |model: &Model| {
        let (q, still) = ([0.1, 0.5, -0.4, 0.2], [0.0; 4]);
        body_motion(model, Posture { q: &q, qd: &still, qdd: &still })[1].pose
    };
    assert!((place(&again).translation - place(&model).translation).norm() < 1e-12);
    assert!((place(&again).rotation - place(&model).rotation).amax() < 1e-12);
    let twice = model.scaled(&[Vec3::repeat(2.0), Vec3::repeat(2.0)], None).unwrap();
    assert!((place(&twice).translation - 2.0 * place(&model).translation).norm() < 1e-12);
}
