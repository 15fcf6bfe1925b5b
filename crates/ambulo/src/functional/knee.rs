//! The axis of a knee from a movement: the symmetrical axis of rotation (SARA).
//!
//! The direction that is fixed in both segments,
//!
//!   min over unit a, b of  Σ_i |R_i a - S_i b|²
//!
//! for the rotations R of the thigh and S of the shank. The sum is 2 n - 2 aᵀ (Σ RᵀS) b, so that a and b are the
//! singular vectors of Σ RᵀS with the largest singular value.
//!
//! Source: Ehrig, Taylor, Duda, Heller 2007, J Biomech 40:2150 (abstract opened), who find the axis from the same sum.
//! Pinned by: tests/functional.rs

use super::MOST_FRAMES;
use super::hip::Rotated;
use super::segments::LegSegments;
use crate::motion::MarkerRecording;
use crate::numerics::elementary::atan2;
use crate::numerics::{counted, degrees, mean, range, sampled};
use crate::spatial::{Mat3, Vec3, rotation_vector};

/// Smallest range of the knee [rad]: that from which Ehrig 2006 found centres within 3 mm by most methods.
const LEAST_RANGE: f64 = 45.0 * std::f64::consts::PI / 180.0;
/// Largest part of the rotation that is not about the axis [rad]; a knee turns about its long axis by 10 to 15 degrees
/// while it bends.
const MOST_OFF: f64 = 15.0 * std::f64::consts::PI / 180.0;
/// Largest turn from the axis of the markers [rad]: palpated axes and wands are wrong by less.
const MOST_TURN: f64 = 30.0 * std::f64::consts::PI / 180.0;
const FEWEST_FRAMES: usize = 20;

/// The axis of a knee that a movement shows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FunctionalKnee {
    /// The axis in the frame of the thigh, to the right.
    pub axis: Vec3,
    /// Turn of the knee axis of the body about the long axis of the thigh that brings it to this one [rad].
    pub turn_rad: f64,
    /// Root mean square rotation that is not about the axis [rad].
    pub off_rad: f64,
    /// Range of flexion [rad].
    pub range_rad: f64,
}

/// The direction that is fixed in both segments, in the frame of each; `None` for fewer than two frames.
#[must_use]
pub fn symmetrical_axis(frames: &[Rotated]) -> Option<[Vec3; 2]> {
    let sum: Mat3 = frames.iter().map(|[a, b]| a.rotation.transpose() * b.rotation).sum();
    let svd = sum.try_svd(true, true, f64::EPSILON, 200)?;
    let most = svd.singular_values.imax();
    let (u, v_t) = (svd.u?, svd.v_t?);
    (frames.len() > 1).then(|| [u.column(most).into(), v_t.row(most).transpose()])
}

/// The axis of a knee of a calibrated body.
pub(super) fn axis(leg: &LegSegments<'_>, movement: &MarkerRecording) -> Result<FunctionalKnee, String> {
    let refused = |why: String| Err(format!("the movement does not show the axis of the {} knee: {why}", leg.side));
    let both = |frame| leg.poses(frame).map(|[_, thigh, shank]| [thigh, shank]);
    let frames: Vec<Rotated> = sampled(movement.frames(), MOST_FRAMES).filter_map(both).collect();
    if frames.len() < FEWEST_FRAMES {
        return refused(format!(
            "thigh and shank are known in {}; expected at least {FEWEST_FRAMES}, with two markers on each",
            counted(frames.len(), "frame")
        ));
    }
    let Some([axis, _]) = symmetrical_axis(&frames) else { return refused("its segments do not move".to_owned()) };
    let axis = if axis.z < 0.0 { -axis } else { axis };
    let [range_rad, off_rad] = rotations(&frames, axis);
    if range_rad < LEAST_RANGE {
        return refused(format!(
            "it bends by {}; expected at least {:.0}",
            degrees(range_rad.to_degrees()),
            LEAST_RANGE.to_degrees()
        ));
    }
    let turn_rad = atan2(axis.x, axis.z);
    if off_rad > MOST_OFF || turn_rad.abs() > MOST_TURN {
        return refused(format!(
            "it turns by {} about other axes, and its axis is {} from that of the markers; expected at most {:.0} and \
             {:.0}",
            degrees(off_rad.to_degrees()),
            degrees(turn_rad.abs().to_degrees()),
            MOST_OFF.to_degrees(),
            MOST_TURN.to_degrees()
        ));
    }
    Ok(FunctionalKnee { axis, turn_rad, off_rad, range_rad })
}

/// Range of the rotation about an axis of the thigh, and root mean square of the rest [rad], both from the mean
/// posture.
fn rotations(frames: &[Rotated], axis: Vec3) -> [f64; 2] {
    let middle = &frames[frames.len() / 2];
    let start = middle[0].rotation.tr_mul(&middle[1].rotation);
    let turned = |[a, b]: &Rotated| rotation_vector(&(a.rotation.tr_mul(&b.rotation) * start.transpose()));
    let vectors: Vec<Vec3> = frames.iter().map(turned).collect();
    let about: Vec<f64> = vectors.iter().map(|v| v.dot(&axis)).collect();
    let centre = vectors.iter().map(|v| v - axis * v.dot(&axis)).sum::<Vec3>() / vectors.len() as f64;
    let rest: Vec<f64> = vectors.iter().map(|v| (v - axis * v.dot(&axis) - centre).norm_squared()).collect();
    [range(&about), mean(&rest).sqrt()]
}
