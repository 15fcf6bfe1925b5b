//! The worlds that simulators are compared on: a standing human with twelve sole spheres, open chains, random trees,
//! ladders.
//!
//! The human is read from the peers' own file; chain and ladder are built as the peers' scripts build theirs (z up).

use ambulo::contact::Shape;
use ambulo::simulation::{
    Closure, JointCoordinate, JointKind, Material, Obstacle, Owner, RigidBody, Spring, Surface, TreeJoint, World,
};
use ambulo::spatial::{Mat3, Pose, Twist, Vec3, Wrench};

/// Gravity in the peers' scenes [m/s²].
const GRAVITY: Vec3 = Vec3::new(0.0, 0.0, -9.81);
/// A link of chain and ladder: length [m], mass [kg], moments of inertia about its middle [kg.m²].
const LINK_M: f64 = 0.2;
const LINK_INERTIA: [f64; 3] = [0.002, 0.004, 0.004];

/// A world with gravity along -z.
fn empty() -> World {
    World { gravity: GRAVITY, ..World::default() }
}

fn body(name: String, mass: f64, inertia: [f64; 3], at: Vec3) -> RigidBody {
    RigidBody {
        name,
        mass,
        inertia: Mat3::from_diagonal(&Vec3::from(inertia)),
        pose: Pose::at(at),
        twist: Twist::ZERO,
        load: Wrench::ZERO,
    }
}

/// Axes with z along `axis`, one of the world's.
fn along(axis: Vec3) -> Mat3 {
    Mat3::from_columns(&[Vec3::new(axis.z, axis.x, axis.y), Vec3::new(axis.y, axis.z, axis.x), axis])
}

fn hinge(child: usize, parent: Option<usize>, in_parent: Vec3, in_child: Vec3, axis: Vec3) -> TreeJoint {
    let at = |translation| Pose { rotation: along(axis), translation };
    TreeJoint::free(format!("hinge {child}"), JointKind::Revolute, child, parent, [at(in_parent), at(in_child)])
}

/// `count` links of 1 kg, level, hinged to the world and to each other about y and z in turn.
pub(crate) fn chain(count: usize) -> World {
    let mut world = empty();
    let half = Vec3::new(0.5 * LINK_M, 0.0, 0.0);
    for i in 0..count {
        world.bodies.push(body(format!("link {i}"), 1.0, LINK_INERTIA, half + Vec3::x() * (LINK_M * i as f64)));
        let axis = if i % 2 == 0 { Vec3::y() } else { Vec3::z() };
        let in_parent = if i == 0 { Vec3::zeros() } else { half };
        world.joints.push(hinge(i, i.checked_sub(1), in_parent, -half, axis));
    }
    world
}

/// `count` links, each hinged to one of the ten before it, drawn by a linear congruential generator.
pub(crate) fn random_tree(count: usize) -> World {
    let mut world = empty();
    let half = Vec3::new(0.5 * LINK_M, 0.0, 0.0);
    let mut seed = 1_u64;
    for i in 0..count {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let back = 1 + (seed >> 33) as usize % 10.min(i.max(1));
        let parent = i.checked_sub(back).filter(|_| i > 0);
        let start = parent.map_or(Vec3::zeros(), |p| world.bodies[p].pose.translation + half);
        world.bodies.push(body(format!("link {i}"), 1.0, LINK_INERTIA, start + half));
        let axis = if (seed >> 40).is_multiple_of(2) { Vec3::y() } else { Vec3::z() };
        let in_parent = if parent.is_none() { Vec3::zeros() } else { half };
        world.joints.push(hinge(i, parent, in_parent, -half, axis));
    }
    world
}

/// Two rails of `count` links, a rung on each link of the left one, closed by `loops` points on the right one.
pub(crate) fn ladder(count: usize, loops: usize) -> World {
    let mut world = empty();
    let half = Vec3::new(0.5 * LINK_M, 0.0, 0.0);
    let rung = Vec3::new(0.0, 0.0, 0.15);
    for i in 0..count {
        let x = Vec3::x() * (LINK_M * i as f64);
        let before = |k: usize| i.checked_sub(1).map(|i| 3 * i + k);
        world.bodies.push(body(format!("left {i}"), 1.0, LINK_INERTIA, x + half));
        world.bodies.push(body(format!("right {i}"), 1.0, LINK_INERTIA, x + half + rung * 2.0));
        world.bodies.push(body(format!("rung {i}"), 0.5, [0.004, 0.004, 0.001], x + half * 2.0 + rung));
        let at = |ground: Vec3| if i == 0 { ground } else { half };
        world.joints.push(hinge(3 * i, before(0), at(Vec3::zeros()), -half, Vec3::y()));
        world.joints.push(hinge(3 * i + 1, before(1), at(rung * 2.0), -half, Vec3::y()));
        world.joints.push(hinge(3 * i + 2, Some(3 * i), half, -rung, Vec3::y()));
        if i < loops {
            world.closures.push(Closure {
                name: format!("closing {i}"),
                first: 3 * i + 2,
                second: Some(3 * i + 1),
                first_from_joint: Pose::at(rung),
                second_from_joint: Pose::at(half),
                kind: JointKind::Ball,
                active: true,
            });
        }
    }
    world
}

/// The reference human of the peers' file: three hinges at one place become a ball joint, two a universal joint;
/// springs and spheres as there.
pub(crate) fn human(xml: &str) -> Result<World, String> {
    let document = roxmltree::Document::parse(xml).map_err(|e| format!("the human's file: {e}"))?;
    let top =
        document.descendants().find(|n| n.has_tag_name("worldbody")).ok_or("the human's file has no worldbody")?;
    let mut world = empty();
    world.obstacles.push(Obstacle { name: "floor".into(), pose: Pose::IDENTITY, path: None });
    world.materials.push(Material::default());
    let up = Pose { rotation: Mat3::new(1., 0., 0., 0., 0., -1., 0., 1., 0.), translation: Vec3::zeros() };
    world.surfaces.push(Surface {
        owner: Owner::Obstacle(0),
        shape: Shape::half_space(),
        owner_from_shape: up,
        material: 0,
    });
    for node in top.children().filter(|n| n.has_tag_name("body")) {
        add_segment(&mut world, &node, None, Vec3::zeros())?;
    }
    Ok(world)
}

/// A segment and all that hang on it. `origin` is the parent's frame in the world; all axes are the world's.
fn add_segment(
    world: &mut World,
    node: &roxmltree::Node<'_, '_>,
    parent: Option<(usize, Vec3)>,
    origin: Vec3,
) -> Result<(), String> {
    let origin = origin + vector(node, "pos")?;
    let child = |tag: &'static str| node.children().filter(move |n| n.has_tag_name(tag));
    let inertial = child("inertial").next().ok_or("a body without inertial")?;
    let (number, center) = (world.bodies.len(), origin + vector(&inertial, "pos")?);
    let moments = vector(&inertial, "diaginertia")?;
    let name = node.attribute("name").unwrap_or_default().to_owned();
    world.bodies.push(body(name.clone(), number_of(&inertial, "mass")?, moments.into(), center));
    if let Some((parent, parent_center)) = parent {
        let mut axes = Vec::new();
        let mut coordinates = Vec::new();
        for joint in child("joint") {
            axes.push(vector(&joint, "axis")?);
            let spring = Spring {
                stiffness: number_of(&joint, "stiffness").unwrap_or(0.0),
                damping: number_of(&joint, "damping").unwrap_or(0.0),
                rest: 0.0,
            };
            coordinates.push(JointCoordinate { spring: Some(spring), ..JointCoordinate::default() });
        }
        let (kind, rotation) = match axes.as_slice() {
            [] => (JointKind::Weld, Mat3::identity()),
            [axis] => (JointKind::Revolute, along(*axis)),
            [x, y] => (JointKind::Universal, Mat3::from_columns(&[*x, *y, x.cross(y)])),
            _ => (JointKind::Ball, Mat3::identity()),
        };
        world.joints.push(TreeJoint {
            name,
            child: number,
            parent: Some(parent),
            parent_from_joint: Pose { rotation, translation: origin - parent_center },
            child_from_joint: Pose { rotation, translation: origin - center },
            kind,
            coordinates,
            follows: None,
        });
    }
    for geom in child("geom").filter(|g| g.attribute("type") == Some("sphere")) {
        world.surfaces.push(Surface {
            owner: Owner::Body(number),
            shape: Shape::sphere(number_of(&geom, "size")?).map_err(|e| e.to_string())?,
            owner_from_shape: Pose::at(origin + vector(&geom, "pos")? - center),
            material: 0,
        });
    }
    child("body").try_for_each(|segment| add_segment(world, &segment, Some((number, center)), origin))
}

fn number_of(node: &roxmltree::Node<'_, '_>, key: &str) -> Result<f64, String> {
    let text = node.attribute(key).ok_or_else(|| format!("<{}> without `{key}`", node.tag_name().name()))?;
    text.trim().parse().map_err(|e| format!("`{key}` = `{text}`: {e}"))
}

fn vector(node: &roxmltree::Node<'_, '_>, key: &str) -> Result<Vec3, String> {
    let text = node.attribute(key).ok_or_else(|| format!("<{}> without `{key}`", node.tag_name().name()))?;
    let numbers: Vec<f64> = text.split_whitespace().filter_map(|word| word.parse().ok()).collect();
    <[f64; 3]>::try_from(numbers).map(Vec3::from).map_err(|n| format!("`{key}`: {} numbers, expected 3", n.len()))
}
