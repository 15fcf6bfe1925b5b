//! Draws the joint angles of a walk over the gait cycle with the sub-cycles of its state machines below, as figure 1 of
//! the 1997 paper, for any gait.

use super::FigureError;
use super::axes::{Axes, AxisWords, range};
use super::chart::CURVE_COLORS;
use super::sheet::{Sample, Sheet, Slot};
use super::svg::{Anchor, Drawing, Letters, Stroke};
use crate::style::{Style, style};
use ambulo::gait::machine::{StateRow, state_rows, walking_machine};
use ambulo::gait::{Clock, Jet, LegAngles, Walk};

/// Heights of the curves, of the gap below them, and of one row of spans [pt].
const CURVES: f64 = 170.0;
const GAP: f64 = 6.0;
const ROW: f64 = 14.0;
/// Space between the spans of two rows [pt].
const BETWEEN: f64 = 3.0;
/// Space at the left of the axes for the names of the rows [pt].
const NAMES: f64 = 16.0;
/// Points of a curve.
const POINTS: usize = 400;
/// Opacity of a span, and of the span of the swing phase.
const FILL: f64 = 0.22;
const SWING_FILL: f64 = 0.06;

/// A joint of the right leg: the machine whose sub-cycles are shown, and its angle.
struct Joint {
    name: &'static str,
    machine: &'static str,
    color: &'static str,
    angle: fn(&LegAngles) -> Jet,
}

const JOINTS: [Joint; 3] = [
    Joint { name: "hip", machine: "right hip", color: CURVE_COLORS[0], angle: |leg| leg.hip },
    Joint { name: "knee", machine: "right knee", color: CURVE_COLORS[1], angle: |leg| leg.knee },
    Joint { name: "ankle", machine: "right ankle", color: CURVE_COLORS[2], angle: |leg| leg.ankle },
];

/// A part of the cycle with a name; from and to [% of the cycle of the right foot].
struct Span {
    name: String,
    from: f64,
    to: f64,
}

/// The spans of one joint or foot.
struct Row {
    name: &'static str,
    color: &'static str,
    spans: Vec<Span>,
}

/// Hip, knee and ankle angle over the cycle of the right foot, in degrees, flexion and dorsiflexion positive; below,
/// the sub-cycles of each joint, and stance and swing of both feet, from the walking machine at the initial speed of
/// the walk.
///
/// # Errors
/// A style that cannot be read.
pub fn gait_figure(walk: &Walk) -> Result<String, FigureError> {
    let style = style().map_err(|e| FigureError { name: "gait.svg", reason: e.to_string() })?;
    let rows = rows(walk);
    let title = format!("Angles and sub-cycles of the gait \u{201c}{}\u{201d}", walk.name());
    let caption = format!(
        "Style {}, {:.2} m/s, step length {:.2} m, cycle time {:.2} s, leg length {:.2} m",
        walk.style().name(),
        walk.speed(),
        walk.step_length(),
        walk.cycle_s(),
        walk.leg_length()
    );
    let legend = JOINTS.map(|joint| (Sample::Line(Stroke::solid(joint.color, style.lines_pt.mean)), joint.name.into()));
    let panels = 0..1;
    let sheet = Sheet {
        style,
        title: &title,
        caption: &caption,
        width_mm: style.widths_mm.two_columns,
        rows: vec![panels],
        panel_height: CURVES + GAP + ROW * rows.len() as f64,
        legend: legend.into(),
        panel_legends: Vec::new(),
        notes: Vec::new(),
        description: "Hip, knee and ankle angle over the gait cycle, and the phases of joints and feet.".into(),
    };
    Ok(sheet.draw(|drawing, slot| draw(drawing, style, slot, walk, &rows)))
}

fn draw(drawing: &mut Drawing, style: &Style, slot: Slot, walk: &Walk, rows: &[Row]) {
    let [left, top, right, bottom] = slot.place;
    let left = left + NAMES;
    let curves = JOINTS.map(|joint| curve(walk, &joint));
    let angles = curves.iter().flatten().map(|[_, angle]| *angle);
    let axes = Axes::new([left, top, right, top + CURVES], [0.0, 100.0], range(angles.chain([0.0]), 10.0));
    let whole = Axes { place: [left, top, right, bottom], ..axes };
    let mut attributes = vec![("id", "angles".to_owned())];
    attributes.extend(axes.attributes());
    drawing.open("", &attributes);
    axes.draw_ground(drawing, style);
    whole.draw_columns(drawing, style);
    for (joint, curve) in JOINTS.iter().zip(&curves) {
        let points: Vec<[f64; 2]> = curve.iter().map(|point| axes.at(*point)).collect();
        let stroke = Stroke::solid(joint.color, style.lines_pt.mean);
        drawing.polyline(&points, stroke, &[("data-name", joint.name.to_owned())]);
    }
    axes.draw_ordinate(drawing, style);
    drawing.close();
    for (number, row) in rows.iter().enumerate() {
        let from = axes.place[3] + GAP + ROW * number as f64;
        draw_row(drawing, style, &axes, row, [from, from + ROW - BETWEEN]);
    }
    let words = AxisWords {
        title: "",
        unit: "flexion and dorsiflexion positive (deg)",
        directions: [""; 2],
        abscissa: Some("gait cycle of the right foot, from foot strike (%)"),
        legend_height: slot.legend_height,
    };
    whole.draw_abscissa(drawing, style);
    whole.draw_words(drawing, style, words);
}

/// Angle [deg] over percent of the cycle.
fn curve(walk: &Walk, joint: &Joint) -> Vec<[f64; 2]> {
    let law_speed = walk.clock(0.0).law_speed;
    let point = |i: usize| {
        let phase = i as f64 / POINTS as f64;
        let posture = walk.posture(&Clock::steady(Jet::new(phase, 1.0, 0.0), law_speed));
        [100.0 * phase, (joint.angle)(&posture.right).value.to_degrees()]
    };
    (0..=POINTS).map(point).collect()
}

fn rows(walk: &Walk) -> Vec<Row> {
    let states = state_rows(&walking_machine(walk));
    let spans = |machine: &str, late: f64| {
        let of_machine = states.iter().filter(|row| row.machine == machine);
        of_machine.flat_map(|row| spans_of(row, late)).collect::<Vec<Span>>()
    };
    let joints =
        JOINTS.iter().map(|joint| Row { name: joint.name, color: joint.color, spans: spans(joint.machine, 0.0) });
    let feet = [("right foot", "right leg", 0.0), ("left foot", "left leg", 0.5)];
    let foot = |(name, machine, late)| Row { name, color: CURVE_COLORS[7], spans: spans(machine, late) };
    joints.chain(feet.map(foot)).collect()
}

/// The parts of the window of a state between 0 % and 100 %; `late` [cycles] is how far the foot of the machine is
/// behind the right foot.
fn spans_of(row: &StateRow, late: f64) -> Vec<Span> {
    let Some(span) = row.span else { return Vec::new() };
    let [from, to] = span.window.map(|phase| phase + late);
    let shift = from.floor();
    let part = |from: f64, to: f64| Span { name: row.state.clone(), from: 100.0 * from, to: 100.0 * to };
    let (from, to) = (from - shift, to - shift);
    if to <= 1.0 { vec![part(from, to)] } else { vec![part(from, 1.0), part(0.0, to - 1.0)] }
}

/// One row of spans between two ordinates of the paper, with its name at the left.
fn draw_row(drawing: &mut Drawing, style: &Style, axes: &Axes<'_>, row: &Row, [top, bottom]: [f64; 2]) {
    let size = style.font.tick_pt;
    let baseline = 0.5 * (top + bottom) + 0.35 * size;
    for span in &row.spans {
        let (left, right) = (axes.x(span.from), axes.x(span.to));
        let corners = [[left, top], [right, top], [right, bottom], [left, bottom]];
        let fill = if span.name == "swing" { SWING_FILL } else { FILL };
        drawing.polygon(&corners, row.color, fill, &[("data-name", format!("{} {}", row.name, span.name))]);
        let outline = [corners[0], corners[1], corners[2], corners[3], corners[0]];
        drawing.polyline(&outline, Stroke::solid(row.color, style.lines_pt.axis), &[]);
        if super::svg::text_width(&span.name, size) + 2.0 < right - left {
            let letters = Letters::plain(size, &style.text.color, Anchor::Middle);
            drawing.text([0.5 * (left + right), baseline], &span.name, letters);
        }
    }
    let letters = Letters::plain(size, &style.text.color, Anchor::End);
    drawing.text([axes.place[0] - 4.0, baseline], row.name, letters);
}
