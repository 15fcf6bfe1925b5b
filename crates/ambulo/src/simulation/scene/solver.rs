//! How a scene is stepped and solved.

use super::SceneError;
use crate::simulation::ImpactLaw;
use crate::toml_reader::Table;

/// How time goes on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Integrator {
    /// Velocity level, first order, impulses in every step.
    Impulse,
    /// Fourth order on smooth stretches, impulses where something touches.
    RungeKutta,
}

/// How loops and contacts are solved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Solver {
    /// The iteration.
    pub method: Method,
    /// Residual at which it stops, relative; between 0 and 1, both excluded.
    pub tolerance: f64,
    /// At most so many iterations a step, one or more.
    pub max_iterations: usize,
}

/// The iteration that solves loops and contacts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Method {
    /// Projected Newton steps.
    Newton,
    /// Conjugate gradients, as in 1997.
    ConjugateGradient,
}

impl Default for Solver {
    fn default() -> Solver {
        Solver { method: Method::Newton, tolerance: 1e-10, max_iterations: 100 }
    }
}

impl Integrator {
    pub(super) fn read(root: &Table<'_>) -> Result<Integrator, SceneError> {
        let words = [("impulse", Integrator::Impulse), ("runge-kutta", Integrator::RungeKutta)];
        root.get("integrator").map_or(Ok(Integrator::Impulse), |value| value.choice(&words))
    }
}

/// What becomes of the velocity of a point that strikes; `sticking` goes with steps of impulses alone.
pub(super) fn read_impact(root: &Table<'_>, integrator: Integrator) -> Result<ImpactLaw, SceneError> {
    let words = [("coulomb", ImpactLaw::Coulomb), ("sticking", ImpactLaw::Sticking)];
    let Some(value) = root.get("impact") else { return Ok(ImpactLaw::Coulomb) };
    let impact = value.choice(&words)?;
    if impact == ImpactLaw::Sticking && integrator == Integrator::RungeKutta {
        return Err(value.wrong("\"coulomb\" with the integrator \"runge-kutta\""));
    }
    Ok(impact)
}

impl Solver {
    pub(super) fn read(root: &Table<'_>) -> Result<Solver, SceneError> {
        let default = Solver::default();
        let Some(value) = root.get("solver") else { return Ok(default) };
        let table = value.table("a table under the header [solver]")?;
        table.only(&[&["method", "tolerance", "max_iterations"]])?;
        let words = [("newton", Method::Newton), ("conjugate-gradient", Method::ConjugateGradient)];
        let tolerance = table.above_zero_or("tolerance", default.tolerance)?;
        if let Some(value) = table.get("tolerance").filter(|_| tolerance >= 1.0) {
            return Err(value.wrong("a number between 0 and 1"));
        }
        Ok(Solver {
            method: table.get("method").map_or(Ok(default.method), |value| value.choice(&words))?,
            tolerance,
            max_iterations: table.get("max_iterations").map_or(Ok(default.max_iterations), |value| value.count())?,
        })
    }
}
