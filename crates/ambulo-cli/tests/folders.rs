//! Result folders: all or nothing after a kill, on a full disk and with two runs at once; files of others stay;
//! mixtures are refused.
//!
//! The tests of `replacement` stop a run after every single change; here the program itself is killed.

use crate::workbench::Workbench;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::Child;
use std::thread::sleep;
use std::time::{Duration, Instant};

const LONG: [&str; 6] = ["simulate", "pendulum.toml", "--duration", "0.6", "-o", "out"];
const SHORT: [&str; 7] = ["simulate", "pendulum.toml", "--duration", "0.3", "-o", "out", "--keep=report,tables"];

/// A folder with a scene, the results of its long run and files of the user.
fn bench(name: &str) -> Workbench {
    let bench = Workbench::empty(name);
    let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/pendulum.toml");
    bench.write("pendulum.toml", fs::read(scene).unwrap());
    fs::create_dir_all(bench.folder.join("out/figures")).unwrap();
    bench.write("out/claims.json", "mine");
    bench.write("out/figures/mine.svg", "mine");
    bench.run(&LONG).done();
    bench
}

/// The content of the folder `out` without durations.
fn contents(bench: &Workbench) -> BTreeMap<String, String> {
    let names = bench.names("out").into_iter().filter(|name| name != "timings.json");
    names.map(|name| (name.clone(), bench.hash(&format!("out/{name}")))).collect()
}

/// Puts the folder back as it was.
fn restore(bench: &Workbench, saved: &str) {
    let out = bench.folder.join("out");
    fs::remove_dir_all(&out).unwrap();
    for name in bench.names(saved) {
        fs::create_dir_all(out.join(&name).parent().unwrap()).unwrap();
        fs::copy(bench.folder.join(saved).join(&name), out.join(&name)).unwrap();
    }
}

fn save(bench: &Workbench, saved: &str) {
    for name in bench.names("out") {
        let path = bench.folder.join(saved).join(&name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::copy(bench.folder.join("out").join(&name), path).unwrap();
    }
}

/// Waits until a run begins to write files, or has ended.
fn wait_for_files(bench: &Workbench, child: &mut Child) {
    while !bench.exists("out/.ambulo-new") && child.try_wait().unwrap().is_none() {
        sleep(Duration::from_micros(200));
    }
}

/// Numbers from 0 to 1 that look random and are the same in every run.
fn seeded(count: u64) -> impl Iterator<Item = f64> {
    let next = |x: &u64| Some(x.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407));
    std::iter::successors(Some(5), next).skip(1).take(count as usize).map(|x| (x >> 11) as f64 / (1_u64 << 53) as f64)
}

#[test]
fn a_killed_run_leaves_all_old_or_all_new() {
    let bench = bench("killed");
    save(&bench, "saved");
    let old = contents(&bench);
    let start = Instant::now();
    let mut child = bench.command(&SHORT).spawn().unwrap();
    wait_for_files(&bench, &mut child);
    let computing = start.elapsed();
    assert_eq!(child.wait().unwrap().code(), Some(0));
    let (new, writing) = (contents(&bench), start.elapsed() - computing);
    assert!(old != new && !bench.exists("out/figures/energy.svg") && bench.text("out/figures/mine.svg") == "mine");
    let (mut olds, mut news) = (0, 0);
    for (kill, share) in seeded(24).enumerate() {
        restore(&bench, "saved");
        let mut child = bench.command(&SHORT).spawn().unwrap();
        // Every fourth is killed at any time, the others while files are written.
        if kill % 4 == 0 {
            sleep(computing.mul_f64(share));
        } else {
            wait_for_files(&bench, &mut child);
            sleep(writing.mul_f64(share));
        }
        child.kill().unwrap();
        child.wait().unwrap();
        bench.run(&["view", "out"]).done();
        bench.run(&["convert", "out", "out.glb", "--force"]).done();
        let mut found = contents(&bench);
        // It has no lock any more.
        found.remove(".ambulo-lock");
        assert!(found == old || found == new, "kill {kill} at {share}: {:?}", found.keys());
        (olds, news) = (olds + usize::from(found == old), news + usize::from(found == new));
    }
    println!("killed: {olds} old, {news} new, 0 torn");
    bench.run(&SHORT).done();
    assert!(contents(&bench) == new, "no lock and no rest remains");
}

#[test]
fn a_full_disk_leaves_the_old_results_and_names_the_path() {
    if cfg!(not(unix)) {
        return;
    }
    let bench = bench("full");
    let old = contents(&bench);
    bench.run_on_a_small_disk(20, &SHORT).refused(&[
        "no results were written",
        "out/.ambulo-new/",
        "cannot be written",
    ]);
    assert!(contents(&bench) == old);
    bench.run_on_a_small_disk(20, &["report", "out"]).refused(&["out/.ambulo-new/report.html"]);
    bench.run_on_a_small_disk(1, &["convert", "out", "x.glb"]).refused(&["x.glb: this file needs", "`ulimit -f`"]);
    assert!(contents(&bench) == old && !bench.exists("x.glb"));
    bench.run(&["view", "out"]).done();
}

#[test]
fn of_two_runs_into_one_folder_one_is_refused() {
    let bench = bench("two");
    let (mut refused, mut whole) = (0, Vec::new());
    for run in [&SHORT[..], &LONG] {
        bench.run(run).done();
        whole.push(contents(&bench));
    }
    for _ in 0..6 {
        let mut runs = [bench.command(&SHORT), bench.command(&LONG)];
        let children = runs.each_mut().map(|run| run.spawn().unwrap());
        let codes = children.map(|mut child| child.wait().unwrap().code().unwrap());
        assert!(codes.contains(&0) && codes.iter().all(|code| [0, 2].contains(code)), "{codes:?}");
        refused += codes.iter().filter(|code| **code == 2).count();
        assert!(whole.contains(&contents(&bench)), "files of two runs");
    }
    println!("{refused} of 6 second runs refused");
    let lock = fs::File::create(bench.folder.join("out/.ambulo-lock")).unwrap();
    lock.lock().unwrap();
    bench.run(&SHORT).refused(&["out: another ambulo command is writing to this folder", "hint: wait"]);
    bench.run(&["report", "out"]).refused(&["another ambulo command"]);
    bench.run(&["view", "out"]).done();
}

#[test]
fn files_that_no_run_recorded_are_not_replaced_without_force() {
    let bench = bench("foreign");
    bench.run(&SHORT).done();
    assert_eq!((bench.text("out/claims.json").as_str(), bench.text("out/figures/mine.svg").as_str()), ("mine", "mine"));
    // A folder without results, with a file that the run would replace.
    fs::create_dir_all(bench.folder.join("work")).unwrap();
    bench.write("work/energy.csv", "mine");
    let work = ["simulate", "pendulum.toml", "--duration", "0.1", "-o", "work"];
    bench.run(&work).refused(&["work/energy.csv: no run of Ambulo recorded this file", "hint: choose another folder"]);
    assert_eq!(bench.names("work"), ["energy.csv"]);
    bench.run(&[&work[..], &["--force"]].concat()).done();
    assert!(bench.text("work/energy.csv") != "mine");
    // A result that was edited.
    bench.write("out/energy.csv", "edited");
    bench.run(&SHORT).refused(&["out/energy.csv: this file was changed after the run"]);
    assert_eq!(bench.text("out/energy.csv"), "edited");
    bench.run(&[&SHORT[..], &["--force"]].concat()).done();
    // The results of an earlier version, and a summary of another program.
    bench.write("out/summary.json", "{}");
    bench.run(&SHORT).refused(&["out/summary.json: this file does not record the files of a run", "--force"]);
    bench.run(&[&SHORT[..], &["--force"]].concat()).done();
    // Single files.
    bench.write("state.json", "mine");
    bench.run(&[&SHORT[..], &["--save", "state.json"]].concat()).refused(&["state.json: this file already exists"]);
    bench.run(&[&SHORT[..], &["--save", "state.json", "--force"]].concat()).done();
    bench.write("page.html", "mine");
    bench.run(&["report", "out", "-o", "page.html"]).refused(&["page.html: this file already exists"]);
    bench.write("out/report.html", "mine");
    bench.run(&["report", "out"]).refused(&["out/report.html: this file was changed", "--force"]);
    bench.run(&["report", "out", "--force"]).done();
    bench.run(&["view", "out"]).done();
}

#[test]
fn an_existing_list_of_events_needs_force() {
    let bench = Workbench::new("list_of_events");
    bench.write("events.csv", "mine");
    let events = ["events", "walk_grf.mot", "-o", "events.csv"];
    bench.run(&events).refused(&["events.csv: this file already exists", "--force"]);
    assert_eq!(bench.text("events.csv"), "mine");
    bench.run(&[&events[..], &["--force"]].concat()).done();
    assert!(bench.text("events.csv").starts_with("side,event,time,source\n"));
}

#[test]
fn files_of_two_runs_are_refused_by_every_command_that_reads_them() {
    let bench = bench("mixed");
    bench.run(&[&SHORT[..4], &["-o", "short"]].concat()).done();
    let (table, page) = (bench.read("out/energy.csv"), bench.read("out/report.html"));
    bench.write("out/energy.csv", bench.read("short/energy.csv"));
    let mixed = ["these files belong to two runs: energy.csv", "hint: run the command"];
    bench.run(&["report", "out"]).refused(&mixed);
    bench.run(&["report", "short", "--compare", "out", "-o", "both.html"]).refused(&mixed);
    bench.run(&["view", "out"]).refused(&mixed);
    bench.run(&["convert", "out", "x.glb"]).refused(&mixed);
    bench.write("out/energy.csv", table);
    bench.write("out/report.html", bench.read("short/report.html"));
    let mixed = ["these files belong to two runs: report.html"];
    bench.run(&["view", "out"]).refused(&mixed);
    bench.run(&["view", "out/report.html"]).refused(&mixed);
    bench.write("out/report.html", page);
    // Files that a command does not need may be deleted or changed.
    bench.write("out/figures/energy.svg", "drawn over");
    bench.run(&["view", "out"]).done();
    fs::remove_dir_all(bench.folder.join("out/figures")).unwrap();
    for args in [&["report", "out"][..], &["view", "out"], &["convert", "out", "x.glb"]] {
        bench.run(args).done();
    }
    fs::remove_file(bench.folder.join("out/poses.csv")).unwrap();
    bench.run(&["convert", "out", "y.glb"]).refused(&["out/poses.csv: this file of the run is missing"]);
    // The page is recorded again when it is written again.
    bench.run(&["report", "short"]).done();
    assert_eq!(bench.json("short/summary.json")["files"]["report.html"], bench.hash("short/report.html"));
}

#[test]
fn a_table_of_another_run_is_not_compared() {
    let bench = Workbench::new("compared");
    bench.forces(&["--quiet"]).done();
    bench.forces(&["--quiet", "--cutoff", "5", "-o", "other"]).done();
    let table = |folder: &str| format!("{folder}/moments.sto");
    let compare = |a: &str, b: &str| bench.run(&["compare", &table(a), &table(b)]);
    compare("out", "other").done();
    bench.write("out/moments.sto", bench.read("other/moments.sto"));
    let mixed = ["these files belong to two runs: moments.sto"];
    compare("out", "other").refused(&mixed);
    compare("other", "out").refused(&mixed);
    // A copy elsewhere belongs to no run.
    fs::create_dir_all(bench.folder.join("copy")).unwrap();
    bench.write("copy/moments.sto", bench.read("out/moments.sto"));
    compare("copy", "other").done();
}

#[test]
fn the_id_of_a_run_depends_on_inputs_and_options_alone() {
    let bench = bench("id");
    let id = |args: &[&str]| {
        bench.run(args).done();
        bench.json(&format!("{}/summary.json", args.last().unwrap()))["run_id"].as_str().unwrap().to_owned()
    };
    let first = id(&[&SHORT[..4], &["-o", "a"]].concat());
    assert_eq!(first.len(), 64);
    assert_eq!(first, id(&[&SHORT[..4], &["--quiet", "-o", "b"]].concat()));
    assert_ne!(first, id(&[&LONG[..4], &["-o", "c"]].concat()));
    let scene = bench.text("pendulum.toml");
    bench.write("pendulum.toml", format!("{scene}\n# changed\n"));
    assert_ne!(first, id(&[&SHORT[..4], &["-o", "d"]].concat()));
    // Every file but the summary and the durations is recorded.
    let recorded: Vec<String> = bench.json("a/summary.json")["files"].as_object().unwrap().keys().cloned().collect();
    let is_recorded = |name: &String| !["summary.json", "timings.json"].contains(&name.as_str());
    assert_eq!(recorded, bench.names("a").into_iter().filter(is_recorded).collect::<Vec<_>>());
}
