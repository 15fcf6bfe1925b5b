//! When a foot is low.

use super::Footfall;
use super::signals::FootPath;
use crate::ground::phases::SHORTEST_CONTACT_S;
use crate::motion::TimeGrid;
use crate::numerics::median;
use crate::spatial::Vec3;

/// A foot whose lowest point is this near the floor stands [m].
const NEAR_FLOOR_M: f64 = 0.03;

/// The stances of one foot: its lowest point is near the floor.
pub(super) fn stances(path: &FootPath, grid: TimeGrid) -> Vec<Footfall> {
    let heights: Vec<f64> = (0..grid.frames).map(|i| path.lowest(i)).collect();
    let mut sorted = heights.clone();
    sorted.sort_by(f64::total_cmp);
    let Some(&floor) = sorted.get(sorted.len() / 20) else { return Vec::new() };
    let limit = floor + NEAR_FLOOR_M;
    let crossing = |i: usize| {
        let share = (limit - heights[i - 1]) / (heights[i] - heights[i - 1]);
        grid.time(i - 1) + share * grid.step_s
    };
    let mut out = Vec::new();
    let mut start = None;
    for i in 0..=grid.frames {
        let low = i < grid.frames && heights[i] < limit;
        match (low, start) {
            (true, None) => start = Some(i),
            (false, Some(from)) => {
                start = None;
                if (i - from) as f64 * grid.step_s >= SHORTEST_CONTACT_S {
                    out.push(Footfall {
                        side: path.side,
                        strike_s: (from > 0).then(|| crossing(from)),
                        off_s: (i < grid.frames).then(|| crossing(i)),
                        floor_height_m: floor,
                        floor_velocity: velocity(path, from..i),
                    });
                }
            }
            _ => {}
        }
    }
    out
}

/// Median velocity of the ball of the foot, level.
fn velocity(path: &FootPath, frames: std::ops::Range<usize>) -> Vec3 {
    let along = |k: usize| median(frames.clone().map(|i| path.velocities[i][1][k])).unwrap_or(0.0);
    let velocity = Vec3::new(along(0), along(1), along(2));
    velocity - path.up * velocity.dot(&path.up)
}

/// What most stances say; nothing below 0.1 m/s.
pub(super) fn common_velocity(falls: &[Footfall]) -> Vec3 {
    let along = |k: usize| median(falls.iter().map(|f| f.floor_velocity[k])).unwrap_or(0.0);
    let velocity = Vec3::new(along(0), along(1), along(2));
    if velocity.norm() < 0.1 { Vec3::zeros() } else { velocity }
}
