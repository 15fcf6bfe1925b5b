//! Fits the parameters of the ground-force estimator:
//! `cargo xtask fit-ground [--evaluations N] [--seed N] [--pull X] [--write]`.
//!
//! Writes `crates/ambulo/data/ground/stance_curves.toml` from the normative tables and reports whether the file has
//! changed. Fits `ambulo::ground::predict::FittedParameters` to the recordings with plates, on all subjects and
//! leave-one-out, calibrates the standard deviations, and prints the results; with `--write` they go to
//! docs/measured/GROUND_FIT.md. The parameters are printed as the `Default` to paste: this command changes no source.

mod calibration;
mod cases;
mod curves;
mod numbers;
mod page;
mod search;

use crate::workspace;
use ambulo::ground::predict::FittedParameters;
use calibration::{Bands, Judged};
use cases::{Case, Cases};
use numbers::{NUMBERS, parameters, rounded};
use std::fs;
use std::time::Instant;

/// Evaluations per fit: five minutes for all fits on one core. With 400 the cost of the fit falls by 0.5 %, that of
/// people left out rises by 1 %.
const EVALUATIONS: usize = 150;
/// Seed of the search.
const SEED: u64 = 1;
/// Penalty of parameters away from the middle of their ranges: one at an end adds a quarter of this to the cost.
/// Cost of people and of laboratories left out with 0.6, 2 and 6: 5.48 and 6.16, 5.51 and 6.01, 5.55 and 6.03.
const PULL: f64 = 2.0;
/// The page, relative to the workspace root.
const PAGE: &str = "docs/measured/GROUND_FIT.md";

/// Settings of the fit.
#[derive(Debug, Clone, Copy)]
struct Order {
    evaluations: usize,
    seed: u64,
    pull: f64,
    write: bool,
}

/// How the parameters were fitted with which a subject is predicted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Fit {
    /// On all subjects.
    Own,
    /// On all others.
    PersonLeftOut,
    /// On those of other laboratories.
    LaboratoryLeftOut,
}

impl Fit {
    const ALL: [Fit; 3] = [Fit::Own, Fit::PersonLeftOut, Fit::LaboratoryLeftOut];

    fn word(self) -> &'static str {
        match self {
            Fit::Own => "own",
            Fit::PersonLeftOut => "person left out",
            Fit::LaboratoryLeftOut => "laboratory left out",
        }
    }
}

/// Results of a subject, one entry per way to fit.
struct Fold {
    subject: &'static str,
    importance: f64,
    /// Whether the figures count in the means: straight walks with markers on the trunk.
    is_judged: bool,
    /// Fitted and calibrated.
    parameters: [FittedParameters; 3],
    costs: [f64; 3],
    figures: [[f64; 11]; 3],
    /// Predicted with the laboratory left out.
    bands: Bands,
    /// The same without the markers above the pelvis; `None` where the subject has no walk with all markers.
    without_trunk: Option<WithoutTrunk>,
}

/// Results of a subject whose markers above the pelvis were dropped, with the laboratory left out of the fit.
struct WithoutTrunk {
    figures: [f64; 11],
    bands: Bands,
}

/// The results of the fit.
struct Outcome {
    /// Fitted and calibrated on all subjects.
    parameters: FittedParameters,
    cost: f64,
    cost_of_middle: f64,
    cost_of_shipped: f64,
    /// Change of the cost, as a share, when a number is halved and doubled.
    sensitivity: Vec<[f64; 2]>,
    folds: Vec<Fold>,
}

impl Outcome {
    /// Subjects who determine the means.
    fn judged(&self) -> impl Iterator<Item = &Fold> {
        self.folds.iter().filter(|fold| fold.is_judged)
    }

    /// Mean over subjects.
    fn mean_cost(&self, fit: Fit) -> f64 {
        let all: f64 = self.folds.iter().map(|fold| fold.importance).sum();
        self.folds.iter().map(|fold| fold.importance * fold.costs[fit as usize]).sum::<f64>() / all
    }
}

/// Runs the command.
#[expect(clippy::print_stdout, reason = "the tables are the command's result")]
pub(crate) fn run(words: &[String]) -> Result<(), String> {
    let order = order(words)?;
    let data = workspace::data().join("data");
    if !data.is_dir() {
        println!("skipped: no data");
        return Ok(());
    }
    let (path, text) = (curves::path(), curves::file_text()?);
    if fs::read_to_string(&path).is_ok_and(|now| now == text) {
        println!("as the tables give it: {}\n", path.display());
    } else {
        fs::write(&path, text).map_err(|e| format!("{}: cannot write: {e}", path.display()))?;
        println!(
            "written, it differed from the tables: {}\nbuild and run again: the fit below used the old one\n",
            path.display()
        );
    }
    let cases = cases::load(&data, &mut |label| progress(&format!("loading {label}")))?;
    let outcome = outcome(&cases, &order);
    let page = page::text(&order, &outcome);
    println!(
        "{page}\nTo paste into crates/ambulo/src/ground/predict/fitted_parameters.rs (`cargo fmt` after it):\n\n{:?}",
        outcome.parameters
    );
    if order.write {
        let path = workspace::root().join(PAGE);
        fs::write(&path, page).map_err(|e| format!("{}: cannot write: {e}", path.display()))?;
        progress(&format!("written: {PAGE}"));
    }
    Ok(())
}

#[expect(clippy::print_stderr, reason = "says how far it is")]
fn progress(text: &str) {
    eprintln!("{text}");
}

fn order(words: &[String]) -> Result<Order, String> {
    let mut order = Order { evaluations: EVALUATIONS, seed: SEED, pull: PULL, write: false };
    let mut words = words.iter();
    while let Some(word) = words.next() {
        let mut number = || {
            let value = words.next().ok_or_else(|| format!("{word} needs a number"))?;
            let number = value.parse::<f64>().ok().filter(|x| (0.0..1e9).contains(x));
            number.ok_or_else(|| format!("{word}: found `{value}`, expected a number, not negative"))
        };
        match word.as_str() {
            "--write" => order.write = true,
            "--evaluations" => order.evaluations = number()?.max(1.0) as usize,
            "--seed" => order.seed = number()? as u64,
            "--pull" => order.pull = number()?,
            _ => {
                return Err(format!(
                    "unknown option `{word}`, expected --evaluations N, --seed N, --pull X or --write"
                ));
            }
        }
    }
    Ok(order)
}

fn outcome(all: &Cases, order: &Order) -> Outcome {
    let cases = &all.whole;
    let subjects = cases::subjects(cases);
    let laboratories: Vec<&'static str> = subjects.iter().map(|subject| cases::laboratory(cases, subject)).collect();
    let mut own = fitted(cases, &subjects, order, "all");
    let left_out = |name: &str, stays: &dyn Fn(usize) -> bool| {
        let others = (0..subjects.len()).filter(|&i| stays(i)).map(|i| subjects[i]).collect::<Vec<_>>();
        fitted(cases, &others, order, &format!("without {name}"))
    };
    let persons: Vec<FittedParameters> =
        (0..subjects.len()).map(|i| left_out(subjects[i], &|other| other != i)).collect();
    let mut by_laboratory: Vec<FittedParameters> = Vec::new();
    for (i, laboratory) in laboratories.iter().enumerate() {
        let first = laboratories.iter().position(|other| other == laboratory).unwrap_or(i);
        let is_alone = laboratories.iter().filter(|other| *other == laboratory).count() == 1;
        by_laboratory.push(match (first < i, is_alone) {
            (true, _) => by_laboratory[first],
            (false, true) => persons[i],
            (false, false) => left_out(laboratory, &|other| laboratories[other] != *laboratory),
        });
    }
    // Every subject is predicted with the parameters fitted on other laboratories: these are the errors of strangers.
    let judged = Judged::new(cases, &subjects, &by_laboratory);
    own.calibration = judged.calibration(|_| true);
    let cost = |parameters: &FittedParameters| cases::cost(cases, &subjects, parameters);
    let least = cost(&own);
    let sensitivity = NUMBERS.iter().map(|number| {
        [0.5, 2.0].map(|factor| {
            let mut changed = own;
            number.set(&mut changed, factor * number.of(&own));
            cost(&changed) / least - 1.0
        })
    });
    let folds = subjects.iter().enumerate().map(|(i, subject)| {
        let is_other = |other: &str| cases::laboratory(cases, other) != laboratories[i];
        let calibration = judged.calibration(is_other);
        let parameters = [own, persons[i], by_laboratory[i]].map(|fit| FittedParameters { calibration, ..fit });
        Fold {
            subject,
            importance: cases::importance(cases, subject),
            is_judged: cases::is_judged(cases, subject),
            parameters,
            costs: parameters.map(|fit| cases::subject_cost(cases, subject, &fit)),
            figures: parameters.map(|fit| cases::figures(cases, subject, &fit)),
            bands: judged.bands(subject, &calibration),
            without_trunk: without_trunk(&all.without_trunk, subject, &parameters[Fit::LaboratoryLeftOut as usize]),
        }
    });
    Outcome {
        parameters: own,
        cost: least,
        cost_of_middle: cost(&parameters(&[0.5; NUMBERS.len()])),
        cost_of_shipped: cost(&FittedParameters::default()),
        sensitivity: sensitivity.collect(),
        folds: folds.collect(),
    }
}

fn without_trunk(cases: &[Case], subject: &'static str, fit: &FittedParameters) -> Option<WithoutTrunk> {
    cases.iter().find(|case| case.subject == subject)?;
    let bands = Judged::new(cases, &[subject], &[*fit]).bands(subject, &fit.calibration);
    Some(WithoutTrunk { figures: cases::figures(cases, subject, fit), bands })
}

/// Parameters fitted on some subjects from the middle of the ranges, rounded, with the mean errors that are then left.
fn fitted(cases: &[Case], subjects: &[&'static str], order: &Order, name: &str) -> FittedParameters {
    let begun = Instant::now();
    let cost = |place: &[f64]| {
        let pull: f64 = place.iter().map(|x| (x - 0.5).powi(2)).sum();
        cases::cost(cases, subjects, &parameters(place)) + order.pull * pull
    };
    let found = search::least(vec![0.5; NUMBERS.len()], order.evaluations, order.seed, &cost, &mut |_, _| ());
    progress(&format!("{name}: {:.4}, {:.0} s", found.cost, begun.elapsed().as_secs_f64()));
    let mut parameters = rounded(parameters(&found.place));
    parameters.errors = cases::mean_errors(cases, subjects, &parameters);
    parameters
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(words: &[&str]) -> Result<Order, String> {
        order(&words.iter().map(|word| (*word).to_owned()).collect::<Vec<_>>())
    }

    #[test]
    fn options_are_read_and_what_is_none_is_refused() {
        let order = read(&["--seed", "4", "--evaluations", "50", "--pull", "0.25", "--write"]).unwrap();
        assert!(order.seed == 4 && order.evaluations == 50 && (order.pull - 0.25).abs() < 1e-12 && order.write);
        assert!(!read(&[]).unwrap().write);
        for wrong in [&["--seed"][..], &["--seed", "x"], &["--pull", "-1"], &["--pull", "NaN"], &["--fast"]] {
            assert!(read(wrong).is_err(), "{wrong:?}");
        }
    }
}
