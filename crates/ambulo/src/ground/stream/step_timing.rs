//! Predicts the foot offs and foot strikes after the newest frame.
//!
//! Steps are regular: from stride to stride the times of stance, stride and double support vary by 1 to 4 %, 10 to
//! 30 ms (Owings, Grabiner 2004, unverified). Foot off is therefore expected at the usual time after the other foot's
//! strike, or, before that strike, after a usual stance; foot strike is expected one stride after the previous one. An
//! event that is overdue by a time x is expected after another x: for a person who stops walking, continued stance is
//! soon expected.
//!
//! | code        | meaning                                       |
//! | `stance_s`  | from strike to off of a foot                  |
//! | `stride_s`  | from strike to strike of a foot               |
//! | `overlap_s` | from the other foot's strike to off of a foot |
//!
//! Each is the median over the latest window with such events.

use crate::ground::footfalls::{Footfall, Footfalls};
use crate::model::Side;
use crate::motion::TimeGrid;
use crate::numerics::{Order, median};

/// Earliest strike of the other foot in walking, as a share of a stance.
const TAKES_OVER_AFTER: f64 = 0.5;

/// Usual times of a person's steps [s]; `None` until they were observed.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct StepTiming {
    stance_s: Option<f64>,
    stride_s: Option<f64>,
    overlap_s: Option<f64>,
}

impl StepTiming {
    /// Updates the times from the footfalls of a window.
    pub fn update(&mut self, footfalls: &Footfalls) {
        let falls = &footfalls.falls;
        let stances = falls.iter().filter_map(|fall| Some(fall.off_s? - fall.strike_s?));
        let strikes = |side: Side| footfalls.of(side).filter_map(|fall| fall.strike_s).collect::<Vec<f64>>();
        let strides = |side: Side| strikes(side).windows(2).map(|pair| pair[1] - pair[0]).collect::<Vec<f64>>();
        let overlaps = falls.iter().filter_map(|fall| Some(fall.off_s? - other_strike(fall, fall.off_s?, falls)?));
        self.stance_s = median(stances).or(self.stance_s);
        self.stride_s = median(Side::BOTH.into_iter().flat_map(strides)).or(self.stride_s);
        self.overlap_s = median(overlaps).or(self.overlap_s);
    }

    /// Adds the predicted events after the window: the offs of feet in stance, and the next stance of each foot.
    pub fn extrapolate(&self, footfalls: &mut Footfalls, grid: TimeGrid) {
        let Some(stance_s) = self.stance_s else { return };
        let seen = footfalls.falls.clone();
        for fall in footfalls.falls.iter_mut().filter(|fall| fall.off_s.is_none()) {
            let Some(strike) = fall.strike_s else { continue };
            let other = other_strike(fall, grid.end_s(), &seen).filter(|s| s - strike > TAKES_OVER_AFTER * stance_s);
            let by_other = other.zip(self.overlap_s).map(|(landed, overlap)| landed + overlap);
            fall.off_s = Some(expected_time(by_other.unwrap_or(strike + stance_s), grid));
        }
        let Some(stride_s) = self.stride_s.filter(|stride| *stride > stance_s) else { return };
        for side in Side::BOTH {
            let Some(last) = footfalls.of(side).last().copied() else { continue };
            let (Some(strike), Some(off)) = (last.strike_s, last.off_s) else { continue };
            let strike = expected_time(strike + stride_s, grid).max(off + 0.5 * (stride_s - stance_s));
            footfalls.falls.push(Footfall { strike_s: Some(strike), off_s: Some(strike + stance_s), ..last });
        }
        let start = |fall: &Footfall| fall.strike_s.unwrap_or(f64::NEG_INFINITY);
        footfalls.falls.sort_by_numbers(|fall| [start(fall), fall.side.rank()]);
    }
}

/// The other foot's last strike during a stance.
fn other_strike(fall: &Footfall, end_s: f64, falls: &[Footfall]) -> Option<f64> {
    let strike = fall.strike_s?;
    let mut others = falls.iter().filter(|other| other.side != fall.side).filter_map(|other| other.strike_s);
    others.rfind(|landed| *landed > strike && *landed < end_s)
}

/// An overdue event is expected after as much time as it is overdue.
fn expected_time(expected_s: f64, grid: TimeGrid) -> f64 {
    let overdue = grid.end_s() - expected_s;
    if overdue < 0.0 { expected_s } else { grid.end_s() + overdue.max(grid.step_s) }
}
