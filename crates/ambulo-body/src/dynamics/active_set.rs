//! The active set of the proximal method: which rows push, stick or slip, first by a guess and then by the forces.

use crate::numerics::elementary::hypot;

use super::constraint::{ConstraintGraph, ConstraintGroup, Law};
use super::curvature::{Curvature, diagonal};

/// If forces are not unique, sticking contacts are kept within this share of their cone.
pub(super) const WITHIN: f64 = 0.95;
/// Number of halvings in the search for this limit.
const SHARE_HALVINGS: usize = 20;

/// Whether a contact existed before: its force is larger than the marker value of a new one.
pub(super) fn has_past(group: &ConstraintGroup, before: &[f64]) -> bool {
    before[group.rows.start] > f64::MIN_POSITIVE
}

/// The largest share (at most 1) of the way from the guess to `lambda` on which no sticking contact leaves its cone.
pub(super) fn share_of_least_squares(
    graph: &ConstraintGraph,
    factored: &[Curvature],
    before: &[f64],
    lambda: &[f64],
) -> f64 {
    let mut share = 1.0_f64;
    for (group, curvature) in graph.groups.iter().zip(factored) {
        let (Law::Contact { friction, .. }, Curvature::Contact { normal, sticks: true, .. }) = (group.law, curvature)
        else {
            continue;
        };
        if *normal <= 0.0 || !has_past(group, before) {
            continue;
        }
        let start = group.rows.start;
        let inside = |s: f64| {
            let [n, x, y] = [0, 1, 2].map(|k| {
                let past = before[start + k];
                past + s * (lambda[start + k] - past)
            });
            hypot(x, y) <= WITHIN * friction * n
        };
        if inside(share) {
            continue;
        }
        // The cone is convex, so bisection works.
        let (mut low, mut high) = (0.0, share);
        for _ in 0..SHARE_HALVINGS {
            let middle = 0.5 * (low + high);
            if inside(middle) { low = middle } else { high = middle }
        }
        share = low;
    }
    share
}

/// Initial H from the guess: loaded contacts stick, or slip if their friction is at the limit.
pub(super) fn guess(
    graph: &ConstraintGraph,
    rho: f64,
    lambda: &[f64],
    curvature: &mut [Curvature],
    radius: &mut [f64],
) {
    for (number, group) in graph.groups.iter().enumerate() {
        let first = group.rows.start;
        let h = |row: usize| rho / (1.0 + rho * graph.rows[row].compliance);
        curvature[number] = match group.law {
            Law::EQUALITY => diagonal(group, h),
            Law::Bounded { least, most } => {
                diagonal(group, |row| if lambda[row] > least && lambda[row] < most { h(row) } else { 0.0 })
            }
            Law::Contact { friction, .. } => {
                let tangential = hypot(lambda[first + 1], lambda[first + 2]);
                let pushing = lambda[first] > 0.0;
                let slips = tangential >= friction * lambda[first] * (1.0 - 1e-9);
                let sticks = pushing && !slips;
                let normal = if pushing { h(first) } else { 0.0 };
                let held = if sticks { rho } else { 0.0 };
                radius[number] = if slips || !pushing { tangential } else { f64::INFINITY };
                Curvature::Contact { normal, tangential: [held, 0.0, held], sticks }
            }
        };
    }
}

/// λ := λ - H J Δ with the factored H.
pub(super) fn follow(graph: &ConstraintGraph, factored: &[Curvature], change: &[f64], lambda: &mut [f64]) {
    for (group, curvature) in graph.groups.iter().zip(factored) {
        let start = group.rows.start;
        let change = &change[group.rows.clone()];
        match curvature {
            Curvature::Diagonal(h) => {
                (0..change.len()).for_each(|k| lambda[start + k] -= h[k] * change[k]);
            }
            Curvature::Contact { normal, tangential: [xx, xy, yy], .. } => {
                lambda[start] -= normal * change[0];
                lambda[start + 1] -= xx * change[1] + xy * change[2];
                lambda[start + 2] -= xy * change[1] + yy * change[2];
            }
        }
    }
}

/// Whether the active set equals the active set of the factored system: the same rows active, the others at the same
/// bounds, and the same contacts sticking.
pub(super) fn alike(graph: &ConstraintGraph, [now, then]: [&[Curvature]; 2], trial: &[f64], lambda: &[f64]) -> bool {
    let same_bound = |group: &ConstraintGroup, curvature: &Curvature| match curvature {
        Curvature::Contact { .. } => true,
        Curvature::Diagonal(h) => {
            let start = group.rows.start;
            group.rows.clone().all(|row| h[row - start] > 0.0 || (lambda[row] - trial[row]).abs() <= 0.0)
        }
    };
    let groups = graph.groups.iter().zip(now.iter().zip(then));
    groups.into_iter().all(|(group, (now, then))| now.holds_alike(then) && same_bound(group, now))
}

pub(super) fn clamp_to(law: Law, lambda: f64) -> f64 {
    match law {
        Law::Bounded { least, most } => lambda.clamp(least, most),
        Law::Contact { .. } => lambda,
    }
}
