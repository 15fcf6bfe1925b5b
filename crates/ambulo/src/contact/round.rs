//! Balls and capsules on solids with flat faces.
//!
//! Both are what lies within a radius r of a core: a point or a segment. With δ the distance of the core from the solid
//! (negative inside) and n the direction from the solid to the core, the gap is δ - r. Outside, δ leads to the face
//! over which the point lies, or else to the nearest edge. Inside, δ is the separation along the best axis: a face's
//! normal or, for a segment with direction d, the product of d and an edge whose two faces look to both sides of the
//! plane across d.
//!
//! A segment over a face to which n belongs touches at the two ends of what the face leaves of it, each with the gap
//! there; along an edge likewise.
//!
//! Source: distances of convex sets; derived here.
//! Cost: faces and edges of the solid; nothing is allocated.
//! Pinned by: tests/contact_geometry.rs

use super::polytope::{Polytope, sides};
use super::segment::{Segment, at_share, nearest_point, nearest_shares, shared_length};
use super::separating_axis::Touch;
use crate::spatial::Vec3;

/// The nearest point of a capsule is reported beside those at the ends of what a face or another capsule leaves of it
/// only if it lies this much deeper [m]: on a flat contact it is any point of the length, and another one in each step.
pub(super) const DEEPER: f64 = 1e-6;
/// A face belongs to a normal at less than this angle from its own [rad], whose cosine it is: 6 degrees, at which the
/// ends of a rod of 0.4 m differ by 40 mm in their gaps.
const FACING: f64 = 0.995;

/// From a solid to a core.
#[derive(Debug, Clone, Copy)]
struct Way {
    /// The point of the core [m].
    point: Vec3,
    /// Unit vector from the solid to the core.
    outward: Vec3,
    /// Distance [m], negative inside.
    distance: f64,
    /// 0 face, 1 edge; its number.
    feature: [usize; 2],
}

impl Way {
    fn touch(&self, radius: f64, feature: [u64; 4]) -> Touch {
        let gap = self.distance - radius;
        Touch { point: self.point - self.outward * (radius + gap / 2.0), outward: self.outward, gap, feature }
    }
}

/// A ball on a solid, in the solid's frame.
pub(super) fn ball_touch(solid: &Polytope, center: Vec3, radius: f64) -> Touch {
    way_to_point(solid, center).touch(radius, [0; 4])
}

/// A capsule on a solid, in the solid's frame.
pub(super) fn capsule_touches(solid: &Polytope, segment: Segment, radius: f64, mut report: impl FnMut(Touch)) {
    let nearest = way_to_segment(solid, segment);
    let mut lowest = f64::MAX;
    let mut report_end = |way: Way, feature: [u64; 4]| {
        let touch = way.touch(radius, feature);
        lowest = lowest.min(touch.gap);
        report(touch);
    };
    if let Some(face) = facing(solid, nearest.outward) {
        if let Some(ends) = over_face(solid, face, segment) {
            for (share, name) in ends {
                report_end(way_to_plane(solid, face, at_share(segment, share)), [1, face as u64, name as u64, 0]);
            }
        }
    } else if let (1, number) = (nearest.feature[0], nearest.feature[1]) {
        let edge = solid.ends(&solid.net.edges[number]);
        if let Some(shares) = shared_length(segment, edge).filter(|_| nearest.distance > 0.0) {
            for (k, share) in shares.into_iter().enumerate() {
                let point = at_share(segment, share);
                if let Some(way) = way_between(point, nearest_point(point, edge), nearest.feature) {
                    report_end(way, [2, number as u64, k as u64, 0]);
                }
            }
        }
    }
    if nearest.distance - radius < lowest - DEEPER {
        report(nearest.touch(radius, [0; 4]));
    }
}

fn way_to_plane(solid: &Polytope, face: usize, point: Vec3) -> Way {
    let plane = &solid.faces[face];
    let distance = plane.normal.dot(&point) - plane.height;
    Way { point, outward: plane.normal, distance, feature: [0, face] }
}

/// `None` if the points coincide.
fn way_between(point: Vec3, on_solid: Vec3, feature: [usize; 2]) -> Option<Way> {
    let distance = (point - on_solid).norm();
    (distance > 0.0).then(|| Way { point, outward: (point - on_solid) / distance, distance, feature })
}

fn way_to_point(solid: &Polytope, point: Vec3) -> Way {
    let mut best = way_to_plane(solid, 0, point);
    for face in 0..solid.faces.len() {
        let way = way_to_plane(solid, face, point);
        if way.distance > 0.0 && solid.is_over(face, point, 0.0) {
            return way;
        }
        if way.distance > best.distance {
            best = way;
        }
    }
    if best.distance <= 0.0 {
        return best;
    }
    let to_edge = |number: usize| {
        let edge = solid.ends(&solid.net.edges[number]);
        way_between(point, nearest_point(point, edge), [1, number])
    };
    nearest_of((0..solid.net.edges.len()).filter_map(to_edge)).unwrap_or(best)
}

fn nearest_of(ways: impl Iterator<Item = Way>) -> Option<Way> {
    ways.min_by(|a, b| a.distance.total_cmp(&b.distance))
}

fn way_to_segment(solid: &Polytope, segment: Segment) -> Way {
    let inner = separation(solid, segment);
    if inner.distance <= 0.0 {
        return inner;
    }
    let to_edge = |number: usize| {
        let edge = solid.ends(&solid.net.edges[number]);
        let (s, t) = nearest_shares(segment, edge);
        way_between(at_share(segment, s), at_share(edge, t), [1, number])
    };
    let ends = segment.into_iter().map(|end| way_to_point(solid, end));
    nearest_of(ends.chain((0..solid.net.edges.len()).filter_map(to_edge))).unwrap_or(inner)
}

/// The axis along which a segment is furthest outside.
fn separation(solid: &Polytope, segment: Segment) -> Way {
    let lower = |face: usize| {
        let [a, b] = segment.map(|end| way_to_plane(solid, face, end));
        if b.distance < a.distance { b } else { a }
    };
    let mut best = lower(0);
    for face in 1..solid.faces.len() {
        let way = lower(face);
        if way.distance > best.distance {
            best = way;
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
                best = Way { point: at_share(segment, s), outward, distance, feature: [1, number] };
            }
        }
    }
    best
}

/// The face whose normal is nearest to this one, if it is near.
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

/// Shares of the way between which a segment lies over a face, each with a name: 0 and 1 for its own ends, 2 and up for
/// the side of the face that cuts it.
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
