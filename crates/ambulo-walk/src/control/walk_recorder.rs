//! Records a walking figure of a scene step by step, for its verdict.

use super::fall::Fall;
use super::schedule::ScheduledController;
use crate::engine::figure_tree::FigureTree;
use crate::engine::forces::ContactForce;
use crate::engine::signal::Signal;
use crate::engine::state::WorldState;
use crate::engine::workspace::StepWorkspace;
use crate::engine::world::{Owner, World};
use crate::kinematics::{Trajectory, TrajectoryError};
use crate::model::anthropometry::Human;
use crate::model::{BodyId, BySide, Side};
use crate::motion::TimeGrid;
use crate::walking::{FootRecord, GaitTargets, WalkRecording};

/// A contact belongs to the ground if the vertical component of its normal is at least this: less than 45° from the
/// vertical.
const GROUND: f64 = std::f64::consts::FRAC_1_SQRT_2;
/// Largest number of recorded steps.
const MOST_ROWS: usize = 1_000_000;

/// A walk of a scene's figure.
#[derive(Debug, Clone)]
pub struct FigureWalk {
    /// Name of the figure.
    pub name: String,
    /// The figure at its pose in the scene, with abducted arms.
    pub human: Human,
    /// Posture and forces of every step.
    pub recording: WalkRecording,
}

/// A recording under way.
#[derive(Debug, Clone)]
pub(crate) struct FigureRecorder {
    name: String,
    human: Human,
    tree: FigureTree,
    /// Indices of the surfaces of the soles.
    soles: Vec<(usize, Side)>,
    start_s: f64,
    /// Coordinates and rates before the step.
    before: Vec<[f64; 2]>,
    columns: Vec<[Vec<f64>; 3]>,
    efforts: Vec<Vec<f64>>,
    feet: [FootRecord; 2],
    unsolved: usize,
    /// Driver of the figure in each step.
    live: Option<Live>,
}

/// Driver of a figure in each step.
#[derive(Debug, Clone)]
pub(crate) enum Live {
    /// Machines compute targets of drives.
    Machines(LiveTargets),
    /// A controller computes torques.
    Controller(Box<ScheduledController>),
}

/// Targets that machines of a figure compute from step to step, because they read loads, angles or joints of the scene.
#[derive(Debug, Clone)]
pub(crate) struct LiveTargets {
    pub(crate) targets: Box<GaitTargets>,
    /// Index of the figure in the world.
    pub(crate) figure: usize,
    /// Time of the gait at the start of the scene [s].
    pub(crate) start_s: f64,
}

impl FigureRecorder {
    pub(crate) fn new(
        name: &str,
        human: &Human,
        tree: FigureTree,
        soles: Vec<(usize, Side)>,
        live: Option<Live>,
    ) -> FigureRecorder {
        let count = tree.places.len();
        let foot = |side: Side| human.soles.iter().find(|sole| sole.side == side).map_or(BodyId(0), |sole| sole.body);
        let toes = |side: Side| {
            let mut bodies = human.soles.iter().filter(|sole| sole.side == side).map(|sole| sole.body);
            bodies.find(|body| *body != foot(side))
        };
        FigureRecorder {
            name: name.to_owned(),
            human: human.clone(),
            tree,
            soles,
            start_s: 0.0,
            before: Vec::new(),
            columns: vec![Default::default(); count],
            efforts: vec![Vec::new(); count],
            feet: Side::BOTH.map(|side| FootRecord::new(foot(side), toes(side), 0)),
            unsolved: 0,
            live,
        }
    }

    /// Whether machines or a controller of the figure read the simulation.
    pub(crate) fn is_live(&self) -> bool {
        self.live.is_some()
    }

    /// Sets drives and motors of the figure for a step that ends at a time [s]; machines and controllers read the
    /// figure as it is at its start.
    pub(crate) fn aim(&mut self, world: &mut World, state: &WorldState, end_s: f64) {
        match &mut self.live {
            Some(Live::Controller(_)) => self.control(world, end_s),
            Some(Live::Machines(_)) => self.aim_machines(world, state, end_s),
            None => {}
        }
    }

    /// Whether it walks by its own torques.
    pub(crate) fn is_controlled(&self) -> bool {
        matches!(self.live, Some(Live::Controller(_)))
    }

    /// The fall of a figure that walks by its own torques.
    pub(crate) fn fall(&self) -> Option<Fall> {
        match &self.live {
            Some(Live::Controller(own)) => own.controller.fall(),
            _ => None,
        }
    }

    /// Message about a fall. Its time and the steps before it are measured afterwards, as those of other figures.
    pub(crate) fn description(&self, fall: &Fall) -> String {
        format!("`{}` fell; {}", self.name, fall.cause(&self.human.model))
    }

    /// Sets the motors of a figure that walks by its own torques.
    fn control(&mut self, world: &mut World, end_s: f64) {
        let Some(Live::Controller(own)) = &mut self.live else { return };
        let controller = &mut own.controller;
        // All speeds of the schedule lie between the speeds of the plans.
        let _within = controller.set_speed(own.schedule.at(end_s));
        let last = self.feet[0].force.len().checked_sub(1);
        let loads_n = last.map_or([0.0; 2], |last| [0, 1].map(|foot| self.feet[foot].force[last].y));
        let joint_of = world.joint_of_body();
        let stood = controller.fall().is_none();
        for (motor, place) in controller.act(&self.before, loads_n).into_iter().zip(&self.tree.places) {
            if let (Some(motor), Some((joint, k))) = (motor, place.joint(&joint_of)) {
                world.joints[joint].coordinates[k].motor = Some(motor);
            }
        }
        if stood && controller.fall().is_some() {
            // The solids of a figure have a size.
            let _lies = self.tree.lie_down(world, &self.before);
        }
    }

    fn aim_machines(&mut self, world: &mut World, state: &WorldState, end_s: f64) {
        let Some(Live::Machines(LiveTargets { targets, figure, start_s })) = &mut self.live else { return };
        let coordinate = |name: &str| {
            let joint = world.joints.iter().position(|joint| joint.name == name)?;
            state.coordinates[joint].first().copied()
        };
        let signals: Vec<f64> = targets.signals().map(|name| coordinate(name).unwrap_or(f64::NAN)).collect();
        targets.measure(|id| self.before[id][0], |k| signals[k]);
        match self.feet[0].force.len().checked_sub(1) {
            Some(last) => {
                let loaded = BySide::from([0, 1].map(|k| self.feet[k].loaded(last)));
                targets.step_with(*start_s + end_s, loaded);
            }
            None => targets.step(*start_s + end_s),
        }
        let joint_of = world.joint_of_body();
        for (id, place) in self.tree.places.iter().enumerate().take(targets.count()) {
            let signal = Signal::Near(end_s, targets.at(id));
            if let Some((joint, k)) = place.joint(&joint_of) {
                let acting = &mut world.joints[joint].coordinates[k];
                if let Some(drive) = &mut acting.drive {
                    drive.signal = signal.clone();
                }
                if let Some(motor) = &mut acting.motor {
                    motor.target = signal.clone();
                }
            }
            world.figures[*figure].coordinates[id] = signal;
        }
    }

    pub(crate) fn before_step(&mut self, world: &World, state: &WorldState) {
        if self.feet[0].force.is_empty() {
            self.start_s = state.time_s;
        }
        self.before = self.tree.read(world, state, &world.joint_of_body());
    }

    /// Records a step; the wrenches of the workspace must have been read. The posture belongs to the start of the step,
    /// velocities to the middle of steps.
    pub(crate) fn after_step(
        &mut self,
        world: &World,
        state: &WorldState,
        w: &StepWorkspace,
        step_s: f64,
        solved: bool,
    ) {
        if self.feet[0].force.len() >= MOST_ROWS {
            return;
        }
        self.unsolved += usize::from(!solved);
        let joint_of = world.joint_of_body();
        let after = self.tree.read(world, state, &joint_of);
        for (id, (columns, place)) in self.columns.iter_mut().zip(&self.tree.places).enumerate() {
            let ([q, old], [_, new]) = (self.before[id], after[id]);
            let mut values = [q, 0.5 * (old + new), (new - old) / step_s];
            let mut effort = 0.0;
            if let Some((joint, k)) = place.joint(&joint_of) {
                let acting = &world.joints[joint].coordinates[k];
                if let Some(drive) = acting.drive.as_ref().filter(|drive| drive.max.is_none()) {
                    values = drive.signal.at(state.time_s - step_s);
                }
                if acting.acts() {
                    effort = w.effort(world.joints[joint].child, joint, k);
                }
            }
            columns.iter_mut().zip(values).for_each(|(column, value)| column.push(value));
            self.efforts[id].push(effort);
        }
        self.keep_feet(world, w);
    }

    fn keep_feet(&mut self, world: &World, w: &StepWorkspace) {
        self.feet.iter_mut().for_each(FootRecord::begin_row);
        for contact in w.contacts() {
            let (a, b) = contact.surfaces;
            let (contact, other) = match self.soles.iter().find(|(sole, _)| *sole == a || *sole == b) {
                None => continue,
                Some((sole, _)) if *sole == a => (contact, b),
                Some(_) => (turned(contact), a),
            };
            let fixed = matches!(world.surfaces[other].owner, Owner::Obstacle(_));
            let touching = self.soles.iter().position(|(sole, _)| *sole == contact.surfaces.0);
            let sole = touching.and_then(|number| self.human.soles.get(number));
            if let (Some(sole), true) = (sole, fixed && contact.normal.y >= GROUND) {
                let [one, two] = [a, b].map(|s| world.materials[world.surfaces[s].material].friction);
                self.feet[usize::from(sole.side == Side::Left)].add(&contact, sole.body, (one * two).sqrt());
            }
        }
        self.feet.iter_mut().for_each(FootRecord::end_row);
    }

    pub(crate) fn walk(&self, step_s: f64) -> Result<FigureWalk, TrajectoryError> {
        let grid = TimeGrid { start_s: self.start_s, step_s, frames: self.feet[0].force.len() };
        let trajectory = Trajectory::new(&self.human.model, grid, self.columns.clone())?;
        let recording = WalkRecording {
            model: self.human.model.clone(),
            trajectory,
            efforts: self.efforts.clone(),
            feet: self.feet.clone(),
            impacts: Vec::new(),
            unsolved_steps: self.unsolved,
        };
        Ok(FigureWalk { name: self.name.clone(), human: self.human.clone(), recording })
    }
}

/// The same contact with its surfaces exchanged.
fn turned(contact: ContactForce) -> ContactForce {
    ContactForce {
        surfaces: (contact.surfaces.1, contact.surfaces.0),
        normal: -contact.normal,
        force: -contact.force,
        slip: -contact.slip,
        ..contact
    }
}
