//! OpenSim `MarkerSet` documents: markers for a model, in a separate file.
//!
//! Read: documents of all versions (`<body>`, or the name of a frame in a socket), also without the `<OpenSimDocument>`
//! around the set, and models, of which only the markers are read.
//! Pinned by: tests/marker_sets.rs

use super::frame::socket;
use super::{OsimFrame, OsimMarker, OsimModel, is_ground, members, name_of};
use crate::error::{Error, Remark, quoted};
use crate::xml;
use roxmltree::Node;

/// A set of markers for a model.
#[derive(Debug, Clone, PartialEq)]
pub struct OsimMarkerSet {
    /// Name of the set.
    pub name: String,
    /// The markers, in the order of the document; no two have the same name.
    pub markers: Vec<OsimSetMarker>,
    /// Remarks on the document.
    pub remarks: Vec<Remark>,
}

/// A marker of a set.
#[derive(Debug, Clone, PartialEq)]
pub struct OsimSetMarker {
    /// Name of the marker.
    pub name: String,
    /// Line of the element, counted from 1.
    pub line: usize,
    /// Name or path of a body or of an offset frame of the model: `pelvis`, `/bodyset/pelvis`,
    /// `/jointset/hip/pelvis_offset`.
    pub frame: String,
    /// Place in that frame [m].
    pub location_m: [f64; 3],
    /// Whether scaling leaves the marker where it is on its body.
    pub fixed: bool,
}

const EXPECTED: &str = "a <MarkerSet>";

impl OsimMarkerSet {
    /// Reads a document with a set of markers.
    ///
    /// # Errors
    /// XML that is not well formed, a document without a marker, markers without a name, a frame or a place.
    pub fn read(bytes: &[u8]) -> Result<OsimMarkerSet, Error> {
        let text = xml::document_text(bytes);
        if text.trim().is_empty() {
            return Err(Error::Empty { expected: "an <OpenSimDocument> with a <MarkerSet>" });
        }
        let document = xml::parse(&text)?;
        let set = find_set(document.root_element())?;
        let mut read = OsimMarkerSet { name: name_of(set).to_owned(), markers: Vec::new(), remarks: Vec::new() };
        let objects = xml::child(set, "objects").unwrap_or(set);
        for node in xml::elements(objects).filter(|n| n.has_tag_name("Marker")) {
            read.add(read_marker(node)?);
        }
        if read.markers.is_empty() {
            return Err(xml::error_at(set, "no <Marker>".into(), "at least one"));
        }
        Ok(read)
    }

    fn add(&mut self, marker: OsimSetMarker) {
        match self.markers.iter_mut().find(|before| before.name == marker.name) {
            None => self.markers.push(marker),
            Some(before) => {
                let message =
                    format!("marker {} is also on line {}; the later one was used", quoted(&marker.name), before.line);
                self.remarks.push(Remark::of_line(marker.line, message));
                *before = marker;
            }
        }
    }
}

fn find_set<'a, 'i>(root: Node<'a, 'i>) -> Result<Node<'a, 'i>, Error> {
    if root.has_tag_name("MarkerSet") {
        return Ok(root);
    }
    let of_model = || xml::child(root, "Model").and_then(|model| xml::child(model, "MarkerSet"));
    xml::child(root, "MarkerSet").or_else(of_model).ok_or_else(|| {
        let found = xml::elements(root).next().map_or("nothing".into(), |e| format!("<{}>", e.tag_name().name()));
        xml::error_at(root, found, EXPECTED)
    })
}

fn read_marker(node: Node<'_, '_>) -> Result<OsimSetMarker, Error> {
    let missing = |what: &str, expected: &str| xml::error_at(node, format!("no {what}"), expected);
    let frame = xml::text(node, "body").or_else(|| socket(node, "parent_frame"));
    let frame = frame.filter(|frame| !frame.eq_ignore_ascii_case("unassigned"));
    let marker = OsimSetMarker {
        name: name_of(node).to_owned(),
        line: xml::line_of(node),
        frame: frame.ok_or_else(|| missing("<body>", "the name of the body that carries the marker"))?.to_owned(),
        location_m: xml::triple(node, "location")?.ok_or_else(|| missing("<location>", "x y z in metres"))?,
        fixed: xml::boolean(node, "fixed")?.unwrap_or(false),
    };
    if marker.name.is_empty() {
        return Err(missing("name", "the name of the marker, as in the recording"));
    }
    Ok(marker)
}

impl OsimModel {
    /// The model with the markers of a set, as OpenSim adds them: a marker replaces the one of its name, other markers
    /// of the model stay.
    ///
    /// # Errors
    /// A marker on a body or frame that the model does not have; the line refers to the set's document.
    pub fn with_marker_set(mut self, set: &OsimMarkerSet) -> Result<OsimModel, Error> {
        for marker in &set.markers {
            let frame = self.frame_at(&marker.frame).ok_or_else(|| self.unknown_frame(marker))?;
            let placed = OsimMarker {
                name: marker.name.clone(),
                location_m: frame.place(marker.location_m),
                body: frame.body,
                fixed: marker.fixed,
            };
            match self.markers.iter_mut().find(|before| before.name == placed.name) {
                Some(before) => *before = placed,
                None => self.markers.push(placed),
            }
        }
        Ok(self)
    }

    /// The body or the offset frame at a path, by its last parts.
    fn frame_at(&self, path: &str) -> Option<OsimFrame> {
        let mut parts = path.rsplit('/').map(str::trim).filter(|part| !part.is_empty());
        let last = parts.next()?;
        let owner = parts.next();
        let of_owner = owner.and_then(|owner| self.frames.get(&format!("{owner}/{last}")));
        if let Some(frame) = of_owner {
            return Some(frame.clone());
        }
        if is_ground(last) || self.bodies.iter().any(|body| body.name == last) {
            return Some(OsimFrame::of_body(last));
        }
        let mut named = self.frames.iter().filter(|(key, _)| key.rsplit('/').next() == Some(last));
        match (named.next(), named.next()) {
            (Some((_, frame)), None) if owner.is_none() => Some(frame.clone()),
            _ => None,
        }
    }

    fn unknown_frame(&self, marker: &OsimSetMarker) -> Error {
        let bodies: Vec<&str> = self.bodies.iter().map(|body| body.name.as_str()).collect();
        Error::Element {
            line: marker.line,
            element: format!("Marker name=\"{}\"", marker.name),
            found: format!("the body {}, which the model {} does not have", quoted(&marker.frame), quoted(&self.name)),
            expected: format!("`ground`, an offset frame of the model, or one of its bodies: {}", bodies.join(", ")),
        }
    }
}

/// The markers of a model document.
pub(super) fn of_model(model: Node<'_, '_>, frames: &super::frame::Frames<'_>) -> Result<Vec<OsimMarker>, Error> {
    members(model, "MarkerSet").map(|node| marker_of_model(node, frames)).collect()
}

fn marker_of_model(node: Node<'_, '_>, frames: &super::frame::Frames<'_>) -> Result<OsimMarker, Error> {
    let location = xml::triple(node, "location")?.unwrap_or_default();
    let frame = match xml::text(node, "body") {
        Some(body) => frames.resolve(node, body)?,
        None => frames.of_socket(node, "parent_frame")?,
    };
    Ok(OsimMarker {
        name: name_of(node).to_owned(),
        location_m: frame.place(location),
        body: frame.body,
        fixed: xml::boolean(node, "fixed")?.unwrap_or(false),
    })
}
