//! Muscle moments at a joint, and their cost.

use super::instant::Instant;
use crate::model::anatomy::Anatomy;
use crate::model::{CoordinateId, Movement, Side};
use crate::numerics::elementary::{exp, hypot};

/// Muscle moment at a joint: its generalised force less the forces of tissue, a spring, a damper, and a device,
///
///   τ - Σ s exp(c + Σ aᵢ qᵢ) + k q + d q̇ - u
#[derive(Debug, Clone, PartialEq)]
pub struct Effort {
    /// The coordinate with the force τ.
    pub coordinate: CoordinateId,
    /// Passive forces of tissue.
    pub tissue: Vec<Exponential>,
    /// Stiffness k [N.m/rad or N/m].
    pub stiffness: f64,
    /// Damping d [N.m.s/rad or N.s/m].
    pub damping: f64,
    /// Force u of a device at each instant, and constant parts of the others [N.m or N]; none if empty.
    pub given: Vec<f64>,
}

/// A passive force that grows exponentially with coordinates: s exp(c + Σ aᵢ qᵢ).
#[derive(Debug, Clone, PartialEq)]
pub struct Exponential {
    /// Force s, with its sign [N.m or N].
    pub scale: f64,
    /// Exponent c of zero coordinates.
    pub constant: f64,
    /// Coordinates with their factors aᵢ [1/rad or 1/m].
    pub rates: Vec<(CoordinateId, f64)>,
}

/// Exponent above which a passive force grows linearly: above 245 times its scale. The first guesses of a solver may
/// bend joints too far.
const STEEPEST: f64 = 5.5;

impl Exponential {
    /// The force, and its derivative by the exponent.
    #[doc(hidden)] // for tests
    pub fn value(&self, at: &Instant) -> (f64, f64) {
        let exponent = self.constant + self.rates.iter().map(|(id, a)| a * at.posture[0][id.index()]).sum::<f64>();
        let value = self.scale * exp(exponent.min(STEEPEST));
        (value * (1.0 + (exponent - STEEPEST).max(0.0)), value)
    }
}

impl Effort {
    /// The whole force of a joint.
    #[must_use]
    pub fn whole(coordinate: CoordinateId) -> Effort {
        Effort { coordinate, tissue: Vec::new(), stiffness: 0.0, damping: 0.0, given: Vec::new() }
    }

    pub(super) fn value(&self, instant: usize, at: &Instant) -> f64 {
        let c = self.coordinate.index();
        let given = self.given.get(instant).copied().unwrap_or(0.0);
        let tissue: f64 = self.tissue.iter().map(|part| part.value(at).0).sum();
        at.forces[c] - tissue + self.stiffness * at.posture[0][c] + self.damping * at.posture[1][c] - given
    }

    /// Appends the derivatives, each multiplied by `factor`.
    pub(super) fn push_row(&self, at: &Instant, factor: f64, full: &mut Vec<f64>) {
        let (n, c, first) = (at.posture[0].len(), self.coordinate.index(), full.len());
        full.extend(at.slopes[c * 3 * n..(c + 1) * 3 * n].iter().map(|slope| slope * factor));
        full[first + c] += self.stiffness * factor;
        full[first + n + c] += self.damping * factor;
        for part in &self.tissue {
            let slope = part.value(at).1 * factor;
            for (id, rate) in &part.rates {
                full[first + id.index()] -= slope * rate;
            }
        }
    }
}

/// √(p₊ P₊ + p₋ P₋) of a mechanical power P, and its derivative by P.
pub(super) fn root_power(power: f64, [positive, negative]: [f64; 2], smooth_w: f64) -> (f64, f64) {
    let smooth = hypot(power, smooth_w);
    let (above, below) = (0.5 * (smooth + power), 0.5 * (smooth - power));
    let root = (positive * above + negative * below).sqrt();
    (root, (positive * above - negative * below) / (2.0 * root * smooth))
}

/// Passive moment of hip, knee or ankle about one joint of a leg, as a sum of exponentials of joint angles.
struct TissueLaw {
    movement: Movement,
    /// Scale [N.m], constant, and factors of hip flexion, knee flexion and ankle dorsiflexion [1/deg].
    parts: &'static [(f64, f64, [f64; 3])],
    /// Constant moment [N.m].
    constant: f64,
}

/// Moments of flexion and dorsiflexion of an adult's leg. Source: Riener and Edrich 1999 (J Biomech 32:539), as
/// transcribed, with the sign of the ankle changed, in published Matlab functions (read; the paper itself was not).
const TISSUE: [TissueLaw; 3] = [
    TissueLaw {
        movement: Movement::HipFlexion,
        parts: &[(1.0, 1.4655, [-0.0750, -0.0034, 0.0]), (-1.0, 1.3403, [0.0305, -0.0226, 0.0])],
        constant: 8.072,
    },
    TissueLaw {
        movement: Movement::KneeFlexion,
        parts: &[
            (1.0, 1.800, [0.0217, -0.0352, 0.0460]),
            (-1.0, -3.971, [-0.0128, 0.0495, 0.0004]),
            (1.0, 2.220, [0.0, -0.150, 0.0]),
        ],
        constant: -4.820,
    },
    TissueLaw {
        movement: Movement::AnkleDorsiflexion,
        parts: &[(1.0, -7.9763, [0.0, 0.0008, -0.1949]), (-1.0, 2.1016, [0.0, -0.0176, 0.0843])],
        constant: 1.792,
    },
];

/// Passive moment about a joint of a leg of an adult: its exponentials, and its constant part [N.m]. `None` for other
/// joints.
pub fn tissue_of(anatomy: &Anatomy, movement: Movement, side: Side) -> Option<(Vec<Exponential>, f64)> {
    let law = TISSUE.iter().find(|law| law.movement == movement)?;
    let (_, sign) = anatomy.coordinate(movement, Some(side))?;
    let joints = [Movement::HipFlexion, Movement::KneeFlexion, Movement::AnkleDorsiflexion];
    let exponential = |(scale, constant, factors): &(f64, f64, [f64; 3])| {
        let rate = |(joint, factor): (Movement, &f64)| {
            let (id, sign) = anatomy.coordinate(joint, Some(side))?;
            Some((id, factor.to_degrees() * sign))
        };
        let rates = joints.into_iter().zip(factors).filter_map(rate).filter(|(_, factor)| *factor != 0.0).collect();
        Exponential { scale: scale * sign, constant: *constant, rates }
    };
    Some((law.parts.iter().map(exponential).collect(), law.constant * sign))
}
