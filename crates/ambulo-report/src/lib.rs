//! Presents results: clinical curves with normative data, figures, the report page, and exchange formats.

#![cfg_attr(
    test,
    allow(clippy::disallowed_methods, reason = "expected values of tests may have the bits of the platform")
)]

mod batch;
mod clinical;
mod clinical_file;
mod exchange;
mod figure_files;
pub mod figures;
mod html;
mod normative;
pub mod page;
mod reproduction;
mod reproduction_page;
mod scene_shapes;
mod session;
mod stage;
pub mod style;
mod sweep;
mod validation;

/// For the tests of results and pages.
#[doc(hidden)]
pub mod internals {
    pub use crate::clinical::{ClinicalGroup, ClinicalNames, ClinicalQuantity, clinical_quantities};
    pub use crate::normative::{BAND_SAMPLES, NormalRange, band, dimensionless_speed, time_distance};
}

pub use batch::{BATCH_QUANTITIES, BatchQuantity, BatchTrial, batch_page};
pub use clinical_file::clinical_file;
pub use exchange::{
    ExchangeError, GroundReactions, bvh_of_folder, c3d_of_markers, csv_of_folder, glb_of_folder, glb_of_motion,
    ground_reactions, laboratory_recording, marker_paths, rig_of_folder, skeleton_of, standing_recording,
    table_of_markers, trc_of_markers,
};
pub use figure_files::{figure_files, outcome_figures};
#[doc(hidden)]
pub use figures::CycleFigures;
pub use figures::{FigureError, Mark, SceneCurves, gait_figure};
pub use reproduction::reproduction_files;
pub use reproduction_page::reproduction_page;
pub use scene_shapes::scene_shapes;
pub use session::{
    ComparedSession, ComputedTrial, ExcludedSummary, ProfileSummary, ReferenceGroup, ReferenceGroupError,
    RepresentativeSummary, SESSION_FORMAT, Session, SessionFacts, SessionSummary, SessionTrial, Spread, TrialSummary,
    session_from_files,
};
pub use stage::quaternion;
pub use sweep::{SweptConditions, SweptWalk, WalkCurves, sweep_files};
pub use validation::{ListedTrial, listed_section, validation_files};
