//! Lists the states of a machine as rows and as a table of text, with their windows, angles and transitions.

use super::definition::{Machine, Span, State};
use super::state_trace::StateChange;
use super::walking_machine;
use crate::gait::walk::Walk;
use std::fmt::Write;

/// A state of one machine of a tree.
#[derive(Debug, Clone, PartialEq)]
pub struct StateRow {
    /// Depth of the machine in the tree; 0 for the root.
    pub depth: usize,
    /// Name of the machine.
    pub machine: String,
    /// Name of the state.
    pub state: String,
    /// The time in which it is active, and the angles at both ends.
    pub span: Option<Span>,
    /// Transitions from it: condition and name of the next state.
    pub leads: Vec<(String, String)>,
}

/// All states of a tree of machines, parents before children.
#[must_use]
pub fn state_rows(machine: &Machine) -> Vec<StateRow> {
    let mut rows = Vec::new();
    collect(machine, 0, &mut rows);
    rows
}

fn collect(machine: &Machine, depth: usize, rows: &mut Vec<StateRow>) {
    for (k, state) in machine.states().iter().enumerate() {
        let transitions = machine.transitions().iter().filter(|transition| transition.from == k);
        let leads = transitions
            .map(|transition| (transition.when.clone(), machine.states()[transition.to].name.clone()))
            .collect();
        let State { name, span, .. } = state.clone();
        rows.push(StateRow { depth, machine: machine.name().to_owned(), state: name, span, leads });
    }
    for child in machine.children() {
        collect(child, depth + 1, rows);
    }
}

/// The state machine of a walk as text: windows in percent of the cycle of the machine's foot, angles in degrees, at
/// the initial speed of the walk.
#[must_use]
pub fn state_table(walk: &Walk) -> String {
    let mut text = format!(
        "{}, style {}: {:.2} m/s on a leg of {:.2} m (V* {:.3}), steps of {:.3} m, cycle {:.3} s, foot off at {:.1} \
         %\n\n",
        walk.name(),
        walk.style().name(),
        walk.speed(),
        walk.leg_length(),
        walk.dimensionless_speed(),
        walk.step_length(),
        walk.cycle_s(),
        100.0 * walk.foot_off(&walk.clock(0.0)),
    );
    let header = ["machine", "state", "from %", "to %", "from deg", "to deg", "leads to, when"].map(String::from);
    let mut rows = vec![header];
    let mut machine = String::new();
    for row in state_rows(&walking_machine(walk)) {
        rows.push(cells(&row, row.machine != machine));
        machine = row.machine;
    }
    text.push_str(&aligned(&rows, 2..6));
    text
}

/// Writes changes of states as lines of a table, one at a time: its columns are as wide as the names of the walk's
/// machines and states, so a line does not wait for later ones.
#[derive(Debug, Clone)]
pub struct ChangeTable {
    /// Widths of the columns of machines and states.
    widths: [usize; 2],
}

impl ChangeTable {
    /// The table of a walk.
    #[must_use]
    pub fn of(walk: &Walk) -> ChangeTable {
        let rows = state_rows(&walking_machine(walk));
        let widest = |name: fn(&StateRow) -> &str| rows.iter().map(|row| name(row).chars().count()).max().unwrap_or(0);
        ChangeTable { widths: [widest(|row| &row.machine), widest(|row| &row.state)] }
    }

    /// The line above the changes.
    #[must_use]
    pub fn header(&self) -> String {
        self.line(["time s", "machine", "from", "to", "because"])
    }

    /// The line of a change; the first one of each machine has the state in which it starts.
    #[must_use]
    pub fn row(&self, StateChange { time_s, machine, from, to, when }: &StateChange) -> String {
        let because = if from.is_none() { "the results begin" } else { when };
        self.line([&format!("{time_s:.3}"), machine, from.as_deref().unwrap_or("-"), to, because])
    }

    fn line(&self, [time, machine, from, to, because]: [&str; 5]) -> String {
        let [machines, states] = self.widths;
        format!("{time:>7}  {machine:<machines$}  {from:<states$}  {to:<states$}  {because}").trim_end().to_owned()
    }
}

/// Rows of text as aligned columns; columns of numbers are right-aligned.
fn aligned<const N: usize>(rows: &[[String; N]], numeric: std::ops::Range<usize>) -> String {
    let width = |column: usize| rows.iter().map(|row| row[column].chars().count()).max().unwrap_or(0);
    let widths: [usize; N] = std::array::from_fn(width);
    let mut text = String::new();
    for row in rows {
        let mut line = String::new();
        for (column, cell) in row.iter().enumerate() {
            let width = widths[column];
            // Writing to a string cannot fail.
            let _ = if numeric.contains(&column) {
                write!(line, "{cell:>width$}  ")
            } else {
                write!(line, "{cell:<width$}  ")
            };
        }
        text.push_str(line.trim_end());
        text.push('\n');
    }
    text
}

fn cells(row: &StateRow, first: bool) -> [String; 7] {
    let machine = if first { format!("{}{}", "  ".repeat(row.depth), row.machine) } else { String::new() };
    let [from, to] = match row.span {
        Some(span) => percents(span.window).map(|percent| format!("{percent:.1}")),
        None => Default::default(),
    };
    let [low, high] = match row.span.and_then(|span| span.bounds) {
        Some(bounds) => bounds.map(|angle| format!("{:.1}", angle.to_degrees())),
        None => Default::default(),
    };
    let leads: Vec<String> = row.leads.iter().map(|(when, to)| format!("{to}, {when}")).collect();
    [machine, row.state.clone(), from, to, low, high, leads.join("; ")]
}

/// A window in percent of the cycle, with a start below 100.
fn percents([from, to]: [f64; 2]) -> [f64; 2] {
    let [from, to] = [from, to].map(|phase| 100.0 * (phase - phase.floor()));
    // The end of a cycle is 100 %, not 0 %.
    [from, if to <= 0.0 { 100.0 } else { to }]
}
