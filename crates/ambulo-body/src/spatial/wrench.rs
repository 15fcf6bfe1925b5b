//! Twists and wrenches: velocity or acceleration of a body, and force with moment on it.

use super::Vec3;

/// Velocity or acceleration of a body, at a point that the context states.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Twist {
    /// Angular part [rad/s or rad/s²].
    pub angular: Vec3,
    /// Linear part at the point [m/s or m/s²].
    pub linear: Vec3,
}

/// A force and a moment about a point that the context states.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wrench {
    /// Moment about the point [N.m].
    pub moment: Vec3,
    /// Force [N].
    pub force: Vec3,
}

impl Twist {
    /// No motion.
    pub const ZERO: Twist = Twist { angular: Vec3::new(0., 0., 0.), linear: Vec3::new(0., 0., 0.) };

    /// The velocity of another point of the same body, at `arm` from this one [m]. For velocities only, not for
    /// accelerations.
    #[inline]
    #[must_use]
    pub fn velocity_at(&self, arm: Vec3) -> Vec3 {
        self.linear + self.angular.cross(&arm)
    }
}

impl Wrench {
    /// No load.
    pub const ZERO: Wrench = Wrench { moment: Vec3::new(0., 0., 0.), force: Vec3::new(0., 0., 0.) };

    /// The same load about another point; `arm` points from the new point to the old one [m].
    #[inline]
    #[must_use]
    pub fn about(&self, arm: Vec3) -> Wrench {
        Wrench { moment: self.moment + arm.cross(&self.force), force: self.force }
    }

    /// Power [W] on a body whose twist is given at the same point.
    #[inline]
    #[must_use]
    pub fn power(&self, twist: &Twist) -> f64 {
        self.moment.dot(&twist.angular) + self.force.dot(&twist.linear)
    }
}
