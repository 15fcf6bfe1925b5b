//! Steps a walker through time and records its motion and forces.

use super::feet::FootRecord;
use super::figure::{Placed, Walker, WalkingError};
use super::recording::{FootImpact, WalkRecording};
use super::signals::GaitTargets;
use super::torques::TorqueSeries;
use crate::engine::signal::Instant;
use crate::engine::{Impact, Integrator, Owner, Signal, StepSettings, StepWorkspace, World, WorldState, step};
use crate::findings::Findings;
use crate::kinematics::Trajectory;
use crate::model::{BodyId, BySide, Side};
use crate::motion::TimeGrid;
use crate::spatial::{Pose, Twist, Vec3};

/// Largest number of steps, because of memory: a step takes about 2 kB, with the results that are made from it.
const MOST_STEPS: usize = 1_200_000;

/// Torques without feedback that take the place of drives.
#[derive(Debug, Clone, Copy)]
pub struct Release<'a> {
    /// The torques, by coordinate.
    pub torques: &'a [TorqueSeries],
    /// Time at which the drives of these coordinates and the support of the trunk end [s].
    pub time_s: f64,
}

/// Targets that are computed from step to step, and who looks at their machines after each step.
pub struct WatchedTargets<'a> {
    /// The targets.
    pub targets: &'a mut GaitTargets,
    /// Called after each step of the machines, before the figure moves.
    pub watch: &'a mut dyn FnMut(&GaitTargets),
}

/// A figure whose pelvis is lower than this share of its height at the release has fallen.
const FALLEN: f64 = 0.75;
/// Tilt of the trunk beyond which a figure has fallen [rad].
const FALLEN_TILT: f64 = std::f64::consts::FRAC_PI_3;
/// Duration of the recording after a fall [s].
const AFTER_FALL_S: f64 = 0.1;

/// A recording under way.
struct Recorder<'a> {
    walker: &'a Walker,
    columns: Vec<[Vec<f64>; 3]>,
    efforts: Vec<Vec<f64>>,
    feet: [FootRecord; 2],
    impacts: Vec<FootImpact>,
    unsolved: usize,
    /// Targets of this row that were computed from step to step.
    targets: Vec<[f64; 3]>,
    /// Coordinates that no drive moves any more; empty while all are driven.
    freed: Vec<bool>,
}

impl Walker {
    /// Walks for `duration_s`, with steps of impulses whatever the integrator of the settings.
    ///
    /// # Errors
    /// If the duration has no whole step or more than 1.2 million, or the motion is not finite.
    pub fn walk(
        &self,
        settings: &StepSettings,
        duration_s: f64,
        findings: &mut Findings,
    ) -> Result<WalkRecording, WalkingError> {
        self.walk_with(None, settings, duration_s, findings)
    }

    /// The same with targets that are computed from step to step: their machines read the loads on the feet in the step
    /// before.
    ///
    /// # Errors
    /// As [`Walker::walk`].
    pub fn walk_with(
        &self,
        mut machines: Option<WatchedTargets<'_>>,
        settings: &StepSettings,
        duration_s: f64,
        findings: &mut Findings,
    ) -> Result<WalkRecording, WalkingError> {
        let step_s = settings.step_s;
        let rows = rows_of(duration_s, step_s)?;
        let settings = StepSettings { integrator: Integrator::Impulse, ..*settings };
        let mut world = self.world.clone();
        let (mut state, mut w) = (self.state(&world, step_s), StepWorkspace::default());
        let mut recorder = Recorder::new(self, rows);
        for row in 0..rows {
            // Times are computed from the row, so that rounding does not accumulate.
            state.time_s = step_s * row as f64;
            let before = RootBefore::of(&world, &state);
            if let Some(WatchedTargets { targets, watch }) = &mut machines {
                recorder.read_targets(targets, state.time_s);
                // The posture at the end of this step, with angles and loads of the last one.
                targets.measure(|id| recorder.targets[id][0], |_| 0.0);
                match recorder.last_loads() {
                    Some(loaded) => targets.step_with(state.time_s + step_s, loaded),
                    None => targets.step(state.time_s + step_s),
                }
                watch(targets);
                self.aim(&mut world, targets, state.time_s + step_s);
            }
            let convergence = step(&world, &mut state, &settings, &mut w, findings)?;
            recorder.unsolved += usize::from(!convergence.converged);
            recorder.record(&before, &state, &w);
        }
        recorder.finish(TimeGrid { start_s: 0.0, step_s, frames: rows })
    }

    /// Walks until the drives end, then with torques that do not depend on the motion, until the figure falls or for
    /// `duration_s`. Gives the walk, driven and then free, and the time from the release to the fall [s]; `None` if the
    /// figure has not fallen at the end.
    ///
    /// # Errors
    /// As [`Walker::walk`], and torques of a coordinate that no drive moves.
    pub fn walk_released(
        &self,
        release: Release<'_>,
        settings: &StepSettings,
        duration_s: f64,
        findings: &mut Findings,
    ) -> Result<(WalkRecording, Option<f64>), WalkingError> {
        let settings = StepSettings { integrator: Integrator::Impulse, ..*settings };
        let step_s = settings.step_s;
        let rows = rows_of(duration_s, step_s)?;
        let free = self.freed(release.torques)?;
        let mut world = self.world.clone();
        let (mut state, mut w) = (WorldState::new(&world), StepWorkspace::default());
        let mut recorder = Recorder::new(self, rows);
        let (mut height, mut end, mut fell_after_s) = (None, rows, None);
        let mut row = 0;
        while row < end {
            state.time_s = step_s * row as f64;
            if state.time_s >= release.time_s - 0.5 * step_s {
                recorder.freed.clone_from(&free);
                let now = *height.get_or_insert(self.pelvis(&state)[0]);
                self.push(&mut world, release.torques, state.time_s);
                let [up, tilt] = self.pelvis(&state);
                if fell_after_s.is_none() && (up < FALLEN * now || tilt.abs() > FALLEN_TILT) {
                    fell_after_s = Some(state.time_s - release.time_s);
                    end = rows.min(row + (AFTER_FALL_S / step_s) as usize);
                }
            }
            let before = RootBefore::of(&world, &state);
            let values = recorder.free_values(&world, &state);
            let convergence = step(&world, &mut state, &settings, &mut w, findings)?;
            recorder.unsolved += usize::from(!convergence.converged);
            recorder.targets_of_free(&world, values, &state, step_s);
            recorder.record(&before, &state, &w);
            row += 1;
        }
        let recording = recorder.finish(TimeGrid { start_s: 0.0, step_s, frames: row })?;
        Ok((recording, fell_after_s))
    }

    /// The coordinates that are free after the release: those with torques, and the rotation of the root.
    fn freed(&self, torques: &[TorqueSeries]) -> Result<Vec<bool>, WalkingError> {
        let mut free: Vec<bool> =
            self.placed.iter().map(|placed| (placed.joint, placed.coordinate) == (0, 2)).collect();
        for series in torques {
            let id = self.model.coordinate(&series.coordinate).filter(|id| self.placed[id.index()].joint > 0);
            let id = id.ok_or_else(|| WalkingError::Torque {
                found: series.coordinate.clone(),
                expected: self.model.coordinates().iter().map(|own| own.name.as_str()).collect::<Vec<_>>().join(", "),
            })?;
            free[id.index()] = true;
        }
        Ok(free)
    }

    /// Height of the pelvis [m] and rotation of the trunk from the vertical [rad].
    fn pelvis(&self, state: &WorldState) -> [f64; 2] {
        let root = &state.coordinates[0];
        let tilt = root.get(2).copied().unwrap_or_default();
        [root.get(1).copied().unwrap_or_default().abs(), tilt]
    }

    /// Takes the drives of coordinates with torques and of the trunk away, and sets the torques of this instant.
    fn push(&self, world: &mut World, torques: &[TorqueSeries], time_s: f64) {
        if let Some(trunk) = world.joints[0].coordinates.get_mut(2) {
            trunk.drive = None;
        }
        for series in torques {
            let Some(id) = self.model.coordinate(&series.coordinate) else { continue };
            let placed = &self.placed[id.index()];
            let coordinate = &mut world.joints[placed.joint].coordinates[placed.coordinate];
            coordinate.drive = None;
            // A joint that nothing drives turns no further than its range.
            coordinate.limits = match (self.model.coordinates()[id.index()].range, placed.sense > 0.0) {
                (Some([low, high]), true) => (Some(low), Some(high)),
                (Some([low, high]), false) => (Some(-high), Some(-low)),
                (None, _) => (None, None),
            };
            coordinate.effort = placed.sense * series.at(time_s / series.cycle_s);
        }
    }

    /// Sets the motion of all drives near an instant [s].
    fn aim(&self, world: &mut World, targets: &GaitTargets, at_s: f64) {
        for (id, placed) in self.placed.iter().enumerate() {
            let coordinate = &mut world.joints[placed.joint].coordinates[placed.coordinate];
            if let Some(drive) = &mut coordinate.drive {
                drive.signal = Signal::Near(at_s, targets.at(id).map(|number| placed.sense * number));
            }
        }
    }

    fn friction(&self) -> f64 {
        self.world.materials.first().map_or(0.0, |material| material.friction)
    }
}

/// Number of whole steps.
fn rows_of(duration_s: f64, step_s: f64) -> Result<usize, WalkingError> {
    let rows = (duration_s / step_s + 1e-9).floor();
    if !(step_s > 0.0 && rows >= 1.0 && rows.is_finite()) {
        return Err(WalkingError::Duration { duration_s, step_s });
    }
    if rows > MOST_STEPS as f64 {
        return Err(WalkingError::TooLong { duration_s, step_s, most: MOST_STEPS });
    }
    Ok(rows as usize)
}

/// The state of the root before a step.
struct RootBefore {
    time_s: f64,
    pose: Pose,
    twist: Twist,
    slides: [f64; 2],
}

impl RootBefore {
    fn of(world: &World, state: &WorldState) -> RootBefore {
        let body = world.joints[0].child;
        let slides = [state.coordinates[0][0], state.coordinates[0][1]];
        RootBefore { time_s: state.time_s, pose: state.poses[body], twist: state.twists[body], slides }
    }
}

/// An impact in the coordinates of the model.
fn foot_impact(walker: &Walker, impact: &Impact) -> FootImpact {
    let mut impulses = [Vec3::zeros(); 2];
    for contact in &impact.contacts {
        if let Some(side) = walker.sides[contact.surfaces.0] {
            impulses[usize::from(side == Side::Left)] += contact.force;
        }
    }
    let effort = |placed: &Placed| placed.sense * impact.efforts[placed.joint][placed.coordinate];
    FootImpact { time_s: impact.time_s, impulses, efforts: walker.placed.iter().map(effort).collect() }
}

impl<'a> Recorder<'a> {
    fn new(walker: &'a Walker, rows: usize) -> Recorder<'a> {
        let count = walker.model.coordinates().len();
        let column = || Vec::with_capacity(rows);
        Recorder {
            walker,
            columns: (0..count).map(|_| [column(), column(), column()]).collect(),
            efforts: (0..count).map(|_| column()).collect(),
            feet: std::array::from_fn(|k| FootRecord::new(walker.feet[k], walker.toes[k], rows)),
            impacts: Vec::new(),
            unsolved: 0,
            targets: Vec::new(),
            freed: Vec::new(),
        }
    }

    /// Keeps the targets of a row; at the start they equal the signals.
    fn read_targets(&mut self, targets: &GaitTargets, time_s: f64) {
        let count = self.walker.signals.len();
        self.targets = match self.columns.is_empty() || self.feet[0].force.is_empty() {
            true => self.walker.signals.iter().map(|signal| signal.at(time_s)).collect(),
            false => (0..count).map(|id| targets.at(id)).collect(),
        };
    }

    /// Values and rates of the free coordinates before a step.
    fn free_values(&self, world: &World, state: &WorldState) -> Vec<Option<[f64; 2]>> {
        let of = |(free, placed): (&bool, &Placed)| {
            free.then(|| {
                let (joint, k) = (placed.joint, placed.coordinate);
                [state.coordinates[joint][k], state.rates(&world.joints[joint])[k]].map(|x| placed.sense * x)
            })
        };
        self.freed.iter().zip(&self.walker.placed).map(of).collect()
    }

    /// Sets the row of the free coordinates: values at the start of a step, velocities in its middle.
    fn targets_of_free(&mut self, world: &World, before: Vec<Option<[f64; 2]>>, after: &WorldState, step_s: f64) {
        self.targets.clear();
        let time_s = after.time_s - step_s;
        let after = self.free_values(world, after);
        for (id, (before, after)) in before.into_iter().zip(after).enumerate() {
            self.targets.push(match (before, after) {
                (Some([value, old]), Some([_, new])) => [value, 0.5 * (old + new), (new - old) / step_s],
                _ => self.walker.signals[id].at(time_s),
            });
        }
    }

    /// Which feet were loaded in the last row.
    fn last_loads(&self) -> Option<BySide<bool>> {
        let last = self.feet[0].force.len().checked_sub(1)?;
        Some(BySide::from([0, 1].map(|k| self.feet[k].loaded(last))))
    }

    fn record(&mut self, before: &RootBefore, after: &WorldState, w: &StepWorkspace) {
        for impact in w.impacts() {
            self.impacts.push(foot_impact(self.walker, impact));
        }
        self.record_root(before, after, w);
        let mut instant = Instant::new(before.time_s);
        let Recorder { walker, targets, columns, efforts, .. } = &mut *self;
        for (id, (columns, placed)) in columns.iter_mut().zip(&walker.placed).enumerate() {
            let effort = placed.sense * w.effort(placed.joint, placed.joint, placed.coordinate);
            efforts[id].push(effort);
            let driven = (placed.joint, placed.coordinate) != (0, 0) && (placed.joint, placed.coordinate) != (0, 1);
            if driven {
                let values = match targets.get(id) {
                    Some(values) => *values,
                    None => instant.at(&walker.signals[id]),
                };
                columns.iter_mut().zip(values).for_each(|(column, value)| column.push(value));
            }
        }
        self.record_feet(w);
    }

    /// Records the translations of the root; velocities belong to the middle of a step.
    fn record_root(&mut self, before: &RootBefore, after: &WorldState, w: &StepWorkspace) {
        let root = &self.walker.world.joints[0];
        let struck = (!w.impacts().is_empty()).then_some(&w.impacts.twists_after);
        let h = after.time_s - before.time_s;
        let to_joint = before.pose.rotation * root.child_from_joint.translation;
        let old = struck.map_or(before.twist, |twists| twists[root.child]).velocity_at(to_joint);
        let new = after.twists[root.child].velocity_at(to_joint);
        for (columns, placed) in self.columns.iter_mut().zip(&self.walker.placed) {
            let k = placed.coordinate;
            if placed.joint != 0 || k > 1 {
                continue;
            }
            columns[0].push(placed.sense * before.slides[k]);
            columns[1].push(placed.sense * 0.5 * (old[k] + new[k]));
            columns[2].push(placed.sense * (new[k] - old[k]) / h);
        }
    }

    fn record_feet(&mut self, w: &StepWorkspace) {
        let friction = self.walker.friction();
        self.feet.iter_mut().for_each(FootRecord::begin_row);
        for contact in w.contacts() {
            let Some(side) = self.walker.sides[contact.surfaces.0] else { continue };
            let Owner::Body(body) = self.walker.world.surfaces[contact.surfaces.0].owner else { continue };
            self.feet[usize::from(side == Side::Left)].add(&contact, BodyId(body), friction);
        }
        self.feet.iter_mut().for_each(FootRecord::end_row);
    }

    fn finish(self, grid: TimeGrid) -> Result<WalkRecording, WalkingError> {
        let model = self.walker.model.clone();
        let trajectory = Trajectory::new(&model, grid, self.columns)?;
        Ok(WalkRecording {
            model,
            trajectory,
            efforts: self.efforts,
            feet: self.feet,
            impacts: self.impacts,
            unsolved_steps: self.unsolved,
        })
    }
}
