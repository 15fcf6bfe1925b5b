//! Settings of a dynamically consistent walk: costs of deviations, resolution of the splines, properties of the shoes.

use crate::contact::HuntCrossley;
use crate::toml_reader::TomlError;

/// The deviation of each quantity that has a cost of one. A smaller deviation is a larger cost.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Deviations {
    /// Hip, knee and ankle from the curves of the gait [rad].
    pub joints: [f64; 3],
    /// Their accelerations [rad/s²].
    pub joint_acceleration: f64,
    /// Toes from lying flat in late stance [rad].
    pub toes: f64,
    /// Tilt of the pelvis [rad].
    pub pelvis: f64,
    /// Lean of the trunk [rad].
    pub trunk: f64,
    /// Their accelerations [rad/s²].
    pub trunk_acceleration: f64,
    /// Vertical and fore-aft force of a foot [body weights].
    pub ground_force: [f64; 2],
    /// Force under the toes [body weights].
    pub toe_force: f64,
    /// Rate of hip, knee and ankle moment [N.m/kg per cycle].
    pub moment_rate: f64,
    /// Residual force, fore-aft and up [body weights].
    pub root_force: f64,
    /// Residual moment [body weights × leg length].
    pub root_moment: f64,
    /// Slip of a loaded sole [m/s].
    pub slip: f64,
    /// Depth of a swinging sole below its clearance [m].
    pub clearance: f64,
    /// Extension of the knee beyond its least flexion [rad].
    pub knee_extension: f64,
}

/// Settings of [`make_consistent_walk`](super::make_consistent_walk).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ConsistentWalkSettings {
    /// Contact law of the soles.
    pub shoes: HuntCrossley,
    /// Deviations with a cost of one each.
    pub deviations: Deviations,
    /// Number of splines per cycle for each joint of the leg, and per half cycle for root and trunk.
    pub splines: [usize; 2],
    /// Instants in half a cycle.
    pub instants: usize,
    /// Smallest height of heel, ball and toes in swing [m].
    pub clearance: f64,
    /// Least flexion of the knee [rad]: people who walk do not hyperextend it.
    pub least_knee_flexion: f64,
}

const DEGREE: f64 = std::f64::consts::PI / 180.0;

impl Default for ConsistentWalkSettings {
    fn default() -> Self {
        ConsistentWalkSettings {
            shoes: HuntCrossley::SOFT_SHOES,
            deviations: Deviations {
                joints: [2.0 * DEGREE, 3.0 * DEGREE, 2.0 * DEGREE],
                joint_acceleration: 30.0,
                toes: 8.0 * DEGREE,
                pelvis: 1.0 * DEGREE,
                trunk: 1.0 * DEGREE,
                trunk_acceleration: 3.0,
                ground_force: [0.02, 0.01],
                toe_force: 0.15,
                moment_rate: 3.0,
                root_force: 0.002,
                root_moment: 0.0007,
                slip: 0.005,
                clearance: 0.002,
                knee_extension: 0.5 * DEGREE,
            },
            splines: [48, 18],
            instants: 96,
            clearance: 0.008,
            least_knee_flexion: 1.5 * DEGREE,
        }
    }
}

/// Why a dynamically consistent walk could not be computed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ConsistentWalkError {
    /// The model lacks a coordinate.
    #[error("the model has no coordinate `{name}`; expected a figure of `model::anthropometry`")]
    Coordinate {
        /// Its name.
        name: String,
    },
    /// The built-in ground force laws could not be read.
    #[error(transparent)]
    Laws(#[from] TomlError),
}
