//! What the user reads: text or JSON on standard output, everything else on standard error.

#![expect(clippy::print_stderr, reason = "this is the one place that prints")]

mod comparison;
mod consistency;
mod forces;
mod report;
mod reproduce;
mod simulate;
mod subject;
mod tools;

pub(crate) use forces::forces;
pub(crate) use report::{report, view};
pub(crate) use reproduce::reproduce;
pub(crate) use simulate::simulate;
pub(crate) use tools::{ComparedColumn, EventSource, SourceAgreement, compare, convert, events, info};

use crate::args::Voice;
use crate::hints;
use ambulo::analysis::feasibility::Verdict;
use ambulo::findings::{Finding, Findings};
use anyhow::Result;
use std::io::{ErrorKind, Write, stdout};

/// A line on standard output. A reader that has gone away (`ambulo ... | head`) is no error.
fn say(line: &str) -> Result<()> {
    match writeln!(stdout(), "{line}") {
        Err(e) if e.kind() != ErrorKind::BrokenPipe => Err(e.into()),
        _ => Ok(()),
    }
}

/// Printed by `ambulo` alone.
pub(crate) fn guide() -> Result<()> {
    say(&format!(
        "Ambulo {}: motion in, forces out.

  ambulo demo -o demo                                        try it, no file needed
  ambulo walk --speed 1.2                                    a figure that walks: the same results, no file needed
  ambulo forces WALK.c3d --static STANDING.c3d               joint moments, powers, ground forces, from markers and plates
  ambulo forces MOTION.trc --mass 70                         the same without plates: ground forces predicted from motion
  ambulo forces MOTION --model OSIM --grf GRF --loads XML    the same, from coordinates of an OpenSim model
  ambulo simulate SCENE.toml --plot                          a scene stepped through time
  ambulo reproduce -o paper                                  the claims of the 1997 paper, recomputed
  ambulo view DIR                                            the report page of a run, in the browser
  ambulo report DIR --compare DIR2                           the same page anew, two runs compared
  ambulo info FILE                                           what a file holds
  ambulo convert A B                                         from one format to another: c3d, trc, mot, sto, csv, bvh
  ambulo events FILE                                         when feet meet and leave the ground
  ambulo compare A B --limit 0.1                             how far two tables agree

`ambulo <verb> --help` shows every option with an example that runs.",
        env!("CARGO_PKG_VERSION")
    ))
}

/// An error: what and where on the first line, what to do on the second.
pub(crate) fn error(error: &anyhow::Error) {
    let message = error.chain().map(ToString::to_string).collect::<Vec<_>>().join(": ");
    eprintln!("error: {}", with_hint(&message, hints::of_error(error)));
}

/// A line about what takes a while, for people.
pub(crate) fn progress(what: &str, voice: Voice) {
    if !voice.quiet && !voice.json {
        eprintln!("{what} ...");
    }
}

/// The states of a gait's machine.
pub(crate) fn states(table: &str, findings: &Findings, voice: Voice) -> Result<()> {
    if voice.quiet {
        return Ok(());
    }
    print_findings(findings.as_slice());
    if voice.json {
        return say(&serde_json::to_string_pretty(&serde_json::json!({ "states": table }))?);
    }
    say(table.trim_end())
}

fn print_findings(findings: &[Finding]) {
    for finding in findings {
        let times = if finding.count > 1 { format!(" ({} times)", finding.count) } else { String::new() };
        let severity = finding.severity();
        let message = with_hint(&format!("{}{times}", finding.message), hints::of_finding(finding.code));
        eprintln!("{severity}: {message}");
    }
}

/// A message with its own hint and that of the command on a second line.
fn with_hint(message: &str, of_command: Option<&str>) -> String {
    let (what, own) = message.split_once("hint: ").map_or((message, None), |(what, own)| (what, Some(own)));
    let hints: Vec<&str> = own.into_iter().chain(of_command).collect();
    match hints.is_empty() {
        true => what.to_owned(),
        false => format!("{}\n  hint: {}", what.trim_end(), hints.join("; ")),
    }
}

/// Feasible, and what came nearest to its limit; or why not.
fn print_verdict(verdict: &Verdict) -> Result<()> {
    /// Longer lists are in summary.json.
    const MOST: usize = 6;
    if verdict.feasible {
        let nearest = verdict.closest.iter().max_by(|a, b| a.share.total_cmp(&b.share));
        let nearest = nearest.map_or_else(String::new, |c| {
            format!(
                ": at most {:.0} % of what is allowed, {} ({}) at {:.3} s",
                100.0 * c.share,
                c.check,
                c.quantity,
                c.at_s
            )
        });
        return say(&format!("  verdict   feasible{nearest}"));
    }
    let count = verdict.reasons.len();
    say(&format!("  verdict   infeasible, {count} reason{}", if count == 1 { "" } else { "s" }))?;
    for reason in verdict.reasons.iter().take(MOST) {
        say(&format!("    {}: {}", reason.check, reason.message))?;
    }
    if count > MOST {
        say(&format!("    and {} more in summary.json", count - MOST))?;
    }
    Ok(())
}
