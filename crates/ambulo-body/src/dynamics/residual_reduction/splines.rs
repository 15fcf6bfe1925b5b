//! Corrections of a motion: a cubic spline added to each free coordinate, in and around the window.

use super::settings::{ResidualReductionError, ResidualReductionSettings};
use crate::kinematics::{Posture, Trajectory};
use crate::model::{Coordinate, CoordinateKind, Displacement, Drive, Function, JointAxis, Model};
use crate::motion::TimeGrid;
use crate::numerics::{SPLINES_AT_ONCE, UniformSplines};
use std::ops::Range;

/// Smallest spacing of knots [s]: human motion and ground forces have little content above 50 Hz.
const KNOT_STEP_S: f64 = 0.010;
/// Time on each side of the window in which the correction fades [s].
const FADING_S: f64 = 0.5;
/// Bandwidth of corrections outside the window [Hz]: a correction at the edge fades within 0.1 to 0.2 s, so that it
/// hardly adds to accelerations.
const FADING_HZ: f64 = 1.5;
/// Minimum number of frames in the window.
const FEWEST_FRAMES: usize = 8;

/// The frames of the problem.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Region {
    /// Where Newton's laws are enforced.
    pub(super) window: Range<usize>,
    /// Where the motion may be corrected: the window and the fading on each side.
    pub(super) frames: Range<usize>,
}

/// Splines added to the free coordinates of a motion.
#[derive(Debug, Clone)]
pub(super) struct CorrectionSplines {
    /// Indices of the free coordinates.
    pub(super) coordinates: Vec<usize>,
    /// Standard deviation of each [rad or m].
    tolerances: Vec<f64>,
    /// Standard deviation of accelerations, as a multiple of that, inside and outside the window [1/s²].
    sharpness: [f64; 2],
    window: Range<usize>,
    followers: Vec<(usize, usize, Function)>,
    splines: UniformSplines,
    first_frame: usize,
    step_s: f64,
}

/// The basis splines that are not zero at one frame: index of the first, count, and what each adds to value, rate and
/// acceleration.
#[derive(Debug, Clone, Copy)]
pub(super) struct SplineWeights {
    pub(super) first: usize,
    pub(super) count: usize,
    pub(super) weights: [[f64; SPLINES_AT_ONCE]; 3],
}

/// Value, rate and acceleration of every coordinate at one instant.
#[derive(Debug, Clone)]
pub(super) struct Instant {
    pub(super) q: Vec<f64>,
    pub(super) qd: Vec<f64>,
    pub(super) qdd: Vec<f64>,
}

impl Region {
    pub(super) fn of(grid: TimeGrid, settings: &ResidualReductionSettings) -> Result<Region, ResidualReductionError> {
        let (first, count) = grid.inside(settings.within);
        if count < FEWEST_FRAMES {
            return Err(ResidualReductionError::TooShort {
                from_s: settings.within.from_s.unwrap_or(grid.start_s),
                to_s: settings.within.to_s.unwrap_or(grid.end_s()),
                found: count,
                expected: FEWEST_FRAMES,
            });
        }
        let (stride, fading) = (stride(grid), (FADING_S / grid.step_s).ceil() as usize);
        let from = first.saturating_sub(fading);
        // A closed end lies on a knot.
        let last = from + (first + count - 1 + fading - from).next_multiple_of(stride);
        Ok(Region { window: first..first + count, frames: from..(last + 1).min(grid.frames) })
    }
}

/// Samples per knot interval.
fn stride(grid: TimeGrid) -> usize {
    ((KNOT_STEP_S / grid.step_s + 1e-6).floor() as usize).max(1)
}

impl CorrectionSplines {
    pub(super) fn new(
        model: &Model,
        grid: TimeGrid,
        region: &Region,
        settings: &ResidualReductionSettings,
    ) -> CorrectionSplines {
        let frames = &region.frames;
        let sharpness = [settings.bandwidth_hz, settings.bandwidth_hz.min(FADING_HZ)];
        let is_free = |&c: &usize| matches!(model.coordinates()[c].drive, Drive::Free);
        let coordinates: Vec<usize> = (0..model.coordinates().len()).filter(is_free).collect();
        let tolerance = |&c: &usize| match model.coordinates()[c].kind {
            CoordinateKind::Translation => settings.tolerance_m,
            CoordinateKind::Rotation | CoordinateKind::Coupled => settings.tolerance_rad,
        };
        let tolerances = coordinates.iter().map(tolerance).collect();
        let follower = |(c, coordinate): (usize, &Coordinate)| match &coordinate.drive {
            Drive::Coupled(leader, function) => Some((c, leader.index(), function.clone())),
            _ => None,
        };
        let closed = [frames.start > 0, frames.end < grid.frames];
        CorrectionSplines {
            coordinates,
            tolerances,
            sharpness: sharpness.map(|hz| (std::f64::consts::TAU * hz).powi(2)),
            window: region.window.clone(),
            followers: model.coordinates().iter().enumerate().filter_map(follower).collect(),
            splines: UniformSplines::new(frames.len(), stride(grid), closed),
            first_frame: frames.start,
            step_s: grid.step_s,
        }
    }

    /// Number of spline coefficients.
    pub(super) fn unknowns(&self) -> usize {
        self.splines.count() * self.coordinates.len()
    }

    /// Bands below the diagonal of the normal equations. Unknowns are ordered by spline, then by coordinate.
    pub(super) fn bands(&self) -> usize {
        self.splines.overlap() * self.coordinates.len() - 1
    }

    pub(super) fn at(&self, frame: usize) -> SplineWeights {
        let (first, values, which) = self.splines.at(frame - self.first_frame);
        let rate = 1.0 / self.step_s;
        let mut weights = [[0.0; SPLINES_AT_ONCE]; 3];
        for (d, scale) in [1.0, rate, rate * rate].into_iter().enumerate() {
            for (k, j) in which.clone().enumerate() {
                weights[d][k] = values[d][j] * scale;
            }
        }
        SplineWeights { first, count: which.len(), weights }
    }

    /// Standard deviations of each coordinate [rad or m] and its acceleration [rad/s² or m/s²] at a frame.
    pub(super) fn tolerances(&self, frame: usize) -> impl Iterator<Item = [f64; 2]> {
        let sharpness = self.sharpness[usize::from(!self.window.contains(&frame))];
        self.tolerances.iter().map(move |tolerance| [*tolerance, tolerance * sharpness])
    }

    /// Whether a step of the coefficients moves every coordinate by less than a thousandth of its tolerance.
    pub(super) fn is_small(&self, step: &[f64]) -> bool {
        let tolerances = self.tolerances.iter().cycle();
        step.iter().zip(tolerances).all(|(x, tolerance)| x.abs() < 1e-3 * tolerance)
    }

    /// Correction of a free coordinate (given by its place among them): value, rate, acceleration.
    pub(super) fn change(&self, at: &SplineWeights, coefficients: &[f64], place: usize) -> [f64; 3] {
        let n = self.coordinates.len();
        std::array::from_fn(|d| {
            (0..at.count).map(|k| at.weights[d][k] * coefficients[(at.first + k) * n + place]).sum()
        })
    }

    /// The corrected motion at a frame.
    pub(super) fn write(&self, trajectory: &Trajectory, frame: usize, coefficients: &[f64], instant: &mut Instant) {
        instant.take(trajectory, frame);
        let at = self.at(frame);
        for (place, &c) in self.coordinates.iter().enumerate() {
            let [value, rate, acceleration] = self.change(&at, coefficients, place);
            instant.q[c] += value;
            instant.qd[c] += rate;
            instant.qdd[c] += acceleration;
        }
        self.follow(instant);
    }

    /// Updates coordinates that follow others.
    pub(super) fn follow(&self, instant: &mut Instant) {
        for (follower, leader, function) in &self.followers {
            let [y, dy, ddy] = function.at(instant.q[*leader]);
            let (rate, acceleration) = (instant.qd[*leader], instant.qdd[*leader]);
            instant.q[*follower] = y;
            instant.qd[*follower] = dy * rate;
            instant.qdd[*follower] = dy * acceleration + ddy * rate * rate;
        }
    }

    /// The whole corrected motion.
    pub(super) fn corrected(
        &self,
        model: &Model,
        trajectory: &Trajectory,
        frames: Range<usize>,
        coefficients: &[f64],
    ) -> Result<Trajectory, ResidualReductionError> {
        let mut columns = trajectory.columns().to_vec();
        let mut instant = Instant::zeros(columns.len());
        for frame in frames {
            self.write(trajectory, frame, coefficients, &mut instant);
            let moved = self.coordinates.iter().copied().chain(self.followers.iter().map(|(f, ..)| *f));
            for c in moved {
                let [q, qd, qdd] = &mut columns[c];
                (q[frame], qd[frame], qdd[frame]) = (instant.q[c], instant.qd[c], instant.qdd[c]);
            }
        }
        Ok(Trajectory::new(model, trajectory.grid(), columns)?)
    }
}

impl Instant {
    pub(super) fn zeros(count: usize) -> Instant {
        Instant { q: vec![0.0; count], qd: vec![0.0; count], qdd: vec![0.0; count] }
    }

    pub(super) fn take(&mut self, trajectory: &Trajectory, frame: usize) {
        for (c, [q, qd, qdd]) in trajectory.columns().iter().enumerate() {
            (self.q[c], self.qd[c], self.qdd[c]) = (q[frame], qd[frame], qdd[frame]);
        }
    }

    pub(super) fn posture(&self) -> Posture<'_> {
        Posture { q: &self.q, qd: &self.qd, qdd: &self.qdd }
    }
}

/// Whether a joint to ground translates along a free coordinate. Without one, the motion cannot balance a force.
pub(super) fn has_free_root(model: &Model) -> bool {
    let is_free = |axis: &JointAxis| match &axis.displacement {
        Displacement::Follows(id, _) => matches!(model.coordinates()[id.index()].drive, Drive::Free),
        Displacement::Fixed(_) => false,
    };
    let mut roots = model.bodies().iter().map(|body| &body.joint).filter(|joint| joint.parent.is_none());
    roots.any(|joint| joint.translations.iter().any(is_free))
}
