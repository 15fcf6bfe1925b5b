//! The motion changed to obey the forces, if the user asked for it.

use crate::args::{Consistency, ForcesArgs};
use ambulo::analysis::{Adjustable, Analysis, Settings};
use ambulo::findings::Findings;
use ambulo::model::Model;
use ambulo_results::{ConsistencySummary, GroundSource, Input};
use anyhow::{Context, Result};

/// Changes motion and body; says how. Predicted forces grow with the mass, so they tell nothing of it.
pub(super) fn agree(
    args: &ForcesArgs,
    model: &mut Model,
    analysis: &mut Analysis,
    input: &Input,
    settings: &Settings,
    findings: &mut Findings,
) -> Result<Option<ConsistencySummary>> {
    let is_predicted = matches!(input.ground_source, GroundSource::Predicted { .. });
    let adjustable = match args.consistent {
        None => return Ok(None),
        Some(Consistency::Motion) => Adjustable::Motion,
        Some(Consistency::Body) if is_predicted => Adjustable::Motion,
        Some(Consistency::Body) => Adjustable::MotionAndBody,
    };
    let settings = Settings { instrumented: settings.instrumented.filter(|_| !is_predicted), ..*settings };
    let done = ambulo::analysis::agree(model, analysis, &settings, adjustable, findings).context("--consistent")?;
    let summary = ConsistencySummary::of(&done);
    *model = done.model;
    Ok(Some(summary))
}
