//! A model with the stated mass and stature of a person.

use super::error::StudyError;
use crate::findings::{Code, Findings};
use crate::model::{CoordinateKind, Displacement, Model};
use crate::motion::Motion;
use crate::spatial::Vec3;
use serde::Deserialize;

/// Along the vertical, rather than along the floor, if the upward part of a unit direction is larger: half a right
/// angle.
const UPWARD: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// Mass and stature that are stated for the person who moved; a model of another size is scaled to them.
#[derive(Debug, Clone, Copy, Default, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct StatedSize {
    /// Body mass [kg].
    pub mass_kg: Option<f64>,
    /// Stature [m].
    pub height_m: Option<f64>,
}

impl StatedSize {
    /// The model with this mass and stature: all lengths by one factor l, all masses by one factor m, inertias by m
    /// l^2.
    pub(super) fn applied(self, model: &Model, findings: &mut Findings) -> Result<Model, StudyError> {
        if self == StatedSize::default() {
            return Ok(model.clone());
        }
        let factor = self.length_factor(model);
        let factors = vec![Vec3::repeat(factor); model.bodies().len()];
        let scaled = model.scaled(&factors, self.mass_kg).map_err(StudyError::Size)?;
        let mut changes = Vec::new();
        if self.mass_kg.is_some() {
            let (own, kg) = (model.mass(), scaled.mass());
            changes.push(format!("masses by {:.3}, from {own:.2} to {kg:.2} kg", kg / own));
        }
        if let Some(height_m) = self.height_m {
            let own_m = model.stature().height_m;
            changes.push(format!("lengths by {factor:.3}, from a stature of {own_m:.3} to {height_m:.3} m"));
        }
        let inertias = factor * factor * scaled.mass() / model.mass();
        findings.report(
            Code::MassScaled,
            format!("the model was scaled to the stated size: {}; inertias by {inertias:.3}", changes.join(", ")),
        );
        Ok(scaled)
    }

    fn length_factor(self, model: &Model) -> f64 {
        self.height_m.map_or(1.0, |height_m| height_m / model.stature().height_m)
    }

    /// The motion of the scaled model: recorded lengths grow with the body, so that feet stay on the floor and do not
    /// slide. Where ground forces were measured, the path along the floor was measured in the laboratory and stays.
    pub(super) fn moved(self, model: &Model, mut motion: Motion, is_measured: bool) -> Motion {
        if self.height_m.is_none() {
            return motion;
        }
        let factor = self.length_factor(model);
        let up = model.up();
        for body in model.bodies() {
            for axis in &body.joint.translations {
                let Displacement::Follows(id, _) = &axis.displacement else { continue };
                let is_length = model.coordinates()[id.index()].kind == CoordinateKind::Translation;
                let is_path = is_measured && body.joint.parent.is_none() && axis.direction.dot(&up).abs() < UPWARD;
                if let (true, false, Some(column)) = (is_length, is_path, &mut motion.columns[id.index()]) {
                    column.iter_mut().for_each(|length| *length *= factor);
                }
            }
        }
        motion
    }
}
