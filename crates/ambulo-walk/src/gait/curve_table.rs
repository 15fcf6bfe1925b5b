//! Reads curves from TOML: `[[knee.knot]]` and `[[knee.sub_cycle]]`, in built-in files and files of users.
//!
//! Numbers are constants or polynomials of dimensionless speed, `[c0, c1, c2]`; times in percent of the cycle, angles
//! in degrees, slopes in degrees per cycle, curvatures in degrees per cycle². docs/GAITS.md describes the keys.

use super::curve_check::{check, check_senses};
use super::cyclic_curve::{CyclicCurve, Knot};
use super::gait_settings::Style;
use super::joint::LegJoint;
use super::speed_law::SpeedLaw;
use crate::toml_reader::{Place, Table, TomlError, Value};

/// Two ends of sub-cycles are equal if they differ by less than this [cycles, rad].
const SAME: f64 = 1e-9;
const DEGREE: f64 = std::f64::consts::PI / 180.0;
const PERCENT: f64 = 0.01;

/// The curve of a joint, if the file has one, checked at these dimensionless speeds.
pub(super) fn read_curve(
    root: &Table<'_>,
    joint: LegJoint,
    style: Style,
    speeds: &[f64],
) -> Result<Option<CyclicCurve>, TomlError> {
    let Some(value) = root.get(joint.name()) else { return Ok(None) };
    let (wanted, other) = match style {
        Style::Knots => ("knot", "sub_cycle"),
        Style::Paper1997 => ("sub_cycle", "knot"),
    };
    let table = value.table(&format!("tables, each under a header [[{}.{wanted}]]", joint.name()))?;
    if let Some(value) = table.get(other) {
        let message = format!("found `{other}` in a gait of style \"{}\"; expected `{wanted}`", style.name());
        let advice = "style \"1997\" has sub-cycles, style \"knots\" has knots";
        return Err(value.place().error(message).hint(advice));
    }
    table.only(&[&[wanted]])?;
    let entries = table.tables(wanted)?;
    let places: Vec<Place> = entries.iter().map(Table::place).collect();
    let knots = match style {
        Style::Knots => entries.iter().map(knot).collect::<Result<Vec<Knot>, TomlError>>()?,
        Style::Paper1997 => sub_cycles(&entries)?,
    };
    let few = || table.wrong(format!("found fewer than two of `{wanted}`; expected two or more"));
    let curve = CyclicCurve::new(knots).ok_or_else(few)?;
    let mut checked = check(&curve, joint, speeds);
    if style == Style::Paper1997 {
        checked = checked.and_then(|()| check_senses(&curve, speeds));
    }
    checked.map_err(|fault| places[fault.knot].error(fault.message))?;
    Ok(Some(curve))
}

/// A curve of `knot` tables whose angles at constant speed stay within limits [rad].
pub(super) fn read_knots(table: &Table<'_>, [low, high]: [f64; 2]) -> Result<CyclicCurve, TomlError> {
    let entries = table.tables("knot")?;
    let knots = entries.iter().map(knot).collect::<Result<Vec<Knot>, TomlError>>()?;
    let count = knots.len();
    let Some(curve) = CyclicCurve::new(knots) else {
        return Err(table.wrong(format!("found {count} of `knot`; expected two or more")));
    };
    for (k, entry) in entries.iter().enumerate() {
        let width = curve.knot_phase(k + 1, MIDDLE) - curve.knot_phase(k, MIDDLE);
        if width < LEAST_WIDTH {
            return Err(entry.wrong(
                "found a knot less than 0.5 % of the cycle before the next one; expected knots in \
                the order of their times, within one cycle",
            ));
        }
        let angle = curve.knots()[k].angle.at(MIDDLE);
        if !(low..=high).contains(&angle) {
            let (found, low, high) = (angle / DEGREE, low / DEGREE, high / DEGREE);
            return Err(entry.wrong(format!("found {found:.1}°; expected angles from {low:.0}° to {high:.0}°")));
        }
    }
    Ok(curve)
}

/// Least distance between knots [cycles].
const LEAST_WIDTH: f64 = 0.005;

fn knot(table: &Table<'_>) -> Result<Knot, TomlError> {
    table.only(&[&["name", "begins", "at_percent", "angle_deg", "slope_deg", "curvature_deg", "height_share"]])?;
    let begins = table.get("begins").map(|value| value.filled_text()).transpose()?;
    Ok(Knot {
        name: table.need("name", "the name of the knot")?.filled_text()?,
        begins,
        phase: law(table, "at_percent", "the time of the knot in percent of the cycle")?.scaled(PERCENT),
        angle: law(table, "angle_deg", "the angle at the knot")?.scaled(DEGREE),
        slope: law(table, "slope_deg", "the slope at the knot in degrees per cycle")?.scaled(DEGREE),
        curvature: law(table, "curvature_deg", "the curvature at the knot in degrees per cycle²")?.scaled(DEGREE),
        height_share: height_share(table)?,
    })
}

fn height_share(table: &Table<'_>) -> Result<f64, TomlError> {
    let share = table.number_or("height_share", 0.0)?;
    match table.get("height_share") {
        Some(value) if !(0.0..=1.0).contains(&share) => Err(value.wrong("a share from 0 to 1")),
        _ => Ok(share),
    }
}

/// A number, or a polynomial of dimensionless speed.
fn law(table: &Table<'_>, key: &str, meaning: &str) -> Result<SpeedLaw, TomlError> {
    law_of(&table.need(key, meaning)?)
}

pub(super) fn law_of(value: &Value<'_>) -> Result<SpeedLaw, TomlError> {
    const EXPECTED: &str = "a number, or a law [c0, c1, c2] of dimensionless speed with one to three numbers";
    let Ok(list) = value.list(EXPECTED) else { return Ok(SpeedLaw::constant(value.finite(EXPECTED)?)) };
    let mut coefficients = [0.0; 3];
    if list.is_empty() || list.len() > coefficients.len() {
        return Err(value.wrong(EXPECTED));
    }
    for (coefficient, number) in coefficients.iter_mut().zip(&list) {
        *coefficient = number.number()?;
    }
    Ok(SpeedLaw { coefficients })
}

/// A sub-cycle in the file.
struct Span {
    name: String,
    end: Option<String>,
    /// Start and end [cycles].
    from: SpeedLaw,
    to: SpeedLaw,
    /// Angles at start and end [rad].
    from_angle: SpeedLaw,
    to_angle: SpeedLaw,
    height_share: f64,
}

fn span(table: &Table<'_>) -> Result<Span, TomlError> {
    table.only(&[&["name", "end", "from_percent", "to_percent", "from_deg", "to_deg", "height_share"]])?;
    let linear = |key: &str, meaning: &str| {
        let value = table.need(key, meaning)?;
        let law = law_of(&value)?;
        let expected = "a number, or a linear law [c0, c1] of dimensionless speed, because the style is \"1997\"";
        if law.is_linear() { Ok(law) } else { Err(value.wrong(expected)) }
    };
    Ok(Span {
        name: table.need("name", "the name of the sub-cycle")?.filled_text()?,
        end: table.get("end").map(|value| value.filled_text()).transpose()?,
        from: linear("from_percent", "the start of the sub-cycle in percent of the cycle")?.scaled(PERCENT),
        to: linear("to_percent", "the end of the sub-cycle in percent of the cycle")?.scaled(PERCENT),
        from_angle: linear("from_deg", "the angle at its start")?.scaled(DEGREE),
        to_angle: linear("to_deg", "the angle at its end")?.scaled(DEGREE),
        height_share: height_share(table)?,
    })
}

/// Knots at the starts of sub-cycles that cover the cycle without gaps.
fn sub_cycles(tables: &[Table<'_>]) -> Result<Vec<Knot>, TomlError> {
    let spans = tables.iter().map(span).collect::<Result<Vec<Span>, TomlError>>()?;
    let mut knots: Vec<Knot> = Vec::new();
    // Whole cycles to add where the times in the file start again from 0 %.
    let mut laps = 0.0;
    for (k, here) in spans.iter().enumerate() {
        let before = &spans[(k + spans.len() - 1) % spans.len()];
        follows(before, here).map_err(|message| tables[k].wrong(message))?;
        if knots.last().is_some_and(|last| here.from.at(MIDDLE) + laps < last.phase.at(MIDDLE)) {
            laps += 1.0;
        }
        knots.push(Knot {
            name: before.end.clone().unwrap_or_else(|| format!("end of {}", before.name)),
            begins: Some(here.name.clone()),
            phase: here.from.plus(laps),
            angle: here.from_angle,
            slope: SpeedLaw::default(),
            curvature: SpeedLaw::default(),
            height_share: before.height_share,
        });
    }
    Ok(knots)
}

/// A speed in the middle of the range on which laws are fitted.
const MIDDLE: f64 = 0.43;

/// Checks that a sub-cycle starts at the time and angle at which the previous one ends.
fn follows(before: &Span, here: &Span) -> Result<(), String> {
    let differ = |a: &SpeedLaw, b: &SpeedLaw| (0..3).any(|i| (a.coefficients[i] - b.coefficients[i]).abs() > SAME);
    let gap = here.from.at(MIDDLE) - before.to.at(MIDDLE);
    let whole = gap.round();
    if differ(&here.from, &before.to.plus(whole)) {
        let gap = 100.0 * (gap - whole);
        let kind = if gap < 0.0 { "overlaps" } else { "leaves a gap after" };
        return Err(format!(
            "sub-cycle {} {kind} sub-cycle {} (by {:.1} % of the cycle at free speed); expected `from_percent` to be \
             equal to \
             `to_percent` of the previous one",
            here.name,
            before.name,
            gap.abs()
        ));
    }
    if differ(&here.from_angle, &before.to_angle) {
        return Err(format!(
            "sub-cycle {} starts at another angle than the end of sub-cycle {}; expected `from_deg` to be equal to \
             `to_deg` of the previous one",
            here.name, before.name
        ));
    }
    Ok(())
}
