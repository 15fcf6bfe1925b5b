//! Times the analysis of a real recording: its stages in this process, and the whole `ambulo` command.

use super::Row;
use super::timing::{JobTiming, Timing, job_us};
use crate::workspace::{self, Walk};
use ambulo::findings::Findings;
use ambulo::model::from_osim;
use ambulo::motion::{coordinates_from_table, force_recordings};
use ambulo::study::{self, ForceFilter, MeasuredForces, Outcome, Settings, Source};
use ambulo_formats::external_loads::ExternalLoads;
use ambulo_formats::osim::OsimModel;
use ambulo_formats::table::Table;
use ambulo_report::figure_files;
use ambulo_results::{Keep, output_files};
use std::fs;
use std::hint::black_box;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::Instant;

/// Runs of the command; one more runs first, unmeasured.
const RUNS: usize = 20;
/// Exit codes of the command from here on mean that it could not run.
const COULD_NOT_RUN: i32 = 2;

/// Contents of the recording's files; reading them from disk belongs to the command's time, not to a stage's.
struct Files {
    model: Vec<u8>,
    motion: Vec<u8>,
    forces: Vec<u8>,
    loads: Vec<u8>,
}

/// What one run of the command costs.
pub(super) struct Program {
    pub(super) wall_ms: Timing,
    /// Largest resident memory seen; only where Linux's `/proc` tells.
    pub(super) peak_mb: Option<f64>,
}

/// CPU time of each stage and of all of them, in milliseconds.
pub(super) fn stages(walk: &Walk) -> Result<Vec<Row>, String> {
    let read = |path: &Path| fs::read(path).map_err(|e| format!("{}: cannot read: {e}", path.display()));
    let files = Files {
        model: read(&walk.model)?,
        motion: read(&walk.motion)?,
        forces: read(&walk.forces)?,
        loads: read(&walk.loads)?,
    };
    let job = |stage: &mut dyn FnMut(&'static str)| main_job(&files, stage).map_err(|e| e.to_string());
    let JobTiming { stages, whole } = job_us(job)?;
    let row = |name: &str, us: Timing| Row { quantity: name.replace('_', " "), unit: "ms", timing: milli(us) };
    let mut rows: Vec<Row> = stages.into_iter().map(|(name, timing)| row(name, timing)).collect();
    rows.push(row("whole job, bytes to bytes", whole));
    Ok(rows)
}

/// What `ambulo forces` does between reading its files and writing others.
fn main_job(files: &Files, stage: &mut dyn FnMut(&'static str)) -> Result<(), Box<dyn std::error::Error>> {
    let mut findings = Findings::default();
    let model = from_osim(&OsimModel::read(&files.model)?, &mut findings)?;
    stage("read model");
    let (table, _) = Table::read_storage(&files.motion)?;
    let motion = coordinates_from_table(&model, &table, "walk", &mut findings)?;
    stage("read motion");
    let (table, _) = Table::read_storage(&files.forces)?;
    let (loads, _) = ExternalLoads::read(&files.loads)?;
    let plates = force_recordings(&model, &loads, &table, &mut findings)?;
    stage("read forces");
    let source = Source::coordinates(model, motion).with_forces(MeasuredForces::OnBodies(plates));
    let mut watch = |done: study::Stage| {
        stage(done.word());
        ControlFlow::Continue(())
    };
    // As OpenSim's inverse dynamics tool treats this recording: forces are not filtered.
    let settings = Settings { force_filter: ForceFilter::Off, ..Settings::default() };
    let outcome = study::run_observed(source, &settings, &mut findings, &mut watch)?;
    let Outcome { body, analysis, .. } = &outcome;
    black_box((output_files(body, analysis, None, &Keep::all())?, figure_files(body, analysis, &[], None)?));
    stage("files' content");
    Ok(())
}

fn milli(timing: Timing) -> Timing {
    let milli = |us: f64| us * 1e-3;
    Timing { median: milli(timing.median), spread: timing.spread.map(|spread| spread.map(milli)) }
}

/// Wall time of `ambulo forces`, with reading and writing its files, each run into a new folder.
pub(super) fn program(walk: &Walk) -> Result<Program, String> {
    let program = workspace::build_program()?;
    let folder = std::env::temp_dir().join(format!("ambulo-bench-{}", std::process::id()));
    let measured = measure(walk, &program, &folder);
    // A temporary folder that cannot be removed does no harm.
    let _ = fs::remove_dir_all(&folder);
    measured
}

fn measure(walk: &Walk, program: &Path, folder: &Path) -> Result<Program, String> {
    let run = |name: String| start(walk.command(program, &new_folder(folder, &name)?));
    let peak_mb = watch_memory(run("memory".to_owned())?)?;
    if !folder.join("memory/moments.sto").is_file() {
        return Err(format!("{} wrote no moments.sto", program.display()));
    }
    let mut wall_ms = Vec::new();
    for i in 0..RUNS {
        let start = Instant::now();
        finish(run(i.to_string())?)?;
        wall_ms.push(start.elapsed().as_secs_f64() * 1e3);
    }
    Ok(Program { wall_ms: Timing::of(wall_ms), peak_mb })
}

fn new_folder(folder: &Path, name: &str) -> Result<PathBuf, String> {
    let folder = folder.join(name);
    fs::create_dir_all(&folder).map_err(|e| format!("{}: cannot create: {e}", folder.display()))?;
    Ok(folder)
}

fn start(mut command: Command) -> Result<Child, String> {
    command.stdout(Stdio::null()).stderr(Stdio::piped());
    command.spawn().map_err(|e| format!("cannot start: {e}"))
}

fn finish(child: Child) -> Result<(), String> {
    let done = child.wait_with_output().map_err(|e| format!("cannot wait for it: {e}"))?;
    match done.status.code() {
        Some(code) if code < COULD_NOT_RUN => Ok(()),
        _ => {
            let stderr = String::from_utf8_lossy(&done.stderr);
            Err(format!("{}: {}", done.status, stderr.lines().next().unwrap_or("no message")))
        }
    }
}

/// Largest resident memory [MB] that was seen while the process ran. It is read all the time; what a process takes in
/// its last tens of microseconds is missed.
pub(super) fn watch_memory(child: Child) -> Result<Option<f64>, String> {
    let status = format!("/proc/{}/status", child.id());
    let mut peak_kb: Option<f64> = None;
    while let Some(kb) = fs::read_to_string(&status).ok().as_deref().and_then(high_water_kb) {
        peak_kb = Some(kb);
    }
    finish(child)?;
    Ok(peak_kb.map(|kb| kb / 1024.0))
}

/// Linux's high-water mark of resident memory [kB]; a process that has ended has none.
fn high_water_kb(status: &str) -> Option<f64> {
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    line.trim().strip_suffix("kB")?.trim().parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_high_water_mark_is_read_from_the_status_and_absent_for_ended_processes() {
        assert_eq!(high_water_kb("Name:\tambulo\nVmHWM:\t   20480 kB\n"), Some(20480.0));
        assert_eq!(high_water_kb("Name:\tambulo\nState:\tZ (zombie)\n"), None);
    }
}
