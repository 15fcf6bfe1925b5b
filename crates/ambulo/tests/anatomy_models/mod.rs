//! Published models, and transformations of a model that do not change its anatomy.

use crate::shared_data;
use ambulo::findings::Findings;
use ambulo::model::{Body, BodyId, Coordinate, CoordinateId, Displacement, Drive, Function, JointAxis, Model};
use ambulo::spatial::{Inertia, Mat3, Pose, Vec3};

/// Files below `shared/data`.
const FILES: [&str; 5] = [
    "opensim-gait2392-subject01/subject01_simbody.osim",
    "opensim-gait10dof-subject01/subject01.osim",
    "opensim-rajagopal-walk/subject_walk_scaled.osim",
    "markerless-pose2sim/body25b.osim",
    "markerless-pose2sim/simple.osim",
];

/// The model of `ambulo demo`.
pub(crate) fn demo() -> Model {
    osim(include_bytes!("../../../ambulo-cli/tests/recording/figure.osim"))
}

pub(crate) fn gait2392() -> Option<Model> {
    Some(osim(&std::fs::read(shared_data::data()?.join(FILES[0])).unwrap()))
}

pub(crate) fn rajagopal() -> Option<Model> {
    Some(osim(&std::fs::read(shared_data::data()?.join(FILES[2])).unwrap()))
}

/// The model of the demo, and published models if they are available.
pub(crate) fn published() -> Vec<Model> {
    let folder = shared_data::data();
    let files = folder.iter().flat_map(|folder| FILES.map(|file| osim(&std::fs::read(folder.join(file)).unwrap())));
    std::iter::once(demo()).chain(files).collect()
}

fn osim(bytes: &[u8]) -> Model {
    Model::from_osim(bytes, &mut Findings::default()).unwrap()
}

fn rebuilt(model: &Model, gravity: Vec3, bodies: Vec<Body>, coordinates: Vec<Coordinate>) -> Model {
    Model::new(model.name(), gravity, bodies, coordinates, Vec::new()).unwrap()
}

/// The model with each body changed; `change` gets the number of the body.
pub(crate) fn change(model: &Model, mut change: impl FnMut(usize, &mut Body)) -> Model {
    let mut bodies = model.bodies().to_vec();
    bodies.iter_mut().enumerate().for_each(|(i, body)| change(i, body));
    rebuilt(model, model.gravity(), bodies, model.coordinates().to_vec())
}

/// Bodies, joints and coordinates with other names, from their numbers and names.
pub(crate) fn renamed(model: &Model, name: impl Fn(usize, &str) -> String) -> Model {
    let bodies = model.bodies().iter().enumerate().map(|(i, body)| {
        let mut body = Body { name: name(i, &body.name), ..body.clone() };
        body.joint.name = name(i, &body.joint.name);
        body
    });
    let coordinates =
        model.coordinates().iter().enumerate().map(|(i, c)| Coordinate { name: name(i, &c.name), ..c.clone() });
    rebuilt(model, model.gravity(), bodies.collect(), coordinates.collect())
}

/// The model mirrored at the plane of walking: every position with z reversed, every axis of rotation as a
/// pseudovector.
pub(crate) fn mirrored(model: &Model) -> Model {
    let m = Mat3::from_diagonal(&Vec3::new(1.0, 1.0, -1.0));
    let pose = |p: &Pose| Pose { rotation: m * p.rotation * m, translation: m * p.translation };
    change(model, |_, body| {
        let inertia = &body.inertia;
        body.inertia = Inertia::new(inertia.mass(), m * inertia.center(), m * inertia.about_center() * m).unwrap();
        let joint = &mut body.joint;
        joint.parent_from_joint = pose(&joint.parent_from_joint);
        joint.child_from_joint = pose(&joint.child_from_joint);
        joint.rotations.iter_mut().for_each(|axis| axis.direction = -(m * axis.direction));
        joint.translations.iter_mut().for_each(|axis| axis.direction = m * axis.direction);
    })
}

/// The same in a world with other axes.
pub(crate) fn turned(model: &Model, other_from_world: &Mat3) -> Model {
    let turn = Pose { rotation: *other_from_world, translation: Vec3::new(0.3, -2.0, 7.0) };
    let changed = change(model, |_, body| {
        if body.joint.parent.is_none() {
            body.joint.parent_from_joint = turn * body.joint.parent_from_joint;
        }
    });
    rebuilt(model, other_from_world * model.gravity(), changed.bodies().to_vec(), model.coordinates().to_vec())
}

/// The same with other frames for its bodies.
pub(crate) fn reframed(model: &Model, mut pose: impl FnMut() -> Pose) -> Model {
    let new_from_old: Vec<Pose> = model.bodies().iter().map(|_| pose()).collect();
    change(model, |i, body| {
        body.inertia = body.inertia.seen_from(&new_from_old[i]);
        let joint = &mut body.joint;
        joint.child_from_joint = new_from_old[i] * joint.child_from_joint;
        if let Some(parent) = joint.parent {
            joint.parent_from_joint = new_from_old[parent.index()] * joint.parent_from_joint;
        }
    })
}

/// An axis whose coordinate has the opposite sign.
pub(crate) fn count_backwards(axis: &mut JointAxis, id: CoordinateId) {
    if let Displacement::Follows(leader, function) = &axis.displacement
        && *leader == id
    {
        // At zero, where the anatomy is determined, f(-q) has the slope -f'(q) and the same value.
        let [value, slope, _] = function.at(0.0);
        axis.displacement = Displacement::Follows(id, Function::Linear { slope: -slope, intercept: value });
    }
}

/// The model without some bodies, and without their coordinates.
pub(crate) fn without(model: &Model, gone: impl Fn(BodyId) -> bool) -> Model {
    let kept: Vec<BodyId> = model.body_ids().filter(|id| !gone(*id)).collect();
    let ids: Vec<BodyId> = model.body_ids().collect();
    let coordinate_ids: Vec<CoordinateId> = model.coordinate_ids().collect();
    let moves = |id: &CoordinateId| kept.iter().any(|b| model.bodies()[b.index()].joint.coordinates().contains(id));
    let left: Vec<CoordinateId> = coordinate_ids.iter().copied().filter(moves).collect();
    let body_id = |old: BodyId| ids[kept.iter().position(|id| *id == old).unwrap()];
    let coordinate_id = |old: CoordinateId| coordinate_ids[left.iter().position(|id| *id == old).unwrap()];
    let bodies = kept.iter().map(|id| {
        let mut body = model.bodies()[id.index()].clone();
        body.joint.parent = body.joint.parent.map(body_id);
        for axis in body.joint.rotations.iter_mut().chain(&mut body.joint.translations) {
            if let Displacement::Follows(id, _) = &mut axis.displacement {
                *id = coordinate_id(*id);
            }
        }
        body
    });
    let coordinates = left.iter().map(|id| {
        let mut coordinate = model.coordinates()[id.index()].clone();
        if let Drive::Coupled(leader, _) = &mut coordinate.drive {
            *leader = coordinate_id(*leader);
        }
        coordinate
    });
    rebuilt(model, model.gravity(), bodies.collect(), coordinates.collect())
}
