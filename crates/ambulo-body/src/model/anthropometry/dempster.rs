//! Dempster's cadavers as in Winter's book.
//!
//! Winter, "Biomechanics and Motor Control of Human Movement", table 4.1: masses, mass centres from the proximal end,
//! radii of gyration about the mass centre, as transcribed in BMClab/BMC (`data/BSP_DempsterWinter.txt`), read.
//! Lengths: Drillis and Contini 1966 as in Winter, figure 4.1 (unverified).

use crate::numerics::elementary::hypot;

use super::dimensions::{ANKLE_HEIGHT, BALL_RADIUS, FOOT_LENGTH, HEEL_TO_ANKLE, HEEL_TO_BALL};
use super::proportions::{Lengths, Proportions, RigidPart, Row};

/// Shares of stature. Shoulder and mid-hip are at 0.818 and 0.530.
const LENGTHS: Lengths = Lengths {
    thigh: 0.245,
    shank: 0.246,
    ankle_height: ANKLE_HEIGHT,
    foot: FOOT_LENGTH,
    lumbar: None,
    shoulder: 0.288,
    head: 0.130,
    head_and_neck: 1.0 - C7,
    upper_arm: 0.186,
    forearm: 0.146,
    hand: 0.108,
};

// Longitudinal / transverse radius of gyration: the table has one radius only; ratios of de Leva 1996, men.
const THIGH_SLIMNESS: f64 = 14.9 / 32.9;
const SHANK_SLIMNESS: f64 = 10.2 / 24.6;
const FOOT_SLIMNESS: f64 = 12.4 / 24.5;
const UPPER_ARM_SLIMNESS: f64 = 15.8 / 26.9;
const FOREARM_SLIMNESS: f64 = 12.1 / 26.5;
const HAND_SLIMNESS: f64 = 40.1 / 51.3;
const HEAD_SLIMNESS: f64 = 31.2 / 37.6;
/// Trunk, mid-shoulder to mid-hip: about x, y, z; the table has none; de Leva 1996, men.
const TRUNK_RADII: [f64; 3] = [0.384, 0.197, 0.358];
/// Wrist to knuckle as a share of wrist to fingertip: de Leva 1996, men, 86.2 of 187.9 mm.
const KNUCKLE: f64 = 86.2 / 187.9;
/// Ear canal, the mass centre of head and neck, and the joint of C7 and T1, from which their length is measured: shares
/// of stature (unverified; the tragion of adults is 7.4 % of stature below the vertex).
const EAR_CANAL: f64 = 0.926;
const C7: f64 = 0.850;

fn row(mass: f64, length: f64, center: f64, radius: f64, slimness: f64) -> Row {
    Row { mass, length, center, radii: [radius, radius * slimness, radius] }
}

pub(super) fn proportions() -> Proportions {
    let trunk = Row { mass: 0.497, length: LENGTHS.shoulder, center: 0.500, radii: TRUNK_RADII };
    let head = 0.495 * (EAR_CANAL - C7);
    Proportions {
        lengths: LENGTHS,
        thigh: row(0.100, LENGTHS.thigh, 0.433, 0.323, THIGH_SLIMNESS).below(0.0),
        shank: row(0.0465, LENGTHS.shank, 0.433, 0.302, SHANK_SLIMNESS).below(0.0),
        foot: foot(),
        upper_arm: row(0.028, LENGTHS.upper_arm, 0.436, 0.322, UPPER_ARM_SLIMNESS).below(0.0),
        forearm: row(0.016, LENGTHS.forearm, 0.430, 0.303, FOREARM_SLIMNESS).below(0.0),
        hand: row(0.006, LENGTHS.hand * KNUCKLE, 0.506, 0.297, HAND_SLIMNESS).below(0.0),
        pelvis: Vec::new(),
        torso: vec![
            trunk.below(LENGTHS.shoulder),
            RigidPart {
                mass: 0.081,
                center: [0.0, EAR_CANAL - LENGTHS.leg()],
                radii: [head, head * HEAD_SLIMNESS, head],
            },
        ],
    }
}

/// Lateral malleolus to head of the second metatarsal, which slopes down.
fn foot() -> RigidPart {
    let along = (HEEL_TO_BALL - HEEL_TO_ANKLE) * LENGTHS.foot;
    let down = LENGTHS.ankle_height - BALL_RADIUS;
    let radius = 0.475 * hypot(along, down);
    RigidPart { mass: 0.0145, center: [0.5 * along, -0.5 * down], radii: [radius * FOOT_SLIMNESS, radius, radius] }
}
