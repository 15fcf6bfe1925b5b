//! A motion with its forces, as a verdict judges it.

use crate::analysis::activity::ActivityKind;
use crate::dynamics::Forces;
use crate::ground::GroundForces;
use crate::ground::footfalls::Footfalls;
use crate::kinematics::Trajectory;
use crate::model::Model;

/// A recorded or synthetic motion with its forces.
#[derive(Debug, Clone, Copy)]
pub struct MotionAndForces<'a> {
    /// The body.
    pub model: &'a Model,
    /// Motion of the model.
    pub trajectory: &'a Trajectory,
    /// The forces of inverse dynamics or of a simulation.
    pub forces: &'a Forces,
    /// The ground forces; without bodies if unknown.
    pub ground: &'a GroundForces,
    /// Generalised forces of a worn device: one column per coordinate [N.m or N].
    pub device: Option<&'a [Vec<f64>]>,
    /// Forces predicted from the motion, for frames in which measured ground forces are incomplete.
    pub predicted: Option<PredictedForces<'a>>,
    /// Times in which a force plate measured only a part of a foot's load [s]. A lack of support in them is the
    /// plate's, not the motion's.
    pub partly_measured: &'a [[f64; 2]],
    /// The stances that the motion shows: a foot may stand on unmeasured ground at the height of its stance, as on
    /// stairs, and the belt moves as they do where no load shows it. `None` if unknown.
    pub stances: Option<&'a Footfalls>,
    /// The activity: walking and standing keep a foot on the ground, running and jumping do not.
    pub activity: ActivityKind,
    /// Cut-off of the low-pass filter of the motion [Hz]; `None` without a filter.
    pub cutoff_hz: Option<f64>,
    /// Whether the ground forces were computed from the motion. A lack of support may then be support that no foot
    /// gives, such as hands or a chair, so it leaves the verdict undecided.
    pub forces_are_predicted: bool,
}

/// Forces predicted from the motion, on its frames.
#[derive(Debug, Clone, Copy)]
pub struct PredictedForces<'a> {
    /// The ground forces.
    pub ground: &'a GroundForces,
    /// Inverse dynamics with them.
    pub forces: &'a Forces,
}
