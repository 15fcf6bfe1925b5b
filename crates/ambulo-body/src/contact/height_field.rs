//! Height fields (ground given by heights on a grid) and their contacts.
//!
//! The ground is solid below the surface, which is made of triangles; it ends at the rim. Contacts:
//!
//! | shape               | with     | contact point |
//! |---------------------|----------|---|
//! | sphere              | surface  | each local minimum of the distance; below the surface, the plane of the triangle |
//! | corner of a solid   | triangle | of the triangle over which it lies, along the normal of the triangle |
//! | edge of a solid     | ridge    | where they cross, if the normal lies between the normals of both edges |
//! | face of a solid     | peak     | along the normal of the face, if no neighbour of the peak is higher along it |
//! | length of a capsule | both     | the same, less the radius; the ends are spheres |
//!
//! A ridge is an edge of the grid at which the surface bends down. Edges in flat ground and in valleys have no
//! contacts, so that a body that slides over flat ground does not catch on them.
//!
//! Source: local minima of the distance between convex pieces, derived here.
//! Cost: cells under the bounding box of the shape times its corners, edges and faces.
//! Not handled: the rim has no contacts.
//! Pinned by: tests/contact_geometry.rs

use super::polytope::Polytope;
use super::segment::{Segment, at_share, nearest_point, nearest_share, nearest_shares};
use super::separating_axis::Touch;
use crate::spatial::Vec3;
use std::ops::RangeInclusive;

/// Heights [m] on a grid over a rectangle in x and z about the origin, y up.
#[derive(Debug)]
pub struct HeightField {
    rows: usize,
    columns: usize,
    /// Row by row.
    heights: Vec<f64>,
    /// Along x and z [m].
    size: [f64; 2],
}

/// A triangle of the surface with its upward normal and index.
#[derive(Debug, Clone, Copy)]
struct Triangle {
    corners: [Vec3; 3],
    normal: Vec3,
    number: usize,
}

/// An edge at which the surface bends down, with the normals of both sides.
#[derive(Debug, Clone, Copy)]
struct Ridge {
    ends: Segment,
    normals: [Vec3; 2],
    number: usize,
}

/// Rows and columns of cells.
type Cells = [RangeInclusive<usize>; 2];

/// Bends below this sine count as flat, and points within this share of a cell as equal; heights and points round to
/// 1e-16.
const FLAT: f64 = 1e-9;
/// Sine of the angle by which a contact normal may lie outside the normals of the two faces of an edge. A box that is
/// tilted by a few degrees on a ridge then touches it with both of its edges, not only with the lower one.
const BESIDE: f64 = 0.05;

/// At most `most` of `count` indices, evenly spread, including both ends.
fn spread(count: usize, most: usize) -> Vec<usize> {
    let kept = count.min(most.max(2));
    (0..kept).map(|k| k * (count - 1) / (kept - 1)).collect()
}

impl HeightField {
    /// Rows and columns, heights row by row [m], and the extent along both [m].
    pub fn new([rows, columns]: [usize; 2], heights: Vec<f64>, size: [f64; 2]) -> HeightField {
        HeightField { rows, columns, heights, size }
    }

    /// Lowest and highest corner of the box around the surface [m].
    pub fn bounding(&self) -> (Vec3, Vec3) {
        let (low, high) = self.heights.iter().fold((f64::MAX, f64::MIN), |(a, b), h| (a.min(*h), b.max(*h)));
        let [x, z] = self.size;
        (Vec3::new(-x / 2.0, low, -z / 2.0), Vec3::new(x / 2.0, high, z / 2.0))
    }

    /// Corners and triangles of the surface. More than `most` rows or columns are thinned out.
    pub(super) fn surface(&self, most: usize) -> (Vec<Vec3>, Vec<[u32; 3]>) {
        let (rows, columns) = (spread(self.rows, most), spread(self.columns, most));
        let share = |i: usize, count: usize| i as f64 / (count - 1) as f64 - 0.5;
        let point = |&i: &usize, &j: &usize| {
            let [x, z] = self.size;
            Vec3::new(share(j, self.columns) * x, self.heights[i * self.columns + j], share(i, self.rows) * z)
        };
        let points = rows.iter().flat_map(|i| columns.iter().map(move |j| point(i, j))).collect();
        let number = |i: usize, j: usize| u32::try_from(i * columns.len() + j).unwrap_or(u32::MAX);
        let cells = (1..rows.len()).flat_map(|i| (1..columns.len()).map(move |j| (i, j)));
        // Each cell is split from (i, j + 1) to (i + 1, j).
        let halves = cells.flat_map(|(i, j)| {
            let [a, b, c, d] = [number(i - 1, j - 1), number(i - 1, j), number(i, j - 1), number(i, j)];
            [[a, c, b], [b, c, d]]
        });
        (points, halves.collect())
    }

    /// Contacts of a sphere, in the frame of the field.
    pub(super) fn ball_touches(&self, center: Vec3, radius: f64, reach: f64, mut report: impl FnMut(Touch)) {
        let touch = |outward: Vec3, distance: f64, number: usize| {
            let gap = distance - radius;
            Touch { point: center - outward * (radius + gap / 2.0), outward, gap, feature: [0, number as u64, 0, 0] }
        };
        if let Some(above) = self.triangle_at(center) {
            let distance = above.normal.dot(&(center - above.corners[0]));
            if distance <= 0.0 {
                report(touch(above.normal, distance, above.number));
                return;
            }
        }
        let around = Vec3::repeat(radius + reach);
        let mut near: Vec<(Triangle, Vec3, f64)> = Vec::new();
        for triangle in self.cells(center - around, center + around).flat_map(|cell| self.triangles(cell)) {
            let place = triangle.nearest_point(center);
            let distance = (center - place).norm();
            if distance < radius + reach && distance > 0.0 && center.y > place.y {
                near.push((triangle, place, distance));
            }
        }
        let same = FLAT * self.step()[0].max(self.step()[1]);
        for (number, (triangle, place, distance)) in near.iter().enumerate() {
            // Another triangle that contains this point is nearer, or has reported it already.
            let taken = near.iter().enumerate().any(|(other_number, (other, _, other_distance))| {
                (*other_distance < distance - same || other_number < number && *other_distance <= distance + same)
                    && (other.nearest_point(*place) - place).norm() <= same
            });
            if !taken {
                report(touch((center - place) / *distance, *distance, triangle.number));
            }
        }
    }

    /// Contacts of a capsule, in the frame of the field: its ends, and its length on ridges and peaks.
    pub(super) fn capsule_touches(&self, ends: Segment, radius: f64, reach: f64, mut report: impl FnMut(Touch)) {
        for (number, end) in ends.into_iter().enumerate() {
            self.ball_touches(end, radius, reach, |t| {
                report(Touch { feature: [t.feature[0], t.feature[1], number as u64, 0], ..t });
            });
        }
        let around = Vec3::repeat(radius + reach);
        let (low, high) = (ends[0].inf(&ends[1]) - around, ends[0].sup(&ends[1]) + around);
        let between = |share: f64| share > 0.0 && share < 1.0;
        for ridge in self.ridges(low, high) {
            let (s, t) = nearest_shares(ends, ridge.ends);
            let touch = core_touch(at_share(ends, s), at_share(ridge.ends, t), radius, [1, ridge.number as u64, 0, 0]);
            if let Some(touch) = touch
                && between(s)
                && between(t)
                && lies_between(touch.outward, ridge.normals)
            {
                report(touch);
            }
        }
        for [i, j] in self.inner_points(low, high) {
            let peak = self.point(i, j);
            let s = nearest_share(peak, ends);
            let touch = core_touch(at_share(ends, s), peak, radius, [2, i as u64, j as u64, 0]);
            if let Some(touch) = touch
                && between(s)
                && self.is_peak(i, j, touch.outward)
            {
                report(touch);
            }
        }
    }

    /// Contacts of a solid, in the frame of the field.
    pub(super) fn polytope_touches(&self, solid: &Polytope, reach: f64, mut report: impl FnMut(Touch)) {
        for (number, corner) in solid.vertices.iter().enumerate() {
            if let Some(Triangle { corners: [p, ..], normal, .. }) = self.triangle_at(*corner) {
                let gap = normal.dot(&(corner - p));
                let point = corner - normal * (gap / 2.0);
                report(Touch { point, outward: normal, gap, feature: [0, number as u64, 0, 0] });
            }
        }
        let around = Vec3::repeat(reach.max(0.0));
        let low = solid.vertices.iter().fold(Vec3::repeat(f64::MAX), |low, v| low.inf(v)) - around;
        let high = solid.vertices.iter().fold(Vec3::repeat(f64::MIN), |high, v| high.sup(v)) + around;
        for ridge in self.ridges(low, high) {
            for (number, edge) in solid.net.edges.iter().enumerate() {
                let against = edge.faces.map(|face| -solid.faces[face].normal);
                if let Some(touch) = crossing(ridge.ends, solid.ends(edge))
                    && lies_between(touch.outward, ridge.normals)
                    && lies_between(touch.outward, against)
                {
                    report(Touch { feature: [1, ridge.number as u64, number as u64, 0], ..touch });
                }
            }
        }
        for [i, j] in self.inner_points(low, high) {
            let peak = self.point(i, j);
            for (number, face) in solid.faces.iter().enumerate() {
                // Only faces that face down: under a face that faces up, the lowest point of the ground would count as
                // a peak.
                if face.normal.y < 0.0 && self.is_peak(i, j, -face.normal) && solid.is_over(number, peak, 0.0) {
                    let gap = face.normal.dot(&peak) - face.height;
                    let point = peak - face.normal * (gap / 2.0);
                    report(Touch {
                        point,
                        outward: -face.normal,
                        gap,
                        feature: [2, (i * self.columns + j) as u64, number as u64, 0],
                    });
                }
            }
        }
    }

    /// Sides of a cell along x and z [m].
    fn step(&self) -> [f64; 2] {
        [self.size[0] / (self.columns - 1) as f64, self.size[1] / (self.rows - 1) as f64]
    }

    /// The grid point in row i and column j.
    fn point(&self, i: usize, j: usize) -> Vec3 {
        let ([x, z], [size_x, size_z]) = (self.step(), self.size);
        Vec3::new(j as f64 * x - size_x / 2.0, self.heights[i * self.columns + j], i as f64 * z - size_z / 2.0)
    }

    /// Row and column of a point, with fractions.
    fn grid_place(&self, point: Vec3) -> [f64; 2] {
        let ([x, z], [size_x, size_z]) = (self.step(), self.size);
        [(point.z + size_z / 2.0) / z, (point.x + size_x / 2.0) / x]
    }

    /// Cells under a box.
    fn cells(&self, low: Vec3, high: Vec3) -> impl Iterator<Item = [usize; 2]> + use<> {
        let [rows, columns]: Cells = self.cell_ranges(low, high);
        rows.flat_map(move |i| columns.clone().map(move |j| [i, j]))
    }

    fn cell_ranges(&self, low: Vec3, high: Vec3) -> Cells {
        let ([i, j], [i_end, j_end]) = (self.grid_place(low), self.grid_place(high));
        // The cast makes negative numbers zero.
        [i as usize..=(i_end as usize).min(self.rows - 2), j as usize..=(j_end as usize).min(self.columns - 2)]
    }

    /// The two triangles of a cell.
    fn triangles(&self, [i, j]: [usize; 2]) -> [Triangle; 2] {
        let (here, right, down) = (self.point(i, j), self.point(i, j + 1), self.point(i + 1, j));
        let number = 2 * (i * self.columns + j);
        [Triangle::new([here, down, right], number), Triangle::new([down, self.point(i + 1, j + 1), right], number + 1)]
    }

    /// The triangle above or below a point; `None` outside the rim.
    fn triangle_at(&self, point: Vec3) -> Option<Triangle> {
        let [row, column] = self.grid_place(point);
        let inside = |x: f64, count: usize| (0.0..=(count - 1) as f64).contains(&x);
        if !inside(row, self.rows) || !inside(column, self.columns) {
            return None;
        }
        let (i, j) = ((row as usize).min(self.rows - 2), (column as usize).min(self.columns - 2));
        let [first, second] = self.triangles([i, j]);
        Some(if row - i as f64 + column - j as f64 <= 1.0 { first } else { second })
    }

    /// Ridges of the cells under a box.
    fn ridges(&self, low: Vec3, high: Vec3) -> impl Iterator<Item = Ridge> {
        self.cells(low, high).flat_map(|cell| self.ridges_of(cell)).flatten()
    }

    /// The ridges at the diagonal of a cell and at its sides to the previous row and the previous column.
    fn ridges_of(&self, [i, j]: [usize; 2]) -> [Option<Ridge>; 3] {
        let [first, second] = self.triangles([i, j]);
        let [here, down, right] = first.corners;
        let number = 3 * (i * self.columns + j);
        let row_before = (i > 0).then(|| self.triangles([i - 1, j])[1]);
        let column_before = (j > 0).then(|| self.triangles([i, j - 1])[1]);
        [
            Ridge::new([down, right], &first, &second, number),
            row_before.and_then(|other| Ridge::new([here, right], &first, &other, number + 1)),
            column_before.and_then(|other| Ridge::new([here, down], &first, &other, number + 2)),
        ]
    }

    /// Rows and columns of the grid points at the corners of the cells under a box, without the rim.
    fn inner_points(&self, low: Vec3, high: Vec3) -> impl Iterator<Item = [usize; 2]> + use<> {
        let [rows, columns] = self.cell_ranges(low, high);
        let (last_row, last_column) = ((rows.end() + 1).min(self.rows - 2), (columns.end() + 1).min(self.columns - 2));
        let (first_row, first_column) = ((*rows.start()).max(1), (*columns.start()).max(1));
        (first_row..=last_row).flat_map(move |i| (first_column..=last_column).map(move |j| [i, j]))
    }

    /// Whether no neighbour of an inner grid point is higher along a direction, and at least one is lower.
    fn is_peak(&self, i: usize, j: usize, up: Vec3) -> bool {
        let peak = self.point(i, j);
        let around = [[i - 1, j], [i + 1, j], [i, j - 1], [i, j + 1], [i + 1, j - 1], [i - 1, j + 1]];
        let rises = around.map(|[i, j]| {
            let to_neighbor = self.point(i, j) - peak;
            to_neighbor.dot(&up) / to_neighbor.norm()
        });
        rises.iter().all(|rise| *rise <= FLAT) && rises.iter().any(|rise| *rise < -FLAT)
    }
}

impl Triangle {
    fn new([a, b, c]: [Vec3; 3], number: usize) -> Triangle {
        Triangle { corners: [a, b, c], normal: (b - a).cross(&(c - a)).normalize(), number }
    }

    fn nearest_point(&self, point: Vec3) -> Vec3 {
        let [a, b, c] = self.corners;
        let sides = [[a, b], [b, c], [c, a]];
        if sides.iter().all(|[from, to]| (to - from).cross(&self.normal).dot(&(point - from)) <= 0.0) {
            return point - self.normal * self.normal.dot(&(point - a));
        }
        let places = sides.map(|side| nearest_point(point, side));
        let distance = |p: &Vec3| (p - point).norm_squared();
        places.into_iter().min_by(|p, q| distance(p).total_cmp(&distance(q))).unwrap_or(a)
    }
}

impl Ridge {
    /// `None` if the surface does not bend down.
    fn new(ends: Segment, first: &Triangle, second: &Triangle, number: usize) -> Option<Ridge> {
        let middle = |t: &Triangle| t.corners.iter().sum::<Vec3>() / 3.0;
        let way = middle(second) - ends[0];
        (first.normal.dot(&way) < -FLAT * way.norm()).then_some(Ridge {
            ends,
            normals: [first.normal, second.normal],
            number,
        })
    }
}

/// Whether a direction, perpendicular to the edge of two faces, lies on the short arc between their normals, or outside
/// by less than [`BESIDE`].
fn lies_between(outward: Vec3, [n, m]: [Vec3; 2]) -> bool {
    let turn = n.cross(&m);
    let least = -BESIDE * turn.norm();
    n.cross(&outward).dot(&turn) >= least && outward.cross(&m).dot(&turn) >= least
}

/// Contact of a sphere about a point of a capsule's axis with a point of the ground, above it or, if they overlap by
/// more than the radius, below. `None` if they coincide.
fn core_touch(core: Vec3, ground: Vec3, radius: f64, feature: [u64; 4]) -> Option<Touch> {
    let way = core - ground;
    let distance = way.norm().copysign(way.y);
    if distance.abs() <= 0.0 {
        return None;
    }
    let (outward, gap) = (way / distance, distance - radius);
    Some(Touch { point: core - outward * (radius + gap / 2.0), outward, gap, feature })
}

/// Contact where an edge of a solid crosses a ridge; `None` if they cross beyond their ends.
fn crossing(ridge: Segment, edge: Segment) -> Option<Touch> {
    let (u, v, way) = (ridge[1] - ridge[0], edge[1] - edge[0], edge[0] - ridge[0]);
    let cross = u.cross(&v);
    let outward = cross.try_normalize(FLAT * u.norm() * v.norm())? * cross.y.signum();
    let gap = outward.dot(&way);
    // ridge + s u + gap n = edge + t v, crossed with v or u and dotted with n.
    let (s, t) = (way.cross(&v).dot(&cross), way.cross(&u).dot(&cross));
    let inside = |x: f64| (0.0..=cross.norm_squared()).contains(&x);
    let point = ridge[0] + u * (s / cross.norm_squared()) + outward * (gap / 2.0);
    (inside(s) && inside(t)).then_some(Touch { point, outward, gap, feature: [0; 4] })
}
