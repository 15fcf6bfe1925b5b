//! Draws curves over any abscissa: panels in columns, with one legend for all panels or one per panel.

use super::FigureError;
use super::axes::{Axes, AxisWords, Ticks, range};
use super::sheet::{Legend, Sample, Sheet, Slot, axes_width};
use super::svg::{Drawing, Stroke};
use crate::style::{Style, style};

/// Colours of curves: the palette of Okabe and Ito for colour-blind eyes (unverified), with black and grey.
pub const CURVE_COLORS: [&str; 8] =
    ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#000000", "#56B4E9", "#E69F00", "#787878"];
/// The colour of curves that are only for comparison.
pub const PALE: &str = "#A0A0A0";

/// Longer curves are thinned to this number of points.
const MOST_POINTS: usize = 2000;
/// Radius of points [pt].
const DOT: f64 = 1.7;
/// Height of the bar that marks an infeasible part [pt].
const BAR: f64 = 2.5;
/// Margin of panels with equal scales, as a share of the range.
const SCALE_MARGIN: f64 = 0.03;
/// The smallest range of an ordinate, as a share of its largest number, and as a number.
const LEAST_SHARE: f64 = 1e-4;
const LEAST: f64 = 1e-12;
/// The range of an ordinate whose numbers are all zero.
const LEAST_OF_ZEROS: f64 = 1.0;

/// A figure of curves.
#[derive(Debug, Clone, PartialEq)]
pub struct Chart {
    /// Name of the file without its ending; also the start of the ids of the panels.
    pub name: &'static str,
    /// Title above the panels.
    pub title: String,
    /// Caption below the title; may be empty.
    pub caption: String,
    /// Width of the figure [mm].
    pub width_mm: f64,
    /// Number of panels side by side.
    pub columns: usize,
    /// Height of the axes [pt]; panels to scale choose their own.
    pub panel_height_pt: f64,
    /// From left to right, then from top to bottom. Only the lowest panel of a column shows the label of its abscissa.
    pub panels: Vec<ChartPanel>,
    /// Notes below the panels.
    pub notes: Vec<String>,
}

/// The curves over one pair of axes.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ChartPanel {
    /// Title above the axes.
    pub title: String,
    /// Horizontal axis.
    pub abscissa: ChartAxis,
    /// Vertical axis.
    pub ordinate: ChartAxis,
    /// Whether a unit has the same length along both axes.
    pub to_scale: bool,
    /// Curves in the order of drawing.
    pub curves: Vec<ChartCurve>,
    /// Parts of the abscissa that are not feasible, marked red.
    pub infeasible: Vec<[f64; 2]>,
}

/// One axis.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ChartAxis {
    /// Quantity and unit.
    pub label: String,
    /// First and last number; `None` for the range of the curves.
    pub range: Option<[f64; 2]>,
    /// Ticks with their labels; round numbers if there are none.
    pub ticks: Vec<(f64, String)>,
}

/// A curve, or a set of points.
#[derive(Debug, Clone, PartialEq)]
pub struct ChartCurve {
    /// Name in the legend; a curve without a name is not listed.
    pub name: String,
    /// `#RRGGBB`
    pub color: &'static str,
    /// How the points are drawn.
    pub form: CurveForm,
    /// Abscissa and ordinate.
    pub points: Vec<[f64; 2]>,
}

/// How the points of a curve are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CurveForm {
    /// A line.
    Line,
    /// A thin line.
    Thin,
    /// Points.
    Dots,
    /// A line with its points.
    DottedLine,
    /// A filled area with the points as its corners.
    Area,
}

impl ChartAxis {
    /// An axis with a label, over the range of its curves, with ticks at round numbers.
    #[must_use]
    pub fn labelled(label: impl Into<String>) -> ChartAxis {
        ChartAxis { label: label.into(), ..ChartAxis::default() }
    }

    fn ticks(&self) -> Ticks<'_> {
        if self.ticks.is_empty() { Ticks::Round } else { Ticks::Given(&self.ticks) }
    }
}

impl Chart {
    /// The figure as SVG.
    ///
    /// # Errors
    /// A style that cannot be read.
    pub fn svg(&self) -> Result<String, FigureError> {
        let style = style().map_err(|e| FigureError { name: self.name, reason: e.to_string() })?;
        let columns = self.columns.max(1);
        let (legend, panel_legends) = self.legends(style);
        let sheet = Sheet {
            style,
            title: &self.title,
            caption: &self.caption,
            width_mm: self.width_mm,
            rows: (0..self.panels.len()).step_by(columns).map(|i| i..(i + columns).min(self.panels.len())).collect(),
            panel_height: self.panel_height(),
            legend,
            panel_legends,
            notes: self.notes.clone(),
            description: self.panels.iter().map(ChartPanel::description).collect::<Vec<_>>().join(" "),
        };
        Ok(sheet.draw(|drawing, slot| {
            let id = format!("{}-{}", self.name, slot.number + 1);
            self.panels[slot.number].draw(drawing, style, slot, id);
        }))
    }

    /// One legend for the figure if no panel contradicts it, else one per panel.
    fn legends<'a>(&'a self, style: &'a Style) -> (Legend<'a>, Vec<Legend<'a>>) {
        let own: Vec<Legend<'a>> = self.panels.iter().map(|panel| panel.legend(style)).collect();
        let mut common = own.iter().max_by_key(|legend| legend.len()).cloned().unwrap_or_default();
        let is_common = own.iter().flatten().all(|entry| common.contains(entry));
        if self.panels.iter().any(|panel| !panel.infeasible.is_empty()) {
            let stroke = Stroke::solid(&style.infeasible.color, BAR);
            let entry = (Sample::Line(stroke), "red: not feasible".to_owned());
            if !is_common {
                return (vec![entry], own);
            }
            common.push(entry);
        }
        if is_common { (common, Vec::new()) } else { (Legend::new(), own) }
    }

    fn panel_height(&self) -> f64 {
        let width = axes_width(self.width_mm, self.columns);
        let to_scale = self.panels.iter().filter(|panel| panel.to_scale).map(|panel| {
            let [[left, right], [low, high]] = panel.ranges();
            width * (high - low) / (right - left)
        });
        to_scale.reduce(f64::max).unwrap_or(self.panel_height_pt)
    }
}

impl ChartPanel {
    fn description(&self) -> String {
        let names: Vec<&str> = self.curves.iter().map(|curve| curve.name.as_str()).filter(|n| !n.is_empty()).collect();
        let of = if names.is_empty() { String::new() } else { format!(": {}", names.join(", ")) };
        format!("{} ({} over {}){of}.", self.title, self.ordinate.label, self.abscissa.label)
    }

    fn legend<'a>(&'a self, style: &'a Style) -> Legend<'a> {
        let named = self.curves.iter().filter(|curve| !curve.name.is_empty());
        named.map(|curve| (curve.sample(style), curve.name.clone())).collect()
    }

    /// Ranges of abscissa and ordinate.
    fn ranges(&self) -> [[f64; 2]; 2] {
        let numbers = |k: usize| self.curves.iter().flat_map(|curve| &curve.points).map(move |point| point[k]);
        let along = self.abscissa.range.unwrap_or_else(|| {
            let exact = numbers(0).filter(|x| x.is_finite()).fold(None, |range: Option<[f64; 2]>, x| {
                Some(range.map_or([x, x], |[low, high]| [low.min(x), high.max(x)]))
            });
            let [low, high] = exact.unwrap_or([0.0, 1.0]);
            let margin = if self.to_scale { SCALE_MARGIN * (high - low) } else { 0.0 };
            if low < high { [low - margin, high + margin] } else { [low - 0.5, low + 0.5] }
        });
        let up = self.ordinate.range.unwrap_or_else(|| {
            let largest = numbers(1).filter(|y| y.is_finite()).fold(0.0_f64, |largest, y| largest.max(y.abs()));
            let least = if largest > 0.0 { (LEAST_SHARE * largest).max(LEAST) } else { LEAST_OF_ZEROS };
            range(numbers(1), least)
        });
        [along, up]
    }

    /// Axes over the ranges; to scale, the range that would be too short is made longer on both sides.
    fn axes(&self, place: [f64; 4]) -> Axes<'_> {
        let [mut along, mut up] = self.ranges();
        if self.to_scale {
            let [left, top, right, bottom] = place;
            let unit = ((along[1] - along[0]) / (right - left)).max((up[1] - up[0]) / (bottom - top));
            let widened = |[low, high]: [f64; 2], length: f64| {
                let (middle, half) = (0.5 * (low + high), 0.5 * unit * length);
                [middle - half, middle + half]
            };
            (along, up) = (widened(along, right - left), widened(up, bottom - top));
        }
        Axes { place, along, up, ticks: [self.abscissa.ticks(), self.ordinate.ticks()] }
    }

    fn draw(&self, drawing: &mut Drawing, style: &Style, slot: Slot, id: String) {
        let axes = self.axes(slot.place);
        let mut attributes = vec![("id", id)];
        attributes.extend(axes.attributes());
        drawing.open("", &attributes);
        for curve in self.curves.iter().filter(|curve| curve.form == CurveForm::Area) {
            curve.draw(drawing, style, &axes);
        }
        axes.draw_ground(drawing, style);
        axes.draw_columns(drawing, style);
        for part in &self.infeasible {
            draw_infeasible(drawing, style, &axes, *part);
        }
        for curve in self.curves.iter().filter(|curve| curve.form != CurveForm::Area) {
            curve.draw(drawing, style, &axes);
        }
        let words = AxisWords {
            title: &self.title,
            unit: &self.ordinate.label,
            directions: [""; 2],
            abscissa: slot.named.then_some(&self.abscissa.label),
            legend_height: slot.legend_height,
        };
        axes.draw_frame(drawing, style, words);
        drawing.close();
    }
}

impl ChartCurve {
    fn stroke<'a>(&self, style: &'a Style) -> Stroke<'a> {
        let width = if self.form == CurveForm::Thin { style.lines_pt.cycle } else { 0.8 * style.lines_pt.mean };
        Stroke::solid(self.color, width)
    }

    fn sample<'a>(&self, style: &'a Style) -> Sample<'a> {
        match self.form {
            CurveForm::Dots => Sample::Dot(self.color),
            CurveForm::Area => Sample::Patch(self.color, 1.0),
            CurveForm::Line | CurveForm::Thin | CurveForm::DottedLine => Sample::Line(self.stroke(style)),
        }
    }

    fn draw(&self, drawing: &mut Drawing, style: &Style, axes: &Axes<'_>) {
        let every = self.points.len().div_ceil(MOST_POINTS).max(1);
        let points: Vec<[f64; 2]> = self.points.iter().step_by(every).map(|point| axes.at(*point)).collect();
        if self.form == CurveForm::Area {
            drawing.polygon(&points, self.color, 1.0, &[("data-name", self.name.clone())]);
            return;
        }
        if self.form != CurveForm::Dots {
            drawing.polyline(&points, self.stroke(style), &[("data-name", self.name.clone())]);
        }
        if matches!(self.form, CurveForm::Dots | CurveForm::DottedLine) {
            points.iter().for_each(|point| drawing.circle(*point, DOT, self.color));
        }
    }
}

/// A red bar above the abscissa, at least as long as it is high.
fn draw_infeasible(drawing: &mut Drawing, style: &Style, axes: &Axes<'_>, part: [f64; 2]) {
    let [left, _, right, bottom] = axes.place;
    let [from, to] = part.map(|x| axes.x(x).clamp(left, right));
    let from = from.min(right - BAR);
    let to = to.max(from + BAR);
    let corners = [[from, bottom - BAR], [to, bottom - BAR], [to, bottom], [from, bottom]];
    drawing.polygon(&corners, &style.infeasible.color, 1.0, &[("data-role", "infeasible".to_owned())]);
}
