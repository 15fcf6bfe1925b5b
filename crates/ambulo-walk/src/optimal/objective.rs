//! The objective of a motion: a sum of squared deviations of quantities from their targets.

use super::effort::{Effort, root_power};
use super::instant::{ContactValues, Instant};
use super::strength::StrengthCurve;
use crate::model::CoordinateId;

/// A quantity of one instant of a motion.
#[derive(Debug, Clone, PartialEq)]
pub enum Quantity {
    /// Weighted sum of coordinates [rad or m].
    Position(Vec<(CoordinateId, f64)>),
    /// Weighted sum of rates [rad/s or m/s].
    Rate(Vec<(CoordinateId, f64)>),
    /// Weighted sum of accelerations [rad/s² or m/s²].
    Acceleration(Vec<(CoordinateId, f64)>),
    /// Generalised force of a coordinate [N.m or N].
    Force(CoordinateId),
    /// Muscle moment or force at a joint [N.m or N].
    Effort(Effort),
    /// Muscle moment at a joint as a share of what its muscles can do at this angle and speed, in the direction of
    /// `sign`: above zero in it, below zero against it.
    Activation {
        /// Action of the muscles at the joint.
        effort: Effort,
        /// What the muscles can do.
        strength: StrengthCurve,
        /// Direction: 1 or -1.
        sign: f64,
    },
    /// Square root of the power that muscles cost at a joint, √(p₊ P₊ + p₋ P₋) [√W], where P₊ and P₋ are positive and
    /// negative mechanical power. Both are smoothed: P₊ = (P + √(P² + `smooth_w`²)) / 2, P₋ = P₊ - P.
    RootPower {
        /// Action of the muscles at the joint.
        effort: Effort,
        /// Price p₊ of positive and p₋ of negative power.
        prices: [f64; 2],
        /// Power below which the smoothed values differ from P₊ and P₋ [W].
        smooth_w: f64,
    },
    /// Rate of a generalised force [N.m/s or N/s].
    ForceRate(CoordinateId),
    /// Sum of the ground forces on some spheres along x (0), y (1) or z (2) [N]. Spheres are numbered as in the
    /// problem.
    GroundForce(Vec<usize>, usize),
    /// Moment of the vertical ground forces on some spheres about a point that moves: Σ N (c - p), with the positions c
    /// of the spheres along x (0) or z (2) [N.m]. It is zero if the centre of pressure is at the point.
    LoadOffset {
        /// Numbers of the spheres.
        spheres: Vec<usize>,
        /// Direction: x (0) or z (2).
        axis: usize,
        /// Position p of the point per instant [m].
        points: Vec<f64>,
    },
    /// Height of a sphere above the ground [m].
    Height(usize),
    /// Position of the centre of a sphere along x (0) or z (2) [m].
    Place(usize, usize),
    /// Slip velocity of a sphere along x (0) or z (1) [m/s], multiplied by N / (N + `light_n`), where N is the vertical
    /// force on it [N].
    Slip {
        /// Number of the sphere.
        sphere: usize,
        /// Direction: x (0) or z (1).
        axis: usize,
        /// Vertical force at which the slip counts half [N].
        light_n: f64,
    },
}

/// The deviations from the target that count.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Bound {
    /// All.
    Near,
    /// Only deviations of values below the target.
    AtLeast,
    /// Only deviations of values above the target.
    AtMost,
}

/// One part of the objective: ((quantity - target) / deviation)², averaged over the span.
#[derive(Debug, Clone, PartialEq)]
pub struct Term {
    /// Name of the term. It need not be unique.
    pub name: String,
    /// The quantity.
    pub quantity: Quantity,
    /// Target per instant, in the unit of the quantity; `None` at instants that do not count.
    pub targets: Vec<Option<f64>>,
    /// The deviation at which an instant costs 1, in the unit of the quantity.
    pub deviation: f64,
    /// The deviations that count.
    pub bound: Bound,
}

/// Derivatives of a quantity by z = (q, q̇, q̈).
pub enum Row {
    /// The entries that are not zero: index in z and derivative.
    Entries(Vec<(usize, f64)>),
    /// All entries; they were appended to the buffer.
    Full,
}

impl Term {
    /// (value - target) / deviation at an instant; `None` if it does not count.
    pub(super) fn residual(&self, instant: usize, value: f64) -> Option<f64> {
        let residual = (value - self.targets[instant]?) / self.deviation;
        match self.bound {
            Bound::AtLeast if residual >= 0.0 => None,
            Bound::AtMost if residual <= 0.0 => None,
            _ => Some(residual),
        }
    }
}

impl Quantity {
    /// The coordinate of a rate of force, which is a difference between two instants; otherwise `None`.
    pub(super) fn is_rate_of_force(&self) -> Option<CoordinateId> {
        match self {
            Quantity::ForceRate(id) => Some(*id),
            _ => None,
        }
    }

    /// Value at an instant, given with its number.
    #[doc(hidden)] // for tests
    pub fn value(&self, instant: usize, at: &Instant) -> f64 {
        let sum = |part: usize, of: &[(CoordinateId, f64)]| {
            of.iter().map(|(id, factor)| factor * at.posture[part][id.index()]).sum::<f64>()
        };
        match self {
            Quantity::Position(of) => sum(0, of),
            Quantity::Rate(of) => sum(1, of),
            Quantity::Acceleration(of) => sum(2, of),
            Quantity::Force(id) | Quantity::ForceRate(id) => at.forces[id.index()],
            Quantity::Effort(effort) => effort.value(instant, at),
            Quantity::Activation { effort, strength, sign } => {
                sign * effort.value(instant, at) / strength_at(strength, effort, *sign, at)[0]
            }
            Quantity::RootPower { effort, prices, smooth_w } => {
                let rate = at.posture[1][effort.coordinate.index()];
                root_power(effort.value(instant, at) * rate, *prices, *smooth_w).0
            }
            Quantity::GroundForce(spheres, axis) => spheres.iter().map(|&s| at.contacts[s].values.force[*axis]).sum(),
            Quantity::LoadOffset { spheres, axis, points } => {
                let offset = |of: &ContactValues| of.force.y * (of.place_along(*axis) - points[instant]);
                spheres.iter().map(|&s| offset(&at.contacts[s].values)).sum()
            }
            Quantity::Height(sphere) => at.contacts[*sphere].values.height,
            Quantity::Place(sphere, axis) => at.contacts[*sphere].values.place_along(*axis),
            Quantity::Slip { sphere, axis, light_n } => {
                let ContactValues { force, slip, .. } = &at.contacts[*sphere].values;
                slip[*axis] * force.y / (force.y + light_n)
            }
        }
    }

    /// Derivatives at an instant divided by `scale`; a full row is appended to `full`.
    #[doc(hidden)] // for tests
    pub fn row(&self, instant: usize, at: &Instant, scale: f64, full: &mut Vec<f64>) -> Row {
        let n = at.posture[0].len();
        let entries = |part: usize, of: &[(CoordinateId, f64)]| {
            Row::Entries(of.iter().map(|(id, factor)| (part * n + id.index(), factor / scale)).collect())
        };
        let contact = |spheres: &[usize], slope: &dyn Fn(usize, &ContactValues) -> f64| {
            let mut row: Vec<(usize, f64)> = Vec::new();
            for &sphere in spheres {
                for (coordinate, slopes) in &at.contacts[sphere].slopes {
                    for (part, slopes) in slopes.iter().enumerate() {
                        let (place, slope) = (part * n + coordinate, slope(sphere, slopes) / scale);
                        match row.iter_mut().find(|(known, _)| *known == place) {
                            Some((_, sum)) => *sum += slope,
                            None => row.push((place, slope)),
                        }
                    }
                }
            }
            Row::Entries(row)
        };
        match self {
            Quantity::Position(of) => entries(0, of),
            Quantity::Rate(of) => entries(1, of),
            Quantity::Acceleration(of) => entries(2, of),
            Quantity::Force(id) | Quantity::ForceRate(id) => {
                full.extend(at.slopes[id.index() * 3 * n..(id.index() + 1) * 3 * n].iter().map(|slope| slope / scale));
                Row::Full
            }
            Quantity::Effort(effort) => {
                effort.push_row(at, 1.0 / scale, full);
                Row::Full
            }
            Quantity::Activation { effort, strength, sign } => {
                push_share(effort, strength, *sign, (instant, at, scale), full);
                Row::Full
            }
            Quantity::RootPower { effort, prices, smooth_w } => {
                let c = effort.coordinate.index();
                let (force, rate) = (effort.value(instant, at), at.posture[1][c]);
                let (first, slope) = (full.len(), root_power(force * rate, *prices, *smooth_w).1 / scale);
                effort.push_row(at, slope * rate, full);
                full[first + n + c] += slope * force;
                Row::Full
            }
            Quantity::GroundForce(spheres, axis) => contact(spheres, &|_, slopes| slopes.force[*axis]),
            Quantity::LoadOffset { spheres, axis, points } => contact(spheres, &|sphere, slopes| {
                let values = &at.contacts[sphere].values;
                let offset = values.place_along(*axis) - points[instant];
                slopes.force.y * offset + values.force.y * slopes.place_along(*axis)
            }),
            Quantity::Height(sphere) => contact(&[*sphere], &|_, slopes| slopes.height),
            Quantity::Place(sphere, axis) => contact(&[*sphere], &|_, slopes| slopes.place_along(*axis)),
            Quantity::Slip { sphere, axis, light_n } => contact(&[*sphere], &|sphere, slopes| {
                let ContactValues { force, slip, .. } = &at.contacts[sphere].values;
                let weight = force.y / (force.y + light_n);
                let weight_slope = light_n / (force.y + light_n).powi(2);
                slopes.slip[*axis] * weight + slip[*axis] * weight_slope * slopes.force.y
            }),
        }
    }
}

/// Largest moment of the muscles at an instant, and its derivatives by angle and rate.
fn strength_at(strength: &StrengthCurve, effort: &Effort, sign: f64, at: &Instant) -> [f64; 3] {
    let c = effort.coordinate.index();
    strength.smooth(at.posture[0][c], at.posture[1][c], sign)
}

/// Appends the derivatives of an activation, divided by `scale`.
fn push_share(
    effort: &Effort,
    strength: &StrengthCurve,
    sign: f64,
    (instant, at, scale): (usize, &Instant, f64),
    full: &mut Vec<f64>,
) {
    let [largest, by_angle, by_rate] = strength_at(strength, effort, sign, at);
    let share = sign * effort.value(instant, at) / largest;
    let (n, c, first) = (at.posture[0].len(), effort.coordinate.index(), full.len());
    effort.push_row(at, sign / (largest * scale), full);
    full[first + c] -= share * by_angle / (largest * scale);
    full[first + n + c] -= share * by_rate / (largest * scale);
}
