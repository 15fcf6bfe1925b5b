//! Residuals and derivatives of the markers of one instant, for least-squares problems with additional unknowns.

use super::problem::FitProblem;
use super::result::FitError;
use super::settings::FitSettings;
use super::tree::MarkerTree;
use crate::findings::Findings;
use crate::model::Model;
use crate::motion::MarkerRecording;
use crate::spatial::Vec3;

/// The common markers of a model and the first frame of a recording.
#[derive(Debug, Clone)]
pub(crate) struct MarkerRows {
    tree: MarkerTree,
    points: Vec<super::normal::Point>,
    positions: Vec<Vec3>,
    /// p - m, one per marker [m].
    residuals: Vec<Vec3>,
    numbers: Vec<usize>,
    derivatives: Vec<Vec3>,
}

/// One marker: p - m [m], and its derivatives by the unknowns towards the root [m/rad or 1].
#[derive(Debug, Clone, Copy)]
pub(crate) struct MarkerRow<'a> {
    pub(crate) residual: Vec3,
    /// May contain an unknown twice.
    pub(crate) unknowns: &'a [usize],
    pub(crate) derivatives: &'a [Vec3],
}

impl MarkerRows {
    pub(crate) fn new(model: &Model, recording: &MarkerRecording) -> Result<MarkerRows, FitError> {
        let settings = FitSettings::default();
        let mut problem = FitProblem::new(model, recording, &settings, &mut Findings::default())?;
        problem.load(0, |_| true, |i| i);
        let seen: Vec<usize> = (0..problem.points.len()).filter(|&i| problem.frame_weights[i] > 0.0).collect();
        let mut rows = MarkerRows {
            points: seen.iter().map(|&i| problem.points[i]).collect(),
            positions: seen.iter().map(|&i| problem.positions[i]).collect(),
            residuals: vec![Vec3::zeros(); seen.len()],
            numbers: Vec::new(),
            derivatives: Vec::new(),
            tree: problem.tree,
        };
        let default: Vec<f64> =
            (0..rows.unknowns()).map(|u| model.coordinates()[rows.coordinate(u)].default_value).collect();
        rows.pose_at(&default);
        Ok(rows)
    }

    /// Number of unknown coordinates.
    pub(crate) fn unknowns(&self) -> usize {
        self.tree.unknowns()
    }

    /// The coordinate that is this unknown.
    pub(crate) fn coordinate(&self, unknown: usize) -> usize {
        self.tree.coordinate(unknown)
    }

    /// The unknown that is this coordinate.
    pub(crate) fn unknown_of(&self, coordinate: usize) -> Option<usize> {
        (0..self.unknowns()).find(|&u| self.tree.coordinate(u) == coordinate)
    }

    /// Puts the model into a posture.
    pub(crate) fn pose_at(&mut self, x: &[f64]) {
        self.tree.pose_at(x);
        for ((residual, point), position) in self.residuals.iter_mut().zip(&self.points).zip(&self.positions) {
            *residual = self.tree.pose(point.node).place(point.place) - position;
        }
    }

    /// p - m at the current posture, one per visible marker [m].
    pub(crate) fn residuals(&self) -> &[Vec3] {
        &self.residuals
    }

    /// The row of a marker at the current posture.
    pub(crate) fn row(&mut self, marker: usize) -> MarkerRow<'_> {
        self.numbers.clear();
        self.derivatives.clear();
        let residual = self.residuals[marker];
        let arm = residual + self.positions[marker] - self.tree.reference();
        let mut next = Some(self.points[marker].node);
        while let Some(node) = next {
            for column in self.tree.columns(node) {
                self.numbers.push(column.unknown);
                self.derivatives.push(column.linear + column.angular.cross(&arm));
            }
            next = self.tree.parent(node);
        }
        MarkerRow { residual, unknowns: &self.numbers, derivatives: &self.derivatives }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{
        Body, Coordinate, CoordinateId, CoordinateKind, Displacement, Drive, Function, Joint, JointAxis, JointSpeeds,
        Marker,
    };
    use crate::motion::MarkerPath;
    use crate::spatial::{Inertia, Mat3, Pose};

    /// A free body, a hinge with a sliding centre, an ellipsoid, and a coupled hinge on it.
    fn model() -> Model {
        let line = |c: usize| Displacement::Follows(CoordinateId(c), Function::Linear { slope: 1.0, intercept: 0.0 });
        let axis = |direction: Vec3, displacement| JointAxis { direction: direction.normalize(), displacement };
        let xyz = |c: usize| vec![axis(Vec3::x(), line(c)), axis(Vec3::y(), line(c + 1)), axis(Vec3::z(), line(c + 2))];
        let slide = Function::Polynomial(vec![0.02, -0.05, 0.01]);
        let joint = |i: usize, rotations, translations, speeds| Joint {
            name: format!("j{i}"),
            parent: i.checked_sub(1).map(crate::model::BodyId),
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
            body: Some(crate::model::BodyId(i / 2)),
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
        use super::super::normal::{Normal, Targets};
        let (model, recording) = (model(), recording());
        let mut rows = MarkerRows::new(&model, &recording).unwrap();
        let x: Vec<f64> = (0..10).map(|i| 0.4 * (0.7 * f64::from(i) - 0.5).sin()).collect();
        rows.pose_at(&x);
        let weights = [1.0, 0.0, 2.0, 0.5, 1.0, 3.0, 0.0, 1.5];
        let mut normal = Normal::new(&rows.tree);
        let targets = Targets { points: &rows.points, positions: &rows.positions, weights: &weights };
        normal.gather(&rows.tree, &targets);
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
        normal.branches.each_entry().for_each(|(a, b, entry)| found[a.max(b) * 10 + a.min(b)] = normal.matrix[entry]);
        for a in 0..10 {
            assert!((normal.right[a] - right[a]).abs() < 1e-12, "right side {a}");
            for b in 0..=a {
                assert!((found[a * 10 + b] - matrix[a * 10 + b]).abs() < 1e-12, "entry {a}, {b}");
            }
        }
    }
}
