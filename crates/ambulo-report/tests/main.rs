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

mod batch_page;
mod charts;
mod clinical_file;
mod clinical_signs;
mod figure_axes;
mod figure_sheet;
mod figure_style;
mod figure_svg;
mod figures;
mod gait_figure;
mod glb;
mod html_text;
mod moving_picture;
mod normative;
mod page_cells;
mod page_contract;
mod page_deviations;
mod page_extracted_values;
mod page_live;
mod page_machines;
mod page_names;
mod page_numbers;
mod page_pace;
mod page_verdict_limits;
mod recurvatum;
mod report_page;
mod report_page_files;
mod report_page_measured;
mod report_page_muscles;
mod report_page_scene;
mod report_page_trust;
mod report_page_words;
mod session_panels;
mod session_quantities;
mod stage;
mod viewer_bundle;
