//! The subcommands, one module each.

pub(crate) mod batch;
pub(crate) mod calibrate;
pub(crate) mod compare;
pub(crate) mod convert;
pub(crate) mod demo;
pub(crate) mod events;
pub(crate) mod forces;
pub(crate) mod info;
pub(crate) mod report;
pub(crate) mod reproduce;
mod result_folder;
mod results;
pub(crate) mod run;
mod run_files;
pub(crate) mod session;
mod side_by_side;
pub(crate) mod simulate;
mod stopwatch;
pub(crate) mod stream;
pub(crate) mod sweep;
mod trials;
pub(crate) mod tune;
pub(crate) mod validate;
pub(crate) mod view;
pub(crate) mod walk;

pub use results::Results;
