//! Results as bytes: the tables, the summary and the figures that a shell writes to files.

mod cycle_table;
mod figure;
mod files;
mod gait_figure;
mod scene_figures;
mod scene_summary;
mod scene_tables;
mod summary;
mod tables;

pub use cycle_table::{CycleRow, cycle_rows};
pub use figure::{FigureError, Mark, moments_figure};
pub use files::{OutputError, OutputFile, output_files};
pub use gait_figure::gait_figure;
pub use scene_figures::SceneCurves;
pub use scene_summary::{
    ContactSummary, ConvergenceSummary, EnergySummary, SceneExtremes, SceneInput, SceneSummary, WorldSummary,
};
pub use scene_tables::SceneTables;
pub use summary::{
    FilterSummary, Filters, Ground, GroundSource, Input, PeakSummary, ResidualSummary, Summary, summary,
};
