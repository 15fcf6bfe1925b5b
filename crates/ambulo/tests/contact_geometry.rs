//! Shapes, where they touch, which pairs may, and the soft law: against closed forms, against the collision library's
//! general queries, and against rigid motions of everything.

use crate::common;
use crate::common::random::Random;
use ambulo::contact::{ContactPoint, FrictionCurve, HuntCrossley, Onset, Shape, candidate_pairs, contacts};
use ambulo::spatial::{Inertia, Mat3, Pose, Vec3};
use parry3d_f64::math::{Matrix, Pose as GenericPose, Rotation, Vector};
use parry3d_f64::query;
use parry3d_f64::shape::SharedShape;

/// Rounding of a few dozen operations on lengths of a metre.
const ROUNDING: f64 = 1e-12;
/// The collision library's iterations stop at about 1e-8 of a length of a metre: its own epsilon is 1.5e-8.
const ITERATED: f64 = 1e-6;

fn touching(first: &Shape, first_pose: &Pose, second: &Shape, second_pose: &Pose, reach: f64) -> Vec<ContactPoint> {
    let mut out = Vec::new();
    contacts(first, first_pose, second, second_pose, reach, &mut out);
    out
}

fn lowest(points: &[ContactPoint]) -> f64 {
    points.iter().map(|p| p.gap).fold(f64::MAX, f64::min)
}

fn random_pose(r: &mut Random, size: f64) -> Pose {
    Pose { rotation: r.rotation(), translation: r.vector(size) }
}

fn moved(pose: &Pose, by: Vec3) -> Pose {
    Pose { translation: pose.translation + by, ..*pose }
}

/// A shape of this library, and one of the collision library that is the same without this radius: its iterations find
/// the distance of segments to 1e-8 m, but that of capsules to 1e-5 m, and where they overlap to 4e-4 m.
struct Twin {
    name: &'static str,
    shape: Shape,
    generic: SharedShape,
    radius: f64,
}

fn to_generic(v: Vec3) -> Vector {
    Vector::new(v.x, v.y, v.z)
}

fn to_generic_pose(pose: &Pose) -> GenericPose {
    let column = |k: usize| to_generic(pose.rotation.column(k).into_owned());
    let rotation = Rotation::from_mat3(&Matrix::from_cols(column(0), column(1), column(2)));
    GenericPose::from_parts(to_generic(pose.translation), rotation)
}

fn sphere(r: &mut Random) -> Twin {
    let radius = r.between(0.05, 0.3);
    Twin { name: "sphere", shape: Shape::sphere(radius).unwrap(), generic: SharedShape::ball(radius), radius: 0.0 }
}

fn capsule(r: &mut Random) -> Twin {
    let (a, b, radius) = (r.vector(0.3), r.vector(0.3), r.between(0.05, 0.2));
    let generic = SharedShape::segment(to_generic(a), to_generic(b));
    Twin { name: "capsule", shape: Shape::capsule(a, b, radius).unwrap(), generic, radius }
}

fn cuboid(r: &mut Random) -> Twin {
    let half = Vec3::new(r.between(0.05, 0.4), r.between(0.05, 0.4), r.between(0.05, 0.4));
    let generic = SharedShape::cuboid(half.x, half.y, half.z);
    Twin { name: "cuboid", shape: Shape::cuboid(half).unwrap(), generic, radius: 0.0 }
}

fn hull(r: &mut Random) -> Twin {
    let points: Vec<Vec3> = (0..12).map(|_| r.unit() * r.between(0.2, 0.4)).collect();
    let given: Vec<Vector> = points.iter().map(|p| to_generic(*p)).collect();
    Twin {
        name: "hull",
        shape: Shape::convex(&points).unwrap(),
        generic: SharedShape::convex_hull(&given).unwrap(),
        radius: 0.0,
    }
}

fn half_space(_: &mut Random) -> Twin {
    Twin { name: "half-space", shape: Shape::half_space(), generic: SharedShape::halfspace(Vector::Y), radius: 0.0 }
}

/// Gently rolling ground of 4 m by 4 m.
fn rolling_ground(r: &mut Random) -> Shape {
    Shape::height_field(9, 9, &r.list(81, 0.05), 4.0, 4.0).unwrap()
}

fn flat_ground() -> Shape {
    Shape::height_field(9, 7, &[0.0; 63], 4.0, 4.0).unwrap()
}

/// Distance of two shapes by the collision library; negative where they overlap. A half-space must come first there:
/// parry 0.31.1 forgets to invert the pose in the other order.
fn generic_gap(a: &Twin, a_pose: &Pose, b: &Twin, b_pose: &Pose) -> f64 {
    let ((a, p), (b, q)) = ((b, to_generic_pose(b_pose)), (a, to_generic_pose(a_pose)));
    query::contact(&p, &*a.generic, &q, &*b.generic, 100.0).unwrap().unwrap().dist - a.radius - b.radius
}

// ---- closed forms and separating axes against the collision library ----

/// Makes a shape of one kind.
type Maker = fn(&mut Random) -> Twin;

#[test]
fn points_have_the_distance_that_the_general_query_finds() {
    let pairs: [(Maker, Maker); 11] = [
        (sphere, half_space),
        (sphere, sphere),
        (sphere, cuboid),
        (sphere, capsule),
        (sphere, hull),
        (capsule, half_space),
        (capsule, capsule),
        (capsule, cuboid),
        (capsule, hull),
        (cuboid, half_space),
        (hull, half_space),
    ];
    for seed in 0..400 {
        let mut r = Random::new(seed);
        for (first, second) in pairs {
            let (a, b) = (first(&mut r), second(&mut r));
            let (p, q) = (random_pose(&mut r, 0.4), random_pose(&mut r, 0.4));
            let ours = lowest(&touching(&a.shape, &p, &b.shape, &q, 100.0));
            let theirs = generic_gap(&a, &p, &b, &q);
            let what = format!("seed {seed}: {} on {}: {ours} {theirs}", a.name, b.name);
            if a.radius > 0.0 && theirs < -0.04 {
                // An axis that runs through a solid parts from it along an edge, yet touches along the face next to it:
                // the gap of that normal is lower, by the square of the angle of up to 0.1 between them.
                assert!(ours < theirs + ITERATED && ours > theirs - 0.005, "{what}");
            } else {
                assert!((ours - theirs).abs() < ITERATED, "{what}");
            }
        }
    }
}

#[test]
fn overlapping_solids_with_flat_faces_overlap_as_the_general_query_says() {
    let pairs: [(Maker, Maker); 3] = [(cuboid, cuboid), (cuboid, hull), (hull, hull)];
    let mut overlapping = 0;
    for seed in 0..2000 {
        let mut r = Random::new(seed);
        for (first, second) in pairs {
            let (a, b) = (first(&mut r), second(&mut r));
            let (p, q) = (random_pose(&mut r, 0.5), random_pose(&mut r, 0.5));
            let theirs = generic_gap(&a, &p, &b, &q);
            // Of solids that overlap by much, the deepest corner may lie beside the face that they part by.
            if (-0.02..-1e-3).contains(&theirs) {
                overlapping += 1;
                let ours = lowest(&touching(&a.shape, &p, &b.shape, &q, 0.0));
                assert!((ours - theirs).abs() < ITERATED, "seed {seed}: {} on {}: {ours} {theirs}", a.name, b.name);
            }
        }
    }
    assert!(overlapping > 100, "only {overlapping} pairs overlapped");
}

#[test]
fn solids_apart_have_no_point_with_overlap() {
    let mut seen = 0;
    for seed in 0..1000 {
        let mut r = Random::new(seed);
        let (a, b) = if r.chance(0.5) { (cuboid(&mut r), cuboid(&mut r)) } else { (hull(&mut r), cuboid(&mut r)) };
        let (p, q) = (random_pose(&mut r, 0.6), random_pose(&mut r, 0.6));
        let points = touching(&a.shape, &p, &b.shape, &q, 1.0);
        if generic_gap(&a, &p, &b, &q) > ITERATED && !points.is_empty() {
            seen += 1;
            assert!(lowest(&points) > 0.0, "seed {seed}: {points:?}");
        }
    }
    assert!(seen > 100, "only {seen} pairs");
}

// ---- what a point means ----

/// All pairs of kinds, in random places near each other.
fn every_pair(seed: u64) -> Vec<(String, Shape, Pose, Shape, Pose)> {
    let mut r = Random::new(seed);
    let solids = |r: &mut Random| [sphere(r), capsule(r), cuboid(r), hull(r)];
    let mut pairs = Vec::new();
    for a in solids(&mut r) {
        for b in solids(&mut r) {
            let name = format!("{} on {}, seed {seed}", a.name, b.name);
            let (p, q) = (random_pose(&mut r, 0.25), random_pose(&mut r, 0.25));
            pairs.push((name, a.shape.clone(), p, b.shape, q));
        }
        let height = r.between(0.0, 0.3);
        let above = Pose { rotation: r.rotation(), translation: Vec3::new(r.within(1.0), height, r.within(1.0)) };
        let ground = random_pose(&mut r, 1.0);
        let half_space = (format!("{} on half-space, seed {seed}", a.name), a.shape.clone(), ground * above);
        pairs.push((half_space.0, half_space.1, half_space.2, Shape::half_space(), ground));
        let terrain = rolling_ground(&mut r);
        pairs.push((format!("{} on terrain, seed {seed}", a.name), a.shape, ground * above, terrain, ground));
    }
    pairs
}

#[test]
fn moving_everything_moves_the_points_and_keeps_the_gaps() {
    for seed in 0..100 {
        for (name, a, p, b, q) in every_pair(seed) {
            let mut r = Random::new(seed + 1000);
            let shift = random_pose(&mut r, 2.0);
            let before = touching(&a, &p, &b, &q, 0.02);
            let after = touching(&a, &(shift * p), &b, &(shift * q), 0.02);
            assert_eq!(before.len(), after.len(), "{name}");
            for (x, y) in before.iter().zip(&after) {
                assert_eq!(x.feature, y.feature, "{name}");
                assert!((x.gap - y.gap).abs() < ROUNDING, "{name}: {} {}", x.gap, y.gap);
                // Normals and corners are quotients by lengths of down to a hundredth.
                assert!((shift.place(x.point) - y.point).norm() < 100.0 * ROUNDING, "{name}: {x:?} {y:?}");
                assert!((shift.rotation * x.normal - y.normal).norm() < 100.0 * ROUNDING, "{name}: {x:?} {y:?}");
            }
        }
    }
}

#[test]
fn swapping_the_shapes_flips_the_normals() {
    for seed in 0..100 {
        for (name, a, p, b, q) in every_pair(seed) {
            let (ab, ba) = (touching(&a, &p, &b, &q, 0.02), touching(&b, &q, &a, &p, 0.02));
            assert_eq!(ab.len(), ba.len(), "{name}");
            let tolerance = 1e-9;
            for x in &ab {
                let twin = ba.iter().any(|y| {
                    (x.point - y.point).norm() < tolerance
                        && (x.normal + y.normal).norm() < tolerance
                        && (x.gap - y.gap).abs() < tolerance
                });
                assert!(twin, "{name}: {x:?} in {ba:?}");
            }
        }
    }
}

#[test]
fn the_normal_leads_from_the_second_shape_to_the_first() {
    let (ball, ground) = (Shape::sphere(0.1).unwrap(), Shape::half_space());
    let points = touching(&ball, &Pose::at(Vec3::new(0.0, 0.09, 0.0)), &ground, &Pose::IDENTITY, 0.0);
    assert_eq!(points[0].normal, Vec3::y());
    assert!((points[0].gap + 0.01).abs() < ROUNDING && (points[0].point.y + 0.005).abs() < ROUNDING);
}

#[test]
fn lifting_a_shape_along_the_normal_adds_as_much_to_the_gap() {
    let mut compared = 0;
    for seed in 0..200 {
        for (name, a, p, b, q) in every_pair(seed) {
            let before = touching(&a, &p, &b, &q, 0.01);
            let Some(normal) = before.first().map(|x| x.normal) else { continue };
            // A lift along one normal is along another only where all points share it.
            if before.iter().any(|x| (x.normal - normal).norm() > 1e-9) || lowest(&before) < -0.05 {
                continue;
            }
            let lift = 1e-5;
            let after = touching(&a, &moved(&p, normal * lift), &b, &q, 1.0);
            for x in &before {
                let Some(y) = after.iter().find(|y| y.feature == x.feature) else {
                    panic!("{name}: {x:?} has gone from {after:?}")
                };
                compared += 1;
                assert!((y.gap - x.gap - lift).abs() < ROUNDING, "{name}: {} {}", x.gap, y.gap);
                assert!((y.point - x.point - normal * (lift / 2.0)).norm() < 100.0 * ROUNDING, "{name}: {x:?} {y:?}");
            }
        }
    }
    assert!(compared > 500, "only {compared} points compared");
}

#[test]
fn features_stay_equal_under_a_small_motion_and_differ_within_a_pair() {
    let (mut kept, mut all) = (0, 0);
    for seed in 0..200 {
        for (name, a, p, b, q) in every_pair(seed) {
            let mut r = Random::new(seed);
            let turn = common::turn(r.unit(), 1e-7);
            let nudged = Pose { rotation: turn * p.rotation, translation: p.translation + r.vector(1e-7) };
            let features = |pose: &Pose| -> Vec<u64> {
                let mut list: Vec<u64> = touching(&a, pose, &b, &q, 0.02).iter().map(|x| x.feature).collect();
                list.sort_unstable();
                list
            };
            let (before, after) = (features(&p), features(&nudged));
            assert!(before.windows(2).all(|w| w[0] != w[1]), "{name}: {before:?}");
            all += 1;
            kept += usize::from(before == after);
        }
    }
    // Points at the edge of the reach or of a face come and go: 1e-7 m of 0.1 m, in a few pairs of many.
    assert!(kept * 1000 >= all * 998, "{kept} of {all}");
}

// ---- boxes ----

#[test]
fn a_box_on_a_half_space_touches_in_four_corners_with_equal_gaps() {
    let block = Shape::cuboid(Vec3::new(0.2, 0.1, 0.3)).unwrap();
    let tilted = Pose { rotation: common::turn(Vec3::new(1.0, 2.0, 3.0), 0.7), translation: Vec3::new(1.0, 2.0, 3.0) };
    let pose = tilted * Pose::at(Vec3::new(0.0, 0.099, 0.0));
    let points = touching(&block, &pose, &Shape::half_space(), &tilted, 0.01);
    assert_eq!(points.len(), 4);
    for p in &points {
        assert!((p.gap + 0.001).abs() < ROUNDING, "{p:?}");
    }
}

#[test]
fn stacked_boxes_touch_in_points_that_span_the_face() {
    let (lower, upper) = (Shape::cuboid(Vec3::new(0.5, 0.2, 0.5)).unwrap(), Vec3::new(0.3, 0.1, 0.4));
    for gap in [-1e-3, -1e-9, -1e-12, 0.0, 1e-12, 1e-9, 1e-3] {
        for seed in 0..50 {
            let mut r = Random::new(seed);
            let ground = random_pose(&mut r, 2.0);
            let yaw = common::turn(Vec3::y(), if seed == 0 { 0.0 } else { r.within(3.0) });
            let on_top = Pose { rotation: yaw, translation: Vec3::new(0.0, 0.3 + gap, 0.0) };
            let top = Shape::cuboid(upper).unwrap();
            let points = touching(&top, &(ground * on_top), &lower, &ground, 0.01);
            assert!(points.len() >= 4, "{} points, seed {seed}", points.len());
            let seen: Vec<Vec3> = points.iter().map(|p| ground.inverse().place(p.point)).collect();
            for (p, x) in points.iter().zip(&seen) {
                assert!((p.gap - gap).abs() < 1e-9 && (x.y - 0.2).abs() < 1e-3, "{p:?}");
                assert!((p.normal - ground.rotation * Vec3::y()).norm() < 1e-6, "{p:?}");
            }
            for k in [0, 2] {
                let (low, high) = seen.iter().fold((0.0_f64, 0.0_f64), |(l, h), x| (l.min(x[k]), h.max(x[k])));
                assert!(low < -0.25 && high > 0.25, "seed {seed}: {seen:?}");
            }
        }
    }
}

#[test]
fn equal_boxes_on_each_other_touch_in_four_points() {
    let block = Shape::cuboid(Vec3::new(0.1, 0.1, 0.1)).unwrap();
    for seed in 0..50 {
        let mut r = Random::new(seed);
        let ground = random_pose(&mut r, 2.0);
        let noise = Pose { rotation: common::turn(r.unit(), r.within(1e-9)), translation: r.vector(1e-9) };
        let on_top = ground * Pose::at(Vec3::new(0.0, 0.2, 0.0)) * noise;
        let points = touching(&block, &on_top, &block, &ground, 0.01);
        assert_eq!(points.len(), 4, "seed {seed}: {points:?}");
    }
}

#[test]
fn crossed_edges_touch_in_the_point_where_they_pass() {
    let bar = Shape::cuboid(Vec3::new(0.5, 0.1, 0.1)).unwrap();
    // Each bar on its edge, one along x and one along z: the edges are 0.1 √2 from the axes.
    let lower = Pose { rotation: common::turn(Vec3::x(), std::f64::consts::FRAC_PI_4), translation: Vec3::zeros() };
    let quarter = common::turn(Vec3::y(), std::f64::consts::FRAC_PI_2);
    let height = 0.2 * 2.0_f64.sqrt() - 0.001;
    let upper = Pose { rotation: quarter * lower.rotation, translation: Vec3::new(0.1, height, 0.2) };
    let points = touching(&bar, &upper, &bar, &lower, 0.01);
    assert_eq!(points.len(), 1);
    assert!((points[0].gap + 0.001).abs() < ROUNDING && (points[0].normal - Vec3::y()).norm() < ROUNDING, "{points:?}");
    assert!((points[0].point - Vec3::new(0.1, height / 2.0, 0.0)).norm() < ROUNDING, "{points:?}");
}

#[test]
fn a_point_is_named_by_the_edges_or_the_face_that_touch() {
    let one = |first: &Shape, first_pose: Pose, second: &Shape, second_pose: Pose| {
        let points = touching(first, &first_pose, second, &second_pose, 0.01);
        points.first().unwrap_or_else(|| panic!("{first_pose:?} {second_pose:?}")).feature
    };
    let quarter = |axis: Vec3, turns: f64| common::turn(axis, turns * std::f64::consts::FRAC_PI_2);
    // Bars that cross on their edges, each turned about its own axis: same place, other edges.
    let bar = Shape::cuboid(Vec3::new(0.5, 0.1, 0.1)).unwrap();
    let lower = |turns: f64| Pose { rotation: quarter(Vec3::x(), turns + 0.5), translation: Vec3::zeros() };
    let upper = |turns: f64| {
        let translation = Vec3::new(0.1, 0.2 * 2.0_f64.sqrt() - 0.001, 0.2);
        Pose { rotation: quarter(Vec3::y(), 1.0) * quarter(Vec3::x(), turns + 0.5), translation }
    };
    let of_edges = one(&bar, upper(0.0), &bar, lower(0.0));
    assert_ne!(of_edges, one(&bar, upper(1.0), &bar, lower(0.0)));
    assert_ne!(of_edges, one(&bar, upper(0.0), &bar, lower(1.0)));
    // A small block on another face of a large one, flat (the face of the first counts) or tilted (that of the large
    // one).
    let (large, small) = (Shape::cuboid(Vec3::repeat(0.5)).unwrap(), Shape::cuboid(Vec3::repeat(0.1)).unwrap());
    let turned = |turns: f64| Pose { rotation: quarter(Vec3::z(), turns), translation: Vec3::zeros() };
    let flat = Pose::at(Vec3::new(0.0, 0.599, 0.0));
    let tilted = Pose { rotation: common::turn(Vec3::new(1.0, 0.0, 0.7), 0.02), ..flat };
    assert_ne!(one(&large, turned(0.0), &small, flat), one(&large, turned(1.0), &small, flat));
    assert_ne!(one(&small, tilted, &large, turned(0.0)), one(&small, tilted, &large, turned(1.0)));
}

#[test]
fn a_ball_about_a_corner_or_an_edge_of_a_solid_overlaps_by_its_radius() {
    let radius = 0.1;
    let ball = Shape::sphere(radius).unwrap();
    let mut r = Random::new(5);
    for _ in 0..300 {
        // Every corner of a tetrahedron is a corner of its hull, every pair of corners an edge.
        let corners: [Vec3; 4] = std::array::from_fn(|_| r.vector(1.0));
        let Ok(solid) = Shape::convex(&corners) else { continue };
        let pairs = (0..4).flat_map(|i| (i..4).map(move |k| [i, k]));
        for center in pairs.map(|[i, k]| corners[i] + (corners[k] - corners[i]) * 0.5) {
            let points = touching(&ball, &Pose::at(center), &solid, &Pose::IDENTITY, 0.01);
            assert!((lowest(&points) + radius).abs() < 1e-9, "{center:?}: {points:?}");
            let outwards = center - corners.iter().sum::<Vec3>() / 4.0;
            let are_right =
                |p: &ContactPoint| (p.normal.norm() - 1.0).abs() < ROUNDING && p.normal.dot(&outwards) > 0.0;
            assert!(points.iter().all(are_right), "{points:?}");
        }
    }
}

#[test]
fn a_hull_with_six_sided_faces_stands_on_all_six_corners() {
    let ring = |y: f64| {
        (0..6)
            .map(move |k| (f64::from(k) * std::f64::consts::FRAC_PI_3).sin_cos())
            .map(move |(s, c)| Vec3::new(0.2 * c, y, 0.2 * s))
    };
    let prism = Shape::convex(&ring(-0.1).chain(ring(0.1)).collect::<Vec<_>>()).unwrap();
    let slab = Shape::cuboid(Vec3::new(1.0, 0.1, 1.0)).unwrap();
    for (below, height) in [(Shape::half_space(), 0.1), (slab, 0.2), (flat_ground(), 0.1)] {
        let points = touching(&prism, &Pose::at(Vec3::new(0.03, height - 0.001, 0.02)), &below, &Pose::IDENTITY, 0.01);
        let corners = ring(0.0).filter(|c| {
            let place = Vec3::new(c.x + 0.03, height - 0.1, c.z + 0.02);
            points.iter().any(|p| (p.point - place).norm() < 1e-3)
        });
        assert_eq!(corners.count(), 6, "{below:?}: {points:?}");
        assert!(points.iter().all(|p| (p.gap + 0.001).abs() < 1e-9), "{below:?}: {points:?}");
    }
}

// ---- capsules ----

#[test]
fn capsules_side_by_side_touch_at_the_ends_of_what_they_share() {
    let rod = Shape::capsule(Vec3::new(-0.3, 0.0, 0.0), Vec3::new(0.3, 0.0, 0.0), 0.05).unwrap();
    let points = touching(&rod, &Pose::at(Vec3::new(0.2, 0.099, 0.0)), &rod, &Pose::IDENTITY, 0.01);
    assert_eq!(points.len(), 2);
    for (p, x) in points.iter().zip([-0.1, 0.3]) {
        assert!((p.gap + 0.001).abs() < ROUNDING && (p.point.x - x).abs() < ROUNDING, "{p:?}");
    }
}

#[test]
fn a_capsule_lying_on_a_box_touches_at_both_ends() {
    let rod = Shape::capsule(Vec3::new(-0.3, 0.0, 0.0), Vec3::new(0.3, 0.0, 0.0), 0.05).unwrap();
    let slab = Shape::cuboid(Vec3::new(1.0, 0.1, 1.0)).unwrap();
    for gap in [-1e-3, -1e-9, 0.0, 1e-9, 1e-3] {
        let points = touching(&rod, &Pose::at(Vec3::new(0.03, 0.15 + gap, 0.02)), &slab, &Pose::IDENTITY, 0.01);
        assert_eq!(points.len(), 2, "{points:?}");
        assert!(points.iter().all(|p| (p.gap - gap).abs() < 1e-9), "{points:?}");
        assert!((points[0].point.x - points[1].point.x).abs() > 0.59, "{points:?}");
    }
}

// ---- height fields ----

#[test]
fn a_flat_height_field_is_a_plane() {
    for seed in 0..200 {
        let mut r = Random::new(seed);
        for twin in [sphere(&mut r), capsule(&mut r), cuboid(&mut r), hull(&mut r)] {
            let ground = random_pose(&mut r, 1.0);
            let turned = Pose { rotation: r.rotation(), translation: Vec3::new(r.within(1.0), 1.0, r.within(1.0)) };
            let lowest_at_one = lowest(&touching(&twin.shape, &turned, &Shape::half_space(), &Pose::IDENTITY, 10.0));
            let gap = r.between(-0.02, 0.005);
            let pose = ground * moved(&turned, Vec3::y() * (gap - lowest_at_one));
            let on_plane = touching(&twin.shape, &pose, &Shape::half_space(), &ground, 0.01);
            let on_field = touching(&twin.shape, &pose, &flat_ground(), &ground, 0.01);
            let what = format!("{} seed {seed}", twin.name);
            assert!((lowest(&on_field) - gap).abs() < 1e-9, "{what}: {} {gap}", lowest(&on_field));
            for p in &on_field {
                assert!((p.normal - ground.rotation * Vec3::y()).norm() < 1e-6, "{what}: {p:?}");
            }
            for p in &on_plane {
                let twin = on_field.iter().any(|q| (p.point - q.point).norm() < 1e-6 && (p.gap - q.gap).abs() < 1e-9);
                assert!(twin, "{what}: {p:?} in {on_field:?}");
            }
        }
    }
}

#[test]
fn rows_run_along_z_and_columns_along_x() {
    // One height of 6, at the last row and the middle column.
    let field = Shape::height_field(2, 3, &[0.0, 0.0, 0.0, 0.0, 6.0, 0.0], 2.0, 1.0).unwrap();
    let ball = Shape::sphere(0.01).unwrap();
    let points = touching(&ball, &Pose::at(Vec3::new(0.0, 6.0, 0.5)), &field, &Pose::IDENTITY, 0.005);
    assert!(!points.is_empty());
    assert!(touching(&ball, &Pose::at(Vec3::new(0.5, 6.0, 0.0)), &field, &Pose::IDENTITY, 0.005).is_empty());
}

#[test]
fn a_sphere_below_a_height_field_is_pushed_up() {
    let ball = Shape::sphere(0.1).unwrap();
    let points = touching(&ball, &Pose::at(Vec3::new(0.1, -0.05, 0.2)), &flat_ground(), &Pose::IDENTITY, 0.01);
    assert!((lowest(&points) + 0.15).abs() < 1e-9, "{points:?}");
}

/// A roof along z, 1 m high at x = 0, falling to 0 at x = ±1; or a tent with its one peak at the origin.
fn roof() -> Shape {
    Shape::height_field(3, 3, &[0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0], 2.0, 2.0).unwrap()
}

fn tent() -> Shape {
    Shape::height_field(3, 3, &[0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0], 2.0, 2.0).unwrap()
}

#[test]
fn the_ridge_of_a_roof_carries_what_lies_across_it() {
    let rod = Shape::capsule(Vec3::new(-0.5, 0.0, 0.0), Vec3::new(0.5, 0.0, 0.0), 0.05).unwrap();
    let block = Shape::cuboid(Vec3::new(0.5, 0.05, 0.2)).unwrap();
    for (shape, corners) in [(rod, vec![0.3]), (block, vec![0.1, 0.5])] {
        let points = touching(&shape, &Pose::at(Vec3::new(0.1, 1.049, 0.3)), &roof(), &Pose::IDENTITY, 0.01);
        assert!(points.len() >= corners.len(), "{points:?}");
        for p in &points {
            assert!((p.gap + 0.001).abs() < ROUNDING && (p.normal - Vec3::y()).norm() < ROUNDING, "{p:?}");
            assert!(p.point.x.abs() < ROUNDING && (p.point.y - 0.9995).abs() < ROUNDING, "{p:?}");
        }
        for z in corners {
            assert!(points.iter().any(|p| (p.point.z - z).abs() < ROUNDING), "{points:?}");
        }
    }
}

#[test]
fn the_peak_of_a_tent_carries_a_plate() {
    let plate = Shape::cuboid(Vec3::new(0.2, 0.05, 0.2)).unwrap();
    let points = touching(&plate, &Pose::at(Vec3::new(0.05, 1.051, 0.05)), &tent(), &Pose::IDENTITY, 0.01);
    assert_eq!(points.len(), 1, "{points:?}");
    assert!((points[0].gap - 0.001).abs() < ROUNDING && (points[0].normal - Vec3::y()).norm() < ROUNDING, "{points:?}");
    let ball = Shape::sphere(0.1).unwrap();
    let points = touching(&ball, &Pose::at(Vec3::new(0.0, 1.099, 0.0)), &tent(), &Pose::IDENTITY, 0.01);
    assert_eq!(points.len(), 1, "{points:?}");
    assert!((points[0].gap + 0.001).abs() < ROUNDING, "{points:?}");
}

#[test]
fn a_peak_at_any_inner_point_of_the_grid_carries_a_plate() {
    let plate = Shape::cuboid(Vec3::new(0.2, 0.05, 0.2)).unwrap();
    let (rows, columns) = (4, 5);
    for (i, j) in (1..rows - 1).flat_map(|i| (1..columns - 1).map(move |j| (i, j))) {
        let mut heights = vec![0.0; rows * columns];
        heights[i * columns + j] = 1.0;
        // A grid point every metre.
        let field = Shape::height_field(rows, columns, &heights, 4.0, 3.0).unwrap();
        let peak = Vec3::new(j as f64 - 2.0, 1.0, i as f64 - 1.5);
        let pose = Pose::at(peak + Vec3::new(0.05, 0.051, 0.07));
        let points = touching(&plate, &pose, &field, &Pose::IDENTITY, 0.01);
        assert_eq!(points.len(), 1, "{i} {j}: {points:?}");
        assert!((points[0].gap - 0.001).abs() < ROUNDING, "{i} {j}: {points:?}");
        assert!((points[0].point - peak - Vec3::y() * 0.0005).norm() < ROUNDING, "{i} {j}: {points:?}");
    }
}

#[test]
fn the_length_of_a_capsule_touches_a_ridge_that_is_not_below_it() {
    let (radius, gap, reach) = (0.1, 0.04, 0.05);
    // Perpendicular to the ridge and to the capsule, which rises to the ridge at 30 degrees and ends just past the
    // nearest point.
    let (along, normal) = (Vec3::new(0.75_f64.sqrt(), 0.5, 0.0), Vec3::new(-0.5, 0.75_f64.sqrt(), 0.0));
    let rod = Shape::capsule(along * -0.3, along * 0.01, radius).unwrap();
    let nearest = Vec3::new(0.0, 1.0, 0.3);
    let points = touching(&rod, &Pose::at(nearest + normal * (radius + gap)), &roof(), &Pose::IDENTITY, reach);
    let of_length = points.iter().filter(|p| (p.gap - gap).abs() < ROUNDING && (p.normal - normal).norm() < ROUNDING);
    let places: Vec<Vec3> = of_length.map(|p| p.point).collect();
    assert_eq!(places.len(), 1, "{points:?}");
    assert!((places[0] - nearest - normal * (gap / 2.0)).norm() < ROUNDING, "{points:?}");
}

#[test]
fn a_ball_in_a_gutter_touches_both_sides() {
    let heights = [1.0, 0.0, 1.0, 1.0, 0.0, 1.0, 1.0, 0.0, 1.0];
    let gutter = Shape::height_field(3, 3, &heights, 2.0, 2.0).unwrap();
    let ball = Shape::sphere(0.1).unwrap();
    let points = touching(&ball, &Pose::at(Vec3::new(0.0, 0.1 * 2.0_f64.sqrt(), 0.3)), &gutter, &Pose::IDENTITY, 0.01);
    assert_eq!(points.len(), 2, "{points:?}");
    for p in &points {
        assert!(p.gap.abs() < ROUNDING && (p.normal.x.abs() - 0.5_f64.sqrt()).abs() < ROUNDING, "{p:?}");
    }
}

// ---- what is no shape ----

#[test]
fn lengths_that_no_solid_has_are_errors() {
    let message = |shape: Result<Shape, _>| shape.map(|_| ()).unwrap_err_text();
    assert_eq!(message(Shape::sphere(-0.1)), "the radius is -0.1 m; expected a finite number above zero");
    assert_eq!(message(Shape::sphere(f64::NAN)), "the radius is NaN m; expected a finite number above zero");
    assert_eq!(
        message(Shape::cuboid(Vec3::new(1.0, 0.0, 1.0))),
        "the half side is 0 m; expected a finite number above zero"
    );
    assert_eq!(
        message(Shape::capsule(Vec3::x(), Vec3::x(), 0.1)),
        "the ends of the capsule are 0 m apart; expected more than zero. hint: use a sphere"
    );
    assert_eq!(
        message(Shape::capsule(Vec3::x(), Vec3::new(0.0, f64::INFINITY, 0.0), 0.1)),
        "end 1 is (0, inf, 0) m; expected finite numbers"
    );
}

#[test]
fn heights_that_fit_no_grid_are_errors() {
    let message = |shape: Result<Shape, _>| shape.map(|_| ()).unwrap_err_text();
    assert_eq!(
        message(Shape::height_field(2, 3, &[0.0; 5], 1.0, 1.0)),
        "a height field of 2 x 3 has 5 heights; expected rows x columns heights, at least 2 x 2"
    );
    assert_eq!(
        message(Shape::height_field(1, 3, &[0.0; 3], 1.0, 1.0)),
        "a height field of 1 x 3 has 3 heights; expected rows x columns heights, at least 2 x 2"
    );
    assert_eq!(
        message(Shape::height_field(2, 2, &[0.0, f64::NAN, 0.0, 0.0], 1.0, 1.0)),
        "height 1 is NaN; expected finite numbers"
    );
    assert_eq!(
        message(Shape::height_field(2, 2, &[0.0; 4], 1.0, 0.0)),
        "the size along z is 0 m; expected a finite number above zero"
    );
}

#[test]
fn points_that_span_no_volume_are_errors() {
    let flat: Vec<Vec3> = (0..20).map(|k| f64::from(k).sin_cos()).map(|(s, c)| Vec3::new(c, 0.5, s)).collect();
    let line: Vec<Vec3> = (0..5).map(|k| Vec3::x() * f64::from(k)).collect();
    for points in [&flat[..], &line[..], &flat[..3], &[], &[Vec3::x(); 6]] {
        let text = Shape::convex(points).map(|_| ()).unwrap_err_text();
        assert!(text.starts_with(&format!("the hull of {} points has a volume of ", points.len())), "{text}");
        assert!(text.ends_with("expected at least four points that are not in one plane"), "{text}");
    }
    let text = Shape::convex(&[Vec3::x(), Vec3::y() * f64::NAN]).map(|_| ()).unwrap_err_text();
    assert_eq!(text, "point 1 is (NaN, NaN, NaN) m; expected finite numbers");
}

/// The text of the error, which must be there.
trait ErrText {
    fn unwrap_err_text(self) -> String;
}

impl<E: std::error::Error> ErrText for Result<(), E> {
    fn unwrap_err_text(self) -> String {
        self.err().unwrap().to_string()
    }
}

// ---- volume, inertia, boxes ----

#[test]
fn hulls_of_any_points_contain_them_and_touch_the_ground_there() {
    for seed in 0..300 {
        let mut r = Random::new(seed);
        // Grids and repeated points are what hull algorithms stumble over.
        let snap = |x: f64| if seed % 3 == 0 { (x * 4.0).round() / 4.0 } else { x };
        let points: Vec<Vec3> = (0..5 + r.below(40)).map(|_| r.vector(1.0).map(snap)).collect();
        let Ok(shape) = Shape::convex(&points) else { continue };
        let pose = Pose { rotation: r.rotation(), translation: Vec3::zeros() };
        let ours = lowest(&touching(&shape, &pose, &Shape::half_space(), &Pose::IDENTITY, 10.0));
        let theirs = points.iter().map(|p| pose.place(*p).y).fold(f64::MAX, f64::min);
        assert!((ours - theirs).abs() < 1e-9, "seed {seed}: {ours} {theirs}");
    }
}

#[test]
fn a_hull_of_a_box_weighs_what_the_box_weighs() {
    let half = Vec3::new(0.1, 0.2, 0.3);
    let corners: Vec<Vec3> =
        (0..8).map(|k| half.component_mul(&Vec3::new(sign(k), sign(k >> 1), sign(k >> 2)))).collect();
    let offset = Vec3::new(1.0, -2.0, 0.5);
    let shifted: Vec<Vec3> = corners.iter().map(|c| c + offset).collect();
    let (block, hull) = (Shape::cuboid(half).unwrap(), Shape::convex(&shifted).unwrap());
    assert!((block.volume().unwrap() - 0.048).abs() < ROUNDING && (hull.volume().unwrap() - 0.048).abs() < ROUNDING);
    let expected = block.inertia(3.0).unwrap().seen_from(&Pose::at(offset));
    assert_same_inertia(&hull.inertia(3.0).unwrap(), &expected);
    let by_hand = Mat3::from_diagonal(&Vec3::new(0.13, 0.10, 0.05));
    assert!((block.inertia(3.0).unwrap().about_center() - by_hand).norm() < ROUNDING);
}

fn sign(bit: usize) -> f64 {
    if bit & 1 == 1 { 1.0 } else { -1.0 }
}

fn assert_same_inertia(a: &Inertia, b: &Inertia) {
    assert!((a.center() - b.center()).norm() < ROUNDING, "{a:?} {b:?}");
    assert!((a.about_center() - b.about_center()).norm() < ROUNDING, "{a:?} {b:?}");
}

#[test]
fn inertias_are_those_of_points_strewn_within() {
    for seed in 0..6 {
        let mut r = Random::new(seed);
        let twin = [sphere, capsule, cuboid, hull][seed as usize % 4](&mut r);
        let (low, high) = twin.shape.bounding(&Pose::IDENTITY).unwrap();
        let speck = Shape::sphere(1e-9).unwrap();
        let draws = 40_000;
        let inside: Vec<Vec3> = (0..draws)
            .map(|_| Vec3::from_fn(|k, _| r.between(low[k], high[k])))
            .filter(|p| lowest(&touching(&speck, &Pose::at(*p), &twin.shape, &Pose::IDENTITY, 10.0)) < 0.0)
            .collect();
        let share = inside.len() as f64 / f64::from(draws);
        let volume = (high - low).product() * share;
        let center = inside.iter().sum::<Vec3>() / inside.len() as f64;
        let about: Mat3 = inside.iter().map(|p| common::point_inertia(p - center)).sum::<Mat3>() / inside.len() as f64;
        let inertia = twin.shape.inertia(1.0).unwrap();
        // Ten thousand points and more: one percent of the size at two standard deviations or less.
        let exact = twin.shape.volume().unwrap();
        assert!((volume / exact - 1.0).abs() < 0.03, "{}: {volume} {exact}", twin.name);
        assert!((center - inertia.center()).norm() < 0.01, "{}", twin.name);
        assert!((about - inertia.about_center()).norm() < 0.03 * about.norm(), "{}: {about} {inertia:?}", twin.name);
    }
}

#[test]
fn endless_shapes_have_no_inertia_and_a_half_space_no_box() {
    let (plane, field) = (Shape::half_space(), flat_ground());
    assert!(plane.volume().is_none() && plane.inertia(1.0).is_none() && plane.bounding(&Pose::IDENTITY).is_none());
    assert!(field.volume().is_none() && field.inertia(1.0).is_none() && field.bounding(&Pose::IDENTITY).is_some());
    assert!(Shape::sphere(1.0).unwrap().inertia(-1.0).is_none());
}

#[test]
fn boxes_around_shapes_are_as_tight_as_half_spaces_find_them() {
    for seed in 0..100 {
        let mut r = Random::new(seed);
        for twin in [sphere(&mut r), capsule(&mut r), cuboid(&mut r), hull(&mut r)] {
            let pose = random_pose(&mut r, 1.0);
            let (low, high) = twin.shape.bounding(&pose).unwrap();
            for k in 0..3 {
                for up in [1.0, -1.0] {
                    // A half-space whose +y looks along ±k, through the origin.
                    let y = Vec3::ith(k, up);
                    let x = Vec3::ith((k + 1) % 3, 1.0);
                    let plane = Pose { rotation: Mat3::from_columns(&[x, y, x.cross(&y)]), translation: Vec3::zeros() };
                    let gap = lowest(&touching(&twin.shape, &pose, &Shape::half_space(), &plane, 10.0));
                    let bound = if up > 0.0 { low[k] } else { -high[k] };
                    assert!((gap - bound).abs() < ROUNDING, "{} seed {seed}: {gap} {bound}", twin.name);
                }
            }
        }
    }
}

// ---- broad phase ----

fn random_boxes(r: &mut Random, count: usize, spread: f64) -> Vec<Option<(Vec3, Vec3)>> {
    (0..count)
        .map(|_| {
            let (low, size) = (r.vector(spread), r.vector(0.5).abs());
            (!r.chance(0.05)).then_some((low, low + size))
        })
        .collect()
}

#[test]
fn the_broad_phase_finds_the_pairs_that_trying_all_finds() {
    for seed in 0..100 {
        let mut r = Random::new(seed);
        let count = r.below(60);
        let boxes = random_boxes(&mut r, count, 1.0);
        let may_touch = |i: usize, j: usize| !(i + j).is_multiple_of(5);
        let mut expected = Vec::new();
        for j in 0..boxes.len() {
            for i in 0..j {
                let overlap = match (boxes[i], boxes[j]) {
                    (Some((a, b)), Some((c, d))) => (0..3).all(|k| a[k] <= d[k] && c[k] <= b[k]),
                    _ => true,
                };
                if overlap && may_touch(i, j) {
                    expected.push((i, j));
                }
            }
        }
        expected.sort_unstable();
        let mut found = vec![(7, 7)];
        candidate_pairs(&boxes, may_touch, &mut found);
        assert_eq!(found, expected, "seed {seed}");
    }
}

#[test]
fn ten_thousand_boxes_along_a_road_need_few_comparisons() {
    let mut r = Random::new(1);
    let boxes: Vec<_> = (0..10_000)
        .map(|_| {
            let low = Vec3::new(r.within(5000.0), r.within(1.0), r.within(5.0));
            Some((low, low + Vec3::repeat(0.5)))
        })
        .collect();
    let asked = std::cell::Cell::new(0);
    let mut out = Vec::new();
    let may_touch = |_: usize, _: usize| {
        asked.set(asked.get() + 1);
        true
    };
    candidate_pairs(&boxes, may_touch, &mut out);
    assert!(asked.get() < 10_000, "{}", asked.get());
}

// ---- the soft law ----

/// Without the rounding off of the published law.
const SHARP: HuntCrossley =
    HuntCrossley { depth_offset: 0.0, depth_slope: 1e9, rate_slope: 1e9, ..HuntCrossley::FALISSE_2022 };

#[test]
fn without_smoothing_and_rate_the_force_is_that_of_hertz() {
    // The numbers of the literature notes: E = 1e6, R = 32 mm gives 2.7 N at 1 mm, 30 N at 5 mm, 84 N at 10 mm.
    for (depth, expected) in [(0.001, 2.7), (0.005, 30.0), (0.010, 84.0)] {
        let (force, friction) = SHARP.force(0.032, depth, 0.0, Vec3::zeros());
        assert!((force - expected).abs() < 0.5 && friction == Vec3::zeros(), "{depth}: {force}");
        let k = 0.5 * 1e4;
        let hertz = 4.0 / 3.0 * k * (0.032_f64 * k).sqrt() * depth.powf(1.5);
        assert!((force / hertz - 1.0).abs() < ROUNDING, "{force} {hertz}");
    }
}

#[test]
fn twice_the_depth_takes_two_to_three_halves_the_force() {
    let force = |depth: f64| SHARP.force(0.05, depth, 0.0, Vec3::zeros()).0;
    assert!((force(0.02) / force(0.01) - 2.0_f64.powf(1.5)).abs() < ROUNDING);
}

#[test]
fn sinking_in_pushes_harder_and_coming_out_less_but_never_pulls() {
    let at = |rate: f64| SHARP.force(0.032, 0.01, rate, Vec3::zeros()).0;
    let still = at(0.0);
    assert!((at(0.1) / still - 1.3).abs() < ROUNDING && (at(-0.1) / still - 0.7).abs() < ROUNDING);
    for set in [SHARP, HuntCrossley::FALISSE_2022, HuntCrossley::WALKER_MODEL, HuntCrossley::SCONE_HUMAN_0914] {
        for rate in [-0.3, -0.34, -0.5, -1.0, -100.0] {
            let (force, _) = set.force(0.032, 0.01, rate, Vec3::x());
            assert!(force >= 0.0, "{rate}: {force}");
        }
    }
}

#[test]
fn no_overlap_no_force() {
    for depth in [0.0, -1e-9, -0.001, -1.0] {
        let (force, friction) = HuntCrossley::MOCO_2D_GAIT.force(0.035, depth, 2.0, Vec3::x());
        assert!(force.abs() <= 0.0 && friction.norm() <= 0.0, "{depth}");
    }
    // The step that the documentation names.
    let (force, _) = HuntCrossley::FALISSE_2022.force(0.032, 1e-12, 0.0, Vec3::zeros());
    assert!((force - 7.5).abs() < 0.05, "{force}");
}

#[test]
fn the_published_law_acts_before_the_surfaces_meet() {
    // Simbody's `SmoothSphereHalfSpaceForceImpl::calcForce`, evaluated by hand: depth -2 mm, sinking at 0.1 m/s, slip
    // 0.05 m/s.
    let law = HuntCrossley { onset: Onset::Published, ..HuntCrossley::MOCO_2D_GAIT };
    let k = 0.5 * 3_067_776.0_f64.powf(2.0 / 3.0);
    let hertz = 4.0 / 3.0 * k * (0.035 * k).sqrt() * (4e-6_f64 + 1e-5).sqrt().powf(1.5);
    let smooth = hertz * (0.5 + 0.5 * (-0.6_f64).tanh());
    let normal = smooth * 1.3 * (0.5 + 0.5 * (50.0_f64 * (0.1 + 1.0 / 3.0)).tanh());
    let slip = (0.0025_f64 + 1e-5).sqrt();
    let friction = normal * (slip / 0.2 * 0.8 + 0.5 * slip) * 0.05 / slip;
    let found = law.force(0.035, -0.002, 0.1, Vec3::x() * 0.05);
    assert!((found.0 - normal).abs() < 1e-9 && (found.1.x + friction).abs() < 1e-9, "{found:?} {normal} {friction}");
    // It pulls a little while the surfaces part faster than 1/3 m/s.
    let (pull, _) = law.force(0.035, 0.01, -0.36, Vec3::zeros());
    assert!(pull < 0.0 && pull > -0.01 * law.force(0.035, 0.01, 0.0, Vec3::zeros()).0, "{pull}");
}

#[test]
fn friction_opposes_the_slip_and_is_static_at_the_transition_velocity() {
    let set = HuntCrossley { viscous_friction: 0.0, ..HuntCrossley::WALKER_MODEL };
    let direction = Vec3::new(0.6, 0.0, -0.8);
    let coefficient = |v: f64| {
        let (normal, friction) = set.force(0.05, 0.01, 0.0, direction * v);
        assert!((friction.normalize() + direction).norm() < ROUNDING, "{friction}");
        friction.norm() / normal
    };
    assert!((coefficient(0.2) - 0.8).abs() < ROUNDING);
    // Half of v_t: half of 0.4 + 0.8/1.25.
    assert!((coefficient(0.1) - 0.52).abs() < ROUNDING);
    assert!((coefficient(200.0) - 0.4).abs() < 1e-5);
    // With viscosity, what it adds.
    let (normal, friction) = HuntCrossley::WALKER_MODEL.force(0.05, 0.01, 0.0, direction * 0.2);
    assert!((friction.norm() / normal - 0.88).abs() < ROUNDING);
}

#[test]
fn parameters_that_the_law_cannot_have_are_errors() {
    let set = HuntCrossley { transition_velocity: 0.0, ..SHARP };
    let text = set.checked().map(|_| ()).unwrap_err_text();
    assert_eq!(text, "the transition velocity is 0 m/s; expected a finite number, above zero");
    let set = HuntCrossley { stiffness: -1.0, ..SHARP };
    let text = set.checked().map(|_| ()).unwrap_err_text();
    assert_eq!(text, "the stiffness is -1 N/m²; expected a finite number, zero or more");
    assert_eq!(HuntCrossley::SCONE_HUMAN_0914.checked(), Ok(HuntCrossley::SCONE_HUMAN_0914));
}

#[test]
fn slopes_of_the_compliant_force_are_its_differences() {
    let smooth = HuntCrossley { friction_curve: FrictionCurve::Smooth, ..HuntCrossley::MOCO_2D_GAIT };
    let mut random = Random::new(5);
    let published = HuntCrossley { onset: Onset::Published, ..HuntCrossley::MOCO_2D_GAIT };
    for law in [smooth, HuntCrossley::FALISSE_2022, HuntCrossley::SCONE_HUMAN_0914, published] {
        for _ in 0..200 {
            let least = if law.onset == Onset::Published { -0.01 } else { 1e-4 };
            let (depth, rate) = (random.between(least, 0.02), random.within(0.5));
            let slip = Vec3::new(random.within(0.3), 0.0, random.within(0.3));
            let force = |depth: f64, rate: f64, slip: Vec3| {
                let (normal, friction) = law.force(0.03, depth, rate, slip);
                friction + Vec3::y() * normal
            };
            let found = law.force_with_slopes(0.03, depth, rate, slip);
            assert!((found.force - force(depth, rate, slip)).norm() < 1e-9);
            let h = 1e-7;
            let central = |plus: Vec3, minus: Vec3| (plus - minus) / (2.0 * h);
            let pairs = [
                (found.by_depth, central(force(depth + h, rate, slip), force(depth - h, rate, slip))),
                (found.by_rate, central(force(depth, rate + h, slip), force(depth, rate - h, slip))),
                (
                    found.by_slip[0],
                    central(force(depth, rate, slip + Vec3::x() * h), force(depth, rate, slip - Vec3::x() * h)),
                ),
                (
                    found.by_slip[1],
                    central(force(depth, rate, slip + Vec3::z() * h), force(depth, rate, slip - Vec3::z() * h)),
                ),
            ];
            for (slope, difference) in pairs {
                let size = difference.norm().max(1.0);
                assert!(
                    (slope - difference).norm() < 1e-5 * size,
                    "{law:?} at {depth} m, {rate} m/s, {slip:?}: {slope:?}, {difference:?}"
                );
            }
        }
    }
}

#[test]
fn a_capsule_beside_an_edge_of_a_box_touches_it_at_both_ends() {
    let rod = Shape::capsule(Vec3::new(-0.3, 0.0, 0.0), Vec3::new(0.3, 0.0, 0.0), 0.05).unwrap();
    let slab = Shape::cuboid(Vec3::new(1.0, 0.1, 1.0)).unwrap();
    // At 45 degrees above and beside the upper edge at z = 1.
    let away = (0.05 + 0.001) * 0.5_f64.sqrt();
    let points = touching(&rod, &Pose::at(Vec3::new(0.1, 0.1 + away, 1.0 + away)), &slab, &Pose::IDENTITY, 0.01);
    assert_eq!(points.len(), 2, "{points:?}");
    for (p, x) in points.iter().zip([-0.2, 0.4]) {
        assert!((p.gap - 0.001).abs() < 1e-9 && (p.point.x - x).abs() < 1e-9, "{p:?}");
    }
}

/// Stiffness, dissipation, static, dynamic and viscous friction, transition velocity, as in the model files that their
/// documentation names.
#[test]
fn published_laws_have_their_published_parameters() {
    for (law, expected) in [
        (HuntCrossley::FALISSE_2022, [1e6, 2.0, 0.8, 0.8, 0.5, 0.2]),
        (HuntCrossley::MOCO_2D_GAIT, [3_067_776.0, 2.0, 0.8, 0.8, 0.5, 0.2]),
        (HuntCrossley::WALKER_MODEL, [1e6, 1.0, 0.8, 0.4, 0.4, 0.2]),
        (HuntCrossley::SCONE_HUMAN_0914, [2e6, 1.0, 0.9, 0.8, 0.6, 0.1]),
        (HuntCrossley::SOFT_SHOES, [3_067_776.0, 2.0, 0.6, 0.6, 0.0, 0.013]),
    ] {
        let found = [
            law.stiffness,
            law.dissipation,
            law.static_friction,
            law.dynamic_friction,
            law.viscous_friction,
            law.transition_velocity,
        ];
        assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() <= 0.0), "{found:?}, expected {expected:?}");
    }
}
