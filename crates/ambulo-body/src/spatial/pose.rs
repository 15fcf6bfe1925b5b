//! Position and orientation of a frame.
//!
//! Products are always inlined: a matrix passed through memory right after it was computed waits for its stores to
//! become visible, which was measured as a fifth of a simulated step.

use super::{Mat3, Vec3};
use std::ops::Mul;

/// The transform `a_from_b`: rotation whose columns are the axes of b in a, and the origin of b in a [m].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pose {
    /// Rotation matrix; columns are the axes of the inner frame.
    pub rotation: Mat3,
    /// Origin of the inner frame [m].
    pub translation: Vec3,
}

impl Pose {
    /// The identity.
    pub const IDENTITY: Pose =
        Pose { rotation: Mat3::new(1., 0., 0., 0., 1., 0., 0., 0., 1.), translation: Vec3::new(0., 0., 0.) };

    /// A frame with the same axes and its origin at `translation` [m].
    #[inline]
    #[must_use]
    pub fn at(translation: Vec3) -> Pose {
        Pose { translation, ..Pose::IDENTITY }
    }

    /// `b_from_a` of an `a_from_b`.
    #[must_use]
    #[inline(always)]
    pub fn inverse(&self) -> Pose {
        let rotation = self.rotation.transpose();
        Pose { rotation, translation: -(rotation * self.translation) }
    }

    /// `self * frame`, without a product of rotations if both frames have the same axes.
    #[must_use]
    #[inline(always)]
    #[doc(hidden)]
    pub fn with(self, frame: &Pose) -> Pose {
        match frame.is_level() {
            true => Pose { rotation: self.rotation, translation: self.place(frame.translation) },
            false => self * *frame,
        }
    }

    /// `self * frame.inverse()`, likewise.
    #[must_use]
    #[inline(always)]
    #[doc(hidden)]
    pub fn without(self, frame: &Pose) -> Pose {
        match frame.is_level() {
            true => Pose { rotation: self.rotation, translation: self.place(-frame.translation) },
            false => self * frame.inverse(),
        }
    }

    /// Whether both frames have the same axes, bit for bit.
    #[inline(always)]
    fn is_level(&self) -> bool {
        // All nine numbers are compared, so that the comparisons need no branches.
        let pairs = self.rotation.as_slice().iter().zip(Pose::IDENTITY.rotation.as_slice());
        pairs.fold(true, |level, (own, one)| level & (own.to_bits() == one.to_bits()))
    }

    /// The coordinates in the outer frame of a point given in the inner frame [m].
    #[must_use]
    #[inline(always)]
    pub fn place(&self, point: Vec3) -> Vec3 {
        self.translation + self.rotation * point
    }
}

impl Mul for Pose {
    type Output = Pose;
    /// `a_from_c = a_from_b * b_from_c`.
    #[inline(always)]
    fn mul(self, inner: Pose) -> Pose {
        Pose { rotation: self.rotation * inner.rotation, translation: self.place(inner.translation) }
    }
}
