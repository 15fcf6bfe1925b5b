//! Hip centres by regression on the size of the pelvis and the legs.
//!
//! Position of the right hip centre from the point midway between the markers of the anterior spines, in axes through
//! the spines: x forward, y up, z to the right; x and z lie in the plane of the spines. The left one is mirrored.
//!
//! | choice | x | y | z | source |
//! |---|---|---|---|---|
//! | `harrington` | -0.24 D - 9.9 mm | -0.30 W - 10.9 mm | 0.33 W + 7.3 mm | Harrington et al. 2007, J Biomech 40:595 |
//! | `hara` | -0.063 L + 11 mm - r | -0.078 L - 9 mm | 0.086 L + 8 mm | Hara et al. 2016, Sci Rep 6:37707 |
//! | `bell` | -0.19 W | -0.30 W | 0.36 W | Bell et al. 1989 and 1990 |
//! | `plug-in-gait` | C cos θ sin β - (A + r) cos β | -C cos θ cos β - (A + r) sin β | W/2 - C sin θ | Davis et al. 1991 |
//!
//! | code | symbol | unit |
//! |---|---|---|
//! | `width` | W, between the anterior spines; for `plug-in-gait` as stated, if it is | m |
//! | `depth` | D, from midway between the anterior to midway between the posterior spines | m |
//! | `legs` | L, anterior spine to medial malleolus | m |
//! | `trochanters` | A, anterior spine to greater trochanter along x; 0.1288 L - 48.56 mm if it was not measured | m |
//! | `radius` | r, of a marker | m |
//! | | C = 0.115 mean(L) - 15.3 mm; β = 0.314 rad; θ = 0.5 rad | |
//!
//! The numbers are those of the open implementations in pyCGM2 (`Model/modelDecorator.py`: Harrington's equations on
//! one measure each, Hara, Davis) and in Visual3D's documentation ("Hip Joint Landmarks": Bell; "Helen Hayes (Davis)
//! Pelvis": Davis); the papers themselves were not opened. Harrington's and Bell's equations are used without the
//! radius of the markers.
//!
//! Expected error, the mean distance from imaged hip centres: Harrington 13 mm and functional methods 11 mm with skin
//! markers (Fiorentino et al. 2016, Ann Biomed Eng 44:2168, 11 adults, dual fluoroscopy), Bell 20 mm (Kutschke and
//! Fiorentino 2015, 5 adults, by the same method), Davis 25 mm (Mantovani et al. 2016, Gait Posture 44:48, 67 adults,
//! computed tomography; there Harrington 12 mm); abstracts opened. Hara 8 mm on bones without skin, the root of the sum
//! of the squared errors along the axes in the cross-validation (5.2, 4.4 and 3.8 mm).
//! Pinned by: tests/hip_centres.rs

use crate::model::{BySide, Side};
use crate::numerics::elementary::sin_cos;
use crate::spatial::Vec3;
use serde::Deserialize;

/// β and θ of Davis 1991, as Plug-in-Gait rounds them [rad].
const BETA: f64 = 0.314;
const THETA: f64 = 0.5;

/// How the centres of the hips follow from the markers of the pelvis.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum HipRegression {
    /// Harrington 2007, from width and depth of the pelvis.
    #[default]
    Harrington,
    /// Hara 2016, from the length of the leg.
    Hara,
    /// Bell 1990, from the width of the pelvis.
    Bell,
    /// Davis 1991, as in Plug-in-Gait.
    PlugInGait,
}

/// Lengths that the regressions use [m].
#[derive(Debug, Clone, Copy)]
pub(super) struct PelvisSize {
    /// Between the anterior spines.
    pub(super) width: f64,
    /// The same as it was stated, for Plug-in-Gait, which prefers it.
    pub(super) stated_width: Option<f64>,
    /// From midway between the anterior spines to midway between the posterior ones.
    pub(super) depth: f64,
    /// From the anterior spine to the medial malleolus.
    pub(super) legs: BySide<f64>,
    /// From the anterior spine back to the greater trochanter.
    pub(super) trochanters: BySide<Option<f64>>,
    /// Radius of a marker.
    pub(super) radius: f64,
}

impl HipRegression {
    /// The choices with their names.
    pub const ALL: [(&'static str, HipRegression); 4] = [
        ("harrington", HipRegression::Harrington),
        ("hara", HipRegression::Hara),
        ("bell", HipRegression::Bell),
        ("plug-in-gait", HipRegression::PlugInGait),
    ];

    /// The name.
    #[must_use]
    pub fn word(self) -> &'static str {
        HipRegression::ALL.iter().find(|(_, choice)| *choice == self).map_or("", |(word, _)| word)
    }

    /// Mean distance from the hip centre of an image [m].
    pub(super) fn expected_error_m(self) -> f64 {
        match self {
            HipRegression::Harrington => 0.013,
            HipRegression::Hara => 0.008,
            HipRegression::Bell => 0.020,
            HipRegression::PlugInGait => 0.025,
        }
    }

    /// Whether the length of the leg matters.
    pub(super) fn uses_legs(self) -> bool {
        matches!(self, HipRegression::Hara | HipRegression::PlugInGait)
    }

    /// The hip centre of a side from the point midway between the anterior spines, in axes through the spines [m].
    pub(super) fn centre(self, size: &PelvisSize, side: Side) -> Vec3 {
        let PelvisSize { width, depth, radius, .. } = *size;
        let leg = size.legs[side];
        let right = match self {
            HipRegression::Harrington => {
                Vec3::new(-0.24 * depth - 0.0099, -0.30 * width - 0.0109, 0.33 * width + 0.0073)
            }
            HipRegression::Hara => Vec3::new(-0.063 * leg + 0.011 - radius, -0.078 * leg - 0.009, 0.086 * leg + 0.008),
            HipRegression::Bell => Vec3::new(-0.19 * width, -0.30 * width, 0.36 * width),
            HipRegression::PlugInGait => davis(size, side),
        };
        if side == Side::Right { right } else { Vec3::new(right.x, right.y, -right.z) }
    }
}

/// As if on the right.
fn davis(size: &PelvisSize, side: Side) -> Vec3 {
    let [(sin_beta, cos_beta), (sin_theta, cos_theta)] = [BETA, THETA].map(sin_cos);
    let c = 0.115 * 0.5 * (size.legs.right + size.legs.left) - 0.0153;
    let trochanter = size.trochanters[side].unwrap_or(0.1288 * size.legs[side] - 0.04856);
    let back = trochanter + size.radius;
    Vec3::new(
        c * cos_theta * sin_beta - back * cos_beta,
        -c * cos_theta * cos_beta - back * sin_beta,
        0.5 * size.stated_width.unwrap_or(size.width) - c * sin_theta,
    )
}
