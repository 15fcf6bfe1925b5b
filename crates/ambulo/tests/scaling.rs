//! Models brought to another size: as OpenSim does it, and back from a standing trial.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]
#![allow(clippy::print_stdout, reason = "the figures are shown with --nocapture")]

mod marker_data;

use ambulo::kinematics::{Posture, body_motion};
use ambulo::model::{Model, ScaleError};
use ambulo::spatial::Vec3;
use marker_data::{gait2392, rajagopal};
use std::path::Path;

/// Rows of a file of OpenSim's numbers: a name and values.
fn rows(file: &str) -> Vec<(String, Vec<f64>)> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/testdata/opensim_scale").join(file);
    let text = std::fs::read_to_string(path).unwrap();
    let row = |line: &str| {
        let (name, values) = line.split_once(',').unwrap();
        (name.to_owned(), values.split(',').map(|v| v.parse().unwrap()).collect())
    };
    text.lines().skip(1).map(row).collect()
}

/// Places of the markers in ground, in the model's order [m].
fn places(model: &Model, q: &[f64]) -> Vec<Vec3> {
    let zeros = vec![0.0; q.len()];
    let bodies = body_motion(model, Posture { q, qd: &zeros, qdd: &zeros });
    let place = |m: &ambulo::model::Marker| m.body.map_or(m.location, |id| bodies[id.index()].pose.place(m.location));
    model.markers().iter().map(place).collect()
}

fn assert_scales_as_opensim(model: &Model, name: &str) {
    let bodies = rows(&format!("{name}_bodies.csv"));
    let of = |body: &str| &bodies.iter().find(|(b, _)| b == body).unwrap().1;
    let factors: Vec<Vec3> = model.bodies().iter().map(|b| Vec3::from_column_slice(&of(&b.name)[..3])).collect();
    let scaled = model.scaled(&factors, Some(77.0)).unwrap();
    let mut worst = [0.0_f64; 2];
    for body in scaled.bodies() {
        let row = of(&body.name);
        let (center, i) = (body.inertia.center(), body.inertia.about_center());
        let ours = [body.inertia.mass(), center.x, center.y, center.z, i.m11, i.m22, i.m33, i.m12, i.m13, i.m23];
        for (ours, theirs) in ours.iter().zip(&row[3..]) {
            worst[0] = worst[0].max((ours - theirs).abs());
            assert!((ours - theirs).abs() < 1e-8, "{name}, {}: {ours} instead of {theirs}", body.name);
        }
    }
    let posture = rows(&format!("{name}_posture.csv"));
    let value = |c: &str| posture.iter().find(|(n, _)| n == c).unwrap().1[0];
    let q: Vec<f64> = scaled.coordinates().iter().map(|c| value(&c.name)).collect();
    let theirs = rows(&format!("{name}_markers.csv"));
    for (marker, place) in scaled.markers().iter().zip(places(&scaled, &q)) {
        let (_, there) = theirs.iter().find(|(n, _)| *n == marker.name).unwrap();
        let miss = (place - Vec3::from_column_slice(there)).norm();
        worst[1] = worst[1].max(miss);
        assert!(miss < 1e-7, "{name}, marker {}: {miss} m", marker.name);
    }
    println!("{name}: largest difference of masses and inertias {:.1e}, of marker places {:.1e} m", worst[0], worst[1]);
    assert!((scaled.mass() - 77.0).abs() < 1e-9);
}

#[test]
fn models_scale_as_opensim_scales_them() {
    if let (Some(a), Some(b)) = (rajagopal(), gait2392()) {
        assert_scales_as_opensim(&a.model, "rajagopal");
        assert_scales_as_opensim(&b.model, "gait2392");
    }
}

#[test]
fn sizes_that_are_none_are_refused() {
    let Some(subject) = gait2392() else { return };
    let ones = vec![Vec3::repeat(1.0); subject.model.bodies().len()];
    assert!(matches!(subject.model.scaled(&ones[1..], None), Err(ScaleError::Count { .. })));
    let mut flat = ones.clone();
    flat[3].y = 0.0;
    let message = subject.model.scaled(&flat, None).unwrap_err().to_string();
    assert!(message.contains(&subject.model.bodies()[3].name) && message.contains("above zero"), "{message}");
    assert!(matches!(subject.model.scaled(&ones, Some(-1.0)), Err(ScaleError::Mass { .. })));
}
