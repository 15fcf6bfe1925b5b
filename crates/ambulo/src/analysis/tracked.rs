//! Analysis of the motion nearest to a recorded one that feet on the ground can make.

use super::recording::Analysis;
use super::residual::residual;
use crate::dynamics::{Workspace, inverse_with_residual};
use crate::ground::footfalls::Footfall;
use crate::ground::predict::Prediction;
use crate::ground::{BodyForces, GroundForces};
use crate::model::anatomy::Sole;
use crate::model::{BySide, Model, Side};
use crate::motion::TimeGrid;
use crate::optimal::{FootGuide, TRACK_STAGES, TrackError, TrackProblem, TrackSettings, TrackedFoot, TrackedMotion};

/// Changes a motion until feet on soft ground supply its external forces ([`TrackProblem`]), near the recorded motion
/// and near predicted ground forces. `analysis` analyses the recorded motion with these forces.
///
/// Returns the analysis of the changed motion, and what the solver found. Events and cycles stay as in the recorded
/// motion.
///
/// # Errors
/// Models, floors and durations that are not supported: see [`TrackError`].
pub fn track(
    model: &Model,
    analysis: &Analysis,
    prediction: &Prediction,
    soles: &BySide<Option<Sole>>,
    settings: &TrackSettings,
) -> Result<(Analysis, TrackedMotion), TrackError> {
    let recorded = &analysis.trajectory;
    let no_feet = || TrackError::NoFeet { model: model.name().to_owned() };
    let soles = soles.both().ok_or_else(no_feet)?;
    let feet = BySide::from_fn(|side| guide(prediction, soles[side], side, recorded.grid()));
    let problem = TrackProblem::new(model, recorded, &feet, &analysis.forces.generalized, settings)?;
    let found = problem.solve(&TRACK_STAGES)?;
    let floor = vec![found.floor_m; recorded.grid().frames];
    let on_foot = |foot: &TrackedFoot| {
        let body = soles[foot.side].points[0].body;
        BodyForces::on_ground(body, &foot.force, &foot.moment, model.up(), &floor)
    };
    let ground = GroundForces { bodies: found.feet.iter().map(on_foot).collect() };
    let trajectory = found.trajectory.clone();
    let forces = inverse_with_residual(&mut Workspace::new(model), &trajectory, &ground.loads());
    let residual = residual(model, &forces);
    let recorded = Some(analysis.trajectory.clone());
    let analysis = Analysis { trajectory, recorded, ground, forces, residual, ..analysis.clone() };
    Ok((analysis, found))
}

/// Stances and expected forces of a foot, by a prediction.
fn guide(prediction: &Prediction, sole: Sole, side: Side, grid: TimeGrid) -> FootGuide {
    let falls: Vec<&Footfall> = prediction.footfalls.of(side).collect();
    let span = |fall: &&Footfall| [fall.strike_s.unwrap_or(grid.start_s), fall.off_s.unwrap_or(grid.end_s())];
    let (expected, _) = prediction.foot(side);
    FootGuide {
        sole,
        stances_s: falls.iter().map(span).collect(),
        floors_m: falls.iter().map(|fall| fall.floor_height_m).collect(),
        floor_velocities: falls.iter().map(|fall| fall.floor_velocity).collect(),
        force: expected.force.clone(),
        center: expected.center_of_pressure.clone(),
    }
}
