//! The description of a simulated world: bodies, joints, closures, surfaces, obstacles, and their drives.

use super::joint::JointKind;
use super::signal::Signal;
use crate::contact::{HuntCrossley, Shape};
use crate::kinematics::{Posture, body_motion};
use crate::model::Model;
use crate::spatial::{Mat3, Pose, STANDARD_GRAVITY, Twist, Vec3, Wrench, rotation};

/// Everything that is simulated. Change it only between steps; joints and closures may then be added and removed.
#[derive(Debug, Clone)]
pub struct World {
    /// Acceleration of a freely falling body [m/s²].
    pub gravity: Vec3,
    /// All bodies.
    pub bodies: Vec<RigidBody>,
    /// Joints of the kinematic trees. A body is the child of at most one joint; a body without a joint is free.
    pub joints: Vec<TreeJoint>,
    /// Joints that close loops.
    pub closures: Vec<Closure>,
    /// Solids that forces do not move.
    pub obstacles: Vec<Obstacle>,
    /// Surfaces that may touch.
    pub surfaces: Vec<Surface>,
    /// Materials of the surfaces.
    pub materials: Vec<Material>,
    /// The law of impacts.
    pub impact: ImpactLaw,
    /// Pairs of owners that pass through each other, in addition to bodies that a joint or an active closure connects.
    pub ignored: Vec<(Owner, Owner)>,
    /// Pairs of surfaces that touch each other and nothing else: limbs of one figure. The lower number comes first.
    pub limbs: Vec<(usize, usize)>,
    /// Motions that joints follow.
    pub figures: Vec<Figure>,
}

impl Default for World {
    /// An empty world under standard gravity along -y (9.80665 m/s²).
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
            limbs: Vec::new(),
            figures: Vec::new(),
        }
    }
}

/// A rigid body. The origin of its frame is the mass centre.
#[derive(Debug, Clone)]
pub struct RigidBody {
    /// Name, used in findings and tables.
    pub name: String,
    /// Mass [kg].
    pub mass: f64,
    /// Inertia about the mass centre, body axes [kg.m²].
    pub inertia: Mat3,
    /// `world_from_body` at the start.
    pub pose: Pose,
    /// Twist at the start, world axes.
    pub twist: Twist,
    /// A constant load: moment and force at the mass centre, world axes [N.m, N].
    pub load: Wrench,
}

/// A joint of a kinematic tree: it connects a child body to its parent.
#[derive(Debug, Clone)]
pub struct TreeJoint {
    /// Name, used in findings and tables.
    pub name: String,
    /// The child body.
    pub child: usize,
    /// The parent body; `None` is the world.
    pub parent: Option<usize>,
    /// P on the parent, or in the world.
    pub parent_from_joint: Pose,
    /// C on the child.
    pub child_from_joint: Pose,
    /// The motions that the joint leaves free.
    pub kind: JointKind,
    /// Actuation of each coordinate, in the order of the kind.
    pub coordinates: Vec<JointCoordinate>,
    /// A motion that prescribes all six directions. `kind` is then [`JointKind::Weld`] and is not used.
    pub follows: Option<Follows>,
}

impl TreeJoint {
    /// A joint on whose coordinates nothing acts. `frames` are P on the parent, or in the world, and C on the child.
    #[must_use]
    pub fn free(name: String, kind: JointKind, child: usize, parent: Option<usize>, frames: [Pose; 2]) -> TreeJoint {
        let [parent_from_joint, child_from_joint] = frames;
        let coordinates = vec![JointCoordinate::default(); kind.freedom()];
        TreeJoint { name, child, parent, parent_from_joint, child_from_joint, kind, coordinates, follows: None }
    }
}

/// The body of a figure that a joint's child follows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Follows {
    /// Index of the figure in [`World::figures`].
    pub figure: usize,
    /// Index of the body in the figure's model.
    pub body: usize,
    /// Index of the joint's parent in the figure's model; `None` is ground.
    pub parent: Option<usize>,
}

/// Actuation of one coordinate of a joint. Angles in rad, distances in m.
#[derive(Debug, Clone, Default)]
pub struct JointCoordinate {
    /// Prescribed motion.
    pub drive: Option<JointDrive>,
    /// Pulls towards a fixed value.
    pub spring: Option<Spring>,
    /// Pulls towards a moving value with bounded force.
    pub motor: Option<Motor>,
    /// Lowest and highest value.
    pub limits: (Option<f64>, Option<f64>),
    /// A constant moment or force [N.m or N].
    pub effort: f64,
    /// Largest moment or force of dry friction [N.m or N].
    pub friction: f64,
    /// Inertia of an actuator's rotor [kg.m² or kg].
    pub rotor: f64,
}

impl JointCoordinate {
    /// Whether anything can act on the coordinate; its effort is zero otherwise.
    pub(crate) fn acts(&self) -> bool {
        let limited = self.limits.0.is_some() || self.limits.1.is_some();
        let driven = self.drive.is_some() || self.spring.is_some() || self.motor.is_some();
        driven || limited || self.effort != 0.0 || self.friction > 0.0 || self.rotor > 0.0
    }

    /// Sum of constant effort, spring, damper and motor [N.m or N] at a value and a rate, at an instant [s].
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
    /// The value over time.
    pub signal: Signal,
    /// Largest moment or force [N.m or N]. Beyond it the drive gives way, and a finding reports it.
    pub max: Option<f64>,
}

/// A linear spring with a damper.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spring {
    /// Stiffness [N.m/rad or N/m].
    pub stiffness: f64,
    /// Damping [N.m.s/rad or N.s/m].
    pub damping: f64,
    /// Value at which the spring is at rest [rad or m].
    pub rest: f64,
}

/// A proportional-derivative motor: kp (target - q) + kd (target rate - rate), within ± max.
#[derive(Debug, Clone)]
pub struct Motor {
    /// The value that it pulls towards.
    pub target: Signal,
    /// Stiffness [N.m/rad or N/m].
    pub kp: f64,
    /// Damping [N.m.s/rad or N.s/m].
    pub kd: f64,
    /// Largest moment or force [N.m or N].
    pub max: f64,
}

/// A joint that closes a loop, or by which one body takes hold of another.
#[derive(Debug, Clone)]
pub struct Closure {
    /// Name, used in findings and tables.
    pub name: String,
    /// The first body; its frame is C.
    pub first: usize,
    /// The second body; its frame is P. `None` is the world.
    pub second: Option<usize>,
    /// C on the first body.
    pub first_from_joint: Pose,
    /// P on the second body, or in the world.
    pub second_from_joint: Pose,
    /// The motions that stay free.
    pub kind: JointKind,
    /// Whether the closure is active now.
    pub active: bool,
}

/// A solid that forces do not move.
#[derive(Debug, Clone)]
pub struct Obstacle {
    /// Name, used in findings and tables.
    pub name: String,
    /// `world_from_obstacle` where its path is zero.
    pub pose: Pose,
    /// Prescribed motion; `None` is at rest.
    pub path: Option<ObstaclePath>,
}

/// Prescribed motion of an obstacle: a translation, and a rotation about an axis through its origin.
#[derive(Debug, Clone)]
pub struct ObstaclePath {
    /// Translation along world x, y, z [m].
    pub shift: [Signal; 3],
    /// Unit axis, world.
    pub axis: Vec3,
    /// Angle about the axis [rad].
    pub turn: Signal,
}

impl Obstacle {
    /// Pose, and twist of the origin, at an instant [s].
    #[must_use]
    pub fn at(&self, t: f64) -> (Pose, Twist) {
        let Some(path) = &self.path else { return (self.pose, Twist::ZERO) };
        let [x, y, z] = [0, 1, 2].map(|k| path.shift[k].at(t));
        let [turn, rate, _] = path.turn.at(t);
        let pose = Pose {
            rotation: rotation(&(path.axis * turn)) * self.pose.rotation,
            translation: self.pose.translation + Vec3::new(x[0], y[0], z[0]),
        };
        (pose, Twist { angular: path.axis * rate, linear: Vec3::new(x[1], y[1], z[1]) })
    }
}

/// The body or obstacle that carries a surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Owner {
    /// Index of a body.
    Body(usize),
    /// Index of an obstacle.
    Obstacle(usize),
}

/// A shape on a body or an obstacle.
#[derive(Debug, Clone)]
pub struct Surface {
    /// The body or obstacle that carries the shape.
    pub owner: Owner,
    /// The shape.
    pub shape: Shape,
    /// Pose of the shape on its owner.
    pub owner_from_shape: Pose,
    /// Index of the material in [`World::materials`].
    pub material: usize,
}

/// Impact law: the velocity of a contact point after it strikes another surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ImpactLaw {
    /// Restitution decides the normal velocity; Coulomb's law decides the tangential impulse, as it does for forces.
    /// Impacts are part of the step in which surfaces meet.
    #[default]
    Coulomb,
    /// The whole velocity is cancelled, tangential part included, whatever the friction (section 3.3 of the 1997
    /// paper). Surfaces touch once their gap has closed. A point that was not in contact before strikes at a separate
    /// instant, while points at rest obey Coulomb's law; the step then continues from there. `StepWorkspace::impacts`
    /// lists the impacts, separately from the forces. Restitution has no effect, and compliant materials have no
    /// impacts. Only [`Integrator::Impulse`](super::Integrator::Impulse) supports this law.
    Sticking,
}

/// Contact properties of a surface. A pair of surfaces has the geometric mean of the frictions, the larger restitution
/// and the softer of the two laws.
#[derive(Debug, Clone, PartialEq)]
pub struct Material {
    /// Coefficient of friction μ.
    pub friction: f64,
    /// Coefficient of restitution e.
    pub restitution: f64,
    /// Law of the normal force.
    pub law: ContactLaw,
}

impl Default for Material {
    /// Rigid, friction 0.8, no restitution (the paper's default).
    fn default() -> Self {
        Material { friction: 0.8, restitution: 0.0, law: ContactLaw::Rigid }
    }
}

/// Law of the normal contact force.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ContactLaw {
    /// Surfaces do not overlap.
    Rigid,
    /// A spring and damper inside the constraint: the force follows the overlap, and Coulomb's cone is exact.
    Regularised {
        /// Stiffness of one contact point [N/m].
        stiffness: f64,
        /// Damping of one contact point [N.s/m].
        damping: f64,
    },
    /// Hunt and Crossley's law of a sphere on a plane, with its own smooth friction.
    HuntCrossley(HuntCrossley),
}

/// A model and its motion, which joints of the world can follow.
#[derive(Debug, Clone)]
pub struct Figure {
    /// The model.
    pub model: Model,
    /// One signal per coordinate of the model, in its order.
    pub coordinates: Vec<Signal>,
}

impl Figure {
    /// Pose in ground of the mass centre frame of every body at an instant; its axes are the axes of the model's
    /// bodies.
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
    /// Index of the joint that carries each body.
    #[must_use]
    pub(crate) fn joint_of_body(&self) -> Vec<Option<usize>> {
        let mut joints = vec![None; self.bodies.len()];
        for (number, joint) in self.joints.iter().enumerate() {
            joints[joint.child] = Some(number);
        }
        joints
    }

    /// For each body, whether joints lead from it inwards to `root`, or it is `root`.
    pub(crate) fn carried_by(&self, root: usize) -> Vec<bool> {
        let joint_of = self.joint_of_body();
        let inwards = |body: usize| joint_of[body].and_then(|joint| self.joints[joint].parent);
        let path = |body: usize| std::iter::successors(Some(body), |body| inwards(*body)).take(self.bodies.len());
        (0..self.bodies.len()).map(|body| path(body).any(|on_path| on_path == root)).collect()
    }

    /// Total mass of all bodies [kg].
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
