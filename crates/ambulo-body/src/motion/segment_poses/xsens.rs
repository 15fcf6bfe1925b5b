//! Poses of segments in motions of Xsens MVN.
//!
//! In the T-pose all segments have the axes x forward, y left, z up, so an arm lies along y. Arms are turned here to
//! the axes of hanging arms with palms forward, as in [`SegmentPoses`]. In the T-pose palms are downwards (thumbs
//! forward when the arm hangs).
//!
//! Floor height: height of heels and toes while the file's contact flags are set. Without flags the height zero of the
//! file is kept. MVN computes positions from orientations, lengths and contacts; they are not measured.
//!
//! Sources: MVN User Manual, document MV0319P.N (June 2015), sections 19.5 to 19.7; the calibration poses `identity`,
//! `tpose` and `tpose-isb` of an upper-body recording of MVN 2019, of which `tpose-isb` has the turns of the arms;
//! Xsens' reader for Python, which assigns the contacts to points.
//! Not handled: fingers, props; the spine between pelvis and T8; floors that are not level.
//! Pinned by: tests/xsens_motions.rs

use super::error::ONE_IN;
use super::{FOOT_LENGTHS_M, PosedSegment, SegmentPoseError, SegmentPoses, axes, labels};
use crate::findings::{Code, Findings};
use crate::model::{BySide, Side};
use crate::motion::gait_event::{Event, EventKind};
use crate::numerics::{Order, sort_numbers};
use crate::spatial::{Mat3, Pose, Vec3, rotation_about};
use ambulo_formats::mvnx::{Mvnx, MvnxFrame, MvnxPose};
use nalgebra::{Quaternion, UnitQuaternion};
use std::f64::consts::FRAC_PI_2;

/// Range of the heights of contacts, between their tenths, above which the floor is not level [m].
const LEVEL_M: f64 = 0.06;
/// Largest angle between segments that are turned alike: six decimals of a quaternion [rad].
const ALIKE: f64 = 1e-5;

/// Reads the poses of the segments, in the axes of MVN: z up.
///
/// # Errors
/// No poses of pelvis, thighs, shanks and feet; legs that were not measured; axes that a person cannot have: see
/// [`SegmentPoseError`].
pub fn segment_poses_from_mvnx(mvnx: &Mvnx, findings: &mut Findings) -> Result<SegmentPoses, SegmentPoseError> {
    let numbers = frame_numbers(mvnx)?;
    let mut segments: Vec<(PosedSegment, Vec<Option<Pose>>)> = Vec::new();
    for (place, named) in mvnx.segments.iter().enumerate() {
        let Some(segment) = labels::segment_of(&named.label) else { continue };
        if segments.iter().all(|(known, _)| *known != segment) {
            segments.push((segment, path(mvnx, place, segment, &numbers)));
        }
    }
    segments.sort_by_key(|(segment, _)| *segment);
    let known: Vec<&str> = mvnx.segments.iter().map(|segment| segment.label.as_str()).collect();
    labels::check_complete(&segments, &known)?;
    let length = |point: Option<[f64; 3]>| point.map(Vec3::from).filter(|way| FOOT_LENGTHS_M.contains(&way.norm()));
    let poses = SegmentPoses {
        rate_hz: mvnx.rate_hz,
        times: numbers.iter().map(|number| *number as f64 / mvnx.rate_hz).collect(),
        segments,
        heel: BySide::from_fn(|side| length(foot_point(mvnx, side, "Foot", "HeelFoot"))),
        toe_length_m: BySide::from_fn(|side| length(foot_point(mvnx, side, "Toe", "Toe")).map(|way| way.norm())),
        statement: String::new(),
    };
    check_legs(&poses, mvnx)?;
    let poses = axes::aligned(with_measured_upper_body(poses, findings))?;
    report_missing(mvnx, &numbers, findings);
    findings.report(
        Code::PosesAssumed,
        "positions of a suit of inertial sensors are not measured: Xsens MVN computed them from the turns and lengths \
         of the segments and from contacts with the ground",
    );
    Ok(on_floor(poses, mvnx, findings))
}

/// Foot strikes and foot offs by the contact flags of the file, in order of time: a foot strikes when its heel or its
/// toes touch the ground, and is off when none does. Contacts at the first frame are no strikes.
#[must_use]
pub fn events_from_mvnx(mvnx: &Mvnx) -> Vec<Event> {
    let mut events = Vec::new();
    for side in Side::BOTH {
        let of_side: Vec<usize> =
            (0..mvnx.contacts.len()).filter(|&k| side_of(&mvnx.contacts[k]) == Some(side)).collect();
        let touches = |frame: &MvnxFrame| {
            (!frame.contacts.is_empty()).then(|| of_side.iter().any(|&contact| frame.contacts[contact]))
        };
        for pair in mvnx.frames.windows(2) {
            let (Some(before), Some(now)) = (touches(&pair[0]), touches(&pair[1])) else { continue };
            if before != now {
                let kind = if now { EventKind::Strike } else { EventKind::Off };
                events.push(Event { side, kind, time_s: pair[1].index as f64 / mvnx.rate_hz });
            }
        }
    }
    events.sort_by_numbers(|event| [event.time_s, event.side.rank()]);
    events
}

/// Numbers of all frames from the first to the last, including missing ones.
fn frame_numbers(mvnx: &Mvnx) -> Result<Vec<u64>, SegmentPoseError> {
    let (Some(first), Some(last)) = (mvnx.frames.first(), mvnx.frames.last()) else {
        return Err(SegmentPoseError::NeverSeen);
    };
    let (first, last, found) = (first.index, last.index, mvnx.frames.len());
    if last.saturating_sub(first) / ONE_IN > found as u64 {
        return Err(SegmentPoseError::FewFrames { first, last, found });
    }
    Ok((first..=last).collect())
}

/// The poses of one segment; `None` in frames that are missing in the file.
fn path(mvnx: &Mvnx, place: usize, segment: PosedSegment, numbers: &[u64]) -> Vec<Option<Pose>> {
    let turn = hanging(segment);
    let mut path = vec![None; numbers.len()];
    for frame in &mvnx.frames {
        let slot = (frame.index - numbers[0]) as usize;
        path[slot] = frame.poses.get(place).map(|pose| pose_of(pose, &turn));
    }
    path
}

fn pose_of(pose: &MvnxPose, turn: &Mat3) -> Pose {
    let [w, x, y, z] = pose.orientation;
    let rotation = UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z)).to_rotation_matrix().into_inner();
    Pose { rotation: rotation * turn, translation: Vec3::from(pose.position) }
}

/// Rotation from the axes of the T-pose to the axes with hanging arms and palms forward.
fn hanging(segment: PosedSegment) -> Mat3 {
    let outward = |side: Side| if side == Side::Right { 1.0 } else { -1.0 };
    let down = |side: Side| rotation_about(Vec3::x(), -outward(side) * FRAC_PI_2);
    let palm = |side: Side| rotation_about(Vec3::z(), outward(side) * FRAC_PI_2);
    match segment {
        PosedSegment::UpperArm(side) => down(side),
        PosedSegment::Forearm(side) | PosedSegment::Hand(side) => down(side) * palm(side),
        _ => Mat3::identity(),
    }
}

/// A point of the foot or the toes of a side: `pRightHeelFoot` of `RightFoot`.
fn foot_point(mvnx: &Mvnx, side: Side, segment: &str, point: &str) -> Option<[f64; 3]> {
    let word = if side == Side::Right { "Right" } else { "Left" };
    mvnx.point(&format!("{word}{segment}"), &format!("p{word}{point}"))
}

/// Whether a segment turns with the pelvis in every frame, as MVN writes segments without a sensor.
fn turns_with_pelvis(poses: &SegmentPoses, segment: PosedSegment) -> bool {
    let back = hanging(segment).transpose();
    let apart = |frame: usize| {
        let (pelvis, own) = (poses.at(PosedSegment::Pelvis, frame)?, poses.at(segment, frame)?);
        Some((own.rotation * back - pelvis.rotation).amax())
    };
    let mut known = (0..poses.times.len()).filter_map(apart).peekable();
    known.peek().is_some() && known.all(|apart| apart <= ALIKE)
}

/// Rejects legs without sensors.
fn check_legs(poses: &SegmentPoses, mvnx: &Mvnx) -> Result<(), SegmentPoseError> {
    let legs = [PosedSegment::Thigh, PosedSegment::Shank, PosedSegment::Foot].map(|of| Side::BOTH.map(of));
    if !legs.into_iter().flatten().all(|segment| turns_with_pelvis(poses, segment)) {
        return Ok(());
    }
    let configuration = match mvnx.configuration.as_str() {
        "" => String::new(),
        stated => format!(" (configuration `{stated}`)"),
    };
    Err(SegmentPoseError::LegsNotMeasured { configuration })
}

/// The poses without trunk and arms that had no sensors, which would stay in the T-pose.
fn with_measured_upper_body(mut poses: SegmentPoses, findings: &mut Findings) -> SegmentPoses {
    let arms = [PosedSegment::UpperArm, PosedSegment::Forearm, PosedSegment::Hand].map(|of| Side::BOTH.map(of));
    let upper = std::iter::once(PosedSegment::Torso).chain(arms.into_iter().flatten());
    let still: Vec<PosedSegment> = upper.filter(|segment| turns_with_pelvis(&poses, *segment)).collect();
    if !still.is_empty() {
        let names: Vec<String> = still.iter().map(|segment| labels::in_words(*segment)).collect();
        let message = format!(
            "segments that turn with the pelvis in every frame were not measured and are left out: {}",
            names.join(", ")
        );
        findings.report(Code::PosesAssumed, message);
        poses.segments.retain(|(segment, _)| !still.contains(segment));
    }
    poses
}

fn report_missing(mvnx: &Mvnx, numbers: &[u64], findings: &mut Findings) {
    let missing = numbers.len() - mvnx.frames.len();
    if missing > 0 {
        let (first, last) = (numbers[0], numbers[numbers.len() - 1]);
        let message = format!("{missing} of the frames {first} to {last} are not in the file; their poses are missing");
        findings.report(Code::PosesOdd, message);
    }
}

/// `LeftFoot_Heel` is on the left.
fn side_of(contact: &str) -> Option<Side> {
    [("Left", Side::Left), ("Right", Side::Right)]
        .iter()
        .find(|(word, _)| contact.starts_with(word))
        .map(|(_, side)| *side)
}

/// Segment and point of a contact, in the axes of the file.
fn contact_point(mvnx: &Mvnx, contact: &str) -> Option<(PosedSegment, Vec3)> {
    let side = side_of(contact)?;
    if contact.ends_with("_Heel") {
        return Some((PosedSegment::Foot(side), foot_point(mvnx, side, "Foot", "HeelFoot")?.into()));
    }
    let toe = foot_point(mvnx, side, "Toe", "Toe")?;
    contact.ends_with("_Toe").then(|| (PosedSegment::Toes(side), toe.into()))
}

/// Heights of the points in contact, in the axes of the file [m].
fn contact_heights(mvnx: &Mvnx) -> Vec<f64> {
    let place = |segment: PosedSegment| {
        mvnx.segments.iter().position(|named| labels::segment_of(&named.label) == Some(segment))
    };
    let points: Vec<Option<(usize, Vec3)>> = mvnx
        .contacts
        .iter()
        .map(|contact| contact_point(mvnx, contact).and_then(|(segment, point)| Some((place(segment)?, point))))
        .collect();
    let height = |frame: &MvnxFrame, contact: usize| {
        let (segment, point) = points[contact].filter(|_| frame.contacts[contact])?;
        Some(pose_of(&frame.poses[segment], &Mat3::identity()).place(point).z)
    };
    mvnx.frames
        .iter()
        .flat_map(|frame| (0..frame.contacts.len()).filter_map(|contact| height(frame, contact)))
        .collect()
}

/// The poses with the floor at height zero, where the contacts of the file show a level one.
fn on_floor(mut poses: SegmentPoses, mvnx: &Mvnx, findings: &mut Findings) -> SegmentPoses {
    let mut heights = contact_heights(mvnx);
    sort_numbers(&mut heights);
    let tenth = |tenths: usize| heights.get(tenths * heights.len() / 10).copied();
    let (Some(low), Some(floor), Some(high)) = (tenth(1), tenth(5), tenth(9)) else { return poses };
    if high - low > LEVEL_M {
        let message = format!(
            "the floor is not level: heels and toes in contact are {low:.3} to {high:.3} m high by the flags of the \
             file; height zero of the file was kept"
        );
        findings.report(Code::PosesOdd, message);
        return poses;
    }
    for pose in poses.segments.iter_mut().flat_map(|(_, path)| path).flatten() {
        pose.translation.z -= floor;
    }
    let message = format!(
        "the floor is at the height {floor:.3} m of the file, where heels and toes are while its flags say that they \
         touch the ground ({} contacts, {low:.3} to {high:.3} m)",
        heights.len()
    );
    findings.report(Code::PosesAssumed, message);
    poses
}
