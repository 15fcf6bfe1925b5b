//! Runs a tree of machines step by step.
//!
//! One step, for every machine of the tree:
//!
//! 1. The transitions of the active state are tested on the snapshot of the previous step and the clock of this step. The first one whose
//!    condition is true is taken, then the transitions of the new state are tested, at most once per state of the machine. A step that
//!    passes several short states therefore ends in the right one.
//! 2. The children run in any order, because none of them reads what another one does in this step.
//! 3. The activity function computes the output from the state, the clock, the snapshot and the new outputs of the children.
//!
//! A step does not allocate. Pinned by: tests/gait_machine.rs.

use super::definition::{ChildOutputs, Machine, MachineInputs};
use crate::gait::jet::Jet;
use crate::gait::pace_plan::Clock;

/// State and output of every machine after a step, parents before children.
type Snapshot = Vec<(usize, Jet)>;

/// A machine with its active states and outputs.
#[derive(Debug)]
pub struct RunningMachine {
    machine: Machine,
    /// Names, parents before children, children in the order of the tree.
    names: Vec<String>,
    /// Names of the states of each machine.
    states: Vec<Vec<String>>,
    before: Snapshot,
    after: Snapshot,
}

impl RunningMachine {
    /// A machine before its first step.
    #[must_use]
    pub fn new(machine: Machine) -> RunningMachine {
        let (mut names, mut states) = (Vec::new(), Vec::new());
        list(&machine, &mut names, &mut states);
        let start = vec![(0, Jet::ZERO); names.len()];
        RunningMachine { machine, names, states, before: start.clone(), after: start }
    }

    /// The machine itself.
    #[must_use]
    pub fn machine(&self) -> &Machine {
        &self.machine
    }

    /// Runs the whole tree once.
    pub fn step(&mut self, clock: &Clock) {
        std::mem::swap(&mut self.before, &mut self.after);
        let inputs = MachineInputs { clock, names: &self.names, states: &self.states, before: &self.before };
        run(&self.machine, 0, &inputs, &mut self.after);
    }

    /// Number of a machine by its name, for [`RunningMachine::state`] and [`RunningMachine::output`].
    #[must_use]
    pub fn number(&self, name: &str) -> Option<usize> {
        self.names.iter().position(|known| known == name)
    }

    /// Index of the active state of a machine.
    #[must_use]
    pub fn state(&self, machine: usize) -> usize {
        self.after[machine].0
    }

    /// Name of the active state of a machine.
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

/// Runs a machine and all machines below it; returns the number of the next machine in the tree.
fn run(machine: &Machine, number: usize, inputs: &MachineInputs<'_>, after: &mut [(usize, Jet)]) -> usize {
    let state = settled(machine, inputs.before[number].0, inputs);
    let mut next = number + 1;
    for child in &machine.children {
        next = run(child, next, inputs, after);
    }
    let children = ChildOutputs { first: number + 1, names: &inputs.names[number + 1..next], outputs: after };
    after[number] = (state, (machine.activity)(state, inputs, &children));
    next
}

/// The state after all transitions of this step.
fn settled(machine: &Machine, mut state: usize, inputs: &MachineInputs<'_>) -> usize {
    for _ in 0..machine.states.len() {
        let taken =
            machine.transitions.iter().find(|transition| transition.from == state && (transition.condition)(inputs));
        match taken {
            Some(transition) => state = transition.to,
            None => break,
        }
    }
    state
}
