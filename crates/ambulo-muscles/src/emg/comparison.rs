//! Computed activations compared with EMG.
//!
//! r is Pearson's correlation of an envelope with the mean activation of the muscles of the model that share its fibres
//! on its side, at the frames of the motion. EMG precedes force: with a delay d, the activation at t is compared with
//! the envelope at t - d. Use d = 0 unless a delay is known: it differs between muscles and contractions, and a delay
//! chosen for the largest r would make every comparison look better than it is.
//!
//! r says whether two curves rise and fall together; it says nothing about size.
//!
//! Pinned by: tests/emg_comparison.rs, tests/emg_against_opensim.rs

use super::{AnatomicalMuscle, EmgEnvelope};
use ambulo_body::model::Side;
use ambulo_body::motion::TimeGrid;
use ambulo_body::numerics::correlation;

/// One channel of EMG compared with a model.
#[derive(Debug, Clone, PartialEq)]
pub struct EmgComparison {
    /// Name of the channel.
    pub channel: String,
    /// The muscle.
    pub muscle: AnatomicalMuscle,
    /// Its side.
    pub side: Side,
    /// Muscles of the model whose mean activation was compared.
    pub model_muscles: Vec<String>,
    /// Number of frames at which both are known.
    pub frames: usize,
    /// Correlation over these frames, -1 to 1.
    pub r: f64,
}

/// Compares each channel that holds a muscle with the activations of a model: names of muscles with one value per
/// frame of `grid`. `delay_s` is how much later than EMG the activation is expected [s].
///
/// Channels without a side, without a muscle in the model, or with fewer than three common frames are left out.
#[must_use]
pub fn compare(
    envelopes: &[EmgEnvelope],
    activations: &[(&str, &[f64])],
    grid: TimeGrid,
    delay_s: f64,
) -> Vec<EmgComparison> {
    const FEWEST: usize = 3;
    let known: Vec<_> = activations
        .iter()
        .filter_map(|(name, values)| match AnatomicalMuscle::of_name(name)? {
            (muscle, Some(side)) => Some((*name, *values, muscle, side)),
            _ => None,
        })
        .collect();
    let mut comparisons = Vec::new();
    for envelope in envelopes.iter().filter(|envelope| envelope.signal.is_muscle()) {
        let Some(side) = envelope.side else { continue };
        let is_same =
            |muscle: AnatomicalMuscle, other: Side| other == side && muscle.shares_fibres_with(envelope.muscle);
        let same: Vec<_> = known.iter().filter(|(_, _, muscle, other)| is_same(*muscle, *other)).collect();
        let pairs: Vec<[f64; 2]> = (0..grid.frames)
            .filter_map(|frame| {
                let emg = envelope.at(grid.time(frame) - delay_s)?;
                let values = same.iter().map(|(_, values, ..)| values.get(frame).copied());
                let sum = values.sum::<Option<f64>>()?;
                Some([emg, sum / same.len() as f64])
            })
            .collect();
        if same.is_empty() || pairs.len() < FEWEST {
            continue;
        }
        let [emg, activation] = [0, 1].map(|i| pairs.iter().map(|pair| pair[i]).collect::<Vec<f64>>());
        comparisons.push(EmgComparison {
            channel: envelope.channel.clone(),
            muscle: envelope.muscle,
            side,
            model_muscles: same.iter().map(|(name, ..)| (*name).to_owned()).collect(),
            frames: pairs.len(),
            r: correlation(&emg, &activation),
        });
    }
    comparisons
}
