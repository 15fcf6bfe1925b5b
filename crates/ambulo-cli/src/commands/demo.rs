//! `ambulo demo`: the main job without any input: a free walk of the default figure, put right, and the forces behind it.

use super::stopwatch::Stopwatch;
use super::walk::{Made, default_build};
use crate::Verdict;
use crate::args::DemoArgs;
use ambulo::analysis::feasibility::Thresholds;
use ambulo::findings::Findings;
use ambulo::gait::Gait;
use ambulo::simulation::synthetic::{Mode, WalkOrder, synthesise};
use anyhow::Result;

pub(crate) fn run(args: &DemoArgs) -> Result<Verdict> {
    let mut clock = Stopwatch::new();
    let mut findings = Findings::default();
    let gait = Gait::named("free")?;
    let order = WalkOrder { gait: &gait, build: default_build(), mode: Mode::Corrected, cycles: 3, rate_hz: 100.0 };
    let walk = synthesise(&order, &mut findings)?;
    clock.lap("walk");
    let made = Made { walk: &walk, order: &order, thresholds: &Thresholds::default(), read: &[] };
    made.analyse_and_write(findings, clock, &args.output, args.voice)
}
