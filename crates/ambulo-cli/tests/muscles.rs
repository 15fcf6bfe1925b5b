//! `forces --muscles`: the muscles of the built-in body and of a model, files, summary, statements that are refused.

use crate::workbench::Workbench;
use ambulo_formats::table::Table;
use serde_json::Value;
use std::fs;

const TRIAL: [&str; 6] = ["forces", "demo/input/walk.c3d", "--static", "demo/input/standing.c3d", "--mass", "75"];
const STATURE: [&str; 2] = ["--height", "1.75"];

fn with_demo(name: &str) -> Workbench {
    let bench = Workbench::empty(name);
    bench.run(&["demo", "-o", "demo", "--quiet", "--keep", "recording"]).done();
    bench
}

fn forces(bench: &Workbench, options: &[&str], output: &str) -> Value {
    // A model has a stature of its own.
    let stature: &[&str] = if options.contains(&"--model") { &[] } else { &STATURE };
    let all = [&TRIAL[..], stature, options, &["-o", output]].concat();
    bench.run(&all).done();
    serde_json::from_slice(&fs::read(bench.folder.join(output).join("summary.json")).unwrap()).unwrap()
}

fn table(bench: &Workbench, file: &str) -> Table {
    Table::read_storage(&fs::read(bench.folder.join(file)).unwrap()).unwrap().0
}

/// Mean of the second peaks of a load over both legs [BW].
fn second_peak(summary: &Value, load: &str) -> f64 {
    let name = format!("{load}_second_peak");
    let loads = summary["muscles"]["contact_loads"].as_array().unwrap();
    let found = loads.iter().find(|quantity| quantity["quantity"] == name.as_str()).unwrap();
    assert_eq!((found["unit"].as_str(), found["right"]["source"].as_str()), (Some("BW"), Some("measured")));
    found["both"]["mean"].as_f64().unwrap()
}

#[test]
fn a_bare_c3d_gives_muscle_forces_and_knee_loads_and_the_written_model_gives_them_again() {
    let bench = with_demo("muscles_of_a_bare_c3d");
    let keep = ["--muscles", "--keep", "muscles,reactions_contact,cycles,model"];
    let summary = forces(&bench, &keep, "own");
    let muscles = &summary["muscles"];
    assert_eq!((muscles["source"].as_str(), muscles["muscles"].as_u64()), (Some("built-in"), Some(86)));
    assert_eq!(muscles["unmet_frames"], 0);
    let [knee, whole_medial, lateral] = ["knee", "knee_medial", "knee_lateral"].map(|load| second_peak(&summary, load));
    // Published model estimates of walking are two to five body weights; the net reaction has one.
    assert!((2.0..5.0).contains(&knee) && whole_medial > lateral, "{knee} {whole_medial} {lateral}");

    let found = table(&bench, "own/muscles.sto");
    let activation = found.column("soleus_r_activation").unwrap();
    assert!(activation.iter().all(|a| (0.01 - 1e-9..=1.0 + 1e-9).contains(a)));
    assert!(found.column("soleus_r_force").unwrap().iter().any(|force| *force > 300.0));
    let shares = table(&bench, "own/reactions_contact.sto");
    let [medial, lateral] = ["knee_r_medial", "knee_r_lateral"].map(|name| shares.column(name).unwrap().to_vec());
    let along = shares.names().iter().find(|name| name.contains("_in_joint_fy") && name.contains("tibia_r"));
    let along = shares.column(along.unwrap()).unwrap();
    for ((medial, lateral), down) in medial.iter().zip(&lateral).zip(along) {
        assert!((medial + lateral + down).abs() < 1e-6 * (1.0 + down.abs()), "{medial} {lateral} {down}");
    }
    let cycles = fs::read_to_string(bench.folder.join("own/cycles.csv")).unwrap();
    assert!(cycles.contains("\nknee_contact_force,r,1,0,"));

    let again = forces(&bench, &["--model", "own/subject.osim", "--muscles", "--keep", "summary"], "again");
    assert_eq!((again["muscles"]["source"].as_str(), again["muscles"]["muscles"].as_u64()), (Some("model"), Some(86)));
    assert!((second_peak(&again, "knee") - knee).abs() < 0.1, "{} {knee}", second_peak(&again, "knee"));

    // Wider condyles share the same load in another way.
    let wide = forces(&bench, &["--muscles", "--condyles", "0.08", "--keep", "summary"], "wide");
    assert!((second_peak(&wide, "knee") - knee).abs() < 1e-9);
    assert!(
        second_peak(&wide, "knee_medial") < whole_medial - 0.1,
        "{} {whole_medial}",
        second_peak(&wide, "knee_medial")
    );
}

/// The cycles of a trial in `cycles.csv` of a session: side, source of the forces, and the curve of a quantity.
fn session_curves(bench: &Workbench, folder: &str, quantity: &str) -> Vec<(String, String, Vec<f64>)> {
    let text = fs::read_to_string(bench.folder.join(folder).join("cycles.csv")).unwrap();
    let rows = text.lines().map(|line| line.split(',').collect::<Vec<_>>()).filter(|row| row[9] == quantity);
    let values = |row: &[&str]| row[11..].iter().map(|cell| cell.parse().unwrap()).collect();
    rows.map(|row| (row[1].to_owned(), row[6].to_owned(), values(&row))).collect()
}

#[test]
fn a_session_pools_what_joints_carry_from_the_forces_of_each_cycle() {
    let bench = with_demo("muscles_of_a_session");
    fs::create_dir_all(bench.folder.join("Ann")).unwrap();
    for file in ["walk.c3d", "standing.c3d"] {
        fs::copy(bench.folder.join("demo/input").join(file), bench.folder.join("Ann").join(file)).unwrap();
    }
    let person = ["--mass", "75", "--height", "1.75"];
    bench.run(&[&["session", "Ann", "-o", "visit", "--quiet", "--", "--muscles"], &person[..]].concat()).done();
    let summary: Value = serde_json::from_slice(&fs::read(bench.folder.join("visit/summary.json")).unwrap()).unwrap();
    let loads = summary["contact_loads"].as_array().unwrap();
    assert_eq!(loads.len(), 15, "three quantities of five loads");
    let page = fs::read_to_string(bench.folder.join("visit/session.html")).unwrap();
    for known in ["Joint contact loads", "mean-contact-knee_medial_force", "knee medial first peak"] {
        assert!(page.contains(known), "{known}");
    }

    // Cycles on plates have the loads of `forces` with the measured forces, the others those of a prediction. Foot
    // strikes of both differ by a frame, so that largest values are compared.
    let curves = |folder: &str, options: &[&str]| {
        forces(&bench, &[&["--muscles", "--keep", "cycles"], options].concat(), folder);
        let text = fs::read_to_string(bench.folder.join(folder).join("cycles.csv")).unwrap();
        let rows = text.lines().map(|line| line.split(',').map(str::to_owned).collect::<Vec<_>>());
        let own = rows.filter(|row| row[0] == "knee_medial_force");
        own.map(|row| (row[1].clone(), row[4].parse::<f64>().unwrap())).collect::<Vec<_>>()
    };
    let (measured, predicted) = (curves("measured", &[]), curves("predicted", &["--predict"]));
    let found = session_curves(&bench, "visit", "knee_medial_force");
    assert!(found.iter().any(|(_, source, _)| source == "measured"), "a cycle on plates");
    for (side, source, values) in found {
        let largest = |values: &[f64]| values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let [same, other] = [&measured, &predicted].map(|all| {
            let own: Vec<f64> = all.iter().filter(|(other, _)| *other == side).map(|(_, value)| *value).collect();
            let far = |cycle: &[f64]| (largest(cycle) - largest(&values)).abs();
            own.chunks(values.len()).map(far).fold(f64::INFINITY, f64::min)
        });
        println!("{side} {source}: {same:.4} from measured, {other:.4} from predicted forces [BW]");
        let [near, far] = if source == "measured" { [same, other] } else { [other, same] };
        assert!(near < 0.01 && near < far, "{side} {source}: {near} {far}");
    }

    // Without muscles there are none, and nothing says so.
    bench.run(&[&["session", "Ann", "-o", "plain", "--quiet", "--"], &person[..]].concat()).done();
    let plain = fs::read_to_string(bench.folder.join("plain/summary.json")).unwrap();
    assert!(!plain.contains("contact_loads"));
    assert!(session_curves(&bench, "plain", "knee_medial_force").is_empty());
}

#[test]
fn without_the_option_nothing_is_computed_and_a_model_says_that_it_could() {
    let bench = with_demo("muscles_not_asked_for");
    let summary = forces(&bench, &["--muscles", "--keep", "model"], "own");
    assert!(summary["muscles"].is_object());
    let without = forces(&bench, &["--model", "own/subject.osim", "--keep", "tables"], "plain");
    assert!(without.get("muscles").is_none() && !bench.folder.join("plain/muscles.sto").exists());
    let findings = without["findings"].as_array().unwrap();
    let note = findings.iter().find(|finding| finding["code"] == "muscles.available").unwrap();
    assert!(note["message"].as_str().unwrap().contains("86 muscles"), "{note}");
}

#[test]
fn statements_about_muscles_are_checked() {
    let bench = with_demo("muscles_checked");
    fs::write(bench.folder.join("reserves.xml"), "<ForceSet><objects/></ForceSet>").unwrap();
    fs::write(bench.folder.join("emg.csv"), "time,left\n0,1\n0.01,2\n").unwrap();
    let cases: [(&[&str], &str); 6] = [
        (&["--reserves", "reserves.xml"], "--muscles"),
        (&["--muscles", "--exponent", "0.5"], "found the exponent 0.5 of activations"),
        (&["--muscles", "--condyles", "4"], "found condyles 4 m apart"),
        (&["--muscles", "--reserves", "reserves.xml"], "no <CoordinateActuator>"),
        (&["--muscles", "--reserves", "nothing.xml"], "nothing.xml"),
        (&["--muscles", "--emg", "emg.csv"], "no channel has the name of a known muscle"),
    ];
    for (options, expected) in cases {
        let run = bench.run(&[&TRIAL[..], &STATURE, options, &["-o", "out"]].concat());
        assert!(run.code == Some(2) && run.stderr.contains(expected), "{options:?}: {}", run.stderr);
        assert!(!bench.folder.join("out").exists());
    }
}
