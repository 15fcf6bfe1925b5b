//! The tables of the page.

use super::super::differences::{TimeChange, time_changes};
use super::super::{ComparedSession, Session};
use ambulo::model::Side;
use ambulo::numerics::rms;
use ambulo::study::session::{CycleForces, deviation, pooled, side_difference};
use ambulo::study::validation::{Section, TextTable, number};
use ambulo_results::{QuantitySummary, SpreadSummary};

const NAMES: [(&str, &str, usize); 16] = [
    ("speed", "Speed", 2),
    ("cadence", "Cadence", 0),
    ("stride_length", "Stride length", 2),
    ("step_length", "Step length", 2),
    ("step_width", "Step width", 2),
    ("cycle_time", "Cycle time", 2),
    ("step_time", "Step time", 2),
    ("stance_time", "Stance time", 2),
    ("swing_time", "Swing time", 2),
    ("stance", "Stance", 1),
    ("swing", "Swing", 1),
    ("single_support", "Single support", 1),
    ("double_support", "Double support", 1),
    ("initial_double_support", "Initial double support", 1),
    ("terminal_double_support", "Terminal double support", 1),
    ("walk_ratio", "Walk ratio", 4),
];

/// Name and digits of a time or distance in tables.
pub(super) fn name(quantity: &str) -> (&'static str, usize) {
    NAMES.iter().find(|(id, ..)| *id == quantity).map_or(("", 2), |(_, name, digits)| (name, *digits))
}

/// `1.20 ± 0.04 (6)`
fn spread(mean: f64, sd: Option<f64>, n: usize, digits: usize) -> String {
    let sd = sd.map_or(String::new(), |sd| format!(" ± {sd:.digits$}"));
    format!("{mean:.digits$}{sd} ({n})")
}

pub(super) fn times(compared: &ComparedSession) -> Section {
    let ComparedSession { session, norms, .. } = compared;
    let mut table = TextTable::new(&["", "unit", "right", "left", "both", "normal", "symmetry %"]);
    if let Some(speed) = session.summary.speed_m_s {
        let both = spread(speed.mean, speed.sd, speed.n, 2);
        table.row(["Speed", "m/s", "", "", both.as_str(), "", ""].map(str::to_owned));
    }
    for found in &session.summary.times_and_distances.quantities {
        let (name, digits) = name(&found.quantity);
        let cell = |spread_of: &Option<SpreadSummary>| {
            spread_of.map_or(String::new(), |found| spread(found.mean, found.sd, found.strides, digits))
        };
        let normal = norms.time(&found.quantity).map_or(String::new(), |normal| match (normal.range, normal.mean) {
            (Some([low, high]), _) => format!("{low:.digits$} to {high:.digits$}"),
            (None, Some(mean)) => format!("about {mean:.digits$}"),
            (None, None) => String::new(),
        });
        let symmetry = found.symmetry.map_or(String::new(), |index| format!("{:+.0}", 100.0 * index));
        table.row([
            name.to_owned(),
            found.unit.clone(),
            cell(&found.right),
            cell(&found.left),
            cell(&found.both),
            normal,
            symmetry,
        ]);
    }
    let note = "Mean ± standard deviation, and the number of strides (of the speed: of trials). Normal: mean ± 2 \
        standard deviations of the reference \
                group, where they are known. Symmetry: right minus left, relative to their mean.";
    Section { title: "Times and distances", table, note: note.to_owned() }
}

pub(super) fn knee_adduction(session: &Session) -> Section {
    let note = "External moment in stance, mean ± standard deviation, and the number of cycles: the largest values in \
        the first and in the second half, and the area of the positive part. Sides whose forces have different \
        sources are neither pooled nor compared.";
    over_stances("Knee adduction moment", &session.summary.knee_adduction_moment, note)
}

pub(super) fn contact_loads(session: &Session) -> Section {
    let note = "Size of the force in hip, knee and ankle with the forces of the muscles, and what each condyle of the \
        knee carries along the shank: the largest values in the first and in the second half of stance, and the area \
        below the curve, as mean ± standard deviation, and the number of cycles. These are estimates of the model, \
        not measured loads (docs/MUSCLES.md). Sides whose forces have different sources are neither pooled nor \
        compared.";
    over_stances("Joint contact loads", &session.summary.contact_loads, note)
}

/// Loads over the stances of both sides.
fn over_stances(title: &'static str, quantities: &[QuantitySummary], note: &str) -> Section {
    let mut table = TextTable::new(&["", "unit", "right", "left", "both", "symmetry %", "forces"]);
    for found in quantities {
        let cell = |spread_of: &Option<SpreadSummary>| {
            spread_of.map_or(String::new(), |found| spread(found.mean, found.sd, found.strides, 2))
        };
        let [right, left, both] = [&found.right, &found.left, &found.both].map(cell);
        let symmetry = found.symmetry.map_or(String::new(), |index| format!("{:+.0}", 100.0 * index));
        let name = found.quantity.replace('_', " ");
        table.row([name, found.unit.clone(), right, left, both, symmetry, found.source_words()]);
    }
    Section { title, table, note: note.to_owned() }
}

pub(super) fn deviations(compared: &ComparedSession) -> Section {
    let mut table = TextTable::new(&[
        "",
        "side",
        "unit",
        "forces",
        "cycles",
        "distance",
        "expected",
        "largest",
        "in SD",
        "at %",
        "outside %",
    ]);
    for quantity in compared.shown() {
        for side in Side::BOTH {
            let Some(found) = pooled(&compared.session.cycles, quantity.id, side) else { continue };
            let Some(norm) = compared.norm(quantity.id) else { continue };
            let Some(away) = deviation(&found.statistics.mean, norm) else { continue };
            let words = quantity.wording();
            let digits = if words.unit == "deg" { 1 } else { 2 };
            let direction = words.directions[usize::from(away.largest < 0.0)];
            table.row([
                quantity.label(),
                side.to_string(),
                words.unit.to_owned(),
                found.forces.map_or("", CycleForces::word).to_owned(),
                found.statistics.count.to_string(),
                number(away.rms, digits),
                number(away.expected_rms, digits),
                format!("{} {direction}", number(away.largest.abs(), digits)),
                number(away.largest_sd.abs(), 1),
                number(away.at_percent, 0),
                number(100.0 * away.outside, 0),
            ]);
        }
    }
    let note = "Mean of the cycles against the mean of the reference group. Distance: root mean square over the cycle. \
        Expected: that of a person of the \
                group. Largest: the difference that is largest in standard deviations of the group, with its \
                direction; 0 % is the foot strike. Outside: \
                share of the cycle more than two standard deviations away.";
    Section { title: "Deviation from the reference group", table, note: note.to_owned() }
}

pub(super) fn sides(compared: &ComparedSession) -> Section {
    let mut table =
        TextTable::new(&["", "unit", "forces", "right - left", "between cycles, right", "between cycles, left"]);
    for quantity in compared.shown() {
        let [right, left] = Side::BOTH.map(|side| pooled(&compared.session.cycles, quantity.id, side));
        let Some(difference) = side_difference(right.as_ref(), left.as_ref()) else { continue };
        let unit = quantity.wording().unit;
        let digits = if unit == "deg" { 1 } else { 2 };
        let between = [&right, &left].map(|side| side.as_ref().and_then(|found| found.statistics.spread()));
        let [of_right, of_left] = between.map(|sd| number(sd.unwrap_or(f64::NAN), digits));
        let forces = right.as_ref().and_then(|found| found.forces).map_or("", CycleForces::word).to_owned();
        table.row([quantity.label(), unit.to_owned(), forces, number(difference, digits), of_right, of_left]);
    }
    let note = "Root mean square difference of the mean curves of both sides, and the standard deviation between the \
        cycles of each side. A difference that \
                is not larger than the variation between cycles is no asymmetry. Sides whose forces have different \
                sources are not compared.";
    Section { title: "Left against right", table, note: note.to_owned() }
}

pub(super) fn time_differences(after: &Session, before: &Session) -> Section {
    let mut table = TextTable::new(&["", "unit", "side", "before", "after", "change", "how sure"]);
    for row in time_changes(after, before) {
        let sure = row.certainty().words().to_owned();
        let TimeChange { quantity, unit, side, before, after } = row;
        let (name, digits) = name(&quantity);
        let cell = |[mean, sd, n]: [f64; 3]| spread(mean, Some(sd).filter(|sd| sd.is_finite()), n as usize, digits);
        let side = match side {
            "r" => "right",
            "l" => "left",
            both => both,
        };
        let change = after[0] - before[0];
        let change = format!("{change:+.digits$}");
        table.row([name.to_owned(), unit, side.to_owned(), cell(before), cell(after), change, sure]);
    }
    Section { title: "Changes of times and distances", table, note: String::new() }
}

pub(super) fn curve_differences(compared: &ComparedSession) -> Section {
    let mut table = TextTable::new(&[
        "", "side", "unit", "forces", "cycles", "change", "largest", "at %", "offset", "beyond", "how sure",
    ]);
    let shown = compared.shown();
    for change in compared.changes.iter().filter(|change| shown.contains(&change.quantity)) {
        let unit = change.quantity.wording().unit;
        let digits = if unit == "deg" { 1 } else { 2 };
        table.row([
            change.quantity.label(),
            change.side.to_string(),
            unit.to_owned(),
            change.forces.map_or("", CycleForces::word).to_owned(),
            format!("{} / {}", change.cycles[0], change.cycles[1]),
            number(rms(&change.found.change), digits),
            format!("{:+.digits$}", change.largest()),
            number(change.at_percent(), 0),
            format!("{:+.digits$}", change.found.offset),
            number(rms(&change.found.beyond), digits),
            change.found.certainty.words().to_owned(),
        ]);
    }
    let missing = match shown.len() * 2 - table.rows().len() {
        0 => "",
        _ => " Curves that only one session has, or whose forces have another source than before, are left out.",
    };
    let note = format!(
        "After minus before. Change: root mean square over the cycle. Offset: the constant part that markers in \
         another \
         place explain. Beyond: root mean square of the rest. A change is clear if, in more than a tenth of the cycle, \
         the rest is larger than two standard deviations of the difference of the means and than the least change that \
         counts (docs/SESSION.md). Nothing is known of the variation between days.{missing}"
    );
    Section { title: "Changes of all curves", table, note }
}
