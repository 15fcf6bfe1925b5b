//! Columns of a stream.

use crate::prediction_files::deviation_columns;
use crate::tables::ground_columns;
use crate::units::unit_of;
use crate::{GROUND, GROUND_SD, MOMENTS};
use ambulo::ground::BodyForces;
use ambulo::ground::stream::{FootLoad, StreamFrame};
use ambulo::model::{Model, Side};

/// Names and units of the columns of a stream: those of `grf.mot`, `grf_sd.mot` and `moments.sto`, one after the other.
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

/// The values of these columns in one frame; those of an unloaded foot are zero.
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

#[cfg(test)]
mod tests {
    use super::*;
    use ambulo::ground::stream::LoadDeviation;
    use ambulo::model::anthropometry::{Build, SegmentTable};
    use ambulo::spatial::Vec3;

    #[test]
    fn a_row_has_the_values_of_its_frame_in_the_columns_of_their_names() {
        let build = Build { table: SegmentTable::DeLevaMale, mass: 75.0, height: 1.75, toe_joint: false };
        let model = build.human().unwrap().model;
        let deviation =
            LoadDeviation { force: Vec3::new(1.0, 2.0, 3.0), center: Vec3::new(0.1, 0.2, 0.3), free_moment: 0.5 };
        let foot = |side, center_of_pressure| FootLoad {
            side,
            force: Vec3::new(10.0, 700.0, -5.0),
            moment: Vec3::zeros(),
            center_of_pressure,
            free_moment: 4.0,
            deviation,
        };
        let count = model.coordinates().len();
        let frame = StreamFrame {
            frame: 0,
            time_s: 0.0,
            // The other order than that of the columns.
            feet: [foot(Side::Left, None), foot(Side::Right, Some(Vec3::new(0.4, 0.0, 0.1)))],
            generalized: (0..count).map(|k| k as f64).collect(),
        };
        let (columns, row) = (stream_columns(&model), stream_row(&model, &frame));
        assert_eq!(columns.len(), row.len());
        let cell = |name: &str| {
            let place = columns.iter().position(|(column, _)| column == name).unwrap();
            (row[place], columns[place].1)
        };
        assert_eq!(cell("ground_force_r_vy"), (700.0, "N"));
        assert_eq!(cell("ground_force_r_px"), (0.4, "m"));
        assert_eq!(cell("ground_torque_r_y"), (4.0, "N.m"));
        assert_eq!(cell("ground_force_l_vy"), (0.0, "N"), "the left foot is not loaded");
        assert_eq!(cell("ground_force_l_vy_sd"), (2.0, "N"));
        assert_eq!(cell("ground_force_r_pz_sd"), (0.3, "m"));
        assert_eq!(cell("ground_torque_l_y_sd"), (0.5, "N.m"));
        let last = model.force_names().pop().unwrap();
        assert_eq!(cell(&last), ((count - 1) as f64, "N.m"));
    }
}
