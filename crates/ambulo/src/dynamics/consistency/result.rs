//! What was changed, and what remains.

use crate::kinematics::Trajectory;
use crate::model::{CoordinateKind, Model};
use crate::spatial::{Vec3, Wrench};
use std::ops::Range;

/// A motion that obeys Newton's laws under given loads as well as its noise allows.
#[derive(Debug, Clone)]
pub struct Consistent {
    /// The motion.
    pub trajectory: Trajectory,
    /// The body: as it was given but for mass and trunk, where these were allowed to change.
    pub model: Model,
    /// What nothing supplied before, inside the window.
    pub residual_before: RootResidual,
    /// What nothing supplies now, inside the window.
    pub residual_after: RootResidual,
    /// How each coordinate that may move was changed.
    pub changes: Vec<CoordinateChange>,
    /// How bodies that carry loads were moved.
    pub feet: Vec<FootChange>,
    /// How the body was changed.
    pub body: BodyChange,
    /// First and last instant of the frames in which laws were enforced [s].
    pub window_s: [f64; 2],
    /// Iterations taken.
    pub iterations: usize,
    /// Whether the last iteration changed nothing that counts.
    pub converged: bool,
}

/// What nothing supplies at the root: length of the force, and of the moment about the root's joint.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct RootResidual {
    /// Root mean square of the force [body weights].
    pub force_rms_bw: f64,
    /// Largest force [body weights].
    pub force_peak_bw: f64,
    /// Root mean square of the moment [N.m].
    pub moment_rms_nm: f64,
    /// Largest moment [N.m].
    pub moment_peak_nm: f64,
}

/// How a coordinate was changed: by radians or metres.
#[derive(Debug, Clone, PartialEq)]
pub struct CoordinateChange {
    /// Name of the coordinate.
    pub name: String,
    /// Root mean square inside the window [rad or m].
    pub rms: f64,
    /// Largest size anywhere [rad or m].
    pub max: f64,
    /// `rad` or `m`.
    pub unit: &'static str,
}

/// How a body that carries a load was moved.
#[derive(Debug, Clone, PartialEq)]
pub struct FootChange {
    /// Name of the body.
    pub body: String,
    /// Root mean square displacement of its mass centre inside the window [m].
    pub rms_m: f64,
    /// Largest displacement anywhere [m].
    pub max_m: f64,
    /// Largest angle by which it was turned [rad].
    pub max_rad: f64,
}

/// How the body was changed.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct BodyChange {
    /// All masses, and inertias with them, were multiplied by one and this.
    pub mass_share: f64,
    /// Name of the segment whose mass centre was moved.
    pub trunk: String,
    /// By how much, in its own axes [m].
    pub trunk_center_m: Vec3,
}

impl Consistent {
    /// Whether the force that remains is less than a share of body weight, rms, and the moment less than that share of body weight
    /// times a metre.
    #[must_use]
    pub fn obeys(&self, share: f64) -> bool {
        let weight = self.model.mass() * self.model.gravity().norm();
        self.residual_after.force_rms_bw < share && self.residual_after.moment_rms_nm < share * weight
    }

    /// The largest change of an angle [rad].
    #[must_use]
    pub fn largest_angle(&self) -> f64 {
        self.changes.iter().filter(|c| c.unit == "rad").map(|c| c.max).fold(0.0, f64::max)
    }
}

impl RootResidual {
    /// Of the wrenches at the root, with the body's weight [N].
    pub(super) fn of(wrenches: &[Wrench], weight: f64) -> RootResidual {
        let [force, moment] = [0, 1].map(|k| {
            let lengths = wrenches.iter().map(|w| if k == 0 { w.force.norm() } else { w.moment.norm() });
            rms_and_largest(lengths)
        });
        RootResidual {
            force_rms_bw: force.0 / weight,
            force_peak_bw: force.1 / weight,
            moment_rms_nm: moment.0,
            moment_peak_nm: moment.1,
        }
    }
}

impl CoordinateChange {
    /// Of a coordinate's values before and after.
    pub(super) fn of(
        model: &Model,
        coordinate: usize,
        before: &[f64],
        after: &[f64],
        window: Range<usize>,
    ) -> CoordinateChange {
        let coordinate = &model.coordinates()[coordinate];
        let differences: Vec<f64> = after.iter().zip(before).map(|(a, b)| a - b).collect();
        CoordinateChange {
            name: coordinate.name.clone(),
            rms: rms_and_largest(differences[window].iter().copied()).0,
            max: rms_and_largest(differences.iter().copied()).1,
            unit: if coordinate.kind == CoordinateKind::Translation { "m" } else { "rad" },
        }
    }
}

/// Root mean square and largest size.
pub(super) fn rms_and_largest(values: impl Iterator<Item = f64>) -> (f64, f64) {
    let (mut squares, mut largest, mut count) = (0.0, 0.0_f64, 0_usize);
    for value in values {
        squares += value * value;
        largest = largest.max(value.abs());
        count += 1;
    }
    ((squares / count.max(1) as f64).sqrt(), largest)
}
