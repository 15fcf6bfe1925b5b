//! Markers to coordinates: the posture of the model that brings its markers closest to the recorded ones, frame by frame or
//! all frames together.
//!
//! q(t) = argmin Σ w |m(t) - p(q)|²    inside the ranges of the coordinates
//!
//! | code | symbol | unit |
//! |---|---|---|
//! | `positions` | m, recorded marker | m |
//! | `points` | p, the model's marker | m |
//! | `weights` | w | 1 |
//! | `x` | q, free coordinates that move a marker | rad, m |
//!
//! The model's markers never stand exactly where those of the person do, so that a marker pulls the posture even while it
//! fits best; when it vanishes, the pull does too and the posture leaps. Frames that lack markers are therefore fitted with each
//! marker at its offset, interpolated from the complete frames around (`gaps`). Coordinates that no seen marker determines
//! are bridged up to a stated length and are not a number beyond it.
//!
//! Source: T.-W. Lu, J.J. O'Connor 1999, J. Biomech. 32:129-134 (global optimisation) (unverified).
//! Cost: some 10 µs a step, three or four steps a frame; `cargo xtask bench-markers`.
//! Not handled: markers fixed to ground; weights that change in time.
//! Pinned by: tests/marker_fit.rs, tests/marker_gaps.rs, tests/marker_misplaced.rs, tests/marker_outliers.rs, tests/marker_smoothing.rs

mod bridge;
mod cholesky;
mod followed;
mod frames;
mod gaps;
mod misplaced;
mod normal;
mod problem;
mod report;
mod result;
pub(crate) mod rows;
mod sequence;
mod settings;
mod sliding;
mod smoothing;
mod solve;
mod start;
mod strays;
mod tree;

pub use result::{FitError, MarkerError, MarkerFit};
pub use settings::{FitSettings, Guard, Limits, Smoothing};

use crate::findings::Findings;
use crate::model::Model;
use crate::motion::MarkerRecording;
use frames::{FEWEST, Frames};
use problem::Problem;

/// Fits a model to recorded markers, both in world axes. Markers that only one of them has are noted.
///
/// # Errors
/// No common marker, nothing that the markers could determine, settings out of range: see [`FitError`].
pub fn fit_markers(
    model: &Model,
    markers: &MarkerRecording,
    settings: &FitSettings,
    findings: &mut Findings,
) -> Result<MarkerFit, FitError> {
    let mut problem = Problem::new(model, markers, settings, findings)?;
    if settings.smoothing.is_some() {
        smoothing::check(problem.frames(), problem.tree.unknowns())?;
    }
    let mut frames = Frames::new(&problem);
    let most = (0..frames.count()).map(|frame| frames.used_in(frame)).max().unwrap_or(0);
    if most < FEWEST {
        let common = problem.points.len();
        return Err(FitError::TooFewMarkers { recording: markers.name.clone(), most, common });
    }
    let default: Vec<f64> =
        (0..problem.tree.unknowns()).map(|u| model.coordinates()[problem.tree.coordinate(u)].default_value).collect();
    sequence::run(&mut problem, &mut frames, settings.guard, &default);
    let mut elsewhere = Vec::new();
    if settings.guard == Guard::On {
        misplaced::exchange_back(&mut problem, &mut frames);
        elsewhere = misplaced::weigh_less(&mut problem, &mut frames);
    }
    let states = gaps::refit(&mut problem, &mut frames, settings.longest_gap_s);
    if let Some(smoothing) = settings.smoothing {
        smoothing::smooth(model, &mut problem, &mut frames, &states, smoothing);
    }
    report::markers(&problem, &frames, findings);
    report::misplaced(&problem, &elsewhere, findings);
    report::coordinates(model, &problem, &frames, &states, settings.longest_gap_s, findings);
    Ok(report::fit(model, markers, &mut problem, &frames, &states))
}
