//! Ground forces from force plates or other sensors, resampled to the frames of a trajectory.
//!
//! The wrench of each sensor is first expressed about the world's origin, M₀ = p × F + T. There it can be filtered,
//! interpolated and added to wrenches of other sensors; a centre of pressure cannot (it jumps, and is undefined without
//! load). The centre of pressure and the free moment are computed at the end, with u the upward unit vector and h the
//! height of the surface of the plate:
//!
//!   p = (u × M₀ + h F) / (u · F)            free moment = u · (M₀ - p × F)
//!
//! from M₀ = p × F + u T and p · u = h, as u × (p × F) = p (u · F) - F (u · p).
//!
//! | code             | symbol | unit | meaning                                  |
//! | `force`          | F      | N    | of the ground on the body, world axes    |
//! | `moment`         | M₀     | N.m  | about the world's origin                 |
//! | `center`         | p      | m    | centre of pressure, on the surface       |
//!
//! Source: force-plate statics; derived above.
//! Pinned by: tests/ground_measured.rs, tests/opensim_parity.rs

use super::phases::contacts_from_force;
use crate::dynamics::LoadSeries;
use crate::findings::{Code, Findings};
use crate::kinematics::{Trajectory, each_body_motion};
use crate::model::{BodyId, Model, Side};
use crate::motion::filter::{LowPass, low_pass_each};
use crate::motion::gaps::rows_around;
use crate::motion::{Between, ForceRecording, MotionError, TimeGrid, Window, interpolate};
use crate::numerics::median;
use crate::spatial::{Pose, Vec3, Wrench};
use std::borrow::Cow;
use std::ops::Range;
use std::sync::Arc;

/// Below this vertical force the centre of pressure is undefined and a foot counts as unloaded [N].
pub const CENTER_OF_PRESSURE_LOAD_N: f64 = crate::motion::force_plate::CENTER_OF_PRESSURE_LOAD_N;

/// Ground reaction force on one body over a trajectory, with its centre of pressure.
#[derive(Debug, Clone, PartialEq)]
pub struct BodyForces {
    /// The body that the ground acts on.
    pub body: BodyId,
    /// Force [N], one entry per frame.
    pub force: Vec<Vec3>,
    /// Moment about the world's origin [N.m], one entry per frame.
    pub moment: Vec<Vec3>,
    /// Centre of pressure [m]; not a number below [`CENTER_OF_PRESSURE_LOAD_N`].
    pub center_of_pressure: Vec<Vec3>,
    /// Moment about the vertical through the centre of pressure [N.m]; not a number below the threshold.
    pub free_moment: Vec<Vec3>,
    /// Height above the world's origin of the surface under the body [m], one entry per frame.
    surface_height: Vec<f64>,
}

/// Ground reaction forces by body: measured, simulated or predicted. A clone shares their memory.
#[derive(Debug, Clone, PartialEq)]
pub struct GroundForces {
    /// One entry per body in contact.
    pub bodies: Arc<[BodyForces]>,
}

impl BodyForces {
    /// The forces when time runs from the end to the beginning.
    pub(super) fn played_back(mut self) -> BodyForces {
        self.force.reverse();
        self.moment.reverse();
        self.center_of_pressure.reverse();
        self.free_moment.reverse();
        self.surface_height.reverse();
        self
    }
}

impl GroundForces {
    /// The loads for [`crate::dynamics::inverse`].
    #[must_use]
    pub fn loads(&self) -> Vec<LoadSeries> {
        self.bodies.iter().map(BodyForces::load).collect()
    }
}

/// Ground reaction force on each foot: the sum over the bodies of that side, assigned to the most loaded one. A single
/// body is borrowed.
#[must_use]
pub fn feet<'a>(model: &Model, ground: &'a GroundForces) -> Vec<(Side, Cow<'a, BodyForces>)> {
    let up = model.up();
    let side_of = |b: &BodyForces| model.anatomy().body_side(b.body);
    let sum = |side: Side| {
        let bodies: Vec<&BodyForces> = ground.bodies.iter().filter(|b| side_of(b) == Some(side)).collect();
        if let [only] = bodies[..] {
            return Some((side, Cow::Borrowed(only)));
        }
        let carried = |b: &&&BodyForces| b.force.iter().map(Vec3::norm).sum::<f64>();
        let body = bodies.iter().max_by(|a, b| carried(a).total_cmp(&carried(b)))?.body;
        let parts = bodies.iter().map(|b| (b.force.as_slice(), b.moment.as_slice(), b.surface_height.as_slice()));
        Some((side, Cow::Owned(combine(body, &parts.collect::<Vec<_>>(), up))))
    };
    Side::BOTH.into_iter().filter_map(sum).collect()
}

impl BodyForces {
    /// Computes centres of pressure from forces and moments about the world's origin, one entry per frame. The ground
    /// is at `surface_height` along `up` [m]. Series of different length are cut to the shortest.
    #[must_use]
    pub fn on_level_ground(body: BodyId, force: &[Vec3], moment: &[Vec3], up: Vec3, surface_height: f64) -> BodyForces {
        BodyForces::on_ground(body, force, moment, up, &vec![surface_height; force.len()])
    }

    /// As [`BodyForces::on_level_ground`], for ground whose height changes from frame to frame, as on stairs [m].
    #[must_use]
    pub fn on_ground(body: BodyId, force: &[Vec3], moment: &[Vec3], up: Vec3, surface_height: &[f64]) -> BodyForces {
        let frames = force.len().min(moment.len()).min(surface_height.len());
        combine(body, &[(&force[..frames], &moment[..frames], &surface_height[..frames])], up)
    }

    /// A range of the frames.
    #[must_use]
    pub(crate) fn within(&self, frames: Range<usize>) -> BodyForces {
        BodyForces {
            body: self.body,
            force: self.force[frames.clone()].to_vec(),
            moment: self.moment[frames.clone()].to_vec(),
            center_of_pressure: self.center_of_pressure[frames.clone()].to_vec(),
            free_moment: self.free_moment[frames.clone()].to_vec(),
            surface_height: self.surface_height[frames].to_vec(),
        }
    }

    /// The sum of loads on the body of the first one, each times its weight in every frame.
    #[must_use]
    pub(crate) fn weighted_sum(parts: &[(&BodyForces, &[f64])], up: Vec3) -> BodyForces {
        let scaled = |values: &[Vec3], weights: &[f64]| -> Vec<Vec3> {
            values.iter().zip(weights).map(|(value, weight)| value * *weight).collect()
        };
        let wrenches: Vec<[Vec<Vec3>; 2]> =
            parts.iter().map(|(part, weights)| [&part.force, &part.moment].map(|of| scaled(of, weights))).collect();
        let sensors: Vec<SensorWrench<'_>> = wrenches
            .iter()
            .zip(parts)
            .map(|([force, moment], (part, _))| (force.as_slice(), moment.as_slice(), part.surface_height.as_slice()))
            .collect();
        combine(parts[0].0.body, &sensors, up)
    }

    fn load(&self) -> LoadSeries {
        let wrench = |(force, moment): (&Vec3, &Vec3)| Wrench { moment: *moment, force: *force };
        LoadSeries {
            body: self.body,
            points: vec![Vec3::zeros(); self.force.len()],
            wrenches: self.force.iter().zip(&self.moment).map(wrench).collect(),
        }
    }
}

/// The wrench of one sensor at the frames of the trajectory.
struct Series {
    body: BodyId,
    /// Force [N].
    force: Vec<Vec3>,
    /// Moment about the world's origin [N.m].
    moment: Vec<Vec3>,
    /// Height of its surface [m].
    surface_height: Vec<f64>,
}

/// Filters the recordings, resamples them to the frames of the trajectory and adds those that act on the same body.
///
/// Samples below the threshold without a point of application (not a number) count as unloaded.
///
/// # Errors
/// A force that is not a number under load, or a cut-off frequency that the sensor's rate does not allow.
pub fn measured(
    model: &Model,
    trajectory: &Trajectory,
    recordings: &[ForceRecording],
    filter: Option<LowPass>,
    findings: &mut Findings,
) -> Result<GroundForces, MotionError> {
    let up = model.up();
    let mut series = Vec::new();
    for recording in recordings {
        let recording = in_world(model, trajectory, &usable(recording, trajectory.grid()));
        series.push(resampled(&recording, trajectory.grid(), filter, up, findings)?);
    }
    let mut bodies: Vec<BodyForces> = Vec::new();
    for body in model.body_ids() {
        let of_body = series.iter().filter(|s| s.body == body);
        let parts: Vec<SensorWrench<'_>> =
            of_body.map(|s| (s.force.as_slice(), s.moment.as_slice(), s.surface_height.as_slice())).collect();
        if !parts.is_empty() {
            bodies.push(combine(body, &parts, up));
        }
    }
    Ok(GroundForces { bodies: bodies.into() })
}

/// The part of the recording around the trajectory that has no gap.
fn usable(recording: &ForceRecording, grid: TimeGrid) -> ForceRecording {
    let window = Window { from_s: Some(grid.start_s), to_s: Some(grid.end_s()) };
    let complete = |row: usize| {
        let (force, moment) = (recording.force[row], recording.moment[row]);
        is_finite(force)
            && (is_finite(recording.point[row].cross(&force) + moment) || force.norm() <= CENTER_OF_PRESSURE_LOAD_N)
    };
    let rows = rows_around(&recording.times, window, complete);
    let mut out = recording.clone();
    out.times = recording.times[rows.clone()].to_vec();
    for (cut, whole) in
        [(&mut out.force, &recording.force), (&mut out.point, &recording.point), (&mut out.moment, &recording.moment)]
    {
        *cut = whole[rows.clone()].to_vec();
    }
    out
}

/// Transforms force, moment and point to the world's axes.
fn in_world(model: &Model, trajectory: &Trajectory, recording: &ForceRecording) -> ForceRecording {
    let mut out = recording.clone();
    if recording.force_frame.is_none() && recording.point_frame.is_none() {
        return out;
    }
    let frames = trajectory.grid();
    let times = frames.times();
    let nearest = |t: f64| times.partition_point(|x| x + 0.5 * frames.step_s <= t).min(times.len() - 1);
    let poses = body_poses(model, trajectory);
    let pose = |body: Option<BodyId>, t: f64| body.map_or(Pose::IDENTITY, |b| poses[nearest(t)][b.index()]);
    for (i, &t) in recording.times.iter().enumerate() {
        let turn = pose(recording.force_frame, t).rotation;
        out.force[i] = turn * recording.force[i];
        out.moment[i] = turn * recording.moment[i];
        out.point[i] = pose(recording.point_frame, t).place(recording.point[i]);
    }
    out
}

fn body_poses(model: &Model, trajectory: &Trajectory) -> Vec<Vec<Pose>> {
    let mut poses = Vec::with_capacity(trajectory.grid().frames);
    each_body_motion(model, trajectory, |_, bodies| poses.push(bodies.iter().map(|b| b.pose).collect()));
    poses
}

/// The total of measured forces, filtered, at any time.
pub(crate) struct TotalLoad {
    /// Times [s] of each sensor, with force [N] and moment about the world's origin [N.m].
    sensors: Vec<(Vec<f64>, [Vec<f64>; 6])>,
}

impl TotalLoad {
    /// The total of the recordings around a trajectory; `None` if one of them cannot be used.
    pub(crate) fn new(
        model: &Model,
        trajectory: &Trajectory,
        recordings: &[ForceRecording],
        filter: Option<LowPass>,
    ) -> Option<TotalLoad> {
        let sensor = |recording: &ForceRecording| {
            let recording = in_world(model, trajectory, &usable(recording, trajectory.grid()));
            let mut columns = about_origin(&recording, &mut Findings::default()).ok()?;
            if let Some(filter) = filter {
                low_pass_all(&recording, &mut columns, filter).ok()?;
            }
            Some((recording.times, columns))
        };
        Some(TotalLoad { sensors: recordings.iter().map(sensor).collect::<Option<_>>()? })
    }

    /// The time that every sensor recorded [s].
    pub(crate) fn covers(&self) -> Option<[f64; 2]> {
        let ends = self.sensors.iter().map(|(times, _)| Some([*times.first()?, *times.last()?]));
        let common = |[a, b]: [f64; 2], [c, d]: [f64; 2]| [a.max(c), b.min(d)];
        ends.reduce(|all, own| Some(common(all?, own?)))?
    }

    /// Force [N] and moment about the world's origin [N.m].
    pub(crate) fn at(&self, time_s: f64) -> Wrench {
        let mut total = Wrench::ZERO;
        for (times, columns) in &self.sensors {
            let place = Between::of(times, time_s);
            let value = |k: usize| place.value(&columns[k]);
            let vector = |k: usize| Vec3::new(value(k), value(k + 1), value(k + 2));
            total = Wrench { force: total.force + vector(0), moment: total.moment + vector(3) };
        }
        total
    }
}

fn resampled(
    recording: &ForceRecording,
    grid: TimeGrid,
    filter: Option<LowPass>,
    up: Vec3,
    findings: &mut Findings,
) -> Result<Series, MotionError> {
    let mut columns = about_origin(recording, findings)?;
    if let Some(filter) = filter {
        low_pass_all(recording, &mut columns, filter)?;
    }
    let covered = covered(recording, grid);
    let place = |i: usize| covered(i).then(|| Between::of(&recording.times, grid.time(i)));
    let places: Vec<Option<Between>> = (0..grid.frames).map(place).collect();
    for column in &mut columns {
        *column = places.iter().map(|place| place.map_or(0.0, |place| place.value(column))).collect();
    }
    let vector =
        |k: usize| (0..grid.frames).map(|i| Vec3::new(columns[k][i], columns[k + 1][i], columns[k + 2][i])).collect();
    let surface = Surface::of(recording, up);
    let surface_height = (0..grid.frames).map(|i| surface.height(grid.time(i))).collect();
    Ok(Series { body: recording.body, force: vector(0), moment: vector(3), surface_height })
}

/// Whether a frame lies inside the recording, within one sample.
fn covered(recording: &ForceRecording, grid: TimeGrid) -> impl Fn(usize) -> bool + use<> {
    let step_s = TimeGrid::spanning(&recording.times).map_or(0.0, |own| own.step_s);
    let from_s = recording.times.first().map_or(f64::INFINITY, |t| t - step_s);
    let to_s = recording.times.last().map_or(f64::NEG_INFINITY, |t| t + step_s);
    move |frame: usize| (from_s..=to_s).contains(&grid.time(frame))
}

/// F and M₀ = p × F + T, as six columns.
fn about_origin(recording: &ForceRecording, findings: &mut Findings) -> Result<[Vec<f64>; 6], MotionError> {
    let mut columns: [Vec<f64>; 6] = std::array::from_fn(|_| Vec::with_capacity(recording.times.len()));
    for (i, &time) in recording.times.iter().enumerate() {
        let (mut force, point, mut torque) = (recording.force[i], recording.point[i], recording.moment[i]);
        let mut moment = point.cross(&force) + torque;
        if !is_finite(moment) && is_finite(force) && force.norm() <= CENTER_OF_PRESSURE_LOAD_N {
            (force, torque, moment) = (Vec3::zeros(), Vec3::zeros(), Vec3::zeros());
            let message = format!(
                "the load `{}` has no point of application while it is unloaded; read as no load",
                recording.name
            );
            findings.report(Code::LoadsPointUndefined, message);
        }
        if !is_finite(force) || !is_finite(moment) || !is_finite(torque) {
            return Err(MotionError::Gap { column: recording.name.clone(), from_s: time, to_s: time, longest_s: 0.0 });
        }
        for (column, x) in columns.iter_mut().zip(force.iter().chain(moment.iter())) {
            column.push(*x);
        }
    }
    Ok(columns)
}

fn is_finite(v: Vec3) -> bool {
    v.iter().all(|x| x.is_finite())
}

fn low_pass_all(recording: &ForceRecording, columns: &mut [Vec<f64>; 6], filter: LowPass) -> Result<(), MotionError> {
    let uniform = TimeGrid::through(&recording.times);
    let Some(grid) = uniform.or_else(|| TimeGrid::spanning(&recording.times)) else { return Ok(()) };
    if uniform.is_none() {
        for column in columns.iter_mut() {
            *column = (0..grid.frames).map(|i| interpolate(&recording.times, column, grid.time(i))).collect();
        }
    }
    let filtered = low_pass_each(columns, grid.rate_hz(), filter)
        .map_err(|(_, source)| MotionError::Filter { column: recording.name.clone(), source })?;
    let times = if uniform.is_none() { grid.times() } else { Vec::new() };
    for (column, filtered) in columns.iter_mut().zip(filtered) {
        *column = match uniform {
            Some(_) => filtered,
            None => recording.times.iter().map(|&t| interpolate(&times, &filtered, t)).collect(),
        };
    }
    Ok(())
}

/// Height of the surface under a load, which changes from contact to contact if one load carries feet on several steps
/// of stairs.
pub(super) struct Surface {
    /// Loaded times with their heights, in order of time.
    contacts: Vec<([f64; 2], f64)>,
}

impl Surface {
    pub(super) fn of(recording: &ForceRecording, up: Vec3) -> Surface {
        let ForceRecording { times, force, point, .. } = recording;
        let vertical: Vec<f64> = force.iter().map(|force| force.dot(&up)).collect();
        let height_over = |[from, to]: [f64; 2]| {
            let samples = times.partition_point(|t| *t < from)..times.partition_point(|t| *t <= to);
            let loaded = samples.filter(|i| vertical[*i] > CENTER_OF_PRESSURE_LOAD_N);
            median(loaded.map(|i| point[i].dot(&up)))
        };
        let ends = [times.first(), times.last()].map(|t| t.copied().unwrap_or(0.0));
        let spans = contacts_from_force(times, &vertical).into_iter().map(|contact| contact.span(ends[0], ends[1]));
        let contacts: Vec<_> = spans.filter_map(|span| Some((span, height_over(span)?))).collect();
        match contacts.is_empty() {
            true => Surface { contacts: height_over(ends).map(|height| (ends, height)).into_iter().collect() },
            false => Surface { contacts },
        }
    }

    /// Height above the world's origin at the contact that is nearest in time [m].
    pub(super) fn height(&self, t: f64) -> f64 {
        let next = self.contacts.partition_point(|([_, to], _)| *to < t);
        let around = [next.checked_sub(1), Some(next)].into_iter().flatten().filter_map(|i| self.contacts.get(i));
        let apart = |([from, to], _): &&([f64; 2], f64)| (from - t).max(t - to).max(0.0);
        around.min_by(|a, b| apart(a).total_cmp(&apart(b))).map_or(0.0, |(_, height)| *height)
    }
}

/// Force, moment about the origin and surface height of one sensor, one entry per frame each.
type SensorWrench<'a> = (&'a [Vec3], &'a [Vec3], &'a [f64]);

/// Adds the wrenches of several sensors on one body.
fn combine(body: BodyId, parts: &[SensorWrench<'_>], up: Vec3) -> BodyForces {
    let frames = parts.first().map_or(0, |(force, _, _)| force.len());
    let mut out = BodyForces {
        body,
        force: Vec::with_capacity(frames),
        moment: Vec::with_capacity(frames),
        center_of_pressure: Vec::with_capacity(frames),
        free_moment: Vec::with_capacity(frames),
        surface_height: Vec::with_capacity(frames),
    };
    for i in 0..frames {
        let force: Vec3 = parts.iter().map(|(force, _, _)| force[i]).sum();
        let moment: Vec3 = parts.iter().map(|(_, moment, _)| moment[i]).sum();
        // A foot on several surfaces takes the height of the most loaded one.
        let most_loaded = parts.iter().max_by(|a, b| a.0[i].dot(&up).total_cmp(&b.0[i].dot(&up)));
        let height = most_loaded.map_or(0.0, |(_, _, height)| height[i]);
        let (center, free_moment) = center_of_pressure(force, moment, up, height);
        out.force.push(force);
        out.moment.push(moment);
        out.center_of_pressure.push(center);
        out.free_moment.push(free_moment);
        out.surface_height.push(height);
    }
    out
}

/// Centre of pressure [m] and free moment [N.m] of a wrench about the origin; not a number below the threshold.
pub(crate) fn center_of_pressure(force: Vec3, moment: Vec3, up: Vec3, height: f64) -> (Vec3, Vec3) {
    let vertical = force.dot(&up);
    if vertical < CENTER_OF_PRESSURE_LOAD_N {
        return (Vec3::repeat(f64::NAN), Vec3::repeat(f64::NAN));
    }
    let center = (up.cross(&moment) + force * height) / vertical;
    (center, up * up.dot(&(moment - center.cross(&force))))
}
