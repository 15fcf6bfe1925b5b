//! Converts shapes and materials of a scene to shapes and materials of the simulator.

use super::material::{MaterialEntry, MaterialLaw};
use super::obstacle::ObstacleShape;
use super::shape::Solid;
use super::{Place, SceneError};
use crate::contact::{HuntCrossley, Shape, ShapeError};
use crate::engine::world::{ContactLaw, Material};
use crate::numerics::elementary::atan2;
use crate::spatial::{Mat3, Pose, Vec3, rotation};
use std::f64::consts::PI;

pub(super) fn material(entry: &MaterialEntry) -> Material {
    match entry.law {
        MaterialLaw::Rigid { friction, restitution } => Material { friction, restitution, law: ContactLaw::Rigid },
        MaterialLaw::Regularised { friction, stiffness, damping } => {
            Material { friction, restitution: 0.0, law: ContactLaw::Regularised { stiffness, damping } }
        }
        MaterialLaw::HuntCrossley {
            stiffness,
            dissipation,
            static_friction,
            dynamic_friction,
            viscous_friction,
            transition_velocity,
        } => Material {
            friction: dynamic_friction,
            restitution: 0.0,
            law: ContactLaw::HuntCrossley(HuntCrossley {
                stiffness,
                dissipation,
                static_friction,
                dynamic_friction,
                viscous_friction,
                transition_velocity,
                ..HuntCrossley::FALISSE_2022
            }),
        },
    }
}

/// A solid in its own frame.
pub(super) fn solid(solid: &Solid, place: &Place) -> Result<Shape, SceneError> {
    let shape = match solid {
        Solid::Sphere { radius } => Shape::sphere(*radius),
        Solid::Capsule { from, to, radius } => Shape::capsule(*from, *to, *radius),
        Solid::Box { size } => Shape::cuboid(size / 2.0),
        Solid::Convex { points } => Shape::convex(points),
    };
    shape.map_err(|e| refused(&e, place))
}

/// The shape of an obstacle, and `obstacle_from_shape`.
pub(super) fn obstacle(shape: &ObstacleShape, place: &Place) -> Result<(Shape, Pose), SceneError> {
    match shape {
        ObstacleShape::Solid(shape) => Ok((solid(shape, place)?, Pose::IDENTITY)),
        ObstacleShape::Plane { normal } => {
            let pose = Pose { rotation: turning_y_to(normal), translation: Vec3::zeros() };
            Ok((Shape::half_space(), pose))
        }
        ObstacleShape::HeightField { heights, size_x, size_z } => {
            let columns = heights.first().map_or(0, Vec::len);
            let field = Shape::height_field(heights.len(), columns, &heights.concat(), *size_x, *size_z);
            Ok((field.map_err(|e| refused(&e, place))?, Pose::IDENTITY))
        }
    }
}

fn refused(error: &ShapeError, place: &Place) -> SceneError {
    place.error(error.to_string())
}

/// The smallest rotation that maps y to a unit vector.
fn turning_y_to(normal: &Vec3) -> Mat3 {
    let across = Vec3::y().cross(normal);
    let angle = atan2(across.norm(), normal.y);
    match across.try_normalize(f64::MIN_POSITIVE) {
        Some(axis) => rotation(&(axis * angle)),
        None if normal.y < 0.0 => rotation(&(Vec3::x() * PI)),
        None => Mat3::identity(),
    }
}
