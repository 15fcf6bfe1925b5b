//! Criteria for an optimal walk at one speed.

use super::Found;
use super::curves::{QUANTITIES, Quantity};
use crate::normative::{Band, Sheet};
use ambulo::numerics::{correlation, extremes};

/// One line of the page: quantity, limit, result at one speed, and whether the limit is met.
pub(super) struct Criterion {
    pub(super) what: String,
    pub(super) limit: &'static str,
    pub(super) result: String,
    pub(super) met: bool,
}

/// Number of the speeds that are slower than free walking.
const SLOW: usize = 2;

/// All criteria at one of the five speeds.
pub(super) fn all(found: &Found, bands: &[Band], speed: usize, sideways: &[f64]) -> Vec<Criterion> {
    let mut lines: Vec<Criterion> = Vec::new();
    for (k, quantity) in QUANTITIES.iter().enumerate() {
        lines.push(curve(*quantity, &found.cycle.curves[k], &bands[k], speed));
    }
    let abduction = QUANTITIES.iter().position(|q| q.name == "hip abduction moment").unwrap_or(0);
    lines.push(peaks(&found.cycle.curves[abduction], &bands[abduction]));
    let cycle = &found.cycle;
    let mut add = |what: &str, limit: &'static str, result: String, met: bool| {
        lines.push(Criterion { what: what.to_owned(), limit, result, met });
    };
    let r = correlation(&cycle.sideways, sideways);
    add("sideways force over stance, r with the recordings", ">= 0.88", format!("{r:.3}"), r >= 0.88);
    let middle = &cycle.sideways[20..=30];
    let mean = 100.0 * middle.iter().sum::<f64>() / middle.len() as f64;
    add("sideways force in mid-stance [%BW, medial]", "2 to 6", format!("{mean:.1}"), (2.0..=6.0).contains(&mean));
    let strike = 100.0 * extremes(&cycle.sideways[..10]).0;
    add("smallest sideways force after the strike [%BW]", "lateral (< 0)", format!("{strike:.1}"), strike < 0.0);
    let width = cycle.step_width * 0.93 / found.leg_length;
    add("step width x 0.93 m / leg [m]", "0.08 to 0.15", format!("{width:.3}"), (0.08..=0.15).contains(&width));
    add("smallest flexion of the knee [deg]", ">= 0", format!("{:.1}", cycle.least_knee), cycle.least_knee >= 0.0);
    add("slip of a stance [mm]", "< 3", format!("{:.1}", 1e3 * cycle.slip), cycle.slip < 3e-3);
    let [up, net] = cycle.mean_force;
    let balanced = (up - 1.0).abs() <= 0.005 && net.abs() <= 0.01;
    add("mean vertical / fore-aft force [BW]", "1 +- 0.005 / 0 +- 0.01", format!("{up:.4} / {net:.4}"), balanced);
    let small = found.root.1 <= 1e-4;
    add("largest residual force at the root [BW, BW x leg]", "<= 1e-4", format!("{:.0e}", found.root.1), small);
    let between = format!("{:.0e} / {:.0e}", found.between.0, found.between.1);
    add("the same between the instants, RMS / largest", "", between, true);
    let drift = (1e3 * found.drift.place_m, found.drift.angle_rad.to_degrees());
    let stays = drift.0 <= 10.0 && drift.1 <= 2.0;
    add(
        "drift of a cycle simulated forward [mm / deg]",
        "<= 10 / 2",
        format!("{:.2} / {:.3}", drift.0, drift.1),
        stays,
    );
    let quick = found.seconds <= 8.0;
    add("CPU time [s], steps", "<= 8", format!("{:.1}, {}", found.seconds, found.steps), quick);
    lines
}

/// Correlation and share inside the band; for some curves also range or RMS difference.
fn curve(quantity: Quantity, ours: &[f64], band: &Band, speed: usize) -> Criterion {
    let r = correlation(ours, &band.mean);
    let inside = inside(ours, band);
    let span = |c: &[f64]| extremes(c).1 - extremes(c).0;
    let range = span(ours) / span(&band.mean);
    let rms = (ours.iter().zip(&band.mean).map(|(a, b)| (a - b).powi(2)).sum::<f64>() / ours.len() as f64).sqrt();
    let slow = speed < SLOW;
    let out_of_plane =
        ["pelvic obliquity", "pelvic rotation", "hip adduction", "hip rotation"].contains(&quantity.name);
    let (limit, met) = match (quantity.sheet, quantity.name) {
        (_, "hip rotation") => ("", true),
        (Sheet::Angles, _) if out_of_plane && slow => ("inside >= 95 %", inside >= 0.95),
        (Sheet::Angles, name) if out_of_plane => {
            let least = if name == "pelvic rotation" { 0.80 } else { 0.90 };
            let limit = if name == "pelvic rotation" {
                "r >= 0.80, 95 %, range +- 35 %"
            } else {
                "r >= 0.90, 95 %, range +- 35 %"
            };
            (limit, r >= least && inside >= 0.95 && (range - 1.0).abs() <= 0.35)
        }
        (Sheet::Angles, _) => ("r >= 0.95, 95 %", r >= 0.95 && inside >= 0.95),
        (Sheet::Moments, "knee extension moment") if slow => ("r >= 0.60, RMS <= 0.08", r >= 0.60 && rms <= 0.08),
        (Sheet::Moments, "knee extension moment") => ("r >= 0.85", r >= 0.85),
        (Sheet::Moments, "hip abduction moment") => ("r >= 0.90", r >= 0.90),
        (Sheet::Moments, _) => ("r >= 0.92", r >= 0.92),
        _ => ("r >= 0.95", r >= 0.95),
    };
    let extra = match quantity.sheet {
        Sheet::Moments => format!(", RMS {rms:.2}"),
        _ if out_of_plane => format!(", range x {range:.2}"),
        _ => String::new(),
    };
    let what = format!("{}, r (inside)", quantity.name);
    Criterion { what, limit, result: format!("{r:.3} ({:.0} %){extra}", 100.0 * inside), met }
}

/// Share of the samples within two standard deviations of the mean.
fn inside(ours: &[f64], band: &Band) -> f64 {
    let within =
        ours.iter().zip(&band.mean).zip(&band.sd).filter(|((value, mean), sd)| (*value - *mean).abs() <= 2.0 * *sd);
    within.count() as f64 / ours.len() as f64
}

/// The two peaks of the hip abduction moment, before and after a quarter of the cycle, relative to those of people.
fn peaks(ours: &[f64], band: &Band) -> Criterion {
    let humps = |curve: &[f64]| {
        let quarter = curve.len() / 4 + 2;
        [extremes(&curve[..quarter]).1, extremes(&curve[quarter..]).1]
    };
    let [first, second] = [0, 1].map(|k| humps(ours)[k] / humps(&band.mean)[k]);
    let met = [first, second].iter().all(|share| (share - 1.0).abs() <= 0.2);
    Criterion {
        what: "peaks of the hip abduction moment, relative to people".to_owned(),
        limit: "0.8 to 1.2",
        result: format!("{first:.2} / {second:.2}"),
        met,
    }
}
