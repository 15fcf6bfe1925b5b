//! Forces of a group within the limits of its law.

use crate::numerics::elementary::hypot;

use super::constraint::{ConstraintGraph, ConstraintGroup, Law};

/// R of a row; friction has none.
pub(super) fn compliance(graph: &ConstraintGraph, group: &ConstraintGroup, row: usize) -> f64 {
    match group.law {
        Law::Contact { .. } if row > group.rows.start => 0.0,
        _ => graph.rows[row].compliance,
    }
}

/// Confines the forces of one group to its law, the normal force first.
pub(super) fn confine(group: &ConstraintGroup, lambda: &mut [f64]) {
    let start = group.rows.start;
    match group.law {
        Law::Bounded { least, most } => {
            lambda[group.rows.clone()].iter_mut().for_each(|l| *l = l.clamp(least, most));
        }
        Law::Contact { friction, bound } => {
            lambda[start] = lambda[start].clamp(0.0, bound);
            let radius = friction * lambda[start];
            let length = hypot(lambda[start + 1], lambda[start + 2]);
            if length > radius {
                lambda[start + 1] *= radius / length;
                lambda[start + 2] *= radius / length;
            }
        }
    }
}

/// Sets the friction of a slipping contact to its limit, along r d + s e.
pub(super) fn fill_friction(
    group: &ConstraintGroup,
    before: &[f64],
    along: [f64; 2],
    turn: [f64; 2],
    lambda: &mut [f64],
) {
    let Law::Contact { friction, .. } = group.law else { return };
    let start = group.rows.start;
    let radius = friction * before[start];
    let toward = [radius * along[0] + turn[0], radius * along[1] + turn[1]];
    let length = hypot(toward[0], toward[1]);
    let longer = if length > 0.0 { friction * lambda[start] / length } else { 0.0 };
    lambda[start + 1] = longer * toward[0];
    lambda[start + 2] = longer * toward[1];
}
