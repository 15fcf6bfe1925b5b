//! A walking figure as sticks at some instants.

use super::figures::{PaperSeries, SeriesKind};
use super::mode::Run;
use super::steady::Steady;
use crate::kinematics::{BodyMotion, Posture, body_motion};
use crate::model::Model;

/// Instants of a step, from contact of the right foot to that of the left.
const INSTANTS: usize = 7;
/// Sticks, as markers of the figure: trunk and head, legs with feet, arms; those of the left side are drawn thin.
const STICKS: [(&[&str], SeriesKind); 5] = [
    (&["sacrum", "neck", "vertex"], SeriesKind::Line),
    (&["hip_l", "knee_l", "ankle_l", "heel_l", "toe_l", "ankle_l"], SeriesKind::Faint),
    (&["shoulder_l", "elbow_l", "wrist_l"], SeriesKind::Faint),
    (&["hip_r", "knee_r", "ankle_r", "heel_r", "toe_r", "ankle_r"], SeriesKind::Line),
    (&["shoulder_r", "elbow_r", "wrist_r"], SeriesKind::Line),
];
/// Distance between figures as drawn, beyond the way that they walk [m].
const APART_M: f64 = 0.55;

/// The figure at instants of a step of the first steady cycle, one beside the other.
pub(super) fn snapshots(run: &Run) -> Vec<PaperSeries> {
    let Ok(steady) = Steady::of(run) else { return Vec::new() };
    let (recording, mut series) = (&run.recording, Vec::new());
    let rows = steady.rows();
    let half = (0.5 * run.cycle_s / recording.grid().step_s) as usize;
    let mut start = f64::NAN;
    for instant in 0..INSTANTS {
        let row = rows.start + half * instant / (INSTANTS - 1);
        let motions = at_row(run, row);
        let root = motions[0].pose.translation.x;
        start = if start.is_nan() { root } else { start };
        let shift = APART_M * instant as f64 - start;
        for (names, kind) in STICKS {
            let points: Vec<[f64; 2]> = names
                .iter()
                .filter_map(|name| place(&recording.model, &motions, name))
                .map(|[x, y]| [x + shift, y])
                .collect();
            series.push(PaperSeries { name: String::new(), kind, points });
        }
    }
    series
}

fn at_row(run: &Run, row: usize) -> Vec<BodyMotion> {
    let (model, trajectory) = (&run.recording.model, &run.recording.trajectory);
    let q: Vec<f64> = model.coordinate_ids().map(|id| trajectory.values(id)[row]).collect();
    let still = vec![0.0; q.len()];
    body_motion(model, Posture { q: &q, qd: &still, qdd: &still })
}

fn place(model: &Model, motions: &[BodyMotion], name: &str) -> Option<[f64; 2]> {
    let marker = model.markers().iter().find(|marker| marker.name == name)?;
    let at = motions[marker.body?.index()].pose.place(marker.location);
    Some([at.x, at.y])
}
