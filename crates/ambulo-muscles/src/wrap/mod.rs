//! Paths of muscles over surfaces: straight parts between points, and arcs on cylinders and spheres.
//!
//! length = sum of straight parts + sum of arcs. A muscle slides on a surface without friction, so its path is the
//! shortest one outside the surface, it leaves the surface along a tangent, and its tension pulls on the bodies at the
//! ends of every straight part, along that part. Then moment arms are -dL/dq without any derivative of the tangent
//! points.
//!
//! | part of the module | duty |
//! |---|---|
//! | `cylinder`, `sphere` | the shortest path between two points over one surface, in closed form |
//! | `chain` | the shortest path over several surfaces between two points |
//! | `opensim` | the paths of OpenSim, with its approximations, for comparison |
//!
//! One-sided surfaces (a [`Quadrant`]): a path passes a cylinder on the permitted side only. What decides is the
//! half-plane that starts at the axis and points away from the permitted side: no path crosses it, however far from
//! the surface. A path may therefore run further than half a turn around the cylinder, as a muscle that is wound up
//! does, and it changes suddenly only when one of its points crosses that half-plane. A sphere has no axis, so there
//! the path takes the nearer way round if its middle is on the permitted side, else the other way.
//!
//! A surface is passed over where it cannot be obeyed, and [`Contact`] says so: a point of the path lies inside it, or
//! both tangent points lie beyond the same end of a cylinder.
//!
//! Not handled: ellipsoids and tori.
//! Pinned by: tests/wrap_closed_forms.rs, tests/wrap_chain.rs, tests/wrap_opensim.rs, tests/wrap_models.rs.

mod chain;
mod cylinder;
mod opensim;
mod opensim_cylinder;
mod sphere;
mod tangents;

use crate::set::{Quadrant, WrapShape};
use ambulo_body::model::BodyId;
use ambulo_body::spatial::{Pose, Vec3};
use serde::Deserialize;

/// How paths run over surfaces.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum WrapRule {
    /// The shortest path, exactly.
    #[default]
    Exact,
    /// As OpenSim 4.6 computes it, with its approximations.
    OpenSim,
}

impl WrapRule {
    /// The rules with their names.
    pub const ALL: [(&'static str, WrapRule); 2] = [("exact", WrapRule::Exact), ("opensim", WrapRule::OpenSim)];
}

/// A point through which a path runs, in one posture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PathAnchor {
    /// The body that holds it; `None` is ground.
    pub body: Option<BodyId>,
    /// Where it is in the world [m].
    pub place: Vec3,
}

/// A surface over which a path may run, in one posture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PathSurface {
    /// The body that holds it; `None` is ground.
    pub body: Option<BodyId>,
    /// `world_from_surface`.
    pub pose: Pose,
    /// Its shape.
    pub shape: WrapShape,
    /// The permitted side; `None` is any side.
    pub quadrant: Option<Quadrant>,
    /// Whether paths wrap over it at all.
    pub active: bool,
    /// First anchor of the part of the path that may touch it, counted from 0 among the anchors given.
    pub first: usize,
    /// Last anchor of that part. No larger than `first`: the path does not touch it.
    pub last: usize,
}

/// A point of a finished path: an anchor, or one end of an arc on a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PathNode {
    /// The body on which the path pulls here; `None` is ground.
    pub body: Option<BodyId>,
    /// Where the straight parts of the path end, in the world [m].
    pub place: Vec3,
    /// Where the path pulls on the body, in the world [m]: the same place, except in paths of OpenSim over several
    /// surfaces.
    pub acts_at: Vec3,
    /// Length of the arc from here to the next node [m]; `None` if the path is straight there, or ends here.
    pub arc: Option<f64>,
    /// Index of the surface whose arc begins or ends here; `None` is an anchor.
    pub surface: Option<usize>,
}

/// What a path has to do with a surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Contact {
    /// The surface is not in the way, or it is switched off.
    #[default]
    Free,
    /// The path runs over it.
    Touching,
    /// Passed over: a point of the path, or an end of an arc on another surface, lies inside.
    EndInside,
    /// Passed over: the path would touch only the cylinder's continuation beyond an end.
    BeyondEnds,
}

/// The nodes of a path, what its surfaces do, and memory to find them without allocation.
#[derive(Debug, Clone, Default)]
pub struct PathRoute {
    nodes: Vec<PathNode>,
    contacts: Vec<Contact>,
    chain: chain::Chain,
    first_places: opensim::FirstPlaces,
}

impl PathRoute {
    /// Finds the path through these anchors, in this order, over these surfaces.
    ///
    /// The result depends on the arguments alone, not on earlier calls. Nothing is allocated once the largest path was
    /// found.
    pub fn find(&mut self, rule: WrapRule, anchors: &[PathAnchor], surfaces: &[PathSurface]) {
        self.nodes.clear();
        self.contacts.clear();
        self.contacts.resize(surfaces.len(), Contact::Free);
        if rule == WrapRule::OpenSim {
            let search = opensim::Search { surfaces, first_places: &mut self.first_places };
            return search.find(anchors, &mut self.contacts, &mut self.nodes);
        }
        for (k, anchor) in anchors.iter().enumerate() {
            self.nodes.push(anchor.node());
            let Some(next) = anchors.get(k + 1) else { break };
            let mut covering = surfaces.iter().enumerate().filter(|(_, surface)| surface.covers(k));
            let ends = [anchor.place, next.place];
            match (covering.next(), covering.next()) {
                (None, _) => {}
                (Some((index, surface)), None) => self.wrap_once(ends, index, surface),
                (Some(_), Some(_)) => self.chain.find(ends, (k, surfaces), &mut self.contacts, &mut self.nodes),
            }
        }
    }

    /// The nodes from origin to insertion.
    #[must_use]
    pub fn nodes(&self) -> &[PathNode] {
        &self.nodes
    }

    /// What the path has to do with each surface, in the order given.
    #[must_use]
    pub fn contacts(&self) -> &[Contact] {
        &self.contacts
    }

    /// Length of the path [m].
    #[must_use]
    pub fn length(&self) -> f64 {
        length(&self.nodes)
    }

    /// Adds the arc over a single surface between two places.
    fn wrap_once(&mut self, [from, to]: [Vec3; 2], index: usize, surface: &PathSurface) {
        match surface.shortest(from, to) {
            Passage::Straight(contact) => note(&mut self.contacts[index], contact),
            Passage::Over(arc) => {
                self.contacts[index] = Contact::Touching;
                self.nodes.extend(surface.nodes(index, &arc));
            }
        }
    }
}

impl PathAnchor {
    fn node(&self) -> PathNode {
        PathNode { body: self.body, place: self.place, acts_at: self.place, arc: None, surface: None }
    }
}

impl PathSurface {
    /// Whether the part of the path after this anchor may touch the surface.
    fn covers(&self, anchor: usize) -> bool {
        self.active && self.first <= anchor && anchor < self.last
    }

    /// The shortest way from one place in the world to another over this surface alone.
    fn shortest(&self, from: Vec3, to: Vec3) -> Passage {
        let ends = [self.inside(from), self.inside(to)];
        match self.shape {
            WrapShape::Cylinder { radius, length } => cylinder::shortest(ends, [radius, length], self.quadrant),
            WrapShape::Sphere { radius } => sphere::shortest(ends, radius, self.quadrant),
        }
    }

    /// The shortest way in this sense of turning, which only a cylinder has.
    fn shortest_in_sense(&self, [from, to]: [Vec3; 2], sense: Option<f64>) -> Passage {
        match (self.shape, sense) {
            (WrapShape::Cylinder { radius, length }, Some(sense)) => {
                cylinder::shortest_in_sense([self.inside(from), self.inside(to)], [radius, length], sense)
            }
            _ => self.shortest(from, to),
        }
    }

    /// How far a straight part runs into the surface, negative if it passes it [m]; `None` if an end lies inside.
    fn depth(&self, ends: [Vec3; 2]) -> Option<f64> {
        let ends = ends.map(|place| self.inside(place));
        match self.shape {
            WrapShape::Cylinder { radius, .. } => cylinder::depth(ends, radius),
            WrapShape::Sphere { radius } => depth(ends, radius),
        }
    }

    /// Whether the path may pass on either side.
    fn has_two_sides(&self) -> bool {
        self.quadrant.is_none() && matches!(self.shape, WrapShape::Cylinder { .. })
    }

    /// A place of the world in the axes of the surface.
    fn inside(&self, place: Vec3) -> Vec3 {
        self.pose.rotation.tr_mul(&(place - self.pose.translation))
    }

    /// Both ends of an arc as nodes.
    fn nodes(&self, index: usize, arc: &Arc) -> [PathNode; 2] {
        let node = |place, arc| {
            let place = self.pose.place(place);
            PathNode { body: self.body, place, acts_at: place, arc, surface: Some(index) }
        };
        [node(arc.from, Some(arc.length)), node(arc.to, None)]
    }
}

/// How far the straight line runs into a sphere around the origin, negative if it passes it [m]; `None` with an end
/// inside.
fn depth([a, b]: [Vec3; 2], radius: f64) -> Option<f64> {
    let line = b - a;
    let square = line.norm_squared();
    let share = if square > 0.0 { (-a.dot(&line) / square).clamp(0.0, 1.0) } else { 0.0 };
    let is_outside = a.norm_squared().min(b.norm_squared()) >= radius * radius;
    is_outside.then(|| radius - (a + line * share).norm())
}

/// Length of a path [m].
fn length(nodes: &[PathNode]) -> f64 {
    nodes.windows(2).map(|part| part[0].arc.unwrap_or_else(|| (part[1].place - part[0].place).norm())).sum()
}

impl Quadrant {
    /// Whether a place in the axes of the surface is on the permitted side, its border included.
    fn holds(self, place: &Vec3) -> bool {
        (place[self.axis.min(2)] >= 0.0) == self.positive
    }
}

/// Keeps the stronger statement when a surface covers several parts of a path.
fn note(kept: &mut Contact, new: Contact) {
    if *kept == Contact::Free {
        *kept = new;
    }
}

/// A part of a path on a surface, in the axes of the surface.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Arc {
    /// Where it begins [m].
    from: Vec3,
    /// Where it ends [m].
    to: Vec3,
    /// Its length [m].
    length: f64,
    /// The angle around the axis of a cylinder, or around the centre of a sphere [rad].
    angle: f64,
    /// 1 or -1. Cylinder: turning about z positively or not. Sphere: the nearer or the other way round.
    sense: f64,
}

/// How a path passes a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Passage {
    /// Along the straight line.
    Straight(Contact),
    /// Over it.
    Over(Arc),
}
