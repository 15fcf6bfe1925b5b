//! Orientations of sensors: known movements come back, OpenSim finds the same angles, the place follows from the feet,
//! and what cannot be used is refused.

use crate::segment_poses::{FRAMES, RATE_HZ, person, posture};
use crate::shared_data::data;
use ambulo::analysis::feasibility::Person;
use ambulo::findings::{Code, Findings};
use ambulo::kinematics::marker_fit::FitSettings;
use ambulo::kinematics::sensor_fit::{SensorAxes, SensorError, SensorFit, SensorHeading, SensorTrial, fit_sensors};
use ambulo::kinematics::{Posture, body_motion};
use ambulo::model::anatomy::Sole;
use ambulo::model::{BySide, Drive, Model, from_osim};
use ambulo::motion::{Motion, SensorPath, SensorRecording, coordinates_from_table};
use ambulo::spatial::{Mat3, Vec3};
use ambulo::study::{self, Measure, QualityState, Recording, SensorBody, SensorSource, Settings, Source};
use ambulo_formats::osim::OsimModel;
use ambulo_formats::table::Table;
use nalgebra::{Rotation3, UnitQuaternion};
use std::f64::consts::FRAC_PI_2;
use std::path::Path;

/// Heading of the model in the earth of the sensors [rad].
const HEADING: f64 = 37.0 * std::f64::consts::PI / 180.0;

fn turn(vector: Vec3) -> Mat3 {
    Rotation3::from_scaled_axis(vector).into_inner()
}

/// How the sensor with this number sits on its body; the first along its axes.
fn mount(k: usize) -> Mat3 {
    let k = k as f64;
    let turned = Vec3::new(0.3 * (1.0 + 2.0 * k).sin(), 0.4 * (2.0 + 3.0 * k).sin(), 0.5 * (3.0 + 5.0 * k).sin());
    if k == 0.0 { Mat3::identity() } else { turn(turned) }
}

/// Sensors on some bodies of a model that moves; each is turned by a disturbance of this size [rad].
fn sensors(model: &Model, motion: &Motion, bodies: &[&str], disturbance: f64) -> SensorRecording {
    let rest = vec![0.0; model.coordinates().len()];
    let earth_from_world = turn(FRAC_PI_2 * Vec3::x()) * turn(-HEADING * Vec3::y());
    let numbers: Vec<usize> = bodies.iter().map(|body| model.body(body).unwrap().index()).collect();
    let mut paths: Vec<Vec<Option<Mat3>>> = vec![Vec::new(); bodies.len()];
    for (frame, time) in motion.times.iter().enumerate() {
        let value = |column: &Option<Vec<f64>>| column.as_ref().map_or(0.0, |column| column[frame]);
        let q: Vec<f64> = motion.columns.iter().map(value).collect();
        let poses = body_motion(model, Posture { q: &q, qd: &rest, qdd: &rest });
        for (k, path) in paths.iter_mut().enumerate() {
            let wave = |w: f64, j: f64| disturbance * (w * time + k as f64 * j).sin();
            let disturbed = turn(Vec3::new(wave(3.0, 1.0), wave(5.0, 2.0), wave(7.0, 3.0)));
            path.push(Some(earth_from_world * poses[numbers[k]].pose.rotation * disturbed * mount(k)));
        }
    }
    let named =
        bodies.iter().zip(paths).map(|(body, orientations)| SensorPath { name: format!("{body}_imu"), orientations });
    SensorRecording { name: "made".into(), times: motion.times.clone(), sensors: named.collect() }
}

/// The model in its default posture.
fn standing(model: &Model) -> Motion {
    let columns = model.coordinates().iter().map(|coordinate| Some(vec![coordinate.default_value; 2]));
    Motion { origin: "standing".into(), times: vec![0.0, 0.01], columns: columns.collect() }
}

/// The movement of the tests of poses.
fn moving(model: &Model) -> Motion {
    let frames: Vec<Vec<f64>> = (0..FRAMES).map(|frame| posture(model, frame)).collect();
    let column = |k: usize| Some(frames.iter().map(|q| q[k]).collect());
    Motion {
        origin: "made".into(),
        times: (0..FRAMES).map(|frame| frame as f64 / RATE_HZ).collect(),
        columns: (0..model.coordinates().len()).map(column).collect(),
    }
}

const BODIES: [&str; 14] = [
    "pelvis",
    "torso",
    "femur_r",
    "tibia_r",
    "calcn_r",
    "toes_r",
    "femur_l",
    "tibia_l",
    "calcn_l",
    "toes_l",
    "humerus_r",
    "forearm_r",
    "humerus_l",
    "forearm_l",
];

fn ahead(axis: Vec3) -> SensorAxes {
    SensorAxes { heading: SensorHeading::Sensor { sensor: "pelvis_imu".into(), axis }, ..SensorAxes::default() }
}

struct Made {
    model: Model,
    soles: BySide<Option<Sole>>,
    moving: SensorRecording,
    standing: SensorRecording,
}

/// Sensors on the built-in body.
fn made(bodies: &[&str]) -> Made {
    let (human, _) = person();
    let model = human.model.clone();
    Made {
        moving: sensors(&model, &moving(&model), bodies, 0.0),
        standing: sensors(&model, &standing(&model), bodies, 0.0),
        soles: Person::of_human(&human).soles,
        model,
    }
}

impl Made {
    fn fit(&self, axes: &SensorAxes, findings: &mut Findings) -> Result<SensorFit, SensorError> {
        let trial = SensorTrial { moving: &self.moving, standing: Some(&self.standing), axes };
        fit_sensors(&self.model, &self.soles, &trial, &FitSettings::default(), findings)
    }
}

/// Largest difference of the free angles [rad], and the coordinate that has it.
fn largest_difference(model: &Model, found: &Motion, known: &Motion) -> (f64, String) {
    let mut largest = (0.0, String::new());
    for (k, coordinate) in model.coordinates().iter().enumerate() {
        let is_place = ["pelvis_tx", "pelvis_ty", "pelvis_tz"].contains(&coordinate.name.as_str());
        let (Some(a), Some(b)) = (&found.columns[k], &known.columns[k]) else { continue };
        if is_place || !matches!(coordinate.drive, Drive::Free) {
            continue;
        }
        let off = a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        if off > largest.0 {
            largest = (off, coordinate.name.clone());
        }
    }
    largest
}

#[test]
fn sensors_that_sit_anyhow_give_back_the_joint_angles() {
    let made = made(&BODIES);
    let mut findings = Findings::default();
    for axes in [ahead(Vec3::x()), SensorAxes::default()] {
        let fit = made.fit(&axes, &mut findings).unwrap();
        let (off, name) = largest_difference(&made.model, &fit.motion, &moving(&made.model));
        println!("{:?}: largest difference {off:.1e} rad of {name}", axes.heading);
        // The solver stops below 1e-7. The mean turn of the knees is about their axis.
        assert!(off < 1e-6, "{off} {name}");
        assert!((fit.heading - HEADING).abs() < 1e-6, "{}", fit.heading.to_degrees());
        assert!(fit.angles.iter().all(|(_, angle)| *angle < 1e-6), "{:?}", fit.angles);
    }
    assert!(findings.has(Code::SensorsPlaced) && findings.has(Code::SensorsHeading));
    assert!(!findings.has(Code::SensorsUnrest));
}

#[test]
fn an_axis_that_does_not_point_forward_gives_other_angles() {
    let made = made(&BODIES);
    let fit = made.fit(&ahead(Vec3::z()), &mut Findings::default()).unwrap();
    let (off, _) = largest_difference(&made.model, &fit.motion, &moving(&made.model));
    assert!(off > 0.3, "{off}");
}

#[test]
fn toes_without_sensors_stay_and_a_missing_thigh_is_refused() {
    let without = |left_out: &[&str]| -> Vec<&'static str> {
        BODIES.into_iter().filter(|body| !left_out.iter().any(|part| body.contains(part))).collect()
    };
    let mut findings = Findings::default();
    let fit = made(&without(&["toes"])).fit(&ahead(Vec3::x()), &mut findings).unwrap();
    let toes = made(&BODIES).model.coordinate("mtp_angle_r").unwrap().index();
    assert!(fit.motion.columns[toes].as_ref().unwrap().iter().all(|angle| *angle == 0.0));
    let told = findings.as_slice().iter().find(|finding| finding.code == Code::SensorsHeld).unwrap();
    assert!(told.message.contains("`mtp_angle_r` (0)") && !told.message.contains("pelvis"), "{}", told.message);
    let error = made(&without(&["femur_r"])).fit(&ahead(Vec3::x()), &mut findings).unwrap_err();
    let wanted = "the sensors do not determine `knee_angle_r`, `hip_flexion_r`, `hip_adduction_r`, `hip_rotation_r`: a \
        sensor is missing";
    assert!(error.to_string().starts_with(wanted), "{error}");
    let error = made(&without(&["pelvis"])).fit(&SensorAxes::default(), &mut findings).unwrap_err();
    assert!(error.to_string().contains("`pelvis_tilt`"), "{error}");
    let error = made(&without(&["tibia_l"])).fit(&ahead(Vec3::x()), &mut findings).unwrap_err();
    assert!(error.to_string().contains("`knee_angle_l`"), "knee and ankle bend about the same axis: {error}");
}

#[test]
fn gaps_of_a_sensor_are_bridged_and_told() {
    let mut made = made(&BODIES);
    let thigh = made.moving.sensors.iter().position(|sensor| sensor.name == "femur_r_imu").unwrap();
    made.moving.sensors[thigh].orientations[40..50].fill(None);
    let mut findings = Findings::default();
    let fit = made.fit(&ahead(Vec3::x()), &mut findings).unwrap();
    let (off, name) = largest_difference(&made.model, &fit.motion, &moving(&made.model));
    assert!(off < 0.01, "{off} {name}");
    let told = findings.as_slice().iter().find(|finding| finding.code == Code::SensorsMissing).unwrap();
    assert_eq!(told.message, "the sensor `femur_r_imu` sent nothing in 10 of 120 frames");
}

#[test]
fn sensors_that_cannot_be_used_are_refused_with_the_reason() {
    let good = made(&BODIES);
    let refused = |made: &Made, axes: &SensorAxes| made.fit(axes, &mut Findings::default()).unwrap_err().to_string();

    let mut unknown = made(&["pelvis", "femur_r"]);
    for (k, sensor) in unknown.moving.sensors.iter_mut().enumerate() {
        sensor.name = format!("sensor{k}");
    }
    let text = refused(&unknown, &ahead(Vec3::x()));
    assert!(text.starts_with("none of the sensors `sensor0`, `sensor1` is on a body of"), "{text}");
    assert!(text.contains("such as `pelvis_imu`"), "{text}");

    let mut silent = made(&BODIES);
    silent.standing.sensors[3].orientations.fill(None);
    assert!(
        refused(&silent, &ahead(Vec3::x()))
            .starts_with("the sensor `tibia_r_imu` has no orientation in the standing posture (made)")
    );

    let text = refused(&good, &ahead(Vec3::y()));
    assert!(text.starts_with("the axis y of `pelvis_imu` is 90 degrees from the horizontal"), "{text}");
    let other = SensorAxes {
        heading: SensorHeading::Sensor { sensor: "belt".into(), axis: Vec3::x() },
        ..SensorAxes::default()
    };
    assert!(
        refused(&good, &other).starts_with("there is no sensor `belt` for the heading; expected one of `pelvis_imu`, ")
    );

    let still = Made { moving: good.standing.clone(), ..made(&BODIES) };
    let text = refused(&still, &SensorAxes::default());
    assert!(
        text.contains("the knees bend by 0 degrees on average at most; expected knees that bend by 15 degrees"),
        "{text}"
    );

    let mut findings = Findings::default();
    let trial = SensorTrial { moving: &good.moving, standing: None, axes: &ahead(Vec3::x()) };
    let fit = fit_sensors(&good.model, &good.soles, &trial, &FitSettings::default(), &mut findings).unwrap();
    assert!(findings.has(Code::SensorsUnrest), "the first frame is no standing posture");
    let (off, _) = largest_difference(&good.model, &fit.motion, &moving(&good.model));
    assert!(off > 0.1, "{off}");
}

/// The recorded walk: model, motion at 100 Hz, and the sensors of the program that ran OpenSim.
fn walk(folder: &Path) -> (Model, Motion) {
    let mut findings = Findings::default();
    let osim = OsimModel::read(&std::fs::read(folder.join("opensim-rajagopal-walk/subject_walk_scaled.osim")).unwrap());
    let model = from_osim(&osim.unwrap(), &mut findings).unwrap();
    let bytes = std::fs::read(folder.join("opensim-rajagopal-walk/coordinates.sto")).unwrap();
    let table = Table::read_storage(&bytes).unwrap().0.every(10);
    let motion = coordinates_from_table(&model, &table, "coordinates.sto", &mut findings).unwrap();
    (model, motion)
}

const WALK_BODIES: [&str; 14] = [
    "pelvis",
    "torso",
    "femur_r",
    "tibia_r",
    "calcn_r",
    "femur_l",
    "tibia_l",
    "calcn_l",
    "humerus_r",
    "ulna_r",
    "radius_r",
    "humerus_l",
    "ulna_l",
    "radius_l",
];

#[test]
fn a_recorded_walk_gives_back_its_joint_angles() {
    let Some(data) = data() else { return };
    let (model, motion) = walk(&data);
    let (moving, still) =
        (sensors(&model, &motion, &WALK_BODIES, 0.0), sensors(&model, &standing(&model), &WALK_BODIES, 0.0));
    let trial = SensorTrial { moving: &moving, standing: Some(&still), axes: &ahead(Vec3::x()) };
    let soles = Person::of_model(&model).soles;
    let fit = fit_sensors(&model, &soles, &trial, &FitSettings::default(), &mut Findings::default()).unwrap();
    let (off, name) = largest_difference(&model, &fit.motion, &motion);
    println!("recorded walk: largest difference {off:.1e} rad of {name}");
    assert!(off < 1e-6, "{off} {name}");
    for (name, limit) in [("pelvis_tx", 0.03), ("pelvis_ty", 0.015), ("pelvis_tz", 0.03)] {
        let k = model.coordinate(name).unwrap().index();
        let columns = [&fit.motion, &motion].map(|motion| motion.columns[k].as_ref().unwrap());
        let apart: Vec<f64> = columns[0].iter().zip(columns[1]).map(|(a, b)| a - b).collect();
        let mean = apart.iter().sum::<f64>() / apart.len() as f64;
        let off = rms(apart.iter().map(|apart| apart - mean));
        println!("{name}: {:.1} mm rms from the recorded place, without the mean", 1e3 * off);
        assert!(off < limit, "{name}: {off}");
    }
}

#[test]
fn opensim_finds_the_same_angles_for_disturbed_sensors() {
    let Some(data) = data() else { return };
    let (model, motion) = walk(&data);
    let (moving, still) =
        (sensors(&model, &motion, &WALK_BODIES, 0.05), sensors(&model, &standing(&model), &WALK_BODIES, 0.0));
    let trial = SensorTrial { moving: &moving, standing: Some(&still), axes: &ahead(Vec3::x()) };
    let soles = Person::of_model(&model).soles;
    let fit = fit_sensors(&model, &soles, &trial, &FitSettings::default(), &mut Findings::default()).unwrap();
    let reference = include_str!("testdata/opensim_sensors/walk.csv");
    let (table, _) = Table::read_csv(reference.as_bytes()).unwrap();
    let times = table.times().unwrap();
    let frame_at = |time: &f64| motion.times.iter().position(|known| (known - time).abs() < 1e-6).unwrap();
    let mut largest = (0.0, String::new());
    let mut disturbed = 0.0;
    for (name, values) in table.columns().skip(1) {
        let k = model.coordinate(name).unwrap().index();
        for (time, value) in times.iter().zip(values) {
            let frame = frame_at(time);
            let off = (fit.motion.columns[k].as_ref().unwrap()[frame] - value).abs();
            let undisturbed = motion.columns[k].as_ref().map_or(0.0, |column| column[frame]);
            disturbed = f64::max(disturbed, (undisturbed - value).abs());
            if off > largest.0 {
                largest = (off, format!("{name} at {time} s"));
            }
        }
    }
    let (off, place) = largest;
    println!(
        "{} angles at {} times: largest difference from OpenSim {off:.1e} rad ({place}); the disturbance moves them by \
         up to {disturbed:.2} rad",
        table.columns().count() - 1,
        times.len()
    );
    assert!(off < 3e-3 && disturbed > 0.05, "{off} {place} {disturbed}");

    // OpenSim's solver stops before the minimum of its own sum of squared angles; ours is of chords, which differ by
    // θ²/12 of each.
    let mut least: f64 = 0.0;
    for (row, time) in times.iter().enumerate() {
        let frame = frame_at(time);
        let ours: Vec<f64> = fit.motion.columns.iter().map(|column| column.as_ref().unwrap()[frame]).collect();
        let mut theirs = ours.clone();
        for (name, values) in table.columns().skip(1) {
            theirs[model.coordinate(name).unwrap().index()] = values[row];
        }
        let [ours, theirs] = [ours, theirs].map(|q| squared_angles(&model, &q, &moving, frame));
        least = least.max(theirs / ours - 1.0);
        assert!(ours <= theirs * (1.0 + 1e-5), "{time}: {ours} rad² above OpenSim's {theirs} rad²");
    }
    println!("the sum of squared angles is lower than OpenSim's, by a share of up to {least:.1e}");
}

/// Sum of the squared angles between bodies and sensors [rad²].
fn squared_angles(model: &Model, q: &[f64], moving: &SensorRecording, frame: usize) -> f64 {
    let rest = vec![0.0; model.coordinates().len()];
    let poses = body_motion(model, Posture { q, qd: &rest, qdd: &rest });
    let world_from_earth = turn(HEADING * Vec3::y()) * turn(-FRAC_PI_2 * Vec3::x());
    let angle = |(k, body): (usize, &&str)| {
        let measured = world_from_earth * moving.sensors[k].orientations[frame].unwrap();
        let off = (poses[model.body(body).unwrap().index()].pose.rotation * mount(k)).transpose() * measured;
        UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(off)).angle()
    };
    WALK_BODIES.iter().enumerate().map(angle).map(|angle| angle * angle).sum()
}

/// Root mean square.
fn rms(values: impl Iterator<Item = f64>) -> f64 {
    let squares: Vec<f64> = values.map(|x| x * x).collect();
    (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
}

#[test]
fn a_walk_from_sensors_has_nearly_the_ground_forces_of_the_whole_motion() {
    let Some(data) = data() else { return };
    let (model, motion) = walk(&data);
    let (moving, still) =
        (sensors(&model, &motion, &WALK_BODIES, 0.0), sensors(&model, &standing(&model), &WALK_BODIES, 0.0));
    let run = |source: Source| study::run(source, &Settings::default(), &mut Findings::default()).unwrap();
    let whole = run(Source::coordinates(model.clone(), motion.clone()));
    let body = SensorBody::Model(model.clone());
    let sensors = SensorSource { moving, standing: Some(still), axes: SensorAxes::default(), body };
    let derived = run(Source::new(Recording::Sensors(Box::new(sensors))));

    let reason = derived.quality.reasons.iter().find(|reason| reason.measure == Measure::DerivedPlace).unwrap();
    assert_eq!(reason.state, QualityState::Doubtful);
    assert!(reason.message.starts_with("where the person is was derived from the feet on the ground, not measured"));
    assert!(whole.quality.reasons.iter().all(|reason| reason.measure != Measure::DerivedPlace));

    let weight = 9.80665 * model.mass();
    let totals = [&whole, &derived].map(|outcome| &outcome.prediction.as_ref().unwrap().prediction.total);
    assert_eq!(totals[0].len(), totals[1].len());
    let percent =
        |axis: usize| 100.0 / weight * rms(totals[0].iter().zip(totals[1]).map(|(a, b)| a.force[axis] - b.force[axis]));
    let [along, up, across] = [percent(0), percent(1), percent(2)];
    println!("total ground force, rms difference: {along:.1} %BW forward, {up:.1} %BW up, {across:.1} %BW to the side");
    let speed = |outcome: &study::Outcome| outcome.times_and_distances.speed_m_s;
    println!("speed {:?} m/s from sensors, {:?} m/s from the whole motion", speed(&derived), speed(&whole));
    for name in ["hip_flexion_r_moment", "knee_angle_r_moment", "ankle_angle_r_moment"] {
        let index = model.force_names().iter().position(|known| known == name).unwrap();
        let forces = [&whole, &derived].map(|outcome| &outcome.analysis.forces.generalized[index]);
        let off = rms(forces[0].iter().zip(forces[1]).map(|(a, b)| a - b)) / model.mass();
        println!("{name}: rms difference {off:.3} N.m/kg");
        assert!(off < 0.3, "{name}: {off}");
    }
    assert!(along < 12.0 && up < 12.0 && across < 12.0, "{along} {up} {across}");
}
