//! The projection of constraint forces on their laws, and its derivative.
//!
//!   λ = Π_K( (λ° - ρ (J a - c)) / (1 + ρ R) )          H = -∂λ/∂(J a)
//!
//! For a row, Π clamps. For the friction of a contact, it shortens z = λ° - ρ u to the radius r, and H is ρ (r / |z|)
//! across z. Symbols as in [`super::proximal`].

use crate::numerics::elementary::hypot;

use super::block::Block;
use super::constraint::{ActsOn, ConstraintGraph, ConstraintGroup, Law};
use super::elimination::EliminationWorkspace;
use super::elimination_order::Elimination;

/// H of a group: 3 x 3 for a contact; diagonal, for up to six rows, for other laws.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Curvature {
    Diagonal([f64; 6]),
    Contact {
        normal: f64,
        /// xx, xy, yy.
        tangential: [f64; 3],
        sticks: bool,
    },
}

impl Curvature {
    pub(super) fn slips(&self) -> bool {
        matches!(self, Curvature::Contact { normal, sticks: false, .. } if *normal > 0.0)
    }

    /// Whether the same rows are active and the same contacts stick.
    pub(super) fn holds_alike(&self, other: &Curvature) -> bool {
        match (self, other) {
            (Curvature::Diagonal(one), Curvature::Diagonal(two)) => {
                one.iter().zip(two).all(|(x, y)| (*x > 0.0) == (*y > 0.0))
            }
            (
                Curvature::Contact { normal, sticks, .. },
                Curvature::Contact { normal: other_normal, sticks: other_sticks, .. },
            ) => (*normal > 0.0) == (*other_normal > 0.0) && sticks == other_sticks,
            _ => false,
        }
    }
}

/// The map from rows u to forces.
#[derive(Debug, Clone, Copy)]
pub(super) struct Proximal<'a> {
    pub(super) graph: &'a ConstraintGraph,
    pub(super) rho: f64,
    /// λ°.
    pub(super) center: &'a [f64],
}

impl Proximal<'_> {
    /// λ and H of one group, for friction of this radius.
    #[inline]
    pub(super) fn project(
        &self,
        group: &ConstraintGroup,
        radius: f64,
        u: impl Fn(usize) -> f64,
        lambda: &mut [f64],
    ) -> Curvature {
        let start = group.rows.start;
        // One row confined to [least, most].
        let clamped = |row: usize, least: f64, most: f64| {
            let (z, h) = self.held(row, u(row));
            if z <= least {
                (least, 0.0)
            } else if z >= most {
                (most, 0.0)
            } else {
                (z, h)
            }
        };
        match group.law {
            Law::Bounded { least, most } => {
                let mut h = [0.0; 6];
                for row in group.rows.clone() {
                    (lambda[row], h[row - start]) = clamped(row, least, most);
                }
                Curvature::Diagonal(h)
            }
            Law::Contact { bound, .. } => {
                let (force, normal) = clamped(start, 0.0, bound);
                lambda[start] = force;
                let z = [1, 2].map(|k| self.center[start + k] - self.rho * u(start + k));
                let sticks = radius > 0.0 && hypot(z[0], z[1]) <= radius;
                let (forces, tangential) = friction(z, radius, self.rho, sticks);
                (lambda[start + 1], lambda[start + 2]) = (forces[0], forces[1]);
                Curvature::Contact { normal, tangential, sticks }
            }
        }
    }

    /// λ and H with the active set of `before`: active rows are equalities, the others keep their forces.
    pub(super) fn extend(
        &self,
        group: &ConstraintGroup,
        radius: f64,
        u: &[f64],
        before: Curvature,
        lambda: &mut [f64],
    ) -> Curvature {
        let start = group.rows.start;
        match before {
            Curvature::Diagonal(mut h) => {
                for row in group.rows.clone() {
                    if h[row - start] > 0.0 {
                        (lambda[row], h[row - start]) = self.held(row, u[row]);
                    }
                }
                Curvature::Diagonal(h)
            }
            Curvature::Contact { normal: held, sticks, .. } => {
                let mut normal = 0.0;
                if held > 0.0 {
                    (lambda[start], normal) = self.held(start, u[start]);
                }
                let z = [1, 2].map(|k| self.center[start + k] - self.rho * u[start + k]);
                let (forces, tangential) = friction(z, radius, self.rho, sticks);
                (lambda[start + 1], lambda[start + 2]) = (forces[0], forces[1]);
                Curvature::Contact { normal, tangential, sticks }
            }
        }
    }

    /// Forces of the rows that are active in `before`, without bounds; the others keep theirs.
    pub(super) fn hold(&self, group: &ConstraintGroup, u: &[f64], before: &Curvature, lambda: &mut [f64]) {
        let start = group.rows.start;
        for row in group.rows.clone() {
            let holds = match before {
                Curvature::Diagonal(h) => h[row - start] > 0.0,
                Curvature::Contact { normal, .. } if row == start => *normal > 0.0,
                Curvature::Contact { sticks, .. } => *sticks,
            };
            if holds {
                lambda[row] = self.held(row, u[row]).0;
            }
        }
    }

    /// Force and stiffness of a row inside its bounds.
    fn held(&self, row: usize, u: f64) -> (f64, f64) {
        let soft = 1.0 + self.rho * self.graph.rows[row].compliance;
        ((self.center[row] - self.rho * u) / soft, self.rho / soft)
    }
}

/// Diagonal H of a group.
pub(super) fn diagonal(group: &ConstraintGroup, h: impl Fn(usize) -> f64) -> Curvature {
    let mut values = [0.0; 6];
    for (value, row) in values.iter_mut().zip(group.rows.clone()) {
        *value = h(row);
    }
    Curvature::Diagonal(values)
}

/// Friction for z = λ° - ρ u, and its curvature; z itself if the contact sticks.
fn friction(z: [f64; 2], radius: f64, rho: f64, sticks: bool) -> ([f64; 2], [f64; 3]) {
    if sticks {
        return (z, [rho, 0.0, rho]);
    }
    let length = hypot(z[0], z[1]);
    if length <= 0.0 {
        return ([0.0; 2], [0.0; 3]);
    }
    let (x, y) = (z[0] / length, z[1] / length);
    let across = rho * (radius / length).min(1.0);
    ([radius * x, radius * y], [across * y * y, -across * x * y, across * x * x])
}

/// Adds Jᵀ H J of one group.
pub(super) fn add_group(
    graph: &ConstraintGraph,
    elimination: &Elimination,
    group: &ConstraintGroup,
    curvature: &Curvature,
    block: Option<(usize, bool)>,
    factors: &mut EliminationWorkspace,
) {
    let start = group.rows.start;
    let (first, second) = match group.on {
        ActsOn::Coordinate { body, coordinate } => {
            if let Curvature::Diagonal(h) = curvature {
                factors.add_to_coordinate(elimination, coordinate, body, h[0]);
            }
            return;
        }
        ActsOn::Bodies { first, second } => (first, second),
    };
    let mut add = |m: usize, n: usize, h: f64| {
        if h == 0.0 {
            return;
        }
        let (one, other) = (&graph.rows[start + m], &graph.rows[start + n]);
        factors.diagonal_mut(first).add_outer(&one.on_first, &other.on_first, h);
        if let (Some(second), Some((block, swapped))) = (second, block) {
            factors.diagonal_mut(second).add_outer(&one.on_second, &other.on_second, h);
            let place: &mut Block = factors.off_mut(block);
            if swapped {
                place.add_outer(&one.on_second, &other.on_first, h);
            } else {
                place.add_outer(&one.on_first, &other.on_second, h);
            }
        }
    };
    match curvature {
        Curvature::Diagonal(h) => (0..group.rows.len()).for_each(|k| add(k, k, h[k])),
        Curvature::Contact { normal, tangential: [xx, xy, yy], .. } => {
            add(0, 0, *normal);
            add(1, 1, *xx);
            add(1, 2, *xy);
            add(2, 1, *xy);
            add(2, 2, *yy);
        }
    }
}
