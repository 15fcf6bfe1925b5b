//! A standing trial, which several trials of a person share.

use super::laboratory_file::LaboratoryFile;
use crate::analysis::KnownBodies;
use std::ops::Deref;

/// A standing trial with the bodies that were calibrated or scaled from it: trials that share it calibrate the person,
/// or scale a model, once.
///
/// ```
/// use ambulo::model::anthropometry::SegmentTable;
/// use ambulo::study::{LaboratoryFile, MarkerBody, MarkerSource, StandingTrial};
/// use std::sync::Arc;
///
/// fn walks(standing: LaboratoryFile, walks: Vec<LaboratoryFile>) -> Vec<MarkerSource> {
///     let standing = Arc::new(StandingTrial::new(standing));
///     let of_walk = |trial| MarkerSource {
///         trial,
///         standing: Some(Arc::clone(&standing)),
///         body: MarkerBody::BuiltIn { table: SegmentTable::DeLevaMale, mass_kg: None, height_m: None, set: None },
///         plates: Vec::new(),
///     };
///     walks.into_iter().map(of_walk).collect()
/// }
/// ```
#[derive(Debug)]
pub struct StandingTrial {
    file: LaboratoryFile,
    pub(super) bodies: KnownBodies,
}

impl StandingTrial {
    /// A standing trial from which no body was made yet.
    #[must_use]
    pub fn new(file: LaboratoryFile) -> StandingTrial {
        StandingTrial { file, bodies: KnownBodies::default() }
    }
}

impl Deref for StandingTrial {
    type Target = LaboratoryFile;

    fn deref(&self) -> &LaboratoryFile {
        &self.file
    }
}
