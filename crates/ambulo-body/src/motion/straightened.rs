//! Straightens walks on a curved path.
//!
//! Methods that detect events in markers use world x as forward. On a curve each frame is transformed here into axes
//! that follow the pelvis and its facing direction; the pelvis moves along x by the distance that it has covered:
//!
//!   x' = s(t) + (p - c) · f        z' = (p - c) · r        s(t) = ∫ ċ · f dt
//!
//! | code | symbol | meaning |
//! |---|---|---|
//! | `center` | c | middle of the pelvis markers, horizontal |
//! | `forward` | f | facing direction of the pelvis, horizontal, averaged over [`STEADY_S`] |
//! | | r | f × up, to the right |
//!
//! A stance foot moves in these axes because of the rotation of the body, at ω times its distance from the pelvis: 0.3
//! m/s on a circle of 1.5 m radius.
//! Pinned by: tests/retarget.rs

use super::landmarks::Landmarks;
use super::marker_recording::{MarkerPath, MarkerRecording};
use crate::spatial::Vec3;

/// Averaging time that removes the rotation of the pelvis in each stride [s].
const STEADY_S: f64 = 1.0;

/// Transforms a recording in world axes to a straight walk along x; `None` without a right and a left marker of the
/// pelvis. Frames without visible pelvis markers have gaps.
#[must_use]
pub fn straightened(markers: &MarkerRecording) -> Option<MarkerRecording> {
    let landmarks = Landmarks::find(markers);
    let path = |marker: Option<usize>| Some(markers.markers.get(marker?)?.positions.as_slice());
    let (right, left) = (path(landmarks.asis_r)?, path(landmarks.asis_l)?);
    let center: Vec<Vec3> = right.iter().zip(left).map(|(r, l)| level((r + l) / 2.0)).collect();
    let facing: Vec<Vec3> = right.iter().zip(left).map(|(r, l)| Vec3::y().cross(&level(r - l))).collect();
    let half = (0.5 * STEADY_S * markers.rate_hz).round() as usize;
    let forward: Vec<Vec3> = (0..facing.len()).map(|frame| mean_facing(&facing, frame, half)).collect();
    let mut way = Vec::with_capacity(center.len());
    let mut so_far = 0.0;
    for frame in 0..center.len() {
        let step = if frame == 0 { 0.0 } else { (center[frame] - center[frame - 1]).dot(&forward[frame]) };
        so_far += if step.is_finite() { step } else { 0.0 };
        way.push(so_far);
    }
    let seen = |path: &MarkerPath| {
        let place = |(frame, p): (usize, &Vec3)| {
            let (out, f) = (p - center[frame], forward[frame]);
            Vec3::new(way[frame] + out.dot(&f), p.y, out.dot(&f.cross(&Vec3::y())))
        };
        MarkerPath { name: path.name.clone(), positions: path.positions.iter().enumerate().map(place).collect() }
    };
    Some(MarkerRecording { markers: markers.markers.iter().map(seen).collect(), ..markers.clone() })
}

fn level(v: Vec3) -> Vec3 {
    Vec3::new(v.x, 0.0, v.z)
}

/// Unit vector; not a number if the pelvis is not visible in any frame of the averaging time.
fn mean_facing(facing: &[Vec3], frame: usize, half: usize) -> Vec3 {
    let around = &facing[frame.saturating_sub(half)..(frame + half + 1).min(facing.len())];
    let sum: Vec3 = around.iter().filter(|f| f.iter().all(|x| x.is_finite())).sum();
    sum.try_normalize(0.0).unwrap_or(Vec3::repeat(f64::NAN))
}
