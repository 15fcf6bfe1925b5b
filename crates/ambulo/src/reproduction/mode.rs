//! Ways to make a figure walk: as in 1997, or put right. Each is a function from a request to a recorded walk.

use super::error::ReproductionError;
use crate::contact::HuntCrossley;
use crate::findings::Findings;
use crate::gait::{Gait, Walk};
use crate::model::anthropometry::{ContactSphere, Human};
use crate::simulation::walking::{Ground, Shoes, WalkRecording, Walker, gait_signals};
use crate::simulation::{Impact, StepSettings};

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
    /// Soft shoes: [`SOFT_SHOES`].
    Soft,
}

/// The soft shoes of the claims: six spheres a foot in that paper, three here.
pub const SOFT_SHOES: HuntCrossley = HuntCrossley::FALISSE_2022;

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
    /// Largest distance that the mode changed a joint's angle by [rad]; zero if it plays the gait as it is.
    pub adjusted_rad: f64,
}

/// A mode: how it walks.
pub type Mode<'a> = dyn FnMut(&Request<'_>) -> Result<Run, ReproductionError> + 'a;

/// Walks as the paper did: joints driven as the gait has them, the trunk held upright, the root free to slide, rigid
/// contacts whose blows cancel the whole velocity of the point, Coulomb's friction.
///
/// # Errors
/// A gait that the figure cannot have, or a walk that cannot be simulated.
pub fn paper_walk(request: &Request<'_>) -> Result<Run, ReproductionError> {
    let mut findings = Findings::default();
    let walk = Walk::new(request.gait, request.human.dimensions.leg_length, &mut findings)?;
    let (shoes, impact) = match request.shoes {
        Footwear::Own | Footwear::Rigid => (Shoes::Rigid, Impact::Sticking),
        Footwear::Soft => (Shoes::HuntCrossley(SOFT_SHOES), Impact::Coulomb),
    };
    let ground = Ground { friction: request.friction, shoes, impact };
    let signals = gait_signals(&walk, &request.human.model);
    let walker = Walker::new(request.human, signals, &ground, walk.speed())?;
    let settings = StepSettings { step_s: 1.0 / request.rate_hz, ..StepSettings::default() };
    let duration_s = walk.cycle_s() * request.cycles as f64;
    let recording = walker.walk(&settings, duration_s, &mut findings)?;
    Ok(Run {
        recording,
        gait: walk.name().to_owned(),
        soles: request.human.soles.clone(),
        cycle_s: walk.cycle_s(),
        speed: walk.speed(),
        step_length: walk.step_length(),
        foot_off: walk.phases(&walk.clock(0.0)).foot_off,
        adjusted_rad: 0.0,
    })
}
