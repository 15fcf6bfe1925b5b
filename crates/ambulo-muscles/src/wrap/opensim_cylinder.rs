//! The path over a cylinder as OpenSim 4.6 finds it.
//!
//! 1. Seen along the axis, tangents from each end touch at two places, one in either sense of turning. Those are taken
//!    that belong together and have the shorter arc or, on a one-sided cylinder, lie on its permitted side.
//! 2. A plane through both ends and an apex on the surface gives the heights of the two tangent points. The apex
//!    is opposite the point that divides the straight line by the distances of its ends from the axis.
//! 3. The arc is the helix between the tangent points. The helix of a geodesic would have the slope of the tangents;
//!    this one has not, so it is too long: at most 0.14 mm in walking with Rajagopal's model.
//! 4. Only if the path has several wraps, both heights are moved until tangents and helix agree within 0.1°.
//!
//! Source: opensim-org/opensim-core, OpenSim/Simulation/Wrap/WrapCylinder.cpp, read at 009c3430, steps restated; that
//! step 4 needs several wraps is pull request 3125.
//! Pinned by: tests/wrap_opensim.rs.

use super::Arc;
use super::opensim::Verdict;
use crate::set::Quadrant;
use ambulo_body::numerics::elementary::{acos, cos, hypot, sin};
use ambulo_body::spatial::Vec3;
use std::f64::consts::{PI, TAU};

/// Length of the pieces into which OpenSim divides an arc [m].
const PIECE_M: f64 = 0.002;
/// Difference in slope of tangent and helix that is left [rad].
const SLOPE_RAD: f64 = 0.1 * PI / 180.0;
/// Moves of the heights.
const MOST_MOVES: usize = 100;
/// A move goes this much further than the height that would agree.
const OVERSHOOT: f64 = 1.5;
/// Squared sine of the angle to the axis below which a line counts as parallel.
const PARALLEL: f64 = 2e-13;
/// Twenty metres of a line parallel to the axis rise at least this much over the plane of step 2 [m].
const LEAST_RISE: f64 = 1e-5;

/// What OpenSim does with the straight part from `a` to `b`, in the axes of a cylinder of this radius and length;
/// `several`: whether the path has several wraps.
pub(super) fn verdict(
    [a, b]: [Vec3; 2],
    [radius, length]: [f64; 2],
    quadrant: Option<Quadrant>,
    several: bool,
) -> Verdict {
    let ends = [a, b].map(|place| hypot(place.x, place.y));
    if ends.iter().any(|distance| distance * distance < radius * radius) {
        return Verdict::Inside;
    }
    let (nearest, crosses) = nearest_to_axis([a, b], radius);
    let candidates = [Candidates::of(a, radius), Candidates::of(b, radius)];
    let Some(course) = Course::of([a, b], (nearest, crosses), &candidates, quadrant) else {
        return Verdict::Straight;
    };
    let mut touches = heights([a, b], ends, radius, &course);
    let half = length / 2.0;
    if touches.iter().all(|touch| touch.z.abs() > half) {
        return Verdict::Straight;
    }
    let helix = match several {
        true => slide([a, b], &mut touches, radius, course.long),
        false => Helix::of(touches, radius, course.long),
    };
    let Helix { length, angle, sense, .. } = helix;
    let arc = Arc { from: touches[0], to: touches[1], length, angle, sense, crosses };
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

/// Which tangent points were taken, and what that says about the arc.
struct Course {
    touches: [Vec3; 2],
    /// The apex lies on the other side of the axis than the straight line.
    far: bool,
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
            let positive = angles[0] < angles[1];
            let touches = around[usize::from(!positive)];
            return crosses.then_some(Course { touches, far: false, long: false, mandatory: true });
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
        let far = if positive { angles[0] > angles[1] } else { angles[0] <= angles[1] };
        let touches = around[usize::from(!positive)];
        let flat = |v: Vec3| Vec3::new(v.x, v.y, 0.0);
        let pull = touches[0] - ends[0] + touches[1] - ends[1];
        let long = flat(touches[0] + touches[1]).dot(&flat(pull)) < 0.0;
        Some(Course { touches, far, long, mandatory: crosses && on_side.contains(&true) })
    }
}

/// Angle around the axis between two points on the surface, at most half a turn [rad].
fn angle_between(a: Vec3, b: Vec3) -> f64 {
    let cosine = (a.x * b.x + a.y * b.y) / (hypot(a.x, a.y) * hypot(b.x, b.y));
    acos(cosine.clamp(-1.0, 1.0))
}

/// The tangent points at the heights where the plane of step 2 meets the lines through them along the axis.
fn heights([a, b]: [Vec3; 2], ends: [f64; 2], radius: f64, course: &Course) -> [Vec3; 2] {
    let share = ends[0] / (ends[0] + ends[1]);
    let middle = a + (b - a) * share;
    let center = Vec3::new(0.0, 0.0, middle.z);
    let unit = |v: Vec3| v.try_normalize(0.0).unwrap_or_else(Vec3::zeros);
    let across = unit(Vec3::z().cross(&unit((a - center).cross(&(b - center)))));
    let [one, two] = [center + across * radius, center - across * radius];
    let one_is_nearer = (middle - one).norm_squared() < (middle - two).norm_squared();
    let apex = if one_is_nearer == course.far { two } else { one };
    let normal = unit(unit(a - apex).cross(&unit(b - apex)));
    let mut touches = course.touches;
    for (touch, other) in touches.iter_mut().zip([b.z, a.z]) {
        if (20.0 * normal.z).abs() < LEAST_RISE {
            continue;
        }
        let height = a.z - (normal.x * (touch.x - a.x) + normal.y * (touch.y - a.y)) / normal.z;
        // No further from the other end than the own end is, and within ten metres.
        if (height - other).abs() < (a.z - b.z).abs() && (height - touch.z).abs() <= 10.0 {
            touch.z = height;
        }
    }
    touches
}

/// The helix between two tangent points.
struct Helix {
    from: Vec3,
    rise: f64,
    /// Angle of the arc and its sense about z.
    angle: f64,
    sense: f64,
    length: f64,
}

impl Helix {
    fn of([from, to]: [Vec3; 2], radius: f64, long: bool) -> Helix {
        let short = angle_between(from, to);
        let turns_positively = (from.x * to.y - from.y * to.x > 0.0) != long;
        let angle = if long { TAU - short } else { short };
        let rise = to.z - from.z;
        let sense = if turns_positively { 1.0 } else { -1.0 };
        Helix { from, rise, angle, sense, length: hypot(radius * angle, rise) }
    }

    /// The point after this share of the length.
    fn at(&self, share: f64) -> Vec3 {
        let angle = self.sense * share * self.angle;
        let (c, s) = (cos(angle), sin(angle));
        let [x, y, z] = [self.from.x, self.from.y, self.from.z];
        Vec3::new(c * x - s * y, s * x + c * y, z + share * self.rise)
    }
}

/// Moves the tangent points along the axis until tangents and helix agree in slope.
fn slide(ends: [Vec3; 2], touches: &mut [Vec3; 2], radius: f64, long: bool) -> Helix {
    for _ in 0..MOST_MOVES {
        let helix = Helix::of(*touches, radius, long);
        let pieces = (helix.length / PIECE_M).floor();
        if pieces < 2.0 {
            return helix;
        }
        let next = [helix.at(1.0 / pieces), helix.at(1.0 - 1.0 / pieces)];
        let moved = [0, 1].map(|end| slide_one(ends[end], &mut touches[end], next[end]));
        if !moved.contains(&true) {
            return helix;
        }
    }
    Helix::of(*touches, radius, long)
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
