//! `ambulo batch`: Parquet tables of all trials; shards, kills and resumed runs; what is refused.
//!
//! | claim                                                                                  | tolerance                        |
//! |----------------------------------------------------------------------------------------|----------------------------------|
//! | the numbers are those of `ambulo forces`                                               | 1e-6 of the largest: they have single precision |
//! | a trial that cannot be computed is a row with its error                                | exact                            |
//! | threads, kills at any moment and continued runs change no byte                         | exact                            |
//! | shards compute every trial once                                                        | exact                            |
//! | another batch, changed inputs, a run at the same time, a full disk are refused by name | exact                            |
//! | a motion that is spoiled is ranked before the good one, with the reason                 | exact                            |
//! | a part without results has no file of frames, and stays closed                          | exact                            |
//! | a model that is read and scaled once gives each trial the results of `ambulo forces`     | single precision                 |
//! | the page is written when all shards are complete, with the same bytes                  | exact                            |
//! | all files of a table have the same columns, whatever the bodies, and a card lists them  | exact                            |
//! | with other limits only parts with trials that could not be computed are computed again | exact                            |
//! | the error against one plate is in the column of the foot that stood on it              | exact                            |

use crate::shared_data;
use crate::workbench::{Workbench, demo_input};
use ambulo_formats::parquet::{ColumnValues, ParquetTable};
use std::collections::BTreeMap;
use std::f64::consts::PI;
use std::fs::{self, File};
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::Duration;

const TRIALS: usize = 5;

/// A folder `set` with five walks of a figure in separate folders, and a broken recording.
fn set(name: &str) -> Workbench {
    let bench = Workbench::empty(name).always_removed();
    for trial in 0..TRIALS {
        fs::create_dir_all(bench.folder.join(format!("set/person {trial}"))).unwrap();
        bench.write(&format!("set/person {trial}/figure.osim"), demo_input("figure.osim"));
        let walk = String::from_utf8(demo_input("walk.mot")).unwrap();
        // Each walk ends a frame earlier.
        let lines: Vec<&str> = walk.lines().collect();
        let rows = lines.len() - lines.iter().position(|line| line.trim() == "endheader").unwrap() - 2;
        let cut = lines[..lines.len() - trial].join("\n") + "\n";
        let cut = cut.replace(&format!("nRows={rows}"), &format!("nRows={}", rows - trial));
        bench.write(&format!("set/person {trial}/walk.mot"), cut);
    }
    bench.write("set/person 1/broken.c3d", "PathFileType");
    bench
}

const BATCH: [&str; 6] = ["batch", "set", "--part", "2", "--quiet", "-o"];

/// All Parquet files of a batch by name.
fn tables(bench: &Workbench, folder: &str) -> BTreeMap<String, Vec<u8>> {
    let mut all = BTreeMap::new();
    for table in ["trials", "frames", "cycles", "events"] {
        for name in bench.names(&format!("{folder}/{table}")) {
            let name = format!("{table}/{name}");
            let bytes = bench.read(&format!("{folder}/{name}"));
            if name.ends_with(".parquet") {
                all.insert(name, bytes);
            }
        }
    }
    all
}

fn texts(table: &ParquetTable, column: &str) -> Vec<Option<String>> {
    let Some(ColumnValues::Text(values)) = table.column(column) else { panic!("{column}") };
    values.clone()
}

/// Names of the trials of a batch, in the order of its files.
fn trials(bench: &Workbench, folder: &str) -> Vec<String> {
    let all = tables(bench, folder);
    let of_trials = all.iter().filter(|(name, _)| name.starts_with("trials/"));
    of_trials.flat_map(|(_, bytes)| texts(&ParquetTable::read(bytes).unwrap(), "trial")).flatten().collect()
}

#[test]
fn the_numbers_are_those_of_forces_and_a_broken_recording_is_a_row() {
    let bench = set("batch");
    let run = bench.run(&["batch", "set", "-o", "out"]).done();
    assert!(run.stdout.contains("5 of 6 trials") && run.stdout.contains(": person 1/broken.c3d\n"), "{}", run.stdout);
    let trials = ParquetTable::read(&bench.read("out/trials/part-000-00000.parquet")).unwrap();
    let errors = texts(&trials, "error");
    assert_eq!(errors.iter().flatten().count(), 1, "{errors:?}");
    let keys = texts(&trials, "key");
    assert!(keys.iter().all(|key| keys.iter().filter(|other| *other == key).count() == 1), "{keys:?}");
    let frames = ParquetTable::read(&bench.read("out/frames/part-000-00000.parquet")).unwrap();
    bench.run(&["forces", "set/person 0/walk.mot", "--model", "set/person 0/figure.osim", "-o", "one"]).done();
    let moments = bench.table("one/moments.sto");
    let own: Vec<usize> =
        texts(&frames, "key").iter().enumerate().filter(|(_, key)| **key == keys[0]).map(|(k, _)| k).collect();
    assert_eq!(own.len(), moments.rows());
    let names = texts(&trials, "trial");
    let in_frames = texts(&frames, "trial");
    assert!(own.iter().all(|k| in_frames[*k] == names[0]), "every table has the name of the trial");
    for (name, expected) in moments.columns().filter(|(name, _)| *name != "time") {
        let Some(ColumnValues::Single(found)) = frames.column(name) else { panic!("no column {name}") };
        let largest = expected.iter().fold(1e-3, |most: f64, x| most.max(x.abs()));
        let worst = own.iter().zip(expected).map(|(k, x)| (f64::from(found[*k]) - x).abs()).fold(0.0, f64::max);
        assert!(worst < 1e-6 * largest, "{name}: {worst} of {largest}");
    }
    assert_eq!(frames.about("unit of hip_flexion_r_moment"), Some("N.m"));
    let cycles = ParquetTable::read(&bench.read("out/cycles/part-000-00000.parquet")).unwrap();
    assert!(texts(&cycles, "quantity").contains(&Some("knee_angle_moment".to_owned())));
    bench.write("set/person 1/other.c3d", bench.read("set/person 1/broken.c3d"));
    let grouped = bench.run(&["batch", "set", "-o", "grouped"]).done().stdout;
    assert_eq!(grouped.matches("failed").count(), 1, "one line for one reason: {grouped}");
    assert!(grouped.contains("failed    2 trials: "), "{grouped}");
    fs::remove_file(bench.folder.join("set/person 1/other.c3d")).unwrap();
    let ranked = bench.run(&["batch", "set", "-o", "ranked", "--check", "--json"]);
    let ranked: serde_json::Value = serde_json::from_str(&ranked.stdout).unwrap();
    assert_eq!(
        (&ranked["counts"]["computed"], &ranked["ranking"][0]["name"]),
        (&5.into(), &"person 1/broken.c3d".into())
    );
}

#[test]
fn threads_kills_and_continued_runs_change_no_byte() {
    let bench = set("batch_killed");
    bench.run(&[&BATCH[..], &["whole", "--jobs", "1"]].concat()).done();
    let whole = tables(&bench, "whole");
    assert_eq!(whole.len(), 4 * 3, "three parts of four tables: {:?}", whole.keys());
    // As a kill leaves it that came while the description was written.
    fs::create_dir_all(bench.folder.join("threads/.shards/000")).unwrap();
    bench.write("threads/.shards/000/batch.json", "{");
    bench.run(&[&BATCH[..], &["threads", "--jobs", "3"]].concat()).done();
    assert!(tables(&bench, "threads") == whole, "three threads");
    let mut interrupted = 0;
    for kill in 0..10_u64 {
        let mut run = bench.command(&[&BATCH[..], &["killed", "--resume"]].concat()).spawn().unwrap();
        sleep(Duration::from_millis(20 + 35 * (kill % 5)));
        let ended = run.try_wait().unwrap().is_some();
        run.kill().unwrap();
        run.wait().unwrap();
        interrupted += usize::from(!ended);
        // What is there is closed, and as it must be.
        let found = if bench.exists("killed/trials") { tables(&bench, "killed") } else { BTreeMap::new() };
        let closed = found.iter().filter(|(name, _)| name.starts_with("trials/"));
        closed.for_each(|(name, bytes)| assert!(whole[name] == *bytes, "{name} after kill {kill}"));
    }
    bench.run(&[&BATCH[..], &["killed", "--resume"]].concat()).done();
    assert!(tables(&bench, "killed") == whole, "after {interrupted} interruptions");
    // A part without its trials is open: what is left of it is written again.
    fs::remove_file(bench.folder.join("killed/trials/part-000-00001.parquet")).unwrap();
    bench.write("killed/frames/part-000-00001.parquet", "torn");
    bench.run(&[&BATCH[..], &["killed", "--resume"]].concat()).done();
    assert!(tables(&bench, "killed") == whole, "an open part is written again");
}

#[test]
fn shards_compute_every_trial_once() {
    let bench = set("batch_shards");
    bench.run(&[&BATCH[..], &["out", "--shard", "0/2"]].concat()).done();
    bench.run(&[&BATCH[..], &["out", "--shard", "1/2"]].concat()).done();
    bench.run(&[&BATCH[..], &["whole"]].concat()).done();
    let (mut found, mut all) = (trials(&bench, "out"), trials(&bench, "whole"));
    found.sort();
    all.sort();
    assert_eq!((found.len(), found), (TRIALS + 1, all));
    bench
        .run(&[&BATCH[..], &["out", "--shard", "1/3"]].concat())
        .refused(&["another batch", "shards: found 2, expected 3"]);
    for wrong in ["0", "nan", "inf", "x"] {
        bench.run(&["batch", "set", &format!("--time-limit={wrong}")]).refused(&["a number of seconds above 0"]);
        bench.run(&["batch", "set", &format!("--size-limit={wrong}")]).refused(&["a number of megabytes above 0"]);
    }
    for wrong in ["2/2", "-1/2", "1", "0/0", "a/b"] {
        bench.run(&["batch", "set", "--shard", wrong]).refused(&["I/N", "0/4"]);
    }
    // A recording that appears between two shards would move others from one to the other.
    bench.run(&[&BATCH[..], &["moved", "--shard", "0/2"]].concat()).done();
    bench.write("set/a new one.c3d", "PathFileType");
    bench
        .run(&[&BATCH[..], &["moved", "--shard", "1/2"]].concat())
        .refused(&["found other trials in the source", "compute all shards again"]);
}

#[test]
fn a_batch_goes_on_where_nobody_reads_its_progress() {
    let bench = set("batch_unread");
    let mut child = bench
        .command(&["batch", "set", "--part", "2", "-o", "out"])
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stderr.take());
    assert!(child.wait().unwrap().success());
    assert_eq!(trials(&bench, "out").len(), TRIALS + 1);
}

#[test]
fn a_closed_part_that_lost_a_table_is_computed_again() {
    let bench = set("batch_lost");
    bench.run(&[&BATCH[..], &["out"]].concat()).done();
    let all = tables(&bench, "out");
    for lost in ["frames/part-000-00001.parquet", "cycles/part-000-00000.parquet"] {
        fs::remove_file(bench.folder.join("out").join(lost)).unwrap();
    }
    // A copy that was interrupted.
    let events = "out/events/part-000-00002.parquet";
    bench.write(events, &bench.read(events)[..20]);
    bench.run(&[&BATCH[..], &["out", "--resume"]].concat()).done();
    assert!(tables(&bench, "out") == all);
    bench.write("out/trials/part-000-00000.parquet", "PAR1");
    bench.run(&[&BATCH[..], &["out", "--resume"]].concat()).refused(&["part-000-00000.parquet", "remove this file"]);
}

#[test]
fn a_part_without_results_has_no_frames_and_stays_closed() {
    let bench = set("batch_part_without_results");
    // The second trial of the list is alone in its part and cannot be computed.
    bench.write("list.csv", "file,model\nset/person 0/walk.mot,set/person 0/figure.osim\nset/person 1/broken.c3d,\n");
    let words = ["batch", "list.csv", "--part", "1", "--quiet", "-o", "out", "--resume"];
    bench.run(&words).done();
    let found = tables(&bench, "out");
    let names: Vec<&str> = found.keys().map(String::as_str).filter(|name| name.contains("00001")).collect();
    assert_eq!(names, ["cycles", "events", "trials"].map(|table| format!("{table}/part-000-00001.parquet")));
    let closed =
        |part: &str| fs::metadata(bench.folder.join(format!("out/trials/{part}"))).unwrap().modified().unwrap();
    let before = closed("part-000-00001.parquet");
    // What an interrupted run may have left of an open part goes.
    fs::remove_file(bench.folder.join("out/trials/part-000-00000.parquet")).unwrap();
    bench.run(&words).done();
    assert_eq!(closed("part-000-00001.parquet"), before, "a part that is closed is not computed again");
    fs::remove_file(bench.folder.join("out/trials/part-000-00001.parquet")).unwrap();
    bench.write("out/frames/part-000-00001.parquet", "torn");
    bench.run(&words).done();
    assert!(tables(&bench, "out") == found);
}

#[test]
fn all_files_of_a_table_have_the_same_columns_and_the_card_lists_them() {
    let bench = set("batch_same_columns");
    bench.run(&["demo", "-o", "demo", "--quiet", "--keep", "recording"]).done();
    // Trials of two bodies: that of the model, and the built-in one with its arms.
    bench.write(
        "list.csv",
        "file,model,static,mass\nset/person 0/walk.mot,set/person 0/figure.osim,,\n\
         demo/input/walk.c3d,,demo/input/standing.c3d,75\nset/person 1/broken.c3d,,,\n",
    );
    let keep = "--keep=kinematics,moments,powers,reactions,grf,grf_sd,foot_contact,events,cycles,clinical";
    let words = ["batch", "list.csv", "--part", "1", "--quiet", keep, "-o", "out", "--shard"];
    bench.run(&[&words[..], &["0/2"]].concat()).done();
    assert!(!bench.exists("out/README.md"), "one of two shards");
    bench.run(&[&words[..], &["1/2"]].concat()).done();
    let found = tables(&bench, "out");
    let frames = || found.iter().filter(|(name, _)| name.starts_with("frames/"));
    let read: Vec<ParquetTable> = frames().map(|(_, bytes)| ParquetTable::read(bytes).unwrap()).collect();
    let names = |table: &ParquetTable| table.columns.iter().map(|column| column.name.clone()).collect::<Vec<_>>();
    assert_eq!(read.len(), 2);
    assert_eq!(names(&read[0]), names(&read[1]));
    // What the first body does not have is missing, with its unit; what it has is kept.
    let values = |table: &ParquetTable, name: &str| match table.column(name) {
        Some(ColumnValues::Single(values)) => values.clone(),
        _ => panic!("{name}"),
    };
    let is_own = |name: &String| values(&read[0], name).iter().all(|value| value.is_nan());
    let added: Vec<String> = names(&read[1])[4..].iter().filter(|name| is_own(name)).cloned().collect();
    assert!(added.iter().any(|name| name.starts_with("arm_")), "{added:?}");
    assert!(added.iter().all(|name| read[0].about(&format!("unit of {name}")).is_some()));
    assert!(values(&read[0], "knee_angle_r_moment").iter().any(|value| value.abs() > 10.0));
    let card = bench.text("out/README.md");
    for name in names(&read[0]).iter().chain(&["error".to_owned(), "speed_m_s".to_owned()]) {
        assert!(card.contains(&format!("| `{name}` |")), "{name}");
    }
    assert!(card.contains("2 trials were computed, 1 could not be"), "{card}");
    let described: Vec<&str> = card.lines().filter(|line| line.starts_with("| `")).collect();
    assert!(described.len() > 100, "{}", described.len());
    assert!(described.iter().all(|line| !line.ends_with("|  |")), "every column has a meaning: {card}");
    // A part that is lost gets the same columns again.
    fs::remove_file(bench.folder.join("out/frames/part-000-00000.parquet")).unwrap();
    bench.run(&[&words[..], &["0/2", "--resume"]].concat()).done();
    assert!(tables(&bench, "out") == found);
    assert_eq!(bench.text("out/README.md"), card);
}

#[test]
fn a_trial_that_was_too_large_is_computed_when_the_limit_is_raised() {
    let bench = set("batch_limits");
    fs::remove_file(bench.folder.join("set/person 1/broken.c3d")).unwrap();
    // Comments make one file larger than the others.
    let walk = bench.text("set/person 3/walk.mot");
    let largest = walk.len() as f64 * 1.1 + bench.read("set/person 3/figure.osim").len() as f64;
    bench.write("set/person 3/walk.mot", format!("{}{walk}", "long header\n".repeat(walk.len() / 40)));
    let limit = format!("--size-limit={}", largest / 1e6);
    bench.run(&[&BATCH[..], &["out", &limit]].concat()).done();
    let part = |k: usize| bench.read(&format!("out/trials/part-000-0000{k}.parquet"));
    let errors = |k: usize| texts(&ParquetTable::read(&part(k)).unwrap(), "error");
    assert_eq!(errors(0), [None, None]);
    let [None, Some(error)] = &errors(1)[..] else { panic!("{:?}", errors(1)) };
    assert!(error.contains("MB; expected at most") && error.contains("continue the batch"), "{error}");
    let before = [part(0), part(1)];
    bench.run(&[&BATCH[..], &["out", &limit, "--resume"]].concat()).done();
    assert_eq!(before, [part(0), part(1)]);
    bench.run(&[&BATCH[..], &["out", "--resume"]].concat()).done();
    assert_eq!(before[0], part(0), "a part without an error stays closed");
    assert_eq!(errors(1), [None, None]);
}

/// The first frames of a TRC.
fn first_frames(trc: &str, count: usize) -> String {
    let cut = |(k, line): (usize, &str)| {
        let mut cells: Vec<String> = line.split('\t').map(str::to_owned).collect();
        let number = cells[0].parse::<usize>().ok();
        // The third line has rates and counts.
        if k == 2 {
            cells[2] = count.to_string();
        }
        (k < 3 || number.is_none_or(|number| number <= count)).then(|| cells.join("\t") + "\n")
    };
    trc.lines().enumerate().filter_map(cut).collect()
}

/// The markers of a TRC at rest where they are in the first frame.
fn frozen(trc: &str) -> String {
    let is_row = |line: &str| line.split('\t').next().is_some_and(|cell| cell.parse::<u32>().is_ok());
    let place = |line: &str| line.splitn(3, '\t').nth(2).unwrap_or_default().to_owned();
    // The third line also begins with a number: rates and counts.
    let first = trc.lines().skip(3).find(|line| is_row(line)).map(place).unwrap();
    let row = |(k, line): (usize, &str)| match k >= 3 && is_row(line) {
        true => format!("{}\t{first}\n", line.splitn(3, '\t').take(2).collect::<Vec<_>>().join("\t")),
        false => format!("{line}\n"),
    };
    trc.lines().enumerate().map(row).collect()
}

#[test]
fn trials_that_share_a_scaled_model_have_the_results_of_each_alone() {
    let bench = Workbench::empty("batch_one_model").always_removed();
    bench.run(&["demo", "-o", "demo", "--quiet", "--keep", "recording"]).done();
    bench.write("figure.osim", bench.read("demo/input/figure.osim"));
    // A stride is enough: markers are fitted frame by frame.
    bench.write("walk.trc", first_frames(&bench.text("demo/input/walk.trc"), 130));
    bench.write("standing.trc", frozen(&first_frames(&bench.text("walk.trc"), 20)));
    // Two trials of one person, and the same with another mass.
    let lines = [70, 70, 90].iter().enumerate().map(|(k, mass)| {
        bench.write(&format!("walk{k}.trc"), bench.read("walk.trc"));
        format!("walk{k}.trc,figure.osim,standing.trc,{mass}\n")
    });
    let list = "file,model,static,mass\n".to_owned() + &lines.collect::<String>();
    bench.write("list.csv", &list);
    bench.run(&["batch", "list.csv", "-o", "out", "--quiet", "--jobs", "1"]).done();
    let table = ParquetTable::read(&bench.read("out/trials/part-000-00000.parquet")).unwrap();
    let frames = ParquetTable::read(&bench.read("out/frames/part-000-00000.parquet")).unwrap();
    let (keys, rows) = (texts(&table, "key"), texts(&frames, "key"));
    let findings = texts(&table, "findings");
    let Some(ColumnValues::Single(found)) = frames.column("knee_angle_r_moment") else { panic!("no moments") };
    let of = |k: usize| -> Vec<f32> {
        rows.iter().zip(found).filter(|(key, _)| **key == keys[k]).map(|(_, value)| *value).collect()
    };
    let own = |k: usize, mass: &str| {
        let folder = format!("one{k}");
        let walk = format!("walk{k}.trc");
        let words =
            ["forces", &walk, "--model", "figure.osim", "--static", "standing.trc", "--mass", mass, "-o", &folder];
        bench.run(&words).done();
        let table = bench.table(&format!("{folder}/moments.sto"));
        table.columns().find(|(name, _)| *name == "knee_angle_r_moment").unwrap().1.to_vec()
    };
    for (k, mass) in ["70", "70", "90"].into_iter().enumerate() {
        let expected: Vec<f32> = own(k, mass).iter().map(|value| *value as f32).collect();
        assert_eq!(of(k), expected, "trial {k}");
    }
    assert_eq!(of(0), of(1), "the same trial twice");
    assert_ne!(of(1), of(2), "another mass is another body");
    // Findings of reading and scaling are those of each trial.
    let scaled = |k: usize| findings[k].as_ref().unwrap().matches("the model was scaled to the standing trial").count();
    assert_eq!([scaled(0), scaled(1), scaled(2)], [1; 3], "{findings:?}");
}

#[test]
fn a_value_behind_an_equals_sign_is_the_same_option_and_a_file_behind_it_is_an_input() {
    let bench = set("batch_equals");
    bench.write("figures.toml", "");
    let batch = |folder: &str, words: &[&str]| {
        let run = ["batch", "set", "--limit", "1", "--quiet", "-o", folder, "--keep", "events", "--resume", "--"];
        bench.run(&[&run[..], words].concat())
    };
    batch("apart", &["--from", "0.5"]).done();
    batch("joined", &["--from=0.5"]).done();
    assert!(tables(&bench, "apart") == tables(&bench, "joined"));
    batch("apart", &["--from=0.5"]).done();
    batch("apart", &["--from=0.6"]).refused(&["another batch", "--from 0.5"]);
    batch("file", &["--thresholds=figures.toml"]).done();
    let trials = ParquetTable::read(&bench.read("file/trials/part-000-00000.parquet")).unwrap();
    assert!(texts(&trials, "inputs")[0].as_ref().unwrap().contains("figures.toml"));
}

#[test]
fn a_full_disk_loses_no_closed_part() {
    let bench = set("batch_full");
    bench.run(&[&BATCH[..], &["whole"]].concat()).done();
    let whole = tables(&bench, "whole");
    let frames = |part: usize| whole[&format!("frames/part-000-0000{part}.parquet")].len();
    assert!(frames(0) < frames(1), "the first part has one walk, the second two");
    let words = [&BATCH[..], &["full", "--resume"]].concat();
    bench.run_on_a_small_disk((frames(0) + frames(1)) / 2048, &words).refused(&[
        "frames/part-000-00001.parquet",
        "cannot be written",
        "--resume continues",
    ]);
    let closed = tables(&bench, "full");
    assert_eq!(closed.len(), 4, "the first part, and no half of the second: {:?}", closed.keys());
    assert!(closed.iter().all(|(name, bytes)| whole[name] == *bytes));
    bench.run(&words).done();
    assert!(tables(&bench, "full") == whole);
}

#[test]
fn spoiled_motions_are_ranked_before_the_good_one_with_the_reason() {
    let bench = Workbench::empty("batch_ranked").always_removed();
    // Name, column, what is added to it at a time [s], and a part of the reason.
    type Added = fn(f64) -> f64;
    let spoiled: [(&str, &str, Added, &str); 4] = [
        ("twice as fast", "time", |time_s| -0.5 * time_s, "the residual force is"),
        (
            "a floor that drops",
            "pelvis_ty",
            |time_s| if time_s > 2.18 { -0.05 } else { 0.0 },
            "something other than the feet",
        ),
        ("feet that slide", "pelvis_tz", |time_s| 0.05 * (4.0 * PI * time_s).sin(), "soles that carry the body move"),
        ("an ankle beyond its range", "ankle_angle_l", |_| 70.0, "the joint reaches"),
    ];
    bench.run(&["demo", "-o", "demo", "--quiet", "--keep", "recording"]).done();
    for name in spoiled.iter().map(|(name, ..)| *name).chain(["good"]) {
        fs::create_dir_all(bench.folder.join(format!("set/{name}"))).unwrap();
        for file in ["figure.osim", "walk.mot"] {
            bench.write(&format!("set/{name}/{file}"), bench.read(&format!("demo/input/{file}")));
        }
    }
    for (name, column, added, _) in &spoiled {
        let walk = format!("set/{name}/walk.mot");
        let text = bench.text(&walk);
        let names = text.lines().skip_while(|line| line.trim() != "endheader").nth(1).unwrap();
        let column = names.split_whitespace().position(|own| own == *column).unwrap();
        bench.edit_rows(&walk, |mut rows| {
            for row in &mut rows {
                let [time_s, value] = [0, column].map(|cell| row[cell].parse::<f64>().unwrap());
                row[column] = (value + added(time_s)).to_string();
            }
            rows
        });
    }
    let run = bench.run(&["batch", "set", "-o", "out", "--check", "--json"]);
    let found: serde_json::Value = serde_json::from_str(&run.stdout).unwrap();
    let ranking = found["ranking"].as_array().unwrap();
    let row = |name: &str| ranking.iter().find(|row| row["name"] == format!("{name}/walk.mot"));
    assert!(row("good").is_none(), "{ranking:?}");
    for (name, _, _, reason) in &spoiled {
        let row = row(name).unwrap_or_else(|| panic!("{name} is not ranked"));
        assert!(row["reasons"].to_string().contains(reason), "{name}: {row}");
    }
    the_page_has_the_command_of_a_page(&bench);
}

/// Copied from the page into a shell, it computes the trial.
#[cfg(unix)]
fn the_page_has_the_command_of_a_page(bench: &Workbench) {
    let page = bench.text("out/summary.html");
    let begin = page.find("ambulo forces 'set/feet that slide/walk.mot'").unwrap_or_else(|| panic!("{page}"));
    let command = page[begin..].split_once('<').unwrap().0;
    assert!(
        command.ends_with("--model 'set/feet that slide/figure.osim' --output feet-that-slide-walk-mot-page"),
        "{command}"
    );
    let program = bench.command(&[]);
    let own = format!("{}{}", program.get_program().to_string_lossy(), command.strip_prefix("ambulo").unwrap());
    let status = Command::new("sh").args(["-c", &own]).current_dir(&bench.folder).output().unwrap();
    assert!(status.status.success(), "{command}: {}", String::from_utf8_lossy(&status.stderr));
    assert!(bench.exists("feet-that-slide-walk-mot-page/report.html"));
}

#[cfg(not(unix))]
fn the_page_has_the_command_of_a_page(bench: &Workbench) {
    assert!(bench.text("out/summary.html").contains("ambulo forces \""));
}

#[test]
fn the_page_is_written_when_all_shards_are_complete() {
    let bench = set("batch_page");
    bench.run(&[&BATCH[..], &["out", "--shard", "0/2"]].concat()).done();
    assert!(!bench.exists("out/summary.html"), "one of two shards");
    bench.run(&[&BATCH[..], &["out", "--shard", "1/2"]].concat()).done();
    let page = bench.text("out/summary.html");
    assert!(page.contains("5 of 6 trials were computed") && page.contains("person 1/broken.c3d"), "{page}");
    bench.run(&["batch", "set", "-o", "whole", "--quiet"]).done();
    assert_eq!(bench.text("whole/summary.html"), page, "parts and shards do not change the page");
    // A page that is lost is made again from the tables.
    fs::remove_file(bench.folder.join("out/summary.html")).unwrap();
    bench.run(&[&BATCH[..], &["out", "--shard", "0/2", "--resume"]].concat()).done();
    assert_eq!(bench.text("out/summary.html"), page);
}

#[test]
fn the_error_against_one_plate_is_in_the_column_of_its_foot() {
    let Some(data) = shared_data::data() else { return };
    let bench = Workbench::empty("batch_one_foot").always_removed();
    // The right foot stood on a plate; the left one did not.
    let folder = data.join("biomechzoo-HC036A");
    let shown = |name: &str| folder.join(name).display().to_string();
    bench.write("list.csv", format!("file,static\n{},{}\n", shown("HC036A23.c3d"), shown("HC036A01.c3d")));
    bench.run(&["batch", "list.csv", "-o", "out", "--quiet", "--keep", "events", "--", "--predict"]).done();
    let table = ParquetTable::read(&bench.read("out/trials/part-000-00000.parquet")).unwrap();
    let errors = ["r", "l"].map(|side| match table.column(&format!("predicted_vertical_rmse_{side}_bw")) {
        Some(ColumnValues::Double(values)) => values[0],
        other => panic!("{side}: {other:?}"),
    });
    assert!(errors[0] > 0.0 && errors[0] < 0.3 && errors[1].is_nan(), "{errors:?}");
}

#[test]
fn another_batch_changed_inputs_and_a_second_run_are_refused() {
    let bench = set("batch_refused");
    bench.run(&[&BATCH[..], &["out"]].concat()).done();
    bench.run(&[&BATCH[..], &["out"]].concat()).refused(&["has results already", "--resume"]);
    bench
        .run(&[&BATCH[..], &["out", "--resume", "--", "--cutoff", "8"]].concat())
        .refused(&["another batch", "--cutoff 8"]);
    bench.run(&["batch", "set", "--part", "3", "-o", "out", "--resume"]).refused(&["--part: found 2, expected 3"]);
    bench.edit("set/person 0/figure.osim", "figure", "body_");
    bench.run(&[&BATCH[..], &["out", "--resume"]].concat()).refused(&["person 0/walk.mot", "changed since"]);
    // A run at the same time has this lock.
    fs::create_dir_all(bench.folder.join("busy/.shards/000")).unwrap();
    let lock = File::create(bench.folder.join("busy/.shards/000/.ambulo-lock")).unwrap();
    lock.lock().unwrap();
    bench.run(&[&BATCH[..], &["busy"]].concat()).refused(&["another batch is writing shard 0/1"]);
    for folder in ["mine", "torn"] {
        fs::create_dir_all(bench.folder.join(folder)).unwrap();
    }
    bench.write("mine/notes.txt", "mine");
    bench.run(&[&BATCH[..], &["mine"]].concat()).refused(&["has other files"]);
    assert_eq!(bench.text("mine/notes.txt"), "mine");
    bench.write("torn/batch.json", "{");
    bench.run(&[&BATCH[..], &["torn"]].concat()).refused(&["not the description of a batch"]);
}

#[test]
fn sources_without_a_trial_and_options_of_a_batch_after_the_dashes_are_refused() {
    let bench = set("batch_sources");
    fs::create_dir_all(bench.folder.join("empty")).unwrap();
    bench.run(&["batch", "empty"]).refused(&["found no trial", "recordings of motion"]);
    bench.run(&["batch", "nowhere"]).refused(&["no such folder"]);
    bench.run(&["batch", "set", "--", "-o", "elsewhere"]).refused(&["after `--`", "before"]);
    bench.run(&["batch", "set", "--", "--cutof", "8"]).refused(&["after `--`", "--cutof"]);
    // A size is that of one person.
    bench.run(&["batch", "set", "--quiet", "-o", "sized", "--", "--mass", "80"]).refused(&[
        "--mass",
        "persons",
        "trials.toml",
    ]);
    for count in ["--jobs", "--part", "--limit"] {
        for wrong in ["0", "-1", "NaN", "1e99"] {
            bench.run(&["batch", "set", &format!("{count}={wrong}")]).refused(&[count]);
        }
    }
    bench.write("list.jsonl", "{\"file\": \"set/person 0/walk.mot\"}\n");
    bench.run(&["batch", "list.jsonl", "--quiet", "-o", "failed"]).refused(&["none of 1 trials", "failed/trials"]);
    assert_eq!(trials(&bench, "failed"), ["set/person 0/walk.mot"], "its row says why");
}

#[test]
fn a_list_of_trials_names_their_files() {
    let bench = set("batch_list");
    bench.write(
        "list.csv",
        "file,model,person\nset/person 0/walk.mot,set/person 0/figure.osim,Ann\nset/person \
        3/walk.mot,set/person 3/figure.osim,\n",
    );
    bench.run(&["batch", "list.csv", "-o", "csv", "--quiet"]).done();
    bench.write(
        "list.jsonl",
        "{\"file\": \"set/person 0/walk.mot\", \"model\": \"set/person 0/figure.osim\", \
         \"person\": \"Ann\"}\n\n{\"file\": \"set/person 3/walk.mot\", \"model\": \"set/person 3/figure.osim\"}\n",
    );
    bench.run(&["batch", "list.jsonl", "-o", "jsonl", "--quiet"]).done();
    assert!(tables(&bench, "csv") == tables(&bench, "jsonl"), "both lists name the same trials");
    let table = ParquetTable::read(&bench.read("csv/trials/part-000-00000.parquet")).unwrap();
    assert_eq!(texts(&table, "person"), [Some("Ann".to_owned()), Some("set/person 3".to_owned())]);
    for (line, words) in [
        ("{\"file\": \"a.c3d\", \"modell\": \"b\"}", &["line 1", "modell"][..]),
        ("{\"file\": \"a.c3d\", \"mass\": -3}", &["line 1", "above 0"]),
        ("{\"file\": \"a.c3d\"}\n{\"file\": \"a.c3d\"}", &["`a.c3d` in two lines"]),
        ("{\"file\": \"a.c3d\"}\n{\"file\": 3}", &["line 2: ", "column"]),
        ("{\"file\": \"a.c3d\", \"mass\": \"82,5\"}", &["found the size `82,5`", "with a point"]),
        ("[\"a.c3d\"]", &["line 1: expected an object"]),
        ("{\"file\": \"\"}", &["a line without `file`"]),
        ("", &["found no trial"]),
    ] {
        bench.write("wrong.jsonl", line);
        bench.run(&["batch", "wrong.jsonl"]).refused(words);
    }
}
