//! What a calibration on one trial of a person changes in the other trials of that person.

use super::recording::{Group, Recording};
use ambulo::analysis::GroundAgreement;
use ambulo::ground::predict::{PersonalErrors, Prescribed};
use ambulo::numerics::finite_mean;
use ambulo::study::validation::TextTable as Table;
use ambulo::study::validation::{Component, Figure, LegJoint, number};
use ambulo::study::{Outcome, Source, personal_errors};
use std::path::Path;

/// The figures of the table, with their headings and digits.
const COLUMNS: [(&str, Figure, usize); 7] = [
    ("vertical %BW", Figure::Rmse(Component::Vertical), 2),
    ("fore-aft %BW", Figure::Rmse(Component::ForeAft), 2),
    ("lateral %BW", Figure::Rmse(Component::Lateral), 2),
    ("CoP fore-aft mm", Figure::CenterAlong, 1),
    ("hip N.m/kg", Figure::Moment(LegJoint::Hip), 3),
    ("knee", Figure::Moment(LegJoint::Knee), 3),
    ("ankle", Figure::Moment(LegJoint::Ankle), 3),
];

/// Agreement without and with a calibration, for a person and a kind of pair.
pub(super) struct Calibrated {
    subject: &'static str,
    /// Of the trial that calibrates and of the trial that is judged.
    groups: [Group; 2],
    agreements: Vec<[GroundAgreement; 2]>,
}

/// Every pair of trials of a person of which the first one is a walk on a straight line.
pub(super) fn calibrated(recordings: &[Recording], data: &Path) -> Result<Vec<Calibrated>, String> {
    let mut all: Vec<Calibrated> = Vec::new();
    for first in recordings.iter().filter(|r| matches!(r.group, Group::Walking | Group::FastWalking)) {
        let others: Vec<&Recording> =
            recordings.iter().filter(|r| r.subject == first.subject && r.label != first.label).collect();
        // Two files of one recording are not two trials.
        if others.is_empty() || !first.is_of_a_person() {
            continue;
        }
        let person = personal(&first.predict(&first.read(data)?, Prescribed::default())?)?;
        for other in others {
            let groups = [first.group, other.group];
            let source = other.read(data)?;
            let Some(pair) = compared(other, &source, &person)? else { continue };
            match all.iter_mut().find(|one| one.subject == first.subject && one.groups == groups) {
                Some(one) => one.agreements.push(pair),
                None => all.push(Calibrated { subject: first.subject, groups, agreements: vec![pair] }),
            }
        }
    }
    Ok(all)
}

fn personal(outcome: &Outcome) -> Result<PersonalErrors, String> {
    personal_errors(std::slice::from_ref(outcome)).map_err(|e| e.to_string())
}

/// Agreement of a trial without and with a calibration.
fn compared(
    recording: &Recording,
    source: &Source,
    person: &PersonalErrors,
) -> Result<Option<[GroundAgreement; 2]>, String> {
    let agreement =
        |outcome: Outcome| outcome.prediction.and_then(|found| found.agreement).filter(|found| !found.feet.is_empty());
    let without = agreement(recording.predict(source, Prescribed::default())?);
    let with = agreement(recording.predict_person(source, Some(person.clone()))?);
    Ok(without.zip(with).map(|(without, with)| [without, with]))
}

/// The section of the page.
pub(super) fn section(all: &[Calibrated]) -> String {
    let head = ["person", "calibrated on", "judged on", "pairs", "calibration"].into_iter();
    let mut table = Table::new(&head.chain(COLUMNS.iter().map(|(name, ..)| *name)).collect::<Vec<_>>());
    let figures = |of: &Calibrated, with: usize| {
        COLUMNS.map(|(_, figure, _)| finite_mean(of.agreements.iter().map(|pair| figure.of(&pair[with]))))
    };
    let mut row = |head: [String; 4], word: &str, values: [f64; 7], digits: Option<usize>| {
        let cells = COLUMNS.iter().zip(values).map(|((.., own), value)| number(value, digits.unwrap_or(*own)));
        table.row(head.into_iter().chain([word.to_owned()]).chain(cells));
    };
    let mut kinds: Vec<[Group; 2]> = Vec::new();
    for one in all {
        let head = || {
            let [first, other] = one.groups.map(|group| group.word().to_owned());
            [one.subject.to_owned(), first, other, one.agreements.len().to_string()]
        };
        row(head(), "without", figures(one, 0), None);
        row(head(), "with", figures(one, 1), None);
        if !kinds.contains(&one.groups) {
            kinds.push(one.groups);
        }
    }
    for groups in kinds {
        let own: Vec<&Calibrated> = all.iter().filter(|one| one.groups == groups).collect();
        let pairs: usize = own.iter().map(|one| one.agreements.len()).sum();
        let over = |with: usize| -> [f64; 7] {
            std::array::from_fn(|k| finite_mean(own.iter().map(|one| figures(one, with)[k])))
        };
        let change = std::array::from_fn(|k| 100.0 * (over(1)[k] / over(0)[k] - 1.0));
        let head = || {
            let [first, other] = groups.map(|group| group.word().to_owned());
            [format!("mean of {}", own.len()), first, other, pairs.to_string()]
        };
        row(head(), "without", over(0), None);
        row(head(), "with", over(1), None);
        row(head(), "change %", change, Some(0));
    }
    format!(
        "{}\nOne trial calibrates (`ambulo calibrate`), another one of the same person is judged (`ambulo forces \
         --person`). Means over pairs, then over people.\n",
        table.text()
    )
}
