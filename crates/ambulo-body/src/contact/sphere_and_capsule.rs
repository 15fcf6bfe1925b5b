//! Spheres and capsules on solids with flat faces.
//!
//! Both contain all points within a radius r of a core: a point or a segment. With δ the distance of the core from the
//! solid (negative inside) and n the direction from the solid to the core, the gap is δ - r. Outside, δ is the distance
//! to the face over which the point lies, or else to the nearest edge. Inside, δ is the separation along the best axis:
//! a face normal or, for a segment of direction d, the cross product of d and an edge whose two faces lie on both sides
//! of the plane through the edge along d.
//!
//! A segment over a face with normal n touches at the two ends of the part over the face, each with its own gap; along
//! an edge likewise.
//!
//! Source: distances of convex sets, derived here.
//! Cost: faces and edges of the solid; nothing is allocated.
//! Pinned by: tests/contact_geometry.rs

use super::polytope::{Polytope, sides};
use super::segment::{Segment, at_share, nearest_point, nearest_shares, shared_length};
use super::separating_axis::Touch;
use crate::spatial::Vec3;

/// The nearest point of a capsule is reported in addition to the ends of the line of contact only if it lies this much
/// deeper [m]. On a flat contact all points are equally near, and rounding would choose another one in each step.
pub(super) const DEEPER: f64 = 1e-6;
/// Cosine of the largest angle between a contact normal and the normal of its face: 6 degrees, at which the gaps at the
/// ends of a rod of 0.4 m differ by 40 mm.
const FACING: f64 = 0.995;

/// Distance of a core from a solid.
#[derive(Debug, Clone, Copy)]
struct Separation {
    /// The point of the core [m].
    point: Vec3,
    /// Unit vector from the solid to the core.
    outward: Vec3,
    /// Distance [m], negative inside.
    distance: f64,
    /// Kind (0 face, 1 edge) and index.
    feature: [usize; 2],
}

impl Separation {
    fn touch(&self, radius: f64, feature: [u64; 4]) -> Touch {
        let gap = self.distance - radius;
        Touch { point: self.point - self.outward * (radius + gap / 2.0), outward: self.outward, gap, feature }
    }
}

/// A sphere on a solid, in the frame of the solid.
pub(super) fn ball_touch(solid: &Polytope, center: Vec3, radius: f64) -> Touch {
    separation_from_point(solid, center).touch(radius, [0; 4])
}

/// A capsule on a solid, in the frame of the solid.
pub(super) fn capsule_touches(solid: &Polytope, segment: Segment, radius: f64, mut report: impl FnMut(Touch)) {
    let nearest = separation_from_segment(solid, segment);
    let mut lowest = f64::MAX;
    let mut report_end = |separation: Separation, feature: [u64; 4]| {
        let touch = separation.touch(radius, feature);
        lowest = lowest.min(touch.gap);
        report(touch);
    };
    if let Some(face) = facing(solid, nearest.outward) {
        if let Some(ends) = over_face(solid, face, segment) {
            for (share, name) in ends {
                report_end(
                    separation_from_plane(solid, face, at_share(segment, share)),
                    [1, face as u64, name as u64, 0],
                );
            }
        }
    } else if let (1, number) = (nearest.feature[0], nearest.feature[1]) {
        let edge = solid.ends(&solid.net.edges[number]);
        if let Some(shares) = shared_length(segment, edge).filter(|_| nearest.distance > 0.0) {
            for (k, share) in shares.into_iter().enumerate() {
                let point = at_share(segment, share);
                if let Some(separation) = separation_between(point, nearest_point(point, edge), nearest.feature) {
                    report_end(separation, [2, number as u64, k as u64, 0]);
                }
            }
        }
    }
    if nearest.distance - radius < lowest - DEEPER {
        report(nearest.touch(radius, [0; 4]));
    }
}

fn separation_from_plane(solid: &Polytope, face: usize, point: Vec3) -> Separation {
    let plane = &solid.faces[face];
    let distance = plane.normal.dot(&point) - plane.height;
    Separation { point, outward: plane.normal, distance, feature: [0, face] }
}

/// `None` if the points coincide.
fn separation_between(point: Vec3, on_solid: Vec3, feature: [usize; 2]) -> Option<Separation> {
    let distance = (point - on_solid).norm();
    (distance > 0.0).then(|| Separation { point, outward: (point - on_solid) / distance, distance, feature })
}

fn separation_from_point(solid: &Polytope, point: Vec3) -> Separation {
    let mut best = separation_from_plane(solid, 0, point);
    for face in 0..solid.faces.len() {
        let separation = separation_from_plane(solid, face, point);
        if separation.distance > 0.0 && solid.is_over(face, point, 0.0) {
            return separation;
        }
        if separation.distance > best.distance {
            best = separation;
        }
    }
    if best.distance <= rounding(solid) {
        return best;
    }
    let to_edge = |number: usize| {
        let edge = solid.ends(&solid.net.edges[number]);
        separation_between(point, nearest_point(point, edge), [1, number])
    };
    nearest_of((0..solid.net.edges.len()).filter_map(to_edge)).unwrap_or(best)
}

/// A point above a plane by less [m] may be on an edge, where the direction from the edge is undefined: a few roundings
/// of the coordinates of the solid's corners.
fn rounding(solid: &Polytope) -> f64 {
    16.0 * f64::EPSILON * solid.size_from(Vec3::zeros())
}

fn nearest_of(separations: impl Iterator<Item = Separation>) -> Option<Separation> {
    separations.min_by(|a, b| a.distance.total_cmp(&b.distance))
}

fn separation_from_segment(solid: &Polytope, segment: Segment) -> Separation {
    let inner = deepest_axis(solid, segment);
    if inner.distance <= rounding(solid) {
        return inner;
    }
    let to_edge = |number: usize| {
        let edge = solid.ends(&solid.net.edges[number]);
        let (s, t) = nearest_shares(segment, edge);
        separation_between(at_share(segment, s), at_share(edge, t), [1, number])
    };
    let ends = segment.into_iter().map(|end| separation_from_point(solid, end));
    nearest_of(ends.chain((0..solid.net.edges.len()).filter_map(to_edge))).unwrap_or(inner)
}

/// The axis of largest separation of a segment.
fn deepest_axis(solid: &Polytope, segment: Segment) -> Separation {
    let lower = |face: usize| {
        let [a, b] = segment.map(|end| separation_from_plane(solid, face, end));
        if b.distance < a.distance { b } else { a }
    };
    let mut best = lower(0);
    for face in 1..solid.faces.len() {
        let separation = lower(face);
        if separation.distance > best.distance {
            best = separation;
        }
    }
    let along = segment[1] - segment[0];
    for (number, edge) in solid.net.edges.iter().enumerate() {
        let [n, m] = edge.faces.map(|face| solid.faces[face].normal);
        let ends = solid.ends(edge);
        let cross = along.cross(&(ends[1] - ends[0]));
        if n.dot(&along) * m.dot(&along) < 0.0 && cross.norm() > 0.0 {
            let outward = cross.normalize() * (n + m).dot(&cross).signum();
            let distance = outward.dot(&(segment[0] - ends[0]));
            if distance > best.distance {
                let (s, _) = nearest_shares(segment, ends);
                best = Separation { point: at_share(segment, s), outward, distance, feature: [1, number] };
            }
        }
    }
    best
}

/// The face whose normal is nearest to this direction, if it is within [`FACING`].
fn facing(solid: &Polytope, outward: Vec3) -> Option<usize> {
    let mut best = (FACING, None);
    for (number, face) in solid.faces.iter().enumerate() {
        let along = face.normal.dot(&outward);
        if along > best.0 {
            best = (along, Some(number));
        }
    }
    best.1
}

/// The part of a segment over a face: two shares of its length, each with a number for its end: 0 and 1 for the ends of
/// the segment, 2 and up for the side of the face that cuts it.
fn over_face(solid: &Polytope, face: usize, segment: Segment) -> Option<[(f64, usize); 2]> {
    let normal = solid.faces[face].normal;
    let (mut from, mut to) = ((0.0, 0), (1.0, 1));
    for (side, (start, end)) in sides(&solid.net.corners[face]).enumerate() {
        let outward = (solid.vertices[end] - solid.vertices[start]).cross(&normal);
        let [a, b] = segment.map(|end| outward.dot(&(end - solid.vertices[start])));
        let share = a / (a - b);
        match (a > 0.0, b > 0.0) {
            (true, true) => return None,
            (true, false) if share > from.0 => from = (share, 2 + side),
            (false, true) if share < to.0 => to = (share, 2 + side),
            _ => {}
        }
    }
    (from.0 < to.0).then_some([from, to])
}
