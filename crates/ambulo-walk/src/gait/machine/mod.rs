//! Hierarchical concurrent state machines (Cremer, Kearney, Papelis, ACM TOMACS 1995), and the machine of a walk.
//!
//! A machine has states with transitions, child machines that run concurrently, and an activity function that computes
//! its output in each step from the clock and the outputs of its children. A machine reads the other machines as they
//! were after the previous step, so the order of siblings does not matter.

mod authored;
mod condition;
mod definition;
mod machine_file;
mod running_machine;
mod settings;
mod state_table;
mod state_trace;
mod walking;

#[doc(hidden)]
pub use condition::{Comparison, Condition, ConditionError, FootEvent};
pub use definition::Span;
#[doc(hidden)]
pub use definition::{ChildOutputs, Machine, MachineInputs, Sensed, State, Transition};
pub(crate) use machine_file::ReadColumn;
pub(super) use machine_file::read_machines;
#[doc(hidden)]
pub use running_machine::RunningMachine;
pub use settings::{Activity, Driven, MachineSettings, PASSAGE_S};
pub use state_table::{ChangeTable, StateRow, state_rows, state_table};
pub use state_trace::{StateChange, StatePeriod};
#[doc(hidden)]
pub use state_trace::{StateTrace, StateWatch};
pub use walking::{WalkMachine, planned, repeats, walking_machine};
