//! The recording of a simulated walk, and excerpts of it for analysis.

use super::feet::FootRecord;
use crate::kinematics::{Trajectory, TrajectoryError};
use crate::model::{BodyId, CoordinateId, Model, Side};
use crate::motion::{ForceRecording, TimeGrid};
use crate::spatial::Vec3;
use std::ops::Range;

/// A simulated walk: posture, forces in the joints and on the ground, one row per time step, and impacts separately.
#[derive(Debug, Clone)]
pub struct WalkRecording {
    /// The figure's model.
    pub model: Model,
    /// Every coordinate of the model with rate and acceleration.
    pub trajectory: Trajectory,
    /// Moments of the drives [N.m], one column per coordinate of the model. The one of the root's rotation holds the
    /// trunk from outside; the columns of the root's translations are zero.
    pub efforts: Vec<Vec<f64>>,
    /// Ground reactions, right and left.
    pub feet: [FootRecord; 2],
    /// Impacts of the feet, in order of time.
    pub impacts: Vec<FootImpact>,
    /// Number of steps whose contacts were not solved to the tolerance.
    pub unsolved_steps: usize,
}

/// An impact of a foot with the ground.
#[derive(Debug, Clone, PartialEq)]
pub struct FootImpact {
    /// Time [s].
    pub time_s: f64,
    /// Impulse on each foot [N.s], right and left.
    pub impulses: [Vec3; 2],
    /// Impulse along each coordinate of the model [N.m.s].
    pub efforts: Vec<f64>,
}

impl WalkRecording {
    /// Times of the rows.
    #[must_use]
    pub fn grid(&self) -> TimeGrid {
        self.trajectory.grid()
    }

    /// The coordinate of this name, if the model has one.
    #[must_use]
    pub fn coordinate(&self, name: &str) -> Option<CoordinateId> {
        self.model.coordinate(name)
    }

    /// Moment of the drive of a coordinate [N.m], one entry per row; `None` if there is no coordinate of this name.
    #[must_use]
    pub fn effort(&self, name: &str) -> Option<&[f64]> {
        self.coordinate(name).map(|id| self.efforts[id.index()].as_slice())
    }

    /// Ground reaction on the foot of a side.
    #[must_use]
    pub fn foot(&self, side: Side) -> &FootRecord {
        &self.feet[usize::from(side == Side::Left)]
    }

    /// Whether no foot is loaded in a row.
    #[must_use]
    pub fn flies(&self, row: usize) -> bool {
        !self.feet.iter().any(|foot| foot.loaded(row))
    }

    /// Whether both feet are loaded in a row.
    #[must_use]
    pub fn stands_on_both(&self, row: usize) -> bool {
        self.feet.iter().all(|foot| foot.loaded(row))
    }

    /// Forward velocity of the mid-hip [m/s], one entry per row.
    #[must_use]
    pub fn speed(&self) -> &[f64] {
        self.coordinate("pelvis_tx").map_or(&[], |id| self.trajectory.rates(id))
    }

    /// Recordings as of a force plate under each foot, right and left.
    #[must_use]
    pub fn plates(&self) -> [ForceRecording; 2] {
        let times = self.grid().times();
        let [right, left] = &self.feet;
        [right.as_recording("ground_force_r", times.clone()), left.as_recording("ground_force_l", times)]
    }
}

/// The rows of an excerpt.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct ExcerptRows {
    /// The first row; the excerpt's time is zero there.
    pub first: usize,
    /// Rows from one frame of the motion to the next; forces keep all rows.
    pub every: usize,
    /// Number of frames.
    pub frames: usize,
}

impl ExcerptRows {
    /// The row of frame n.
    #[must_use]
    pub(crate) fn row(&self, n: usize) -> usize {
        self.first + self.every * n
    }

    /// All rows from the first frame to the last.
    #[must_use]
    pub(crate) fn all(&self) -> Range<usize> {
        self.first..self.row(self.frames.saturating_sub(1)) + 1
    }
}

/// A part of a walk: complete motion, and the loads on each body of the feet.
#[derive(Debug, Clone)]
pub(crate) struct Excerpt {
    /// Every coordinate with rate and acceleration.
    pub trajectory: Trajectory,
    /// Ground reactions on feet and toes, as force and moment about the world's origin.
    pub loads: Vec<ForceRecording>,
    /// Moments of the drives [N.m], one column per coordinate.
    pub efforts: Vec<Vec<f64>>,
}

impl WalkRecording {
    /// An excerpt of the walk. Rows that the walk does not have are left out.
    ///
    /// # Errors
    /// None for a recording: its numbers are finite.
    pub(crate) fn excerpt(&self, rows: ExcerptRows) -> Result<Excerpt, TrajectoryError> {
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
        let loads = loads(&self.feet, rows.all(), &times);
        Ok(Excerpt {
            trajectory: Trajectory::new(&self.model, short, columns)?,
            loads,
            efforts: self.efforts.iter().map(|effort| taken(effort)).collect(),
        })
    }
}

/// Loads on the heel's body and on the toes of each foot in some rows, as force and moment about the world's origin.
pub(crate) fn loads(feet: &[FootRecord; 2], rows: Range<usize>, times: &[f64]) -> Vec<ForceRecording> {
    let sides = ["right", "left"].iter().zip(feet);
    sides.flat_map(|(side, foot)| loads_of_foot(side, foot, &rows, times)).collect()
}

fn loads_of_foot(side: &str, foot: &FootRecord, rows: &Range<usize>, times: &[f64]) -> Vec<ForceRecording> {
    let of_toes = |row: usize| {
        foot.toes.as_ref().map_or((Vec3::zeros(), Vec3::zeros()), |toes| (toes.force[row], toes.moment[row]))
    };
    let of_rest = |row: usize| {
        let (force, moment) = of_toes(row);
        (foot.force[row] - force, foot.moment[row] - moment)
    };
    let load = |name: String, body: BodyId, at: &dyn Fn(usize) -> (Vec3, Vec3)| {
        let (force, moment) = rows.clone().map(at).unzip();
        let point = vec![Vec3::zeros(); times.len()];
        ForceRecording { name, body, force_frame: None, point_frame: None, times: times.to_vec(), force, point, moment }
    };
    let toes = foot.toes.as_ref().map(|toes| load(format!("{side} toes"), toes.body, &of_toes));
    std::iter::once(load(format!("{side} foot"), foot.body, &of_rest)).chain(toes).collect()
}
