//! Bodies that float freely in the world: the smallest models for tests of plates, events and filters.

#![allow(dead_code, reason = "each crate uses its own part")]
use ambulo::model::{
    Body, Coordinate, CoordinateId, CoordinateKind, Displacement, Drive, Function, Joint, JointAxis, JointSpeeds, Model,
};
use ambulo::spatial::{Inertia, Mat3, Pose, Vec3};

/// Gravity along -y, rounded.
pub(crate) const DOWN_Y: Vec3 = Vec3::new(0.0, -9.81, 0.0);

/// Coordinates of a body: angles about x, y, z, then positions along x, y, z.
pub(crate) const PARTS: [(&str, CoordinateKind); 6] = [
    ("rx", CoordinateKind::Rotation),
    ("ry", CoordinateKind::Rotation),
    ("rz", CoordinateKind::Rotation),
    ("tx", CoordinateKind::Translation),
    ("ty", CoordinateKind::Translation),
    ("tz", CoordinateKind::Translation),
];

/// Bodies of these names and masses [kg], each with six coordinates `<name>_rx` to `<name>_tz`.
pub(crate) fn free_bodies(gravity: Vec3, bodies: &[(&str, f64)]) -> Model {
    let ids = coordinate_ids(6 * bodies.len());
    let mut coordinates = Vec::new();
    let mut list = Vec::new();
    for (&(name, mass), ids) in bodies.iter().zip(ids.chunks(6)) {
        coordinates.extend(PARTS.map(|(part, kind)| free(&format!("{name}_{part}"), kind)));
        let axes = |ids: &[CoordinateId]| -> Vec<JointAxis> {
            [Vec3::x(), Vec3::y(), Vec3::z()].into_iter().zip(ids).map(|(d, id)| axis(d, *id)).collect()
        };
        let joint = Joint { rotations: axes(&ids[..3]), translations: axes(&ids[3..]), ..weld(name) };
        list.push(Body { name: name.to_owned(), inertia: ball(mass), joint });
    }
    Model::new("free bodies", gravity, list, coordinates, Vec::new()).unwrap()
}

/// Mass [kg] at the origin of the frame, with the same inertia about every axis.
pub(crate) fn ball(mass: f64) -> Inertia {
    Inertia::new(mass, Vec3::zeros(), Mat3::identity() * (0.01 * mass)).unwrap()
}

/// A free coordinate.
pub(crate) fn free(name: &str, kind: CoordinateKind) -> Coordinate {
    Coordinate { name: name.to_owned(), kind, default_value: 0.0, range: None, clamped: false, drive: Drive::Free }
}

/// An axis that follows a coordinate one to one.
pub(crate) fn axis(direction: Vec3, id: CoordinateId) -> JointAxis {
    JointAxis { direction, displacement: Displacement::Follows(id, Function::Linear { slope: 1.0, intercept: 0.0 }) }
}

/// A joint to ground without axes.
pub(crate) fn weld(body: &str) -> Joint {
    Joint {
        name: format!("{body}_to_ground"),
        parent: None,
        parent_from_joint: Pose::IDENTITY,
        child_from_joint: Pose::IDENTITY,
        rotations: Vec::new(),
        translations: Vec::new(),
        speeds: JointSpeeds::Rates,
    }
}

/// Coordinate ids, which only models create; they are valid in any model with this number of coordinates.
pub(crate) fn coordinate_ids(count: usize) -> Vec<CoordinateId> {
    let body = Body { name: "stand".into(), inertia: ball(1.0), joint: weld("stand") };
    let coordinates = (0..count).map(|i| free(&format!("q{i}"), CoordinateKind::Rotation)).collect();
    Model::new("ids", DOWN_Y, vec![body], coordinates, Vec::new()).unwrap().coordinate_ids().collect()
}
