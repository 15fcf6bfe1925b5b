//! Markers (`.c3d`, `.trc`): the body that is fitted to them, and the plates under its feet.

use super::laboratory_file::{self, LaboratoryFile};
use super::{Reading, Recorded, coordinates, read_model};
use crate::args::{ForcesArgs, MarkerFitting};
use crate::files;
use ambulo::analysis::{Body, BodyInMotion, body_in_motion, standing_mass};
use ambulo::findings::Findings;
use ambulo::kinematics::calibration::{Measures, Person};
use ambulo::kinematics::marker_fit::{FitSettings, Smoothing};
use ambulo::model::marker_set::MarkerSet;
use ambulo::report::SubjectSummary;
use anyhow::{Context, Result, bail};
use std::path::Path;

/// Masses stated and measured that differ by more are reported.
const MASS_MISMATCH: f64 = 0.03;

pub(super) fn read(args: &ForcesArgs, reading: &mut Reading) -> Result<Recorded> {
    let walk = laboratory_file::read(&args.input, reading)?;
    let still = args.subject.still.as_deref().map(|path| laboratory_file::read(path, reading)).transpose()?;
    reading.clock.lap("read_markers");
    let settings = fit_settings(args);
    let model = args.model.as_deref().map(|path| read_model(path, args, reading)).transpose()?;
    let Reading { findings, clock, .. } = reading;
    let stage = &mut |stage: &'static str| clock.lap(stage);
    let standing = still.as_ref().map(|still| &still.recording);
    let body = match &model {
        Some(model) => body_in_motion(&walk.recording, standing, &Body::Model(model), &settings, findings, stage),
        None => {
            let person = person(args, &walk, still.as_ref(), findings)?;
            let set = args.subject.markers.as_deref().map(read_set).transpose()?;
            let body = Body::BuiltIn { person: &person, set: set.as_ref() };
            body_in_motion(&walk.recording, standing, &body, &settings, findings, stage)
        }
    };
    let body = body.with_context(|| args.input.display().to_string())?;
    let input = coordinates::input(args, None);
    Ok(Recorded {
        subject: Some(subject_summary(&body)),
        files: Vec::new(),
        plates: Vec::new(),
        input,
        motion: body.fit.motion,
        model: body.subject.model,
        person: body.subject.person,
    })
}

fn subject_summary(body: &BodyInMotion) -> SubjectSummary {
    let assumptions = body.subject.calibration.as_ref().map_or(&[][..], |report| &report.assumptions);
    SubjectSummary::new(&body.laboratory.statement, &body.subject.sets, &body.fit, assumptions)
}

fn fit_settings(args: &ForcesArgs) -> FitSettings {
    let smoothing = match args.subject.fit {
        MarkerFitting::Frames => None,
        MarkerFitting::Trajectory => Some(Smoothing::default()),
    };
    FitSettings { longest_gap_s: args.subject.max_gap, smoothing, limits: ambulo::kinematics::marker_fit::Limits::Ranges, ..FitSettings::default() }
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
    let standing = still.and_then(|still| standing_mass(&still.recording.plates));
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

fn height(args: &ForcesArgs, walk: &LaboratoryFile, still: Option<&LaboratoryFile>) -> Option<f64> {
    args.subject.height.or(still.and_then(|still| still.subject.height_m)).or(walk.subject.height_m)
}
