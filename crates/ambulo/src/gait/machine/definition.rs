//! The description of a machine: states, transitions, children, activity; and the data that these can read.

use crate::gait::jet::Jet;
use crate::gait::pace_plan::Clock;
use std::fmt;

/// Data that a machine can read: the clock of this step, and all machines as they were after the previous step.
#[derive(Debug, Clone, Copy)]
pub struct MachineInputs<'a> {
    /// Phase and speed of this step.
    pub clock: &'a Clock,
    pub(super) names: &'a [String],
    pub(super) states: &'a [Vec<String>],
    pub(super) before: &'a [(usize, Jet)],
}

/// Outputs of a machine's children in this step.
#[derive(Debug, Clone, Copy)]
pub struct ChildOutputs<'a> {
    /// Number of the first machine below this one in the tree.
    pub(super) first: usize,
    pub(super) names: &'a [String],
    pub(super) outputs: &'a [(usize, Jet)],
}

impl MachineInputs<'_> {
    fn number(&self, machine: &str) -> Option<usize> {
        self.names.iter().position(|name| name == machine)
    }

    /// Name of the active state of a machine after the previous step.
    #[must_use]
    pub fn state(&self, machine: &str) -> Option<&str> {
        let number = self.number(machine)?;
        Some(&self.states[number][self.before[number].0])
    }

    /// Output of a machine in the previous step; zero before the first step.
    #[must_use]
    pub fn output(&self, machine: &str) -> Option<Jet> {
        self.number(machine).map(|number| self.before[number].1)
    }
}

impl ChildOutputs<'_> {
    /// Output of a machine below this one; zero if there is none of this name.
    #[must_use]
    pub fn output(&self, machine: &str) -> Jet {
        let found = self.names.iter().position(|name| name == machine);
        found.map_or(Jet::ZERO, |i| self.outputs[self.first + i].1)
    }
}

/// Computes the output of a machine in a state.
pub(super) type Activity = Box<dyn Fn(usize, &MachineInputs<'_>, &ChildOutputs<'_>) -> Jet + Send + Sync>;
/// Decides whether a transition is taken.
pub(super) type Condition = Box<dyn Fn(&MachineInputs<'_>) -> bool + Send + Sync>;

/// The description of a machine; [`RunningMachine`](super::RunningMachine) has the active states.
pub struct Machine {
    pub(super) name: String,
    pub(super) states: Vec<State>,
    pub(super) transitions: Vec<Transition>,
    pub(super) children: Vec<Machine>,
    pub(super) activity: Activity,
}

/// A state.
#[derive(Debug, Clone, PartialEq)]
pub struct State {
    /// Name.
    pub name: String,
    /// Time and angles of the state, for tables and figures.
    pub span: Option<Span>,
}

/// The time in which a state is active, and the angles at both ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Span {
    /// Start and end in cycles of the foot of the machine (of the right foot for the global cycle).
    pub window: [f64; 2],
    /// Angles at start and end [rad].
    pub bounds: Option<[f64; 2]>,
}

impl State {
    /// A state without times and angles.
    #[must_use]
    pub fn named(name: &str) -> State {
        State { name: name.to_owned(), span: None }
    }
}

/// A change from one state to another.
pub struct Transition {
    /// Index of the state that is left.
    pub from: usize,
    /// Index of the state that is entered.
    pub to: usize,
    /// Description of the condition.
    pub when: String,
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
        Transition { from, to, when: when.into(), condition: Box::new(condition) }
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
            activity: Box::new(activity),
        }
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

    /// The same machine with the children of all machines sorted by a key of their names. The order does not change any output.
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
