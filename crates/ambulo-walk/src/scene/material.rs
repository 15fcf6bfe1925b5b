//! Materials in a scene file: friction, restitution, compliance.

use super::SceneError;
use crate::toml_reader::Table;

/// A material, which shapes refer to by its name.
#[derive(Debug, Clone, PartialEq)]
pub struct MaterialEntry {
    /// Name.
    pub name: String,
    /// Line of its header; 0 for the built-in `default`.
    pub line: usize,
    /// The contact law.
    pub law: MaterialLaw,
}

/// The contact law of a material, with its friction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum MaterialLaw {
    /// Surfaces do not overlap; Coulomb friction.
    Rigid {
        /// Coulomb's coefficient, zero or more.
        friction: f64,
        /// Coefficient of restitution, 0 to 1.
        restitution: f64,
    },
    /// A spring and a damper at every contact point, solved as a constraint; Coulomb friction.
    Regularised {
        /// Coulomb's coefficient, zero or more.
        friction: f64,
        /// Stiffness per contact point [N/m], above zero.
        stiffness: f64,
        /// Damping per contact point [N.s/m], zero or more.
        damping: f64,
    },
    /// Hunt and Crossley's law as in OpenSim's `SmoothSphereHalfSpaceForce`: a force that depends on the depth, no
    /// constraint.
    HuntCrossley {
        /// Plane strain modulus [N/m²], above zero.
        stiffness: f64,
        /// Dissipation [s/m], zero or more.
        dissipation: f64,
        /// Friction coefficient as sliding begins.
        static_friction: f64,
        /// Friction coefficient while sliding.
        dynamic_friction: f64,
        /// Increase of the friction coefficient per m/s of sliding [s/m].
        viscous_friction: f64,
        /// Sliding speed at which friction is full [m/s], above zero.
        transition_velocity: f64,
    },
}

/// A shoe on a floor, and the default of the 1997 paper, without restitution.
const DEFAULT: MaterialLaw = MaterialLaw::Rigid { friction: 0.8, restitution: 0.0 };

/// The contact laws, by their name in the file.
#[derive(Clone, Copy)]
enum Word {
    Rigid,
    Regularised,
    HuntCrossley,
}

/// Reads all materials; the first is `default`, from the file or built in.
pub(super) fn read_all(root: &Table<'_>) -> Result<Vec<MaterialEntry>, SceneError> {
    let mut materials = vec![MaterialEntry { name: "default".into(), line: 0, law: DEFAULT }];
    for (name, table) in root.named_tables("material")? {
        let material = MaterialEntry { law: law(&table)?, line: table.line, name };
        if material.name == "default" {
            materials[0] = material;
        } else {
            materials.push(material);
        }
    }
    Ok(materials)
}

fn law(table: &Table<'_>) -> Result<MaterialLaw, SceneError> {
    let words = [("rigid", Word::Rigid), ("regularised", Word::Regularised), ("hunt-crossley", Word::HuntCrossley)];
    let word = table.get("law").map_or(Ok(Word::Rigid), |value| value.choice(&words))?;
    match word {
        Word::Rigid => rigid(table),
        Word::Regularised => regularised(table),
        Word::HuntCrossley => hunt_crossley(table),
    }
}

fn rigid(table: &Table<'_>) -> Result<MaterialLaw, SceneError> {
    table.only(&[&["law", "friction", "restitution"]])?;
    let restitution = table.number_or("restitution", 0.0)?;
    if let Some(value) = table.get("restitution").filter(|_| !(0.0..=1.0).contains(&restitution)) {
        return Err(value.wrong("a coefficient of restitution from 0 to 1"));
    }
    Ok(MaterialLaw::Rigid { friction: friction(table)?, restitution })
}

fn regularised(table: &Table<'_>) -> Result<MaterialLaw, SceneError> {
    table.only(&[&["law", "friction", "stiffness", "damping"]])?;
    Ok(MaterialLaw::Regularised {
        friction: friction(table)?,
        stiffness: table.need("stiffness", "the stiffness of a contact point [N/m]")?.above_zero()?,
        damping: table.zero_or_more_or("damping", 0.0)?,
    })
}

fn friction(table: &Table<'_>) -> Result<f64, SceneError> {
    table.need("friction", "the coefficient of friction")?.zero_or_more()
}

/// Defaults as in `contact::HuntCrossley::FALISSE_2022`.
fn hunt_crossley(table: &Table<'_>) -> Result<MaterialLaw, SceneError> {
    let friction = ["static_friction", "dynamic_friction", "viscous_friction", "transition_velocity"];
    table.only(&[&["law", "stiffness", "dissipation"], &friction])?;
    Ok(MaterialLaw::HuntCrossley {
        stiffness: table.above_zero_or("stiffness", 1e6)?,
        dissipation: table.zero_or_more_or("dissipation", 2.0)?,
        static_friction: table.zero_or_more_or("static_friction", 0.8)?,
        dynamic_friction: table.zero_or_more_or("dynamic_friction", 0.8)?,
        viscous_friction: table.zero_or_more_or("viscous_friction", 0.5)?,
        transition_velocity: table.above_zero_or("transition_velocity", 0.2)?,
    })
}

/// Index of the material that a shape names.
pub(super) fn of_shape(table: &Table<'_>, materials: &[MaterialEntry]) -> Result<usize, SceneError> {
    let Some(value) = table.get("material") else { return Ok(0) };
    let words: Vec<(&str, usize)> = materials.iter().enumerate().map(|(i, m)| (m.name.as_str(), i)).collect();
    value.choice(&words)
}
