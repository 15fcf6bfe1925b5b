//! Blocks of six by six numbers and the small symmetric systems of one joint.
//!
//! Written out by hand over fixed sizes: a general library's 6 x 6 factorisation was measured at four times the cost.

use super::constraint::Six;
use crate::spatial::Vec3;

/// A pivot below this share of its own diagonal has vanished: sums of six products round to a few 1e-16, while rows held
/// stiffly beside it (see `proximal`) leave it 1e-10.
const VANISHED: f64 = 1e-13;

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

    /// Xᵀ B: see [`carry`], column by column.
    #[inline(always)]
    pub(crate) fn carry_rows(&mut self, arm: &Vec3) {
        for j in 0..6 {
            let (x, y, z) = (self.0[3][j], self.0[4][j], self.0[5][j]);
            self.0[0][j] += arm.y * z - arm.z * y;
            self.0[1][j] += arm.z * x - arm.x * z;
            self.0[2][j] += arm.x * y - arm.y * x;
        }
    }

    /// B X: the same on columns.
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

/// Xᵀ f: a wrench at the child's mass centre, seen at the parent's; `arm` leads from the parent's to the child's.
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

/// X a: a motion of the parent, seen at the child's mass centre: v + ω × arm.
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

/// L D Lᵀ of a symmetric matrix of `rows.len()` ≤ 6 rows, in place: unit L below the diagonal, 1/D on it. Pivots that vanish
/// are switched off (1/D = 0), as are those up to `least`; their number is returned.
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

/// Solves with what [`factor_small`] left.
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
