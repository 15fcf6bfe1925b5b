//! The page of a session: one file that needs no other file.

mod figures;
mod sections;

use super::{ComparedSession, SessionSummary, Spread};
use crate::figures::{FigureError, SessionFigure};
use crate::html::{Document, code, escaped, html_table};
use crate::style::style;
use ambulo::model::Side;
use ambulo::study::validation::Section;
use ambulo_results::SESSION_PAGE;
use figures::{Figures, Part, color_of};
use std::fmt::Write;

const STYLE: &str =
    concat!(include_str!("../../../data/report/page.css"), include_str!("../../../data/report/session.css"));
const POLICY: &str = "default-src 'none'; style-src 'unsafe-inline'; img-src data:";

/// The page.
///
/// # Errors
/// A style that cannot be read.
pub(super) fn page(compared: &ComparedSession) -> Result<String, FigureError> {
    let style = style().map_err(|e| FigureError { name: SESSION_PAGE, reason: e.to_string() })?;
    let figures = Figures { compared, style };
    let summary = &compared.session.summary;
    let title = match &summary.person {
        Some(person) => format!("Session of {person}"),
        None => "Session".to_owned(),
    };
    let mut body = format!("<header>\n<h1>{}</h1>\n{}</header>\n<main>\n", escaped(&title), facts(summary));
    body += &warnings(summary);
    body += &glance(summary, &figures)?;
    body += &part("Mean and standard deviation", Part::ALL.map(|part| figures.means(part)))?;
    body += &before_and_after(&figures)?;
    body += &section(&sections::times(compared));
    body += &section(&sections::knee_adduction(&compared.session));
    body += &section(&sections::contact_loads(&compared.session));
    body += &section(&sections::deviations(compared));
    body += &section(&sections::sides(compared));
    body += &part("Consistency: all cycles", Part::ALL.map(|part| figures.consistency(part)))?;
    body += &part("Representative cycles", Part::ALL.map(|part| figures.representative(part)))?;
    body += &section(&sections::trials(&compared.session));
    body += &section(&sections::excluded(&compared.session));
    body += &not_computed(summary);
    let _ = write!(body, "<p class=\"soft\">{} Ambulo {}</p>\n</main>", code(METHOD), escaped(&summary.version));
    let sides = Side::BOTH.map(|side| {
        let color = color_of(style, side);
        let name = side.to_string();
        format!(
            ":root {{ --{name}: {}; }} @media (prefers-color-scheme: dark) {{ :root {{ --{name}: {}; }} }}",
            color.color, color.dark
        )
    });
    let style = format!("{STYLE}\n{}", sides.join("\n"));
    Ok(Document { title: &title, policy: POLICY, style: &style, body: &body }.html())
}

const METHOD: &str = "Angles are clinical: flexion, dorsiflexion, adduction, internal rotation, anterior tilt, own \
    side up and forward are positive. Moments \
are internal, per body mass. The scales are the same in every session; where a curve leaves its scale, the figure says \
so. Forces are measured where force \
plates measured the whole stance of a cycle, otherwise predicted from the motion; a mean never has both. Definitions: \
docs/SESSION.md.";

/// Longer facts take a separate line, in letters.
const WIDE: usize = 60;

/// Facts about person, body and data.
fn facts(summary: &SessionSummary) -> String {
    let spread = |spread: Spread, digits: usize| {
        let sd = spread.sd.map_or(String::new(), |sd| format!(" ± {sd:.digits$}"));
        format!("{:.digits$}{sd}", spread.mean)
    };
    let count = |of: fn(&super::TrialSummary) -> [usize; 2]| {
        let sums = summary.trials.iter().map(of).fold([0, 0], |[r, l], [right, left]| [r + right, l + left]);
        format!("{} right, {} left", sums[0], sums[1])
    };
    let computed = summary.trials.iter().filter(|trial| trial.error.is_none()).count();
    let rows = [
        ("Recorded", summary.days()),
        ("Age", summary.age_years.map(|age| format!("{age} years"))),
        ("Body mass", summary.mass_kg.map(|mass| format!("{mass:.1} kg"))),
        ("Stature", summary.height_m.map(|height| format!("{height:.2} m"))),
        ("Leg length", summary.leg_length_m.map(|leg| format!("{leg:.2} m"))),
        ("Body", Some(summary.body.clone()).filter(|body| !body.is_empty())),
        ("Trials", Some(format!("{computed} of {} computed", summary.trials.len()))),
        ("Cycles in the means", Some(count(|trial| trial.counted))),
        ("Cycles with measured forces", Some(count(|trial| trial.measured))),
        ("Walking speed", summary.speed_m_s.map(|speed| format!("{} m/s", spread(speed, 2)))),
        ("Speed over √(g L)", summary.speed_dimensionless.map(|speed| spread(speed, 2))),
        ("Angles of pelvis and hips", Some(convention(summary))),
        ("Earlier session", summary.compared_with.clone()),
        ("Compared with", summary.reference.as_ref().map(|reference| reference.words.clone())),
        ("Not compared", summary.no_reference.clone()),
    ];
    let mut html = String::from("<dl class=\"facts\">\n");
    for (name, value) in rows {
        if let Some(value) = value {
            let wide = if value.len() > WIDE { " class=\"wide\"" } else { "" };
            let _ = writeln!(html, "<div{wide}><dt>{}</dt><dd>{}</dd></div>", escaped(name), escaped(&value));
        }
    }
    html + "</dl>\n"
}

fn convention(summary: &SessionSummary) -> String {
    let reason = summary.convention_reason.as_ref().map_or(String::new(), |reason| format!(" ({reason})"));
    format!("{} convention{reason}", summary.convention.word())
}

fn warnings(summary: &SessionSummary) -> String {
    if summary.warnings.is_empty() {
        return String::new();
    }
    let items: String = summary.warnings.iter().map(|text| format!("<li>{}</li>\n", code(text))).collect();
    format!("<ul class=\"warnings\">\n{items}</ul>\n")
}

/// Gait profile scores in large letters, and the profile.
fn glance(summary: &SessionSummary, figures: &Figures<'_>) -> Result<String, FigureError> {
    let (Some(profile), Some(figure)) = (&summary.profile, figures.profile()) else { return Ok(String::new()) };
    let score = |spread: Option<Spread>| spread.map(|spread| (spread.mean, spread.sd));
    let scores = [
        ("both sides", "both", profile.overall.map(|overall| (overall, None))),
        ("right", "right", score(profile.right)),
        ("left", "left", score(profile.left)),
    ];
    let mut html = String::from("<h2>Gait profile score</h2>\n<div class=\"scores\">\n");
    for (name, class, score) in scores {
        let Some((mean, sd)) = score else { continue };
        let sd = sd.map_or(String::new(), |sd| format!(" ± {sd:.1}"));
        let _ = writeln!(html, "<div class=\"score {class}\"><b>{mean:.1}°</b><span>{name}{sd}</span></div>");
    }
    if let Some(expected) = profile.expected {
        let _ = writeln!(
            html,
            "<div class=\"score\"><b>{expected:.1}°</b><span>expected of a person of the reference group</span></div>"
        );
    }
    html += "</div>\n";
    if profile.overall.is_none() {
        html +=
            "<p class=\"soft\">There is no gait profile score, because it needs all nine angles of both sides.</p>\n";
    }
    Ok(html + &picture(&figure.svg()?, "Movement analysis profile"))
}

/// The figures of angles, of kinetics and of contact loads under one title.
fn part(title: &str, drawn: [Option<SessionFigure>; 3]) -> Result<String, FigureError> {
    let mut html = String::new();
    for figure in drawn.into_iter().flatten() {
        html += &picture(&figure.svg()?, &figure.title);
    }
    Ok(if html.is_empty() { html } else { format!("<h2>{}</h2>\n{html}", escaped(title)) })
}

fn before_and_after(figures: &Figures<'_>) -> Result<String, FigureError> {
    let Some(before) = &figures.compared.earlier else { return Ok(String::new()) };
    let mut html = String::new();
    for side in Side::BOTH {
        html += &part(&format!("Before and after: {side} side"), Part::ALL.map(|part| figures.change(part, side)))?;
    }
    html += &section(&sections::time_differences(&figures.compared.session, before));
    Ok(html + &section(&sections::curve_differences(figures.compared, before)))
}

/// A picture that scrolls on a narrow screen.
fn picture(svg: &str, label: &str) -> String {
    let labelled = format!("<svg aria-label=\"{}\" ", escaped(label));
    format!("<p class=\"picture\">{}</p>\n", svg.replacen("<svg ", &labelled, 1))
}

fn section(section: &Section) -> String {
    if section.table.rows().is_empty() {
        return String::new();
    }
    format!("<h2>{}</h2>\n{}", escaped(section.title), html_table(section))
}

fn not_computed(summary: &SessionSummary) -> String {
    if summary.not_computed.is_empty() {
        return String::new();
    }
    let items: String = summary
        .not_computed
        .iter()
        .map(|(name, why)| format!("<li><b>{}</b>: {}</li>\n", escaped(name), code(why)))
        .collect();
    format!("<h2>Other recordings</h2>\n<ul>\n{items}</ul>\n")
}
