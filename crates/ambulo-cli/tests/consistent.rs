//! `ambulo forces --consistent`: files and messages of residual reduction; the written motion agrees with the written
//! forces.

use crate::workbench::Workbench;
use serde_json::Value;
use std::fs;

/// The demo's walk of 75 kg, by a model that is 2 % heavier.
const WALK: [&str; 7] = [
    "demo/input/walk.mot",
    "--model",
    "demo/input/figure.osim",
    "--loads",
    "demo/input/walk_grf.xml",
    "--add-mass",
    "torso:1.5",
];

fn with_demo(name: &str) -> Workbench {
    let bench = Workbench::empty(name);
    bench.run(&["demo", "-o", "demo", "--quiet"]).done();
    bench
}

/// Runs `forces` and reads its summary.
fn forces(bench: &Workbench, args: &[&str], output: &str) -> (Value, String) {
    let run = bench.run(&[&["forces", "--verbose"], args, &["-o", output]].concat());
    assert!(matches!(run.code, Some(0 | 1)), "{}", run.stderr);
    let bytes = fs::read(bench.folder.join(output).join("summary.json")).unwrap();
    (serde_json::from_slice(&bytes).unwrap(), run.stdout)
}

fn number(value: &Value, path: &str) -> f64 {
    value.pointer(path).and_then(Value::as_f64).unwrap_or_else(|| panic!("{path} in {value}"))
}

#[test]
fn the_written_motion_agrees_with_the_forces_and_is_labelled_as_changed() {
    let bench = with_demo("consistent");
    let (plain, stdout) = forces(&bench, &WALK, "plain");
    assert!(plain["consistency"].is_null() && !stdout.contains("residual reduction"), "{stdout}");
    let (reduced, stdout) = forces(&bench, &[&WALK[..], &["--consistent"]].concat(), "reduced");
    let part = &reduced["consistency"];
    assert!(number(part, "/residual_before/force_rms_bw") > 0.01, "{part}");
    assert!(number(part, "/residual_after/force_rms_bw") < 0.003, "{part}");
    assert!((number(part, "/mass_percent") + 2.0).abs() < 0.5, "{part}");
    assert!((number(&reduced, "/mass/kg") - 75.0).abs() < 0.4, "{}", reduced["mass"]);
    let changes = part["changes"].as_object().unwrap();
    assert!(
        changes.values().all(|c| c["unit"] == "deg" && c["max"].as_f64() < Some(2.0) || c["unit"] == "mm"),
        "{part}"
    );
    assert!((number(&reduced, "/residual/force_rms_bw") - number(part, "/residual_after/force_rms_bw")).abs() < 1e-3);
    assert!(stdout.contains("residual reduction, ") && stdout.contains("residual after"), "{stdout}");
    let head = |folder: &str| {
        let text = fs::read_to_string(bench.folder.join(folder).join("kinematics.mot")).unwrap();
        text.lines().next().unwrap().to_owned()
    };
    assert_eq!(head("plain"), "Coordinates");
    assert_eq!(head("reduced"), "Coordinates, changed to agree with the forces");
    // Motion, forces and body once more, as files: inside the window little is missing.
    let [from, to] = ["/window_s/0", "/window_s/1"].map(|path| (number(part, path)).to_string());
    let again = [
        "reduced/kinematics.mot",
        "--model",
        "reduced/subject.osim",
        "--loads",
        "reduced/external_loads.xml",
        "--cutoff",
        "off",
        "--from",
        &from,
        "--to",
        &to,
    ];
    let (again, _) = forces(&bench, &again, "again");
    let (plain_left, left) = (number(&plain, "/residual/force_rms_bw"), number(&again, "/residual/force_rms_bw"));
    // The table has zeros where a foot carries less than 20 N (2.7 % of this weight), and accelerations at its ends are
    // guessed.
    assert!(left < 0.02 && left < 0.5 * plain_left, "{plain_left} -> {left}");
}

#[test]
fn the_body_can_be_kept_and_forces_are_required() {
    let bench = with_demo("consistent_motion");
    let (reduced, stdout) = forces(&bench, &[&WALK[..], &["--consistent=motion"]].concat(), "out");
    let part = &reduced["consistency"];
    assert!(part["mass_percent"] == 0.0 && part["trunk_center_mm"] == serde_json::json!([0.0, 0.0, 0.0]), "{part}");
    assert!(!stdout.contains("mass centre of") && bench.exists("out/kinematics_recorded.mot"), "{stdout}");
    let run = bench.run(&[&["forces"], &WALK[..], &["--consistent", "--no-ground", "-o", "out"]].concat());
    assert_eq!(run.code, Some(2));
    assert!(run.stderr.contains("--consistent") && run.stderr.contains("--no-ground"), "{}", run.stderr);
    let short = [&["forces"], &WALK[..], &["--consistent", "--from", "1.5", "--to", "1.65", "-o", "out"]].concat();
    let run = bench.run(&short);
    assert_eq!(run.code, Some(2));
    assert!(run.stderr.contains("frames of the motion; expected at least 8"), "{}", run.stderr);
}
