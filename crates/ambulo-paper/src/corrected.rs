//! The corrected mode: the same gaits on the same figure, without residual forces.
//!
//! Differences from the paper's mode: joint curves whose knots have velocity and acceleration, a moving pelvis and
//! trunk, a toe joint, soft shoes, and a dynamically consistent motion ([`ambulo_walk::consistent_walk`]): its forces
//! come from the ground alone.

use super::error::ReproductionError;
use super::mode::{Footwear, Run, TrialSettings};
use super::paper_human::{rebuilt, sum_of_radii};
use super::paper_settings::PaperSettings;
use super::setting::Setting;
use ambulo_body::findings::Findings;
use ambulo_body::model::anthropometry::{Build, Human};
use ambulo_walk::consistent_walk::{ConsistentWalk, ConsistentWalkSettings, make_consistent_walk};
use ambulo_walk::engine::{ImpactLaw, Integrator, StepSettings};
use ambulo_walk::gait::{Gait, Style, Walk};
use ambulo_walk::walking::{GroundContact, Shoes};

/// The corrected mode. A walk is made consistent once and kept for the requests that differ in shoes, rate or friction.
#[derive(Debug, Default)]
pub struct CorrectedMode {
    /// Step lengths and heights of the gaits; `None` takes the built-in gaits.
    steps: Option<PaperSettings>,
    /// How walks are made consistent.
    pub settings: ConsistentWalkSettings,
    cache: Vec<CachedWalk>,
}

#[derive(Debug)]
struct CachedWalk {
    gait: Gait,
    /// Bits of mass, stature and radii of the soles, which identify the figure.
    figure: [u64; 3],
    human: Human,
    walk: ConsistentWalk,
}

impl CorrectedMode {
    /// The mode with the step lengths and heights of a setting, and its stature.
    #[must_use]
    pub fn of(setting: &Setting) -> CorrectedMode {
        CorrectedMode { steps: Some(setting.applied()), ..CorrectedMode::default() }
    }

    /// Simulates a walk.
    ///
    /// # Errors
    /// A gait that is not possible for the figure, or a walk that cannot be simulated.
    pub fn walk(&mut self, trial: &TrialSettings<'_>) -> Result<Run, ReproductionError> {
        let number = self.find_or_make(trial)?;
        let CachedWalk { human, walk, .. } = &self.cache[number];
        let ground = match trial.shoes {
            Footwear::Own | Footwear::Soft => GroundContact {
                friction: self.settings.shoes.dynamic_friction,
                shoes: Shoes::HuntCrossley(self.settings.shoes),
                impact: ImpactLaw::Coulomb,
            },
            Footwear::Rigid => {
                GroundContact { friction: trial.friction, shoes: Shoes::Rigid, impact: ImpactLaw::Sticking }
            }
        };
        let steps =
            StepSettings { step_s: 1.0 / trial.rate_hz, integrator: Integrator::Impulse, ..StepSettings::default() };
        let gait = walk.walk();
        let duration_s = gait.cycle_s() * trial.cycles as f64;
        let recording = walk.walker(human, &ground)?.walk(&steps, duration_s, &mut Findings::default())?;
        let shoes = if trial.shoes == Footwear::Own { Footwear::Soft } else { trial.shoes };
        Ok(Run::of(gait, human, recording, shoes))
    }

    fn find_or_make(&mut self, trial: &TrialSettings<'_>) -> Result<usize, ReproductionError> {
        let figure = [trial.human.model.mass(), trial.human.build.height, sum_of_radii(trial.human)].map(f64::to_bits);
        if let Some(number) = self.cache.iter().position(|k| k.gait == *trial.gait && k.figure == figure) {
            return Ok(number);
        }
        let human = match self.steps.and_then(|steps| steps.height) {
            Some(height) => with_toes(&rebuilt(trial.human, height)?)?,
            None => with_toes(trial.human)?,
        };
        // The same speed, steps and changes, with curves whose knots have velocity and acceleration.
        let gait = self.steps.map_or_else(|| trial.gait.clone(), |steps| steps.with_steps(trial.gait));
        let gait = gait.in_style(Style::Knots);
        let walk = Walk::new(&gait, human.dimensions.leg_length, &mut Findings::default())?;
        let walk = make_consistent_walk(&human, &walk, &self.settings)
            .map_err(|e| ReproductionError::Mode { gait: gait.name.clone(), reason: e.to_string() })?;
        self.cache.push(CachedWalk { gait: trial.gait.clone(), figure, human, walk });
        Ok(self.cache.len() - 1)
    }
}

/// The same figure with a toe joint and the same radii of the soles.
pub(super) fn with_toes(human: &Human) -> Result<Human, ReproductionError> {
    let mut figure = Build { toe_joint: true, ..human.build }.human()?;
    let (old, new) = (sum_of_radii(human), sum_of_radii(&figure));
    for sole in &mut figure.soles {
        sole.center.y += sole.radius * (old / new - 1.0);
        sole.radius *= old / new;
    }
    Ok(figure)
}
