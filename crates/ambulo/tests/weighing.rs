//! Weighing: closed forms, and people of known mass.

use crate::ground_agreement::{WALK, predicted};
use crate::plug_in_gait::PEOPLE;
use crate::shared_data::data;
use ambulo::analysis::{Analysis, Mass, MassSource, PredictedAnalysis};
use ambulo::findings::{Code, Findings};
use ambulo::model::Model;
use ambulo::model::anthropometry::{Build, SegmentTable};
use ambulo::motion::{ForceRecording, Motion};
use ambulo::spatial::Vec3;
use ambulo::study::{
    self, BodyMass, LaboratoryFile, MarkerBody, MarkerSource, MassState, MassWitness, MeasuredForces, Outcome,
    Recording, Settings, Source, StandingTrial, standing_trial,
};
use std::path::Path;
use std::sync::Arc;

const G: f64 = 9.80665;

/// A person who bobs on both feet: y = A sin(2 pi f t), so that the ground carries m (g - A (2 pi f)^2 sin(2 pi f t)).
fn bobbing(true_kg: f64, model_kg: f64, share_on_plates: f64) -> Source {
    let (amplitude_m, rate_hz) = (0.02, 1.0);
    let omega = std::f64::consts::TAU * rate_hz;
    let build = Build { table: SegmentTable::DeLevaMale, mass: model_kg, height: 1.75, toe_joint: false };
    let human = build.human().unwrap();
    let model: Model = human.model;
    let times: Vec<f64> = (0..401).map(|i| 0.01 * f64::from(i)).collect();
    let height_m = ambulo::kinematics::body_motion(
        &model,
        ambulo::kinematics::Posture {
            q: &vec![0.0; model.coordinates().len()],
            qd: &vec![0.0; model.coordinates().len()],
            qdd: &vec![0.0; model.coordinates().len()],
        },
    );
    let lowest = height_m.iter().map(|body| body.center.y).fold(f64::INFINITY, f64::min);
    let mut columns = vec![Some(vec![0.0; times.len()]); model.coordinates().len()];
    let vertical = model.coordinate("pelvis_ty").unwrap();
    columns[vertical.index()] = Some(times.iter().map(|t| 0.05 - lowest + amplitude_m * (omega * t).sin()).collect());
    let fine: Vec<f64> = (0..4001).map(|i| 0.001 * f64::from(i)).collect();
    let feet = model.anatomy().feet().unwrap();
    let force = |t: &f64| true_kg * (G - amplitude_m * omega * omega * (omega * t).sin());
    let on = |(side, body): (ambulo::model::Side, &ambulo::model::BodyId)| ForceRecording {
        name: format!("{side}"),
        body: *body,
        force_frame: None,
        point_frame: None,
        times: fine.clone(),
        force: fine.iter().map(|t| Vec3::new(0.0, 0.5 * share_on_plates * force(t), 0.0)).collect(),
        point: vec![Vec3::zeros(); fine.len()],
        moment: vec![Vec3::zeros(); fine.len()],
    };
    let forces = feet.iter().map(on).collect();
    let motion = Motion { origin: "bobbing".to_owned(), times, columns };
    Source::coordinates(model, motion).with_forces(MeasuredForces::OnBodies(forces))
}

fn run(source: &Source) -> (Outcome, Findings) {
    let mut findings = Findings::default();
    let outcome = study::run(source.clone(), &Settings::default(), &mut findings).unwrap();
    (outcome, findings)
}

#[test]
fn a_bobbing_person_weighs_what_newton_says() {
    let (outcome, findings) = run(&bobbing(70.0, 70.0, 1.0));
    let impulse = outcome.mass.by(MassWitness::Impulse).unwrap();
    assert!((impulse.kg - 70.0).abs() < 0.1, "{:?}", outcome.mass);
    assert!(impulse.error_kg < 0.5, "{impulse:?}");
    assert_eq!(outcome.mass.state, MassState::Weighed);
    assert!(!findings.has(Code::MassContradicted));
}

#[test]
fn a_model_that_is_15_percent_too_light_is_named() {
    let (outcome, findings) = run(&bobbing(70.0, 0.85 * 70.0, 1.0));
    assert_eq!((outcome.mass.state, outcome.mass.source), (MassState::Contradicted, MassWitness::Model));
    assert!((outcome.mass.plates_kg.unwrap() - 70.0).abs() < 0.2, "{:?}", outcome.mass);
    assert!(findings.has(Code::MassContradicted), "{:?}", findings.as_slice());
}

/// A walk that was measured by plates which say `factor` times the force, before anybody is weighed.
fn unweighed(walk: &PredictedAnalysis, factor: f64) -> PredictedAnalysis {
    let PredictedAnalysis { analysis, prediction, measured } = walk.clone();
    let stated = Mass { kg: WALK.human.model.mass(), source: MassSource::Model };
    let mut measured: Analysis = measured.unwrap();
    for foot in Arc::make_mut(&mut measured.ground.bodies) {
        foot.force.iter_mut().for_each(|force| *force *= factor);
    }
    let without = |analysis: Analysis| Analysis { mass: stated, ..analysis };
    PredictedAnalysis { analysis: without(analysis), prediction, measured: Some(without(measured)) }
}

#[test]
fn any_gait_cycle_on_the_plates_weighs_a_walker() {
    let model = &WALK.human.model;
    let stated = model.mass();
    let walk = predicted(&WALK.loads);
    let masses = |factor: f64, window_s, standing_kg| {
        let weighed = unweighed(&walk, factor).weighed(model, window_s, standing_kg);
        [weighed.analysis.mass, weighed.measured.unwrap().mass]
    };
    let cycle = walk.measured.as_ref().unwrap().cycles[0];
    let cycle_s = cycle.end_s - cycle.start_s;
    for factor in [0.97, 1.0, 1.04] {
        // From any instant on, not from strike to strike.
        for share in [0.1, 0.25, 0.6] {
            let start_s = walk.analysis.trajectory.grid().start_s + share * cycle_s;
            for mass in masses(factor, Some([start_s, start_s + 1.1 * cycle_s]), Some(1.01 * stated)) {
                assert_eq!(mass.source, MassSource::Plates, "{factor} from {start_s} s");
                // A frame more or less than a cycle is 1 % of it, at up to 1.2 body weights.
                assert!((mass.kg / stated - factor).abs() < 0.005, "{factor} from {start_s} s: {} kg", mass.kg);
            }
            for window_s in [None, Some([start_s, start_s + 0.8 * cycle_s])] {
                for mass in masses(factor, window_s, Some(1.01 * stated)) {
                    assert_eq!(mass, Mass { kg: 1.01 * stated, source: MassSource::Standing }, "shorter than a cycle");
                }
            }
        }
    }
    // Somebody else, or somebody who also stands next to the plates.
    let window_s = Some([0.1 * cycle_s, 1.3 * cycle_s]);
    for mass in masses(0.9, window_s, Some(1.1 * stated)).into_iter().chain(masses(1.1, window_s, None)) {
        assert_eq!(mass, Mass { kg: stated, source: MassSource::Model });
    }
}

fn laboratory_file(path: &Path) -> LaboratoryFile {
    LaboratoryFile::from_c3d(std::fs::read(path).unwrap(), "trial", &mut Findings::default()).unwrap()
}

fn without_stated_mass(trial: &Path, standing: Option<&Path>) -> Source {
    let mut trial = laboratory_file(trial);
    trial.subject.mass_kg = None;
    let standing = standing.map(|path| {
        let mut still = standing_trial(&mut Findings::default(), |_| Ok::<_, ()>(laboratory_file(path))).unwrap();
        still.subject.mass_kg = None;
        still.recording.plates.clear();
        Arc::new(StandingTrial::new(still))
    });
    Source::markers(MarkerSource {
        trial,
        standing,
        body: MarkerBody::BuiltIn { table: SegmentTable::DeLevaMale, mass_kg: None, height_m: None, set: None },
        plates: Vec::new(),
    })
}

fn shown(name: &str, mass: &BodyMass) {
    println!(
        "{name}: {:.2} kg by {}, {}, plates {:?}",
        mass.kg,
        mass.source.words(),
        mass.state.word(),
        mass.plates_kg
    );
    for one in &mass.sources {
        println!("    {:?} {:.2} ± {:.2} kg, {} times", one.by, one.kg, one.error_kg, one.times);
    }
}

/// File, standing trial, least and largest mass [kg].
const WALKS: [(&str, Option<&str>, f64, f64); 9] = [
    ("opensim-core-fast-walk/walking2.c3d", None, 63.5, 68.5),
    ("opensim-core-fast-walk/walking5.c3d", None, 63.5, 68.5),
    ("opensim-core-fast-walk/test_walking.c3d", None, 63.5, 68.5),
    ("motonms-unipd/Walking1.c3d", Some("motonms-unipd/Static1.c3d"), 80.5, 85.0),
    ("motonms-unipd/Walking2.c3d", Some("motonms-unipd/Static1.c3d"), 80.5, 85.0),
    ("motonms-unipd/Walking3.c3d", Some("motonms-unipd/Static1.c3d"), 80.5, 85.0),
    ("motonms-unipd/Walking4.c3d", Some("motonms-unipd/Static1.c3d"), 80.5, 85.0),
    ("motonms-unipd/Walking5.c3d", Some("motonms-unipd/Static1.c3d"), 80.5, 85.0),
    ("btkdata-pig-adult3plates/PiG_Motion3_FF.c3d", None, 71.0, 75.5),
];

#[test]
fn walkers_without_a_stated_mass_are_weighed() {
    let Some(folder) = data() else { return };
    for (walk, standing, least, most) in WALKS {
        let standing = standing.map(|standing| folder.join(standing));
        let (outcome, findings) = run(&without_stated_mass(&folder.join(walk), standing.as_deref()));
        shown(walk, &outcome.mass);
        assert!((least..=most).contains(&outcome.mass.kg), "{walk}: {:?}", outcome.mass);
        assert!(findings.has(Code::MassWeighed) && outcome.mass.state == MassState::Weighed, "{walk}");
    }
}

#[test]
fn weight_next_to_the_plates_is_not_a_lighter_person() {
    let Some(folder) = data() else { return };
    for person in PEOPLE.iter().take(2) {
        let mut source = person.source(&folder);
        let Recording::Markers(markers) = &mut source.recording else { panic!("no markers") };
        for plate in &mut markers.trial.recording.plates {
            plate.force.iter_mut().for_each(|force| *force *= 0.6);
            plate.moment.iter_mut().for_each(|moment| *moment *= 0.6);
        }
        let (outcome, findings) = run(&source);
        shown("0.6 of the weight", &outcome.mass);
        assert_eq!(outcome.mass.source, MassWitness::Standing);
        assert!(findings.has(Code::MassContradicted), "{:?}", findings.as_slice());
        assert_eq!(outcome.mass.state, MassState::Contradicted, "the plates of the walk carry another weight");
        assert!((outcome.mass.kg / outcome.mass.plates_kg.unwrap() - 1.0 / 0.6).abs() < 0.05, "{:?}", outcome.mass);
    }
}

#[test]
fn people_weigh_in_motion_what_they_weigh_standing() {
    let Some(folder) = data() else { return };
    for person in &PEOPLE {
        let (outcome, _) = run(&person.source(&folder));
        shown("stated and standing", &outcome.mass);
        let (moving, standing) = (outcome.mass.in_motion(), outcome.mass.by(MassWitness::Standing));
        let (Some(moving), Some(standing)) = (moving, standing) else { continue };
        let error_kg = moving.error_kg.hypot(standing.error_kg);
        assert!((moving.kg - standing.kg).abs() < 3.5 * error_kg, "{moving:?} {standing:?}");
    }
}
