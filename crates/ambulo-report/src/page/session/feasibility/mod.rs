//! The verdict: whether a person could do this, and what stands against it, when and where.

mod basis;

pub(super) use basis::Basis;

use super::cells::{Form, column, listed, table};
use super::{sides, words};
use crate::clinical::ClinicalQuantity;
use crate::page::contract::{Feasibility, Group, RedSpan, Table};
use serde_json::Value;

/// Panels that show what is no coordinate's, by check.
const PANELS: [(&str, &str); 5] = [
    ("friction", super::quality::FRICTION),
    ("center_of_pressure", super::quality::CENTER_FORWARD),
    ("flight", "ground_force_vertical"),
    ("support", super::quality::RESIDUAL_FORCE),
    ("balance", super::quality::RESIDUAL_MOMENT),
];

/// Place of the quantity in a row of the table of limits.
pub(super) const QUANTITY: usize = 1;

/// Of a verdict in the summary; `None` where nothing was judged, or too little of it to say anything of the whole.
pub(super) fn feasibility(verdict: &Value, basis: &Basis, quantities: &[ClinicalQuantity]) -> Option<Feasibility> {
    let feasible = verdict["feasible"].as_bool().filter(|feasible| !(*feasible && basis.no_ground))?;
    let red: Vec<RedSpan> = entries(verdict, "reasons").iter().filter_map(|reason| span(reason, quantities)).collect();
    Some(Feasibility {
        feasible,
        sentence: sentence(verdict, feasible, basis, &red),
        closest: closest(verdict, quantities),
        red,
    })
}

/// Why nothing is said of the whole though checks were made, and how near they come to their limits.
pub(super) fn partly_judged(
    verdict: &Value,
    basis: &Basis,
    quantities: &[ClinicalQuantity],
) -> Option<(String, Table)> {
    let passed = verdict["feasible"].as_bool() == Some(true) && basis.no_ground;
    passed.then(|| {
        let sentence = format!("{} Nothing of that is against the motion.", without_ground(verdict));
        (format!("No verdict: {sentence}"), closest(verdict, quantities))
    })
}

/// Which checks were made though no ground forces are known.
fn without_ground(verdict: &Value) -> String {
    let made = |check: &&str| entries(verdict, "closest").iter().any(|entry| entry["check"] == **check);
    let made: Vec<&str> = ["range", "strength", "power"].into_iter().filter(made).map(|check| plural(check)).collect();
    match made.split_last() {
        None => "without ground forces nothing was judged.".to_owned(),
        Some((one, [])) => format!("without ground forces only {one} were judged."),
        Some((last, others)) => format!("without ground forces only {} and {last} were judged.", others.join(", ")),
    }
}

fn plural(check: &str) -> &'static str {
    match check {
        "range" => "ranges of motion",
        "strength" => "moments that move the limbs in the air",
        _ => "powers",
    }
}

fn entries<'a>(verdict: &'a Value, key: &str) -> &'a [Value] {
    verdict[key].as_array().map_or(&[], Vec::as_slice)
}

fn sentence(verdict: &Value, feasible: bool, basis: &Basis, red: &[RedSpan]) -> String {
    let person = match (verdict["mass_kg"].as_f64(), verdict["height_m"].as_f64()) {
        (Some(mass), Some(height)) => format!("person of {mass:.1} kg and {height:.2} m"),
        _ => "person of this size".to_owned(),
    };
    let limits = basis.limits();
    if feasible {
        return match limits {
            None => format!("A {person} could do this: every check that was made is within its limit."),
            Some(limits) => format!("What was judged is within the limits of a {person}, but {limits}."),
        };
    }
    let mut checks: Vec<String> = red.iter().map(|span| in_words(&span.check)).collect();
    checks.sort_unstable();
    checks.dedup();
    let times = if red.len() == 1 { "1 time".to_owned() } else { format!("{} times", red.len()) };
    let said = format!("A {person} could not do this: limits are passed at {times} ({}).", checks.join(", "));
    let ground = basis.no_ground.then(|| capitalised(&without_ground(verdict)));
    let rest = limits.map(|limits| format!("{}.", capitalised(&limits)));
    [Some(said), ground, rest].into_iter().flatten().collect::<Vec<_>>().join(" ")
}

fn capitalised(sentence: &str) -> String {
    let mut letters = sentence.chars();
    letters.next().map(|first| first.to_uppercase().chain(letters).collect()).unwrap_or_default()
}

/// `center_of_pressure` as a reader has it.
fn in_words(check: &str) -> String {
    check.replace('_', " ")
}

fn span(reason: &Value, quantities: &[ClinicalQuantity]) -> Option<RedSpan> {
    let check = reason["check"].as_str()?;
    Some(RedSpan {
        from_s: reason["time_s"][0].as_f64()?,
        to_s: reason["time_s"][1].as_f64()?,
        side: sides::of_letter(reason["side"].as_str()),
        check: check.to_owned(),
        sentence: reason["message"].as_str()?.to_owned(),
        panel: panel(check, reason["quantity"].as_str().unwrap_or_default(), quantities),
    })
}

/// The panel that shows a quantity of a verdict.
fn panel(check: &str, quantity: &str, quantities: &[ClinicalQuantity]) -> Option<String> {
    if let Some((_, panel)) = PANELS.iter().find(|(known, _)| *known == check) {
        return Some((*panel).to_owned());
    }
    let coordinates = ["strength", "power", "range"];
    let (shown, _) = coordinates.contains(&check).then(|| words::known(quantity, quantities)).flatten()?;
    Some(shown.id.to_owned())
}

fn closest(verdict: &Value, quantities: &[ClinicalQuantity]) -> Table {
    let not_judged: Vec<String> = entries(verdict, "not_judged")
        .iter()
        .filter_map(|left| Some(format!("{}: {}", in_words(left["check"].as_str()?), left["why"].as_str()?)))
        .collect();
    let note = match not_judged.is_empty() {
        true => "How near every check comes to its limit.".to_owned(),
        false => format!("How near every check comes to its limit. Not judged: {}.", not_judged.join("; ")),
    };
    let head = ["closest", "Closest to the limits", note.as_str()];
    let columns = [
        column("Check", "/check", Form::Check),
        column("Quantity", "/quantity", Form::Words),
        column("Time [s]", "/at_s", Form::Number(1.0, 2)),
        column("Value", "/value", Form::Number(1.0, 3)),
        column("Limit", "/limit", Form::Number(1.0, 3)),
        column("Unit", "/unit", Form::Unit),
        column("Used [%]", "/share", Form::AtMost(100.0, 0, 100.0)),
    ];
    let mut closest = listed(head, entries(verdict, "closest"), &columns).unwrap_or_else(|| Table {
        empty: Some("No check could be made.".to_owned()),
        ..table(head, Vec::new(), Vec::new())
    });
    words::reword(&mut closest, QUANTITY, quantities);
    closest
}

/// A table of no checks.
pub(super) fn no_checks() -> Table {
    closest(&Value::Null, &[])
}

/// Gives every panel the spans that it shows; spans whose panel there is not point at none.
pub(super) fn mark(groups: &mut [&mut Vec<Group>], red: &mut [RedSpan]) {
    let panels = || groups.iter().flat_map(|groups| groups.iter()).flat_map(|group| &group.panels);
    for span in red.iter_mut() {
        span.panel = span.panel.take().filter(|id| panels().any(|panel| panel.id == *id));
    }
    for panel in groups.iter_mut().flat_map(|groups| groups.iter_mut()).flat_map(|group| &mut group.panels) {
        panel.red = red.iter().filter(|span| span.panel.as_ref() == Some(&panel.id)).cloned().collect();
    }
}
