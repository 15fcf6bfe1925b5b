//! A moving stick figure as SVG that animates itself, without a script.

use ambulo_paper::{MovingFigure, MovingHead, SeriesKind};
use std::fmt::Write;

/// Width and height of the picture [px], and pixels per metre.
const SIZE: [f64; 2] = [170.0, 240.0];
const SCALE: f64 = 112.0;
/// Height of the ground line above the lower edge [px].
const GROUND: f64 = 14.0;
/// Colour and thickness of trunk, head and near limbs.
const NEAR: (&str, f64) = ("#1d4ed8", 2.5);
/// Marks on the ground are about this far apart [m].
const MARKS_M: f64 = 0.5;

/// The figure walks on the spot; marks on the ground move at its speed.
#[must_use]
pub fn moving_picture(figure: &MovingFigure, label: &str) -> String {
    let [width, height] = SIZE;
    let ground = height - GROUND;
    let mut svg = format!(
        "<svg role=\"img\" aria-label=\"{label}\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" \
         height=\"{height}\" fill=\"none\" \
         stroke-linecap=\"round\" stroke-linejoin=\"round\"><path d=\"M0 {ground}H{width}\" stroke=\"#888\"/>"
    );
    svg += &marks(figure, ground);
    svg += &figure.head.as_ref().map_or_else(String::new, |drawn| head(drawn, figure.cycle_s, ground));
    for stick in &figure.sticks {
        let paths: Vec<String> = stick.points.iter().map(|points| path(points, ground)).collect();
        let (colour, thickness) = match stick.kind {
            SeriesKind::Faint => ("#999", 1.5),
            SeriesKind::Line | SeriesKind::Dots => NEAR,
        };
        let _ = write!(
            svg,
            "<path stroke=\"{colour}\" stroke-width=\"{thickness}\" d=\"{}\"><animate attributeName=\"d\" \
             dur=\"{:.3}s\" \
             repeatCount=\"indefinite\" values=\"{}\"/></path>",
            paths.first().map_or("", String::as_str),
            figure.cycle_s,
            paths.join(";")
        );
    }
    svg + "</svg>"
}

fn head(head: &MovingHead, cycle_s: f64, ground: f64) -> String {
    let place = |[x, y]: [f64; 2]| [0.5 * SIZE[0] + SCALE * x, ground - SCALE * y];
    let (colour, thickness) = NEAR;
    let mut svg = String::from("<circle");
    let first = head.centres.first().map_or([0.0; 2], |centre| place(*centre));
    let _ = write!(
        svg,
        " cx=\"{:.1}\" cy=\"{:.1}\" r=\"{:.1}\" stroke=\"{colour}\" stroke-width=\"{thickness}\">",
        first[0],
        first[1],
        SCALE * head.radius
    );
    for (axis, name) in ["cx", "cy"].into_iter().enumerate() {
        let values: Vec<String> = head.centres.iter().map(|centre| format!("{:.1}", place(*centre)[axis])).collect();
        let _ = write!(
            svg,
            "<animate attributeName=\"{name}\" dur=\"{cycle_s:.3}s\" repeatCount=\"indefinite\" values=\"{}\"/>",
            values.join(";")
        );
    }
    svg + "</circle>"
}

fn path(points: &[[f64; 2]], ground: f64) -> String {
    let mut path = String::new();
    for (number, [x, y]) in points.iter().enumerate() {
        let letter = if number == 0 { 'M' } else { 'L' };
        let _ = write!(path, "{letter}{:.1} {:.1}", 0.5 * SIZE[0] + SCALE * x, ground - SCALE * y);
    }
    path
}

/// Marks on the ground: a whole number of them passes in a cycle, so that the picture repeats without a jump.
fn marks(figure: &MovingFigure, ground: f64) -> String {
    let all = figure.advance.last().copied().unwrap_or(0.0);
    let count = (all.abs() / MARKS_M).round().max(1.0);
    let apart = SCALE * (all.abs() / count).max(0.1);
    let many = (SIZE[0] / apart) as usize + 2 * count as usize + 2;
    let mut line = String::new();
    for mark in 0..many {
        let _ = write!(line, "M{:.1} {ground}v5", (mark as f64 - count) * apart);
    }
    let moves: Vec<String> = figure.advance.iter().map(|x| format!("{:.1} 0", -SCALE * x)).collect();
    format!(
        "<g><path d=\"{line}\" stroke=\"#888\"/><animateTransform attributeName=\"transform\" type=\"translate\" \
         dur=\"{:.3}s\" \
         repeatCount=\"indefinite\" values=\"{}\"/></g>",
        figure.cycle_s,
        moves.join(";")
    )
}

/// Width and height of the picture of the speed [px], and the margins of its axes.
const SPEED_SIZE: [f64; 2] = [420.0, 240.0];
const LEFT: f64 = 46.0;
const ABOVE: f64 = 22.0;
const BELOW: f64 = 34.0;
const RIGHT: f64 = 12.0;
/// Distance of the lines of the speed [m/s].
const SPEED_TICK: f64 = 0.5;

/// Forward speed over the cycle, with a dot that moves as the figure does.
pub fn moving_speed(figure: &MovingFigure) -> String {
    let [width, height] = SPEED_SIZE;
    let highest = figure.speed.iter().fold(SPEED_TICK, |top, speed| top.max(*speed));
    let lowest = figure.speed.iter().fold(0.0_f64, |low, speed| low.min(*speed));
    let last = figure.speed.len().saturating_sub(1).max(1) as f64;
    let x = |share: f64| LEFT + share * (width - LEFT - RIGHT);
    let y = |speed: f64| height - BELOW - (speed - lowest) / (highest - lowest) * (height - ABOVE - BELOW);
    let place = |(instant, speed): (usize, &f64)| [x(instant as f64 / last), y(*speed)];
    let places: Vec<[f64; 2]> = figure.speed.iter().enumerate().map(place).collect();
    let first = (lowest / SPEED_TICK).ceil();
    let ticks = (0..).map(|tick| SPEED_TICK * (first + f64::from(tick))).take_while(|speed| *speed <= highest);
    format!(
        "<svg role=\"img\" aria-label=\"forward speed over the cycle\" viewBox=\"0 0 {width} {height}\" \
         width=\"{width}\" height=\"{height}\" fill=\"none\" font-family=\"sans-serif\" font-size=\"12\">{}<text \
         x=\"{LEFT}\" y=\"13\" fill=\"#444\">m/s</text><text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"middle\" \
         fill=\"#444\">gait cycle, 0 to 100 %</text><path d=\"{}\" stroke=\"{}\" stroke-width=\"2\"/>{}</svg>",
        ticks.map(|speed| tick_line(speed, y(speed), [x(0.0), x(1.0)])).collect::<String>(),
        x(0.5),
        height - 10.0,
        polyline(&places),
        NEAR.0,
        dot(&places, figure.cycle_s)
    )
}

/// A line across the axes with its speed [m/s].
fn tick_line(speed: f64, y: f64, [left, right]: [f64; 2]) -> String {
    format!(
        "<path d=\"M{left:.1} {y:.1}H{right:.1}\" stroke=\"#ccc\"/><text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\" \
         fill=\"#444\">{speed:.1}</text>",
        left - 6.0,
        y + 4.0
    )
}

fn polyline(places: &[[f64; 2]]) -> String {
    let letter = |number: usize| if number == 0 { 'M' } else { 'L' };
    places.iter().enumerate().map(|(number, [x, y])| format!("{}{x:.1} {y:.1}", letter(number))).collect()
}

/// A dot that passes all places in a cycle.
fn dot(places: &[[f64; 2]], cycle_s: f64) -> String {
    let [x, y] = places.first().copied().unwrap_or_default();
    let mut svg = format!("<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"5\" fill=\"#c2410c\">");
    for (axis, name) in ["cx", "cy"].into_iter().enumerate() {
        let values: Vec<String> = places.iter().map(|place| format!("{:.1}", place[axis])).collect();
        let _ = write!(
            svg,
            "<animate attributeName=\"{name}\" dur=\"{cycle_s:.3}s\" repeatCount=\"indefinite\" values=\"{}\"/>",
            values.join(";")
        );
    }
    svg + "</circle>"
}
