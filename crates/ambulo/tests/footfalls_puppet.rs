//! Stances of a puppet whose feet are placed by the test: stairs, sideways, backwards, on a belt, starting and
//! stopping.
//!
//! The puppet is a trunk and two flat feet that move independently. A foot swings on a quintic from place to place
//! (velocity and acceleration are zero at both ends) and is lifted in between; the trunk follows. The places of the
//! feet are known exactly, the times of the events to a few hundredths of a second, because a quintic starts slowly:
//! after 50 of 400 ms it has covered 2 % of its way.

use ambulo::findings::Findings;
use ambulo::ground::footfalls::{Footfalls, footfalls};
use ambulo::kinematics::Trajectory;
use ambulo::model::anatomy::{Sole, SolePoint};
use ambulo::model::{BySide, Model, Side};
use ambulo::motion::TimeGrid;
use ambulo::spatial::Vec3;

/// Stance before the first swing and after the last [s].
const STILL_S: f64 = 1.0;
const SWING_S: f64 = 0.4;
/// Time from swing to swing of one foot; right and left alternate [s].
const STRIDE_S: f64 = 1.1;
const LIFT_M: f64 = 0.1;

fn model() -> Model {
    let body = |name: &str, mass: f64| {
        let axes = ["rx", "ry", "rz", "tx", "ty", "tz"];
        let coordinates: String = axes.iter().map(|a| format!("<Coordinate name=\"{name}_{a}\"/>")).collect();
        format!(
            "<Body name=\"{name}\"><mass>{mass}</mass><mass_center>0 0 0</mass_center><inertia_xx>1</inertia_xx>\
             <inertia_yy>1</inertia_yy><inertia_zz>1</inertia_zz><inertia_xy>0</inertia_xy><inertia_xz>0</inertia_xz>\
             <inertia_yz>0</inertia_yz><Joint><FreeJoint name=\"{name}_free\"><parent_body>ground</parent_body>\
             <location_in_parent>0 0 0</location_in_parent><orientation_in_parent>0 0 0</orientation_in_parent>\
             <location>0 0 0</location><orientation>0 0 0</orientation>\
             <CoordinateSet><objects>{coordinates}</objects></CoordinateSet></FreeJoint></Joint></Body>\n"
        )
    };
    let text = format!(
        "<?xml version=\"1.0\"?>\n<OpenSimDocument Version=\"30000\">\n<Model name=\"puppet\">\n<gravity>0 -9.80665 \
         0</gravity>\n\
         <BodySet><objects>\n<Body \
         name=\"ground\"><mass>0</mass></Body>\n{}{}{}</objects></BodySet>\n</Model>\n</OpenSimDocument>\n",
        body("trunk", 70.0),
        body("calcn_r", 1.0),
        body("calcn_l", 1.0)
    );
    Model::from_osim(text.as_bytes(), &mut Findings::default()).unwrap()
}

/// Share of the way, its velocity and acceleration, after the share `u` of the time.
fn quintic(u: f64) -> [f64; 3] {
    let u = u.clamp(0.0, 1.0);
    [
        u.powi(3) * (10.0 - 15.0 * u + 6.0 * u * u),
        30.0 * (u * (1.0 - u)).powi(2),
        60.0 * u * (1.0 - u) * (1.0 - 2.0 * u),
    ]
}

/// From a to b in `duration` seconds from `start` on: place, velocity, acceleration.
fn move_to(a: Vec3, b: Vec3, t: f64, start: f64, duration: f64) -> [Vec3; 3] {
    let [s, v, w] = quintic((t - start) / duration);
    [a + (b - a) * s, (b - a) * (v / duration), (b - a) * (w / (duration * duration))]
}

/// Start time of a swing by its number [s].
fn lifts(side: Side, swing: usize) -> f64 {
    STILL_S + STRIDE_S * (swing as f64 + if side == Side::Left { 0.5 } else { 0.0 })
}

/// Position, velocity and acceleration of a foot that steps through these places.
fn foot(side: Side, places: &[Vec3], t: f64) -> [Vec3; 3] {
    let swing = (0..places.len() - 1).rev().find(|&k| t >= lifts(side, k));
    let Some(swing) = swing else { return [places[0], Vec3::zeros(), Vec3::zeros()] };
    let mut moved = move_to(places[swing], places[swing + 1], t, lifts(side, swing), SWING_S);
    let u = ((t - lifts(side, swing)) / SWING_S).clamp(0.0, 1.0);
    // 64 u³ (1 - u)³ rises from 0 to 1 and returns to 0, starting and ending at rest.
    let p = u * (1.0 - u);
    let slope = 1.0 - 2.0 * u;
    moved[0].y += LIFT_M * 64.0 * p.powi(3);
    moved[1].y += LIFT_M * 64.0 * 3.0 * p * p * slope / SWING_S;
    moved[2].y += LIFT_M * 64.0 * (6.0 * p * slope * slope - 6.0 * p * p) / (SWING_S * SWING_S);
    moved
}

/// The feet of a walk through these places of the right and left sole, over a floor that moves with `belt` [m/s].
fn walk(places: [&[Vec3]; 2], belt: Vec3) -> Footfalls {
    let model = model();
    let swings = places[0].len() - 1;
    let end = lifts(Side::Left, swings - 1) + SWING_S + STILL_S;
    let grid = TimeGrid { start_s: 0.0, step_s: 0.01, frames: (100.0 * end) as usize };
    let mut columns = vec![[const { Vec::new() }; 3]; model.coordinates().len()];
    let above = |k: usize| 0.5 * (places[0][k] + places[1][k]) + Vec3::y();
    for frame in 0..grid.frames {
        let t = grid.time(frame);
        let trunk = move_to(above(0), above(swings), t, STILL_S, end - 2.0 * STILL_S);
        let [right, left] =
            [Side::Right, Side::Left].map(|side| foot(side, places[usize::from(side == Side::Left)], t));
        for (body, moved) in [("trunk", trunk), ("calcn_r", right), ("calcn_l", left)] {
            for (axis, name) in ["tx", "ty", "tz"].iter().enumerate() {
                let id = model.coordinate(&format!("{body}_{name}")).unwrap().index();
                columns[id][0].push(moved[0][axis] + belt[axis] * t);
                columns[id][1].push(moved[1][axis] + belt[axis]);
                columns[id][2].push(moved[2][axis]);
            }
        }
    }
    for series in columns.iter_mut().flatten().filter(|series| series.is_empty()) {
        series.resize(grid.frames, 0.0);
    }
    let sole = |body: &str| {
        let body = model.body(body).unwrap();
        let point = |x: f64| SolePoint { body, place: Vec3::new(x, 0.0, 0.0) };
        Sole { points: [point(-0.05), point(0.12), point(0.18)], half_width: 0.05 }
    };
    let soles = BySide { right: Some(sole("calcn_r")), left: Some(sole("calcn_l")) };
    let trajectory = Trajectory::new(&model, grid, columns).unwrap();
    footfalls(&model, &trajectory, &soles, &mut Findings::default())
}

/// Six places of each foot, `step` apart, the left half a step behind.
fn places(step: Vec3) -> [Vec<Vec3>; 2] {
    [Side::Right, Side::Left].map(|side| {
        let from = if side == Side::Left { -0.5 * step + Vec3::z() * -0.1 } else { Vec3::z() * 0.1 };
        (0..6).map(|k| from + step * f64::from(k)).collect()
    })
}

/// Asserts that every stance of the puppet is found, at its time.
#[track_caller]
fn assert_all_found(found: &Footfalls) {
    for side in Side::BOTH {
        let falls: Vec<_> = found.of(side).collect();
        assert_eq!(falls.len(), 6, "{side:?}: {found:?}");
        assert_eq!((falls[0].strike_s, falls[5].off_s), (None, None), "{side:?}: {found:?}");
        for (k, pair) in falls.windows(2).enumerate() {
            let (off, strike) = (pair[0].off_s.unwrap(), pair[1].strike_s.unwrap());
            let lifted = lifts(side, k);
            // A quarter of the swing each: the quintic accelerates slowly.
            assert!((lifted..lifted + 0.25 * SWING_S).contains(&off), "{side:?} {k}: {off} after {lifted}");
            assert!((lifted + 0.65 * SWING_S..lifted + SWING_S).contains(&strike), "{side:?} {k}: {strike}, {lifted}");
        }
    }
}

#[test]
fn all_steps_are_found_in_every_direction() {
    for step in [
        Vec3::new(1.3, 0.0, 0.0),
        Vec3::new(0.5, 0.0, 0.0),
        Vec3::new(0.15, 0.0, 0.0),
        Vec3::zeros(),
        Vec3::new(-0.9, 0.0, 0.0),
        Vec3::new(0.0, 0.0, 0.6),
        Vec3::new(-0.4, 0.0, -0.4),
    ] {
        let [right, left] = places(step);
        let found = walk([&right, &left], Vec3::zeros());
        assert_all_found(&found);
        assert!(
            found.falls.iter().all(|f| f.floor_height_m.abs() < 1e-3 && f.floor_velocity.norm() <= 0.0),
            "{found:?}"
        );
        let belt = Vec3::new(-0.8, 0.0, 0.3);
        let on_belt = walk([&right, &left], belt);
        assert_all_found(&on_belt);
        assert!((on_belt.floor_velocity - belt).norm() < 0.03, "{:?}", on_belt.floor_velocity);
    }
}

#[test]
fn every_stair_has_its_height() {
    for rise in [0.34, -0.34] {
        let [right, left] = places(Vec3::new(0.6, rise, 0.0));
        let found = walk([&right, &left], Vec3::zeros());
        assert_all_found(&found);
        for (side, places) in [(Side::Right, &right), (Side::Left, &left)] {
            for (fall, place) in found.of(side).zip(places) {
                assert!((fall.floor_height_m - place.y).abs() < 5e-3, "{fall:?} at {place:?}");
            }
        }
    }
}

#[test]
fn soles_of_unequal_height_are_on_one_floor() {
    let [right, mut left] = places(Vec3::new(1.2, 0.0, 0.0));
    left.iter_mut().for_each(|place| place.y += 0.02);
    let found = walk([&right, &left], Vec3::zeros());
    assert_all_found(&found);
    assert!(found.falls.iter().all(|f| (f.floor_height_m - 0.01).abs() < 2e-3), "{found:?}");
}
