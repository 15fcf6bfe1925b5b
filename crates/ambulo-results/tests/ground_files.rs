//! Ground forces in the files of a run.

use crate::free_bodies::{DOWN_Y, free_bodies};
use ambulo::analysis::{AnalysisSettings, analyse};
use ambulo::findings::Findings;
use ambulo::model::{BodyId, Model};
use ambulo::motion::{ForceRecording, Motion, Smoother, TimeGrid, Window};
use ambulo::spatial::Vec3;
use ambulo_formats::table::Table;
use ambulo_results::{Keep, output_files};

/// Products and sums of numbers up to 1000 N.m, divided by hundreds of newtons.
const ROUNDING: f64 = 1e-11;

const FRAMES: usize = 41;

fn grid() -> TimeGrid {
    TimeGrid { start_s: 0.0, step_s: 0.01, frames: FRAMES }
}

/// Two feet, each free in the world.
fn feet(gravity: Vec3) -> Model {
    free_bodies(gravity, &[("calcn_r", 35.0), ("calcn_l", 35.0)])
}

fn right(model: &Model) -> BodyId {
    model.body("calcn_r").unwrap()
}

/// A plate sampled at the instants of the frames.
fn plate(body: BodyId, at: impl Fn(f64) -> (Vec3, Vec3, Vec3)) -> ForceRecording {
    let times = grid().times();
    let (mut force, mut point, mut moment) = (Vec::new(), Vec::new(), Vec::new());
    for &t in &times {
        let (f, p, m) = at(t);
        force.push(f);
        point.push(p);
        moment.push(m);
    }
    ForceRecording { name: "plate".into(), body, force_frame: None, point_frame: None, times, force, point, moment }
}

#[test]
fn an_unloaded_foot_is_zero_in_the_written_file_and_a_loaded_one_is_not() {
    let model = feet(DOWN_Y);
    let on = |t: f64| t > 0.2;
    let push = plate(right(&model), |t| {
        let force = Vec3::new(1.0, if on(t) { 600.0 } else { 15.0 }, 2.0);
        (force, Vec3::new(0.3, 0.05, 0.1), Vec3::new(0.0, 4.0, 0.0))
    });
    let motion = Motion { origin: "made".into(), times: grid().times(), columns: vec![Some(vec![0.1; FRAMES]); 12] };
    let settings = AnalysisSettings {
        smoother: Smoother::Off,
        force_filter: None,
        window: Window::default(),
        rate_hz: None,
        instrumented: None,
    };
    let analysis = analyse(&model, &motion, &[push], settings, &mut Findings::default()).unwrap();
    let files = output_files(&model, &analysis, None, &Keep::all()).unwrap();
    let file = files.iter().find(|f| f.name == "grf.mot").unwrap();
    let table = Table::read_storage(&file.bytes().unwrap()).unwrap().0;
    let expected = [("ground_force_r_v", [1.0, 600.0, 2.0]), ("ground_force_r_p", [0.3, 0.05, 0.1])];
    let torque = [("ground_torque_r_", [0.0, 4.0, 0.0])];
    for (stem, values) in expected.into_iter().chain(torque) {
        for (axis, value) in ["x", "y", "z"].into_iter().zip(values) {
            let column = table.column(&format!("{stem}{axis}")).unwrap();
            for (t, x) in table.times().unwrap().iter().zip(column) {
                let expected = if on(*t) { value } else { 0.0 };
                assert!((x - expected).abs() < ROUNDING, "{stem}{axis} at {t}: {x} instead of {expected}");
            }
        }
    }
    let left = table.columns().filter(|(name, _)| name.contains("_l_"));
    assert!(left.flat_map(|(_, values)| values).all(|x| x.abs() < f64::MIN_POSITIVE), "the left foot was not loaded");
}

#[test]
fn the_written_ground_force_of_a_side_is_the_sum_of_all_its_loads() {
    // Heel and toes of one foot on a plate each, applied to two bodies: the file has one load per side, which must
    // be their sum, because the dynamics used both.
    let model = free_bodies(DOWN_Y, &[("calcn_r", 35.0), ("toes_r", 35.0)]);
    let push = |body: &str, load: f64| {
        plate(model.body(body).unwrap(), move |_| {
            (Vec3::new(0.0, load, 0.0), Vec3::new(load / 1e3, 0.0, 0.1), Vec3::zeros())
        })
    };
    let plates = [push("calcn_r", 400.0), push("toes_r", 300.0)];
    let motion = Motion { origin: "made".into(), times: grid().times(), columns: vec![Some(vec![0.1; FRAMES]); 12] };
    let settings = AnalysisSettings {
        smoother: Smoother::Off,
        force_filter: None,
        window: Window::default(),
        rate_hz: None,
        instrumented: None,
    };
    let mut findings = Findings::default();
    let analysis = analyse(&model, &motion, &plates, settings, &mut findings).unwrap();
    let files = output_files(&model, &analysis, None, &Keep::all()).unwrap();
    let file = files.iter().find(|f| f.name == "grf.mot").unwrap();
    let table = Table::read_storage(&file.bytes().unwrap()).unwrap().0;
    let vertical = table.column("ground_force_r_vy").unwrap();
    assert!(vertical.iter().all(|y| (y - 700.0).abs() < ROUNDING), "{} N of 700 N were written", vertical[0]);
}
