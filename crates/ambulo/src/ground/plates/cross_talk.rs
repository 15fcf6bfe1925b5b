//! Removes the load that a plate shows under no foot while another plate is loaded: cross-talk.
//!
//! Amplifiers and cables let a part of one plate's signal appear in another, and a floor carries a part of a step to
//! the next plate. Such a load is small, lasts as long as the load of the loaded plate, and no foot stands on the
//! plate. It exceeds 20 N for seconds, so that the plate seems loaded long before a foot is on it.
//! Pinned by: tests/feet_on_plates.rs

use super::feet::FeetInMotion;
use crate::findings::{Code, Findings};
use crate::ground::CENTER_OF_PRESSURE_LOAD_N;
use crate::model::Side;
use crate::motion::PlateRecording;
use crate::spatial::Vec3;

/// Cross-talk is at most this share of the largest force of all plates: what counts as vibration.
const OF_HIGHEST: f64 = super::VIBRATION;
/// ... or of the force of the other plates at the same time: amplifiers have 1 to 5 %, and floors some more.
const OF_OTHERS: f64 = 0.1;
/// ... and never more than this [N].
const MOST_N: f64 = 60.0;
/// The load of the other plates at the same time, as a share of the largest force.
const OTHERS_LOADED: f64 = 0.2;
/// Shortest cross-talk [s]; a foot loads a plate to more than cross-talk within 0.02 s.
const SHORTEST_S: f64 = 0.1;
/// A foot may be on the plate in this share of the time: errors of its events.
const FOOT_SHARE: f64 = 0.2;

/// The plates without cross-talk.
pub(super) fn removed(
    feet: &FeetInMotion<'_>,
    mut plates: Vec<PlateRecording>,
    findings: &mut Findings,
) -> Vec<PlateRecording> {
    let highest = plates.iter().map(PlateRecording::peak_n).fold(0.0, f64::max);
    let spans: Vec<Vec<[usize; 2]>> = (0..plates.len()).map(|plate| spans(feet, &plates, plate, highest)).collect();
    for (k, spans) in spans.into_iter().enumerate().filter(|(_, spans)| !spans.is_empty()) {
        report(&plates[k], &spans, findings);
        let source = source(&plates, k, &spans);
        let plate = &mut plates[k];
        subtract(&mut plate.force, &spans, &source);
        subtract(&mut plate.moment, &spans, &source);
    }
    plates
}

/// Upward force of the other plates [N], one entry per sample of a plate.
fn others(plates: &[PlateRecording], plate: usize) -> Vec<f64> {
    let samples = plates[plate].times.len();
    let of = |i: usize| {
        let others = plates.iter().enumerate().filter(|(k, other)| *k != plate && other.times.len() == samples);
        others.map(|(_, other)| other.vertical(i).max(0.0)).sum::<f64>()
    };
    (0..samples).map(of).collect()
}

/// Upward force of the plate that is loaded most during the cross-talk [N], one entry per sample of a plate.
fn source(plates: &[PlateRecording], plate: usize, spans: &[[usize; 2]]) -> Vec<f64> {
    let samples = plates[plate].times.len();
    let carried = |other: &PlateRecording| {
        spans.iter().flat_map(|[first, end]| *first..*end).map(|i| other.vertical(i).max(0.0)).sum::<f64>()
    };
    let others = plates.iter().enumerate().filter(|(k, other)| *k != plate && other.times.len() == samples);
    let source = others.map(|(_, other)| other).max_by(|a, b| carried(a).total_cmp(&carried(b)));
    (0..samples).map(|i| source.map_or(0.0, |source| source.vertical(i))).collect()
}

/// Removes cross-talk where it occurs alone, and its part while a foot is on the plate. This part is the same share of
/// the other plates' force, or the same amount, whichever fits better where cross-talk is alone.
fn subtract(values: &mut [Vec3], spans: &[[usize; 2]], source: &[f64]) {
    let alone =
        || spans.iter().flat_map(|[first, end]| *first..*end).filter(|i| source[*i] > CENTER_OF_PRESSURE_LOAD_N);
    let count = alone().count().max(1) as f64;
    let share =
        alone().map(|i| values[i] * source[i]).sum::<Vec3>() / alone().map(|i| source[i].powi(2)).sum::<f64>().max(1.0);
    let amount = alone().map(|i| values[i]).sum::<Vec3>() / count;
    let left = |talk: &dyn Fn(usize) -> Vec3| alone().map(|i| (values[i] - talk(i)).norm_squared()).sum::<f64>();
    let is_share = left(&|i| share * source[i]) < left(&|_| amount);
    let is_alone = |i: usize| spans.iter().any(|[first, end]| (*first..*end).contains(&i));
    for i in 0..values.len() {
        if is_alone(i) {
            values[i] = Vec3::zeros();
        } else if source[i] > CENTER_OF_PRESSURE_LOAD_N {
            values[i] -= if is_share { share * source[i] } else { amount };
        }
    }
}

/// Ranges of samples in which a plate shows cross-talk.
fn spans(feet: &FeetInMotion<'_>, plates: &[PlateRecording], plate: usize, highest: f64) -> Vec<[usize; 2]> {
    let own = &plates[plate];
    let others = others(plates, plate);
    let is_small = |i: usize| own.vertical(i) < (OF_HIGHEST * highest).max((OF_OTHERS * others[i]).min(MOST_N));
    let is_shown = |i: usize| own.is_loaded(i) && others[i] > OTHERS_LOADED * highest;
    let step_s = own.times.windows(2).next().map_or(f64::INFINITY, |pair| pair[1] - pair[0]);
    let indices: Vec<usize> = (0..own.times.len()).collect();
    let runs = indices.chunk_by(|a, b| is_small(*a) == is_small(*b)).filter(|run| is_small(run[0]));
    let shown = |run: &[usize]| run.iter().copied().filter(|i| is_shown(*i)).collect::<Vec<_>>();
    let is_cross_talk = |run: &&[usize]| {
        let shown = shown(run);
        let stands = |i: &&usize| Side::BOTH.iter().any(|side| feet.is_on(*side, own, own.times[**i]));
        let looked_at = || shown.iter().step_by((shown.len() / 50).max(1));
        shown.len() as f64 * step_s >= SHORTEST_S
            && looked_at().filter(stands).count() as f64 <= FOOT_SHARE * looked_at().count() as f64
    };
    runs.filter(is_cross_talk).map(|run| [run[0], run[run.len() - 1] + 1]).collect()
}

fn report(plate: &PlateRecording, spans: &[[usize; 2]], findings: &mut Findings) {
    let samples = || spans.iter().flat_map(|[first, end]| *first..*end).filter(|i| plate.is_loaded(*i));
    let most = samples().map(|i| plate.vertical(i)).fold(0.0, f64::max);
    let (first, last) = (samples().next().unwrap_or(0), samples().next_back().unwrap_or(0));
    let message = format!(
        "{} shows up to {most:.0} N between {:.3} and {:.3} s while another plate is loaded and no foot stands on it: \
         cross-talk; it was removed",
        plate.name, plate.times[first], plate.times[last]
    );
    findings.report(Code::PlatesCrossTalk, message);
}
