//! The results of a study.

use super::mass::BodyMass;
use super::muscle_outcome::MuscleOutcome;
use super::origin::{ForceOrigin, Tracking};
use super::quality::Quality;
use crate::analysis::activity::Activity;
use crate::analysis::feasibility::{Person, Verdict};
use crate::analysis::{
    Analysis, AnalysisSettings, ComparedAnalyses, GroundAgreement, PlateCoverage, PredictionChecks, TimesAndDistances,
};
use crate::dynamics::residual_reduction::ReducedMotion;
use crate::ground::footfalls::Footfalls;
use crate::ground::predict::Prediction;
use crate::ground::stances::{Stance, measured_share};
use crate::model::{BySide, CoordinateId, Model, Side};
use crate::motion::filter::LowPass;
use crate::motion::{Smoother, Window};

/// Everything that [`super::run`] found. It is complete when it exists: only a run makes one.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Outcome {
    /// The body: given, scaled or calibrated, with added masses, and with what residual reduction changed.
    pub body: Model,
    /// Stature and soles.
    pub person: Person,
    /// Motion, ground forces, joint forces, events, cycles, body mass and residual.
    pub analysis: Analysis,
    /// The activity of the person; the limits of the verdict follow it.
    pub activity: Activity,
    /// Speed, cadence, lengths, stance, swing and support.
    pub times_and_distances: TimesAndDistances,
    /// Where the ground forces come from.
    pub force_origin: ForceOrigin,
    /// By how much the measured forces are late against the motion [s], negative if they are early; `None` where no
    /// delay was found.
    pub force_delay_s: Option<f64>,
    /// The prediction, with its checks and its comparison with measured forces; `None` where forces were measured or
    /// are none.
    pub prediction: Option<PredictedGround>,
    /// The body mass by each source, and how well it is known.
    pub mass: BodyMass,
    /// How the body follows markers or a skeleton; `None` for coordinates and complete motions.
    pub tracking: Option<Tracking>,
    /// Residual reduction: the changed motion and body; `None` where nothing was changed.
    pub residual_reduction: Option<ReducedMotion>,
    /// Generalised forces of a worn device on the frames of the motion, one column per coordinate [N.m or N].
    pub device: Option<Vec<Vec<f64>>>,
    /// Coordinates of pelvis and legs that nothing recorded determines: held at one value, or on a limit in more than a
    /// tenth of the frames. Their angles and powers are no results.
    pub not_measured: Vec<CoordinateId>,
    /// Whether the recording, the body and the forces fit together: about the data.
    pub quality: Quality,
    /// Whether a person could do this: about the movement.
    pub verdict: Verdict,
    /// The stances of both feet with the source of their loads, in order of time; empty for a simulated motion.
    pub stances: Vec<Stance>,
    /// The analysis with predicted forces where a loaded foot was not measured: [`Outcome::complete`] chooses.
    pub(super) completed: Option<Analysis>,
    /// Filters and time range that were used.
    pub processing: Processing,
    /// Checksum of the name of the person in the file of the recording, if it has one.
    pub subject: Option<u64>,
    /// Muscle forces; `None` where they were not asked for.
    pub muscles: Option<MuscleOutcome>,
}

/// Filters and time range that were used.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Processing {
    /// How the motion was smoothed.
    pub smoother: Smoother,
    /// Low-pass of the measured forces.
    pub force_filter: Option<LowPass>,
    /// The requested time range, or the range that long gaps of markers leave.
    pub window: Window,
}

impl Processing {
    pub(super) fn of(settings: &AnalysisSettings) -> Processing {
        let AnalysisSettings { smoother, force_filter, window, .. } = *settings;
        Processing { smoother, force_filter, window }
    }
}

/// A motion near the recorded one whose external forces come from feet on the ground alone.
#[derive(Debug, Clone, PartialEq)]
pub struct TrackedGround {
    /// Residual forces at the root in the frames: root mean square and maximum [body weights, body weights × leg
    /// length].
    pub residual: (f64, f64),
    /// Root mean square of the changes of rotations [rad], and of the translations of the root [m].
    pub moved: [f64; 2],
    /// Largest change of each rotation [rad], by the name of its coordinate.
    pub turned: Vec<(String, f64)>,
    /// Largest distance of a hand from its place in the recorded motion, relative to the trunk [m]; `None` without
    /// arms.
    pub hands_m: Option<f64>,
    /// Steps of the solver.
    pub steps: usize,
    /// How the prediction that it started from agrees with measured forces; `None` where nothing was measured
    /// completely.
    pub predicted: Option<GroundAgreement>,
}

/// Predicted ground forces.
#[derive(Debug, Clone)]
pub struct PredictedGround {
    /// The prediction.
    pub prediction: Prediction,
    /// Whether it can be right.
    pub checks: PredictionChecks,
    /// The same motion with the measured forces; `None` where there are none.
    pub measured: Option<Analysis>,
    /// The stances that the plates measured completely; `None` without plates.
    pub coverage: Option<PlateCoverage>,
    /// How prediction (or tracking) and measurement agree; `None` where nothing was measured completely.
    pub agreement: Option<GroundAgreement>,
    /// How the motion was changed so that feet on the ground supply its external forces; `None` where it was not.
    pub tracked: Option<TrackedGround>,
}

impl PredictedGround {
    /// The stances of the motion of an analysis, if this was predicted from the same motion.
    pub(super) fn stances(&self, analysis: &Analysis, settings: AnalysisSettings) -> Option<&Footfalls> {
        (analysis.recorded.is_none() && settings.filters_as_the_prediction()).then_some(&self.prediction.footfalls)
    }
}

impl Outcome {
    /// The analysis that tables and figures show: of the measured forces, with predicted ones in the stances that were
    /// not measured. Events, cycles, mass and residual come from [`Outcome::analysis`].
    #[must_use]
    pub fn complete(&self) -> &Analysis {
        self.completed.as_ref().unwrap_or(&self.analysis)
    }

    /// Of the time in which a leg was loaded, the share in which its load was measured; `None` if no force was
    /// measured, or if the leg was never loaded.
    #[must_use]
    pub fn measured_share(&self, side: Side) -> Option<f64> {
        let is_measured = matches!(self.force_origin, ForceOrigin::Measured | ForceOrigin::Mixed { .. });
        measured_share(&self.stances, side).filter(|_| is_measured)
    }

    /// For each frame the source of the load of a foot, as [`StanceSource::number`]; a foot in the air is measured.
    /// `None` if all loads of the motion were measured, or none.
    #[must_use]
    pub fn load_sources(&self) -> Option<BySide<Vec<f64>>> {
        let others: Vec<&Stance> = self.stances.iter().filter(|stance| !stance.source.is_measured()).collect();
        let is_mixed = matches!(self.force_origin, ForceOrigin::Measured | ForceOrigin::Mixed { .. });
        let grid = self.analysis.trajectory.grid();
        let at = |side: Side, time_s: f64| {
            let own = others.iter().filter(|stance| stance.side == side);
            let now = own.filter(|stance| (stance.start_s..=stance.end_s).contains(&time_s));
            now.map(|stance| stance.source.number()).fold(0.0, f64::max)
        };
        let of_side = |side: Side| (0..grid.frames).map(|frame| at(side, grid.time(frame))).collect();
        (is_mixed && !others.is_empty()).then(|| BySide::from_fn(of_side))
    }

    /// How prediction and measured forces agree on what a coverage names, such as a part of the stances; `None` without
    /// measured forces, or if the coverage is empty.
    #[must_use]
    pub fn agreement_over(&self, coverage: &PlateCoverage) -> Option<GroundAgreement> {
        let PredictedGround { prediction, measured, .. } = self.prediction.as_ref()?;
        let measured = measured.as_ref()?;
        let compared = ComparedAnalyses { model: &self.body, predicted: &self.analysis, prediction, measured };
        compared.agreement(coverage)
    }

    /// Stature [m], where it is known rather than estimated from the joints of a model.
    #[must_use]
    pub fn height_m(&self) -> Option<f64> {
        (!self.person.estimated).then_some(self.person.height_m)
    }
}
