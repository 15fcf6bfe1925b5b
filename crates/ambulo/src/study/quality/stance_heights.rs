//! Feet that sink into the floor, or float above it, in some stances of a level walk.
//!
//! Without force plates the floor is where the feet stand, so a floor of a wrong height cannot be found. That some
//! stances have another height than the others can be: a level floor has one height, and a person whose foot stands
//! lower or higher has a lower or higher pelvis.
//!
//! | symbol | meaning                                                                                       |
//! |--------|-----------------------------------------------------------------------------------------------|
//! | h      | height of the lowest point of the sole, median over the middle half of a stance [m]           |
//! | p      | height of the pelvis over the same time, median [m]                                           |
//!
//! Reported is h less its median over the stances of the same foot, where p differs from its median by at most
//! [`LEVEL_M`]. Errors of the sole are the same in each stance of a foot and cancel.
//!
//! **Not judged**: other activities than walking and turning; stances on stairs, a ramp or an uneven floor, where the
//! pelvis rises and sinks with the feet; stances that the recording cuts; a foot with fewer than [`FEWEST`] whole
//! stances.
//!
//! Sources: PHUMA (arXiv 2510.26236, abstract read) names penetration and floating among the faults for which motions
//! are left out. `compute_penetration` of UHC (github.com/ZhengyiLuo/UHC, uhc/smpllib/smpl_eval.py, read) measures the
//! depth below a floor at height zero and has no limit; a recording need not have its floor there. The limit is chosen
//! here. Pinned by: tests/stance_heights.rs

use crate::analysis::activity::ActivityKind;
use crate::ground::footfalls::{Footfall, Footfalls};
use crate::kinematics::{Trajectory, each_body_motion};
use crate::model::anatomy::Sole;
use crate::model::{BySide, Model, Side};
use crate::numerics::median;

/// Stances at which the height of the pelvis differs more from its median are not level [m]. It differs by up to a
/// centimetre between the strides of a level walk.
const LEVEL_M: f64 = 0.015;
/// Of two stances nothing shows which one is wrong.
const FEWEST: usize = 3;

/// Heights of the soles in the stances that can be judged.
#[derive(Debug, Clone, Default)]
pub(in crate::study) struct StanceHeights {
    stances: Vec<StanceHeight>,
}

/// A stance relative to the others of the foot.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StanceHeight {
    pub side: Side,
    /// Middle of the stance [s].
    pub at_s: f64,
    /// Height of the sole above its median [m].
    pub above_m: f64,
}

/// Heights over the middle of a stance.
pub struct Middle {
    /// Time of the middle [s].
    pub at_s: f64,
    /// Of the sole [m].
    pub sole_m: f64,
    /// Of the pelvis [m].
    pub pelvis_m: f64,
}

impl StanceHeights {
    /// Of a walk; empty if nothing can be judged.
    pub(in crate::study) fn of(
        model: &Model,
        trajectory: &Trajectory,
        soles: &BySide<Option<Sole>>,
        stances: &Footfalls,
        activity: ActivityKind,
    ) -> StanceHeights {
        let is_walk = matches!(activity, ActivityKind::Walk | ActivityKind::Turn);
        let whole = |side: Side| stances.of(side).filter_map(middle_half).collect();
        let times: BySide<Vec<[f64; 2]>> = BySide::from_fn(whole);
        if !is_walk || times.values().all(|times| times.len() < FEWEST) {
            return StanceHeights::default();
        }
        let Some(heights) = Heights::of(model, trajectory, soles) else { return StanceHeights::default() };
        let of_side = |side: Side| {
            let middles: Vec<Middle> = times[side].iter().filter_map(|span| heights.middle(side, *span)).collect();
            compared(side, &middles)
        };
        StanceHeights { stances: Side::BOTH.into_iter().flat_map(of_side).collect() }
    }

    /// The stance whose sole is farthest from the others of its foot.
    pub(super) fn farthest(&self) -> Option<StanceHeight> {
        self.stances.iter().copied().max_by(|a, b| a.above_m.abs().total_cmp(&b.above_m.abs()))
    }
}

/// The middle half of a whole stance [s].
fn middle_half(fall: &Footfall) -> Option<[f64; 2]> {
    let (strike_s, off_s) = (fall.strike_s?, fall.off_s?);
    let quarter_s = 0.25 * (off_s - strike_s);
    Some([strike_s + quarter_s, off_s - quarter_s])
}

/// The stances of a foot on a level floor, relative to all of its stances.
pub fn compared(side: Side, middles: &[Middle]) -> Vec<StanceHeight> {
    let usual = |of: fn(&Middle) -> f64| median(middles.iter().map(of)).filter(|_| middles.len() >= FEWEST);
    let (Some(sole_m), Some(pelvis_m)) = (usual(|middle| middle.sole_m), usual(|middle| middle.pelvis_m)) else {
        return Vec::new();
    };
    let level = middles.iter().filter(|middle| (middle.pelvis_m - pelvis_m).abs() <= LEVEL_M);
    level.map(|middle| StanceHeight { side, at_s: middle.at_s, above_m: middle.sole_m - sole_m }).collect()
}

/// Heights at each frame [m].
struct Heights<'a> {
    trajectory: &'a Trajectory,
    soles: BySide<Vec<f64>>,
    pelvis: Vec<f64>,
}

impl<'a> Heights<'a> {
    /// `None` of a body without a pelvis.
    fn of(model: &Model, trajectory: &'a Trajectory, soles: &BySide<Option<Sole>>) -> Option<Heights<'a>> {
        let (up, root) = (model.up(), model.anatomy().pelvis()?);
        let mut heights = Heights { trajectory, soles: BySide::from_fn(|_| Vec::new()), pelvis: Vec::new() };
        each_body_motion(model, trajectory, |_, bodies| {
            heights.pelvis.push(bodies[root.index()].pose.translation.dot(&up));
            for (side, sole) in soles.iter() {
                let points = sole.iter().flat_map(|sole| &sole.points);
                let height = points.map(|point| bodies[point.body.index()].pose.place(point.place).dot(&up));
                heights.soles[side].push(height.fold(f64::INFINITY, f64::min));
            }
        });
        Some(heights)
    }

    fn middle(&self, side: Side, [from_s, to_s]: [f64; 2]) -> Option<Middle> {
        let grid = self.trajectory.grid();
        let frame = |time_s: f64| ((time_s - grid.start_s) / grid.step_s).round().max(0.0) as usize;
        let frames = frame(from_s)..(frame(to_s) + 1).min(grid.frames);
        let of = |heights: &[f64]| median(heights.get(frames.clone())?.iter().copied()).filter(|m| m.is_finite());
        Some(Middle { at_s: 0.5 * (from_s + to_s), sole_m: of(&self.soles[side])?, pelvis_m: of(&self.pelvis)? })
    }
}
