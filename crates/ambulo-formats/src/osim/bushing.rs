//! Springs with dampers between two frames (`BushingForce`), in both layouts of the format.

use super::frame::Frames;
use super::{OsimFrame, members, name_of};
use crate::error::Error;
use crate::xml;
use roxmltree::Node;

/// A spring and a damper between two frames. It resists the body-fixed X-Y-Z angles of the second frame in the first,
/// and the place of its origin there.
#[derive(Debug, Clone, PartialEq)]
pub struct OsimBushing {
    /// Name of the force.
    pub name: String,
    /// Line of the element, counted from 1.
    pub line: usize,
    /// The two frames.
    pub frames: [OsimFrame; 2],
    /// Stiffness against the angles [N.m/rad].
    pub rotational_stiffness: [f64; 3],
    /// Stiffness along the axes of the first frame [N/m].
    pub translational_stiffness: [f64; 3],
    /// Damping of the rates of the angles [N.m.s/rad].
    pub rotational_damping: [f64; 3],
    /// Damping along the axes of the first frame [N.s/m].
    pub translational_damping: [f64; 3],
    /// Groups of the set of forces to which it belongs.
    pub groups: Vec<String>,
}

/// Tag of the element.
pub(super) const TAG: &str = "BushingForce";

/// The bushings of a model that are switched on.
pub(super) fn of_model(model: Node<'_, '_>, frames: &Frames<'_>) -> Result<Vec<OsimBushing>, Error> {
    let mut bushings = Vec::new();
    let listed = ["ForceSet", "ComponentSet"].into_iter().flat_map(|set| members(model, set));
    for node in listed.filter(|node| node.has_tag_name(TAG)) {
        let is_disabled = xml::boolean(node, "isDisabled")?.unwrap_or(false);
        if !is_disabled && xml::boolean(node, "appliesForce")?.unwrap_or(true) {
            bushings.push(read(node, frames, groups_of(model, name_of(node)))?);
        }
    }
    Ok(bushings)
}

fn read(node: Node<'_, '_>, frames: &Frames<'_>, groups: Vec<String>) -> Result<OsimBushing, Error> {
    let triple = |tag: &str| Ok::<_, Error>(xml::triple(node, tag)?.unwrap_or_default());
    Ok(OsimBushing {
        name: name_of(node).to_owned(),
        line: xml::line_of(node),
        frames: [end(node, frames, 1)?, end(node, frames, 2)?],
        rotational_stiffness: triple("rotational_stiffness")?,
        translational_stiffness: triple("translational_stiffness")?,
        rotational_damping: triple("rotational_damping")?,
        translational_damping: triple("translational_damping")?,
        groups,
    })
}

/// The frame at one end: on a body by location and orientation (to 30500), or named by a socket.
fn end(node: Node<'_, '_>, frames: &Frames<'_>, number: usize) -> Result<OsimFrame, Error> {
    let Some(body) = xml::text(node, &format!("body_{number}")) else {
        return frames.of_socket(node, &format!("frame{number}"));
    };
    let body = frames.resolve(node, body)?;
    let place = xml::triple(node, &format!("location_body_{number}"))?.unwrap_or_default();
    Ok(OsimFrame::offset(
        &body.body,
        place,
        xml::triple(node, &format!("orientation_body_{number}"))?.unwrap_or_default(),
    ))
}

/// Names of the groups of forces with this member.
fn groups_of(model: Node<'_, '_>, name: &str) -> Vec<String> {
    let groups = xml::child(model, "ForceSet").and_then(|set| xml::child(set, "groups"));
    let has_it = |group: &Node<'_, '_>| {
        xml::text(*group, "members").unwrap_or_default().split_whitespace().any(|member| member == name)
    };
    let named = |group: Node<'_, '_>| name_of(group).to_owned();
    groups.into_iter().flat_map(|groups| xml::elements(groups)).filter(has_it).map(named).collect()
}
