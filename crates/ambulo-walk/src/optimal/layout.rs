//! The unknowns: coefficients of quintic B-splines of every coordinate over a span of time, and the continuation beyond
//! the span.
//!
//! Knots are uniform. Over knot interval i, coordinate c is q_c(s) = Σ_j w_j(u) x_{i+j, c}, j = 0..5, with the cardinal
//! splines w_j of [`crate::numerics::quintic_splines`] and u the position in the interval. Block k of the unknowns has
//! coefficient k of every coordinate. In a repeated motion, blocks beyond the last knot equal the first blocks, or
//! their mirror images.

use crate::model::{CoordinateId, Model, Movement, Side};
use crate::numerics::{OVERLAP, quintic_splines};

/// How a motion continues after its span of time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Span {
    /// The span is half a cycle; in the other half, left and right are exchanged.
    MirroredHalfCycle,
    /// The span is one cycle, which repeats.
    Cycle,
    /// The motion does not repeat.
    Single,
}

/// Numbering of the unknowns.
#[derive(Debug, Clone)]
pub(super) struct Layout {
    pub(super) span: Span,
    /// Number of coordinates, the size of a block.
    pub(super) width: usize,
    /// Number of knot intervals.
    pub(super) knots: usize,
    /// Instants per knot interval.
    pub(super) per_knot: usize,
    /// Coordinate on the other side (the same one in the middle of the body), and its sign, per coordinate.
    mirror: Vec<(usize, f64)>,
}

/// Weights of the blocks of unknowns in the coordinates at one instant.
#[derive(Debug, Clone, Copy)]
pub(super) struct Weights {
    /// The first of the blocks that have weights.
    pub(super) first: usize,
    /// Weight of each block in the value and in its first and second derivative by the share of the span.
    pub(super) values: [[f64; OVERLAP]; 3],
}

impl Weights {
    /// Weights times one factor for the value, the first and the second derivative each.
    pub(super) fn scaled(mut self, factors: [f64; 3]) -> Weights {
        for (values, factor) in self.values.iter_mut().zip(factors) {
            for value in values {
                *value *= factor;
            }
        }
        self
    }
}

impl Layout {
    pub(super) fn new(model: &Model, span: Span, knots: usize, per_knot: usize) -> Layout {
        Layout { span, width: model.coordinates().len(), knots: knots.max(OVERLAP), per_knot, mirror: mirror(model) }
    }

    /// Number of blocks, including those beyond the last knot.
    pub(super) fn extended_blocks(&self) -> usize {
        self.knots + OVERLAP - 1
    }

    /// Number of unknown blocks.
    pub(super) fn blocks(&self) -> usize {
        if self.span == Span::Single { self.extended_blocks() } else { self.knots }
    }

    /// Number of instants, including both ends.
    pub(super) fn instants(&self) -> usize {
        self.knots * self.per_knot + 1
    }

    /// Block, coordinate and sign of the unknown at (`block`, `coordinate`) of the extended blocks.
    pub(super) fn origin(&self, block: usize, coordinate: usize) -> (usize, usize, f64) {
        if block < self.blocks() {
            return (block, coordinate, 1.0);
        }
        let (same, sign) = match self.span {
            Span::MirroredHalfCycle => self.mirror[coordinate],
            _ => (coordinate, 1.0),
        };
        (block - self.knots, same, sign)
    }

    /// Coefficients of all extended blocks.
    pub(super) fn extended(&self, unknowns: &[f64]) -> Vec<f64> {
        let place = |block: usize, c: usize| {
            let (block, c, sign) = self.origin(block, c);
            sign * unknowns[block * self.width + c]
        };
        (0..self.extended_blocks()).flat_map(|block| (0..self.width).map(move |c| place(block, c))).collect()
    }

    /// Weights at a share of the span (0 to 1) in knot interval `interval`. A knot belongs to the intervals on both of
    /// its sides.
    pub(super) fn weights(&self, share: f64, interval: usize) -> Weights {
        let place = share * self.knots as f64 - interval as f64;
        Weights { first: interval, values: quintic_splines(place, self.knots as f64) }
    }

    /// Share of the span and knot interval of an instant.
    pub(super) fn instant(&self, index: usize) -> (f64, usize) {
        let share = index as f64 / (self.instants() - 1) as f64;
        (share, (index / self.per_knot).min(self.knots - 1))
    }

    /// The coordinate on the other side, and its sign in a mirrored motion.
    pub(super) fn mirrored(&self, coordinate: usize) -> (usize, f64) {
        self.mirror[coordinate]
    }
}

/// Per coordinate: the coordinate on the other side, and its sign. Coordinates of pelvis and trunk outside the sagittal
/// plane change sign.
pub fn mirror(model: &Model) -> Vec<(usize, f64)> {
    let anatomy = model.anatomy();
    let sign = |id: CoordinateId| anatomy.meaning(id).map_or(1.0, |meaning| meaning.sign);
    model
        .coordinate_ids()
        .map(|id| {
            let coordinate = &model.coordinates()[id.index()];
            if let Some((side, stem)) = Side::split_name(&coordinate.name) {
                let other = model.coordinate(&format!("{stem}_{}", side.other().letter())).unwrap_or(id);
                return (other.index(), sign(id) * sign(other));
            }
            let across = anatomy.meaning(id).is_some_and(|meaning| {
                matches!(
                    meaning.movement,
                    Movement::PelvicObliquity
                        | Movement::PelvicRotation
                        | Movement::PelvisRight
                        | Movement::TrunkObliquity
                        | Movement::TrunkRotation
                )
            });
            (id.index(), if across { -1.0 } else { 1.0 })
        })
        .collect()
}
