//! `shapes.json` of a simulated scene: shapes of its bodies and obstacles (docs/OUTPUTS.md).
//!
//! Bodies have their contact surfaces; figures also get the shapes of a person. Other bodies also have sticks from
//! their mass centre to their joints; a body without surface and joint is drawn as the box with its inertia: with mass
//! m and principal moments I, the half sides obey h_x² = 3 (I_y + I_z - I_x) / (2 m), and so on.

use super::page::ViewShape;
use super::stage::figure_shapes;
use ambulo::contact::Outline;
use ambulo::simulation::scene::Scene;
use ambulo::simulation::{Owner, Surface, World};
use ambulo::spatial::{Pose, Vec3};
use ambulo_results::{OutputFile, SHAPES};
use nalgebra::{Matrix3, Rotation3, UnitQuaternion};
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;

/// Version of its layout.
pub(super) const FORMAT: u32 = 1;
/// Maximum number of drawn rows or columns of a height field.
const MOST_ROWS: usize = 128;
/// Radius of a stick over its length.
const STICK: f64 = 0.05;

/// All shapes of a scene.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct SceneShapes {
    /// Version of this layout.
    pub(super) format: u32,
    /// Gravity, world axes [m/s²].
    pub(super) gravity_m_s2: [f64; 3],
    /// The bodies of `poses.csv`.
    pub(super) bodies: Vec<BodyShapes>,
    /// Obstacles.
    pub(super) obstacles: Vec<ObstacleShapes>,
}

/// A body with its shapes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct BodyShapes {
    /// Name, as in `poses.csv`.
    pub(super) name: String,
    /// Mass [kg].
    pub(super) mass_kg: f64,
    /// `r` or `l`, of a figure's limbs.
    pub(super) side: Option<char>,
    /// Shapes in the axes of `poses.csv`: origin in the mass centre [m].
    pub(super) shapes: Vec<ViewShape>,
}

/// An obstacle with its shapes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct ObstacleShapes {
    /// Name.
    pub(super) name: String,
    /// Whether it moves: if so, `poses.csv` has its rows, and shapes and planes are in its own axes; otherwise they are
    /// in world axes.
    pub(super) moves: bool,
    /// Shapes [m].
    pub(super) shapes: Vec<ViewShape>,
    /// Infinite ground planes.
    pub(super) planes: Vec<GroundPlane>,
}

/// Everything below a plane.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct GroundPlane {
    /// A point of the plane [m].
    pub(super) point: [f64; 3],
    /// Unit normal of the plane, out of the ground.
    pub(super) normal: [f64; 3],
}

/// `shapes.json`.
///
/// # Errors
/// Data that JSON cannot store.
pub fn scene_shapes(scene: &Scene) -> Result<OutputFile<'static>, serde_json::Error> {
    let world = scene.world();
    let shapes = SceneShapes {
        format: FORMAT,
        gravity_m_s2: world.gravity.into(),
        bodies: bodies(scene),
        obstacles: (0..world.obstacles.len()).map(|number| obstacle(world, number)).collect(),
    };
    Ok(OutputFile::new(SHAPES, serde_json::to_vec(&shapes)?))
}

fn bodies(scene: &Scene) -> Vec<BodyShapes> {
    let world = scene.world();
    let mut bodies: Vec<BodyShapes> = world
        .bodies
        .iter()
        .enumerate()
        .map(|(number, body)| {
            let (shapes, _) = solids(world, Owner::Body(number), &Pose::IDENTITY);
            BodyShapes { name: body.name.clone(), mass_kg: body.mass, side: None, shapes }
        })
        .collect();
    let mut drawn = BTreeSet::new();
    for (name, figure) in scene.figure_names().zip(&world.figures) {
        for (id, shapes) in figure.model.body_ids().zip(figure_shapes(&figure.model)) {
            let described = &figure.model.bodies()[id.index()];
            let full = format!("{name}/{}", described.name);
            let Some(number) = bodies.iter().position(|body| body.name == full) else { continue };
            drawn.insert(number);
            let body = &mut bodies[number];
            let center_from_body = Pose::at(-described.inertia.center());
            body.side = figure.model.anatomy().body_side(id).and_then(|side| side.letter().chars().next());
            body.shapes.extend(shapes.iter().map(|shape| moved(shape, &center_from_body)));
        }
    }
    for (number, body) in bodies.iter_mut().enumerate().filter(|(number, _)| !drawn.contains(number)) {
        body.shapes.extend(sticks(world, number));
        if body.shapes.is_empty() {
            body.shapes.push(box_of_inertia(&world.bodies[number]));
        }
    }
    bodies
}

fn obstacle(world: &World, number: usize) -> ObstacleShapes {
    let obstacle = &world.obstacles[number];
    let moves = obstacle.path.is_some();
    let place = if moves { Pose::IDENTITY } else { obstacle.pose };
    let (shapes, planes) = solids(world, Owner::Obstacle(number), &place);
    ObstacleShapes { name: obstacle.name.clone(), moves, shapes, planes }
}

/// The surfaces of an owner, expressed in the axes in which it has this pose.
fn solids(world: &World, owner: Owner, place: &Pose) -> (Vec<ViewShape>, Vec<GroundPlane>) {
    let (mut shapes, mut planes) = (Vec::new(), Vec::new());
    for Surface { shape, owner_from_shape, .. } in world.surfaces.iter().filter(|surface| surface.owner == owner) {
        let pose = *place * *owner_from_shape;
        match shape.outline(MOST_ROWS) {
            Outline::Capsule { ends, radius } => {
                let [from, to] = ends.map(|end| pose.place(end).into());
                shapes.push(ViewShape::Capsule { from, to, radius });
            }
            Outline::Box { half } => shapes.push(boxed(&pose, half)),
            Outline::Surface { points, triangles } => {
                let points = points.into_iter().map(|point| pose.place(point).into()).collect();
                shapes.push(ViewShape::Mesh { points, triangles });
            }
            Outline::HalfSpace => {
                planes.push(GroundPlane {
                    point: pose.translation.into(),
                    normal: pose.rotation.column(1).into_owned().into(),
                });
            }
        }
    }
    (shapes, planes)
}

/// A shape expressed in outer axes; boxes of figures are never rotated.
fn moved(shape: &ViewShape, outer_from_inner: &Pose) -> ViewShape {
    let place = |point: &[f64; 3]| -> [f64; 3] { outer_from_inner.place(Vec3::from(*point)).into() };
    match shape {
        ViewShape::Capsule { from, to, radius } => {
            ViewShape::Capsule { from: place(from), to: place(to), radius: *radius }
        }
        ViewShape::Box { center, half, turn } => {
            let turn = quaternion(&outer_from_inner.rotation)
                * UnitQuaternion::new_unchecked(nalgebra::Quaternion::from(*turn));
            ViewShape::Box { center: place(center), half: *half, turn: turn.coords.into() }
        }
        ViewShape::Mesh { points, triangles } => {
            ViewShape::Mesh { points: points.iter().map(place).collect(), triangles: triangles.clone() }
        }
    }
}

/// Sticks from the mass centre of a body to its joints.
fn sticks(world: &World, number: usize) -> Vec<ViewShape> {
    let own = world.joints.iter().filter(|joint| joint.child == number).map(|joint| joint.child_from_joint.translation);
    let carried = world.joints.iter().filter(|joint| joint.parent == Some(number));
    let joints = own.chain(carried.map(|joint| joint.parent_from_joint.translation));
    let stick = |end: Vec3| ViewShape::Capsule { from: [0.0; 3], to: end.into(), radius: STICK * end.norm() };
    joints.filter(|end| end.norm() > 1e-6).map(stick).collect()
}

fn box_of_inertia(body: &ambulo::simulation::RigidBody) -> ViewShape {
    let eigen = body.inertia.symmetric_eigen();
    let moments = eigen.eigenvalues;
    let half = Vec3::from_fn(|k, _| (1.5 * (moments.sum() - 2.0 * moments[k]) / body.mass).max(1e-8).sqrt());
    let mut axes = eigen.eigenvectors;
    if axes.determinant() < 0.0 {
        axes.set_column(0, &-axes.column(0));
    }
    boxed(&Pose { rotation: axes, translation: Vec3::zeros() }, half)
}

fn boxed(pose: &Pose, half: Vec3) -> ViewShape {
    ViewShape::Box {
        center: pose.translation.into(),
        half: half.into(),
        turn: quaternion(&pose.rotation).coords.into(),
    }
}

fn quaternion(rotation: &Matrix3<f64>) -> UnitQuaternion<f64> {
    UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(*rotation))
}
