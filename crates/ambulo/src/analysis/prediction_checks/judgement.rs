//! Where the checks write down what they found.

use super::{PredictionCheck, PredictionChecks};
use crate::analysis::feasibility::{Check, Reason, Thresholds};
use crate::findings::{Code, Findings};

/// What was found so far.
pub(super) struct Judgement<'a> {
    pub(super) checks: PredictionChecks,
    findings: &'a mut Findings,
    judged: &'a Thresholds,
}

/// What was looked at, and what passes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Looked {
    pub(super) name: &'static str,
    pub(super) allowed: [f64; 2],
    pub(super) unit: &'static str,
}

/// A value and its time [s].
#[derive(Debug, Clone, Copy)]
pub(super) struct Found {
    pub(super) value: f64,
    pub(super) time_s: [f64; 2],
}

impl<'a> Judgement<'a> {
    pub(super) fn new(judged: &'a Thresholds, findings: &'a mut Findings) -> Judgement<'a> {
        Judgement { checks: PredictionChecks::default(), findings, judged }
    }

    /// Takes a value; `true` if it passes.
    pub(super) fn take(&mut self, looked: Looked, found: Found) -> bool {
        let Looked { name, allowed, unit } = looked;
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

    pub(super) fn skip(&mut self, looked: Looked, why: &'static str) {
        let Looked { name, allowed, unit } = looked;
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

    /// Forces do not go through the feet, which stands against the motion where the verdict has a check of it.
    pub(super) fn oppose(&mut self, check: Check, looked: Looked, found: Found, message: String) {
        if !self.judged.judges(check) {
            return self.findings.report(Code::PredictionNotThroughTheFeet, message);
        }
        self.findings.report(Code::PredictionNotThroughTheFeet, message.clone());
        let limit = if found.value < looked.allowed[0] { looked.allowed[0] } else { looked.allowed[1] };
        self.checks.reasons.push(Reason {
            check,
            quantity: format!("{}_needed", looked.name.trim_end_matches("_needed")),
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
