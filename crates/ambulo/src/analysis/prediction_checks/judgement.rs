//! Collects the outcomes of the checks of a prediction.

use super::{PredictionCheck, PredictionChecks};
use crate::analysis::feasibility::{Check, Reason, Thresholds};
use crate::findings::{Code, Findings};

/// The outcomes so far.
pub(super) struct Judgement<'a> {
    pub(super) checks: PredictionChecks,
    findings: &'a mut Findings,
    thresholds: &'a Thresholds,
}

/// Name, allowed range and unit of a check.
#[derive(Debug, Clone, Copy)]
pub(super) struct Criterion {
    pub(super) name: &'static str,
    pub(super) allowed: [f64; 2],
    pub(super) unit: &'static str,
}

/// A value and its time [s].
#[derive(Debug, Clone, Copy)]
pub struct TimedValue {
    pub value: f64,
    pub time_s: [f64; 2],
}

impl<'a> Judgement<'a> {
    pub(super) fn new(thresholds: &'a Thresholds, findings: &'a mut Findings) -> Judgement<'a> {
        Judgement { checks: PredictionChecks::default(), findings, thresholds }
    }

    /// Adds the value of a check; `true` if it passes.
    pub(super) fn take(&mut self, criterion: Criterion, found: TimedValue) -> bool {
        let Criterion { name, allowed, unit } = criterion;
        let passed = (allowed[0]..=allowed[1]).contains(&found.value);
        self.checks.checks.push(PredictionCheck {
            name: name.into(),
            passed: Some(passed),
            value: Some(found.value),
            allowed,
            unit: unit.into(),
            time_s: Some(found.time_s),
            not_judged: None,
        });
        passed
    }

    pub(super) fn skip(&mut self, criterion: Criterion, why: &'static str) {
        let Criterion { name, allowed, unit } = criterion;
        let check = PredictionCheck {
            name: name.into(),
            passed: None,
            value: None,
            allowed,
            unit: unit.into(),
            time_s: None,
            not_judged: Some(why.into()),
        };
        self.checks.checks.push(check);
    }

    pub(super) fn report(&mut self, code: Code, message: String) {
        self.findings.report(code, message);
    }

    /// Reports forces that do not act through the feet, also as a reason for an infeasible verdict unless the check is
    /// skipped.
    pub(super) fn report_infeasible(&mut self, check: Check, criterion: Criterion, found: TimedValue, message: String) {
        if !self.thresholds.judges(check) {
            return self.findings.report(Code::PredictionNotThroughTheFeet, message);
        }
        self.findings.report(Code::PredictionNotThroughTheFeet, message.clone());
        let limit = if found.value < criterion.allowed[0] { criterion.allowed[0] } else { criterion.allowed[1] };
        self.checks.reasons.push(Reason {
            check,
            quantity: format!("{}_needed", criterion.name.trim_end_matches("_needed")),
            side: None,
            time_s: found.time_s,
            at_s: 0.5 * (found.time_s[0] + found.time_s[1]),
            value: found.value,
            limit,
            unit: check.unit().into(),
            message,
        });
    }
}
