//! The loads of both feet, estimated over the whole trial at once.
//!
//! Unknown are the curves of [`super::unknowns`]: three forces and three moments of every stance, near what is expected of it. What is
//! seen is what the whole body's motion asks of the ground, and only as sharply as markers on skin and the motion's filter show it:
//!
//!   G ∗ Σ_feet F_i          = F_total            + noise
//!   G ∗ Σ_feet (r_i × F_i + T_i) = M_total about the mass centre + noise
//!
//! r_i leads from the mass centre to the expected centre of pressure of foot i ([`super::center_path`]) and G is a low-pass of
//! Gaussian shape. Both are linear in the unknowns; with Gaussian noise and expectations the likeliest curves solve a
//! band of linear equations, whose inverse tells how far they may be off. In single support the forces decide; in double support the
//! lever rule between the feet, what is expected of people who walk at this speed, and the smoothness of a stance share the decision by
//! their noise.
//!
//! | code         | symbol | unit | meaning                                              |
//! | `taps`       | G      | -    | weights of the low-pass                              |
//! | `total`      | F, M   | N, N.m | of the ground on the body, by Newton and Euler     |
//!
//! Cost: linear in frames. Memory: about 15 kB a second of walking beside the trajectory.
//! Not handled: pulls (a foot that clings), hands and objects.

use super::center_path::center_path;
use super::expected::{Component, Expectation, lever, mass_center_spread};
use super::geometry::Geometry;
use super::stance_curves::StanceCurves;
use super::stances::{Measure, Stance};
use super::unknowns::Unknowns;
use super::weights::Weights;
use super::{FootDeviation, Known};
use crate::model::Side;
use crate::motion::TimeGrid;
use crate::numerics::{BandFactor, BandMatrix};
use crate::spatial::{Vec3, Wrench};

/// The motion's evidence is read this often [s]: at 7 Hz neighbours tell nearly the same.
const OBSERVED_EVERY_S: f64 = 0.04;
/// The low-pass is sampled this often [s].
const TAPS_EVERY_S: f64 = 0.0125;
/// Taps reach this many deviations of the Gauss curve.
const TAPS_REACH: f64 = 3.5;
/// Within a reach of the recording's ends the motion is less certain: noise grows by this factor.
const AT_THE_ENDS: f64 = 2.0;

/// What is estimated from.
pub(super) struct Evidence<'a> {
    pub(super) grid: TimeGrid,
    pub(super) geometry: &'a Geometry,
    pub(super) stances: &'a [Stance],
    /// About the world's origin.
    pub(super) total: &'a [Wrench],
    pub(super) measure: &'a Measure,
    pub(super) weights: &'a Weights,
    pub(super) known: &'a Known,
}

/// Loads of one foot, one entry a frame.
#[derive(Debug, Clone)]
pub(super) struct FootLoads {
    pub(super) force: Vec<Vec3>,
    pub(super) center: Vec<Vec3>,
    /// About the vertical through the centre of pressure [N.m].
    pub(super) free_moment: Vec<f64>,
    pub(super) height: Vec<f64>,
    pub(super) deviation: FootDeviation,
}

/// The estimate: right and left foot.
pub(super) struct Estimate {
    pub(super) feet: [FootLoads; 2],
    /// By how much the model's mass centre seems to be off [m], level.
    pub(super) mass_center_offset: Vec3,
}

/// Loads of both feet; `None` if the equations have no solution, which finite evidence always has.
pub(super) fn estimate(evidence: &Evidence<'_>, curves: &StanceCurves) -> Option<Estimate> {
    let Evidence { stances, measure, weights, .. } = *evidence;
    let expectations: Vec<Expectation<'_>> =
        stances.iter().map(|stance| Expectation::new(stance, stances, curves, weights, measure)).collect();
    let unknowns = Unknowns::new(stances, measure, weights);
    let system = System {
        evidence,
        expectations: &expectations,
        unknowns: &unknowns,
        offset: offset(evidence),
        taps: taps(weights.bandwidth_hz, evidence.grid),
    };
    let (solution, inverse) = system.solve()?;
    Some(Estimate {
        feet: Side::BOTH.map(|side| system.loads(side, &solution, &inverse)),
        mass_center_offset: system.offset,
    })
}

/// Frames between taps, and the weights of the middle tap and those on one side.
#[derive(Debug, Clone)]
struct Taps {
    stride: usize,
    weights: Vec<f64>,
}

impl Taps {
    fn reach_s(&self, grid: TimeGrid) -> f64 {
        (self.stride * (self.weights.len() - 1)) as f64 * grid.step_s
    }
}

/// exp(-t²/2σ²) with half the amplitude at the bandwidth: σ = √(ln 2 / 2) / (π f).
fn taps(bandwidth_hz: f64, grid: TimeGrid) -> Taps {
    let sigma = (0.5 * std::f64::consts::LN_2).sqrt() / (std::f64::consts::PI * bandwidth_hz);
    let stride = ((TAPS_EVERY_S / grid.step_s) as usize).max(1);
    let step = stride as f64 * grid.step_s;
    let count = (TAPS_REACH * sigma / step).ceil() as usize;
    let weights = (0..=count).map(|i| (-0.5 * (i as f64 * step / sigma).powi(2)).exp()).collect();
    Taps { stride, weights }
}

/// The centre of pressure that is expected at a frame.
fn expected_center(evidence: &Evidence<'_>, stance: &Stance, frame: usize) -> Vec3 {
    let foot = stance.side as usize;
    let known = evidence.known.center_at(foot, frame);
    let place = &evidence.geometry.feet[foot][frame];
    known.unwrap_or_else(|| center_path(place, stance, evidence.grid.time(frame), evidence.measure, evidence.weights))
}

/// How far the whole force seems to pass from where it should while one foot stands flat: the model's mass centre is off by that much,
/// or the expected centres of pressure are. Both are shrunk by their deviations.
fn offset(evidence: &Evidence<'_>) -> Vec3 {
    /// Part of a stance in which one foot stands flat and alone.
    const FLAT: std::ops::Range<f64> = 0.3..0.7;
    let Evidence { grid, geometry, stances, total, measure, weights, .. } = *evidence;
    let (mut sum, mut count, mut steps) = (Vec3::zeros(), 0.0, 0.0);
    for stance in stances {
        let mut seen = false;
        for frame in frames_within(grid, stance.start_s, stance.end_s) {
            let time = grid.time(frame);
            let alone = stances.iter().filter(|s| s.holds(time)).count() == 1;
            let Wrench { force, moment } = total[frame];
            let vertical = force.dot(&measure.up);
            if !FLAT.contains(&stance.own_phase(time)) || !alone || vertical < 0.3 * measure.weight_n {
                continue;
            }
            let center = expected_center(evidence, stance, frame);
            let rest = moment - center.cross(&force);
            sum += stance.forward * (rest.dot(&stance.right) / vertical)
                - stance.right * (rest.dot(&stance.forward) / vertical);
            (count, seen) = (count + 1.0, true);
        }
        steps += f64::from(u8::from(seen));
    }
    let _ = geometry;
    if count == 0.0 {
        return Vec3::zeros();
    }
    let of_mass_center = mass_center_spread(weights, measure).powi(2);
    let of_pressure = weights.center_spread[0].powi(2) / steps;
    sum / count * (of_mass_center / (of_mass_center + of_pressure))
}

fn frames_within(grid: TimeGrid, from_s: f64, to_s: f64) -> std::ops::Range<usize> {
    let frame = |time: f64| ((time - grid.start_s) / grid.step_s).clamp(0.0, grid.frames as f64);
    let (first, end) = (frame(from_s).ceil() as usize, (frame(to_s).floor() as usize + 1).min(grid.frames));
    first..end.max(first)
}

struct System<'a> {
    evidence: &'a Evidence<'a>,
    expectations: &'a [Expectation<'a>],
    unknowns: &'a Unknowns,
    offset: Vec3,
    taps: Taps,
}

/// One instant's six equations: forces and moments along three axes.
#[derive(Debug, Default)]
struct Rows {
    /// What is left of the evidence after the means.
    rest: [f64; 6],
    /// Coefficients by number, from `first` on.
    first: usize,
    coefficients: [Vec<f64>; 6],
}

impl System<'_> {
    /// The unknowns, and the inverse of their equations inside the band.
    fn solve(&self) -> Option<(Vec<f64>, BandMatrix)> {
        let grid = self.evidence.grid;
        let every = ((OBSERVED_EVERY_S / grid.step_s).round() as usize).max(1);
        let instants: Vec<usize> = (0..grid.frames).step_by(every).collect();
        let ranges: Vec<Option<[usize; 2]>> = instants.iter().map(|&frame| self.range(frame)).collect();
        let width = ranges.iter().flatten().map(|[first, last]| last - first).max().unwrap_or(0);
        let mut matrix = BandMatrix::zeros(self.unknowns.count, width.max(self.widest_curve()));
        let mut right = vec![0.0; self.unknowns.count];
        for number in 0..self.unknowns.count {
            matrix.add(number, number, 1.0);
        }
        let mut rows = Rows::default();
        for (&frame, range) in instants.iter().zip(&ranges) {
            let Some([first, last]) = *range else { continue };
            self.observe(frame, first, last, &mut rows);
            let noise = self.noise(frame);
            for ((coefficients, rest), noise) in rows.coefficients.iter().zip(rows.rest).zip(noise) {
                add_row(&mut matrix, &mut right, first, coefficients, rest, 1.0 / (noise * noise));
            }
        }
        let factor: BandFactor = matrix.factor()?;
        factor.solve(&mut right);
        Some((right, factor.inverse_in_band()))
    }

    /// Most numbers between splines of one curve that are active together.
    fn widest_curve(&self) -> usize {
        let curves = self.unknowns.curves.iter().flatten();
        curves.flat_map(|c| c.numbers.windows(4).map(|w| w[3] - w[0])).max().unwrap_or(0)
    }

    /// Lowest and highest number that an instant's taps reach.
    fn range(&self, frame: usize) -> Option<[usize; 2]> {
        let (grid, reach) = (self.evidence.grid, self.taps.reach_s(self.evidence.grid));
        let [from, to] = [grid.time(frame) - reach - grid.step_s, grid.time(frame) + reach + grid.step_s];
        let mut range: Option<[usize; 2]> = None;
        for (stance, curves) in self.evidence.stances.iter().zip(&self.unknowns.curves) {
            if stance.end_s < from || stance.start_s > to {
                continue;
            }
            for curve in curves {
                let low = curve.numbers[curve.active(from).0];
                let high = curve.numbers[curve.active(to).0 + 3];
                range = Some(range.map_or([low, high], |[a, b]| [a.min(low), b.max(high)]));
            }
        }
        range
    }

    /// Forward, up and right at an instant: of the stance that is nearest.
    fn axes(&self, time: f64) -> [Vec3; 3] {
        let apart = |s: &Stance| (s.start_s - time).max(time - s.end_s);
        let nearest = self.evidence.stances.iter().min_by(|a, b| apart(a).total_cmp(&apart(b)));
        let up = self.evidence.measure.up;
        nearest.map_or([Vec3::x(), up, Vec3::z()], |s| [s.forward, up, s.right])
    }

    fn observe(&self, frame: usize, first: usize, last: usize, rows: &mut Rows) {
        let Evidence { grid, geometry, stances, .. } = *self.evidence;
        rows.first = first;
        for row in &mut rows.coefficients {
            row.clear();
            row.resize(last - first + 1, 0.0);
        }
        let axes = self.axes(grid.time(frame));
        let (mut expected, mut seen) = (Wrench::ZERO, Wrench::ZERO);
        let mut weight_of_taps = 0.0;
        for (tap, weight) in self.tapped(frame) {
            weight_of_taps += weight;
            let time = grid.time(tap);
            if self.evidence.known.total.is_some() {
                let known = self.about_mass_center(tap);
                seen.force += known.force * weight;
                seen.moment += known.moment * weight;
            }
            for (s, stance) in stances.iter().enumerate().filter(|(_, stance)| stance.holds(time)) {
                let center = expected_center(self.evidence, stance, tap);
                let to_mass_center = lever(geometry, tap, center);
                let arm = self.offset - to_mass_center;
                for (component, curve) in Component::ALL.into_iter().zip(&self.unknowns.curves[s]) {
                    let found = self.expectations[s].of(component, time, to_mass_center);
                    let unit = unit_load(component, stance, self.evidence.measure.up, arm);
                    expected.force += unit.force * (found.mean * weight);
                    expected.moment += unit.moment * (found.mean * weight);
                    let (k, values) = curve.active(time);
                    let slopes = along(&unit, &axes).map(|x| x * found.deviation * weight);
                    for (i, value) in values.iter().enumerate() {
                        let column = curve.numbers[k + i] - first;
                        for (row, slope) in rows.coefficients.iter_mut().zip(slopes) {
                            row[column] += slope * value;
                        }
                    }
                }
            }
        }
        if self.evidence.known.total.is_none() {
            seen = self.about_mass_center(frame);
            weight_of_taps = weight_of_taps.max(f64::MIN_POSITIVE);
            seen.force *= weight_of_taps;
            seen.moment *= weight_of_taps;
        }
        let rest = Wrench { force: seen.force - expected.force, moment: seen.moment - expected.moment };
        rows.rest = along(&rest, &axes).map(|x| x / weight_of_taps);
        for row in &mut rows.coefficients {
            row.iter_mut().for_each(|x| *x /= weight_of_taps);
        }
    }

    /// Frames of the taps around a frame, with their weights; less of them at the recording's ends.
    fn tapped(&self, frame: usize) -> impl Iterator<Item = (usize, f64)> {
        let (stride, frames) = (self.taps.stride, self.evidence.grid.frames);
        let side = self.taps.weights.len() as isize - 1;
        (-side..=side).filter_map(move |i| {
            let tap = frame.checked_add_signed(i * stride as isize).filter(|tap| *tap < frames)?;
            Some((tap, self.taps.weights[i.unsigned_abs()]))
        })
    }

    fn about_mass_center(&self, frame: usize) -> Wrench {
        self.evidence.total[frame].about(-self.evidence.geometry.center[frame])
    }

    /// Standard deviations of the six equations at a frame [N, N.m].
    fn noise(&self, frame: usize) -> [f64; 6] {
        let Evidence { grid, stances, measure, weights, .. } = *self.evidence;
        let time = grid.time(frame);
        let impact = stances.iter().map(|s| (-0.5 * ((time - s.start_s) / weights.impact_s).powi(2)).exp());
        let impact = impact.fold(0.0, f64::max);
        let reach = self.taps.reach_s(grid);
        let at_end = time - grid.start_s < reach || grid.end_s() - time < reach;
        let scale = measure.weight_n * if at_end { AT_THE_ENDS } else { 1.0 };
        let lever = measure.height_m / 1.75;
        std::array::from_fn(|row| match row {
            0..3 => scale * weights.force_noise[row].hypot(weights.impact_noise[row] * impact),
            _ => scale * lever * weights.moment_noise[row - 3],
        })
    }

    /// Loads of one foot in every frame.
    fn loads(&self, side: Side, solution: &[f64], inverse: &BandMatrix) -> FootLoads {
        let Evidence { grid, geometry, stances, measure, known, .. } = *self.evidence;
        let frames = grid.frames;
        let zeros = || vec![Vec3::zeros(); frames];
        let mut out = FootLoads {
            force: zeros(),
            center: zeros(),
            free_moment: vec![0.0; frames],
            height: vec![0.0; frames],
            deviation: FootDeviation { side, force: zeros(), center: zeros(), free_moment: vec![0.0; frames] },
        };
        for (s, stance) in stances.iter().enumerate().filter(|(_, stance)| stance.side == side) {
            for frame in frames_within(grid, stance.start_s, stance.end_s) {
                let time = grid.time(frame);
                let path = expected_center(self.evidence, stance, frame);
                let to_mass_center = lever(geometry, frame, path);
                let mut values = [0.0; 6];
                let mut variances = [0.0; 6];
                for (c, (component, curve)) in Component::ALL.into_iter().zip(&self.unknowns.curves[s]).enumerate() {
                    let found = self.expectations[s].of(component, time, to_mass_center);
                    let (k, splines) = curve.active(time);
                    let numbers = &curve.numbers[k..k + 4];
                    let z: f64 = numbers.iter().zip(splines).map(|(n, b)| solution[*n] * b).sum();
                    let mut variance = 0.0;
                    for (n, a) in numbers.iter().zip(splines) {
                        for (m, b) in numbers.iter().zip(splines) {
                            variance += a * b * inverse.value(*n, *m);
                        }
                    }
                    values[c] = found.mean + found.deviation * z;
                    variances[c] = found.deviation * found.deviation * variance;
                }
                let axes = [stance.forward, measure.up, stance.right];
                let vector = |v: &[f64]| axes[0] * v[0] + axes[1] * v[1] + axes[2] * v[2];
                out.force[frame] = vector(&values[..3]);
                out.height[frame] = stance.height_m;
                let vertical = values[1].max(0.05 * measure.weight_n);
                let [along, across] = [values[5] / vertical, -values[3] / vertical];
                out.center[frame] = match known.center_at(side as usize, frame) {
                    Some(center) => center,
                    None => path + stance.forward * along + stance.right * across,
                };
                out.free_moment[frame] = values[4];
                let spread = |v: [f64; 3]| {
                    let squares = |row: usize| (0..3).map(|a| axes[a][row].powi(2) * v[a]).sum::<f64>();
                    Vec3::new(squares(0), squares(1), squares(2)).map(f64::sqrt)
                };
                out.deviation.force[frame] = spread([variances[0], variances[1], variances[2]]);
                out.deviation.center[frame] =
                    spread([variances[5] / vertical.powi(2), 0.0, variances[3] / vertical.powi(2)]);
                out.deviation.free_moment[frame] = variances[4].sqrt();
            }
        }
        out
    }
}

/// The load on the body about the mass centre when a component is one.
fn unit_load(component: Component, stance: &Stance, up: Vec3, arm: Vec3) -> Wrench {
    let axis = |i: usize| [stance.forward, up, stance.right][i];
    match component {
        Component::Force(i) => Wrench { force: axis(i), moment: arm.cross(&axis(i)) },
        Component::Moment(i) => Wrench { force: Vec3::zeros(), moment: axis(i) },
    }
}

fn along(load: &Wrench, axes: &[Vec3; 3]) -> [f64; 6] {
    std::array::from_fn(|row| if row < 3 { load.force.dot(&axes[row]) } else { load.moment.dot(&axes[row - 3]) })
}

/// Adds a weighted equation to the normal equations; most coefficients are zero.
fn add_row(matrix: &mut BandMatrix, right: &mut [f64], first: usize, row: &[f64], rest: f64, weight: f64) {
    let used: Vec<(usize, f64)> =
        row.iter().enumerate().filter(|(_, x)| x.abs() > 0.0).map(|(i, x)| (first + i, *x)).collect();
    for (n, &(i, a)) in used.iter().enumerate() {
        right[i] += weight * a * rest;
        for &(j, b) in &used[..=n] {
            matrix.add(i, j, weight * a * b);
        }
    }
}
