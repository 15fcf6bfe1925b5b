//! Linear systems of jointed bodies, solved leaves to root without fill-in on trees.
//!
//! A body c hangs on its parent p by a joint with f free directions S (6 x f, at the mass centre of c). Whatever the
//! unknown is, acceleration, velocity or displacement, the joint leaves
//!
//!   a_c = X a_p + S q + w          X a = (α, a + α × arm)          w: what the joint prescribes
//!
//! The system is min ½ aᵀ A a - bᵀ a - τᵀ q over all bodies and free directions, where A holds the inertias on its
//! diagonal and, off the diagonal, whatever couples bodies that are no parent and child (closed loops, contacts between
//! bodies). Stationarity in a_c with the joint's own force on it is Newton's law with Lagrange multipliers: the
//! multipliers of the 6 - f held directions are that force. With the neighbours n of c among the bodies left,
//!
//!   G_p = Sᵀ (A_cc X + A_cp)      G_n = Sᵀ A_cn      D = Sᵀ A_cc S      y = D⁻¹ (Sᵀ (b_c - A_cc w) + τ)
//!   A_pp += Xᵀ A_cc X + Xᵀ A_cp + A_pc X - G_pᵀ D⁻¹ G_p
//!   A_pn += Xᵀ A_cn - G_pᵀ D⁻¹ G_n           A_nm -= G_nᵀ D⁻¹ G_m
//!   b_p  += Xᵀ (b_c - A_cc w) - A_pc w - G_pᵀ y      b_n -= A_nc w + G_nᵀ y
//!   q = y - D⁻¹ (G_p a_p + Σ G_n a_n)                a_c = X a_p + S q + w
//!
//! This is the block L D Lᵀ of the system of bodies and multipliers with each body and its joint's multipliers eliminated
//! together. On a forest no block appears that was not there. With couplings, the bodies whose children are gone are
//! eliminated in the order of fewest neighbours. A body without mass needs no care unless one of its free directions
//! moves no mass at all; such a direction does not move (`inertialess`).
//!
//! | code         | symbol | unit             | shape                        |
//! | `diagonal`   | A_cc   | kg.m², kg.m, kg  | 6 x 6 a body                 |
//! | `directions` | S      | 1, m             | 6 a free direction           |
//! | `arm`        |        | m                | 3 a body                     |
//! | `offset`     | w      | as the unknown   | 6 a body                     |
//! | `d`          | D      | kg.m² or kg      | f x f a joint                |
//!
//! Source: Baraff 1996, "Linear-time dynamics using Lagrange multipliers" (unverified page), as the paper of 1997 cites
//! it in section 3.1; the recursion, which for f free directions instead of 6 - f held ones is that of articulated
//! bodies, is derived above.
//! Cost: linear in bodies on forests.
//! Pinned by: tests/elimination.rs

use super::block::{Block, carry, factor_small, solve_small, transport};
use super::constraint::{BodyTerms, Six};
use crate::spatial::Vec3;
use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::ops::Range;

/// Sums of a few dozen products round to less than this share of their largest terms.
const ROUNDING: f64 = 1e-14;

/// How a body is held.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Link {
    /// The body that it hangs on; `None` is ground.
    pub parent: Option<usize>,
    /// Number of free directions, at most six.
    pub freedom: usize,
}

/// Why links are no forest.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum LinkError {
    /// A body that is not there.
    #[error("body {body} hangs on body {parent}; expected a number below {bodies}")]
    NoBody {
        /// The body.
        body: usize,
        /// The parent that it names.
        parent: usize,
        /// How many there are.
        bodies: usize,
    },
    /// Links that lead in a circle.
    #[error("body {body} hangs on itself by way of its parents; expected trees. hint: close loops with closing rows")]
    Circle {
        /// A body of the circle.
        body: usize,
    },
    /// More free directions than a joint can have.
    #[error("body {body} has {freedom} free directions; expected at most 6")]
    Freedom {
        /// The body.
        body: usize,
        /// What was asked for.
        freedom: usize,
    },
    /// A coupling of a body with itself or with one that is not there.
    #[error("bodies {first} and {second} cannot be coupled; expected two different bodies below {bodies}")]
    Coupling {
        /// One of the two.
        first: usize,
        /// The other one.
        second: usize,
        /// How many there are.
        bodies: usize,
    },
}

/// The joints at one instant.
#[derive(Debug, Clone, Default)]
pub struct LinkTerms {
    /// From the parent's mass centre to the body's [m]; one a body, without meaning on ground.
    pub arm: Vec<Vec3>,
    /// Free directions at the body's mass centre, world axes; one a coordinate.
    pub directions: Vec<Six>,
    /// What the joint prescribes of the body's motion relative to the parent's; one a body.
    pub offset: Vec<Six>,
}

/// The order in which bodies are eliminated and the blocks that this takes. Depends on who hangs on whom and who is coupled
/// with whom, not on numbers.
#[derive(Debug, Clone)]
pub struct Elimination {
    links: Vec<Link>,
    /// First coordinate of each body, and the number of all.
    first: Vec<usize>,
    steps: Vec<Step>,
    neighbors: Vec<Neighbor>,
    pairs: Vec<Place>,
    /// Bodies of each off-diagonal block, the lower number first; those asked for come first, each once.
    couplings: Vec<(usize, usize)>,
}

/// One body's turn.
#[derive(Debug, Clone)]
struct Step {
    body: usize,
    /// Block between the body and its own parent.
    with_parent: Option<Place>,
    neighbors: Range<usize>,
    /// Where the products of neighbours go: (0,1), (0,2) .. (1,2) ..
    pairs: Range<usize>,
}

/// A body coupled with the one whose turn it is.
#[derive(Debug, Clone, Copy)]
struct Neighbor {
    body: usize,
    place: Place,
    /// Block between the parent and this neighbour; without meaning on ground.
    with_parent: Place,
}

/// A block, and whether it is meant transposed.
#[derive(Debug, Clone, Copy)]
struct Place {
    block: usize,
    transposed: bool,
}

/// Scratch for one elimination.
#[derive(Debug, Clone, Default)]
pub struct EliminationWorkspace {
    /// A_cc, as left when the body's turn came.
    diagonal: Vec<Block>,
    off: Vec<Block>,
    /// G_p, one row a coordinate.
    g_parent: Vec<Six>,
    /// G_n, one row a neighbour and coordinate, from the step's first neighbour times six.
    g_neighbor: Vec<[Six; 6]>,
    /// Factor of D, one row a coordinate.
    d: Vec<[f64; 6]>,
    /// Linear and angular size of what was summed up on each body's diagonal, before joints took their share: it rounds to
    /// `ROUNDING` of this. (Of two hinges on one line with nothing between, the inner one sees but rounding.)
    carried: Vec<(f64, f64)>,
    inertialess: usize,
}

impl Elimination {
    /// Sorts out who is eliminated when. `couplings` are pairs of bodies that off-diagonal blocks will join.
    ///
    /// # Errors
    /// See [`LinkError`].
    pub fn new(links: &[Link], couplings: &[(usize, usize)]) -> Result<Elimination, LinkError> {
        let outwards = outwards(links)?;
        let mut first = Vec::with_capacity(links.len() + 1);
        let mut count = 0;
        for link in links {
            first.push(count);
            count += link.freedom;
        }
        first.push(count);
        let mut this = Elimination {
            links: links.to_vec(),
            first,
            steps: Vec::with_capacity(links.len()),
            neighbors: Vec::new(),
            pairs: Vec::new(),
            couplings: Vec::new(),
        };
        if couplings.is_empty() {
            this.steps.extend(outwards.iter().rev().map(|body| Step::alone(*body)));
        } else {
            this.order(&outwards, couplings)?;
        }
        Ok(this)
    }

    /// Number of bodies.
    #[must_use]
    pub fn bodies(&self) -> usize {
        self.links.len()
    }

    /// Number of coordinates: free directions of all joints.
    #[must_use]
    pub fn coordinates(&self) -> usize {
        self.first[self.links.len()]
    }

    /// The coordinates of a body's joint.
    #[must_use]
    pub fn coordinates_of(&self, body: usize) -> Range<usize> {
        self.first[body]..self.first[body + 1]
    }

    /// Off-diagonal blocks that the elimination works with; with none but those asked for, nothing was filled in.
    #[must_use]
    pub fn blocks(&self) -> usize {
        self.couplings.len()
    }

    /// Fewest neighbours first, among the bodies whose children are gone; the outermost of equals.
    fn order(&mut self, outwards: &[usize], couplings: &[(usize, usize)]) -> Result<(), LinkError> {
        let bodies = self.links.len();
        let mut adjacent: Vec<Vec<(usize, usize)>> = vec![Vec::new(); bodies];
        for &(first, second) in couplings {
            if first == second || first.max(second) >= bodies {
                return Err(LinkError::Coupling { first, second, bodies });
            }
            self.join(&mut adjacent, first, second);
        }
        let mut rank = vec![0; bodies];
        let mut children = vec![0_usize; bodies];
        for (number, body) in outwards.iter().enumerate() {
            rank[*body] = number;
            if let Some(parent) = self.links[*body].parent {
                children[parent] += 1;
            }
        }
        let mut gone = vec![false; bodies];
        let mut ready: BinaryHeap<(Reverse<usize>, usize, usize)> = BinaryHeap::new();
        let degree = |adjacent: &[Vec<(usize, usize)>], body: usize| Reverse(adjacent[body].len());
        for body in (0..bodies).filter(|b| children[*b] == 0) {
            ready.push((degree(&adjacent, body), rank[body], body));
        }
        while let Some((Reverse(seen), _, body)) = ready.pop() {
            if gone[body] || seen != adjacent[body].len() {
                continue;
            }
            gone[body] = true;
            let touched = self.eliminate(body, &mut adjacent);
            if let Some(parent) = self.links[body].parent {
                children[parent] -= 1;
                ready.extend((children[parent] == 0).then(|| (degree(&adjacent, parent), rank[parent], parent)));
            }
            for other in touched {
                ready.extend((children[other] == 0).then(|| (degree(&adjacent, other), rank[other], other)));
            }
        }
        Ok(())
    }

    /// One body's turn in the sorting: its neighbours become neighbours of each other and of its parent. Returns them.
    fn eliminate(&mut self, body: usize, adjacent: &mut [Vec<(usize, usize)>]) -> Vec<usize> {
        let parent = self.links[body].parent;
        let list = std::mem::take(&mut adjacent[body]);
        for (other, _) in &list {
            adjacent[*other].retain(|(b, _)| *b != body);
        }
        let place = |from: usize, to: usize, block: usize| Place { block, transposed: from > to };
        let with_parent =
            list.iter().find(|(other, _)| Some(*other) == parent).map(|(other, block)| place(body, *other, *block));
        let others: Vec<(usize, usize)> = list.into_iter().filter(|(other, _)| Some(*other) != parent).collect();
        let (start, first_pair) = (self.neighbors.len(), self.pairs.len());
        for &(other, block) in &others {
            let own = place(body, other, block);
            let with_parent = parent.map_or(own, |p| self.join(adjacent, p, other));
            self.neighbors.push(Neighbor { body: other, place: own, with_parent });
        }
        for (k, &(one, _)) in others.iter().enumerate() {
            for &(other, _) in &others[k + 1..] {
                // A joint without freedom passes nothing between its neighbours.
                if self.links[body].freedom > 0 {
                    let place = self.join(adjacent, one, other);
                    self.pairs.push(place);
                }
            }
        }
        self.steps.push(Step {
            body,
            with_parent,
            neighbors: start..self.neighbors.len(),
            pairs: first_pair..self.pairs.len(),
        });
        others.into_iter().map(|(other, _)| other).collect()
    }

    /// The block between two bodies, made if it is not there; transposed if the first has the higher number.
    fn join(&mut self, adjacent: &mut [Vec<(usize, usize)>], one: usize, other: usize) -> Place {
        let transposed = one > other;
        if let Some((_, block)) = adjacent[one].iter().find(|(b, _)| *b == other) {
            return Place { block: *block, transposed };
        }
        let block = self.couplings.len();
        self.couplings.push((one.min(other), one.max(other)));
        adjacent[one].push((other, block));
        adjacent[other].push((one, block));
        Place { block, transposed }
    }
}

impl Step {
    fn alone(body: usize) -> Step {
        Step { body, with_parent: None, neighbors: 0..0, pairs: 0..0 }
    }
}

/// Parents before children.
pub(super) fn outwards(links: &[Link]) -> Result<Vec<usize>, LinkError> {
    let bodies = links.len();
    let mut children = vec![Vec::new(); bodies];
    let mut order = Vec::with_capacity(bodies);
    for (body, link) in links.iter().enumerate() {
        if link.freedom > 6 {
            return Err(LinkError::Freedom { body, freedom: link.freedom });
        }
        match link.parent {
            Some(parent) if parent >= bodies => return Err(LinkError::NoBody { body, parent, bodies }),
            Some(parent) => children[parent].push(body),
            None => order.push(body),
        }
    }
    let mut next = 0;
    while next < order.len() {
        order.extend_from_slice(&children[order[next]]);
        next += 1;
    }
    if order.len() == bodies {
        return Ok(order);
    }
    let mut reached = vec![false; bodies];
    order.iter().for_each(|body| reached[*body] = true);
    Err(LinkError::Circle { body: reached.iter().position(|r| !r).unwrap_or_default() })
}

impl EliminationWorkspace {
    /// Makes room, and puts the bodies' inertias on the diagonal; off it are zeros. Then blocks may be added.
    pub fn begin(&mut self, elimination: &Elimination, bodies: &[BodyTerms]) {
        assert_eq!(bodies.len(), elimination.bodies(), "one entry a body");
        let coordinates = elimination.coordinates();
        self.inertialess = 0;
        self.diagonal.resize(bodies.len(), Block::ZERO);
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
            *block = Block::ZERO;
            for i in 0..3 {
                for j in 0..3 {
                    block.0[i][j] = body.inertia[(i, j)];
                }
                block.0[3 + i][3 + i] = body.mass;
            }
        }
    }

    /// The diagonal block of a body.
    pub(crate) fn diagonal_mut(&mut self, body: usize) -> &mut Block {
        &mut self.diagonal[body]
    }

    /// An off-diagonal block: rows for the body of the lower number.
    pub(crate) fn off_mut(&mut self, block: usize) -> &mut Block {
        &mut self.off[block]
    }

    /// Adds to the inertia of a coordinate [kg.m² or kg].
    pub(crate) fn add_to_coordinate(&mut self, elimination: &Elimination, coordinate: usize, body: usize, amount: f64) {
        self.d[coordinate][coordinate - elimination.first[body]] += amount;
    }

    /// A pivot along a direction up to which it is rounding.
    #[inline(always)]
    fn least(&self, body: usize, s: &Six) -> f64 {
        let (linear, angular) = self.carried[body];
        let turn = s[0] * s[0] + s[1] * s[1] + s[2] * s[2];
        let shift = s[3] * s[3] + s[4] * s[4] + s[5] * s[5];
        ROUNDING * (angular * turn + linear * shift)
    }

    /// A body's diagonal is about to be added to its parent's.
    #[inline(always)]
    fn hang(&mut self, body: usize, parent: usize, arm: &Vec3) {
        let Block(own) = &self.diagonal[body];
        let (angular, linear) = (own[0][0] + own[1][1] + own[2][2], own[3][3] + own[4][4] + own[5][5]);
        self.carried[parent].0 += linear;
        self.carried[parent].1 += angular + linear * arm.norm_squared();
    }

    /// Directions that move no mass; they do not move.
    #[must_use]
    pub fn inertialess(&self) -> usize {
        self.inertialess
    }
}

impl Elimination {
    /// Factors the system that the workspace holds.
    pub fn factor(&self, terms: &LinkTerms, w: &mut EliminationWorkspace) {
        for step in &self.steps {
            let (body, link) = (step.body, self.links[step.body]);
            let range = self.first[body]..self.first[body] + link.freedom;
            if step.with_parent.is_none() && step.neighbors.is_empty() && link.freedom <= 1 {
                self.factor_hinge(body, link, range.start, terms, w);
            } else {
                self.factor_step(step, link, range, terms, w);
            }
        }
    }

    /// At most one free direction and no neighbours: the bulk of all bodies.
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
        passed.carry_rows(arm);
        passed.carry_columns(arm);
        w.diagonal[parent].add(&passed);
        w.hang(body, parent, arm);
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
            let mut passed = own;
            passed.carry_rows(arm);
            passed.carry_columns(arm);
            if let Some(mut block) = with_parent {
                for k in 0..f {
                    w.g_parent[range.start + k] += block.transpose_times(&s[k]);
                }
                block.carry_rows(arm);
                passed.add(&block);
                passed.add_transposed(&block);
            }
            w.diagonal[parent].add(&passed);
            w.hang(step.body, parent, arm);
        }
        self.factor_neighbors(step, link, range, terms, w);
    }

    /// What the body's turn leaves between its parent and its neighbours.
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
        // Z = D⁻¹ G of the parent, then of each neighbour; products with those not yet visited.
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

    fn read(&self, place: Place, w: &EliminationWorkspace) -> Block {
        let block = &w.off[place.block];
        if place.transposed { block.transposed() } else { *block }
    }

    fn write(&self, place: Place, more: &Block, w: &mut EliminationWorkspace) {
        let block = &mut w.off[place.block];
        if place.transposed { block.add_transposed(more) } else { block.add(more) }
    }

    /// Solves with the factor. `bodies` holds the wrenches b and becomes the motions a, one a body; `coordinates` holds the
    /// efforts τ and becomes the joints' motions q. Without `offsets` the joints prescribe nothing (w = 0).
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
        let b = bodies[body];
        for k in range.clone() {
            coordinates[k] += terms.directions[k].dot(&b);
        }
        if link.freedom == 1 {
            coordinates[range.start] *= w.d[range.start][0];
        } else {
            solve_small(&w.d[range.clone()], &mut coordinates[range.clone()]);
        }
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

    /// Bᵀ x of the block between a body and its neighbour.
    fn times_transposed(&self, place: Place, x: &Six, w: &EliminationWorkspace) -> Six {
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
        if link.freedom == 1 {
            known[0] *= w.d[range.start][0];
        } else {
            solve_small(&w.d[range.clone()], known);
        }
        if offsets == Offsets::Prescribed {
            a += terms.offset[body];
        }
        for (k, value) in range.zip(known.iter()) {
            coordinates[k] -= value;
            a.axpy(coordinates[k], &terms.directions[k], 1.0);
        }
        bodies[body] = a;
    }
}

/// Whether what joints prescribe plays a part in a solve.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Offsets {
    /// It does.
    Prescribed,
    /// Only differences between two solutions are asked for.
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
