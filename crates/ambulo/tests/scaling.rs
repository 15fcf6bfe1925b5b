//! Scaling of models: compared with OpenSim, and recovery of known sizes from a standing trial.

use crate::common::random::Random;
use crate::marker_data::{Subject, gait2392, rajagopal};
use ambulo::findings::{Code, Findings};
use ambulo::kinematics::marker_fit::{FitSettings, fit_markers};
use ambulo::kinematics::scaling::{
    DistanceMeasurement, MarkerPlacement, MeasuredBody, ProtocolTrials, ScalingError, ScalingProtocol, ScalingStep,
    SizedModel, fit_size, measured_factors, scale_by_protocol,
};
use ambulo::kinematics::{Posture, body_motion};
use ambulo::model::{Drive, MassDistribution, Model, ScaleError};
use ambulo::motion::{MarkerPath, MarkerRecording};
use ambulo::spatial::Vec3;
use std::path::Path;

/// Rows of a file with OpenSim's results: a name and values.
fn rows(file: &str) -> Vec<(String, Vec<f64>)> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/testdata/opensim_scale").join(file);
    let text = std::fs::read_to_string(path).unwrap();
    let row = |line: &str| {
        let (name, values) = line.split_once(',').unwrap();
        (name.to_owned(), values.split(',').map(|v| v.parse().unwrap()).collect())
    };
    text.lines().skip(1).map(row).collect()
}

/// Positions of the markers in ground, in the order of the model [m].
fn places(model: &Model, q: &[f64]) -> Vec<Vec3> {
    let zeros = vec![0.0; q.len()];
    let bodies = body_motion(model, Posture { q, qd: &zeros, qdd: &zeros });
    let place = |m: &ambulo::model::Marker| m.body.map_or(m.location, |id| bodies[id.index()].pose.place(m.location));
    model.markers().iter().map(place).collect()
}

fn assert_scales_as_opensim(model: &Model, name: &str) {
    let bodies = rows(&format!("{name}_bodies.csv"));
    let of = |body: &str| &bodies.iter().find(|(b, _)| b == body).unwrap().1;
    let factors: Vec<Vec3> = model.bodies().iter().map(|b| Vec3::from_column_slice(&of(&b.name)[..3])).collect();
    let scaled = model.scaled(&factors, Some(77.0)).unwrap();
    let mut worst = [0.0_f64; 2];
    for body in scaled.bodies() {
        let row = of(&body.name);
        let (center, i) = (body.inertia.center(), body.inertia.about_center());
        let ours = [body.inertia.mass(), center.x, center.y, center.z, i.m11, i.m22, i.m33, i.m12, i.m13, i.m23];
        for (ours, theirs) in ours.iter().zip(&row[3..]) {
            worst[0] = worst[0].max((ours - theirs).abs());
            assert!((ours - theirs).abs() < 1e-8, "{name}, {}: {ours} instead of {theirs}", body.name);
        }
    }
    let posture = rows(&format!("{name}_posture.csv"));
    let value = |c: &str| posture.iter().find(|(n, _)| n == c).unwrap().1[0];
    let q: Vec<f64> = scaled.coordinates().iter().map(|c| value(&c.name)).collect();
    let theirs = rows(&format!("{name}_markers.csv"));
    for (marker, place) in scaled.markers().iter().zip(places(&scaled, &q)) {
        let (_, there) = theirs.iter().find(|(n, _)| *n == marker.name).unwrap();
        let miss = (place - Vec3::from_column_slice(there)).norm();
        worst[1] = worst[1].max(miss);
        assert!(miss < 1e-7, "{name}, marker {}: {miss} m", marker.name);
    }
    println!("{name}: largest difference of masses and inertias {:.1e}, of marker places {:.1e} m", worst[0], worst[1]);
    assert!((scaled.mass() - 77.0).abs() < 1e-9);
}

#[test]
fn models_are_scaled_as_by_opensim() {
    if let (Some(a), Some(b)) = (rajagopal(), gait2392()) {
        assert_scales_as_opensim(&a.model, "rajagopal");
        assert_scales_as_opensim(&b.model, "gait2392");
    }
}

/// Bodies that are scaled together: the size of a body without markers is not determined.
const GROUPS: [&[&str]; 5] = [
    &["pelvis"],
    &["femur"],
    &["tibia", "patella"],
    &["talus", "calcn", "toes"],
    &["torso", "humerus", "ulna", "radius", "hand"],
];

fn disturbed(model: &Model, r: &mut Random) -> (Model, Vec<f64>) {
    let of_group: Vec<f64> = GROUPS.iter().map(|_| r.between(0.8, 1.25)).collect();
    let group = |name: &str| GROUPS.iter().position(|g| g.iter().any(|stem| name.starts_with(stem)));
    let factors: Vec<f64> = model.bodies().iter().map(|b| group(&b.name).map_or(1.0, |g| of_group[g])).collect();
    let all: Vec<Vec3> = factors.iter().map(|f| Vec3::repeat(*f)).collect();
    (model.scaled(&all, Some(55.0)).unwrap(), factors)
}

/// Distance from each joint to the joint of its parent [mm], in the default posture.
fn lengths(model: &Model) -> Vec<(String, f64)> {
    let joint = |b: &ambulo::model::Body| {
        let parent = &model.bodies()[b.joint.parent?.index()];
        let arm = b.joint.parent_from_joint.translation - parent.joint.child_from_joint.translation;
        Some((format!("{} to {}", parent.name, b.name), 1000.0 * arm.norm()))
    };
    model.bodies().iter().filter_map(joint).collect()
}

/// Largest difference of lengths of the legs and the pelvis [mm], and where.
fn worst_length(a: &Model, b: &Model) -> (f64, String) {
    let mut worst = (0.0, String::new());
    for ((what, a), (_, b)) in lengths(a).into_iter().zip(lengths(b)) {
        let of_leg = ["hum", "torso", "ulna", "radius", "patella"].iter().all(|arm| !what.contains(arm));
        if of_leg && (a - b).abs() > worst.0 {
            worst = ((a - b).abs(), format!("{what}: {a:.1} mm against {b:.1}"));
        }
    }
    worst
}

/// `from_stored_mm`: allowed difference of the leg lengths from those of the stored model, which another program scaled
/// by other distances.
fn assert_comes_back(name: &str, subject: &Subject, from_stored_mm: f64) {
    let mut findings = Findings::default();
    let mass = Some(subject.model.mass());
    let plain = fit_size(&subject.model, &subject.standing, mass, &mut findings).unwrap();
    let (stored, place) = worst_length(&subject.model, &plain.model);
    println!(
        "{name} as stored: marker RMS {:.1} mm before, {:.1} mm after; {place}",
        1000.0 * plain.rms_before_m.unwrap(),
        1000.0 * plain.rms_m.unwrap()
    );
    assert!(stored < from_stored_mm, "{name}: {stored} mm, {place}");
    for seed in 0..6 {
        let mut r = Random::new(seed);
        let (other, _) = disturbed(&subject.model, &mut r);
        let sized = fit_size(&other, &subject.standing, mass, &mut Findings::default()).unwrap();
        let [before, after] = [sized.rms_before_m, sized.rms_m].map(|m| 1000.0 * m.unwrap());
        let (worst, place) = worst_length(&plain.model, &sized.model);
        println!(
            "{name} seed {seed}: marker RMS {before:.1} mm before, {after:.1} mm after; worst length {worst:.1} mm, \
             {place}"
        );
        assert!(worst < 4.0, "{name} seed {seed}: {worst} mm");
        assert!(
            after < 0.7 * before && after < 1000.0 * plain.rms_m.unwrap() + 2.0,
            "{name} seed {seed}: {before} to {after} mm"
        );
        assert!((sized.model.mass() - subject.model.mass()).abs() < 1e-9);
        let share = |m: &Model| m.bodies()[0].inertia.mass() / m.mass();
        assert!((share(&sized.model) - share(&subject.model)).abs() < 1e-12, "mass distribution");
        assert_fits_standing(subject, &sized);
    }
}

/// Asserts that the markers of the model match the standing trial.
fn assert_fits_standing(subject: &Subject, sized: &SizedModel) {
    let fit = fit_markers(&sized.model, &subject.standing, &FitSettings::default(), &mut Findings::default()).unwrap();
    let middle = fit.rms_m[fit.rms_m.len() / 2];
    // The person sways by some millimetres in the trial.
    assert!(middle < 0.01, "{middle} m");
}

#[test]
fn the_size_of_a_disturbed_model_is_recovered_from_a_standing_trial() {
    if let (Some(a), Some(b)) = (gait2392(), rajagopal()) {
        assert_comes_back("gait2392", &a, 5.0);
        assert_comes_back("rajagopal", &b, 20.0);
    }
}

#[test]
fn impossible_sizes_are_rejected() {
    let Some(subject) = gait2392() else { return };
    let ones = vec![Vec3::repeat(1.0); subject.model.bodies().len()];
    assert!(matches!(subject.model.scaled(&ones[1..], None), Err(ScaleError::Count { .. })));
    let mut flat = ones.clone();
    flat[3].y = 0.0;
    let message = subject.model.scaled(&flat, None).unwrap_err().to_string();
    assert!(message.contains(&subject.model.bodies()[3].name) && message.contains("above zero"), "{message}");
    assert!(matches!(subject.model.scaled(&ones, Some(-1.0)), Err(ScaleError::Mass { .. })));
}

/// A person of known size, standing in the default posture of the model.
fn standing_person(model: &Model, factors: &[Vec3]) -> MarkerRecording {
    let person = model.scaled(factors, None).unwrap();
    let mut q: Vec<f64> = person.coordinates().iter().map(|c| c.default_value).collect();
    for (i, coordinate) in person.coordinates().iter().enumerate() {
        if let Drive::Coupled(leader, function) = &coordinate.drive {
            q[i] = function.at(q[leader.index()])[0];
        }
    }
    let path = |(marker, place): (&ambulo::model::Marker, Vec3)| MarkerPath {
        name: marker.name.clone(),
        positions: vec![place; 3],
    };
    let markers = person.markers().iter().zip(places(&person, &q)).map(path).collect();
    MarkerRecording { name: "known".into(), rate_hz: 100.0, times: vec![0.0, 0.01, 0.02], markers }
}

fn measurement(name: &str, pairs: &[[&str; 2]], bodies: &[(&str, [bool; 3])]) -> DistanceMeasurement {
    DistanceMeasurement {
        name: name.into(),
        pairs: pairs.iter().map(|[a, b]| [(*a).to_owned(), (*b).to_owned()]).collect(),
        bodies: bodies.iter().map(|(body, axes)| MeasuredBody { body: (*body).to_owned(), axes: *axes }).collect(),
    }
}

const ALL: [bool; 3] = [true; 3];

#[test]
fn measured_distances_give_the_factors_of_a_known_person() {
    let Some(subject) = gait2392() else { return };
    let model = &subject.model;
    let of = |name: &str| match name {
        "pelvis" => Vec3::repeat(1.1),
        "tibia_r" | "tibia_l" => Vec3::repeat(0.9),
        _ => Vec3::repeat(1.0),
    };
    let factors: Vec<Vec3> = model.bodies().iter().map(|b| of(&b.name)).collect();
    let standing = standing_person(model, &factors);
    let measurements = [
        measurement("pelvis", &[["R.ASIS", "L.ASIS"], ["R.ASIS", "V.Sacral"]], &[("pelvis", ALL)]),
        measurement("right shank", &[["R.Shank.Upper", "R.Ankle.Lat"]], &[("tibia_r", ALL), ("tail", ALL)]),
        measurement("left shank", &[["L.Shank.Upper", "L.Ankle.Lat"]], &[("tibia_l", ALL)]),
        measurement("nowhere", &[["R.ASIS", "L.ASIS"], ["R.Nowhere", "R.ASIS"]], &[("pelvis", ALL)]),
    ];
    let mut findings = Findings::default();
    let found = measured_factors(model, &standing, &measurements, &mut findings).unwrap();
    for ((found, expected), body) in found.iter().zip(&factors).zip(model.bodies()) {
        assert!((found - expected).norm() < 1e-12, "{}: {found} for {expected}", body.name);
    }
    assert!(findings.has(Code::ScalingPair) && findings.has(Code::ScalingBody));
    let protocol = ScalingProtocol {
        steps: vec![ScalingStep::Measurements(measurements.to_vec())],
        mass_kg: Some(60.0),
        placement: Some(MarkerPlacement::default()),
        ..ScalingProtocol::default()
    };
    let trials = ProtocolTrials { measured: Some(&standing), standing: Some(&standing) };
    let sized = scale_by_protocol(model, &protocol, trials, &mut findings).unwrap();
    let (before, after) = (sized.rms_before_m.unwrap(), sized.rms_m.unwrap());
    assert!(after < 1e-8 && before > 0.003, "{after} from {before}");
    assert!((sized.model.mass() - 60.0).abs() < 1e-9);
    let scaled = model.scaled(&sized.factors, None).unwrap();
    for (placed, scaled) in sized.model.markers().iter().zip(scaled.markers()) {
        assert!(placed.name == scaled.name && (placed.location - scaled.location).norm() < 1e-7, "{placed:?}");
    }

    let missing = scale_by_protocol(model, &protocol, ProtocolTrials::default(), &mut findings).unwrap_err();
    assert!(matches!(missing, ScalingError::NoTrial { .. }), "{missing}");
    let late = ScalingProtocol { measured_s: Some([5.0, 6.0]), ..protocol };
    let late = scale_by_protocol(model, &late, trials, &mut findings).unwrap_err().to_string();
    assert!(late.contains("no frame between 5 and 6 s; expected a part of 0 to 0.02 s"), "{late}");

    let error =
        |m: DistanceMeasurement| measured_factors(model, &standing, &[m], &mut Findings::default()).unwrap_err();
    let none = error(measurement("none", &[["R.ASIS", "R.ASIS"]], &[("pelvis", ALL)]));
    assert!(matches!(none, ScalingError::NoDistance { .. }), "{none}");
}

#[test]
fn axes_without_a_measurement_keep_their_size() {
    let Some(subject) = gait2392() else { return };
    let ones = vec![Vec3::repeat(1.0); subject.model.bodies().len()];
    let standing = standing_person(&subject.model, &ones);
    let pair = measurement("width", &[["R.ASIS", "L.ASIS"]], &[("pelvis", [false, false, true])]);
    let mut wide = standing.clone();
    let far = wide.markers.iter().position(|m| m.name == "R.ASIS").unwrap();
    let near = standing.marker("L.ASIS").unwrap().positions[0];
    wide.markers[far].positions.iter_mut().for_each(|p| *p = near + (*p - near) * 1.2);
    let found = measured_factors(&subject.model, &wide, &[pair], &mut Findings::default()).unwrap();
    let pelvis = subject.model.body("pelvis").unwrap().index();
    assert!((found[pelvis] - Vec3::new(1.0, 1.0, 1.2)).norm() < 1e-12, "{}", found[pelvis]);
}

#[test]
fn later_steps_of_a_protocol_replace_factors_and_fixed_markers_stay() {
    let Some(subject) = gait2392() else { return };
    let ones = vec![Vec3::repeat(1.0); subject.model.bodies().len()];
    let mut standing = standing_person(&subject.model, &ones);
    standing.markers.retain(|m| m.name != "Top.Head");
    let shifted = standing.markers.iter_mut().filter(|m| ["R.Heel", "L.Heel"].contains(&m.name.as_str()));
    shifted.for_each(|m| m.positions.iter_mut().for_each(|p| p.y += 0.01));
    let fixed = |m: &ambulo::model::Marker| ambulo::model::Marker { fixed: m.name == "R.Heel", ..m.clone() };
    let model = subject.model.with_markers(subject.model.markers().iter().map(fixed).collect()).unwrap();
    let width = measurement("width", &[["R.ASIS", "L.ASIS"]], &[("pelvis", ALL)]);
    let stated = Vec3::new(1.2, 1.0, 0.9);
    let protocol = |steps: Vec<ScalingStep>, masses| ScalingProtocol {
        steps,
        masses,
        placement: Some(MarkerPlacement::default()),
        ..ScalingProtocol::default()
    };
    let measured = || ScalingStep::Measurements(vec![width.clone()]);
    let manual = || ScalingStep::Stated(vec![("pelvis".into(), stated), ("toes_r".into(), stated)]);
    let trials = ProtocolTrials { measured: Some(&standing), standing: Some(&standing) };
    let scaled =
        |steps, masses| scale_by_protocol(&model, &protocol(steps, masses), trials, &mut Findings::default()).unwrap();
    let pelvis = model.body("pelvis").unwrap().index();
    let first = scaled(vec![manual(), measured()], MassDistribution::Kept);
    assert!((first.factors[pelvis] - Vec3::repeat(1.0)).norm() < 1e-12, "{}", first.factors[pelvis]);
    let second = scaled(vec![measured(), manual()], MassDistribution::ByVolume);
    assert_eq!(second.factors[pelvis], stated);
    let mass = |model: &Model| model.bodies()[pelvis].inertia.mass();
    assert!((mass(&second.model) - 1.08 * mass(&model)).abs() < 1e-9);
    assert!((mass(&first.model) - mass(&model)).abs() < 1e-12);
    let place = |model: &Model, name: &str| model.markers().iter().find(|m| m.name == name).map(|m| m.location);
    assert_eq!(place(&first.model, "Top.Head"), None);
    assert_eq!(place(&first.model, "R.Heel"), place(&model, "R.Heel"));
    assert!((place(&first.model, "L.Heel").unwrap() - place(&model, "L.Heel").unwrap()).norm() > 0.005);
}
