//! Whether the joints form trees: no body on two joints, no parents that lead in a circle.

use super::SceneError;
use super::body::BodyEntry;
use super::joint::JointEntry;
use super::names::Attachment;
use crate::toml_reader::Table;

const ADVICE: &str = "close the loop with a [[closure]]";

/// Refuses joints that do not form trees; `tables` are those of the joints, in the same order.
pub(super) fn check(joints: &[JointEntry], tables: &[Table<'_>], bodies: &[BodyEntry]) -> Result<(), SceneError> {
    let mut joint_of: Vec<Option<usize>> = vec![None; bodies.len()];
    for (i, (joint, table)) in joints.iter().zip(tables).enumerate() {
        if let Some(earlier) = joint_of[joint.child].map(|j| &joints[j]) {
            let expected =
                format!("a body on one joint; this one is on \"{}\" already (line {})", earlier.name, earlier.line);
            return Err(table.need("child", "a body")?.wrong(&expected).hint(ADVICE));
        }
        joint_of[joint.child] = Some(i);
    }
    let parent = |joint: usize| match joints[joint].parent {
        Attachment::Body(body) => joint_of[body],
        Attachment::World | Attachment::FigureBody { .. } => None,
    };
    let Some(circle) = circle(joints.len(), parent) else { return Ok(()) };
    let mut names: Vec<&str> = circle.iter().map(|joint| bodies[joints[*joint].child].name.as_str()).collect();
    names.push(names[0]);
    let first = &tables[circle[0]];
    let expected = format!("parents that do not lead in a circle; here they do: {}", shortened(&names));
    Err(first.need("parent", "a body")?.wrong(&expected).hint(ADVICE))
}

/// The first joint in a circle, followed by its parents; `None` if there is no circle.
fn circle(count: usize, parent: impl Fn(usize) -> Option<usize>) -> Option<Vec<usize>> {
    // Which walk came by first; a walk that meets itself has found a circle.
    let mut walk: Vec<Option<usize>> = vec![None; count];
    for start in 0..count {
        let mut at = Some(start);
        while let Some(joint) = at {
            match walk[joint] {
                None => walk[joint] = Some(start),
                Some(earlier) if earlier == start => return Some(around(joint, parent)),
                Some(_) => break,
            }
            at = parent(joint);
        }
    }
    None
}

fn around(joint: usize, parent: impl Fn(usize) -> Option<usize>) -> Vec<usize> {
    let mut circle = vec![joint];
    while let Some(next) = parent(circle[circle.len() - 1]).filter(|next| *next != joint) {
        circle.push(next);
    }
    // Begin with the one that stands first in the file.
    let first = circle.iter().enumerate().min_by_key(|(_, joint)| **joint).map_or(0, |(i, _)| i);
    circle.rotate_left(first);
    circle
}

fn shortened(names: &[&str]) -> String {
    const SHOWN: usize = 6;
    if names.len() <= SHOWN {
        return names.join(" -> ");
    }
    format!("{} -> … -> {}", names[..SHOWN - 1].join(" -> "), names[names.len() - 1])
}
