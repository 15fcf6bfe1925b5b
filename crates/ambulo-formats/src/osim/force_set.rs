//! OpenSim `ForceSet` documents: motors at coordinates for a model, in a separate file (reserve actuators).
//!
//! Read: documents of all versions, also without the `<OpenSimDocument>` around the set.
//! Pinned by: tests/osim_muscles.rs

use super::muscle::{self, OsimCoordinateActuator};
use super::name_of;
use crate::error::Error;
use crate::xml::{self, LineCounter};
use std::collections::BTreeMap;

/// Motors at coordinates, from a separate document.
#[derive(Debug, Clone, PartialEq)]
pub struct OsimForceSet {
    /// Name of the set.
    pub name: String,
    /// Motors at coordinates that are switched on, in document order.
    pub actuators: Vec<OsimCoordinateActuator>,
    /// Number of elements of other types, by tag.
    pub ignored: BTreeMap<String, usize>,
}

impl OsimForceSet {
    /// Reads a document with a set of forces.
    ///
    /// # Errors
    /// XML that is not well formed, a document without a `ForceSet` or without a `CoordinateActuator`, actuators
    /// without a coordinate, numbers that are not valid.
    pub fn read(bytes: &[u8]) -> Result<OsimForceSet, Error> {
        let text = xml::document_text(bytes);
        if text.trim().is_empty() {
            return Err(Error::Empty { expected: "an <OpenSimDocument> with a <ForceSet>" });
        }
        let document = xml::parse(&text)?;
        let root = document.root_element();
        let set = if root.has_tag_name("ForceSet") { Some(root) } else { xml::child(root, "ForceSet") };
        let set = set.ok_or_else(|| {
            let found = xml::elements(root).next().map_or("nothing".into(), |e| format!("<{}>", e.tag_name().name()));
            xml::error_at(root, found, "a <ForceSet>")
        })?;
        let listed = || xml::child(set, "objects").into_iter().flat_map(|objects| xml::elements(objects));
        let actuators = muscle::actuators(listed(), &mut LineCounter::new(&text))?;
        if actuators.is_empty() {
            return Err(xml::error_at(set, "no <CoordinateActuator>".into(), "at least one that is switched on"));
        }
        let mut ignored = BTreeMap::new();
        for node in listed().filter(|node| !node.has_tag_name(muscle::ACTUATOR)) {
            *ignored.entry(node.tag_name().name().to_owned()).or_insert(0) += 1;
        }
        Ok(OsimForceSet { name: name_of(set).to_owned(), actuators, ignored })
    }
}
