//! A tree of machines, step by step.
//!
//! One step, for every machine of the tree:
//!
//! 1. Transitions out of the active state are tested on the snapshot of the step before and on the external data of this step; one
//!    that holds is taken, and those of the state then entered are tested in turn, at most once for each state of the machine. So
//!    a step that passes over several short states ends in the right one.
//! 2. The children run, in any order: none sees what another does in this step.
//! 3. The activity function gives the machine's output from its state, the external data, the snapshot, and its children's new
//!    outputs.
//!
//! No step allocates. Pinned by: tests/gait_machine.rs.

use super::definition::Machine;
use crate::gait::jet::Jet;
use crate::gait::speed_plan::Clock;

/// State and output of every machine after a step, parents before children.
type Snapshot = Vec<(usize, Jet)>;

/// A machine with its active states and outputs.
#[derive(Debug)]
pub struct Running {
    machine: Machine,
    /// Names, parents before children, children in the order of the tree.
    names: Vec<String>,
    /// Names of the states of each machine.
    states: Vec<Vec<String>>,
    before: Snapshot,
    after: Snapshot,
}

/// What a machine can see: external data of this step, and everything as it was after the step before.
#[derive(Debug, Clone, Copy)]
pub struct Sight<'a> {
    /// Phase and speed of this step.
    pub clock: &'a Clock,
    names: &'a [String],
    states: &'a [Vec<String>],
    before: &'a [(usize, Jet)],
}

/// Outputs that a machine's children gave in this step.
#[derive(Debug, Clone, Copy)]
pub struct Children<'a> {
    /// Numbers of all machines below this one, and theirs.
    first: usize,
    names: &'a [String],
    outputs: &'a [(usize, Jet)],
}

impl Sight<'_> {
    fn number(&self, machine: &str) -> Option<usize> {
        self.names.iter().position(|name| name == machine)
    }

    /// Name of the state in which a machine was after the step before.
    #[must_use]
    pub fn state(&self, machine: &str) -> Option<&str> {
        let number = self.number(machine)?;
        Some(&self.states[number][self.before[number].0])
    }

    /// Output of a machine in the step before; zero before the first.
    #[must_use]
    pub fn output(&self, machine: &str) -> Option<Jet> {
        self.number(machine).map(|number| self.before[number].1)
    }
}

impl Children<'_> {
    /// Output of a machine below this one; zero for names that are not there.
    #[must_use]
    pub fn output(&self, machine: &str) -> Jet {
        let found = self.names.iter().position(|name| name == machine);
        found.map_or(Jet::ZERO, |i| self.outputs[self.first + i].1)
    }
}

impl Running {
    /// A machine before its first step.
    #[must_use]
    pub fn new(machine: Machine) -> Running {
        let (mut names, mut states) = (Vec::new(), Vec::new());
        list(&machine, &mut names, &mut states);
        let start = vec![(0, Jet::ZERO); names.len()];
        Running { machine, names, states, before: start.clone(), after: start }
    }

    /// The machine itself.
    #[must_use]
    pub fn machine(&self) -> &Machine {
        &self.machine
    }

    /// Runs the whole tree once.
    pub fn step(&mut self, clock: &Clock) {
        std::mem::swap(&mut self.before, &mut self.after);
        let sight = Sight { clock, names: &self.names, states: &self.states, before: &self.before };
        run(&self.machine, 0, &sight, &mut self.after);
    }

    /// Number of a machine by its name, for [`Running::state`] and [`Running::output`].
    #[must_use]
    pub fn number(&self, name: &str) -> Option<usize> {
        self.names.iter().position(|known| known == name)
    }

    /// Index of a machine's active state.
    #[must_use]
    pub fn state(&self, machine: usize) -> usize {
        self.after[machine].0
    }

    /// Name of a machine's active state.
    #[must_use]
    pub fn state_name(&self, machine: usize) -> &str {
        &self.states[machine][self.state(machine)]
    }

    /// Output of a machine in the last step.
    #[must_use]
    pub fn output(&self, machine: usize) -> Jet {
        self.after[machine].1
    }
}

fn list(machine: &Machine, names: &mut Vec<String>, states: &mut Vec<Vec<String>>) {
    names.push(machine.name.clone());
    states.push(machine.states.iter().map(|state| state.name.clone()).collect());
    for child in &machine.children {
        list(child, names, states);
    }
}

/// Runs a machine and all below it; gives the number of the next machine in the tree.
fn run(machine: &Machine, number: usize, sight: &Sight<'_>, after: &mut [(usize, Jet)]) -> usize {
    let state = settled(machine, sight.before[number].0, sight);
    let mut next = number + 1;
    for child in &machine.children {
        next = run(child, next, sight, after);
    }
    let children = Children { first: number + 1, names: &sight.names[number + 1..next], outputs: after };
    after[number] = (state, (machine.activity)(state, sight, &children));
    next
}

/// The state after all transitions of this step.
fn settled(machine: &Machine, mut state: usize, sight: &Sight<'_>) -> usize {
    for _ in 0..machine.states.len() {
        let taken = machine.transitions.iter().find(|way| way.from == state && (way.condition)(sight));
        match taken {
            Some(way) => state = way.to,
            None => break,
        }
    }
    state
}
