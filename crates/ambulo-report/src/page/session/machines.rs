//! The state machines of a synthetic walk, with their states over time.

use crate::page::contract::{PageMachine, PagePeriod};
use ambulo::gait::machine::StatePeriod;

/// One entry per machine, in the order of the file.
pub(super) fn machines(periods: &[StatePeriod]) -> Vec<PageMachine> {
    let mut machines: Vec<PageMachine> = Vec::new();
    for StatePeriod { machine, state, time_s: [from_s, to_s] } in periods {
        let number = machines.iter().position(|own| own.name == *machine).unwrap_or_else(|| {
            machines.push(PageMachine { name: machine.clone(), states: Vec::new(), periods: Vec::new() });
            machines.len() - 1
        });
        let own = &mut machines[number];
        let state = own.states.iter().position(|known| known == state).unwrap_or_else(|| {
            own.states.push(state.clone());
            own.states.len() - 1
        });
        own.periods.push(PagePeriod { state, from_s: *from_s, to_s: *to_s });
    }
    machines.iter_mut().for_each(sort_states);
    machines
}

/// Sorts the states by name, so that left and right machines have the same numbers and colours.
fn sort_states(machine: &mut PageMachine) {
    let mut sorted = machine.states.clone();
    sorted.sort_unstable();
    for period in &mut machine.periods {
        let name = &machine.states[period.state];
        period.state = sorted.iter().position(|own| own == name).unwrap_or(period.state);
    }
    machine.states = sorted;
}
