//! The conformance suite (`conformance/`): its references are those of the formulas, `ambulo` passes it, and a spoiled
//! output does not.
//!
//! With AMBULO_WRITE=1 the references are written.

mod closed_forms;
mod figure;
mod series;

use crate::workbench::Workbench;
use serde_json::Value;
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

fn suite() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../conformance")
}

fn cases() -> Vec<Value> {
    let text = fs::read_to_string(suite().join("cases.json")).unwrap();
    serde_json::from_str::<Value>(&text).unwrap()["cases"].as_array().unwrap().clone()
}

#[test]
fn the_references_are_those_of_the_closed_forms_and_of_the_figure() {
    let all: Vec<closed_forms::Files> = closed_forms::all().into_iter().chain(figure::all()).collect();
    for (folder, files) in &all {
        for (name, bytes) in files {
            let path = suite().join(folder).join(name);
            if std::env::var_os("AMBULO_WRITE").is_some() {
                fs::write(&path, bytes).unwrap();
            }
            let found = fs::read(&path).unwrap_or_default();
            assert!(found == *bytes, "{} is out of date; run this test with AMBULO_WRITE=1", path.display());
        }
    }
    let made: BTreeSet<&str> = all.iter().map(|(folder, _)| *folder).collect();
    let listed = cases();
    assert_eq!(made, listed.iter().map(|case| case["name"].as_str().unwrap()).collect());
}

#[test]
fn the_suite_is_small() {
    fn size(folder: &Path) -> u64 {
        let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
        let sizes = entries.map(|path| if path.is_dir() { size(&path) } else { path.metadata().unwrap().len() });
        sizes.sum()
    }
    let bytes = size(&suite());
    println!("the suite has {bytes} bytes");
    assert!(bytes < 300_000, "{bytes} bytes");
}

/// Output and exit code of the judge for a folder of results.
fn judged(bench: &Workbench, folder: &str, cases: &[&str]) -> (i32, String) {
    let mut judge = Command::new(if cfg!(windows) { "python" } else { "python3" });
    let output =
        judge.arg("-B").arg(suite().join("judge.py")).arg(bench.folder.join(folder)).args(cases).output().unwrap();
    let words = [output.stdout, output.stderr].map(|bytes| String::from_utf8(bytes).unwrap()).concat();
    (output.status.code().unwrap(), words)
}

/// Runs the program on every case, as the README of the suite says.
fn run_all(bench: &Workbench) {
    let suite = suite();
    for case in cases() {
        let name = case["name"].as_str().unwrap();
        let words = case["ambulo"].as_str().unwrap().replace("CASE", suite.join(name).to_str().unwrap());
        let output = format!("out/{name}");
        let words: Vec<&str> = words.split(' ').chain(["-o", &output, "--quiet"]).collect();
        let run = bench.run(&words);
        assert!(run.code == Some(0) || run.code == Some(1), "{name}: {}", run.stderr);
    }
}

#[test]
fn the_judge_accepts_ambulo_and_refuses_a_spoiled_output_of_every_kind() {
    let bench = Workbench::empty("conformance");
    run_all(&bench);
    let (code, words) = judged(&bench, "out", &[]);
    println!("{words}");
    assert_eq!(code, 0, "{words}");
    assert!(words.ends_with("15 of 15 cases agree\n"), "{words}");
    // A sign, a unit, a number that is none, a column and a row that are missing, in one file of each reader.
    let spoiled = [
        ("inverse-dynamics/pendulum", "moments.sto", "swing_moment", "other_moment", "no column `swing_moment`"),
        ("inverse-dynamics/figure-on-the-ground", "moments.sto", "hip_flexion_r", "hip_flexion_x", "no column"),
        ("contact/slide", "poses.csv", "box,", "crate,", "no column `box/px`"),
        ("paper/quintics", "joints.csv", "knee,", "ankle,", "no column `knee/"),
        ("contact/stack", "contacts.csv", "lower,", "lowest,", "no column `lower/floor/"),
        ("paper/figure", "figure.osim", "<mass>", "<mass>1", "femur_"),
    ];
    for (case, file, old, new, reason) in spoiled {
        let path = format!("out/{case}/{file}");
        let before = bench.text(&path);
        bench.edit(&path, old, new);
        let (code, words) = judged(&bench, "out", &[case]);
        assert!(code == 1 && words.contains("MISS") && words.contains(reason), "{case}: {words}");
        bench.write(&path, before);
    }
    assert_eq!(judged(&bench, "out", &[]).0, 0);
}

#[test]
fn the_judge_refuses_wrong_numbers_and_folders() {
    let bench = Workbench::empty("conformance_numbers");
    let case = "inverse-dynamics/pendulum";
    fs::create_dir_all(bench.folder.join("out").join(case)).unwrap();
    let reference = fs::read_to_string(suite().join(case).join("reference.sto")).unwrap();
    let file = format!("out/{case}/inverse_dynamics.sto");
    bench.write(&file, &reference);
    assert_eq!(judged(&bench, "out", &[case]).0, 0);
    let change = |change: &dyn Fn(f64) -> String| {
        bench.write(&file, &reference);
        bench.edit_rows(&file, |rows| {
            rows.iter().map(|row| vec![row[0].clone(), change(row[1].parse().unwrap())]).collect()
        });
        judged(&bench, "out", &[case])
    };
    assert_eq!(change(&|x| x.to_string()).0, 0, "the rows are unchanged");
    for wrong in [
        change(&|x| (-x).to_string()),
        change(&|x| (x + 0.1).to_string()),
        change(&|x| if x > 1.0 { "nan".to_owned() } else { x.to_string() }),
        change(&|x| if x > 1.0 { "inf".to_owned() } else { x.to_string() }),
    ] {
        assert!(wrong.0 == 1 && wrong.1.contains("swing_moment at "), "{}", wrong.1);
    }
    bench.write(&file, &reference);
    bench.edit_rows(&file, |rows| rows[5..].to_vec());
    let (code, words) = judged(&bench, "out", &[case]);
    assert!(code == 1 && words.contains("`swing_moment` has no value at 0.1 s"), "{words}");
    bench.write(&file, "swing_moment\n1\n");
    assert!(judged(&bench, "out", &[case]).1.contains("no line `endheader`"));
    let (code, words) = judged(&bench, "out", &[]);
    assert!(code == 1 && words.contains("0 of 15 cases agree") && words.contains("has none of"), "{words}");
    assert_eq!(judged(&bench, "nowhere", &[]).0, 2);
    assert!(judged(&bench, "out", &["pendulum"]).1.contains("no case is named pendulum"));
}
