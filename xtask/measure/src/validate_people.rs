//! Errors of the predicted ground forces by kind of person, kind of movement and laboratory:
//! `cargo xtask validate-people [--each] [--write]`; `--each` prints every trial as well.
//!
//! Every recording of the development data is processed as by `ambulo forces --predict`, with parameters of the
//! estimator that are fitted here without the laboratory of the recording. Means are over feet, then trials, then
//! persons, then laboratories: a laboratory counts once, however many people it recorded. The page has no figure of a
//! single person of data that may only be used for fitting and testing.

use crate::fit_ground;
use crate::validate::recording::{self, Group, Population, Recording};
use crate::workspace;
use ambulo::analysis::GroundAgreement;
use ambulo::findings::Findings;
use ambulo::ground::predict::FittedParameters;
use ambulo::numerics;
use ambulo::study::validation::baselines::Baseline;
use ambulo::study::validation::{Component, Figure, JudgedTrial, LegJoint, Method, NotJudged, TextTable as Table};
use std::path::Path;

/// The page, relative to the workspace root.
const PAGE: &str = "docs/measured/PEOPLE.md";

/// The kinds of movement, in the order of tables.
const GROUPS: [Group; 6] =
    [Group::Walking, Group::FastWalking, Group::NoTrunk, Group::Turning, Group::Running, Group::Jumping];

/// Figures of the tables, with the head of the column and the digits.
const FIGURES: [(&str, Figure, usize); 17] = [
    ("up RMSE [%BW]", Figure::Rmse(Component::Vertical), 2),
    ("r", Figure::Correlation(Component::Vertical), 3),
    ("fore-aft RMSE [%BW]", Figure::Rmse(Component::ForeAft), 2),
    ("r", Figure::Correlation(Component::ForeAft), 3),
    ("lateral RMSE [%BW]", Figure::Rmse(Component::Lateral), 2),
    ("r", Figure::Correlation(Component::Lateral), 3),
    ("CoP along [mm]", Figure::CenterAlong, 1),
    ("across [mm]", Figure::CenterAcross, 1),
    ("hip [N.m/kg]", Figure::Moment(LegJoint::Hip), 3),
    ("knee", Figure::Moment(LegJoint::Knee), 3),
    ("ankle", Figure::Moment(LegJoint::Ankle), 3),
    ("in band up [%]", Figure::InBand(Component::Vertical), 0),
    ("fore-aft", Figure::InBand(Component::ForeAft), 0),
    ("lateral", Figure::InBand(Component::Lateral), 0),
    ("band/RMSE up", Figure::BandWidth(Component::Vertical), 2),
    ("fore-aft", Figure::BandWidth(Component::ForeAft), 2),
    ("lateral", Figure::BandWidth(Component::Lateral), 2),
];

/// A recording that was judged.
struct Judged {
    recording: Recording,
    /// The recognised activity.
    activity: &'static str,
    /// Of the recorded motion; not a number where it is not known [Hz].
    bandwidth_hz: f64,
    trial: JudgedTrial,
}

/// Runs the command.
#[expect(clippy::print_stdout, reason = "the page is the command's result")]
pub(crate) fn run(words: &[String]) -> Result<(), String> {
    let (each, words): (Vec<String>, Vec<String>) = words.iter().cloned().partition(|word| word == "--each");
    let write = workspace::write_option(&words)?;
    let data = workspace::data().join("data");
    if !data.is_dir() {
        println!("skipped: no data");
        return Ok(());
    }
    let fits = fit_ground::laboratories_left_out(&data)?;
    let (mut judged, mut not_judged) = (Vec::new(), Vec::new());
    for recording in recording::all().into_iter().chain(recording::further()) {
        let fit = fits.iter().find(|(laboratory, _)| *laboratory == recording.laboratory);
        let parameters = fit.map_or_else(FittedParameters::default, |(_, parameters)| *parameters);
        match judge(recording, parameters, &data).map_err(|e| format!("{}: {e}", recording.label))? {
            Ok(one) => judged.push(one),
            Err(reason) => not_judged.push((recording, reason)),
        }
    }
    let page = page(&judged, &not_judged);
    println!("{page}");
    if !each.is_empty() {
        println!("{}", each_trial(&judged));
    }
    if write {
        workspace::save(PAGE, &page)?;
    }
    Ok(())
}

/// An error, or why plates cannot judge the trial.
fn judge(recording: Recording, parameters: FittedParameters, data: &Path) -> Result<Result<Judged, NotJudged>, String> {
    let source = recording.read(data)?;
    let outcome = recording.predict_with(&source, parameters)?;
    let found = outcome.prediction.as_ref().and_then(|found| found.prediction.motion_bandwidth_hz);
    let trial = JudgedTrial::of(recording.label, recording.subject, &outcome, &Findings::default());
    Ok(trial.map(|trial| Judged {
        recording,
        activity: outcome.activity.kind.words(),
        bandwidth_hz: found.unwrap_or(f64::NAN),
        trial,
    }))
}

fn page(judged: &[Judged], not_judged: &[(Recording, NotJudged)]) -> String {
    let all: Vec<&Judged> = judged.iter().collect();
    format!(
        "# Predicted ground forces by kind of person and laboratory\n\n\
         Forces are predicted from motion alone and compared with force plates, as `ambulo validate` compares them. \
         Everybody is predicted with parameters that were fitted without the own laboratory \
         ([GROUND_FIT.md](GROUND_FIT.md) describes the fit): these are the errors of strangers. Means: feet, then \
         trials, then persons, then \
         laboratories, each laboratory with the same weight. Children: children and adolescents; in a laboratory that \
         recorded children and adults, those below 45 kg. The publishers of the Rehazenter set low-passed its markers \
         at about 6 Hz. Plates of the runners of UFABC are wrong sideways.\n\n\
         ## Strangers: the own laboratory left out of the fit\n\n{}\n\
         ## The same, by laboratory\n\n{}\n\
         ## Bandwidth of the recorded motion\n\n\
         The frequency below which 99 % of the acceleration of the feet lies (`motion_bandwidth` of the summary), 20 \
         Hz and more counted as 20. Raw markers have a noise floor up to half of the frame rate; where it is missing, \
         the markers were low-passed before publication.\n\n{}\n\
         ## Running: the prediction and Newton's law alone\n\n{}\n\
         ## Recognised activities\n\n{}\n\
         ## Trials that plates cannot judge\n\n{}",
        by_kind(&all),
        by_laboratory(&all),
        bandwidths(judged),
        running(&all),
        activities(&all),
        unjudged(not_judged)
    )
}

/// The head of a table of figures.
fn table(first: &[&str]) -> Table {
    Table::new(&first.iter().copied().chain(FIGURES.iter().map(|figure| figure.0)).collect::<Vec<_>>())
}

fn cells(of: impl Fn(Figure) -> f64) -> impl Iterator<Item = String> {
    FIGURES.into_iter().map(move |(_, figure, digits)| number(of(figure), digits))
}

fn number(x: f64, digits: usize) -> String {
    if x.is_finite() { format!("{x:.digits$}") } else { "-".to_owned() }
}

fn by_kind(judged: &[&Judged]) -> String {
    let mut table = table(&["people", "movement", "laboratories", "persons", "trials"]);
    for (population, group) in Population::ALL.into_iter().flat_map(|of| GROUPS.map(|group| (of, group))) {
        let own: Vec<&Judged> = chosen(judged, |r| r.population == population && r.group == group);
        if own.is_empty() {
            continue;
        }
        let laboratories = names(&own, |recording| recording.laboratory);
        let counts = [laboratories.len(), names(&own, |recording| recording.subject).len(), own.len()];
        let first = [population.word().to_owned(), group.word().to_owned()];
        let mean = |figure: Figure| over_laboratories(&own, |one| figure.of(&one.trial.agreement));
        table.row(first.into_iter().chain(counts.map(|count| count.to_string())).chain(cells(mean)));
    }
    table.text()
}

fn by_laboratory(judged: &[&Judged]) -> String {
    let mut table = table(&["laboratory", "people", "movement", "persons", "trials"]);
    for laboratory in names(judged, |recording| recording.laboratory) {
        for (population, group) in Population::ALL.into_iter().flat_map(|of| GROUPS.map(|group| (of, group))) {
            let is_own = |r: &Recording| (r.laboratory, r.population, r.group) == (laboratory, population, group);
            let own: Vec<&Judged> = chosen(judged, is_own);
            if own.is_empty() {
                continue;
            }
            let first = [laboratory, population.word(), group.word()].map(str::to_owned);
            let counts = [names(&own, |recording| recording.subject).len(), own.len()].map(|count| count.to_string());
            let mean = |figure: Figure| over_laboratories(&own, |one| figure.of(&one.trial.agreement));
            table.row(first.into_iter().chain(counts).chain(cells(mean)));
        }
    }
    table.text()
}

fn bandwidths(judged: &[Judged]) -> String {
    let all: Vec<&Judged> = judged.iter().filter(|one| one.bandwidth_hz.is_finite()).collect();
    let mut table = Table::new(&["laboratory", "trials", "least [Hz]", "median", "most"]);
    for laboratory in names(&all, |recording| recording.laboratory) {
        let own = chosen(&all, |recording| recording.laboratory == laboratory);
        let mut found: Vec<f64> = own.iter().map(|one| one.bandwidth_hz).collect();
        found.sort_by(f64::total_cmp);
        let three = [found[0], found[found.len() / 2], found[found.len() - 1]].map(|x| number(x, 1));
        table.row([laboratory.to_owned(), found.len().to_string()].into_iter().chain(three));
    }
    table.text()
}

/// Running trials of a laboratory, by speed where labels have one.
fn running(judged: &[&Judged]) -> String {
    let law = Method::Baseline(Baseline::SmoothTransition);
    let mut table = Table::new(&[
        "laboratory",
        "speed [m/s]",
        "trials",
        "up RMSE [%BW]",
        "Newton's law at 6 Hz",
        "trials above the law",
    ]);
    let up = |agreement: &GroundAgreement| Figure::Rmse(Component::Vertical).of(agreement);
    let runs = chosen(judged, |recording| recording.group == Group::Running);
    let speed = |one: &Judged| one.recording.label.split_once(' ').map_or("-", |(_, speed)| speed);
    let mut rows: Vec<(&str, &str)> = runs.iter().map(|one| (one.recording.laboratory, speed(one))).collect();
    rows.sort_unstable();
    rows.dedup();
    for row in rows {
        let own: Vec<&&Judged> = runs.iter().filter(|one| (one.recording.laboratory, speed(one)) == row).collect();
        let found = own.iter().map(|one| up(&one.trial.agreement));
        let of_law = |one: &Judged| one.trial.of_method(law).map_or(f64::NAN, up);
        let above = own.iter().filter(|one| up(&one.trial.agreement) > of_law(one)).count();
        table.row([
            row.0.to_owned(),
            row.1.to_owned(),
            own.len().to_string(),
            number(mean(found), 1),
            number(mean(own.iter().map(|one| of_law(one))), 1),
            above.to_string(),
        ]);
    }
    table.text()
}

fn activities(judged: &[&Judged]) -> String {
    let mut table = Table::new(&["movement", "recognised as", "trials"]);
    for group in GROUPS {
        let own = chosen(judged, |recording| recording.group == group);
        let mut words: Vec<&str> = own.iter().map(|one| one.activity).collect();
        words.sort_unstable();
        words.dedup();
        for word in words {
            let count = own.iter().filter(|one| one.activity == word).count();
            table.row([group.word().to_owned(), word.to_owned(), count.to_string()]);
        }
    }
    table.text()
}

fn unjudged(trials: &[(Recording, NotJudged)]) -> String {
    let mut table = Table::new(&["laboratory", "movement", "reason", "trials"]);
    let mut rows: Vec<[String; 3]> = trials
        .iter()
        .map(|(r, reason)| [r.laboratory.to_owned(), r.group.word().to_owned(), reason.to_string()])
        .collect();
    rows.sort();
    rows.chunk_by(|a, b| a == b)
        .for_each(|same| table.row(same[0].clone().into_iter().chain([same.len().to_string()])));
    table.text()
}

fn each_trial(judged: &[Judged]) -> String {
    let mut table = table(&["trial", "activity", "speed [m/s]", "mass [kg]"]);
    for one in judged {
        let first = [one.recording.label.to_owned(), one.activity.to_owned()];
        let size = [one.trial.speed_m_s.unwrap_or(f64::NAN), one.trial.mass.kg].map(|x| number(x, 2));
        table.row(first.into_iter().chain(size).chain(cells(|figure| figure.of(&one.trial.agreement))));
    }
    table.text()
}

fn chosen<'a>(judged: &[&'a Judged], is_chosen: impl Fn(&Recording) -> bool) -> Vec<&'a Judged> {
    judged.iter().copied().filter(|one| is_chosen(&one.recording)).collect()
}

/// Names, each once, in their order.
fn names(judged: &[&Judged], name: impl Fn(&Recording) -> &'static str) -> Vec<&'static str> {
    let mut names: Vec<&str> = Vec::new();
    for one in judged.iter().map(|one| name(&one.recording)) {
        if !names.contains(&one) {
            names.push(one);
        }
    }
    names
}

/// The mean over trials, then persons, then laboratories.
fn over_laboratories(judged: &[&Judged], of: impl Fn(&Judged) -> f64) -> f64 {
    let of_person = |subject: &str| {
        mean(judged.iter().filter(|one| one.recording.subject == subject).map(|one| of(one)).filter(|x| x.is_finite()))
    };
    let of_laboratory = |laboratory: &str| {
        let own = chosen(judged, |recording| recording.laboratory == laboratory);
        mean(names(&own, |recording| recording.subject).into_iter().map(of_person).filter(|x| x.is_finite()))
    };
    let laboratories = names(judged, |recording| recording.laboratory);
    mean(laboratories.into_iter().map(of_laboratory).filter(|x| x.is_finite()))
}

/// NaN without numbers.
fn mean(values: impl Iterator<Item = f64>) -> f64 {
    let values: Vec<f64> = values.collect();
    if values.is_empty() { f64::NAN } else { numerics::mean(&values) }
}
