//! Holds loaded feet still: a motion whose feet slide on the floor is changed as little as the floor requires.
//!
//! Joint angles that a program fitted without knowledge of the floor let loaded feet slide. The coordinates that move
//! the soles are changed by δ:
//!
//!   δ = argmin Σ_frames ( Σ_points w |h(p(q + δ) - v t - p̄)|² / σ_p²
//!                           + Σ_coordinates (δ_i / σ_i)² + (δ_i'' / (ω² σ_i))² )
//!
//! | code       | symbol | unit     | meaning |
//! | `points`   | p      | m        | rear, ball and tip of a sole; h takes the horizontal part |
//! | `weight`   | w      | 1        | 1 while the point rests on the floor: in stance and near its lowest place |
//! | `velocity` | v      | m/s      | velocity of the floor, as the belt of a treadmill |
//! | `place`    | p̄     | m        | mean of p - v t over the stance, weighted by w |
//! | `STILL_M`  | σ_p    | m        | how still a point that rests is: skin and shoe give way, the rigid foot of a model does not |
//! | `TURN`, `SHIFT_M` | σ_i | rad, m | usual error of a fitted angle, of a displacement |
//! | `CHANGING` | ω      | rad/s    | how fast these errors change: a faster change would itself be a force |
//!
//! Heights are not changed. In animation the same task is called the clean-up of sliding feet.
//!
//! Solved by two Gauss-Newton steps with numerical derivatives of the poses, over all frames at once: a band matrix
//! with 2 n bands for n coordinates. Cost: about 0.3 ms and 16 n² bytes per frame.
//! Not handled: slipping that is real, such as on ice; belts of different speed under the two feet.
//! Pinned by: tests/refit.rs

use super::footfalls::{Footfall, Footfalls};
use crate::kinematics::Trajectory;
use crate::model::anatomy::{Sole, SolePoint};
use crate::model::{BySide, CoordinateKind, Drive, Model};
use crate::motion::{Motion, TimeGrid};
use crate::numerics::BandMatrix;
use crate::spatial::{Pose, Vec3};
use std::f64::consts::TAU;

/// Standard deviation of the place of a loaded point of a sole [m].
const STILL_M: f64 = 0.005;
/// Usual error of a fitted angle [rad] and of a displacement [m].
const TURN: f64 = 0.035;
const SHIFT_M: f64 = 0.01;
/// Rate at which errors of fitted coordinates change [rad/s]: once a second.
const CHANGING: f64 = TAU;
/// A point rests up to the first height above its lowest place in the stance, and not at all above the second [m].
const RESTING_M: [f64; 2] = [0.010, 0.025];
/// Time in which the weight of a point grows after the foot strike, and falls before the foot off [s].
const RAMP_S: f64 = 0.05;
/// Step of the numerical derivatives [rad or m].
const STEP: f64 = 1e-6;
/// Gauss-Newton steps.
const STEPS: usize = 2;

/// A motion whose loaded feet hardly slide.
#[derive(Debug, Clone, PartialEq)]
pub struct Refit {
    /// The changed motion.
    pub motion: Motion,
    /// Speed of resting points of the soles along the floor, root mean square before and after [m/s].
    pub sliding_m_s: [f64; 2],
    /// Largest change of an angle [rad].
    pub largest_turn_rad: f64,
    /// Largest change of a displacement [m].
    pub largest_shift_m: f64,
}

/// Changes a motion so that loaded feet do not slide. `trajectory` is the same motion, smoothed, with the stances
/// `falls`; `None` if no foot rests on the floor, or no recorded coordinate moves it.
#[must_use]
pub fn hold_loaded_feet(
    model: &Model,
    motion: &Motion,
    trajectory: &Trajectory,
    falls: &Footfalls,
    soles: &BySide<Option<Sole>>,
) -> Option<Refit> {
    let postures = postures(trajectory);
    let resting: Vec<RestingPoint> = falls
        .falls
        .iter()
        .filter_map(|fall| Some((fall, soles[fall.side].as_ref()?)))
        .flat_map(|(fall, sole)| sole.points.iter().map(move |point| (fall, *point)))
        .filter_map(|(fall, point)| RestingPoint::new(model, &postures, trajectory.grid(), fall, point))
        .collect();
    let changed = Changeable::new(model, motion, &postures, &resting);
    if resting.is_empty() || changed.ids.is_empty() {
        return None;
    }
    let moved = changed.held(model, &postures, &resting, trajectory.grid())?;
    let sliding_m_s = [&postures, &moved].map(|of| sliding(model, of, &resting, trajectory.grid()));
    let changes = |id: usize| moved.iter().zip(&postures).map(move |(new, old)| new[id] - old[id]);
    let largest = |is_shift: bool| {
        let kind = |id: &&usize| (model.coordinates()[**id].kind == CoordinateKind::Translation) == is_shift;
        let all = changed.ids.iter().filter(kind).flat_map(|id| changes(*id));
        all.fold(0.0, |most: f64, change| most.max(change.abs()))
    };
    let mut out = motion.clone();
    for id in &changed.ids {
        let series: Vec<f64> = changes(*id).collect();
        let column = out.columns[*id].iter_mut().flatten();
        column.zip(&motion.times).for_each(|(value, time)| *value += interpolated(&series, trajectory.grid(), *time));
    }
    Some(Refit { motion: out, sliding_m_s, largest_turn_rad: largest(false), largest_shift_m: largest(true) })
}

/// Coordinates of every frame.
fn postures(trajectory: &Trajectory) -> Vec<Vec<f64>> {
    let mut out = Vec::with_capacity(trajectory.grid().frames);
    trajectory.for_each_posture(|_, posture| out.push(posture.q.to_vec()));
    out
}

/// A point of a sole during one stance.
struct RestingPoint {
    point: SolePoint,
    /// First frame of the stance.
    first: usize,
    /// Weight in each frame of the stance.
    weights: Vec<f64>,
    /// Place on the floor at the time zero of the grid [m].
    place: Vec3,
    /// Velocity of the floor [m/s].
    velocity: Vec3,
    up: Vec3,
    grid: TimeGrid,
}

impl RestingPoint {
    /// `None` if it rests in no frame.
    fn new(
        model: &Model,
        postures: &[Vec<f64>],
        grid: TimeGrid,
        fall: &Footfall,
        point: SolePoint,
    ) -> Option<RestingPoint> {
        let up = -model.gravity().try_normalize(f64::MIN_POSITIVE)?;
        let [start, end] = [fall.strike_s.unwrap_or(f64::NEG_INFINITY), fall.off_s.unwrap_or(f64::INFINITY)];
        let inside = |frame: &usize| (start..=end).contains(&grid.time(*frame));
        let first = (0..grid.frames).find(inside)?;
        let end_frame = (first..grid.frames).find(|frame| !inside(frame)).unwrap_or(grid.frames);
        let paths: Vec<Vec3> =
            postures[first..end_frame].iter().map(|q| model.poses(q)[point.body.index()].place(point.place)).collect();
        let lowest = paths.iter().map(|p| p.dot(&up)).fold(f64::INFINITY, f64::min);
        let weight = |(k, p): (usize, &Vec3)| {
            let time = grid.time(first + k);
            let resting = smooth_step((RESTING_M[1] - (p.dot(&up) - lowest)) / (RESTING_M[1] - RESTING_M[0]));
            resting * smooth_step((time - start) / RAMP_S) * smooth_step((end - time) / RAMP_S)
        };
        let weights: Vec<f64> = paths.iter().enumerate().map(weight).collect();
        let whole: f64 = weights.iter().sum();
        let still = |k: usize| paths[k] - fall.floor_velocity * (grid.time(first + k) - grid.start_s);
        let place = (0..paths.len()).map(|k| still(k) * weights[k]).sum::<Vec3>() / whole;
        let velocity = fall.floor_velocity;
        (whole > 0.0).then_some(RestingPoint { point, first, weights, place, velocity, up, grid })
    }

    /// Weight of the point in a frame.
    fn weight(&self, frame: usize) -> f64 {
        frame.checked_sub(self.first).and_then(|k| self.weights.get(k)).copied().unwrap_or(0.0)
    }

    /// Horizontal distance from where it should rest in a frame, in a posture of the body [m].
    fn off(&self, poses: &[Pose], frame: usize) -> Vec3 {
        let target = self.place + self.velocity * (self.grid.time(frame) - self.grid.start_s);
        let off = poses[self.point.body.index()].place(self.point.place) - target;
        off - self.up * off.dot(&self.up)
    }
}

/// The recorded coordinates that move a sole, with their usual errors [rad or m].
struct Changeable {
    ids: Vec<usize>,
    errors: Vec<f64>,
}

impl Changeable {
    fn new(model: &Model, motion: &Motion, postures: &[Vec<f64>], resting: &[RestingPoint]) -> Changeable {
        let middle = &postures[postures.len() / 2];
        let poses = model.poses(middle);
        let moves_a_sole = |id: usize| {
            let moved = stepped(model, middle, id);
            resting.iter().any(|point| {
                let place = |poses: &[Pose]| poses[point.point.body.index()].place(point.point.place);
                (place(&moved) - place(&poses)).norm() > 1e-3 * STEP
            })
        };
        let is_recorded = |id: &usize| motion.columns[*id].is_some();
        let is_free = |id: &usize| matches!(model.coordinates()[*id].drive, Drive::Free);
        let ids: Vec<usize> =
            (0..middle.len()).filter(is_recorded).filter(is_free).filter(|id| moves_a_sole(*id)).collect();
        let error = |id: &usize| match model.coordinates()[*id].kind {
            CoordinateKind::Translation => SHIFT_M,
            _ => TURN,
        };
        Changeable { errors: ids.iter().map(error).collect(), ids }
    }

    /// The coordinates of all frames with resting points held; `None` without a finite solution.
    fn held(
        &self,
        model: &Model,
        postures: &[Vec<f64>],
        resting: &[RestingPoint],
        grid: TimeGrid,
    ) -> Option<Vec<Vec<f64>>> {
        let (count, frames) = (self.ids.len(), postures.len());
        let mut out = postures.to_vec();
        let mut change = vec![0.0; count * frames];
        for _ in 0..STEPS {
            let mut matrix = self.near_and_slow(frames, grid);
            let mut right = vec![0.0; count * frames];
            for (frame, q) in out.iter().enumerate() {
                let points: Vec<&RestingPoint> = resting.iter().filter(|point| point.weight(frame) > 0.0).collect();
                if points.is_empty() {
                    continue;
                }
                let own = frame * count..(frame + 1) * count;
                let poses = model.poses(q);
                let moved: Vec<Vec<Pose>> = self.ids.iter().map(|id| stepped(model, q, *id)).collect();
                for point in points {
                    let weight = point.weight(frame) / STILL_M.powi(2);
                    let off = point.off(&poses, frame);
                    let slopes: Vec<Vec3> = moved.iter().map(|poses| (point.off(poses, frame) - off) / STEP).collect();
                    let reached: Vec3 = slopes.iter().zip(&change[own.clone()]).map(|(slope, x)| slope * *x).sum();
                    for (i, a) in slopes.iter().enumerate() {
                        right[own.start + i] += weight * a.dot(&(reached - off));
                        let lower = slopes[..=i].iter().enumerate();
                        lower.for_each(|(j, b)| matrix.add(own.start + i, own.start + j, weight * a.dot(b)));
                    }
                }
            }
            matrix.factor()?.solve(&mut right);
            change = right;
            for (frame, (new, old)) in out.iter_mut().zip(postures).enumerate() {
                let own = self.ids.iter().zip(&change[frame * count..]);
                own.for_each(|(id, change)| new[*id] = old[*id] + change);
            }
        }
        out.iter().flatten().all(|x| x.is_finite()).then_some(out)
    }

    /// The matrix of the two sums over coordinates.
    fn near_and_slow(&self, frames: usize, grid: TimeGrid) -> BandMatrix {
        let count = self.ids.len();
        let mut matrix = BandMatrix::zeros(count * frames, 2 * count);
        for (i, error) in self.errors.iter().enumerate() {
            let near = error.powi(-2);
            let slow = (CHANGING * grid.step_s).powi(-4) * near;
            for frame in 0..frames {
                matrix.add(frame * count + i, frame * count + i, near);
            }
            // Second differences 1, -2, 1.
            for first in 0..frames.saturating_sub(2) {
                let rows = [0, 1, 2].map(|k| (first + k) * count + i);
                for (a, of_a) in rows.into_iter().zip([1.0, -2.0, 1.0]) {
                    for (b, of_b) in rows.into_iter().zip([1.0, -2.0, 1.0]).filter(|(b, _)| *b <= a) {
                        matrix.add(a, b, slow * of_a * of_b);
                    }
                }
            }
        }
        matrix
    }
}

/// Poses with one coordinate moved by [`STEP`].
fn stepped(model: &Model, q: &[f64], id: usize) -> Vec<Pose> {
    let mut moved = q.to_vec();
    moved[id] += STEP;
    model.poses(&moved)
}

/// Speed along the floor of resting points, root mean square [m/s].
fn sliding(model: &Model, postures: &[Vec<f64>], resting: &[RestingPoint], grid: TimeGrid) -> f64 {
    let mut before: Option<Vec<Pose>> = None;
    let [mut squares, mut whole] = [0.0; 2];
    for (frame, q) in postures.iter().enumerate() {
        let poses = model.poses(q);
        if let Some(before) = &before {
            for point in resting {
                let weight = point.weight(frame - 1).min(point.weight(frame));
                let speed = (point.off(&poses, frame) - point.off(before, frame - 1)).norm() / grid.step_s;
                squares += weight * speed.powi(2);
                whole += weight;
            }
        }
        before = Some(poses);
    }
    if whole > 0.0 { (squares / whole).sqrt() } else { 0.0 }
}

/// 0 below 0, 1 above 1, smooth between.
fn smooth_step(x: f64) -> f64 {
    let x = x.clamp(0.0, 1.0);
    x * x * (3.0 - 2.0 * x)
}

/// A series of a grid at any time, linear between frames and zero outside.
fn interpolated(series: &[f64], grid: TimeGrid, time: f64) -> f64 {
    let place = (time - grid.start_s) / grid.step_s;
    let last = series.len() - 1;
    if !(-0.5..=last as f64 + 0.5).contains(&place) {
        return 0.0;
    }
    let place = place.clamp(0.0, last as f64);
    let k = (place as usize).min(last.saturating_sub(1));
    let next = series[(k + 1).min(last)];
    series[k] + (next - series[k]) * (place - k as f64)
}
