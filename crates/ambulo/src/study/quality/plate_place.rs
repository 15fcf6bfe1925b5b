//! Force plates whose places in the file are not those in the laboratory.
//!
//! Plates that are stated beside their place shift every centre of pressure by the same way. A foot carries its load
//! near the line of its sole, in most people a little outside of it; of both feet together the part outwards cancels.
//!
//! | symbol | meaning                                                                                            |
//! |--------|----------------------------------------------------------------------------------------------------|
//! | e      | distance of the centre of pressure from the line of the sole, to the right of the person [m]       |
//! | ē      | median of e over the frames in which a foot carries at least [`LOADED_BW`]                         |
//!
//! Judged is the mean of ē over both feet, or ē of one foot less [`OUTWARDS_M`]. With the limit of 30 mm none of 60
//! clean recordings is called wrong, and 32 of 33 whose plates were moved by 60 mm are (`cargo xtask twins`). Along the
//! foot the load travels from heel to toes, so that a shift in this direction is judged by the ends of the sole
//! (`Measure::CenterOfPressure`).
//!
//! Pinned by: tests/quality.rs

use super::{Measure, QualityReason, millimetres};
use crate::findings::{Code, Findings};
use crate::ground::{GroundForces, feet};
use crate::kinematics::{Trajectory, each_body_motion};
use crate::model::anatomy::Sole;
use crate::model::{BySide, Model, Side};
use crate::numerics::median;
use crate::spatial::Vec3;

/// Vertical force from which on a frame counts, as a share of the weight.
const LOADED_BW: f64 = 0.5;
/// Fewest frames of a foot.
const FEWEST: usize = 10;
/// How far outside of the line of the sole people load a foot on average [m].
const OUTWARDS_M: f64 = 0.005;

/// How far the measured centres of pressure lie beside the feet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::study) struct PlatePlace {
    /// To the right of the person [m].
    pub(super) right_m: f64,
    /// Number of feet that show it.
    pub(super) feet: usize,
}

impl PlatePlace {
    /// `None` if no foot is loaded long enough.
    pub(in crate::study) fn of(
        model: &Model,
        trajectory: &Trajectory,
        soles: &BySide<Option<Sole>>,
        ground: &GroundForces,
    ) -> Option<PlatePlace> {
        let forces = feet(model, ground);
        let (up, least_n) = (model.up(), LOADED_BW * model.mass() * model.gravity().norm());
        let mut beside: BySide<Vec<f64>> = BySide::from_fn(|_| Vec::new());
        each_body_motion(model, trajectory, |frame, bodies| {
            for (side, foot) in &forces {
                let Some(sole) = soles[*side].as_ref() else { continue };
                if foot.force[frame].dot(&up) >= least_n {
                    let [rear, _, tip] = sole.points.map(|p| bodies[p.body.index()].pose.place(p.place));
                    beside[*side].extend(to_the_right([rear, tip], foot.center_of_pressure[frame], up));
                }
            }
        });
        let of_side = |side: Side| median(beside[side].iter().copied()).filter(|_| beside[side].len() >= FEWEST);
        let found: Vec<(Side, f64)> = Side::BOTH.into_iter().filter_map(|side| Some((side, of_side(side)?))).collect();
        match found[..] {
            [(_, right), (_, left)] => Some(PlatePlace { right_m: 0.5 * (right + left), feet: 2 }),
            [(Side::Right, right_m)] => Some(PlatePlace { right_m: right_m - OUTWARDS_M, feet: 1 }),
            [(Side::Left, right_m)] => Some(PlatePlace { right_m: right_m + OUTWARDS_M, feet: 1 }),
            _ => None,
        }
    }
}

impl PlatePlace {
    /// Reports a place beyond the limit of good data.
    pub(in crate::study) fn report(&self, findings: &mut Findings) {
        if let Some(reason) = self.reason() {
            findings.report(Code::PlatesMisplaced, reason.message);
        }
    }

    pub(super) fn reason(&self) -> Option<QualityReason> {
        Measure::PlatePlace.reason(self.right_m.abs(), |limit| self.sentence(limit))
    }

    /// What is wrong, in words; `limit` in metres.
    fn sentence(&self, limit: f64) -> String {
        let side = if self.right_m > 0.0 { "right" } else { "left" };
        let feet = if self.feet == 2 { "both feet" } else { "the foot" };
        format!(
            "the measured centres of pressure lie {} to the {side} of the middle of {feet} (at most {}): the force \
             plates are not where the file states",
            millimetres(self.right_m.abs()),
            millimetres(limit)
        )
    }
}

/// Distance of a point from a line along the ground, to the right of its direction [m].
fn to_the_right([from, to]: [Vec3; 2], point: Vec3, up: Vec3) -> Option<f64> {
    let along = (to - from) - up * up.dot(&(to - from));
    let right = along.try_normalize(1e-6)?.cross(&up);
    Some((point - from).dot(&right)).filter(|distance| distance.is_finite())
}
