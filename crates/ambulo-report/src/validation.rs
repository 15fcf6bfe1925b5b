//! Predicted ground forces judged by force plates: tables, figures and a page.
//!
//! `stances.csv` has one row per stance and component, `means.csv` one per trial, person and kind of trial;
//! `validation.md` and `validation.html` have the same tables for reading. Definitions and units:
//! `ambulo::study::validation`.

use super::figures::{CURVE_COLORS, Chart, ChartAxis, ChartCurve, ChartPanel, CurveForm, FigureError, PALE};
use super::html::{Document, code, escaped, html_table};
use ambulo::numerics::finite_mean;
use ambulo::study::QualityState;
use ambulo::study::validation::{
    self, Component, DEFINITIONS, Figure, JudgedTrial, LegJoint, PhaseError, Section, TextTable, kinds, over_kind,
    persons, phase_errors, stance_rows,
};
use ambulo_formats::table::guarded;
use ambulo_results::{OutputFile, VALIDATION_PAGE};
use serde::Serialize;
use std::fmt::Write;

const STYLE: &str = include_str!("../data/report/page.css");
const POLICY: &str = "default-src 'none'; style-src 'unsafe-inline'; img-src data:";
/// Width of a figure [mm], and height of its axes [pt].
const SIZE: (f64, f64) = (260.0, 90.0);

/// A trial with the files that were used for it, and why it was not judged.
#[derive(Debug, Clone, Serialize)]
pub struct ListedTrial {
    /// Path of the recording.
    pub name: String,
    /// Person of the trial.
    pub person: String,
    /// The standing trial.
    pub standing: Option<String>,
    /// Whether it is a trial of a `.b3d`, which contains a model and forces.
    pub is_subject: bool,
    /// The model; `None` for the built-in body, or the one of the file.
    pub model: Option<String>,
    /// The table of measured forces; `None` for those in the recording.
    pub forces: Option<String>,
    /// The stated body mass [kg].
    pub mass_kg: Option<f64>,
    /// The stated stature [m].
    pub height_m: Option<f64>,
    /// Why it was not judged.
    pub error: Option<String>,
}

/// Which files belong to each trial.
#[must_use]
pub fn listed_section(listed: &[ListedTrial]) -> Section {
    let mut table =
        TextTable::new(&["trial", "person", "standing trial", "body", "forces from", "stated kg", "stated m"]);
    let stated = |x: Option<f64>| x.map_or("-".to_owned(), |x| x.to_string());
    for trial in listed {
        table.row([
            trial.name.clone(),
            trial.person.clone(),
            trial.standing.clone().unwrap_or_else(|| "-".to_owned()),
            trial.model.clone().unwrap_or_else(|| if trial.is_subject { "its own" } else { "built-in" }.to_owned()),
            trial.forces.clone().unwrap_or_else(|| if trial.is_subject { "the file" } else { "its plates" }.to_owned()),
            stated(trial.mass_kg),
            stated(trial.height_m),
        ]);
    }
    Section { title: "Files of each trial", table, note: String::new() }
}

/// The files of a validation: `validation.html`, `validation.md`, `stances.csv`, `means.csv`. `title` states what was
/// judged; `others` are recordings that are no trials, each with the reason.
///
/// # Errors
/// A style that cannot be read.
pub fn validation_files(
    title: &str,
    listed: &[ListedTrial],
    others: &[(String, String)],
    judged: &[JudgedTrial],
) -> Result<Vec<OutputFile<'static>>, FigureError> {
    let judged: Vec<&JudgedTrial> = judged.iter().collect();
    let report = Report { title, listed, others, judged: &judged };
    Ok(vec![
        OutputFile::new(VALIDATION_PAGE, report.page()?.into_bytes()),
        OutputFile::new("validation.md", report.markdown().into_bytes()),
        OutputFile::new("stances.csv", stances_csv(&judged).into_bytes()),
        OutputFile::new("means.csv", means_csv(&judged).into_bytes()),
    ])
}

struct Report<'a> {
    title: &'a str,
    listed: &'a [ListedTrial],
    others: &'a [(String, String)],
    judged: &'a [&'a JudgedTrial],
}

impl Report<'_> {
    /// The sentences below the title.
    fn lead(&self) -> String {
        let Report { listed, judged, .. } = self;
        let rule = judged.first().map_or("", |trial| trial.rule);
        let of_quality = |state: QualityState| judged.iter().filter(|trial| trial.quality == state).count();
        let (doubtful, bad) = (of_quality(QualityState::Doubtful), of_quality(QualityState::Bad));
        let data = match doubtful + bad {
            0 => String::new(),
            _ => format!(" {doubtful} of them have doubtful data and {bad} bad data; they count in all means."),
        };
        format!(
            "{} of {} trials were judged (persons: {}).{data} Every trial was predicted without its force plates: \
             events and everything else \
             from motion alone, the motion low-passed at 6 Hz, the plates at 20 Hz; body mass as stated, else as the \
             plates show it. Rule in double \
             support: {rule}.",
            judged.len(),
            listed.len(),
            persons(judged).len(),
        )
    }

    /// The tables behind the figures, in order.
    fn sections(&self) -> Vec<Section> {
        let judged = self.judged;
        vec![
            validation::kind_means(judged),
            validation::rmse_by_fifth(judged),
            validation::share_by_fifth(judged),
            validation::method_means(judged),
            validation::person_means(judged),
            validation::each_trial(judged),
            validation::forces(judged),
            validation::centers(judged),
            validation::moments(judged),
            validation::events(judged),
            data_section(judged),
            listed_section(self.listed),
        ]
    }

    /// Trials with errors, and recordings that are no trials, each with the reason.
    fn not_judged(&self) -> Vec<(&str, &str)> {
        let errors = self.listed.iter().filter_map(|trial| Some((trial.name.as_str(), trial.error.as_deref()?)));
        errors.chain(self.others.iter().map(|(name, why)| (name.as_str(), why.as_str()))).collect()
    }

    /// Remedies for errors; empty without any.
    fn remedy(&self) -> &'static str {
        if self.listed.iter().all(|trial| trial.error.is_none()) {
            return "";
        }
        "What an error asks for, such as the mass or the model, is a key of trials.toml: `mass = KG`, `model = \
         \"FILE\"`."
    }

    fn markdown(&self) -> String {
        let head = format!("# {}\n\n{}\n\n{DEFINITIONS}\n", self.title, self.lead());
        let mut page = self.sections().iter().fold(head, |page, section| format!("{page}\n{}", section.markdown()));
        let others = self.not_judged();
        if !others.is_empty() {
            page += "\n## Not judged\n\n";
            others.iter().for_each(|(name, why)| _ = writeln!(page, "- {name}: {}", why.replace(['\n', '\r'], " ")));
            let _ = writeln!(page, "\n{}", self.remedy());
        }
        page
    }

    /// The list of what was not judged, as HTML.
    fn not_judged_html(&self) -> String {
        let others = self.not_judged();
        if others.is_empty() {
            return String::new();
        }
        let mut html = String::from("<h2>Not judged</h2>\n<ul>\n");
        for (name, why) in others {
            let _ = writeln!(html, "<li><b>{}</b>: {}</li>", escaped(name), code(why));
        }
        format!("{html}</ul>\n<p class=\"soft\">{}</p>\n", code(self.remedy()))
    }

    fn page(&self) -> Result<String, FigureError> {
        let mut tables = String::new();
        for section in self.sections() {
            let _ = write!(tables, "<h2>{}</h2>\n{}", escaped(section.title), html_table(&section));
        }
        let body = format!(
            r#"<header>
<h1>{title}</h1>
<p>{lead}</p>
<p class="soft">{definitions} Ambulo {version}</p>
</header>
<main>
<h2>Errors over the stance</h2>
<p class="soft">From foot strike (0 %) to foot off (100 %), each person once. Where the predicted standard deviation is as large as the RMSE, the bands
of the prediction are right; where it is smaller, they are too narrow.</p>
{figure}
{tables}{not_judged}</main>"#,
            title = escaped(self.title),
            lead = code(&self.lead()),
            definitions = code(DEFINITIONS),
            version = env!("CARGO_PKG_VERSION"),
            figure = self.figure()?,
            not_judged = self.not_judged_html(),
        );
        // On a narrow screen, figures scroll: their letters would be too small.
        let style = format!("{STYLE}\n.picture svg {{ min-width: 46rem; }}\ntbody th {{ white-space: nowrap; }}");
        Ok(Document { title: self.title, policy: POLICY, style: &style, body: &body }.html())
    }

    /// A row of panels for each kind of trial, with a column for each component.
    fn figure(&self) -> Result<String, FigureError> {
        let panels = kinds(self.judged)
            .into_iter()
            .flat_map(|kind| Component::ALL.map(|component| panel(self.judged, kind, component)))
            .collect();
        let chart = Chart {
            name: "errors",
            title: "Error of the predicted ground force".to_owned(),
            caption: String::new(),
            width_mm: SIZE.0,
            columns: Component::ALL.len(),
            panel_height_pt: SIZE.1,
            panels,
            notes: Vec::new(),
        };
        let svg = chart.svg()?.replacen("<svg ", "<svg aria-label=\"Errors over the stance\" ", 1);
        Ok(format!("<p class=\"picture\">{svg}</p>\n"))
    }
}

fn panel(judged: &[&JudgedTrial], kind: &str, component: Component) -> ChartPanel {
    let errors = phase_errors(judged, kind, component);
    let curve = |name: &str, color, form, of: fn(&PhaseError) -> f64| ChartCurve {
        name: name.to_owned(),
        color,
        form,
        points: errors.iter().map(|error| [100.0 * error.phase, of(error)]).collect(),
    };
    ChartPanel {
        title: format!("{kind}: {}", component.word()),
        abscissa: ChartAxis { range: Some([0.0, 100.0]), ..ChartAxis::labelled("stance (%)") },
        ordinate: ChartAxis::labelled("% of body weight"),
        curves: vec![
            curve("RMSE", CURVE_COLORS[0], CurveForm::Line, |error| error.rmse),
            curve("predicted standard deviation", CURVE_COLORS[1], CurveForm::Line, |error| error.deviation),
            curve("mean of predicted minus measured", PALE, CurveForm::Line, |error| error.bias),
        ],
        ..ChartPanel::default()
    }
}

/// Mass, speed and quality of the data of each trial.
fn data_section(judged: &[&JudgedTrial]) -> Section {
    let mut table = TextTable::new(&["trial", "speed m/s", "body mass kg", "mass from", "data"]);
    for trial in judged {
        table.row([
            trial.name.clone(),
            validation::number(trial.speed_m_s.unwrap_or(f64::NAN), 2),
            validation::number(trial.mass.kg, 1),
            trial.mass.source.word().to_owned(),
            trial.quality.word().to_owned(),
        ]);
    }
    let note = "`ambulo forces` with the files of the trial gives the reasons for doubtful and bad data.".to_owned();
    Section { title: "Data of each trial", table, note }
}

/// A text as a cell of a CSV file.
pub(crate) fn cell(text: &str) -> String {
    let text = guarded(text);
    if text.contains([',', '"', ';', '\n', '\r']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.into_owned()
    }
}

/// A number as a cell; empty where there is none.
pub(crate) fn shown(x: f64) -> String {
    if x.is_finite() { x.to_string() } else { String::new() }
}

fn stances_csv(judged: &[&JudgedTrial]) -> String {
    let mut text = String::from(
        "trial,person,kind,side,start_s,end_s,component,rmse_percent_bw,rrmse_percent,r,in_band_percent,band_over_rmse",
    );
    for name in ["rmse_percent_bw", "in_band_percent"] {
        (1..=5).for_each(|fifth| _ = write!(text, ",{name}_fifth_{fifth}"));
    }
    text.push('\n');
    for row in stance_rows(judged) {
        let [start, end] = row.span_s;
        let names = [&row.trial.name, &row.trial.person, &row.trial.kind].map(|name| cell(name)).join(",");
        let _ = write!(text, "{names},{},{start},{end},{}", row.side.letter(), row.component.word());
        let whole = &row.whole;
        let rmse = row.fifths.map(|fifth| fifth.map_or(f64::NAN, |force| 100.0 * force.rmse_bw));
        let held = row.fifths.map(|fifth| fifth.map_or(f64::NAN, |force| 100.0 * force.band.holds));
        let of_whole = [
            100.0 * whole.rmse_bw,
            100.0 * whole.rrmse,
            whole.r,
            100.0 * whole.band.holds,
            whole.band.half_width_over_rmse,
        ];
        for x in of_whole.into_iter().chain(rmse).chain(held) {
            let _ = write!(text, ",{}", shown(x));
        }
        text.push('\n');
    }
    text
}

/// Columns of `means.csv` with their figures.
fn columns() -> Vec<(String, Figure)> {
    let mut columns = Vec::new();
    for of in Component::ALL {
        let word = of.word().replace('-', "_");
        let figures = [
            ("rmse_percent_bw", Figure::Rmse(of)),
            ("rrmse_percent", Figure::Relative(of)),
            ("r", Figure::Correlation(of)),
            ("in_band_percent", Figure::InBand(of)),
            ("band_over_rmse", Figure::BandWidth(of)),
        ];
        columns.extend(figures.map(|(name, figure)| (format!("{word}_{name}"), figure)));
    }
    columns.extend([
        ("cop_fore_aft_mm".to_owned(), Figure::CenterAlong),
        ("cop_lateral_mm".to_owned(), Figure::CenterAcross),
    ]);
    for joint in LegJoint::ALL {
        let word = joint.word();
        columns.push((format!("{word}_moment_rmse_n_m_kg"), Figure::Moment(joint)));
        columns.push((format!("{word}_moment_r"), Figure::MomentCorrelation(joint)));
    }
    columns.push(("events_ms".to_owned(), Figure::Events));
    columns
}

fn means_csv(judged: &[&JudgedTrial]) -> String {
    let columns = columns();
    let names: Vec<&str> = columns.iter().map(|(name, _)| name.as_str()).collect();
    let mut text = format!("of,trial,person,kind,trials,stances,{}\n", names.join(","));
    let mut row = |head: [&str; 4], own: &[&JudgedTrial], of: &dyn Fn(Figure) -> f64| {
        let stances: usize = own.iter().map(|trial| trial.stances.len()).sum();
        let figures: Vec<String> = columns.iter().map(|(_, figure)| shown(of(*figure))).collect();
        let head = head.map(cell).join(",");
        let _ = writeln!(text, "{head},{},{stances},{}", own.len(), figures.join(","));
    };
    for trial in judged {
        row(["trial", &trial.name, &trial.person, &trial.kind], &[*trial], &|figure| figure.of(&trial.agreement));
    }
    for person in persons(judged) {
        let of_person: Vec<&JudgedTrial> = judged.iter().filter(|trial| trial.person == person).copied().collect();
        for kind in kinds(&of_person) {
            let own: Vec<&JudgedTrial> = of_person.iter().filter(|trial| trial.kind == kind).copied().collect();
            let of = |figure: Figure| finite_mean(own.iter().map(|trial| figure.of(&trial.agreement)));
            row(["person", "", person, kind], &own, &of);
        }
    }
    for kind in kinds(judged) {
        let own: Vec<&JudgedTrial> = judged.iter().filter(|trial| trial.kind == kind).copied().collect();
        row(["kind", "", "", kind], &own, &|figure| over_kind(judged, kind, |trial| figure.of(&trial.agreement)));
    }
    text
}
