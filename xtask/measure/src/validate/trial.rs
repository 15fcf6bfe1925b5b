//! One recording: its prediction compared with measured forces, also with each source of error replaced by its measured
//! value.

use super::recording::Recording;
use super::tracking::Tracked;
use ambulo::analysis::{Analysis, GroundAgreement, PlateCoverage};
use ambulo::findings::Findings;
use ambulo::ground::footfalls::{Footfall, Footfalls};
use ambulo::ground::predict::{PredictSettings, Prescribed, predict};
use ambulo::ground::{BodyForces, feet};
use ambulo::model::{BySide, Side};
use ambulo::motion::{TimeGrid, Window};
use ambulo::spatial::{Vec3, Wrench};
use ambulo::study::validation::{JudgedTrial, Method};
use ambulo::study::{Outcome, PredictedGround, Source};
use std::borrow::Cow;
use std::time::Instant;

/// A foot is loaded above this vertical force [N].
const LOADED_N: f64 = 20.0;

/// Results of a recording.
pub(super) struct Trial {
    /// Agreement of the prediction with the plates; its kind is the group of the recording.
    pub(super) judged: JudgedTrial,
    pub(super) frames: usize,
    /// Time of the prediction alone, per frame [µs].
    pub(super) microseconds: f64,
    /// Relative error of the vertical peak of each whole stance: side, time of foot strike [s], share.
    pub(super) peaks_off: Vec<(&'static str, f64, f64)>,
    /// Time without a loaded foot in the instrumented window: predicted, measured [s].
    pub(super) flight_s: [f64; 2],
    /// The agreement in the instrumented window with one source of error replaced: name, agreement.
    pub(super) budget: Vec<(&'static str, GroundAgreement)>,
    /// Tracking of the same motion.
    pub(super) tracked: Option<Tracked>,
}

impl Trial {
    pub(super) fn run(recording: &Recording, source: &Source) -> Result<Trial, String> {
        let outcome = recording.predict(source, Prescribed::default())?;
        let judged = JudgedTrial::of(recording.label, recording.subject, &outcome, &Findings::default());
        let mut judged = JudgedTrial { kind: recording.group.word().to_owned(), ..judged.map_err(|e| e.to_string())? };
        let PredictedGround { prediction, measured, coverage, .. } =
            outcome.prediction.as_ref().ok_or("nothing was predicted")?;
        let (measured, seen) = measured.as_ref().zip(coverage.as_ref()).ok_or("no plates")?;
        let window = inside_window(seen);
        let mut budget = Vec::new();
        budget.extend(outcome.agreement_over(&window).map(|agreement| ("nothing", agreement)));
        for (name, prescribed) in truths(&outcome, &prediction.footfalls, measured, seen) {
            let again = recording.predict(source, prescribed)?;
            budget.extend(again.agreement_over(&window).map(|agreement| (name, agreement)));
        }
        let tracked = Tracked::new(recording, &outcome, &judged.agreement);
        let solved = tracked.as_ref().and_then(|tracked| tracked.found.as_ref().ok());
        judged.others.extend(solved.map(|found| (Method::Tracking, found.agreement.clone())));
        Ok(Trial {
            frames: outcome.analysis.trajectory.grid().frames,
            microseconds: microseconds(&outcome)?,
            peaks_off: peaks_off(&outcome, measured, seen),
            flight_s: [&outcome.analysis, measured].map(|analysis| flight_s(&outcome, analysis, seen)),
            tracked,
            judged,
            budget,
        })
    }
}

/// Restricted to the instrumented window, where each source of error can be replaced completely.
fn inside_window(seen: &PlateCoverage) -> PlateCoverage {
    let Some([from, to]) = seen.window else { return PlateCoverage { stances: Vec::new(), ..seen.clone() } };
    let clipped = seen.stances.iter().map(|(side, [start, end])| (*side, [start.max(from), end.min(to)]));
    PlateCoverage { stances: clipped.filter(|(_, [start, end])| end > start).collect(), ..seen.clone() }
}

/// The measured value of each source of error.
fn truths(
    outcome: &Outcome,
    found: &Footfalls,
    measured: &Analysis,
    seen: &PlateCoverage,
) -> Vec<(&'static str, Prescribed)> {
    let grid = outcome.analysis.trajectory.grid();
    let by_side = feet(&outcome.body, &measured.ground);
    let of = |side: Side| by_side.iter().find(|(s, _)| *s == side).map(|(_, forces)| &**forces);
    let footfalls = Some(true_footfalls(found, seen));
    let (Some(right), Some(left)) = (of(Side::Right), of(Side::Left)) else {
        return vec![("events", Prescribed { footfalls, ..Prescribed::default() })];
    };
    let total = Some(true_total(grid, right, left, seen));
    let right_share = Some(true_share(grid, right, left, seen));
    let centers = Some(BySide { right: right.center_of_pressure.clone(), left: left.center_of_pressure.clone() });
    let none = Prescribed::default;
    vec![
        ("total wrench", Prescribed { total: total.clone(), ..none() }),
        ("vertical split", Prescribed { right_share: right_share.clone(), ..none() }),
        ("centres of pressure", Prescribed { centers: centers.clone(), ..none() }),
        ("events", Prescribed { footfalls: footfalls.clone(), ..none() }),
        ("events and split", Prescribed { footfalls: footfalls.clone(), right_share: right_share.clone(), ..none() }),
        ("everything", Prescribed { footfalls, total, right_share, centers }),
    ]
}

/// Stances by plates; by motion where there were none.
fn true_footfalls(found: &Footfalls, seen: &PlateCoverage) -> Footfalls {
    let overlaps = |fall: &Footfall, side: Side, span: [f64; 2]| {
        let from = fall.strike_s.unwrap_or(f64::NEG_INFINITY);
        fall.side == side && from < span[1] && fall.off_s.unwrap_or(f64::INFINITY) > span[0]
    };
    let is_seen = |fall: &&Footfall| seen.stances.iter().any(|(side, span)| overlaps(fall, *side, *span));
    let mut falls: Vec<Footfall> = found.falls.iter().filter(|fall| !is_seen(fall)).copied().collect();
    falls.extend(seen.stances.iter().map(|&(side, span)| {
        let like = found.falls.iter().find(|fall| overlaps(fall, side, span)).or(found.falls.first());
        Footfall {
            side,
            strike_s: Some(span[0]),
            off_s: Some(span[1]),
            floor_height_m: like.map_or(0.0, |fall| fall.floor_height_m),
            floor_velocity: like.map_or(Vec3::zeros(), |fall| fall.floor_velocity),
        }
    }));
    let start = |fall: &Footfall| fall.strike_s.unwrap_or(f64::NEG_INFINITY);
    falls.sort_by(|a, b| start(a).total_cmp(&start(b)).then(a.side.cmp(&b.side)));
    Footfalls { falls, ..found.clone() }
}

/// Whether plates measured every foot in a frame.
fn in_window(grid: TimeGrid, seen: &PlateCoverage, frame: usize) -> bool {
    seen.window.is_some_and(|[from, to]| (from..=to).contains(&grid.time(frame)))
}

fn true_total(grid: TimeGrid, right: &BodyForces, left: &BodyForces, seen: &PlateCoverage) -> Vec<Wrench> {
    let unknown = Vec3::repeat(f64::NAN);
    let at = |i: usize| match in_window(grid, seen, i) {
        true => Wrench { force: right.force[i] + left.force[i], moment: right.moment[i] + left.moment[i] },
        false => Wrench { force: unknown, moment: unknown },
    };
    (0..grid.frames).map(at).collect()
}

fn true_share(grid: TimeGrid, right: &BodyForces, left: &BodyForces, seen: &PlateCoverage) -> Vec<f64> {
    let share = |i: usize| {
        let [right, left] = [right, left].map(|foot| foot.force[i].y.max(0.0));
        if in_window(grid, seen, i) { right / (right + left) } else { f64::NAN }
    };
    (0..grid.frames).map(share).collect()
}

/// Time of a prediction per frame [µs]: the best of several.
fn microseconds(outcome: &Outcome) -> Result<f64, String> {
    const RUNS: usize = 5;
    let trajectory = &outcome.analysis.trajectory;
    let mut best = f64::INFINITY;
    for _ in 0..RUNS {
        let (settings, mut findings) = (PredictSettings::default(), Findings::default());
        let start = Instant::now();
        predict(&outcome.body, trajectory, &outcome.person.soles, &settings, &mut findings)
            .map_err(|e| e.to_string())?;
        best = best.min(start.elapsed().as_secs_f64());
    }
    Ok(1e6 * best / trajectory.grid().frames as f64)
}

/// Largest vertical force of each whole stance compared with the measured one.
fn peaks_off(outcome: &Outcome, truth: &Analysis, seen: &PlateCoverage) -> Vec<(&'static str, f64, f64)> {
    let grid = outcome.analysis.trajectory.grid();
    let (found, truth) = (feet(&outcome.body, &outcome.analysis.ground), feet(&outcome.body, &truth.ground));
    let peak = |feet: &[(Side, Cow<'_, BodyForces>)], side: Side, [from, to]: [f64; 2]| {
        let (_, foot) = feet.iter().find(|(s, _)| *s == side)?;
        let (first, count) = grid.inside(Window { from_s: Some(from), to_s: Some(to) });
        Some(foot.force[first..first + count].iter().map(|f| f.y).fold(0.0, f64::max))
    };
    let off = |&(side, span): &(Side, [f64; 2])| {
        let whole = span[0] >= grid.start_s && span[1] <= grid.end_s();
        let share = peak(&found, side, span)? / peak(&truth, side, span)? - 1.0;
        whole.then_some((side.letter(), span[0], share))
    };
    seen.stances.iter().filter_map(off).collect()
}

/// Time without a loaded foot inside the window [s].
fn flight_s(outcome: &Outcome, analysis: &Analysis, seen: &PlateCoverage) -> f64 {
    let (grid, feet) = (analysis.trajectory.grid(), feet(&outcome.body, &analysis.ground));
    let flies = |i: &usize| in_window(grid, seen, *i) && feet.iter().all(|(_, foot)| foot.force[*i].y < LOADED_N);
    (0..grid.frames).filter(flies).count() as f64 * grid.step_s
}
