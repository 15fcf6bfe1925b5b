//! The description of a machine: states, transitions, children, activity; and the data that these can read.

use crate::gait::jet::Jet;
use crate::gait::pace_plan::Clock;
use crate::gait::quintic::{End, quintic};
use crate::model::BySide;
use std::fmt;
use std::sync::Arc;

/// Data that a machine can read: the clock and the figure in this step, and all machines as they were after the
/// previous step.
#[derive(Debug, Clone, Copy)]
pub struct MachineInputs<'a> {
    /// Phase and speed of this step.
    pub clock: &'a Clock,
    /// State of the figure in this step.
    pub sensed: &'a Sensed,
    pub(super) tree: &'a Tree<'a>,
    /// Time [s] and steps of the figure when the machine that reads entered its state.
    pub(super) entered: [f64; 2],
}

/// All machines as they were after the previous step, parents before children.
#[derive(Debug, Clone, Copy)]
pub(super) struct Tree<'a> {
    pub(super) names: &'a [String],
    pub(super) states: &'a [Vec<State>],
    pub(super) before: &'a [Active],
}

/// State of the figure that machines can read, apart from the clock.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Sensed {
    /// Time since the machines began [s]; below zero before that.
    pub time_s: f64,
    /// Whether each foot is loaded.
    pub loaded: BySide<bool>,
    /// Whether each foot was loaded in the previous step.
    pub loaded_before: BySide<bool>,
    /// Angles of joints [rad]: clinical signs for parts of the gait, the model's signs for coordinates.
    pub angles: Vec<(String, f64)>,
    /// Numbers from outside.
    pub signals: Vec<(String, f64)>,
}

/// A machine after a step.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Active {
    /// Index of its state.
    pub(super) state: usize,
    /// The state before a machine above interrupted it.
    pub(super) interrupted: Option<usize>,
    /// Time [s] and steps of the figure when it entered its state.
    pub(super) entered: [f64; 2],
    /// Why it entered its state.
    pub(super) cause: Cause,
    pub(super) output: Jet,
    pub(super) passage: Option<Passage>,
}

/// Why a machine is in its state.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(super) enum Cause {
    /// The machine started in this state.
    #[default]
    Start,
    /// The gate of the machine opened (true) or closed.
    Gate(bool),
    /// A transition by its number.
    Transition(usize),
}

/// The rest of an earlier activity, which fades within some time.
#[derive(Debug, Clone, Copy)]
pub(super) struct Passage {
    start_s: f64,
    duration_s: f64,
    /// Output of the earlier activity minus output of the new one, at the start.
    from: Jet,
}

impl Passage {
    pub(super) fn new(start_s: f64, duration_s: f64, from: Jet) -> Passage {
        Passage { start_s, duration_s, from }
    }

    pub(super) fn is_over(&self, time_s: f64) -> bool {
        time_s - self.start_s >= self.duration_s
    }

    /// Difference from the new activity at a time: a quintic from the difference at the start, with its rate and
    /// acceleration, to zero. Zero after the end.
    pub(super) fn at(&self, time_s: f64) -> Jet {
        if self.is_over(time_s) {
            return Jet::ZERO;
        }
        let (since_s, span) = (time_s - self.start_s, self.duration_s);
        let from = End {
            value: Jet::constant(self.from.value),
            slope: Jet::constant(self.from.rate * span),
            curvature: Jet::constant(self.from.acceleration * span * span),
        };
        quintic(from, End::default(), Jet::new(since_s / span, 1.0 / span, 0.0))
    }
}

/// Outputs of a machine's children in this step.
#[derive(Debug, Clone, Copy)]
pub struct ChildOutputs<'a> {
    /// Number of the first machine below this one in the tree.
    pub(super) first: usize,
    pub(super) names: &'a [String],
    pub(super) outputs: &'a [Active],
}

impl<'a> MachineInputs<'a> {
    fn number(&self, machine: &str) -> Option<usize> {
        self.tree.names.iter().position(|name| name == machine)
    }

    /// Name of the active state of a machine after the previous step.
    #[must_use]
    pub fn state(&self, machine: &str) -> Option<&'a str> {
        let number = self.number(machine)?;
        Some(&self.tree.states[number][self.tree.before[number].state].name)
    }

    /// Output of a machine in the previous step; zero before the first step.
    #[must_use]
    pub fn output(&self, machine: &str) -> Option<Jet> {
        self.number(machine).map(|number| self.tree.before[number].output)
    }

    /// Whether a machine was in a state that is marked as done.
    #[must_use]
    pub(crate) fn is_done(&self, machine: &str) -> bool {
        self.number(machine).is_some_and(|number| self.tree.states[number][self.tree.before[number].state].done)
    }

    /// Time since the machine that reads this entered its state [s].
    #[must_use]
    pub fn since_s(&self) -> f64 {
        self.sensed.time_s - self.entered[0]
    }

    /// Steps of the figure since the machine that reads this entered its state; with fractions.
    #[must_use]
    pub fn steps(&self) -> f64 {
        2.0 * self.clock.phase.value - self.entered[1]
    }

    /// An angle of the figure [rad]; of the previous step's machines where no simulation measures it.
    #[must_use]
    pub fn angle(&self, name: &str) -> Option<f64> {
        let measured = self.sensed.angles.iter().find(|(own, _)| own == name).map(|(_, angle)| *angle);
        measured.or_else(|| self.output(name).map(|output| output.value))
    }
}

impl ChildOutputs<'_> {
    /// Output of a machine below this one; zero if there is none of this name.
    #[must_use]
    pub fn output(&self, machine: &str) -> Jet {
        let found = self.names.iter().position(|name| name == machine);
        found.map_or(Jet::ZERO, |i| self.outputs[self.first + i].output)
    }
}

/// Computes the output of a machine in a state.
pub(super) type Activity = Arc<dyn Fn(usize, &MachineInputs<'_>, &ChildOutputs<'_>) -> Jet + Send + Sync>;
/// Decides whether a transition is taken.
pub(super) type Condition = Arc<dyn Fn(&MachineInputs<'_>) -> bool + Send + Sync>;

/// The description of a machine; [`RunningMachine`](super::RunningMachine) has the active states.
#[derive(Clone)]
pub struct Machine {
    pub(super) name: String,
    pub(super) states: Vec<State>,
    pub(super) transitions: Vec<Transition>,
    pub(super) children: Vec<Machine>,
    pub(super) activity: Activity,
    pub(super) gate: Option<Gate>,
}

/// Condition for a machine to run. While it does not run, it is in its first state.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Gate {
    /// Another machine and its state; `None` for a machine that runs from the time at which machines begin.
    pub during: Option<(String, String)>,
    /// Whether the machine resumes the state in which it was interrupted.
    pub resumes: bool,
    /// Duration of the passages into the second state, where it starts, and back into the first [s].
    pub within_s: [f64; 2],
}

/// A state.
#[derive(Debug, Clone, PartialEq)]
pub struct State {
    /// Name.
    pub name: String,
    /// Time and angles of the state, for tables and figures.
    pub span: Option<Span>,
    /// Whether the machine has then done its work.
    pub done: bool,
}

/// The time in which a state is active, and the angles at both ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Span {
    /// Start and end in cycles of the foot of the machine (of the right foot for the global cycle).
    pub window: [f64; 2],
    /// Angles at start and end [rad].
    pub bounds: Option<[f64; 2]>,
}

impl Gate {
    /// Why the machine starts, or is interrupted.
    pub(super) fn reason(&self, opens: bool) -> String {
        match (&self.during, opens) {
            (Some((machine, state)), true) => format!("{machine} is in {state}"),
            (Some((machine, state)), false) => format!("{machine} left {state}"),
            (None, _) => "the machines begin".to_owned(),
        }
    }
}

impl State {
    /// A state without times and angles.
    #[must_use]
    pub fn named(name: &str) -> State {
        State { name: name.to_owned(), span: None, done: false }
    }
}

/// A change from one state to another.
#[derive(Clone)]
pub struct Transition {
    /// Index of the state that is left.
    pub from: usize,
    /// Index of the state that is entered.
    pub to: usize,
    /// Description of the condition.
    pub when: String,
    /// Duration of the passage to the activity of the new state [s]; 0 where both agree.
    pub within_s: f64,
    pub(super) condition: Condition,
}

impl Transition {
    /// A transition that is taken when the condition is true.
    pub fn new(
        from: usize,
        to: usize,
        when: impl Into<String>,
        condition: impl Fn(&MachineInputs<'_>) -> bool + Send + Sync + 'static,
    ) -> Transition {
        Transition { from, to, when: when.into(), within_s: 0.0, condition: Arc::new(condition) }
    }

    /// The same transition with a passage to the new activity [s], in which the output stays continuous up to its
    /// acceleration.
    #[must_use]
    pub fn within(mut self, within_s: f64) -> Transition {
        self.within_s = within_s;
        self
    }
}

impl Machine {
    /// A machine that starts in its first state. Machines in a tree must have different names.
    pub fn new(
        name: &str,
        states: Vec<State>,
        activity: impl Fn(usize, &MachineInputs<'_>, &ChildOutputs<'_>) -> Jet + Send + Sync + 'static,
    ) -> Machine {
        let states = if states.is_empty() { vec![State::named("active")] } else { states };
        Machine {
            name: name.to_owned(),
            states,
            transitions: Vec::new(),
            children: Vec::new(),
            activity: Arc::new(activity),
            gate: None,
        }
    }

    /// A machine that runs at some times only. Its first state is rest; it starts in the second.
    #[must_use]
    pub(crate) fn with_gate(mut self, gate: Gate) -> Machine {
        self.gate = Some(gate);
        self
    }

    /// Adds transitions; transitions of states that do not exist are ignored.
    #[must_use]
    pub fn with_transitions(mut self, transitions: impl IntoIterator<Item = Transition>) -> Machine {
        let count = self.states.len();
        self.transitions
            .extend(transitions.into_iter().filter(|transition| transition.from < count && transition.to < count));
        self
    }

    /// Adds machines that run concurrently below this one.
    #[must_use]
    pub fn with_children(mut self, children: impl IntoIterator<Item = Machine>) -> Machine {
        self.children.extend(children);
        self
    }

    /// The same machine with each child replaced by the result of a function.
    pub(super) fn with_mapped_children(mut self, image: impl FnMut(Machine) -> Machine) -> Machine {
        self.children = self.children.into_iter().map(image).collect();
        self
    }

    /// The same machine with the children of all machines sorted by a key of their names. The order does not change any
    /// output.
    #[must_use]
    pub fn with_children_ordered(mut self, key: &impl Fn(&str) -> u64) -> Machine {
        self.children = self.children.into_iter().map(|child| child.with_children_ordered(key)).collect();
        self.children.sort_by_key(|child| key(&child.name));
        self
    }

    /// Name.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// States; the machine starts in the first one.
    #[must_use]
    pub fn states(&self) -> &[State] {
        &self.states
    }

    /// Transitions, in the order in which they are tested.
    #[must_use]
    pub fn transitions(&self) -> &[Transition] {
        &self.transitions
    }

    /// Machines that run concurrently below this one.
    #[must_use]
    pub fn children(&self) -> &[Machine] {
        &self.children
    }
}

impl fmt::Debug for Machine {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Machine")
            .field("name", &self.name)
            .field("states", &self.states)
            .field("transitions", &self.transitions)
            .field("children", &self.children)
            .finish_non_exhaustive()
    }
}

impl fmt::Debug for Transition {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} -> {} when {}", self.from, self.to, self.when)
    }
}
