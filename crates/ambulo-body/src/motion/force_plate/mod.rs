//! Force plates: converts their channels to the force on the foot in the axes of the laboratory.
//!
//! With R the axes of the plate in the laboratory, C the centre of its surface, n the upward normal, and F, M the force
//! and its moment about C in the plate's axes (kind.rs):
//!
//!   F_lab = R F         M₀ = R M + C × R F          p = C + n × R M / (n · R F)          T = n · (R M - (p - C) × R F)
//!
//! | code                   | symbol | unit | meaning                                     |
//! | `force`                | F_lab  | N    | of the plate on the foot                    |
//! | `moment`               | M₀     | N.m  | about the origin of the axes                |
//! | `center_of_pressure`   | p      | m    | on the surface                              |
//! | `free_moment`          | T      | N.m  | about the normal through p                  |
//!
//! Derived from R M = (p - C) × R F + T n with (p - C) · n = 0.
//! A foot cannot pull a plate, so the load acts along n: if it acts in the opposite direction, the file has
//! the force of the foot on the plate, and all signs are reversed.
//! Pinned by: tests/force_plate.rs, tests/laboratory_files.rs

mod baseline;
mod body_weight;
mod c3d;
mod clipping;
mod decode;
mod kind;
mod reread;
mod standing;
mod surface;
pub(crate) mod units;

pub use body_weight::{ForceUnit, stepped_weight};
pub use c3d::{PlateError, plates_from_c3d};
pub use reread::CORNER_ORDERS;
pub use standing::standing_weight_n;

use crate::spatial::{Mat3, Vec3};

/// Below this vertical force the centre of pressure is undefined and a foot counts as unloaded [N].
pub const CENTER_OF_PRESSURE_LOAD_N: f64 = 20.0;

/// Forces and moments of one force plate. From a file they are in the axes of the laboratory;
/// [`PlateRecording::rotated`] rotates them to world axes.
#[derive(Debug, Clone, PartialEq)]
pub struct PlateRecording {
    /// Name: `plate 1`, counted from 1 in the order of the file.
    pub name: String,
    /// FORCE_PLATFORM:TYPE of the file.
    pub kind: u8,
    /// Times [s], strictly increasing.
    pub times: Vec<f64>,
    /// Force of the plate on the foot [N], one entry per time.
    pub force: Vec<Vec3>,
    /// Moment of the force about the origin of the axes [N.m].
    pub moment: Vec<Vec3>,
    /// Corners of the surface, in the order of the file [m].
    pub corners: [Vec3; 4],
    /// Unit normal of the surface, upward.
    pub up: Vec3,
    /// From the origin of the sensors to the centre of the surface [m]; zero where the file has moments about the
    /// centre.
    pub center_from_sensors: Vec3,
    /// Factors by which forces and moments of the file were multiplied, because its own unit cannot be right; `None`
    /// where it was used.
    pub assumed_units: Option<[f64; 2]>,
    /// Vertical force of the unloaded plate that was removed [N]; `None` if nothing was removed.
    pub baseline_n: Option<f64>,
    /// Times during which a channel was clipped: first and last time [s].
    pub clipped: Vec<[f64; 2]>,
}

/// Settings of [`plates_from_c3d`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PlateSettings {
    /// Whether the signal of the unloaded plate is removed.
    pub remove_baseline: bool,
}

impl Default for PlateSettings {
    fn default() -> PlateSettings {
        PlateSettings { remove_baseline: true }
    }
}

impl PlateRecording {
    /// The samples from one time to another, both included.
    #[must_use]
    pub fn within(self, [from_s, to_s]: [f64; 2]) -> PlateRecording {
        let first = self.times.partition_point(|time| *time < from_s);
        let end = self.times.partition_point(|time| *time <= to_s).max(first);
        let part = |values: &[Vec3]| values.get(first..end).unwrap_or(values).to_vec();
        let is_inside = |span: &[f64; 2]| span[1] >= from_s && span[0] <= to_s;
        PlateRecording {
            times: self.times.get(first..end).unwrap_or(&self.times).to_vec(),
            force: part(&self.force),
            moment: part(&self.moment),
            clipped: self.clipped.iter().copied().filter(is_inside).collect(),
            ..self
        }
    }

    /// Centre of the surface: the mean of its corners [m].
    #[must_use]
    pub fn center(&self) -> Vec3 {
        self.corners.iter().sum::<Vec3>() * 0.25
    }

    /// Force along the upward normal [N].
    #[must_use]
    pub fn vertical(&self, sample: usize) -> f64 {
        self.force[sample].dot(&self.up)
    }

    /// Whether the vertical force exceeds [`CENTER_OF_PRESSURE_LOAD_N`].
    #[must_use]
    pub fn is_loaded(&self, sample: usize) -> bool {
        self.vertical(sample) > CENTER_OF_PRESSURE_LOAD_N
    }

    /// Largest vertical force [N]; zero without samples.
    #[must_use]
    pub fn peak_n(&self) -> f64 {
        (0..self.times.len()).map(|i| self.vertical(i)).fold(0.0, f64::max)
    }

    /// Moment of the force about the centre of the surface [N.m].
    #[must_use]
    pub fn moment_about_center(&self, sample: usize) -> Vec3 {
        self.moment[sample] - self.center().cross(&self.force[sample])
    }

    /// Centre of pressure [m]; not a number while the plate is unloaded.
    #[must_use]
    pub fn center_of_pressure(&self, sample: usize) -> Vec3 {
        if !self.is_loaded(sample) {
            return Vec3::repeat(f64::NAN);
        }
        self.center() + self.up.cross(&self.moment_about_center(sample)) / self.vertical(sample)
    }

    /// Moment about the normal through the centre of pressure [N.m]; not a number while the plate is unloaded.
    #[must_use]
    pub fn free_moment(&self, sample: usize) -> f64 {
        let arm = self.center_of_pressure(sample) - self.center();
        self.up.dot(&(self.moment_about_center(sample) - arm.cross(&self.force[sample])))
    }

    /// Distance of a point from the nearest edge along the surface [m]; positive inside, negative outside.
    #[must_use]
    pub fn depth_inside(&self, point: Vec3) -> f64 {
        let center = self.center();
        let edge = |i: usize| {
            let (a, b) = (self.corners[i], self.corners[(i + 1) % 4]);
            let outward = (b - a).cross(&self.up).normalize();
            let outward = if outward.dot(&(a - center)) < 0.0 { -outward } else { outward };
            outward.dot(&(a - point))
        };
        (0..4).map(edge).fold(f64::INFINITY, f64::min)
    }

    /// The same measurements in rotated axes: `world_from_lab * v`.
    #[must_use]
    pub fn rotated(&self, world_from_lab: &Mat3) -> PlateRecording {
        let turn = |vectors: &[Vec3]| vectors.iter().map(|v| world_from_lab * v).collect();
        PlateRecording {
            force: turn(&self.force),
            moment: turn(&self.moment),
            corners: self.corners.map(|c| world_from_lab * c),
            up: world_from_lab * self.up,
            center_from_sensors: world_from_lab * self.center_from_sensors,
            ..self.clone()
        }
    }
}
