//! How a walk is made consistent: what a deviation costs, how fine the splines are, what the shoes are made of.

use crate::contact::{FrictionCurve, HuntCrossley};

/// Deviations that count one each. Smaller means dearer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Deviations {
    /// Hip, knee and ankle against the gait's curves [rad].
    pub joints: [f64; 3],
    /// Their accelerations [rad/s²].
    pub joint_acceleration: f64,
    /// Toes against lying flat in late stance [rad].
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
    /// Rate of hip, knee and ankle moment [N.m/kg a cycle].
    pub moment_rate: f64,
    /// Force that the root lacks, fore-aft and up [body weights].
    pub root_force: f64,
    /// Moment that the root lacks [body weights × leg length].
    pub root_moment: f64,
    /// Slip of a loaded sole [m/s].
    pub slip: f64,
    /// A swinging sole below its clearance [m].
    pub clearance: f64,
}

/// How a walk is made consistent.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ConsistentWalkSettings {
    /// The soles.
    pub shoes: HuntCrossley,
    /// Deviations that count one each.
    pub deviations: Deviations,
    /// Splines a cycle for each joint of the leg, and half a cycle for root and trunk.
    pub splines: [usize; 2],
    /// Instants in half a cycle.
    pub instants: usize,
    /// Least height of heel, ball and toes in swing [m].
    pub clearance: f64,
}

const DEGREE: f64 = std::f64::consts::PI / 180.0;

impl Default for ConsistentWalkSettings {
    fn default() -> Self {
        ConsistentWalkSettings {
            shoes: SOFT_SHOES,
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
            },
            splines: [48, 18],
            instants: 96,
            clearance: 0.008,
        }
    }
}

/// Soft shoes: stiffness as OpenSim Moco's `2D_gait.osim`, dissipation 2 s/m as there and in Falisse 2022; friction 0.6. Creep
/// of 13 mm/s at full friction is ours: much slower than theirs (0.2 m/s), so that a standing foot stays where it is.
pub const SOFT_SHOES: HuntCrossley = HuntCrossley {
    static_friction: 0.6,
    dynamic_friction: 0.6,
    viscous_friction: 0.0,
    transition_velocity: 0.013,
    depth_offset: 0.0,
    friction_curve: FrictionCurve::Smooth,
    ..HuntCrossley::MOCO_2D_GAIT
};
