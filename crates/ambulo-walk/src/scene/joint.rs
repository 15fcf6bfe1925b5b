//! Joints in a scene file: they connect a body to another one or to the world.

use super::SceneError;
use super::body::BodyEntry;
use super::coordinate::CoordinateEntry;
use super::joint_axes::JointAxes;
use super::names::{Attachment, Names};
use crate::spatial::Vec3;
use crate::toml_reader::Table;

/// A joint between a child and its parent. The joints form trees; loops are closed by closures.
#[derive(Debug, Clone, PartialEq)]
pub struct JointEntry {
    /// Name, unique among joints and closures.
    pub name: String,
    /// Line of its header.
    pub line: usize,
    /// The free motions.
    pub kind: JointAxes,
    /// The parent.
    pub parent: Attachment,
    /// The child: index in [`SceneFile::bodies`](super::SceneFile::bodies). No body is the child of two joints.
    pub child: usize,
    /// Initial position of the joint's centre in the world [m].
    pub at: Vec3,
    /// Coordinates, one per free motion, in the order of [`JointAxes::coordinates`].
    pub coordinates: Vec<CoordinateEntry>,
}

const KEYS: &[&str] = &["name", "kind", "parent", "child", "at", "coordinate"];

impl JointEntry {
    /// Reads one joint; `tree` checks that all joints form trees.
    pub(super) fn read(
        table: &Table<'_>,
        name: String,
        names: &Names,
        bodies: &[BodyEntry],
        duration_s: f64,
    ) -> Result<JointEntry, SceneError> {
        let kind = JointAxes::read(table, KEYS)?;
        let parent = names.carrier(&table.need("parent", "\"world\" or a body")?)?;
        let child = names.body(&table.need("child", "the child of the joint")?)?;
        let at = match (table.get("at"), kind) {
            (Some(value), _) => value.vector()?,
            (None, JointAxes::Revolute { .. } | JointAxes::Universal { .. } | JointAxes::Ball) => {
                return Err(table.missing("at", "the joint's centre in the world at the start [m]"));
            }
            (None, _) => bodies[child].start.translation,
        };
        let coordinates = CoordinateEntry::read_all(table, kind, &bodies[child], duration_s)?;
        Ok(JointEntry { name, line: table.line, kind, parent, child, at, coordinates })
    }
}
