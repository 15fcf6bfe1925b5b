//! The first sheet of the page: what changed since the earlier session, or how far the session is from normal.

use super::super::quantities::named;
use super::super::{ChangeSummary, ChangesSummary, SessionSummary, Spread};
use super::figures::Figures;
use super::sections;
use crate::figures::FigureError;
use crate::html::{code, escaped};
use std::fmt::Write;

/// The names of curves in a sentence.
const NAMED: usize = 6;

/// What changed: a sentence, and before and after side by side.
pub(super) fn what_changed(summary: &SessionSummary, changes: &ChangesSummary) -> String {
    let since = summary.compared_with.as_deref().unwrap_or_default();
    let mut html = format!("<section id=\"changes\"><h2>What changed since {}</h2>\n", escaped(since));
    html += &format!("<p class=\"answer\">{}</p>\n", sentence(changes));
    html += "<div class=\"scroll\"><table class=\"changes\">\n<thead><tr><th></th><th class=\"number\">before</th>\
             <th class=\"number\">after</th><th class=\"number\">change</th><th class=\"number\">normal</th>\
             <th>how sure</th></tr></thead>\n<tbody>\n";
    for change in changes.scores.iter().chain(&changes.times) {
        html += &row(change);
    }
    html += "<tr class=\"part\"><th colspan=\"6\">The largest changes of curves beyond the error of a \
             calibration</th></tr>\n";
    html += &changes.largest.iter().map(row).collect::<String>();
    if changes.largest.is_empty() {
        html += "<tr><td colspan=\"6\">No curve changed clearly.</td></tr>\n";
    }
    html += "</tbody></table></div>\n";
    html += &calibration(&changes.calibration);
    html + "<p class=\"soft\">Clear: larger than two standard deviations of the difference over the cycles (in \
        brackets). \
            A score counts from 1.6°. Nothing is known of the variation between days. Curves: values where the change \
            is largest.</p>\n</section>\n"
}

/// The answer in words.
fn sentence(changes: &ChangesSummary) -> String {
    let mut words = String::new();
    if let Some(score) = changes.scores.first() {
        let (before, after) = (score.before, score.after);
        let change = after - before;
        let spread = score.two_sd.map_or(String::new(), |two_sd| format!(" ± {two_sd:.1}"));
        let numbers = format!("gait profile score {before:.1}° before, {after:.1}° after ({change:+.1}°{spread})");
        let closer = if change < 0.0 { "closer to normal" } else { "farther from normal" };
        words += &match score.certainty.as_str() {
            "clear" => format!("<b>The walk is {closer}</b>: {numbers}."),
            "calibration" => {
                format!(
                    "<b>Whether the walk is {closer} is not sure</b>: {numbers}, but a new calibration explains it."
                )
            }
            "single_cycle" => {
                format!("<b>Whether the walk is {closer} is not known</b>: {numbers}, but one side has a single cycle.")
            }
            _ => format!("<b>The walk is as far from normal as before</b>: {numbers}."),
        };
        if let Some(without) = changes.score_without_calibration {
            let _ = write!(words, " Without the offsets that a calibration explains it would be {without:.1}°.");
        }
    }
    let [clear, all] = changes.clear;
    let _ = write!(words, " {clear} of {all} curves changed clearly.");
    words
}

/// The changes that a calibration explains.
fn calibration(explained: &[ChangeSummary]) -> String {
    if explained.is_empty() {
        return String::new();
    }
    let offset = |change: &ChangeSummary| {
        let offset = change.offset.unwrap_or(0.0);
        format!("{} {} ({offset:+.0}°)", label(&change.quantity), side(&change.side))
    };
    let mut names: Vec<String> = explained.iter().take(NAMED).map(offset).collect();
    if explained.len() > NAMED {
        names.push(format!("and {} more", explained.len() - NAMED));
    }
    format!(
        "<p class=\"caution\"><b>Not counted, because a new calibration explains it:</b> {}. Markers or wands that \
         were \
         placed anew add such an offset. A change of the bone (a rotation) would look the same: compare with the \
         physical \
         examination.</p>\n",
        escaped(&names.join(", "))
    )
}

fn row(change: &ChangeSummary) -> String {
    let digits = digits(change);
    let normal = change.normal.map_or("-".to_owned(), |normal| format!("{normal:.digits$}"));
    let spread = change.two_sd.map_or(String::new(), |two_sd| format!(" (± {two_sd:.digits$})"));
    format!(
        "<tr><th scope=\"row\">{}</th><td class=\"number\">{:.digits$}</td><td class=\"number\">{:.digits$}</td>\
         <td class=\"number\">{:+.digits$}</td><td class=\"number\">{normal}</td><td class=\"sure \
         {}\">{}{spread}</td></tr>\n",
        escaped(&row_name(change)),
        change.before,
        change.after,
        change.after - change.before,
        change.certainty,
        change.words
    )
}

/// `Knee flexion, left, at 72 % (flexion +, deg)`
fn row_name(change: &ChangeSummary) -> String {
    let unit = if change.unit.is_empty() { String::new() } else { format!(", {}", change.unit) };
    let of_side = side(&change.side);
    match change.at_percent {
        Some(percent) => {
            let positive = named(&change.quantity).map_or("", |quantity| quantity.wording().directions[0]);
            let positive = if positive.is_empty() { String::new() } else { format!("{positive} +, ") };
            format!("{}, {of_side}, at {percent:.0} % ({positive}{})", label(&change.quantity), change.unit)
        }
        None if change.side == "both" => format!("{}{unit}", label(&change.quantity)),
        None => format!("{}, {of_side}{unit}", label(&change.quantity)),
    }
}

/// Name of a score, a time, a distance or a curve.
pub(crate) fn label(quantity: &str) -> String {
    match quantity {
        "gait_profile_score" => "Gait profile score".to_owned(),
        "gait_deviation_index" => "Gait deviation index".to_owned(),
        other => named(other).map_or_else(|| sections::name(other).0.to_owned(), |quantity| quantity.label()),
    }
}

fn side(letter: &str) -> &'static str {
    match letter {
        "r" => "right",
        "l" => "left",
        _ => "both sides",
    }
}

fn digits(change: &ChangeSummary) -> usize {
    match change.unit.as_str() {
        "deg" => 1,
        "" => 0,
        _ if change.at_percent.is_some() => 2,
        _ => sections::name(&change.quantity).1,
    }
}

/// Gait profile scores in large letters, and the profile.
pub(super) fn normal(summary: &SessionSummary, figures: &Figures<'_>) -> Result<String, FigureError> {
    let mut html = String::from("<section id=\"normal\"><h2>How far from normal</h2>\n");
    if let Some(why) = &summary.no_reference {
        let _ = writeln!(html, "<p>Not compared with healthy people: {}.</p>", escaped(why));
    }
    if let Some(reference) = &summary.reference {
        let _ = writeln!(html, "<p class=\"soft\">Reference group: {}</p>", escaped(&reference.words));
    }
    let (Some(profile), Some(figure)) = (&summary.profile, figures.profile()) else {
        return Ok(if summary.no_reference.is_some() { html + "</section>\n" } else { String::new() });
    };
    let score = |spread: Option<Spread>| spread.map(|spread| (spread.mean, spread.sd));
    let scores = [
        ("both sides", "both", profile.overall.map(|overall| (overall, None))),
        ("right", "right", score(profile.right)),
        ("left", "left", score(profile.left)),
        ("expected of a healthy person", "", profile.expected.map(|expected| (expected, None))),
    ];
    let is_known = scores[..3].iter().any(|(.., score)| score.is_some());
    html += "<div class=\"scores\">\n";
    for (name, class, score) in scores.into_iter().filter(|_| is_known) {
        let Some((mean, sd)) = score else { continue };
        let sd = sd.map_or(String::new(), |sd| format!(" ± {sd:.1}"));
        let _ = writeln!(html, "<div class=\"score {class}\"><b>{mean:.1}°</b><span>{name}{sd}</span></div>");
    }
    html += "</div>\n<p>The gait profile score is the distance of nine angles of pelvis, hip, knee, ankle and foot \
        from \
             the mean of healthy people, root mean square over the cycle.</p>\n";
    if profile.overall.is_none() {
        html += "<p class=\"soft\">There is no score of both sides, because it needs all nine angles of both.</p>\n";
    }
    html += &deviation_index(profile);
    html += &super::picture("wide", &figure.svg()?, "Movement analysis profile");
    for part in figure.narrow() {
        html += &super::picture("narrow", &part.svg()?, "Movement analysis profile, a part");
    }
    Ok(html + "</section>\n")
}

fn deviation_index(profile: &super::super::ProfileSummary) -> String {
    if let Some(why) = &profile.no_deviation_index {
        return format!("<p class=\"soft\">No gait deviation index: {}.</p>\n", code(why));
    }
    let Some(index) = profile.deviation_index else { return String::new() };
    let number = |index: Option<f64>| index.map_or("-".to_owned(), |index| format!("{index:.0}"));
    format!(
        "<p>Gait deviation index, from the score: <b>{}</b>; right {}, left {}. 100 is the mean of the reference \
         group, 10 \
         less is a standard deviation away.</p>\n",
        number(index.overall),
        number(index.right),
        number(index.left)
    )
}
