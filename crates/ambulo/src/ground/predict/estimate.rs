//! Maximum a posteriori estimate of the loads of both feet, over the whole trial at once.
//!
//! The unknowns are the curves of [`super::unknowns`]: three forces and three moments of every stance, with the prior
//! of [`super::expected`]. The evidence is the total wrench that the motion of the whole body requires. Skin markers
//! show it only up to some frequency, so both sides are compared after a Gaussian low-pass filter G; sharper features,
//! such as the impact of a heel strike, come from the prior. In running the estimated vertical force also passes the
//! filter H of the motion ([`super::evidence_filter`]):
//!
//!   G ∗ (H ∗) Σ_feet F_i               = G ∗ F_total                        + noise
//!   G ∗ (H ∗) Σ_feet (r_i × F_i + T_i) = G ∗ M_total about the mass centre  + noise
//!
//! r_i leads from the mass centre to the expected centre of pressure of foot i ([`super::center_path`]). Both are
//! linear in the unknowns; with Gaussian noise and priors the estimate solves a banded linear system
//! ([`super::normal_equations`]), whose inverse is its covariance. In single support the force balance determines the
//! forces; in double support the lever rule between the feet, the normative curves at this walking speed and the
//! smoothness of the curves are weighted by their deviations.
//!
//! Where only some frames are wanted ([`Extent`]), the equations have the stances near them and the evidence from one
//! √(L/g) before the stances in progress: earlier steps are other unknowns, which later evidence does not change.
//!
//! Cost: the equations are linear in frames; the stances near each frame are searched among all of them, which is
//! noticeable from some thousand steps on. Memory: 370 bytes per frame of the result, 1.1 kB during the computation
//! (docs/STREAMING.md). Not handled: contact of hands and objects. Negative vertical forces are corrected afterwards
//! ([`super::unilateral`]).

use super::PredictError;
use super::evidence_filter::EvidenceFilters;
use super::expected::Expectation;
use super::loads::{FootLoads, FrameEstimate, loads, stance_estimates};
use super::misfit::misfits;
use super::normal_equations::NormalEquations;
use super::samples::EstimateInputs;
use super::stance_curves::StanceCurves;
use super::stances::Stance;
use super::unknowns::Unknowns;
use crate::model::BySide;
use std::ops::Range;

/// Longest part of a stance in progress that is evaluated before the wanted frames, in √(L/g): most of two steps.
const LONGEST_PAST: f64 = 4.0;

/// The part of a motion on which the wanted frames depend.
struct Extent {
    stances: Vec<Stance>,
    /// Frames whose total wrench is compared.
    evidence: Range<usize>,
}

impl Extent {
    /// The whole motion if all of its frames are wanted.
    fn of(inputs: &EstimateInputs<'_>, wanted: &Range<usize>, reach_s: f64) -> Extent {
        let EstimateInputs { grid, stances, body_scale, .. } = *inputs;
        if *wanted == (0..grid.frames) || wanted.is_empty() {
            return Extent { stances: stances.to_vec(), evidence: 0..grid.frames };
        }
        let [from, to] = [wanted.start, wanted.end - 1].map(|frame| grid.time(frame));
        let in_progress = stances.iter().filter(|stance| stance.start_s <= to && stance.end_s >= from);
        let earliest = in_progress.map(|stance| stance.start_s).fold(from, f64::min);
        let begin = earliest.max(from - LONGEST_PAST * body_scale.leg_time_s) - body_scale.leg_time_s;
        let near = |stance: &&Stance| stance.end_s >= begin - reach_s && stance.start_s <= grid.end_s() + reach_s;
        let first = ((begin - grid.start_s) / grid.step_s).max(0.0) as usize;
        Extent { stances: stances.iter().filter(near).cloned().collect(), evidence: first..grid.frames }
    }
}

/// Loads of the right and the left foot in the `wanted` frames.
///
/// # Errors
/// Equations that are too large or have no solution.
pub(super) fn estimate(
    inputs: &EstimateInputs<'_>,
    curves: &StanceCurves,
    wanted: Range<usize>,
) -> Result<BySide<FootLoads>, PredictError> {
    let EstimateInputs { grid, stances: all, body_scale, parameters, .. } = *inputs;
    let filters =
        EvidenceFilters::new(parameters.bandwidth_hz, inputs.motion_filter, inputs.motion_bandwidth_hz, grid, all);
    let Extent { stances, evidence } = Extent::of(inputs, &wanted, filters.longest().reach_s(grid));
    let inputs = &EstimateInputs { stances: &stances, ..*inputs };
    let expectations: Vec<Expectation<'_>> =
        stances.iter().map(|stance| Expectation::new(stance, all, curves, parameters, body_scale)).collect();
    let unknowns = Unknowns::new(&stances, body_scale, parameters);
    let equations = NormalEquations {
        inputs,
        unknowns: &unknowns,
        expectations: &expectations,
        filters: &filters,
        evidence: evidence.clone(),
    };
    let solution = equations.solve(wanted.len() < grid.frames)?;
    let of_stance = |(expectation, curves)| stance_estimates(inputs, expectation, curves, &solution, &wanted);
    let estimates: Vec<Vec<FrameEstimate>> = expectations.iter().zip(&unknowns.curves).map(of_stance).collect();
    let misfits = misfits(inputs, &estimates, &filters, &evidence);
    Ok(BySide::from_fn(|side| loads(side, inputs, &estimates, &misfits, &wanted)))
}
