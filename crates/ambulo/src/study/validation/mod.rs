//! Predicted ground forces judged by force plates: trials, persons and kinds of trial, as figures and as tables.
//!
//! | figure | unit | definition |
//! |---|---|---|
//! | RMSE | % of body weight | root-mean-square difference over the whole stances of a foot on separate plates, where the plate carries more than 20 N |
//! | rRMSE | % | RMSE over the mean of the two ranges |
//! | r | - | Pearson's correlation of the same samples |
//! | in band | % | share of the samples within 1.645 predicted standard deviations; 90 % for a normal distribution |
//! | band/RMSE | - | mean half-width of that band over the RMSE |
//! | centre of pressure | mm | root-mean-square distance, samples weighted by the measured vertical force, where it exceeds 5 % of body weight |
//! | moments | N.m/kg | root-mean-square difference of the sagittal moment of hip, knee, ankle over the instrumented window and whole stances |
//! | events | ms | mean absolute difference of foot strikes and foot offs |
//!
//! Vertical is against gravity; fore-aft and lateral are along and across the walking direction, which in turns is that
//! of the pelvis in that stance. Agreements: [`GroundAgreement`](crate::analysis::GroundAgreement).
//!
//! **Means:** feet, then trials, then persons; a person with several trials of a kind counts once. What is not a number
//! is left out.
//!
//! **Kinds:** the recognised activity ([`crate::analysis::activity`]); walking is fast above a dimensionless speed of
//! [`FAST_WALKING`]; trials without markers on the trunk are a separate kind.
//! Pinned by: tests/validation.rs

pub mod baselines;
mod figures;
mod methods;
mod phase_errors;
mod stance_rows;
mod tables;
mod text_table;
mod trial;

pub use figures::{Component, Figure, LegJoint, kinds, over_kind, over_persons, persons};
pub use methods::Method;
pub use phase_errors::{PhaseError, phase_errors};
pub use stance_rows::{StanceRow, stance_rows};
pub use tables::{
    DEFINITIONS, SUMMARY, Section, centers, each_trial, events, forces, kind_means, method_means, moments, number,
    person_means, rmse_by_fifth, share_by_fifth, summary_cells,
};
pub use text_table::TextTable;
pub use trial::{FAST_WALKING, JudgedTrial, NotJudged, TrialKind};
