//! The smooth transition assumption: in double support, the load of the trailing foot fades along fixed curves of time.
//!
//! In single support the foot on the ground carries the whole force. From the strike of the leading foot on, with F₀
//! the force of the trailing foot at that instant,
//!
//!   fore-aft            F(t) = F₀ (k₁ exp(-((t - t_p) / T)²) - k₂ t / T)
//!   vertical, lateral   F(t) = F₀ exp(-(t / T)³)
//!
//! and the leading foot carries the rest of the total force.
//!
//! | code       | symbol | unit | meaning                                                             |
//! |------------|--------|------|---------------------------------------------------------------------|
//! | `time`     | t / T  | -    | time since the strike over half of the double support, from 0 to 2  |
//! |            | t_p    | s    | 2 T / 3                                                             |
//! | `k1`, `k2` | k₁, k₂ | -    | exp(4/9), k₁ exp(-16/9) / 2: the curve begins at 1 and ends at 0    |
//!
//! The centre of pressure is under the heel until the other foot has left the ground, then goes to the ball while time
//! passes from 0 to 1 of the single support: s = (-2 / 3π) (sin 2πu - sin(4πu) / 8 - 3πu / 2), and stays there. Two
//! feet that stand from the beginning of the recording carry half of the force each.
//!
//! Source: Ren, Jones, Howard 2008, J Biomech 41:2750 (unverified), as programmed in OpenSimRT
//! (github.com/mitkof6/OpenSimRT, `GRFMPrediction.cpp`, opened), which multiplies the present total force by the curves
//! instead of F₀.

use super::{AppliedForce, BaselineInput, FootPoints, at_height};
use crate::ground::footfalls::Footfall;
use crate::model::{BySide, Side};
use crate::numerics::elementary::{exp, sin};
use crate::spatial::Vec3;
use std::f64::consts::PI;

/// The fore-aft force of the trailing foot over that at the strike; `time` in halves of the double support, 0 to 2.
#[must_use]
pub fn fore_aft(time: f64) -> f64 {
    let k1 = exp(4.0_f64 / 9.0);
    let k2 = k1 * exp(-16.0_f64 / 9.0) / 2.0;
    k1 * exp(-(time - 2.0 / 3.0).powi(2)) - k2 * time
}

/// The vertical and lateral force of the trailing foot over that at the strike.
#[must_use]
pub fn other(time: f64) -> f64 {
    exp(-time.powi(3))
}

/// Share of the way from heel to ball at a share of the single support.
#[must_use]
pub fn roll(share: f64) -> f64 {
    let u = share.clamp(0.0, 1.0);
    -2.0 / (3.0 * PI) * (sin(2.0 * PI * u) - sin(4.0 * PI * u) / 8.0 - 1.5 * PI * u)
}

pub(super) fn forces(input: &BaselineInput<'_>, places: &BySide<Vec<FootPoints>>) -> BySide<AppliedForce> {
    let grid = input.trajectory.grid();
    let up = input.model.up();
    let mut feet = BySide::from_fn(|side| AppliedForce {
        force: vec![Vec3::zeros(); grid.frames],
        point: places[side].iter().map(|foot| foot.sole[1]).collect(),
    });
    for frame in 0..grid.frames {
        let time = grid.time(frame);
        let down = BySide::from_fn(|side| input.footfalls.of(side).find(|fall| is_down(fall, time)));
        let divided = divided(input, &down, frame);
        for side in Side::BOTH {
            let Some(fall) = down[side] else { continue };
            let [rear, ball, _] = places[side][frame].sole;
            let point = rear + (ball - rear) * roll(single_support(input, fall, time));
            feet[side].point[frame] = at_height(point, up, fall.floor_height_m);
            feet[side].force[frame] = divided[side];
        }
    }
    feet
}

fn is_down(fall: &Footfall, time: f64) -> bool {
    fall.strike_s.is_none_or(|strike| strike <= time) && fall.off_s.is_none_or(|off| time < off)
}

/// The force on each foot in a frame.
fn divided(input: &BaselineInput<'_>, down: &BySide<Option<&Footfall>>, frame: usize) -> BySide<Vec3> {
    let total = input.total[frame].force;
    let (right, left) = match (down.right, down.left) {
        (None, None) => (Vec3::zeros(), Vec3::zeros()),
        (Some(_), None) => (total, Vec3::zeros()),
        (None, Some(_)) => (Vec3::zeros(), total),
        (Some(right), Some(left)) => {
            let strike = |fall: &Footfall| fall.strike_s.unwrap_or(f64::NEG_INFINITY);
            match strike(right).total_cmp(&strike(left)) {
                std::cmp::Ordering::Equal => (total / 2.0, total / 2.0),
                std::cmp::Ordering::Greater => {
                    let trailing = trailing(input, right, left, frame);
                    (total - trailing, trailing)
                }
                std::cmp::Ordering::Less => {
                    let trailing = trailing(input, left, right, frame);
                    (trailing, total - trailing)
                }
            }
        }
    };
    BySide { right, left }
}

/// The force on the trailing foot in double support.
fn trailing(input: &BaselineInput<'_>, leading: &Footfall, trailing: &Footfall, frame: usize) -> Vec3 {
    let grid = input.trajectory.grid();
    let strike = leading.strike_s.unwrap_or(grid.start_s);
    // A double support that the recording cuts ends with it.
    let off = trailing.off_s.unwrap_or(grid.end_s()).max(strike + grid.step_s);
    let time = 2.0 * (grid.time(frame) - strike) / (off - strike);
    let at_strike = ((strike - grid.start_s) / grid.step_s).round().clamp(0.0, (grid.frames - 1) as f64) as usize;
    let before = input.total[at_strike].force;
    let forward = (input.forward)([trailing.strike_s.unwrap_or(grid.start_s), off]);
    let along = forward * before.dot(&forward);
    along * fore_aft(time) + (before - along) * other(time)
}

/// Elapsed share of the single support of a stance: from the last off of the other foot before the middle of the
/// stance, or its strike, to the next strike of the other foot, or its off.
fn single_support(input: &BaselineInput<'_>, fall: &Footfall, time: f64) -> f64 {
    let grid = input.trajectory.grid();
    let (strike, off) = (fall.strike_s.unwrap_or(grid.start_s), fall.off_s.unwrap_or(grid.end_s()));
    let middle = 0.5 * (strike + off);
    let others = || input.footfalls.of(fall.side.other());
    let from = others().filter_map(|other| other.off_s).filter(|t| (strike..middle).contains(t)).fold(strike, f64::max);
    let to = others().filter_map(|other| other.strike_s).filter(|t| (middle..off).contains(t)).fold(off, f64::min);
    (time - from) / (to - from).max(grid.step_s)
}
