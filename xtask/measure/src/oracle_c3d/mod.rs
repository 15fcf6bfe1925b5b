//! Compares our C3D reader with ezc3d, file by file: `cargo xtask oracle-c3d [FOLDER] [--env DIR]`.
//!
//! Reads every C3D file below the folder (without one: the recordings) with both and prints the largest differences of
//! coordinates, samples and plate forces. ezc3d is a Python package; it does not read SGI files. Fails if numbers of
//! points, frames or channels differ, if a number in both differs, or if we reject a file that ezc3d reads.

mod plates;

use crate::workspace;
use ambulo_formats::c3d::C3d;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::{fs, iter};

/// Folder of the peers' virtual environments, when `--env` is not given.
const ENV_VARIABLE: &str = "AMBULO_PEERS_ENV";
/// The Python script, relative to the workspace root.
const SCRIPT: &str = "xtask/measure/peers/c3d_ezc3d.py";
/// Allowed difference relative to the largest number in the same row: ezc3d multiplies some numbers as 32-bit reals.
const TOLERANCE: f64 = 1e-6;

/// Where the files and ezc3d are.
#[derive(Debug, Clone, PartialEq)]
struct Settings {
    folder: PathBuf,
    env: Option<PathBuf>,
}

/// What ezc3d reads from one file.
#[derive(Debug, PartialEq)]
enum Oracle {
    Refused(String),
    /// Blocks of numbers, row by row, with the length of a row.
    Read(BTreeMap<String, (usize, Vec<f64>)>),
}

/// Two rows of numbers compared.
#[derive(Debug, Default, Clone, Copy, PartialEq)]
struct Comparison {
    /// Largest difference of numbers in both rows.
    difference: f64,
    /// Largest number in either row.
    largest: f64,
    /// Count of numbers in only one of the rows.
    one_sided: usize,
}

/// Runs the command.
#[expect(clippy::print_stdout, reason = "the table is the command's result")]
pub(crate) fn run(args: &[String]) -> Result<(), String> {
    let settings = parse(args)?;
    let mut files = Vec::new();
    c3d_files(&settings.folder, &mut files)?;
    if files.is_empty() {
        return Err(format!("{}: no C3D file in it or below", settings.folder.display()));
    }
    let (version, oracles) = ask(&settings, &files)?;
    println!("ambulo-formats compared with ezc3d {version}: largest differences\n");
    println!(
        "{:<28} {:>6} {:>7} {:>8} {:>12} {:>12} {:>10} {:>10}  notes",
        "file", "points", "frames", "channels", "positions", "samples", "force [N]", "CoP [mm]"
    );
    let mut wrong = 0;
    for (path, oracle) in files.iter().zip(&oracles) {
        let (row, fine) = compare_file(path, oracle)?;
        println!("{row}");
        wrong += usize::from(!fine);
    }
    if wrong == 0 { Ok(()) } else { Err(format!("{wrong} of {} files differ, see the table", files.len())) }
}

fn parse(args: &[String]) -> Result<Settings, String> {
    let mut settings =
        Settings { folder: workspace::data().join("data"), env: std::env::var_os(ENV_VARIABLE).map(PathBuf::from) };
    let mut args = args.iter();
    while let Some(word) = args.next() {
        match word.as_str() {
            "--env" => settings.env = Some(args.next().ok_or("--env needs a folder")?.into()),
            option if option.starts_with('-') => return Err(format!("unknown option `{option}`, expected --env DIR")),
            folder => settings.folder = folder.into(),
        }
    }
    Ok(settings)
}

/// All C3D files in a folder and below, by name.
fn c3d_files(folder: &Path, files: &mut Vec<PathBuf>) -> Result<(), String> {
    let entries = fs::read_dir(folder).map_err(|e| format!("{}: cannot read: {e}", folder.display()))?;
    let mut paths: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).collect();
    paths.sort();
    for path in paths {
        if path.is_dir() {
            c3d_files(&path, files)?;
        } else if path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("c3d")) {
            files.push(path);
        }
    }
    Ok(())
}

/// Version of ezc3d, and what it reads from each file.
fn ask(settings: &Settings, files: &[PathBuf]) -> Result<(String, Vec<Oracle>), String> {
    let install = "python3 -m venv DIR/ezc3d && DIR/ezc3d/bin/pip install ezc3d numpy";
    let env = settings.env.as_ref().ok_or_else(|| format!("{install}, then pass --env DIR or set {ENV_VARIABLE}"))?;
    let python = env.join("ezc3d/bin/python");
    if !python.is_file() {
        return Err(format!("{}: not there; {install}", python.display()));
    }
    let output = workspace::root().join("target/oracle-c3d");
    fs::create_dir_all(&output).map_err(|e| format!("{}: cannot create: {e}", output.display()))?;
    let mut command = Command::new(python);
    command.arg(workspace::root().join(SCRIPT)).arg(&output).args(files);
    let done = command.output().map_err(|e| format!("python: cannot start: {e}"))?;
    if !done.status.success() {
        return Err(format!("{SCRIPT}: {}: {}", done.status, String::from_utf8_lossy(&done.stderr)));
    }
    let version = String::from_utf8_lossy(&done.stdout).trim().to_owned();
    let oracles = (0..files.len()).map(|number| {
        let path = output.join(format!("{number}.blocks"));
        let bytes = fs::read(&path).map_err(|e| format!("{}: cannot read: {e}", path.display()))?;
        oracle(&bytes).ok_or_else(|| format!("{}: not in the form that {SCRIPT} writes", path.display()))
    });
    Ok((version, oracles.collect::<Result<_, String>>()?))
}

/// The file that the script writes: lines `name rows columns`, each followed by so many doubles.
fn oracle(mut bytes: &[u8]) -> Option<Oracle> {
    let mut blocks = BTreeMap::new();
    while !bytes.is_empty() {
        let end = bytes.iter().position(|&byte| byte == b'\n')?;
        let line = std::str::from_utf8(&bytes[..end]).ok()?;
        if let Some(reason) = line.strip_prefix("refused ") {
            return Some(Oracle::Refused(reason.to_owned()));
        }
        let mut words = line.split(' ');
        let name = words.next()?;
        let rows: usize = words.next()?.parse().ok()?;
        let columns: usize = words.next()?.parse().ok()?;
        let size = rows.checked_mul(columns)?.checked_mul(8)?;
        let numbers = bytes.get(end + 1..)?.get(..size)?;
        blocks
            .insert(name.to_owned(), (columns, numbers.as_chunks().0.iter().map(|&b| f64::from_le_bytes(b)).collect()));
        bytes = &bytes[end + 1 + size..];
    }
    Some(Oracle::Read(blocks))
}

/// A row of the table, and whether the two readers agree.
fn compare_file(path: &Path, oracle: &Oracle) -> Result<(String, bool), String> {
    let bytes = fs::read(path).map_err(|e| format!("{}: cannot read: {e}", path.display()))?;
    let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    Ok(match (C3d::read(&bytes), oracle) {
        (Err(_), Oracle::Refused(_)) => (format!("{name:<28} refused by both"), true),
        (Err(error), Oracle::Read(_)) => (format!("{name:<28} refused by us alone: {error}"), false),
        (Ok((record, _)), Oracle::Refused(reason)) => {
            let short: String = reason.chars().take(40).collect();
            (format!("{} refused by ezc3d: {short}", counts(&name, &record)), true)
        }
        (Ok((record, _)), Oracle::Read(blocks)) => compare(&name, &record, blocks),
    })
}

fn counts(name: &str, record: &C3d) -> String {
    format!("{name:<28} {:>6} {:>7} {:>8}", record.points.len(), record.frames(), record.channels.len())
}

fn compare(name: &str, record: &C3d, blocks: &BTreeMap<String, (usize, Vec<f64>)>) -> (String, bool) {
    let points: Vec<&[f64]> = record.points.iter().map(|point| point.positions.as_flattened()).collect();
    let channels: Vec<&[f64]> = record.channels.iter().map(|channel| channel.samples.as_slice()).collect();
    let mut row = counts(name, record);
    let mut fine = true;
    let mut notes = String::new();
    for (block, ours) in [("points", points), ("channels", channels)] {
        match compare_rows(&ours, blocks.get(block)) {
            Ok(found) => {
                let _ = write!(row, " {:>12.2e}", found.difference);
                fine &= found.difference <= TOLERANCE * found.largest;
                if found.one_sided > 0 {
                    let _ = write!(notes, "{} numbers of {block} in one alone; ", found.one_sided);
                }
            }
            Err(reason) => {
                let _ = write!(row, " {:>12}", "-");
                let _ = write!(notes, "{block}: {reason}; ");
                fine = false;
            }
        }
    }
    match plates::compare(record, blocks) {
        Ok(None) => {
            let _ = write!(row, " {:>10} {:>10}", "-", "-");
        }
        Ok(Some(found)) => {
            let _ = write!(row, " {:>10.3} {:>10.3}", found.force_n, 1000.0 * found.center_m);
            notes.push_str(&found.note);
            fine &= found.is_fine();
        }
        Err(reason) => {
            let _ = write!(row, " {:>10} {:>10}", "-", "-");
            let _ = write!(notes, "plates: {reason}");
            fine = false;
        }
    }
    (format!("{row}  {}", notes.trim_end_matches("; ")), fine)
}

/// Compares rows with rows. The error describes how their shapes differ.
fn compare_rows(ours: &[&[f64]], theirs: Option<&(usize, Vec<f64>)>) -> Result<Comparison, String> {
    let (columns, numbers) = theirs.ok_or("not in ezc3d's blocks")?;
    let length = ours.first().map_or(0, |row| row.len());
    if ours.len() * length != numbers.len() || (length != *columns && !ours.is_empty()) {
        return Err(format!("{} rows of {length}, ezc3d {} numbers in rows of {columns}", ours.len(), numbers.len()));
    }
    let mut found = Comparison::default();
    for (a, b) in iter::zip(ours.iter().copied().flatten(), numbers) {
        if a.is_nan() && b.is_nan() {
            continue;
        }
        if a.is_nan() || b.is_nan() {
            found.one_sided += 1;
            continue;
        }
        found.difference = found.difference.max((a - b).abs());
        found.largest = found.largest.max(a.abs());
    }
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bytes(blocks: &[(&str, usize, usize, &[f64])]) -> Vec<u8> {
        let mut bytes = Vec::new();
        for (name, rows, columns, numbers) in blocks {
            bytes.extend(format!("{name} {rows} {columns}\n").bytes());
            bytes.extend(numbers.iter().flat_map(|number| number.to_le_bytes()));
        }
        bytes
    }

    fn record() -> C3d {
        let mut record = C3d::new(100.0, "mm");
        record.points = vec![ambulo_formats::c3d::Point::new("HEEL", vec![[1.0, 2.0, 3.0], [f64::NAN; 3]])];
        record
    }

    #[test]
    fn blocks_are_read_and_damage_is_seen() {
        let written = bytes(&[("points", 1, 2, &[1.0, 2.0]), ("channels", 0, 5, &[])]);
        let Some(Oracle::Read(blocks)) = oracle(&written) else { panic!("not read") };
        assert_eq!(blocks["points"], (2, vec![1.0, 2.0]));
        assert_eq!(blocks["channels"], (5, vec![]));
        assert_eq!(oracle(&written[..20]), None);
        assert_eq!(oracle(b"refused no such file\n"), Some(Oracle::Refused("no such file".into())));
    }

    #[test]
    fn agreement_and_difference_are_told_apart() {
        let blocks = |z: f64, last: f64| {
            let numbers = [1.0, 2.0, z, f64::NAN, f64::NAN, last];
            match oracle(&bytes(&[("points", 1, 6, &numbers), ("channels", 0, 2, &[])])) {
                Some(Oracle::Read(blocks)) => blocks,
                other => panic!("{other:?}"),
            }
        };
        assert!(compare("a", &record(), &blocks(3.0, f64::NAN)).1);
        let (row, fine) = compare("a", &record(), &blocks(3.5, f64::NAN));
        assert!(!fine && row.contains("5.00e-1"), "{row}");
        let (row, fine) = compare("a", &record(), &blocks(3.0, 4.0));
        assert!(fine && row.ends_with("1 numbers of points in one alone"), "{row}");
        let (row, fine) = compare("a", &record(), &BTreeMap::new());
        assert!(!fine && row.contains("points: not in ezc3d's blocks"), "{row}");
    }

    #[test]
    fn arguments_are_a_folder_and_an_environment() {
        let args = |words: &[&str]| words.iter().map(|&w| w.to_owned()).collect::<Vec<_>>();
        let settings = parse(&args(&["here", "--env", "there"])).unwrap();
        assert_eq!(settings, Settings { folder: "here".into(), env: Some("there".into()) });
        assert_eq!(parse(&args(&["--fast"])).unwrap_err(), "unknown option `--fast`, expected --env DIR");
    }
}
