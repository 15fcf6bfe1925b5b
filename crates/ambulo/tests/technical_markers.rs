//! Markers without a known name on the segments with which they move: on a made walk, and on recordings whose markers
//! are given other names.

use crate::shared_data;
use ambulo::analysis::Analysis;
use ambulo::findings::{Code, Findings};
use ambulo::job::{FileError, Job};
use ambulo::kinematics::{BodyMotion, Posture, body_motion};
use ambulo::model::anthropometry::{Build, Human, SegmentTable};
use ambulo::model::full_body::full_body;
use ambulo::model::marker_set::{MarkerSet, NamedMarker, RecognisedMarkers};
use ambulo::model::{Marker, Side};
use ambulo::motion::{MarkerPath, MarkerRecording};
use ambulo::numerics::Random;
use ambulo::spatial::Vec3;
use ambulo::study::{
    self, GroundSettings, LaboratoryFile, Outcome, Recording, Settings, Source, StandingTrial, Tracking,
};
use ambulo::technical_markers::{MarkedBody, computed_points, technical_markers};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;
use std::sync::Arc;

// ---- a made walk ----

const FRAMES: usize = 60;

fn person() -> Human {
    full_body(&Build { table: SegmentTable::DeLevaMale, mass: 70.0, height: 1.75, toe_joint: true }).unwrap()
}

/// Coordinates of a walk: hips, knees, ankles and trunk swing, the pelvis travels.
fn walking(human: &Human, frame: usize) -> Vec<f64> {
    let phase = 0.3 * frame as f64;
    let value = |name: &str| match name {
        "pelvis_tx" => 0.02 * frame as f64,
        "hip_flexion_r" => 0.1 + 0.4 * phase.sin(),
        "hip_flexion_l" => 0.1 - 0.4 * phase.sin(),
        "knee_angle_r" => -0.4 - 0.4 * phase.cos(),
        "knee_angle_l" => -0.4 + 0.4 * phase.cos(),
        "ankle_angle_r" | "ankle_angle_l" => 0.2 * (1.7 * phase).sin(),
        "lumbar_extension" | "lumbar_bending" => 0.2 * (1.3 * phase).cos(),
        _ => 0.0,
    };
    human.model.coordinates().iter().map(|c| c.default_value + value(&c.name)).collect()
}

/// The recording of these markers on a body in some postures.
fn recorded(human: &Human, markers: &[Marker], postures: &[Vec<f64>]) -> MarkerRecording {
    let rest = vec![0.0; human.model.coordinates().len()];
    let poses: Vec<_> =
        postures.iter().map(|q| body_motion(&human.model, Posture { q, qd: &rest, qdd: &rest })).collect();
    let path = |marker: &Marker| {
        let place = |poses: &Vec<BodyMotion>| {
            marker.body.map_or(marker.location, |body| poses[body.index()].pose.place(marker.location))
        };
        MarkerPath { name: marker.name.clone(), positions: poses.iter().map(place).collect() }
    };
    MarkerRecording {
        name: "made".to_owned(),
        rate_hz: 100.0,
        times: (0..postures.len()).map(|i| 0.01 * i as f64).collect(),
        markers: markers.iter().map(path).collect(),
    }
}

/// Markers whose names tell nothing: three on each thigh and shank, one on the pelvis, and one on the floor.
fn nameless(human: &Human) -> Vec<Marker> {
    let at = |body: &str, place: [f64; 3]| (human.model.body(body), Vec3::from(place));
    let of_leg = |side: &str| {
        let (thigh, shank) = (format!("femur_{side}"), format!("tibia_{side}"));
        [
            at(&thigh, [0.08, -0.15, 0.02]),
            at(&thigh, [0.06, -0.25, 0.05]),
            at(&thigh, [-0.05, -0.3, 0.06]),
            at(&shank, [0.05, -0.1, 0.03]),
            at(&shank, [0.04, -0.2, 0.05]),
            at(&shank, [-0.04, -0.3, 0.04]),
        ]
    };
    let all = of_leg("r")
        .into_iter()
        .chain(of_leg("l"))
        .chain([at("pelvis", [-0.1, 0.02, 0.03]), (None, Vec3::new(0.4, 0.01, 0.1))]);
    all.enumerate()
        .map(|(i, (body, location))| Marker { name: format!("m{i:02}"), body, location, fixed: false })
        .collect()
}

struct Made {
    human: Human,
    known: Vec<Marker>,
    further: Vec<Marker>,
    standing: MarkerRecording,
    moving: MarkerRecording,
}

/// Pelvis, feet and trunk have their names; knees and ankles have markers in the standing trial only.
fn made() -> Made {
    let human = person();
    let all = MarkerSet::named("plug-in-gait").unwrap().on(&human);
    let is_joint = |name: &str| ["KNE", "KNM", "ANK", "MED", "THI", "TIB"].iter().any(|part| name.contains(part));
    let (joints, known): (Vec<Marker>, Vec<Marker>) = all.into_iter().partition(|marker| is_joint(&marker.name));
    let further = nameless(&human);
    let standing = human.model.coordinates().iter().map(|c| c.default_value).collect::<Vec<f64>>();
    let in_both: Vec<Marker> = known.iter().chain(&further).cloned().collect();
    let of_standing: Vec<Marker> = in_both.iter().chain(&joints).cloned().collect();
    let postures: Vec<Vec<f64>> = (0..FRAMES).map(|frame| walking(&human, frame)).collect();
    Made {
        standing: recorded(&human, &of_standing, &vec![standing; 20]),
        moving: recorded(&human, &in_both, &postures),
        known: known.into_iter().chain(joints).collect(),
        further,
        human,
    }
}

fn named_in(recording: &MarkerRecording) -> Vec<NamedMarker> {
    RecognisedMarkers::with(None, recording.markers.iter().map(|path| path.name.as_str())).unwrap().markers
}

impl Made {
    /// The markers that are found, where some names besides those of the set have a meaning.
    fn found(&self, standing: Option<&MarkerRecording>, further: &[NamedMarker]) -> BTreeMap<String, Marker> {
        let model = self.human.model.with_markers(self.known.clone()).unwrap();
        let weights = BTreeMap::new();
        let body = MarkedBody { model: &model, weights: &weights, is_shown: false };
        let named = [named_in(&self.moving), further.to_vec()].concat();
        let found = technical_markers(body, &self.moving, standing, &named);
        found.into_iter().map(|(marker, _)| (marker.name.clone(), marker)).collect()
    }
}

#[test]
fn nameless_markers_get_segment_and_place_and_the_floor_gets_none() {
    let made = made();
    for standing in [Some(&made.standing), None] {
        let found = made.found(standing, &[]);
        let (floor, on_body) = made.further.split_last().unwrap();
        assert!(!found.contains_key(&floor.name), "{found:?}");
        for marker in on_body {
            let own = found.get(&marker.name).unwrap_or_else(|| panic!("{} of {:?}", marker.name, found.keys()));
            assert_eq!(own.body, marker.body, "{}, standing: {}", marker.name, standing.is_some());
            // The fit of a frame ends 0.01 mm from the markers. Without a standing trial the places come from the walk,
            // in which only bent knees show how thighs without markers turn.
            let allowed_m = if standing.is_some() { 1e-4 } else { 0.02 };
            let off_m = (own.location - marker.location).norm();
            assert!(off_m < allowed_m, "{}: {off_m} m, standing: {}", marker.name, standing.is_some());
        }
    }
}

#[test]
fn a_name_decides_unless_the_motion_contradicts_it() {
    let made = made();
    let named = |name: &str, like: &str| {
        let known = RecognisedMarkers::with(None, ["RTHAP", "RTIAP", "LASI", "RASI", like]).unwrap();
        let meaning = known.markers.into_iter().find(|marker| marker.name == like).unwrap();
        NamedMarker { name: name.to_owned(), ..meaning }
    };
    let body = |name: &str| made.human.model.body(name);
    // m00 is on the thigh, as `RTHAP` is, m06 on the left one.
    let found = made.found(Some(&made.standing), &[named("m00", "RTHAP"), named("m06", "RTHAD")]);
    assert_eq!(found["m00"].body, body("femur_r"));
    assert_eq!(found["m06"].body, body("femur_l"));
}

#[test]
fn points_that_a_program_computed_are_told_from_markers() {
    let mut made = made();
    // Cameras have noise of 0.2 mm, computed points follow from the markers with their noise.
    let mut random = Random::seeded(5);
    let mut noise = || 2e-4 * (random.below(2001) as f64 / 1000.0 - 1.0);
    for position in made.moving.markers.iter_mut().flat_map(|path| &mut path.positions) {
        *position += Vec3::new(noise(), noise(), noise());
    }
    let at = |name: &str| made.moving.marker(name).unwrap().positions.clone();
    let (right, left) = (at("RASI"), at("LASI"));
    let mut add = |name: &str, positions: Vec<Vec3>| {
        made.moving.markers.push(MarkerPath { name: name.to_owned(), positions });
    };
    let axis_end = |(right, left): (&Vec3, &Vec3)| right + (right - left).normalize() * 0.1;
    add("axis 1", right.iter().zip(&left).map(axis_end).collect());
    add("CentreOfMass", right.iter().zip(&left).map(|(right, left)| (right + left) * 0.5).collect());
    let named = named_in(&made.moving);
    assert_eq!(computed_points(&made.moving, &named), ["axis 1", "CentreOfMass"]);
    let found = made.found(Some(&made.standing), &[]);
    assert!(!found.contains_key("axis 1") && found.contains_key("m00"), "{:?}", found.keys());
}

// ---- recordings with other names ----

/// Recordings with a standing trial and clusters or single technical markers on thighs and shanks, one request a line.
const LIST: &str = include_str!("cluster_recordings.jsonl");

/// The recording in a folder.
fn read(folder: &str, data: &Path) -> Source {
    let jobs = LIST.lines().map(|line| serde_json::from_str::<Job>(line).unwrap());
    let job = jobs.into_iter().find(|job| job.recording().starts_with(folder)).unwrap();
    let mut files = |path: &Path| fs::read(data.join(path)).map_err(FileError::from);
    job.read(&mut files, &mut Findings::default()).unwrap().source
}

/// Markers of thighs and shanks: those that define a joint, and the others.
#[derive(Default)]
struct LegMarkers {
    joints: BTreeSet<String>,
    technical: BTreeMap<String, Vec<String>>,
}

fn run(source: Source) -> (Outcome, Findings) {
    let mut findings = Findings::default();
    let settings = Settings { ground: GroundSettings::Predicted, ..Settings::default() };
    (study::run(source, &settings, &mut findings).unwrap(), findings)
}

/// The markers of both recordings changed, `standing` says which of the two it is.
fn changed(source: &Source, change: impl Fn(&mut Vec<MarkerPath>, bool)) -> Source {
    let mut source = source.clone();
    let Recording::Markers(markers) = &mut source.recording else { panic!("no markers") };
    change(&mut markers.trial.recording.markers.markers, false);
    let mut still = LaboratoryFile::clone(markers.standing.as_ref().unwrap());
    change(&mut still.recording.markers.markers, true);
    markers.standing = Some(Arc::new(StandingTrial::new(still)));
    source
}

fn leg_markers(outcome: &Outcome) -> LegMarkers {
    let Some(Tracking::Markers(tracked)) = &outcome.tracking else { panic!("no markers") };
    let subject = &tracked.body.subject;
    let mut found = LegMarkers::default();
    for leg in Side::BOTH.into_iter().filter_map(|side| subject.model.anatomy().legs()[side].as_ref()) {
        for body in [leg.thigh, leg.shank] {
            for marker in subject.model.markers().iter().filter(|marker| marker.body == Some(body)) {
                let name = marker.name.clone();
                match subject.weights.get(&name).is_none_or(|weight| *weight >= 1.0) {
                    true => _ = found.joints.insert(name),
                    false => {
                        found.technical.entry(subject.model.bodies()[body.index()].name.clone()).or_default().push(name)
                    }
                }
            }
        }
    }
    found
}

/// Knees and ankles have markers in the standing trial only, and the others of thighs and shanks, at most this many on
/// each, names that tell nothing.
fn with_few_names(source: &Source, legs: &LegMarkers, most: usize) -> Source {
    let kept: Vec<&String> = legs.technical.values().flat_map(|names| names.iter().take(most)).collect();
    let is_dropped = |name: &String| legs.technical.values().flatten().any(|own| own == name) && !kept.contains(&name);
    changed(source, |markers, is_standing| {
        markers.retain(|path| !is_dropped(&path.name) && (is_standing || !legs.joints.contains(&path.name)));
        for path in markers {
            if let Some(number) = kept.iter().position(|name| **name == path.name) {
                path.name = format!("m{}", number + 1);
            }
        }
    })
}

/// Root mean square of the difference of the sagittal moments of the legs, in the frames of both [N.m/kg].
fn moments_apart(a: &Analysis, b: &Analysis, outcome: &Outcome) -> f64 {
    let grid = |analysis: &Analysis| (analysis.trajectory.grid().start_s, analysis.trajectory.grid().step_s);
    let ((start_a, step_s), (start_b, _)) = (grid(a), grid(b));
    let shift = ((start_b - start_a) / step_s).round() as i64;
    let names = ["hip_flexion_r", "hip_flexion_l", "knee_angle_r", "knee_angle_l", "ankle_angle_r", "ankle_angle_l"];
    let (mut sum, mut count) = (0.0, 0_u32);
    for name in names {
        let id = outcome.body.coordinate(name).unwrap().index();
        let [of_a, of_b] = [a, b].map(|analysis| &analysis.forces.generalized[id]);
        for (frame, moment) in of_b.iter().enumerate() {
            let other = usize::try_from(frame as i64 + shift).ok().and_then(|frame| of_a.get(frame));
            if let Some(other) = other.filter(|other| other.is_finite() && moment.is_finite()) {
                sum += ((moment - other) / outcome.body.mass()).powi(2);
                count += 1;
            }
        }
    }
    (sum / f64::from(count)).sqrt()
}

/// Error of the predicted vertical force, mean of the feet [% of body weight].
fn vertical_error(outcome: &Outcome) -> f64 {
    let agreement = outcome.prediction.as_ref().and_then(|prediction| prediction.agreement.as_ref()).unwrap();
    let errors: Vec<f64> = agreement.feet.iter().map(|foot| 100.0 * foot.vertical.rmse_bw).collect();
    errors.iter().sum::<f64>() / errors.len() as f64
}

/// Markers that the body follows, markers of the recording, and the root mean square distance in the median frame [mm].
fn use_of_markers(outcome: &Outcome) -> (usize, usize, f64) {
    let Some(Tracking::Markers(tracked)) = &outcome.tracking else { panic!("no markers") };
    let mut rms: Vec<f64> = tracked.body.fit.rms_m.iter().copied().filter(|rms| rms.is_finite()).collect();
    rms.sort_by(f64::total_cmp);
    let used = tracked.body.fit.errors.iter().filter(|error| error.rms_m.is_finite()).count();
    (used, tracked.body.recorded_markers, 1e3 * rms[rms.len() / 2])
}

fn measured(outcome: &Outcome) -> &Analysis {
    outcome.prediction.as_ref().and_then(|prediction| prediction.measured.as_ref()).unwrap()
}

/// The recording as it is and with few names, compared.
fn compare(folder: &str) {
    let Some(data) = shared_data::data() else { return };
    let source = read(folder, &data);
    let (whole, _) = run(source.clone());
    let legs = leg_markers(&whole);
    println!("{folder}: {:?}", legs.technical);
    let few = with_few_names(&source, &legs, 3);
    let (found, findings) = run(few);
    let [before, after] = [&whole, &found].map(|outcome| (use_of_markers(outcome), vertical_error(outcome)));
    let apart = moments_apart(measured(&whole), measured(&found), &found);
    println!("  as it is {before:?}, renamed {after:?}, moments {apart:.4} N.m/kg apart");
    for finding in findings.as_slice().iter().filter(|finding| finding.code.name().starts_with("markers.")) {
        println!("  {} {}", finding.code, finding.message);
    }
    let (used, recorded, _) = after.0;
    assert!(used as f64 >= 0.95 * recorded as f64 - before.0.1.abs_diff(before.0.0) as f64, "{after:?}");
    assert!(!findings.has(Code::MarkersUnused), "{findings:?}");
    assert!(after.1 < before.1 + 1.0, "vertical error {:.2} %BW, before {:.2}", after.1, before.1);
    assert!(apart < 0.05, "{apart} N.m/kg");
}

#[test]
fn a_walk_on_a_belt_with_clusters_without_names() {
    compare("opensim-gait2392-subject01");
}

#[test]
fn a_walk_with_clusters_without_names() {
    compare("opensim-rajagopal-walk");
}

#[test]
fn a_run_with_clusters_without_names() {
    compare("opensim-rajagopal-run");
}

/// Each thigh has one technical marker here, and the feet are hardly seen: too little for a pose, which is said.
#[test]
fn a_walk_with_single_technical_markers_is_not_followed_in_silence() {
    let Some(data) = shared_data::data() else { return };
    let source = read("motonms-unipd", &data);
    let (whole, none) = run(source.clone());
    let (found, findings) = run(with_few_names(&source, &leg_markers(&whole), 3));
    println!("{:?}, renamed {:?}", use_of_markers(&whole), use_of_markers(&found));
    assert!(!none.has(Code::MarkersSegmentHardlyShown), "{none:?}");
    assert!(findings.has(Code::MarkersSegmentHardlyShown), "{findings:?}");
}

#[test]
fn one_wand_on_each_segment_is_too_little_and_is_said() {
    let Some(data) = shared_data::data() else { return };
    let source = read("opensim-gait2392-subject01", &data);
    let settings = Settings { ground: GroundSettings::MeasuredOrPredicted, ..Settings::default() };
    let run = |source: Source| {
        let mut findings = Findings::default();
        (study::run(source, &settings, &mut findings).unwrap(), findings)
    };
    let (whole, none) = run(source.clone());
    assert!(!none.has(Code::MarkersSegmentHardlyShown) && !none.has(Code::MarkersUnused), "{none:?}");
    let (_, findings) = run(with_few_names(&source, &leg_markers(&whole), 1));
    let said = findings.as_slice().iter().find(|finding| finding.code == Code::MarkersSegmentHardlyShown).unwrap();
    println!("{}", said.message);
    for part in ["the right thigh (1 marker)", "the left shank (1 marker)", "a marker of the knee"] {
        assert!(said.message.contains(part), "{}", said.message);
    }
}
