//! The command line: guide, help, options, small tools, result folders.

use crate::workbench::{FORCES, RAW, Workbench};
use serde_json::Value;

#[test]
fn without_arguments_the_command_prints_a_guide() {
    let run = Workbench::empty("guide").run(&[]).done();
    for verb in [
        "ambulo demo",
        "ambulo walk",
        "ambulo forces",
        "ambulo session",
        "ambulo run",
        "ambulo stream",
        "ambulo simulate",
        "ambulo tune",
        "ambulo report",
        "ambulo view",
        "ambulo info",
        "ambulo convert",
        "ambulo events",
        "ambulo compare",
        "--help",
    ] {
        assert!(run.stdout.contains(verb), "{}", run.stdout);
    }
    assert!(run.stderr.is_empty(), "{}", run.stderr);
}

#[test]
fn the_help_of_every_command_has_an_example() {
    let bench = Workbench::empty("help");
    for verb in [
        "demo", "walk", "forces", "run", "session", "stream", "validate", "simulate", "tune", "report", "view", "info",
        "convert", "events", "compare",
    ] {
        let run = bench.run(&[verb, "--help"]).done();
        let example = run.stdout.split("Example").nth(1).unwrap_or_default();
        assert!(example.contains(&format!("ambulo {verb}")), "{}", run.stdout);
        assert!(run.stderr.is_empty(), "{}", run.stderr);
    }
    assert!(bench.run(&["--version"]).done().stdout.contains(env!("CARGO_PKG_VERSION")));
}

#[test]
fn invalid_options_exit_with_two_and_state_the_valid_ones() {
    let bench = Workbench::new("options");
    let cases: [(&[&str], &str); 12] = [
        (&["dance"], "unrecognized subcommand"),
        (&["forces"], "<INPUT>"),
        (&["forces", "walk.mot"], "`--model FILE.osim`"),
        (&["forces", "walk.mot", "--model", "figure.osim", "--fast"], "--fast"),
        (&["info"], "<FILE>"),
        (&["compare", "walk.mot"], "<B>"),
        (&["forces", "walk.mot", "--model", "figure.osim", "--cutoff", "0"], "a frequency above 0"),
        (&["forces", "walk.mot", "--model", "figure.osim", "--cutoff", "six"], "or `off`"),
        (&["forces", "walk.mot", "--model", "figure.osim", "--right", "calcn_r"], "BODY:PREFIX"),
        (&["forces", "walk.mot", "--model", "figure.osim", "--add-mass", "torso"], "BODY:KG"),
        (&["forces", "walk.mot", "--model", "figure.osim", "--add-mass", "torso:1:2,3"], "BODY:KG:X,Y,Z"),
        (
            &["forces", "walk.mot", "--model", "figure.osim", "--loads", "a.xml", "--right", "r:force", "--grf", "g"],
            "cannot be used with",
        ),
    ];
    for (args, words) in cases {
        let run = bench.run(args);
        assert_eq!(run.code, Some(2), "{args:?}: {}", run.stderr);
        assert!(run.stderr.contains(words), "{args:?}: {}", run.stderr);
    }
}

#[test]
fn compare_exits_with_one_if_a_limit_is_exceeded_and_two_if_nothing_can_be_compared() {
    let bench = Workbench::empty("compare");
    let table = |offset: f64| {
        format!("t\nendheader\ntime\ta\tb\n0\t{}\t1\n1\t{}\t2\n2\t{}\t3\n", offset, 1.0 + offset, 2.0 + offset)
    };
    bench.write("a.sto", table(0.0));
    bench.write("b.sto", table(0.25));
    let same = bench.run(&["compare", "a.sto", "a.sto", "--limit", "0"]).done();
    assert!(same.stdout.contains("0 of 2 columns over the limit"), "{}", same.stdout);
    bench.run(&["compare", "a.sto", "b.sto"]).done();
    bench.run(&["compare", "a.sto", "b.sto", "--limit", "0.26"]).done();
    let over = bench.run(&["compare", "a.sto", "b.sto", "--limit", "0.24"]);
    assert_eq!(over.code, Some(1), "{}", over.stderr);
    assert!(over.stdout.contains("1 of 2 columns over the limit"), "{}", over.stdout);
    bench.run(&["compare", "a.sto", "b.sto", "--limit", "0.24", "--columns", "b"]).done();
    let json: Value = serde_json::from_str(&bench.run(&["compare", "a.sto", "b.sto", "--json"]).done().stdout).unwrap();
    assert!((json[0]["rmse"].as_f64().unwrap() - 0.25).abs() < 1e-12 && json[0]["samples"] == 3, "{json}");

    bench.run(&["compare", "a.sto", "b.sto", "--columns", "c"]).refused(&["there is no column `c`", "a, b"]);
    bench
        .run(&["compare", "a.sto", "b.sto", "--from", "7"])
        .refused(&["no row between --from and --to", "covers 0 s to 2 s"]);
    bench.write("late.sto", "t\nendheader\ntime\ta\n8\t1\n9\t1\n");
    bench.run(&["compare", "a.sto", "late.sto"]).refused(&["no common time", "the other 8 s to 9 s"]);
    bench.write("other.sto", "t\nendheader\ntime\tz\n0\t1\n");
    bench.run(&["compare", "a.sto", "other.sto"]).refused(&["no column in common"]);
    bench.write("hole.sto", "t\nendheader\ntime\ta\n0\tnan\n1\t1\n");
    bench.run(&["compare", "a.sto", "hole.sto"]).refused(&["column `a`", "not a finite number at 0.0000 s", "hint: "]);
}

#[test]
fn compare_rejects_decreasing_times() {
    // Values between samples are looked up by bisection, which returns nonsense in unsorted instants.
    let bench = Workbench::empty("compare_clock");
    bench.write("a.sto", "t\nendheader\ntime\ta\n0\t0\n2\t2\n1\t1\n3\t3\n");
    bench.write("b.sto", "t\nendheader\ntime\ta\n0\t0\n1\t1\n2\t2\n3\t3\n");
    bench.run(&["compare", "a.sto", "b.sto"]).refused(&["a.sto", "time"]);
}

#[test]
fn info_describes_each_kind_of_file() {
    let bench = Workbench::new("info");
    let json = |file: &str| serde_json::from_str::<Value>(&bench.run(&["info", file, "--json"]).done().stdout).unwrap();
    let model = json("figure.osim");
    assert_eq!(model["kind"], "OpenSim model");
    assert!((model["mass_kg"].as_f64().unwrap() - 72.0).abs() < 0.01, "{model}");
    assert_eq!((model["bodies"].as_array().unwrap().len(), model["coordinates"].as_array().unwrap().len()), (8, 19));
    let motion = json("walk.mot");
    assert_eq!(
        (&motion["kind"], &motion["rows"], &motion["angles"]),
        (&"OpenSim storage".into(), &291.into(), &"degrees".into())
    );
    assert!((motion["rate_hz"].as_f64().unwrap() - 100.0).abs() < 1e-9, "{motion}");
    let loads = json("walk_grf.xml");
    assert_eq!((&loads["kind"], &loads["data_file"]), (&"external loads".into(), &"walk_grf.mot".into()));
    bench.write("a.csv", "time,force\n0,1\n0.5,2\n");
    assert_eq!(json("a.csv")["columns"], serde_json::json!(["time", "force"]));
    bench.write(
        "a.trc",
        "PathFileType\t4\t(X/Y/Z)\ta.trc\nDataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\t\
         OrigDataStartFrame\tOrigNumFrames\n100\t100\t1\t1\tmm\t100\t1\t1\nFrame#\tTime\tHeel\t\t\n\t\tX1\tY1\tZ1\n\n\
         1\t0.0\t12.5\t30\t-4.1\n",
    );
    assert_eq!(json("a.trc")["markers"], serde_json::json!(["Heel"]));
    for file in ["figure.osim", "walk.mot", "walk_grf.xml", "a.csv", "a.trc"] {
        let run = bench.run(&["info", file]).done();
        assert!(run.stdout.starts_with("kind: ") || run.stdout.contains("\nkind: "), "{file}: {}", run.stdout);
    }
}

#[test]
fn an_input_file_is_never_overwritten() {
    let bench = Workbench::new("same_folder");
    bench.write("external_loads.xml", bench.read("walk_grf.xml"));
    let before = bench.read("external_loads.xml");
    bench
        .run(&[&FORCES[..4], &["--loads", "external_loads.xml", "-o", "."], &RAW].concat())
        .refused(&["external_loads.xml: this input file would be overwritten", "hint: choose another folder"]);
    assert_eq!(bench.read("external_loads.xml"), before);
}

#[test]
fn results_of_an_earlier_run_are_removed() {
    let bench = Workbench::new("stale");
    bench.forces(&[&RAW[..], &["-o", "out"]].concat()).done();
    assert!(!bench.read("out/cycles.csv").is_empty());
    bench.write("out/notes.txt", "mine");
    bench.run(&[&FORCES[..4], &RAW, &["--no-ground", "-o", "out"]].concat()).done();
    assert!(
        !bench.exists("out/cycles.csv") && !bench.exists("out/grf.mot") && !bench.exists("out/figures/moments.svg")
    );
    assert!(bench.exists("out/moments.sto") && bench.exists("out/notes.txt"));
}
