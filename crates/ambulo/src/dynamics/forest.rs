//! Accelerations and constraint forces of any number of trees of bodies, in linear time.
//!
//! For all bodies and rows together, with M the inertias, J the rows, f the known wrenches and c the targets:
//!
//!   [ M  -Jᵀ ] [ a ]   [ f ]
//!   [ J   0  ] [ λ ] = [ c ]
//!
//! In a forest every body has one joint to its parent. Going from the leaves to the root and eliminating each body and
//! then its joint touches nothing but the parent's 6 x 6 block, so the factor has no more blocks than the matrix:
//!
//!   Y = A⁻¹ J_cᵀ      S = J_c Y      λ = S⁻¹ (c - J_c A⁻¹ b - J_p a_p)      a = A⁻¹ b + Y λ
//!   A_p += J_pᵀ S⁻¹ J_p               b_p += J_pᵀ S⁻¹ (c - J_c A⁻¹ b)
//!
//! where A and b are the body's inertia and wrench with what its own children have added. On the way back the parents'
//! accelerations give the multipliers.
//!
//! A body without mass has no A⁻¹, but its joint holds it. Adding ρ J_cᵀ (J_c a + J_p a_p - c), which is zero, to its row
//! changes nothing and makes the block regular: with μ = λ - ρ J_p a_p everything above holds for A + ρ J_cᵀ J_c,
//! b + ρ J_cᵀ c and μ, and the parent receives J_pᵀ S⁻¹ J_p - ρ J_pᵀ J_p.
//!
//! | code     | symbol | unit                 | shape                     |
//! | `a`      | a      | rad/s², m/s²         | 6 a body                  |
//! | `lambda` | λ      | N.m or N             | one a row                 |
//! | `block`  | A      | kg.m², kg.m, kg      | 6 x 6 a body              |
//! | `schur`  | S      | 1/(kg.m²), 1/kg      | rows x rows a joint       |
//! | `rho`    | ρ      | kg                   | one a body, mostly 0      |
//!
//! Source: Baraff 1996, "Linear-time dynamics using Lagrange multipliers" (unverified page), as the paper of 1997 cites
//! it in section 3.1; the recursion is derived above.
//! Cost: linear in bodies; no matrix larger than 6 x 6.
//! Not handled: closed loops (an error names the body).
//! Redundant rows get the multiplier zero and are counted; see [`Solution::redundant`].
//! Pinned by: tests/forest.rs

use super::constraint::{BodyTerms, Constraint, Six};
use crate::spatial::{Twist, Vec3};
use nalgebra::Matrix6;
use std::ops::Range;

/// A pivot below this share of the row's own size says that the row repeats others: sums of six products round to a few
/// 1e-16, and inertias of real bodies span 1e4.
const REDUNDANT: f64 = 1e-11;
/// A body's block with a pivot below this share is held by its joint (ρ): what its children add to a body without mass is
/// singular but for rounding, and dividing by that rounding would spread it. Solid bodies keep pivots above 1e-5.
const WEAK: f64 = 1e-6;

/// Which body hangs on which, and how many rows hold it. Never changes; the solver's scratch is a [`ForestWorkspace`].
#[derive(Debug, Clone)]
pub struct Forest {
    /// Per body: its parent, and its rows among all rows.
    links: Vec<(Option<usize>, Range<usize>)>,
    /// Bodies, parents before children.
    outwards: Vec<usize>,
    rows: usize,
}

/// A joint between a body and its parent, or ground.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Link {
    /// The body that hangs on the joint.
    pub child: usize,
    /// What it hangs on; `None` is ground.
    pub parent: Option<usize>,
    /// Number of rows, at most six.
    pub rows: usize,
}

/// Why links are no forest.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ForestError {
    /// A body that is not there.
    #[error("link {link} names body {body}; expected a number below {bodies}")]
    NoBody {
        /// The link, from 0.
        link: usize,
        /// The body that it names.
        body: usize,
        /// How many there are.
        bodies: usize,
    },
    /// Two joints hold one body.
    #[error(
        "body {body} is the child of two links, the second being {link}; expected one. hint: close loops with closing rows, not with links"
    )]
    TwoParents {
        /// The body.
        body: usize,
        /// The second link, from 0.
        link: usize,
    },
    /// Links that lead in a circle.
    #[error("body {body} hangs on itself by way of its parents; expected trees")]
    Circle {
        /// A body of the circle.
        body: usize,
    },
    /// More rows than a joint can have.
    #[error("link {link} has {rows} rows; expected at most 6")]
    Rows {
        /// The link, from 0.
        link: usize,
        /// Its rows.
        rows: usize,
    },
}

/// Scratch for one forest. Nothing is allocated after it is made.
#[derive(Debug, Clone)]
pub struct ForestWorkspace {
    block: Vec<Matrix6<f64>>,
    factors: Vec<Factor6>,
    /// b, then A⁻¹ b.
    right: Vec<Six>,
    a: Vec<Six>,
    /// Y = A⁻¹ J_cᵀ, one column a row.
    y: Vec<Six>,
    schur: Vec<Small>,
    rho: Vec<f64>,
    typical_mass: f64,
    /// c - J_c A⁻¹ b, then S⁻¹ of it.
    rest: Vec<f64>,
    lambda: Vec<f64>,
    redundant: usize,
    inertialess: usize,
}

/// What a solve yields, borrowed from the workspace.
#[derive(Debug, Clone, Copy)]
pub struct Solution<'w> {
    /// Accelerations, one a body.
    a: &'w [Six],
    /// Multipliers, one a row [N.m or N].
    pub lambda: &'w [f64],
    /// Rows that repeat others; their multipliers are zero.
    pub redundant: usize,
    /// Directions in which a body has no inertia and no row; it does not accelerate that way.
    pub inertialess: usize,
}

impl Solution<'_> {
    /// Acceleration of a body at its mass centre [rad/s², m/s²].
    #[must_use]
    pub fn acceleration(&self, body: usize) -> Twist {
        let a = &self.a[body];
        Twist { angular: Vec3::new(a[0], a[1], a[2]), linear: Vec3::new(a[3], a[4], a[5]) }
    }
}

impl Forest {
    /// Sorts the links of `bodies` bodies. A body without a link is free.
    ///
    /// Rows are numbered link by link, in the order in which the links are given.
    ///
    /// # Errors
    /// Links that are no forest: see [`ForestError`].
    pub fn new(bodies: usize, list: &[Link]) -> Result<Forest, ForestError> {
        let mut links: Vec<(Option<usize>, Range<usize>)> = vec![(None, 0..0); bodies];
        let mut linked = vec![false; bodies];
        let mut rows = 0;
        for (number, link) in list.iter().enumerate() {
            for body in std::iter::once(link.child).chain(link.parent) {
                if body >= bodies {
                    return Err(ForestError::NoBody { link: number, body, bodies });
                }
            }
            if std::mem::replace(&mut linked[link.child], true) {
                return Err(ForestError::TwoParents { body: link.child, link: number });
            }
            if link.rows > 6 {
                return Err(ForestError::Rows { link: number, rows: link.rows });
            }
            links[link.child] = (link.parent, rows..rows + link.rows);
            rows += link.rows;
        }
        let outwards = outwards(&links)?;
        Ok(Forest { links, outwards, rows })
    }

    /// Number of rows of all joints.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Factors the system; wrenches and targets play no part yet. `bodies` has one entry a body, `rows` one a row.
    ///
    /// # Panics
    /// If a slice has another length than the forest has bodies or rows.
    pub fn factor(&self, bodies: &[BodyTerms], rows: &[Constraint], workspace: &mut ForestWorkspace) {
        assert_eq!(bodies.len(), self.links.len(), "one entry a body");
        assert_eq!(rows.len(), self.rows, "one entry a row");
        workspace.begin(bodies);
        for &i in self.outwards.iter().rev() {
            self.factor_link(i, rows, workspace);
        }
    }

    /// Accelerations and multipliers under these wrenches and targets; the system has been factored with the same masses
    /// and the same rows. May be called again with other wrenches and targets.
    ///
    /// # Panics
    /// If a slice has another length than the forest has bodies or rows.
    pub fn solve<'w>(
        &self,
        bodies: &[BodyTerms],
        rows: &[Constraint],
        workspace: &'w mut ForestWorkspace,
    ) -> Solution<'w> {
        assert_eq!(bodies.len(), self.links.len(), "one entry a body");
        assert_eq!(rows.len(), self.rows, "one entry a row");
        for (right, body) in workspace.right.iter_mut().zip(bodies) {
            let (m, f) = (body.wrench.moment, body.wrench.force);
            *right = Six::new(m.x, m.y, m.z, f.x, f.y, f.z);
        }
        for &i in self.outwards.iter().rev() {
            self.gather(i, rows, workspace);
        }
        for &i in &self.outwards {
            self.substitute(i, rows, workspace);
        }
        let ForestWorkspace { a, lambda, redundant, inertialess, .. } = workspace;
        Solution { a, lambda, redundant: *redundant, inertialess: *inertialess }
    }

    /// Body i and its joint, into the parent's block.
    fn factor_link(&self, i: usize, rows: &[Constraint], w: &mut ForestWorkspace) {
        let (parent, range) = &self.links[i];
        let own = &rows[range.clone()];
        w.factor_body(i, own);
        let count = range.len();
        let mut schur = Small::zeros(count);
        for (r, row) in range.clone().zip(own) {
            w.y[r] = w.factors[i].solve(&row.on_child);
        }
        for (m, row) in own.iter().enumerate() {
            for n in 0..=m {
                schur.set(m, n, row.on_child.dot(&w.y[range.start + n]));
            }
        }
        w.redundant += schur.factor();
        w.schur[i] = schur;
        let Some(parent) = *parent else { return };
        // A_p += J_pᵀ S⁻¹ J_p - ρ J_pᵀ J_p, column by column.
        for column in 0..6 {
            let mut solved = [0.0; 6];
            for (s, row) in solved.iter_mut().zip(own) {
                *s = row.on_parent[column];
            }
            w.schur[i].solve(&mut solved[..count]);
            for (s, row) in solved.iter().zip(own) {
                let factor = s - w.rho[i] * row.on_parent[column];
                w.block[parent].column_mut(column).axpy(factor, &row.on_parent, 1.0);
            }
        }
    }

    /// What body i and its joint add to the parent's wrench: b_p += J_pᵀ S⁻¹ (c - J_c A⁻¹ b).
    fn gather(&self, i: usize, rows: &[Constraint], w: &mut ForestWorkspace) {
        let (parent, range) = &self.links[i];
        let own = &rows[range.clone()];
        for row in own {
            let share = row.on_child * (w.rho[i] * row.target);
            w.right[i] += share;
        }
        w.right[i] = w.factors[i].solve(&w.right[i]);
        for (r, row) in range.clone().zip(own) {
            w.rest[r] = row.target - row.on_child.dot(&w.right[i]);
        }
        w.schur[i].solve(&mut w.rest[range.clone()]);
        let Some(parent) = *parent else { return };
        for (r, row) in range.clone().zip(own) {
            let push = row.on_parent * w.rest[r];
            w.right[parent] += push;
        }
    }

    /// λ and a of body i from the parent's acceleration.
    fn substitute(&self, i: usize, rows: &[Constraint], w: &mut ForestWorkspace) {
        let (parent, range) = &self.links[i];
        let count = range.len();
        let mut of_parent = [0.0; 6];
        if let Some(parent) = parent {
            for (s, row) in of_parent.iter_mut().zip(&rows[range.clone()]) {
                *s = row.on_parent.dot(&w.a[*parent]);
            }
        }
        let mut solved = of_parent;
        w.schur[i].solve(&mut solved[..count]);
        w.a[i] = w.right[i];
        for (k, r) in range.clone().enumerate() {
            let mu = w.rest[r] - solved[k];
            w.lambda[r] = mu + w.rho[i] * of_parent[k];
            let share = w.y[r] * mu;
            w.a[i] += share;
        }
    }
}

impl ForestWorkspace {
    /// Scratch for this forest.
    #[must_use]
    pub fn new(forest: &Forest) -> ForestWorkspace {
        let (bodies, rows) = (forest.links.len(), forest.rows);
        ForestWorkspace {
            block: vec![Matrix6::zeros(); bodies],
            factors: vec![Factor6::new(&Matrix6::identity()); bodies],
            right: vec![Six::zeros(); bodies],
            a: vec![Six::zeros(); bodies],
            y: vec![Six::zeros(); rows],
            schur: vec![Small::zeros(0); bodies],
            rho: vec![0.0; bodies],
            typical_mass: 0.0,
            rest: vec![0.0; rows],
            lambda: vec![0.0; rows],
            redundant: 0,
            inertialess: 0,
        }
    }

    fn begin(&mut self, bodies: &[BodyTerms]) {
        (self.redundant, self.inertialess) = (0, 0);
        self.typical_mass = bodies.iter().map(|b| b.mass).sum::<f64>() / bodies.len().max(1) as f64;
        for (block, body) in self.block.iter_mut().zip(bodies) {
            *block = Matrix6::zeros();
            block.fixed_view_mut::<3, 3>(0, 0).copy_from(&body.inertia);
            for k in 3..6 {
                block[(k, k)] = body.mass;
            }
        }
    }

    /// Factors a body's block; where it has no inertia in some direction, with ρ J_cᵀ J_c added.
    fn factor_body(&mut self, i: usize, rows: &[Constraint]) {
        self.rho[i] = 0.0;
        self.factors[i] = Factor6::new(&self.block[i]);
        if self.factors[i].weakest <= WEAK && !rows.is_empty() {
            self.rho[i] = if self.typical_mass > 0.0 { self.typical_mass } else { 1.0 };
            for row in rows {
                self.block[i] += row.on_child * self.rho[i] * row.on_child.transpose();
            }
            self.factors[i] = Factor6::new(&self.block[i]);
        }
        self.inertialess += self.factors[i].vanished;
    }
}

/// Parents before children.
fn outwards(links: &[(Option<usize>, Range<usize>)]) -> Result<Vec<usize>, ForestError> {
    let mut children = vec![Vec::new(); links.len()];
    let mut order = Vec::with_capacity(links.len());
    for (i, (parent, _)) in links.iter().enumerate() {
        match parent {
            Some(parent) => children[*parent].push(i),
            None => order.push(i),
        }
    }
    let mut next = 0;
    while next < order.len() {
        order.extend_from_slice(&children[order[next]]);
        next += 1;
    }
    if order.len() == links.len() {
        return Ok(order);
    }
    let reached: std::collections::BTreeSet<usize> = order.into_iter().collect();
    let body = (0..links.len()).find(|i| !reached.contains(i)).unwrap_or_default();
    Err(ForestError::Circle { body })
}

/// L D Lᵀ of a body's block. A pivot that vanishes (a body without mass in that direction, and nothing on it) takes no
/// part: the body does not accelerate that way by itself.
#[derive(Debug, Clone, Copy)]
struct Factor6 {
    l: Matrix6<f64>,
    inverse_d: [f64; 6],
    /// Number of pivots that vanished.
    vanished: usize,
    /// Smallest pivot as a share of its row's own size.
    weakest: f64,
}

impl Factor6 {
    fn new(a: &Matrix6<f64>) -> Factor6 {
        let mut l = Matrix6::zeros();
        let mut d = [0.0; 6];
        let mut inverse_d = [0.0; 6];
        let (mut vanished, mut weakest) = (0, 1.0_f64);
        for j in 0..6 {
            let mut pivot = a[(j, j)];
            for k in 0..j {
                pivot -= l[(j, k)] * l[(j, k)] * d[k];
            }
            let vanishes = pivot <= REDUNDANT * a[(j, j)].abs() || pivot <= 0.0;
            vanished += usize::from(vanishes);
            weakest = weakest.min(if vanishes { 0.0 } else { pivot / a[(j, j)] });
            d[j] = if vanishes { 0.0 } else { pivot };
            inverse_d[j] = if vanishes { 0.0 } else { 1.0 / pivot };
            l[(j, j)] = 1.0;
            for i in j + 1..6 {
                let mut sum = a[(i, j)];
                for k in 0..j {
                    sum -= l[(i, k)] * l[(j, k)] * d[k];
                }
                l[(i, j)] = sum * inverse_d[j];
            }
        }
        Factor6 { l, inverse_d, vanished, weakest }
    }

    fn solve(&self, b: &Six) -> Six {
        let mut x = *b;
        for i in 0..6 {
            for k in 0..i {
                x[i] -= self.l[(i, k)] * x[k];
            }
        }
        for i in 0..6 {
            x[i] *= self.inverse_d[i];
        }
        for i in (0..6).rev() {
            for k in i + 1..6 {
                x[i] -= self.l[(k, i)] * x[k];
            }
        }
        x
    }
}

/// A symmetric matrix of at most six rows, and in place its L D Lᵀ (unit L below the diagonal, 1/D on it).
#[derive(Debug, Clone, Copy)]
struct Small {
    size: usize,
    m: [[f64; 6]; 6],
}

impl Small {
    fn zeros(size: usize) -> Small {
        Small { size, m: [[0.0; 6]; 6] }
    }

    fn set(&mut self, i: usize, j: usize, value: f64) {
        self.m[i][j] = value;
    }

    /// Factors in place; rows whose pivot vanishes are switched off (1/D = 0) and counted.
    fn factor(&mut self) -> usize {
        let mut off = 0;
        let mut d = [0.0; 6];
        for j in 0..self.size {
            let own = self.m[j][j];
            let mut pivot = own;
            for k in 0..j {
                pivot -= self.m[j][k] * self.m[j][k] * d[k];
            }
            let vanishes = pivot <= REDUNDANT * own.abs() || pivot <= 0.0;
            off += usize::from(vanishes);
            d[j] = if vanishes { 0.0 } else { pivot };
            let inverse = if vanishes { 0.0 } else { 1.0 / pivot };
            for i in j + 1..self.size {
                let mut sum = self.m[i][j];
                for k in 0..j {
                    sum -= self.m[i][k] * self.m[j][k] * d[k];
                }
                self.m[i][j] = sum * inverse;
            }
            self.m[j][j] = inverse;
        }
        off
    }

    fn solve(&self, x: &mut [f64]) {
        let n = self.size;
        for i in 0..n {
            for k in 0..i {
                x[i] -= self.m[i][k] * x[k];
            }
        }
        for i in 0..n {
            x[i] *= self.m[i][i];
        }
        for i in (0..n).rev() {
            for k in i + 1..n {
                x[i] -= self.m[k][i] * x[k];
            }
        }
    }
}
