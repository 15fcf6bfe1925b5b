//! Where a convex function is least along a step.
//!
//! φ(s) of a motion a + s Δ: φ'(s) = Δᵀ(A a - b) + s Δᵀ A Δ - (J Δ)ᵀ λ(s), which rises with s since λ falls with J a.

use super::constraint::{ConstraintGraph, Six};

/// Halvings; the slope of a convex function changes sign within them.
const HALVINGS: usize = 30;
/// A slope below this share of the first is nought.
const LEVEL: f64 = 0.1;

/// Δᵀ(A a - b) and Δᵀ A Δ, for (motions, coordinates) of a and Δ.
pub(super) fn inertial_slope(
    graph: &ConstraintGraph,
    (motions, coordinates): (&[Six], &[f64]),
    (step, step_coordinates): (&[Six], &[f64]),
) -> [f64; 2] {
    let [mut constant, mut linear] = [0.0; 2];
    for (i, d) in step.iter().enumerate() {
        let body = &graph.bodies[i];
        constant += d.dot(&(body.times(&motions[i]) - graph.wrenches[i]));
        linear += d.dot(&body.times(d));
    }
    for (k, d) in step_coordinates.iter().enumerate() {
        constant += d * (graph.rotors[k] * coordinates[k] - graph.efforts[k]);
        linear += d * d * graph.rotors[k];
    }
    [constant, linear]
}

/// The share of the step at which φ is about least: all of it, unless the slope there is above `steep` times the first.
pub(super) fn lowest(start: f64, steep: f64, mut slope: impl FnMut(f64) -> f64) -> f64 {
    if slope(1.0) <= steep * start.abs() {
        return 1.0;
    }
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        let here = slope(middle);
        if here.abs() <= LEVEL * start.abs() {
            return middle;
        }
        if here > 0.0 { high = middle } else { low = middle }
    }
    0.5 * (low + high)
}
