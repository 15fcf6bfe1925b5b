//! `ambulo walk` and `ambulo demo`: files, summary, verdict, and errors.

use crate::workbench::{RAW, Workbench};
use serde_json::Value;

/// Every file of a walk.
const FILES: [&str; 12] = [
    "kinematics.mot",
    "moments.sto",
    "powers.sto",
    "reactions.sto",
    "grf.mot",
    "external_loads.xml",
    "events.csv",
    "cycles.csv",
    "summary.json",
    "figure.osim",
    "figures/moments.svg",
    "figures/gait.svg",
];

fn rows<'a>(text: &'a str, begin: &str) -> Vec<&'a str> {
    text.lines().filter(|line| line.starts_with(begin)).collect()
}

#[test]
fn a_walk_writes_the_files_of_a_recording_with_the_same_times() {
    let bench = Workbench::empty("walk_files");
    let run = bench.run(&["walk", "--cycles", "2", "--verbose", "-o", "out"]).done();
    for words in ["de-leva-male 75 kg 1.75 m, gait free", "ankle_angle_r_moment", "optimal mode", "verdict   feasible"]
    {
        assert!(run.stdout.contains(words), "{words}: {}", run.stdout);
    }
    for file in FILES {
        assert!(!bench.read(&format!("out/{file}")).is_empty(), "{file}");
    }
    let times = bench.table("out/kinematics.mot").times().unwrap().to_vec();
    assert!((times[1] - times[0] - 0.01).abs() < 1e-9 && times[0].abs() < 1e-12);
    for file in ["moments.sto", "powers.sto", "reactions.sto", "grf.mot"] {
        assert_eq!(bench.table(&format!("out/{file}")).times().unwrap(), times, "{file}");
    }
    let events = bench.text("out/events.csv");
    assert_eq!((rows(&events, "r,strike").len(), rows(&events, "l,strike").len()), (3, 3), "{events}");
    let cycles = bench.text("out/cycles.csv");
    assert_eq!(rows(&cycles, "hip_flexion_moment,r,2,").len(), 101);
    assert!(rows(&cycles, "hip_flexion_moment,r,3,").is_empty());
}

#[test]
fn the_summary_states_how_the_walk_was_computed() {
    let bench = Workbench::empty("walk_summary");
    let number = |value: &Value| value.as_f64().unwrap_or_else(|| panic!("{value} is no number"));
    // The root of a simulated walk is held by a torque; that of an optimal one by nothing.
    for (options, mode, slip_mm, held_nm) in
        [(&[][..], "optimal", 6.0, 2.0), (&["--planar"][..], "corrected", 2.0, 5.0)]
    {
        let run = bench.run(&[&["walk", "--cycles", "1", "--json", "-o", "out"], options].concat()).done();
        let summary: Value = serde_json::from_str(&run.stdout).unwrap();
        assert_eq!(summary, bench.json("out/summary.json"));
        let ground = &summary["ground"];
        assert_eq!((&ground["source"], &ground["rule"]), (&"simulated".into(), &"soft shoes".into()));
        assert_eq!((&summary["height_m"], &summary["mass"]["normalised_by"]), (&1.75.into(), &"model".into()));
        assert!((number(&summary["mass_kg"]) - 75.0).abs() < 1e-9);
        assert!((number(&summary["speed_m_s"]) / number(&summary["walk"]["speed_asked_m_s"]) - 1.0).abs() < 0.03);
        assert_eq!(summary["verdict"]["state"], "feasible");
        let walk = &summary["walk"];
        assert_eq!((&walk["gait"], &walk["style"], &walk["mode"]), (&"free".into(), &"knots".into(), &mode.into()));
        for joint in
            ["hip_flexion_r", "knee_angle_r", "ankle_angle_r", "mtp_angle_r", "pelvis_tilt", "lumbar_extension"]
        {
            let size = &walk["adjustment_deg"][joint];
            assert!(number(&size["rms"]) > 0.0 && number(&size["rms"]) <= number(&size["largest"]), "{joint}: {size}");
        }
        for key in ["forward", "up"] {
            assert!(number(&walk["pelvis_path_mm"][key]["largest"]) < 50.0, "{walk}");
        }
        assert!(number(&walk["trunk_torque_nm"]["rms"]) < held_nm && number(&walk["foot_slip_mm"]) < slip_mm, "{walk}");
        assert!(
            number(&walk["parameters_adjusted"]) > 50.0 && !walk["solver"].as_array().unwrap().is_empty(),
            "{walk}"
        );
        assert!(number(&walk["flight_s"]) < 1e-9 && number(&walk["impacts"]) < 0.5, "{walk}");
    }
    // Recordings have no such part.
    let recorded = Workbench::new("walk_summary_of_forces");
    recorded.forces(&RAW).done();
    assert_eq!(recorded.json("out/summary.json")["walk"], Value::Null);
}

#[test]
fn figure_speed_and_steps_can_be_chosen() {
    let bench = Workbench::empty("walk_options");
    let walk = |more: &[&str]| {
        let run = bench.run(&[&["walk", "--cycles", "1", "--json", "-o", "out"], more].concat());
        assert!(matches!(run.code, Some(0 | 1)), "{}", run.stderr);
        serde_json::from_str::<Value>(&run.stdout).unwrap()
    };
    let near = |value: &Value, expected: f64| {
        let found = value.as_f64().unwrap();
        assert!((found - expected).abs() < 1e-6, "{found} instead of {expected}");
    };
    let planar = |more: &[&str]| walk(&[&["--planar"], more].concat());
    let woman = walk(&["--figure", "de-leva-female", "--mass", "58", "--height", "1.62", "--speed", "1.1"]);
    near(&woman["mass_kg"], 58.0);
    near(&woman["height_m"], 1.62);
    near(&woman["walk"]["speed_asked_m_s"], 1.1);
    assert_eq!(woman["walk"]["figure"], "de-leva-female");
    let steps = planar(&["--step-length", "0.6", "--cadence", "110", "--no-toe-joint"]);
    near(&steps["walk"]["step_length_m"], 0.6);
    near(&steps["walk"]["cadence_steps_min"], 110.0);
    near(&steps["walk"]["speed_asked_m_s"], 0.6 * 110.0 / 60.0);
    assert!(!bench.text("out/moments.sto").contains("mtp_angle"));
    // With one number given, the gait decides the rest: short steps stay short at another speed.
    near(&planar(&["--step-length", "0.65"])["walk"]["step_length_m"], 0.65);
    let [short, standard] =
        ["short", "standard"].map(|gait| planar(&["--gait", gait, "--speed", "1.2"])["walk"].clone());
    near(&short["speed_asked_m_s"], 1.2);
    near(&short["step_length_m"], 0.62 * standard["step_length_m"].as_f64().unwrap());
    let rows = |rate: &str| {
        planar(&["--rate", rate]);
        bench.table("out/moments.sto").rows()
    };
    assert!(rows("200").abs_diff(2 * rows("100")) <= 2);
    bench.write("mine.toml", "base = \"slow\"\nspeed = 0.9\n");
    near(&planar(&["--gait", "mine.toml"])["walk"]["speed_asked_m_s"], 0.9);
    assert_eq!(planar(&["--style", "1997"])["walk"]["style"], "1997");
}

#[test]
fn the_walk_of_the_papers_mode_is_infeasible() {
    let bench = Workbench::empty("walk_paper");
    let paper = ["walk", "--gait", "standard", "--mode", "paper", "--figure", "faure-1997", "-v", "-o", "out"];
    let run = bench.run(&paper).infeasible();
    assert!(run.stdout.contains("paper mode") && run.stdout.contains("impacts"), "{}", run.stdout);
    let summary = bench.json("out/summary.json");
    assert_eq!(summary["ground"]["rule"], "rigid soles");
    assert_eq!(summary["walk"]["parameters_adjusted"], Value::Null);
    assert!(summary["walk"]["largest_impact_n_s"].as_f64().unwrap() > 1.0);
    assert!(!summary["verdict"]["reasons"].as_array().unwrap().is_empty());
    assert!(bench.text("out/figures/moments.svg").contains("red: not feasible"));
}

#[test]
fn a_gait_that_cannot_be_made_consistent_gives_a_warning_and_a_verdict() {
    let bench = Workbench::empty("walk_fast_parade");
    bench.write("fast.toml", "name = \"long parade\"\nbase = \"parade\"\nspeed = 4.5\nstep_length = 2.8\n");
    let run = bench.run(&["walk", "--gait", "fast.toml", "--cycles", "1", "-o", "out"]).infeasible();
    run.reports(&["warning: found no motion near this gait that needs no force from outside", "hint: "]);
    let findings = bench.json("out/summary.json")["findings"].clone();
    assert!(findings.as_array().unwrap().iter().any(|f| f["code"] == "walk.not_consistent"), "{findings}");
}

#[test]
fn machines_of_a_gait_file_drive_the_walk_and_their_states_are_written() {
    let bench = Workbench::empty("walk_machines");
    let examples = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/gaits");
    for name in ["limp", "stop-and-go", "sub-cycles"] {
        bench.write(&format!("{name}.toml"), std::fs::read(examples.join(format!("{name}.toml"))).unwrap());
    }
    // Sides that differ are corrected over a whole cycle; the mode of the paper walks them as they are.
    bench.run(&["walk", "--gait", "limp.toml", "--cycles", "1", "--quiet", "-o", "limp"]);
    assert_eq!(bench.json("limp/summary.json")["ground"]["rule"], "soft shoes");
    bench
        .run(&["walk", "--gait", "limp.toml", "--mode", "paper", "--cycles", "2", "--quiet", "-o", "limp"])
        .infeasible();
    assert_eq!(bench.json("limp/summary.json")["ground"]["rule"], "rigid soles");
    let states = bench.text("limp/states.csv");
    assert!(states.starts_with("machine,state,start_s,end_s\nwalk,"), "{states}");
    assert!(states.contains("\nbalancing arm,lifted,"), "{states}");
    assert!(states.contains("\"double support, right foot ahead\""), "{states}");
    // A machine of the pace is corrected, and the summary has its changes.
    bench.run(&["walk", "--gait", "stop-and-go.toml", "--cycles", "4", "--quiet", "-o", "stop"]);
    let summary = bench.json("stop/summary.json");
    assert_eq!(summary["ground"]["rule"], "soft shoes");
    assert_eq!(summary["walk"]["pace_changes"][0]["speed_m_s"], 0.0);
    assert_eq!(summary["verdict"]["state"], "feasible", "{}", summary["verdict"]);
    let line = |text: &str, name: &str| text.lines().filter(|line| line.starts_with(name)).count();
    assert!(line(&bench.text("stop/states.csv"), "traffic light,standing,") == 1);
    let changes = ["walk", "--gait", "stop-and-go.toml", "--speed-change", "1:1.3", "-o", "stop"];
    bench.run(&changes).refused(&["the machine `traffic light` of the gait drives the pace"]);
    // States of machines in the table of states, below what they drive.
    let table = bench.run(&["walk", "--gait", "limp.toml", "--states"]).done().stdout;
    assert!(table.contains("driven by balancing arm") && table.contains("lifted, left foot is down"), "{table}");
    // Then the run of states in order of time, with the same states as in the file, and the condition of each change.
    let (_, run) = table.split_once("time s  machine").unwrap();
    let times: Vec<f64> =
        run.lines().skip(1).map(|line| line.split_whitespace().next().unwrap().parse().unwrap()).collect();
    assert!(times.is_sorted(), "{run}");
    let lifted = run.lines().filter(|line| line.contains("lifted  ") && line.ends_with("left foot is down")).count();
    assert!(lifted >= 3, "{run}");
    assert!(run.contains("the results begin") && run.contains("left contact"), "{run}");
    bench.write(
        "nod.toml",
        "[[machine]]\nname = \"nod\"\ndrives = \"trunk\"\nstate = [{ name = \"on\", \
        activity = \"recording\", file = \"none.sto\", column = \"x\" }]\n",
    );
    bench.run(&["walk", "--gait", "nod.toml", "-o", "nod"]).refused(&[
        "nod.toml",
        "line 4, `machine[1].state[1].file`",
        "none.sto",
    ]);
    // Errors that depend on the figure name the file too.
    bench.write(
        "wrist.toml",
        "[[machine]]\nname = \"w\"\ndrives = \"wrist_flex_r\"\nstate = [{ name = \"on\", \
        activity = \"constant\", angle_deg = 3 }]\n",
    );
    bench
        .run(&["walk", "--gait", "wrist.toml", "-o", "wrist"])
        .refused(&["wrist.toml", "the machine `w` drives the coordinate `wrist_flex_r`"]);
    bench.run(&["walk", "--gait", "wrist.toml", "--states"]).refused(&["wrist.toml", "the machine `w`"]);
    bench.write("empty.toml", "[[machine]]\nname = \"w\"\nstate = []\n");
    bench
        .run(&["walk", "--gait", "empty.toml", "-o", "empty"])
        .refused(&["line 3, `machine[1].state`", "expected at least one state"]);
    // An angle that jumps cannot be followed.
    let row = |k: u32| {
        format!("{:.2}\t{}\n", 0.01 * f64::from(k), f64::from(k).mul_add(0.1, if k < 20 { 0.0 } else { 40.0 }))
    };
    let rows: String = (0..40).map(row).collect();
    bench.write(
        "jump.sto",
        format!("nod\nversion=1\nnRows=40\nnColumns=2\ninDegrees=yes\nendheader\ntime\tlean\n{rows}"),
    );
    bench.write(
        "jump.toml",
        "[[machine]]\nname = \"nod\"\ndrives = \"trunk\"\nstate = [{ name = \"on\", \
        activity = \"recording\", file = \"jump.sto\", column = \"lean\" }]\n",
    );
    bench.run(&["walk", "--gait", "jump.toml", "-o", "nod"]).refused(&[
        "line 4, `machine[1].state[1].file`",
        "jump.sto",
        "line 28, column `lean`",
        "40.1 deg at 0.2000 s",
    ]);
    // A recording next to the gait file is followed.
    bench.edit("nod.toml", "none.sto", "limp/kinematics.mot");
    bench.edit("nod.toml", "\"x\"", "\"arm_flex_r\"");
    bench.run(&["walk", "--gait", "nod.toml", "--cycles", "1", "--quiet", "-o", "nod"]).infeasible();
}

#[test]
fn states_are_printed_and_drawn() {
    let bench = Workbench::empty("walk_states");
    let run = bench.run(&["walk", "--gait", "standard", "--states"]).done();
    for words in ["standard, style 1997: 1.50 m/s", "right knee", "double support", "E1", "leads to, when"] {
        assert!(run.stdout.contains(words), "{words}: {}", run.stdout);
    }
    assert!(!bench.exists("out"));
    bench.run(&["walk", "--states", "-o", "drawn", "--quiet"]).done();
    assert!(bench.text("drawn/figures/gait.svg").starts_with("<svg") && !bench.exists("drawn/moments.sto"));
    let json = bench.run(&["walk", "--states", "--json"]).done().stdout;
    let table = serde_json::from_str::<Value>(&json).unwrap()["states"].as_str().unwrap().to_owned();
    assert!(table.contains("right hip"), "{table}");
    let run = serde_json::from_str::<Value>(&json).unwrap()["run"].as_array().unwrap().clone();
    assert!(
        run.iter().any(|row| row["machine"] == "left leg" && row["from"] == "stance" && row["to"] == "swing"),
        "{run:?}"
    );
}

#[test]
fn two_walks_give_identical_bytes() {
    let bench = Workbench::empty("walk_twice");
    for folder in ["a", "b"] {
        bench.run(&["walk", "--cycles", "1", "-o", folder, "--quiet"]).done();
    }
    for file in FILES {
        assert_eq!(bench.read(&format!("a/{file}")), bench.read(&format!("b/{file}")), "{file}");
    }
}

#[test]
fn the_demo_needs_no_input_and_its_walk_can_be_read_as_a_recording() {
    let bench = Workbench::empty("demo");
    let run = bench.run(&["demo", "-o", "demo"]).done();
    println!("ambulo demo took {:.2} s", run.took.as_secs_f64());
    for file in FILES {
        assert!(!bench.read(&format!("demo/{file}")).is_empty(), "{file}");
    }
    assert_eq!(bench.json("demo/summary.json")["files"]["input/walk.c3d"], bench.hash("demo/input/walk.c3d"));
    let model = ["forces", "demo/input/walk.mot", "--model", "demo/input/figure.osim"];
    bench.run(&[&model[..], &["--loads", "demo/input/walk_grf.xml", "-o", "again"], &RAW].concat()).done();
    let (made, read) = (bench.table("demo/moments.sto"), bench.table("again/moments.sto"));
    let frames = made.rows();
    // A foot that is loaded by less than the threshold has a force in the walk and none in the table: frames next to a
    // strike or an off.
    let table = bench.table("demo/grf.mot");
    let vertical = ["r", "l"].map(|side| table.column(&format!("ground_force_{side}_vy")).unwrap());
    let changes = |i: usize| vertical.iter().any(|force| (i - 1..=i + 1).any(|k| (force[k] > 0.0) != (force[i] > 0.0)));
    let compared: Vec<usize> = (10..frames - 10).filter(|i| !changes(*i)).collect();
    assert!(compared.len() * 10 > frames * 8, "{} of {frames} frames", compared.len());
    // The recording's accelerations are those of its samples: exact in between, not at its ends; and a plate measures
    // the whole foot, so the moment at the toe joint is lost.
    for name in ["hip_flexion_r_moment", "knee_angle_l_moment", "ankle_angle_r_moment", "lumbar_extension_moment"] {
        let (a, b) = (made.column(name).unwrap(), read.column(name).unwrap());
        let differences: Vec<f64> = compared.iter().map(|i| (a[*i] - b[*i]).powi(2)).collect();
        let rms = (differences.iter().sum::<f64>() / differences.len() as f64).sqrt();
        println!("{name}: {rms:.3} N.m rms");
        assert!(rms < 0.3, "{name}: {rms} N.m rms");
    }
    let vertical =
        |folder: &str| bench.table(&format!("{folder}/grf.mot")).column("ground_force_r_vy").unwrap().to_vec();
    let worst = vertical("demo").iter().zip(vertical("again")).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(worst < 1e-6, "{worst} N");
}

#[test]
fn impossible_walks_are_rejected() {
    let bench = Workbench::empty("walk_refused");
    let refused = |args: &[&str], words: &[&str]| {
        bench.run(&[&["walk", "-o", "out"], args].concat()).refused(words);
        assert!(!bench.exists("out"), "{args:?}");
    };
    for speed in ["0", "-1", "nan", "inf"] {
        refused(&["--speed", speed], &["speed", "found", "expected"]);
    }
    // These ended in panics, in an allocation of 46 GB, or in no frames with the verdict `feasible`.
    for (option, values, range) in [
        ("--speed", &["1e-308", "1e-9", "1e6", "1e308"][..], "0.05 to 5 m/s, because"),
        ("--step-length", &["1e-9", "0.001", "1000", "1e308"], "0.02 to 3 m, because"),
        ("--cadence", &["1e-308", "0.001", "1e308"], "5 to 1000 steps/min, because"),
        ("--step-height", &["1e-308", "1e308"], "a factor from 0.1 to 10"),
    ] {
        for value in values {
            for mode in ["corrected", "paper"] {
                refused(&[option, value, "--mode", mode], &["found ", "expected ", range]);
            }
        }
    }
    refused(&["--cadence", "5"], &["resulting speed", "0.05 to 5 m/s"]);
    refused(
        &["--speed", "0.05", "--cycles", "1000", "--mode", "paper"],
        &["expected at most 1200000 steps, because of memory", "hint: compute fewer cycles"],
    );
    for (option, value) in [
        ("--step-length", "0"),
        ("--step-length", "-0.7"),
        ("--cadence", "0"),
        ("--cadence", "nan"),
        ("--step-height", "-1"),
    ] {
        refused(&[option, value], &["found", "expected"]);
    }
    refused(
        &["--speed", "1", "--step-length", "0.7", "--cadence", "120"],
        &["speed = step length", "hint: leave out one"],
    );
    for mass in ["0", "-75", "nan", "5000"] {
        refused(&["--mass", mass], &["the body mass is", "expected 2 to 300 kg"]);
    }
    for height in ["0", "-1.75", "nan", "175"] {
        refused(&["--height", height], &["the height is", "expected 0.4 to 2.5 m"]);
    }
    refused(&["--mass", "20"], &["20 kg at 1.75 m; expected"]);
    refused(
        &["--gait", "moonwalk"],
        &["--gait", "found `moonwalk`", "standard, long, short, goose, parade, slow, free, fast"],
    );
    refused(&["--gait", "gose"], &["hint: did you mean `goose`?"]);
    refused(&["--style", "2024"], &["style: found `2024`; expected one of knots, 1997", "`--style`"]);
    refused(&["--figure", "barbie"], &["--figure", "no figure is named `barbie`", "de-leva-male"]);
    refused(&["--cycles", "0"], &["found 0 cycles; expected 1 to 1000"]);
    for rate in ["0", "-100", "nan", "1e9"] {
        refused(&["--rate", rate], &["Hz; expected 20 to 5000 Hz"]);
    }
    refused(&["--gait", "none.toml"], &["none.toml: there is no such file"]);
    for (args, words) in
        [(&["--mode", "slide"][..], "corrected, paper"), (&["--speed", "fast"], "--speed"), (&["--cycles", "-3"], "-3")]
    {
        let run = bench.run(&[&["walk"], args].concat());
        assert!(run.code == Some(2) && run.stderr.contains(words), "{args:?}: {}", run.stderr);
    }
    bench.write("limits.toml", "[frictoin]\n");
    refused(&["--thresholds", "limits.toml"], &["limits.toml: line 1", "hint: did you mean `friction`?"]);
}

#[test]
fn errors_in_gait_files_are_reported_with_their_line() {
    let bench = Workbench::empty("walk_gait_files");
    let refused = |content: &str, words: &[&str]| {
        bench.write("gait.toml", content);
        bench.run(&["walk", "--gait", "gait.toml"]).refused(words);
    };
    refused("speed = 0\n", &["gait.toml", "speed"]);
    refused("speed = \"quick\"\n", &["gait.toml: line 1", "quick"]);
    refused("sped = 1.2\n", &["gait.toml: line 1", "hint: did you mean `speed`?"]);
    refused("style = \"2024\"\n", &["gait.toml: line 1", "2024"]);
    refused("= 3\n", &["gait.toml: line 1", "this is not TOML"]);
    let overlapping = "[[knot]]\njoint = \"knee\"\nknot = \"stance peak\"\nphase = 0.5\n";
    refused(overlapping, &["knee"]);
}

#[test]
fn a_gait_file_is_never_overwritten() {
    let bench = Workbench::empty("walk_same_folder");
    let walk = |folder: &str| bench.run(&["walk", "--gait", "summary.json/../mine.toml", "-o", folder]);
    bench.write("mine.toml", "base = \"free\"\n");
    assert_eq!(walk(".").code, Some(2), "a path through a file is none");
    assert_eq!(bench.text("mine.toml"), "base = \"free\"\n");
}

#[test]
fn a_walk_changes_its_pace_on_the_way() {
    let bench = Workbench::empty("walk_changes");
    let words =
        ["walk", "--mode", "paper", "--speed", "0", "--speed-change", "0.5:1.2:1.5", "--step-length-change", "3:0.6"];
    bench.run(&[&words[..], &["--cadence-change", "3:120", "--speed-change=6:0", "-o", "out"]].concat()).done();
    let summary = bench.json("out/summary.json");
    let changes = summary["walk"]["pace_changes"].as_array().unwrap();
    let number = |k: usize, key: &str| changes[k][key].as_f64().unwrap();
    assert_eq!(changes.len(), 3, "{changes:?}");
    assert!((number(0, "start_s") - 0.5).abs() < 1e-9 && (number(0, "duration_s") - 1.5).abs() < 1e-9);
    assert!((number(0, "speed_m_s") - 1.2).abs() < 1e-9);
    assert!((number(1, "step_length_m") - 0.6).abs() < 1e-9 && (number(1, "cadence_steps_min") - 120.0).abs() < 1e-9);
    assert!(number(2, "speed_m_s").abs() < 1e-12);
    assert!(bench.text("out/report.html").contains("Walking speed"));
    let last = *bench.table("out/kinematics.mot").times().unwrap().last().unwrap();
    assert!(last > 7.0, "the results end at {last} s");
}

#[test]
fn changes_of_pace_that_cannot_be_made_are_refused() {
    let bench = Workbench::empty("walk_changes_refused");
    for (words, expected) in [
        (&["--speed-change", "3"][..], "expected TIME:VALUE or TIME:VALUE:DURATION"),
        (&["--speed-change", "3:fast"], "expected TIME:VALUE"),
        (&["--speed", "0"], "no change to a walking speed"),
        (&["--speed-change", "3:9"], "expected 0.05 to 5 m/s"),
        (&["--speed-change", "3:1.6:0.001"], "expected 0.1 to 300 s"),
        (&["--speed-change=-1:1.6"], "expected 0 to 300 s"),
        (&["--speed-change", "3:1.6", "--speed-change", "3:1.2"], "found two changes at 3 s"),
        (&["--speed-change", "3:1.6:2", "--speed-change", "4:1.2"], "after the end of the previous change"),
    ] {
        let run = bench.run(&[&["walk", "-o", "out"], words].concat());
        assert!(run.code == Some(2) && run.stderr.contains(expected), "{words:?}: {}", run.stderr);
    }
}

#[test]
fn a_built_in_gait_with_changed_knots_is_walked_in_its_own_style() {
    let bench = Workbench::empty("walk_parade");
    bench.run(&["walk", "--gait", "parade", "--cycles", "1", "-o", "out"]).done();
    assert_eq!(bench.json("out/summary.json")["walk"]["style"], "1997");
}

/// The moment at the weak ankle is compared with the strength that it has left, so it comes closest to a limit.
#[test]
fn the_verdict_judges_a_weak_joint_with_the_strength_that_it_has_left() {
    let bench = Workbench::empty("walk_weak");
    bench.run(&["walk", "--weak", "ankle_r=0.7", "--cycles", "1", "--quiet", "-o", "out"]).done();
    let verdict = bench.json("out/summary.json")["verdict"].clone();
    let closest = verdict["closest"].as_array().unwrap().iter().find(|c| c["check"] == "strength").unwrap().clone();
    assert_eq!(closest["quantity"], "ankle_angle_r_moment", "{verdict}");
    // Of the usual man, 75 kg: the whole strength is 240 N.m there, and 0.1 N.m/kg are a tolerance.
    let limit = closest["limit"].as_f64().unwrap().abs();
    assert!((150.0..190.0).contains(&limit), "{limit} N.m");
}

/// The moments without the device lack the moment of the springs at each angle; a spring gives back the work that it
/// takes, and terminal and summary say what springs and body did.
#[test]
fn a_walk_with_springs_says_what_they_and_the_body_did() {
    const STIFFNESS: f64 = 60.0;
    const REST_DEG: f64 = 5.0;
    let bench = Workbench::empty("walk_device");
    bench.write("exo.toml", format!("[[device]]\njoint = \"ankle\"\nstiffness = {STIFFNESS}\nrest_deg = {REST_DEG}\n"));
    let run = bench.run(&["walk", "--device", "exo.toml", "--cycles", "1", "-o", "out"]);
    assert!(
        run.code == Some(0) && run.stdout.contains("ankle_angle_r and ankle_angle_l: the device does"),
        "{}",
        run.stdout
    );
    let [angles, whole, body] = ["kinematics.mot", "moments.sto", "moments_biological.sto"].map(|name| {
        let table = bench.table(&format!("out/{name}"));
        move |column: &str| table.column(column).unwrap().to_vec()
    });
    for side in ["r", "l"] {
        let moment = format!("ankle_angle_{side}_moment");
        let frames = angles(&format!("ankle_angle_{side}")).into_iter().zip(whole(&moment)).zip(body(&moment));
        for ((angle_deg, whole), body) in frames {
            let spring = -STIFFNESS * (angle_deg - REST_DEG).to_radians();
            assert!((whole - body - spring).abs() < 1e-3, "{whole} {body} {spring}");
        }
    }
    assert_eq!(whole("knee_angle_r_moment"), body("knee_angle_r_moment"));
    let summary = bench.json("out/summary.json");
    assert_eq!(summary["input"]["device"], "exo.toml");
    let work = &summary["walk"]["prediction"]["device_work"][0];
    let of = |who: &str| [0, 1].map(|k| work[who][k].as_f64().unwrap());
    let ([given, taken], [done, braked]) = (of("device_j_kg"), of("body_j_kg"));
    // The walk without the device is the one that is predicted without it.
    bench.run(&["walk", "--mode", "predict", "--cycles", "1", "--quiet", "-o", "alone"]).done();
    let power = |folder: &str, key: &str| {
        bench.json(&format!("{folder}/summary.json"))["walk"]["prediction"][key].as_f64().unwrap()
    };
    let alone = power("out", "metabolic_power_without_devices_w_kg");
    assert!((alone - power("alone", "metabolic_power_w_kg")).abs() < 1e-9, "{alone}");
    // Springs alone change what the muscles do.
    let [done_alone, taken_alone] = of("body_without_device_j_kg");
    assert!(done_alone > 0.05 && taken_alone < 0.0 && (done_alone - done).abs() > 1e-3, "{done_alone} {taken_alone}");
    assert!(given > 0.01 && (given + taken).abs() < 0.01 * given, "{given} {taken}");
    assert!(done > 0.05 && braked < 0.0, "{done} {braked}");
}

/// The trunk is held from outside, so that the body does not balance; its clock is right all the same.
#[test]
fn the_clock_of_a_computed_walk_is_not_doubted() {
    let bench = Workbench::empty("walk_clock");
    bench.run(&["walk", "--mode", "paper", "--cycles", "1", "--keep", "summary", "--quiet", "-o", "out"]).done();
    let summary = bench.json("out/summary.json").to_string();
    assert!(!summary.contains("motion.clock") && !summary.contains("\"tempo\""), "{summary}");
}

/// Level ground is asked for like any slope, and a hint never leads to a mode that is refused for the same words.
#[test]
fn a_slope_of_zero_is_predicted_and_styles_are_refused_with_the_true_reason() {
    let bench = Workbench::empty("walk_slope_zero");
    let refused = |words: &[&str], expected: &[&str]| bench.run(words).refused(expected);
    refused(
        &["walk", "--slope", "0", "--gait", "goose", "-o", "out"],
        &["`goose`", "a predicted walk takes its speed"],
    );
    refused(&["walk", "--slope", "5", "--no-toe-joint", "-o", "out"], &["toe joints", "on level ground"]);
    refused(&["walk", "--slope", "5", "--planar", "-o", "out"], &["found the mode corrected", "`--slope`"]);
}

/// A device without a moment changes nothing, at one joint as little as at two: neither metabolic power nor the work of
/// the body.
#[test]
fn a_device_that_does_nothing_changes_nothing() {
    let bench = Workbench::empty("walk_idle_device");
    bench.write("idle.toml", "[[device]]\njoint = \"ankle_r\"\nstiffness = 0\n");
    bench.run(&["walk", "--device", "idle.toml", "--cycles", "1", "--quiet", "-o", "out"]).done();
    let made = bench.json("out/summary.json")["walk"]["prediction"].clone();
    let (with, without) = (&made["metabolic_power_w_kg"], &made["metabolic_power_without_devices_w_kg"]);
    assert!(with.is_f64() && with == without, "{with} {without}");
    let work = &made["device_work"][0];
    assert_eq!(work["device_j_kg"], serde_json::json!([0.0, 0.0]));
    assert_eq!(work["body_j_kg"], work["body_without_device_j_kg"]);
}
