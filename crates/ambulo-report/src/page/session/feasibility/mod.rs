//! The verdict: whether a person could do this motion, and which limits it exceeds, when and where.

pub(crate) mod basis;

pub(super) use basis::Basis;

use super::cells::{Column, listed, name, number, table, text, unit};
use super::{sides, words};
use crate::clinical::ClinicalQuantity;
use crate::page::contract::{Feasibility, Group, RedSpan, Table};
use ambulo::analysis::feasibility::{Check, Closest, Reason, Verdict, VerdictState};

/// Panels of the checks that do not belong to a coordinate.
const PANELS: [(Check, &str); 5] = [
    (Check::Friction, super::quality::FRICTION),
    (Check::CenterOfPressure, super::quality::CENTER_FORWARD),
    (Check::Flight, "ground_force_vertical"),
    (Check::Support, super::quality::RESIDUAL_FORCE),
    (Check::Balance, super::quality::RESIDUAL_MOMENT),
];

/// Column of the quantity in the table of limits.
pub(super) const QUANTITY: usize = 1;

/// The verdict as shown; `None` if nothing was judged, or too little for a verdict on the whole motion.
pub(super) fn feasibility(verdict: &Verdict, basis: &Basis, quantities: &[ClinicalQuantity]) -> Option<Feasibility> {
    let state = Some(verdict.state).filter(|state| *state == VerdictState::Infeasible || !basis.no_ground)?;
    let red: Vec<RedSpan> = verdict.reasons.iter().map(|reason| span(reason, quantities)).collect();
    Some(Feasibility {
        state: state.into(),
        sentence: sentence(verdict, basis),
        closest: closest(verdict, quantities),
        red,
    })
}

/// Why there is no verdict although checks were made, and how near they come to their limits.
pub(super) fn partly_judged(
    verdict: &Verdict,
    basis: &Basis,
    quantities: &[ClinicalQuantity],
) -> Option<(String, Table)> {
    let passed = verdict.state != VerdictState::Infeasible && basis.no_ground;
    passed.then(|| {
        let sentence = format!("{} All checks that could be made passed.", without_ground(verdict));
        (format!("No verdict: {sentence}"), closest(verdict, quantities))
    })
}

/// Which checks were made without ground forces.
fn without_ground(verdict: &Verdict) -> String {
    let made = |(check, _): &(Check, &str)| verdict.closest.iter().any(|entry| entry.check == *check);
    let checks = [
        (Check::Range, "ranges of motion"),
        (Check::Strength, "moments of limbs in the air"),
        (Check::Power, "powers"),
    ];
    let made: Vec<&str> = checks.into_iter().filter(made).map(|(_, plural)| plural).collect();
    match made.split_last() {
        None => "without ground forces nothing could be checked.".to_owned(),
        Some((one, [])) => format!("without ground forces only {one} could be checked."),
        Some((last, others)) => {
            format!("without ground forces only {} and {last} could be checked.", others.join(", "))
        }
    }
}

/// The sentence of the verdict, and what no person would do in a walk.
fn sentence(verdict: &Verdict, basis: &Basis) -> String {
    let unlike = verdict.unlike_people();
    let unlike: Vec<String> = unlike.iter().map(|found| format!(" Unlike people: {}.", found.message)).collect();
    judged(verdict, basis) + &unlike.concat()
}

fn judged(verdict: &Verdict, basis: &Basis) -> String {
    let person = format!("person of {:.1} kg and {:.2} m", verdict.mass_kg, verdict.height_m);
    let limits = basis.limits();
    match (verdict.state, &limits) {
        (VerdictState::Infeasible, _) => {}
        (VerdictState::NotJudged, _) => {
            let why = verdict.undecided.join("; ");
            return format!("Not judged for a {person}: {why}. All checks that could be made passed.");
        }
        (VerdictState::Feasible, None) => {
            return format!("A {person} could do this: all checks that could be made passed.");
        }
        (VerdictState::Feasible, Some(limits)) => return format!("All checks passed for a {person}, but {limits}."),
    }
    let mut checks: Vec<String> = verdict.reasons.iter().map(|reason| in_words(reason.check)).collect();
    checks.sort_unstable();
    checks.dedup();
    let times = match verdict.reasons.len() {
        1 => "once".to_owned(),
        several => format!("{several} times"),
    };
    let exceeded = format!("A {person} could not do this: limits are exceeded {times} ({}).", checks.join(", "));
    let ground = basis.no_ground.then(|| capitalised(&without_ground(verdict)));
    let rest = limits.map(|limits| format!("{}.", capitalised(&limits)));
    [Some(exceeded), ground, rest].into_iter().flatten().collect::<Vec<_>>().join(" ")
}

fn capitalised(sentence: &str) -> String {
    let mut letters = sentence.chars();
    letters.next().map(|first| first.to_uppercase().chain(letters).collect()).unwrap_or_default()
}

/// The name of a check with blanks: `center of pressure`.
fn in_words(check: Check) -> String {
    check.name().replace('_', " ")
}

fn span(reason: &Reason, quantities: &[ClinicalQuantity]) -> RedSpan {
    RedSpan {
        from_s: reason.time_s[0],
        to_s: reason.time_s[1],
        side: reason.side.map(sides::page),
        check: reason.check.name().to_owned(),
        sentence: reason.message.clone(),
        panel: panel(reason.check, &reason.quantity, quantities),
    }
}

/// The panel that shows a quantity of a verdict.
fn panel(check: Check, quantity: &str, quantities: &[ClinicalQuantity]) -> Option<String> {
    if let Some((_, panel)) = PANELS.iter().find(|(known, _)| *known == check) {
        return Some((*panel).to_owned());
    }
    let of_coordinate = matches!(check, Check::Strength | Check::Power | Check::Range);
    let (shown, _) = of_coordinate.then(|| words::known(quantity, quantities)).flatten()?;
    Some(shown.id.to_owned())
}

const CLOSEST: [Column<Closest>; 7] = [
    ("Check", |entry| name(entry.check.name())),
    ("Quantity", |entry| text(&entry.quantity)),
    ("Time [s]", |entry| number(Some(entry.at_s), 2, None)),
    ("Value", |entry| number(Some(entry.value), 3, None)),
    ("Limit", |entry| number(Some(entry.limit), 3, None)),
    ("Unit", |entry| unit(&entry.unit)),
    ("Used [%]", |entry| number(Some(100.0 * entry.share), 0, Some([f64::NEG_INFINITY, 100.0]))),
];

fn closest(verdict: &Verdict, quantities: &[ClinicalQuantity]) -> Table {
    let not_judged: Vec<String> =
        verdict.not_judged.iter().map(|left| format!("{}: {}", in_words(left.check), left.why)).collect();
    let note = match not_judged.is_empty() {
        true => "How near each check comes to its limit.".to_owned(),
        false => format!("How near each check comes to its limit. Not judged: {}.", not_judged.join("; ")),
    };
    let Some(mut closest) = listed(closest_head(&note), &verdict.closest, &CLOSEST) else { return no_checks() };
    words::reword(&mut closest, QUANTITY, quantities);
    closest
}

fn closest_head(note: &str) -> [&str; 3] {
    ["closest", "Closest to the limits", note]
}

/// The table if no check could be made.
pub(super) fn no_checks() -> Table {
    let head = closest_head("How near each check comes to its limit.");
    Table { empty: Some("No check could be made.".to_owned()), ..table(head, Vec::new(), Vec::new()) }
}

/// Adds each span to its panel; clears the panel of spans whose panel does not exist.
pub(super) fn mark(groups: &mut [&mut Vec<Group>], red: &mut [RedSpan]) {
    let panels = || groups.iter().flat_map(|groups| groups.iter()).flat_map(|group| &group.panels);
    for span in red.iter_mut() {
        span.panel = span.panel.take().filter(|id| panels().any(|panel| panel.id == *id));
    }
    for panel in groups.iter_mut().flat_map(|groups| groups.iter_mut()).flat_map(|group| &mut group.panels) {
        panel.red = red.iter().filter(|span| span.panel.as_ref() == Some(&panel.id)).cloned().collect();
    }
}
