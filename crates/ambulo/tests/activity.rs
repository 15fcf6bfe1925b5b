//! Activities: each kind on a puppet whose feet and pelvis the test moves, and on recordings of people.

use crate::footfall_trials::{Recorded, everything};
use crate::shared_data::data;
use ambulo::analysis::activity::{Activity, ActivityKind, activity};
use ambulo::findings::{Code, Findings};
use ambulo::ground::footfalls::footfalls;
use ambulo::job::{FileError, Job};
use ambulo::kinematics::Trajectory;
use ambulo::model::BySide;
use ambulo::model::anthropometry::{Build, Human, SegmentTable};
use ambulo::motion::{Motion, TimeGrid};
use ambulo::study::{self, GroundSettings, Settings, Source};
use std::f64::consts::TAU;
use std::fs;
use std::path::Path;

const STEP_S: f64 = 0.01;
pub(crate) const GRAVITY: f64 = 9.80665;

/// Pelvis and both ankles in the sagittal plane [m], as a function of time: forward and up; heights of the ankles are
/// above those of standing.
pub(crate) type Places = fn(f64) -> [[f64; 2]; 3];

pub(crate) fn man() -> Human {
    Build { table: SegmentTable::DeLevaMale, mass: 72.6, height: 1.80, toe_joint: false }.human().unwrap()
}

/// Coordinates of a man whose hips and ankles are at these places; the soles of right and left foot slope down to the
/// front by the pitches.
fn posture(human: &Human, places: [[f64; 2]; 3], pitches: [f64; 2]) -> Vec<(String, f64)> {
    let d = &human.dimensions;
    let [pelvis, right, left] = places;
    let mut values = vec![("pelvis_tx".to_owned(), pelvis[0]), ("pelvis_ty".to_owned(), pelvis[1])];
    for (letter, ankle, pitch) in [("r", right, pitches[0]), ("l", left, pitches[1])] {
        let [x, y] = [ankle[0] - pelvis[0], ankle[1] + d.ankle_height - pelvis[1]];
        let length = x.hypot(y).min((d.thigh + d.shank) * 0.9999);
        let knee = std::f64::consts::PI - angle(d.thigh, d.shank, length);
        let hip = x.atan2(-y) + angle(d.thigh, length, d.shank);
        values.push((format!("hip_flexion_{letter}"), hip));
        values.push((format!("knee_angle_{letter}"), -knee));
        values.push((format!("ankle_angle_{letter}"), knee - hip - pitch));
    }
    values
}

/// Angle between two sides of a triangle, opposite to the third.
fn angle(a: f64, b: f64, opposite: f64) -> f64 {
    ((a * a + b * b - opposite * opposite) / (2.0 * a * b)).clamp(-1.0, 1.0).acos()
}

/// A motion of some seconds with level feet.
pub(crate) fn moving(human: &Human, places: Places, seconds: f64) -> Trajectory {
    moving_on_soles(human, |t| (places(t), [0.0; 2]), seconds)
}

/// A motion of some seconds, from the places and the pitches of the soles.
pub(crate) fn moving_on_soles(
    human: &Human,
    motion: impl Fn(f64) -> ([[f64; 2]; 3], [f64; 2]),
    seconds: f64,
) -> Trajectory {
    let model = &human.model;
    let frames = (seconds / STEP_S) as usize;
    let value = |t: f64| -> Vec<f64> {
        let (places, pitches) = motion(t);
        let posture = posture(human, places, pitches);
        let of = |name: &str, default| posture.iter().find(|(n, _)| n == name).map_or(default, |(_, value)| *value);
        model.coordinates().iter().map(|c| of(&c.name, c.default_value)).collect()
    };
    let h = 1e-3;
    let mut columns = vec![[const { Vec::new() }; 3]; model.coordinates().len()];
    for frame in 0..frames {
        let t = frame as f64 * STEP_S;
        let [before, now, after] = [value(t - h), value(t), value(t + h)];
        for (c, column) in columns.iter_mut().enumerate() {
            column[0].push(now[c]);
            column[1].push((after[c] - before[c]) / (2.0 * h));
            column[2].push((after[c] - 2.0 * now[c] + before[c]) / (h * h));
        }
    }
    let grid = TimeGrid { start_s: 0.0, step_s: STEP_S, frames };
    Trajectory::new(model, grid, columns).unwrap()
}

/// The activity that is recognised in a motion of some seconds.
fn recognised(places: Places, seconds: f64) -> Activity {
    let human = man();
    let trajectory = moving(&human, places, seconds);
    recognised_in(&human, &trajectory)
}

fn recognised_in(human: &Human, trajectory: &Trajectory) -> Activity {
    let model = &human.model;
    let soles = BySide::from_fn(|side| human.sole(side));
    let falls = footfalls(model, trajectory, &soles, &mut Findings::default());
    activity(model, trajectory, &soles, human.dimensions.leg_length, &falls)
}

#[track_caller]
fn assert_kind(places: Places, seconds: f64, expected: ActivityKind) {
    let found = recognised(places, seconds);
    assert_eq!(found.kind, expected, "{found:?}");
}

/// From 0 to 1 with rest at both ends.
pub(crate) fn smooth(u: f64) -> f64 {
    let u = u.clamp(0.0, 1.0);
    u.powi(3) * (10.0 - 15.0 * u + 6.0 * u * u)
}

/// A foot that steps forward by `stride` and up by `rise` in every `period`, and is on the ground for a share of it.
fn step(t: f64, period: f64, duty: f64, [stride, rise]: [f64; 2]) -> [f64; 2] {
    let cycles = (t / period).floor();
    let u = ((t / period - cycles - duty) / (1.0 - duty)).clamp(0.0, 1.0);
    let lift = 64.0 * (u * (1.0 - u)).powi(3) * 0.15;
    [stride * (cycles + smooth(u)), rise * (cycles + smooth(u)) + lift]
}

/// Pelvis and feet of someone who steps along, each foot half a period after the other.
pub(crate) fn stepping(t: f64, period: f64, duty: f64, change: [f64; 2], height: f64) -> [[f64; 2]; 3] {
    let from = t + 5.0 * period;
    let right = step(from, period, duty, change);
    let behind = step(from - 0.5 * period, period, duty, change);
    let left = [behind[0] + 0.5 * change[0], behind[1] + 0.5 * change[1]];
    // The pelvis is above the ankle in the middle of each stance.
    let along = from / period - 0.5 * duty;
    [[change[0] * along, height + change[1] * along], right, left]
}

#[test]
fn a_man_who_stands_stands() {
    assert_kind(|t| [[0.0, 0.9 + 0.003 * (TAU * 0.3 * t).sin()], [0.0; 2], [0.0; 2]], 3.0, ActivityKind::Stand);
}

#[test]
fn a_part_of_a_stride_is_a_walk_and_its_speed_tells_it_from_standing_and_running() {
    // Half a second of single support: one foot on the ground, the other swings past it.
    let gliding = |speed: f64| {
        let human = man();
        let trajectory = moving_on_soles(
            &human,
            |t| {
                let place = speed * (t - 0.25);
                ([[place, 0.88], [0.0, 0.0], [2.0 * place, 0.06]], [0.0; 2])
            },
            0.5,
        );
        let soles = BySide::from_fn(|side| human.sole(side));
        let falls = footfalls(&human.model, &trajectory, &soles, &mut Findings::default());
        activity(&human.model, &trajectory, &soles, human.dimensions.leg_length, &falls).kind
    };
    assert_eq!(gliding(1.2), ActivityKind::Walk);
    assert_eq!(gliding(0.1), ActivityKind::Stand);
    assert_eq!(gliding(3.0), ActivityKind::Run);
}

fn squat(t: f64) -> [[f64; 2]; 3] {
    let low = 0.5 - 0.5 * (TAU * 0.4 * t).cos();
    [[-0.05 - 0.05 * low, 0.9 - 0.25 * low], [-0.1, 0.0], [-0.1, 0.0]]
}

#[test]
fn bent_knees_with_the_weight_over_the_feet_are_a_squat() {
    assert_kind(squat, 5.0, ActivityKind::Squat);
}

#[test]
fn predicted_forces_of_an_activity_without_validation_are_reported() {
    let standing = |t: f64| [[-0.05, 0.9 + 0.003 * (TAU * 0.3 * t).sin()], [-0.1, 0.0], [-0.1, 0.0]];
    for (places, is_reported) in [(squat as Places, true), (standing, false)] {
        let human = man();
        let trajectory = moving(&human, places, 5.0);
        let columns = human.model.coordinate_ids().map(|id| Some(trajectory.values(id).to_vec())).collect();
        let motion = Motion { origin: "puppet".into(), times: trajectory.grid().times(), columns };
        let mut findings = Findings::default();
        let source = Source::coordinates(human.model, motion);
        study::run(source, &Settings::default(), &mut findings).unwrap();
        assert_eq!(findings.has(Code::PredictionUntested), is_reported, "{:?}", findings.as_slice());
    }
}

#[test]
fn rising_from_a_seat_behind_the_feet_is_sit_to_stand() {
    let rises = |t: f64| {
        let up = smooth((t - 1.0) / 1.5);
        [[-0.45 * (1.0 - up), 0.52 + 0.38 * up], [0.0; 2], [0.0; 2]]
    };
    assert_kind(rises, 3.5, ActivityKind::SitToStand);
}

/// A child of the same shape: lengths are smaller by one factor, times by its root, so that the forces are similar too.
#[test]
fn a_child_does_the_same_as_an_adult() {
    let sits = |t: f64| {
        let up = smooth((t - 1.0) / 1.5);
        [[-0.45 * (1.0 - up), 0.52 + 0.38 * up], [0.0; 2], [0.0; 2]]
    };
    let stands = |t: f64| [[0.0, 0.9 + 0.003 * (TAU * 0.3 * t).sin()], [0.0; 2], [0.0; 2]];
    let kinds: [(Places, ActivityKind); 3] =
        [(stands, ActivityKind::Stand), (squat, ActivityKind::Squat), (sits, ActivityKind::SitToStand)];
    let adult = man();
    let size = 0.6;
    let build = Build {
        table: SegmentTable::DeLevaMale,
        mass: 72.6 * f64::powi(size, 3),
        height: 1.80 * size,
        toe_joint: false,
    };
    let child = build.human().unwrap();
    assert!((child.dimensions.leg_length - size * adult.dimensions.leg_length).abs() < 1e-12);
    for (places, expected) in kinds {
        let small = |t: f64| places(t / size.sqrt()).map(|place| place.map(|x| size * x));
        let trajectory = moving_on_soles(&child, |t| (small(t), [0.0; 2]), 5.0 * size.sqrt());
        let found = recognised_in(&child, &trajectory);
        assert_eq!(found.kind, expected, "{found:?}");
        assert_eq!(recognised(places, 5.0).kind, expected);
    }
}

#[test]
fn a_flight_from_both_feet_is_a_jump() {
    // 0.4 s of flight: up and down by g t²/8 = 0.2 m; before and after it the pelvis follows the same speed smoothly.
    let jump = |t: f64| {
        let s: f64 = t - 1.5;
        let ballistic = 0.9 + 0.5 * GRAVITY * (0.04 - s * s);
        let pelvis = if s.abs() < 0.2 { ballistic } else { 0.9 - 0.2 * pushed(s.abs() - 0.2) };
        let feet = if s.abs() < 0.2 { 0.5 * GRAVITY * (0.04 - s * s) } else { 0.0 };
        [[-0.06, pelvis], [-0.1, feet], [-0.1, feet]]
    };
    assert_kind(jump, 3.0, ActivityKind::Jump);
}

/// Depth of a push-off, in shares of 0.2 m: leaves zero with the speed of the flight and returns to rest.
fn pushed(s: f64) -> f64 {
    let speed = 0.2 * GRAVITY / 0.2;
    let u = s / 0.4;
    if u < 1.0 { speed * 0.4 * u * (1.0 - u).powi(3) } else { 0.0 }
}

#[test]
fn steps_are_walking_or_stairs() {
    assert_kind(|t| stepping(t, 1.1, 0.62, [1.3, 0.0], 0.88), 4.0, ActivityKind::Walk);
    assert_kind(|t| stepping(t, 1.4, 0.65, [0.6, 0.34], 0.8), 5.0, ActivityKind::StairsUp);
    assert_kind(|t| stepping(t, 1.4, 0.65, [0.6, -0.34], 0.8), 5.0, ActivityKind::StairsDown);
}

/// Each foot takes load once, as in a laboratory with two plates, but none of them moves.
#[test]
fn feet_that_only_lose_and_take_load_make_no_walk() {
    // The pelvis sways forward and aside over feet that stand side by side, and each foot is lifted once.
    let shifts = |t: f64| {
        let lift = |at: f64| 0.06 * (1.0 - ((t - at) / 0.25).powi(2)).max(0.0).powi(3);
        let forward = 0.6 * smooth((t - 0.3) / 2.4);
        [[forward - 0.3, 0.84], [0.0, lift(1.0)], [0.0, lift(2.0)]]
    };
    let found = recognised(shifts, 3.0);
    assert_ne!(found.kind, ActivityKind::Walk, "{found:?}");
}

/// A squat, a drop jump and a standing person of three laboratories.
#[test]
fn recordings_without_a_walk_have_their_own_words() {
    let Some(folder) = data() else { return };
    let kulleuven = ["kuleuven-walk-squat/markers_Squat2.trc", "kuleuven-walk-squat/grf_Squat2.mot"];
    let opencap = ["opencap-adult-83kg/DJ2.trc", "opencap-adult-83kg/DJ2_forces.mot"];
    let biomechzoo = ["biomechzoo-HC032A/HC032A01.c3d", ""];
    for ([recording, forces], mass_kg, expected) in [
        (kulleuven, Some(64.6), ActivityKind::Squat),
        (opencap, Some(83.0), ActivityKind::Jump),
        (biomechzoo, None, ActivityKind::Stand),
    ] {
        let mut job = Job::of(folder.join(recording));
        job.forces.table = Some(forces).filter(|forces| !forces.is_empty()).map(|forces| folder.join(forces));
        (job.size.mass_kg, job.size.height_m) = (mass_kg, mass_kg.map(|_| 1.75));
        let mut findings = Findings::default();
        let read = job.read(&mut |path: &Path| fs::read(path).map_err(FileError::from), &mut findings).unwrap();
        let found = read.run(&mut findings).unwrap().activity;
        assert_eq!(found.kind, expected, "{recording}: {found:?}");
    }
}

/// At 4.5 m/s a stance foot does not settle at the speed of the belt in a motion that is low-passed at 6 Hz; of this
/// runner no stance was found.
#[test]
fn fast_running_on_a_belt_is_running() {
    let Some(folder) = data() else { return };
    let runners = folder.join("runners-ufabc");
    for (recording, speed_m_s) in [("RBDS08runT25.c3d", 2.5), ("RBDS08runT45.c3d", 4.5)] {
        let mut job = Job::of(runners.join("RBDS08").join(recording));
        job.standing = Some(runners.join("RBDS08/RBDS08static.trc"));
        job.markers = Some(runners.join("markers.toml").display().to_string());
        (job.size.mass_kg, job.size.height_m) = (Some(67.6), Some(1.80));
        job.settings.ground = GroundSettings::Predicted;
        let mut findings = Findings::default();
        let read = job.read(&mut |path: &Path| fs::read(path).map_err(FileError::from), &mut findings).unwrap();
        let found = read.run(&mut findings).unwrap();
        let belt = found.prediction.unwrap().prediction.footfalls.floor_velocity.norm();
        assert!((belt / speed_m_s - 1.0).abs() < 0.1, "{recording}: the belt moves at {belt} m/s");
        assert_eq!(found.activity.kind, ActivityKind::Run, "{recording}: {:?}", found.activity);
        assert!(found.activity.treadmill && found.activity.steps >= 4, "{recording}: {:?}", found.activity);
        // Its plates, whose centre of pressure is 36 to 59 mm off, do not contradict the clock.
        job.settings.ground = GroundSettings::MeasuredOrPredicted;
        let mut findings = Findings::default();
        let read = job.read(&mut |path: &Path| fs::read(path).map_err(FileError::from), &mut findings).unwrap();
        let measured = read.run(&mut findings).unwrap();
        assert!(measured.prediction.is_none() && !findings.has(Code::MotionClock), "{recording}: {findings:?}");
    }
}

#[test]
fn people_who_walk_turn_and_run_are_recognised() {
    if data().is_none() {
        return;
    }
    let turns = ["HC032A18", "HC002D25"];
    for recorded in everything() {
        let Recorded { name, model, soles, .. } = recorded;
        let trajectory = recorded.trajectory(6.0);
        let falls = footfalls(model, &trajectory, soles, &mut Findings::default());
        let found = activity(model, &trajectory, soles, model.stature().leg_length_m, &falls);
        let expected = match *name {
            "rajagopal-run" => ActivityKind::Run,
            name if turns.iter().any(|turn| name.starts_with(turn)) => ActivityKind::Turn,
            _ => ActivityKind::Walk,
        };
        assert_eq!(found.kind, expected, "{name}: {found:?}");
        let on_belt = ["gait2392", "rajagopal-run"].iter().any(|belt| name.starts_with(belt));
        assert_eq!(found.treadmill, on_belt, "{name}: {found:?}");
        assert_eq!(found.words().ends_with("on a treadmill"), on_belt, "{name}");
    }
}

#[test]
fn a_short_flight_is_no_jump_and_a_body_without_feet_does_something_else() {
    let heels = |t: f64| [[0.0, 0.9 + 0.02 * (TAU * 0.5 * t).sin()], [0.0; 2], [0.0; 2]];
    let found = recognised(heels, 3.0);
    assert_eq!((found.kind, found.steps), (ActivityKind::Stand, 0), "{found:?}");
    let human = man();
    let still = |c: &ambulo::model::Coordinate| [vec![c.default_value; 100], vec![0.0; 100], vec![0.0; 100]];
    let columns = human.model.coordinates().iter().map(still).collect();
    let grid = TimeGrid { start_s: 0.0, step_s: STEP_S, frames: 100 };
    let trajectory = Trajectory::new(&human.model, grid, columns).unwrap();
    let none = BySide { right: None, left: None };
    let falls = footfalls(&human.model, &trajectory, &none, &mut Findings::default());
    let found = activity(&human.model, &trajectory, &none, human.dimensions.leg_length, &falls);
    assert_eq!(found.kind, ActivityKind::Other);
}
