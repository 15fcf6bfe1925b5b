//! `ambulo demo`: the main job without any input: a free walk of the default figure, put right, and the forces behind it.

use super::stopwatch::Stopwatch;
use super::walk::{Made, default_build};
use crate::args::DemoArgs;
use crate::{Verdict, files};
use ambulo::analysis::feasibility::Thresholds;
use ambulo::findings::Findings;
use ambulo::gait::Gait;
use ambulo::simulation::synthetic::{SyntheticMode, SyntheticWalk, SyntheticWalkSettings, synthesise};
use ambulo_formats::external_loads::ExternalLoads;
use ambulo_report::{laboratory_recording, marker_paths, skeleton_of, standing_recording, trc_of_markers};
use ambulo_results::Convention;
use anyhow::Result;
use std::path::Path;

pub(crate) fn run(args: &DemoArgs) -> Result<Verdict> {
    let mut clock = Stopwatch::new();
    let mut findings = Findings::default();
    let gait = Gait::named("free")?;
    let order = SyntheticWalkSettings {
        gait: &gait,
        build: default_build(),
        mode: SyntheticMode::Corrected,
        cycles: 3,
        rate_hz: 100.0,
    };
    let walk = synthesise(&order, &mut findings)?;
    clock.lap("walk");
    let made = Made {
        walk: &walk,
        order: &order,
        thresholds: Thresholds::default(),
        convention: Convention::default(),
        read: &[],
    };
    let verdict = made.analyse_and_write(findings, clock, &args.output, args.voice)?;
    write_input(&args.output)?;
    write_recording(&walk, &args.output)?;
    Ok(verdict)
}

/// The results again as a recording: model, motion, ground forces and their description.
fn write_input(output: &Path) -> Result<()> {
    for (result, name) in [("figure.osim", "figure.osim"), ("kinematics.mot", "walk.mot"), ("grf.mot", "walk_grf.mot")]
    {
        files::write(&output.join("input").join(name), &files::read(&output.join(result))?)?;
    }
    let (mut loads, _) = ExternalLoads::read(&files::read(&output.join("external_loads.xml"))?)?;
    loads.datafile = Some("walk_grf.mot".to_owned());
    files::write(&output.join("input/walk_grf.xml"), &loads.write())
}

/// The walk as a laboratory would have recorded it, with markers and plates; the figure standing; its own markers; its skeleton.
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
