//! Runs a tree of machines step by step.
//!
//! One step, for every machine of the tree:
//!
//! 1. The transitions of the active state are tested on the snapshot of the previous step and the clock of this step.
//!    The first one whose condition is true is taken, then the transitions of the new state are tested, at most once
//!    per state of the machine. A step that passes several short states therefore ends in the right one.
//! 2. The children run in any order, because none of them reads what another one does in this step.
//! 3. The activity function computes the output from the state, the clock, the snapshot and the new outputs of the
//!    children.
//!
//! 4. Where a transition has a passage, the difference between the activities of both states at that instant, with its
//!    rate and acceleration, fades along a quintic, so the output is C².
//!
//! A machine with a gate is in its first state until the gate opens, and again when it closes; the gate is tested
//! before transitions. A step does not allocate. Pinned by: tests/gait_machine.rs.

use super::definition::{
    Active, Cause, ChildOutputs, Gate, Machine, MachineInputs, Passage, Sensed, State, Transition, Tree,
};
use crate::gait::jet::Jet;
use crate::gait::pace_plan::Clock;

/// A machine with its active states and outputs.
#[derive(Debug, Clone)]
pub struct RunningMachine {
    machine: Machine,
    /// Names, parents before children, children in the order of the tree.
    names: Vec<String>,
    /// States of each machine.
    states: Vec<Vec<State>>,
    /// Conditions of the transitions of each machine, and conditions of its gate: closed, open.
    reasons: Vec<Reasons>,
    /// State and output of every machine before and after the last step, in the order of the names.
    before: Vec<Active>,
    after: Vec<Active>,
}

impl RunningMachine {
    /// A machine before its first step.
    #[must_use]
    pub fn new(machine: Machine) -> RunningMachine {
        let (mut names, mut states, mut reasons) = (Vec::new(), Vec::new(), Vec::new());
        list(&machine, &mut names, &mut states, &mut reasons);
        let start = vec![Active::default(); names.len()];
        RunningMachine { machine, names, states, reasons, before: start.clone(), after: start }
    }

    /// The machine itself.
    #[must_use]
    pub fn machine(&self) -> &Machine {
        &self.machine
    }

    /// Runs the whole tree once.
    pub fn step(&mut self, clock: &Clock, sensed: &Sensed) {
        std::mem::swap(&mut self.before, &mut self.after);
        let tree = Tree { names: &self.names, states: &self.states, before: &self.before };
        let inputs = MachineInputs { clock, sensed, tree: &tree, entered: [0.0; 2] };
        run(&self.machine, 0, &inputs, &mut self.after);
    }

    /// Names of all machines, parents before children.
    #[must_use]
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// Number of a machine by its name, for [`RunningMachine::state`] and [`RunningMachine::output`].
    #[must_use]
    pub fn number(&self, name: &str) -> Option<usize> {
        self.names.iter().position(|known| known == name)
    }

    /// Index of the active state of a machine.
    #[must_use]
    pub fn state(&self, machine: usize) -> usize {
        self.after[machine].state
    }

    /// Whether a machine has entered its state in the last step.
    #[must_use]
    pub(crate) fn has_changed(&self, machine: usize) -> bool {
        self.after[machine].state != self.before[machine].state
    }

    /// Name of the active state of a machine.
    #[must_use]
    pub fn state_name(&self, machine: usize) -> &str {
        self.name_of(machine, self.state(machine))
    }

    /// Name of a state of a machine.
    #[must_use]
    pub fn name_of(&self, machine: usize, state: usize) -> &str {
        &self.states[machine][state].name
    }

    /// The condition that brought a machine into its state; `None` for the state in which it started.
    #[must_use]
    pub fn reason(&self, machine: usize) -> Option<&str> {
        let (transitions, gate) = &self.reasons[machine];
        match self.after[machine].cause {
            Cause::Start => None,
            Cause::Gate(opens) => gate.as_ref().map(|words| words[usize::from(opens)].as_str()),
            Cause::Transition(number) => transitions.get(number).map(String::as_str),
        }
    }

    /// Output of a machine in the last step.
    #[must_use]
    pub fn output(&self, machine: usize) -> Jet {
        self.after[machine].output
    }
}

type Reasons = (Vec<String>, Option<[String; 2]>);

fn list(machine: &Machine, names: &mut Vec<String>, states: &mut Vec<Vec<State>>, reasons: &mut Vec<Reasons>) {
    names.push(machine.name.clone());
    states.push(machine.states.clone());
    let conditions = machine.transitions.iter().map(|transition| transition.when.clone()).collect();
    reasons.push((conditions, machine.gate.as_ref().map(|gate| [false, true].map(|opens| gate.reason(opens)))));
    for child in &machine.children {
        list(child, names, states, reasons);
    }
}

/// Runs a machine and all machines below it; returns the number of the next machine in the tree.
fn run(machine: &Machine, number: usize, inputs: &MachineInputs<'_>, after: &mut [Active]) -> usize {
    let mut next = number + 1;
    for child in &machine.children {
        next = run(child, next, inputs, after);
    }
    let children = ChildOutputs { first: number + 1, names: &inputs.tree.names[number + 1..next], outputs: after };
    let before = &inputs.tree.before[number];
    let taken = settled(machine, before, inputs);
    let time_s = inputs.sensed.time_s;
    let output = (machine.activity)(taken.state, &MachineInputs { entered: taken.entered, ..*inputs }, &children);
    let mut passage = before.passage;
    if taken.state != before.state && taken.within_s > 0.0 {
        let own = (machine.activity)(before.state, &MachineInputs { entered: before.entered, ..*inputs }, &children);
        let old = before.passage.map_or(own, |passage| own + passage.at(time_s));
        passage = Some(Passage::new(time_s, taken.within_s, old - output));
    }
    let output = passage.map_or(output, |passage| output + passage.at(time_s));
    let passage = passage.filter(|passage| !passage.is_over(time_s));
    let Settled { state, interrupted, entered, cause, .. } = taken;
    after[number] = Active { state, interrupted, entered, cause, output, passage };
    next
}

/// The state after the transitions of a step.
struct Settled {
    state: usize,
    /// The state to go on with after an interruption.
    interrupted: Option<usize>,
    /// Time [s] and steps of the figure when the state was entered.
    entered: [f64; 2],
    cause: Cause,
    /// Duration of the passage to it [s].
    within_s: f64,
}

impl Settled {
    fn enter(&mut self, state: usize, cause: Cause, within_s: f64, inputs: &MachineInputs<'_>) {
        (self.state, self.cause, self.within_s) = (state, cause, within_s);
        self.entered = [inputs.sensed.time_s, 2.0 * inputs.clock.phase.value];
    }
}

/// The state after all transitions of this step.
fn settled(machine: &Machine, before: &Active, inputs: &MachineInputs<'_>) -> Settled {
    let &Active { state, interrupted, entered, cause, .. } = before;
    let mut settled = Settled { state, interrupted, entered, cause, within_s: 0.0 };
    if let Some(gate) = &machine.gate {
        let open = is_open(gate, inputs);
        if open && state == 0 {
            let first = interrupted.filter(|_| gate.resumes).unwrap_or(1);
            settled.enter(first, Cause::Gate(true), gate.within_s[0], inputs);
            settled.interrupted = None;
        } else if !open && state > 0 {
            settled.enter(0, Cause::Gate(false), gate.within_s[1], inputs);
            settled.interrupted = Some(state);
        }
        if !open {
            return settled;
        }
    }
    for _ in 0..machine.states.len() {
        let now = MachineInputs { entered: settled.entered, ..*inputs };
        let leaves = |transition: &Transition| transition.from == settled.state && (transition.condition)(&now);
        match machine.transitions.iter().enumerate().find(|(_, transition)| leaves(transition)) {
            Some((k, taken)) => settled.enter(taken.to, Cause::Transition(k), taken.within_s, inputs),
            None => break,
        }
    }
    settled
}

fn is_open(gate: &Gate, inputs: &MachineInputs<'_>) -> bool {
    let begun = inputs.sensed.time_s >= 0.0;
    begun && gate.during.as_ref().is_none_or(|(machine, state)| inputs.state(machine) == Some(state))
}
