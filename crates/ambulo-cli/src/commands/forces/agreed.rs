//! The motion changed to obey the forces, if the user asked for it.

use crate::args::{Consistency, ForcesArgs};
use ambulo::analysis::{Adjustable, AnalysisError, Settings, agreed_motion};
use ambulo::findings::Findings;
use ambulo::kinematics::Trajectory;
use ambulo::model::Model;
use ambulo::motion::{ForceRecording, Window};
use ambulo::report::ConsistencySummary;

/// Body and motion to analyse, and how they were changed.
pub(super) struct Agreed {
    pub(super) model: Model,
    pub(super) trajectory: Trajectory,
    pub(super) summary: Option<ConsistencySummary>,
}

pub(super) fn agreed(
    args: &ForcesArgs,
    model: Model,
    trajectory: Trajectory,
    plates: &[ForceRecording],
    settings: &Settings,
    findings: &mut Findings,
) -> Result<Agreed, AnalysisError> {
    let adjustable = match args.consistent {
        None => return Ok(Agreed { model, trajectory, summary: None }),
        Some(Consistency::Motion) => Adjustable::Motion,
        Some(Consistency::Body) => Adjustable::MotionAndBody,
    };
    let done = agreed_motion(&model, &trajectory, plates, settings, adjustable, findings)?;
    let summary = Some(ConsistencySummary::of(&done));
    Ok(Agreed { model: done.model, trajectory: done.trajectory, summary })
}

/// The time in which the laws were enforced.
pub(super) fn window(summary: &ConsistencySummary) -> Window {
    let [from, to] = summary.window_s;
    Window { from_s: Some(from), to_s: Some(to) }
}
