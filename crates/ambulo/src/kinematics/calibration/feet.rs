//! Feet that stand flat: ankle joints, sizes, soles.

use super::axes::{about_x, about_y, angles_zxy, from_y_z, inside, median_point};
use super::legs::{Leg, Legs};
use super::person::index;
use super::reference::Trial;
use super::sight::Sight;
use crate::model::Side;
use crate::model::anthropometry::Dimensions;
use crate::model::full_body::FootPrint;
use crate::model::marker_set::Landmark;
use crate::numerics::median;
use crate::spatial::{Mat3, Pose, Vec3};

/// A foot in a walk lies flat where heel and toe markers are no higher than this above their lowest [m].
const FLAT: f64 = 0.008;
/// Where too few frames are as flat as that [m].
const NEARLY_FLAT: f64 = 0.02;
/// Frames in which a foot must lie flat, at least.
const LEAST_FRAMES: usize = 3;
/// The ground is y = 0 if the lowest foot marker of a flat foot stands between these heights above it [m].
const MARKER_HEIGHTS: [f64; 2] = [0.0, 0.1];
/// Heights of ankles, against the table's for a foot of that size, that need no remark.
const ANKLE_HEIGHTS: [f64; 2] = [0.6, 1.4];
/// Twists of the shank that need no remark [deg]: means in adults are 20 to 25 outwards, with a standard deviation of some 10 (unverified).
const TORSIONS_DEG: [f64; 2] = [-10.0, 40.0];
/// Sizes of feet against the table's that walkers have.
const FACTORS: [f64; 2] = [0.6, 1.6];

/// Both feet, right first.
pub(super) type Feet = [Foot; 2];

/// A foot of the subject.
#[derive(Debug)]
pub(super) struct Foot {
    /// Pose of the flat foot, origin at the ankle, in the measured frames in which it lies flat.
    pub(super) poses: Vec<Option<Pose>>,
    /// Size against the table's.
    pub(super) factor: f64,
    /// Where the sole lies.
    pub(super) print: FootPrint,
    /// Axes of the ankle's joint in the shank.
    pub(super) tibia_from_joint: Mat3,
    /// Axes of the foot in those of the joint, ankle at zero.
    pub(super) joint_from_foot: Mat3,
}

/// The rear and the front point by which a foot is directed, in the world and on the table's foot [m].
struct Ends {
    rear: Vec3,
    front: Vec3,
    table_rear: Vec3,
    table_front: Vec3,
}

pub(super) fn find(
    sight: &Sight<'_>,
    frames: &[usize],
    trial: Trial,
    legs: &Legs,
    dimensions: &Dimensions,
    assumptions: &mut Vec<String>,
) -> Feet {
    let finder = Finder { sight, frames, trial, dimensions };
    let floor = finder.floor(assumptions);
    Side::BOTH.map(|side| match &legs[index(side)] {
        Some(leg) => finder.foot(leg, side, floor, assumptions),
        None => table_foot(dimensions, frames.len()),
    })
}

fn table_foot(dimensions: &Dimensions, count: usize) -> Foot {
    Foot {
        poses: vec![None; count],
        factor: 1.0,
        print: FootPrint::of(dimensions),
        tibia_from_joint: Mat3::identity(),
        joint_from_foot: Mat3::identity(),
    }
}

struct Finder<'a> {
    sight: &'a Sight<'a>,
    frames: &'a [usize],
    trial: Trial,
    dimensions: &'a Dimensions,
}

impl Finder<'_> {
    /// Height of the ground [m]: zero, unless the markers of the feet stand elsewhere.
    fn floor(&self, assumptions: &mut Vec<String>) -> f64 {
        let heights =
            |side: Side| self.frames.iter().filter_map(move |&f| self.sight.of(Landmark::Heel, side, f)).map(|p| p.y);
        let lowest = Side::BOTH.into_iter().flat_map(heights).fold(f64::INFINITY, f64::min);
        if !lowest.is_finite() || (MARKER_HEIGHTS[0]..=MARKER_HEIGHTS[1]).contains(&lowest) {
            return 0.0;
        }
        let floor = lowest - (self.dimensions.ankle_height + self.place(Landmark::Heel, Side::Right).y);
        assumptions.push(format!("the ground is taken at {floor:.3} m, from the lowest height of the heel markers"));
        floor
    }

    /// Where a landmark stands on the table's foot, from the ankle [m].
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

    /// The best front point that the recording has: the middle of one or two landmarks.
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
        let is_there = |list: &&[Landmark]| list.iter().all(|&l| self.sight.has(l, Some(side)));
        candidates.into_iter().find(is_there).map(<[Landmark]>::to_vec)
    }

    fn ends(&self, leg: &Leg, side: Side, front: &[Landmark], measured: usize) -> Option<Ends> {
        let frame = self.frames[measured];
        let mean = |list: &[Vec3]| list.iter().sum::<Vec3>() / list.len() as f64;
        let points: Option<Vec<Vec3>> = front.iter().map(|&l| self.sight.of(l, side, frame)).collect();
        let places: Vec<Vec3> = front.iter().map(|&l| self.place(l, side)).collect();
        let (rear, table_rear) = if self.sight.has(Landmark::Heel, Some(side)) {
            (self.sight.of(Landmark::Heel, side, frame)?, self.place(Landmark::Heel, side))
        } else {
            (leg.frames[measured]?.ankle, Vec3::zeros())
        };
        Some(Ends { rear, front: mean(&points?), table_rear, table_front: mean(&places) })
    }

    fn foot(&self, leg: &Leg, side: Side, floor: f64, assumptions: &mut Vec<String>) -> Foot {
        let count = self.frames.len();
        let Some(front) = self.front(side) else {
            assumptions
                .push(format!("the {side} foot has no marker in front; it keeps the table's size and is not measured"));
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
        let Some(ankle_height) = median(poses.iter().flatten().map(|pose| pose.translation.y - floor)) else {
            assumptions.push(format!("the {side} foot was never seen flat; it keeps the table's shape"));
            return Foot { factor, ..self.unmeasured(leg, count) };
        };
        let usual = self.dimensions.ankle_height * factor;
        if !(ANKLE_HEIGHTS[0]..=ANKLE_HEIGHTS[1]).contains(&(ankle_height / usual)) {
            assumptions.push(format!(
                "the {side} ankle stands {:.0} mm above y = 0, where a foot of this length has {:.0}: shoes, or the ground is elsewhere",
                1e3 * ankle_height,
                1e3 * usual
            ));
        }
        let rear = |(pose, ends): (&Option<Pose>, &Option<Ends>)| Some(inside(pose.as_ref()?, ends.as_ref()?.rear));
        let rear = median_point(&poses.iter().zip(&ends).filter_map(rear).collect::<Vec<_>>()).unwrap_or_default();
        let table_rear = ends.iter().flatten().map(|e| e.table_rear).next().unwrap_or_default();
        let print = FootPrint { ankle_height, forward: rear.x - table_rear.x * factor, right: rear.z };
        let tibia_from_joint = ankle_axes(leg, &poses);
        note_torsion(&tibia_from_joint, side, assumptions);
        let joint_from_foot = standing_offset(leg, &poses, &tibia_from_joint);
        Foot { poses, factor, print, tibia_from_joint, joint_from_foot }
    }

    fn unmeasured(&self, leg: &Leg, count: usize) -> Foot {
        Foot { tibia_from_joint: ankle_axes(leg, &vec![None; count]), ..table_foot(self.dimensions, count) }
    }

    /// In which measured frames the foot lies flat.
    fn flat(&self, ends: &[Option<Ends>], side: Side, assumptions: &mut Vec<String>) -> Vec<bool> {
        if self.trial == Trial::Standing {
            return ends.iter().map(Option::is_some).collect();
        }
        let lowest = |height: fn(&Ends) -> f64| low(ends.iter().flatten().map(height).collect());
        let (rear, front) = (lowest(|e| e.rear.y), lowest(|e| e.front.y));
        for allowed in [FLAT, NEARLY_FLAT] {
            let is_flat = |e: &Ends| e.rear.y < rear + allowed && e.front.y < front + allowed;
            let flat: Vec<bool> = ends.iter().map(|e| e.as_ref().is_some_and(is_flat)).collect();
            if flat.iter().filter(|&&f| f).count() >= LEAST_FRAMES {
                return flat;
            }
        }
        assumptions.push(format!("the {side} foot lies flat in fewer than {LEAST_FRAMES} of the frames measured"));
        vec![false; ends.len()]
    }
}

/// A low value that a few outliers do not reach: one in twenty is lower.
fn low(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 20).copied().unwrap_or(f64::NAN)
}

/// Length over the ground [m].
fn flat_length(v: Vec3) -> f64 {
    v.x.hypot(v.z)
}

/// Upright axes, turned so that the line from rear to front lies as on the table's foot.
fn heading(ends: &Ends) -> Mat3 {
    let angle = |v: Vec3| (-v.z).atan2(v.x);
    about_y(angle(ends.front - ends.rear) - angle(ends.table_front - ends.table_rear))
}

/// Axes of the ankle's joint in the shank: y along the shank, z along the line of the malleoli as far as that leaves it. The line itself
/// is 6 to 10 degrees off a right angle to the shank, by a marker's place as much as by the joint's axis. The frames in which the foot
/// lies flat count, all frames if it never does.
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

/// Says if the ankle axis lies where no shank is twisted so far.
fn note_torsion(tibia_from_joint: &Mat3, side: Side, assumptions: &mut Vec<String>) {
    let axis = tibia_from_joint.column(2);
    let out = if side == Side::Right { 1.0 } else { -1.0 };
    let outwards = (-axis.x * out).atan2(axis.z).to_degrees();
    if !(TORSIONS_DEG[0]..=TORSIONS_DEG[1]).contains(&outwards) {
        assumptions.push(format!(
            "the {side} ankle axis is turned outwards by {outwards:.0} degrees against the knee axis (usual: 10 to 30): a wand or a knee marker may be misplaced, and moments about these axes with it"
        ));
    }
}

/// What the flat foot deviates from the joint's axes beside dorsiflexion.
fn standing_offset(leg: &Leg, poses: &[Option<Pose>], tibia_from_joint: &Mat3) -> Mat3 {
    let angles = |(frame, pose): (&Option<super::legs::LegFrame>, &Option<Pose>)| {
        let joint = frame.as_ref()?.tibia.rotation * tibia_from_joint;
        Some(angles_zxy(&(joint.transpose() * pose.as_ref()?.rotation)))
    };
    let list: Vec<[f64; 3]> = leg.frames.iter().zip(poses).filter_map(angles).collect();
    let middle = |i: usize| median(list.iter().map(|a| a[i])).unwrap_or(0.0);
    about_x(middle(1)) * about_y(middle(2))
}
