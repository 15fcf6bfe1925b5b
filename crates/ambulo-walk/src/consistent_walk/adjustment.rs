//! Size of the change that made a walk dynamically consistent, and of its remaining residual forces.

use super::walk::ConsistentWalk;
use crate::model::{CoordinateKind, Model, Side};
use crate::numerics::Progress;
use crate::optimal::{OptimalWalkError, Sample, Solution, WalkProblem};

/// Number of instants per cycle that are evaluated.
const INSTANTS: usize = 200;

/// Root mean square and maximum of the magnitude.
#[derive(Debug, Clone, Copy, Default, PartialEq, serde::Serialize, serde::Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(rename = "Size"))]
pub struct Magnitude {
    /// Root mean square.
    pub rms: f64,
    /// Largest.
    pub largest: f64,
}

impl Magnitude {
    /// Magnitude of values about zero.
    #[must_use]
    pub fn of(values: impl IntoIterator<Item = f64>) -> Magnitude {
        let (mut sum, mut count, mut largest) = (0.0, 0.0, 0.0_f64);
        for value in values {
            sum += value * value;
            count += 1.0;
            largest = largest.max(value.abs());
        }
        Magnitude { rms: if count > 0.0 { (sum / count).sqrt() } else { 0.0 }, largest }
    }

    /// The magnitude of the values times a factor above zero.
    #[must_use]
    pub fn times(self, factor: f64) -> Magnitude {
        Magnitude { rms: factor * self.rms, largest: factor * self.largest }
    }
}

/// Size of the change of a walk.
#[derive(Debug, Clone, PartialEq)]
pub struct Adjustment {
    /// Name and change of angle [rad] of each changed coordinate. Only the right side is listed if the left side is the
    /// same half a cycle later.
    pub angles: Vec<(String, Magnitude)>,
    /// Change of the pelvis path relative to even forward motion at mean height: forwards and up [m].
    pub pelvis: [Magnitude; 2],
}

/// How a gait was made dynamically consistent: the change of its motion, what is left, and the course of the solution.
#[derive(Debug, Clone, PartialEq)]
pub struct CorrectionReport {
    /// Number of free parameters.
    pub parameters: usize,
    /// Difference of the motion from the curves of the gait.
    pub adjustment: Adjustment,
    /// Remaining residual force [N] and residual moment [N.m] of the planned motion.
    pub residual: [Magnitude; 2],
    /// Progress of the solver.
    pub progress: Vec<Progress>,
}

impl CorrectionReport {
    /// Of the solution of a problem whose first guess is the gait, over the cycle of a walk [s].
    ///
    /// # Errors
    /// If the figure has joints that are not hinges or slides.
    pub fn of(problem: &WalkProblem, solution: &Solution, cycle_s: f64) -> Result<CorrectionReport, OptimalWalkError> {
        let curves = problem.problem.at(&problem.guess)?;
        let times: Vec<f64> = (0..INSTANTS).map(|k| cycle_s * k as f64 / INSTANTS as f64).collect();
        let samples = solution.samples(&times)?;
        let from_outside = |turns: bool| {
            let root = problem.problem.root();
            let of = |sample: &Sample| {
                let own = root.iter().filter(|(_, is_turning)| *is_turning == turns);
                own.map(|(id, _)| sample.forces[id.index()].powi(2)).sum::<f64>().sqrt()
            };
            Magnitude::of(samples.iter().map(of))
        };
        let stages = solution.progress.iter();
        Ok(CorrectionReport {
            parameters: solution.unknowns().len(),
            adjustment: adjustment([&curves, solution], &times),
            residual: [from_outside(false), from_outside(true)],
            progress: stages.map(|s| Progress { iterations: s.steps, from: s.from, to: s.cost }).collect(),
        })
    }
}

impl ConsistentWalk {
    /// How the gait was changed.
    ///
    /// # Errors
    /// Does not fail for a walk that was computed.
    pub fn report(&self) -> Result<CorrectionReport, OptimalWalkError> {
        CorrectionReport::of(&self.problem, &self.solution, self.walk.cycle_s())
    }
}

fn adjustment([curves, found]: [&Solution; 2], times: &[f64]) -> Adjustment {
    let model: &Model = &found.problem().model;
    let is_mirrored = found.problem().span == crate::optimal::Span::MirroredHalfCycle;
    let count = model.coordinates().len();
    let mut differences = vec![Vec::with_capacity(times.len()); count];
    let [mut before, mut after] = [(); 2].map(|()| [(); 3].map(|()| vec![0.0; count]));
    for &time_s in times {
        curves.write(time_s, &mut before);
        found.write(time_s, &mut after);
        for (column, (new, old)) in differences.iter_mut().zip(after[0].iter().zip(&before[0])) {
            column.push(new - old);
        }
    }
    let path = |name: &str| {
        let Some(id) = model.coordinate(name) else { return Magnitude::default() };
        let column = &differences[id.index()];
        let mean = column.iter().sum::<f64>() / column.len() as f64;
        Magnitude::of(column.iter().map(|x| x - mean))
    };
    let listed = model.coordinates().iter().zip(&differences).filter(|(coordinate, _)| {
        let is_left = Side::split_name(&coordinate.name).is_some_and(|(side, _)| side == Side::Left);
        coordinate.kind == CoordinateKind::Rotation && !(is_left && is_mirrored)
    });
    let angles = listed.map(|(c, column)| (c.name.clone(), Magnitude::of(column.iter().copied()))).collect();
    Adjustment { angles, pelvis: ["pelvis_tx", "pelvis_ty"].map(path) }
}
