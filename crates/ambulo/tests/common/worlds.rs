//! Worlds for tests of the simulator, built in code; y is up, joints turn and slide along z.

use super::turn;
use ambulo::contact::Shape;
use ambulo::dynamics::Convergence;
use ambulo::findings::Findings;
use ambulo::simulation::{
    Closure, JointDrive, JointKind, Material, Obstacle, ObstaclePath, Owner, RigidBody, Signal, StepForces,
    StepSettings, StepWorkspace, Surface, TreeJoint, World, WorldState, step,
};
use ambulo::spatial::{Mat3, Pose, Twist, Vec3, Wrench};

/// Gravity of all these worlds [m/s²].
pub(crate) const G: f64 = 9.81;
pub(crate) const O: Vec3 = Vec3::new(0.0, 0.0, 0.0);

pub(crate) fn v(x: f64, y: f64, z: f64) -> Vec3 {
    Vec3::new(x, y, z)
}

/// Turned by `angle` about z, placed at `at`.
pub(crate) fn turned(angle: f64, at: Vec3) -> Pose {
    Pose { rotation: turn(Vec3::z(), angle), translation: at }
}

/// A frame at `at` whose z looks along `axis`.
pub(crate) fn along(axis: Vec3, at: Vec3) -> Pose {
    let rotation = nalgebra::Rotation3::rotation_between(&Vec3::z(), &axis).unwrap();
    Pose { rotation: *rotation.matrix(), translation: at }
}

/// Nothing but gravity.
pub(crate) fn empty() -> World {
    World { gravity: v(0.0, -G, 0.0), ..World::default() }
}

/// One material for all surfaces.
pub(crate) fn of_material(material: Material) -> World {
    World { materials: vec![material], ..empty() }
}

/// One rigid material with this friction and restitution for all surfaces.
pub(crate) fn of_rigid(friction: f64, restitution: f64) -> World {
    of_material(Material { friction, restitution, ..Material::default() })
}

pub(crate) fn add_body(world: &mut World, mass: f64, inertia: [f64; 3], pose: Pose) -> usize {
    let name = format!("body {}", world.bodies.len());
    let inertia = Mat3::from_diagonal(&Vec3::from(inertia));
    world.bodies.push(RigidBody { name, mass, inertia, pose, twist: Twist::ZERO, load: Wrench::ZERO });
    world.bodies.len() - 1
}

pub(crate) fn add_joint(
    world: &mut World,
    kind: JointKind,
    child: usize,
    parent: Option<usize>,
    frames: [Pose; 2],
) -> usize {
    world.joints.push(TreeJoint::free(format!("joint {}", world.joints.len()), kind, child, parent, frames));
    world.joints.len() - 1
}

/// A hinge about z.
pub(crate) fn add_hinge(
    world: &mut World,
    child: usize,
    parent: Option<usize>,
    on_parent: Vec3,
    on_child: Vec3,
) -> usize {
    add_joint(world, JointKind::Revolute, child, parent, [Pose::at(on_parent), Pose::at(on_child)])
}

/// An active closure that joins a place on `first` to one on `second`.
pub(crate) fn add_closure(
    world: &mut World,
    kind: JointKind,
    first: usize,
    second: Option<usize>,
    [first_from_joint, second_from_joint]: [Pose; 2],
) -> usize {
    let name = format!("closure {}", world.closures.len());
    world.closures.push(Closure { name, first, second, first_from_joint, second_from_joint, kind, active: true });
    world.closures.len() - 1
}

pub(crate) fn drive(world: &mut World, joint: usize, coordinate: usize, signal: Signal) {
    world.joints[joint].coordinates[coordinate].drive = Some(JointDrive { signal, max: None });
}

pub(crate) fn sine(amplitude: f64, frequency_hz: f64, phase: f64, offset: f64) -> Signal {
    Signal::Sine { amplitude, frequency_hz, phase, offset }
}

pub(crate) fn add_surface(world: &mut World, owner: Owner, shape: Shape, owner_from_shape: Pose) -> usize {
    world.surfaces.push(Surface { owner, shape, owner_from_shape, material: 0 });
    world.surfaces.len() - 1
}

pub(crate) fn add_obstacle(world: &mut World, pose: Pose, path: Option<ObstaclePath>) -> usize {
    let name = format!("obstacle {}", world.obstacles.len());
    world.obstacles.push(Obstacle { name, pose, path });
    world.obstacles.len() - 1
}

/// A half-space below the plane y = 0 of `pose`.
pub(crate) fn add_floor(world: &mut World, pose: Pose) -> usize {
    let obstacle = add_obstacle(world, pose, None);
    add_surface(world, Owner::Obstacle(obstacle), Shape::half_space(), Pose::IDENTITY);
    obstacle
}

/// A uniform ball.
pub(crate) fn add_ball(world: &mut World, mass: f64, radius: f64, at: Vec3) -> usize {
    add_solid(world, mass, Shape::sphere(radius).unwrap(), Pose::at(at))
}

/// A uniform box of these half sides.
pub(crate) fn add_box(world: &mut World, mass: f64, half: Vec3, pose: Pose) -> usize {
    add_solid(world, mass, Shape::cuboid(half).unwrap(), pose)
}

/// A uniform solid whose own frame stands at `pose`; its mass centre must be the origin of that frame.
pub(crate) fn add_solid(world: &mut World, mass: f64, shape: Shape, pose: Pose) -> usize {
    let inertia = shape.inertia(mass).unwrap();
    assert!(inertia.center().norm() < 1e-12, "the mass centre is not the origin");
    let body = add_body(world, mass, [1.0; 3], pose);
    world.bodies[body].inertia = inertia.about_center();
    add_surface(world, Owner::Body(body), shape, Pose::IDENTITY);
    body
}

/// A world, where it is, and what stepping it takes.
#[derive(Clone)]
pub(crate) struct Run {
    pub(crate) world: World,
    pub(crate) state: WorldState,
    pub(crate) settings: StepSettings,
    pub(crate) workspace: StepWorkspace,
    pub(crate) findings: Findings,
}

impl Run {
    pub(crate) fn new(world: World, step_s: f64) -> Run {
        Run {
            state: WorldState::new(&world),
            world,
            settings: StepSettings { step_s, ..StepSettings::default() },
            workspace: StepWorkspace::default(),
            findings: Findings::default(),
        }
    }

    pub(crate) fn step(&mut self) -> Convergence {
        let Run { world, state, settings, workspace, findings } = self;
        step(world, state, settings, workspace, findings).unwrap()
    }

    /// Whole steps until this time [s].
    pub(crate) fn to(&mut self, time_s: f64) -> &mut Run {
        self.watch(time_s, |_| {})
    }

    /// The same, looking on after each step.
    pub(crate) fn watch(&mut self, time_s: f64, mut look: impl FnMut(&Run)) -> &mut Run {
        for _ in 0..((time_s - self.state.time_s) / self.settings.step_s).round() as usize {
            self.step();
            look(self);
        }
        self
    }

    pub(crate) fn forces(&self) -> StepForces {
        self.workspace.forces(&self.world)
    }

    /// Coordinate k of a joint.
    pub(crate) fn q(&self, joint: usize, k: usize) -> f64 {
        self.state.coordinates[joint][k]
    }

    pub(crate) fn place(&self, body: usize) -> Vec3 {
        self.state.poses[body].translation
    }

    pub(crate) fn velocity(&self, body: usize) -> Vec3 {
        self.state.twists[body].linear
    }

    pub(crate) fn spin(&self, body: usize) -> Vec3 {
        self.state.twists[body].angular
    }

    /// Linear momentum, and angular momentum about the origin of the world.
    pub(crate) fn momentum(&self) -> (Vec3, Vec3) {
        let mut sum = (O, O);
        for ((body, pose), twist) in self.world.bodies.iter().zip(&self.state.poses).zip(&self.state.twists) {
            let p = twist.linear * body.mass;
            let spin = pose.rotation * (body.inertia * (pose.rotation.transpose() * twist.angular));
            sum = (sum.0 + p, sum.1 + pose.translation.cross(&p) + spin);
        }
        sum
    }
}

/// Asserts that an error falls to half as the step does, from `step_s` on twice, and returns it at the three steps.
/// With error = c h + d h² the ratio is 2 + O(h); no order would give 1, second order 4.
#[track_caller]
pub(crate) fn assert_first_order(step_s: f64, error: impl Fn(f64) -> f64) -> [f64; 3] {
    let errors = [1.0, 0.5, 0.25].map(|share| error(step_s * share));
    for pair in errors.windows(2) {
        let ratio = pair[0] / pair[1];
        assert!((1.7..2.3).contains(&ratio), "errors {errors:?} do not halve with the step: ratio {ratio}");
    }
    errors
}
