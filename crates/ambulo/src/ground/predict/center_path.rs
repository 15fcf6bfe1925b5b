//! The expected path of the centre of pressure under a foot, from the motion alone.
//!
//!   p = rear + (front - rear) s(θ)       s(θ) = σ((θ - θ₀) / θ₁), scaled to 0 at θ = -20° and to 1 at 22°
//!
//! θ is the forward lean of the shank, σ the logistic function; the front lies between ball and tip. That the centre of
//! pressure follows the shank, in much the same way at every speed, is the roll-over shape of Hansen, Childress, Knox
//! 2004 (unverified). Compared with force plates, leave-one-out, the shank's lean predicted the path better than time,
//! the pitch of the foot or the mass centre (docs/GROUND_FORCES.md). Without a shank the path is linear in time.
//!
//! A foot that comes down forefoot first (on stairs downwards, from a jump, with a stiff calf) touches the ground with
//! what is lowest: as long as its heel has not come down, the centre of pressure is under the ball, whatever the lean
//! of the shank:
//!
//!   s ≥ (φ - φ₀) / (φ₁ - φ₀)      φ: slope of the sole from rear to ball, downwards positive
//!
//! | code   | symbol | unit | meaning                            |
//! | `lean` | θ      | rad  | of ankle to knee, forward positive |

use super::fitted_parameters::FittedParameters;
use super::forefoot::share_of_ball;
use super::geometry::FootPlace;
use super::stances::{BodyScale, Stance};
use crate::model::Side;
use crate::numerics::elementary::{atan2, exp};
use crate::spatial::Vec3;

/// Lean at the beginning and at the end of the path [rad].
const LEANS: [f64; 2] = [-0.349, 0.384];

/// Expected centre of pressure, on the ground.
pub fn center_path(
    place: &FootPlace,
    stance: &Stance,
    time: f64,
    body_scale: &BodyScale,
    parameters: &FittedParameters,
) -> Vec3 {
    let up = body_scale.up;
    let level = |v: Vec3| v - up * v.dot(&up);
    let [rear, ball, tip] = place.sole;
    let along = level(tip - rear).try_normalize(f64::MIN_POSITIVE).unwrap_or(stance.forward);
    let outwards = along.cross(&up) * if stance.side == Side::Right { 1.0 } else { -1.0 };
    let [behind, front] = parameters.center_ends;
    let back = rear - along * (behind * body_scale.height_m);
    let front = ball + (tip - ball) * front;
    let share = match place.shank {
        Some(shank) => share(atan2(shank.dot(&along), shank.dot(&up)), parameters.center_lean),
        None => stance.elapsed_share(time),
    };
    let share = if stance.is_on_forefoot(time) { share.max(share_of_ball(place, up)) } else { share };
    let path = back + (front - back) * share + outwards * (parameters.center_outwards * body_scale.height_m);
    level(path) + up * stance.height_m
}

/// Share of the way from heel to ball at a lean of the shank [rad]; `middle` and `width` describe the step between
/// both.
pub fn share(lean: f64, [middle, width]: [f64; 2]) -> f64 {
    let sigma = |lean: f64| 1.0 / (1.0 + exp((middle - lean) / width));
    let [from, to] = LEANS.map(sigma);
    ((sigma(lean) - from) / (to - from)).clamp(0.0, 1.0)
}
