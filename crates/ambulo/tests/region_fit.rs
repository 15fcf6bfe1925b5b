//! Quality by region: arms and trunk that do not follow their markers spoil neither legs nor quality.
//!
//! | claim | tolerance |
//! |---|---|
//! | an elbow marker 200 mm from its place: moments of the legs | 0.02 N.m/kg, rms |
//! | a hand that is lost for most of the recording takes no frame from the legs; their moments | 0.02 N.m/kg, rms |
//! | a trunk marker that is loose: moments of the legs from plates | 0.05 N.m/kg, rms |
//! | markers of the trunk, of the arms or of the legs 100 mm away: the region is named, and only legs are bad | - |

use crate::plug_in_gait::PEOPLE;
use crate::shared_data::data;
use ambulo::findings::{Code, Findings};
use ambulo::model::anthropometry::{Build, SegmentTable};
use ambulo::model::full_body::full_body;
use ambulo::model::{Region, Side};
use ambulo::motion::MarkerRecording;
use ambulo::spatial::Vec3;
use ambulo::study::{self, Measure, Outcome, QualityState, Recording, RegionFit, Settings, Source};
use std::path::Path;

const LEGS: [&str; 3] = ["hip_flexion", "knee_angle", "ankle_angle"];

/// A walk of the first person, whose markers are changed.
fn run(data: &Path, change: impl Fn(&mut MarkerRecording)) -> (Outcome, Findings) {
    let mut source: Source = PEOPLE[0].source(data);
    let Recording::Markers(markers) = &mut source.recording else { panic!("no markers") };
    change(&mut markers.trial.recording.markers);
    let mut findings = Findings::default();
    let outcome = study::run(source, &Settings::default(), &mut findings).unwrap();
    (outcome, findings)
}

/// Moves markers; `by` gives the displacement [m] at a time [s].
fn move_markers(recording: &mut MarkerRecording, names: &[&str], by: impl Fn(f64) -> Vec3) {
    let times = recording.times.clone();
    for marker in recording.markers.iter_mut().filter(|marker| names.contains(&marker.name.as_str())) {
        marker.positions.iter_mut().zip(&times).for_each(|(position, time_s)| *position += by(*time_s));
    }
}

/// Largest change of a sagittal moment of a leg, root mean square over the frames [N.m/kg].
fn change_of_moments(clean: &Outcome, found: &Outcome) -> f64 {
    let column = |outcome: &Outcome, name: &str| -> Vec<f64> {
        let id = outcome.body.coordinate(name).unwrap();
        outcome.analysis.forces.generalized[id.index()].iter().map(|moment| moment / outcome.analysis.mass.kg).collect()
    };
    let mut largest = 0.0_f64;
    for name in LEGS.iter().flat_map(|stem| Side::BOTH.map(|side| format!("{stem}_{}", side.letter()))) {
        let (a, b) = (column(clean, &name), column(found, &name));
        assert_eq!(a.len(), b.len());
        let square: f64 = a.iter().zip(&b).map(|(a, b)| (a - b).powi(2)).sum();
        largest = largest.max((square / a.len() as f64).sqrt());
    }
    println!("largest change of a moment: {largest:.4} N.m/kg");
    largest
}

fn regions(outcome: &Outcome) -> &[RegionFit] {
    outcome.tracking.as_ref().unwrap().regions()
}

fn rms_mm(outcome: &Outcome, region: Region) -> f64 {
    1e3 * regions(outcome).iter().find(|fit| fit.region == region).unwrap().rms_m
}

#[test]
fn an_elbow_marker_that_is_elsewhere_spoils_neither_legs_nor_quality() {
    let Some(data) = data() else { return };
    let (clean, _) = run(&data, |_| ());
    for by in [Vec3::new(0.2, 0.0, 0.0), Vec3::new(0.0, 0.0, 0.2)] {
        let (found, findings) = run(&data, |markers| move_markers(markers, &["RELB"], |_| by));
        let arms = regions(&found).iter().find(|fit| fit.region == Region::Arms).unwrap();
        println!("legs {:.1} mm, arms {:?}", rms_mm(&found, Region::Legs), &arms.markers[..3]);
        assert!(change_of_moments(&clean, &found) < 0.02);
        assert!((rms_mm(&found, Region::Legs) - rms_mm(&clean, Region::Legs)).abs() < 0.5);
        assert_eq!(arms.markers[0].0, "RELB");
        assert_eq!(found.quality.state, QualityState::Good, "{:?}", found.quality.reasons);
        assert_eq!(found.verdict.state, clean.verdict.state, "{:?}", found.verdict);
        assert!(findings.has(Code::MarkersArms) || findings.has(Code::MarkersMisplaced));
    }
}

#[test]
fn a_lost_hand_takes_no_time_from_the_legs() {
    let Some(data) = data() else { return };
    let hand = ["RWRA", "RWRB", "RFIN"];
    let (clean, _) = run(&data, |_| ());
    for (from, to) in [(0.0, 1.0), (0.4, 1.0), (0.2, 0.8)] {
        let (found, _) = run(&data, |recording| {
            let frames = recording.frames();
            for marker in recording.markers.iter_mut().filter(|marker| hand.contains(&marker.name.as_str())) {
                let lost = (from * frames as f64) as usize..(to * frames as f64) as usize;
                marker.positions[lost].fill(Vec3::repeat(f64::NAN));
            }
        });
        assert!(change_of_moments(&clean, &found) < 0.02);
        assert_eq!(found.quality.state, QualityState::Good, "{:?}", found.quality.reasons);
    }
}

#[test]
fn a_loose_trunk_marker_is_in_the_region_of_the_trunk() {
    let Some(data) = data() else { return };
    let (clean, _) = run(&data, |_| ());
    let shake = |time_s: f64| Vec3::new(0.0, 0.0, 0.08) * (9.0 * time_s).sin();
    let (found, _) = run(&data, |markers| move_markers(markers, &["C7"], shake));
    let trunk = regions(&found).iter().find(|fit| fit.region == Region::Trunk).unwrap();
    println!("trunk {:?}, before {:.1} mm", trunk.markers, rms_mm(&clean, Region::Trunk));
    assert_eq!(trunk.markers[0].0, "C7");
    assert!(rms_mm(&found, Region::Trunk) > rms_mm(&clean, Region::Trunk));
    assert!(change_of_moments(&clean, &found) < 0.05);
    assert_ne!(found.quality.state, QualityState::Bad, "{:?}", found.quality.reasons);
}

#[test]
fn the_region_that_does_not_fit_is_named_and_only_legs_are_bad() {
    let Some(data) = data() else { return };
    // Markers of one region that contradict each other: every second one is moved the other way.
    let apart = |markers: &mut MarkerRecording, names: &[&str], by: Vec3| {
        for (k, name) in names.iter().enumerate() {
            let sign = if k % 2 == 0 { 1.0 } else { -1.0 };
            move_markers(markers, &[name], |_| by * sign);
        }
    };
    let trunk = ["C7", "T10", "CLAV", "STRN", "RBAK"];
    let (found, findings) = run(&data, |markers| apart(markers, &trunk, Vec3::new(0.0, 0.1, 0.1)));
    println!("{:?}\n{:?}", found.quality, regions(&found));
    assert!(findings.has(Code::MarkersTrunk) && !findings.has(Code::MarkersArms));
    assert!(found.quality.reasons.iter().any(|reason| reason.measure == Measure::TrunkFit));
    assert_ne!(found.quality.state, QualityState::Bad, "{:?}", found.quality.reasons);
    let arms = ["RELB", "RWRA", "RWRB", "LELB", "LWRA", "LWRB"];
    let (found, findings) = run(&data, |markers| apart(markers, &arms, Vec3::new(0.1, 0.0, 0.1)));
    assert!(findings.has(Code::MarkersArms) && !findings.has(Code::MarkersTrunk), "{:?}", regions(&found));
    assert_eq!(found.quality.state, QualityState::Good, "{:?}", found.quality.reasons);
    let legs = ["RKNE", "RANK", "RTIB", "RTHI", "LKNE", "LANK", "LTIB", "LTHI"];
    let (found, findings) = run(&data, |markers| apart(markers, &legs, Vec3::new(0.1, 0.0, 0.1)));
    assert!(!findings.has(Code::MarkersArms) && !findings.has(Code::MarkersTrunk), "{:?}", regions(&found));
    assert_eq!(found.quality.state, QualityState::Bad);
    let of_fit = found.quality.reasons.iter().find(|reason| reason.measure == Measure::MarkerFit).unwrap();
    assert!(of_fit.message.contains("pelvis and legs"), "{}", of_fit.message);
}

#[test]
fn every_body_has_its_region() {
    let build = Build { table: SegmentTable::DeLevaMale, mass: 70.0, height: 1.74, toe_joint: true };
    let model = full_body(&build).unwrap().model;
    for body in model.body_ids() {
        let name = model.bodies()[body.index()].name.as_str();
        let expected = match name.split('_').next().unwrap() {
            "torso" => Region::Trunk,
            "humerus" | "forearm" => Region::Arms,
            _ => Region::Legs,
        };
        assert_eq!(Region::of(&model, body), expected, "{name}");
    }
    let elbow = model.coordinate("elbow_flex_l").unwrap();
    assert_eq!(Region::of_coordinate(&model, elbow), Some(Region::Arms));
}
