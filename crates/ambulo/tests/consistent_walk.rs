//! Dynamically consistent walks: the planned motion, its simulation, and invariances.

use ambulo::findings::Findings;
use ambulo::gait::{Gait, Walk};
use ambulo::kinematics::each_body_motion;
use ambulo::model::Side;
use ambulo::model::anthropometry::{Build, Human, SegmentTable};
use ambulo::optimal::WalkCosts;
use ambulo::simulation::consistent_walk::{ConsistentWalk, ConsistentWalkSettings, make_consistent_walk};
use ambulo::simulation::walking::{GroundContact, Shoes, WalkRecording, Walker, gait_signals};
use ambulo::simulation::{ImpactLaw, StepSettings};
use std::sync::LazyLock;

/// Of the simulator [s].
const STEP_S: f64 = 1e-3;
/// Cycles until the start is forgotten; the one after them is judged.
const CYCLES: f64 = 5.0;

struct Case {
    human: Human,
    walk: Walk,
    consistent: ConsistentWalk,
    recording: WalkRecording,
}

fn human(mass: f64) -> Human {
    let build = Build { table: SegmentTable::DeLevaMale, mass, height: 1.75, toe_joint: true };
    build.human().unwrap_or_else(|e| panic!("{e}"))
}

fn free_walk(human: &Human) -> Walk {
    let gait = Gait::named("free").unwrap_or_else(|e| panic!("{e}"));
    Walk::new(&gait, human.dimensions.leg_length, &mut Findings::default()).unwrap_or_else(|e| panic!("{e}"))
}

fn consistent(human: &Human, walk: &Walk, settings: &ConsistentWalkSettings) -> ConsistentWalk {
    make_consistent_walk(human, walk, settings).unwrap_or_else(|e| panic!("{e}"))
}

/// Fewer splines, for what does not depend on their number.
fn coarse() -> ConsistentWalkSettings {
    let settings = ConsistentWalkSettings::default();
    ConsistentWalkSettings { costs: WalkCosts { knots: 16, per_knot: 2, ..settings.costs }, ..settings }
}

/// Free walking of de Leva's man, 75 kg.
static CASE: LazyLock<Case> = LazyLock::new(|| {
    let human = human(75.0);
    let walk = free_walk(&human);
    let settings = ConsistentWalkSettings::default();
    let consistent = consistent(&human, &walk, &settings);
    let recording = consistent
        .simulate(&human, &settings, STEP_S, CYCLES, &mut Findings::default())
        .unwrap_or_else(|e| panic!("{e}"));
    Case { human, walk, consistent, recording }
});

/// Rows of the last whole cycle.
fn last_cycle(recording: &WalkRecording, walk: &Walk) -> std::ops::Range<usize> {
    let rows = recording.grid().frames;
    rows - (walk.cycle_s() / STEP_S).round() as usize..rows
}

fn rms_and_peak(values: &[f64]) -> (f64, f64) {
    let mean = values.iter().map(|x| x * x).sum::<f64>() / values.len() as f64;
    (mean.sqrt(), values.iter().fold(0.0, |m: f64, x| m.max(x.abs())))
}

fn trunk_torque(recording: &WalkRecording, walk: &Walk) -> (f64, f64) {
    let Some(effort) = recording.effort("pelvis_tilt") else { panic!("no trunk") };
    rms_and_peak(&effort[last_cycle(recording, walk)])
}

#[test]
fn nothing_holds_the_trunk_of_a_simulated_walk() {
    let (rms, peak) = trunk_torque(&CASE.recording, &CASE.walk);
    println!("trunk-holding torque {rms:.2} N.m RMS, {peak:.2} N.m peak");
    assert!(rms < 3.0 && peak < 10.0, "{rms} N.m RMS, {peak} N.m peak");
}

#[test]
fn the_same_curves_unchanged_need_a_hand() {
    let case = &*CASE;
    let settings = ConsistentWalkSettings::default();
    let ground =
        GroundContact { friction: 0.6, shoes: Shoes::HuntCrossley(settings.shoes), impact: ImpactLaw::Coulomb };
    let signals = gait_signals(&case.walk, &case.human.model, 0.0, 1.0).unwrap();
    let walker = Walker::new(&case.human, signals, &ground, case.walk.speed()).unwrap_or_else(|e| panic!("{e}"));
    let steps = StepSettings { step_s: STEP_S, ..StepSettings::default() };
    let recording =
        walker.walk(&steps, CYCLES * case.walk.cycle_s(), &mut Findings::default()).unwrap_or_else(|e| panic!("{e}"));
    let (rms, peak) = trunk_torque(&recording, &case.walk);
    println!("without any change: {rms:.0} N.m RMS, {peak:.0} N.m peak");
    assert!(rms > 20.0 && peak > 60.0, "{rms} N.m RMS, {peak} N.m peak");
}

#[test]
fn feet_carry_the_weight_and_never_fly() {
    let case = &*CASE;
    let rows = last_cycle(&case.recording, &case.walk);
    let weight = case.human.model.mass() * case.human.model.gravity().norm();
    let total = |row: usize| case.recording.feet.iter().map(|foot| foot.force[row]).sum::<ambulo::spatial::Vec3>();
    let mean = rows.clone().map(total).sum::<ambulo::spatial::Vec3>() / (rows.len() as f64 * weight);
    println!("mean force of a cycle: vertical {:.5}, fore-aft {:.5} body weights", mean.y, mean.x);
    assert!((mean.y - 1.0).abs() < 0.005 && mean.x.abs() < 0.01, "{mean:?}");
    assert!(rows.clone().all(|row| !case.recording.flies(row)));
    let least = rows.map(|row| total(row).y / weight).fold(f64::INFINITY, f64::min);
    assert!(least > 0.6, "{least} body weights");
}

#[test]
fn feet_in_stance_stay_in_place() {
    let case = &*CASE;
    let cycle = last_cycle(&case.recording, &case.walk);
    let Some(slip) = case.recording.stance_slip(cycle.start - cycle.len()) else { panic!("no whole stance") };
    println!("a standing sole gets {:.2} mm away, by a way of {:.2} mm", 1e3 * slip.excursion, 1e3 * slip.path);
    assert!(slip.excursion < 2e-3 && slip.path < 3e-3, "{slip:?}");
}

#[test]
fn a_gait_whose_sides_differ_walks_a_whole_cycle_without_a_hand() {
    let human = human(75.0);
    let limp = "base = \"free\"\n[[joint]]\njoint = \"left knee\"\nangle_deg = 8\n[[joint]]\njoint = \"left \
        hip\"\nscale = 0.85\n";
    let gait = Gait::from_toml(limp).unwrap();
    let walk = Walk::new(&gait, human.dimensions.leg_length, &mut Findings::default()).unwrap();
    let settings = ConsistentWalkSettings::default();
    let limping = consistent(&human, &walk, &settings);
    let recording = limping.simulate(&human, &settings, STEP_S, CYCLES, &mut Findings::default()).unwrap();
    let ((rms, peak), rows) = (trunk_torque(&recording, &walk), last_cycle(&recording, &walk));
    let most = |name: &str| {
        let angles = recording.trajectory.values(human.model.coordinate(name).unwrap());
        rows.clone().map(|row| -angles[row].to_degrees()).fold(f64::MIN, f64::max)
    };
    let knees = [most("knee_angle_r"), most("knee_angle_l")];
    println!("a limp: trunk {rms:.2} N.m RMS, {peak:.2} N.m peak; knees bend by {knees:.1?} deg");
    assert!(rms < 5.0 && peak < 30.0, "{rms} N.m RMS, {peak} N.m peak");
    assert!((knees[1] - knees[0]).abs() > 3.0, "{knees:?}");
    let weight = human.model.mass() * human.model.gravity().norm();
    let apart = |row: usize| {
        let [right, left] = [0, 1].map(|side| &recording.feet[side].force);
        (right[row].y - left[row - rows.len() / 2].y).abs() / weight
    };
    let worst = rows.clone().map(apart).fold(0.0, f64::max);
    assert!(worst > 0.05, "sides that mirror each other: {worst} body weights");
}

#[test]
fn cycles_repeat_and_sides_mirror_each_other() {
    let case = &*CASE;
    let last = last_cycle(&case.recording, &case.walk);
    let (period, half) = (last.len(), last.len() / 2);
    let weight = case.human.model.mass() * case.human.model.gravity().norm();
    let vertical = |side: usize, row: usize| case.recording.feet[side].force[row].y / weight;
    for row in last {
        let before = (vertical(0, row) - vertical(0, row - period)).abs();
        let mirrored = (vertical(0, row) - vertical(1, row - half)).abs();
        // Half a step of a millisecond lies between samples of both sides at strikes, where force rises by 20 weights a
        // second.
        assert!(before < 0.03 && mirrored < 0.03, "row {row}: {before}, {mirrored} body weights");
    }
}

#[test]
fn the_plan_and_the_simulation_agree() {
    let case = &*CASE;
    let weight = case.human.model.mass() * case.human.model.gravity().norm();
    let mut off = Vec::new();
    let spheres = Side::BOTH.map(|side| {
        let of_side = case.human.soles.iter().enumerate().filter(move |(_, sole)| sole.side == side);
        of_side.map(|(sphere, _)| sphere).collect::<Vec<_>>()
    });
    for row in last_cycle(&case.recording, &case.walk).step_by(7) {
        let planned = case.consistent.planned(&[case.recording.grid().time(row)]).unwrap_or_else(|e| panic!("{e}"));
        for (foot, spheres) in case.recording.feet.iter().zip(&spheres) {
            let force = planned[0].ground_force(spheres);
            off.push((foot.force[row].y - force.y) / weight);
            off.push((foot.force[row].x - force.x) / weight);
        }
    }
    let (rms, peak) = rms_and_peak(&off);
    println!("plan and simulation: {rms:.4} RMS, {peak:.3} peak, in body weights");
    assert!(rms < 0.02, "{rms}");
}

#[test]
fn ground_forces_explain_the_change_of_momentum() {
    let case = &*CASE;
    let model = &case.human.model;
    let mut worst = 0.0_f64;
    each_body_motion(model, &case.recording.trajectory, |row, bodies| {
        let needed: ambulo::spatial::Vec3 = model
            .bodies()
            .iter()
            .zip(bodies)
            .map(|(body, motion)| (motion.acceleration.linear - model.gravity()) * body.inertia.mass())
            .sum();
        let given: ambulo::spatial::Vec3 = case.recording.feet.iter().map(|foot| foot.force[row]).sum();
        // The first steps settle.
        if row > 100 {
            worst = worst.max((needed - given).norm());
        }
    });
    println!("m (a - g) and the feet's forces differ by up to {worst:.2} N");
    // Impulses of a step of a millisecond are of first order: legs (14 kg each) jerk by up to 100 m/s3.
    assert!(worst < 2.0, "{worst} N");
}

#[test]
fn heavier_people_on_stiffer_shoes_walk_the_same_way() {
    let settings = ConsistentWalkSettings::default();
    let mut stiffer = settings.clone();
    stiffer.shoes.stiffness *= 1.6;
    let (light, heavy) = (human(60.0), human(96.0));
    let (a, b) = (consistent(&light, &free_walk(&light), &settings), consistent(&heavy, &free_walk(&heavy), &stiffer));
    for k in 0..20 {
        let t = 0.05 * f64::from(k);
        let [pa, pb] = [&a, &b].map(|walk| walk.planned(&[t]).unwrap_or_else(|e| panic!("{e}"))[0].forces.clone());
        for (joint, (x, y)) in pa.iter().map(|moment| 1.6 * moment).zip(pb).enumerate() {
            assert!((x - y).abs() < 1e-3 * (1.0 + x.abs()), "force {joint} at {t}: {x} and {y}");
        }
    }
}

#[test]
fn the_same_walk_has_the_same_bits() {
    let settings = coarse();
    let human = human(75.0);
    let walk = free_walk(&human);
    let [a, b] = [0, 1].map(|_| consistent(&human, &walk, &settings));
    let count = human.model.coordinates().len();
    let read = |walk: &ConsistentWalk| {
        let mut posture = [vec![0.0; count], vec![0.0; count], vec![0.0; count]];
        walk.write(0.321, &mut posture);
        posture
    };
    assert_eq!(read(&a), read(&b));
}

#[test]
fn the_motion_is_periodic_and_its_rates_are_its_derivatives() {
    let case = &*CASE;
    let count = case.human.model.coordinates().len();
    let read = |t: f64| {
        let mut posture = [vec![0.0; count], vec![0.0; count], vec![0.0; count]];
        case.consistent.write(t, &mut posture);
        posture
    };
    let forward = case.human.model.coordinate("pelvis_tx").map(|id| id.index());
    let (h, period) = (1e-5, case.walk.cycle_s());
    for k in 0..200 {
        let t = 0.0057 * f64::from(k) + 0.0011;
        let [before, at, after] = [t - h, t, t + h].map(read);
        let later = read(t + period);
        for i in 0..count {
            let rate = (after[0][i] - before[0][i]) / (2.0 * h);
            let acceleration = (after[1][i] - before[1][i]) / (2.0 * h);
            assert!((rate - at[1][i]).abs() < 1e-5 * (1.0 + rate.abs()), "rate {i} at {t}");
            assert!((acceleration - at[2][i]).abs() < 0.02 * (1.0 + acceleration.abs()), "acceleration {i} at {t}");
            let gain = if Some(i) == forward { case.walk.speed() * period } else { 0.0 };
            assert!((later[0][i] - at[0][i] - gain).abs() < 1e-9, "coordinate {i} at {t}");
        }
    }
}
