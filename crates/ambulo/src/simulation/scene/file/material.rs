//! Materials of surfaces: friction, restitution and compliance.

use crate::contact::HuntCrossley;
use crate::simulation::scene::SceneError;
use crate::simulation::{ContactLaw, Material};
use crate::toml_reader::Table;

/// A material of a scene file; shapes refer to it by name.
#[derive(Debug, Clone, PartialEq)]
pub struct MaterialEntry {
    /// Name.
    pub name: String,
    /// Line of its header; 0 for the built-in `default`.
    pub line: usize,
    /// Its contact properties.
    pub material: Material,
}

/// The contact laws in scene files.
#[derive(Clone, Copy)]
enum LawWord {
    Rigid,
    Regularised,
    HuntCrossley,
}

/// All materials of the file. The first is `default`: the file's own, or else the built-in one (shoe on floor, and the default of
/// the 1997 paper).
pub(super) fn read_all(root: &Table<'_>) -> Result<Vec<MaterialEntry>, SceneError> {
    let mut materials = vec![MaterialEntry { name: "default".into(), line: 0, material: Material::default() }];
    for (name, table) in root.named_tables("material")? {
        let entry = MaterialEntry { material: material(&table)?, line: table.line, name };
        if entry.name == "default" {
            materials[0] = entry;
        } else {
            materials.push(entry);
        }
    }
    Ok(materials)
}

fn material(table: &Table<'_>) -> Result<Material, SceneError> {
    let words =
        [("rigid", LawWord::Rigid), ("regularised", LawWord::Regularised), ("hunt-crossley", LawWord::HuntCrossley)];
    match table.get("law").map_or(Ok(LawWord::Rigid), |value| value.choice(&words))? {
        LawWord::Rigid => rigid(table),
        LawWord::Regularised => regularised(table),
        LawWord::HuntCrossley => hunt_crossley(table),
    }
}

fn rigid(table: &Table<'_>) -> Result<Material, SceneError> {
    table.only(&[&["law", "friction", "restitution"]])?;
    let restitution = table.number_or("restitution", 0.0)?;
    if let Some(value) = table.get("restitution").filter(|_| !(0.0..=1.0).contains(&restitution)) {
        return Err(value.wrong("a share of the approach speed from 0 to 1"));
    }
    Ok(Material { friction: friction(table)?, restitution, law: ContactLaw::Rigid })
}

fn regularised(table: &Table<'_>) -> Result<Material, SceneError> {
    table.only(&[&["law", "friction", "stiffness", "damping"]])?;
    let friction = friction(table)?;
    let stiffness = table.need("stiffness", "the stiffness of a contact point [N/m]")?.above_zero()?;
    let damping = table.zero_or_more_or("damping", 0.0)?;
    Ok(Material { friction, restitution: 0.0, law: ContactLaw::Regularised { stiffness, damping } })
}

fn friction(table: &Table<'_>) -> Result<f64, SceneError> {
    table.need("friction", "the coefficient of friction")?.zero_or_more()
}

/// Keys that are left out have the values of `HuntCrossley::FALISSE_2022`.
fn hunt_crossley(table: &Table<'_>) -> Result<Material, SceneError> {
    let friction = ["static_friction", "dynamic_friction", "viscous_friction", "transition_velocity"];
    table.only(&[&["law", "stiffness", "dissipation"], &friction])?;
    let default = HuntCrossley::FALISSE_2022;
    let law = HuntCrossley {
        stiffness: table.above_zero_or("stiffness", default.stiffness)?,
        dissipation: table.zero_or_more_or("dissipation", default.dissipation)?,
        static_friction: table.zero_or_more_or("static_friction", default.static_friction)?,
        dynamic_friction: table.zero_or_more_or("dynamic_friction", default.dynamic_friction)?,
        viscous_friction: table.zero_or_more_or("viscous_friction", default.viscous_friction)?,
        transition_velocity: table.above_zero_or("transition_velocity", default.transition_velocity)?,
        ..default
    };
    Ok(Material { friction: law.dynamic_friction, restitution: 0.0, law: ContactLaw::HuntCrossley(law) })
}

/// Index of the material that a shape names under `key`; the first material if it names none.
pub(super) fn index_under(
    table: &Table<'_>,
    key: &str,
    materials: &[MaterialEntry],
) -> Result<Option<usize>, SceneError> {
    let words: Vec<(&str, usize)> = materials.iter().enumerate().map(|(i, m)| (m.name.as_str(), i)).collect();
    table.get(key).map(|value| value.choice(&words)).transpose()
}

/// Index of the material of a shape.
pub(super) fn of_shape(table: &Table<'_>, materials: &[MaterialEntry]) -> Result<usize, SceneError> {
    index_under(table, "material", materials).map(Option::unwrap_or_default)
}
