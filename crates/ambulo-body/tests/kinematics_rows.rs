//! Residuals and derivatives of the markers of one instant, for least-squares problems with additional unknowns.

use ambulo_body::internals::MarkerRows;
use ambulo_body::model::{
    Body, Coordinate, CoordinateId, CoordinateKind, Displacement, Drive, Function, Joint, JointAxis, JointSpeeds,
    Marker, Model,
};
use ambulo_body::motion::{MarkerPath, MarkerRecording};
use ambulo_body::spatial::{Inertia, Mat3, Pose, Vec3};

/// A free body, a hinge with a sliding centre, an ellipsoid, and a coupled hinge on it.
fn model() -> Model {
    let line = |c: usize| Displacement::Follows(CoordinateId(c), Function::Linear { slope: 1.0, intercept: 0.0 });
    let axis = |direction: Vec3, displacement| JointAxis { direction: direction.normalize(), displacement };
    let xyz = |c: usize| vec![axis(Vec3::x(), line(c)), axis(Vec3::y(), line(c + 1)), axis(Vec3::z(), line(c + 2))];
    let slide = Function::Polynomial(vec![0.02, -0.05, 0.01]);
    let joint = |i: usize, rotations, translations, speeds| Joint {
        name: format!("j{i}"),
        parent: i.checked_sub(1).map(ambulo_body::model::BodyId),
        parent_from_joint: Pose::at(Vec3::new(0.1, -0.3, 0.05)),
        child_from_joint: Pose {
            rotation: Mat3::new(0., 1., 0., 0., 0., 1., 1., 0., 0.),
            translation: Vec3::new(0.02, 0.03, 0.0),
        },
        rotations,
        translations,
        speeds,
    };
    let joints = [
        joint(0, xyz(0), xyz(3), JointSpeeds::AngularVelocity),
        joint(
            1,
            vec![axis(Vec3::new(0.2, 0.1, 1.0), line(6))],
            vec![axis(Vec3::x(), Displacement::Follows(CoordinateId(6), slide))],
            JointSpeeds::Rates,
        ),
        joint(2, xyz(7), Vec::new(), JointSpeeds::Ellipsoid(Vec3::new(0.1, 0.2, 0.15))),
        joint(3, vec![axis(Vec3::y(), line(10))], Vec::new(), JointSpeeds::Rates),
    ];
    let inertia = Inertia::new(1.0, Vec3::zeros(), Mat3::identity()).unwrap();
    let bodies = joints.into_iter().enumerate().map(|(i, joint)| Body { name: format!("b{i}"), inertia, joint });
    let coordinate = |i: usize| Coordinate {
        name: format!("q{i}"),
        kind: CoordinateKind::Rotation,
        default_value: 0.0,
        range: None,
        clamped: false,
        drive: match i {
            10 => Drive::Coupled(CoordinateId(6), Function::Polynomial(vec![0.5, 0.8, 0.1])),
            _ => Drive::Free,
        },
    };
    let marker = |i: usize| Marker {
        name: format!("m{i}"),
        body: Some(ambulo_body::model::BodyId(i / 2)),
        location: Vec3::new(0.1, 0.05 * i as f64, -0.1),
        fixed: false,
    };
    let coordinates = (0..11).map(coordinate).collect();
    Model::new("rows", Vec3::zeros(), bodies.collect(), coordinates, (0..8).map(marker).collect()).unwrap()
}

fn recording() -> MarkerRecording {
    let path = |i: usize| MarkerPath {
        name: format!("m{i}"),
        positions: vec![Vec3::new(0.3 + 0.01 * i as f64, -0.2, 0.1 * i as f64)],
    };
    MarkerRecording { name: "rows".into(), rate_hz: 1.0, times: vec![0.0], markers: (0..8).map(path).collect() }
}

#[test]
fn derivatives_are_those_of_finite_differences() {
    let (model, recording) = (model(), recording());
    let mut rows = MarkerRows::new(&model, &recording).unwrap();
    let x: Vec<f64> = (0..10).map(|i| 0.4 * (1.3 * f64::from(i) + 0.5).sin()).collect();
    // Central differences of step h miss by h² f'''/6, 2e-11, and by rounding, 1e-16 / h.
    const H: f64 = 1e-5;
    for u in 0..10 {
        let at = |rows: &mut MarkerRows, step: f64| {
            let mut other = x.clone();
            other[u] += step;
            rows.pose_at(&other);
            rows.residuals().to_vec()
        };
        let (up, down) = (at(&mut rows, H), at(&mut rows, -H));
        rows.pose_at(&x);
        for marker in 0..8 {
            let row = rows.row(marker);
            let parts = row.unknowns.iter().zip(row.derivatives).filter(|(k, _)| **k == u);
            let found: Vec3 = parts.map(|(_, d)| d).sum();
            let expected = (up[marker] - down[marker]) / (2.0 * H);
            assert!((found - expected).norm() < 1e-9, "marker {marker} by {u}: {found} for {expected}");
        }
    }
}

/// The composite method gives the same equations as the rows, also with zero weights.
#[test]
fn the_normal_equations_are_those_of_the_rows() {
    let (model, recording) = (model(), recording());
    let mut rows = MarkerRows::new(&model, &recording).unwrap();
    let x: Vec<f64> = (0..10).map(|i| 0.4 * (0.7 * f64::from(i) - 0.5).sin()).collect();
    rows.pose_at(&x);
    let weights = [1.0, 0.0, 2.0, 0.5, 1.0, 3.0, 0.0, 1.5];
    let (entries, found_right) = rows.normal_equations(&weights);
    let mut matrix = vec![0.0; 100];
    let mut right = [0.0; 10];
    for (marker, weight) in weights.iter().enumerate() {
        let row = rows.row(marker);
        let mut dense = [Vec3::zeros(); 10];
        row.unknowns.iter().zip(row.derivatives).for_each(|(u, d)| dense[*u] += d);
        for a in 0..10 {
            right[a] -= weight * dense[a].dot(&row.residual);
            (0..=a).for_each(|b| matrix[a * 10 + b] += weight * dense[a].dot(&dense[b]));
        }
    }
    let mut found = vec![0.0; 100];
    entries.into_iter().for_each(|(a, b, entry)| found[a.max(b) * 10 + a.min(b)] = entry);
    for a in 0..10 {
        assert!((found_right[a] - right[a]).abs() < 1e-12, "right side {a}");
        for b in 0..=a {
            assert!((found[a * 10 + b] - matrix[a * 10 + b]).abs() < 1e-12, "entry {a}, {b}");
        }
    }
}
