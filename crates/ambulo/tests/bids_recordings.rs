//! BIDS motions as markers and as coordinates: units, frame rates, bad channels, refusals.

use crate::anatomy_models;
use ambulo::findings::{Code, Findings};
use ambulo::motion::{BidsError, coordinates_from_bids, is_bids_markers, markers_from_bids};
use ambulo::spatial::Vec3;
use ambulo_formats::bids_motion::BidsMotion;

/// A motion with these channels: name, component, type, tracked point, unit, status.
fn motion(channels: &[[&str; 6]], rows: &[&[f64]]) -> BidsMotion {
    let heading = "name\tcomponent\ttype\ttracked_point\tunits\tstatus\n";
    let lines: String = channels.iter().map(|channel| channel.join("\t") + "\n").collect();
    let row = |values: &&[f64]| values.iter().map(f64::to_string).collect::<Vec<_>>().join("\t") + "\n";
    let rows: String = rows.iter().map(row).collect();
    BidsMotion::read(rows.as_bytes(), (heading.to_owned() + &lines).as_bytes()).unwrap()
}

/// Four tracked points in different units; the third has its components in another order, the last is bad.
fn markers() -> BidsMotion {
    let axes = ["x", "y", "z"];
    let point = |name: &'static str, unit: &'static str, status: &'static str, axes: [&'static str; 3]| {
        axes.map(|axis| ["c", axis, "POS", name, unit, status])
    };
    let channels = [
        point("LASI", "mm", "good", axes),
        point("RASI", "cm", "good", axes),
        point("LPSI", "m", "good", ["z", "x", "y"]),
        point("RPSI", "m", "bad", axes),
    ]
    .concat();
    let row: Vec<f64> = (1..=12).map(f64::from).collect();
    motion(&channels, &[&row, &row])
}

#[test]
fn tracked_points_are_markers_in_metres() {
    let findings = &mut Findings::default();
    let bids = markers();
    assert_eq!(is_bids_markers(&bids), Ok(true));
    let found = markers_from_bids(&bids, Some(50.0), "walk", findings).unwrap();
    assert_eq!((found.rate_hz, &found.times[..]), (50.0, &[0.0, 0.02][..]));
    let at = |name: &str| found.marker(name).unwrap().positions[1];
    assert!((at("LASI") - Vec3::new(0.001, 0.002, 0.003)).norm() < 1e-15);
    assert!((at("RASI") - Vec3::new(0.04, 0.05, 0.06)).norm() < 1e-15);
    assert_eq!(at("LPSI"), Vec3::new(8.0, 9.0, 7.0));
    assert!(at("RPSI").x.is_nan() && findings.has(Code::FileOdd), "{findings:?}");
    assert_eq!(markers_from_bids(&bids, None, "walk", findings), Err(BidsError::NoRate));
}

#[test]
fn joint_angles_are_coordinates_of_a_model() {
    let model = anatomy_models::demo();
    let channels = [
        ["time", "n/a", "LATENCY", "n/a", "s", "good"],
        ["knee_angle_r", "n/a", "JNTANG", "RightKnee", "deg", "good"],
        ["angle_7", "n/a", "JNTANG", "hip_flexion_r", "rad", "good"],
        ["pelvis_ty", "y", "POS", "pelvis", "cm", "good"],
    ];
    let bids = motion(&channels, &[&[0.5, -90.0, 0.25, 92.0], &[0.6, -45.0, 0.5, 93.0]]);
    assert_eq!(is_bids_markers(&bids), Ok(false));
    let found = coordinates_from_bids(&model, &bids, None, "walk", &mut Findings::default()).unwrap();
    let value = |name: &str| found.column(model.coordinate(name).unwrap()).unwrap()[0];
    assert_eq!((&found.times[..], value("hip_flexion_r")), (&[0.5, 0.6][..], 0.25));
    assert!((value("knee_angle_r") + std::f64::consts::FRAC_PI_2).abs() < 1e-15);
    assert!((value("pelvis_ty") - 0.92).abs() < 1e-15);
    let mut odd = bids;
    odd.channels[1].units = "turns".into();
    let refused = coordinates_from_bids(&model, &odd, None, "walk", &mut Findings::default()).unwrap_err().to_string();
    assert!(
        refused.contains("`knee_angle_r` of the type JNTANG has the unit `turns`; expected rad or deg"),
        "{refused}"
    );
    odd.channels.iter_mut().for_each(|channel| channel.kind = "ACCEL".into());
    assert_eq!(is_bids_markers(&odd), Err(BidsError::Nothing { found: "ACCEL".into() }));
}
