//! Simulates a scene with its events, and passes frames to the caller.

use super::build::Scene;
use super::checks::open_m;
use super::event::EventAction;
use super::file::MOST_STEPS;
use super::model_figure::PlacedFigure;
use super::output::Outputs;
use super::recorder::{FigureRecord, Recorder};
use super::solver::IntegratorReason;
use crate::dynamics::{Convergence, LinkError, Workspace, project_wrenches};
use crate::engine::energy::{Energy, energy};
use crate::engine::figure_tree::{FigurePlace, FigureTree};
use crate::engine::forces::{ContactForce, StepForces};
use crate::engine::projection::largest_joint_error;
use crate::engine::row::{Row, StepTaken};
use crate::engine::state::{RowKey, WorldState};
use crate::engine::step::step;
use crate::engine::workspace::StepSettings;
use crate::engine::world::World;
use crate::findings::{Code, Findings};
use crate::kinematics::{BodyMotion, Posture, TrajectoryError, body_motion};
use crate::numerics::Shown;
use crate::spatial::{Pose, Wrench};
use std::ops::ControlFlow;

/// Times closer than this share of a step are simultaneous: for rounded times in files.
const SAME_INSTANT: f64 = 1e-6;
/// Duration of a scene after all figures that walk by their own torques have fallen [s].
const AFTER_FALL_S: f64 = 2.0;
/// Largest number of rows of output, counted for each body, joint and closure: they take about 200 bytes each.
const MOST_ROWS: f64 = 1e7;

/// Why a scene could not be resumed, or simulated to its end.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RunError {
    /// Joints that do not form trees.
    #[error(transparent)]
    Links(#[from] LinkError),
    /// No time step, or too many.
    #[error("the time step is {} s, the duration {} s; expected 1 to 1e9 time steps", Shown(*step_s),
        Shown(*duration_s))]
    Steps {
        /// Time step [s].
        step_s: f64,
        /// Duration [s].
        duration_s: f64,
    },
    /// More output than fits into memory.
    #[error(
        "a duration of {} s gives {rows:.1e} rows of output for each of {things} bodies, joints and closures; expected \
         at most {MOST_ROWS:e} rows together, because of memory. hint: simulate a shorter time, or lower `output_rate`",
             Shown(*duration_s)
    )]
    TooLong {
        /// Duration [s].
        duration_s: f64,
        /// Rows of output for each body, joint and closure.
        rows: f64,
        /// Number of bodies, joints and closures.
        things: usize,
    },
    /// A number that is not finite.
    #[error("at {time_s:.6} s position or velocity of `{body}` is not a finite number. hint: use a shorter time step")]
    NotFinite {
        /// The body.
        body: String,
        /// Time [s].
        time_s: f64,
    },
    /// The saved state of another scene.
    #[error("the saved state belongs to another scene: {what} {found}; expected {expected}")]
    OtherScene {
        /// Difference.
        what: &'static str,
        /// Saved value.
        found: String,
        /// Value of the scene.
        expected: String,
    },
    /// The caller asked to stop.
    #[error("the simulation was stopped at {} s", Shown(*time_s))]
    Stopped {
        /// Time of the last frame [s].
        time_s: f64,
    },
    /// Machines or controllers, whose states are not saved.
    #[error(
        "a figure of the scene has a controller, or machines that read loads, angles or joints, and their states are \
         not saved; expected figures that follow the clock alone. hint: simulate the scene from its start"
    )]
    Machines,
}

/// A scene at one output time. Positions, velocities and forces belong to that instant (docs/SIMULATION.md).
#[derive(Debug)]
pub struct SceneFrame<'a> {
    /// The scene at this instant.
    pub scene: &'a Scene,
    /// Forces at this instant; none if no step can begin here.
    pub forces: Option<StepForces>,
    /// Impacts within steps since the last frame: time [s], with impulses [N.s] as forces.
    pub impacts: Vec<(f64, ContactForce)>,
    /// Energies.
    pub energy: Energy,
}

/// Numbers of steps and iterations of a run.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct RunStatistics {
    /// Steps made.
    pub steps: usize,
    /// Tree solves of all steps.
    pub iterations: usize,
    /// Most tree solves of one step.
    pub most_iterations: usize,
    /// Factorisations of all steps.
    pub factorizations: usize,
    /// Largest residual of a step.
    pub largest_residual: f64,
    /// Steps whose residual stayed above the tolerance.
    pub not_converged: usize,
}

impl RunStatistics {
    fn add(&mut self, convergence: &Convergence) {
        self.steps += 1;
        self.iterations += convergence.iterations;
        self.most_iterations = self.most_iterations.max(convergence.iterations);
        self.factorizations += convergence.factorizations;
        self.largest_residual = self.largest_residual.max(convergence.residual);
        self.not_converged += usize::from(!convergence.converged);
    }
}

impl Scene {
    /// The simulated world. Events add and remove joints and closures.
    #[must_use]
    pub fn world(&self) -> &World {
        &self.world
    }

    /// The present state.
    #[must_use]
    pub fn state(&self) -> &WorldState {
        &self.state
    }

    /// Settings of the steps.
    #[must_use]
    pub fn settings(&self) -> &StepSettings {
        &self.settings
    }

    /// Why the steps have their integrator.
    #[must_use]
    pub fn integrator_reason(&self) -> IntegratorReason {
        self.integrator_reason
    }

    /// Time at which the scene ends [s].
    #[must_use]
    pub fn duration_s(&self) -> f64 {
        self.duration_s
    }

    /// Title; may be empty.
    #[must_use]
    pub fn title(&self) -> &str {
        &self.title
    }

    /// The results to write.
    #[must_use]
    pub fn outputs(&self) -> &Outputs {
        &self.outputs
    }

    /// Name of a joint of the file, which an event may have removed.
    #[must_use]
    pub fn joint_name(&self, joint: usize) -> &str {
        &self.joint_names[joint]
    }

    /// Names of the figures, in the order of [`World::figures`].
    pub fn figure_names(&self) -> impl Iterator<Item = &str> {
        self.walkers.iter().map(|walker| walker.name.as_str())
    }

    /// Steps since the beginning of the scene, including those before it was resumed.
    #[must_use]
    pub fn steps_made(&self) -> usize {
        self.steps
    }

    /// Number of steps of the whole scene.
    #[must_use]
    pub fn steps_in_all(&self) -> usize {
        (self.duration_s / self.settings.step_s - SAME_INSTANT).ceil().max(0.0) as usize
    }

    /// Simulates to the end and calls back at the output rate. The first frame is the start, except for a resumed
    /// scene, where the earlier run had this frame. A frame has the world after the events of its instant.
    ///
    /// # Errors
    /// No time step or too many, more output than fits into memory, joints that do not form trees, motion that is not
    /// finite.
    pub fn run(
        &mut self,
        findings: &mut Findings,
        mut visit: impl FnMut(&SceneFrame<'_>),
    ) -> Result<RunStatistics, RunError> {
        self.run_while(findings, |frame| {
            visit(frame);
            ControlFlow::Continue(())
        })
    }

    /// As [`Scene::run`], until a visit asks to stop.
    ///
    /// # Errors
    /// As [`Scene::run`]; [`RunError::Stopped`].
    pub fn run_while(
        &mut self,
        findings: &mut Findings,
        mut visit: impl FnMut(&SceneFrame<'_>) -> ControlFlow<()>,
    ) -> Result<RunStatistics, RunError> {
        self.check_length()?;
        let mut statistics = RunStatistics::default();
        let mut impacts = Vec::new();
        while self.steps < self.steps_in_all() && !self.has_ended() {
            self.prepare(findings);
            let before = self.is_seen().then(|| self.state.clone());
            statistics.add(&self.advance(findings)?);
            if let Some(before) = before {
                self.show(&before, std::mem::take(&mut impacts), &mut visit)?;
            }
            let of_step = self.workspace.impacts().iter();
            impacts.extend(of_step.flat_map(|impact| impact.contacts.iter().map(|contact| (impact.time_s, *contact))));
        }
        if self.is_seen() {
            self.show_end(impacts, &mut visit)?;
        }
        self.checks.end(&self.world, &self.state, findings);
        Ok(statistics)
    }

    /// Passes the frame of the last instant to the caller: its forces belong to a step that would begin there.
    fn show_end(
        &self,
        impacts: Vec<(f64, ContactForce)>,
        visit: &mut impl FnMut(&SceneFrame<'_>) -> ControlFlow<()>,
    ) -> Result<(), RunError> {
        let (mut ahead, mut unseen) = (self.clone(), Findings::default());
        ahead.prepare(&mut unseen);
        let before = ahead.state.clone();
        if ahead.advance(&mut unseen).is_err() {
            let energy = energy(&self.world, &self.state);
            return self.seen(visit(&SceneFrame { scene: self, forces: None, impacts, energy }));
        }
        ahead.show(&before, impacts, visit)
    }

    /// Passes the frame of the instant before the last step to the caller.
    fn show(
        &mut self,
        before: &WorldState,
        impacts: Vec<(f64, ContactForce)>,
        visit: &mut impl FnMut(&SceneFrame<'_>) -> ControlFlow<()>,
    ) -> Result<(), RunError> {
        let begins = self.steps == 1 && !self.starts_early;
        let (settings, workspace) = (&self.settings, &self.workspace);
        let step = StepTaken { world: &self.world, before, after: &self.state, settings, workspace, begins };
        let Row { state, forces } = step.row(&mut self.probe)?;
        let after = std::mem::replace(&mut self.state, state);
        let energy = energy(&self.world, &self.state);
        let going = visit(&SceneFrame { scene: self, forces: Some(forces), impacts, energy });
        self.state = after;
        self.seen(going)
    }

    /// Ends the run with an error if the caller answered a frame with `Break`.
    fn seen(&self, going: ControlFlow<()>) -> Result<(), RunError> {
        match going {
            ControlFlow::Continue(()) => Ok(()),
            ControlFlow::Break(()) => Err(RunError::Stopped { time_s: self.state.time_s }),
        }
    }

    /// Whether all figures that walk by their own torques have fallen some time ago.
    fn has_ended(&self) -> bool {
        let last = self.recorders.iter().filter_map(Recorder::falls_at).reduce(f64::max);
        last.is_some_and(|fall_s| self.state.time_s >= fall_s + AFTER_FALL_S)
    }

    fn check_length(&self) -> Result<(), RunError> {
        let (step_s, duration_s) = (self.settings.step_s, self.duration_s);
        let is_possible = step_s > 0.0 && step_s <= duration_s && duration_s / step_s <= MOST_STEPS;
        if !is_possible {
            return Err(RunError::Steps { step_s, duration_s });
        }
        let things = self.world.bodies.len() + self.world.joints.len() + self.world.closures.len();
        let rows = duration_s * self.output_rate_hz.min(1.0 / step_s);
        if rows * things as f64 > MOST_ROWS {
            return Err(RunError::TooLong { duration_s, rows, things });
        }
        Ok(())
    }

    /// Applies the events that are due, then makes one step.
    ///
    /// # Errors
    /// As [`Scene::run`].
    pub fn step(&mut self, findings: &mut Findings) -> Result<Convergence, RunError> {
        self.prepare(findings);
        self.advance(findings)
    }

    /// Applies the events that are due, and sets drives and motors of the next step.
    fn prepare(&mut self, findings: &mut Findings) {
        self.fire_events();
        if !self.walkers.is_empty() {
            self.before.clone_from(&self.state.poses);
        }
        for recorder in &mut self.recorders {
            let stood = !recorder.has_fallen();
            recorder.before_step(&self.world, &self.state);
            recorder.aim(&mut self.world, &self.state, (self.steps + 1) as f64 * self.settings.step_s);
            if stood {
                recorder.fall().into_iter().for_each(|fall| findings.report(Code::FigureFell, fall));
            }
        }
    }

    /// Makes one step.
    fn advance(&mut self, findings: &mut Findings) -> Result<Convergence, RunError> {
        let convergence = step(&self.world, &mut self.state, &self.settings, &mut self.workspace, findings)?;
        if self.steps == 0 {
            for closure in self.workspace.undetermined_closures() {
                let name = &self.world.closures[closure].name;
                findings.report(
                    Code::ClosureRedundant,
                    format!(
                        "the closure `{name}` repeats constraints of others; its forces are the least-squares ones"
                    ),
                );
            }
        }
        self.steps += 1;
        // Times are computed from the number of steps, so that rounding does not accumulate.
        self.state.time_s = self.steps as f64 * self.settings.step_s;
        if !self.recorders.is_empty() {
            self.workspace.read_wrenches();
            for recorder in &mut self.recorders {
                let (step_s, solved) = (self.settings.step_s, convergence.converged);
                recorder.after_step(&self.world, &self.before, &self.state, &self.workspace, step_s, solved);
            }
        }
        self.checks.look(&self.world, &self.state, self.settings.step_s, findings);
        let finite = |body: usize| {
            let (pose, twist) = (&self.state.poses[body], &self.state.twists[body]);
            let numbers = pose.translation.iter().chain(pose.rotation.iter());
            numbers.chain(twist.linear.iter()).chain(twist.angular.iter()).all(|x| x.is_finite())
        };
        match (0..self.world.bodies.len()).find(|body| !finite(*body)) {
            None => Ok(convergence),
            Some(body) => {
                let body = self.world.bodies[body].name.clone();
                Err(RunError::NotFinite { body, time_s: self.state.time_s })
            }
        }
    }

    /// Forces of the last step.
    #[must_use]
    pub fn forces(&self) -> StepForces {
        self.workspace.forces(&self.world)
    }

    /// Recordings of the figures that walk or follow a recording since the scene was built or resumed, in the order of
    /// the file.
    ///
    /// # Errors
    /// If no step was made yet.
    pub fn records(&self) -> Result<Vec<FigureRecord>, TrajectoryError> {
        self.recorders.iter().map(|recorder| recorder.record(self.settings.step_s)).collect()
    }

    /// Whether this is an instant of output that no earlier run has shown.
    fn is_seen(&self) -> bool {
        let every = self.output_rate_hz * self.settings.step_s;
        let rows = |steps: usize| (steps as f64 * every + SAME_INSTANT).floor();
        match self.steps {
            0 => true,
            steps => steps > self.resumed && rows(steps) > rows(steps - 1),
        }
    }

    /// Applies the events up to now.
    fn fire_events(&mut self) {
        let now = self.state.time_s + SAME_INSTANT * self.settings.step_s;
        while let Some(event) = self.events.get(self.fired).filter(|event| event.time_s <= now) {
            let change = event.change;
            self.fired += 1;
            let mut added = None;
            match change {
                EventAction::AddClosure(closure) => {
                    self.close(closure);
                    added = Some(closure);
                }
                EventAction::RemoveClosure(closure) => {
                    self.world.closures[closure].active = false;
                    self.state.guess.remove(&RowKey::Closure(closure));
                }
                EventAction::RemoveJoint(joint) => self.remove_joint(joint),
            }
            self.checks.changed(&self.world, &self.state, added, self.settings.step_s);
        }
    }

    fn close(&mut self, number: usize) {
        let closing = &self.closings[number];
        let pose = |body: Option<usize>| body.map_or(Pose::IDENTITY, |body| self.state.poses[body]);
        let frames = closing.frames(&pose(Some(closing.first)), &pose(closing.second));
        let closure = &mut self.world.closures[number];
        (closure.first_from_joint, closure.second_from_joint) = frames;
        closure.active = true;
    }

    /// Removes a joint of the file; its child is then free.
    pub(super) fn remove_joint(&mut self, joint: usize) {
        let Some(number) = self.joint_numbers[joint].take() else { return };
        self.world.joints.remove(number);
        self.state.coordinates.remove(number);
        for other in self.joint_numbers.iter_mut().flatten().filter(|other| **other > number) {
            *other -= 1;
        }
        let guess = std::mem::take(&mut self.state.guess);
        self.state.guess = guess.into_iter().filter_map(|(key, rows)| Some((without(key, number)?, rows))).collect();
    }

    /// Value, rate and generalised force [N.m or N] of every coordinate of each figure's model, from the forces of a
    /// frame. The force is zero for joints without constraint or drive; values of figures from a model file are those
    /// of the recording.
    #[must_use]
    pub fn generalized_forces(&self, forces: &StepForces) -> Vec<Vec<[f64; 3]>> {
        self.walkers.iter().map(|walker| self.of_walker(walker, forces)).collect()
    }

    fn of_walker(&self, walker: &PlacedFigure, forces: &StepForces) -> Vec<[f64; 3]> {
        if let Some(tree) = &walker.tree {
            return self.of_joints(tree, forces);
        }
        let figure = &self.world.figures[walker.figure];
        let values: Vec<[f64; 3]> = figure.coordinates.iter().map(|signal| signal.at(self.state.time_s)).collect();
        let [q, qd, qdd] = [0, 1, 2].map(|k| values.iter().map(|v| v[k]).collect::<Vec<f64>>());
        let posture = Posture { q: &q, qd: &qd, qdd: &qdd };
        let motions = body_motion(&figure.model, posture);
        let joint_of = self.world.joint_of_body();
        // The recording may have another posture than the figure; reactions are rotated with the joint's child.
        let wrench = |(i, motion): (usize, &BodyMotion)| {
            let body = walker.first_body + i;
            let follows = joint_of[body].is_some_and(|j| self.world.joints[j].follows.is_some());
            if !follows {
                return Wrench::ZERO;
            }
            let turn = motion.pose.rotation * self.state.poses[body].rotation.transpose();
            let Wrench { moment, force } = forces.joints[body];
            Wrench { moment: turn * moment, force: turn * force }
        };
        let wrenches: Vec<Wrench> = motions.iter().enumerate().map(wrench).collect();
        let mut workspace = Workspace::new(&figure.model);
        let tau = project_wrenches(&mut workspace, posture, &wrenches);
        q.iter().zip(&qd).zip(tau).map(|((value, rate), tau)| [*value, *rate, *tau]).collect()
    }

    fn of_joints(&self, tree: &FigureTree, forces: &StepForces) -> Vec<[f64; 3]> {
        let joint_of = self.world.joint_of_body();
        let read = tree.read(&self.world, &self.state, &joint_of);
        let of = |(place, [value, rate]): (&FigurePlace, [f64; 2])| {
            [value, rate, place.joint(&joint_of).map_or(0.0, |(joint, k)| forces.efforts[joint][k])]
        };
        tree.places.iter().zip(read).map(of).collect()
    }

    /// Distance of the points of a closure along its constrained directions [m].
    #[must_use]
    pub fn closure_gap(&self, closure: usize) -> f64 {
        open_m(&self.world, &self.state, closure)
    }

    /// Largest position error of any joint or active closure [m].
    #[must_use]
    pub fn largest_joint_error(&self) -> f64 {
        largest_joint_error(&self.world, &self.state)
    }
}

/// The key after a joint was removed; `None` if it belonged to that joint.
fn without(key: RowKey, gone: usize) -> Option<RowKey> {
    let rest = |joint: usize| (joint != gone).then(|| joint - usize::from(joint > gone));
    Some(match key {
        RowKey::Drive(joint, k) => RowKey::Drive(rest(joint)?, k),
        RowKey::Motor(joint, k) => RowKey::Motor(rest(joint)?, k),
        RowKey::Friction(joint, k) => RowKey::Friction(rest(joint)?, k),
        RowKey::LowerLimit(joint, k) => RowKey::LowerLimit(rest(joint)?, k),
        RowKey::UpperLimit(joint, k) => RowKey::UpperLimit(rest(joint)?, k),
        other => other,
    })
}
