//! Capsules for limbs: from joint to joint, with a thickness that follows from the mass.
//!
//! A capsule of length L between its centres and mass m has the radius r with m / density = pi r² L + 4/3 pi r³; solved
//! by bisection. So a heavy thigh is thick and the thigh of a child is thin. The radius of bodies without mass is a
//! share of their length.

use super::BodySolid;
use super::joint_places::JointPlaces;
use super::part::Part;
use crate::model::BodyId;
use crate::spatial::Vec3;
use std::f64::consts::PI;

/// Density of limbs [kg/m³]: Winter 2009, table 4.1, has 1050 for thighs, 1090 for shanks, 1070 for upper arms
/// (unverified).
const DENSITY: f64 = 1060.0;
/// Radius over length of bodies without mass.
const SLENDER: f64 = 0.1;
/// Minimum and maximum of radius over length.
const LIMITS: [f64; 2] = [0.04, 0.3];
/// Radius of a body without extent, over stature.
const DOT: f64 = 0.012;
/// Parts of a limb: start and end over its length, and radius relative to the thickest part, the muscles.
const PARTS: [[f64; 3]; 3] = [[0.0, 1.0, 0.78], [0.06, 0.64, 0.9], [0.12, 0.46, 1.0]];
/// A segment shorter than this, relative to the stature, is drawn as a dot.
const SHORT: f64 = 0.02;

/// Radius of a capsule of this length [m] and mass [kg].
pub(super) fn radius(length: f64, mass: f64) -> f64 {
    let limits = LIMITS.map(|share| share * length);
    if mass <= 0.0 {
        return SLENDER * length;
    }
    let volume = mass / DENSITY;
    let (mut low, mut high) = (limits[0], limits[1]);
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        let filled = PI * middle * middle * (length + 4.0 / 3.0 * middle);
        if filled < volume { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// Nested capsules between two points, the thickest of a radius [m]; a dot if the points coincide.
pub(super) fn flesh(from: Vec3, to: Vec3, thick: f64, stature: f64) -> Vec<BodySolid> {
    let along = to - from;
    if along.norm() < SHORT * stature {
        return vec![dot(from, stature)];
    }
    PARTS
        .map(|[start, end, share]| BodySolid::capsule(from + along * start, from + along * end, thick * share))
        .to_vec()
}

/// A small ball.
pub(super) fn dot(at: Vec3, stature: f64) -> BodySolid {
    BodySolid::capsule(at, at, DOT * stature)
}

/// Capsules from the joint of the body to the joints of its children; a body without children ends as far beyond its
/// mass centre as its joint is on the other side.
pub(super) fn limb(places: &JointPlaces<'_>, body: BodyId, stature: f64) -> Vec<BodySolid> {
    let own = places.own(body);
    let ends = ends(places, body);
    let share = places.mass(body) / ends.len().max(1) as f64;
    ends.into_iter().flat_map(|end| flesh(own, end, radius((end - own).norm(), share), stature)).collect()
}

fn ends(places: &JointPlaces<'_>, body: BodyId) -> Vec<Vec3> {
    if places.part(body) == Part::Ulna
        && let Some(hand) = places.find(Part::Hand, places.side(body))
    {
        return vec![places.joint_of(hand, body)];
    }
    // The patella lies on the thigh and is not its end.
    let is_end = |id: &BodyId| places.part(*id) != Part::Small || places.children(*id).next().is_some();
    let ends: Vec<Vec3> = places.children(body).filter(is_end).map(|id| places.joint_of(id, body)).collect();
    if ends.is_empty() {
        let own = places.own(body);
        return vec![own + (places.mass_center(body) - own) * 2.0];
    }
    ends
}
