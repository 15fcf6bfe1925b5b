//! Checks that joints form trees: no body is the child of two joints, and no chain of parents is a cycle.

use super::SceneError;
use super::body::BodyEntry;
use super::joint::JointEntry;
use super::names::Attachment;
use crate::toml_reader::Table;

const ADVICE: &str = "close the loop with a [[closure]]";

/// Rejects joints that do not form trees; `tables` are the tables of the joints, in the same order.
pub(super) fn check(joints: &[JointEntry], tables: &[Table<'_>], bodies: &[BodyEntry]) -> Result<(), SceneError> {
    let mut joint_of: Vec<Option<usize>> = vec![None; bodies.len()];
    for (i, (joint, table)) in joints.iter().zip(tables).enumerate() {
        if let Some(earlier) = joint_of[joint.child].map(|j| &joints[j]) {
            let expected = format!(
                "the child of one joint; this body is already the child of \"{}\" (line {})",
                earlier.name, earlier.line
            );
            return Err(table.need("child", "a body")?.wrong(&expected).hint(ADVICE));
        }
        joint_of[joint.child] = Some(i);
    }
    let parent = |joint: usize| match joints[joint].parent {
        Attachment::Body(body) => joint_of[body],
        Attachment::World | Attachment::FigureBody { .. } => None,
    };
    let Some(cycle) = cycle(joints.len(), parent) else { return Ok(()) };
    let mut names: Vec<&str> = cycle.iter().map(|joint| bodies[joints[*joint].child].name.as_str()).collect();
    names.push(names[0]);
    let first = &tables[cycle[0]];
    let expected = format!("a chain of parents without a cycle; found {}", shortened(&names));
    Err(first.need("parent", "a body")?.wrong(&expected).hint(ADVICE))
}

/// The first joint in a cycle, followed by its parents; `None` if there is no cycle.
fn cycle(count: usize, parent: impl Fn(usize) -> Option<usize>) -> Option<Vec<usize>> {
    // The search that visited each joint first; a search that meets itself has found a cycle.
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
    let mut cycle = vec![joint];
    while let Some(next) = parent(cycle[cycle.len() - 1]).filter(|next| *next != joint) {
        cycle.push(next);
    }
    // Begin with the joint that is first in the file.
    let first = cycle.iter().enumerate().min_by_key(|(_, joint)| **joint).map_or(0, |(i, _)| i);
    cycle.rotate_left(first);
    cycle
}

fn shortened(names: &[&str]) -> String {
    const SHOWN: usize = 6;
    if names.len() <= SHOWN {
        return names.join(" -> ");
    }
    format!("{} -> … -> {}", names[..SHOWN - 1].join(" -> "), names[names.len() - 1])
}
