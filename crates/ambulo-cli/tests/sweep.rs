//! `ambulo sweep`: its tables against single walks, and what it refuses.

use crate::workbench::Workbench;
use std::collections::BTreeMap;

/// The rows of a table without quotes, each by the names of the columns.
fn rows(text: &str) -> Vec<BTreeMap<String, String>> {
    let mut lines = text.lines();
    let names: Vec<&str> = lines.next().unwrap().split(',').collect();
    lines
        .map(|line| names.iter().map(|name| (*name).to_owned()).zip(line.split(',').map(str::to_owned)).collect())
        .collect()
}

fn number(row: &BTreeMap<String, String>, name: &str) -> f64 {
    row.get(name).unwrap_or_else(|| panic!("no column {name}")).parse().unwrap()
}

#[test]
fn every_walk_of_a_sweep_is_that_of_the_command_walk() {
    let bench = Workbench::empty("sweep");
    let run = bench.run(&["sweep", "--speed", "1.1,1.3", "--mass", "80", "-o", "all"]).done();
    assert!(run.stdout.contains("walks     2: 2 feasible"), "{}", run.stdout);
    bench.run(&["walk", "--speed", "1.1", "--mass", "80", "--cycles", "1", "-o", "one", "--quiet"]).done();
    let swept = rows(&bench.text("all/sweep.csv"));
    assert_eq!(swept.len(), 2 * 2 * 101);
    let (mut compared, mut largest) = (0, 0.0_f64);
    // Quantity in cycles.csv, column of the sweep, and the factor from one to the other.
    for (quantity, column, factor) in [
        ("hip_flexion_angle", "hip_flexion_angle", 1.0),
        ("ankle_angle_moment", "ankle_dorsiflexion_moment", -1.0 / 80.0),
        ("knee_angle_power", "knee_flexion_power", 1.0 / 80.0),
        ("hip_adduction_power", "hip_adduction_power", 1.0 / 80.0),
        ("ground_force_vertical", "ground_force_vertical", 1.0),
    ] {
        for line in bench.text("one/cycles.csv").lines().filter(|line| line.starts_with(&format!("{quantity},"))) {
            let cells: Vec<&str> = line.split(',').collect();
            let is_it = |row: &&BTreeMap<String, String>| {
                row["walk"] == "1" && row["side"] == cells[1] && row["percent"] == cells[3]
            };
            let expected = factor * cells[4].parse::<f64>().unwrap();
            largest = largest.max((number(swept.iter().find(is_it).unwrap(), column) - expected).abs());
            compared += 1;
        }
    }
    assert!(compared == 5 * 2 * 101 && largest < 1e-9, "{compared} {largest}");
    velocities_are_those_of_the_angles(&swept, number(&rows(&bench.text("all/walks.csv"))[0], "cadence_steps_min"));
    the_extremes_are_those_of_the_curves(&swept, &rows(&bench.text("all/walks.csv")));
    let page = bench.text("all/report.html");
    assert!(page.contains("Forces of 2 walks") && page.matches("<svg ").count() == 4);
    bench.run(&["view", "all"]).done();
    bench.run(&["report", "all"]).refused(&["`ambulo sweep` wrote this folder"]);
}

fn velocities_are_those_of_the_angles(swept: &[BTreeMap<String, String>], cadence: f64) {
    let percent_s = 1.2 / cadence;
    let own: Vec<_> = swept.iter().filter(|row| row["walk"] == "1" && row["side"] == "r").collect();
    for stem in ["knee_flexion", "ankle_dorsiflexion"] {
        let angle = |i: usize| number(own[i], &format!("{stem}_angle"));
        for i in 20..80 {
            let difference = (angle(i + 1) - angle(i - 1)) / (2.0 * percent_s);
            let velocity = number(own[i], &format!("{stem}_velocity"));
            // Central differences over 22 ms, and linear interpolation between frames.
            assert!((velocity - difference).abs() < 25.0, "{stem} {i}: {velocity} {difference}");
        }
    }
}

fn the_extremes_are_those_of_the_curves(swept: &[BTreeMap<String, String>], walks: &[BTreeMap<String, String>]) {
    for walk in walks {
        let of_walk = || swept.iter().filter(|row| row["walk"] == walk["walk"]);
        for column in ["knee_flexion_moment", "ankle_dorsiflexion_power", "ground_force_lateral"] {
            let largest = of_walk().map(|row| number(row, column)).fold(f64::NEG_INFINITY, f64::max);
            let least = of_walk().map(|row| number(row, column)).fold(f64::INFINITY, f64::min);
            let ends = [number(walk, &format!("{column}_min")), number(walk, &format!("{column}_max"))];
            assert!((ends[0] - least).abs() < 1e-12 && (ends[1] - largest).abs() < 1e-12, "{column} {ends:?}");
        }
        assert_eq!(walk["not_found_because"], "");
    }
}

#[test]
fn a_walk_that_is_not_found_is_a_row_with_its_reason() {
    let bench = Workbench::empty("sweep_missing");
    let words = ["sweep", "--speed", "1.3,4", "-o", "out"];
    let run = bench.run(&words).done();
    assert!(
        run.stdout.contains("2: 1 feasible, 1 not found") && run.stdout.contains("speeds of walking"),
        "{}",
        run.stdout
    );
    let walks = bench.text("out/walks.csv");
    let lines: Vec<&str> = walks.lines().collect();
    assert!(lines[2].starts_with("2,4,75,1.75,0,0,,,,,") && lines[2].contains("expected 0."), "{}", lines[2]);
    assert!(bench.text("out/report.html").contains("the speeds of walking"));
    assert!(bench.text("out/sweep.csv").lines().skip(1).all(|line| line.starts_with("1,1.3,")));
    let checked = bench.run(&[&words[..], &["--check"]].concat());
    assert_eq!(checked.code, Some(1), "{}", checked.stderr);
}

#[test]
fn lists_that_are_none_and_sweeps_without_a_walk_are_refused() {
    let bench = Workbench::empty("sweep_bad");
    for (words, found) in [
        (&["--speed", "1:2"][..], "FROM:TO:STEP"),
        (&["--speed", "2:1:0.1"], "a range that rises"),
        (&["--mass", "60,,80"], "numbers separated by commas"),
        (&["--mass", "60:80:inf"], "numbers separated by commas"),
        (&["--load", "10:head"], "FROM:TO:STEP"),
        (&["--speed", "1:2:0.01", "--mass", "60:80:1"], "found 1 x 1 x 1 x 21 x 101 walks; expected at most 500"),
        (&["--slope", "100"], "expected -40 to 40 %"),
        (&["--load=-5"], "load"),
        (&["--mass", "1e6,1e7"], "none of 2 walks was found; the first one: the body mass"),
        (&["--figure", "robot"], "--figure"),
        (&["--device", "none.toml"], "none.toml"),
    ] {
        let run = bench.run(&[&["sweep"], words].concat());
        assert!(run.code == Some(2) && run.stderr.contains(found), "{words:?}: {:?} {}", run.code, run.stderr);
        assert!(!bench.exists("out/summary.json"), "{words:?}");
    }
}

/// The walk at its own cadence is that of `ambulo walk`, and the page says that the cadence is its own.
#[test]
fn walks_of_a_sweep_choose_their_cadence() {
    let bench = Workbench::empty("sweep_cadence");
    bench.run(&["sweep", "--speed", "1.2", "--free-cadence", "--quiet", "-o", "all"]).done();
    bench.run(&["walk", "--speed", "1.2", "--free-cadence", "--cycles", "1", "--quiet", "-o", "one"]).done();
    let walks = rows(&bench.text("all/walks.csv"));
    let prediction = bench.json("one/summary.json")["walk"]["prediction"].clone();
    let cost = prediction["cost_of_transport_j_kg_m"].as_f64().unwrap();
    let [own, usual] =
        [number(&walks[0], "cadence_steps_min"), prediction["usual_cadence_steps_min"].as_f64().unwrap()];
    assert!((own - usual).abs() > 0.1, "{own} {usual} steps/min");
    assert!((number(&walks[0], "cost_of_transport_j_kg_m") - cost).abs() < 1e-9, "{cost} {walks:?}");
    assert!(bench.text("all/report.html").contains("each at its own cadence"));
}
