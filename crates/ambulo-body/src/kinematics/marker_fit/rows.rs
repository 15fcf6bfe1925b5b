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
pub struct MarkerRows {
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
pub struct MarkerRow<'a> {
    /// p - m [m].
    pub residual: Vec3,
    /// The unknowns towards the root. May contain an unknown twice.
    pub unknowns: &'a [usize],
    /// Derivatives by these unknowns.
    pub derivatives: &'a [Vec3],
}

impl MarkerRows {
    /// The model is in its default posture.
    pub fn new(model: &Model, recording: &MarkerRecording) -> Result<MarkerRows, FitError> {
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
    pub fn pose_at(&mut self, x: &[f64]) {
        self.tree.pose_at(x);
        for ((residual, point), position) in self.residuals.iter_mut().zip(&self.points).zip(&self.positions) {
            *residual = self.tree.pose(point.node).place(point.place) - position;
        }
    }

    /// p - m at the current posture, one per visible marker [m].
    pub fn residuals(&self) -> &[Vec3] {
        &self.residuals
    }

    /// The row of a marker at the current posture.
    pub fn row(&mut self, marker: usize) -> MarkerRow<'_> {
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

    /// The normal equations at the current posture, as a fit assembles them: entries of the matrix with their row and
    /// column, and the right side.
    pub fn normal_equations(&self, weights: &[f64]) -> (Vec<(usize, usize, f64)>, Vec<f64>) {
        let mut normal = super::normal::Normal::new(&self.tree);
        normal
            .gather(&self.tree, &super::normal::Targets { points: &self.points, positions: &self.positions, weights });
        let entries = normal.branches.each_entry().map(|(row, column, entry)| (row, column, normal.matrix[entry]));
        (entries.collect(), normal.right)
    }
}
