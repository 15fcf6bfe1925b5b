//! A walk as a moving stick figure: one steady cycle, relative to the middle of the hips.

use super::figures::{STICKS, SeriesKind, at_row, place};
use super::mode::Run;
use super::steady::Steady;

/// Instants of a cycle.
const FRAMES: usize = 40;

/// One cycle of a walk.
#[derive(Debug, Clone, PartialEq)]
pub struct MovingFigure {
    /// Name of the gait.
    pub gait: String,
    /// Duration of the cycle [s].
    pub cycle_s: f64,
    /// Lines between markers.
    pub sticks: Vec<MovingStick>,
    /// Distance that the figure has advanced at each instant [m]; the last instant is the first of the next cycle.
    pub advance: Vec<f64>,
}

/// A line between markers at each instant.
#[derive(Debug, Clone, PartialEq)]
pub struct MovingStick {
    /// How it is drawn.
    pub kind: SeriesKind,
    /// Points of each instant: forward of the hips and above the ground [m].
    pub points: Vec<Vec<[f64; 2]>>,
}

/// The first steady cycle of a run; `None` for a run that is too short.
#[must_use]
pub fn moving_figure(run: &Run) -> Option<MovingFigure> {
    let steady = Steady::of(run).ok()?;
    let recording = &run.recording;
    let cycle = run.cycle_s / recording.grid().step_s;
    let last = recording.grid().frames - 1;
    let row =
        |instant: usize| (steady.rows().start + (cycle * instant as f64 / FRAMES as f64).round() as usize).min(last);
    let mut sticks: Vec<MovingStick> =
        STICKS.iter().map(|(_, kind)| MovingStick { kind: *kind, points: Vec::new() }).collect();
    let mut advance = Vec::new();
    for instant in 0..=FRAMES {
        let motions = at_row(run, row(instant));
        let hips = motions.first()?.pose.translation.x;
        advance.push(hips);
        for (stick, (names, _)) in sticks.iter_mut().zip(STICKS) {
            let points = names.iter().filter_map(|name| place(&recording.model, &motions, name));
            stick.points.push(points.map(|[x, y]| [x - hips, y]).collect());
        }
    }
    let start = advance.first().copied()?;
    advance.iter_mut().for_each(|x| *x -= start);
    Some(MovingFigure { gait: run.gait.clone(), cycle_s: run.cycle_s, sticks, advance })
}
