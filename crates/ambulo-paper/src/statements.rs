//! The list of all claims, and their judgement.

use super::claim::{Claim, Judgement, Statement};
use super::evidence::{Evidence, Scope};
use super::{
    action, bounce, convergence, forward, gaits, ground_force, interaction, joints, laws, mass, own_torques, sliding,
};

/// All statements, in the order of the figures in the paper.
static STATEMENTS: [Statement; 35] = [
    laws::SMOOTH,
    laws::SPEED_LAW,
    laws::CHANGE,
    convergence::TORQUE,
    convergence::IMPULSE,
    convergence::PERIOD,
    forward::STOPS,
    forward::AMPLITUDE,
    forward::SLOW,
    action::FORWARD,
    sliding::SINGLE,
    sliding::FORCED,
    ground_force::HUMPS,
    ground_force::FLIGHT,
    ground_force::BOUNCING,
    action::NO_PULL,
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
    action::MUSCLES,
    action::WARNING,
    interaction::LOOPS,
    interaction::OBSTACLE,
    interaction::GRASP_CLAIM,
    interaction::HAND_IN_HAND,
    own_torques::OWN_TORQUES,
    bounce::SPEED,
];

/// A statement by its letter.
pub fn statement(id: &str) -> Option<&'static Statement> {
    STATEMENTS.iter().find(|statement| statement.id == id)
}

/// Judges every claim in the paper's mode, with the numbers of the corrected mode for comparison.
#[must_use]
pub fn claims(paper: &Evidence, corrected: Option<&Evidence>) -> Vec<Claim> {
    STATEMENTS.iter().map(|statement| statement.claim(paper, corrected)).collect()
}

/// Judges the claims for which the walks of a scope are sufficient.
#[must_use]
pub fn judgements(paper: &Evidence, scope: Scope) -> Vec<Judgement> {
    STATEMENTS.iter().filter(|statement| statement.scope <= scope).map(|s| s.judgement(paper)).collect()
}
