//! Recomputes the paper of 1997 and judges its claims.
//!
//! Faure, Debunne, Cani, Multon 1997, "Dynamic analysis of human walking". A [`Mode`] simulates walks of the paper's
//! figure. [`Evidence`] has all walks that the claims need, and [`claims`] judges them. [`paper_walk`] is the mode of
//! the paper; [`CorrectedMode`] is evaluated by the same measures for comparison.

mod corrected;
mod error;
mod evidence;
mod mode;
mod open_values;
mod paper_human;
mod paper_settings;
mod setting;
mod steady;

mod action;
mod assumptions;
mod bounce;
mod claim;
mod convergence;
mod experiments;
mod forward;
mod gaits;
mod ground_force;
mod interaction;
mod joints;
mod laws;
mod mass;
mod own_torques;
mod shares;
mod sliding;
mod statements;

mod figures;
mod harmonics;
mod moving;
mod muscles;

pub use assumptions::{Assumption, Sensitivity, assumptions, judged_with, sensitivities};
#[doc(hidden)]
pub use claim::ClaimKind;
pub use claim::{Claim, FormerJudgement, Judgement, Numbers, former_tally, number, tally};
pub use corrected::CorrectedMode;
pub use error::ReproductionError;
pub use evidence::{
    BRIEF_CYCLES, CYCLES, Evidence, FRICTION, FRICTIONS, MASSES, RATE_HZ, RATES_HZ, REFERENCE_HZ, Scope,
};
pub use experiments::add_experiments;
pub use figures::{FigureSet, PaperFigure, PaperPanel, PaperSeries, SeriesKind, angular_laws, paper_figures, quintics};
pub use ground_force::{MEASURED_FOOT_OFF, VERTICAL_EVERY_4_PERCENT, measured_vertical};
pub use harmonics::torque_series;
pub use mode::{Footwear, Mode, Run, TrialSettings, paper_walk_with};
pub use moving::{MovingFigure, MovingHead, MovingStick, moving_figure};
pub use muscles::{MuscleRow, PHASES, muscle_table};
pub use open_values::{GAITS, KNOT_RANGE, KNOTS, open_values};
#[doc(hidden)]
pub use open_values::{OpenKind, OpenValue};
pub use paper_human::{HEIGHT, MASS, paper_human};
#[doc(hidden)]
pub use paper_settings::PaperSettings;
pub use setting::{NAMED, Setting, paper_walk};
pub use shares::{ClaimShare, StoredShares, judged_of_the_paper, read_shares, shares_csv, shares_of, stored_shares};
pub use statements::{claims, judgements};
#[doc(hidden)]
pub use steady::Steady;
pub use steady::{IMPACT_MARGIN_S, POINTS, STEADY_CYCLES};

/// For the tests of this crate.
#[doc(hidden)]
pub mod internals {
    pub use crate::claim::Statement;
    pub use crate::ground_force::humps;
    pub use crate::interaction::{GRASP_CLAIM, HAND_IN_HAND, LOOPS, OBSTACLE};
    pub use crate::setting::CLAIMS;
    pub use crate::statements::statement;
}
