//! Sets in separate files: `<IKTaskSet file="tasks.xml"/>`.

use crate::error::Error;
use crate::xml;
use roxmltree::{Document, Node};

/// Tags of the sets that may be in separate files.
const SETS: [&str; 4] = ["IKTaskSet", "MeasurementSet", "ScaleSet", "OrientationWeightSet"];

/// Largest number of such sets in a document; a tool has at most three.
const MOST_SETS: usize = 16;

/// The text of a document with the sets of other files in their places; `load` reads a file by its path from the folder
/// of the document. Each set is written without line breaks, so that the lines of the document stay the same.
pub(super) fn included(
    text: &str,
    load: &mut dyn FnMut(&str) -> Result<Vec<u8>, String>,
) -> Result<Option<String>, Error> {
    let document = xml::parse(text)?;
    let is_elsewhere = |node: &Node<'_, '_>| SETS.iter().any(|set| node.has_tag_name(*set)) && file_of(*node).is_some();
    let is_inside = |place: &Node<'_, '_>| place.ancestors().skip(1).any(|above| is_elsewhere(&above));
    let places = document.descendants().filter(|node| is_elsewhere(node) && !is_inside(node));
    let places: Vec<Node<'_, '_>> = places.take(MOST_SETS + 1).collect();
    if places.is_empty() {
        return Ok(None);
    }
    if let Some(one_more) = places.get(MOST_SETS) {
        let found = format!("more than {MOST_SETS} sets in files of their own");
        return Err(xml::error_at(*one_more, found, "one of each tag"));
    }
    let (mut out, mut end) = (String::new(), 0);
    for place in places {
        out += &text[end..place.range().start];
        out += &set_of_file(place, load)?;
        end = place.range().end;
    }
    out += &text[end..];
    Ok(Some(out))
}

/// The path of the file that holds a set.
fn file_of(set: Node<'_, '_>) -> Option<String> {
    let file = set.attribute("file")?.trim();
    (!file.is_empty()).then(|| file.replace('\\', "/"))
}

/// The element of the set in its file, in one line.
fn set_of_file(place: Node<'_, '_>, load: &mut dyn FnMut(&str) -> Result<Vec<u8>, String>) -> Result<String, Error> {
    let (tag, file) = (place.tag_name().name(), file_of(place).unwrap_or_default());
    let error = |reason: String| {
        let found = format!("file=\"{file}\": {reason}");
        xml::error_at(place, found, format!("a file with the element <{tag}>"))
    };
    let text = xml::document_text(&load(&file).map_err(error)?);
    let document: Document<'_> = xml::parse(&text).map_err(|reason| error(reason.to_string()))?;
    let set = document.descendants().find(|node| node.has_tag_name(tag));
    let set = set.ok_or_else(|| error(format!("no element <{tag}>")))?;
    if let Some(other) = file_of(set) {
        return Err(error(format!("names a further file, {other}")));
    }
    Ok(text[set.range()].replace(['\n', '\r'], " "))
}
