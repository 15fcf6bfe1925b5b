//! The path over a cylinder as OpenSim 4.6 finds it.
//!
//! 1. Seen along the axis, tangents from each end touch at two places, one in either sense of turning. Those are taken
//!    that belong together and have the shorter arc or, on a one-sided cylinder, lie on its permitted side.
//! 2. The heights of the two tangent points are those of the plane through both ends and a point of the axis, at the
//!    height of the point that divides the straight line in the ratio of the distances of its ends from the axis.
//! 3. The arc is the helix between the tangent points. The helix of a geodesic would have the slope of the tangents;
//!    this one has not, so it is too long: at most 0.14 mm in walking with Rajagopal's model.
//! 4. Only if the path has several wraps, both heights are moved until tangents and helix agree within 0.1°. The second
//!    point is compared with a helix that was already shifted by the move of the first.
//!
//! An arc of more than half a turn gets the angle 2π - θ, where θ is positive about the axis. If such an arc turns
//! positively itself, θ is negative and the arc is counted a full turn too long.
//!
//! Source: opensim-org/opensim-core, OpenSim/Simulation/Wrap/WrapCylinder.cpp, read at 009c3430 and in a later version
//! with the angle by `atan2`; steps restated. That step 4 needs several wraps is pull request 3125.
//! Pinned by: tests/wrap_opensim.rs, tests/wrap_models.rs.

use super::Arc;
use crate::set::Quadrant;
use ambulo_body::numerics::elementary::{acos, atan2, cos, hypot, sin};
use ambulo_body::spatial::Vec3;
use std::f64::consts::{PI, TAU};

/// Length of the pieces into which OpenSim divides an arc [m].
const PIECE_M: f64 = 0.002;
/// Difference in slope of tangent and helix that is left [rad].
const SLOPE_RAD: f64 = 0.1 * PI / 180.0;
/// Moves of the heights.
const MOST_MOVES: usize = 100;
/// A move in multiples of the move after which the slopes would agree.
const OVERSHOOT: f64 = 1.5;
/// Squared sine of the angle to the axis below which a line counts as parallel.
const PARALLEL: f64 = 2e-13;
/// Component along the axis of the unit normal of the plane of step 2 below which the plane is not used.
const LEAST_NORMAL: f64 = 1e-5 / 20.0;
/// The plane moves a tangent point no further than this [m].
const FURTHEST_M: f64 = 10.0;

/// What OpenSim finds for one straight part and one surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Verdict {
    /// The part stays straight.
    Straight,
    /// An end lies inside.
    Inside,
    /// The part could run over the surface.
    Possible(Arc),
    /// The straight part would run through the surface.
    Mandatory(Arc),
}

/// What OpenSim does with the straight part from `a` to `b`, in the axes of a cylinder of this radius and length;
/// `several`: whether the path has several wraps.
pub(super) fn verdict(
    [a, b]: [Vec3; 2],
    [radius, length]: [f64; 2],
    quadrant: Option<Quadrant>,
    several: bool,
) -> Verdict {
    let distances = [a, b].map(|place| hypot(place.x, place.y));
    if distances.iter().any(|distance| distance * distance < radius * radius) {
        return Verdict::Inside;
    }
    let (nearest, crosses) = nearest_to_axis([a, b], radius);
    let candidates = [Candidates::of(a, radius), Candidates::of(b, radius)];
    let Some(course) = Course::of([a, b], (nearest, crosses), &candidates, quadrant) else {
        return Verdict::Straight;
    };
    let mut touches = heights([a, b], distances, course.touches);
    let half = length / 2.0;
    if touches.iter().all(|touch| touch.z.abs() > half) {
        return Verdict::Straight;
    }
    if several {
        slide([a, b], &mut touches, radius, course.long);
    }
    let Helix { angle, sense, length, .. } = Helix::of(touches, radius, course.long);
    let arc = Arc { from: touches[0], to: touches[1], length, angle, sense };
    if course.mandatory { Verdict::Mandatory(arc) } else { Verdict::Possible(arc) }
}

/// The point of the line through both ends that is nearest to the axis, and whether it lies between them and inside.
fn nearest_to_axis([a, b]: [Vec3; 2], radius: f64) -> (Vec3, bool) {
    let line = b - a;
    let flat = line.x * line.x + line.y * line.y;
    if flat <= PARALLEL * line.norm_squared() {
        return (Vec3::zeros(), false);
    }
    let t = -(a.x * line.x + a.y * line.y) / flat;
    let nearest = a + line * t;
    let inside = nearest.x * nearest.x + nearest.y * nearest.y < radius * radius;
    (nearest, inside && t > 0.0 && t < 1.0)
}

/// The tangent points of one end at its own height: turning about z positively and negatively.
struct Candidates {
    positive: Vec3,
    negative: Vec3,
}

impl Candidates {
    fn of(place: Vec3, radius: f64) -> Candidates {
        let distance = hypot(place.x, place.y);
        let away = Vec3::new(place.x / distance, place.y / distance, 0.0);
        let across = Vec3::new(-away.y, away.x, 0.0);
        let along = radius * (radius / distance);
        let aside = (radius * radius - along * along).max(0.0).sqrt();
        let foot = Vec3::new(0.0, 0.0, place.z) + away * along;
        Candidates { positive: foot + across * aside, negative: foot - across * aside }
    }
}

/// Which tangent points were taken, at the heights of the ends, and what that says about the arc.
struct Course {
    touches: [Vec3; 2],
    /// The arc is more than half a turn.
    long: bool,
    mandatory: bool,
}

impl Course {
    /// `None` if the path stays straight.
    fn of(
        ends: [Vec3; 2],
        (nearest, crosses): (Vec3, bool),
        [one, two]: &[Candidates; 2],
        quadrant: Option<Quadrant>,
    ) -> Option<Course> {
        let around = [[one.positive, two.negative], [one.negative, two.positive]];
        let angles = around.map(|[from, to]| angle_between(from, to));
        let Some(side) = quadrant else {
            let touches = around[usize::from(angles[0] >= angles[1])];
            return crosses.then_some(Course { touches, long: false, mandatory: true });
        };
        let on_side = ends.map(|end| side.holds(&end));
        if on_side.contains(&true) && !crosses && (on_side[0] == on_side[1] || side.holds(&nearest)) {
            return None;
        }
        // OpenSim's order of questions, which decides by the side of the tangent points.
        let positive = match [one.positive, one.negative].map(|touch| side.holds(&touch)) {
            [true, false] => true,
            [false, true] => false,
            [both, _] => match [two.positive, two.negative].map(|touch| side.holds(&touch)) {
                [true, _] => false,
                [false, second] => both || second || angles[0] > angles[1],
            },
        };
        let touches = around[usize::from(!positive)];
        let flat = |v: Vec3| Vec3::new(v.x, v.y, 0.0);
        let pull = touches[0] - ends[0] + touches[1] - ends[1];
        let long = flat(touches[0] + touches[1]).dot(&flat(pull)) < 0.0;
        Some(Course { touches, long, mandatory: crosses && on_side.contains(&true) })
    }
}

/// Angle around the axis between two points on the surface, at most half a turn [rad].
fn angle_between(a: Vec3, b: Vec3) -> f64 {
    let cosine = (a.x * b.x + a.y * b.y) / (hypot(a.x, a.y) * hypot(b.x, b.y));
    acos(cosine.clamp(-1.0, 1.0))
}

/// The tangent points at the heights where the plane of step 2 meets the lines through them along the axis.
fn heights([a, b]: [Vec3; 2], distances: [f64; 2], mut touches: [Vec3; 2]) -> [Vec3; 2] {
    let share = distances[0] / (distances[0] + distances[1]);
    let center = Vec3::new(0.0, 0.0, a.z + (b.z - a.z) * share);
    let normal = (a - center).cross(&(b - center)).try_normalize(0.0).unwrap_or_else(Vec3::zeros);
    if normal.z.abs() < LEAST_NORMAL {
        return touches;
    }
    for (touch, other) in touches.iter_mut().zip([b.z, a.z]) {
        let height = a.z - (normal.x * (touch.x - a.x) + normal.y * (touch.y - a.y)) / normal.z;
        // No further from the other end than the own end is.
        if (height - other).abs() < (a.z - b.z).abs() && (height - touch.z).abs() <= FURTHEST_M {
            touch.z = height;
        }
    }
    touches
}

/// The helix between two tangent points.
struct Helix {
    /// Angle of the arc, about the axis times `sense`.
    angle: f64,
    sense: f64,
    rise: f64,
    length: f64,
}

impl Helix {
    fn of([from, to]: [Vec3; 2], radius: f64, long: bool) -> Helix {
        let short = atan2(from.x * to.y - from.y * to.x, from.x * to.x + from.y * to.y);
        let (angle, sense) = if long { (TAU - short, -1.0) } else { (short, 1.0) };
        let rise = to.z - from.z;
        Helix { angle, sense, rise, length: hypot(radius * angle, rise) }
    }

    /// The point after this share of the length, if the helix begins at `from`.
    fn at(&self, from: Vec3, share: f64) -> Vec3 {
        let angle = self.sense * share * self.angle;
        let (c, s) = (cos(angle), sin(angle));
        Vec3::new(c * from.x - s * from.y, s * from.x + c * from.y, from.z + share * self.rise)
    }
}

/// Moves the tangent points along the axis until tangents and helix agree in slope.
fn slide(ends: [Vec3; 2], touches: &mut [Vec3; 2], radius: f64, long: bool) {
    for _ in 0..MOST_MOVES {
        let helix = Helix::of(*touches, radius, long);
        let pieces = (helix.length / PIECE_M).floor();
        if pieces < 2.0 {
            return;
        }
        let next = helix.at(touches[0], 1.0 / pieces);
        let first = slide_one(ends[0], &mut touches[0], next);
        let next = helix.at(touches[0], 1.0 - 1.0 / pieces);
        let last = slide_one(ends[1], &mut touches[1], next);
        if !(first || last) {
            return;
        }
    }
}

/// Moves a tangent point if the slope of its tangent differs from that to the `next` point of the helix.
fn slide_one(end: Vec3, touch: &mut Vec3, next: Vec3) -> bool {
    let slope = |v: Vec3| acos((v.z / v.norm()).clamp(-1.0, 1.0));
    if (slope(*touch - end) - slope(next - *touch)).abs() <= SLOPE_RAD {
        return false;
    }
    let line = next - end;
    let share = ((touch.x - end.x) * line.x + (touch.y - end.y) * line.y) / (line.x * line.x + line.y * line.y);
    let height = end.z + share * line.z;
    if height.is_finite() {
        touch.z += OVERSHOOT * (height - touch.z);
    }
    true
}
