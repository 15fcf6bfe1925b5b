//! Forces of one posture: contact forces of the soles by the law of soft contact, then inverse dynamics under them.

use super::settings::ConsistentWalkError;
use crate::contact::HuntCrossley;
use crate::dynamics::{BodyLoad, Workspace, inverse_frame};
use crate::kinematics::Posture;
use crate::model::anthropometry::{ContactSphere, Human};
use crate::model::{CoordinateId, Side};
use crate::spatial::{Vec3, Wrench};

/// Number of outputs of one instant: three of the root, twelve of each side.
pub(super) const OUTPUTS: usize = 3 + 2 * SIDE;
pub(super) const SIDE: usize = 12;
/// Offsets within a side: moments of hip, knee and ankle, vertical and fore-aft force, force under the toes, three heights,
/// three slips.
pub(super) const MOMENTS: usize = 0;
pub(super) const VERTICAL: usize = 3;
pub(super) const FORE_AFT: usize = 4;
pub(super) const TOE: usize = 5;
pub(super) const HEIGHTS: usize = 6;
pub(super) const SLIPS: usize = 9;
/// Load at which slip has half its weight [body weights].
const LIGHT: f64 = 0.05;

/// The parts of a figure that the problem uses.
pub(super) struct GroundedFigure<'a> {
    soles: [Vec<&'a ContactSphere>; 2],
    root: [CoordinateId; 3],
    moments: [[CoordinateId; 3]; 2],
    mass: f64,
    weight: f64,
    pub(super) leg_length: f64,
}

impl<'a> GroundedFigure<'a> {
    pub(super) fn of(human: &'a Human) -> Result<GroundedFigure<'a>, ConsistentWalkError> {
        let id = |name: &str| {
            let missing = || ConsistentWalkError::Coordinate { name: name.to_owned() };
            human.model.coordinate(name).ok_or_else(missing)
        };
        let leg = |letter: &str| -> Result<[CoordinateId; 3], ConsistentWalkError> {
            Ok([
                id(&format!("hip_flexion_{letter}"))?,
                id(&format!("knee_angle_{letter}"))?,
                id(&format!("ankle_angle_{letter}"))?,
            ])
        };
        let mass = human.model.mass();
        Ok(GroundedFigure {
            soles: Side::BOTH.map(|side| human.soles.iter().filter(|s| s.side == side).collect()),
            root: [id("pelvis_tx")?, id("pelvis_ty")?, id("pelvis_tilt")?],
            moments: [leg("r")?, leg("l")?],
            mass,
            weight: mass * human.model.gravity().norm(),
            leg_length: human.dimensions.leg_length,
        })
    }

    /// The outputs of a posture (value, rate and acceleration of every coordinate).
    pub(super) fn outputs(
        &self,
        workspace: &mut Workspace,
        shoes: &HuntCrossley,
        posture: &[Vec<f64>; 3],
    ) -> [f64; OUTPUTS] {
        let mut out = [0.0; OUTPUTS];
        let posture = Posture { q: &posture[0], qd: &posture[1], qdd: &posture[2] };
        let mut loads = Vec::with_capacity(6);
        let free = inverse_frame(workspace, posture, &[]);
        for (side, soles) in self.soles.iter().enumerate() {
            let base = 3 + SIDE * side;
            for (k, sole) in soles.iter().enumerate().take(3) {
                let motion = free.body_motion(sole.body);
                let center = motion.pose.rotation * sole.center + motion.pose.translation;
                let gap = center.y - sole.radius;
                // The simulator's contact point lies midway between the two surfaces.
                let point = Vec3::new(center.x, 0.5 * gap, center.z);
                let velocity = motion.twist.velocity_at(point - motion.center);
                let (normal, friction) = shoes.force(sole.radius, -gap, -velocity.y, Vec3::new(velocity.x, 0.0, 0.0));
                let load = normal / self.weight;
                out[base + VERTICAL] += load;
                out[base + FORE_AFT] += friction.x / self.weight;
                if k == 2 {
                    out[base + TOE] = load;
                }
                out[base + HEIGHTS + k] = gap;
                out[base + SLIPS + k] = velocity.x * load / (load + LIGHT);
                if normal > 0.0 {
                    let force = Vec3::new(friction.x, normal, 0.0);
                    let wrench = Wrench { moment: Vec3::zeros(), force };
                    loads.push(BodyLoad { body: sole.body, point, wrench });
                }
            }
        }
        let loaded = inverse_frame(workspace, posture, &loads);
        let tau = loaded.generalized();
        let scales = [self.weight, self.weight, self.weight * self.leg_length];
        for (k, scale) in scales.into_iter().enumerate() {
            out[k] = tau[self.root[k].index()] / scale;
        }
        for (side, joints) in self.moments.iter().enumerate() {
            for (k, joint) in joints.iter().enumerate() {
                out[3 + SIDE * side + MOMENTS + k] = tau[joint.index()] / self.mass;
            }
        }
        out
    }
}

/// Forces of the planned motion at an instant, before any simulation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlannedForces {
    /// Residual force and moment at the root: fore-aft and up [N], pitch [N.m].
    pub root: [f64; 3],
    /// Moments of hip, knee and ankle [N.m] with the signs of the model; right, left.
    pub moments: [[f64; 3]; 2],
    /// Fore-aft and vertical force on each foot [N].
    pub feet: [[f64; 2]; 2],
}

/// The forces of one posture (value, rate, acceleration of every coordinate).
pub(super) fn planned(
    human: &Human,
    shoes: &HuntCrossley,
    posture: &[Vec<f64>; 3],
) -> Result<PlannedForces, ConsistentWalkError> {
    let body = GroundedFigure::of(human)?;
    let out = body.outputs(&mut Workspace::new(&human.model), shoes, posture);
    let scales = [body.weight, body.weight, body.weight * body.leg_length];
    let side = |side: usize| 3 + SIDE * side;
    Ok(PlannedForces {
        root: std::array::from_fn(|k| out[k] * scales[k]),
        moments: [0, 1].map(|s| std::array::from_fn(|k| out[side(s) + MOMENTS + k] * body.mass)),
        feet: [0, 1].map(|s| [out[side(s) + FORE_AFT] * body.weight, out[side(s) + VERTICAL] * body.weight]),
    })
}
