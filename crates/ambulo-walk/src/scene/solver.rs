//! Reads the integrator, the impact law and the solver settings of a scene.

use super::SceneError;
use crate::dynamics::{Method, SolverSettings};
use crate::engine::{ImpactLaw, Integrator};
use crate::toml_reader::Table;

/// Why a scene has its integrator.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum IntegratorReason {
    /// The scene file states it.
    Stated,
    /// Nothing can touch and nothing is driven: the midpoint rule keeps the energy of the motion.
    FreeMotion,
    /// Surfaces may touch.
    MayTouch,
    /// A drive or a figure prescribes a motion.
    Driven,
}

impl IntegratorReason {
    /// Explanation for a reader.
    #[must_use]
    pub fn explanation(self) -> &'static str {
        match self {
            IntegratorReason::Stated => "as the scene states",
            IntegratorReason::FreeMotion => "chosen because nothing touches or is driven",
            IntegratorReason::MayTouch => "chosen because surfaces may touch",
            IntegratorReason::Driven => "chosen because the scene has drives or figures",
        }
    }
}

/// The impact law that only steps of impulses have.
pub(super) const STICKING: &str = "sticking";

/// The integrator of the file, or the one that fits the scene.
pub(super) fn read_integrator(
    root: &Table<'_>,
    of_scene: impl Fn() -> IntegratorReason,
) -> Result<(Integrator, IntegratorReason), SceneError> {
    let all = [Integrator::Impulse, Integrator::Midpoint, Integrator::RungeKutta];
    let words = all.map(|integrator| (integrator.word(), integrator));
    if let Some(value) = root.get("integrator") {
        return Ok((value.choice(&words)?, IntegratorReason::Stated));
    }
    let reason = of_scene();
    let keeps_energy = reason == IntegratorReason::FreeMotion;
    Ok((if keeps_energy { Integrator::Midpoint } else { Integrator::Impulse }, reason))
}

/// Reads the impact law; `sticking` requires the integrator `impulse`.
pub(super) fn read_impact(root: &Table<'_>, integrator: Integrator) -> Result<ImpactLaw, SceneError> {
    let words = [("coulomb", ImpactLaw::Coulomb), (STICKING, ImpactLaw::Sticking)];
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
