//! Functions of time that drives, motors and obstacles follow.

use super::samples::Samples;
use crate::model::Function;
use crate::numerics::NaturalSpline;
use crate::numerics::elementary::sin_cos;
use std::f64::consts::TAU;
use std::sync::Arc;

/// A function of time [s], twice differentiable; values in rad or m.
#[derive(Debug, Clone)]
pub enum Signal {
    /// A constant value.
    Constant(f64),
    /// offset + amplitude sin(2π frequency t + phase).
    Sine {
        /// Amplitude.
        amplitude: f64,
        /// Frequency [Hz].
        frequency_hz: f64,
        /// Phase at time zero [rad].
        phase: f64,
        /// Mean value.
        offset: f64,
    },
    /// Stops at given instants (time [s], value), times rising. Between two stops a quintic with zero velocity and
    /// acceleration at its ends; constant outside.
    Stops(Vec<(f64, f64)>),
    /// A natural spline, and the time of the spline at time zero of the world [s]; constant outside the spline.
    Spline(NaturalSpline, f64),
    /// A function of time, and its argument at time zero of the world [s].
    OfTime(Function, f64),
    /// A function of another signal, for a coordinate that a coupler drives.
    Of(Function, Box<Signal>),
    /// A parabola with value, rate and acceleration at an instant [s], for a step that ends there.
    Near(f64, [f64; 3]),
    /// One column of samples.
    Sampled(Arc<Samples>, usize),
}

/// Largest spacing of the samples of a cycle [s].
const SAMPLE_STEP_S: f64 = 1e-3;

impl Signal {
    /// One signal per column of a motion that repeats every `cycle_s`; `motion` fills one entry (value, rate,
    /// acceleration) per column.
    ///
    /// The motion is sampled every millisecond: between samples of a gait, angles differ by less than 1e-9 rad, and
    /// accelerations by what a jump of the third derivative makes in a millisecond.
    ///
    /// # Panics
    /// If the cycle is not above zero.
    #[must_use]
    pub fn periodic(columns: usize, cycle_s: f64, motion: impl FnMut(f64, &mut [[f64; 3]])) -> Vec<Signal> {
        let samples = Arc::new(Samples::new(columns, cycle_s, SAMPLE_STEP_S, motion));
        (0..columns).map(|column| Signal::Sampled(Arc::clone(&samples), column)).collect()
    }

    /// One signal per column of a motion from time zero to `span_s`, sampled like [`Signal::periodic`]; constant after
    /// it.
    ///
    /// # Panics
    /// If the span is not above zero.
    #[must_use]
    pub fn over(columns: usize, span_s: f64, motion: impl FnMut(f64, &mut [[f64; 3]])) -> Vec<Signal> {
        let samples = Arc::new(Samples::over(columns, span_s, SAMPLE_STEP_S, motion));
        (0..columns).map(|column| Signal::Sampled(Arc::clone(&samples), column)).collect()
    }

    /// Value, first and second derivative.
    #[must_use]
    pub fn at(&self, t: f64) -> [f64; 3] {
        match self {
            Signal::Constant(value) => [*value, 0.0, 0.0],
            Signal::Sine { amplitude, frequency_hz, phase, offset } => {
                let omega = TAU * frequency_hz;
                let (sin, cos) = sin_cos(omega * t + phase);
                [offset + amplitude * sin, amplitude * omega * cos, -amplitude * omega * omega * sin]
            }
            Signal::Stops(stops) => between_stops(stops, t),
            Signal::Spline(spline, start) => {
                let (first, last) = (spline.times().first(), spline.times().last());
                match (first, last) {
                    (Some(first), _) if t + start < *first => [spline.value(*first), 0.0, 0.0],
                    (_, Some(last)) if t + start > *last => [spline.value(*last), 0.0, 0.0],
                    _ => spline.value_and_two_derivatives(t + start),
                }
            }
            Signal::OfTime(function, start) => function.at(t + start),
            Signal::Near(at_s, [value, rate, acceleration]) => {
                let dt = t - at_s;
                [value + dt * (rate + 0.5 * dt * acceleration), rate + dt * acceleration, *acceleration]
            }
            Signal::Sampled(samples, column) => samples.at(*column, t),
            Signal::Of(function, leader) => following(function, leader.at(t)),
        }
    }

    /// The value alone; cheaper than [`Signal::at`] for samples.
    #[must_use]
    pub fn value(&self, t: f64) -> f64 {
        match self {
            Signal::Constant(value) => *value,
            Signal::Sampled(samples, column) => samples.value(*column, t),
            Signal::Of(function, leader) => function.at(leader.value(t))[0],
            _ => self.at(t)[0],
        }
    }
}

/// A function of a signal, with its derivatives in time.
#[inline]
fn following(function: &Function, [x, rate, acceleration]: [f64; 3]) -> [f64; 3] {
    let [y, dy, ddy] = function.at(x);
    [y, dy * rate, dy * acceleration + ddy * rate * rate]
}

/// Reads many signals at one instant: samples on one grid look for their place in it once.
#[derive(Debug)]
pub struct Instant<'a> {
    time_s: f64,
    /// The last samples, and the place of the instant on their grid.
    last: Option<(&'a Samples, (usize, f64))>,
}

impl<'a> Instant<'a> {
    /// An instant without readings.
    pub fn new(time_s: f64) -> Instant<'a> {
        Instant { time_s, last: None }
    }

    /// [`Signal::at`].
    #[inline]
    pub fn at(&mut self, signal: &'a Signal) -> [f64; 3] {
        match signal {
            Signal::Sampled(samples, column) => samples.at_place(*column, self.place(samples)),
            Signal::Of(function, leader) => following(function, self.at(leader)),
            _ => signal.at(self.time_s),
        }
    }

    /// [`Signal::value`].
    #[inline]
    pub fn value(&mut self, signal: &'a Signal) -> f64 {
        match signal {
            Signal::Sampled(samples, column) => samples.value_at_place(*column, self.place(samples)),
            Signal::Of(function, leader) => function.at(self.value(leader))[0],
            _ => signal.value(self.time_s),
        }
    }

    fn place(&mut self, samples: &'a Samples) -> (usize, f64) {
        match self.last {
            Some((last, place)) if std::ptr::eq(last, samples) => place,
            _ => {
                let place = samples.place(self.time_s);
                self.last = Some((samples, place));
                place
            }
        }
    }
}

/// x(s) = x0 + (x1 - x0) (10 s³ - 15 s⁴ + 6 s⁵), s from 0 to 1: zero velocity and acceleration at both ends.
fn between_stops(stops: &[(f64, f64)], t: f64) -> [f64; 3] {
    let after = stops.partition_point(|(time, _)| *time <= t);
    let (Some((_, last)), Some((_, first))) = (stops.last(), stops.first()) else { return [0.0; 3] };
    if after == 0 {
        return [*first, 0.0, 0.0];
    }
    if after == stops.len() {
        return [*last, 0.0, 0.0];
    }
    let ((t0, x0), (t1, x1)) = (stops[after - 1], stops[after]);
    let (span, rise) = (t1 - t0, x1 - x0);
    let s = (t - t0) / span;
    let (s2, s3) = (s * s, s * s * s);
    [
        x0 + rise * s3 * (10.0 - 15.0 * s + 6.0 * s2),
        rise * 30.0 * s2 * (1.0 - 2.0 * s + s2) / span,
        rise * 60.0 * s * (1.0 - 3.0 * s + 2.0 * s2) / (span * span),
    ]
}
