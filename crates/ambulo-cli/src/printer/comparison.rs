//! Prints the comparison of predicted with measured ground forces.

use super::print_line;
use ambulo::analysis::{CenterAgreement, EventAgreement, FootAgreement, GroundAgreement, MomentAgreement};
use anyhow::Result;

pub(super) fn print(comparison: &GroundAgreement) -> Result<()> {
    let window =
        comparison.window_s.map_or(String::new(), |[from, to]| format!("; instrumented window {from:.3} to {to:.3} s"));
    print_line(&format!("  compared with plates, {:.2} kg{window}", comparison.mass_kg))?;
    if !comparison.feet.is_empty() {
        print_line("    ground force          RMSE %BW   rRMSE %        r   in 90 % band %   half-width/RMSE")?;
    }
    for foot in &comparison.feet {
        print_foot(foot)?;
    }
    if !comparison.feet.is_empty() {
        print_line("    centre of pressure    fore-aft mm   weighted   lateral mm   weighted")?;
    }
    for foot in &comparison.feet {
        print_line(&format!("      {}", center(foot)))?;
    }
    if !comparison.moments.is_empty() {
        print_line("    joint moment                  RMSE N.m/kg        N.m        r")?;
    }
    comparison.moments.iter().try_for_each(|moment| print_line(&format!("      {}", self::moment(moment))))?;
    comparison
        .events
        .iter()
        .filter(|e| e.pairs + e.missed > 0)
        .try_for_each(|e| print_line(&format!("    {}", events(e))))
}

/// Prints how the vertical forces agree, on one line.
pub(super) fn print_vertical(comparison: &GroundAgreement) -> Result<()> {
    let foot = |foot: &FootAgreement| {
        format!(
            "{} {:.1} % of body weight (r {})",
            foot.side,
            100.0 * foot.vertical.rmse_bw,
            correlation(foot.vertical.r)
        )
    };
    let feet: Vec<String> = comparison.feet.iter().map(foot).collect();
    match feet.is_empty() {
        true => Ok(()),
        false => print_line(&format!("  plates    vertical force differs by {} rms", feet.join(", "))),
    }
}

fn print_foot(foot: &FootAgreement) -> Result<()> {
    let components = [("vertical", foot.vertical), ("fore-aft", foot.fore_aft), ("lateral", foot.lateral)];
    for (name, force) in components {
        print_line(&format!(
            "      {:<6}{:<12}{:>10.2}{:>10.1}{:>9}{:>18.1}{:>18.2}",
            foot.side.to_string(),
            name,
            100.0 * force.rmse_bw,
            100.0 * force.rrmse,
            correlation(force.r),
            100.0 * force.band.holds,
            force.band.half_width_over_rmse
        ))?;
    }
    Ok(())
}

fn center(foot: &FootAgreement) -> String {
    let CenterAgreement { fore_aft_mm, lateral_mm, fore_aft_weighted_mm, lateral_weighted_mm, missing, samples } =
        foot.center_of_pressure;
    let gap =
        if missing > 0 { format!("   missing in {missing} of {} samples", missing + samples) } else { String::new() };
    format!(
        "{:<18}{fore_aft_mm:>13.1}{fore_aft_weighted_mm:>11.1}{lateral_mm:>13.1}{lateral_weighted_mm:>11.1}{gap}",
        foot.side.to_string()
    )
}

fn moment(moment: &MomentAgreement) -> String {
    let MomentAgreement { quantity, rmse_nm, rmse_nm_kg, r, .. } = moment;
    format!("{quantity:<26}{rmse_nm_kg:>13.3}{rmse_nm:>11.1}{:>9}", correlation(*r))
}

fn events(agreement: &EventAgreement) -> String {
    let EventAgreement { kind, pairs, missed, extra, mean_absolute_ms, bias_ms } = agreement;
    if *pairs == 0 {
        return format!("{kind}: none matched, {missed} missed");
    }
    let direction = if *bias_ms < 0.0 { "early" } else { "late" };
    format!(
        "{kind}: {pairs} matched, {mean_absolute_ms:.1} ms apart, {:.1} ms {direction} on average; {missed} missed, \
         {extra} extra",
        bias_ms.abs()
    )
}

fn correlation(r: f64) -> String {
    if r.is_finite() { format!("{r:.3}") } else { "-".to_owned() }
}
