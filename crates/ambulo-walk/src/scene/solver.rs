//! Reads the integrator, the impact law and the solver settings of a scene.

use super::SceneError;
use crate::dynamics::{Method, SolverSettings};
use crate::engine::{ImpactLaw, Integrator};
use crate::toml_reader::Table;

pub(super) fn read_integrator(root: &Table<'_>) -> Result<Integrator, SceneError> {
    let all = [Integrator::Impulse, Integrator::Midpoint, Integrator::RungeKutta];
    let words = all.map(|integrator| (integrator.word(), integrator));
    root.get("integrator").map_or(Ok(Integrator::Impulse), |value| value.choice(&words))
}

/// Reads the impact law; `sticking` requires the integrator `impulse`.
pub(super) fn read_impact(root: &Table<'_>, integrator: Integrator) -> Result<ImpactLaw, SceneError> {
    let words = [("coulomb", ImpactLaw::Coulomb), ("sticking", ImpactLaw::Sticking)];
    let Some(value) = root.get("impact") else { return Ok(ImpactLaw::Coulomb) };
    let impact = value.choice(&words)?;
    if impact == ImpactLaw::Sticking && integrator != Integrator::Impulse {
        return Err(value.wrong(&format!("\"coulomb\" with the integrator \"{}\"", integrator.word())));
    }
    Ok(impact)
}

pub(super) fn read_solver(root: &Table<'_>) -> Result<SolverSettings, SceneError> {
    let default = SolverSettings::default();
    let Some(value) = root.get("solver") else { return Ok(default) };
    let table = value.table("a table under the header [solver]")?;
    table.only(&[&["method", "tolerance", "max_iterations"]])?;
    let words = [("newton", Method::Newton), ("conjugate-gradient", Method::ConjugateGradient)];
    let tolerance = table.above_zero_or("tolerance", default.tolerance)?;
    if let Some(value) = table.get("tolerance").filter(|_| tolerance >= 1.0) {
        return Err(value.wrong("a number between 0 and 1"));
    }
    Ok(SolverSettings {
        method: table.get("method").map_or(Ok(default.method), |value| value.choice(&words))?,
        tolerance,
        max_iterations: table.get("max_iterations").map_or(Ok(default.max_iterations), |value| value.count())?,
    })
}
