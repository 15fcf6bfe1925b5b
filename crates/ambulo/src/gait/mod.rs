//! Synthetic walking: angles of the joints, with velocity and acceleration, from speed and style.
//!
//! Clinical signs throughout: hip flexion +, knee flexion +, ankle dorsiflexion +, pelvis tilt anterior +, trunk lean forward +,
//! shoulder and elbow flexion + [rad].

mod arms;
mod coordinates;
mod curve_check;
mod curve_table;
mod cyclic_curve;
mod error;
mod gait_file;
mod ground_force;
mod jet;
mod joint;
mod laws;
pub mod machine;
mod pace;
mod quintic;
mod request;
mod speed_law;
mod speed_plan;
mod stride;
mod style;
mod sub_cycle;
mod walk;
mod wave;

pub use arms::ArmCurves;
pub use coordinates::{COORDINATE_NAMES, Trunk, WalkCoordinates, coordinates};
pub use cyclic_curve::{CyclicCurve, Knot};
pub use error::GaitError;
pub use ground_force::GroundForceLaws;
pub use jet::Jet;
pub use joint::{Joint, STANDING_TILT};
pub use laws::{Laws, LegCurves, SupportLaw};
pub use quintic::{End, quintic};
pub use request::{Gait, KnotChange, Pace, Pelvis, Speed};
pub use speed_law::{GRAVITY, SpeedLaw, SpeedRange};
pub use speed_plan::{Clock, SpeedChange};
pub use stride::{
    ADULT_EXPONENT, CHILD_EXPONENT, EXPONENT_1997, REFERENCE_LEG, StrideLaw, WALKING_SPEEDS, walking_speeds,
};
pub use style::Style;
pub use sub_cycle::SubCycle;
pub use walk::{LegAngles, Phases, Walk, WalkPosture};
pub use wave::{Harmonic, Wave};
