//! What a simulation is made of: bodies, joints, closures, shapes, obstacles and what drives them.

use super::joint::JointKind;
use super::signal::Signal;
use crate::contact::{HuntCrossley, Shape};
use crate::kinematics::{Posture, body_motion};
use crate::model::Model;
use crate::spatial::{Mat3, Pose, STANDARD_GRAVITY, Twist, Vec3, Wrench};

/// Everything that can move or be touched. Changed only between steps: joints and closures may come and go.
#[derive(Debug, Clone)]
pub struct World {
    /// Acceleration of a body that nothing holds [m/s²].
    pub gravity: Vec3,
    /// All bodies.
    pub bodies: Vec<RigidBody>,
    /// Joints of the trees: each body is the child of one at most; one without is free.
    pub joints: Vec<TreeJoint>,
    /// Joints that close loops.
    pub closures: Vec<Closure>,
    /// Bodies that forces do not move.
    pub obstacles: Vec<Obstacle>,
    /// Shapes that may touch.
    pub surfaces: Vec<Surface>,
    /// What surfaces are made of.
    pub materials: Vec<Material>,
    /// What becomes of the velocity of a point that strikes another one.
    pub impact: ImpactLaw,
    /// Pairs of owners that pass through each other, beside bodies that a joint or an active closure connects.
    pub ignored: Vec<(Owner, Owner)>,
    /// Recordings that joints follow.
    pub figures: Vec<Figure>,
}

impl Default for World {
    /// Nothing, under standard gravity along -y (9.80665 m/s²).
    fn default() -> Self {
        World {
            gravity: Vec3::new(0.0, -STANDARD_GRAVITY, 0.0),
            bodies: Vec::new(),
            joints: Vec::new(),
            closures: Vec::new(),
            obstacles: Vec::new(),
            surfaces: Vec::new(),
            materials: Vec::new(),
            impact: ImpactLaw::Coulomb,
            ignored: Vec::new(),
            figures: Vec::new(),
        }
    }
}

/// A rigid body; its frame has the origin at the mass centre.
#[derive(Debug, Clone)]
pub struct RigidBody {
    /// Name, for findings and tables.
    pub name: String,
    /// Mass [kg].
    pub mass: f64,
    /// Inertia about the mass centre, body axes [kg.m²].
    pub inertia: Mat3,
    /// `world_from_body` at the start.
    pub pose: Pose,
    /// Motion at the start, world axes.
    pub twist: Twist,
    /// A load that acts until it is changed: moment and force at the mass centre, world axes [N.m, N].
    pub load: Wrench,
}

/// A joint between a child and its parent.
#[derive(Debug, Clone)]
pub struct TreeJoint {
    /// Name, for findings and tables.
    pub name: String,
    /// The body that hangs on it.
    pub child: usize,
    /// What it hangs on; `None` is ground.
    pub parent: Option<usize>,
    /// P on the parent, or in the world.
    pub parent_from_joint: Pose,
    /// C on the child.
    pub child_from_joint: Pose,
    /// Which motions are free.
    pub kind: JointKind,
    /// What acts on each coordinate, in the kind's order.
    pub coordinates: Vec<JointCoordinate>,
    /// A recording that prescribes all six directions; then `kind` is [`JointKind::Weld`] and plays no other part.
    pub follows: Option<Follows>,
}

/// Which body of which figure a joint's child follows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Follows {
    /// The figure.
    pub figure: usize,
    /// The body of its model.
    pub body: usize,
    /// The body of its model that the joint's parent is; `None` is ground.
    pub parent: Option<usize>,
}

/// What acts on one coordinate of a joint. Angles in rad, distances in m.
#[derive(Debug, Clone, Default)]
pub struct JointCoordinate {
    /// Prescribes it.
    pub drive: Option<JointDrive>,
    /// Pulls it towards a place.
    pub spring: Option<Spring>,
    /// Pulls it towards a moving place, with bounded force.
    pub motor: Option<Motor>,
    /// Lowest and highest value.
    pub limits: (Option<f64>, Option<f64>),
    /// A force that acts until it is changed [N.m or N].
    pub effort: f64,
    /// Dry friction [N.m or N].
    pub friction: f64,
    /// Inertia of a rotor [kg.m² or kg].
    pub rotor: f64,
}

impl JointCoordinate {
    /// Effort of force, spring, damper and motor at a value and rate, at an instant [s].
    pub(crate) fn smooth_effort(&self, q: f64, rate: f64, t: f64) -> f64 {
        let spring = self.spring.map_or(0.0, |s| s.stiffness * (s.rest - q) - s.damping * rate);
        let motor = self.motor.as_ref().map_or(0.0, |m| {
            let [target, target_rate, _] = m.target.at(t);
            (m.kp * (target - q) + m.kd * (target_rate - rate)).clamp(-m.max, m.max)
        });
        self.effort + spring + motor
    }
}

/// Prescribed motion of a coordinate.
#[derive(Debug, Clone)]
pub struct JointDrive {
    /// What it follows.
    pub signal: Signal,
    /// Largest force [N.m or N]: beyond it the drive gives way, and a finding says so.
    pub max: Option<f64>,
}

/// A linear spring with a damper.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spring {
    /// [N.m/rad or N/m].
    pub stiffness: f64,
    /// [N.m.s/rad or N.s/m].
    pub damping: f64,
    /// Where it is at rest [rad or m].
    pub rest: f64,
}

/// A proportional-derivative motor: kp (target - q) + kd (target rate - rate), within ± max.
#[derive(Debug, Clone)]
pub struct Motor {
    /// Where it wants to be.
    pub target: Signal,
    /// [N.m/rad or N/m].
    pub kp: f64,
    /// [N.m.s/rad or N.s/m].
    pub kd: f64,
    /// Largest force [N.m or N].
    pub max: f64,
}

/// A joint that closes a loop, or that one body takes hold of another with.
#[derive(Debug, Clone)]
pub struct Closure {
    /// Name, for findings and tables.
    pub name: String,
    /// One body; its frame is C.
    pub first: usize,
    /// The other one, whose frame is P; `None` is ground.
    pub second: Option<usize>,
    /// C on the first body.
    pub first_from_joint: Pose,
    /// P on the second body, or in the world.
    pub second_from_joint: Pose,
    /// Which motions stay free.
    pub kind: JointKind,
    /// Whether it holds now.
    pub active: bool,
}

/// Something solid that forces do not move.
#[derive(Debug, Clone)]
pub struct Obstacle {
    /// Name, for findings and tables.
    pub name: String,
    /// `world_from_obstacle` where its path is zero.
    pub pose: Pose,
    /// Where it goes; `None` stays.
    pub path: Option<ObstaclePath>,
}

/// Prescribed motion of an obstacle: a shift, and a turn about an axis through its origin.
#[derive(Debug, Clone)]
pub struct ObstaclePath {
    /// Shift along world x, y, z [m].
    pub shift: [Signal; 3],
    /// Unit axis, world.
    pub axis: Vec3,
    /// Turn about it [rad].
    pub turn: Signal,
}

impl Obstacle {
    /// Pose and twist of its origin at an instant [s].
    #[must_use]
    pub fn at(&self, t: f64) -> (Pose, Twist) {
        let Some(path) = &self.path else { return (self.pose, Twist::ZERO) };
        let [x, y, z] = [0, 1, 2].map(|k| path.shift[k].at(t));
        let [turn, rate, _] = path.turn.at(t);
        let pose = Pose {
            rotation: super::joint::rotation(&(path.axis * turn)) * self.pose.rotation,
            translation: self.pose.translation + Vec3::new(x[0], y[0], z[0]),
        };
        (pose, Twist { angular: path.axis * rate, linear: Vec3::new(x[1], y[1], z[1]) })
    }
}

/// Who carries a surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Owner {
    /// A body.
    Body(usize),
    /// An obstacle.
    Obstacle(usize),
}

/// A shape on a body or an obstacle.
#[derive(Debug, Clone)]
pub struct Surface {
    /// Who carries it.
    pub owner: Owner,
    /// Its form.
    pub shape: Shape,
    /// Where on the owner.
    pub owner_from_shape: Pose,
    /// Which material.
    pub material: usize,
}

/// What becomes of the velocity of a point that strikes another one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ImpactLaw {
    /// Along the normal, restitution says; across it, Coulomb's law holds for impulses as for forces. Impacts are part of the
    /// step in which surfaces meet.
    #[default]
    Coulomb,
    /// All of it is cancelled, along the surfaces too, whatever the friction (the paper's rule, section 3.3). Surfaces touch
    /// once their gap has closed; a point that was not in touch before then strikes at an instant of its own, those that
    /// rest obeying Coulomb's law, and the step goes on from there. The impacts are in `StepWorkspace::impacts`, apart from
    /// the forces. Restitution plays no part; materials that give do not strike. Only steps of impulses know it.
    Sticking,
}

/// How a surface answers to touch. Two surfaces share the geometric mean of their frictions and the larger restitution; the
/// softer law of the two holds.
#[derive(Debug, Clone, PartialEq)]
pub struct Material {
    /// Coefficient of friction μ.
    pub friction: f64,
    /// Coefficient of restitution e.
    pub restitution: f64,
    /// Normal law.
    pub law: ContactLaw,
}

impl Default for Material {
    /// Rigid, friction 0.8, no restitution (the paper's default).
    fn default() -> Self {
        Material { friction: 0.8, restitution: 0.0, law: ContactLaw::Rigid }
    }
}

/// How a normal force arises.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ContactLaw {
    /// No overlap.
    Rigid,
    /// A spring and damper inside the constraint: the force follows the overlap, Coulomb's cone holds exactly.
    Regularised {
        /// [N/m] of one contact point.
        stiffness: f64,
        /// [N.s/m].
        damping: f64,
    },
    /// Hunt and Crossley's sphere on a plane, with its own smooth friction.
    HuntCrossley(HuntCrossley),
}

/// A recording that joints follow.
#[derive(Debug, Clone)]
pub struct Figure {
    /// The body.
    pub model: Model,
    /// One signal a coordinate of the model, in its order.
    pub coordinates: Vec<Signal>,
}

impl Figure {
    /// `ground_from_mass-centre frame` of every body of the model at an instant; axes are the model's own body axes.
    #[must_use]
    pub fn poses(&self, t: f64) -> Vec<Pose> {
        let values: Vec<[f64; 3]> = self.coordinates.iter().map(|signal| signal.at(t)).collect();
        let [q, qd, qdd] = [0, 1, 2].map(|k| values.iter().map(|v| v[k]).collect::<Vec<f64>>());
        body_motion(&self.model, Posture { q: &q, qd: &qd, qdd: &qdd })
            .into_iter()
            .map(|m| Pose { rotation: m.pose.rotation, translation: m.center })
            .collect()
    }
}

impl World {
    /// The joint that each body hangs on.
    #[must_use]
    pub fn joint_of_body(&self) -> Vec<Option<usize>> {
        let mut joints = vec![None; self.bodies.len()];
        for (number, joint) in self.joints.iter().enumerate() {
            joints[joint.child] = Some(number);
        }
        joints
    }

    /// Mass of all bodies [kg].
    #[must_use]
    pub fn mass(&self) -> f64 {
        self.bodies.iter().map(|b| b.mass).sum()
    }

    /// Name of a surface's owner.
    #[must_use]
    pub fn owner_name(&self, owner: Owner) -> &str {
        match owner {
            Owner::Body(body) => &self.bodies[body].name,
            Owner::Obstacle(obstacle) => &self.obstacles[obstacle].name,
        }
    }
}
