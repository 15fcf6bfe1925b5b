//! A complete motion of a model: every coordinate with two derivatives on a uniform time grid.

use crate::findings::{Code, Findings};
use crate::model::{Coordinate, CoordinateId, CoordinateKind, Drive, Model};
use crate::motion::{SmoothMotion, TimeGrid};

/// A complete motion of a model: every coordinate with rate and acceleration on a uniform time grid. All numbers are
/// finite; couplers and locks are obeyed.
///
/// Poses of bodies are not stored: recomputing them where they are used is cheaper than reading them from memory.
#[derive(Debug, Clone)]
pub struct Trajectory {
    grid: TimeGrid,
    /// Columns of value, rate and acceleration per coordinate, with one entry per frame.
    columns: Vec<[Vec<f64>; 3]>,
}

/// Coordinates of a model with their rates and accelerations at one instant, in the order of the model.
#[derive(Debug, Clone, Copy)]
pub struct Posture<'a> {
    /// Values [rad or m].
    pub q: &'a [f64],
    /// Rates [rad/s or m/s].
    pub qd: &'a [f64],
    /// Accelerations [rad/s² or m/s²].
    pub qdd: &'a [f64],
}

/// Why a motion is rejected as a trajectory.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TrajectoryError {
    /// A number that is not finite.
    #[error(
        "coordinate `{coordinate}` is not a finite number at {time_s:.4} s; expected values without gaps. hint: choose \
         a range without the gap, or fill it"
    )]
    NotFinite {
        /// The coordinate.
        coordinate: String,
        /// The instant [s].
        time_s: f64,
    },
    /// A motion without frames.
    #[error("the motion has no frames; expected at least one")]
    NoFrames,
    /// A wrong number of columns or frames.
    #[error("found {found} {what}; expected {expected}")]
    Shape {
        /// `columns` or `frames`.
        what: &'static str,
        /// Number found.
        found: usize,
        /// Number expected.
        expected: usize,
    },
}

/// Largest difference between a recorded coordinate and its coupler without a warning [rad or m].
const COUPLER_TOLERANCE: f64 = 0.02;
/// Largest difference between a recorded coordinate and its lock at which both are the same [rad or m]: the digits of a
/// file.
const LOCK_TOLERANCE: f64 = 1e-6;
/// The same for a prescribed coordinate, which a low-pass filter of the recording changes [rad or m].
const PRESCRIBED_TOLERANCE: f64 = 1e-3;

impl Trajectory {
    /// Makes a trajectory from complete columns: per coordinate its value, rate and acceleration, one entry per frame.
    ///
    /// # Errors
    /// No frames, wrong numbers of columns or frames, numbers that are not finite.
    pub fn new(model: &Model, grid: TimeGrid, columns: Vec<[Vec<f64>; 3]>) -> Result<Trajectory, TrajectoryError> {
        if grid.frames == 0 {
            return Err(TrajectoryError::NoFrames);
        }
        let expected = model.coordinates().len();
        if columns.len() != expected {
            return Err(TrajectoryError::Shape { what: "columns", found: columns.len(), expected });
        }
        for (column, coordinate) in columns.iter().zip(model.coordinates()) {
            for series in column {
                if series.len() != grid.frames {
                    return Err(TrajectoryError::Shape { what: "frames", found: series.len(), expected: grid.frames });
                }
                if let Some(i) = series.iter().position(|x| !x.is_finite()) {
                    let coordinate = coordinate.name.clone();
                    return Err(TrajectoryError::NotFinite { coordinate, time_s: grid.time(i) });
                }
            }
        }
        Ok(Trajectory { grid, columns })
    }

    /// Completes a smoothed recording: missing coordinates get the values of the model, coupled ones follow their
    /// coupler. Locked and prescribed coordinates keep their recorded values, as in OpenSim's inverse dynamics; without
    /// a recording they get the values of the model. A warning names each column that contradicts the model.
    ///
    /// # Errors
    /// Numbers that are not finite.
    pub fn complete(
        model: &Model,
        mut motion: SmoothMotion,
        findings: &mut Findings,
    ) -> Result<Trajectory, TrajectoryError> {
        let grid = motion.grid;
        let missing = missing(model, &motion);
        let mut columns: Vec<[Vec<f64>; 3]> =
            model.coordinate_ids().map(|id| recorded_or_driven(model, &mut motion, id, findings)).collect();
        report_missing(&missing, findings);
        for id in model.coordinate_ids() {
            if let Drive::Coupled(leader, function) = &model.coordinates()[id.index()].drive {
                let follower = follow(&columns[leader.index()], |x| function.at(x));
                report_mismatch(model, id, motion.column(id).map(|c| &c[0]), &follower[0], findings);
                columns[id.index()] = follower;
            }
        }
        Trajectory::new(model, grid, columns)
    }

    /// The time grid.
    #[inline]
    #[must_use]
    pub fn grid(&self) -> TimeGrid {
        self.grid
    }

    /// Values of a coordinate [rad or m], one per frame.
    #[inline]
    #[must_use]
    pub fn values(&self, id: CoordinateId) -> &[f64] {
        &self.columns[id.index()][0]
    }

    /// Rates of a coordinate [rad/s or m/s], one per frame.
    #[inline]
    #[must_use]
    pub fn rates(&self, id: CoordinateId) -> &[f64] {
        &self.columns[id.index()][1]
    }

    /// Accelerations of a coordinate [rad/s² or m/s²], one per frame.
    #[inline]
    #[must_use]
    pub fn accelerations(&self, id: CoordinateId) -> &[f64] {
        &self.columns[id.index()][2]
    }

    /// The columns of all coordinates: value, rate, acceleration.
    #[inline]
    #[doc(hidden)]
    pub fn columns(&self) -> &[[Vec<f64>; 3]] {
        &self.columns
    }

    /// Calls `visit` with the posture of every frame, in order.
    pub fn for_each_posture(&self, mut visit: impl FnMut(usize, Posture<'_>)) {
        let n = self.columns.len();
        let (mut q, mut qd, mut qdd) = (vec![0.0; n], vec![0.0; n], vec![0.0; n]);
        for frame in 0..self.grid.frames {
            for (c, [value, rate, acceleration]) in self.columns.iter().enumerate() {
                (q[c], qd[c], qdd[c]) = (value[frame], rate[frame], acceleration[frame]);
            }
            visit(frame, Posture { q: &q, qd: &qd, qdd: &qdd });
        }
    }
}

fn recorded_or_driven(
    model: &Model,
    motion: &mut SmoothMotion,
    id: CoordinateId,
    findings: &mut Findings,
) -> [Vec<f64>; 3] {
    let coordinate = &model.coordinates()[id.index()];
    if let Drive::Free = coordinate.drive
        && let Some(recorded) = motion.columns.get_mut(id.index()).and_then(Option::take)
    {
        return recorded;
    }
    let recorded = motion.columns.get_mut(id.index()).filter(|_| !matches!(coordinate.drive, Drive::Coupled(..)));
    let recorded = recorded.and_then(Option::take);
    let motion = &*motion;
    let (of_model, tolerance) = match &coordinate.drive {
        Drive::Prescribed(function) => {
            let times = [motion.grid.times(), vec![1.0; motion.grid.frames], zeros(motion)];
            (follow(&times, |t| function.at(t)), PRESCRIBED_TOLERANCE)
        }
        Drive::Locked | Drive::Coupled(..) | Drive::Free => {
            ([vec![coordinate.default_value; motion.grid.frames], zeros(motion), zeros(motion)], LOCK_TOLERANCE)
        }
    };
    let Some(recorded) = recorded else { return of_model };
    let worst = largest_difference(&recorded[0], &of_model[0]);
    if worst <= tolerance {
        return of_model;
    }
    report_replaced(coordinate, worst, findings);
    recorded
}

fn largest_difference(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// Warns that recorded values are used in place of those that the model locks or prescribes.
fn report_replaced(coordinate: &Coordinate, worst: f64, findings: &mut Findings) {
    let source = if matches!(coordinate.drive, Drive::Locked) { "is locked" } else { "is prescribed" };
    let unit = unit(coordinate);
    let message = format!(
        "coordinate `{}` {source} in the model; the recorded values, which differ by up to {worst:.3} {unit}, were \
         used, \
         as in OpenSim's inverse dynamics. hint: without this column the values of the model are used",
        coordinate.name
    );
    findings.report(Code::MotionModelReplaced, message);
}

fn unit(coordinate: &Coordinate) -> &'static str {
    if coordinate.kind == CoordinateKind::Translation { "m" } else { "rad" }
}

/// Free coordinates without a column, with their default values.
fn missing(model: &Model, motion: &SmoothMotion) -> Vec<String> {
    let is_missing = |(c, column): &(&Coordinate, &Option<_>)| matches!(c.drive, Drive::Free) && column.is_none();
    let missing = model
        .coordinates()
        .iter()
        .zip(&motion.columns)
        .filter(is_missing)
        .map(|(c, _)| format!("`{}` ({})", c.name, c.default_value));
    missing.collect()
}

fn report_missing(missing: &[String], findings: &mut Findings) {
    if !missing.is_empty() {
        let message =
            format!("the recording has no column for {}; the default values in brackets are used", missing.join(", "));
        findings.report(Code::MotionMissingCoordinate, message);
    }
}

fn zeros(motion: &SmoothMotion) -> Vec<f64> {
    vec![0.0; motion.grid.frames]
}

/// y = f(x), ẏ = f' ẋ, ÿ = f' ẍ + f'' ẋ².
fn follow(leader: &[Vec<f64>; 3], f: impl Fn(f64) -> [f64; 3]) -> [Vec<f64>; 3] {
    let mut out = leader.clone();
    for frame in 0..leader[0].len() {
        let (rate, acceleration) = (leader[1][frame], leader[2][frame]);
        let [y, dy, ddy] = f(leader[0][frame]);
        (out[0][frame], out[1][frame]) = (y, dy * rate);
        out[2][frame] = dy * acceleration + ddy * rate * rate;
    }
    out
}

/// Warns if a recorded column contradicts the values used.
fn report_mismatch(
    model: &Model,
    id: CoordinateId,
    recorded: Option<&Vec<f64>>,
    used: &[f64],
    findings: &mut Findings,
) {
    let Some(recorded) = recorded else { return };
    let coordinate = &model.coordinates()[id.index()];
    let worst = largest_difference(recorded, used);
    if worst <= COUPLER_TOLERANCE {
        return;
    }
    let unit = unit(coordinate);
    let in_degrees = recorded.iter().zip(used).all(|(a, b)| (a.to_radians() - b).abs() <= COUPLER_TOLERANCE);
    let guess = if in_degrees { "; the recorded column is in degrees under a header that states radians" } else { "" };
    let message = format!(
        "coordinate `{}` follows a coupler of the model; the recorded values, off by up to {worst:.3} {unit}, were not \
         used{guess}",
        coordinate.name
    );
    findings.report(Code::MotionCoupledMismatch, message);
}
