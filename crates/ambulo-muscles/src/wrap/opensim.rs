//! The paths of OpenSim 4.6 over several surfaces.
//!
//! OpenSim treats its wraps one after the other. Each is taken out of the path and put back into one straight part: the
//! first one that runs through its surface, else the part that becomes least longer. With several wraps the sweep is
//! repeated until the length changes by less than 0.5 mm, at most 8 times. So the path is not the shortest, and
//! its moment arms are not the derivatives of its length.
//!
//! Source: opensim-org/opensim-core, `GeometryPath::applyWrapObjects` (OpenSim/Simulation/Model/GeometryPath.cpp), read
//! at 025239c4; rules restated, and compared with results of OpenSim 4.6.
//! Not handled: a path of which a conditional point at a bound of a wrap's range is switched off together with all
//! others of that range; OpenSim then leaves out later wraps too.

use super::{Arc, Contact, Passage, PathAnchor, PathNode, PathSurface, opensim_cylinder};
use crate::set::WrapShape;

/// Sweeps over several wraps.
const MOST_SWEEPS: usize = 8;
/// A change of length that ends the sweeps [m].
const SETTLED_M: f64 = 0.0005;

/// What OpenSim finds for one straight part and one surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Verdict {
    /// The part stays straight.
    Straight,
    /// An end lies inside.
    Inside,
    /// The part could run over the surface.
    Possible(Arc),
    /// The straight part would run through the surface.
    Mandatory(Arc),
}

/// Adds the nodes of the path through these anchors.
pub(super) fn find(
    anchors: &[PathAnchor],
    surfaces: &[PathSurface],
    contacts: &mut [Contact],
    nodes: &mut Vec<PathNode>,
) {
    nodes.extend(anchors.iter().map(PathAnchor::node));
    let several = surfaces.len() > 1;
    let mut last_length = f64::INFINITY;
    let mut exchanged = false;
    for sweep in 0..if several { MOST_SWEEPS } else { 1 } {
        let mut verdicts = [Verdict::Straight; 2];
        for turn in 0..surfaces.len() {
            // Positions in the order of the first sweep; later the first two may be exchanged.
            let index = if exchanged && turn < 2 { 1 - turn } else { turn };
            let verdict = put(nodes, index, &surfaces[index], several, &mut contacts[index]);
            if turn < 2 {
                verdicts[turn] = verdict;
            }
        }
        let length = super::length(nodes);
        if (length - last_length).abs() < SETTLED_M {
            return;
        }
        last_length = length;
        if sweep == 0 && verdicts == [Verdict::Straight, Verdict::Inside] {
            exchanged = true;
            remove(nodes, 0);
        }
    }
}

/// Takes a surface out of the path and puts it back; returns the last verdict.
fn put(
    nodes: &mut Vec<PathNode>,
    index: usize,
    surface: &PathSurface,
    several: bool,
    contact: &mut Contact,
) -> Verdict {
    remove(nodes, index);
    *contact = Contact::Free;
    let (mut last, mut best, mut least) = (Verdict::Straight, None, f64::INFINITY);
    if !surface.active || surface.first >= surface.last {
        return last;
    }
    let anchor = |wanted: usize| nodes.iter().enumerate().filter(|(_, node)| node.surface.is_none()).nth(wanted);
    let (Some((first, _)), Some((end, _))) = (anchor(surface.first), anchor(surface.last)) else { return last };
    for at in first..end {
        let [from, to] = [&nodes[at], &nodes[at + 1]];
        if from.arc.is_some() {
            continue;
        }
        last = verdict(surface, [from, to], several);
        match last {
            Verdict::Straight => {}
            Verdict::Inside => *contact = Contact::EndInside,
            Verdict::Mandatory(arc) => {
                best = Some((at, arc));
                break;
            }
            Verdict::Possible(arc) => {
                let [begin, end] = surface.nodes(index, &arc);
                let longer = (begin.place - from.place).norm() + arc.length + (to.place - end.place).norm()
                    - (to.place - from.place).norm();
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
