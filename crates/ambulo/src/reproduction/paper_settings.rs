//! Values for what the paper does not give, and what they make of figure, gait and signals.

use super::error::ReproductionError;
use super::figures_of_mass::{rebuilt, with_soles, with_thickness};
use crate::contact::HuntCrossley;
use crate::gait::{Gait, Pelvis, Style, Walk};
use crate::model::anthropometry::Human;
use crate::model::{Function, Model};
use crate::simulation::walking::gait_signals;
use crate::simulation::{ImpactLaw, Signal};

/// What the paper leaves open. The default is what its mode takes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PaperSettings {
    /// Stature [m]; `None` leaves the figure's.
    pub height: Option<f64>,
    /// Cross-section of the segments against the figure's.
    pub thickness: f64,
    /// Radii of the soles' spheres against the figure's; the sole plane stays.
    pub sole_radii: f64,
    /// Whether there is a sphere under the tip of the toes.
    pub toe_spheres: bool,
    /// Swing of shoulders and elbows against the gait's.
    pub arm_swing: f64,
    /// Added to both hips' flexion [rad].
    pub hip_offset: f64,
    /// How the joint curves run between their knots; `None` leaves the gait's. Of no effect on gaits with changes of knots.
    pub style: Option<Style>,
    /// Step length of all gaits against their own.
    pub step_length: f64,
    /// Step height of all gaits against their own.
    pub step_height: f64,
    /// Step length of one gait against the standard one, in place of its own.
    pub own_length: Option<(&'static str, f64)>,
    /// What becomes of the velocity of what strikes.
    pub impact: ImpactLaw,
    /// Soft shoes.
    pub soft_shoes: HuntCrossley,
}

impl Default for PaperSettings {
    fn default() -> PaperSettings {
        PaperSettings {
            height: None,
            thickness: 1.0,
            sole_radii: 1.0,
            toe_spheres: true,
            arm_swing: 1.0,
            hip_offset: 0.0,
            style: None,
            step_length: 1.0,
            step_height: 1.0,
            own_length: None,
            impact: ImpactLaw::Sticking,
            soft_shoes: HuntCrossley::FALISSE_2022,
        }
    }
}

impl PaperSettings {
    pub(super) fn figure(&self, human: &Human) -> Result<Human, ReproductionError> {
        let figure = match self.height {
            Some(height) => rebuilt(human, height)?,
            None => human.clone(),
        };
        let mut figure = with_soles(with_thickness(&figure, self.thickness)?, self.sole_radii);
        if !self.toe_spheres {
            figure.soles.retain(|sole| !sole.name.starts_with("toe"));
        }
        Ok(figure)
    }

    /// The trunk is held at a constant angle, whatever the gait has.
    pub(super) fn gait(&self, gait: &Gait) -> Gait {
        let mut gait = Gait { pelvis: Pelvis::Vertical, ..gait.clone() };
        gait.pace.length_scale *= self.step_length;
        gait.step_height *= self.step_height;
        if let Some((_, scale)) = self.own_length.filter(|(name, _)| *name == gait.name) {
            gait.pace.length_scale = scale;
        }
        if let (Some(style), true) = (self.style, gait.changes.is_empty()) {
            gait.style = style;
        }
        gait
    }

    pub(super) fn signals(&self, walk: &Walk, model: &Model) -> Vec<Signal> {
        let plain = gait_signals(walk, model).into_iter().zip(model.coordinates());
        plain
            .map(|(signal, coordinate)| {
                let of_arm = coordinate.name.starts_with("arm_") || coordinate.name.starts_with("elbow_");
                let slope = if of_arm { self.arm_swing } else { 1.0 };
                let intercept = if coordinate.name.starts_with("hip_") { self.hip_offset } else { 0.0 };
                let changes = (slope - 1.0).abs() > 0.0 || intercept.abs() > 0.0;
                if changes { Signal::Of(Function::Linear { slope, intercept }, Box::new(signal)) } else { signal }
            })
            .collect()
    }
}
