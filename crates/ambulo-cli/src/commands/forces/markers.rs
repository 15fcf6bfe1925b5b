//! Reads markers (`.c3d`, `.trc`) or poses of segments (`.c3d`, `.mvnx`), with a standing trial or a model.

use super::{Reading, added_mass, ground_table, read_model, size};
use crate::args::{ForcesArgs, PlateFoot, SubjectArgs};
use crate::caller::Caller;
use crate::commands::bids;
use crate::files;
use ambulo::findings::Findings;
use ambulo::model::marker_set::MarkerSet;
use ambulo::motion::markers_from_bids;
use ambulo::study::{
    LaboratoryFile, MarkerBody, MarkerSource, PlateAssignment, PlateUse, Source, StandingTrial, standing_trial,
};
use anyhow::{Context, Result, bail};
use std::path::Path;
use std::sync::Arc;

pub(super) fn read(args: &ForcesArgs, reading: &mut Reading) -> Result<Source> {
    check_options(args)?;
    let trial = read_laboratory_file(args.recording(), &reading.caller, &mut reading.findings)?;
    let standing = args.subject.still.as_deref().map(|path| shared_standing_trial(path, reading)).transpose()?;
    reading.clock.lap("read_markers");
    let body = body(args, reading)?;
    let plates = args.subject.plate.iter().map(|PlateFoot { plate, side }| PlateAssignment {
        plate: plate - 1,
        used: side.map_or(PlateUse::Off, PlateUse::Foot),
    });
    let markers = MarkerSource { trial, standing, body, plates: plates.collect() };
    let forces = ground_table::read(args, reading)?;
    Ok(Source { forces, added_mass: added_mass(args), stated: size::stated(&args.subject), ..Source::markers(markers) })
}

/// The given model, or the size and mass of the person for the built-in body.
pub(super) fn body(args: &ForcesArgs, reading: &mut Reading) -> Result<MarkerBody> {
    let SubjectArgs { mass, height, figure, markers, .. } = &args.subject;
    if let Some(path) = args.model_file() {
        let model = read_model(path, args.subject.marker_set.as_deref(), reading)?;
        let setups = reading.setups.clone();
        reading.tracked = setups.tasks(&model, reading)?;
        let protocol = setups.protocol(&model, reading)?;
        return Ok(MarkerBody::Model { model, mass_kg: *mass, protocol });
    }
    Ok(MarkerBody::BuiltIn {
        table: figure.parse().context("--figure").with_context(|| args.recording().display().to_string())?,
        mass_kg: *mass,
        height_m: *height,
        set: markers.as_deref().map(|set| read_set(set, reading)).transpose()?,
    })
}

/// Reads a `.c3d`, a `.trc`, a `.mvnx`, a `.csv` or a BIDS motion.
pub(crate) fn read_laboratory_file(path: &Path, caller: &Caller, findings: &mut Findings) -> Result<LaboratoryFile> {
    if files::ending(path) == "tsv" {
        return read_bids(path, caller, findings);
    }
    parse_laboratory_file(files::read_input(caller, path)?, path, findings)
}

/// Reads the tracked points of a BIDS motion.
fn read_bids(path: &Path, caller: &Caller, findings: &mut Findings) -> Result<LaboratoryFile> {
    let shown = path.display().to_string();
    let bids = bids::read(caller, path)?;
    let markers = markers_from_bids(&bids.motion, bids.rate_hz, &shown, findings).context(shown)?;
    Ok(LaboratoryFile::of_markers(markers))
}

/// The recording in the content of a `.c3d`, a `.trc`, a `.mvnx` or a `.csv`.
pub(crate) fn parse_laboratory_file(bytes: Vec<u8>, path: &Path, findings: &mut Findings) -> Result<LaboratoryFile> {
    let shown = path.display().to_string();
    if files::ending(path) == "csv" {
        let (table, remarks) = files::parse_table(path, &bytes)?;
        files::note_remarks(&shown, &remarks, findings);
        return LaboratoryFile::from_table(&table, &shown, findings).context(shown);
    }
    let read = match files::ending(path).as_str() {
        "c3d" => LaboratoryFile::from_c3d(bytes, &shown, findings),
        "trc" => LaboratoryFile::from_trc(bytes, &shown, findings),
        "mvnx" => LaboratoryFile::from_mvnx(bytes, &shown, findings),
        _ => bail!("{shown}: expected markers (.c3d, .trc or .csv) or segments (.c3d, .mvnx)"),
    };
    read.context(shown)
}

/// Rejects options that contradict each other or have no effect with --model.
pub(super) fn check_options(args: &ForcesArgs) -> Result<()> {
    let SubjectArgs { plate, height, markers, figure, .. } = &args.subject;
    for (i, given) in plate.iter().enumerate() {
        if plate[..i].iter().any(|before| before.plate == given.plate) {
            bail!("--plate {} is given twice; expected one foot per plate", given.plate);
        }
    }
    if args.model_file().is_none() {
        if args.subject.marker_set.is_some() {
            bail!(
                "--marker-set places markers on the bodies of a model; expected --model FILE.osim. hint: for the built-in body, --markers names a set of docs/MARKERS.md"
            );
        }
        return Ok(());
    }
    size::check(&args.subject)?;
    if height.is_some() && args.subject.still.is_some() {
        bail!("--height has no effect with --model and --static: the standing trial gives the model its lengths");
    }
    let of_the_built_in_body = [("--markers", markers.is_some()), ("--figure", figure != SubjectArgs::DEFAULT_FIGURE)];
    match of_the_built_in_body.iter().find(|(_, given)| *given) {
        Some((option, _)) => bail!(
            "{option} has no effect with --model, which has its own segments and markers; it is for the built-in body. hint: --static FILE scales the model to the person, --mass KG and --height M set its mass and stature"
        ),
        None => Ok(()),
    }
}

/// The standing trial of the person, which other recordings may share.
fn shared_standing_trial(path: &Path, reading: &mut Reading) -> Result<Arc<StandingTrial>> {
    reading.read.push(path.to_owned());
    let Reading { caller, findings, standing_trials, .. } = reading;
    standing_trial(findings, |findings| standing_trials.read(path, caller, findings))
}

pub(super) fn read_standing_trial(path: &Path, reading: &mut Reading) -> Result<LaboratoryFile> {
    reading.read.push(path.to_owned());
    let Reading { caller, findings, .. } = reading;
    standing_trial(findings, |findings| read_laboratory_file(path, caller, findings))
}

/// A marker set by its name, or from a file.
fn read_set(name_or_file: &str, reading: &mut Reading) -> Result<MarkerSet> {
    let path = Path::new(name_or_file);
    if !path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("toml")) {
        return MarkerSet::named(name_or_file).context("--markers");
    }
    let text = String::from_utf8(files::read_input(&reading.caller, path)?).with_context(|| name_or_file.to_owned())?;
    reading.read.push(path.to_owned());
    MarkerSet::from_toml(&text).with_context(|| name_or_file.to_owned())
}
