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
    /// Per coordinate: value, rate, acceleration, one entry per frame.
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

/// Largest difference between a recorded coordinate and its coupler or lock without a warning [rad or m].
const COUPLER_TOLERANCE: f64 = 0.02;

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

    /// Completes a smoothed recording: locked, prescribed and missing coordinates get the values of the model, coupled
    /// ones follow their coupler. A recorded column that contradicts them is not used, with a warning.
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
    let motion = &*motion;
    let held = || [vec![coordinate.default_value; motion.grid.frames], zeros(motion), zeros(motion)];
    match (&coordinate.drive, motion.column(id)) {
        (Drive::Locked, recorded) => {
            report_mismatch(model, id, recorded.map(|c| &c[0]), &held()[0], findings);
            held()
        }
        (Drive::Prescribed(function), _) => {
            let times = [motion.grid.times(), vec![1.0; motion.grid.frames], zeros(motion)];
            follow(&times, |t| function.at(t))
        }
        (Drive::Coupled(..) | Drive::Free, _) => held(),
    }
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
    let worst = recorded.iter().zip(used).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    if worst <= COUPLER_TOLERANCE {
        return;
    }
    let unit = if coordinate.kind == CoordinateKind::Translation { "m" } else { "rad" };
    let source = match coordinate.drive {
        Drive::Locked => "is locked in the model",
        _ => "follows a coupler of the model",
    };
    let in_degrees = recorded.iter().zip(used).all(|(a, b)| (a.to_radians() - b).abs() <= COUPLER_TOLERANCE);
    let guess = if in_degrees { "; the recorded column is in degrees under a header that states radians" } else { "" };
    let message = format!(
        "coordinate `{}` {source}; the recorded values, off by up to {worst:.3} {unit}, were not used{guess}",
        coordinate.name
    );
    findings.report(Code::MotionCoupledMismatch, message);
}
