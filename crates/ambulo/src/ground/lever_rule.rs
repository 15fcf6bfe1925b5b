//! Whether horizontal forces of the ground lead to the mass centre, as they do in every step.
//!
//! The force leads nearly from the centre of pressure p to the mass centre c, because its moment about the mass centre
//! only changes the angular momentum of the body, which is small (Herr, Popovic 2008, J Exp Biol 211:467, unverified):
//!
//! ```text
//! e = F_v (c - p)_h / (c - p)_v          r = Σ F·e / √(Σ F² Σ e²)
//! ```
//!
//! Means are not removed, because the mean is what shows a lateral force: it leads inwards, towards the other foot.
//!
//! | code | symbol | unit |
//! |---|---|---|
//! | `expected` | e | N |
//! | `agreement` | r | 1 |
//!
//! Pinned by: tests/quality.rs, tests/plate_orders.rs

use crate::spatial::Vec3;

/// Sums over loaded samples, by two horizontal axes.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct LeverRule {
    /// Of expected (row) times measured components [N²].
    pub(crate) products: [[f64; 2]; 2],
    /// Of squares of expected and of measured components [N²].
    pub(crate) expected: [f64; 2],
    pub(crate) measured: [f64; 2],
}

impl LeverRule {
    /// Adds a force [N] with the arm from its centre of pressure to the mass centre [m]; `false` without either.
    pub(crate) fn add(&mut self, force: Vec3, arm: Vec3, up: Vec3, axes: [Vec3; 2]) -> bool {
        let expected = arm * (force.dot(&up) / arm.dot(&up));
        if !expected.iter().chain(force.iter()).all(|x| x.is_finite()) {
            return false;
        }
        let [e, f] = [expected, force].map(|v| axes.map(|axis| v.dot(&axis)));
        for a in 0..2 {
            (0..2).for_each(|b| self.products[a][b] += e[a] * f[b]);
            self.expected[a] += e[a] * e[a];
            self.measured[a] += f[a] * f[a];
        }
        true
    }

    /// The sums of both.
    pub(crate) fn with(mut self, other: &LeverRule) -> LeverRule {
        for a in 0..2 {
            (0..2).for_each(|b| self.products[a][b] += other.products[a][b]);
            self.expected[a] += other.expected[a];
            self.measured[a] += other.measured[a];
        }
        self
    }

    /// The agreement along an axis, -1 to 1; not a number without forces.
    pub(crate) fn agreement(&self, axis: usize) -> f64 {
        self.products[axis][axis] / (self.expected[axis] * self.measured[axis]).sqrt()
    }
}
