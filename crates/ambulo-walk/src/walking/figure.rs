//! A walking figure in the sagittal plane, as bodies, joints and soles of a world.

use crate::contact::{HuntCrossley, ShapeError};
use crate::dynamics::LinkError;
use crate::engine::soles::{add_level_ground, add_soles, lowest};
use crate::engine::{
    ContactLaw, ImpactLaw, JointCoordinate, JointDrive, JointKind, Material, RigidBody, Signal, TreeJoint, World,
    WorldError, WorldState,
};
use crate::kinematics::{BodyMotion, Posture, TrajectoryError, body_motion};
use crate::model::anthropometry::Human;
use crate::model::{Body, BodyId, CoordinateId, Displacement, Function, JointAxis, Model, Side};
use crate::spatial::{Mat3, Pose, Twist, Vec3, Wrench};

/// Tolerance for rounding of directions.
const SLACK: f64 = 1e-9;

/// Material of the soles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Shoes {
    /// Rigid soles.
    Rigid,
    /// A spring and a damper under each sphere, with exact Coulomb friction.
    Regularised {
        /// Stiffness [N/m].
        stiffness: f64,
        /// Damping [N.s/m].
        damping: f64,
    },
    /// Hunt and Crossley's law, with its own friction.
    HuntCrossley(HuntCrossley),
}

/// Contact between figure and ground.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GroundContact {
    /// Coefficient of friction μ; not used by Hunt and Crossley's law.
    pub friction: f64,
    /// Material of the soles.
    pub shoes: Shoes,
    /// Impact law of the soles.
    pub impact: ImpactLaw,
}

/// The joint coordinate of the world for a coordinate of the model.
#[derive(Debug, Clone, Copy)]
pub(super) struct Placed {
    pub(super) joint: usize,
    pub(super) coordinate: usize,
    /// +1, or -1 if the model counts in the opposite direction.
    pub(super) sense: f64,
}

/// A figure on flat ground (y = 0), ready to walk.
#[derive(Debug, Clone)]
pub struct Walker {
    /// The world. Bodies have the model's order, and body n is the child of joint n. Surfaces are the soles in their
    /// order, then the ground.
    pub world: World,
    pub(super) model: Model,
    /// One signal per coordinate of the model.
    pub(super) signals: Vec<Signal>,
    /// The joint coordinate of each coordinate of the model.
    pub(super) placed: Vec<Placed>,
    /// Side of the sole that each surface is; `None` for the ground.
    pub(super) sides: Vec<Option<Side>>,
    /// The body that carries each foot's heel, right and left.
    pub(super) feet: [BodyId; 2],
    /// The other body of each foot that has soles (the toes), right and left.
    pub(super) toes: [Option<BodyId>; 2],
    /// Accelerations of the bodies at the start, if the motion before it is known.
    accelerations: Vec<Twist>,
}

impl Walker {
    /// Places a figure on the ground in the posture of its signals at time zero, with the mid-hip above x = 0 and
    /// moving forwards at `speed_m_s`. `signals` has one entry per coordinate of the model [rad]; entries of the root's
    /// translations are not used.
    ///
    /// # Errors
    /// If the model is not planar, or the number of signals does not match.
    pub fn new(
        human: &Human,
        signals: Vec<Signal>,
        ground: &GroundContact,
        speed_m_s: f64,
    ) -> Result<Walker, WalkingError> {
        let model = human.model.clone();
        let expected = model.coordinates().len();
        if signals.len() != expected {
            return Err(WalkingError::Signals { found: signals.len(), expected });
        }
        let mut walker = Walker {
            world: World { gravity: model.gravity(), impact: ground.impact, ..World::default() },
            placed: vec![Placed { joint: 0, coordinate: 0, sense: 1.0 }; expected],
            sides: Vec::new(),
            feet: [BodyId(0); 2],
            toes: [None; 2],
            accelerations: Vec::new(),
            model,
            signals,
        };
        walker.add_joints()?;
        walker.add_soles(human, ground)?;
        let motions = walker.start(human, speed_m_s);
        walker.add_bodies(&motions);
        walker.world.check()?;
        Ok(walker)
    }

    /// Moves the whole figure so that its mid-hip is at a position [m] and moves with a velocity [m/s].
    #[must_use]
    pub(crate) fn starting_at(mut self, mid_hip: Vec3, velocity: Vec3) -> Walker {
        let joint = &self.world.joints[0];
        let root = &self.world.bodies[joint.child];
        let to_hip = root.pose.rotation * joint.child_from_joint.translation;
        let shift = mid_hip - (root.pose.translation + to_hip);
        let gain = velocity - root.twist.velocity_at(to_hip);
        for body in &mut self.world.bodies {
            body.pose.translation += shift;
            body.twist.linear += gain;
        }
        self
    }

    /// States that the walk also exists before its start, where it has this posture with rates and accelerations of all
    /// coordinates.
    ///
    /// The simulator stores velocities at the middle of a time step, so the walk starts with velocities of half a step
    /// earlier. Otherwise the first step has half of the change of velocity, and its joint forces lack half of the
    /// forces of inertia.
    #[must_use]
    pub(crate) fn moving_as(mut self, [q, qd, qdd]: &[Vec<f64>; 3]) -> Walker {
        let motions = body_motion(&self.model, Posture { q, qd, qdd });
        self.accelerations = motions.iter().map(|motion| motion.acceleration).collect();
        self
    }

    /// The state at the start of a walk in steps of `step_s`.
    pub(super) fn state(&self, world: &World, step_s: f64) -> WorldState {
        let mut state = WorldState::new(world);
        for (twist, acceleration) in state.twists.iter_mut().zip(&self.accelerations) {
            *twist = half_a_step_earlier(*twist, *acceleration, step_s);
        }
        state
    }

    /// The figure's model.
    #[must_use]
    pub fn model(&self) -> &Model {
        &self.model
    }

    fn add_joints(&mut self) -> Result<(), WalkingError> {
        for id in self.model.body_ids() {
            let body = &self.model.bodies()[id.index()];
            let joint = match body.joint.parent {
                None => self.root(id, body)?,
                Some(_) => self.hinge(id, body)?,
            };
            for (coordinate, (model, sense)) in joint.1.into_iter().enumerate() {
                self.placed[model.index()] = Placed { joint: id.index(), coordinate, sense };
            }
            self.world.joints.push(joint.0);
        }
        Ok(())
    }

    /// The root joint: free translations along x and y, a driven rotation about z.
    fn root(&self, id: BodyId, body: &Body) -> Result<JointInModel, WalkingError> {
        let [turn] = moving(body, &body.joint.rotations, [Vec3::z()])?;
        let [x, y] = moving(body, &body.joint.translations, [Vec3::x(), Vec3::y()])?;
        let free = JointCoordinate::default;
        let coordinates = vec![free(), free(), self.driven(turn)];
        Ok((self.joint(id, body, JointKind::Planar, coordinates), vec![x, y, turn]))
    }

    fn hinge(&self, id: BodyId, body: &Body) -> Result<JointInModel, WalkingError> {
        let [turn] = moving(body, &body.joint.rotations, [Vec3::z()])?;
        let [] = moving(body, &body.joint.translations, [])?;
        Ok((self.joint(id, body, JointKind::Revolute, vec![self.driven(turn)]), vec![turn]))
    }

    fn joint(&self, id: BodyId, body: &Body, kind: JointKind, coordinates: Vec<JointCoordinate>) -> TreeJoint {
        let from_center = |body: BodyId| Pose::at(-self.model.bodies()[body.index()].inertia.center());
        let parent = body.joint.parent;
        TreeJoint {
            name: body.joint.name.clone(),
            child: id.index(),
            parent: parent.map(BodyId::index),
            parent_from_joint: parent.map_or(Pose::IDENTITY, from_center) * body.joint.parent_from_joint,
            child_from_joint: from_center(id) * body.joint.child_from_joint,
            kind,
            coordinates,
            follows: None,
        }
    }

    fn driven(&self, (id, sense): (CoordinateId, f64)) -> JointCoordinate {
        let own = &self.signals[id.index()];
        let turned = Function::Linear { slope: sense, intercept: 0.0 };
        let signal = if sense > 0.0 { own.clone() } else { Signal::Of(turned, Box::new(own.clone())) };
        JointCoordinate { drive: Some(JointDrive { signal, max: None }), ..JointCoordinate::default() }
    }

    fn add_soles(&mut self, human: &Human, ground: &GroundContact) -> Result<(), WalkingError> {
        self.world.materials.push(sole_material(ground));
        let soles = add_soles(&mut self.world, human, 0, 0)?;
        add_level_ground(&mut self.world, 0);
        self.sides = soles.into_iter().map(|(_, side)| Some(side)).chain([None]).collect();
        for (k, side) in Side::BOTH.into_iter().enumerate() {
            let mut bodies = human.soles.iter().filter(|sole| sole.side == side).map(|sole| sole.body);
            if let Some(heel) = bodies.next() {
                self.feet[k] = heel;
                self.toes[k] = bodies.find(|body| *body != heel);
            }
        }
        Ok(())
    }

    /// Motions of the bodies at time zero, with the lowest sole on the ground.
    fn start(&self, human: &Human, speed_m_s: f64) -> Vec<BodyMotion> {
        let values: Vec<[f64; 3]> = self.signals.iter().map(|signal| signal.at(0.0)).collect();
        let [mut q, mut qd, qdd] = [0, 1, 2].map(|k| values.iter().map(|v| v[k]).collect::<Vec<f64>>());
        let of_root = |coordinate: usize| self.placed.iter().position(|p| (p.joint, p.coordinate) == (0, coordinate));
        let (x, y) = (of_root(0), of_root(1));
        for (slide, speed) in [(x, speed_m_s), (y, 0.0)] {
            if let Some(slide) = slide {
                (q[slide], qd[slide]) = (0.0, self.placed[slide].sense * speed);
            }
        }
        let at = |q: &[f64]| body_motion(&self.model, Posture { q, qd: &qd, qdd: &qdd });
        let motions = at(&q);
        let lowest = lowest(&human.soles, &motions);
        if let (Some(y), true) = (y, lowest.is_finite()) {
            q[y] = -self.placed[y].sense * lowest;
        }
        at(&q)
    }

    fn add_bodies(&mut self, motions: &[BodyMotion]) {
        for (body, motion) in self.model.bodies().iter().zip(motions) {
            self.world.bodies.push(RigidBody {
                name: body.name.clone(),
                mass: body.inertia.mass(),
                inertia: body.inertia.about_center(),
                pose: Pose { rotation: motion.pose.rotation, translation: motion.center },
                twist: motion.twist,
                load: Wrench::ZERO,
            });
        }
    }
}

/// Material of soles and ground.
pub(crate) fn sole_material(ground: &GroundContact) -> Material {
    let law = match ground.shoes {
        Shoes::Rigid => ContactLaw::Rigid,
        Shoes::Regularised { stiffness, damping } => ContactLaw::Regularised { stiffness, damping },
        Shoes::HuntCrossley(law) => ContactLaw::HuntCrossley(law),
    };
    Material { friction: ground.friction, restitution: 0.0, law }
}

/// Velocity of a body half a time step earlier.
pub(crate) fn half_a_step_earlier(twist: Twist, acceleration: Twist, step_s: f64) -> Twist {
    let half_s = 0.5 * step_s;
    Twist {
        angular: twist.angular - acceleration.angular * half_s,
        linear: twist.linear - acceleration.linear * half_s,
    }
}

/// Why a figure could not walk.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum WalkingError {
    /// A joint that moves out of the plane.
    #[error(
        "joint `{joint}`: {found}; expected one hinge about z, and for the root a turn about z with slides along x and \
         y"
    )]
    Joint {
        /// The joint.
        joint: String,
        /// Found value.
        found: String,
    },
    /// The number of signals differs from the number of coordinates.
    #[error("found {found} signals for {expected} coordinates; expected one per coordinate")]
    Signals {
        /// Number of signals.
        found: usize,
        /// Number of coordinates.
        expected: usize,
    },
    /// A machine that drives a coordinate that the model does not have.
    #[error("the machine `{machine}` drives the coordinate `{found}`; expected one of {expected}")]
    Coordinate {
        /// Name of the machine.
        machine: String,
        /// The coordinate.
        found: String,
        /// Coordinates of the model.
        expected: String,
    },
    /// A machine that reads an angle that the model does not have.
    #[error(
        "the machine `{machine}` reads the angle `{found}`; expected a joint such as 'left knee', or one of {expected}"
    )]
    Angle {
        /// Name of the machine.
        machine: String,
        /// The angle.
        found: String,
        /// Coordinates of the model.
        expected: String,
    },
    /// A machine that reads a signal that does not exist.
    #[error(
        "the machine `{machine}` reads the signal `{found}`; expected {expected}. hint: joints of a scene are signals; \
         a walk without a scene has none"
    )]
    Signal {
        /// Name of the machine.
        machine: String,
        /// The signal.
        found: String,
        /// Signals that exist.
        expected: String,
    },
    /// Torques of a coordinate that no drive moves.
    #[error("found torques of the coordinate `{found}`; expected joints among {expected}")]
    Torque {
        /// The coordinate.
        found: String,
        /// Coordinates of the model.
        expected: String,
    },
    /// A duration without a whole step.
    #[error("{duration_s} s in steps of {step_s} s; expected at least one whole step")]
    Duration {
        /// Duration [s].
        duration_s: f64,
        /// Time step [s].
        step_s: f64,
    },
    /// A walk with more time steps than fit into memory.
    #[error(
        "a walk of {duration_s:.1} s in steps of {step_s} s; expected at most {most} steps, because of memory. hint: \
         compute fewer cycles or a lower frame rate"
    )]
    TooLong {
        /// Duration [s].
        duration_s: f64,
        /// Time step [s].
        step_s: f64,
        /// Largest allowed number of steps.
        most: usize,
    },
    /// A sole with an invalid radius.
    #[error(transparent)]
    Sole(#[from] ShapeError),
    /// An invalid world.
    #[error(transparent)]
    World(#[from] WorldError),
    /// Joints that do not form trees.
    #[error(transparent)]
    Link(#[from] LinkError),
    /// Motion that is not a finite number.
    #[error("the simulated motion is not a finite number")]
    Motion(#[from] TrajectoryError),
}

/// A joint, and for each of its coordinates the coordinate of the model with its sense.
type JointInModel = (TreeJoint, Vec<(CoordinateId, f64)>);

/// The coordinates that move the expected axes, in the order of the axes; an error if anything else moves.
fn moving<const N: usize>(
    body: &Body,
    axes: &[JointAxis],
    expected: [Vec3; N],
) -> Result<[(CoordinateId, f64); N], WalkingError> {
    let wrong = |found: &str| WalkingError::Joint { joint: body.joint.name.clone(), found: found.to_owned() };
    let level = (body.joint.parent_from_joint.rotation - Mat3::identity()).amax() <= SLACK;
    if !level {
        return Err(wrong("its frame is rotated relative to the parent's"));
    }
    let mut found = [None; N];
    for axis in axes {
        let Displacement::Follows(id, function) = &axis.displacement else {
            return Err(wrong("an axis has a fixed value"));
        };
        let slope = match function.as_linear() {
            Some((slope, intercept)) if (slope.abs() - 1.0).abs() <= SLACK && intercept.abs() <= SLACK => slope,
            _ => return Err(wrong("an axis is a curved function of its coordinate")),
        };
        let place = expected.iter().position(|e| (e.dot(&axis.direction).abs() - 1.0).abs() <= SLACK);
        let Some(place) = place else { return Err(wrong("an axis is outside the plane")) };
        found[place] = Some((*id, slope * expected[place].dot(&axis.direction)));
    }
    let mut all = [(CoordinateId(0), 1.0); N];
    for (one, found) in all.iter_mut().zip(found) {
        *one = found.ok_or_else(|| wrong("an axis is missing"))?;
    }
    Ok(all)
}
