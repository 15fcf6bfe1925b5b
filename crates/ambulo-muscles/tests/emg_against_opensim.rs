//! Activations of static optimisation against recorded EMG, and how well OpenSim's agree with it.
//!
//! `testdata/emg_opensim.csv` has the correlations of OpenSim 4.6 on the same frames of the same files
//! (`xtask/measure/peers/opensim_emg.py`). Two public recordings: a healthy man on a treadmill with seven muscles of the
//! left leg (MatlabStaticOptimization), and a person walking and running with nine of the right leg (CEINMS-RT).

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
use ambulo_muscles::emg::{EmgComparison, EmgSettings, EmgTrial, compare, emg_from_table, envelopes};
use ambulo_muscles::settings::MuscleSettings;
use ambulo_muscles::trial::{MuscleTrial, solve_trial};
use ambulo_muscles::wrap::WrapRule;
use std::path::Path;

const REFERENCE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/testdata/emg_opensim.csv");
/// How much smaller r may be than OpenSim's.
const ALLOWED: f64 = 0.02;

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

/// The muscle forces of a window.
fn muscles(case: &Case, data: &Path, window: [f64; 2], wraps: WrapRule) -> (MuscleModel, Trajectory, MuscleTrial) {
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

/// Rows of the reference of one case and source: window, column, r.
fn reference(case: &str, source: &str) -> Vec<([f64; 2], String, usize, f64)> {
    let text = std::fs::read_to_string(REFERENCE).unwrap();
    let rows = text.lines().skip(1).map(|line| line.split(',').collect::<Vec<_>>());
    let wanted = rows.filter(|row| row[0] == case && row[3] == source);
    let number = |cell: &str| cell.parse::<f64>().unwrap();
    wanted
        .map(|row| {
            let window = [number(row[1]), number(row[2])];
            (window, row[4].to_owned(), row[5].parse().unwrap(), number(row[6]))
        })
        .collect()
}

fn windows(rows: &[([f64; 2], String, usize, f64)]) -> Vec<[f64; 2]> {
    let mut windows: Vec<[f64; 2]> = rows.iter().map(|row| row.0).collect();
    windows.dedup();
    windows
}

fn compared(case: &Case, data: &Path, window: [f64; 2], wraps: WrapRule) -> Vec<EmgComparison> {
    let (body, trajectory, trial) = muscles(case, data, window, wraps);
    let activations: Vec<(&str, &[f64])> = body
        .set
        .muscles
        .iter()
        .zip(&trial.muscles)
        .map(|(muscle, series)| (muscle.name.as_str(), series.activation.as_slice()))
        .collect();
    compare(&emg(case, data).envelopes, &activations, trajectory.grid(), 0.0)
}

#[test]
fn activations_agree_with_emg_as_those_of_opensim_do() {
    let Some(data) = shared_data::data() else { return };
    let mut least = f64::INFINITY;
    for case in &CASES {
        let rows = reference(case.name, "opensim");
        assert!(rows.len() >= 7, "{}: no reference", case.name);
        for window in windows(&rows) {
            let exact = compared(case, &data, window, WrapRule::Exact);
            let as_opensim = compared(case, &data, window, WrapRule::OpenSim);
            println!(
                "{} {} to {} s: muscle, r of ours (exact wraps, OpenSim's wraps), of OpenSim",
                case.name, window[0], window[1]
            );
            for (_, muscle, frames, r) in rows.iter().filter(|row| row.0 == window) {
                let of = |list: &[EmgComparison]| {
                    let found = list.iter().find(|comparison| comparison.channel == *muscle).unwrap();
                    assert_eq!(found.frames, *frames, "{} {muscle}", case.name);
                    assert_eq!(found.model_muscles.len(), 1);
                    found.r
                };
                let (ours, repeated) = (of(&exact), of(&as_opensim));
                println!("  {muscle:<24} {ours:7.4} {repeated:7.4} {r:7.4}");
                least = least.min(ours - r);
                assert!(ours >= r - ALLOWED, "{} {muscle}: r = {ours}, OpenSim's {r}", case.name);
                assert!(repeated >= r - ALLOWED, "{} {muscle}: r = {repeated}, OpenSim's {r}", case.name);
            }
        }
    }
    println!("smallest r minus OpenSim's: {least:.4}");
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
    let found = compare(&emg(case, &data).envelopes, &named, grid, 0.0);
    let rows = reference(case.name, "published");
    assert_eq!(rows.len(), 7);
    for (_, muscle, frames, r) in rows {
        let comparison = found.iter().find(|comparison| comparison.channel == muscle).unwrap();
        println!("{muscle:<24} {:7.4}", comparison.r);
        assert_eq!(comparison.frames, frames);
        assert!((comparison.r - r).abs() < 2e-4, "{muscle}: {} instead of {r}", comparison.r);
    }
}

#[test]
fn the_other_leg_or_another_time_does_not_agree() {
    let Some(data) = shared_data::data() else { return };
    let case = &CASES[1];
    let (body, trajectory, trial) = muscles(case, &data, [12.0, 14.4], WrapRule::Exact);
    let named = |swap: bool| -> Vec<(String, Vec<f64>)> {
        let name = |name: &str| match name.strip_suffix("_l") {
            Some(stem) if swap => format!("{stem}_r"),
            _ if swap => name.replace("_r", "_l"),
            _ => name.to_owned(),
        };
        let each = body.set.muscles.iter().zip(&trial.muscles);
        each.map(|(muscle, series)| (name(&muscle.name), series.activation.clone())).collect()
    };
    let mean_r = |swap: bool, delay_s: f64| {
        let named = named(swap);
        let activations: Vec<(&str, &[f64])> = named.iter().map(|(n, v)| (n.as_str(), v.as_slice())).collect();
        let found = compare(&emg(case, &data).envelopes, &activations, trajectory.grid(), delay_s);
        found.iter().map(|comparison| comparison.r).sum::<f64>() / found.len() as f64
    };
    let right = mean_r(false, 0.0);
    println!("mean r {right:.3}, other leg {:.3}, 0.3 s later {:.3}", mean_r(true, 0.0), mean_r(false, 0.3));
    assert!(mean_r(true, 0.0) < right - 0.2);
    assert!(mean_r(false, 0.3) < right - 0.2);
}
