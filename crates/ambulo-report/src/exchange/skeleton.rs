//! Writes the motion of a model as a BVH skeleton: one joint per body, with an offset and three angles.
//!
//! Lengths are in centimetres, axes are the world's: x forward, y up, z right. R = R_z R_x R_y, so that
//!
//!   x = asin R₃₂        y = atan2(-R₃₁, R₃₃)        z = atan2(-R₁₂, R₂₂)
//!
//! Derived by multiplying out; at x = ±90° y and z are not unique. A joint that moves in its parent (a rolling knee)
//! has position channels that replace its offset. Bodies of common models get the names that animation programs expect.

use ambulo::kinematics::{Trajectory, each_body_motion};
use ambulo::model::anatomy::Leg;
use ambulo::model::{BodyId, Model, Side};
use ambulo::numerics::elementary::{asin, atan2};
use ambulo::spatial::{Mat3, Pose, Vec3};
use ambulo_formats::Error;
use ambulo_formats::bvh::{Bvh, Channel, ChannelKind, Joint};

const CENTIMETRES: f64 = 100.0;
/// A joint that moves by less than this in its parent has a constant offset [m].
const FIXED: f64 = 1e-9;

/// Bodies of trunk and arms in the usual models, and the joints that animation programs name after what they carry;
/// `{}` is Right or Left.
const NAMES: [(&str, &str); 7] = [
    ("pelvis", "Hips"),
    ("torso", "Spine"),
    ("humerus", "{}Arm"),
    ("ulna", "{}ForeArm"),
    ("forearm", "{}ForeArm"),
    ("hand", "{}Hand"),
    ("head", "Head"),
];

/// The motion as a skeleton.
///
/// # Errors
/// More bodies than a BVH file may have, or names that it cannot store.
pub fn skeleton_of(model: &Model, trajectory: &Trajectory) -> Result<Bvh, Error> {
    let order = depth_first(model);
    let poses = relative_poses(model, trajectory);
    let mut joints: Vec<Joint> = Vec::new();
    for &id in &order {
        let body = &model.bodies()[id.index()];
        let parent = body.joint.parent.and_then(|parent| order.iter().position(|&other| other == parent));
        let (offset, slides) = place(&poses[id.index()], parent.is_none());
        joints.push(Joint {
            name: name(model, id),
            parent,
            offset: (offset * CENTIMETRES).into(),
            channels: channels(slides),
            end_sites: end_sites(model, id),
        });
    }
    let frame = |frame: usize| -> Vec<f64> {
        let values = order.iter().zip(&joints).flat_map(|(id, joint)| {
            let Pose { rotation, translation } = poses[id.index()][frame];
            let place: [f64; 3] = (translation * CENTIMETRES).into();
            let slides = joint.channels.len() > 3;
            place.into_iter().filter(move |_| slides).chain(angles_deg(&rotation))
        });
        values.collect()
    };
    let frames: Vec<Vec<f64>> = (0..trajectory.grid().frames).map(frame).collect();
    Bvh::new(joints, trajectory.grid().step_s, &frames)
}

/// Sorts bodies so that each comes directly before all of its descendants.
fn depth_first(model: &Model) -> Vec<BodyId> {
    let parent = |id: &BodyId| model.bodies()[id.index()].joint.parent;
    // The stack returns the last one first.
    let mut open: Vec<BodyId> = model.body_ids().filter(|id| parent(id).is_none()).collect();
    open.reverse();
    let mut order = Vec::new();
    while let Some(body) = open.pop() {
        order.push(body);
        let mut carried: Vec<BodyId> = model.body_ids().filter(|id| parent(id) == Some(body)).collect();
        carried.reverse();
        open.extend(carried);
    }
    order
}

/// `parent_from_body` of every body in every frame.
fn relative_poses(model: &Model, trajectory: &Trajectory) -> Vec<Vec<Pose>> {
    let mut poses = vec![Vec::with_capacity(trajectory.grid().frames); model.bodies().len()];
    each_body_motion(model, trajectory, |_, bodies| {
        for ((body, motion), list) in model.bodies().iter().zip(bodies).zip(&mut poses) {
            let parent = body.joint.parent.map_or(Pose::IDENTITY, |parent| bodies[parent.index()].pose);
            list.push(parent.inverse() * motion.pose);
        }
    });
    poses
}

/// The offset of a joint while all channels are zero, and whether it translates. A root is at the origin.
fn place(poses: &[Pose], is_root: bool) -> (Vec3, bool) {
    let first = poses.first().map_or(Vec3::zeros(), |pose| pose.translation);
    let slides = poses.iter().any(|pose| (pose.translation - first).amax() > FIXED);
    (if is_root { Vec3::zeros() } else { first }, is_root || slides)
}

fn channels(slides: bool) -> Vec<Channel> {
    let turning = [2, 0, 1].map(|axis| Channel { kind: ChannelKind::Rotation, axis });
    let sliding = [0, 1, 2].map(|axis| Channel { kind: ChannelKind::Position, axis });
    sliding.into_iter().filter(|_| slides).chain(turning).collect()
}

/// z, x, y [degrees].
fn angles_deg(r: &Mat3) -> [f64; 3] {
    let x = asin(r[(2, 1)].clamp(-1.0, 1.0));
    let (y, z) = (atan2(-r[(2, 0)], r[(2, 2)]), atan2(-r[(0, 1)], r[(1, 1)]));
    [z, x, y].map(f64::to_degrees)
}

/// The end of a body without children, and the top of the head: the outermost marker, otherwise twice the mass centre.
fn end_sites(model: &Model, id: BodyId) -> Vec<[f64; 3]> {
    let markers = || model.markers().iter().filter(|marker| marker.body == Some(id));
    let is_leaf = model.bodies().iter().all(|body| body.joint.parent != Some(id));
    let end = if is_leaf {
        let furthest = markers().max_by(|a, b| a.location.norm().total_cmp(&b.location.norm()));
        let center = || model.bodies()[id.index()].inertia.center() * 2.0;
        Some(furthest.map_or_else(center, |marker| marker.location))
    } else {
        markers().find(|marker| marker.name == "vertex").map(|marker| marker.location)
    };
    end.map(|place| (place * CENTIMETRES).into()).into_iter().collect()
}

/// Joint names: legs, pelvis and trunk from the anatomy, other bodies from their names.
fn name(model: &Model, id: BodyId) -> String {
    let own = &model.bodies()[id.index()].name;
    let anatomy = model.anatomy();
    let of_leg = |leg: &Leg| {
        let words = [(Some(leg.thigh), "{}UpLeg"), (Some(leg.shank), "{}Leg"), (Some(leg.ankle), "{}Foot")];
        words.into_iter().chain([(leg.toes, "{}ToeBase")])
    };
    let central = [(anatomy.trunk(), "Spine"), (anatomy.pelvis().filter(|_| anatomy.trunk().is_some()), "Hips")];
    let legs = anatomy.legs().values().flatten().flat_map(of_leg);
    let by_anatomy = central.into_iter().chain(legs).find(|(body, _)| *body == Some(id)).map(|(_, word)| word);
    let stem = Side::split_name(own).map_or_else(|| own.clone(), |(_, stem)| stem);
    let by_name = || NAMES.iter().find(|(known, _)| *known == stem).map(|(_, word)| *word);
    let Some(known) = by_anatomy.or_else(by_name) else { return own.clone() };
    let word = match anatomy.body_side(id) {
        Some(Side::Right) => "Right",
        Some(Side::Left) => "Left",
        None => "",
    };
    known.replace("{}", word)
}
