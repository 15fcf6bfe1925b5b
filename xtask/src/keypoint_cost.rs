//! What keypoints of video cost per frame: `cargo xtask keypoint-cost [PROGRAM]`.
//!
//! A recording of Pose2Sim (`markerless-pose2sim` of the data folder: 21 points at 60 Hz) runs forwards and backwards
//! until it is long enough. Time and memory per frame are differences between two lengths, so that what a run takes
//! anyway does not count; an hour at 50 Hz is computed as a whole.

use crate::batch_cost::{Cost, run_to_end};
use crate::sweep::optimised_program;
use crate::workspace;
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

const RECORDING: &str = "data/markerless-pose2sim/S00_P00_T01_BalancingTrial_0-100.trc";
/// Lines before the first frame of a TRC file.
const HEADER: usize = 5;
/// The two lengths, and an hour at 50 Hz [frames].
const LENGTHS: [usize; 2] = [3_000, 12_000];
const HOUR: usize = 180_000;
/// Allowed: milliseconds and kilobytes per frame, megabytes of an hour.
const REQUIRED: [f64; 3] = [0.3, 4.0, 1000.0];

/// Measures and prints.
#[expect(clippy::print_stdout, reason = "the figures are the command's result")]
pub(crate) fn run(options: &[String]) -> Result<(), String> {
    let program = match options {
        [] => optimised_program()?,
        [program] => PathBuf::from(program),
        _ => return Err("usage: cargo xtask keypoint-cost [PROGRAM]".to_owned()),
    };
    let folder = workspace::target().join("keypoint-cost");
    fs::create_dir_all(&folder).map_err(|e| format!("{}: cannot be created: {e}", folder.display()))?;
    let source = workspace::data().join(RECORDING);
    let text = fs::read_to_string(&source).map_err(|e| format!("{}: cannot be read: {e}", source.display()))?;
    let cost = |frames: usize| cost(&program, &folder, &prolonged(&text, frames)?);
    let [short, long] = [cost(LENGTHS[0])?, cost(LENGTHS[1])?];
    let frames = (LENGTHS[1] - LENGTHS[0]) as f64;
    let [asked_ms, asked_kb, asked_mb] = REQUIRED;
    let (ms, kb) =
        (1e3 * (long.processor_s - short.processor_s) / frames, 1024.0 * (long.peak_mb - short.peak_mb) / frames);
    println!("processor time  {ms:.3} ms per frame (asked {asked_ms})");
    println!(
        "memory          {kb:.2} kB per frame (asked {asked_kb}); {:.0} MB at {} frames",
        long.peak_mb, LENGTHS[1]
    );
    let hour = cost(HOUR)?;
    println!("an hour, 50 Hz  {:.1} s, {:.0} MB (asked {asked_mb:.0})", hour.processor_s, hour.peak_mb);
    fs::remove_dir_all(&folder).map_err(|e| format!("{}: cannot be removed: {e}", folder.display()))
}

fn cost(program: &Path, folder: &Path, recording: &str) -> Result<Cost, String> {
    let input = folder.join("long.trc");
    fs::write(&input, recording).map_err(|e| format!("{}: cannot be written: {e}", input.display()))?;
    let mut command = Command::new(program);
    command.arg("forces").arg(&input).args(["--mass", "70", "--height", "1.75", "--keep", "summary", "--force"]);
    command.arg("-o").arg(folder.join("results")).stdout(Stdio::null()).stderr(Stdio::null());
    run_to_end(command)
}

/// The recording with this many frames, forwards and backwards without repeating the ends.
fn prolonged(text: &str, frames: usize) -> Result<String, String> {
    let lines: Vec<&str> = text.lines().collect();
    let rows: Vec<&str> =
        lines.get(HEADER..).unwrap_or_default().iter().copied().filter(|row| !row.is_empty()).collect();
    let cells: Option<Vec<&str>> = lines.get(2).map(|line| line.split('\t').collect());
    let (Some(mut cells), [_, .., _]) = (cells.filter(|cells| cells.len() > 3), &rows[..]) else {
        return Err(format!("{RECORDING}: expected the header of a TRC file and two frames"));
    };
    let rate_hz: f64 = cells[0].trim().parse().map_err(|e| format!("{RECORDING}: DataRate: {e}"))?;
    let count = frames.to_string();
    cells[2] = &count;
    let mut long = [lines[0], lines[1], &cells.join("\t"), lines[3], lines[4]].join("\n");
    let last = rows.len() - 1;
    for frame in 0..frames {
        let place = frame % (2 * last);
        let row = rows[place.min(2 * last - place)];
        let positions = row.splitn(3, '\t').nth(2).unwrap_or_default();
        let _ = write!(long, "\n{}\t{:.6}\t{positions}", frame + 1, frame as f64 / rate_hz);
    }
    long.push('\n');
    Ok(long)
}
