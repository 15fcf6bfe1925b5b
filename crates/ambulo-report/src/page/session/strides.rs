//! Times and distances of walking, from strikes and toe-offs.

use super::feet::{self, Strike};
use super::results::Results;
use super::sides;
use ambulo::model::Side;
use ambulo::spatial::Vec3;

/// Between two strikes of a foot that are so many strides apart, one was missed.
const MISSED: f64 = 1.5;

/// What one stride of a foot shows: strike, toe-off, next strike. Shares are in per cent of the cycle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Stride {
    pub(super) side: Side,
    pub(super) cycle_s: f64,
    pub(super) stance: f64,
    /// Only where the other foot's events were seen.
    pub(super) single_support: Option<f64>,
    /// From the strike to the other foot's toe-off, likewise.
    pub(super) initial_double_support: Option<f64>,
    /// From the other foot's strike to the toe-off.
    pub(super) terminal_double_support: Option<f64>,
    /// From the other foot's strike to this foot's at the end of the stride.
    pub(super) step_time_s: Option<f64>,
    pub(super) stride_length_m: Option<f64>,
    /// From the other foot's strike before to this foot's at the end of the stride.
    pub(super) step_length_m: Option<f64>,
    pub(super) step_width_m: Option<f64>,
}

/// All strides of both feet in which the foot left the ground once.
pub(super) fn strides(results: &Results) -> Vec<Stride> {
    let strikes = feet::strikes(results);
    let mut list = Vec::new();
    for side in Side::BOTH {
        let times = |of: Side, strike: bool| {
            let events = results.events.iter().filter(move |e| e.side == sides::page(of) && e.strike == strike);
            events.map(|event| event.time_s).collect::<Vec<f64>>()
        };
        let (own, offs) = (times(side, true), times(side, false));
        let other = other(side);
        let (other_strikes, other_offs) = (times(other, true), times(other, false));
        for pair in own.windows(2) {
            let span = [pair[0], pair[1]];
            let Some(off) = only(&offs, span) else { continue };
            let cycle_s = span[1] - span[0];
            let alone =
                only(&other_offs, span).zip(only(&other_strikes, span)).filter(|(from, to)| from < to && *to <= off);
            let placed = Placed::of(&strikes, side, span);
            let other_strike = only(&other_strikes, span);
            let share = |from: f64, to: f64| 100.0 * (to - from) / cycle_s;
            list.push(Stride {
                side,
                cycle_s,
                initial_double_support: alone.map(|(other_off, _)| share(span[0], other_off)),
                terminal_double_support: alone.map(|(_, other_strike)| share(other_strike, off)),
                step_time_s: other_strike.map(|other_strike| span[1] - other_strike),
                stance: share(span[0], off),
                single_support: alone.map(|(from, to)| share(from, to)),
                stride_length_m: placed.map(|placed| placed.stride_m),
                step_length_m: placed.and_then(|placed| placed.step_m),
                step_width_m: placed.and_then(|placed| placed.width_m),
            });
        }
    }
    list
}

/// The other foot.
pub(super) fn other(side: Side) -> Side {
    match side {
        Side::Right => Side::Left,
        Side::Left => Side::Right,
    }
}

/// The only instant inside a span, if there is just one.
fn only(times: &[f64], [from, to]: [f64; 2]) -> Option<f64> {
    let mut inside = times.iter().copied().filter(|t| *t > from && *t < to);
    let first = inside.next()?;
    inside.next().is_none().then_some(first)
}

/// Distances of one stride.
#[derive(Debug, Clone, Copy)]
struct Placed {
    stride_m: f64,
    step_m: Option<f64>,
    width_m: Option<f64>,
}

impl Placed {
    /// Stride: along the line of the heel from strike to strike. Step: in the direction in which both feet go around it, so that a turn
    /// makes no step wide or narrow.
    fn of(strikes: &[Strike], side: Side, [from, to]: [f64; 2]) -> Option<Placed> {
        let at = |time: f64| strikes.iter().find(|s| s.side == side && s.time_s.total_cmp(&time).is_eq());
        let (first, last) = (at(from)?, at(to)?);
        let line = level(last.heel - first.heel);
        let between: Vec<&Strike> =
            strikes.iter().filter(|s| s.side != side && s.time_s > from && s.time_s < to).collect();
        let step = match between[..] {
            [other] => Some((last.heel - other.heel, heading(strikes, line, other, to - from))),
            _ => None,
        };
        let outwards = if side == Side::Right { 1.0 } else { -1.0 };
        let step =
            step.map(|(step, ahead)| [step.dot(&ahead), outwards * step.dot(&Vec3::new(-ahead.z, 0.0, ahead.x))]);
        Some(Placed { stride_m: line.norm(), step_m: step.map(|step| step[0]), width_m: step.map(|step| step[1]) })
    }
}

/// Where walking goes in the step from the `other` foot's strike to this foot's, which ends its stride `line`. The line of a stride has
/// the direction in its middle: this foot's that of half a step before, the other foot's next stride that of half a step after. The
/// other foot's last stride, one and a half steps before, serves where there is no next one.
fn heading(strikes: &[Strike], line: Vec3, other: &Strike, stride_s: f64) -> Vec3 {
    let of_other = |from_s: f64, to_s: f64| {
        let mut inside = strikes.iter().filter(|s| s.side == other.side && s.time_s > from_s && s.time_s < to_s);
        inside.find(|s| (s.time_s - other.time_s).abs() > 0.5 * stride_s)
    };
    let longest = MISSED * stride_s;
    let own = line.try_normalize(1e-6).unwrap_or_else(Vec3::x);
    let next = of_other(other.time_s, other.time_s + longest).map(|next| level(next.heel - other.heel));
    let last = of_other(other.time_s - longest, other.time_s).map(|last| level(other.heel - last.heel));
    let direction = match (next.and_then(|way| way.try_normalize(1e-6)), last.and_then(|way| way.try_normalize(1e-6))) {
        (Some(next), _) => own + next,
        (None, Some(last)) => own * 1.5 - last * 0.5,
        (None, None) => own,
    };
    direction.try_normalize(1e-6).unwrap_or(own)
}

/// Along the floor.
fn level(v: Vec3) -> Vec3 {
    Vec3::new(v.x, 0.0, v.z)
}
