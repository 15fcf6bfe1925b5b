//! Ways to make a figure walk: as in 1997, or put right. Each is a function from a request to a recorded walk.

use super::error::ReproductionError;
use super::paper_settings::PaperSettings;
use crate::findings::Findings;
use crate::gait::{Gait, Walk};
use crate::model::anthropometry::{ContactSphere, Human};
use crate::simulation::walking::{Ground, Shoes, WalkRecording, Walker};
use crate::simulation::{ImpactLaw, StepSettings};

/// A walk that a claim needs.
#[derive(Debug, Clone, Copy)]
pub struct Request<'a> {
    /// The gait.
    pub gait: &'a Gait,
    /// The figure.
    pub human: &'a Human,
    /// What the soles are made of.
    pub shoes: Footwear,
    /// Coefficient of friction μ of rigid soles.
    pub friction: f64,
    /// Steps of the simulator in a second [Hz].
    pub rate_hz: f64,
    /// Cycles to walk.
    pub cycles: usize,
}

/// What the soles are made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Footwear {
    /// Whatever the mode takes of itself.
    Own,
    /// They do not give, and what strikes loses all its velocity.
    Rigid,
    /// They give, by Hunt and Crossley's law.
    Soft,
}

/// A walk, and what was asked of it.
#[derive(Debug, Clone)]
pub struct Run {
    /// What happened.
    pub recording: WalkRecording,
    /// Name of the gait.
    pub gait: String,
    /// Soles of the figure.
    pub soles: Vec<ContactSphere>,
    /// Duration of a cycle [s]; row 0 is the right foot's nominal contact.
    pub cycle_s: f64,
    /// Speed that the gait asks for [m/s].
    pub speed: f64,
    /// Step length that the gait asks for [m].
    pub step_length: f64,
    /// Foot off as a share of the cycle, as the gait has it.
    pub foot_off: f64,
}

/// A mode: how it walks.
pub type Mode<'a> = dyn FnMut(&Request<'_>) -> Result<Run, ReproductionError> + 'a;

/// Walks as the paper did: joints driven as the gait has them, the trunk held upright, the root free to slide, rigid
/// contacts whose blows cancel the whole velocity of the point, Coulomb's friction. What the paper does not give is as in
/// [`assumptions`](super::assumptions).
///
/// # Errors
/// A gait that the figure cannot have, or a walk that cannot be simulated.
pub fn paper_walk(request: &Request<'_>) -> Result<Run, ReproductionError> {
    paper_walk_with(&PaperSettings::default(), request)
}

/// The same with other values for what the paper does not give.
///
/// # Errors
/// A gait that the figure cannot have, or a walk that cannot be simulated.
pub fn paper_walk_with(settings: &PaperSettings, request: &Request<'_>) -> Result<Run, ReproductionError> {
    // Nobody is told of what is odd on the way: speeds outside of the gait's data, and steps that contacts leave unsolved, which the
    // recording counts.
    let mut findings = Findings::default();
    let human = settings.figure(request.human)?;
    let walk = Walk::new(&settings.gait(request.gait), human.dimensions.leg_length, &mut findings)?;
    let (shoes, impact) = match request.shoes {
        Footwear::Own | Footwear::Rigid => (Shoes::Rigid, settings.impact),
        Footwear::Soft => (Shoes::HuntCrossley(settings.soft_shoes), ImpactLaw::Coulomb),
    };
    let ground = Ground { friction: request.friction, shoes, impact };
    let walker = Walker::new(&human, settings.signals(&walk, &human.model), &ground, walk.speed())?;
    let steps = StepSettings { step_s: 1.0 / request.rate_hz, ..StepSettings::default() };
    let duration_s = walk.cycle_s() * request.cycles as f64;
    let recording = walker.walk(&steps, duration_s, &mut findings)?;
    Ok(Run {
        recording,
        gait: walk.name().to_owned(),
        soles: human.soles,
        cycle_s: walk.cycle_s(),
        speed: walk.speed(),
        step_length: walk.step_length(),
        foot_off: walk.phases(&walk.clock(0.0)).foot_off,
    })
}
