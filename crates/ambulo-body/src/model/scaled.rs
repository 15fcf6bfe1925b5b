//! Scales a model body by body, as OpenSim does.
//!
//! Factors are along the axes of the frame of each body. With S = diag(factors of the body):
//! - mass centre, markers, joint frames and frames of bushings on the body: position S p, orientation unchanged;
//! - translations of a joint are scaled by the factors of the parent, aᵀ S a along their axis a; a translation that is
//!   itself a coordinate (slope one, no intercept) is not, because its value is a length of the motion, not of the
//!   body;
//! - the half axes of an ellipsoid are scaled by the factors of the parent along them;
//! - the length of an arc is scaled by the factor of the child along y;
//! - a coupler whose follower is a translation is multiplied by the factor of the parent along it;
//! - masses keep their shares, or grow with the volumes of the bodies ([`MassDistribution`]); inertias scale with the
//!   square of the factor or, if the three factors differ, as for a cylinder with the smallest and another moment
//!   of inertia of the body.
//!
//! Source: OpenSim 4, Body.cpp (`scaleInertialProperties`), SpatialTransform.cpp, CoordinateCouplerConstraint.cpp
//! (`scale`), read. Differences: an axis opposite to x, y or z is scaled as one along it (OpenSim multiplies by the
//! negative factor); couplers of translations may have unequal factors; the half axes of an ellipsoid in a rotated
//! joint frame are scaled along their own directions (OpenSim takes the factors in the order x, y, z).
//! Pinned by: tests/scaling.rs, against OpenSim 4.6

use super::{
    Body, BodyId, Bushing, BushingEnd, CoordinateKind, Displacement, Drive, Function, JointAxis, JointSpeeds, Marker,
    Model, ModelError,
};
use crate::spatial::{Inertia, InertiaError, Mat3, Pose, Vec3};

/// Factors that differ by less than this share are equal.
const SAME_FACTOR: f64 = 1e-12;

/// How the masses of the bodies follow from their sizes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum MassDistribution {
    /// Every body keeps its share of the mass of the model.
    #[default]
    Kept,
    /// The mass of a body grows with its volume, the product of its three factors; then all are scaled to the total.
    ByVolume,
}

/// Why a model cannot be scaled.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ScaleError {
    /// The number of factors differs from the number of bodies.
    #[error("found factors for {found} bodies; expected {expected}, one per body of the model")]
    Count {
        /// Number of factors.
        found: usize,
        /// Number of bodies.
        expected: usize,
    },
    /// A factor that is not finite and positive.
    #[error("body `{body}` has the factors {found:?}; expected finite numbers above zero")]
    Factor {
        /// The body.
        body: String,
        /// Factors along x, y and z.
        found: [f64; 3],
    },
    /// A mass that is not positive, or a model without mass.
    #[error(
        "the requested mass is {found} kg and the mass of the model is {own} kg; expected finite numbers above zero"
    )]
    Mass {
        /// Requested mass [kg].
        found: f64,
        /// Mass of the model [kg].
        own: f64,
    },
    /// An inertia that is not possible.
    #[error("body `{body}` cannot be scaled")]
    Inertia {
        /// The body.
        body: String,
        /// Why.
        source: InertiaError,
    },
    /// The scaled model is not valid.
    #[error(transparent)]
    Model(#[from] ModelError),
}

impl Model {
    /// Scales every body along its axes, and all masses by one factor to the total `mass` [kg]
    /// (`None` keeps them).
    ///
    /// # Errors
    /// Factors or masses that are not finite numbers above zero.
    pub fn scaled(&self, factors: &[Vec3], mass: Option<f64>) -> Result<Model, ScaleError> {
        self.scaled_with(factors, mass, MassDistribution::Kept)
    }

    /// [`Model::scaled`] with a choice of the masses.
    ///
    /// # Errors
    /// As [`Model::scaled`].
    pub fn scaled_with(
        &self,
        factors: &[Vec3],
        mass: Option<f64>,
        distribution: MassDistribution,
    ) -> Result<Model, ScaleError> {
        check(self, factors)?;
        let shares = mass_shares(self, factors, mass, distribution)?;
        let of = |body: Option<BodyId>| body.map_or(Vec3::repeat(1.0), |id| factors[id.index()]);
        let mut bodies = Vec::with_capacity(self.bodies.len());
        for ((body, own), share) in self.bodies.iter().zip(factors).zip(shares) {
            bodies.push(scaled_body(body, own, &of(body.joint.parent), share)?);
        }
        let mut coordinates = self.coordinates.clone();
        for body in &self.bodies {
            scale_couplers(body, &of(body.joint.parent), &mut coordinates);
        }
        let place = |m: &Marker| Marker { location: of(m.body).component_mul(&m.location), ..m.clone() };
        let markers = self.markers.iter().map(place).collect();
        let end = |end: BushingEnd| BushingEnd { frame: scaled_pose(&end.frame, &of(end.body)), ..end };
        let bushings = self.bushings.iter().map(|b| Bushing { ends: b.ends.map(end), ..b.clone() }).collect();
        let scaled =
            Model::new(self.name.clone(), self.gravity, bodies, coordinates, markers)?.with_bushings(bushings)?;
        let all = self.scale_factors().iter().zip(factors).map(|(before, own)| before.component_mul(own)).collect();
        Ok(Model { factors: all, ..scaled })
    }

    /// The model with other markers.
    ///
    /// # Errors
    /// None at present; see [`ModelError`].
    pub fn with_markers(&self, markers: Vec<Marker>) -> Result<Model, ModelError> {
        let same = Model::new(self.name.clone(), self.gravity, self.bodies.clone(), self.coordinates.clone(), markers)?;
        Ok(Model { factors: self.factors.clone(), ..same.with_bushings(self.bushings.clone())? })
    }
}

fn check(model: &Model, factors: &[Vec3]) -> Result<(), ScaleError> {
    let (found, expected) = (factors.len(), model.bodies.len());
    if found != expected {
        return Err(ScaleError::Count { found, expected });
    }
    for (body, factors) in model.bodies.iter().zip(factors) {
        if !factors.iter().all(|f| *f > 0.0 && f.is_finite()) {
            return Err(ScaleError::Factor { body: body.name.clone(), found: (*factors).into() });
        }
    }
    Ok(())
}

/// The factor of the mass of each body.
fn mass_shares(
    model: &Model,
    factors: &[Vec3],
    mass: Option<f64>,
    distribution: MassDistribution,
) -> Result<Vec<f64>, ScaleError> {
    let volume = |factors: &Vec3| match distribution {
        MassDistribution::Kept => 1.0,
        MassDistribution::ByVolume => factors.product(),
    };
    let volumes: Vec<f64> = factors.iter().map(volume).collect();
    let Some(found) = mass else { return Ok(volumes) };
    let own: f64 = model.bodies.iter().zip(&volumes).map(|(body, volume)| body.inertia.mass() * volume).sum();
    if !(found > 0.0 && found.is_finite() && own > 0.0) {
        return Err(ScaleError::Mass { found, own });
    }
    Ok(volumes.into_iter().map(|volume| volume * (found / own)).collect())
}

fn scaled_body(body: &Body, own: &Vec3, parent: &Vec3, share: f64) -> Result<Body, ScaleError> {
    let error = |source| ScaleError::Inertia { body: body.name.clone(), source };
    let inertia = scaled_inertia(&body.inertia, own, share).map_err(error)?;
    let mut joint = body.joint.clone();
    joint.parent_from_joint = scaled_pose(&joint.parent_from_joint, parent);
    joint.child_from_joint = scaled_pose(&joint.child_from_joint, own);
    joint.translations.iter_mut().for_each(|axis| scale_axis(axis, parent));
    if let JointSpeeds::Ellipsoid(radii) = &mut joint.speeds {
        let axes = body.joint.parent_from_joint.rotation;
        *radii = Vec3::from_fn(|i, _| radii[i] * along(&axes.column(i).into_owned(), parent));
    }
    if let JointSpeeds::Arc(length) = &mut joint.speeds {
        *length *= own.y;
    }
    Ok(Body { name: body.name.clone(), inertia, joint })
}

fn scaled_pose(pose: &Pose, factors: &Vec3) -> Pose {
    Pose { rotation: pose.rotation, translation: factors.component_mul(&pose.translation) }
}

/// aᵀ S a.
fn along(direction: &Vec3, factors: &Vec3) -> f64 {
    direction.component_mul(direction).dot(factors)
}

fn scale_axis(axis: &mut JointAxis, parent: &Vec3) {
    let factor = along(&axis.direction, parent);
    match &mut axis.displacement {
        Displacement::Fixed(value) => *value *= factor,
        Displacement::Follows(_, function) if !is_the_coordinate(function) => {
            let scaled = match &*function {
                Function::Scaled(scale, inner) => Function::Scaled(scale * factor, inner.clone()),
                other => Function::Scaled(factor, Box::new(other.clone())),
            };
            *function = scaled;
        }
        Displacement::Follows(..) => {}
    }
}

fn is_the_coordinate(function: &Function) -> bool {
    matches!(function, Function::Linear { slope, intercept }
        if (slope - 1.0).abs() < f64::MIN_POSITIVE && intercept.abs() < f64::MIN_POSITIVE)
}

/// Scales couplers of translations of this joint.
fn scale_couplers(body: &Body, parent: &Vec3, coordinates: &mut [super::Coordinate]) {
    for axis in &body.joint.translations {
        let Displacement::Follows(id, _) = &axis.displacement else { continue };
        let coordinate = &mut coordinates[id.index()];
        if let (Drive::Coupled(leader, function), CoordinateKind::Translation) = (&coordinate.drive, coordinate.kind) {
            let scaled = Function::Scaled(along(&axis.direction, parent), Box::new(function.clone()));
            coordinate.drive = Drive::Coupled(*leader, scaled);
        }
    }
}

fn scaled_inertia(inertia: &Inertia, s: &Vec3, share: f64) -> Result<Inertia, InertiaError> {
    let (mass, about) = (inertia.mass(), inertia.about_center());
    let equal = (s.x - s.y).abs() <= SAME_FACTOR * s.x && (s.y - s.z).abs() <= SAME_FACTOR * s.y;
    let scaled = if mass <= 0.0 {
        Mat3::zeros()
    } else if equal {
        about * (s.x * s.x)
    } else {
        as_cylinder(mass, &about, s)
    };
    Inertia::new(mass * share, s.component_mul(&inertia.center()), scaled * share)
}

/// Scales a cylinder along the axis k of the smallest moment, m r²/2, whose length follows from another moment, m
/// (l²/12 + r²/4); products of inertia scale with both their factors.
fn as_cylinder(mass: f64, about: &Mat3, s: &Vec3) -> Mat3 {
    let moments = about.diagonal();
    let k = if moments.x <= moments.y {
        if moments.x <= moments.z { 0 } else { 2 }
    } else if moments.y <= moments.z {
        1
    } else {
        2
    };
    let other = if k == 0 { 1 } else { 0 };
    let radius_squared = (2.0 * moments[k] / mass).max(0.0);
    let length_squared = (12.0 * (moments[other] - 0.25 * mass * radius_squared) / mass).max(0.0) * s[k] * s[k];
    let radius_squared = radius_squared * s[(k + 1) % 3] * s[(k + 2) % 3];
    let across = mass * (length_squared / 12.0 + 0.25 * radius_squared);
    Mat3::from_fn(|i, j| match (i, j) {
        (i, j) if i != j => about[(i, j)] * s[i] * s[j],
        (i, _) if i == k => 0.5 * mass * radius_squared,
        _ => across,
    })
}
