//! The angles of a joint that bring it closest to a rotation.
//!
//! max_q tr(R(q)^T R)      closest in the angle of the remaining rotation
//!
//! With three perpendicular axes there are two exact solutions; the one nearer to the angles of the frame before is
//! taken. With fewer axes, each angle in turn takes its best value while the others stay: for R(q) = A R(a, θ) B,
//! tr(R(q)^T R) = tr(R(a, θ)^T M) with M = A^T R B^T, which is largest at
//!
//!   θ = atan2(a · v, tr M - a · M a)        v = (M32 - M23, M13 - M31, M21 - M12)
//!
//! One axis needs one round; two perpendicular axes converge in a few.

use super::super::calibration::angles_zxy;
use crate::model::{Displacement, Joint};
use crate::numerics::elementary::atan2;
use crate::spatial::{Mat3, Vec3, rotation_about};
use std::f64::consts::{PI, TAU};

/// Rounds over the axes; two axes at 60 degrees need about 30 to reach rounding.
const ROUNDS: usize = 60;
/// Change of the angles at which the rounds end [rad].
const SMALLEST_CHANGE: f64 = 1e-12;
/// Largest product of perpendicular axes.
const PERPENDICULAR: f64 = 1e-9;

/// The axes of a joint with its latest angles.
#[derive(Debug, Clone)]
pub struct JointAngles {
    axes: Vec<Vec3>,
    /// Angles [rad].
    pub angles: Vec<f64>,
    /// Columns: second, third and first axis, if there are three that are perpendicular.
    perpendicular: Option<Mat3>,
}

/// Rotation about an axis [rad].
pub fn turn_about(axis: Vec3, angle: f64) -> Mat3 {
    rotation_about(axis.normalize(), angle)
}

impl JointAngles {
    /// All angles are zero.
    pub fn new(joint: &Joint) -> JointAngles {
        let axes: Vec<Vec3> = joint.rotations.iter().map(|axis| axis.direction).collect();
        let perpendicular = match axes[..] {
            [first, second, third] => Some(Mat3::from_columns(&[second, third, first])),
            _ => None,
        };
        let is_square = |frame: &Mat3| (frame.transpose() * frame - Mat3::identity()).amax() < PERPENDICULAR;
        JointAngles { angles: vec![0.0; axes.len()], perpendicular: perpendicular.filter(is_square), axes }
    }

    /// The reachable rotation nearest to `wanted`; its angles are kept.
    pub fn nearest(&mut self, wanted: &Mat3) -> Mat3 {
        match self.perpendicular {
            Some(frame) => self.angles = exact(&frame, wanted, &self.angles),
            None => self.improve(wanted),
        }
        self.rotation()
    }

    /// The rotation at the current angles.
    pub fn rotation(&self) -> Mat3 {
        self.axes.iter().zip(&self.angles).fold(Mat3::identity(), |all, (axis, angle)| all * turn_about(*axis, *angle))
    }

    fn improve(&mut self, wanted: &Mat3) {
        for _ in 0..ROUNDS {
            let mut change = 0.0;
            for k in 0..self.axes.len() {
                let product = |range: std::ops::Range<usize>| {
                    range.fold(Mat3::identity(), |all, i| all * turn_about(self.axes[i], self.angles[i]))
                };
                let (before, after) = (product(0..k), product(k + 1..self.axes.len()));
                let m = before.transpose() * wanted * after.transpose();
                let axis = self.axes[k];
                let v = Vec3::new(m.m32 - m.m23, m.m13 - m.m31, m.m21 - m.m12);
                let best = atan2(axis.dot(&v), m.trace() - axis.dot(&(m * axis)));
                let best = near(best, self.angles[k]);
                change = f64::max(change, (best - self.angles[k]).abs());
                self.angles[k] = best;
            }
            if change < SMALLEST_CHANGE {
                break;
            }
        }
    }

    /// Writes the angles to the coordinates of the joint.
    pub(super) fn write(&self, joint: &Joint, values: &mut [f64]) {
        for (axis, angle) in joint.rotations.iter().zip(&self.angles) {
            write_displacement(&axis.displacement, *angle, values);
        }
    }

    /// Writes a translation in the joint frame to the coordinates of the joint.
    pub fn write_translation(&self, joint: &Joint, translation: Vec3, values: &mut [f64]) {
        for axis in &joint.translations {
            write_displacement(&axis.displacement, axis.direction.dot(&translation), values);
        }
    }
}

/// Axes of the built-in body follow one coordinate each, with slope 1.
fn write_displacement(displacement: &Displacement, value: f64, values: &mut [f64]) {
    if let Displacement::Follows(coordinate, _) = displacement {
        values[coordinate.index()] = value;
    }
}

/// Both solutions for three perpendicular axes; returns the one nearer to `before`. Axes that are left-handed count
/// backwards.
fn exact(frame: &Mat3, wanted: &Mat3, before: &[f64]) -> Vec<f64> {
    let sign = frame.determinant().signum();
    let [a, b, c] = angles_zxy(&(frame.transpose() * wanted * frame)).map(|angle| sign * angle);
    let solutions = [[a, b, c], [a + PI, PI - b, c + PI]];
    let beside = |solution: [f64; 3]| -> Vec<f64> {
        solution.iter().zip(before).map(|(angle, before)| near(*angle, *before)).collect()
    };
    let distance = |solution: &[f64]| -> f64 { solution.iter().zip(before).map(|(a, b)| (a - b).abs()).sum() };
    let [first, second] = solutions.map(beside);
    if distance(&second) < distance(&first) { second } else { first }
}

/// The same angle in the turn nearest to `before` [rad].
fn near(angle: f64, before: f64) -> f64 {
    angle - TAU * ((angle - before) / TAU).round()
}
