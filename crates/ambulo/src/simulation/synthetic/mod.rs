//! Synthetic walks, from a gait and a build to motion and ground forces that an analysis takes as it takes a recording.
//!
//! Two modes: [`SyntheticMode::Corrected`] changes the gait until its forces come from the ground alone
//! ([`super::consistent_walk`]) and steps it on soft shoes; [`SyntheticMode::Paper`] drives the joints as the gait has them, holds the trunk
//! upright, and lets rigid soles strike (Faure, Debunne, Cani, Multon 1997). In both, cycles before the walk is steady are
//! left out, and what is kept begins a little before a strike of the right foot, so that every cycle is whole.

mod corrected;
mod error;
mod order;
mod paper;
mod report;
mod steady;

pub use crate::numerics::Progress;
pub use error::SyntheticError;
pub use order::{MOST_CYCLES, RATES_HZ, SyntheticMode, SyntheticWalkSettings};
pub use report::{CorrectionReport, WalkReport};

use crate::findings::Findings;
use crate::gait::Walk;
use crate::kinematics::Trajectory;
use crate::model::anthropometry::Human;
use crate::motion::ForceRecording;

/// A walk that was made.
#[derive(Debug, Clone)]
pub struct SyntheticWalk {
    /// Who walks.
    pub human: Human,
    /// The gait on these legs.
    pub walk: Walk,
    /// The motion, periodic, at the rate that was ordered.
    pub trajectory: Trajectory,
    /// What the ground does to the feet.
    pub loads: Vec<ForceRecording>,
    /// What the simulator drove each coordinate with, one column a coordinate, one entry a frame [N.m].
    pub efforts: Vec<Vec<f64>>,
    /// How it came about.
    pub report: WalkReport,
}

/// Makes a walk.
///
/// # Errors
/// A figure or a gait that cannot be; see [`SyntheticError`].
pub fn synthesise(order: &SyntheticWalkSettings<'_>, findings: &mut Findings) -> Result<SyntheticWalk, SyntheticError> {
    order.check()?;
    let human = order.build.human()?;
    match order.mode {
        SyntheticMode::Corrected => corrected::walk(order, human, findings),
        SyntheticMode::Paper => paper::walk(order, human, findings),
    }
}
