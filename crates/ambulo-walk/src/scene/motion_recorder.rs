//! Records a figure of a scene that follows a recording, step by step, for its verdict.
//!
//! Coordinates that follow the recording equal their signals. The others, of passive joints and of a free root,
//! are found from the pose T of a body on its parent: Newton steps on J Δq = the rotation and translation that T(q)
//! lacks, where J is the motion of the joint per unit rate of its coordinates, and J q̇ = relative velocity of the
//! bodies for the rates.
//!
//! Pinned by: tests/scene_verdict.rs

use crate::dynamics::LoadSeries;
use crate::engine::forces::StepForces;
use crate::engine::signal::Signal;
use crate::engine::state::WorldState;
use crate::engine::workspace::StepWorkspace;
use crate::engine::world::{Owner, World};
use crate::kinematics::{Trajectory, TrajectoryError};
use crate::model::{BodyId, CoordinateId, Drive, Joint, Model};
use crate::motion::TimeGrid;
use crate::spatial::{Mat3, Pose, Twist, Vec3, Wrench};
use nalgebra::{Cholesky, DMatrix, DVector};

/// Largest number of recorded steps.
const MOST_ROWS: usize = 1_000_000;
/// Most Newton steps for the coordinates of a joint: they start at the last posture, a step of the scene before.
const NEWTON_STEPS: usize = 4;
/// The coordinates have settled when a Newton step changes them by less [rad or m].
const SETTLED: f64 = 1e-12;
/// Added to the diagonal of JᵀJ, as a share of its largest entry: two axes that coincide (gimbal lock) move alike.
const SINGULAR: f64 = 1e-12;

/// Motion of a figure of a scene that follows a recording, with the forces on it.
#[derive(Debug, Clone)]
pub struct FigureMotion {
    /// Name of the figure.
    pub name: String,
    /// The model at its pose in the scene.
    pub model: Model,
    /// Posture of every step.
    pub trajectory: Trajectory,
    /// Forces of obstacles on bodies of the figure.
    pub ground: Vec<ObstacleForces>,
    /// All forces of the scene on the figure: of obstacles, and of contacts, loops and joints with other bodies.
    pub loads: Vec<LoadSeries>,
}

/// Force of all obstacles on a body, one entry per step.
#[derive(Debug, Clone)]
pub struct ObstacleForces {
    /// The body.
    pub body: BodyId,
    /// Force [N].
    pub force: Vec<Vec3>,
    /// Moment about the world's origin [N.m].
    pub moment: Vec<Vec3>,
    /// Height of the obstacle at the last point of contact, against gravity [m].
    pub height: Vec<f64>,
}

/// A recording under way.
#[derive(Debug, Clone)]
pub(super) struct MotionRecorder {
    name: String,
    model: Model,
    signals: Vec<Signal>,
    /// Whether a coordinate follows its signal.
    follows: Vec<bool>,
    first_body: usize,
    start_s: f64,
    /// Joints with coordinates that follow no signal, which are found from the poses of the bodies.
    passive: Vec<(BodyId, Vec<CoordinateId>)>,
    /// Coordinates and rates at the end of the last recorded step, which is the start of the next: events between steps
    /// move no body.
    now: [Vec<f64>; 2],
    columns: Vec<[Vec<f64>; 3]>,
    /// Force and moment about the world's origin on each body, from obstacles and from everything else.
    of_ground: Vec<Vec<Wrench>>,
    of_others: Vec<Vec<Wrench>>,
    /// Height of the obstacle under each body, the last one known [m].
    heights: Vec<Vec<f64>>,
}

/// The joints of a model, by their body, with free coordinates that follow no signal.
fn passive_joints(model: &Model, follows: &[bool]) -> Vec<(BodyId, Vec<CoordinateId>)> {
    let is_free =
        |id: &CoordinateId| !follows[id.index()] && matches!(model.coordinates()[id.index()].drive, Drive::Free);
    let of = |body: BodyId| {
        let coordinates: Vec<CoordinateId> =
            model.bodies()[body.index()].joint.coordinates().into_iter().filter(is_free).collect();
        (body, coordinates)
    };
    model.body_ids().map(of).filter(|(_, coordinates)| !coordinates.is_empty()).collect()
}

impl MotionRecorder {
    pub(super) fn new(
        name: &str,
        model: &Model,
        signals: Vec<Signal>,
        follows: Vec<bool>,
        first_body: usize,
    ) -> MotionRecorder {
        let (coordinates, bodies) = (model.coordinates().len(), model.bodies().len());
        let start = signals.iter().map(|signal| signal.at(0.0)[0]).collect();
        MotionRecorder {
            name: name.to_owned(),
            model: model.clone(),
            signals,
            passive: passive_joints(model, &follows),
            follows,
            first_body,
            start_s: 0.0,
            now: [start, vec![0.0; coordinates]],
            columns: vec![Default::default(); coordinates],
            of_ground: vec![Vec::new(); bodies],
            of_others: vec![Vec::new(); bodies],
            heights: vec![Vec::new(); bodies],
        }
    }

    fn rows(&self) -> usize {
        self.of_ground.first().map_or(0, Vec::len)
    }

    /// Coordinates and rates now. For coordinates without a signal, the search starts at their last values.
    fn read(&self, state: &WorldState) -> [Vec<f64>; 2] {
        let mut q = self.now[0].clone();
        let mut rates = vec![0.0; q.len()];
        for (id, signal) in self.signals.iter().enumerate().filter(|(id, _)| self.follows[*id]) {
            [q[id], rates[id], _] = signal.at(state.time_s);
        }
        for (body, coordinates) in &self.passive {
            let joint = &self.model.bodies()[body.index()].joint;
            let wanted = self.parent_from_child(*body, state);
            for _ in 0..NEWTON_STEPS {
                let change = least_squares(joint, &q, coordinates, missing(joint, &q, &wanted));
                coordinates.iter().zip(&change).for_each(|(id, d)| q[id.index()] += d);
                if change.iter().all(|d| d.abs() < SETTLED) {
                    break;
                }
            }
            let velocity = self.relative_velocity(*body, state);
            let found = least_squares(joint, &q, coordinates, velocity);
            coordinates.iter().zip(&found).for_each(|(id, rate)| rates[id.index()] = *rate);
        }
        [q, rates]
    }

    /// Pose of a body's frame in the world.
    fn pose(&self, body: BodyId, state: &WorldState) -> Pose {
        let center = self.model.bodies()[body.index()].inertia.center();
        state.poses[self.first_body + body.index()] * Pose::at(-center)
    }

    /// Pose of a body's frame on its parent, or in the world.
    fn parent_from_child(&self, body: BodyId, state: &WorldState) -> Pose {
        let own = self.pose(body, state);
        let parent = self.model.bodies()[body.index()].joint.parent;
        parent.map_or(own, |parent| self.pose(parent, state).inverse() * own)
    }

    /// Angular velocity and velocity of the joint frame of a body relative to the parent, in the axes of the parent.
    fn relative_velocity(&self, body: BodyId, state: &WorldState) -> [Vec3; 2] {
        let joint = &self.model.bodies()[body.index()].joint;
        let frame = self.pose(body, state) * joint.child_from_joint;
        let velocity = |body: BodyId| -> [Vec3; 2] {
            let n = self.first_body + body.index();
            let twist: &Twist = &state.twists[n];
            [twist.angular, twist.velocity_at(frame.translation - state.poses[n].translation)]
        };
        let own = velocity(body);
        let Some(parent) = joint.parent else { return own };
        let of_parent = velocity(parent);
        let turn = self.pose(parent, state).rotation.transpose();
        [0, 1].map(|k| turn * (own[k] - of_parent[k]))
    }

    pub(super) fn before_step(&mut self, state: &WorldState) {
        if self.rows() == 0 {
            self.start_s = state.time_s;
            self.now = self.read(state);
        }
    }

    /// Records a step. The posture belongs to its start; velocities of free coordinates belong to the middle of steps.
    pub(super) fn after_step(
        &mut self,
        world: &World,
        poses: &[Pose],
        state: &WorldState,
        w: &StepWorkspace,
        step_s: f64,
    ) {
        if self.rows() >= MOST_ROWS {
            return;
        }
        let after = self.read(state);
        for (id, columns) in self.columns.iter_mut().enumerate() {
            let values = if self.follows[id] {
                self.signals[id].at(state.time_s - step_s)
            } else {
                let (old, new) = (self.now[1][id], after[1][id]);
                [self.now[0][id], 0.5 * (old + new), (new - old) / step_s]
            };
            columns.iter_mut().zip(values).for_each(|(column, value)| column.push(value));
        }
        self.now = after;
        self.keep_forces(world, poses, &w.forces(world));
    }

    /// The index among the figure's bodies.
    fn own(&self, body: usize) -> Option<usize> {
        body.checked_sub(self.first_body).filter(|index| *index < self.model.bodies().len())
    }

    /// Sums the forces of a step on each body; `poses` are those at its start.
    fn keep_forces(&mut self, world: &World, poses: &[Pose], forces: &StepForces) {
        let up = -world.gravity.normalize();
        for list in [&mut self.of_ground, &mut self.of_others] {
            list.iter_mut().for_each(|rows| rows.push(Wrench::ZERO));
        }
        self.heights.iter_mut().for_each(|rows| rows.push(rows.last().copied().unwrap_or(0.0)));
        for contact in &forces.contacts {
            let owners = [contact.surfaces.0, contact.surfaces.1].map(|surface| world.surfaces[surface].owner);
            for (owner, other, force) in [(owners[0], owners[1], contact.force), (owners[1], owners[0], -contact.force)]
            {
                let Owner::Body(body) = owner else { continue };
                let Some(index) = self.own(body) else { continue };
                let is_ground = matches!(other, Owner::Obstacle(_));
                let list = if is_ground { &mut self.of_ground } else { &mut self.of_others };
                add(&mut list[index], Wrench { moment: contact.point.cross(&force), force });
                if let (true, Some(height)) = (is_ground && force != Vec3::zeros(), self.heights[index].last_mut()) {
                    *height = contact.point.dot(&up);
                }
            }
        }
        for (body, wrench) in self.pulls(world, poses, forces) {
            add(&mut self.of_others[body], wrench);
        }
    }

    /// Wrenches about the world's origin of loops, and of joints to bodies that the figure carries.
    fn pulls(&self, world: &World, poses: &[Pose], forces: &StepForces) -> Vec<(usize, Wrench)> {
        let about_origin = |body: usize, wrench: &Wrench| Wrench {
            moment: wrench.moment + poses[body].translation.cross(&wrench.force),
            force: wrench.force,
        };
        let mut found = Vec::new();
        let mut add_pair = |first: usize, second: Option<usize>, wrench: Wrench| {
            found.extend(self.own(first).map(|index| (index, wrench)));
            let reaction = Wrench { moment: -wrench.moment, force: -wrench.force };
            found.extend(second.and_then(|body| self.own(body)).map(|index| (index, reaction)));
        };
        for (closure, wrench) in &forces.closing {
            let closure = &world.closures[*closure];
            add_pair(closure.first, closure.second, about_origin(closure.first, wrench));
        }
        let between = |child: usize, parent: usize| self.own(child).is_some() != self.own(parent).is_some();
        for joint in &world.joints {
            if let Some(parent) = joint.parent.filter(|parent| between(joint.child, *parent)) {
                add_pair(joint.child, Some(parent), about_origin(joint.child, &forces.joints[joint.child]));
            }
        }
        found
    }

    pub(super) fn motion(&self, step_s: f64) -> Result<FigureMotion, TrajectoryError> {
        let grid = TimeGrid { start_s: self.start_s, step_s, frames: self.rows() };
        let trajectory = Trajectory::new(&self.model, grid, self.columns.clone())?;
        let acts = |rows: &[Wrench]| rows.iter().any(|wrench| *wrench != Wrench::ZERO);
        let touched = self.model.body_ids().filter(|id| acts(&self.of_ground[id.index()]));
        let ground = touched.map(|body| {
            let rows = &self.of_ground[body.index()];
            ObstacleForces {
                body,
                force: rows.iter().map(|wrench| wrench.force).collect(),
                moment: rows.iter().map(|wrench| wrench.moment).collect(),
                height: self.heights[body.index()].clone(),
            }
        });
        let loads =
            self.model.body_ids().flat_map(|id| [(id, &self.of_ground[id.index()]), (id, &self.of_others[id.index()])]);
        let loads = loads.filter(|(_, rows)| acts(rows)).map(|(body, rows)| LoadSeries {
            body,
            points: vec![Vec3::zeros(); rows.len()],
            wrenches: rows.clone(),
        });
        Ok(FigureMotion {
            name: self.name.clone(),
            model: self.model.clone(),
            trajectory,
            ground: ground.collect(),
            loads: loads.collect(),
        })
    }
}

fn add(rows: &mut [Wrench], wrench: Wrench) {
    if let Some(last) = rows.last_mut() {
        last.moment += wrench.moment;
        last.force += wrench.force;
    }
}

/// Rotation and translation of the joint frame of the child that the coordinates lack, in the axes of the parent.
fn missing(joint: &Joint, q: &[f64], wanted: &Pose) -> [Vec3; 2] {
    let wanted = *wanted * joint.child_from_joint;
    let found = joint.parent_from_child(q) * joint.child_from_joint;
    // sin(angle) times the axis: nearly the angle, where steps are small.
    let r: Mat3 = wanted.rotation * found.rotation.transpose();
    let turn = Vec3::new(r[(2, 1)] - r[(1, 2)], r[(0, 2)] - r[(2, 0)], r[(1, 0)] - r[(0, 1)]) * 0.5;
    [turn, wanted.translation - found.translation]
}

/// The changes of coordinates that move a joint by this rotation and translation, in the sense of least squares.
fn least_squares(joint: &Joint, q: &[f64], coordinates: &[CoordinateId], [turn, shift]: [Vec3; 2]) -> Vec<f64> {
    let mut jacobian = DMatrix::zeros(6, coordinates.len());
    for (column, id) in coordinates.iter().enumerate() {
        let [angular, linear] = joint.slopes(q, *id);
        jacobian.fixed_view_mut::<3, 1>(0, column).copy_from(&angular);
        jacobian.fixed_view_mut::<3, 1>(3, column).copy_from(&linear);
    }
    let wanted = DVector::from_iterator(6, turn.iter().chain(shift.iter()).copied());
    let mut square = jacobian.tr_mul(&jacobian);
    let least = SINGULAR * square.diagonal().max();
    (0..coordinates.len()).for_each(|k| square[(k, k)] += least);
    let wanted = jacobian.tr_mul(&wanted);
    Cholesky::new(square).map_or_else(|| vec![0.0; coordinates.len()], |c| c.solve(&wanted).iter().copied().collect())
}
