//! `ambulo convert`: from one format to another.

mod folder;
mod recording;
mod skeleton;
mod table;

use crate::args::ConvertArgs;
use crate::{Completion, files, printer};
use ambulo::findings::{Code, Findings};
use ambulo::job::ending;
use anyhow::{Result, bail};
use std::path::PathBuf;

/// Each input format with its output formats.
const PAIRS: [(&str, &[&str]); 6] = [
    ("c3d", &["trc", "csv", "mot", "sto"]),
    ("trc", &["c3d", "csv"]),
    ("mot", &["sto", "csv", "bvh", "glb"]),
    ("sto", &["mot", "csv", "bvh", "glb"]),
    ("csv", &["mot", "sto"]),
    ("bvh", &["trc", "csv"]),
];

/// The files of a conversion, not yet written, and its findings.
struct Converted {
    files: Vec<(PathBuf, Vec<u8>)>,
    findings: Findings,
}

pub(crate) fn run(args: &ConvertArgs) -> Result<Completion> {
    let (from, to) = (ending(&args.input), ending(&args.output));
    let converted = if args.input.is_dir() { of_folder(args, &to) } else { of_file(args, &from, &to) }?;
    let inputs: Vec<PathBuf> =
        [Some(&args.input), args.model.as_ref(), args.rig.as_ref()].into_iter().flatten().cloned().collect();
    for (path, _) in &converted.files {
        files::check_target(path, &inputs, args.replace.existing())?;
    }
    for (path, bytes) in &converted.files {
        files::write(path, bytes)?;
    }
    let written: Vec<String> = converted.files.iter().map(|(path, _)| path.display().to_string()).collect();
    printer::convert(&args.input.display().to_string(), &written, &converted.findings, args.print)?;
    Ok(Completion::Passed)
}

fn of_file(args: &ConvertArgs, from: &str, to: &str) -> Result<Converted> {
    if !args.input.exists() {
        bail!("{}: there is no such file or folder", args.input.display());
    }
    if args.rig.is_some() {
        bail!(
            "--rig is for result folders only; expected the folder that `ambulo forces` wrote for this animation file"
        );
    }
    check_pair(from, to)?;
    check_options(args, from, to)?;
    let bytes = files::read(&args.input)?;
    match from {
        "c3d" | "trc" => recording::convert(args, &bytes, from, to),
        "bvh" => skeleton::convert(args, &bytes, to),
        _ if ["bvh", "glb"].contains(&to) => skeleton::make(args, &bytes, to),
        _ => table::convert(args, &bytes, from, to),
    }
}

fn of_folder(args: &ConvertArgs, to: &str) -> Result<Converted> {
    if !folder::TARGETS.contains(&to) {
        let found = if to.is_empty() { "a name without an extension".to_owned() } else { format!("`.{to}`") };
        bail!("a result folder is converted to .glb, .bvh or .csv; found {found} for the output");
    }
    if args.what.is_some() || args.world || args.model.is_some() {
        bail!("--what, --world and --model are for files; a result folder has its own body and axes");
    }
    if args.rig.is_some() && to != "bvh" {
        bail!("--rig writes a .bvh only; found `.{to}` for the output");
    }
    folder::convert(args, to)
}

fn check_pair(from: &str, to: &str) -> Result<()> {
    let listed = |endings: &[&str]| endings.iter().map(|e| format!(".{e}")).collect::<Vec<_>>().join(", ");
    match PAIRS.iter().find(|(known, _)| *known == from) {
        Some((_, targets)) if targets.contains(&to) => Ok(()),
        Some((_, targets)) if to.is_empty() => {
            bail!("the output's name has no extension; expected one of {}", listed(targets))
        }
        Some((_, targets)) => bail!(".{from} cannot be converted to .{to}; expected one of {}", listed(targets)),
        None => {
            let known: Vec<&str> = PAIRS.iter().map(|(known, _)| *known).collect();
            bail!("`.{from}` cannot be converted; expected an input with the extension {}", listed(&known))
        }
    }
}

/// Rejects options that have no effect for this pair of formats.
fn check_options(args: &ConvertArgs, from: &str, to: &str) -> Result<()> {
    if args.what.is_some() && !(from == "c3d" && to == "csv") {
        bail!("--what is for .c3d to .csv only; a .{to} has only one kind of content");
    }
    if args.world && !(["c3d", "trc", "bvh"].contains(&from) && ["trc", "c3d", "csv"].contains(&to)) {
        bail!("--world is for markers and joint centres only; .{from} to .{to} has none");
    }
    let moves_a_body = ["bvh", "glb"].contains(&to);
    if args.model.is_some() && !moves_a_body {
        bail!("--model is for .bvh and .glb only");
    }
    if moves_a_body && args.model.is_none() {
        bail!("a .{to} needs the model of these coordinates; expected --model FILE.osim");
    }
    Ok(())
}

/// Reports data that the new format cannot hold.
fn report_lost(findings: &mut Findings, what: &[String]) {
    if !what.is_empty() {
        findings.report(Code::ConvertLost, format!("not carried over: {}", what.join(", ")));
    }
}

/// `3 channels`, `1 event`; `None` for zero.
fn counted(count: usize, one: &str) -> Option<String> {
    (count > 0).then(|| ambulo::numerics::counted(count, one))
}
