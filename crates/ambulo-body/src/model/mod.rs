//! Musculoskeletal models: segments, joints, coordinates, markers. A model is immutable.
//!
//! A [`Model`] is a tree: every body has one joint to its parent or to ground, and parents precede their children.
//! Coordinates are numbered in the order of the bodies, as in OpenSim's results.

pub mod anatomy;
pub mod anthropometry;
pub(crate) mod arc;
pub(crate) mod bushing;
mod by_side;
mod export;
pub mod full_body;
mod function;
mod import;
mod joint;
mod knots;
pub mod marker_set;
#[doc(hidden)]
pub mod neck_and_wrists;
#[doc(hidden)]
pub mod osim_frame;
#[doc(hidden)]
pub mod osim_function;
mod posture;
mod scaled;
mod scapulothoracic;
mod side;
mod simm_spline;
pub(crate) mod subject_shape;

pub use anatomy::{Anatomy, Movement, Region};
pub use bushing::Bushing;
#[doc(hidden)]
pub use bushing::{BushingEnd, Resistance};
pub use by_side::BySide;
pub use export::{ExportError, to_osim};
pub use function::Function;
pub use import::{ImportError, from_osim};
pub use joint::{Displacement, Joint, JointAxis, JointSpeeds};
pub use knots::Knots;
pub(crate) use posture::ModelPosture;
pub use scaled::{MassDistribution, ScaleError};
pub use side::Side;
pub use simm_spline::SimmSpline;

use crate::numerics::Shown;
use crate::numerics::elementary::{cos, sin};
use crate::spatial::{Inertia, InertiaError, Vec3};
use std::sync::Arc;

/// Index of a body in its model.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct BodyId(#[doc(hidden)] pub usize);

/// Index of a coordinate in its model.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct CoordinateId(#[doc(hidden)] pub usize);

impl BodyId {
    /// Position in [`Model::bodies`].
    #[inline]
    #[must_use]
    pub fn index(self) -> usize {
        self.0
    }
}

impl CoordinateId {
    /// Position in [`Model::coordinates`].
    #[inline]
    #[must_use]
    pub fn index(self) -> usize {
        self.0
    }
}

/// A rigid segment and the joint to its parent.
#[derive(Debug, Clone, PartialEq)]
pub struct Body {
    /// Name of the body.
    pub name: String,
    /// Mass, mass centre and inertia in the body frame.
    pub inertia: Inertia,
    /// The joint to the parent.
    pub joint: Joint,
}

/// A generalised coordinate.
#[derive(Debug, Clone, PartialEq)]
pub struct Coordinate {
    /// Name of the coordinate.
    pub name: String,
    /// Rotation, translation or coupled.
    pub kind: CoordinateKind,
    /// Value if it is not recorded [rad or m].
    pub default_value: f64,
    /// Range stated by the author of the model [rad or m].
    pub range: Option<[f64; 2]>,
    /// Whether motion must stay inside the range; otherwise the range is a recommendation.
    pub clamped: bool,
    /// Whether it is free, locked, prescribed or coupled.
    pub drive: Drive,
}

/// The physical quantity of a coordinate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CoordinateKind {
    /// An angle about an axis [rad]; its generalised force is a moment [N.m].
    Rotation,
    /// A distance along an axis [m]; its generalised force is a force [N].
    Translation,
    /// A parameter of curves in several axes; OpenSim reports its generalised force as a force.
    Coupled,
}

impl CoordinateKind {
    /// Suffix of the column name of the generalised force, as in OpenSim.
    #[must_use]
    pub fn force_suffix(self) -> &'static str {
        match self {
            CoordinateKind::Rotation => "moment",
            CoordinateKind::Translation | CoordinateKind::Coupled => "force",
        }
    }
}

/// How the value of a coordinate is determined.
#[derive(Debug, Clone, PartialEq)]
pub enum Drive {
    /// The recording.
    Free,
    /// Fixed at the default value.
    Locked,
    /// A function of time [s].
    Prescribed(Function),
    /// A function of another coordinate.
    Coupled(CoordinateId, Function),
}

/// A marker fixed to a body.
#[derive(Debug, Clone, PartialEq)]
pub struct Marker {
    /// Name of the marker.
    pub name: String,
    /// The body; `None` is ground.
    pub body: Option<BodyId>,
    /// Position in the body frame [m].
    pub location: Vec3,
    /// Whether a scaling protocol leaves the marker at its place on the body, instead of moving it to the recorded one.
    pub fixed: bool,
}

/// A tree of bodies, its coordinates and markers; it never changes.
///
/// Bodies come parent first, each with the joint that carries it. A joint has at most three rotations and three
/// translations, each a function of at most one coordinate.
#[derive(Debug, Clone, PartialEq)]
pub struct Model {
    name: String,
    gravity: Vec3,
    up: Vec3,
    bodies: Vec<Body>,
    coordinates: Vec<Coordinate>,
    markers: Vec<Marker>,
    bushings: Vec<Bushing>,
    anatomy: Arc<Anatomy>,
    /// Factors by which the bodies were scaled; empty for a model as it was made.
    factors: Vec<Vec3>,
}

/// Why parts cannot be assembled into a model.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ModelError {
    /// The model has no body.
    #[error("the model has no body; expected at least one")]
    NoBody,
    /// A parent that does not precede its child.
    #[error("body `{body}` precedes its parent; expected parents first")]
    ParentAfterChild {
        /// The child.
        body: String,
    },
    /// A coordinate that the model does not have, or that two joints use.
    #[error("joint `{joint}` uses coordinate {index}; expected one of {count} that no other joint uses")]
    Coordinate {
        /// The joint.
        joint: String,
        /// Index of the coordinate.
        index: usize,
        /// Number of coordinates.
        count: usize,
    },
    /// Two bodies or coordinates with the same name.
    #[error("two {what} are named `{name}`; expected different names")]
    Duplicate {
        /// Bodies or coordinates.
        what: &'static str,
        /// The name.
        name: String,
    },
    /// A bushing on a body that the model does not have.
    #[error("bushing `{bushing}` is fixed to body {index}; expected one of {count}")]
    Bushing {
        /// The bushing.
        bushing: String,
        /// Index of the body.
        index: usize,
        /// Number of bodies.
        count: usize,
    },
    /// Too many axes, or an axis without direction.
    #[error("joint `{joint}`: {found}; expected at most three rotations and three translations about unit axes")]
    Axis {
        /// The joint.
        joint: String,
        /// Found value.
        found: String,
    },
    /// A coupler whose leader follows another coordinate.
    #[error("coordinate `{coordinate}` follows a coordinate that itself follows another; expected a free one")]
    CouplerChain {
        /// The follower.
        coordinate: String,
    },
    /// A mass that is not possible.
    #[error("body `{body}` cannot have this mass")]
    Inertia {
        /// The body.
        body: String,
        /// Why.
        source: InertiaError,
    },
    /// A point mass that is too heavy for a person.
    #[error(
        "a mass of {} kg on `{body}`; expected at most {most_kg:.0} kg, five times the mass of the model, because no \
         person carries more", Shown(*found_kg)
    )]
    PointMass {
        /// The body that should carry it.
        body: String,
        /// The mass [kg].
        found_kg: f64,
        /// Largest allowed mass [kg].
        most_kg: f64,
    },
    /// A point mass that is too far away from its body.
    #[error(
        "a mass {} m from the origin of `{body}`; expected at most {most_m} m, because a mass farther away is not on \
         the body. hint: positions are in metres", Shown(*found_m)
    )]
    PointMassPlace {
        /// The body that should carry it.
        body: String,
        /// Distance found [m].
        found_m: f64,
        /// Largest allowed distance [m].
        most_m: f64,
    },
}

/// Largest point mass as a multiple of the mass of the model: no person carries more.
const MOST_BODY_MASSES: f64 = 5.0;
/// Largest distance of a point mass from the origin of its body [m].
const FARTHEST_POINT_MASS_M: f64 = 5.0;

impl Model {
    /// Assembles a model. Gravity is in world axes [m/s²]; parents precede their children.
    ///
    /// # Errors
    /// Parts that do not fit together: see [`ModelError`].
    pub fn new(
        name: impl Into<String>,
        gravity: Vec3,
        bodies: Vec<Body>,
        coordinates: Vec<Coordinate>,
        markers: Vec<Marker>,
    ) -> Result<Model, ModelError> {
        let anatomy = Arc::default();
        let up = gravity.try_normalize(f64::MIN_POSITIVE).map_or(Vec3::y(), |down| -down);
        let bushings = Vec::new();
        let (name, factors) = (name.into(), Vec::new());
        let mut model = Model { name, gravity, up, bodies, coordinates, markers, bushings, anatomy, factors };
        model.check()?;
        model.anatomy = Arc::new(Anatomy::find(&model));
        Ok(model)
    }

    fn check(&self) -> Result<(), ModelError> {
        if self.bodies.is_empty() {
            return Err(ModelError::NoBody);
        }
        unique("bodies", self.bodies.iter().map(|b| &b.name))?;
        unique("coordinates", self.coordinates.iter().map(|c| &c.name))?;
        let mut used = vec![false; self.coordinates.len()];
        for (i, body) in self.bodies.iter().enumerate() {
            if body.joint.parent.is_some_and(|p| p.0 >= i) {
                return Err(ModelError::ParentAfterChild { body: body.name.clone() });
            }
            check_axes(&body.joint)?;
            for CoordinateId(index) in body.joint.coordinates() {
                match used.get_mut(index) {
                    Some(seen) if !*seen => *seen = true,
                    _ => {
                        let (joint, count) = (body.joint.name.clone(), used.len());
                        return Err(ModelError::Coordinate { joint, index, count });
                    }
                }
            }
        }
        for coordinate in &self.coordinates {
            if let Drive::Coupled(leader, _) = &coordinate.drive
                && !self.coordinates.get(leader.0).is_some_and(|l| !matches!(l.drive, Drive::Coupled(..)))
            {
                return Err(ModelError::CouplerChain { coordinate: coordinate.name.clone() });
            }
        }
        Ok(())
    }

    /// Name of the model.
    #[inline]
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Gravity in world axes [m/s²].
    #[inline]
    #[must_use]
    pub fn gravity(&self) -> Vec3 {
        self.gravity
    }

    /// The upward direction, perpendicular to the ground: against gravity, except on a slope; world y without gravity.
    #[inline]
    #[must_use]
    pub fn up(&self) -> Vec3 {
        self.up
    }

    /// Bodies, parents first.
    #[inline]
    #[must_use]
    pub fn bodies(&self) -> &[Body] {
        &self.bodies
    }

    /// Coordinates, in the order of the bodies that they move.
    #[inline]
    #[must_use]
    pub fn coordinates(&self) -> &[Coordinate] {
        &self.coordinates
    }

    /// Markers.
    #[inline]
    #[must_use]
    pub fn markers(&self) -> &[Marker] {
        &self.markers
    }

    /// Springs with dampers between bodies. Inverse dynamics applies them.
    #[inline]
    #[must_use]
    pub fn bushings(&self) -> &[Bushing] {
        &self.bushings
    }

    /// How much each body was scaled along its axes since the model was read or made, one entry per body.
    #[must_use]
    pub fn scale_factors(&self) -> Vec<Vec3> {
        if self.factors.is_empty() { vec![Vec3::repeat(1.0); self.bodies.len()] } else { self.factors.clone() }
    }

    /// The model with its bushings replaced by these.
    ///
    /// # Errors
    /// A bushing on a body that the model does not have.
    pub fn with_bushings(mut self, bushings: Vec<Bushing>) -> Result<Model, ModelError> {
        let count = self.bodies.len();
        for bushing in &bushings {
            let mut bodies = bushing.ends.iter().filter_map(|end| end.body.map(BodyId::index));
            if let Some(index) = bodies.find(|index| *index >= count) {
                return Err(ModelError::Bushing { bushing: bushing.name.clone(), index, count });
            }
        }
        self.bushings = bushings;
        Ok(self)
    }

    /// Anatomical meaning of the parts.
    #[inline]
    #[must_use]
    pub fn anatomy(&self) -> &Anatomy {
        &self.anatomy
    }

    /// Total mass [kg].
    #[inline]
    #[must_use]
    pub fn mass(&self) -> f64 {
        self.bodies.iter().map(|b| b.inertia.mass()).sum()
    }

    /// The body with this name.
    #[must_use]
    pub fn body(&self, name: &str) -> Option<BodyId> {
        self.bodies.iter().position(|b| b.name == name).map(BodyId)
    }

    /// The coordinate with this name.
    #[must_use]
    pub fn coordinate(&self, name: &str) -> Option<CoordinateId> {
        self.coordinates.iter().position(|c| c.name == name).map(CoordinateId)
    }

    /// The name of a coordinate without its side, as in `cycles.csv`: `knee_angle` for `knee_angle_r`.
    #[must_use]
    pub fn coordinate_stem(&self, id: CoordinateId) -> String {
        let name = &self.coordinates[id.0].name;
        Side::split_name(name).map_or_else(|| name.clone(), |(_, stem)| stem)
    }

    /// All bodies, by id.
    #[inline]
    pub fn body_ids(&self) -> impl DoubleEndedIterator<Item = BodyId> + use<> {
        (0..self.bodies.len()).map(BodyId)
    }

    /// All coordinates, by id.
    #[inline]
    pub fn coordinate_ids(&self) -> impl Iterator<Item = CoordinateId> + use<> {
        (0..self.coordinates.len()).map(CoordinateId)
    }

    /// The model with a point mass [kg] fixed to a body at a position in its frame [m]: a shoe, a battery, a load.
    ///
    /// # Errors
    /// A negative mass, more than five times the mass of the model, a place more than 5 m away, or numbers that are not
    /// finite.
    pub fn with_point_mass(&self, body: BodyId, mass: f64, place: Vec3) -> Result<Model, ModelError> {
        let (most_kg, found_m) = (MOST_BODY_MASSES * self.mass(), place.amax());
        let named = || self.bodies[body.0].name.clone();
        if mass.is_finite() && mass > most_kg {
            return Err(ModelError::PointMass { body: named(), found_kg: mass, most_kg });
        }
        if found_m.is_finite() && found_m > FARTHEST_POINT_MASS_M {
            return Err(ModelError::PointMassPlace { body: named(), found_m, most_m: FARTHEST_POINT_MASS_M });
        }
        let mut model = self.clone();
        let Body { inertia, name, .. } = &mut model.bodies[body.0];
        *inertia = inertia
            .with_point_mass(mass, place)
            .map_err(|source| ModelError::Inertia { body: name.clone(), source })?;
        Ok(model)
    }

    /// The model on ground that rises by an angle [rad] along x. The axes are aligned with the ground, so gravity is
    /// inclined.
    #[must_use]
    pub fn on_slope(&self, angle: f64) -> Model {
        let forward = Vec3::x() - self.up * self.up.dot(&Vec3::x());
        let gravity = (self.up * cos(angle) + forward * sin(angle)) * -self.gravity.norm();
        Model { gravity, ..self.clone() }
    }

    /// The model with another mass, mass centre and inertia of a body, in the frame of the body.
    #[must_use]
    pub fn with_inertia(&self, body: BodyId, inertia: Inertia) -> Model {
        let mut model = self.clone();
        model.bodies[body.0].inertia = inertia;
        model
    }

    /// Names of the generalised forces, one per coordinate: `<coordinate>_moment` or `<coordinate>_force`.
    #[must_use]
    pub fn force_names(&self) -> Vec<String> {
        self.coordinates.iter().map(|c| format!("{}_{}", c.name, c.kind.force_suffix())).collect()
    }
}

fn unique<'a>(what: &'static str, names: impl Iterator<Item = &'a String>) -> Result<(), ModelError> {
    let mut seen = std::collections::BTreeSet::new();
    for name in names {
        if !seen.insert(name) {
            return Err(ModelError::Duplicate { what, name: name.clone() });
        }
    }
    Ok(())
}

/// Whether a joint has three rotations, each by its own coordinate with slope one.
fn is_ball_like(joint: &Joint) -> bool {
    let leader = |axis: &JointAxis| match &axis.displacement {
        Displacement::Follows(id, Function::Linear { slope: 1.0, .. }) => Some(*id),
        _ => None,
    };
    let leaders: Vec<_> = joint.rotations.iter().filter_map(leader).collect();
    leaders.len() == 3 && leaders[0] != leaders[1] && leaders[1] != leaders[2] && leaders[0] != leaders[2]
}

fn check_axes(joint: &Joint) -> Result<(), ModelError> {
    const UNIT_TOLERANCE: f64 = 1e-9;
    let error = |found: String| Err(ModelError::Axis { joint: joint.name.clone(), found });
    if joint.rotations.len() > 3 || joint.translations.len() > 3 {
        return error(format!("{} rotations and {} translations", joint.rotations.len(), joint.translations.len()));
    }
    if !matches!(joint.speeds, JointSpeeds::Rates | JointSpeeds::Arc(_)) && !is_ball_like(joint) {
        return error(
            "angular velocities as speeds without three rotations that each follow their own coordinate".into(),
        );
    }
    for axis in joint.rotations.iter().chain(&joint.translations) {
        let length = axis.direction.norm();
        if (length - 1.0).abs() > UNIT_TOLERANCE || !length.is_finite() {
            return error(format!("an axis of length {length}"));
        }
    }
    Ok(())
}
