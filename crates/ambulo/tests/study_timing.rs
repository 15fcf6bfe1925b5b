//! The clock of motion and forces: twins of real recordings whose forces are late, whose time is stretched or whose
//! frames repeat are named; the recordings themselves are silent.

use crate::plug_in_gait::PEOPLE;
use crate::shared_data::data;
use ambulo::findings::{Code, Findings};
use ambulo::formats::external_loads::ExternalLoads;
use ambulo::formats::table::Table;
use ambulo::ground::plates::ContactQuality;
use ambulo::model::Model;
use ambulo::motion::{coordinates_from_table, force_recordings};
use ambulo::spatial::Vec3;
use ambulo::study::{
    self, GroundSettings, Measure, MeasuredForces, Outcome, QualityState, Recording, Settings, Source, StudyError,
    Tracking,
};
use std::path::Path;

fn run(source: Source, settings: &Settings) -> (Outcome, Findings) {
    let mut findings = Findings::default();
    let outcome = study::run(source, settings, &mut findings).unwrap();
    (outcome, findings)
}

fn predicted() -> Settings {
    Settings { ground: GroundSettings::Predicted, ..Settings::default() }
}

/// The recording with plates that are late by this [s].
fn late(mut source: Source, by_s: f64) -> Source {
    let Recording::Markers(markers) = &mut source.recording else { panic!("no markers") };
    let plates = &mut markers.trial.recording.plates;
    plates.iter_mut().flat_map(|plate| &mut plate.times).for_each(|time| *time += by_s);
    source
}

/// The recording in slow motion by a factor, its force plates too.
fn stretched(mut source: Source, factor: f64) -> Source {
    let Recording::Markers(markers) = &mut source.recording else { panic!("no markers") };
    let trial = &mut markers.trial;
    trial.recording.markers.rate_hz /= factor;
    trial.recording.markers.times.iter_mut().for_each(|time| *time *= factor);
    trial.recording.plates.iter_mut().flat_map(|plate| &mut plate.times).for_each(|time| *time *= factor);
    trial.events.iter_mut().for_each(|event| event.time_s *= factor);
    source
}

fn has_measure(outcome: &Outcome, measure: Measure) -> bool {
    outcome.quality.reasons.iter().any(|reason| reason.measure == measure)
}

#[test]
fn plates_that_are_30_ms_late_or_early_are_found_with_their_sign_and_the_same_plates_in_time_are_not() {
    let Some(data) = data() else { return };
    for person in &PEOPLE {
        for by_s in [0.0_f64, 0.03, -0.03, 0.06] {
            let is_late = by_s.abs() > 0.0;
            let own;
            let (outcome, findings) = if is_late {
                own = run(late(person.source(&data), by_s), &Settings::default());
                &own
            } else {
                person.computed(&data)
            };
            let found = outcome.force_delay_s;
            println!("{} late by {by_s} s: found {found:?}, {:?}", person.name, outcome.quality.state);
            let is_named = findings.has(Code::ForcesDelayed);
            assert_eq!(is_named, is_late, "{} {by_s}", person.name);
            assert_eq!(has_measure(outcome, Measure::ForceDelay), is_named, "{} {by_s}", person.name);
            if is_named {
                // The two witnesses scatter by 5 ms together.
                assert!((found.unwrap() - by_s).abs() < 0.012, "{} {by_s}: {found:?}", person.name);
                assert_ne!(outcome.quality.state, QualityState::Good, "{} {by_s}", person.name);
            }
        }
    }
}

#[test]
fn a_stated_delay_brings_late_plates_back() {
    let Some(data) = data() else { return };
    let person = &PEOPLE[0];
    let (truth, _) = person.computed(&data);
    let settings = Settings { force_delay_s: 0.03, ..Settings::default() };
    let (mended, findings) = run(late(person.source(&data), 0.03), &settings);
    assert!(!findings.has(Code::ForcesDelayed));
    assert_eq!(mended.quality.state, QualityState::Good);
    let knee = truth.body.coordinate("knee_angle_r").unwrap().index();
    let peak = |outcome: &Outcome| outcome.analysis.forces.generalized[knee].iter().copied().fold(0.0, f64::max);
    assert!((peak(&mended) - peak(truth)).abs() < 0.05, "{} {}", peak(&mended), peak(truth));
    let (opposite, _) = run(late(person.source(&data), 0.03), &Settings { force_delay_s: -0.03, ..settings });
    assert!(opposite.force_delay_s.unwrap() > 0.045, "the opposite sign doubles the delay");
}

/// Gait2392's subject on a treadmill: forces in a table, without instrumented windows.
fn treadmill(data: &Path, late_s: f64) -> Source {
    let folder = data.join("opensim-gait2392-subject01");
    let read = |name: &str| std::fs::read(folder.join(name)).unwrap();
    let findings = &mut Findings::default();
    let model = Model::from_osim(&read("subject01_simbody.osim"), findings).unwrap();
    let (angles, _) = Table::read_storage(&read("subject01_walk1_ik.mot")).unwrap();
    let motion = coordinates_from_table(&model, &angles, "walk", findings).unwrap();
    let (plates, _) = Table::read_storage(&read("subject01_walk1_grf.mot")).unwrap();
    let (loads, _) = ExternalLoads::read(&read("subject01_walk1_grf.xml")).unwrap();
    let mut forces = force_recordings(&model, &loads, &plates, findings).unwrap();
    forces.iter_mut().flat_map(|force| &mut force.times).for_each(|time| *time += late_s);
    Source::coordinates(model, motion).with_forces(MeasuredForces::OnBodies(forces))
}

#[test]
fn late_forces_of_a_table_are_found_and_a_stated_delay_corrects_them() {
    let Some(data) = data() else { return };
    for late_s in [0.0, 0.03, -0.03] {
        let (outcome, findings) = run(treadmill(&data, late_s), &Settings::default());
        assert_eq!(findings.has(Code::ForcesDelayed), late_s.abs() > 0.0, "{late_s}: {:?}", outcome.force_delay_s);
        let (mended, _) = run(treadmill(&data, late_s), &Settings { force_delay_s: late_s, ..Settings::default() });
        assert_eq!(mended.force_delay_s, None, "{late_s}");
    }
}

#[test]
fn a_clock_that_is_wrong_by_a_factor_of_1_25_is_contradicted_by_force_plates() {
    let Some(data) = data() else { return };
    for person in &PEOPLE {
        for factor in [0.8, 1.0, 1.25] {
            let is_wrong = (factor - 1.0_f64).abs() > 0.1;
            let own;
            let (outcome, findings) = if is_wrong {
                own = run(stretched(person.source(&data), factor), &Settings::default());
                &own
            } else {
                person.computed(&data)
            };
            println!("{} {factor}: {:?}", person.name, outcome.quality.reasons);
            assert_eq!(findings.has(Code::MotionClock), is_wrong, "{} {factor}", person.name);
            assert_eq!(has_measure(outcome, Measure::Tempo), is_wrong, "{} {factor}", person.name);
        }
    }
}

/// The moments of one plate, or its place, contradict the balance of the body as a wrong clock does.
#[test]
fn plates_with_reversed_moments_do_not_make_a_clock_wrong() {
    let Some(data) = data() else { return };
    for person in &PEOPLE {
        let mut source = person.source(&data);
        let Recording::Markers(markers) = &mut source.recording else { panic!("no markers") };
        for plate in &mut markers.trial.recording.plates {
            let centre = plate.corners.iter().sum::<Vec3>() * 0.25;
            for (moment, force) in plate.moment.iter_mut().zip(&plate.force) {
                *moment = centre.cross(force) * 2.0 - *moment;
            }
        }
        let (outcome, findings) = run(source, &Settings::default());
        println!("{}: {:?} {:?}", person.name, outcome.quality.state, outcome.quality.reasons);
        assert!(!findings.has(Code::MotionClock), "{}", person.name);
    }
}

#[test]
fn a_plate_that_is_60_mm_from_its_place_along_the_walk_is_named() {
    let Some(data) = data() else { return };
    for person in &PEOPLE {
        let (clean, findings) = person.computed(&data);
        assert!(!findings.has(Code::PlatesMisplaced), "{}", person.name);
        let Some(Tracking::Markers(tracked)) = &clean.tracking else { panic!("no markers") };
        let used = tracked.body.on_plates.contacts.iter().find(|contact| contact.quality == ContactQuality::Clean);
        let (moved, side) = used.map(|contact| (contact.plate, contact.side.unwrap())).unwrap();
        let mut named = 0;
        for (by_m, way) in [(0.06, "ahead"), (-0.06, "behind")] {
            let mut source = person.source(&data);
            let Recording::Markers(markers) = &mut source.recording else { panic!("no markers") };
            let recording = &mut markers.trial.recording;
            let toe = &recording.markers.marker("RTOE").unwrap().positions;
            let walked = toe[toe.len() - 1] - toe[0];
            let shift = Vec3::new(walked.x, walked.y, 0.0).normalize() * by_m;
            let plate = &mut recording.plates[moved];
            plate.corners.iter_mut().for_each(|corner| *corner += shift);
            // Moments are about the origin of the laboratory.
            let forces = plate.force.clone();
            plate.moment.iter_mut().zip(&forces).for_each(|(moment, force)| *moment += shift.cross(force));
            let (outcome, findings) = run(source, &Settings::default());
            let said = findings.as_slice().iter().find(|finding| finding.code == Code::PlatesMisplaced);
            println!("{} {side} {by_m}: {:?}", person.name, said.map(|finding| &finding.message));
            assert_eq!(said.is_some(), has_measure(&outcome, Measure::CenterOffset), "{} {by_m}", person.name);
            if let Some(said) = said {
                let place = format!(" mm {way} on plate {}", moved + 1);
                assert!(said.message.contains(&place), "{} {by_m}: {}", person.name, said.message);
                named += 1;
            }
        }
        assert_eq!(named, 2, "{}", person.name);
    }
}

#[test]
fn a_clock_that_is_wrong_by_a_factor_of_1_6_is_contradicted_by_the_gait_alone() {
    let Some(data) = data() else { return };
    for person in &PEOPLE {
        for factor in [0.625, 1.0, 1.6] {
            let mut source = stretched(person.source(&data), factor);
            let Recording::Markers(markers) = &mut source.recording else { panic!("no markers") };
            markers.trial.recording.plates.clear();
            let (outcome, findings) = run(source, &predicted());
            let is_wrong = (factor - 1.0_f64).abs() > 0.1;
            println!("{} {factor}: {:?}", person.name, outcome.quality.reasons);
            assert_eq!(findings.has(Code::MotionClock), is_wrong, "{} {factor}", person.name);
            assert_eq!(has_measure(&outcome, Measure::Tempo), is_wrong, "{} {factor}", person.name);
        }
    }
}

#[test]
fn samples_that_are_seconds_apart_are_refused_with_what_they_look_like() {
    let Some(data) = data() else { return };
    let error = study::run(stretched(PEOPLE[0].source(&data), 1e4), &Settings::default(), &mut Findings::default());
    let Err(error @ StudyError::Clock { looks_like: "frames per second", .. }) = error else { panic!("{error:?}") };
    assert!(error.to_string().contains("0.0100000 s"), "{error}");
}

/// The markers of a frame that each frame shows.
fn played(mut source: Source, shown: impl Fn(usize) -> usize) -> Source {
    let Recording::Markers(markers) = &mut source.recording else { panic!("no markers") };
    for marker in &mut markers.trial.recording.markers.markers {
        let recorded = marker.positions.clone();
        (0..recorded.len()).for_each(|frame| marker.positions[frame] = recorded[shown(frame)]);
    }
    source
}

#[test]
fn frames_that_repeat_are_gaps_and_the_moments_are_those_of_the_recording() {
    let Some(data) = data() else { return };
    let person = &PEOPLE[0];
    let (truth, findings) = person.computed(&data);
    assert!(!findings.has(Code::MotionHeldFrames));
    let said = |findings: &Findings| {
        let mut held = findings.as_slice().iter().filter(|finding| finding.code == Code::MotionHeldFrames);
        held.next().map(|finding| finding.message.clone()).unwrap_or_default()
    };
    for (every, pattern) in [(2, "every second frame"), (5, "20 frames per second that were held as 100")] {
        let (outcome, findings) =
            run(played(person.source(&data), |frame| frame / every * every), &Settings::default());
        assert!(said(&findings).contains(pattern), "{}", said(&findings));
        for name in ["hip_flexion_r", "knee_angle_r", "ankle_angle_r"] {
            let id = truth.body.coordinate(name).unwrap().index();
            let of = |outcome: &Outcome| {
                let grid = outcome.analysis.trajectory.grid();
                let inside = (0..grid.frames).filter(|i| (1.8..2.6).contains(&grid.time(*i)));
                inside.map(|i| outcome.analysis.forces.generalized[id][i]).collect::<Vec<f64>>()
            };
            let apart = of(truth).iter().zip(of(&outcome)).map(|(a, b)| (a - b).powi(2)).sum::<f64>();
            let rms = (apart / of(truth).len() as f64).sqrt() / 60.3;
            println!("every {every}: {name} {rms:.3} N.m/kg");
            assert!(rms < 0.1, "{every} {name}: {rms} N.m/kg");
        }
    }
    let (outcome, findings) = run(played(person.source(&data), |frame| frame.min(100)), &Settings::default());
    assert!(said(&findings).contains("frozen from 2.560 s on"), "{}", said(&findings));
    let grid = outcome.analysis.trajectory.grid();
    assert!(grid.end_s() < 2.57, "the frozen part is left out: {}", grid.end_s());
}
