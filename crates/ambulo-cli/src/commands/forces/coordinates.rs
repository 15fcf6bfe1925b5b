//! Reads recorded coordinates (`.mot`, `.sto`, `.csv`) of an OpenSim model.

use super::{Reading, added_mass, ground_table, read_model, size};
use crate::args::{ForcesArgs, SubjectArgs};
use crate::commands::bids;
use crate::files;
use ambulo::model::Model;
use ambulo::motion::{Motion, coordinates_from_bids, coordinates_from_table};
use ambulo::study::Source;
use anyhow::{Context, Result, bail};
use std::path::Path;

pub(super) fn read(args: &ForcesArgs, reading: &mut Reading) -> Result<Source> {
    let Some(model_path) = args.model_file() else {
        bail!(
            "{}: coordinates need their model; expected --model FILE.osim. hint: markers (.c3d, .trc) need no model",
            args.recording().display()
        );
    };
    if reading.setups.has_markers() {
        bail!(
            "{}: these are coordinates; expected markers, which the set-ups of ScaleTool and InverseKinematicsTool are for",
            args.recording().display()
        );
    }
    reject_marker_options(args)?;
    size::check(&args.subject)?;
    let model = read_model(model_path, None, reading)?;
    reading.clock.lap("read_model");
    let motion = read_motion(&model, args.recording(), reading)?;
    reading.clock.lap("read_motion");
    let forces = ground_table::read(args, reading)?;
    reading.clock.lap("read_forces");
    Ok(Source {
        forces,
        added_mass: added_mass(args),
        stated: size::stated(&args.subject),
        ..Source::coordinates(model, motion)
    })
}

fn reject_marker_options(args: &ForcesArgs) -> Result<()> {
    let given = [
        ("--static", args.subject.still.is_some()),
        ("--markers", args.subject.markers.is_some()),
        ("--marker-set", args.subject.marker_set.is_some()),
        ("--plate", !args.subject.plate.is_empty()),
        ("--figure", args.subject.figure != SubjectArgs::DEFAULT_FIGURE),
        ("--fit", args.subject.fit.is_some()),
    ];
    match given.iter().find(|(_, given)| *given) {
        Some((option, _)) => {
            bail!(
                "{}: {option} is for markers (.c3d, .trc); recorded coordinates have a model",
                args.recording().display()
            )
        }
        None => Ok(()),
    }
}

fn read_motion(model: &Model, path: &Path, reading: &mut Reading) -> Result<Motion> {
    let shown = path.display().to_string();
    if files::ending(path) == "tsv" {
        let bids = bids::read(&reading.caller, path)?;
        reading.read.extend(bids.beside);
        return coordinates_from_bids(model, &bids.motion, bids.rate_hz, &shown, &mut reading.findings).context(shown);
    }
    let (table, remarks) = files::read_table(&reading.caller, path)?;
    files::note_remarks(&shown, &remarks, &mut reading.findings);
    coordinates_from_table(model, &table, &shown, &mut reading.findings).context(shown)
}
