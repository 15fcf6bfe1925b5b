//! The size of the person whose body is drawn.

use super::joint_places::JointPlaces;
use ambulo::model::anthropometry::{Build, Dimensions, SegmentTable};

/// Statures that the tables of segments allow [m].
const HEIGHTS: [f64; 2] = [0.4, 2.5];
/// Mass over stature cubed of 73 kg and 1.74 m; lengths do not depend on it [kg/m³].
const PONDERAL: f64 = 13.9;

/// Lengths of a person of this stature [m] from de Leva's table, for parts that a model lacks.
pub(super) fn lengths(stature: f64) -> Option<Dimensions> {
    let height = stature.clamp(HEIGHTS[0], HEIGHTS[1]);
    let build = Build { table: SegmentTable::DeLevaMale, mass: PONDERAL * height.powi(3), height, toe_joint: true };
    build.human().ok().map(|human| human.dimensions)
}

/// Stature [m]: the known stature, otherwise estimated from the legs, otherwise from the mass.
pub(super) fn stature(places: &JointPlaces<'_>, known_m: Option<f64>) -> f64 {
    let known = known_m.filter(|height| height.is_finite() && *height > 0.0);
    known.unwrap_or_else(|| places.model.stature().height_m)
}
