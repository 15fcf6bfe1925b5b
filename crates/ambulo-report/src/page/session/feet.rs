//! Where the feet are when they strike.

use super::results::Results;
use ambulo::kinematics::{Posture, body_motion};
use ambulo::model::anatomy::Sole;
use ambulo::model::{CoordinateKind, Model, Movement, Side};
use ambulo::motion::interpolate;
use ambulo::spatial::Vec3;

/// The floor moves if the body gets this share less far than its feet carry it.
const MOVING_FLOOR: f64 = 0.2;

/// A strike of a foot, and the place of its heel on the floor that it stands on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Strike {
    pub(super) side: Side,
    pub(super) time_s: f64,
    /// Rear point of the sole, as if the floor had stood still since the recording began [m].
    pub(super) heel: Vec3,
}

/// All strikes in order of time; none without a body whose feet are known.
pub(super) fn strikes(results: &Results) -> Vec<Strike> {
    let Some((_, model)) = &results.body else { return Vec::new() };
    let soles = model.anatomy().soles(model.stature().height_m);
    let floor = floor_velocity(results);
    let events = results.events.iter().filter(|event| event.strike);
    let strike = |time_s: f64, side: Side, sole: &Sole| {
        let rear = sole.points[0];
        let place = pose_place(results, model, time_s, rear.body.index(), rear.place);
        Strike { side, time_s, heel: place - floor * (time_s - results.grid.start_s) }
    };
    let mut list: Vec<Strike> = events
        .filter_map(|event| {
            let (side, sole) = soles.iter().find(|(side, _)| super::sides::page(*side) == event.side)?;
            Some(strike(event.time_s, side, sole.as_ref()?))
        })
        .collect();
    list.sort_by(|a, b| a.time_s.total_cmp(&b.time_s));
    list
}

/// A point of a body at an instant, in the world.
fn pose_place(results: &Results, model: &Model, time_s: f64, body: usize, point: Vec3) -> Vec3 {
    let value = |coordinate: &ambulo::model::Coordinate| {
        let Some(column) = results.kinematics.column(&coordinate.name) else { return coordinate.default_value };
        let shown = interpolate(&results.times, column, time_s);
        if coordinate.kind == CoordinateKind::Rotation { shown.to_radians() } else { shown }
    };
    let q: Vec<f64> = model.coordinates().iter().map(value).collect();
    let rest = vec![0.0; q.len()];
    body_motion(model, Posture { q: &q, qd: &rest, qdd: &rest })[body].pose.place(point)
}

/// How the floor moves [m/s]: a belt, if the body stays behind what its feet carry it; else nothing.
pub(super) fn floor_velocity(results: &Results) -> Vec3 {
    let (Some(way), Some(speed)) = (pelvis_velocity(results), results.summary.speed_m_s) else {
        return Vec3::zeros();
    };
    // On a curved path, too, the body ends nearer than its speed says.
    let straight = results.turn_deg().is_none();
    match straight && speed > 0.0 && speed - way.norm() > MOVING_FLOOR * speed {
        true => Vec3::x() * (way.x - speed),
        false => Vec3::zeros(),
    }
}

/// Mean velocity of the pelvis along the floor [m/s].
pub(super) fn pelvis_velocity(results: &Results) -> Option<Vec3> {
    let duration = results.grid.end_s() - results.grid.start_s;
    let way = |movement: Movement| {
        let column = results.kinematics.column(results.clinical_names().central(movement)?)?;
        Some((column.last()? - column.first()?) / duration)
    };
    Some(Vec3::new(way(Movement::PelvisForward)?, 0.0, way(Movement::PelvisRight).unwrap_or(0.0)))
}
