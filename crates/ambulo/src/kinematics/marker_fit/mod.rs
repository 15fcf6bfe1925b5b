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
//! marker at its offset, interpolated from the complete frames around ([`gaps`]). Coordinates that no seen marker determines
//! are bridged up to a stated length and are not a number beyond it.
//!
//! Source: T.-W. Lu, J.J. O'Connor 1999, J. Biomech. 32:129-134 (global optimisation) (unverified).
//! Cost: some 10 µs a step, three or four steps a frame; `cargo xtask bench-markers`.
//! Not handled: markers fixed to ground; weights that change in time.
//! Pinned by: tests/marker_fit.rs, tests/marker_gaps.rs, tests/marker_outliers.rs

mod cholesky;
mod frames;
mod normal;
mod problem;
mod result;
mod sequence;
mod settings;
mod solve;
mod start;
mod tree;

pub use result::{FitError, MarkerError, MarkerFit};
pub use settings::{FitSettings, Guard, Limits, Smoothing};

use crate::findings::Findings;
use crate::model::{Drive, Model};
use crate::motion::{MarkerRecording, Motion};
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
    let mut frames = Frames::new(&problem);
    let most = (0..frames.count()).map(|frame| frames.used_in(frame)).max().unwrap_or(0);
    if most < FEWEST {
        let common = problem.points.len();
        return Err(FitError::TooFewMarkers { recording: markers.name.clone(), most, common });
    }
    let default: Vec<f64> =
        (0..problem.tree.unknowns()).map(|u| model.coordinates()[problem.tree.coordinate(u)].default_value).collect();
    sequence::run(&mut problem, &mut frames, settings.guard, &default);
    Ok(collect(model, markers, &mut problem, &frames))
}

/// The postures as a recording of coordinates, and the markers' distances.
fn collect(model: &Model, markers: &MarkerRecording, problem: &mut Problem<'_>, frames: &Frames) -> MarkerFit {
    let count = frames.count();
    let mut columns: Vec<Option<Vec<f64>>> =
        column_wanted(model, problem).into_iter().map(|w| w.then(|| vec![f64::NAN; count])).collect();
    let mut rms_m = vec![f64::NAN; count];
    let names: Vec<String> = problem.paths.iter().map(|p| p.name.clone()).collect();
    let mut sums = vec![(0.0_f64, 0.0_f64, 0_usize); names.len()];
    for frame in 0..count {
        if frames.outcomes[frame].is_none() {
            continue;
        }
        frames.load(frame, problem);
        let x = frames.posture(frame);
        problem.pose_at(x);
        for (column, value) in columns.iter_mut().zip(problem.tree.values()) {
            if let Some(column) = column {
                column[frame] = *value;
            }
        }
        let (mut sum, mut used) = (0.0, 0);
        for (i, (square, most, seen)) in sums.iter_mut().enumerate() {
            if problem.frame_weights[i] > 0.0 {
                let distance = problem.distance(i);
                *square += distance * distance;
                *most = most.max(distance);
                *seen += 1;
                sum += distance * distance;
                used += 1;
            }
        }
        rms_m[frame] = (sum / used as f64).sqrt();
    }
    let errors = names
        .into_iter()
        .zip(sums)
        .enumerate()
        .map(|(i, (name, (square, most, used)))| MarkerError {
            name,
            rms_m: (square / used as f64).sqrt(),
            max_m: if used > 0 { most } else { f64::NAN },
            seen: (0..count).filter(|&frame| frames.is_seen(frame, i)).count(),
            down_weighted: (0..count).filter(|&f| frames.is_seen(f, i) && !frames.is_used(f, i)).count(),
        })
        .collect();
    MarkerFit {
        motion: Motion { origin: format!("markers of {}", markers.name), times: markers.times.clone(), columns },
        errors,
        rms_m,
        iterations: frames.outcomes.iter().map(|o| o.map_or(0, |o| o.steps)).collect(),
        converged: frames.outcomes.iter().map(|o| o.is_none_or(|o| o.converged)).collect(),
    }
}

/// Coordinates that markers move, and those that something else decides.
fn column_wanted(model: &Model, problem: &Problem<'_>) -> Vec<bool> {
    let mut wanted: Vec<bool> =
        model.coordinates().iter().map(|c| !matches!(c.drive, Drive::Free | Drive::Coupled(..))).collect();
    for unknown in 0..problem.tree.unknowns() {
        wanted[problem.tree.coordinate(unknown)] = true;
    }
    for (i, coordinate) in model.coordinates().iter().enumerate() {
        if let Drive::Coupled(leader, _) = &coordinate.drive {
            wanted[i] = wanted[leader.index()];
        }
    }
    wanted
}
