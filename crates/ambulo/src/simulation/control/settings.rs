//! Settings of a controller, and why there is none.

use crate::dynamics::CurvedJointError;
use crate::simulation::figure_tree::FigureJointError;
use crate::simulation::walking::WalkingError;

/// Settings of a [`WalkController`](super::WalkController). Torques are those of an adult of 75 kg and 1.75 m; they grow with mass times stature.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ControlSettings {
    /// Stiffness of the impedance of hips, knees, ankles and lumbar joint [N.m/rad]; arms have 0.3 and toes 0.2 times as much.
    pub stiffness: f64,
    /// Damping of the impedance over its stiffness [s].
    pub damping_s: f64,
    /// Whether the state of the whole figure is fed back.
    pub feedback: bool,
    /// Number of harmonics of the cycle by which the torques of the plan are replaced; `None` keeps them.
    pub harmonics: Option<usize>,
    /// Deviations that cost 1 per second.
    pub costs: TrackingCosts,
}

/// Deviations from the plan that cost as much as each other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TrackingCosts {
    /// Of the angle of a joint [rad].
    pub angle: f64,
    /// Of its rate [rad/s].
    pub rate: f64,
    /// Of the rotation of the pelvis in the world [rad].
    pub pelvis: f64,
    /// Of the height of the pelvis [m].
    pub height: f64,
    /// Of the place of the pelvis sideways [m].
    pub sideways: f64,
    /// Of the velocity of the pelvis, along the ground and up [m/s].
    pub velocity: [f64; 2],
    /// Of the torque of a hip, knee, ankle or the lumbar joint [N.m]; arms have 0.3 and toes 0.2 times as much.
    pub torque: f64,
}

impl Default for ControlSettings {
    /// Found by hand on pushes of a man of 75 kg at 1.25 m/s (docs/PHYSICAL_WALK.md).
    fn default() -> ControlSettings {
        ControlSettings {
            stiffness: 200.0,
            damping_s: 0.1,
            feedback: true,
            harmonics: None,
            costs: TrackingCosts {
                angle: 0.1,
                rate: 1.0,
                pelvis: 0.1,
                height: 0.05,
                sideways: 1.0,
                velocity: [0.5, 0.3],
                torque: 60.0,
            },
        }
    }
}

/// Why a figure cannot be controlled.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ControlError {
    /// A joint that the simulator cannot move by motors.
    #[error(transparent)]
    Joint(#[from] FigureJointError),
    /// A plan whose forces cannot be computed.
    #[error(transparent)]
    Plan(#[from] CurvedJointError),
    /// A figure with other joints or soles than that of the plan.
    #[error("found a figure with {found}; expected {expected}, as in the plan")]
    Figure {
        /// Coordinates and soles of the figure.
        found: String,
        /// Those of the plan.
        expected: String,
    },
    /// The figure cannot be simulated.
    #[error(transparent)]
    Walking(#[from] WalkingError),
    /// A cycle without enough time steps, or with too many.
    #[error("a cycle has {found} time steps; expected {least} to {most}: a controller has gains for each of them")]
    Steps {
        /// Time steps of a cycle.
        found: usize,
        /// Fewest.
        least: usize,
        /// Most.
        most: usize,
    },
    /// Controllers that cannot be joined.
    #[error(
        "found {found} among controllers to be joined; expected controllers of one figure, with the same settings, at several speeds"
    )]
    Joined {
        /// What was found.
        found: String,
    },
    /// A speed that no plan of a controller has.
    #[error(
        "found the speed {found} m/s; expected {slowest:.2} to {fastest:.2} m/s, the speeds of the plans of this controller"
    )]
    Speed {
        /// The speed [m/s].
        found: f64,
        /// That of the slowest plan [m/s].
        slowest: f64,
        /// That of the fastest plan [m/s].
        fastest: f64,
    },
    /// The Riccati equation has no solution.
    #[error("the feedback of the walk could not be computed: its Riccati equation did not converge")]
    Riccati,
}
