//! Result of residual reduction: the corrected motion, its corrections and the remaining residual.

use crate::kinematics::Trajectory;
use crate::model::{CoordinateKind, Model};
use crate::spatial::{Vec3, Wrench};
use std::ops::Range;

/// A motion changed within its noise so that it obeys Newton's laws under given loads.
#[derive(Debug, Clone)]
pub struct ReducedMotion {
    /// The corrected motion.
    pub trajectory: Trajectory,
    /// The given model; its mass and trunk are changed where the settings allow it.
    pub model: Model,
    /// Residual before the correction, inside the window.
    pub residual_before: RootResidual,
    /// Residual after the correction, inside the window.
    pub residual_after: RootResidual,
    /// Correction of each free coordinate.
    pub changes: Vec<CoordinateChange>,
    /// Displacement of each body that carries a load.
    pub feet: Vec<FootChange>,
    /// All masses and inertias were multiplied by 1 + this.
    pub mass_share: f64,
    /// Name of the trunk segment.
    pub trunk: String,
    /// Displacement of its mass centre, in its own axes [m].
    pub trunk_center_m: Vec3,
    /// First and last instant at which Newton's laws were enforced [s].
    pub window_s: [f64; 2],
    /// Number of iterations.
    pub iterations: usize,
    /// Whether the iteration converged.
    pub converged: bool,
}

/// Size of the residual at the root.
#[derive(Debug, Clone, Copy, PartialEq, Default, serde::Serialize, serde::Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(rename = "ResidualSize"))]
pub struct RootResidual {
    /// Root mean square of the force in body weights.
    pub force_rms_bw: f64,
    /// Largest force in body weights.
    pub force_peak_bw: f64,
    /// Root mean square of the moment about the root joint [N.m].
    pub moment_rms_nm: f64,
    /// Largest moment [N.m].
    pub moment_peak_nm: f64,
}

/// Correction of one coordinate.
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

/// Displacement of a body that carries a load.
#[derive(Debug, Clone, PartialEq)]
pub struct FootChange {
    /// Name of the body.
    pub body: String,
    /// Root mean square displacement of its mass centre inside the window [m].
    pub rms_m: f64,
    /// Largest displacement anywhere [m].
    pub max_m: f64,
    /// Largest rotation [rad].
    pub max_rad: f64,
}

impl ReducedMotion {
    /// Whether the RMS residual force is below this share of body weight, and the RMS residual moment below this share
    /// of body weight times 1 m.
    #[must_use]
    pub fn obeys(&self, share: f64) -> bool {
        let weight = self.model.mass() * self.model.gravity().norm();
        self.residual_after.force_rms_bw < share && self.residual_after.moment_rms_nm < share * weight
    }

    /// Largest correction of an angle [rad].
    #[must_use]
    pub fn largest_angle(&self) -> f64 {
        self.changes.iter().filter(|c| c.unit == "rad").map(|c| c.max).fold(0.0, f64::max)
    }
}

impl RootResidual {
    /// Computes the summary from the residual wrenches at the root and the body weight [N].
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
    /// Computes the change of a coordinate from its values before and after.
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

/// Root mean square and largest magnitude.
pub(super) fn rms_and_largest(values: impl Iterator<Item = f64>) -> (f64, f64) {
    let (mut squares, mut largest, mut count) = (0.0, 0.0_f64, 0_usize);
    for value in values {
        squares += value * value;
        largest = largest.max(value.abs());
        count += 1;
    }
    ((squares / count.max(1) as f64).sqrt(), largest)
}
