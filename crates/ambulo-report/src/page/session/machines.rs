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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_state_that_comes_back_keeps_its_place() {
        let period = |machine: &str, state: &str, time_s: [f64; 2]| StatePeriod {
            machine: machine.to_owned(),
            state: state.to_owned(),
            time_s,
        };
        let leg = "left leg";
        let made = machines(&[
            period(leg, "swing", [0.0, 0.2]),
            period(leg, "stance", [0.2, 0.8]),
            period(leg, "swing", [0.8, 1.0]),
            period("arm", "rest", [0.0, 1.0]),
        ]);
        assert_eq!(made.len(), 2);
        assert_eq!(made[0].states, ["stance", "swing"]);
        assert_eq!(made[0].periods.iter().map(|period| period.state).collect::<Vec<_>>(), [1, 0, 1]);
        assert_eq!(made[1].periods, [PagePeriod { state: 0, from_s: 0.0, to_s: 1.0 }]);
    }
}
