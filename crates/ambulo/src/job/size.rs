//! The stated size of a person.

use super::error::{Field, JobError};
use crate::study::StatedSize;
use std::ops::RangeInclusive;

/// Accepted body masses [kg].
const BODY_MASS_KG: RangeInclusive<f64> = 2.0..=300.0;
/// Accepted statures [m].
const HEIGHT_M: RangeInclusive<f64> = 0.4..=2.5;

/// Rejects sizes that no person has.
pub(super) fn check(size: StatedSize) -> Result<(), JobError> {
    if let Some(mass) = size.mass_kg.filter(|mass| !BODY_MASS_KG.contains(mass)) {
        let (least, most) = (BODY_MASS_KG.start(), BODY_MASS_KG.end());
        let what = format!("the body mass is {mass} kg; expected {least} to {most} kg. hint: the unit is kilograms");
        return Err(JobError::new(&[Field::Mass], what));
    }
    if let Some(height) = size.height_m.filter(|height| !HEIGHT_M.contains(height)) {
        let (least, most) = (HEIGHT_M.start(), HEIGHT_M.end());
        let what = format!("the height is {height} m; expected {least} to {most} m. hint: metres, not centimetres");
        return Err(JobError::new(&[Field::Height], what));
    }
    Ok(())
}
