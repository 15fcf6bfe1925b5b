//! How a walk came about, in numbers.

use super::order::SyntheticMode;
use crate::gait::Style;
use crate::model::anthropometry::SegmentTable;
use crate::numerics::Progress;
use crate::simulation::consistent_walk::{Adjustment, Magnitude};
use crate::simulation::walking::StanceSlip;

/// How a walk came about.
#[derive(Debug, Clone, PartialEq)]
pub struct WalkReport {
    /// Name of the gait.
    pub gait: String,
    /// How its curves run.
    pub style: Style,
    /// How the walk was made.
    pub mode: SyntheticMode,
    /// Whose segments.
    pub figure: SegmentTable,
    /// Speed that the gait asks for [m/s].
    pub speed: f64,
    /// V/√(gL).
    pub dimensionless_speed: f64,
    /// Step length [m].
    pub step_length: f64,
    /// Duration of a cycle [s].
    pub cycle_s: f64,
    /// Hip to floor, standing [m].
    pub leg_length: f64,
    /// What was changed; `None` in paper mode.
    pub correction: Option<CorrectionReport>,
    /// Torque that holds the trunk from outside [N.m].
    pub trunk_torque: Magnitude,
    /// How far a loaded sole gets from where it stood, in the worst whole stance.
    pub slip: Option<StanceSlip>,
    /// Time that no foot is loaded [s].
    pub flight_s: f64,
    /// Impacts of rigid soles, and the largest impulse on a foot [N.s]; none on soft shoes.
    pub impacts: (usize, f64),
    /// Largest difference of the mid-hip's speed from one cycle to the next [m/s]; the angles are given and repeat exactly.
    pub speed_drift: f64,
    /// Steps of the simulator a second [Hz].
    pub steps_hz: f64,
    /// Steps whose contacts were not solved to the tolerance.
    pub unsolved_steps: usize,
}

/// What was changed to make a walk consistent.
#[derive(Debug, Clone, PartialEq)]
pub struct CorrectionReport {
    /// How many numbers were free.
    pub parameters: usize,
    /// How much the motion changed.
    pub adjustment: Adjustment,
    /// What the plan's root still lacks: force [N] and moment [N.m].
    pub lacking: [Magnitude; 2],
    /// How the solver got there.
    pub progress: Vec<Progress>,
}
