//! Values of set-ups in place of fields that were left open.

use super::error::Field;
use super::values::{Cutoff, EarthTurn, HeadingAxis, ModelChoice};
use crate::findings::{Code, Findings};
use std::path::PathBuf;

/// The value of a field, or what a set-up states in its place.
pub(super) fn fill<T: Clone + PartialEq + Shown>(
    option: &mut Option<T>,
    stated: Option<T>,
    field: Field,
    findings: &mut Findings,
) {
    replaced(option.clone(), stated.clone(), field, findings);
    if option.is_none() {
        *option = stated;
    }
}

/// Reports a value that replaces another one of a set-up.
pub(super) fn replaced<T: PartialEq + Shown>(
    given: Option<T>,
    stated: Option<T>,
    field: Field,
    findings: &mut Findings,
) {
    if let (Some(given), Some(stated)) = (given, stated)
        && given != stated
    {
        let message = format!("{} {} replaces {} of the set-up", field.name(), given.shown(), stated.shown());
        findings.report(Code::SetupReplaced, message);
    }
}

/// A value in a message.
pub(super) trait Shown {
    fn shown(&self) -> String;
}

impl Shown for PathBuf {
    fn shown(&self) -> String {
        self.display().to_string()
    }
}

impl Shown for f64 {
    fn shown(&self) -> String {
        self.to_string()
    }
}

impl Shown for Cutoff {
    fn shown(&self) -> String {
        self.to_string()
    }
}

impl Shown for HeadingAxis {
    fn shown(&self) -> String {
        self.to_string()
    }
}

impl Shown for EarthTurn {
    fn shown(&self) -> String {
        self.to_string()
    }
}

impl Shown for ModelChoice {
    fn shown(&self) -> String {
        self.path().display().to_string()
    }
}
