//! Solids with flat faces: corners, planes and edges, volume and inertia.
//!
//! Integrals are sums over tetrahedra that share the middle of the solid. For a tetrahedron 0, a, b, c of volume
//! V = det(a, b, c)/6
//!
//!   ∫ x dV = V (a + b + c)/4      ∫ x xᵀ dV = V/20 (a aᵀ + b bᵀ + c cᵀ + s sᵀ),  s = a + b + c.
//!
//! Source: moments of the simplex, derived here.
//! Cost: linear in corners.
//! Pinned by: tests/contact_geometry.rs

use crate::spatial::{Mat3, Pose, Vec3};
use parry3d_f64::math::Vector;
use parry3d_f64::shape::ConvexPolyhedron;
use std::collections::BTreeMap;
use std::sync::Arc;

/// A convex solid with flat faces.
#[derive(Debug, Clone)]
pub struct Polytope {
    pub(super) vertices: Vec<Vec3>,
    /// The planes of the faces.
    pub(super) faces: Vec<Plane>,
    pub(super) net: Arc<Net>,
}

#[derive(Debug, Clone, Copy)]
pub(super) struct Plane {
    /// Outward, of unit length.
    pub(super) normal: Vec3,
    /// Largest n·v of all vertices [m].
    pub(super) height: f64,
}

/// Vertices of faces and edges.
#[derive(Debug)]
pub(super) struct Net {
    /// Vertices of each face, anticlockwise seen from outside.
    pub(super) corners: Vec<Vec<usize>>,
    pub(super) edges: Vec<Edge>,
}

#[derive(Debug, Clone, Copy)]
pub(super) struct Edge {
    pub(super) corners: [usize; 2],
    pub(super) faces: [usize; 2],
}

impl Polytope {
    /// A box about the origin. Bits 0, 1, 2 of a vertex index are set for vertices at +x, +y, +z.
    pub fn cuboid(half: Vec3) -> Polytope {
        let side = |bit: usize, k: usize| if bit >> k & 1 == 1 { half[k] } else { -half[k] };
        let vertices = (0..8).map(|bit| Vec3::new(side(bit, 0), side(bit, 1), side(bit, 2))).collect();
        let (faces, corners) = (0..6)
            .map(|number| {
                let (k, positive) = (number / 2, number % 2);
                let (u, v) = (1 << ((k + 1) % 3), 1 << ((k + 2) % 3));
                let base = positive << k;
                let corners = if positive == 1 { [0, u, u + v, v] } else { [0, v, u + v, u] };
                let normal = Vec3::ith(k, if positive == 1 { 1.0 } else { -1.0 });
                (Plane { normal, height: half[k] }, corners.map(|c| base + c).to_vec())
            })
            .unzip();
        Polytope::new(vertices, faces, corners)
    }

    /// The convex hull of points [m], built by the collision library. `None` if that fails.
    pub(super) fn hull(points: &[Vec3]) -> Option<Polytope> {
        let from_library = |v: Vector| Vec3::new(v.x, v.y, v.z);
        let given: Vec<Vector> = points.iter().map(|p| Vector::new(p.x, p.y, p.z)).collect();
        let hull = ConvexPolyhedron::from_convex_hull(&given)?;
        let vertices: Vec<Vec3> = hull.points().iter().map(|p| from_library(*p)).collect();
        let (faces, corners) = hull
            .faces()
            .iter()
            .map(|face| {
                let (start, count) = (face.first_vertex_or_edge as usize, face.num_vertices_or_edges as usize);
                let corners = hull.vertices_adj_to_face()[start..start + count].iter().map(|c| *c as usize).collect();
                let normal = from_library(face.normal);
                (Plane { normal, height: largest(&vertices, normal) }, corners)
            })
            .unzip();
        Some(Polytope::new(vertices, faces, corners))
    }

    fn new(vertices: Vec<Vec3>, faces: Vec<Plane>, corners: Vec<Vec<usize>>) -> Polytope {
        let mut faces_at: BTreeMap<[usize; 2], Vec<usize>> = BTreeMap::new();
        for (number, corners) in corners.iter().enumerate() {
            for (a, b) in sides(corners) {
                faces_at.entry([a.min(b), a.max(b)]).or_default().push(number);
            }
        }
        let edge = |(corners, faces): ([usize; 2], Vec<usize>)| match faces[..] {
            [a, b] => Some(Edge { corners, faces: [a, b] }),
            _ => None, // produced by rounding in the hull; its corners still belong to faces
        };
        let edges = faces_at.into_iter().filter_map(edge).collect();
        Polytope { vertices, faces, net: Arc::new(Net { corners, edges }) }
    }

    /// Volume [m³].
    pub(super) fn volume(&self) -> f64 {
        self.tetrahedra().map(|t| determinant(t) / 6.0).sum()
    }

    /// Mass centre [m] and ∫ x xᵀ dm / m about it [m²].
    pub(super) fn center_and_spread(&self) -> (Vec3, Mat3) {
        let origin = self.middle();
        let (mut volume, mut first, mut second) = (0.0, Vec3::zeros(), Mat3::zeros());
        for [a, b, c] in self.tetrahedra() {
            let (v, s) = (determinant([a, b, c]) / 6.0, a + b + c);
            volume += v;
            first += s * (v / 4.0);
            second += (a * a.transpose() + b * b.transpose() + c * c.transpose() + s * s.transpose()) * (v / 20.0);
        }
        let center = first / volume;
        (origin + center, second / volume - center * center.transpose())
    }

    /// Tetrahedra that fill the solid: three corners relative to the middle, which is the fourth.
    fn tetrahedra(&self) -> impl Iterator<Item = [Vec3; 3]> {
        let origin = self.middle();
        self.net.corners.iter().flat_map(move |corners| {
            let corner = move |c: usize| self.vertices[corners[c]] - origin;
            (2..corners.len()).map(move |c| [corner(0), corner(c - 1), corner(c)])
        })
    }

    pub(super) fn middle(&self) -> Vec3 {
        self.vertices.iter().sum::<Vec3>() / self.vertices.len() as f64
    }

    /// Distance of the furthest vertex from `point` [m].
    pub fn size_from(&self, point: Vec3) -> f64 {
        self.vertices.iter().map(|v| (v - point).norm()).fold(0.0, f64::max)
    }

    /// The same solid in another frame.
    pub(super) fn seen_from(&self, outer_from_inner: &Pose) -> Polytope {
        let vertices = self.vertices.iter().map(|v| outer_from_inner.place(*v)).collect();
        let faces = self
            .faces
            .iter()
            .map(|face| {
                let normal = outer_from_inner.rotation * face.normal;
                let height = face.height + normal.dot(&outer_from_inner.translation);
                Plane { normal, height }
            })
            .collect();
        Polytope { vertices, faces, net: Arc::clone(&self.net) }
    }

    /// Of the faces at the vertex furthest against `direction` (within `slack` [m]), the one that faces most against
    /// it.
    pub(super) fn opposing(&self, direction: Vec3, slack: f64) -> usize {
        let reached = -largest(&self.vertices, -direction) + slack;
        let mut best = (f64::MAX, 0);
        for (number, (face, corners)) in self.faces.iter().zip(&self.net.corners).enumerate() {
            let along = face.normal.dot(&direction);
            if along < best.0 && corners.iter().any(|c| self.vertices[*c].dot(&direction) <= reached) {
                best = (along, number);
            }
        }
        best.1
    }

    /// Whether a point lies over a face: between the planes through its sides, or at most `slack` [m] outside.
    pub(super) fn is_over(&self, face: usize, point: Vec3, slack: f64) -> bool {
        let normal = self.faces[face].normal;
        sides(&self.net.corners[face]).all(|(from, to)| {
            let outward = (self.vertices[to] - self.vertices[from]).cross(&normal);
            outward.dot(&(point - self.vertices[from])) <= slack * outward.norm()
        })
    }

    pub(super) fn ends(&self, edge: &Edge) -> [Vec3; 2] {
        edge.corners.map(|c| self.vertices[c])
    }
}

/// Largest coordinate of the points along a direction.
pub(super) fn largest(points: &[Vec3], direction: Vec3) -> f64 {
    points.iter().map(|p| p.dot(&direction)).fold(f64::MIN, f64::max)
}

/// Sides of a face: each corner with the next one.
pub(super) fn sides(corners: &[usize]) -> impl Iterator<Item = (usize, usize)> {
    corners.iter().enumerate().map(|(i, corner)| (*corner, corners[(i + 1) % corners.len()]))
}

fn determinant([a, b, c]: [Vec3; 3]) -> f64 {
    a.dot(&b.cross(&c))
}
