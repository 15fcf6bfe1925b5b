//! Muscle forces of a motion, and whether the muscles were strong enough.

use crate::analysis::Analysis;
use crate::findings::{Code, Findings};
use crate::model::{BySide, CoordinateId, CoordinateKind, Model};
use crate::muscles::contact_loads::LegLoads;
use crate::muscles::emg::{EmgComparison, EmgTrial};
use crate::muscles::set::MuscleSet;
use crate::muscles::trial::{MuscleTrial, ReserveUse};
use std::collections::BTreeSet;

/// Motors that add more than this share of the largest moment of a coordinate are a warning (OpenSim's documentation,
/// page "Reserves and Residuals").
const LARGE_RESERVE: f64 = 0.1;
/// Least moment that a share is taken of, in N.m for each kilogram of body mass: smaller ones are noise.
const LEAST_MOMENT: f64 = 0.05;

/// Muscle forces of a motion and what follows from them.
#[derive(Debug, Clone)]
pub struct MuscleOutcome {
    /// The muscles of the body, in its size.
    pub set: MuscleSet,
    /// Whether they are those of the built-in body.
    pub is_built_in: bool,
    /// Activations, tensions, lengths and reserves.
    pub trial: MuscleTrial,
    /// Loads of hip, knee and ankle; `None` for a leg that the model does not have.
    pub loads: BySide<Option<LegLoads>>,
    /// The same with the measured forces of [`PredictedGround::measured`](super::PredictedGround::measured), for a
    /// result that holds measured and predicted forces.
    pub measured_loads: Option<BySide<Option<LegLoads>>>,
    /// Envelopes of the recorded channels.
    pub emg: Option<EmgTrial>,
    /// Envelopes beside activations.
    pub agreement: Vec<EmgComparison>,
    /// Coordinates inside the body that muscles cross and that no motor of the model drives.
    pub(super) crossed: BTreeSet<CoordinateId>,
}

impl MuscleOutcome {
    /// The coordinate whose muscles lack most of the moment that the motion needs, with the share that they lack.
    /// Coordinates of joints to ground are left out, because what they need is the residual of inverse dynamics,
    /// coordinates that no muscle crosses, and those that a motor of the model drives.
    #[must_use]
    pub fn weakest(&self, body: &Model) -> Option<(ReserveUse, f64)> {
        let least = LEAST_MOMENT * body.mass();
        let share = |used: ReserveUse| (used, used.largest / used.net.max(least));
        let all = self.trial.reserve_use().into_iter().filter(|used| self.crossed.contains(&used.coordinate));
        all.map(share).max_by(|(_, a), (_, b)| a.total_cmp(b))
    }

    /// Warns where strength was not enough, where nothing could give a moment, and where paths ended inside a surface.
    pub(super) fn report(&self, body: &Model, analysis: &Analysis, findings: &mut Findings) {
        let grid = analysis.trajectory.grid();
        if let Some((used, share)) = self.weakest(body).filter(|(_, share)| *share > LARGE_RESERVE) {
            let coordinate = &body.coordinates()[used.coordinate.index()];
            let unit = if coordinate.kind == CoordinateKind::Rotation { "N.m" } else { "N" };
            let message = format!(
                "the muscles are too weak at {} at {:.2} s: motors add up to {:.1} {unit}, {:.0} % of the largest \
                 moment there; forces of muscles and loads of this joint are too small by as much",
                coordinate.name,
                grid.time(used.frame),
                used.largest,
                100.0 * share
            );
            findings.report(Code::MusclesReserves, message);
        }
        if let Some(first) = self.trial.unmet_frames.first() {
            let message = format!(
                "muscles and motors together cannot give the moments in {} of {} frames, first at {:.2} s",
                self.trial.unmet_frames.len(),
                grid.frames,
                grid.time(*first)
            );
            findings.report(Code::MusclesUnmet, message);
        }
        let inside = self.set.muscles.iter().zip(&self.trial.muscles).filter(|(_, series)| series.inside_frames > 0);
        let inside: Vec<String> =
            inside.map(|(muscle, series)| format!("`{}` ({})", muscle.name, series.inside_frames)).collect();
        if !inside.is_empty() {
            let message = format!(
                "paths end inside a surface and run straight there, in this number of {} frames: {}",
                grid.frames,
                inside.join(", ")
            );
            findings.report(Code::MusclesInsideWrap, message);
        }
    }
}
