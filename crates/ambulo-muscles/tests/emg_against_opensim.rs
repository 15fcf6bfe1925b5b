//! Activations of static optimisation against recorded EMG, and how well OpenSim's agree with it.
//!
//! `testdata/emg_opensim.csv` has the correlations of OpenSim 4.6 on the same frames of the same files
//! (`xtask/measure/peers/opensim_emg.py`). Two public recordings: a healthy man on a treadmill with EMG of the left leg
//! (MatlabStaticOptimization), and a person walking and running with EMG of the right leg (CEINMS-RT).

use crate::muscle_models::{self, MuscleModel};
use crate::shared_data;
use ambulo_body::dynamics::{LoadSeries, Workspace, inverse};
use ambulo_body::findings::Findings;
use ambulo_body::kinematics::Trajectory;
use ambulo_body::model::Model;
use ambulo_body::motion::filter::LowPass;
use ambulo_body::motion::{
    Between, ForceRecording, SmoothSettings, Smoother, TimeGrid, Window, coordinates_from_table, force_recordings,
    smooth,
};
use ambulo_body::spatial::{Vec3, Wrench};
use ambulo_formats::external_loads::{ExternalForce, ExternalLoads};
use ambulo_formats::table::Table;
use ambulo_muscles::emg::{EmgEnvelope, EmgSettings, EmgTrial, compare, emg_from_table, envelopes};
use ambulo_muscles::settings::MuscleSettings;
use ambulo_muscles::trial::{MuscleTrial, solve_trial};
use ambulo_muscles::wrap::WrapRule;
use std::path::Path;

const REFERENCE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/testdata/emg_opensim.csv");
/// How much smaller r may be than OpenSim's.
const ALLOWED: f64 = 0.02;
/// A column that is a copy of vastus lateralis in the file: no EMG was measured there. Its activation is so small that
/// OpenSim's tolerance matters: r by OpenSim's wraps is up to 0.06 smaller.
const NOT_MEASURED: &str = "vasint_l_activation";

/// A recording with EMG.
struct Case {
    name: &'static str,
    model: &'static str,
    folder: &'static str,
    files: [&'static str; 3],
    /// Prefix of the columns of the force on the left foot.
    left: &'static str,
    mass_factor: f64,
}

const fn ceinms(name: &'static str, folder: &'static str) -> Case {
    Case {
        name,
        model: "muscles/B-ceinms-lowerlimb/gait2392.osim",
        folder,
        files: ["ik.sto", "XLD.mot", "emgFilt.sto"],
        left: "l_",
        mass_factor: 58.03 / 75.16,
    }
}

const CASES: [Case; 4] = [
    Case {
        name: "stanford",
        model: "muscles/A-stanford-matlabso/Rajagopal_scaled_Sub1_gasAvoid.osim",
        folder: "muscles/A-stanford-matlabso",
        files: ["results_ik.sto", "walking_baseline1_forces.mot", "EMG_allMuscles.sto"],
        left: "1_",
        mass_factor: 1.0,
    },
    ceinms("walk36", "muscles/B-ceinms-lowerlimb/walk36"),
    ceinms("walk45", "muscles/B-ceinms-lowerlimb/walk45"),
    ceinms("run81", "muscles/B-ceinms-lowerlimb/run81"),
];

fn table(path: &Path) -> Table {
    Table::read_storage(&std::fs::read(path).unwrap()).unwrap().0
}

/// The loads at the frames: wrenches about the origin of the world, between samples linear.
fn loads(plates: &[ForceRecording], grid: TimeGrid) -> Vec<LoadSeries> {
    let of = |plate: &ForceRecording| {
        let moments: Vec<Vec3> =
            (0..plate.times.len()).map(|i| plate.point[i].cross(&plate.force[i]) + plate.moment[i]).collect();
        let at = |values: &[Vec3], place: Between| {
            let axis = |k: usize| place.value(&values.iter().map(|v| v[k]).collect::<Vec<f64>>());
            Vec3::new(axis(0), axis(1), axis(2))
        };
        let wrench = |t: f64| {
            let place = Between::of(&plate.times, t);
            Wrench { force: at(&plate.force, place), moment: at(&moments, place) }
        };
        let wrenches = grid.times().into_iter().map(wrench).collect();
        LoadSeries { body: plate.body, points: vec![Vec3::zeros(); grid.frames], wrenches }
    };
    plates.iter().map(of).collect()
}

/// Coordinates at 6 Hz as OpenSim filters them, over a window.
fn trajectory(model: &Model, ik: &Table, window: [f64; 2]) -> Trajectory {
    let mut findings = Findings::default();
    let motion = coordinates_from_table(model, ik, "recording", &mut findings).unwrap();
    let settings = SmoothSettings {
        smoother: Smoother::Butterworth(LowPass::MOTION),
        window: Window { from_s: Some(window[0]), to_s: Some(window[1]) },
        rate_hz: None,
    };
    let smooth = smooth(model, &motion, settings, &mut findings).unwrap();
    Trajectory::complete(model, smooth, &mut findings).unwrap()
}

type Solved = (MuscleModel, Trajectory, MuscleTrial);

/// The muscle forces of a window.
fn muscles(case: &Case, data: &Path, window: [f64; 2], wraps: WrapRule) -> Solved {
    let mut body = muscle_models::read(&std::fs::read(data.join(case.model)).unwrap());
    let ones = vec![Vec3::repeat(1.0); body.model.bodies().len()];
    body.model = body.model.scaled(&ones, Some(case.mass_factor * body.model.mass())).unwrap();
    let [ik, forces, _] = case.files.map(|file| table(&data.join(case.folder).join(file)));
    let trajectory = trajectory(&body.model, &ik, window);
    let force = |body: &str, prefix: &str| ExternalForce {
        torque_identifier: Some(format!("{prefix}ground_torque_")),
        ..ExternalForce::with_prefix(body, body, &format!("{prefix}ground_force_"))
    };
    let feet = vec![force("calcn_r", ""), force("calcn_l", case.left)];
    let external = ExternalLoads { name: "feet".to_owned(), datafile: None, forces: feet };
    let plates = force_recordings(&body.model, &external, &forces, &mut Findings::default()).unwrap();
    let ground = loads(&plates, trajectory.grid());
    let net = inverse(&mut Workspace::new(&body.model), &trajectory, &ground);
    let settings = MuscleSettings { wraps, ..MuscleSettings::default() };
    let trial = solve_trial(&body.model, &body.set, &settings, &trajectory, &net.generalized).unwrap();
    (body, trajectory, trial)
}

fn emg(case: &Case, data: &Path) -> EmgTrial {
    let table = table(&data.join(case.folder).join(case.files[2]));
    let recording = emg_from_table(&table, &[], &mut Findings::default()).unwrap();
    envelopes(&[recording], &EmgSettings::default()).unwrap().remove(0)
}

/// One correlation of the reference.
struct Reference {
    window: [f64; 2],
    delay_s: f64,
    muscle: String,
    frames: usize,
    r: f64,
}

fn reference(case: &str, source: &str) -> Vec<Reference> {
    let text = std::fs::read_to_string(REFERENCE).unwrap();
    let rows = text.lines().skip(1).map(|line| line.split(',').collect::<Vec<_>>());
    let number = |cell: &str| cell.parse::<f64>().unwrap();
    let read = |row: Vec<&str>| Reference {
        window: [number(row[1]), number(row[2])],
        delay_s: number(row[3]),
        muscle: row[5].to_owned(),
        frames: row[6].parse().unwrap(),
        r: number(row[7]),
    };
    rows.filter(|row| row[0] == case && row[4] == source).map(read).collect()
}

/// Names of muscles with their activations.
fn named<'a>(body: &'a MuscleModel, trial: &'a MuscleTrial) -> Vec<(&'a str, &'a [f64])> {
    let each = body.set.muscles.iter().zip(&trial.muscles);
    each.map(|(muscle, series)| (muscle.name.as_str(), series.activation.as_slice())).collect()
}

/// r of a row by our activations.
fn r_of((body, trajectory, trial): &Solved, emg: &[EmgEnvelope], row: &Reference) -> f64 {
    let found = compare(emg, &named(body, trial), trajectory.grid(), row.delay_s);
    let found = found.into_iter().find(|comparison| comparison.channel == row.muscle).unwrap();
    assert_eq!((found.frames, found.model_muscles.len()), (row.frames, 1), "{}", row.muscle);
    found.r
}

#[test]
fn activations_agree_with_emg_as_those_of_opensim_do() {
    let Some(data) = shared_data::data() else { return };
    let mut smaller = Vec::new();
    for case in &CASES {
        let rows = reference(case.name, "opensim");
        assert!(rows.len() >= 14, "{}: no reference", case.name);
        let emg = emg(case, &data).envelopes;
        for rows in rows.chunk_by(|a, b| a.window.map(f64::to_bits) == b.window.map(f64::to_bits)) {
            let [from, to] = rows[0].window;
            let solved = [WrapRule::Exact, WrapRule::OpenSim].map(|wraps| muscles(case, &data, [from, to], wraps));
            println!("{} {from} to {to} s: delay, muscle, r of ours (exact wraps, OpenSim's), of OpenSim", case.name);
            for rows in rows.chunk_by(|a, b| a.delay_s.to_bits() == b.delay_s.to_bits()) {
                let mut sums = [0.0; 3];
                for row in rows {
                    let [exact, repeated] = [r_of(&solved[0], &emg, row), r_of(&solved[1], &emg, row)];
                    println!("  {:3} s {:<24} {exact:7.4} {repeated:7.4} {:7.4}", row.delay_s, row.muscle, row.r);
                    // Exact paths of the calf over two surfaces have other moment arms than OpenSim's; without a delay,
                    // which is the default, they are compared too.
                    let least = if row.delay_s > 0.0 { repeated } else { exact.min(repeated) };
                    if row.muscle != NOT_MEASURED && least < row.r - ALLOWED {
                        smaller.push(format!("{} {}: r = {least:.4}, OpenSim's {}", case.name, row.muscle, row.r));
                    }
                    sums.iter_mut().zip([exact, repeated, row.r]).for_each(|(sum, r)| *sum += r);
                }
                let [exact, repeated, reference] = sums.map(|sum| sum / rows.len() as f64);
                println!("  {:3} s {:<24} {exact:7.4} {repeated:7.4} {reference:7.4}", rows[0].delay_s, "mean");
            }
        }
    }
    assert!(smaller.is_empty(), "{}", smaller.join("\n"));
}

#[test]
fn published_activations_of_the_first_recording_are_read_and_compared() {
    let Some(data) = shared_data::data() else { return };
    let case = &CASES[0];
    let states = table(&data.join("muscles/A-stanford-matlabso/results_SO/results_states.sto"));
    let grid = TimeGrid::through(states.times().unwrap()).unwrap();
    let named: Vec<(&str, &[f64])> = states
        .columns()
        .filter_map(|(name, values)| Some((name.strip_prefix("/forceset/")?.strip_suffix("/activation")?, values)))
        .collect();
    let rows = reference(case.name, "published");
    assert_eq!(rows.len(), 14);
    for row in rows {
        let found = compare(&emg(case, &data).envelopes, &named, grid, row.delay_s);
        let comparison = found.iter().find(|comparison| comparison.channel == row.muscle).unwrap();
        println!("{:3} s {:<24} {:7.4}", row.delay_s, row.muscle, comparison.r);
        assert_eq!(comparison.frames, row.frames);
        assert!((comparison.r - row.r).abs() < 2e-4, "{}: {} instead of {}", row.muscle, comparison.r, row.r);
    }
}

#[test]
fn the_other_leg_or_another_time_does_not_agree() {
    let Some(data) = shared_data::data() else { return };
    let case = &CASES[1];
    let (body, trajectory, trial) = muscles(case, &data, [12.0, 14.4], WrapRule::Exact);
    let mut body_of_other_leg = body.set.clone();
    for muscle in &mut body_of_other_leg.muscles {
        let stem = muscle.name[..muscle.name.len() - 2].to_owned();
        muscle.name = if muscle.name.ends_with("_l") { stem + "_r" } else { stem + "_l" };
    }
    let other =
        MuscleModel { set: body_of_other_leg, ..muscle_models::read(&std::fs::read(data.join(case.model)).unwrap()) };
    let emg = emg(case, &data).envelopes;
    let mean_r = |body: &MuscleModel, delay_s: f64| {
        let found = compare(&emg, &named(body, &trial), trajectory.grid(), delay_s);
        assert_eq!(found.len(), 9);
        found.iter().map(|comparison| comparison.r).sum::<f64>() / found.len() as f64
    };
    let (right, left, later) = (mean_r(&body, 0.1), mean_r(&other, 0.1), mean_r(&body, 0.7));
    println!("mean r {right:.3}, other leg {left:.3}, half a cycle later {later:.3}");
    assert!(left < right - 0.5 && later < right - 0.5);
}
