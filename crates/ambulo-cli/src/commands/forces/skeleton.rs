//! Reads a skeleton in motion (`.bvh`) for the built-in body. The format has no forces, no mass and no unit of length.

use super::{Reading, added_mass};
use crate::args::ForcesArgs;
use crate::files;
use ambulo::motion::skeleton::skeleton_from_bvh;
use ambulo::study::{Recording, Source};
use ambulo_formats::bvh::Bvh;
use anyhow::{Context, Result, bail};

pub(super) fn read(args: &ForcesArgs, reading: &mut Reading) -> Result<Source> {
    let shown = args.recording().display().to_string();
    reject_unused_options(args)?;
    let Some(mass_kg) = args.subject.mass else {
        bail!("{shown}: a BVH contains no body mass; expected --mass KG");
    };
    let (bvh, remarks) =
        Bvh::read(&files::read_input(&reading.caller, args.recording())?).with_context(|| shown.clone())?;
    files::note_remarks(&shown, &remarks, &mut reading.findings);
    reading.clock.lap("read_skeleton");
    let skeleton = skeleton_from_bvh(&bvh, &shown, args.subject.height, &mut reading.findings).context(shown)?;
    let table = args.subject.figure.parse().context("--figure")?;
    let source = Source::new(Recording::Skeleton { skeleton, table, mass_kg });
    Ok(Source { added_mass: added_mass(args), ..source })
}

fn reject_unused_options(args: &ForcesArgs) -> Result<()> {
    let given = [
        ("--model", args.model.is_some()),
        ("--grf", args.grf.is_some()),
        ("--loads", args.loads.is_some()),
        ("--static", args.subject.still.is_some()),
        ("--markers", args.subject.markers.is_some()),
        ("--marker-set", args.subject.marker_set.is_some()),
        ("--plate", !args.subject.plate.is_empty()),
    ];
    match given.iter().find(|(_, given)| *given) {
        Some((option, _)) => bail!(
            "{}: {option} has no effect for a .bvh, which is fitted with the built-in body and has no measured forces; expected --mass and --height",
            args.recording().display()
        ),
        None => Ok(()),
    }
}
