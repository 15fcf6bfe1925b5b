//! Fits the parameters of the ground-force estimator:
//! `cargo xtask fit-ground [--evaluations N] [--seed N] [--pull X] [--search] [--write] [--keep]`.
//!
//! Writes `crates/ambulo/data/ground/stance_curves.toml` from the normative tables and reports whether the file has
//! changed. Fits the numbers of `ambulo::ground::predict::FittedParameters` to recordings with plates of the people of
//! VALIDATION.md, and its mean errors and standard deviations to those of all laboratories, each with the same weight;
//! on everybody and with people and laboratories left out. Prints the results; with `--write` they go to
//! docs/measured/GROUND_FIT.md, with `--keep` the errors of this version replace those that the gate compares with. The
//! parameters are printed as the `Default` to paste: this command changes no source.

mod calibration;
mod cases;
mod curves;
mod gate;
mod numbers;
mod page;
mod search;

use crate::workspace;
use ambulo::ground::predict::FittedParameters;
use calibration::{Bands, Judged};
use cases::{Case, CaseErrors, Cases};
use numbers::{NUMBERS, parameters, rounded};
use std::fs;
use std::path::Path;
use std::thread;
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
    keep: bool,
    /// Whether the numbers are searched again; otherwise those of the crate stay, and without a laboratory those that
    /// were found last.
    search: bool,
}

impl Order {
    const DEFAULT: Order =
        Order { evaluations: EVALUATIONS, seed: SEED, pull: PULL, write: false, keep: false, search: false };
}

/// How the parameters were fitted with which a subject is predicted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Fit {
    /// On all subjects.
    Own,
    /// On those of other laboratories.
    LaboratoryLeftOut,
}

impl Fit {
    const ALL: [Fit; 2] = [Fit::Own, Fit::LaboratoryLeftOut];

    fn word(self) -> &'static str {
        match self {
            Fit::Own => "own",
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
    parameters: [FittedParameters; 2],
    costs: [f64; 2],
    figures: [[f64; 11]; 2],
    /// The same without the markers above the pelvis; `None` where the subject has no walk with all markers.
    without_trunk: Option<WithoutTrunk>,
}

/// Results of a subject whose markers above the pelvis were dropped, with the laboratory left out of the fit.
struct WithoutTrunk {
    figures: [f64; 11],
    bands: Bands,
}

/// Laboratories, each with parameters that were fitted without it.
pub(crate) type Fits = Vec<(&'static str, FittedParameters)>;

/// The results of the fit.
struct Outcome {
    /// Fitted and calibrated on everybody.
    parameters: FittedParameters,
    cost: f64,
    cost_of_middle: f64,
    cost_of_shipped: f64,
    /// Change of the cost, as a share, when a number is halved and doubled.
    sensitivity: Vec<[f64; 2]>,
    /// The people to whom the numbers are fitted.
    folds: Vec<Fold>,
    /// Each laboratory with the parameters that do not know it.
    laboratories: Fits,
    /// Bands of everybody who walks straight, the own laboratory left out.
    bands: Vec<(&'static str, &'static str, Bands)>,
    /// Errors of groups, the own laboratory left out.
    groups: Vec<gate::GroupErrors>,
    /// The numbers of the laboratories that have a part in them, without each of them.
    numbers_left_out: Fits,
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
    let outcome = outcome(&cases, &order)?;
    let page = page::text(&order, &outcome);
    if order.search {
        let path = workspace::root().join(NUMBERS_LEFT_OUT);
        fs::write(&path, numbers::written(&outcome.numbers_left_out))
            .map_err(|e| format!("{}: cannot write: {e}", path.display()))?;
    }
    if order.keep {
        gate::keep(&outcome.groups)?;
    }
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
    let mut order = Order::DEFAULT;
    let mut words = words.iter();
    while let Some(word) = words.next() {
        let mut number = || {
            let value = words.next().ok_or_else(|| format!("{word} needs a number"))?;
            let number = value.parse::<f64>().ok().filter(|x| (0.0..1e9).contains(x));
            number.ok_or_else(|| format!("{word}: found `{value}`, expected a number, not negative"))
        };
        match word.as_str() {
            "--write" => order.write = true,
            "--keep" => order.keep = true,
            "--search" => order.search = true,
            "--evaluations" => order.evaluations = number()?.max(1.0) as usize,
            "--seed" => order.seed = number()? as u64,
            "--pull" => order.pull = number()?,
            _ => {
                return Err(format!(
                    "unknown option `{word}`, expected --evaluations N, --seed N, --pull X, --write or \
                     --keep"
                ));
            }
        }
    }
    Ok(order)
}

/// Numbers that were fitted without some people, with the errors of everybody that they leave.
struct Numbers {
    parameters: FittedParameters,
    errors: CaseErrors,
}

impl Numbers {
    fn of(all: &Cases, parameters: FittedParameters) -> Numbers {
        Numbers { errors: cases::errors(&all.all().collect::<Vec<_>>(), &parameters), parameters }
    }

    /// With the mean errors of the cases for which `stays` states so.
    fn with_means(&self, all: &Cases, stays: &dyn Fn(&Case) -> bool) -> FittedParameters {
        let errors = cases::mean_errors(&all.all().collect::<Vec<_>>(), &self.errors, stays);
        FittedParameters { errors, ..self.parameters }
    }
}

/// Numbers that were fitted without each laboratory that has a part in them, relative to the workspace root.
const NUMBERS_LEFT_OUT: &str = "xtask/measure/src/fit_ground/numbers_left_out.csv";

/// Parameters for each laboratory that were fitted and calibrated without it, in the order of the recordings.
pub(crate) fn laboratories_left_out(data: &Path) -> Result<Fits, String> {
    let all = cases::load(data, &mut |label| progress(&format!("loading {label}")))?;
    let (own, left_out) = known_numbers(&all)?;
    let of = |laboratory: &str| of_laboratory(&left_out, laboratory).copied();
    let fits = without_each_laboratory(&all, &Numbers::of(&all, own), &of);
    let judged = Judged::new(all.all(), &|laboratory| of_laboratory(&fits, laboratory));
    Ok(calibrated(&fits, &judged))
}

/// The numbers of the crate, and those that [`all_numbers`] has found last without each laboratory.
fn known_numbers(all: &Cases) -> Result<(FittedParameters, Fits), String> {
    let path = workspace::root().join(NUMBERS_LEFT_OUT);
    let hint = "hint: `cargo xtask fit-ground --search` writes it";
    let text = fs::read_to_string(&path).map_err(|e| format!("{}: {e}. {hint}", path.display()))?;
    let known = numbers::read(&text);
    let of = |laboratory: &'static str| {
        let found = known.iter().find(|(name, _)| name == laboratory).map(|(_, found)| (laboratory, *found));
        found.ok_or_else(|| format!("{}: no numbers without {laboratory}. {hint}", path.display()))
    };
    let laboratories = cases::named(all.whole.iter().map(|case| case.laboratory));
    let left_out = laboratories.into_iter().map(of).collect::<Result<Vec<_>, String>>()?;
    Ok((numbers::unfitted(), left_out))
}

/// Numbers fitted to everybody who has a part in them, and without each of their laboratories; the fits run side by
/// side.
fn all_numbers(all: &Cases, order: &Order) -> (FittedParameters, Fits) {
    let subjects = cases::subjects(&all.whole);
    let without = |laboratory: &'static str| {
        let is_other = |subject: &&str| cases::laboratory(&all.whole, subject) != laboratory;
        let others: Vec<&'static str> = subjects.iter().copied().filter(is_other).collect();
        (laboratory, numbers_fitted(&all.whole, &others, order, &format!("without {laboratory}")))
    };
    let laboratories = cases::named(all.whole.iter().map(|case| case.laboratory));
    thread::scope(|scope| {
        let without = &without;
        let left_out: Vec<_> =
            laboratories.into_iter().map(|laboratory| scope.spawn(move || without(laboratory))).collect();
        let own = numbers_fitted(&all.whole, &subjects, order, "all");
        (own, left_out.into_iter().filter_map(|fit| fit.join().ok()).collect())
    })
}

/// Numbers and mean errors without each laboratory. `numbers` gives those of the laboratories that have a part in them.
fn without_each_laboratory(all: &Cases, own: &Numbers, numbers: &dyn Fn(&str) -> Option<FittedParameters>) -> Fits {
    let without = |laboratory: &'static str| {
        let stays = |case: &Case| case.laboratory != laboratory;
        let parameters = match numbers(laboratory) {
            Some(found) => Numbers::of(all, found).with_means(all, &stays),
            None => own.with_means(all, &stays),
        };
        (laboratory, parameters)
    };
    all.laboratories().into_iter().map(without).collect()
}

fn of_laboratory<'a>(fits: &'a [(&'static str, FittedParameters)], laboratory: &str) -> Option<&'a FittedParameters> {
    fits.iter().find(|(name, _)| *name == laboratory).map(|(_, parameters)| parameters)
}

/// With the standard deviations that the others need.
fn calibrated(fits: &[(&'static str, FittedParameters)], judged: &Judged) -> Fits {
    let with = |(name, fit): &(&'static str, FittedParameters)| {
        (*name, FittedParameters { calibration: judged.calibration(Some(name)), ..*fit })
    };
    fits.iter().map(with).collect()
}

fn outcome(all: &Cases, order: &Order) -> Result<Outcome, String> {
    let cases = &all.whole;
    let subjects = cases::subjects(cases);
    let (of_everybody, left_out) = if order.search { all_numbers(all, order) } else { known_numbers(all)? };
    let numbers = Numbers::of(all, of_everybody);
    let fits = without_each_laboratory(all, &numbers, &|laboratory| of_laboratory(&left_out, laboratory).copied());
    // Everybody is predicted with the parameters fitted on other laboratories: these are the errors of strangers.
    let judged = Judged::new(all.all(), &|laboratory| of_laboratory(&fits, laboratory));
    let laboratories = calibrated(&fits, &judged);
    let means = numbers.with_means(all, &|_| true);
    let own = FittedParameters { calibration: judged.calibration(None), ..means };
    progress(&format!("fitted: {own:?}"));
    let cost = |parameters: &FittedParameters| cases::cost(cases, &subjects, parameters);
    let least = cost(&own);
    let sensitivity = NUMBERS.iter().map(|number| {
        [0.5, 2.0].map(|factor| {
            let mut changed = own;
            number.set(&mut changed, factor * number.of(&own));
            cost(&changed) / least - 1.0
        })
    });
    let bands = judged.people().map(|(subject, laboratory)| {
        let calibration = of_laboratory(&laboratories, laboratory).map_or(own.calibration, |fit| fit.calibration);
        (subject, laboratory, judged.bands(subject, &calibration))
    });
    Ok(Outcome {
        cost: least,
        cost_of_middle: cost(&parameters(&[0.5; NUMBERS.len()])),
        cost_of_shipped: cost(&FittedParameters::default()),
        sensitivity: sensitivity.collect(),
        folds: subjects.iter().map(|subject| fold(all, subject, &own, &laboratories)).collect(),
        numbers_left_out: left_out,
        bands: bands.collect(),
        groups: gate::by_group(all.all(), &|laboratory| of_laboratory(&laboratories, laboratory)),
        parameters: own,
        laboratories,
    })
}

/// The results of one of the people to whom the numbers are fitted.
fn fold(
    all: &Cases,
    subject: &'static str,
    own: &FittedParameters,
    laboratories: &[(&'static str, FittedParameters)],
) -> Fold {
    let cases = &all.whole;
    let laboratory = cases::laboratory(cases, subject);
    let of_laboratory = of_laboratory(laboratories, laboratory).copied().unwrap_or(*own);
    let parameters = [*own, of_laboratory];
    Fold {
        subject,
        importance: cases::importance(cases, subject),
        is_judged: cases::is_judged(cases, subject),
        parameters,
        costs: parameters.map(|fit| cases::subject_cost(cases, subject, &fit)),
        figures: parameters.map(|fit| cases::figures(cases, subject, &fit)),
        without_trunk: without_trunk(&all.without_trunk, subject, &of_laboratory),
    }
}

fn without_trunk(cases: &[Case], subject: &'static str, fit: &FittedParameters) -> Option<WithoutTrunk> {
    let own = cases.iter().filter(|case| case.subject == subject);
    own.clone().next()?;
    let bands = Judged::new(own, &|_| Some(fit)).bands(subject, &fit.calibration);
    Some(WithoutTrunk { figures: cases::figures(cases, subject, fit), bands })
}

/// Parameters fitted on some subjects from the middle of the ranges, rounded.
fn numbers_fitted(cases: &[Case], subjects: &[&'static str], order: &Order, name: &str) -> FittedParameters {
    let begun = Instant::now();
    let cost = |place: &[f64]| {
        let pull: f64 = place.iter().map(|x| (x - 0.5).powi(2)).sum();
        cases::cost(cases, subjects, &parameters(place)) + order.pull * pull
    };
    let found = search::least(vec![0.5; NUMBERS.len()], order.evaluations, order.seed, &cost, &mut |_, _| ());
    progress(&format!("{name}: {:.4}, {:.0} s", found.cost, begun.elapsed().as_secs_f64()));
    rounded(parameters(&found.place))
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
