//! `ambulo simulate`: files, errors, resumption.

use crate::workbench::Workbench;
use serde_json::Value;
use std::path::Path;

fn example(name: &str) -> Vec<u8> {
    let folders = ["../../examples", "../ambulo-paper/data/scenes"];
    let files = folders.map(|folder| Path::new(env!("CARGO_MANIFEST_DIR")).join(folder).join(name));
    std::fs::read(files.iter().find(|file| file.is_file()).unwrap()).unwrap()
}

/// A folder with these examples in it.
fn bench(name: &str, examples: &[&str]) -> Workbench {
    let bench = Workbench::empty(name);
    examples.iter().for_each(|file| bench.write(file, example(file)));
    bench
}

/// First line of a table.
fn header(bench: &Workbench, name: &str) -> String {
    bench.text(name).lines().next().unwrap().to_owned()
}

#[test]
fn a_run_writes_the_documented_files_with_the_documented_columns() {
    let bench = bench("simulate_files", &["pusher.toml", "hands.toml"]);
    let run = bench.run(&["simulate", "pusher.toml", "--duration", "0.6", "-o", "out"]).done();
    assert!(run.stdout.contains("Arm pushing a box") && run.stdout.contains("600 steps"), "{}", run.stdout);
    let columns = [
        ("poses.csv", "time,body,px,py,pz,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz"),
        ("joints.csv", "time,joint,coordinate,value,rate,effort,unit"),
        ("reactions.csv", "time,joint,body,fx,fy,fz,mx,my,mz,px,py,pz"),
        (
            "contacts.csv",
            "time,kind,first,second,px,py,pz,nx,ny,nz,fx,fy,fz,normal_force,friction_force,slip_m_s,gap_m",
        ),
        ("energy.csv", "time,kinetic,gravity,springs,total,iterations,factorizations,residual,converged"),
    ];
    let documented =
        std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/OUTPUTS.md")).unwrap();
    for (file, names) in columns {
        assert_eq!(header(&bench, &format!("out/{file}")), names);
        assert!(documented.contains(&format!("`{file}`")), "{file} is not documented");
        for name in names.split(',') {
            assert!(documented.contains(name), "{name} of {file} is not documented");
        }
        let width = names.split(',').count();
        let text = bench.text(&format!("out/{file}"));
        assert!(text.lines().all(|line| line.split(',').count() == width), "{file}");
    }
    // 61 instants: the start and 0.6 s at 100 Hz; three bodies, and the obstacle that moves.
    assert_eq!(bench.text("out/poses.csv").lines().count(), 1 + 61 * 4);
    assert!(bench.text("out/poses.csv").contains("\n0.35,box,"), "instants without rounding noise");
    for figure in ["joints", "bodies", "contacts"] {
        assert!(bench.text(&format!("out/figures/{figure}.svg")).ends_with("</svg>\n"), "{figure}");
    }
    assert!(!bench.exists("out/closures.csv") && !bench.exists("out/moments.sto"));

    // Another scene in the same folder removes the results of the first.
    bench.run(&["simulate", "hands.toml", "--duration", "1.2", "-o", "out"]).done();
    assert_eq!(header(&bench, "out/closures.csv"), "time,closure,fx,fy,fz,mx,my,mz,px,py,pz,gap_m");
    assert!(bench.text("out/closures.csv").contains("\n1.1,hand in hand,"));
    assert!(!bench.exists("out/contacts.csv") && !bench.exists("out/figures/contacts.svg"));
}

#[test]
fn the_summary_has_its_documented_keys() {
    let bench = bench("simulate_summary", &["slope.toml"]);
    let run = bench.run(&["simulate", "slope.toml", "--duration", "0.2", "--json", "-o", "out"]).done();
    let printed: Value = serde_json::from_str(&run.stdout).unwrap();
    let summary = bench.json("out/summary.json");
    assert_eq!(printed, summary);
    let documented =
        std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/OUTPUTS.md")).unwrap();
    for key in summary.as_object().unwrap().keys() {
        assert!(documented.contains(&format!("`{key}`")), "{key} is not documented");
    }
    assert_eq!((&summary["steps"], &summary["world"]["bodies"]), (&200.into(), &2.into()));
    assert!(summary["verdict"].is_null() && summary["convergence"]["not_converged"] == 0, "{summary}");
    assert_eq!(bench.run(&["simulate", "slope.toml", "--duration", "0.01", "--quiet"]).done().stdout, "");
}

#[test]
fn a_resumed_run_gives_the_same_bytes_as_one_run() {
    // Events on both sides of the break, contacts with friction, impacts within steps.
    for (scene, half, whole) in [("hands", "1.5", "2.7"), ("grasp", "0.8", "1.1"), ("pile", "0.25", "0.5")] {
        let file = format!("{scene}.toml");
        let bench = bench(&format!("simulate_resume_{scene}"), &[&file]);
        bench.run(&["simulate", &file, "--duration", whole, "-o", "whole"]).done();
        bench.run(&["simulate", &file, "--duration", half, "--save", "state.json", "-o", "first"]).done();
        bench.run(&["simulate", &file, "--duration", whole, "--resume", "state.json", "-o", "second"]).done();
        for table in ["poses.csv", "joints.csv", "contacts.csv", "closures.csv", "energy.csv", "reactions.csv"] {
            if !bench.exists(&format!("whole/{table}")) {
                continue;
            }
            let [whole, first, second] = ["whole", "first", "second"].map(|run| bench.text(&format!("{run}/{table}")));
            let (_, rows) = second.split_once('\n').unwrap();
            assert!(first + rows == whole, "{scene}: {table} differs");
        }
        let ended = bench.run(&["simulate", &file, "--duration", half, "--resume", "state.json"]);
        ended.refused(&["the scene ends at", "hint: --duration"]);
    }
}

#[test]
fn a_state_of_another_scene_is_rejected() {
    let bench = bench("simulate_other_state", &["pendulum.toml", "top.toml"]);
    bench.run(&["simulate", "top.toml", "--duration", "0.1", "--save", "top.json", "-o", "out"]).done();
    bench.run(&["simulate", "pendulum.toml", "--resume", "top.json"]).refused(&["top.json", "another scene", "rod"]);
    bench
        .run(&["simulate", "top.toml", "--step", "0.001", "--resume", "top.json"])
        .refused(&["the step is 0.0005; expected 0.001"]);
    bench
        .run(&["simulate", "top.toml", "--resume", "pendulum.toml"])
        .refused(&["pendulum.toml: this file was not written by"]);
    bench.run(&["simulate", "top.toml", "--save", "top.toml"]).refused(&["would be overwritten"]);
}

#[test]
fn a_bad_scene_is_rejected_with_line_and_key() {
    let bench = bench("simulate_errors", &["pendulum.toml"]);
    let cases = [
        ("mass = 1.0", "mass = -1.0", "`body[1].mass`: found -1"),
        ("mass = 1.0", "mass = nan", "`body[1].mass`"),
        ("mass = 1.0", "weight = 1.0", "`body[1].weight`"),
        ("parent = \"world\"", "parent = \"wall\"", "`joint[1].parent`"),
        ("step = 0.001 ", "step = 0 ", "`step`: found 0"),
        ("start_deg = 30", "drive = { motion = \"no.mot\", column = \"a\" }", "no.mot: there is no such file"),
    ];
    for (old, new, words) in cases {
        bench.write("bad.toml", String::from_utf8(example("pendulum.toml")).unwrap().replacen(old, new, 1));
        bench.run(&["simulate", "bad.toml"]).refused(&["bad.toml: line ", words]);
    }
    bench.run(&["simulate", "no.toml"]).refused(&["no.toml: there is no such file", "hint: "]);
    bench.run(&["simulate", "."]).refused(&["this is a folder"]);
    bench.run(&["simulate", "pendulum.toml", "--step", "9"]).refused(&["the time step is 9 s, the duration 5 s"]);
    bench.run(&["simulate", "pendulum.toml", "--step", "1e-12"]).refused(&["1e9 time steps"]);
    bench.run(&["simulate", "pendulum.toml", "--duration", "1e6"]).refused(&[
        "1.0e8 rows of output",
        "because of memory",
        "hint: simulate a shorter time",
    ]);
    let run = bench.run(&["simulate", "pendulum.toml", "--step", "0"]);
    assert!(run.code == Some(2) && run.stderr.contains("above 0"), "{}", run.stderr);
    bench.write("file", "");
    bench.run(&["simulate", "pendulum.toml", "--duration", "0.01", "-o", "file"]).refused(&["expected a folder"]);
}

/// A figure of the demo whose root follows the recording.
const WALKER: &str = r#"step = 0.001
duration = 0.3
[[figure]]
name = "walker"
model = "figure.osim"
motion = "walk.mot"
from = 0.5
root = "driven"
"#;

#[test]
fn files_named_in_a_scene_are_relative_to_it_and_their_errors_have_line_and_key() {
    let bench = Workbench::new("simulate_figure");
    std::fs::create_dir_all(bench.folder.join("scenes")).unwrap();
    bench.write("scenes/walk.toml", WALKER.replace("figure.osim", "../figure.osim").replace("walk.mot", "../walk.mot"));
    bench.run(&["simulate", "scenes/walk.toml", "-o", "out"]).done();
    let moments = bench.table("out/moments.sto");
    assert!(moments.column("knee_angle_r_moment").is_some_and(|c| c.len() == 31), "{:?}", moments.names());
    assert!(bench.text("out/joints.csv").contains(",knee_angle_r,"));

    let cases = [
        ("model = \"figure.osim\"", "model = \"no.osim\"", "line 5, `figure[1].model`: no.osim: there is no such file"),
        ("model = \"figure.osim\"", "model = \"walk.mot\"", "line 5, `figure[1].model`: walk.mot: "),
        ("motion = \"walk.mot\"", "motion = \"figure.osim\"", "line 6, `figure[1].motion`: figure.osim: "),
        ("from = 0.5", "from = 50", "line 6, `figure[1].motion`: walk.mot: found `from` = 50 s"),
        ("root = \"driven\"", "drive = [\"knee\"]", "`figure[1].drive`: found \"knee\""),
        ("root = \"driven\"", "drive = [\"pelvis_tx\"]", "see the key `root`"),
        (
            "root = \"driven\"",
            "sphere = { body = \"foot\", radius = 0.03 }",
            "line 8, `figure[1].sphere[1].body`: found \"foot\"",
        ),
    ];
    for (old, new, words) in cases {
        bench.write("bad.toml", WALKER.replace(old, new));
        let run = bench.run(&["simulate", "bad.toml"]);
        assert_eq!(run.code, Some(2), "{new}: {}", run.stderr);
        // The hint is on its own line.
        let said = run.stderr.replace("\n  hint: ", " hint: ");
        assert!(said.contains(words), "{new}: {said}");
    }
    bench.write("late.toml", WALKER.replace("from = 0.5", "from = 2.8"));
    bench.run(&["simulate", "late.toml", "-o", "late"]).warned(&["walk.mot ends 0.1"]);
}

#[test]
fn the_example_of_the_help_runs() {
    let bench = bench("simulate_help", &[]);
    std::fs::create_dir_all(bench.folder.join("examples")).unwrap();
    bench.write("examples/pendulum.toml", example("pendulum.toml"));
    let help = bench.run(&["simulate", "--help"]).done().stdout;
    let line = help.lines().find(|line| line.starts_with("  ambulo simulate")).unwrap();
    let words: Vec<&str> = line.split_whitespace().skip(1).collect();
    bench.run(&words).done();
    assert!(bench.exists("out/energy.csv") && bench.exists("out/figures/energy.svg"));
}

#[test]
fn a_walk_that_hits_something_is_judged_infeasible_with_exit_code_1() {
    let bench = bench("simulate_verdict", &["stumble.toml"]);
    let run = bench.run(&["simulate", "stumble.toml", "-o", "out"]).infeasible();
    assert!(
        run.stdout.contains("ann\n  verdict   infeasible") && run.stdout.contains("the muscles can supply"),
        "{}",
        run.stdout
    );
    assert!(run.stdout.starts_with("ann walked 3 steps, "), "the first line: {}", run.stdout);
    let walked = &bench.json("out/summary.json")["walked"][0];
    assert_eq!((&walked["figure"], &walked["steps"], walked["fell_at_s"].is_null()), (&"ann".into(), &3.into(), true));
    let verdict = &bench.json("out/summary.json")["verdict"];
    assert_eq!(verdict["state"], "infeasible");
    let reason = &verdict["figures"][0]["reasons"][0];
    assert_eq!((&verdict["figures"][0]["figure"], &reason["check"]), (&"ann".into(), &"strength".into()));
    let number = |value: &Value| value.as_f64().unwrap();
    // Moments and their limits have a sign, and the reason that comes first may be of either.
    assert!(number(&reason["time_s"][0]) > 1.0 && number(&reason["value"]).abs() > number(&reason["limit"]).abs());
    assert!(bench.text("out/figures/joints.svg").contains("red: not feasible"));
    // The moment that holds the trunk upright is written.
    assert!(bench.text("out/joints.csv").contains(",ann/ground_pelvis,angle_z,"));
    // Before the kerb it is feasible.
    bench.run(&["simulate", "stumble.toml", "--duration", "1.3", "-o", "early"]).done();
    assert_eq!(bench.json("early/summary.json")["verdict"]["state"], "feasible");
    bench.write("still.toml", example("pendulum.toml"));
    bench.run(&["simulate", "still.toml", "--duration", "0.1", "-o", "still"]).done();
    assert!(bench.json("still/summary.json")["verdict"].is_null());
}

#[test]
fn a_fall_leaves_the_drawn_shapes_of_the_figure_as_they_are() {
    let bench = Workbench::empty("simulate_fall");
    let scene = String::from_utf8(example("pushed-walker.toml")).unwrap().replace("mass = 5\n", "mass = 60\n");
    bench.write("fall.toml", scene);
    let shapes = |folder: &str| {
        let all = bench.json(&format!("{folder}/shapes.json"));
        all["bodies"].as_array().unwrap().clone()
    };
    bench.run(&["simulate", "fall.toml", "--duration", "0.1", "-o", "short"]).done();
    let run = bench.run(&["simulate", "fall.toml", "-o", "fallen"]).done();
    assert!(run.stdout.contains("ann fell after "), "{}", run.stdout);
    assert_eq!(shapes("short"), shapes("fallen"));
}
