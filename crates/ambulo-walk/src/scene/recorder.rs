//! Records the walking figures of a scene, and figures that follow a recording, for their verdicts.

use super::motion_recorder::{FigureMotion, MotionRecorder};
use crate::control::{FigureRecorder, FigureWalk};
use crate::engine::state::WorldState;
use crate::engine::workspace::StepWorkspace;
use crate::engine::world::World;
use crate::kinematics::TrajectoryError;
use crate::spatial::Pose;

/// The recording of a figure.
#[derive(Debug, Clone)]
pub enum FigureRecord {
    /// A built figure that walks.
    Walk(Box<FigureWalk>),
    /// A figure that follows a recording.
    Motion(Box<FigureMotion>),
}

/// A recording under way.
#[derive(Debug, Clone)]
pub(super) enum Recorder {
    Walk(Box<FigureRecorder>),
    Motion(Box<MotionRecorder>),
}

impl Recorder {
    pub(super) fn before_step(&mut self, world: &World, state: &WorldState) {
        match self {
            Recorder::Walk(recorder) => recorder.before_step(world, state),
            Recorder::Motion(recorder) => recorder.before_step(state),
        }
    }

    /// Sets the drives of a figure whose machines read the simulation.
    pub(super) fn aim(&mut self, world: &mut World, state: &WorldState, end_s: f64) {
        if let Recorder::Walk(recorder) = self {
            recorder.aim(world, state, end_s);
        }
    }

    /// Whether the figure walked by its own torques and has fallen.
    pub(super) fn has_fallen(&self) -> bool {
        matches!(self, Recorder::Walk(recorder) if recorder.fall().is_some())
    }

    /// Time of the fall of a figure that walks by its own torques [s]; infinite while it is up. `None` for other
    /// figures.
    pub(super) fn falls_at(&self) -> Option<f64> {
        let Recorder::Walk(recorder) = self else { return None };
        recorder.is_controlled().then(|| recorder.fall().map_or(f64::INFINITY, |fall| fall.time_s))
    }

    /// Message about the fall of a figure that walks by its own torques.
    pub(super) fn fall(&self) -> Option<String> {
        let Recorder::Walk(recorder) = self else { return None };
        recorder.fall().map(|fall| recorder.description(&fall))
    }

    /// Whether machines of the figure read the simulation.
    pub(super) fn is_live(&self) -> bool {
        matches!(self, Recorder::Walk(recorder) if recorder.is_live())
    }

    /// Records a step; the wrenches of the workspace must have been read. `poses` are those at the start of the step.
    pub(super) fn after_step(
        &mut self,
        world: &World,
        poses: &[Pose],
        state: &WorldState,
        w: &StepWorkspace,
        step_s: f64,
        solved: bool,
    ) {
        match self {
            Recorder::Walk(recorder) => recorder.after_step(world, state, w, step_s, solved),
            Recorder::Motion(recorder) => recorder.after_step(world, poses, state, w, step_s),
        }
    }

    pub(super) fn record(&self, step_s: f64) -> Result<FigureRecord, TrajectoryError> {
        Ok(match self {
            Recorder::Walk(recorder) => FigureRecord::Walk(Box::new(recorder.walk(step_s)?)),
            Recorder::Motion(recorder) => FigureRecord::Motion(Box::new(recorder.motion(step_s)?)),
        })
    }
}
