//! Where bodies touch, the Coulomb cone, rigid and compliant laws.

mod height_field;
mod outline;
mod polytope;
mod shape;

mod broad_phase;
mod detect;
mod round;
mod segment;
mod separating_axis;

mod compliant;
mod cone;

pub use broad_phase::candidate_pairs;
pub use compliant::{Creep, HuntCrossley, HuntCrossleyError};
pub use cone::{Projection, onto_cone};
pub use detect::{ContactPoint, contacts};
pub use outline::Outline;
pub use shape::{Shape, ShapeError};
