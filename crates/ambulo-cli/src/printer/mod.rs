//! Prints results as text or JSON on standard output, and everything else on standard error.

mod batch;
mod calibrate;
mod comparison;
mod consistency;
mod forces;
mod muscles;
mod report;
mod reproduce;
mod session;
mod simulate;
mod subject;
mod sweep;
mod tools;
mod tune;
mod validate;

pub(crate) use batch::{BatchCounts, BatchRow, batch, batch_plan, batch_progress, failures};
pub(crate) use calibrate::calibrate;
pub(crate) use forces::forces;
pub(crate) use report::{report, view};
pub(crate) use reproduce::{lost_claims, reproduce, setting_written};
pub(crate) use session::session;
pub(crate) use simulate::simulate;
pub(crate) use sweep::sweep;
pub(crate) use tools::{ComparedColumn, EventSource, SourceAgreement, compare, convert, events, info};
pub(crate) use tune::{TunedGains, tune, tuning};
pub(crate) use validate::{found_trials, validate};

use crate::args::PrintArgs;
use crate::hints;
use ambulo::analysis::feasibility::{Verdict, VerdictState};
use ambulo::findings::{Finding, Findings, Severity};
use ambulo::gait::Walk;
use ambulo::gait::machine::{ChangeTable, StateChange, state_table};
use ambulo::numerics::counted;
use anyhow::Result;
use std::borrow::Cow;
use std::cell::RefCell;
use std::fmt::Arguments;
use std::io::{ErrorKind, IsTerminal, Write, stderr, stdout};
use std::path::Path;

/// Prints a line on standard output. A closed pipe (`ambulo ... | head`) is not an error.
fn print_line(line: &str) -> Result<()> {
    print(&visible(line))
}

/// Prints JSON on standard output. Codes that could change the terminal are escaped, so that the text stays the same.
fn print_json(value: &(impl serde::Serialize + ?Sized)) -> Result<()> {
    let text = serde_json::to_string_pretty(value)?;
    if !text.contains(is_code) {
        return print(&text);
    }
    let escaped = |c: char| if is_code(c) { format!("\\u{:04x}", u32::from(c)) } else { c.to_string() };
    print(&text.chars().map(escaped).collect::<String>())
}

thread_local! {
    /// The text that a caller reads in place of the terminal.
    static CAUGHT: RefCell<Option<String>> = const { RefCell::new(None) };
}

/// What `run` prints on standard output from this thread, and its result.
pub(crate) fn caught<T>(run: impl FnOnce() -> T) -> (String, T) {
    CAUGHT.set(Some(String::new()));
    let result = run();
    (CAUGHT.take().unwrap_or_default(), result)
}

/// Adds a line to the text of the caller, if there is one.
fn is_caught(text: &str) -> bool {
    let add = |caught: &mut String| {
        caught.push_str(text);
        caught.push('\n');
    };
    CAUGHT.with_borrow_mut(|caught| caught.as_mut().map(add).is_some())
}

fn print(text: &str) -> Result<()> {
    if is_caught(text) {
        return Ok(());
    }
    match writeln!(stdout(), "{text}") {
        Err(e) if e.kind() != ErrorKind::BrokenPipe => Err(e.into()),
        _ => Ok(()),
    }
}

/// Prints a line on standard error. The computation continues if the line cannot be written, for example into a closed
/// pipe.
fn say(line: Arguments<'_>) {
    let _ = writeln!(stderr(), "{}", visible(&line.to_string()));
}

/// Whether a character could change the terminal or how the text around it reads: a control code, or a mark
/// that changes the direction of writing or is invisible (Unicode, UAX #9, bidirectional formatting characters).
pub(crate) fn is_code(c: char) -> bool {
    let is_hidden =
        matches!(c, '\u{061c}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{2069}');
    (c.is_control() && c != '\n' && c != '\t') || is_hidden
}

/// The text without codes, which a file name could have.
pub(crate) fn visible(text: &str) -> Cow<'_, str> {
    match text.contains(is_code) {
        true => Cow::Owned(text.replace(is_code, "\u{fffd}")),
        false => Cow::Borrowed(text),
    }
}

/// Prints what the parser of the command line refused.
pub(crate) fn refused(text: &str) -> std::io::Result<()> {
    write!(stderr(), "{}", visible(text))
}

/// Prints one line.
pub(crate) fn line(text: &str) -> Result<()> {
    print_line(text)
}

/// Printed by `ambulo` alone.
pub(crate) fn guide() -> Result<()> {
    print_line(&format!(
        "Ambulo {}: the forces behind human walking, computed from motion.

  ambulo demo -o demo                                        try it, no file needed
  ambulo walk --speed 1.2                                    the forces of a synthetic walk, no file needed
  ambulo sweep --speed 0.8:1.6:0.2 --mass 60,80,100          the forces of many synthetic walks, with envelopes
  ambulo forces WALK.c3d --static STANDING.c3d               joint moments, powers, ground forces from markers and force plates
  ambulo forces MOTION.trc --mass 70                         the same without force plates: predicted ground forces
  ambulo forces MOTION --model OSIM --grf GRF --loads XML    the same from coordinates of an OpenSim model
  ambulo session DIR                                         the trials of a visit on one page, compared with healthy people
  ambulo validate DIR                                        judge predicted ground forces on a folder of trials on plates
  ambulo stream MODEL.osim --rate 200 --input tcp:5005       forces while the motion arrives
  ambulo run REQUEST.json                                    one of these verbs with its files and settings in JSON
  ambulo simulate SCENE.toml                                 simulate a scene
  ambulo tune SCENE.toml                                     tune the gains of a figure that walks by its own torques
  ambulo reproduce -o paper                                  recompute the claims of the 1997 paper
  ambulo view DIR                                            open the report page of a run in the browser
  ambulo report DIR --compare DIR2                           write the page again, here with two runs compared
  ambulo info FILE                                           describe the content of a file
  ambulo convert A B                                         convert a file: c3d, trc, mot, sto, csv, bvh, glb
  ambulo events FILE                                         detect foot strikes and foot offs
  ambulo compare A B --limit 0.1                             compare two tables

`ambulo COMMAND --help` lists every option, with examples.",
        env!("CARGO_PKG_VERSION")
    ))
}

/// Prints an error: where and what on the first line, what to do on the second.
pub(crate) fn error(error: &anyhow::Error) {
    say(format_args!("error: {}", visible(&with_hint(&chain(error), hints::of_error(error).as_deref()))));
}

/// An error as [`error`] prints it: what and where, and what to do.
pub(crate) fn error_parts(error: &anyhow::Error) -> (String, Option<String>) {
    parts(&chain(error), hints::of_error(error).as_deref())
}

fn chain(error: &anyhow::Error) -> String {
    error.chain().map(ToString::to_string).collect::<Vec<_>>().join(": ")
}

/// Prints which long computation begins, unless the output is JSON.
pub(crate) fn progress(what: &str, print: PrintArgs) {
    if !print.quiet && !print.json {
        say(format_args!("{what} ..."));
    }
}

/// Shows on a terminal how many steps a solver has made, on one line; `None` clears that line.
pub(crate) fn solver_steps(steps: Option<usize>, print: PrintArgs) {
    if !print.quiet && !print.json && stderr().is_terminal() {
        let text = steps.map_or_else(String::new, |steps| format!("finding the walk, step {steps}"));
        // As in `say`, the computation continues if this cannot be written.
        let _ = write!(stderr(), "{text:<40}\r");
    }
}

/// Prints the state machines of a gait, then calls `run` and prints each change of state as it happens.
pub(crate) fn states(
    walk: &Walk,
    findings: &Findings,
    print: PrintArgs,
    run: impl FnOnce(&mut dyn FnMut(&StateChange)) -> Result<()>,
) -> Result<()> {
    let table = state_table(walk);
    if print.quiet || print.json {
        let mut changes = Vec::new();
        run(&mut |change| changes.push(change.clone()))?;
        return if print.quiet { Ok(()) } else { states_as_json(&table, &changes, findings) };
    }
    let lines = ChangeTable::of(walk);
    // A rejected gait prints nothing, so machines are printed with the first change.
    let heading = || {
        print_findings(findings.as_slice());
        print_line(&format!("{}\n\n{}", table.trim_end(), lines.header()))
    };
    let mut printed = None;
    run(&mut |change| {
        let so_far = printed.take().unwrap_or_else(heading);
        printed = Some(so_far.and_then(|()| print_line(&lines.row(change))));
    })?;
    printed.unwrap_or_else(heading)
}

fn states_as_json(table: &str, changes: &[StateChange], findings: &Findings) -> Result<()> {
    print_findings(findings.as_slice());
    let change = |change: &StateChange| {
        let StateChange { time_s, machine, from, to, when } = change;
        serde_json::json!({ "time_s": time_s, "machine": machine, "from": from, "to": to, "because": when })
    };
    let run: Vec<_> = changes.iter().map(change).collect();
    print_json(&serde_json::json!({ "states": table, "run": run }))
}

/// Prints what frames and results of a stream contain, as JSON.
pub(crate) fn stream_description(description: &impl serde::Serialize) -> Result<()> {
    print_json(description)
}

/// Prints a line about a running stream.
pub(crate) fn stream_line(line: &str) {
    say(format_args!("{}", visible(line)));
}

fn print_findings(findings: &[Finding]) {
    for finding in findings {
        let times = if finding.count > 1 { format!(" ({} times)", finding.count) } else { String::new() };
        let severity = finding.severity();
        let message = with_hint(&format!("{}{times}", finding.message), hints::of_finding(finding.code));
        say(format_args!("{severity}: {}", visible(&message)));
    }
}

/// Prints the warnings of one of several trials, with its name.
pub(crate) fn warnings_of_trial(trial: &Path, findings: &[Finding], print: PrintArgs) {
    for finding in findings.iter().filter(|finding| finding.severity() == Severity::Warning && !print.quiet) {
        let message = with_hint(&format!("{}: {}", trial.display(), finding.message), hints::of_finding(finding.code));
        say(format_args!("warning: {}", visible(&message)));
    }
}

/// Prints the first warnings, and the number of further warnings and notes.
fn print_warnings(findings: &[Finding]) {
    /// With one line for the rest and the lines of a run, a terminal of 25 lines shows everything.
    const MOST: usize = 4;
    let (mut warnings, notes): (Vec<&Finding>, Vec<&Finding>) =
        findings.iter().partition(|finding| finding.severity() == Severity::Warning);
    warnings.sort_by_key(|finding| !finding.code.comes_first());
    for finding in warnings.iter().take(MOST) {
        let (what, hint) = finding.message.split_once("hint: ").unwrap_or((&finding.message, ""));
        let hint = Some(hint).filter(|hint| !hint.is_empty()).or(hints::of_finding(finding.code));
        let hint = hint.map_or(String::new(), |hint| format!(" (hint: {hint})"));
        say(format_args!("warning: {}{}", visible(what.trim_end()), visible(&hint)));
    }
    let more = [(warnings.len().saturating_sub(MOST), "warning"), (notes.len(), "note")];
    let more = more.into_iter().filter(|(count, _)| *count > 0);
    let more: Vec<String> = more.map(|(count, kind)| counted(count, kind)).collect();
    if !more.is_empty() {
        say(format_args!("{} more: use --verbose, or read them in the report", more.join(" and ")));
    }
}

/// A path as it is typed in a shell.
fn quoted(path: &Path) -> String {
    let text = path.display().to_string();
    let is_plain = |c: char| c.is_alphanumeric() || "/\\._-+=:@%,~".contains(c);
    if !text.is_empty() && text.chars().all(is_plain) {
        return text;
    }
    if cfg!(windows) { format!("\"{text}\"") } else { format!("'{}'", text.replace('\'', "'\\''")) }
}

/// The number of reasons, after a state.
fn counted_reasons(count: usize) -> String {
    if count == 0 { String::new() } else { format!(", {}", counted(count, "reason")) }
}

/// Number of reasons that are printed; all are in summary.json.
fn reasons_shown(count: usize, print: PrintArgs) -> usize {
    if print.verbose { count } else { count.min(3) }
}

/// A message with its own hint and the hint of the command on a second line.
fn with_hint(message: &str, of_command: Option<&str>) -> String {
    match parts(message, of_command) {
        (what, None) => what,
        (what, Some(hint)) => format!("{}\n  hint: {hint}", what.trim_end()),
    }
}

fn parts(message: &str, of_command: Option<&str>) -> (String, Option<String>) {
    let (what, own) = message.split_once("hint: ").map_or((message, None), |(what, own)| (what, Some(own)));
    let hints: Vec<&str> = own.into_iter().chain(of_command).collect();
    (what.to_owned(), (!hints.is_empty()).then(|| hints.join("; ")))
}

/// Prints the verdict: feasible with the check that came closest to its limit, infeasible with the reasons, or why it
/// is not judged.
fn print_verdict(verdict: &Verdict, print: PrintArgs) -> Result<()> {
    if verdict.state == VerdictState::NotJudged {
        print_line(&format!("  verdict   not judged: {}", verdict.undecided.join("; ")))?;
        return print_likeness(verdict);
    }
    if verdict.state == VerdictState::Feasible {
        let nearest = verdict.closest.iter().max_by(|a, b| a.share.total_cmp(&b.share));
        let nearest = nearest.map_or_else(String::new, |c| {
            format!(
                ": at most {:.0} % of the allowed value, {} ({}) at {:.3} s",
                100.0 * c.share,
                c.check,
                c.quantity,
                c.at_s
            )
        });
        print_line(&format!("  verdict   feasible{nearest}"))?;
        return print_likeness(verdict);
    }
    let count = verdict.reasons.len();
    print_line(&format!("  verdict   infeasible{}", counted_reasons(count)))?;
    let mut shown = verdict.reasons.iter().take(reasons_shown(count, print));
    shown.try_for_each(|reason| print_line(&format!("    {}: {}", reason.check, reason.message)))?;
    print_likeness(verdict)
}

/// Prints whether a walk that was made is like walks of people.
fn print_likeness(verdict: &Verdict) -> Result<()> {
    let unlike = verdict.unlike_people();
    if unlike.is_empty() {
        let Some(nearest) = verdict.likeness.iter().max_by(|a, b| a.share.total_cmp(&b.share)) else { return Ok(()) };
        let share = 100.0 * nearest.share;
        return print_line(&format!("  likeness  like people: at most {share:.0} % of the limit, {}", nearest.measure));
    }
    print_line(&format!("  likeness  unlike people{}", counted_reasons(unlike.len())))?;
    unlike.iter().try_for_each(|found| print_line(&format!("    {}: {}", found.measure, found.message)))
}
