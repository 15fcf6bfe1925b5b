//! The pictures of docs/BENCHMARKS.md: time and error over size, on logarithmic axes.
//!
//! Panels are drawn over the logarithms themselves, so that each tick is a power of ten with a name that can be read.

use super::Results;
use super::run::Run;
use crate::simulators::{Peer, PeerTiming, Scene};
use plotters::coord::Shift;
use plotters::prelude::*;

/// The library rounds coordinates to whole pixels, so pictures are drawn on a canvas this much larger than they are shown.
const FINE: u32 = 4;
/// Width and height of one panel, height of the title and of the legend, as shown [px].
const PANEL: (u32, u32) = (400, 320);
const TITLE: u32 = 34;
const LEGEND: u32 = 30;
/// Errors below this are drawn at it [m]: joints that are coordinates do not come apart.
const LEAST_M: f64 = 1e-17;

const INK: RGBColor = RGBColor(40, 40, 40);
const GREY: RGBColor = RGBColor(120, 120, 120);
/// Okabe and Ito's palette (unverified), told apart by colour-blind eyes.
const OURS: RGBColor = RGBColor(0, 114, 178);
const OURS_TOO: RGBColor = RGBColor(86, 180, 233);
const MUJOCO: RGBColor = RGBColor(213, 94, 0);
const RAPIER: RGBColor = RGBColor(0, 158, 115);

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Drawn = Result<(), Box<dyn std::error::Error>>;

/// A curve in both panels: size, time [us], error [m].
struct Curve {
    name: String,
    color: RGBColor,
    points: Vec<(f64, f64, f64)>,
}

/// Chains: all engines.
pub(super) fn scaling(results: &Results) -> Result<String, String> {
    let named = [(true, "Ambulo, with position projection", OURS), (false, "Ambulo, without", OURS_TOO)];
    let ours = named.into_iter().filter_map(|(projection, name, color)| {
        let family = results.scaling.family("chain", projection)?;
        Some(Curve { name: name.to_owned(), color, points: points(&family.sizes) })
    });
    let curves: Vec<Curve> = ours.chain(peers(&results.peers, Scene::Chain)).collect();
    draw("Open chain: time per step and joint error", "bodies", &curves)
        .map_err(|e| format!("simulation_scaling.svg: {e}"))
}

/// Ladders: all engines.
pub(super) fn ladder(results: &Results) -> Result<String, String> {
    let ours = results.ladders.iter().zip([OURS, OURS_TOO]).map(|(method, color)| {
        let name = if results.ladders.len() > 1 { format!("Ambulo, {}", method.name) } else { "Ambulo".to_owned() };
        Curve { name, color, points: points(&method.whole) }
    });
    let mut curves: Vec<Curve> = ours.chain(peers(&results.peers, Scene::Ladder)).collect();
    // No loop has no place on a logarithmic axis; the table has it.
    let closed = |(loops, run): &(usize, Run)| (*loops > 0).then_some((*loops as f64, run.step_us.median, run.worst_m));
    curves.extend(results.ladders.first().map(|first| Curve {
        name: "Ambulo, 1,000 rungs".to_owned(),
        color: GREY,
        points: first.closing.iter().filter_map(closed).collect(),
    }));
    draw("Ladder: time per step and loop error", "closed loops", &curves)
        .map_err(|e| format!("simulation_ladder.svg: {e}"))
}

fn points(runs: &[(usize, Run)]) -> Vec<(f64, f64, f64)> {
    runs.iter().map(|(size, run)| (*size as f64, run.step_us.median, run.worst_m)).collect()
}

/// The engines in the settings that they come with.
fn peers(timings: &[PeerTiming], scene: Scene) -> Vec<Curve> {
    let settings = [(Peer::MuJoCo, "Euler", "MuJoCo", MUJOCO), (Peer::RapierF32, "default", "Rapier (f32)", RAPIER)];
    let curve = |(peer, setting, name, color): (Peer, &str, &str, RGBColor)| {
        let of_it = timings.iter().filter(|t| t.scene == scene && t.peer == peer && t.setting == setting);
        let point = |timing: &PeerTiming| {
            let measured = timing.measurement()?;
            Some((timing.size as f64, measured.median_us, measured.constraint_error_m[0]?))
        };
        Curve { name: name.to_owned(), color, points: of_it.filter_map(point).collect() }
    };
    settings.into_iter().map(curve).filter(|curve| !curve.points.is_empty()).collect()
}

fn draw(title: &str, sizes: &str, curves: &[Curve]) -> Result<String, Box<dyn std::error::Error>> {
    let (width, height) = (2 * PANEL.0, TITLE + PANEL.1 + LEGEND);
    let mut svg = String::new();
    {
        let root = SVGBackend::with_string(&mut svg, (FINE * width, FINE * height)).into_drawing_area();
        root.fill(&WHITE)?;
        let (head, body) = root.split_vertically(FINE * TITLE);
        let (panels, legend) = body.split_vertically(FINE * PANEL.1);
        head.draw_text(title, &font(15), at(14, 10))?;
        draw_legend(&legend, curves)?;
        let panels = panels.split_evenly((1, 2));
        draw_panel(&panels[0], sizes, "time per step", curves, |(_, us, _)| us.log10(), time_label)?;
        draw_panel(&panels[1], sizes, "worst error [m]", curves, |(_, _, m)| m.max(LEAST_M).log10(), error_label)?;
        root.present()?;
    }
    Ok(shown_at(&svg, width, height))
}

fn draw_panel(
    area: &Area<'_>,
    sizes: &str,
    quantity: &str,
    curves: &[Curve],
    height: impl Fn((f64, f64, f64)) -> f64,
    label: impl Fn(f64) -> String,
) -> Drawn {
    let places: Vec<Vec<(f64, f64)>> =
        curves.iter().map(|c| c.points.iter().map(|p| (p.0.log10(), height(*p))).collect()).collect();
    let (left, right) = decades(places.iter().flatten().map(|p| p.0));
    let (low, high) = decades(places.iter().flatten().map(|p| p.1));
    let mut chart = ChartBuilder::on(area)
        .caption(quantity, font(13))
        .margin(FINE * 8)
        .margin_right(FINE * 20)
        .x_label_area_size(FINE * 36)
        .y_label_area_size(FINE * 56)
        .build_cartesian_2d(left - 0.1..right + 0.1, low..high)?;
    let labels = |low: f64, high: f64| (high - low).round() as usize + 1;
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(RGBColor(225, 225, 225).stroke_width(FINE))
        .axis_style(GREY.stroke_width(FINE))
        .label_style(font(11))
        .axis_desc_style(font(11))
        .x_labels(labels(left, right))
        .y_labels(labels(low, high))
        .x_desc(sizes)
        .x_label_formatter(&|x| grouped(10.0_f64.powf(*x)))
        .y_label_formatter(&|y| label(*y))
        .draw()?;
    for (curve, places) in curves.iter().zip(&places) {
        chart.draw_series(LineSeries::new(places.iter().copied(), curve.color.stroke_width(2 * FINE)))?;
        chart.draw_series(places.iter().map(|place| Circle::new(*place, 3 * FINE, curve.color.filled())))?;
    }
    Ok(())
}

fn draw_legend(area: &Area<'_>, curves: &[Curve]) -> Drawn {
    let mut x = 60;
    for curve in curves {
        area.draw(&PathElement::new(vec![at(x, 10), at(x + 22, 10)], curve.color.stroke_width(2 * FINE)))?;
        area.draw(&Circle::new(at(x + 11, 10), 3 * FINE, curve.color.filled()))?;
        area.draw_text(&curve.name, &font(11), at(x + 28, 4))?;
        // Letters of this size are about five and a half pixels wide.
        x += 28 + 11 * curve.name.chars().count() as u32 / 2 + 20;
    }
    Ok(())
}

fn font(size: u32) -> TextStyle<'static> {
    ("sans-serif", FINE * size).into_font().color(&INK)
}

fn at(x: u32, y: u32) -> (i32, i32) {
    ((FINE * x) as i32, (FINE * y) as i32)
}

/// Whole decades around all values.
fn decades(values: impl Iterator<Item = f64> + Clone) -> (f64, f64) {
    let low = values.clone().fold(f64::INFINITY, f64::min).floor();
    let high = values.fold(f64::NEG_INFINITY, f64::max).ceil();
    if low < high { (low, high) } else { (low - 1.0, low + 1.0) }
}

/// A power of ten microseconds.
fn time_label(power: f64) -> String {
    let (below, unit) = match power {
        p if p < 3.0 => (0.0, "us"),
        p if p < 6.0 => (3.0, "ms"),
        _ => (6.0, "s"),
    };
    format!("{} {unit}", 10.0_f64.powf(power - below).round())
}

fn error_label(power: f64) -> String {
    if power <= LEAST_M.log10() { "0".to_owned() } else { format!("1e{power:.0}") }
}

/// 10,000.
fn grouped(value: f64) -> String {
    let digits = format!("{value:.0}");
    let (head, tail) = digits.split_at(digits.len().saturating_sub(3));
    if head.is_empty() { tail.to_owned() } else { format!("{head},{tail}") }
}

/// Keeps the fine canvas as the view box and shows it at its real size.
fn shown_at(svg: &str, width: u32, height: u32) -> String {
    let fine = format!("width=\"{}\" height=\"{}\" viewBox", FINE * width, FINE * height);
    svg.replacen(&fine, &format!("width=\"{width}\" height=\"{height}\" viewBox"), 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_have_names_that_can_be_read() {
        assert_eq!([0.0, 2.0, 3.0, 4.0, 6.0].map(time_label), ["1 us", "100 us", "1 ms", "10 ms", "1 s"]);
        assert_eq!([10.0, 1000.0, 10_000.0].map(grouped), ["10", "1,000", "10,000"]);
        assert_eq!([-17.0, -9.0].map(error_label), ["0", "1e-9"]);
    }

    #[test]
    fn a_picture_names_all_its_curves_once() {
        let curve = |name: &str| Curve {
            name: name.to_owned(),
            color: OURS,
            points: vec![(10.0, 3.0, 1e-15), (1e4, 4e3, 0.0)],
        };
        let svg = draw("Chains", "bodies", &[curve("one"), curve("other")]).unwrap();
        assert!(svg.starts_with("<svg width=\"800\""), "{}", &svg[..80]);
        assert_eq!((svg.matches("other").count(), svg.matches("10,000").count()), (1, 2));
    }
}
