//! Muscle forces over a whole motion.
//!
//! ```text
//! let net = inverse(&mut Workspace::new(&model), &trajectory, &ground);
//! let trial = solve_trial(&model, &set, &settings, &trajectory, &net.generalized)?;
//! let reader = trial.reader(&model, &trajectory, &ground);
//! let loads = contact_loads(&model, &trajectory, &reader, BySide::from_fn(|_| condyle_distance(None)));
//! ```

use crate::set::MuscleSet;
use crate::settings::{MuscleSettings, SolverError};
use crate::solver::{FrameValues, MuscleSolver};
use crate::wrap::Contact;
use ambulo_body::dynamics::{LoadSeries, ReactionReader};
use ambulo_body::kinematics::Trajectory;
use ambulo_body::model::{BodyId, CoordinateId, Model};
use std::collections::BTreeSet;

/// An unmet force above this share of the required one (or of 1 N.m) is reported.
const UNMET: f64 = 1e-6;

/// One muscle over a motion; one entry per frame.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MuscleSeries {
    /// Activations.
    pub activation: Vec<f64>,
    /// Tension [N].
    pub force: Vec<f64>,
    /// Length of the path [m].
    pub length: Vec<f64>,
    /// Lengthening speed of the path [m/s].
    pub speed: Vec<f64>,
    /// Number of frames in which an end of the path lies inside a surface, so that the path runs straight there.
    pub inside_frames: usize,
}

/// The motors at one coordinate over a motion; one entry per frame.
#[derive(Debug, Clone, PartialEq)]
pub struct ReserveSeries {
    /// The coordinate.
    pub coordinate: CoordinateId,
    /// Generalised force of its motors [N.m or N].
    pub force: Vec<f64>,
    /// What nothing could exert [N.m or N].
    pub unmet: Vec<f64>,
}

/// How much the muscles of a coordinate lacked: a quality of the result.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReserveUse {
    /// The coordinate.
    pub coordinate: CoordinateId,
    /// Largest force of its motors plus what was unmet, without sign [N.m or N].
    pub largest: f64,
    /// Its frame.
    pub frame: usize,
    /// Root mean square over the motion [N.m or N].
    pub rms: f64,
    /// Largest generalised force of the coordinate over the motion, without sign [N.m or N].
    pub net: f64,
}

/// Muscle forces over a motion.
#[derive(Debug, Clone, PartialEq)]
pub struct MuscleTrial {
    /// Every muscle, in the order of the set.
    pub muscles: Vec<MuscleSeries>,
    /// Every free coordinate.
    pub reserves: Vec<ReserveSeries>,
    /// The tensions as loads on the bodies that muscles touch.
    pub loads: Vec<LoadSeries>,
    /// Newton steps of each frame.
    pub iterations: Vec<usize>,
    /// Frames whose generalised forces could not be met within the bounds.
    pub unmet_frames: Vec<usize>,
    /// Largest net generalised force of each entry of `reserves`, without sign [N.m or N].
    net: Vec<f64>,
}

impl MuscleTrial {
    fn empty(solver: &MuscleSolver, set: &MuscleSet, frames: usize) -> MuscleTrial {
        let column = || Vec::with_capacity(frames);
        let muscle = |_| MuscleSeries {
            activation: column(),
            force: column(),
            length: column(),
            speed: column(),
            inside_frames: 0,
        };
        let reserve = |id: &CoordinateId| ReserveSeries { coordinate: *id, force: column(), unmet: column() };
        let load = |body| LoadSeries { body, points: Vec::with_capacity(frames), wrenches: Vec::with_capacity(frames) };
        MuscleTrial {
            muscles: set.muscles.iter().map(muscle).collect(),
            reserves: solver.coordinates().iter().map(reserve).collect(),
            loads: pulled_bodies(set).into_iter().map(load).collect(),
            iterations: Vec::with_capacity(frames),
            unmet_frames: Vec::new(),
            net: vec![0.0; solver.coordinates().len()],
        }
    }

    fn push(&mut self, frame: usize, values: &FrameValues) {
        for (i, series) in self.muscles.iter_mut().enumerate() {
            series.activation.push(values.activations[i]);
            series.force.push(values.forces[i]);
            series.length.push(values.lengths[i]);
            series.speed.push(values.speeds[i]);
        }
        for (i, series) in self.reserves.iter_mut().enumerate() {
            series.force.push(values.reserves[i]);
            series.unmet.push(values.unmet[i]);
            self.net[i] = self.net[i].max(values.required[i].abs());
        }
        for series in &mut self.loads {
            let load = values.body_loads[series.body.index()];
            series.points.push(load.point);
            series.wrenches.push(load.wrench);
        }
        let Some(convergence) = values.convergence else { return };
        self.iterations.push(convergence.iterations);
        let is_unmet = |(unmet, required): (&f64, &f64)| unmet.abs() > UNMET * (1.0 + required.abs());
        if !convergence.is_met || values.unmet.iter().zip(&values.required).any(is_unmet) {
            self.unmet_frames.push(frame);
        }
    }

    /// Reactions of all joints with the tensions of the muscles; `ground` are the loads of the net inverse dynamics.
    #[must_use]
    pub fn reader<'a>(&self, model: &Model, trajectory: &'a Trajectory, ground: &[LoadSeries]) -> ReactionReader<'a> {
        let loads = ground.iter().chain(&self.loads).cloned().collect();
        ReactionReader::new(model, trajectory, loads)
    }

    /// What the muscles lacked at each free coordinate, in the order of `reserves`.
    #[must_use]
    pub fn reserve_use(&self) -> Vec<ReserveUse> {
        let use_of = |(series, net): (&ReserveSeries, &f64)| {
            let lacking = |frame: usize| series.force[frame].abs() + series.unmet[frame].abs();
            let count = series.force.len();
            let frame = (0..count).max_by(|a, b| lacking(*a).total_cmp(&lacking(*b))).unwrap_or(0);
            let squares: f64 = (0..count).map(|frame| lacking(frame) * lacking(frame)).sum();
            ReserveUse {
                coordinate: series.coordinate,
                largest: lacking(frame),
                frame,
                rms: (squares / count.max(1) as f64).sqrt(),
                net: *net,
            }
        };
        self.reserves.iter().zip(&self.net).map(use_of).collect()
    }
}

/// Muscle forces of every frame of a motion with the generalised forces of inverse dynamics: one column per coordinate,
/// one entry per frame.
///
/// # Errors
/// See [`SolverError`].
///
/// # Panics
/// If `generalized` has other columns or frames than the trajectory.
pub fn solve_trial(
    model: &Model,
    set: &MuscleSet,
    settings: &MuscleSettings,
    trajectory: &Trajectory,
    generalized: &[Vec<f64>],
) -> Result<MuscleTrial, SolverError> {
    let frames = trajectory.grid().frames;
    assert!(
        generalized.len() == model.coordinates().len() && generalized.iter().all(|column| column.len() == frames),
        "generalised forces of another motion"
    );
    let mut solver = MuscleSolver::new(model, set, settings)?;
    let mut trial = MuscleTrial::empty(&solver, set, frames);
    let mut forces = vec![0.0; generalized.len()];
    trajectory.for_each_posture(|frame, posture| {
        for (force, column) in forces.iter_mut().zip(generalized) {
            *force = column[frame];
        }
        trial.push(frame, solver.frame(posture, &forces));
        for (i, series) in trial.muscles.iter_mut().enumerate() {
            series.inside_frames += usize::from(solver.paths().contacts(i).contains(&Contact::EndInside));
        }
    });
    Ok(trial)
}

/// The bodies on which muscles pull.
fn pulled_bodies(set: &MuscleSet) -> Vec<BodyId> {
    let points = set.muscles.iter().flat_map(|muscle| &muscle.path.points).filter_map(|point| point.body);
    let bodies: BTreeSet<BodyId> = points.chain(set.wraps.iter().filter_map(|wrap| wrap.body)).collect();
    bodies.into_iter().collect()
}
