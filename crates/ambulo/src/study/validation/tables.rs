//! Tables of judged trials.

use super::figures::{Component, Figure, LegJoint, kinds, over_kind, persons};
use super::methods::Method;
use super::text_table::TextTable;
use super::trial::JudgedTrial;
use crate::analysis::{FootAgreement, ForceAgreement};
use crate::model::Side;
use crate::numerics::finite_mean;

/// A table with its title and, below it, a note; the note may be empty.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Section {
    /// Content of the table.
    pub title: &'static str,
    /// The table.
    pub table: TextTable,
    /// Explanation for readers.
    pub note: String,
}

impl Section {
    /// As Markdown, with a heading of the second level.
    #[must_use]
    pub fn markdown(&self) -> String {
        let note = if self.note.is_empty() { String::new() } else { format!("\n{}\n", self.note) };
        format!("## {}\n\n{}{note}", self.title, self.table.text())
    }
}

/// Definitions of the figures in the tables.
pub const DEFINITIONS: &str = "\
Per foot over its whole stances on plates of its own (plate above 20 N): RMSE in % of body weight, rRMSE over the mean \
of the two ranges, \
Pearson's r, share of the samples inside the predicted 90 % band, and half-width of that band over the RMSE. Vertical \
is against gravity; \
fore-aft is along the walking direction, in turns that of the pelvis in that stance; lateral is across it. Centres of \
pressure (CoP) where the \
plate carries more than 5 % of body weight; in tables of means they are weighted by the vertical force. Moments of a \
leg over the \
instrumented window and over its whole stances. Means: feet, then trials, then persons; a person with several trials \
of a kind counts once.";

/// Headings, figures and digits of the tables with one row per trial, person or method.
pub const SUMMARY: [(&str, Figure, usize); 12] = [
    ("vertical %BW", Figure::Rmse(Component::Vertical), 2),
    ("r", Figure::Correlation(Component::Vertical), 3),
    ("fore-aft %BW", Figure::Rmse(Component::ForeAft), 2),
    ("r", Figure::Correlation(Component::ForeAft), 3),
    ("lateral %BW", Figure::Rmse(Component::Lateral), 2),
    ("r", Figure::Correlation(Component::Lateral), 3),
    ("CoP fore-aft mm", Figure::CenterAlong, 1),
    ("CoP lateral mm", Figure::CenterAcross, 1),
    ("hip N.m/kg", Figure::Moment(LegJoint::Hip), 3),
    ("knee", Figure::Moment(LegJoint::Knee), 3),
    ("ankle", Figure::Moment(LegJoint::Ankle), 3),
    ("events ms", Figure::Events, 1),
];

/// A number, or a dash.
#[must_use]
pub fn number(x: f64, digits: usize) -> String {
    if x.is_finite() { format!("{x:.digits$}") } else { "-".to_owned() }
}

/// The cells of [`SUMMARY`].
pub fn summary_cells(of: impl Fn(Figure) -> f64) -> [String; SUMMARY.len()] {
    SUMMARY.map(|(_, figure, digits)| number(of(figure), digits))
}

fn summary_table(head: &[&str]) -> TextTable {
    let names: Vec<&str> = head.iter().copied().chain(SUMMARY.map(|(name, ..)| name)).collect();
    TextTable::new(&names)
}

/// Means of each kind of trial, component by component.
#[must_use]
pub fn kind_means(trials: &[&JudgedTrial]) -> Section {
    let mut table = TextTable::new(&[
        "kind",
        "persons",
        "trials",
        "component",
        "RMSE %BW",
        "rRMSE %",
        "r",
        "in band %",
        "band/RMSE",
    ]);
    for kind in kinds(trials) {
        let own: Vec<&JudgedTrial> = trials.iter().filter(|trial| trial.kind == kind).copied().collect();
        let count = [persons(&own).len(), own.len()].map(|count| count.to_string());
        for component in Component::ALL {
            let mean =
                |figure: Figure, digits| number(over_kind(trials, kind, |trial| figure.of(&trial.agreement)), digits);
            let head = [kind.to_owned()].into_iter().chain(count.clone()).chain([component.word().to_owned()]);
            table.row(head.chain([
                mean(Figure::Rmse(component), 2),
                mean(Figure::Relative(component), 1),
                mean(Figure::Correlation(component), 3),
                mean(Figure::InBand(component), 1),
                mean(Figure::BandWidth(component), 2),
            ]));
        }
    }
    Section { title: "Means of each kind of trial", table, note: String::new() }
}

/// Means of each kind of trial by each method.
#[must_use]
pub fn method_means(trials: &[&JudgedTrial]) -> Section {
    // Strikes and offs are the same for all of them.
    let columns = || SUMMARY.into_iter().filter(|(_, figure, _)| *figure != Figure::Events);
    let names: Vec<&str> = ["kind", "method", "trials"].into_iter().chain(columns().map(|(name, ..)| name)).collect();
    let mut table = TextTable::new(&names);
    for kind in kinds(trials) {
        for method in Method::ALL {
            let own: Vec<&JudgedTrial> = trials
                .iter()
                .filter(|trial| trial.kind == kind && trial.of_method(method).is_some())
                .copied()
                .collect();
            if own.is_empty() {
                continue;
            }
            let mean = |figure: Figure| {
                over_kind(&own, kind, |trial| trial.of_method(method).map_or(f64::NAN, |found| figure.of(found)))
            };
            let cells = columns().map(|(_, figure, digits)| number(mean(figure), digits));
            table.row([kind.to_owned(), method.words().to_owned(), own.len().to_string()].into_iter().chain(cells));
        }
    }
    let note = "Foot height: the weight, divided by exp(-height of the foot / 8 cm), as monomech 0.15.24 does; it has \
        no horizontal force. Smooth \
                transition: the total force by Newton's law; in double support the trailing foot's force fades along \
                fixed curves (Ren, Jones, \
                Howard 2008), between the strikes and offs that the prediction detects. Tracking: a motion near the \
                recorded one that feet on soft \
                ground make, where one was found. Prediction: this program's.";
    Section { title: "Methods side by side", table, note: note.to_owned() }
}

/// Means of each person's trials of a kind.
#[must_use]
pub fn person_means(trials: &[&JudgedTrial]) -> Section {
    let mut table = summary_table(&["person", "kind", "trials"]);
    for person in persons(trials) {
        let of_person: Vec<&JudgedTrial> = trials.iter().filter(|trial| trial.person == person).copied().collect();
        for kind in kinds(&of_person) {
            let own = || of_person.iter().filter(|trial| trial.kind == kind);
            let cells = summary_cells(|figure| finite_mean(own().map(|trial| figure.of(&trial.agreement))));
            table.row([person.to_owned(), kind.to_owned(), own().count().to_string()].into_iter().chain(cells));
        }
    }
    Section { title: "Means of each person", table, note: String::new() }
}

/// One row per trial.
#[must_use]
pub fn each_trial(trials: &[&JudgedTrial]) -> Section {
    let mut table = summary_table(&["trial", "person", "kind", "data", "stances"]);
    for trial in trials {
        let words = [&trial.name, &trial.person, &trial.kind].map(String::clone);
        let head = words.into_iter().chain([trial.quality.word().to_owned(), trial.stances.len().to_string()]);
        table.row(head.chain(summary_cells(|figure| figure.of(&trial.agreement))));
    }
    let note = "Data: whether recording, body and measured forces fit together (`quality` in docs/JUDGEMENT.md); \
        errors of doubtful and bad data may be those of the data.";
    Section { title: "Each trial", table, note: note.to_owned() }
}

/// Share of the samples inside the 90 % band in each fifth of the stance.
#[must_use]
pub fn share_by_fifth(trials: &[&JudgedTrial]) -> Section {
    let table = by_fifth(trials, 0, |force| 100.0 * force.band.holds);
    Section { title: "Share inside the 90 % band in each fifth of the stance [%]", table, note: String::new() }
}

/// RMSE in each fifth of the stance.
#[must_use]
pub fn rmse_by_fifth(trials: &[&JudgedTrial]) -> Section {
    let table = by_fifth(trials, 2, |force| 100.0 * force.rmse_bw);
    Section { title: "RMSE in each fifth of the stance [% of body weight]", table, note: String::new() }
}

/// A figure of each fifth: means over stances, then trials, then persons.
fn by_fifth(trials: &[&JudgedTrial], digits: usize, of: impl Fn(&ForceAgreement) -> f64) -> TextTable {
    let mut table = TextTable::new(&["kind", "component", "1st", "2nd", "3rd", "4th", "5th"]);
    for kind in kinds(trials) {
        for component in Component::ALL {
            let cells = [0, 1, 2, 3, 4].map(|fifth| {
                let of_trial = |trial: &JudgedTrial| in_fifth(trial, component, fifth, &of);
                number(over_kind(trials, kind, of_trial), digits)
            });
            table.row([kind.to_owned(), component.word().to_owned()].into_iter().chain(cells));
        }
    }
    table
}

/// A figure of a fifth of the stances of a trial: the mean over its stances.
fn in_fifth(trial: &JudgedTrial, component: Component, fifth: usize, of: impl Fn(&ForceAgreement) -> f64) -> f64 {
    let parts = trial.stances.iter().filter_map(|stance| stance.fifth(fifth).agreement(trial.weight_n));
    finite_mean(parts.map(|foot| of(&component.of(&foot))))
}

fn each_foot<'a>(trials: &[&'a JudgedTrial]) -> impl Iterator<Item = (&'a JudgedTrial, &'a FootAgreement)> {
    trials.iter().flat_map(|trial| trial.agreement.feet.iter().map(move |foot| (*trial, foot)))
}

/// Forces of each foot.
#[must_use]
pub fn forces(trials: &[&JudgedTrial]) -> Section {
    let mut table = TextTable::new(&[
        "trial",
        "kind",
        "foot",
        "stances",
        "component",
        "RMSE %BW",
        "rRMSE %",
        "r",
        "in band %",
        "band/RMSE",
    ]);
    for (trial, foot) in each_foot(trials) {
        for component in Component::ALL {
            let force = component.of(foot);
            table.row([
                trial.name.clone(),
                trial.kind.clone(),
                foot.side.letter().to_owned(),
                foot.stances_s.len().to_string(),
                component.word().to_owned(),
                number(100.0 * force.rmse_bw, 2),
                number(100.0 * force.rrmse, 1),
                number(force.r, 3),
                number(100.0 * force.band.holds, 1),
                number(force.band.half_width_over_rmse, 2),
            ]);
        }
    }
    Section { title: "Forces of each foot", table, note: String::new() }
}

/// Centres of pressure of each foot.
#[must_use]
pub fn centers(trials: &[&JudgedTrial]) -> Section {
    let mut table = TextTable::new(&[
        "trial",
        "foot",
        "fore-aft mm",
        "fore-aft weighted",
        "lateral mm",
        "lateral weighted",
        "samples",
        "without",
    ]);
    for (trial, foot) in each_foot(trials) {
        let center = &foot.center_of_pressure;
        table.row([
            trial.name.clone(),
            foot.side.letter().to_owned(),
            number(center.fore_aft_mm, 1),
            number(center.fore_aft_weighted_mm, 1),
            number(center.lateral_mm, 1),
            number(center.lateral_weighted_mm, 1),
            center.samples.to_string(),
            center.missing.to_string(),
        ]);
    }
    Section { title: "Centres of pressure", table, note: String::new() }
}

/// Sagittal moments of each leg.
#[must_use]
pub fn moments(trials: &[&JudgedTrial]) -> Section {
    let mut table = TextTable::new(&["trial", "leg", "hip", "r", "knee", "r", "ankle", "r"]);
    for trial in trials {
        for side in Side::BOTH {
            let found = LegJoint::ALL.map(|joint| {
                let own = trial.agreement.moments.iter().find(|moment| moment.side == side && joint.has(moment));
                own.map_or([f64::NAN; 2], |moment| [moment.rmse_nm_kg, moment.r])
            });
            if found.iter().any(|[rmse, _]| rmse.is_finite()) {
                let head = [trial.name.clone(), side.letter().to_owned()];
                table.row(head.into_iter().chain(found.into_iter().flatten().map(|x| number(x, 3))));
            }
        }
    }
    Section { title: "Sagittal moments: RMSE [N.m/kg], r", table, note: String::new() }
}

/// Foot strikes and foot offs of each trial.
#[must_use]
pub fn events(trials: &[&JudgedTrial]) -> Section {
    let mut table = TextTable::new(&["trial", "event", "pairs", "missed", "extra", "mean error ms", "bias ms"]);
    for trial in trials {
        for event in &trial.agreement.events {
            table.row([
                trial.name.clone(),
                event.kind.word().to_owned(),
                event.pairs.to_string(),
                event.missed.to_string(),
                event.extra.to_string(),
                number(event.mean_absolute_ms, 1),
                number(event.bias_ms, 1),
            ]);
        }
    }
    Section { title: "Foot strikes and foot offs", table, note: String::new() }
}
