//! `ambulo events`: foot strikes and foot offs from every source in a recording.

use crate::args::EventsArgs;
use crate::printer::{EventSource, SourceAgreement};
use crate::{Completion, files, printer};
use ambulo::analysis::{LaboratoryRecording, event_agreement};
use ambulo::findings::{Code, Findings};
use ambulo::ground::foot_motion::{FootMotion, foot_motion};
use ambulo::ground::phases::contacts_from_force;
use ambulo::ground::plates::{ContactQuality, FeetOnPlates, feet_on_plates, plates_under_feet};
use ambulo::job::ending;
use ambulo::model::Side;
use ambulo::motion::skeleton::skeleton_from_bvh;
use ambulo::motion::{Event, EventKind, MarkerRecording, PlateRecording, straightened};
use ambulo::numerics::Order;
use ambulo::study::LaboratoryFile;
use ambulo_formats::bvh::Bvh;
use ambulo_formats::table::Table;
use anyhow::{Context, Result, bail};
use std::fmt::Write;

pub(crate) fn run(args: &EventsArgs) -> Result<Completion> {
    let bytes = files::read(&args.input)?;
    let shown = args.input.display().to_string();
    let mut findings = Findings::default();
    let read = match ending(&args.input).as_str() {
        "c3d" => from_c3d(&bytes, &shown, &mut findings),
        "trc" => from_trc(&bytes, &shown, &mut findings),
        "mvnx" => from_mvnx(&bytes, &shown, &mut findings),
        "bvh" => from_bvh(&bytes, &shown, &mut findings),
        "mot" | "sto" => from_forces(&bytes, &shown, &mut findings),
        ending => bail!("{shown}: `.{ending}` contains no gait; expected .c3d, .trc, .mvnx, .bvh, .mot or .sto"),
    };
    let sources = read.with_context(|| shown.clone())?;
    if let Some(output) = &args.output {
        files::check_target(output, std::slice::from_ref(&args.input), args.replace.existing())?;
        files::write(output, csv(&sources).as_bytes())?;
    }
    printer::events(&sources, &agreements(&sources), &findings, args.print)?;
    Ok(Completion::Passed)
}

fn from_c3d(bytes: &[u8], shown: &str, findings: &mut Findings) -> Result<Vec<EventSource>> {
    let LaboratoryFile { recording, events, .. } = LaboratoryFile::from_c3d(bytes, shown, findings)?;
    let LaboratoryRecording { markers, plates, .. } = in_world(&recording, findings);
    let motion = foot_motion(&markers, findings);
    let plates = plates_under_feet(&markers, plates, &motion, findings);
    let feet = feet_on_plates(&markers, &plates, &motion, &[], findings);
    let of_plates = of_plates(&feet, &plates);
    Ok(vec![
        EventSource { word: "plates", title: "force plates (20 N)".into(), events: of_plates },
        of_motion(motion),
        EventSource { word: "file", title: "the file's own list".into(), events },
    ])
}

fn from_trc(bytes: &[u8], shown: &str, findings: &mut Findings) -> Result<Vec<EventSource>> {
    let file = LaboratoryFile::from_trc(bytes, shown, findings)?;
    Ok(markers_alone(&in_world(&file.recording, findings).markers, findings))
}

/// Events of a motion of Xsens MVN, and of its contact flags.
fn from_mvnx(bytes: &[u8], shown: &str, findings: &mut Findings) -> Result<Vec<EventSource>> {
    let LaboratoryFile { recording, events, .. } = LaboratoryFile::from_mvnx(bytes, shown, findings)?;
    let motion = foot_motion(&in_world(&recording, findings).markers, findings);
    Ok(vec![of_motion(motion), EventSource { word: "file", title: "the contact flags of the file".into(), events }])
}

fn in_world(recording: &LaboratoryRecording, findings: &mut Findings) -> LaboratoryRecording {
    let (axes, turned) = recording.in_world(findings);
    findings.report(Code::LaboratoryAxes, axes.statement);
    turned
}

fn from_bvh(bytes: &[u8], shown: &str, findings: &mut Findings) -> Result<Vec<EventSource>> {
    let (bvh, remarks) = Bvh::read(bytes)?;
    files::note_remarks(shown, &remarks, findings);
    let skeleton = skeleton_from_bvh(&bvh, shown, None, findings)?;
    // Animated figures may walk along a curve.
    let straight = straightened(&skeleton.markers).unwrap_or(skeleton.markers);
    Ok(markers_alone(&straight, findings))
}

fn markers_alone(markers: &MarkerRecording, findings: &mut Findings) -> Vec<EventSource> {
    vec![of_motion(foot_motion(markers, findings))]
}

/// Events from ground forces in columns with the usual names.
fn from_forces(bytes: &[u8], shown: &str, findings: &mut Findings) -> Result<Vec<EventSource>> {
    let (table, remarks) = Table::read_storage(bytes)?;
    files::note_remarks(shown, &remarks, findings);
    let times = table.times().context("no column `time`; expected it as the first column")?;
    let columns = vertical_columns(&table);
    if columns.is_empty() {
        bail!(
            "no ground-force columns among {}; expected ground_force_r_vy and ground_force_l_vy, or similar. hint: \
             `ambulo info` lists the columns",
            table.names().join(", ")
        );
    }
    let mut events = Vec::new();
    for (side, column) in columns {
        findings
            .report(Code::EventsColumns, format!("column `{column}` is used as the upward force on the {side} foot"));
        for contact in contacts_from_force(times, table.column(&column).unwrap_or_default()) {
            push(&mut events, side, contact.strike_s, contact.off_s);
        }
    }
    Ok(vec![EventSource { word: "plates", title: "ground forces (20 N)".into(), events: sorted(events) }])
}

/// The upward forces of both feet.
fn vertical_columns(table: &Table) -> Vec<(Side, String)> {
    const USUAL: [[&str; 2]; 4] = [
        ["ground_force_r_vy", "ground_force_l_vy"],
        ["R_ground_force_vy", "L_ground_force_vy"],
        ["ground_force_vy", "1_ground_force_vy"],
        ["ground_force_vy", "l_ground_force_vy"],
    ];
    let there = |names: &&[&str; 2]| names.iter().all(|name| table.column(name).is_some());
    let found = USUAL.iter().find(there);
    found.map_or(vec![], |names| Side::BOTH.into_iter().zip(names.map(str::to_owned)).collect())
}

/// Begin and end of contacts that were entirely on one plate; the ends of the recording are no events.
fn of_plates(feet: &FeetOnPlates, plates: &[PlateRecording]) -> Vec<Event> {
    let mut events = Vec::new();
    for contact in &feet.contacts {
        if let (Some(side), ContactQuality::Clean) = (contact.side, contact.quality) {
            let times = &plates[contact.plate].times;
            let inside = |time: &f64| times.first().is_some_and(|t| t < time) && times.last().is_some_and(|t| time < t);
            push(&mut events, side, Some(contact.start_s).filter(inside), Some(contact.end_s).filter(inside));
        }
    }
    sorted(events)
}

fn of_motion(motion: FootMotion) -> EventSource {
    let methods = motion.by_method.len();
    EventSource { word: "motion", title: format!("motion of the feet ({methods} methods)"), events: motion.events }
}

fn push(events: &mut Vec<Event>, side: Side, strike_s: Option<f64>, off_s: Option<f64>) {
    let event = |kind, time_s: Option<f64>| time_s.map(|time_s| Event { side, kind, time_s });
    events.extend([event(EventKind::Strike, strike_s), event(EventKind::Off, off_s)].into_iter().flatten());
}

fn sorted(mut events: Vec<Event>) -> Vec<Event> {
    events.sort_by_numbers(|event| [event.time_s, event.side.rank()]);
    events
}

/// Compares each source that has events with the ones before it.
fn agreements(sources: &[EventSource]) -> Vec<SourceAgreement> {
    let filled: Vec<&EventSource> = sources.iter().filter(|source| !source.events.is_empty()).collect();
    let pairs = (0..filled.len()).flat_map(|k| (k + 1..filled.len()).map(move |later| (k, later)));
    let agreement = |(reference, found): (usize, usize)| SourceAgreement {
        found: filled[found].word,
        reference: filled[reference].word,
        kinds: event_agreement(&filled[reference].events, &filled[found].events),
    };
    pairs.map(agreement).collect()
}

fn csv(sources: &[EventSource]) -> String {
    let mut out = String::from("side,event,time,source\n");
    for source in sources {
        for Event { side, kind, time_s } in &source.events {
            // Writing to memory does not fail.
            let _ = writeln!(out, "{},{},{time_s},{}", side.letter(), kind.word(), source.word);
        }
    }
    out
}
