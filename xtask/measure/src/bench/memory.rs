//! Memory of the `ambulo` command for long recordings: bytes per frame, from two lengths of the same recording, which
//! runs forwards and backwards until it is long enough.
//!
//! The page of a recording draws 4,000 instants at most, so that its share vanishes in longer recordings than these.

use super::timing::Timing;
use super::walk::watch_memory;
use super::{Row, verdict};
use crate::workspace;
use ambulo_formats::table::Table;
use ambulo_formats::trc::{Marker, Trc};
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// The two lengths [frames].
const LENGTHS: [usize; 2] = [3_000, 12_000];
/// kB per frame, at most: from coordinates with `--keep moments,grf`, and from markers with all outputs.
const REQUIRED: [f64; 2] = [2.0, 4.0];

/// A recording, the model for it, and which outputs are kept (all where empty).
struct Case {
    name: &'static str,
    recording: &'static str,
    model: &'static str,
    keep: &'static [&'static str],
    required: f64,
}

const GAIT2392: &str = "data/opensim-gait2392-subject01/subject01_simbody.osim";
const RAJAGOPAL: &str = "data/opensim-rajagopal-walk/subject_walk_scaled.osim";
const KEPT: &[&str] = &["--keep", "moments,grf"];

const CASES: [Case; 4] = [
    Case {
        name: "23 coordinates, Gait2392, --keep moments,grf",
        recording: "data/opensim-gait2392-subject01/subject01_walk1_ik.mot",
        model: GAIT2392,
        keep: KEPT,
        required: REQUIRED[0],
    },
    Case {
        name: "39 coordinates, Rajagopal, --keep moments,grf",
        recording: "data/opensim-rajagopal-walk/ik_uniform_weights.mot",
        model: RAJAGOPAL,
        keep: KEPT,
        required: REQUIRED[0],
    },
    Case {
        name: "41 markers, Gait2392, all outputs",
        recording: "data/opensim-gait2392-subject01/subject01_walk1.trc",
        model: GAIT2392,
        keep: &[],
        required: REQUIRED[1],
    },
    Case {
        name: "41 markers, Rajagopal, all outputs",
        recording: "data/opensim-rajagopal-walk/markers_walk.trc",
        model: RAJAGOPAL,
        keep: &[],
        required: REQUIRED[1],
    },
];

/// Memory per frame of each case; empty where memory cannot be read.
pub(super) fn bench() -> Result<Vec<Row>, String> {
    let program = workspace::build_program()?;
    let folder = std::env::temp_dir().join(format!("ambulo-bench-memory-{}", std::process::id()));
    fs::create_dir_all(&folder).map_err(|e| format!("{}: cannot create: {e}", folder.display()))?;
    let measured = CASES.iter().map(|case| measure(case, &program, &folder)).collect::<Result<Vec<_>, _>>();
    // A temporary folder that cannot be removed does no harm.
    let _ = fs::remove_dir_all(&folder);
    Ok(measured?.into_iter().flatten().collect())
}

/// The rows as text, with what is required.
pub(super) fn table(rows: &[Row]) -> String {
    let mut text = format!("memory per frame, between {} and {} frames\n", LENGTHS[0], LENGTHS[1]);
    for row in rows {
        let required = CASES.iter().find(|case| case.name == row.quantity).map_or(f64::NAN, |case| case.required);
        let kb = row.timing.median;
        let _ = writeln!(text, "{:<48} {kb:5.2} kB  required {required:.1}: {}", row.quantity, verdict(kb, required));
    }
    text
}

fn measure(case: &Case, program: &Path, folder: &Path) -> Result<Option<Row>, String> {
    let mut peaks_mb = [0.0; 2];
    for (peak, frames) in peaks_mb.iter_mut().zip(LENGTHS) {
        let input = prolonged(case.recording, frames, folder)?;
        let mut command = Command::new(program);
        command.arg("forces").arg(&input).arg("--model").arg(workspace::data().join(case.model)).args(case.keep);
        command.arg("--force").arg("-o").arg(folder.join("results"));
        command.stdout(Stdio::null()).stderr(Stdio::piped());
        let child = command.spawn().map_err(|e| format!("cannot start: {e}"))?;
        let Some(mb) = watch_memory(child)? else { return Ok(None) };
        *peak = mb;
    }
    let kb = (peaks_mb[1] - peaks_mb[0]) * 1024.0 / (LENGTHS[1] - LENGTHS[0]) as f64;
    Ok(Some(Row { quantity: case.name.to_owned(), unit: "kB/frame", timing: Timing::single(kb) }))
}

/// Writes a recording that has this number of frames into a folder.
fn prolonged(recording: &str, frames: usize, folder: &Path) -> Result<PathBuf, String> {
    let source = workspace::data().join(recording);
    let failed = |e: &dyn std::fmt::Display| format!("{}: {e}", source.display());
    let bytes = fs::read(&source).map_err(|e| failed(&e))?;
    let (name, long) = if recording.ends_with(".trc") {
        let (trc, _) = Trc::read(&bytes).map_err(|e| failed(&e))?;
        let of = |marker: &Marker| Marker {
            name: marker.name.clone(),
            positions_m: to_and_fro(&marker.positions_m, frames),
        };
        let markers = trc.markers().iter().map(of).collect();
        let mut long = Trc::new(trc.rate_hz, even_times(trc.times(), frames), markers).map_err(|e| failed(&e))?;
        long.unit = trc.unit;
        ("long.trc", long.write())
    } else {
        let (table, _) = Table::read_storage(&bytes).map_err(|e| failed(&e))?;
        let times = table.times().unwrap_or_default();
        let columns = table.columns().map(|(name, values)| {
            let values = if name == "time" { even_times(times, frames) } else { to_and_fro(values, frames) };
            (name.to_owned(), values)
        });
        let mut long = Table::new(table.name.clone(), columns.collect()).map_err(|e| failed(&e))?;
        long.in_degrees = table.in_degrees;
        ("long.mot", long.write_storage())
    };
    let path = folder.join(name);
    fs::write(&path, long).map_err(|e| format!("{}: cannot write: {e}", path.display()))?;
    Ok(path)
}

/// Values forwards and backwards, without repeating the ends.
fn to_and_fro<T: Copy>(values: &[T], frames: usize) -> Vec<T> {
    let last = values.len().saturating_sub(1).max(1);
    let place = |i: usize| if (i / last).is_multiple_of(2) { i % last } else { last - i % last };
    (0..frames).map(|i| values[place(i)]).collect()
}

/// Times with the first step of these.
fn even_times(times: &[f64], frames: usize) -> Vec<f64> {
    let (start, step) = (times[0], times[1] - times[0]);
    (0..frames).map(|i| start + i as f64 * step).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_prolonged_recording_turns_at_its_ends_without_a_jump() {
        assert_eq!(to_and_fro(&[0, 1, 2, 3], 9), [0, 1, 2, 3, 2, 1, 0, 1, 2]);
        assert_eq!(even_times(&[1.0, 1.5, 2.0], 4), [1.0, 1.5, 2.0, 2.5]);
    }
}
