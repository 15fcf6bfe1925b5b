//! How often the claims of the 1997 paper hold: `cargo xtask claim-shares [--settings N] [--seed S] [--write]`.
//!
//! Draws all values that the paper does not give jointly until N choices could be simulated, judges the claims with
//! each of them, and searches near the best one for a choice that meets more claims. Choices whose gaits are not
//! possible are counted by their reasons. Runs on one core for some minutes; start it with `nice`. With `--write` the
//! results go to `crates/ambulo-paper/data/shares.csv`, from where `ambulo reproduce` prints them.

use crate::workspace;
use ambulo_paper::{Judgement, OpenValues, StoredShares, judged_of_the_paper, shares_csv};
use std::collections::BTreeMap;
use std::fs;

/// Settings that are simulated, if no other number is asked for.
const SETTINGS: u64 = 500;
/// For each setting that is simulated, at most so many are drawn.
const MOST_DRAWN: u64 = 10;
/// Settings near the best one that are tried afterwards, for each five that were simulated.
const NEAR: u64 = 1;
/// The year of the paper.
const SEED: u64 = 1997;
/// The stored results, relative to the workspace root.
const FILE: &str = "crates/ambulo-paper/data/shares.csv";

/// Runs the command.
#[expect(clippy::print_stdout, clippy::print_stderr, reason = "the results and the progress of the command")]
pub(crate) fn run(words: &[String]) -> Result<(), String> {
    let (mut settings, mut seed, mut write) = (SETTINGS, SEED, false);
    let mut rest = words.iter();
    while let Some(word) = rest.next() {
        let mut number =
            || rest.next().and_then(|n| n.parse().ok()).ok_or(format!("`{word}`: expected a whole number"));
        match word.as_str() {
            "--settings" => settings = number()?,
            "--seed" => seed = number()?,
            "--write" => write = true,
            _ => return Err(format!("unknown option `{word}`, expected --settings, --seed or --write")),
        }
    }
    let mut tally = Tally::default();
    let mut drawn = 0;
    while (tally.judged.len() as u64) < settings && drawn < MOST_DRAWN * settings {
        tally.add(OpenValues::drawn(seed, drawn));
        drawn += 1;
        if drawn % 50 == 0 {
            eprintln!("{drawn} drawn, {} of {settings} simulated", tally.judged.len());
        }
    }
    let sampled = tally.clone();
    for number in 0..NEAR * settings / 5 {
        let Some((_, best)) = &tally.best else { break };
        tally.add(best.near(seed, drawn + number));
    }
    let text = shares_csv(&sampled.shares(seed, &tally)?);
    println!("{text}settings that could not be simulated:");
    for (reason, count) in &sampled.failed {
        println!("  {count}: {reason}");
    }
    if write {
        fs::write(workspace::root().join(FILE), text).map_err(|e| format!("{FILE}: cannot write: {e}"))?;
    }
    Ok(())
}

/// What was found so far.
#[derive(Debug, Clone, Default)]
struct Tally {
    judged: Vec<Vec<Judgement>>,
    /// Number of settings that could not be simulated, by reason; numbers in the reasons are left out.
    failed: BTreeMap<String, usize>,
    /// The judgements and values that meet most claims; the earliest of equals.
    best: Option<(Vec<Judgement>, OpenValues)>,
}

impl Tally {
    fn add(&mut self, values: OpenValues) {
        let judgements = match values.judged() {
            Ok(judgements) => judgements,
            Err(error) => {
                let reason = error.to_string().replace(|c: char| c.is_ascii_digit(), "");
                *self.failed.entry(reason).or_default() += 1;
                return;
            }
        };
        let met = |judgements: &[Judgement]| judged_of_the_paper(judgements)[0];
        if self.best.as_ref().is_none_or(|(best, _)| met(&judgements) > met(best)) {
            self.best = Some((judgements.clone(), values));
        }
        self.judged.push(judgements);
    }

    /// The shares of these settings, with the best setting of a longer search.
    fn shares(&self, seed: u64, search: &Tally) -> Result<StoredShares, String> {
        let first = self.judged.first().ok_or("no setting could be simulated")?;
        let share = |claim: usize| {
            let held = self.judged.iter().filter(|judgements| judgements[claim].pass).count();
            held as f64 / self.judged.len() as f64
        };
        let (judgements, best) = search.best.clone().ok_or("no setting could be simulated")?;
        Ok(StoredShares {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            seed,
            drawn: self.judged.len() + self.failed.values().sum::<usize>(),
            settings: self.judged.len(),
            held: first.iter().enumerate().map(|(claim, judged)| (judged.id.to_owned(), share(claim))).collect(),
            best_held: judged_of_the_paper(&judgements),
            best,
        })
    }
}
