//! Height of the floor under each stance.
//!
//! The lowest point of a foot in stance lies on the floor, as accurately as the sole is known: its median height over
//! the stance is used. Stances of similar height share one floor, at the mean of the medians of right and left foot;
//! stairs have several floors.

use super::Footfall;
use super::signals::{FootPath, Signals};
use crate::model::Side;
use crate::numerics::{mean, median, sort_numbers};
use std::ops::Range;

/// Heights within this range are one floor [m]: estimated soles have errors of 1 to 3 cm, stairs are 15 to 20 cm high.
const ONE_FLOOR_M: f64 = 0.04;

/// Height of the floor under one stance, from this stance alone [m].
pub(super) fn height(signals: &Signals, foot: &FootPath, run: &Range<usize>) -> f64 {
    median(run.clone().map(|frame| signals.lowest(foot, frame).1)).unwrap_or(0.0)
}

/// Gives stances of similar height the same floor.
pub(super) fn share_floors(falls: &mut [Footfall]) {
    let mut heights: Vec<f64> = falls.iter().map(|fall| fall.floor_height_m).collect();
    sort_numbers(&mut heights);
    let mut rest = heights.as_slice();
    let mut floors = Vec::new();
    while let Some(&lowest) = rest.first() {
        let (floor, above) = rest.split_at(rest.partition_point(|h| *h <= lowest + ONE_FLOOR_M));
        floors.extend(floor.last().map(|&highest| [lowest, highest]));
        rest = above;
    }
    for [lowest, highest] in floors {
        let is_on_it = |fall: &&mut Footfall| (lowest..=highest).contains(&fall.floor_height_m);
        let on_it: Vec<&mut Footfall> = falls.iter_mut().filter(is_on_it).collect();
        let of_side = |side: Side| median(on_it.iter().filter(|f| f.side == side).map(|f| f.floor_height_m));
        let of_sides: Vec<f64> = Side::BOTH.into_iter().filter_map(of_side).collect();
        let height = mean(&of_sides);
        for fall in on_it {
            fall.floor_height_m = height;
        }
    }
}
