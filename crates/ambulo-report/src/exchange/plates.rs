//! Writes force plates as ground reactions for OpenSim.

use ambulo::ground::plates::FeetOnPlates;
use ambulo::model::Side;
use ambulo::motion::PlateRecording;
use ambulo_formats::Error;
use ambulo_formats::external_loads::{ExternalForce, ExternalLoads};
use ambulo_formats::table::Table;
use ambulo_results::ground_columns;

/// Plates whose heights differ by more have no common surface [m].
const SAME_HEIGHT: f64 = 0.005;

/// Measured forces by foot, in the form that OpenSim reads.
#[derive(Debug, Clone, PartialEq)]
pub struct GroundReactions {
    /// `time`, then for both sides `ground_force_{s}_v`, `ground_force_{s}_p`, `ground_torque_{s}_` with x, y, z.
    pub table: Table,
    /// The bodies they act on: `calcn_r` and `calcn_l`. The name of the data file is not set yet.
    pub loads: ExternalLoads,
    /// Whether the loaded plates have the same height. If not, the centres of pressure are at the height of the first.
    pub is_level: bool,
}

/// Forces of plates in world axes, assigned to the feet on them. `None` without plates.
///
/// # Errors
/// None that tests let through: the names of the columns are fixed.
pub fn ground_reactions(plates: &[PlateRecording], feet: &FeetOnPlates) -> Result<Option<GroundReactions>, Error> {
    let Some(first) = plates.first() else { return Ok(None) };
    let heights: Vec<f64> = plates.iter().map(|plate| plate.center().y).collect();
    let is_level = heights.iter().all(|height| (height - heights[0]).abs() <= SAME_HEIGHT);
    let found = feet.loads_by_foot(plates, heights[0]);
    let time = ("time".to_owned(), first.times.clone());
    let columns = std::iter::once(time).chain(ground_columns(&found, first.times.len())).collect();
    let mut table = Table::new("Ground Reactions", columns)?;
    table.in_degrees = Some(false);
    let force = |side: Side| {
        let (letter, name) = (side.letter(), format!("{side}_ground_reaction"));
        ExternalForce::with_prefix(&name, &format!("calcn_{letter}"), &format!("ground_force_{letter}_"))
    };
    let forces = Side::BOTH.map(force).to_vec();
    let loads = ExternalLoads { name: "ground_reactions".into(), datafile: None, forces };
    Ok(Some(GroundReactions { table, loads, is_level }))
}
