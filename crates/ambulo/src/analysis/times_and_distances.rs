//! Times and distances of walking for every stride: speed, cadence, step and stride length, step width, stance, swing
//! and support.
//!
//! | quantity              | definition |
//! |-----------------------|---|
//! | cycle time            | foot strike to next foot strike of the same foot, with one foot off in between |
//! | stance, swing         | foot strike to foot off, foot off to foot strike, as shares of the cycle |
//! | single support        | foot off to foot strike of the other foot within the stance |
//! | double support        | initial: foot strike to foot off of the other foot; terminal: foot strike of the other foot to foot off |
//! | step time             | foot strike of the other foot to the foot strike that ends the stride |
//! | stride length         | displacement of the heel (rear point of the sole) over the floor from strike to strike |
//! | step length and width | from the other heel at its strike to this heel at its strike, along and across the walking direction |
//!
//! On a treadmill, positions are relative to the belt; its velocity is taken from the loaded feet. The walking
//! direction of a step is the direction of the strides around it, so turning does not change the step width. The path
//! is the pelvis path relative to the same floor. Pinned by: tests/analysis_times_and_distances.rs,
//! tests/times_and_distances.rs

use super::events::{Event, EventKind};
use super::feasibility::over_ground;
use super::recording::Analysis;
use crate::kinematics::each_body_motion;
use crate::model::anatomy::Sole;
use crate::model::{BySide, Model, Side};
use crate::motion::{TimeGrid, interpolate};
use crate::numerics::elementary::acos;
use crate::numerics::{Order, mean, sample_deviation};
use crate::spatial::Vec3;

/// A floor velocity below this share of the walking speed is taken as zero.
const MOVING_FLOOR: f64 = 0.2;
/// If two strikes of a foot are this many median strides apart, a strike in between was not detected.
const MISSED: f64 = 1.5;

/// The pelvis moves at least this far in a stride that has a direction [m].
pub(super) const LEAST_STRIDE_M: f64 = 0.2;
/// A path that is this many times as long as the straight line between its ends has its own speed.
const LONGER: f64 = 1.05;
/// The path is measured in pieces of about this time: half a stride, so that sway does not lengthen it [s].
const PIECE_S: f64 = 0.5;

/// Times and distances of all strides.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct TimesAndDistances {
    /// Mean speed over the floor or belt [m/s].
    pub speed_m_s: Option<f64>,
    /// Mean speed along the path of the pelvis [m/s], where a curved path makes it more than 5 % larger than the
    /// straight one.
    pub path_speed_m_s: Option<f64>,
    /// Speed of the belt of a treadmill [m/s]; `None` on a floor that does not move.
    pub belt_speed_m_s: Option<f64>,
    /// Mean velocity of the pelvis in the world, along the floor [m/s]; `None` without a pelvis.
    pub pelvis_velocity: Option<Vec3>,
    /// Largest angle between the directions of any two strides [rad]: how far the path turns.
    pub turn: Option<f64>,
    /// Every stride of both feet, right foot first.
    pub strides: Vec<Stride>,
}

/// One stride of a foot: strike, foot off, next strike. Shares refer to the cycle, from 0 to 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stride {
    /// Side of the foot.
    pub side: Side,
    /// First strike [s].
    pub start_s: f64,
    /// Duration of the cycle [s].
    pub cycle_s: f64,
    /// Share of the stance.
    pub stance: f64,
    /// Share of single support, if the events of the other foot are known.
    pub single_support: Option<f64>,
    /// Share from foot strike to foot off of the other foot, if known.
    pub initial_double_support: Option<f64>,
    /// Share from foot strike of the other foot to foot off, if known.
    pub terminal_double_support: Option<f64>,
    /// Time from foot strike of the other foot to the end of the stride [s].
    pub step_time_s: Option<f64>,
    /// Displacement of the heel over the floor [m], if the soles are known.
    pub stride_length_m: Option<f64>,
    /// Forward distance from the other heel to this one at the end of the stride [m].
    pub step_length_m: Option<f64>,
    /// Lateral distance of the heels [m], positive if the feet are not crossed.
    pub step_width_m: Option<f64>,
}

/// A quantity of walking.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum StrideQuantity {
    /// Steps per time [1/s].
    Cadence,
    /// Stride length [m].
    StrideLength,
    /// Step length [m].
    StepLength,
    /// Step width [m].
    StepWidth,
    /// Duration of a cycle [s].
    CycleTime,
    /// Duration of a step [s].
    StepTime,
    /// Duration of stance [s].
    StanceTime,
    /// Duration of swing [s].
    SwingTime,
    /// Share of stance.
    Stance,
    /// Share of swing.
    Swing,
    /// Share of single support.
    SingleSupport,
    /// Share of double support.
    DoubleSupport,
    /// Share of double support after foot strike.
    InitialDoubleSupport,
    /// Share of double support before foot off.
    TerminalDoubleSupport,
    /// Step length over cadence [m s].
    WalkRatio,
}

/// Mean and spread of a quantity over strides.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StrideStatistics {
    /// Mean.
    pub mean: f64,
    /// Standard deviation; `None` for a single stride.
    pub standard_deviation: Option<f64>,
    /// Number of strides.
    pub strides: usize,
}

impl StrideQuantity {
    /// All quantities, in the order of tables.
    pub const ALL: [StrideQuantity; 15] = [
        StrideQuantity::Cadence,
        StrideQuantity::StrideLength,
        StrideQuantity::StepLength,
        StrideQuantity::StepWidth,
        StrideQuantity::CycleTime,
        StrideQuantity::StepTime,
        StrideQuantity::StanceTime,
        StrideQuantity::SwingTime,
        StrideQuantity::Stance,
        StrideQuantity::Swing,
        StrideQuantity::SingleSupport,
        StrideQuantity::DoubleSupport,
        StrideQuantity::InitialDoubleSupport,
        StrideQuantity::TerminalDoubleSupport,
        StrideQuantity::WalkRatio,
    ];

    /// The name in files.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            StrideQuantity::Cadence => "cadence",
            StrideQuantity::StrideLength => "stride_length",
            StrideQuantity::StepLength => "step_length",
            StrideQuantity::StepWidth => "step_width",
            StrideQuantity::CycleTime => "cycle_time",
            StrideQuantity::StepTime => "step_time",
            StrideQuantity::StanceTime => "stance_time",
            StrideQuantity::SwingTime => "swing_time",
            StrideQuantity::Stance => "stance",
            StrideQuantity::Swing => "swing",
            StrideQuantity::SingleSupport => "single_support",
            StrideQuantity::DoubleSupport => "double_support",
            StrideQuantity::InitialDoubleSupport => "initial_double_support",
            StrideQuantity::TerminalDoubleSupport => "terminal_double_support",
            StrideQuantity::WalkRatio => "walk_ratio",
        }
    }

    /// The value for a stride, in SI units.
    #[must_use]
    pub fn of(self, stride: &Stride) -> Option<f64> {
        match self {
            StrideQuantity::Cadence => Some(2.0 / stride.cycle_s),
            StrideQuantity::StrideLength => stride.stride_length_m,
            StrideQuantity::StepLength => stride.step_length_m,
            StrideQuantity::StepWidth => stride.step_width_m,
            StrideQuantity::CycleTime => Some(stride.cycle_s),
            StrideQuantity::StepTime => stride.step_time_s,
            StrideQuantity::StanceTime => Some(stride.stance * stride.cycle_s),
            StrideQuantity::SwingTime => Some((1.0 - stride.stance) * stride.cycle_s),
            StrideQuantity::Stance => Some(stride.stance),
            StrideQuantity::Swing => Some(1.0 - stride.stance),
            StrideQuantity::SingleSupport => stride.single_support,
            StrideQuantity::DoubleSupport => Some(stride.stance - stride.single_support?),
            StrideQuantity::InitialDoubleSupport => stride.initial_double_support,
            StrideQuantity::TerminalDoubleSupport => stride.terminal_double_support,
            StrideQuantity::WalkRatio => Some(0.5 * stride.step_length_m? * stride.cycle_s),
        }
    }
}

impl TimesAndDistances {
    /// Mean and standard deviation of a quantity over the strides of one foot or of both; `None` if it is unknown.
    #[must_use]
    pub fn spread(&self, quantity: StrideQuantity, side: Option<Side>) -> Option<StrideStatistics> {
        let chosen = self.strides.iter().filter(|stride| side.is_none_or(|side| stride.side == side));
        let values: Vec<f64> = chosen.filter_map(|stride| quantity.of(stride)).collect();
        (!values.is_empty()).then(|| StrideStatistics {
            mean: mean(&values),
            standard_deviation: sample_deviation(&values),
            strides: values.len(),
        })
    }

    /// Symmetry index of the means of both feet: (right - left) over their mean. 0 is symmetric, positive if the right
    /// one is larger. `None` for values with different signs or near zero, whose ratio has no meaning.
    #[must_use]
    pub fn symmetry(&self, quantity: StrideQuantity) -> Option<f64> {
        let [right, left] = [Side::Right, Side::Left].map(|side| Some(self.spread(quantity, Some(side))?.mean));
        symmetry_index(right?, left?)
    }
}

/// (right - left) over the mean of both sizes; `None` for values with different signs or near zero.
#[must_use]
pub fn symmetry_index(right: f64, left: f64) -> Option<f64> {
    let sum = right.abs() + left.abs();
    (right * left > 0.0).then(|| 2.0 * (right.abs() - left.abs()) / sum)
}

/// Computes times and distances of an analysed walk; without soles there are no distances.
#[must_use]
pub fn times_and_distances(model: &Model, soles: &BySide<Option<Sole>>, analysis: &Analysis) -> TimesAndDistances {
    let floor = Floor::of(model, analysis);
    let places = Places::of(model, soles, analysis, floor);
    let path = PelvisPath::of(model, analysis, floor);
    let (mut strides, mut directions) = (Vec::new(), Vec::new());
    for side in Side::BOTH {
        for pair in times(&analysis.events, side, EventKind::Strike).windows(2) {
            let span = [pair[0], pair[1]];
            strides.extend(stride(&analysis.events, &places, side, span));
            let moved = path.as_ref().and_then(|path| path.between(span));
            directions.extend(moved.and_then(|moved| moved.try_normalize(LEAST_STRIDE_M)));
        }
    }
    TimesAndDistances {
        speed_m_s: analysis.speed_m_s,
        path_speed_m_s: path.as_ref().filter(|_| floor.is_still()).and_then(PelvisPath::longer_speed),
        belt_speed_m_s: (!floor.is_still()).then(|| floor.velocity.norm()),
        pelvis_velocity: path.as_ref().and_then(PelvisPath::velocity).map(|velocity| velocity + floor.velocity),
        turn: largest_angle(&directions),
        strides,
    }
}

/// Between any two directions [rad]; `None` of fewer than two.
fn largest_angle(directions: &[Vec3]) -> Option<f64> {
    let pairs = directions.iter().enumerate().flat_map(|(i, a)| directions[i + 1..].iter().map(move |b| (a, b)));
    pairs.map(|(a, b)| acos(a.dot(b).clamp(-1.0, 1.0))).max_by(f64::total_cmp)
}

fn times(events: &[Event], side: Side, kind: EventKind) -> Vec<f64> {
    events.iter().filter(|e| e.side == side && e.kind == kind).map(|e| e.time_s).collect()
}

/// The stride of a foot between two strikes; `None` if the foot does not leave the ground exactly once.
fn stride(events: &[Event], places: &Places, side: Side, span: [f64; 2]) -> Option<Stride> {
    let off = only(&times(events, side, EventKind::Off), span)?;
    let other = side.other();
    let other_off = only(&times(events, other, EventKind::Off), span);
    let other_strike = only(&times(events, other, EventKind::Strike), span);
    let alone = other_off.zip(other_strike).filter(|(from, to)| from < to && *to <= off);
    let cycle_s = span[1] - span[0];
    let share = |from: f64, to: f64| (to - from) / cycle_s;
    let placed = places.of_stride(side, span);
    Some(Stride {
        side,
        start_s: span[0],
        cycle_s,
        stance: share(span[0], off),
        single_support: alone.map(|(from, to)| share(from, to)),
        initial_double_support: alone.map(|(other_off, _)| share(span[0], other_off)),
        terminal_double_support: alone.map(|(_, other_strike)| share(other_strike, off)),
        step_time_s: other_strike.map(|other_strike| span[1] - other_strike),
        stride_length_m: placed.map(|placed| placed.stride_m),
        step_length_m: placed.and_then(|placed| placed.step_m),
        step_width_m: placed.and_then(|placed| placed.width_m),
    })
}

/// The only time inside a span; `None` if there are none or several.
fn only(times: &[f64], [from, to]: [f64; 2]) -> Option<f64> {
    let mut inside = times.iter().copied().filter(|t| *t > from && *t < to);
    let first = inside.next()?;
    inside.next().is_none().then_some(first)
}

/// A foot strike with the position of the heel relative to the floor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Strike {
    /// Side of the foot.
    pub side: Side,
    /// Time of the strike [s].
    pub time_s: f64,
    /// Position of the heel relative to the floor [m].
    pub heel: Vec3,
}

/// The floor: which direction is up, and how a belt moves [m/s].
#[derive(Debug, Clone, Copy)]
pub struct Floor {
    /// Upward unit vector.
    pub up: Vec3,
    /// Velocity of the belt [m/s].
    pub velocity: Vec3,
}

impl Floor {
    /// A belt moves with the feet that carry the body; a floor that moves slower than a share of the walking speed is
    /// still.
    pub(super) fn of(model: &Model, analysis: &Analysis) -> Floor {
        let up = model.up();
        let still = Floor { up, velocity: Vec3::zeros() };
        let over = over_ground(model, &analysis.trajectory, &analysis.ground, up);
        let Some((ground, speed)) = over else { return still };
        let velocity = still.level(ground);
        if velocity.norm() > MOVING_FLOOR * speed { Floor { up, velocity } } else { still }
    }

    fn is_still(&self) -> bool {
        self.velocity == Vec3::zeros()
    }

    /// The part of a vector along the floor.
    pub(super) fn level(&self, v: Vec3) -> Vec3 {
        v - self.up * v.dot(&self.up)
    }
}

/// Where the pelvis is over the floor, frame by frame, as if the floor had not moved since the first frame.
pub(super) struct PelvisPath {
    grid: TimeGrid,
    places: Vec<Vec3>,
}

impl PelvisPath {
    /// `None` of a body without a pelvis.
    pub(super) fn of(model: &Model, analysis: &Analysis, floor: Floor) -> Option<PelvisPath> {
        let pelvis = model.anatomy().pelvis()?;
        let grid = analysis.trajectory.grid();
        let mut places = Vec::with_capacity(grid.frames);
        each_body_motion(model, &analysis.trajectory, |frame, bodies| {
            let passed_s = grid.time(frame) - grid.start_s;
            places.push(floor.level(bodies[pelvis.index()].pose.translation) - floor.velocity * passed_s);
        });
        Some(PelvisPath { grid, places })
    }

    /// Displacement from one instant to another [m].
    pub(super) fn between(&self, [from, to]: [f64; 2]) -> Option<Vec3> {
        Some(at(self.grid, &self.places, to)? - at(self.grid, &self.places, from)?)
    }

    /// Mean velocity over the floor [m/s].
    fn velocity(&self) -> Option<Vec3> {
        let (start, end) = (self.grid.start_s, self.grid.end_s());
        Some(self.between([start, end])? / (end - start))
    }

    /// Mean speed along the path [m/s] where it clearly differs from the straight one.
    fn longer_speed(&self) -> Option<f64> {
        let (start, duration) = (self.grid.start_s, self.grid.end_s() - self.grid.start_s);
        let pieces = (duration / PIECE_S).round().max(1.0);
        let instant = |i: usize| start + duration * i as f64 / pieces;
        let lengths = (0..pieces as usize).map(|i| Some(self.between([instant(i), instant(i + 1)])?.norm()));
        let along = lengths.sum::<Option<f64>>()? / duration;
        (along > LONGER * self.velocity()?.norm()).then_some(along)
    }
}

/// Where the heels are at the strikes, in order of time.
pub struct Places {
    /// The floor under the feet.
    pub floor: Floor,
    /// Strikes in order of time.
    pub strikes: Vec<Strike>,
}

/// Distances of one stride.
#[derive(Debug, Clone, Copy)]
pub struct Placed {
    stride_m: f64,
    /// Length of the step [m].
    pub step_m: Option<f64>,
    /// Width of the step [m].
    pub width_m: Option<f64>,
}

impl Places {
    fn of(model: &Model, soles: &BySide<Option<Sole>>, analysis: &Analysis, floor: Floor) -> Places {
        let grid = analysis.trajectory.grid();
        let mut heels: BySide<Vec<Vec3>> = BySide::default();
        each_body_motion(model, &analysis.trajectory, |_, bodies| {
            for (side, sole) in soles.iter() {
                let heel = sole.as_ref().map(|sole| sole.points[0]);
                heels[side].extend(heel.map(|heel| bodies[heel.body.index()].pose.place(heel.place)));
            }
        });
        let strikes = analysis.events.iter().filter(|event| event.kind == EventKind::Strike);
        let placed = |event: &Event| {
            let heel = at(grid, &heels[event.side], event.time_s)? - floor.velocity * (event.time_s - grid.start_s);
            Some(Strike { side: event.side, time_s: event.time_s, heel })
        };
        let mut strikes: Vec<Strike> = strikes.filter_map(placed).collect();
        strikes.sort_by_number(|event| event.time_s);
        Places { floor, strikes }
    }

    /// Distances of the stride between two strikes of a foot at these times [s].
    pub fn of_stride(&self, side: Side, [from, to]: [f64; 2]) -> Option<Placed> {
        let at = |time: f64| self.strikes.iter().find(|s| s.side == side && s.time_s.total_cmp(&time).is_eq());
        let (first, last) = (at(from)?, at(to)?);
        let line = self.floor.level(last.heel - first.heel);
        let mut between = self.strikes.iter().filter(|s| s.side != side && s.time_s > from && s.time_s < to);
        let other = between.next().filter(|_| between.next().is_none());
        let outwards = if side == Side::Right { 1.0 } else { -1.0 };
        let step = other.map(|other| {
            let (step, ahead) = (last.heel - other.heel, self.heading(line, other, to - from));
            [step.dot(&ahead), outwards * step.dot(&ahead.cross(&self.floor.up))]
        });
        Some(Placed { stride_m: line.norm(), step_m: step.map(|step| step[0]), width_m: step.map(|step| step[1]) })
    }

    /// The walking direction in the step from the strike of the `other` foot to the one that ends the stride `line`.
    /// The direction of a stride holds at its middle: this foot's stride gives it half a step before, the other foot's
    /// next stride half a step after. If there is no next stride, the other foot's last stride is used, one and a half
    /// steps before.
    fn heading(&self, line: Vec3, other: &Strike, stride_s: f64) -> Vec3 {
        let of_other = |from_s: f64, to_s: f64| {
            let same_foot = |s: &&Strike| s.side == other.side && s.time_s > from_s && s.time_s < to_s;
            let mut inside = self.strikes.iter().filter(same_foot);
            inside.find(|s| (s.time_s - other.time_s).abs() > 0.5 * stride_s)
        };
        let longest = MISSED * stride_s;
        let direction = |way: Vec3| way.try_normalize(1e-6);
        let own = direction(line).unwrap_or_else(Vec3::x);
        let next = of_other(other.time_s, other.time_s + longest).map(|next| self.floor.level(next.heel - other.heel));
        let last = of_other(other.time_s - longest, other.time_s).map(|last| self.floor.level(other.heel - last.heel));
        let ahead = match (next.and_then(direction), last.and_then(direction)) {
            (Some(next), _) => own + next,
            (None, Some(last)) => own * 1.5 - last * 0.5,
            (None, None) => own,
        };
        direction(ahead).unwrap_or(own)
    }
}

/// A path at a time, linearly interpolated between frames.
fn at(grid: TimeGrid, path: &[Vec3], time_s: f64) -> Option<Vec3> {
    let times = grid.times();
    let along = |axis: usize| interpolate(&times, &path.iter().map(|p| p[axis]).collect::<Vec<f64>>(), time_s);
    (!path.is_empty()).then(|| Vec3::new(along(0), along(1), along(2)))
}
