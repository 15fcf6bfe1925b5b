//! Foot progression: the angle of a foot to the walking direction.
//!
//!   Wᵀ R(t) F = R_z(pitch) R_x(roll) R_y(φ)
//!
//! | symbol | meaning |
//! |---|---|
//! | W | axes of the walk: direction of the pelvis over the floor or belt from the foot strike to the next one of the same foot, up, right |
//! | R(t) | rotation of the foot |
//! | F | axes in the foot: in the neutral posture from the rear of the sole to the ball without the vertical part, up, right |
//! | φ | turn about the upright axis of the foot [rad]; internal (toes towards the other foot) is positive |
//!
//! While the foot is flat, φ is the angle between its direction and the walking direction, seen from above. While it
//! points down, as at foot off, that angle would be one between short projections; φ is then still the turn of the foot
//! itself, as angles of the pelvis are (`clinical_angles`).
//!
//! Source: the sign follows Schwartz, Rozumalski, Trost 2008 (docs/SESSION.md).
//! Not handled: cycles in which the pelvis stays within 0.2 m; they have no walking direction.
//! Pinned by: tests/analysis_foot_progression.rs

use super::cycles::{Cycle, over_cycle_of};
use super::recording::Analysis;
use super::times_and_distances::{Floor, LEAST_STRIDE_M, PelvisPath};
use crate::kinematics::calibration::angles_zxy;
use crate::kinematics::each_body_motion;
use crate::model::anatomy::{Sole, SolePoint};
use crate::model::{BodyId, BySide, Model, Side};
use crate::spatial::{Mat3, Vec3};

/// A sole that is shorter has no direction [m].
const LEAST_SOLE_M: f64 = 0.01;

/// Foot progression over each cycle of an analysis [rad], internal positive: 101 values per cycle, in the order of
/// [`Analysis::cycles`]. `None` for a foot without a sole, and for a cycle without a walking direction.
#[must_use]
pub fn foot_progression(model: &Model, soles: &BySide<Option<Sole>>, analysis: &Analysis) -> Vec<Option<Vec<f64>>> {
    let floor = Floor::of(model, analysis);
    let path = PelvisPath::of(model, analysis, floor);
    let own_axes = BySide::from_fn(|side| axes_in_foot(model, soles[side].as_ref()?));
    let mut feet: BySide<Vec<Mat3>> = BySide::default();
    each_body_motion(model, &analysis.trajectory, |_, bodies| {
        for (side, own) in own_axes.iter() {
            feet[side].extend(own.map(|(foot, axes)| bodies[foot.index()].pose.rotation * axes));
        }
    });
    let grid = analysis.trajectory.grid();
    let of_cycle = |cycle: &Cycle| {
        let moved = path.as_ref()?.between([cycle.start_s, cycle.end_s])?;
        let walk = level_axes(moved.try_normalize(LEAST_STRIDE_M)?, model.up());
        let foot = &feet[cycle.side];
        let angle = |frame: usize| inwards(&walk, &foot[frame], cycle.side);
        (!foot.is_empty()).then(|| over_cycle_of(grid, angle, cycle))
    };
    analysis.cycles.iter().map(of_cycle).collect()
}

/// The foot, and F in its frame.
fn axes_in_foot(model: &Model, sole: &Sole) -> Option<(BodyId, Mat3)> {
    let neutral = model.anatomy().neutral()?;
    let [rear, ball, _] = sole.points;
    let place = |point: SolePoint| neutral.poses[point.body.index()].place(point.place);
    let along = place(ball) - place(rear);
    let ahead = (along - model.up() * along.dot(&model.up())).try_normalize(LEAST_SOLE_M)?;
    let axes = level_axes(ahead, model.up());
    Some((rear.body, neutral.poses[rear.body.index()].rotation.transpose() * axes))
}

/// Ahead, up and right as columns.
pub fn level_axes(ahead: Vec3, up: Vec3) -> Mat3 {
    Mat3::from_columns(&[ahead, up, ahead.cross(&up)])
}

/// φ of a foot with these axes in the world [rad].
pub fn inwards(walk: &Mat3, foot: &Mat3, side: Side) -> f64 {
    let [_, _, to_the_left] = angles_zxy(&(walk.transpose() * foot));
    if side == Side::Right { to_the_left } else { -to_the_left }
}
