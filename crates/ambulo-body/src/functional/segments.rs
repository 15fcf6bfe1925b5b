//! Pelvis, thigh and shank of a calibrated body, each where its own markers are, without the joints of the body.

use crate::kinematics::calibration::axes::fit_pose;
use crate::model::{BodyId, Model, Side};
use crate::motion::{MarkerPath, MarkerRecording};
use crate::spatial::{Pose, Vec3};

/// A segment with its recorded markers.
#[derive(Debug)]
pub(super) struct Segment<'a> {
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
    fn of(model: &Model, recording: &'a MarkerRecording, body: BodyId) -> Segment<'a> {
        let own = model.markers().iter().filter(|marker| marker.body == Some(body));
        let markers = own.filter_map(|marker| Some((marker.location, recording.marker(&marker.name)?)));
        Segment { markers: markers.collect() }
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
