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
