//! Scalar constraints between bodies, and the graph of bodies, joints, constraints and loads at one instant.
//!
//! A row constrains the motions a = (α, a_c) of two bodies (angular part before linear, at the mass centres, in world
//! axes): the quantity
//!
//!   u = j_first · a_first + j_second · a_second + R λ - target
//!
//! must vanish, or obey the law of the row. The multiplier λ is the constraint force: it acts as the wrench j_first λ
//! on the first body and j_second λ on the second (Faure, Debunne, Cani, Multon 1997, section 3.1). R is the
//! compliance: zero for a rigid row. The unknown motion may be accelerations, velocities (then λ is an impulse) or
//! displacements.
//!
//! Joints that form trees are [`Link`]s, not rows. Rows close loops, and describe contacts and limits of coordinates.

use super::block::{BodyTerms, Six, carry};
use super::elimination_order::{Link, LinkTerms};
use crate::spatial::Vec3;
use std::ops::Range;

/// One scalar constraint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Constraint {
    /// Coefficients of the first body's motion.
    pub on_first: Six,
    /// Coefficients of the second body's motion; unused if that is ground.
    pub on_second: Six,
    /// Required value of the sum.
    pub target: f64,
    /// Compliance R ≥ 0: deviation per unit of force.
    pub compliance: f64,
}

/// The rows of one loop closure, contact or limit.
#[derive(Debug, Clone, PartialEq)]
pub struct ConstraintGroup {
    /// Bodies or coordinate that the rows act on.
    pub on: ActsOn,
    /// Indices of the rows.
    pub rows: Range<usize>,
    /// Which constraint forces are allowed.
    pub law: Law,
}

/// Bodies or coordinate that a group of rows acts on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ActsOn {
    /// Two bodies, or a body and ground.
    Bodies {
        /// The first body.
        first: usize,
        /// The second body; `None` is ground.
        second: Option<usize>,
    },
    /// One coordinate of a joint; the group has one row, which reads the motion q of the coordinate.
    Coordinate {
        /// The child body of the joint.
        body: usize,
        /// Index of the coordinate.
        coordinate: usize,
    },
}

/// Which constraint forces rows may produce.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Law {
    /// For each row: u = 0 while λ is inside [least, most]; u > 0 only at λ = least, u < 0 only at λ = most. Infinite
    /// bounds make an equality; `least` = 0 makes a row that only pushes, such as a lower limit.
    Bounded {
        /// Least force [N, N.m], or impulse.
        least: f64,
        /// Largest force [N, N.m], or impulse.
        most: f64,
    },
    /// Three rows, normal first: u_n ≥ 0, λ_n ≥ 0, one of them zero; |λ_t| ≤ μ λ_n, and while slipping λ_t = -μ λ_n
    /// u_t/|u_t| (Coulomb's cone, not a pyramid).
    Contact {
        /// Coefficient of friction μ.
        friction: f64,
        /// Largest normal force [N], or impulse.
        bound: f64,
    },
}

impl Law {
    /// u = 0 with a force of any size.
    pub const EQUALITY: Law = Law::Bounded { least: f64::NEG_INFINITY, most: f64::INFINITY };
}

/// Bodies, joints, constraints and loads at one instant.
#[derive(Debug, Clone, Default)]
pub struct ConstraintGraph {
    /// Parent and freedom of each body.
    pub links: Vec<Link>,
    /// Mass and inertia of each body.
    pub bodies: Vec<BodyTerms>,
    /// Geometry of the joints.
    pub terms: LinkTerms,
    /// Right side b, one per body: known wrenches [N.m, N], or momenta plus known impulses.
    pub wrenches: Vec<Six>,
    /// Efforts along the free directions of the joints, one per coordinate [N.m or N].
    pub efforts: Vec<f64>,
    /// Inertia added to coordinates: rotors, and implicit springs and dampers [kg.m² or kg].
    pub rotors: Vec<f64>,
    /// Groups of rows.
    pub groups: Vec<ConstraintGroup>,
    /// All rows.
    pub rows: Vec<Constraint>,
}

/// Convergence of a solver. Redundant rows are not counted here; [`undetermined_rows`](super::undetermined_rows) finds
/// them with a few tree solves.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Convergence {
    /// Number of tree solves.
    pub iterations: usize,
    /// Number of factorisations.
    pub factorizations: usize,
    /// Largest departure of a row from its law, as a share of the largest departure that rows would have without any
    /// constraint force.
    pub residual: f64,
    /// Whether the residual is within the tolerance.
    pub converged: bool,
    /// The row with the largest departure; `None` without rows.
    pub worst: Option<usize>,
    /// Whether the search for a solution ended because its work was used up.
    pub gave_up: bool,
}

/// Solution of a constraint graph: motions and multipliers.
#[derive(Debug, Clone, Default)]
pub struct GraphSolution {
    /// Motions, one per body.
    pub motions: Vec<Six>,
    /// Motions along the joints' free directions, one per coordinate.
    pub coordinates: Vec<f64>,
    /// Multipliers, one per row.
    pub lambda: Vec<f64>,
    /// Convergence of the solver.
    pub convergence: Convergence,
}

impl ConstraintGraph {
    /// Removes all rows, bodies and joints; keeps the allocated memory.
    #[inline]
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

    /// Value of a row for a motion: J a, without compliance and target.
    #[inline]
    #[doc(hidden)]
    pub fn reading(&self, group: &ConstraintGroup, row: usize, motions: &[Six], coordinates: &[f64]) -> f64 {
        match group.on {
            ActsOn::Coordinate { coordinate, .. } => coordinates[coordinate],
            ActsOn::Bodies { first, second } => {
                let row = &self.rows[row];
                row.on_first.dot(&motions[first]) + second.map_or(0.0, |s| row.on_second.dot(&motions[s]))
            }
        }
    }

    /// Value of a row, and the sum of the magnitudes of its terms.
    #[inline]
    pub(crate) fn reading_and_terms(
        &self,
        group: &ConstraintGroup,
        row: usize,
        motions: &[Six],
        coordinates: &[f64],
    ) -> (f64, f64) {
        let sum = self.reading(group, row, motions, coordinates);
        let ActsOn::Bodies { first, second } = group.on else { return (sum, sum.abs()) };
        let terms = |j: &Six, a: &Six| (0..6).map(|k| (j[k] * a[k]).abs()).sum::<f64>();
        let row = &self.rows[row];
        let of_second = second.map_or(0.0, |s| terms(&row.on_second, &motions[s]));
        (sum, terms(&row.on_first, &motions[first]) + of_second)
    }

    /// Adds Jᵀ λ of all rows.
    pub(crate) fn push(&self, lambda: &[f64], wrenches: &mut [Six], efforts: &mut [f64]) {
        for group in &self.groups {
            match group.on {
                ActsOn::Coordinate { coordinate, .. } => efforts[coordinate] += lambda[group.rows.start],
                ActsOn::Bodies { first, second } => {
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

    /// Wrench of each joint on its body, at the mass centre of the body [N.m, N]: the sum of M a - b - Jᵀ λ over the
    /// body and its descendants. Along a free direction it is the effort, up to the residual of the solver.
    #[must_use]
    pub fn joint_wrenches(&self, outwards: &[(usize, Option<usize>)], solution: &GraphSolution) -> Vec<Six> {
        let mut wrenches = Vec::new();
        self.read_joint_wrenches(outwards, solution, &mut wrenches);
        wrenches
    }

    /// [`Self::joint_wrenches`] into existing memory.
    #[doc(hidden)]
    pub fn read_joint_wrenches(
        &self,
        outwards: &[(usize, Option<usize>)],
        solution: &GraphSolution,
        wrenches: &mut Vec<Six>,
    ) {
        wrenches.clear();
        let acting = self.bodies.iter().zip(&solution.motions).zip(&self.wrenches);
        wrenches.extend(acting.map(|((body, a), b)| body.times(a) - b));
        for group in &self.groups {
            let ActsOn::Bodies { first, second } = group.on else { continue };
            for row in group.rows.clone() {
                wrenches[first].axpy(-solution.lambda[row], &self.rows[row].on_first, 1.0);
                if let Some(second) = second {
                    wrenches[second].axpy(-solution.lambda[row], &self.rows[row].on_second, 1.0);
                }
            }
        }
        for &(body, parent) in outwards.iter().rev() {
            if let Some(parent) = parent {
                let carried = carry(&wrenches[body], &self.terms.arm[body]);
                wrenches[parent] += carried;
            }
        }
    }

    /// Mobility of a row [1/kg or 1/(kg.m²)]: its motion per unit of force if its bodies were free, with the mean of
    /// their principal moments of inertia.
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
            ActsOn::Coordinate { body, coordinate } => {
                let s = &self.terms.directions[coordinate];
                let inertia = s.dot(&self.bodies[body].times(s)) + self.rotors[coordinate];
                if inertia > 0.0 { 1.0 / inertia } else { 0.0 }
            }
            ActsOn::Bodies { first, second } => {
                let row = &self.rows[row];
                of_body(first, &row.on_first) + second.map_or(0.0, |s| of_body(s, &row.on_second))
            }
        }
    }
}

/// The row of an angular velocity along `axis`.
#[inline]
pub fn relative_turn(axis: Vec3) -> Constraint {
    rigid_row((axis, Vec3::zeros()), (-axis, Vec3::zeros()))
}

/// The row of the velocity of a point along `axis`.
#[inline]
pub fn relative_slide(axis: Vec3, to_first: Vec3, from_second: Vec3) -> Constraint {
    rigid_row((-to_first.cross(&axis), axis), (-from_second.cross(&axis), -axis))
}

#[inline]
fn rigid_row(first: (Vec3, Vec3), second: (Vec3, Vec3)) -> Constraint {
    let six = |(w, v): (Vec3, Vec3)| Six::new(w.x, w.y, w.z, v.x, v.y, v.z);
    Constraint { on_first: six(first), on_second: six(second), target: 0.0, compliance: 0.0 }
}
