//! The report page compared with its files: every drawn number is in the files, and missing parts are reported.

use crate::report_pages::{Files, Shown, keep_lines, page_of, recorded, with_summary};
use ambulo_formats::table::Table;
use ambulo_report::page::report_page;
use ambulo_results::Folder;
use serde_json::{Value, json};
use std::collections::BTreeMap;

// ---- numbers ----

/// The curves of `cycles.csv` by quantity, side and cycle, read with other code than the page's.
fn curves(files: &Files) -> BTreeMap<(String, String, u64), Vec<f64>> {
    let text = String::from_utf8(files["cycles.csv"].clone()).unwrap();
    let mut curves: BTreeMap<_, Vec<f64>> = BTreeMap::new();
    for line in text.lines().skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        let key = (cells[0].to_owned(), cells[1].to_owned(), cells[2].parse().unwrap());
        curves.entry(key).or_default().push(cells[4].parse().unwrap());
    }
    curves
}

/// How many numbers of the page differ from `factor` times those of the files by more than half a step of the 16-bit
/// numbers.
fn compared(shown: &Shown, files: &Files) -> (usize, usize) {
    let curves = curves(files);
    let (mut same, mut different) = (0, 0);
    let mut compare = |series: &Value, expected: &[f64], factor: f64, gaps: bool| {
        let found = shown.series(series);
        assert_eq!(found.len(), expected.len());
        let slack = 0.5 * series["step"].as_f64().unwrap() + 1e-12;
        for (found, expected) in found.iter().zip(expected) {
            match (found - factor * expected).abs() <= slack * (1.0 + 1e-9) || gaps && found.is_nan() {
                true => same += 1,
                false => different += 1,
            }
        }
    };
    for panel in shown.panels() {
        for curve in panel["cycles"].as_array().unwrap() {
            let origin = &curve["origin"];
            assert_eq!(origin["file"], "cycles.csv");
            let word = |value: &Value| value.as_str().unwrap().to_owned();
            let key = (word(&origin["column"]), word(&curve["side"]), curve["number"].as_u64().unwrap());
            compare(&curve["values"], &curves[&key], origin["factor"].as_f64().unwrap(), false);
        }
        for trace in panel["traces"].as_array().unwrap().iter().filter(|trace| trace["origin"].is_object()) {
            let origin = &trace["origin"];
            let table = Table::read_storage(&files[origin["file"].as_str().unwrap()]).unwrap().0;
            let column = table.column(origin["column"].as_str().unwrap()).unwrap();
            let place = panel["id"].as_str().unwrap().starts_with("center_of_pressure") || panel["id"] == "free_moment";
            let drawn: Vec<f64> = column.iter().copied().step_by(shown.rows_per_instant(column.len())).collect();
            compare(&trace["values"], &drawn, origin["factor"].as_f64().unwrap(), place);
        }
    }
    (same, different)
}

#[test]
fn every_number_drawn_is_that_of_the_files() {
    let files = recorded();
    let (same, different) = compared(&Shown::of(&files), &files);
    assert_eq!(different, 0);
    assert!(same > 20_000, "{same} numbers");
}

/// The same motion with this many rows for each step of time, interpolated linearly.
fn refined(files: &Files, times: usize) -> Files {
    let mut refined = files.clone();
    for (name, bytes) in files {
        let is_csv = name == "clinical.csv";
        if !is_csv && ![".mot", ".sto"].iter().any(|ending| name.ends_with(ending)) {
            continue;
        }
        let read = if is_csv { Table::read_csv(bytes) } else { Table::read_storage(bytes) };
        let table = read.unwrap().0;
        let between = |values: &[f64]| -> Vec<f64> {
            let pairs = values.windows(2).flat_map(|pair| {
                (0..times).map(|k| pair[0] + (pair[1] - pair[0]) * k as f64 / times as f64).collect::<Vec<_>>()
            });
            pairs.chain(values.last().copied()).collect()
        };
        let columns = table.columns().map(|(name, values)| (name.to_owned(), between(values))).collect();
        let mut fine = Table::new(table.name.clone(), columns).unwrap();
        fine.in_degrees = table.in_degrees;
        refined.insert(name.clone(), if is_csv { fine.write_csv() } else { fine.write_storage() });
    }
    refined
}

#[test]
fn of_a_long_recording_the_page_draws_evenly_spaced_instants_and_all_cycles() {
    let short = recorded();
    let rows = |files: &Files| Table::read_storage(&files["kinematics.mot"]).unwrap().0.rows();
    let files = refined(&short, 13_000 / rows(&short));
    let (shown, whole) = (Shown::of(&files), Shown::of(&short));
    let time = &shown.session()["time"];
    let step = shown.rows_per_instant(rows(&files));
    assert!(step >= 2 && time["frames"].as_u64().unwrap() <= 4_000, "{step} rows per instant, {time}");
    let times = Table::read_storage(&files["kinematics.mot"]).unwrap().0.times().unwrap().to_vec();
    let spacing = time["step_s"].as_f64().unwrap();
    assert!((spacing - (times[step] - times[0])).abs() < 1e-9 * spacing.max(1.0), "{spacing} s");
    let (same, different) = compared(&shown, &files);
    assert_eq!(different, 0);
    assert!(same > 50_000, "{same} numbers");
    assert_eq!(shown.session()["cycles"], whole.session()["cycles"]);
    assert!(shown.misses("Not all instants") && !whole.misses("Not all instants"));
}

#[test]
fn a_number_changed_in_a_file_is_noticed() {
    let files = recorded();
    for (file, column) in
        [("moments.sto", "knee_angle_r_moment"), ("kinematics.mot", "hip_flexion_l"), ("grf.mot", "ground_force_l_vy")]
    {
        let mut changed = files.clone();
        let table = Table::read_storage(&files[file]).unwrap().0;
        let columns = table.columns().map(|(name, values)| {
            let mut values = values.to_vec();
            if name == column {
                values[100] += 5.0;
            }
            (name.to_owned(), values)
        });
        let mut table = Table::new("changed", columns.collect()).unwrap();
        table.in_degrees = Some(true);
        changed.insert(file.to_owned(), table.write_storage());
        let (_, different) = compared(&Shown::of(&changed), &files);
        assert!(different >= 1, "{file}");
    }
}

#[test]
fn means_are_those_of_the_cycles() {
    let shown = Shown::of(&recorded());
    let panel = shown.panel("knee_flexion_moment");
    let of_side = |key: &str| {
        let list = panel[key].as_array().unwrap().iter().filter(|curve| curve["side"] == "r");
        list.map(|curve| shown.series(&curve["values"])).collect::<Vec<_>>()
    };
    let (cycles, means) = (of_side("cycles"), of_side("means"));
    assert!(cycles.len() >= 2 && means.len() == 1, "{} cycles", cycles.len());
    let sd = shown.series(&panel["means"].as_array().unwrap().iter().find(|mean| mean["side"] == "r").unwrap()["sd"]);
    let count = cycles.len() as f64;
    for k in 0..101 {
        let mean = cycles.iter().map(|curve| curve[k]).sum::<f64>() / count;
        let variance = cycles.iter().map(|curve| (curve[k] - mean).powi(2)).sum::<f64>() / (count - 1.0);
        // All series lie within 2 N.m/kg, so that 16 bits err by 2 / 65534 / 2 each.
        assert!((means[0][k] - mean).abs() < 1e-4 && (sd[k] - variance.sqrt()).abs() < 1e-4, "{k} %");
    }
}

#[test]
fn clinical_signs_are_those_of_walking_people() {
    let shown = Shown::of(&recorded());
    let extremes = |id: &str| {
        let values = shown.series(&shown.panel(id)["means"][0]["values"]);
        (values.iter().copied().fold(f64::INFINITY, f64::min), values.iter().copied().fold(f64::NEG_INFINITY, f64::max))
    };
    let (_, knee) = extremes("knee_flexion_angle");
    assert!((40.0..80.0).contains(&knee), "the knee bends by {knee} deg in swing, which is positive");
    let (_, ankle) = extremes("ankle_dorsiflexion_moment");
    assert!((0.8..2.2).contains(&ankle), "plantarflexors push with {ankle} N.m/kg, which is positive");
    let (braking, driving) = extremes("ground_force_fore_aft");
    assert!(braking < -0.05 && driving > 0.05, "{braking} to {driving} BW");
    let (_, vertical) = extremes("ground_force_vertical");
    assert!((0.9..1.6).contains(&vertical), "{vertical} BW");
}

// ---- cycles, times and distances ----

#[test]
fn cycles_are_found_in_time_though_some_are_left_out() {
    let mut files = recorded();
    let all = Shown::of(&files);
    let cycles = |shown: &Shown| shown.session()["cycles"].as_array().unwrap().clone();
    let right: Vec<Value> = cycles(&all).into_iter().filter(|cycle| cycle["side"] == "r").collect();
    assert!(right.len() >= 2, "{right:?}");
    // As if plates measured only the second strike: the file numbers the remaining cycles from 1.
    keep_lines(&mut files, "cycles.csv", |line| !line.contains(",r,1,"));
    let text = String::from_utf8(files["cycles.csv"].clone()).unwrap().replace(",r,2,", ",r,1,");
    files.insert("cycles.csv".to_owned(), text.into_bytes());
    let left: Vec<Value> = cycles(&Shown::of(&files)).into_iter().filter(|cycle| cycle["side"] == "r").collect();
    assert_eq!((left[0]["number"].as_u64(), &left[0]["start_s"]), (Some(1), &right[1]["start_s"]));
    assert_ne!(left[0]["start_s"], right[0]["start_s"]);
}

#[test]
fn times_and_distances_are_those_of_the_summary() {
    let mut files = recorded();
    let shown = Shown::of(&files);
    let summary: Value = serde_json::from_slice(&files["summary.json"]).unwrap();
    let quantities = summary["times_and_distances"]["quantities"].as_array().unwrap();
    assert_eq!(quantities.len(), 15, "{quantities:?}");
    for (row, word) in [("Cadence", "cadence"), ("Step width", "step_width"), ("Double support", "double_support")] {
        let known = quantities.iter().find(|known| known["quantity"] == word).unwrap();
        for (column, side) in [(2, "right"), (3, "left"), (4, "both")] {
            let of_summary = known[side]["mean"].as_f64().unwrap();
            assert!((shown.value("time_distance", row, column) - of_summary).abs() < 1e-12, "{row}");
        }
    }
    with_summary(&mut files, |summary| summary["times_and_distances"]["belt_speed_m_s"] = json!(1.25));
    assert!(shown.header("Walking direction").ends_with("world x"), "{}", shown.header("Walking direction"));
    assert_eq!(Shown::of(&files).header("Walking direction"), "in place, on a treadmill at 1.25 m/s");
}

#[test]
fn bands_need_a_leg_length() {
    let mut files = recorded();
    let shown = Shown::of(&files);
    let band = &shown.panel("knee_flexion_angle")["band"];
    assert!(band["citation"].as_str().unwrap().contains("Schwartz"), "{band}");
    assert_eq!(shown.series(&band["mean"]).len(), shown.series(&band["sd"]).len());
    assert!(shown.header("Leg length").ends_with(" m"));
    files.remove("subject.osim");
    let bare = Shown::of(&files);
    assert!(bare.panel("hip_flexion_angle")["band"].is_null());
    assert!(bare.misses("No normative bands: the leg length is not known"));
    assert!(bare.session()["view"].is_null() && bare.misses("There is no body"));
    assert_eq!(bare.header("Leg length"), "not known");
}

#[test]
fn running_has_no_norms_of_walking() {
    let mut files = recorded();
    with_summary(&mut files, |summary| {
        let quantities = summary["times_and_distances"]["quantities"].as_array_mut().unwrap();
        let stance = quantities.iter_mut().find(|known| known["quantity"] == "stance").unwrap();
        stance["both"]["mean"] = json!(38.0);
    });
    let shown = Shown::of(&files);
    assert!(shown.value("time_distance", "Stance", 4) < 50.0);
    assert!(
        shown.panel("knee_flexion_angle")["band"].is_null() && shown.misses("stance lasts less than half of the cycle")
    );
    for row in ["Cadence", "Stance", "Step length", "Walk ratio"] {
        assert_eq!(shown.row("time_distance", row)[5], "", "{row} has no normal value");
        assert!((2..5).all(|column| !shown.stands_out("time_distance", row, column)), "{row}");
    }
}

#[test]
fn sessions_to_compare_keep_their_own_numbers() {
    let files = recorded();
    let mut heavier = files.clone();
    with_summary(&mut heavier, |summary| summary["mass_kg"] = json!(2.0 * summary["mass_kg"].as_f64().unwrap()));
    let (first, second) = (|name: &str| files.get(name).cloned(), |name: &str| heavier.get(name).cloned());
    let folders = [Folder::of_files("before", &first), Folder::of_files("after", &second)];
    let shown = Shown::read(&report_page(&folders).unwrap());
    let curve = |session: usize| {
        let groups = shown.page["sessions"][session]["groups"].as_array().unwrap();
        let mut panels = groups.iter().flat_map(|group| group["panels"].as_array().unwrap());
        let panel = panels.find(|panel| panel["id"] == "ankle_dorsiflexion_moment").unwrap();
        shown.series(&panel["means"][0]["values"])
    };
    for (before, after) in curve(0).iter().zip(curve(1)) {
        assert!((before - 2.0 * after).abs() < 1e-3, "{before} and {after} N.m/kg");
    }
    assert_eq!(shown.page["title"], "before / after");
}

// ---- verdict ----

#[test]
fn reasons_of_the_verdict_are_marked_on_their_panels() {
    let mut files = recorded();
    with_summary(&mut files, |summary| {
        let reason = |check: &str, quantity: &str, side: Option<&str>| {
            json!({"check": check, "quantity": quantity, "side": side, "time_s": [0.3, 0.4], "at_s": 0.35, "value": 3.0,
                "limit": 2.0, "unit": "N.m", "message": format!("{quantity} is too much")})
        };
        summary["verdict"]["state"] = json!("infeasible");
        summary["verdict"]["reasons"] = json!([
            reason("strength", "knee_angle_l_moment", Some("l")),
            reason("range", "hip_flexion_r", Some("r")),
            reason("power", "ankle_angle_r_power", Some("r")),
            reason("friction", "friction_r", Some("r")),
            reason("support", "support", None),
            reason("sliding", "sliding_r", Some("r")),
        ]);
    });
    let shown = Shown::of(&files);
    for (panel, side) in [
        ("knee_flexion_moment", json!("l")),
        ("hip_flexion_angle", json!("r")),
        ("ankle_dorsiflexion_power", json!("r")),
        ("friction_use", json!("r")),
        ("residual_force", Value::Null),
    ] {
        let red = shown.panel(panel)["red"].as_array().unwrap();
        assert_eq!((red.len(), &red[0]["side"], &red[0]["panel"]), (1, &side, &json!(panel)));
        assert_eq!((red[0]["from_s"].as_f64(), red[0]["to_s"].as_f64()), (Some(0.3), Some(0.4)));
    }
    assert!(shown.panel("hip_flexion_moment")["red"].as_array().unwrap().is_empty());
    let feasibility = &shown.session()["feasibility"];
    assert_eq!(feasibility["red"].as_array().unwrap().len(), 6);
    let sentence = feasibility["sentence"].as_str().unwrap();
    assert!(sentence.contains("could not") && sentence.contains("6 times"), "{sentence}");
}

// ---- missing parts ----

#[test]
fn a_recording_of_one_leg_is_reported() {
    let mut files = recorded();
    keep_lines(&mut files, "cycles.csv", |line| !line.contains(",l,"));
    let shown = Shown::of(&files);
    assert!(shown.misses("No whole cycle of the left foot") && !shown.misses("No whole cycle of the right foot"));
    let sides = |key: &str| {
        let list = shown.panel("hip_flexion_angle")[key].as_array().unwrap().clone();
        list.iter().map(|entry| entry["side"].as_str().unwrap().to_owned()).collect::<Vec<_>>()
    };
    assert_eq!(sides("means"), ["r"]);
    assert_eq!(sides("traces"), ["r", "l"], "over time both legs are there");
    assert_eq!(shown.row("extracted", "Knee flexion, range")[3], "-");
}

#[test]
fn no_whole_cycle_leaves_the_curves_over_time() {
    let mut files = recorded();
    files.remove("cycles.csv");
    let shown = Shown::of(&files);
    assert!(shown.misses("No whole gait cycle"));
    for panel in ["hip_flexion_angle", "ankle_dorsiflexion_moment", "ground_force_vertical"] {
        assert!(shown.panel(panel)["cycles"].as_array().unwrap().is_empty());
        assert_eq!(shown.panel(panel)["traces"].as_array().unwrap().len(), 2, "{panel}");
        assert!(shown.panel(panel)["empty"].is_null());
    }
    let tables = shown.session()["tables"].as_array().unwrap();
    let extracted = tables.iter().find(|table| table["id"] == "extracted").unwrap();
    assert!(extracted["empty"].as_str().unwrap().contains("no whole gait cycle"));
}

#[test]
fn missing_ground_forces_are_reported_in_their_group() {
    let mut files = recorded();
    for file in ["grf.mot", "events.csv", "cycles.csv"] {
        files.remove(file);
    }
    with_summary(&mut files, |summary| {
        summary["ground"]["source"] = json!("none");
        summary["speed_m_s"] = Value::Null;
    });
    let shown = Shown::of(&files);
    assert!(shown.misses("No ground forces"));
    assert_eq!(shown.session()["source"], "none");
    assert_eq!(shown.header("Ground forces"), "none");
    let groups = shown.session()["groups"].as_array().unwrap();
    let ground = groups.iter().find(|group| group["id"] == "ground").unwrap();
    assert!(ground["panels"].as_array().unwrap().is_empty());
    assert!(ground["note"].as_str().unwrap().contains("without ground forces"));
}

#[test]
fn every_panel_has_something_or_says_why_not() {
    for removed in [vec![], vec!["moments.sto"], vec!["powers.sto", "cycles.csv"], vec!["grf.mot", "events.csv"]] {
        let mut files = recorded();
        for file in &removed {
            files.remove(*file);
        }
        let shown = Shown::of(&files);
        for panel in shown.panels() {
            let drawn = ["cycles", "traces"].iter().any(|key| !panel[*key].as_array().unwrap().is_empty());
            assert!(drawn != panel["empty"].is_string(), "without {removed:?}: {}", panel["id"]);
        }
        let ids: Vec<&str> = shown.panels().iter().map(|panel| panel["id"].as_str().unwrap()).collect();
        let mut once = ids.clone();
        once.sort_unstable();
        once.dedup();
        assert_eq!(once.len(), ids.len(), "words of panels are unique");
    }
}

// ---- text that a user can influence ----

#[test]
fn script_in_names_stays_text() {
    const NASTY: &str = "</script><script>alert('x')</script><!-- & \"<img src=x onerror=alert(1)>";
    let mut files = recorded();
    let plain = page_of("plain", &files).unwrap();
    with_summary(&mut files, |summary| {
        summary["model"] = json!(NASTY);
        summary["input"]["motion"] = json!(NASTY.replace('/', "|"));
        summary["findings"] = json!([{"code": "residual.large", "severity": "note", "message": NASTY, "count": 1}]);
    });
    let html = page_of(NASTY, &files).unwrap();
    let count = |html: &str, word: &str| html.to_lowercase().matches(word).count();
    for word in ["<script", "</script", "<img", "<!--"] {
        assert_eq!(count(&html, word), count(&plain, word), "{word}");
    }
    let shown = Shown::read(&html);
    assert_eq!(shown.session()["name"], NASTY.replace('/', "|"));
    assert_eq!(shown.header("Subject and model"), NASTY);
    assert_eq!(shown.session()["quality"]["findings"][0]["message"], NASTY);
}

// ---- broken files ----

#[test]
fn malformed_files_are_rejected_with_file_and_line() {
    let text = |files: &Files, name: &str| String::from_utf8(files[name].clone()).unwrap();
    let files = recorded();
    let line = |name: &str, number: usize| text(&files, name).lines().nth(number - 1).unwrap().to_owned();
    let replaced = |name: &str, number: usize, with: &str| {
        let found = line(name, number);
        (name.to_owned(), text(&files, name).replacen(&found, with, 1))
    };
    let cases = [
        (replaced("cycles.csv", 40, "hip_flexion_angle,r,1,?,2,deg"), "folder/cycles.csv: line 40: found"),
        (replaced("events.csv", 3, "r,jump,0.5"), "folder/events.csv: line 3: found `r,jump,0.5`"),
        (replaced("events.csv", 2, "r,strike,NaN"), "folder/events.csv: line 2"),
        (replaced("moments.sto", 20, "a\tb"), "folder/moments.sto: line 20"),
        (("kinematics.mot".to_owned(), "no table".to_owned()), "folder/kinematics.mot: "),
        (("summary.json".to_owned(), "{".to_owned()), "folder/summary.json: "),
        (("summary.json".to_owned(), "{\"mass_kg\": 0}".to_owned()), "missing field `version`"),
        (("subject.osim".to_owned(), "<no model>".to_owned()), "folder/subject.osim: "),
    ];
    for ((name, content), expected) in cases {
        let mut broken = files.clone();
        broken.insert(name, content.into_bytes());
        let error = page_of("folder", &broken).unwrap_err().to_string();
        assert!(error.contains(expected), "{error}\nexpected {expected}");
    }
    let mut bare = files.clone();
    bare.remove("summary.json");
    assert!(page_of("folder", &bare).unwrap_err().to_string().contains("folder: found no summary.json"));
    let mut bare = files.clone();
    bare.remove("kinematics.mot");
    assert!(page_of("folder", &bare).unwrap_err().to_string().contains("folder: found no kinematics.mot"));
}

#[test]
fn a_table_with_other_instants_is_rejected() {
    let mut files = recorded();
    let table = Table::read_storage(&files["powers.sto"]).unwrap().0;
    let shorter = table.columns().map(|(name, values)| (name.to_owned(), values[..50].to_vec()));
    files.insert("powers.sto".to_owned(), Table::new("short", shorter.collect()).unwrap().write_storage());
    let error = page_of("folder", &files).unwrap_err().to_string();
    assert!(error.contains("folder/powers.sto: found 50 rows; expected 291"), "{error}");
}
