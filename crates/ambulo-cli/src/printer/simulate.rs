//! Prints the outcome of `simulate`.

use super::{print_findings, print_json, print_line, print_verdict};
use crate::args::PrintArgs;
use ambulo_results::{ContactSummary, SceneSummary, WorldSummary};
use anyhow::Result;
use std::collections::BTreeMap;
use std::path::Path;

pub(crate) fn simulate(
    summary: &SceneSummary,
    timing_ms: &BTreeMap<String, f64>,
    output: &Path,
    print: PrintArgs,
) -> Result<()> {
    if print.quiet {
        return Ok(());
    }
    print_findings(&summary.findings);
    if print.json {
        return print_json(summary);
    }
    let (world, energy, convergence) = (&summary.world, &summary.energy, &summary.convergence);
    for walked in &summary.walked {
        print_line(&format!("{} {}", walked.figure, walked.sentence()))?;
    }
    print_line(&format!("{}, {}", summary.title.as_deref().unwrap_or("scene"), summary.input.scene))?;
    print_world(world)?;
    let [from, to] = summary.window_s;
    let each_us = 1e3 * timing_ms.get("simulate").copied().unwrap_or(0.0) / summary.steps.max(1) as f64;
    print_line(&format!(
        "  time        {from} to {to} s, {} steps of {} s, {each_us:.1} us each",
        summary.steps, summary.step_s,
    ))?;
    let why = summary.integrator_reason.map_or(String::new(), |reason| format!(", {}", reason.explanation()));
    print_line(&format!("  integrator  {}{why}", summary.integrator.word()))?;
    print_line(&format!(
        "  energy      {:.6} J at the start, {:.6} J at the end; between {:.6} and {:.6} J",
        energy.start_j, energy.end_j, energy.lowest_j, energy.highest_j
    ))?;
    if world.joints + world.closures > 0 {
        print_line(&format!("  joint error {:.1e} m at most", summary.joint_error_max_m))?;
    }
    if world.surfaces > 0 {
        print_contacts(&summary.contacts)?;
    }
    print_line(&format!(
        "  iterations  {:.1} per step, {} at most; residual {:.1e} at most, {} step{} not converged",
        convergence.iterations_mean,
        convergence.iterations_max,
        convergence.residual_max,
        convergence.not_converged,
        if convergence.not_converged == 1 { "" } else { "s" },
    ))?;
    print_efforts(summary)?;
    for judged in summary.verdict.iter().flat_map(|verdict| &verdict.figures) {
        print_line(&format!("  {}", judged.figure))?;
        print_verdict(&judged.verdict, print)?;
    }
    print_line(&format!("  written     {}", output.display()))
}

/// Bodies, masses and joints of the world.
fn print_world(world: &WorldSummary) -> Result<()> {
    print_line(&format!(
        "  world       {} bod{}, {:.2} kg{}{}{}{}",
        world.bodies,
        if world.bodies == 1 { "y" } else { "ies" },
        world.mass_kg,
        counted(world.figures, "figure", "figures"),
        counted(world.joints, "joint", "joints"),
        counted(world.closures, "closure", "closures"),
        counted(world.obstacles, "obstacle", "obstacles"),
    ))
}

/// Largest contact force and overlap.
fn print_contacts(contacts: &ContactSummary) -> Result<()> {
    print_line(&format!(
        "  contacts    {} points at most, {:.2} N at one of them, overlap {:.1e} m{}",
        contacts.points_max,
        contacts.normal_force_max_n,
        contacts.overlap_max_m,
        counted(contacts.impacts, "collision within a step", "collisions within steps"),
    ))
}

/// `, 2 joints`; empty for zero.
fn counted(count: usize, one: &str, many: &str) -> String {
    match count {
        0 => String::new(),
        1 => format!(", 1 {one}"),
        _ => format!(", {count} {many}"),
    }
}

/// Prints the efforts of coordinates that are not zero.
fn print_efforts(summary: &SceneSummary) -> Result<()> {
    /// Longer lists are in summary.json.
    const MOST: usize = 12;
    let acting: Vec<_> = summary.peaks.iter().filter(|p| p.max.abs().max(p.min.abs()) >= 0.005).collect();
    if acting.is_empty() {
        return Ok(());
    }
    print_line("  efforts                                   min          max")?;
    for peak in acting.iter().take(MOST) {
        print_line(&format!("    {:<34} {:>9.2}    {:>9.2} {}", peak.quantity, peak.min, peak.max, peak.unit))?;
    }
    if acting.len() > MOST {
        print_line(&format!("    and {} more in summary.json", acting.len() - MOST))?;
    }
    Ok(())
}
