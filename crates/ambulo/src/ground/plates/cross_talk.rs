//! Removes the load that a plate shows under no foot while another plate is loaded: cross-talk.
//!
//! Amplifiers and cables let a part of one plate's signal appear in another, and a floor carries a part of a step to
//! the next plate. Such a load is small, lasts as long as the load of the loaded plate, and no foot stands on the
//! plate. It exceeds 20 N for seconds, so that the plate seems loaded long before a foot is on it.
//!
//! Smaller cross-talk, of children or of a few percent, follows the load of one other plate while a foot steps on that.
//! In 60 clean recordings (5 laboratories) the correlation of a plate under no foot with the others is at most 0.4, in
//! copies with 4 % of cross-talk at least 0.86.
//! Pinned by: tests/feet_on_plates.rs

use super::feet::FeetInMotion;
use crate::findings::{Code, Findings};
use crate::ground::CENTER_OF_PRESSURE_LOAD_N;
use crate::model::Side;
use crate::motion::PlateRecording;
use crate::numerics::{correlation, sample_deviation};
use crate::spatial::Vec3;

/// Cross-talk is at most this share of the largest force of all plates: what counts as vibration.
const OF_HIGHEST: f64 = super::VIBRATION;
/// ... or of the force of the other plates at the same time: amplifiers have 1 to 5 %, and floors some more.
const OF_OTHERS: f64 = 0.1;
/// ... and, if it does not follow one plate, never more than this [N].
const MOST_N: f64 = 60.0;
/// The load of the other plates at the same time, as a share of the largest force.
const OTHERS_LOADED: f64 = 0.2;
/// Shortest cross-talk [s]; a foot loads a plate to more than cross-talk within 0.02 s.
const SHORTEST_S: f64 = 0.1;
/// A foot may be on the plate in this share of the time: errors of its events.
const FOOT_SHARE: f64 = 0.2;

/// Cross-talk below what loads a plate follows another plate with at least this correlation and share.
const FOLLOWS: [f64; 2] = [0.8, 0.02];
/// Samples by which this is judged.
const JUDGED: usize = 500;

/// A time of cross-talk: first sample and the one after the last, and the plate that it follows, if it is known.
#[derive(Debug, Clone, Copy)]
struct Span {
    samples: [usize; 2],
    follows: Option<usize>,
}

/// The plates without cross-talk.
pub(super) fn removed(
    feet: &FeetInMotion<'_>,
    mut plates: Vec<PlateRecording>,
    findings: &mut Findings,
) -> Vec<PlateRecording> {
    let highest = plates.iter().map(PlateRecording::peak_n).fold(0.0, f64::max);
    let found: Vec<Vec<Span>> = (0..plates.len()).map(|plate| spans(feet, &plates, plate, highest)).collect();
    for (k, found) in found.into_iter().enumerate().filter(|(_, found)| !found.is_empty()) {
        let follows = found.iter().find_map(|span| span.follows);
        let spans: Vec<[usize; 2]> = found.into_iter().map(|span| span.samples).collect();
        report(&plates[k], &spans, follows.map(|other| plates[other].name.as_str()), findings);
        let source = source(&plates, k, &spans, follows);
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

/// Upward force of the plate that cross-talk follows, or that is loaded most during it [N], one entry per sample of a
/// plate.
fn source(plates: &[PlateRecording], plate: usize, spans: &[[usize; 2]], follows: Option<usize>) -> Vec<f64> {
    let samples = plates[plate].times.len();
    let carried = |other: &PlateRecording| {
        spans.iter().flat_map(|[first, end]| *first..*end).map(|i| other.vertical(i).max(0.0)).sum::<f64>()
    };
    let others = plates.iter().enumerate().filter(|(k, other)| *k != plate && other.times.len() == samples);
    let most = others.map(|(_, other)| other).max_by(|a, b| carried(a).total_cmp(&carried(b)));
    let source = follows.map(|other| &plates[other]).or(most);
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

/// Times in which a plate shows cross-talk.
fn spans(feet: &FeetInMotion<'_>, plates: &[PlateRecording], plate: usize, highest: f64) -> Vec<Span> {
    let own = &plates[plate];
    let others = others(plates, plate);
    let is_small = |i: usize| own.vertical(i) < (OF_HIGHEST * highest).max(OF_OTHERS * others[i]);
    let is_little = |i: usize| own.vertical(i) < (OF_HIGHEST * highest).max(MOST_N);
    let is_beside = |i: &usize| others[*i] > OTHERS_LOADED * highest;
    let step_s = own.times.windows(2).next().map_or(f64::INFINITY, |pair| pair[1] - pair[0]);
    let lasts = |samples: &[usize]| samples.len() as f64 * step_s >= SHORTEST_S;
    let indices: Vec<usize> = (0..own.times.len()).collect();
    let runs = indices.chunk_by(|a, b| is_small(*a) == is_small(*b)).filter(|run| is_small(run[0]));
    let of_run = |run: &[usize]| {
        let beside: Vec<usize> = run.iter().copied().filter(is_beside).collect();
        let loaded: Vec<usize> = beside.iter().copied().filter(|i| own.is_loaded(*i)).collect();
        let little = loaded.iter().filter(|i| is_little(**i)).count() as f64;
        let is_loaded = lasts(&loaded) && little >= (1.0 - FOOT_SHARE) * loaded.len() as f64;
        let follows = if lasts(&beside) { followed(plates, plate, run, highest) } else { None };
        let shown = if is_loaded { loaded } else { beside };
        let stands = |i: &&usize| Side::BOTH.iter().any(|side| feet.is_on(*side, own, own.times[**i]));
        let looked_at = || shown.iter().step_by((shown.len() / 50).max(1));
        let is_cross_talk = (is_loaded || follows.is_some())
            && looked_at().filter(stands).count() as f64 <= FOOT_SHARE * looked_at().count() as f64;
        is_cross_talk.then(|| Span { samples: [run[0], run[run.len() - 1] + 1], follows })
    };
    runs.filter_map(of_run).collect()
}

/// The plate whose load this one follows in a range of samples, where no third plate is loaded.
fn followed(plates: &[PlateRecording], plate: usize, range: &[usize], highest: f64) -> Option<usize> {
    let own = &plates[plate];
    let looked_at = || range.iter().copied().step_by((range.len() / JUDGED).max(1));
    let of_other = |(k, other): (usize, &PlateRecording)| {
        let is_third = |j: usize| j != plate && j != k && plates[j].times.len() == own.times.len();
        let third = |i: usize| (0..plates.len()).filter(|j| is_third(*j)).map(|j| plates[j].vertical(i)).sum::<f64>();
        let alone: Vec<usize> = looked_at().filter(|i| third(*i) < OF_HIGHEST * highest).collect();
        let is_stepped_on = alone.iter().any(|i| other.vertical(*i) > OTHERS_LOADED * highest);
        let [talk, load] = [own, other].map(|plate| alone.iter().map(|i| plate.vertical(*i)).collect::<Vec<f64>>());
        let follows = correlation(&talk, &load);
        let share = follows * sample_deviation(&talk)? / sample_deviation(&load)?;
        let [least, least_share] = FOLLOWS;
        (is_stepped_on && follows > least && share > least_share).then_some((k, follows))
    };
    let others = plates.iter().enumerate().filter(|(k, other)| *k != plate && other.times.len() == own.times.len());
    others.filter_map(of_other).max_by(|a, b| a.1.total_cmp(&b.1)).map(|(k, _)| k)
}

fn report(plate: &PlateRecording, spans: &[[usize; 2]], follows: Option<&str>, findings: &mut Findings) {
    let samples = || spans.iter().flat_map(|[first, end]| *first..*end);
    let most = samples().map(|i| plate.vertical(i)).fold(0.0, f64::max);
    let is_shown = |i: &usize| plate.is_loaded(*i) || 2.0 * plate.vertical(*i) > most;
    let (first, last) = (samples().find(is_shown).unwrap_or(0), samples().rfind(is_shown).unwrap_or(0));
    let source = follows.unwrap_or("another plate");
    let message = format!(
        "{} shows up to {most:.0} N between {:.3} and {:.3} s while {source} is loaded and no foot stands on it: \
         cross-talk; it was removed",
        plate.name, plate.times[first], plate.times[last]
    );
    findings.report(Code::PlatesCrossTalk, message);
}
