//! Muscles: the forces that turn the joints, and the loads that the joints carry because of them.
//!
//! | module | duty |
//! |---|---|
//! | [`built_in`] | the muscles of the built-in body of a person |
//! | [`set`] | muscles, wraps and actuators of a model |
//! | [`wrap`] | paths over cylinders and spheres |

/// The body and its mechanics, so that one dependency is enough.
pub use ambulo_body as body;

pub mod built_in;
pub mod set;
pub mod wrap;
