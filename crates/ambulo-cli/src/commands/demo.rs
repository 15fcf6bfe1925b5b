//! `ambulo demo`: the main job on built-in input.
//!
//! The input is compiled in: a figure, two strides and the ground forces that they need (made by `cargo xtask demo-input`).
//! It goes the way of any recording, and is written out so that the user can repeat the run with `ambulo forces`.

use super::forces::{Recording, Stopwatch, compute};
use crate::args::DemoArgs;
use crate::{Verdict, files};
use ambulo::analysis::Settings;
use ambulo::analysis::feasibility::Thresholds;
use ambulo::findings::Findings;
use ambulo::model::from_osim;
use ambulo::motion::{Smoother, Window, coordinates_from_table, force_recordings};
use ambulo::report::{GroundSource, Input};
use ambulo_formats::external_loads::ExternalLoads;
use ambulo_formats::osim::OsimModel;
use ambulo_formats::table::Table;
use anyhow::Result;

const FIGURE: &[u8] = include_bytes!("../../assets/demo/figure.osim");
const WALK: &[u8] = include_bytes!("../../assets/demo/walk.mot");
const GROUND_FORCES: &[u8] = include_bytes!("../../assets/demo/walk_grf.mot");
const LOADS: &[u8] = include_bytes!("../../assets/demo/walk_grf.xml");
const THRESHOLDS: &str = include_str!("../../assets/demo/thresholds.toml");

pub(crate) fn run(args: &DemoArgs) -> Result<Verdict> {
    let input = args.output.join("input");
    for (name, bytes) in [
        ("figure.osim", FIGURE),
        ("walk.mot", WALK),
        ("walk_grf.mot", GROUND_FORCES),
        ("walk_grf.xml", LOADS),
        ("thresholds.toml", THRESHOLDS.as_bytes()),
    ] {
        files::write(&input.join(name), bytes)?;
    }
    let mut findings = Findings::default();
    findings.note(
        "demo.built_in",
        "an invented walk, not typical of people: figure and motion were made by this project, with the ground forces that they need; sliding and centre of pressure are not judged",
    );
    let mut clock = Stopwatch::new();
    let recording = read(&mut findings)?;
    clock.lap("read");
    compute(&recording, findings, clock, &args.output, args.voice)
}

fn read(findings: &mut Findings) -> Result<Recording> {
    let model = from_osim(&OsimModel::read(FIGURE)?, findings)?;
    let (walk, _) = Table::read_storage(WALK)?;
    let motion = coordinates_from_table(&model, &walk, "built-in walk", findings)?;
    let (loads, _) = ExternalLoads::read(LOADS)?;
    let (ground_forces, _) = Table::read_storage(GROUND_FORCES)?;
    let plates = force_recordings(&model, &loads, &ground_forces, findings)?;
    let named = |name: &str| format!("built-in {name}");
    Ok(Recording {
        model,
        motion,
        plates,
        device: None,
        read: Vec::new(),
        // The walk is free of noise.
        settings: Settings { smoother: Smoother::Off, force_filter: None, window: Window::default(), rate_hz: None },
        thresholds: Thresholds::from_toml(THRESHOLDS)?,
        input: Input {
            motion: named("walk.mot"),
            model: named("figure.osim"),
            ground: Some(named("walk_grf.mot")),
            loads: Some(named("walk_grf.xml")),
            device: None,
            added_mass: Vec::new(),
            ground_source: GroundSource::Simulated { rule: "lever rule between rear toe and front heel" },
        },
    })
}
