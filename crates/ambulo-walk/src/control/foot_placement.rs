//! Balance by foot placement and by the torque of the stance hip, for planar figures.
//!
//! The hip of the swing leg turns further by
//!
//!   Δθ = c_d (d - d*) + c_v (v - v*)
//!
//! with the distance d of the mass centre in front of the stance foot and its velocity v; a star marks the plan. The
//! hip of the stance leg holds the pelvis upright in the world instead of following its own angle: its torque on the
//! pelvis is k (θ* - θ) + d (θ̇* - θ̇) plus the torque of the plan, and it carries the reaction of the swing leg.
//!
//! Source: Yin, Loken, van de Panne 2007, SIMBICON, ACM Trans Graph 26(3):105 (unverified), with a plan in place of its
//! fixed postures. Pinned by: docs/measured/PHYSICAL_WALK.md, which compares it with the feedback of the whole state.

use super::linear::Impedance;
use super::settings::{ControlError, FootPlacement};
use crate::kinematics::{Posture, body_motion};
use crate::model::{BodyId, Model, Movement, Side};

/// Coordinates and bodies of a planar figure that the law uses.
#[derive(Debug, Clone)]
pub(super) struct PlacedFeet {
    settings: FootPlacement,
    /// Coordinates of the right and the left hip.
    hips: [usize; 2],
    feet: [BodyId; 2],
    tilt: usize,
    /// Stiffness [N.m/rad] and damping [N.m.s/rad] of the trunk in this figure.
    trunk: [f64; 2],
}

/// State and plan of a figure in a step: coordinates and rates.
pub(super) struct Followed<'a> {
    pub(super) now: [&'a [f64]; 2],
    pub(super) planned: [&'a [f64]; 2],
}

impl PlacedFeet {
    /// The law for a figure whose torques are `size` times the torques of an adult.
    pub(super) fn new(model: &Model, settings: FootPlacement, size: f64) -> Result<PlacedFeet, ControlError> {
        let anatomy = model.anatomy();
        let hip = |side| anatomy.coordinate(Movement::HipFlexion, Some(side)).map(|(id, _)| id.index());
        let [right, left] = Side::BOTH.map(hip);
        let tilt = model.coordinate("pelvis_tilt").map(|id| id.index());
        let is_planar = model.coordinate("pelvis_list").is_none();
        match (right, left, anatomy.feet(), tilt.filter(|_| is_planar)) {
            (Some(right), Some(left), Some(feet), Some(tilt)) => Ok(PlacedFeet {
                settings,
                hips: [right, left],
                feet: [feet.right, feet.left],
                tilt,
                trunk: settings.trunk.map(|of_adult| of_adult * size),
            }),
            _ => Err(ControlError::NotPlanar),
        }
    }

    /// Torques of both hips in addition to plan and impedance [N.m], for the stance leg.
    pub(super) fn torques(
        &self,
        model: &Model,
        impedances: &[Impedance],
        state: &Followed<'_>,
        stance: usize,
    ) -> [(usize, f64); 2] {
        let Followed { now, planned } = state;
        let [[d, v], [d_planned, v_planned]] = [now, planned].map(|[q, qd]| self.center(model, [*q, *qd], stance));
        let further = self.settings.distance * (d - d_planned) + self.settings.velocity * (v - v_planned);
        let behind = |c: usize| [planned[0][c] - now[0][c], planned[1][c] - now[1][c]];
        let drawn = |c: usize| {
            let ([angle, rate], impedance) = (behind(c), &impedances[c]);
            impedance.stiffness * angle + impedance.damping * rate
        };
        let (standing, swinging) = (self.hips[stance], self.hips[1 - stance]);
        let placing = impedances[swinging].stiffness * further;
        let [lean, rate] = behind(self.tilt);
        let upright = self.trunk[0] * lean + self.trunk[1] * rate;
        [(swinging, placing), (standing, -upright - placing - drawn(swinging) - drawn(standing))]
    }

    /// Distance of the mass centre in front of a foot [m] and its velocity [m/s].
    fn center(&self, model: &Model, [q, qd]: [&[f64]; 2], foot: usize) -> [f64; 2] {
        let still = vec![0.0; q.len()];
        let motions = body_motion(model, Posture { q, qd, qdd: &still });
        let masses = || model.bodies().iter().map(|body| body.inertia.mass());
        let along: f64 = masses().zip(&motions).map(|(mass, body)| mass * body.center.x).sum();
        let speed: f64 = masses().zip(&motions).map(|(mass, body)| mass * body.twist.linear.x).sum();
        let foot = motions[self.feet[foot].index()].pose.translation.x;
        [along / model.mass() - foot, speed / model.mass()]
    }
}
