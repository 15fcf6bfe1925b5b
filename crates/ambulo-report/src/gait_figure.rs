//! The angular laws of a walk with the sub-cycles of its state machines below: figure 1 of the 1997 paper, for any gait.

use super::plot::{Area, COLORS, DrawResult, FINE, FigureError, GREY, GRID, font, shown_at};
use ambulo::gait::machine::{StateRow, state_rows, walking_machine};
use ambulo::gait::{Clock, Jet, LegAngles, Walk};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

/// Width of the figure, heights of title, curves and one row of spans as shown [px].
const WIDTH: u32 = 760;
const TITLE: u32 = 48;
const CURVES: u32 = 330;
const ROW: u32 = 26;
/// Room below the rows for the axis [px].
const AXIS: u32 = 36;
/// Margin of the figure on the left, room for labels beside it [px].
const MARGIN: u32 = 10;
const LABELS: u32 = 82;
/// Points of a curve.
const POINTS: usize = 400;
/// Spans shorter than this share of the cycle have no room for a name.
const NARROWEST: f64 = 0.025;

/// A joint of the right leg: the machine whose sub-cycles are shown, and its angle.
struct Shown {
    name: &'static str,
    machine: &'static str,
    color: RGBColor,
    angle: fn(&LegAngles) -> Jet,
}

const JOINTS: [Shown; 3] = [
    Shown { name: "hip", machine: "right hip", color: COLORS[0], angle: |leg| leg.hip },
    Shown { name: "knee", machine: "right knee", color: COLORS[1], angle: |leg| leg.knee },
    Shown { name: "ankle", machine: "right ankle", color: COLORS[2], angle: |leg| leg.ankle },
];

/// A part of the cycle with a name.
struct Span {
    name: String,
    from: f64,
    to: f64,
}

/// Hip, knee and ankle angle over the cycle of the right foot, in degrees, flexion and dorsiflexion positive; below, the sub-cycles of
/// each joint and stance and swing of both feet, as the walking machine has them at the speed at which the walk begins.
///
/// # Errors
/// A canvas that the plotting library refuses.
pub fn gait_figure(walk: &Walk) -> Result<String, FigureError> {
    draw(walk).map_err(|e| FigureError { name: "gait.svg", reason: e.to_string() })
}

fn draw(walk: &Walk) -> Result<String, Box<dyn std::error::Error>> {
    let rows = rows(walk);
    let height = TITLE + CURVES + ROW * rows.len() as u32 + AXIS;
    let mut svg = String::new();
    {
        let root = SVGBackend::with_string(&mut svg, (FINE * WIDTH, FINE * height)).into_drawing_area();
        root.fill(&WHITE).map_err(|e| e.to_string())?;
        let (title, body) = root.split_vertically(FINE * TITLE);
        let (curves, spans) = body.split_vertically(FINE * CURVES);
        draw_title(&title, walk)?;
        draw_curves(&curves, walk)?;
        draw_spans(&spans, &rows)?;
        root.present().map_err(|e| e.to_string())?;
    }
    Ok(shown_at(&svg, WIDTH, height))
}

fn draw_title(area: &Area<'_>, walk: &Walk) -> DrawResult {
    let at = |x: u32, y: u32| ((FINE * x) as i32, (FINE * y) as i32);
    let title = format!("Angles and sub-cycles of the gait \u{201c}{}\u{201d}", walk.name());
    let pace = format!(
        "style {}, {:.2} m/s, steps of {:.2} m, cycle of {:.2} s, leg of {:.2} m",
        walk.style().name(),
        walk.speed(),
        walk.step_length(),
        walk.cycle_s(),
        walk.leg_length()
    );
    area.draw_text(&title, &font(15), at(14, 10))?;
    area.draw_text(&pace, &font(11), at(14, 31))?;
    for (number, joint) in JOINTS.iter().enumerate() {
        let x = 500 + 84 * number as u32;
        area.draw(&PathElement::new(vec![at(x, 23), at(x + 22, 23)], joint.color.stroke_width(2 * FINE)))?;
        area.draw_text(joint.name, &font(12), at(x + 28, 16))?;
    }
    Ok(())
}

fn draw_curves(area: &Area<'_>, walk: &Walk) -> DrawResult {
    let curves = JOINTS.map(|joint| curve(walk, &joint));
    let values = || curves.iter().flatten().map(|(_, angle)| *angle);
    let (low, high) = (values().fold(0.0, f64::min), values().fold(0.0, f64::max));
    let mut chart = ChartBuilder::on(area)
        .margin_left(FINE * MARGIN)
        .margin_right(FINE * 16)
        .margin_top(FINE * 4)
        .x_label_area_size(0)
        .y_label_area_size(FINE * LABELS)
        .build_cartesian_2d(0.0..100.0, low - 5.0..high + 5.0)?;
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(GRID.stroke_width(FINE))
        .axis_style(GREY.stroke_width(FINE))
        .label_style(font(11))
        .axis_desc_style(font(11))
        .x_labels(11)
        .y_labels(9)
        .y_desc("angle (deg), flexion and dorsiflexion +")
        .y_label_formatter(&|y| format!("{y:.0}"))
        .draw()?;
    chart.draw_series(LineSeries::new([(0.0, 0.0), (100.0, 0.0)], GREY.stroke_width(FINE)))?;
    for (joint, curve) in JOINTS.iter().zip(curves) {
        chart.draw_series(LineSeries::new(curve, joint.color.stroke_width(2 * FINE)))?;
    }
    Ok(())
}

/// Angle [deg] against percent of the cycle.
fn curve(walk: &Walk, joint: &Shown) -> Vec<(f64, f64)> {
    let law_speed = walk.clock(0.0).law_speed;
    let point = |i: usize| {
        let phase = i as f64 / POINTS as f64;
        let posture = walk.posture(&Clock { phase: Jet::new(phase, 1.0, 0.0), law_speed });
        (100.0 * phase, (joint.angle)(&posture.right).value.to_degrees())
    };
    (0..=POINTS).map(point).collect()
}

/// The rows of spans: name, colour, spans in percent of the right foot's cycle.
fn rows(walk: &Walk) -> Vec<(&'static str, RGBColor, Vec<Span>)> {
    let states = state_rows(&walking_machine(walk));
    let spans = |machine: &str, late: f64| {
        let of_machine = states.iter().filter(|row| row.machine == machine);
        of_machine.flat_map(|row| shown_spans(row, late)).collect::<Vec<Span>>()
    };
    let joints = JOINTS.iter().map(|joint| (joint.name, joint.color, spans(joint.machine, 0.0)));
    let feet = [("right foot", "right leg", 0.0), ("left foot", "left leg", 0.5)];
    joints.chain(feet.map(|(name, machine, late)| (name, GREY, spans(machine, late)))).collect()
}

/// The parts of a state's window between 0 % and 100 %; `late` [cycles] is how far the machine's foot is behind the right one.
fn shown_spans(row: &StateRow, late: f64) -> Vec<Span> {
    let Some(span) = row.span else { return Vec::new() };
    let [from, to] = span.window.map(|phase| phase + late);
    let shift = from.floor();
    let part = |from: f64, to: f64| Span { name: row.state.clone(), from: 100.0 * from, to: 100.0 * to };
    let (from, to) = (from - shift, to - shift);
    if to <= 1.0 { vec![part(from, to)] } else { vec![part(from, 1.0), part(0.0, to - 1.0)] }
}

fn draw_spans(area: &Area<'_>, rows: &[(&'static str, RGBColor, Vec<Span>)]) -> DrawResult {
    let count = rows.len() as f64;
    let mut chart = ChartBuilder::on(area)
        .margin_left(FINE * MARGIN)
        .margin_right(FINE * 16)
        .x_label_area_size(FINE * AXIS)
        .y_label_area_size(FINE * LABELS)
        .build_cartesian_2d(0.0..100.0, 0.0..count)?;
    chart
        .configure_mesh()
        .disable_y_mesh()
        .disable_y_axis()
        .light_line_style(TRANSPARENT)
        .bold_line_style(GRID.stroke_width(FINE))
        .axis_style(GREY.stroke_width(FINE))
        .label_style(font(11))
        .axis_desc_style(font(11))
        .x_labels(11)
        .x_desc("cycle of the right foot, from its contact (%)")
        .x_label_formatter(&|x| format!("{x:.0}"))
        .draw()?;
    let text = font(11).pos(Pos::new(HPos::Center, VPos::Center));
    for (number, (_, color, spans)) in rows.iter().enumerate() {
        let (bottom, top) = (count - number as f64 - 0.88, count - number as f64 - 0.12);
        for span in spans {
            let corners = [(span.from, bottom), (span.to, top)];
            let fill = if span.name == "swing" { color.mix(0.06) } else { color.mix(0.22) };
            chart.draw_series([Rectangle::new(corners, fill.filled())])?;
            chart.draw_series([Rectangle::new(corners, color.stroke_width(FINE))])?;
            if span.to - span.from > 100.0 * NARROWEST {
                let middle = (0.5 * (span.from + span.to), 0.5 * (bottom + top));
                chart.draw_series([Text::new(span.name.clone(), middle, text.clone())])?;
            }
        }
    }
    draw_names(area, rows)
}

fn draw_names(area: &Area<'_>, rows: &[(&'static str, RGBColor, Vec<Span>)]) -> DrawResult {
    let style = font(12).pos(Pos::new(HPos::Right, VPos::Center));
    for (number, (name, _, _)) in rows.iter().enumerate() {
        let y = ROW * number as u32 + ROW / 2;
        area.draw_text(name, &style, ((FINE * LABELS) as i32, (FINE * y) as i32))?;
    }
    Ok(())
}
