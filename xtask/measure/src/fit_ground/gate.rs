//! Errors by kind of people and movement, with the laboratory left out, against those of the last version.
//!
//! A version that makes walking adults, walking children or runners worse by more than 2 % does not replace the last
//! one; the other groups are shown. Errors of the last version are in `last_version.csv`;
//! `cargo xtask fit-ground --keep` writes those of this one there.

use super::cases::{Case, mean, named};
use crate::validate::recording::{Group, Population};
use crate::workspace;
use ambulo::analysis::FootAgreement;
use ambulo::ground::predict::FittedParameters;
use ambulo::study::validation::TextTable as Table;
use std::fs;

/// Errors of a group: upward, forward and sideways [% body weight].
#[derive(Debug, Clone, PartialEq)]
pub(super) struct GroupErrors {
    pub(super) name: String,
    pub(super) laboratories: usize,
    pub(super) errors: [f64; 3],
}

/// The groups of people, each with its kind of movement.
const GROUPS: [(Population, Group, &str); 7] = [
    (Population::Adult, Group::Walking, "adults, walking"),
    (Population::Adult, Group::FastWalking, "adults, fast walking"),
    (Population::Adult, Group::NoTrunk, "adults, walking, no trunk markers"),
    (Population::Child, Group::Walking, "children, walking"),
    (Population::Child, Group::Turning, "children, turning"),
    (Population::Patient, Group::Walking, "patients, walking"),
    (Population::Runner, Group::Running, "runners, running"),
];

/// Means over feet, then trials, then people, then laboratories; every case is predicted with the parameters that `of`
/// gives.
pub(super) fn by_group<'a>(
    cases: impl Iterator<Item = &'a Case>,
    of: &dyn Fn(&str) -> Option<&'a FittedParameters>,
) -> Vec<GroupErrors> {
    let found: Vec<(&Case, [f64; 3])> =
        cases.filter_map(|case| Some((case, errors(case, of(case.laboratory)?)?))).collect();
    let of_group = |(population, group, name): &(Population, Group, &str)| {
        let own: Vec<_> =
            found.iter().filter(|(case, _)| (case.population, case.group) == (*population, *group)).collect();
        let laboratories = named(own.iter().map(|(case, _)| case.laboratory));
        let axis = |k: usize| {
            mean(laboratories.iter().map(|laboratory| {
                let people =
                    named(own.iter().filter(|(case, _)| case.laboratory == *laboratory).map(|(case, _)| case.subject));
                let person = |name: &&str| {
                    mean(own.iter().filter(|(case, _)| case.subject == *name).map(|(_, errors)| errors[k]))
                };
                mean(people.iter().map(person))
            }))
        };
        let errors = [0, 1, 2].map(axis);
        GroupErrors { name: (*name).to_owned(), laboratories: laboratories.len(), errors }
    };
    GROUPS.iter().map(of_group).filter(|group| group.laboratories > 0).collect()
}

fn errors(case: &Case, parameters: &FittedParameters) -> Option<[f64; 3]> {
    let agreement = case.agreement(parameters)?;
    let of = |force: fn(&FootAgreement) -> f64| mean(agreement.feet.iter().map(|foot| 100.0 * force(foot)));
    (!agreement.feet.is_empty())
        .then(|| [of(|foot| foot.vertical.rmse_bw), of(|foot| foot.fore_aft.rmse_bw), of(|foot| foot.lateral.rmse_bw)])
}

/// The last version, relative to the workspace root: a line of comment, then group, up, forward, sideways.
const FILE: &str = "xtask/measure/src/fit_ground/last_version.csv";
const HEAD: &str =
    "# Made by `cargo xtask fit-ground --keep`: group, errors up, forward, sideways [%BW], laboratory left out.\n";
/// A group may get worse by this share.
const WORSE: f64 = 0.02;

/// Writes the errors of this version, with which the next one is compared.
pub(super) fn keep(groups: &[GroupErrors]) -> Result<(), String> {
    let path = workspace::root().join(FILE);
    let line = |group: &GroupErrors| {
        let [up, forward, sideways] = group.errors;
        format!("{};{up:.3};{forward:.3};{sideways:.3}\n", group.name)
    };
    let text = format!("{HEAD}{}", groups.iter().map(line).collect::<String>());
    fs::write(&path, text).map_err(|e| format!("{}: cannot write: {e}", path.display()))
}

/// Errors of a group in the last version.
fn last(text: &str, name: &str) -> Option<[f64; 3]> {
    let line = text.lines().find(|line| line.split(';').next() == Some(name))?;
    let numbers: Vec<f64> = line.split(';').skip(1).filter_map(|number| number.parse().ok()).collect();
    numbers.try_into().ok()
}

/// Whether a group may have these errors.
fn passes(now: [f64; 3], last: [f64; 3]) -> bool {
    now.iter().zip(last).all(|(now, last)| *now <= (1.0 + WORSE) * last)
}

/// Errors of each group with their change against the last version.
pub(super) fn table(groups: &[GroupErrors]) -> String {
    let text = fs::read_to_string(workspace::root().join(FILE)).unwrap_or_default();
    let mut table = Table::new(&[
        "group",
        "laboratories",
        "up RMSE [%BW]",
        "change [%]",
        "forward",
        "change [%]",
        "sideways",
        "change [%]",
        "gate",
    ]);
    for group in groups {
        let last = last(&text, &group.name);
        let change =
            |k: usize| last.map_or("-".to_owned(), |last| format!("{:+.1}", 100.0 * (group.errors[k] / last[k] - 1.0)));
        let of_axis = |k: usize| [format!("{:.2}", group.errors[k]), change(k)];
        let gate = match last {
            None => "new",
            Some(last) if passes(group.errors, last) => "passed",
            Some(_) => "worse",
        };
        let first = [group.name.clone(), group.laboratories.to_string()];
        table.row(first.into_iter().chain((0..3).flat_map(of_axis)).chain([gate.to_owned()]));
    }
    table.text()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_version_has_every_group_and_a_worse_component_does_not_pass() {
        for (.., name) in GROUPS {
            assert!(last(include_str!("last_version.csv"), name).is_some(), "{name}");
        }
        assert!(passes([5.0, 2.0, 1.0], [4.95, 2.0, 1.1]) && !passes([5.0, 2.05, 1.0], [6.0, 2.0, 2.0]));
    }
}
