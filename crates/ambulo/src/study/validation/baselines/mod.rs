//! Simple published rules for ground forces from motion alone, against which [`crate::ground::predict`] is judged.
//!
//! | rule | total force | divided between the feet | centre of pressure |
//! |---|---|---|---|
//! | [`Baseline::FootHeight`] | the weight, upwards | by exp(-height of the foot) ([`foot_height`]) | the middle of the foot |
//! | [`Baseline::SmoothTransition`] | Newton's law for all segments ([`total_wrench`](crate::ground::predict::total_wrench)) | by time in double support ([`smooth_transition`]) | from heel to ball |
//!
//! None of them has standard deviations or a free moment.
//! Pinned by: tests/ground_baselines.rs

pub mod foot_height;
pub mod smooth_transition;

use crate::analysis::{Analysis, WalkingDirection, residual};
use crate::dynamics::{Workspace, inverse_with_residual};
use crate::ground::footfalls::Footfalls;
use crate::ground::predict::Prediction;
use crate::ground::{BodyForces, GroundForces};
use crate::kinematics::{Trajectory, each_body_motion};
use crate::model::anatomy::{Sole, SolePoint};
use crate::model::{BySide, Model, Side};
use crate::spatial::{Vec3, Wrench};

/// A simple rule.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Baseline {
    /// The weight, divided by the heights of the feet.
    FootHeight,
    /// The total force, handed over along fixed curves in double support.
    SmoothTransition,
}

/// Input of the rules.
#[derive(Clone, Copy)]
pub(super) struct BaselineInput<'a> {
    /// The body.
    model: &'a Model,
    /// Its motion.
    trajectory: &'a Trajectory,
    /// The soles of both feet.
    soles: &'a BySide<Sole>,
    /// The stances of both feet.
    footfalls: &'a Footfalls,
    /// Total force [N] and moment about the world's origin [N.m] that the motion requires, one entry per frame.
    total: &'a [Wrench],
    /// The walking direction during a time span [s], a unit vector.
    forward: &'a dyn Fn([f64; 2]) -> Vec3,
}

/// Force on a foot and its point of application, one entry per frame.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct AppliedForce {
    /// [N]
    force: Vec<Vec3>,
    /// On the floor [m].
    point: Vec<Vec3>,
}

impl Baseline {
    /// All rules, in the order of tables.
    pub const ALL: [Baseline; 2] = [Baseline::FootHeight, Baseline::SmoothTransition];

    /// The analysis of the same motion with the ground forces of this rule in place of `prediction`, which
    /// gives the stances and the total force. `None` without the soles of both feet.
    #[must_use]
    pub fn analysis(
        self,
        model: &Model,
        analysis: &Analysis,
        prediction: &Prediction,
        soles: &BySide<Option<Sole>>,
    ) -> Option<Analysis> {
        let trajectory = &analysis.trajectory;
        let direction = WalkingDirection::of(model, trajectory, &prediction.footfalls);
        let input = BaselineInput {
            model,
            trajectory,
            soles: &soles.both()?,
            footfalls: &prediction.footfalls,
            total: &prediction.total,
            forward: &|span_s| direction.during(span_s)[0],
        };
        let ground = self.ground(&input);
        let forces = inverse_with_residual(&mut Workspace::new(model), trajectory, &ground.loads());
        let residual = residual(model, &forces);
        Some(Analysis { ground, forces, residual, ..analysis.clone() })
    }

    /// Ground forces on both feet by this rule.
    fn ground(self, input: &BaselineInput<'_>) -> GroundForces {
        let places = places(input);
        let feet = match self {
            Baseline::FootHeight => foot_height::forces(input, &places),
            Baseline::SmoothTransition => smooth_transition::forces(input, &places),
        };
        let up = input.model.up();
        let on_foot = |(side, applied): (Side, &AppliedForce)| {
            let AppliedForce { force, point } = applied;
            let moment: Vec<Vec3> = point.iter().zip(force).map(|(point, force)| point.cross(force)).collect();
            let height: Vec<f64> = point.iter().map(|point| point.dot(&up)).collect();
            BodyForces::on_ground(input.soles[side].points[0].body, force, &moment, up, &height)
        };
        GroundForces { bodies: feet.iter().map(on_foot).collect() }
    }
}

/// Points of a foot in one frame [m].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct FootPoints {
    /// Rear, ball and tip of the sole.
    sole: [Vec3; 3],
    /// The ankle; the rear of the sole where the model has none.
    ankle: Vec3,
}

fn places(input: &BaselineInput<'_>) -> BySide<Vec<FootPoints>> {
    let BaselineInput { model, trajectory, soles, .. } = input;
    let legs = model.anatomy().legs();
    let mut all = BySide { right: Vec::new(), left: Vec::new() };
    each_body_motion(model, trajectory, |_, bodies| {
        for (side, sole) in soles.iter() {
            let place = |point: &SolePoint| bodies[point.body.index()].pose.place(point.place);
            let [rear, ball, tip] = &sole.points;
            let sole = [place(rear), place(ball), place(tip)];
            let ankle = legs[side].as_ref().map(|leg| {
                let joint = &model.bodies()[leg.ankle.index()].joint;
                bodies[leg.ankle.index()].pose.place(joint.child_from_joint.translation)
            });
            all[side].push(FootPoints { sole, ankle: ankle.unwrap_or(sole[0]) });
        }
    });
    all
}

/// A point moved along the vertical to a height.
fn at_height(point: Vec3, up: Vec3, height_m: f64) -> Vec3 {
    point + up * (height_m - point.dot(&up))
}
