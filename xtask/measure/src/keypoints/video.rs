//! The recordings of video next to the workspace.

use super::made::tracked;
use super::{JOINTS, moment, outcome};
use ambulo::findings::Findings;
use ambulo::job::Job;
use ambulo::model::Side;
use ambulo::motion::MarkerRecording;
use ambulo::spatial::Vec3;
use ambulo::study::validation::TextTable as Table;
use ambulo::study::{GroundSettings, Outcome, Recording, StatedSize};
use cpu_time::ThreadTime;
use std::fs;
use std::path::Path;

const FOLDER: &str = "markerless-pose2sim";
const MASS_KG: f64 = 70.0;

/// One row for each file.
pub(super) fn table(data: &Path, only: &str) -> Result<String, String> {
    let folder = data.join(FOLDER);
    let Ok(read) = fs::read_dir(&folder) else { return Ok(format!("skipped: no {FOLDER}")) };
    let mut files: Vec<_> = read.filter_map(|entry| Some(entry.ok()?.path())).collect();
    files.retain(|file| file.extension().is_some_and(|e| e == "trc"));
    files.sort();
    let mut table = Table::new(&[
        "recording",
        "trunk off [deg]",
        "residual rms [BW]",
        "hip peak [N.m/kg]",
        "knee",
        "ankle",
        "quality",
        "CPU s",
    ]);
    for file in files {
        let name = file.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
        if !name.contains(only) {
            continue;
        }
        let bytes = fs::read(&file).map_err(|e| format!("{}: {e}", file.display()))?;
        table.row(row(&name, &bytes).unwrap_or_else(|reason| {
            [
                name.clone(),
                reason,
                String::new(),
                String::new(),
                String::new(),
                String::new(),
                String::new(),
                String::new(),
            ]
        }));
    }
    Ok(table.text())
}

fn row(name: &str, bytes: &[u8]) -> Result<[String; 8], String> {
    let mut files = |_: &Path| Ok(bytes.to_vec());
    let job = Job { size: StatedSize { mass_kg: Some(MASS_KG), height_m: None }, ..Job::of(name) };
    let source = job.read(&mut files, &mut Findings::default()).map_err(|error| error.text())?.source;
    let Recording::Markers(markers) = &source.recording else { return Err(format!("{name}: no markers")) };
    let world = markers.trial.recording.in_world(&mut Findings::default()).1.markers;
    let began = ThreadTime::now();
    let found = outcome(source, GroundSettings::MeasuredOrPredicted)?;
    let seconds = began.elapsed().as_secs_f64();
    let peak = |joint: &str| {
        let largest = Side::BOTH
            .into_iter()
            .map(|side| Ok(moment(&found, joint, side)?.into_iter().fold(0.0, |most: f64, x| most.max(x.abs()))));
        largest.collect::<Result<Vec<f64>, String>>().map(|list| format!("{:.2} {:.2}", list[0], list[1]))
    };
    let [hip, knee, ankle] = JOINTS.map(peak);
    let residual = found.verdict.fit.residual_force_bw.map_or("-".to_owned(), |x| format!("{x:.3}"));
    let reasons: Vec<&str> = found.quality.reasons.iter().map(|r| r.measure.name()).collect();
    let quality = format!("{} ({})", found.quality.state.word(), reasons.join(", "));
    let off = trunk_off_deg(&found, &world)?;
    let off = format!("{:.1} to {:.1}", off[0], off[1]);
    Ok([name.to_owned(), off, residual, hip?, knee?, ankle?, quality, format!("{seconds:.3}")])
}

/// Angle between the trunk of the body and the line from hips to shoulders: median and largest [deg].
fn trunk_off_deg(outcome: &Outcome, world: &MarkerRecording) -> Result<[f64; 2], String> {
    tracked(outcome)?;
    let model = &outcome.body;
    let torso = model.body("torso").ok_or("no torso")?;
    let middle = |names: [&str; 2], frame: usize| {
        let at = |name: &str| world.marker(name).map(|path| path.positions[frame]);
        Some((at(names[0])? + at(names[1])?) * 0.5)
    };
    let mut angles = Vec::new();
    let trajectory = &outcome.analysis.trajectory;
    let mut ups: Vec<Vec3> = Vec::new();
    trajectory.for_each_posture(|_, posture| {
        ups.push(ambulo::kinematics::body_motion(model, posture)[torso.index()].pose.rotation.column(1).into());
    });
    for (frame, up) in ups.iter().enumerate() {
        let time = trajectory.grid().time(frame);
        let there = world.times.partition_point(|t| *t < time - 1e-6).min(world.frames() - 1);
        let line = middle(["LShoulder", "RShoulder"], there).zip(middle(["LHip", "RHip"], there));
        let Some(line) = line.map(|(top, bottom)| top - bottom).filter(|line| line.norm() > 0.0) else { continue };
        angles.push(up.angle(&line).to_degrees());
    }
    angles.sort_by(f64::total_cmp);
    let last = angles.last().copied().ok_or("no hips and shoulders")?;
    Ok([angles[angles.len() / 2], last])
}
