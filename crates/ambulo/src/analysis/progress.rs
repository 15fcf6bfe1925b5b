//! How a caller watches a long computation and stops it.

use std::ops::ControlFlow;

/// A stage of the computation from a recording to forces.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Stage {
    /// The axes of the laboratory.
    Axes,
    /// Calibration or scaling of the body.
    Body,
    /// The fit of the body to markers or to a skeleton.
    Markers,
    /// Events from the motion of the feet, and which foot was on which force plate.
    Feet,
    /// Smoothing of the motion.
    Smoothing,
    /// Prediction of the ground forces.
    Prediction,
    /// Forces of the plates alongside a prediction.
    Plates,
    /// Measured ground forces on the frames of the motion.
    Ground,
    /// Inverse dynamics.
    InverseDynamics,
    /// Events, cycles, body mass and residual.
    Analysis,
    /// Checks of the prediction, and its comparison with the plates.
    Checks,
    /// Tracking by feet on the ground.
    Tracking,
    /// Residual reduction.
    ResidualReduction,
    /// Feasibility for a person.
    Feasibility,
}

impl Stage {
    /// The name in `timings.json`.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Stage::Axes => "axes",
            Stage::Body => "body",
            Stage::Markers => "markers",
            Stage::Feet => "feet",
            Stage::Smoothing => "smooth",
            Stage::Prediction => "prediction",
            Stage::Plates => "plates",
            Stage::Ground => "ground",
            Stage::InverseDynamics => "inverse_dynamics",
            Stage::Analysis => "analysis",
            Stage::Checks => "checks",
            Stage::Tracking => "tracking",
            Stage::ResidualReduction => "consistency",
            Stage::Feasibility => "feasibility",
        }
    }
}

/// The observer stopped the computation.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("stopped after the stage `{}`", .after.word())]
pub struct Stopped {
    /// The last stage that was completed.
    pub after: Stage,
}

/// Passes the end of each stage to an observer, if there is one.
#[derive(Default)]
pub struct Progress<'a> {
    observer: Option<&'a mut dyn FnMut(Stage) -> ControlFlow<()>>,
}

impl<'a> Progress<'a> {
    /// Tells this observer the end of each stage.
    pub fn watched_by(observer: &'a mut dyn FnMut(Stage) -> ControlFlow<()>) -> Progress<'a> {
        Progress { observer: Some(observer) }
    }

    /// Reports the end of a stage; an error if the observer asks to stop.
    pub fn end(&mut self, stage: Stage) -> Result<(), Stopped> {
        match self.observer.as_mut().map(|observer| observer(stage)) {
            Some(ControlFlow::Break(())) => Err(Stopped { after: stage }),
            Some(ControlFlow::Continue(())) | None => Ok(()),
        }
    }
}
