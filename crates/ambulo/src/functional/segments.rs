//! Segments of a body, each where its own markers are, without the joints of the body.
//!
//! **A pose**: the markers, and a joint centre as one more point, by least squares ([`fit_pose`]). Movements that show
//! joint centres and axes are read from these poses, because no centre is known yet.
//!
//! **A rotation about a joint centre** that is known, which two markers determine:
//!
//!   R = arg min Σ |R a_i - (m_i - C)|²        δ = A⁻¹ Σ u_i × (m_i - C),   u_i = R a_i,   A = Σ (|u_i|² 1 - u_i u_iᵀ)
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | C | the joint centre, in the world | m |
//! | a_i | place of a marker, from the joint centre, in the segment | m |
//! | m_i | the recorded marker, in the world | m |
//! | δ | rotation vector of a step, from the rotation of the fitted body on | rad |
//!
//! The poses that the fit of all markers gives to the segments, with the joints of the body, are another thing: they
//! are needed where a marker is not on the body yet (`technical_markers`).
//!
//! Pinned by: tests/functional.rs, tests/segment_angles.rs

use crate::kinematics::calibration::fit_pose;
use crate::model::{BodyId, Model, Side};
use crate::motion::{MarkerPath, MarkerRecording};
use crate::spatial::{Mat3, Pose, Vec3, rotation};

/// Smallest root of the sum of squared distances of the markers from a line through the joint centre [m]: of shorter
/// arms a centimetre of soft-tissue motion turns the segment by more than 15 degrees.
const LEAST_ARM_M: f64 = 0.035;
/// Steps of the fit: it converges quadratically from the rotation of the fitted body, which is a few degrees off.
const STEPS: usize = 8;

/// A segment with its recorded markers.
#[derive(Debug)]
pub(super) struct Segment<'a> {
    pub(super) body: BodyId,
    /// Places of the markers on the body [m], and their paths.
    pub(super) markers: Vec<(Vec3, &'a MarkerPath)>,
}

/// Pelvis and one leg.
#[derive(Debug)]
pub(super) struct LegSegments<'a> {
    pub(super) side: Side,
    pub(super) pelvis: Segment<'a>,
    pub(super) thigh: Segment<'a>,
    pub(super) shank: Segment<'a>,
    /// The hip centre of the body, in its pelvis [m].
    pub(super) hip: Vec3,
    /// The knee centre of the body, in its thigh, and the ankle centre, in its shank [m].
    pub(super) knee: Vec3,
    pub(super) ankle: Vec3,
}

impl<'a> Segment<'a> {
    pub(super) fn of(model: &Model, recording: &'a MarkerRecording, body: BodyId) -> Segment<'a> {
        let own = model.markers().iter().filter(|marker| marker.body == Some(body));
        let markers = own.filter_map(|marker| Some((marker.location, recording.marker(&marker.name)?)));
        Segment { body, markers: markers.collect() }
    }

    /// The places and points of the markers that are visible in a frame, and of a joint centre if one is known.
    fn seen(&self, frame: usize, joint: Option<(Vec3, Vec3)>) -> (Vec<Vec3>, Vec<Vec3>) {
        let visible = self.markers.iter().filter(|(_, path)| path.is_seen(frame));
        visible.map(|(place, path)| (*place, path.positions[frame])).chain(joint).unzip()
    }

    /// The pose of the segment in a frame, by least squares; `None` with fewer than three points.
    pub(super) fn pose(&self, frame: usize, joint: Option<(Vec3, Vec3)>) -> Option<Pose> {
        let (places, points) = self.seen(frame, joint);
        fit_pose(&places, &points)
    }

    /// Whether the markers determine how the segment turns about a joint centre, given in the segment [m].
    pub(super) fn turns_about(&self, center: Vec3) -> bool {
        arm(self.markers.iter().map(|(place, _)| place - center)) > LEAST_ARM_M
    }

    /// The rotation of the segment about a joint centre, given in the segment and in the world [m], from the rotation
    /// `start` on; `None` if the markers that are visible in the frame do not determine it.
    pub(super) fn turned(&self, frame: usize, (in_segment, center): (Vec3, Vec3), start: Mat3) -> Option<Mat3> {
        let visible = self.markers.iter().filter(|(_, path)| path.is_seen(frame));
        let seen = visible.map(|(place, path)| (place - in_segment, path.positions[frame] - center));
        if arm(seen.clone().map(|(place, _)| place)) <= LEAST_ARM_M {
            return None;
        }
        let mut turned = start;
        for _ in 0..STEPS {
            let (mut stiffness, mut moment) = (Mat3::zeros(), Vec3::zeros());
            for (place, arm) in seen.clone() {
                let u = turned * place;
                stiffness += Mat3::identity() * u.norm_squared() - u * u.transpose();
                moment += u.cross(&arm);
            }
            turned = rotation(&(stiffness.try_inverse()? * moment)) * turned;
        }
        Some(turned)
    }
}

/// Least root of the sum of squared distances of points from a line through the origin [m]: the line along which they
/// lie best is found by iterating A⁻¹, with A = Σ (|a|² 1 - a aᵀ). Zero for points on a line.
fn arm(places: impl Iterator<Item = Vec3>) -> f64 {
    let inertia = places.fold(Mat3::zeros(), |sum, a| sum + Mat3::identity() * a.norm_squared() - a * a.transpose());
    let Some(inverse) = inertia.try_inverse() else { return 0.0 };
    let mut along = Vec3::new(0.3, 0.9, 0.2);
    for _ in 0..STEPS {
        along = (inverse * along).try_normalize(f64::MIN_POSITIVE).unwrap_or(along);
    }
    along.dot(&(inertia * along)).max(0.0).sqrt()
}

impl<'a> LegSegments<'a> {
    /// The leg of a body with the usual names of segments.
    pub(super) fn of(model: &Model, recording: &'a MarkerRecording, side: Side) -> Result<LegSegments<'a>, String> {
        let body = |name: &str| {
            let name = if name == "pelvis" { name.to_owned() } else { format!("{name}_{}", side.letter()) };
            model.body(&name).ok_or_else(|| format!("the body has no segment `{name}`"))
        };
        let [pelvis, thigh, shank, foot] = ["pelvis", "femur", "tibia", "calcn"].map(body);
        let (pelvis, thigh, shank, foot) = (pelvis?, thigh?, shank?, foot?);
        let joint = |body: BodyId| model.bodies()[body.index()].joint.parent_from_joint.translation;
        let segment = |body: BodyId| Segment::of(model, recording, body);
        Ok(LegSegments {
            side,
            pelvis: segment(pelvis),
            thigh: segment(thigh),
            shank: segment(shank),
            hip: joint(thigh),
            knee: joint(shank),
            ankle: joint(foot),
        })
    }

    /// Poses of pelvis, thigh and shank in a frame: the hip centre counts as a point of the thigh, the knee centre as a
    /// point of the shank.
    pub(super) fn poses(&self, frame: usize) -> Option<[Pose; 3]> {
        let pelvis = self.pelvis.pose(frame, None)?;
        let thigh = self.thigh.pose(frame, Some((Vec3::zeros(), pelvis.place(self.hip))))?;
        let shank = self.shank.pose(frame, Some((Vec3::zeros(), thigh.place(self.knee))))?;
        Some([pelvis, thigh, shank])
    }
}
