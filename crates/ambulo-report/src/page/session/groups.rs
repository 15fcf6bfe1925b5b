//! The grids of panels of a report: kinematics, kinetics, ground forces.

use super::curves;
use super::results::Results;
use super::size::BodySize;
use crate::clinical::{ClinicalGroup, ClinicalQuantity, clinical_quantities};
use crate::clinical_file::KNEE_ANGLES;
use crate::page::block::Block;
use crate::page::contract::{Group, PageSource, Panel};
use ambulo::model::Side;
use ambulo_results::JOINT_MOMENTS;
use std::collections::BTreeSet;

/// A grid: its id, its heading, the kinds of quantities in it.
struct Grid {
    id: &'static str,
    title: &'static str,
    kinds: &'static [ClinicalGroup],
    note: &'static str,
}

const GRIDS: [Grid; 3] = [
    Grid {
        id: "kinematics",
        title: "Joint angles",
        kinds: &[ClinicalGroup::Kinematics],
        note: "Angles in degrees. A gait cycle lasts from foot strike to the next foot strike of the same foot.",
    },
    Grid {
        id: "kinetics",
        title: "Joint moments and powers",
        kinds: &[ClinicalGroup::Moments, ClinicalGroup::Powers],
        note: "Internal joint moments (by muscles, ligaments and bones) and joint powers, per kilogram of body mass.",
    },
    Grid {
        id: "ground",
        title: "Ground forces",
        kinds: &[ClinicalGroup::Ground],
        note: "Ground reaction forces on the foot, in body weights.",
    },
];

/// Moments shown above the power of the same joint.
const SAGITTAL: [&str; 3] = ["hip_flexion_moment", "knee_flexion_moment", "ankle_dorsiflexion_moment"];
/// Moments of the frontal plane, shown above those of the transverse plane.
const FRONTAL: [&str; 3] = ["hip_adduction_moment", "knee_adduction_moment", "ankle_inversion_moment"];
/// Panels per row.
const COLUMNS: usize = 3;

/// All grids for which the files contain data.
pub(super) fn groups(
    results: &Results,
    size: &BodySize,
    quantities: &[ClinicalQuantity],
    block: &mut Block,
) -> Vec<Group> {
    GRIDS.iter().map(|grid| group(results, size, grid, quantities, block)).collect()
}

/// The quantities in the files, over cycles or over time.
pub(super) fn quantities(results: &Results) -> Vec<ClinicalQuantity> {
    let names = names(results);
    clinical_quantities(&results.clinical_names(), |name| names.contains(name))
}

fn group(results: &Results, size: &BodySize, grid: &Grid, quantities: &[ClinicalQuantity], block: &mut Block) -> Group {
    let mut of_grid: Vec<_> = quantities.iter().filter(|quantity| grid.kinds.contains(&quantity.group)).collect();
    of_grid.sort_by_key(|quantity| place(quantity));
    let empty = format!("The files contain no data for this: {}.", lacking(results, grid));
    let panels: Vec<Panel> =
        of_grid.into_iter().map(|quantity| curves::panel(results, size, quantity, &empty, block)).collect();
    let note = match panels.is_empty() {
        true => format!("No data to show: {}.", lacking(results, grid)),
        false => grid.note.to_owned(),
    };
    Group { id: grid.id.to_owned(), title: grid.title.to_owned(), note: Some(note), columns: COLUMNS, panels }
}

/// Puts sagittal moments above the powers of the same joints; the frontal and the transverse plane follow.
fn place(quantity: &ClinicalQuantity) -> usize {
    match quantity.group {
        ClinicalGroup::Moments if SAGITTAL.contains(&quantity.id) => 0,
        ClinicalGroup::Moments if FRONTAL.contains(&quantity.id) => 2,
        ClinicalGroup::Moments => 3,
        ClinicalGroup::Powers => 1,
        ClinicalGroup::Kinematics | ClinicalGroup::Ground => 0,
    }
}

/// Why a grid has no data.
fn lacking(results: &Results, grid: &Grid) -> &'static str {
    match grid.id {
        "ground" if results.source == PageSource::None => "the run was made without ground forces",
        "ground" => "the folder has no grf.mot",
        "kinetics" if results.moments.is_none() => "the folder has no moments.sto",
        _ => "the model has no joints of legs and trunk",
    }
}

/// Names of quantities in the style of `cycles.csv`, from that file and from all tables over time.
fn names(results: &Results) -> BTreeSet<String> {
    let stem = |column: &str| Side::split_name(column).map_or_else(|| column.to_owned(), |(_, stem)| stem);
    let over_time = results.kinematics.names().iter().map(|column| format!("{}_angle", stem(column)));
    let tables = [&results.moments, &results.powers].into_iter().flatten();
    let forces = tables.flat_map(|table| table.names().iter().map(|column| stem(column)));
    let ground = results.ground.iter().flat_map(|_| curves::GROUND_AXES.iter().map(|(name, _)| (*name).to_owned()));
    let over_cycles = results.curves.iter().map(|curve| curve.quantity.clone());
    let clinical = results.clinical.iter().flat_map(|table| table.names().iter().map(|column| stem(column)));
    let derived = clinical
        .flat_map(|name| [format!("{name}_angle"), name])
        .filter(|name| KNEE_ANGLES.contains(&name.as_str()) || JOINT_MOMENTS.iter().any(|(known, _)| known == name));
    over_time.chain(forces).chain(ground).chain(over_cycles).chain(derived).collect()
}
