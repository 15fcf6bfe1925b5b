//! Outputs in a scene file.

use super::SceneError;
use super::names::{Item, Names};
use crate::toml_reader::{Table, Value};

/// The results that are written and drawn.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Outputs {
    /// Poses of the bodies.
    pub poses: bool,
    /// Coordinates, efforts and reactions of the joints.
    pub joints: bool,
    /// Contact points, forces, slip.
    pub contacts: bool,
    /// Energies, iterations, residual.
    pub energy: bool,
    /// Curves that are drawn over time.
    pub plots: Vec<Plot>,
}

/// A curve over time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Plot {
    /// Kinetic, potential and total energy.
    Energy,
    /// Iterations and residual.
    Solver,
    /// The sum of the contact forces.
    Contacts,
    /// Position of a body: index in [`SceneFile::bodies`](super::SceneFile::bodies).
    Body(usize),
    /// Coordinates and moments of a joint: index in [`SceneFile::joints`](super::SceneFile::joints).
    Joint(usize),
    /// Force of a closure: index in [`SceneFile::closures`](super::SceneFile::closures).
    Closure(usize),
}

/// Reads the outputs. `things` are bodies, obstacles and figures, `links` are joints and closures.
pub(super) fn read(root: &Table<'_>, things: &Names, links: &Names) -> Result<Outputs, SceneError> {
    let Some(value) = root.get("output") else {
        return Ok(Outputs { poses: true, joints: true, contacts: true, energy: true, plots: Vec::new() });
    };
    let table = value.table("a table under the header [output]")?;
    table.only(&[&["poses", "joints", "contacts", "energy", "plot"]])?;
    let plots = match table.get("plot") {
        None => Vec::new(),
        Some(value) => {
            value.list(EXPECTED)?.iter().map(|entry| plot(entry, things, links)).collect::<Result<_, _>>()?
        }
    };
    Ok(Outputs {
        poses: table.truth_or("poses", true)?,
        joints: table.truth_or("joints", true)?,
        contacts: table.truth_or("contacts", true)?,
        energy: table.truth_or("energy", true)?,
        plots,
    })
}

const EXPECTED: &str =
    "a list of \"energy\", \"solver\", \"contacts\", \"body:NAME\", \"joint:NAME\", \"closure:NAME\"";

fn plot(value: &Value<'_>, things: &Names, links: &Names) -> Result<Plot, SceneError> {
    let text = value.text()?;
    let (kind, name) = text.split_once(':').unwrap_or((text, ""));
    match (kind, things.find(name), links.find(name)) {
        ("energy", ..) if text == kind => Ok(Plot::Energy),
        ("solver", ..) if text == kind => Ok(Plot::Solver),
        ("contacts", ..) if text == kind => Ok(Plot::Contacts),
        ("body", Some(Item::Body(body)), _) => Ok(Plot::Body(body)),
        ("joint", _, Some(Item::Joint(joint))) => Ok(Plot::Joint(joint)),
        ("closure", _, Some(Item::Closure(closure))) => Ok(Plot::Closure(closure)),
        ("body", found, _) => Err(things.unfit(value, name, "the name of a body after \"body:\"", found)),
        ("joint", _, found) => Err(links.unfit(value, name, "the name of a joint after \"joint:\"", found)),
        ("closure", _, found) => Err(links.unfit(value, name, "the name of a closure after \"closure:\"", found)),
        _ => Err(value.wrong(EXPECTED)),
    }
}
