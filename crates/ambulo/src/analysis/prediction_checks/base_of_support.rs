//! The base of support in the horizontal plane, and the distance of a point outside it.

use crate::numerics::Order;
use crate::numerics::elementary::hypot;
use crate::spatial::Vec3;

/// Convex hull of discs around sole points.
#[derive(Debug, Clone)]
pub struct BaseOfSupport {
    /// Corners, counterclockwise; one or two if the soles span no area.
    corners: Vec<[f64; 2]>,
    /// Radius of the discs at them [m].
    radius: f64,
    axes: [Vec3; 2],
}

impl BaseOfSupport {
    /// The base of support of points with discs of `radius` [m] around them; `axes` are two horizontal orthogonal unit
    /// vectors. `None` without points.
    pub fn around(points: &[Vec3], radius: f64, axes: [Vec3; 2]) -> Option<BaseOfSupport> {
        let corners = hull(points.iter().map(|p| [p.dot(&axes[0]), p.dot(&axes[1])]).collect());
        (!corners.is_empty()).then_some(BaseOfSupport { corners, radius, axes })
    }

    /// Horizontal vector from the nearest point of the base [m]; zero inside.
    pub fn outside(&self, point: Vec3) -> Vec3 {
        let p = [point.dot(&self.axes[0]), point.dot(&self.axes[1])];
        let count = self.corners.len();
        let edges = || (0..count).map(|i| (self.corners[i], self.corners[(i + 1) % count]));
        if count > 2 && edges().all(|(a, b)| turn(a, b, p) >= 0.0) {
            return Vec3::zeros();
        }
        let offsets = edges().map(|(a, b)| from_edge(a, b, p));
        let nearest = offsets.min_by(|v, w| length(*v).total_cmp(&length(*w))).unwrap_or([0.0; 2]);
        let distance = length(nearest);
        let share = if distance > self.radius { (distance - self.radius) / distance } else { 0.0 };
        (self.axes[0] * nearest[0] + self.axes[1] * nearest[1]) * share
    }
}

fn length([x, y]: [f64; 2]) -> f64 {
    hypot(x, y)
}

/// Twice the area of a triangle, positive if counterclockwise.
fn turn(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// Vector from the nearest point of an edge to p.
fn from_edge(a: [f64; 2], b: [f64; 2], p: [f64; 2]) -> [f64; 2] {
    let (along, to) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
    let square = along[0] * along[0] + along[1] * along[1];
    let share = if square > 0.0 { ((to[0] * along[0] + to[1] * along[1]) / square).clamp(0.0, 1.0) } else { 0.0 };
    [to[0] - share * along[0], to[1] - share * along[1]]
}

/// Corners of the convex hull, counterclockwise (Andrew 1979, monotone chains; unverified).
fn hull(mut places: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    places.sort_by_numbers(|place| [place[0], place[1]]);
    places.dedup();
    if places.len() < 3 {
        return places;
    }
    let chain = |places: &mut dyn Iterator<Item = [f64; 2]>| {
        let mut out: Vec<[f64; 2]> = Vec::new();
        for p in places {
            while out.len() > 1 && turn(out[out.len() - 2], out[out.len() - 1], p) <= 0.0 {
                out.pop();
            }
            out.push(p);
        }
        out.pop();
        out
    };
    let mut corners = chain(&mut places.iter().copied());
    corners.extend(chain(&mut places.iter().rev().copied()));
    corners
}
