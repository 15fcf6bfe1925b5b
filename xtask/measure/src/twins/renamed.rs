//! Joint moments with markers whose names say nothing, against those with the names.
//!
//! Of the first clean recording of each person with a standing trial, the technical markers of thighs and shanks are
//! renamed `m1`, `m2` and so on in both files, and the markers of knees and ankles are left in the standing trial
//! alone: the way most research laboratories record. People with fewer than two technical markers on a thigh or shank
//! are left out, because with one the segment is not shown, which a warning says.

use super::changes::bare;
use super::clean::{Files, people};
use super::spoiled::{Trial, name};
use ambulo::findings::Findings;
use ambulo::model::Side;
use ambulo::study::validation::TextTable;
use ambulo::study::{Outcome, Tracking};
use ambulo_formats::c3d::C3d;
use std::path::Path;

/// The coordinates whose moments are compared, without the side.
const JOINTS: [&str; 3] = ["ankle_angle", "knee_angle", "hip_flexion"];
/// Fewest technical markers on a thigh or shank.
const FEWEST: usize = 2;
/// Weight of markers that define a joint.
const AT_JOINT: f64 = 1.0;

/// Markers of thighs and shanks.
#[derive(Default)]
struct LegMarkers {
    at_joints: Vec<String>,
    technical: Vec<String>,
    /// Smallest number of technical markers on one of the segments.
    fewest: usize,
}

/// The table with the words around it.
pub(super) fn section(data: &Path, only: &str) -> Result<String, String> {
    let mut table =
        TextTable::new(&["recording", "renamed", "used", "of", "with names", "of", "ankle", "knee", "hip flexion"]);
    let first = people(data).into_iter().filter_map(|trials| trials.into_iter().next());
    for files in first.filter(|files| files.standing.is_some() && name(&files.trial).contains(only)) {
        if let Some(row) = row(&files)? {
            table.row(row);
        }
    }
    Ok(format!(
        "## Markers without names\n\nTechnical markers of thighs and shanks are renamed, and knee and ankle markers \
         are in the standing trial alone. `used`: markers of the\nwalk that the body follows, of all; root mean square \
         difference of the moments of both legs from those with all names [N.m/kg].\n\n{}",
        table.text()
    ))
}

/// `None` for a person with too few technical markers.
fn row(files: &Files) -> Result<Option<[String; 9]>, String> {
    let recorded = Trial::read(files, files)?.computed(&mut Findings::default())?;
    let legs = leg_markers(&recorded);
    if legs.fewest < FEWEST {
        return Ok(None);
    }
    let mut trial = Trial::read(files, files)?;
    trial.moving.points.retain(|point| !legs.at_joints.iter().any(|name| name == bare(&point.name)));
    rename(&mut trial.moving, &legs.technical);
    rename(trial.standing.as_mut().ok_or("no standing trial")?, &legs.technical);
    let renamed = trial.computed(&mut Findings::default())?;
    let [(used, all), (before, of)] = [&renamed, &recorded].map(counts);
    let numbers = [legs.technical.len(), used, all, before, of].map(|count| count.to_string());
    let [renamed_count, used, all, before, of] = numbers;
    let [ankle, knee, hip] = JOINTS.map(|joint| format!("{:.3}", difference([&recorded, &renamed], joint)));
    Ok(Some([name(&files.trial), renamed_count, used, all, before, of, ankle, knee, hip]))
}

fn rename(file: &mut C3d, names: &[String]) {
    for point in &mut file.points {
        if let Some(number) = names.iter().position(|name| name == bare(&point.name)) {
            point.name = format!("m{}", number + 1);
        }
    }
}

/// Markers that the body follows, and all markers of the recording.
fn counts(outcome: &Outcome) -> (usize, usize) {
    let Some(Tracking::Markers(tracked)) = &outcome.tracking else { return (0, 0) };
    let used = tracked.body.fit.errors.iter().filter(|error| error.rms_m.is_finite()).count();
    (used, tracked.body.recorded_markers)
}

fn leg_markers(outcome: &Outcome) -> LegMarkers {
    let Some(Tracking::Markers(tracked)) = &outcome.tracking else { return LegMarkers::default() };
    let subject = &tracked.body.subject;
    let legs = subject.model.anatomy().legs();
    let segments = Side::BOTH.into_iter().filter_map(|side| legs[side].as_ref());
    let mut found = LegMarkers { fewest: usize::MAX, ..LegMarkers::default() };
    for body in segments.flat_map(|leg| [leg.thigh, leg.shank]) {
        let own = subject.model.markers().iter().filter(|marker| marker.body == Some(body));
        let (at_joints, technical): (Vec<_>, Vec<_>) = own
            .map(|marker| marker.name.clone())
            .partition(|name| subject.weights.get(name).is_none_or(|weight| *weight >= AT_JOINT));
        found.fewest = found.fewest.min(technical.len());
        found.at_joints.extend(at_joints);
        found.technical.extend(technical);
    }
    found
}

/// Root mean square difference of a moment of both legs in the frames of both [N.m/kg].
fn difference([recorded, renamed]: [&Outcome; 2], joint: &str) -> f64 {
    let grids = [recorded, renamed].map(|outcome| outcome.analysis.trajectory.grid());
    let shift = ((grids[1].start_s - grids[0].start_s) / grids[0].step_s).round() as i64;
    let (mut count, mut sum) = (0.0, 0.0);
    for side in Side::BOTH {
        let name = format!("{joint}_{}", side.letter());
        let moments = [recorded, renamed].map(|outcome| {
            let id = outcome.body.coordinate(&name);
            id.map_or(&[][..], |id| &outcome.complete().forces.generalized[id.index()])
        });
        for (frame, moment) in moments[1].iter().enumerate() {
            let other = usize::try_from(frame as i64 + shift).ok().and_then(|frame| moments[0].get(frame));
            if let Some(other) = other {
                count += 1.0;
                sum += (moment - other).powi(2);
            }
        }
    }
    (sum / count).sqrt() / recorded.analysis.mass.kg
}
