//! Walks whose pace changes on the way, simulated: motion without breaks, slip, trunk torque, and the pace that is
//! reached.

use crate::common::assert_near;
use ambulo::analysis::feasibility::Thresholds;
use ambulo::findings::Findings;
use ambulo::gait::{Gait, PaceChange, Walk};
use ambulo::model::anthropometry::{Build, Human, SegmentTable};
use ambulo::simulation::Signal;
use ambulo::simulation::consistent_walk::{ChangingWalk, ConsistentWalkSettings, make_changing_walk};
use ambulo::simulation::synthetic::{SyntheticMode, SyntheticWalk, SyntheticWalkSettings, synthesise};
use std::sync::LazyLock;

const BUILD: Build = Build { table: SegmentTable::DeLevaMale, mass: 75.0, height: 1.75, toe_joint: true };
const STEP_S: f64 = 1e-3;

fn gait(speed: f64, changes: &[(f64, f64)]) -> Gait {
    let mut gait = Gait::named("free").unwrap();
    gait.pace = gait.pace.with(Some(speed), None, None);
    let change =
        |(start_s, speed): &(f64, f64)| PaceChange { start_s: *start_s, speed: Some(*speed), ..PaceChange::default() };
    gait.pace_changes = changes.iter().map(change).collect();
    gait
}

fn changing(human: &Human, gait: &Gait) -> ChangingWalk {
    let walk = Walk::new(gait, human.dimensions.leg_length, &mut Findings::default()).unwrap();
    make_changing_walk(human, &walk, &ConsistentWalkSettings::default()).unwrap()
}

fn synthetic(gait: &Gait, mode: SyntheticMode) -> SyntheticWalk {
    let settings = SyntheticWalkSettings { gait, build: BUILD, mode, cycles: 3, rate_hz: 1000.0 };
    synthesise(&settings, &mut Findings::default()).unwrap()
}

/// From 1.2 to 1.6 m/s at 1 s, to a halt at 2.5 s, and to 0.9 m/s at 6 s.
static THREE: LazyLock<(Human, Walk, ChangingWalk)> = LazyLock::new(|| {
    let (human, gait) = (BUILD.human().unwrap(), gait(1.2, &[(1.0, 1.6), (2.5, 0.0), (6.0, 0.9)]));
    let walk = Walk::new(&gait, human.dimensions.leg_length, &mut Findings::default()).unwrap();
    let changing = changing(&human, &gait);
    (human, walk, changing)
});

/// From 1.2 to 1.6 m/s within two steps, which begin at 2 s.
static FASTER: LazyLock<SyntheticWalk> =
    LazyLock::new(|| synthetic(&gait(1.2, &[(2.0, 1.6)]), SyntheticMode::Corrected));

/// Mean forward speed [m/s] of the pelvis over whole cycles that end at a time [s].
fn mean_speed(walk: &SyntheticWalk, end_s: f64, cycle_s: f64) -> f64 {
    let forward = walk.trajectory.values(walk.human.model.coordinate("pelvis_tx").unwrap());
    let row = |t: f64| (t / STEP_S).round() as usize;
    let (from, to) = (row(end_s - cycle_s), row(end_s));
    (forward[to] - forward[from]) / ((to - from) as f64 * STEP_S)
}

/// The state at the start of a change is that of the walk before, to rounding, and that at its end is that of the walk
/// after; one instant later the walk before is elsewhere.
#[test]
fn a_change_begins_and_ends_in_the_states_of_both_walks() {
    let (human, walk, changing) = &*THREE;
    let forward = human.model.coordinate("pelvis_tx").unwrap().index();
    let read = |t: f64| {
        let mut posture = [(); 3].map(|()| vec![0.0; human.model.coordinates().len()]);
        changing.write(t, &mut posture);
        posture
    };
    let own = |pace: usize, t: f64| {
        let steady = &changing.paces()[pace];
        let mut posture = read(t);
        steady.write(walk.clock(t).phase.value * steady.walk().cycle_s(), &mut posture);
        posture
    };
    let end_s = 1.0 + changing.changes().next().unwrap().problem().duration_s;
    for (pace, t) in [(0, 1.0), (1, end_s - 1e-9)] {
        let (found, expected) = (read(t), own(pace, t));
        for (d, allowed) in [1e-8, 1e-5, 1e-3].into_iter().enumerate() {
            for k in (0..found[d].len()).filter(|k| *k != forward) {
                assert_near(found[d][k], expected[d][k], allowed, &format!("coordinate {k}, derivative {d} at {t} s"));
            }
        }
    }
    let (found, before) = (read(1.5), own(0, 1.5));
    assert!(found[0].iter().zip(&before[0]).any(|(a, b)| (a - b).abs() > 0.02));
}

/// Accelerations have slopes of up to 6e5 rad/s³ (toes), so across 0.2 µs they differ by 0.12 where they are
/// continuous; a break of the correction or of the ramps would be tens of rad/s².
#[test]
fn targets_have_no_break_in_their_accelerations() {
    let (human, _, changing) = &*THREE;
    let signals = changing.signals(human, 0.0, 9.0);
    let coordinates = human.model.coordinates().iter().zip(&signals);
    for (coordinate, signal) in coordinates {
        for i in 1..9000 {
            let t = 1e-3 * f64::from(i);
            let ([x, v, a], [y, w, b]) = (signal.at(t - 1e-7), signal.at(t + 1e-7));
            let name = &coordinate.name;
            assert_near(y - x, 1e-7 * (v + w), 1e-10, &format!("{name} at {t} s"));
            assert_near(w - v, 1e-7 * (a + b), 1e-6, &format!("rate of {name} at {t} s"));
            assert_near(b, a, 0.5, &format!("acceleration of {name} at {t} s"));
        }
    }
}

#[test]
fn a_change_of_speed_within_two_steps_is_reached_with_little_slip() {
    let report = &FASTER.report;
    let change = report.changes[0];
    let end_s = change.start_s + change.duration_s;
    let last_cycle_s = 2.0 / change.step_frequency;
    let reached = mean_speed(&FASTER, end_s + 1.5 * last_cycle_s, last_cycle_s);
    let steady = synthetic(&gait(1.6, &[]), SyntheticMode::Corrected);
    let expected = mean_speed(&steady, 3.0 * last_cycle_s, last_cycle_s);
    let slip = report.slip.unwrap().excursion;
    println!(
        "slip {:.2} mm in the worst stance; {reached:.3} m/s after the change, {expected:.3} m/s in a steady walk",
        1e3 * slip
    );
    assert_near(change.speed, 1.6, 1e-9, "speed asked");
    assert_near(change.start_s, 2.0, 1e-9, "start");
    assert_near(reached, expected, 0.03 * expected, "speed reached");
    assert_near(mean_speed(&FASTER, 2.0, report.cycle_s), 1.2, 0.04, "speed before the change");
    assert!(slip < 3e-3, "{slip} m");
}

#[test]
fn nothing_holds_the_trunk_during_a_change() {
    let human = &FASTER.human;
    let effort = &FASTER.efforts[human.model.coordinate("pelvis_tilt").unwrap().index()];
    let rms = |from_s: f64, to_s: f64| {
        let rows = &effort[(from_s / STEP_S) as usize..(to_s / STEP_S) as usize];
        (rows.iter().map(|x| x * x).sum::<f64>() / rows.len() as f64).sqrt()
    };
    let change = FASTER.report.changes[0];
    let (during, before) = (rms(change.start_s, change.start_s + change.duration_s), rms(0.2, change.start_s));
    println!("trunk torque: {during:.1} N.m rms during the change, {before:.1} before");
    // With the angles of the gait and no plan of the change, it was 54 N.m: the force that accelerates 75 kg by 0.4 m/s
    // turns the body.
    assert!(during < 10.0, "{during}");
    assert!(before < 8.0, "{before}");
}

#[test]
fn the_papers_mode_changes_speed_as_well() {
    let walk = synthetic(&gait(1.2, &[(2.0, 1.6)]), SyntheticMode::Paper);
    let change = walk.report.changes[0];
    let last_cycle_s = 2.0 / change.step_frequency;
    let reached = mean_speed(&walk, change.start_s + change.duration_s + 1.5 * last_cycle_s, last_cycle_s);
    let before = mean_speed(&walk, 2.0, walk.report.cycle_s);
    println!("{before:.3} m/s before, {reached:.3} m/s after");
    assert!(reached > before + 0.3, "{before} and {reached} m/s");
}

#[test]
fn a_figure_comes_to_a_halt_and_stands() {
    let walk = synthetic(&gait(1.0, &[(2.0, 0.0)]), SyntheticMode::Corrected);
    let grid = walk.trajectory.grid();
    let end_s = grid.time(grid.frames - 1);
    assert_near(mean_speed(&walk, end_s, 0.3), 0.0, 0.01, "speed at the end");
    assert!(walk.report.speed_drift < 0.01, "an asked change is not a drift: {} m/s", walk.report.speed_drift);
    let weight: f64 = walk.loads.iter().map(|load| load.force[load.force.len() - 1].y).sum();
    assert_near(weight, 75.0 * 9.80665, 0.05 * 75.0 * 9.80665, "force under both feet");
}

/// Without a given duration, a halt from any phase takes 3 to 6 steps. The figure still walks a fifth of a cycle after
/// the start, because a swing that begins earlier changes nothing, and it stands before the end.
#[test]
fn a_halt_ends_with_a_swing_from_any_phase() {
    let human = BUILD.human().unwrap();
    for k in 0..40 {
        let start_s = 2.0 + 0.03 * f64::from(k);
        let gait = gait(1.2, &[(start_s, 0.0)]);
        let walk = Walk::new(&gait, human.dimensions.leg_length, &mut Findings::default()).unwrap();
        let ramp = &walk.pace_ramps()[0];
        let steps = 2.0 * ramp.duration_s / walk.cycle_s();
        assert!((3.0..6.0).contains(&steps), "{steps} steps from {start_s} s");
        let share = |since: f64| walk.clock(start_s + since * ramp.duration_s).walking.value;
        let turned =
            |since: f64| walk.clock(start_s + since * ramp.duration_s).phase.value - walk.clock(start_s).phase.value;
        let at = |cycles: f64| (0..=1000).map(|i| 1e-3 * f64::from(i)).find(|x| turned(*x) >= cycles).unwrap();
        assert!((share(at(0.19)) - 1.0).abs() < 1e-12, "{} from {start_s} s", share(at(0.19)));
        assert!(share(0.9).abs() < 1e-12 && share(0.1) > 0.5, "from {start_s} s");
        assert!(turned(1.0) > 0.7 && turned(1.0) < 1.3, "{} cycles from {start_s} s", turned(1.0));
    }
}

/// Changes from different speeds and phases leave no joint's range by more than the limit of the verdict, and nothing
/// at the root. The start to 0.9 m/s from rest is one whose first swing begins within rounding of its start.
#[test]
fn starts_and_halts_need_no_force_from_outside_and_stay_in_range() {
    let human = BUILD.human().unwrap();
    for (from, start_s, to) in [(1.2, 2.2, 0.0), (0.8, 2.8, 0.0), (0.0, 1.0, 0.9)] {
        assert_clean(&changing(&human, &gait(from, &[(start_s, to)])), &human, &[start_s]);
    }
    // Faster, to a halt from the faster walk, and a start after it.
    assert_clean(&THREE.2, &THREE.0, &[1.0, 2.5, 6.0]);
}

/// All changes of a walk, which begin at these times [s].
fn assert_clean(changing: &ChangingWalk, human: &Human, starts_s: &[f64]) {
    let slack = Thresholds::default().range_slack_rad;
    assert_eq!(changing.changes().count(), starts_s.len());
    for (solution, start_s) in changing.changes().zip(starts_s) {
        let (rms, largest) = solution.root_forces(10).unwrap();
        let mut over = 0.0_f64;
        for k in 0..=400 {
            let posture =
                changing.posture(&human.model, start_s + solution.problem().duration_s * f64::from(k) / 400.0);
            for (coordinate, value) in human.model.coordinates().iter().zip(&posture[0]) {
                let [low, high] = coordinate.range.unwrap_or([f64::NEG_INFINITY, f64::INFINITY]);
                over = over.max((low - value).max(value - high));
            }
        }
        println!(
            "from {start_s} s: {rms:.4} and {largest:.3} body weights, {:.1} degrees out of range",
            over.to_degrees()
        );
        assert!(rms < 0.001 && largest < 0.02, "from {start_s} s: {rms} and {largest} body weights");
        assert!(over < slack, "from {start_s} s: {} degrees out of range", over.to_degrees());
    }
}

#[test]
fn signals_over_a_span_begin_where_they_are_told() {
    let human = BUILD.human().unwrap();
    let walk = Walk::new(&gait(1.2, &[(1.0, 1.6)]), human.dimensions.leg_length, &mut Findings::default()).unwrap();
    let signals = |start_s: f64| ambulo::simulation::walking::gait_signals(&walk, &human.model, start_s, 3.0).unwrap();
    let knee = human.model.coordinate("knee_angle_r").unwrap().index();
    let of = |signals: &[Signal], t: f64| signals[knee].at(t)[0];
    let (early, late) = (signals(0.0), signals(0.75));
    for i in 0..20 {
        let t = 0.1 * f64::from(i);
        assert_near(of(&late, t), of(&early, t + 0.75), 1e-8, "knee");
    }
}
