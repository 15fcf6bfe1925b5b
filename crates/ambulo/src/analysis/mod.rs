//! What a reader wants to know of a motion and its forces: events, cycles, peaks, agreement.

mod agreed_motion;
mod body_mass;
mod comparison;
mod cycles;
mod event_agreement;
mod events;
pub mod feasibility;
mod ground_agreement;
mod marker_trial;
mod measured_cycles;
mod peaks;
mod plausibility;
mod predicted;
mod prediction_checks;
mod recording;
mod residual;
mod scene_verdict;
mod walking_direction;

pub use agreed_motion::{Adjustable, agree};
pub use body_mass::body_mass;
pub use comparison::{Agreement, ComparisonError, Curve, compare};
pub use cycles::{CYCLE_SAMPLES, Cycle, cycles, over_cycle};
pub use event_agreement::{EventAgreement, event_agreement};
pub use events::{Contact, Event, EventKind, SHORTEST_CONTACT_S, contacts, events};
pub use ground_agreement::{
    BandAgreement, CenterAgreement, Compared, FootAgreement, ForceAgreement, GroundAgreement, MomentAgreement, Seen,
    ground_agreement,
};
pub use marker_trial::{Body, BodyInMotion, LaboratoryRecording, MarkerTrialError, Subject, body_in_motion};
pub use peaks::{Peak, peak};
pub use plausibility::LARGE_RESIDUAL_BW;
pub use predicted::{
    PLATES_LOW_PASS, PredictOrder, PredictedAnalysis, analyse_predicted, analyse_predicted_trajectory,
};
pub use prediction_checks::{
    CarriedBy, CarriedMass, CheckOrder, CheckedPrediction, PredictionCheck, PredictionChecks, prediction_checks,
};
pub use recording::{Analysis, AnalysisError, ForceSource, Mass, MassSource, Settings, analyse, analyse_trajectory};
pub use residual::{Residual, residual, residual_sizes, residual_within};
pub use scene_verdict::{FigureVerdict, SceneVerdict, scene_verdict};
