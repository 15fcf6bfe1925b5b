//! Markers (`.c3d`, `.trc`): the body that is fitted to them, and the plates under its feet.

use super::laboratory_file::{self, LaboratoryFile};
use super::{Followed, Origin, Reading, Recorded, coordinates, read_model};
use crate::args::{ForcesArgs, MarkerFitting, PlateFoot, SubjectArgs};
use crate::files;
use ambulo::analysis::{Body, BodyInMotion, MarkerTrialError, body_in_motion};
use ambulo::findings::{Finding, Findings};
use ambulo::ground::plates::{PlateContact, foot_bodies};
use ambulo::kinematics::calibration::{CalibrationError, Measures, Person};
use ambulo::kinematics::marker_fit::{FitSettings, Smoothing};
use ambulo::model::marker_set::MarkerSet;
use ambulo::model::{Model, Side};
use ambulo::motion::ForceRecording;
use ambulo::motion::force_plate::standing_weight_n;
use ambulo::report::Input;
use ambulo::spatial::{Mat3, Vec3};
use anyhow::{Context, Result, anyhow, bail};
use std::mem;
use std::ops::RangeInclusive;
use std::path::Path;

/// Masses stated and measured that differ by more are reported.
const MASS_MISMATCH: f64 = 0.03;
/// Bodies that can be made [kg].
const BODY_MASS_KG: RangeInclusive<f64> = 2.0..=300.0;
/// Weight to mass [m/s²].
const STANDARD_GRAVITY: f64 = 9.806_65;

pub(super) fn read(args: &ForcesArgs, reading: &mut Reading) -> Result<Recorded> {
    check_options(args)?;
    let walk = laboratory_file::read(&args.input, reading)?;
    let still = args.subject.still.as_deref().map(|path| read_still(path, reading)).transpose()?;
    reading.clock.lap("read_markers");
    let model = args.model.as_deref().map(|path| read_model(path, args, reading)).transpose()?;
    let walk = without_plates_switched_off(walk, args)?;
    let body = body(args, &walk, still.as_ref(), model.as_ref(), reading)?;
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
    let before = mem::take(&mut reading.findings);
    let file = laboratory_file::read(path, reading);
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

/// The forces under the feet: from a table if one was given, else from the plates of the file.
fn ground(args: &ForcesArgs, body: &BodyInMotion, reading: &mut Reading) -> Result<(Vec<ForceRecording>, Input)> {
    if args.no_ground {
        return Ok((Vec::new(), coordinates::input(args, None)));
    }
    if args.grf.is_some() || args.loads.is_some() {
        let (table, mut plates) = coordinates::read_ground(args, &body.subject.model, reading)?;
        turn_to_world(&mut plates, &body.laboratory.world_from_lab, &mut reading.findings);
        return Ok((plates, coordinates::input(args, table.as_ref())));
    }
    let plates = body.plate_forces();
    if plates.is_empty() {
        return Err(without_forces(args, body));
    }
    let input = Input { ground: Some(args.input.display().to_string()), ..coordinates::input(args, None) };
    Ok((plates, input))
}

/// Brings forces of a table to the world's axes: from those of the markers, or not at all where they stand upright as they are.
fn turn_to_world(plates: &mut [ForceRecording], world_from_lab: &Mat3, findings: &mut Findings) {
    /// Share of the mean force that points up where the axes are right: walking sums to nearly none forwards and sideways.
    const UPRIGHT: f64 = 0.9;
    let sum: Vec3 = plates.iter().flat_map(|p| &p.force).filter(|f| f.iter().all(|x| x.is_finite())).sum();
    let is_upright = |sum: &Vec3| sum.y > UPRIGHT * sum.norm();
    if is_upright(&sum) && !is_upright(&(world_from_lab * sum)) {
        findings.note(
            "loads.world_axes",
            "the table's forces do not stand in the axes of the markers; they are taken as x forward, y up, z right",
        );
        return;
    }
    plates.iter_mut().for_each(|plate| plate.turn(world_from_lab));
}

/// Why there are no forces under the feet, and what can be done.
fn without_forces(args: &ForcesArgs, body: &BodyInMotion) -> anyhow::Error {
    let shown = args.input.display();
    let contacts = &body.on_plates.contacts;
    let (found, hint) = if body.plates.is_empty() {
        ("the file has no force plates".to_owned(), "--no-ground computes a motion without contact")
    } else if contacts.is_empty() {
        let found = format!("nobody stands on the file's {}", counted(body.plates.len(), "force plate"));
        (found, "--no-ground computes a motion without contact")
    } else if foot_bodies(&body.subject.model).is_none() {
        let found = "the model has no bodies called calcn_r and calcn_l, foot_r and foot_l or talus_r and talus_l";
        (found.to_owned(), "give the forces with --grf and say which bodies they act on with --right and --left")
    } else {
        let one = |c: &PlateContact| {
            format!("{}, {:.3}-{:.3} s: {}", body.plates[c.plate].name, c.start_s, c.end_s, c.reason)
        };
        let found = format!("no plate's load belongs to one foot ({})", one(&contacts[0]));
        (
            found,
            "--plate 1=r says whose foot a plate carries; a person who stands is for --static, beside a trial that walks",
        )
    };
    anyhow!(
        "{shown}: no ground forces: {found}, and forces are not predicted from the motion yet; expected --grf FILE, or a trial that hits a plate. hint: {hint}"
    )
}

fn counted(count: usize, one: &str) -> String {
    format!("{count} {one}{}", if count == 1 { "" } else { "s" })
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
