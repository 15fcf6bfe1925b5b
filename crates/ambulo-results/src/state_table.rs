//! The states of the machines of a gait, as rows of `states.csv`.

use ambulo::gait::machine::StatePeriod;
use ambulo_formats::table::guarded;
use std::borrow::Cow;

/// The text of `states.csv`: one row for each time in which a machine was in a state, machine by machine.
#[must_use]
pub fn states_csv(states: &[StatePeriod]) -> String {
    let mut text = String::from("machine,state,start_s,end_s\n");
    for StatePeriod { machine, state, time_s: [start, end] } in states {
        text += &format!("{},{},{start:.4},{end:.4}\n", csv_cell(machine), csv_cell(state));
    }
    text
}

/// A name as a cell of a CSV file, in quotes if it has a comma, a quote or a line break.
pub(crate) fn csv_cell(name: &str) -> Cow<'_, str> {
    let name = guarded(name);
    if name.contains([',', '"', '\n', '\r']) { Cow::Owned(format!("\"{}\"", name.replace('"', "\"\""))) } else { name }
}
