//! Settings of a controller, and the errors when a controller cannot be made.

use crate::dynamics::CurvedJointError;
use crate::engine::WorldError;
use crate::optimal::OptimalWalkError;
use crate::walking::{TorqueSeries, WalkingError};

/// Settings of a [`WalkController`](super::WalkController). Torques are stated for an adult of 75 kg and 1.75 m; they
/// grow with mass times stature.
#[derive(Debug, Clone, PartialEq)]
pub struct ControlSettings {
    /// Stiffness of the impedance of hips, knees, ankles and lumbar joint [N.m/rad]; arms have 0.3 and toes 0.2 times
    /// as much.
    pub stiffness: f64,
    /// Damping of the impedance over its stiffness [s].
    pub damping_s: f64,
    /// Balance control.
    pub balance: Balance,
    /// Time after which feedback of the state acts [s]; the state then is foreseen. Muscles need some 40 ms.
    pub delay_s: f64,
    /// Time constant with which torques of feedback follow their command [s], as muscle forces follow activation; 0: at
    /// once.
    pub activation_s: f64,
    /// Whether a figure in three dimensions plans its step again after a strong push, and steps out of standing to keep
    /// its balance, by trial in the simulator.
    pub recovery_steps: bool,
    /// Torques along the plan.
    pub torques: TorqueCurves,
    /// Deviations that cost 1 per second.
    pub costs: TrackingCosts,
}

/// Balance control in addition to the impedances of joints.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Balance {
    /// No balance control: the figure falls.
    Nothing,
    /// Feedback of the state of the whole figure.
    WholeState,
    /// The place of the next foot and the torque of the stance hip; planar figures only.
    FootPlacement(FootPlacement),
}

/// Balance by foot placement (Yin, Loken, van de Panne 2007).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FootPlacement {
    /// Further flexion of the swing hip per distance of the mass centre in front of the stance foot [rad/m].
    pub distance: f64,
    /// And per velocity of the mass centre [rad.s/m].
    pub velocity: f64,
    /// Stiffness [N.m/rad] and damping [N.m.s/rad] by which the stance hip of an adult keeps the pelvis upright.
    pub trunk: [f64; 2],
}

/// Torques of the joints over the cycle, to which impedance and feedback add theirs.
#[derive(Debug, Clone, PartialEq)]
pub enum TorqueCurves {
    /// Torques of the plan.
    Plan,
    /// Mean and this number of harmonics of the torques of the plan.
    Harmonics(usize),
    /// Curves of a file, in proportion to the mass of the figure; joints without one keep the torque of the plan.
    Given(Vec<TorqueSeries>),
}

/// Deviations from the plan that have equal cost.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TrackingCosts {
    /// Deviation of the angle of a joint [rad].
    pub angle: f64,
    /// Deviation of the rate of a joint [rad/s].
    pub rate: f64,
    /// Deviation of the rotation of the pelvis in the world [rad].
    pub pelvis: f64,
    /// Deviation of the height of the pelvis [m].
    pub height: f64,
    /// Deviation of the sideways position of the pelvis [m].
    pub sideways: f64,
    /// Deviation of the velocity of the pelvis, along the ground and up [m/s].
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
            balance: Balance::WholeState,
            delay_s: 0.0,
            activation_s: 0.0,
            recovery_steps: true,
            torques: TorqueCurves::Plan,
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

impl ControlSettings {
    /// Gains that survive stronger pushes than the default ones, for planar figures whose feedback acts at once: found
    /// by [`crate::tuning`] for a woman of 60 kg at 1.2 m/s. In three dimensions they survive fewer pushes from the
    /// side without recovery steps, and with late feedback they survive fewer than the default ones
    /// (docs/measured/PHYSICAL_WALK.md).
    #[must_use]
    pub fn tuned_in_the_plane() -> ControlSettings {
        let default = ControlSettings::default();
        ControlSettings {
            stiffness: 97.76,
            damping_s: 0.01783,
            costs: TrackingCosts {
                angle: 3.261_f64.to_radians(),
                rate: 135.0_f64.to_radians(),
                pelvis: 1.519_f64.to_radians(),
                height: 0.0667,
                velocity: [0.4286, 0.5226],
                ..default.costs
            },
            ..default
        }
    }
}

/// Why a figure cannot be controlled.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ControlError {
    /// A joint that the simulator cannot move by motors.
    #[error(transparent)]
    Joint(#[from] WorldError),
    /// A plan whose forces cannot be computed.
    #[error(transparent)]
    Plan(#[from] CurvedJointError),
    /// A figure with other joints or soles than the planned figure.
    #[error("found a figure with {found}; expected {expected}, as in the plan")]
    Figure {
        /// Coordinates and soles of the figure.
        found: String,
        /// Coordinates and soles of the plan.
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
    /// A law for planar figures only.
    #[error("balance by foot placement is for planar figures; expected feedback of the whole state")]
    NotPlanar,
    /// A torque curve of no joint of the figure.
    #[error(
        "found a torque curve of `{coordinate}`; expected coordinates of joints of the figure. hint: curves of a walk \
         in three dimensions need a figure in three dimensions, and those of a planar walk a planar figure"
    )]
    TorqueOf {
        /// The coordinate.
        coordinate: String,
    },
    /// Torque curves of another walk.
    #[error(
        "found torque curves of a cycle of {found_s:.3} s; expected that of the plan, {cycle_s:.3} s, of the same \
         speed and figure"
    )]
    TorqueCycle {
        /// Cycle of the curves [s].
        found_s: f64,
        /// Cycle of the plan [s].
        cycle_s: f64,
    },
    /// Controllers that cannot be joined.
    #[error(
        "found {found} among controllers to be joined; expected controllers of one figure, with the same settings, at \
         several speeds"
    )]
    Joined {
        /// Description of what was passed.
        found: String,
    },
    /// A speed that no plan of a controller has.
    #[error(
        "found the speed {found} m/s; expected {slowest:.2} to {fastest:.2} m/s, the speeds of the plans of this \
         controller"
    )]
    Speed {
        /// The speed [m/s].
        found: f64,
        /// Speed of the slowest plan [m/s].
        slowest: f64,
        /// Speed of the fastest plan [m/s].
        fastest: f64,
    },
    /// A figure that cannot stop, or walk off.
    #[error(transparent)]
    NoStanding(#[from] OptimalWalkError),
    /// Standing of another walk, or without gains.
    #[error(
        "found movements of standing of a walk at {found:.2} m/s; expected those of the slowest walk of the \
         controller, at {slowest:.2} m/s, with feedback of the whole state"
    )]
    Standing {
        /// Speed of the walk [m/s].
        found: f64,
        /// Slowest speed of the controller [m/s].
        slowest: f64,
    },
    /// Movements that do not begin and end in the walk.
    #[error(
        "found a stop or a start that does not join the walk at {speed:.2} m/s; expected those that \
         `StandingMovements::find` returns for this walk"
    )]
    Movements {
        /// Speed of the walk [m/s].
        speed: f64,
    },
    /// The Riccati equation has no solution.
    #[error("the feedback of the walk could not be computed: its Riccati equation did not converge")]
    Riccati,
}
