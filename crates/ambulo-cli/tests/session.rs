//! `ambulo session`: the trials of a visit on one page, and what is refused.
//!
//! | claim                                                                                         | tolerance |
//! |-----------------------------------------------------------------------------------------------|-----------|
//! | curves are those of `ambulo forces --predict`; a broken trial is a row with its reason        | 1e-6      |
//! | means, deviations and changes have rows for every quantity; a session compared with itself has not changed | exact |
//! | threads and the place of the folder change no byte                                            | exact     |
//! | an own reference group is written, read back, and gives the same numbers again                | exact     |
//! | without name, path and date: no byte of any file has one                                      | exact     |
//! | several persons, several standing trials, results of others are refused, and nothing is lost  | exact     |
//! | all trials have one body; foot progression is that of Plug-in-Gait in the recording            | 6 degrees |

use crate::shared_data::data;
use crate::workbench::Workbench;
use ambulo_formats::c3d::C3d;
use std::fs;

/// A folder, with the walk that `ambulo demo` writes next to it.
fn laboratory(name: &str) -> Workbench {
    let bench = Workbench::empty(name).always_removed();
    bench.run(&["demo", "-o", "demo", "--keep", "recording", "--quiet"]).done();
    bench
}

/// A folder with walks of the figure, the later ones shorter by a frame, and a model.
fn visit(bench: &Workbench, folder: &str, walks: usize) {
    fs::create_dir_all(bench.folder.join(folder)).unwrap();
    bench.write(&format!("{folder}/figure.osim"), bench.read("demo/input/figure.osim"));
    for walk in 0..walks {
        let name = format!("{folder}/walk{walk}.mot");
        bench.write(&name, bench.read("demo/input/walk.mot"));
        bench.edit_rows(&name, |rows| rows[..rows.len() - walk].to_vec());
    }
}

/// The rows of a table, each as its cells.
fn rows(text: &str) -> Vec<Vec<&str>> {
    text.lines().map(|line| line.split(',').collect()).collect()
}

#[test]
fn a_visit_is_one_page_with_the_curves_of_forces_and_a_broken_trial_is_a_row() {
    let bench = laboratory("session");
    visit(&bench, "Ann", 2);
    bench.write("Ann/broken.c3d", "PathFileType");
    let run = bench.run(&["session", "Ann", "-o", "out"]).done();
    assert!(run.stdout.contains("2 of 3 computed") && run.stdout.contains("broken.c3d: "), "{}", run.stdout);
    let tables =
        ["cycles.csv", "deviations.csv", "session.html", "summary.json", "times_and_distances.csv", "trials.csv"];
    let pages = ["trials/walk0.mot.html", "trials/walk1.mot.html"];
    let names: Vec<&str> = tables.iter().chain(&pages).copied().collect();
    assert_eq!(bench.names("out"), names);
    let page = bench.text("out/session.html");
    for known in [
        "default-src 'none'",
        "Gait session of Ann",
        "broken.c3d",
        "mean-angles-knee_flexion_angle",
        "Times and distances",
    ] {
        assert!(page.contains(known), "{known}");
    }
    assert!(!page.contains("<script"));
    assert_eq!(page.matches("://").count(), page.matches("http://www.w3.org").count(), "only names of SVG");
    the_curves_are_those_of_forces(&bench);
    a_session_compared_with_itself_has_not_changed(&bench);
    no_byte_depends_on_place_or_threads(&bench);
}

fn the_curves_are_those_of_forces(bench: &Workbench) {
    let words = ["forces", "Ann/walk0.mot", "--model", "Ann/figure.osim", "--predict", "--keep", "tables", "-o", "one"];
    bench.run(&[&words[..], &["--quiet"]].concat()).done();
    let (all, own) = (bench.text("out/cycles.csv"), bench.text("one/cycles.csv"));
    let (all, own) = (rows(&all), rows(&own));
    let mut compared = 0;
    // Dorsiflexion is positive in both; the displayed moment is that of plantarflexors, per mass.
    let mass: f64 = bench.json("out/summary.json")["mass_kg"].as_f64().unwrap();
    for (quantity, column, factor) in [
        ("ankle_dorsiflexion_angle", "ankle_angle_angle", 1.0),
        ("ankle_dorsiflexion_moment", "ankle_angle_moment", -1.0 / mass),
    ] {
        for row in
            all.iter().filter(|row| row[0] == "walk0.mot" && row[9] == quantity && row[1] == "r" && row[2] == "1")
        {
            let expected = own.iter().filter(|line| line[0] == column && line[1] == "r" && line[2] == "1");
            let expected: Vec<f64> = expected.map(|line| line[4].parse::<f64>().unwrap() * factor).collect();
            let found: Vec<f64> = row[11..].iter().map(|cell| cell.parse().unwrap()).collect();
            assert_eq!(found.len(), 101);
            assert!(found.iter().zip(&expected).all(|(a, b)| (a - b).abs() < 1e-6), "{quantity}");
            compared += expected.len();
        }
    }
    assert_eq!(compared, 2 * 101);
}

fn a_session_compared_with_itself_has_not_changed(bench: &Workbench) {
    bench.run(&["session", "Ann", "-o", "again", "--compare", "out", "--quiet"]).done();
    let text = bench.text("again/differences.csv");
    let lines = rows(&text);
    assert!(lines.len() > 20, "{}", lines.len());
    for line in &lines[1..] {
        let change: f64 = line[8].parse().unwrap();
        // The table of cycles has six digits.
        assert!(line.len() == 17 && change.abs() < 1e-5 && line[16] != "clear", "{line:?}");
    }
    assert!(bench.text("again/session.html").contains("The walk is as far from normal as before"));
    assert_eq!(bench.json("again/summary.json")["changes"]["clear"][0], 0);
    bench.run(&["session", "Ann", "-o", "out", "--compare", "out"]).refused(&["would replace it", "-o"]);
    bench.edit("out/summary.json", "\"session_format\": 1", "\"session_format\": 99");
    bench.run(&["session", "Ann", "-o", "third", "--compare", "out"]).refused(&["layout 99", "reads layout 1"]);
    bench.edit("out/summary.json", "\"session_format\": 99", "\"session_format\": 1");
    bench.run(&["session", "Ann", "-o", "third", "--compare", "one"]).refused(&["another command", "ambulo session"]);
    assert!(!bench.exists("third/summary.json"));
}

fn no_byte_depends_on_place_or_threads(bench: &Workbench) {
    fs::create_dir(bench.folder.join("moved")).unwrap();
    fs::rename(bench.folder.join("Ann"), bench.folder.join("moved/Ann")).unwrap();
    bench.run(&["session", "moved/Ann", "-o", "threads", "--jobs", "1", "--quiet"]).done();
    for name in bench.names("out") {
        assert_eq!(bench.hash(&format!("out/{name}")), bench.hash(&format!("threads/{name}")), "{name}");
    }
}

#[test]
fn name_and_day_are_stated_and_trials_have_pages_and_reasons() {
    let bench = laboratory("session_named");
    visit(&bench, "Ann", 2);
    bench.write("Ann/trials.toml", "[[trial]]\nfiles = \"**\"\nperson = \"Ann B.\"\ndate = \"2026-03-12\"\n");
    bench.run(&["session", "Ann", "-o", "spring", "--quiet"]).done();
    let summary = bench.json("spring/summary.json");
    assert_eq!((&summary["person"], &summary["recorded_on"]), (&"Ann B.".into(), &serde_json::json!(["2026-03-12"])));
    let words = ["session", "Ann", "-o", "autumn", "--name", "Ann C.", "--date", "2026-09-30", "--compare", "spring"];
    let run = bench.run(&words).done();
    assert!(run.stdout.contains("change    Gait profile score") && run.stdout.contains("0 of "), "{}", run.stdout);
    let page = bench.text("autumn/session.html");
    let order =
        ["Gait session of Ann C.", "2026-09-30", "id=\"changes\"", "id=\"normal\"", "id=\"curves\"", "id=\"trials\""];
    let places: Vec<usize> = order.iter().map(|words| page.find(words).expect(words)).collect();
    assert!(places.is_sorted(), "{places:?}");
    assert!(page.contains("What changed since 2026-03-12"));
    assert_eq!(page.matches("class=\"legend\"").count(), 1, "one legend");
    for known in ["href=\"trials/walk0.mot.html\"", "download=\"differences.csv\"", "class=\"strip\""] {
        assert!(page.contains(known), "{known}");
    }
    // Every link within the page has its place.
    for link in page.split("href=\"#").skip(1) {
        let id = link.split('"').next().unwrap();
        assert!(page.contains(&format!("id=\"{id}\"")), "{id}");
    }
    assert!(bench.exists("autumn/trials/walk1.mot.html"));
    bench.run(&["session", "Ann", "-o", "x", "--date", "30.9.2026"]).refused(&["--date", "YYYY-MM-DD"]);
    bench.run(&["session", "Ann", "-o", "x", "--name", "Ann", "--anonymous"]).refused(&["--anonymous"]);
    bench.edit("Ann/trials.toml", "2026-03-12", "March");
    bench.run(&["session", "Ann", "-o", "x"]).refused(&["trials.toml", "YYYY-MM-DD"]);
}

#[test]
fn a_gait_deviation_index_needs_thirty_people() {
    let bench = laboratory("session_index");
    visit(&bench, "people/Ann", 1);
    visit(&bench, "people/Ben", 2);
    visit(&bench, "Eve", 1);
    bench.run(&["session", "Eve", "-o", "first", "--norm", "people", "--quiet"]).done();
    let why = bench.json("first/summary.json")["profile"]["no_deviation_index"].to_string();
    assert!(why.contains("at least 30 people") && why.contains("this one has"), "{why}");
    // A group of thirty people is known by its file.
    let mut group = bench.json("first/norm.json");
    group["log_scores"] = serde_json::json!({ "mean": 1.0, "sd": 0.25, "n": 30 });
    bench.write("norm.json", group.to_string());
    bench.run(&["session", "Eve", "-o", "second", "--norm", "norm.json", "--quiet"]).done();
    let profile = &bench.json("second/summary.json")["profile"];
    let [score, index] = [&profile["right"]["mean"], &profile["deviation_index"]["right"]].map(|x| x.as_f64());
    if let Some((score, index)) = score.zip(index) {
        assert!((index - (100.0 - 40.0 * (score.ln() - 1.0))).abs() < 1e-6, "{score} {index}");
    }
    assert!(profile["no_deviation_index"].is_null(), "{profile}");
}

#[test]
fn a_list_of_files_is_a_visit_of_these_files_only() {
    let bench = laboratory("session_files");
    visit(&bench, "Ann", 2);
    visit(&bench, "Ann/later", 3);
    bench.write("Ann/trials.toml", "[[trial]]\nfiles = \"walk1.mot\"\nage = 30\n");
    let files = ["Ann/walk0.mot", "Ann/later/walk2.mot", "Ann/figure.osim"];
    let run = bench.run(&[&["session"], &files[..], &["--dry-run"]].concat()).done();
    for known in ["2 trials", "later/walk2.mot", "figure.osim"] {
        assert!(run.stdout.contains(known), "{known}: {}", run.stdout);
    }
    assert!(!run.stdout.contains("walk1") && !run.stdout.contains("another recording"), "{}", run.stdout);
    bench.run(&["session", "Ann/walk0.mot", "Ann/walk1.mot", "Ann/figure.osim", "-o", "files"]).done();
    fs::remove_dir_all(bench.folder.join("Ann/later")).unwrap();
    bench.run(&["session", "Ann", "-o", "folder"]).done();
    assert_eq!(bench.text("files/cycles.csv"), bench.text("folder/cycles.csv"), "the same trials by another way");
    for (files, words) in [
        (&["Ann", "Ann/walk0.mot"][..], &["Ann: this is a folder", "files only"][..]),
        (&["Ann/walk0.mot", "Ann/lost.mot"], &["Ann/lost.mot: there is no such file"]),
        (&["Ann/walk0.mot", "Ann/walk0.mot"], &["in the list twice"]),
        (&["Ann/walk0.mot", "Ann/trials.toml"], &["Ann/trials.toml: this is no file of a trial"]),
    ] {
        bench.run(&[&["session"], files, &["-o", "refused"]].concat()).refused(words);
    }
    assert!(!bench.exists("refused"));
}

#[test]
fn an_own_reference_group_is_written_and_read_back() {
    let bench = laboratory("session_norm");
    visit(&bench, "people/Ann", 1);
    visit(&bench, "people/Ben", 2);
    bench
        .write("people/trials.toml", "[[trial]]\nfiles = \"Ann/*\"\nage = 8\n[[trial]]\nfiles = \"Ben/*\"\nage = 11\n");
    visit(&bench, "Eve", 1);
    bench.run(&["session", "Eve", "-o", "first", "--norm", "people", "--quiet"]).done();
    let group = bench.json("first/norm.json");
    assert_eq!((&group["persons"], &group["version"], &group["ages_years"][1]), (&2.into(), &1.into(), &11.0.into()));
    let knee = &group["curves"]["hip_flexion_angle"];
    assert_eq!((knee["mean"].as_array().unwrap().len(), &knee["persons"]), (101, &2.into()));
    bench.run(&["session", "Eve", "-o", "second", "--norm", "first/norm.json", "--quiet"]).done();
    for name in ["deviations.csv", "times_and_distances.csv", "norm.json"] {
        assert_eq!(bench.hash(&format!("first/{name}")), bench.hash(&format!("second/{name}")), "{name}");
    }
    // The sessions of the people, computed before, are the same group but for their ages.
    for person in ["Ann", "Ben"] {
        bench.run(&["session", &format!("people/{person}"), "-o", &format!("done/{person}"), "--quiet"]).done();
    }
    bench.run(&["session", "Eve", "-o", "third", "--norm", "done", "--quiet"]).done();
    let found = bench.json("third/norm.json");
    assert_eq!((&found["persons"], &found["ages_years"]), (&2.into(), &serde_json::Value::Null));
    for (old, new, words) in [
        ("\"version\": 1", "\"version\": 7", &["version 7", "reads version 1"][..]),
        ("\"persons\": 2,", "\"persons\": 1,", &["at least 2"]),
        ("ambulo-reference-group", "another", &["reference group"]),
    ] {
        bench.write("wrong.json", bench.text("first/norm.json").replacen(old, new, 1));
        bench.run(&["session", "Eve", "-o", "out", "--norm", "wrong.json"]).refused(&[&["wrong.json"], words].concat());
    }
    bench.run(&["session", "Eve", "-o", "out", "--norm", "Eve", "--quiet"]).refused(&["found 1 person", "at least 2"]);
}

#[test]
fn a_copy_of_a_recording_does_not_count_twice_and_another_person_is_noticed() {
    let bench = laboratory("session_copies");
    visit(&bench, "once", 1);
    bench.run(&["session", "once", "-o", "first", "--quiet"]).done();
    visit(&bench, "twice", 1);
    bench.write("twice/walk0 - copy.mot", bench.read("twice/walk0.mot"));
    bench.run(&["session", "twice", "-o", "second", "--quiet"]).done();
    let (first, second) = (bench.json("first/summary.json"), bench.json("second/summary.json"));
    assert_eq!(first["trials"][0]["counted"], second["trials"][0]["counted"]);
    assert_eq!(second["trials"].as_array().unwrap().len(), 1, "{}", second["trials"]);
    let left_out = second["not_computed"].to_string();
    assert!(left_out.contains("\"walk0.mot\":\"a copy of walk0 - copy.mot"), "{left_out}");
    // The same motion of a heavier body.
    visit(&bench, "heavy", 1);
    let run = ["session", "heavy", "-o", "third", "--compare", "first", "--quiet", "--", "--mass", "110"];
    bench.run(&run).done();
    let warnings = bench.json("third/summary.json")["warnings"].to_string();
    assert!(warnings.contains("if it is not the same person"), "{warnings}");
    bench
        .run(&["session", "once", "-o", "x", "--compare", "demo/input"])
        .refused(&["expected a folder that `ambulo session` wrote"]);
}

#[test]
fn an_anonymous_session_has_no_name_of_a_model_and_the_same_id_in_a_folder_of_another_name() {
    let bench = laboratory("session_model_name");
    let ids = ["Erika", "Ann"].map(|folder| {
        visit(&bench, folder, 1);
        let model = bench.text(&format!("{folder}/figure.osim"));
        let start = model.find("<Model name=\"").unwrap() + "<Model name=\"".len();
        let end = start + model[start..].find('"').unwrap();
        bench.write(&format!("{folder}/figure.osim"), format!("{}Erika Schmidt{}", &model[..start], &model[end..]));
        bench.run(&["session", folder, "-o", "out", "--anonymous", "--force", "--quiet"]).done();
        for name in bench.names("out") {
            let text = bench.text(&format!("out/{name}"));
            assert!(!text.contains("Erika") && !text.contains("Schmidt"), "{name}");
        }
        bench.json("out/summary.json")["run_id"].as_str().unwrap().to_owned()
    });
    assert_eq!(ids[0], ids[1]);
}

#[test]
fn what_is_no_visit_of_one_person_is_refused_and_nothing_is_lost() {
    let bench = laboratory("session_refused");
    fs::create_dir_all(bench.folder.join("empty")).unwrap();
    bench.run(&["session", "empty"]).refused(&["empty: found no trial", "docs/SESSION.md"]);
    bench.run(&["session", "nowhere"]).refused(&["no such folder"]);
    visit(&bench, "two/Ann", 1);
    visit(&bench, "two/Ben", 1);
    // Of the same bytes they would be one recording.
    bench.edit_rows("two/Ben/walk0.mot", |rows| rows[..rows.len() - 1].to_vec());
    bench.run(&["session", "two"]).refused(&["2 persons (Ann, Ben)", "person = \"NAME\""]);
    bench.write(
        "two/trials.toml",
        "[[trial]]\nfiles = \"**\"\nperson = \"Ann\"\n[[trial]]\nfiles = \"Ben/*\"\nmass = \
        20\n[[trial]]\nfiles = \"Ann/*\"\nmass = 60\n",
    );
    bench.run(&["session", "two"]).refused(&["`mass` from 20 to 60 kg", "one number"]);
    bench.run(&["session", "two/Ann", "--", "--cutof", "8"]).refused(&["after `--`", "--cutof"]);
    bench.run(&["session", "two/Ann", "--", "-o", "there"]).refused(&["after `--`", "before"]);
    bench.run(&["session", "two/Ann", "-o", "two/Ann"]).refused(&["between the recordings"]);
    for wrong in ["0", "-1", "NaN"] {
        bench.run(&["session", "two/Ann", &format!("--jobs={wrong}")]).refused(&["--jobs"]);
    }
    // Results of others stay.
    bench.run(&["walk", "--mode", "paper", "--cycles", "1", "--keep", "summary", "-o", "walked", "--quiet"]).done();
    let before = bench.hash("walked/summary.json");
    bench.run(&["session", "two/Ann", "-o", "walked"]).refused(&["another command", "--force"]);
    fs::create_dir_all(bench.folder.join("batch")).unwrap();
    bench.write("batch/batch.json", "{}");
    bench.run(&["session", "two/Ann", "-o", "batch"]).refused(&["has a batch"]);
    bench.run(&["session", "two/Ann", "-o", "ann", "--quiet"]).done();
    visit(&bench, "Eve", 2);
    fs::remove_file(bench.folder.join("Eve/walk0.mot")).unwrap();
    bench.run(&["session", "Eve", "-o", "ann"]).refused(&["session of other recordings", "--force"]);
    assert_eq!(bench.hash("walked/summary.json"), before);
    // A motion without a whole cycle.
    bench.edit_rows("Eve/walk1.mot", |rows| rows.into_iter().take(40).collect());
    bench.run(&["session", "Eve", "-o", "eve", "--quiet"]).refused(&["none of 1 trials has a cycle that counts"]);
    assert!(!bench.exists("eve/summary.json"));
    bench.run(&["report", "ann"]).refused(&["`ambulo session` wrote this folder"]);
    let opened = bench.run(&["view", "ann"]).done();
    assert!(opened.stdout.contains("session.html"), "{}", opened.stdout);
}

/// Names that no file of an anonymous session may have.
const NAMES: [&str; 5] = ["Beatrix", "Muster", "HC032A", "visit", "session_real"];

#[test]
fn a_real_visit_has_one_body_and_can_be_anonymous() {
    let Some(data) = data() else { return };
    let bench = Workbench::empty("session_real").always_removed();
    let folder = bench.folder.join("visit Beatrix Muster");
    fs::create_dir_all(&folder).unwrap();
    for name in ["HC032A01.c3d", "HC032A03.c3d", "HC032A18.c3d"] {
        fs::copy(data.join("biomechzoo-HC032A").join(name), folder.join(name)).unwrap();
    }
    bench.write("visit Beatrix Muster/HC032A99.c3d", "broken");
    let list = "[[trial]]\nfiles = \"HC032A*\"\nperson = \"Beatrix Muster\"\n";
    bench.write("visit Beatrix Muster/trials.toml", list);
    let run = bench.run(&["session", "visit Beatrix Muster", "-o", "out", "--anonymous"]).done();
    let summary = bench.json("out/summary.json");
    // The turn is in no mean.
    assert!(
        run.stdout.contains("trial 2") && summary["trials"][1]["counted"] == serde_json::json!([0, 0]),
        "{summary}"
    );
    assert!(summary["body"].as_str().unwrap().starts_with("built-in, calibrated from the standing trial"));
    assert_eq!(summary["trials"][0]["measured"], serde_json::json!([1, 1]), "both plates measured a whole stance");
    let score = summary["profile"]["overall"].as_f64().unwrap();
    assert!((2.0..20.0).contains(&score), "{score}");
    for name in bench.names("out") {
        let text = bench.text(&format!("out/{name}")).to_lowercase();
        let found = NAMES.iter().find(|name| text.contains(&name.to_lowercase()));
        assert_eq!(found, None, "{name}");
        let no_date = |year: i32| !text.contains(&format!("{year}-"));
        assert!((1990..2100).all(no_date), "{name}");
    }
    foot_progression_is_that_of_plug_in_gait(&bench);
    two_standing_trials_are_refused(&bench);
}

/// The recording has the angles that Plug-in-Gait computed from the same markers; the third is foot progression.
fn foot_progression_is_that_of_plug_in_gait(bench: &Workbench) {
    let (recording, _) = C3d::read(&bench.read("visit Beatrix Muster/HC032A03.c3d")).unwrap();
    let times = recording.times();
    let cycles = bench.text("out/cycles.csv");
    let rows = rows(&cycles);
    let column = |name: &str| rows[0].iter().position(|head| *head == name).unwrap();
    let own = rows.iter().filter(|row| row[column("quantity")] == "foot_progression_angle");
    let mut compared = 0;
    for row in own.filter(|row| row[column("trial")] == "trial 1") {
        let number = |name: &str| row[column(name)].parse::<f64>().unwrap();
        let angles = recording.point(&format!("{}FootProgressAngles", row[column("side")].to_uppercase())).unwrap();
        for percent in 0..=100 {
            let time = number("start_s") + (number("end_s") - number("start_s")) * f64::from(percent) / 100.0;
            let frame = times.partition_point(|t| *t < time).min(times.len() - 1);
            let off = number(&format!("percent_{percent}")) - angles.positions[frame][2];
            assert!(off.abs() < 6.0, "{percent} % of {row:?}: {off} degrees off");
        }
        compared += 1;
    }
    assert_eq!(compared, 2);
}

fn two_standing_trials_are_refused(bench: &Workbench) {
    let own = |name: &str| bench.folder.join("visit Beatrix Muster").join(name);
    fs::copy(own("HC032A01.c3d"), own("static2.c3d")).unwrap();
    let words = ["session", "visit Beatrix Muster", "-o", "out2", "--quiet"];
    bench.run(&words).refused(&["2 standing trials (HC032A01.c3d, static2.c3d)", "static = \"FILE\"", "exclude"]);
    let list = bench.text("visit Beatrix Muster/trials.toml");
    bench.write("visit Beatrix Muster/trials.toml", format!("{list}static = \"static2.c3d\"\n"));
    bench.run(&words).done();
    assert!(bench.json("out2/summary.json")["body"].as_str().unwrap().ends_with("calibrated from static2.c3d"));
}
