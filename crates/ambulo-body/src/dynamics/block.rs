//! Six-vectors, 6 x 6 blocks, body inertias, and the small symmetric systems of one joint.
//!
//! Written out for fixed sizes: the 6 x 6 factorisation of a general library took four times as long (measured).

use crate::spatial::{Mat3, Vec3};

/// A motion or wrench of a body: angular part, then linear part.
pub type Six = nalgebra::Vector6<f64>;

/// A pivot below this share of its diagonal entry counts as zero: sums of six products round to a few 1e-16, while
/// stiff rows (see `proximal`) leave a share of 1e-10.
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
}

/// Entries of a symmetric 3 x 3 matrix: xx, xy, xz, yy, yz, zz.
type Triangle = [f64; 6];

/// Rows and columns of the entries of a [`Triangle`].
const PLACES: [(usize, usize); 6] = [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)];

/// y += T x.
#[inline(always)]
fn add_product(t: &Triangle, x: [f64; 3], y: &mut [f64]) {
    y[0] += t[0] * x[0] + t[1] * x[1] + t[2] * x[2];
    y[1] += t[1] * x[0] + t[3] * x[1] + t[4] * x[2];
    y[2] += t[2] * x[0] + t[4] * x[1] + t[5] * x[2];
}

/// A symmetric 6 x 6 block, such as the inertia of a body with all that hangs on it: [A B; Bᵀ C], angular part first.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Symmetric {
    angular: Triangle,
    coupling: [[f64; 3]; 3],
    linear: Triangle,
}

impl Symmetric {
    pub(crate) const ZERO: Symmetric = Symmetric { angular: [0.0; 6], coupling: [[0.0; 3]; 3], linear: [0.0; 6] };

    /// The inertia of one body about its mass centre.
    #[inline(always)]
    pub(crate) fn of(body: &BodyTerms) -> Symmetric {
        Symmetric {
            angular: PLACES.map(|place| body.inertia[place]),
            coupling: [[0.0; 3]; 3],
            linear: [body.mass, 0.0, 0.0, body.mass, 0.0, body.mass],
        }
    }

    /// Sums of the angular and of the linear part of the diagonal.
    #[inline(always)]
    pub(crate) fn traces(&self) -> (f64, f64) {
        let trace = |t: &Triangle| t[0] + t[3] + t[5];
        (trace(&self.angular), trace(&self.linear))
    }

    #[inline(always)]
    pub(crate) fn times(&self, x: &Six) -> Six {
        let (turn, slide) = ([x[0], x[1], x[2]], [x[3], x[4], x[5]]);
        let mut y = [0.0; 6];
        for i in 0..3 {
            for j in 0..3 {
                y[i] += self.coupling[i][j] * slide[j];
                y[3 + j] += self.coupling[i][j] * turn[i];
            }
        }
        add_product(&self.angular, turn, &mut y[..3]);
        add_product(&self.linear, slide, &mut y[3..]);
        Six::from(y)
    }

    #[inline(always)]
    pub(crate) fn add(&mut self, other: &Symmetric) {
        for k in 0..6 {
            self.angular[k] += other.angular[k];
            self.linear[k] += other.linear[k];
        }
        for i in 0..3 {
            for j in 0..3 {
                self.coupling[i][j] += other.coupling[i][j];
            }
        }
    }

    /// Adds `factor` x yᵀ; the sum of all that is added must be symmetric.
    #[inline(always)]
    pub(crate) fn add_outer(&mut self, x: &Six, y: &Six, factor: f64) {
        let scaled = x * factor;
        for (k, (i, j)) in PLACES.into_iter().enumerate() {
            self.angular[k] += scaled[i] * y[j];
            self.linear[k] += scaled[3 + i] * y[3 + j];
        }
        for i in 0..3 {
            for j in 0..3 {
                self.coupling[i][j] += scaled[i] * y[3 + j];
            }
        }
    }

    /// Adds B + Bᵀ.
    pub(crate) fn add_with_transpose(&mut self, Block(b): &Block) {
        for (k, (i, j)) in PLACES.into_iter().enumerate() {
            self.angular[k] += b[i][j] + b[j][i];
            self.linear[k] += b[3 + i][3 + j] + b[3 + j][3 + i];
        }
        for i in 0..3 {
            for j in 0..3 {
                self.coupling[i][j] += b[i][3 + j] + b[3 + j][i];
            }
        }
    }

    /// Xᵀ S X: the block as the parent moves with it. With R x = arm × x: B' = B + R C and A' = A + R Bᵀ + B' Rᵀ.
    #[inline(always)]
    pub(crate) fn carried(&self, arm: &Vec3) -> Symmetric {
        let Symmetric { angular, coupling, linear } = *self;
        let cross =
            |x: [f64; 3]| [arm.y * x[2] - arm.z * x[1], arm.z * x[0] - arm.x * x[2], arm.x * x[1] - arm.y * x[0]];
        let [xx, xy, xz, yy, yz, zz] = linear;
        // C is symmetric: its columns are its rows.
        let columns = [cross([xx, xy, xz]), cross([xy, yy, yz]), cross([xz, yz, zz])];
        let mut moved = coupling;
        for i in 0..3 {
            for j in 0..3 {
                moved[i][j] += columns[j][i];
            }
        }
        let (before, after) = (coupling.map(cross), moved.map(cross));
        let mut turned = angular;
        for (k, (i, j)) in PLACES.into_iter().enumerate() {
            turned[k] += before[j][i] + after[i][j];
        }
        Symmetric { angular: turned, coupling: moved, linear }
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
pub fn transport(a: &Six, arm: &Vec3) -> Six {
    Six::new(
        a[0],
        a[1],
        a[2],
        a[3] + a[1] * arm.z - a[2] * arm.y,
        a[4] + a[2] * arm.x - a[0] * arm.z,
        a[5] + a[0] * arm.y - a[1] * arm.x,
    )
}

/// Factors a symmetric matrix of `rows.len()` ≤ 6 rows as L D Lᵀ in place: unit L below the diagonal, 1/D on it. Zero
/// pivots and pivots up to `least` are disabled (1/D = 0); returns their number.
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
