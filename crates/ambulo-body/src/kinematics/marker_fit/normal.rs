//! The normal equations of one frame, JᵀWJ and JᵀW(m - p).
//!
//! JᵀWJ is the joint-space mass matrix of a body whose only masses are the weights w at the markers, and JᵀW(m - p) is
//! the generalised force of springs of stiffness w that pull the markers to the recorded positions. Both are therefore
//! assembled by the composite-rigid-body method: mass, first and second moment of the weights are summed from the
//! leaves to the root, and the entry of two columns is the twist of one times the momentum of the other. J is never
//! formed; bodies without weights are free.
//!
//! Half the second derivative of the cost is JᵀWJ - Σ f·∂²p, with f = w (m - p). An axis a moves every axis b further
//! out, ∂²p/∂a∂b = ω_a × (v_b + ω_b × x), so that
//!
//!   Σ f·∂²p = F·(ω_a × v_b) + ω_aᵀ X ω_b - tr X ω_a·ω_b,      X = Σ x fᵀ
//!
//! The second derivatives of the functions of the joints are omitted: this slows the iteration, but does not change its
//! result.
//!
//! | code       | symbol                | unit |
//! | `mass`     | Σ w                   | 1    |
//! | `first`    | Σ w x                 | m    |
//! | `second`   | Σ w (x² 1 - x xᵀ)     | m²   |
//! | `force`    | Σ w (m - p)           | m    |
//! | `moment`   | Σ x × w (m - p)       | m²   |
//! | `spread`   | X = Σ x w (m - p)ᵀ    | m²   |
//!
//! where x is the position of the marker relative to the reference point.
//!
//! Source: R. Featherstone 2008, Rigid Body Dynamics Algorithms, section 6.2 (composite-rigid-body algorithm)
//! (unverified). Cost: number of pairs of a column with a column between it and the root.
//! Pinned by: tests/marker_fit.rs

use super::branch_matrix::Branches;
use super::tree::{MarkerTree, TwistColumn};
use crate::spatial::{Mat3, Vec3};

/// A fitted marker: the node that carries it, and its place in the frame of that body [m].
#[derive(Debug, Clone, Copy)]
pub(super) struct Point {
    pub(super) node: usize,
    pub(super) place: Vec3,
}

/// Targets of one frame: one recorded position and one weight per point. The weight of a missing marker is zero.
#[derive(Debug, Clone, Copy)]
pub(super) struct Targets<'a> {
    pub(super) points: &'a [Point],
    pub(super) positions: &'a [Vec3],
    pub(super) weights: &'a [f64],
}

#[derive(Debug, Clone, Copy)]
struct Composite {
    mass: f64,
    first: Vec3,
    second: Mat3,
    force: Vec3,
    moment: Vec3,
    spread: Mat3,
}

const EMPTY: Composite = Composite {
    mass: 0.0,
    first: Vec3::new(0., 0., 0.),
    second: Mat3::new(0., 0., 0., 0., 0., 0., 0., 0., 0.),
    force: Vec3::new(0., 0., 0.),
    moment: Vec3::new(0., 0., 0.),
    spread: Mat3::new(0., 0., 0., 0., 0., 0., 0., 0., 0.),
};

impl Composite {
    fn add(&mut self, other: &Composite) {
        self.mass += other.mass;
        self.first += other.first;
        self.second += other.second;
        self.force += other.force;
        self.moment += other.moment;
        self.spread += other.spread;
    }
}

/// JᵀWJ and JᵀW(m - p).
#[derive(Debug, Clone)]
pub(super) struct Normal {
    /// Places of the entries of both matrices.
    pub(super) branches: Branches,
    pub(super) matrix: Vec<f64>,
    /// Σ f·∂²p.
    pub(super) curvature: Vec<f64>,
    pub(super) right: Vec<f64>,
    composites: Vec<Composite>,
}

/// Σ w |m - p|² at the current posture.
pub(super) fn cost(tree: &MarkerTree, targets: &Targets<'_>) -> f64 {
    let mut sum = 0.0;
    for (i, point) in targets.points.iter().enumerate() {
        let weight = targets.weights[i];
        if weight > 0.0 {
            sum += weight * (targets.positions[i] - tree.pose(point.node).place(point.place)).norm_squared();
        }
    }
    sum
}

impl Normal {
    pub(super) fn new(tree: &MarkerTree) -> Normal {
        let branches = branches(tree);
        Normal {
            matrix: vec![0.0; branches.entries()],
            curvature: vec![0.0; branches.entries()],
            right: vec![0.0; branches.unknowns()],
            composites: vec![EMPTY; tree.node_count()],
            branches,
        }
    }

    /// Assembles the equations at the current posture.
    pub(super) fn gather(&mut self, tree: &MarkerTree, targets: &Targets<'_>) {
        self.matrix.fill(0.0);
        self.curvature.fill(0.0);
        self.right.fill(0.0);
        self.composites.fill(EMPTY);
        self.add_markers(tree, targets);
        for node in (0..tree.node_count()).rev() {
            let own = self.composites[node];
            if own.mass > 0.0 {
                self.project(tree, node, &own);
                if let Some(parent) = tree.parent(node) {
                    self.composites[parent].add(&own);
                }
            }
        }
    }

    fn add_markers(&mut self, tree: &MarkerTree, targets: &Targets<'_>) {
        for (i, point) in targets.points.iter().enumerate() {
            let w = targets.weights[i];
            if w > 0.0 {
                let p = tree.pose(point.node).place(point.place);
                let (x, force) = (p - tree.reference(), (targets.positions[i] - p) * w);
                self.composites[point.node].add(&Composite {
                    mass: w,
                    first: x * w,
                    second: (Mat3::from_diagonal_element(x.norm_squared()) - x * x.transpose()) * w,
                    force,
                    moment: x.cross(&force),
                    spread: x * force.transpose(),
                });
            }
        }
    }

    /// Adds the products of the columns of a node with each other and with all columns towards the root.
    fn project(&mut self, tree: &MarkerTree, node: usize, c: &Composite) {
        let trace = c.spread.trace();
        let own = tree.columns(node);
        for (k, column) in own.iter().enumerate() {
            self.right[column.unknown] += column.angular.dot(&c.moment) + column.linear.dot(&c.force);
            let linear = column.linear * c.mass + column.angular.cross(&c.first);
            let angular = c.second * column.angular + c.first.cross(&column.linear);
            let bend = column.linear.cross(&c.force) + c.spread * column.angular - column.angular * trace;
            for other in &own[..k] {
                let bends = if other.turns && column.turns { other.angular.dot(&bend) } else { 0.0 };
                self.add(column.unknown, other.unknown, other.angular.dot(&angular) + other.linear.dot(&linear), bends);
            }
            let diagonal = self.branches.diagonal(column.unknown);
            self.matrix[diagonal] += column.angular.dot(&angular) + column.linear.dot(&linear);
            self.curvature[diagonal] += column.angular.dot(&bend);
            let mut next = tree.parent(node);
            while let Some(ancestor) = next {
                for other in tree.columns(ancestor) {
                    let product = other.angular.dot(&angular) + other.linear.dot(&linear);
                    self.add(column.unknown, other.unknown, product, other.angular.dot(&bend));
                }
                next = tree.parent(ancestor);
            }
        }
    }

    /// Adds the product of two different columns, which may belong to one unknown.
    fn add(&mut self, a: usize, b: usize, product: f64, bends: f64) {
        let times = if a == b { 2.0 } else { 1.0 };
        let entry = self.branches.entry(a, b);
        self.matrix[entry] += times * product;
        self.curvature[entry] += times * bends;
    }
}

/// The unknowns of each node with each other and with those of all nodes towards the root.
fn branches(tree: &MarkerTree) -> Branches {
    let mut outwards = Vec::with_capacity(tree.unknowns());
    let mut pairs = Vec::new();
    for node in 0..tree.node_count() {
        for column in tree.columns(node) {
            if !outwards.contains(&column.unknown) {
                outwards.push(column.unknown);
            }
        }
        let towards_root = std::iter::successors(Some(node), |node| tree.parent(*node));
        let others: Vec<&TwistColumn> = towards_root.flat_map(|node| tree.columns(node)).collect();
        for column in tree.columns(node) {
            pairs.extend(others.iter().map(|other| (column.unknown, other.unknown)));
        }
    }
    Branches::new(outwards, pairs.into_iter().filter(|(a, b)| a != b))
}
