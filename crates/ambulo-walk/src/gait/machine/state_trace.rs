//! Records the states of the machines of a walk over time.

use super::running_machine::RunningMachine;
use crate::numerics::Order;

/// A time in which a machine was in one state.
#[derive(Debug, Clone, PartialEq)]
pub struct StatePeriod {
    /// Name of the machine.
    pub machine: String,
    /// Name of the state.
    pub state: String,
    /// Start and end [s].
    pub time_s: [f64; 2],
}

/// A change of a machine from one state to another.
#[derive(Debug, Clone, PartialEq)]
pub struct StateChange {
    /// Time of the change [s].
    pub time_s: f64,
    /// Name of the machine.
    pub machine: String,
    /// The state that it left; `None` where the trace begins.
    pub from: Option<String>,
    /// The state that it entered.
    pub to: String,
    /// The condition that was true; empty where the trace begins.
    pub when: String,
}

/// The states of all machines of a tree since its first step.
#[derive(Debug, Clone, Default)]
pub struct StateTrace {
    /// State of each machine and the time at which it was entered [s].
    open: Vec<(usize, f64)>,
    /// Number of the machine, state, start and end [s].
    closed: Vec<(usize, usize, [f64; 2])>,
    /// Every change, in order of time.
    changes: Vec<StateChange>,
}

impl StateTrace {
    /// Adds the states after a step at a time [s].
    pub fn add(&mut self, running: &RunningMachine, time_s: f64) {
        if self.open.is_empty() {
            self.open = (0..running.names().len()).map(|machine| (running.state(machine), time_s)).collect();
        }
        for (machine, (state, since_s)) in self.open.iter_mut().enumerate() {
            let now = running.state(machine);
            if now != *state {
                self.closed.push((machine, *state, [*since_s, time_s]));
                self.changes.push(StateChange {
                    time_s,
                    machine: running.names()[machine].clone(),
                    from: Some(running.name_of(machine, *state).to_owned()),
                    to: running.state_name(machine).to_owned(),
                    when: running.reason(machine).unwrap_or_default().to_owned(),
                });
                (*state, *since_s) = (now, time_s);
            }
        }
    }

    /// The times in all states until an end [s], machine by machine, parents before children. Times count from
    /// `zero_s`.
    #[must_use]
    pub fn periods(&self, running: &RunningMachine, zero_s: f64, end_s: f64) -> Vec<StatePeriod> {
        let open = self.open.iter().enumerate().map(|(machine, (state, since_s))| (machine, *state, [*since_s, end_s]));
        let mut all: Vec<_> = self.closed.iter().copied().chain(open).collect();
        all.retain(|(_, _, [start, end])| *start < end_s && *end > zero_s);
        all.sort_by_numbers(|(machine, _, time_s)| [*machine as f64, time_s[0]]);
        let period = |(machine, state, [start, end]): (usize, usize, [f64; 2])| StatePeriod {
            machine: running.names()[machine].clone(),
            state: running.name_of(machine, state).to_owned(),
            time_s: [start.max(zero_s) - zero_s, end.min(end_s) - zero_s],
        };
        all.into_iter().map(period).collect()
    }

    /// The states in which all machines are at `zero_s`, parents before children, and every change until `end_s` in
    /// order of time. Times count from `zero_s`.
    #[must_use]
    pub fn changes(&self, running: &RunningMachine, zero_s: f64, end_s: f64) -> Vec<StateChange> {
        let first = self.periods(running, zero_s, end_s).into_iter().filter(|period| period.time_s[0] <= 0.0);
        let start = first.map(|StatePeriod { machine, state, .. }| StateChange {
            time_s: 0.0,
            machine,
            from: None,
            to: state,
            when: String::new(),
        });
        let inside = self.changes.iter().filter(|change| change.time_s > zero_s && change.time_s < end_s);
        start.chain(inside.map(|change| StateChange { time_s: change.time_s - zero_s, ..change.clone() })).collect()
    }
}

/// Reports the states and changes of a trace while it grows: as [`StateTrace::changes`], each in the step in which it
/// happens.
pub struct StateWatch<'a> {
    /// First and last instant [s]; reported times count from the first one.
    ends_s: [f64; 2],
    /// Number of changes of the trace that were reported or left out, once the first instant is reached.
    seen: Option<usize>,
    tell: &'a mut dyn FnMut(&StateChange),
}

impl<'a> StateWatch<'a> {
    /// Tells of what happens from a first to a last instant [s].
    pub fn new(ends_s: [f64; 2], tell: &'a mut dyn FnMut(&StateChange)) -> StateWatch<'a> {
        StateWatch { ends_s, seen: None, tell }
    }

    /// Tells of what is new in a trace after a step at a time [s].
    pub fn look(&mut self, trace: &StateTrace, running: &RunningMachine, time_s: f64) {
        let [zero_s, end_s] = self.ends_s;
        match self.seen {
            None if time_s < zero_s => return,
            None => trace.changes(running, zero_s, end_s).iter().for_each(&mut *self.tell),
            Some(seen) => {
                let inside = trace.changes[seen..].iter().filter(|change| change.time_s < end_s);
                inside
                    .for_each(|change| (self.tell)(&StateChange { time_s: change.time_s - zero_s, ..change.clone() }));
            }
        }
        self.seen = Some(trace.changes.len());
    }
}
