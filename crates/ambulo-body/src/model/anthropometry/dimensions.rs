//! Lengths of a figure.

use super::proportions::Lengths;

/// Distance between the hip centres, share of stature: Dumas, Cheze, Verriest 2007 as in the public model HeiMan (read
/// there).
const HIP_WIDTH: f64 = 0.093;
/// Distance between the shoulder centres, the same source.
const SHOULDER_WIDTH: f64 = 0.2401;

/// Heel to ankle, share of the foot length: the ankle of Gait2392 (1.80 m) is 49 mm in front of the origin of its
/// calcaneus, with about 20 mm of soft tissue behind it, of 274 mm.
pub(crate) const HEEL_TO_ANKLE: f64 = 0.25;
/// Heel to the ball of the foot (first metatarsophalangeal joint), share of the foot length: men 201 of 271 mm, women
/// 182 of 246 mm in the US Army survey of 2012 (unverified).
pub(crate) const HEEL_TO_BALL: f64 = 0.74;
// Shares of stature: Drillis and Contini 1966 as in Winter, figure 4.1 (unverified).
pub(crate) const FOOT_LENGTH: f64 = 0.152;
pub(crate) const FOOT_WIDTH: f64 = 0.055;
pub(crate) const ANKLE_HEIGHT: f64 = 0.039;
/// 35 mm at 1.80 m: the heel sphere of OpenSim Moco's `2D_gait.osim`; others have 30 to 50 mm.
pub(super) const HEEL_RADIUS: f64 = 0.035 / 1.80;
/// 25 mm at 1.80 m: between that model's front sphere (15 mm) and the spheres of Falisse 2022 (32 mm).
pub(super) const BALL_RADIUS: f64 = 0.025 / 1.80;
/// 15 mm at 1.80 m: the front sphere of `2D_gait.osim`.
pub(super) const TOE_RADIUS: f64 = 0.015 / 1.80;

/// Lengths of a figure [m].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dimensions {
    /// Stature.
    pub height: f64,
    /// Hip centre above the ground, standing.
    pub leg_length: f64,
    /// Hip to knee.
    pub thigh: f64,
    /// Knee to ankle.
    pub shank: f64,
    /// Ankle above the ground.
    pub ankle_height: f64,
    /// Heel to tip of the toes.
    pub foot_length: f64,
    /// Width of the foot; no effect on planar motion.
    pub foot_width: f64,
    /// Rear of the heel to the ankle, along the foot.
    pub heel_to_ankle: f64,
    /// Ankle to the ball of the foot, along the foot.
    pub ankle_to_ball: f64,
    /// Ball of the foot to the tip of the toes.
    pub ball_to_toe: f64,
    /// Radius of the contact sphere of the heel.
    pub heel_radius: f64,
    /// Radius of the contact sphere of the ball; the toe joint is at its centre.
    pub ball_radius: f64,
    /// Radius of the contact sphere of the toes.
    pub toe_radius: f64,
    /// Distance between the hip centres.
    pub hip_width: f64,
    /// Distance between the shoulder centres.
    pub shoulder_width: f64,
    /// Lumbar joint above mid-hip; `None` for an undivided trunk.
    pub lumbar_height: Option<f64>,
    /// Shoulder centres above mid-hip.
    pub shoulder_height: f64,
    /// Chin, or the angle of the jaw, to vertex.
    pub head: f64,
    /// Shoulder to elbow.
    pub upper_arm: f64,
    /// Elbow to wrist.
    pub forearm: f64,
    /// Wrist to the tip of the middle finger.
    pub hand: f64,
}

impl Dimensions {
    pub(super) fn new(lengths: &Lengths, height: f64) -> Dimensions {
        let foot = lengths.foot * height;
        Dimensions {
            height,
            leg_length: lengths.leg() * height,
            thigh: lengths.thigh * height,
            shank: lengths.shank * height,
            ankle_height: lengths.ankle_height * height,
            foot_length: foot,
            foot_width: FOOT_WIDTH * height,
            heel_to_ankle: HEEL_TO_ANKLE * foot,
            ankle_to_ball: (HEEL_TO_BALL - HEEL_TO_ANKLE) * foot,
            ball_to_toe: (1.0 - HEEL_TO_BALL) * foot,
            heel_radius: HEEL_RADIUS * height,
            ball_radius: BALL_RADIUS * height,
            toe_radius: TOE_RADIUS * height,
            hip_width: HIP_WIDTH * height,
            shoulder_width: SHOULDER_WIDTH * height,
            lumbar_height: lengths.lumbar.map(|share| share * height),
            shoulder_height: lengths.shoulder * height,
            head: lengths.head * height,
            upper_arm: lengths.upper_arm * height,
            forearm: lengths.forearm * height,
            hand: lengths.hand * height,
        }
    }

    /// Vertex above mid-hip.
    pub(super) fn vertex(&self) -> f64 {
        self.height - self.leg_length
    }
}
