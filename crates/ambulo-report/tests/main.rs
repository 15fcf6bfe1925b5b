//! Tests of the report, its pages and its figures.
//!
//! All are modules of one program, which links faster and takes less space than a program each.

#![allow(clippy::disallowed_methods, reason = "expected values of tests may have the bits of the platform")]
#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]
#![allow(clippy::print_stdout, reason = "what a test measured or skipped is shown with --show-output")]

mod report_pages;
#[path = "../../ambulo/tests/shared_data/mod.rs"]
mod shared_data;
mod svg_reader;

mod charts;
mod clinical_file;
mod clinical_signs;
mod figures;
mod gait_figure;
mod normative;
mod recurvatum;
mod report_page;
mod report_page_files;
mod report_page_measured;
mod report_page_scene;
mod report_page_trust;
mod report_page_words;
mod viewer_bundle;
