//! A plate read in another way: corners in another order, a component with the other sign.
//!
//! A file states the axes R of a plate by the order of its corners. Another order states other axes S, so that force
//! and moment about the centre turn with T = s S Rᵀ; s is -1 where this would let the load act downwards, because a
//! foot cannot pull. Four orders turn the plate, four reverse it.
//!
//! A component whose channel has the wrong sign changes the moment as well, because the sensors lie below the surface:
//! M = M_sensors + F × o, with o from the sensors to the centre of the surface (kind.rs).
//! Pinned by: tests/plate_orders.rs

use super::PlateRecording;
use super::surface::Surface;
use crate::spatial::{Mat3, Vec3};

/// The orders of four corners that keep neighbours: places of the corners in the order of the file. The first is the
/// order of the file, the next three turn the plate by quarters, the last four reverse it.
pub const CORNER_ORDERS: [[usize; 4]; 8] =
    [[0, 1, 2, 3], [1, 2, 3, 0], [2, 3, 0, 1], [3, 0, 1, 2], [0, 3, 2, 1], [3, 2, 1, 0], [2, 1, 0, 3], [1, 0, 3, 2]];

impl PlateRecording {
    /// The plate's x and y by its corners, unit vectors; `None` for corners that are no rectangle.
    #[must_use]
    pub fn axes(&self) -> Option<[Vec3; 2]> {
        let axes = Surface::through(&self.corners).ok()?.lab_from_plate;
        Some([axes.column(0).into(), axes.column(1).into()])
    }

    /// The plate read with its corners in another order; `None` for corners that are no rectangle.
    #[must_use]
    pub fn with_corners(&self, order: [usize; 4]) -> Option<PlateRecording> {
        let corners = order.map(|corner| self.corners[corner]);
        let [stated, other] = [&self.corners, &corners].map(Surface::through);
        let turn = other.ok()?.lab_from_plate * stated.ok()?.lab_from_plate.transpose();
        let sign = if (turn * self.up).dot(&self.up) < 0.0 { -1.0 } else { 1.0 };
        let read = self.with_wrenches(|force, moment| (turn * force * sign, turn * moment * sign));
        Some(PlateRecording { corners, center_from_sensors: turn * self.center_from_sensors, ..read })
    }

    /// The recording of the plate, turned about the vertical through its centre by this many quarters, to the left as
    /// seen from above.
    #[must_use]
    pub fn turned(&self, quarters: i32) -> PlateRecording {
        let up = self.up;
        let quarter = |v: Vec3| up * up.dot(&v) + up.cross(&v);
        let turn = |v: Vec3| (0..quarters.rem_euclid(4)).fold(v, |v, _| quarter(v));
        let read = self.with_wrenches(|force, moment| (turn(force), turn(moment)));
        PlateRecording { center_from_sensors: turn(self.center_from_sensors), ..read }
    }

    /// The plate with the other sign of its force along x (0) or y (1).
    #[must_use]
    pub fn flipped(&self, axis: usize) -> PlateRecording {
        let Some(along) = self.axes().and_then(|axes| axes.get(axis).copied()) else { return self.clone() };
        let mirror = Mat3::identity() - along * along.transpose() * 2.0;
        let lever = self.center_from_sensors;
        self.with_wrenches(|force, moment| {
            let mirrored = mirror * force;
            (mirrored, moment + (mirrored - force).cross(&lever))
        })
    }

    /// The plate with another unit in place of the assumed one: forces multiplied by a factor, and moments if
    /// they had the same unit.
    #[must_use]
    pub fn with_unit(&self, factor: f64) -> PlateRecording {
        let Some([force_factor, moment_factor]) = self.assumed_units else { return self.clone() };
        // Type 1 has points, so that its moments follow the forces.
        let is_same = self.kind == 1 || (moment_factor / force_factor - 1.0).abs() < 1e-6;
        let moments = if is_same { factor } else { 1.0 };
        let read = self.with_wrenches(|force, moment| (force * factor, moment * moments));
        PlateRecording { assumed_units: Some([force_factor * factor, moment_factor * moments]), ..read }
    }

    /// Without any load.
    #[must_use]
    pub fn unloaded(&self) -> PlateRecording {
        self.with_wrenches(|_, _| (Vec3::zeros(), Vec3::zeros()))
    }

    /// Other forces and moments about the centre.
    fn with_wrenches(&self, read: impl Fn(Vec3, Vec3) -> (Vec3, Vec3)) -> PlateRecording {
        let center = self.center();
        let wrenches = (0..self.times.len()).map(|i| read(self.force[i], self.moment_about_center(i)));
        let (force, moment) = wrenches.map(|(force, moment)| (force, moment + center.cross(&force))).unzip();
        PlateRecording { force, moment, ..self.clone() }
    }
}
