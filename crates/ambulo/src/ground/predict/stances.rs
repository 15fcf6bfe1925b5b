//! The stances of both feet as the estimate sees them: whole, with axes, speed, and the phase of every instant.

use super::geometry::Geometry;
use super::stance_curves::{AtSpeed, StanceCurves};
use crate::ground::footfalls::{Footfall, Footfalls};
use crate::model::Side;
use crate::motion::TimeGrid;
use crate::numerics::median;
use crate::spatial::Vec3;

/// Stance of a walk at usual speed where the recording shows none in full, in leg times √(L/g): 62 % of a cycle of 3.5.
const USUAL_STANCE: f64 = 2.1;
/// A stance that is longer is standing, not a step, in leg times: very slow walking (V* = 0.17) has 68 % of a cycle of 5.9.
const LONGEST_STEP: f64 = 6.0;
/// Slower than this share of √(g L) the body is not under way.
const UNDER_WAY: f64 = 0.08;

/// How a stance carries the body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Gait {
    /// With double support before or after.
    Walk,
    /// Between two flights.
    Run,
    /// Standing, or whatever is no step.
    Stand,
}

/// One stance.
#[derive(Debug, Clone)]
pub(super) struct Stance {
    pub(super) side: Side,
    /// Strike and off [s]; where the recording cuts them, as they probably were.
    pub(super) start_s: f64,
    pub(super) end_s: f64,
    /// Of the ground, along the upward direction [m].
    pub(super) height_m: f64,
    /// Level directions of the walk and to its right.
    pub(super) forward: Vec3,
    pub(super) right: Vec3,
    /// V / √(g L).
    pub(super) speed: f64,
    pub(super) gait: Gait,
    /// Instants [s] and shares of the stance of strike, other foot's off and strike, off.
    knots: Vec<[f64; 2]>,
}

/// The body's measure: what makes times, lengths and forces dimensionless.
#[derive(Debug, Clone, Copy)]
pub(super) struct Measure {
    /// Direction against gravity.
    pub(super) up: Vec3,
    /// Body weight [N].
    pub(super) weight_n: f64,
    /// √(L/g) [s] and √(g L) [m/s].
    pub(super) leg_time_s: f64,
    pub(super) leg_speed_m_s: f64,
    /// Stature [m].
    pub(super) height_m: f64,
}

/// Stature for which lengths of [`super::Weights`] are given [m].
const STATURE_M: f64 = 1.75;

impl Measure {
    /// Size against that stature.
    pub(super) fn size(&self) -> f64 {
        self.height_m / STATURE_M
    }
}

impl Stance {
    pub(super) fn duration_s(&self) -> f64 {
        self.end_s - self.start_s
    }

    /// Share of the stance that has passed.
    pub(super) fn own_phase(&self, time: f64) -> f64 {
        ((time - self.start_s) / self.duration_s()).clamp(0.0, 1.0)
    }

    /// The same, with the other foot's events where they are in the curves of [`StanceCurves`]: straight lines between them.
    pub(super) fn phase(&self, time: f64) -> f64 {
        let next = self.knots.partition_point(|knot| knot[0] < time).clamp(1, self.knots.len() - 1);
        let [[t0, p0], [t1, p1]] = [self.knots[next - 1], self.knots[next]];
        (p0 + (p1 - p0) * (time - t0) / (t1 - t0).max(f64::MIN_POSITIVE)).clamp(0.0, 1.0)
    }
}

/// A level direction where none is better than another.
fn any_level(up: Vec3) -> Vec3 {
    let axis = if up.x.abs() < 0.7 { Vec3::x() } else { Vec3::z() };
    (axis - up * axis.dot(&up)).normalize()
}

/// All stances, in the order of their strikes.
pub(super) fn stances(
    footfalls: &Footfalls,
    grid: TimeGrid,
    geometry: &Geometry,
    measure: &Measure,
    curves: &StanceCurves,
) -> Vec<Stance> {
    let usual_s = usual_duration(footfalls, measure);
    let spans: Vec<(&Footfall, f64, f64)> = footfalls.falls.iter().map(|fall| span(fall, grid, usual_s)).collect();
    let mut out: Vec<Stance> = Vec::new();
    for (fall, start_s, end_s) in &spans {
        // What is shorter than a frame carries nothing.
        if end_s - start_s < grid.step_s {
            continue;
        }
        let others: Vec<[f64; 2]> =
            spans.iter().filter(|(o, ..)| o.side != fall.side).map(|(_, a, b)| [*a, *b]).collect();
        out.push(stance(fall, [*start_s, *end_s], &others, grid, geometry, measure, curves));
    }
    out.sort_by(|a, b| a.start_s.total_cmp(&b.start_s));
    out
}

fn usual_duration(footfalls: &Footfalls, measure: &Measure) -> f64 {
    let whole = footfalls.falls.iter().filter_map(|fall| Some(fall.off_s? - fall.strike_s?));
    let steps = whole.filter(|duration| *duration < LONGEST_STEP * measure.leg_time_s);
    median(steps.collect::<Vec<f64>>()).unwrap_or(USUAL_STANCE * measure.leg_time_s)
}

/// From strike to off; what the recording cuts is as long as other stances, and at least reaches its end.
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
    measure: &Measure,
    curves: &StanceCurves,
) -> Stance {
    let frame = |time: f64| (((time - grid.start_s) / grid.step_s).round().max(0.0) as usize).min(grid.frames - 1);
    let (first, last) = (frame(start_s), frame(end_s));
    let count = (last - first + 1) as f64;
    let level = |v: Vec3| v - measure.up * v.dot(&measure.up);
    let drift = geometry.velocity[first..=last].iter().sum::<Vec3>() / count - fall.floor_velocity;
    let foot = &geometry.feet[fall.side][(first + last) / 2].sole;
    let pace = level(drift).norm() / measure.leg_speed_m_s;
    let heading = if pace > UNDER_WAY { level(drift) } else { level(foot[2] - foot[0]) };
    let forward = heading.try_normalize(f64::MIN_POSITIVE).unwrap_or_else(|| any_level(measure.up));
    let near = 0.02 * measure.leg_time_s;
    // The other foot leaves a stance that began before this one, and meets the ground for one that ends after it.
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
        () if end_s - start_s > LONGEST_STEP * measure.leg_time_s || pace < UNDER_WAY => Gait::Stand,
        () if meets => Gait::Walk,
        () => Gait::Run,
    };
    let marks = curves.at_speed(pace).landmarks();
    let mut knots = vec![[start_s, 0.0]];
    if gait == Gait::Walk {
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
        right: forward.cross(&measure.up),
        speed: pace,
        gait,
        knots,
    }
}

impl Stance {
    /// The curves of walking at its speed.
    pub(super) fn curves<'c>(&self, curves: &'c StanceCurves) -> AtSpeed<'c> {
        curves.at_speed(self.speed)
    }
}
