//! The figure of the paper, also with another mass, stature or thickness.

use super::error::ReproductionError;
use ambulo_body::model::anthropometry::{Build, BuildError, Human, SegmentTable};
use ambulo_body::model::{Body, Model};
use ambulo_body::spatial::{Inertia, Mat3};

/// Mass of the paper's figure [kg].
pub const MASS: f64 = 80.0;
/// Stature of the figure, which the paper does not give [m].
pub const HEIGHT: f64 = 1.80;
/// Length of the foot in Table 1, share of the stature.
pub(super) const TABLE_FOOT: f64 = 0.089;

/// The figure of the paper: Table 1, 80 kg.
///
/// # Errors
/// None is known.
pub fn paper_human() -> Result<Human, ReproductionError> {
    let build = Build { table: SegmentTable::Faure1997, mass: MASS, height: HEIGHT, toe_joint: false };
    Ok(build.human()?)
}

/// The figure of the paper with another mass [kg] and the same lengths and radii of segments and soles.
pub(super) fn of_mass(mass: f64) -> Result<Human, ReproductionError> {
    let build = Build { table: SegmentTable::Faure1997, mass, height: HEIGHT, toe_joint: false };
    Ok(build.human()?)
}

/// The figure with another stature [m]; cross-sections and soles keep their ratio to its build.
pub(super) fn rebuilt(human: &Human, height: f64) -> Result<Human, ReproductionError> {
    let plain = human.build.human()?;
    let figure = Build { height, ..human.build }.human()?;
    let thickness = cross_section(human) / cross_section(&plain);
    let soles = sum_of_radii(human) / sum_of_radii(&plain);
    Ok(with_soles(with_thickness(&figure, thickness)?, soles))
}

/// Squared radius of the cylinder of the heaviest segment [m²]: r² = 2 I / m about its axis.
fn cross_section(human: &Human) -> f64 {
    let square = |body: &Body| {
        let own = body.inertia.about_center();
        let least = (0..3).map(|axis| own[(axis, axis)]).fold(f64::INFINITY, f64::min);
        2.0 * least / body.inertia.mass()
    };
    let by_mass = |a: &&Body, b: &&Body| a.inertia.mass().total_cmp(&b.inertia.mass());
    human.model.bodies().iter().max_by(by_mass).map_or(1.0, square)
}

/// Sum of the radii of the soles [m].
pub(super) fn sum_of_radii(human: &Human) -> f64 {
    human.soles.iter().map(|sole| sole.radius).sum()
}

/// The figure with the density that it has at [`MASS`]: segments of the same length, with other radii of segments and
/// soles.
pub(super) fn denser(human: &Human) -> Result<Human, ReproductionError> {
    let ratio = human.build.mass / MASS;
    Ok(with_soles(with_thickness(human, ratio)?, ratio.sqrt()))
}

/// Multiplies the cross-section of the cylinders by `ratio`: the moment of inertia grows by m Δ(r²)/4 about transverse
/// axes and by m Δ(r²)/2 about the axis of the cylinder.
pub(super) fn with_thickness(human: &Human, ratio: f64) -> Result<Human, ReproductionError> {
    let mut figure = human.clone();
    let bodies = figure.model.bodies().iter().map(|body| thicker(body, ratio)).collect::<Result<Vec<Body>, _>>()?;
    let (name, gravity) = (figure.model.name().to_owned(), figure.model.gravity());
    let (coordinates, markers) = (figure.model.coordinates().to_vec(), figure.model.markers().to_vec());
    figure.model = Model::new(name, gravity, bodies, coordinates, markers).map_err(BuildError::from)?;
    Ok(figure)
}

/// Multiplies the radii of the spheres of the soles by `factor` and keeps the plane of the sole.
pub(super) fn with_soles(mut human: Human, factor: f64) -> Human {
    for sole in &mut human.soles {
        let radius = sole.radius * factor;
        sole.center.y += radius - sole.radius;
        sole.radius = radius;
    }
    human
}

/// The foot as a cylinder from the ankle to the tip of the toes, `reach` times the stature long: its spheres in front
/// of the ankle move in proportion, and its mass centre to half the reach. The heel stays.
pub(super) fn with_toe_reach(mut human: Human, reach: f64) -> Result<Human, ReproductionError> {
    let tip = human.soles.iter().map(|sole| sole.center.x + sole.radius).fold(0.0, f64::max);
    let length = reach * human.build.height;
    let feet: Vec<_> = human.soles.iter().map(|sole| sole.body).collect();
    for sole in human.soles.iter_mut().filter(|sole| sole.center.x > 0.0) {
        sole.center.x = (sole.center.x + sole.radius) * length / tip - sole.radius;
    }
    let mut bodies = human.model.bodies().to_vec();
    for foot in [feet.first(), feet.last()].into_iter().flatten() {
        let body = &mut bodies[foot.index()];
        let mut center = body.inertia.center();
        center.x = 0.5 * length;
        body.inertia =
            Inertia::new(body.inertia.mass(), center, body.inertia.about_center()).map_err(BuildError::from)?;
    }
    let (name, gravity) = (human.model.name().to_owned(), human.model.gravity());
    let (coordinates, markers) = (human.model.coordinates().to_vec(), human.model.markers().to_vec());
    human.model = Model::new(name, gravity, bodies, coordinates, markers).map_err(BuildError::from)?;
    Ok(human)
}

/// The axis with the smallest moment of inertia is the axis of the cylinder, with I = m r²/2.
fn thicker(body: &Body, ratio: f64) -> Result<Body, ReproductionError> {
    let (mass, own) = (body.inertia.mass(), body.inertia.about_center());
    let along = (0..3).min_by(|a, b| own[(*a, *a)].total_cmp(&own[(*b, *b)])).unwrap_or(1);
    let square = 2.0 * own[(along, along)] / mass * (ratio - 1.0);
    let mut more = Mat3::from_diagonal_element(0.25 * mass * square);
    more[(along, along)] = 0.5 * mass * square;
    let inertia = Inertia::new(mass, body.inertia.center(), own + more).map_err(BuildError::from)?;
    Ok(Body { inertia, ..body.clone() })
}
