//! Frame of the pelvis and hip centres.

use super::CalibrationError;
use super::axes::{about_z, direction, from_z_x, from_z_y};
use super::hip_centre::{HipRegression, PelvisSize};
use super::landmark_trajectories::LandmarkTrajectories;
use super::person::PersonMeasurements;
use super::report::HipCentres;
use crate::model::full_body::STANDING_TILT;
use crate::model::marker_set::Landmark;
use crate::model::{BySide, Side};
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
    /// From midway between the hips to the right hip centre, in the body frame [m].
    half: Vec3,
    /// Whether only the hip centres are known, so that the tilt is not.
    pub(super) is_line: bool,
    /// How the hip centres were found.
    pub(super) hips: HipCentres,
}

impl Pelvis {
    /// Distance between the hip centres [m].
    pub(super) fn hip_width(&self) -> f64 {
        2.0 * self.half.norm()
    }

    /// A hip centre in the body frame [m].
    pub(super) fn hip_in_body(&self, side: Side) -> Vec3 {
        self.half * if side == Side::Right { 1.0 } else { -1.0 }
    }

    /// A hip centre in a selected frame [m].
    pub(super) fn hip(&self, measured: usize, side: Side) -> Option<Vec3> {
        Some(self.poses.get(measured)?.as_ref()?.place(self.hip_in_body(side)))
    }

    /// Direction to the right in a selected frame.
    pub(super) fn right(&self, measured: usize) -> Option<Vec3> {
        Some(self.poses.get(measured)?.as_ref()?.rotation.column(2).into())
    }
}

pub(super) fn find(
    trajectories: &LandmarkTrajectories<'_>,
    frames: &[usize],
    person: &PersonMeasurements,
    assumptions: &mut Vec<String>,
) -> Result<Pelvis, CalibrationError> {
    let both = |landmark: Landmark| Side::BOTH.into_iter().all(|side| trajectories.has(landmark, Some(side)));
    let has_back = both(Landmark::Psis) || trajectories.has(Landmark::Sacrum, None);
    let pelvis = if both(Landmark::Asis) && has_back {
        from_spines(trajectories, frames, person, assumptions)
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
    if !(least_m..=most_m).contains(&pelvis.hip_width()) {
        return Err(CalibrationError::Length {
            part: "line between the hip centres".to_owned(),
            found_m: pelvis.hip_width(),
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

/// Right and left hip centre by Harrington's regression [m], from the anterior spines, right first, and the back of the
/// pelvis in the same axes.
#[must_use]
pub fn hip_centres([right, left]: [Vec3; 2], back: Vec3) -> Option<[Vec3; 2]> {
    let (front, across) = ((right + left) * 0.5, right - left);
    let rotation = from_z_x(across, front - back)?;
    let (width, depth) = (across.norm(), (front - back).norm());
    let unused = BySide::from([f64::NAN; 2]);
    let (stated_width, trochanters) = (None, BySide::default());
    let size = PelvisSize { width, stated_width, depth, legs: unused, trochanters, radius: 0.0 };
    Some(Side::BOTH.map(|side| front + rotation * HipRegression::Harrington.centre(&size, side)))
}

/// Length of each leg from the anterior spine over knee and ankle [m]: as stated, or between the markers; that of the
/// other leg if one lacks them. NaN if no leg has them.
fn leg_lengths(
    trajectories: &LandmarkTrajectories<'_>,
    frames: &[usize],
    person: &PersonMeasurements,
    assumptions: &mut Vec<String>,
) -> BySide<f64> {
    let measured = |side: Side| {
        let one = |places: [Landmark; 2], frame| places.iter().find_map(|place| trajectories.of(*place, side, frame));
        median(frames.iter().filter_map(|&frame| {
            let spine = trajectories.of(Landmark::Asis, side, frame)?;
            let knee = one([Landmark::LateralEpicondyle, Landmark::KneeCentre], frame)?;
            let medial = trajectories.of(Landmark::MedialMalleolus, side, frame);
            let ankle = medial.or_else(|| one([Landmark::LateralMalleolus, Landmark::AnkleCentre], frame))?;
            Some((spine - knee).norm() + (knee - ankle).norm())
        }))
    };
    let stated = person.measurements.leg_length;
    if Side::BOTH.into_iter().any(|side| stated[side].is_none()) {
        assumptions.push("the length of a leg is not stated; it is that over spine, knee and ankle markers".to_owned());
    }
    let own = BySide::from_fn(|side| stated[side].or_else(|| measured(side)));
    let any = own.right.or(own.left).unwrap_or(f64::NAN);
    own.map(|length| length.unwrap_or(any))
}

/// Hip centres from midway between the anterior spines, in axes through the spines: those of a movement, or by the
/// regression. A hip whose movement was not measured mirrors the other.
fn centres(
    regression: HipRegression,
    size: &PelvisSize,
    person: &PersonMeasurements,
    assumptions: &mut Vec<String>,
) -> HipCentres {
    let moved = person.measurements.joints.hips;
    let mirrored = |centre: Vec3| Vec3::new(centre.x, centre.y, -centre.z);
    if let (Some(one), None) | (None, Some(one)) = (moved.right, moved.left) {
        assumptions.push(format!(
            "the movement shows the centre of one hip; the other is its mirror image, {:.0} mm outwards",
            1e3 * one.z.abs()
        ));
    }
    let functional = moved.right.or_else(|| moved.left.map(mirrored));
    let Some(right) = functional else {
        return HipCentres {
            method: regression.word(),
            expected_error_m: Some(regression.expected_error_m()),
            centres_m: BySide::from_fn(|side| regression.centre(size, side)),
        };
    };
    let centres_m = BySide { right, left: moved.left.unwrap_or_else(|| mirrored(right)) };
    HipCentres { method: HipCentres::FUNCTIONAL, expected_error_m: Some(HipCentres::FUNCTIONAL_ERROR_M), centres_m }
}

fn from_spines(
    trajectories: &LandmarkTrajectories<'_>,
    frames: &[usize],
    person: &PersonMeasurements,
    assumptions: &mut Vec<String>,
) -> Pelvis {
    let seen: Vec<_> = frames.iter().map(|&frame| spines(trajectories, frame)).collect();
    let known = || seen.iter().flatten();
    let regression = person.measurements.joints.hip;
    let size = PelvisSize {
        width: median(known().map(|(_, _, across)| across.norm())).unwrap_or(f64::NAN),
        depth: median(known().map(|(front, back, _)| (front - back).norm())).unwrap_or(f64::NAN),
        legs: match regression.uses_legs() {
            true => leg_lengths(trajectories, frames, person, assumptions),
            false => BySide::from([f64::NAN; 2]),
        },
        stated_width: person.measurements.asis_width,
        trochanters: person.measurements.asis_trochanter,
        radius: person.measurements.radius(),
    };
    let hips = centres(regression, &size, person, assumptions);
    let BySide { right, left } = hips.centres_m;
    let origin = (right + left) * 0.5;
    let pose = |(front, back, across): &(Vec3, Vec3, Vec3)| {
        let rotation = from_z_x(*across, front - back)?;
        Some(Pose { rotation: rotation * about_z(STANDING_TILT), translation: front + rotation * origin })
    };
    let poses = seen.iter().map(|spines| spines.as_ref().and_then(pose)).collect();
    let half = about_z(STANDING_TILT).transpose() * ((right - left) * 0.5);
    Pelvis { poses, half, is_line: false, hips }
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
    let half = Vec3::z() * (0.5 * hip_width);
    let hips =
        HipCentres { method: HipCentres::RECORDED, expected_error_m: None, centres_m: BySide::from([half, -half]) };
    Pelvis { poses, half, is_line: true, hips }
}
