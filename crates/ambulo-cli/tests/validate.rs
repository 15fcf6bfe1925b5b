//! `ambulo validate`: which files are trials, their tables, and what is refused.
//!
//! | claim                                                                                      | tolerance |
//! |--------------------------------------------------------------------------------------------|-----------|
//! | a standing trial is used and not judged; a broken trial is a row, and the others are judged | exact     |
//! | names of files, their order, the number of threads and the place of the folder change no byte | exact  |
//! | a trial has the numbers of `ambulo forces --predict` with the same files                    | rounding  |
//! | trials.toml states person, files and what is left out; its mistakes are named               | exact     |

use crate::shared_data::data;
use crate::workbench::Workbench;
use std::fs;

/// A folder `lab` with two persons of real recordings, a broken file, and a recording without plates.
fn laboratory(name: &str) -> Option<Workbench> {
    let data = data()?;
    let bench = Workbench::empty(name).always_removed();
    for (person, files) in [
        ("biomechzoo-HC032A", &["HC032A01.c3d", "HC032A03.c3d"][..]),
        ("biomechzoo-HC030A", &["HC030A01.c3d", "HC030A22.c3d"]),
    ] {
        let folder = bench.folder.join("lab").join(person);
        fs::create_dir_all(&folder).unwrap();
        for file in files {
            fs::copy(data.join(person).join(file), folder.join(file)).unwrap();
        }
    }
    let walk = bench.read("lab/biomechzoo-HC032A/HC032A03.c3d");
    bench.write("lab/biomechzoo-HC032A/cut.c3d", &walk[..600]);
    bench.write("lab/biomechzoo-HC032A/cut.trc", "PathFileType\t4");
    fs::copy(data.join("opensim-rajagopal-walk/markers_walk.trc"), bench.folder.join("lab/markers_walk.trc")).unwrap();
    Some(bench)
}

/// The rows of a table without quotes, each as its cells.
fn rows(text: &str) -> Vec<Vec<&str>> {
    text.lines().map(|line| line.split(',').collect()).collect()
}

#[test]
fn a_laboratory_judges_its_own_plates_and_a_broken_trial_is_a_row() {
    let Some(bench) = laboratory("validate") else { return };
    let run = bench.run(&["validate", "lab", "-o", "out"]).done();
    assert!(run.stdout.contains("2 of 3 trials; persons 2") && run.stdout.contains("cut.c3d"), "{}", run.stdout);
    let written = ["means.csv", "stances.csv", "summary.json", "validation.html", "validation.md"];
    assert_eq!(bench.names("out"), written);
    let stances = bench.text("out/stances.csv");
    let stances = rows(&stances);
    assert!(stances.iter().all(|row| row.len() == stances[0].len() && row.len() == 22), "{stances:?}");
    assert_eq!(stances.len(), 1 + 4 * 3, "two stances of two trials, with three components");
    let means = bench.text("out/means.csv");
    let kinds: Vec<(&str, &str)> = rows(&means).iter().map(|row| (row[0], row[3])).collect();
    let expected = [("of", "kind"), ("trial", "turn"), ("trial", "walk"), ("person", "turn"), ("person", "walk")];
    assert_eq!(kinds[..5], expected, "{kinds:?}");
    assert!(kinds[5..] == [("kind", "turn"), ("kind", "walk")], "{kinds:?}");
    let page = bench.text("out/validation.html");
    assert!(page.contains("<svg ") && page.contains("default-src 'none'"), "the page loads nothing");
    let text = bench.text("out/validation.md");
    for known in
        ["| turn ", "foot height", "smooth transition", "- biomechzoo-HC032A/cut.c3d: ", "HC032A01.c3d: the person"]
    {
        assert!(text.contains(known), "{known}");
    }
    assert!(text.contains("- markers_walk.trc: no measured ground forces"), "the trial without plates has a reason");
    let listed = bench.json("out/summary.json")["listed"].clone();
    assert_eq!(listed[1]["standing"], "biomechzoo-HC032A/HC032A01.c3d", "{listed}");
    the_numbers_are_those_of_the_command_forces(&bench, &means);
    no_byte_depends_on_place_or_threads(&bench);
}

fn the_numbers_are_those_of_the_command_forces(bench: &Workbench, means: &str) {
    let [walk, still] = ["HC032A03.c3d", "HC032A01.c3d"].map(|name| format!("lab/biomechzoo-HC032A/{name}"));
    bench.run(&["forces", &walk, "--static", &still, "--predict", "--keep", "summary", "-o", "one", "--quiet"]).done();
    let feet = bench.json("one/summary.json")["comparison"]["feet"].clone();
    let rmse: Vec<f64> = feet.as_array().unwrap().iter().map(|f| f["vertical"]["rmse_bw"].as_f64().unwrap()).collect();
    let expected = 100.0 * rmse.iter().sum::<f64>() / rmse.len() as f64;
    let row = means.lines().find(|line| line.starts_with("trial,biomechzoo-HC032A/HC032A03")).unwrap();
    let found: f64 = row.split(',').nth(6).unwrap().parse().unwrap();
    assert!((found - expected).abs() < 1e-9, "{found} {expected}");
}

fn no_byte_depends_on_place_or_threads(bench: &Workbench) {
    fs::create_dir(bench.folder.join("moved")).unwrap();
    fs::rename(bench.folder.join("lab"), bench.folder.join("moved/lab")).unwrap();
    bench.run(&["validate", "moved/lab", "-o", "again", "--jobs", "1", "--quiet"]).done();
    for name in ["means.csv", "stances.csv", "validation.md", "validation.html", "summary.json"] {
        let [first, again] = ["out", "again"].map(|folder| bench.hash(&format!("{folder}/{name}")));
        assert_eq!(first, again, "{name}");
    }
}

#[test]
fn a_list_states_persons_files_and_what_is_left_out() {
    let Some(bench) = laboratory("validate_list") else { return };
    let list = "
        [[trial]]
        files = '**/HC0*.c3d'
        person = 'Ann'
        mass = 46.5
        [[trial]]
        files = 'biomechzoo-HC032A/*'
        exclude = 'no consent'
        [[trial]]
        files = '**/HC030A22.c3d'
        kind = 'corner'
        static = 'biomechzoo-HC030A/HC030A01.c3d'
    ";
    bench.write("lab/trials.toml", list);
    bench.run(&["validate", "lab", "-o", "out", "--quiet"]).done();
    let means = bench.text("out/means.csv");
    assert_eq!(rows(&means)[1][..4], ["trial", "biomechzoo-HC030A/HC030A22.c3d", "Ann", "corner"]);
    assert!(bench.text("out/validation.md").contains("cut.c3d: excluded: no consent"));
    let listed = bench.json("out/summary.json")["listed"].clone();
    assert_eq!((listed.as_array().unwrap().len(), &listed[0]["mass_kg"]), (1, &46.5.into()), "{listed}");
    for (list, words) in [
        ("[[trial]]\nfiles = 'nobody/*'", ["trials.toml: line 2", "nobody/*"]),
        ("[[trial]]\nfiles = '*/*'\nstatic = 'nothing.c3d'", ["nothing.c3d", "there is no such file"]),
        ("[[trial]]\nfiles = '*/*'\nweight = 60", ["`trial[1].weight`", "unknown key"]),
    ] {
        bench.write("lab/trials.toml", list);
        bench.run(&["validate", "lab", "--dry-run"]).refused(&words);
    }
}

#[test]
fn files_that_belong_together_are_found_by_their_names() {
    let bench = Workbench::empty("validate_names").always_removed();
    bench.run(&["demo", "--keep", "recording", "-o", "demo", "--quiet"]).done();
    let found = |folder: &str| bench.run(&["validate", folder, "--dry-run", "--json"]).done().stdout;
    let list: serde_json::Value = serde_json::from_str(&found("demo/input")).unwrap();
    assert_eq!(
        (&list["listed"][0]["name"], &list["listed"][0]["standing"]),
        (&"walk.c3d".into(), &"standing.c3d".into())
    );
    assert_eq!(list["listed"].as_array().unwrap().len(), 1, "the same trial as markers and as coordinates: {list}");
    fs::create_dir(bench.folder.join("coordinates")).unwrap();
    for (from, to) in [("walk.mot", "walk_ik.mot"), ("walk_grf.mot", "walk_grf.mot"), ("figure.osim", "body.osim")] {
        bench.write(&format!("coordinates/{to}"), bench.read(&format!("demo/input/{from}")));
    }
    let run = bench.run(&["validate", "coordinates", "-o", "coordinates/out"]).done();
    assert!(run.stdout.contains("1 of 1 trials"), "{}", run.stdout);
    // The results in the folder are no recordings, and are replaced.
    let run = bench.run(&["validate", "coordinates", "-o", "coordinates/out"]).done();
    assert!(run.stdout.contains("1 of 1 trials"), "{}", run.stdout);
    fs::remove_file(bench.folder.join("coordinates/walk_grf.mot")).unwrap();
    bench.run(&["validate", "coordinates"]).refused(&[
        "no trial",
        "walk_ik.mot: no measured ground forces",
        "walk1_grf.mot",
    ]);
    the_size_is_that_of_one_person(&bench);
}

fn the_size_is_that_of_one_person(bench: &Workbench) {
    for person in ["two/a", "two/b"] {
        fs::create_dir_all(bench.folder.join(person)).unwrap();
        bench.write(&format!("{person}/walk.c3d"), bench.read("demo/input/walk.c3d"));
    }
    bench.run(&["validate", "two", "--mass", "75", "--dry-run"]).refused(&["--mass", "2 persons", "trials.toml"]);
    for mass in ["0", "nan", "1e9"] {
        let run = bench.run(&["validate", "demo/input", "--mass", mass, "-o", "none", "--quiet"]);
        run.refused(&["none of 1 trials", "walk.c3d", "mass"]);
    }
    assert!(!bench.exists("none/summary.json"));
}

#[test]
fn folders_without_trials_are_refused() {
    let bench = Workbench::empty("validate_none");
    fs::create_dir_all(bench.folder.join("empty")).unwrap();
    bench.write("file.c3d", "no recording");
    bench.run(&["validate", "empty"]).refused(&["empty: found no trial", "force plates"]);
    bench.run(&["demo", "--keep", "summary", "-o", "demo", "--quiet"]).done();
    bench.run(&["validate", "demo"]).refused(&["demo: this folder has results", "input"]);
    bench.run(&["validate", "nowhere"]).refused(&["nowhere: there is no such folder"]);
    bench.run(&["validate", "file.c3d"]).refused(&["this is a file", "ambulo forces"]);
    fs::rename(bench.folder.join("file.c3d"), bench.folder.join("empty/file.c3d")).unwrap();
    bench.run(&["validate", "empty", "--quiet"]).refused(&["none of 1 trials", "file.c3d"]);
}
