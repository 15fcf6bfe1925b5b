//! The shortest path between two points over a sphere.
//!
//! It lies in the plane of both points and the centre: a tangent, an arc of a great circle and a tangent, with
//!   γa = acos(r/|a|), γb = acos(r/|b|), arc φ = angle between a and b - γa - γb, or 2π minus that angle the other
//! way round.
//!
//! Source: own derivation; compared with OpenSim 4.6 in tests/wrap_opensim.rs. On which side a path passes a one-sided
//! sphere is OpenSim's rule: where the two tangents of the other way together do not point to the permitted side.

use super::{Arc, Contact, Passage};
use crate::set::Quadrant;
use ambulo_body::numerics::elementary::atan2;
use ambulo_body::spatial::Vec3;
use std::f64::consts::TAU;

/// The shortest path from `a` to `b` in the axes of a sphere of this radius.
pub(super) fn shortest([a, b]: [Vec3; 2], radius: f64, quadrant: Option<Quadrant>) -> Passage {
    let distances = [a.norm(), b.norm()];
    if !distances.iter().all(|distance| *distance >= radius && *distance > 0.0) {
        return Passage::Straight(Contact::EndInside);
    }
    let [u, v] = [a / distances[0], b / distances[1]];
    let tangents = distances.map(|distance| ((distance - radius) * (distance + radius)).sqrt());
    let covered = atan2(tangents[0], radius) + atan2(tangents[1], radius);
    let normal = u.cross(&v);
    let between = atan2(normal.norm(), u.dot(&v));
    let near = between - covered;
    if near <= 0.0 {
        return Passage::Straight(Contact::Free);
    }
    let Some(normal) = plane(u, normal, quadrant) else { return Passage::Straight(Contact::Free) };
    // Tangent points: from a towards b, from b towards a; the other way round with the opposite sense.
    let touch = |sense: f64| {
        [0, 1].map(|end| {
            let (toward, sense) = if end == 0 { (u, sense) } else { (v, -sense) };
            let (cos, sin) = (radius / distances[end], sense * tangents[end] / distances[end]);
            radius * (cos * toward + sin * normal.cross(&toward))
        })
    };
    let (sense, angle) = match is_far(quadrant, touch(-1.0), [a, b]) {
        false => (1.0, near),
        true => (-1.0, TAU - between - covered),
    };
    let [from, to] = touch(sense);
    Passage::Over(Arc { from, to, length: radius * angle, angle, sense })
}

/// Unit normal of the plane of the path; if both points and the centre lie on a line, one of its many planes.
fn plane(u: Vec3, normal: Vec3, quadrant: Option<Quadrant>) -> Option<Vec3> {
    normal.try_normalize(f64::MIN_POSITIVE).or_else(|| {
        let mut front = [0.0; 3];
        let least = u.iamin();
        front[quadrant.map_or(least, |side| side.axis.min(2))] =
            if quadrant.is_some_and(|side| !side.positive) { -1.0 } else { 1.0 };
        u.cross(&Vec3::from(front)).try_normalize(f64::MIN_POSITIVE)
    })
}

/// Whether a one-sided sphere is passed the longer way round: `others` are the tangent points of that way.
fn is_far(quadrant: Option<Quadrant>, others: [Vec3; 2], [a, b]: [Vec3; 2]) -> bool {
    quadrant.is_some_and(|side| {
        let toward = (others[0] - a) + (others[1] - b);
        let sign = if side.positive { 1.0 } else { -1.0 };
        let on_side = |place: Vec3| place[side.axis.min(2)] * sign >= 0.0;
        sign * toward[side.axis.min(2)] > 0.0 && !(on_side(a) && on_side(b))
    })
}
