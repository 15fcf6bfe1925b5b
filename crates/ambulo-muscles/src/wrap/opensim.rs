//! The paths of OpenSim 4.6 over several surfaces.
//!
//! OpenSim treats its wraps one after the other. Each is taken out of the path and put back into one straight part: the
//! first one that runs through its surface, else the part that becomes least longer. With several wraps the sweep is
//! repeated until the length changes by less than 0.5 mm, at most 8 times. So the path is not the shortest, and
//! its moment arms are not the derivatives of its length.
//!
//! A fault adds to that. OpenSim keeps the place in the world at which a tangent point was first asked for, and does
//! not renew it when a later sweep moves the point. Straight parts, their lengths and their directions therefore belong
//! to the first sweep; the arcs and the places at which the forces act belong to the last. In walking with Rajagopal's
//! model this makes `gaslat` up to 6.9 mm shorter than the shortest path, and its forces are not in balance.
//!
//! Source: opensim-org/opensim-core, `GeometryPath::applyWrapObjects`, `calcPathLengthChange` and
//! `addInEquivalentForces` (OpenSim/Simulation/Model/GeometryPath.cpp, read at 025239c4 and 42039bea),
//! `Point::getLocationInGround` (Point.cpp, 32120f2c), `PathWrapPoint::setLocation` (PathWrapPoint.cpp, 123e4a09);
//! rules restated, and compared with results of OpenSim 4.6.
//! Not handled: a wrap of whose range all points are switched off; OpenSim then leaves out all later wraps too.
//! Pinned by: tests/wrap_models.rs.

use super::opensim_cylinder::{self, Verdict};
use super::{Contact, Passage, PathAnchor, PathNode, PathSurface};
use crate::set::WrapShape;
use ambulo_body::spatial::Vec3;

/// Sweeps over several wraps.
const MOST_SWEEPS: usize = 8;
/// A change of length that ends the sweeps [m].
const SETTLED_M: f64 = 0.0005;

/// The places at which both ends of each surface's arc were first asked for [m].
pub(super) type FirstPlaces = Vec<[Option<Vec3>; 2]>;

/// The surfaces of a path and what OpenSim remembers of them.
pub(super) struct Search<'a> {
    pub(super) surfaces: &'a [PathSurface],
    pub(super) first_places: &'a mut FirstPlaces,
}

impl Search<'_> {
    /// Adds the nodes of the path through these anchors.
    pub(super) fn find(mut self, anchors: &[PathAnchor], contacts: &mut [Contact], nodes: &mut Vec<PathNode>) {
        nodes.extend(anchors.iter().map(PathAnchor::node));
        self.first_places.clear();
        self.first_places.resize(self.surfaces.len(), [None; 2]);
        let sweeps = if self.is_several() { MOST_SWEEPS } else { 1 };
        let mut last_length = f64::INFINITY;
        let mut exchanged = false;
        for sweep in 0..sweeps {
            let mut verdicts = [Verdict::Straight; 2];
            for turn in 0..self.surfaces.len() {
                // Places in the order of the first sweep; later the first two may be exchanged.
                let index = if exchanged && turn < 2 { 1 - turn } else { turn };
                let verdict = self.put(nodes, index, &mut contacts[index]);
                if turn < 2 {
                    verdicts[turn] = verdict;
                }
            }
            let length = self.length(nodes);
            if (length - last_length).abs() < SETTLED_M {
                break;
            }
            last_length = length;
            if sweep == 0 && verdicts == [Verdict::Straight, Verdict::Inside] {
                exchanged = true;
                remove(nodes, 0);
            }
        }
        for node in nodes {
            node.place = self.first_place(node);
        }
    }

    fn is_several(&self) -> bool {
        self.surfaces.len() > 1
    }

    /// The place of a node where it was first asked for.
    fn first_place(&mut self, node: &PathNode) -> Vec3 {
        let Some(surface) = node.surface else { return node.place };
        *self.first_places[surface][usize::from(node.arc.is_none())].get_or_insert(node.place)
    }

    /// The length that OpenSim states.
    fn length(&mut self, nodes: &[PathNode]) -> f64 {
        let part = |part: &[PathNode]| match part[0].arc {
            Some(arc) => arc,
            None => {
                let from = self.first_place(&part[0]);
                (self.first_place(&part[1]) - from).norm()
            }
        };
        nodes.windows(2).map(part).sum()
    }

    /// Takes a surface out of the path and puts it back; returns the last verdict.
    fn put(&mut self, nodes: &mut Vec<PathNode>, index: usize, contact: &mut Contact) -> Verdict {
        remove(nodes, index);
        *contact = Contact::Free;
        let surface = &self.surfaces[index];
        let (mut last, mut best, mut least) = (Verdict::Straight, None, f64::INFINITY);
        let anchor = |wanted: usize| {
            let mut anchors = nodes.iter().enumerate().filter(|(_, node)| node.surface.is_none());
            anchors.nth(wanted).filter(|_| surface.active)
        };
        let (Some((first, _)), Some((end, _))) = (anchor(surface.first), anchor(surface.last)) else { return last };
        for at in first..end {
            let [from, to] = [nodes[at], nodes[at + 1]];
            if from.arc.is_some() {
                continue;
            }
            last = verdict(surface, [&from, &to], self.is_several());
            match last {
                Verdict::Straight => {}
                Verdict::Inside => *contact = Contact::EndInside,
                Verdict::Mandatory(arc) => {
                    best = Some((at, arc));
                    break;
                }
                Verdict::Possible(arc) => {
                    let longer = self.longer([&from, &to], &surface.nodes(index, &arc), arc.length);
                    if longer < least {
                        (best, least) = (Some((at, arc)), longer);
                    }
                }
            }
        }
        if let Some((at, arc)) = best {
            *contact = Contact::Touching;
            let [begin, end] = surface.nodes(index, &arc);
            nodes.insert(at + 1, begin);
            nodes.insert(at + 2, end);
        }
        last
    }

    /// How much longer a straight part becomes by an arc.
    fn longer(&mut self, ends: [&PathNode; 2], arc: &[PathNode; 2], length: f64) -> f64 {
        let [from, to] = ends.map(|node| self.first_place(node));
        (arc[0].place - from).norm() + length + (to - arc[1].place).norm() - (to - from).norm()
    }
}

/// Takes the arc on a surface out of the path.
fn remove(nodes: &mut Vec<PathNode>, index: usize) {
    nodes.retain(|node| node.surface != Some(index));
}

fn verdict(surface: &PathSurface, ends: [&PathNode; 2], several: bool) -> Verdict {
    let ends = ends.map(|node| surface.inside(node.place));
    match surface.shape {
        WrapShape::Cylinder { radius, length } => {
            opensim_cylinder::verdict(ends, [radius, length], surface.quadrant, several)
        }
        // OpenSim's sphere is exact.
        WrapShape::Sphere { radius } => match super::sphere::shortest(ends, radius, surface.quadrant) {
            Passage::Straight(Contact::EndInside) => Verdict::Inside,
            Passage::Straight(_) => Verdict::Straight,
            Passage::Over(arc) => match surface.quadrant {
                Some(side) if ends.iter().any(|end| side.holds(end)) => Verdict::Mandatory(arc),
                _ => Verdict::Possible(arc),
            },
        },
    }
}
