//! Times and distances of walking, from strikes and toe-offs.

use super::feet::{self, Strike};
use super::results::Results;
use super::sides;
use crate::model::Side;
use crate::spatial::Vec3;

/// What one stride of a foot shows: strike, toe-off, next strike. Shares are in per cent of the cycle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Stride {
    pub(super) side: Side,
    pub(super) cycle_s: f64,
    pub(super) stance: f64,
    /// Only where the other foot's events were seen.
    pub(super) single_support: Option<f64>,
    pub(super) stride_length_m: Option<f64>,
    /// From the other foot's strike before to this foot's at the end of the stride.
    pub(super) step_length_m: Option<f64>,
    pub(super) step_width_m: Option<f64>,
}

/// All strides of both feet in which the foot left the ground once.
pub(super) fn strides(results: &Results) -> Vec<Stride> {
    let strikes = feet::strikes(results);
    let direction = direction(&strikes);
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
            let placed = Placed::of(&strikes, side, span, direction);
            list.push(Stride {
                side,
                cycle_s,
                stance: 100.0 * (off - span[0]) / cycle_s,
                single_support: alone.map(|(from, to)| 100.0 * (to - from) / cycle_s),
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

/// Where walking goes along the floor: the mean of all strides; x where there is none.
fn direction(strikes: &[Strike]) -> Vec3 {
    let level = |v: Vec3| Vec3::new(v.x, 0.0, v.z);
    let mut sum = Vec3::zeros();
    for side in Side::BOTH {
        let own: Vec<&Strike> = strikes.iter().filter(|strike| strike.side == side).collect();
        sum += own.windows(2).map(|pair| level(pair[1].heel - pair[0].heel)).sum::<Vec3>();
    }
    sum.try_normalize(1e-6).unwrap_or_else(Vec3::x)
}

/// Distances of one stride.
#[derive(Debug, Clone, Copy)]
struct Placed {
    stride_m: f64,
    step_m: Option<f64>,
    width_m: Option<f64>,
}

impl Placed {
    fn of(strikes: &[Strike], side: Side, [from, to]: [f64; 2], direction: Vec3) -> Option<Placed> {
        let at = |time: f64| strikes.iter().find(|s| s.side == side && s.time_s.total_cmp(&time).is_eq());
        let (first, last) = (at(from)?, at(to)?);
        let between: Vec<&Strike> =
            strikes.iter().filter(|s| s.side != side && s.time_s > from && s.time_s < to).collect();
        let step = match between[..] {
            [other] => Some(last.heel - other.heel),
            _ => None,
        };
        let to_right = Vec3::new(-direction.z, 0.0, direction.x);
        let outwards = if side == Side::Right { 1.0 } else { -1.0 };
        Some(Placed {
            stride_m: (last.heel - first.heel).dot(&direction),
            step_m: step.map(|step| step.dot(&direction)),
            width_m: step.map(|step| outwards * step.dot(&to_right)),
        })
    }
}
