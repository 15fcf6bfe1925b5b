//! Feasibility of whole motions: a figure at rest with prescribed ground forces, and recordings of people.
//!
//! Recordings are looked for as tests/opensim_parity.rs does; without them their tests report `skipped` and pass.

use crate::activity::{moving, stepping};
use crate::common::assert_near;
use crate::feasibility::{GRAVITY, man};
use crate::shared_data::data;
use ambulo::analysis::activity::ActivityKind;
use ambulo::analysis::feasibility::{
    Check, MotionAndForces, Person, PredictedForces, Thresholds, Verdict, VerdictState, check,
};
use ambulo::analysis::{AnalysisSettings, analyse};
use ambulo::dynamics::{Forces, Workspace, inverse};
use ambulo::findings::Findings;
use ambulo::ground::{BodyForces, GroundForces};
use ambulo::kinematics::{Posture, Trajectory, body_motion};
use ambulo::model::anthropometry::{Build, Human, SegmentTable};
use ambulo::model::{Model, Side, from_osim};
use ambulo::motion::filter::LowPass;
use ambulo::motion::{ForceRecording, Motion, Smoother, TimeGrid, Window, coordinates_from_table, force_recordings};
use ambulo::spatial::Vec3;
use ambulo::study::{self, ForceFilter, LaboratoryFile, MarkerBody, MarkerSource, MeasuredForces, Settings, Source};
use ambulo_formats::external_loads::{ExternalForce, ExternalLoads};
use ambulo_formats::osim::OsimModel;
use ambulo_formats::table::Table;
use std::ops::Range;
use std::path::Path;

// ---- whole motions ----

/// A man at rest with some joints flexed.
fn still(human: &Human, frames: usize, bent: &[(&str, f64)]) -> Trajectory {
    let grid = TimeGrid { start_s: 2.0, step_s: 0.01, frames };
    let value = |name: &str, default: f64| bent.iter().find(|(n, _)| *n == name).map_or(default, |(_, v)| *v);
    let coordinates = human.model.coordinates().iter();
    let columns = coordinates
        .map(|c| [vec![value(&c.name, c.default_value); frames], vec![0.0; frames], vec![0.0; frames]])
        .collect();
    Trajectory::new(&human.model, grid, columns).unwrap()
}

/// A motion whose ground forces were measured whole and were not filtered.
fn measured<'a>(
    model: &'a Model,
    trajectory: &'a Trajectory,
    forces: &'a Forces,
    ground: &'a GroundForces,
    activity: ActivityKind,
) -> MotionAndForces<'a> {
    MotionAndForces {
        model,
        trajectory,
        forces,
        ground,
        device: None,
        predicted: None,
        partly_measured: &[],
        stances: None,
        activity,
        cutoff_hz: None,
        forces_are_predicted: false,
    }
}

/// The verdict on a man who stands for 1 s while `force(frame)` acts on the middle of each foot [N].
fn judged(force: impl Fn(usize, Side) -> Vec3, thresholds: &Thresholds) -> (Verdict, Findings) {
    judged_with(force, thresholds, &[], None)
}

/// The same verdict if a low-pass filter has smoothed forces and motion.
fn judged_at(force: impl Fn(usize, Side) -> Vec3, thresholds: &Thresholds, cutoff_hz: Option<f64>) -> Verdict {
    judged_with(force, thresholds, &[], cutoff_hz).0
}

/// The same with other values of some coordinates.
fn judged_with(
    force: impl Fn(usize, Side) -> Vec3,
    thresholds: &Thresholds,
    moved: &[(&str, f64)],
    cutoff_hz: Option<f64>,
) -> (Verdict, Findings) {
    let human = man();
    let (frames, model) = (101, &human.model);
    let trajectory = still(&human, frames, moved);
    let ground = on_both_feet(&human, frames, force);
    let forces = inverse(&mut Workspace::new(model), &trajectory, &ground.loads());
    let evidence = MotionAndForces { cutoff_hz, ..measured(model, &trajectory, &forces, &ground, ActivityKind::Walk) };
    let mut findings = Findings::default();
    let verdict = check(&evidence, &Person::of_human(&human), thresholds, &mut findings);
    (verdict, findings)
}

/// Ground forces `force(frame, side)` [N] under both feet, level with the mass centre, so that a person at rest is in
/// balance.
fn on_both_feet(human: &Human, frames: usize, force: impl Fn(usize, Side) -> Vec3) -> GroundForces {
    beside_both_feet(human, frames, 0.0, force)
}

/// The same further out than the middle of each foot [m].
fn beside_both_feet(
    human: &Human,
    frames: usize,
    outwards_m: f64,
    force: impl Fn(usize, Side) -> Vec3,
) -> GroundForces {
    let center = mass_center(human);
    let bodies = Side::BOTH.map(|side| {
        let sign = if side == Side::Right { 1.0 } else { -1.0 };
        let at = Vec3::new(center.x, 0.0, sign * (0.5 * human.dimensions.hip_width + outwards_m));
        let forces: Vec<Vec3> = (0..frames).map(|i| force(i, side)).collect();
        let moments: Vec<Vec3> = forces.iter().map(|f| at.cross(f)).collect();
        let body = human.model.body(&format!("calcn_{}", side.letter())).unwrap();
        BodyForces::on_level_ground(body, &forces, &moments, Vec3::y(), 0.0)
    });
    GroundForces { bodies: bodies.into() }
}

fn mass_center(human: &Human) -> Vec3 {
    let q: Vec<f64> = human.model.coordinates().iter().map(|c| c.default_value).collect();
    let rest = vec![0.0; q.len()];
    let bodies = body_motion(&human.model, Posture { q: &q, qd: &rest, qdd: &rest });
    let weighted = human.model.bodies().iter().zip(bodies).map(|(b, m)| m.center * b.inertia.mass());
    weighted.sum::<Vec3>() / human.model.mass()
}

const HALF: f64 = 0.5 * 72.6 * GRAVITY;

#[test]
fn standing_is_feasible_and_the_verdict_has_the_closest_values() {
    let (verdict, findings) = judged(|_, _| Vec3::new(0.0, HALF, 0.0), &Thresholds::default());
    assert!(verdict.state == VerdictState::Feasible && verdict.reasons.is_empty(), "{:?}", verdict);
    assert!(findings.as_slice().is_empty());
    assert_near(verdict.height_m, 1.80, 1e-12, "height");
    let closest: Vec<Check> = verdict.closest.iter().map(|c| c.check).collect();
    // The ground forces of a person who stands do not vary, so there is no ratio of accelerations.
    let compared = |c: &Check| !matches!(c, Check::Flight | Check::Acceleration);
    assert_eq!(closest, Check::ALL.into_iter().filter(compared).collect::<Vec<_>>());
    assert!(verdict.closest.iter().all(|c| c.share <= 1.0));
    let unknown = verdict.not_judged.iter().find(|n| n.check == Check::Strength).unwrap();
    assert!(unknown.why.contains("lumbar_extension") && unknown.why.contains("arm_flex_r"), "{}", unknown.why);
}

#[test]
fn a_motion_is_called_feasible_only_if_nearly_all_of_it_was_judged() {
    // From this frame on the plates measure nothing; 81 frames count, the first and the last 0.1 s do not.
    let off = |from: usize| {
        judged(move |i, _| Vec3::new(0.0, if i < from { HALF } else { 0.0 }, 0.0), &Thresholds::default()).0
    };
    let nearly_all = off(84);
    assert_eq!(nearly_all.state, VerdictState::Feasible, "{nearly_all:?}");
    assert_near(nearly_all.judged_share, 74.0 / 81.0, 1e-12, "judged share");
    for (from, share) in [(80, 70.0 / 81.0), (0, 0.0)] {
        let verdict = off(from);
        assert_eq!(verdict.state, VerdictState::NotJudged, "{verdict:?}");
        assert_near(verdict.judged_share, share, 1e-12, "judged share");
        assert!(verdict.reasons.is_empty() && verdict.undecided.iter().any(|why| why.contains("90 % are needed")));
    }
}

#[test]
fn forces_that_do_not_belong_to_the_motion_give_no_feasible_verdict() {
    let scaled = |share: f64| judged(move |_, _| Vec3::new(0.0, share * HALF, 0.0), &Thresholds::default()).0;
    assert_eq!(scaled(0.85).state, VerdictState::Feasible);
    let verdict = scaled(0.75);
    assert_eq!(verdict.state, VerdictState::NotJudged, "{verdict:?}");
    assert!(verdict.undecided[0].contains("25 % of body weight"), "{:?}", verdict.undecided);
    let nothing = judged(|_, _| Vec3::repeat(f64::NAN), &Thresholds::default()).0;
    assert_eq!(nothing.state, VerdictState::NotJudged, "{nothing:?}");
}

#[test]
fn the_first_and_last_tenth_of_a_second_are_not_judged() {
    // The feet are pushed apart, with three times the allowed friction.
    let push = |frames: Range<usize>| {
        let force = move |i: usize, side: Side| {
            let share = if frames.contains(&i) { 0.3 } else { 0.0 };
            Vec3::new(if side == Side::Right { share } else { -share } * HALF, HALF, 0.0)
        };
        judged(force, &Thresholds { friction: 0.1, ..Thresholds::default() }).0.state
    };
    assert_eq!(push(0..10), VerdictState::Feasible);
    assert_eq!(push(91..101), VerdictState::Feasible);
    assert_eq!(push(5..15), VerdictState::Infeasible);
}

#[test]
fn a_reason_has_times_worst_value_and_message_and_short_violations_are_noise() {
    // The right foot is pushed forwards and the left one backwards, a fifth of the load, from 2.30 to 2.49 s; and for
    // two frames only (0.02 s) at 2.80 s.
    let push = |i: usize, side: Side| {
        let share = match i {
            40 => 0.25,
            30..50 | 80 | 81 => 0.2,
            _ => 0.0,
        };
        Vec3::new(if side == Side::Right { share } else { -share } * HALF, HALF, 0.0)
    };
    let thresholds = Thresholds { friction: 0.1, ..Thresholds::default() };
    let (verdict, _) = judged(push, &thresholds);
    assert_eq!(verdict.state, VerdictState::Infeasible);
    assert_eq!(verdict.reasons.len(), 2, "{:?}", verdict.reasons);
    for (reason, side) in verdict.reasons.iter().zip(["r", "l"]) {
        assert_eq!((reason.check, reason.quantity.as_str()), (Check::Friction, format!("friction_{side}").as_str()));
        assert_near(reason.time_s[0], 2.30, 1e-9, "begin");
        assert_near(reason.time_s[1], 2.49, 1e-9, "end");
        assert_near(reason.at_s, 2.40, 1e-9, "worst");
        assert_near(reason.value, 0.25, 1e-9, "value");
        assert_near(reason.limit, 0.1, 1e-12, "limit");
        assert_eq!(reason.unit, "1");
    }
    assert_eq!(
        verdict.reasons[0].message,
        "the right foot needs a coefficient of friction of 0.25; 0.10 is available (from 2.300 to 2.490 s, worst at \
         2.400 s)"
    );
    // With a smaller limit of time the short one is detected too.
    let (verdict, _) = judged(push, &Thresholds { shortest_s: 0.0, ..thresholds });
    assert_eq!(verdict.reasons.len(), 4);
}

#[test]
fn too_long_a_flight_is_reported_with_its_duration() {
    let load = |i: usize, _: Side| Vec3::new(0.0, if (40..60).contains(&i) { 0.0 } else { HALF }, 0.0);
    // Kept in the air, he should fall, and his feet are off the ground that loads them: both are skipped here.
    let thresholds =
        Thresholds { skip: vec![Check::Support, Check::Balance, Check::CenterOfPressure], ..Thresholds::default() };
    let (verdict, findings) = judged_with(load, &thresholds, &[("pelvis_ty", 1.5)], None);
    assert_eq!(verdict.reasons.len(), 1, "{:?}", verdict.reasons);
    let message = "no foot is loaded for 0.200 s while walking; 0.030 s are allowed (from 2.400 to 2.590 s)";
    assert_eq!(verdict.reasons[0].message, message);
    assert!(findings.as_slice().is_empty());
    assert_eq!(verdict.not_judged[0].why, "skipped by the thresholds");
}

#[test]
fn frames_with_missing_forces_are_not_checked_and_reported() {
    let load = |i: usize, _: Side| Vec3::new(0.0, if (40..60).contains(&i) { 0.0 } else { HALF }, 0.0);
    let (verdict, findings) = judged(load, &Thresholds::default());
    assert_eq!(verdict.state, VerdictState::NotJudged, "{:?}", verdict.reasons);
    let text = &findings.as_slice()[0].message;
    assert!(text.contains("not checked in 20 of 101 frames (the first at 2.400 s)"), "{text}");
}

#[test]
fn frames_without_measured_forces_are_judged_on_predicted_ones() {
    let human = man();
    let (model, trajectory) = (&human.model, still(&human, 101, &[]));
    let with_load = |load: &dyn Fn(usize) -> f64| {
        let ground = on_both_feet(&human, 101, |i, _| Vec3::new(0.0, load(i), 0.0));
        let forces = inverse(&mut Workspace::new(model), &trajectory, &ground.loads());
        (ground, forces)
    };
    let judged = |measured: &(GroundForces, Forces), predicted: Option<&(GroundForces, Forces)>| {
        let (ground, forces) = (&measured.0, &measured.1);
        let predicted = predicted.map(|(ground, forces)| PredictedForces { ground, forces });
        let evidence = MotionAndForces {
            model,
            trajectory: &trajectory,
            forces,
            ground,
            device: None,
            predicted,
            partly_measured: &[],
            stances: None,
            activity: ActivityKind::Stand,
            cutoff_hz: None,
            forces_are_predicted: false,
        };
        check(&evidence, &Person::of_human(&human), &Thresholds::default(), &mut Findings::default())
    };
    let plates = with_load(&|i| if (40..60).contains(&i) { 0.0 } else { HALF });
    let (whole, weak) = (with_load(&|_| HALF), with_load(&|_| 0.5 * HALF));
    let verdict = judged(&plates, Some(&whole));
    assert_eq!((verdict.state, verdict.frames_unmeasured, verdict.frames_predicted), (VerdictState::Feasible, 20, 20));
    assert_near(verdict.judged_share, 1.0, 1e-12, "judged share");
    assert_eq!(judged(&plates, None).state, VerdictState::NotJudged);
    // Where a prediction does not carry the body, something else may: a hand, or a chair. The person is not called
    // unable for it.
    let verdict = judged(&plates, Some(&weak));
    assert_eq!((verdict.state, verdict.reasons.len()), (VerdictState::NotJudged, 0), "{:?}", verdict.reasons);
    assert!(verdict.undecided[0].contains("something other than the feet may support the person"));
    assert!(verdict.undecided[0].contains("the residual force is 0.50 body weights"), "{:?}", verdict.undecided);
    // The same lack of support on plates that carry all of it before and after is a fault of the motion.
    assert_eq!(judged(&weak, None).state, VerdictState::Infeasible);
    assert_eq!(judged(&whole, Some(&weak)).state, VerdictState::Feasible);
}

#[test]
fn a_lack_of_support_next_to_missing_forces_is_a_step_off_the_plates_unless_it_lasts() {
    let load = |partial: Range<usize>| {
        move |i: usize, _: Side| {
            let share = if (40..60).contains(&i) { 0.0 } else { 1.0 };
            Vec3::new(0.0, if partial.contains(&i) { 0.5 } else { share } * HALF, 0.0)
        }
    };
    let (verdict, _) = judged(load(60..72), &Thresholds::default());
    assert!(verdict.frames_unmeasured == 32 && verdict.reasons.is_empty(), "{verdict:?}");
    let (verdict, _) = judged(load(28..40), &Thresholds::default());
    assert!(verdict.frames_unmeasured == 32 && verdict.reasons.is_empty(), "{verdict:?}");
    // For longer than a step off takes, or away from missing forces, the body is not carried.
    for partial in [60..80, 70..82] {
        let (verdict, _) = judged(load(partial.clone()), &Thresholds::default());
        let support = verdict.reasons.iter().find(|reason| reason.check == Check::Support).unwrap();
        assert_near(support.time_s[1], 2.0 + 0.01 * (partial.end - 1) as f64, 0.011, "end of the lack");
        assert_eq!(verdict.state, VerdictState::Infeasible);
    }
}

/// A figure that bobs up and down, and the ground forces that this takes with a clock that is `clock` times as fast.
fn bobbing(clock: f64) -> Verdict {
    let human = man();
    let model = &human.model;
    let grid = TimeGrid { start_s: 0.0, step_s: 0.01 / clock, frames: 201 };
    let rate = std::f64::consts::TAU * clock;
    let height = model.coordinate("pelvis_ty").unwrap().index();
    let mut columns: Vec<[Vec<f64>; 3]> =
        model.coordinates().iter().map(|c| [vec![c.default_value; 201], vec![0.0; 201], vec![0.0; 201]]).collect();
    for i in 0..201 {
        let (sine, cosine) = (rate * grid.time(i)).sin_cos();
        let [value, speed, acceleration] = &mut columns[height];
        value[i] += 0.02 * sine;
        speed[i] = 0.02 * rate * cosine;
        acceleration[i] = -0.02 * rate * rate * sine;
    }
    let trajectory = Trajectory::new(model, grid, columns).unwrap();
    // m (g + a) with the true clock.
    let force = |i: usize| {
        let acceleration = -0.02 * std::f64::consts::TAU.powi(2) * (rate * grid.time(i)).sin();
        0.5 * 72.6 * (GRAVITY + acceleration)
    };
    let ground = on_both_feet(&human, 201, |i, _| Vec3::new(0.0, force(i), 0.0));
    let forces = inverse(&mut Workspace::new(model), &trajectory, &ground.loads());
    let evidence = measured(model, &trajectory, &forces, &ground, ActivityKind::Other);
    check(&evidence, &Person::of_human(&human), &Thresholds::default(), &mut Findings::default())
}

/// The verdict on a man who stands with these ground forces, of which the plates measured only a part at some times.
fn standing(ground: &GroundForces, partly_measured: &[[f64; 2]]) -> Verdict {
    let human = man();
    let (model, trajectory) = (&human.model, still(&human, 101, &[]));
    let forces = inverse(&mut Workspace::new(model), &trajectory, &ground.loads());
    let evidence =
        MotionAndForces { partly_measured, ..measured(model, &trajectory, &forces, ground, ActivityKind::Stand) };
    check(&evidence, &Person::of_human(&human), &Thresholds::default(), &mut Findings::default())
}

#[test]
fn a_centre_of_pressure_beside_a_foot_that_may_be_turned_decides_nothing() {
    let upward = |_: usize, _: Side| Vec3::new(0.0, HALF, 0.0);
    let beside = |outwards_m: f64| standing(&beside_both_feet(&man(), 101, outwards_m, upward), &[]);
    assert_eq!(beside(0.0).state, VerdictState::Feasible);
    // 85 mm beside the line of the foot: a foot that points outwards stands there.
    let near = beside(0.085);
    assert_eq!(near.state, VerdictState::NotJudged);
    assert!(near.reasons.is_empty() && near.undecided[0].contains("direction of a foot"), "{near:?}");
    // The report of the closest value still shows it.
    let closest = near.closest.iter().find(|closest| closest.check == Check::CenterOfPressure).unwrap();
    assert!(closest.share > 1.0, "{closest:?}");
    // Further out than a foot turned by 30 degrees would stand, but no further from the heel than a foot is long.
    let far = beside(0.2);
    assert_eq!(far.state, VerdictState::Infeasible);
    assert!(checks(&far).contains(&Check::CenterOfPressure), "{far:?}");
}

#[test]
fn a_lack_of_support_while_a_plate_measures_a_part_of_a_foot_is_the_plates() {
    // The left plate shows a tenth of its load from 2.4 to 2.6 s.
    let force = |i: usize, side: Side| {
        let share = if side == Side::Left && (40..=60).contains(&i) { 0.1 } else { 1.0 };
        Vec3::new(0.0, share * HALF, 0.0)
    };
    let ground = on_both_feet(&man(), 101, force);
    let unknown = standing(&ground, &[]);
    assert!(checks(&unknown).contains(&Check::Support), "{unknown:?}");
    let told = standing(&ground, &[[2.35, 2.65]]);
    assert!(told.state != VerdictState::Infeasible && told.frames_unmeasured == 21, "{told:?}");
    // Another time explains nothing.
    assert_eq!(standing(&ground, &[[2.7, 2.8]]).state, VerdictState::Infeasible);
}

#[test]
fn a_person_with_a_heel_beside_the_plate_and_misplaced_toe_markers_is_not_called_unable() {
    // The heel is 155 mm beyond the edge of the second plate in single support, and the toe markers show feet that
    // point 45 degrees outwards.
    let Some(data) = data() else { return };
    let bytes = std::fs::read(data.join("c3d-format-variants/TYPE-3.c3d")).unwrap();
    let trial = LaboratoryFile::from_c3d(&bytes, "TYPE-3.c3d", &mut Findings::default()).unwrap();
    let body = MarkerBody::BuiltIn { table: SegmentTable::DeLevaMale, mass_kg: None, height_m: None, set: None };
    let source = Source::markers(MarkerSource { trial, standing: None, body, plates: Vec::new() });
    let outcome = study::run(source, &Settings::default(), &mut Findings::default()).unwrap();
    let verdict = outcome.verdict;
    assert_eq!(verdict.state, VerdictState::NotJudged, "{:?}", verdict.reasons);
    assert!(verdict.undecided.iter().any(|why| why.contains("direction of a foot")), "{:?}", verdict.undecided);
    assert!(verdict.fit.residual_force_bw.unwrap() < 0.2, "{:?}", verdict.fit.residual_force_bw);
}

#[test]
fn a_clock_that_is_too_fast_multiplies_the_accelerations_that_the_plates_do_not_show() {
    let ratio =
        |verdict: &Verdict| verdict.closest.iter().find(|closest| closest.check == Check::Acceleration).unwrap().value;
    for clock in [1.0, 1.2, 1.5, 2.0] {
        let verdict = bobbing(clock);
        assert_near(ratio(&verdict), clock * clock, 0.02, "ratio of accelerations");
        let found = verdict.reasons.iter().any(|reason| reason.check == Check::Acceleration);
        assert_eq!(found, clock > 1.3, "{clock}: {:?}", verdict.reasons);
    }
}

#[test]
fn an_excess_shorter_than_the_filter_can_show_is_noise() {
    let slope = |cutoff_hz: Option<f64>| {
        let push = |i: usize, side: Side| {
            let along = if (40..48).contains(&i) && side == Side::Right { 0.7 } else { 0.0 };
            Vec3::new(along * HALF, HALF, 0.0)
        };
        let found = judged_at(push, &Thresholds::default(), cutoff_hz).reasons;
        found.iter().any(|reason| reason.check == Check::Friction)
    };
    // 0.08 s: longer than 0.603 / 20 Hz, shorter than 0.603 / 6 Hz.
    assert!(slope(None) && slope(Some(20.0)));
    assert!(!slope(Some(6.0)));
}

#[test]
fn a_skipped_check_gives_no_reason() {
    let push = |_: usize, side: Side| Vec3::new(if side == Side::Right { 0.7 } else { -0.7 } * HALF, HALF, 0.0);
    let (verdict, _) = judged(push, &Thresholds::default());
    let found: Vec<Check> = verdict.reasons.iter().map(|r| r.check).collect();
    assert!(found.contains(&Check::Friction), "{found:?}");
    let skip = vec![Check::Friction, Check::Strength];
    let (verdict, _) = judged(push, &Thresholds { skip, ..Thresholds::default() });
    assert_eq!(verdict.state, VerdictState::Feasible, "{:?} {:?}", verdict.reasons, verdict.undecided);
}

// ---- people ----

#[test]
fn the_size_of_a_person_is_estimated_from_the_legs_of_any_model() {
    for table in SegmentTable::ALL {
        let human = Build { table, mass: 70.0, height: 1.75, toe_joint: true }.human().unwrap();
        let (known, estimated) = (Person::of_human(&human), Person::of_model(&human.model));
        assert!(estimated.estimated && !known.estimated);
        assert_near(known.height_m, 1.75, 1e-12, "known");
        // Women of de Leva's sample have thighs 3 % of stature shorter than the others.
        let slack = if table == SegmentTable::DeLevaFemale { 0.06 } else { 0.04 };
        assert_near(estimated.height_m / 1.75, 1.0, slack, &format!("{table}"));
        for (a, b) in known.soles.values().zip(estimated.soles.values()) {
            let (a, b) = (a.unwrap(), b.unwrap());
            assert_near(b.half_width / a.half_width, 1.0, slack, "width of the sole");
            assert!((a.points[0].place - b.points[0].place).norm() < 0.015, "{table}: heels apart");
        }
    }
}

struct Subject {
    model: Model,
    motion: Motion,
    plates: Vec<ForceRecording>,
}

fn table(path: &Path) -> Table {
    Table::read_storage(&std::fs::read(path).unwrap()).unwrap().0
}

fn subject(folder: &Path, [model, motion, grf, loads]: [&str; 4]) -> Subject {
    let mut findings = Findings::default();
    let document = OsimModel::read(&std::fs::read(folder.join(model)).unwrap()).unwrap();
    let model = from_osim(&document, &mut findings).unwrap();
    let motion = coordinates_from_table(&model, &table(&folder.join(motion)), "recording", &mut findings).unwrap();
    let loads = if loads.is_empty() {
        let prefix = |name: &str, body: &str, prefix: &str| ExternalForce::with_prefix(name, body, prefix);
        let forces = vec![prefix("r", "calcn_r", "ground_force_"), prefix("l", "calcn_l", "l_ground_force_")];
        ExternalLoads { name: "feet".into(), datafile: None, forces }
    } else {
        ExternalLoads::read(&std::fs::read(folder.join(loads)).unwrap()).unwrap().0
    };
    let plates = force_recordings(&model, &loads, &table(&folder.join(grf)), &mut findings).unwrap();
    Subject { model, motion, plates }
}

/// Every available recording of normal walking with plates.
fn walkers(data: &Path) -> Vec<(&'static str, Subject)> {
    let (gait2392, gait10dof, rajagopal) = (
        data.join("opensim-gait2392-subject01"),
        data.join("opensim-gait10dof-subject01"),
        data.join("opensim-rajagopal-walk"),
    );
    let walk1 = |motion| ["subject01_simbody.osim", motion, "subject01_walk1_grf.mot", "subject01_walk1_grf.xml"];
    let whole = ["subject01_simbody.osim", "subject01_walk1_ik.mot", "core-id-test/subject01_walk1_grf.mot", ""];
    let planar = ["subject01.osim", "subject01_walk_IK.mot", "subject01_walk_grf.mot", "subject01_walk_grf.xml"];
    let overground = |motion| ["subject_walk_scaled.osim", motion, "grf_walk.mot", "grf_walk.xml"];
    vec![
        ("gait2392", subject(&gait2392, walk1("subject01_walk1_ik.mot"))),
        ("gait2392, uniform weights", subject(&gait2392, walk1("ik_uniform_weights.mot"))),
        ("gait2392, longer", subject(&gait2392, whole)),
        ("gait10dof", subject(&gait10dof, planar)),
        ("rajagopal", subject(&rajagopal, overground("coordinates.sto"))),
        ("rajagopal, uniform weights", subject(&rajagopal, overground("ik_uniform_weights.mot"))),
    ]
}

fn verdict(subject: &Subject, thresholds: &Thresholds) -> Verdict {
    let six_hz = LowPass { order: 3, cutoff_hz: 6.0 };
    let settings = AnalysisSettings {
        smoother: Smoother::Butterworth(six_hz),
        force_filter: Some(six_hz),
        window: Window::default(),
        rate_hz: None,
        instrumented: None,
    };
    let mut findings = Findings::default();
    let Subject { model, motion, plates } = subject;
    let analysis = analyse(model, motion, plates, settings, &mut findings).unwrap();
    let (trajectory, forces, ground) = (&analysis.trajectory, &analysis.forces, &analysis.ground);
    let cutoff_hz = Some(six_hz.cutoff_hz);
    let evidence = MotionAndForces { cutoff_hz, ..measured(model, trajectory, forces, ground, ActivityKind::Walk) };
    check(&evidence, &Person::of_model(model), thresholds, &mut findings)
}

fn checks(verdict: &Verdict) -> Vec<Check> {
    let mut list: Vec<Check> = verdict.reasons.iter().map(|r| r.check).collect();
    list.sort();
    list.dedup();
    list
}

#[test]
fn recorded_walks_are_feasible() {
    let Some(data) = data() else { return };
    for (name, subject) in walkers(&data) {
        let verdict = verdict(&subject, &Thresholds::default());
        // A foot of some recordings is off the plates for a while, and no prediction takes their place here.
        assert!(verdict.reasons.is_empty(), "{name}: {:?}", verdict.reasons);
        assert_eq!(
            verdict.state == VerdictState::Feasible,
            verdict.judged_share >= 0.9,
            "{name}: {:?}",
            verdict.undecided
        );
        println!("{name}, {:.1} kg, {:.3} m", verdict.mass_kg, verdict.height_m);
        for c in &verdict.closest {
            println!(
                "  {:<19} {:<24} {:>9.3} of {:>9.3} {:<5} {:>4.0} %",
                c.check.name(),
                c.quantity,
                c.value,
                c.limit,
                c.unit,
                100.0 * c.share
            );
        }
    }
}

#[test]
fn normal_walking_on_slippery_ice_is_infeasible() {
    let Some(data) = data() else { return };
    for (name, subject) in walkers(&data) {
        let found = verdict(&subject, &Thresholds { friction: 0.05, ..Thresholds::default() });
        assert_eq!(checks(&found), [Check::Friction], "{name}");
    }
}

#[test]
fn added_mass_that_the_plates_did_not_measure_is_detected() {
    let Some(data) = data() else { return };
    for (name, mut subject) in walkers(&data) {
        let torso = subject.model.body("torso").unwrap();
        let mass = subject.model.mass();
        subject.model = subject.model.with_point_mass(torso, mass, Vec3::new(0.0, 0.3, 0.0)).unwrap();
        // Half of the new weight is missing on average.
        let found = verdict(&subject, &Thresholds::default());
        assert!(checks(&found).contains(&Check::Support), "{name}: {:?}", checks(&found));
    }
}

#[test]
fn three_times_the_mass_and_forces_exceed_the_strength() {
    let Some(data) = data() else { return };
    for (name, mut subject) in walkers(&data) {
        let person = Person::of_model(&subject.model);
        let heavier = subject.model.bodies().iter().map(|body| {
            let mut body = body.clone();
            let inertia = body.inertia;
            body.inertia = inertia.joined(&inertia).joined(&inertia);
            body
        });
        let (bodies, m) = (heavier.collect(), &subject.model);
        subject.model =
            Model::new(m.name(), m.gravity(), bodies, m.coordinates().to_vec(), m.markers().to_vec()).unwrap();
        for plate in &mut subject.plates {
            for part in plate.force.iter_mut().chain(&mut plate.moment) {
                *part *= 3.0;
            }
        }
        // A person of that mass would be strong enough; this person (who could carry one more, as porters do) cannot
        // carry two.
        assert_eq!(verdict(&subject, &Thresholds::default()).reasons, [], "{name}");
        let (mass_kg, height_m) = (Some(person.mass_kg), Some(person.height_m));
        let found = verdict(&subject, &Thresholds { mass_kg, height_m, ..Thresholds::default() });
        assert_eq!(checks(&found), [Check::Strength], "{name}");
    }
}

#[test]
fn the_same_walk_at_twice_the_pace_is_infeasible() {
    let Some(data) = data() else { return };
    for (name, mut subject) in walkers(&data) {
        let hurry = |times: &mut Vec<f64>| times.iter_mut().for_each(|t| *t *= 0.5);
        hurry(&mut subject.motion.times);
        subject.plates.iter_mut().for_each(|plate| hurry(&mut plate.times));
        let found = verdict(&subject, &Thresholds::default());
        println!("{name}: {:?}", checks(&found));
        assert_eq!(found.state, VerdictState::Infeasible, "{name}");
    }
}

// ---- stairs ----

/// The coordinates of a man who climbs steps of 0.17 m, on the frames of his motion, all lifted by a height [m].
fn climbing(human: &Human, lifted_m: f64) -> Motion {
    let trajectory = moving(human, |t| stepping(t, 1.4, 0.65, [0.6, 0.34], 0.8), 5.0);
    let vertical = human.model.coordinate("pelvis_ty").unwrap();
    let lift = |id| if id == vertical { lifted_m } else { 0.0 };
    let column = |id| trajectory.values(id).iter().map(|value| value + lift(id)).collect();
    let columns = human.model.coordinate_ids().map(|id| Some(column(id))).collect();
    Motion { origin: "climbs".to_owned(), times: trajectory.grid().times(), columns }
}

/// The forces of an outcome on both feet between two times, as plates under these steps measure them; elsewhere there
/// are no plates.
fn loads_between(outcome: &study::Outcome, [from, to]: [f64; 2]) -> Vec<ForceRecording> {
    let times = outcome.analysis.trajectory.grid().times();
    let on_plates = |values: &[Vec3]| -> Vec<Vec3> {
        let is_measured = |value: &Vec3, t: &f64| (from..=to).contains(t) && value.iter().all(|x| x.is_finite());
        let inside = |(value, t): (&Vec3, &f64)| if is_measured(value, t) { *value } else { Vec3::zeros() };
        values.iter().zip(&times).map(inside).collect()
    };
    let load = |foot: &BodyForces| ForceRecording {
        name: "plate".to_owned(),
        body: foot.body,
        force_frame: None,
        point_frame: None,
        times: times.clone(),
        force: on_plates(&foot.force),
        point: on_plates(&foot.center_of_pressure),
        moment: on_plates(&foot.free_moment),
    };
    outcome.analysis.ground.bodies.iter().map(load).collect()
}

#[test]
fn a_foot_on_a_step_without_a_plate_is_on_unmeasured_ground_and_a_body_that_hovers_is_not() {
    let human = man();
    let settings = Settings { force_filter: ForceFilter::Off, ..Settings::default() };
    let run = |source: &Source| study::run(source.clone(), &settings, &mut Findings::default()).unwrap();
    let whole = run(&Source::coordinates(human.model.clone(), climbing(&human, 0.0)));
    assert_eq!(whole.activity.kind, ActivityKind::StairsUp, "{:?}", whole.activity);
    // Plates under the steps in the middle only: the others are higher and lower than these.
    let loads = loads_between(&whole, [1.7, 3.3]);
    let verdict = |lifted_m: f64| {
        let source = Source::coordinates(human.model.clone(), climbing(&human, lifted_m));
        run(&source.with_forces(MeasuredForces::OnBodies(loads.clone()))).verdict
    };
    let on_stairs = verdict(0.0);
    assert!(on_stairs.frames_predicted > 100, "{}", on_stairs.frames_predicted);
    // The legs of these invented steps bend the ankles too far; no force is against the motion.
    let by_forces = |found: &Verdict| found.reasons.iter().filter(|reason| reason.check != Check::Range).count();
    assert_eq!(by_forces(&on_stairs), 0, "{:?}", on_stairs.reasons);
    let hovers = verdict(0.3);
    assert_eq!(hovers.state, VerdictState::Infeasible, "{:?}", hovers.undecided);
    assert!(by_forces(&hovers) > 0, "{:?}", hovers.reasons);
}
