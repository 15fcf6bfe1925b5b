//! Ground forces as a table: which columns act on which body, and in which axes they are.

use super::error::StudyError;
use super::source::ForceTable;
use crate::findings::{Code, Findings};
use crate::model::{BySide, Model};
use crate::motion::{ForceRecording, force_recordings};
use crate::spatial::{Mat3, Vec3};
use ambulo_formats::external_loads::{ExternalForce, ExternalLoads};
use ambulo_formats::table::Table;

/// Column prefixes that laboratories use, right and left; tried in this order when nothing was said.
const USUAL_PREFIXES: [(&str, &str); 4] = [
    ("ground_force_r_", "ground_force_l_"),
    ("R_ground_force_", "L_ground_force_"),
    ("ground_force_", "1_ground_force_"),
    ("ground_force_", "l_ground_force_"),
];

/// The forces of a table on the bodies of a model.
pub(super) fn forces_of_table(
    model: &Model,
    ForceTable { table, loads }: &ForceTable,
    findings: &mut Findings,
) -> Result<Vec<ForceRecording>, StudyError> {
    let usual;
    let loads = match loads {
        Some(loads) => loads,
        None => {
            usual = usual_loads(model, table, findings)?;
            &usual
        }
    };
    force_recordings(model, loads, table, findings).map_err(StudyError::ForceTable)
}

/// Brings forces of a table to the axes of the world: from those of the markers, or not at all where they are upright as they are.
pub(super) fn turn_to_world(plates: &mut [ForceRecording], world_from_lab: &Mat3, findings: &mut Findings) {
    /// Share of the mean force that points up where the axes are right: walking sums to nearly none forwards and sideways.
    const UPRIGHT: f64 = 0.9;
    let sum: Vec3 = plates.iter().flat_map(|p| &p.force).filter(|f| f.iter().all(|x| x.is_finite())).sum();
    let is_upright = |sum: &Vec3| sum.y > UPRIGHT * sum.norm();
    if is_upright(&sum) && !is_upright(&(world_from_lab * sum)) {
        findings.report(
            Code::LoadsWorldAxes,
            "the forces of the table are not in the axes of the markers; they are taken as x forward, y up, z right",
        );
        return;
    }
    plates.iter_mut().for_each(|plate| plate.rotate(world_from_lab));
}

/// Usual prefixes on the model's feet, reported as a finding.
fn usual_loads(model: &Model, table: &Table, findings: &mut Findings) -> Result<ExternalLoads, StudyError> {
    let has = |prefix: &str| table.column(&format!("{prefix}vx")).is_some();
    let columns = USUAL_PREFIXES.iter().find(|(right, left)| has(right) && has(left));
    let feet = model.anatomy().feet().map(|feet| feet.map(|body| model.bodies()[body.index()].name.as_str()));
    let (Some((right_prefix, left_prefix)), Some(BySide { right: right_foot, left: left_foot })) = (columns, feet)
    else {
        return Err(StudyError::ForceColumns { found: table.names().iter().map(ToString::to_string).collect() });
    };
    let message =
        format!("taken as ground forces: `{right_prefix}...` on {right_foot}, `{left_prefix}...` on {left_foot}");
    findings.report(Code::LoadsGuessed, message);
    let forces = vec![
        ExternalForce::with_prefix("right", right_foot, right_prefix),
        ExternalForce::with_prefix("left", left_foot, left_prefix),
    ];
    Ok(ExternalLoads { name: "feet".into(), datafile: None, forces })
}
