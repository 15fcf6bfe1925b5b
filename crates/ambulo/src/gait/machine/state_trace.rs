//! Records which states the machines of a walk were in, and when.

use super::running_machine::RunningMachine;

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

/// The states of all machines of a tree since its first step.
#[derive(Debug, Clone, Default)]
pub struct StateTrace {
    /// State of each machine and the time at which it was entered [s].
    open: Vec<(usize, f64)>,
    /// Number of the machine, state, start and end [s].
    closed: Vec<(usize, usize, [f64; 2])>,
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
                (*state, *since_s) = (now, time_s);
            }
        }
    }

    /// The times in all states until an end [s], machine by machine, parents before children. Times count from `zero_s`.
    #[must_use]
    pub fn periods(&self, running: &RunningMachine, zero_s: f64, end_s: f64) -> Vec<StatePeriod> {
        let open = self.open.iter().enumerate().map(|(machine, (state, since_s))| (machine, *state, [*since_s, end_s]));
        let mut all: Vec<_> = self.closed.iter().copied().chain(open).collect();
        all.retain(|(_, _, [start, end])| *start < end_s && *end > zero_s);
        all.sort_by(|a, b| a.0.cmp(&b.0).then(a.2[0].total_cmp(&b.2[0])));
        let period = |(machine, state, [start, end]): (usize, usize, [f64; 2])| StatePeriod {
            machine: running.names()[machine].clone(),
            state: running.name_of(machine, state).to_owned(),
            time_s: [start.max(zero_s) - zero_s, end.min(end_s) - zero_s],
        };
        all.into_iter().map(period).collect()
    }
}
