//! `--keep` writes the listed outputs and the summary, with the numbers of a run that writes all.

use crate::workbench::{FORCES, RAW, Workbench};
use ambulo_results::Keep;

/// Runs with the options of the base.
fn with<'a>(base: &[&'a str], more: &[&'a str]) -> Vec<&'a str> {
    [base, more].concat()
}

#[test]
fn forces_writes_what_is_listed_with_the_same_numbers() {
    let bench = Workbench::new("keep");
    bench.forces(&RAW).done();
    let whole = |name: &str| bench.hash(&format!("out/{name}"));
    let (moments, grf, page) = (whole("moments.sto"), whole("grf.mot"), bench.text("out/report.html").len());
    let run = bench.forces(&with(&RAW, &["--keep", "moments,grf"])).done();
    assert_eq!(bench.names("out"), ["external_loads.xml", "grf.mot", "moments.sto", "summary.json"]);
    assert!([whole("moments.sto"), whole("grf.mot")] == [moments, grf], "the numbers changed");
    assert!(!run.stdout.contains("ambulo view"), "there is no page: {}", run.stdout);
    bench.run(&["report", "out"]).refused(&["found no kinematics.mot", "--keep"]);
    let run = bench.forces(&with(&RAW, &["--keep", "report"])).done();
    assert_eq!(bench.names("out"), ["report.html", "summary.json"]);
    assert!(run.stdout.contains("ambulo view"), "{}", run.stdout);
    assert!(bench.text("out/report.html").len().abs_diff(page) < 100, "the page lacks something");
    bench.forces(&with(&RAW, &["--keep", "summary"])).done();
    assert_eq!(bench.names("out"), ["summary.json"]);
}

#[test]
fn scenes_and_walks_can_leave_outputs_out() {
    let bench = Workbench::empty("keep_verbs");
    let scene = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/pendulum.toml");
    bench.write("pendulum.toml", std::fs::read(scene).unwrap());
    for (verb, kept, files) in [
        (&["simulate", "pendulum.toml"][..], "energy,poses", &["energy.csv", "poses.csv", "shapes.json"][..]),
        (&["simulate", "pendulum.toml"], "figures", &["figures/energy.svg", "figures/joints.svg"]),
        (&["walk", "--mode=paper", "--cycles=1"], "events,model", &["events.csv", "figure.osim"]),
    ] {
        bench.run(&with(verb, &["--keep", kept, "--quiet", "-o", "out"])).done();
        let expected: Vec<&str> = files.iter().copied().chain(["summary.json"]).collect();
        assert_eq!(bench.names("out"), expected, "{verb:?} {kept}");
    }
    bench.run(&["demo", "--keep", "recording", "-o", "demo"]).done();
    assert!(bench.names("demo").iter().all(|name| name.starts_with("input/") || name == "summary.json"));
    assert!(bench.exists("demo/input/walk.mot") && bench.exists("demo/input/walk.c3d"));
}

/// In a walk on level ground at least one foot touches it at all times, and each for 55 to 70 % of a cycle: heel first,
/// toes last.
#[test]
fn walks_have_labels_of_contact() {
    let bench = Workbench::empty("keep_contact");
    bench.run(&["walk", "--cycles=1", "--keep=foot_contact", "--quiet", "-o", "out"]).done();
    assert_eq!(bench.names("out"), ["foot_contact.sto", "summary.json"]);
    let text = bench.text("out/foot_contact.sto");
    let (_, table) = text.split_once("endheader\n").unwrap();
    let (header, rows) = table.split_once('\n').unwrap();
    let names = ["time", "heel_r_contact", "toes_r_contact", "heel_l_contact", "toes_l_contact"];
    assert_eq!(header.split('\t').collect::<Vec<_>>(), names);
    let rows: Vec<Vec<bool>> = rows
        .lines()
        .map(|row| row.split('\t').skip(1).map(|label| label.trim().parse::<f64>().unwrap() > 0.5).collect())
        .collect();
    let share =
        |is_it: &dyn Fn(&[bool]) -> bool| rows.iter().filter(|row| is_it(row)).count() as f64 / rows.len() as f64;
    assert!(rows.iter().all(|row| row.contains(&true)));
    for foot in [0, 2] {
        let stance = share(&|row| row[foot] || row[foot + 1]);
        assert!((0.55..0.70).contains(&stance), "{stance}");
        let (heel, toes) = (share(&|row| row[foot]), share(&|row| row[foot + 1]));
        assert!(heel < stance && toes < stance, "{heel} {toes} {stance}");
        // Where a foot meets the ground its heel does so first, and its toes leave last.
        for pair in rows.windows(2) {
            let touches = |row: &[bool]| row[foot] || row[foot + 1];
            match (touches(&pair[0]), touches(&pair[1])) {
                (false, true) => assert!(pair[1][foot], "{pair:?}"),
                (true, false) => assert!(pair[0][foot + 1], "{pair:?}"),
                _ => {}
            }
        }
    }
}

#[test]
fn unknown_names_are_refused_with_those_allowed() {
    let bench = Workbench::new("keep_unknown");
    for (words, allowed) in [
        (with(&FORCES, &["--keep", "moments,eeg"]), "times_and_distances"),
        (with(&FORCES, &["--keep", "recording"]), "kinematics"),
        (vec!["simulate", "pendulum.toml", "--keep", "grf"], "energy"),
        (vec!["sweep", "--keep", "grf"], "walks"),
        (vec!["reproduce", "--keep", ""], "claims"),
    ] {
        let run = bench.run(&words);
        assert_eq!(run.code, Some(2), "{words:?}");
        assert!(run.stderr.contains("possible values") && run.stderr.contains(allowed), "{}", run.stderr);
    }
}

#[test]
fn the_outputs_are_documented() {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/OUTPUTS.md");
    let documented = std::fs::read_to_string(path).unwrap();
    let (_, section) = documented.split_once("## Which outputs are written").unwrap();
    for name in ["report", "figures", "tables", "model", "recording", "summary", "timings"] {
        assert!(section.contains(&format!("`{name}`")), "{name}");
    }
    let lists = [&Keep::OF_RUNS[..], &Keep::OF_SCENES, &Keep::OF_SWEEPS, &Keep::OF_THE_PAPER].concat();
    for name in lists {
        assert!(documented.contains(&format!("`{name}")), "{name}");
    }
}
