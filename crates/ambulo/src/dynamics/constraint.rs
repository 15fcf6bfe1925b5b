//! Scalar constraints between bodies, and the graph of everything that acts at one instant.
//!
//! A row asks of the motions a = (α, a_c) of two bodies, angular part before linear, at the mass centres, in world axes,
//! that the departure
//!
//!   u = j_first · a_first + j_second · a_second + R λ - target
//!
//! vanish, or as its law says. Its multiplier λ is the generalised force that keeps it: the wrench j_first λ on the first
//! body and j_second λ on the second (Faure, Debunne, Cani, Multon 1997, section 3.1). R is the compliance: zero for a rigid
//! row. The unknown motion may be accelerations, velocities (then λ is an impulse) or displacements.
//!
//! Joints that form trees are not rows but [`Link`]s; rows close loops, hold contacts and limit coordinates.

use super::elimination::{Link, LinkTerms};
use crate::spatial::{Mat3, Vec3};
use std::ops::Range;

/// Six numbers, angular part before linear.
pub type Six = nalgebra::Vector6<f64>;

/// One scalar row.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Constraint {
    /// On the first body's motion.
    pub on_first: Six,
    /// On the second body's motion; without meaning where that is ground.
    pub on_second: Six,
    /// What the two add up to.
    pub target: f64,
    /// R ≥ 0: how much the row yields per unit of force.
    pub compliance: f64,
}

/// Rows of one closing joint, contact or limit.
#[derive(Debug, Clone, PartialEq)]
pub struct ConstraintGroup {
    /// What the rows act on.
    pub on: Acting,
    /// Which rows, among all.
    pub rows: Range<usize>,
    /// What forces they may bring up.
    pub law: Law,
}

/// What rows act on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Acting {
    /// Two bodies, or a body and ground.
    Bodies {
        /// The first.
        first: usize,
        /// The second; `None` is ground.
        second: Option<usize>,
    },
    /// One coordinate of a joint: the one row reads its motion q.
    Coordinate {
        /// The body that hangs on the joint.
        body: usize,
        /// The coordinate, among all.
        coordinate: usize,
    },
}

/// What forces rows may bring up.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Law {
    /// u = 0 while λ lies within [least, most]; u > 0 only at λ = least, u < 0 only at λ = most. In each row. With infinite
    /// bounds the row holds; with `least` zero it only pushes, as a lower limit does.
    Bounded {
        /// Least force [N, N.m], or impulse.
        least: f64,
        /// Largest force [N, N.m], or impulse.
        most: f64,
    },
    /// Three rows, normal first: u_n ≥ 0, λ_n ≥ 0, one of them zero; |λ_t| ≤ μ λ_n, and where it slips, λ_t = -μ λ_n u_t/|u_t|
    /// (Coulomb's cone, not a pyramid).
    Contact {
        /// Coefficient of friction μ.
        friction: f64,
        /// Largest normal force [N], or impulse.
        bound: f64,
    },
}

impl Law {
    /// u = 0, whatever force it takes.
    pub const HELD: Law = Law::Bounded { least: f64::NEG_INFINITY, most: f64::INFINITY };
}

/// A rigid body as the solver sees it at one instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BodyTerms {
    /// Mass [kg].
    pub mass: f64,
    /// Inertia about the mass centre in world axes [kg.m²].
    pub inertia: Mat3,
}

impl BodyTerms {
    /// M a.
    #[must_use]
    #[inline]
    pub fn times(&self, a: &Six) -> Six {
        let moment = self.inertia * Vec3::new(a[0], a[1], a[2]);
        Six::new(moment.x, moment.y, moment.z, self.mass * a[3], self.mass * a[4], self.mass * a[5])
    }
}

/// Bodies, joints, rows and what acts, at one instant.
#[derive(Debug, Clone, Default)]
pub struct ConstraintGraph {
    /// How each body is held.
    pub links: Vec<Link>,
    /// Each body's inertia.
    pub bodies: Vec<BodyTerms>,
    /// The joints' geometry.
    pub terms: LinkTerms,
    /// Right side b, one a body: known wrenches [N.m, N], or momenta with known impulses.
    pub wrenches: Vec<Six>,
    /// Efforts along the joints' free directions, one a coordinate [N.m or N].
    pub efforts: Vec<f64>,
    /// Inertia added to coordinates: rotors, and springs and dampers taken implicitly [kg.m² or kg].
    pub rotors: Vec<f64>,
    /// Groups of rows.
    pub groups: Vec<ConstraintGroup>,
    /// All rows.
    pub rows: Vec<Constraint>,
}

/// How far a solver came. Redundant rows do no harm and are not counted here; [`undetermined_rows`](super::undetermined_rows)
/// finds them at the price of a few tree solves.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Convergence {
    /// Tree solves.
    pub iterations: usize,
    /// Factorisations.
    pub factorizations: usize,
    /// Largest departure of a row from its law, as a share of the largest departure that rows would have without any
    /// constraint force.
    pub residual: f64,
    /// Whether the residual is within the tolerance.
    pub converged: bool,
    /// The row that departs most; none without rows.
    pub worst: Option<usize>,
}

/// The motion and the multipliers, one vector each.
#[derive(Debug, Clone, Default)]
pub struct GraphSolution {
    /// Motions, one a body.
    pub motions: Vec<Six>,
    /// Motions along the joints' free directions, one a coordinate.
    pub coordinates: Vec<f64>,
    /// Multipliers, one a row.
    pub lambda: Vec<f64>,
    /// How far the solver came.
    pub convergence: Convergence,
}

impl ConstraintGraph {
    /// Forgets all rows, bodies and joints; keeps the memory.
    pub fn clear(&mut self) {
        self.links.clear();
        self.bodies.clear();
        self.terms.arm.clear();
        self.terms.directions.clear();
        self.terms.offset.clear();
        self.wrenches.clear();
        self.efforts.clear();
        self.rotors.clear();
        self.groups.clear();
        self.rows.clear();
    }

    /// What the rows of a group make of a motion: J a, without compliance or target.
    #[inline]
    pub(crate) fn reading(&self, group: &ConstraintGroup, row: usize, motions: &[Six], coordinates: &[f64]) -> f64 {
        match group.on {
            Acting::Coordinate { coordinate, .. } => coordinates[coordinate],
            Acting::Bodies { first, second } => {
                let row = &self.rows[row];
                row.on_first.dot(&motions[first]) + second.map_or(0.0, |s| row.on_second.dot(&motions[s]))
            }
        }
    }

    /// The same, with the sum of the magnitudes that it adds up.
    #[inline]
    pub(crate) fn reading_and_terms(
        &self,
        group: &ConstraintGroup,
        row: usize,
        motions: &[Six],
        coordinates: &[f64],
    ) -> (f64, f64) {
        let sum = self.reading(group, row, motions, coordinates);
        let Acting::Bodies { first, second } = group.on else { return (sum, sum.abs()) };
        let terms = |j: &Six, a: &Six| (0..6).map(|k| (j[k] * a[k]).abs()).sum::<f64>();
        let row = &self.rows[row];
        let of_second = second.map_or(0.0, |s| terms(&row.on_second, &motions[s]));
        (sum, terms(&row.on_first, &motions[first]) + of_second)
    }

    /// Adds Jᵀ λ of all rows.
    pub(crate) fn push(&self, lambda: &[f64], wrenches: &mut [Six], efforts: &mut [f64]) {
        for group in &self.groups {
            match group.on {
                Acting::Coordinate { coordinate, .. } => efforts[coordinate] += lambda[group.rows.start],
                Acting::Bodies { first, second } => {
                    for row in group.rows.clone() {
                        wrenches[first].axpy(lambda[row], &self.rows[row].on_first, 1.0);
                        if let Some(second) = second {
                            wrenches[second].axpy(lambda[row], &self.rows[row].on_second, 1.0);
                        }
                    }
                }
            }
        }
    }

    /// The wrench of each joint on its body, at the body's mass centre [N.m, N]: M a - b - Jᵀ λ of the body and of all that
    /// hangs on it. Along a free direction it is the effort, but for the solver's residual.
    #[must_use]
    pub fn joint_wrenches(&self, outwards: &[(usize, Option<usize>)], solution: &GraphSolution) -> Vec<Six> {
        let mut wrenches = Vec::new();
        self.read_joint_wrenches(outwards, solution, &mut wrenches);
        wrenches
    }

    /// The same, into memory at hand.
    pub(crate) fn read_joint_wrenches(
        &self,
        outwards: &[(usize, Option<usize>)],
        solution: &GraphSolution,
        wrenches: &mut Vec<Six>,
    ) {
        wrenches.clear();
        let acting = self.bodies.iter().zip(&solution.motions).zip(&self.wrenches);
        wrenches.extend(acting.map(|((body, a), b)| body.times(a) - b));
        for group in &self.groups {
            let Acting::Bodies { first, second } = group.on else { continue };
            for row in group.rows.clone() {
                wrenches[first].axpy(-solution.lambda[row], &self.rows[row].on_first, 1.0);
                if let Some(second) = second {
                    wrenches[second].axpy(-solution.lambda[row], &self.rows[row].on_second, 1.0);
                }
            }
        }
        for &(body, parent) in outwards.iter().rev() {
            if let Some(parent) = parent {
                let carried = super::block::carry(&wrenches[body], &self.terms.arm[body]);
                wrenches[parent] += carried;
            }
        }
    }

    /// Whether the row's own length of motion is angular or linear plays no part: the inverse inertia that an
    /// unconstrained body, or a pair, shows to a row [1/kg or 1/(kg.m²)]; from the mean of its principal moments.
    pub(crate) fn mobility(&self, group: &ConstraintGroup, row: usize) -> f64 {
        let of_body = |body: usize, j: &Six| {
            let terms = &self.bodies[body];
            let mean = terms.inertia.trace() / 3.0;
            let linear = j[3] * j[3] + j[4] * j[4] + j[5] * j[5];
            let angular = j[0] * j[0] + j[1] * j[1] + j[2] * j[2];
            let share = |squares: f64, inertia: f64| if inertia > 0.0 { squares / inertia } else { 0.0 };
            share(linear, terms.mass) + share(angular, mean)
        };
        match group.on {
            Acting::Coordinate { body, coordinate } => {
                let s = &self.terms.directions[coordinate];
                let inertia = s.dot(&self.bodies[body].times(s)) + self.rotors[coordinate];
                if inertia > 0.0 { 1.0 / inertia } else { 0.0 }
            }
            Acting::Bodies { first, second } => {
                let row = &self.rows[row];
                of_body(first, &row.on_first) + second.map_or(0.0, |s| of_body(s, &row.on_second))
            }
        }
    }
}

/// The six rows of the relative motion of two bodies at a point: angular velocity of the first in the second along each of
/// `axes`, then the velocity of the first's point against the second's along each of them. Targets are zero.
///
/// `to_first` leads from the point to the first's mass centre, `from_second` from the second's mass centre to the point, world
/// axes [m].
///
/// The velocity of the point on the first is v + ω × (-to_first), so e · that = e · v + (-to_first × e) · ω; on the second it
/// is v + ω × from_second.
#[must_use]
pub fn relative_rows(axes: [Vec3; 3], to_first: Vec3, from_second: Vec3) -> [Constraint; 6] {
    let six = |angular: Vec3, linear: Vec3| Six::new(angular.x, angular.y, angular.z, linear.x, linear.y, linear.z);
    let rigid = |on_first, on_second| Constraint { on_first, on_second, target: 0.0, compliance: 0.0 };
    let angular = |e: Vec3| rigid(six(e, Vec3::zeros()), six(-e, Vec3::zeros()));
    let linear = |e: Vec3| rigid(six(-to_first.cross(&e), e), six(-from_second.cross(&e), -e));
    let [x, y, z] = axes;
    [angular(x), angular(y), angular(z), linear(x), linear(y), linear(z)]
}
