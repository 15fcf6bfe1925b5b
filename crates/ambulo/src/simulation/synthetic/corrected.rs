//! The corrected mode: the gait made consistent, then stepped on soft shoes.

use super::order::SyntheticWalkSettings;
use super::report::CorrectionReport;
use super::steady::{simulated_cycles, steady};
use super::{SyntheticError, SyntheticWalk};
use crate::findings::{Code, Findings};
use crate::gait::Walk;
use crate::model::anthropometry::Human;
use crate::simulation::consistent_walk::{ConsistentWalk, ConsistentWalkSettings, make_consistent_walk};

/// Cycles until the simulated walk is steady: it starts on the planned motion.
const LEFT_OUT: usize = 1;
/// A root that lacks more than these shares of weight, and of weight times leg length, rms, was not made consistent.
const LACKING: [f64; 2] = [0.01, 0.005];

pub(super) fn walk(
    order: &SyntheticWalkSettings<'_>,
    human: Human,
    findings: &mut Findings,
) -> Result<SyntheticWalk, SyntheticError> {
    let walk = Walk::new(order.gait, human.dimensions.leg_length, findings)?;
    let settings = ConsistentWalkSettings::default();
    let consistent = make_consistent_walk(&human, &walk, &settings)?;
    let correction = report(&consistent, &human, &settings, findings)?;
    let recording =
        consistent.simulate(&human, &settings, order.step_s(), simulated_cycles(order, LEFT_OUT), findings)?;
    steady(order, LEFT_OUT, human, walk, &recording, Some(correction))
}

fn report(
    consistent: &ConsistentWalk,
    human: &Human,
    settings: &ConsistentWalkSettings,
    findings: &mut Findings,
) -> Result<CorrectionReport, SyntheticError> {
    let lacking = consistent.lacking(human, &settings.shoes)?;
    let weight = human.model.mass() * human.model.gravity().norm();
    let allowed = [LACKING[0] * weight, LACKING[1] * weight * human.dimensions.leg_length];
    if lacking[0].rms > allowed[0] || lacking[1].rms > allowed[1] {
        let message = format!(
            "no small change makes this gait one that the ground carries: {:.1} N and {:.1} N.m rms are missing at the root (at most {:.1} N and {:.1} N.m are taken as none); what is missing is given from outside, and the verdict judges it. hint: choose another speed, step length or style",
            lacking[0].rms, lacking[1].rms, allowed[0], allowed[1]
        );
        findings.report(Code::WalkNotConsistent, message);
    }
    Ok(CorrectionReport {
        parameters: consistent.parameters(),
        adjustment: consistent.adjustment(&human.model),
        lacking,
        progress: consistent.progress.clone(),
    })
}
