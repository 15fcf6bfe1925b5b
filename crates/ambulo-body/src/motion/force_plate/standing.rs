//! Body weight from quiet standing on force plates.

use super::PlateRecording;
use crate::numerics::quantiles;

/// Smallest total force of a person [N].
const PERSON_N: f64 = 50.0;
/// In quiet standing nine tenths of the loaded samples are within this share of their median.
const STILL_SHARE: f64 = 0.1;

/// The median of the total force of all plates [N], if a person stands still on them; `None` otherwise. Divided by g it
/// is the body mass, if both feet are on plates.
#[must_use]
pub fn standing_weight_n(plates: &[PlateRecording]) -> Option<f64> {
    let samples = plates.iter().map(|p| p.times.len()).min()?;
    let total = |i: usize| plates.iter().map(|p| p.vertical(i)).sum::<f64>();
    let loaded: Vec<f64> = (0..samples).map(total).filter(|x| *x > PERSON_N).collect();
    let [low, middle, high] = quantiles(loaded.iter().copied(), [0.05, 0.5, 0.95])?;
    let still = middle - low <= STILL_SHARE * middle && high - middle <= STILL_SHARE * middle;
    (still && 2 * loaded.len() > samples).then_some(middle)
}
