//! Six-vectors, 6 x 6 blocks, body inertias, and the small symmetric systems of one joint.
//!
//! Written out for fixed sizes: the 6 x 6 factorisation of a general library took four times as long (measured).

use crate::spatial::{Mat3, Vec3};

/// A motion or wrench of a body: angular part, then linear part.
pub type Six = nalgebra::Vector6<f64>;

/// A pivot below this share of its diagonal entry counts as zero: sums of six products round to a few 1e-16, while stiff rows
/// (see `proximal`) leave a share of 1e-10.
const VANISHED: f64 = 1e-13;

/// Mass and inertia of a rigid body at one instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BodyTerms {
    /// Mass [kg].
    pub mass: f64,
    /// Inertia about the mass centre in world axes [kg.m²].
    pub inertia: Mat3,
}

impl BodyTerms {
    /// M a.
    #[must_use]
    #[inline]
    pub fn times(&self, a: &Six) -> Six {
        let moment = self.inertia * Vec3::new(a[0], a[1], a[2]);
        Six::new(moment.x, moment.y, moment.z, self.mass * a[3], self.mass * a[4], self.mass * a[5])
    }
}

/// A 6 x 6 block, row by row.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Block(pub(crate) [[f64; 6]; 6]);

impl Block {
    pub(crate) const ZERO: Block = Block([[0.0; 6]; 6]);

    #[inline(always)]
    pub(crate) fn times(&self, x: &Six) -> Six {
        let mut y = Six::zeros();
        for (i, row) in self.0.iter().enumerate() {
            let mut sum = 0.0;
            for j in 0..6 {
                sum += row[j] * x[j];
            }
            y[i] = sum;
        }
        y
    }

    #[inline(always)]
    pub(crate) fn transpose_times(&self, x: &Six) -> Six {
        let mut y = Six::zeros();
        for (i, row) in self.0.iter().enumerate() {
            for j in 0..6 {
                y[j] += row[j] * x[i];
            }
        }
        y
    }

    #[inline(always)]
    pub(crate) fn add(&mut self, other: &Block) {
        for (row, more) in self.0.iter_mut().zip(&other.0) {
            for j in 0..6 {
                row[j] += more[j];
            }
        }
    }

    /// Adds the transpose of another block.
    pub(crate) fn add_transposed(&mut self, other: &Block) {
        for i in 0..6 {
            for j in 0..6 {
                self.0[i][j] += other.0[j][i];
            }
        }
    }

    /// Adds `factor` x yᵀ.
    #[inline(always)]
    pub(crate) fn add_outer(&mut self, x: &Six, y: &Six, factor: f64) {
        for (i, row) in self.0.iter_mut().enumerate() {
            let scaled = factor * x[i];
            for j in 0..6 {
                row[j] += scaled * y[j];
            }
        }
    }

    pub(crate) fn transposed(&self) -> Block {
        let mut other = Block::ZERO;
        other.add_transposed(self);
        other
    }

    /// Xᵀ B: [`carry`] applied to each column.
    #[inline(always)]
    pub(crate) fn carry_rows(&mut self, arm: &Vec3) {
        for j in 0..6 {
            let (x, y, z) = (self.0[3][j], self.0[4][j], self.0[5][j]);
            self.0[0][j] += arm.y * z - arm.z * y;
            self.0[1][j] += arm.z * x - arm.x * z;
            self.0[2][j] += arm.x * y - arm.y * x;
        }
    }

    /// B X: the transposed operation, applied to each row.
    #[inline(always)]
    pub(crate) fn carry_columns(&mut self, arm: &Vec3) {
        for row in &mut self.0 {
            let (x, y, z) = (row[3], row[4], row[5]);
            row[0] += arm.y * z - arm.z * y;
            row[1] += arm.z * x - arm.x * z;
            row[2] += arm.x * y - arm.y * x;
        }
    }
}

/// Xᵀ f: moves a wrench from the child's mass centre to the parent's; `arm` points from the parent's to the child's.
#[inline(always)]
pub(crate) fn carry(f: &Six, arm: &Vec3) -> Six {
    Six::new(
        f[0] + arm.y * f[5] - arm.z * f[4],
        f[1] + arm.z * f[3] - arm.x * f[5],
        f[2] + arm.x * f[4] - arm.y * f[3],
        f[3],
        f[4],
        f[5],
    )
}

/// X a: the motion of the parent at the child's mass centre, v + ω × arm.
#[inline(always)]
pub(crate) fn transport(a: &Six, arm: &Vec3) -> Six {
    Six::new(
        a[0],
        a[1],
        a[2],
        a[3] + a[1] * arm.z - a[2] * arm.y,
        a[4] + a[2] * arm.x - a[0] * arm.z,
        a[5] + a[0] * arm.y - a[1] * arm.x,
    )
}

/// Factors a symmetric matrix of `rows.len()` ≤ 6 rows as L D Lᵀ in place: unit L below the diagonal, 1/D on it. Zero pivots and
/// pivots up to `least` are disabled (1/D = 0); returns their number.
#[inline(always)]
pub(crate) fn factor_small(rows: &mut [[f64; 6]], least: &[f64; 6]) -> usize {
    let size = rows.len();
    let mut off = 0;
    let mut d = [0.0; 6];
    for j in 0..size {
        let own = rows[j][j];
        let mut pivot = own;
        for k in 0..j {
            pivot -= rows[j][k] * rows[j][k] * d[k];
        }
        let vanishes = pivot <= VANISHED * own.abs() || pivot <= least[j];
        off += usize::from(vanishes);
        d[j] = if vanishes { 0.0 } else { pivot };
        let inverse = if vanishes { 0.0 } else { 1.0 / pivot };
        for i in j + 1..size {
            let mut sum = rows[i][j];
            for k in 0..j {
                sum -= rows[i][k] * rows[j][k] * d[k];
            }
            rows[i][j] = sum * inverse;
        }
        rows[j][j] = inverse;
    }
    off
}

/// Solves with the result of [`factor_small`].
#[inline(always)]
pub(crate) fn solve_small(rows: &[[f64; 6]], x: &mut [f64]) {
    let size = rows.len();
    for i in 0..size {
        for k in 0..i {
            x[i] -= rows[i][k] * x[k];
        }
    }
    for i in 0..size {
        x[i] *= rows[i][i];
    }
    for i in (0..size).rev() {
        for k in i + 1..size {
            x[i] -= rows[k][i] * x[k];
        }
    }
}
