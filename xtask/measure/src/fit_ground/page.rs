//! The page: tables that read as text and as Markdown.

use super::calibration::{Band, Bands, spread};
use super::cases::COMPONENTS;
use super::numbers::{NUMBERS, Number};
use super::{Fit, Fold, Order, Outcome, WithoutTrunk};
use ambulo::ground::predict::{DeviationScaling, FittedParameters, KNOTS, StanceCurve};
use ambulo::study::validation::TextTable as Table;

/// Components of a force in the order of the figures.
const FORCES: [&str; 3] = ["up", "forward", "sideways"];

/// The whole page.
pub(super) fn text(order: &Order, outcome: &Outcome) -> String {
    let Order { evaluations, seed, pull, .. } = *order;
    let laboratories = outcome.laboratories.len();
    let searched = if order.search {
        "All numbers were searched again."
    } else {
        "The numbers of the crate stayed as they are, and without a laboratory those of the last search (`--search`)."
    };
    let head = format!(
        "# Fit of the ground-force estimator\n\n\
         Settings: `--evaluations {evaluations} --seed {seed} --pull {pull}`. The numbers of \
         `ambulo::ground::predict::FittedParameters` that no law gives are fitted to recordings with plates of fifteen \
         people of six laboratories, mean errors and standard deviations to those of all {laboratories} laboratories, \
         each with the same \
         weight. Footfalls are found once a recording, from motion alone; every prediction is made as `ambulo forces \
         --predict` makes it. A random local search with \
         {evaluations} evaluations a fit starts from the middle of the ranges, also for the fits that leave \
         a laboratory out.\n\n\
         Cost of a recording, mean over its feet: upward force rRMSE / 4 % + RMSE / 5 % of body weight + 0.3 (1 - r) / \
         0.01, forward \
         rRMSE / 8.5 %, sideways rRMSE / 12 % + 0.3 (1 - r) / 0.12, centre of pressure along / 24 mm + across / 24 mm. \
         Subjects: mean over \
         their recordings, turns and fast walks included; PiG has no markers on the trunk, is not judged sideways and \
         across, and counts half. \
         Runs are left out. Added to it is {pull} x the sum over the numbers of their squared distance from the middle \
         of the range, as a share of the \
         range: what recordings do not tell stays in the middle. Costs below are without it. {searched}\n"
    );
    let values = format!(
        "{}\nCost with all subjects: {:.3} in the middle of the ranges, {:.3} fitted, {:.3} with the numbers that the \
         crate has now.\n",
        numbers(outcome),
        outcome.cost_of_middle,
        outcome.cost,
        outcome.cost_of_shipped
    );
    let mean_costs = Fit::ALL.map(|fit| format!("{} {:.3}", fit.word(), outcome.mean_cost(fit)));
    let costs = format!("{}\nMean over subjects, PiG at half: {}.\n", costs(outcome), mean_costs.join(", "));
    let sections = [
        ("Numbers: range, fit, and change of the cost when one is halved or doubled", values),
        ("Cost of each subject", costs),
        ("Figures of straight walks", figures(outcome)),
        ("Mean errors that are taken off", errors(outcome)),
        ("Standard deviations: factor and floor", spreads(outcome)),
        ("Bands of 90 %, laboratory left out: share held [%], half-width over RMSE", bands(outcome)),
        ("Groups of people, laboratory left out, and the gate", gate(outcome)),
        ("The same walks without the markers above the pelvis", without_trunk(outcome)),
    ];
    sections.into_iter().fold(head, |page, (title, part)| format!("{page}\n## {title}\n\n{part}"))
}

/// A number with three significant digits and no needless zeros.
fn digits(value: f64) -> String {
    super::numbers::three_digits(value).to_string()
}

fn number(x: f64, digits: usize) -> String {
    if x.is_finite() { format!("{x:.digits$}") } else { "-".to_owned() }
}

fn numbers(outcome: &Outcome) -> String {
    let mut table = Table::new(&[
        "number",
        "unit",
        "least",
        "most",
        "fitted",
        "in the crate",
        "x 0.5 [%]",
        "x 2 [%]",
        "left out, least",
        "left out, most",
    ]);
    let shipped = FittedParameters::default();
    for (number, changes) in NUMBERS.iter().zip(&outcome.sensitivity) {
        let folds = outcome.folds.iter().flat_map(|fold| &fold.parameters[1..]).map(|fit| number.of(fit));
        let (low, high) = folds.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)));
        let Number { name, unit, range, .. } = number;
        let change = |x: f64| format!("{:+.1}", 100.0 * x);
        table.row([
            (*name).to_owned(),
            (*unit).to_owned(),
            digits(range[0]),
            digits(range[1]),
            digits(number.of(&outcome.parameters)),
            digits(number.of(&shipped)),
            change(changes[0]),
            change(changes[1]),
            digits(low),
            digits(high),
        ]);
    }
    table.text()
}

fn costs(outcome: &Outcome) -> String {
    let mut table = Table::new(&["subject", Fit::ALL[0].word(), Fit::ALL[1].word()]);
    for fold in &outcome.folds {
        let [own, laboratory] = fold.costs.map(|cost| number(cost, 3));
        table.row([fold.subject.to_owned(), own, laboratory]);
    }
    table.text()
}

fn figures(outcome: &Outcome) -> String {
    let mut table = figures_table();
    let row = |subject: &str, fit: Fit, values: &[f64; 11]| figures_row([subject, fit.word()], values);
    for fold in &outcome.folds {
        if fold.figures[0][0].is_finite() {
            Fit::ALL.into_iter().for_each(|fit| table.row(row(fold.subject, fit, &fold.figures[fit as usize])));
        }
    }
    for fit in Fit::ALL {
        let of = |k: usize| super::cases::mean(outcome.judged().map(|fold| fold.figures[fit as usize][k]));
        table.row(row("mean with markers on the trunk", fit, &std::array::from_fn(of)));
    }
    table.text()
}

fn figures_table() -> Table {
    let mut head = vec!["subject".to_owned(), "fit".to_owned()];
    head.extend(FORCES.iter().flat_map(|f| [format!("{f} RMSE [%BW]"), "rRMSE [%]".to_owned(), "r".to_owned()]));
    head.extend(["centre along [mm]".to_owned(), "across [mm]".to_owned()]);
    Table::new(&head.iter().map(String::as_str).collect::<Vec<_>>())
}

fn figures_row(names: [&str; 2], values: &[f64; 11]) -> [String; 13] {
    std::array::from_fn(|column| match column {
        0 | 1 => names[column].to_owned(),
        2..11 if column % 3 == 1 => number(values[column - 2], 3),
        2..11 => number(values[column - 2], 2),
        _ => number(values[column - 2], 1),
    })
}

fn without_trunk(outcome: &Outcome) -> String {
    let known: Vec<(&Fold, &WithoutTrunk)> =
        outcome.folds.iter().filter_map(|fold| Some((fold, fold.without_trunk.as_ref()?))).collect();
    let mut figures = figures_table();
    let word = Fit::LaboratoryLeftOut.word();
    known.iter().for_each(|(fold, found)| figures.row(figures_row([fold.subject, word], &found.figures)));
    let of = |k: usize| super::cases::mean(known.iter().map(|(_, found)| found.figures[k]));
    figures.row(figures_row(["mean", word], &std::array::from_fn(of)));
    let bands: Vec<_> = known.iter().map(|(fold, found)| (fold.subject, &found.bands)).collect();
    format!("{}\nBands of 90 %: share held [%], half-width over RMSE\n\n{}", figures.text(), bands_table(&bands))
}

/// A column of the table of mean errors.
struct MeanError {
    name: &'static str,
    curve: fn(&FittedParameters) -> &StanceCurve,
}

const MEAN_ERRORS: [MeanError; 7] = [
    MeanError { name: "force up [%BW]", curve: |fit| &fit.errors.usual.force[1] },
    MeanError { name: "and for each unit of descent", curve: |fit| &fit.errors.changes[1][0] },
    MeanError { name: "and of haste", curve: |fit| &fit.errors.changes[1][1] },
    MeanError { name: "force forward [%BW]", curve: |fit| &fit.errors.usual.force[0] },
    MeanError { name: "force outwards [%BW]", curve: |fit| &fit.errors.usual.force[2] },
    MeanError { name: "and for each unit of leg length", curve: |fit| &fit.errors.changes[2][2] },
    MeanError { name: "centre along [% stature]", curve: |fit| &fit.errors.usual.center[0] },
];

fn errors(outcome: &Outcome) -> String {
    let mut head = vec!["share of the stance"];
    head.extend(MEAN_ERRORS.iter().flat_map(|error| [error.name, "left out"]));
    let mut table = Table::new(&head);
    for (k, knot) in KNOTS.iter().enumerate() {
        let range = |error: &MeanError| {
            let folds = outcome.laboratories.iter().map(|(_, fit)| (error.curve)(fit).0[k]);
            folds.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)))
        };
        let percent = |x: f64| number(100.0 * x, 2);
        let cell = |column: usize| match column.checked_sub(1).map(|column| (&MEAN_ERRORS[column / 2], column % 2)) {
            None => number(*knot, 2),
            Some((error, 0)) => percent((error.curve)(&outcome.parameters).0[k]),
            Some((error, _)) => {
                let (low, high) = range(error);
                format!("{} to {}", percent(low), percent(high))
            }
        };
        table.row((0..=2 * MEAN_ERRORS.len()).map(cell));
    }
    format!(
        "{}\nMeasured minus estimated; forces: over all walks with markers on the trunk, each laboratory with the same \
         weight, in it each person; centre along: over the straight walks of the people of the numbers, each with the \
         same weight. A usual stance is that of an adult at usual speed. Descent of the mass centre at the strike: 0 \
         as \
         usual, 0.85 at most; haste: (V / √(g L) - 0.45) / 0.1 from 0 to 2; leg length: (L - 0.85 m) / 0.1 m \
         (`stance_traits.rs`). `left out`: without a laboratory.\n",
        table.text()
    )
}

fn spreads(outcome: &Outcome) -> String {
    let mut table = Table::new(&[
        "component",
        "share of the stance",
        "unit of the floor",
        "factor",
        "floor",
        "left out: factors",
        "floors",
    ]);
    for (c, component) in COMPONENTS.iter().enumerate() {
        let fifths = if c < 3 { 5 } else { 1 };
        for k in 0..fifths {
            let own = spread(&outcome.parameters.calibration, c)[k];
            let folds: Vec<_> = outcome.laboratories.iter().map(|(_, fit)| spread(&fit.calibration, c)[k]).collect();
            let ends = |of: fn(&DeviationScaling) -> f64| {
                let (low, high) = folds.iter().map(of).fold((f64::INFINITY, 0.0_f64), |(a, b), x| (a.min(x), b.max(x)));
                format!("{} to {}", digits(low), digits(high))
            };
            let unit = match c {
                0..3 => "BW",
                3 | 4 => "m",
                _ => "BW m",
            };
            let phase = if fifths == 1 { "whole".to_owned() } else { format!("{:.1}", 0.1 + 0.2 * k as f64) };
            table.row([
                (*component).to_owned(),
                phase,
                unit.to_owned(),
                digits(own.factor),
                digits(own.floor),
                ends(|s| s.factor),
                ends(|s| s.floor),
            ]);
        }
    }
    format!(
        "{}\nDeviation = root of (factor x deviation of the equations)^2 + floor^2, linear between the shares of the \
         stance; the sharpest pair whose \
         band of 1.645 deviations holds 90 % of the samples (plate above 20 N; centres of pressure and free moments \
         above 5 % of body weight), mean over \
         stances, then over subjects; straight walks. Each subject is predicted with the numbers fitted on other \
         laboratories, so these are the errors of \
         strangers. `left out`: without the laboratory of each subject.\n",
        table.text()
    )
}

/// Bands of everybody who walks straight: means over people, then laboratories.
fn bands(outcome: &Outcome) -> String {
    let mut table = Table::new(&[
        "component",
        "part of the stance",
        "mean held",
        "width",
        "people with 75 % and more",
        "least held by a laboratory",
        "which",
    ]);
    for (c, component) in COMPONENTS.iter().enumerate() {
        for (k, part) in PARTS.iter().enumerate() {
            let known: Vec<(&str, Band)> =
                outcome.bands.iter().filter_map(|(_, laboratory, bands)| Some((*laboratory, bands[k][c]?))).collect();
            let laboratories = super::cases::named(outcome.bands.iter().map(|one| one.1));
            let of = |of: fn(&Band) -> f64| -> Vec<(&str, f64)> {
                let own =
                    |name: &str| super::cases::mean(known.iter().filter(|one| one.0 == name).map(|one| of(&one.1)));
                laboratories.iter().map(|name| (*name, own(name))).filter(|one| one.1.is_finite()).collect()
            };
            let (held, width) = (of(|band| band.holds), of(|band| band.half_width_over_rmse));
            let mean = |all: &[(&str, f64)]| super::cases::mean(all.iter().map(|one| one.1));
            let enough = super::cases::mean(known.iter().map(|one| f64::from(u8::from(one.1.holds >= LEAST_HELD))));
            let least = held.iter().min_by(|a, b| a.1.total_cmp(&b.1));
            table.row([
                (*component).to_owned(),
                (*part).to_owned(),
                number(100.0 * mean(&held), 0),
                number(mean(&width), 2),
                format!("{} %", number(100.0 * enough, 0)),
                number(least.map_or(f64::NAN, |one| 100.0 * one.1), 0),
                least.map_or("-", |one| one.0).to_owned(),
            ]);
        }
    }
    table.text()
}

fn gate(outcome: &Outcome) -> String {
    format!(
        "{}\nMeans over feet, trials, people, then laboratories. Everybody is predicted with parameters that do not \
         know the laboratory. Change: against the last version, with laboratories left out, too. Walking \
         adults, walking children and runners decide: a version that makes one of them worse by more than 2 % does not \
         replace the last one. The other groups are few people of one or two laboratories; GROUND_FORCES.md says what \
         they lose. Mean errors and deviations of walking do not change \
         runners.\n",
        super::gate::table(&outcome.groups)
    )
}

/// Parts of a stance in the order of [`Bands`].
const PARTS: [&str; 6] = ["whole", "1st fifth", "2nd fifth", "3rd fifth", "4th fifth", "5th fifth"];
/// Share that the bands of nine people of ten should hold.
const LEAST_HELD: f64 = 0.75;

/// Means of the bands of subjects.
fn bands_table(subjects: &[(&str, &Bands)]) -> String {
    let mut table = Table::new(&["component", "part of the stance", "mean held", "width", "least held", "by"]);
    for (c, component) in COMPONENTS.iter().enumerate() {
        for (k, part) in PARTS.iter().enumerate() {
            let known: Vec<(&str, Band)> =
                subjects.iter().filter_map(|(subject, bands)| Some((*subject, bands[k][c]?))).collect();
            let least = known.iter().min_by(|a, b| a.1.holds.total_cmp(&b.1.holds));
            table.row([
                (*component).to_owned(),
                (*part).to_owned(),
                number(100.0 * super::cases::mean(known.iter().map(|(_, band)| band.holds)), 0),
                number(super::cases::mean(known.iter().map(|(_, band)| band.half_width_over_rmse)), 2),
                number(least.map_or(f64::NAN, |(_, band)| 100.0 * band.holds), 0),
                least.map_or("-", |(subject, _)| subject).to_owned(),
            ]);
        }
    }
    table.text()
}
