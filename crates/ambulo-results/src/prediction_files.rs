//! Files of a run with predicted ground forces: standard deviations and measured forces.

use crate::files::OutputFile;
use crate::tables;
use crate::{GROUND_MEASURED, GROUND_SD, Keep};
use ambulo::analysis::Analysis;
use ambulo::ground::predict::{FootDeviation, Prediction};
use ambulo::model::{Model, Side};
use ambulo::spatial::Vec3;

/// `grf_sd.mot` and, with force plates, `grf_measured.mot`, at the instants of `kinematics.mot`, as far as `keep`
/// includes them. `analysis` is the one with the predicted forces, `measured` the one with plate forces.
#[must_use]
pub(crate) fn prediction_files<'a>(
    model: &'a Model,
    analysis: &'a Analysis,
    prediction: &'a Prediction,
    measured: Option<&'a Analysis>,
    keep: &Keep,
) -> Vec<OutputFile<'a>> {
    let deviations = move || {
        let columns = deviation_columns(&prediction.deviations, analysis.trajectory.grid().frames);
        tables::table("Standard Deviations of Ground Reactions", analysis, columns)
    };
    let mut files = vec![OutputFile::storage_by(GROUND_SD, deviations)];
    if let Some(measured) = measured {
        files.push(OutputFile::storage_by(GROUND_MEASURED, move || tables::ground(model, measured, &None)));
    }
    files.retain(|file| keep.includes(&file.name));
    files
}

/// `ground_force_{s}_vx_sd` .. `vz_sd` [N], `px_sd` .. `pz_sd` [m], `ground_torque_{s}_y_sd` [N.m]; zeros while a foot
/// is unloaded.
#[must_use]
pub fn deviation_columns(deviations: &[FootDeviation], frames: usize) -> Vec<(String, Vec<f64>)> {
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
