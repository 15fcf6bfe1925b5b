//! When a figure has fallen, and which joint reached its strength first.
//!
//!   fallen:     h < 0.7 h₀
//!   at limit:   |k (q̂ - q) - d q̇| ≥ 1.2 τ_max          ([`Impedance::is_overloaded`])
//!
//! | code | symbol | unit | meaning |
//! |---|---|---|---|
//! | `height_m` | h | m | height of the pelvis over the ground under the figure |
//! | `first_height_m` | h₀ | m | the same in the first time step |
//! | `motor.target` | q̂ | rad | target of the motor, with plan and feedback |
//! | `motor.kp`, `motor.kd` | k, d | N.m/rad, N.m.s/rad | its stiffness and damping |
//! | `motor.max` | τ_max | N.m | strength of the muscles at the angle and rate of the joint |
//!
//! A joint that was at its limit more than a second ago is forgotten: it has nothing to do with the fall.
//! Pinned by: tests/physical_walk.rs.

use super::linear::Impedance;
use crate::engine::Motor;
use crate::model::{CoordinateId, Model};

/// A figure whose pelvis is lower than this share of its first height has fallen.
const FALLEN: f64 = 0.7;
/// A joint that was at its limit for the last time longer ago has nothing to do with a fall [s].
const LIMIT_MEMORY_S: f64 = 1.0;

/// A fall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fall {
    /// Time since the controller began [s].
    pub time_s: f64,
    /// Foot strikes until then.
    pub strikes: usize,
    /// The first joint that needed clearly more than the strength of its muscles in the second before, and when [s].
    pub at_limit: Option<(CoordinateId, f64)>,
}

impl Fall {
    /// Whether a joint was at the strength of its muscles before the fall, in words.
    pub(crate) fn cause(&self, model: &Model) -> String {
        self.at_limit.map_or("no torque was at its limit".to_owned(), |(id, since_s)| {
            format!(
                "the muscles of `{}` were at their strength from {since_s:.2} s",
                model.coordinates()[id.index()].name
            )
        })
    }
}

/// A joint that needs clearly more than its strength.
#[derive(Debug, Clone, Copy)]
struct AtLimit {
    coordinate: usize,
    /// Since when [s].
    since_s: f64,
    /// Last time at which a joint was at its limit [s].
    last_s: f64,
}

/// Detects a fall and its cause.
#[derive(Debug, Clone)]
pub(super) struct FallWatch {
    /// Hips, knees, ankles and lumbar joint: a figure may fall where their strength ends. Toes reach theirs in every
    /// step.
    pub(super) carrying: Vec<usize>,
    first_height_m: Option<f64>,
    at_limit: Option<AtLimit>,
    fall: Option<Fall>,
}

impl FallWatch {
    pub(super) fn new(carrying: Vec<usize>) -> FallWatch {
        FallWatch { carrying, first_height_m: None, at_limit: None, fall: None }
    }

    pub(super) fn fall(&self) -> Option<Fall> {
        self.fall
    }

    /// Detects a fall from the height of the pelvis over the ground [m], after a time [s] and a number of foot strikes.
    pub(super) fn watch_height(&mut self, height_m: f64, time_s: f64, strikes: usize) {
        // A height that is not a number is a fall.
        let stands = height_m >= FALLEN * *self.first_height_m.get_or_insert(height_m);
        if self.fall.is_none() && !stands {
            let at_limit = self.at_limit.map(|joint| (CoordinateId(joint.coordinate), joint.since_s));
            self.fall = Some(Fall { time_s, strikes, at_limit });
        }
    }

    /// Records which joint is at its limit; `now` has value and rate of each coordinate.
    pub(super) fn watch_limits(&mut self, motors: &[Option<Motor>], now: &[[f64; 2]], time_s: f64) {
        let is_limited = |c: &usize| motors[*c].as_ref().is_some_and(|motor| Impedance::is_overloaded(motor, now[*c]));
        let first = self.carrying.iter().copied().find(is_limited);
        self.at_limit = match (self.at_limit, first) {
            (Some(known), Some(_)) => Some(AtLimit { last_s: time_s, ..known }),
            (None, Some(coordinate)) => Some(AtLimit { coordinate, since_s: time_s, last_s: time_s }),
            (known, None) => known.filter(|joint| time_s - joint.last_s < LIMIT_MEMORY_S),
        };
    }
}
