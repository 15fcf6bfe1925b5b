//! Whether a person could do this: joint moments against strength, friction, centre of pressure, flight, sliding, joint
//! limits, power, and forces that nobody supplies.
//!
//! [`check`] judges a whole recording or synthetic walk, whoever made it, and yields a [`Verdict`]; [`check_frame`] measures
//! one instant without allocating. An infeasible motion is a result, not an error. Defaults, their sources and the file
//! format of [`Thresholds`]: docs/FEASIBILITY.md.

mod frame;
mod ground_speed;
mod judgement;
mod person;
mod spans;
mod strength;
mod thresholds;
mod verdict;

pub use frame::{FootFrame, Frame, Judge, Measured, Measurement, check_frame, least_load_n};
pub use judgement::{Evidence, check};
pub use person::Person;
pub use strength::{Hill, StrengthCurve};
pub use thresholds::Thresholds;
pub use verdict::{Check, Closest, NotJudged, Reason, Verdict};

pub(super) use ground_speed::over_ground;
