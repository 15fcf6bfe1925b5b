//! Runs mutants with `cargo mutants` in a copy of the commit.

use super::modules::{LONG, Module, SLOW};
use super::record::{Outcome, Record};
use crate::workspace;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::PathBuf;
use std::process::{Command, Stdio};

/// Tests of one mutant that take longer [s] have hung: the quick ones take less than ten seconds, the wide ones less
/// than a minute.
const QUICK_LIMIT_S: u32 = 30;
const WIDE_LIMIT_S: u32 = 300;
/// Mutants between two savings of the record.
const BATCH: usize = 10;
/// Exit codes of `cargo mutants` when it has run: nothing missed, some missed, some timed out.
const RAN: [i32; 3] = [0, 2, 3];
/// Its files of outcomes.
const FILES: [(&str, Outcome); 4] = [
    ("caught.txt", Outcome::Caught),
    ("timeout.txt", Outcome::Timeout),
    ("missed.txt", Outcome::Missed),
    ("unviable.txt", Outcome::Unviable),
];

/// How mutants are drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Draws {
    /// How many; none: all.
    pub(super) sample: Option<usize>,
    pub(super) seed: u64,
}

type Outcomes = BTreeMap<String, Outcome>;

/// Tests that a mutant is run with.
struct Tests {
    /// Parts of their names.
    named: Vec<&'static str>,
    /// Parts of the names of tests that are left out.
    skipped: Vec<&'static str>,
    limit_s: u32,
    /// Whether they are known to pass without a mutation.
    passed: bool,
}

impl Tests {
    fn quick(module: &Module) -> Tests {
        let skipped = SLOW.iter().chain(&LONG).copied().collect();
        Tests { named: module.quick.to_vec(), skipped, limit_s: QUICK_LIMIT_S, passed: false }
    }

    /// The quick tests are among the wide ones.
    fn wide(module: &Module) -> Tests {
        let named = module.quick.iter().chain(module.wide).copied().collect();
        Tests { named, skipped: SLOW.to_vec(), limit_s: WIDE_LIMIT_S, passed: false }
    }
}

/// Where mutants are built: a copy of the commit, kept between runs so that only what changes is compiled.
pub(super) struct Place {
    commit: String,
    tree: PathBuf,
    output: PathBuf,
}

impl Place {
    /// Unpacks the commit.
    pub(super) fn unpack() -> Result<Place, String> {
        let folder = workspace::target().join("mutation-tests");
        let tree = folder.join("tree");
        if tree.exists() {
            fs::remove_dir_all(&tree).map_err(|e| format!("{}: cannot remove: {e}", tree.display()))?;
        }
        fs::create_dir_all(&tree).map_err(|e| format!("{}: cannot create: {e}", tree.display()))?;
        workspace::unpack("HEAD", &tree)?;
        let commit =
            Command::new("git").current_dir(workspace::root()).args(["rev-parse", "--short=12", "HEAD"]).output();
        let commit = commit.map_err(|e| format!("git: cannot start: {e}"))?;
        let commit = String::from_utf8_lossy(&commit.stdout).trim().to_owned();
        Ok(Place { commit, tree, output: folder })
    }

    /// `cargo mutants` for one module.
    fn mutants(&self, module: &Module) -> Command {
        let mut command = workspace::cargo();
        command.current_dir(&self.tree);
        command.env("CARGO_TARGET_DIR", workspace::target()).env("AMBULO_DATA", absolute(workspace::data()));
        command.args(["mutants", "--package", module.package(), "--colors", "never", "--file", module.files]);
        command
    }

    /// Names of all mutants of a module.
    fn list(&self, module: &Module) -> Result<Vec<String>, String> {
        let output = self.mutants(module).arg("--list").stderr(Stdio::inherit()).output();
        let output = output.map_err(|e| format!("cargo mutants: cannot start: {e}"))?;
        if !output.status.success() {
            return Err(
                "cargo mutants: see above\nhint: install it with `cargo install cargo-mutants --locked`".to_owned()
            );
        }
        Ok(String::from_utf8_lossy(&output.stdout).lines().map(str::to_owned).collect())
    }

    /// Writes a difference that adds the lines of these mutants, as if all others had been there before.
    /// `cargo mutants` 27.1.0 runs mutants that delete a field of a struct whatever pattern of names it is given, but
    /// leaves out those of unchanged lines.
    fn write_lines(&self, names: &[String]) -> Result<PathBuf, String> {
        let mut lines = BTreeMap::<&str, BTreeSet<usize>>::new();
        for name in names {
            let (file, line) = line_of(name).ok_or_else(|| format!("`{name}` has no file and line"))?;
            lines.entry(file).or_default().insert(line);
        }
        let mut text = String::new();
        for (file, lines) in lines {
            let path = self.tree.join(file);
            let source = fs::read_to_string(&path).map_err(|e| format!("{}: cannot read: {e}", path.display()))?;
            text += &added(file, &source, &lines);
        }
        let path = self.output.join("lines.diff");
        fs::write(&path, text).map_err(|e| format!("{}: cannot write: {e}", path.display()))?;
        Ok(path)
    }

    /// Runs mutants with some tests.
    fn run(&self, module: &Module, names: &[String], tests: &mut Tests) -> Result<Outcomes, String> {
        let mut command = self.mutants(module);
        command.args(["--in-place", "--annotations", "none"]);
        command.args(module.programs().map(|program| format!("--cargo-arg=--test={program}")));
        // Most tests are those of `ambulo`, whatever crate the module is in.
        command.args(["--test-package", "ambulo", "--test-package", module.package()]);
        command.args(["--baseline", if tests.passed { "skip" } else { "run" }]);
        command.arg("--timeout").arg(tests.limit_s.to_string()).arg("--output").arg(&self.output);
        command.args(names.iter().flat_map(|name| ["--re".to_owned(), format!("^{}$", escaped(name))]));
        command.arg("--in-diff").arg(self.write_lines(names)?);
        command.args(["--", "--"]).args(&tests.named).args(tests.skipped.iter().flat_map(|name| ["--skip", name]));
        let status = command.status().map_err(|e| format!("cargo mutants: cannot start: {e}"))?;
        tests.passed = true;
        if !status.code().is_some_and(|code| RAN.contains(&code)) {
            return Err(format!("cargo mutants failed ({status}), see above"));
        }
        let folder = self.output.join("mutants.out");
        let mut outcomes = Outcomes::new();
        for (file, outcome) in FILES {
            let path = folder.join(file);
            let text = fs::read_to_string(&path).map_err(|e| format!("{}: cannot read: {e}", path.display()))?;
            let wanted = text.lines().filter(|line| names.iter().any(|name| name == line));
            outcomes.extend(wanted.map(|line| (line.to_owned(), outcome)));
        }
        match names.iter().find(|name| !outcomes.contains_key(*name)) {
            Some(name) => Err(format!("`{name}` was not run")),
            None => Ok(outcomes),
        }
    }
}

/// Draws mutants of a module and runs those that `known` does not have yet. After every few mutants `save` gets the
/// record, so that a run that is interrupted is a smaller sample.
pub(super) fn sample(
    place: &Place,
    module: &Module,
    draws: &Draws,
    known: Option<Record>,
    save: impl Fn(&Record) -> Result<(), String>,
) -> Result<Record, String> {
    let all = place.list(module)?;
    let mut record = known.unwrap_or_default();
    if let Some(lost) = record.outcomes.keys().find(|name| !all.contains(name)) {
        return Err(format!("{}: `{lost}` no longer exists\nhint: run the module again without --resume", module.name));
    }
    record.mutants = all.len();
    record.seed = draws.seed;
    record.measured_at(&place.commit);
    let mut drawn = draw(all, draws.sample.unwrap_or(record.mutants), draws.seed);
    drawn.retain(|name| !record.outcomes.contains_key(name));
    let (mut quick, mut wide) = (Tests::quick(module), Tests::wide(module));
    for batch in drawn.chunks(BATCH) {
        let mut outcomes = place.run(module, batch, &mut quick)?;
        let missed = with(&outcomes, Outcome::Missed);
        if !missed.is_empty() {
            outcomes.extend(place.run(module, &missed, &mut wide)?);
        }
        record.outcomes.extend(outcomes);
        save(&record)?;
    }
    Ok(record)
}

/// Runs the survivors of a record again, with the tests of today.
pub(super) fn retry(place: &Place, module: &Module, mut record: Record) -> Result<Record, String> {
    let missed = record.with(Outcome::Missed);
    let known: BTreeSet<String> = place.list(module)?.into_iter().collect();
    if let Some(lost) = missed.iter().find(|name| !known.contains(*name)) {
        return Err(format!("{}: `{lost}` no longer exists\nhint: run the module again without --retry", module.name));
    }
    if missed.is_empty() {
        return Ok(record);
    }
    record.measured_at(&place.commit);
    let mut outcomes = place.run(module, &missed, &mut Tests::quick(module))?;
    let missed = with(&outcomes, Outcome::Missed);
    if !missed.is_empty() {
        outcomes.extend(place.run(module, &missed, &mut Tests::wide(module))?);
    }
    for (name, outcome) in outcomes {
        let outcome = if outcome == Outcome::Missed { Outcome::Missed } else { Outcome::Mended };
        record.outcomes.insert(name, outcome);
    }
    Ok(record)
}

/// Names of the mutants with one outcome.
fn with(outcomes: &Outcomes, wanted: Outcome) -> Vec<String> {
    outcomes.iter().filter(|(_, outcome)| **outcome == wanted).map(|(name, _)| name.clone()).collect()
}

/// A random sample: the first `count` of a shuffle (Fisher, Yates) with the generator SplitMix64 (Steele, Lea, Flood
/// 2014; unverified).
fn draw(mut names: Vec<String>, count: usize, seed: u64) -> Vec<String> {
    let mut state = seed;
    let mut random = || {
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    };
    let count = count.min(names.len());
    for i in 0..count {
        let left = (names.len() - i) as u64;
        names.swap(i, i + (random() % left) as usize);
    }
    names.truncate(count);
    names
}

/// File and line of a mutant, from its name.
fn line_of(name: &str) -> Option<(&str, usize)> {
    let (file, place) = name.split_once(':')?;
    let (line, _) = place.split_once(':')?;
    Some((file, line.parse().ok()?))
}

/// A unified difference without context that adds some lines of a file.
fn added(file: &str, source: &str, lines: &BTreeSet<usize>) -> String {
    let mut text = format!("--- a/{file}\n+++ b/{file}\n");
    for (earlier, &line) in lines.iter().enumerate() {
        // Without the lines that are added before it, this one follows line `line - 1 - earlier`.
        let content = source.lines().nth(line - 1).unwrap_or_default();
        text += &format!("@@ -{},0 +{line} @@\n+{content}\n", line - 1 - earlier);
    }
    text
}

/// A name as a regular expression that matches it alone.
fn escaped(name: &str) -> String {
    let mut pattern = String::new();
    for c in name.chars() {
        // A backslash before any other sign may have its own meaning: `\<` is the beginning of a word.
        if r"\.+*?()|[]{}^$".contains(c) {
            pattern.push('\\');
        }
        pattern.push(c);
    }
    pattern
}

fn absolute(path: PathBuf) -> PathBuf {
    fs::canonicalize(&path).unwrap_or(path)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(count: usize) -> Vec<String> {
        (0..count).map(|i| i.to_string()).collect()
    }

    #[test]
    fn a_sample_has_no_mutant_twice_and_is_the_same_for_the_same_seed() {
        let sample = draw(names(300), 40, 7);
        assert_eq!(sample.iter().collect::<BTreeSet<_>>().len(), 40);
        assert_eq!(sample, draw(names(300), 40, 7));
        assert_ne!(sample, draw(names(300), 40, 8));
        assert_eq!(draw(names(300), 30, 7), sample[..30]);
        assert_eq!(draw(names(5), 40, 7).len(), 5);
    }

    #[test]
    fn every_mutant_is_drawn_equally_often() {
        const SEEDS: u64 = 3000;
        let first: Vec<String> = (0..SEEDS).map(|seed| draw(names(10), 1, seed).remove(0)).collect();
        for name in names(10) {
            let share = first.iter().filter(|drawn| **drawn == name).count() as f64 / SEEDS as f64;
            // Six standard deviations of a binomial share: 6 sqrt(0.1 0.9 / 3000) = 0.033.
            assert!((share - 0.1).abs() < 0.033, "{name}: {share}");
        }
    }

    #[test]
    fn a_difference_adds_the_lines_of_mutants() {
        assert_eq!(line_of("a/b.rs:12:7: replace + with - in f"), Some(("a/b.rs", 12)));
        assert_eq!(line_of("no place"), None);
        let text = added("b.rs", "one\ntwo\nthree\nfour\n", &BTreeSet::from([2, 4]));
        assert_eq!(text, "--- a/b.rs\n+++ b/b.rs\n@@ -1,0 +2 @@\n+two\n@@ -2,0 +4 @@\n+four\n");
    }

    #[test]
    fn signs_of_a_name_have_no_meaning_in_its_pattern() {
        assert_eq!(escaped("a.rs:1: replace * with <"), "a\\.rs:1: replace \\* with <");
    }
}
