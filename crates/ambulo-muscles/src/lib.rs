//! Muscles: the forces that turn the joints, and the loads that the joints carry because of them.
//!
//! | module | duty |
//! |---|---|
//! | [`set`] | muscles, wraps and actuators of a model |
//! | [`emg`] | electromyograms: envelopes, on/off, comparison with activations |

/// The body and its mechanics, so that one dependency is enough.
pub use ambulo_body as body;

pub mod emg;
pub mod set;
