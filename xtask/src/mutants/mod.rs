//! Mutation tests of the science: `cargo xtask mutants [MODULE..] [--sample N] [--seed S]`, `[--resume]`, `[--retry]`,
//! `[--page]`.
//!
//! `cargo mutants` changes one function at a time (another operator, another return value, a lost branch) and runs the
//! tests. A mutant that no test notices survives: that line could be wrong unseen. This command runs all mutants of
//! small modules and a random sample of large ones, first with the quick tests of the subject, then the survivors with
//! the wider tests. Outcomes are recorded in `xtask/mutants/<module>.txt`, the reasons for survivors in
//! `xtask/mutants/reasons.txt`; `docs/measured/MUTANTS.md` is written from both.
//!
//! It tests the commit, in a separate copy below the target folder, so that nothing in the workspace changes while it
//! runs. A mutant takes about ten seconds.

mod campaign;
mod modules;
mod page;
mod record;

use crate::workspace;
use campaign::Draws;
use modules::{MODULES, Module};
use record::Record;
use std::fs;
use std::path::PathBuf;

/// Seed of the samples unless another is given: the year of the paper.
const SEED: u64 = 1997;

/// The command line.
#[derive(Debug, PartialEq)]
struct Request {
    modules: Vec<String>,
    sample: Option<usize>,
    seed: u64,
    resume: bool,
    retry: bool,
    page: bool,
}

/// Runs the command.
#[expect(clippy::print_stdout, reason = "counts are the command's result")]
pub(crate) fn run(words: &[String]) -> Result<(), String> {
    let request = Request::parse(words)?;
    if !request.page {
        let place = campaign::Place::unpack()?;
        for module in MODULES.iter().filter(|module| request.names(module)) {
            let known = || Record::read(&folder(), module.name);
            let save = |record: &Record| record.write(&folder(), module.name);
            let record = if request.retry {
                campaign::retry(&place, module, known()?)?
            } else {
                let draws = Draws { sample: request.sample.or(module.sample), seed: request.seed };
                let known = if request.resume { Some(known()?) } else { None };
                campaign::sample(&place, module, &draws, known, save)?
            };
            println!("{}: {}", module.name, record.counts(&record::reasons(&folder())?).sentence());
            save(&record)?;
        }
    }
    write_page()
}

/// Writes the page from the recorded outcomes and the reasons.
#[expect(clippy::print_stdout, reason = "the file that was written is the command's result")]
pub(crate) fn write_page() -> Result<(), String> {
    let path = workspace::root().join("docs/measured/MUTANTS.md");
    fs::write(&path, rendered_page()?).map_err(|e| format!("{}: cannot write: {e}", path.display()))?;
    crate::measured::stamp("mutants")?;
    println!("written: {}", path.display());
    Ok(())
}

/// The page without its first line.
pub(crate) fn rendered_page() -> Result<String, String> {
    page::render(&folder())
}

/// Folder of recorded outcomes and reasons.
fn folder() -> PathBuf {
    workspace::root().join("xtask/mutants")
}

impl Request {
    fn parse(words: &[String]) -> Result<Request, String> {
        let mut request =
            Request { modules: Vec::new(), sample: None, seed: SEED, resume: false, retry: false, page: false };
        let mut words = words.iter();
        while let Some(word) = words.next() {
            let mut number = || {
                let value = words.next().and_then(|value| value.parse::<u64>().ok());
                value.ok_or_else(|| format!("`{word}` needs a whole number"))
            };
            match word.as_str() {
                "--sample" => request.sample = Some(number()? as usize),
                "--seed" => request.seed = number()?,
                "--resume" => request.resume = true,
                "--retry" => request.retry = true,
                "--page" => request.page = true,
                name if MODULES.iter().any(|module| module.name == name) => request.modules.push(name.to_owned()),
                other => {
                    let names: Vec<&str> = MODULES.iter().map(|module| module.name).collect();
                    return Err(format!(
                        "`{other}` is unknown, expected a module ({}), --sample N, --seed S, --resume, --retry or \
                         --page",
                        names.join(", ")
                    ));
                }
            }
        }
        Ok(request)
    }

    /// Whether a module is to be run: all are, unless some were named.
    fn names(&self, module: &Module) -> bool {
        self.modules.is_empty() || self.modules.iter().any(|name| name == module.name)
    }
}

#[cfg(test)]
mod tests {
    use super::record::Outcome;
    use super::*;

    #[test]
    fn modules_sample_and_seed_are_read_and_anything_else_is_refused() {
        let parse = |line: &str| Request::parse(&line.split_whitespace().map(str::to_owned).collect::<Vec<_>>());
        let contact = Request {
            modules: vec!["contact".to_owned()],
            sample: Some(7),
            seed: 3,
            resume: false,
            retry: false,
            page: false,
        };
        assert_eq!(parse("contact --sample 7 --seed 3"), Ok(contact));
        assert!(parse("").is_ok_and(|all| MODULES.iter().all(|module| all.names(module))));
        for wrong in ["knee", "--sample", "--sample many", "contact --seeds 3"] {
            assert!(parse(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn every_record_belongs_to_a_module_and_every_survivor_has_a_reason() {
        let reasons = record::reasons(&folder()).unwrap();
        let mut survivors = Vec::new();
        for module in &MODULES {
            let Ok(record) = Record::read(&folder(), module.name) else { continue };
            survivors.extend([Outcome::Missed, Outcome::Mended].into_iter().flat_map(|outcome| record.with(outcome)));
        }
        let unexplained: Vec<&String> = survivors.iter().filter(|name| !reasons.contains_key(*name)).collect();
        assert!(unexplained.is_empty(), "survivors without a reason in xtask/mutants/reasons.txt: {unexplained:#?}");
        let unused: Vec<&String> = reasons.keys().filter(|name| !survivors.contains(name)).collect();
        assert!(unused.is_empty(), "reasons of mutants that did not survive: {unused:#?}");
    }
}
