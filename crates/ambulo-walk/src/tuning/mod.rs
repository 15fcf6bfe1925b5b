//! Gains of a controller found by trial: settings that survive more pushes and stay nearer to the plan.
//!
//! The feedback of a controller follows from its settings by the Riccati equation, which describes the walk near its
//! plan alone. Strikes at other instants, the limits of muscles and the ankle of a foot that tips are not in it, so
//! settings that cost least there need not be those that survive the largest pushes. Here [`Cma`](crate::numerics::Cma)
//! changes them and trials judge them:
//!
//! - [`Gain`]: a setting by its name in a scene, with bounds.
//! - [`Push`]: a push at a phase of the cycle; sets are drawn from a seed.
//! - [`TuningProblem`]: a figure, its plan and its settings; [`TuningProblem::outcome`] is the cost of other settings.
//! - [`Tuning`]: the state of the search, from which it can be resumed.
//!
//! Three kinds of pushes are never the same: pushes by which candidates of a generation are compared (new ones in every
//! generation), pushes by which the best mean of all generations is chosen, and pushes of the report ([`PushUse`]).
//!
//! The maps of the time steps are computed once: maps of another impedance follow from them (module `linear`), so a
//! candidate costs its Riccati equation and its trials.

pub(crate) mod gain;
pub(crate) mod outcome;
mod problem;
mod push;
mod search;

pub use gain::{Gain, GainError};
pub use outcome::TrialOutcome;
pub use problem::TuningProblem;
pub use push::PushSettings;
#[doc(hidden)]
pub use push::{Push, PushUse};
pub use search::{Task, Tuning, Validated};
