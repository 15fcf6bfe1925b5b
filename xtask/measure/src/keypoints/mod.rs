//! Keypoints of video: what forces from them are worth. `cargo xtask keypoints [--only NAME] [--seed S]`.
//!
//! 1. The recordings of video next to the workspace, as they are.
//! 2. Keypoints made from recordings with markers and a standing trial: joint centres, shoulders, heel and toes of the
//!    body that follows the markers, with errors of known size, three times with other random numbers. Flexion moments
//!    of hip, knee and ankle are compared with those from the markers: root mean square of the difference over both
//!    sides [N.m/kg], with force plates for both (inside the instrumented window) and with predicted ground forces for
//!    both (all frames but those within 0.1 s of the ends).

mod made;
mod video;

use crate::validate::recording::{self, Group, Recording};
use crate::workspace;
use ambulo::findings::Findings;
use ambulo::job::Job;
use ambulo::model::Side;
use ambulo::motion::MarkerRecording;
use ambulo::study::validation::TextTable as Table;
use ambulo::study::{
    self, GroundSettings, MeasuredForces, Outcome, Recording as Recorded, Settings, Source, StatedSize, TrackedMarkers,
};
use ambulo_formats::trc::LengthUnit;
use ambulo_report::trc_of_markers;
use cpu_time::ThreadTime;
use made::{Errors, keypoints, tracked, with_errors};
use std::path::Path;

const ERRORS: [Errors; 4] = [made::NONE, made::WHITE, made::SLOW, made::ALL];
/// Coordinates of the built-in body, without the side.
const JOINTS: [&str; 3] = ["hip_flexion", "knee_angle", "ankle_angle"];
/// Frames this close to the ends of a motion are left out [s].
const END_S: f64 = 0.1;
const SEED: u64 = 20_261_126;
/// Each kind of errors is made this often.
const TIMES: u64 = 3;

/// Runs the command.
#[expect(clippy::print_stdout, reason = "the answer of the command")]
pub(crate) fn run(words: &[String]) -> Result<(), String> {
    let (mut only, mut seed) = ("", SEED);
    for pair in words.chunks(2) {
        match pair {
            [option, name] if option == "--only" => only = name,
            [option, number] if option == "--seed" => {
                seed = number.parse().map_err(|_| format!("--seed is `{number}`, expected a whole number"))?;
            }
            _ => return Err("expected `cargo xtask keypoints [--only NAME] [--seed S]`".to_owned()),
        }
    }
    let data = workspace::data().join("data");
    if !data.is_dir() {
        println!("skipped: no data");
        return Ok(());
    }
    println!("{}", video::table(&data, only)?);
    let mut table = Table::new(&[
        "recording",
        "errors",
        "hip, plates",
        "knee",
        "ankle",
        "hip, predicted",
        "knee",
        "ankle",
        "CPU s per 100 frames",
    ]);
    let mut sums = vec![Vec::new(); ERRORS.len()];
    for recording in recordings().into_iter().filter(|r| r.label.contains(only)) {
        let source = recording.read(&data)?;
        let reference = Reference::of(&source).map_err(|e| format!("{}: {e}", recording.label))?;
        for (errors, sums) in ERRORS.into_iter().zip(&mut sums) {
            let times = if errors.is_none() { 1 } else { TIMES };
            let rows: Result<Vec<Row>, String> = (0..times).map(|k| reference.compared(errors, seed + k)).collect();
            let row = mean(&rows.map_err(|e| format!("{}, {}: {e}", recording.label, errors.name))?);
            table.row(cells(recording.label, errors.name, &row));
            if recording.group != Group::Running {
                sums.push(row);
            }
        }
    }
    for (errors, rows) in ERRORS.into_iter().zip(&sums).filter(|(_, rows)| !rows.is_empty()) {
        table.row(cells("mean of the walks", errors.name, &mean(rows)));
    }
    println!("{}", table.text());
    Ok(())
}

/// Straight walks, two turns and a run, on the built-in body with a standing trial.
fn recordings() -> Vec<Recording> {
    let others = recording::labelled(&["HC032A18", "HC002D25", "rajagopal-run"]);
    recording::straight().into_iter().chain(others).collect()
}

/// Root mean square differences of three moments [N.m/kg] with and without plates, and the processor time for 100
/// frames [s].
#[derive(Debug, Clone, Copy, Default)]
struct Row {
    plates: Option<[f64; 3]>,
    predicted: Option<[f64; 3]>,
    seconds: f64,
}

fn cells(label: &str, errors: &str, row: &Row) -> [String; 9] {
    let number =
        |list: Option<[f64; 3]>| list.map_or(["-", "-", "-"].map(str::to_owned), |l| l.map(|x| format!("{x:.3}")));
    let ([a, b, c], [d, e, f]) = (number(row.plates), number(row.predicted));
    [label.to_owned(), errors.to_owned(), a, b, c, d, e, f, format!("{:.3}", row.seconds)]
}

fn mean(rows: &[Row]) -> Row {
    let of = |get: fn(&Row) -> Option<[f64; 3]>| {
        let list: Vec<[f64; 3]> = rows.iter().filter_map(get).collect();
        let mean = [0, 1, 2].map(|i| list.iter().map(|l| l[i]).sum::<f64>() / list.len() as f64);
        (!list.is_empty()).then_some(mean)
    };
    let seconds = rows.iter().map(|row| row.seconds).sum::<f64>() / rows.len() as f64;
    Row { plates: of(|row| row.plates), predicted: of(|row| row.predicted), seconds }
}

/// What markers say about a person, and the keypoints of the same motion.
struct Reference {
    forces: MeasuredForces,
    measured: Outcome,
    predicted: Outcome,
    clean: MarkerRecording,
    mass_kg: f64,
    height_m: f64,
}

impl Reference {
    fn of(source: &Source) -> Result<Reference, String> {
        let measured = outcome(source.clone(), GroundSettings::MeasuredOrPredicted)?;
        let predicted = outcome(source.clone(), GroundSettings::Predicted)?;
        let clean = keypoints(&measured)?;
        let (mass_kg, height_m) = (measured.body.mass(), measured.person.height_m);
        Ok(Reference { forces: source.forces.clone(), measured, predicted, clean, mass_kg, height_m })
    }

    /// Keypoints as a recording of this person, with the plates and forces of the reference.
    fn source(&self, markers: &MarkerRecording, tracked: &TrackedMarkers) -> Result<Source, String> {
        let mut file = trc_of_markers(markers).map_err(|e| e.to_string())?;
        // In metres, a file has the numbers to the last bit.
        file.unit = LengthUnit::Metre;
        let file = file.write();
        let size = StatedSize { mass_kg: Some(self.mass_kg), height_m: Some(self.height_m) };
        let job = Job { size, ..Job::of("keypoints.trc") };
        let read = job.read(&mut |_: &Path| Ok(file.clone()), &mut Findings::default());
        let mut source = read.map_err(|error| error.text())?.source.with_forces(self.forces.clone());
        if let Recorded::Markers(recorded) = &mut source.recording {
            recorded.trial.recording.plates.clone_from(&tracked.body.plates);
        }
        Ok(source)
    }

    fn compared(&self, errors: Errors, seed: u64) -> Result<Row, String> {
        let tracked = tracked(&self.measured)?;
        let markers = with_errors(&self.clean, errors, seed);
        let frames = markers.times.len();
        let source = self.source(&markers, tracked)?;
        let began = ThreadTime::now();
        let predicted = outcome(source.clone(), GroundSettings::Predicted)?;
        let seconds = began.elapsed().as_secs_f64() * 100.0 / frames as f64;
        let window = tracked.body.on_plates.windows.first().copied();
        let with_plates = window.map(|window| {
            let found = outcome(source, GroundSettings::MeasuredOrPredicted)?;
            differences(&self.measured, &found, window)
        });
        let grid = self.predicted.analysis.trajectory.grid();
        let within = [grid.start_s + END_S, grid.end_s() - END_S];
        Ok(Row {
            plates: with_plates.transpose()?,
            predicted: Some(differences(&self.predicted, &predicted, within)?),
            seconds,
        })
    }
}

fn outcome(source: Source, ground: GroundSettings) -> Result<Outcome, String> {
    let settings = Settings { ground, ..Settings::default() };
    study::run(source, &settings, &mut Findings::default()).map_err(|e| e.to_string())
}

/// Flexion moment of a joint over time [N.m/kg].
fn moment(outcome: &Outcome, joint: &str, side: Side) -> Result<Vec<f64>, String> {
    let name = format!("{joint}_{}", side.letter());
    let id = outcome.body.coordinate(&name).ok_or_else(|| format!("no coordinate `{name}`"))?;
    let per_kg = 1.0 / outcome.body.mass();
    Ok(outcome.analysis.forces.generalized[id.index()].iter().map(|moment| moment * per_kg).collect())
}

/// Root mean square of the differences of the three moments, both sides together [N.m/kg].
fn differences(reference: &Outcome, found: &Outcome, [from, to]: [f64; 2]) -> Result<[f64; 3], String> {
    let (grid, other) = (reference.analysis.trajectory.grid(), found.analysis.trajectory.grid());
    let mut squares = [(0.0, 0); 3];
    for (joint, sum) in JOINTS.into_iter().zip(&mut squares) {
        for side in Side::BOTH {
            let (expected, found) = (moment(reference, joint, side)?, moment(found, joint, side)?);
            for (frame, value) in expected.iter().enumerate() {
                let time = grid.time(frame);
                let there = ((time - other.start_s) / other.step_s).round();
                let is_inside = (from..=to).contains(&time) && there >= 0.0 && there < other.frames as f64;
                if is_inside && value.is_finite() && found[there as usize].is_finite() {
                    *sum = (sum.0 + (value - found[there as usize]).powi(2), sum.1 + 1);
                }
            }
        }
    }
    Ok(squares.map(|(sum, count)| (sum / f64::from(count)).sqrt()))
}
