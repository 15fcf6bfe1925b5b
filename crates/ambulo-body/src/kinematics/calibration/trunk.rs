//! Trunk and arms: poses, sizes, shoulders and elbows.

use super::axes::{about_z, direction, fit_pose, from_y_x, from_y_z, in_frame, median_point};
use super::landmark_trajectories::LandmarkTrajectories;
use super::pelvis::Pelvis;
use super::person::PersonMeasurements;
use crate::model::anthropometry::Dimensions;
use crate::model::marker_set::{Landmark, Segment};
use crate::model::{BySide, Side};
use crate::numerics::elementary::{atan2, cos, hypot, sin};
use crate::numerics::median;
use crate::spatial::{Pose, Vec3};

/// Default width of the elbow as a share of stature: 67 mm at 1.45 m in biomechzoo's HC002D.
const ELBOW_BREADTH: f64 = 0.046;
/// An elbow flexed less than this [rad] does not show its plane of flexion.
const BENT: f64 = 0.17;
/// Upper arms further from the trunk than this are raised [rad].
const RAISED: f64 = 0.6;
/// Plausible scale factors.
const FACTORS: [f64; 2] = [0.6, 1.6];
/// Landmarks of the head, which moves relative to the trunk.
const HEAD: [Landmark; 5] = [Landmark::FrontHead, Landmark::BackHead, Landmark::Ear, Landmark::Nose, Landmark::Vertex];
/// Smallest number of landmarks of the trunk.
const LEAST_LANDMARKS: usize = 2;
/// Smallest number of frames in which a part is visible.
const LEAST_FRAMES: usize = 3;

/// Whether a landmark is on the head.
pub(super) fn is_head(landmark: Option<Landmark>) -> bool {
    landmark.is_some_and(|l| HEAD.contains(&l))
}

/// Trunk and arms in the selected frames.
#[derive(Debug)]
pub(super) struct Trunk {
    /// Pose of the body frame, origin at the lumbar joint, one per selected frame.
    pub(super) poses: Vec<Option<Pose>>,
    /// Scale factor relative to the segment table.
    pub(super) factor: f64,
    /// Shoulder centres in the body frame [m], right first.
    pub(super) shoulders: BySide<Vec3>,
    /// How much higher they are in the selected frames because of raised arms [m].
    pub(super) lift: f64,
    /// Right first; `None` without markers.
    pub(super) arms: BySide<Option<Arm>>,
}

/// Upper arm and forearm of one side.
#[derive(Debug)]
pub(super) struct Arm {
    /// Poses of upper arm (origin at the shoulder) and forearm (origin at the elbow), one per selected frame.
    pub(super) frames: Vec<Option<[Pose; 2]>>,
    /// Shoulder to elbow [m].
    pub(super) upper: f64,
    /// Elbow to wrist [m].
    pub(super) lower: f64,
}

pub(super) fn find(
    trajectories: &LandmarkTrajectories<'_>,
    frames: &[usize],
    pelvis: &Pelvis,
    dimensions: &Dimensions,
    person: &PersonMeasurements,
    assumptions: &mut Vec<String>,
) -> Trunk {
    let finder = Finder { trajectories, frames, dimensions, person };
    let fitted = finder.fit(pelvis);
    if fitted.iter().flatten().count() < LEAST_FRAMES.min(frames.len()) {
        assumptions.push(
            "trunk and arms have too few markers; their size is from the segment table, and the trunk is assumed \
             upright"
                .to_owned(),
        );
        return finder.unmeasured();
    }
    let mut trunk = finder.trunk(fitted);
    if trunk.lift > 0.0 {
        assumptions.push(format!(
            "the arms are raised, which lifts the shoulders; for hanging arms the shoulder centres are lowered by \
             {:.0} mm, estimated from neck markers and segment table",
            1e3 * trunk.lift
        ));
    }
    for side in Side::BOTH {
        let raised = trunk.shoulders[side] + Vec3::y() * trunk.lift;
        trunk.arms[side] = finder.arm(&trunk.poses, raised, side);
        if trunk.arms[side].is_none() {
            assumptions.push(format!("the {side} arm has too few markers; its size is from the segment table"));
        }
    }
    trunk
}

struct Finder<'a> {
    trajectories: &'a LandmarkTrajectories<'a>,
    frames: &'a [usize],
    dimensions: &'a Dimensions,
    person: &'a PersonMeasurements,
}

impl Finder<'_> {
    /// Length from the lumbar joint to the height of the shoulders in the segment table [m].
    fn length(&self) -> f64 {
        Segment::Torso.length(self.dimensions)
    }

    /// The lumbar joint in the pelvis [m].
    fn lumbar(&self) -> Vec3 {
        Vec3::y() * self.dimensions.lumbar_height.unwrap_or(0.0)
    }

    fn unmeasured(&self) -> Trunk {
        let d = self.dimensions;
        let shoulder = |out: f64| Vec3::new(0.0, self.length(), out * 0.5 * d.shoulder_width);
        let poses = vec![None; self.frames.len()];
        Trunk {
            poses,
            factor: 1.0,
            shoulders: BySide { right: shoulder(1.0), left: shoulder(-1.0) },
            lift: 0.0,
            arms: BySide::from_fn(|_| None),
        }
    }

    /// Fits the usual positions of the landmarks to the visible ones and to the lumbar joint.
    fn fit(&self, pelvis: &Pelvis) -> Vec<Option<Pose>> {
        let landmarks: Vec<(Landmark, Option<Side>, Vec3)> = self
            .trajectories
            .markers
            .iter()
            .filter(|(m, _)| m.definition.segment == Segment::Torso && !is_head(m.definition.landmark))
            .filter_map(|(m, _)| Some((m.definition.landmark?, m.definition.side, m.definition.place? * self.length())))
            .collect();
        let pose = |(measured, &frame): (usize, &usize)| {
            let (mut places, mut points) = (vec![Vec3::zeros()], vec![pelvis.poses[measured]?.place(self.lumbar())]);
            for (landmark, side, place) in &landmarks {
                if let Some(point) = self.trajectories.at(*landmark, *side, frame) {
                    places.push(*place);
                    points.push(point);
                }
            }
            if places.len() > LEAST_LANDMARKS { fit_pose(&places, &points) } else { None }
        };
        let first: Vec<Option<Pose>> = self.frames.iter().enumerate().map(pose).collect();
        // Shift the origin to the lumbar joint of the pelvis.
        let joints = first
            .iter()
            .zip(&pelvis.poses)
            .filter_map(|(torso, pelvis)| Some(in_frame(torso.as_ref()?, pelvis.as_ref()?.place(self.lumbar()))));
        let origin = median_point(&joints.collect::<Vec<_>>()).unwrap_or_default();
        first.into_iter().map(|pose| pose.map(|pose| pose * Pose::at(origin))).collect()
    }

    /// The trunk, with y from the lumbar joint to the point midway between the shoulders.
    fn trunk(&self, poses: Vec<Option<Pose>>) -> Trunk {
        let shoulders = Side::BOTH.map(|side| self.shoulder(&poses, side));
        let [Some(right), Some(left)] = shoulders else {
            return Trunk { poses, ..self.unmeasured() };
        };
        let lift = if self.are_arms_raised(&poses) { self.lift(&poses, 0.5 * (right.y + left.y)) } else { 0.0 };
        let [right, left] = [right, left].map(|s| s - Vec3::y() * lift);
        let middle = (right + left) * 0.5;
        let turn = about_z(atan2(-middle.x, middle.y));
        let poses = poses.into_iter().map(|pose| pose.map(|p| Pose { rotation: p.rotation * turn, ..p })).collect();
        let factor = (hypot(middle.x, middle.y) / self.length()).clamp(FACTORS[0], FACTORS[1]);
        let shoulders = BySide { right, left }.map(|s| turn.transpose() * s);
        Trunk { poses, factor, shoulders, lift, arms: BySide::from_fn(|_| None) }
    }

    /// Whether the upper arms are raised from the trunk.
    fn are_arms_raised(&self, poses: &[Option<Pose>]) -> bool {
        let cosine = |side: Side| {
            move |(pose, &frame): (&Option<Pose>, &usize)| {
                let arm = self.trajectories.of(Landmark::LateralElbow, side, frame)?
                    - self.trajectories.of(Landmark::Acromion, side, frame)?;
                Some(-direction(arm)?.dot(&pose.as_ref()?.rotation.column(1)))
            }
        };
        let all = Side::BOTH.into_iter().flat_map(|side| poses.iter().zip(self.frames).filter_map(cosine(side)));
        median(all).is_some_and(|cosine| cosine < cos(RAISED))
    }

    /// Height of the shoulders above that expected for hanging arms from neck markers and segment table [m].
    fn lift(&self, poses: &[Option<Pose>], height: f64) -> f64 {
        let neck = [Landmark::C7, Landmark::Jugular].map(|landmark| {
            let heights = poses.iter().zip(self.frames).filter_map(|(pose, &frame)| {
                Some(in_frame(pose.as_ref()?, self.trajectories.at(landmark, None, frame)?).y)
            });
            median(heights).map(|found| found / landmark.place().y)
        });
        let shoulders =
            median(neck.into_iter().flatten()).unwrap_or(self.length()) * Landmark::ShoulderCentre.place().y;
        (height - shoulders).max(0.0)
    }

    /// Position of a shoulder centre in the trunk [m].
    fn shoulder(&self, poses: &[Option<Pose>], side: Side) -> Option<Vec3> {
        let middle = |landmark: Landmark| {
            let points = poses.iter().zip(self.frames).filter_map(|(pose, &frame)| {
                Some(in_frame(pose.as_ref()?, self.trajectories.of(landmark, side, frame)?))
            });
            median_point(&points.collect::<Vec<_>>())
        };
        let usual = (Landmark::Acromion.place() - Landmark::ShoulderCentre.place()).y * self.length();
        let measured = self.person.measurements.shoulder_offset[side].map(|v| v + self.person.measurements.radius());
        let below = Vec3::y() * measured.unwrap_or(usual);
        middle(Landmark::ShoulderCentre).or_else(|| Some(middle(Landmark::Acromion)? - below))
    }

    fn arm(&self, trunk: &[Option<Pose>], shoulder: Vec3, side: Side) -> Option<Arm> {
        let frames: Vec<Option<[Pose; 2]>> = trunk
            .iter()
            .zip(self.frames)
            .map(|(trunk, &frame)| self.arm_frame(trunk.as_ref()?, shoulder, side, frame))
            .collect();
        let known: Vec<&[Pose; 2]> = frames.iter().flatten().collect();
        if known.len() < LEAST_FRAMES.min(self.frames.len()).max(1) {
            return None;
        }
        let upper = median(known.iter().map(|[h, f]| (h.translation - f.translation).norm()))?;
        let wrists = trunk.iter().zip(self.frames).zip(&frames).filter_map(|((_, &frame), poses)| {
            Some((self.wrist(side, frame)? - poses.as_ref()?[1].translation).norm())
        });
        let lower = median(wrists)?;
        let is_usual = |found: f64, usual: f64| (FACTORS[0]..=FACTORS[1]).contains(&(found / usual));
        let d = self.dimensions;
        (is_usual(upper, d.upper_arm) && is_usual(lower, d.forearm)).then_some(Arm { frames, upper, lower })
    }

    /// Centre of the wrist, or its only marker [m].
    fn wrist(&self, side: Side, frame: usize) -> Option<Vec3> {
        let at = |landmark: Landmark| self.trajectories.of(landmark, side, frame);
        match (at(Landmark::RadialStyloid), at(Landmark::UlnarStyloid)) {
            (Some(radial), Some(ulnar)) => Some((radial + ulnar) * 0.5),
            (radial, ulnar) => at(Landmark::WristCentre).or(radial).or(ulnar),
        }
    }

    fn arm_frame(&self, trunk: &Pose, shoulder: Vec3, side: Side, frame: usize) -> Option<[Pose; 2]> {
        let at = |landmark: Landmark| self.trajectories.of(landmark, side, frame);
        let out = if side == Side::Right { 1.0 } else { -1.0 };
        let (shoulder, wrist) = (trunk.place(shoulder), self.wrist(side, frame)?);
        let across: Vec3 = trunk.rotation.column(2).into();
        let (elbow, axis) = match (at(Landmark::ElbowCentre), at(Landmark::LateralElbow), at(Landmark::MedialElbow)) {
            (Some(centre), ..) => (centre, bending_axis(shoulder, centre, wrist).unwrap_or(across)),
            (None, Some(lateral), Some(medial)) => ((lateral + medial) * 0.5, direction(lateral - medial)? * out),
            (None, Some(lateral), None) => self.elbow(shoulder, lateral, wrist, across, side, frame),
            _ => return None,
        };
        let humerus = from_y_z(shoulder - elbow, axis)?;
        let forearm = match (at(Landmark::RadialStyloid), at(Landmark::UlnarStyloid)) {
            (Some(radial), Some(ulnar)) => from_y_x(elbow - wrist, radial - ulnar)?,
            _ => from_y_z(elbow - wrist, axis)?,
        };
        Some([Pose { rotation: humerus, translation: shoulder }, Pose { rotation: forearm, translation: elbow }])
    }

    /// Elbow centre and axis (to the right) from the lateral marker alone. The axis is the normal of the plane of
    /// shoulder, centre and wrist if the elbow is flexed; otherwise that of a forearm halfway between pronation and
    /// supination.
    fn elbow(
        &self,
        shoulder: Vec3,
        lateral: Vec3,
        wrist: Vec3,
        across: Vec3,
        side: Side,
        frame: usize,
    ) -> (Vec3, Vec3) {
        const ROUNDS: usize = 4;
        /// A normal more than 60° from the axis of the forearm means that the arm is nearly straight.
        const LEAST_COSINE: f64 = 0.5;
        let at = |landmark: Landmark| self.trajectories.of(landmark, side, frame);
        let thumb = at(Landmark::RadialStyloid).zip(at(Landmark::UlnarStyloid)).map(|(radial, ulnar)| radial - ulnar);
        let usual = thumb.and_then(|thumb| direction(thumb.cross(&(lateral - wrist)))).unwrap_or(across);
        let reach = self.half_elbow(side) * if side == Side::Right { 1.0 } else { -1.0 };
        let mut axis = usual;
        for _ in 0..ROUNDS {
            let normal = bending_axis(shoulder, lateral - axis * reach, wrist);
            axis = normal.filter(|n| n.dot(&usual) > LEAST_COSINE).unwrap_or(usual);
        }
        (lateral - axis * reach, axis)
    }

    /// Distance from the lateral marker to the elbow centre [m].
    fn half_elbow(&self, side: Side) -> f64 {
        let width = self.person.measurements.elbow_width[side].unwrap_or(ELBOW_BREADTH * self.dimensions.height);
        0.5 * width + self.person.measurements.radius()
    }
}

/// Normal of the plane of flexion of an elbow, to the right; `None` if it is nearly straight.
fn bending_axis(shoulder: Vec3, elbow: Vec3, wrist: Vec3) -> Option<Vec3> {
    let (upper, lower) = (direction(elbow - shoulder)?, direction(wrist - elbow)?);
    let normal = upper.cross(&lower);
    (normal.norm() > sin(BENT)).then(|| normal.normalize())
}
