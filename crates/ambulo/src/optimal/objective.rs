//! What a motion should be like: a sum of squares of deviations.

use super::instant::{CONTACT, HEIGHT, Instant, SLIP};
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
    /// Rate of a generalised force [N.m/s or N/s].
    ForceRate(CoordinateId),
    /// Force of the ground on some spheres together along x (0), y (1) or z (2) [N]. Spheres are numbered as in the problem.
    GroundForce(Vec<usize>, usize),
    /// Height of a sphere over the ground [m].
    Height(usize),
    /// Slip of a sphere along x (0) or z (1) [m/s], weighted with its load N as N / (N + `light_n`).
    Slip {
        /// Number of the sphere.
        sphere: usize,
        /// Direction.
        axis: usize,
        /// Load with half the weight [N].
        light_n: f64,
    },
}

/// The side of the target on which deviations count.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Bound {
    /// Both sides.
    Near,
    /// Only values below the target.
    AtLeast,
    /// Only values above the target.
    AtMost,
}

/// One part of the objective: ((quantity - target) / deviation)², averaged over the span.
#[derive(Debug, Clone, PartialEq)]
pub struct Term {
    /// What is meant, for messages.
    pub name: String,
    /// The quantity.
    pub quantity: Quantity,
    /// Target of each instant, in its unit; `None` where there is none.
    pub targets: Vec<Option<f64>>,
    /// The deviation that costs one.
    pub deviation: f64,
    /// The side on which deviations count.
    pub bound: Bound,
}

/// Derivatives of a quantity in z = (q, q̇, q̈).
pub(super) enum Row {
    /// Few entries: number and slope.
    Entries(Vec<(usize, f64)>),
    /// A row of all entries was appended to the buffer.
    Full,
}

impl Term {
    /// Deviation of a value from the target of an instant, in units of the deviation, if it counts.
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
    /// Whether the quantity belongs to two instants.
    pub(super) fn is_rate_of_force(&self) -> Option<CoordinateId> {
        match self {
            Quantity::ForceRate(id) => Some(*id),
            _ => None,
        }
    }

    /// Value at an instant.
    pub(super) fn value(&self, at: &Instant) -> f64 {
        let sum = |part: usize, of: &[(CoordinateId, f64)]| {
            of.iter().map(|(id, factor)| factor * at.posture[part][id.index()]).sum::<f64>()
        };
        match self {
            Quantity::Position(of) => sum(0, of),
            Quantity::Rate(of) => sum(1, of),
            Quantity::Acceleration(of) => sum(2, of),
            Quantity::Force(id) | Quantity::ForceRate(id) => at.forces[id.index()],
            Quantity::GroundForce(spheres, axis) => spheres.iter().map(|&s| at.contacts[s].values[*axis]).sum(),
            Quantity::Height(sphere) => at.contacts[*sphere].values[HEIGHT],
            Quantity::Slip { sphere, axis, light_n } => {
                let values = &at.contacts[*sphere].values;
                values[SLIP + axis] * values[1] / (values[1] + light_n)
            }
        }
    }

    /// Derivatives at an instant; a full row is appended to `full`, divided by `scale`.
    pub(super) fn row(&self, at: &Instant, scale: f64, full: &mut Vec<f64>) -> Row {
        let n = at.posture[0].len();
        let entries = |part: usize, of: &[(CoordinateId, f64)]| {
            Row::Entries(of.iter().map(|(id, factor)| (part * n + id.index(), factor / scale)).collect())
        };
        let contact = |spheres: &[usize], slope: &dyn Fn(usize, &[f64; CONTACT]) -> f64| {
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
            Quantity::GroundForce(spheres, axis) => contact(spheres, &|_, slopes| slopes[*axis]),
            Quantity::Height(sphere) => contact(&[*sphere], &|_, slopes| slopes[HEIGHT]),
            Quantity::Slip { sphere, axis, light_n } => contact(&[*sphere], &|sphere, slopes| {
                let values = &at.contacts[sphere].values;
                let weight = values[1] / (values[1] + light_n);
                let weight_slope = light_n / (values[1] + light_n).powi(2);
                slopes[SLIP + axis] * weight + values[SLIP + axis] * weight_slope * slopes[1]
            }),
        }
    }
}
