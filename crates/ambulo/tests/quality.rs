//! Quality of the data: clean recordings are good, spoiled copies of them never are.

use crate::plug_in_gait::PEOPLE;
use crate::shared_data::data;
use ambulo::analysis::feasibility::VerdictState;
use ambulo::findings::Findings;
use ambulo::formats::external_loads::ExternalLoads;
use ambulo::formats::table::Table;
use ambulo::model::Model;
use ambulo::motion::filter::LowPass;
use ambulo::motion::force_plate::PlateRecording;
use ambulo::motion::{ForceRecording, Motion, Smoother, coordinates_from_table, force_recordings};
use ambulo::spatial::Vec3;
use ambulo::study::{
    self, GroundSettings, LaboratoryFile, MarkerBody, Measure, MeasuredForces, Quality, QualityLimits, QualityState,
    Recording, Settings, Source, StandingTrial,
};
use std::path::Path;
use std::sync::Arc;

/// A way to spoil a recording, and a measure that must find it.
struct Spoiled {
    what: &'static str,
    measure: Measure,
    spoil: fn(&mut Source, &mut Settings),
}

const fn spoiled(what: &'static str, measure: Measure, spoil: fn(&mut Source, &mut Settings)) -> Spoiled {
    Spoiled { what, measure, spoil }
}

const SPOILED: [Spoiled; 14] = [
    spoiled("a body of 85 % of the mass", Measure::Mass, |source, _| {
        let Recording::Markers(markers) = &mut source.recording else { panic!("no markers") };
        let MarkerBody::BuiltIn { mass_kg: Some(mass_kg), .. } = &mut markers.body else { panic!("no stated mass") };
        *mass_kg *= 0.85;
        let mut still = LaboratoryFile::clone(markers.standing.as_ref().unwrap());
        still.recording.plates.clear();
        markers.standing = Some(Arc::new(StandingTrial::new(still)));
    }),
    spoiled("plates at 0.6 of the force", Measure::ResidualForce, |source, _| scale_plates(source, 0.6)),
    spoiled("plates at 1.4 times the force", Measure::ResidualForce, |source, _| scale_plates(source, 1.4)),
    spoiled("plates that were off", Measure::SilentPlates, |source, _| scale_plates(source, 0.0)),
    spoiled("plates with the signals of each other", Measure::UnassignedForces, |source, _| exchange_plates(source)),
    spoiled("plates with the lateral force mirrored", Measure::ForceDirections, |source, _| {
        each_plate(source, |plate| *plate = plate.flipped(0));
    }),
    spoiled("plates with the fore-aft force mirrored", Measure::ForceDirections, |source, _| {
        each_plate(source, |plate| *plate = plate.flipped(1));
    }),
    spoiled("plates 60 mm beside their place", Measure::PlatePlace, |source, _| {
        each_plate(source, |plate| {
            let axis = plate.axes().unwrap()[0];
            move_plate(plate, axis * 0.06 * axis.sum().signum());
        });
    }),
    spoiled("a walk on another scale than the standing trial", Measure::MarkerFit, |source, _| {
        each_marker(source, |_, position| *position *= 1.1);
    }),
    spoiled("a laboratory that shakes", Measure::Sliding, |source, _| {
        each_marker(source, |time_s, position| *position += Vec3::new(0.03, 0.03, 0.0) * (10.0 * time_s).sin());
    }),
    spoiled("plates that start 0.1 s late", Measure::ResidualMoment, |source, _| {
        each_plate(source, |plate| {
            let late = (0.1 / (plate.times[1] - plate.times[0])).round() as usize;
            for values in [&mut plate.force, &mut plate.moment] {
                values.rotate_right(late);
                values[..late].fill(Vec3::zeros());
            }
        });
    }),
    spoiled("a filter that removes the movement", Measure::LowCutoff, |_, settings| {
        settings.smoother = Smoother::Butterworth(LowPass { order: 3, cutoff_hz: 0.9 });
    }),
    spoiled("a filter that leaves the noise", Measure::HighCutoff, |_, settings| {
        settings.smoother = Smoother::Butterworth(LowPass { order: 3, cutoff_hz: 45.0 });
    }),
    spoiled("no forces at all", Measure::GroundForces, |_, settings| settings.ground = GroundSettings::NoContact),
];

fn scale_plates(source: &mut Source, factor: f64) {
    each_plate(source, |plate| {
        plate.force.iter_mut().for_each(|force| *force *= factor);
        plate.moment.iter_mut().for_each(|moment| *moment *= factor);
    });
}

fn each_plate(source: &mut Source, change: impl Fn(&mut PlateRecording)) {
    let Recording::Markers(markers) = &mut source.recording else { panic!("no markers") };
    markers.trial.recording.plates.iter_mut().for_each(change);
}

/// The plates keep their places and record what the other one measured.
fn exchange_plates(source: &mut Source) {
    let Recording::Markers(markers) = &mut source.recording else { panic!("no markers") };
    let [first, second] = &mut markers.trial.recording.plates[..] else { panic!("not two plates") };
    let apart = second.center() - first.center();
    for (corner, other) in first.corners.iter_mut().zip(&mut second.corners) {
        (*corner, *other) = (*other, *corner);
    }
    move_loads(first, apart);
    move_loads(second, -apart);
}

/// The plate and its loads are elsewhere.
fn move_plate(plate: &mut PlateRecording, by: Vec3) {
    plate.corners.iter_mut().for_each(|corner| *corner += by);
    move_loads(plate, by);
}

fn move_loads(plate: &mut PlateRecording, by: Vec3) {
    for (moment, force) in plate.moment.iter_mut().zip(&plate.force) {
        *moment += by.cross(force);
    }
}

/// Moves every marker of the walk, as a function of time [s] and its position in the laboratory.
fn each_marker(source: &mut Source, change: impl Fn(f64, &mut Vec3)) {
    let Recording::Markers(markers) = &mut source.recording else { panic!("no markers") };
    let recording = &mut markers.trial.recording.markers;
    for marker in &mut recording.markers {
        for (position, time_s) in marker.positions.iter_mut().zip(&recording.times) {
            change(*time_s, position);
        }
    }
}

fn quality(source: &Source, settings: &Settings) -> Quality {
    study::run(source.clone(), settings, &mut Findings::default()).unwrap().quality
}

fn predicted() -> Settings {
    Settings { ground: GroundSettings::Predicted, ..Settings::default() }
}

#[test]
fn walks_of_seven_people_are_good_with_measured_and_with_predicted_forces() {
    let Some(data) = data() else { return };
    for person in &PEOPLE {
        let predicted = study::run(person.source(&data), &predicted(), &mut Findings::default()).unwrap();
        for outcome in [&person.computed(&data).0, &predicted] {
            println!("{} {:?}", person.name, outcome.verdict.fit);
            let quality = &outcome.quality;
            assert_eq!(quality.state, QualityState::Good, "{}: {:?}", person.name, quality.reasons);
        }
    }
}

#[test]
fn spoiled_copies_are_never_good_and_the_reason_names_what_is_wrong() {
    let Some(data) = data() else { return };
    for person in &PEOPLE {
        for Spoiled { what, measure, spoil } in &SPOILED {
            let (mut source, mut settings) = (person.source(&data), Settings::default());
            spoil(&mut source, &mut settings);
            let quality = quality(&source, &settings);
            let found: Vec<_> = quality.reasons.iter().map(|reason| (reason.measure, reason.value)).collect();
            println!("{} {what}: {:?} {found:?}", person.name, quality.state);
            assert_ne!(quality.state, QualityState::Good, "{}: {what}", person.name);
            assert!(found.iter().any(|(found, _)| found == measure), "{}: {what}: {found:?}", person.name);
        }
    }
}

/// Gait2392's subject on a treadmill, with changed forces.
fn with_forces(data: &Path, change: impl FnMut(&mut ForceRecording)) -> study::Outcome {
    let folder = data.join("opensim-gait2392-subject01");
    let read = |name: &str| std::fs::read(folder.join(name)).unwrap();
    let mut findings = Findings::default();
    let model = Model::from_osim(&read("subject01_simbody.osim"), &mut findings).unwrap();
    let (angles, _) = Table::read_storage(&read("subject01_walk1_ik.mot")).unwrap();
    let motion = coordinates_from_table(&model, &angles, "walk", &mut findings).unwrap();
    let (plates, _) = Table::read_storage(&read("subject01_walk1_grf.mot")).unwrap();
    let (loads, _) = ExternalLoads::read(&read("subject01_walk1_grf.xml")).unwrap();
    let mut forces = force_recordings(&model, &loads, &plates, &mut findings).unwrap();
    forces.iter_mut().for_each(change);
    let source = Source::coordinates(model, motion).with_forces(MeasuredForces::OnBodies(forces));
    study::run(source, &Settings::default(), &mut findings).unwrap()
}

/// Plates that were switched off say nothing about the person.
#[test]
fn force_plates_that_carry_nothing_make_the_data_bad_and_the_movement_not_judged() {
    let Some(data) = data() else { return };
    for factor in [0.0, 0.02] {
        let outcome = with_forces(&data, |load| {
            load.force.iter_mut().chain(&mut load.moment).for_each(|value| *value *= factor);
        });
        let (verdict, quality) = (outcome.verdict, outcome.quality);
        assert_eq!(verdict.state, VerdictState::NotJudged, "{:?}", verdict.reasons);
        assert_eq!(quality.state, QualityState::Bad);
        assert!(
            quality.reasons.iter().any(|reason| reason.measure == Measure::MeasuredForces),
            "{:?}",
            quality.reasons
        );
    }
}

/// The feet are so near to each other's places that a treadmill's forces fit the whole body, though not the feet.
#[test]
fn forces_of_a_treadmill_that_are_late_are_outside_the_soles_and_the_quality_says_so() {
    let Some(data) = data() else { return };
    let found = |late_s: f64| {
        let outcome = with_forces(&data, |load| load.times.iter_mut().for_each(|time| *time += late_s));
        let reasons = outcome.quality.reasons.into_iter();
        reasons.filter(|reason| reason.measure == Measure::CenterOfPressure).map(|reason| reason.value).next()
    };
    assert_eq!(found(0.0), None);
    assert!(found(0.1).is_some_and(|outside_m| outside_m > 0.03));
}

#[test]
fn errors_of_the_data_are_not_held_against_the_movement_and_nothing_is_called_feasible_on_them() {
    let Some(data) = data() else { return };
    type Spoil = fn(&mut Source);
    let cases: [(&str, Spoil); 5] = [
        ("0.6 of the force", |source| scale_plates(source, 0.6)),
        ("1.4 of the force", |source| scale_plates(source, 1.4)),
        ("off", |source| scale_plates(source, 0.0)),
        ("exchanged", exchange_plates),
        ("markers of another scale", |source| each_marker(source, |_, position| *position *= 1.3)),
    ];
    for person in &PEOPLE[..3] {
        for (what, spoil) in cases {
            let mut source = person.source(&data);
            spoil(&mut source);
            let verdict = study::run(source, &Settings::default(), &mut Findings::default()).unwrap().verdict;
            println!("{} {what}: {:?} {:?}", person.name, verdict.state, verdict.undecided);
            assert_eq!(verdict.state, VerdictState::NotJudged, "{} {what}: {:?}", person.name, verdict.reasons);
        }
        // What the forces of the right size do not cause is the movement's fault.
        let mut source = person.source(&data);
        each_marker(&mut source, |_, position| position.z += 0.1);
        let verdict = study::run(source, &Settings::default(), &mut Findings::default()).unwrap().verdict;
        assert_eq!(verdict.state, VerdictState::Infeasible, "{} above its plates", person.name);
    }
}

#[test]
fn a_jump_of_a_coordinate_is_named_with_its_frame() {
    let Some(data) = data() else { return };
    let (outcome, _) = PEOPLE[0].computed(&data);
    let (model, grid) = (&outcome.body, outcome.analysis.trajectory.grid());
    let columns = model.coordinate_ids().map(|id| Some(outcome.analysis.trajectory.values(id).to_vec()));
    let mut motion = Motion { origin: "copied".to_owned(), times: grid.times(), columns: columns.collect() };
    let settings = Settings::default();
    let of = |motion: &Motion| quality(&Source::coordinates(model.clone(), motion.clone()), &settings);
    assert!(of(&motion).reasons.iter().all(|reason| reason.measure != Measure::Jumps));
    let knee = model.coordinate("knee_angle_r").unwrap().index();
    motion.columns[knee].as_mut().unwrap()[80..].iter_mut().for_each(|angle| *angle += 0.6);
    let quality = of(&motion);
    let jump = quality.reasons.iter().find(|reason| reason.measure == Measure::Jumps).unwrap();
    assert!(
        (jump.value - 1.0).abs() < 1e-12 && jump.message.contains("`knee_angle_r` at frame 81"),
        "{}",
        jump.message
    );
    assert_ne!(quality.state, QualityState::Good);
}

/// With AMBULO_WRITE=1 the table is written.
#[test]
fn the_table_in_the_documentation_has_the_limits() {
    let head = "| measure | meaning | good | bad | unit |\n|---|---|---|---|---|\n";
    let row = |measure: &Measure| {
        let (good, bad) = match measure.limits() {
            QualityLimits::AtMost(good, bad) => (format!("at most {good}"), format!("above {bad}")),
            QualityLimits::AtLeast(good, bad) => (format!("at least {good}"), format!("below {bad}")),
        };
        format!("| `{}` | {} | {good} | {bad} | {} |\n", measure.name(), measure.meaning(), measure.unit())
    };
    let table: String = std::iter::once(head.to_owned()).chain(Measure::ALL.iter().map(row)).collect();
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/JUDGEMENT.md");
    let text = std::fs::read_to_string(&path).unwrap();
    let start = text.find("| measure |").unwrap();
    let end = start + text[start..].find("\n\n").unwrap() + 1;
    if std::env::var_os("AMBULO_WRITE").is_some() {
        std::fs::write(&path, format!("{}{table}{}", &text[..start], &text[end..])).unwrap();
        return;
    }
    assert!(text[start..end] == table, "docs/JUDGEMENT.md is out of date; run this test with AMBULO_WRITE=1");
}
