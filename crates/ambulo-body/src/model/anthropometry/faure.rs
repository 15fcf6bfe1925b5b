//! Uniform cylinders of the 1997 paper.
//!
//! Faure, Debunne, Cani, Multon 1997, "Dynamic analysis of human walking", table 1 and section 4.1: "uniform density
//! and a cylindrical shape". The paper has no density and no stature; both are assumed below.

use super::dimensions::{ANKLE_HEIGHT, FOOT_LENGTH, HEEL_TO_ANKLE};
use super::proportions::{Lengths, Proportions, RigidPart};
use std::f64::consts::PI;

/// Mass [% of body mass], length [% of stature].
type Entry = (f64, f64);

const HEAD: Entry = (7.84, 10.0);
const TRUNK: Entry = (53.13, 28.7);
const UPPER_ARM: Entry = (2.96, 18.8);
const LOWER_ARM: Entry = (2.20, 14.5);
const UPPER_LEG: Entry = (7.92, 24.5);
const LOWER_LEG: Entry = (4.70, 24.6);
const FOOT: Entry = (1.72, 8.9);

/// Sum of the printed masses [%]: 99.97.
const PRINTED_SUM: f64 = HEAD.0 + TRUNK.0 + 2.0 * (UPPER_ARM.0 + LOWER_ARM.0 + UPPER_LEG.0 + LOWER_LEG.0 + FOOT.0);
/// Body mass in the paper [kg] (section 4.2).
const REFERENCE_MASS: f64 = 80.0;
/// Assumed stature [m]: the paper has none.
const REFERENCE_STATURE: f64 = 1.80;
/// Assumed density [kg/m³]: soft tissue is denser than water, the trunk with its lungs less dense; 1000 makes the
/// cylinders 2.5 % thicker and a thigh's inertia about the hip 0.1 % larger.
const DENSITY: f64 = 1050.0;

/// Drillis and Contini 1966, as in Winter, figure 4.1 (unverified): share of stature.
const HAND_LENGTH: f64 = 0.108;

/// Radius of a cylinder of the reference body, share of stature: m = rho pi r² l.
fn radius((mass, length): Entry) -> f64 {
    let mass = mass / PRINTED_SUM * REFERENCE_MASS;
    let length = length / 100.0 * REFERENCE_STATURE;
    (mass / (DENSITY * PI * length)).sqrt() / REFERENCE_STATURE
}

/// Radii of gyration of a cylinder, shares of stature: r/√2 about its axis, √(l²/12 + r²/4) across it.
fn gyration(entry: Entry) -> [f64; 2] {
    let (radius, length) = (radius(entry), entry.1 / 100.0);
    [radius / 2f64.sqrt(), (length * length / 12.0 + radius * radius / 4.0).sqrt()]
}

/// An upright cylinder that ends at `top`.
fn below(top: f64, entry: Entry) -> RigidPart {
    let [along, across] = gyration(entry);
    RigidPart { mass: entry.0 / PRINTED_SUM, center: [0.0, top - entry.1 / 200.0], radii: [across, along, across] }
}

/// A horizontal cylinder in the middle of the foot, at half the height of the ankle.
fn foot() -> RigidPart {
    let [along, across] = gyration(FOOT);
    RigidPart {
        mass: FOOT.0 / PRINTED_SUM,
        center: [(0.5 - HEEL_TO_ANKLE) * FOOT_LENGTH, -0.5 * ANKLE_HEIGHT],
        radii: [along, across, across],
    }
}

pub(super) fn proportions() -> Proportions {
    let lengths = Lengths {
        thigh: UPPER_LEG.1 / 100.0,
        shank: LOWER_LEG.1 / 100.0,
        ankle_height: ANKLE_HEIGHT,
        foot: FOOT_LENGTH,
        lumbar: None,
        shoulder: TRUNK.1 / 100.0,
        head: HEAD.1 / 100.0,
        head_and_neck: 1.0 - (UPPER_LEG.1 + LOWER_LEG.1 + TRUNK.1) / 100.0 - ANKLE_HEIGHT,
        upper_arm: UPPER_ARM.1 / 100.0,
        forearm: LOWER_ARM.1 / 100.0,
        hand: HAND_LENGTH,
    };
    Proportions {
        lengths,
        thigh: below(0.0, UPPER_LEG),
        shank: below(0.0, LOWER_LEG),
        foot: foot(),
        upper_arm: below(0.0, UPPER_ARM),
        forearm: below(0.0, LOWER_ARM),
        hand: RigidPart { mass: 0.0, center: [0.0, 0.0], radii: [0.0; 3] },
        pelvis: Vec::new(),
        torso: vec![below(lengths.shoulder, TRUNK), below(1.0 - lengths.leg(), HEAD)],
    }
}
