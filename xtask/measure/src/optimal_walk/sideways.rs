//! Sideways ground force of people over stance, from the recordings with plates: mean over people of straight trials.

use crate::validate::recording::{Recording, straight};
use crate::workspace;
use ambulo::ground::feet;
use ambulo::ground::predict::Prescribed;
use ambulo::model::Side;
use ambulo::motion::Window;
use ambulo::spatial::Vec3;

/// Number of samples over stance.
pub(super) const SAMPLES: usize = 51;
/// Speeds of the trials [m/s].
const SPEEDS: [f64; 2] = [1.0, 1.5];

/// Medial force over stance [body weights], mean over people, and how many people there are.
pub(super) fn people() -> Result<(Vec<f64>, usize), String> {
    let mut means: Vec<Vec<f64>> = Vec::new();
    for recording in straight() {
        means.extend(person(&recording).map_err(|e| format!("{}: {e}", recording.label))?);
    }
    let count = means.len();
    let mean = (0..SAMPLES).map(|k| means.iter().map(|curve| curve[k]).sum::<f64>() / count as f64).collect();
    Ok((mean, count))
}

/// Mean over the complete stances on plates of a trial; `None` without such stances, and at speeds outside the range.
fn person(recording: &Recording) -> Result<Option<Vec<f64>>, String> {
    let source = recording.read(&workspace::data().join("data"))?;
    let outcome = recording.predict(&source, Prescribed::default())?;
    let speed = outcome.times_and_distances.speed_m_s.unwrap_or(0.0);
    if !(SPEEDS[0]..=SPEEDS[1]).contains(&speed) {
        return Ok(None);
    }
    let ground = outcome.prediction.as_ref().ok_or("nothing was predicted")?;
    let (measured, seen) = ground.measured.as_ref().zip(ground.coverage.as_ref()).ok_or("no plates")?;
    let grid = measured.trajectory.grid();
    let weight = outcome.body.mass() * outcome.body.gravity().norm();
    // Up × forward points to the left.
    let forward = outcome.times_and_distances.pelvis_velocity.ok_or("no pelvis")?;
    let left = Vec3::new(0.0, 1.0, 0.0).cross(&forward) * (1.0 / forward.norm());
    let feet = feet(&outcome.body, &measured.ground);
    let mut stances: Vec<Vec<f64>> = Vec::new();
    for &(side, [from, to]) in &seen.stances {
        let Some((_, foot)) = feet.iter().find(|(s, _)| *s == side) else { continue };
        let (first, count) = grid.inside(Window { from_s: Some(from), to_s: Some(to) });
        let part = &foot.force[first..first + count];
        let medial = if side == Side::Right { left } else { -left };
        stances.push(resampled(&part.iter().map(|force| force.dot(&medial) / weight).collect::<Vec<_>>()));
    }
    let count = stances.len() as f64;
    let mean = |k: usize| stances.iter().map(|curve| curve[k]).sum::<f64>() / count;
    Ok((!stances.is_empty()).then(|| (0..SAMPLES).map(mean).collect()))
}

/// A curve at equally spaced samples, linearly between its own.
pub(super) fn resampled(curve: &[f64]) -> Vec<f64> {
    let last = curve.len() - 1;
    let at = |k: usize| {
        let place = (last * k) as f64 / (SAMPLES - 1) as f64;
        let low = (place as usize).min(last.saturating_sub(1));
        let share = place - low as f64;
        curve[low] * (1.0 - share) + curve[(low + 1).min(last)] * share
    };
    (0..SAMPLES).map(at).collect()
}
