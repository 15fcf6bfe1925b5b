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
//! While the foot is flat, φ is the angle between its direction and the walking direction, seen from above. While it points down, as at foot off,
//! that angle would be one between short projections; φ is then still the turn of the foot itself, as angles of the pelvis are (`clinical_angles`).
//!
//! Source: the sign is that of Schwartz, Rozumalski, Trost 2008 (docs/SESSION.md).
//! Not handled: cycles in which the pelvis stays within 0.2 m; they have no walking direction.
//! Pinned by: its own tests

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
fn level_axes(ahead: Vec3, up: Vec3) -> Mat3 {
    Mat3::from_columns(&[ahead, up, ahead.cross(&up)])
}

/// φ of a foot with these axes in the world [rad].
fn inwards(walk: &Mat3, foot: &Mat3, side: Side) -> f64 {
    let [_, _, to_the_left] = angles_zxy(&(walk.transpose() * foot));
    if side == Side::Right { to_the_left } else { -to_the_left }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Rotation3;

    /// A foot that is turned to the left by the first angle, then pitched toes down by the second [deg].
    fn foot(to_the_left_deg: f64, down_deg: f64) -> Mat3 {
        let turn = Rotation3::from_axis_angle(&Vec3::y_axis(), to_the_left_deg.to_radians());
        let pitch = Rotation3::from_axis_angle(&Vec3::z_axis(), -down_deg.to_radians());
        (pitch * turn).into_inner()
    }

    #[test]
    fn toes_towards_the_other_foot_are_internal_on_both_sides() {
        // World axes: x forward, y up, z to the right.
        let ahead = level_axes(Vec3::x(), Vec3::y());
        let of = |deg: f64, down_deg: f64, side: Side| inwards(&ahead, &foot(deg, down_deg), side).to_degrees();
        assert!((of(12.0, 0.0, Side::Right) - 12.0).abs() < 1e-9, "a right foot turned to the left is turned inwards");
        assert!((of(12.0, 0.0, Side::Left) + 12.0).abs() < 1e-9);
        assert!((of(-7.0, 0.0, Side::Left) - 7.0).abs() < 1e-9);
        let toes = foot(12.0, 0.0) * Vec3::x();
        assert!(toes.z < 0.0 && toes.x > 0.9, "to the left is away from z: {toes}");
        // A foot that points down is turned as before; its projection on the floor would be far more.
        assert!((of(12.0, 70.0, Side::Right) - 12.0).abs() < 1e-9);
        let projected = foot(12.0, 70.0) * Vec3::x();
        assert!((-projected.z).atan2(projected.x).to_degrees() > 30.0);
        let back = level_axes(-Vec3::x(), Vec3::y());
        let turned = Rotation3::from_axis_angle(&Vec3::y_axis(), std::f64::consts::PI).into_inner() * foot(5.0, 0.0);
        assert!((inwards(&back, &turned, Side::Right).to_degrees() - 5.0).abs() < 1e-9, "against world x");
    }
}
