//! Contact points of two shapes: midway between their surfaces, with normal and gap.
//!
//! Closed forms, with centre c and radius r of a sphere, normal n towards the first shape, and gap = n·(p₁ - p₂) for
//! the points p₁, p₂ of the two surfaces that face each other:
//!
//! | first    | second     | gap                                       | points                                     |
//! |----------|------------|-------------------------------------------|--------------------------------------------|
//! | sphere   | half-space | n·c - r                                   | 1                                          |
//! | sphere   | sphere     | ‖c₁ - c₂‖ - r₁ - r₂                       | 1                                          |
//! | sphere   | capsule    | distance of c₁ from the segment - r₁ - r₂ | 1                                          |
//! | sphere   | cuboid     | distance of c from the box - r            | 1                                          |
//! | capsule  | half-space | n·end - r                                 | 2, one per end                             |
//! | capsule  | capsule    | distance of the segments - r₁ - r₂        | 1; 2 if they are parallel                  |
//! | cuboid   | half-space | n·corner                                  | 8, one per corner                          |
//! | hull     | half-space | n·corner                                  | one per corner                             |
//!
//! Other pairs: see `separating_axis` (flat faces on flat faces), `sphere_and_capsule` (on flat faces) and
//! `height_field`. No state is kept between calls, so that the gap of a point belongs to this pose and not to an
//! earlier one.
//!
//! Cost: constant for closed forms, which do not allocate; per call, two solids with flat faces allocate a few lists, a
//! sphere on a height field one.
//! Not handled: contacts between half-spaces and height fields.
//! Pinned by: tests/contact_geometry.rs

use super::polytope::Polytope;
use super::segment::{Segment, across, at_share, nearest_point, nearest_shares, shared_length};
use super::separating_axis::{self, Touch};
use super::shape::{Form, Shape};
use super::sphere_and_capsule::{self, DEEPER};
use crate::spatial::{Pose, Vec3};

/// A point where two shapes touch or nearly touch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactPoint {
    /// Midway between the two surfaces, in the world [m].
    pub point: Vec3,
    /// Unit vector from the second shape towards the first, in the world.
    pub normal: Vec3,
    /// Distance of the surfaces along the normal [m]; negative where they overlap.
    pub gap: f64,
    /// Identifies the touching features of the two shapes: constant from step to step, different for each point of a
    /// pair.
    pub feature: u64,
}

/// Appends the points at which the gap between `first` and `second` is below `reach` [m]; poses are `world_from_shape`.
pub fn contacts(
    first: &Shape,
    first_pose: &Pose,
    second: &Shape,
    second_pose: &Pose,
    reach: f64,
    out: &mut Vec<ContactPoint>,
) {
    let (a, b) = (Placed { shape: first, pose: first_pose }, Placed { shape: second, pose: second_pose });
    let mut report = |p: ContactPoint| {
        if p.gap < reach {
            out.push(p);
        }
    };
    let known = touch_in_order(a, b, reach, &mut report)
        || touch_in_order(b, a, reach, &mut |p| report(ContactPoint { normal: -p.normal, ..p }));
    debug_assert!(known || (is_ground(first) && is_ground(second)), "{first:?} and {second:?}");
}

/// A shape with its pose.
#[derive(Clone, Copy)]
struct Placed<'a> {
    shape: &'a Shape,
    /// `world_from_shape`
    pose: &'a Pose,
}

/// Reports the contacts if this order of the pair is implemented; returns false if not.
fn touch_in_order(first: Placed, second: Placed, reach: f64, report: &mut impl FnMut(ContactPoint)) -> bool {
    match (&first.shape.form, &second.shape.form) {
        (Form::Sphere { radius }, _) => sphere_on(first.pose.translation, *radius, second, reach, report),
        (Form::Capsule { ends, radius }, _) => {
            capsule_on(ends.map(|end| first.pose.place(end)), *radius, second, reach, report)
        }
        (Form::Cuboid { solid, .. } | Form::Convex { solid }, _) => solid_on(solid, first.pose, second, reach, report),
        (Form::HalfSpace | Form::HeightField { .. }, _) => false,
    }
}

fn sphere_on(center: Vec3, radius: f64, second: Placed, reach: f64, report: &mut impl FnMut(ContactPoint)) -> bool {
    let local = second.pose.inverse().place(center);
    match &second.shape.form {
        Form::HalfSpace => report(above_plane(center, radius, second.pose, 0)),
        Form::Sphere { radius: other } => {
            let y = second.pose.rotation.column(1).into_owned();
            report(between_balls([center, second.pose.translation], [radius, *other], || y, 0));
        }
        Form::Capsule { ends, radius: other } => {
            let [a, b] = ends.map(|end| second.pose.place(end));
            report(between_balls([center, nearest_point(center, [a, b])], [radius, *other], || across(b - a), 0));
        }
        Form::Cuboid { half, .. } => report(ball_and_box(center, radius, *half, second.pose)),
        Form::Convex { solid } => report(placed(second.pose, &sphere_and_capsule::ball_touch(solid, local, radius))),
        Form::HeightField { field } => {
            field.ball_touches(local, radius, reach, |t| report(placed(second.pose, &t)));
        }
    }
    true
}

fn capsule_on(ends: Segment, radius: f64, second: Placed, reach: f64, report: &mut impl FnMut(ContactPoint)) -> bool {
    let second_from_world = second.pose.inverse();
    let local = ends.map(|end| second_from_world.place(end));
    match &second.shape.form {
        Form::HalfSpace => {
            for (number, end) in ends.into_iter().enumerate() {
                report(above_plane(end, radius, second.pose, number as u64));
            }
        }
        Form::Capsule { ends: others, radius: other } => {
            between_capsules([ends, others.map(|end| second.pose.place(end))], [radius, *other], report);
        }
        Form::Cuboid { solid, .. } | Form::Convex { solid } => {
            sphere_and_capsule::capsule_touches(solid, local, radius, |t| report(placed(second.pose, &t)));
        }
        Form::HeightField { field } => {
            field.capsule_touches(local, radius, reach, |t| report(placed(second.pose, &t)));
        }
        Form::Sphere { .. } => return false,
    }
    true
}

fn solid_on(solid: &Polytope, pose: &Pose, second: Placed, reach: f64, report: &mut impl FnMut(ContactPoint)) -> bool {
    let seen = || solid.seen_from(&(second.pose.inverse() * *pose));
    match &second.shape.form {
        Form::HalfSpace => {
            for (number, corner) in solid.vertices.iter().enumerate() {
                report(above_plane(pose.place(*corner), 0.0, second.pose, number as u64));
            }
        }
        Form::Cuboid { solid: other, .. } | Form::Convex { solid: other } => {
            separating_axis::touches(other, &seen(), reach, |t| report(placed(second.pose, &t)));
        }
        Form::HeightField { field } => {
            field.polytope_touches(&seen(), reach, |t| report(placed(second.pose, &t)));
        }
        Form::Sphere { .. } | Form::Capsule { .. } => return false,
    }
    true
}

/// A sphere above the plane y = 0 of a frame.
fn above_plane(center: Vec3, radius: f64, plane: &Pose, feature: u64) -> ContactPoint {
    let normal = plane.rotation.column(1).into_owned();
    let gap = normal.dot(&(center - plane.translation)) - radius;
    ContactPoint { point: center - normal * (radius + gap / 2.0), normal, gap, feature }
}

/// Two spheres; `fallback` gives the normal if the centres coincide.
fn between_balls(
    [c1, c2]: [Vec3; 2],
    [r1, r2]: [f64; 2],
    fallback: impl FnOnce() -> Vec3,
    feature: u64,
) -> ContactPoint {
    let apart = c1 - c2;
    let distance = apart.norm();
    let normal = if distance > 0.0 { apart / distance } else { fallback() };
    let gap = distance - r1 - r2;
    ContactPoint { point: c1 - normal * (r1 + gap / 2.0), normal, gap, feature }
}

/// A sphere and a box. If the centre is inside, the nearest face counts.
fn ball_and_box(center: Vec3, radius: f64, half: Vec3, world_from_box: &Pose) -> ContactPoint {
    let c = world_from_box.rotation.transpose() * (center - world_from_box.translation);
    let outside = c - c.sup(&-half).inf(&half);
    let distance = outside.norm();
    let (normal, distance) = if distance > 0.0 {
        (outside / distance, distance)
    } else {
        let k = (half - c.abs()).imin();
        (Vec3::ith(k, if c[k] < 0.0 { -1.0 } else { 1.0 }), c[k].abs() - half[k])
    };
    let (normal, gap) = (world_from_box.rotation * normal, distance - radius);
    ContactPoint { point: center - normal * (radius + gap / 2.0), normal, gap, feature: 0 }
}

/// Two capsules. Parallel ones touch at the ends of the length that they share (features 1 and 2, along the first); the
/// nearest points of the segments (feature 0) are reported for other ones, or if they lie deeper.
fn between_capsules(segments: [Segment; 2], radii: [f64; 2], report: &mut impl FnMut(ContactPoint)) {
    let [first, second] = segments;
    let (u, v) = (first[1] - first[0], second[1] - second[0]);
    let aside = || u.cross(&v).try_normalize(0.0).unwrap_or_else(|| across(u));
    let (s, t) = nearest_shares(first, second);
    let nearest = between_balls([at_share(first, s), at_share(second, t)], radii, aside, 0);
    let mut lowest = f64::MAX;
    for (share, feature) in shared_length(first, second).into_iter().flatten().zip([1, 2]) {
        let p = at_share(first, share);
        let contact = between_balls([p, nearest_point(p, second)], radii, aside, feature);
        lowest = lowest.min(contact.gap);
        report(contact);
    }
    if nearest.gap < lowest - DEEPER {
        report(nearest);
    }
}

fn is_ground(shape: &Shape) -> bool {
    matches!(shape.form, Form::HalfSpace | Form::HeightField { .. })
}

/// A contact in the frame of the second shape, with its normal outward from it, in the world.
fn placed(world_from_second: &Pose, touch: &Touch) -> ContactPoint {
    ContactPoint {
        point: world_from_second.place(touch.point),
        normal: world_from_second.rotation * touch.outward,
        gap: touch.gap,
        feature: mixed(touch.feature),
    }
}

/// Hashes four numbers into one, with the finalizer of splitmix64 after each: two different inputs collide with a
/// probability of 2⁻⁶⁴.
fn mixed(parts: [u64; 4]) -> u64 {
    parts.into_iter().fold(0, |state, part| {
        let mut z = (state ^ part).wrapping_add(0x9E37_79B9_7F4A_7C15);
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    })
}
