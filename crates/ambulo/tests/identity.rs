//! Whose markers these are: spoiled copies of real recordings are named or mended, clean ones are silent.
//!
//! | claim | tolerance |
//! |---|---|
//! | exchanged labels, of all markers, of a pair or within a leg, are undone where they are wrong | exact |
//! | a marker that the standing trial lacks is placed by the walk: angle of the ankle, mean over the frames | 3 degrees |
//! | labels exchanged for a fifth of a walk without standing trial: moments of the knees, rms | 0.1 N.m/kg |
//! | a marker that moved by 40 mm is named; another person's standing trial is | - |
//! | in a folder of several people each gets the own standing trial | exact |
//! | clean recordings have none of these findings | exact |

use crate::plug_in_gait::{PEOPLE, Person};
use crate::shared_data::data;
use ambulo::analysis::MarkerTrialError;
use ambulo::findings::{Code, Findings};
use ambulo::job::trials::{FoundFile, Listing, TrialFolder, Wanted};
use ambulo::job::{FileError, Job};
use ambulo::model::{Marker, Model};
use ambulo::motion::{MarkerPath, MarkerRecording};
use ambulo::spatial::Vec3;
use ambulo::study::{
    self, LaboratoryFile, MarkerBody, MarkerSource, Outcome, QualityState, Recording, Settings, Source, StandingTrial,
    StudyError,
};
use std::path::Path;
use std::sync::Arc;

const CODES: [Code; 6] = [
    Code::MarkersNotMeasured,
    Code::MarkersSidesExchanged,
    Code::MarkersMoved,
    Code::CalibrationOtherLimbs,
    Code::CalibrationPlaced,
    Code::MarkersArms,
];

/// The markers of a source.
fn markers(source: &mut Source) -> &mut MarkerSource {
    let Recording::Markers(markers) = &mut source.recording else { panic!("no markers") };
    markers
}

fn change_walk(source: &mut Source, change: impl Fn(&mut MarkerRecording)) {
    change(&mut markers(source).trial.recording.markers);
}

fn change_standing(source: &mut Source, change: impl Fn(&mut MarkerRecording)) {
    let mut still = LaboratoryFile::clone(markers(source).standing.as_ref().unwrap());
    change(&mut still.recording.markers);
    markers(source).standing = Some(Arc::new(StandingTrial::new(still)));
}

fn path<'a>(recording: &'a mut MarkerRecording, name: &str) -> &'a mut MarkerPath {
    recording.markers.iter_mut().find(|marker| marker.name == name).unwrap()
}

fn hide(recording: &mut MarkerRecording, name: &str) {
    path(recording, name).positions.fill(Vec3::repeat(f64::NAN));
}

/// Exchanges the first letters R and L of all names that have a partner.
fn exchange_all(recording: &mut MarkerRecording) {
    let names: Vec<String> = recording.markers.iter().map(|marker| marker.name.clone()).collect();
    for marker in &mut recording.markers {
        let other = match marker.name.split_at(1) {
            ("R", rest) => format!("L{rest}"),
            ("L", rest) => format!("R{rest}"),
            _ => continue,
        };
        if names.contains(&other) {
            marker.name = other;
        }
    }
}

fn exchange_pair(recording: &mut MarkerRecording, a: &str, b: &str) {
    let positions = path(recording, a).positions.clone();
    path(recording, a).positions = std::mem::replace(&mut path(recording, b).positions, positions);
}

fn run(source: Source) -> (Outcome, Findings) {
    let mut findings = Findings::default();
    let outcome = study::run(source, &Settings::default(), &mut findings).unwrap();
    (outcome, findings)
}

fn source(person: &Person, data: &Path) -> Source {
    person.source(data)
}

/// A coordinate over the frames [deg].
fn angle(outcome: &Outcome, name: &str) -> Vec<f64> {
    let id = outcome.body.coordinate(name).unwrap();
    outcome.analysis.trajectory.values(id).iter().map(|value| value.to_degrees()).collect()
}

/// Mean difference of an angle [deg].
fn apart(a: &Outcome, b: &Outcome, name: &str) -> f64 {
    let (a, b) = (angle(a, name), angle(b, name));
    assert_eq!(a.len(), b.len());
    a.iter().zip(&b).map(|(a, b)| (a - b).abs()).sum::<f64>() / a.len() as f64
}

fn message(findings: &Findings, code: Code) -> String {
    let own = findings.as_slice().iter().find(|finding| finding.code == code);
    own.map_or_else(|| panic!("no {code}: {findings:?}"), |finding| finding.message.clone())
}

#[test]
fn clean_recordings_are_silent() {
    let Some(data) = data() else { return };
    for person in &PEOPLE {
        let (outcome, findings) = person.computed(&data);
        let found: Vec<_> = findings.as_slice().iter().filter(|finding| CODES.contains(&finding.code)).collect();
        assert!(found.is_empty(), "{}: {found:?}", person.name);
        assert!(outcome.not_measured.is_empty(), "{}", person.name);
    }
}

#[test]
fn a_marker_that_only_the_standing_trial_lacks_is_placed_by_the_walk() {
    let Some(data) = data() else { return };
    for person in &PEOPLE[..3] {
        let (clean, _) = person.computed(&data);
        for lost in [&["RTOE"][..], &["RHEE"], &["LANK"], &["RKNE"], &["LASI"]] {
            let mut spoiled = source(person, &data);
            change_standing(&mut spoiled, |still| lost.iter().for_each(|name| hide(still, name)));
            let (found, findings) = run(spoiled);
            let side = lost[0][..1].to_lowercase();
            let [ankle, knee] =
                ["ankle_angle", "knee_angle"].map(|stem| apart(clean, &found, &format!("{stem}_{side}")));
            println!("{} {lost:?}: ankle {ankle:.1}, knee {knee:.1} degrees", person.name);
            assert!(ankle < 3.0 && knee < 4.0, "{} {lost:?}: {ankle} {knee}", person.name);
            assert!(message(&findings, Code::CalibrationPlaced).contains(lost[0]));
            assert!(!findings.has(Code::CalibrationOtherLimbs) && !findings.has(Code::MarkersMoved));
            assert!(found.not_measured.is_empty());
        }
    }
}

/// A given model with a marker 40 mm from its place on the person: the standing trial moves it there, or, where it does
/// not show the marker, the walk.
#[test]
fn a_marker_of_a_given_model_that_only_the_standing_trial_lacks_is_placed_by_the_walk() {
    let Some(data) = data() else { return };
    let folder = data.join("opensim-gait2392-subject01");
    let read = |name: &str| std::fs::read(folder.join(name)).unwrap();
    let model = Model::from_osim(&read("subject01_simbody.osim"), &mut Findings::default()).unwrap();
    let trial = |name: &str| LaboratoryFile::from_trc(read(name), name, &mut Findings::default()).unwrap();
    let source = |lost: &str| {
        let displaced = |marker: &Marker| match marker.name == lost {
            true => Marker { location: marker.location + Vec3::new(0.03, 0.02, 0.02), ..marker.clone() },
            false => marker.clone(),
        };
        let model = model.with_markers(model.markers().iter().map(displaced).collect()).unwrap();
        Source::markers(MarkerSource {
            trial: trial("subject01_walk1.trc"),
            standing: Some(Arc::new(StandingTrial::new(trial("subject01_static.trc")))),
            body: MarkerBody::Model { model, mass_kg: None, protocol: None },
            plates: Vec::new(),
        })
    };
    for (lost, coordinate) in
        [("R.Shank.Upper", "knee_angle_r"), ("R.Toe.Tip", "ankle_angle_r"), ("L.Thigh.Front", "hip_rotation_l")]
    {
        let (clean, findings) = run(source(lost));
        assert!(!findings.has(Code::CalibrationPlaced));
        let mut spoiled = source(lost);
        change_standing(&mut spoiled, |still| hide(still, lost));
        let (found, findings) = run(spoiled);
        let angle = apart(&clean, &found, coordinate);
        println!("{lost}: {coordinate} {angle:.2} degrees");
        assert!(message(&findings, Code::CalibrationPlaced).contains(lost));
        assert!(angle < 1.0, "{lost}: {angle}");
    }
}

#[test]
fn a_joint_that_nothing_determines_is_named_and_not_measured() {
    let Some(data) = data() else { return };
    let mut spoiled = source(&PEOPLE[0], &data);
    let lost = ["RTOE", "RHEE", "RHLX", "RD1M", "RD5M", "RP1M", "RP5M", "RLCA", "RSTL", "RPCA", "RCPG", "RNAV"];
    let hide_all = |recording: &mut MarkerRecording| {
        recording.markers.retain(|marker| !lost.contains(&marker.name.as_str()));
    };
    change_standing(&mut spoiled, hide_all);
    change_walk(&mut spoiled, hide_all);
    let (outcome, findings) = run(spoiled);
    let names: Vec<&str> =
        outcome.not_measured.iter().map(|id| outcome.body.coordinates()[id.index()].name.as_str()).collect();
    assert_eq!(names, ["ankle_angle_r"]);
    assert!(message(&findings, Code::MarkersNotMeasured).contains("`ankle_angle_r` is held at 0 degrees"));
    assert_ne!(outcome.quality.state, QualityState::Good);
}

#[test]
fn labels_of_left_and_right_that_are_exchanged_throughout_are_named_and_exchanged_back() {
    let Some(data) = data() else { return };
    for person in &PEOPLE[..2] {
        let (clean, _) = person.computed(&data);
        for (walk, still) in [(true, false), (false, true), (true, true)] {
            let mut spoiled = source(person, &data);
            if walk {
                change_walk(&mut spoiled, exchange_all);
            }
            if still {
                change_standing(&mut spoiled, exchange_all);
            }
            let (found, findings) = run(spoiled);
            assert!(
                message(&findings, Code::MarkersSidesExchanged).contains("left and right are exchanged in all labels")
            );
            assert_ne!(found.quality.state, QualityState::Good);
            for name in ["hip_flexion_r", "knee_angle_l", "ankle_angle_r"] {
                assert!(apart(clean, &found, name) < 1e-6, "{} {name}", person.name);
            }
        }
    }
}

#[test]
fn a_pair_that_is_exchanged_throughout_is_exchanged_back() {
    let Some(data) = data() else { return };
    let (clean, _) = PEOPLE[0].computed(&data);
    for [right, left] in [["RWRA", "LWRA"], ["RTHI", "LTHI"], ["RTIB", "LTIB"], ["RKNE", "LKNE"], ["RTOE", "LTOE"]] {
        for in_walk in [true, false] {
            let mut spoiled = source(&PEOPLE[0], &data);
            let exchange = |recording: &mut MarkerRecording| exchange_pair(recording, right, left);
            if in_walk {
                change_walk(&mut spoiled, exchange)
            } else {
                change_standing(&mut spoiled, exchange)
            }
            let (found, findings) = run(spoiled);
            assert!(message(&findings, Code::MarkersSwap).contains(right), "{right}");
            for name in ["hip_flexion_r", "knee_angle_l", "ankle_angle_r"] {
                assert!(apart(clean, &found, name) < 1e-6, "{right} {name}");
            }
        }
    }
}

/// Exchanged in the standing trial, the labels of the walk would be exchanged instead, and the joint would be
/// elsewhere.
#[test]
fn two_markers_of_a_leg_that_are_exchanged_in_one_recording_are_exchanged_back_there() {
    let Some(data) = data() else { return };
    // A woman and a small child.
    for person in [&PEOPLE[0], &PEOPLE[3]] {
        let (clean, _) = person.computed(&data);
        for [a, b] in [["LKNE", "LTHI"], ["RANK", "RTIB"], ["LHEE", "LTOE"], ["RANK", "RHEE"]] {
            for (in_walk, which) in [(true, "whole recording"), (false, "whole standing trial")] {
                let mut spoiled = source(person, &data);
                let exchange = |recording: &mut MarkerRecording| exchange_pair(recording, a, b);
                if in_walk {
                    change_walk(&mut spoiled, exchange)
                } else {
                    change_standing(&mut spoiled, exchange)
                }
                let (found, findings) = run(spoiled);
                let said = message(&findings, Code::MarkersSwap);
                assert!(said.contains(a) && said.contains(b) && said.contains(which), "{} {a}: {said}", person.name);
                for name in ["hip_flexion_l", "knee_angle_l", "ankle_angle_r"] {
                    assert!(apart(clean, &found, name) < 1e-6, "{} {a} {name}", person.name);
                }
            }
        }
    }
}

/// A body that is calibrated on the walk itself is that of the recording without the exchange.
#[test]
fn labels_that_are_exchanged_for_a_while_do_not_change_the_body_without_a_standing_trial() {
    let Some(data) = data() else { return };
    for person in &PEOPLE {
        let mut clean = source(person, &data);
        markers(&mut clean).standing = None;
        let mut spoiled = clean.clone();
        change_walk(&mut spoiled, |walk| {
            let frames = walk.frames() / 2..walk.frames() * 7 / 10;
            let of_left = path(walk, "LKNE").positions[frames.clone()].to_vec();
            let of_right = path(walk, "RKNE").positions[frames.clone()].to_vec();
            path(walk, "RKNE").positions[frames.clone()].copy_from_slice(&of_left);
            path(walk, "LKNE").positions[frames].copy_from_slice(&of_right);
        });
        let (clean, spoiled) = (run(clean).0, run(spoiled).0);
        for name in ["knee_angle_r", "knee_angle_l"] {
            let moments = |outcome: &Outcome| {
                let id = outcome.body.coordinate(name).unwrap().index();
                outcome.analysis.forces.generalized[id].clone()
            };
            let (own, other) = (moments(&spoiled), moments(&clean));
            let squares = own.iter().zip(&other).map(|(a, b)| (a - b).powi(2)).sum::<f64>();
            let rms = (squares / own.len() as f64).sqrt() / clean.analysis.mass.kg;
            println!("{} {name}: {rms:.3} N.m/kg", person.name);
            assert!(rms < 0.1, "{} {name}: {rms} N.m/kg", person.name);
        }
    }
}

#[test]
fn a_knee_marker_that_moved_by_40_mm_is_named() {
    let Some(data) = data() else { return };
    for person in &PEOPLE[..4] {
        let mut spoiled = source(person, &data);
        change_standing(&mut spoiled, |still| {
            let middle = |name: &str| still.markers.iter().find(|m| m.name == name).unwrap().positions[0];
            let ahead = (middle("RTOE") - middle("RHEE")).normalize();
            path(still, "RKNE").positions.iter_mut().for_each(|position| *position -= ahead * 0.04);
        });
        let (found, findings) = run(spoiled);
        let said = message(&findings, Code::MarkersMoved);
        assert!(said.contains("`RKNE`"), "{}: {said}", person.name);
        assert_ne!(found.quality.state, QualityState::Good);
    }
}

/// Two people of the same marker set and nearly the same size.
#[test]
fn the_standing_trial_of_a_person_of_like_size_is_named() {
    let Some(data) = data() else { return };
    let folder = data.join("adults-rehazenter");
    let mut files = |path: &Path| std::fs::read(path).map_err(FileError::from);
    for [walker, stander] in [["2014048", "2015007"], ["2014001", "2014048"]] {
        let standing = folder.join(format!("{stander}/{stander}_ST.c3d"));
        let walk = std::fs::read_dir(folder.join(walker)).unwrap().map(|entry| entry.unwrap().path());
        let walk = walk.filter(|path| !path.ends_with(format!("{walker}_ST.c3d"))).min().unwrap();
        let job = Job { standing: Some(standing), ..Job::of(walk) };
        let (_, findings) = run(job.read(&mut files, &mut Findings::default()).unwrap().source);
        assert!(message(&findings, Code::CalibrationOtherLimbs).contains("another person"), "{walker} {stander}");
    }
}

#[test]
fn the_standing_trial_of_another_person_is_named_by_the_limbs() {
    let Some(data) = data() else { return };
    let (child, adult) = (&PEOPLE[3], &PEOPLE[0]);
    let mut spoiled = source(adult, &data);
    markers(&mut spoiled).standing = markers(&mut source(child, &data)).standing.clone();
    let (found, findings) = run(spoiled);
    assert!(message(&findings, Code::CalibrationOtherLimbs).contains("another person"));
    assert_ne!(found.quality.state, QualityState::Good);
}

/// Both recordings in one, with prefixes.
fn together(a: &MarkerRecording, b: &MarkerRecording) -> MarkerRecording {
    let frames = a.frames().min(b.frames());
    let named = |prefix: &'static str, recording: &MarkerRecording| -> Vec<MarkerPath> {
        let path = |marker: &MarkerPath| MarkerPath {
            name: format!("{prefix}:{}", marker.name),
            positions: marker.positions[..frames].to_vec(),
        };
        recording.markers.iter().map(path).collect()
    };
    let markers = [named("Anna", a), named("Ben", b)].concat();
    MarkerRecording { markers, times: a.times[..frames].to_vec(), ..a.clone() }
}

#[test]
fn two_people_in_one_file_are_refused_with_their_names_and_one_can_be_chosen() {
    let Some(data) = data() else { return };
    let (mut anna, mut ben) = (source(&PEOPLE[0], &data), source(&PEOPLE[1], &data));
    let both = together(&markers(&mut anna).trial.recording.markers, &markers(&mut ben).trial.recording.markers);
    markers(&mut anna).trial.recording.markers = both;
    let refused = study::run(anna.clone(), &Settings::default(), &mut Findings::default()).unwrap_err();
    assert!(
        matches!(&refused, StudyError::Markers(MarkerTrialError::SeveralPeople { people, .. }) if *people == ["Anna",
            "Ben"])
    );
    let file = markers(&mut anna).trial.clone();
    let chosen = file.clone().of_person(Some("anna")).unwrap();
    assert!(chosen.recording.markers.marker("RASI").is_some() && chosen.recording.markers.marker("Ben:RASI").is_none());
    let error = file.of_person(Some("Carl")).unwrap_err().to_string();
    assert!(error.contains("`Carl`") && error.contains("Anna, Ben"), "{error}");
    markers(&mut anna).trial = chosen;
    let (clean, found) = (&PEOPLE[0].computed(&data).0, run(anna).0);
    let (clean, found) = (angle(clean, "knee_angle_r"), angle(&found, "knee_angle_r"));
    assert!(clean.iter().zip(&found).take(40).all(|(a, b)| (a - b).abs() < 0.5));
}

#[test]
fn in_a_folder_of_several_people_each_recording_gets_the_standing_trial_of_its_person() {
    let Some(data) = data() else { return };
    let file = |name: &str| FoundFile {
        path: data.join(format!("biomechzoo-{}/{name}.c3d", &name[..6])),
        name: format!("{name}.c3d"),
        folder: String::new(),
    };
    let people = [("HC031A01", "HC031A06"), ("HC032A01", "HC032A03"), ("HC033A01", "HC033A10")];
    let mut found: Vec<FoundFile> = people.iter().flat_map(|(still, walk)| [file(still), file(walk)]).collect();
    // The walk of a person whose standing trial is not there.
    found.push(file("HC055A09"));
    let mut files = |path: &Path| std::fs::read(path).map_err(FileError::from);
    let folder = TrialFolder { path: &data, name: "laboratory", wanted: Wanted::Motion };
    let listing = Listing::of_folder(folder, &found, &mut files).unwrap();
    let contents: Vec<_> = (0..listing.recordings()).map(|k| listing.content(k, &mut files)).collect();
    let plan = listing.plan(&contents, &mut files);
    assert_eq!(plan.trials.len(), 4, "{:?}", plan.others);
    for trial in &plan.trials {
        let standing = trial.files.standing.as_ref().map(|path| path.file_stem().unwrap().to_str().unwrap());
        let own = people.iter().find(|(_, walk)| trial.name.starts_with(walk)).map(|(still, _)| *still);
        assert_eq!(standing, own, "{}", trial.name);
    }
}
