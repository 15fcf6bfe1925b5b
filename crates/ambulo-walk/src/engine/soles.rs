//! The soles of a figure: as surfaces of a world, with the level ground on which it walks, and their height.

use super::{Obstacle, Owner, Surface, World};
use crate::contact::{Shape, ShapeError};
use crate::engine::figure_tree::center_from;
use crate::kinematics::BodyMotion;
use crate::model::anthropometry::{ContactSphere, Human};
use crate::model::{BodyId, Side};
use crate::spatial::Pose;

/// Adds the soles of a figure whose first body is `first_body`, in their order. Feet do not touch each other, nor do
/// the parts of one foot. Returns the indices of the surfaces with their sides.
pub(crate) fn add_soles(
    world: &mut World,
    human: &Human,
    first_body: usize,
    material: usize,
) -> Result<Vec<(usize, Side)>, ShapeError> {
    let owner = |body: BodyId| first_body + body.index();
    let mut soles = Vec::new();
    for sole in &human.soles {
        soles.push((world.surfaces.len(), sole.side));
        world.surfaces.push(Surface {
            owner: Owner::Body(owner(sole.body)),
            shape: Shape::sphere(sole.radius)?,
            owner_from_shape: center_from(&human.model, sole.body) * Pose::at(sole.center),
            material,
        });
    }
    for one in human.soles.iter().map(|sole| owner(sole.body)) {
        let others = human.soles.iter().map(|sole| owner(sole.body)).filter(|other| *other > one);
        world.ignored.extend(others.map(|other| (Owner::Body(one), Owner::Body(other))));
    }
    world.ignored.sort_unstable();
    world.ignored.dedup();
    Ok(soles)
}

/// Adds the level ground, at height zero.
pub(crate) fn add_level_ground(world: &mut World, material: usize) {
    let number = world.obstacles.len();
    world.obstacles.push(Obstacle { name: "ground".to_owned(), pose: Pose::IDENTITY, path: None });
    world.surfaces.push(Surface {
        owner: Owner::Obstacle(number),
        shape: Shape::half_space(),
        owner_from_shape: Pose::IDENTITY,
        material,
    });
}

/// Height of the lowest point of some soles [m], from the motions of the bodies of the model; infinite without soles.
pub(crate) fn lowest<'a>(soles: impl IntoIterator<Item = &'a ContactSphere>, motions: &[BodyMotion]) -> f64 {
    let low = |sole: &ContactSphere| motions[sole.body.index()].pose.place(sole.center).y - sole.radius;
    soles.into_iter().map(low).fold(f64::INFINITY, f64::min)
}
