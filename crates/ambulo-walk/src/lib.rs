//! Walking without a recording: gaits, optimal motion, and figures in a simulated world.
//!
//! The crate `ambulo` contains these modules; most programs depend on it alone.
//!
//! | module | duty |
//! |---|---|
//! | [`gait`] | joint curves against phase and speed, steps, state machines |
//! | [`optimal`] | motions that obey mechanics and cost little |
//! | [`figure_shape`] | the solids of a person: how bodies look, and where they touch the ground |
//! | [`engine`] | worlds of rigid bodies, stepped through time |
//! | [`walking`], [`consistent_walk`] | figures that walk in a world, and walks without outside forces |
//! | [`control`], [`tuning`] | figures that walk by their own torques, and the search for their gains |
//! | [`scene`] | worlds from files |
//! | [`synthetic`] | from a gait and a body size to motion and ground forces |

#[doc(no_inline)]
pub use ambulo_body::{contact, dynamics, findings, kinematics, model, motion, numerics, spatial, toml_reader};

pub mod figure_shape;

pub mod gait;

pub mod optimal;

pub mod engine;

pub mod consistent_walk;
pub mod walking;

pub mod control;

pub mod scene;

pub mod synthetic;
pub mod tuning;

/// For the tests of this crate.
#[doc(hidden)]
pub mod internals {
    pub use crate::control::activation::activated;
    pub use crate::control::figure::FigureWorld;
    pub use crate::control::linear::{DIFFERENCES, Impedance, with_impedances};
    pub use crate::control::plan::{CyclePlan, PlannedStep, Root};
    pub use crate::control::riccati::{Costs, StepMap};
    pub use crate::engine::joint::MOST;
    pub use crate::engine::signal::Instant as SignalInstant;
    pub use crate::gait::cyclic_curve::SteadyCurve;
    pub use crate::optimal::effort::tissue_of;
    pub use crate::optimal::instant::{Contact, Evaluator, Instant};
    pub use crate::optimal::layout::mirror;
    pub use crate::optimal::objective::Row;
    pub use crate::optimal::predict::flatter_slopes;
    pub use crate::optimal::problem::Stage;
    pub use crate::optimal::refine::Newton;
    pub use crate::optimal::walk::passage::coefficient;
    pub use crate::tuning::gain::rounded;
    pub use crate::tuning::outcome::Sums;
    pub use crate::walking::slip::stances;
}
