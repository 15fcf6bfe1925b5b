//! `ambulo demo`: the main job without any input: a free walk of the default figure, put right, and the forces behind it.

use super::stopwatch::Stopwatch;
use super::walk::{Made, default_build};
use crate::args::DemoArgs;
use crate::{Verdict, files};
use ambulo::analysis::feasibility::Thresholds;
use ambulo::findings::Findings;
use ambulo::gait::Gait;
use ambulo::simulation::synthetic::{Mode, WalkOrder, synthesise};
use ambulo_formats::external_loads::ExternalLoads;
use anyhow::Result;
use std::path::Path;

pub(crate) fn run(args: &DemoArgs) -> Result<Verdict> {
    let mut clock = Stopwatch::new();
    let mut findings = Findings::default();
    let gait = Gait::named("free")?;
    let order = WalkOrder { gait: &gait, build: default_build(), mode: Mode::Corrected, cycles: 3, rate_hz: 100.0 };
    let walk = synthesise(&order, &mut findings)?;
    clock.lap("walk");
    let made = Made { walk: &walk, order: &order, thresholds: &Thresholds::default(), read: &[] };
    let verdict = made.analyse_and_write(findings, clock, &args.output, args.voice)?;
    write_input(&args.output)?;
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
