//! Results of a stream: the forces on both feet and in all joints in one frame.

use crate::dynamics::{BodyLoad, Workspace, inverse_frame};
use crate::ground::BodyForces;
use crate::ground::predict::Prediction;
use crate::kinematics::Posture;
use crate::model::{Model, Side};
use crate::spatial::{Vec3, Wrench};

/// Forces in one frame.
#[derive(Debug, Clone, PartialEq)]
pub struct StreamFrame {
    /// Number of the frame, from 0.
    pub frame: usize,
    /// Time since the first frame [s].
    pub time_s: f64,
    /// Right and left foot.
    pub feet: [FootLoad; 2],
    /// Generalised forces under these loads, one per coordinate of the model [N.m or N].
    pub generalized: Vec<f64>,
}

/// Ground reaction force on one foot, with standard deviations.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FootLoad {
    /// Side of the foot.
    pub side: Side,
    /// Force [N]; zero in swing.
    pub force: Vec3,
    /// Moment about the world's origin [N.m].
    pub moment: Vec3,
    /// Centre of pressure [m]; `None` below [`crate::ground::CENTER_OF_PRESSURE_LOAD_N`].
    pub center_of_pressure: Option<Vec3>,
    /// Free moment [N.m]; zero without a centre of pressure.
    pub free_moment: f64,
    /// Standard deviations.
    pub deviation: LoadDeviation,
}

/// Standard deviations of a foot's load; zero in swing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoadDeviation {
    /// Standard deviation of the force [N].
    pub force: Vec3,
    /// Standard deviation of the centre of pressure [m].
    pub center: Vec3,
    /// Standard deviation of the free moment [N.m].
    pub free_moment: f64,
}

impl FootLoad {
    /// Whether the foot is loaded enough for a centre of pressure.
    #[must_use]
    pub fn loaded(&self) -> bool {
        self.center_of_pressure.is_some()
    }
}

/// The forces in one frame of a window. `row` is its row in the prediction; `number` and `time_s` count in the stream.
pub(super) fn read(
    model: &Model,
    workspace: &mut Workspace,
    posture: Posture<'_>,
    (prediction, row): (&Prediction, usize),
    (number, time_s): (usize, f64),
) -> StreamFrame {
    let feet = Side::BOTH.map(|side| foot_load(model, prediction, side, row));
    let bodies = &prediction.ground.bodies;
    let load = |(body, foot): (&BodyForces, &FootLoad)| BodyLoad {
        body: body.body,
        point: Vec3::zeros(),
        wrench: Wrench { force: foot.force, moment: foot.moment },
    };
    let loads: Vec<BodyLoad> = bodies.iter().zip(&feet).map(load).collect();
    let forces = inverse_frame(workspace, posture, &loads);
    StreamFrame { frame: number, time_s, feet, generalized: forces.generalized().to_vec() }
}

fn foot_load(model: &Model, prediction: &Prediction, side: Side, frame: usize) -> FootLoad {
    let (foot, deviation) = prediction.foot(side);
    let center = Some(foot.center_of_pressure[frame]).filter(|center| center.iter().all(|x| x.is_finite()));
    FootLoad {
        side,
        force: foot.force[frame],
        moment: foot.moment[frame],
        center_of_pressure: center,
        free_moment: center.map_or(0.0, |_| foot.free_moment[frame].dot(&model.up())),
        deviation: LoadDeviation {
            force: deviation.force[frame],
            center: deviation.center[frame],
            free_moment: deviation.free_moment[frame],
        },
    }
}
