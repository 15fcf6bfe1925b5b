//! What a machine is: states, transitions, children, activity.

use super::running::{Children, Sight};
use crate::gait::jet::Jet;
use std::fmt;

/// Output of a machine in a state, from what it sees and what its children gave in this step.
pub(super) type Activity = Box<dyn Fn(usize, &Sight<'_>, &Children<'_>) -> Jet + Send + Sync>;
/// Whether a transition is to be taken.
pub(super) type Condition = Box<dyn Fn(&Sight<'_>) -> bool + Send + Sync>;

/// A machine: description only; [`Running`](super::Running) holds which states are active.
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
    /// When it is active and which angles bound it, for readers.
    pub span: Option<Span>,
}

/// When a state is active, and the angles at both ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Span {
    /// Activation and end in cycles of the machine's own foot (of the right foot for the global cycle).
    pub window: [f64; 2],
    /// Angles there [rad].
    pub bounds: Option<[f64; 2]>,
}

impl State {
    /// A state of which nothing more is told.
    #[must_use]
    pub fn named(name: &str) -> State {
        State { name: name.to_owned(), span: None }
    }
}

/// A way from one state to another.
pub struct Transition {
    /// Index of the state that is left.
    pub from: usize,
    /// Index of the state that is entered.
    pub to: usize,
    /// When, in words.
    pub when: String,
    pub(super) condition: Condition,
}

impl Transition {
    /// A transition that is taken whenever the condition holds.
    pub fn new(
        from: usize,
        to: usize,
        when: impl Into<String>,
        condition: impl Fn(&Sight<'_>) -> bool + Send + Sync + 'static,
    ) -> Transition {
        Transition { from, to, when: when.into(), condition: Box::new(condition) }
    }
}

impl Machine {
    /// A machine that starts in its first state; names of machines must differ within a tree.
    pub fn new(
        name: &str,
        states: Vec<State>,
        activity: impl Fn(usize, &Sight<'_>, &Children<'_>) -> Jet + Send + Sync + 'static,
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

    /// With transitions; those that name states that are not there are left out.
    #[must_use]
    pub fn with_transitions(mut self, transitions: impl IntoIterator<Item = Transition>) -> Machine {
        let count = self.states.len();
        self.transitions.extend(transitions.into_iter().filter(|way| way.from < count && way.to < count));
        self
    }

    /// With machines that run side by side below it.
    #[must_use]
    pub fn with_children(mut self, children: impl IntoIterator<Item = Machine>) -> Machine {
        self.children.extend(children);
        self
    }

    /// The same machine, children everywhere in the order of a key of their names: nothing that it gives may change.
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

    /// States; the first is where it starts.
    #[must_use]
    pub fn states(&self) -> &[State] {
        &self.states
    }

    /// Transitions, in the order in which they are tested.
    #[must_use]
    pub fn transitions(&self) -> &[Transition] {
        &self.transitions
    }

    /// Machines that run side by side below it.
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
