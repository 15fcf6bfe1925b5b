//! Known measurements of a person, in addition to the markers.

use crate::model::Side;
use crate::model::anthropometry::SegmentTable;

/// Mass, stature and measurements of the person whose body is calibrated.
#[derive(Debug, Clone, PartialEq)]
pub struct PersonMeasurements {
    /// Table of the segment masses.
    pub table: SegmentTable,
    /// Body mass [kg].
    pub mass: f64,
    /// Stature [m]; estimated from the legs if unknown.
    pub height: Option<f64>,
    /// Measurements of the body.
    pub measures: Measures,
}

/// Measurements of a body [m], right before left; `None` if not measured.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Measures {
    /// Radius of the markers.
    pub marker_radius: Option<f64>,
    /// Breadth of the knee between its epicondyles.
    pub knee_width: [Option<f64>; 2],
    /// Breadth of the ankle between its malleoli.
    pub ankle_width: [Option<f64>; 2],
    /// Breadth of the elbow between its epicondyles.
    pub elbow_width: [Option<f64>; 2],
    /// Acromion marker to the height of the shoulder centre, downwards, without the marker's radius.
    pub shoulder_offset: [Option<f64>; 2],
}

/// Default radius of a marker [m]: the usual diameter is 14 mm.
pub(super) const MARKER_RADIUS: f64 = 0.007;

impl Measures {
    /// From parameters with the names and units that Vicon's programs write into the group PROCESSING: `MarkerDiameter`,
    /// `RKneeWidth`, `LAnkleWidth`, ... in mm. Zeros mean that nothing was measured.
    #[must_use]
    pub fn from_processing(parameter_mm: impl Fn(&str) -> Option<f64>) -> Measures {
        let metres = |name: &str| parameter_mm(name).filter(|v| *v > 0.0 && v.is_finite()).map(|v| 0.001 * v);
        let both = |stem: &str| ["R", "L"].map(|side| metres(&format!("{side}{stem}")));
        Measures {
            marker_radius: metres("MarkerDiameter").map(|d| 0.5 * d),
            knee_width: both("KneeWidth"),
            ankle_width: both("AnkleWidth"),
            elbow_width: both("ElbowWidth"),
            shoulder_offset: both("ShoulderOffset"),
        }
    }

    /// Radius of the markers, the usual one if nothing is known [m].
    pub(super) fn radius(&self) -> f64 {
        self.marker_radius.unwrap_or(MARKER_RADIUS)
    }
}

/// One of a pair.
pub(super) fn of<T: Copy>(pair: &[T; 2], side: Side) -> T {
    pair[index(side)]
}

/// Right before left.
pub(super) fn index(side: Side) -> usize {
    usize::from(side == Side::Left)
}
