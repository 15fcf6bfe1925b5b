//! Stances for the estimate: complete, with axes, speed, type of gait and phase.

use super::forefoot::heel_down;
use super::geometry::Geometry;
use super::stance_curves::{AtSpeed, StanceCurves};
use super::stance_traits::{Traits, traits};
use super::strike_descent::{CenterVelocity, Strike, descents};
use crate::ground::footfalls::{Footfall, Footfalls};
use crate::model::Side;
use crate::motion::TimeGrid;
use crate::numerics::{Order, median};
use crate::spatial::Vec3;

/// Duration of a stance where the recording has no complete one, in √(L/g): 62 % of a cycle of 3.5, at usual walking
/// speed.
const USUAL_STANCE: f64 = 2.1;
/// A longer stance is standing, not a step, in √(L/g): in very slow walking (V* = 0.17) it is 68 % of a cycle of 5.9.
const LONGEST_STEP: f64 = 6.0;
/// Steps of stairs differ by more than this [m]: half the rise of a usual step, as in docs/JUDGEMENT.md.
const LEAST_RISE_M: f64 = 0.08;
/// Speed below which the body stands still, as a share of √(g L).
const UNDER_WAY: f64 = 0.08;

/// Type of gait of a stance.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum GaitType {
    /// Walking: with double support before or after.
    Walk,
    /// Running: between two flights.
    Run,
    /// Standing, or anything else that is not a step.
    Stand,
}

/// One stance with its axes, speed and phase.
#[derive(Debug, Clone)]
pub struct Stance {
    /// Side of the foot.
    pub side: Side,
    /// Strike [s]; estimated where the recording cuts the stance.
    pub start_s: f64,
    /// Off [s]; estimated likewise.
    pub end_s: f64,
    /// Height of the ground [m].
    pub height_m: f64,
    /// Horizontal direction of walking.
    pub forward: Vec3,
    /// The direction to its right.
    pub right: Vec3,
    /// Dimensionless speed V / √(g L).
    pub speed: f64,
    /// Gait of which the stance is a part.
    pub gait: GaitType,
    /// Time until which only the forefoot is on the ground after a forefoot strike; `None` after a strike with
    /// the heel [s].
    pub heel_down_s: Option<f64>,
    /// Whether the stance before or after it is on another step of stairs.
    pub on_stairs: bool,
    /// Traits on which mean errors depend (`stance_traits`).
    pub traits: Traits,
    /// Time [s] and phase of strike, other foot's off, other foot's strike, and off.
    pub knots: Vec<[f64; 2]>,
}

/// Scales that make times, lengths and forces dimensionless.
#[derive(Debug, Clone, Copy)]
pub struct BodyScale {
    /// Direction against gravity.
    pub up: Vec3,
    /// Body weight [N].
    pub weight_n: f64,
    /// √(L/g) [s].
    pub leg_time_s: f64,
    /// √(g L) [m/s].
    pub leg_speed_m_s: f64,
    /// Stature [m].
    pub height_m: f64,
}

/// Stature that the lengths in [`super::FittedParameters`] refer to [m].
const STATURE_M: f64 = 1.75;

impl BodyScale {
    /// Size relative to that stature.
    pub(super) fn size(&self) -> f64 {
        self.height_m / STATURE_M
    }
}

impl Stance {
    /// Forward, up, right.
    pub(super) fn axes(&self, up: Vec3) -> [Vec3; 3] {
        [self.forward, up, self.right]
    }

    pub(super) fn duration_s(&self) -> f64 {
        self.end_s - self.start_s
    }

    /// Whether the foot came down forefoot first and its heel is not down yet.
    pub(super) fn is_on_forefoot(&self, time: f64) -> bool {
        self.heel_down_s.is_some_and(|heel_down_s| time <= heel_down_s)
    }

    /// Elapsed share of the stance.
    pub(super) fn elapsed_share(&self, time: f64) -> f64 {
        ((time - self.start_s) / self.duration_s()).clamp(0.0, 1.0)
    }

    /// Phase in the curves of [`StanceCurves`]: the share of the stance, time-normalised between the events of the
    /// other foot.
    pub(super) fn phase(&self, time: f64) -> f64 {
        let next = self.knots.partition_point(|knot| knot[0] < time).clamp(1, self.knots.len() - 1);
        let [[t0, p0], [t1, p1]] = [self.knots[next - 1], self.knots[next]];
        (p0 + (p1 - p0) * (time - t0) / (t1 - t0).max(f64::MIN_POSITIVE)).clamp(0.0, 1.0)
    }
}

/// An arbitrary horizontal direction.
fn any_level(up: Vec3) -> Vec3 {
    let axis = if up.x.abs() < 0.7 { Vec3::x() } else { Vec3::z() };
    (axis - up * axis.dot(&up)).normalize()
}

/// All stances, in order of their strikes.
pub(super) fn stances(
    footfalls: &Footfalls,
    grid: TimeGrid,
    geometry: &Geometry,
    body_scale: &BodyScale,
    curves: &StanceCurves,
) -> Vec<Stance> {
    let usual_s = usual_duration(footfalls, body_scale);
    let spans: Vec<(&Footfall, f64, f64)> = footfalls.falls.iter().map(|fall| span(fall, grid, usual_s)).collect();
    let mut out: Vec<Stance> = Vec::new();
    for (fall, start_s, end_s) in &spans {
        // Shorter than a frame.
        if end_s - start_s < grid.step_s {
            continue;
        }
        let others: Vec<[f64; 2]> =
            spans.iter().filter(|(o, ..)| o.side != fall.side).map(|(_, a, b)| [*a, *b]).collect();
        out.push(stance(fall, [*start_s, *end_s], &others, grid, geometry, body_scale, curves));
    }
    out.sort_by_number(|stance| stance.start_s);
    let strikes: Vec<Strike> =
        out.iter().map(|stance| Strike { time_s: Some(stance.start_s), height_m: stance.height_m }).collect();
    let center = CenterVelocity { grid, velocity: &geometry.velocity };
    let found = descents(&strikes, center, body_scale.up, body_scale.leg_speed_m_s);
    let leg_m = body_scale.leg_speed_m_s * body_scale.leg_time_s;
    out.iter_mut().zip(found).for_each(|(stance, descent)| stance.traits = traits(descent, stance.speed, leg_m));
    let rises: Vec<bool> =
        out.windows(2).map(|pair| (pair[1].height_m - pair[0].height_m).abs() > LEAST_RISE_M).collect();
    for (i, stance) in out.iter_mut().enumerate() {
        stance.on_stairs = rises.get(i).is_some_and(|rise| *rise) || (i > 0 && rises[i - 1]);
    }
    out
}

fn usual_duration(footfalls: &Footfalls, body_scale: &BodyScale) -> f64 {
    let whole = footfalls.falls.iter().filter_map(|fall| Some(fall.off_s? - fall.strike_s?));
    let steps = whole.filter(|duration| *duration < LONGEST_STEP * body_scale.leg_time_s);
    median(steps.collect::<Vec<f64>>()).unwrap_or(USUAL_STANCE * body_scale.leg_time_s)
}

/// Strike and off; a stance that the recording cuts is as long as the others, and reaches beyond its end.
fn span(fall: &Footfall, grid: TimeGrid, usual_s: f64) -> (&Footfall, f64, f64) {
    let beyond = 0.1 * usual_s;
    let (first, last) = (grid.start_s - beyond, grid.end_s() + beyond);
    let (start, end) = match (fall.strike_s, fall.off_s) {
        (Some(strike), Some(off)) => (strike, off),
        (Some(strike), None) => (strike, (strike + usual_s).max(last)),
        (None, Some(off)) => ((off - usual_s).min(first), off),
        (None, None) => (first, last),
    };
    (fall, start, end)
}

fn stance(
    fall: &Footfall,
    [start_s, end_s]: [f64; 2],
    others: &[[f64; 2]],
    grid: TimeGrid,
    geometry: &Geometry,
    body_scale: &BodyScale,
    curves: &StanceCurves,
) -> Stance {
    let frame = |time: f64| (((time - grid.start_s) / grid.step_s).round().max(0.0) as usize).min(grid.frames - 1);
    let (first, last) = (frame(start_s), frame(end_s));
    let count = (last - first + 1) as f64;
    let level = |v: Vec3| v - body_scale.up * v.dot(&body_scale.up);
    let drift = geometry.velocity[first..=last].iter().sum::<Vec3>() / count - fall.floor_velocity;
    let foot = &geometry.feet[fall.side][(first + last) / 2].sole;
    let pace = level(drift).norm() / body_scale.leg_speed_m_s;
    let heading = if pace > UNDER_WAY { level(drift) } else { level(foot[2] - foot[0]) };
    let forward = heading.try_normalize(f64::MIN_POSITIVE).unwrap_or_else(|| any_level(body_scale.up));
    let near = 0.02 * body_scale.leg_time_s;
    // The other foot's off ends a stance that began before this one; its strike begins a stance that ends later.
    let before = others.iter().filter(|o| o[0] <= start_s).map(|o| o[1]);
    let other_off = before.into_iter().find(|off| *off > start_s + near && *off < end_s - near);
    let other_strike = others
        .iter()
        .rev()
        .filter(|o| o[1] >= end_s)
        .map(|o| o[0])
        .find(|strike| *strike > start_s + near && *strike < end_s - near);
    let meets = others.iter().any(|o| o[0] < end_s && o[1] > start_s);
    let gait = match () {
        () if end_s - start_s > LONGEST_STEP * body_scale.leg_time_s || pace < UNDER_WAY => GaitType::Stand,
        () if meets => GaitType::Walk,
        () => GaitType::Run,
    };
    let marks = curves.at_speed(pace).other_foot_events();
    let mut knots = vec![[start_s, 0.0]];
    if gait == GaitType::Walk {
        knots.extend(other_off.map(|time| [time, marks.other_off]));
        let after = knots.last().map_or(start_s, |knot| knot[0]);
        knots.extend(other_strike.filter(|time| *time > after + near).map(|time| [time, marks.other_strike]));
    }
    knots.push([end_s, 1.0]);
    Stance {
        side: fall.side,
        start_s,
        end_s,
        height_m: fall.floor_height_m,
        forward,
        right: forward.cross(&body_scale.up),
        speed: pace,
        gait,
        heel_down_s: fall
            .strike_s
            .and_then(|_| heel_down(&geometry.feet[fall.side][first..=last], body_scale.up))
            .map(|frames| grid.time(first + frames)),
        on_stairs: false,
        traits: Traits::default(),
        knots,
    }
}

impl Stance {
    /// The normative curves at the speed of this stance.
    pub(super) fn curves<'c>(&self, curves: &'c StanceCurves) -> AtSpeed<'c> {
        curves.at_speed(self.speed)
    }
}
