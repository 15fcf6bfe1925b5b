//! The body and its mechanics: models, recorded motion, kinematics, contact and dynamics.
//!
//! The crate `ambulo` contains these modules under the same names; most programs depend on it alone.
//!
//! | module | duty |
//! |---|---|
//! | [`findings`] | warnings and notes about unusual input |
//! | [`numerics`], [`spatial`] | splines, equations and random numbers; poses, twists, wrenches and inertias |
//! | [`toml_reader`] | TOML files, with errors that have line and key |
//! | [`model`] | bodies, joints, coordinates, markers and anatomy |
//! | [`motion`] | recordings of markers, coordinates, skeletons, force plates and sensors |
//! | [`kinematics`] | from markers to coordinates, and from coordinates to the motion of all bodies |
//! | [`contact`] | contact points, friction, rigid and compliant laws |
//! | [`dynamics`] | inverse dynamics, and bodies under constraints |

/// Readers and writers of files, so that one dependency is enough.
pub use ambulo_formats as formats;

pub mod findings;
pub mod numerics;
pub mod spatial;
pub mod toml_reader;

pub mod model;
pub mod motion;

pub mod kinematics;

pub mod contact;

pub mod dynamics;

/// For the tests of this crate.
#[doc(hidden)]
pub mod internals {
    use crate::dynamics::GraphWorkspace;
    use crate::numerics::Cma;

    pub use crate::contact::height_field::HeightField;
    pub use crate::contact::polytope::Polytope;
    pub use crate::contact::separating_axis::{CUTTING, Cut, Line, VERTEX, cut_polygon};
    pub use crate::dynamics::block::transport;
    pub use crate::dynamics::residual_reduction::bordered::BorderedSystem;
    pub use crate::kinematics::calibration::axes::{about_x, about_y, about_z};
    pub use crate::kinematics::calibration::legs::{bending_axis, chord};
    pub use crate::kinematics::marker_fit::branch_matrix::Branches;
    pub use crate::kinematics::marker_fit::gaps::{Determination, bridge_gaps, fill_gap};
    pub use crate::kinematics::marker_fit::rows::MarkerRows;
    pub use crate::kinematics::pose_fit::joint_angles::{JointAngles, turn_about};
    pub use crate::model::marker_set::name_index::{NameIndex, Readings, RecordedName};
    pub use crate::model::subject_shape::{SegmentShape, SolePlacement, SubjectShape, reshaped};
    pub use crate::motion::force_plate::units::{INCH_M, KILOPOND_N, POUND_N, moment_nm};
    pub use crate::motion::skeleton::channel_angles::{angle_between, angles, rotation};
    pub use crate::numerics::dense::DenseLu;
    pub use crate::numerics::sin_cos::sin_cos;

    /// The same search with another step size.
    #[must_use]
    pub fn with_sigma(cma: &Cma, sigma: f64) -> Cma {
        let mut other = cma.clone();
        other.sigma = sigma;
        other
    }

    /// The same search with another evolution path of the covariance.
    #[must_use]
    pub fn with_path(cma: &Cma, path: Vec<f64>) -> Cma {
        let mut other = cma.clone();
        other.path = path;
        other
    }

    /// Whether the last solution merged the bodies that follow others.
    #[must_use]
    pub fn is_lumped(workspace: &GraphWorkspace) -> bool {
        workspace.is_lumped
    }
}
