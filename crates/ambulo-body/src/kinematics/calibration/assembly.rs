//! Assembles the calibrated body from its parts.

use super::axes::{about_x, in_frame, median_point};
use super::feet::Feet;
use super::landmark_trajectories::LandmarkTrajectories;
use super::legs::Legs;
use super::neck_and_wrists::{ENOUGH_ON_TRUNK, markers_of_trunk, neck, on_its_body};
use super::pelvis::Pelvis;
use super::report::{CalibrationReport, MarkerPlacement, SegmentScale};
use super::trunk::{Trunk, is_head};
use super::{Calibrated, CalibrationError};
use crate::model::anthropometry::{Dimensions, Human};
use crate::model::marker_set::{Landmark, NamedMarker, Segment};
use crate::model::neck_and_wrists::{HEAD, hand};
use crate::model::subject_shape::{SegmentShape, SubjectShape, reshaped};
use crate::model::{BodyId, BySide, Marker, Side};
use crate::numerics::counted;
use crate::spatial::{Pose, Vec3};
use std::collections::BTreeMap;

/// Smallest weight of a marker that determines the motion of the trunk.
const RELIABLE: f64 = 0.05;
/// Weight of shoulder markers if they must determine it.
const SHOULDER_WEIGHT: f64 = 0.1;

/// The calibrated parts of the body.
pub(super) struct Parts<'a> {
    pub(super) pelvis: &'a Pelvis,
    pub(super) legs: &'a Legs,
    pub(super) feet: &'a Feet,
    pub(super) trunk: &'a Trunk,
}

pub(super) fn assemble(
    trajectories: &LandmarkTrajectories<'_>,
    frames: &[usize],
    generic: &Human,
    parts: &Parts<'_>,
    mut assumptions: Vec<String>,
) -> Result<Calibrated, CalibrationError> {
    let (mut markers, mut weights, mut places) = (Vec::new(), BTreeMap::new(), Vec::new());
    let mut unused = Vec::new();
    for (named, number) in chosen(trajectories, generic, parts, &mut unused) {
        match placed(trajectories, frames, generic, parts, named, number) {
            Some((marker, place)) => {
                markers.push(marker);
                weights.insert(named.name.clone(), named.definition.weight);
                places.push(place);
            }
            None => unused.push(named.name.as_str()),
        }
    }
    use_shoulders_if_needed(trajectories, &mut weights);
    if !unused.is_empty() {
        assumptions.push(format!(
            "not used: {} (head with enough markers on the trunk, or a segment without a pose): {}",
            counted(unused.len(), "marker"),
            unused.join(", ")
        ));
    }
    let shape = shape(generic, parts, markers, &mut assumptions);
    let scales = scales(generic, parts, &shape);
    let human = reshaped(generic, &shape)?;
    let report = CalibrationReport {
        sets: trajectories.sets.to_vec(),
        height_m: generic.dimensions.height,
        hip_width_m: parts.pelvis.hip_width(),
        hips: parts.pelvis.hips.clone(),
        segments: scales,
        markers: places,
        assumptions,
        frames: frames.len(),
    };
    Ok(Calibrated { human, weights, report })
}

/// Raises the weight of shoulder markers if the trunk has too few others.
fn use_shoulders_if_needed(trajectories: &LandmarkTrajectories<'_>, weights: &mut BTreeMap<String, f64>) {
    let trunk = || trajectories.markers.iter().map(|(m, _)| m).filter(|m| m.definition.segment == Segment::Torso);
    let is_shoulder = |l: Option<Landmark>| matches!(l, Some(Landmark::Acromion | Landmark::ShoulderCentre));
    let reliable = trunk().filter(|m| m.definition.weight >= RELIABLE && weights.contains_key(&m.name)).count();
    if reliable >= ENOUGH_ON_TRUNK {
        return;
    }
    for marker in trunk().filter(|m| is_shoulder(m.definition.landmark)) {
        if let Some(weight) = weights.get_mut(&marker.name) {
            *weight = weight.max(SHOULDER_WEIGHT);
        }
    }
}

/// The markers that are used: those of a head that does not move on its own only if the trunk has few others.
fn chosen<'a>(
    trajectories: &LandmarkTrajectories<'a>,
    generic: &Human,
    parts: &Parts<'_>,
    unused: &mut Vec<&'a str>,
) -> Vec<(&'a NamedMarker, usize)> {
    let has_trunk = markers_of_trunk(trajectories) >= ENOUGH_ON_TRUNK && parts.trunk.poses.iter().any(Option::is_some);
    let drops_head = has_trunk && generic.model.body(HEAD).is_none();
    let mut list = Vec::new();
    for &(marker, number) in &trajectories.markers {
        if drops_head && is_head(marker.definition.landmark) {
            unused.push(marker.name.as_str());
        } else {
            list.push((marker, number));
        }
    }
    list
}

/// Pose of the segment of a marker in a selected frame.
fn pose(parts: &Parts<'_>, segment: Segment, side: Option<Side>, ball: Vec3, measured: usize) -> Option<Pose> {
    let leg = || parts.legs[side?].as_ref()?.frames[measured];
    let arm = || parts.trunk.arms[side?].as_ref()?.frames[measured];
    let foot = || parts.feet[side?].poses[measured];
    match segment {
        Segment::Pelvis => parts.pelvis.poses[measured],
        Segment::Torso => parts.trunk.poses[measured],
        Segment::Femur => leg().map(|f| f.femur),
        Segment::Tibia => leg().map(|f| f.tibia),
        Segment::Foot => foot(),
        Segment::Toes => foot().map(|foot| foot * Pose::at(ball)),
        Segment::Humerus => arm().map(|[humerus, _]| humerus),
        Segment::Forearm => arm().map(|[_, forearm]| forearm),
    }
}

/// A marker at its median position on its segment, and its error.
fn placed(
    trajectories: &LandmarkTrajectories<'_>,
    frames: &[usize],
    generic: &Human,
    parts: &Parts<'_>,
    named: &NamedMarker,
    number: usize,
) -> Option<(Marker, MarkerPlacement)> {
    let (segment, side) = (named.definition.segment, named.definition.side);
    let body = segment.body(&generic.model, side)?;
    let ball = side.map_or(Vec3::zeros(), |side| ball(&generic.dimensions, parts.feet, side));
    let seen = |(measured, &frame): (usize, &usize)| {
        Some(in_frame(&pose(parts, segment, side, ball, measured)?, trajectories.place(number, frame)?))
    };
    let points: Vec<Vec3> = frames.iter().enumerate().filter_map(seen).collect();
    let mut location = median_point(&points)?;
    let rms_m = (points.iter().map(|p| (p - location).norm_squared()).sum::<f64>() / points.len() as f64).sqrt();
    if named.definition.landmark == Some(Landmark::Acromion) {
        location.y -= parts.trunk.lift;
    }
    let (body, location) = on_its_body(&generic.model, parts.trunk, &named.definition, (body, location));
    let body_name = generic.model.bodies()[body.index()].name.clone();
    let place = MarkerPlacement { name: named.name.clone(), body: body_name, rms_m, frames: points.len() };
    Some((Marker { name: named.name.clone(), body: Some(body), location, fixed: false }, place))
}

/// Position of the ball of a foot relative to its ankle [m].
fn ball(d: &Dimensions, feet: &Feet, side: Side) -> Vec3 {
    let foot = &feet[side];
    foot.placement.place(d.ankle_to_ball * foot.factor, d.ball_radius * foot.factor)
}

fn shape(generic: &Human, parts: &Parts<'_>, markers: Vec<Marker>, assumptions: &mut Vec<String>) -> SubjectShape {
    let d = &generic.dimensions;
    let mut segments = SegmentShape::of(generic);
    let of = |segment: Segment, side: Side| segment.body(&generic.model, Some(side));
    let mut set = |body: Option<BodyId>, shape: SegmentShape| {
        if let Some(body) = body {
            segments[body.index()] = shape;
        }
    };
    let plain = |factor: f64, place: Vec3| SegmentShape {
        factor,
        parent_from_joint: Pose::at(place),
        child_from_joint: Pose::IDENTITY,
    };
    let lumbar = Vec3::y() * d.lumbar_height.unwrap_or(0.0);
    set(Segment::Torso.body(&generic.model, None), plain(parts.trunk.factor, lumbar));
    if let Some(head) = generic.model.body(HEAD) {
        set(Some(head), plain(parts.trunk.factor, neck(&generic.model, head, parts.trunk)));
    }
    for side in Side::BOTH {
        let hip = parts.pelvis.hip_in_body(side);
        let (thigh, shank, varus) =
            parts.legs[side].as_ref().map_or((d.thigh, d.shank, 0.0), |l| (l.thigh, l.shank, l.varus));
        let foot = &parts.feet[side];
        set(of(Segment::Femur, side), plain(thigh / d.thigh, hip));
        let knee = plain(shank / d.shank, Vec3::y() * -thigh);
        let varus = Pose { rotation: about_x(varus).transpose(), translation: Vec3::zeros() };
        set(of(Segment::Tibia, side), SegmentShape { child_from_joint: varus, ..knee });
        let ankle = Pose { rotation: foot.tibia_from_joint, translation: Vec3::y() * -shank };
        let offset = Pose { rotation: foot.joint_from_foot.transpose(), translation: Vec3::zeros() };
        set(
            of(Segment::Foot, side),
            SegmentShape { factor: foot.factor, parent_from_joint: ankle, child_from_joint: offset },
        );
        set(of(Segment::Toes, side), plain(foot.factor, ball(d, parts.feet, side)));
        let (upper, lower) =
            parts.trunk.arms[side].as_ref().map_or((d.upper_arm, d.forearm), |arm| (arm.upper, arm.lower));
        set(of(Segment::Humerus, side), plain(upper / d.upper_arm, parts.trunk.shoulders[side]));
        set(of(Segment::Forearm, side), plain(lower / d.forearm, Vec3::y() * -upper));
        set(generic.model.body(&hand(side)), plain(lower / d.forearm, Vec3::y() * -lower));
    }
    let mut locked = Vec::new();
    if parts.pelvis.is_line {
        assumptions.push(
            "only the hip centres of the pelvis are known, which do not determine its tilt; it is that of the line \
             from hips to shoulders, or upright"
                .to_owned(),
        );
        locked = vec!["lumbar_extension".to_owned()];
    }
    let feet = Side::BOTH.map(|side| parts.feet[side].placement);
    SubjectShape { segments, markers, feet, dimensions: dimensions(d, parts), locked }
}

/// Lengths of the person, mean of both sides.
fn dimensions(generic: &Dimensions, parts: &Parts<'_>) -> Dimensions {
    let mean = |of: &dyn Fn(Side) -> f64| 0.5 * (of(Side::Right) + of(Side::Left));
    let foot = mean(&|side| parts.feet[side].factor);
    let thigh = mean(&|side| parts.legs[side].as_ref().map_or(generic.thigh, |leg| leg.thigh));
    let shank = mean(&|side| parts.legs[side].as_ref().map_or(generic.shank, |leg| leg.shank));
    let ankle_height = mean(&|side| parts.feet[side].placement.ankle_height);
    let arm = |side: Side| parts.trunk.arms[side].as_ref();
    let BySide { right, left } = parts.trunk.shoulders;
    Dimensions {
        leg_length: thigh + shank + ankle_height,
        thigh,
        shank,
        ankle_height,
        foot_length: generic.foot_length * foot,
        foot_width: generic.foot_width * foot,
        heel_to_ankle: generic.heel_to_ankle * foot,
        ankle_to_ball: generic.ankle_to_ball * foot,
        ball_to_toe: generic.ball_to_toe * foot,
        heel_radius: generic.heel_radius * foot,
        ball_radius: generic.ball_radius * foot,
        toe_radius: generic.toe_radius * foot,
        hip_width: parts.pelvis.hip_width(),
        shoulder_width: right.z - left.z,
        shoulder_height: generic.lumbar_height.unwrap_or(0.0) + 0.5 * (right.y + left.y),
        upper_arm: mean(&|side| arm(side).map_or(generic.upper_arm, |arm| arm.upper)),
        forearm: mean(&|side| arm(side).map_or(generic.forearm, |arm| arm.lower)),
        ..*generic
    }
}

fn scales(generic: &Human, parts: &Parts<'_>, shape: &SubjectShape) -> Vec<SegmentScale> {
    let is_measured = |name: &str| {
        let side = Side::of_name(name);
        let leg = || side.is_some_and(|side| parts.legs[side].is_some());
        match name.split('_').next().unwrap_or_default() {
            "pelvis" => false,
            "torso" | HEAD => parts.trunk.poses.iter().any(Option::is_some),
            "femur" | "tibia" => leg(),
            "calcn" | "toes" => side.is_some_and(|side| parts.feet[side].poses.iter().any(Option::is_some)),
            _ => side.is_some_and(|side| parts.trunk.arms[side].is_some()),
        }
    };
    let scale = |(body, segment): (&crate::model::Body, &SegmentShape)| SegmentScale {
        body: body.name.clone(),
        factor: segment.factor,
        is_measured: is_measured(&body.name),
    };
    generic.model.bodies().iter().zip(&shape.segments).map(scale).collect()
}
