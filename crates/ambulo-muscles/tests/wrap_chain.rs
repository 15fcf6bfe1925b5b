//! Paths over several surfaces: closed forms, derivatives, and independence from order.

use crate::wrap_closed_forms::{cylinder, pulls, route, slopes, sphere};
use ambulo_body::numerics::Random;
use ambulo_body::spatial::{Pose, Vec3, rotation};
use ambulo_muscles::set::Quadrant;
use ambulo_muscles::wrap::{Contact, PathAnchor, PathRoute, PathSurface, WrapRule};
use std::f64::consts::{PI, TAU};

fn over(surface: PathSurface, x: f64, positive: bool) -> PathSurface {
    PathSurface { pose: Pose::at(Vec3::x() * x), quadrant: Some(Quadrant { axis: 1, positive }), ..surface }
}

#[test]
fn a_belt_over_two_cylinders_has_its_closed_form() {
    // From below the left one over both, four apart, to below the right one: quarter turns and the common tangent.
    let flat = 3.0 + PI / 2.0 + 4.0 + PI / 2.0 + 3.0;
    let ends = [Vec3::new(-1.0, -3.0, 0.0), Vec3::new(5.0, -3.0, 0.0)];
    // Crossing between them, over the left and under the right one: the inner tangent, and thirds of a turn.
    let crossing = 3.0 + TAU / 3.0 + 12.0_f64.sqrt() + TAU / 3.0 + 3.0;
    let diagonal = [ends[0], Vec3::new(5.0, 3.0, 0.0)];
    for (ends, positive, flat) in [(ends, true, flat), (diagonal, false, crossing)] {
        for rise in [0.0, 0.7] {
            let length = |x: f64| {
                let two = [over(cylinder(1.0, 9.0), 0.0, true), over(cylinder(1.0, 9.0), x, positive)];
                let found = route(&[ends[0], ends[1] + Vec3::z() * rise], &two);
                assert_eq!(found.contacts(), [Contact::Touching; 2]);
                found.length()
            };
            assert!((length(4.0) - flat.hypot(rise)).abs() < 1e-13);
            // It must fail for another distance.
            assert!((length(4.001) - flat.hypot(rise)).abs() > 1e-4);
        }
    }
}

/// Surfaces in a row along x, inclined at random, and ends outside.
fn row(random: &mut Random, count: usize) -> ([Vec3; 2], Vec<PathSurface>) {
    let mut vector = || Vec3::from_fn(|_, _| random.normal());
    let mut surfaces = Vec::new();
    for k in 0..count {
        let translation = Vec3::new(0.09 * k as f64, 0.0, 0.0) + vector() * 0.006;
        let pose = Pose { rotation: rotation(&(vector() * 0.3)), translation };
        let shape = if (k + count).is_multiple_of(3) { sphere(0.03) } else { cylinder(0.03, 9.0) };
        surfaces.push(PathSurface { pose, ..shape });
    }
    let ends = [Vec3::new(-0.08, -0.02, 0.0), Vec3::new(0.09 * (count as f64 - 1.0) + 0.08, -0.02, 0.0)];
    (ends.map(|end| end + vector() * 0.02), surfaces)
}

#[test]
fn several_surfaces_give_the_jointly_shortest_path() {
    let mut random = Random::seeded(5);
    for (count, trials) in [(2, 80), (3, 40), (4, 10)] {
        let (mut worst, mut all, mut compared) = (0.0_f64, 0, 0);
        for _ in 0..trials {
            let (ends, surfaces) = row(&mut random, count);
            let found = route(&ends, &surfaces);
            let touched = found.contacts().iter().filter(|contact| **contact == Contact::Touching).count();
            let Some(slopes) = slopes(ends, &surfaces) else { continue };
            if touched < 2 {
                continue;
            }
            let difference = (0..2).map(|k| (slopes[k] + pulls(&found)[k]).norm()).fold(0.0, f64::max);
            compared += 1;
            all += usize::from(touched == count);
            worst = worst.max(difference);
        }
        println!("{count} surfaces: {compared} paths, {all} over all, derivatives within {worst:.1e}");
        assert!(compared > trials / 5 && worst < 1e-9, "{count}: {compared} {worst:e}");
    }
}

/// Straight parts and arcs meet along one tangent at every node.
#[test]
fn a_path_over_several_surfaces_has_no_corner() {
    let mut random = Random::seeded(6);
    let (mut worst, mut compared) = (0.0_f64, 0);
    for _ in 0..100 {
        let (ends, surfaces) = row(&mut random, 3);
        let found = route(&ends, &surfaces);
        for part in found.nodes().windows(4) {
            let [before, from, to, after] = part else { unreachable!() };
            let (Some(_), Some(surface)) = (from.arc, from.surface) else { continue };
            // Shortest between its neighbours over this surface alone.
            let alone = route(&[before.place, after.place], &surfaces[surface..=surface]);
            if let [_, first, last, _] = alone.nodes() {
                // Not where the path takes the longer side of a cylinder, because of another surface.
                if (first.place - from.place).norm() > 1e-3 {
                    continue;
                }
                compared += 1;
                worst = worst.max((first.place - from.place).norm()).max((last.place - to.place).norm());
            }
        }
    }
    println!("{compared} arcs within {worst:.1e} m of the shortest path between their neighbours");
    assert!(compared > 100 && worst < 1e-12, "{compared} {worst:e}");
}

#[test]
fn the_order_of_surfaces_and_of_calls_does_not_matter() {
    let mut random = Random::seeded(7);
    let mut reused = PathRoute::default();
    let mut differing = 0;
    for _ in 0..100 {
        let (ends, surfaces) = row(&mut random, 3);
        let found = route(&ends, &surfaces);
        let back: Vec<PathSurface> = surfaces.iter().rev().copied().collect();
        differing += usize::from((route(&ends, &back).length() - found.length()).abs() > 1e-12);
        let reversed = route(&[ends[1], ends[0]], &surfaces);
        differing += usize::from((reversed.length() - found.length()).abs() > 1e-12);
        // Memory of another path changes nothing.
        let anchors = ends.map(|place| PathAnchor { body: None, place });
        reused.find(WrapRule::Exact, &anchors, &surfaces);
        assert_eq!(reused.nodes(), found.nodes());
    }
    println!("{differing} of 200 paths depend on the order");
    assert_eq!(differing, 0);
}
