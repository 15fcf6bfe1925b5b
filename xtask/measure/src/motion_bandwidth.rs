//! The bandwidth of recorded markers: the frequency below which nearly all of their acceleration lies.
//!
//!   P(f) = Σ over axes and pieces |DFT(h (x(t + dt) - 2 x(t) + x(t - dt)))|²        Σ_{f <= b} P(f) = 0.99 Σ P(f)
//!
//! | code        | symbol | meaning                                          |
//! |-------------|--------|--------------------------------------------------|
//! | `positions` | x      | a marker's place, in pieces of 1.28 s without gap |
//! | `window`    | h      | Hann's window                                    |
//!
//! b is the median over the fastest quarter of the markers. White noise of a marker grows with f⁴ in its acceleration,
//! so raw markers have a b near half of the frame rate; markers that were low-passed before publication have no noise
//! floor, and a b somewhat above the cut-off frequency.

use ambulo::motion::MarkerRecording;
use ambulo::numerics::elementary::{cos, sin};
use ambulo::numerics::median;
use ambulo::spatial::Vec3;
use std::f64::consts::TAU;

/// Length of a piece, and the least length in a short recording [s].
const PIECE_S: f64 = 1.28;
const LEAST_S: f64 = 0.5;
/// Share of the power below the bandwidth.
const SHARE: f64 = 0.99;
/// Share of the markers that count: the fastest.
const FASTEST: f64 = 0.25;

/// The bandwidth [Hz]; `None` for recordings of less than half a second.
pub(crate) fn bandwidth(recording: &MarkerRecording) -> Option<f64> {
    let frames = recording.times.len().checked_sub(2)?;
    let length = ((PIECE_S * recording.rate_hz) as usize).min(frames);
    if (length as f64) < LEAST_S * recording.rate_hz {
        return None;
    }
    let waves: Vec<[f64; 2]> =
        (0..length).map(|i| TAU * i as f64 / length as f64).map(|angle| [cos(angle), sin(angle)]).collect();
    let spectra = recording.markers.iter().filter_map(|marker| spectrum(&marker.positions, &waves));
    let mut spectra: Vec<(f64, Vec<f64>)> = spectra.map(|power| (power.iter().sum(), power)).collect();
    spectra.sort_by(|a, b| b.0.total_cmp(&a.0));
    spectra.truncate((FASTEST * spectra.len() as f64).ceil() as usize);
    let step_hz = recording.rate_hz / length as f64;
    median(spectra.iter().map(|(whole, power)| step_hz * place(power, SHARE * whole)))
}

/// Mean power of the acceleration of a marker over its pieces without gaps, which overlap by half; `None` without one.
fn spectrum(positions: &[Vec3], waves: &[[f64; 2]]) -> Option<Vec<f64>> {
    let length = waves.len();
    let (mut power, mut pieces) = (vec![0.0; length / 2 + 1], 0.0);
    for piece in positions.windows(length + 2).step_by(length / 2) {
        if piece.iter().any(|place| !place.x.is_finite()) {
            continue;
        }
        pieces += 1.0;
        let window = |i: usize| 0.5 * (1.0 - waves[i][0]);
        let bent: Vec<Vec3> = (0..length).map(|i| (piece[i + 2] - piece[i + 1] * 2.0 + piece[i]) * window(i)).collect();
        for (k, power) in power.iter_mut().enumerate() {
            let (mut even, mut odd) = (Vec3::zeros(), Vec3::zeros());
            for (i, bent) in bent.iter().enumerate() {
                let [cosine, sine] = waves[(i * k) % length];
                even += bent * cosine;
                odd += bent * sine;
            }
            *power += even.norm_squared() + odd.norm_squared();
        }
    }
    (pieces > 0.0).then(|| power.iter().map(|sum| sum / pieces).collect())
}

/// Index up to which the numbers sum to this.
fn place(power: &[f64], wanted: f64) -> f64 {
    let mut sum = 0.0;
    let reaches = |x: &f64| {
        sum += x;
        sum >= wanted
    };
    power.iter().position(reaches).unwrap_or(power.len()) as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use ambulo::motion::MarkerPath;
    use ambulo::numerics::Random;

    /// Markers that move at 1 and 3 Hz, with noise.
    fn recording(noise_m: f64) -> MarkerRecording {
        let mut random = Random::seeded(3);
        let times: Vec<f64> = (0..300).map(|i| 0.01 * f64::from(i)).collect();
        let path = |k: usize| {
            let mut at = |t: f64| Vec3::new(sin(TAU * t), 0.1 * sin(TAU * 3.0 * t), noise_m * random.normal());
            MarkerPath { name: format!("M{k}"), positions: times.iter().map(|t| at(*t)).collect() }
        };
        let markers = [0, 1, 2, 3].map(path).to_vec();
        MarkerRecording { name: "test".to_owned(), rate_hz: 100.0, times, markers }
    }

    #[test]
    fn smooth_markers_end_where_their_motion_ends_and_noise_reaches_half_of_the_frame_rate() {
        let (smooth, noisy) = (bandwidth(&recording(0.0)).unwrap(), bandwidth(&recording(2e-3)).unwrap());
        assert!((3.0..5.0).contains(&smooth), "{smooth}");
        assert!(noisy > 40.0, "{noisy}");
    }

    #[test]
    fn a_short_recording_has_none() {
        let mut short = recording(0.0);
        short.times.truncate(40);
        short.markers.iter_mut().for_each(|marker| marker.positions.truncate(40));
        assert!(bandwidth(&short).is_none());
    }
}
