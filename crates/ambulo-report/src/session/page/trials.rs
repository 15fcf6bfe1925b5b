//! The trials of the page, each with a link to its page and the reasons why cycles are left out; warnings.

use super::super::{Session, SessionSummary, TrialSummary, TrialWarning};
use crate::html::{code, escaped};
use std::collections::BTreeMap;
use std::fmt::Write;

/// The list of trials.
pub(super) fn trials(session: &Session) -> String {
    let mut html = String::from(
        "<section id=\"trials\"><h2>Trials</h2>\n<div class=\"scroll\"><table>\n<thead><tr><th>trial</th>\
         <th>recorded</th><th>activity</th><th class=\"number\">speed m/s</th><th>data</th><th>motion</th>\
         <th class=\"number\">cycles in the means</th><th class=\"number\">with measured forces</th>\
         <th>left out, and why</th></tr></thead>\n<tbody>\n",
    );
    for trial in &session.summary.trials {
        html += &row(trial, &left_out(session, trial));
    }
    html += "</tbody></table></div>\n<p class=\"soft\">Cycles: right + left, of all. Measured: force plates measured \
             the whole stance of the cycle.";
    if session.summary.trials.iter().any(|trial| trial.page.is_some()) {
        html += " The names lead to the pages of the trials, in the folder <code>trials</code> next to this file.";
    }
    html + "</p>\n" + &other_recordings(&session.summary) + "</section>\n"
}

fn row(trial: &TrialSummary, left_out: &str) -> String {
    let text = |text: &Option<String>| escaped(text.as_deref().unwrap_or("-"));
    let name = match &trial.page {
        Some(page) => format!("<a href=\"{}\">{}</a>", escaped(&address(page)), escaped(&trial.trial)),
        None => escaped(&trial.trial),
    };
    let [[right, left], [all_right, all_left]] = [trial.counted, trial.cycles];
    let activity = if trial.error.is_some() { "not computed".to_owned() } else { text(&trial.activity) };
    format!(
        "<tr><th scope=\"row\">{name}</th><td>{}</td><td>{activity}</td><td class=\"number\">{}</td><td>{}</td>\
         <td>{}</td><td class=\"number\">{right} + {left} of {all_right} + {all_left}</td><td class=\"number\">{} + \
         {}</td><td>{left_out}</td></tr>\n",
        text(&trial.recorded_on),
        trial.speed_m_s.map_or("-".to_owned(), |speed| format!("{speed:.2}")),
        text(&trial.quality),
        text(&trial.verdict),
        trial.measured[0],
        trial.measured[1],
    )
}

/// The address of a file by its name.
fn address(name: &str) -> String {
    let mut address = String::new();
    for byte in name.bytes() {
        match byte {
            b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'/' | b'.' | b'-' | b'_' => address.push(char::from(byte)),
            other => _ = write!(address, "%{other:02X}"),
        }
    }
    address
}

/// Why cycles are not in the means, and which of those in the means are unusual, as HTML.
fn left_out(session: &Session, trial: &TrialSummary) -> String {
    if let Some(error) = &trial.error {
        return code(error);
    }
    let found = session.representative();
    let mut reasons: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for (k, cycle) in session.cycles.iter().enumerate().filter(|(_, c)| session.name(c.trial) == trial.trial) {
        let far = found.distances[k].filter(|_| found.is_far(k));
        let unusual = far.map(|distance| {
            format!("in the means, but its angles are {distance:.1} times as far from the median as usual")
        });
        if let Some(reason) = cycle.excluded.clone().or(unusual) {
            reasons.entry(reason).or_default().push(format!("{} {}", cycle.side, cycle.number));
        }
    }
    let words = |(reason, cycles): (String, Vec<String>)| match cycles.len() {
        1 | 2 => format!("{}: {}", cycles.join(" and "), code(&reason)),
        several => format!("{several} cycles: {}", code(&reason)),
    };
    reasons.into_iter().map(words).collect::<Vec<_>>().join("<br>")
}

fn other_recordings(summary: &SessionSummary) -> String {
    if summary.not_computed.is_empty() {
        return String::new();
    }
    let item = |(name, why): (&String, &String)| format!("<li><b>{}</b>: {}</li>\n", escaped(name), code(why));
    let items: String = summary.not_computed.iter().map(item).collect();
    format!("<h3>Other recordings</h3>\n<ul>\n{items}</ul>\n")
}

/// Each different warning with the names of its trials, in the order of the trials.
fn grouped(trials: &[TrialSummary], is_wanted: impl Fn(&TrialWarning) -> bool) -> Vec<(&str, Vec<&str>)> {
    let mut groups: Vec<(&str, Vec<&str>)> = Vec::new();
    for trial in trials {
        for warning in trial.warnings.iter().filter(|warning| is_wanted(warning)) {
            match groups.iter_mut().find(|(message, _)| *message == warning.message) {
                Some((_, names)) => names.push(&trial.trial),
                None => groups.push((&warning.message, vec![&trial.trial])),
            }
        }
    }
    groups
}

/// Warnings about the sessions as a whole and about their bodies; they belong on the first sheet.
pub(super) fn first_warnings(session: &Session, earlier: Option<&Session>) -> Vec<String> {
    let mut all: Vec<String> = session.summary.warnings.iter().map(|warning| code(warning)).collect();
    let sessions = [(Some(session), ""), (earlier, "Earlier session: ")];
    for (session, start) in sessions.into_iter().filter_map(|(session, start)| Some((session?, start))) {
        let trials = &session.summary.trials;
        let found = grouped(trials, TrialWarning::is_of_calibration);
        all.extend(found.iter().map(|(message, names)| format!("{start}{}{}", code(message), of(names, trials.len()))));
    }
    all
}

/// All warnings about the data of the trials.
pub(super) fn data_warnings(session: &Session) -> String {
    let trials = &session.summary.trials;
    let found = grouped(trials, |warning| !warning.is_of_calibration());
    if found.is_empty() {
        return String::new();
    }
    let item =
        |(message, names): &(&str, Vec<&str>)| format!("<li>{}{}</li>\n", code(message), of(names, trials.len()));
    let items: String = found.iter().map(item).collect();
    format!(
        "<section id=\"warnings\"><h2>Warnings about the data</h2>\n<ul class=\"data\">\n{items}</ul>\n</section>\n"
    )
}

/// The trials of a warning.
fn of(names: &[&str], all: usize) -> String {
    let words = match names.len() {
        count if count == all && all > 1 => format!("all {all} trials"),
        1..=3 => names.join(", "),
        several => format!("{several} trials: {}, ...", names[0]),
    };
    format!(" <span class=\"soft\">({})</span>", escaped(&words))
}
