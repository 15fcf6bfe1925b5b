//! Angles of pelvis and hips as clinics define them: of axes through the iliac spines.
//!
//! With A the axes of the body (forward, up, right) in the neutral posture, R_p(t) and R_t(t) the rotations of pelvis
//! and thigh, R_t(0) the rotation of the thigh in the neutral posture, and C the clinical axes in the pelvis
//! ([`PelvicFrame`]):
//!
//!   pelvis in the world      Aᵀ R_p(t) C
//!   thigh in the pelvis      (R_p(t) C)ᵀ R_t(t) R_t(0)ᵀ A
//!
//! Each is taken apart into R_z(a) R_x(b) R_y(c): tilt or flexion about the axis to the right, then obliquity or
//! adduction about the axis forward, then rotation, in the order of Plug-in-Gait and of Gait2392.
//!
//! Source: Kadaba 1990, as Plug-in-Gait has it (unverified).
//! Not handled: pelves that lean sideways by 90 degrees.
//! Pinned by: tests/clinical_angles.rs

use super::calibration::angles_zxy;
use super::{Trajectory, each_body_motion};
use crate::model::anatomy::PelvicFrame;
use crate::model::{BySide, Model, Side};
use std::f64::consts::TAU;

/// Angles of pelvis and hips, one entry per frame.
#[derive(Debug, Clone, PartialEq)]
pub struct ClinicalAngles {
    /// Anterior tilt of the pelvis [rad].
    pub pelvic_tilt: Vec<f64>,
    /// Right side of the pelvis up [rad].
    pub pelvic_obliquity: Vec<f64>,
    /// Right side of the pelvis forward [rad].
    pub pelvic_rotation: Vec<f64>,
    /// Flexion, adduction and internal rotation of the hips [rad], where there is a leg.
    pub hips: BySide<Option<[Vec<f64>; 3]>>,
}

/// Angles of a motion in the clinical axes of the pelvis; `None` for a model without legs.
#[must_use]
pub fn clinical_angles(model: &Model, trajectory: &Trajectory, frame: &PelvicFrame) -> Option<ClinicalAngles> {
    let anatomy = model.anatomy();
    let neutral = anatomy.neutral()?;
    let thighs = anatomy.legs().map(|leg| leg.map(|leg| leg.thigh));
    let thigh_axes =
        thighs.map(|thigh| thigh.map(|thigh| neutral.poses[thigh.index()].rotation.transpose() * neutral.axes));
    let mut angles = ClinicalAngles {
        pelvic_tilt: Vec::new(),
        pelvic_obliquity: Vec::new(),
        pelvic_rotation: Vec::new(),
        hips: thighs.map(|thigh| thigh.map(|_| Default::default())),
    };
    each_body_motion(model, trajectory, |_, bodies| {
        let pelvis = bodies[frame.pelvis.index()].pose.rotation * frame.axes;
        let [tilt, obliquity, rotation] = angles_zxy(&(neutral.axes.transpose() * pelvis));
        angles.pelvic_tilt.push(-tilt);
        angles.pelvic_obliquity.push(-obliquity);
        angles.pelvic_rotation.push(rotation);
        for side in Side::BOTH {
            let (Some(thigh), Some(axes), Some(hip)) = (thighs[side], thigh_axes[side], &mut angles.hips[side]) else {
                continue;
            };
            let thigh = bodies[thigh.index()].pose.rotation * axes;
            let [flexion, adduction, rotation] = angles_zxy(&(pelvis.transpose() * thigh));
            let inwards = if side == Side::Right { 1.0 } else { -1.0 };
            hip[0].push(flexion);
            hip[1].push(inwards * adduction);
            hip[2].push(inwards * rotation);
        }
    });
    unwrap_turns(&mut angles.pelvic_rotation);
    Some(angles)
}

/// Makes an angle continuous where it passes a half turn.
fn unwrap_turns(angles: &mut [f64]) {
    for i in 1..angles.len() {
        angles[i] -= TAU * ((angles[i] - angles[i - 1]) / TAU).round();
    }
}
