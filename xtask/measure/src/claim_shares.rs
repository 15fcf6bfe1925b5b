//! How often the claims of the 1997 paper hold: `cargo xtask claim-shares [--settings N] [--seed S] [--write]`.
//!
//! Draws all values that the paper does not give jointly, judges the claims with each choice, and searches near the best one for a choice
//! that meets more claims. Runs on one core for some minutes; start it with `nice`. With `--write` the results go to
//! `crates/ambulo/data/reproduction/shares.csv`, from where `ambulo reproduce` prints them.

use crate::workspace;
use ambulo::reproduction::{Judgement, OpenValues, StoredShares, judged_of_the_paper, shares_csv};
use std::fs;

/// Settings that are drawn, if no other number is asked for.
const SETTINGS: u64 = 500;
/// Settings near the best one that are tried afterwards, for each five that are drawn.
const NEAR: u64 = 1;
/// The year of the paper.
const SEED: u64 = 1997;
/// The stored results, relative to the workspace root.
const FILE: &str = "crates/ambulo/data/reproduction/shares.csv";

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
    for number in 0..settings {
        tally.add(OpenValues::drawn(seed, number));
        if number % 50 == 49 {
            eprintln!("{} of {settings}", number + 1);
        }
    }
    let drawn = tally.clone();
    for number in 0..NEAR * settings / 5 {
        let Some((_, best)) = &tally.best else { break };
        tally.add(best.near(seed, settings + number));
    }
    let text = shares_csv(&drawn.shares(seed, &tally)?);
    println!("{text}{} of {settings} settings could not be simulated", drawn.failed);
    if write {
        fs::write(workspace::root().join(FILE), text).map_err(|e| format!("{FILE}: cannot write: {e}"))?;
    }
    Ok(())
}

/// What was found so far.
#[derive(Debug, Clone, Default)]
struct Tally {
    judged: Vec<Vec<Judgement>>,
    failed: usize,
    /// The judgements and values that meet most claims; the earliest of equals.
    best: Option<(Vec<Judgement>, OpenValues)>,
}

impl Tally {
    fn add(&mut self, values: OpenValues) {
        let Ok(judgements) = values.judged() else {
            self.failed += 1;
            return;
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
            settings: self.judged.len(),
            held: first.iter().enumerate().map(|(claim, judged)| (judged.id.to_owned(), share(claim))).collect(),
            best_held: judged_of_the_paper(&judgements),
            best,
        })
    }
}
