//! Quality information on the page: verdicts on part of a motion, friction, uncertainty bands of predictions.

use crate::report_pages::{Shown, predicted, recorded, with_summary};
use ambulo::analysis::LEAST_MARKER_SHARE;
use ambulo_formats::table::Table;
use serde_json::{Value, json};

// ---- limits of a verdict ----

#[test]
fn a_verdict_on_part_of_the_motion_says_so() {
    let mut files = recorded();
    let whole = Shown::of(&files);
    let sentence = |shown: &Shown| shown.session()["feasibility"]["sentence"].as_str().unwrap().to_owned();
    let fact = |shown: &Shown| {
        let facts = shown.session()["quality"]["facts"].as_array().unwrap().clone();
        facts.into_iter().find(|fact| fact["label"] == "Residual force, RMS").unwrap()
    };
    assert!(fact(&whole)["good"].is_boolean() && fact(&whole)["allowed"].is_string());
    let judge = |summary: &mut Value, state: &str, unmeasured: usize, residual_bw: f64| {
        let range = json!({"check": "range", "quantity": "hip_flexion_r", "at_s": 0.1, "value": 3.0, "limit": 9.0,
            "unit": "deg", "share": 0.3});
        summary["verdict"] = json!({"state": state, "judged_share": 1.0, "undecided": [], "reasons": [],
            "closest": [range], "not_judged": [], "frames": 100, "frames_unmeasured": unmeasured, "frames_predicted": 0,
                "frames_predicted": 0, "mass_kg": 75.0, "height_m": 1.75});
        summary["residual"]["force_rms_bw"] = json!(residual_bw);
    };
    let feasible = "A person of 75.0 kg and 1.75 m could do this: all checks that could be made passed.";
    let part = "44 % of the time was not judged, because a foot may have been on ground whose force is not known";
    let trust = "the residual force is 63 % of body weight: motion, forces and body are not consistent, so do not rely \
        on the moments.";
    with_summary(&mut files, |summary| judge(summary, "feasible", 0, 0.05));
    assert_eq!(sentence(&Shown::of(&files)), feasible);
    for (unmeasured, residual_bw, ends) in [
        (44, 0.05, format!("but {part}.")),
        (0, 0.63, format!("but {trust}")),
        (44, 0.63, format!("but {part}; {trust}")),
    ] {
        with_summary(&mut files, |summary| judge(summary, "feasible", unmeasured, residual_bw));
        let found = sentence(&Shown::of(&files));
        assert!(found.starts_with("All checks passed for a person of 75.0 kg"), "{found}");
        assert!(found.ends_with(&ends) && !found.contains("could do"), "{found}");
    }
    with_summary(&mut files, |summary| {
        judge(summary, "not_judged", 44, 0.05);
        summary["verdict"]["undecided"] = json!(["ground forces are known in 56 % of the frames; 90 % are needed"]);
    });
    let found = sentence(&Shown::of(&files));
    assert!(found.starts_with("Not judged for a person of 75.0 kg") && found.contains("56 % of the frames"), "{found}");
    assert!(!found.contains("could do"), "{found}");
    assert_eq!(Shown::of(&files).session()["feasibility"]["state"], "not_judged");
    with_summary(&mut files, |summary| judge(summary, "infeasible", 0, 0.63));
    let found = sentence(&Shown::of(&files));
    assert!(
        found.contains("could not do this") && found.contains("The residual force is 63 % of body weight"),
        "{found}"
    );
}

#[test]
fn without_ground_forces_there_is_no_verdict_on_the_whole_motion() {
    let mut files = recorded();
    for file in ["grf.mot", "events.csv", "cycles.csv"] {
        files.remove(file);
    }
    let range = json!({"check": "range", "quantity": "hip_flexion_r", "at_s": 0.1, "value": 3.0, "limit": 9.0,
        "unit": "deg", "share": 0.3});
    with_summary(&mut files, |summary| {
        summary["ground"]["source"] = json!("none");
        summary["speed_m_s"] = Value::Null;
        summary["verdict"] = json!({"state": "not_judged", "judged_share": 0.0, "reasons": [],
            "undecided": ["the ground forces are unknown"], "closest": [range], "not_judged": [], "frames": 100,
                "frames_unmeasured": 0, "frames_predicted": 0, "mass_kg": 75.0, "height_m": 1.75});
        summary["residual"]["force_rms_bw"] = json!(1.02);
    });
    let shown = Shown::of(&files);
    assert!(shown.session()["feasibility"].is_null());
    assert!(shown.misses("No verdict: without ground forces only ranges of motion could be checked"));
    let quality = &shown.session()["quality"];
    assert!(quality["tables"].as_array().unwrap().iter().any(|table| table["id"] == "closest"));
    let facts = quality["facts"].as_array().unwrap();
    let residual = facts.iter().find(|fact| fact["label"] == "Residual force, RMS").unwrap();
    assert!(residual["good"].is_null() && residual["allowed"].is_null(), "{residual}");
}

// ---- quality ----

#[test]
fn the_share_of_used_markers_is_judged_by_the_limit_of_the_analysis() {
    let mut files = recorded();
    let least = (100.0 * LEAST_MARKER_SHARE).ceil() as usize;
    for (used, good) in [(least, true), (least - 1, false)] {
        with_summary(&mut files, |summary| {
            let markers =
                json!({"rms_mm": 10.0, "frames_not_converged": 0, "used": used, "recorded": 100, "errors": []});
            summary["subject"] = json!({"axes": "", "turn_deg": null, "marker_sets": [], "markers": markers,
                "segments": [], "plates": [], "plate_corners_m": [], "instrumented_windows_s": [], "events": [],
                "assumptions": []});
        });
        let facts = Shown::of(&files).session()["quality"]["facts"].as_array().unwrap().clone();
        let fact = facts.iter().find(|fact| fact["label"] == "Markers that the body follows").unwrap();
        assert_eq!((fact["good"].as_bool(), fact["value"].as_str()), (Some(good), Some(&*format!("{used} of 100"))));
        assert_eq!(fact["allowed"], format!("at least {:.0} %", 100.0 * LEAST_MARKER_SHARE));
    }
}

#[test]
fn friction_is_drawn_where_the_verdict_judges_it() {
    let mut files = recorded();
    let weight = {
        let mass: Value = serde_json::from_slice(&files["summary.json"]).unwrap();
        mass["mass"]["kg"].as_f64().unwrap() * 9.81
    };
    let table = Table::read_storage(&files["grf.mot"]).unwrap().0;
    // The left foot's load is put just below and just above the load from which on friction is judged.
    let columns = table.columns().map(|(name, values)| {
        let mut values = values.to_vec();
        if let Some(axis) = name.strip_prefix("ground_force_l_v") {
            for (row, share) in [(100, 0.095), (101, 0.105)] {
                values[row] = if axis == "y" { share * weight } else { 0.5 * share * weight };
            }
        }
        (name.to_owned(), values)
    });
    let mut changed = Table::new("changed", columns.collect()).unwrap();
    changed.in_degrees = Some(true);
    files.insert("grf.mot".to_owned(), changed.write_storage());
    let shown = Shown::of(&files);
    let traces = shown.panel("friction_use")["traces"].as_array().unwrap();
    let left = shown.series(&traces.iter().find(|trace| trace["side"] == "l").unwrap()["values"]);
    assert!(left[100].is_nan(), "{}", left[100]);
    assert!((left[101] - 0.5_f64.hypot(0.5)).abs() < 1e-3, "{}", left[101]);
    let groups = shown.session()["quality"]["groups"].as_array().unwrap();
    let note = groups.iter().find(|group| group["id"] == "friction").unwrap()["note"].as_str().unwrap();
    assert!(note.contains("shorter than 0.03 s"), "{note}");
}

#[test]
fn the_note_mentions_a_band_only_if_there_is_one() {
    let mut files = predicted();
    let overlay = |shown: &Shown| {
        let groups = shown.session()["quality"]["groups"].as_array().unwrap();
        let group = groups.iter().find(|group| group["id"] == "overlay").unwrap();
        let uncertain =
            group["panels"].as_array().unwrap().iter().flat_map(|panel| panel["traces"].as_array().unwrap());
        (group["note"].as_str().unwrap().to_owned(), uncertain.filter(|trace| trace["sd"].is_object()).count())
    };
    let (note, bands) = overlay(&Shown::of(&files));
    assert!(note.contains("± 1 standard deviation") && note.contains("± 1.645") && bands > 0, "{note} {bands}");
    files.remove("grf_sd.mot").unwrap();
    let (note, bands) = overlay(&Shown::of(&files));
    assert!(!note.contains("Band") && note.contains("no grf_sd.mot") && bands == 0, "{note} {bands}");
    files.remove("grf_measured.mot").unwrap();
    assert!(!overlay(&Shown::of(&files)).0.contains("Band"));
}
