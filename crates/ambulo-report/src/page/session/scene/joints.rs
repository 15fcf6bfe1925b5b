//! Panels of the joint coordinates of a scene, and of the moments and forces of drives, springs and limits, over time.

use super::instants::Instants;
use crate::page::block::Block;
use crate::page::contract::{Group, Origin, Panel, Role, Trace};
use crate::page::session::quality::over_time;
use crate::page::session::sides;
use crate::stage::csv_rows::Row;
use ambulo::model::Side;
use ambulo_results::{Folder, JOINTS, ResultsError};
use std::collections::BTreeMap;

const HEAD: &str = "time,joint,coordinate,value,rate,effort,unit";
/// Maximum number of panels in a group.
const MOST_PANELS: usize = 60;

/// One coordinate of a joint.
#[derive(Default)]
struct Coordinate {
    /// Position in the order of the file.
    order: usize,
    turns: bool,
    values: Vec<(f64, f64)>,
    efforts: Vec<(f64, f64)>,
}

/// Groups of angles and distances, and of efforts; empty without the file.
pub(super) fn groups(
    folder: &Folder<'_>,
    instants: &Instants,
    block: &mut Block,
    missing: &mut Vec<String>,
) -> Result<Vec<Group>, ResultsError> {
    let Some(text) = folder.text(JOINTS)? else { return Ok(Vec::new()) };
    let coordinates = coordinates(folder, &text)?;
    let mut panels: Vec<Vec<&(String, Coordinate)>> = Vec::new();
    for entry in &coordinates {
        match panels.iter_mut().find(|panel| panel.first().is_some_and(|first| pairs(&first.0, &entry.0))) {
            Some(panel) => panel.push(entry),
            None => panels.push(vec![entry]),
        }
    }
    if panels.len() > MOST_PANELS {
        let left = panels.len() - MOST_PANELS;
        missing.push(format!("The curves of {left} more joint coordinates are only in {JOINTS}."));
        panels.truncate(MOST_PANELS);
    }
    let mut grid = |id: &str, title: &str, note: &str, what: What| Group {
        id: id.to_owned(),
        title: title.to_owned(),
        note: Some(note.to_owned()),
        columns: 3,
        panels: panels.iter().enumerate().map(|(i, entries)| panel(i, entries, what, instants, block)).collect(),
    };
    let efforts = "Sum of drive, motor, spring, damper, limit and friction of a coordinate, acting on the child body.";
    Ok(vec![
        grid("joints", "Joint angles and distances", "With the signs of the joint.", What::Value),
        grid("efforts", "Joint moments and forces", efforts, What::Effort),
    ])
}

#[derive(Clone, Copy, PartialEq)]
enum What {
    Value,
    Effort,
}

fn coordinates(folder: &Folder<'_>, text: &str) -> Result<Vec<(String, Coordinate)>, ResultsError> {
    let mut found: BTreeMap<String, Coordinate> = BTreeMap::new();
    for row in Row::all(folder, JOINTS, text, HEAD)? {
        let [time] = row.numbers(0)?;
        let name = format!("{} {}", row.word(1)?, row.word(2)?);
        let count = found.len();
        let entry = found.entry(name).or_insert_with(|| Coordinate { order: count, ..Coordinate::default() });
        entry.turns = row.word(6)? == "N.m";
        entry.values.push((time, row.numbers::<1>(3)?[0]));
        entry.efforts.push((time, row.number_or_gap(5)?));
    }
    let mut list: Vec<(String, Coordinate)> = found.into_iter().collect();
    list.sort_by_key(|(_, coordinate)| coordinate.order);
    Ok(list)
}

/// The joint in a name, which precedes its coordinate.
fn joint(name: &str) -> &str {
    name.rsplit_once(' ').map_or(name, |(joint, _)| joint)
}

/// Whether two names belong to the same joint on the two sides.
fn pairs(a: &str, b: &str) -> bool {
    let ends = |name: &str| name.rsplit_once(' ').map(|(_, coordinate)| coordinate.to_owned());
    match (Side::split_name(joint(a)), Side::split_name(joint(b))) {
        (Some((first, stem)), Some((second, other))) => first != second && stem == other && ends(a) == ends(b),
        _ => false,
    }
}

fn panel(
    number: usize,
    entries: &[&(String, Coordinate)],
    what: What,
    instants: &Instants,
    block: &mut Block,
) -> Panel {
    let traces: Vec<Trace> =
        entries.iter().map(|(name, coordinate)| trace(name, coordinate, what, instants, block)).collect();
    let turns = entries.first().is_some_and(|(_, coordinate)| coordinate.turns);
    let (stem, unit) = match (what, turns) {
        (What::Value, true) => ("joint", "deg"),
        (What::Value, false) => ("joint", "m"),
        (What::Effort, true) => ("effort", "N.m"),
        (What::Effort, false) => ("effort", "N"),
    };
    let name = entries.first().map_or("", |(name, _)| name.as_str());
    let title = match Side::split_name(joint(name)).filter(|_| entries.len() > 1) {
        Some((_, stem)) => stem,
        None if name.ends_with(" angle") => joint(name).to_owned(),
        None => name.to_owned(),
    };
    over_time([&format!("{stem}_{}", number + 1), &title, unit], ["", ""], traces)
}

fn trace(name: &str, coordinate: &Coordinate, what: What, instants: &Instants, block: &mut Block) -> Trace {
    let (rows, column) = match what {
        What::Value => (&coordinate.values, "value"),
        What::Effort => (&coordinate.efforts, "effort"),
    };
    let factor = if what == What::Value && coordinate.turns { 1.0_f64.to_degrees() } else { 1.0 };
    let shown: Vec<f64> = instants.nearest(rows).iter().map(|x| factor * x).collect();
    let side = Side::of_name(joint(name));
    Trace {
        name: side.map_or_else(|| name.to_owned(), |side| side.to_string()),
        side: side.map(sides::page),
        role: Role::Main,
        values: block.add(&shown),
        sd: None,
        predicted: Vec::new(),
        origin: Some(Origin { file: JOINTS.to_owned(), column: format!("{column} of {name}"), factor }),
    }
}
