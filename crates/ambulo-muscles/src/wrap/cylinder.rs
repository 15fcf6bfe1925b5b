//! The shortest path between two points over a cylinder.
//!
//! Seen along the axis, a path that turns around the cylinder is a tangent, an arc and a tangent:
//!   T1 at γa = acos(r/ρa) from a, T2 at γb = acos(r/ρb) before b, arc φ = |turn from a to b| - γa - γb.
//! Both tangents and the arc lie on a surface that unrolls into a plane, where the shortest path is a straight line.
//! Height is therefore proportional to the length ℓ = da + rφ + db seen along the axis:
//!   z1 = za + (zb - za) da/ℓ,   z2 = zb - (zb - za) db/ℓ,   arc = rφ √(ℓ² + (zb - za)²) / ℓ.
//!
//! | code | symbol | unit | |
//! |---|---|---|---|
//! | `distance` | ρ | m | from the axis |
//! | `tangent` | d | m | length of a tangent seen along the axis, √(ρ² - r²) |
//! | `turn` | | rad | angle from a to b around the axis, positive about z |
//!
//! Source: own derivation; compared with OpenSim 4.6 in tests/wrap_opensim.rs.

use super::{Arc, Contact, Passage};
use crate::set::Quadrant;
use ambulo_body::numerics::elementary::{atan2, hypot};
use ambulo_body::spatial::Vec3;
use std::f64::consts::TAU;

/// The shortest path from `a` to `b` in the axes of a cylinder of this radius and length.
pub(super) fn shortest(ends: [Vec3; 2], size: [f64; 2], quadrant: Option<Quadrant>) -> Passage {
    // Most lines pass the cylinder, and need no angles.
    if quadrant.is_none() && depth(ends, size[0]).is_some_and(|depth| depth < 0.0) {
        return Passage::Straight(Contact::Free);
    }
    by_turn(ends, size, turn(ends[0], ends[1], quadrant))
}

/// The shortest path that turns in this sense, 1 positively about z or -1.
pub(super) fn shortest_in_sense(ends: [Vec3; 2], size: [f64; 2], sense: f64) -> Passage {
    let turn = turn(ends[0], ends[1], None);
    by_turn(ends, size, if turn * sense < 0.0 { turn + sense * TAU } else { turn })
}

/// How far the straight line runs into the cylinder, negative if it passes it [m]; `None` with an end inside.
pub(super) fn depth([a, b]: [Vec3; 2], radius: f64) -> Option<f64> {
    super::depth([a, b].map(|place| Vec3::new(place.x, place.y, 0.0)), radius)
}

fn by_turn([a, b]: [Vec3; 2], [radius, length]: [f64; 2], turn: f64) -> Passage {
    let [from, to] = [a, b].map(|place| End::of(place, radius));
    let (Some(from), Some(to)) = (from, to) else { return Passage::Straight(Contact::EndInside) };
    let angle = turn.abs() - from.angle - to.angle;
    if angle <= 0.0 {
        return Passage::Straight(Contact::Free);
    }
    let sense = if turn > 0.0 { 1.0 } else { -1.0 };
    let flat = from.tangent + radius * angle + to.tangent;
    let rise = (b.z - a.z) / flat;
    let heights = [a.z + rise * from.tangent, b.z - rise * to.tangent];
    let half = length / 2.0;
    if heights.iter().all(|z| *z > half) || heights.iter().all(|z| *z < -half) {
        return Passage::Straight(Contact::BeyondEnds);
    }
    Passage::Over(Arc {
        from: from.touch(a, sense, heights[0]),
        to: to.touch(b, -sense, heights[1]),
        length: radius * angle * hypot(1.0, rise),
        angle,
        sense,
    })
}

/// Angle from a to b around the z axis: the shorter way, or the way that does not cross the half-plane behind the axis.
fn turn(a: Vec3, b: Vec3, quadrant: Option<Quadrant>) -> f64 {
    let front = match quadrant {
        Some(Quadrant { axis: axis @ (0 | 1), positive }) => {
            let sign = if positive { 1.0 } else { -1.0 };
            if axis == 0 { [sign, 0.0] } else { [0.0, sign] }
        }
        // The side along its own axis is no side of a cylinder.
        Some(_) | None => return atan2(a.x * b.y - a.y * b.x, a.x * b.x + a.y * b.y),
    };
    let from_front = |p: Vec3| atan2(front[0] * p.y - front[1] * p.x, front[0] * p.x + front[1] * p.y);
    from_front(b) - from_front(a)
}

/// One end of the path, seen along the axis.
struct End {
    /// Cosine and sine of the angle to the tangent point: radius, and tangent, over the distance from the axis.
    cos_sin: [f64; 2],
    angle: f64,
    tangent: f64,
    /// Radius over distance.
    shrink: f64,
}

impl End {
    /// `None` inside the cylinder.
    fn of(place: Vec3, radius: f64) -> Option<End> {
        let distance = hypot(place.x, place.y);
        if distance < radius || distance <= 0.0 {
            return None;
        }
        let tangent = ((distance - radius) * (distance + radius)).sqrt();
        let shrink = radius / distance;
        Some(End { cos_sin: [shrink, tangent / distance], angle: atan2(tangent, radius), tangent, shrink })
    }

    /// The tangent point in this sense of turning, at this height.
    fn touch(&self, place: Vec3, sense: f64, height: f64) -> Vec3 {
        let [cos, sin] = self.cos_sin;
        let sin = sense * sin;
        let [x, y] = [place.x * self.shrink, place.y * self.shrink];
        Vec3::new(cos * x - sin * y, sin * x + cos * y, height)
    }
}
