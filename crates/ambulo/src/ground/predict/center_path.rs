//! The expected path of the centre of pressure under a foot, from the motion alone.
//!
//!   p = rear + (front - rear) s(θ)       s(θ) = σ((θ - θ₀) / θ₁), scaled to 0 at θ = -20° and to 1 at 22°
//!
//! θ is the forward lean of the shank, σ the logistic function; the front lies between ball and tip. That the centre of pressure
//! follows the shank, in much the same way at every speed, is the roll-over shape of Hansen, Childress, Knox 2004 (unverified).
//! Compared with force plates, leave-one-out, the shank's lean predicted the path better than time, the pitch of the foot or the mass
//! centre (docs/GROUND_FORCES.md). Without a shank the path is linear in time.
//!
//! A foot that comes down forefoot first (on stairs downwards, from a jump, with a stiff calf) touches the ground with what is lowest: as long as
//! its heel has not come down, the centre of pressure is under the ball, whatever the lean of the shank:
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
pub(super) fn center_path(
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

fn share(lean: f64, [middle, width]: [f64; 2]) -> f64 {
    let sigma = |lean: f64| 1.0 / (1.0 + exp((middle - lean) / width));
    let [from, to] = LEANS.map(sigma);
    ((sigma(lean) - from) / (to - from)).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::super::forefoot::heel_down;
    use super::*;

    /// A foot whose sole slopes down to the ball by an angle, under an upright shank.
    fn foot(slope: f64) -> FootPlace {
        let (sine, cosine) = slope.sin_cos();
        let point = |along: f64| Vec3::new(along * cosine, (0.18 - along) * sine, 0.0);
        FootPlace { sole: [point(0.0), point(0.18), point(0.25)], shank: Some(Vec3::y()) }
    }

    /// Place of the centre of pressure between rear (0) and ball (1) at 0.05 s of a stance in which the foot first has these slopes.
    fn place_between(slopes: &[f64]) -> f64 {
        let places: Vec<FootPlace> = slopes.iter().copied().map(foot).collect();
        let up = Vec3::y();
        let body_scale = BodyScale { up, weight_n: 700.0, leg_time_s: 0.3, leg_speed_m_s: 3.0, height_m: 1.75 };
        let heel_down_s = heel_down(&places, up).map(|frame| 0.01 * frame as f64);
        let stance = Stance::level(Side::Right, [0.0, 0.6], heel_down_s);
        let center = center_path(&places[5], &stance, 0.05, &body_scale, &FittedParameters::default());
        let [rear, ball, _] = places[5].sole;
        (center.x - rear.x) / (ball.x - rear.x)
    }

    #[test]
    fn a_foot_that_comes_down_forefoot_first_has_its_centre_of_pressure_under_the_ball_until_the_heel_is_down() {
        let steep = 25_f64.to_radians();
        let flat = place_between(&[0.0; 10]);
        assert!(flat < 0.5, "an upright shank over a flat foot: {flat}");
        // Still on the forefoot: between ball and tip.
        assert!(place_between(&[steep; 10]) > 0.99);
        // The heel came down before: the lean of the shank decides, also when the heel rises again.
        let mut slopes = [steep; 10];
        slopes[2] = 0.0;
        slopes[5] = 0.0;
        assert!((place_between(&slopes) - flat).abs() < 1e-12);
        // Heel first: a slope that comes later, as in push-off, changes nothing.
        let mut slopes = [-0.2; 10];
        slopes[5] = steep;
        let late = place_between(&slopes);
        assert!((late - flat).abs() < 0.06, "{late} {flat}");
    }

    #[test]
    fn the_path_leads_from_heel_to_ball_as_the_shank_leans_forward() {
        let lean = [0.1, 0.087];
        let shares: Vec<f64> = (-30..=30).map(|degrees| share(f64::from(degrees).to_radians(), lean)).collect();
        assert!(shares[0].abs() < 1e-12 && (shares[60] - 1.0).abs() < 1e-12);
        assert!(shares.windows(2).all(|pair| pair[0] <= pair[1]));
        assert!((share(0.1, lean) - 0.5).abs() < 0.05);
    }
}
