//! Figures as SVG, drawn from the same rows as `cycles.csv`.

use super::cycle_table::CycleRow;
use crate::model::Side;
use crate::motion::interpolate;
use plotters::coord::Shift;
use plotters::prelude::*;

/// Why a figure could not be drawn.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("the figure `{name}` could not be drawn: {reason}")]
pub struct FigureError {
    /// Which figure.
    pub name: &'static str,
    /// The plotting library's words.
    pub reason: String,
}

/// The library rounds coordinates to whole pixels, so figures are drawn on a canvas this much larger than they are shown.
pub(super) const FINE: u32 = 4;
/// Width and height of one panel as shown [px].
const PANEL: (u32, u32) = (330, 270);
/// Height of the title line as shown [px].
const TITLE: u32 = 46;

/// Right: blue, left: vermilion; told apart by colour-blind eyes (Okabe and Ito's palette, unverified).
fn color(side: Side) -> RGBColor {
    match side {
        Side::Right => RGBColor(0, 114, 178),
        Side::Left => RGBColor(213, 94, 0),
    }
}

/// A panel: clinical name, the quantity in `cycles.csv` and the sign that makes extension and plantarflexion positive.
struct Panel {
    title: &'static str,
    quantity: &'static str,
    positive: &'static str,
    sign: f64,
}

/// A part of a cycle in which a motion is not feasible.
#[derive(Debug, Clone, PartialEq)]
pub struct Mark {
    /// What is not: a coordinate without its side, or `None` for what concerns feet and body as a whole.
    pub coordinate: Option<String>,
    /// The foot whose cycle it is.
    pub side: Side,
    /// Number of the cycle of this foot, from 1.
    pub cycle: usize,
    /// From where to where [% of the cycle].
    pub percent: [f64; 2],
}

/// What is not feasible.
const RED: RGBColor = RGBColor(220, 0, 0);

/// Hip, knee and ankle moment over the gait cycle, N.m per kg of body mass, extensor and plantarflexor positive; right
/// and left, every cycle thin and the mean thick, toe-off as a tick.
///
/// OpenSim's coordinates count hip flexion and ankle dorsiflexion positive, so the generalised force of an extensor or
/// plantarflexor is negative and the sign is turned. The knee's coordinate is taken from the data: flexion is negative
/// in the Gait2392 family and positive in Rajagopal's; the direction in which the knee turns most during the cycle is
/// flexion.
///
/// `caption` says whose walk it is. `marks` are drawn red: on the curve of their coordinate, or as a bar at the bottom.
///
/// # Errors
/// A canvas that the plotting library refuses.
pub fn moments_figure(rows: &[CycleRow], mass_kg: f64, caption: &str, marks: &[Mark]) -> Result<String, FigureError> {
    let error = |reason: String| FigureError { name: "moments.svg", reason };
    let knee_sign = -knee_flexion_sign(rows);
    let panels = [
        Panel { title: "Hip", quantity: "hip_flexion_moment", positive: "extensor", sign: -1.0 },
        Panel { title: "Knee", quantity: "knee_angle_moment", positive: "extensor", sign: knee_sign },
        Panel { title: "Ankle", quantity: "ankle_angle_moment", positive: "plantarflexor", sign: -1.0 },
    ];
    let (width, height) = (3 * PANEL.0, PANEL.1 + TITLE);
    let mut svg = String::new();
    {
        let root = SVGBackend::with_string(&mut svg, (FINE * width, FINE * height)).into_drawing_area();
        root.fill(&WHITE).map_err(|e| error(e.to_string()))?;
        let (title, body) = root.split_vertically(FINE * TITLE);
        let sides = Side::BOTH.into_iter().filter(|side| rows.iter().any(|row| row.side == *side)).collect::<Vec<_>>();
        draw_title(&title, caption, &sides, !marks.is_empty()).map_err(|e| error(e.to_string()))?;
        for (panel, area) in panels.iter().zip(body.split_evenly((1, 3))) {
            draw_panel(&area, panel, rows, mass_kg, marks).map_err(|e| error(e.to_string()))?;
        }
        root.present().map_err(|e| error(e.to_string()))?;
    }
    Ok(shown_at(&svg, width, height))
}

pub(super) type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
pub(super) type DrawResult = Result<(), Box<dyn std::error::Error>>;

/// +1 if knee flexion is the positive direction of `knee_angle`, -1 if it is the negative one.
fn knee_flexion_sign(rows: &[CycleRow]) -> f64 {
    let angles = rows.iter().filter(|r| r.quantity == "knee_angle_angle").flat_map(|r| &r.values);
    let largest = angles.fold(0.0_f64, |m, &x| if x.abs() > m.abs() { x } else { m });
    if largest < 0.0 { -1.0 } else { 1.0 }
}

pub(super) fn font(size: u32) -> TextStyle<'static> {
    ("sans-serif", FINE * size).into_font().color(&RGBColor(40, 40, 40))
}

fn draw_title(area: &Area<'_>, caption: &str, sides: &[Side], marked: bool) -> DrawResult {
    let at = |x: u32, y: u32| ((FINE * x) as i32, (FINE * y) as i32);
    area.draw_text("Net joint moments over the gait cycle", &font(15), at(14, 10))?;
    area.draw_text(caption, &font(11), at(14, 30))?;
    let explanation = "thin: single cycles, thick: mean, tick: toe-off";
    area.draw_text(explanation, &font(11), at(500, 17))?;
    if marked {
        area.draw_text("red: not feasible", &font(11).color(&RED), at(500, 31))?;
    }
    for (side, x) in [(Side::Right, 780), (Side::Left, 880)] {
        if !sides.contains(&side) {
            continue;
        }
        let dashes: &[(u32, u32)] = if side == Side::Right { &[(0, 25)] } else { &[(0, 7), (9, 16), (18, 25)] };
        for (from, to) in dashes {
            let line = [at(x + from, 22), at(x + to, 22)];
            area.draw(&PathElement::new(line.to_vec(), color(side).stroke_width(2 * FINE)))?;
        }
        area.draw_text(&side.to_string(), &font(12), at(x + 30, 15))?;
    }
    Ok(())
}

fn draw_panel(area: &Area<'_>, panel: &Panel, rows: &[CycleRow], mass_kg: f64, marks: &[Mark]) -> DrawResult {
    let curves: Vec<(&CycleRow, Vec<f64>)> = rows
        .iter()
        .filter(|r| r.quantity == panel.quantity)
        .map(|r| (r, r.values.iter().map(|x| panel.sign * x / mass_kg).collect()))
        .collect();
    let (low, high) = span(&curves);
    let mut chart = ChartBuilder::on(area)
        .caption(format!("{} ({} +)", panel.title, panel.positive), font(13))
        .margin(FINE * 8)
        .margin_right(FINE * 16)
        .x_label_area_size(FINE * 34)
        .y_label_area_size(FINE * 44)
        .build_cartesian_2d(0.0..100.0, low..high)?;
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(RGBColor(225, 225, 225).stroke_width(FINE))
        .axis_style(RGBColor(120, 120, 120).stroke_width(FINE))
        .label_style(font(11))
        .axis_desc_style(font(11))
        .x_labels(6)
        .y_labels(6)
        .x_desc("gait cycle (%)")
        .y_desc("moment (N.m/kg)")
        .x_label_formatter(&|x| format!("{x:.0}"))
        .y_label_formatter(&|y| format!("{y:.1}"))
        .draw()?;
    chart.draw_series(LineSeries::new([(0.0, 0.0), (100.0, 0.0)], RGBColor(120, 120, 120).stroke_width(FINE)))?;
    for side in Side::BOTH {
        let of_side: Vec<_> = curves.iter().filter(|(r, _)| r.side == side).collect();
        for (row, values) in &of_side {
            chart.draw_series(LineSeries::new(points(values), color(side).mix(0.35).stroke_width(FINE)))?;
            if let Some(off) = row.toe_off_percent {
                let (from, to) = if side == Side::Right { (0.0, 0.07) } else { (0.07, 0.14) };
                let tick = [(off, low + from * (high - low)), (off, low + to * (high - low))];
                chart.draw_series(LineSeries::new(tick, color(side).stroke_width(FINE)))?;
            }
        }
        if !of_side.is_empty() {
            let mean = mean(of_side.iter().map(|(_, v)| v.as_slice()));
            let style = color(side).stroke_width(2 * FINE);
            match side {
                Side::Right => chart.draw_series(LineSeries::new(points(&mean), style))?,
                // Dashed, so that the right shows through where the two agree.
                Side::Left => chart.draw_series(DashedLineSeries::new(points(&mean), 7 * FINE, 4 * FINE, style))?,
            };
        }
    }
    for (row, values) in &curves {
        for mark in marks.iter().filter(|mark| mark.side == row.side && mark.cycle == row.cycle) {
            let style = RED.stroke_width(2 * FINE);
            match &mark.coordinate {
                Some(coordinate) if panel.quantity == format!("{coordinate}_moment") => {
                    chart.draw_series(LineSeries::new(within(values, mark.percent), style))?;
                }
                Some(_) => {}
                None => {
                    let lane = if mark.side == Side::Right { 0.01 } else { 0.03 };
                    let bar = mark.percent.map(|percent| (percent, low + lane * (high - low)));
                    chart.draw_series(LineSeries::new(bar, style))?;
                }
            }
        }
    }
    Ok(())
}

/// The curve between two percentages, with its ends read on straight lines.
fn within(values: &[f64], [from, to]: [f64; 2]) -> Vec<(f64, f64)> {
    let percents: Vec<f64> = (0..values.len()).map(|i| i as f64).collect();
    let at = |percent: f64| (percent, interpolate(&percents, values, percent));
    let between = percents.iter().copied().filter(|p| (from..to).contains(p));
    std::iter::once(from).chain(between).chain([to]).map(at).collect()
}

fn points(values: &[f64]) -> impl Iterator<Item = (f64, f64)> + Clone + '_ {
    values.iter().enumerate().map(|(percent, y)| (percent as f64, *y))
}

fn mean<'a>(curves: impl Iterator<Item = &'a [f64]> + Clone) -> Vec<f64> {
    let count = curves.clone().count() as f64;
    let length = curves.clone().map(<[f64]>::len).min().unwrap_or(0);
    (0..length).map(|i| curves.clone().map(|c| c[i]).sum::<f64>() / count).collect()
}

/// Range of all curves with a margin; at least ±0.1.
fn span(curves: &[(&CycleRow, Vec<f64>)]) -> (f64, f64) {
    let values = curves.iter().flat_map(|(_, v)| v);
    let (low, high) = values.fold((-0.1_f64, 0.1_f64), |(low, high), &x| (low.min(x), high.max(x)));
    let margin = 0.08 * (high - low);
    (low - margin, high + margin)
}

/// Keeps the fine canvas as the view box and shows it at its real size.
pub(super) fn shown_at(svg: &str, width: u32, height: u32) -> String {
    let fine = format!("width=\"{}\" height=\"{}\" viewBox", FINE * width, FINE * height);
    svg.replacen(&fine, &format!("width=\"{width}\" height=\"{height}\" viewBox"), 1)
}
