//! The stated size of a person whose model is given.

use crate::args::SubjectArgs;
use ambulo::study::StatedSize;
use anyhow::{Result, bail};
use std::ops::RangeInclusive;

/// Accepted body masses [kg].
const BODY_MASS_KG: RangeInclusive<f64> = 2.0..=300.0;
/// Accepted statures [m].
const HEIGHT_M: RangeInclusive<f64> = 0.4..=2.5;

/// Mass and stature from the options.
pub(super) fn stated(args: &SubjectArgs) -> StatedSize {
    StatedSize { mass_kg: args.mass, height_m: args.height }
}

/// Rejects sizes that no person has.
pub(super) fn check(args: &SubjectArgs) -> Result<()> {
    if let Some(mass) = args.mass.filter(|mass| !BODY_MASS_KG.contains(mass)) {
        let (least, most) = (BODY_MASS_KG.start(), BODY_MASS_KG.end());
        bail!("--mass: the body mass is {mass} kg; expected {least} to {most} kg. hint: the unit is kilograms");
    }
    if let Some(height) = args.height.filter(|height| !HEIGHT_M.contains(height)) {
        let (least, most) = (HEIGHT_M.start(), HEIGHT_M.end());
        bail!("--height: the height is {height} m; expected {least} to {most} m. hint: metres, not centimetres");
    }
    Ok(())
}
