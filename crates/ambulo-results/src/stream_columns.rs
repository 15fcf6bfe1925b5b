//! Columns of a stream.

use crate::prediction_files::deviation_columns;
use crate::tables::ground_columns;
use crate::units::unit_of;
use crate::{GROUND, GROUND_MEASURED, GROUND_SD, MOMENTS};
use ambulo::ground::BodyForces;
use ambulo::ground::stream::{FootLoad, StreamFrame};
use ambulo::model::{Model, Side};

/// Names and units of the columns of a stream: the columns of `grf.mot`, `grf_sd.mot` and `moments.sto`, in this order.
#[must_use]
pub fn stream_columns(model: &Model) -> Vec<(String, &'static str)> {
    let no_foot: [(Side, BodyForces); 0] = [];
    let ground = ground_columns(&no_foot, 0).into_iter().map(|(name, _)| (GROUND, name));
    let deviations = deviation_columns(&[], 0).into_iter().map(|(name, _)| (GROUND_SD, name));
    let moments = model.force_names().into_iter().map(|name| (MOMENTS, name));
    let with_unit = |(file, name): (&str, String)| {
        let unit = unit_of(file, &name, Some(model));
        (name, unit)
    };
    ground.chain(deviations).chain(moments).map(with_unit).collect()
}

/// File, name and unit of the columns of the tables that only a run with predicted ground forces writes.
#[must_use]
pub fn columns_of_predictions(model: &Model) -> Vec<(&'static str, String, &'static str)> {
    let no_foot: [(Side, BodyForces); 0] = [];
    let deviations = deviation_columns(&[], 0).into_iter().map(|(name, _)| (GROUND_SD, name));
    let measured = ground_columns(&no_foot, 0).into_iter().map(|(name, _)| (GROUND_MEASURED, name));
    let with_unit = |(file, name): (&'static str, String)| {
        let unit = unit_of(file, &name, Some(model));
        (file, name, unit)
    };
    deviations.chain(measured).map(with_unit).collect()
}

/// The values of these columns in one frame; values of an unloaded foot are zero.
#[must_use]
pub fn stream_row(model: &Model, frame: &StreamFrame) -> Vec<f64> {
    let mut row = Vec::new();
    for foot in in_order(frame) {
        let center = foot.and_then(|foot| Some((foot, foot.center_of_pressure?)));
        let load = center.map(|(foot, center)| [foot.force, center, model.up() * foot.free_moment]);
        row.extend(load.unwrap_or_default().iter().flatten());
    }
    for foot in in_order(frame) {
        let deviation = foot.map(|foot| foot.deviation);
        let vectors = deviation.map(|deviation| [deviation.force, deviation.center]).unwrap_or_default();
        row.extend(vectors.iter().flatten());
        row.push(deviation.map_or(0.0, |deviation| deviation.free_moment));
    }
    row.extend(&frame.generalized);
    row
}

/// The feet in the order of the columns.
fn in_order(frame: &StreamFrame) -> impl Iterator<Item = Option<&FootLoad>> {
    Side::BOTH.into_iter().map(|side| frame.feet.iter().find(|foot| foot.side == side))
}
