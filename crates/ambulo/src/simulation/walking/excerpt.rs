//! A part of a walk, as an analysis wants it: complete motion, and the loads under each body of the feet.

use super::feet::FootRecord;
use super::recording::WalkRecording;
use crate::kinematics::{Trajectory, TrajectoryError};
use crate::model::BodyId;
use crate::motion::{ForceRecording, TimeGrid};
use crate::spatial::Vec3;
use std::ops::Range;

/// Which rows of a walk.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ExcerptRows {
    /// The first; the clock is zero there.
    pub first: usize,
    /// How far from one to the next in the motion; forces are kept at all rows.
    pub every: usize,
    /// How many.
    pub frames: usize,
}

impl ExcerptRows {
    /// The n-th of them.
    #[must_use]
    pub fn row(&self, n: usize) -> usize {
        self.first + self.every * n
    }

    /// From the first to the last, every one.
    #[must_use]
    pub fn all(&self) -> Range<usize> {
        self.first..self.row(self.frames.saturating_sub(1)) + 1
    }
}

/// A part of a walk.
#[derive(Debug, Clone)]
pub struct Excerpt {
    /// Every coordinate with rate and acceleration.
    pub trajectory: Trajectory,
    /// What the ground does to the feet, to their toes apart: force, and moment about the world's origin.
    pub loads: Vec<ForceRecording>,
    /// What drives each coordinate, one column a coordinate [N.m].
    pub efforts: Vec<Vec<f64>>,
}

impl WalkRecording {
    /// Some rows of the walk; those that it does not have are left out.
    ///
    /// # Errors
    /// None that a recording can give: its numbers are finite.
    pub fn excerpt(&self, rows: ExcerptRows) -> Result<Excerpt, TrajectoryError> {
        let grid = self.grid();
        let every = rows.every.max(1);
        let there = grid.frames.saturating_sub(rows.first).div_ceil(every);
        let rows = ExcerptRows { every, frames: rows.frames.min(there), ..rows };
        let taken = |series: &[f64]| (0..rows.frames).map(|n| series[rows.row(n)]).collect::<Vec<f64>>();
        let t = &self.trajectory;
        let column = |id| [t.values(id), t.rates(id), t.accelerations(id)].map(taken);
        let columns = self.model.coordinate_ids().map(column).collect();
        let short = TimeGrid { start_s: 0.0, step_s: grid.step_s * every as f64, frames: rows.frames };
        let times: Vec<f64> = rows.all().map(|row| grid.step_s * (row - rows.first) as f64).collect();
        let loads = ["right", "left"].iter().zip(&self.feet).flat_map(|(side, foot)| loads(side, foot, &rows, &times));
        Ok(Excerpt {
            trajectory: Trajectory::new(&self.model, short, columns)?,
            loads: loads.collect(),
            efforts: self.efforts.iter().map(|effort| taken(effort)).collect(),
        })
    }
}

/// What the heel's body and the toes of a foot feel.
fn loads(side: &str, foot: &FootRecord, rows: &ExcerptRows, times: &[f64]) -> Vec<ForceRecording> {
    let of_toes = |row: usize| {
        foot.toes.as_ref().map_or((Vec3::zeros(), Vec3::zeros()), |toes| (toes.force[row], toes.moment[row]))
    };
    let of_rest = |row: usize| {
        let (force, moment) = of_toes(row);
        (foot.force[row] - force, foot.moment[row] - moment)
    };
    let load = |name: String, body: BodyId, at: &dyn Fn(usize) -> (Vec3, Vec3)| {
        let (force, moment) = rows.all().map(at).unzip();
        let point = vec![Vec3::zeros(); times.len()];
        ForceRecording { name, body, force_frame: None, point_frame: None, times: times.to_vec(), force, point, moment }
    };
    let toes = foot.toes.as_ref().map(|toes| load(format!("{side} toes"), toes.body, &of_toes));
    std::iter::once(load(format!("{side} foot"), foot.body, &of_rest)).chain(toes).collect()
}
