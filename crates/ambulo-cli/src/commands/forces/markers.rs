//! Markers (`.c3d`, `.trc`): the body that is fitted to them, and the plates under its feet.

use super::{Followed, Origin, Reading, Recorded, coordinates, read_model};
use crate::args::{ForcesArgs, MarkerFitting, PlateFoot};
use crate::files;
use crate::laboratory_file::{self, LaboratoryFile};
use ambulo::analysis::{Body, BodyInMotion, body_in_motion};
use ambulo::findings::Findings;
use ambulo::kinematics::calibration::{Measures, Person};
use ambulo::kinematics::marker_fit::{FitSettings, Smoothing};
use ambulo::model::marker_set::MarkerSet;
use ambulo::model::{Model, Side};
use ambulo::motion::ForceRecording;
use ambulo::motion::force_plate::standing_weight_n;
use ambulo::report::Input;
use ambulo::spatial::Vec3;
use anyhow::{Context, Result, bail};
use std::path::Path;

/// Masses stated and measured that differ by more are reported.
const MASS_MISMATCH: f64 = 0.03;
/// Weight to mass [m/s²].
const STANDARD_GRAVITY: f64 = 9.806_65;

pub(super) fn read(args: &ForcesArgs, reading: &mut Reading) -> Result<Recorded> {
    let walk = laboratory_file::read(&args.input, &mut reading.findings)?;
    let still = args.subject.still.as_deref();
    reading.read.extend(still.map(Path::to_owned));
    let still = still.map(|path| laboratory_file::read(path, &mut reading.findings)).transpose()?;
    reading.clock.lap("read_markers");
    let model = args.model.as_deref().map(|path| read_model(path, args, reading)).transpose()?;
    let walk = without_plates_switched_off(walk, args)?;
    let body =
        body(args, &walk, still.as_ref(), model.as_ref(), reading).with_context(|| args.input.display().to_string())?;
    let (plates, input) = ground(args, &body, reading)?;
    Ok(Recorded {
        plates,
        input,
        motion: body.fit.motion.clone(),
        model: body.subject.model.clone(),
        person: body.subject.person.clone(),
        origin: Origin::Markers(Box::new(Followed {
            body,
            listed: walk.events,
            standing_kg: still.as_ref().and_then(standing_kg),
        })),
    })
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
    if let Some(model) = model {
        let body = Body::Model { model, mass: args.subject.mass };
        return Ok(body_in_motion(&walk.recording, standing, &body, &settings, &told, findings, stage)?);
    }
    let person = person(args, walk, still, findings)?;
    let set = args.subject.markers.as_deref().map(read_set).transpose()?;
    let body = Body::BuiltIn { person: &person, set: set.as_ref() };
    Ok(body_in_motion(&walk.recording, standing, &body, &settings, &told, findings, stage)?)
}

/// The plates that `--plate N=off` leaves; those that it names must be there.
fn without_plates_switched_off(mut walk: LaboratoryFile, args: &ForcesArgs) -> Result<LaboratoryFile> {
    let plates = &mut walk.recording.plates;
    for PlateFoot { plate, side } in &args.subject.plate {
        let count = plates.len();
        match plates.get_mut(plate - 1) {
            None => bail!("--plate {plate}: {} has {count} force plates", args.input.display()),
            Some(plate) if side.is_none() => {
                plate.force.fill(Vec3::zeros());
                plate.moment.fill(Vec3::zeros());
            }
            Some(_) => {}
        }
    }
    Ok(walk)
}

/// The forces under the feet: from a table if one was given, else from the plates of the file.
fn ground(args: &ForcesArgs, body: &BodyInMotion, reading: &mut Reading) -> Result<(Vec<ForceRecording>, Input)> {
    if args.no_ground {
        return Ok((Vec::new(), coordinates::input(args, None)));
    }
    if args.grf.is_some() || args.loads.is_some() {
        let (table, mut plates) = coordinates::read_ground(args, &body.subject.model, reading)?;
        plates.iter_mut().for_each(|plate| plate.turn(&body.laboratory.world_from_lab));
        return Ok((plates, coordinates::input(args, table.as_ref())));
    }
    let plates = body.plate_forces();
    if plates.is_empty() {
        let shown = args.input.display();
        let found = body.plates.len();
        bail!(
            "{shown}: no ground forces: {found} force plates in the file, no foot on any of them, and forces are not predicted from the motion yet; expected --grf FILE, or a trial that hits a plate. hint: --no-ground computes a motion without contact; --plate 1=r says whose foot a plate carries"
        );
    }
    let input = Input { ground: Some(args.input.display().to_string()), ..coordinates::input(args, None) };
    Ok((plates, input))
}

fn fit_settings(args: &ForcesArgs) -> FitSettings {
    let smoothing = match args.subject.fit {
        MarkerFitting::Frames => None,
        MarkerFitting::Trajectory => Some(Smoothing::default()),
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

/// Body mass [kg]: what the user says, else what the files say, else what the plates carry in the standing trial.
fn mass(
    args: &ForcesArgs,
    walk: &LaboratoryFile,
    still: Option<&LaboratoryFile>,
    findings: &mut Findings,
) -> Result<f64> {
    let in_file = still.and_then(|still| still.subject.mass_kg).or(walk.subject.mass_kg);
    let stated = args.subject.mass.or(in_file);
    let standing = still.and_then(standing_kg);
    match (stated, standing) {
        (Some(stated), Some(standing)) => {
            if (standing / stated - 1.0).abs() > MASS_MISMATCH {
                let message = format!(
                    "{stated:.1} kg are stated, the plates carry {standing:.1} kg in the standing trial; the stated mass was used. hint: --mass {standing:.1}"
                );
                findings.warn("mass.mismatch", message);
            }
            Ok(stated)
        }
        (Some(mass), None) => Ok(mass),
        (None, Some(mass)) => {
            findings.note(
                "mass.standing",
                format!("no mass is stated; {mass:.1} kg stand on the plates in the standing trial"),
            );
            Ok(mass)
        }
        (None, None) => bail!(
            "the body mass is not known: the files state none and nobody stands still on plates; expected --mass KG"
        ),
    }
}

/// What stands on the plates of a standing trial [kg].
fn standing_kg(still: &LaboratoryFile) -> Option<f64> {
    standing_weight_n(&still.recording.plates).map(|weight_n| weight_n / STANDARD_GRAVITY)
}

fn height(args: &ForcesArgs, walk: &LaboratoryFile, still: Option<&LaboratoryFile>) -> Option<f64> {
    args.subject.height.or(still.and_then(|still| still.subject.height_m)).or(walk.subject.height_m)
}
