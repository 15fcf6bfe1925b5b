//! What is the same for the path of a muscle in every posture.

use crate::set::{MusclePath, MuscleSet, PathWrap, PointPlace, RANGE_MARGIN};
use crate::wrap::WrapRule;
use ambulo_body::model::{BodyId, CoordinateId, Drive, Function, Model};
use ambulo_body::spatial::{Pose, Vec3};
use std::collections::{BTreeMap, BTreeSet};

/// The path of a muscle, prepared.
#[derive(Debug, Clone)]
pub(super) struct PathPlan {
    pub(super) points: Vec<PathPlanPoint>,
    pub(super) moving: Vec<MovingPoint>,
    pub(super) wraps: Vec<PlannedWrap>,
    /// Bodies of the path and those between them, parents first; the first one carries all others.
    pub(super) slots: Vec<Slot>,
    /// Coordinates about which the muscle may have a moment arm, rising; none follows another.
    pub(super) coordinates: Vec<CoordinateId>,
    /// Coordinates that move points, one for each component of a moving point.
    pub(super) gears: Vec<usize>,
    /// Of each gear: its coordinate, and the index of its arm.
    pub(super) gear_arms: Vec<(usize, usize)>,
    /// Where the muscle begins in the arrays of all muscles.
    pub(super) first_arm: usize,
    pub(super) first_slot: usize,
    pub(super) first_gear: usize,
}

/// Sizes of the arrays of all muscles.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Counts {
    pub(super) arms: usize,
    pub(super) slots: usize,
    pub(super) gears: usize,
}

/// A point of the path.
#[derive(Debug, Clone)]
pub(super) struct PathPlanPoint {
    pub(super) body: Option<usize>,
    pub(super) slot: usize,
    pub(super) place: Place,
}

/// Where a point is on its body [m].
#[derive(Debug, Clone)]
pub(super) enum Place {
    Fixed(Vec3),
    Conditional { place: Vec3, coordinate: usize, range: [f64; 2] },
    Moving { frame: Pose, axes: Box<[MovingAxis; 3]> },
}

/// A component of the place of a moving point.
#[derive(Debug, Clone)]
pub(super) struct MovingAxis {
    /// The coordinate with the range in which it counts.
    coordinate: Option<(usize, [f64; 2])>,
    function: Function,
}

/// A moving point, with the gear of each component.
#[derive(Debug, Clone)]
pub(super) struct MovingPoint {
    pub(super) index: usize,
    pub(super) gears: [Option<usize>; 3],
}

/// A surface of the path.
#[derive(Debug, Clone)]
pub(super) struct PlannedWrap {
    pub(super) object: usize,
    pub(super) slot: usize,
    /// First and last point of the path between which it counts.
    pub(super) first: usize,
    pub(super) last: usize,
}

/// A body of the path, or one between them.
#[derive(Debug, Clone)]
pub(super) struct Slot {
    /// `None` is ground.
    pub(super) body: Option<usize>,
    /// The slot of the parent; `None` for the first slot.
    pub(super) parent: Option<usize>,
    /// Index of the arm of each coordinate of the joint.
    pub(super) arms: Vec<usize>,
}

impl Place {
    /// The place on the body [m]; `None` if the point is not part of the path.
    pub(super) fn at(&self, q: &[f64]) -> Option<Vec3> {
        match self {
            Place::Fixed(place) => Some(*place),
            Place::Conditional { place, coordinate, range: [least, greatest] } => {
                let value = q[*coordinate];
                (value >= least - RANGE_MARGIN && value <= greatest + RANGE_MARGIN).then_some(*place)
            }
            Place::Moving { frame, axes } => {
                let [x, y, z] = axes.each_ref().map(|axis| axis.at(q)[0]);
                Some(frame.place(Vec3::new(x, y, z)))
            }
        }
    }
}

impl MovingAxis {
    /// The component [m] and its derivative by the coordinate.
    pub(super) fn at(&self, q: &[f64]) -> [f64; 2] {
        let Some((coordinate, [least, greatest])) = self.coordinate else {
            return [self.function.at(0.0)[0], 0.0];
        };
        let value = q[coordinate];
        if value < least || value > greatest {
            return [self.function.at(value.clamp(least, greatest))[0], 0.0];
        }
        let [place, slope, _] = self.function.at(value);
        [place, slope]
    }
}

impl PathPlan {
    pub(super) fn new(
        model: &Model,
        set: &MuscleSet,
        path: &MusclePath,
        rule: WrapRule,
        counts: &mut Counts,
    ) -> PathPlan {
        let of_wraps = path.wraps.iter().map(|wrap| set.wraps[wrap.object].body);
        let bodies: BTreeSet<Option<BodyId>> = path.points.iter().map(|p| p.body).chain(of_wraps).collect();
        let bodies = between(model, &bodies, rule);
        let slot_of: BTreeMap<Option<usize>, usize> = bodies.iter().enumerate().map(|(i, b)| (*b, i)).collect();
        let slot = |body: Option<BodyId>| slot_of.get(&body.map(BodyId::index)).copied().unwrap_or(0);
        let (moving, gears) = moving_points(path);
        let coordinates = coordinates(model, &bodies[1..], &gears);
        let arm_of = |id: usize| coordinates.binary_search(&leader(model, id)).unwrap_or(0);
        let plan = PathPlan {
            points: path.points.iter().map(|p| PathPlanPoint::new(model, p, slot(p.body))).collect(),
            moving,
            wraps: path.wraps.iter().map(|w| planned_wrap(path, w, slot(set.wraps[w.object].body))).collect(),
            slots: bodies
                .iter()
                .enumerate()
                .map(|(i, body)| Slot::new(model, *body, i == 0, &slot_of, arm_of))
                .collect(),
            gear_arms: gears.iter().map(|id| (*id, arm_of(*id))).collect(),
            gears,
            first_arm: counts.arms,
            first_slot: counts.slots,
            first_gear: counts.gears,
            coordinates,
        };
        counts.arms += plan.coordinates.len();
        counts.slots += plan.slots.len();
        counts.gears += plan.gears.len();
        plan
    }
}

/// The bodies of a path and those between them, parents first. The first is the nearest one that carries all; for paths
/// by OpenSim's rule it is ground, because their pulls need not be in balance.
fn between(model: &Model, bodies: &BTreeSet<Option<BodyId>>, rule: WrapRule) -> Vec<Option<usize>> {
    let parent = |body: usize| model.bodies()[body].joint.parent.map(BodyId::index);
    let mut all: BTreeSet<Option<usize>> = BTreeSet::new();
    for body in bodies {
        let mut next = body.map(BodyId::index);
        while let Some(body) = next {
            all.insert(Some(body));
            next = parent(body);
        }
    }
    all.insert(None);
    let mut list: Vec<Option<usize>> = all.into_iter().collect();
    if rule == WrapRule::OpenSim {
        return list;
    }
    // As long as the first carries nothing of the path itself and only one body hangs on it, that body carries all.
    while let [first, second, rest @ ..] = &list[..] {
        let holds = bodies.contains(&first.map(BodyId));
        if holds || rest.iter().any(|body| body.and_then(parent) == *first) {
            break;
        }
        debug_assert!(second.and_then(parent) == *first);
        list.remove(0);
    }
    list
}

/// Moving points, and the coordinate of each of their gears.
fn moving_points(path: &MusclePath) -> (Vec<MovingPoint>, Vec<usize>) {
    let (mut moving, mut gears) = (Vec::new(), Vec::new());
    for (index, point) in path.points.iter().enumerate() {
        let PointPlace::Moving { axes, .. } = &point.place else { continue };
        let own = axes.each_ref().map(|(coordinate, function)| {
            let id = coordinate.as_ref().filter(|_| function.as_constant().is_none())?;
            gears.push(id.index());
            Some(gears.len() - 1)
        });
        moving.push(MovingPoint { index, gears: own });
    }
    (moving, gears)
}

/// The coordinates of the joints of these bodies and of gears, each replaced by its leader.
fn coordinates(model: &Model, bodies: &[Option<usize>], gears: &[usize]) -> Vec<CoordinateId> {
    let of_joint = |body: &usize| model.bodies()[*body].joint.coordinates().into_iter().map(CoordinateId::index);
    let of_joints = bodies.iter().flatten().flat_map(of_joint);
    let all: BTreeSet<CoordinateId> = of_joints.chain(gears.iter().copied()).map(|id| leader(model, id)).collect();
    all.into_iter().collect()
}

/// The coordinate that leads this one by a coupler, or this one.
fn leader(model: &Model, coordinate: usize) -> CoordinateId {
    match model.coordinates()[coordinate].drive {
        Drive::Coupled(leader, _) => leader,
        _ => CoordinateId(coordinate),
    }
}

fn planned_wrap(path: &MusclePath, wrap: &PathWrap, slot: usize) -> PlannedWrap {
    let end = path.points.len().saturating_sub(1);
    PlannedWrap { object: wrap.object, slot, first: wrap.first.unwrap_or(0), last: wrap.last.unwrap_or(end) }
}

impl Slot {
    fn new(
        model: &Model,
        body: Option<usize>,
        is_first: bool,
        slot_of: &BTreeMap<Option<usize>, usize>,
        arm_of: impl Fn(usize) -> usize,
    ) -> Slot {
        let Some(index) = body.filter(|_| !is_first) else { return Slot { body, parent: None, arms: Vec::new() } };
        let joint = &model.bodies()[index].joint;
        let parent = slot_of.get(&joint.parent.map(BodyId::index)).copied();
        Slot { body, parent, arms: joint.coordinates().into_iter().map(|id| arm_of(id.index())).collect() }
    }
}

impl PathPlanPoint {
    fn new(model: &Model, point: &crate::set::PathPoint, slot: usize) -> PathPlanPoint {
        let place = match &point.place {
            PointPlace::Fixed(place) => Place::Fixed(*place),
            PointPlace::Conditional { place, coordinate, range } => {
                Place::Conditional { place: *place, coordinate: coordinate.index(), range: *range }
            }
            PointPlace::Moving { frame, axes } => {
                let axis = |(coordinate, function): &(Option<CoordinateId>, Function)| MovingAxis {
                    coordinate: coordinate.map(|id| {
                        let range = model.coordinates()[id.index()].range;
                        (id.index(), range.unwrap_or([f64::NEG_INFINITY, f64::INFINITY]))
                    }),
                    function: function.clone(),
                };
                Place::Moving { frame: *frame, axes: Box::new(axes.each_ref().map(axis)) }
            }
        };
        PathPlanPoint { body: point.body.map(BodyId::index), slot, place }
    }
}
