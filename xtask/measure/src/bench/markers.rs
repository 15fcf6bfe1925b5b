//! Marker fitting, timed and compared: `cargo xtask bench-markers [--write]`.
//!
//! Two recordings of the data folder are fitted, all common markers at weight 1. Ours is CPU time of the thread for the
//! whole fit, divided by the frames; OpenSim's is CPU time of its process for `InverseKinematicsTool::run` over the
//! same frames, as `ik_opensim.py` of the peers' scripts prints it, right after ours. Where `AMBULO_PEERS_ENV` names no
//! folder with an `opensim` environment, only ours is printed. The same recordings are then damaged at random, with a
//! seed: labels exchanged, markers lost and displaced for a while. With `--write` the table is written to
//! docs/measured/BENCHMARKS_MARKERS.md.

use super::machine;
use super::timing::{Timing, cpu_us};
use crate::workspace;
use ambulo::findings::Findings;
use ambulo::kinematics::marker_fit::{FitSettings, MarkerFit, fit_markers};
use ambulo::model::Model;
use ambulo::motion::{MarkerRecording, markers_from_trc};
use ambulo::numerics::Random;
use ambulo::spatial::Vec3;
use ambulo_formats::trc::Trc;
use std::fmt::Write as _;
use std::fs;
use std::hint::black_box;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Folder of the peers' environments.
const ENV_VARIABLE: &str = "AMBULO_PEERS_ENV";

/// A recording with OpenSim's result and our limits.
struct Case {
    name: &'static str,
    folder: &'static str,
    model: &'static str,
    markers: &'static str,
    /// OpenSim's mean over 0 to 2 s of the root mean square over markers [mm].
    opensim_mm: f64,
    /// Time for a frame at most [ms].
    required_ms: f64,
}

const CASES: [Case; 2] = [
    Case {
        name: "rajagopal-walk, 41 markers, 33 coordinates",
        folder: "opensim-rajagopal-walk",
        model: "subject_walk_scaled.osim",
        markers: "markers_walk.trc",
        opensim_mm: 13.03,
        required_ms: 0.2,
    },
    Case {
        name: "gait2392, 31 markers, 23 coordinates",
        folder: "opensim-gait2392-subject01",
        model: "subject01_simbody.osim",
        markers: "subject01_walk1.trc",
        opensim_mm: 19.11,
        required_ms: 0.05,
    },
];
/// Distances may exceed OpenSim's by this [mm].
const ALLOWED_MM: f64 = 0.1;
/// The stored runs of OpenSim end here [s].
const JUDGED_UNTIL_S: f64 = 2.0;

/// Faults of a damaged recording: exchanges of two labels, markers that are lost, markers that are displaced.
const DAMAGE: [[usize; 3]; 2] = [[5, 10, 3], [30, 40, 20]];
/// Time for a frame of a damaged recording at most [ms].
const REQUIRED_DAMAGED_MS: f64 = 0.3;
/// An exchange or a gap lasts at most this share of the recording.
const LONGEST_FAULT: f64 = 0.25;
/// Furthest displacement along each axis [m].
const DISPLACED: f64 = 0.4;
const SEED: u64 = 7;

/// Fits, times and prints. An error means a wrong fit or a broken file, never a long time.
#[expect(clippy::print_stdout, reason = "the table is the command's result")]
pub(crate) fn run(words: &[String]) -> Result<(), String> {
    let write = match words {
        [word, only @ ..] if word == "--recordings" && only.len() < 2 => {
            return super::fit_methods::run(only.first().map_or("", String::as_str));
        }
        [] => false,
        [word] if word == "--write" => true,
        _ => return Err(format!("unknown option `{}`, expected --write or --recordings", words.join(" "))),
    };
    let mut page =
        format!("# Marker fitting, timed\n\nOpenSim ran in the same run, right after ours.\n\n{}\n\n", machine());
    page.push_str(
        "| recording | mean marker RMS | OpenSim's | ours, CPU per frame | required | OpenSim, CPU per frame \
        | ratio |\n|---|---|---|---|---|---|---|\n",
    );
    let mut damaged = String::new();
    let mut rows = 0;
    for case in &CASES {
        let folder = workspace::data().join("data").join(case.folder);
        if !folder.is_dir() {
            println!("{}: skipped: no data", case.name);
            continue;
        }
        page.push_str(&row(case, &folder)?);
        damaged.push_str(&damaged_rows(case, &folder)?);
        rows += 1;
    }
    page.push_str(
        "\n## Damaged recordings\n\nLabels are exchanged and markers lost for up to a quarter of the \
        recording, and displaced by up to 0.4 m along each axis, at random.\n\n",
    );
    page.push_str(
        "| recording | exchanges, gaps, displacements | ours, CPU per frame | required |\n|---|---|---|---|\n",
    );
    page.push_str(&damaged);
    print!("{page}");
    if write && rows == CASES.len() {
        let path = workspace::root().join("docs/measured/BENCHMARKS_MARKERS.md");
        fs::write(&path, page).map_err(|e| format!("{}: cannot write: {e}", path.display()))?;
        println!("written: {}", path.display());
    }
    Ok(())
}

/// Model and markers of the first recording; `None` without data.
pub(crate) fn walk() -> Result<Option<(Model, MarkerRecording)>, String> {
    let [case, _] = &CASES;
    let folder = workspace::data().join("data").join(case.folder);
    folder.is_dir().then(|| read(case, &folder)).transpose()
}

fn row(case: &Case, folder: &Path) -> Result<String, String> {
    let (model, markers) = read(case, folder)?;
    let fit = || fit_markers(&model, &markers, &FitSettings::default(), &mut Findings::default());
    let first = fit().map_err(|e| e.to_string())?;
    let mean_mm = judge(case, &first)?;
    let frames = markers.times.len();
    let ours = cpu_us(frames, || {
        black_box(fit().is_ok());
    });
    let theirs = opensim(case, folder);
    Ok(line(case, mean_mm, ours, theirs.as_ref()))
}

/// Times of fits to damaged recordings. Their distances are not judged: some faults are as large as the body.
fn damaged_rows(case: &Case, folder: &Path) -> Result<String, String> {
    let (model, clean) = read(case, folder)?;
    let mut text = String::new();
    for damage in DAMAGE {
        let markers = damaged(&clean, damage);
        let fit = || fit_markers(&model, &markers, &FitSettings::default(), &mut Findings::default());
        fit().map_err(|e| e.to_string())?;
        let ms = cpu_us(markers.times.len(), || {
            black_box(fit().is_ok());
        });
        let ms = ms.median / 1000.0;
        let met = if ms <= REQUIRED_DAMAGED_MS { "met" } else { "missed" };
        let [exchanges, gaps, displacements] = damage;
        let _ = writeln!(
            text,
            "| {} | {exchanges}, {gaps}, {displacements} | {ms:.3} ms | {REQUIRED_DAMAGED_MS} ms: {met} |",
            case.name
        );
    }
    Ok(text)
}

/// A recording with faults at random.
fn damaged(clean: &MarkerRecording, [exchanges, gaps, displacements]: [usize; 3]) -> MarkerRecording {
    let mut markers = clean.clone();
    let (mut random, frames, count) = (Random::seeded(SEED), clean.times.len(), clean.markers.len());
    let mut below = |n: usize| random.below(n);
    let longest = (LONGEST_FAULT * frames as f64) as usize;
    for _ in 0..exchanges {
        let (a, b, start, length) = (below(count), below(count), below(frames), below(longest));
        for frame in start..(start + length).min(frames) {
            let kept = markers.markers[a].positions[frame];
            markers.markers[a].positions[frame] = markers.markers[b].positions[frame];
            markers.markers[b].positions[frame] = kept;
        }
    }
    for _ in 0..gaps {
        let (marker, start, length) = (below(count), below(frames), below(longest));
        markers.markers[marker].positions[start..(start + length).min(frames)].fill(Vec3::repeat(f64::NAN));
    }
    for _ in 0..displacements {
        let (marker, start, length) = (below(count), below(frames), below(20));
        let move_by = Vec3::from([(); 3].map(|()| DISPLACED * (below(2001) as f64 / 1000.0 - 1.0)));
        markers.markers[marker].positions[start..(start + length).min(frames)].iter_mut().for_each(|p| *p += move_by);
    }
    markers
}

fn line(case: &Case, mean_mm: f64, ours: Timing, theirs: Result<&f64, &String>) -> String {
    let ours_ms = ours.median / 1000.0;
    let required = format!("{} ms: {}", case.required_ms, if ours_ms <= case.required_ms { "met" } else { "missed" });
    let (peer, ratio) = match theirs {
        Ok(ms) => (format!("{ms:.1} ms"), format!("{:.0}", ms / ours_ms)),
        Err(reason) => (format!("not run: {reason}"), "-".to_owned()),
    };
    let mut text = String::new();
    let _ = writeln!(
        text,
        "| {} | {mean_mm:.2} mm | {} mm | {ours_ms:.4} ms | {required} | {peer} | {ratio} |",
        case.name, case.opensim_mm
    );
    text
}

fn read(case: &Case, folder: &Path) -> Result<(Model, MarkerRecording), String> {
    let bytes = |name: &str| fs::read(folder.join(name)).map_err(|e| format!("{name}: cannot read: {e}"));
    let mut findings = Findings::default();
    let model = Model::from_osim(&bytes(case.model)?, &mut findings).map_err(|e| e.to_string())?;
    let (trc, _) = Trc::read(&bytes(case.markers)?).map_err(|e| e.to_string())?;
    let markers = markers_from_trc(&trc, &mut findings).map_err(|e| e.to_string())?;
    Ok((model, markers))
}

/// The mean distance [mm], which must be OpenSim's.
fn judge(case: &Case, fit: &MarkerFit) -> Result<f64, String> {
    let judged: Vec<f64> =
        fit.motion.times.iter().zip(&fit.rms_m).filter(|(t, _)| **t <= JUDGED_UNTIL_S).map(|(_, r)| *r).collect();
    let mean_mm = 1000.0 * judged.iter().sum::<f64>() / judged.len() as f64;
    let allowed = case.opensim_mm + ALLOWED_MM;
    if mean_mm <= allowed {
        return Ok(mean_mm);
    }
    Err(format!("{}: mean marker RMS {mean_mm:.3} mm, allowed {allowed} mm", case.name))
}

/// OpenSim's CPU time for a frame [ms], or why there is none.
fn opensim(case: &Case, folder: &Path) -> Result<f64, String> {
    let env = std::env::var_os(ENV_VARIABLE).map(PathBuf::from).ok_or(format!("{ENV_VARIABLE} is not set"))?;
    let python = env.join("opensim/bin/python");
    let script = workspace::data().join("reference/peers/ik_opensim.py");
    if !python.is_file() || !script.is_file() {
        return Err("no opensim environment or no script".to_owned());
    }
    let results = workspace::root().join("target/peers/opensim");
    fs::create_dir_all(&results).map_err(|e| e.to_string())?;
    let full = |path: PathBuf| path.canonicalize().map_err(|e| format!("{}: {e}", path.display()));
    let mut command = Command::new(&python);
    command.arg(full(script)?).arg(full(folder.join(case.model))?).arg(full(folder.join(case.markers))?);
    let done = command.arg("fit.mot").current_dir(&results).output().map_err(|e| e.to_string())?;
    let printed = String::from_utf8_lossy(&done.stdout).into_owned();
    cpu_ms(&printed).ok_or_else(|| "it printed no time".to_owned())
}

/// The number before `ms CPU per frame`.
fn cpu_ms(printed: &str) -> Option<f64> {
    let line = printed.lines().find(|line| line.ends_with("ms CPU per frame"))?;
    line.split(", ").nth(1)?.split_whitespace().next()?.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_time_is_read_from_what_the_script_prints() {
        assert_eq!(cpu_ms("[info] x\n238 frames, 54.1 ms CPU per frame\n"), Some(54.1));
        assert_eq!(cpu_ms("no frames"), None);
    }

    #[test]
    fn a_missing_peer_leaves_no_ratio() {
        let text = line(&CASES[0], 13.0, Timing::single(40.0), Err(&"absent".to_owned()));
        assert!(text.contains("0.0400 ms") && text.contains("met") && text.contains("not run: absent"), "{text}");
    }
}
