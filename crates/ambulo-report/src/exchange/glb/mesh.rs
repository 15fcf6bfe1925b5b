//! Triangles of shapes, with normals.

use crate::page::ViewShape;
use ambulo::numerics::elementary::{cos, sin};
use ambulo::spatial::Vec3;
use nalgebra::{Quaternion, UnitQuaternion};
use std::f64::consts::{PI, TAU};

/// Sides of a round shape, and rings of each of its caps.
const SIDES: usize = 16;
const RINGS: usize = 4;

/// A surface; triangles are anticlockwise seen from outside.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Triangles {
    /// Corners of triangles [m].
    pub points: Vec<[f64; 3]>,
    /// Outward unit vectors, one per point.
    pub normals: Vec<[f64; 3]>,
    /// Indices in `points`.
    pub corners: Vec<[u32; 3]>,
}

impl Triangles {
    /// The surface of a shape.
    #[must_use]
    pub fn of_shape(shape: &ViewShape) -> Triangles {
        match shape {
            ViewShape::Capsule { from, to, radius } => capsule(Vec3::from(*from), Vec3::from(*to), *radius),
            ViewShape::Box { center, half, turn } => {
                let turn = UnitQuaternion::from_quaternion(Quaternion::from(*turn));
                cuboid(Vec3::from(*center), Vec3::from(*half), &turn)
            }
            ViewShape::Mesh { points, triangles } => {
                let point = |corner: u32| points.get(corner as usize).map(|point| Vec3::from(*point));
                let mut all = Triangles::default();
                for [a, b, c] in triangles {
                    if let (Some(a), Some(b), Some(c)) = (point(*a), point(*b), point(*c)) {
                        all.face(&[a, b, c]);
                    }
                }
                all
            }
        }
    }

    /// A flat sheet with four corners.
    pub(super) fn sheet(corners: &[[f64; 3]; 4]) -> Triangles {
        let mut sheet = Triangles::default();
        sheet.face(&corners.map(Vec3::from));
        sheet
    }

    /// Joins two surfaces.
    pub(super) fn with(mut self, other: Triangles) -> Triangles {
        let base = self.next();
        self.points.extend(other.points);
        self.normals.extend(other.normals);
        self.corners.extend(other.corners.into_iter().map(|corners| corners.map(|corner| corner + base)));
        self
    }

    /// A ring of a round surface: SIDES + 1 points about an axis; the last coincides with the first.
    /// `lean` is the share of the axis in the normals.
    pub(super) fn ring(&mut self, center: Vec3, [across, aside, along]: [Vec3; 3], radius: f64, lean: f64) {
        for side in 0..=SIDES {
            let angle = TAU * side as f64 / SIDES as f64;
            let outward = across * cos(angle) + aside * sin(angle);
            self.points.push((center + outward * radius).into());
            self.normals.push((outward * (1.0 - lean * lean).max(0.0).sqrt() + along * lean).into());
        }
    }

    /// The band between the last two rings, the later one further along the axis.
    pub(super) fn band(&mut self) {
        let count = SIDES as u32 + 1;
        let (lower, upper) = (self.next() - 2 * count, self.next() - count);
        for side in 0..SIDES as u32 {
            self.corners.push([lower + side, upper + side, upper + side + 1]);
            self.corners.push([lower + side, upper + side + 1, lower + side + 1]);
        }
    }

    /// A flat face with its corners in turn.
    fn face(&mut self, corners: &[Vec3]) {
        let [a, b, c, ..] = corners else { return };
        let Some(normal) = (b - a).cross(&(c - a)).try_normalize(1e-15) else { return };
        let base = self.next();
        for corner in corners {
            self.points.push((*corner).into());
            self.normals.push(normal.into());
        }
        let last = self.next() - base;
        self.corners.extend((2..last).map(|k| [base, base + k - 1, base + k]));
    }

    fn next(&self) -> u32 {
        u32::try_from(self.points.len()).unwrap_or(u32::MAX)
    }
}

/// Two directions across an axis, and the axis: left-handed, so that bands face outwards.
pub(super) fn frame(along: Vec3) -> [Vec3; 3] {
    let spare = if along.y.abs() < 0.9 { Vec3::y() } else { Vec3::x() };
    let across = spare.cross(&along).normalize();
    [across, across.cross(&along), along]
}

fn capsule(from: Vec3, to: Vec3, radius: f64) -> Triangles {
    let along = (to - from).try_normalize(1e-12).unwrap_or_else(Vec3::y);
    let axes = frame(along);
    let mut all = Triangles::default();
    let angles = (0..=RINGS).map(|k| (from, -0.5 * PI * (RINGS - k) as f64 / RINGS as f64));
    let upper = (0..=RINGS).map(|k| (to, 0.5 * PI * k as f64 / RINGS as f64));
    for (number, (center, angle)) in angles.chain(upper).enumerate() {
        all.ring(center + along * (radius * sin(angle)), axes, radius * cos(angle), sin(angle));
        if number > 0 {
            all.band();
        }
    }
    all
}

fn cuboid(center: Vec3, half: Vec3, turn: &UnitQuaternion<f64>) -> Triangles {
    let mut all = Triangles::default();
    for k in 0..3 {
        for sign in [1.0, -1.0] {
            let [normal, u, v] = [0, 1, 2].map(|i| Vec3::ith((k + i) % 3, half[(k + i) % 3]));
            let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
            let corner = |(a, b): (f64, f64)| center + turn * (normal * sign + u * (a * sign) + v * b);
            all.face(&corners.map(corner));
        }
    }
    all
}
