//! The paper's figure with another mass, stature or thickness.

use super::error::ReproductionError;
use super::evidence::{HEIGHT, MASS};
use crate::model::anthropometry::{Build, BuildError, Human, SegmentTable};
use crate::model::{Body, Model};
use crate::spatial::{Inertia, Mat3};

/// The paper's figure of another mass [kg]: all lengths, and the radii of segments and soles, as they were.
pub(super) fn of_mass(mass: f64) -> Result<Human, ReproductionError> {
    let build = Build { table: SegmentTable::Faure1997, mass, height: HEIGHT, toe_joint: false };
    Ok(build.human()?)
}

/// The same build at another stature [m].
pub(super) fn rebuilt(human: &Human, height: f64) -> Result<Human, ReproductionError> {
    Ok(Build { height, ..human.build }.human()?)
}

/// The figure with its density kept at that of [`MASS`]: segments of the same lengths and soles as thick as that asks.
pub(super) fn denser(human: &Human) -> Result<Human, ReproductionError> {
    let ratio = human.build.mass / MASS;
    Ok(with_soles(with_thickness(human, ratio)?, ratio.sqrt()))
}

/// Cylinders whose cross-section is `ratio` of what it was: m Δ(r²)/4 more across them and m Δ(r²)/2 more about them.
pub(super) fn with_thickness(human: &Human, ratio: f64) -> Result<Human, ReproductionError> {
    let mut figure = human.clone();
    let bodies = figure.model.bodies().iter().map(|body| thicker(body, ratio)).collect::<Result<Vec<Body>, _>>()?;
    let (name, gravity) = (figure.model.name().to_owned(), figure.model.gravity());
    let (coordinates, markers) = (figure.model.coordinates().to_vec(), figure.model.markers().to_vec());
    figure.model = Model::new(name, gravity, bodies, coordinates, markers).map_err(BuildError::from)?;
    Ok(figure)
}

/// Soles whose spheres have radii `factor` of what they were, on the same sole plane.
pub(super) fn with_soles(mut human: Human, factor: f64) -> Human {
    for sole in &mut human.soles {
        let radius = sole.radius * factor;
        sole.center.y += radius - sole.radius;
        sole.radius = radius;
    }
    human
}

/// The axis of least inertia is that of the cylinder, about which I = m r²/2.
fn thicker(body: &Body, ratio: f64) -> Result<Body, ReproductionError> {
    let (mass, own) = (body.inertia.mass(), body.inertia.about_center());
    let along = (0..3).min_by(|a, b| own[(*a, *a)].total_cmp(&own[(*b, *b)])).unwrap_or(1);
    let square = 2.0 * own[(along, along)] / mass * (ratio - 1.0);
    let mut more = Mat3::from_diagonal_element(0.25 * mass * square);
    more[(along, along)] = 0.5 * mass * square;
    let inertia = Inertia::new(mass, body.inertia.center(), own + more).map_err(BuildError::from)?;
    Ok(Body { inertia, ..body.clone() })
}
