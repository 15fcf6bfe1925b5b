//! Results as bytes: the tables, the summary and the figures that a shell writes to files.

mod cycle_table;
mod figure;
mod files;
mod summary;
mod tables;

pub use cycle_table::{CycleRow, cycle_rows};
pub use figure::{FigureError, moments_figure};
pub use files::{OutputError, OutputFile, output_files};
pub use summary::{
    FilterSummary, Filters, Ground, GroundSource, Input, PeakSummary, ResidualSummary, Summary, summary,
};
