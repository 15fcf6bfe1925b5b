//! Results as bytes: the tables and the summary that a shell writes to files.

mod consistency_summary;
mod cycle_table;
mod files;
mod outcome;
mod prediction_files;
mod scene_summary;
mod scene_tables;
mod subject_summary;
mod summary;
mod tables;
mod walk_summary;

pub use consistency_summary::{ConsistencySummary, CoordinateSize, FootSize, ResidualSize};
pub use cycle_table::{CycleRow, cycle_rows};
pub use files::{OutputFile, output_files};
pub use outcome::{outcome_summary, outcome_tables, predicted_analysis};
pub use prediction_files::prediction_files;
pub use scene_summary::{
    ContactSummary, ConvergenceSummary, EnergySummary, SceneExtremes, SceneInput, SceneSummary, WorldSummary,
};
pub use scene_tables::SceneTables;
pub use subject_summary::{
    EventAgreementSummary, MarkerErrorSummary, MarkersSummary, PlateContactSummary, PlateCornersSummary,
    SegmentSummary, SubjectSummary,
};
pub use summary::{
    FilterSummary, Filters, Ground, GroundSource, Input, MassKnowledge, PeakSummary, ResidualSummary, Summary, summary,
};
pub use tables::ground_columns;
pub use walk_summary::{PelvisPath, Size, SolverStage, WalkSummary};
