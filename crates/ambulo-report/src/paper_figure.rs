//! Figures of the 1997 paper, drawn from their numbers: axes side by side, a legend under each title.

use super::plot::{Area, COLORS, DrawResult, FINE, FigureError, GREY, GRID, font, shown_at};
use ambulo::reproduction::{PaperFigure, PaperPanel, PaperSeries, SeriesKind};
use plotters::prelude::*;

/// Height of the title line, and of one line of a legend, as shown [px].
const TITLE: u32 = 44;
const LEGEND_LINE: u32 = 17;
/// Width of a panel, and height of its axes, as shown [px].
const WIDTH: u32 = 420;
const HEIGHT: u32 = 300;
/// Widths of panels drawn to scale, which need room.
const WIDE: u32 = 760;
/// Room for labels beside and below the axes [px].
const LEFT: u32 = 58;
const BELOW: u32 = 38;
const MARGIN: u32 = 10;
/// Figures with more panels than this have them one below the other.
const MOST_ABREAST: usize = 3;

/// Lines with names take turns with so many colours.
const TURNS: usize = 5;
const PALE: RGBColor = RGBColor(160, 160, 160);

/// Draws a figure.
///
/// # Errors
/// A canvas that the plotting library refuses.
pub fn paper_figure(figure: &PaperFigure) -> Result<String, FigureError> {
    draw(figure).map_err(|e| FigureError { name: figure.name, reason: e.to_string() })
}

fn draw(figure: &PaperFigure) -> Result<String, Box<dyn std::error::Error>> {
    let to_scale = figure.panels.iter().any(|panel| panel.to_scale);
    let below = to_scale || figure.panels.len() > MOST_ABREAST;
    let count = figure.panels.len().max(1) as u32;
    let legend = figure.panels.iter().map(|panel| named(panel).count() as u32).max().unwrap_or(0) * LEGEND_LINE + 26;
    let panel = if to_scale { (WIDE, scaled_height(&figure.panels) + legend) } else { (WIDTH, HEIGHT + legend) };
    let (columns, rows) = if below { (1, count) } else { (count, 1) };
    let (width, height) = (columns * panel.0, TITLE + rows * panel.1);
    let mut svg = String::new();
    {
        let root = SVGBackend::with_string(&mut svg, (FINE * width, FINE * height)).into_drawing_area();
        root.fill(&WHITE).map_err(|e| e.to_string())?;
        let (top, body) = root.split_vertically(FINE * TITLE);
        let place = ((FINE * 14) as i32, (FINE * 14) as i32);
        top.draw_text(&figure.title, &font(15), place).map_err(|e| e.to_string())?;
        for (panel, area) in figure.panels.iter().zip(body.split_evenly((rows as usize, columns as usize))) {
            let (head, axes) = area.split_vertically(FINE * legend);
            draw_legend(&head, panel)?;
            draw_panel(&axes, panel)?;
        }
        root.present().map_err(|e| e.to_string())?;
    }
    Ok(shown_at(&svg, width, height))
}

/// Height of axes on which a unit is as long upwards as along [px].
fn scaled_height(panels: &[PaperPanel]) -> u32 {
    let of = |panel: &PaperPanel| {
        let [(left, right), (low, high)] = ranges(panel);
        let across = f64::from(WIDE - LEFT - 2 * MARGIN);
        (across * (high - low) / (right - left)) as u32 + BELOW + 2 * MARGIN
    };
    panels.iter().map(of).max().unwrap_or(HEIGHT)
}

/// Series with a name, each with its colour.
fn named(panel: &PaperPanel) -> impl Iterator<Item = (&PaperSeries, RGBColor)> {
    panel.series.iter().zip(colors(panel)).filter(|(series, _)| !series.name.is_empty())
}

/// A colour for each series: lines with names take turns, points go with the line before them, the rest is black or grey.
fn colors(panel: &PaperPanel) -> Vec<RGBColor> {
    let mut next = 0;
    let mut color_of = |series: &PaperSeries| match series.kind {
        SeriesKind::Line if !series.name.is_empty() => {
            next += 1;
            COLORS[(next - 1) % TURNS]
        }
        SeriesKind::Line => COLORS[0],
        SeriesKind::Faint => PALE,
        SeriesKind::Dots => COLORS[next.saturating_sub(1) % TURNS],
    };
    panel.series.iter().map(&mut color_of).collect()
}

fn draw_legend(area: &Area<'_>, panel: &PaperPanel) -> DrawResult {
    let at = |x: u32, y: u32| ((FINE * x) as i32, (FINE * y) as i32);
    area.draw_text(&panel.title, &font(13), at(LEFT, 2))?;
    for (line, (series, color)) in named(panel).enumerate() {
        let y = 24 + LEGEND_LINE * line as u32;
        match series.kind {
            SeriesKind::Dots => area.draw(&Circle::new(at(LEFT + 11, y + 6), 3 * FINE, color.filled()))?,
            _ => {
                area.draw(&PathElement::new(vec![at(LEFT, y + 6), at(LEFT + 22, y + 6)], color.stroke_width(2 * FINE)))?
            }
        }
        area.draw_text(&series.name, &font(11), at(LEFT + 28, y))?;
    }
    Ok(())
}

fn draw_panel(area: &Area<'_>, panel: &PaperPanel) -> DrawResult {
    let [(left, right), (low, high)] = ranges(panel);
    let digits = if high - low < 12.0 { usize::from(high - low < 6.0) } else { 0 };
    let along = usize::from(right - left < 20.0);
    let mut chart = ChartBuilder::on(area)
        .margin(FINE * MARGIN)
        .x_label_area_size(FINE * BELOW)
        .y_label_area_size(FINE * LEFT)
        .build_cartesian_2d(left..right, low..high)?;
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(GRID.stroke_width(FINE))
        .axis_style(GREY.stroke_width(FINE))
        .label_style(font(11))
        .axis_desc_style(font(11))
        .x_labels(6)
        .y_labels(7)
        .x_desc(panel.x_label)
        .y_desc(panel.y_label)
        .x_label_formatter(&|x| format!("{x:.along$}"))
        .y_label_formatter(&|y| format!("{y:.digits$}"))
        .draw()?;
    if low < 0.0 && high > 0.0 {
        chart.draw_series(LineSeries::new([(left, 0.0), (right, 0.0)], GREY.stroke_width(FINE)))?;
    }
    for (series, color) in panel.series.iter().zip(colors(panel)) {
        let points = series.points.iter().map(|[x, y]| (*x, *y));
        match series.kind {
            SeriesKind::Line => {
                chart.draw_series(LineSeries::new(points, color.stroke_width(3 * FINE / 2)))?;
            }
            SeriesKind::Faint => {
                chart.draw_series(LineSeries::new(points, color.stroke_width(FINE)))?;
            }
            SeriesKind::Dots => {
                chart.draw_series(points.map(|place| Circle::new(place, 3 * FINE, color.filled())))?;
            }
        }
    }
    Ok(())
}

/// Ranges of abscissa and ordinate; the ordinate's with a margin.
fn ranges(panel: &PaperPanel) -> [(f64, f64); 2] {
    let along = |k: usize| {
        let values = panel.series.iter().flat_map(|series| &series.points).map(|point| point[k]);
        values.filter(|x| x.is_finite()).fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)))
    };
    let widened = |(low, high): (f64, f64), share: f64| match low <= high {
        true => {
            let margin = (share * (high - low)).max(1e-6);
            (low - margin, high + margin)
        }
        false => (0.0, 1.0),
    };
    let share = if panel.to_scale { 0.03 } else { 0.0 };
    [widened(along(0), share), widened(along(1), 0.06)]
}
