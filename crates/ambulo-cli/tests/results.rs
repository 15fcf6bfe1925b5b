//! What a run leaves behind: files, numbers, how they are read back.

use crate::workbench::{FORCES, RAW, Workbench};
use ambulo::findings::Findings;
use ambulo::model::from_osim;
use ambulo::numerics::mean;
use ambulo_formats::external_loads::ExternalLoads;
use ambulo_formats::osim::OsimModel;
use ambulo_formats::table::Table;
use serde_json::Value;

/// Largest difference of a column in two tables of the same length.
fn largest_difference(a: &Table, b: &Table, column: &str) -> f64 {
    let (a, b) = (a.column(column).unwrap(), b.column(column).unwrap());
    assert_eq!(a.len(), b.len(), "{column}");
    a.iter().zip(b).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max)
}

#[test]
fn a_run_writes_the_documented_files_with_the_documented_columns() {
    let bench = Workbench::new("files");
    let run = bench.forces(&RAW).done();
    assert!(run.stdout.contains("demo_figure") && run.stdout.contains("ankle_angle_r_moment"), "{}", run.stdout);
    let coordinates = bench.table("walk.mot").names()[1..].to_vec();
    let model = from_osim(&OsimModel::read(&bench.read("figure.osim")).unwrap(), &mut Findings::default()).unwrap();
    let times = bench.table("walk.mot").times().unwrap().to_vec();
    let expect = |file: &str, names: &mut dyn Iterator<Item = String>| {
        let table = bench.table(&format!("out/{file}"));
        let names: std::collections::BTreeSet<String> = names.chain(["time".into()]).collect();
        let found: std::collections::BTreeSet<String> = table.names().iter().cloned().collect();
        assert_eq!(found, names, "{file}");
        let largest = table.times().unwrap().iter().zip(&times).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(table.rows() == times.len() && largest < 1e-9, "{file} has other instants: {} rows", table.rows());
        // Written and read, it is the same bytes when written again.
        assert_eq!(table.write_storage(), bench.read(&format!("out/{file}")), "{file}");
        table
    };
    let kinematics = expect("kinematics.mot", &mut coordinates.iter().cloned());
    assert_eq!(kinematics.in_degrees, Some(true));
    for name in &coordinates {
        let difference = largest_difference(&kinematics, &bench.table("walk.mot"), name);
        assert!(difference < 1e-9, "without a filter `{name}` changes by {difference}");
    }
    expect("moments.sto", &mut model.force_names().into_iter());
    expect("powers.sto", &mut coordinates.iter().map(|c| format!("{c}_power")));
    let axes = |stem: String| ["x", "y", "z"].map(|axis| format!("{stem}{axis}"));
    let parts = |s: &str| ["ground_force_S_v", "ground_force_S_p", "ground_torque_S_"].map(|p| p.replace('S', s));
    expect("grf.mot", &mut ["r", "l"].iter().flat_map(|s| parts(s)).flat_map(axes));
    let joints = model
        .bodies()
        .iter()
        .flat_map(|b| ["f", "m", "p"].map(|part| format!("{}_on_{}_in_ground_{part}", b.joint.name, b.name)));
    expect("reactions.sto", &mut joints.flat_map(axes));

    let events = bench.text("out/events.csv");
    assert!(events.starts_with("side,event,time\n"), "{events}");
    for line in events.lines().skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        assert!(["r", "l"].contains(&cells[0]) && ["strike", "off"].contains(&cells[1]), "{line}");
        assert!(cells[2].parse::<f64>().is_ok_and(|t| (0.0..=3.0).contains(&t)), "{line}");
    }
    let cycles = bench.text("out/cycles.csv");
    assert!(cycles.starts_with("quantity,side,cycle,percent,value,unit\n"));
    assert_eq!((cycles.lines().count() - 1) % 101, 0, "a cycle has 101 rows");
    assert!(bench.text("out/figures/moments.svg").contains("</svg>"));
    let (loads, remarks) = ExternalLoads::read(&bench.read("out/external_loads.xml")).unwrap();
    assert!(remarks.is_empty() && loads.datafile.as_deref() == Some("grf.mot") && loads.forces.len() == 2);
}

#[test]
fn the_summary_has_its_stable_keys() {
    let bench = Workbench::new("summary");
    bench.forces(&RAW).done();
    let summary = bench.json("out/summary.json");
    for key in [
        "version",
        "input",
        "model",
        "mass_kg",
        "mass",
        "height_m",
        "speed_m_s",
        "window_s",
        "filter",
        "ground",
        "residual",
        "peaks",
        "times_and_distances",
        "findings",
        "verdict",
        "comparison",
    ] {
        assert!(summary.get(key).is_some(), "no key `{key}`");
    }
    for key in ["force_rms_n", "force_peak_n", "force_rms_bw", "moment_rms_nm", "moment_peak_nm"] {
        assert!(summary["residual"][key].is_number(), "no key `residual.{key}`");
    }
    assert_eq!(summary["version"], env!("CARGO_PKG_VERSION"));
    assert_eq!(summary["window_s"], serde_json::json!([0.0, 2.9]));
    // The figure has 72 kg, and its plates carry it.
    assert!((summary["mass_kg"].as_f64().unwrap() - 72.0).abs() < 0.5, "{}", summary["mass_kg"]);
}

#[test]
fn quiet_prints_nothing_and_json_is_the_summary() {
    let bench = Workbench::new("voices");
    let quiet = bench.forces(&[&RAW[..], &["--quiet"]].concat()).done();
    assert!(quiet.stdout.is_empty() && quiet.stderr.is_empty(), "{}{}", quiet.stdout, quiet.stderr);
    let json = bench.forces(&[&RAW[..], &["--json"]].concat()).done();
    let printed: Value = serde_json::from_str(&json.stdout).unwrap();
    assert_eq!(printed, bench.json("out/summary.json"));
    for args in [&["info", "walk.mot"][..], &["compare", "walk.mot", "walk.mot"]] {
        let json = bench.run(&[args, &["--json"]].concat()).done();
        serde_json::from_str::<Value>(&json.stdout).unwrap();
        assert!(bench.run(&[args, &["--quiet"]].concat()).done().stdout.is_empty());
    }
    // Errors are printed all the same.
    bench.run(&["info", "no.mot", "--quiet"]).refused(&["no.mot"]);
}

#[test]
fn two_runs_give_identical_bytes_but_for_their_durations() {
    let bench = Workbench::new("determinism");
    let files = |folder: &str| {
        bench.forces(&["-o", folder]).done();
        let names = bench.names(folder).into_iter().filter(|name| name != "timings.json");
        names.map(|name| (name.clone(), bench.read(&format!("{folder}/{name}")))).collect::<Vec<_>>()
    };
    let (first, second) = (files("first"), files("second"));
    assert!(first.len() >= 10, "{}", first.len());
    assert!(first == second);
    let timings = |folder: &str| bench.json(&format!("{folder}/timings.json"));
    let (summary, first) = (bench.json("first/summary.json"), timings("first"));
    assert_eq!((&first["run_id"], &timings("second")["run_id"]), (&summary["run_id"], &summary["run_id"]));
    for stage in ["read_model", "inverse_dynamics", "tables", "report"] {
        assert!(first["timing_ms"][stage].as_f64().unwrap() >= 0.0, "{stage}");
    }
}

#[test]
fn a_quiet_run_writes_no_durations_and_removes_those_of_an_earlier_one() {
    let bench = Workbench::new("quiet_durations");
    bench.forces(&[]).done();
    assert!(bench.exists("out/timings.json"));
    bench.forces(&["--quiet"]).done();
    assert!(!bench.exists("out/timings.json"));
    let before = bench.read("out/summary.json");
    bench.forces(&["--keep", "timings"]).done();
    assert_eq!(bench.names("out"), ["summary.json", "timings.json"]);
    // Earlier versions wrote durations to the summary, which still reads.
    let mut earlier: Value = serde_json::from_slice(&before).unwrap();
    earlier["timing_ms"] = serde_json::json!({ "read_model": 1.5 });
    bench.forces(&["--quiet"]).done();
    bench.write("out/summary.json", serde_json::to_vec(&earlier).unwrap());
    bench.run(&["report", "out"]).done();
    bench.run(&["compare", "out/moments.sto", "out/moments.sto"]).done();
}

#[test]
fn the_written_ground_forces_give_the_same_moments_when_fed_back() {
    let bench = Workbench::new("fed_back");
    bench.forces(&RAW).done();
    let again =
        ["forces", "walk.mot", "--model", "figure.osim", "--grf", "out/grf.mot", "--loads", "out/external_loads.xml"];
    let judged = ["--thresholds", "thresholds.toml"];
    bench.run(&[&again[..], &RAW, &judged, &["-o", "again"]].concat()).done();
    let grf = bench.table("walk_grf.mot");
    let vertical = |side: &str| grf.column(&format!("ground_force_{side}_vy")).unwrap();
    let (first, second) = (bench.table("out/moments.sto"), bench.table("again/moments.sto"));
    let mut small_loads = 0;
    for name in first.names().iter().skip(1) {
        let (a, b) = (first.column(name).unwrap(), second.column(name).unwrap());
        for frame in 0..first.rows() {
            let small = |side: &str| vertical(side)[frame].abs() < 20.0;
            let lost: f64 = ["r", "l"].iter().filter(|s| small(s)).map(|s| vertical(s)[frame].abs()).sum();
            small_loads += usize::from(lost > 0.0);
            // Centre of pressure and free moment carry the wrench to rounding (1e-13 of 1000 N.m about the origin).
            // Below 20 N a side the file contains zeros: what is lost acts at an arm of at most 1.3 m, hips to floor
            // and a step, and its horizontal part is at most half of it.
            let allowed = 1e-9 + 1.5 * lost * 1.3;
            let difference = (a[frame] - b[frame]).abs();
            assert!(difference <= allowed, "{name}, frame {frame}: {difference}, {lost} N were lost");
        }
    }
    println!("{small_loads} of {} numbers stand at loads below 20 N", first.rows() * (first.names().len() - 1));
    // The same file without its description is recognised by its column names.
    bench.run(&[&again[..6], &RAW, &judged, &["-o", "guessed"]].concat()).done();
    assert_eq!(bench.read("guessed/moments.sto"), bench.read("again/moments.sto"));
    // Left out, the forces are missed: several hundred newtons at the root.
    bench.run(&[&FORCES[..4], &RAW, &["--no-ground", "-o", "without"]].concat()).done();
    assert!(largest_difference(&first, &bench.table("without/moments.sto"), "pelvis_ty_force") > 500.0);
}

#[test]
fn feet_can_be_named_on_the_command_line_instead_of_in_a_document() {
    let bench = Workbench::new("named_feet");
    bench.forces(&RAW).done();
    let feet = ["--right", "calcn_r:ground_force_r_", "--left", "calcn_l:ground_force_l_", "-o", "named"];
    bench.run(&[&FORCES[..6], &FORCES[8..], &feet, &RAW].concat()).done();
    assert_eq!(bench.read("out/moments.sto"), bench.read("named/moments.sto"));
    let swapped = ["--right", "calcn_r:ground_force_l_", "--left", "calcn_l:ground_force_r_", "-o", "swapped"];
    bench.run(&[&FORCES[..6], &FORCES[8..], &swapped, &RAW].concat()).infeasible();
    let difference =
        largest_difference(&bench.table("out/moments.sto"), &bench.table("swapped/moments.sto"), "knee_angle_r_moment");
    assert!(difference > 50.0, "swapped feet change the knee by {difference} N.m only");
}

#[test]
fn a_device_that_gives_half_of_the_ankle_moment_leaves_the_other_half_to_the_body() {
    let bench = Workbench::new("results_with_device");
    bench.forces(&RAW).done();
    let total = bench.table("out/moments.sto");
    let half: Vec<f64> = total.column("ankle_angle_r_moment").unwrap().iter().map(|x| 0.5 * x).collect();
    let times = total.times().unwrap().to_vec();
    let device = Table::new("exoskeleton", vec![("time".into(), times), ("ankle_angle_r_moment".into(), half.clone())]);
    bench.write("device.sto", device.unwrap().write_storage());
    bench.forces(&[&RAW[..], &["--device", "device.sto", "-o", "worn"]].concat()).done();
    assert_eq!(bench.read("worn/moments.sto"), bench.read("out/moments.sto"), "the total does not change");
    let body = bench.table("worn/moments_biological.sto");
    for name in total.names().iter().skip(1) {
        let expected = if name == "ankle_angle_r_moment" { &half[..] } else { total.column(name).unwrap() };
        let worst = body.column(name).unwrap().iter().zip(expected).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(worst < 1e-9, "{name}: {worst}");
    }
    assert!(!bench.folder.join("out/moments_biological.sto").exists());
    bench.write("device.sto", "x\nendheader\ntime elbow\n0 1\n1 1\n");
    bench.forces(&["--device", "device.sto"]).refused(&[
        "device.sto",
        "no column of the device",
        "ankle_angle_r_moment",
    ]);
}

#[test]
fn a_mass_carried_on_the_torso_loads_the_back_and_the_root_and_no_leg() {
    let bench = Workbench::new("add_mass");
    bench.forces(&RAW).done();
    let carried = ["--add-mass", "torso:10:-0.15,0.3,0", "-o", "carried"];
    bench.forces(&[&RAW[..], &carried].concat()).done();
    let strength_of = |folder: &str| {
        let summary: Value = serde_json::from_str(&bench.text(&format!("{folder}/summary.json"))).unwrap();
        summary["verdict"]["mass_kg"].as_f64().unwrap()
    };
    assert!((strength_of("carried") - strength_of("out")).abs() < 1e-9, "a load makes nobody stronger");
    let (before, after) = (bench.table("out/moments.sto"), bench.table("carried/moments.sto"));
    let more = |name: &str| mean(after.column(name).unwrap()) - mean(before.column(name).unwrap());
    // The plates did not feel it, so the root must hold it: m g on the average, and m Δv / T for what its speed changes
    // from the first frame to the last (at most 0.3 m/s over 2.9 s: 1 N).
    assert!((more("pelvis_ty_force") - 98.07).abs() < 1.0, "{} N", more("pelvis_ty_force"));
    // 0.15 m behind the back's centre, 15 N.m of extension are to be held, less or more as the trunk leans by degrees
    // (10 degrees move it by 0.05 m: 5 N.m).
    assert!((more("lumbar_extension_moment").abs() - 14.7).abs() < 6.0, "{} N.m", more("lumbar_extension_moment"));
    // A leg's moments follow from what is below them.
    for name in ["hip_flexion_r_moment", "knee_angle_l_moment", "ankle_angle_r_moment"] {
        assert!(largest_difference(&before, &after, name) < 1e-9, "{name}");
    }
    // A shoe of 1 kg does change the hip.
    bench.forces(&[&RAW[..], &["--add-mass", "calcn_r:1:0.05,-0.05,0", "-o", "shod"]].concat()).done();
    let hip = largest_difference(&before, &bench.table("shod/moments.sto"), "hip_flexion_r_moment");
    assert!(hip > 3.0, "a shoe of 1 kg changes the hip by {hip} N.m only");
    assert!(largest_difference(&before, &bench.table("shod/moments.sto"), "hip_flexion_l_moment") < 1e-9);
    for (mass, words) in [
        ("torso:-1000", "the mass is -1000 kg"),
        ("torso:nan", "the mass is NaN kg"),
        ("torso:1e308", "a mass of 1e308 kg on `torso`; expected at most 360 kg, five times the mass of the model"),
        ("torso:361", "a mass of 361 kg"),
        ("torso:1:0,-150,0", "150 m from the origin of `torso`; expected at most 5 m, because"),
    ] {
        bench.forces(&["--add-mass", mass]).refused(&["--add-mass", words]);
    }
    bench.forces(&[&RAW[..], &["--add-mass", "torso:100", "-o", "heavy"]].concat()).warned(&[]);
}

#[test]
fn from_and_to_cut_the_range_without_changing_a_number() {
    let bench = Workbench::new("window");
    bench.forces(&["--cutoff", "6"]).done();
    bench.forces(&["--cutoff", "6", "--from", "0.5", "--to", "1.25", "-o", "cut"]).done();
    let (whole, cut) = (bench.table("out/moments.sto"), bench.table("cut/moments.sto"));
    assert_eq!(cut.rows(), 76);
    assert!((cut.times().unwrap()[0] - 0.5).abs() < 1e-9 && (cut.times().unwrap()[75] - 1.25).abs() < 1e-9);
    for name in whole.names().iter().skip(1) {
        let pairs = whole.column(name).unwrap()[50..126].iter().zip(cut.column(name).unwrap());
        // Instants of the two grids differ in the last bit; moments change by up to 1e4 N.m/s.
        let worst = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(worst < 1e-7, "{name}: {worst}");
    }
    bench.forces(&["--from", "5", "--to", "6"]).refused(&[
        "the range from 5 s to 6 s is outside of the recorded time, 0.000 s to 2.900 s",
        "hint: choose a range inside the recorded time",
    ]);
    bench.forces(&["--from", "100"]).refused(&["the start of the range, 100 s, is outside of the recorded time"]);
    bench.forces(&["--to", "-5"]).refused(&["the end of the range, -5 s, is outside of the recorded time"]);
    bench.forces(&["--from", "2", "--to", "1"]).refused(&["the start, 2 s, is after the end, 1 s"]);
    bench.forces(&["--cutoff", "80"]).refused(&["cut-off is 80 Hz", "hint: "]);
    // With 1e-308 Hz the filtered forces were not finite, and the verdict was feasible.
    for cutoff in ["1e-308", "1e-9", "0.09"] {
        bench.forces(&["--cutoff", cutoff]).refused(&["cut-off is", "allowed are 0.1 Hz, because", "below 50 Hz"]);
        bench.forces(&["--force-cutoff", cutoff]).refused(&["--force-cutoff", "expected a frequency from 1 to 500 Hz"]);
    }
    bench.forces(&["--from", "-1e308"]).refused(&["starts or ends at -1e308 s", "near the recording", "--from"]);
    bench.forces(&["--order", "0"]).refused(&["expected a whole number from 1 to 8"]);
    bench.forces(&["--from", "nan"]).refused(&["expected a number of seconds"]);
    bench.forces(&["--cutoff", "-6"]).refused(&["expected a frequency above 0 in Hz, or `off`"]);
}
