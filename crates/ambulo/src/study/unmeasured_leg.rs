//! A leg none of whose stances was measured, although the forces of the other leg were.
//!
//! Its moments, powers and reactions rest on predicted forces (or are unknown), while the residual is checked in the
//! stances of the other leg and cannot warn. Two cases look alike in the tables:
//!
//! - The step was beside the plates, over an edge, or on a plate with the other foot: laboratories with one plate
//!   measure one leg a trial, as planned. The data are good, and the leg is marked; spoiled steps have their own
//!   warnings.
//! - The foot stood on a plate that gave nothing: it was off, or left out by the user, or the file does not describe
//!   it. A load is lost; this is a warning, and the data are doubtful.
//!
//! Pinned by: tests/stance_loads.rs

use super::idle_forces::IdleForces;
use crate::findings::{Code, Findings};
use crate::ground::stances::{Stance, StanceSource, measured_share};
use crate::model::Side;

/// A leg without a measured load that should have one.
#[derive(Debug, Clone)]
pub(super) struct UnmeasuredLeg {
    side: Side,
    is_predicted: bool,
    /// Why its load is not there.
    why: String,
}

impl UnmeasuredLeg {
    /// Of these stances; `None` if a stance of each leg was measured, or none of any leg, or if the feet of the leg
    /// were on no plate.
    pub(super) fn of(stances: &[Stance], idle: &IdleForces) -> Option<UnmeasuredLeg> {
        let is_measured = |side: Side| measured_share(stances, side).map(|share| share > 0.0);
        let without = |side: &Side| is_measured(*side) == Some(false) && is_measured(side.other()) == Some(true);
        let side = Side::BOTH.into_iter().find(without)?;
        let is_predicted = stances.iter().any(|own| own.side == side && own.source == StanceSource::Predicted);
        Some(UnmeasuredLeg { side, is_predicted, why: idle.lost(side)?.to_owned() })
    }

    /// Which leg has no measured force, in a sentence.
    pub(super) fn message(&self) -> String {
        let UnmeasuredLeg { side, is_predicted, why } = self;
        let rest = if *is_predicted { "rest on predicted forces" } else { "are unknown" };
        format!(
            "0 % of the {side} leg's loaded time was measured ({why}): all moments, powers and reactions of this leg \
             {rest}"
        )
    }

    pub(super) fn report(&self, findings: &mut Findings) {
        let hint = "hint: find out why its load is missing, or choose another trial for this leg";
        findings.report(Code::StancesLegUnmeasured, format!("{}. {hint}", self.message()));
    }
}
