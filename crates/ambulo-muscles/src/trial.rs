//! Muscle forces over a whole motion.
//!
//! ```ignore
//! let net = inverse(&mut Workspace::new(&model), &trajectory, &ground);
//! let trial = solve_trial(&model, &set, &settings, &trajectory, &net.generalized)?;
//! let reader = trial.reader(&model, &trajectory, &ground);
//! let loads = contact_loads(&model, &trajectory, &reader, BySide::from_fn(|_| condyle_distance(None)));
//! ```

use crate::body::dynamics::{LoadSeries, ReactionReader};
use crate::body::kinematics::Trajectory;
use crate::body::model::{CoordinateId, Model};
use crate::set::MuscleSet;
use crate::settings::{MuscleError, MuscleSettings};

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
/// See [`MuscleError`].
///
/// # Panics
/// If `generalized` has other columns or frames than the trajectory.
pub fn solve_trial(
    model: &Model,
    set: &MuscleSet,
    settings: &MuscleSettings,
    trajectory: &Trajectory,
    generalized: &[Vec<f64>],
) -> Result<MuscleTrial, MuscleError> {
    let _ = (model, set, settings, trajectory, generalized);
    Err(MuscleError::NoMuscles)
}
