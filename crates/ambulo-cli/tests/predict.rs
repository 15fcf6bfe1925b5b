//! `ambulo forces` without plates and with `--predict`: files, columns, keys, comparison, exit codes.
//!
//! The demo's walk lies on the instants of its own forces, so that prediction and truth can be compared directly.

use crate::workbench::{RAW, Run, Workbench};
use ambulo_formats::external_loads::ExternalLoads;

const MOTION: [&str; 4] = ["forces", "walk.mot", "--model", "figure.osim"];
const PLATES: [&str; 4] = ["--grf", "walk_grf.mot", "--loads", "walk_grf.xml"];

fn ran(run: Run) -> Run {
    assert!(matches!(run.code, Some(0 | 1)), "{}", run.stderr);
    run
}

/// Runs `forces --predict` with the measured forces of the demo.
fn predict_with_plates(bench: &Workbench, more: &[&str]) -> Run {
    ran(bench.run(&[&MOTION[..], &PLATES, &["--predict", "--verbose"], &RAW[..2], more].concat()))
}

#[test]
fn forces_are_predicted_where_none_were_measured() {
    let bench = Workbench::new("predicted");
    let run = ran(bench.run(&[&MOTION[..], &RAW[..2], &["--verbose"]].concat()));
    run.reports(&[
        "note: no ground forces were given; they are predicted",
        "warning: body mass is neither given nor measured",
    ]);
    let summary = bench.json("out/summary.json");
    assert_eq!(summary["ground"]["source"], "predicted");
    assert!(summary["ground"]["rule"].as_str().is_some_and(|rule| !rule.is_empty()), "{}", summary["ground"]);
    assert_eq!(
        (summary["mass"]["state"].as_str(), summary["mass"]["normalised_by"].as_str()),
        (Some("unknown"), Some("model"))
    );
    assert!(summary["comparison"].is_null());
    for name in ["grf.mot", "grf_sd.mot", "external_loads.xml", "events.csv", "moments.sto", "powers.sto", "cycles.csv"]
    {
        assert!(bench.exists(&format!("out/{name}")), "{name}");
    }
    assert!(!bench.exists("out/grf_measured.mot"), "there are no measured forces");
    // The feet carry the weight; changes too fast for markers remain as residual.
    assert!(summary["residual"]["force_rms_bw"].as_f64().unwrap() < 0.1, "{}", summary["residual"]);
}

#[test]
fn a_refit_says_what_it_changed_and_gained() {
    let bench = Workbench::new("refit");
    let run = ran(bench.run(&[&MOTION[..], &RAW[..2], &["--refit", "--verbose"]].concat()));
    run.reports(&["note: the refit held loaded feet still: their soles slid at", "of body weight (rms)"]);
    let refitted = bench.table("out/kinematics.mot");
    ran(bench.run(&[&MOTION[..], &RAW[..2], &["-o", "as_given"]].concat()));
    let given = bench.table("as_given/kinematics.mot");
    let change = |name: &str| {
        let [a, b] = [&refitted, &given].map(|table| table.column(name).unwrap());
        a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    };
    assert!(change("hip_flexion_r") > 1e-3, "the legs were moved");
    assert!(change("pelvis_ty") < 2e-3, "heights are kept: {}", change("pelvis_ty"));
    let refused = bench.run(&[&MOTION[..], &["--refit", "--no-ground"]].concat());
    assert_eq!(refused.code, Some(2), "{}", refused.stderr);
}

#[test]
fn a_tracked_motion_agrees_with_its_forces_and_is_compared_with_plates() {
    let bench = Workbench::new("tracked");
    let run = ran(bench.run(&[&MOTION[..], &PLATES, &["--track"], &RAW[..2]].concat()));
    assert!(run.stdout.contains("tracking  motion changed by"), "{}", run.stdout);
    let summary = bench.json("out/summary.json");
    assert_eq!(summary["ground"]["source"], "predicted");
    assert!(
        summary["ground"]["rule"].as_str().is_some_and(|rule| rule.starts_with("tracking")),
        "{}",
        summary["ground"]
    );
    let residual = summary["residual"]["force_rms_bw"].as_f64().unwrap();
    assert!(
        residual < 1.2e-3 && summary["tracking"]["residual_peak"].as_f64().unwrap() < 5e-3,
        "{}",
        summary["residual"]
    );
    assert!(!summary["comparison"].is_null() && !summary["tracking"]["predicted"].is_null());
    // The model has no arms.
    assert!(summary["tracking"]["hands_mm"].is_null() && !run.stdout.contains("a hand by"), "{}", run.stdout);
    for name in ["grf.mot", "grf_measured.mot", "kinematics.mot", "moments.sto", "powers.sto"] {
        assert!(bench.exists(&format!("out/{name}")), "{name}");
    }
}

#[test]
fn all_files_share_the_samples_of_the_motion_and_name_their_columns() {
    let bench = Workbench::new("predict_columns");
    predict_with_plates(&bench, &[]);
    let times = bench.table("out/kinematics.mot").times().unwrap().to_vec();
    for name in ["grf.mot", "grf_measured.mot", "grf_sd.mot", "moments.sto"] {
        assert_eq!(bench.table(&format!("out/{name}")).times().unwrap(), times, "{name}");
    }
    let (found, measured, deviations) =
        (bench.table("out/grf.mot"), bench.table("out/grf_measured.mot"), bench.table("out/grf_sd.mot"));
    assert_eq!(found.names(), measured.names());
    for side in ["r", "l"] {
        for axis in ["x", "y", "z"] {
            for stem in [format!("ground_force_{side}_v{axis}"), format!("ground_force_{side}_p{axis}")] {
                assert!(found.column(&stem).is_some(), "{stem}");
                let deviation = deviations.column(&format!("{stem}_sd")).unwrap();
                let vertical = found.column(&format!("ground_force_{side}_vy")).unwrap();
                assert!(deviation.iter().all(|sd| *sd >= 0.0), "{stem}: a deviation is no number below zero");
                // A foot that stands may carry too little to be written; one that swings deviates by nothing.
                let is_force = stem.contains("_v");
                let covered = deviation.iter().zip(vertical).all(|(sd, force)| !is_force || *force <= 0.0 || *sd > 0.0);
                assert!(covered, "{stem}: a force without a deviation");
                let swings = deviation.iter().filter(|sd| **sd <= 0.0).count();
                assert!(4 * swings > deviation.len(), "{stem}: {swings} of {} samples swing", deviation.len());
            }
        }
        assert!(deviations.column(&format!("ground_torque_{side}_y_sd")).is_some());
    }
    let (loads, _) = ExternalLoads::read(&bench.read("out/external_loads.xml")).unwrap();
    assert_eq!(loads.datafile.as_deref(), Some("grf.mot"));
    let bodies: Vec<&str> = loads.forces.iter().map(|force| force.applied_to_body.as_str()).collect();
    assert_eq!(bodies, ["calcn_r", "calcn_l"]);
}

#[test]
fn predicted_forces_can_be_read_as_measured_forces() {
    let bench = Workbench::new("predict_again");
    ran(bench.run(&[&MOTION[..], &RAW[..2], &["-o", "first"]].concat()));
    let again = ["--loads", "first/external_loads.xml", "--cutoff", "off", "--force-cutoff", "off", "-o", "second"];
    ran(bench.run(&[&MOTION[..], &again].concat()));
    // Below 20 N a foot has zeros in the file: two frames at each of a dozen strikes and offs among 291, 20 N at most
    // and a lever of at most a metre, make an RMS of 20 sqrt(24 / 291) = 5.7 N or N.m.
    let compare = |other: &str| bench.run(&["compare", "first/moments.sto", other, "--limit", "5.7"]);
    let same = compare("second/moments.sto");
    assert_eq!(same.code, Some(0), "{}", same.stdout);
    ran(bench.run(&[&MOTION[..], &["--no-ground", "--cutoff", "off", "-o", "third"]].concat()));
    assert_eq!(compare("third/moments.sto").code, Some(1), "without ground the moments are others");
}

#[test]
fn a_prediction_is_compared_with_measured_forces() {
    let bench = Workbench::new("predict_compared");
    let run = predict_with_plates(&bench, &[]);
    for words in ["compared with plates", "vertical", "fore-aft", "lateral", "ankle_angle_r_moment", "strike"] {
        assert!(run.stdout.contains(words), "`{words}` is missing in: {}", run.stdout);
    }
    let summary = bench.json("out/summary.json");
    assert_eq!(
        (summary["mass"]["state"].as_str(), summary["mass"]["normalised_by"].as_str()),
        (Some("weighed"), Some("plates"))
    );
    assert_eq!(summary["filter"]["force"]["cutoff_hz"], 20.0, "the plates' own filter, whatever the motion's");
    let comparison = &summary["comparison"];
    let feet = comparison["feet"].as_array().unwrap();
    assert_eq!(feet.len(), 2, "{comparison}");
    for foot in feet {
        for component in ["vertical", "fore_aft", "lateral"] {
            for key in ["rmse_bw", "rrmse", "r"] {
                assert!(foot[component].get(key).is_some(), "{component} {key}: {foot}");
            }
        }
        // The walk obeys Newton's laws; what is left is the split in double support.
        let rmse = foot["vertical"]["rmse_bw"].as_f64().unwrap();
        assert!(rmse < 0.2, "{rmse} BW");
        assert!(foot["center_of_pressure"]["fore_aft_mm"].as_f64().unwrap() < 100.0, "{foot}");
    }
    assert_eq!(comparison["moments"].as_array().unwrap().len(), 6);
    assert_eq!(comparison["events"].as_array().unwrap().len(), 2);
    // Without --predict everything is as it was measured.
    bench.forces(&RAW).done();
    let summary = bench.json("out/summary.json");
    assert_eq!(summary["ground"]["source"], "measured");
    assert!(
        summary["comparison"].is_null() && !bench.exists("out/grf_sd.mot") && !bench.exists("out/grf_measured.mot")
    );
}

#[test]
fn a_walk_carried_by_its_feet_passes_the_checks_and_one_with_other_support_fails() {
    let bench = Workbench::empty("predict_checks");
    bench.run(&["demo", "-o", "demo", "--quiet"]).done();
    let motion = ["forces", "demo/input/walk.mot", "--model", "demo/input/figure.osim", "--cutoff", "off"];
    let plates = ["--grf", "demo/input/walk_grf.mot", "--loads", "demo/input/walk_grf.xml"];
    let run = bench.run(&[&motion[..], &plates, &["--predict", "-v"]].concat()).done();
    assert!(run.stdout.contains("  checks    passed: vertical_force_feet, "), "{}", run.stdout);
    let summary = bench.json("out/summary.json");
    let checks = summary["prediction"]["checks"].as_array().unwrap();
    assert!(checks.iter().all(|check| check["passed"] != false), "{checks:?}");
    let mass = checks.iter().find(|check| check["name"] == "mass").unwrap();
    assert_eq!(mass["passed"], true, "the measured forces give the mass: {mass}");
    for key in ["value", "allowed", "unit", "time_s", "not_judged"] {
        assert!(mass.get(key).is_some(), "{key}: {mass}");
    }
    // The same steps with the trunk bent far forward, as over a walking frame.
    let text = bench.text("demo/input/walk.mot");
    let names = text.lines().skip_while(|line| line.trim() != "endheader").nth(1).unwrap();
    let trunk = names.split_whitespace().position(|name| name == "lumbar_extension").unwrap();
    bench.edit_rows("demo/input/walk.mot", |mut rows| {
        for row in &mut rows {
            row[trunk] = (row[trunk].parse::<f64>().unwrap() - 60.0).to_string();
        }
        rows
    });
    let run = ran(bench.run(&[&motion[..], &["-v"]].concat()));
    run.reports(&["warning: the whole body's"]);
    assert!(run.stdout.contains("            failed: "), "{}", run.stdout);
    let summary = bench.json("out/summary.json");
    let codes = summary["findings"].as_array().unwrap();
    assert!(codes.iter().any(|finding| finding["code"] == "prediction.not_through_the_feet"), "{codes:?}");
    // Nothing shows whether the frame was there, so the person is not called unable.
    let verdict = &summary["verdict"];
    assert_eq!(verdict["state"], "not_judged", "{verdict}");
    let undecided = verdict["undecided"].as_array().unwrap();
    let is_support =
        |why: &&serde_json::Value| why.as_str().unwrap().contains("something other than the feet may support");
    assert!(undecided.iter().any(|why| is_support(&why)), "{undecided:?}");
    // Forces that plates measured are judged as ever.
    ran(bench.run(&[&motion[..], &plates].concat()));
    assert!(bench.json("out/summary.json")["prediction"].is_null());
}

#[test]
fn half_the_mass_is_only_detected_with_force_plates() {
    let bench = Workbench::empty("predict_half");
    bench.run(&["demo", "-o", "demo", "--quiet"]).done();
    let mass = |more: &[&str]| {
        let input = ["forces", "demo/input/walk.c3d", "--height", "1.75", "--mass", "40", "--predict", "-v"];
        let run = ran(bench.run(&[&input[..], more].concat()));
        (run, bench.json("out/summary.json")["mass"]["state"].as_str().unwrap().to_owned())
    };
    let (run, known) = mass(&[]);
    run.reports(&["forces are computed with 40.0 kg (stated), but the ground forces carry 7", "hint: ", "--mass"]);
    assert_eq!(known, "contradicted");
    assert!(run.stdout.contains("40.00 kg (stated, contradicted; the force plates carry 7"), "{}", run.stdout);
    ran(bench.run(&["forces", "demo/input/walk.bvh", "--mass", "40", "--height", "1.75"]));
    let summary = bench.json("out/summary.json");
    let checks = summary["prediction"]["checks"].as_array().unwrap();
    let mass = checks.iter().find(|check| check["name"] == "mass").unwrap();
    assert!(mass["passed"].is_null() && mass["not_judged"].is_string(), "the mass is not measured: {mass}");
    assert_eq!(summary["mass"]["state"], "stated", "--mass is used");
}

#[test]
fn exchanged_feet_on_plates_give_a_warning() {
    let bench = Workbench::new("predict_exchanged");
    let exchanged = ["--right", "calcn_r:ground_force_l_", "--left", "calcn_l:ground_force_r_"];
    let run = bench.run(&[&MOTION[..], &PLATES[..2], &exchanged, &["--predict"], &RAW[..2]].concat());
    ran(run).reports(&["measured forces alongside the prediction: ", "right and left may be exchanged"]);
    let summary = bench.json("out/summary.json");
    let feet = summary["comparison"]["feet"].as_array().unwrap();
    assert!(feet.iter().all(|foot| foot["vertical"]["rmse_bw"].as_f64().unwrap() > 0.3), "{feet:?}");
}

#[test]
fn markers_and_skeletons_need_no_plates() {
    let bench = Workbench::empty("predict_markers");
    bench.run(&["demo", "-o", "demo", "--quiet"]).done();
    let input =
        |name: &str, more: &[&str]| ran(bench.run(&[&["forces", &format!("demo/input/{name}")], more].concat()));
    input("walk.trc", &["--model", "demo/input/figure.osim"]);
    assert_eq!(bench.json("out/summary.json")["mass"]["state"], "unknown");
    input("walk.trc", &["--model", "demo/input/figure.osim", "--mass", "75"]);
    assert_eq!(bench.json("out/summary.json")["mass"]["state"], "stated");
    input("walk.bvh", &["--mass", "75", "--height", "1.75"]);
    let summary = bench.json("out/summary.json");
    assert_eq!(
        (summary["ground"]["source"].as_str(), summary["mass"]["state"].as_str()),
        (Some("predicted"), Some("stated"))
    );
    // Plates in the C3D: compared on stances that are entirely on one plate.
    input("walk.c3d", &["--static", "demo/input/standing.c3d", "--mass", "75", "--height", "1.75", "--predict"]);
    let summary = bench.json("out/summary.json");
    assert_eq!(summary["comparison"]["feet"].as_array().unwrap().len(), 2);
    assert!(bench.exists("out/grf_measured.mot"));
}

#[test]
fn impossible_predictions_are_rejected() {
    let bench = Workbench::new("predict_refused");
    bench.run(&[&MOTION[..], &["--predict", "--no-ground"]].concat()).refused(&["--predict", "--no-ground"]);
    bench.run(&[&MOTION[..], &["--from", "0.5", "--to", "0.505"]].concat()).refused(&["walk.mot", "expected"]);
    // Names do not matter: a hoof below a hock is a foot.
    let (figure, walk) = (bench.text("figure.osim"), bench.text("walk.mot"));
    bench.edit("figure.osim", "calcn", "hoof");
    bench.edit("figure.osim", "ankle_angle", "hock_angle");
    bench.edit("walk.mot", "ankle_angle", "hock_angle");
    bench.run(&MOTION);
    assert_eq!(bench.json("out/summary.json")["ground"]["source"], "predicted");
    bench.write("figure.osim", figure);
    bench.write("walk.mot", walk);
    // Thighs and shanks a centimetre long are no legs.
    bench.edit("figure.osim", "0 -0.43 0", "0 -0.01 0");
    bench.run(&MOTION).refused(&["has no two legs", "hint: ", "--no-ground", "--grf"]);
    bench.run(&[&MOTION[..], &["--no-ground"], &RAW].concat());
    assert_eq!(bench.json("out/summary.json")["ground"]["source"], "none");
}

#[test]
fn a_person_is_calibrated_on_plates_and_only_that_person_is_predicted_with_it() {
    let bench = Workbench::empty("calibrated");
    bench.run(&["demo", "-o", "demo", "--quiet"]).done();
    let walk = "demo/input/walk.c3d";
    let body = ["--static", "demo/input/standing.c3d", "--mass", "75", "--height", "1.75"];
    let calibrate = [&["calibrate", walk][..], &body, &["-o", "person.toml"]].concat();
    let run = bench.run(&calibrate).done();
    assert!(run.stdout.contains("right foot stances") && run.stdout.contains("person.toml"), "{}", run.stdout);
    bench.run(&calibrate).refused(&["person.toml", "--force"]);
    let forces = |more: &[&str]| {
        ran(bench.run(&[&["forces", walk][..], &body, &["--keep", "report"], more].concat()));
        let summary = bench.json("out/summary.json");
        let rule = summary["ground"]["rule"].as_str().unwrap();
        assert_eq!(rule.contains("calibrated for the person"), more.contains(&"--person"), "{rule}");
        summary["comparison"]["feet"][0]["vertical"]["rmse_bw"].as_f64().unwrap()
    };
    let (before, after) = (forces(&["--predict"]), forces(&["--person", "person.toml"]));
    assert!(after < 0.7 * before, "{before} -> {after}");
    // Warnings about a trial name it.
    let heavy = ["--static", "demo/input/standing.c3d", "--mass", "90", "-o", "heavy.toml"];
    let warned = bench.run(&[&["calibrate", walk][..], &heavy].concat()).done().stderr;
    assert!(warned.contains(&format!("warning: {walk}: the stated mass is 90.0 kg")), "{warned}");
    bench.edit("person.toml", "mass_kg = 7", "mass_kg = 6");
    let other = [&["forces", walk][..], &body, &["--person", "person.toml"]].concat();
    bench.run(&other).refused(&[walk, "mass", "ambulo calibrate"]);
    bench.run(&["calibrate", "demo/input/walk.trc", "--mass", "75", "--force", "--quiet"]).refused(&[
        "walk.trc",
        "plates",
        "`--grf FILE`",
    ]);
    bench.write("person.toml", "mass_kg = 3");
    bench.run(&other).refused(&["person.toml", "stances"]);
}

/// A table of forces in place of a motion, and the other way round.
#[test]
fn tables_in_each_others_place_are_named() {
    let bench = Workbench::new("exchanged-tables");
    let forces = ["forces", "walk_grf.mot", "--model", "figure.osim"];
    bench.run(&forces).refused(&["walk_grf.mot", "these are the columns of measured forces"]);
    let motion = [&MOTION[..], &["--grf", "walk.mot"]].concat();
    bench.run(&motion).refused(&["walk.mot", "these are coordinates of a motion, not forces"]);
}

/// Markers, and coordinates of the same model, with the forces in a table.
#[test]
fn a_person_is_calibrated_by_every_recording_that_forces_takes() {
    let bench = Workbench::empty("calibrated-tables");
    bench.run(&["demo", "-o", "demo", "--quiet"]).done();
    let [trc, mot, loads] = ["demo/input/walk.trc", "demo/input/walk.mot", "demo/input/walk_grf.xml"];
    let model = ["--model", "demo/input/figure.osim", "--quiet", "-o"];
    let twice = [&["calibrate", trc, mot, "--loads", loads, "--loads", loads][..], &model, &["both.toml"]].concat();
    bench.run(&twice).done();
    assert!(bench.text("both.toml").contains("leg_length_m"));
    let feet = ["--right", "calcn_r:ground_force_r_", "--left", "calcn_l:ground_force_l_"];
    let grf = [&["calibrate", mot, "--grf", "demo/input/walk_grf.mot"][..], &feet, &model, &["table.toml"]].concat();
    bench.run(&grf).done();
    let one = [&["calibrate", mot, "--loads", loads][..], &model, &["one.toml"]].concat();
    bench.run(&one).done();
    assert_eq!(bench.text("table.toml"), bench.text("one.toml"));
    let few = [&["calibrate", trc, mot, "--loads", loads][..], &model, &["few.toml"]].concat();
    bench.run(&few).refused(&["found 1 files of external loads for 2 trials", "one per trial"]);
    assert!(!bench.exists("few.toml"));
    let no_trial = ["forces", "demo/input/walk.trc", "--static", "demo/input/figure.osim", "--mass", "75"];
    bench.run(&no_trial).refused(&["figure.osim", "found a file `.osim`", "expected markers"]);
    // A standing trial has force plates; the reason is that nobody walks.
    let stands = ["calibrate", "demo/input/standing.c3d", "--mass", "75", "--height", "1.75", "-o", "stands.toml"];
    let refused = bench.run(&stands);
    assert_eq!(refused.code, Some(2), "{}", refused.stderr);
    refused.reports(&["standing.c3d", "does not walk in this trial (stand)"]);
}
