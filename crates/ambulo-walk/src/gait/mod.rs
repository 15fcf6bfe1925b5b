//! Synthetic walking: joint angles with velocity and acceleration, from speed and style.
//!
//! A [`Gait`] has the settings of a walk, by name or from TOML (docs/GAITS.md). A [`Walk`] is a gait for a leg length;
//! [`Walk::at`] returns the posture at any time, and the speed may change while walking. Hierarchical state machines
//! ([`machine`]) give the same postures. [`coordinates`] converts a posture to coordinates of a model.
//!
//! Clinical signs throughout: hip flexion +, knee flexion +, ankle dorsiflexion +, pelvis tilt anterior +, trunk lean
//! forward +, shoulder and elbow flexion + [rad].
//!
//! Start reading at `cyclic_curve` (how the curve of a joint depends on phase and speed), then `walk`, `pace_plan`,
//! `stride`.
//!
//! ```
//! use ambulo_walk::findings::Findings;
//! use ambulo_walk::gait::{Gait, PaceChange, Walk};
//!
//! let mut findings = Findings::default();
//! let mut gait = Gait::named("free")?;
//! gait.pace_changes.push(PaceChange { start_s: 2.0, duration_s: Some(1.5), speed: Some(1.8), ..PaceChange::default() });
//! let walk = Walk::new(&gait, 0.92, &mut findings)?;
//! assert!((walk.speed() - walk.step_length() * 2.0 / walk.cycle_s()).abs() < 1e-12);
//! let knee = walk.at(2.6).right.knee;
//! println!("{:.1} deg, {:.2} rad/s, {:.1} rad/s²", knee.value.to_degrees(), knee.rate, knee.acceleration);
//! # Ok::<(), ambulo_walk::gait::GaitError>(())
//! ```

mod arms;
mod curve_check;
mod curve_table;
pub(crate) mod cyclic_curve;
mod ground_force;
mod jet;
mod joint;
mod joint_moments;
mod laws;
mod other_planes;
mod quintic;
mod speed_law;
mod sub_cycle;
mod wave;

mod coordinates;
mod error;
mod gait_file;
mod gait_settings;
pub mod machine;
mod pace;
mod pace_plan;
mod stride;
mod walk;

pub use coordinates::{COORDINATE_NAMES, Trunk, WalkCoordinates, coordinates};
pub use cyclic_curve::{CyclicCurve, Knot};
pub use error::GaitError;
pub use gait_settings::{Gait, JointChange, KnotChange, Pace, Pelvis, Speed, Style};
pub use ground_force::GroundForceLaws;
pub use jet::Jet;
pub use joint::{LegJoint, STANDING_TILT, WalkPart};
#[doc(hidden)]
pub use joint_moments::{JointMomentLaws, JointMoments};
pub use laws::{Laws, LegCurves};
#[doc(hidden)]
pub use other_planes::{OtherPlaneLaws, OtherPlanes};
pub use pace_plan::{Clock, PaceChange};
pub use quintic::{End, quintic};
#[doc(hidden)]
pub use speed_law::SpeedLaw;
pub use speed_law::{GRAVITY, SpeedRange};
pub(crate) use stride::FREE_SPEED;
pub use stride::{
    ADULT_EXPONENT, CHILD_EXPONENT, EXPONENT_1997, REFERENCE_LEG, StrideLaw, WALKING_SPEEDS, walking_speeds,
};
#[doc(hidden)]
pub use sub_cycle::SubCycle;
pub use walk::{LegAngles, Phases, Walk};
#[doc(hidden)]
pub use walk::{PaceRamp, WalkPosture};
pub use wave::Wave;
