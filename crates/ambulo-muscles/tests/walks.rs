//! The walks of which OpenSim 4.6 made references: motion, ground forces and tables of results.

use crate::muscle_models::{MuscleModel, load};
use crate::shared_data;
use ambulo_body::dynamics::{LoadSeries, Workspace, inverse};
use ambulo_body::findings::Findings;
use ambulo_body::kinematics::Trajectory;
use ambulo_body::motion::filter::LowPass;
use ambulo_body::motion::{
    SmoothSettings, Smoother, Window, coordinates_from_table, force_recordings, interpolate, smooth,
};
use ambulo_body::spatial::{Vec3, Wrench};
use ambulo_formats::external_loads::ExternalLoads;
use ambulo_formats::table::Table;
use std::path::Path;

/// A walk, smoothed as OpenSim's tools smooth it, in the frames of its static optimisation.
pub(crate) struct Walk {
    pub(crate) muscles: MuscleModel,
    pub(crate) trajectory: Trajectory,
    /// Ground forces, one entry per frame.
    pub(crate) ground: Vec<LoadSeries>,
    /// Generalised forces of inverse dynamics: one column per coordinate.
    pub(crate) generalized: Vec<Vec<f64>>,
    pub(crate) body_weight: f64,
    /// Name in the tables.
    pub(crate) name: &'static str,
}

/// Folder, motion, plates, their document, and the time range of the references.
fn files(name: &str) -> (&'static str, &'static str, &'static str, &'static str, [f64; 2]) {
    match name {
        "gait2392" => (
            "opensim-gait2392-subject01",
            "subject01_walk1_ik.mot",
            "subject01_walk1_grf.mot",
            "subject01_walk1_grf.xml",
            [0.6, 1.6],
        ),
        "gait10dof" => (
            "opensim-gait10dof-subject01",
            "subject01_walk_IK.mot",
            "subject01_walk_grf.mot",
            "subject01_walk_grf.xml",
            [0.6, 1.6],
        ),
        _ => ("opensim-rajagopal-walk", "ik_uniform_weights.mot", "grf_walk.mot", "grf_walk.xml", [0.5, 1.7]),
    }
}

fn storage(path: &Path) -> Table {
    Table::read_storage(&std::fs::read(path).unwrap()).unwrap().0
}

impl Walk {
    /// The walk with the muscles of a model; `None` without the shared recordings.
    pub(crate) fn load(name: &'static str) -> Option<Walk> {
        let muscles = load(name)?;
        let model = &muscles.model;
        let (folder, motion, plates, loads, [from, to]) = files(name);
        let folder = shared_data::data()?.join(folder);
        let findings = &mut Findings::default();
        let motion = coordinates_from_table(model, &storage(&folder.join(motion)), "recording", findings).unwrap();
        // Half a frame more, because the times of the files are rounded.
        let window = Window { from_s: Some(from - 1e-3), to_s: Some(to + 1e-3) };
        let smoother = Smoother::Butterworth(LowPass { order: 3, cutoff_hz: 6.0 });
        let settings = SmoothSettings { smoother, window: Window::default(), rate_hz: None };
        let whole = smooth(model, &motion, settings, findings).unwrap();
        let whole = Trajectory::complete(model, whole, findings).unwrap();
        let (first, frames) = whole.grid().inside(window);
        let grid = ambulo_body::motion::TimeGrid { start_s: whole.grid().time(first), frames, ..whole.grid() };
        let part = |series: &Vec<f64>| series[first..first + frames].to_vec();
        let columns = whole.columns().iter().map(|column| column.each_ref().map(part)).collect();
        let trajectory = Trajectory::new(model, grid, columns).unwrap();
        let (document, _) = ExternalLoads::read(&std::fs::read(folder.join(loads)).unwrap()).unwrap();
        let plates = force_recordings(model, &document, &storage(&folder.join(plates)), findings).unwrap();
        let at = |times: &[f64], values: &[Vec3], t: f64| {
            let part = |k: usize| interpolate(times, &values.iter().map(|v| v[k]).collect::<Vec<_>>(), t);
            Vec3::new(part(0), part(1), part(2))
        };
        let series = |plate: &ambulo_body::motion::ForceRecording| LoadSeries {
            body: plate.body,
            points: grid.times().iter().map(|t| at(&plate.times, &plate.point, *t)).collect(),
            wrenches: grid
                .times()
                .iter()
                .map(|t| Wrench {
                    moment: at(&plate.times, &plate.moment, *t),
                    force: at(&plate.times, &plate.force, *t),
                })
                .collect(),
        };
        let ground: Vec<LoadSeries> = plates.iter().map(series).collect();
        let generalized = inverse(&mut Workspace::new(model), &trajectory, &ground).generalized;
        let body_weight = model.mass() * model.gravity().norm();
        Some(Walk { muscles, trajectory, ground, generalized, body_weight, name })
    }

    /// A table of results of OpenSim, `STEM_MODEL END.sto`, one row per frame.
    pub(crate) fn reference(&self, stem: &str, end: &str) -> Table {
        let folder = shared_data::data().unwrap().join("muscles/opensim46");
        let table = storage(&folder.join(format!("{stem}_{}{end}.sto", self.name)));
        let grid = self.trajectory.grid();
        assert_eq!(table.times().unwrap().len(), grid.frames);
        for (frame, time) in table.times().unwrap().iter().enumerate() {
            assert!((time - grid.time(frame)).abs() < 1e-4, "{time}");
        }
        table
    }
}
