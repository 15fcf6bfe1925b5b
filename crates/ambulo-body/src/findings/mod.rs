//! Warnings and notes that computations collect for the user.
//!
//! A function that can continue despite a problem reports it to the [`Findings`] that its caller passes in. Every
//! kind of finding has a [`Code`] with a severity, a meaning and a remedy. Findings inform the user; no computation
//! depends on them.

mod code;
mod word;

pub use code::Code;
pub use word::word;

use serde::{Deserialize, Serialize};
use std::fmt;

/// How much a finding matters.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum Severity {
    /// For information; results are valid.
    Note,
    /// Results may be wrong and should be checked.
    Warning,
}

impl fmt::Display for Severity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(word(self))
    }
}

/// One warning or note, with the number of times that it occurred.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(into = "Record", from = "Record")]
pub struct Finding {
    /// Code of the finding.
    pub code: Code,
    /// Found value, place, and consequence.
    pub message: String,
    /// Number of times that it occurred.
    pub count: usize,
}

impl Finding {
    /// Severity; every code has one.
    #[must_use]
    pub fn severity(&self) -> Severity {
        self.code.severity()
    }
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.severity(), self.message)
    }
}

/// A finding as written in files: with its severity, for programs that do not know the codes.
#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
struct Record {
    code: Code,
    severity: Severity,
    message: String,
    count: usize,
}

impl From<Finding> for Record {
    fn from(finding: Finding) -> Record {
        let severity = finding.severity();
        Record { code: finding.code, severity, message: finding.message, count: finding.count }
    }
}

impl From<Record> for Finding {
    fn from(record: Record) -> Finding {
        Finding { code: record.code, message: record.message, count: record.count }
    }
}

/// Warnings and notes, in the order in which they first occurred. Lost data is an error instead.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(transparent)]
pub struct Findings {
    list: Vec<Finding>,
}

impl Findings {
    /// Reports a finding once.
    pub fn report(&mut self, code: Code, message: impl Into<String>) {
        self.add(Finding { code, message: message.into(), count: 1 });
    }

    /// Adds a finding; a finding that is in the list already has its count raised.
    pub fn add(&mut self, finding: Finding) {
        match self.list.iter_mut().find(|f| f.code == finding.code && f.message == finding.message) {
            Some(known) => known.count += finding.count,
            None => self.list.push(finding),
        }
    }

    /// Removes the findings with this code for which `is_wrong` is true, because a later finding has the true reason.
    pub fn withdraw(&mut self, code: Code, is_wrong: impl Fn(&str) -> bool) {
        self.list.retain(|finding| finding.code != code || !is_wrong(&finding.message));
    }

    /// The findings, in the order in which they first occurred.
    #[must_use]
    pub fn as_slice(&self) -> &[Finding] {
        &self.list
    }

    /// Whether a finding with this code was reported. For tests and for display: no computation may depend on it.
    #[must_use]
    pub fn has(&self, code: Code) -> bool {
        self.list.iter().any(|f| f.code == code)
    }
}

/// The end of a message that names the first of several occurrences.
#[doc(hidden)]
pub fn and_more_times(occurrences: usize) -> String {
    match occurrences {
        0 | 1 => String::new(),
        2 => " and once more".to_owned(),
        _ => format!(" and {} more times", occurrences - 1),
    }
}
