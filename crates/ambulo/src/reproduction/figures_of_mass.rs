//! The paper's figure with other masses: all lengths alike, or as thick as its density asks.

use super::error::ReproductionError;
use super::evidence::{HEIGHT, MASS};
use crate::model::anthropometry::{Build, Human, SegmentTable};
use crate::model::{Body, Model};
use crate::spatial::{Inertia, Mat3};

/// The paper's figure of another mass [kg]: all lengths, and the radii of segments and soles, as they were.
///
/// # Errors
/// A mass that no figure can have.
pub(super) fn of_mass(mass: f64) -> Result<Human, ReproductionError> {
    let build = Build { table: SegmentTable::Faure1997, mass, height: HEIGHT, toe_joint: false };
    Ok(build.human()?)
}

/// The same figure with its density kept at that of [`MASS`]: cylinders of the same lengths whose radii r go with the root of the
/// mass, which adds m Δ(r²)/4 across them and m Δ(r²)/2 about them; soles as much thicker, on the same sole plane.
///
/// # Errors
/// Inertias that no body has.
pub(super) fn denser(human: &Human) -> Result<Human, ReproductionError> {
    let ratio = human.build.mass / MASS;
    let mut figure = human.clone();
    let bodies = figure.model.bodies().iter().map(|body| thicker(body, ratio)).collect::<Result<Vec<Body>, _>>()?;
    let (name, gravity) = (figure.model.name().to_owned(), figure.model.gravity());
    let (coordinates, markers) = (figure.model.coordinates().to_vec(), figure.model.markers().to_vec());
    figure.model = Model::new(name, gravity, bodies, coordinates, markers).map_err(|e| build_error(e.into()))?;
    for sole in &mut figure.soles {
        let radius = sole.radius * ratio.sqrt();
        sole.center.y += radius - sole.radius;
        sole.radius = radius;
    }
    Ok(figure)
}

/// The longest axis is that of the cylinder.
fn thicker(body: &Body, ratio: f64) -> Result<Body, ReproductionError> {
    let (mass, own) = (body.inertia.mass(), body.inertia.about_center());
    let along = (0..3).min_by(|a, b| own[(*a, *a)].total_cmp(&own[(*b, *b)])).unwrap_or(1);
    // I = m r²/2 about the axis.
    let square = 2.0 * own[(along, along)] / mass * (ratio - 1.0);
    let mut more = Mat3::from_diagonal_element(0.25 * mass * square);
    more[(along, along)] = 0.5 * mass * square;
    let inertia = Inertia::new(mass, body.inertia.center(), own + more).map_err(|e| build_error(e.into()))?;
    Ok(Body { inertia, ..body.clone() })
}

fn build_error(error: crate::model::anthropometry::BuildError) -> ReproductionError {
    ReproductionError::Build(error)
}
