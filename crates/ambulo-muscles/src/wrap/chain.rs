//! The shortest path between two points over several surfaces.
//!
//! Between its neighbours, every arc is the closed form of its own surface. Putting the arcs one by one is a descent
//! that finds which surfaces are touched and in which order, but its error shrinks only by a constant factor each time.
//! When the order stays, Newton's method takes over. The unknowns are the ends p of every arc and q of the next one, on
//! both sides of each free part between two surfaces:
//!   p_j = T2_j(p_(j-1), q_j),   q_j = T1_(j+1)(p_j, q_(j+1)),
//! where T1 and T2 are the tangent points of the closed form, with derivatives in closed form too.
//!
//! A cylinder that may be passed on either side is passed on the side that is shorter between its neighbours. Where
//! that is not clear by far, all combinations of sides are tried, and the shortest path is taken.
//!
//! The search begins anew in every posture, so the path does not depend on earlier postures.
//!
//! Source: own derivation. Cost: about ten closed forms for two surfaces.
//! Not handled: a surface that the path would have to touch twice between the same two points.

use super::tangents::Derivatives;
use super::{Arc, Contact, Passage, PathNode, PathSurface};
use ambulo_body::numerics::DenseLu;
use ambulo_body::numerics::elementary::atan2;
use ambulo_body::spatial::{Mat3, Vec3};

/// Sweeps of closed forms and of Newton's method before the best path so far is taken.
const MOST_SWEEPS: usize = 40;
/// Steps of Newton's method between two sweeps.
const MOST_STEPS: usize = 8;
/// A move of all tangent points that counts as none [m].
const SETTLED_M: f64 = 1e-14;
/// A move after which the search has ended, if a sweep moves tangent points no more than this [m].
const ENDED_M: f64 = 1e-13;
/// Length that a path may still lose after a sweep that moved no tangent point by more than 1 m [m]: an end of an arc
/// changes the length by at most twice its move, and the moves shrink geometrically. Larger is safer and slower.
const MOST_GAIN: f64 = 32.0;
/// Turn around a cylinder above which the path on its other side is tried [rad]; half a turn is as far on both sides.
const DOUBTFUL_RAD: f64 = 2.0;
/// Cylinders whose sides are tried.
const MOST_DOUBTFUL: usize = 4;
/// A path must be this much shorter to be preferred [m].
const SHORTER_M: f64 = 1e-12;

/// An arc of the path, in world axes.
#[derive(Debug, Clone, Copy)]
struct Link {
    surface: usize,
    from: Vec3,
    to: Vec3,
    length: f64,
}

/// Memory of the search.
#[derive(Debug, Clone, Default)]
pub(super) struct Chain {
    links: Vec<Link>,
    /// The surfaces of the arcs before a sweep.
    order: Vec<usize>,
    contacts: Vec<Contact>,
    /// The sense of turning around each cylinder, where it is prescribed.
    senses: Vec<Option<f64>>,
    doubtful: Vec<usize>,
    best_links: Vec<Link>,
    best_contacts: Vec<Contact>,
    matrix: DenseLu,
    right: Vec<f64>,
}

impl Chain {
    /// Adds the arcs of the shortest path between two places over those surfaces that cover this part of the path.
    pub(super) fn find(
        &mut self,
        ends: [Vec3; 2],
        (part, surfaces): (usize, &[PathSurface]),
        contacts: &mut [Contact],
        nodes: &mut Vec<PathNode>,
    ) {
        self.senses.clear();
        self.senses.resize(surfaces.len(), None);
        self.solve(ends, part, surfaces, (usize::MAX, f64::INFINITY));
        self.try_other_sides(ends, part, surfaces);
        contacts.iter_mut().zip(&self.contacts).for_each(|(kept, found)| super::note(kept, *found));
        for link in &self.links {
            contacts[link.surface] = Contact::Touching;
            let body = surfaces[link.surface].body;
            let node = |place, arc| PathNode { body, place, acts_at: place, arc, surface: Some(link.surface) };
            nodes.extend([node(link.from, Some(link.length)), node(link.to, None)]);
        }
    }

    /// The shortest path with the prescribed senses; the search ends early where it cannot become better than a path
    /// with the merit `least`.
    fn solve(&mut self, ends: [Vec3; 2], part: usize, surfaces: &[PathSurface], least: (usize, f64)) {
        self.links.clear();
        for _ in 0..MOST_SWEEPS {
            self.contacts.clear();
            self.contacts.resize(surfaces.len(), Contact::Free);
            let (changed, moved) = self.sweep(ends, part, surfaces);
            let (passed_over, length) = self.merit(ends);
            let is_worse = passed_over >= least.0 && length - least.1 > MOST_GAIN * moved;
            if !changed && (moved <= ENDED_M || is_worse) {
                return;
            }
            if !changed {
                self.newton(ends, surfaces);
            }
        }
    }

    /// Tries all combinations of sides of the touched cylinders whose side is in doubt, and keeps the shortest path. A
    /// cylinder that is not touched does not lengthen the path on its present side.
    fn try_other_sides(&mut self, ends: [Vec3; 2], part: usize, surfaces: &[PathSurface]) {
        self.doubtful.clear();
        for at in 0..self.links.len() {
            let index = self.links[at].surface;
            let [from, to] = self.around(ends, at).map(|place| surfaces[index].inside(place));
            let turn = atan2(from.x * to.y - from.y * to.x, from.x * to.x + from.y * to.y);
            if surfaces[index].has_two_sides() && turn.abs() > DOUBTFUL_RAD {
                self.doubtful.push(index);
            }
        }
        if self.doubtful.is_empty() {
            return;
        }
        self.doubtful.truncate(MOST_DOUBTFUL);
        let mut least = self.merit(ends);
        self.best_links.clone_from(&self.links);
        self.best_contacts.clone_from(&self.contacts);
        for sides in 0..1_usize << self.doubtful.len() {
            for (bit, index) in self.doubtful.iter().enumerate() {
                self.senses[*index] = Some(if sides >> bit & 1 == 0 { 1.0 } else { -1.0 });
            }
            self.solve(ends, part, surfaces, least);
            let merit = self.merit(ends);
            if merit.0 < least.0 || merit.0 == least.0 && merit.1 < least.1 - SHORTER_M {
                least = merit;
                self.best_links.clone_from(&self.links);
                self.best_contacts.clone_from(&self.contacts);
            }
        }
        std::mem::swap(&mut self.links, &mut self.best_links);
        std::mem::swap(&mut self.contacts, &mut self.best_contacts);
    }

    /// Number of surfaces that are passed over, and length between both ends [m]: less is better.
    fn merit(&self, ends: [Vec3; 2]) -> (usize, f64) {
        let mut from = ends[0];
        let mut length = 0.0;
        for link in &self.links {
            length += (link.from - from).norm() + link.length;
            from = link.to;
        }
        let passed_over = self.contacts.iter().filter(|contact| **contact != Contact::Free).count();
        (passed_over, length + (ends[1] - from).norm())
    }

    /// Puts every surface's arc anew; returns whether surfaces or their order changed, and the largest move [m].
    fn sweep(&mut self, ends: [Vec3; 2], part: usize, surfaces: &[PathSurface]) -> (bool, f64) {
        let mut moved = 0.0_f64;
        self.order.clear();
        self.order.extend(self.links.iter().map(|link| link.surface));
        for (index, surface) in surfaces.iter().enumerate().filter(|(_, surface)| surface.covers(part)) {
            let old = self.links.iter().position(|link| link.surface == index).map(|at| self.links.remove(at));
            let mut contact = Contact::Free;
            let new = self.best(ends, index, surface, &mut contact);
            self.contacts[index] = contact;
            if let (Some(old), Some((_, new))) = (old, new) {
                moved = moved.max((old.from - new.from).norm()).max((old.to - new.to).norm());
            }
            if let Some((at, link)) = new {
                self.links.insert(at, link);
            }
        }
        // Within a sweep two arcs may change places and change them back.
        (!self.order.iter().copied().eq(self.links.iter().map(|link| link.surface)), moved)
    }

    /// The arc on a surface and its place among the other arcs: in the straight part that runs deepest through the
    /// surface, or passes it most closely.
    fn best(
        &self,
        ends: [Vec3; 2],
        index: usize,
        surface: &PathSurface,
        contact: &mut Contact,
    ) -> Option<(usize, Link)> {
        let mut deepest: Option<(f64, usize)> = None;
        for at in 0..=self.links.len() {
            match surface.depth(self.neighbours(ends, at)) {
                None => *contact = Contact::EndInside,
                Some(depth) if deepest.is_none_or(|(most, _)| depth > most) => deepest = Some((depth, at)),
                Some(_) => {}
            }
        }
        let (_, at) = deepest?;
        match surface.shortest_in_sense(self.neighbours(ends, at), self.senses[index]) {
            Passage::Straight(found) => {
                super::note(contact, found);
                None
            }
            Passage::Over(arc) => Some((at, surface.link(index, &arc))),
        }
    }

    /// The places between which an arc put in at this position of the chain would lie.
    fn neighbours(&self, ends: [Vec3; 2], at: usize) -> [Vec3; 2] {
        let from = at.checked_sub(1).and_then(|before| self.links.get(before)).map_or(ends[0], |link| link.to);
        [from, self.links.get(at).map_or(ends[1], |link| link.from)]
    }

    /// The places between which the arc at this position lies.
    fn around(&self, ends: [Vec3; 2], at: usize) -> [Vec3; 2] {
        [self.neighbours(ends, at)[0], self.neighbours(ends, at + 1)[1]]
    }

    /// Newton's method on the tangent points while surfaces and order stay.
    fn newton(&mut self, ends: [Vec3; 2], surfaces: &[PathSurface]) {
        let gaps = self.links.len().saturating_sub(1);
        for _ in 0..MOST_STEPS {
            if gaps == 0 || !self.equations(ends, surfaces) || !self.matrix.factor() {
                return;
            }
            self.matrix.solve(&mut self.right);
            if !self.right.iter().all(|step| step.is_finite()) {
                return;
            }
            let mut moved = 0.0_f64;
            for gap in 0..gaps {
                let step = |at: usize| Vec3::from_column_slice(&self.right[at..at + 3]);
                let [p, q] = [step(6 * gap), step(6 * gap + 3)];
                self.links[gap].to += p;
                self.links[gap + 1].from += q;
                moved = moved.max(p.norm()).max(q.norm());
            }
            if moved <= SETTLED_M {
                return;
            }
        }
    }

    /// Fills the linear equations of a step; returns whether every surface is still touched.
    fn equations(&mut self, ends: [Vec3; 2], surfaces: &[PathSurface]) -> bool {
        let size = 6 * (self.links.len() - 1);
        self.matrix.clear(size);
        self.right.clear();
        self.right.resize(size, 0.0);
        (0..size).for_each(|k| self.matrix.row_mut(k)[k] = 1.0);
        for at in 0..self.links.len() {
            let link = self.links[at];
            let neighbours = self.around(ends, at);
            let Some((arc, slopes)) = surfaces[link.surface].tangents(neighbours, self.senses[link.surface]) else {
                return false;
            };
            // Rows of q before this arc and of p after it; columns of p before and of q after.
            let before = at.checked_sub(1).map(|gap| 6 * gap);
            let after = (at + 1 < self.links.len()).then_some(6 * at);
            if let Some(before) = before {
                self.put(before + 3, arc.from - link.from);
                self.subtract(before + 3, before, &slopes.first[0]);
                if let Some(after) = after {
                    self.subtract(before + 3, after + 3, &slopes.first[1]);
                }
            }
            if let Some(after) = after {
                self.put(after, arc.to - link.to);
                self.subtract(after, after + 3, &slopes.last[1]);
                if let Some(before) = before {
                    self.subtract(after, before, &slopes.last[0]);
                }
            }
        }
        true
    }

    fn put(&mut self, row: usize, value: Vec3) {
        self.right[row..row + 3].copy_from_slice(value.as_slice());
    }

    fn subtract(&mut self, row: usize, column: usize, block: &Mat3) {
        for k in 0..3 {
            (0..3).for_each(|m| self.matrix.row_mut(row + k)[column + m] -= block[(k, m)]);
        }
    }
}

impl PathSurface {
    fn link(&self, surface: usize, arc: &Arc) -> Link {
        Link { surface, from: self.pose.place(arc.from), to: self.pose.place(arc.to), length: arc.length }
    }

    /// Tangent points in the world and their derivatives by both neighbours; `None` where the path is straight.
    fn tangents(&self, neighbours: [Vec3; 2], sense: Option<f64>) -> Option<(Arc, Derivatives)> {
        let Passage::Over(arc) = self.shortest_in_sense(neighbours, sense) else { return None };
        let slopes = Derivatives::of(self.shape, neighbours.map(|place| self.inside(place)), &arc)?;
        let turned = |block: &Mat3| self.pose.rotation * block * self.pose.rotation.transpose();
        let slopes = Derivatives { first: slopes.first.map(|b| turned(&b)), last: slopes.last.map(|b| turned(&b)) };
        Some((Arc { from: self.pose.place(arc.from), to: self.pose.place(arc.to), ..arc }, slopes))
    }
}
