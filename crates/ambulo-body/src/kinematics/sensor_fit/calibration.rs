//! Calibration of sensors: their orientation on their bodies, and the forward direction.

use super::{PlacedSensor, SensorAxes, SensorError, SensorHeading, SensorTrial};
use crate::findings::{Code, Findings};
use crate::model::{BodyId, Model, ModelPosture, Side};
use crate::motion::{PosedSegment, SensorRecording, posed_segment};
use crate::numerics::elementary::{asin, atan2};
use crate::numerics::{Order, degrees};
use crate::spatial::{Mat3, Vec3, rotation_about, rotation_vector};

/// Ending of the names of sensors, after the name of the body.
const ENDING: &str = "_imu";
/// Smallest bending of a knee that shows the direction forward [rad]: 15 degrees.
const KNEE_BENDS: f64 = 0.262;
/// Largest angle of an axis forward from the horizontal [rad]: 60 degrees.
const LEVEL: f64 = 1.047;
/// Fastest turn of a person standing still [rad/s].
const STILL: f64 = 0.5;
/// Time at the beginning in which the person stands, if there is no standing trial [s].
const FIRST_S: f64 = 0.1;

/// Sensors on their bodies, and the turn of their earth.
pub(super) struct Calibration {
    pub(super) placed: Vec<PlacedSensor>,
    /// World from earth, with the heading.
    pub(super) turn: Mat3,
    /// The part of the turn about the vertical [rad].
    pub(super) heading: f64,
}

/// A sensor with the body that it is on, and its orientation in the standing posture.
struct Standing {
    name: String,
    number: usize,
    body: BodyId,
    earth_from_sensor: Mat3,
}

pub(super) fn calibrated(
    model: &Model,
    trial: &SensorTrial<'_>,
    findings: &mut Findings,
) -> Result<Calibration, SensorError> {
    let standing = standing_sensors(model, trial, findings)?;
    let default = model.coordinates().iter().map(|coordinate| coordinate.default_value).collect();
    let posture = ModelPosture::new(model, default);
    let world_from_earth = trial.axes.world_from_earth;
    let up = model.up();
    let forward = level(posture.poses[0].rotation.column(0).into(), up).unwrap_or_else(Vec3::x);
    let facing = facing(model, trial, &standing, forward, up)?;
    let heading = atan2(up.dot(&facing.cross(&forward)), facing.dot(&forward));
    let turn = rotation_about(up.normalize(), heading) * world_from_earth;
    report_heading(&trial.axes.heading, heading, findings);
    let placed = standing.into_iter().map(|sensor| PlacedSensor {
        body_from_sensor: posture.poses[sensor.body.index()].rotation.transpose() * turn * sensor.earth_from_sensor,
        name: sensor.name,
        number: sensor.number,
        body: sensor.body,
    });
    Ok(Calibration { placed: placed.collect(), turn, heading })
}

/// The sensors that are on bodies, in the standing posture.
fn standing_sensors(
    model: &Model,
    trial: &SensorTrial<'_>,
    findings: &mut Findings,
) -> Result<Vec<Standing>, SensorError> {
    let mut standing: Vec<Standing> = Vec::new();
    let mut others = Vec::new();
    for (number, sensor) in trial.moving.sensors.iter().enumerate() {
        match body_of(model, &sensor.name) {
            Some(body) if standing.iter().all(|known| known.body != body) => {
                let earth_from_sensor = standing_orientation(trial, &sensor.name)?;
                standing.push(Standing { name: sensor.name.clone(), number, body, earth_from_sensor });
            }
            _ => others.push(format!("`{}`", sensor.name)),
        }
    }
    if standing.is_empty() {
        let example: Vec<String> =
            model.bodies().iter().take(4).map(|body| format!("`{}{ENDING}`", body.name)).collect();
        let (sensors, model, example) = (others.join(", "), model.name().to_owned(), example.join(", "));
        return Err(SensorError::NoBody { sensors, model, example });
    }
    if !others.is_empty() {
        let message = format!(
            "sensors on no body of the model, or on one that has another sensor, were not used: {}",
            others.join(", ")
        );
        findings.report(Code::SensorsUnknown, message);
    }
    report_unrest(trial, findings);
    Ok(standing)
}

/// The body that a sensor is on: by its name without the ending, or by the segment that the name means.
fn body_of(model: &Model, sensor: &str) -> Option<BodyId> {
    let lower = sensor.to_lowercase();
    let name = lower.strip_suffix(ENDING).map_or(sensor, |stem| &sensor[..stem.len()]);
    model.body(name).or_else(|| {
        let segment = segment_of(name)?;
        model.body_ids().find(|body| segment_of(&model.bodies()[body.index()].name) == Some(segment))
    })
}

/// The segment that a name means; also names of bodies in OpenSim.
fn segment_of(body: &str) -> Option<PosedSegment> {
    let Some((side, stem)) = Side::split_name(body) else {
        return posed_segment(body);
    };
    Some(match stem.as_str() {
        "calcn" => PosedSegment::Foot(side),
        "ulna" | "radius" => PosedSegment::Forearm(side),
        _ => return posed_segment(body),
    })
}

/// Mean orientation in the standing trial; without one, that in the first frame of the motion.
fn standing_orientation(trial: &SensorTrial<'_>, sensor: &str) -> Result<Mat3, SensorError> {
    let none = |place: &str| SensorError::NotCalibrated { sensor: sensor.to_owned(), place: place.to_owned() };
    let path = |recording: &SensorRecording| recording.sensors.iter().position(|known| known.name == sensor);
    match trial.standing {
        None => {
            let path = path(trial.moving).map(|number| &trial.moving.sensors[number].orientations);
            path.and_then(|path| *path.first()?).ok_or_else(|| none("the first frame of the motion"))
        }
        Some(standing) => {
            let path = path(standing).map(|number| &standing.sensors[number].orientations);
            path.and_then(|path| mean(path.iter().flatten())).ok_or_else(|| none(&standing.name))
        }
    }
}

/// The rotation with the least sum of squared differences from some rotations.
fn mean<'r>(rotations: impl Iterator<Item = &'r Mat3>) -> Option<Mat3> {
    crate::kinematics::pose_fit::mean_rotation(rotations.copied())
}

/// Reports a person who moves in the standing posture.
fn report_unrest(trial: &SensorTrial<'_>, findings: &mut Findings) {
    let (recording, until_s) = match trial.standing {
        Some(standing) => (standing, f64::INFINITY),
        None => (trial.moving, trial.moving.times.first().map_or(0.0, |first| first + FIRST_S)),
    };
    let mut fastest: Option<(&str, f64)> = None;
    for sensor in &recording.sensors {
        let Some(first) = sensor.orientations.first().copied().flatten() else { continue };
        let last = recording.times.partition_point(|time| *time <= until_s).saturating_sub(1);
        let span = recording.times[last] - recording.times[0];
        let Some(end) = sensor.orientations[last].filter(|_| span > 0.0) else { continue };
        let speed = rotation_vector(&(first.transpose() * end)).norm() / span;
        if fastest.is_none_or(|(_, known)| speed > known) {
            fastest = Some((&sensor.name, speed));
        }
    }
    if let Some((sensor, speed)) = fastest.filter(|(_, speed)| *speed > STILL) {
        let place = if trial.standing.is_some() { "in the standing trial" } else { "at the beginning of the motion" };
        let message = format!(
            "the person moves {place}, where the default posture of the model is assumed: `{sensor}` turns by {:.0} \
             degrees/s; every angle is off by what the posture there differs",
            speed.to_degrees()
        );
        findings.report(Code::SensorsUnrest, message);
    }
}

/// The horizontal direction in which the person faces in the standing posture, in world axes before the turn of the
/// heading.
fn facing(
    model: &Model,
    trial: &SensorTrial<'_>,
    standing: &[Standing],
    forward: Vec3,
    up: Vec3,
) -> Result<Vec3, SensorError> {
    let SensorAxes { world_from_earth, heading } = trial.axes;
    match heading {
        SensorHeading::OfModel => Ok(forward),
        SensorHeading::Sensor { sensor, axis } => {
            let Some(base) = standing.iter().find(|known| known.name.eq_ignore_ascii_case(sensor)) else {
                let known: Vec<String> = standing.iter().map(|known| format!("`{}`", known.name)).collect();
                return Err(SensorError::NoBaseSensor { found: sensor.clone(), known: known.join(", ") });
            };
            let ahead = world_from_earth * base.earth_from_sensor * axis;
            let above = asin(ahead.dot(&up).clamp(-1.0, 1.0));
            let odd = SensorError::HeadingAxis {
                axis: axis_name(axis),
                sensor: base.name.clone(),
                angle_deg: above.to_degrees(),
            };
            if above.abs() > LEVEL { Err(odd) } else { level(ahead, up).ok_or(odd) }
        }
        SensorHeading::Knees => {
            let left = mean_bending(model, trial, standing).map(|bending| world_from_earth * bending);
            let bends = left.map_or(0.0, |left| (left - up * left.dot(&up)).norm());
            let found = match left {
                None => "no leg has sensors on thigh and shank".to_owned(),
                Some(_) => format!("the knees bend by {} on average at most", degrees(bends.to_degrees())),
            };
            let unknown = || SensorError::Heading { found, expected_deg: KNEE_BENDS.to_degrees() };
            let left = left.filter(|_| bends > KNEE_BENDS).and_then(|left| level(left, up)).ok_or_else(unknown)?;
            Ok(left.cross(&up))
        }
    }
}

/// Mean rotation of the shanks relative to the thighs since the standing posture, over the legs and the largest tenth
/// of rotations. The rotations are as if the thighs still stood, in the axes of the sensors' earth [rad]. Knees bend
/// backwards, so it points to the left.
fn mean_bending(model: &Model, trial: &SensorTrial<'_>, standing: &[Standing]) -> Option<Vec3> {
    let of = |segment: PosedSegment| {
        standing.iter().find(|sensor| segment_of(&model.bodies()[sensor.body.index()].name) == Some(segment))
    };
    let displaced = |sensor: &Standing, frame: usize| {
        let now = trial.moving.sensors[sensor.number].orientations[frame]?;
        Some(now * sensor.earth_from_sensor.transpose())
    };
    let mut sum = Vec3::zeros();
    let mut legs = 0;
    for side in Side::BOTH {
        let (Some(thigh), Some(shank)) = (of(PosedSegment::Thigh(side)), of(PosedSegment::Shank(side))) else {
            continue;
        };
        let turn = |frame: usize| {
            let relative = displaced(thigh, frame)?.transpose() * displaced(shank, frame)?;
            Some(rotation_vector(&relative))
        };
        let mut turns: Vec<Vec3> = (0..trial.moving.times.len()).filter_map(turn).collect();
        turns.sort_by_number(|vector| -vector.norm());
        turns.truncate(turns.len().div_ceil(10));
        if !turns.is_empty() {
            sum += turns.iter().sum::<Vec3>() / turns.len() as f64;
            legs += 1;
        }
    }
    (legs > 0).then(|| sum / f64::from(legs))
}

/// The horizontal part of a direction, with unit length.
fn level(direction: Vec3, up: Vec3) -> Option<Vec3> {
    (direction - up * direction.dot(&up)).try_normalize(1e-9)
}

fn axis_name(axis: &Vec3) -> String {
    let largest = axis.iamax();
    format!("{}{}", if axis[largest] < 0.0 { "-" } else { "" }, ["x", "y", "z"][largest])
}

fn report_heading(source: &SensorHeading, heading: f64, findings: &mut Findings) {
    let by = match source {
        SensorHeading::OfModel => return,
        SensorHeading::Knees => "the bending of the knees".to_owned(),
        SensorHeading::Sensor { sensor, axis } => format!("the axis {} of `{sensor}`", axis_name(axis)),
    };
    let message = format!(
        "the sensors were turned by {:.1} degrees about the vertical, so that the person faces forward in the standing \
         posture, by {by}",
        heading.to_degrees()
    );
    findings.report(Code::SensorsHeading, message);
}
