//! Poses of body segments, as markerless motion capture computes them and C3D files store them (group ROTATION), or as
//! a suit of inertial sensors does (`xsens.rs`).
//!
//! Each segment has its origin in the joint to its parent: the thigh in the hip, the shank in the knee, the foot in the
//! ankle, the toes in the ball of the foot, the upper arm in the shoulder. The axes of a [`SegmentPoses`] are x
//! forward, y up and z right of a person who stands upright with hanging arms and palms forward; the axes of a file are
//! found from the geometry (`axes.rs`): the knee is below the hip in the thigh, and the right hip is to the right in
//! the pelvis. Theia3D writes x right, y forward, z up.
//!
//! [`SegmentPoses::points`] are the joint centres, and points next to them that show the orientation of the segments,
//! with the names of [`crate::motion::skeleton`]. Heel and tip of the toes come from the group THEIA3D, where the
//! file has it: `l_heel` is a point of the foot [m], and `LTO` the length of the toes [m] (meaning of `LTO` unverified;
//! 61 and 65 mm in the one file that was seen).
//!
//! Sources: wiki.has-motion.com, "ROTATION DATA TYPE" (matrices, axes of segments); docs.theiamarkerless.com, "Theia
//! Model Description" (landmarks of feet, hands and head in the C3D).
//! Not handled: models whose segments have no pose of their own for thigh, shank and foot.
//! Pinned by: tests/segment_poses.rs

mod axes;
mod error;
mod labels;
mod xsens;

pub use error::SegmentPoseError;
pub(super) use labels::in_words;
pub use xsens::{events_from_mvnx, segment_poses_from_mvnx};

use super::guessed_unit::unit_of_frames;
use super::marker_recording::{MarkerPath, MarkerRecording};
use super::skeleton::{HEEL_SHARE, POINT_DISTANCE_M};
use crate::findings::{Code, Findings};
use crate::model::{BySide, Side};
use crate::numerics::median;
use crate::spatial::{Mat3, Pose, Vec3};
use ambulo_formats::c3d::{C3d, Rotation};
use std::ops::RangeInclusive;

/// A segment with its own pose.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum PosedSegment {
    /// Pelvis.
    Pelvis,
    /// Trunk above the pelvis.
    Torso,
    /// Thigh; origin in the hip.
    Thigh(Side),
    /// Shank; origin in the knee.
    Shank(Side),
    /// Foot without the toes; origin in the ankle.
    Foot(Side),
    /// Toes; origin in the ball of the foot.
    Toes(Side),
    /// Upper arm; origin in the shoulder.
    UpperArm(Side),
    /// Forearm; origin in the elbow.
    Forearm(Side),
    /// Hand; origin in the wrist.
    Hand(Side),
}

/// The segment of a label such as `l_thigh_4X4`, `RightUpperLeg` or `tibia_r`; `None` for others.
pub(crate) fn posed_segment(label: &str) -> Option<PosedSegment> {
    labels::segment_of(label)
}

/// Poses of segments over time, with the axes of a standing person: x forward, y up, z right.
#[derive(Debug, Clone, PartialEq)]
pub struct SegmentPoses {
    /// Rate of the poses [Hz].
    pub rate_hz: f64,
    /// Times [s].
    pub times: Vec<f64>,
    /// The poses `laboratory_from_segment` of each segment [m], one per time; `None` where the pose is missing.
    pub segments: Vec<(PosedSegment, Vec<Option<Pose>>)>,
    /// Back of the heel in the foot, from the ankle [m].
    pub heel: BySide<Option<Vec3>>,
    /// Length of the toes from the ball of the foot to their tip [m].
    pub toe_length_m: BySide<Option<f64>>,
    /// Axes of the segments in the file, in words.
    pub statement: String,
}

/// Largest deviation of the axes of a pose from unit length and right angles.
const LARGEST_DEFECT: f64 = 1e-3;
/// Plausible distances from ankle to heel, and lengths of toes [m].
const FOOT_LENGTHS_M: RangeInclusive<f64> = 0.01..=0.2;

/// Reads the poses of the segments of a C3D file, in the axes of the laboratory.
///
/// # Errors
/// No poses of pelvis, thighs, shanks and feet; axes that a person cannot have: see [`SegmentPoseError`].
pub fn segment_poses_from_c3d(c3d: &C3d, findings: &mut Findings) -> Result<SegmentPoses, SegmentPoseError> {
    let unit_m = unit_m(c3d, findings);
    let samples = c3d.frames() * c3d.rotations_per_frame();
    let mut segments: Vec<(PosedSegment, Vec<Option<Pose>>)> = Vec::new();
    let mut defects = 0;
    for rotation in &c3d.rotations {
        let Some(segment) = labels::segment_of(&rotation.name) else { continue };
        if segments.iter().all(|(known, _)| *known != segment) {
            let path = (0..samples).map(|sample| pose(rotation, sample, unit_m, &mut defects));
            segments.push((segment, path.collect()));
        }
    }
    segments.sort_by_key(|(segment, _)| *segment);
    if defects > 0 {
        let message = format!(
            "{defects} poses are no rotations: their axes are not perpendicular unit vectors; they were read as missing"
        );
        findings.report(Code::PosesOdd, message);
    }
    let labels: Vec<&str> = c3d.rotations.iter().map(|rotation| rotation.name.as_str()).collect();
    labels::check_complete(&segments, &labels)?;
    let start_s = (c3d.first_frame - 1) as f64 / c3d.point_rate_hz;
    let poses = SegmentPoses {
        rate_hz: c3d.rotation_rate_hz,
        times: (0..samples).map(|sample| start_s + sample as f64 / c3d.rotation_rate_hz).collect(),
        segments,
        heel: BySide::from_fn(|side| heel(c3d, side)),
        toe_length_m: BySide::from_fn(|side| toe_length(c3d, side)),
        statement: String::new(),
    };
    axes::aligned(poses)
}

/// Metres per unit of the positions: as stated, else inferred from the distances between the origins of the segments.
fn unit_m(c3d: &C3d, findings: &mut Findings) -> f64 {
    let place = |rotation: &Rotation, sample: usize| {
        let matrix = rotation.matrices.get(sample).filter(|_| labels::segment_of(&rotation.name).is_some())?;
        Some(Vec3::from_fn(|row, _| matrix[row][3]))
    };
    if let Some(metres) = c3d.metres_per_unit() {
        return metres;
    }
    let samples = c3d.frames() * c3d.rotations_per_frame();
    let places = |sample: usize| c3d.rotations.iter().filter_map(move |rotation| place(rotation, sample));
    let (name, metres) = unit_of_frames(samples, places).unwrap_or(("m", 1.0));
    let message = format!(
        "POINT:UNITS is `{}`, which is no unit of length; by the size of the poses lengths are in {name}",
        c3d.point_unit
    );
    findings.report(Code::FileUnitGuessed, message);
    metres
}

/// A pose in metres; `None` if it is missing or no rotation.
fn pose(rotation: &Rotation, sample: usize, unit_m: f64, defects: &mut usize) -> Option<Pose> {
    let matrix = rotation.matrices.get(sample).filter(|_| rotation.is_seen(sample))?;
    let turn = Mat3::from_fn(|row, column| matrix[row][column]);
    let defect = (turn.transpose() * turn - Mat3::identity()).amax();
    if defect > LARGEST_DEFECT || turn.determinant() < 0.0 {
        *defects += 1;
        return None;
    }
    Some(Pose { rotation: turn, translation: Vec3::from_fn(|row, _| matrix[row][3] * unit_m) })
}

/// `THEIA3D:l_heel`, in the axes of the foot in the file [m].
fn heel(c3d: &C3d, side: Side) -> Option<Vec3> {
    let numbers = c3d.parameters.get("THEIA3D", &format!("{}_heel", side.letter()))?.numbers()?;
    let heel = Vec3::from_iterator(numbers.get(..3)?.iter().copied());
    FOOT_LENGTHS_M.contains(&heel.norm()).then_some(heel)
}

/// `THEIA3D:LTO`, a text in the file that was seen [m].
fn toe_length(c3d: &C3d, side: Side) -> Option<f64> {
    let name = format!("{}TO", side.letter().to_uppercase());
    let parameter = c3d.parameters.get("THEIA3D", &name)?;
    let of_text = || parameter.texts()?.first()?.trim().parse().ok();
    let length = parameter.numbers().and_then(|numbers| numbers.first().copied()).or_else(of_text)?;
    FOOT_LENGTHS_M.contains(&length).then_some(length)
}

impl SegmentPoses {
    /// The poses of a segment.
    #[must_use]
    pub fn of(&self, segment: PosedSegment) -> Option<&[Option<Pose>]> {
        self.segments.iter().find(|(known, _)| *known == segment).map(|(_, path)| path.as_slice())
    }

    /// The pose of a segment in a frame; `None` where it is missing.
    #[must_use]
    pub fn at(&self, segment: PosedSegment, frame: usize) -> Option<Pose> {
        self.of(segment)?.get(frame).copied().flatten()
    }

    /// The poses in other axes and another unit: `rotation` and then lengths times `scale`.
    #[must_use]
    pub fn transformed(&self, rotation: &Mat3, scale: f64) -> SegmentPoses {
        let turned =
            |pose: &Pose| Pose { rotation: rotation * pose.rotation, translation: rotation * pose.translation * scale };
        let path = |path: &[Option<Pose>]| path.iter().map(|pose| pose.as_ref().map(turned)).collect();
        SegmentPoses {
            segments: self.segments.iter().map(|(segment, poses)| (*segment, path(poses))).collect(),
            ..self.clone()
        }
    }

    /// The frames from `first`, `count` of them.
    #[must_use]
    pub fn cut(&self, first: usize, count: usize) -> SegmentPoses {
        let part = |path: &[Option<Pose>]| path.iter().skip(first).take(count).copied().collect();
        SegmentPoses {
            times: self.times.iter().skip(first).take(count).copied().collect(),
            segments: self.segments.iter().map(|(segment, poses)| (*segment, part(poses))).collect(),
            ..self.clone()
        }
    }

    /// Joint centres, heels and tips of the toes, and points next to the joints; not-a-number where poses are missing.
    #[must_use]
    pub fn points(&self, name: &str) -> MarkerRecording {
        let mut points = Points { poses: self, markers: Vec::new() };
        let middle = |frame: usize| {
            let [right, left] = Side::BOTH.map(|side| self.at(PosedSegment::Thigh(side), frame));
            Some((right?.translation + left?.translation) / 2.0)
        };
        for (name, axis) in [("pelvis_up", Vec3::y()), ("pelvis_front", Vec3::x())] {
            points.push(name.to_owned(), |frame| {
                Some(middle(frame)? + self.at(PosedSegment::Pelvis, frame)?.rotation * axis * POINT_DISTANCE_M)
            });
        }
        for side in Side::BOTH {
            points.leg(side);
            points.foot(side);
            points.arm(side);
        }
        let Points { mut markers, .. } = points;
        markers.retain(|path| (0..path.positions.len()).any(|frame| path.is_seen(frame)));
        MarkerRecording { name: name.to_owned(), rate_hz: self.rate_hz, times: self.times.clone(), markers }
    }

    /// Ball of the foot, in axes of the foot [m].
    fn ball(&self, side: Side) -> Option<Vec3> {
        let in_foot = |frame: usize| {
            let foot = self.at(PosedSegment::Foot(side), frame)?.inverse();
            Some(foot.place(self.at(PosedSegment::Toes(side), frame)?.translation))
        };
        median_vector((0..self.times.len()).filter_map(in_foot))
    }
}

/// Median of vectors, component by component; `None` without any.
fn median_vector(vectors: impl Iterator<Item = Vec3>) -> Option<Vec3> {
    let all: Vec<Vec3> = vectors.collect();
    let one = |axis: usize| median(all.iter().map(|vector| vector[axis]));
    Some(Vec3::new(one(0)?, one(1)?, one(2)?))
}

/// The points of some poses.
struct Points<'p> {
    poses: &'p SegmentPoses,
    markers: Vec<MarkerPath>,
}

impl Points<'_> {
    fn push(&mut self, name: String, place: impl Fn(usize) -> Option<Vec3>) {
        let missing = Vec3::repeat(f64::NAN);
        let positions = (0..self.poses.times.len()).map(|frame| place(frame).unwrap_or(missing)).collect();
        self.markers.push(MarkerPath { name, positions });
    }

    /// A point that is fixed to a segment.
    fn fixed(&mut self, name: &str, side: Side, segment: PosedSegment, place: Vec3) {
        let poses = self.poses;
        self.push(format!("{name}_{}", side.letter()), |frame| Some(poses.at(segment, frame)?.place(place)));
    }

    /// A point at the origin of one segment, moved along an axis of another.
    fn beside(&mut self, name: &str, side: Side, [origin, turned]: [PosedSegment; 2], axis: Vec3) {
        let poses = self.poses;
        self.push(format!("{name}_{}", side.letter()), |frame| {
            let turn = poses.at(turned, frame)?.rotation;
            Some(poses.at(origin, frame)?.translation + turn * axis * POINT_DISTANCE_M)
        });
    }

    fn leg(&mut self, side: Side) {
        let [thigh, shank, foot] = [PosedSegment::Thigh(side), PosedSegment::Shank(side), PosedSegment::Foot(side)];
        for (name, segment) in [("hip", thigh), ("knee", shank), ("ankle", foot)] {
            self.fixed(name, side, segment, Vec3::zeros());
        }
        self.beside("thigh_side", side, [shank, thigh], Vec3::z());
        self.beside("shank_side", side, [foot, shank], Vec3::z());
    }

    fn foot(&mut self, side: Side) {
        let [foot, toes] = [PosedSegment::Foot(side), PosedSegment::Toes(side)];
        let ball = self.poses.ball(side);
        let length = self.poses.toe_length_m[side];
        let of_ball = |ball: Vec3| {
            let tip = ball.x + length.unwrap_or(0.0);
            Vec3::new(-HEEL_SHARE * tip, ball.y, 0.0)
        };
        if let Some(heel) = self.poses.heel[side].or(ball.map(of_ball)) {
            self.fixed("heel", side, foot, heel);
        }
        self.beside("foot_front", side, [foot, foot], Vec3::x());
        self.beside("foot_side", side, [foot, foot], Vec3::z());
        self.fixed("toe", side, toes, Vec3::zeros());
        self.beside("toe_front", side, [toes, toes], Vec3::x());
        if let Some(length) = length {
            self.fixed("toe_tip", side, toes, Vec3::x() * length);
        }
    }

    fn arm(&mut self, side: Side) {
        use PosedSegment::{Forearm, Hand, UpperArm};
        for (name, segment) in [("shoulder", UpperArm(side)), ("elbow", Forearm(side)), ("wrist", Hand(side))] {
            self.fixed(name, side, segment, Vec3::zeros());
        }
    }
}
