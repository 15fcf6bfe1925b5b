//! Figures over time: residual forces, and predicted ground forces with the measured ones.

use super::FigureError;
use super::axes::{Axes, AxisWords, range};
use super::cycle_panel::dashes;
use super::sheet::{Sample, Sheet, Slot};
use super::svg::{Drawing, Stroke};
use crate::style::{Style, style};
use ambulo::analysis::{Analysis, Residual, residual_sizes};
use ambulo::ground::predict::Prediction;
use ambulo::ground::{BodyForces, feet};
use ambulo::model::{Model, Side};
use ambulo::spatial::Vec3;

const HEIGHT: f64 = 84.0;
/// Curves of longer recordings are thinned to this number of points.
const MOST_POINTS: usize = 2000;
/// Half width in standard deviations of the band that contains 90 % of the true values (docs/GROUND_FORCES.md).
const DEVIATES: f64 = 1.645;

/// A line over time.
struct Series<'a> {
    role: &'a str,
    side: Option<Side>,
    values: Vec<f64>,
    /// Half width of its band.
    spread: Option<Vec<f64>>,
    stroke: Stroke<'a>,
}

/// One set of axes.
struct Panel<'a> {
    id: &'a str,
    title: &'a str,
    unit: String,
    directions: [&'a str; 2],
    least: f64,
    series: Vec<Series<'a>>,
}

/// `quality.svg`: magnitude of the residual force and moment at the root over time, relative to body weight. `None` if
/// the ground forces are not known, or without frames.
///
/// # Errors
/// A style that cannot be read.
pub(crate) fn residual_figure(
    model: &Model,
    analysis: &Analysis,
    caption: &str,
) -> Result<Option<String>, FigureError> {
    let style = style().map_err(|e| FigureError { name: "quality.svg", reason: e.to_string() })?;
    let sizes = residual_sizes(model, &analysis.forces);
    if analysis.ground.bodies.is_empty() || sizes.len() < 2 {
        return Ok(None);
    }
    let weight = analysis.mass.kg * model.gravity().norm();
    let stroke = Stroke::solid(&style.text.color, 0.8 * style.lines_pt.mean);
    let line = |values: Vec<f64>| vec![Series { role: "residual", side: None, values, spread: None, stroke }];
    let [force, moment] = [0, 1].map(|k| sizes.iter().map(|size| size[k]).collect::<Vec<f64>>());
    let note = residual_note(analysis.residual, weight);
    let directions = ["", ""];
    let panels = [
        Panel {
            id: "residual_force",
            title: "Residual force",
            unit: "N".into(),
            directions,
            least: 1.0,
            series: line(force),
        },
        Panel {
            id: "residual_moment",
            title: "Residual moment",
            unit: "N·m".into(),
            directions,
            least: 0.2,
            series: line(moment),
        },
    ];
    let figure =
        TimeFigure { style, title: "Residual force and moment", caption, legend: Vec::new(), notes: vec![note] };
    Ok(Some(figure.draw(&analysis.trajectory.grid().times(), &panels)))
}

/// The size of the residual where all ground forces are known, and what it is.
fn residual_note(residual: Option<Residual>, weight_n: f64) -> String {
    let about =
        "The motion requires them, but neither joints nor ground supply them: errors of motion, body and forces.";
    let Some(Residual { force_rms_n, moment_rms_nm, .. }) = residual else { return about.to_owned() };
    let percent = 100.0 * force_rms_n / weight_n.max(f64::MIN_POSITIVE);
    format!(
        "Root mean square where all ground forces are known: {force_rms_n:.1} N ({percent:.1} % of body weight) and \
         {moment_rms_nm:.1} N·m. {about}"
    )
}

/// A motion with predicted forces.
#[derive(Clone, Copy)]
pub(crate) struct PredictedMotion<'a> {
    /// The analysis with predicted forces.
    pub analysis: &'a Analysis,
    /// The prediction.
    pub prediction: &'a Prediction,
    /// The same motion with measured forces; `None` without plates.
    pub measured: Option<&'a Analysis>,
}

/// `prediction.svg`: predicted ground forces over time with their uncertainty, and the measured forces if there are
/// plates.
///
/// # Errors
/// A style that cannot be read.
pub(crate) fn prediction_figure(
    model: &Model,
    predicted: PredictedMotion<'_>,
    caption: &str,
) -> Result<Option<String>, FigureError> {
    let style = style().map_err(|e| FigureError { name: "prediction.svg", reason: e.to_string() })?;
    let grid = predicted.analysis.trajectory.grid();
    let weight = predicted.analysis.mass.kg * model.gravity().norm();
    if grid.frames < 2 || weight <= 0.0 {
        return Ok(None);
    }
    let dash = dashes(style, Side::Left);
    let shown = Shown { style, dash: &dash, weight, frames: grid.frames };
    let up = model.up();
    let forward = Vec3::x();
    let axes = [
        ("vertical", "Vertical", up, ["up", ""]),
        ("fore_aft", "Fore-aft", forward, ["forward", "backward"]),
        ("lateral", "Sideways", forward.cross(&up), ["right", "left"]),
    ];
    let panels = axes.map(|(id, title, axis, directions)| Panel {
        id,
        title,
        unit: "BW".into(),
        directions,
        least: 0.05,
        series: shown.series(model, predicted, axis),
    });
    let mut legend = Vec::new();
    for (side, name) in [(Side::Right, "right, predicted"), (Side::Left, "left, predicted")] {
        legend.push((Sample::Line(shown.line(side)), name.to_owned()));
    }
    legend.push((Sample::Patch(&style.right.color, style.uncertainty_opacity), "90 % uncertainty".to_owned()));
    if predicted.measured.is_some() {
        legend.push((Sample::Line(shown.measured(Side::Right)), "plates, right".to_owned()));
        legend.push((Sample::Line(shown.measured(Side::Left)), "plates, left".to_owned()));
    }
    let notes = vec![format!(
        "Bands: the prediction ± {DEVIATES} of its own standard deviations. Method for double support: {}. Measured \
         forces are drawn while a plate is loaded.",
        predicted.prediction.rule
    )];
    let figure = TimeFigure { style, title: "Predicted ground forces", caption, legend, notes };
    Ok(Some(figure.draw(&grid.times(), &panels)))
}

/// How predicted and measured forces are drawn.
struct Shown<'a> {
    style: &'a Style,
    dash: &'a [f64],
    weight: f64,
    frames: usize,
}

impl<'a> Shown<'a> {
    fn dash(&self, side: Side) -> &'a [f64] {
        if side == Side::Left { self.dash } else { &[] }
    }

    fn line(&self, side: Side) -> Stroke<'a> {
        let width = 0.8 * self.style.lines_pt.mean;
        Stroke { dash: self.dash(side), ..Stroke::solid(&self.style.side(side).color, width) }
    }

    fn measured(&self, side: Side) -> Stroke<'a> {
        let style = self.style;
        Stroke { dash: self.dash(side), ..Stroke::solid(&style.measured.color, 1.2 * style.lines_pt.cycle) }
    }

    fn series(&self, model: &Model, predicted: PredictedMotion<'_>, axis: Vec3) -> Vec<Series<'a>> {
        let along = |foot: &BodyForces| foot.force.iter().map(|f| f.dot(&axis) / self.weight).collect::<Vec<f64>>();
        let mut series = Vec::new();
        for (side, foot) in feet(model, &predicted.analysis.ground) {
            let deviation = predicted.prediction.deviations.iter().find(|deviation| deviation.side == side);
            // Along an axis that is not a world axis, the deviations of the components count as independent.
            let spread = deviation
                .map(|d| d.force.iter().map(|f| DEVIATES * f.component_mul(&axis).norm() / self.weight).collect());
            series.push(Series {
                role: "predicted",
                side: Some(side),
                values: along(&foot),
                spread,
                stroke: self.line(side),
            });
        }
        for (side, foot) in predicted.measured.iter().flat_map(|measured| feet(model, &measured.ground)) {
            // Without load it is not known whether the foot was on a plate.
            let loaded = |frame: usize| !foot.center_of_pressure[frame].x.is_nan();
            let known = |(frame, x)| if loaded(frame) { x } else { f64::NAN };
            let values: Vec<f64> = along(&foot).into_iter().enumerate().map(known).collect();
            if values.len() == self.frames {
                series.push(Series {
                    role: "measured",
                    side: Some(side),
                    values,
                    spread: None,
                    stroke: self.measured(side),
                });
            }
        }
        series
    }
}

/// Panels below each other over the same time.
struct TimeFigure<'a> {
    style: &'a Style,
    title: &'a str,
    caption: &'a str,
    legend: Vec<(Sample<'a>, String)>,
    notes: Vec<String>,
}

impl TimeFigure<'_> {
    fn draw(&self, times: &[f64], panels: &[Panel<'_>]) -> String {
        let words = panels.iter().map(|panel| format!("{} ({}) over time.", panel.title, panel.unit));
        let sheet = Sheet {
            style: self.style,
            title: self.title,
            caption: self.caption,
            width_mm: self.style.widths_mm.two_columns,
            rows: (0..panels.len()).map(|number| number..number + 1).collect(),
            panel_height: HEIGHT,
            legend: self.legend.clone(),
            description: words.chain(self.notes.iter().cloned()).collect::<Vec<_>>().join(" "),
            notes: self.notes.clone(),
            panel_legends: Vec::new(),
        };
        sheet.draw(|drawing, slot| self.draw_panel(drawing, &panels[slot.number], times, slot))
    }

    fn draw_panel(&self, drawing: &mut Drawing, panel: &Panel<'_>, times: &[f64], slot: Slot) {
        let edges = panel.series.iter().flat_map(|series| {
            let spread = |i: usize| series.spread.as_ref().and_then(|s| s.get(i)).copied().unwrap_or(0.0);
            series.values.iter().enumerate().flat_map(move |(i, x)| [x - spread(i), x + spread(i)])
        });
        let along = [times.first().copied().unwrap_or(0.0), times.last().copied().unwrap_or(1.0)];
        let axes = Axes::new(slot.place, along, range(edges.chain([0.0]), panel.least));
        let mut attributes = vec![("id", panel.id.to_owned())];
        attributes.extend(axes.attributes());
        drawing.open("", &attributes);
        axes.draw_ground(drawing, self.style);
        for series in &panel.series {
            self.draw_series(drawing, &axes, series, times);
        }
        let abscissa = slot.named.then_some("time (s)");
        axes.draw_frame(
            drawing,
            self.style,
            AxisWords {
                title: panel.title,
                unit: &panel.unit,
                directions: panel.directions,
                abscissa,
                legend_height: slot.legend_height,
            },
        );
        drawing.close();
    }

    fn draw_series(&self, drawing: &mut Drawing, axes: &Axes<'_>, series: &Series<'_>, times: &[f64]) {
        let every = times.len().div_ceil(MOST_POINTS).max(1);
        let chosen = || (0..times.len().min(series.values.len())).step_by(every);
        let side = series.side.map_or("", Side::letter);
        let tags = |role: &str| [("data-side", side.to_owned()), ("data-role", role.to_owned())];
        if let Some(spread) = &series.spread {
            let edge = |i: usize, sign: f64| {
                axes.at([times[i], series.values[i] + sign * spread.get(i).copied().unwrap_or(0.0)])
            };
            let mut corners: Vec<[f64; 2]> = chosen().map(|i| edge(i, 1.0)).collect();
            corners.extend(chosen().rev().map(|i| edge(i, -1.0)));
            drawing.polygon(&corners, series.stroke.color, self.style.uncertainty_opacity, &tags("uncertainty"));
        }
        let line: Vec<[f64; 2]> = chosen().map(|i| axes.at([times[i], series.values[i]])).collect();
        drawing.polyline(&line, series.stroke, &tags(series.role));
    }
}
