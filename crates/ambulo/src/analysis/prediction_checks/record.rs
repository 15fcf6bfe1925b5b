//! The whole body's wrench and both soles in axes that move with the floor: the data that the checks use.

use super::CheckedPrediction;
use crate::ground::footfalls::Footfall;
use crate::kinematics::each_body_motion;
use crate::model::{Displacement, Model, Side};
use crate::motion::TimeGrid;
use crate::spatial::{Vec3, Wrench};

/// Series with one entry per frame. Positions are relative to the moving floor, so that a sole in stance on a belt is
/// at rest.
#[derive(Debug, Clone)]
pub(super) struct Record {
    pub(super) grid: TimeGrid,
    /// Against gravity.
    pub(super) up: Vec3,
    /// Body weight [N].
    pub(super) weight: f64,
    /// Velocity of the mass centre over the floor [m/s].
    pub(super) velocity: Vec<Vec3>,
    /// Rear, ball and tip of right and left sole [m].
    pub(super) soles: [Vec<[Vec3; 3]>; 2],
    /// Height of the ground under right and left foot [m]; `None` while not in stance.
    pub(super) stands_on: [Vec<Option<f64>>; 2],
    /// Force of the ground on the body, and moment about the floor's origin.
    pub(super) total: Vec<Wrench>,
    /// Half the width of right and left sole [m].
    pub(super) half_widths: [f64; 2],
    /// Normal of the plane in which the root joint keeps the body, if it does.
    pub(super) plane_normal: Option<Vec3>,
}

impl Record {
    /// `None` without both soles.
    pub(super) fn of(evidence: &CheckedPrediction<'_>) -> Option<Record> {
        let CheckedPrediction { model, trajectory, prediction, soles, .. } = *evidence;
        let soles_of_body = [soles.right?, soles.left?];
        let (grid, floor) = (trajectory.grid(), prediction.footfalls.floor_velocity);
        let way = |frame: usize| floor * (grid.time(frame) - grid.start_s);
        let mut velocity = Vec::with_capacity(grid.frames);
        let mut soles = [(); 2].map(|()| Vec::with_capacity(grid.frames));
        each_body_motion(model, trajectory, |frame, bodies| {
            let momentum: Vec3 =
                model.bodies().iter().zip(bodies).map(|(b, m)| m.twist.linear * b.inertia.mass()).sum();
            velocity.push(momentum / model.mass() - floor);
            for (list, sole) in soles.iter_mut().zip(&soles_of_body) {
                list.push(sole.points.map(|p| bodies[p.body.index()].pose.place(p.place) - way(frame)));
            }
        });
        let stands_on = Side::BOTH.map(|side| {
            let on = |frame: usize| prediction.footfalls.of(side).find(|fall| holds(fall, grid.time(frame)));
            (0..grid.frames).map(|frame| on(frame).map(|fall| fall.floor_height_m)).collect()
        });
        let on_floor = |(frame, wrench): (usize, &Wrench)| wrench.about(-way(frame));
        Some(Record {
            grid,
            up: model.up(),
            weight: model.mass() * model.gravity().norm(),
            velocity,
            soles,
            stands_on,
            total: prediction.total.iter().enumerate().map(on_floor).collect(),
            half_widths: soles_of_body.map(|sole| sole.half_width),
            plane_normal: plane_normal(model),
        })
    }

    /// Frames in a time [s], at least one.
    pub(super) fn frames_in(&self, duration_s: f64) -> usize {
        ((duration_s / self.grid.step_s).round() as usize).max(1)
    }
}

fn holds(fall: &Footfall, time: f64) -> bool {
    fall.strike_s.is_none_or(|strike| strike <= time) && fall.off_s.is_none_or(|off| time <= off)
}

/// The rotation axis of a root that rotates about one axis only and translates.
fn plane_normal(model: &Model) -> Option<Vec3> {
    let joint = &model.bodies().iter().find(|body| body.joint.parent.is_none())?.joint;
    let moves = |axis: &&crate::model::JointAxis| matches!(axis.displacement, Displacement::Follows(..));
    let mut turns = joint.rotations.iter().filter(moves);
    let (first, second) = (turns.next()?, turns.next());
    let is_plane = second.is_none() && joint.translations.iter().any(|axis| moves(&axis));
    is_plane.then(|| joint.parent_from_joint.rotation * first.direction)
}
