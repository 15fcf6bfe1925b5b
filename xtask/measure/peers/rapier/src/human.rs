//! The human standing on a plane: read from an MJCF file, held upright by springs in its joints.
//!
//! Of MJCF only what that file uses is understood: nested bodies with a position, `inertial`, hinge `joint`s through
//! the body's origin with `axis`, `stiffness` and `damping`, and `geom` spheres; the floor is the plane z = 0.
//!
//! A body with one hinge becomes a revolute joint; one with two or three becomes one joint with as many free rotations,
//! each with a spring. For small angles that is the same device as MuJoCo's hinges in a row.

use crate::rapier::prelude::*;
use crate::scene::{GRAVITY, Inertial, Scene, hinge_about, vector};
use roxmltree::Node;
use std::collections::BTreeMap;

/// Half the width and the thickness of the floor [m].
const FLOOR_M: [f64; 2] = [50.0, 1.0];
/// Soles and floor touch each other, and nothing else touches anything.
const FLOOR_GROUP: Group = Group::GROUP_1;
const SOLE_GROUP: Group = Group::GROUP_2;
/// A contact sticks when it carries more than this part of the weight, and friction stays below this part of its limit.
const CARRIES: f64 = 1e-3;
const WITHIN_CONE: f64 = 0.95;
/// The rotations of a joint, as axis in the body and as Rapier's name and mask.
const ROTATIONS: [([f64; 3], JointAxis, JointAxesMask); 3] = [
    ([1.0, 0.0, 0.0], JointAxis::AngX, JointAxesMask::ANG_X),
    ([0.0, 1.0, 0.0], JointAxis::AngY, JointAxesMask::ANG_Y),
    ([0.0, 0.0, 1.0], JointAxis::AngZ, JointAxesMask::ANG_Z),
];

/// A sphere of the soles.
struct Sphere {
    collider: ColliderHandle,
    body: RigidBodyHandle,
    radius: f64,
    friction: f64,
}

/// The scene, and what is measured on it.
pub struct Human {
    pub scene: Scene,
    pelvis: RigidBodyHandle,
    spheres: Vec<Sphere>,
    pub weight_n: f64,
    /// Of the free pelvis and all hinges of the file.
    pub degrees_of_freedom: usize,
}

/// What the soles did in one step.
pub struct Stance {
    /// Upward force of the floor [N].
    pub force_n: f64,
    /// Spheres that carry something.
    pub contacts: usize,
    /// Horizontal velocity of the lowest point of each sphere that sticks [m/s], by its number.
    pub sticking: Vec<(usize, [f64; 2])>,
}

impl Human {
    /// Reads the model from the text of an MJCF file.
    pub fn read(text: &str) -> Result<Human, String> {
        let document = roxmltree::Document::parse(text).map_err(|e| e.to_string())?;
        let tag = |node: &Node<'_, '_>, name: &str| node.has_tag_name(name);
        let worldbody = document.descendants().find(|node| tag(node, "worldbody")).ok_or("no <worldbody>")?;
        let friction = worldbody.children().find(|node| tag(node, "geom")).map(|geom| first_number(geom, "friction"));
        let pelvis = worldbody.children().find(|node| tag(node, "body")).ok_or("no <body>")?;
        let mut scene = Scene::empty();
        let floor = ColliderBuilder::cuboid(FLOOR_M[0] as Real, FLOOR_M[0] as Real, FLOOR_M[1] as Real)
            .translation(vector([0.0, 0.0, -FLOOR_M[1]]))
            .friction(friction.ok_or("no floor")?? as Real)
            .collision_groups(InteractionGroups::new(FLOOR_GROUP, SOLE_GROUP, InteractionTestMode::And));
        scene.world.insert_collider(floor, Some(scene.ground));
        let root = scene.ground;
        let mut human = Human { scene, pelvis: root, spheres: Vec::new(), weight_n: 0.0, degrees_of_freedom: 6 };
        human.pelvis = human.add(pelvis, None, [0.0; 3])?;
        Ok(human)
    }

    /// Adds a body, its joint to the parent, its spheres, then all bodies below it.
    fn add(
        &mut self,
        node: Node<'_, '_>,
        parent: Option<RigidBodyHandle>,
        origin: [f64; 3],
    ) -> Result<RigidBodyHandle, String> {
        let in_parent = three(node, "pos")?;
        let position = [0, 1, 2].map(|i| origin[i] + in_parent[i]);
        let inertial = node.children().find(|child| child.has_tag_name("inertial"));
        let inertial = inertial.ok_or_else(|| format!("no <inertial> in line {}", line(node)))?;
        let mass = first_number(inertial, "mass")?;
        let com = three(inertial, "pos")?;
        let body = self.scene.body(position, Inertial { mass, com, inertia: three(inertial, "diaginertia")? });
        self.weight_n += mass * GRAVITY;
        if let Some(parent) = parent {
            self.scene.join([parent, body], [in_parent, [0.0; 3]], sprung_joint(node)?);
        }
        for child in node.children() {
            match child.tag_name().name() {
                "joint" => self.degrees_of_freedom += 1,
                "geom" => self.add_sphere(child, body)?,
                "body" => {
                    self.add(child, Some(body), position)?;
                }
                _ => {}
            }
        }
        Ok(body)
    }

    fn add_sphere(&mut self, geom: Node<'_, '_>, body: RigidBodyHandle) -> Result<(), String> {
        if geom.attribute("type") != Some("sphere") {
            return Err(format!("the geom in line {} is not a sphere", line(geom)));
        }
        let (radius, friction) = (first_number(geom, "size")?, first_number(geom, "friction")?);
        let ball = ColliderBuilder::ball(radius as Real)
            .translation(vector(three(geom, "pos")?))
            .density(0.0)
            .friction(friction as Real)
            .collision_groups(InteractionGroups::new(SOLE_GROUP, FLOOR_GROUP, InteractionTestMode::And));
        let collider = self.scene.world.insert_collider(ball, Some(body));
        self.spheres.push(Sphere { collider, body, radius, friction });
        Ok(())
    }

    /// Height of the pelvis' origin above the floor [m].
    pub fn pelvis_height(&self) -> f64 {
        f64::from(self.scene.world.bodies[self.pelvis].translation().z)
    }

    /// How far the lowest sphere is below the floor [m]; 0 above it.
    pub fn penetration(&self) -> f64 {
        let depths = self.spheres.iter().map(|sphere| sphere.radius - f64::from(self.centre(sphere).z));
        depths.fold(0.0, f64::max)
    }

    /// Forces and velocities at the soles after a step.
    pub fn stance(&self) -> Stance {
        let mut stance = Stance { force_n: 0.0, contacts: 0, sticking: Vec::new() };
        let numbers: BTreeMap<_, usize> =
            self.spheres.iter().enumerate().map(|(i, sphere)| (sphere.collider.into_raw_parts(), i)).collect();
        for pair in self.scene.world.contact_pairs() {
            let found = [pair.collider1, pair.collider2].map(|c| numbers.get(&c.into_raw_parts()));
            let Some(&number) = found.into_iter().flatten().next() else { continue };
            let sphere = &self.spheres[number];
            for manifold in pair.solver_manifolds() {
                let upward = f64::from(manifold.data.normal.z.abs());
                for point in &manifold.points {
                    let data = &point.data;
                    // The impulse of the whole step.
                    let force_n = f64::from(data.impulse) / crate::scene::STEP_S;
                    stance.force_n += force_n * upward;
                    stance.contacts += usize::from(force_n > 0.0);
                    // Those of its last substep, the only ones that Rapier keeps for both directions.
                    let tangential = f64::from(data.warmstart_tangent_world.length());
                    let limit = WITHIN_CONE * sphere.friction * f64::from(data.warmstart_impulse);
                    if force_n > CARRIES * self.weight_n && tangential < limit {
                        stance.sticking.push((number, self.slip(sphere)));
                    }
                }
            }
        }
        stance
    }

    fn slip(&self, sphere: &Sphere) -> [f64; 2] {
        let mut lowest = self.centre(sphere);
        lowest.z -= sphere.radius as Real;
        let velocity = self.scene.world.bodies[sphere.body].velocity_at_point(lowest);
        [f64::from(velocity.x), f64::from(velocity.y)]
    }

    /// A collider's own position is that before the step, so it is taken from its body.
    fn centre(&self, sphere: &Sphere) -> Vector {
        let world = &self.scene.world;
        let in_body =
            world.colliders[sphere.collider].position_wrt_parent().map_or(Vector::ZERO, |pose| pose.translation);
        world.bodies[sphere.body].position().transform_point(in_body)
    }
}

/// The joint that stands for all hinges of a body, with their springs at rest in the pose of the file.
fn sprung_joint(body: Node<'_, '_>) -> Result<GenericJoint, String> {
    let mut hinges = Vec::new();
    for joint in body.children().filter(|child| child.has_tag_name("joint")) {
        let axis = three(joint, "axis")?;
        hinges.push((axis, first_number(joint, "stiffness")?, first_number(joint, "damping")?));
    }
    if let [(axis, stiffness, damping)] = hinges[..] {
        let mut joint = hinge_about(axis);
        spring(&mut joint, JointAxis::AngX, stiffness, damping);
        return Ok(joint);
    }
    let mut joint = GenericJoint::new(JointAxesMask::LOCKED_SPHERICAL_AXES);
    let mut locked = JointAxesMask::ANG_AXES;
    for (axis, stiffness, damping) in hinges {
        let rotation = ROTATIONS.iter().find(|(along, ..)| *along == axis);
        let (_, name, mask) =
            rotation.ok_or_else(|| format!("line {}: the axis {axis:?} is not x, y or z", line(body)))?;
        spring(&mut joint, *name, stiffness, damping);
        locked.remove(*mask);
    }
    joint.lock_axes(locked);
    Ok(joint)
}

/// A spring [N.m/rad] and damper [N.m.s/rad] on one free rotation.
fn spring(joint: &mut GenericJoint, axis: JointAxis, stiffness: f64, damping: f64) {
    joint.set_motor_model(axis, MotorModel::ForceBased);
    joint.set_motor_position(axis, 0.0, stiffness as Real, damping as Real);
}

fn three(node: Node<'_, '_>, name: &str) -> Result<[f64; 3], String> {
    let wrong = || format!("line {}: <{}> needs three numbers in `{name}`", line(node), node.tag_name().name());
    numbers(node, name).and_then(|found| found.try_into().ok()).ok_or_else(wrong)
}

fn first_number(node: Node<'_, '_>, name: &str) -> Result<f64, String> {
    let wrong = || format!("line {}: <{}> needs a number in `{name}`", line(node), node.tag_name().name());
    numbers(node, name).and_then(|found| found.first().copied()).ok_or_else(wrong)
}

fn numbers(node: Node<'_, '_>, name: &str) -> Option<Vec<f64>> {
    node.attribute(name)?.split_whitespace().map(|word| word.parse().ok()).collect()
}

fn line(node: Node<'_, '_>) -> u32 {
    node.document().text_pos_at(node.range().start).row
}
