//! Inverse dynamics of the built-in figure, from a walk with exact derivatives: in the air, and with forces on the
//! feet.

use super::closed_forms::Files;
use super::series::{Signal, Wave, column, motion_file, rounded, seconds, storage};
use crate::workbench::demo_input;
use ambulo::dynamics::{LoadSeries, Workspace, inverse};
use ambulo::kinematics::Trajectory;
use ambulo::model::anthropometry::{Build, SegmentTable};
use ambulo::model::full_body::full_body;
use ambulo::model::{Model, to_osim};
use ambulo::motion::TimeGrid;
use ambulo::numerics::Harmonics;
use ambulo::numerics::elementary::{atan2, hypot};
use ambulo::spatial::{Vec3, Wrench};
use ambulo_formats::external_loads::{ExternalForce, ExternalLoads};
use ambulo_formats::table::Table;

/// Harmonics of a coordinate: the fourth has 4 Hz, which 200 rows per second resolve.
const HARMONICS: usize = 4;
/// Samples of a stride of the recording at 100 Hz.
const STRIDE: usize = 110;

pub(super) fn all() -> [Files; 2] {
    let model = full_body(&Build::usual(SegmentTable::DeLevaMale)).unwrap().model;
    let walk = Table::read_storage(&demo_input("walk.mot")).unwrap().0;
    let motion: Vec<(String, Signal)> =
        model.coordinates().iter().map(|c| (c.name.clone(), signal(&c.name, &walk))).collect();
    let named: Vec<(&str, Signal)> = motion.iter().map(|(name, signal)| (name.as_str(), signal.clone())).collect();
    let (loads, table) = loads(&model);
    let air = vec![
        ("model.osim", to_osim(&model).unwrap().write().unwrap()),
        ("motion.mot", motion_file(&named)),
        ("reference.sto", reference(&model, &motion, &[])),
    ];
    let document = ExternalLoads {
        name: "loads".to_owned(),
        datafile: Some("loads.mot".to_owned()),
        forces: vec![
            ExternalForce::with_prefix("right", "calcn_r", "ground_force_r_"),
            ExternalForce::with_prefix("left", "calcn_l", "ground_force_l_"),
        ],
    };
    let ground = vec![
        ("loads.xml", document.write()),
        ("loads.mot", table),
        ("reference.sto", reference(&model, &motion, &loads)),
    ];
    [("inverse-dynamics/figure-in-the-air", air), ("inverse-dynamics/figure-on-the-ground", ground)]
}

/// The first stride of the recorded coordinate as a steady part and harmonics; small waves where it has none.
fn signal(name: &str, walk: &Table) -> Signal {
    let frequency_hz = 100.0 / STRIDE as f64;
    let Some(values) = walk.column(name) else {
        let phase = name.len() as f64;
        return Signal::Wave(Wave { offset: 0.1, amplitude: 0.25, frequency_hz, phase });
    };
    let unit = if name.starts_with("pelvis_t") && name != "pelvis_tilt" { 1.0 } else { 1.0_f64.to_radians() };
    let speed = (values[STRIDE] - values[0]) / STRIDE as f64;
    let phases: Vec<f64> = (0..STRIDE).map(|row| row as f64 / STRIDE as f64).collect();
    let left: Vec<f64> = (0..STRIDE).map(|row| values[row] - speed * row as f64).collect();
    let found = Harmonics::of(&phases, &left, HARMONICS);
    let mean = Wave { offset: found.mean * unit, amplitude: 0.0, frequency_hz, phase: 0.0 };
    let waves = (0..HARMONICS).map(|k| Wave {
        offset: 0.0,
        amplitude: hypot(found.cosine[k], found.sine[k]) * unit,
        frequency_hz: frequency_hz * (k + 1) as f64,
        phase: atan2(found.cosine[k], found.sine[k]),
    });
    Signal::Sum { speed: speed * 100.0 * unit, waves: std::iter::once(mean).chain(waves).collect() }
}

/// Forces on the feet over 0.8 s at 100 Hz, and the table that has them.
fn loads(model: &Model) -> (Vec<LoadSeries>, Vec<u8>) {
    let recorded = Table::read_storage(&demo_input("walk_grf.mot")).unwrap().0;
    let digits =
        |name: &str| -> Vec<f64> { recorded.column(name).unwrap()[..81].iter().map(|x| rounded(*x, 1e-6)).collect() };
    let columns = recorded.names().iter().filter(|name| *name != "time").map(|name| (name.clone(), digits(name)));
    let table = storage("loads", &seconds(0.0, 0.01, 81), columns.collect(), 1e-6);
    let side = |s: &str| {
        let vectors = |stem: &str| -> Vec<Vec3> {
            let [x, y, z] = ["x", "y", "z"].map(|axis| digits(&format!("{stem}{axis}")));
            // The rows of the reference begin at 0.1 s.
            (10..71).map(|row| Vec3::new(x[row], y[row], z[row])).collect()
        };
        let forces = vectors(&format!("ground_force_{s}_v"));
        let moments = vectors(&format!("ground_torque_{s}_"));
        LoadSeries {
            body: model.body(&format!("calcn_{s}")).unwrap(),
            points: vectors(&format!("ground_force_{s}_p")),
            wrenches: forces.into_iter().zip(moments).map(|(force, moment)| Wrench { moment, force }).collect(),
        }
    };
    (vec![side("r"), side("l")], table)
}

/// Generalised forces from the exact derivatives.
fn reference(model: &Model, motion: &[(String, Signal)], loads: &[LoadSeries]) -> Vec<u8> {
    let times = seconds(0.1, 0.01, 61);
    let grid = TimeGrid { start_s: 0.1, step_s: 0.01, frames: times.len() };
    let part = |signal: &Signal, part: usize| times.iter().map(|t| signal.at(*t)[part]).collect();
    let columns = motion.iter().map(|(_, signal)| [0, 1, 2].map(|i| part(signal, i))).collect();
    let trajectory = Trajectory::new(model, grid, columns).unwrap();
    let forces = inverse(&mut Workspace::new(model), &trajectory, loads).generalized;
    let columns = model.force_names().into_iter().zip(forces);
    let columns = columns.map(|(name, values)| column(&name, &times, |t| values[((t - 0.1) * 100.0).round() as usize]));
    storage("reference", &times, columns.collect(), 1e-5)
}
