//! Reads measured ground forces from the table and the external loads of a job.

use super::error::{At, Field, JobError};
use super::files::{Files, note_remarks, read as read_file, read_table};
use super::values::FootColumns;
use super::{ForceFiles, Job, Reading};
use crate::study::{ForceTable, GroundSettings, MeasuredForces};
use ambulo_formats::external_loads::{ExternalForce, ExternalLoads};
use std::path::{Path, PathBuf};

/// The forces of the table or of the loads; the forces in the recording if neither was given.
pub(super) fn read(job: &Job, reading: &mut Reading<'_>) -> Result<MeasuredForces, JobError> {
    let ForceFiles { table, loads: loads_path, .. } = &job.forces;
    if job.settings.ground == GroundSettings::NoContact || (table.is_none() && loads_path.is_none()) {
        return Ok(MeasuredForces::InRecording);
    }
    let loads = loads_path.as_deref().map(|path| read_loads(path, reading)).transpose()?;
    let path = match (table, &loads) {
        (Some(path), _) => path.clone(),
        (None, Some(loads)) => data_file(loads_path.as_deref(), loads, reading.files)?,
        (None, None) => return Ok(MeasuredForces::InRecording),
    };
    let table = read_table(reading.files, &path, reading.findings)?;
    reading.read.push(path.clone());
    reading.read.extend(loads_path.clone());
    reading.ground = Some(path);
    Ok(MeasuredForces::Table(ForceTable { table, loads: loads.or_else(|| named(&job.forces)) }))
}

fn read_loads(path: &Path, reading: &mut Reading<'_>) -> Result<ExternalLoads, JobError> {
    let shown = path.display().to_string();
    let (loads, remarks) = ExternalLoads::read(&read_file(reading.files, path)?).in_file(path)?;
    note_remarks(&shown, &remarks, reading.findings);
    Ok(loads)
}

/// The data file named in the external loads: by its relative path, or a file of that name in the same folder.
fn data_file(xml: Option<&Path>, loads: &ExternalLoads, files: &mut dyn Files) -> Result<PathBuf, JobError> {
    let Some(named) = &loads.datafile else {
        let what = "the external loads name no <datafile>; expected the table of ground forces";
        return Err(JobError::new(&[Field::ForceTable], what));
    };
    let folder = xml.and_then(Path::parent).unwrap_or(Path::new(""));
    let named = Path::new(named);
    let in_folder = named.file_name().map(|name| folder.join(name));
    let candidates = [Some(folder.join(named)), in_folder];
    candidates.into_iter().flatten().find(|path| files.has(path)).ok_or_else(|| {
        let what = format!(
            "the external loads name the data file `{}`, which does not exist; expected the table of ground forces",
            named.display()
        );
        JobError::new(&[Field::ForceTable], what)
    })
}

/// The stated columns of the feet.
fn named(files: &ForceFiles) -> Option<ExternalLoads> {
    let feet = [("right", &files.right), ("left", &files.left)];
    let force = |(side, foot): (&str, &Option<FootColumns>)| {
        foot.as_ref().map(|FootColumns { body, prefix }| ExternalForce::with_prefix(side, body, prefix))
    };
    let forces: Vec<ExternalForce> = feet.into_iter().filter_map(force).collect();
    (!forces.is_empty()).then(|| ExternalLoads { name: "feet".into(), datafile: None, forces })
}
