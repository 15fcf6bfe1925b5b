//! The page of a batch: counts, distributions, the worst trials and the failures, from its table of trials.

use super::figures::{CURVE_COLORS, Chart, ChartAxis, ChartCurve, ChartPanel, CurveForm, FigureError};
use super::html::{Document, escaped, html_table};
use ambulo::numerics::sort_numbers;
use ambulo::study::validation::{Section, TextTable, number};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

const STYLE: &str = include_str!("../data/report/page.css");
const POLICY: &str = "default-src 'none'; style-src 'unsafe-inline'; img-src data:";
/// Width of the figure [mm], and height of its axes [pt].
const SIZE: (f64, f64) = (260.0, 90.0);
/// Panels side by side.
const COLUMNS: usize = 3;
/// Steps of a curve at most.
const STEPS: usize = 500;
/// Trials, and reasons of failures, that are listed.
const LISTED: usize = 100;

/// A quantity of every trial whose distribution is shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct BatchQuantity {
    /// Column of the quantity in the table of trials.
    pub column: &'static str,
    /// Title of its panel.
    pub title: &'static str,
    /// Unit of the quantity.
    pub unit: &'static str,
    decimals: usize,
}

/// The quantities, in the order of the page.
pub const BATCH_QUANTITIES: [BatchQuantity; 6] = [
    quantity("residual_force_bw", "Residual force, rms", "BW", 3),
    quantity("residual_moment_nm", "Residual moment, rms", "N.m", 1),
    quantity("marker_error_mm", "Distance of markers, rms", "mm", 1),
    quantity("speed_m_s", "Speed", "m/s", 2),
    quantity("mass_kg", "Body mass", "kg", 1),
    quantity("rate_hz", "Frame rate", "Hz", 1),
];

const fn quantity(column: &'static str, title: &'static str, unit: &'static str, decimals: usize) -> BatchQuantity {
    BatchQuantity { column, title, unit, decimals }
}

/// A trial of a batch.
#[derive(Debug, Clone, PartialEq)]
pub struct BatchTrial {
    /// Path of the recording.
    pub name: String,
    /// Person of the trial.
    pub person: String,
    /// Why it was not computed.
    pub error: Option<String>,
    /// Quality of the data: `good`, `doubtful`, `bad`.
    pub quality: Option<String>,
    /// Verdict on the motion: `feasible`, `infeasible`, `not_judged`.
    pub verdict: Option<String>,
    /// Why quality and verdict are not better.
    pub reasons: Vec<String>,
    /// The values of [`BATCH_QUANTITIES`]; NaN where the trial has none.
    pub values: [f64; BATCH_QUANTITIES.len()],
}

/// The page of a batch. `source` names where the trials came from; `worst` are the trials that are not good and
/// feasible, the worst first, each with the command that makes the page of the trial.
///
/// # Errors
/// A style that cannot be read.
pub fn batch_page(source: &str, trials: &[BatchTrial], worst: &[(&BatchTrial, String)]) -> Result<String, FigureError> {
    let title = format!("Batch of {source}");
    let sections = [distributions(trials), worst_trials(worst), failures(trials)];
    let tables: String = sections
        .iter()
        .filter(|section| !section.table.rows().is_empty())
        .map(|section| format!("<h2>{}</h2>\n{}", escaped(section.title), html_table(section)))
        .collect();
    let body = format!(
        r#"<header>
<h1>{title}</h1>
<p>{lead}</p>
<p class="soft">Made from the table of trials. Ambulo {version}</p>
</header>
<main>
<h2>Shares of the trials below a value</h2>
{figure}
{tables}</main>"#,
        title = escaped(&title),
        lead = escaped(&lead(trials)),
        version = env!("CARGO_PKG_VERSION"),
        figure = figure(trials)?,
    );
    let style = format!("{STYLE}\n.picture svg {{ min-width: 46rem; }}\ntbody th {{ white-space: nowrap; }}");
    Ok(Document { title: &title, policy: POLICY, style: &style, body: &body }.html())
}

fn lead(trials: &[BatchTrial]) -> String {
    let persons: BTreeSet<&str> = trials.iter().map(|trial| trial.person.as_str()).collect();
    let computed = trials.iter().filter(|trial| trial.error.is_none()).count();
    let counted = |of: fn(&BatchTrial) -> Option<&str>| {
        let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
        trials.iter().filter_map(of).for_each(|word| *counts.entry(word).or_default() += 1);
        counts.iter().map(|(word, count)| format!("{count} {}", words(word))).collect::<Vec<_>>().join(", ")
    };
    let (quality, verdict) = (counted(|trial| trial.quality.as_deref()), counted(|trial| trial.verdict.as_deref()));
    let states =
        if computed == 0 { String::new() } else { format!(" Quality of the data: {quality}. Motion: {verdict}.") };
    format!("{computed} of {} trials were computed (persons: {}).{states}", trials.len(), persons.len())
}

/// The known values of a quantity in increasing order.
fn sorted(trials: &[BatchTrial], quantity: usize) -> Vec<f64> {
    let mut values: Vec<f64> = trials.iter().map(|trial| trial.values[quantity]).filter(|x| x.is_finite()).collect();
    sort_numbers(&mut values);
    values
}

/// Cumulative distributions: they need no choice of classes, and show single values far from the others.
fn figure(trials: &[BatchTrial]) -> Result<String, FigureError> {
    let panel = |(k, quantity): (usize, &BatchQuantity)| {
        let values = sorted(trials, k);
        let all = values.len() as f64;
        // A step at each value, or at as many as can be seen.
        let steps = values.len().min(STEPS);
        let shown = (1..=steps).map(|step| step * values.len() / steps);
        let points = shown.scan(0, |before, up_to| {
            let x = values[up_to - 1];
            let ends = [*before, up_to].map(|count| [x, 100.0 * count as f64 / all]);
            *before = up_to;
            Some(ends)
        });
        let curve = ChartCurve {
            name: String::new(),
            color: CURVE_COLORS[0],
            form: CurveForm::Line,
            points: points.flatten().collect(),
        };
        ChartPanel {
            title: format!("{} ({})", quantity.title, quantity.unit),
            abscissa: ChartAxis::labelled(""),
            ordinate: ChartAxis { range: Some([0.0, 100.0]), ..ChartAxis::labelled("% of trials") },
            curves: vec![curve],
            ..ChartPanel::default()
        }
    };
    let known = |(k, _): &(usize, &BatchQuantity)| !sorted(trials, *k).is_empty();
    let panels: Vec<ChartPanel> = BATCH_QUANTITIES.iter().enumerate().filter(known).map(panel).collect();
    if panels.is_empty() {
        return Ok(String::new());
    }
    let chart = Chart {
        name: "distributions",
        title: "Distributions".to_owned(),
        caption: String::new(),
        width_mm: SIZE.0,
        columns: COLUMNS,
        panel_height_pt: SIZE.1,
        panels,
        notes: Vec::new(),
    };
    let svg = chart.svg()?.replacen("<svg ", "<svg aria-label=\"Distributions over the trials\" ", 1);
    Ok(format!("<p class=\"picture\">{svg}</p>\n"))
}

fn distributions(trials: &[BatchTrial]) -> Section {
    let mut table = TextTable::new(&["quantity", "unit", "trials", "lowest", "5 %", "median", "95 %", "highest"]);
    for (k, quantity) in BATCH_QUANTITIES.iter().enumerate() {
        let values = sorted(trials, k);
        let Some(last) = values.len().checked_sub(1) else { continue };
        let at = |share: f64| number(values[(share * last as f64).round() as usize], quantity.decimals);
        let [lowest, low, middle, high, highest] = [0.0, 0.05, 0.5, 0.95, 1.0].map(at);
        let count = values.len().to_string();
        table.row([quantity.title.to_owned(), quantity.unit.to_owned(), count, lowest, low, middle, high, highest]);
    }
    let note = "A trial has no value where it cannot have one, such as the distance of markers in a recording of joint \
        angles.";
    Section { title: "Distributions", table, note: note.to_owned() }
}

fn worst_trials(worst: &[(&BatchTrial, String)]) -> Section {
    let mut table = TextTable::new(&["trial", "data", "motion", "reasons", "command that makes its page"]);
    let computed = || worst.iter().filter(|(trial, _)| trial.error.is_none());
    for (trial, command) in computed().take(LISTED) {
        let word = |word: &Option<String>| word.as_deref().map_or("-".to_owned(), words);
        table.row([
            trial.name.clone(),
            word(&trial.quality),
            word(&trial.verdict),
            trial.reasons.join("; "),
            command.clone(),
        ]);
    }
    let note =
        format!("The commands are for the folder in which the batch was started. {}", and_more(computed().count()));
    Section { title: "Worst trials", table, note: note.trim_end().to_owned() }
}

/// Failures with one reason are one row.
fn failures(trials: &[BatchTrial]) -> Section {
    let mut reasons: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    for trial in trials {
        if let Some(error) = &trial.error {
            reasons.entry(error).or_default().push(&trial.name);
        }
    }
    let mut ordered: Vec<(&str, Vec<&str>)> = reasons.into_iter().collect();
    ordered.sort_by_key(|(_, names)| std::cmp::Reverse(names.len()));
    let count = ordered.len();
    let mut table = TextTable::new(&["reason", "trials", "first trial"]);
    for (reason, names) in ordered.into_iter().take(LISTED) {
        table.row([reason.to_owned(), names.len().to_string(), names[0].to_owned()]);
    }
    Section { title: "Failures by reason", table, note: and_more(count) }
}

/// A state as it is read: its name in files has no blanks.
fn words(state: &str) -> String {
    state.replace('_', " ")
}

/// The note below a list of this many entries.
fn and_more(count: usize) -> String {
    let mut note = String::new();
    if count > LISTED {
        let _ = write!(note, "The first {LISTED} of {count}. The folder `trials` has all.");
    }
    note
}
