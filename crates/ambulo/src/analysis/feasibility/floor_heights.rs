//! Height of the ground under each foot, where no load shows it.
//!
//! On level ground it is the median height of the centres of pressure. On stairs each stance has its own height, which
//! the motion shows. The motion is used only where it agrees with the loads: the soles of a body that hovers above
//! the centres of pressure stand on nothing. Pinned by: tests/feasibility_motions.rs

use super::frame::NEAR_GROUND_M;
use super::motion_and_forces::MotionAndForces;
use crate::ground::BodyForces;
use crate::ground::footfalls::{Footfall, Footfalls};
use crate::model::{BySide, Side};
use crate::motion::TimeGrid;
use crate::numerics::median;
use crate::spatial::Vec3;

/// Heights of the ground over time [m].
pub(super) struct FloorHeights {
    /// Usual height of the loads [m].
    usual: f64,
    /// Stances with their heights, in order of time.
    stances: BySide<Vec<([f64; 2], f64)>>,
}

impl FloorHeights {
    pub(super) fn of(motion: &MotionAndForces<'_>, feet: &BySide<Option<&BodyForces>>) -> FloorHeights {
        let (up, grid) = (motion.model.up(), motion.trajectory.grid());
        let centers = feet.values().flatten().flat_map(|foot| &foot.center_of_pressure);
        let usual = median(centers.map(|p| p.dot(&up))).unwrap_or(0.0);
        let agreeing = motion.stances.filter(|stances| agree(stances, feet, grid, up));
        let with_height = |fall: &Footfall| (fall.contact().span(grid.start_s, grid.end_s()), fall.floor_height_m);
        let stances =
            BySide::from_fn(|side| agreeing.map_or_else(Vec::new, |found| found.of(side).map(with_height).collect()));
        FloorHeights { usual, stances }
    }

    /// Under each foot: of its stance at this time [s], otherwise of the loads.
    pub(super) fn at(&self, time_s: f64) -> BySide<f64> {
        BySide::from_fn(|side| {
            let next = self.stances[side].partition_point(|([_, off], _)| *off < time_s);
            let stance = self.stances[side].get(next).filter(|([strike, _], _)| *strike <= time_s);
            stance.map_or(self.usual, |(_, height)| *height)
        })
    }
}

/// Whether the floor under stances and the centres of pressure have one height.
fn agree(stances: &Footfalls, feet: &BySide<Option<&BodyForces>>, grid: TimeGrid, up: Vec3) -> bool {
    let above = Side::BOTH.into_iter().flat_map(|side| {
        let foot = feet[side];
        stances.of(side).flat_map(move |fall| {
            let [from, to] = fall.contact().span(grid.start_s, grid.end_s());
            let frame = |t: f64| ((t - grid.start_s) / grid.step_s).round().max(0.0) as usize;
            let frames = frame(from)..(frame(to) + 1).min(grid.frames);
            frames.filter_map(move |i| Some(fall.floor_height_m - foot?.center_of_pressure[i].dot(&up)))
        })
    });
    median(above).is_none_or(|above| above.abs() < NEAR_GROUND_M)
}
