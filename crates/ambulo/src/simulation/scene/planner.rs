//! Plans and controllers of figures in a scene: walks without outside forces, and who follows them by torques.

use super::built_entry::{FigureWalkMode, WalkEntry};
use super::sources::{InputFiles, PlannedWalk, chain};
use super::{Place, SceneError};
use crate::gait::{Gait, PaceChange, Speed, Walk};
use crate::model::anthropometry::Build;
use crate::optimal::OptimalWalk;
use crate::simulation::consistent_walk::{ConsistentWalkSettings, make_consistent_walk};
use crate::simulation::control::{ControlSettings, WalkController};

/// Largest difference of speed between two plans of one controller [m/s].
const PLANS_APART: f64 = 0.1;
/// Duration of a change of speed without one of its own [s].
const CHANGE_S: f64 = 2.0;

/// A controller whose speed follows a schedule.
#[derive(Debug, Clone)]
pub(super) struct ScheduledController {
    pub(super) controller: WalkController,
    changes: Vec<SpeedChange>,
}

/// A change of speed at a constant rate.
#[derive(Debug, Clone, Copy)]
struct SpeedChange {
    start_s: f64,
    duration_s: f64,
    /// [m/s].
    from: f64,
    to: f64,
}

impl ScheduledController {
    /// Sets the speed of a time [s].
    pub(super) fn keep_schedule(&mut self, time_s: f64) {
        let Some(change) = self.changes.iter().rev().find(|change| time_s >= change.start_s) else { return };
        let share = ((time_s - change.start_s) / change.duration_s).clamp(0.0, 1.0);
        let speed = change.from + share * (change.to - change.from);
        // All speeds of the schedule lie between those of the plans.
        let _within = self.controller.set_speed(speed);
    }
}

/// Plans walks of a figure.
pub(super) struct Planner<'a> {
    pub(super) entry: &'a WalkEntry,
    pub(super) build: &'a Build,
    /// The gait at its own speed, without the changes of the scene.
    pub(super) gait: &'a Gait,
}

impl Planner<'_> {
    /// The plan at a speed [m/s], or at the gait's own.
    pub(super) fn plan<'s>(
        &self,
        speed: Option<f64>,
        sources: &'s mut InputFiles<'_, '_>,
    ) -> Result<&'s PlannedWalk, SceneError> {
        let number = match sources.planned.iter().position(|known| known.is_of(self.build, self.entry, speed)) {
            Some(number) => number,
            None => {
                let made = self.made(speed, sources)?;
                sources.planned.push(made);
                sources.planned.len() - 1
            }
        };
        Ok(&sources.planned[number])
    }

    fn made(&self, speed: Option<f64>, sources: &mut InputFiles<'_, '_>) -> Result<PlannedWalk, SceneError> {
        let place = &self.entry.place;
        let wrong = |e: &dyn std::error::Error| place.error(chain(e));
        let mut gait = self.gait.clone();
        if let Some(speed) = speed {
            gait.pace.speed = Some(Speed::MetersPerSecond(speed));
        }
        let human = self.build.human().map_err(|e| wrong(&e))?;
        let walk = Walk::new(&gait, human.dimensions.leg_length, sources.findings).map_err(|e| wrong(&e))?;
        let entry = WalkEntry { speed, ..self.entry.clone() };
        if self.entry.mode == FigureWalkMode::Optimal {
            if !(walk.is_symmetric() && walk.gait().follows_people() && self.build.toe_joint) {
                let found = format!("found the gait `{}` in the mode `optimal`", gait.name);
                return Err(place.error(
                    found + "; expected curves of people, the same on both sides, and a figure with toe joints",
                ));
            }
            let found = OptimalWalk::find_lifted(self.build, &walk, entry.lift).map_err(|e| wrong(&e))?;
            return Ok(PlannedWalk { build: *self.build, entry, human: found.figure(), solution: found.solution });
        }
        let mut settings = ConsistentWalkSettings::default();
        settings.costs.lift = entry.lift;
        let walk = make_consistent_walk(&human, &walk, &settings).map_err(|e| wrong(&e))?;
        Ok(PlannedWalk { build: *self.build, entry, human, solution: walk.solution().clone() })
    }

    /// The controller of a figure that walks by its own torques, through all changes of its speed.
    pub(super) fn controller(
        &self,
        place: &Place,
        settings: &ControlSettings,
        sources: &mut InputFiles<'_, '_>,
    ) -> Result<ScheduledController, SceneError> {
        if !(self.gait.pace_changes.is_empty() && self.gait.machines.is_empty()) {
            let found = format!("found the gait `{}` with machines or changes of pace of its own", self.gait.name);
            return Err(place.error(found + "; expected one pace. hint: changes of speed can be given by the scene"));
        }
        let first = self.plan(self.entry.speed, sources)?.solution.speed();
        let changes = self.schedule(first)?;
        let ends = changes.iter().fold([first; 2], |[low, high], change| [low.min(change.to), high.max(change.to)]);
        let count = ((ends[1] - ends[0]) / PLANS_APART).ceil();
        let between = (0..=count as usize).map(|k| ends[0] + (ends[1] - ends[0]) * k as f64 / count.max(1.0));
        let steps = sources.steps;
        let mut all = Vec::new();
        let speeds = if changes.is_empty() { vec![self.entry.speed] } else { between.map(Some).collect() };
        for speed in speeds {
            let plan = self.plan(speed, sources)?;
            let one = WalkController::new(&plan.human, &plan.solution, steps, settings);
            all.push(one.map_err(|e| place.error(chain(&e)))?);
        }
        let mut controller = WalkController::joined(&all).map_err(|e| place.error(chain(&e)))?;
        controller.set_speed(first).map_err(|e| place.error(chain(&e)))?;
        Ok(ScheduledController { controller: controller.starting_at(self.entry.phase), changes })
    }

    fn schedule(&self, first: f64) -> Result<Vec<SpeedChange>, SceneError> {
        let (mut from, mut all) = (first, Vec::new());
        for PaceChange { start_s, duration_s, speed, step_length, step_frequency } in &self.entry.changes {
            let (Some(to), None, None) = (speed.filter(|speed| *speed > 0.0), step_length, step_frequency) else {
                let found = "found a change of step length or frequency, or to standing";
                return Err(self.entry.place.error(format!(
                    "{found}; expected changes of `speed` above zero, which is what a controller can follow"
                )));
            };
            all.push(SpeedChange { start_s: *start_s, duration_s: duration_s.unwrap_or(CHANGE_S), from, to });
            from = to;
        }
        Ok(all)
    }
}
