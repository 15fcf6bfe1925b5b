//! The page of a simulated scene: a door on a hinge and a walker, in files made here.

use crate::report_pages::{Files, Shown, page_of};
use serde_json::{Value, json};
use std::fmt::Write;

const INSTANTS: usize = 50;
const STEP_S: f64 = 0.02;

/// A door that swings by 0.5 rad, and a figure `ann` of 60 kg with hips, that touches the floor with both feet.
fn scene() -> Files {
    let mut energy = String::from("time,kinetic,gravity,springs,total,iterations,factorizations,residual,converged\n");
    let mut joints = String::from("time,joint,coordinate,value,rate,effort,unit\n");
    let mut contacts =
        String::from("time,kind,first,second,px,py,pz,nx,ny,nz,fx,fy,fz,normal_force,friction_force,slip_m_s,gap_m\n");
    let mut moments = String::from("Generalized Forces\nversion=1\nnRows=49\nnColumns=3\ninDegrees=no\nendheader\n");
    moments += "time\thip_flexion_r_moment\thip_flexion_l_moment\n";
    for i in 0..INSTANTS {
        let t = i as f64 * STEP_S;
        let solver = if i == 0 { ",,,".to_owned() } else { "2,1,1e-12,true".to_owned() };
        writeln!(energy, "{t},{},{},0,{},{solver}", 2.0 * t, 5.0 - 2.0 * t, 5.0).unwrap();
        let effort = if i == 0 { String::new() } else { format!("{}", 3.0 * t) };
        writeln!(joints, "{t},\"door, hinge\",angle,{},0,{effort},N.m", 0.5 * (t * 6.0).sin()).unwrap();
        for (side, sign) in [("r", 1.0), ("l", -1.0)] {
            writeln!(joints, "{t},ann/hip_flexion_{side},angle,{},0,{effort},N.m", sign * t).unwrap();
            for _ in 0..2 {
                writeln!(contacts, "{t},contact,ann/calcn_{side},floor,0,0,0,0,1,0,1,100,0,100,10,0,0").unwrap();
            }
        }
        writeln!(contacts, "{t},impact,ann/calcn_r,floor,0,0,0,0,1,0,0,9999,0,9999,0,0,0").unwrap();
        if i > 0 {
            writeln!(moments, "{t}\t{}\t{}", 60.0 * t, -60.0 * t).unwrap();
        }
    }
    let reason = json!({"check": "strength", "quantity": "hip_flexion_l_moment", "side": "l", "time_s": [0.2, 0.4],
        "at_s": 0.3,
        "value": 300.0, "limit": 160.0, "unit": "N.m", "message": "the hip needs 300 N.m"});
    let summary = json!({
        "version": "0.1.0", "input": {"scene": "scenes/door.toml", "files": [], "resumed": null},
            "title": "A door </script>",
        "world": {"bodies": 5, "joints": 3, "closures": 0, "obstacles": 1, "figures": 1, "surfaces": 4,
            "mass_kg": 61.0},
        "integrator": "impulse", "step_s": 0.001, "steps": 980, "window_s": [0.0, 0.98], "frames": INSTANTS,
        "energy": {"start_j": 5.0, "end_j": 5.0, "lowest_j": 5.0, "highest_j": 5.0, "kinetic_max_j": 2.0},
            "joint_error_max_m": 1e-9,
        "contacts": {"points_max": 4, "normal_force_max_n": 100.0, "overlap_max_m": 0.001,
            "obstacles_force_max_n": 400.0, "impacts": 0},
        "peaks": [{"quantity": "ann/hip_flexion_r_moment", "unit": "N.m", "max": 58.8, "max_at_s": 0.98, "min": 0.0,
            "min_at_s": 0.0}],
        "convergence": {"iterations_mean": 2.0, "iterations_max": 2, "factorizations_mean": 1.0, "residual_max": 1e-12,
            "not_converged": 3}, "findings": [],
        "verdict": {"state": "infeasible", "figures": [{"figure": "ann", "state": "infeasible", "judged_share": 1.0,
            "undecided": [], "reasons": [reason],
            "closest": [{"check": "strength", "quantity": "hip_flexion_l_moment", "at_s": 0.3, "value": 300.0,
                "limit": 160.0,
                "unit": "N.m", "share": 1.875}], "not_judged": [], "frames": 50, "frames_unmeasured": 0,
                    "frames_predicted": 0,
            "mass_kg": 60.0, "height_m": 1.7}]},
        "timing_ms": {},
    });
    let files = [
        ("energy.csv", energy),
        ("joints.csv", joints),
        ("contacts.csv", contacts),
        ("moments.sto", moments),
        ("summary.json", summary.to_string()),
    ];
    files.into_iter().map(|(name, text)| (name.to_owned(), text.into_bytes())).collect()
}

fn trace(shown: &Shown, panel: &str, name: &str) -> Vec<f64> {
    let traces = shown.panel(panel)["traces"].as_array().unwrap();
    let found = traces.iter().find(|trace| trace["name"] == name).unwrap_or_else(|| panic!("no {name} in {panel}"));
    shown.series(&found["values"])
}

#[test]
fn curves_of_a_scene_are_those_of_its_tables() {
    let shown = Shown::of(&scene());
    let time = &shown.session()["time"];
    assert_eq!((time["frames"].as_u64(), shown.session()["source"].as_str()), (Some(50), Some("simulated")));
    assert!((time["step_s"].as_f64().unwrap() - STEP_S).abs() < 1e-12);
    let (door, energy) = (trace(&shown, "joint_1", "door, hinge angle"), trace(&shown, "energy_kinetic", "kinetic"));
    let (effort, moment) =
        (trace(&shown, "effort_1", "door, hinge angle"), trace(&shown, "hip_flexion_moment", "left"));
    let contact = trace(&shown, "contact_1_normal", "right");
    for i in 0..INSTANTS {
        let t = i as f64 * STEP_S;
        // Half a step of the 16-bit numbers: 58 deg, 2 J and 1 N.m/kg over 65534.
        assert!((door[i] - (0.5 * (t * 6.0).sin()).to_degrees()).abs() < 1e-3, "{i}: {}", door[i]);
        assert!((energy[i] - 2.0 * t).abs() < 1e-4);
        assert!((contact[i] - 200.0).abs() < 1e-9, "two points of 100 N, and no impulse of an impact: {}", contact[i]);
        match i {
            0 => assert!(effort[i].is_nan() && moment[i].is_nan(), "before the first step nothing has acted"),
            // Extensor positive: the file's flexor moment of -60 t over 60 kg.
            _ => assert!((effort[i] - 3.0 * t).abs() < 1e-4 && (moment[i] - t).abs() < 1e-4, "{i}: {}", moment[i]),
        }
    }
    let hips = shown.panel("joint_2")["traces"].as_array().unwrap();
    assert_eq!(hips.iter().map(|trace| trace["side"].as_str().unwrap()).collect::<Vec<_>>(), ["r", "l"], "one panel");
}

#[test]
fn the_verdict_of_a_walker_is_marked_on_its_panel() {
    let shown = Shown::of(&scene());
    let red = shown.panel("hip_flexion_moment")["red"].as_array().unwrap();
    assert_eq!((red.len(), red[0]["sentence"].as_str()), (1, Some("ann: the hip needs 300 N.m")));
    let feasibility = &shown.session()["feasibility"];
    assert_eq!(feasibility["state"], "infeasible");
    assert_eq!(feasibility["closest"]["rows"][0][1]["text"], "ann: left hip flexion moment");
    assert_eq!(feasibility["closest"]["rows"][0][6]["outside"], true);
    let facts = shown.session()["quality"]["facts"].as_array().unwrap();
    let steps = facts.iter().find(|fact| fact["label"] == "Time steps above the solver's tolerance").unwrap();
    assert_eq!((&steps["value"], &steps["good"]), (&json!("3"), &Value::Bool(false)));
    assert_eq!(shown.header("Scene"), "A door </script>");
}

#[test]
fn the_page_begins_with_how_far_each_figure_walked_and_whether_it_fell() {
    let mut files = scene();
    assert_eq!(Shown::of(&files).session()["outcome"], json!([]));
    let mut summary: Value = serde_json::from_slice(&files["summary.json"]).unwrap();
    let walked = |figure: &str, fell_at_s: Value, first: Value| {
        json!({"figure": figure, "steps": 5, "distance_m": 3.27,
        "fell_at_s": fell_at_s, "first_part": first})
    };
    summary["walked"] = json!([walked("ann", Value::Null, Value::Null), walked("bob", json!(3.2), json!("hip"))]);
    files.insert("summary.json".to_owned(), summary.to_string().into_bytes());
    let sentences = json!(["ann walked 5 steps, 3.3 m", "bob fell after 5 steps at 3.20 s, hip first"]);
    assert_eq!(Shown::of(&files).session()["outcome"], sentences);
}

#[test]
fn a_scene_without_tables_says_so() {
    let mut files = scene();
    files.retain(|name, _| name == "summary.json");
    let shown = Shown::of(&files);
    assert!(shown.misses("No curves") && shown.session()["view"].is_null());
    let mut files = scene();
    let text = String::from_utf8(files["summary.json"].clone()).unwrap();
    let mut summary: Value = serde_json::from_str(&text).unwrap();
    summary["verdict"] = Value::Null;
    files.insert("summary.json".to_owned(), summary.to_string().into_bytes());
    assert!(Shown::of(&files).misses("No verdict"));
}

#[test]
fn malformed_tables_of_a_scene_are_rejected_with_their_line() {
    for (name, from, to, expected) in [
        ("joints.csv", "0.02,\"door", "soon,\"door", "joints.csv: line 5, column 1: found `soon`"),
        ("energy.csv", "time,kinetic", "time,warmth", "energy.csv: line 1: found `time,warmth"),
        ("contacts.csv", ",100,10,", ",many,10,", "contacts.csv: line 2, column 14: found `many`"),
    ] {
        let mut files = scene();
        let text = String::from_utf8(files[name].clone()).unwrap().replacen(from, to, 1);
        files.insert(name.to_owned(), text.into_bytes());
        let error = page_of("folder", &files).unwrap_err().to_string();
        assert!(error.contains(expected), "{error}\nexpected {expected}");
    }
}
