//! Symbolic part of the elimination: in which order bodies are eliminated, and which blocks that takes.
//!
//! On a forest, each body comes after its children, and no block appears that was not there. With couplings between
//! bodies that are no parent and child, the next body is the one with the fewest neighbours among those whose children
//! are eliminated; its neighbours then become neighbours of each other and of its parent. The numeric part is
//! `elimination`.
//!
//! Source: minimum degree (unverified).
//! Pinned by: tests/elimination.rs

use super::block::Six;
use crate::spatial::Vec3;
use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::ops::Range;

/// Parent and freedom of a body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Link {
    /// The parent body; `None` is ground.
    pub parent: Option<usize>,
    /// Number of free directions of the joint, at most six.
    pub freedom: usize,
}

/// Why links or couplings are rejected.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum LinkError {
    /// A parent that does not exist.
    #[error("body {body} has body {parent} as parent; expected a number below {bodies}")]
    NoBody {
        /// The body.
        body: usize,
        /// The given parent.
        parent: usize,
        /// Number of bodies.
        bodies: usize,
    },
    /// Links that form a loop.
    #[error("body {body} is its own ancestor; expected trees. hint: close loops with constraint rows")]
    Circle {
        /// A body of the loop.
        body: usize,
    },
    /// More than six free directions.
    #[error("body {body} has {freedom} free directions; expected at most 6")]
    Freedom {
        /// The body.
        body: usize,
        /// Given number.
        freedom: usize,
    },
    /// A coupling of a body with itself or with one that does not exist.
    #[error("bodies {first} and {second} cannot be coupled; expected two different bodies below {bodies}")]
    Coupling {
        /// The first body.
        first: usize,
        /// The second body.
        second: usize,
        /// Number of bodies.
        bodies: usize,
    },
}

/// Geometry of all joints at one instant.
#[derive(Debug, Clone, Default)]
pub struct LinkTerms {
    /// Vector from the parent's mass centre to the body's [m]; one per body, unused on ground.
    pub arm: Vec<Vec3>,
    /// Free directions at the body's mass centre, world axes; one per coordinate.
    pub directions: Vec<Six>,
    /// Prescribed part w of the body's motion relative to its parent; one per body.
    pub offset: Vec<Six>,
}

/// The order in which bodies are eliminated and the blocks needed. Depends on parents and couplings only, so it is made
/// once for many instants.
#[derive(Debug, Clone)]
pub struct Elimination {
    pub(super) links: Vec<Link>,
    /// First coordinate of each body, then the number of coordinates.
    pub(super) first: Vec<usize>,
    pub(super) steps: Vec<Step>,
    pub(super) neighbors: Vec<Neighbor>,
    pub(super) pairs: Vec<BlockRef>,
    /// Bodies of each off-diagonal block, the lower number first; given couplings come first, each once.
    pub(super) couplings: Vec<(usize, usize)>,
}

/// Elimination of one body.
#[derive(Debug, Clone)]
pub(super) struct Step {
    pub(super) body: usize,
    /// Block between the body and its parent.
    pub(super) with_parent: Option<BlockRef>,
    pub(super) neighbors: Range<usize>,
    /// Blocks of pairs of neighbours: (0,1), (0,2) .. (1,2) ..
    pub(super) pairs: Range<usize>,
}

/// A body coupled with the eliminated one.
#[derive(Debug, Clone, Copy)]
pub(super) struct Neighbor {
    pub(super) body: usize,
    pub(super) place: BlockRef,
    /// Block between the parent and this neighbour; unused on ground.
    pub(super) with_parent: BlockRef,
}

/// A block, used as it is or transposed.
#[derive(Debug, Clone, Copy)]
pub(super) struct BlockRef {
    pub(super) block: usize,
    pub(super) transposed: bool,
}

impl Elimination {
    /// Determines the order for these links. `couplings` are the pairs of bodies with off-diagonal blocks.
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
    #[inline]
    #[must_use]
    pub fn bodies(&self) -> usize {
        self.links.len()
    }

    /// Number of coordinates: free directions of all joints.
    #[inline]
    #[must_use]
    pub fn coordinates(&self) -> usize {
        self.first[self.links.len()]
    }

    /// The coordinates of a body's joint.
    #[inline]
    #[must_use]
    pub fn coordinates_of(&self, body: usize) -> Range<usize> {
        self.first[body]..self.first[body + 1]
    }

    /// Number of off-diagonal blocks, fill-in included.
    #[inline]
    #[must_use]
    pub fn blocks(&self) -> usize {
        self.couplings.len()
    }

    /// Takes the body with the fewest neighbours first, among those whose children are eliminated; of equals the
    /// outermost.
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

    /// Eliminates one body: its neighbours become neighbours of each other and of its parent. Returns the neighbours.
    fn eliminate(&mut self, body: usize, adjacent: &mut [Vec<(usize, usize)>]) -> Vec<usize> {
        let parent = self.links[body].parent;
        let list = std::mem::take(&mut adjacent[body]);
        for (other, _) in &list {
            adjacent[*other].retain(|(b, _)| *b != body);
        }
        let place = |from: usize, to: usize, block: usize| BlockRef { block, transposed: from > to };
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
                // A joint without freedom couples no neighbours.
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

    /// The block between two bodies, created if missing; transposed if the first has the higher number.
    fn join(&mut self, adjacent: &mut [Vec<(usize, usize)>], one: usize, other: usize) -> BlockRef {
        let transposed = one > other;
        if let Some((_, block)) = adjacent[one].iter().find(|(b, _)| *b == other) {
            return BlockRef { block: *block, transposed };
        }
        let block = self.couplings.len();
        self.couplings.push((one.min(other), one.max(other)));
        adjacent[one].push((other, block));
        adjacent[other].push((one, block));
        BlockRef { block, transposed }
    }
}

impl Step {
    fn alone(body: usize) -> Step {
        Step { body, with_parent: None, neighbors: 0..0, pairs: 0..0 }
    }
}

/// The bodies of trees, each after its parent, level by level; bodies in a circle are missing.
#[must_use]
pub fn parents_first(parents: impl ExactSizeIterator<Item = Option<usize>>) -> Vec<usize> {
    let mut children = vec![Vec::new(); parents.len()];
    let mut order = Vec::with_capacity(parents.len());
    for (body, parent) in parents.enumerate() {
        match parent {
            Some(parent) => children[parent].push(body),
            None => order.push(body),
        }
    }
    let mut next = 0;
    while next < order.len() {
        order.extend_from_slice(&children[order[next]]);
        next += 1;
    }
    order
}

/// As [`parents_first`]; links that do not form trees are errors.
pub(super) fn outwards(links: &[Link]) -> Result<Vec<usize>, LinkError> {
    let bodies = links.len();
    for (body, link) in links.iter().enumerate() {
        if link.freedom > 6 {
            return Err(LinkError::Freedom { body, freedom: link.freedom });
        }
        if let Some(parent) = link.parent.filter(|parent| *parent >= bodies) {
            return Err(LinkError::NoBody { body, parent, bodies });
        }
    }
    let order = parents_first(links.iter().map(|link| link.parent));
    if order.len() == bodies {
        return Ok(order);
    }
    let mut reached = vec![false; bodies];
    order.iter().for_each(|body| reached[*body] = true);
    Err(LinkError::Circle { body: reached.iter().position(|r| !r).unwrap_or_default() })
}
