//! Thighs and shanks: joint centres, lengths and axes.

use super::CalibrationError;
use super::axes::{angles_zxy, direction, from_y_z, perpendicular};
use super::landmark_trajectories::LandmarkTrajectories;
use super::pelvis::Pelvis;
use super::person::PersonMeasurements;
use crate::model::anthropometry::{Build, BuildError, SegmentTable};
use crate::model::marker_set::Landmark;
use crate::model::{BySide, Side};
use crate::numerics::elementary::sin;
use crate::numerics::median;
use crate::spatial::{Pose, Vec3, rotation_about};

/// Default widths as shares of stature: those of the adult in the Plug-in-Gait sample of BTKData (102 and 70 mm at
/// 1.76 m); a child of 1.45 m has 0.057 and 0.043.
const KNEE_BREADTH: f64 = 0.058;
const ANKLE_BREADTH: f64 = 0.040;
/// Plausible lengths of thighs and shanks [m].
const LENGTHS: [f64; 2] = [0.08, 0.75];
/// A knee flexed more than this [rad] shows its plane of flexion.
const BENT: f64 = 0.35;
/// Varus is measured where the knee is flexed less than this [rad]: at larger angles an error of the axis appears as
/// varus.
const NEARLY_STRAIGHT: f64 = 0.5;
/// A wand further than 60 degrees from straight outwards is none, but a marker in front or behind with the same name:
/// wands are placed within 15 to 20 degrees of the plane of the joint.
const WAND_COSINE: f64 = 0.5;
/// Smallest number of frames in which a leg is visible.
const LEAST_FRAMES: usize = 3;

/// Both legs, right first; `None` without markers.
pub(super) type Legs = BySide<Option<Leg>>;

/// Thigh and shank of one leg.
#[derive(Debug)]
pub(super) struct Leg {
    /// One entry per selected frame.
    pub(super) frames: Vec<Option<LegFrame>>,
    /// Hip to knee [m].
    pub(super) thigh: f64,
    /// Knee to ankle [m].
    pub(super) shank: f64,
    /// Angle about x between the shank and the plane of the knee's hinge [rad].
    pub(super) varus: f64,
}

/// A leg in one frame.
#[derive(Debug, Clone, Copy)]
pub(super) struct LegFrame {
    /// Origin at the hip, y from knee to hip, z along the knee axis.
    pub(super) femur: Pose,
    /// Origin at the knee, y from ankle to knee, z along the knee axis.
    pub(super) tibia: Pose,
    pub(super) ankle: Vec3,
    /// Direction of the ankle axis, to the right.
    pub(super) ankle_axis: Vec3,
}

/// How the centre of a knee or an ankle is determined.
#[derive(Debug, Clone, Copy)]
enum Method {
    /// It is recorded.
    Centre(Landmark),
    /// Midway between the lateral and the medial marker.
    Middle(Landmark, Landmark),
    /// Half the width [m] inside the lateral marker, in the plane of a wand.
    Wand(Landmark, Landmark, f64),
    /// Half the width [m] inside the lateral marker, in the plane of a given axis.
    Plane(Landmark, f64),
    /// Of an ankle without a marker: where it is on a usual foot between heel and this front landmark, in the plane of
    /// heel, front and knee.
    OfFoot(Landmark),
}

/// Front landmarks of a foot that place its ankle, the best first.
const FRONTS: [Landmark; 5] = [
    Landmark::SecondToe,
    Landmark::FirstMetatarsal,
    Landmark::FifthMetatarsal,
    Landmark::FifthBase,
    Landmark::Navicular,
];

/// Landmarks of a joint of the leg.
struct JointLandmarks {
    name: &'static str,
    centre: Landmark,
    lateral: Landmark,
    medial: Landmark,
    wand: Landmark,
}

const KNEE: JointLandmarks = JointLandmarks {
    name: "knee",
    centre: Landmark::KneeCentre,
    lateral: Landmark::LateralEpicondyle,
    medial: Landmark::MedialEpicondyle,
    wand: Landmark::ThighWand,
};
const ANKLE: JointLandmarks = JointLandmarks {
    name: "ankle",
    centre: Landmark::AnkleCentre,
    lateral: Landmark::LateralMalleolus,
    medial: Landmark::MedialMalleolus,
    wand: Landmark::ShankWand,
};

pub(super) fn find(
    trajectories: &LandmarkTrajectories<'_>,
    frames: &[usize],
    pelvis: &Pelvis,
    person: &PersonMeasurements,
    assumptions: &mut Vec<String>,
) -> Result<Legs, CalibrationError> {
    let mut legs = BySide { right: None, left: None };
    for side in Side::BOTH {
        let breadths = breadths(trajectories, frames, pelvis, person, side);
        let turn = person.measurements.joints.knees[side];
        let finder = Finder { trajectories, frames, side, turn };
        let (Some(knee), Some(ankle)) = (
            finder.method((&KNEE, pelvis), breadths[0], person.measurements.radius(), assumptions),
            finder.method((&ANKLE, pelvis), breadths[1], person.measurements.radius(), assumptions),
        ) else {
            assumptions.push(format!(
                "the {side} leg has no markers at knee and ankle; its lengths are from the segment table"
            ));
            continue;
        };
        legs[side] = Some(leg(&finder, pelvis, knee, ankle)?);
    }
    if legs.values().all(Option::is_none) {
        return Err(CalibrationError::Markers {
            part: "legs".to_owned(),
            needed:
                "on one side at least lateral_epicondyle or knee_centre, and lateral_malleolus, ankle_centre or heel \
                     with a marker of the forefoot,"
                    .to_owned(),
            found: trajectories.words(),
        });
    }
    Ok(legs)
}

/// Widths of knee and ankle [m], and whether they were measured.
fn breadths(
    trajectories: &LandmarkTrajectories<'_>,
    frames: &[usize],
    pelvis: &Pelvis,
    person: &PersonMeasurements,
    side: Side,
) -> [(f64, bool); 2] {
    let measured = [person.measurements.knee_width[side], person.measurements.ankle_width[side]];
    let stature = person.height.or_else(|| rough_stature(trajectories, frames, pelvis, side)).unwrap_or(f64::NAN);
    let usual = [KNEE_BREADTH * stature, ANKLE_BREADTH * stature];
    [0, 1].map(|i| measured[i].map_or((usual[i], false), |width| (width, true)))
}

/// Stature [m] from hip, lateral epicondyle and lateral malleolus: thigh and shank are about 0.49 of it, the thigh
/// alone half of this.
fn rough_stature(
    trajectories: &LandmarkTrajectories<'_>,
    frames: &[usize],
    pelvis: &Pelvis,
    side: Side,
) -> Option<f64> {
    const LEG_SHARE: f64 = 0.49;
    let length = |measured: usize, frame: usize| {
        let knee = trajectories.of(Landmark::LateralEpicondyle, side, frame)?;
        let thigh = (pelvis.hip(measured, side)? - knee).norm();
        let shank = trajectories.of(Landmark::LateralMalleolus, side, frame).map(|ankle| (knee - ankle).norm());
        Some((thigh + shank.unwrap_or(thigh)) / LEG_SHARE)
    };
    median(frames.iter().enumerate().filter_map(|(measured, &frame)| length(measured, frame)))
}

/// Finds one leg's joints.
struct Finder<'a> {
    trajectories: &'a LandmarkTrajectories<'a>,
    frames: &'a [usize],
    side: Side,
    /// Turn of the knee's axis about the long axis of the thigh [rad].
    turn: Option<f64>,
}

impl Finder<'_> {
    /// The best method that the visible markers allow; its assumptions are added to the list.
    fn method(
        &self,
        (joint, pelvis): (&JointLandmarks, &Pelvis),
        (breadth, is_measured): (f64, bool),
        radius: f64,
        assumptions: &mut Vec<String>,
    ) -> Option<Method> {
        if self.together(&[joint.centre]) {
            return Some(Method::Centre(joint.centre));
        }
        if self.together(&[joint.lateral, joint.medial]) {
            return Some(Method::Middle(joint.lateral, joint.medial));
        }
        let (side, name) = (self.side, joint.name);
        if !self.together(&[joint.lateral]) {
            let front = FRONTS.into_iter().find(|front| self.together(&[Landmark::Heel, *front]))?;
            if joint.name != ANKLE.name {
                return None;
            }
            assumptions.push(format!(
                "the {side} ankle has no marker: its centre is assumed where a usual foot has it, by the markers of \
                 heel and forefoot"
            ));
            return Some(Method::OfFoot(front));
        }
        if !is_measured {
            assumptions.push(format!(
                "the {side} {name} is assumed {:.0} mm wide, a share of stature: it has no medial marker and no \
                 measured width",
                1e3 * breadth
            ));
        }
        let half = 0.5 * breadth + radius;
        if self.together(&[joint.lateral, joint.wand]) && self.is_wand_outside(joint, pelvis) {
            return Some(Method::Wand(joint.lateral, joint.wand, half));
        }
        let plane = if joint.name == KNEE.name {
            "perpendicular to the sagittal plane of the pelvis"
        } else {
            "parallel to the knee axis"
        };
        assumptions.push(format!("the {side} {name} axis is assumed {plane}: there is no medial marker and no wand"));
        Some(Method::Plane(joint.lateral, half))
    }

    /// Whether a wand lies on the outer side of its segment, within [`WAND_COSINE`] of straight outwards.
    fn is_wand_outside(&self, joint: &JointLandmarks, pelvis: &Pelvis) -> bool {
        let out = if self.side == Side::Right { 1.0 } else { -1.0 };
        let cosine = |(measured, &frame): (usize, &usize)| {
            let at = |landmark: Landmark| self.trajectories.of(landmark, self.side, frame);
            let upper = if joint.name == KNEE.name { pelvis.hip(measured, self.side) } else { at(KNEE.lateral) };
            let lateral = at(joint.lateral)?;
            let along = direction(upper? - lateral)?;
            let outwards = perpendicular(pelvis.right(measured)? * out, along)?;
            Some(perpendicular(at(joint.wand)? - lateral, along)?.dot(&outwards))
        };
        median(self.frames.iter().enumerate().filter_map(cosine)).is_none_or(|cosine| cosine > WAND_COSINE)
    }

    /// Whether landmarks are visible together in enough frames.
    fn together(&self, landmarks: &[Landmark]) -> bool {
        let is_seen = |&&frame: &&usize| landmarks.iter().all(|&l| self.trajectories.of(l, self.side, frame).is_some());
        let needed = LEAST_FRAMES.min(self.frames.len()).max(1);
        self.frames.iter().filter(is_seen).count() >= needed
    }

    /// Centre and axis (to the right) of a joint below `upper`; `given` is the axis if no better one is known.
    fn joint(&self, method: Method, upper: Vec3, given: Vec3, frame: usize) -> Option<(Vec3, Vec3)> {
        let at = |landmark: Landmark| self.trajectories.of(landmark, self.side, frame);
        let out = if self.side == Side::Right { 1.0 } else { -1.0 };
        match method {
            Method::Centre(centre) => Some((at(centre)?, given)),
            Method::Middle(lateral, medial) => {
                let (lateral, medial) = (at(lateral)?, at(medial)?);
                Some(((lateral + medial) * 0.5, direction(lateral - medial)? * out))
            }
            Method::Wand(lateral, wand, half) => {
                let lateral = at(lateral)?;
                let centre = chord(upper, lateral, at(wand)?, half)?;
                Some((centre, direction(lateral - centre)? * out))
            }
            Method::Plane(lateral, half) => {
                let lateral = at(lateral)?;
                let centre = chord(upper, lateral, lateral + given * out, half)?;
                Some((centre, direction(lateral - centre)? * out))
            }
            Method::OfFoot(front) => Some((ankle_of_foot([at(Landmark::Heel)?, at(front)?], front, upper)?, given)),
        }
    }

    /// Centre and axis of a knee whose axis is turned about the line from knee to hip: a centre that was found along
    /// the axis moves with it.
    fn turned(
        &self,
        method: Method,
        [hip, knee]: [Vec3; 2],
        (axis, turn): (Vec3, f64),
        frame: usize,
    ) -> Option<(Vec3, Vec3)> {
        let along = direction(hip - knee)?;
        let axis = rotation_about(along, turn) * perpendicular(axis, along)?;
        let (Method::Wand(lateral, _, half) | Method::Plane(lateral, half)) = method else { return Some((knee, axis)) };
        let out = if self.side == Side::Right { 1.0 } else { -1.0 };
        let lateral = self.trajectories.of(lateral, self.side, frame)?;
        let centre = chord(hip, lateral, lateral + axis * out, half)?;
        Some((centre, direction(lateral - centre)? * out))
    }

    fn frame(&self, pelvis: &Pelvis, methods: [Method; 2], measured: usize) -> Option<LegFrame> {
        let frame = self.frames[measured];
        let (hip, across) = (pelvis.hip(measured, self.side)?, pelvis.right(measured)?);
        let (mut knee, mut axis) = self.joint(methods[0], hip, across, frame)?;
        let (mut ankle, mut ankle_axis) = self.joint(methods[1], knee, axis, frame)?;
        if matches!(methods[0], Method::Centre(_)) {
            axis = bending_axis(hip, knee, ankle).unwrap_or(across);
        }
        if let Some(turn) = self.turn {
            (knee, axis) = self.turned(methods[0], [hip, knee], (axis, turn), frame)?;
            (ankle, ankle_axis) = self.joint(methods[1], knee, axis, frame)?;
        }
        let femur = Pose { rotation: from_y_z(hip - knee, axis)?, translation: hip };
        let tibia = Pose { rotation: from_y_z(knee - ankle, femur.rotation.column(2).into())?, translation: knee };
        if matches!(methods[1], Method::Centre(_) | Method::Plane(..) | Method::OfFoot(_)) {
            ankle_axis = tibia.rotation.column(2).into();
        }
        Some(LegFrame { femur, tibia, ankle, ankle_axis })
    }
}

/// Centre of an ankle [m] from a heel and a front marker, which have the landmarks of a usual foot of their distance.
/// The knee shows which side of the line between them is up, whatever the angle of the ankle.
fn ankle_of_foot([heel, front]: [Vec3; 2], landmark: Landmark, knee: Vec3) -> Option<Vec3> {
    let level = |place: Vec3| Vec3::new(place.x, place.y, 0.0);
    let (rear, ahead) = (level(Landmark::Heel.place()), level(landmark.place()));
    let size = (front - heel).norm() / (landmark.place() - Landmark::Heel.place()).norm();
    let (along, of_table) = (direction(front - heel)?, direction(ahead - rear)?);
    let up = perpendicular(knee - heel, along)?;
    let up_of_table = Vec3::new(-of_table.y, of_table.x, 0.0);
    Some(heel + (along * -rear.dot(&of_table) + up * -rear.dot(&up_of_table)) * size)
}

/// Centre of a hinge at half the width from a lateral marker: perpendicular to the line to the upper joint, in the
/// plane of upper joint, marker and wand, on the side of the line from joint to marker opposite to the wand (the chord
/// of Plug-in-Gait).
pub fn chord(upper: Vec3, lateral: Vec3, wand: Vec3, half: f64) -> Option<Vec3> {
    let length = (upper - lateral).norm();
    let along = direction(upper - lateral)?;
    let aside = -perpendicular(wand - lateral, along)?;
    let cosine = half / length;
    if !(0.0..1.0).contains(&cosine) {
        return None;
    }
    Some(lateral + (along * cosine + aside * (1.0 - cosine * cosine).sqrt()) * half)
}

/// Normal of the plane of flexion of a knee, to the right; `None` if it is nearly straight.
pub fn bending_axis(hip: Vec3, knee: Vec3, ankle: Vec3) -> Option<Vec3> {
    let (thigh, shank) = (direction(knee - hip)?, direction(ankle - knee)?);
    let normal = shank.cross(&thigh);
    (normal.norm() > sin(BENT)).then(|| normal.normalize())
}

fn leg(finder: &Finder<'_>, pelvis: &Pelvis, knee: Method, ankle: Method) -> Result<Leg, CalibrationError> {
    let count = finder.frames.len();
    let frames: Vec<Option<LegFrame>> =
        (0..count).map(|measured| finder.frame(pelvis, [knee, ankle], measured)).collect();
    let known: Vec<&LegFrame> = frames.iter().flatten().collect();
    let expected = LEAST_FRAMES.min(count).max(1);
    let part = |name: &str| format!("{} {name}", finder.side);
    if known.len() < expected {
        return Err(CalibrationError::Unseen { part: part("leg"), seen: known.len(), frames: count, expected });
    }
    let thigh = length(part("thigh"), known.iter().map(|f| (f.femur.translation - f.tibia.translation).norm()))?;
    let shank = length(part("shank"), known.iter().map(|f| (f.tibia.translation - f.ankle).norm()))?;
    let angles: Vec<[f64; 3]> =
        known.iter().map(|f| angles_zxy(&(f.femur.rotation.transpose() * f.tibia.rotation))).collect();
    let straight = median(angles.iter().filter(|a| a[0].abs() < NEARLY_STRAIGHT).map(|a| a[1]));
    let varus = straight.or_else(|| median(angles.iter().map(|a| a[1]))).unwrap_or(0.0);
    drop(known);
    Ok(Leg { frames, thigh, shank, varus })
}

fn length(part: String, lengths: impl Iterator<Item = f64>) -> Result<f64, CalibrationError> {
    let found_m = median(lengths).unwrap_or(f64::NAN);
    let [least_m, most_m] = LENGTHS;
    if (least_m..=most_m).contains(&found_m) {
        return Ok(found_m);
    }
    let hint = "check the unit of length, and whether left and right markers are swapped";
    Err(CalibrationError::Length { part, found_m, least_m, most_m, hint })
}

/// Stature [m] from the lengths of legs, thigh and shank together, by their share in the segment table.
pub(in crate::kinematics) fn stature(
    lengths: impl Iterator<Item = f64>,
    table: SegmentTable,
    assumptions: &mut Vec<String>,
) -> Result<f64, BuildError> {
    let (mass, height) = (70.0, 1.75);
    let d = Build { table, mass, height, toe_joint: true }.human()?.dimensions;
    let found = height * median(lengths).unwrap_or(f64::NAN) / (d.thigh + d.shank);
    assumptions.push(format!("the stature is not given; it is estimated as {found:.2} m from thighs and shanks"));
    Ok(found)
}
