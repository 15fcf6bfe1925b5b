//! One recording: its prediction against plates, and again with each source of error replaced by the truth.

use super::recording::{Group, Loaded, Recording};
use ambulo::analysis::{
    Analysis, GroundAgreement, MassSource, PLATES_LOW_PASS, PredictOrder, PredictedAnalysis, Seen, Settings,
    analyse_predicted,
};
use ambulo::findings::Findings;
use ambulo::ground::footfalls::{Footfall, Footfalls};
use ambulo::ground::predict::{Known, PredictSettings, predict};
use ambulo::ground::{BodyForces, feet};
use ambulo::kinematics::Trajectory;
use ambulo::model::Side;
use ambulo::motion::filter::LowPass;
use ambulo::motion::{Smoother, TimeGrid, Window};
use ambulo::spatial::{Vec3, Wrench};
use std::time::Instant;

/// What `ambulo forces` filters motion with when nobody says.
const MOTION_FILTER: LowPass = LowPass { order: 3, cutoff_hz: 6.0 };
/// A foot is loaded above this vertical force [N].
const LOADED_N: f64 = 20.0;

/// A recording, judged.
pub(super) struct Trial {
    pub(super) label: &'static str,
    pub(super) subject: &'static str,
    pub(super) group: Group,
    pub(super) mass_source: &'static str,
    pub(super) rule: &'static str,
    pub(super) frames: usize,
    /// Time of the prediction alone, a frame [µs].
    pub(super) microseconds: f64,
    /// Vertical peak of each whole stance over the plate's, less one: side, time of strike [s], share.
    pub(super) peaks_off: Vec<(&'static str, f64, f64)>,
    /// Time without a loaded foot while plates measured every foot: predicted, measured [s].
    pub(super) flight_s: [f64; 2],
    pub(super) agreement: GroundAgreement,
    /// The agreement while plates measured every foot, with something known: what, how.
    pub(super) budget: Vec<(&'static str, GroundAgreement)>,
}

impl Trial {
    pub(super) fn run(recording: &Recording, loaded: &Loaded) -> Result<Trial, String> {
        let (predicted, seen) = predicted(loaded, Known::default())?;
        let agreement = predicted.agreement(&loaded.model, &seen).ok_or("plates saw no foot in full")?;
        let measured = predicted.measured.as_ref().ok_or("no plates")?;
        let judged = inside_window(&seen);
        let mut budget = Vec::new();
        budget.extend(predicted.agreement(&loaded.model, &judged).map(|agreement| ("nothing", agreement)));
        for (source, known) in truths(loaded, &predicted, measured, &seen) {
            let (again, _) = self::predicted(loaded, known)?;
            budget.extend(again.agreement(&loaded.model, &judged).map(|agreement| (source, agreement)));
        }
        let trajectory = &predicted.analysis.trajectory;
        Ok(Trial {
            label: recording.label,
            subject: recording.subject,
            group: recording.group,
            mass_source: match measured.mass.source {
                MassSource::Plates => "plates",
                MassSource::Standing => "standing",
                MassSource::Model => "stated",
            },
            rule: predicted.prediction.rule,
            frames: trajectory.grid().frames,
            microseconds: microseconds(loaded, trajectory)?,
            peaks_off: peaks_off(loaded, &predicted.analysis, measured, &seen),
            flight_s: [&predicted.analysis, measured].map(|analysis| flight_s(loaded, analysis, &seen)),
            agreement,
            budget,
        })
    }
}

/// The prediction and what plates saw, as the command makes them.
pub(crate) fn predicted(loaded: &Loaded, known: Known) -> Result<(PredictedAnalysis, Seen), String> {
    let Loaded { model, motion, plates, person, body, standing_kg } = loaded;
    let on_plates = body.as_ref().filter(|body| !body.on_plates.contacts.is_empty());
    let longest = body.as_ref().and_then(|body| body.longest_known_s());
    let window = longest.map_or(Window::default(), |[from, to]| Window { from_s: Some(from), to_s: Some(to) });
    let settings = Settings {
        smoother: Smoother::Butterworth(MOTION_FILTER),
        force_filter: None,
        window,
        rate_hz: None,
        instrumented: None,
    };
    let order = PredictOrder {
        soles: &person.soles,
        settings: &PredictSettings { known, ..PredictSettings::default() },
        plates_filter: Some(PLATES_LOW_PASS),
    };
    let mut findings = Findings::default();
    let mut predicted = analyse_predicted(model, motion, plates, settings, &order, &mut findings, &mut |_| ())
        .map_err(|e| e.to_string())?;
    let measured = predicted.measured.as_mut().ok_or("no plates")?;
    let seen = match on_plates {
        Some(body) => body.seen(),
        None => Seen::by_load(measured, plates, &predicted.prediction.footfalls),
    };
    if let Some(body) = on_plates {
        measured.take_events(&body.measured_events(), &body.events(&body.feet.events));
    }
    predicted.weigh(model, seen.window, *standing_kg);
    Ok((predicted, seen))
}

/// Only what happened while plates measured every foot: there each source of error can be replaced in full.
fn inside_window(seen: &Seen) -> Seen {
    let Some([from, to]) = seen.window else { return Seen { stances: Vec::new(), ..seen.clone() } };
    let clipped = seen.stances.iter().map(|(side, [start, end])| (*side, [start.max(from), end.min(to)]));
    Seen { stances: clipped.filter(|(_, [start, end])| end > start).collect(), ..seen.clone() }
}

/// What plates know of each source of error.
fn truths(
    loaded: &Loaded,
    predicted: &PredictedAnalysis,
    measured: &Analysis,
    seen: &Seen,
) -> Vec<(&'static str, Known)> {
    let grid = predicted.analysis.trajectory.grid();
    let by_side = feet(&loaded.model, &measured.ground);
    let of = |side: Side| by_side.iter().find(|(s, _)| *s == side).map(|(_, forces)| forces);
    let footfalls = Some(true_footfalls(&predicted.prediction.footfalls, seen));
    let (Some(right), Some(left)) = (of(Side::Right), of(Side::Left)) else {
        return vec![("events", Known { footfalls, ..Known::default() })];
    };
    let total = Some(true_total(grid, right, left, seen));
    let right_share = Some(true_share(grid, right, left, seen));
    let centers = Some([right.center_of_pressure.clone(), left.center_of_pressure.clone()]);
    let none = Known::default;
    vec![
        ("total wrench", Known { total: total.clone(), ..none() }),
        ("vertical split", Known { right_share: right_share.clone(), ..none() }),
        ("centres of pressure", Known { centers: centers.clone(), ..none() }),
        ("events", Known { footfalls: footfalls.clone(), ..none() }),
        ("events and split", Known { footfalls: footfalls.clone(), right_share: right_share.clone(), ..none() }),
        ("everything", Known { footfalls, total, right_share, centers }),
    ]
}

/// Stances by plates; by motion where there were none.
fn true_footfalls(found: &Footfalls, seen: &Seen) -> Footfalls {
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
fn in_window(grid: TimeGrid, seen: &Seen, frame: usize) -> bool {
    seen.window.is_some_and(|[from, to]| (from..=to).contains(&grid.time(frame)))
}

fn true_total(grid: TimeGrid, right: &BodyForces, left: &BodyForces, seen: &Seen) -> Vec<Wrench> {
    let unknown = Vec3::repeat(f64::NAN);
    let at = |i: usize| match in_window(grid, seen, i) {
        true => Wrench { force: right.force[i] + left.force[i], moment: right.moment[i] + left.moment[i] },
        false => Wrench { force: unknown, moment: unknown },
    };
    (0..grid.frames).map(at).collect()
}

fn true_share(grid: TimeGrid, right: &BodyForces, left: &BodyForces, seen: &Seen) -> Vec<f64> {
    let share = |i: usize| {
        let [right, left] = [right, left].map(|foot| foot.force[i].y.max(0.0));
        if in_window(grid, seen, i) { right / (right + left) } else { f64::NAN }
    };
    (0..grid.frames).map(share).collect()
}

/// Time of a prediction, a frame [µs]: the best of a few.
fn microseconds(loaded: &Loaded, trajectory: &Trajectory) -> Result<f64, String> {
    const RUNS: usize = 5;
    let mut best = f64::INFINITY;
    for _ in 0..RUNS {
        let (settings, mut findings) = (PredictSettings::default(), Findings::default());
        let start = Instant::now();
        predict(&loaded.model, trajectory, &loaded.person.soles, &settings, &mut findings)
            .map_err(|e| e.to_string())?;
        best = best.min(start.elapsed().as_secs_f64());
    }
    Ok(1e6 * best / trajectory.grid().frames as f64)
}

/// Largest vertical force of each whole stance against the plate's.
fn peaks_off(loaded: &Loaded, found: &Analysis, truth: &Analysis, seen: &Seen) -> Vec<(&'static str, f64, f64)> {
    let grid = found.trajectory.grid();
    let sides = |analysis: &Analysis| feet(&loaded.model, &analysis.ground);
    let (found, truth) = (sides(found), sides(truth));
    let peak = |feet: &[(Side, BodyForces)], side: Side, [from, to]: [f64; 2]| {
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
fn flight_s(loaded: &Loaded, analysis: &Analysis, seen: &Seen) -> f64 {
    let (grid, feet) = (analysis.trajectory.grid(), feet(&loaded.model, &analysis.ground));
    let flies = |i: &usize| in_window(grid, seen, *i) && feet.iter().all(|(_, foot)| foot.force[*i].y < LOADED_N);
    (0..grid.frames).filter(flies).count() as f64 * grid.step_s
}
