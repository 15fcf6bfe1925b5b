//! Finds the loads in a force table by the names of its columns.
//!
//! A load is a force, a point and a moment of three columns each, whose names differ in one word: `ground_force_vx`,
//! `ground_force_px`, `ground_torque_x`; `ground_force_2_vx`, `ground_force_2_px`, `ground_force_2_mx`;
//! `1_ground_force_vx`; `R_ground_force_vx`. Without these words, a name holds what belongs to this load alone: a
//! number, a side in any spelling, or nothing. This may also follow the axis, as in `ground_force_vx_r` and `Fx1`.
//! Pinned by: ambulo-cli/tests/plates.rs

use crate::model::Side;
use ambulo_formats::external_loads::ExternalForce;
use ambulo_formats::table::Table;

/// The columns of one load.
#[derive(Debug, Clone, PartialEq)]
pub struct LoadColumns {
    /// The part of the names that only this load has: a number, a side, or nothing.
    pub key: String,
    /// The side that the names state.
    pub side: Option<Side>,
    /// The beginning of the names of the force, for messages.
    pub prefix: String,
    pub force: String,
    pub point: Option<String>,
    pub moment: Option<String>,
}

/// The quantity of three columns.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Force,
    Point,
    Moment,
}

/// Words that belong to no load in particular.
const COMMON_WORDS: [&str; 22] = [
    "ground",
    "reaction",
    "force",
    "forces",
    "torque",
    "torques",
    "moment",
    "moments",
    "free",
    "grf",
    "grm",
    "cop",
    "center",
    "centre",
    "of",
    "pressure",
    "point",
    "plate",
    "fp",
    "foot",
    "position",
    "application",
];
const MOMENT_WORDS: [&str; 6] = ["torque", "torques", "moment", "moments", "free", "grm"];
const POINT_WORDS: [&str; 5] = ["cop", "point", "pressure", "position", "application"];

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

/// The table with the axis at the end of each name: the number or side of a load may follow the axis, as in
/// `ground_force_vx_r` or `Fx1`, and is put before the name. `None` if no name has such a part.
pub fn with_axis_last(table: &Table) -> Option<Table> {
    let (names, columns): (Vec<&str>, Vec<&[f64]>) = table.columns().unzip();
    let has = |name: &str| names.contains(&name);
    let mut renamed: Vec<String> = names.iter().map(|name| (*name).to_owned()).collect();
    for name in &names {
        let places = name.char_indices().rev().filter(|(_, letter)| letter.eq_ignore_ascii_case(&'x'));
        let of_axes = places.map(|(at, letter)| {
            ["x", "y", "z"]
                .map(|axis| {
                    let axis = if letter.is_uppercase() { axis.to_uppercase() } else { axis.to_owned() };
                    format!("{}{axis}{}", &name[..at], &name[at + 1..])
                })
                .map(|whole| (whole, at))
        });
        let Some(vector) = of_axes.into_iter().find(|axes| axes.iter().all(|(whole, _)| has(whole))) else { continue };
        for (whole, at) in &vector {
            let Some(index) = names.iter().position(|name| name == whole) else { continue };
            let after = whole[at + 1..].trim_matches(|c: char| !c.is_alphanumeric());
            let before = if after.is_empty() { String::new() } else { format!("{after}_") };
            renamed[index] = format!("{before}{}{}", &whole[..*at], whole[*at..=*at].to_lowercase());
        }
    }
    let is_new = renamed.iter().zip(&names).any(|(new, old)| new != old);
    let columns = renamed.into_iter().zip(columns).map(|(name, column)| (name, column.to_vec())).collect();
    is_new.then(|| Table::new("ground forces", columns).ok()).flatten()
}

/// The loads of a table, in the order of their forces. A load needs a force, and a point or a moment; one whose names
/// are a single letter with its number or side, such as `F1x`, needs a point.
pub fn load_columns(table: &Table) -> Vec<LoadColumns> {
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
    loads.filter(|load| load.point.is_some() || load.moment.is_some() && !is_bare(&words(&load.force))).collect()
}

/// Kind and key of the columns `<stem>x`, `<stem>y`, `<stem>z`; `None` if they are no part of a load.
fn meaning(stem: &str) -> Option<(Kind, String)> {
    let mut words = words(stem);
    let is_any = |words: &[String], of: &[&str]| words.iter().any(|word| of.contains(&word.as_str()));
    let bare = is_bare(&words);
    if !is_any(&words, &COMMON_WORDS) && !bare {
        return None;
    }
    let letter = |word: &String| match word.as_str() {
        "v" | "f" => Some(Kind::Force),
        "p" => Some(Kind::Point),
        "m" | "t" => Some(Kind::Moment),
        _ => None,
    };
    let place = if bare { words.iter().position(|word| letter(word).is_some()) } else { words.len().checked_sub(1) };
    let by_letter = place.and_then(|place| Some((place, letter(words.get(place)?)?)));
    let kind = match by_letter {
        Some((place, kind)) => {
            words.remove(place);
            kind
        }
        None if is_any(&words, &MOMENT_WORDS) => Kind::Moment,
        None if is_any(&words, &POINT_WORDS) => Kind::Point,
        None => Kind::Force,
    };
    words.retain(|word| !COMMON_WORDS.contains(&word.as_str()));
    Some((kind, words.join("_")))
}

/// Whether a name is a letter for its quantity, with nothing but a number or a side: `F1`, `r_P`.
fn is_bare(words: &[String]) -> bool {
    let is_letter = |word: &&String| ["f", "p", "m", "t"].contains(&word.as_str());
    let is_key = |word: &String| word.parse::<u32>().is_ok() || side(word).is_some();
    words.iter().filter(is_letter).count() == 1 && words.iter().all(|word| is_letter(&word) || is_key(word))
}

/// The words of a name in lower case: parts between other signs than letters and digits, between letters and digits,
/// and in camel case.
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
