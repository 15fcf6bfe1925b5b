//! The loads of both feet, estimated over the whole trial at once.
//!
//! Unknown are the curves of [`super::unknowns`]: three forces and three moments of every stance, near what is expected of it. What is
//! seen is what the whole body's motion asks of the ground. Markers on skin show it up to some frequency only, so both sides are compared
//! behind a low-pass G of Gaussian shape ([`super::taps`]); what is sharper, as a heel strike, comes from what is expected:
//!
//!   G ∗ Σ_feet F_i               = G ∗ F_total                            + noise
//!   G ∗ Σ_feet (r_i × F_i + T_i) = G ∗ M_total about the mass centre      + noise
//!
//! r_i leads from the mass centre to the expected centre of pressure of foot i ([`super::center_path`]). Both are linear in the unknowns; with Gaussian noise and expectations the likeliest curves solve a
//! band of linear equations ([`super::system`]), whose inverse tells how far they may be off. In single support the forces decide; in
//! double support the lever rule between the feet, what is expected of people who walk at this speed, and the smoothness of a stance
//! share the decision by their noise.
//!
//! Cost: the equations are linear in frames; which stances are near an instant is looked up among all of them, which is felt from some
//! thousand steps on. Memory: 370 bytes a frame held, 2.3 kB while it is made (docs/STREAMING.md).
//! Not handled: hands and objects. What would pull is put right afterwards ([`super::unilateral`]).

use super::PredictError;
use super::expected::Expectation;
use super::loads::{FootLoads, loads};
use super::samples::{Evidence, Samples};
use super::stance_curves::StanceCurves;
use super::system::System;
use super::taps::Taps;
use super::unknowns::Unknowns;
use crate::model::BySide;

/// Loads of right and left foot.
///
/// # Errors
/// Those of the equations.
pub(super) fn estimate(evidence: &Evidence<'_>, curves: &StanceCurves) -> Result<BySide<FootLoads>, PredictError> {
    let Evidence { grid, stances, measure, weights, .. } = *evidence;
    let expectations: Vec<Expectation<'_>> =
        stances.iter().map(|stance| Expectation::new(stance, stances, curves, weights, measure)).collect();
    let unknowns = Unknowns::new(stances, measure, weights);
    let taps = Taps::new(weights.bandwidth_hz, grid);
    let samples: Vec<Samples> = expectations
        .iter()
        .zip(&unknowns.curves)
        .map(|(expectation, curves)| Samples::new(evidence, expectation, curves, taps.stride))
        .collect();
    let solution = System { evidence, unknowns: &unknowns, samples: &samples, taps: &taps }.solve()?;
    Ok(BySide::from_fn(|side| loads(side, evidence, &expectations, &unknowns, &solution)))
}
