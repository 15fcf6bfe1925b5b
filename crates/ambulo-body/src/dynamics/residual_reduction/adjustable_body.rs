//! Parameters of the body that residual reduction may adjust: total mass and the trunk's mass centre.

use super::settings::{
    CENTER_TOLERANCE_M, MASS_TOLERANCE, MOST_CENTER_M, MOST_MASS_SHARE, ResidualReductionError,
    ResidualReductionSettings,
};
use crate::model::{BodyId, Model, ModelError};
use crate::spatial::{Inertia, Vec3};

/// One adjustable parameter.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Parameter {
    Mass,
    Center(usize),
}

/// A model with its adjustable parameters.
#[derive(Debug, Clone)]
pub(super) struct AdjustableBody<'a> {
    model: &'a Model,
    trunk: BodyId,
    parameters: Vec<Parameter>,
}

impl<'a> AdjustableBody<'a> {
    /// Takes the heaviest segment as the trunk.
    pub(super) fn new(model: &'a Model, settings: &ResidualReductionSettings) -> AdjustableBody<'a> {
        let mass = |id: &BodyId| model.bodies()[id.index()].inertia.mass();
        let heaviest = |a: BodyId, b: BodyId| if mass(&b) > mass(&a) { b } else { a };
        let trunk = model.body_ids().reduce(heaviest).unwrap_or(BodyId(0));
        let mut parameters = Vec::new();
        if settings.adjust_mass {
            parameters.push(Parameter::Mass);
        }
        if settings.adjust_trunk_center {
            parameters.extend((0..3).map(Parameter::Center));
        }
        AdjustableBody { model, trunk, parameters }
    }

    pub(super) fn count(&self) -> usize {
        self.parameters.len()
    }

    /// Standard deviation and largest change of a parameter [share or m].
    pub(super) fn tolerance_and_most(&self, parameter: usize) -> [f64; 2] {
        match self.parameters[parameter] {
            Parameter::Mass => [MASS_TOLERANCE, MOST_MASS_SHARE],
            Parameter::Center(_) => [CENTER_TOLERANCE_M, MOST_CENTER_M],
        }
    }

    /// Name of the trunk.
    pub(super) fn trunk(&self) -> &str {
        &self.model.bodies()[self.trunk.index()].name
    }

    /// The share that these parameter values add to all masses, and the displacement of the trunk's mass centre [m].
    pub(super) fn change(&self, values: &[f64]) -> (f64, Vec3) {
        let (mut mass_share, mut center_m) = (0.0, Vec3::zeros());
        for (parameter, value) in self.parameters.iter().zip(values) {
            match parameter {
                Parameter::Mass => mass_share = *value,
                Parameter::Center(axis) => center_m[*axis] = *value,
            }
        }
        (mass_share, center_m)
    }

    /// The model with these parameter values.
    pub(super) fn with(&self, values: &[f64]) -> Result<Model, ResidualReductionError> {
        let (mass_share, trunk_center_m) = self.change(values);
        let mut model = self.model.clone();
        if self.parameters.is_empty() {
            return Ok(model);
        }
        for id in self.model.body_ids() {
            let body = &self.model.bodies()[id.index()];
            let shift = if id == self.trunk { trunk_center_m } else { Vec3::zeros() };
            let (own, factor) = (body.inertia, 1.0 + mass_share);
            let changed = Inertia::new(factor * own.mass(), own.center() + shift, own.about_center() * factor)
                .map_err(|source| ModelError::Inertia { body: body.name.clone(), source })?;
            model = model.with_inertia(id, changed);
        }
        Ok(model)
    }
}
