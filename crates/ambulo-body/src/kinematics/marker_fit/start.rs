//! Initial posture for the first frame and for frames after long gaps.
//!
//! The model in its default posture is fitted to the markers as one rigid body, starting from the best of all rotations
//! of the root by multiples of 90 degrees. The best results are fitted in full and, if the distances stay large, again
//! joint by joint from the root outwards. The posture with the lowest cost is used.
//!
//! Pinned by: tests/marker_fit.rs (recordings turned about the vertical, random postures)

use super::problem::FitProblem;
use crate::numerics::Order;
use crate::spatial::Vec3;
use std::f64::consts::{FRAC_PI_2, PI};

/// Number of rotations from which the rigid body is fitted, of 64: three sets of angles have the same rotation on
/// average.
const ROTATIONS: usize = 12;
/// Number of rigid placements that are fitted in full.
const CANDIDATES: usize = 3;
/// Maximum number of root angles that are varied: an orientation has three.
const MOST_ANGLES: usize = 3;
/// A fit with an RMS distance above this [m] may have a wrong posture.
const FAR: f64 = 0.04;
/// Placements whose costs differ by less than this share are the same.
const SAME: f64 = 1e-6;
/// Costs that differ by less are the same: markers that are 1 µm off [m²].
const NEGLIGIBLE: f64 = 1e-12;
const TURNS: [f64; 4] = [0.0, FRAC_PI_2, PI, -FRAC_PI_2];

/// The posture that brings the model closest to the loaded markers.
pub(super) fn posture(problem: &mut FitProblem<'_>, default: &[f64]) -> Vec<f64> {
    let total: f64 = problem.frame_weights.iter().sum();
    let is_far = |cost: f64| cost > FAR * FAR * total;
    let mut best = (f64::INFINITY, default.to_vec());
    for start in placements(problem, default) {
        for by_joint in [false, true] {
            if by_joint && !is_far(best.0) {
                continue;
            }
            let mut x = start.clone();
            if by_joint {
                outwards(problem, &mut x);
            }
            let cost = problem.fit(&mut x).cost;
            if cost < best.0 {
                best = (cost, x);
            }
        }
        if !is_far(best.0) {
            break;
        }
    }
    wrap(problem, default, &mut best.1);
    best.1
}

/// Postures with the model placed as one rigid body, best first.
fn placements(problem: &mut FitProblem<'_>, default: &[f64]) -> Vec<Vec<f64>> {
    problem.pose_at(default);
    let root: Vec<_> = (0..problem.tree.node_count())
        .filter(|&node| problem.tree.parent(node).is_none())
        .flat_map(|node| problem.tree.columns(node).to_vec())
        .collect();
    if root.is_empty() {
        return vec![default.to_vec()];
    }
    let mut angles: Vec<usize> = root.iter().filter(|c| c.angular.norm() > 0.5).map(|c| c.unknown).collect();
    angles.truncate(MOST_ANGLES);
    let held = problem.bounds.held.clone();
    problem.bounds.held.fill(true);
    root.iter().for_each(|column| problem.bounds.held[column.unknown] = false);
    let turned = |k: usize| {
        let mut x = default.to_vec();
        for (place, &unknown) in angles.iter().enumerate() {
            x[unknown] += TURNS[k / TURNS.len().pow(place as u32) % TURNS.len()];
        }
        x
    };
    let starts = (0..TURNS.len().pow(angles.len() as u32)).map(turned);
    let mut found: Vec<(f64, Vec<f64>)> = starts.map(|x| (cost_where_it_fits(problem, &x), x)).collect();
    found.sort_by_number(|found| found.0);
    found.truncate(ROTATIONS);
    for (cost, x) in &mut found {
        *cost = problem.fit(x).cost;
    }
    problem.bounds.held = held;
    found.sort_by_number(|found| found.0);
    // Starts that lead to the same placement are one candidate. Three angles have two sets of values for an
    // orientation; the one nearer to the default posture is used.
    let far = |x: &[f64]| x.iter().zip(default).map(|(x, d)| (x - d) * (x - d)).sum::<f64>();
    found.dedup_by(|later, earlier| {
        let same = (later.0 - earlier.0).abs() <= SAME * earlier.0.abs() + NEGLIGIBLE;
        if same && far(&later.1) < far(&earlier.1) {
            std::mem::swap(later, earlier);
        }
        same
    });
    found.into_iter().take(CANDIDATES).map(|(_, x)| x).collect()
}

/// Cost of a rotation of the whole body at its best place: Σ w |d|² - |Σ w d|² / Σ w, with d from the marker of the
/// body to the recorded one [m²].
fn cost_where_it_fits(problem: &mut FitProblem<'_>, x: &[f64]) -> f64 {
    problem.pose_at(x);
    let (mut weights, mut sum, mut squares) = (0.0, Vec3::zeros(), 0.0);
    for (i, &weight) in problem.frame_weights.iter().enumerate().filter(|(_, weight)| **weight > 0.0) {
        let off = problem.positions[i] - problem.place(i, &Vec3::zeros());
        (weights, sum, squares) = (weights + weight, sum + off * weight, squares + weight * off.norm_squared());
    }
    squares - sum.norm_squared() / weights
}

/// Fits joint by joint from the root outwards, each to the markers of its own body.
fn outwards(problem: &mut FitProblem<'_>, x: &mut [f64]) {
    let held = problem.bounds.held.clone();
    let weights = problem.frame_weights.clone();
    for node in 0..problem.tree.node_count() {
        problem.bounds.held.fill(true);
        for column in problem.tree.columns(node) {
            problem.bounds.held[column.unknown] = held[column.unknown];
        }
        for (i, point) in problem.points.iter().enumerate() {
            problem.frame_weights[i] = if point.node == node { weights[i] } else { 0.0 };
        }
        if problem.bounds.held.iter().all(|held| *held) || problem.frame_weights.iter().all(|w| *w <= 0.0) {
            continue;
        }
        let mut best = (f64::INFINITY, x.to_vec());
        let own: Vec<usize> = problem.tree.columns(node).iter().map(|c| c.unknown).collect();
        let mut starts = vec![x.to_vec()];
        for (&unknown, step) in own.iter().flat_map(|u| [(u, 1.0), (u, -1.0)]) {
            let mut start = x.to_vec();
            start[unknown] += step;
            starts.push(start);
        }
        for mut start in starts {
            let cost = problem.fit(&mut start).cost;
            if cost < best.0 {
                best = (cost, start);
            }
        }
        x.copy_from_slice(&best.1);
    }
    problem.bounds.held = held;
    problem.frame_weights = weights;
}

/// Removes full turns from angles if the posture stays the same.
fn wrap(problem: &mut FitProblem<'_>, default: &[f64], x: &mut [f64]) {
    let cost = problem.pose_at(x);
    for i in 0..x.len() {
        let turns = ((x[i] - default[i]) / (2.0 * PI)).round();
        let before = x[i];
        x[i] -= turns * 2.0 * PI;
        let inside = x[i] >= problem.bounds.low[i] && x[i] <= problem.bounds.high[i];
        if !inside || (problem.pose_at(x) - cost).abs() > 1e-9 * (1.0 + cost) {
            x[i] = before;
        }
    }
    problem.pose_at(x);
}
