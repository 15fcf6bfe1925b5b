//! `ambulo walk`: synthetic walking, and the forces behind it.

use super::run_files::{RunFiles, read_thresholds};
use super::stopwatch::Stopwatch;
use crate::args::{FigureArgs, GaitArgs, Voice, WalkArgs, WalkMode};
use crate::{Verdict, files, printer};
use ambulo::analysis::feasibility::{Person, Thresholds};
use ambulo::findings::Findings;
use ambulo::gait::machine::state_table;
use ambulo::gait::{Gait, Pace, Speed, Style, Walk};
use ambulo::model::anthropometry::{Build, SegmentTable};
use ambulo::simulation::synthetic::{SyntheticMode, SyntheticWalk, SyntheticWalkSettings, synthesise};
use ambulo::study::{self, CompleteMotion, Recording, Settings, Source, Stage};
use ambulo_report::gait_figure;
use ambulo_results::{Convention, GroundSource, Input, OutputFile, WalkSummary};
use anyhow::{Context, Result};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

pub(crate) fn run(args: &WalkArgs) -> Result<Verdict> {
    let mut clock = Stopwatch::new();
    let mut findings = Findings::default();
    let (gait, mut read) = gait(&args.gait)?;
    let build = build(&args.figure)?;
    if args.states {
        let human = build.human()?;
        let walk = Walk::new(&gait, human.dimensions.leg_length, &mut findings)?;
        if let Some(output) = &args.output {
            let file = gait_file(&walk)?;
            files::write(&output.join(&file.name), &file.bytes)?;
        }
        return printer::states(&state_table(&walk), &findings, args.voice).map(|()| Verdict::Accepted);
    }
    let thresholds = read_thresholds(args.thresholds.as_deref())?;
    read.extend(args.thresholds.clone());
    let gait = if args.mode == WalkMode::Corrected { put_right(gait, &args.gait) } else { gait };
    let order =
        SyntheticWalkSettings { gait: &gait, build, mode: args.mode.mode(), cycles: args.cycles, rate_hz: args.rate };
    let walk = synthesise(&order, &mut findings)?;
    clock.lap("walk");
    let made = Made { walk: &walk, order: &order, thresholds, convention: args.convention.into(), read: &read };
    let output = args.output.as_deref().unwrap_or(Path::new(DEFAULT_OUTPUT));
    made.analyse_and_write(findings, clock, output, args.voice)
}

/// Folder for the results, if none is named.
const DEFAULT_OUTPUT: &str = "out";

/// A walk that was made, and what it is judged by.
pub(super) struct Made<'a> {
    pub(super) walk: &'a SyntheticWalk,
    pub(super) order: &'a SyntheticWalkSettings<'a>,
    pub(super) thresholds: Thresholds,
    /// How angles of pelvis and hips are measured.
    pub(super) convention: Convention,
    pub(super) read: &'a [PathBuf],
}

impl Made<'_> {
    /// Takes the same road as a recording, from a complete motion on.
    pub(super) fn analyse_and_write(
        self,
        mut findings: Findings,
        mut clock: Stopwatch,
        output: &Path,
        voice: Voice,
    ) -> Result<Verdict> {
        let settings = Settings { thresholds: self.thresholds.clone(), ..Settings::default() };
        let mut watch = |stage: Stage| {
            clock.lap(stage.word());
            ControlFlow::Continue(())
        };
        let outcome = study::run_observed(&self.source(), &settings, &mut findings, &mut watch)?;
        let files = RunFiles {
            outcome: &outcome,
            input: input(self.order),
            convention: self.convention,
            walk: Some(WalkSummary::new(&self.walk.human.model, &self.walk.report)),
            files: self.files()?,
            read: self.read,
            findings,
            clock,
        };
        files.write(output, voice)
    }

    /// The walk with the forces that its simulation or correction gives.
    fn source(&self) -> Source {
        let SyntheticWalk { human, trajectory, loads, .. } = self.walk;
        let made = CompleteMotion {
            model: human.model.clone(),
            person: Person::of_human(human),
            trajectory: trajectory.clone(),
            loads: loads.clone(),
            rule: rule(self.order),
        };
        Source::new(Recording::Complete(Box::new(made)))
    }

    /// The figure as a model that `ambulo forces` and OpenSim read, and the gait as a picture.
    fn files(&self) -> Result<Vec<OutputFile>> {
        Ok(vec![OutputFile::body("figure.osim", &self.walk.human.model)?, gait_file(&self.walk.walk)?])
    }
}

/// The figure of a gait as a file.
fn gait_file(walk: &Walk) -> Result<OutputFile> {
    Ok(OutputFile::new("figures/gait.svg", gait_figure(walk)?.into_bytes()))
}

/// How the forces were divided between the feet in double support.
fn rule(order: &SyntheticWalkSettings<'_>) -> &'static str {
    match order.mode {
        SyntheticMode::Corrected => "soft shoes",
        SyntheticMode::Paper => "rigid soles",
    }
}

fn input(order: &SyntheticWalkSettings<'_>) -> Input {
    Input {
        motion: format!("gait {}", order.gait.name),
        model: format!("figure {}", order.build.table),
        standing: None,
        ground: None,
        loads: None,
        device: None,
        added_mass: Vec::new(),
        ground_source: GroundSource::None,
    }
}

/// Mass [kg] and stature [m] of a figure when nothing is said: de Leva's and Winter's as round numbers near the means of the people
/// measured, the paper's 80 kg at the stature that completes its table.
fn usual_size(table: SegmentTable) -> [f64; 2] {
    match table {
        SegmentTable::DeLevaMale | SegmentTable::DempsterWinter => [75.0, 1.75],
        SegmentTable::DeLevaFemale => [60.0, 1.65],
        SegmentTable::Faure1997 => [80.0, 1.80],
    }
}

/// The figure when nothing is said.
pub(super) fn default_build() -> Build {
    let table = SegmentTable::DeLevaMale;
    let [mass, height] = usual_size(table);
    Build { table, mass, height, toe_joint: true }
}

fn build(args: &FigureArgs) -> Result<Build> {
    let table = args.figure.parse().context("--figure")?;
    let [mass, height] = usual_size(table);
    let (mass, height) = (args.mass.unwrap_or(mass), args.height.unwrap_or(height));
    let build = Build { table, mass, height, toe_joint: !args.no_toe_joint };
    // Refused before anything is computed.
    build.human()?;
    Ok(build)
}

/// The gait as asked for, and the file that it was read from.
fn gait(args: &GaitArgs) -> Result<(Gait, Vec<PathBuf>)> {
    let path = Path::new(&args.gait);
    let is_file = path.extension().is_some_and(|e| e.eq_ignore_ascii_case("toml")) || path.components().count() > 1;
    let (mut gait, read) = if is_file {
        let shown = || path.display().to_string();
        let text = String::from_utf8(files::read(path)?).with_context(shown)?;
        (Gait::from_toml(&text).with_context(shown)?, vec![path.to_owned()])
    } else {
        (Gait::named(&args.gait).context("--gait")?, Vec::new())
    };
    if let Some(word) = &args.style {
        gait = gait.in_style(style(word)?);
    }
    gait.pace = paced(gait.pace, args);
    if let Some(height) = args.step_height {
        gait.step_height = height;
    }
    Ok((gait, read))
}

/// Built-in gaits of style 1997 have curves without acceleration at their knots; put right, they get some, unless a style was asked for.
fn put_right(gait: Gait, args: &GaitArgs) -> Gait {
    if args.style.is_none() && Gait::NAMES.contains(&args.gait.as_str()) { gait.in_style(Style::Knots) } else { gait }
}

fn style(word: &str) -> Result<Style> {
    let known = Style::WORDS.into_iter().find(|(name, _)| *name == word);
    let names = Style::WORDS.map(|(name, _)| name).join(", ");
    known.map(|(_, style)| style).with_context(|| format!("--style: found `{word}`; expected one of {names}"))
}

/// As in gait files: where one of speed, step length and cadence is given, the gait's own count no more, its factors do; so that what
/// was asked for comes out, it is taken before them.
fn paced(own: Pace, args: &GaitArgs) -> Pace {
    if args.speed.is_none() && args.step_length.is_none() && args.cadence.is_none() {
        return own;
    }
    let (long, quick) = (own.length_scale, own.cadence_scale);
    Pace {
        speed: args.speed.map(|speed| Speed::MetersPerSecond(speed / (long * quick))),
        step_length: args.step_length.map(|length| length / long),
        step_frequency: args.cadence.map(|cadence| cadence / 60.0 / quick),
        ..own
    }
}
