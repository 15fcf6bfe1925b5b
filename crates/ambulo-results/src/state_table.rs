//! The states of the machines of a gait, as rows of `states.csv`.

use crate::sound::is_sound;
use ambulo::gait::machine::StatePeriod;
use ambulo_formats::table::{guarded, unguarded};
use std::borrow::Cow;

/// First line.
pub const HEAD: &str = "machine,state,start_s,end_s";

/// The text of `states.csv`: one row for each time in which a machine was in a state, machine by machine.
#[must_use]
pub fn states_csv(states: &[StatePeriod]) -> String {
    let mut text = format!("{HEAD}\n");
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

/// Reads the text that [`states_csv`] writes.
pub fn read(text: &str) -> Result<Vec<StatePeriod>, String> {
    let mut records = records(text).into_iter();
    let head = records.next().map_or_else(String::new, |(_, cells)| cells.join(","));
    if head != HEAD {
        return Err(format!("line 1: found `{head}`; expected `{HEAD}`"));
    }
    let period = |(line, cells): (usize, Vec<String>)| {
        period(&cells).ok_or_else(|| {
            let found = cells.join(",");
            format!(
                "line {line}: found `{found}`; expected {HEAD}: two names, and a start that is not after the end [s]"
            )
        })
    };
    records.map(period).collect()
}

fn period(cells: &[String]) -> Option<StatePeriod> {
    let [machine, state, start, end] = cells else { return None };
    let time_s = [start.parse().ok()?, end.parse().ok()?];
    let name = |cell: &String| unguarded(cell).to_owned();
    (time_s.iter().all(|time| is_sound(*time)) && time_s[0] <= time_s[1]).then(|| StatePeriod {
        machine: name(machine),
        state: name(state),
        time_s,
    })
}

/// The cells of each record, and the number of its first line. Cells in quotes may have commas and line breaks.
fn records(text: &str) -> Vec<(usize, Vec<String>)> {
    let (mut all, mut cells, mut cell) = (Vec::new(), Vec::new(), String::new());
    let (mut line, mut first, mut quoted) = (1, 1, false);
    let mut characters = text.chars().peekable();
    while let Some(character) = characters.next() {
        line += usize::from(character == '\n');
        match character {
            '"' if quoted && characters.peek() == Some(&'"') => cell.extend(characters.next()),
            '"' => quoted = !quoted,
            ',' if !quoted => cells.push(std::mem::take(&mut cell)),
            '\n' if !quoted => {
                cells.push(std::mem::take(&mut cell));
                all.push((first, std::mem::take(&mut cells)));
                first = line;
            }
            '\r' if !quoted => {}
            _ => cell.push(character),
        }
    }
    if !cell.is_empty() || !cells.is_empty() {
        cells.push(cell);
        all.push((first, cells));
    }
    all
}
