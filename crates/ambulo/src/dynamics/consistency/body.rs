//! The body that may change with the motion: its mass, and where the trunk's mass centre lies.

use super::result::BodyChange;
use super::settings::{CENTER_TOLERANCE_M, MASS_TOLERANCE, MOST_CENTER_M, MOST_MASS_SHARE};
use super::{ConsistencyError, ConsistencySettings};
use crate::model::{BodyId, Model, ModelError};
use crate::spatial::{Inertia, Vec3};

/// A number of the body that may change.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Number {
    Mass,
    Center(usize),
}

/// The numbers of a body that may change, and how far.
#[derive(Debug, Clone)]
pub(super) struct Body<'a> {
    model: &'a Model,
    trunk: BodyId,
    numbers: Vec<Number>,
}

impl<'a> Body<'a> {
    /// The trunk is the heaviest segment.
    pub(super) fn new(model: &'a Model, settings: &ConsistencySettings) -> Body<'a> {
        let mass = |id: &BodyId| model.bodies()[id.index()].inertia.mass();
        let heaviest = |a: BodyId, b: BodyId| if mass(&b) > mass(&a) { b } else { a };
        let trunk = model.body_ids().reduce(heaviest).unwrap_or(BodyId(0));
        let mut numbers = Vec::new();
        if settings.adjust_mass {
            numbers.push(Number::Mass);
        }
        if settings.adjust_trunk_center {
            numbers.extend((0..3).map(Number::Center));
        }
        Body { model, trunk, numbers }
    }

    pub(super) fn count(&self) -> usize {
        self.numbers.len()
    }

    /// How far a number may be off, and the most by which it is changed [share or m].
    pub(super) fn tolerance_and_most(&self, number: usize) -> [f64; 2] {
        match self.numbers[number] {
            Number::Mass => [MASS_TOLERANCE, MOST_MASS_SHARE],
            Number::Center(_) => [CENTER_TOLERANCE_M, MOST_CENTER_M],
        }
    }

    /// What the numbers say.
    pub(super) fn change(&self, values: &[f64]) -> BodyChange {
        let mut change =
            BodyChange { trunk: self.model.bodies()[self.trunk.index()].name.clone(), ..BodyChange::default() };
        for (number, value) in self.numbers.iter().zip(values) {
            match number {
                Number::Mass => change.mass_share = *value,
                Number::Center(axis) => change.trunk_center_m[*axis] = *value,
            }
        }
        change
    }

    /// The body with these numbers.
    pub(super) fn with(&self, values: &[f64]) -> Result<Model, ConsistencyError> {
        let BodyChange { mass_share, trunk_center_m, .. } = self.change(values);
        let mut model = self.model.clone();
        if self.numbers.is_empty() {
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
