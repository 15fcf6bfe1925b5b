//! Reads a skeleton in motion (`.bvh`), or a motion of the SMPL family (`.npz`), for the built-in body. Neither has forces or a mass.

use super::{Reading, added_mass};
use crate::args::ForcesArgs;
use crate::files;
use ambulo::model::anthropometry::Build;
use ambulo::motion::skeleton::{SkeletonRecording, skeleton_from_bvh};
use ambulo::motion::{SmplBody, SmplError, SmplMotion};
use ambulo::study::{Recording, Source};
use ambulo_formats::bvh::Bvh;
use ambulo_formats::npz::Npz;
use anyhow::{Context, Result, bail};
use std::path::Path;

pub(super) fn read(args: &ForcesArgs, reading: &mut Reading) -> Result<Source> {
    let shown = args.recording().display().to_string();
    let mass_kg = mass(args, "a BVH")?;
    let (bvh, remarks) =
        Bvh::read(&files::read_input(&reading.caller, args.recording())?).with_context(|| shown.clone())?;
    files::note_remarks(&shown, &remarks, &mut reading.findings);
    reading.clock.lap("read_skeleton");
    let skeleton = skeleton_from_bvh(&bvh, &shown, args.subject.height, &mut reading.findings).context(shown)?;
    source(args, skeleton, mass_kg)
}

/// Reads a motion of the SMPL family.
pub(super) fn read_smpl(args: &ForcesArgs, reading: &mut Reading) -> Result<Source> {
    let shown = args.recording().display().to_string();
    let mass_kg = mass(args, "a motion of the SMPL family")?;
    let npz = read_npz(args.recording(), reading)?;
    let motion = SmplMotion::from_npz(&npz).with_context(|| shown.clone())?;
    drop(npz);
    reading.clock.lap("read_skeleton");
    let body = smpl_body(args, &motion, mass_kg, reading)?;
    let skeleton = motion.skeleton(&body, &shown, args.subject.height, &mut reading.findings).context(shown)?;
    source(args, skeleton, mass_kg)
}

/// The lengths: those of the user's model, or of the built-in body of the stated stature.
fn smpl_body(args: &ForcesArgs, motion: &SmplMotion, mass_kg: f64, reading: &mut Reading) -> Result<SmplBody> {
    let table = args.subject.figure.parse().context("--figure")?;
    let build = |height: f64| Build { table, mass: mass_kg, height, toe_joint: true };
    let Some(path) = &args.smpl else {
        let height = args.subject.height.ok_or(SmplError::NoLengths);
        let body = height.and_then(|height| SmplBody::of_stature(&build(height)));
        return body.with_context(|| args.recording().display().to_string());
    };
    let shown = || path.display().to_string();
    reading.read.push(path.clone());
    let npz = read_npz(path, reading)?;
    // Of the table only the shape of the foot is used, which does not depend on the stature.
    let sizes = build(args.subject.height.unwrap_or(ANY_STATURE_M)).human().with_context(shown)?.dimensions;
    SmplBody::of_model(&npz, &motion.betas, &sizes).with_context(shown)
}

/// A stature for proportions [m].
const ANY_STATURE_M: f64 = 1.7;

fn read_npz(path: &Path, reading: &Reading) -> Result<Npz> {
    Npz::read(&files::read_input(&reading.caller, path)?).with_context(|| path.display().to_string())
}

/// The mass, which the file does not hold.
fn mass(args: &ForcesArgs, what: &str) -> Result<f64> {
    reject_unused_options(args)?;
    match args.subject.mass {
        Some(mass_kg) => Ok(mass_kg),
        None => bail!("{}: {what} contains no body mass; expected --mass KG", args.recording().display()),
    }
}

fn source(args: &ForcesArgs, skeleton: SkeletonRecording, mass_kg: f64) -> Result<Source> {
    let table = args.subject.figure.parse().context("--figure")?;
    let source = Source::new(Recording::Skeleton { skeleton, table, mass_kg });
    Ok(Source { added_mass: added_mass(args), ..source })
}

fn reject_unused_options(args: &ForcesArgs) -> Result<()> {
    let given = [
        ("--model", args.model_file().is_some()),
        ("--grf", args.grf.is_some()),
        ("--loads", args.loads.is_some()),
        ("--static", args.subject.still.is_some()),
        ("--markers", args.subject.markers.is_some()),
        ("--marker-set", args.subject.marker_set.is_some()),
        ("--plate", !args.subject.plate.is_empty()),
    ];
    match given.iter().find(|(_, given)| *given) {
        Some((option, _)) => bail!(
            "{}: {option} has no effect for a .{}, which is fitted with the built-in body and has no measured forces; expected --mass and --height",
            args.recording().display(),
            files::ending(args.recording())
        ),
        None => Ok(()),
    }
}
