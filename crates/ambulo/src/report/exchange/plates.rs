//! Force plates as OpenSim's ground reactions.

use crate::ground::BodyForces;
use crate::ground::plates::FeetOnPlates;
use crate::model::{BodyId, Side};
use crate::motion::{ForceRecording, PlateRecording};
use crate::report::tables::ground_columns;
use crate::spatial::Vec3;
use ambulo_formats::Error;
use ambulo_formats::external_loads::{ExternalForce, ExternalLoads};
use ambulo_formats::table::Table;

/// Plates of different height than this give no common surface [m].
const SAME_HEIGHT: f64 = 0.005;

/// What plates measured, by foot, as OpenSim's tools read it.
#[derive(Debug, Clone, PartialEq)]
pub struct GroundReactions {
    /// `time`, then for both sides `ground_force_{s}_v`, `ground_force_{s}_p`, `ground_torque_{s}_` with x, y, z.
    pub table: Table,
    /// Which body they act on: `calcn_r` and `calcn_l`. The name of the data file is still missing.
    pub loads: ExternalLoads,
    /// Whether the loaded plates have one height. If not, the centres of pressure stand at the height of the first.
    pub is_level: bool,
}

/// The forces of plates in the world's axes, each at the foot that stood on it. `None` without plates.
///
/// # Errors
/// None that tests let through: the names of the columns are fixed.
pub fn ground_reactions(plates: &[PlateRecording], feet: &FeetOnPlates) -> Result<Option<GroundReactions>, Error> {
    let Some(first) = plates.first() else { return Ok(None) };
    // The bodies are only told apart; no model is there yet.
    let bodies = [BodyId(0), BodyId(1)];
    let recordings = feet.recordings(plates, bodies);
    let heights: Vec<f64> = plates.iter().map(|plate| plate.center().y).collect();
    let is_level = heights.iter().all(|height| (height - heights[0]).abs() <= SAME_HEIGHT);
    let mut found = Vec::new();
    for (side, body) in Side::BOTH.into_iter().zip(bodies) {
        let own: Vec<&ForceRecording> = recordings.iter().filter(|recording| recording.body == body).collect();
        let (force, moment) = sum(&own, first.times.len());
        found.push((side, BodyForces::on_level_ground(body, &force, &moment, Vec3::y(), heights[0])));
    }
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

/// Force and its moment about the world's origin.
fn sum(recordings: &[&ForceRecording], samples: usize) -> (Vec<Vec3>, Vec<Vec3>) {
    let (mut force, mut moment) = (vec![Vec3::zeros(); samples], vec![Vec3::zeros(); samples]);
    for recording in recordings {
        let loads = recording.force.iter().zip(&recording.point).zip(&recording.moment);
        for ((total, about), ((f, point), m)) in force.iter_mut().zip(&mut moment).zip(loads) {
            *total += f;
            *about += m + point.cross(f);
        }
    }
    (force, moment)
}
