//! Where the soles are and how they move.

use crate::ground::sole::Sole;
use crate::ground::upward;
use crate::kinematics::{Trajectory, each_body_motion};
use crate::model::{Model, Side};
use crate::spatial::Vec3;

/// The three points of one sole, frame by frame.
pub(super) struct FootPath {
    pub(super) side: Side,
    /// Direction against gravity.
    pub(super) up: Vec3,
    /// Rear, ball and tip [m], one entry a frame.
    pub(super) places: Vec<[Vec3; 3]>,
    /// Their velocities [m/s].
    pub(super) velocities: Vec<[Vec3; 3]>,
}

impl FootPath {
    /// Height of the lowest point [m].
    pub(super) fn lowest(&self, frame: usize) -> f64 {
        self.places[frame].iter().map(|p| p.dot(&self.up)).fold(f64::INFINITY, f64::min)
    }
}

/// The paths of the soles that there are.
pub(super) fn foot_paths(model: &Model, trajectory: &Trajectory, soles: &[Option<Sole>; 2]) -> Vec<FootPath> {
    let (up, frames) = (upward(model), trajectory.grid().frames);
    let mut paths: Vec<(Sole, FootPath)> = Vec::new();
    for (side, sole) in Side::BOTH.into_iter().zip(soles) {
        let (places, velocities) = (Vec::with_capacity(frames), Vec::with_capacity(frames));
        paths.extend(sole.map(|sole| (sole, FootPath { side, up, places, velocities })));
    }
    each_body_motion(model, trajectory, |_, bodies| {
        for (sole, path) in &mut paths {
            let moves = sole.points.map(|point| {
                let body = &bodies[point.body.index()];
                let place = body.pose.place(point.place);
                (place, body.twist.velocity_at(place - body.center))
            });
            path.places.push(moves.map(|(place, _)| place));
            path.velocities.push(moves.map(|(_, velocity)| velocity));
        }
    });
    paths.into_iter().map(|(_, path)| path).collect()
}
