//! The normal equations of the estimate, from prior and evidence.

use super::PredictError;
use super::evidence_filter::EvidenceFilters;
use super::expected::Expectation;
use super::samples::{EstimateInputs, StanceSample, StanceSamples, frames_of};
use super::stances::Stance;
use super::unknowns::{Curve, Unknowns};
use crate::numerics::{BandFactor, BandMatrix};
use crate::spatial::{Vec3, Wrench};
use std::ops::Range;

/// The total wrench is compared about this often [s]: at the bandwidth of [`super::FittedParameters`] neighbouring
/// frames are nearly equal.
const OBSERVED_EVERY_S: f64 = 0.04;
/// Near the ends of the recording, within the length of the filter, noise is larger by this factor.
const AT_THE_ENDS: f64 = 2.0;
/// Memory limit for the equations, whose inverse takes their place [bytes]: ten minutes of walking take 30 MB.
const MOST_BYTES: f64 = 1e9;
/// Index of the upward force among the equations.
const UP: usize = 1;
/// Smaller coefficients, as a share of a standard deviation of the noise, are neglected.
const NEGLIGIBLE: f64 = 1e-4;

/// Estimated values of the unknowns, and their covariances.
pub(super) struct Solution {
    pub(super) values: Vec<f64>,
    pub(super) covariances: Covariances,
}

/// Covariances of the unknowns.
pub(super) enum Covariances {
    /// All inside the band, for many frames.
    InBand(BandMatrix),
    /// Computed when they are needed, for a few frames: the inverse takes four fifths of the time of the whole
    /// estimate.
    OnDemand(BandFactor),
}

impl Covariances {
    /// Variance of a weighted sum of four neighbouring unknowns of a curve.
    pub(super) fn variance(&self, numbers: &[usize], weights: &[f64; 4]) -> f64 {
        match self {
            Covariances::OnDemand(factor) => {
                let entries: [(usize, f64); 4] = std::array::from_fn(|i| (numbers[i], weights[i]));
                factor.variance_of(&entries)
            }
            Covariances::InBand(covariances) => {
                let mut variance = 0.0;
                for (i, (n, a)) in numbers.iter().zip(weights).enumerate() {
                    variance += a * a * covariances.value(*n, *n);
                    for (m, b) in numbers[..i].iter().zip(weights) {
                        variance += 2.0 * a * b * covariances.value(*n, *m);
                    }
                }
                variance
            }
        }
    }
}

/// Inputs of the equations.
pub(super) struct NormalEquations<'a> {
    pub(super) inputs: &'a EstimateInputs<'a>,
    pub(super) unknowns: &'a Unknowns,
    /// One entry per stance.
    pub(super) expectations: &'a [Expectation<'a>],
    pub(super) filters: &'a EvidenceFilters,
    /// Frames whose total wrench is compared.
    pub(super) evidence: Range<usize>,
}

/// Six equations of a frame: forces and moments along three axes.
#[derive(Debug, Default)]
struct Rows {
    rest: [f64; 6],
    /// Coefficients of each unknown in the six equations.
    coefficients: Vec<[f64; 6]>,
}

impl Rows {
    /// Adds the wrench of a stance in one frame, with a weight: some rows of its mean and of the influence of its
    /// unknowns. `first` is the unknown of the first coefficient.
    fn add(
        &mut self,
        chosen: &[usize],
        sample: &StanceSample,
        curves: &[Curve; 6],
        axes: &[Vec3; 3],
        weight: f64,
        first: usize,
    ) {
        let expected = along(&sample.expected, axes);
        chosen.iter().for_each(|&row| self.rest[row] -= weight * expected[row]);
        for (part, curve) in sample.parts.iter().zip(curves) {
            // Zero in the rows that are not chosen.
            let along_axes = along(&part.unit, axes);
            let mut slopes = [0.0; 6];
            chosen.iter().for_each(|&row| slopes[row] = along_axes[row] * part.deviation * weight);
            let (k, values) = part.active;
            for (number, value) in curve.numbers[k..].iter().zip(values) {
                let of_unknown = &mut self.coefficients[number - first];
                of_unknown.iter_mut().zip(slopes).for_each(|(sum, slope)| *sum += slope * value);
            }
        }
    }
}

impl NormalEquations<'_> {
    /// `few`: whether variances are needed in a few frames only.
    ///
    /// # Errors
    /// Equations that are too large, or have no solution (which happens only with numbers that are not finite).
    pub(super) fn solve(&self, few: bool) -> Result<Solution, PredictError> {
        let grid = self.inputs.grid;
        let stride = self.filters.gaussian.stride;
        let every = stride * ((OBSERVED_EVERY_S / grid.step_s / stride as f64).round() as usize).max(1);
        let instants = || (0..grid.frames).step_by(every).filter(|frame| self.evidence.contains(frame));
        let ranges: Vec<Option<[usize; 2]>> = instants().map(|frame| self.range(grid.time(frame))).collect();
        let width = ranges.iter().flatten().map(|[first, last]| last - first).max().unwrap_or(0);
        let width = width.max(self.unknowns.widest());
        let bytes = 8.0 * self.unknowns.count as f64 * (width + 1) as f64;
        if bytes > MOST_BYTES {
            return Err(PredictError::TooLarge { found_mb: bytes / 1e6, most_mb: MOST_BYTES / 1e6 });
        }
        let mut matrix = BandMatrix::zeros(self.unknowns.count, width);
        let mut values = vec![0.0; self.unknowns.count];
        // Prior: every unknown has mean 0 and standard deviation 1.
        for number in 0..self.unknowns.count {
            matrix.add(number, number, 1.0);
        }
        let mut samples: Vec<Option<StanceSamples>> = vec![None; self.expectations.len()];
        let mut rows = Rows::default();
        let mut used = Vec::new();
        for (frame, range) in instants().zip(&ranges) {
            let Some([first, last]) = *range else { continue };
            self.sample_near(frame, &mut samples);
            self.observe(frame, first, last - first + 1, &samples, &mut rows);
            let noise = self.noise(grid.time(frame));
            for (row, (rest, noise)) in rows.rest.into_iter().zip(noise).enumerate() {
                used.clear();
                let whitened = rows.coefficients.iter().map(|of_unknown| of_unknown[row] / noise);
                let whitened = whitened.enumerate().filter(|(_, x)| x.abs() > NEGLIGIBLE);
                used.extend(whitened.map(|(i, x)| (first + i, x)));
                add_equation(&mut matrix, &mut values, &used, rest / noise);
            }
        }
        let factor = matrix.factor().ok_or(PredictError::NoSolution)?;
        factor.solve(&mut values);
        if values.iter().any(|x| !x.is_finite()) {
            return Err(PredictError::NoSolution);
        }
        let covariances =
            if few { Covariances::OnDemand(factor) } else { Covariances::InBand(factor.inverse_in_band()) };
        Ok(Solution { values, covariances })
    }

    /// Lowest and highest index of the unknowns that influence the filtered wrench at a time.
    fn range(&self, time: f64) -> Option<[usize; 2]> {
        let reach = self.filters.longest().reach_s(self.inputs.grid);
        let [from, to] = [time - reach, time + reach];
        let near = self.inputs.stances.iter().zip(&self.unknowns.curves);
        let near = near.filter(|(stance, _)| stance.end_s >= from && stance.start_s <= to);
        let ends = near.flat_map(|(_, curves)| curves).map(|curve| curve.range(from, to));
        ends.reduce(|[a, b], [c, d]| [a.min(c), b.max(d)])
    }

    /// Forward, up and right direction of the nearest stance.
    fn axes(&self, time: f64) -> [Vec3; 3] {
        let apart = |s: &Stance| (s.start_s - time).max(time - s.end_s);
        let nearest = self.inputs.stances.iter().min_by(|a, b| apart(a).total_cmp(&apart(b)));
        let up = self.inputs.body_scale.up;
        nearest.map_or([Vec3::x(), up, Vec3::z()], |s| s.axes(up))
    }

    /// Samples the stances within the filter around a frame, and forgets the others: a long recording has many.
    fn sample_near(&self, frame: usize, samples: &mut [Option<StanceSamples>]) {
        let reach = self.filters.longest().reach_frames();
        let (from, to) = (frame.saturating_sub(reach), frame + reach);
        let stances = self.expectations.iter().zip(&self.unknowns.curves);
        for (samples, (expectation, curves)) in samples.iter_mut().zip(stances) {
            let frames = frames_of(self.inputs, expectation.stance);
            if frames.start > to || frames.end <= from {
                *samples = None;
            } else if samples.is_none() {
                *samples = Some(StanceSamples::new(self.inputs, expectation, curves, self.filters.gaussian.stride));
            }
        }
    }

    /// `samples` has one entry per stance.
    fn observe(&self, frame: usize, first: usize, count: usize, samples: &[Option<StanceSamples>], rows: &mut Rows) {
        let grid = self.inputs.grid;
        rows.coefficients.clear();
        rows.coefficients.resize(count, [0.0; 6]);
        let axes = self.axes(grid.time(frame));
        let mut required = Wrench::ZERO;
        for (tap, weight) in self.filters.gaussian.around(frame, grid.frames) {
            add(&mut required, &self.inputs.about_mass_center(tap), weight);
        }
        rows.rest = along(&required, &axes);
        if let Some(filter) = self.filters.smoothed() {
            let passed = |(tap, weight)| self.inputs.about_mass_center(tap).force.dot(&axes[UP]) * weight;
            rows.rest[UP] = filter.around(frame, grid.frames).map(passed).sum();
        }
        for (filter, passing) in self.filters.estimated() {
            let near = samples.iter().zip(&self.unknowns.curves).zip(self.inputs.stances);
            let near = near.filter_map(|((samples, curves), stance)| Some((samples.as_ref()?, curves, stance)));
            for (samples, curves, stance) in near {
                let passing = passing(stance.gait);
                for (tap, weight) in filter.around(frame, grid.frames).filter(|_| !passing.is_empty()) {
                    if let Some(sample) = samples.at(tap) {
                        rows.add(passing, sample, curves, &axes, weight, first);
                    }
                }
            }
        }
    }

    /// Standard deviations of the six equations at a time [N, N.m].
    fn noise(&self, time: f64) -> [f64; 6] {
        let EstimateInputs { grid, body_scale, parameters, .. } = *self.inputs;
        let reach = self.filters.gaussian.reach_s(grid);
        let at_end = time - grid.start_s < reach || grid.end_s() - time < reach;
        let scale = body_scale.weight_n * if at_end { AT_THE_ENDS } else { 1.0 };
        std::array::from_fn(|row| match row {
            0..3 => scale * parameters.force_noise[row],
            _ => scale * body_scale.size() * parameters.moment_noise[row - 3],
        })
    }
}

fn add(sum: &mut Wrench, load: &Wrench, weight: f64) {
    sum.force += load.force * weight;
    sum.moment += load.moment * weight;
}

fn along(load: &Wrench, axes: &[Vec3; 3]) -> [f64; 6] {
    std::array::from_fn(|row| if row < 3 { load.force.dot(&axes[row]) } else { load.moment.dot(&axes[row - 3]) })
}

/// Adds an equation with noise of standard deviation 1 to the normal equations.
fn add_equation(matrix: &mut BandMatrix, right: &mut [f64], row: &[(usize, f64)], rest: f64) {
    for (n, &(i, a)) in row.iter().enumerate() {
        right[i] += a * rest;
        for &(j, b) in &row[..=n] {
            matrix.add(i, j, a * b);
        }
    }
}
