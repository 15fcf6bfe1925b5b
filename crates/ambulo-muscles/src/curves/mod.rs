//! The curves of a muscle: active force against length and velocity, and passive force against length.
//!
//! | code | symbol | unit | meaning |
//! |---|---|---|---|
//! | `length` | l | optimal fibre lengths | fibre length |
//! | `velocity` | v | greatest velocity of shortening | lengthening velocity of the fibre; shortening is negative |
//! | `activation` | a | 1 | activation, of meaning for Thelen's force-velocity alone |
//!
//! All forces are in multiples of the greatest isometric force. `thelen` has closed forms, `millard` is made of
//! quintic Bézier curves (`bezier`).
//!
//! Pinned by: tests/curves.rs (OpenSim 4.6)

pub(crate) mod bezier;
pub(crate) mod millard;
pub(crate) mod thelen;

use crate::set::{MuscleCurves, ThelenCurves};
pub use bezier::CurveError;
use millard::Millard;

/// The curves of a muscle, ready to be evaluated.
#[derive(Debug, Clone, PartialEq)]
pub enum ForceCurves {
    /// Thelen 2003.
    #[doc(hidden)]
    Thelen2003(ThelenCurves),
    /// Millard and others 2013.
    #[doc(hidden)]
    Millard2012(Box<Millard>),
}

impl ForceCurves {
    /// Prepares the curves.
    ///
    /// # Errors
    /// Parameters that give no curve, as in OpenSim: see [`CurveError`].
    pub fn new(curves: &MuscleCurves) -> Result<ForceCurves, CurveError> {
        match curves {
            MuscleCurves::Thelen2003(parameters) => {
                thelen::check(parameters)?;
                Ok(ForceCurves::Thelen2003(parameters.clone()))
            }
            MuscleCurves::Millard2012(parameters) => Ok(ForceCurves::Millard2012(Box::new(Millard::new(parameters)?))),
        }
    }

    /// Active force at a fibre length.
    #[inline]
    #[must_use]
    pub fn active(&self, length: f64) -> f64 {
        match self {
            ForceCurves::Thelen2003(curves) => thelen::active(curves, length),
            ForceCurves::Millard2012(curves) => curves.active.at(length),
        }
    }

    /// Factor of the active force at a velocity of the fibre.
    #[inline]
    #[must_use]
    pub fn velocity(&self, velocity: f64, activation: f64) -> f64 {
        match self {
            ForceCurves::Thelen2003(curves) => thelen::velocity(curves, velocity, activation),
            ForceCurves::Millard2012(curves) => curves.velocity.at(velocity),
        }
    }

    /// Passive force at a fibre length.
    #[inline]
    #[must_use]
    pub fn passive(&self, length: f64) -> f64 {
        match self {
            ForceCurves::Thelen2003(curves) => thelen::passive(curves, length),
            ForceCurves::Millard2012(curves) => curves.passive.at(length),
        }
    }

    /// Fibre length below which OpenSim lets no fibre shorten [optimal fibre lengths].
    #[inline]
    #[must_use]
    pub(crate) fn least_active_length(&self) -> f64 {
        match self {
            ForceCurves::Thelen2003(_) => 0.0,
            ForceCurves::Millard2012(curves) => curves.active.start(),
        }
    }
}
