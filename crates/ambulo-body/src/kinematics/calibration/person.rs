//! Data of a person other than markers.

use super::hip_centre::HipRegression;
use crate::model::BySide;
use crate::model::anthropometry::SegmentTable;
use crate::spatial::Vec3;
use serde::Deserialize;

/// Data for calibrating a body: segment table, mass, stature and body measurements.
#[derive(Debug, Clone, PartialEq)]
pub struct PersonMeasurements {
    /// Table of segment masses.
    pub table: SegmentTable,
    /// Body mass [kg].
    pub mass: f64,
    /// Stature [m]; `None` estimates it from the legs.
    pub height: Option<f64>,
    /// Widths measured on the body.
    pub measurements: BodyMeasurements,
}

/// Measurements of a body [m]; `None` if not measured.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct BodyMeasurements {
    /// Radius of the markers.
    pub marker_radius: Option<f64>,
    /// Width of the knee between its epicondyles.
    pub knee_width: BySide<Option<f64>>,
    /// Width of the ankle between its malleoli.
    pub ankle_width: BySide<Option<f64>>,
    /// Width of the elbow between its epicondyles.
    pub elbow_width: BySide<Option<f64>>,
    /// Vertical distance from the acromion marker down to the shoulder centre, without the radius of the marker.
    pub shoulder_offset: BySide<Option<f64>>,
    /// Length of the leg from the anterior spine to the medial malleolus.
    pub leg_length: BySide<Option<f64>>,
    /// Between the anterior spines.
    pub asis_width: Option<f64>,
    /// From the anterior spine back to the greater trochanter.
    pub asis_trochanter: BySide<Option<f64>>,
    /// Where centres and axes of joints come from.
    pub joints: JointCentres,
}

/// Where the axes of the knees of the built-in body come from.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum KneeAxis {
    /// The markers of the epicondyles or the wand.
    #[default]
    Markers,
    /// The markers, turned about the long axis of the thigh so that varus follows flexion least in the motion.
    LeastCrossTalk,
}

impl KneeAxis {
    /// The choices with their names.
    pub const ALL: [(&'static str, KneeAxis); 2] =
        [("markers", KneeAxis::Markers), ("least-cross-talk", KneeAxis::LeastCrossTalk)];

    /// The name.
    #[must_use]
    pub fn word(self) -> &'static str {
        KneeAxis::ALL.iter().find(|(_, choice)| *choice == self).map_or("", |(word, _)| word)
    }
}

/// Where centres and axes of joints come from, apart from the markers of the trial that calibrates the body.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct JointCentres {
    /// The regression of the hip centres.
    pub hip: HipRegression,
    /// Hip centres that a movement showed: forward, up and right from midway between the markers of the anterior
    /// spines, in axes through the spines [m].
    pub hips: BySide<Option<Vec3>>,
    /// How the axes of the knees are found where no turn is given.
    pub knee_axis: KneeAxis,
    /// Turns of the knee axes about the long axis of the thigh, from the axis that the markers show [rad].
    pub knees: BySide<Option<f64>>,
}

/// Default radius of a marker [m]: the usual diameter is 14 mm.
pub(super) const MARKER_RADIUS: f64 = 0.007;

impl BodyMeasurements {
    /// Reads parameters with the names and units that Vicon's programs write into the group PROCESSING:
    /// `MarkerDiameter`, `RKneeWidth`, `LAnkleWidth`, ... in mm. Zero means not measured.
    #[must_use]
    pub fn from_processing(parameter_mm: impl Fn(&str) -> Option<f64>) -> BodyMeasurements {
        let metres = |name: &str| parameter_mm(name).filter(|v| *v > 0.0 && v.is_finite()).map(|v| 0.001 * v);
        let both = |stem: &str| BySide::from(["R", "L"].map(|side| metres(&format!("{side}{stem}"))));
        BodyMeasurements {
            marker_radius: metres("MarkerDiameter").map(|d| 0.5 * d),
            knee_width: both("KneeWidth"),
            ankle_width: both("AnkleWidth"),
            elbow_width: both("ElbowWidth"),
            shoulder_offset: both("ShoulderOffset"),
            leg_length: both("LegLength"),
            asis_width: metres("InterAsisDistance"),
            asis_trochanter: both("AsisTrocanterDistance"),
            joints: JointCentres::default(),
        }
    }

    /// Radius of the markers, or the default [m].
    pub(super) fn radius(&self) -> f64 {
        self.marker_radius.unwrap_or(MARKER_RADIUS)
    }
}
