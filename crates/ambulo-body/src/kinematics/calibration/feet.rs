//! Feet: ankle joints, sizes and soles, from frames in which the feet are flat.

use super::axes::{about_x, about_y, angles_zxy, from_y_z, in_frame, median_point};
use super::landmark_trajectories::LandmarkTrajectories;
use super::legs::{Leg, Legs};
use super::reference::Trial;
use crate::model::anthropometry::Dimensions;
use crate::model::marker_set::Landmark;
use crate::model::subject_shape::SolePlacement;
use crate::model::{BySide, Side};
use crate::numerics::elementary::{atan2, hypot};
use crate::numerics::{degrees, median, quantiles};
use crate::spatial::{Mat3, Pose, Vec3};

/// In a walk a foot is flat while heel and toe markers are at most this high above their lowest positions [m].
const FLAT: f64 = 0.008;
/// The same if too few frames are flat [m].
const NEARLY_FLAT: f64 = 0.02;
/// Smallest number of frames in which a foot is flat.
const LEAST_FRAMES: usize = 3;
/// The ground is at y = 0 if the lowest heel marker is between these heights [m].
const MARKER_HEIGHTS: [f64; 2] = [0.0, 0.1];
/// Usual heights of ankles, relative to that of the segment table for a foot of this size.
const ANKLE_HEIGHTS: [f64; 2] = [0.6, 1.4];
/// Usual tibial torsions [deg]: means in adults are 20 to 25 outwards, with a standard deviation of about 10
/// (unverified).
const TORSIONS_DEG: [f64; 2] = [-10.0, 40.0];
/// Plausible scale factors of feet.
const FACTORS: [f64; 2] = [0.6, 1.6];

/// Standard deviation of foot length at a given stature, as a share (unverified).
const LENGTH_ERROR: f64 = 0.05;
/// The same for the length between keypoints: each is 20 mm off on a foot of 0.25 m.
const KEYPOINT_LENGTH_ERROR: f64 = 0.12;
/// Share of the distance between ankle and foot, by keypoints, that exceeds the usual one and is believed: both ends
/// together are 14 mm off, people differ by 10 mm.
const KEYPOINT_SHIFT: f64 = 0.33;

/// Both feet, right first.
pub(super) type Feet = BySide<Foot>;

/// Pose, size, sole and ankle joint of one foot.
#[derive(Debug)]
pub(super) struct Foot {
    /// Pose of the foot in the selected frames in which it is flat, origin at the ankle.
    pub(super) poses: Vec<Option<Pose>>,
    /// Scale factor relative to the segment table.
    pub(super) factor: f64,
    /// Position of the sole.
    pub(super) placement: SolePlacement,
    /// Axes of the ankle joint in the shank.
    pub(super) tibia_from_joint: Mat3,
    /// Axes of the foot in the joint, at zero ankle angle.
    pub(super) joint_from_foot: Mat3,
}

/// The trial and the kind of points that show the feet.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Observed {
    pub(super) trial: Trial,
    /// Whether heel and toe are keypoints of video.
    pub(super) keypoints: bool,
}

/// Rear and front point that define the direction of a foot, in the world and on the foot of the segment table [m].
struct Ends {
    rear: Vec3,
    front: Vec3,
    table_rear: Vec3,
    table_front: Vec3,
}

pub(super) fn find(
    trajectories: &LandmarkTrajectories<'_>,
    frames: &[usize],
    observed: Observed,
    legs: &Legs,
    dimensions: &Dimensions,
    assumptions: &mut Vec<String>,
) -> Feet {
    let finder = Finder { trajectories, frames, observed, dimensions };
    let floor = finder.floor(assumptions);
    BySide::from_fn(|side| match &legs[side] {
        Some(leg) => finder.foot(leg, side, floor, assumptions),
        None => table_foot(dimensions, frames.len()),
    })
}

fn table_foot(dimensions: &Dimensions, count: usize) -> Foot {
    Foot {
        poses: vec![None; count],
        factor: 1.0,
        placement: SolePlacement::of(dimensions),
        tibia_from_joint: Mat3::identity(),
        joint_from_foot: Mat3::identity(),
    }
}

struct Finder<'a> {
    trajectories: &'a LandmarkTrajectories<'a>,
    frames: &'a [usize],
    observed: Observed,
    dimensions: &'a Dimensions,
}

impl Finder<'_> {
    /// Height of the ground [m]: zero if the heel markers agree, otherwise estimated from them.
    fn floor(&self, assumptions: &mut Vec<String>) -> f64 {
        let heights = |side: Side| {
            self.frames.iter().filter_map(move |&f| self.trajectories.of(Landmark::Heel, side, f)).map(|p| p.y)
        };
        let lowest = Side::BOTH.into_iter().flat_map(heights).fold(f64::INFINITY, f64::min);
        let is_usual = (MARKER_HEIGHTS[0]..=MARKER_HEIGHTS[1]).contains(&lowest) && !self.observed.keypoints;
        if !lowest.is_finite() || is_usual {
            return 0.0;
        }
        let floor = lowest - (self.dimensions.ankle_height + self.place(Landmark::Heel, Side::Right).y);
        assumptions.push(format!("the ground is assumed at {floor:.3} m, from the lowest height of the heel markers"));
        floor
    }

    /// Position of a landmark on the foot of the segment table, relative to the ankle [m].
    fn place(&self, landmark: Landmark, side: Side) -> Vec3 {
        let d = self.dimensions;
        let mut place = landmark.place() * d.foot_length;
        if matches!(landmark, Landmark::Hallux | Landmark::SmallToe) {
            place += Vec3::new(d.ankle_to_ball, d.ball_radius - d.ankle_height, 0.0);
        }
        if side == Side::Left {
            place.z = -place.z;
        }
        place
    }

    /// The best front point in the recording: one landmark, or midway between two.
    fn front(&self, side: Side) -> Option<Vec<Landmark>> {
        use Landmark as L;
        let candidates: [&[Landmark]; 7] = [
            &[L::SecondToe],
            &[L::FirstMetatarsal, L::FifthMetatarsal],
            &[L::Hallux, L::SmallToe],
            &[L::Hallux],
            &[L::FirstMetatarsal],
            &[L::FifthMetatarsal],
            &[L::SmallToe],
        ];
        let is_there = |list: &&[Landmark]| list.iter().all(|&l| self.trajectories.has(l, Some(side)));
        candidates.into_iter().find(is_there).map(<[Landmark]>::to_vec)
    }

    fn ends(&self, leg: &Leg, side: Side, front: &[Landmark], measured: usize) -> Option<Ends> {
        let frame = self.frames[measured];
        let mean = |list: &[Vec3]| list.iter().sum::<Vec3>() / list.len() as f64;
        let points: Option<Vec<Vec3>> = front.iter().map(|&l| self.trajectories.of(l, side, frame)).collect();
        let places: Vec<Vec3> = front.iter().map(|&l| self.place(l, side)).collect();
        let (rear, table_rear) = if self.trajectories.has(Landmark::Heel, Some(side)) {
            (self.trajectories.of(Landmark::Heel, side, frame)?, self.place(Landmark::Heel, side))
        } else {
            (leg.frames[measured]?.ankle, Vec3::zeros())
        };
        Some(Ends { rear, front: mean(&points?), table_rear, table_front: mean(&places) })
    }

    fn foot(&self, leg: &Leg, side: Side, floor: f64, assumptions: &mut Vec<String>) -> Foot {
        let count = self.frames.len();
        let Some(front) = self.front(side) else {
            assumptions.push(format!("the {side} foot has no marker at its front; its size is from the segment table"));
            return self.unmeasured(leg, count);
        };
        let ends: Vec<Option<Ends>> = (0..count).map(|measured| self.ends(leg, side, &front, measured)).collect();
        let flat = self.flat(&ends, side, assumptions);
        let pose = |measured: usize| {
            let (ends, at) = (ends[measured].as_ref()?, leg.frames[measured]?);
            flat[measured].then(|| Pose { rotation: heading(ends), translation: at.ankle })
        };
        let poses: Vec<Option<Pose>> = (0..count).map(pose).collect();
        let size =
            ends.iter().flatten().map(|e| flat_length(e.front - e.rear) / flat_length(e.table_front - e.table_rear));
        let factor = median(size).unwrap_or(1.0).clamp(FACTORS[0], FACTORS[1]);
        let factor = if self.observed.keypoints { self.by_stature(factor, side, assumptions) } else { factor };
        let Some(ankle_height) = median(poses.iter().flatten().map(|pose| pose.translation.y - floor)) else {
            assumptions.push(format!("the {side} foot is never flat; its shape is from the segment table"));
            return Foot { factor, ..self.unmeasured(leg, count) };
        };
        let usual = self.dimensions.ankle_height * factor;
        if !(ANKLE_HEIGHTS[0]..=ANKLE_HEIGHTS[1]).contains(&(ankle_height / usual)) {
            assumptions.push(format!(
                "the {side} ankle is {:.0} mm above y = 0; {:.0} mm is usual for a foot of this length: shoes, or the \
                 ground is at another height",
                1e3 * ankle_height,
                1e3 * usual
            ));
        }
        let rear = |(pose, ends): (&Option<Pose>, &Option<Ends>)| Some(in_frame(pose.as_ref()?, ends.as_ref()?.rear));
        let rear = median_point(&poses.iter().zip(&ends).filter_map(rear).collect::<Vec<_>>()).unwrap_or_default();
        let table_rear = ends.iter().flatten().map(|e| e.table_rear).next().unwrap_or_default();
        let forward = rear.x - table_rear.x * factor;
        let placement = if self.observed.keypoints {
            let front = |(pose, ends): (&Option<Pose>, &Option<Ends>)| {
                Some(in_frame(pose.as_ref()?, ends.as_ref()?.front).x - ends.as_ref()?.table_front.x * factor)
            };
            let of_front = median(poses.iter().zip(&ends).filter_map(front)).unwrap_or(forward);
            SolePlacement { ankle_height, forward: 0.5 * (forward + of_front) * KEYPOINT_SHIFT, right: 0.0 }
        } else {
            SolePlacement { ankle_height, forward, right: rear.z }
        };
        let tibia_from_joint = ankle_axes(leg, &poses);
        report_unusual_torsion(&tibia_from_joint, side, assumptions);
        let joint_from_foot = standing_offset(leg, &poses, &tibia_from_joint);
        Foot { poses, factor, placement, tibia_from_joint, joint_from_foot }
    }

    /// Scale factor of a foot whose length between keypoints is `measured` times the usual one: the mean of both,
    /// weighted by their errors.
    fn by_stature(&self, measured: f64, side: Side, assumptions: &mut Vec<String>) -> f64 {
        let [seen, usual] = [KEYPOINT_LENGTH_ERROR, LENGTH_ERROR].map(|error: f64| error.powi(-2));
        if (measured - 1.0).abs() > 2.0 * KEYPOINT_LENGTH_ERROR {
            assumptions.push(format!(
                "the {side} foot is {measured:.2} times as long between the points of heel and toe as is usual at this \
                 stature; the sole follows the stature"
            ));
        }
        (seen * measured + usual) / (seen + usual)
    }

    fn unmeasured(&self, leg: &Leg, count: usize) -> Foot {
        Foot { tibia_from_joint: ankle_axes(leg, &vec![None; count]), ..table_foot(self.dimensions, count) }
    }

    /// Whether the foot is flat, for each selected frame.
    fn flat(&self, ends: &[Option<Ends>], side: Side, assumptions: &mut Vec<String>) -> Vec<bool> {
        if self.observed.trial == Trial::Standing {
            return ends.iter().map(Option::is_some).collect();
        }
        let lowest = |height: fn(&Ends) -> f64| fifth_percentile(ends.iter().flatten().map(height).collect());
        let (rear, front) = (lowest(|e| e.rear.y), lowest(|e| e.front.y));
        for allowed in [FLAT, NEARLY_FLAT] {
            let is_flat = |e: &Ends| e.rear.y < rear + allowed && e.front.y < front + allowed;
            let flat: Vec<bool> = ends.iter().map(|e| e.as_ref().is_some_and(is_flat)).collect();
            if flat.iter().filter(|&&f| f).count() >= LEAST_FRAMES {
                return flat;
            }
        }
        assumptions.push(format!("the {side} foot is flat in fewer than {LEAST_FRAMES} of the selected frames"));
        vec![false; ends.len()]
    }
}

/// The fifth percentile: a lowest value without outliers.
fn fifth_percentile(values: Vec<f64>) -> f64 {
    quantiles(values, [0.05]).map_or(f64::NAN, |[low]| low)
}

/// Horizontal length [m].
fn flat_length(v: Vec3) -> f64 {
    hypot(v.x, v.z)
}

/// Upright axes in which the line from rear to front has the direction that it has on the foot of the segment table.
fn heading(ends: &Ends) -> Mat3 {
    let angle = |v: Vec3| atan2(-v.z, v.x);
    about_y(angle(ends.front - ends.rear) - angle(ends.table_front - ends.table_rear))
}

/// Axes of the ankle joint in the shank: y along the shank, z along the part of the line of the malleoli perpendicular
/// to y. The line itself is 6 to 10 degrees off the perpendicular, as much by marker placement as by the axis of the
/// joint. Uses the frames in which the foot is flat, or all frames if there is none.
fn ankle_axes(leg: &Leg, poses: &[Option<Pose>]) -> Mat3 {
    let axis = |all: bool| {
        let both = leg.frames.iter().zip(poses).filter(|(_, pose)| all || pose.is_some());
        let list: Vec<Vec3> =
            both.filter_map(|(f, _)| f.map(|f| f.tibia.rotation.transpose() * f.ankle_axis)).collect();
        median_point(&list)
    };
    let axis = axis(false).or_else(|| axis(true)).unwrap_or_else(Vec3::z);
    from_y_z(Vec3::y(), axis).unwrap_or_else(Mat3::identity)
}

/// Reports an ankle axis outside the usual tibial torsion.
fn report_unusual_torsion(tibia_from_joint: &Mat3, side: Side, assumptions: &mut Vec<String>) {
    let axis = tibia_from_joint.column(2);
    let out = if side == Side::Right { 1.0 } else { -1.0 };
    let outwards = atan2(-axis.x * out, axis.z).to_degrees();
    if !(TORSIONS_DEG[0]..=TORSIONS_DEG[1]).contains(&outwards) {
        let way = if outwards < 0.0 { "inwards" } else { "outwards" };
        let angle = degrees(outwards.abs());
        assumptions.push(format!(
            "the {side} ankle axis is rotated {way} by {angle} relative to the knee axis (usual: 10 to 30 outwards): \
             a wand or a knee marker may be misplaced, which affects the moments about these axes"
        ));
    }
}

/// Rotation of the flat foot relative to the axes of the joint, without dorsiflexion.
fn standing_offset(leg: &Leg, poses: &[Option<Pose>], tibia_from_joint: &Mat3) -> Mat3 {
    let angles = |(frame, pose): (&Option<super::legs::LegFrame>, &Option<Pose>)| {
        let joint = frame.as_ref()?.tibia.rotation * tibia_from_joint;
        Some(angles_zxy(&(joint.transpose() * pose.as_ref()?.rotation)))
    };
    let list: Vec<[f64; 3]> = leg.frames.iter().zip(poses).filter_map(angles).collect();
    let middle = |i: usize| median(list.iter().map(|a| a[i])).unwrap_or(0.0);
    about_x(middle(1)) * about_y(middle(2))
}
