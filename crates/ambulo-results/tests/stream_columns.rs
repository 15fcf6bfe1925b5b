//! Columns of a stream.

use ambulo::ground::stream::{FootLoad, LoadDeviation, StreamFrame};
use ambulo::model::Side;
use ambulo::model::anthropometry::{Build, SegmentTable};
use ambulo::spatial::Vec3;
use ambulo_results::{stream_columns, stream_row};

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
