//! Forces as arrows: an upward mesh of one metre, whose node is moved to the point, turned along the force and scaled
//! to its magnitude.

use super::material::Paint;
use super::mesh::{Triangles, frame};
use super::{GlbBuilder, METRES_PER_NEWTON};
use crate::stage::{BodyPath, ForceRole, Stage, StageForce, upward_to};
use ambulo::spatial::Vec3;
use serde_json::json;

/// Radius of the shaft and of the head, and where the head begins [m].
const SHAFT: f64 = 0.009;
const HEAD: f64 = 0.024;
const NECK: f64 = 0.88;

/// Adds all forces of a stage.
pub(super) fn add(stage: &Stage, builder: &mut GlbBuilder) {
    for force in &stage.forces {
        let paint = if force.role == ForceRole::Measured { Paint::Measured } else { Paint::of_side(force.side) };
        let Some(mesh) = builder.mesh(&format!("force {}", force.name), &arrow(), paint) else { continue };
        let mut node = json!({ "name": format!("force {}", force.name), "mesh": mesh });
        let Moving { place, turn, scale } = moving(force);
        let number = builder.nodes.len();
        builder.animation.place(number, &mut node, &place, &turn, &mut builder.buffer);
        builder.animation.channel(number, &mut node, "scale", &scale, &mut builder.buffer);
        builder.add_root(node);
    }
}

/// Pose and scale of an arrow, one row per instant.
struct Moving {
    place: Vec<[f64; 3]>,
    turn: Vec<[f64; 4]>,
    scale: Vec<[f64; 3]>,
}

/// While a force does not act, its arrow stays at its last place with scale zero.
fn moving(force: &StageForce) -> Moving {
    let acts = |(point, force): &(&Vec3, &Vec3)| point.iter().chain(force.iter()).all(|x| x.is_finite());
    let rows = || force.point.iter().zip(&force.force);
    let (mut place, mut direction) = rows().find(acts).map_or((Vec3::zeros(), Vec3::y()), |(p, f)| (*p, *f));
    let (mut path, mut scale) = (BodyPath::default(), Vec::new());
    for row in rows() {
        let length = if acts(&row) { row.1.norm() * METRES_PER_NEWTON } else { 0.0 };
        if length > 0.0 {
            (place, direction) = (*row.0, *row.1);
        }
        path.push_turned(place, upward_to(&direction));
        let width = if length > 0.0 { 1.0 } else { 0.0 };
        scale.push([width, length, width]);
    }
    Moving {
        place: path.position.iter().map(|place| (*place).into()).collect(),
        turn: path.rotation.iter().map(|turn| turn.coords.into()).collect(),
        scale,
    }
}

/// An arrow from the origin to one metre above it.
fn arrow() -> Triangles {
    let axes = frame(Vec3::y());
    let at = |height: f64| Vec3::y() * height;
    let mut all = Triangles::default();
    all.ring(at(0.0), axes, SHAFT, 0.0);
    all.ring(at(NECK), axes, SHAFT, 0.0);
    all.band();
    all.ring(at(NECK), axes, SHAFT, -1.0);
    all.ring(at(NECK), axes, HEAD, -1.0);
    all.band();
    all.ring(at(NECK), axes, HEAD, 0.2);
    all.ring(at(1.0), axes, 0.0, 0.2);
    all.band();
    all
}
