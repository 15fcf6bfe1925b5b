//! Events in a scene file: closures are added and removed, joints are removed.

use super::SceneError;
use super::closure::ClosureEntry;
use super::joint::JointEntry;
use super::names::{Item, Names};
use crate::numerics::Order;
use crate::toml_reader::{Table, Value};

/// A change at one instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EventEntry {
    /// Line of its header.
    pub line: usize,
    /// Time [s], from zero to the duration.
    pub time_s: f64,
    /// The change.
    pub change: EventAction,
}

/// Change that an event makes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EventAction {
    /// A closure becomes active: index in [`SceneFile::closures`](super::SceneFile::closures).
    AddClosure(usize),
    /// A closure is removed: index in [`SceneFile::closures`](super::SceneFile::closures).
    RemoveClosure(usize),
    /// A joint is removed for good, and its child is free: index in [`SceneFile::joints`](super::SceneFile::joints).
    RemoveJoint(usize),
}

/// Reads all events in order of time; simultaneous events are in the order of the file.
pub(super) fn read_all(
    root: &Table<'_>,
    links: &Names,
    (joints, closures): (&[JointEntry], &[ClosureEntry]),
    duration_s: f64,
) -> Result<Vec<EventEntry>, SceneError> {
    let mut list = Vec::new();
    for table in root.tables("event")? {
        table.only(&[&["time", "add", "remove"]])?;
        let time_s = time(&table, duration_s)?;
        let (change, value) = change(&table, links)?;
        list.push((EventEntry { line: table.line, time_s, change }, value));
    }
    list.sort_by_number(|event| event.0.time_s);
    refuse_idle(&list, joints, closures)?;
    Ok(list.into_iter().map(|(event, _)| event).collect())
}

fn time(table: &Table<'_>, duration_s: f64) -> Result<f64, SceneError> {
    let value = table.need("time", "the instant [s]")?;
    let time_s = value.number()?;
    let inside = (0.0..=duration_s).contains(&time_s);
    if inside { Ok(time_s) } else { Err(value.wrong(&format!("an instant from 0 to {duration_s} s, the duration"))) }
}

fn change<'t>(table: &Table<'t>, links: &Names) -> Result<(EventAction, Value<'t>), SceneError> {
    let (value, adds) = match (table.get("add"), table.get("remove")) {
        (Some(value), None) => (value, true),
        (None, Some(value)) => (value, false),
        (Some(_), Some(value)) => return Err(value.wrong("either `add` or `remove`").hint("write two events")),
        (None, None) => return Err(table.missing("add", "`add` or `remove` with a name")),
    };
    let name = value.text()?;
    let change = match (links.find(name), adds) {
        (Some(Item::Closure(closure)), true) => EventAction::AddClosure(closure),
        (Some(Item::Closure(closure)), false) => EventAction::RemoveClosure(closure),
        (Some(Item::Joint(joint)), false) => EventAction::RemoveJoint(joint),
        (found, true) => return Err(links.unfit(&value, name, "a closure", found)),
        (found, false) => return Err(links.unfit(&value, name, "a closure or a joint", found)),
    };
    Ok((change, value))
}

/// Rejects adding an active closure, and removing an inactive closure or a removed joint.
fn refuse_idle(
    events: &[(EventEntry, Value<'_>)],
    joints: &[JointEntry],
    closures: &[ClosureEntry],
) -> Result<(), SceneError> {
    let mut closed: Vec<bool> = closures.iter().map(|closure| closure.active).collect();
    let mut jointed = vec![true; joints.len()];
    for (event, value) in events {
        let (there, after) = match event.change {
            EventAction::AddClosure(closure) => (&mut closed[closure], true),
            EventAction::RemoveClosure(closure) => (&mut closed[closure], false),
            EventAction::RemoveJoint(joint) => (&mut jointed[joint], false),
        };
        if *there == after && after {
            let error = value.wrong(&format!("a closure that is not active at {} s already", event.time_s));
            return Err(error.hint("with active = false a closure is inactive until an event adds it"));
        }
        if *there == after {
            return Err(value.wrong(&format!("a closure or joint that is active at {} s", event.time_s)));
        }
        *there = after;
    }
    Ok(())
}
