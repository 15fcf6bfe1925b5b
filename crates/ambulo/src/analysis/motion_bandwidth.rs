//! The bandwidth of a recorded motion: the frequency below which nearly all of the acceleration of the feet lies.
//!
//!   P(f) = Σ over axes and pieces |DFT(h (x(t + dt) - 2 x(t) + x(t - dt)))|²        Σ_{f <= b} P(f) = 0.99 Σ P(f)
//!
//! | code     | symbol | meaning                                                        |
//! |----------|--------|----------------------------------------------------------------|
//! | `places` | x      | rear and tip of a sole before any filter, in pieces of 1.28 s  |
//! | `window` | h      | Hann's window                                                  |
//!
//! b is the median over the four points: nothing moves faster than the feet. White noise of a point grows with f⁴ in
//! its acceleration, so raw recordings have a b far above what feet do; a motion that was low-passed before has no
//! noise floor, and a b somewhat above the cut-off frequency. Every input passes here, because the points come from the
//! coordinates of the body. Frequencies above [`HIGHEST_HZ`] are not told apart.

use super::recording::{AnalysisSettings, trajectory_within};
use crate::findings::Findings;
use crate::kinematics::each_body_motion;
use crate::model::anatomy::Sole;
use crate::model::{BySide, Model};
use crate::motion::{Motion, Smoother};
use crate::numerics::elementary::{cos, sin};
use crate::numerics::median;
use crate::spatial::Vec3;
use std::f64::consts::TAU;

/// Length of a piece, and the least length in a short recording [s].
const PIECE_S: f64 = 1.28;
const LEAST_S: f64 = 0.5;
/// Share of the power below the bandwidth.
const SHARE: f64 = 0.99;
/// Bandwidths from here on are all the same: raw motion [Hz].
pub const HIGHEST_HZ: f64 = 20.0;

/// The bandwidth of a recorded motion inside the time that is analysed [Hz], at most [`HIGHEST_HZ`]; `None` for less
/// than half a second, without soles, or where coordinates are missing.
#[must_use]
pub(super) fn motion_bandwidth(
    model: &Model,
    motion: &Motion,
    soles: &BySide<Option<Sole>>,
    settings: AnalysisSettings,
) -> Option<f64> {
    let as_recorded = AnalysisSettings { smoother: Smoother::Off, rate_hz: None, ..settings };
    let raw = trajectory_within(model, motion, &[], as_recorded, settings.window, &mut Findings::default()).ok()?;
    let points: Vec<_> = soles.values().flatten().flat_map(|sole| [sole.points[0], sole.points[2]]).collect();
    let mut places = vec![Vec::with_capacity(raw.grid().frames); points.len()];
    each_body_motion(model, &raw, |_, bodies| {
        for (places, point) in places.iter_mut().zip(&points) {
            places.push(bodies[point.body.index()].pose.place(point.place));
        }
    });
    let rate_hz = raw.grid().rate_hz();
    median(places.iter().filter_map(|places| bandwidth(places, rate_hz)).collect::<Vec<f64>>())
}

/// The bandwidth of the path of a point [Hz]; `None` for less than half a second, and for a point at rest.
pub fn bandwidth(places: &[Vec3], rate_hz: f64) -> Option<f64> {
    let length = ((PIECE_S * rate_hz) as usize).min(places.len().checked_sub(2)?);
    if (length as f64) < LEAST_S * rate_hz {
        return None;
    }
    let waves: Vec<[f64; 2]> =
        (0..length).map(|i| TAU * i as f64 / length as f64).map(|angle| [cos(angle), sin(angle)]).collect();
    let step_hz = rate_hz / length as f64;
    let highest = ((HIGHEST_HZ / step_hz) as usize).min(length / 2);
    let (mut power, mut whole) = (vec![0.0; highest + 1], 0.0);
    for piece in places.windows(length + 2).step_by((length / 2).max(1)) {
        let window = |i: usize| 0.5 * (1.0 - waves[i][0]);
        let bent: Vec<Vec3> = (0..length).map(|i| (piece[i + 2] - piece[i + 1] * 2.0 + piece[i]) * window(i)).collect();
        // Parseval: the whole power without its spectrum, half of it at positive frequencies.
        whole += 0.5 * length as f64 * bent.iter().map(Vec3::norm_squared).sum::<f64>();
        for (k, power) in power.iter_mut().enumerate() {
            let (mut even, mut odd) = (Vec3::zeros(), Vec3::zeros());
            for (i, bent) in bent.iter().enumerate() {
                let [cosine, sine] = waves[(i * k) % length];
                even += bent * cosine;
                odd += bent * sine;
            }
            *power += (even.norm_squared() + odd.norm_squared()) * if k == 0 { 0.5 } else { 1.0 };
        }
    }
    let mut sum = 0.0;
    let reaches = |power: &f64| {
        sum += power;
        sum >= SHARE * whole
    };
    let place = power.iter().position(reaches);
    (whole > 0.0).then(|| place.map_or(HIGHEST_HZ, |k| (k as f64 * step_hz).min(HIGHEST_HZ)))
}
