//! Contact geometry and contact laws: shapes, where two shapes touch, Coulomb's friction cone, and a compliant contact
//! force.

mod shape;

pub(crate) mod height_field;
pub(crate) mod polytope;
mod segment;

mod broad_phase;
mod detect;
pub(crate) mod separating_axis;
mod sphere_and_capsule;

mod compliant;
mod cone;

pub use broad_phase::candidate_pairs;
#[doc(hidden)]
pub use compliant::FrictionCurve;
pub use compliant::{ContactSlopes, HuntCrossley, HuntCrossleyError, Onset};
pub use cone::project_onto_cone;
pub use detect::{ContactPoint, contacts};
pub use shape::{Outline, Shape, ShapeError};
