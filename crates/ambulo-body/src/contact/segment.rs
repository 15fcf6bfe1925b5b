//! Nearest points of segments: to a point, or to another segment.
//!
//! Source: minimum of a quadratic over an interval or the unit square, derived here.
//! Pinned by: tests/contact_geometry.rs

use crate::spatial::Vec3;

/// The two ends [m].
pub(super) type Segment = [Vec3; 2];

/// The nearest point of a segment to a point, as a share of the length from its first end.
pub(super) fn nearest_share(point: Vec3, [a, b]: Segment) -> f64 {
    ((point - a).dot(&(b - a)) / (b - a).norm_squared()).clamp(0.0, 1.0)
}

/// The point at this share of the length.
pub(super) fn at_share([a, b]: Segment, share: f64) -> Vec3 {
    a + (b - a) * share
}

/// The point of a segment nearest to another point.
pub(super) fn nearest_point(point: Vec3, segment: Segment) -> Vec3 {
    at_share(segment, nearest_share(point, segment))
}

/// The nearest points of two segments, as shares s, t of their lengths: the minimum of ‖a + s u - b - t v‖² over the
/// unit square, inside if there is one, else on one of the four sides.
pub(super) fn nearest_shares(first: Segment, second: Segment) -> (f64, f64) {
    let ([a, a_end], [b, b_end]) = (first, second);
    let (u, v, d) = (a_end - a, b_end - b, a - b);
    let (uu, uv, vv) = (u.norm_squared(), u.dot(&v), v.norm_squared());
    // The determinant of the 2 x 2 system, (‖u‖ ‖v‖ sin)², without cancellation.
    let determinant = u.cross(&v).norm_squared();
    if determinant > 0.0 {
        let s = (uv * v.dot(&d) - vv * u.dot(&d)) / determinant;
        let t = (uu * v.dot(&d) - uv * u.dot(&d)) / determinant;
        if (0.0..=1.0).contains(&s) && (0.0..=1.0).contains(&t) {
            return (s, t);
        }
    }
    let sides = [
        (0.0, nearest_share(a, second)),
        (1.0, nearest_share(a_end, second)),
        (nearest_share(b, first), 0.0),
        (nearest_share(b_end, first), 1.0),
    ];
    let distance = |(s, t): (f64, f64)| (d + u * s - v * t).norm_squared();
    sides.into_iter().min_by(|p, q| distance(*p).total_cmp(&distance(*q))).unwrap_or_default()
}

/// A unit vector perpendicular to a direction.
pub(super) fn across(direction: Vec3) -> Vec3 {
    direction.cross(&Vec3::ith(direction.iamin(), 1.0)).normalize()
}

/// Segments at a smaller angle [rad] are treated as parallel. At this angle the ends of a length of 0.4 m are 20 mm
/// further apart than its middle.
const SIDE_BY_SIDE: f64 = 0.1;

/// The part of `first` that `second` runs alongside, as shares of its length. `None` unless they are nearly parallel.
pub(super) fn shared_length(first: Segment, second: Segment) -> Option<[f64; 2]> {
    let (u, v) = (first[1] - first[0], second[1] - second[0]);
    if u.cross(&v).norm() >= SIDE_BY_SIDE * u.norm() * v.norm() {
        return None;
    }
    let [a, b] = second.map(|end| nearest_share(end, first));
    (a.min(b) < a.max(b)).then(|| [a.min(b), a.max(b)])
}
