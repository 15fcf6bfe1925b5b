//! Low-pass filters of the evidence, symmetric in time.
//!
//! * Of the required force: a Gaussian G, exp(-t² / 2σ²), half the amplitude at the bandwidth f, σ = √(ln 2 / 2) / (π
//!   f).
//! * Of the estimated vertical force in running: the same, and the filter H that the motion has passed, whose gain is 1
//!   / (1 + (f / f_c)^(2 order)) ([`LowPass`]). The required force comes from filtered motion; what is compared with it
//!   must have lost the same, and steps of running have their second harmonic at the cut-off frequency of 6 Hz.
//!
//!   k(t) ∝ ∫ 2^(-(ν / f)²) / (1 + (ν / f_c)^(2 order)) cos(2π ν t) dν
//!
//! * Of the vertical force, required and estimated, where the motion had been smoothed before it was recorded (its own
//!   bandwidth b is below [`SMOOTHED_HZ`]), in walking: a Gaussian with the bandwidth 3 b. Such a motion has no noise
//!   above b that the narrower filter would keep out, and its smoothing leaves a part of what lies there. On ten people
//!   of the one laboratory with such recordings the vertical error falls by 11 % at their own speed and by 3 % in fast
//!   walking (measured during development); with more noise assumed in place of less filtering it rises.
//! * Of all other estimated forces and moments: the Gaussian alone. They have little between 4 and 6 Hz but the strike,
//!   which markers do not show; with H as well their noise is amplified: in walking the errors of subjects left out
//!   were 3 % larger, in running the fore-aft error rose from 4.6 to 6.1 % of body weight (measured during
//!   development).

use super::stances::{GaitType, Stance};
use crate::motion::TimeGrid;
use crate::motion::filter::LowPass;
use crate::numerics::elementary::{cos, exp, powi};
use std::f64::consts::{LN_2, PI, TAU};

/// Spacing of the coefficients [s].
const EVERY_S: f64 = 0.0125;
/// Half of the length of the Gaussian, in σ.
const REACH: f64 = 3.5;
/// A filter ends where its coefficients stay below this share of the largest.
const NEGLIGIBLE: f64 = 0.01;
/// Longest half of a filter [s]: a filter at the lowest allowed cut-off frequency is cut there.
const LONGEST_S: f64 = 0.5;
/// Frequencies of the quadrature for each bandwidth, up to this multiple of it.
const PER_BANDWIDTH: usize = 50;
const HIGHEST: f64 = 3.0;

/// A motion with a lower bandwidth was smoothed before: markers that their publishers low-passed at 6 Hz have 5.5 to
/// 7.3 Hz, other recordings 7.4 Hz and more, raw ones 20 and more [Hz].
pub(crate) const SMOOTHED_HZ: f64 = 7.4;

/// Whether a motion of this bandwidth was smoothed before it was recorded.
#[must_use]
pub fn is_smoothed(motion_hz: Option<f64>) -> bool {
    motion_hz.is_some_and(|own_hz| own_hz < SMOOTHED_HZ)
}

/// Bandwidth of the filter of the vertical force over that of a motion that was smoothed before.
const OF_SMOOTHED: f64 = 3.0;

/// The filters of both sides of the equations.
#[derive(Debug, Clone)]
pub(super) struct EvidenceFilters {
    /// Filter of the force that the motion requires, and of most estimated forces.
    pub(super) gaussian: EvidenceFilter,
    /// Filter of the vertical force in running; `None` without running, or if the motion was not filtered.
    running: Option<EvidenceFilter>,
    /// Filter of the vertical force of a walk that was smoothed before; `None` for others, and with running.
    smoothed: Option<EvidenceFilter>,
}

/// Components of a wrench, forces before moments along forward, up and right, that pass a filter.
type Passing = &'static [usize];
const ALL: Passing = &[0, 1, 2, 3, 4, 5];
const UP: Passing = &[1];
const ALL_BUT_UP: Passing = &[0, 2, 3, 4, 5];

impl EvidenceFilters {
    /// `motion` is the filter that the motion has passed, if any, `motion_hz` its bandwidth before it.
    pub(super) fn new(
        bandwidth_hz: f64,
        motion: Option<LowPass>,
        motion_hz: Option<f64>,
        grid: TimeGrid,
        stances: &[Stance],
    ) -> EvidenceFilters {
        let runs = stances.iter().any(|stance| stance.gait == GaitType::Run);
        let running = motion.filter(|_| runs).map(|motion| EvidenceFilter::of_motion(bandwidth_hz, motion, grid));
        let walks = stances.iter().any(|stance| stance.gait == GaitType::Walk) && !runs;
        let smoothed_hz = motion_hz.filter(|_| is_smoothed(motion_hz) && walks);
        // Never longer than the filter of the others.
        let smoothed = smoothed_hz.map(|own_hz| EvidenceFilter::gaussian(bandwidth_hz.max(OF_SMOOTHED * own_hz), grid));
        EvidenceFilters { gaussian: EvidenceFilter::gaussian(bandwidth_hz, grid), running, smoothed }
    }

    /// The filter of the required vertical force, where it has one of its own.
    pub(super) fn smoothed(&self) -> Option<&EvidenceFilter> {
        self.smoothed.as_ref()
    }

    /// The filters of the estimated wrench, and which of its components pass each of them in a type of gait.
    pub(super) fn estimated(&self) -> impl Iterator<Item = (&EvidenceFilter, impl Fn(GaitType) -> Passing + Copy)> {
        let (has_running, is_smoothed) = (self.running.is_some(), self.smoothed.is_some());
        let passing = move |is_gaussian: bool| {
            move |gait: GaitType| match (is_smoothed || has_running && gait == GaitType::Run, is_gaussian) {
                (true, false) => UP,
                (true, true) => ALL_BUT_UP,
                (false, false) => &[],
                (false, true) => ALL,
            }
        };
        let of_up = self.running.as_ref().or(self.smoothed.as_ref());
        let both = [Some(&self.gaussian), of_up].into_iter().zip([true, false]);
        both.filter_map(move |(filter, is_gaussian)| Some((filter?, passing(is_gaussian))))
    }

    /// The longest one.
    pub(super) fn longest(&self) -> &EvidenceFilter {
        self.running.as_ref().unwrap_or(&self.gaussian)
    }
}

/// Coefficients of a filter.
#[derive(Debug, Clone)]
pub struct EvidenceFilter {
    /// Frames between two coefficients.
    pub stride: usize,
    /// The middle coefficient and those on one side.
    weights: Vec<f64>,
}

impl EvidenceFilter {
    /// The Gaussian alone.
    pub fn gaussian(bandwidth_hz: f64, grid: TimeGrid) -> EvidenceFilter {
        let sigma = (0.5 * LN_2).sqrt() / (PI * bandwidth_hz);
        let (stride, step) = spacing(grid);
        let count = (REACH * sigma / step).ceil() as usize;
        let weights = (0..=count).map(|i| exp(-0.5 * (i as f64 * step / sigma).powi(2))).collect();
        EvidenceFilter { stride, weights }
    }

    /// The Gaussian and the filter that the motion has passed.
    pub fn of_motion(bandwidth_hz: f64, motion: LowPass, grid: TimeGrid) -> EvidenceFilter {
        let (stride, step) = spacing(grid);
        let frequencies = (0..=(HIGHEST * PER_BANDWIDTH as f64) as usize).map(|i| i as f64 / PER_BANDWIDTH as f64);
        let gains: Vec<[f64; 2]> = frequencies
            .map(|share| {
                let frequency = share * bandwidth_hz;
                let of_motion = 1.0 + powi(frequency / motion.cutoff_hz, 2 * motion.order as i32);
                [TAU * frequency, exp(-LN_2 * share * share) / of_motion * if frequency > 0.0 { 1.0 } else { 0.5 }]
            })
            .collect();
        let at = |time: f64| gains.iter().map(|[omega, gain]| gain * cos(omega * time)).sum::<f64>();
        let whole = at(0.0);
        let mut weights: Vec<f64> = (0..=(LONGEST_S / step) as usize).map(|i| at(i as f64 * step) / whole).collect();
        let last = weights.iter().rposition(|weight| weight.abs() > NEGLIGIBLE).unwrap_or(0);
        weights.truncate(last + 1);
        EvidenceFilter { stride, weights }
    }

    /// Half of its length, plus one frame.
    pub(super) fn reach_frames(&self) -> usize {
        self.stride * (self.weights.len() - 1) + 1
    }

    /// Half of its length, plus one frame [s].
    pub(super) fn reach_s(&self, grid: TimeGrid) -> f64 {
        self.reach_frames() as f64 * grid.step_s
    }

    /// Frames around a frame with their coefficients, which sum to one; fewer at the ends of the recording.
    pub fn around(&self, frame: usize, frames: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        let side = self.weights.len() as isize - 1;
        let inside = move |i: isize| {
            let tap = frame.checked_add_signed(i * self.stride as isize).filter(|tap| *tap < frames)?;
            Some((tap, self.weights[i.unsigned_abs()]))
        };
        let whole: f64 = (-side..=side).filter_map(inside).map(|(_, weight)| weight).sum();
        (-side..=side).filter_map(inside).map(move |(tap, weight)| (tap, weight / whole))
    }
}

/// Frames between two coefficients, and the time between them [s].
fn spacing(grid: TimeGrid) -> (usize, f64) {
    let stride = ((EVERY_S / grid.step_s + 1e-6) as usize).max(1);
    (stride, stride as f64 * grid.step_s)
}
