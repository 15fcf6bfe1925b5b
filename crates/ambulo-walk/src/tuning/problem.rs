//! A figure whose gains are tuned, and trials of other gains.

use super::gain::{Gain, GainError, rounded};
use super::outcome::{Sums, TrialOutcome};
use super::push::{PUSH_S, Push};
use crate::control::riccati::StepMap;
use crate::control::{Balance, ControlError, ControlSettings, PhysicalWalk, WalkController};
use crate::engine::StepSettings;
use crate::model::anthropometry::Human;
use crate::numerics::elementary::{exp, ln};
use crate::optimal::Solution;
use crate::spatial::Wrench;

/// Cycles before the pushes, and cycles that must follow a push: ten steps.
const BEFORE: f64 = 1.0;
const AFTER: f64 = 5.0;
/// Share of the time after a push over which the speed is measured.
const SPEED_FROM: f64 = 0.5;
/// Time steps between samples of deviation and effort.
const EVERY: usize = 10;

/// A figure, its plan and its settings, of which some gains are tuned: on level ground, alone, at the speed of the
/// plan.
#[derive(Debug, Clone)]
pub struct TuningProblem {
    human: Human,
    plan: Solution,
    step: StepSettings,
    start: ControlSettings,
    gains: Vec<Gain>,
    /// With the settings at the start.
    controller: WalkController,
    maps: Vec<StepMap>,
    /// Numbers of the trunk's body and of the coordinate forward.
    trunk: usize,
    forward: usize,
}

impl TuningProblem {
    /// A problem whose search starts from settings with feedback. Tuned gains start rounded to the digits with which
    /// gains are written, so the written gains are the judged ones.
    ///
    /// # Errors
    /// A gain that starts outside its bounds; a walk without a controller.
    pub fn new(
        human: &Human,
        plan: &Solution,
        step: StepSettings,
        start: &ControlSettings,
        gains: &[Gain],
    ) -> Result<TuningProblem, GainError> {
        gains.iter().try_for_each(|gain| gain.check(start))?;
        // Feedback is judged, not what recovery steps make of it.
        let mut start = ControlSettings { recovery_steps: false, ..start.clone() };
        for gain in gains {
            let value = rounded(gain.value(&start));
            gain.set(&mut start, value);
        }
        let bare = ControlSettings { balance: Balance::Nothing, ..start.clone() };
        let bare = WalkController::new(human, plan, step, &bare)?;
        let maps = bare.maps(human, plan, step)?;
        let index = |name: &str| human.model.coordinate(name).map_or(0, |id| id.index());
        Ok(TuningProblem {
            controller: bare.with_settings(human, &start, &maps)?,
            trunk: human.model.body("torso").map_or(0, |id| id.index()),
            forward: index("pelvis_tx"),
            human: human.clone(),
            plan: plan.clone(),
            step,
            start,
            gains: gains.to_vec(),
            maps,
        })
    }

    /// The gains that are tuned.
    #[must_use]
    pub fn gains(&self) -> &[Gain] {
        &self.gains
    }

    /// The settings at the start.
    #[must_use]
    pub fn start(&self) -> &ControlSettings {
        &self.start
    }

    /// Settings at a point of the search, which has the natural logarithm of each gain over its start, and the square
    /// of the distance by which the point lies outside the bounds. At zero they are exactly those at the start.
    #[must_use]
    pub fn settings_at(&self, point: &[f64]) -> (ControlSettings, f64) {
        let (mut settings, mut outside) = (self.start.clone(), 0.0);
        for (gain, &wanted) in self.gains.iter().zip(point) {
            let start = gain.value(&self.start);
            let [least, most] = gain.bounds.map(|bound| ln(bound / start));
            let x = wanted.clamp(least, most);
            outside += (wanted - x).powi(2);
            if x.abs() > 0.0 {
                gain.set(&mut settings, rounded(start * exp(x)));
            }
        }
        (settings, outside)
    }

    /// The controller with other settings, as [`WalkController::new`] makes it, in less time.
    ///
    /// # Errors
    /// Settings without gains.
    pub fn controller(&self, settings: &ControlSettings) -> Result<WalkController, ControlError> {
        self.controller.with_settings(&self.human, settings, &self.maps)
    }

    /// Simulates a walk with other settings, and its pushes, which are in the order of their phases.
    ///
    /// # Errors
    /// A walk that cannot be simulated.
    pub fn outcome(&self, settings: &ControlSettings, pushes: &[Push]) -> Result<TrialOutcome, ControlError> {
        let controller = match self.controller(settings) {
            Err(ControlError::Riccati) => return Ok(TrialOutcome::without_gains(pushes.len())),
            other => other?,
        };
        let mut level = PhysicalWalk::with(&self.human, &self.plan, self.step, controller)?;
        let (cycle_s, mut sums) = (self.plan.cycle_s(), Sums::default());
        self.walk(&mut level, BEFORE * cycle_s, &mut sums)?;
        let place = level.coordinates()[self.forward][0];
        for push in pushes {
            self.walk(&mut level, (BEFORE + push.phase) * cycle_s, &mut sums)?;
            self.pushed(&level, push, &mut sums)?;
        }
        self.walk(&mut level, (BEFORE + 1.0) * cycle_s, &mut sums)?;
        if level.fall().is_none() {
            let time_s = level.time_s() - BEFORE * cycle_s;
            sums.speed((level.coordinates()[self.forward][0] - place) / time_s / self.plan.speed());
        }
        Ok(sums.outcome())
    }

    /// A push at the present state of a walk; the walk itself continues without it. Deviation and effort of a walk that
    /// ends in a fall do not count: the fall does.
    fn pushed(&self, level: &PhysicalWalk, push: &Push, sums: &mut Sums) -> Result<(), ControlError> {
        let (mut walk, mut own) = (level.clone(), Sums::default());
        let (start_s, after_s) = (walk.time_s(), AFTER * self.plan.cycle_s());
        walk.world_mut().bodies[self.trunk].load =
            Wrench { force: push.force(self.human.model.mass()), ..Wrench::ZERO };
        self.walk(&mut walk, start_s + PUSH_S, &mut own)?;
        walk.world_mut().bodies[self.trunk].load = Wrench::ZERO;
        self.walk(&mut walk, start_s + SPEED_FROM * after_s, &mut own)?;
        let (from_s, place) = (walk.time_s(), walk.coordinates()[self.forward][0]);
        self.walk(&mut walk, start_s + after_s, &mut own)?;
        if let Some(fall) = walk.fall() {
            sums.fell((fall.time_s - start_s) / after_s);
            return Ok(());
        }
        let speed = (walk.coordinates()[self.forward][0] - place) / (walk.time_s() - from_s);
        own.speed(speed / self.plan.speed());
        sums.survived(&own);
        Ok(())
    }

    /// Walks until a time [s] or a fall, with samples on the way.
    fn walk(&self, walk: &mut PhysicalWalk, until_s: f64, sums: &mut Sums) -> Result<(), ControlError> {
        let mut steps = 0;
        while walk.time_s() < until_s && walk.fall().is_none() {
            walk.step()?;
            steps += 1;
            if steps % EVERY == 0 {
                sums.sample(walk.controller().deviation_and_effort(&walk.coordinates(), &walk.efforts()));
            }
        }
        Ok(())
    }
}
