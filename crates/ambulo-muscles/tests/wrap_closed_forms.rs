//! Paths over one surface: closed forms, minimality, derivatives, invariance, and surfaces that are passed over.

use ambulo_body::numerics::Random;
use ambulo_body::spatial::{Mat3, Pose, Vec3, rotation};
use ambulo_muscles::set::{Quadrant, WrapShape};
use ambulo_muscles::wrap::{Contact, PathAnchor, PathRoute, PathSurface, WrapRule};
use std::f64::consts::{PI, TAU};

pub(crate) const FRONT: Option<Quadrant> = Some(Quadrant { axis: 0, positive: true });

pub(crate) fn cylinder(radius: f64, length: f64) -> PathSurface {
    surface(WrapShape::Cylinder { radius, length })
}

pub(crate) fn sphere(radius: f64) -> PathSurface {
    surface(WrapShape::Sphere { radius })
}

fn surface(shape: WrapShape) -> PathSurface {
    PathSurface { body: None, pose: Pose::IDENTITY, shape, quadrant: None, active: true, first: 0, last: 1 }
}

pub(crate) fn route(places: &[Vec3], surfaces: &[PathSurface]) -> PathRoute {
    let anchors: Vec<PathAnchor> = places.iter().map(|place| PathAnchor { body: None, place: *place }).collect();
    let mut route = PathRoute::default();
    route.find(WrapRule::Exact, &anchors, surfaces);
    route
}

/// Pull of unit tension on the first and last point.
pub(crate) fn pulls(route: &PathRoute) -> [Vec3; 2] {
    let nodes = route.nodes();
    let last = nodes.len() - 1;
    [(nodes[1].place - nodes[0].place).normalize(), (nodes[last - 1].place - nodes[last].place).normalize()]
}

/// Derivatives of the length by both ends, from differences with the sixth order of the step as error; `None` where the
/// path begins to touch a surface or changes sides within four steps, or the error is estimated above 3e-10.
pub(crate) fn slopes(places: [Vec3; 2], surfaces: &[PathSurface]) -> Option<[Vec3; 2]> {
    let [fine, coarse] = [slopes_by(1e-4, places, surfaces)?, slopes_by(1.5e-4, places, surfaces)?];
    (0..2).all(|end| (fine[end] - coarse[end]).norm() < 3e-10).then_some(fine)
}

fn slopes_by(step: f64, places: [Vec3; 2], surfaces: &[PathSurface]) -> Option<[Vec3; 2]> {
    let middle = route(&places, surfaces);
    let mut slopes = [Vec3::zeros(); 2];
    for end in 0..2 {
        for axis in 0..3 {
            let at = |n: f64| {
                let mut moved = places;
                moved[end][axis] += n * step;
                let found = route(&moved, surfaces);
                let is_alike = found.contacts() == middle.contacts()
                    && found.nodes().iter().zip(middle.nodes()).all(|(a, b)| (a.place - b.place).norm() < 0.01);
                is_alike.then_some(found.length())
            };
            at(4.0)?;
            at(-4.0)?;
            let sum = 45.0 * (at(1.0)? - at(-1.0)?) - 9.0 * (at(2.0)? - at(-2.0)?) + at(3.0)? - at(-3.0)?;
            slopes[end][axis] = sum / (60.0 * step);
        }
    }
    Some(slopes)
}

fn vector(random: &mut Random) -> Vec3 {
    Vec3::from_fn(|_, _| random.normal())
}

/// Two points on opposite sides, 2 to 4 radii of 0.03 from the centre, scattered so that about half the paths touch.
fn ends(random: &mut Random) -> [Vec3; 2] {
    let a = vector(random).normalize() * (0.06 + 0.06 * random.share());
    let b = -a + vector(random) * 0.03;
    // Near the surface lengths are no smooth functions of the place.
    [a, b.normalize() * b.norm().max(0.06)]
}

fn place(random: &mut Random) -> Pose {
    Pose { rotation: rotation(&vector(random)), translation: vector(random) }
}

#[test]
fn half_a_turn_has_its_closed_form() {
    // Points on opposite sides at two radii: tangents of √3 and a sixth of a turn.
    let ends = [Vec3::new(-2.0, 0.0, 0.0), Vec3::new(2.0, 0.0, 0.0)];
    let expected = 2.0 * 3.0_f64.sqrt() + PI / 3.0;
    let found = route(&ends, &[cylinder(1.0, 9.0)]);
    assert!((found.length() - expected).abs() < 1e-14 && found.contacts() == [Contact::Touching]);
    assert!((route(&ends, &[sphere(1.0)]).length() - expected).abs() < 1e-14);
    // With a rise the unrolled path is a straight line; the arc has its share of it.
    let rising = [ends[0], ends[1] + Vec3::z() * 3.0];
    let found = route(&rising, &[cylinder(1.0, 9.0)]);
    assert!((found.length() - expected.hypot(3.0)).abs() < 1e-14);
    let arc = found.nodes()[1].arc.unwrap();
    assert!((arc - PI / 3.0 * expected.hypot(3.0) / expected).abs() < 1e-14);
    // It must fail for another radius.
    assert!((route(&ends, &[cylinder(1.001, 9.0)]).length() - expected).abs() > 1e-3);
}

#[test]
fn a_one_sided_cylinder_is_passed_in_front_however_far_that_is() {
    let at = |angle: f64, height: f64| Vec3::new(2.0 * angle.cos(), 2.0 * angle.sin(), height);
    let front = PathSurface { quadrant: FRONT, ..cylinder(1.0, 9.0) };
    let covered = TAU / 3.0;
    for turn in [0.5, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0] {
        let ends = [at(-turn / 2.0, 0.0), at(turn / 2.0, 0.2)];
        let found = route(&ends, &[front]);
        let arc: f64 = turn - covered;
        let expected = match arc > 0.0 {
            true => (2.0 * 3.0_f64.sqrt() + arc).hypot(0.2),
            false => (ends[1] - ends[0]).norm(),
        };
        assert!((found.length() - expected).abs() < 1e-13, "{turn}");
        // Any side: never more than half a turn.
        let free = route(&ends, &[cylinder(1.0, 9.0)]);
        assert!((free.length() - found.length()).abs() < 1e-13 || turn > PI);
    }
    // Both ends behind the axis, the straight line between them free: the path still runs around the front.
    let ends = [at(-3.0, 0.0), at(3.0, 0.0)];
    assert!(route(&ends, &[front]).length() > 6.0 && route(&ends, &[cylinder(1.0, 9.0)]).length() < 1.0);
}

#[test]
fn surfaces_that_cannot_be_obeyed_are_passed_over_and_named() {
    let ends = [Vec3::new(-2.0, 0.1, 0.0), Vec3::new(2.0, 0.1, 0.0)];
    let straight = (ends[1] - ends[0]).norm();
    let high = ends.map(|end| end + Vec3::z() * 5.0);
    let cases = [
        (ends, cylinder(3.0, 9.0), Contact::EndInside),
        (ends, sphere(3.0), Contact::EndInside),
        (high, cylinder(1.0, 9.0), Contact::BeyondEnds),
        (ends, PathSurface { active: false, ..cylinder(1.0, 9.0) }, Contact::Free),
        (ends, PathSurface { last: 0, ..sphere(1.0) }, Contact::Free),
        (ends.map(|end| end + Vec3::y()), cylinder(1.0, 9.0), Contact::Free),
    ];
    for (ends, surface, contact) in cases {
        let found = route(&ends, &[surface]);
        assert!((found.length() - straight).abs() < 1e-14 && found.contacts() == [contact], "{contact:?}");
        assert_eq!(found.nodes().len(), 2);
    }
    // One tangent point on the cylinder is enough.
    let rising = [ends[0] + Vec3::z() * 4.0, ends[1] + Vec3::z() * 5.0];
    assert_eq!(route(&rising, &[cylinder(1.0, 9.0)]).contacts(), [Contact::Touching]);
    // Ends in places without a direction give a length all the same.
    for surface in [cylinder(1.0, 9.0), sphere(1.0)] {
        for places in [[Vec3::zeros(); 2], [Vec3::x() * 2.0, -Vec3::x() * 2.0], [Vec3::x() * 2.0; 2], [Vec3::z(); 2]] {
            assert!(route(&places, &[surface]).length().is_finite());
        }
    }
}

#[test]
fn only_the_named_part_of_a_path_touches() {
    let places = [-2.0, 2.0, -2.0, 2.0].map(|x| Vec3::new(x, 0.0, 0.0));
    let arcs = |first, last| {
        let surface = PathSurface { first, last, ..cylinder(1.0, 9.0) };
        route(&places, &[surface]).nodes().iter().map(|node| node.arc.is_some()).collect::<Vec<_>>()
    };
    assert_eq!(arcs(1, 2), [false, false, true, false, false, false]);
    assert_eq!(arcs(0, 1), [false, true, false, false, false, false]);
    assert_eq!(arcs(0, 3).iter().filter(|arc| **arc).count(), 3);
}

/// Length of the way over a surface through two other points of it.
fn detour(surface: &PathSurface, ends: [Vec3; 2], touches: [Vec3; 2]) -> f64 {
    let arc = match surface.shape {
        WrapShape::Cylinder { radius, .. } => {
            let [a, b] = touches;
            (radius * (a.x * b.y - a.y * b.x).atan2(a.x * b.x + a.y * b.y)).hypot(b.z - a.z)
        }
        WrapShape::Sphere { radius } => radius * touches[0].angle(&touches[1]),
    };
    (touches[0] - ends[0]).norm() + arc + (ends[1] - touches[1]).norm()
}

/// The point of the surface after a small move.
fn slid(surface: &PathSurface, place: Vec3, step: Vec3) -> Vec3 {
    let moved = place + step;
    match surface.shape {
        WrapShape::Cylinder { radius, .. } => {
            let out = radius / moved.x.hypot(moved.y);
            Vec3::new(moved.x * out, moved.y * out, moved.z)
        }
        WrapShape::Sphere { radius } => moved.normalize() * radius,
    }
}

fn surface_normal(surface: &PathSurface, place: Vec3) -> Vec3 {
    match surface.shape {
        WrapShape::Cylinder { .. } => Vec3::new(place.x, place.y, 0.0),
        WrapShape::Sphere { .. } => place,
    }
}

#[test]
fn no_near_way_is_shorter() {
    let mut random = Random::seeded(1);
    let (mut compared, mut least) = (0, f64::INFINITY);
    for _ in 0..400 {
        let ends = ends(&mut random);
        for surface in [cylinder(0.03, 9.0), sphere(0.03)] {
            let found = route(&ends, &[surface]);
            let [from, to] = match found.nodes() {
                // On a shorter arc both points could change places.
                [_, from, to, _] if from.arc.unwrap() > 2e-3 => [from.place, to.place],
                _ => continue,
            };
            assert!((detour(&surface, ends, [from, to]) - found.length()).abs() < 1e-12);
            for _ in 0..20 {
                let touches = [from, to].map(|place| slid(&surface, place, vector(&mut random) * 1e-4));
                // Not through the surface: each end must be above the tangent plane of its point.
                let is_seen = |k: usize| surface_normal(&surface, touches[k]).dot(&(ends[k] - touches[k])) >= 0.0;
                if !(is_seen(0) && is_seen(1)) {
                    continue;
                }
                least = least.min(detour(&surface, ends, touches) - found.length());
                compared += 1;
            }
            // It must fail from a wrong tangent point: some move shortens the way.
            let wrong = [slid(&surface, from, vector(&mut random).normalize() * 2e-3), to];
            let moves = (0..60).map(|_| slid(&surface, wrong[0], vector(&mut random) * 2e-4));
            let best = moves.map(|first| detour(&surface, ends, [first, to])).fold(f64::INFINITY, f64::min);
            assert!(best < detour(&surface, ends, wrong));
        }
    }
    println!("{compared} ways, least excess {least:.1e} m");
    assert!(compared > 1000 && least > -1e-15, "{least:e}");
}

#[test]
fn the_pull_at_an_end_is_the_derivative_of_the_length() {
    let mut random = Random::seeded(2);
    let (mut worst, mut touching) = (0.0_f64, 0);
    for _ in 0..300 {
        let ends = ends(&mut random);
        for quadrant in [None, FRONT] {
            let one_sided = PathSurface { quadrant, pose: place(&mut random), ..cylinder(0.03, 9.0) };
            for surface in [one_sided, PathSurface { pose: one_sided.pose, ..sphere(0.03) }] {
                let ends = ends.map(|end| surface.pose.place(end));
                let found = route(&ends, &[surface]);
                let Some(slopes) = slopes(ends, &[surface]) else { continue };
                let difference = (0..2).map(|k| (slopes[k] + pulls(&found)[k]).norm()).fold(0.0, f64::max);
                touching += usize::from(found.nodes().len() == 4);
                worst = worst.max(difference);
            }
        }
    }
    println!("{touching} arcs within {worst:.1e}");
    assert!(touching > 500 && worst < 1e-9, "{touching} {worst:e}");
}

#[test]
fn paths_move_with_the_world_are_mirrored_with_it_and_scale_with_it() {
    let mut random = Random::seeded(3);
    let mirror = Mat3::from_diagonal(&Vec3::new(1.0, 1.0, -1.0));
    for _ in 0..200 {
        let ends = ends(&mut random);
        for quadrant in [None, FRONT] {
            for surface in [cylinder(0.03, 0.1), sphere(0.03)] {
                let surface = PathSurface { quadrant, ..surface };
                let found = route(&ends, &[surface]);
                let same = |other: &PathRoute, image: &dyn Fn(Vec3) -> Vec3, scale: f64| {
                    assert_eq!(found.contacts(), other.contacts());
                    assert!((found.length() * scale - other.length()).abs() < 1e-13);
                    for (a, b) in found.nodes().iter().zip(other.nodes()) {
                        assert!((image(a.place) - b.place).norm() < 1e-11);
                    }
                };
                let pose = place(&mut random);
                let moved = PathSurface { pose, ..surface };
                same(&route(&ends.map(|end| pose.place(end)), &[moved]), &|p| pose.place(p), 1.0);
                // Mirrored across the plane of x and y, which surface and side are symmetric to.
                same(&route(&ends.map(|end| mirror * end), &[surface]), &|p| mirror * p, 1.0);
                let shape = match surface.shape {
                    WrapShape::Cylinder { radius, length } => {
                        WrapShape::Cylinder { radius: 2.0 * radius, length: 2.0 * length }
                    }
                    WrapShape::Sphere { radius } => WrapShape::Sphere { radius: 2.0 * radius },
                };
                let larger = PathSurface { shape, ..surface };
                same(&route(&ends.map(|end| end * 2.0), &[larger]), &|p| p * 2.0, 2.0);
                // Backwards it is the same path.
                let back = route(&[ends[1], ends[0]], &[surface]);
                assert!((found.length() - back.length()).abs() < 1e-14);
            }
        }
    }
}

#[test]
fn the_length_changes_no_more_than_the_ends_move() {
    let mut random = Random::seeded(4);
    let mut worst = 0.0_f64;
    for _ in 0..200 {
        let [a, b] = ends(&mut random);
        let toward = vector(&mut random) * 0.05;
        for surface in [cylinder(0.03, 9.0), sphere(0.03)] {
            let mut last: Option<f64> = None;
            for step in 0..=200 {
                let moved = [a, b + toward * (f64::from(step) / 200.0)];
                let found = route(&moved, &[surface]);
                if found.contacts() == [Contact::EndInside] {
                    break;
                }
                let length = found.length();
                worst = worst.max(last.map_or(0.0, |last| (length - last).abs() - toward.norm() / 200.0));
                last = Some(length);
            }
        }
    }
    println!("largest excess {worst:.1e} m");
    assert!(worst < 1e-14, "{worst:e}");
}
