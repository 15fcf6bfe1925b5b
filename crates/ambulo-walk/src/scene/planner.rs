//! Plans and controllers of figures in a scene: walks without external forces, and controllers that follow them by
//! torques.

use super::SceneError;
use super::built_entry::{ControlEntry, FigureWalkMode, WalkEntry};
use super::error_chain::chain;
use super::sources::{InputFiles, PlannedWalk};
use crate::consistent_walk::{ConsistentWalkSettings, make_consistent_walk};
use crate::control::{ControlSettings, ScheduledController, SpeedSchedule, TorqueCurves, WalkController};
use crate::gait::{Gait, PaceChange, Speed, Walk};
use crate::model::anthropometry::Build;
use crate::optimal::{OptimalWalk, StandingMovements};
use crate::walking::TorqueSeries;

/// Default duration of a change of speed [s].
const CHANGE_S: f64 = 2.0;

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
    ) -> Result<&'s mut PlannedWalk, SceneError> {
        let number = match sources.planned.iter().position(|known| known.is_of(self.build, self.entry, speed)) {
            Some(number) => number,
            None => {
                let made = self.made(speed, sources)?;
                sources.planned.push(made);
                sources.planned.len() - 1
            }
        };
        Ok(&mut sources.planned[number])
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
                    found + "; expected normative curves, the same on both sides, and a figure with toe joints",
                ));
            }
            let found =
                OptimalWalk::find_lifted(self.build, &walk, entry.lift, &sources.observer).map_err(|e| wrong(&e))?;
            let human = found.figure();
            return Ok(PlannedWalk { build: *self.build, entry, human, solution: found.solution, controller: None });
        }
        let observer = sources.observer.clone();
        let mut settings = ConsistentWalkSettings { observer, ..ConsistentWalkSettings::default() };
        settings.costs.lift = entry.lift;
        let walk = make_consistent_walk(&human, &walk, &settings).map_err(|e| wrong(&e))?;
        Ok(PlannedWalk { build: *self.build, entry, human, solution: walk.solution().clone(), controller: None })
    }

    /// The controller of a figure that walks by its own torques, through all changes of its speed.
    pub(super) fn controller(
        &self,
        control: &ControlEntry,
        sources: &mut InputFiles<'_, '_>,
    ) -> Result<ScheduledController, SceneError> {
        let place = &control.place;
        if !(self.gait.pace_changes.is_empty() && self.gait.machines.is_empty()) {
            let found = format!("found the gait `{}` with its own machines or changes of pace", self.gait.name);
            return Err(place.error(found + "; expected one pace. hint: changes of speed can be given by the scene"));
        }
        let schedule = self.schedule(sources)?;
        let settings = &self.settings(control, sources)?;
        let steps = sources.steps;
        let mut all = Vec::new();
        let walks_steadily = schedule.is_empty() && !schedule.begins_standing();
        let speeds =
            if walks_steadily { vec![self.entry.speed] } else { schedule.plans().into_iter().map(Some).collect() };
        for speed in &speeds {
            let plan = self.plan(*speed, sources)?;
            let one = match &plan.controller {
                Some((known, own)) if known == settings => own.clone(),
                _ => {
                    let made = WalkController::new(&plan.human, &plan.solution, steps, settings);
                    made.map_err(|e| place.error(chain(&e)))?
                }
            };
            plan.controller = Some((settings.clone(), one.clone()));
            all.push(one);
        }
        let mut controller = WalkController::joined(&all).map_err(|e| place.error(chain(&e)))?;
        if schedule.has_standing() {
            let slowest = self.plan(speeds[0], sources)?;
            let with = controller.with_standing(&slowest.human, &slowest.solution, steps, settings);
            controller = with.map_err(|e| place.error(chain(&e)))?;
        }
        if schedule.begins_standing() {
            controller = controller.starting_at_rest();
        } else {
            controller = controller.starting_at(self.entry.phase);
            controller.set_speed(schedule.at(0.0)).map_err(|e| place.error(chain(&e)))?;
        }
        Ok(ScheduledController { controller, schedule })
    }

    /// The settings of a controller with the torque curves of its file.
    pub(super) fn settings(
        &self,
        control: &ControlEntry,
        sources: &mut InputFiles<'_, '_>,
    ) -> Result<ControlSettings, SceneError> {
        let mut settings = control.settings.clone();
        if let Some((place, path)) = &control.torques {
            if !self.entry.changes.is_empty() {
                return Err(place.error(
                    "found torque curves and `changes` of speed; expected one speed, to which the curves belong"
                        .to_owned(),
                ));
            }
            let text = sources.text(place, path)?;
            let curves = TorqueSeries::read(&text, "physical", &self.gait.name);
            let curves = curves.map_err(|e| place.error(format!("{path}: {}", chain(&e))))?;
            settings.torques = TorqueCurves::Given(curves);
        }
        Ok(settings)
    }

    /// Speeds over time. A figure that stands at the start has no plan at its speed.
    fn schedule(&self, sources: &mut InputFiles<'_, '_>) -> Result<SpeedSchedule, SceneError> {
        let place = &self.entry.place;
        let human = self.build.human().map_err(|e| place.error(chain(&e)))?;
        let stands = self.entry.speed.is_some_and(|speed| speed <= 0.0);
        let first = if stands { 0.0 } else { self.plan(self.entry.speed, sources)?.solution.speed() };
        let mut schedule = SpeedSchedule::from(first, StandingMovements::speed(&human));
        for PaceChange { start_s, duration_s, speed, step_length, step_frequency } in &self.entry.changes {
            let (Some(to), None, None) = (speed, step_length, step_frequency) else {
                let found = "found a change of step length or frequency; expected changes of `speed`";
                return Err(place.error(format!("{found}, which is what a controller can follow")));
            };
            schedule.change(*start_s, duration_s.unwrap_or(CHANGE_S), *to);
        }
        Ok(schedule)
    }
}
