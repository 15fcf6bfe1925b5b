//! Contact spheres and toes of the feet.

use super::dimensions::Dimensions;
use crate::model::{BodyId, Model, Side};
use crate::spatial::{Inertia, InertiaError, Mat3, Vec3};

/// Mass of the toes, share of the foot mass: `toes_r` over `calcn_r` and `toes_r` of Gait2392, 0.2166 of 1.4666 kg.
const TOES_MASS: f64 = 0.148;

/// The part of the foot that a contact sphere belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SpherePart {
    /// The heel.
    Heel,
    /// The ball of the foot.
    Ball,
    /// The toes.
    Toes,
    /// No part of a foot: a sphere at another body, which touches a seat or a wall.
    Other,
}

impl SpherePart {
    /// The parts of a foot from rear to front, with the beginnings of the names of their spheres.
    pub const OF_FOOT: [(SpherePart, &'static str); 3] =
        [(SpherePart::Heel, "heel"), (SpherePart::Ball, "ball"), (SpherePart::Toes, "toe")];
}

/// A sphere under a foot: heel, ball of the foot or toes.
///
/// In upright standing all of them touch the ground. They lie on the mid-line of the foot; the heel sphere begins at
/// the heel, the toe sphere ends at the tip of the toes. Radii of published foot models, scaled with stature,
/// from 1.80 m (OpenSim Moco `2D_gait.osim`: heel 35 mm, front 15 mm; Falisse 2022: 32 mm; SCONE: 30 mm).
#[derive(Debug, Clone, PartialEq)]
pub struct ContactSphere {
    /// `heel_r`, `ball_r`, `toe_r`, `heel_l`, `ball_l` or `toe_l`; for files and messages.
    pub name: String,
    /// Part of the foot that it belongs to.
    pub part: SpherePart,
    /// The foot.
    pub side: Side,
    /// The body that it is fixed to.
    pub body: BodyId,
    /// Centre in the frame of the body [m].
    pub center: Vec3,
    /// Radius [m].
    pub radius: f64,
}

/// The ball of the foot, the axis of the toes, relative to the ankle [m].
pub(super) fn ball(d: &Dimensions) -> Vec3 {
    Vec3::new(d.ankle_to_ball, d.ball_radius - d.ankle_height, 0.0)
}

pub(super) fn soles(model: &Model, d: &Dimensions, toe_joint: bool) -> Vec<ContactSphere> {
    let heel = Vec3::new(d.heel_radius - d.heel_to_ankle, d.heel_radius - d.ankle_height, 0.0);
    let tip = Vec3::new(d.ankle_to_ball + d.ball_to_toe - d.toe_radius, d.toe_radius - d.ankle_height, 0.0);
    let mut spheres = Vec::new();
    for side in Side::BOTH {
        let letter = side.letter();
        let calcn = model.body(&format!("calcn_{letter}"));
        let (toes, tip) = match model.body(&format!("toes_{letter}")) {
            Some(toes) if toe_joint => (Some(toes), tip - ball(d)),
            _ => (calcn, tip),
        };
        let places = [(calcn, heel, d.heel_radius), (calcn, ball(d), d.ball_radius), (toes, tip, d.toe_radius)];
        let parts = SpherePart::OF_FOOT.into_iter().zip(places);
        spheres.extend(parts.filter_map(|((part, name), (body, center, radius))| {
            Some(ContactSphere { name: format!("{name}_{letter}"), part, side, body: body?, center, radius })
        }));
    }
    spheres
}

/// Splits a foot (about the ankle) into rear foot (about the ankle) and toes (about the ball), which together are
/// equivalent to the foot while the toes are flat: a locked toe joint changes nothing.
///
/// The toes are a horizontal cylinder from the ball to the tip, as thick as their contact sphere. With D the distance
/// between the two mass centres and m m'/M their reduced mass, I_rear = I_foot - I_toes - (m m'/M) (|D|² 1 - D Dᵀ).
pub(super) fn split(foot: &Inertia, d: &Dimensions) -> Result<(Inertia, Inertia), InertiaError> {
    let toes = TOES_MASS * foot.mass();
    let rear = foot.mass() - toes;
    let toes_center = ball(d) + Vec3::new(0.5 * d.ball_to_toe, d.toe_radius - d.ball_radius, 0.0);
    let rear_center = (foot.center() * foot.mass() - toes_center * toes) / rear;
    let across = toes * (d.ball_to_toe.powi(2) / 12.0 + d.toe_radius.powi(2) / 4.0);
    let toes_inertia = Mat3::from_diagonal(&Vec3::new(0.5 * toes * d.toe_radius.powi(2), across, across));
    let apart = toes_center - rear_center;
    let reduced = toes * rear / foot.mass();
    let spread = (Mat3::identity() * apart.norm_squared() - apart * apart.transpose()) * reduced;
    let rear_inertia = foot.about_center() - toes_inertia - spread;
    Ok((Inertia::new(rear, rear_center, rear_inertia)?, Inertia::new(toes, toes_center - ball(d), toes_inertia)?))
}
