//! How far the varus of a knee follows its flexion, and the turn of its axis that makes this least.
//!
//! A knee axis that is turned about the long axis of the thigh shows flexion as varus (cross-talk). With the direction
//! u from ankle to knee in the frame of the thigh, x forward, y up and z to the right,
//!
//!   flexion = atan2(-u_x, u_y),   varus = asin(u_z),
//!
//! and a turn by ψ about y makes u_z into sin ψ u_x + cos ψ u_z. Its variance is least at
//!
//!   2 ψ = atan2(-cov(u_x, u_z), (var u_x - var u_z) / 2),
//!
//! the direction of the principal component of u_x and u_z.
//!
//! The poses are those of the segments' own markers ([`super::segments`]), because the knee of the built-in body has
//! no varus.
//!
//! Sources: Baker, Finney, Orr 1999, Hum Mov Sci 18:655 (least variance of varus; unverified); Jensen et al. 2016, J
//! Biomech 49:1698 (r² of flexion and varus as the measure, principal components; abstract opened).
//! Pinned by: tests/functional.rs

use super::MOST_FRAMES;
use super::segments::LegSegments;
use crate::model::{Model, Side};
use crate::motion::MarkerRecording;
use crate::numerics::elementary::{asin, atan2};
use crate::numerics::{correlation, mean, sampled, sort_numbers};
use crate::spatial::Vec3;

/// Smallest range of flexion that shows an axis [rad]; walking has 60 degrees.
const LEAST_FLEXION: f64 = 40.0 * std::f64::consts::PI / 180.0;
const FEWEST_FRAMES: usize = 20;
/// Share of the frames at either end of a range that is left out.
const ENDS: f64 = 0.025;

/// Cross-talk of a knee in a motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CrossTalk {
    /// Correlation of varus with flexion.
    pub r: f64,
    /// Range of varus, from 2.5 to 97.5 % of the frames [rad].
    pub varus_range_rad: f64,
    /// The same of flexion.
    pub flexion_range_rad: f64,
    /// Turn of the knee axis about the long axis of the thigh that makes the variance of varus least [rad].
    pub turn_rad: f64,
}

/// The cross-talk of a knee of a calibrated body in a motion; `None` if the knee hardly bends or has too few markers.
#[must_use]
pub fn knee_cross_talk(model: &Model, motion: &MarkerRecording, side: Side) -> Option<CrossTalk> {
    let leg = LegSegments::of(model, motion, side).ok()?;
    let shank = |frame| {
        let [_, thigh, shank] = leg.poses(frame)?;
        let along = thigh.place(leg.knee) - shank.place(leg.ankle);
        Some(thigh.rotation.tr_mul(&along).normalize())
    };
    of_directions(&sampled(motion.frames(), MOST_FRAMES).filter_map(shank).collect::<Vec<Vec3>>())
}

/// From the directions of the shank, from ankle to knee, in the frame of the thigh.
fn of_directions(directions: &[Vec3]) -> Option<CrossTalk> {
    let flexion: Vec<f64> = directions.iter().map(|u| atan2(-u.x, u.y)).collect();
    let varus: Vec<f64> = directions.iter().map(|u| asin(u.z.clamp(-1.0, 1.0))).collect();
    let flexion_range_rad = inner_range(&flexion);
    if directions.len() < FEWEST_FRAMES || flexion_range_rad < LEAST_FLEXION {
        return None;
    }
    let [x, z]: [Vec<f64>; 2] = [0, 2].map(|axis| directions.iter().map(|u| u[axis]).collect());
    let (middle_x, middle_z) = (mean(&x), mean(&z));
    let moment = |f: &dyn Fn(f64, f64) -> f64| {
        let each = x.iter().zip(&z).map(|(x, z)| f(x - middle_x, z - middle_z));
        mean(&each.collect::<Vec<f64>>())
    };
    let turn_rad = 0.5 * atan2(-moment(&|x, z| x * z), 0.5 * moment(&|x, z| x * x - z * z));
    let r = correlation(&flexion, &varus);
    Some(CrossTalk { r, varus_range_rad: inner_range(&varus), flexion_range_rad, turn_rad })
}

/// Range of the values without those at the ends.
fn inner_range(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sort_numbers(&mut sorted);
    let Some(last) = sorted.len().checked_sub(1) else { return 0.0 };
    let cut = (ENDS * last as f64) as usize;
    sorted[last - cut] - sorted[cut]
}
