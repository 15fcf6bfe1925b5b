//! Mass and inertia of a rigid body.

use super::{Mat3, Pose, Vec3};
use crate::numerics::sort_numbers;

/// Mass, mass centre and inertia about it, in the axes of a frame that the context states.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Inertia {
    mass: f64,
    center: Vec3,
    about_center: Mat3,
}

/// Why numbers are not an inertia.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum InertiaError {
    /// A mass below zero, or not finite.
    #[error("the mass is {mass} kg; expected a finite number, zero or more")]
    Mass {
        /// Given mass [kg].
        mass: f64,
    },
    /// An infinite or undefined number.
    #[error("the mass centre or the inertia holds a number that is not finite")]
    NotFinite,
}

/// Principal moments may violate the triangle inequality by this share of the largest: rounding of printed inertias.
const TRIANGLE_SLACK: f64 = 1e-3;

impl Inertia {
    /// From mass [kg], mass centre [m] and the symmetric inertia about it [kg.m²].
    ///
    /// # Errors
    /// A negative mass or numbers that are not finite. An inertia that no body can have is not an error here; see
    /// [`Inertia::defect`].
    pub fn new(mass: f64, center: Vec3, about_center: Mat3) -> Result<Inertia, InertiaError> {
        if !(mass >= 0.0 && mass.is_finite()) {
            return Err(InertiaError::Mass { mass });
        }
        if !center.iter().chain(about_center.iter()).all(|x| x.is_finite()) {
            return Err(InertiaError::NotFinite);
        }
        Ok(Inertia { mass, center, about_center })
    }

    /// Mass [kg].
    #[inline]
    #[must_use]
    pub fn mass(&self) -> f64 {
        self.mass
    }

    /// Mass centre [m].
    #[inline]
    #[must_use]
    pub fn center(&self) -> Vec3 {
        self.center
    }

    /// Inertia about the mass centre [kg.m²].
    #[inline]
    #[must_use]
    pub fn about_center(&self) -> Mat3 {
        self.about_center
    }

    /// Describes why no rigid body can have this inertia: a negative principal moment, or one larger than the sum of
    /// the other two (∫(y²+z²) ≤ ∫(x²+z²) + ∫(x²+y²)). `None` if the inertia is valid.
    #[must_use]
    pub fn defect(&self) -> Option<String> {
        let mut principal = self.about_center.symmetric_eigenvalues();
        sort_numbers(principal.as_mut_slice());
        let [small, middle, large] = principal.into();
        let shown = format!("principal moments {small:.3e}, {middle:.3e}, {large:.3e} kg.m²");
        if small < -TRIANGLE_SLACK * large.abs() {
            return Some(format!("{shown}: one is negative"));
        }
        (large > (small + middle) * (1.0 + TRIANGLE_SLACK))
            .then(|| format!("{shown}: {large:.3e} exceeds the sum of the others"))
    }

    /// The same body described in another frame, `outer_from_inner`.
    #[must_use]
    pub fn seen_from(&self, outer_from_inner: &Pose) -> Inertia {
        let r = outer_from_inner.rotation;
        Inertia {
            mass: self.mass,
            center: outer_from_inner.place(self.center),
            about_center: r * self.about_center * r.transpose(),
        }
    }

    /// This body with a point mass [kg] fixed at `place` [m] (parallel-axis theorem).
    ///
    /// # Errors
    /// A negative mass or numbers that are not finite.
    pub fn with_point_mass(&self, mass: f64, place: Vec3) -> Result<Inertia, InertiaError> {
        let point = Inertia::new(mass, place, Mat3::zeros())?;
        let total = self.mass + mass;
        if total <= 0.0 {
            return Ok(*self);
        }
        let center = (self.center * self.mass + place * mass) / total;
        Inertia::new(total, center, self.about(center) + point.about(center))
    }

    /// This body and another one fixed to it, in the same frame (parallel-axis theorem).
    #[must_use]
    pub fn joined(&self, other: &Inertia) -> Inertia {
        let mass = self.mass + other.mass;
        if mass <= 0.0 {
            return *self;
        }
        let center = (self.center * self.mass + other.center * other.mass) / mass;
        Inertia { mass, center, about_center: self.about(center) + other.about(center) }
    }

    /// This body without a part of it, in the same frame (parallel-axis theorem): the inverse of [`Inertia::joined`].
    ///
    /// # Errors
    /// A part that is heavier than the body.
    pub(crate) fn without(&self, part: &Inertia) -> Result<Inertia, InertiaError> {
        let mass = self.mass - part.mass;
        let center = (self.center * self.mass - part.center * part.mass) / mass;
        Inertia::new(mass, center, self.about(center) - part.about(center))
    }

    /// Inertia about any point [kg.m²]: I + m (|d|² 1 - d dᵀ).
    fn about(&self, point: Vec3) -> Mat3 {
        let d = self.center - point;
        self.about_center + (Mat3::identity() * d.norm_squared() - d * d.transpose()) * self.mass
    }
}
