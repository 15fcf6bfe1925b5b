//! Measured ground forces against closed forms: known forces on a plate are recovered exactly.

use crate::free_bodies::{DOWN_Y, free_bodies};
use ambulo::findings::{Code, Findings};
use ambulo::ground::{BodyForces, CENTER_OF_PRESSURE_LOAD_N, measured};
use ambulo::kinematics::Trajectory;
use ambulo::model::{BodyId, Model};
use ambulo::motion::filter::{LowPass, low_pass};
use ambulo::motion::{ForceRecording, MotionError, TimeGrid};
use ambulo::spatial::Vec3;
use std::f64::consts::{FRAC_PI_2, PI};

/// Products and sums of numbers up to 1000 N.m, divided by hundreds of newtons.
const ROUNDING: f64 = 1e-11;

const FRAMES: usize = 41;

fn grid() -> TimeGrid {
    TimeGrid { start_s: 0.0, step_s: 0.01, frames: FRAMES }
}

/// Two feet that move independently.
fn feet(gravity: Vec3) -> Model {
    free_bodies(gravity, &[("calcn_r", 35.0), ("calcn_l", 35.0)])
}

/// The feet at rest at these coordinates.
fn held(model: &Model, values: [f64; 12]) -> Trajectory {
    let columns = values.map(|q| [vec![q; FRAMES], vec![0.0; FRAMES], vec![0.0; FRAMES]]).to_vec();
    Trajectory::new(model, grid(), columns).unwrap()
}

fn right(model: &Model) -> BodyId {
    model.body("calcn_r").unwrap()
}

/// A plate sampled at the frames.
fn plate(body: BodyId, at: impl Fn(f64) -> (Vec3, Vec3, Vec3)) -> ForceRecording {
    let times = grid().times();
    let (mut force, mut point, mut moment) = (Vec::new(), Vec::new(), Vec::new());
    for &t in &times {
        let (f, p, m) = at(t);
        force.push(f);
        point.push(p);
        moment.push(m);
    }
    ForceRecording { name: "plate".into(), body, force_frame: None, point_frame: None, times, force, point, moment }
}

fn on_foot(model: &Model, trajectory: &Trajectory, plates: &[ForceRecording], filter: Option<LowPass>) -> BodyForces {
    let mut findings = Findings::default();
    let ground = measured(model, trajectory, plates, filter, &mut findings).unwrap();
    assert!(findings.as_slice().is_empty(), "{:?}", findings.as_slice());
    ground.bodies.iter().find(|b| b.body == right(model)).unwrap().clone()
}

#[track_caller]
fn assert_near(found: Vec3, expected: Vec3, tolerance: f64, what: &str) {
    assert!((found - expected).norm() <= tolerance, "{what}: {found:?} instead of {expected:?}");
}

/// A force that grows and moves on a surface at this height.
fn wandering(height: f64) -> impl Fn(f64) -> (Vec3, Vec3, Vec3) {
    move |t| {
        let force = Vec3::new(80.0 * (9.0 * t).cos(), 500.0 + 300.0 * (7.0 * t).sin(), -40.0 + 50.0 * t);
        let point = Vec3::new(0.4 + 0.5 * t, height, 0.13 - 0.1 * t);
        (force, point, Vec3::new(0.0, 6.0 * (11.0 * t).sin(), 0.0))
    }
}

#[test]
fn a_known_force_on_a_raised_plate_gives_its_point_and_free_moment() {
    let model = feet(DOWN_Y);
    let trajectory = held(&model, [0.0; 12]);
    for height in [-0.0075, 0.0, 0.12, 0.8] {
        let push = wandering(height);
        let foot = on_foot(&model, &trajectory, &[plate(right(&model), &push)], None);
        for (i, t) in grid().times().into_iter().enumerate() {
            let (force, point, moment) = push(t);
            assert_near(foot.force[i], force, 0.0, "force");
            assert_near(foot.moment[i], point.cross(&force) + moment, ROUNDING, "moment about the origin");
            assert_near(foot.center_of_pressure[i], point, ROUNDING, "centre of pressure");
            assert_near(foot.free_moment[i], moment, ROUNDING, "free moment");
        }
    }
}

#[test]
fn the_height_of_the_surface_shifts_the_center_of_pressure_by_the_slope_of_the_force() {
    // The point of application moved along the line of action to the floor: the wrench is the same, the centre is not.
    let model = feet(DOWN_Y);
    let trajectory = held(&model, [0.0; 12]);
    let height = 0.12;
    let raised = plate(right(&model), wandering(height));
    let mut on_floor = raised.clone();
    for (point, force) in on_floor.point.iter_mut().zip(&raised.force) {
        *point -= force * (height / force.y);
    }
    let raised = on_foot(&model, &trajectory, &[raised], None);
    let floor = on_foot(&model, &trajectory, &[on_floor], None);
    let mut largest: f64 = 0.0;
    for i in 0..FRAMES {
        assert_near(raised.moment[i], floor.moment[i], ROUNDING, "moment about the origin");
        let expected = raised.force[i] * (height / raised.force[i].y);
        assert_near(raised.center_of_pressure[i] - floor.center_of_pressure[i], expected, ROUNDING, "shift");
        largest = largest.max(expected.x.abs());
    }
    assert!(largest > 0.01, "the heights make no clear difference: {largest} m");
}

#[test]
fn two_plates_under_one_foot_add_up_and_the_center_is_weighted_by_load() {
    let model = feet(DOWN_Y);
    let trajectory = held(&model, [0.0; 12]);
    let (heel, toe) = (Vec3::new(0.2, 0.0, 0.1), Vec3::new(0.45, 0.0, 0.12));
    let share = |t: f64| 0.5 - 0.4 * (PI * t / 0.4).cos();
    let back = plate(right(&model), |t| (Vec3::new(-20.0, 700.0 * (1.0 - share(t)), 5.0), heel, Vec3::zeros()));
    let front = plate(right(&model), |t| (Vec3::new(60.0, 700.0 * share(t), -8.0), toe, Vec3::new(0.0, 3.0, 0.0)));
    let other = plate(model.body("calcn_l").unwrap(), |_| (Vec3::new(0.0, 99.0, 0.0), Vec3::zeros(), Vec3::zeros()));
    let foot = on_foot(&model, &trajectory, &[back, other, front], None);
    for (i, t) in grid().times().into_iter().enumerate() {
        assert_near(foot.force[i], Vec3::new(40.0, 700.0, -3.0), ROUNDING, "sum of the forces");
        let center = heel * (1.0 - share(t)) + toe * share(t);
        assert_near(foot.center_of_pressure[i], center, ROUNDING, "weighted centre");
        // The moment of the horizontal forces about the common centre, and the free moment of the front plate.
        let couple =
            (heel - center).cross(&Vec3::new(-20.0, 0.0, 5.0)) + (toe - center).cross(&Vec3::new(60.0, 0.0, -8.0));
        assert_near(foot.free_moment[i], Vec3::new(0.0, 3.0 + couple.y, 0.0), ROUNDING, "free moment");
    }
}

#[test]
fn a_foot_below_twenty_newtons_has_no_center_of_pressure() {
    let model = feet(DOWN_Y);
    let trajectory = held(&model, [0.0; 12]);
    let force = |t: f64| Vec3::new(0.0, if t < 0.1 { 19.999 } else { CENTER_OF_PRESSURE_LOAD_N }, 3.0);
    let point = Vec3::new(0.3, 0.0, 0.1);
    let foot = on_foot(&model, &trajectory, &[plate(right(&model), |t| (force(t), point, Vec3::zeros()))], None);
    for (i, t) in grid().times().into_iter().enumerate() {
        // The force itself stays: it is small, not absent.
        assert_near(foot.force[i], force(t), 0.0, "force");
        assert_near(foot.moment[i], point.cross(&force(t)), ROUNDING, "moment");
        if force(t).y < CENTER_OF_PRESSURE_LOAD_N {
            assert!(foot.center_of_pressure[i].iter().chain(foot.free_moment[i].iter()).all(|x| x.is_nan()), "{t}");
        } else {
            assert_near(foot.center_of_pressure[i], point, ROUNDING, "centre of pressure");
        }
    }
}

#[test]
fn a_force_in_the_axes_of_a_body_rotates_with_it() {
    let model = feet(DOWN_Y);
    // The foot stands on its heel: its x points up (a quarter turn about z).
    let mut pose = [0.0; 12];
    (pose[2], pose[3], pose[4], pose[5]) = (FRAC_PI_2, 1.0, 0.4, -0.2);
    let trajectory = held(&model, pose);
    let (force, moment) = (Vec3::new(700.0, -30.0, 20.0), Vec3::new(5.0, 0.0, 0.0));
    let point = Vec3::new(1.1, 0.0, -0.15);
    let mut push = plate(right(&model), |_| (force, point, moment));
    push.force_frame = Some(right(&model));
    let foot = on_foot(&model, &trajectory, &[push.clone()], None);
    let (turned, moment) = (Vec3::new(30.0, 700.0, 20.0), Vec3::new(0.0, 5.0, 0.0));
    assert_near(foot.force[3], turned, ROUNDING, "force");
    assert_near(foot.moment[3], point.cross(&turned) + moment, ROUNDING, "moment");
    assert_near(foot.center_of_pressure[3], point, ROUNDING, "centre of pressure");
    assert_near(foot.free_moment[3], moment, ROUNDING, "free moment");
    // Read in the axes of the world, the force is different.
    push.force_frame = None;
    let unturned = on_foot(&model, &trajectory, &[push], None);
    assert!((unturned.force[3] - turned).norm() > 900.0);
}

#[test]
fn a_point_in_the_frame_of_a_moving_body_moves_with_it() {
    let model = feet(DOWN_Y);
    // The right foot slides along x at 1 m/s and turns about y.
    let mut columns = vec![[vec![0.0; FRAMES], vec![0.0; FRAMES], vec![0.0; FRAMES]]; 12];
    columns[1] = [grid().times().iter().map(|t| 2.0 * t).collect(), vec![2.0; FRAMES], vec![0.0; FRAMES]];
    columns[3] = [grid().times(), vec![1.0; FRAMES], vec![0.0; FRAMES]];
    let trajectory = Trajectory::new(&model, grid(), columns).unwrap();
    let (force, in_foot) = (Vec3::new(10.0, 600.0, -5.0), Vec3::new(0.2, 0.0, 0.05));
    let mut push = plate(right(&model), |_| (force, in_foot, Vec3::zeros()));
    push.point_frame = Some(right(&model));
    let foot = on_foot(&model, &trajectory, &[push], None);
    for (i, t) in grid().times().into_iter().enumerate() {
        let (s, c) = (2.0 * t).sin_cos();
        // R_y(2t) in_foot + (t, 0, 0)
        let point = Vec3::new(c * in_foot.x + s * in_foot.z + t, 0.0, -s * in_foot.x + c * in_foot.z);
        assert_near(foot.force[i], force, 0.0, "the force stays in world axes");
        assert_near(foot.center_of_pressure[i], point, ROUNDING, "centre of pressure");
    }
}

#[test]
fn without_a_filter_the_forces_are_unchanged() {
    let model = feet(DOWN_Y);
    let trajectory = held(&model, [0.0; 12]);
    let noisy = |t: f64| {
        let wild = 400.0 + 300.0 * (1e4 * t).sin();
        (Vec3::new(wild / 3.0, wild, -wild / 7.0), Vec3::new(wild / 1e3, 0.0, 0.1), Vec3::zeros())
    };
    let foot = on_foot(&model, &trajectory, &[plate(right(&model), noisy)], None);
    let bits = |v: Vec3| [v.x.to_bits(), v.y.to_bits(), v.z.to_bits()];
    for (i, t) in grid().times().into_iter().enumerate() {
        let (force, point, _) = noisy(t);
        assert_eq!(bits(foot.force[i]), bits(force), "force at {t} s");
        assert_eq!(bits(foot.moment[i]), bits(point.cross(&force)), "moment at {t} s");
    }
    let smooth =
        on_foot(&model, &trajectory, &[plate(right(&model), noisy)], Some(LowPass { order: 3, cutoff_hz: 6.0 }));
    let largest = (0..FRAMES).map(|i| (smooth.force[i] - foot.force[i]).norm()).fold(0.0, f64::max);
    assert!(largest > 100.0, "a filter changes the same numbers by {largest} N only");
}

#[test]
fn the_moment_about_the_origin_is_filtered_not_the_center_of_pressure() {
    // A step from heel to toe while the load jumps: a smoothed point times a smoothed force is another moment.
    let model = feet(DOWN_Y);
    let trajectory = held(&model, [0.0; 12]);
    let early = |t: f64| t < 0.2;
    let push = |t: f64| {
        let force = Vec3::new(0.0, if early(t) { 200.0 } else { 900.0 }, 0.0);
        (force, Vec3::new(if early(t) { 0.1 } else { 0.9 }, 0.0, 0.0), Vec3::zeros())
    };
    let filter = LowPass { order: 3, cutoff_hz: 6.0 };
    let recording = plate(right(&model), push);
    let smoothed = |values: Vec<f64>| low_pass(&values, grid().rate_hz(), filter).unwrap();
    let force = smoothed(recording.force.iter().map(|f| f.y).collect());
    let point = smoothed(recording.point.iter().map(|p| p.x).collect());
    let about_origin = smoothed(recording.point.iter().zip(&recording.force).map(|(p, f)| p.cross(f).z).collect());
    let foot = on_foot(&model, &trajectory, &[recording], Some(filter));
    let mut largest: f64 = 0.0;
    for i in 0..FRAMES {
        assert!((foot.moment[i].z - about_origin[i]).abs() < ROUNDING, "frame {i}");
        assert!((foot.center_of_pressure[i].x - about_origin[i] / force[i]).abs() < ROUNDING, "frame {i}");
        largest = largest.max((point[i] * force[i] - about_origin[i]).abs());
    }
    assert!(largest > 50.0, "the other order differs by {largest} N.m only");
}

#[test]
fn with_gravity_along_minus_z_the_plate_lies_in_x_and_y() {
    let model = feet(Vec3::new(0.0, 0.0, -9.81));
    let trajectory = held(&model, [0.0; 12]);
    let push = |t: f64| {
        let force = Vec3::new(50.0, -30.0, 600.0 + 100.0 * t);
        (force, Vec3::new(0.2 + t, 1.5 - t, 0.3), Vec3::new(0.0, 0.0, 5.0 - 20.0 * t))
    };
    let foot = on_foot(&model, &trajectory, &[plate(right(&model), push)], None);
    for (i, t) in grid().times().into_iter().enumerate() {
        assert_near(foot.center_of_pressure[i], push(t).1, ROUNDING, "centre of pressure");
        assert_near(foot.free_moment[i], push(t).2, ROUNDING, "free moment");
    }
    // With gravity along -y the same force is not a stance: its load along y is negative.
    let model = feet(DOWN_Y);
    let foot = on_foot(&model, &held(&model, [0.0; 12]), &[plate(right(&model), push)], None);
    assert!(foot.center_of_pressure[0].x.is_nan());
}

#[test]
fn a_missing_point_is_no_load_below_twenty_newtons_and_an_error_above() {
    let model = feet(DOWN_Y);
    let trajectory = held(&model, [0.0; 12]);
    let nowhere = Vec3::repeat(f64::NAN);
    let with = |load: f64| {
        let push = plate(right(&model), |t| {
            if t < 0.1 {
                (Vec3::new(0.0, load, 0.0), nowhere, Vec3::zeros())
            } else {
                (Vec3::new(0.0, 600.0, 0.0), Vec3::new(0.3, 0.0, 0.1), Vec3::zeros())
            }
        });
        let mut findings = Findings::default();
        (measured(&model, &trajectory, &[push], None, &mut findings), findings)
    };
    let (ground, findings) = with(12.0);
    let found: Vec<_> = findings.as_slice().iter().map(|f| (f.code, f.count)).collect();
    assert_eq!(found, [(Code::LoadsPointUndefined, 10)]);
    let foot = &ground.unwrap().bodies[0];
    assert_near(foot.force[0], Vec3::zeros(), 0.0, "unloaded");
    assert_near(foot.center_of_pressure[20], Vec3::new(0.3, 0.0, 0.1), ROUNDING, "loaded");
    let (ground, _) = with(300.0);
    assert!(matches!(ground, Err(MotionError::Gap { ref column, .. }) if column == "plate"), "{ground:?}");
}
