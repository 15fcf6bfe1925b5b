//! Modes of walking: functions from settings to a recorded walk. This file has the mode of the paper.

use super::error::ReproductionError;
use super::paper_settings::PaperSettings;
use ambulo_body::findings::Findings;
use ambulo_body::model::anthropometry::{ContactSphere, Human};
use ambulo_walk::engine::{ImpactLaw, StepSettings};
use ambulo_walk::gait::{Gait, Phases, Walk};
use ambulo_walk::walking::{GroundContact, Shoes, WalkRecording, Walker};

/// The settings of a walk that a claim needs.
#[derive(Debug, Clone, Copy)]
pub struct TrialSettings<'a> {
    /// The gait.
    pub gait: &'a Gait,
    /// The figure.
    pub human: &'a Human,
    /// Contact law of the soles.
    pub shoes: Footwear,
    /// Coefficient of friction μ of rigid soles.
    pub friction: f64,
    /// Time steps of the simulator per second [Hz].
    pub rate_hz: f64,
    /// Number of cycles.
    pub cycles: usize,
}

/// Contact law of the soles.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Footwear {
    /// The default of the mode.
    Own,
    /// Rigid soles; an impact cancels the whole velocity of the point.
    Rigid,
    /// Soft soles by the law of Hunt and Crossley.
    Soft,
}

/// A recorded walk with the values of its gait.
#[derive(Debug, Clone)]
pub struct Run {
    /// Motion and forces.
    pub recording: WalkRecording,
    /// Name of the gait.
    pub gait: String,
    /// Contact law of the soles: rigid or soft.
    pub shoes: Footwear,
    /// Soles of the figure.
    pub soles: Vec<ContactSphere>,
    /// Duration of a cycle [s]; row 0 is the nominal foot strike of the right foot.
    pub cycle_s: f64,
    /// Leg length of the figure [m].
    pub leg_length: f64,
    /// Speed of the gait [m/s].
    pub speed: f64,
    /// Step length of the gait [m].
    pub step_length: f64,
    /// Foot off of the gait as a share of the cycle.
    pub foot_off: f64,
}

impl Run {
    pub(crate) fn of(walk: &Walk, human: &Human, recording: WalkRecording, shoes: Footwear) -> Run {
        let Phases { foot_off, .. } = walk.phases(&walk.clock(0.0));
        Run {
            recording,
            gait: walk.name().to_owned(),
            shoes,
            soles: human.soles.clone(),
            cycle_s: walk.cycle_s(),
            leg_length: human.dimensions.leg_length,
            speed: walk.speed(),
            step_length: walk.step_length(),
            foot_off,
        }
    }
}

/// A mode: simulates a walk with given settings.
pub type Mode<'a> = dyn FnMut(&TrialSettings<'_>) -> Result<Run, ReproductionError> + 'a;

/// Simulates a walk as in the paper: joints driven by the gait, the trunk held upright, the root free to slide, rigid
/// contacts whose impacts cancel the whole velocity of the point, Coulomb friction. The settings have the values that
/// the paper does not give.
///
/// # Errors
/// A gait that is not possible for the figure, or a walk that cannot be simulated.
pub fn paper_walk_with(settings: &PaperSettings, trial: &TrialSettings<'_>) -> Result<Run, ReproductionError> {
    // Warnings are discarded: some claims need speeds outside of the data of the gait, and the recording counts time
    // steps whose contacts were not solved.
    let mut findings = Findings::default();
    let human = settings.figure(trial.human)?;
    let walk = Walk::new(&settings.gait(trial.gait), human.dimensions.leg_length, &mut findings)?;
    let footwear = if trial.shoes == Footwear::Own { Footwear::Rigid } else { trial.shoes };
    let (shoes, impact) = match footwear {
        Footwear::Own | Footwear::Rigid => (Shoes::Rigid, settings.impact),
        Footwear::Soft => (Shoes::HuntCrossley(settings.soft_shoes), ImpactLaw::Coulomb),
    };
    let ground = GroundContact { friction: trial.friction, shoes, impact };
    let duration_s = walk.cycle_s() * trial.cycles as f64;
    let signals = settings.signals(&walk, &human.model, duration_s)?;
    let walker = Walker::new(&human, signals, &ground, walk.speed())?;
    let steps = StepSettings { step_s: 1.0 / trial.rate_hz, ..StepSettings::default() };
    let recording = walker.walk(&steps, duration_s, &mut findings)?;
    Ok(Run::of(&walk, &human, recording, footwear))
}
