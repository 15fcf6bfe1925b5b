//! Outcomes of mutants, one file per module, and the reasons for survivors.
//!
//! A file begins with `commit`, `seed`, `mutants` (how many the module has) and perhaps `note` (why it is no random
//! sample); then one line per mutant that was run: outcome, blank, name as `cargo mutants --list` shows it. A line of
//! `reasons.txt` is a name, ` => ` and the reason.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::fs;
use std::path::Path;

/// The outcome of a mutant.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Outcome {
    /// A test failed.
    Caught,
    /// A test did not end: noticed as well.
    Timeout,
    /// No test noticed.
    Missed,
    /// No test noticed; one that was written since does.
    Mended,
    /// It does not compile.
    Unviable,
}

const WORDS: [(Outcome, &str); 5] = [
    (Outcome::Caught, "caught"),
    (Outcome::Timeout, "timeout"),
    (Outcome::Missed, "missed"),
    (Outcome::Mended, "mended"),
    (Outcome::Unviable, "unviable"),
];

/// Beginning of the reason for a survivor that no test can notice: results change nowhere, or only where two computed
/// numbers are exactly equal.
const EQUIVALENT: &str = "equivalent";

/// The outcomes of one module.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(super) struct Record {
    /// Commits whose tests were run, in their order.
    pub(super) commit: String,
    /// Seed of the sample.
    pub(super) seed: u64,
    /// Mutants of the module, run or not.
    pub(super) mutants: usize,
    /// Why the mutants that were run are no random sample; empty if they are one, or all.
    pub(super) note: String,
    /// Outcome of each mutant that was run, by name.
    pub(super) outcomes: BTreeMap<String, Outcome>,
}

/// How often each outcome occurred.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(super) struct Counts {
    pub(super) caught: usize,
    pub(super) timeout: usize,
    pub(super) missed: usize,
    pub(super) mended: usize,
    /// Missed, and no test could notice.
    pub(super) equivalent: usize,
    pub(super) unviable: usize,
}

impl Counts {
    /// Mutants that were run.
    pub(super) fn run(&self) -> usize {
        self.viable() + self.equivalent + self.unviable
    }

    /// Mutants that compile and that a test could notice.
    pub(super) fn viable(&self) -> usize {
        self.caught + self.timeout + self.missed + self.mended
    }

    /// Mutants that the tests noticed when they were drawn.
    pub(super) fn noticed_at_first(&self) -> usize {
        self.caught + self.timeout
    }

    pub(super) fn sentence(&self) -> String {
        let Counts { caught, timeout, missed, mended, equivalent, unviable } = self;
        format!(
            "{caught} caught, {timeout} timeouts, {missed} missed, {mended} mended, {equivalent} equivalent, \
             {unviable} unviable"
        )
    }
}

impl std::ops::Add for Counts {
    type Output = Counts;

    fn add(self, other: Counts) -> Counts {
        Counts {
            caught: self.caught + other.caught,
            timeout: self.timeout + other.timeout,
            missed: self.missed + other.missed,
            mended: self.mended + other.mended,
            equivalent: self.equivalent + other.equivalent,
            unviable: self.unviable + other.unviable,
        }
    }
}

impl Record {
    pub(super) fn read(folder: &Path, module: &str) -> Result<Record, String> {
        let path = folder.join(module).with_extension("txt");
        let text = fs::read_to_string(&path).map_err(|e| format!("{}: cannot read: {e}", path.display()))?;
        Record::parse(&text).map_err(|message| format!("{}: {message}", path.display()))
    }

    pub(super) fn write(&self, folder: &Path, module: &str) -> Result<(), String> {
        let path = folder.join(module).with_extension("txt");
        fs::write(&path, self.text()).map_err(|e| format!("{}: cannot write: {e}", path.display()))
    }

    /// Notes the commit whose tests are run from here on.
    pub(super) fn measured_at(&mut self, commit: &str) {
        if !self.commit.ends_with(commit) {
            self.commit += if self.commit.is_empty() { "" } else { ", " };
            self.commit += commit;
        }
    }

    fn parse(text: &str) -> Result<Record, String> {
        let mut record = Record::default();
        for (index, line) in text.lines().enumerate() {
            let wrong = || format!("line {}: found `{line}`, expected an outcome and a mutant", index + 1);
            let (word, rest) = line.split_once(' ').ok_or_else(wrong)?;
            match word {
                "commit" => record.commit = rest.to_owned(),
                "note" => record.note = rest.to_owned(),
                "seed" => record.seed = rest.parse().map_err(|_| wrong())?,
                "mutants" => record.mutants = rest.parse().map_err(|_| wrong())?,
                _ => {
                    let known = WORDS.iter().find(|(_, known)| *known == word).ok_or_else(wrong)?;
                    record.outcomes.insert(rest.to_owned(), known.0);
                }
            }
        }
        Ok(record)
    }

    fn text(&self) -> String {
        let mut text = format!("commit {}\nseed {}\nmutants {}\n", self.commit, self.seed, self.mutants);
        if !self.note.is_empty() {
            let _ = writeln!(text, "note {}", self.note);
        }
        for (name, outcome) in &self.outcomes {
            let word = WORDS.iter().find(|(known, _)| known == outcome).map_or("", |(_, word)| word);
            let _ = writeln!(text, "{word} {name}");
        }
        text
    }

    /// Survivors whose reason begins with `equivalent` are counted separately.
    pub(super) fn counts(&self, reasons: &BTreeMap<String, String>) -> Counts {
        let is_equivalent = |name: &String| reasons.get(name).is_some_and(|reason| reason.starts_with(EQUIVALENT));
        let equivalent = self.with(Outcome::Missed).iter().filter(|name| is_equivalent(name)).count();
        let of = |outcome: Outcome| self.outcomes.values().filter(|known| **known == outcome).count();
        Counts {
            caught: of(Outcome::Caught),
            timeout: of(Outcome::Timeout),
            missed: of(Outcome::Missed) - equivalent,
            mended: of(Outcome::Mended),
            equivalent,
            unviable: of(Outcome::Unviable),
        }
    }

    /// Names of the mutants with one outcome.
    pub(super) fn with(&self, wanted: Outcome) -> Vec<String> {
        self.outcomes.iter().filter(|(_, outcome)| **outcome == wanted).map(|(name, _)| name.clone()).collect()
    }
}

/// The reasons for survivors, by the name of the mutant.
pub(super) fn reasons(folder: &Path) -> Result<BTreeMap<String, String>, String> {
    let path = folder.join("reasons.txt");
    let text = fs::read_to_string(&path).map_err(|e| format!("{}: cannot read: {e}", path.display()))?;
    let lines = text.lines().filter(|line| !line.trim().is_empty() && !line.starts_with('#'));
    let pair = |line: &str| {
        let parts = line.split_once(" => ").map(|(name, reason)| (name.to_owned(), reason.to_owned()));
        parts.ok_or_else(|| format!("{}: found `{line}`, expected a mutant, ` => ` and a reason", path.display()))
    };
    lines.map(pair).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_record_that_was_written_reads_back() {
        let outcomes =
            [("a.rs:1:2: replace + with -", Outcome::Caught), ("a.rs:9:1: replace f with ()", Outcome::Mended)];
        let outcomes = outcomes.into_iter().map(|(name, outcome)| (name.to_owned(), outcome)).collect();
        let record = Record { commit: "abc".to_owned(), seed: 3, mutants: 12, note: "in order".to_owned(), outcomes };
        assert_eq!(Record::parse(&record.text()), Ok(record.clone()));
        assert_eq!(record.with(Outcome::Mended), ["a.rs:9:1: replace f with ()"]);
        let counts = record.counts(&BTreeMap::new());
        assert_eq!((counts.run(), counts.noticed_at_first()), (2, 1));
        assert!(Record::parse("escaped a.rs:1:2: replace + with -").is_err());
    }

    #[test]
    fn equivalent_survivors_are_no_viable_mutants() {
        let record =
            Record::parse("commit a\nseed 1\nmutants 9\ncaught a.rs:1:1: x\nmissed a.rs:2:1: y\nmissed a.rs:3:1: z")
                .unwrap();
        let reason = |name: &str, reason: &str| (name.to_owned(), reason.to_owned());
        let reasons = BTreeMap::from([
            reason("a.rs:1:1: x", "equivalent: but it was caught"),
            reason("a.rs:2:1: y", "equivalent: a tie"),
            reason("a.rs:3:1: z", "open"),
        ]);
        let counts = record.counts(&reasons);
        assert_eq!((counts.run(), counts.viable(), counts.equivalent, counts.missed), (3, 2, 1, 1));
    }
}
