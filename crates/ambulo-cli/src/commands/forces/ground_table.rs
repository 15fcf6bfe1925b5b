//! Reads measured ground forces from the table and the external loads that the options name.

use super::Reading;
use crate::args::{FootColumns, ForcesArgs};
use crate::caller::Caller;
use crate::files;
use ambulo::study::{ForceTable, MeasuredForces};
use ambulo_formats::external_loads::{ExternalForce, ExternalLoads};
use anyhow::{Context, Result, bail};
use std::path::{Path, PathBuf};

/// The forces of `--grf` or `--loads`; the forces in the recording if neither was given.
pub(super) fn read(args: &ForcesArgs, reading: &mut Reading) -> Result<MeasuredForces> {
    if args.no_ground || (args.grf.is_none() && args.loads.is_none()) {
        return Ok(MeasuredForces::InRecording);
    }
    let loads = args.loads.as_deref().map(|path| read_loads(path, reading)).transpose()?;
    let path = match (&args.grf, &loads) {
        (Some(path), _) => path.clone(),
        (None, Some(loads)) => data_file(args.loads.as_deref(), loads, &reading.caller)?,
        (None, None) => return Ok(MeasuredForces::InRecording),
    };
    let (table, remarks) = files::read_table(&reading.caller, &path)?;
    files::note_remarks(&path.display().to_string(), &remarks, &mut reading.findings);
    reading.read.push(path.clone());
    reading.read.extend(args.loads.clone());
    reading.ground = Some(path);
    Ok(MeasuredForces::Table(ForceTable { table, loads: loads.or_else(|| named(args)) }))
}

fn read_loads(path: &Path, reading: &mut Reading) -> Result<ExternalLoads> {
    let shown = path.display().to_string();
    let (loads, remarks) =
        ExternalLoads::read(&files::read_input(&reading.caller, path)?).with_context(|| shown.clone())?;
    files::note_remarks(&shown, &remarks, &mut reading.findings);
    Ok(loads)
}

/// The data file named in the external loads: by its relative path, or a file of that name in the same folder.
fn data_file(xml: Option<&Path>, loads: &ExternalLoads, caller: &Caller) -> Result<PathBuf> {
    let Some(named) = &loads.datafile else {
        bail!("the external loads name no <datafile>; expected --grf FILE");
    };
    let folder = xml.and_then(Path::parent).unwrap_or(Path::new(""));
    let named = Path::new(named);
    let in_folder = named.file_name().map(|name| folder.join(name));
    let candidates = [Some(folder.join(named)), in_folder];
    match candidates.into_iter().flatten().find(|path| caller.has_file(path)) {
        Some(path) => Ok(path),
        None => bail!(
            "the external loads name the data file `{}`, which does not exist. hint: give the file with --grf",
            named.display()
        ),
    }
}

/// The columns of `--right` and `--left`.
fn named(args: &ForcesArgs) -> Option<ExternalLoads> {
    let feet = [("right", &args.right), ("left", &args.left)];
    let force = |(side, foot): (&str, &Option<FootColumns>)| {
        foot.as_ref().map(|FootColumns { body, prefix }| ExternalForce::with_prefix(side, body, prefix))
    };
    let forces: Vec<ExternalForce> = feet.into_iter().filter_map(force).collect();
    (!forces.is_empty()).then(|| ExternalLoads { name: "feet".into(), datafile: None, forces })
}
