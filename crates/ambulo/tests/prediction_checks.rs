//! Checks of predictions without plates: consistent motions pass, forces that do not act through the feet are detected.
//!
//! The recordings are not part of the repository; without them their test states `skipped` and passes.

use crate::footfall_trials::everything;
use crate::walking_puppet::{Hand, NO_HAND, Puppet, moved, walk};
use crate::walks;
use ambulo::analysis::feasibility::{Check, Person, Thresholds};
use ambulo::analysis::{
    CheckSettings, CheckedPrediction, MassSource, PlateCoverage, PlateMass, PredictedAnalysis, PredictionChecks,
    PredictionInput, analyse_predicted_trajectory, cycles, prediction_checks,
};
use ambulo::findings::{Code, Findings};
use ambulo::gait::Gait;
use ambulo::ground::predict::{PredictSettings, Prediction, predict};
use ambulo::ground::{BodyForces, GroundForces};
use ambulo::kinematics::Trajectory;
use ambulo::model::anatomy::Sole;
use ambulo::model::anthropometry::{Build, Human, SegmentTable};
use ambulo::model::full_body::full_body;
use ambulo::model::{BySide, Model};
use ambulo::motion::TimeGrid;
use ambulo::simulation::synthetic::{SyntheticMode, SyntheticWalk, SyntheticWalkSettings, synthesise};
use ambulo::spatial::{Inertia, Vec3};
use std::sync::LazyLock;

const FOUND: Code = Code::PredictionNotThroughTheFeet;

fn prediction(model: &Model, trajectory: &Trajectory, soles: &BySide<Option<Sole>>) -> Prediction {
    predict(model, trajectory, soles, &PredictSettings::default(), &mut Findings::default()).unwrap()
}

/// Checks of a prediction whose forces were changed.
fn checked_after(
    model: &Model,
    trajectory: &Trajectory,
    soles: &BySide<Option<Sole>>,
    plate_mass: Option<PlateMass>,
    change: impl Fn(&mut Prediction),
) -> (PredictionChecks, Findings) {
    let mut prediction = prediction(model, trajectory, soles);
    change(&mut prediction);
    let cycles = cycles(&prediction.footfalls.events(), trajectory.grid());
    let evidence = CheckedPrediction {
        model,
        trajectory,
        soles,
        prediction: &prediction,
        cycles: &cycles,
        thresholds: &Thresholds::default(),
        plate_mass,
    };
    let mut findings = Findings::default();
    (prediction_checks(&evidence, &mut findings), findings)
}

fn checked(model: &Model, trajectory: &Trajectory, soles: &BySide<Option<Sole>>) -> (PredictionChecks, Findings) {
    checked_after(model, trajectory, soles, None, |_| ())
}

fn of_puppet(puppet: &Puppet) -> (PredictionChecks, Findings) {
    checked(&puppet.model, &puppet.trajectory, &puppet.soles)
}

/// Values as a line; a star marks failed checks.
fn line(checks: &PredictionChecks) -> String {
    let value = |check: &ambulo::analysis::PredictionCheck| {
        let star = if check.passed == Some(false) { "*" } else { " " };
        check.value.map_or_else(|| format!("{:>8} ", "-"), |value| format!("{value:>8.3}{star}"))
    };
    checks.checks.iter().map(value).collect()
}

fn failed(checks: &PredictionChecks) -> Vec<&str> {
    checks.checks.iter().filter(|check| check.passed == Some(false)).map(|check| &*check.name).collect()
}

#[test]
fn no_recording_has_forces_outside_its_feet() {
    let mut is_first = true;
    for trial in everything() {
        for cutoff_hz in [6.0, 15.0] {
            let trajectory = trial.trajectory(cutoff_hz);
            let (checks, findings) = checked(&trial.model, &trajectory, &trial.soles);
            if std::mem::take(&mut is_first) {
                println!("{:24}{}", "", checks.checks.iter().map(|c| format!("{:>8.8} ", c.name)).collect::<String>());
            }
            println!("{:<15} {cutoff_hz:>4} Hz  {}", trial.name, line(&checks));
            assert!(checks.reasons.is_empty() && !findings.has(FOUND), "{}: {:?}", trial.name, checks.reasons);
            // Half of the limit.
            let outside = checks.get("center_of_pressure").unwrap().value.unwrap();
            assert!(outside < 0.015, "{} at {cutoff_hz} Hz: {outside} m", trial.name);
            assert!(failed(&checks).is_empty(), "{} at {cutoff_hz} Hz: {}", trial.name, line(&checks));
            assert_eq!(checks.mass_agrees(), None, "{}: nobody said what it weighs", trial.name);
        }
    }
}

#[test]
fn a_walk_carried_only_by_the_feet_passes() {
    let (checks, findings) = of_puppet(&walk(NO_HAND));
    println!("{}", line(&checks));
    assert!(failed(&checks).is_empty() && findings.as_slice().is_empty(), "{checks:?}");
    let judged = checks.checks.iter().filter(|check| check.passed.is_some()).count();
    assert!(judged >= 6, "{checks:?}");
}

#[test]
fn a_hand_on_a_rail_is_detected() {
    for (what, hand) in [
        ("on the right", Hand { share: 0.15, forward: 0.1, right: 0.45 }),
        ("on the left", Hand { share: 0.15, forward: 0.1, right: -0.45 }),
        ("ahead", Hand { share: 0.2, forward: 0.6, right: 0.0 }),
        ("carried behind", Hand { share: 0.3, forward: -0.6, right: 0.0 }),
        ("lightly", Hand { share: 0.02, forward: 0.1, right: 0.45 }),
    ] {
        let (checks, findings) = of_puppet(&walk(hand));
        println!("{what:<20} {}", line(&checks));
        if what == "lightly" {
            assert!(!findings.has(FOUND), "2 % of body weight is within what masses are wrong by");
            continue;
        }
        assert!(findings.has(FOUND), "{what}");
        let reason = checks.reasons.first().unwrap_or_else(|| panic!("{what}: a reason for the verdict"));
        assert_eq!((reason.check, &*reason.unit), (Check::CenterOfPressure, "m"), "{what}");
        assert!(reason.value.abs() > reason.limit.abs(), "{what}: {reason:?}");
    }
}

/// A figure in some posture, at rest for two seconds: coordinates and their values [rad, m].
fn still(human: &Human, posture: &[(&str, f64)]) -> Trajectory {
    let grid = TimeGrid { start_s: 0.0, step_s: 0.01, frames: 200 };
    let columns = human.model.coordinates().iter().map(|coordinate| {
        let value = posture.iter().find(|(name, _)| *name == coordinate.name).map(|(_, value)| *value);
        [vec![value.unwrap_or(coordinate.default_value); grid.frames], vec![0.0; grid.frames], vec![0.0; grid.frames]]
    });
    Trajectory::new(&human.model, grid, columns.collect()).unwrap()
}

fn man() -> Human {
    full_body(&Build { table: SegmentTable::DeLevaMale, mass: 75.0, height: 1.75, toe_joint: true }).unwrap()
}

fn of_posture(posture: &[(&str, f64)]) -> (PredictionChecks, Findings) {
    let human = man();
    checked(&human.model, &still(&human, posture), &Person::of_human(&human).soles)
}

#[test]
fn standing_upright_passes_and_leaning_beyond_the_toes_does_not() {
    let (checks, findings) = of_posture(&[]);
    println!("upright {}", line(&checks));
    assert!(failed(&checks).is_empty() && findings.as_slice().is_empty(), "{checks:?} {findings:?}");
    // The whole body turns about the ankles.
    for (lean, is_found) in [(-0.1_f64, false), (-0.35, true)] {
        let ankle = man().model.coordinates().iter().find(|c| c.name == "pelvis_ty").unwrap().default_value;
        let (checks, findings) = of_posture(&[
            ("pelvis_tilt", lean),
            ("pelvis_tx", -lean.sin() * ankle),
            ("pelvis_ty", lean.cos() * ankle),
            ("ankle_angle_r", -lean),
            ("ankle_angle_l", -lean),
        ]);
        println!("lean {lean} {}", line(&checks));
        assert_eq!(findings.has(FOUND), is_found, "{lean} rad: {checks:?}");
    }
}

/// Without a margin a point inside the soles is exactly at the limit.
#[test]
fn who_leans_too_far_for_half_of_the_time_exceeds_the_limit_for_half_of_it() {
    let human = man();
    let height = human.model.coordinates().iter().find(|c| c.name == "pelvis_ty").unwrap().default_value;
    let lean = -0.35_f64;
    let leaning = [
        ("pelvis_tilt", lean),
        ("pelvis_tx", -lean.sin() * height),
        ("pelvis_ty", lean.cos() * height),
        ("ankle_angle_r", -lean),
        ("ankle_angle_l", -lean),
    ];
    let [upright, leaning] = [still(&human, &[]), still(&human, &leaning)];
    let grid = TimeGrid { frames: 2 * upright.grid().frames, ..upright.grid() };
    let rest = || vec![0.0; grid.frames];
    let values = |id| [upright.values(id), leaning.values(id)].concat();
    let columns = human.model.coordinate_ids().map(|id| [values(id), rest(), rest()]).collect();
    let trajectory = Trajectory::new(&human.model, grid, columns).unwrap();
    let soles = Person::of_human(&human).soles;
    let prediction = prediction(&human.model, &trajectory, &soles);
    let mut findings = Findings::default();
    let evidence = CheckedPrediction {
        model: &human.model,
        trajectory: &trajectory,
        soles: &soles,
        prediction: &prediction,
        cycles: &[],
        thresholds: &Thresholds { sole_margin_m: 0.0, ..Thresholds::default() },
        plate_mass: None,
    };
    let checks = prediction_checks(&evidence, &mut findings);
    let reason = checks.reasons.iter().find(|reason| reason.check == Check::CenterOfPressure).unwrap();
    let (_, after) = reason.message.split_once("exceeded for ").unwrap();
    let percent: f64 = after.split(' ').next().unwrap().parse().unwrap();
    // The window of the low-pass is 0.2 s wide, in 4 s.
    assert!((percent - 50.0).abs() < 5.0, "{}", reason.message);
}

#[test]
fn sitting_is_detected() {
    let (checks, findings) = of_posture(&[
        ("hip_flexion_r", 1.5),
        ("hip_flexion_l", 1.5),
        ("knee_angle_r", -1.5),
        ("knee_angle_l", -1.5),
        ("pelvis_ty", 0.5),
    ]);
    println!("{}", line(&checks));
    assert!(findings.has(FOUND), "{checks:?}");
    assert!(!checks.reasons.is_empty());
}

#[test]
fn hanging_in_a_harness_is_detected_and_a_jump_passes() {
    let grid = TimeGrid { start_s: 0.0, step_s: 0.01, frames: 300 };
    let still = |place: Vec3| [place, Vec3::zeros(), Vec3::zeros()];
    // Feet that move up and down next to each other.
    let feet = |t: f64, up: [f64; 3]| {
        [0.08, -0.08].map(|z: f64| {
            let (phase, rate) = (8.0 * t + 10.0 * z, 8.0);
            let swing = [phase.sin(), rate * phase.cos(), -rate * rate * phase.sin()];
            [0, 1, 2].map(|k| Vec3::new(0.0, up[k] + 0.25 * swing[k], if k == 0 { z } else { 0.0 }))
        })
    };
    let hangs = moved(grid, |frame| {
        let [right, left] = feet(grid.time(frame), [0.6, 0.0, 0.0]);
        [still(Vec3::y()), right, left]
    });
    let (checks, findings) = of_puppet(&hangs);
    println!("hangs {}", line(&checks));
    assert!(findings.has(FOUND) && failed(&checks).contains(&"held_without_feet"), "{checks:?}");
    let reason = checks.reasons.iter().find(|reason| reason.check == Check::Support).unwrap();
    assert!((reason.value - 1.0).abs() < 0.05, "all of the weight: {reason:?}");
    // The same in free fall: no support.
    let fall = |t: f64, g: f64| [40.0 - 0.5 * g * t * t, -g * t, -g];
    for (g, is_fine) in [(9.80665, true), (14.0, false)] {
        let falls = moved(grid, |frame| {
            let t = grid.time(frame);
            let [y, v, a] = fall(t, g);
            let [right, left] = feet(t, [y - 1.0, v, a]);
            [[Vec3::y() * y, Vec3::y() * v, Vec3::y() * a], right, left]
        });
        let (checks, findings) = of_puppet(&falls);
        println!("falls at {g} {}", line(&checks));
        assert!(!findings.has(FOUND), "{g}: {checks:?}");
        assert_eq!(findings.has(Code::PredictionPull), !is_fine, "{g}: {checks:?}");
    }
}

#[test]
fn forces_of_the_feet_that_do_not_balance_the_motion_are_detected() {
    let puppet = walk(NO_HAND);
    let changed = |change: &dyn Fn(Vec3) -> Vec3| {
        let (checks, findings) = checked_after(&puppet.model, &puppet.trajectory, &puppet.soles, None, |prediction| {
            let bodies = &prediction.ground.bodies;
            let of_foot = |foot: &BodyForces| {
                let force: Vec<Vec3> = foot.force.iter().map(|f| change(*f)).collect();
                BodyForces::on_level_ground(foot.body, &force, &foot.moment, Vec3::y(), 0.0)
            };
            prediction.ground = GroundForces { bodies: bodies.iter().map(of_foot).collect() };
        });
        let codes: Vec<Code> = findings.as_slice().iter().map(|finding| finding.code).collect();
        (failed(&checks).into_iter().map(str::to_owned).collect::<Vec<_>>(), codes)
    };
    assert_eq!(changed(&|f| f), (vec![], vec![]));
    assert_eq!(changed(&|f| f * 0.9), (vec!["vertical_force_feet".to_owned()], vec![Code::PredictionWeight]));
    let pushed = changed(&|f| f + Vec3::x() * (0.05 * f.y));
    assert_eq!(pushed, (vec!["fore_aft_impulse".to_owned()], vec![Code::PredictionImpulse]));
    let slippery = changed(&|f| f + Vec3::z() * (0.8 * f.y));
    assert_eq!(slippery, (vec!["friction".to_owned()], vec![Code::PredictionFriction]));
}

#[test]
fn a_fast_walk_that_was_smoothed_before_it_was_recorded_is_doubted_and_a_free_one_is_not() {
    let build = Build { table: SegmentTable::DeLevaMale, mass: 72.6, height: 1.80, toe_joint: false };
    let found = |gait: &str, bandwidth_hz: Option<f64>| {
        let gait = Gait::named(gait).unwrap();
        let settings =
            SyntheticWalkSettings { gait: &gait, build, mode: SyntheticMode::Paper, cycles: 1, rate_hz: 100.0 };
        let walk = synthesise(&settings, &mut Findings::default()).unwrap();
        let soles = Person::of_human(&walk.human).soles;
        let (checks, findings) = checked_after(&walk.human.model, &walk.trajectory, &soles, None, |prediction| {
            prediction.motion_bandwidth_hz = bandwidth_hz;
        });
        let check = checks.get("motion_bandwidth").unwrap().clone();
        assert_eq!(check.passed == Some(false), findings.has(Code::PredictionMotionSmoothed));
        check.passed
    };
    assert_eq!(found("fast", Some(6.0)), Some(false));
    assert_eq!(found("fast", Some(12.0)), Some(true));
    assert_eq!(found("fast", None), None);
    assert_eq!(found("slow", Some(6.0)), Some(true));
}

// ---- mass ----

static WALK: LazyLock<&SyntheticWalk> = LazyLock::new(|| walks::corrected(walks::WITHOUT_TOES, 2));

/// The walk's figure with a share of its masses.
fn lighter(share: f64) -> Model {
    let model = &WALK.human.model;
    let mut bodies = model.bodies().to_vec();
    for body in &mut bodies {
        let (mass, center, turning) = (body.inertia.mass(), body.inertia.center(), body.inertia.about_center());
        body.inertia = Inertia::new(share * mass, center, turning * share).unwrap();
    }
    Model::new("lighter", model.gravity(), bodies, model.coordinates().to_vec(), Vec::new()).unwrap()
}

fn of_mass(share: f64, with_plates: bool, standing_kg: Option<f64>) -> (PredictionChecks, Findings, PredictedAnalysis) {
    let (model, soles) = (lighter(share), Person::of_human(&WALK.human).soles);
    let plates = if with_plates { &WALK.loads[..] } else { &[] };
    let order = PredictionInput { soles: &soles, settings: &PredictSettings::default(), plates_filter: None };
    let mut findings = Findings::default();
    let trajectory = WALK.trajectory.clone();
    let predicted = analyse_predicted_trajectory(&model, trajectory, plates, None, &order, &mut findings).unwrap();
    let seen = predicted.measured.as_ref().map(|m| PlateCoverage::by_load(m, plates, &predicted.prediction.footfalls));
    let window_s = seen.and_then(|seen| seen.window);
    let predicted = predicted.weighed(&model, window_s, standing_kg);
    let thresholds = Thresholds::default();
    let order = CheckSettings { model: &model, soles: &soles, thresholds: &thresholds, window_s, standing_kg };
    let mut findings = Findings::default();
    (predicted.checks(&order, &mut findings), findings, predicted)
}

#[test]
fn a_wrong_mass_is_only_detected_with_plates() {
    let (checks, findings, predicted) = of_mass(0.5, false, None);
    println!("half, alone     {}", line(&checks));
    // All forces are halved and agree with each other.
    assert!(failed(&checks).is_empty() && findings.as_slice().is_empty(), "{checks:?}");
    assert_eq!((checks.mass_agrees(), predicted.analysis.mass.source), (None, MassSource::Model));
    for (with_plates, standing_kg) in [(true, None), (false, Some(75.0))] {
        let (checks, findings, predicted) = of_mass(0.5, with_plates, standing_kg);
        println!("half, weighed   {}", line(&checks));
        assert_eq!((failed(&checks), checks.mass_agrees()), (vec!["mass"], Some(false)));
        assert!(findings.as_slice().is_empty() && checks.reasons.is_empty(), "reported by `study`: {findings:?}");
        let value = checks.get("mass").unwrap().value.unwrap();
        assert!((value - 2.0).abs() < 0.02, "{value}");
        assert_eq!(predicted.analysis.mass.source, MassSource::Model, "a contradicting mass is not used");
        let (checks, findings, predicted) = of_mass(1.0, with_plates, standing_kg);
        assert_eq!((failed(&checks), checks.mass_agrees()), (vec![], Some(true)), "{findings:?}");
        assert_ne!(predicted.analysis.mass.source, MassSource::Model);
    }
}
