//! Forces with markers whose names say nothing, against those with the names.
//!
//! In recordings with a standing trial and clusters on thighs and shanks, knees and ankles keep their markers in the
//! standing trial alone, and at most [`KEPT`] other markers of each thigh and shank are left, with the names `m1`, `m2`
//! and so on in both files: the way most research laboratories record. The recordings are those of
//! crates/ambulo/tests/cluster_recordings.jsonl.

use super::spoiled::name;
use ambulo::analysis::Analysis;
use ambulo::findings::Findings;
use ambulo::job::{FileError, Job};
use ambulo::model::Side;
use ambulo::motion::MarkerPath;
use ambulo::study::validation::TextTable;
use ambulo::study::{
    self, GroundSettings, LaboratoryFile, Outcome, Recording, Settings, Source, StandingTrial, Tracking,
};
use std::path::Path;
use std::sync::Arc;

const LIST: &str = include_str!("../../../../crates/ambulo/tests/cluster_recordings.jsonl");
/// The coordinates whose moments are compared, without the side.
const JOINTS: [&str; 3] = ["ankle_angle", "knee_angle", "hip_flexion"];
/// Technical markers that a thigh or shank keeps.
const KEPT: usize = 3;
/// Weight of markers that define a joint.
const AT_JOINT: f64 = 1.0;

/// Markers of thighs and shanks.
#[derive(Default)]
struct LegMarkers {
    at_joints: Vec<String>,
    /// The technical markers that are left.
    kept: Vec<String>,
    dropped: Vec<String>,
}

/// The table with the words around it.
pub(super) fn section(data: &Path, only: &str) -> Result<String, String> {
    let mut table = TextTable::new(&[
        "recording",
        "renamed",
        "used",
        "of",
        "with names",
        "of",
        "vertical",
        "with names",
        "ankle",
        "knee",
        "hip flexion",
    ]);
    for line in LIST.lines() {
        let job: Job = serde_json::from_str(line).map_err(|e| format!("{line}: {e}"))?;
        if name(job.recording()).contains(only) {
            table.row(row(data, &job)?);
        }
    }
    Ok(format!(
        "## Markers without names\n\nAt most {KEPT} technical markers of each thigh and shank are left, with names \
         that \
         say nothing, and knee and ankle markers are in the\nstanding trial alone. `used`: markers that the body \
         follows, of all; `vertical`: error of the predicted vertical force, mean of the\nfeet [% of body weight]; \
         root mean square difference of the measured moments of both legs from those with all names [N.m/kg].\n\n{}",
        table.text()
    ))
}

fn row(data: &Path, job: &Job) -> Result<Vec<String>, String> {
    let mut files = |path: &Path| std::fs::read(data.join(path)).map_err(FileError::from);
    let source = job.read(&mut files, &mut Findings::default()).map_err(|error| error.text())?.source;
    let recorded = computed(source.clone())?;
    let legs = LegMarkers::of(&recorded);
    let renamed = computed(legs.renamed(source)?)?;
    let [(used, all), (before, of)] = [&renamed, &recorded].map(counts);
    let counts = [legs.kept.len(), used, all, before, of].map(|count| count.to_string());
    let errors = [&renamed, &recorded].map(|outcome| word(vertical_error(outcome), 1));
    let moments = JOINTS.map(|joint| word(difference([&recorded, &renamed], joint), 3));
    Ok([name(job.recording())].into_iter().chain(counts).chain(errors).chain(moments).collect())
}

fn word(value: Option<f64>, decimals: usize) -> String {
    value.map_or_else(|| "-".to_owned(), |value| format!("{value:.decimals$}"))
}

fn computed(source: Source) -> Result<Outcome, String> {
    let settings = Settings { ground: GroundSettings::Predicted, ..Settings::default() };
    study::run(source, &settings, &mut Findings::default()).map_err(|error| error.to_string())
}

/// Markers that the body follows, and all markers of the recording.
fn counts(outcome: &Outcome) -> (usize, usize) {
    let Some(Tracking::Markers(tracked)) = &outcome.tracking else { return (0, 0) };
    let used = tracked.body.fit.errors.iter().filter(|error| error.rms_m.is_finite()).count();
    (used, tracked.body.recorded_markers)
}

impl LegMarkers {
    fn of(outcome: &Outcome) -> LegMarkers {
        let Some(Tracking::Markers(tracked)) = &outcome.tracking else { return LegMarkers::default() };
        let subject = &tracked.body.subject;
        let legs = subject.model.anatomy().legs();
        let segments = Side::BOTH.into_iter().filter_map(|side| legs[side].as_ref());
        let mut found = LegMarkers::default();
        for body in segments.flat_map(|leg| [leg.thigh, leg.shank]) {
            let own = subject.model.markers().iter().filter(|marker| marker.body == Some(body));
            let (at_joints, mut technical): (Vec<_>, Vec<_>) = own
                .map(|marker| marker.name.clone())
                .partition(|name| subject.weights.get(name).is_none_or(|weight| *weight >= AT_JOINT));
            found.dropped.extend(technical.split_off(technical.len().min(KEPT)));
            found.at_joints.extend(at_joints);
            found.kept.extend(technical);
        }
        found
    }

    /// The recording and its standing trial with few names.
    fn renamed(&self, mut source: Source) -> Result<Source, String> {
        let Recording::Markers(markers) = &mut source.recording else { return Err("no markers".to_owned()) };
        let still = markers.standing.as_ref().ok_or("no standing trial")?;
        let mut still = LaboratoryFile::clone(still);
        self.rename(&mut still.recording.markers.markers);
        let moving = &mut markers.trial.recording.markers.markers;
        moving.retain(|path| !self.at_joints.contains(&path.name));
        self.rename(moving);
        markers.standing = Some(Arc::new(StandingTrial::new(still)));
        Ok(source)
    }

    fn rename(&self, paths: &mut Vec<MarkerPath>) {
        paths.retain(|path| !self.dropped.contains(&path.name));
        for path in paths {
            if let Some(number) = self.kept.iter().position(|name| *name == path.name) {
                path.name = format!("m{}", number + 1);
            }
        }
    }
}

/// Error of the predicted vertical force, mean of the feet [% of body weight]; `None` where no plate measured a foot.
fn vertical_error(outcome: &Outcome) -> Option<f64> {
    let feet = &outcome.prediction.as_ref()?.agreement.as_ref()?.feet;
    Some(feet.iter().map(|foot| 100.0 * foot.vertical.rmse_bw).sum::<f64>() / feet.len() as f64)
}

/// Root mean square difference of a measured moment of both legs in the frames of both [N.m/kg].
fn difference(outcomes: [&Outcome; 2], joint: &str) -> Option<f64> {
    let measured: Vec<&Analysis> =
        outcomes.iter().filter_map(|outcome| outcome.prediction.as_ref()?.measured.as_ref()).collect();
    let [recorded, renamed] = measured[..] else { return None };
    let grids = [recorded, renamed].map(|analysis| analysis.trajectory.grid());
    let shift = ((grids[1].start_s - grids[0].start_s) / grids[0].step_s).round() as i64;
    let (mut count, mut sum) = (0.0, 0.0);
    for side in Side::BOTH {
        let id = outcomes[0].body.coordinate(&format!("{joint}_{}", side.letter()))?.index();
        for (frame, moment) in renamed.forces.generalized[id].iter().enumerate() {
            let other = usize::try_from(frame as i64 + shift).ok();
            let other = other.and_then(|frame| recorded.forces.generalized[id].get(frame));
            if let Some(other) = other.filter(|other| other.is_finite() && moment.is_finite()) {
                count += 1.0;
                sum += (moment - other).powi(2);
            }
        }
    }
    Some((sum / count).sqrt() / recorded.mass.kg)
}
