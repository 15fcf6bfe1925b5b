//! Measures a motion and its stances for the recognition of the activity.

use crate::ground::footfalls::{Footfall, Footfalls};
use crate::ground::predict::total_wrench;
use crate::kinematics::{BodyMotion, Trajectory, each_body_motion};
use crate::model::anatomy::{Movement, Sole};
use crate::model::{BySide, Model, Side};
use crate::motion::TimeGrid;
use crate::numerics::elementary::atan2;
use crate::numerics::{mean, median, range};
use crate::spatial::Vec3;

/// Filters have no neighbours at the ends, so the first and last moments show nothing [s].
const EDGE_S: f64 = 0.1;
/// The body flies while the motion needs less upward force than this [body weights]; a low-pass filter at 6 Hz leaves a
/// quarter of the weight in the middle of a flight of 0.1 s.
const FLIGHT_BW: f64 = 0.3;
/// Both feet leave the ground together within this share of the flight.
const TOGETHER: f64 = 0.5;
/// Rotation of the pelvis within a step is removed by a mean over this time, about one stride [s].
const STRIDE_S: f64 = 1.0;
/// The path is measured in pieces of about half a stride, so that sway does not lengthen it [s].
const PIECE_S: f64 = 0.5;

/// The quantities that distinguish one activity from another.
#[derive(Debug, Clone, Default)]
pub(super) struct Evidence {
    /// Number of foot strikes.
    pub(super) steps: usize,
    /// Median way of a foot over the floor from one stance to its next one [m]; where no foot has two stances, twice
    /// the median step forward from a stance of one foot to the next one of the other; `None` with less.
    pub(super) stride_m: Option<f64>,
    /// Path of the pelvis over the floor [m].
    pub(super) path_m: f64,
    /// Mean speed along this path [m/s].
    pub(super) speed_m_s: f64,
    /// Median share of stance in a cycle.
    pub(super) duty_factor: Option<f64>,
    /// Longest flight [s].
    pub(super) flight_s: f64,
    /// Whether both feet left the ground together before the longest flight.
    pub(super) leaves_with_both_feet: bool,
    /// Mean change of the height of the floor from stance to stance of the other foot [m].
    pub(super) rise_per_step_m: f64,
    /// Range of the heading of the pelvis [rad].
    pub(super) turn_rad: f64,
    /// Range of the height of the pelvis [m].
    pub(super) pelvis_range_m: f64,
    /// Largest range of the flexion of a knee [rad].
    pub(super) knee_range_rad: f64,
    /// Whether the mass centre is behind both feet while the pelvis is lowest.
    pub(super) behind_feet_when_low: bool,
}

/// One instant of the body.
struct Instant {
    /// Pelvis over the floor, horizontal [m].
    level: Vec3,
    /// The rear points of the soles over the floor, horizontal [m].
    feet: BySide<Vec3>,
    /// Height of the pelvis [m].
    height: f64,
    /// Forward direction of the pelvis: horizontal, of unit length.
    forward: Vec3,
    /// Heading of the pelvis [rad], in (-π, π].
    heading: f64,
    /// Distance from the mass centre forward to the nearest rear point of a sole [m]: above zero, it is behind both
    /// feet.
    behind_m: f64,
}

impl Evidence {
    /// `None` for a body without pelvis or two feet, or a motion of a few frames.
    pub(super) fn of(
        model: &Model,
        trajectory: &Trajectory,
        soles: &BySide<Option<Sole>>,
        footfalls: &Footfalls,
    ) -> Option<Evidence> {
        let grid = trajectory.grid();
        let edge = (EDGE_S / grid.step_s).round() as usize;
        let inner = edge..grid.frames.checked_sub(edge)?;
        let instants = instants(model, trajectory, soles, footfalls.floor_velocity)?;
        let stride_m = stride(&instants, footfalls, grid);
        let instants = instants.get(inner.clone()).filter(|inner| inner.len() >= 2)?;
        let flight = longest_flight(model, trajectory, footfalls, inner.start);
        let heights: Vec<f64> = instants.iter().map(|instant| instant.height).collect();
        let lowest = (0..heights.len()).min_by(|a, b| heights[*a].total_cmp(&heights[*b]))?;
        let path_m = path(instants, grid);
        Some(Evidence {
            steps: footfalls.falls.iter().filter(|fall| fall.strike_s.is_some()).count(),
            stride_m,
            path_m,
            speed_m_s: path_m / ((instants.len() - 1) as f64 * grid.step_s),
            duty_factor: duty_factor(footfalls),
            flight_s: flight.map_or(0.0, |[from, to]| to - from),
            leaves_with_both_feet: flight.is_some_and(|span| together(footfalls, span)),
            rise_per_step_m: rise_per_step(footfalls),
            turn_rad: turn(instants, grid),
            pelvis_range_m: range(&heights),
            knee_range_rad: knee_range(model, trajectory, inner.start, inner.end),
            behind_feet_when_low: instants[lowest].behind_m > 0.0,
        })
    }
}

fn instants(
    model: &Model,
    trajectory: &Trajectory,
    soles: &BySide<Option<Sole>>,
    floor_velocity: Vec3,
) -> Option<Vec<Instant>> {
    let (up, grid) = (model.up(), trajectory.grid());
    let pelvis = model.anatomy().pelvis()?;
    let legs = model.anatomy().legs().as_ref().map(|leg| leg.as_ref().map(|leg| leg.hip)).both()?;
    let soles = soles.as_ref().map(Option::as_ref).both()?;
    let mut instants = Vec::with_capacity(grid.frames);
    each_body_motion(model, trajectory, |frame, bodies| {
        let across = bodies[legs.right.index()].pose.translation - bodies[legs.left.index()].pose.translation;
        let forward = up.cross(&across);
        let level = forward - up * forward.dot(&up);
        let forward = level / level.norm().max(f64::MIN_POSITIVE);
        let moved = floor_velocity * (grid.time(frame) - grid.start_s);
        let place = bodies[pelvis.index()].pose.translation - moved;
        let rear = |side: Side| {
            let point = &soles[side].points[0];
            bodies[point.body.index()].pose.place(point.place)
        };
        let behind = |side: Side| -> f64 { (rear(side) - mass_center(model, bodies)).dot(&forward) };
        instants.push(Instant {
            level: place - up * place.dot(&up),
            feet: BySide::from_fn(|side| rear(side) - moved - up * (rear(side) - moved).dot(&up)),
            height: place.dot(&up),
            forward,
            heading: heading(forward, up),
            behind_m: behind(Side::Right).min(behind(Side::Left)),
        });
    });
    Some(instants)
}

fn mass_center(model: &Model, bodies: &[BodyMotion]) -> Vec3 {
    let moments = model.bodies().iter().zip(bodies).map(|(body, motion)| motion.center * body.inertia.mass());
    moments.sum::<Vec3>() / model.mass()
}

/// Angle of a horizontal direction about the vertical [rad].
fn heading(forward: Vec3, up: Vec3) -> f64 {
    let reference = if up.x.abs() < 0.5 { Vec3::x() } else { Vec3::z() };
    let ahead = (reference - up * reference.dot(&up)).normalize();
    atan2(forward.dot(&up.cross(&ahead)), forward.dot(&ahead))
}

/// Median distance between the places of a foot in the middle of a stance and of its next one [m], or twice the
/// distance forward between the places of both feet.
fn stride(instants: &[Instant], footfalls: &Footfalls, grid: TimeGrid) -> Option<f64> {
    let middle = |fall: &Footfall| {
        let (from, to) = (fall.strike_s.unwrap_or(grid.start_s), fall.off_s.unwrap_or(grid.end_s()));
        let frame = ((0.5 * (from + to) - grid.start_s) / grid.step_s).round() as usize;
        instants.get(frame).map(|instant| (instant.feet[fall.side], instant.forward))
    };
    let mut ways = Vec::new();
    for side in Side::BOTH {
        let places: Vec<Vec3> = footfalls.of(side).filter_map(middle).map(|(place, _)| place).collect();
        ways.extend(places.windows(2).map(|pair| (pair[1] - pair[0]).norm()));
    }
    let of_pair = |pair: &[Footfall]| {
        let ((from, forward), (to, _)) = (middle(&pair[0])?, middle(&pair[1])?);
        (pair[0].side != pair[1].side).then(|| 2.0 * (to - from).dot(&forward).abs())
    };
    median(ways).or_else(|| median(footfalls.falls.windows(2).filter_map(of_pair)))
}

/// Length of the path in pieces [m].
fn path(instants: &[Instant], grid: TimeGrid) -> f64 {
    let piece = ((PIECE_S / grid.step_s).round() as usize).clamp(1, instants.len() - 1);
    let mut marks: Vec<usize> = (0..instants.len()).step_by(piece).collect();
    if let Some(last) = marks.last_mut().filter(|last| instants.len() - **last < piece) {
        *last = instants.len() - 1;
    }
    marks.windows(2).map(|pair| (instants[pair[1]].level - instants[pair[0]].level).norm()).sum()
}

/// Range of the heading, each the mean of about a stride [rad].
fn turn(instants: &[Instant], grid: TimeGrid) -> f64 {
    let mut unwrapped = Vec::with_capacity(instants.len());
    let mut last = instants[0].heading;
    for instant in instants {
        last +=
            (instant.heading - last + std::f64::consts::PI).rem_euclid(std::f64::consts::TAU) - std::f64::consts::PI;
        unwrapped.push(last);
    }
    let width = ((STRIDE_S / grid.step_s).round() as usize).clamp(1, (instants.len() / 3).max(1));
    let means: Vec<f64> = unwrapped.windows(width).map(mean).collect();
    range(&means)
}

/// First and last instant of the longest time in which no foot is on the ground and the motion needs almost no upward
/// force [s].
fn longest_flight(model: &Model, trajectory: &Trajectory, footfalls: &Footfalls, edge: usize) -> Option<[f64; 2]> {
    let (grid, up) = (trajectory.grid(), model.up());
    let weight = model.mass() * model.gravity().norm();
    let total = total_wrench(model, trajectory);
    let inner = edge..grid.frames.saturating_sub(edge);
    let flies = |frame: &usize| {
        let stands = footfalls.falls.iter().any(|fall| is_on_ground(fall, grid.time(*frame)));
        !stands && total[*frame].force.dot(&up) < FLIGHT_BW * weight
    };
    let mut longest: Option<[f64; 2]> = None;
    let mut start = None;
    for frame in inner {
        start = if flies(&frame) { start.or(Some(frame)) } else { None };
        let Some(first) = start else { continue };
        let span = [grid.time(first), grid.time(frame)];
        if longest.is_none_or(|[from, to]| span[1] - span[0] > to - from) {
            longest = Some(span);
        }
    }
    longest
}

fn is_on_ground(fall: &Footfall, time_s: f64) -> bool {
    fall.strike_s.is_none_or(|strike| strike <= time_s) && fall.off_s.is_none_or(|off| off >= time_s)
}

/// Whether both feet left the ground shortly before a flight.
fn together(footfalls: &Footfalls, [from, to]: [f64; 2]) -> bool {
    let last_off = |side: Side| {
        let offs = footfalls.of(side).filter_map(|fall| fall.off_s).filter(|off| *off <= 0.5 * (from + to));
        offs.max_by(f64::total_cmp)
    };
    match [Side::Right, Side::Left].map(last_off) {
        [Some(right), Some(left)] => (right - left).abs() < TOGETHER * (to - from),
        _ => false,
    }
}

/// Median share of stance in the cycles from strike to strike.
fn duty_factor(footfalls: &Footfalls) -> Option<f64> {
    let mut shares = Vec::new();
    for side in Side::BOTH {
        let falls: Vec<&Footfall> = footfalls.of(side).collect();
        for pair in falls.windows(2) {
            if let (Some(strike), Some(off), Some(next)) = (pair[0].strike_s, pair[0].off_s, pair[1].strike_s) {
                shares.push((off - strike) / (next - strike));
            }
        }
    }
    median(shares)
}

/// Mean change of the height of the floor from a stance to the next one of the other foot [m]; who sets both feet on
/// each stair rises with every second step.
fn rise_per_step(footfalls: &Footfalls) -> f64 {
    let pairs = footfalls.falls.windows(2).filter(|pair| pair[0].side != pair[1].side);
    let (count, sum) =
        pairs.fold((0, 0.0), |(count, sum), pair| (count + 1, sum + pair[1].floor_height_m - pair[0].floor_height_m));
    sum / f64::from(count.max(1))
}

/// Largest range of the flexion of a knee [rad].
fn knee_range(model: &Model, trajectory: &Trajectory, from: usize, to: usize) -> f64 {
    let knee = |side| model.anatomy().coordinate(Movement::KneeFlexion, Some(side));
    let ranges = Side::BOTH.into_iter().filter_map(knee).map(|(id, _)| range(&trajectory.values(id)[from..to]));
    ranges.fold(0.0, f64::max)
}
