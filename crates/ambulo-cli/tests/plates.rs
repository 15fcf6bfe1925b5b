//! Measured forces: plates of a C3D, assigned by the user or ignored, and the resulting cycles and mass; force tables
//! with any names of their columns; loads on the wrong foot; the filter of the forces.

use crate::workbench::{RAW, Workbench};
use serde_json::Value;
use std::collections::BTreeSet;
use std::fs;

/// Runs `forces` on the demo's C3D, whose nine plates each catch one step: 1 to 4 right, 5 to 9 left.
fn forces(bench: &Workbench, options: &[&str]) -> (Value, String) {
    let mut args = vec![
        "forces",
        "demo/input/walk.c3d",
        "--static",
        "demo/input/standing.c3d",
        "--mass",
        "75",
        "--height",
        "1.75",
    ];
    args.extend(options);
    args.extend(["-o", "out"]);
    let run = bench.run(&args);
    assert!(matches!(run.code, Some(0 | 1)), "{}", run.stderr);
    let summary = serde_json::from_slice(&fs::read(bench.folder.join("out/summary.json")).unwrap()).unwrap();
    (summary, run.stderr)
}

fn rows(bench: &Workbench, file: &str) -> Vec<Vec<String>> {
    let text = fs::read_to_string(bench.folder.join("out").join(file)).unwrap();
    text.lines().skip(1).map(|line| line.split(',').map(str::to_owned).collect()).collect()
}

fn with_demo(name: &str) -> Workbench {
    let bench = Workbench::empty(name);
    bench.run(&["demo", "-o", "demo", "--quiet"]).done();
    bench
}

/// Side and number of every cycle.
fn cycles(bench: &Workbench) -> BTreeSet<(String, String)> {
    rows(bench, "cycles.csv").into_iter().map(|row| (row[1].clone(), row[2].clone())).collect()
}

#[test]
fn cycles_begin_with_a_foot_strike_on_a_plate_and_may_end_with_one_from_the_motion() {
    let bench = with_demo("two_plates");
    let (all, _) = forces(&bench, &[]);
    assert_eq!((all["mass"]["normalised_by"].as_str(), cycles(&bench).len()), (Some("plates"), 6));
    let off: Vec<&str> = ["1=off", "3=off", "4=off", "5=off", "6=off", "8=off", "9=off"].into();
    let options: Vec<&str> = off.iter().flat_map(|plate| ["--plate", *plate]).collect();
    let (two, _) = forces(&bench, &options);
    let contacts = two["subject"]["plates"].as_array().unwrap();
    let sides: Vec<&str> = contacts.iter().map(|c| c["side"].as_str().unwrap()).collect();
    assert_eq!(sides, ["r", "l"], "{contacts:?}");
    assert_eq!(cycles(&bench).into_iter().map(|(side, _)| side).collect::<String>(), "lr", "one cycle of each foot");
    // Two plates measure no whole cycle, so the mass is from the standing trial.
    assert_eq!(two["mass"]["normalised_by"], "standing");
    assert!((two["mass_kg"].as_f64().unwrap() - 75.0).abs() < 0.1, "{}", two["mass_kg"]);
    let strikes = rows(&bench, "events.csv").into_iter().filter(|row| row[1] == "strike").count();
    assert!(strikes >= 7, "the file's own list goes on: {strikes}");
    // Single support of either foot with the double support between: from the left foot's off to the right foot's next
    // strike.
    let window = two["subject"]["instrumented_windows_s"][0].as_array().unwrap();
    let (from, to) = (window[0].as_f64().unwrap(), window[1].as_f64().unwrap());
    assert!((from - 1.436).abs() < 0.03 && (to - 2.409).abs() < 0.03, "{from} to {to}");
    let residual = two["residual"]["force_rms_bw"].as_f64().unwrap();
    assert!(residual < 0.1, "only while plates saw both feet: {residual}");
}

#[test]
fn the_user_can_assign_a_foot_to_a_plate() {
    let bench = with_demo("told_plate");
    let (told, _) = forces(&bench, &["--plate", "2=l"]);
    let second = &told["subject"]["plates"][1];
    assert_eq!((second["plate"].as_str(), second["side"].as_str()), (Some("plate 2"), Some("l")));
    let run = bench.run(&["forces", "demo/input/walk.c3d", "--mass", "75", "--plate", "12=r", "-o", "out"]);
    assert_eq!(run.code, Some(2));
    assert!(run.stderr.contains("plate 12") && run.stderr.contains("9 force plates"), "{}", run.stderr);
}

#[test]
fn a_body_that_hovers_above_the_forces_of_a_table_keeps_them_and_is_infeasible() {
    let bench = Workbench::new("hovering");
    bench.write(
        "table.mot",
        bench
            .text("walk_grf.mot")
            .replace("ground_force_r_", "ground_force_1_")
            .replace("ground_torque_r_", "ground_torque_1_")
            .replace("ground_force_l_", "ground_force_2_")
            .replace("ground_torque_l_", "ground_torque_2_"),
    );
    let on_the_ground = bench.text("walk.mot");
    let judged = |lifted_m: f64| {
        let (head, rows) = on_the_ground.split_once("endheader\n").unwrap();
        let mut rows = rows.lines();
        let names: Vec<&str> = rows.next().unwrap().split('\t').collect();
        let vertical = names.iter().position(|name| *name == "pelvis_ty").unwrap();
        let lift = |row: &str| {
            let mut cells: Vec<String> = row.split('\t').map(str::to_owned).collect();
            cells[vertical] = (cells[vertical].trim().parse::<f64>().unwrap() + lifted_m).to_string();
            cells.join("\t")
        };
        let rows: Vec<String> = rows.map(lift).collect();
        bench.write("lifted.mot", format!("{head}endheader\n{}\n{}\n", names.join("\t"), rows.join("\n")));
        let run = bench.run(&ON_TABLE.map(|word| if word == "walk.mot" { "lifted.mot" } else { word })).done();
        let summary: Value = serde_json::from_slice(&bench.read("out/summary.json")).unwrap();
        (
            summary["verdict"]["state"].as_str().unwrap().to_owned(),
            run.stderr.contains("above or below its centre of pressure"),
        )
    };
    assert_eq!(judged(0.0), ("feasible".to_owned(), false));
    assert_eq!(judged(0.3), ("infeasible".to_owned(), true));
}

/// The arguments of a run without filters on a table of forces, without statements about its columns.
const ON_TABLE: [&str; 13] = [
    "forces",
    "walk.mot",
    "--model",
    "figure.osim",
    "--thresholds",
    "thresholds.toml",
    "--grf",
    "table.mot",
    "--cutoff",
    "off",
    "--force-cutoff",
    "off",
    "--verbose",
];

/// The moments with the loads that the built-in input states.
fn stated_moments(bench: &Workbench) -> Vec<u8> {
    bench.forces(&RAW).done();
    bench.read("out/moments.sto")
}

#[test]
fn columns_of_a_force_table_are_recognised_in_any_spelling_and_assigned_by_the_centre_of_pressure() {
    let bench = Workbench::new("spellings");
    let expected = stated_moments(&bench);
    let spellings = [
        (
            ["ground_force_1_v", "ground_force_1_p", "ground_force_1_m"],
            ["ground_force_2_v", "ground_force_2_p", "ground_torque_2_"],
        ),
        // The habit of OpenSim's examples would call the unnumbered load the right foot's.
        (
            ["1_ground_force_v", "1_ground_force_p", "1_ground_torque_"],
            ["ground_force_v", "ground_force_p", "ground_torque_"],
        ),
        (
            ["R_ground_force_v", "R_ground_force_p", "R_ground_torque_"],
            ["L_ground_force_v", "L_ground_force_p", "L_ground_torque_"],
        ),
        (["GRF_Right_F", "CoP_Right_", "Moment_Right_"], ["GRF_left_F", "CoP_left_", "Moment_left_"]),
        (["FP7_F", "FP7_P", "FP7_M"], ["FP12_F", "FP12_P", "FP12_M"]),
        (["Force_1_", "Center_of_Pressure_1_", "Torque_1_"], ["Force_2_", "Center_of_Pressure_2_", "Torque_2_"]),
        (["F1", "P1", "M1"], ["F2", "P2", "M2"]),
    ];
    for (right, left) in spellings {
        let mut text = bench.text("walk_grf.mot");
        for (usual, name) in ["ground_force_r_v", "ground_force_r_p", "ground_torque_r_"].iter().zip(right) {
            text = text.replace(usual, name);
        }
        for (usual, name) in ["ground_force_l_v", "ground_force_l_p", "ground_torque_l_"].iter().zip(left) {
            text = text.replace(usual, name);
        }
        bench.write("table.mot", text);
        let run = bench.run(&ON_TABLE).done();
        assert!(bench.read("out/moments.sto") == expected, "{right:?}, {left:?}: {}", run.stderr);
        run.reports(&["taken as ground forces: "]);
        assert!(!run.stderr.contains("lies under"), "{}", run.stderr);
    }
}

/// Changes the vectors of every row of the table: force, point and moment of each foot.
fn edit_vectors(bench: &Workbench, change: impl Fn(usize, [f64; 3]) -> [f64; 3]) {
    bench.write("table.mot", bench.text("walk_grf.mot").replace("_r_", "_1_").replace("_l_", "_2_"));
    bench.edit_rows("table.mot", |mut rows| {
        for cells in &mut rows {
            for vector in 0..6 {
                let own = &mut cells[1 + 3 * vector..4 + 3 * vector];
                let values: Vec<f64> = own.iter().map(|cell| cell.trim().parse().unwrap()).collect();
                for (cell, value) in own.iter_mut().zip(change(vector % 3, [values[0], values[1], values[2]])) {
                    *cell = value.to_string();
                }
            }
        }
        rows
    });
}

#[test]
fn axes_and_units_of_a_force_table_are_recognised_by_what_the_body_weighs() {
    let bench = Workbench::new("table_axes");
    stated_moments(&bench);
    let expected = bench.table("out/moments.sto");
    let summary: Value = serde_json::from_slice(&bench.read("out/summary.json")).unwrap();
    let weight_n = 9.80665 * summary["mass"]["kg"].as_f64().unwrap();
    let scaled = |factor: [f64; 3]| move |kind: usize, v: [f64; 3]| v.map(|x| x * factor[kind]);
    let same = |words: &[&str]| {
        let run = bench.run(&ON_TABLE).done();
        run.reports(words);
        let found = bench.table("out/moments.sto");
        for ((name, found), (_, expected)) in found.columns().zip(expected.columns()) {
            let worst = found.iter().zip(expected).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(worst < 1e-3, "{words:?} {name}: {worst} {}", run.stderr);
        }
    };
    edit_vectors(&bench, |_, [x, y, z]| [x, -z, y]);
    same(&["carry the body along z, not along y", "x forward"]);
    // The person walks along y.
    edit_vectors(&bench, |_, [x, y, z]| [z, x, y]);
    same(&["carry the body along z, not along y", "y forward"]);
    edit_vectors(&bench, |_, [x, y, z]| [-z, -x, y]);
    same(&["carry the body along z, not along y", "-y forward"]);
    edit_vectors(&bench, scaled([1e-3, 1.0, 1e-3]));
    same(&["the table is in kilonewtons"]);
    edit_vectors(&bench, scaled([1e-3, 1.0, 1.0]));
    same(&["the table is in kilonewtons"]);
    edit_vectors(&bench, scaled([1.0 / weight_n, 1.0, 1.0 / weight_n]));
    same(&["the table is in body weights"]);
    edit_vectors(&bench, |kind, [x, y, z]| [x, -z, y].map(|v| if kind == 0 { v / weight_n } else { v }));
    same(&["the table is in body weights", "carry the body along z"]);
    edit_vectors(&bench, scaled([1.0, 1.0, 1e3]));
    same(&["longer than a foot; they are in N.mm"]);
}

#[test]
fn a_mirrored_force_of_a_table_is_named_and_bad() {
    let bench = Workbench::new("mirrored_table");
    for (axis, word) in [(0, "the fore-aft force (x)"), (2, "the lateral force (z)")] {
        edit_vectors(&bench, |kind, mut v| {
            v[axis] *= if kind == 0 { -1.0 } else { 1.0 };
            v
        });
        let run = bench.run(&ON_TABLE);
        run.reports(&[word, "is mirrored", "change the sign of the columns"]);
        let summary: Value = serde_json::from_slice(&bench.read("out/summary.json")).unwrap();
        assert_eq!(summary["quality"]["state"], "bad", "{}", summary["quality"]);
        assert!(summary["quality"]["reasons"].to_string().contains("force_directions"));
    }
    edit_vectors(&bench, |_, v| v);
    assert!(!bench.run(&ON_TABLE).done().stderr.contains("mirrored"));
}

#[test]
fn a_force_of_another_size_or_turned_by_some_degrees_is_named_and_doubtful() {
    let bench = Workbench::new("misfit_table");
    let turned = |degrees: f64| {
        let (sin, cos) = degrees.to_radians().sin_cos();
        move |[x, y, z]: [f64; 3]| [x * cos + z * sin, y, z * cos - x * sin]
    };
    type Spoil = Box<dyn Fn([f64; 3]) -> [f64; 3]>;
    let spoiled: [(Spoil, &[&str]); 4] = [
        (Box::new(|[x, y, z]| [2.0 * x, y, 2.0 * z]), &["0.5 times the horizontal force", "calibration matrix"]),
        (Box::new(|[x, y, z]| [0.5 * x, y, 0.5 * z]), &["2.1 times the horizontal force", "calibration matrix"]),
        (Box::new(turned(20.0)), &["is turned to the left by", "axes of the table"]),
        (Box::new(turned(-20.0)), &["is turned to the right by", "axes of the table"]),
    ];
    for (spoil, words) in spoiled {
        edit_vectors(&bench, |kind, v| if kind == 0 { spoil(v) } else { v });
        bench.run(&ON_TABLE).warned(words);
        let summary: Value = serde_json::from_slice(&bench.read("out/summary.json")).unwrap();
        assert_eq!(summary["quality"]["state"], "doubtful", "{words:?}: {}", summary["quality"]);
        assert!(summary["quality"]["reasons"].to_string().contains("lost_forces"), "{}", summary["quality"]);
        assert_ne!(summary["verdict"]["state"], "infeasible", "{}", summary["verdict"]);
    }
    edit_vectors(&bench, |_, v| v);
    let run = bench.run(&ON_TABLE).done();
    assert!(!run.stderr.contains("horizontal force"), "{}", run.stderr);
}

#[test]
fn a_load_that_is_stronger_than_the_other_for_the_same_need_is_named_and_doubtful() {
    let bench = Workbench::new("unequal_table");
    for (factor, is_named) in [(1.25, true), (0.8, true), (1.05, false)] {
        edit_vectors(&bench, |_, v| v);
        bench.edit_rows("table.mot", |mut rows| {
            for cells in &mut rows {
                // Force and moment of the second load.
                for cell in [10, 11, 12, 16, 17, 18] {
                    cells[cell] = (factor * cells[cell].trim().parse::<f64>().unwrap()).to_string();
                }
            }
            rows
        });
        let run = bench.run(&ON_TABLE);
        let stronger = if factor > 1.0 { "the load `ground_force_2_` measures" } else { "`ground_force_1_` measures" };
        assert_eq!(run.stderr.contains(stronger), is_named, "{factor}: {}", run.stderr);
        let summary: Value = serde_json::from_slice(&bench.read("out/summary.json")).unwrap();
        let reasons = summary["quality"]["reasons"].to_string();
        assert_eq!(reasons.contains("lost_forces"), is_named, "{factor}: {reasons}");
    }
}

#[test]
fn one_force_may_serve_changing_feet() {
    let bench = Workbench::new("changing_feet");
    stated_moments(&bench);
    let expected = bench.table("out/moments.sto");
    let text = bench.text("walk_grf.mot");
    let (head, rows) = text.split_once("endheader\n").unwrap();
    // Three plates, on which the steps of both feet follow each other in turn.
    let mut names = vec!["time".to_owned()];
    for plate in 1..=3 {
        for part in
            [format!("ground_force_{plate}_v"), format!("ground_force_{plate}_p"), format!("ground_torque_{plate}_")]
        {
            names.extend(["x", "y", "z"].map(|axis| format!("{part}{axis}")));
        }
    }
    let (mut steps, mut plate_of, mut was_loaded) = (0, [0, 0], [false, false]);
    let mut lines = vec![names.join("\t")];
    for row in rows.lines().skip(1) {
        let cells: Vec<&str> = row.split('\t').collect();
        let mut plates = [["0"; 9]; 3];
        for foot in 0..2 {
            let own = &cells[1 + 9 * foot..10 + 9 * foot];
            let is_loaded = own[1].parse::<f64>().unwrap() > 0.0;
            if is_loaded && !was_loaded[foot] {
                plate_of[foot] = steps % 3;
                steps += 1;
            }
            was_loaded[foot] = is_loaded;
            if is_loaded {
                plates[plate_of[foot]].copy_from_slice(own);
            }
        }
        lines.push([&cells[..1], &plates.concat()[..]].concat().join("\t"));
    }
    assert!(steps >= 4, "{steps} steps: no plate serves both feet");
    let head = head.replace("nColumns=19", "nColumns=28");
    bench.write("table.mot", format!("{head}endheader\n{}\n", lines.join("\n")));
    let run = bench.run(&ON_TABLE).done();
    run.reports(&["`ground_force_1_...` on calcn_r by the centre of pressure", "`ground_force_1_...` on calcn_l by"]);
    let found = bench.table("out/moments.sto");
    for ((name, found), (_, expected)) in found.columns().zip(expected.columns()) {
        let worst = found.iter().zip(expected).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(worst < 1e-6, "{name}: {worst}");
    }
}

#[test]
fn a_load_far_from_both_feet_is_assigned_to_neither() {
    let bench = Workbench::new("far_load");
    let text = bench.text("walk_grf.mot").replace("_r_", "_1_").replace("_l_", "_2_");
    bench.write("table.mot", text);
    bench.edit_rows("table.mot", |mut rows| {
        rows.iter_mut().for_each(|cells| cells[15] = (cells[15].parse::<f64>().unwrap() - 3.0).to_string());
        rows
    });
    let run = bench.run(&ON_TABLE);
    run.warned(&[
        "`ground_force_2_...`",
        "its load was not assigned to a foot: no foot is near its centre of pressure",
    ]);
}

#[test]
fn a_load_that_pulls_its_foot_down_is_named_although_it_belongs_to_no_foot() {
    let bench = Workbench::new("downward_load");
    let down = "which was not used, down";
    for (reversed, warned) in [(11..12, down), (10..13, down), (0..0, "no step in which it carries a foot")] {
        bench.write("table.mot", bench.text("walk_grf.mot").replace("_r_", "_1_").replace("_l_", "_2_"));
        bench.edit_rows("table.mot", |mut rows| {
            for cells in &mut rows {
                for cell in &mut cells[reversed.clone()] {
                    *cell = format!("-{}", cell.trim()).replace("--", "");
                }
                if reversed.is_empty() {
                    // The load lies in a column of another axis.
                    (cells[10], cells[11]) = (cells[11].clone(), "0".to_owned());
                }
            }
            rows
        });
        let run = bench.run(&ON_TABLE);
        run.warned(&["ground_force_2_...`", warned]);
        let summary: Value = serde_json::from_slice(&bench.read("out/summary.json")).unwrap();
        assert_ne!(summary["quality"]["state"], "good", "{}", summary["quality"]);
        assert!(summary["quality"]["reasons"].to_string().contains("unassigned_forces"), "{}", summary["quality"]);
    }
}

#[test]
fn external_loads_on_the_wrong_foot_are_recognised() {
    let bench = Workbench::new("wrong_foot");
    assert!(!bench.forces(&RAW).done().stderr.contains("lies under"));
    bench.edit("walk_grf.xml", "calcn_l", "calcn_r");
    let run = bench.forces(&RAW);
    run.warned(&["the second load (`left`) lies under the left foot", "acts on `calcn_r`; it was used as stated"]);
    assert!(!run.stderr.contains("the first load"), "{}", run.stderr);
}

#[test]
fn the_filter_of_the_forces_is_chosen_and_printed() {
    let bench = Workbench::new("force_cutoff");
    let printed = |options: &[&str]| {
        let run = bench.forces(&[options, &["--verbose"]].concat());
        let line = run.stdout.lines().find(|line| line.trim_start().starts_with("filter")).map(str::to_owned);
        line.unwrap_or_else(|| panic!("no filter in: {}{}", run.stdout, run.stderr))
    };
    assert!(printed(&[]).contains("forces butterworth 25 Hz (order 3"), "{}", printed(&[]));
    assert!(printed(&["--force-cutoff", "same"]).contains("forces butterworth 6 Hz"));
    assert!(printed(&["--force-cutoff", "SAME", "--cutoff", "off"]).ends_with("forces off"));
    assert!(printed(&["--force-cutoff", "12.5", "--order", "2"]).contains("forces butterworth 12.5 Hz (order 2"));
    assert!(printed(&["--force-cutoff", "off"]).ends_with("forces off"));
    for wrong in ["1e-308", "0.5", "501", "-3", "nan", "sometimes"] {
        bench.forces(&["--force-cutoff", wrong]).refused(&["from 1 to 500 Hz, `same` (as the motion) or `off`"]);
    }
}

#[test]
fn a_stance_beside_the_plates_has_predicted_forces_that_every_table_marks() {
    let bench = with_demo("stance_beside_plates");
    let (all, _) = forces(&bench, &[]);
    let (found, _) = forces(&bench, &["--plate", "2=off"]);
    assert_eq!(found["ground"]["source"], "mixed");
    assert!(found["ground"]["rule"].as_str().unwrap().contains("a posteriori"), "{}", found["ground"]);
    let share = |summary: &Value, side: &str| summary["ground"]["measured_share"][side].as_f64().unwrap();
    assert!(share(&found, "right") < share(&all, "right") - 0.1, "{} of {}", found["ground"], all["ground"]);
    assert!((share(&found, "left") - share(&all, "left")).abs() < 0.02, "{} of {}", found["ground"], all["ground"]);
    let stances = rows(&bench, "stances.csv");
    let of = |source: &str| stances.iter().filter(|row| row[3] == source).count();
    assert!(of("plate 1") == 1 && of("plate 2") == 0 && of("predicted") >= 1, "{stances:?}");
    let lost =
        stances.iter().find(|row| row[0] == "r" && row[3] == "predicted" && row[1].parse::<f64>().unwrap() > 1.0);
    let lost = lost.unwrap_or_else(|| panic!("{stances:?}"));
    let middle = 0.5 * (lost[1].parse::<f64>().unwrap() + lost[2].parse::<f64>().unwrap());
    for name in ["moments.sto", "powers.sto", "reactions.sto", "grf.mot"] {
        let table = bench.table(&format!("out/{name}"));
        let frame = table.times().unwrap().partition_point(|time| *time < middle);
        assert!((table.column("ground_source_r").unwrap()[frame] - 1.0).abs() < 1e-9, "{name}");
    }
    let table = bench.table("out/grf.mot");
    let frame = table.times().unwrap().partition_point(|time| *time < middle);
    assert!(table.column("ground_force_r_vy").unwrap()[frame] > 300.0, "the leg carries the body");
    assert!(bench.text("out/clinical.csv").lines().next().unwrap().ends_with("ground_source_r,ground_source_l"));
    let run = bench.run(&["report", "out", "-o", "again.html"]).done();
    assert!(run.stdout.contains("again.html") && bench.text("again.html").contains("leg's loaded time"));
    // The marks are in several tables, and in the long one once.
    bench.run(&["convert", "out", "long.csv"]).done();
    let long = bench.text("long.csv");
    let cells: Vec<Vec<&str>> = long.lines().map(|line| line.split(',').collect()).collect();
    let places: BTreeSet<[&str; 2]> = cells.iter().map(|row| [row[0], row[1]]).collect();
    assert_eq!(places.len(), cells.len(), "each quantity has one number at a time");
    for quantity in ["ground_source_r", "ground_source_l", "heel_r_contact", "toes_l_contact"] {
        let own: Vec<&Vec<&str>> = cells.iter().filter(|row| row[1] == quantity).collect();
        assert!(own.len() == table.rows() && own.iter().all(|row| row[2] == "1"), "{quantity}: {:?}", own.first());
    }
}

#[test]
fn a_leg_whose_plate_is_left_out_is_named_beside_the_quality() {
    let Some(data) = crate::shared_data::data() else { return };
    let bench = Workbench::empty("plate_left_out");
    let path = |name: &str| data.join("biomechzoo-HC032A").join(name).display().to_string();
    let (walk, standing) = (path("HC032A03.c3d"), path("HC032A01.c3d"));
    let words = ["forces", &walk, "--static", &standing, "--plate", "1=off", "-o", "out"];
    let run = bench.run(&words).done();
    run.warned(&["0 % of the left leg's loaded time was measured", "under the left foot", "was left out"]);
    assert!(run.stdout.contains("  quality   doubtful"), "{}", run.stdout);
    let summary = bench.json("out/summary.json");
    assert_eq!(summary["quality"]["reasons"][0]["measure"], "unmeasured_leg");
    assert_eq!(summary["ground"]["measured_share"]["left"], 0.0);
    let page = bench.text("out/report.html");
    assert!(page.contains("0 % of the left leg"), "the page gives the reason");
}

#[test]
fn tables_of_a_walk_with_all_loads_are_not_marked() {
    let bench = Workbench::new("all_loads");
    let run = bench.forces(&RAW).done();
    assert!(!run.stdout.contains("  loads "), "{}", run.stdout);
    assert_eq!(bench.json("out/summary.json")["ground"]["source"], "measured");
    assert!(bench.table("out/moments.sto").column("ground_source_r").is_none());
    let stances = rows(&bench, "stances.csv");
    assert!(!stances.is_empty() && stances.iter().all(|row| row[3] == "table"), "{stances:?}");
}

#[test]
fn cells_that_depend_on_an_unknown_load_are_empty() {
    let Some(data) = crate::shared_data::data() else { return };
    let bench = Workbench::empty("unknown_load");
    let folder = data.join("kuleuven-walk-squat");
    bench.write("squat.trc", fs::read(folder.join("markers_Squat2.trc")).unwrap());
    bench.write("squat_grf.mot", fs::read(folder.join("grf_Squat2.mot")).unwrap());
    bench.edit_rows("squat_grf.mot", |mut rows| {
        let is_data = |cells: &&mut Vec<String>| cells.first().is_some_and(|time| time.parse::<f64>().is_ok());
        rows.iter_mut().filter(is_data).for_each(|cells| cells[7..13].fill("0".to_owned()));
        rows
    });
    let run = bench.run(&["forces", "squat.trc", "--grf", "squat_grf.mot", "--mass", "62.7", "-o", "out"]);
    run.warned(&["the load of the right foot", "cannot be predicted reliably"]);
    assert!(run.stdout.contains("measured in 0 % of the right leg's loaded time"), "{}", run.stdout);
    let clinical = bench.text("out/clinical.csv");
    let head: Vec<&str> = clinical.lines().next().unwrap().split(',').collect();
    let cell = |name: &str| {
        let column = head.iter().position(|known| *known == name).unwrap();
        clinical.lines().nth(200).unwrap().split(',').nth(column).unwrap().to_owned()
    };
    assert_eq!((cell("knee_flexion_moment_r").as_str(), cell("ground_force_vertical_r").as_str()), ("", ""));
    assert!(!cell("knee_flexion_r").is_empty() && !cell("knee_flexion_moment_l").is_empty());
    bench.run(&["report", "out", "-o", "again.html"]).done();
}

#[test]
fn a_cycle_has_one_stance_also_if_a_stance_in_it_was_not_measured() {
    let bench = Workbench::new("stance_not_measured");
    bench.forces(&RAW).done();
    let strikes: Vec<f64> = rows(&bench, "events.csv")
        .iter()
        .filter(|row| row[0] == "r" && row[1] == "strike")
        .map(|row| row[2].parse().unwrap())
        .collect();
    let of_right = |bench: &Workbench| cycles(bench).into_iter().filter(|(side, _)| side == "r").count();
    let whole = of_right(&bench);
    assert!(strikes.len() >= 3 && whole + 1 == strikes.len(), "{strikes:?}");
    bench.edit_rows("walk_grf.mot", |mut rows| {
        let stance = strikes[1] - 0.05..strikes[1] + 0.8 * (strikes[1] - strikes[0]);
        let lost = |cells: &[String]| stance.contains(&cells[0].parse::<f64>().unwrap());
        rows.iter_mut().filter(|cells| lost(cells)).for_each(|cells| cells[1..4].fill("0".to_owned()));
        rows
    });
    let run = bench.forces(&RAW);
    assert!(run.stdout.contains("of the right leg's loaded time"), "{}", run.stdout);
    assert_eq!(of_right(&bench), whole - 2, "the cycles before and after the stance without a load");
}
