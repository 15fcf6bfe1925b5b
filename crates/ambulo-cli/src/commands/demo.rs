//! `ambulo demo`: the forces of a built-in walk, which is also written as a recording.

use super::stopwatch::Stopwatch;
use super::walk::{SyntheticRun, default_build};
use crate::args::DemoArgs;
use crate::{Completion, files};
use ambulo::analysis::feasibility::Thresholds;
use ambulo::findings::Findings;
use ambulo::gait::Gait;
use ambulo::simulation::synthetic::{SyntheticMode, SyntheticWalk, SyntheticWalkSettings, synthesise};
use ambulo_formats::external_loads::ExternalLoads;
use ambulo_report::{laboratory_recording, marker_paths, skeleton_of, standing_recording, trc_of_markers};
use ambulo_results::Convention;
use anyhow::Result;
use std::path::Path;

pub(crate) fn run(args: &DemoArgs) -> Result<Completion> {
    let mut clock = Stopwatch::new();
    let mut findings = Findings::default();
    let gait = Gait::named("free")?;
    let settings = SyntheticWalkSettings {
        gait: &gait,
        build: default_build(),
        mode: SyntheticMode::Corrected,
        cycles: 3,
        rate_hz: 100.0,
    };
    let walk = synthesise(&settings, &mut findings)?;
    clock.lap("walk");
    let run = SyntheticRun {
        walk: &walk,
        walk_settings: &settings,
        thresholds: Thresholds::default(),
        convention: Convention::default(),
        read: &[],
        check: args.check,
    };
    let verdict = run.analyse_and_write(findings, clock, &args.output, args.print)?;
    write_input(&args.output)?;
    write_recording(&walk, &args.output)?;
    Ok(verdict)
}

/// Writes the results as recorded coordinates: model, motion, ground forces and external loads.
fn write_input(output: &Path) -> Result<()> {
    for (result, name) in [("figure.osim", "figure.osim"), ("kinematics.mot", "walk.mot"), ("grf.mot", "walk_grf.mot")]
    {
        files::write(&output.join("input").join(name), &files::read(&output.join(result))?)?;
    }
    let (mut loads, _) = ExternalLoads::read(&files::read(&output.join("external_loads.xml"))?)?;
    loads.datafile = Some("walk_grf.mot".to_owned());
    files::write(&output.join("input/walk_grf.xml"), &loads.write())
}

/// Writes the walk as a laboratory recording (markers and force plates) with a standing trial, as markers of the model and as a skeleton.
fn write_recording(walk: &SyntheticWalk, output: &Path) -> Result<()> {
    let SyntheticWalk { human, trajectory, loads, .. } = walk;
    let recording = laboratory_recording(human, trajectory, loads)?;
    let standing = standing_recording(human, recording.point_rate_hz)?;
    let markers = marker_paths(&human.model, trajectory, human.model.markers());
    for (name, bytes) in [
        ("walk.c3d", recording.write()?),
        ("standing.c3d", standing.write()?),
        ("walk.trc", trc_of_markers(&markers)?.write()),
        ("walk.bvh", skeleton_of(&human.model, trajectory)?.write()),
    ] {
        files::write(&output.join("input").join(name), &bytes)?;
    }
    Ok(())
}
