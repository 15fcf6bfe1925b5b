//! A walk as a moving stick figure: one steady cycle, relative to the middle of the hips.

use ambulo_body::numerics::elementary::hypot;

use super::figures::{STICKS, SeriesKind, at_row, place};
use super::mode::Run;
use super::steady::Steady;

/// Instants of a cycle.
const FRAMES: usize = 40;

/// The sticks of figure 3, with a trunk that ends at the neck: the head is a circle.
const TRUNK_AND_LIMBS: [(&[&str], SeriesKind); STICKS.len()] = {
    let mut sticks = STICKS;
    sticks[0] = (&["sacrum", "neck"], SeriesKind::Line);
    sticks
};

/// One cycle of a walk.
#[derive(Debug, Clone, PartialEq)]
pub struct MovingFigure {
    /// Name of the gait.
    pub gait: String,
    /// Duration of the cycle [s].
    pub cycle_s: f64,
    /// Lines between markers.
    pub sticks: Vec<MovingStick>,
    /// The head; `None` for a model without its markers.
    pub head: Option<MovingHead>,
    /// Distance that the figure has advanced at each instant [m]; the last instant is the first of the next cycle.
    pub advance: Vec<f64>,
    /// Forward speed of the hips at each instant [m/s].
    pub speed: Vec<f64>,
}

/// The head at each instant: a circle from the neck to the vertex.
#[derive(Debug, Clone, PartialEq)]
pub struct MovingHead {
    /// Radius [m].
    pub radius: f64,
    /// Centres: forward of the hips and above the ground [m].
    pub centres: Vec<[f64; 2]>,
}

/// A line between markers at each instant.
#[derive(Debug, Clone, PartialEq)]
pub struct MovingStick {
    /// How the series is drawn.
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
        TRUNK_AND_LIMBS.iter().map(|(_, kind)| MovingStick { kind: *kind, points: Vec::new() }).collect();
    let (mut advance, mut heads) = (Vec::new(), Vec::new());
    let speed = (0..=FRAMES).map(|instant| recording.speed()[row(instant)]).collect();
    for instant in 0..=FRAMES {
        let motions = at_row(run, row(instant));
        let hips = motions.first()?.pose.translation.x;
        advance.push(hips);
        let [neck, vertex] = ["neck", "vertex"].map(|name| place(&recording.model, &motions, name));
        heads.extend(neck.zip(vertex).map(|ends| head(ends, hips)));
        for (stick, (names, _)) in sticks.iter_mut().zip(TRUNK_AND_LIMBS) {
            let points = names.iter().filter_map(|name| place(&recording.model, &motions, name));
            stick.points.push(points.map(|[x, y]| [x - hips, y]).collect());
        }
    }
    let start = advance.first().copied()?;
    advance.iter_mut().for_each(|x| *x -= start);
    // The head is rigid: its radius is the same at each instant.
    let head = heads
        .first()
        .map(|(_, radius)| MovingHead { radius: *radius, centres: heads.iter().map(|(centre, _)| *centre).collect() });
    Some(MovingFigure { gait: run.gait.clone(), cycle_s: run.cycle_s, sticks, head, advance, speed })
}

/// Centre and radius of a head between neck and vertex, relative to the hips [m].
fn head(([x, y], [top_x, top_y]): ([f64; 2], [f64; 2]), hips: f64) -> ([f64; 2], f64) {
    ([0.5 * (x + top_x) - hips, 0.5 * (y + top_y)], 0.5 * hypot(top_x - x, top_y - y))
}
