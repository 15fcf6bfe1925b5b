//! Replaces the results in a folder on a disk that fails after any change.

use ambulo_cli::internals::{
    Changes, Disk, Existing, MANIFEST, NEW, Record, ResultTarget, WriteContent, hash, recover, replace, settle,
};
use ambulo_results::{OutputFile, SUMMARY, TIMINGS};
use anyhow::{Error, Result};
use std::cell::Cell;
use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// A disk that fails after some changes: for good, as after a kill, or for writing only, as when it is full.
struct Failing {
    left: Cell<usize>,
    only_writing: bool,
}

impl Failing {
    fn after(changes: usize) -> Failing {
        Failing { left: Cell::new(changes), only_writing: false }
    }

    fn fails(&self) -> bool {
        let left = self.left.get();
        self.left.set(left.saturating_sub(1));
        left == 0
    }
}

/// More changes than a run makes.
const MOST: usize = 32;

fn stopped<T>() -> io::Result<T> {
    Err(io::Error::other("stopped"))
}

impl Changes for Failing {
    fn create_dir(&self, path: &Path) -> io::Result<()> {
        if !self.only_writing && self.fails() { stopped() } else { fs::create_dir_all(path) }
    }

    fn write(&self, path: &Path, content: &mut WriteContent<'_>) -> io::Result<()> {
        let mut bytes = Vec::new();
        content(&mut bytes)?;
        if self.fails() {
            fs::write(path, &bytes[..bytes.len() / 2])?;
            return stopped();
        }
        fs::write(path, bytes)
    }

    fn rename(&self, from: &Path, to: &Path) -> io::Result<()> {
        if !self.only_writing && self.fails() { stopped() } else { fs::rename(from, to) }
    }

    fn remove_file(&self, path: &Path) -> io::Result<()> {
        if !self.only_writing && self.fails() { stopped() } else { fs::remove_file(path) }
    }

    fn remove_dir(&self, path: &Path) -> io::Result<()> {
        if !self.only_writing && self.fails() {
            let first = fs::read_dir(path)?.flatten().map(|entry| entry.path()).find(|path| path.is_file());
            first.map_or(Ok(()), fs::remove_file)?;
            return stopped();
        }
        fs::remove_dir_all(path)
    }
}

const OLD: [(&str, &str); 4] =
    [("moments.sto", "old"), ("cycles.csv", "old"), ("figures/moments.svg", "old"), ("input/walk.c3d", "old")];
const NEWER: [(&str, &str); 4] =
    [("moments.sto", "newer"), ("grf.mot", "newer"), ("figures/moments.svg", "newer"), ("figures/gait.svg", "newer")];
const MINE: [(&str, &str); 3] = [("notes.txt", "mine"), ("claims.json", "mine"), ("figures/mine.svg", "mine")];

/// The files of a run without their summary.
fn run(files: &[(&str, &str)]) -> Vec<OutputFile<'static>> {
    files.iter().map(|(name, text)| OutputFile::new(*name, text.as_bytes().to_vec())).collect()
}

fn summary(files: BTreeMap<String, String>) -> Result<Vec<u8>> {
    let id = hash(files.values().cloned().collect::<String>().as_bytes());
    Ok(serde_json::json!({ "run_id": id, "files": files }).to_string().into_bytes())
}

fn fresh(name: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("ambulo-replacement-{}-{name}", std::process::id()));
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(folder.join("figures")).unwrap();
    for (name, text) in MINE {
        fs::write(folder.join(name), text).unwrap();
    }
    replace(&Failing::after(usize::MAX), &folder, &run(&OLD), &mut summary, BTreeMap::new()).unwrap();
    folder
}

/// Old files that the new run does not replace.
fn stale() -> BTreeMap<String, String> {
    ["cycles.csv", "input/walk.c3d"].map(|name| (name.to_owned(), hash(b"old"))).into()
}

fn contents(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut found = BTreeMap::new();
    for path in fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        match path.is_dir() {
            true => found.extend(contents(&path).into_iter().map(|(inner, bytes)| (format!("{name}/{inner}"), bytes))),
            false => _ = found.insert(name, fs::read(&path).unwrap()),
        }
    }
    found
}

fn expected(files: &[(&str, &str)]) -> BTreeMap<String, Vec<u8>> {
    let mine = MINE.map(|(name, text)| (name.to_owned(), text.as_bytes().to_vec()));
    let texts = || files.iter().map(|(name, text)| ((*name).to_owned(), text.as_bytes().to_vec()));
    let hashes = texts().map(|(name, bytes)| (name, hash(&bytes))).collect();
    texts().chain(mine).chain([(SUMMARY.to_owned(), summary(hashes).unwrap())]).collect()
}

#[test]
fn a_run_stopped_after_any_change_leaves_all_old_or_all_new_even_if_its_recovery_is_stopped_too() {
    let (mut old, mut new) = (0, 0);
    for changes in 0..MOST {
        let mut again = 0;
        loop {
            let folder = fresh("stopped");
            let first = replace(&Failing::after(changes), &folder, &run(&NEWER), &mut summary, stale());
            assert!(changes < MOST - 1 || first.is_ok(), "a run makes fewer changes");
            let complete = first.is_ok() || folder.join(NEW).join(MANIFEST).exists();
            // Stopped or not, another recovery completes it.
            let _ = settle(&Failing::after(again), &folder);
            let recovered = !folder.join(NEW).exists();
            settle(&Disk, &folder).unwrap();
            let found = contents(&folder);
            assert!(found == expected(if complete { &NEWER } else { &OLD }), "{changes}, {again}: {found:?}");
            (old, new) = (old + usize::from(!complete), new + usize::from(complete));
            fs::remove_dir_all(folder).unwrap();
            again += 1;
            if recovered {
                break;
            }
        }
    }
    assert!(old > 20 && new > 50, "{old} old, {new} new");
}

#[test]
fn a_full_disk_leaves_the_old_results_at_once() {
    for writes in 0..NEWER.len() + 2 {
        let folder = fresh("full");
        let full = Failing { left: Cell::new(writes), only_writing: true };
        let error = replace(&full, &folder, &run(&NEWER), &mut summary, stale()).unwrap_err();
        let message = format!("{error:#}");
        assert!(message.contains("earlier ones are unchanged") && message.contains(NEW), "{message}");
        assert!(contents(&folder) == expected(&OLD), "{writes}");
        fs::remove_dir_all(folder).unwrap();
    }
}

#[test]
fn files_of_others_need_force_and_inputs_always_stay() {
    let folder = fresh("foreign");
    let target = |existing| ResultTarget::open(&folder, existing).unwrap();
    let claims = run(&[("claims.json", "newer")]);
    let refusal = |existing, inputs: &[PathBuf]| {
        target(existing).replace(&claims, inputs, &mut summary).map_err(|error| error.to_string())
    };
    assert!(refusal(Existing::Kept, &[]).unwrap_err().contains("claims.json: no run of Ambulo recorded this file"));
    let inputs = [folder.join("claims.json")];
    assert!(refusal(Existing::Replaced, &inputs).unwrap_err().contains("input file would be overwritten"));
    fs::write(folder.join("cycles.csv"), "edited").unwrap();
    let edited = ResultTarget::for_run(&folder, Existing::Kept).err().unwrap().to_string();
    assert!(edited.contains("cycles.csv: this file was changed"), "{edited}");
    assert_eq!(fs::read(folder.join("claims.json")).unwrap(), b"mine");
    refusal(Existing::Replaced, &[]).unwrap();
    target(Existing::Kept).replace(&run(&NEWER), &[], &mut summary).unwrap();
    assert!(!folder.join("claims.json").exists(), "it was recorded");
    refusal(Existing::Kept, &[]).unwrap();
    assert_eq!(fs::read(folder.join("claims.json")).unwrap(), b"newer");
    assert!(!folder.join("cycles.csv").exists() && folder.join("notes.txt").exists());
    fs::remove_dir_all(folder).unwrap();
}

#[test]
fn durations_are_replaced_with_their_run_and_are_not_recorded() {
    let folder = fresh("durations");
    let path = folder.join(TIMINGS);
    let of_run = |id: &str| serde_json::json!({ "run_id": id, "timing_ms": {} }).to_string();
    let replaced = |files: &[OutputFile<'_>]| {
        ResultTarget::for_run(&folder, Existing::Kept)?.replace(files, &[], &mut summary)?;
        Ok::<Record, Error>(Record::of_folder(&folder).unwrap())
    };
    // A file of this name that belongs to no run is the user's.
    fs::write(&path, of_run("another")).unwrap();
    let with_timings = run(&[&NEWER[..], &[(TIMINGS, "new")]].concat());
    assert!(replaced(&with_timings).unwrap_err().to_string().contains("timings.json: no run of Ambulo recorded"));
    let record = replaced(&run(&NEWER)).unwrap();
    assert!(path.exists());
    // That of the run is replaced, and removed by a run without one.
    fs::write(&path, of_run(&record.run_id)).unwrap();
    let record = replaced(&with_timings).unwrap();
    assert_eq!(fs::read(&path).unwrap(), b"new");
    assert!(!record.files.contains_key(TIMINGS), "{:?}", record.files);
    fs::write(&path, of_run(&record.run_id)).unwrap();
    replaced(&run(&OLD)).unwrap();
    assert!(!path.exists());
    fs::remove_dir_all(folder).unwrap();
}

#[test]
fn a_folder_is_taken_by_one_command_at_a_time() {
    let folder = fresh("taken");
    let first = ResultTarget::open(&folder, Existing::Kept).unwrap();
    let second = ResultTarget::open(&folder, Existing::Kept).err().unwrap().to_string();
    assert!(second.contains("another ambulo command is writing to this folder"), "{second}");
    drop(first);
    drop(ResultTarget::open(&folder, Existing::Kept).unwrap());
    assert!(contents(&folder) == expected(&OLD), "the lock leaves no file");
    // A folder that was made for the lock is removed with it.
    let made = folder.join("a/b");
    drop(ResultTarget::open(&made, Existing::Kept).unwrap());
    assert!(!folder.join("a").exists());
    fs::remove_dir_all(folder).unwrap();
}

#[test]
fn a_manifest_that_names_a_file_outside_is_refused() {
    let folder = fresh("outside");
    fs::create_dir_all(folder.join(NEW)).unwrap();
    fs::write(folder.join(NEW).join(MANIFEST), r#"{"files": [], "removed": {"../mine": "0"}}"#).unwrap();
    let error = recover(&folder).unwrap_err();
    assert!(format!("{error:#}").contains("expected files inside the folder"), "{error:#}");
    fs::remove_dir_all(folder).unwrap();
}
