//! Hierarchical concurrent state machines (Cremer, Kearney, Papelis, ACM TOMACS 1995), and the machine of a walk.
//!
//! A machine has states with transitions, child machines that run concurrently, and an activity function that computes its output in
//! each step from the clock and the outputs of its children. A machine reads the other machines as they were after the previous step,
//! so the order of siblings does not matter.

mod definition;
mod running_machine;
mod state_table;
mod walking;

pub use definition::{ChildOutputs, Machine, MachineInputs, Span, State, Transition};
pub use running_machine::RunningMachine;
pub use state_table::{StateRow, state_rows, state_table};
pub use walking::{WalkMachine, walking_machine};
