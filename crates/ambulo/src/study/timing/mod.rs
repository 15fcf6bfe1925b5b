//! Whether motion and measured forces have one clock and one place, and whether the clock runs at the right rate.
//!
//! Mechanics decides. Every frame needs a wrench from the ground; its part that carries the weight does not depend on
//! the clock, the rest is inertia, which changes with the square of the rate. [`force_delay`] shifts the measured
//! forces in time until they fit best, [`tempo`] stretches the time of the motion until it fits,
//! [`center_offset`] compares the places of the forces.
//! Pinned by: tests/study_timing.rs

mod center_offset;
mod force_delay;
mod tempo;

pub(super) use center_offset::{CenterOffset, MOST_OFFSET_M};
pub(super) use force_delay::{ForceDelay, PlateTiming};
pub(super) use tempo::Tempo;

use crate::analysis::Analysis;
use crate::dynamics::JointReaction;
use crate::kinematics::each_body_motion;
use crate::model::{BodyId, Model};
use crate::spatial::{Vec3, Wrench};

/// What one frame of a motion needs from the ground; wrenches are about the world's origin.
#[derive(Debug, Clone, Copy)]
struct NeededFrame {
    /// Time [s].
    time_s: f64,
    /// The whole wrench.
    whole: Wrench,
    /// The part that carries the weight of the body in this posture.
    weight: Wrench,
    /// Centre of the joint between body and ground [m].
    root: Vec3,
}

/// A body that one joint connects with the ground.
struct NeededWrenches {
    root: BodyId,
    frames: Vec<NeededFrame>,
}

impl NeededWrenches {
    /// Of a motion whose joint forces are known; `None` of a body with several joints to the ground.
    fn of(model: &Model, analysis: &Analysis) -> Option<NeededWrenches> {
        let mut roots = model.body_ids().filter(|id| model.bodies()[id.index()].joint.parent.is_none());
        let (root, None) = (roots.next()?, roots.next()) else { return None };
        let masses: Vec<f64> = model.bodies().iter().map(|body| body.inertia.mass()).collect();
        let gravity = model.gravity();
        let grid = analysis.trajectory.grid();
        let mut frames = Vec::with_capacity(grid.frames);
        each_body_motion(model, &analysis.trajectory, |frame, bodies| {
            let mut weight = Wrench::ZERO;
            for (body, mass) in bodies.iter().zip(&masses) {
                weight = sum(weight, Wrench { moment: Vec3::zeros(), force: -gravity * *mass }.about(body.center));
            }
            let JointReaction { center, wrench } = analysis.forces.reactions[root.index()][frame];
            let loads = analysis
                .ground
                .bodies
                .iter()
                .map(|load| Wrench { moment: load.moment[frame], force: load.force[frame] });
            let whole = loads.fold(wrench.about(center), sum);
            frames.push(NeededFrame { time_s: grid.time(frame), whole, weight, root: center });
        });
        Some(NeededWrenches { root, frames })
    }
}

fn sum(a: Wrench, b: Wrench) -> Wrench {
    Wrench { moment: a.moment + b.moment, force: a.force + b.force }
}

fn difference(a: Wrench, b: Wrench) -> Wrench {
    Wrench { moment: a.moment - b.moment, force: a.force - b.force }
}
