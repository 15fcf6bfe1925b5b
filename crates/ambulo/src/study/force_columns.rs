//! Finds the loads in a force table by the names of its columns.
//!
//! A load is a force, a point and a moment of three columns each, whose names differ in one word: `ground_force_vx`, `ground_force_px`,
//! `ground_torque_x`; `ground_force_2_vx`, `ground_force_2_px`, `ground_force_2_mx`; `1_ground_force_vx`; `R_ground_force_vx`. Without these
//! words, a name holds what belongs to this load alone: a number, a side in any spelling, or nothing.
//! Pinned by: ambulo-cli/tests/plates.rs

use crate::model::Side;
use ambulo_formats::external_loads::ExternalForce;
use ambulo_formats::table::Table;

/// The columns of one load.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct LoadColumns {
    /// The part of the names that only this load has: a number, a side, or nothing.
    pub(super) key: String,
    /// The side that the names state.
    pub(super) side: Option<Side>,
    /// The beginning of the names of the force, for messages.
    pub(super) prefix: String,
    force: String,
    point: Option<String>,
    moment: Option<String>,
}

/// The quantity of three columns.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Force,
    Point,
    Moment,
}

/// Words that belong to no load in particular.
const COMMON_WORDS: [&str; 14] = [
    "ground", "reaction", "force", "forces", "torque", "torques", "moment", "moments", "grf", "cop", "point", "plate",
    "fp", "foot",
];

impl LoadColumns {
    /// The load on a body.
    pub(super) fn on_body(&self, body: &str) -> ExternalForce {
        let name = self.side.map_or_else(|| self.prefix.clone(), |side| side.to_string());
        ExternalForce {
            force_identifier: Some(self.force.clone()),
            point_identifier: self.point.clone(),
            torque_identifier: self.moment.clone(),
            ..ExternalForce::with_prefix(&name, body, &self.prefix)
        }
    }
}

/// The loads of a table, in the order of their forces. A load needs a force, and a point or a moment.
pub(super) fn load_columns(table: &Table) -> Vec<LoadColumns> {
    let stems = table.names().iter().skip(1).filter_map(|name| name.strip_suffix('x'));
    let is_vector = |stem: &&str| ["y", "z"].iter().all(|axis| table.column(&format!("{stem}{axis}")).is_some());
    let found: Vec<(&str, Kind, String)> = stems
        .filter(is_vector)
        .filter_map(|stem| {
            let (kind, key) = meaning(stem)?;
            Some((stem, kind, key))
        })
        .collect();
    let other = |wanted: Kind, key: &str| {
        found.iter().find(|(_, kind, own)| *kind == wanted && own == key).map(|(stem, ..)| (*stem).to_owned())
    };
    let forces = found.iter().filter(|(_, kind, _)| *kind == Kind::Force);
    let loads = forces.map(|(stem, _, key)| LoadColumns {
        side: side(key),
        prefix: stem.trim_end_matches(['v', 'f']).to_owned(),
        force: (*stem).to_owned(),
        point: other(Kind::Point, key),
        moment: other(Kind::Moment, key),
        key: key.clone(),
    });
    loads.filter(|load| load.point.is_some() || load.moment.is_some()).collect()
}

/// Kind and key of the columns `<stem>x`, `<stem>y`, `<stem>z`; `None` if they are no part of a load.
fn meaning(stem: &str) -> Option<(Kind, String)> {
    let mut words = words(stem);
    let is_any = |words: &[String], of: &[&str]| words.iter().any(|word| of.contains(&word.as_str()));
    if !is_any(&words, &COMMON_WORDS) {
        return None;
    }
    let by_letter = match words.last().map(String::as_str) {
        Some("v" | "f") => Some(Kind::Force),
        Some("p") => Some(Kind::Point),
        Some("m" | "t") => Some(Kind::Moment),
        _ => None,
    };
    let kind = match by_letter {
        Some(kind) => {
            words.pop();
            kind
        }
        None if is_any(&words, &["torque", "torques", "moment", "moments"]) => Kind::Moment,
        None if is_any(&words, &["cop", "point"]) => Kind::Point,
        None => Kind::Force,
    };
    words.retain(|word| !COMMON_WORDS.contains(&word.as_str()));
    Some((kind, words.join("_")))
}

/// The words of a name in lower case: parts between other signs than letters and digits, between letters and digits, and in camel case.
fn words(name: &str) -> Vec<String> {
    let mut words = vec![String::new()];
    let mut last = ' ';
    for c in name.replace("CoP", "COP").chars() {
        let begins = last.is_ascii_digit() != c.is_ascii_digit() || last.is_lowercase() && c.is_uppercase();
        if !c.is_alphanumeric() || begins {
            words.push(String::new());
        }
        if let (true, Some(word)) = (c.is_alphanumeric(), words.last_mut()) {
            word.extend(c.to_lowercase());
        }
        last = c;
    }
    words.retain(|word| !word.is_empty());
    words
}

fn side(key: &str) -> Option<Side> {
    let is = |names: [&str; 2]| key.split('_').any(|word| names.contains(&word));
    match (is(["r", "right"]), is(["l", "left"])) {
        (true, false) => Some(Side::Right),
        (false, true) => Some(Side::Left),
        _ => None,
    }
}
