//! Human figures of any mass and height, from published tables of body segments.
//!
//! A figure moves in a plane but has three-dimensional segments: hinges about z, hips and shoulders at their width. All
//! coordinates zero is upright standing; the default of `pelvis_ty` is the leg length, so the soles touch the ground
//! y = 0. Body frames have their origin at the proximal joint (`pelvis`, or the `torso` that is the root: mid-hip) and
//! the axes of the world in that posture. Signs follow docs/CONVENTIONS.md.
//!
//! | body              | joint to its parent | coordinate                              |
//! |-------------------|---------------------|-----------------------------------------|
//! | `pelvis`          | ground              | `pelvis_tilt`, `pelvis_tx`, `pelvis_ty` |
//! | `torso` (+ head)  | omphalion           | `lumbar_extension`                      |
//! | `femur_s`         | hip                 | `hip_flexion_s`                         |
//! | `tibia_s`         | knee                | `knee_angle_s` (+ extension)            |
//! | `calcn_s`         | ankle               | `ankle_angle_s` (+ dorsiflexion)        |
//! | `toes_s`          | ball, if requested  | `mtp_angle_s` (+ extension)             |
//! | `humerus_s`       | shoulder            | `arm_flex_s`                            |
//! | `forearm_s` (+ hand) | elbow            | `elbow_flex_s`                          |
//!
//! Only de Leva's tables split the trunk (at the omphalion); with the others the root is `torso`, without lumbar joint,
//! and keeps the names `pelvis_...` of its coordinates.
//!
//! # Values that are not in the tables
//!
//! Lengths in % of stature H, masses in % of body mass.
//!
//! | quantity | faure-1997 | de-leva-* | dempster-winter |
//! |---|---|---|---|
//! | masses | Table 1; they sum to 99.97 and are renormalised to 100 | sum to 100.00 (male) and 99.99 (female, renormalised) | sum to 100.0 |
//! | thigh, shank | 24.5, 24.6 (Table 1) | mean lengths, joint centre to joint centre, / mean stature | 24.5, 24.6 (Drillis and Contini) |
//! | ankle height | 3.9 (Drillis and Contini) | 3.9 (the same) | 3.9 |
//! | neck | 8.3: the rest of the stature above a trunk of 28.7; its mass is included in the head (Dempster's head and neck: 8.1) | the rest: 4.3 (male), 7.5 (female) | head and neck 18.2 |
//! | foot length | 15.2 (Drillis and Contini); Table 1's 8.9 is neither this nor a height and is kept as the length of the cylinder of the foot, in its middle | mean length / mean stature | 15.2 |
//! | heel to ankle | 25 % of the foot: the ankle of Gait2392 is 49 mm in front of the rear of the calcaneus (1.80 m), soft tissue adds about 20 mm | the same | the same |
//! | heel to ball | 74 % of the foot (ball of foot length / foot length, US Army survey; unverified) | the same | the same |
//! | distance between hip centres, between shoulder centres | 9.3, 24.0 (Dumas 2007 as in HeiMan's `segment_lengths`); no effect on planar dynamics | the same | the same |
//! | shoulder height | top of the trunk | mid-hip to mid-shoulder | top of the trunk |
//! | hand | its mass is included in the lower arm (2.20) | own row, rigid with the forearm | own row, rigid with the forearm |
//! | head | cylinder 10.0 long below the vertex | vertex to mid-gonion below the vertex | mass at the ear canal, 92.6 high |
//! | inertia | uniform cylinders of 1050 kg/m³ at the paper's 80 kg and a stature of 1.80 m (both stature and density are assumed) | radii of gyration as printed | one printed radius, used about x and z; about the long axis the ratio of de Leva's male table; trunk: de Leva's ratio to hip-shoulder length |
//!
//! **Scaling.** Lengths and radii of spheres and cylinders are proportional to stature, masses to body mass; inertias
//! are therefore proportional to mass times stature squared, and at equal stature every force is proportional to mass.
//! The density of the figure is mass / stature³ times a constant.
//!
//! Sources: Faure, Debunne, Cani, Multon 1997, table 1. De Leva 1996, J Biomech 29:1223, table 4: radii and masses as
//! transcribed in BMClab/BMC, lengths as in R. Gurchiek's `deleva.m`, both read. Dempster as in Winter, table 4.1, read
//! in BMClab/BMC; Drillis and Contini 1966 as in Winter, figure 4.1 (unverified). Feet: see [`ContactSphere`].

mod de_leva;
mod dempster;
pub(super) mod dimensions;
mod faure;
mod figure;
pub(crate) mod foot;
mod proportions;
mod ranges;
mod table;

pub use dimensions::Dimensions;
pub use foot::{ContactSphere, SpherePart};
pub use table::{SegmentTable, UnknownTable};

use super::anatomy::Sole;
use super::{Model, ModelError, Side};
use crate::numerics::Shown;
use crate::spatial::{Inertia, InertiaError, Vec3};

/// Range of body masses [kg]: from infants to the heaviest persons who walk.
const MASS_RANGE: [f64; 2] = [2.0, 300.0];
/// Range of statures [m].
const HEIGHT_RANGE: [f64; 2] = [0.4, 2.5];
/// Range of mass / stature³ [kg/m³]: adults have 9 to 40, newborns 20 to 30.
const PONDERAL_RANGE: [f64; 2] = [5.0, 90.0];

/// Segment table, mass and stature of a figure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Build {
    /// Table of body segments.
    pub table: SegmentTable,
    /// Body mass [kg].
    pub mass: f64,
    /// Stature [m].
    pub height: f64,
    /// Whether the toes have a joint at the ball of the foot.
    pub toe_joint: bool,
}

/// Why a figure cannot be built.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum BuildError {
    /// An implausible mass.
    #[error("the body mass is {} kg; expected {min} to {max} kg", Shown(*found))]
    Mass {
        /// Requested mass [kg].
        found: f64,
        /// Smallest mass [kg].
        min: f64,
        /// Largest mass [kg].
        max: f64,
    },
    /// An implausible stature.
    #[error("the height is {} m; expected {min} to {max} m. hint: metres, not centimetres", Shown(*found))]
    Height {
        /// Requested stature [m].
        found: f64,
        /// Smallest stature [m].
        min: f64,
        /// Largest stature [m].
        max: f64,
    },
    /// A mass that is implausible at this stature.
    #[error("{mass} kg at {height} m; expected {min:.1} to {max:.1} kg at this height")]
    Thickness {
        /// Requested mass [kg].
        mass: f64,
        /// Requested stature [m].
        height: f64,
        /// Smallest mass [kg].
        min: f64,
        /// Largest mass [kg].
        max: f64,
    },
    /// A segment with an impossible inertia.
    #[error("a segment of the figure has an impossible inertia")]
    Segment(#[from] InertiaError),
    /// Parts that do not fit together.
    #[error("the parts of the figure do not fit together")]
    Model(#[from] ModelError),
}

/// A built-in figure: its model, soles and lengths.
#[derive(Debug, Clone)]
pub struct Human {
    /// Bodies, joints, coordinates with anatomical ranges, and markers at the joints.
    pub model: Model,
    /// Contact spheres: heel, ball, toe, right foot first.
    pub soles: Vec<ContactSphere>,
    /// Lengths [m].
    pub dimensions: Dimensions,
    /// Settings of the figure.
    pub build: Build,
}

impl Human {
    /// The sole of a foot, from its contact spheres.
    #[must_use]
    pub fn sole(&self, side: Side) -> Option<Sole> {
        Sole::of_spheres(&self.soles, side, 0.5 * self.dimensions.foot_width)
    }
}

/// Parts of trunk and forearm that may move on them.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Extremities {
    /// The joint between neck and trunk, in the trunk [m].
    pub(crate) neck: Vec3,
    /// Head and neck, relative to this joint.
    pub(crate) head: Inertia,
    /// Hand, relative to the wrist.
    pub(crate) hand: Inertia,
}

impl Build {
    /// The figure of a table in its usual size, with toe joints: for de Leva's and Winter's tables round numbers near
    /// the means of their subjects, for the 1997 paper 80 kg with the stature that completes its table.
    #[must_use]
    pub fn usual(table: SegmentTable) -> Build {
        let [mass, height] = match table {
            SegmentTable::DeLevaMale | SegmentTable::DempsterWinter => [75.0, 1.75],
            SegmentTable::DeLevaFemale => [60.0, 1.65],
            SegmentTable::Faure1997 => [80.0, 1.80],
        };
        Build { table, mass, height, toe_joint: true }
    }

    /// Builds the figure.
    ///
    /// # Errors
    /// An implausible mass, stature or combination of both.
    pub fn human(&self) -> Result<Human, BuildError> {
        self.check()?;
        let proportions = self.table.proportions();
        let dimensions = Dimensions::new(&proportions.lengths, self.height);
        let model = figure::model(self, &proportions, &dimensions)?;
        let soles = foot::soles(&model, &dimensions, self.toe_joint);
        Ok(Human { model, soles, dimensions, build: *self })
    }

    /// Head with neck, and a hand, which the figure has as parts of trunk and forearm.
    pub(crate) fn extremities(&self) -> Result<Extremities, BuildError> {
        let proportions = self.table.proportions();
        figure::extremities(self, &proportions, &Dimensions::new(&proportions.lengths, self.height))
    }

    fn check(&self) -> Result<(), BuildError> {
        let Build { mass, height, .. } = *self;
        if !within(mass, MASS_RANGE) {
            return Err(BuildError::Mass { found: mass, min: MASS_RANGE[0], max: MASS_RANGE[1] });
        }
        if !within(height, HEIGHT_RANGE) {
            return Err(BuildError::Height { found: height, min: HEIGHT_RANGE[0], max: HEIGHT_RANGE[1] });
        }
        let [min, max] = PONDERAL_RANGE.map(|density| density * height.powi(3));
        if !within(mass, [min, max]) {
            return Err(BuildError::Thickness {
                mass,
                height,
                min: min.max(MASS_RANGE[0]),
                max: max.min(MASS_RANGE[1]),
            });
        }
        Ok(())
    }
}

/// False for not-a-number.
fn within(value: f64, [min, max]: [f64; 2]) -> bool {
    (min..=max).contains(&value)
}
