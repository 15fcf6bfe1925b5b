//! The floor under a recorded motion, and the body on it: which ones are supported.

use super::{FootGuide, TrackError};
use crate::model::{BySide, CoordinateId, Displacement, Drive, Joint, JointAxis, Model};
use crate::numerics::{extremes, mean};
use crate::spatial::Vec3;

/// Floors of different stances may differ by this height [m].
const LEVEL_M: f64 = 0.02;
/// Velocities of the floor may differ by this [m/s].
const STEADY_M_S: f64 = 0.05;

pub(super) fn checked(model: &Model) -> Result<(), TrackError> {
    let name = || model.name().to_owned();
    if (model.up() - Vec3::y()).norm() > 1e-6 {
        return Err(TrackError::NotUpright { model: name() });
    }
    if let Some(bushing) = model.bushings().first() {
        return Err(TrackError::Bushing { model: name(), bushing: bushing.name.clone() });
    }
    let roots = model.bodies().iter().filter(|body| body.joint.parent.is_none());
    let is_free = |id: CoordinateId| matches!(model.coordinates()[id.index()].drive, Drive::Free);
    let ids: Vec<CoordinateId> = roots.flat_map(|body| body.joint.coordinates()).collect();
    if ids.len() != 6 || !ids.into_iter().all(is_free) {
        return Err(TrackError::HeldRoot { model: name() });
    }
    Ok(())
}

/// The height of the floor [m].
pub(super) fn level(feet: &BySide<FootGuide>) -> Result<f64, TrackError> {
    let all: Vec<f64> = feet.values().flat_map(|foot| foot.floors_m.iter().copied()).collect();
    let (low, high) = extremes(&all);
    if all.is_empty() {
        return Err(TrackError::NoStance);
    }
    if high - low > LEVEL_M {
        return Err(TrackError::UnevenFloor { what: "height", found: high - low, most: LEVEL_M, unit: "m" });
    }
    Ok(mean(&all))
}

/// The velocity of the floor [m/s].
pub(super) fn steady(feet: &BySide<FootGuide>) -> Result<Vec3, TrackError> {
    let all: Vec<Vec3> = feet.values().flat_map(|foot| foot.floor_velocities.iter().copied()).collect();
    let mean = all.iter().sum::<Vec3>() / all.len().max(1) as f64;
    let found = all.iter().map(|v| (v - mean).norm()).fold(0.0, f64::max);
    if found > STEADY_M_S {
        return Err(TrackError::UnevenFloor { what: "velocity", found, most: STEADY_M_S, unit: "m/s" });
    }
    Ok(mean)
}

/// Translations of the root: coordinate, and how it moves the root.
fn root_axes(model: &Model) -> Vec<(usize, Vec3)> {
    let roots = model.bodies().iter().map(|body| &body.joint).filter(|joint| joint.parent.is_none());
    let axis = |joint: &Joint, axis: &JointAxis| match &axis.displacement {
        Displacement::Follows(id, function) => {
            Some((id.index(), joint.parent_from_joint.rotation * axis.direction * function.as_linear()?.0))
        }
        Displacement::Fixed(_) => None,
    };
    roots.flat_map(|joint| joint.translations.iter().filter_map(move |one| axis(joint, one))).collect()
}

/// Rate of each coordinate that moves the body with the floor [m/s].
pub(super) fn belt(model: &Model, velocity: Vec3) -> Vec<f64> {
    let mut rates = vec![0.0; model.coordinates().len()];
    for (c, axis) in root_axes(model) {
        rates[c] = velocity.dot(&axis) / axis.norm_squared();
    }
    rates
}

/// The inverse of [`belt`].
pub(super) fn floor_velocity(model: &Model, belt: &[f64]) -> Vec3 {
    root_axes(model).into_iter().map(|(c, axis)| axis * belt[c]).sum()
}
