//! Texts of the page for unusual recordings: turns, two masses, no ground forces, single strides, missing files.

use crate::report_pages::{Files, Shown, analysed, keep_lines, predicted, recorded, with_summary};
use crate::shared_data;
use ambulo_formats::external_loads::ExternalLoads;
use ambulo_formats::table::Table;
use serde_json::{Value, json};

/// `subject` of the summary of a body that follows markers.
fn subject(axes: &str, turn_deg: Option<f64>) -> Value {
    json!({"axes": axes, "turn_deg": turn_deg, "marker_sets": [], "segments": [], "plates": [], "plate_corners_m": [],
        "instrumented_windows_s": [], "events": [], "assumptions": [],
        "markers": {"rms_mm": 10.0, "frames_not_converged": 0, "errors": []}})
}

/// The table of a motion with columns changed: name, values, all columns by name.
fn with_motion(files: &mut Files, change: impl Fn(&str, &[f64], &Table) -> Vec<f64>) {
    let table = Table::read_storage(&files["kinematics.mot"]).unwrap().0;
    let columns = table.columns().map(|(name, values)| (name.to_owned(), change(name, values, &table)));
    let mut changed = Table::new("Coordinates", columns.collect()).unwrap();
    changed.in_degrees = Some(true);
    files.insert("kinematics.mot".to_owned(), changed.write_storage());
}

fn note(shown: &Shown, table: &str) -> Value {
    let tables = shown.session()["tables"].as_array().unwrap();
    tables.iter().find(|known| known["id"] == table).unwrap()["note"].clone()
}

fn header_note(shown: &Shown, label: &str) -> String {
    let lines = shown.session()["header"].as_array().unwrap();
    let line = lines.iter().find(|line| line["label"] == label).unwrap();
    line["note"].as_str().unwrap_or_default().to_owned()
}

fn header_has(shown: &Shown, label: &str) -> bool {
    shown.session()["header"].as_array().unwrap().iter().any(|line| line["label"] == label)
}

// ---- predicted walks ----

#[test]
fn a_predicted_walk_says_what_it_was_asked_to_bear() {
    let size = json!({"rms": 0.0, "largest": 0.0});
    let walk = |conditions: Value| {
        let mut prediction = json!({"slope_percent": 0.0, "load_kg": 0.0, "strength": {}, "devices": [],
            "step_width_m": null,
            "metabolic_power_w_kg": 6.25, "cost_of_transport_j_kg_m": 5.0});
        for (key, value) in conditions.as_object().unwrap() {
            prediction[key] = value.clone();
        }
        let mut files = recorded();
        with_summary(&mut files, |summary| {
            summary["walk"] = json!({"gait": "free", "style": "knots", "mode": "predict", "figure": "de-leva-male",
                "speed_asked_m_s": 1.25, "speed_dimensionless": 0.4, "step_length_m": 0.7, "cadence_steps_min": 110.0,
                "cycle_s": 1.1, "leg_length_m": 0.9, "pace_changes": [], "trunk_torque_nm": size,
                "trunk_torque_nm_kg": size, "flight_s": 0.0, "impacts": 0, "largest_impact_n_s": 0.0,
                "speed_drift_m_s": 0.0, "simulator_hz": 100.0, "unsolved_steps": 0, "prediction": prediction});
        });
        Shown::of(&files)
    };
    let plain = walk(json!({}));
    assert_eq!(plain.header("Conditions"), "level ground, no load, full strength");
    assert!(!header_note(&plain, "Conditions").contains("slope"));
    assert!(header_note(&plain, "Conditions").starts_with("metabolic power 6.2 W/kg, cost of transport 5.0 J/kg/m"));
    let hard = walk(json!({"slope_percent": -8.000_000_000_000_002, "load_kg": 15.0, "load_place": "back",
        "strength": {"ankle_angle_r": 0.5}, "devices": ["knee_angle_l"], "step_width_m": 0.2}));
    assert_eq!(
        hard.header("Conditions"),
        "8 % downhill; load of 15 kg (back); strength of ankle_angle_r 50 %; devices at knee_angle_l; steps 0.2 m wide"
    );
    assert!(header_note(&hard, "Conditions").contains("axes of the slope"));
    assert!(!header_has(&Shown::of(&recorded()), "Conditions"));

    let device = |shown: &Shown| {
        let facts = shown.session()["glance"]["facts"].as_array().unwrap();
        facts.iter().find(|fact| fact["label"] == "Device").cloned()
    };
    assert_eq!(device(&plain), None);
    let at = |coordinate: &str, done: f64| {
        json!({"coordinate": coordinate, "device_j_kg": [0.1, -0.1], "body_j_kg": [done, -0.3],
            "body_without_device_j_kg": [0.4, -0.5]})
    };
    let work = json!([at("knee_angle_l", 0.2), at("ankle_angle_l", 0.2), at("knee_angle_r", 0.25)]);
    let helped = walk(json!({"devices": ["knee_angle_l"], "device_work": work,
        "metabolic_power_without_devices_w_kg": 6.5}));
    let shown = device(&helped).unwrap();
    assert_eq!(shown["value"], "metabolic power 6.25 W/kg, without it 6.50 (-3.8 %)");
    assert_eq!(
        shown["note"],
        "knee_angle_l and ankle_angle_l: the device does 0.100 and takes 0.100 J/kg in a cycle, muscles and tissue do \
         0.200 and take 0.300, without it 0.400 and 0.500; knee_angle_r: the device does 0.100 and takes 0.100 J/kg in \
         a cycle, muscles and tissue do 0.250 and take 0.300, without it 0.400 and 0.500"
    );
    let useless = walk(json!({"devices": ["knee_angle_l"], "metabolic_power_without_devices_w_kg": 6.2501}));
    assert_eq!(device(&useless).unwrap()["value"], "metabolic power 6.25 W/kg, without it 6.25 (+0.0 %)");
    let needed = walk(json!({"devices": ["knee_angle_l"], "no_walk_without_devices": "found no walk"}));
    assert_eq!(device(&needed).unwrap()["value"], "without it: found no walk");
}

// ---- paths ----

#[test]
fn a_turn_has_no_norms() {
    let mut files = recorded();
    let straight = Shown::of(&files);
    with_summary(&mut files, |summary| {
        summary["times_and_distances"]["turn_deg"] = json!(48.0);
        summary["times_and_distances"]["path_speed_m_s"] = json!(1.4);
    });
    let turning = Shown::of(&files);
    assert!(turning.misses("The path turns by 48 degrees") && !straight.misses("The path turns"));
    assert!(
        turning.panel("knee_flexion_angle")["band"].is_null()
            && straight.panel("knee_flexion_angle")["band"].is_object()
    );
    assert_eq!(turning.row("time_distance", "Stance")[5], "");
    assert!(turning.header("Speed").starts_with("1.40 m/s along the path"), "{}", turning.header("Speed"));
    assert!(!straight.header("Speed").contains("along the path"));
    assert!((turning.value("time_distance", "Speed along the path", 4) - 1.4).abs() < 1e-12);
}

#[test]
fn a_turn_that_the_laboratory_saw_counts() {
    let mut files = recorded();
    with_summary(&mut files, |summary| {
        summary["subject"] = subject("lab", Some(90.0));
    });
    let shown = Shown::of(&files);
    assert!(shown.misses("The path turns: normal ranges") && shown.panel("knee_flexion_angle")["band"].is_null());
}

// ---- header ----

#[test]
fn both_masses_are_shown_if_they_differ() {
    let mut files = recorded();
    let mass = |files: &Files| Shown::of(files).header("Body mass");
    with_summary(&mut files, |summary| summary["mass"]["kg"] = json!(1.004 * summary["mass_kg"].as_f64().unwrap()));
    assert!(!mass(&files).contains("dynamics"), "{}", mass(&files));
    with_summary(&mut files, |summary| (summary["mass_kg"], summary["mass"]["kg"]) = (json!(70.0), json!(72.84)));
    assert_eq!(mass(&files), "70.0 kg (normalises moments and powers); 72.8 kg (model, used for the dynamics)");
}

#[test]
fn the_header_shows_how_the_motion_was_processed() {
    let mut files = recorded();
    assert!(!header_has(&Shown::of(&files), "Motion"));
    with_summary(&mut files, |summary| {
        let residual =
            json!({"force_rms_bw": 0.05, "force_peak_bw": 0.1, "moment_rms_nm": 8.0, "moment_peak_nm": 20.0});
        summary["consistency"] = json!({"window_s": [0.1, 0.9], "residual_before": residual, "residual_after": residual,
            "feet_mm": {}, "mass_percent": 0.0, "trunk": "torso", "trunk_center_mm": [0.0, 0.0, 0.0], "iterations": 3,
            "converged": true, "changes": {"knee_angle_r": {"rms": 0.5, "max": 1.25, "unit": "deg"},
            "pelvis_tilt": {"rms": 1.0, "max": 3.21, "unit": "deg"}, "pelvis_ty": {"rms": 2.0, "max": 7.0,
                "unit": "mm"}}});
        summary["subject"] = subject("lab z up, mm -> world y up, m", None);
        summary["requested_window_s"] = json!([0.1, 0.9]);
    });
    let shown = Shown::of(&files);
    assert!(shown.header("Motion").contains("changed"));
    assert_eq!(header_note(&shown, "Motion"), "at most pelvis tilt by 3.2 deg and pelvis ty by 7.0 mm");
    assert_eq!(shown.header("Axes"), "lab z up, mm → world y up, m");
    let cut = header_note(&shown, "Time");
    assert!(cut.ends_with(", part of the recording"), "{cut}");
}

// ---- strides ----

#[test]
fn one_stride_is_one_stride() {
    let mut files = recorded();
    with_summary(&mut files, |summary| {
        for known in summary["times_and_distances"]["quantities"].as_array_mut().unwrap() {
            known["left"] = Value::Null;
            let one = json!({"mean": known["right"]["mean"], "sd": null, "strides": 1});
            (known["right"], known["both"]) = (one.clone(), one);
        }
    });
    let shown = Shown::of(&files);
    let note = note(&shown, "time_distance");
    assert!(note.as_str().unwrap().starts_with("Values of 1 right stride, between"), "{note}");
    assert_eq!(header_note(&shown, "Cadence"), "one stride");
}

// ---- missing files ----

#[test]
fn a_motion_without_ground_forces_keeps_its_cycles() {
    let mut files = recorded();
    for file in ["grf.mot", "events.csv"] {
        files.remove(file);
    }
    with_summary(&mut files, |summary| {
        summary["ground"]["source"] = json!("none");
        summary["speed_m_s"] = Value::Null;
        summary["times_and_distances"]["quantities"] = json!([]);
        summary["filter"]["force"] = json!({"kind": "butterworth", "cutoff_hz": 6.0, "order": 3});
    });
    let shown = Shown::of(&files);
    assert!(!shown.panel("hip_flexion_angle")["means"].as_array().unwrap().is_empty());
    assert!(!shown.header("Filter").contains("forces"), "{}", shown.header("Filter"));
    assert!(
        header_note(&shown, "Ground forces").contains("as requested") && shown.misses("without them, as requested")
    );
    assert!(header_note(&shown, "Speed").contains("without ground forces"));
    let tables = shown.session()["tables"].as_array().unwrap();
    let times = tables.iter().find(|table| table["id"] == "time_distance").unwrap();
    assert!(times["note"].is_null() && times["empty"].as_str().unwrap().contains("without ground forces"), "{times}");
}

#[test]
fn each_file_left_out_is_named() {
    let whole = Shown::of(&recorded());
    for (file, words) in [
        ("moments.sto", "No joint moments over time: the folder has no moments.sto"),
        ("powers.sto", "No joint powers over time: the folder has no powers.sto"),
        ("grf_sd.mot", "No uncertainty of the predicted forces"),
        ("events.csv", "No foot strikes and foot offs"),
    ] {
        let mut files = if file == "grf_sd.mot" { predicted() } else { recorded() };
        assert!(!Shown::of(&files).misses(words) && !whole.misses(words), "{file} is there");
        files.remove(file);
        assert!(Shown::of(&files).misses(words), "{file}");
    }
    let mut files = recorded();
    keep_lines(&mut files, "events.csv", |_| false);
    assert!(Shown::of(&files).misses("No foot strikes and foot offs"));
}

#[test]
fn a_column_of_one_side_left_out_is_named() {
    let mut files = recorded();
    assert!(!Shown::of(&files).misses("lacks the columns"));
    let table = Table::read_storage(&files["kinematics.mot"]).unwrap().0;
    let kept = table.columns().filter(|(name, _)| *name != "knee_angle_r");
    let mut kept =
        Table::new("Coordinates", kept.map(|(name, values)| (name.to_owned(), values.to_vec())).collect()).unwrap();
    kept.in_degrees = Some(true);
    files.insert("kinematics.mot".to_owned(), kept.write_storage());
    let shown = Shown::of(&files);
    assert!(shown.misses("because kinematics.mot lacks the columns: right knee flexion (knee_angle_r)."));
    let traces = shown.panel("knee_flexion_angle")["traces"].as_array().unwrap().clone();
    assert_eq!(traces.iter().map(|trace| &trace["side"]).collect::<Vec<_>>(), ["l"]);
}

#[test]
fn constant_quantities_have_no_panel() {
    // The invented walk keeps pelvis and trunk upright.
    let mut files = recorded();
    let shown = Shown::of(&files);
    let has = |shown: &Shown, id: &str| shown.panels().iter().any(|panel| panel["id"] == id);
    assert!(
        !has(&shown, "pelvis_tilt_angle") && !has(&shown, "trunk_lean_angle") && has(&shown, "trunk_rotation_angle")
    );
    assert!(shown.misses("pelvic tilt (does not move), ") && !shown.misses("pelvic rotation (does not move)"));
    with_motion(&mut files, |name, values, _| match name {
        "pelvis_tilt" => (0..values.len()).map(|i| 0.01 * i as f64).collect(),
        _ => values.to_vec(),
    });
    let tilted = Shown::of(&files);
    assert!(has(&tilted, "pelvis_tilt_angle") && !tilted.misses("pelvic tilt (does not move)"));
}

#[test]
fn a_locked_joint_is_reported_as_locked() {
    let Some(data) = shared_data::data() else { return };
    let folder = data.join("opensim-gait2392-subject01");
    let read = |name: &str| std::fs::read(folder.join(name)).unwrap();
    let loads = ExternalLoads::read(&read("subject01_walk1_grf.xml")).unwrap().0;
    let mut body = String::from_utf8(read("subject01_simbody.osim")).unwrap();
    for name in ["subtalar_angle_r", "subtalar_angle_l"] {
        let (before, after) = body.split_once(&format!("<Coordinate name=\"{name}\">")).unwrap();
        let after = after.replacen("<locked>false</locked>", "<locked>true</locked>", 1);
        body = format!("{before}<Coordinate name=\"{name}\">{after}");
    }
    let motion = read("subject01_walk1_ik.mot");
    let files = analysed(body.as_bytes(), &motion, &read("subject01_walk1_grf.mot"), &loads);
    let shown = Shown::of(&files);
    assert!(shown.misses("subtalar inversion (locked in the model)"), "{}", shown.session()["missing"]);
    assert!(shown.panels().iter().all(|panel| panel["id"] != "subtalar_angle"));
}
