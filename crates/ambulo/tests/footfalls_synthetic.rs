//! Stances of motions whose contacts are known: a synthetic walk, also on a belt, on a ramp, mirrored, rotated,
//! reversed and cut; standing on two feet and on one; a jump.

use crate::common;
use crate::walks;
use ambulo::analysis::feasibility::Person;
use ambulo::findings::{Code, Findings};
use ambulo::ground::footfalls::{Footfall, Footfalls, footfalls};
use ambulo::ground::phases::contacts_from_force;
use ambulo::kinematics::{Trajectory, each_body_motion};
use ambulo::model::anatomy::Sole;
use ambulo::model::anthropometry::{Build, ContactSphere, SegmentTable};
use ambulo::model::{BySide, Model, Side};
use ambulo::motion::{Event, EventKind, TimeGrid};
use ambulo::simulation::synthetic::SyntheticWalk;
use ambulo::spatial::{Mat3, Pose, Vec3};

const MAN: Build = Build { table: SegmentTable::DeLevaMale, mass: 75.0, height: 1.75, toe_joint: true };

/// A model with its motion and soles.
#[derive(Clone)]
struct Moving {
    model: Model,
    soles: BySide<Option<Sole>>,
    grid: TimeGrid,
    columns: Vec<[Vec<f64>; 3]>,
}

impl Moving {
    fn new(model: &Model, soles: BySide<Option<Sole>>, trajectory: &Trajectory) -> Moving {
        let of = |id| [trajectory.values(id), trajectory.rates(id), trajectory.accelerations(id)].map(<[f64]>::to_vec);
        let columns = model.coordinate_ids().map(of).collect();
        Moving { model: model.clone(), soles, grid: trajectory.grid(), columns }
    }

    /// A person standing still for a while.
    fn standing(seconds: f64) -> Moving {
        let human = MAN.human().unwrap();
        let grid = TimeGrid { start_s: 0.0, step_s: 0.01, frames: (100.0 * seconds) as usize };
        let hold = |value: f64| [vec![value; grid.frames], vec![0.0; grid.frames], vec![0.0; grid.frames]];
        let columns = human.model.coordinates().iter().map(|c| hold(c.default_value)).collect();
        Moving { soles: Person::of_human(&human).soles, model: human.model, grid, columns }
    }

    fn footfalls(&self) -> Footfalls {
        let trajectory = Trajectory::new(&self.model, self.grid, self.columns.clone()).unwrap();
        footfalls(&self.model, &trajectory, &self.soles, &mut Findings::default())
    }

    fn column(&mut self, name: &str) -> &mut [Vec<f64>; 3] {
        let id = self.model.coordinate(name).unwrap();
        &mut self.columns[id.index()]
    }

    /// The motion relative to a belt that has moved back by `way`, at `speed` [m, m/s], functions of time.
    fn on_belt(mut self, way: impl Fn(f64) -> f64, speed: impl Fn(f64) -> f64) -> Moving {
        let grid = self.grid;
        let forward = self.column("pelvis_tx");
        for frame in 0..grid.frames {
            forward[0][frame] -= way(grid.time(frame));
            forward[1][frame] -= speed(grid.time(frame));
        }
        self
    }

    /// The body rotated in the world; gravity stays or rotates with it.
    fn turned(mut self, rotation: Mat3, with_gravity: bool) -> Moving {
        let turn = Pose { rotation, translation: Vec3::new(0.3, -0.2, 0.7) };
        let mut bodies = self.model.bodies().to_vec();
        for body in bodies.iter_mut().filter(|body| body.joint.parent.is_none()) {
            body.joint.parent_from_joint = turn * body.joint.parent_from_joint;
        }
        let gravity = if with_gravity { rotation * self.model.gravity() } else { self.model.gravity() };
        let coordinates = self.model.coordinates().to_vec();
        self.model = Model::new("turned", gravity, bodies, coordinates, Vec::new()).unwrap();
        self
    }

    /// A range of the frames.
    fn cut(mut self, frames: std::ops::Range<usize>) -> Moving {
        self.grid = TimeGrid { start_s: self.grid.time(frames.start), frames: frames.len(), ..self.grid };
        for series in self.columns.iter_mut().flatten() {
            *series = series[frames.clone()].to_vec();
        }
        self
    }
}

/// A walk in the sagittal plane that touches the ground at known times.
fn synthetic() -> &'static SyntheticWalk {
    walks::corrected(MAN, 6)
}

fn walk() -> Moving {
    moving(synthetic())
}

fn moving(walk: &SyntheticWalk) -> Moving {
    Moving::new(&walk.human.model, Person::of_human(&walk.human).soles, &walk.trajectory)
}

/// Times at which a foot rises above the floor at height zero [s].
fn rises(walk: &SyntheticWalk, side: Side) -> Vec<f64> {
    let own: Vec<&ContactSphere> = walk.human.soles.iter().filter(|sole| sole.side == side).collect();
    let mut lowest = Vec::new();
    each_body_motion(&walk.human.model, &walk.trajectory, |_, bodies| {
        let low = |sole: &&ContactSphere| bodies[sole.body.index()].pose.place(sole.center).y - sole.radius;
        lowest.push(own.iter().map(low).fold(f64::INFINITY, f64::min));
    });
    let grid = walk.trajectory.grid();
    let pairs = lowest.windows(2).enumerate().filter(|(_, pair)| pair[0] <= 0.0 && pair[1] > 0.0);
    pairs.map(|(i, pair)| grid.time(i) - grid.step_s * pair[0] / (pair[1] - pair[0])).collect()
}

/// Strikes of the forces under the walk, and offs: the foot then is above the floor. Those next to the ends are left
/// out.
///
/// The force of a soft shoe ends earlier, although its sole is still below the floor: it is damped, and zero where the
/// sole rises faster than 1 / (1.5 x 2 s/m) = 0.33 m/s. Toes that carried the body are 10 mm deep then, and need 25 ms
/// more. Detection from motion cannot know that.
fn known(walk: &SyntheticWalk) -> Vec<Event> {
    let mut events = Vec::new();
    for side in Side::BOTH {
        let of_side = |name: &str| Side::of_name(name) == Some(side);
        let loads = walk.loads.iter().filter(|load| of_side(&walk.human.model.bodies()[load.body.index()].name));
        let mut vertical = vec![0.0; walk.loads[0].times.len()];
        loads.for_each(|load| vertical.iter_mut().zip(&load.force).for_each(|(sum, f)| *sum += f.y));
        let free = rises(walk, side);
        for contact in contacts_from_force(&walk.loads[0].times, &vertical) {
            let event = |kind, time_s| Event { side, kind, time_s };
            events.extend(contact.strike_s.map(|t| event(EventKind::Strike, t)));
            let rises = contact.off_s.and_then(|off_s| free.iter().find(|t| (off_s - 0.01..off_s + 0.06).contains(*t)));
            assert_eq!(contact.off_s.is_some(), rises.is_some(), "{contact:?} {free:?}");
            events.extend(rises.map(|t| event(EventKind::Off, *t)));
        }
    }
    let grid = walk.trajectory.grid();
    let inside = grid.start_s + 0.15..grid.end_s() - 0.15;
    events.retain(|e| inside.contains(&e.time_s));
    events
}

/// Largest time between each event and the nearest of its kind [s].
fn farthest(events: &[Event], found: &[Event]) -> f64 {
    let nearest = |e: &Event| {
        let same = found.iter().filter(|f| f.side == e.side && f.kind == e.kind);
        same.map(|f| (f.time_s - e.time_s).abs()).fold(f64::INFINITY, f64::min)
    };
    events.iter().map(nearest).fold(0.0, f64::max)
}

/// Asserts that two lists have the same events to within a time [s].
#[track_caller]
fn assert_same(a: &[Event], b: &[Event], within_s: f64) {
    let far = farthest(a, b).max(farthest(b, a));
    assert!(a.len() == b.len() && far <= within_s, "{} and {} events, {far} s apart: {a:?} {b:?}", a.len(), b.len());
}

#[test]
fn the_contacts_of_synthetic_walks_are_found() {
    contacts_are_found(walks::optimal(MAN, 6));
    contacts_are_found(synthetic());
}

#[track_caller]
fn contacts_are_found(synthetic: &SyntheticWalk) {
    let walk = moving(synthetic);
    let (known, found) = (known(synthetic), walk.footfalls());
    let events = found.events();
    for event in &known {
        println!("{event:?} off by {:.1} ms", 1e3 * farthest(&[*event], &events));
    }
    assert!(known.len() >= 20, "{known:?}");
    // The soft soles touch the ground before and after they are loaded; the limit for force plates is 30 ms.
    assert!(farthest(&known, &events) < 0.03, "{} s", farthest(&known, &events));
    let inside = events.iter().filter(|e| (known[0].time_s - 0.1..walk.grid.end_s() - 0.15).contains(&e.time_s));
    assert!(inside.count() <= known.len() + 1);
    assert!(found.floor_velocity.norm() <= 0.0 && found.falls.iter().all(|f| f.floor_velocity.norm() <= 0.0));
    // The floor of the simulator lies at height zero; soft soles sink by some millimetres.
    assert!(found.falls.iter().all(|f| f.floor_height_m.abs() < 0.02), "{:?}", found.falls);
    // The stances of one foot are not those of the other.
    let swapped: Vec<Event> = known.iter().map(|e| Event { side: other(e.side), ..*e }).collect();
    assert!(farthest(&swapped, &events) > 0.1);
}

fn other(side: Side) -> Side {
    if side == Side::Right { Side::Left } else { Side::Right }
}

#[test]
fn a_belt_changes_no_event_and_its_speed_is_found() {
    let on_floor = walk().footfalls();
    for speed in [0.4, 1.3, 2.0] {
        let on_belt = walk().on_belt(|t| speed * t, |_| speed).footfalls();
        assert_same(&on_floor.events(), &on_belt.events(), 0.004);
        let error = on_belt.floor_velocity - Vec3::new(-speed, 0.0, 0.0);
        println!("{speed} m/s: off by {error:?}");
        assert!(error.norm() < 0.05, "{error:?}");
    }
}

#[test]
fn a_belt_that_changes_its_speed_is_followed() {
    let (on_floor, walk) = (walk().footfalls(), walk());
    let (start, end) = (walk.grid.start_s, walk.grid.end_s());
    let gain = 0.8 / (end - start);
    let speed = |t: f64| 0.6 + gain * (t - start);
    let on_belt = walk.on_belt(|t| 0.6 * (t - start) + 0.5 * gain * (t - start).powi(2), speed).footfalls();
    assert_same(&on_floor.events(), &on_belt.events(), 0.02);
    for fall in &on_belt.falls {
        let middle = 0.5 * (fall.strike_s.unwrap_or(start) + fall.off_s.unwrap_or(end));
        assert!((fall.floor_velocity.x + speed(middle)).abs() < 0.15, "{fall:?}, belt {}", speed(middle));
    }
}

#[test]
fn a_rotated_world_changes_nothing() {
    let straight = walk().footfalls();
    let about = |axis: Vec3, angle: f64| *nalgebra::Rotation3::new(axis * angle).matrix();
    let turned = walk().turned(about(Vec3::y(), 0.9), false).footfalls();
    assert_same(&straight.events(), &turned.events(), 1e-9);
    let lying = walk().turned(about(Vec3::new(0.6, 0.0, 0.8), 1.4), true).footfalls();
    assert_same(&straight.events(), &lying.events(), 1e-9);
    // Heights are relative to the origin, by which the walk was displaced.
    assert!((turned.falls[2].floor_height_m - straight.falls[2].floor_height_m + 0.2).abs() < 1e-9);
}

#[test]
fn a_floor_that_rises_has_a_height_for_each_step() {
    let level = walk().footfalls();
    let slope: f64 = 0.15;
    let up = *nalgebra::Rotation3::new(Vec3::z() * slope).matrix();
    let rising = walk().turned(up, false).footfalls();
    assert_same(&level.events(), &rising.events(), 0.02);
    let heights: Vec<f64> = rising.falls.iter().map(|f| f.floor_height_m).collect();
    println!("{heights:?}");
    // The steps of this walk are 0.7 m long.
    let rise = 0.7 * slope.sin();
    assert!(heights.windows(2).all(|pair| (0.5 * rise..1.5 * rise).contains(&(pair[1] - pair[0]))), "{heights:?}");
    assert!(level.falls.windows(2).all(|pair| (pair[1].floor_height_m - pair[0].floor_height_m).abs() < 0.5 * rise));
}

#[test]
fn a_mirrored_walk_swaps_the_feet() {
    let mut mirrored = walk();
    for (id, coordinate) in mirrored.model.clone().coordinates().iter().enumerate() {
        if let Some(stem) = coordinate.name.strip_suffix("_r") {
            let left = mirrored.model.coordinate(&format!("{stem}_l")).unwrap().index();
            mirrored.columns.swap(id, left);
        }
    }
    let swapped: Vec<Event> = walk().footfalls().events().iter().map(|e| Event { side: other(e.side), ..*e }).collect();
    assert_same(&swapped, &mirrored.footfalls().events(), 1e-9);
}

#[test]
fn in_a_reversed_walk_strikes_and_offs_are_exchanged() {
    let forwards = walk();
    let mut backwards = forwards.clone();
    for [value, rate, acceleration] in &mut backwards.columns {
        value.reverse();
        rate.reverse();
        rate.iter_mut().for_each(|v| *v = -*v);
        acceleration.reverse();
    }
    let turn = |e: &Event| Event {
        side: e.side,
        kind: if e.kind == EventKind::Strike { EventKind::Off } else { EventKind::Strike },
        time_s: forwards.grid.start_s + forwards.grid.end_s() - e.time_s,
    };
    let known: Vec<Event> = known(synthetic()).iter().map(turn).collect();
    let far = farthest(&known, &backwards.footfalls().events());
    println!("backwards: {:.1} ms", 1e3 * far);
    assert!(far < 0.06, "{far} s");
}

#[test]
fn a_stance_that_the_recording_cuts_has_no_event_there() {
    let whole = walk();
    let fall = *whole.footfalls().falls.iter().find(|f| f.strike_s.is_some() && f.off_s.is_some()).unwrap();
    let frame = |t: f64| ((t - whole.grid.start_s) / whole.grid.step_s).round() as usize;
    let middle = frame(0.5 * (fall.strike_s.unwrap() + fall.off_s.unwrap()));
    let after = whole.clone().cut(middle..whole.grid.frames).footfalls();
    assert_eq!(after.of(fall.side).next().unwrap().strike_s, None);
    let before = whole.clone().cut(0..middle).footfalls();
    assert_eq!(before.of(fall.side).last().unwrap().off_s, None);
    // Both parts together have the events of the whole.
    let both = [before.events(), after.events()].concat();
    assert!(farthest(&whole.footfalls().events(), &both) < 0.02);
}

#[test]
fn standing_is_one_stance_over_the_whole_recording() {
    let found = Moving::standing(3.0).footfalls();
    assert_eq!(found.falls.len(), 2, "{found:?}");
    for fall in &found.falls {
        assert_eq!((fall.strike_s, fall.off_s), (None, None));
        assert!(fall.floor_height_m.abs() < 0.005 && fall.floor_velocity.norm() <= 0.0, "{fall:?}");
    }
    assert!(found.events().is_empty());
}

/// Standing with the right knee raised, the body leaning to the left by `lean` [rad].
fn on_one_leg(lean: f64) -> Moving {
    let mut standing = Moving::standing(3.0);
    standing.column("hip_flexion_r")[0].fill(1.0);
    standing.column("knee_angle_r")[0].fill(-1.0);
    standing.turned(*nalgebra::Rotation3::new(-Vec3::x() * lean).matrix(), false)
}

#[test]
fn a_foot_held_still_in_the_air_is_not_in_stance() {
    // Leaning by 0.1 rad brings the left foot under the mass centre; leaning the other way would load the right foot.
    let sides = |lean: f64| on_one_leg(lean).footfalls().falls.iter().map(|f| f.side).collect::<Vec<_>>();
    assert_eq!(sides(0.1), [Side::Left]);
    assert!(sides(-0.1).contains(&Side::Right));
}

#[test]
fn a_jump_has_no_stance_in_flight() {
    let (leaves, lands, gravity) = (1.0, 1.4, 9.80665);
    let mut jump = Moving::standing(3.0);
    let grid = jump.grid;
    let height = jump.column("pelvis_ty");
    for frame in 0..grid.frames {
        let t = grid.time(frame) - leaves;
        if t > 0.0 && t < lands - leaves {
            let speed = 0.5 * gravity * (lands - leaves);
            height[0][frame] += speed * t - 0.5 * gravity * t * t;
            height[1][frame] = speed - gravity * t;
            height[2][frame] = -gravity;
        }
    }
    let found = jump.footfalls();
    assert_eq!(found.falls.len(), 4, "{found:?}");
    for event in found.events() {
        let expected = if event.kind == EventKind::Off { leaves } else { lands };
        // Two frames: the speed changes at once.
        assert!((event.time_s - expected).abs() <= 2.0 * grid.step_s, "{event:?}");
    }
}

#[test]
fn strikes_and_offs_alternate_in_any_motion() {
    for seed in 0..30 {
        let mut random = common::random::Random::new(seed);
        let mut wild = Moving::standing(0.1 + 0.2 * seed as f64);
        let grid = wild.grid;
        for column in &mut wild.columns {
            let (size, omega, phase) = (random.within(0.5), random.between(0.1, 20.0), random.within(3.0));
            for frame in 0..grid.frames {
                let (sine, cosine) = (omega * grid.time(frame) + phase).sin_cos();
                column[0][frame] += size * sine;
                column[1][frame] = size * omega * cosine;
                column[2][frame] = -size * omega * omega * sine;
            }
        }
        let found = wild.footfalls();
        for side in Side::BOTH {
            let ends = |f: &Footfall| [f.strike_s.unwrap_or(grid.start_s), f.off_s.unwrap_or(grid.end_s())];
            let ends: Vec<f64> = found.of(side).flat_map(ends).collect();
            assert!(ends.windows(2).all(|pair| pair[0] <= pair[1]), "seed {seed}: {found:?}");
            assert!(ends.iter().all(|t| (grid.start_s..=grid.end_s()).contains(t)), "seed {seed}: {found:?}");
            assert!(found.of(side).skip(1).all(|f| f.strike_s.is_some()), "seed {seed}: {found:?}");
            let count = found.of(side).count();
            assert!(found.of(side).take(count.saturating_sub(1)).all(|f| f.off_s.is_some()), "seed {seed}: {found:?}");
        }
        assert!(found.falls.iter().all(|f| f.floor_height_m.is_finite() && f.floor_velocity.norm().is_finite()));
    }
}

#[test]
fn recordings_of_a_few_frames_are_accepted() {
    for frames in 1..5 {
        let found = walk().cut(20..20 + frames).footfalls();
        assert!(found.falls.len() <= 2 && found.events().len() <= 1, "{frames}: {found:?}");
    }
}

#[test]
fn a_rotated_world_changes_nothing_on_a_belt() {
    let on_belt = || walk().on_belt(|t| 1.2 * t, |_| 1.2);
    let turn = *nalgebra::Rotation3::new(Vec3::y() * 0.9).matrix();
    let (straight, turned) = (on_belt().footfalls(), on_belt().turned(turn, false).footfalls());
    // The mean shift converges to one velocity from any start, within its tolerance.
    assert_same(&straight.events(), &turned.events(), 1e-3);
    assert!((turned.floor_velocity - turn * straight.floor_velocity).norm() < 1e-2);
}

#[test]
fn a_foot_without_a_sole_is_left_out() {
    let mut walk = walk();
    walk.soles.right = None;
    let found = walk.footfalls();
    assert!(found.of(Side::Right).next().is_none() && found.of(Side::Left).count() >= 6);
    walk.soles.left = None;
    let mut findings = Findings::default();
    let trajectory = Trajectory::new(&walk.model, walk.grid, walk.columns.clone()).unwrap();
    assert!(footfalls(&walk.model, &trajectory, &walk.soles, &mut findings).falls.is_empty());
    assert!(findings.has(Code::FootfallsNone));
}
