//! Analysis of a motion and its forces: events, gait cycles, peaks, residuals, feasibility, and agreement of curves.

pub mod activity;
mod comparison;
mod cycles;
mod event_agreement;
mod events;
pub mod feasibility;
pub(crate) mod foot_progression;
mod ground_agreement;
mod known_bodies;
mod laboratory_recording;
mod marker_trial;
mod peaks;
mod plausibility;
mod predicted;
pub(crate) mod prediction_checks;
pub(crate) mod progress;
pub(crate) mod recording;
mod residual;
mod residual_reduction;
mod subject;
pub(crate) mod times_and_distances;
mod tracked;
pub(crate) mod walking_direction;
mod weighing;

pub use comparison::{Agreement, ComparisonError, Curve, compare};
pub use cycles::{CYCLE_SAMPLES, Cycle, cycles, over_cycle, over_cycle_of};
pub use event_agreement::{EventAgreement, event_agreement};
pub use events::{Contact, Event, EventKind, SHORTEST_CONTACT_S, contacts_from_force, events};
pub use foot_progression::foot_progression;
pub use ground_agreement::{
    BandAgreement, CenterAgreement, ComparedAnalyses, ComparedSample, ComparedStance, FootAgreement, ForceAgreement,
    GroundAgreement, MomentAgreement, PlateCoverage, compared_stances, ground_agreement,
};
pub use known_bodies::KnownBodies;
pub use laboratory_recording::LaboratoryRecording;
pub(crate) use marker_trial::fit_body_to_markers;
pub use marker_trial::{BodyInMotion, MarkerTrial, body_in_motion};
pub use peaks::{Peak, peak};
pub(crate) use predicted::predict_and_analyse;
pub use predicted::{PredictedAnalysis, PredictionInput, analyse_predicted_trajectory};
pub use prediction_checks::{
    CheckSettings, CheckedPrediction, PlateMass, PredictionCheck, PredictionChecks, Weighing, prediction_checks,
};
pub(crate) use progress::Progress;
pub use progress::{Stage, Stopped};
pub use recording::{
    Analysis, AnalysisError, AnalysisSettings, ForceSource, Mass, MassSource, analyse, analyse_trajectory,
};
pub(crate) use recording::{analyse_measured, analyse_with_progress, recorded_trajectory};
pub use residual::{Residual, residual, residual_sizes, residual_within};
pub use residual_reduction::{Adjustable, reduce_residual};
pub use subject::{BodySource, MarkerTrialError, ModelProtocol, Subject};
pub use times_and_distances::{
    Stride, StrideQuantity, StrideStatistics, TimesAndDistances, symmetry_index, times_and_distances,
};
pub use tracked::track;
pub(crate) use walking_direction::WalkingDirection;
pub(crate) use weighing::{weighed_standing, weighed_within};
