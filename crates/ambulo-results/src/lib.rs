//! Results of a run as types that are written to files and read back: summary, tables and file names.

mod consistency_summary;
mod convention;
mod cycle_table;
mod file_names;
mod files;
mod folder;
mod force_unit;
mod json_place;
mod keep;
mod muscle_summary;
mod muscle_tables;
mod outcome;
mod prediction_files;
mod run_summary;
mod scene_summary;
mod scene_tables;
mod sound;
mod state_table;
mod stream_columns;
mod subject_summary;
mod summary;
mod tables;
mod timings;
mod tracking_summary;
mod units;
mod walk_summary;
mod walking_summary;

/// Source of the ground forces of [`Input`].
pub use ambulo::study::ForceOrigin as GroundSource;
pub use consistency_summary::{ChangeUnit, ConsistencySummary, CoordinateSize, FootSize};
pub use convention::{Convention, ConventionSummary};
pub use cycle_table::{CONTACT_LOADS, CycleRow, JOINT_MOMENTS, contact_rows, cycle_rows};
pub use file_names::{
    BATCH, BATCH_PAGE, CLAIMS, CLINICAL, CLOSURES, CONTACT_REACTIONS, CONTACTS, CYCLES, EMG, ENERGY, EVENTS,
    EXTERNAL_LOADS, FIGURE, FOOT_CONTACT, GROUND, GROUND_MEASURED, GROUND_SD, JOINTS, KINEMATICS, KINEMATICS_RECORDED,
    MOMENTS, MOMENTS_BIOLOGICAL, MUSCLES, PAGE, POSES, POWERS, REACTIONS, REFERENCE_GROUP, SCENE_REACTIONS,
    SESSION_PAGE, SHAPES, STANCES, STATES, SUBJECT, SUMMARY, TIMES_AND_DISTANCES, TIMINGS, VALIDATION_PAGE, WALKS,
};
pub use files::{OutputFile, WriteError, output_files};
pub use folder::{BODIES, Folder, ResultsError, error_chain};
pub use force_unit::ForceUnit;
pub use json_place::json_place;
pub use keep::Keep;
#[doc(hidden)]
pub use muscle_summary::{EmgSummary, ReserveSummary};
pub use muscle_summary::{MuscleOrigin, MuscleSummary};
pub use outcome::outcome_tables;
pub use prediction_files::deviation_columns;
#[cfg(feature = "schema")]
pub use run_summary::summary_schema;
pub use run_summary::{RunSummary, summary_json};
pub use scene_summary::{
    ContactSummary, ConvergenceSummary, EnergySummary, SceneExtremes, SceneInput, SceneSummary, WorldSummary,
};
pub use scene_tables::SceneTables;
pub use sound::{EXPECTED, is_sound};
pub use state_table::states_csv;
pub use stream_columns::{columns_of_predictions, stream_columns, stream_row};
pub use subject_summary::{
    EventAgreementSummary, EventOrigin, HipsSummary, KneeSummary, MarkerErrorSummary, MarkersSummary,
    PlateContactSummary, PlateCornersSummary, RegionSummary, SegmentSummary, SubjectSummary,
};
pub use summary::{
    FilterKind, FilterSummary, Filters, Ground, GroundOrigin, Input, MeasuredShare, PeakSummary, ResidualSummary,
    Summary, outcome_summary,
};
pub use tables::ground_columns;
pub use timings::Timings;
pub use tracking_summary::TrackingSummary;
pub use units::{is_storage, unit_of};
pub use walk_summary::{DeviceWorkSummary, PaceChangeSummary, PelvisPath, WalkPredictionSummary, WalkSummary};
pub use walking_summary::{
    QuantitySummary, SpreadSummary, WalkingSummary, contact_load_summary, knee_adduction_summary,
};

/// For the tests of this crate.
#[doc(hidden)]
pub mod internals {
    pub use crate::cycle_table::{HEAD as CYCLES_HEAD, read as read_cycles};
    pub use crate::scene_tables::RowTable;
    pub use crate::state_table::{HEAD as STATES_HEAD, read as read_states};
}
