//! Reads marker sets from TOML files. Errors state line and key.
//!
//! ```toml
//! name = "my-laboratory"
//! title = "Marker set of my laboratory"
//!
//! [[pair]]                        # one on each side
//! right = ["RKNE", "R.Knee.Lat"]  # a name, or a list of names
//! left = ["LKNE", "L.Knee.Lat"]
//! landmark = "lateral_epicondyle"
//!
//! [[single]]                      # in the middle, or on one side only
//! names = "RBAK"
//! segment = "torso"               # a technical marker: a segment instead of a landmark
//! place = [-0.3, 0.7, 0.3]        # shares of the segment length; right side for pairs
//! weight = 0.5
//! ```

use super::{Landmark, MarkerDefinition, MarkerSet, Segment};
use crate::model::Side;
use crate::spatial::Vec3;
use crate::toml_reader::{Source, Table, TomlError, Value};
use std::collections::BTreeSet;

const DOCUMENT: &str = "docs/MARKERS.md";
const LARGEST_WEIGHT: f64 = 1000.0;

impl MarkerSet {
    /// Reads a set from a TOML file.
    ///
    /// # Errors
    /// Anything that does not follow docs/MARKERS.md, with line and key.
    pub fn from_toml(text: &str) -> Result<MarkerSet, TomlError> {
        let source = Source::new(text, DOCUMENT);
        let parsed = source.parse()?;
        let root = Table::root(&source, &parsed);
        root.only(&[&["name", "title", "pair", "single"]])?;
        let name = root.need("name", "the name of the set")?.filled_text()?;
        let title = root.get("title").map_or(Ok(name.clone()), |value| value.filled_text())?;
        let mut reading = Reading::default();
        for table in root.tables("pair")? {
            reading.pair(&table)?;
        }
        for table in root.tables("single")? {
            reading.single(&table)?;
        }
        if reading.markers.is_empty() {
            return Err(root.wrong("found no marker; expected tables [[pair]] or [[single]]"));
        }
        Ok(MarkerSet { name, title, markers: reading.markers })
    }
}

#[derive(Default)]
struct Reading {
    markers: Vec<MarkerDefinition>,
    names: BTreeSet<String>,
}

impl Reading {
    fn pair(&mut self, table: &Table<'_>) -> Result<(), TomlError> {
        table.only(&[&["right", "left", "landmark", "segment", "place", "weight"]])?;
        let right = self.names(table, "right", "the name on the right side")?;
        let left = self.names(table, "left", "the name on the left side")?;
        let common = common(table)?;
        for (side, names) in [(Side::Right, right), (Side::Left, left)] {
            let place = common.place.map(|p| if side == Side::Left { Vec3::new(p.x, p.y, -p.z) } else { p });
            self.markers.push(MarkerDefinition { names, side: Some(side), place, ..common.clone() });
        }
        Ok(())
    }

    fn single(&mut self, table: &Table<'_>) -> Result<(), TomlError> {
        table.only(&[&["names", "side", "landmark", "segment", "place", "weight"]])?;
        let names = self.names(table, "names", "the name of the marker")?;
        let common = common(table)?;
        let words = [("right", Some(Side::Right)), ("left", Some(Side::Left))];
        let side = table.get("side").map_or(Ok(None), |value| value.choice(&words))?;
        if side.is_none() && common.segment.is_paired() {
            return Err(table.missing("side", "the side of the limb, \"right\" or \"left\""));
        }
        let place = match (common.place, side) {
            // An explicit position is used as written; the position of a landmark is mirrored.
            (Some(p), Some(Side::Left)) if table.get("place").is_none() => Some(Vec3::new(p.x, p.y, -p.z)),
            (place, _) => place,
        };
        self.markers.push(MarkerDefinition { names, side, place, ..common });
        Ok(())
    }

    /// The names under a key: a text or a list of texts, without repetitions in the set.
    fn names(&mut self, table: &Table<'_>, key: &str, meaning: &str) -> Result<Vec<String>, TomlError> {
        let value = table.need(key, meaning)?;
        let values: Vec<Value<'_>> = match value.text() {
            Ok(_) => vec![value],
            Err(_) => value.list("a name or a list of names")?,
        };
        let mut names = Vec::new();
        for value in &values {
            let name = value.filled_text()?;
            if !self.names.insert(name.to_lowercase()) {
                return Err(value.wrong("a name that no other marker of the set has (case is ignored)"));
            }
            names.push(name);
        }
        if names.is_empty() {
            return Err(table.missing(key, meaning));
        }
        Ok(names)
    }
}

/// The keys of both kinds of tables, without names and side.
fn common(table: &Table<'_>) -> Result<MarkerDefinition, TomlError> {
    let landmarks: Vec<(&str, Landmark)> = Landmark::all().map(|l| (l.word(), l)).collect();
    let landmark = table.get("landmark").map(|value| value.choice(&landmarks)).transpose()?;
    let segment = match (landmark, table.get("segment")) {
        (Some(landmark), None) => landmark.segment(),
        (None, Some(value)) => value.choice(&Segment::WORDS)?,
        (Some(_), Some(value)) => {
            let message = "found both `landmark` and `segment`; expected one of them: a landmark defines its segment";
            return Err(value.place().error(message));
        }
        (None, None) => {
            return Err(table.missing("landmark", "the landmark of the marker (or `segment` for a technical marker)"));
        }
    };
    let own = table.get("place").map(|value| value.vector()).transpose()?;
    let usual = landmark.map_or_else(|| segment.technical_weight(), Landmark::weight);
    let weight = match table.get("weight") {
        Some(value) => {
            let weight = value.above_zero()?;
            if weight > LARGEST_WEIGHT {
                return Err(value.wrong("a weight of at most 1000"));
            }
            weight
        }
        None => usual,
    };
    let place = own.or_else(|| landmark.map(Landmark::place));
    Ok(MarkerDefinition { names: Vec::new(), side: None, segment, landmark, place, weight })
}
