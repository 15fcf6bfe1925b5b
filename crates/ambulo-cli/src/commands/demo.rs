//! `ambulo demo`: the forces of a built-in walk, which is also written as a recording.

use super::stopwatch::Stopwatch;
use super::walk::SyntheticRun;
use crate::Completion;
use crate::args::DemoArgs;
use crate::caller::Caller;
use crate::replacement::ResultTarget;
use ambulo::analysis::feasibility::Thresholds;
use ambulo::findings::Findings;
use ambulo::gait::Gait;
use ambulo::model::anthropometry::{Build, SegmentTable};
use ambulo::simulation::synthetic::{SyntheticMode, SyntheticWalk, SyntheticWalkSettings, synthesise};
use ambulo_formats::external_loads::ExternalLoads;
use ambulo_report::{laboratory_recording, marker_paths, skeleton_of, standing_recording, trc_of_markers};
use ambulo_results::{Convention, EXTERNAL_LOADS, FIGURE, GROUND, KINEMATICS, Keep, OutputFile};
use anyhow::{Context, Error, Result};

pub(crate) fn run(args: &DemoArgs) -> Result<Completion> {
    let mut clock = Stopwatch::new();
    let target = ResultTarget::for_run(&args.output, args.replace.existing())?;
    let mut findings = Findings::default();
    let gait = Gait::named("free")?;
    let settings = SyntheticWalkSettings {
        gait: &gait,
        build: Build::usual(SegmentTable::DeLevaMale),
        mode: SyntheticMode::Optimal,
        cycles: 3,
        rate_hz: 100.0,
    };
    let walk = synthesise(&settings, &mut findings)?;
    clock.lap("walk");
    let recorded = walk.clone();
    let run = SyntheticRun {
        walk: &walk,
        walk_settings: &settings,
        device: None,
        thresholds: Thresholds::default(),
        convention: Convention::default(),
        read: Vec::new(),
        caller: &Caller::default(),
        options: "demo".to_owned(),
        keep: Keep::of_names(&args.keep),
        more: Box::new(move |written| {
            Ok(coordinate_files(written)?.into_iter().chain(recording_files(&recorded)?).collect())
        }),
    };
    run.analyse(findings, clock)?.write(&target, args.print, args.check)
}

/// The results as recorded coordinates: model, motion, ground forces and external loads.
fn coordinate_files(written: &[OutputFile<'_>]) -> Result<Vec<OutputFile<'static>>> {
    let result = |name: &str| {
        let found = written.iter().find(|file| file.name == name);
        Ok::<_, Error>(found.with_context(|| format!("the walk has no {name}"))?.bytes()?)
    };
    let (mut loads, _) = ExternalLoads::read(&result(EXTERNAL_LOADS)?)?;
    loads.datafile = Some("walk_grf.mot".to_owned());
    Ok(vec![
        OutputFile::new("input/figure.osim", result(FIGURE)?),
        OutputFile::new("input/walk.mot", result(KINEMATICS)?),
        OutputFile::new("input/walk_grf.mot", result(GROUND)?),
        OutputFile::new("input/walk_grf.xml", loads.write()),
    ])
}

/// The walk as a laboratory recording (markers and force plates) with a standing trial, as markers of the model and as
/// a skeleton.
fn recording_files(walk: &SyntheticWalk) -> Result<Vec<OutputFile<'static>>> {
    let SyntheticWalk { human, trajectory, loads, .. } = walk;
    let recording = laboratory_recording(human, trajectory, loads)?;
    let standing = standing_recording(human, recording.point_rate_hz)?;
    let markers = marker_paths(&human.model, trajectory, human.model.markers());
    Ok(vec![
        OutputFile::new("input/walk.c3d", recording.write()?),
        OutputFile::new("input/standing.c3d", standing.write()?),
        OutputFile::new("input/walk.trc", trc_of_markers(&markers)?.write()),
        OutputFile::new("input/walk.bvh", skeleton_of(&human.model, trajectory)?.write()),
    ])
}
