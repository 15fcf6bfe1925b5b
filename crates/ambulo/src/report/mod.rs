//! Results as bytes: the tables, the summary and the figures that a shell writes to files.

pub mod clinical;
mod consistency_summary;
mod cycle_table;
mod exchange;
pub mod figures;
mod files;
mod html;
pub mod normative;
pub mod page;
mod prediction_files;
mod reproduction;
mod reproduction_page;
mod scene_shapes;
mod scene_summary;
mod scene_tables;
mod scene_verdict;
mod stage;
pub mod style;
mod subject_summary;
mod summary;
mod tables;
mod walk_summary;

pub use consistency_summary::{ConsistencySummary, CoordinateSize, FootSize, ResidualSize};
pub use cycle_table::{CycleRow, cycle_rows};
pub use exchange::{
    ExchangeError, Glb, GroundReactions, LaboratoryError, bvh_of_folder, c3d_of_markers, csv_of_folder, glb_of_folder,
    glb_of_motion, ground_reactions, laboratory_recording, marker_paths, skeleton_of, standing_recording,
    table_of_markers, trc_of_markers,
};
pub use figures::{CycleFigures, FigureError, Mark, SceneCurves, gait_figure, paper_figure};
pub use files::{OutputError, OutputFile, output_files};
pub use prediction_files::prediction_files;
pub use reproduction::reproduction_files;
pub use reproduction_page::reproduction_page;
pub use scene_shapes::scene_shapes;
pub use scene_summary::{
    ContactSummary, ConvergenceSummary, EnergySummary, SceneExtremes, SceneInput, SceneSummary, WorldSummary,
};
pub use scene_tables::SceneTables;
pub use scene_verdict::{FigureVerdict, SceneVerdict, scene_verdict};
pub use subject_summary::{
    EventAgreementSummary, MarkerErrorSummary, MarkersSummary, PlateContactSummary, PlateCornersSummary,
    SegmentSummary, SubjectSummary,
};
pub use summary::{
    FilterSummary, Filters, Ground, GroundSource, Input, MassKnowledge, PeakSummary, ResidualSummary, Summary, summary,
};
pub use walk_summary::{PelvisPath, Size, SolverStage, WalkSummary};
