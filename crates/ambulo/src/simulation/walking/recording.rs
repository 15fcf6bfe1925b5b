//! What happened in a walk.

use super::feet::FootRecord;
use crate::kinematics::Trajectory;
use crate::model::{CoordinateId, Model, Side};
use crate::motion::{ForceRecording, TimeGrid};
use crate::spatial::Vec3;

/// A walk: posture and forces, one row a step.
#[derive(Debug, Clone)]
pub struct WalkRecording {
    /// The figure.
    pub model: Model,
    /// Every coordinate of the model with rate and acceleration.
    pub trajectory: Trajectory,
    /// What drives each coordinate, one column a coordinate of the model [N.m]; that of the root's turn is the torque which
    /// holds the trunk from outside; the root's slides have none.
    pub efforts: Vec<Vec<f64>>,
    /// Right and left.
    pub feet: [FootRecord; 2],
    /// Impacts, in order of time.
    pub impacts: Vec<FootImpact>,
    /// Steps whose contacts the solver did not solve to its tolerance.
    pub unsolved_steps: usize,
}

/// A foot strikes the ground.
#[derive(Debug, Clone, PartialEq)]
pub struct FootImpact {
    /// When [s].
    pub time_s: f64,
    /// Whose points struck or were pressed by the impact, with the impulse on each foot [N.s].
    pub impulses: [Vec3; 2],
    /// Impulse along each coordinate of the model [N.m.s].
    pub efforts: Vec<f64>,
}

impl WalkRecording {
    /// The instants of the rows.
    #[must_use]
    pub fn grid(&self) -> TimeGrid {
        self.trajectory.grid()
    }

    /// A coordinate of the model by its name.
    #[must_use]
    pub fn coordinate(&self, name: &str) -> Option<CoordinateId> {
        self.model.coordinate(name)
    }

    /// What drives a coordinate [N.m], one entry a row; none of that name is `None`.
    #[must_use]
    pub fn effort(&self, name: &str) -> Option<&[f64]> {
        self.coordinate(name).map(|id| self.efforts[id.index()].as_slice())
    }

    /// The foot of a side.
    #[must_use]
    pub fn foot(&self, side: Side) -> &FootRecord {
        &self.feet[usize::from(side == Side::Left)]
    }

    /// Whether no foot is pressed in a row.
    #[must_use]
    pub fn flies(&self, row: usize) -> bool {
        !self.feet.iter().any(|foot| foot.loaded(row))
    }

    /// Whether both feet are pressed in a row.
    #[must_use]
    pub fn stands_on_both(&self, row: usize) -> bool {
        self.feet.iter().all(|foot| foot.loaded(row))
    }

    /// Forward velocity of the mid-hip [m/s], one entry a row.
    #[must_use]
    pub fn speed(&self) -> &[f64] {
        self.coordinate("pelvis_tx").map_or(&[], |id| self.trajectory.rates(id))
    }

    /// What plates under each foot would have measured.
    #[must_use]
    pub fn plates(&self) -> [ForceRecording; 2] {
        let times = self.grid().times();
        let [right, left] = &self.feet;
        [right.as_recording("ground_force_r", times.clone()), left.as_recording("ground_force_l", times)]
    }
}
