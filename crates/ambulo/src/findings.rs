//! What was odd on the way, collected for every shell to show.

use serde::Serialize;
use std::fmt;

/// How much a finding matters.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Severity {
    /// Worth knowing; the result stands.
    Note,
    /// The result may be wrong; a person should look.
    Warning,
}

/// One kind of oddity, with the number of times it was met.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Finding {
    /// Stable word for programs, such as `model.ignored`.
    pub code: &'static str,
    /// How much it matters.
    pub severity: Severity,
    /// What was found, where, and what was made of it.
    pub message: String,
    /// How many times.
    pub count: usize,
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let severity = match self.severity {
            Severity::Note => "note",
            Severity::Warning => "warning",
        };
        write!(f, "{severity}: {}", self.message)
    }
}

/// A list of findings, in the order in which they were met.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Findings {
    list: Vec<Finding>,
}

impl Findings {
    /// Adds a note.
    pub fn note(&mut self, code: &'static str, message: impl Into<String>) {
        self.add(Finding { code, severity: Severity::Note, message: message.into(), count: 1 });
    }

    /// Adds a warning.
    pub fn warn(&mut self, code: &'static str, message: impl Into<String>) {
        self.add(Finding { code, severity: Severity::Warning, message: message.into(), count: 1 });
    }

    /// Adds a finding; the same finding met again raises its count.
    pub fn add(&mut self, finding: Finding) {
        match self.list.iter_mut().find(|f| f.code == finding.code && f.message == finding.message) {
            Some(known) => known.count += finding.count,
            None => self.list.push(finding),
        }
    }

    /// The findings, in the order in which they were met.
    #[must_use]
    pub fn as_slice(&self) -> &[Finding] {
        &self.list
    }

    /// Whether a finding with this code was met.
    #[must_use]
    pub fn has(&self, code: &str) -> bool {
        self.list.iter().any(|f| f.code == code)
    }
}
