//! Rigid bodies held together by impulse joints: the chain and the ladder, and what can go wrong with any such scene.

use crate::rapier::prelude::*;

/// Simulated time of one step [s].
pub const STEP_S: f64 = 0.001;
/// Standard gravity as all peers take it [m/s²], downwards along z.
pub const GRAVITY: f64 = 9.81;

/// Length of a link, distance of the rails [m].
const LENGTH: f64 = 0.2;
const WIDTH: f64 = 0.3;
const RAIL: Inertial = Inertial { mass: 1.0, com: [0.1, 0.0, 0.0], inertia: [0.002, 0.004, 0.004] };
const RUNG: Inertial = Inertial { mass: 0.5, com: [0.0, 0.0, 0.15], inertia: [0.004, 0.004, 0.001] };
const Y_AXIS: [f64; 3] = [0.0, 1.0, 0.0];
const Z_AXIS: [f64; 3] = [0.0, 0.0, 1.0];
const ORIGIN: [f64; 3] = [0.0; 3];

/// Mass [kg], centre of mass [m] and principal moments of inertia [kg.m²] in a body's own axes.
#[derive(Clone, Copy)]
pub struct Inertial {
    pub mass: f64,
    pub com: [f64; 3],
    pub inertia: [f64; 3],
}

/// Two points that a joint should keep together, each in its body's own axes [m].
struct Anchors {
    bodies: [RigidBodyHandle; 2],
    points: [Vector; 2],
}

/// A world and the joints in it.
pub struct Scene {
    pub world: PhysicsWorld,
    /// A body that stands still.
    pub ground: RigidBodyHandle,
    anchors: Vec<Anchors>,
    /// Each body with its inertia: Rapier's own are zero before the first step.
    bodies: Vec<(RigidBodyHandle, Inertial)>,
}

impl Scene {
    /// Nothing but a fixed body.
    pub fn empty() -> Scene {
        let mut world = PhysicsWorld::new();
        world.gravity = vector([0.0, 0.0, -GRAVITY]);
        world.integration_parameters.dt = STEP_S as Real;
        let ground = world.insert_body(RigidBodyBuilder::fixed());
        Scene { world, ground, anchors: Vec::new(), bodies: Vec::new() }
    }

    /// Links along x, hinged to each other and to the world about y and z by turns.
    pub fn chain(links: usize) -> Scene {
        let mut scene = Scene::empty();
        let mut tip = scene.ground;
        for i in 0..links {
            let x = LENGTH * i as f64;
            let link = scene.body([x, 0.0, 0.0], RAIL);
            let axis = if i % 2 == 0 { Y_AXIS } else { Z_AXIS };
            let anchor = if i == 0 { ORIGIN } else { [LENGTH, 0.0, 0.0] };
            scene.hinge([tip, link], [anchor, ORIGIN], axis);
            tip = link;
        }
        scene
    }

    /// Two rails, one above the other, and a rung at the end of each pair of links; every joint is a hinge about y.
    pub fn ladder(loops: usize) -> Scene {
        let mut scene = Scene::empty();
        let (end, top) = ([LENGTH, 0.0, 0.0], [0.0, 0.0, WIDTH]);
        let mut ends = [scene.ground; 2];
        for i in 0..loops {
            let x = LENGTH * i as f64;
            let starts = if i == 0 { [ORIGIN, top] } else { [end; 2] };
            let rails = [0.0, WIDTH].map(|z| scene.body([x, 0.0, z], RAIL));
            for side in 0..2 {
                scene.hinge([ends[side], rails[side]], [starts[side], ORIGIN], Y_AXIS);
            }
            let rung = scene.body([x + LENGTH, 0.0, 0.0], RUNG);
            scene.hinge([rails[0], rung], [end, ORIGIN], Y_AXIS);
            scene.hinge([rung, rails[1]], [top, end], Y_AXIS);
            ends = rails;
        }
        scene
    }

    /// Adds a body whose origin is at `position`, its axes along the world's.
    pub fn body(&mut self, position: [f64; 3], inertial: Inertial) -> RigidBodyHandle {
        let Inertial { mass, com, inertia } = inertial;
        let properties = MassProperties::new(vector(com), mass as Real, vector(inertia).into());
        let body = RigidBodyBuilder::dynamic().translation(vector(position)).additional_mass_properties(properties);
        let body = self.world.insert_body(body.can_sleep(false));
        self.bodies.push((body, inertial));
        body
    }

    /// Adds a joint that keeps the two points together, and whatever else `joint` states.
    pub fn join(&mut self, bodies: [RigidBodyHandle; 2], points: [[f64; 3]; 2], mut joint: GenericJoint) {
        let points = points.map(vector);
        joint.set_local_anchor1(points[0]).set_local_anchor2(points[1]).set_contacts_enabled(false);
        self.world.insert_impulse_joint(bodies[0], bodies[1], joint);
        self.anchors.push(Anchors { bodies, points });
    }

    fn hinge(&mut self, bodies: [RigidBodyHandle; 2], points: [[f64; 3]; 2], axis: [f64; 3]) {
        self.join(bodies, points, hinge_about(axis));
    }

    /// Largest distance of two points that a joint should keep together [m].
    pub fn constraint_error(&self) -> f64 {
        let distance = |anchors: &Anchors| {
            let [a, b] =
                [0, 1].map(|i| self.world.bodies[anchors.bodies[i]].position().transform_point(anchors.points[i]));
            f64::from((a - b).length())
        };
        // A distance that is not a number must not be passed over, as `max` would.
        self.anchors.iter().map(distance).fold(0.0, |worst, d| if d.is_nan() { f64::INFINITY } else { d.max(worst) })
    }

    /// Kinetic and potential energy of all bodies [J].
    pub fn energy(&self) -> f64 {
        let of = |(body, inertial): &(RigidBodyHandle, Inertial)| {
            let body = &self.world.bodies[*body];
            let com = body.position().transform_point(vector(inertial.com));
            f64::from(body.kinetic_energy()) + inertial.mass * GRAVITY * f64::from(com.z)
        };
        self.bodies.iter().map(of).sum()
    }

    /// Whether a body has left for infinity or was taken out by Rapier because of that.
    pub fn diverged(&self) -> bool {
        let finite = self.world.rigid_bodies().all(|(_, body)| body.translation().is_finite());
        !finite || !self.world.quarantine().is_empty()
    }
}

/// A hinge; its free axis is the joint's `AngX`.
pub fn hinge_about(axis: [f64; 3]) -> GenericJoint {
    let mut joint = GenericJoint::new(JointAxesMask::LOCKED_REVOLUTE_AXES);
    joint.set_local_axis1(vector(axis)).set_local_axis2(vector(axis));
    joint
}

/// Three numbers in Rapier's precision.
pub fn vector(v: [f64; 3]) -> Vector {
    Vector::new(v[0] as Real, v[1] as Real, v[2] as Real)
}
