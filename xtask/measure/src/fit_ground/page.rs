//! The page: tables that read as text and as Markdown.

use super::calibration::spread;
use super::cases::COMPONENTS;
use super::numbers::{NUMBERS, Number};
use super::{Fold, Order, Outcome};
use crate::table::Table;
use ambulo::ground::predict::FittedParameters;

/// Components of a force in the order of the figures.
const FORCES: [&str; 3] = ["up", "forward", "sideways"];

/// The whole page.
pub(super) fn text(order: &Order, outcome: &Outcome) -> String {
    let Order { evaluations, seed, pull, .. } = *order;
    let head = format!(
        "# Fit of the ground-force estimator\n\n\
         Settings: `--evaluations {evaluations} --seed {seed} --pull {pull}`. The numbers of `ambulo::ground::predict::FittedParameters` that no law gives are fitted to recordings with plates. Footfalls are found once a \
         recording, from motion alone; every prediction is made as `ambulo forces --predict` makes it. A random local search with \
         {evaluations} evaluations a fit starts from the middle of the ranges, also for the fits that leave a subject out.\n\n\
         Cost of a recording, mean over its feet: upward force rRMSE / 4 % + RMSE / 5 % of body weight + 0.3 (1 - r) / 0.01, forward \
         rRMSE / 8.5 %, sideways rRMSE / 12 % + 0.3 (1 - r) / 0.12, centre of pressure along / 24 mm + across / 24 mm. Subjects: mean over \
         their recordings, turns included; PiG has no markers on the trunk, is not judged sideways and across, and counts half. A run is \
         left out. Added to it is {pull} x the sum over the numbers of their squared distance from the middle of the range, as a share of the \
         range: what recordings do not tell stays in the middle. Costs below are without it.\n"
    );
    let values = format!(
        "{}\nCost with all subjects: {:.3} in the middle of the ranges, {:.3} fitted, {:.3} with the numbers that the crate has now.\n",
        numbers(outcome),
        outcome.cost_of_middle,
        outcome.cost,
        outcome.cost_of_shipped
    );
    let costs = format!(
        "{}\n`own`: fitted on all subjects. `left out`: fitted on the others. Mean over subjects, PiG at half: own {:.3}, left out {:.3}.\n",
        costs(outcome),
        outcome.mean_cost(|fold| fold.own_cost),
        outcome.mean_cost(|fold| fold.left_out_cost)
    );
    let sections = [
        ("Numbers: range, fit, and change of the cost when one is halved or doubled", values),
        ("Cost of each subject", costs),
        ("Figures of straight walks, own and left out", figures(outcome)),
        ("Standard deviations: factor and floor", spreads(outcome)),
        ("Bands of 90 %, subject left out: share held [%], half-width over RMSE", bands(outcome)),
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
        let folds = outcome.folds.iter().map(|fold| number.of(&fold.parameters));
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
    let mut table = Table::new(&["subject", "own", "left out"]);
    for fold in &outcome.folds {
        table.row([fold.subject.to_owned(), number(fold.own_cost, 3), number(fold.left_out_cost, 3)]);
    }
    table.text()
}

fn figures(outcome: &Outcome) -> String {
    let mut head = vec!["subject".to_owned(), "fit".to_owned()];
    head.extend(FORCES.iter().flat_map(|f| [format!("{f} RMSE [%BW]"), "rRMSE [%]".to_owned(), "r".to_owned()]));
    head.extend(["centre along [mm]".to_owned(), "across [mm]".to_owned()]);
    let mut table = Table::new(&head.iter().map(String::as_str).collect::<Vec<_>>());
    let row = |subject: &str, fit: &str, values: &[f64; 11]| -> [String; 13] {
        std::array::from_fn(|column| match column {
            0 => subject.to_owned(),
            1 => fit.to_owned(),
            2..11 if column % 3 == 1 => number(values[column - 2], 3),
            2..11 => number(values[column - 2], 2),
            _ => number(values[column - 2], 1),
        })
    };
    for fold in &outcome.folds {
        table.row(row(fold.subject, "own", &fold.own_figures));
        table.row(row(fold.subject, "left out", &fold.left_out_figures));
    }
    let mean = |of: fn(&Fold) -> &[f64; 11]| {
        std::array::from_fn(|k| super::cases::mean(outcome.with_trunk().map(|fold| of(fold)[k])))
    };
    table.row(row("mean without PiG", "own", &mean(|fold| &fold.own_figures)));
    table.row(row("mean without PiG", "left out", &mean(|fold| &fold.left_out_figures)));
    table.text()
}

fn spreads(outcome: &Outcome) -> String {
    let mut table = Table::new(&["component", "unit of the floor", "factor", "floor", "left out: factors", "floors"]);
    for (c, component) in COMPONENTS.iter().enumerate() {
        let own = spread(&outcome.parameters.calibration, c);
        let folds: Vec<_> = outcome.folds.iter().map(|fold| spread(&fold.parameters.calibration, c)).collect();
        let ends = |of: fn(&ambulo::ground::predict::DeviationScaling) -> f64| {
            let (low, high) = folds.iter().map(of).fold((f64::INFINITY, 0.0_f64), |(a, b), x| (a.min(x), b.max(x)));
            format!("{} to {}", digits(low), digits(high))
        };
        let unit = match c {
            0..3 => "BW",
            3 | 4 => "m",
            _ => "BW m",
        };
        table.row([
            (*component).to_owned(),
            unit.to_owned(),
            digits(own.factor),
            digits(own.floor),
            ends(|s| s.factor),
            ends(|s| s.floor),
        ]);
    }
    format!(
        "{}\nDeviation = root of (factor x deviation of the equations)^2 + floor^2; the sharpest pair whose band of 1.645 deviations \
         holds 90 % of the samples (plate above 20 N; centres of pressure and free moments above 5 % of body weight), mean over stances, \
         then over subjects; straight walks. Each subject is predicted with the numbers fitted on the others, so these are the errors of strangers. \
         `left out`: from the other subjects alone.\n",
        table.text()
    )
}

fn bands(outcome: &Outcome) -> String {
    let mut head = vec!["component"];
    head.extend(outcome.folds.iter().flat_map(|fold| [fold.subject, "width"]));
    head.extend(["mean without PiG", "width"]);
    let mut rows = String::new();
    let line = |cells: &[String]| format!("| {} |\n", cells.join(" | "));
    rows += &line(&head.iter().map(|cell| (*cell).to_owned()).collect::<Vec<_>>());
    rows += &line(
        &head.iter().enumerate().map(|(i, _)| if i == 0 { ":---" } else { "---:" }.to_owned()).collect::<Vec<_>>(),
    );
    for (c, component) in COMPONENTS.iter().enumerate() {
        let found: Vec<_> = outcome.folds.iter().map(|fold| fold.bands[c]).collect();
        let mut cells = vec![(*component).to_owned()];
        for band in &found {
            cells.push(band.map_or("-".to_owned(), |band| number(100.0 * band.holds, 0)));
            cells.push(band.map_or("-".to_owned(), |band| number(band.half_width_over_rmse, 2)));
        }
        let known = || outcome.with_trunk().filter_map(|fold| fold.bands[c]);
        cells.push(number(100.0 * super::cases::mean(known().map(|band| band.holds)), 0));
        cells.push(number(super::cases::mean(known().map(|band| band.half_width_over_rmse)), 2));
        rows += &line(&cells);
    }
    rows
}
