//! Times muscle forces of two walks: paths, static optimisation, and the reactions of the joints with them.
//!
//! | step | content of a frame |
//! |---|---|
//! | paths | posture, lengths, speeds, moment arms |
//! | muscle forces | paths, strengths, static optimisation, loads on the bodies |
//! | whole | muscle forces, and inverse dynamics with them: the reactions of all joints |
//!
//! If OpenSim is installed as a peer, its static optimisation and joint reaction of the same walk run right after, and
//! the ratio is printed.

use super::Row;
use super::timing::{Timing, cpu_us};
use crate::workspace;
use ambulo::analysis::{Analysis, AnalysisSettings, analyse};
use ambulo::dynamics::{BodyLoad, Workspace, inverse_frame};
use ambulo::findings::Findings;
use ambulo::kinematics::Posture;
use ambulo::model::{Model, from_osim};
use ambulo::motion::filter::LowPass;
use ambulo::motion::{Smoother, Window, coordinates_from_table, force_recordings};
use ambulo_formats::external_loads::ExternalLoads;
use ambulo_formats::osim::OsimModel;
use ambulo_formats::table::Table;
use ambulo_muscles::path::PathWorkspace;
use ambulo_muscles::set::MuscleSet;
use ambulo_muscles::settings::MuscleSettings;
use ambulo_muscles::solver::MuscleSolver;
use std::fs;
use std::hint::black_box;

/// The walks: name, name for OpenSim's script, folder, model, motion, plates, their document, and the most that a frame
/// may take [us].
const WALKS: [(&str, &str, [&str; 5], f64); 2] = [
    (
        "Gait2392, 92 muscles",
        "gait2392",
        [
            "opensim-gait2392-subject01",
            "subject01_simbody.osim",
            "subject01_walk1_ik.mot",
            "subject01_walk1_grf.mot",
            "subject01_walk1_grf.xml",
        ],
        60.0,
    ),
    (
        "Rajagopal, 80 muscles, 46 wraps",
        "rajagopal",
        [
            "opensim-rajagopal-walk",
            "subject_walk_scaled.osim",
            "ik_uniform_weights.mot",
            "grf_walk.mot",
            "grf_walk.xml",
        ],
        120.0,
    ),
];

/// A walk whose muscle forces are timed.
struct Walk {
    model: Model,
    set: MuscleSet,
    analysis: Analysis,
    loads: Vec<Vec<BodyLoad>>,
    postures: Vec<[Vec<f64>; 4]>,
}

/// Times every walk there is data for; each row is the CPU time of a frame.
#[expect(clippy::print_stdout, reason = "the table is the command's result")]
pub(super) fn bench() -> Result<Vec<Row>, String> {
    let mut rows = Vec::new();
    for (name, short, files, most_us) in WALKS {
        let folder = workspace::data().join("data").join(files[0]);
        if !folder.join(files[1]).is_file() {
            println!("muscle forces, {name}: skipped: no data");
            continue;
        }
        let walk = Walk::read(&folder, files)?;
        let own = walk.time(name)?;
        println!("\nmuscle forces, {name}");
        print!("{}", super::table(&own));
        let whole = own.last().map_or(f64::INFINITY, |row| row.timing.median);
        println!("required: at most {most_us} us: {}", super::verdict(whole, most_us));
        rows.extend(own);
        match opensim_us(short) {
            Ok(us) => {
                let ratio = us / whole;
                println!("OpenSim, static optimisation and joint reaction: {us:.0} us/frame, {ratio:.0} times ours");
                let timing = Timing::single(us);
                rows.push(Row { quantity: format!("OpenSim, {name}"), unit: "us/frame", timing });
            }
            Err(reason) => println!("OpenSim was not timed: {reason}"),
        }
    }
    Ok(rows)
}

/// CPU time per frame of OpenSim's tools for the same walk [us].
fn opensim_us(short: &str) -> Result<f64, String> {
    let env = workspace::peers_env();
    let mut program = workspace::peer_program(env.as_deref(), "opensim", "opensim_muscles.py")?;
    let done = program.arg(workspace::data().join("data")).arg(short).output().map_err(|e| e.to_string())?;
    let text = String::from_utf8_lossy(&done.stdout);
    let us = text.split_whitespace().nth(1).and_then(|word| word.parse().ok());
    us.ok_or_else(|| format!("no time in its output: {}", String::from_utf8_lossy(&done.stderr).trim()))
}

impl Walk {
    fn read(folder: &std::path::Path, [_, model, motion, plates, loads]: [&str; 5]) -> Result<Walk, String> {
        let read = |name: &str| fs::read(folder.join(name)).map_err(|e| format!("{name}: cannot read: {e}"));
        let table = |name: &str| -> Result<Table, String> {
            Ok(Table::read_storage(&read(name)?).map_err(|e| format!("{name}: {e}"))?.0)
        };
        let findings = &mut Findings::default();
        let document = OsimModel::read(&read(model)?).map_err(|e| e.to_string())?;
        let model = from_osim(&document, findings).map_err(|e| e.to_string())?;
        let set = MuscleSet::of_document(&document, &model, findings).map_err(|e| e.to_string())?;
        let motion = coordinates_from_table(&model, &table(motion)?, "walk", findings).map_err(|e| e.to_string())?;
        let (loads, _) = ExternalLoads::read(&read(loads)?).map_err(|e| e.to_string())?;
        let plates = force_recordings(&model, &loads, &table(plates)?, findings).map_err(|e| e.to_string())?;
        let smoother = Smoother::Butterworth(LowPass { order: 3, cutoff_hz: 6.0 });
        let window = Window::default();
        let settings = AnalysisSettings { smoother, force_filter: None, window, rate_hz: None, instrumented: None };
        let analysis = analyse(&model, &motion, &plates, settings, findings).map_err(|e| e.to_string())?;
        let series = analysis.ground.loads();
        let frames = analysis.trajectory.grid().frames;
        let loads = (0..frames).map(|frame| series.iter().map(|load| load.at(frame)).collect()).collect();
        let mut postures = Vec::with_capacity(frames);
        analysis.trajectory.for_each_posture(|frame, Posture { q, qd, qdd }| {
            let forces = analysis.forces.generalized.iter().map(|column| column[frame]).collect();
            postures.push([q.to_vec(), qd.to_vec(), qdd.to_vec(), forces]);
        });
        Ok(Walk { model, set, analysis, loads, postures })
    }

    fn time(&self, name: &str) -> Result<Vec<Row>, String> {
        let frames = self.analysis.trajectory.grid().frames;
        let settings = MuscleSettings::default();
        let mut solver = MuscleSolver::new(&self.model, &self.set, &settings).map_err(|e| e.to_string())?;
        let mut paths = PathWorkspace::new(&self.model, &self.set, settings.wraps);
        let mut workspace = Workspace::new(&self.model);
        let row = |what: &str, timing: Timing| Row { quantity: format!("{what}, {name}"), unit: "us/frame", timing };
        let paths = cpu_us(frames, || {
            for frame in &self.postures {
                paths.update(Posture { q: &frame[0], qd: &frame[1], qdd: &frame[2] });
                black_box(paths.lengths());
            }
        });
        let forces = cpu_us(frames, || {
            for frame in &self.postures {
                let at = Posture { q: &frame[0], qd: &frame[1], qdd: &frame[2] };
                black_box(solver.frame(at, &frame[3]));
            }
        });
        let mut loads = Vec::new();
        let whole = cpu_us(frames, || {
            for (frame, ground) in self.postures.iter().zip(&self.loads) {
                let at = Posture { q: &frame[0], qd: &frame[1], qdd: &frame[2] };
                let values = solver.frame(at, &frame[3]);
                loads.clear();
                loads.extend_from_slice(ground);
                loads.extend_from_slice(&values.body_loads);
                black_box(inverse_frame(&mut workspace, at, &loads));
            }
        });
        Ok(vec![row("paths", paths), row("muscle forces", forces), row("whole", whole)])
    }
}
