//! Apparent gravity in flight phases: a clock that runs wrongly shows as a body that falls too slowly or too fast.
//!
//! While nothing touches the person, the mass centre falls with g. If the stated frame rate is k times the true one,
//! every time is 1/k of the true time and the apparent acceleration is k² g; a film in slow motion falls slowly. One
//! published subset of AMASS states half of its true rate.
//!
//! A flight is a time in which the lowest point of both feet is higher than [`CLEAR_M`] above its usual lowest place.
//! On it a parabola is fitted to the height of the mass centre; where the parabola leaves more than [`UNEXPLAINED`] of
//! the variance, something carried the person. Pinned by: tests/smpl_motions.rs

use crate::model::Model;
use crate::motion::{MarkerRecording, Motion};
use crate::numerics::elementary::powi;
use crate::numerics::{median, quantiles};
use crate::spatial::STANDARD_GRAVITY;
use std::ops::Range;

/// Height of both feet above the floor in flight [m]: more than a heel rises while the toes stand, with toes and heels
/// tracked.
const CLEAR_M: f64 = 0.05;
/// Fewest frames of a flight.
const FRAMES: usize = 6;
/// Largest share of the variance of the height that a parabola may leave.
const UNEXPLAINED: f64 = 0.02;
/// Smallest rise and fall within a flight [m]: less shows no acceleration.
const SHORTEST_FALL_M: f64 = 0.02;
/// Points of the feet in recordings of skeletons, without their sides.
const FOOT_POINTS: [&str; 4] = ["heel", "ankle", "toe", "toe_tip"];
/// Quantile of the height of the lowest point that is the floor.
const FLOOR: f64 = 0.05;
/// A frame rate that is wrong by this factor contradicts gravity. The shape of the body and the filter of the file
/// change the apparent gravity too.
pub const WRONG_CLOCK: f64 = 1.25;

/// The acceleration with which a person falls in flight, from which a wrong frame rate shows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FlightGravity {
    /// Median apparent gravity at the stated frame rate [m/s²].
    pub gravity: f64,
    /// Number of flights.
    pub flights: usize,
    /// The stated frame rate [Hz].
    pub stated_hz: f64,
}

impl FlightGravity {
    /// Measures the fall of the mass centre in the flights of a skeleton; `None` if there is no flight.
    #[must_use]
    pub fn of(model: &Model, motion: &Motion, markers: &MarkerRecording) -> Option<FlightGravity> {
        let lowest = lowest_points(markers);
        let [floor] = quantiles(lowest.iter().copied(), [FLOOR])?;
        let height = |frame: usize| {
            let value = |column: &Option<Vec<f64>>| column.as_ref().map_or(0.0, |column| column[frame]);
            model.mass_center(&motion.columns.iter().map(value).collect::<Vec<f64>>()).y
        };
        let fallen = |flight: Range<usize>| {
            let times: Vec<f64> = flight.clone().map(|frame| motion.times[frame]).collect();
            gravity_of(&times, &flight.map(height).collect::<Vec<f64>>())
        };
        let found: Vec<f64> = flights(&lowest, floor + CLEAR_M).into_iter().filter_map(fallen).collect();
        let gravity = median(found.iter().copied())?;
        Some(FlightGravity { gravity, flights: found.len(), stated_hz: markers.rate_hz })
    }

    /// The frame rate at which the person falls with g [Hz].
    #[must_use]
    pub fn rate_hz(&self) -> f64 {
        self.stated_hz / (self.gravity / STANDARD_GRAVITY).sqrt()
    }

    /// The factor by which the stated frame rate is wrong, 1 or more.
    #[must_use]
    pub fn wrong_by(&self) -> f64 {
        let factor = self.rate_hz() / self.stated_hz;
        factor.max(factor.recip())
    }
}

/// Height of the lowest point of both feet in every frame; not a number where a foot is not known.
fn lowest_points(markers: &MarkerRecording) -> Vec<f64> {
    let is_foot = |name: &str| {
        FOOT_POINTS.iter().any(|point| name.strip_prefix(point).is_some_and(|s| ["_r", "_l"].contains(&s)))
    };
    let feet: Vec<_> = markers.markers.iter().filter(|path| is_foot(&path.name)).collect();
    let lowest = |frame: usize| {
        feet.iter().map(|path| path.positions[frame].y).reduce(|a, b| if a < b || a.is_nan() { a } else { b })
    };
    (0..markers.frames()).map(|frame| lowest(frame).unwrap_or(f64::NAN)).collect()
}

/// Runs of frames above a height.
fn flights(lowest: &[f64], clear: f64) -> Vec<Range<usize>> {
    let (mut found, mut start) = (Vec::new(), 0);
    for frame in 0..=lowest.len() {
        if lowest.get(frame).is_some_and(|y| *y > clear) {
            continue;
        }
        if frame - start >= FRAMES {
            found.push(start..frame);
        }
        start = frame + 1;
    }
    found
}

/// Downward acceleration of a parabola through these heights; `None` if no parabola fits.
fn gravity_of(times: &[f64], heights: &[f64]) -> Option<f64> {
    let (first, last) = (times.first()?, times.last()?);
    let (middle, half) = (0.5 * (first + last), 0.5 * (last - first));
    let s: Vec<f64> = times.iter().map(|t| (t - middle) / half).collect();
    let rows = nalgebra::DMatrix::from_fn(s.len(), 3, |i, power| powi(s[i], power as i32));
    let values = nalgebra::DVector::from_column_slice(heights);
    let normal = rows.tr_mul(&rows).try_inverse()?;
    let fit = normal * rows.tr_mul(&values);
    let mean = values.mean();
    let total: f64 = values.iter().map(|y| (y - mean).powi(2)).sum();
    let left = (&rows * &fit - &values).norm_squared();
    let range = heights.iter().fold(f64::MIN, |a, b| a.max(*b)) - heights.iter().fold(f64::MAX, |a, b| a.min(*b));
    let is_fall = total.is_finite() && left <= UNEXPLAINED * total && range >= SHORTEST_FALL_M && fit[2] < 0.0;
    is_fall.then(|| -2.0 * fit[2] / half.powi(2))
}
