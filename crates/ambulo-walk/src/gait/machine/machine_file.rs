//! Reads `[[machine]]` tables of a gait file (docs/GAITS.md, docs/MACHINES.md).

use super::authored::REST;
use super::condition::Condition;
use super::settings::{Activity, Driven, MachineSettings, PASSAGE_S, StateSettings, TransitionSettings};
use super::walking_machine;
use crate::gait::curve_table::read_knots;
use crate::gait::gait_settings::Gait;
use crate::gait::joint::WalkPart;
use crate::gait::pace_plan::PaceChange;
use crate::gait::walk::Walk;
use crate::numerics::NaturalSpline;
use crate::toml_reader::{Table, TomlError, Value, nearest};
use std::collections::BTreeSet;
use std::sync::Arc;

/// Reads a column of a recording as an angle [rad] against time [s]. The arguments are the file and the column as the
/// gait file names them.
pub(crate) type ReadColumn<'a> = dyn FnMut(&str, &str) -> Result<NaturalSpline, String> + 'a;

const DEGREE: f64 = std::f64::consts::PI / 180.0;
/// Durations of sub-cycles and passages [s].
const WITHIN_S: [f64; 2] = [0.01, 60.0];
/// More would be a typing error, and names are searched in every step.
const MOST_MACHINES: usize = 100;
/// A leg length for which the names of the machine of a walk are listed [m].
const ANY_LEG_M: f64 = 0.9;
const ACTIVITIES: [&str; 7] = ["walk", "sub_cycle", "constant", "curve", "recording", "pace", "wait"];

/// The machines of a gait file.
pub(in crate::gait) fn read_machines(
    root: &Table<'_>,
    gait: &Gait,
    load: &mut ReadColumn<'_>,
) -> Result<Vec<MachineSettings>, TomlError> {
    let tables = root.tables("machine")?;
    if let Some(table) = tables.get(MOST_MACHINES) {
        return Err(table.wrong(format!("found more than {MOST_MACHINES} machines; expected at most that many")));
    }
    let mut machines: Vec<MachineSettings> = Vec::new();
    let taken = names_of_the_walk(gait);
    for table in &tables {
        let machine = read_machine(table, load)?;
        if taken.contains(&machine.name) || machines.iter().any(|other| other.name == machine.name) {
            return Err(table.need("name", "the name of the machine")?.wrong("a name that no other machine has"));
        }
        let same = |other: &MachineSettings| other.drives == machine.drives && machine.drives != Driven::Nothing;
        if let (Some(other), Some(value)) = (machines.iter().find(|other| same(other)), table.get("drives")) {
            let expected = format!("something that no other machine drives; the machine `{}` does", other.name);
            return Err(value.wrong(&expected));
        }
        machines.push(machine);
    }
    let known = taken.into_iter().chain(machines.iter().map(|machine| machine.name.clone())).collect();
    for (table, machine) in tables.iter().zip(&machines) {
        check_names(table, machine, &known, &machines)?;
    }
    Ok(machines)
}

/// Names of the machines of the walk itself.
fn names_of_the_walk(gait: &Gait) -> BTreeSet<String> {
    fn collect(machine: &super::Machine, names: &mut BTreeSet<String>) {
        names.insert(machine.name().to_owned());
        machine.children().iter().for_each(|child| collect(child, names));
    }
    let mut names = BTreeSet::new();
    if let Ok(walk) =
        Walk::new(&Gait { pace_changes: Vec::new(), ..Gait::new("", gait.style) }, ANY_LEG_M, &mut Default::default())
    {
        collect(&walking_machine(&walk), &mut names);
    }
    names
}

fn read_machine(table: &Table<'_>, load: &mut ReadColumn<'_>) -> Result<MachineSettings, TomlError> {
    table.only(&[&["name", "drives", "during", "resumes", "state", "transition"]])?;
    let drives = table.get("drives").map_or(Ok(Driven::Nothing), |value| driven(&value))?;
    let during = match table.get("during") {
        Some(value) => {
            let during = value.table("a table { machine = \"..\", state = \"..\" }")?;
            during.only(&[&["machine", "state"]])?;
            let name = |key: &str, meaning: &str| during.need(key, meaning)?.filled_text();
            Some((name("machine", "the name of a machine")?, name("state", "the name of its state")?))
        }
        None => None,
    };
    let mut states: Vec<StateSettings> = Vec::new();
    let tables = table.tables("state")?;
    for entry in &tables {
        let state = read_state(entry, &drives, load)?;
        let value = entry.need("name", "the name of the state")?;
        if state.name == REST || state.name == "done" {
            return Err(value.wrong("another name, because this one has a special meaning"));
        }
        if states.iter().any(|other| other.name == state.name) {
            return Err(value.wrong("a name that no other state of this machine has"));
        }
        states.push(state);
    }
    if states.is_empty() {
        const EXPECTED: &str = "at least one state, under the header [[machine.state]]";
        return Err(table.get("state").map_or_else(|| table.missing("state", EXPECTED), |value| value.wrong(EXPECTED)));
    }
    let transitions = table.tables("transition")?;
    let transitions = transitions.iter().map(|entry| read_transition(entry, &states));
    Ok(MachineSettings {
        name: table.need("name", "the name of the machine")?.filled_text()?,
        drives,
        during,
        resumes: table.truth_or("resumes", false)?,
        transitions: transitions.collect::<Result<_, _>>()?,
        states,
    })
}

fn driven(value: &Value<'_>) -> Result<Driven, TomlError> {
    let name = value.filled_text()?;
    if name == "pace" {
        return Ok(Driven::Pace);
    }
    if let Some(part) = WalkPart::ALL.into_iter().find(|part| part.name() == name) {
        return Ok(Driven::Part(part));
    }
    // Coordinates of models have no spaces. The coordinates of the figure are checked later, when it walks.
    let is_coordinate = !name.contains(' ') && name.contains('_');
    if is_coordinate && !crate::gait::COORDINATE_NAMES.contains(&name.as_str()) {
        return Ok(Driven::Coordinate(name));
    }
    let names = || WalkPart::ALL.iter().map(|part| part.name()).chain(["pace"]);
    let list = names().map(|name| format!("\"{name}\"")).collect::<Vec<_>>().join(", ");
    let error = value.wrong(&format!("{list}, or a coordinate of the model that the gait does not move"));
    Err(match nearest(&name, names()) {
        Some(near) => error.hint(&format!("did you mean \"{near}\"?")),
        None => error,
    })
}

/// Keys of every state.
const STATE_KEYS: &[&str] = &["name", "activity", "done"];

fn read_state(table: &Table<'_>, drives: &Driven, load: &mut ReadColumn<'_>) -> Result<StateSettings, TomlError> {
    let word = activity_word(table, drives)?;
    Ok(StateSettings {
        activity: read_activity(table, word, drives, load)?,
        name: table.need("name", "the name of the state")?.filled_text()?,
        done: table.truth_or("done", false)?,
    })
}

/// The word of an activity that fits what the machine drives.
fn activity_word(table: &Table<'_>, drives: &Driven) -> Result<&'static str, TomlError> {
    let value = table.get("activity");
    let default = if drives.moves_a_joint() { "walk" } else { "wait" };
    let word = match &value {
        Some(value) => value.choice(&ACTIVITIES.map(|word| (word, word)))?,
        None => default,
    };
    let (fits, allowed) = match drives {
        Driven::Part(_) => {
            (!matches!(word, "pace" | "wait"), "an activity of a joint: walk, sub_cycle, constant, curve or recording")
        }
        Driven::Coordinate(_) => (
            !matches!(word, "walk" | "pace" | "wait"),
            "an activity of a coordinate: sub_cycle, constant, curve or recording",
        ),
        Driven::Pace => (matches!(word, "pace" | "wait"), "an activity of the pace: pace or wait"),
        Driven::Nothing => (word == "wait", "wait, because this machine drives nothing"),
    };
    match value {
        _ if fits => Ok(word),
        Some(value) => Err(value.wrong(allowed)),
        None => Err(table.missing("activity", allowed)),
    }
}

fn read_activity(
    table: &Table<'_>,
    word: &str,
    drives: &Driven,
    load: &mut ReadColumn<'_>,
) -> Result<Activity, TomlError> {
    let only = |keys: &[&str]| table.only(&[STATE_KEYS, keys]);
    Ok(match word {
        "walk" => {
            only(&["scale", "angle_deg", "time_percent"])?;
            Activity::Walk {
                scale: bounded(table, "scale", 1.0, [-10.0, 10.0])?,
                angle: bounded(table, "angle_deg", 0.0, [-180.0, 180.0])? * DEGREE,
                phase: -bounded(table, "time_percent", 0.0, [-100.0, 100.0])? * 0.01,
            }
        }
        "sub_cycle" => {
            only(&["to_deg", "within"])?;
            let within_s =
                within(table)?.ok_or_else(|| table.missing("within", "the duration of the sub-cycle [s]"))?;
            Activity::SubCycle { to: angle(table, "to_deg", drives)?, within_s }
        }
        "constant" => {
            only(&["angle_deg"])?;
            Activity::SubCycle { to: angle(table, "angle_deg", drives)?, within_s: PASSAGE_S }
        }
        "curve" => {
            only(&["knot"])?;
            Activity::Curve(read_knots(table, limits(drives))?)
        }
        "recording" => {
            only(&["file", "column", "from"])?;
            read_recording(table, load)?
        }
        "pace" => {
            only(&["speed", "step_length", "cadence", "within"])?;
            Activity::Pace(PaceChange::read_values(table, 0.0)?)
        }
        _ => {
            only(&[])?;
            Activity::Wait
        }
    })
}

fn read_recording(table: &Table<'_>, load: &mut ReadColumn<'_>) -> Result<Activity, TomlError> {
    let file = table.need("file", "a recording")?;
    let column = table.need("column", "the column of the recording")?.filled_text()?;
    let values = load(&file.filled_text()?, &column).map_err(|message| file.place().error(message))?;
    let (first, last) = (values.times()[0], values.times()[values.times().len() - 1]);
    let from_s = table.number_or("from", first)?;
    match table.get("from") {
        Some(value) if !(first..=last).contains(&from_s) => {
            Err(value.wrong(&format!("a time of the recording, {first} to {last} s")))
        }
        _ => Ok(Activity::Recording { values: Arc::new(values), from_s }),
    }
}

/// Accepted angles [rad].
fn limits(drives: &Driven) -> [f64; 2] {
    match drives {
        Driven::Part(part) => part.plausible(),
        _ => [-std::f64::consts::PI, std::f64::consts::PI],
    }
}

fn angle(table: &Table<'_>, key: &str, drives: &Driven) -> Result<f64, TomlError> {
    let value = table.need(key, "an angle in degrees")?;
    let angle = value.number()? * DEGREE;
    let [low, high] = limits(drives);
    if (low..=high).contains(&angle) {
        return Ok(angle);
    }
    Err(value.wrong(&format!("an angle from {:.0} to {:.0} degrees", low / DEGREE, high / DEGREE)))
}

fn bounded(table: &Table<'_>, key: &str, default: f64, [low, high]: [f64; 2]) -> Result<f64, TomlError> {
    let Some(value) = table.get(key) else { return Ok(default) };
    let number = value.number()?;
    if (low..=high).contains(&number) {
        Ok(number)
    } else {
        Err(value.wrong(&format!("a number from {low} to {high}")))
    }
}

fn within(table: &Table<'_>) -> Result<Option<f64>, TomlError> {
    let Some(value) = table.get("within") else { return Ok(None) };
    let (within_s, [least, most]) = (value.number()?, WITHIN_S);
    if (least..=most).contains(&within_s) {
        return Ok(Some(within_s));
    }
    Err(value.wrong(&format!("a duration from {least} to {most} s")))
}

fn read_transition(table: &Table<'_>, states: &[StateSettings]) -> Result<TransitionSettings, TomlError> {
    table.only(&[&["from", "to", "when", "within"]])?;
    let words: Vec<(&str, usize)> = states.iter().enumerate().map(|(k, state)| (state.name.as_str(), k)).collect();
    let state = |key: &str, meaning: &str| table.need(key, meaning)?.choice(&words);
    let value = table.need("when", "the condition of the transition")?;
    let when = Condition::parse(&value.filled_text()?)
        .map_err(|error| value.place().error(error.to_string()).hint("docs/MACHINES.md lists the conditions"))?;
    Ok(TransitionSettings {
        from: state("from", "the state that is left")?,
        to: state("to", "the state that is entered")?,
        when,
        within_s: within(table)?.unwrap_or(PASSAGE_S),
    })
}

/// Machines and states in conditions and in `during` exist, and no machine waits for itself to run.
fn check_names(
    table: &Table<'_>,
    machine: &MachineSettings,
    known: &BTreeSet<String>,
    machines: &[MachineSettings],
) -> Result<(), TomlError> {
    let refuse = |value: &Value<'_>, name: &str, names: &mut dyn Iterator<Item = &str>| {
        let names: Vec<&str> = names.collect();
        let list = names.iter().map(|name| format!("'{name}'")).collect::<Vec<_>>().join(", ");
        let error = value.place().error(format!("found no `{name}`; expected one of {list}"));
        match nearest(name, names.into_iter()) {
            Some(near) => error.hint(&format!("did you mean '{near}'?")),
            None => error,
        }
    };
    let state_of = |value: &Value<'_>, name: &str, state: &str| {
        if !known.contains(name) {
            return Err(refuse(value, name, &mut known.iter().map(String::as_str)));
        }
        match machines.iter().find(|other| other.name == name) {
            Some(other) if !other.states.iter().any(|own| own.name == state) && state != REST => {
                Err(refuse(value, state, &mut other.states.iter().map(|own| own.name.as_str())))
            }
            _ => Ok(()),
        }
    };
    if let (Some((name, state)), Some(value)) = (&machine.during, table.get("during")) {
        state_of(&value, name, state)?;
        if *name == machine.name {
            return Err(value.wrong("another machine"));
        }
    }
    for (entry, transition) in table.tables("transition")?.iter().zip(&machine.transitions) {
        let value = entry.need("when", "the condition of the transition")?;
        let mut result = Ok(());
        transition.when.visit(&mut |condition| {
            let found = match condition {
                Condition::InState(name, state) => state_of(&value, name, state),
                Condition::Done(name) => state_of(&value, name, REST),
                _ => Ok(()),
            };
            if result.is_ok() {
                result = found;
            }
        });
        result?;
    }
    Ok(())
}
