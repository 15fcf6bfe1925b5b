//! Varus and rotation of the knee from the markers of thigh and shank alone.
//!
//! The knee of the built-in body only flexes, and the fit of all markers together spreads what does not agree with it
//! over the leg. Clinics read the knee from segments that move freely: each follows its own markers. Thigh and shank
//! turn about their proximal joint centres, hip and knee, so that
//!
//!   R = arg min Σ |R a_i - (m_i - C)|²        δ = A⁻¹ Σ u_i × (m_i - C),   u_i = R a_i,   A = Σ (|u_i|² 1 - u_i u_iᵀ)
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | C | centre of the joint: hip of the fitted body; knee of the turned thigh | m |
//! | a_i | place of a marker of the segment, from the joint centre, in the segment | m |
//! | m_i | the recorded marker, in the world | m |
//! | δ | rotation vector of a step, from the rotation of the fitted body on | rad |
//!
//! The angles describe the shank in the thigh in the order flexion, adduction, rotation, with the axes of the joint
//! coordinate system in the neutral posture.
//!
//! Source: as Plug-in-Gait (Kadaba 1990, Davis 1991; unverified), whose segments also turn about the centre of the
//! joint above them; compared with its angles in tests/plug_in_gait_planes.rs.
//! Not handled: segments whose markers lie on a line through the joint centre. They have no angles.
//! Pinned by: tests/segment_angles.rs

use crate::kinematics::calibration::angles_zxy;
use crate::model::anatomy::{Leg, Movement};
use crate::model::{BodyId, BySide, Coordinate, Model, Side};
use crate::motion::{MarkerRecording, Motion};
use crate::spatial::{Mat3, Pose, Vec3, rotation, rotation_vector};

/// Smallest root of the sum of squared distances of the markers from a line through the joint centre [m]: of shorter
/// arms a centimetre of soft-tissue motion turns the segment by more than 15 degrees.
const LEAST_ARM_M: f64 = 0.035;
/// Steps of the fit: it converges quadratically from the rotation of the fitted body, which is a few degrees off.
const STEPS: usize = 8;

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
            let [varus, turn] = knee.at(markers, frame, |body: BodyId| poses[body.index()]).unwrap_or([f64::NAN; 2]);
            found[0].push(varus);
            found[1].push(turn);
        }
    }
    angles
}

/// A segment, and its markers.
struct Segment {
    body: BodyId,
    /// Proximal joint centre in the segment [m].
    center: Vec3,
    /// Number of each marker in the recording, and its place from the joint centre [m].
    markers: Vec<(usize, Vec3)>,
    /// Axes of the segment, forward, up and right as columns, in its frame.
    axes: Mat3,
}

/// Thigh and shank of a leg.
struct Knee {
    thigh: Segment,
    shank: Segment,
    /// Knee centre in the thigh [m].
    knee_in_thigh: Vec3,
    /// +1 on the right, -1 on the left.
    inwards: f64,
}

impl Knee {
    /// Of a leg whose segments have enough markers.
    fn of(model: &Model, markers: &MarkerRecording, side: Side) -> Option<Knee> {
        let anatomy = model.anatomy();
        let turns = |movement| anatomy.coordinate(movement, Some(side)).is_some();
        let leg = anatomy.legs()[side].filter(|_| !turns(Movement::KneeAdduction) && !turns(Movement::KneeRotation))?;
        let (poses, axis) = straight(model, &leg, side)?;
        let pose = |body: BodyId| &poses[body.index()];
        let center =
            |joint: BodyId| pose(joint).place(model.bodies()[joint.index()].joint.child_from_joint.translation);
        let [hip, knee, ankle] = [leg.hip, leg.knee, leg.ankle].map(center);
        let [thigh_axes, shank_axes] = [frame(hip - knee, axis, Axis::Right)?, frame(knee - ankle, axis, Axis::Up)?];
        let segment = |body: BodyId, joint: Vec3, axes: Mat3| {
            let center = pose(body).inverse().place(joint);
            let axes = pose(body).rotation.transpose() * axes;
            Segment { body, center, markers: markers_of(model, markers, body, center), axes }
        };
        let (thigh, shank) = (segment(leg.thigh, hip, thigh_axes), segment(leg.shank, knee, shank_axes));
        let inwards = if side == Side::Right { 1.0 } else { -1.0 };
        let knee_in_thigh = pose(leg.thigh).inverse().place(knee);
        [&thigh, &shank].iter().all(|segment| segment.is_determined()).then_some(Knee {
            thigh,
            shank,
            knee_in_thigh,
            inwards,
        })
    }

    /// Varus and internal rotation in a frame [rad]; `None` if markers are missing.
    fn at(&self, markers: &MarkerRecording, frame: usize, fitted: impl Fn(BodyId) -> Pose) -> Option<[f64; 2]> {
        let Knee { thigh, shank, knee_in_thigh, inwards } = self;
        let hip = fitted(thigh.body).place(thigh.center);
        let of_thigh = thigh.turned(markers, frame, hip, fitted(thigh.body).rotation)?;
        let knee = hip + of_thigh * (knee_in_thigh - thigh.center);
        let of_shank = shank.turned(markers, frame, knee, fitted(shank.body).rotation)?;
        let [_, varus, turn] = angles_zxy(&((of_thigh * thigh.axes).transpose() * (of_shank * shank.axes)));
        Some([inwards * varus, inwards * turn])
    }
}

impl Segment {
    /// Whether its markers determine how it turns about the joint centre.
    fn is_determined(&self) -> bool {
        arm(self.markers.iter().map(|(_, place)| *place)) > LEAST_ARM_M
    }

    /// Rotation of the segment about a joint centre in the world; `None` if the visible markers do not determine it.
    fn turned(&self, recording: &MarkerRecording, frame: usize, center: Vec3, start: Mat3) -> Option<Mat3> {
        let seen = self.markers.iter().filter_map(|(number, place)| {
            let arm = recording.markers[*number].positions[frame] - center;
            arm.iter().all(|x| x.is_finite()).then_some((*place, arm))
        });
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

/// The markers of a body that the recording has.
fn markers_of(model: &Model, recording: &MarkerRecording, body: BodyId, center: Vec3) -> Vec<(usize, Vec3)> {
    let own = model.markers().iter().filter(|marker| marker.body == Some(body));
    own.filter_map(|marker| {
        let number = recording.markers.iter().position(|path| path.name == marker.name)?;
        Some((number, marker.location - center))
    })
    .collect()
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
