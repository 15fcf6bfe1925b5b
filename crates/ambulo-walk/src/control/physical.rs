//! A figure that walks by its own torques on level ground, and the outcome of its walk.

use super::controller::WalkController;
use super::fall::Fall;
use super::figure::FigureWorld;
use super::settings::{ControlError, ControlSettings};
use super::walk_recorder::FigureRecorder;
use crate::dynamics::Convergence;
use crate::engine::{StepSettings, World};
use crate::findings::Findings;
use crate::model::anthropometry::Human;
use crate::optimal::Solution;
use crate::spatial::Pose;
use crate::walking::WalkingError;

/// A figure that walks by its own torques.
#[derive(Debug, Clone)]
pub struct PhysicalWalk {
    figure: FigureWorld,
    controller: WalkController,
    findings: Findings,
}

impl PhysicalWalk {
    /// A figure in the first state of a walk, with the controller of that walk.
    ///
    /// # Errors
    /// As [`WalkController::new`].
    pub fn new(
        human: &Human,
        plan: &Solution,
        step: StepSettings,
        settings: &ControlSettings,
    ) -> Result<PhysicalWalk, ControlError> {
        let controller = WalkController::new(human, plan, step, settings)?;
        PhysicalWalk::with(human, plan, step, controller)
    }

    /// A figure with a controller that was made for a similar one: another mass or size.
    ///
    /// # Errors
    /// A figure that is not planar.
    pub fn with(
        human: &Human,
        plan: &Solution,
        step: StepSettings,
        controller: WalkController,
    ) -> Result<PhysicalWalk, ControlError> {
        let mut figure = FigureWorld::new(human, plan.problem().shoes, step)?;
        let controller = controller.of_figure(human).predicting_with(&figure);
        let [q, qd] = controller.start();
        figure.place(&q, &qd);
        Ok(PhysicalWalk { figure, controller, findings: Findings::default() })
    }

    /// The world: bodies in the order of the model, their loads, the ground and what is added to it.
    pub fn world_mut(&mut self) -> &mut World {
        &mut self.figure.world
    }

    /// Time [s].
    #[must_use]
    pub fn time_s(&self) -> f64 {
        self.figure.state.time_s
    }

    /// Duration of a step [s].
    #[must_use]
    pub fn step_s(&self) -> f64 {
        self.figure.settings.step_s
    }

    /// Sets the speed of the plan [m/s] ([`WalkController::set_speed`]).
    ///
    /// # Errors
    /// A speed that no plan has.
    pub fn set_speed(&mut self, speed: f64) -> Result<(), ControlError> {
        self.controller.set_speed(speed)
    }

    /// The controller.
    #[must_use]
    pub fn controller(&self) -> &WalkController {
        &self.controller
    }

    /// Value and rate of each coordinate.
    #[must_use]
    pub fn coordinates(&self) -> Vec<[f64; 2]> {
        self.figure.read()
    }

    /// Poses of the bodies, in the order of the model; their origins are the mass centres [m].
    #[must_use]
    pub fn poses(&self) -> &[Pose] {
        let bodies = self.figure.tree.model.bodies().len();
        &self.figure.state.poses[self.figure.tree.first_body..self.figure.tree.first_body + bodies]
    }

    /// Generalised force of each coordinate in the last step [N.m or N]; the root's are zero.
    #[must_use]
    pub fn efforts(&self) -> Vec<f64> {
        self.figure.efforts()
    }

    /// The fall, once there was one.
    #[must_use]
    pub fn fall(&self) -> Option<Fall> {
        self.controller.fall()
    }

    /// Findings of the simulator so far.
    #[must_use]
    pub fn findings(&self) -> &Findings {
        &self.findings
    }

    /// Makes one step; returns whether its equations were solved.
    ///
    /// # Errors
    /// Joints that do not form trees.
    pub fn step(&mut self) -> Result<Convergence, WalkingError> {
        let (now, loads) = (self.figure.read(), self.figure.loads());
        let stood = self.fall().is_none();
        for (c, motor) in self.controller.act(&now, loads).into_iter().enumerate() {
            if let Some(motor) = motor {
                self.figure.drive(c, motor);
            }
        }
        if stood && self.fall().is_some() {
            self.figure.lie_down(&now);
        }
        Ok(self.figure.step(&mut self.findings)?)
    }

    /// A recorder of the figure.
    pub(crate) fn recorder(&self, human: &Human) -> FigureRecorder {
        let soles = human.soles.iter().enumerate().map(|(surface, sole)| (surface, sole.side)).collect();
        FigureRecorder::new("figure", human, self.figure.tree.clone(), soles, None)
    }

    /// Makes one step and records it.
    ///
    /// # Errors
    /// As [`PhysicalWalk::step`].
    pub(crate) fn record_step(&mut self, recorder: &mut FigureRecorder) -> Result<(), WalkingError> {
        recorder.before_step(&self.figure.world, &self.figure.state);
        let converged = self.step()?.converged;
        let FigureWorld { world, state, workspace, settings, .. } = &mut self.figure;
        workspace.read_wrenches();
        recorder.after_step(world, state, workspace, settings.step_s, converged);
        Ok(())
    }

    /// Walks until a time [s] or a fall.
    ///
    /// # Errors
    /// As [`PhysicalWalk::step`].
    pub fn walk_until(&mut self, time_s: f64) -> Result<Option<Fall>, WalkingError> {
        while self.time_s() < time_s && self.fall().is_none() {
            self.step()?;
        }
        Ok(self.fall())
    }
}
