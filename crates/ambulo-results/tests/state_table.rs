//! The table of the states of a gait's machines.

use ambulo::gait::machine::StatePeriod;
use ambulo_results::internals::{STATES_HEAD, read_states};
use ambulo_results::states_csv;

#[test]
fn states_that_are_written_read_back() {
    let period = |machine: &str, state: &str, time_s: [f64; 2]| StatePeriod {
        machine: machine.to_owned(),
        state: state.to_owned(),
        time_s,
    };
    let states = [
        period("walk", "double support, right foot ahead", [0.0, 0.25]),
        period("a \"named\" machine", "two\nlines", [0.0, 1.5]),
        period("=sum", "E1", [0.25, 1.5]),
    ];
    assert_eq!(read_states(&states_csv(&states)).unwrap(), states);
    let wrong = read_states(&format!("{STATES_HEAD}\nknee,E1,0.5,0.2\n")).unwrap_err();
    assert!(wrong.contains("line 2") && wrong.contains("knee,E1,0.5,0.2"), "{wrong}");
    assert!(read_states("time,event\n").unwrap_err().contains("line 1"));
}
