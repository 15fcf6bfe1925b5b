//! Builds the result of the fit, and reports missing, excluded, swapped and misplaced markers and gaps of coordinates.

use super::frames::Frames;
use super::gaps::Determination;
use super::misplaced::Misplaced;
use super::problem::{FitProblem, listed};
use super::result::{MarkerFit, MarkerResidual};
use crate::findings::{Code, Findings};
use crate::model::{Drive, Model};
use crate::motion::{MarkerRecording, Motion};
use crate::numerics::counted;
use crate::spatial::Vec3;

/// Maximum number of time spans in a message.
const MOST_SPANS: usize = 6;

/// The result of a fit, with corrections instead of a corrected recording.
pub(super) struct Fitted {
    motion: Motion,
    errors: Vec<MarkerResidual>,
    rms_m: Vec<f64>,
    iterations: Vec<usize>,
    converged: Vec<bool>,
    solves: usize,
    /// Marker of the recording, frame, and the corrected position there [m]; NaN removes the marker.
    corrections: Vec<(usize, usize, Vec3)>,
}

impl Fitted {
    /// Returns the result and the corrected recording.
    pub(super) fn following(self, mut recording: MarkerRecording) -> (MarkerFit, MarkerRecording) {
        for (marker, frame, position) in &self.corrections {
            recording.markers[*marker].positions[*frame] = *position;
        }
        (self.alone(), recording)
    }

    /// The result without corrections.
    pub(super) fn alone(self) -> MarkerFit {
        MarkerFit {
            motion: self.motion,
            errors: self.errors,
            rms_m: self.rms_m,
            followed: None,
            iterations: self.iterations,
            converged: self.converged,
            solves: self.solves,
        }
    }
}

/// The result of the fit: coordinates, distances and corrections of the markers.
pub(super) fn fit(
    model: &Model,
    recording: &MarkerRecording,
    problem: &mut FitProblem<'_>,
    frames: &Frames,
    states: &[Determination],
) -> Fitted {
    let count = frames.count();
    let leaders = leaders(model, problem);
    let mut columns: Vec<Option<Vec<f64>>> =
        leaders.iter().map(|leader| (*leader != Leader::Nothing).then(|| vec![f64::NAN; count])).collect();
    let mut distances = vec![Distances::default(); frames.markers()];
    let mut rms_m = vec![f64::NAN; count];
    for frame in (0..count).filter(|&frame| frames.outcomes[frame].is_some()) {
        frames.load(frame, problem);
        problem.pose_at(frames.posture(frame));
        let states = &states[frame * problem.tree.unknowns()..(frame + 1) * problem.tree.unknowns()];
        for ((column, value), leader) in columns.iter_mut().zip(problem.tree.values()).zip(&leaders) {
            let is_gap = matches!(leader, Leader::Unknown(u) if states[*u] == Determination::Gap);
            if let (Some(column), false) = (column, is_gap) {
                column[frame] = *value;
            }
        }
        rms_m[frame] = note_distances(problem, &mut distances);
    }
    let errors = distances.iter().enumerate().map(|(i, d)| d.error(i, problem, frames)).collect();
    Fitted {
        motion: Motion { origin: format!("markers of {}", recording.name), times: problem.times.to_vec(), columns },
        errors,
        rms_m,
        corrections: corrections(recording, problem, frames, states),
        iterations: frames.outcomes.iter().map(|o| o.map_or(0, |o| o.steps)).collect(),
        converged: frames.outcomes.iter().map(|o| o.is_none_or(|o| o.converged)).collect(),
        solves: problem.solver.budget.spent(),
    }
}

/// Source of the value of a coordinate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Leader {
    /// Nothing: it moves no marker.
    Nothing,
    /// The model: a lock or a function of time.
    Model,
    /// An unknown: its own, or that of its coupler.
    Unknown(usize),
}

/// Source of the value of each coordinate of the model.
pub(super) fn leaders(model: &Model, problem: &FitProblem<'_>) -> Vec<Leader> {
    let own = |c: usize| (0..problem.tree.unknowns()).find(|&u| problem.tree.coordinate(u) == c);
    let leader = |(i, drive): (usize, &Drive)| match drive {
        Drive::Free => own(i).map_or(Leader::Nothing, Leader::Unknown),
        Drive::Coupled(leader, _) => match &model.coordinates()[leader.index()].drive {
            Drive::Free => own(leader.index()).map_or(Leader::Nothing, Leader::Unknown),
            _ => Leader::Model,
        },
        Drive::Locked | Drive::Prescribed(_) => Leader::Model,
    };
    model.coordinates().iter().map(|c| &c.drive).enumerate().map(leader).collect()
}

#[derive(Debug, Clone, Copy, Default)]
struct Distances {
    square: f64,
    most: f64,
    used: usize,
}

/// Adds the distances of the loaded markers; returns their RMS.
fn note_distances(problem: &FitProblem<'_>, distances: &mut [Distances]) -> f64 {
    let (mut sum, mut used) = (0.0, 0);
    for (i, d) in distances.iter_mut().enumerate() {
        if problem.frame_weights[i] > 0.0 {
            let distance = problem.distance(i);
            d.square += distance * distance;
            d.most = d.most.max(distance);
            d.used += 1;
            sum += distance * distance;
            used += 1;
        }
    }
    (sum / f64::from(used)).sqrt()
}

impl Distances {
    fn error(&self, i: usize, problem: &FitProblem<'_>, frames: &Frames) -> MarkerResidual {
        let seen = || (0..frames.count()).filter(|&f| frames.is_seen(f, i));
        MarkerResidual {
            name: problem.paths[i].name.clone(),
            rms_m: (self.square / self.used as f64).sqrt(),
            max_m: if self.used > 0 { self.most } else { f64::NAN },
            seen: seen().count(),
            down_weighted: seen().filter(|&f| !frames.is_used(f, i)).count(),
        }
    }
}

/// Corrections of the recording: swapped labels are swapped back, outliers are removed, and missing markers get the
/// positions that follow from the fitted posture and their offsets, if the posture is known. Events and plates are
/// detected from these markers, so that a foot is not lost with its toe marker. Markers that the model does not have
/// are kept.
fn corrections(
    recording: &MarkerRecording,
    problem: &mut FitProblem<'_>,
    frames: &Frames,
    states: &[Determination],
) -> Vec<(usize, usize, Vec3)> {
    let mut all = Vec::new();
    let numbers: Vec<Option<usize>> =
        problem.paths.iter().map(|path| recording.markers.iter().position(|m| m.name == path.name)).collect();
    let unknowns = problem.tree.unknowns();
    for frame in 0..frames.count() {
        let own = &states[frame * unknowns..(frame + 1) * unknowns];
        let is_posed = frames.outcomes[frame].is_some() && !own.contains(&Determination::Gap);
        let lacks = |i: usize| !frames.is_used(frame, i);
        if is_posed && (0..frames.markers()).any(lacks) {
            frames.load(frame, problem);
            problem.pose_at(frames.posture(frame));
        }
        for (i, number) in numbers.iter().enumerate() {
            let Some(marker) = *number else { continue };
            let position = match frames.targets(frame)[i] {
                _ if !lacks(i) && frames.path(frame, i) == i => continue,
                _ if !lacks(i) => problem.paths[frames.path(frame, i)].positions[frame],
                offset if is_posed && offset.iter().all(|x| x.is_finite()) => problem.place(i, &offset),
                _ => Vec3::repeat(f64::NAN),
            };
            all.push((marker, frame, position));
        }
    }
    all
}

/// Reports markers that are missing.
pub(super) fn missing(problem: &FitProblem<'_>, frames: &Frames, findings: &mut Findings) {
    for i in 0..frames.markers() {
        let missing = spans(frames.count(), |f| !frames.is_seen(f, i));
        if !missing.is_empty() {
            let message = format!("marker `{}` is missing at {}", problem.paths[i].name, times(problem, &missing));
            findings.report(Code::MarkersMissing, message);
        }
    }
}

/// Reports markers that are excluded or swapped.
pub(super) fn excluded(problem: &FitProblem<'_>, frames: &Frames, findings: &mut Findings) {
    let name = |i: usize| problem.paths[i].name.as_str();
    for i in 0..frames.markers() {
        let wild = spans(frames.count(), |f| {
            let path = frames.path(f, i);
            frames.is_seen(f, path) && !frames.is_used(f, i)
        });
        if !wild.is_empty() {
            let message = format!(
                "marker `{}` jumped away from its place on the body at {}; it is excluded there",
                name(i),
                times(problem, &wild)
            );
            findings.report(Code::MarkersJump, message);
        }
        for j in i + 1..frames.markers() {
            let swapped = spans(frames.count(), |f| frames.path(f, i) == j);
            if !swapped.is_empty() {
                let message = format!(
                    "the markers `{}` and `{}` have swapped labels at {}; they were swapped back",
                    name(i),
                    name(j),
                    times(problem, &swapped)
                );
                findings.report(Code::MarkersSwap, message);
            }
        }
    }
}

/// Reports frames whose fit took too many steps.
pub(super) fn unfitted(problem: &FitProblem<'_>, frames: &Frames, findings: &mut Findings) {
    let unfinished = spans(frames.count(), |frame| frames.is_unfinished(frame));
    if !unfinished.is_empty() {
        let message = format!(
            "the fit was stopped at {}, because it took too many steps; the coordinates are approximate there, or have \
             no values. hint: correct markers that jump or have the labels of others",
            times(problem, &unfinished)
        );
        findings.report(Code::MarkersUnfitted, message);
    }
}

/// Why all frames are fitted together.
pub(super) fn together(problem: &FitProblem<'_>, frames: &Frames) -> String {
    let unfinished = spans(frames.count(), |frame| frames.is_unfinished(frame));
    format!(
        "frame by frame the fit took too many steps at {}; all frames were fitted together, with a prior on the change \
         of acceleration",
        times(problem, &unfinished)
    )
}

/// Reports the attempts that followed the first one.
pub(super) fn tried(attempts: &[String], findings: &mut Findings) {
    for attempt in attempts {
        let hint = "look at the distances of the markers, and correct markers that jump or have the labels of others";
        findings.report(Code::MarkersRefitted, format!("{attempt}. hint: {hint}"));
    }
}

/// Reports misplaced markers.
pub(super) fn misplaced(problem: &FitProblem<'_>, markers: &[Misplaced], findings: &mut Findings) {
    for Misplaced { marker, rms_m, usual_m } in markers {
        let name = &problem.paths[*marker].name;
        let message = format!(
            "marker `{name}` is {:.0} mm (RMS) from its place on the body in the whole recording, its neighbours {:.0} \
             mm; its weight was divided by {:.0}. hint: check whether it was elsewhere in the standing trial, or has \
             the label of another marker",
            1e3 * rms_m,
            1e3 * usual_m,
            (rms_m / usual_m).powi(2)
        );
        findings.report(Code::MarkersMisplaced, message);
    }
}

/// Reports coordinates that the markers do not determine.
pub(super) fn coordinates(
    model: &Model,
    problem: &FitProblem<'_>,
    frames: &Frames,
    states: &[Determination],
    longest_s: f64,
    findings: &mut Findings,
) {
    let unknowns = problem.tree.unknowns();
    for u in 0..unknowns {
        let name = &model.coordinates()[problem.tree.coordinate(u)].name;
        let bridged = spans(frames.count(), |f| states[f * unknowns + u] == Determination::Bridged);
        if !bridged.is_empty() {
            let message = format!(
                "too few markers to determine `{name}` at {}; bridged by a smooth curve",
                times(problem, &bridged)
            );
            findings.report(Code::MarkersBridged, message);
        }
        let gaps = spans(frames.count(), |f| states[f * unknowns + u] == Determination::Gap && !frames.is_unfitted(f));
        if !gaps.is_empty() {
            let message = format!(
                "too few markers to determine `{name}` at {}; it has no value there (only gaps of up to {longest_s} s \
                 inside the recording are bridged)",
                times(problem, &gaps)
            );
            findings.report(Code::MarkersGap, message);
        }
    }
}

/// Spans of frames, as first and last frame.
fn spans(count: usize, holds: impl Fn(usize) -> bool) -> Vec<[usize; 2]> {
    let mut list: Vec<[usize; 2]> = Vec::new();
    for frame in (0..count).filter(|&frame| holds(frame)) {
        match list.last_mut() {
            Some([_, last]) if *last + 1 == frame => *last = frame,
            _ => list.push([frame, frame]),
        }
    }
    list
}

fn times(problem: &FitProblem<'_>, spans: &[[usize; 2]]) -> String {
    let frames: usize = spans.iter().map(|[a, b]| b + 1 - a).sum();
    let one = |[a, b]: &[usize; 2]| format!("{:.3}-{:.3} s", problem.times[*a], problem.times[*b]);
    let shown: Vec<String> = spans.iter().take(MOST_SPANS).map(one).collect();
    let rest = spans.len().saturating_sub(MOST_SPANS);
    let more = if rest > 0 { format!(" and {rest} more stretches") } else { String::new() };
    format!("{}{more} ({})", listed(shown.iter().map(String::as_str)), counted(frames, "frame"))
}
