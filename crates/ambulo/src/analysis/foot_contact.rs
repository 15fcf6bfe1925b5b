//! Which ends of the soles touch the ground, frame by frame: labels for animation and for sets of motions.

use super::recording::Analysis;
use crate::ground::feet;
use crate::kinematics::each_body_motion;
use crate::model::anatomy::{Sole, SolePoint};
use crate::model::{BySide, Model};

/// Height of one end of a sole above the other from which it does not touch the ground [m]: a tilt of about five
/// degrees, which is more than the error of a fitted foot (ours).
const CLEAR_M: f64 = 0.02;

/// The ends of a sole that touch the ground in a frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct FootContact {
    /// The heel.
    pub heel: bool,
    /// The ball of the foot or the toes.
    pub toes: bool,
}

/// The contact of each foot with the ground in each frame. A foot touches the ground while it is loaded, as the centres
/// of pressure state; of its sole the lower end touches, and the other end if it is at most 20 mm higher. On a slope of
/// more than 5 % the end that the slope raises is therefore missed.
///
/// A side without a sole has no frames.
#[must_use]
pub fn foot_contact(model: &Model, analysis: &Analysis, soles: &BySide<Option<Sole>>) -> BySide<Vec<FootContact>> {
    let feet = feet(model, &analysis.ground);
    let mut found: BySide<Vec<FootContact>> = BySide::from_fn(|_| Vec::new());
    each_body_motion(model, &analysis.trajectory, |frame, bodies| {
        let height = |point: &SolePoint| bodies[point.body.index()].pose.place(point.place).dot(&model.up());
        for (side, foot) in &feet {
            let Some(Sole { points: [heel, ball, tip], .. }) = &soles[*side] else { continue };
            let is_loaded = foot.center_of_pressure[frame].x.is_finite();
            let above = height(heel) - height(ball).min(height(tip));
            found[*side]
                .push(FootContact { heel: is_loaded && above <= CLEAR_M, toes: is_loaded && above >= -CLEAR_M });
        }
    });
    found
}
