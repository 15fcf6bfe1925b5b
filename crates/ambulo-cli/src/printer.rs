//! What the user reads: text or JSON on standard output, everything else on standard error.

#![expect(clippy::print_stderr, reason = "this is the one place that prints")]

mod files;

pub(crate) use files::{convert, events, info};

use crate::args::Voice;
use ambulo::analysis::Agreement;
use ambulo::analysis::feasibility::Verdict;
use ambulo::findings::{Finding, Findings};
use ambulo::report::{FilterSummary, Ground, SceneSummary, Summary, WalkSummary};
use ambulo::reproduction::{Claim, Sensitivity};
use anyhow::Result;
use serde::Serialize;
use std::io::{ErrorKind, Write, stdout};
use std::path::Path;

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
  ambulo forces MOTION --model OSIM --grf GRF --loads XML    joint moments, powers, ground forces
  ambulo simulate SCENE.toml --plot                          a scene stepped through time
  ambulo reproduce -o paper                                  the claims of the 1997 paper, recomputed
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
    match message.split_once("hint: ") {
        Some((what, hint)) => eprintln!("error: {}\n  hint: {hint}", what.trim_end()),
        None => eprintln!("error: {message}"),
    }
}

/// The outcome of `forces` and `demo`.
pub(crate) fn forces(summary: &Summary, output: &Path, voice: Voice) -> Result<()> {
    if voice.quiet {
        return Ok(());
    }
    print_findings(&summary.findings);
    if voice.json {
        say(&serde_json::to_string_pretty(summary)?)?;
        return Ok(());
    }
    say(&format!("{}, {}", summary.model, summary.input.motion))?;
    say(&format!("  mass      {:.2} kg ({})", summary.mass_kg, summary.mass_source))?;
    if let Some(speed) = summary.speed_m_s {
        say(&format!("  speed     {speed:.2} m/s"))?;
    }
    let [from, to] = summary.window_s;
    say(&format!("  window    {from:.3} to {to:.3} s, {} frames at {:.2} Hz", summary.frames, summary.rate_hz))?;
    print_ground(summary)?;
    if let Some(walk) = &summary.walk {
        print_walk(walk)?;
    }
    if let Some(r) = &summary.residual {
        say(&format!(
            "  residual  {:.1} N rms ({:.1} %BW), {:.1} N peak; {:.1} N.m rms, {:.1} N.m peak",
            r.force_rms_n,
            100.0 * r.force_rms_bw,
            r.force_peak_n,
            r.moment_rms_nm,
            r.moment_peak_nm
        ))?;
    }
    print_peaks(summary)?;
    if let Some(verdict) = &summary.verdict {
        print_verdict(verdict)?;
    }
    say(&format!("  written   {}", output.display()))?;
    Ok(())
}

/// A line about what takes a while, for people.
pub(crate) fn progress(what: &str, voice: Voice) {
    if !voice.quiet && !voice.json {
        eprintln!("{what} ...");
    }
}

/// The outcome of `reproduce`.
pub(crate) fn reproduce(claims: &[Claim], others: &[Sensitivity], output: &Path, voice: Voice) -> Result<()> {
    if voice.quiet {
        return Ok(());
    }
    if voice.json {
        return say(&serde_json::to_string_pretty(claims)?);
    }
    for claim in claims {
        let holds = if claim.pass { "holds" } else { "fails" };
        say(&format!("{:3} {holds}  {}", claim.id, claim.paper))?;
        say(&format!("           {} = {:.4}", claim.headline, claim.value()))?;
        let turned = others.iter().filter(|other| other.turned(claims).contains(&claim.id)).count();
        if turned > 0 {
            say(&format!("           otherwise with {turned} of {} other values: assumptions.csv", others.len()))?;
        }
    }
    let held = claims.iter().filter(|claim| claim.pass).count();
    say(&format!("  {held} of {} hold; why and why not: claims.json", claims.len()))?;
    say(&format!("  written   {}", output.display()))
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

/// How a walk was made.
fn print_walk(walk: &WalkSummary) -> Result<()> {
    say(&format!(
        "  walk      {}, style {}, {} mode: {:.2} m/s, steps of {:.3} m, {:.1} a minute",
        walk.gait, walk.style, walk.mode, walk.speed_asked_m_s, walk.step_length_m, walk.cadence_steps_min
    ))?;
    if let (Some(count), Some(degrees), Some(path)) =
        (walk.parameters_adjusted, &walk.adjustment_deg, &walk.pelvis_path_mm)
    {
        let angles: Vec<String> =
            degrees.iter().map(|(name, size)| format!("{} {:.1}", name.trim_end_matches("_r"), size.rms)).collect();
        say(&format!("  changed   by {count} numbers: {} deg rms", angles.join(", ")))?;
        say(&format!("            pelvis {:.1} mm rms forwards, {:.1} mm up", path.forward.rms, path.up.rms))?;
    }
    let slip = match (walk.foot_slip_mm, walk.foot_slip_path_mm) {
        (Some(distance), Some(path)) => {
            format!("; feet get {distance:.1} mm from where they stood, by a way of {path:.1} mm")
        }
        _ => String::new(),
    };
    say(&format!(
        "  trunk     held with {:.1} N.m rms, {:.1} N.m peak{slip}",
        walk.trunk_torque_nm.rms, walk.trunk_torque_nm.largest
    ))?;
    if walk.blows > 0 {
        say(&format!("  blows     {}, {:.1} N.s at most", walk.blows, walk.largest_blow_n_s))?;
    }
    Ok(())
}

fn print_findings(findings: &[Finding]) {
    for finding in findings {
        let times = if finding.count > 1 { format!(" ({} times)", finding.count) } else { String::new() };
        let severity = format!("{:?}", finding.severity).to_lowercase();
        eprintln!("{severity}: {}{times}", finding.message.replace(" hint: ", "\n  hint: "));
    }
}

/// The outcome of `simulate`.
pub(crate) fn simulate(summary: &SceneSummary, output: &Path, voice: Voice) -> Result<()> {
    if voice.quiet {
        return Ok(());
    }
    print_findings(&summary.findings);
    if voice.json {
        return say(&serde_json::to_string_pretty(summary)?);
    }
    let (world, energy, convergence) = (&summary.world, &summary.energy, &summary.convergence);
    say(&format!("{}, {}", summary.title.as_deref().unwrap_or("scene"), summary.input.scene))?;
    let counted = |count: usize, one: &str, many: &str| match count {
        0 => String::new(),
        1 => format!(", 1 {one}"),
        _ => format!(", {count} {many}"),
    };
    say(&format!(
        "  world       {} bod{}, {:.2} kg{}{}{}{}",
        world.bodies,
        if world.bodies == 1 { "y" } else { "ies" },
        world.mass_kg,
        counted(world.figures, "figure", "figures"),
        counted(world.joints, "joint", "joints"),
        counted(world.closures, "closure", "closures"),
        counted(world.obstacles, "obstacle", "obstacles"),
    ))?;
    let [from, to] = summary.window_s;
    let each_us = 1e3 * summary.timing_ms.get("simulate").copied().unwrap_or(0.0) / summary.steps.max(1) as f64;
    say(&format!(
        "  time        {from} to {to} s, {} steps of {} s ({}), {each_us:.1} us each",
        summary.steps, summary.step_s, summary.integrator
    ))?;
    say(&format!(
        "  energy      {:.6} J at the start, {:.6} J at the end; between {:.6} and {:.6} J",
        energy.start_j, energy.end_j, energy.lowest_j, energy.highest_j
    ))?;
    if world.joints + world.closures > 0 {
        say(&format!("  joint error {:.1e} m at most", summary.joint_error_max_m))?;
    }
    if world.surfaces > 0 {
        let contacts = &summary.contacts;
        say(&format!(
            "  contacts    {} points at most, {:.2} N at one of them, overlap {:.1e} m{}",
            contacts.points_max,
            contacts.normal_force_max_n,
            contacts.overlap_max_m,
            counted(contacts.impacts, "collision within a step", "collisions within steps"),
        ))?;
    }
    say(&format!(
        "  iterations  {:.1} a step, {} at most; residual {:.1e} at most, {} step{} not converged",
        convergence.iterations_mean,
        convergence.iterations_max,
        convergence.residual_max,
        convergence.not_converged,
        if convergence.not_converged == 1 { "" } else { "s" },
    ))?;
    print_efforts(summary)?;
    for judged in summary.verdict.iter().flat_map(|verdict| &verdict.figures) {
        say(&format!("  {}", judged.figure))?;
        print_verdict(&judged.verdict)?;
    }
    say(&format!("  written     {}", output.display()))
}

/// Efforts of the coordinates that have some.
fn print_efforts(summary: &SceneSummary) -> Result<()> {
    /// Longer lists are in summary.json.
    const MOST: usize = 12;
    let acting: Vec<_> = summary.peaks.iter().filter(|p| p.max.abs().max(p.min.abs()) >= 0.005).collect();
    if acting.is_empty() {
        return Ok(());
    }
    say("  efforts                                   min          max")?;
    for peak in acting.iter().take(MOST) {
        say(&format!("    {:<34} {:>9.2}    {:>9.2} {}", peak.quantity, peak.min, peak.max, peak.unit))?;
    }
    if acting.len() > MOST {
        say(&format!("    and {} more in summary.json", acting.len() - MOST))?;
    }
    Ok(())
}

fn print_ground(summary: &Summary) -> Result<()> {
    let motion = filter(&summary.filter.motion);
    let Ground { source, threshold_n, .. } = summary.ground;
    if source == "none" {
        return say(&format!("  filter    motion {motion}\n  ground    none"));
    }
    say(&format!("  filter    motion {motion}, forces {}", filter(&summary.filter.force)))?;
    say(&format!("  ground    {source} (a foot counts as unloaded below {threshold_n} N)"))
}

fn print_peaks(summary: &Summary) -> Result<()> {
    say("  peaks                               min          max")?;
    for peak in summary.peaks.iter().filter(|p| p.unit == "N.m") {
        say(&format!("    {:<28} {:>9.2}    {:>9.2} {}", peak.quantity, peak.min, peak.max, peak.unit))?;
    }
    Ok(())
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

fn filter(filter: &FilterSummary) -> String {
    match (filter.cutoff_hz, filter.order) {
        (Some(hz), Some(order)) => format!("{} {hz} Hz (order {order}, forwards and backwards)", filter.kind),
        _ => filter.kind.to_owned(),
    }
}

/// Agreement of one column.
#[derive(Debug, Clone, Serialize)]
pub(crate) struct ComparedColumn {
    pub(crate) column: String,
    /// In the column's unit.
    pub(crate) rmse: f64,
    /// RMSE over the mean range; `null` if both are flat.
    pub(crate) rrmse: Option<f64>,
    /// Pearson's correlation; `null` if one is flat.
    pub(crate) r: Option<f64>,
    pub(crate) max_difference: f64,
    pub(crate) samples: usize,
    /// Whether the limit was kept; `null` without a limit.
    pub(crate) within_limit: Option<bool>,
}

impl ComparedColumn {
    pub(crate) fn new(column: &str, agreement: Agreement, limit: Option<f64>) -> ComparedColumn {
        let known = |x: f64| x.is_finite().then_some(x);
        ComparedColumn {
            column: column.to_owned(),
            rmse: agreement.rmse,
            rrmse: known(agreement.rrmse),
            r: known(agreement.r),
            max_difference: agreement.max_difference,
            samples: agreement.samples,
            within_limit: limit.map(|limit| agreement.rmse <= limit),
        }
    }
}

/// The outcome of `compare`.
pub(crate) fn compare(rows: &[ComparedColumn], limit: Option<f64>, voice: Voice) -> Result<()> {
    if voice.json {
        say(&serde_json::to_string_pretty(rows)?)?;
    }
    if voice.json || voice.quiet {
        return Ok(());
    }
    let width = rows.iter().map(|r| r.column.len()).max().unwrap_or(0).max(6);
    say(&format!("{:<width$}  {:>12}  {:>8}  {:>8}  {:>12}  samples", "column", "RMSE", "rRMSE", "r", "max"))?;
    for row in rows {
        let share = row.rrmse.map_or("-".into(), |x| format!("{x:.4}"));
        let r = row.r.map_or("-".into(), |x| format!("{x:.5}"));
        let verdict = match row.within_limit {
            Some(false) => "  over the limit",
            _ => "",
        };
        say(&format!(
            "{:<width$}  {:>12.6}  {share:>8}  {r:>8}  {:>12.6}  {}{verdict}",
            row.column, row.rmse, row.max_difference, row.samples
        ))?;
    }
    if let Some(limit) = limit {
        let over = rows.iter().filter(|r| r.within_limit == Some(false)).count();
        say(&format!("{over} of {} columns over the limit of {limit}", rows.len()))?;
    }
    Ok(())
}
