//! Reads a trial of an AddBiomechanics subject (`.b3d`). Header and trial are read alone, so that files of any size can
//! be used.

use super::error::{At, Field, JobError};
use super::files::Files;
use super::{Job, Reading, markers};
use crate::motion::B3dTrial;
use crate::study::Source;
use ambulo_formats::b3d::{Header, LENGTH_BYTES};
use ambulo_formats::osim::OsimModel;
use std::path::Path;

/// Description of the expected file.
const NAME: &str = "a subject of AddBiomechanics (.b3d)";
/// Bytes that show what another file is.
const CONTENT_BYTES: usize = 4096;
/// Most trials that a message lists.
const LISTED: usize = 8;

pub(super) fn read(job: &Job, reading: &mut Reading<'_>) -> Result<Source, JobError> {
    let shown = job.shown();
    check(job)?;
    let header = read_header(reading.files, job.recording())?;
    let trial = chosen(&header, job.trial.as_deref()).map_err(|error| error.within(shown.clone()))?;
    let Some(place) = header.trial_place(trial) else {
        let what = "its header states more bytes than any file has. Is it damaged?";
        return Err(JobError::new(&[], what).within(shown));
    };
    let bytes = reading.files.read_part(job.recording(), place).map_err(JobError::of_file)?;
    let frames = header.read_trial(trial, &bytes).at(shown.clone())?;
    drop(bytes);
    (reading.progress)("read_trial");
    let name = format!("{shown}, trial {}", header.trials[trial].name);
    let of_file = B3dTrial { header: &header, trial, frames: &frames, name: &name };
    if job.muscles.is_some() && job.model.is_none() {
        let text = of_file.model_text().at(name.clone())?;
        reading.own_model = Some(OsimModel::read(text.as_bytes()).at(name.clone())?);
    }
    let window = job.settings.window;
    let source = match job.model {
        None => Source::of_b3d(&of_file, window, reading.findings),
        Some(_) => {
            let body = markers::body(job, reading)?;
            Source::of_b3d_markers(&of_file, body, window, reading.findings)
        }
    };
    let source = source.at(name)?;
    Ok(Source { added_mass: job.added_mass.clone(), stated: job.size, ..source })
}

/// The header of a `.b3d`.
///
/// # Errors
/// A file that cannot be read, or is no `.b3d`.
pub fn read_header(files: &mut dyn Files, path: &Path) -> Result<Header, JobError> {
    let mut start = |count: usize| files.read_part(path, 0..count).map_err(JobError::of_file);
    let length = Header::length(&start(LENGTH_BYTES)?);
    let length = match length {
        Err(error) => return Err(error.or_other_content(&start(CONTENT_BYTES)?, NAME)).in_file(path),
        Ok(length) => length,
    };
    Header::read(&start(length)?).in_file(path)
}

/// The trial with this name or number; without either the only one.
fn chosen(header: &Header, wanted: Option<&str>) -> Result<usize, JobError> {
    let trials = &header.trials;
    let listed = || {
        let names = trials.iter().take(LISTED).enumerate().map(|(k, trial)| format!("{} ({})", k + 1, trial.name));
        let more = if trials.len() > LISTED { ", ..." } else { "" };
        format!("{}{more}", names.collect::<Vec<_>>().join(", "))
    };
    let refused = |what: String| JobError::new(&[Field::Trial], what);
    if trials.is_empty() {
        return Err(JobError::new(&[], "the file has no trials"));
    }
    let Some(wanted) = wanted else {
        return match trials.len() {
            1 => Ok(0),
            count => Err(refused(format!("the file has {count} trials; expected one of {}", listed()))),
        };
    };
    let number = wanted.parse().ok().filter(|number| (1..=trials.len()).contains(number));
    let found = trials.iter().position(|trial| trial.name == wanted).or(number.map(|number| number - 1));
    let unknown = || refused(format!("the file has no trial `{wanted}`; expected one of {}", listed()));
    found.ok_or_else(unknown)
}

/// Rejects fields without effect.
fn check(job: &Job) -> Result<(), JobError> {
    let never = [
        (Field::ForceTable, job.forces.table.is_some()),
        (Field::Loads, job.forces.loads.is_some()),
        (Field::Standing, job.standing.is_some()),
        (Field::Plates, !job.plates.is_empty()),
    ];
    let of_markers = [
        (Field::Markers, job.markers.is_some()),
        (Field::Segments, job.has_other_segments()),
        (Field::Fit, job.settings.fit.is_some()),
    ];
    if let Some((field, _)) = never.into_iter().find(|(_, given)| *given) {
        let what = format!("the {} cannot be used with a .b3d, which has its own ground forces", field.name());
        return Err(JobError::new(&[field], what).within(job.shown()));
    }
    if job.model.is_some() {
        return markers::check(job);
    }
    match of_markers.into_iter().chain(job.of_joints()).find(|(_, given)| *given) {
        Some((field, _)) => {
            let what = format!(
                "the {} can only be used with markers, but the file's own model and coordinates are used; expected a \
                 model, or the built-in body, to fit the markers",
                field.name()
            );
            Err(JobError::new(&[field, Field::Model], what).within(job.shown()))
        }
        None => Ok(()),
    }
}
