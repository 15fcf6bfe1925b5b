//! Files of a run with predicted ground forces: standard deviations and measured forces.

use crate::Keep;
use crate::files::OutputFile;
use crate::tables::{self, Column};
use ambulo::analysis::PredictedAnalysis;
use ambulo::ground::predict::FootDeviation;
use ambulo::model::{Model, Side};
use ambulo::spatial::Vec3;
use ambulo_formats::Error;

const DEVIATIONS: &str = "grf_sd.mot";
const MEASURED: &str = "grf_measured.mot";

/// `grf_sd.mot` and, with force plates, `grf_measured.mot`, at the instants of `kinematics.mot`, as far as `keep` includes them.
///
/// # Errors
/// Column names that a table cannot store, numbers that are not finite.
pub fn prediction_files(model: &Model, predicted: &PredictedAnalysis, keep: &Keep) -> Result<Vec<OutputFile>, Error> {
    let mut files = Vec::new();
    if keep.includes(DEVIATIONS) {
        let frames = predicted.analysis.trajectory.grid().frames;
        let deviations = deviation_columns(&predicted.prediction.deviations, frames);
        let deviations = tables::table("Standard Deviations of Ground Reactions", &predicted.analysis, deviations)?;
        files.push(OutputFile::storage(DEVIATIONS, deviations)?);
    }
    if let Some(measured) = predicted.measured.as_ref().filter(|_| keep.includes(MEASURED)) {
        files.push(OutputFile::storage(MEASURED, tables::ground(model, measured)?)?);
    }
    Ok(files)
}

/// `ground_force_{s}_vx_sd` .. `vz_sd` [N], `px_sd` .. `pz_sd` [m], `ground_torque_{s}_y_sd` [N.m]; zeros while a foot is unloaded.
fn deviation_columns(deviations: &[FootDeviation], frames: usize) -> Vec<Column> {
    let mut columns = Vec::new();
    for side in Side::BOTH {
        let letter = side.letter();
        let foot = deviations.iter().find(|deviation| deviation.side == side);
        let vectors = |pick: &dyn Fn(&FootDeviation) -> &Vec<Vec3>, axis: usize| {
            foot.map_or_else(|| vec![0.0; frames], |foot| pick(foot).iter().map(|v| v[axis]).collect())
        };
        for (k, axis) in ["x", "y", "z"].into_iter().enumerate() {
            columns.push((format!("ground_force_{letter}_v{axis}_sd"), vectors(&|foot| &foot.force, k)));
        }
        for (k, axis) in ["x", "y", "z"].into_iter().enumerate() {
            columns.push((format!("ground_force_{letter}_p{axis}_sd"), vectors(&|foot| &foot.center, k)));
        }
        let free = foot.map_or_else(|| vec![0.0; frames], |foot| foot.free_moment.clone());
        columns.push((format!("ground_torque_{letter}_y_sd"), free));
    }
    columns
}
