//! Maximum a posteriori estimate of the loads of both feet, over the whole trial at once.
//!
//! The unknowns are the curves of [`super::unknowns`]: three forces and three moments of every stance, with the prior of
//! [`super::expected`]. The evidence is the total wrench that the motion of the whole body requires. Skin markers show it only up to
//! some frequency, so both sides are compared after a Gaussian low-pass filter G; sharper features, such as the impact of a heel strike, come
//! from the prior. In running the estimated vertical force also passes the filter H of the motion ([`super::evidence_filter`]):
//!
//!   G ∗ (H ∗) Σ_feet F_i               = G ∗ F_total                        + noise
//!   G ∗ (H ∗) Σ_feet (r_i × F_i + T_i) = G ∗ M_total about the mass centre  + noise
//!
//! r_i leads from the mass centre to the expected centre of pressure of foot i ([`super::center_path`]). Both are linear in the
//! unknowns; with Gaussian noise and priors the estimate solves a banded linear system ([`super::normal_equations`]), whose inverse is
//! its covariance. In single support the force balance determines the forces; in double support the lever rule between the feet, the
//! normative curves at this walking speed and the smoothness of the curves are weighted by their deviations.
//!
//! Cost: the equations are linear in frames; the stances near each frame are searched among all of them, which is noticeable from
//! some thousand steps on. Memory: 370 bytes per frame of the result, 1.1 kB during the computation (docs/STREAMING.md).
//! Not handled: contact of hands and objects. Negative vertical forces are corrected afterwards ([`super::unilateral`]).

use super::PredictError;
use super::evidence_filter::EvidenceFilters;
use super::expected::Expectation;
use super::loads::{FootLoads, FrameEstimate, loads, stance_estimates};
use super::misfit::misfits;
use super::normal_equations::NormalEquations;
use super::samples::EstimateInputs;
use super::stance_curves::StanceCurves;
use super::unknowns::Unknowns;
use crate::model::BySide;

/// Loads of the right and the left foot.
///
/// # Errors
/// Equations that are too large or have no solution.
pub(super) fn estimate(inputs: &EstimateInputs<'_>, curves: &StanceCurves) -> Result<BySide<FootLoads>, PredictError> {
    let EstimateInputs { grid, stances, body_scale, parameters, .. } = *inputs;
    let expectations: Vec<Expectation<'_>> =
        stances.iter().map(|stance| Expectation::new(stance, stances, curves, parameters, body_scale)).collect();
    let unknowns = Unknowns::new(stances, body_scale, parameters);
    let filters = EvidenceFilters::new(parameters.bandwidth_hz, inputs.motion_filter, grid, stances);
    let solution =
        NormalEquations { inputs, unknowns: &unknowns, expectations: &expectations, filters: &filters }.solve()?;
    let of_stance = |(expectation, curves)| stance_estimates(inputs, expectation, curves, &solution);
    let estimates: Vec<Vec<FrameEstimate>> = expectations.iter().zip(&unknowns.curves).map(of_stance).collect();
    let misfits = misfits(inputs, &estimates, &filters);
    Ok(BySide::from_fn(|side| loads(side, inputs, &estimates, &misfits)))
}
