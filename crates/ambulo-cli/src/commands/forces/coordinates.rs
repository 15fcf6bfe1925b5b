//! Recorded coordinates (`.mot`, `.sto`, `.csv`) of an OpenSim model.

use super::ground_table::{self, GroundTable};
use super::{Origin, Reading, Recorded, read_model};
use crate::args::{ForcesArgs, MarkerFitting, SubjectArgs};
use crate::files;
use ambulo::analysis::feasibility::Person;
use ambulo::findings::{Code, Findings};
use ambulo::model::Model;
use ambulo::motion::{ForceRecording, Motion, coordinates_from_table, force_recordings};
use ambulo_results::{GroundSource, Input};
use anyhow::{Context, Result, bail};
use std::path::Path;

pub(super) fn read(args: &ForcesArgs, reading: &mut Reading) -> Result<Recorded> {
    let Some(model_path) = &args.model else {
        bail!(
            "{}: recorded coordinates belong to a model; expected --model FILE.osim. hint: markers (.c3d, .trc) need none",
            args.input.display()
        );
    };
    refuse_what_is_for_markers(args)?;
    let model = read_model(model_path, args, reading)?;
    reading.clock.lap("read_model");
    let motion = read_motion(&model, &args.input, &mut reading.findings)?;
    reading.clock.lap("read_motion");
    let (ground, plates) = read_ground(args, &model, reading)?;
    reading.clock.lap("read_forces");
    let input = input(args, ground.as_ref());
    let person = Person::of_model(&model);
    Ok(Recorded { model, motion, plates, person, input, origin: Origin::Coordinates, mass_is_stated: false })
}

/// What is said where nothing was measured.
pub(super) const NO_FORCES: &str = "no ground forces were given; they are predicted from the motion";

fn refuse_what_is_for_markers(args: &ForcesArgs) -> Result<()> {
    let given = [
        ("--static", args.subject.still.is_some()),
        ("--markers", args.subject.markers.is_some()),
        ("--plate", !args.subject.plate.is_empty()),
        ("--mass", args.subject.mass.is_some()),
        ("--height", args.subject.height.is_some()),
        ("--figure", args.subject.figure != SubjectArgs::USUAL_FIGURE),
        ("--fit", args.subject.fit != MarkerFitting::Frames),
    ];
    match given.iter().find(|(_, given)| *given) {
        Some((option, _)) => bail!(
            "{}: {option} is for markers (.c3d, .trc); recorded coordinates are those of one model, whose size and mass they have",
            args.input.display()
        ),
        None => Ok(()),
    }
}

/// What went in, for the summary.
pub(super) fn input(args: &ForcesArgs, ground: Option<&GroundTable>) -> Input {
    Input {
        motion: args.input.display().to_string(),
        model: args.model.as_ref().map_or("built-in".into(), |model| model.display().to_string()),
        standing: args.subject.still.as_ref().map(|p| p.display().to_string()),
        ground: ground.map(|g| g.path.display().to_string()),
        loads: args.loads.as_ref().map(|p| p.display().to_string()),
        device: args.device.as_ref().map(|p| p.display().to_string()),
        added_mass: args.add_mass.iter().map(ToString::to_string).collect(),
        ground_source: if args.no_ground { GroundSource::None } else { GroundSource::Measured },
    }
}

fn read_motion(model: &Model, path: &Path, findings: &mut Findings) -> Result<Motion> {
    let shown = path.display().to_string();
    let (table, remarks) = files::read_table(path)?;
    files::note_remarks(&shown, &remarks, findings);
    coordinates_from_table(model, &table, &shown, findings).context(shown)
}

/// What plates measured, from a table, with the table.
pub(super) fn read_ground(
    args: &ForcesArgs,
    model: &Model,
    reading: &mut Reading,
) -> Result<(Option<GroundTable>, Vec<ForceRecording>)> {
    if args.no_ground {
        return Ok((None, Vec::new()));
    }
    if args.grf.is_none() && args.loads.is_none() {
        reading.findings.report(Code::GroundPredicted, NO_FORCES);
        return Ok((None, Vec::new()));
    }
    let ground = ground_table::read(args, model, &mut reading.findings)?;
    let shown = || match &args.loads {
        Some(loads) => format!("{} with {}", ground.path.display(), loads.display()),
        None => ground.path.display().to_string(),
    };
    let plates = force_recordings(model, &ground.loads, &ground.table, &mut reading.findings).with_context(shown)?;
    reading.read.push(ground.path.clone());
    reading.read.extend(args.loads.clone());
    Ok((Some(ground), plates))
}
