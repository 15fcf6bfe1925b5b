//! Frame of the pelvis and hip centres.

use super::CalibrationError;
use super::axes::{about_z, direction, from_z_x, from_z_y};
use super::landmark_trajectories::LandmarkTrajectories;
use crate::model::Side;
use crate::model::full_body::STANDING_TILT;
use crate::model::marker_set::Landmark;
use crate::numerics::median;
use crate::spatial::{Pose, Vec3};

/// Smallest number of frames in which the pelvis is visible.
const LEAST_FRAMES: usize = 3;
/// Plausible distances between the hip centres [m].
const HIP_WIDTHS: [f64; 2] = [0.05, 0.35];

/// The pelvis in the selected frames.
#[derive(Debug)]
pub(super) struct Pelvis {
    /// Pose of the body frame, one per selected frame: origin midway between the hips, upright in standing.
    pub(super) poses: Vec<Option<Pose>>,
    /// Distance between the hip centres [m].
    pub(super) hip_width: f64,
    /// Whether only the hip centres are known, so that the tilt is not.
    pub(super) is_line: bool,
}

impl Pelvis {
    /// A hip centre in a selected frame [m].
    pub(super) fn hip(&self, measured: usize, side: Side) -> Option<Vec3> {
        let out = if side == Side::Right { 0.5 } else { -0.5 };
        Some(self.poses.get(measured)?.as_ref()?.place(Vec3::z() * (out * self.hip_width)))
    }

    /// Direction to the right in a selected frame.
    pub(super) fn right(&self, measured: usize) -> Option<Vec3> {
        Some(self.poses.get(measured)?.as_ref()?.rotation.column(2).into())
    }
}

pub(super) fn find(trajectories: &LandmarkTrajectories<'_>, frames: &[usize]) -> Result<Pelvis, CalibrationError> {
    let both = |landmark: Landmark| Side::BOTH.into_iter().all(|side| trajectories.has(landmark, Some(side)));
    let has_back = both(Landmark::Psis) || trajectories.has(Landmark::Sacrum, None);
    let pelvis = if both(Landmark::Asis) && has_back {
        from_spines(trajectories, frames)
    } else if both(Landmark::HipCentre) {
        from_hips(trajectories, frames)
    } else {
        return Err(CalibrationError::Markers {
            part: "pelvis".to_owned(),
            needed: "asis r, asis l and (psis r, psis l or sacrum), or hip_centre r and l,".to_owned(),
            found: trajectories.words(),
        });
    };
    let seen = pelvis.poses.iter().flatten().count();
    let expected = LEAST_FRAMES.min(frames.len()).max(1);
    if seen < expected {
        return Err(CalibrationError::Unseen { part: "pelvis".to_owned(), seen, frames: frames.len(), expected });
    }
    let [least_m, most_m] = HIP_WIDTHS;
    if !(least_m..=most_m).contains(&pelvis.hip_width) {
        return Err(CalibrationError::Length {
            part: "line between the hip centres".to_owned(),
            found_m: pelvis.hip_width,
            least_m,
            most_m,
            hint: "check the unit of length, and whether left and right markers are swapped",
        });
    }
    Ok(pelvis)
}

/// In a frame: the points midway between the anterior and the posterior iliac spines, and the vector from the left to
/// the right anterior one.
fn spines(trajectories: &LandmarkTrajectories<'_>, frame: usize) -> Option<(Vec3, Vec3, Vec3)> {
    let (right, left) =
        (trajectories.of(Landmark::Asis, Side::Right, frame)?, trajectories.of(Landmark::Asis, Side::Left, frame)?);
    let posterior = || {
        let pair = Side::BOTH.map(|side| trajectories.of(Landmark::Psis, side, frame));
        Some((pair[0]? + pair[1]?) * 0.5)
    };
    let back = posterior().or_else(|| trajectories.at(Landmark::Sacrum, None, frame))?;
    Some(((right + left) * 0.5, back, right - left))
}

/// Hip centre by Harrington 2007 from width and depth of the pelvis between the markers [m], relative to the point
/// midway between the anterior spines, in axes through the spines.
fn regression(width: f64, depth: f64) -> Vec3 {
    Vec3::new(-0.24 * depth - 0.0099, -0.30 * width - 0.0109, 0.33 * width + 0.0073)
}

/// Right and left hip centre [m], from the anterior spines, right first, and the back of the pelvis in the same axes.
#[must_use]
pub fn hip_centres([right, left]: [Vec3; 2], back: Vec3) -> Option<[Vec3; 2]> {
    let (front, across) = ((right + left) * 0.5, right - left);
    let rotation = from_z_x(across, front - back)?;
    let hip = regression(across.norm(), (front - back).norm());
    Some([1.0, -1.0].map(|out| front + rotation * Vec3::new(hip.x, hip.y, out * hip.z)))
}

fn from_spines(trajectories: &LandmarkTrajectories<'_>, frames: &[usize]) -> Pelvis {
    let seen: Vec<_> = frames.iter().map(|&frame| spines(trajectories, frame)).collect();
    let known = || seen.iter().flatten();
    let width = median(known().map(|(_, _, across)| across.norm())).unwrap_or(f64::NAN);
    let depth = median(known().map(|(front, back, _)| (front - back).norm())).unwrap_or(f64::NAN);
    let hip = regression(width, depth);
    let origin = Vec3::new(hip.x, hip.y, 0.0);
    let pose = |(front, back, across): &(Vec3, Vec3, Vec3)| {
        let rotation = from_z_x(*across, front - back)?;
        Some(Pose { rotation: rotation * about_z(STANDING_TILT), translation: front + rotation * origin })
    };
    let poses = seen.iter().map(|spines| spines.as_ref().and_then(pose)).collect();
    Pelvis { poses, hip_width: 2.0 * hip.z, is_line: false }
}

/// From hip centres of video: the line between the hips, and the line from hips to shoulders for the tilt. Where no
/// shoulder is seen, the pelvis is upright.
fn from_hips(trajectories: &LandmarkTrajectories<'_>, frames: &[usize]) -> Pelvis {
    let both = |landmark: Landmark, frame: usize| {
        Some((trajectories.of(landmark, Side::Right, frame)?, trajectories.of(landmark, Side::Left, frame)?))
    };
    let seen: Vec<_> = frames.iter().map(|&frame| both(Landmark::HipCentre, frame)).collect();
    let hip_width = median(seen.iter().flatten().map(|(right, left)| (right - left).norm())).unwrap_or(f64::NAN);
    let pose = |(hips, &frame): (&Option<(Vec3, Vec3)>, &usize)| {
        let (right, left) = (*hips)?;
        let middle = (right + left) * 0.5;
        let shoulders = both(Landmark::ShoulderCentre, frame).map(|(right, left)| (right + left) * 0.5);
        let up = shoulders.and_then(|shoulders| direction(shoulders - middle)).unwrap_or_else(Vec3::y);
        Some(Pose { rotation: from_z_y(direction(right - left)?, up)?, translation: middle })
    };
    let poses = seen.iter().zip(frames).map(pose).collect();
    Pelvis { poses, hip_width, is_line: true }
}
