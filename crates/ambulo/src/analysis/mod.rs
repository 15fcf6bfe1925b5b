//! Analysis of a motion and its forces: events, gait cycles, peaks, residuals, feasibility, and agreement of curves.

pub mod activity;
mod comparison;
mod cycles;
mod event_agreement;
mod events;
pub mod feasibility;
mod fitted_feet;
mod foot_contact;
pub(crate) mod foot_progression;
mod functional_joints;
mod ground_agreement;
pub(crate) mod identity;
mod knee_axes;
mod known_bodies;
mod laboratory_recording;
mod marker_trial;
mod marker_use;
pub(crate) mod motion_bandwidth;
mod peaks;
pub(crate) mod plausibility;
mod predicted;
pub(crate) mod prediction_checks;
pub(crate) mod progress;
pub(crate) mod recording;
mod residual;
mod residual_reduction;
mod stance_load;
mod subject;
pub(crate) mod times_and_distances;
mod tracked;
pub(crate) mod walking_direction;
mod weighing;

pub use comparison::{Agreement, ComparisonError, Curve, compare};
pub use cycles::{CYCLE_SAMPLES, Cycle, cycles, over_cycle, over_cycle_of};
pub use event_agreement::{EventAgreement, event_agreement};
pub use events::{Contact, Event, EventKind, SHORTEST_CONTACT_S, contacts_from_force, events};
pub use foot_contact::{FootContact, foot_contact};
pub use foot_progression::foot_progression;
pub(crate) use functional_joints::joints_of_movement;
#[doc(hidden)]
pub use ground_agreement::ComparedSample;
pub use ground_agreement::{
    BandAgreement, CenterAgreement, ComparedAnalyses, ComparedStance, FootAgreement, ForceAgreement, GroundAgreement,
    MomentAgreement, PlateCoverage, compared_stances, ground_agreement,
};
#[doc(hidden)]
pub use known_bodies::KnownBodies;
pub use laboratory_recording::LaboratoryRecording;
#[doc(hidden)]
pub use marker_trial::MarkerTrial;
pub(crate) use marker_trial::fit_body_to_markers;
pub use marker_trial::{BodyInMotion, body_in_motion};
pub use marker_use::{LEAST_MARKER_SHARE, MarkerUse, marker_use};
pub use peaks::{Peak, peak};
pub use predicted::analyse_predicted_trajectory;
#[doc(hidden)]
pub use predicted::{PredictedAnalysis, PredictionInput};
pub(crate) use predicted::{predict_and_analyse, predicted_in_frames};
#[doc(hidden)]
pub use prediction_checks::{CheckSettings, CheckedPrediction, PlateMass};
pub use prediction_checks::{PredictionCheck, PredictionChecks, prediction_checks};
pub(crate) use progress::Progress;
pub use progress::{Stage, Stopped};
pub use recording::{Analysis, AnalysisError, Mass, MassSource, analyse, analyse_trajectory};
#[doc(hidden)]
pub use recording::{AnalysisSettings, ForceSource};
pub(crate) use recording::{analyse_measured, recorded_trajectory, trajectory_of_measured, vertical_by_side};
pub use residual::{Residual, residual, residual_sizes};
pub use residual_reduction::Adjustable;
pub(crate) use residual_reduction::reduce_residual;
pub use stance_load::stance_load;
#[doc(hidden)]
pub use subject::{BodySource, Subject};
pub use subject::{MarkerTrialError, ModelProtocol};
pub use times_and_distances::{
    Stride, StrideQuantity, StrideStatistics, TimesAndDistances, symmetry_index, times_and_distances,
};
pub use tracked::track;
pub(crate) use walking_direction::WalkingDirection;
pub(crate) use weighing::{weighed_standing, weighed_within};
