//! Prints the outcome of `forces`, `walk` and `demo`.

use super::{
    comparison, consistency, counted_reasons, muscles, print_findings, print_json, print_line, print_verdict,
    print_warnings, quoted, reasons_shown, subject,
};
use crate::args::PrintArgs;
use ambulo::analysis::PredictionCheck;
use ambulo::numerics::{Order, counted};
use ambulo::simulation::consistent_walk::Magnitude;
use ambulo::simulation::synthetic::SyntheticMode;
use ambulo::study::{MassState, MassWitness, Quality};
use ambulo_results::{
    FilterSummary, ForceUnit, Ground, GroundOrigin, PAGE, PeakSummary, ResidualSummary, Summary, TrackingSummary,
    WalkSummary,
};
use anyhow::Result;
use std::path::Path;

/// Prints a run: at most 25 lines, or everything with `--verbose`.
pub(crate) fn forces(summary: &Summary, output: &Path, print: PrintArgs) -> Result<()> {
    if print.quiet {
        return Ok(());
    }
    if print.json {
        print_findings(&summary.findings);
        return print_json(summary);
    }
    if print.verbose {
        print_findings(&summary.findings);
    } else {
        print_warnings(&summary.findings);
    }
    print_line(&format!("{}, {}", summary.model, summary.input.motion))?;
    print_mass(summary)?;
    if print.verbose {
        details(summary)?
    } else {
        outline(summary)?
    }
    if let Some(quality) = &summary.quality {
        print_quality(quality, &summary.ground, print)?;
    }
    if let Some(verdict) = &summary.verdict {
        print_verdict(verdict, print)?;
    }
    print_line(&format!("  written   {}", output.display()))?;
    match summary.files.contains_key(PAGE) {
        true => print_line(&format!("  next      ambulo view {}", quoted(output))),
        false => Ok(()),
    }
}

/// The mass of the body, how well it is known, and what the force plates carry.
fn print_mass(summary: &Summary) -> Result<()> {
    let mass = &summary.mass;
    let plates = match (mass.state, mass.plates_kg, mass.plates_error_kg) {
        (MassState::Weighed | MassState::Contradicted, Some(kg), Some(error)) => {
            format!("; the force plates carry {kg:.1} ± {error:.1} kg")
        }
        _ => String::new(),
    };
    let state = match (mass.source, mass.state) {
        (MassWitness::Stated, MassState::Stated) => "not weighed",
        (_, state) => state.word(),
    };
    print_line(&format!("  mass      {:.2} kg ({}, {state}{plates})", mass.kg, mass.source.words()))
}

/// Prints the main numbers of a run: markers, activity, speed, cadence, step length.
fn outline(summary: &Summary) -> Result<()> {
    if let Some(subject) = &summary.subject {
        subject::print_markers(subject)?;
    }
    let mean = |name: &str| {
        let quantity = summary.times_and_distances.quantities.iter().find(|quantity| quantity.quantity == name)?;
        Some(quantity.both.as_ref()?.mean)
    };
    // The straight line between the ends of a curved path gives little information about the walk.
    let along_path = summary.times_and_distances.path_speed_m_s.map(|speed| format!("{speed:.2} m/s along the path"));
    let speed = along_path.or(summary.speed_m_s.map(|speed| format!("{speed:.2} m/s")));
    let walk = [
        summary.activity.map(|activity| activity.words()),
        speed,
        mean("cadence").map(|cadence| format!("{cadence:.0} steps/min")),
        mean("step_length").map(|length| format!("steps of {length:.2} m")),
    ];
    let walk: Vec<String> = walk.into_iter().flatten().collect();
    if !walk.is_empty() {
        print_line(&format!("  activity  {}", walk.join(", ")))?;
    }
    if let Some(made) = summary.walk.as_ref().and_then(|walk| walk.prediction.as_ref()) {
        let cost = format!("{:.1} J/kg/m", made.cost_of_transport_j_kg_m);
        let parts = made.conditions().into_iter().chain([format!("cost of transport {cost}")]);
        print_line(&format!("  walk      {}", parts.collect::<Vec<_>>().join(", ")))?;
        let lines = made.without_devices().into_iter().chain(made.device_words());
        lines.into_iter().try_for_each(|words| print_line(&format!("  device    {words}")))?;
    }
    let [from, to] = summary.window_s;
    let Summary { frames, rate_hz, ground, .. } = summary;
    print_line(&format!(
        "  forces    {}, {from:.3} to {to:.3} s, {} at {rate_hz:.2} Hz",
        ground.source,
        counted(*frames, "frame")
    ))?;
    print_shares(ground)?;
    if let Some(comparison) = &summary.comparison {
        comparison::print_vertical(comparison)?;
    }
    if let Some(residual) = &summary.residual {
        let ResidualSummary { force_rms_bw, moment_rms_nm, .. } = residual;
        print_line(&format!("  residual  {:.1} % of body weight, {moment_rms_nm:.1} N.m rms", 100.0 * force_rms_bw))?;
    }
    if let Some(tracking) = &summary.tracking {
        print_tracking(tracking)?;
    }
    if let Some(found) = &summary.muscles {
        muscles::print_muscles(found)?;
    }
    for (i, peak) in largest_peaks(summary).enumerate() {
        let head = if i == 0 { "peaks" } else { "" };
        print_line(&format!("  {head:<9} {} {:.1} to {:.1} {}", peak.quantity, peak.min, peak.max, peak.unit))?;
    }
    Ok(())
}

/// Prints the changes by which tracking made feet on the ground supply the external forces.
fn print_tracking(tracking: &TrackingSummary) -> Result<()> {
    let TrackingSummary { residual_peak, rotations_rms_deg, root_rms_mm, steps, largest_change_deg, hands_mm, .. } =
        tracking;
    let largest = largest_change_deg.iter().max_by(|a, b| a.1.total_cmp(b.1));
    let most = largest.map_or_else(String::new, |(name, deg)| format!(" (most: {name} by {deg:.0} deg)"));
    let hands = hands_mm.map_or_else(String::new, |mm| format!(", a hand by at most {mm:.0} mm"));
    print_line(&format!(
        "  tracking  motion changed by {rotations_rms_deg:.1} deg{most} and {root_rms_mm:.1} mm rms{hands}, residual \
         at most {:.3} % of body weight, {}",
        100.0 * residual_peak,
        counted(*steps, "step")
    ))
}

/// The three largest joint moments.
fn largest_peaks(summary: &Summary) -> impl Iterator<Item = &PeakSummary> {
    let mut peaks: Vec<&PeakSummary> = summary.peaks.iter().filter(|p| p.unit == ForceUnit::NewtonMetre).collect();
    let size = |peak: &PeakSummary| peak.max.abs().max(peak.min.abs());
    peaks.sort_by_number(|peak| -size(peak));
    peaks.into_iter().take(3)
}

/// Everything that is worth reading in a terminal.
fn details(summary: &Summary) -> Result<()> {
    if let Some(subject) = &summary.subject {
        subject::print(subject)?;
    }
    if let Some(speed) = summary.speed_m_s {
        print_line(&format!("  speed     {speed:.2} m/s"))?;
    }
    let [from, to] = summary.window_s;
    print_line(&format!(
        "  window    {from:.3} to {to:.3} s, {} at {:.2} Hz",
        counted(summary.frames, "frame"),
        summary.rate_hz
    ))?;
    print_ground(summary)?;
    if let Some(walk) = &summary.walk {
        print_walk(walk)?;
    }
    if let Some(r) = &summary.residual {
        print_line(&format!(
            "  residual  {:.1} N rms ({:.1} %BW), {:.1} N peak; {:.1} N.m rms, {:.1} N.m peak",
            r.force_rms_n,
            100.0 * r.force_rms_bw,
            r.force_peak_n,
            r.moment_rms_nm,
            r.moment_peak_nm
        ))?;
    }
    if let Some(agreed) = &summary.consistency {
        consistency::print(agreed)?;
    }
    if let Some(tracking) = &summary.tracking {
        print_tracking(tracking)?;
    }
    if let Some(prediction) = &summary.prediction {
        print_checks(&prediction.checks)?;
    }
    print_peaks(summary)?;
    summary.comparison.as_ref().map_or(Ok(()), comparison::print)
}

/// Prints whether the data are good, and the strongest reasons why not; good data may be those of one leg only.
fn print_quality(quality: &Quality, ground: &Ground, print: PrintArgs) -> Result<()> {
    let count = quality.reasons.len();
    let but = ground.unmeasured_leg().filter(|_| count == 0).map_or_else(String::new, |leg| format!(", but {leg}"));
    print_line(&format!("  quality   {}{}{but}", quality.state.word(), counted_reasons(count)))?;
    let shown = quality.reasons.iter().take(reasons_shown(count, print));
    shown.into_iter().try_for_each(|reason| print_line(&format!("    {}: {}", reason.state.word(), reason.message)))
}

/// Angles whose change is printed, the largest first.
const ANGLES_SHOWN: usize = 5;

/// Prints how a synthetic walk was computed.
fn print_walk(walk: &WalkSummary) -> Result<()> {
    print_line(&format!(
        "  walk      {}, style {}, {} mode: {:.2} m/s, steps of {:.3} m, {:.1} per minute",
        walk.gait, walk.style, walk.mode, walk.speed_asked_m_s, walk.step_length_m, walk.cadence_steps_min
    ))?;
    if let (Some(count), Some(degrees), Some(path)) =
        (walk.parameters_adjusted, &walk.adjustment_deg, &walk.pelvis_path_mm)
    {
        let mut largest: Vec<_> = degrees.iter().collect();
        largest.sort_by_number(|(_, size)| -size.rms);
        let shown = largest.iter().take(ANGLES_SHOWN);
        let angles: Vec<String> =
            shown.map(|(name, size)| format!("{} {:.1}", name.trim_end_matches("_r"), size.rms)).collect();
        let others = match degrees.len().saturating_sub(ANGLES_SHOWN) {
            0 => String::new(),
            others => format!(", {others} others less"),
        };
        print_line(&format!("  changed   {} deg rms{others}, by {count} parameters", angles.join(", ")))?;
        print_line(&format!("            pelvis {:.1} mm rms forwards, {:.1} mm up", path.forward.rms, path.up.rms))?;
    }
    let slip = match (walk.foot_slip_mm, walk.foot_slip_path_mm) {
        (Some(distance), Some(path)) => {
            format!("; stance feet slip {distance:.1} mm at most, along a path of {path:.1} mm")
        }
        _ => String::new(),
    };
    let held = match (&walk.lacking_force_n, &walk.lacking_moment_nm) {
        _ if walk.mode == SyntheticMode::Physical.name() => "outside   nothing but the ground acts".to_owned(),
        (Some(force), Some(moment)) if walk.mode == SyntheticMode::Optimal.name() => {
            format!("outside   {:.2} N and {:.2} N.m rms act on the pelvis", force.rms, moment.rms)
        }
        _ => {
            let Magnitude { rms, largest } = walk.trunk_torque_nm;
            format!("trunk     held upright with {rms:.1} N.m rms, {largest:.1} N.m peak")
        }
    };
    print_line(&format!("  {held}{slip}"))?;
    if walk.impacts > 0 {
        print_line(&format!("  impacts   {}, {:.1} N.s at most", walk.impacts, walk.largest_impact_n_s))?;
    }
    Ok(())
}

fn print_ground(summary: &Summary) -> Result<()> {
    let motion = filter(&summary.filter.motion);
    let Ground { source, ref rule, threshold_n, .. } = summary.ground;
    if source == GroundOrigin::None {
        return print_line(&format!("  filter    motion {motion}\n  ground    none"));
    }
    print_line(&format!("  filter    motion {motion}, forces {}", filter(&summary.filter.force)))?;
    let rule = rule.as_ref().filter(|_| matches!(source, GroundOrigin::Predicted | GroundOrigin::Mixed));
    let rule = rule.map_or(String::new(), |rule| format!(", {rule}"));
    print_line(&format!("  ground    {source}{rule} (a foot counts as unloaded below {threshold_n} N)"))?;
    print_shares(&summary.ground)
}

/// Prints the share of each leg's loaded time with measured load, if it is below 1.
fn print_shares(ground: &Ground) -> Result<()> {
    ground.shares().map_or(Ok(()), |shares| print_line(&format!("  loads     {shares}")))
}

/// Prints the passed checks of a prediction, and the failed checks with their values.
fn print_checks(checks: &[PredictionCheck]) -> Result<()> {
    let of = |passed: Option<bool>| checks.iter().filter(move |check| check.passed == passed);
    let names = |passed: Option<bool>| of(passed).map(|check| &*check.name).collect::<Vec<_>>().join(", ");
    let failure = |check: &PredictionCheck| {
        let unit = if check.unit == "1" { String::new() } else { format!(" {}", check.unit) };
        let allowed = match check.allowed {
            [low, high] if low.is_finite() && high.is_finite() => format!("{low:.3} to {high:.3}"),
            [low, _] if low.is_finite() => format!("at least {low:.3}"),
            [_, high] => format!("at most {high:.3}"),
        };
        format!("{} {:.3}{unit} (allowed {allowed})", check.name, check.value.unwrap_or(f64::NAN))
    };
    let failed: Vec<String> = of(Some(false)).map(failure).collect();
    let lines = [("passed", names(Some(true))), ("failed", failed.join(", ")), ("not judged", names(None))];
    let mut head = "checks";
    for (what, list) in lines.iter().filter(|(_, list)| !list.is_empty()) {
        print_line(&format!("  {head:<10}{what}: {list}"))?;
        head = "";
    }
    Ok(())
}

fn print_peaks(summary: &Summary) -> Result<()> {
    print_line("  peaks                               min          max")?;
    for peak in summary.peaks.iter().filter(|p| p.unit == ForceUnit::NewtonMetre) {
        print_line(&format!("    {:<28} {:>9.2}    {:>9.2} {}", peak.quantity, peak.min, peak.max, peak.unit))?;
    }
    Ok(())
}

fn filter(filter: &FilterSummary) -> String {
    match (filter.cutoff_hz, filter.order) {
        (Some(hz), Some(order)) => format!("{} {hz} Hz (order {order}, forwards and backwards)", filter.kind),
        _ => filter.kind.word().to_owned(),
    }
}
