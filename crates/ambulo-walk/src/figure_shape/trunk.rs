//! Shapes of pelvis, trunk and head.
//!
//! The pelvis is a capsule from hip to hip and one up to the joint of the trunk. The trunk is a slab with round edges
//! that widens upwards, and a capsule from shoulder to shoulder; the head is above it on a neck. If a model has no arms
//! or head, their positions come from the proportions of a person of the same stature (de Leva's table; shoulders:
//! Dumas 2007).

use super::BodySolid;
use super::joint_places::JointPlaces;
use super::part::Part;
use crate::model::anthropometry::Dimensions;
use crate::model::{BodyId, Side};
use crate::spatial::Vec3;

/// Half breadth of a head over its height from chin to vertex: 155 of 230 mm (Drillis and Contini 1966, as in Winter,
/// figure 4.1; unverified), widened by the depth.
const HEAD: f64 = 0.38;
/// Thickness of the parts of the trunk over the stature of a person of [`USUAL_BUILD`], chosen so that chest and arms
/// do not touch.
const CHEST: f64 = 0.062;
const HIP: f64 = 0.05;
const SHOULDER: f64 = 0.032;
const NECK: f64 = 0.028;
/// Mass over stature squared at which these thicknesses hold: 75 kg and 1.75 m [kg/m²].
const USUAL_BUILD: f64 = 24.5;
/// Minimum and maximum of the ratio to that.
const BUILDS: [f64; 2] = [0.6, 1.6];
/// Distance of the edges of the chest from its middle, over the distance of the shoulders: at the waist, at the top.
const PARTED: [f64; 2] = [0.1, 0.22];

/// Shapes of the pelvis, or of a trunk that includes it.
pub(super) fn pelvis(places: &JointPlaces<'_>, body: BodyId, size: &Dimensions) -> Vec<BodySolid> {
    let hips = places.joints_to(body, Part::Thigh);
    let middle = middle(&hips).unwrap_or_else(|| places.own(body));
    let thick = CHEST * girth(places, size);
    let mut shapes: Vec<BodySolid> = match hips[..] {
        [a, b] => vec![BodySolid::capsule(a, b, HIP * girth(places, size))],
        _ => vec![BodySolid::capsule(middle, middle, thick)],
    };
    let above = places.joints_to(body, Part::Trunk);
    shapes.extend(above.into_iter().map(|joint| BodySolid::capsule(middle, joint, thick)));
    shapes
}

/// Shapes of the trunk, including the head if it is not a separate body.
pub(super) fn trunk(places: &JointPlaces<'_>, body: BodyId, size: &Dimensions) -> Vec<BodySolid> {
    let hips = hips(places, body);
    let own = places.own(body);
    let up = upwards(places, body);
    let [right, left] = shoulders(places, body, size, hips).unwrap_or([own + up * size.shoulder_height; 2]);
    let thick = CHEST * girth(places, size);
    let (base, top) = (own + up * (0.5 * thick), (right + left) * 0.5);
    let edge = |share: f64| {
        let apart = (right - left) * share;
        [base + apart * PARTED[0], top - up * thick + apart * PARTED[1]]
    };
    let mut shapes = slab(edge(1.0), edge(-1.0), thick);
    shapes.push(BodySolid::capsule(left, right, SHOULDER * girth(places, size)));
    if let [a, b] = places.joints_to(body, Part::Thigh)[..] {
        shapes.push(BodySolid::capsule(a, b, HIP * girth(places, size)));
    }
    if places.model.body_ids().all(|id| places.part(id) != Part::Head) {
        let vertex = marker(places, body, "vertex").unwrap_or(top + up * above_shoulders(size));
        shapes.extend(head_below(vertex, top, size));
    }
    shapes
}

/// A flat body with round edges: a capsule along each edge of a trapezium, whose ends are `right` and `left`, and two
/// faces that touch the capsules along a line.
fn slab(right: [Vec3; 2], left: [Vec3; 2], thick: f64) -> Vec<BodySolid> {
    let corners = [right[0], right[1], left[1], left[0]];
    let mut shapes: Vec<BodySolid> =
        (0..4).map(|i| BodySolid::capsule(corners[i], corners[(i + 1) % 4], thick)).collect();
    let across = (right[1] - right[0]).cross(&(left[1] - right[0]));
    if let Some(out) = across.try_normalize(1e-12) {
        // Corners are anticlockwise as seen from outside the face.
        let face = |sign: f64| corners.map(|corner| corner + out * (sign * thick));
        let points = face(1.0).into_iter().chain(face(-1.0)).collect();
        let triangles = vec![[0, 1, 2], [0, 2, 3], [4, 6, 5], [4, 7, 6]];
        shapes.push(BodySolid::Faces { points, triangles });
    }
    shapes
}

/// Shapes of a head that is a separate body: from its joint to the height above the shoulders that follows from the
/// stature.
pub(super) fn head(places: &JointPlaces<'_>, body: BodyId, size: &Dimensions) -> Vec<BodySolid> {
    let own = places.own(body);
    let up = (places.mass_center(body) - own).try_normalize(1e-6).unwrap_or_else(|| places.up(body));
    let trunk = places.model.bodies()[body.index()].joint.parent;
    let shoulders = trunk.and_then(|trunk| middle(&places.joints_to(trunk, Part::UpperArm)).map(|top| (trunk, top)));
    let from_trunk = |(trunk, top): (BodyId, Vec3)| places.seen_from(body, places.rest[trunk.index()].pose.place(top));
    let vertex = match shoulders.map(from_trunk) {
        Some(top) => top + up * above_shoulders(size),
        None => own + up * size.head,
    };
    head_below(vertex, own, size).to_vec()
}

/// Head and neck between the vertex and the base of the neck.
fn head_below(vertex: Vec3, foot: Vec3, size: &Dimensions) -> [BodySolid; 2] {
    let up = (vertex - foot).try_normalize(1e-6).unwrap_or_else(Vec3::y);
    let thick = HEAD * size.head;
    let chin = vertex - up * (size.head - thick);
    [BodySolid::capsule(chin, vertex - up * thick, thick), BodySolid::capsule(foot, chin, NECK * size.height)]
}

/// The stature [m], decreased for thin and increased for heavy persons: at equal length thickness grows with the root
/// of mass.
fn girth(places: &JointPlaces<'_>, size: &Dimensions) -> f64 {
    let build = (places.model.mass() / size.height.powi(2) / USUAL_BUILD).sqrt();
    size.height * build.clamp(BUILDS[0], BUILDS[1])
}

/// Shoulder centres to vertex [m].
fn above_shoulders(size: &Dimensions) -> f64 {
    size.height - size.leg_length - size.shoulder_height
}

/// Right and left shoulder in the trunk: the joints of its arms, or their positions in a person of this size.
fn shoulders(places: &JointPlaces<'_>, body: BodyId, size: &Dimensions, hips: Option<[Vec3; 2]>) -> Option<[Vec3; 2]> {
    if let Some(arms) = pair(places, body, Part::UpperArm) {
        return Some(arms);
    }
    let [right, left] = hips?;
    let (middle, up) = ((right + left) * 0.5, upwards(places, body));
    let aside = (right - left).try_normalize(1e-6)? * (0.5 * size.shoulder_width);
    let aside = aside - up * aside.dot(&up);
    // At the usual height above the hips, on the line upwards from the joint of the trunk.
    let own = places.own(body);
    let top = own + up * ((middle - own).dot(&up) + size.shoulder_height);
    Some([top + aside, top - aside])
}

/// Right and left hip in the frame of a body.
fn hips(places: &JointPlaces<'_>, body: BodyId) -> Option<[Vec3; 2]> {
    let hip = |side| places.find(Part::Thigh, Some(side)).map(|thigh| places.joint_of(thigh, body));
    Some([hip(Side::Right)?, hip(Side::Left)?])
}

/// Joints of the right and left child that are this part.
fn pair(places: &JointPlaces<'_>, body: BodyId, part: Part) -> Option<[Vec3; 2]> {
    let joint = |side| {
        let child = places.children(body).find(|id| places.part(*id) == part && places.side(*id) == Some(side));
        child.map(|child| places.joint_of(child, body))
    };
    Some([joint(Side::Right)?, joint(Side::Left)?])
}

/// Direction upwards along a trunk: the world's vertical at rest if it passes near the mass centre, otherwise towards
/// the mass centre.
fn upwards(places: &JointPlaces<'_>, body: BodyId) -> Vec3 {
    const NEAR: f64 = 0.8; // cosine of 37 degrees
    let up = places.up(body);
    let center = (places.mass_center(body) - places.own(body)).try_normalize(1e-6).unwrap_or(up);
    if center.dot(&up) > NEAR { up } else { center }
}

fn marker(places: &JointPlaces<'_>, body: BodyId, name: &str) -> Option<Vec3> {
    let found = places.model.markers().iter().find(|marker| marker.name == name && marker.body == Some(body));
    found.map(|marker| marker.location)
}

fn middle(points: &[Vec3]) -> Option<Vec3> {
    (!points.is_empty()).then(|| points.iter().sum::<Vec3>() / points.len() as f64)
}
