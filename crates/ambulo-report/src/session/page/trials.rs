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

/// Warnings of the same code: the first message, the number of other messages, and the trials.
struct Group<'a> {
    code: &'a str,
    message: &'a str,
    others: Vec<&'a str>,
    trials: Vec<&'a str>,
}

/// The warnings by their codes, in the order of the trials.
fn grouped<'a>(
    sessions: impl Iterator<Item = &'a Session>,
    is_wanted: impl Fn(&TrialWarning) -> bool,
) -> Vec<Group<'a>> {
    let mut groups: Vec<Group<'a>> = Vec::new();
    let trials = sessions.flat_map(|session| &session.summary.trials);
    for (trial, warning) in trials.flat_map(|trial| trial.warnings.iter().map(move |warning| (trial, warning))) {
        if !is_wanted(warning) {
            continue;
        }
        let (code, message, name) = (warning.code.as_str(), warning.message.as_str(), trial.trial.as_str());
        let Some(group) = groups.iter_mut().find(|group| group.code == code && group.belongs(message)) else {
            groups.push(Group { code, message, others: Vec::new(), trials: vec![name] });
            continue;
        };
        if group.message != message && !group.others.contains(&message) {
            group.others.push(message);
        }
        if !group.trials.contains(&name) {
            group.trials.push(name);
        }
    }
    groups
}

impl Group<'_> {
    /// Assumptions of a calibration are different statements under one code.
    fn belongs(&self, message: &str) -> bool {
        self.code != ASSUMED || message == self.message
    }

    fn html(&self) -> String {
        let trials = match self.trials.len() {
            1..=3 => self.trials.join(", "),
            count => format!("{count} trials: {}, ...", self.trials[0]),
        };
        let more = match self.others.len() {
            0 => String::new(),
            count => format!("; {count} more like it"),
        };
        format!("{} <span class=\"soft\">({}{more})</span>", code(self.message), escaped(&trials))
    }
}

/// The code of assumptions of a calibration; one that names what may be misplaced changes angles.
const ASSUMED: &str = "calibration.assumed";
const MISPLACED: &str = "misplaced";

/// Whether a warning decides which angles can be used.
fn comes_first(warning: &TrialWarning) -> bool {
    warning.is_of_calibration() && (warning.code != ASSUMED || warning.message.contains(MISPLACED))
}

/// Warnings about the sessions as a whole and about their bodies; they belong on the first sheet.
pub(super) fn first_warnings(session: &Session, earlier: Option<&Session>) -> Vec<String> {
    let own = session.summary.warnings.iter().map(|warning| code(warning));
    let found = grouped([Some(session), earlier].into_iter().flatten(), comes_first);
    own.chain(found.iter().map(Group::html)).collect()
}

/// The other warnings about the data of the trials: one of each kind, and all of them in a part to open.
pub(super) fn data_warnings(session: &Session) -> String {
    let found = grouped(std::iter::once(session), |warning| !comes_first(warning));
    if found.is_empty() {
        return String::new();
    }
    let items: String = found.iter().map(|group| format!("<li>{}</li>\n", group.html())).collect();
    let mut html = format!("<section id=\"warnings\"><h2>Warnings about the data</h2>\n<ul>\n{items}</ul>\n");
    if found.iter().any(|group| !group.others.is_empty()) {
        let own = |trial: &TrialSummary| {
            let items = trial.warnings.iter().map(|warning| format!("<li>{}</li>\n", code(&warning.message)));
            format!("<h3>{}</h3>\n<ul>\n{}</ul>\n", escaped(&trial.trial), items.collect::<String>())
        };
        html += &super::folded("Every warning", &session.summary.trials.iter().map(own).collect::<String>());
    }
    html + "</section>\n"
}
