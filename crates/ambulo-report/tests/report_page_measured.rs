//! The page of a prediction compared with plates, and of a recorded person.

use crate::report_pages::{Shown, analysed, predicted, with_summary};
use crate::shared_data;
use ambulo_formats::external_loads::ExternalLoads;
use ambulo_formats::table::Table;
use serde_json::json;

#[test]
fn a_prediction_is_drawn_over_the_plates_with_its_uncertainty() {
    let files = predicted();
    let shown = Shown::of(&files);
    assert_eq!(
        (shown.session()["source"].as_str(), shown.header("Ground forces").as_str()),
        (Some("predicted"), "predicted from the motion")
    );
    let weight = {
        let summary: serde_json::Value = serde_json::from_slice(&files["summary.json"]).unwrap();
        // The model's gravity.
        summary["mass_kg"].as_f64().unwrap() * 9.80665
    };
    let panel = shown.panel("plates_vertical");
    let traces = panel["traces"].as_array().unwrap();
    let table = |file: &str| Table::read_storage(&files[file]).unwrap().0;
    for (role, file) in [("main", "grf.mot"), ("measured", "grf_measured.mot")] {
        let trace = traces.iter().find(|trace| trace["role"] == role && trace["side"] == "l").unwrap();
        assert_eq!(trace["origin"]["file"], file);
        let largest = |values: &[f64]| values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let (shown, expected) =
            (largest(&shown.series(&trace["values"])), largest(table(file).column("ground_force_l_vy").unwrap()));
        assert!((shown * weight / expected - 1.0).abs() < 1e-4, "{role}: {shown} BW of {expected} N");
        assert_eq!(trace["sd"].is_object(), role == "main", "only the prediction is uncertain");
    }
    let main = traces.iter().find(|trace| trace["role"] == "main" && trace["side"] == "l").unwrap();
    let (sd, deviations) = (shown.series(&main["sd"]), table("grf_sd.mot"));
    let expected = deviations.column("ground_force_l_vy_sd").unwrap();
    assert!(sd.iter().zip(expected).all(|(sd, expected)| (sd * weight - expected).abs() < 1e-3 * weight));
    // While a foot is in the air, it has no centre of pressure.
    let center = &shown.panel("center_of_pressure_x")["traces"].as_array().unwrap()[0];
    let (center, force) = (shown.series(&center["values"]), table("grf.mot"));
    let loaded = force.column("ground_force_r_vy").unwrap();
    assert!(center.iter().zip(loaded).all(|(x, force)| x.is_nan() == (force.abs() < 1e-12)));
    assert!(center.iter().any(|x| x.is_nan()) && center.iter().any(|x| x.is_finite()));
    assert!(!shown.misses("No force plates"));
}

#[test]
fn a_prediction_alone_says_that_nothing_measured_it() {
    let mut files = predicted();
    files.remove("grf_measured.mot");
    let shown = Shown::of(&files);
    assert!(shown.misses("No force plates"));
    let roles = shown.panel("plates_vertical")["traces"].as_array().unwrap().clone();
    assert!(roles.iter().all(|trace| trace["role"] == "main"));
}

#[test]
fn metrics_markers_and_plates_are_tables_of_quality() {
    let mut files = predicted();
    with_summary(&mut files, |summary| {
        let component = json!({"rmse_bw": 0.0312, "rrmse": 0.041, "r": 0.991, "band": {"holds": 0.93,
            "half_width_over_rmse": 2.0}});
        let center = json!({"samples": 60, "missing": 2, "fore_aft_mm": 12.4, "lateral_mm": 5.6,
            "fore_aft_weighted_mm": 11.0, "lateral_weighted_mm": 5.0});
        summary["comparison"] = json!({"mass_kg": 75.0, "window_s": null, "feet": [{"side": "l", "stances_s": [[0.1,
            0.8]], "samples": 70,
            "vertical": component, "fore_aft": component, "lateral": component,
            "center_of_pressure": center}], "moments": [], "events": [{"kind": "strike", "pairs": 2, "missed": 1,
                "extra": 0,
            "mean_absolute_ms": 14.0, "bias_ms": -3.0},
            {"kind": "off", "pairs": 0, "missed": 0, "extra": 0, "mean_absolute_ms": null, "bias_ms": null}]});
        summary["subject"] = json!({"axes": "", "turn_deg": null, "marker_sets": [], "segments": [],
            "plate_corners_m": [],
            "instrumented_windows_s": [], "events": [], "markers": {"rms_mm": 25.0, "frames_not_converged": 0,
                "errors": [
                {"name": "LASI", "rms_mm": 4.0, "max_mm": 9.0, "frames_seen": 291, "frames_refused": 0},
                {"name": "RASI", "rms_mm": 44.0, "max_mm": 60.0, "frames_seen": 250, "frames_refused": 3}]},
            "plates": [{"plate": "plate 1", "side": "l", "start_s": 0.1, "end_s": 0.8, "peak_n": 700.0,
                "quality": "partial",
                "reason": "the toes stand beside it"}], "assumptions": ["arms hang"]});
    });
    let shown = Shown::of(&files);
    assert_eq!(shown.row("agreement", "left")[1..4], ["vertical", "3.1", "4.1"]);
    assert_eq!(shown.row("centers", "left")[1..3], ["12", "6"]);
    assert_eq!(shown.row("events", "prediction")[3..5], ["2", "1"]);
    assert_eq!(shown.row("markers", "RASI")[1..], ["-", "44.0", "60.0", "250", "41", "3"]);
    assert_eq!(
        shown.row("plates", "plate 1")[1..],
        ["left", "0.10", "0.80", "700", "partial", "the toes stand beside it"]
    );
    let quality = &shown.session()["quality"];
    assert_eq!(quality["assumptions"], json!(["arms hang"]));
    let tables = quality["tables"].as_array().unwrap();
    let markers = tables.iter().find(|table| table["id"] == "markers").unwrap();
    assert_eq!(markers["rows"][0][0]["text"], "RASI", "the largest error first");
    assert_eq!((&markers["rows"][0][2]["outside"], &markers["rows"][1][2]["outside"]), (&json!(true), &json!(false)));
    let fact = quality["facts"].as_array().unwrap().iter().find(|fact| fact["value"] == "25.0 mm").unwrap();
    assert_eq!(fact["good"], false);
}

#[test]
fn a_recorded_person_walks_as_people_do() {
    let Some(data) = shared_data::data() else { return };
    let folder = data.join("opensim-gait2392-subject01");
    let read = |name: &str| std::fs::read(folder.join(name)).unwrap();
    let loads = ExternalLoads::read(&read("subject01_walk1_grf.xml")).unwrap().0;
    let files = analysed(
        &read("subject01_simbody.osim"),
        &read("subject01_walk1_ik.mot"),
        &read("subject01_walk1_grf.mot"),
        &loads,
    );
    let shown = Shown::of(&files);
    let mean = |table: &str, row: &str| (shown.value(table, row, 2) + shown.value(table, row, 3)) / 2.0;
    assert!((55.0..75.0).contains(&mean("extracted", "Knee flexion, maximum in swing")));
    assert!((1.0..2.0).contains(&mean("extracted", "Ankle plantarflexor moment, peak")));
    assert!((0.9..1.3).contains(&mean("extracted", "Vertical force, first peak")));
    assert!((58.0..68.0).contains(&mean("time_distance", "Stance")));
    assert!((0.4..0.9).contains(&mean("time_distance", "Step length")), "on the belt");
    assert!(shown.header("Walking direction").contains("treadmill"));
    let band = &shown.panel("knee_flexion_angle")["band"];
    let (normal, found) =
        (shown.series(&band["mean"]), shown.series(&shown.panel("knee_flexion_angle")["means"][0]["values"]));
    let away =
        normal.iter().zip(found.iter().step_by(2)).map(|(a, b)| (a - b).powi(2)).sum::<f64>() / normal.len() as f64;
    assert!(away.sqrt() < 15.0, "{} deg from the band's mean; with the other sign it would be 50", away.sqrt());
}
