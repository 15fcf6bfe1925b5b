//! The paper of 1997, claim by claim.
//!
//! Faure, Debunne, Cani, Multon 1997, "Dynamic analysis of human walking". A [`Mode`] makes the paper's figure walk; [`Evidence`] is
//! what it has to walk for the claims, and [`claims`] judges them. [`paper_walk`] is the paper's own mode; a corrected mode is
//! judged beside it by the same measures.

mod assumptions;
mod claim;
mod corrected;
mod error;
mod evidence;
mod feet;
mod figures;
mod figures_of_mass;
mod measured;
mod mode;
mod paper_settings;
mod snapshots;
mod steady;

mod bounce;
mod convergence;
mod forward;
mod gaits;
mod ground_force;
mod harmonics;
mod joints;
mod mass;
mod muscles;
mod period;
mod sliding;

pub use assumptions::{Assumption, Sensitivity, assumptions, sensitivities};
pub use claim::{Claim, Judgement, Numbers, number};
pub use corrected::Corrected;
pub use error::ReproductionError;
pub use evidence::{
    CYCLES, Evidence, FRICTION, FRICTIONS, GAITS, HEIGHT, MASS, MASSES, RATE_HZ, RATES_HZ, REFERENCE_HZ, Scope,
    paper_human,
};
pub use figures::{PaperFigure, PaperPanel, PaperSeries, SeriesKind, angular_laws, paper_figures};
pub use harmonics::{HARMONICS, TorqueSeries, torque_series};
pub use measured::{MEASURED_FOOT_OFF, VERTICAL_EVERY_4_PERCENT, measured_vertical};
pub use mode::{Footwear, Mode, Request, Run, paper_walk, paper_walk_with};
pub use muscles::{MuscleRow, PHASES, muscle_table};
pub use paper_settings::PaperSettings;
pub use steady::{BLOW_MARGIN_S, POINTS, STEADY_CYCLES, Steady, correlation, extremes, mean, mean_of, range_of, rms};

use claim::Statement;

/// All statements, in the paper's order of figures.
const STATEMENTS: [Statement; 22] = [
    convergence::TORQUE,
    convergence::IMPULSE,
    period::PERIOD,
    forward::STOPS,
    forward::AMPLITUDE,
    forward::SLOW,
    sliding::SINGLE,
    sliding::FORCED,
    ground_force::HUMPS,
    ground_force::FLIGHT,
    mass::EXACTLY,
    mass::NEARLY,
    gaits::SHAPE,
    gaits::LOWEST,
    gaits::REGULAR,
    joints::ORDER,
    joints::ALIKE,
    joints::CONTINUOUS,
    joints::SIGNS,
    bounce::SHOES,
    gaits::PLAUSIBLE,
    bounce::SPEED,
];

/// Every claim, judged by the paper's mode, with the corrected one beside it.
#[must_use]
pub fn claims(paper: &Evidence, corrected: Option<&Evidence>) -> Vec<Claim> {
    STATEMENTS.iter().map(|statement| statement.claim(paper, corrected)).collect()
}

/// Whether the claims that brief evidence suffices for pass.
#[must_use]
pub fn judgements(paper: &Evidence) -> Vec<Judgement> {
    STATEMENTS.iter().filter(|statement| statement.scope == Scope::Brief).map(|s| s.judgement(paper)).collect()
}
