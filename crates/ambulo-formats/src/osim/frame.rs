//! Frames fixed to bodies, and the ways in which the versions of the format name them.

use super::{OsimBody, OsimFrame, is_ground, name_of};
use crate::error::Error;
use crate::xml;
use roxmltree::Node;
use std::collections::BTreeMap;

/// Offset frames may be fixed to offset frames; a longer chain than this is a cycle.
const LONGEST_CHAIN: usize = 32;

impl OsimFrame {
    /// The body's own frame.
    pub(super) fn of_body(body: &str) -> OsimFrame {
        let rotation = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        OsimFrame { body: body.to_owned(), rotation, translation_m: [0.0; 3] }
    }

    /// A frame on `body` with origin [m] and body-fixed X-Y-Z angles [rad].
    pub(super) fn offset(body: &str, translation_m: [f64; 3], orientation_rad: [f64; 3]) -> OsimFrame {
        OsimFrame { body: body.to_owned(), rotation: body_fixed_xyz(orientation_rad), translation_m }
    }

    /// The body coordinates of a point given in this frame [m].
    pub(super) fn place(&self, point: [f64; 3]) -> [f64; 3] {
        let mut placed = self.translation_m;
        for (row, p) in self.rotation.iter().zip(&mut placed) {
            *p += row.iter().zip(point).map(|(r, x)| r * x).sum::<f64>();
        }
        placed
    }

    /// A frame with origin [m] and body-fixed X-Y-Z angles [rad] in this frame.
    pub(super) fn with_offset(&self, translation: [f64; 3], angles: [f64; 3]) -> OsimFrame {
        self.carry(translation, body_fixed_xyz(angles))
    }

    /// The pose in the body of a frame that is given in this frame.
    fn carry(&self, translation: [f64; 3], rotation: [[f64; 3]; 3]) -> OsimFrame {
        OsimFrame {
            body: self.body.clone(),
            translation_m: self.place(translation),
            rotation: product(&self.rotation, &rotation),
        }
    }
}

fn product(a: &[[f64; 3]; 3], b: &[[f64; 3]; 3]) -> [[f64; 3]; 3] {
    std::array::from_fn(|i| std::array::from_fn(|j| (0..3).map(|k| a[i][k] * b[k][j]).sum()))
}

/// R = Rx(a) Ry(b) Rz(c): body-fixed rotations about x, then the new y, then the new z, as OpenSim's `orientation`.
fn body_fixed_xyz([a, b, c]: [f64; 3]) -> [[f64; 3]; 3] {
    let ((sa, ca), (sb, cb), (sc, cc)) = (libm::sincos(a), libm::sincos(b), libm::sincos(c));
    [
        [cb * cc, -cb * sc, sb],
        [ca * sc + sa * sb * cc, ca * cc - sa * sb * sc, -sa * cb],
        [sa * sc - ca * sb * cc, sa * cc + ca * sb * sc, ca * cb],
    ]
}

/// Every offset frame of the document, with its owner, and the names of the bodies.
pub(super) struct Frames<'d> {
    bodies: Vec<String>,
    offsets: Vec<Offset<'d>>,
}

struct Offset<'d> {
    name: &'d str,
    /// Name of the joint, body or component that contains the frame.
    owner: &'d str,
    parent: Option<&'d str>,
    translation: [f64; 3],
    orientation: [f64; 3],
}

impl<'d> Frames<'d> {
    pub(super) fn collect(model: Node<'d, '_>, bodies: &[OsimBody]) -> Result<Frames<'d>, Error> {
        let mut offsets = Vec::new();
        for node in model.descendants().filter(|n| n.has_tag_name("PhysicalOffsetFrame")) {
            offsets.push(Offset {
                name: name_of(node),
                owner: owner_of(node),
                parent: socket(node, "parent"),
                translation: xml::triple(node, "translation")?.unwrap_or_default(),
                orientation: xml::triple(node, "orientation")?.unwrap_or_default(),
            });
        }
        Ok(Frames { bodies: bodies.iter().map(|b| b.name.clone()).collect(), offsets })
    }

    /// Every offset frame that leads to a body, by `owner/name`.
    pub(super) fn by_owner(&self) -> BTreeMap<String, OsimFrame> {
        let key = |offset: &Offset<'_>| format!("{}/{}", offset.owner, offset.name);
        self.offsets.iter().filter_map(|offset| Some((key(offset), self.stack(offset, 0)?))).collect()
    }

    /// The frame named by a socket of a component.
    pub(super) fn of_socket(&self, node: Node<'_, '_>, name: &str) -> Result<OsimFrame, Error> {
        match socket(node, name) {
            Some(path) => self.resolve(node, path),
            None => Err(xml::error_at(node, format!("no <socket_{name}>"), "the name of a body or of an offset frame")),
        }
    }

    /// The frame that contains an element: a body, ground or an offset frame.
    pub(super) fn of_component(&self, node: Node<'_, '_>) -> Result<OsimFrame, Error> {
        let is_frame = |n: &Node<'_, '_>| matches!(n.tag_name().name(), "Body" | "Ground" | "PhysicalOffsetFrame");
        let owner = node.ancestors().skip(1).find(is_frame);
        let path = match owner {
            Some(frame) if frame.has_tag_name("PhysicalOffsetFrame") => {
                format!("{}/{}", owner_of(frame), name_of(frame))
            }
            Some(frame) if frame.has_tag_name("Ground") => "ground".to_owned(),
            Some(frame) => name_of(frame).to_owned(),
            None => String::new(),
        };
        self.lookup("", &path, 0).ok_or_else(|| {
            xml::error_at(
                node,
                "a place outside the bodies of the model".into(),
                "an element inside a <Body> or <Ground>",
            )
        })
    }

    /// The frame with this name or path, resolved from `node`: its own frames first, then bodies, then any frame.
    pub(super) fn resolve(&self, node: Node<'_, '_>, path: &str) -> Result<OsimFrame, Error> {
        let owner = name_of(node);
        self.lookup(owner, path, 0).ok_or_else(|| {
            let known: Vec<_> = self.bodies.iter().map(String::as_str).collect();
            xml::error_at(
                node,
                format!("the frame `{path}`, which leads to no body"),
                format!("`ground`, one of the bodies {}, or an offset frame on one of them", known.join(", ")),
            )
        })
    }

    fn lookup(&self, owner: &str, path: &str, depth: usize) -> Option<OsimFrame> {
        let mut parts = path.rsplit('/').map(str::trim).filter(|p| !p.is_empty());
        let last = parts.next()?;
        let before = parts.next().filter(|p| *p != ".." && *p != "bodyset" && *p != "jointset" && *p != "frames");
        if depth > LONGEST_CHAIN {
            return None;
        }
        if before.is_none() {
            if let Some(offset) = self.offsets.iter().find(|o| o.owner == owner && o.name == last) {
                return self.stack(offset, depth);
            }
            if is_ground(last) || self.bodies.iter().any(|b| b == last) {
                return Some(OsimFrame::of_body(last));
            }
        }
        let offset = self.offsets.iter().find(|o| o.name == last && before.is_none_or(|b| o.owner == b))?;
        self.stack(offset, depth)
    }

    fn stack(&self, offset: &Offset<'_>, depth: usize) -> Option<OsimFrame> {
        // A frame without a stated parent is fixed to the component that contains it.
        let base = match offset.parent {
            Some(".." | "") | None => self.lookup("", offset.owner, depth + 1)?,
            Some(parent) => self.lookup(offset.owner, parent, depth + 1)?,
        };
        Some(base.carry(offset.translation, body_fixed_xyz(offset.orientation)))
    }
}

/// Name of the nearest enclosing component that has a name and is not a list.
fn owner_of<'d>(node: Node<'d, '_>) -> &'d str {
    node.ancestors()
        .skip(1)
        .filter(|n| n.is_element() && !matches!(n.tag_name().name(), "frames" | "components" | "objects"))
        .find_map(|n| n.attribute("name"))
        .unwrap_or_default()
        .trim()
}

/// The connectee of a socket, in the syntax of any version since 30505.
pub(super) fn socket<'d>(node: Node<'d, '_>, name: &str) -> Option<&'d str> {
    for tag in
        [format!("socket_{name}"), format!("socket_{name}_connectee_name"), format!("connector_{name}_connectee_name")]
    {
        if let Some(path) = xml::text(node, &tag) {
            return Some(path);
        }
    }
    let connectors = xml::child(node, "connectors")?;
    let connector = xml::elements(connectors).find(|c| name_of(*c) == name)?;
    xml::text(connector, "connectee_name")
}
