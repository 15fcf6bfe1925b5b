//! Contacts that begin to slip or to separate at once: how many steps leave how large a violation of the laws.

use ambulo::contact::Shape;
use ambulo::findings::Findings;
use ambulo::simulation::scene::{Scene, SceneFile, SceneSettings};
use ambulo::simulation::{
    ContactForce, JointCoordinate, JointKind, Material, Obstacle, Owner, RigidBody, Spring, StepSettings,
    StepWorkspace, Surface, TreeJoint, World, WorldState, step,
};
use ambulo::spatial::{Mat3, Pose, Twist, Vec3, Wrench};

/// Steps above each limit, of all.
#[derive(Default)]
struct Count {
    steps: usize,
    above: [usize; 3],
    worst: f64,
}

const LIMITS: [f64; 3] = [1e-10, 1e-8, 1e-6];

impl Count {
    fn add(&mut self, violation: f64) {
        self.steps += 1;
        self.worst = if violation.is_nan() { f64::INFINITY } else { self.worst.max(violation) };
        for (count, limit) in self.above.iter_mut().zip(LIMITS) {
            *count += usize::from(violation.is_nan() || violation > limit);
        }
    }

    /// Prints the counts; at most 1 % of the steps may be above 1e-8, none above 1e-6.
    fn check(&self, what: &str) {
        let Count { steps, above, worst } = self;
        println!("{what}: {above:?} of {steps} steps above {LIMITS:?}, worst {worst:.1e}");
        assert!(above[1] * 100 <= *steps && above[2] == 0, "{what}: {above:?} of {steps}, worst {worst:e}");
    }
}

/// Gaps below this count as closed [m].
const CLOSED_M: f64 = 1e-10;

/// The largest violation of the laws at the contacts of a step: the smallest change of force, as a share of the weight,
/// or of velocity, as a share of that of free fall during the step, that would satisfy them. Collisions without
/// restitution only.
fn violation(world: &World, [before, after]: [&WorldState; 2], contacts: &[ContactForce], step_s: f64) -> f64 {
    let gravity = world.gravity.norm();
    let (weight, fall) = (world.mass() * gravity, gravity * step_s);
    let velocity = |surface: usize, point: Vec3| match world.surfaces[surface].owner {
        Owner::Body(body) => after.twists[body].velocity_at(point - before.poses[body].translation),
        Owner::Obstacle(_) => Vec3::zeros(),
    };
    let mut worst = 0.0_f64;
    for contact in contacts {
        let (first, second) = contact.surfaces;
        let apart = velocity(first, contact.point) - velocity(second, contact.point);
        let material = |surface: usize| &world.materials[world.surfaces[surface].material];
        let friction = (material(first).friction * material(second).friction).sqrt();
        let gap = if contact.gap > CLOSED_M { contact.gap } else { 0.0 };
        let opening = (contact.normal.dot(&apart) + gap / step_s) / fall;
        let push = contact.normal_force / weight;
        let along = |v: Vec3| v - contact.normal * contact.normal.dot(&v);
        let rubbing = along(contact.force) / weight;
        let wanted = rubbing - along(apart) / fall;
        let limit = friction * push.max(0.0);
        let shrink = if wanted.norm() > limit { limit / wanted.norm() } else { 1.0 };
        worst = worst.max(push.min(opening).abs()).max((rubbing - wanted * shrink).norm());
    }
    worst
}

/// Residuals of 3 s of the example `pile.toml` after these replacements in its text.
fn pile(replacements: &[[&str; 2]]) -> Count {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples");
    let mut text = std::fs::read_to_string(folder.join("pile.toml")).unwrap();
    for [old, new] in replacements {
        assert!(text.contains(old));
        text = text.replace(old, new);
    }
    let mut findings = Findings::default();
    let mut load = |path: &str| Err(format!("no file {path}"));
    let scene = SceneFile::parse(&text).unwrap();
    let mut scene = Scene::build(&scene, SceneSettings::default(), &mut load, &mut findings).unwrap();
    let mut residuals = Count::default();
    for _ in 0..3000 {
        residuals.add(scene.step(&mut findings).unwrap().residual);
    }
    residuals
}

#[test]
fn contact_convergence_of_a_pile() {
    pile(&[]).check("pile, residual");
}

#[test]
fn contact_convergence_of_piles_that_the_solver_was_not_made_on() {
    const BALL: &str = "{ kind = \"sphere\", radius = 0.1,";
    const BOX: &str = "{ kind = \"box\", size = [0.18, 0.12, 0.16],";
    const FRICTION: &str = "friction = 0.4";
    pile(&[[FRICTION, "friction = 0.2"]]).check("pile with less friction");
    pile(&[[FRICTION, "friction = 0.8"]]).check("pile with more friction");
    pile(&[["restitution = 0.2", "restitution = 0.0"]]).check("pile without restitution");
    pile(&[[BALL, BOX]]).check("pile of boxes");
}

#[test]
fn a_box_of_almost_no_mass_on_a_slope_ends_in_an_error_or_a_step() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples");
    let text = std::fs::read_to_string(folder.join("slope.toml")).unwrap();
    assert!(text.contains("mass = 2.0"));
    let scene = SceneFile::parse(&text.replace("mass = 2.0", "mass = 1e-308")).unwrap();
    let mut load = |path: &str| Err(format!("no file {path}"));
    let mut findings = Findings::default();
    let Ok(mut scene) = Scene::build(&scene, SceneSettings::default(), &mut load, &mut findings) else { return };
    for _ in 0..20 {
        if scene.step(&mut findings).is_err() {
            return;
        }
    }
}

const GRAVITY: f64 = 9.80665;
/// Segments of a person of 75 kg: mass [kg], height of the mass centre above that of the joint above it [m], radius of
/// gyration [m], stiffness of the joint above it [N.m/rad].
const THIGH: [f64; 4] = [8.0, -0.18, 0.13, 600.0];
const SHANK: [f64; 4] = [3.5, -0.19, 0.12, 400.0];
const FOOT: [f64; 4] = [1.0, -0.06, 0.06, 300.0];
/// Damping of joints as a share of their stiffness [s].
const DAMPING_S: f64 = 0.02;
const SOLE_RADIUS_M: f64 = 0.02;

fn segment(name: &str, mass: f64, gyration: f64, at: Vec3) -> RigidBody {
    RigidBody {
        name: name.to_owned(),
        mass,
        inertia: Mat3::identity() * (mass * gyration * gyration),
        pose: Pose::at(at),
        twist: Twist::ZERO,
        load: Wrench::ZERO,
    }
}

/// A person in upright stance on twelve spheres, y up: one trunk, two legs of three segments with springs in their
/// joints.
fn person(friction: f64) -> World {
    let mut world = World { gravity: Vec3::new(0.0, -GRAVITY, 0.0), ..World::default() };
    world.materials.push(Material { friction, ..Material::default() });
    world.obstacles.push(Obstacle { name: "floor".into(), pose: Pose::IDENTITY, path: None });
    let floor = Surface {
        owner: Owner::Obstacle(0),
        shape: Shape::half_space(),
        owner_from_shape: Pose::IDENTITY,
        material: 0,
    };
    world.surfaces.push(floor);
    let hip_m = 0.4 + 0.4 + 0.08;
    world.bodies.push(segment("trunk", 50.0, 0.28, Vec3::new(0.0, hip_m + 0.3, 0.0)));
    for side in [-0.1, 0.1] {
        let (mut parent, mut joint) = (0, Vec3::new(0.0, hip_m, side));
        for (k, [mass, down, gyration, stiffness]) in [THIGH, SHANK, FOOT].into_iter().enumerate() {
            let ahead = if k == 2 { 0.05 } else { 0.0 };
            let (child, center) = (world.bodies.len(), joint + Vec3::new(ahead, down, 0.0));
            world.bodies.push(segment(&format!("segment {child}"), mass, gyration, center));
            let spring = Spring { stiffness, damping: DAMPING_S * stiffness, rest: 0.0 };
            let sprung = JointCoordinate { spring: Some(spring), ..JointCoordinate::default() };
            world.joints.push(TreeJoint {
                name: format!("joint {child}"),
                child,
                parent: Some(parent),
                parent_from_joint: Pose::at(joint - world.bodies[parent].pose.translation),
                child_from_joint: Pose::at(joint - center),
                kind: JointKind::Ball,
                coordinates: vec![sprung; 3],
                follows: None,
            });
            (parent, joint) = (child, joint - Vec3::y() * 0.4);
        }
        let foot = world.bodies[parent].pose.translation;
        for x in [-0.06, 0.09, 0.19] {
            for z in [-0.03, 0.03] {
                world.surfaces.push(Surface {
                    owner: Owner::Body(parent),
                    shape: Shape::sphere(SOLE_RADIUS_M).unwrap(),
                    owner_from_shape: Pose::at(Vec3::new(x, SOLE_RADIUS_M, side + z) - foot),
                    material: 0,
                });
            }
        }
    }
    world.check().unwrap();
    world
}

/// Residuals and violations of the laws for a person who is pushed at the trunk for 0.2 s after a second of standing;
/// the largest number of contacts that slip at once, and the trunk's height at the end [m].
fn pushed_person(friction: f64, force: Vec3) -> (Count, Count, usize, f64) {
    let standing = person(friction);
    let mut pushed = standing.clone();
    pushed.bodies[0].load = Wrench { moment: Vec3::zeros(), force };
    let settings = StepSettings::default();
    let (mut state, mut w, mut findings) = (WorldState::new(&standing), StepWorkspace::default(), Findings::default());
    let (mut residuals, mut laws, mut slipping) = (Count::default(), Count::default(), 0);
    for number in 0..2200 {
        let world = if (1000..1200).contains(&number) { &pushed } else { &standing };
        let before = state.clone();
        let convergence = step(world, &mut state, &settings, &mut w, &mut findings).unwrap();
        let contacts = w.forces(world).contacts;
        residuals.add(convergence.residual);
        laws.add(violation(world, [&before, &state], &contacts, settings.step_s));
        slipping = slipping.max(contacts.iter().filter(|c| c.normal_force > 0.0 && c.slip.norm() > 1e-3).count());
    }
    (residuals, laws, slipping, state.poses[0].translation.y)
}

#[test]
fn contact_convergence_of_a_person_who_is_pushed_over() {
    let pushes = [Vec3::new(150.0, 100.0, 40.0), Vec3::new(-120.0, 0.0, 60.0), Vec3::new(30.0, 50.0, 200.0)];
    let (mut most_slipping, mut lowest) = (0, f64::INFINITY);
    for friction in [0.3, 0.6, 0.9] {
        for (number, force) in pushes.into_iter().enumerate() {
            let (residuals, laws, slipping, trunk_m) = pushed_person(friction, force);
            println!("friction {friction}, push {number}: trunk at {trunk_m:.2} m, {slipping} contacts slip at once");
            residuals.check("residual");
            laws.check("laws of the contacts");
            (most_slipping, lowest) = (most_slipping.max(slipping), lowest.min(trunk_m));
        }
    }
    assert!(
        most_slipping >= 4 && lowest < 0.8,
        "{most_slipping} slip, trunk at {lowest} m: a push must slide and overthrow"
    );
}
