//! Numeric part of the elimination: factors and solves linear systems of jointed bodies, leaves to root, without
//! fill-in on trees.
//!
//! A body c is attached to its parent p by a joint with f free directions S (6 x f, at the mass centre of c). For any
//! unknown (acceleration, velocity or displacement) the joint allows
//!
//!   a_c = X a_p + S q + w          X a = (α, a + α × arm)          w: prescribed by the joint
//!
//! The system is min ½ aᵀ A a - bᵀ a - τᵀ q over all bodies and free directions. A has the inertias on its diagonal
//! and, off the diagonal, the couplings between bodies that are no parent and child (closed loops, contacts between
//! bodies). Stationarity in a_c is Newton's law with the joint force as Lagrange multipliers of the 6 - f constrained
//! directions. With the neighbours n of c among the remaining bodies,
//!
//!   G_p = Sᵀ (A_cc X + A_cp)      G_n = Sᵀ A_cn      D = Sᵀ A_cc S      y = D⁻¹ (Sᵀ (b_c - A_cc w) + τ)
//!   A_pp += Xᵀ A_cc X + Xᵀ A_cp + A_pc X - G_pᵀ D⁻¹ G_p
//!   A_pn += Xᵀ A_cn - G_pᵀ D⁻¹ G_n           A_nm -= G_nᵀ D⁻¹ G_m
//!   b_p  += Xᵀ (b_c - A_cc w) - A_pc w - G_pᵀ y      b_n -= A_nc w + G_nᵀ y
//!   q = y - D⁻¹ (G_p a_p + Σ G_n a_n)                a_c = X a_p + S q + w
//!
//! This is the block L D Lᵀ factorisation of the system of bodies and multipliers, with each body and the multipliers
//! of its joint eliminated together, in the order of `elimination_order`. A massless body is no special case unless one
//! of its free directions moves no mass at all; such a direction is kept at rest (`inertialess`).
//!
//! | code         | symbol | unit             | shape                        |
//! | `diagonal`   | A_cc   | kg.m², kg.m, kg  | 6 x 6 per body               |
//! | `directions` | S      | 1, m             | 6 per free direction         |
//! | `arm`        |        | m                | 3 per body                   |
//! | `offset`     | w      | as the unknown   | 6 per body                   |
//! | `d`          | D      | kg.m² or kg      | f x f per joint              |
//!
//! Source: Baraff 1996, "Linear-time dynamics using Lagrange multipliers" (unverified page), as the paper of 1997 cites
//! it in section 3.1; the recursion over f free directions instead of 6 - f constrained ones is the articulated-body
//! recursion, derived above.
//! Cost: linear in bodies on forests.
//! Pinned by: tests/elimination.rs

use super::block::{Block, BodyTerms, Six, Symmetric, carry, factor_small, solve_small, transport};
use super::elimination_order::{BlockRef, Elimination, Link, LinkTerms, Step};
use crate::spatial::Vec3;
use std::ops::Range;

/// Sums of a few dozen products round to less than this share of their largest terms.
const ROUNDING: f64 = 1e-14;

/// Scratch memory of one elimination.
#[derive(Debug, Clone, Default)]
pub struct EliminationWorkspace {
    /// A_cc at the time when the body is eliminated.
    diagonal: Vec<Symmetric>,
    off: Vec<Block>,
    /// G_p, one row per coordinate.
    g_parent: Vec<Six>,
    /// G_n, six rows per neighbour.
    g_neighbor: Vec<[Six; 6]>,
    /// Factor of D, one row per coordinate.
    d: Vec<[f64; 6]>,
    /// Linear and angular size of the sums on each body's diagonal before the joints are eliminated; the result is
    /// accurate to `ROUNDING` of this. (The inner one of two hinges on the same line without mass between them has only
    /// rounding left.)
    carried: Vec<(f64, f64)>,
    inertialess: usize,
}

impl EliminationWorkspace {
    /// Sets the diagonal blocks to the inertias of the bodies and all others to zero. Blocks may be added afterwards.
    pub fn begin(&mut self, elimination: &Elimination, bodies: &[BodyTerms]) {
        assert_eq!(bodies.len(), elimination.bodies(), "one entry per body");
        let coordinates = elimination.coordinates();
        self.inertialess = 0;
        self.diagonal.resize(bodies.len(), Symmetric::ZERO);
        self.carried.clear();
        self.carried.resize(bodies.len(), (0.0, 0.0));
        self.g_parent.resize(coordinates, Six::zeros());
        self.d.resize(coordinates, [0.0; 6]);
        self.off.clear();
        self.off.resize(elimination.couplings.len(), Block::ZERO);
        self.g_neighbor.resize(elimination.neighbors.len(), [Six::zeros(); 6]);
        for row in &mut self.d {
            *row = [0.0; 6];
        }
        for (block, body) in self.diagonal.iter_mut().zip(bodies) {
            *block = Symmetric::of(body);
        }
    }

    /// The diagonal block of a body.
    pub(crate) fn diagonal_mut(&mut self, body: usize) -> &mut Symmetric {
        &mut self.diagonal[body]
    }

    /// An off-diagonal block; its rows belong to the body with the lower number.
    pub(crate) fn off_mut(&mut self, block: usize) -> &mut Block {
        &mut self.off[block]
    }

    /// Adds to the inertia of a coordinate [kg.m² or kg].
    pub(crate) fn add_to_coordinate(&mut self, elimination: &Elimination, coordinate: usize, body: usize, amount: f64) {
        self.d[coordinate][coordinate - elimination.first[body]] += amount;
    }

    /// Size of a pivot along a direction below which it is rounding.
    #[inline(always)]
    fn least(&self, body: usize, s: &Six) -> f64 {
        let (linear, angular) = self.carried[body];
        let turn = s[0] * s[0] + s[1] * s[1] + s[2] * s[2];
        let shift = s[3] * s[3] + s[4] * s[4] + s[5] * s[5];
        ROUNDING * (angular * turn + linear * shift)
    }

    /// Adds the size of a body's diagonal to its parent's.
    #[inline(always)]
    fn hang(&mut self, body: usize, parent: usize, arm: &Vec3) {
        let (angular, linear) = self.diagonal[body].traces();
        self.carried[parent].0 += linear;
        self.carried[parent].1 += angular + linear * arm.norm_squared();
    }

    /// Number of free directions that move no mass; they are kept at rest.
    #[must_use]
    pub fn inertialess(&self) -> usize {
        self.inertialess
    }
}

impl Elimination {
    /// Factors the system in the workspace.
    pub fn factor(&self, terms: &LinkTerms, w: &mut EliminationWorkspace) {
        for step in &self.steps {
            let (body, link) = (step.body, self.links[step.body]);
            let range = self.first[body]..self.first[body] + link.freedom;
            let alone = step.with_parent.is_none() && step.neighbors.is_empty();
            match link.freedom {
                0 | 1 if alone => self.factor_hinge(body, link, range.start, terms, w),
                1 => self.factor_coupled_hinge(step, link, range.start, terms, w),
                _ => self.factor_step(step, link, range, terms, w),
            }
        }
    }

    /// The common case: at most one free direction and no neighbours.
    #[inline(always)]
    fn factor_hinge(&self, body: usize, link: Link, k: usize, terms: &LinkTerms, w: &mut EliminationWorkspace) {
        let mut passed = w.diagonal[body];
        let mut u = Six::zeros();
        let mut inverse = 0.0;
        if link.freedom == 1 {
            let s = &terms.directions[k];
            u = passed.times(s);
            let pivot = s.dot(&u) + w.d[k][0];
            let moves = pivot > w.least(body, s);
            inverse = if moves { 1.0 / pivot } else { 0.0 };
            w.inertialess += usize::from(!moves);
            w.d[k][0] = inverse;
        }
        let Some(parent) = link.parent else { return };
        let arm = &terms.arm[body];
        if link.freedom == 1 {
            w.g_parent[k] = carry(&u, arm);
            passed.add_outer(&u, &u, -inverse);
        }
        w.diagonal[parent].add(&passed.carried(arm));
        w.hang(body, parent, arm);
    }

    /// One free direction and neighbours: what [`Elimination::factor_step`] does, without room for five more
    /// directions.
    fn factor_coupled_hinge(&self, step: &Step, link: Link, k: usize, terms: &LinkTerms, w: &mut EliminationWorkspace) {
        let (s, arm) = (&terms.directions[k], &terms.arm[step.body]);
        let own = w.diagonal[step.body];
        let u = own.times(s);
        let pivot = w.d[k][0] + s.dot(&u);
        let moves = pivot > w.least(step.body, s);
        let inverse = if moves { 1.0 / pivot } else { 0.0 };
        w.inertialess += usize::from(!moves);
        w.d[k][0] = inverse;
        if let Some(parent) = link.parent {
            let mut g = carry(&u, arm);
            let mut passed = own.carried(arm);
            if let Some(place) = step.with_parent {
                let mut block = self.read(place, w);
                g += block.transpose_times(s);
                block.carry_rows(arm);
                passed.add_with_transpose(&block);
            }
            passed.add_outer(&g, &(g * inverse), -1.0);
            w.diagonal[parent].add(&passed);
            w.hang(step.body, parent, arm);
            w.g_parent[k] = g;
        }
        let mut pair = step.pairs.start;
        for number in step.neighbors.clone() {
            let neighbor = self.neighbors[number];
            let mut block = self.read(neighbor.place, w);
            let g = block.transpose_times(s);
            let z = g * inverse;
            if link.parent.is_some() {
                block.carry_rows(arm);
                block.add_outer(&w.g_parent[k], &z, -1.0);
                self.write(neighbor.with_parent, &block, w);
            }
            w.diagonal[neighbor.body].add_outer(&g, &z, -1.0);
            w.g_neighbor[number][0] = g;
        }
        for number in step.neighbors.clone() {
            let z = w.g_neighbor[number][0] * inverse;
            for later in number + 1..step.neighbors.end {
                let BlockRef { block, transposed } = self.pairs[pair];
                let (rows, columns) =
                    if transposed { (&w.g_neighbor[later][0], &z) } else { (&z, &w.g_neighbor[later][0]) };
                w.off[block].add_outer(rows, columns, -1.0);
                pair += 1;
            }
        }
    }

    fn factor_step(
        &self,
        step: &Step,
        link: Link,
        range: Range<usize>,
        terms: &LinkTerms,
        w: &mut EliminationWorkspace,
    ) {
        let f = link.freedom;
        let own = w.diagonal[step.body];
        let s = &terms.directions[range.clone()];
        let arm = &terms.arm[step.body];
        let mut u = [Six::zeros(); 6];
        for k in 0..f {
            u[k] = own.times(&s[k]);
        }
        for i in 0..f {
            for j in 0..=i {
                w.d[range.start + i][j] += s[i].dot(&u[j]);
            }
        }
        let mut least = [0.0; 6];
        for k in 0..f {
            least[k] = w.least(step.body, &s[k]);
        }
        w.inertialess += factor_small(&mut w.d[range.clone()], &least);
        let with_parent = step.with_parent.map(|place| self.read(place, w));
        if let Some(parent) = link.parent {
            for k in 0..f {
                w.g_parent[range.start + k] = carry(&u[k], arm);
            }
            let mut passed = own.carried(arm);
            if let Some(mut block) = with_parent {
                for k in 0..f {
                    w.g_parent[range.start + k] += block.transpose_times(&s[k]);
                }
                block.carry_rows(arm);
                passed.add_with_transpose(&block);
            }
            w.diagonal[parent].add(&passed);
            w.hang(step.body, parent, arm);
        }
        self.factor_neighbors(step, link, range, terms, w);
    }

    /// Updates the blocks between the parent and the neighbours of the body.
    fn factor_neighbors(
        &self,
        step: &Step,
        link: Link,
        range: Range<usize>,
        terms: &LinkTerms,
        w: &mut EliminationWorkspace,
    ) {
        let f = link.freedom;
        let arm = &terms.arm[step.body];
        for number in step.neighbors.clone() {
            let neighbor = self.neighbors[number];
            let mut block = self.read(neighbor.place, w);
            for k in 0..f {
                w.g_neighbor[number][k] = block.transpose_times(&terms.directions[range.start + k]);
            }
            if link.parent.is_some() {
                block.carry_rows(arm);
                self.write(neighbor.with_parent, &block, w);
            }
        }
        if f == 0 {
            return;
        }
        // Z = D⁻¹ G of the parent, then of each neighbour, and its products with the remaining neighbours.
        if let Some(parent) = link.parent {
            let mut g = [Six::zeros(); 6];
            g[..f].copy_from_slice(&w.g_parent[range.clone()]);
            let z = self.solved(&range, &g, w);
            for k in 0..f {
                w.diagonal[parent].add_outer(&g[k], &z[k], -1.0);
            }
            for number in step.neighbors.clone() {
                let product = product(&z, &w.g_neighbor[number], f);
                self.write(self.neighbors[number].with_parent, &product, w);
            }
        }
        let mut pair = step.pairs.start;
        for number in step.neighbors.clone() {
            let g = w.g_neighbor[number];
            let z = self.solved(&range, &g, w);
            for k in 0..f {
                w.diagonal[self.neighbors[number].body].add_outer(&g[k], &z[k], -1.0);
            }
            for later in number + 1..step.neighbors.end {
                let product = product(&z, &w.g_neighbor[later], f);
                self.write(self.pairs[pair], &product, w);
                pair += 1;
            }
        }
    }

    /// D⁻¹ G.
    fn solved(&self, range: &Range<usize>, g: &[Six; 6], w: &EliminationWorkspace) -> [Six; 6] {
        let rows = &w.d[range.clone()];
        let f = rows.len();
        let mut z = *g;
        for i in 0..f {
            for k in 0..i {
                let (done, rest) = z.split_at_mut(i);
                rest[0].axpy(-rows[i][k], &done[k], 1.0);
            }
        }
        for i in 0..f {
            z[i] *= rows[i][i];
        }
        for i in (0..f).rev() {
            for k in i + 1..f {
                let (before, after) = z.split_at_mut(k);
                before[i].axpy(-rows[k][i], &after[0], 1.0);
            }
        }
        z
    }

    fn read(&self, place: BlockRef, w: &EliminationWorkspace) -> Block {
        let block = &w.off[place.block];
        if place.transposed { block.transposed() } else { *block }
    }

    fn write(&self, place: BlockRef, more: &Block, w: &mut EliminationWorkspace) {
        let block = &mut w.off[place.block];
        if place.transposed { block.add_transposed(more) } else { block.add(more) }
    }

    /// Solves with the factor. `bodies` contains the wrenches b and receives the motions a, one per body; `coordinates`
    /// contains the efforts τ and receives the joint motions q.
    pub fn solve(
        &self,
        terms: &LinkTerms,
        offsets: Offsets,
        bodies: &mut [Six],
        coordinates: &mut [f64],
        w: &EliminationWorkspace,
    ) {
        for step in &self.steps {
            self.gather(step, terms, offsets, bodies, coordinates, w);
        }
        for step in self.steps.iter().rev() {
            self.spread(step, terms, offsets, bodies, coordinates, w);
        }
    }

    #[inline(always)]
    fn gather(
        &self,
        step: &Step,
        terms: &LinkTerms,
        offsets: Offsets,
        bodies: &mut [Six],
        coordinates: &mut [f64],
        w: &EliminationWorkspace,
    ) {
        let (body, link) = (step.body, self.links[step.body]);
        let range = self.first[body]..self.first[body] + link.freedom;
        if offsets == Offsets::Prescribed {
            let offset = &terms.offset[body];
            let share = w.diagonal[body].times(offset);
            bodies[body] -= share;
            for number in step.neighbors.clone() {
                let neighbor = self.neighbors[number];
                bodies[neighbor.body] -= self.times_transposed(neighbor.place, offset, w);
            }
            if let (Some(place), Some(parent)) = (step.with_parent, link.parent) {
                bodies[parent] -= self.times_transposed(place, offset, w);
            }
        }
        if link.freedom == 1 {
            self.gather_hinge(step, link, range.start, terms, bodies, coordinates, w);
            return;
        }
        let b = bodies[body];
        for k in range.clone() {
            coordinates[k] += terms.directions[k].dot(&b);
        }
        solve_small(&w.d[range.clone()], &mut coordinates[range.clone()]);
        if let Some(parent) = link.parent {
            let mut passed = carry(&b, &terms.arm[body]);
            for k in range.clone() {
                passed.axpy(-coordinates[k], &w.g_parent[k], 1.0);
            }
            bodies[parent] += passed;
        }
        for number in step.neighbors.clone() {
            let other = self.neighbors[number].body;
            for (k, g) in range.clone().zip(&w.g_neighbor[number]) {
                bodies[other].axpy(-coordinates[k], g, 1.0);
            }
        }
    }

    /// The common case of [`Elimination::gather`]: one free direction.
    #[inline(always)]
    #[expect(clippy::too_many_arguments, reason = "those of the general case")]
    fn gather_hinge(
        &self,
        step: &Step,
        link: Link,
        k: usize,
        terms: &LinkTerms,
        bodies: &mut [Six],
        coordinates: &mut [f64],
        w: &EliminationWorkspace,
    ) {
        let b = bodies[step.body];
        let along = (coordinates[k] + terms.directions[k].dot(&b)) * w.d[k][0];
        coordinates[k] = along;
        if let Some(parent) = link.parent {
            let mut passed = carry(&b, &terms.arm[step.body]);
            passed.axpy(-along, &w.g_parent[k], 1.0);
            bodies[parent] += passed;
        }
        for number in step.neighbors.clone() {
            bodies[self.neighbors[number].body].axpy(-along, &w.g_neighbor[number][0], 1.0);
        }
    }

    /// Bᵀ x of the block between a body and its neighbour.
    fn times_transposed(&self, place: BlockRef, x: &Six, w: &EliminationWorkspace) -> Six {
        let block = &w.off[place.block];
        if place.transposed { block.times(x) } else { block.transpose_times(x) }
    }

    #[inline(always)]
    fn spread(
        &self,
        step: &Step,
        terms: &LinkTerms,
        offsets: Offsets,
        bodies: &mut [Six],
        coordinates: &mut [f64],
        w: &EliminationWorkspace,
    ) {
        let (body, link) = (step.body, self.links[step.body]);
        let range = self.first[body]..self.first[body] + link.freedom;
        if link.freedom == 1 {
            self.spread_hinge(step, link, range.start, terms, offsets, bodies, coordinates, w);
            return;
        }
        let mut known = [0.0; 6];
        let known = &mut known[..link.freedom];
        let mut a = match link.parent {
            Some(parent) => {
                let of_parent = bodies[parent];
                for (value, g) in known.iter_mut().zip(&w.g_parent[range.clone()]) {
                    *value = g.dot(&of_parent);
                }
                transport(&of_parent, &terms.arm[body])
            }
            None => Six::zeros(),
        };
        for number in step.neighbors.clone() {
            let of_neighbor = bodies[self.neighbors[number].body];
            for (value, g) in known.iter_mut().zip(&w.g_neighbor[number]) {
                *value += g.dot(&of_neighbor);
            }
        }
        solve_small(&w.d[range.clone()], known);
        if offsets == Offsets::Prescribed {
            a += terms.offset[body];
        }
        for (k, value) in range.zip(known.iter()) {
            coordinates[k] -= value;
            a.axpy(coordinates[k], &terms.directions[k], 1.0);
        }
        bodies[body] = a;
    }

    /// The common case of [`Elimination::spread`]: one free direction.
    #[inline(always)]
    #[expect(clippy::too_many_arguments, reason = "those of the general case")]
    fn spread_hinge(
        &self,
        step: &Step,
        link: Link,
        k: usize,
        terms: &LinkTerms,
        offsets: Offsets,
        bodies: &mut [Six],
        coordinates: &mut [f64],
        w: &EliminationWorkspace,
    ) {
        let (mut known, mut a) = (0.0, Six::zeros());
        if let Some(parent) = link.parent {
            let of_parent = &bodies[parent];
            known = w.g_parent[k].dot(of_parent);
            a = transport(of_parent, &terms.arm[step.body]);
        }
        for number in step.neighbors.clone() {
            known += w.g_neighbor[number][0].dot(&bodies[self.neighbors[number].body]);
        }
        if offsets == Offsets::Prescribed {
            a += terms.offset[step.body];
        }
        coordinates[k] -= known * w.d[k][0];
        a.axpy(coordinates[k], &terms.directions[k], 1.0);
        bodies[step.body] = a;
    }
}

/// Whether a solve includes the motion w that the joints prescribe.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Offsets {
    /// Includes it.
    Prescribed,
    /// w = 0: for differences between two solutions.
    None,
}

/// -Zᵀ G.
fn product(z: &[Six; 6], g: &[Six; 6], f: usize) -> Block {
    let mut block = Block::ZERO;
    for k in 0..f {
        block.add_outer(&z[k], &g[k], -1.0);
    }
    block
}
