//! Varus and rotation of the knee from the markers of thigh and shank alone.
//!
//! The knee of the built-in body only flexes, and the fit of all markers together spreads what does not agree with it
//! over the leg. Clinics read the knee from segments that move freely: thigh and shank turn about their proximal joint
//! centres, hip and knee, until their own markers fit best ([`super::segments`]). The hip is that of the fitted body,
//! the knee that of the turned thigh.
//!
//! The angles describe the shank in the thigh in the order flexion, adduction, rotation, with the axes of the joint
//! coordinate system in the neutral posture.
//!
//! Source: as Plug-in-Gait (Kadaba 1990, Davis 1991; unverified), whose segments also turn about the centre of the
//! joint above them; compared with its angles in tests/plug_in_gait_planes.rs.
//! Not handled: segments whose markers lie on a line through the joint centre. They have no angles.
//! Pinned by: tests/segment_angles.rs

use super::segments::Segment;
use crate::kinematics::calibration::angles_zxy;
use crate::model::anatomy::{Leg, Movement};
use crate::model::{BodyId, BySide, Coordinate, Model, Side};
use crate::motion::{MarkerRecording, Motion};
use crate::spatial::{Mat3, Pose, Vec3, rotation_vector};

/// Varus (adduction) and internal rotation of both knees in the frames of a marker recording that the body follows
/// [rad]; a gap is not a number. `None` for a leg whose markers do not suffice, and for a body whose knee turns in
/// these planes itself.
pub fn knee_angles(model: &Model, markers: &MarkerRecording, motion: &Motion) -> BySide<Option<[Vec<f64>; 2]>> {
    let knees = BySide::from_fn(|side| Knee::of(model, markers, side));
    let mut angles = knees.as_ref().map(|knee| knee.as_ref().map(|_| Default::default()));
    if knees.values().all(Option::is_none) {
        return angles;
    }
    for frame in 0..motion.times.len().min(markers.frames()) {
        let q: Vec<f64> =
            model.coordinate_ids().map(|id| motion.column(id).map_or(0.0, |column| column[frame])).collect();
        let poses = model.poses(&q);
        for (side, knee) in knees.iter() {
            let (Some(knee), Some(found)) = (knee, &mut angles[side]) else { continue };
            let [varus, turn] = knee.at(frame, |body: BodyId| poses[body.index()]).unwrap_or([f64::NAN; 2]);
            found[0].push(varus);
            found[1].push(turn);
        }
    }
    angles
}

/// A segment of a leg that turns about its proximal joint centre.
struct LegSegment<'a> {
    segment: Segment<'a>,
    /// The joint centre in the segment [m].
    center: Vec3,
    /// Axes forward, up and right as columns, in the frame of the segment.
    axes: Mat3,
}

/// Thigh and shank of a leg.
struct Knee<'a> {
    thigh: LegSegment<'a>,
    shank: LegSegment<'a>,
    /// Knee centre in the thigh [m].
    knee_in_thigh: Vec3,
    /// +1 on the right, -1 on the left.
    inwards: f64,
}

impl<'a> Knee<'a> {
    /// Of a leg whose segments have enough markers.
    fn of(model: &Model, markers: &'a MarkerRecording, side: Side) -> Option<Knee<'a>> {
        let anatomy = model.anatomy();
        let turns = |movement| anatomy.coordinate(movement, Some(side)).is_some();
        let leg = anatomy.legs()[side].filter(|_| !turns(Movement::KneeAdduction) && !turns(Movement::KneeRotation))?;
        let (poses, axis) = straight(model, &leg, side)?;
        let pose = |body: BodyId| &poses[body.index()];
        let center =
            |joint: BodyId| pose(joint).place(model.bodies()[joint.index()].joint.child_from_joint.translation);
        let [hip, knee, ankle] = [leg.hip, leg.knee, leg.ankle].map(center);
        let [thigh_axes, shank_axes] = [frame(hip - knee, axis, Axis::Right)?, frame(knee - ankle, axis, Axis::Up)?];
        let segment = |body: BodyId, joint: Vec3, axes: Mat3| LegSegment {
            segment: Segment::of(model, markers, body),
            center: pose(body).inverse().place(joint),
            axes: pose(body).rotation.transpose() * axes,
        };
        let (thigh, shank) = (segment(leg.thigh, hip, thigh_axes), segment(leg.shank, knee, shank_axes));
        let inwards = if side == Side::Right { 1.0 } else { -1.0 };
        let knee_in_thigh = pose(leg.thigh).inverse().place(knee);
        let is_determined = [&thigh, &shank].iter().all(|own| own.segment.turns_about(own.center));
        is_determined.then_some(Knee { thigh, shank, knee_in_thigh, inwards })
    }

    /// Varus and internal rotation in a frame [rad]; `None` if markers are missing.
    fn at(&self, frame: usize, fitted: impl Fn(BodyId) -> Pose) -> Option<[f64; 2]> {
        let Knee { thigh, shank, knee_in_thigh, inwards } = self;
        let fitted = |own: &LegSegment<'_>| fitted(own.segment.body);
        let hip = fitted(thigh).place(thigh.center);
        let of_thigh = thigh.segment.turned(frame, (thigh.center, hip), fitted(thigh).rotation)?;
        let knee = hip + of_thigh * (knee_in_thigh - thigh.center);
        let of_shank = shank.segment.turned(frame, (shank.center, knee), fitted(shank).rotation)?;
        let [_, varus, turn] = angles_zxy(&((of_thigh * thigh.axes).transpose() * (of_shank * shank.axes)));
        Some([inwards * varus, inwards * turn])
    }
}

/// The poses of all bodies with straight joints, and the axis about which the knee then extends, to the right.
fn straight(model: &Model, leg: &Leg, side: Side) -> Option<(Vec<Pose>, Vec3)> {
    /// A turn whose axis is known to all digits [rad].
    const TURN: f64 = 0.1;
    let (knee, sign) = model.anatomy().coordinate(Movement::KneeFlexion, Some(side))?;
    let in_range = |c: &Coordinate| c.range.map_or(0.0, |[low, high]| 0.0_f64.clamp(low, high.max(low)));
    let mut q: Vec<f64> = model.coordinates().iter().map(in_range).collect();
    let poses = model.poses(&q);
    q[knee.index()] += sign * TURN;
    let shank = leg.shank.index();
    let flexed = model.poses(&q)[shank].rotation * poses[shank].rotation.transpose();
    Some((poses, -rotation_vector(&flexed)))
}

/// Which axis of a segment keeps its direction.
enum Axis {
    /// The flexion axis.
    Right,
    /// The long axis.
    Up,
}

/// Axes forward, up and right as columns from a long axis and a flexion axis; the one that is not kept is made
/// perpendicular.
fn frame(long: Vec3, flexion: Vec3, kept: Axis) -> Option<Mat3> {
    let (long, flexion) = (long.try_normalize(f64::MIN_POSITIVE)?, flexion.try_normalize(f64::MIN_POSITIVE)?);
    let forward = long.cross(&flexion).try_normalize(f64::MIN_POSITIVE)?;
    let [up, right] = match kept {
        Axis::Right => [flexion.cross(&forward), flexion],
        Axis::Up => [long, forward.cross(&long)],
    };
    Some(Mat3::from_columns(&[forward, up, right]))
}
