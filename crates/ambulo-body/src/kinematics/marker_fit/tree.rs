//! The part of a model that carries markers, prepared for repeated fits: positions of the markers and their derivatives
//! by the unknowns.
//!
//! A column is the twist that an unknown gives to a body through its own joint, and to all bodies further out. With the
//! moving origin M of the joint, the direction a of a rotation axis in world axes and the slope f' of the axis by the
//! unknown (by the chain rule through couplers),
//!
//!   angular part  ω = Σ f' a,      velocity of the point of the body at the reference point  v = Σ f' a × (ref - M) + Σ f' d
//!
//! where d are the directions of translations; on an ellipsoid d is radii ∘ (a × z) in the axes of F. A marker at p
//! then moves at v + ω × (p - ref).
//!
//! The axes are those of [`plan`](crate::kinematics::plan). The nodes are not: a fit needs body frames and columns of
//! the bodies with markers only, the sweeps need joint frames relative to mass centres, with velocities, of all bodies.
//!
//! Pinned by: tests/marker_fit.rs (derivatives against finite differences, random models of all joint kinds)

use crate::kinematics::plan::Source;
use crate::model::arc;
use crate::model::{BodyId, Drive, Function, Joint, JointAxis, JointSpeeds, Model};
use crate::numerics::elementary::sin_cos;
use crate::spatial::{Mat3, Pose, Vec3};

#[derive(Debug, Clone)]
struct Axis {
    direction: Vec3,
    source: Source,
    /// The column that the axis contributes to, if an unknown moves it.
    column: Option<usize>,
}

/// A body that has fitted markers, or a descendant with some.
#[derive(Debug, Clone)]
struct Node {
    parent: Option<usize>,
    parent_from_joint: Pose,
    joint_from_child: Pose,
    rotations: Vec<Axis>,
    translations: Vec<Axis>,
    speeds: JointSpeeds,
    /// Its columns, in [`MarkerTree::columns`].
    first_column: usize,
    end_column: usize,
}

/// How a coordinate gets its value in the fit.
#[derive(Debug, Clone)]
enum Follower {
    /// Set by the caller: unknown, locked or prescribed.
    Given,
    /// A function of another coordinate.
    Follows(usize, Function),
}

/// The twist per unit of an unknown of the bodies beyond one joint.
#[derive(Debug, Clone, Copy)]
pub(super) struct TwistColumn {
    pub(super) unknown: usize,
    /// Whether an axis of rotation contributes.
    pub(super) turns: bool,
    pub(super) angular: Vec3,
    /// At the reference point.
    pub(super) linear: Vec3,
}

/// A model prepared for fits of certain markers, with the state of one posture.
#[derive(Debug, Clone)]
pub(super) struct MarkerTree {
    nodes: Vec<Node>,
    followers: Vec<Follower>,
    /// Coordinate of each unknown.
    unknowns: Vec<usize>,
    /// Unknown of each coordinate, its own or its leader's.
    unknown_of: Vec<Option<usize>>,
    /// Derivative of each coordinate by its unknown at this posture.
    rates: Vec<f64>,
    columns: Vec<TwistColumn>,
    poses: Vec<Pose>,
    joint_frames: Vec<Pose>,
    /// Values of all coordinates at this posture.
    q: Vec<f64>,
    reference: Vec3,
}

impl MarkerTree {
    /// Prepares a model for markers on these bodies; the unknowns are the free coordinates that move one of them. The
    /// second list is the node of each of the bodies.
    pub(super) fn new(model: &Model, tracked: &[BodyId]) -> (MarkerTree, Vec<usize>) {
        let mut wanted = vec![false; model.bodies().len()];
        for body in tracked {
            let mut next = Some(*body);
            while let Some(id) = next.filter(|id| !wanted[id.index()]) {
                wanted[id.index()] = true;
                next = model.bodies()[id.index()].joint.parent;
            }
        }
        let mut tree = MarkerTree::empty(model);
        tree.number_unknowns(model, &wanted);
        let mut node_of = vec![usize::MAX; wanted.len()];
        for (i, body) in model.bodies().iter().enumerate().filter(|(i, _)| wanted[*i]) {
            node_of[i] = tree.nodes.len();
            let parent = body.joint.parent.map(|id| node_of[id.index()]);
            tree.push(&body.joint, parent);
        }
        let nodes = tracked.iter().map(|body| node_of[body.index()]).collect();
        (tree, nodes)
    }

    fn empty(model: &Model) -> MarkerTree {
        let follower = |drive: &Drive| match drive {
            Drive::Coupled(leader, function) => Follower::Follows(leader.index(), function.clone()),
            _ => Follower::Given,
        };
        let count = model.coordinates().len();
        MarkerTree {
            nodes: Vec::new(),
            followers: model.coordinates().iter().map(|c| follower(&c.drive)).collect(),
            unknowns: Vec::new(),
            unknown_of: vec![None; count],
            rates: vec![1.0; count],
            columns: Vec::new(),
            poses: Vec::new(),
            joint_frames: Vec::new(),
            q: model.coordinates().iter().map(|c| c.default_value).collect(),
            reference: Vec3::zeros(),
        }
    }

    /// Numbers the free coordinates that move a wanted body, in the order of the model.
    fn number_unknowns(&mut self, model: &Model, wanted: &[bool]) {
        let mut moves = vec![false; self.q.len()];
        for (body, _) in model.bodies().iter().zip(wanted).filter(|(_, wanted)| **wanted) {
            for id in body.joint.coordinates() {
                match &model.coordinates()[id.index()].drive {
                    Drive::Coupled(leader, _) => moves[leader.index()] = true,
                    _ => moves[id.index()] = true,
                }
            }
        }
        for (i, coordinate) in model.coordinates().iter().enumerate() {
            if moves[i] && matches!(coordinate.drive, Drive::Free) {
                self.unknown_of[i] = Some(self.unknowns.len());
                self.unknowns.push(i);
            }
        }
        for (i, coordinate) in model.coordinates().iter().enumerate() {
            if let Drive::Coupled(leader, _) = &coordinate.drive {
                self.unknown_of[i] = self.unknown_of[leader.index()];
            }
        }
    }

    fn push(&mut self, joint: &Joint, parent: Option<usize>) {
        let first_column = self.columns.len();
        let mut axes = |list: &[JointAxis]| -> Vec<Axis> {
            list.iter()
                .map(|axis| {
                    let source = Source::new(&axis.displacement, 1.0);
                    let unknown = source.coordinate().and_then(|c| self.unknown_of[c]);
                    let column = unknown.map(|unknown| column_of(&mut self.columns, first_column, unknown));
                    Axis { direction: axis.direction, source, column }
                })
                .collect()
        };
        let (rotations, translations) = (axes(&joint.rotations), axes(&joint.translations));
        for column in rotations.iter().filter_map(|axis| axis.column) {
            self.columns[column].turns = true;
        }
        self.nodes.push(Node {
            parent,
            parent_from_joint: joint.parent_from_joint,
            joint_from_child: joint.child_from_joint.inverse(),
            rotations,
            translations,
            speeds: joint.speeds,
            first_column,
            end_column: self.columns.len(),
        });
        self.poses.push(Pose::IDENTITY);
        self.joint_frames.push(Pose::IDENTITY);
    }

    /// Number of unknowns.
    pub(super) fn unknowns(&self) -> usize {
        self.unknowns.len()
    }

    /// The coordinate that is this unknown.
    pub(super) fn coordinate(&self, unknown: usize) -> usize {
        self.unknowns[unknown]
    }

    /// Number of nodes, which are ordered parents first.
    pub(super) fn node_count(&self) -> usize {
        self.nodes.len()
    }

    /// The parent of a node.
    pub(super) fn parent(&self, node: usize) -> Option<usize> {
        self.nodes[node].parent
    }

    /// The columns of the joint of a node.
    pub(super) fn columns(&self, node: usize) -> &[TwistColumn] {
        &self.columns[self.nodes[node].first_column..self.nodes[node].end_column]
    }

    /// `world_from_body` at this posture.
    pub(super) fn pose(&self, node: usize) -> &Pose {
        &self.poses[node]
    }

    /// Values of all coordinates at this posture, including coupled ones.
    pub(super) fn values(&self) -> &[f64] {
        &self.q
    }

    /// Sets a locked or prescribed coordinate.
    pub(super) fn give(&mut self, coordinate: usize, value: f64) {
        self.q[coordinate] = value;
    }

    /// The reference point of the columns.
    pub(super) fn reference(&self) -> Vec3 {
        self.reference
    }

    /// Sets the reference point of the columns: near the markers, to keep digits.
    pub(super) fn refer_to(&mut self, point: Vec3) {
        self.reference = point;
    }

    /// Puts the model into a posture: one value per unknown.
    pub(super) fn pose_at(&mut self, x: &[f64]) {
        for (&coordinate, &value) in self.unknowns.iter().zip(x) {
            self.q[coordinate] = value;
        }
        for i in 0..self.q.len() {
            if let Follower::Follows(leader, function) = &self.followers[i] {
                let [value, slope, _] = function.at(self.q[*leader]);
                (self.q[i], self.rates[i]) = (value, slope);
            }
        }
        for column in &mut self.columns {
            (column.angular, column.linear) = (Vec3::zeros(), Vec3::zeros());
        }
        for i in 0..self.nodes.len() {
            self.pose_node(i);
        }
    }

    fn pose_node(&mut self, i: usize) {
        let node = &self.nodes[i];
        let parent = node.parent.map_or(Pose::IDENTITY, |p| self.poses[p]);
        let world_from_f = parent * node.parent_from_joint;
        let mut rotation = world_from_f.rotation;
        let mut turned = [(None, Vec3::zeros(), 0.0); 3];
        for (axis, slot) in node.rotations.iter().zip(&mut turned) {
            let (angle, slope) = displacement(&axis.source, &self.q, &self.rates);
            *slot = (axis.column, rotation * axis.direction, slope);
            rotation *= turn(&axis.direction, angle);
        }
        let mut origin = world_from_f.translation;
        for axis in &node.translations {
            let (distance, slope) = displacement(&axis.source, &self.q, &self.rates);
            let direction = world_from_f.rotation * axis.direction;
            origin += direction * distance;
            if let Some(column) = axis.column {
                self.columns[column].linear += direction * slope;
            }
        }
        if let Some(law) = Slide::of(node.speeds) {
            let n = world_from_f.rotation.tr_mul(&rotation.column(law.axis()));
            origin += world_from_f.rotation * law.place(n);
            for (column, axis, slope) in turned {
                let slide = law.velocity(n, world_from_f.rotation.tr_mul(&axis).cross(&n));
                if let Some(column) = column {
                    self.columns[column].linear += world_from_f.rotation * slide * slope;
                }
            }
        }
        for (column, axis, slope) in turned {
            if let Some(column) = column {
                self.columns[column].angular += axis * slope;
                self.columns[column].linear += axis.cross(&(self.reference - origin)) * slope;
            }
        }
        self.joint_frames[i] = Pose { rotation, translation: origin };
        self.poses[i] = self.joint_frames[i] * node.joint_from_child;
    }
}

/// How the origin of M follows an axis of M.
enum Slide {
    Ellipsoid(Vec3),
    Arc(f64),
}

impl Slide {
    fn of(speeds: JointSpeeds) -> Option<Slide> {
        match speeds {
            JointSpeeds::Ellipsoid(radii) => Some(Slide::Ellipsoid(radii)),
            JointSpeeds::Arc(length) => Some(Slide::Arc(length)),
            JointSpeeds::Rates | JointSpeeds::AngularVelocity => None,
        }
    }

    /// The axis of M that the origin follows.
    fn axis(&self) -> usize {
        match self {
            Slide::Ellipsoid(_) => 2,
            Slide::Arc(_) => 1,
        }
    }

    fn place(&self, n: Vec3) -> Vec3 {
        match self {
            Slide::Ellipsoid(radii) => radii.component_mul(&n),
            Slide::Arc(length) => arc::end(*length, n),
        }
    }

    fn velocity(&self, n: Vec3, rate: Vec3) -> Vec3 {
        match self {
            Slide::Ellipsoid(radii) => radii.component_mul(&rate),
            Slide::Arc(length) => arc::slide(*length, n, rate),
        }
    }
}

/// The column of this unknown among those from `first`; added if missing.
fn column_of(columns: &mut Vec<TwistColumn>, first: usize, unknown: usize) -> usize {
    let found = columns[first..].iter().position(|c| c.unknown == unknown);
    found.map_or_else(
        || {
            columns.push(TwistColumn { unknown, turns: false, angular: Vec3::zeros(), linear: Vec3::zeros() });
            columns.len() - 1
        },
        |k| first + k,
    )
}

/// Angle or displacement of an axis, and its slope by the unknown.
fn displacement(source: &Source, q: &[f64], rates: &[f64]) -> (f64, f64) {
    match source {
        Source::Fixed(value) => (*value, 0.0),
        Source::Line { coordinate, slope, intercept } => {
            (slope * q[*coordinate] + intercept, slope * rates[*coordinate])
        }
        Source::Curve { coordinate, function } => {
            let [value, slope, _] = function.at(q[*coordinate]);
            (value, slope * rates[*coordinate])
        }
    }
}

/// Rotation by an angle about a unit axis (Rodrigues): c 1 + s [a]× + (1 - c) a aᵀ.
fn turn(a: &Vec3, angle: f64) -> Mat3 {
    let (s, c) = sin_cos(angle);
    let t = 1.0 - c;
    let (x, y, z) = (a.x, a.y, a.z);
    Mat3::new(
        c + t * x * x,
        t * x * y - s * z,
        t * x * z + s * y,
        t * x * y + s * z,
        c + t * y * y,
        t * y * z - s * x,
        t * x * z - s * y,
        t * y * z + s * x,
        c + t * z * z,
    )
}
