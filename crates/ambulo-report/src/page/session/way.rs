//! The way of the pelvis along the floor: straight or turning, how long.

use super::feet;
use super::results::Results;
use super::sides;
use ambulo::model::{Movement, Side};
use ambulo::motion::interpolate;
use ambulo::spatial::Vec3;

/// A path whose strides differ by more in direction is no straight walk [deg].
const STRAIGHT_DEG: f64 = 20.0;
/// The pelvis goes at least this far in a stride that has a direction [m].
const LEAST_STRIDE_M: f64 = 0.2;
/// A path that is so many times as long as the straight way has a speed of its own.
const LONGER: f64 = 1.05;
/// The path is measured in pieces of about this time: half a stride, so that sway does not lengthen it [s].
const PIECE_S: f64 = 0.5;

/// A path that is not straight.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Turn {
    /// Largest angle between two strides, where the file's strides show it [deg].
    pub(super) degrees: Option<f64>,
}

/// Where the pelvis is along a floor that stands still.
pub(super) struct Way<'a> {
    times: &'a [f64],
    forward: &'a [f64],
    sideways: Option<&'a [f64]>,
    floor: Vec3,
}

impl Way<'_> {
    /// By the coordinates of the pelvis; none without them.
    pub(super) fn of(results: &Results) -> Option<Way<'_>> {
        let column = |movement: Movement| results.kinematics.column(results.clinical_names().central(movement)?);
        Some(Way {
            times: &results.times,
            forward: column(Movement::PelvisForward)?,
            sideways: column(Movement::PelvisRight),
            floor: feet::floor_velocity(results),
        })
    }

    /// From one instant to another [m].
    fn between(&self, [from, to]: [f64; 2]) -> Vec3 {
        let at = |column: &[f64]| interpolate(self.times, column, to) - interpolate(self.times, column, from);
        let moved = Vec3::new(at(self.forward), 0.0, self.sideways.map_or(0.0, at));
        moved - self.floor * (to - from)
    }

    /// Mean speed along the path [m/s], and as the crow flies.
    fn speeds(&self) -> Option<[f64; 2]> {
        let (first, last) = (*self.times.first()?, *self.times.last()?);
        let pieces = ((last - first) / PIECE_S).round().max(1.0);
        let at = |i: usize| first + (last - first) * i as f64 / pieces;
        let length: f64 = (0..pieces as usize).map(|i| self.between([at(i), at(i + 1)]).norm()).sum();
        Some([length, self.between([first, last]).norm()].map(|way| way / (last - first)))
    }

    /// The speed along the path [m/s] where it differs from the straight one. Belts have no path.
    pub(super) fn longer_speed(&self) -> Option<f64> {
        let [along, straight] = self.speeds().filter(|_| self.floor.norm() < 1e-9)?;
        (along > LONGER * straight).then_some(along)
    }
}

/// Whether the path turns.
pub(super) fn turn(results: &Results) -> Option<Turn> {
    let degrees = largest_angle(&headings(results)).filter(|degrees| *degrees > STRAIGHT_DEG);
    (degrees.is_some() || results.turn_deg().is_some()).then_some(Turn { degrees })
}

/// Where the pelvis goes in each stride.
fn headings(results: &Results) -> Vec<Vec3> {
    let Some(way) = Way::of(results) else { return Vec::new() };
    let mut headings = Vec::new();
    for side in Side::BOTH {
        let strikes = results.events.iter().filter(|event| event.strike && event.side == sides::page(side));
        let strikes: Vec<f64> = strikes.map(|event| event.time_s).collect();
        headings.extend(
            strikes.windows(2).filter_map(|pair| way.between([pair[0], pair[1]]).try_normalize(LEAST_STRIDE_M)),
        );
    }
    headings
}

/// Between any two directions [deg].
fn largest_angle(headings: &[Vec3]) -> Option<f64> {
    let pairs = headings.iter().enumerate().flat_map(|(i, a)| headings[i + 1..].iter().map(move |b| (a, b)));
    pairs.map(|(a, b)| a.dot(b).clamp(-1.0, 1.0).acos().to_degrees()).max_by(f64::total_cmp)
}
