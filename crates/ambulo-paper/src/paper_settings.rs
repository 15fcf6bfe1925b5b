//! Values that the paper does not give, and their effect on figure, gait and signals.

use super::error::ReproductionError;
use super::open_values::{GAITS, KNOTS};
use super::paper_human::{rebuilt, with_soles, with_thickness, with_toe_reach};
use ambulo_body::contact::HuntCrossley;
use ambulo_body::model::anthropometry::{Human, SpherePart};
use ambulo_body::model::{Function, Model};
use ambulo_walk::engine::{ImpactLaw, Signal};
use ambulo_walk::gait::{Gait, KnotChange, Pelvis, Speed, Style, Walk};
use ambulo_walk::walking::{WalkingError, gait_signals};

/// Values that the paper does not give, as the simulation uses them; [`Setting`](super::Setting) has their sources.
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
    /// Interpolation of the joint curves. In style `knots`, and in a gait with its own knots, `knots` has no effect.
    pub style: Style,
    /// Step length of the standard gait [m].
    pub standard_step: f64,
    /// Whether the curves belong to the speed of this step.
    pub angles_of_the_step: bool,
    /// Factor on the step height of all gaits.
    pub step_height: f64,
    /// Step lengths of [`GAITS`] relative to the standard gait.
    pub lengths: [f64; 4],
    /// Step heights of [`GAITS`] relative to the standard gait.
    pub heights: [f64; 4],
    /// Whether the goose step has the straight knees of the built-in gait `parade`, at its own period.
    pub straight_goose: bool,
    /// Time [cycles] and angle [rad] that are added to each of [`KNOTS`].
    pub knots: [[f64; 2]; KNOTS.len()],
    /// Impact law of the soles.
    pub impact: ImpactLaw,
    /// Soft shoes.
    pub soft_shoes: HuntCrossley,
}

/// Step length and steps per second of the built-in standard gait [m, 1/s].
const BUILT_IN_STEP: [f64; 2] = [0.75, 2.0];

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

    /// The gait with these settings; the trunk is always held at a constant angle. Another gait than [`GAITS`] keeps
    /// its steps.
    pub(super) fn gait(&self, gait: &Gait) -> Gait {
        let mut gait = Gait { pelvis: Pelvis::Vertical, ..self.with_steps(gait) };
        if self.is_straight(&gait) {
            gait.changes = Gait::named("parade").map(|parade| parade.changes).unwrap_or_default();
        } else if gait.changes.is_empty() {
            gait.style = self.style;
            gait.changes = self.changes();
        }
        gait
    }

    /// The gait with the step length and the step height of these settings, and its own curves.
    pub(super) fn with_steps(&self, gait: &Gait) -> Gait {
        let mut gait = gait.clone();
        if let Some(number) = GAITS.iter().position(|name| *name == gait.name) {
            gait.pace.length_scale = self.lengths[number];
            gait.step_height = if self.is_straight(&gait) { 1.0 } else { self.heights[number] };
            self.set_standard_step(&mut gait);
        }
        gait.step_height *= self.step_height;
        gait
    }

    fn is_straight(&self, gait: &Gait) -> bool {
        self.straight_goose && gait.name == "goose"
    }

    fn set_standard_step(&self, gait: &mut Gait) {
        let [step, frequency] = BUILT_IN_STEP;
        if self.angles_of_the_step {
            gait.pace.speed = Some(Speed::MetersPerSecond(self.standard_step * frequency));
        } else {
            gait.pace.length_scale *= self.standard_step / step;
        }
    }

    fn changes(&self) -> Vec<KnotChange> {
        if self.style == Style::Knots {
            return Vec::new();
        }
        let moved = KNOTS.iter().zip(self.knots).filter(|(_, [time, angle])| time.abs() + angle.abs() > 0.0);
        moved
            .map(|((joint, knot), [phase, angle])| KnotChange { phase, angle, ..KnotChange::of(*joint, knot) })
            .collect()
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
