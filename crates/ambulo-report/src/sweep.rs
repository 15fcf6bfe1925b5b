//! Walks of a sweep over speeds, bodies and ground: tables, envelopes and a page.
//!
//! `sweep.csv` has one row per walk, side and percent of the gait cycle; `walks.csv` has one row per walk, with the
//! extremes of its curves. Quantities, signs and units are as in `clinical.csv` (docs/OUTPUTS.md), and angular
//! velocities [deg/s].

use super::clinical::{ClinicalGroup, ClinicalNames, ClinicalQuantity, clinical_quantities};
use super::figures::{CURVE_COLORS, Chart, ChartAxis, ChartCurve, ChartPanel, CurveForm, FigureError, PALE};
use super::html::{Document, escaped};
use ambulo::analysis::{CYCLE_SAMPLES, over_cycle_of};
use ambulo::model::Side;
use ambulo::numerics::Order;
use ambulo::study::Outcome;
use ambulo_formats::table::guarded;
use ambulo_results::{CycleRow, OutputFile, PAGE, WALKS, cycle_rows};
use std::collections::BTreeMap;
use std::fmt::Write;

const STYLE: &str = include_str!("../data/report/page.css");
const POLICY: &str = "default-src 'none'; style-src 'unsafe-inline'; img-src data:";

/// The conditions that a sweep varies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SweptConditions {
    /// Walking speed [m/s].
    pub speed_m_s: f64,
    /// Body mass [kg].
    pub mass_kg: f64,
    /// Stature [m].
    pub height_m: f64,
    /// Slope of the ground [%]; uphill is positive.
    pub slope_percent: f64,
    /// Carried load [kg].
    pub load_kg: f64,
}

/// Names of the conditions in tables, with the names and units on the page.
const CONDITIONS: [(&str, &str, &str); 5] = [
    ("speed_m_s", "speed", "m/s"),
    ("mass_kg", "mass", "kg"),
    ("height_m", "stature", "m"),
    ("slope_percent", "slope", "%"),
    ("load_kg", "load", "kg"),
];

impl SweptConditions {
    fn values(&self) -> [f64; 5] {
        [self.speed_m_s, self.mass_kg, self.height_m, self.slope_percent, self.load_kg]
    }
}

/// One walk of a sweep.
#[derive(Debug, Clone)]
pub struct SweptWalk {
    /// Conditions of the walk.
    pub conditions: SweptConditions,
    /// Curves of the walk, or why no walk was found.
    pub found: Result<WalkCurves, String>,
}

/// One gait cycle of each foot.
#[derive(Debug, Clone)]
pub struct WalkCurves {
    /// Step length [m].
    pub step_length_m: f64,
    /// Steps per minute.
    pub cadence: f64,
    /// The verdict in words.
    pub verdict: &'static str,
    /// Metabolic energy per distance, of a predicted walk [J/kg/m].
    pub cost_of_transport: Option<f64>,
    curves: Vec<SweptCurve>,
}

/// A quantity over a gait cycle.
#[derive(Debug, Clone)]
struct SweptCurve {
    /// `knee_flexion_moment`
    id: String,
    title: &'static str,
    group: Kind,
    /// Meaning of positive values.
    positive: &'static str,
    side: Side,
    /// At 0, 1, ... 100 %.
    values: Vec<f64>,
}

/// Kinds of quantities, in the order of the panels.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Kind {
    Angle,
    Velocity,
    Moment,
    Power,
    Ground,
}

impl Kind {
    fn words(self) -> [&'static str; 2] {
        match self {
            Kind::Angle => ["angle", "deg"],
            Kind::Velocity => ["velocity", "deg/s"],
            Kind::Moment => ["moment", "N·m/kg"],
            Kind::Power => ["power", "W/kg"],
            Kind::Ground => ["force", "body weights"],
        }
    }
}

impl WalkCurves {
    /// The first whole cycle of each foot of a computed walk. Moments, powers and ground forces are divided by
    /// `mass_kg`, the mass of the body without a load.
    #[must_use]
    pub fn of(
        outcome: &Outcome,
        mass_kg: f64,
        step_length_m: f64,
        cadence: f64,
        cost_of_transport: Option<f64>,
    ) -> WalkCurves {
        let (model, analysis) = (&outcome.body, &outcome.analysis);
        let rows: Vec<CycleRow> = cycle_rows(model, analysis).into_iter().filter(|row| row.cycle == 1).collect();
        let names = ClinicalNames::of_model(model);
        let quantities = clinical_quantities(&names, |name| rows.iter().any(|row| row.quantity == name));
        // Ground forces in the table of cycles are shares of all weight, with the load.
        let loaded = |quantity: &ClinicalQuantity| match quantity.group {
            ClinicalGroup::Ground => analysis.mass.kg / mass_kg,
            ClinicalGroup::Kinematics | ClinicalGroup::Moments | ClinicalGroup::Powers => 1.0,
        };
        let mut curves = Vec::new();
        for quantity in &quantities {
            for side in Side::BOTH {
                let own = rows.iter().find(|row| row.side == side && row.quantity == quantity.columns[side]);
                let factor = loaded(quantity) * quantity.factor(mass_kg, side);
                let values = own.map(|row| row.values.iter().map(|value| factor * value).collect());
                curves.extend(values.map(|values| SweptCurve::new(quantity, side, values)));
                curves.extend(velocity_of(outcome, quantity, side));
                curves.extend(power_of(&rows, quantity, &quantities, mass_kg, side));
            }
        }
        curves.sort_by_key(|curve| curve.side);
        let verdict = outcome.verdict.state.words();
        WalkCurves { step_length_m, cadence, verdict, cost_of_transport, curves }
    }

    fn curve(&self, id: &str, side: Side) -> Option<&[f64]> {
        self.curves.iter().find(|curve| curve.id == id && curve.side == side).map(|curve| &curve.values[..])
    }
}

impl SweptCurve {
    fn new(quantity: &ClinicalQuantity, side: Side, values: Vec<f64>) -> SweptCurve {
        let group = match quantity.group {
            ClinicalGroup::Kinematics => Kind::Angle,
            ClinicalGroup::Moments => Kind::Moment,
            ClinicalGroup::Powers => Kind::Power,
            ClinicalGroup::Ground => Kind::Ground,
        };
        let (id, title, positive) = (quantity.id.to_owned(), quantity.title, quantity.positive);
        SweptCurve { id, title, group, positive, side, values }
    }
}

/// The angular velocity over the first cycle of a foot [deg/s].
fn velocity_of(outcome: &Outcome, quantity: &ClinicalQuantity, side: Side) -> Option<SweptCurve> {
    if quantity.group != ClinicalGroup::Kinematics {
        return None;
    }
    let trajectory = &outcome.analysis.trajectory;
    let cycle = outcome.analysis.cycles.iter().find(|cycle| cycle.side == side && cycle.number == 1)?;
    let rates = trajectory.rates(outcome.body.coordinate(&quantity.coordinates[side])?);
    let factor = quantity.factor(1.0, side);
    let values = over_cycle_of(trajectory.grid(), |frame| factor * rates[frame].to_degrees(), cycle);
    let curve = SweptCurve::new(quantity, side, values);
    let id = format!("{}_velocity", quantity.id.strip_suffix("_angle").unwrap_or(quantity.id));
    Some(SweptCurve { id, group: Kind::Velocity, ..curve })
}

/// The power of a movement without a power panel [W/kg].
fn power_of(
    rows: &[CycleRow],
    quantity: &ClinicalQuantity,
    known: &[ClinicalQuantity],
    mass_kg: f64,
    side: Side,
) -> Option<SweptCurve> {
    let id = format!("{}_power", quantity.id.strip_suffix("_moment")?);
    let name = format!("{}_power", quantity.columns[side].strip_suffix("_moment")?);
    let row = rows.iter().find(|row| row.side == side && row.quantity == name)?;
    let values = row.values.iter().map(|value| value / mass_kg).collect();
    let curve = SweptCurve { id, group: Kind::Power, positive: "generated", ..SweptCurve::new(quantity, side, values) };
    (!known.iter().any(|other| other.id == curve.id)).then_some(curve)
}

/// The files of a sweep: `sweep.csv`, `walks.csv`, `figures/*.svg` and `report.html`; `title` states what was swept.
///
/// # Errors
/// A style that cannot be read.
pub fn sweep_files(title: &str, walks: &[SweptWalk]) -> Result<Vec<OutputFile<'static>>, FigureError> {
    let sweep = Sweep::new(walks);
    let mut files = vec![
        OutputFile::new("sweep.csv", sweep.curves_csv().into_bytes()),
        OutputFile::new(WALKS, sweep.walks_csv().into_bytes()),
    ];
    let mut pictures = Vec::new();
    for (name, heading, rows) in FIGURES {
        let Some(chart) = sweep.chart(name, heading, rows) else { continue };
        let svg = chart.svg()?;
        files.push(OutputFile::new(format!("figures/{name}.svg"), svg.clone().into_bytes()));
        pictures.push((heading, svg));
    }
    files.push(sweep.page(title, &pictures));
    Ok(files)
}

/// A row of panels: start of the names of its quantities, and the movement; empty where quantities have titles of their
/// own.
type Row = (&'static str, &'static str);

/// Figures: file, heading, rows.
const FIGURES: [(&str, &str, &[Row]); 4] = [
    ("hip", "Hip", &[("hip_flexion", "Flexion"), ("hip_adduction", "Adduction")]),
    ("knee", "Knee", &[("knee_flexion", "Flexion")]),
    ("ankle", "Ankle", &[("ankle_dorsiflexion", "Dorsiflexion")]),
    ("ground", "Ground force on a foot", &[("ground_force", "")]),
];
/// Curves of at most this many walks, or values of a condition, have their own line.
const MOST_LINES: usize = 6;
/// Width of a figure [mm], and height of its axes [pt].
const SIZE: (f64, f64) = (260.0, 110.0);

/// All walks, and the names of their quantities.
struct Sweep<'a> {
    walks: &'a [SweptWalk],
    /// Names of the quantities in the order of the tables.
    ids: Vec<String>,
    /// Number of the condition whose values have colours.
    colored: usize,
}

impl<'a> Sweep<'a> {
    fn new(walks: &'a [SweptWalk]) -> Sweep<'a> {
        let mut ids: Vec<String> = Vec::new();
        for curve in walks.iter().filter_map(|walk| walk.found.as_ref().ok()).flat_map(|found| &found.curves) {
            if !ids.contains(&curve.id) {
                ids.push(curve.id.clone());
            }
        }
        let varies = |k: &usize| {
            walks.iter().any(|walk| walk.conditions.values()[*k].total_cmp(&walks[0].conditions.values()[*k]).is_ne())
        };
        Sweep { walks, ids, colored: (0..CONDITIONS.len()).find(varies).unwrap_or(0) }
    }

    fn found(&self) -> impl Iterator<Item = (usize, &'a SweptWalk, &'a WalkCurves)> {
        self.walks.iter().enumerate().filter_map(|(i, walk)| Some((i + 1, walk, walk.found.as_ref().ok()?)))
    }

    fn curves_csv(&self) -> String {
        let conditions = CONDITIONS.map(|(name, ..)| name).join(",");
        let mut text = format!("walk,{conditions},side,percent,{}\n", self.ids.join(","));
        for (number, walk, found) in self.found() {
            let conditions = walk.conditions.values().map(|value| value.to_string()).join(",");
            for side in Side::BOTH {
                let curves: Vec<Option<&[f64]>> = self.ids.iter().map(|id| found.curve(id, side)).collect();
                for percent in 0..CYCLE_SAMPLES {
                    let _ = write!(text, "{number},{conditions},{},{percent}", side.letter());
                    for curve in &curves {
                        let _ = write!(text, ",{}", curve.map_or(String::new(), |values| values[percent].to_string()));
                    }
                    text.push('\n');
                }
            }
        }
        text
    }

    fn walks_csv(&self) -> String {
        let conditions = CONDITIONS.map(|(name, ..)| name).join(",");
        let mut text = format!("walk,{conditions},step_length_m,cadence_steps_min,verdict,cost_of_transport_j_kg_m");
        for id in &self.ids {
            let _ = write!(text, ",{id}_min,{id}_max");
        }
        text += ",not_found_because\n";
        for (i, walk) in self.walks.iter().enumerate() {
            let conditions = walk.conditions.values().map(|value| value.to_string()).join(",");
            let _ = write!(text, "{},{conditions}", i + 1);
            match &walk.found {
                Ok(found) => {
                    let cost = found.cost_of_transport.map_or(String::new(), |cost| cost.to_string());
                    let _ = write!(text, ",{},{},{},{cost}", found.step_length_m, found.cadence, found.verdict);
                    for id in &self.ids {
                        let [low, high] = extremes(found, id)
                            .map_or([const { String::new() }; 2], |ends| ends.map(|x| x.to_string()));
                        let _ = write!(text, ",{low},{high}");
                    }
                    text += ",\n";
                }
                Err(reason) => {
                    let empty = ",".repeat(4 + 2 * self.ids.len());
                    let _ = writeln!(text, "{empty},{}", guarded(reason));
                }
            }
        }
        text
    }

    /// Rows of panels, with a column for each kind of quantity.
    fn chart(&self, name: &'static str, heading: &str, rows: &[Row]) -> Option<Chart> {
        let mut panels = Vec::new();
        for (stem, movement) in rows {
            let of_stem = |id: &&String| id.strip_prefix(stem).is_some_and(|rest| rest.starts_with('_'));
            let mut ids: Vec<&String> = self.ids.iter().filter(of_stem).collect();
            ids.sort_by_key(|id| self.example(id).map(|curve| curve.group));
            panels.extend(ids.into_iter().filter_map(|id| self.panel(id, movement)));
        }
        let columns = panels.len() / rows.len().max(1);
        (!panels.is_empty()).then(|| Chart {
            name,
            title: heading.to_owned(),
            caption: String::new(),
            width_mm: SIZE.0,
            columns,
            panel_height_pt: SIZE.1,
            panels,
            notes: Vec::new(),
        })
    }

    fn example(&self, id: &str) -> Option<&'a SweptCurve> {
        self.found().flat_map(|(.., found)| &found.curves).find(|curve| curve.id == id)
    }

    /// The envelope of all walks, and the mean of walks with the same value of the coloured condition.
    fn panel(&self, id: &str, movement: &str) -> Option<ChartPanel> {
        let example = self.example(id)?;
        let mut groups: BTreeMap<String, (f64, Vec<&[f64]>)> = BTreeMap::new();
        for (_, walk, found) in self.found() {
            let value = walk.conditions.values()[self.colored];
            let curve = found.curve(id, Side::Right)?;
            groups.entry(format!("{value:020.6}")).or_insert((value, Vec::new())).1.push(curve);
        }
        let all = || groups.values().flat_map(|(_, curves)| curves.iter().copied());
        let edge = |of: fn(f64, f64) -> f64| {
            move |i: usize, curves: &mut dyn Iterator<Item = &[f64]>| {
                curves.map(|curve| curve[i]).reduce(of).map(|y| [i as f64, y])
            }
        };
        let upper = (0..CYCLE_SAMPLES).filter_map(|i| edge(f64::max)(i, &mut all()));
        let lower = (0..CYCLE_SAMPLES).rev().filter_map(|i| edge(f64::min)(i, &mut all()));
        let area = ChartCurve {
            name: "all walks".to_owned(),
            color: PALE,
            form: CurveForm::Area,
            points: upper.chain(lower).collect(),
        };
        let (_, what, unit) = CONDITIONS[self.colored];
        let mut shown: Vec<&(f64, Vec<&[f64]>)> = groups.values().collect();
        shown.sort_by_number(|(value, ..)| *value);
        let every = shown.len().div_ceil(MOST_LINES).max(1);
        let line = |(k, (value, curves)): (usize, &(f64, Vec<&[f64]>))| ChartCurve {
            name: format!("{what} {value} {unit}"),
            color: CURVE_COLORS[k % CURVE_COLORS.len()],
            form: CurveForm::Line,
            points: (0..CYCLE_SAMPLES)
                .map(|i| [i as f64, curves.iter().map(|curve| curve[i]).sum::<f64>() / curves.len() as f64])
                .collect(),
        };
        let lines = shown.into_iter().step_by(every).enumerate().map(line);
        let [word, unit] = example.group.words();
        let positive = example.positive;
        let title = if movement.is_empty() { example.title.to_owned() } else { format!("{movement}: {word}") };
        Some(ChartPanel {
            title,
            abscissa: ChartAxis { range: Some([0.0, 100.0]), ..ChartAxis::labelled("gait cycle (%)") },
            ordinate: ChartAxis::labelled(format!("{unit}, {positive} +")),
            curves: std::iter::once(area).chain(lines).collect(),
            ..ChartPanel::default()
        })
    }

    fn page(&self, title: &str, pictures: &[(&str, String)]) -> OutputFile<'static> {
        let count = self.found().count();
        let figures: String = pictures
            .iter()
            .map(|(heading, svg)| {
                let svg = svg.replacen("<svg ", &format!("<svg aria-label=\"{heading}\" "), 1);
                format!("<p class=\"picture\">{svg}</p>\n")
            })
            .collect();
        let body = format!(
            r#"<header>
<h1>Forces of {count} walks</h1>
<p>{title}. <span class="soft">Ambulo {version}</span></p>
</header>
<main>
<h2>Extremes</h2>
<p class="soft">Largest internal moments, powers and angular velocities of either leg in a gait cycle. All extremes: walks.csv. All curves: sweep.csv.</p>
{table}
<h2>Envelopes</h2>
<p class="soft">Right leg, over its gait cycle. Grey: least and largest value of all walks. Lines: mean of the walks with the same {colored}.
Moments are internal; powers are positive where they are generated. Masses and weights are those of the body without the load.</p>
{figures}
</main>"#,
            title = escaped(title),
            version = env!("CARGO_PKG_VERSION"),
            table = self.table(),
            colored = CONDITIONS[self.colored].1,
        );
        // On a narrow screen, figures scroll: their letters would be too small.
        let style = format!("{STYLE}\n.picture svg {{ min-width: 46rem; }}");
        let page = Document { title: "Forces of a sweep of walks", policy: POLICY, style: &style, body: &body };
        OutputFile::new(PAGE, page.html().into_bytes())
    }

    fn table(&self) -> String {
        let mut html = String::from("<div class=\"scroll\"><table>\n<thead><tr><th scope=\"col\">Walk</th>");
        let head = |text: String| format!("<th scope=\"col\" class=\"number\">{}</th>", escaped(&text));
        html.extend(CONDITIONS.map(|(_, name, unit)| head(format!("{name} [{unit}]"))));
        html += &head("cadence [steps/min]".to_owned());
        html.extend(PEAKS.map(|peak| head(format!("{} [{}]", peak.title, peak.unit))));
        html += "<th scope=\"col\">Verdict</th></tr></thead>\n<tbody>\n";
        for (i, walk) in self.walks.iter().enumerate() {
            let _ = write!(html, "<tr><th scope=\"row\">{}</th>", i + 1);
            let cell = |text: String| format!("<td class=\"number\">{text}</td>");
            html.extend(walk.conditions.values().map(|value| cell(value.to_string())));
            match &walk.found {
                Ok(found) => {
                    html += &cell(format!("{:.0}", found.cadence));
                    html.extend(PEAKS.map(|peak| cell(peak.shown(found, walk.conditions.mass_kg))));
                    let _ = writeln!(html, "<td>{}</td></tr>", found.verdict);
                }
                Err(reason) => {
                    let _ = writeln!(html, "<td colspan=\"{}\">{}</td></tr>", PEAKS.len() + 2, escaped(reason));
                }
            }
        }
        html + "</tbody></table></div>"
    }
}

/// A column of the table of extremes.
struct Peak {
    title: &'static str,
    unit: &'static str,
    id: &'static str,
    /// Largest, else smallest value.
    is_largest: bool,
    /// Whether the number is multiplied by the body mass.
    of_mass: bool,
}

const fn peak(title: &'static str, unit: &'static str, id: &'static str, is_largest: bool, of_mass: bool) -> Peak {
    Peak { title, unit, id, is_largest, of_mass }
}

const PEAKS: [Peak; 9] = [
    peak("hip extensor moment", "N·m", "hip_flexion_moment", true, true),
    peak("hip flexor moment", "N·m", "hip_flexion_moment", false, true),
    peak("hip power", "W", "hip_flexion_power", true, true),
    peak("knee extensor moment", "N·m", "knee_flexion_moment", true, true),
    peak("knee power absorbed", "W", "knee_flexion_power", false, true),
    peak("ankle plantarflexor moment", "N·m", "ankle_dorsiflexion_moment", true, true),
    peak("ankle power", "W", "ankle_dorsiflexion_power", true, true),
    peak("ankle plantarflexion velocity", "deg/s", "ankle_dorsiflexion_velocity", false, false),
    peak("vertical ground force", "body weights", "ground_force_vertical", true, false),
];

impl Peak {
    fn shown(&self, found: &WalkCurves, mass_kg: f64) -> String {
        let Some([low, high]) = extremes(found, self.id) else { return "-".to_owned() };
        let value = if self.is_largest { high } else { low } * if self.of_mass { mass_kg } else { 1.0 };
        let digits = if value.abs() < 10.0 { 2 } else { 0 };
        format!("{value:.digits$}")
    }
}

/// Smallest and largest value of a quantity on either side.
fn extremes(found: &WalkCurves, id: &str) -> Option<[f64; 2]> {
    let values = || Side::BOTH.into_iter().filter_map(|side| found.curve(id, side)).flatten().copied();
    Some([values().reduce(f64::min)?, values().reduce(f64::max)?])
}
