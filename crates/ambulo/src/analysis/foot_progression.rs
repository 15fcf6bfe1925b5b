//! Foot progression: the angle of a foot to the walking direction, seen from above.
//!
//!   φ(t) = s atan2((d × f(t)) · u, d · f(t))
//!
//! | symbol | unit | meaning |
//! |---|---|---|
//! | φ | rad | foot progression; internal (toes towards the other foot) is positive |
//! | d | - | direction of the pelvis over the floor or belt, from the foot strike to the next one of the same foot |
//! | f | m | from the rear of the sole to the ball of the foot, which no movement of the toes changes, without its vertical part |
//! | u | - | upwards |
//! | s | - | +1 for the right foot, -1 for the left one |
//!
//! Source: the sign is that of Schwartz, Rozumalski, Trost 2008 (docs/SESSION.md).
//! Not handled: cycles in which the pelvis stays within 0.2 m; they have no walking direction.
//! Pinned by: its own tests, tests of `ambulo session` against the angles of Plug-in-Gait in a recording

use super::cycles::over_cycle_of;
use super::recording::Analysis;
use super::times_and_distances::{Floor, LEAST_STRIDE_M, PelvisPath};
use crate::kinematics::each_body_motion;
use crate::model::anatomy::Sole;
use crate::model::{BySide, Model, Side};
use crate::spatial::Vec3;

/// Foot progression over each cycle of an analysis [rad], internal positive: 101 values per cycle, in the order of
/// [`Analysis::cycles`]. `None` for a foot without a sole, and for a cycle without a walking direction.
#[must_use]
pub fn foot_progression(model: &Model, soles: &BySide<Option<Sole>>, analysis: &Analysis) -> Vec<Option<Vec<f64>>> {
    let floor = Floor::of(model, analysis);
    let path = PelvisPath::of(model, analysis, floor);
    let mut feet: BySide<Vec<Vec3>> = BySide::default();
    each_body_motion(model, &analysis.trajectory, |_, bodies| {
        for (side, sole) in soles.iter() {
            let place = |k: usize| {
                sole.as_ref().map(|sole| &sole.points[k]).map(|p| bodies[p.body.index()].pose.place(p.place))
            };
            feet[side].extend(place(1).zip(place(0)).map(|(ball, rear)| floor.level(ball - rear)));
        }
    });
    let grid = analysis.trajectory.grid();
    let of_cycle = |cycle: &super::Cycle| {
        let moved = path.as_ref()?.between([cycle.start_s, cycle.end_s])?;
        let ahead = moved.try_normalize(LEAST_STRIDE_M)?;
        let foot = &feet[cycle.side];
        let angle = |frame: usize| inwards(ahead, foot[frame], model.up(), cycle.side);
        (!foot.is_empty()).then(|| over_cycle_of(grid, angle, cycle))
    };
    analysis.cycles.iter().map(of_cycle).collect()
}

/// The angle from the walking direction to the foot, positive towards the other foot [rad].
fn inwards(ahead: Vec3, foot: Vec3, up: Vec3, side: Side) -> f64 {
    let to_the_left = ahead.cross(&foot).dot(&up).atan2(ahead.dot(&foot));
    if side == Side::Right { to_the_left } else { -to_the_left }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn toes_towards_the_other_foot_are_internal_on_both_sides() {
        // World axes: x forward, y up, z to the right.
        let turned = |to_the_left_deg: f64| {
            let angle = to_the_left_deg.to_radians();
            Vec3::new(0.2 * angle.cos(), 0.0, -0.2 * angle.sin())
        };
        let of = |deg: f64, side: Side| inwards(Vec3::x(), turned(deg), Vec3::y(), side).to_degrees();
        assert!((of(12.0, Side::Right) - 12.0).abs() < 1e-12, "a right foot turned to the left is turned inwards");
        assert!((of(12.0, Side::Left) + 12.0).abs() < 1e-12);
        assert!((of(-7.0, Side::Left) - 7.0).abs() < 1e-12);
        let back = inwards(-Vec3::x(), -turned(5.0), Vec3::y(), Side::Right).to_degrees();
        assert!((back - 5.0).abs() < 1e-12, "against world x: {back}");
    }
}
