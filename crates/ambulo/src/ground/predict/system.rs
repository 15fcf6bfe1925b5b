//! The normal equations of the estimate: expectations and evidence, by number of the unknowns.

use super::PredictError;
use super::samples::{Evidence, Samples};
use super::stances::Stance;
use super::taps::Taps;
use super::unknowns::Unknowns;
use crate::numerics::BandMatrix;
use crate::spatial::{Vec3, Wrench};

/// The motion's evidence is read about this often [s]: at the bandwidth of [`super::Weights`] neighbours tell nearly the
/// same.
const OBSERVED_EVERY_S: f64 = 0.04;
/// Within a reach of the recording's ends the motion is less certain: noise grows by this factor.
const AT_THE_ENDS: f64 = 2.0;
/// Most memory for the equations and their inverse: ten minutes of walking take 60 MB.
const MOST_BYTES: f64 = 1e9;
/// Smaller coefficients, as a share of one deviation of the noise, do not count.
const NEGLIGIBLE: f64 = 1e-4;

/// The unknowns' likeliest values, and their covariances inside the band.
pub(super) struct Solution {
    pub(super) values: Vec<f64>,
    pub(super) covariances: BandMatrix,
}

/// What the equations are made of.
pub(super) struct System<'a> {
    pub(super) evidence: &'a Evidence<'a>,
    pub(super) unknowns: &'a Unknowns,
    /// One entry a stance, on the taps' stride.
    pub(super) samples: &'a [Samples],
    pub(super) taps: &'a Taps,
}

/// Six equations of an instant: forces and moments along three axes.
#[derive(Debug, Default)]
struct Rows {
    rest: [f64; 6],
    coefficients: [Vec<f64>; 6],
}

impl System<'_> {
    /// # Errors
    /// Equations without a solution, which finite evidence always has, or more of them than memory should hold.
    pub(super) fn solve(&self) -> Result<Solution, PredictError> {
        let grid = self.evidence.grid;
        let stride = self.taps.stride;
        let every = stride * ((OBSERVED_EVERY_S / grid.step_s / stride as f64).round() as usize).max(1);
        let instants = || (0..grid.frames).step_by(every);
        let ranges: Vec<Option<[usize; 2]>> = instants().map(|frame| self.range(grid.time(frame))).collect();
        let width = ranges.iter().flatten().map(|[first, last]| last - first).max().unwrap_or(0);
        let width = width.max(self.unknowns.widest());
        let bytes = 2.0 * 8.0 * self.unknowns.count as f64 * (width + 1) as f64;
        if bytes > MOST_BYTES {
            return Err(PredictError::TooLarge { found_mb: bytes / 1e6, most_mb: MOST_BYTES / 1e6 });
        }
        let mut matrix = BandMatrix::zeros(self.unknowns.count, width);
        let mut values = vec![0.0; self.unknowns.count];
        // Every unknown has unit deviation about zero.
        for number in 0..self.unknowns.count {
            matrix.add(number, number, 1.0);
        }
        let mut rows = Rows::default();
        let mut used = Vec::new();
        for (frame, range) in instants().zip(&ranges) {
            let Some([first, last]) = *range else { continue };
            self.observe(frame, first, last - first + 1, &mut rows);
            let noise = self.noise(grid.time(frame));
            for ((row, rest), noise) in rows.coefficients.iter().zip(rows.rest).zip(noise) {
                used.clear();
                let whitened = row.iter().map(|x| x / noise).enumerate().filter(|(_, x)| x.abs() > NEGLIGIBLE);
                used.extend(whitened.map(|(i, x)| (first + i, x)));
                add_equation(&mut matrix, &mut values, &used, rest / noise);
            }
        }
        let factor = matrix.factor().ok_or(PredictError::NoSolution)?;
        factor.solve(&mut values);
        if values.iter().any(|x| !x.is_finite()) {
            return Err(PredictError::NoSolution);
        }
        Ok(Solution { values, covariances: factor.inverse_in_band() })
    }

    /// Lowest and highest number that the taps around an instant reach.
    fn range(&self, time: f64) -> Option<[usize; 2]> {
        let reach = self.taps.reach_s(self.evidence.grid);
        let [from, to] = [time - reach, time + reach];
        let near = self.evidence.stances.iter().zip(&self.unknowns.curves);
        let near = near.filter(|(stance, _)| stance.end_s >= from && stance.start_s <= to);
        let ends = near.flat_map(|(_, curves)| curves).map(|curve| curve.range(from, to));
        ends.reduce(|[a, b], [c, d]| [a.min(c), b.max(d)])
    }

    /// Forward, up and right at an instant: of the stance that is nearest.
    fn axes(&self, time: f64) -> [Vec3; 3] {
        let apart = |s: &Stance| (s.start_s - time).max(time - s.end_s);
        let nearest = self.evidence.stances.iter().min_by(|a, b| apart(a).total_cmp(&apart(b)));
        let up = self.evidence.measure.up;
        nearest.map_or([Vec3::x(), up, Vec3::z()], |s| [s.forward, up, s.right])
    }

    fn observe(&self, frame: usize, first: usize, count: usize, rows: &mut Rows) {
        let grid = self.evidence.grid;
        for row in &mut rows.coefficients {
            row.clear();
            row.resize(count, 0.0);
        }
        let axes = self.axes(grid.time(frame));
        let mut rest = Wrench::ZERO;
        for (tap, weight) in self.taps.around(frame, grid.frames) {
            add(&mut rest, &self.evidence.about_mass_center(tap), weight);
            for (samples, curves) in self.samples.iter().zip(&self.unknowns.curves) {
                let Some(sample) = samples.at(tap) else { continue };
                add(&mut rest, &sample.expected, -weight);
                for (part, curve) in sample.parts.iter().zip(curves) {
                    let slopes = along(&part.unit, &axes).map(|x| x * part.deviation * weight);
                    let (k, values) = part.active;
                    for (number, value) in curve.numbers[k..].iter().zip(values) {
                        for (row, slope) in rows.coefficients.iter_mut().zip(slopes) {
                            row[number - first] += slope * value;
                        }
                    }
                }
            }
        }
        rows.rest = along(&rest, &axes);
    }

    /// Standard deviations of the six equations at an instant [N, N.m].
    fn noise(&self, time: f64) -> [f64; 6] {
        let Evidence { grid, measure, weights, .. } = *self.evidence;
        let reach = self.taps.reach_s(grid);
        let at_end = time - grid.start_s < reach || grid.end_s() - time < reach;
        let scale = measure.weight_n * if at_end { AT_THE_ENDS } else { 1.0 };
        std::array::from_fn(|row| match row {
            0..3 => scale * weights.force_noise[row],
            _ => scale * measure.size() * weights.moment_noise[row - 3],
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

/// Adds an equation of unit noise to the normal equations.
fn add_equation(matrix: &mut BandMatrix, right: &mut [f64], row: &[(usize, f64)], rest: f64) {
    for (n, &(i, a)) in row.iter().enumerate() {
        right[i] += a * rest;
        for &(j, b) in &row[..=n] {
            matrix.add(i, j, a * b);
        }
    }
}
