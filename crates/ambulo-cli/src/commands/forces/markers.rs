//! Markers (`.c3d`, `.trc`): the body that is fitted to them, and the plates under its feet.

use super::{Followed, Origin, Reading, Recorded, loaded, marker_ground, read_model};
use crate::args::{ForcesArgs, MarkerFitting, PlateFoot, SubjectArgs};
use crate::files;
use crate::laboratory_file::{self, LaboratoryFile};
use ambulo::analysis::{Body, BodyInMotion, MarkerTrialError, body_in_motion, body_mass};
use ambulo::findings::{Finding, Findings};
use ambulo::kinematics::calibration::{CalibrationError, Measures, Person};
use ambulo::kinematics::marker_fit::{FitSettings, SmoothnessPrior};
use ambulo::model::marker_set::MarkerSet;
use ambulo::model::{Model, Side};
use ambulo::motion::force_plate::standing_weight_n;
use ambulo::spatial::Vec3;
use anyhow::{Context, Result, anyhow, bail};
use std::mem;
use std::ops::RangeInclusive;
use std::path::Path;

/// Bodies that can be made [kg].
const BODY_MASS_KG: RangeInclusive<f64> = 2.0..=300.0;
/// Weight to mass [m/s²].
const STANDARD_GRAVITY: f64 = 9.806_65;

pub(super) fn read(args: &ForcesArgs, reading: &mut Reading) -> Result<Recorded> {
    check_options(args)?;
    let walk = laboratory_file::read(&args.input, &mut reading.findings)?;
    let still = args.subject.still.as_deref().map(|path| read_still(path, reading)).transpose()?;
    reading.clock.lap("read_markers");
    let model = args.model.as_deref().map(|path| read_model(path, args, reading)).transpose()?;
    let walk = without_plates_switched_off(walk, args)?;
    let mut body = body(args, &walk, still.as_ref(), model.as_ref(), reading)?;
    if model.is_none() {
        body.subject.model = loaded(body.subject.model, args)?;
    }
    let (plates, input) = marker_ground::read(args, &body, reading)?;
    Ok(Recorded {
        plates,
        input,
        motion: body.fit.motion.clone(),
        model: body.subject.model.clone(),
        person: body.subject.person.clone(),
        mass_is_stated: args.model.is_none() || args.subject.mass.is_some(),
        origin: Origin::Markers(Box::new(Followed {
            body,
            listed: walk.events,
            standing_kg: still.as_ref().and_then(standing_kg),
        })),
    })
}

/// Options that contradict each other or have no use beside --model.
fn check_options(args: &ForcesArgs) -> Result<()> {
    let SubjectArgs { plate, mass, height, markers, figure, .. } = &args.subject;
    for (i, told) in plate.iter().enumerate() {
        if plate[..i].iter().any(|before| before.plate == told.plate) {
            bail!("--plate {} is given twice; expected one foot for a plate", told.plate);
        }
    }
    if args.model.is_none() {
        return Ok(());
    }
    if let Some(mass) = mass.filter(|mass| !BODY_MASS_KG.contains(mass)) {
        let (least, most) = (BODY_MASS_KG.start(), BODY_MASS_KG.end());
        bail!("--mass: the body mass is {mass} kg; expected {least} to {most} kg. hint: kilograms");
    }
    let of_the_built_in_body = [
        ("--height", height.is_some()),
        ("--markers", markers.is_some()),
        ("--figure", figure != SubjectArgs::USUAL_FIGURE),
    ];
    match of_the_built_in_body.iter().find(|(_, given)| *given) {
        Some((option, _)) => bail!(
            "{option} has no use beside --model: it is for the built-in body; the model has its own size, segments and markers. hint: --static FILE brings a model to a person's size, --mass KG to a person's mass"
        ),
        None => Ok(()),
    }
}

/// The standing trial. What was odd in the walk already is not said again.
fn read_still(path: &Path, reading: &mut Reading) -> Result<LaboratoryFile> {
    reading.read.push(path.to_owned());
    let before = mem::take(&mut reading.findings);
    let file = laboratory_file::read(path, &mut reading.findings);
    let found = mem::replace(&mut reading.findings, before);
    let known = reading.findings.clone();
    for finding in found.as_slice() {
        if !known.as_slice().iter().any(|k| k.code == finding.code && k.message == finding.message) {
            let message = format!("standing trial: {}", finding.message);
            reading.findings.add(Finding { message, ..finding.clone() });
        }
    }
    file
}

/// The body, calibrated or as it is, following the markers.
fn body(
    args: &ForcesArgs,
    walk: &LaboratoryFile,
    still: Option<&LaboratoryFile>,
    model: Option<&Model>,
    reading: &mut Reading,
) -> Result<BodyInMotion> {
    let Reading { findings, clock, .. } = reading;
    let stage = &mut |stage: &'static str| clock.lap(stage);
    let settings = fit_settings(args);
    let told: Vec<(usize, Side)> =
        args.subject.plate.iter().filter_map(|told| Some((told.plate - 1, told.side?))).collect();
    let standing = still.map(|still| &still.recording);
    let walk_shown = || args.input.display().to_string();
    let (person, set);
    let body = match model {
        Some(model) => Body::Model { model, mass: args.subject.mass },
        None => {
            person = self::person(args, walk, still, findings).with_context(walk_shown)?;
            set = args.subject.markers.as_deref().map(read_set).transpose()?;
            Body::BuiltIn { person: &person, set: set.as_ref() }
        }
    };
    body_in_motion(&walk.recording, standing, &body, &settings, &told, findings, stage).map_err(|error| {
        // The file in which the body was looked for.
        let of_the_standing_trial = match &error {
            MarkerTrialError::Calibration(CalibrationError::Build(_)) | MarkerTrialError::Fit(_) => false,
            MarkerTrialError::Names(_) | MarkerTrialError::Calibration(_) | MarkerTrialError::Scaling(_) => true,
            _ => false,
        };
        let still = args.subject.still.as_ref().filter(|_| of_the_standing_trial);
        let shown = still.map_or_else(walk_shown, |still| still.display().to_string());
        anyhow::Error::new(error).context(shown)
    })
}

/// The plates that `--plate N=off` leaves; those that it names must be there.
fn without_plates_switched_off(mut walk: LaboratoryFile, args: &ForcesArgs) -> Result<LaboratoryFile> {
    let plates = &mut walk.recording.plates;
    for PlateFoot { plate, side } in &args.subject.plate {
        let count = plates.len();
        match plates.get_mut(plate - 1) {
            None if count == 0 => {
                bail!("--plate {plate}: {} has no force plates; expected a C3D with plates", args.input.display())
            }
            None => bail!(
                "--plate {plate}: {} has {count} force plates; expected a plate from 1 to {count}. hint: `ambulo info` lists them",
                args.input.display()
            ),
            Some(plate) if side.is_none() => {
                plate.force.fill(Vec3::zeros());
                plate.moment.fill(Vec3::zeros());
            }
            Some(_) => {}
        }
    }
    Ok(walk)
}

fn fit_settings(args: &ForcesArgs) -> FitSettings {
    let smoothing = match args.subject.fit {
        MarkerFitting::Frames => None,
        MarkerFitting::Trajectory => Some(SmoothnessPrior::default()),
    };
    FitSettings { longest_gap_s: args.subject.max_gap, smoothing, ..FitSettings::default() }
}

/// A set of markers by its name, or from a file.
fn read_set(name_or_file: &str) -> Result<MarkerSet> {
    let path = Path::new(name_or_file);
    if !path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("toml")) {
        return MarkerSet::named(name_or_file).context("--markers");
    }
    let text = String::from_utf8(files::read(path)?).with_context(|| name_or_file.to_owned())?;
    MarkerSet::from_toml(&text).with_context(|| name_or_file.to_owned())
}

/// What is known of the person.
fn person(
    args: &ForcesArgs,
    walk: &LaboratoryFile,
    still: Option<&LaboratoryFile>,
    findings: &mut Findings,
) -> Result<Person> {
    let measured = |name: &str| still.and_then(|s| s.subject.processing(name)).or(walk.subject.processing(name));
    Ok(Person {
        table: args.subject.figure.parse().context("--figure")?,
        mass: mass(args, walk, still, findings)?,
        height: height(args, walk, still),
        measures: Measures::from_processing(measured),
    })
}

/// Body mass [kg]: what the plates carry in the standing trial, what the user says, or what the files say; see [`body_mass`].
fn mass(
    args: &ForcesArgs,
    walk: &LaboratoryFile,
    still: Option<&LaboratoryFile>,
    findings: &mut Findings,
) -> Result<f64> {
    let in_file = still.and_then(|still| still.subject.mass_kg).or(walk.subject.mass_kg);
    let stated = args.subject.mass.or(in_file);
    let standing = still.and_then(standing_kg);
    body_mass(stated, standing, findings).ok_or_else(|| {
        anyhow!(
            "the body mass is not known: the files state none and nobody stands still on plates; expected --mass KG"
        )
    })
}

/// What stands on the plates of a standing trial [kg].
fn standing_kg(still: &LaboratoryFile) -> Option<f64> {
    standing_weight_n(&still.recording.plates).map(|weight_n| weight_n / STANDARD_GRAVITY)
}

fn height(args: &ForcesArgs, walk: &LaboratoryFile, still: Option<&LaboratoryFile>) -> Option<f64> {
    args.subject.height.or(still.and_then(|still| still.subject.height_m)).or(walk.subject.height_m)
}
