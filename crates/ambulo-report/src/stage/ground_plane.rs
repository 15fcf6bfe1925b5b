//! Draws infinite ground planes: a level plane as the floor, a tilted one as a slab under the moving bodies.

use super::Stage;
use super::path::upward_to;
use crate::page::ViewShape;
use crate::scene_shapes::{GroundPlane, SceneShapes};
use ambulo::spatial::Vec3;

/// Cosine of the tilt below which ground counts as level: 0.5 degrees.
const LEVEL: f64 = 0.999_96;
/// Margin of a slab beyond the moving bodies, and half its thickness [m].
const MARGIN: f64 = 2.0;
const HALF_THICKNESS: f64 = 0.01;

/// Sets the floor of a stage and adds its slabs.
pub(super) fn lay(stage: &mut Stage, shapes: &SceneShapes) {
    let up = (-Vec3::from(shapes.gravity_m_s2)).try_normalize(f64::MIN_POSITIVE).unwrap_or_else(Vec3::y);
    let planes: Vec<GroundPlane> =
        shapes.obstacles.iter().filter(|obstacle| !obstacle.moves).flat_map(|o| o.planes.clone()).collect();
    let is_level = |plane: &&GroundPlane| Vec3::from(plane.normal).dot(&up) > LEVEL && up.y > LEVEL;
    let floor = planes.iter().filter(is_level).map(|plane| plane.point[1]).max_by(f64::total_cmp);
    let (low, high) = around(stage);
    stage.floor_m = floor.unwrap_or(low.y);
    let tilted = planes.iter().filter(|plane| !is_level(plane)).map(|plane| slab(plane, low, high));
    stage.fixed.extend(tilted);
}

/// The box around all bodies and obstacles; around the origin if there are none.
fn around(stage: &Stage) -> (Vec3, Vec3) {
    let moving = stage.bodies.iter().flat_map(|body| body.path.position.iter().copied());
    let standing = stage.fixed.iter().flat_map(|shape| match shape {
        ViewShape::Capsule { from, to, .. } => vec![Vec3::from(*from), Vec3::from(*to)],
        ViewShape::Box { center, half, .. } => {
            let reach = Vec3::repeat(Vec3::from(*half).norm());
            vec![Vec3::from(*center) - reach, Vec3::from(*center) + reach]
        }
        ViewShape::Mesh { points, .. } => points.iter().map(|point| Vec3::from(*point)).collect(),
    });
    let nothing = (Vec3::repeat(f64::INFINITY), Vec3::repeat(f64::NEG_INFINITY));
    let (low, high) = moving.chain(standing).fold(nothing, |(low, high), p| (low.inf(&p), high.sup(&p)));
    if low.x.is_finite() { (low, high) } else { (Vec3::zeros(), Vec3::zeros()) }
}

fn slab(plane: &GroundPlane, low: Vec3, high: Vec3) -> ViewShape {
    let (point, normal) = (Vec3::from(plane.point), Vec3::from(plane.normal));
    let middle = (low + high) * 0.5;
    let below = middle - normal * (middle - point).dot(&normal) - normal * HALF_THICKNESS;
    let reach = 0.5 * (high - low).norm() + MARGIN;
    let turn = upward_to(&normal).coords.into();
    ViewShape::Box { center: below.into(), half: [reach, HALF_THICKNESS, reach], turn }
}
