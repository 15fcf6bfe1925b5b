//! Prints the outcome of residual reduction.

use super::print_line;
use ambulo::dynamics::residual_reduction::RootResidual;
use ambulo::numerics::Order;
use ambulo_results::{ChangeUnit, ConsistencySummary, CoordinateSize};
use anyhow::Result;

/// Coordinates printed per unit: those that changed most.
const SHOWN: usize = 4;

/// Prints the residuals before and after, and the changes.
pub(super) fn print(summary: &ConsistencySummary) -> Result<()> {
    let [from, to] = summary.window_s;
    print_line(&format!("  residual reduction, {from:.3} to {to:.3} s              rms            peak"))?;
    for (when, residual) in [("before", &summary.residual_before), ("after", &summary.residual_after)] {
        print_line(&residual_line(when, residual))?;
    }
    print_line("    changed                           rms          largest")?;
    for unit in [ChangeUnit::Degree, ChangeUnit::Millimetre] {
        for (name, size) in largest(summary, unit) {
            print_line(&format!("    {name:<28} {:>8.2} {:>16.2} {unit}", size.rms, size.max))?;
        }
    }
    for (body, size) in &summary.feet_mm {
        print_line(&format!("    {body:<28} {:>8.2} {:>16.2} mm", size.rms, size.max))?;
    }
    let [x, y, z] = summary.trunk_center_mm;
    if summary.mass_percent.abs() + x.abs() + y.abs() + z.abs() > 0.0 {
        print_line(&format!(
            "    mass {:+.2} %, mass centre of `{}` {x:+.1} {y:+.1} {z:+.1} mm; subject.osim is the changed body",
            summary.mass_percent, summary.trunk
        ))?;
    }
    Ok(())
}

fn residual_line(when: &str, residual: &RootResidual) -> String {
    format!(
        "    residual {when:<8} {:>8.2} %BW {:>7.2} N.m {:>8.2} %BW {:>7.2} N.m",
        100.0 * residual.force_rms_bw,
        residual.moment_rms_nm,
        100.0 * residual.force_peak_bw,
        residual.moment_peak_nm
    )
}

/// Coordinates in this unit, the largest change first.
fn largest(summary: &ConsistencySummary, unit: ChangeUnit) -> Vec<(&String, &CoordinateSize)> {
    let mut list: Vec<_> = summary.changes.iter().filter(|(_, size)| size.unit == unit).collect();
    list.sort_by_number(|(_, change)| -change.max);
    list.truncate(SHOWN);
    list
}
