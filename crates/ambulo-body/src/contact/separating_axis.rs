//! Contacts of two solids with flat faces, by the separating-axis theorem.
//!
//! The gap of two convex solids is their separation along the direction that separates them most,
//!
//!   s(n) = min over b in B of n·b - max over a in A of n·a,      gap = max over unit n of s(n).
//!
//! For overlapping solids this direction is the normal of a face of A or of B, or the cross product of an edge of each.
//! A pair of edges counts only where the arcs between the normals of their faces cross on the unit sphere, since only
//! such pairs make a face of B - A. For a face, the opposing face of the other solid is clipped by the planes through
//! the sides of the first; each remaining corner touches the plane of the face with the gap n·(v - p). Two edges touch
//! in the one point where they cross.
//!
//! | code        | symbol | unit | meaning                                            |
//! | `normal`    | n      | 1    | outward from the first solid, or from a face       |
//! | `gap`       | s      | m    | negative where the solids overlap                  |
//! | `arc`       |        | 1    | normals of the two faces of an edge                |
//!
//! Source: separating-axis theorem; the test of arcs follows Gregorius 2013, "The separating axis test between convex
//! polyhedra" (unverified page), derived here from the signs of triple products.
//! Cost: faces of one times corners of the other, plus edges times edges.
//! Not handled: separated solids that are nearest at a corner and a corner or edge. There s is below the distance, and
//! no point is reported unless a face lies opposite.
//! Pinned by: tests/contact_geometry.rs

use super::polytope::{Plane, Polytope, largest, sides};
use crate::spatial::Vec3;

/// A contact of two solids, in the frame of the caller.
#[derive(Debug, Clone, Copy)]
pub(super) struct Touch {
    /// Midway between the surfaces [m].
    pub(super) point: Vec3,
    /// Unit vector from the first solid towards the second.
    pub(super) outward: Vec3,
    pub(super) gap: f64,
    /// Kinds and indices of the touching features; 64 bits on every target, since `face_touches` packs three numbers
    /// into one.
    pub(super) feature: [u64; 4],
}

/// The features that separate two solids most.
#[derive(Debug, Clone, Copy)]
enum Axis {
    FaceOfFirst(usize),
    FaceOfSecond(usize),
    Edges(usize, usize, Vec3),
}

/// In the order face of the first, face of the second, edges, a later feature must separate by this share of the size
/// of the solids more than an earlier one. Rounding (1e-16 of the size) then does not change the choice from step to
/// step; a normal that is wrong by this share changes the gap by less.
const PREFERENCE: f64 = 1e-7;
/// Edges at a smaller angle [rad] are skipped: their cross product is inaccurate, and a face separates equally well to
/// second order.
const PARALLEL: f64 = 1e-4;

/// Reports the contacts of two solids, given in one frame, whose gap is below `reach` [m].
pub(super) fn touches(first: &Polytope, second: &Polytope, reach: f64, mut report: impl FnMut(Touch)) {
    match separating_axis(first, second, reach) {
        None => {}
        Some(Axis::FaceOfFirst(face)) => face_touches(first, face, second, reach, |t| {
            report(Touch { feature: [0, face as u64, t.feature[0], t.feature[1]], ..t });
        }),
        Some(Axis::FaceOfSecond(face)) => face_touches(second, face, first, reach, |t| {
            report(Touch { outward: -t.outward, feature: [1, face as u64, t.feature[0], t.feature[1]], ..t });
        }),
        Some(Axis::Edges(a, b, outward)) => {
            let touch = edge_touch(first.ends(&first.net.edges[a]), second.ends(&second.net.edges[b]), outward);
            if touch.gap < reach {
                report(Touch { feature: [2, a as u64, b as u64, 0], ..touch });
            }
        }
    }
}

/// The features along which the solids are separated most; `None` if they are `reach` or more apart.
fn separating_axis(first: &Polytope, second: &Polytope, reach: f64) -> Option<Axis> {
    let slack = PREFERENCE * first.size_from(first.vertices[0]).min(second.size_from(second.vertices[0]));
    let (of_first, a) = best_face(first, second);
    let (of_second, b) = best_face(second, first);
    if of_first.max(of_second) >= reach {
        return None;
    }
    let (mut best, mut axis) = (of_first, Axis::FaceOfFirst(a));
    if of_second > best + slack {
        (best, axis) = (of_second, Axis::FaceOfSecond(b));
    }
    match best_edges(first, second) {
        Some((gap, _)) if gap >= reach => None,
        Some((gap, edges)) if gap > best + slack => Some(edges),
        _ => Some(axis),
    }
}

/// Largest separation along a face normal of `of`, and the face.
fn best_face(of: &Polytope, from: &Polytope) -> (f64, usize) {
    let mut best = (f64::MIN, 0);
    for (number, face) in of.faces.iter().enumerate() {
        let gap = -largest(&from.vertices, -face.normal) - face.height;
        if gap > best.0 {
            best = (gap, number);
        }
    }
    best
}

/// Largest separation along the cross product of two edges whose arcs cross.
fn best_edges(first: &Polytope, second: &Polytope) -> Option<(f64, Axis)> {
    let middle = first.middle();
    let mut best: Option<(f64, Axis)> = None;
    for (i, edge_of_first) in first.net.edges.iter().enumerate() {
        let [p, p_end] = first.ends(edge_of_first);
        let along = p_end - p;
        let arc = edge_of_first.faces.map(|f| first.faces[f].normal);
        for (k, edge_of_second) in second.net.edges.iter().enumerate() {
            let other_arc = edge_of_second.faces.map(|f| -second.faces[f].normal);
            if !arcs_cross(arc, other_arc) {
                continue;
            }
            let [q, q_end] = second.ends(edge_of_second);
            let cross = along.cross(&(q_end - q));
            let length = cross.norm();
            if length <= PARALLEL * along.norm() * (q_end - q).norm() {
                continue;
            }
            let normal = cross * ((p - middle).dot(&cross).signum() / length);
            let gap = normal.dot(&(q - p));
            if best.is_none_or(|(most, _)| gap > most) {
                best = Some((gap, Axis::Edges(i, k, normal)));
            }
        }
    }
    best
}

/// Whether the short arcs a-b and c-d on the unit sphere cross: c and d are on opposite sides of the plane of a and b,
/// a and b on opposite sides of the plane of c and d, and both arcs on one half of the sphere.
fn arcs_cross([a, b]: [Vec3; 2], [c, d]: [Vec3; 2]) -> bool {
    let (plane, other_plane) = (b.cross(&a), d.cross(&c));
    let (from_c, from_d) = (c.dot(&plane), d.dot(&plane));
    let (from_a, from_b) = (a.dot(&other_plane), b.dot(&other_plane));
    from_c * from_d < 0.0 && from_a * from_b < 0.0 && from_c * from_b > 0.0
}

/// A corner of the clipped face and the line from it to the next corner.
#[derive(Debug, Clone, Copy)]
pub struct Cut {
    /// The corner.
    pub point: Vec3,
    /// Origin of the corner: two lines, or a vertex.
    pub origin: [usize; 2],
    /// The line to the next corner: a side of the clipped face or of the clipping face.
    pub line: usize,
}

/// Lines are numbered from 0 for sides of the clipped face, from here for sides of the clipping face.
pub const CUTTING: usize = 1 << 16;
/// The mark of vertices.
pub const VERTEX: usize = 1 << 17;

/// Clips the face of `other` that opposes `face` of `solid` by the sides of `face`, and reports the remaining corners.
fn face_touches(solid: &Polytope, face: usize, other: &Polytope, reach: f64, mut report: impl FnMut(Touch)) {
    let (Plane { normal, height }, corners) = (solid.faces[face], &solid.net.corners[face]);
    let slack = PREFERENCE * solid.size_from(solid.vertices[corners[0]]);
    let opposing = other.opposing(normal, slack);
    let incident = &other.net.corners[opposing];
    let mut polygon: Vec<Cut> = incident
        .iter()
        .enumerate()
        .map(|(line, vertex)| Cut { point: other.vertices[*vertex], origin: [VERTEX, *vertex], line })
        .collect();
    let mut cut = Vec::with_capacity(polygon.len() + corners.len());
    for (side, (from, to)) in sides(corners).enumerate() {
        let start = solid.vertices[from];
        let outward = (solid.vertices[to] - start).cross(&normal).normalize();
        cut_polygon(&polygon, Line { side, outward, start, slack }, &mut cut);
        std::mem::swap(&mut polygon, &mut cut);
    }
    for corner in &polygon {
        let gap = normal.dot(&corner.point) - height;
        if gap < reach {
            let [from, to] = corner.origin.map(|number| number as u64);
            let name = ((opposing as u64) << 36) | (from << 18) | to;
            let point = corner.point - normal * (gap / 2.0);
            report(Touch { point, outward: normal, gap, feature: [name, 0, 0, 0] });
        }
    }
}

/// The plane through a side of the clipping face.
#[derive(Debug, Clone, Copy)]
pub struct Line {
    /// The number of the side.
    pub side: usize,
    /// Unit vector in the plane of the face, away from the face.
    pub outward: Vec3,
    /// A point of the side.
    pub start: Vec3,
    /// Corners within this distance of the plane [m] are kept unchanged, so that equal boxes touch in four points.
    pub slack: f64,
}

/// Keeps the part of a polygon inside the line (Sutherland-Hodgman clipping).
pub fn cut_polygon(polygon: &[Cut], line: Line, kept: &mut Vec<Cut>) {
    kept.clear();
    let number = CUTTING + line.side;
    let outside = |corner: &Cut| line.outward.dot(&(corner.point - line.start));
    for (i, corner) in polygon.iter().enumerate() {
        let next = &polygon[(i + 1) % polygon.len()];
        let (here, there) = (outside(corner), outside(next));
        let point = || corner.point + (next.point - corner.point) * (here / (here - there));
        let leaves = there > line.slack;
        if here <= line.slack {
            let on_line = leaves && here >= -line.slack;
            kept.push(Cut { line: if on_line { number } else { corner.line }, ..*corner });
            if leaves && !on_line {
                kept.push(Cut { point: point(), origin: [corner.line, number], line: number });
            }
        } else if there < -line.slack {
            kept.push(Cut { point: point(), origin: [corner.line, number], line: corner.line });
        }
    }
}

/// The contact where the lines through two edges cross.
fn edge_touch([p, p_end]: [Vec3; 2], [q, q_end]: [Vec3; 2], outward: Vec3) -> Touch {
    let (u, v) = (p_end - p, q_end - q);
    let gap = outward.dot(&(q - p));
    // p + s u + gap n = q + t v, crossed with v and dotted with n.
    let s = (q - p).cross(&v).dot(&outward) / u.cross(&v).dot(&outward);
    Touch { point: p + u * s + outward * (gap / 2.0), outward, gap, feature: [0; 4] }
}
