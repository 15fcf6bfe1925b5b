//! The page of a session: one file that needs no other file.

pub(crate) mod answer;
mod figures;
mod legend;
mod sections;
mod trials;

use super::{ComparedSession, SessionSummary, Spread};
use crate::figures::FigureError;
use crate::html::{Document, code, escaped, html_table};
use crate::style::style;
use ambulo::model::Side;
use ambulo::study::validation::Section;
use ambulo_results::{OutputFile, SESSION_PAGE};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use figures::{Figures, Part};
use std::fmt::Write;

const STYLE: &str =
    concat!(include_str!("../../../data/report/page.css"), include_str!("../../../data/report/session.css"));
const POLICY: &str = "default-src 'none'; style-src 'unsafe-inline'; img-src data:";

/// The page; it contains the tables `files`.
///
/// # Errors
/// A style that cannot be read.
pub(super) fn page(compared: &ComparedSession, files: &[OutputFile<'_>]) -> Result<String, FigureError> {
    let style = style().map_err(|e| FigureError { name: SESSION_PAGE, reason: e.to_string() })?;
    let figures = Figures { compared, style };
    let summary = &compared.session.summary;
    let title = match &summary.person {
        Some(person) => format!("Gait session of {person}"),
        None => "Gait session".to_owned(),
    };
    let mut body = first_sheet(compared, &figures, &title)?;
    body += &curves(&figures)?;
    body += &tables(compared);
    body += &trials::trials(&compared.session);
    body += &trials::data_warnings(&compared.session);
    body += &about(summary, files);
    let sides = Side::BOTH.map(|side| {
        let line = style.side(side);
        format!(
            ":root {{ --{side}: {}; }} @media (prefers-color-scheme: dark) {{ :root {{ --{side}: {}; }} }}",
            line.color, line.dark
        )
    });
    let style = format!("{STYLE}\n{}", sides.join("\n"));
    Ok(Document { title: &title, policy: POLICY, style: &style, body: &body }.html())
}

/// Who, when, the answer and what to check: the sheet for a patient's file; then how far from normal.
fn first_sheet(compared: &ComparedSession, figures: &Figures<'_>, title: &str) -> Result<String, FigureError> {
    let summary = &compared.session.summary;
    let strip = compared.session.figure.as_deref().unwrap_or_default();
    let mut html = format!(
        "<header>\n<div><h1>{}</h1>\n<p>{}</p></div>\n{strip}</header>\n{}<main>\n<div class=\"first\">\n",
        escaped(title),
        escaped(&subtitle(summary)),
        contents(compared)
    );
    let normal = answer::normal(summary, figures)? + &section(&sections::times(compared));
    let warnings = warnings(compared);
    html += &match &summary.changes {
        Some(changes) => format!("{}{warnings}</div>\n{normal}", answer::what_changed(summary, changes)),
        None => format!("{normal}{warnings}</div>\n"),
    };
    Ok(html)
}

/// `2026-11-03 · 9 years · 32.1 kg · 1.45 m · 1.31 m/s`
fn subtitle(summary: &SessionSummary) -> String {
    let speed = summary.speed_m_s.map(|speed| format!("walking at {:.2} m/s", speed.mean));
    let parts = [
        Some(summary.days().unwrap_or_else(|| "day not stated".to_owned())),
        summary.age_years.map(|age| format!("{age} years")),
        summary.mass_kg.map(|mass| format!("{mass:.1} kg")),
        summary.height_m.map(|height| format!("{height:.2} m")),
        speed,
    ];
    parts.into_iter().flatten().collect::<Vec<_>>().join(" · ")
}

/// Links to the parts of the page.
fn contents(compared: &ComparedSession) -> String {
    let summary = &compared.session.summary;
    let parts = [
        ("changes", "What changed", summary.changes.is_some()),
        ("normal", "How far from normal", summary.profile.is_some() || summary.no_reference.is_some()),
        ("curves", "Curves", true),
        ("tables", "Tables", true),
        ("trials", "Trials", true),
        ("about", "About this session", true),
    ];
    let shown = parts.into_iter().filter(|(.., is_shown)| *is_shown);
    let links: String = shown.map(|(id, words, _)| format!("<li><a href=\"#{id}\">{words}</a></li>")).collect();
    format!("<nav aria-label=\"Contents\"><ul>{links}</ul></nav>\n")
}

fn warnings(compared: &ComparedSession) -> String {
    let found = trials::first_warnings(&compared.session, compared.earlier.as_ref());
    if found.is_empty() {
        return String::new();
    }
    let items: String = found.iter().map(|item| format!("<li>{item}</li>\n")).collect();
    format!("<section class=\"check\"><h2>Check before use</h2>\n<ul class=\"warnings\">\n{items}</ul></section>\n")
}

/// All curves with one legend.
fn curves(figures: &Figures<'_>) -> Result<String, FigureError> {
    let mut html = format!("<section id=\"curves\"><h2>Curves</h2>\n{}", figures.legend());
    for side in Side::BOTH {
        for part in Part::ALL {
            html += &figures.change(part, side)?;
        }
    }
    for part in Part::ALL {
        html += &figures.means(part)?;
    }
    let representative: String =
        Part::ALL.iter().map(|part| figures.representative(*part)).collect::<Result<Vec<_>, _>>()?.concat();
    if !representative.is_empty() {
        html += &folded("Representative cycles", &representative);
    }
    Ok(html + "</section>\n")
}

/// The tables: the short ones open, the long ones folded.
fn tables(compared: &ComparedSession) -> String {
    let mut html = String::from("<section id=\"tables\"><h2>Tables</h2>\n");
    html += &section(&sections::knee_adduction(&compared.session));
    html += &section(&sections::contact_loads(&compared.session));
    let mut long = Vec::new();
    if let Some(before) = &compared.earlier {
        long.push(sections::time_differences(&compared.session, before));
        long.push(sections::curve_differences(compared));
    }
    long.extend([sections::deviations(compared), sections::sides(compared)]);
    for table in long.iter().filter(|table| !table.table.rows().is_empty()) {
        html += &folded(table.title, &html_table(table));
    }
    html + "</section>\n"
}

/// A part that opens on a click and is not printed.
fn folded(title: &str, html: &str) -> String {
    format!("<details><summary>{}</summary>\n{html}</details>\n", escaped(title))
}

/// Facts about person, body and data; the tables as files; the method.
fn about(summary: &SessionSummary, files: &[OutputFile<'_>]) -> String {
    let mut html = format!("<section id=\"about\"><h2>About this session</h2>\n{}", facts(summary));
    let link = |file: &OutputFile<'_>| {
        // These tables are text in memory, which is always written.
        let data = STANDARD.encode(file.bytes().unwrap_or_default());
        let name = escaped(&file.name);
        format!("<a download=\"{name}\" href=\"data:text/csv;charset=utf-8;base64,{data}\">{name}</a>")
    };
    let links: Vec<String> = files.iter().map(link).collect();
    let _ = writeln!(
        html,
        "<p class=\"files\">Tables in this file: {}. All curves are in <code>cycles.csv</code> next to it.</p>",
        links.join(", ")
    );
    let version = escaped(&summary.version);
    html + &format!("<p class=\"soft\">{} Ambulo {version}</p>\n</section>\n</main>", code(METHOD))
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

/// A picture for a wide or a narrow screen.
fn picture(screen: &str, svg: &str, label: &str) -> String {
    let labelled = format!("<svg aria-label=\"{}\" ", escaped(label));
    format!("<p class=\"picture {screen}\">{}</p>\n", svg.replacen("<svg ", &labelled, 1))
}

fn section(section: &Section) -> String {
    if section.table.rows().is_empty() {
        return String::new();
    }
    format!("<div class=\"whole\"><h3>{}</h3>\n{}</div>\n", escaped(section.title), html_table(section))
}
