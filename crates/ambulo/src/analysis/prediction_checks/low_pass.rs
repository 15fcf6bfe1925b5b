//! Low-passed wrench of the whole body, and the soles in stance meanwhile.
//!
//!   p = (u × M₀ + h F) / (u · F)
//!
//! p is the centre of pressure, F and M₀ the ground's wrench averaged with a Gaussian window over time, h the mean
//! height of the ground.

use super::record::Record;
use crate::numerics::elementary::exp;
use crate::spatial::{Vec3, Wrench};

/// Frequency at which half the amplitude passes [Hz]. Soft tissue of the trunk vibrates faster after a foot strike.
const BANDWIDTH_HZ: f64 = 3.5;
/// Half-width of the window in standard deviations of the Gaussian: 0.11 s.
const REACH: f64 = 2.0;
/// Time between checked instants [s].
const EVERY_S: f64 = 0.02;
/// Centres of pressure are only used above this mean vertical force [body weights].
const LEAST_LOAD_BW: f64 = 0.3;
/// Shorter violations are noise [s].
pub(super) const SHORTEST_S: f64 = 0.1;

/// The low-passed record at regular times.
#[derive(Debug, Clone)]
pub(super) struct LowPassed {
    pub(super) instants: Vec<Instant>,
    /// Time between instants [s].
    pub(super) step_s: f64,
    /// Frames between instants.
    stride: usize,
    /// Half-width of the window in frames.
    reach: usize,
}

/// The low-passed record at one instant.
#[derive(Debug, Clone, Copy)]
pub(super) struct Instant {
    pub(super) frame: usize,
    pub(super) time_s: f64,
    /// Mean wrench of the ground on the body about the floor's origin.
    pub(super) mean: Wrench,
    /// Mean height of the ground under the feet in stance [m].
    height: f64,
    /// Whether a foot is in stance within the window.
    pub(super) any_foot_stands: bool,
    /// The foot in stance at this instant if the other one is not.
    pub(super) single_support_foot: Option<usize>,
}

/// Low-passes the record; instants closer to its ends than the half-width of the window are left out.
pub(super) fn low_passed(record: &Record) -> LowPassed {
    let sigma = (0.5 * std::f64::consts::LN_2).sqrt() / (std::f64::consts::PI * BANDWIDTH_HZ);
    let reach = record.frames_in(REACH * sigma);
    let weights: Vec<f64> = (0..=reach).map(|i| exp(-0.5 * (i as f64 * record.grid.step_s / sigma).powi(2))).collect();
    let stride = record.frames_in(EVERY_S);
    let end = record.grid.frames.saturating_sub(reach);
    let instants = (reach..end).step_by(stride).map(|frame| instant(record, frame, &weights)).collect();
    LowPassed { instants, step_s: stride as f64 * record.grid.step_s, stride, reach }
}

fn instant(record: &Record, frame: usize, weights: &[f64]) -> Instant {
    let reach = weights.len() - 1;
    let (mut sum, mut whole) = (Wrench::ZERO, 0.0);
    let (mut height, mut standing) = (0.0, 0.0);
    for near in frame - reach..=frame + reach {
        let weight = weights[near.abs_diff(frame)];
        whole += weight;
        sum.force += record.total[near].force * weight;
        sum.moment += record.total[near].moment * weight;
        for floor in record.stands_on.iter().filter_map(|on| on[near]) {
            height += weight * floor;
            standing += weight;
        }
    }
    let stands = |foot: usize| record.stands_on[foot][frame].is_some();
    Instant {
        frame,
        time_s: record.grid.time(frame),
        mean: Wrench { force: sum.force / whole, moment: sum.moment / whole },
        height: if standing > 0.0 { height / standing } else { 0.0 },
        any_foot_stands: standing > 0.0,
        single_support_foot: (0..2).find(|&foot| stands(foot) && !stands(1 - foot)),
    }
}

impl LowPassed {
    /// Sole points of the feet in stance within the window around an instant [m].
    pub(super) fn places(&self, record: &Record, instant: &Instant) -> Vec<Vec3> {
        let (first, last) = (instant.frame - self.reach, instant.frame + self.reach);
        let frames = (first..last).step_by(self.stride).chain([last]);
        let of_frame = |frame: usize| {
            let feet = record.soles.iter().zip(&record.stands_on);
            feet.filter(move |(_, on)| on[frame].is_some()).flat_map(move |(soles, _)| soles[frame])
        };
        frames.flat_map(of_frame).collect()
    }
}

impl Instant {
    /// The centre of pressure that the motion needs [m]; `None` at low load.
    pub(super) fn center(&self, record: &Record) -> Option<Vec3> {
        let Wrench { force, moment } = self.mean;
        let vertical = force.dot(&record.up);
        let is_loaded = vertical > LEAST_LOAD_BW * record.weight;
        is_loaded.then(|| (record.up.cross(&moment) + force * self.height) / vertical)
    }

    /// Vertical force that the motion needs [body weights].
    pub(super) fn vertical(&self, record: &Record) -> f64 {
        self.mean.force.dot(&record.up) / record.weight
    }
}
