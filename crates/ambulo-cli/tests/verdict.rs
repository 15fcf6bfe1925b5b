//! The verdict of `ambulo forces`: exit code, words, summary, figure, and the file of thresholds.

use crate::workbench::{FORCES, RAW, Workbench};
use serde_json::Value;

/// `forces` on the built-in walk, judged by the built-in limits.
const STRICT: &[&str] = FORCES.split_at(8).0;

#[test]
fn a_feasible_motion_exits_with_zero_and_reports_its_closest_limit() {
    let bench = Workbench::new("feasible");
    let run = bench.forces(&RAW).done();
    assert!(run.stdout.contains("  verdict   feasible: at most "), "{}", run.stdout);
    let verdict = &bench.json("out/summary.json")["verdict"];
    assert_eq!(verdict["state"], "feasible");
    assert_eq!(verdict["reasons"], serde_json::json!([]));
    let closest = verdict["closest"].as_array().unwrap();
    assert!(closest.iter().any(|c| c["check"] == "strength" && c["share"].as_f64().unwrap() < 1.0), "{closest:?}");
    let skipped = verdict["not_judged"].as_array().unwrap().iter().filter(|n| n["why"] == "skipped by the thresholds");
    assert_eq!(skipped.map(|n| n["check"].clone()).collect::<Vec<Value>>(), ["center_of_pressure", "sliding"]);
    assert!(!bench.text("out/figures/moments.svg").contains("red: not feasible"));
}

#[test]
fn sliding_feet_are_detected_with_the_built_in_limits() {
    let bench = Workbench::new("sliding");
    let run = bench.run(&[STRICT, &RAW].concat()).infeasible();
    assert!(run.stdout.lines().count() + run.stderr.lines().count() <= 25, "{}{}", run.stderr, run.stdout);
    assert!(run.stdout.contains("  verdict   infeasible, "), "{}", run.stdout);
    assert!(run.stdout.contains("sliding: the loaded left foot slides at 1.0"), "{}", run.stdout);
    let verdict = bench.json("out/summary.json")["verdict"].clone();
    assert_eq!(verdict["state"], "infeasible");
    for reason in verdict["reasons"].as_array().unwrap() {
        for key in ["check", "quantity", "unit", "message", "side"] {
            assert!(reason[key].is_string(), "no `{key}` in {reason}");
        }
        let time = |i: usize| reason["time_s"][i].as_f64().unwrap();
        assert!(time(0) <= reason["at_s"].as_f64().unwrap() && reason["at_s"].as_f64().unwrap() <= time(1), "{reason}");
        assert!(reason["value"].as_f64().unwrap() > reason["limit"].as_f64().unwrap(), "{reason}");
    }
    let figure = bench.text("out/figures/moments.svg");
    assert!(figure.contains("red: not feasible") && figure.contains("#C00018"), "no red in the figure");
    // Everything else is written as for a feasible motion.
    bench.forces(&[&RAW[..], &["-o", "lenient"]].concat()).done();
    assert_eq!(bench.read("out/moments.sto"), bench.read("lenient/moments.sto"));
    let quiet = bench.run(&[STRICT, &RAW, &["--quiet"]].concat()).infeasible();
    assert!(quiet.stdout.is_empty() && quiet.stderr.is_empty());
}

#[test]
fn an_infeasible_motion_changes_the_exit_code_only_with_a_check() {
    let bench = Workbench::new("check");
    bench.run(&[STRICT, &RAW].concat()).infeasible();
    let run = bench.run(&[STRICT, &RAW, &["--check"]].concat());
    assert_eq!(run.code, Some(1), "{}", run.stderr);
    bench.forces(&[&RAW[..], &["--check", "-o", "feasible"]].concat()).done();
}

#[test]
fn plates_without_a_load_are_not_called_feasible() {
    let bench = Workbench::new("unloaded");
    let loaded = bench.text("walk_grf.mot");
    let (head, rows) = loaded.split_once("endheader\n").unwrap();
    let (names, rows) = rows.split_once('\n').unwrap();
    let unloaded = rows.lines().map(|row| {
        let cells = row.split('\t').enumerate().map(|(i, cell)| if i == 0 { cell } else { "0" });
        cells.collect::<Vec<_>>().join("\t") + "\n"
    });
    bench.write("walk_grf.mot", format!("{head}endheader\n{names}\n{}", unloaded.collect::<String>()));
    let run = bench.forces(&RAW).done();
    assert!(run.stdout.contains("  verdict   not judged: "), "{}", run.stdout);
    let verdict = bench.json("out/summary.json")["verdict"].clone();
    assert_eq!(verdict["state"], "not_judged");
    let why = verdict["undecided"].to_string();
    assert!(why.contains("no force was measured where a foot stood"), "{why}");
}

#[test]
fn thresholds_are_read_from_a_file() {
    let bench = Workbench::new("thresholds");
    let limits =
        "skip = [\"sliding\", \"center_of_pressure\"]\n[friction]\navailable = 0.05\n[strength]\nshare = 0.2\n";
    bench.write("limits.toml", limits);
    let run = bench.run(&[STRICT, &RAW, &["--thresholds", "limits.toml"]].concat()).infeasible();
    assert!(run.stdout.contains("friction: the left foot needs a coefficient of friction of 0."), "{}", run.stdout);
    let verdict = bench.json("out/summary.json")["verdict"].clone();
    let checks: Vec<&str> =
        verdict["reasons"].as_array().unwrap().iter().map(|r| r["check"].as_str().unwrap()).collect();
    assert!(checks.contains(&"friction") && checks.contains(&"strength"), "{checks:?}");
    assert!(!checks.contains(&"sliding"), "{checks:?}");
}

#[test]
fn an_invalid_thresholds_file_is_rejected() {
    let bench = Workbench::new("bad_thresholds");
    let refused = |file: &str, words: &[&str]| bench.run(&[STRICT, &["--thresholds", file]].concat()).refused(words);
    bench.write("a.toml", "[friction]\navailable = \"much\"\n");
    refused("a.toml", &["a.toml: line 2, `friction.available`: found \"much\"; expected a number from 0 to 5"]);
    bench.write("a.toml", "[frictoin]\n");
    refused("a.toml", &["a.toml: line 1, `frictoin`: unknown key", "hint: did you mean `friction`?"]);
    bench.write("a.toml", [0xff, 0xfe]);
    refused("a.toml", &["a.toml"]);
    refused("none.toml", &["none.toml: there is no such file"]);
    refused("figure.osim", &["figure.osim: line 1", "this is not TOML"]);
}

#[test]
fn without_ground_forces_only_joints_are_checked() {
    let bench = Workbench::new("not_judged_without_ground");
    bench.run(&[&FORCES[..4], &RAW, &["--no-ground"]].concat()).done();
    let verdict = bench.json("out/summary.json")["verdict"].clone();
    let unjudged = verdict["not_judged"].as_array().unwrap().iter().filter(|n| n["why"] == "no ground forces").count();
    assert_eq!(unjudged, 7, "{verdict}");
    assert!(verdict["closest"].as_array().unwrap().iter().any(|c| c["check"] == "strength"));
}

#[test]
fn the_moment_of_a_device_is_subtracted_before_strength_is_checked() {
    let bench = Workbench::new("not_judged_with_device");
    let weak = "skip = [\"sliding\", \"center_of_pressure\"]\n[strength]\nshare = 0.25\n";
    bench.write("weak.toml", weak);
    let judge = |more: &[&str]| {
        bench.run(&[STRICT, &RAW, &["--thresholds", "weak.toml"], more].concat()).infeasible();
        let verdict = bench.json("out/summary.json")["verdict"].clone();
        let reasons = verdict["reasons"].as_array().unwrap().clone();
        reasons.iter().filter(|r| r["quantity"] == "ankle_angle_r_moment").count()
    };
    let alone = judge(&[]);
    assert!(alone > 0);
    // A device that supplies the whole moment of the right ankle.
    let moments = bench.table("out/moments.sto");
    let (times, ankle) = (moments.times().unwrap(), moments.column("ankle_angle_r_moment").unwrap());
    let rows: Vec<String> = times.iter().zip(ankle).map(|(t, m)| format!("{t},{m}")).collect();
    bench.write("device.csv", format!("time,ankle_angle_r_moment\n{}\n", rows.join("\n")));
    assert_eq!(judge(&["--device", "device.csv"]), 0);
}
