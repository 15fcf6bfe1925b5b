//! The costs of the feedback of a controller in a scene file.

use super::SceneError;
use crate::control::TrackingCosts;
use crate::toml_reader::Table;

/// Largest ratio between a cost and its default, upwards and downwards; beyond it, rounding determines the feedback.
const MOST: f64 = 1000.0;

/// The costs of the table `costs` of `control`; the usual ones where it has none.
pub(super) fn read(control: &Table<'_>, usual: TrackingCosts) -> Result<TrackingCosts, SceneError> {
    let Some(value) = control.get("costs") else { return Ok(usual) };
    let table = value.table("{ angle_deg = …, torque = … }")?;
    table.only(&[
        &["angle_deg", "angle", "rate_deg", "rate", "pelvis_deg", "pelvis"],
        &["height", "sideways", "velocity", "velocity_up", "torque"],
    ])?;
    let cost = |key: &str, usual: f64| {
        let Some((value, unit)) = table.either_unit(key)? else { return Ok(usual) };
        let [least, most] = [usual / MOST, usual * MOST].map(|bound| bound / unit);
        let found = value.above_zero()?;
        if !(least..=most).contains(&found) {
            return Err(value.wrong(&format!("a number from {least:.1e} to {most:.1e}")));
        }
        Ok(found * unit)
    };
    Ok(TrackingCosts {
        angle: cost("angle", usual.angle)?,
        rate: cost("rate", usual.rate)?,
        pelvis: cost("pelvis", usual.pelvis)?,
        height: cost("height", usual.height)?,
        sideways: cost("sideways", usual.sideways)?,
        velocity: [cost("velocity", usual.velocity[0])?, cost("velocity_up", usual.velocity[1])?],
        torque: cost("torque", usual.torque)?,
    })
}
