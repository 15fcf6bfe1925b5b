//! Metabolic power and work of the body in the same walk without its devices.

use super::conditions::{Device, WalkConditions};
use super::error::OptimalWalkError;
use super::find::OptimalWalk;
use super::observer::Observer;
use super::predict::{DeviceEffort, metabolic_power};
use crate::gait::Walk;
use crate::model::anthropometry::Build;

/// The same walk, at the same speed and cadence, without its devices.
#[derive(Debug, Clone, PartialEq)]
pub struct Unassisted {
    /// Metabolic power, as [`metabolic_power`] [W/kg of the body without load].
    pub metabolic_power: f64,
    /// Positive and negative work of the body at each joint with a device [J/kg of the body without load], in the order
    /// of [`DeviceEffort::of`].
    pub body_work: Vec<[f64; 2]>,
}

impl Unassisted {
    /// Predicts the walk of some conditions without their devices. If the conditions differ between the sides only by
    /// devices, both sides of this walk may still differ: a walk that is solved over a whole cycle costs up to one
    /// percent more or less than one that is solved over half a cycle, and that is not the devices' doing.
    ///
    /// # Errors
    /// As [`OptimalWalk::predict`]: it may be that the muscles alone cannot do it. An observer that stops the solver.
    pub fn predict(
        build: &Build,
        walk: &Walk,
        conditions: &WalkConditions,
        observer: &Observer,
    ) -> Result<Unassisted, OptimalWalkError> {
        let asymmetric = conditions.asymmetric || !conditions.is_symmetric();
        let without = WalkConditions { devices: Vec::new(), free_cadence: false, asymmetric, ..conditions.clone() };
        let found = OptimalWalk::predict_observed(build, walk, &without, observer)?;
        let idle = |device: &Device| Device { stiffness: 0.0, damping: 0.0, moments: Vec::new(), ..device.clone() };
        let idle: Vec<Device> = conditions.devices.iter().map(idle).collect();
        let efforts = DeviceEffort::of(&found.solution, walk, build.mass, &idle)?;
        Ok(Unassisted {
            metabolic_power: metabolic_power(&found.solution, walk, build.mass, &[])?,
            body_work: efforts.into_iter().map(|effort| effort.body_work).collect(),
        })
    }
}
