//! Draws the pictures of docs/measured/BENCHMARKS.md: time and error over size, on logarithmic axes.
//!
//! Panels are drawn over the logarithms, with a labelled tick at each power of ten.

use super::Results;
use super::run::Run;
use crate::simulators::{Peer, PeerTiming, Scene};
use ambulo_report::figures::{CURVE_COLORS, Chart, ChartAxis, ChartCurve, ChartPanel, CurveForm};

/// Width of a picture [mm] and height of the axes [pt].
const WIDTH_MM: f64 = 178.0;
const HEIGHT: f64 = 190.0;
/// Smaller errors are drawn at this value [m]: joints described by coordinates do not come apart.
const LEAST_M: f64 = 1e-17;
/// Space between the outermost powers of ten and the ends of an axis, in powers of ten.
const MARGIN: f64 = 0.2;
/// Powers of ten that have a label on one axis.
const MOST_TICKS: usize = 14;

const OURS: &str = CURVE_COLORS[0];
const OURS_TOO: &str = CURVE_COLORS[5];
const MUJOCO: &str = CURVE_COLORS[1];
const RAPIER: &str = CURVE_COLORS[2];
const GREY: &str = CURVE_COLORS[7];

/// A curve in both panels: size, time [us], error [m].
struct Curve {
    name: String,
    color: &'static str,
    points: Vec<(f64, f64, f64)>,
}

/// Chains: all engines.
pub(super) fn scaling(results: &Results) -> Result<String, String> {
    let named =
        [(true, "Ambulo, with position projection", OURS), (false, "Ambulo, without position projection", OURS_TOO)];
    let ours = named.into_iter().filter_map(|(projection, name, color)| {
        let family = results.scaling.family("chain", projection)?;
        Some(Curve { name: name.to_owned(), color, points: points(&family.sizes) })
    });
    let curves: Vec<Curve> = ours.chain(peers(&results.peers, Scene::Chain)).collect();
    draw("simulation_scaling", "Open chain: time per step and joint error", "bodies", &curves)
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
    draw("simulation_ladder", "Ladder: time per step and loop error", "closed loops", &curves)
}

fn points(runs: &[(usize, Run)]) -> Vec<(f64, f64, f64)> {
    runs.iter().map(|(size, run)| (*size as f64, run.step_us.median, run.worst_m)).collect()
}

/// The engines in the settings that they come with.
fn peers(timings: &[PeerTiming], scene: Scene) -> Vec<Curve> {
    let settings = [(Peer::MuJoCo, "Euler", "MuJoCo", MUJOCO), (Peer::RapierF32, "default", "Rapier (f32)", RAPIER)];
    let curve = |(peer, setting, name, color): (Peer, &str, &str, &'static str)| {
        let of_it = timings.iter().filter(|t| t.scene == scene && t.peer == peer && t.setting == setting);
        let point = |timing: &PeerTiming| {
            let measured = timing.measurement()?;
            Some((timing.size as f64, measured.median_us, measured.constraint_error_m[0]?))
        };
        Curve { name: name.to_owned(), color, points: of_it.filter_map(point).collect() }
    };
    settings.into_iter().map(curve).filter(|curve| !curve.points.is_empty()).collect()
}

fn draw(name: &'static str, title: &str, sizes: &str, curves: &[Curve]) -> Result<String, String> {
    let panels = [
        panel(["time per step", sizes], curves, |(_, us, _)| us.log10(), time_label),
        panel(["worst error (m)", sizes], curves, |(_, _, m)| m.max(LEAST_M).log10(), error_label),
    ];
    let chart = Chart {
        name,
        title: title.to_owned(),
        caption: String::new(),
        width_mm: WIDTH_MM,
        columns: 2,
        panel_height_pt: HEIGHT,
        panels: panels.into(),
        notes: Vec::new(),
    };
    chart.svg().map_err(|e| e.to_string())
}

fn panel(
    [title, sizes]: [&str; 2],
    curves: &[Curve],
    height: impl Fn((f64, f64, f64)) -> f64,
    label: impl Fn(f64) -> String,
) -> ChartPanel {
    let drawn = |curve: &Curve| ChartCurve {
        name: curve.name.clone(),
        color: curve.color,
        form: CurveForm::DottedLine,
        points: curve.points.iter().map(|point| [point.0.log10(), height(*point)]).collect(),
    };
    let curves: Vec<ChartCurve> = curves.iter().map(drawn).collect();
    let decades_of = |k: usize| decades(curves.iter().flat_map(|curve| &curve.points).map(move |point| point[k]));
    let ([left, right], [low, high]) = (decades_of(0), decades_of(1));
    ChartPanel {
        title: title.to_owned(),
        abscissa: ChartAxis {
            label: sizes.to_owned(),
            range: Some([left - MARGIN, right + MARGIN]),
            ticks: ticks([left, right], |power| grouped(10.0_f64.powf(power))),
        },
        ordinate: ChartAxis {
            label: String::new(),
            range: Some([low - MARGIN, high + MARGIN]),
            ticks: ticks([low, high], label),
        },
        curves,
        ..ChartPanel::default()
    }
}

/// A tick at each power of ten; of many powers, at every second or third.
fn ticks([low, high]: [f64; 2], label: impl Fn(f64) -> String) -> Vec<(f64, String)> {
    let count = (high - low).round() as usize;
    let every = count.div_ceil(MOST_TICKS).max(1);
    (0..=count).step_by(every).map(|k| low + k as f64).map(|power| (power, label(power))).collect()
}

/// Whole decades around all values.
fn decades(values: impl Iterator<Item = f64> + Clone) -> [f64; 2] {
    let low = values.clone().fold(f64::INFINITY, f64::min).floor();
    let high = values.fold(f64::NEG_INFINITY, f64::max).ceil();
    if low < high { [low, high] } else { [low - 1.0, low + 1.0] }
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
        let svg = draw("chains", "Chains", "bodies", &[curve("one"), curve("other")]).unwrap();
        assert_eq!((svg.matches(">other</text>").count(), svg.matches(">10,000</text>").count()), (1, 2), "{svg}");
    }
}
