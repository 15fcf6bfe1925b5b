//! Machines that a user describes: what they drive, their states with activities, and their transitions.

use super::condition::Condition;
use crate::gait::cyclic_curve::CyclicCurve;
use crate::gait::joint::WalkPart;
use crate::gait::pace_plan::PaceChange;
use crate::numerics::NaturalSpline;
use std::sync::Arc;

/// A machine that a user describes. It runs next to the machine of the walk.
#[derive(Debug, Clone, PartialEq)]
pub struct MachineSettings {
    /// Name, unique among the machines.
    pub name: String,
    /// The joint, the coordinate or the pace that its activities set.
    pub drives: Driven,
    /// Another machine and one of its states: this machine runs only during that state, and is interrupted when it
    /// ends.
    pub during: Option<(String, String)>,
    /// Whether the machine resumes its last state when it runs again; otherwise it restarts in its first state.
    pub resumes: bool,
    /// States; it starts in the first one.
    pub(crate) states: Vec<StateSettings>,
    /// Transitions, in the order in which they are tested.
    pub(crate) transitions: Vec<TransitionSettings>,
}

impl MachineSettings {
    /// The conditions of its transitions, with the conditions inside them.
    #[must_use]
    pub fn conditions(&self) -> Vec<&Condition> {
        let mut all = Vec::new();
        for transition in &self.transitions {
            transition.when.visit(&mut |condition| all.push(condition));
        }
        all
    }

    /// The parts whose curve its states scale and move: part, factor on the distance from upright standing, and offset
    /// [rad].
    pub(in crate::gait) fn altered_curves(&self) -> Vec<(WalkPart, f64, f64)> {
        let of_state = |state: &StateSettings| match (&self.drives, &state.activity) {
            (Driven::Part(part), Activity::Walk { scale, angle, .. }) => Some((*part, *scale, *angle)),
            _ => None,
        };
        self.states.iter().filter_map(of_state).collect()
    }
}

/// The quantity that a machine sets.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Driven {
    /// An angle of the gait.
    Part(WalkPart),
    /// A coordinate of the model that the gait does not move, by name.
    Coordinate(String),
    /// The pace.
    Pace,
    /// No output: other machines wait for the states of this machine.
    Nothing,
}

impl Driven {
    /// Whether it is a joint.
    #[must_use]
    pub(crate) fn moves_a_joint(&self) -> bool {
        matches!(self, Driven::Part(_) | Driven::Coordinate(_))
    }
}

/// A state of a machine.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct StateSettings {
    /// Name.
    pub name: String,
    /// Activity of the machine in this state.
    pub activity: Activity,
    /// Whether the machine has then done its work, for machines that wait for it.
    pub done: bool,
}

/// How a machine computes its output in a state.
#[derive(Debug, Clone, PartialEq)]
pub enum Activity {
    /// No activity, for machines without output.
    Wait,
    /// The curve of the gait at another phase, with the distance from upright standing scaled, and an offset.
    Walk {
        /// Factor on the distance from upright standing.
        scale: f64,
        /// Added to the angle [rad].
        angle: f64,
        /// Added to the phase [cycles].
        phase: f64,
    },
    /// A sub-cycle: from the angle, rate and acceleration at its start to a bound without rate and acceleration, where
    /// the joint stays.
    SubCycle {
        /// The bound [rad].
        to: f64,
        /// Duration [s].
        within_s: f64,
    },
    /// A curve over the cycle of the part's side.
    Curve(CyclicCurve),
    /// A recording.
    Recording {
        /// The recorded values [rad].
        values: Arc<NaturalSpline>,
        /// Time of the recording at which the state is entered [s].
        from_s: f64,
    },
    /// Another pace; its start is the time at which the state is entered.
    Pace(PaceChange),
}

/// A change from one state to another.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct TransitionSettings {
    /// Index of the state that is left.
    pub from: usize,
    /// Index of the state that is entered.
    pub to: usize,
    /// Condition for the transition.
    pub when: Condition,
    /// Duration of the passage from the old activity to the new one [s]. Angle, rate and acceleration are continuous.
    pub within_s: f64,
}

/// Duration of the passage from one activity to another if the file does not give it [s]: about a double support.
pub const PASSAGE_S: f64 = 0.1;
