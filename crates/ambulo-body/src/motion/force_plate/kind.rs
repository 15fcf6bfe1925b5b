//! Types of force plates: converts channels to a wrench about the centre of the surface.
//!
//! Everything is in the axes of the plate: x from corners 2 and 3 to corners 1 and 4, y from corners 3 and 4 to corners
//! 1 and 2, z = x × y, which points down in a plate in the floor. F is the force **on the foot**, M its moment about
//! the centre of the surface, c the channels.
//!
//! | type | channels | F | M |
//! |---|---|---|---|
//! | 1 | Fx Fy Fz px py Tz | c₁ c₂ c₃ | (px, py, 0) × F + (0, 0, Tz) |
//! | 2 | Fx Fy Fz Mx My Mz | c₁ c₂ c₃ | (c₄, c₅, c₆) + F × o |
//! | 3 | Fx12 Fx34 Fy14 Fy23 Fz1 Fz2 Fz3 Fz4 | sums | Σ rᵢ × fᵢ + F × (0, 0, o₃) |
//! | 4 | as 2, before a 6 x 6 matrix | | |
//! | 5 | 8 channels before a 6 x 8 matrix that gives those of 2 | | |
//! | 6 | Fx1 Fy1 Fz1 ... Fz4 after a 12 x 12 matrix | sums | as 3 |
//! | 7 | as 3, before an 8 x 8 matrix | | |
//!
//! o is ORIGIN: for types 2, 4, 5 it leads from the origin of the sensors to the centre of the surface, so that
//! M = M_sensor + F × o, and o₃ is negative where the sensors lie below the surface. For types 3, 6, 7 o₁ and o₂ are
//! half the distances between the sensors along x and y: sensor 1 is at (o₁, o₂), 2 at (-o₁, o₂), 3 at (-o₁, -o₂), 4 at
//! (o₁, -o₂), and o₃ is the height of the surface above them, again negative. Many programs write o with the opposite
//! sign, which is detected by o₃ > 0.
//!
//! Source: C3D User Guide (Motion Lab Systems), pages on FORCE_PLATFORM:TYPE, ORIGIN, CHANNEL, CAL_MATRIX at c3d.org;
//! types 3, 5, 6, 7: Visual3D's pages on FP_TYPE; type 5 as well: BTK's `ForcePlatformType5`. The moments are derived
//! from M = Σ r × f. Visual3D's page on type 7 has other signs (Mz with +Fy23), which no rigid plate has.
//! Pinned by: tests/force_plate.rs

use crate::spatial::{Vec3, Wrench};

/// Meaning of the channels of a plate: `FORCE_PLATFORM:TYPE`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum PlateKind {
    /// Type 1: force, centre of pressure, free moment.
    Point,
    /// Types 2, 4, 5: force and moment at the sensor's origin.
    Wrench,
    /// Types 3, 7: eight channels of a plate on four sensors.
    EightForces,
    /// Type 6: twelve forces of a plate on four sensors.
    TwelveForces,
}

/// Channels and matrix of a type.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Layout {
    pub(super) kind: PlateKind,
    /// Number of channels.
    pub(super) channels: usize,
    /// Rows of the calibration matrix, if the type has one.
    pub(super) matrix_rows: Option<usize>,
}

impl Layout {
    /// The layout of a type; `None` for types that are not documented.
    pub(super) fn of_type(number: u8) -> Option<Layout> {
        let layout = |kind, channels, matrix_rows| Some(Layout { kind, channels, matrix_rows });
        match number {
            1 => layout(PlateKind::Point, 6, None),
            2 => layout(PlateKind::Wrench, 6, None),
            3 => layout(PlateKind::EightForces, 8, None),
            4 => layout(PlateKind::Wrench, 6, Some(6)),
            5 => layout(PlateKind::Wrench, 8, Some(6)),
            6 => layout(PlateKind::TwelveForces, 12, Some(12)),
            7 => layout(PlateKind::EightForces, 8, Some(8)),
            _ => None,
        }
    }
}

/// SI values of the units in the file.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Units {
    /// Force [N].
    pub(super) force_n: f64,
    /// Moment [N.m].
    pub(super) moment_nm: f64,
    /// Length of a centre of pressure [m].
    pub(super) length_m: f64,
}

impl PlateKind {
    /// Force on the foot [N] and its moment about the centre of the surface [N.m], in the plate's axes. `channels` are
    /// calibrated, in the file's units; `origin` is ORIGIN with its third component negative [m].
    pub(super) fn wrench(self, channels: &[f64], origin: Vec3, units: Units) -> Wrench {
        let at = |i: usize| channels.get(i).copied().unwrap_or(0.0);
        let triple = |i: usize| Vec3::new(at(i), at(i + 1), at(i + 2));
        match self {
            PlateKind::Point => {
                let force = triple(0) * units.force_n;
                let point = Vec3::new(at(3), at(4), 0.0) * units.length_m;
                // An unloaded plate may have no point.
                let arm = if point.iter().all(|x| x.is_finite()) { point } else { Vec3::zeros() };
                Wrench { force, moment: arm.cross(&force) + Vec3::z() * (at(5) * units.moment_nm) }
            }
            PlateKind::Wrench => {
                let force = triple(0) * units.force_n;
                Wrench { force, moment: triple(3) * units.moment_nm + force.cross(&origin) }
            }
            PlateKind::EightForces => {
                // Two sensors share a shear channel; only sums enter, so each gets half of it.
                let half = |i: usize| 0.5 * at(i);
                let sensors = [
                    Vec3::new(half(0), half(2), at(4)),
                    Vec3::new(half(0), half(3), at(5)),
                    Vec3::new(half(1), half(3), at(6)),
                    Vec3::new(half(1), half(2), at(7)),
                ];
                on_four_sensors(sensors.map(|f| f * units.force_n), origin)
            }
            PlateKind::TwelveForces => on_four_sensors([0, 3, 6, 9].map(|i| triple(i) * units.force_n), origin),
        }
    }

    /// From the origin of the sensors to the centre of the surface [m], in the plate's axes: o in M = M_sensors + F ×
    /// o.
    pub(super) fn lever(self, origin: Vec3) -> Vec3 {
        match self {
            PlateKind::Point => Vec3::zeros(),
            PlateKind::Wrench => origin,
            PlateKind::EightForces | PlateKind::TwelveForces => Vec3::z() * origin.z,
        }
    }

    /// Whether a channel is a coordinate, which has no offset to be removed.
    pub(super) fn is_coordinate(self, channel: usize) -> bool {
        self == PlateKind::Point && (3..5).contains(&channel)
    }

    /// Whether ORIGIN has the positions of four sensors.
    pub(super) fn has_four_sensors(self) -> bool {
        matches!(self, PlateKind::EightForces | PlateKind::TwelveForces)
    }
}

/// Σ fᵢ and Σ rᵢ × fᵢ + F × (0, 0, o₃).
fn on_four_sensors(forces: [Vec3; 4], origin: Vec3) -> Wrench {
    let (a, b) = (origin.x, origin.y);
    let places = [Vec3::new(a, b, 0.0), Vec3::new(-a, b, 0.0), Vec3::new(-a, -b, 0.0), Vec3::new(a, -b, 0.0)];
    let force: Vec3 = forces.iter().sum();
    let moment: Vec3 = places.iter().zip(&forces).map(|(r, f)| r.cross(f)).sum();
    Wrench { force, moment: moment + force.cross(&(Vec3::z() * origin.z)) }
}
