//! Finds the coordinates that the sensors determine.
//!
//! Between a body with a sensor and the next one with a sensor towards the ground, three angles at most are determined,
//! and only if their axes are independent in the default posture.

use super::PlacedSensor;
use crate::model::{BodyId, CoordinateId, Drive, Model, ModelPosture};
use crate::spatial::Vec3;

/// Smallest sine between two axes, or volume between three, of angles that are distinguished: 6 degrees.
const INDEPENDENT: f64 = 0.1;

/// Names of the coordinates that turn sensors and cannot be distinguished.
pub(super) fn undetermined(model: &Model, placed: &[PlacedSensor]) -> Vec<String> {
    let default = model.coordinates().iter().map(|coordinate| coordinate.default_value).collect();
    let posture = ModelPosture::new(model, default);
    let mut names = Vec::new();
    for sensor in placed {
        let axes = axes_below(model, &posture, placed, sensor.body);
        if !are_independent(&axes.iter().map(|(_, axis)| *axis).collect::<Vec<Vec3>>()) {
            names.extend(axes.iter().map(|(id, _)| format!("`{}`", model.coordinates()[id.index()].name)));
        }
    }
    names
}

/// Free coordinates that turn a body relative to the next one with a sensor, with their axes in the default posture.
fn axes_below(
    model: &Model,
    posture: &ModelPosture<'_>,
    placed: &[PlacedSensor],
    body: BodyId,
) -> Vec<(CoordinateId, Vec3)> {
    let mut axes = Vec::new();
    let mut next = Some(body);
    while let Some(id) = next.filter(|id| *id == body || placed.iter().all(|sensor| sensor.body != *id)) {
        let joint = &model.bodies()[id.index()].joint;
        for coordinate in joint.coordinates() {
            let axis = posture.slopes(id, coordinate)[0].try_normalize(1e-9);
            if let (Drive::Free, Some(axis)) = (&model.coordinates()[coordinate.index()].drive, axis) {
                axes.push((coordinate, axis));
            }
        }
        next = joint.parent;
    }
    axes
}

fn are_independent(axes: &[Vec3]) -> bool {
    match axes {
        [] | [_] => true,
        [a, b] => a.cross(b).norm() > INDEPENDENT,
        [a, b, c] => a.cross(b).dot(c).abs() > INDEPENDENT,
        _ => false,
    }
}
