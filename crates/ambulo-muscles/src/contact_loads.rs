//! Loads that hip, knee and ankle carry, with the tension of the muscles.
//!
//! The reaction of a joint from inverse dynamics alone is net: muscles that cross the joint press it together, and the
//! net reaction contains their sum. With the tensions as loads on the bodies, the same inverse dynamics gives the load
//! that the joint itself carries. Along the free axes of the joint what is left is the moment of the reserves.
//!
//!   F_medial = C / 2 - s M / d     F_lateral = C / 2 + s M / d
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | C | compression of the knee: force of the thigh on the shank down the long axis of the shank | N |
//! | M | moment of the thigh on the shank about the forward axis, at the knee centre | N.m |
//! | d | distance between the centres of pressure of both condyles | m |
//! | s | +1 on the right, -1 on the left | |
//!
//! Assumed: both condyles touch in points at d / 2 on each side of the knee centre, and ligaments carry no frontal
//! moment. A negative share means that this condyle would lift off: then ligaments carry a moment that is not modelled.
//!
//! Not handled: contact areas, ligaments, the patella's own load.
//! Pinned by: tests/contact_loads.rs (OpenSim's JointReaction)

use ambulo_body::dynamics::ReactionReader;
use ambulo_body::kinematics::Trajectory;
use ambulo_body::model::anatomy::LegJoint;
use ambulo_body::model::{BodyId, BySide, Model, Side};
use ambulo_body::spatial::{Vec3, Wrench};

/// Distance between the centres of pressure of both condyles at a knee of [`KNEE_WIDTH_M`] [m].
pub const CONDYLE_DISTANCE_M: f64 = 0.04;
/// Width of a knee with [`CONDYLE_DISTANCE_M`] [m].
pub const KNEE_WIDTH_M: f64 = 0.09;

/// Load of one joint over the frames of a motion.
#[derive(Debug, Clone, PartialEq)]
pub struct JointLoad {
    /// The body whose joint to its parent this is: the child.
    pub body: BodyId,
    /// Force [N] and moment about the joint centre [N.m] of the parent on the child in the axes of the child's frame,
    /// as OpenSim's JointReaction gives them; one per frame.
    pub in_child: Vec<Wrench>,
    /// The same load on the distal segment in axes of the joint: forward (floating axis of the joint coordinate
    /// system), up (long axis of the distal segment), and to the right, perpendicular to both.
    pub in_joint: Vec<Wrench>,
}

/// How both condyles share the load of a knee; one entry per frame.
#[derive(Debug, Clone, PartialEq)]
pub struct KneeShares {
    /// Distance between the centres of pressure [m].
    pub condyle_distance_m: f64,
    /// Force on the medial condyle along the long axis of the shank [N]; negative means lift-off.
    pub medial: Vec<f64>,
    /// Force on the lateral condyle [N].
    pub lateral: Vec<f64>,
}

/// Loads of the joints of one leg.
#[derive(Debug, Clone, PartialEq)]
pub struct LegLoads {
    /// Hip, knee and ankle.
    pub joints: [JointLoad; 3],
    /// Shares of the condyles.
    pub knee: KneeShares,
}

/// Distance between the condyles for a knee width [m]: in proportion, and [`CONDYLE_DISTANCE_M`] if it is not known.
#[must_use]
pub fn condyle_distance(knee_width_m: Option<f64>) -> f64 {
    knee_width_m.map_or(CONDYLE_DISTANCE_M, |width| CONDYLE_DISTANCE_M * width / KNEE_WIDTH_M)
}

/// The loads of both legs. `reader` reads the reactions under ground forces and muscle tensions
/// ([`MuscleTrial::reader`](crate::trial::MuscleTrial::reader)); `condyle_distance_m` may differ by side.
#[must_use]
pub fn contact_loads(
    model: &Model,
    trajectory: &Trajectory,
    reader: &ReactionReader<'_>,
    condyle_distance_m: BySide<f64>,
) -> BySide<Option<LegLoads>> {
    BySide::from_fn(|side| {
        model.anatomy().legs()[side].as_ref()?;
        let frames = trajectory.grid().frames;
        let [hip, knee, ankle] = LegJoint::ALL.map(|joint| joint_load(model, frames, reader, joint, side));
        let joints = [hip?, knee?, ankle?];
        let knee = shares(&joints[1].in_joint, side, condyle_distance_m[side]);
        Some(LegLoads { joints, knee })
    })
}

fn joint_load(
    model: &Model,
    frames: usize,
    reader: &ReactionReader<'_>,
    joint: LegJoint,
    side: Side,
) -> Option<JointLoad> {
    let mut load: Option<JointLoad> = None;
    for frame in 0..frames {
        let at = model.leg_joint(joint, side, |body| reader.body_motion(body, frame).pose.rotation)?;
        let reaction = reader.at(at.body, frame).wrench;
        let turned = reader.body_motion(at.body, frame).pose.rotation.transpose();
        let [forward, up, _] = at.axes;
        let right = forward.cross(&up);
        let along = |v: Vec3| Vec3::new(forward.dot(&v), up.dot(&v), right.dot(&v)) * at.on_distal;
        let empty =
            || JointLoad { body: at.body, in_child: Vec::with_capacity(frames), in_joint: Vec::with_capacity(frames) };
        let load = load.get_or_insert_with(empty);
        load.in_child.push(Wrench { moment: turned * reaction.moment, force: turned * reaction.force });
        load.in_joint.push(Wrench { moment: along(reaction.moment), force: along(reaction.force) });
    }
    load
}

fn shares(in_joint: &[Wrench], side: Side, condyle_distance_m: f64) -> KneeShares {
    let sign = if side == Side::Right { 1.0 } else { -1.0 };
    let share = |sign: f64| {
        let half = |load: &Wrench| -0.5 * load.force.y + sign * load.moment.x / condyle_distance_m;
        in_joint.iter().map(half).collect()
    };
    KneeShares { condyle_distance_m, medial: share(-sign), lateral: share(sign) }
}
