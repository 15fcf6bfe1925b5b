//! Force plates of a C3D: assignment of feet by the user, ignored plates, and the resulting cycles and mass.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]

mod workbench;

use serde_json::Value;
use std::collections::BTreeSet;
use std::fs;
use workbench::Workbench;

/// Runs `forces` on the demo's C3D, whose nine plates each catch one step: 1 to 4 right, 5 to 9 left.
fn forces(bench: &Workbench, options: &[&str]) -> (Value, String) {
    let mut args = vec![
        "forces",
        "demo/input/walk.c3d",
        "--static",
        "demo/input/standing.c3d",
        "--mass",
        "75",
        "--height",
        "1.75",
    ];
    args.extend(options);
    args.extend(["-o", "out"]);
    let run = bench.run(&args);
    assert!(matches!(run.code, Some(0 | 1)), "{}", run.stderr);
    let summary = serde_json::from_slice(&fs::read(bench.folder.join("out/summary.json")).unwrap()).unwrap();
    (summary, run.stderr)
}

fn rows(bench: &Workbench, file: &str) -> Vec<Vec<String>> {
    let text = fs::read_to_string(bench.folder.join("out").join(file)).unwrap();
    text.lines().skip(1).map(|line| line.split(',').map(str::to_owned).collect()).collect()
}

fn with_demo(name: &str) -> Workbench {
    let bench = Workbench::empty(name);
    bench.run(&["demo", "-o", "demo", "--quiet"]).done();
    bench
}

/// Side and number of every cycle.
fn cycles(bench: &Workbench) -> BTreeSet<(String, String)> {
    rows(bench, "cycles.csv").into_iter().map(|row| (row[1].clone(), row[2].clone())).collect()
}

#[test]
fn cycles_begin_with_a_foot_strike_on_a_plate_and_may_end_with_one_from_the_motion() {
    let bench = with_demo("two_plates");
    let (all, _) = forces(&bench, &[]);
    assert_eq!((all["mass_source"].as_str(), cycles(&bench).len()), (Some("plates"), 6));
    let off: Vec<&str> = ["1=off", "3=off", "4=off", "5=off", "6=off", "8=off", "9=off"].into();
    let options: Vec<&str> = off.iter().flat_map(|plate| ["--plate", *plate]).collect();
    let (two, _) = forces(&bench, &options);
    let contacts = two["subject"]["plates"].as_array().unwrap();
    let sides: Vec<&str> = contacts.iter().map(|c| c["side"].as_str().unwrap()).collect();
    assert_eq!(sides, ["r", "l"], "{contacts:?}");
    assert_eq!(cycles(&bench).into_iter().map(|(side, _)| side).collect::<String>(), "lr", "one cycle of each foot");
    // Two plates measure no whole cycle, so the mass is from the standing trial.
    assert_eq!(two["mass_source"], "standing");
    assert!((two["mass_kg"].as_f64().unwrap() - 75.0).abs() < 0.1, "{}", two["mass_kg"]);
    let strikes = rows(&bench, "events.csv").into_iter().filter(|row| row[1] == "strike").count();
    assert!(strikes >= 7, "the file's own list goes on: {strikes}");
    // Single support of either foot with the double support between: from the left foot's off to the right foot's next strike.
    let window = two["subject"]["instrumented_windows_s"][0].as_array().unwrap();
    let (from, to) = (window[0].as_f64().unwrap(), window[1].as_f64().unwrap());
    assert!((from - 1.436).abs() < 0.03 && (to - 2.409).abs() < 0.03, "{from} to {to}");
    let residual = two["residual"]["force_rms_bw"].as_f64().unwrap();
    assert!(residual < 0.1, "only while plates saw both feet: {residual}");
}

#[test]
fn the_user_can_assign_a_foot_to_a_plate() {
    let bench = with_demo("told_plate");
    let (told, _) = forces(&bench, &["--plate", "2=l"]);
    let second = &told["subject"]["plates"][1];
    assert_eq!((second["plate"].as_str(), second["side"].as_str()), (Some("plate 2"), Some("l")));
    let run = bench.run(&["forces", "demo/input/walk.c3d", "--mass", "75", "--plate", "12=r", "-o", "out"]);
    assert_eq!(run.code, Some(2));
    assert!(run.stderr.contains("--plate 12") && run.stderr.contains("9 force plates"), "{}", run.stderr);
}
