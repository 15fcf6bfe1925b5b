//! Hierarchical concurrent state machines (Cremer, Kearney, Papelis, ACM TOMACS 1995), and the one that walks.
//!
//! A machine has states with transitions, child machines that run side by side, and an activity function that gives its
//! output each step from readable external data and its children's outputs. Everything that a machine can see of others is a
//! snapshot of the step before, so the order of siblings never matters.

mod definition;
mod description;
mod running;
mod walking;

pub use definition::{Machine, Span, State, Transition};
pub use description::{StateRow, state_rows, state_table};
pub use running::{Children, Running, Sight};
pub use walking::{WalkMachine, walking_machine};
