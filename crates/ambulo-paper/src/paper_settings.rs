//! Values that the paper does not give, and their effect on figure, gait and signals.

use super::error::ReproductionError;
use super::paper_human::{rebuilt, with_soles, with_thickness, with_toe_reach};
use ambulo_body::contact::HuntCrossley;
use ambulo_body::model::anthropometry::{Human, SpherePart};
use ambulo_body::model::{Function, Model};
use ambulo_walk::engine::{ImpactLaw, Signal};
use ambulo_walk::gait::{Gait, Pelvis, Style, Walk};
use ambulo_walk::walking::{WalkingError, gait_signals};

/// Values that the paper does not give. The default is used in the paper's mode.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PaperSettings {
    /// Stature [m]; `None` for the value of the figure.
    pub height: Option<f64>,
    /// Factor on the cross-section of the segments.
    pub thickness: f64,
    /// Factor on the radii of the spheres of the soles; the plane of the sole is kept.
    pub sole_radii: f64,
    /// Whether there is a sphere under the tip of the toes.
    pub toe_spheres: bool,
    /// Distance from the ankle to the tip of the toes, share of the stature; `None` for the value of the figure.
    pub toe_reach: Option<f64>,
    /// Factor on the swing of shoulders and elbows.
    pub arm_swing: f64,
    /// Angle that is added to the flexion of both hips [rad].
    pub hip_offset: f64,
    /// Interpolation of the joint curves; `None` for the value of the gait. It has no effect on gaits with changes of
    /// knots.
    pub style: Option<Style>,
    /// Factor on the step length of all gaits.
    pub step_length: f64,
    /// Factor on the step height of all gaits.
    pub step_height: f64,
    /// Step length of one gait relative to the standard gait, instead of its own.
    pub own_length: Option<(&'static str, f64)>,
    /// Step length of the short steps relative to the standard gait, instead of their own.
    pub short_length: Option<f64>,
    /// The same for the long steps.
    pub long_length: Option<f64>,
    /// Step height of one gait relative to the standard gait, instead of its own.
    pub own_height: Option<(&'static str, f64)>,
    /// Whether the goose step has the straight knees of the built-in gait `parade`, at its own period.
    pub straight_goose: bool,
    /// Impact law of the soles.
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
            toe_reach: None,
            arm_swing: 1.0,
            hip_offset: 0.0,
            style: None,
            step_length: 1.0,
            step_height: 1.0,
            own_length: None,
            short_length: None,
            long_length: None,
            own_height: None,
            straight_goose: false,
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
            figure.soles.retain(|sole| sole.part != SpherePart::Toes);
        }
        match self.toe_reach {
            Some(reach) => with_toe_reach(figure, reach),
            None => Ok(figure),
        }
    }

    /// The gait with these settings; the trunk is always held at a constant angle.
    pub(super) fn gait(&self, gait: &Gait) -> Gait {
        let mut gait = Gait { pelvis: Pelvis::Vertical, ..gait.clone() };
        if self.straight_goose && gait.name == "goose" {
            gait.changes = Gait::named("parade").map(|parade| parade.changes).unwrap_or_default();
            gait.step_height = 1.0;
        }
        gait.pace.length_scale *= self.step_length;
        if let Some((_, height)) = self.own_height.filter(|(name, _)| *name == gait.name) {
            gait.step_height = height;
        }
        gait.step_height *= self.step_height;
        for (name, length) in [("short", self.short_length), ("long", self.long_length)] {
            if let Some(length) = length.filter(|_| gait.name == name) {
                gait.pace.length_scale = length * self.step_length;
            }
        }
        if let Some((_, scale)) = self.own_length.filter(|(name, _)| *name == gait.name) {
            gait.pace.length_scale = scale;
        }
        if let (Some(style), true) = (self.style, gait.changes.is_empty()) {
            gait.style = style;
        }
        gait
    }

    pub(super) fn signals(&self, walk: &Walk, model: &Model, duration_s: f64) -> Result<Vec<Signal>, WalkingError> {
        let plain = gait_signals(walk, model, 0.0, duration_s)?.into_iter().zip(model.coordinates());
        let changed = plain
            .map(|(signal, coordinate)| {
                let of_arm = coordinate.name.starts_with("arm_") || coordinate.name.starts_with("elbow_");
                let slope = if of_arm { self.arm_swing } else { 1.0 };
                let intercept = if coordinate.name.starts_with("hip_") { self.hip_offset } else { 0.0 };
                let changes = (slope - 1.0).abs() > 0.0 || intercept.abs() > 0.0;
                if changes { Signal::Of(Function::Linear { slope, intercept }, Box::new(signal)) } else { signal }
            })
            .collect();
        Ok(changed)
    }
}
