//! What is known of an instant before anything is changed: the gait's posture, and what is aimed at.

use super::unknowns::{Input, Layout, reference};
use crate::gait::{GroundForceLaws, Walk};
use crate::model::anthropometry::Human;

/// The foot is in swing from this share of the cycle after foot off to this share before the next strike, at heel, ball and toes.
const SWING_MARGINS: [[f64; 2]; 3] = [[0.03, 0.025], [0.03, 0.04], [0.03, 0.04]];
/// How far toes bend up at most in the guess [rad].
const TOES_LIMIT: f64 = 0.8;

/// What is known of one instant before anything is changed.
pub(super) struct Instant {
    /// Value, rate and acceleration of every coordinate.
    pub(super) posture: [Vec<f64>; 3],
    /// How coordinates follow the coefficients.
    pub(super) inputs: Vec<Input>,
    /// Coefficients of all inputs, one after the other.
    pub(super) columns: Vec<usize>,
    /// Right and left.
    pub(super) sides: [SideTarget; 2],
}

/// What is aimed at on one side.
pub(super) struct SideTarget {
    /// Vertical and fore-aft force [body weights].
    pub(super) force: [f64; 2],
    /// Angle of the toes [rad].
    pub(super) toes: f64,
    /// Whether heel, ball and toes have to be clear of the ground.
    pub(super) swing: [bool; 3],
}

impl Instant {
    pub(super) fn new(human: &Human, walk: &Walk, layout: &Layout, forces: &GroundForceLaws, phase: f64) -> Instant {
        let count = human.model.coordinates().len();
        let mut posture = [vec![0.0; count], vec![0.0; count], vec![0.0; count]];
        let time_s = phase * walk.cycle_s();
        let [q, qd, qdd] = &mut posture;
        reference(walk, layout, time_s, q, qd, qdd);
        let inputs = layout.inputs(phase, walk.cycle_s());
        let columns = inputs.iter().flat_map(|input| input.numbers).collect();
        let at = walk.at(time_s);
        let sides = [(&at.right, 0.0), (&at.left, 0.5)].map(|(leg, ahead)| {
            let place = (phase + ahead) % 1.0;
            let pitch = leg.hip.value - at.pelvis_tilt.value - leg.knee.value + leg.ankle.value;
            let stands = place < at.phases.foot_off;
            SideTarget {
                force: forces.at(place, walk.curve_speed(&walk.clock(time_s)).value),
                toes: if stands { (-pitch).clamp(0.0, TOES_LIMIT) } else { 0.0 },
                swing: SWING_MARGINS.map(|[after, before]| place > at.phases.foot_off + after && place < 1.0 - before),
            }
        });
        Instant { posture, inputs, columns, sides }
    }
}
