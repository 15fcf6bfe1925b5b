//! Derivatives of the tangent points of the closed forms by the points between which the path runs.
//!
//! Cylinder, with e_r and e_t the unit vectors away from the axis and around it at a, s the sense of turning:
//!   dτ1 = (e_t/ρ + s r/(ρ d) e_r)·da,  dd = ρ/d e_r·da,  rdφ = s r (dτ2 - dτ1),  dℓ = dda + rdφ + ddb,
//!   dT1 = r dτ1 around the axis and d(za + (zb - za) da/ℓ) along it; T2 is the mirror image.
//! Sphere, with u = a/ρ, w the unit vector in the plane of the path across u, h = u × w:
//!   T1 = r²/ρ u + s r d/ρ w.
//!
//! Source: own derivation. Pinned by: tests/wrap_chain.rs, where paths over several surfaces converge to rounding.

use super::Arc;
use crate::set::WrapShape;
use ambulo_body::spatial::{Mat3, Vec3};

/// Derivatives of both tangent points by the point before and by the point after the arc.
pub(super) struct Derivatives {
    pub(super) first: [Mat3; 2],
    pub(super) last: [Mat3; 2],
}

impl Derivatives {
    /// In the axes of the surface, for the path from the first to the second end along this arc; `None` where they are
    /// infinite.
    pub(super) fn of(shape: WrapShape, ends: [Vec3; 2], arc: &Arc) -> Option<Derivatives> {
        let found = match shape {
            WrapShape::Cylinder { radius, .. } => cylinder(ends, radius, arc),
            WrapShape::Sphere { radius } => sphere(ends, radius, arc),
        };
        let blocks = found.first.iter().chain(&found.last);
        blocks.into_iter().all(|block| block.iter().all(|entry| entry.is_finite())).then_some(found)
    }
}

/// One end of a path over a cylinder, seen along the axis.
struct Side {
    /// Length of the tangent [m].
    tangent: f64,
    /// Derivatives of the angle of the tangent point and of the length of the tangent, as rows.
    angle: Vec3,
    longer: Vec3,
    /// Derivative of the tangent point around the axis, as a column.
    around: Vec3,
}

impl Side {
    fn of(place: Vec3, touch: Vec3, radius: f64, sense: f64) -> Side {
        let flat = Vec3::new(place.x, place.y, 0.0);
        let distance = flat.norm();
        let away = flat / distance;
        let across = Vec3::new(-away.y, away.x, 0.0);
        let tangent = ((distance - radius) * (distance + radius)).sqrt();
        Side {
            tangent,
            angle: across / distance + away * (sense * radius / (distance * tangent)),
            longer: away * (distance / tangent),
            around: Vec3::new(-touch.y, touch.x, 0.0),
        }
    }
}

fn cylinder([a, b]: [Vec3; 2], radius: f64, arc: &Arc) -> Derivatives {
    let sense = arc.sense;
    let [one, two] = [Side::of(a, arc.from, radius, sense), Side::of(b, arc.to, radius, -sense)];
    let rise = b.z - a.z;
    let flat = one.tangent + radius * arc.angle + two.tangent;
    // Derivatives of ℓ by a and by b.
    let flat_by = [one.longer - one.angle * (sense * radius), two.longer + two.angle * (sense * radius)];
    let axis = Vec3::z();
    let share = [one.tangent / flat, two.tangent / flat];
    // z1 = za + rise share1,  z2 = zb - rise share2.
    let height = |share: f64, own: Option<Vec3>, flat_by: Vec3| {
        (own.unwrap_or_else(Vec3::zeros) - flat_by * share) * (rise / flat)
    };
    let first_by_a = axis * (1.0 - share[0]) + height(share[0], Some(one.longer), flat_by[0]);
    let first_by_b = axis * share[0] + height(share[0], None, flat_by[1]);
    let last_by_a = axis * share[1] - height(share[1], None, flat_by[0]);
    let last_by_b = axis * (1.0 - share[1]) - height(share[1], Some(two.longer), flat_by[1]);
    let up = |row: Vec3| axis * row.transpose();
    Derivatives {
        first: [one.around * one.angle.transpose() + up(first_by_a), up(first_by_b)],
        last: [up(last_by_a), two.around * two.angle.transpose() + up(last_by_b)],
    }
}

fn sphere([a, b]: [Vec3; 2], radius: f64, arc: &Arc) -> Derivatives {
    let first = touch_slopes(a, b, radius, arc.sense);
    let last = touch_slopes(b, a, radius, arc.sense);
    Derivatives { first, last: [last[1], last[0]] }
}

/// Derivatives of the tangent point near `a` by `a` and by `b`.
fn touch_slopes(a: Vec3, b: Vec3, radius: f64, sense: f64) -> [Mat3; 2] {
    let distance = a.norm();
    let u = a / distance;
    let along = b.dot(&u);
    let rest = b - u * along;
    let width = rest.norm();
    let w = rest / width;
    let h = u.cross(&w);
    let tangent = ((distance - radius) * (distance + radius)).sqrt();
    let side = sense * radius * tangent / distance;
    let squared = (radius / distance) * (radius / distance);
    let outer = |x: Vec3, y: Vec3| x * y.transpose();
    let by_a = Mat3::identity() * squared - outer(u, u) * (2.0 * squared)
        + outer(w, u) * (sense * squared * radius / tangent)
        - outer(u, w) * (side / distance)
        - outer(h, h) * (side * along / (width * distance));
    [by_a, outer(h, h) * (side / width)]
}
