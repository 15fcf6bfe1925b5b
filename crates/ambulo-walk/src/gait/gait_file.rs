//! Reads gaits from TOML (docs/GAITS.md). Errors contain line and key.

use super::curve_check::check;
use super::curve_table::read_curve;
use super::error::GaitError;
use super::gait_settings::{Gait, JointChange, KnotChange, Pace, Pelvis, Speed, Style};
use super::joint::{LegJoint, WalkPart};
use super::laws::{DOCUMENT, Laws, checked_speeds};
use super::machine::{ReadColumn, read_machines};
use super::pace::{AGREEMENT, CADENCE, FACTOR, Range, SPEED, STEP_LENGTH};
use super::pace_plan::PaceChange;
use super::walk::changed;
use crate::toml_reader::{Source, Table, TomlError, Value, nearest};

/// Keys at the top level of the file.
const KEYS: [&str; 20] = [
    "name",
    "base",
    "style",
    "pelvis",
    "speed",
    "dimensionless_speed",
    "step_length",
    "cadence",
    "cycle_s",
    "step_length_scale",
    "cadence_scale",
    "step_height",
    "cadence_exponent",
    "change",
    "pace_change",
    "joint",
    "machine",
    "hip",
    "knee",
    "ankle",
];
const DEGREE: f64 = std::f64::consts::PI / 180.0;

impl Gait {
    /// A gait from a TOML file whose machines do not follow recordings.
    ///
    /// # Errors
    /// Anything that differs from docs/GAITS.md, with line and key.
    pub fn from_toml(text: &str) -> Result<Gait, GaitError> {
        Gait::from_toml_with(text, &mut |file, _| Err(format!("{file}: found a recording; expected none here")))
    }

    /// A gait from a TOML file; `load` reads the recordings that its machines follow.
    ///
    /// # Errors
    /// Anything that differs from docs/GAITS.md, with line and key.
    pub fn from_toml_with(text: &str, load: &mut ReadColumn<'_>) -> Result<Gait, GaitError> {
        let source = Source::new(text, DOCUMENT);
        let parsed = source.parse()?;
        let root = Table::root(&source, &parsed);
        root.only(&[&KEYS])?;
        let mut gait = base(&root)?;
        if let Some(value) = root.get("name") {
            gait.name = value.filled_text()?;
        }
        gait.pace = pace(&root, gait.pace)?;
        gait.step_height = scale_or(&root, "step_height", gait.step_height)?;
        let laws = Laws::built_in(gait.style)?;
        let speeds = checked_speeds(&laws.range);
        for (own, joint) in gait.curves.iter_mut().zip(LegJoint::ALL) {
            *own = read_curve(&root, joint, gait.style, &speeds)?;
        }
        read_changes(&root, &mut gait, &laws)?;
        gait.pace_changes = root.tables("pace_change")?.iter().map(PaceChange::read).collect::<Result<_, _>>()?;
        for table in root.tables("joint")? {
            gait.joints.extend(read_joint(&table)?);
        }
        gait.machines = read_machines(&root, &gait, load)?;
        if let (Some(value), Some(change)) = (root.get("pace_change"), gait.machine_of_the_pace()) {
            let message =
                format!("found changes of pace; expected none, because the machine `{}` drives the pace", change.name);
            return Err(value.place().error(message).into());
        }
        Ok(gait)
    }
}

impl PaceChange {
    /// Reads `at`, `within`, `speed`, `step_length` and `cadence` of a table.
    pub(crate) fn read(table: &Table<'_>) -> Result<PaceChange, TomlError> {
        table.only(&[&["at", "within", "speed", "step_length", "cadence"]])?;
        let start_s = table.need("at", "the time at which the change begins [s]")?.zero_or_more()?;
        PaceChange::read_values(table, start_s)
    }

    /// Reads a change of pace from a table without `at`.
    pub(super) fn read_values(table: &Table<'_>, start_s: f64) -> Result<PaceChange, TomlError> {
        let speed = table.get("speed").map(|value| value.zero_or_more()).transpose()?;
        let step_length = table.get("step_length").map(|value| value.above_zero()).transpose()?;
        let cadence = table.get("cadence").map(|value| value.above_zero()).transpose()?;
        if (speed, step_length, cadence) == (None, None, None) {
            return Err(table.wrong("found no speed, step_length or cadence; expected at least one of them"));
        }
        Ok(PaceChange {
            start_s,
            duration_s: table.get("within").map(|value| value.above_zero()).transpose()?,
            speed,
            step_length,
            step_frequency: cadence.map(|steps_per_minute| steps_per_minute / 60.0),
        })
    }
}

/// The gait to start from: a built-in gait, or free walking in a style.
fn base(root: &Table<'_>) -> Result<Gait, GaitError> {
    let style = root.get("style").map(|value| value.choice(&Style::WORDS)).transpose()?;
    let mut gait = match root.get("base") {
        Some(value) => {
            let words = Gait::NAMES.map(|name| (name, name));
            Gait::named(value.choice(&words)?)?
        }
        None => Gait::new("own", style.unwrap_or(Style::Knots)),
    };
    if let Some(style) = style {
        gait.style = style;
        gait.pelvis = style.pelvis();
    }
    if let Some(value) = root.get("pelvis") {
        gait.pelvis = value.choice(&[("moving", Pelvis::Moving), ("vertical", Pelvis::Vertical)])?;
    }
    Ok(gait)
}

/// The pace. Speed, step length and frequency of the base are used only if the file gives none of them.
fn pace(root: &Table<'_>, base: Pace) -> Result<Pace, TomlError> {
    let speed = one_of(root, "speed", "dimensionless_speed")?;
    let frequency = one_of(root, "cadence", "cycle_s")?;
    let length_scale = scale_or(root, "step_length_scale", base.length_scale)?;
    let cadence_scale = scale_or(root, "cadence_scale", base.cadence_scale)?;
    let mut pace = Pace { length_scale, cadence_scale, ..base };
    if speed.is_some() || frequency.is_some() || root.get("step_length").is_some() {
        pace.speed = match root.get("dimensionless_speed") {
            Some(value) => Some(Speed::Dimensionless(value.above_zero()?)),
            None => within(root, "speed", &SPEED, length_scale * cadence_scale)?.map(Speed::MetersPerSecond),
        };
        pace.step_length = within(root, "step_length", &STEP_LENGTH, length_scale)?;
        pace.step_frequency = match root.get("cycle_s") {
            Some(value) => Some(2.0 / cycle_s(&value, cadence_scale)?),
            None => within(root, "cadence", &CADENCE, cadence_scale)?.map(|steps_per_minute| steps_per_minute / 60.0),
        };
        refuse_contradiction(root, &pace)?;
    }
    if let Some(value) = root.get("cadence_exponent") {
        let exponent = value.number()?;
        if !(0.0..1.0).contains(&exponent) {
            return Err(value.wrong("an exponent from 0 to below 1"));
        }
        pace.cadence_exponent = Some(exponent);
    }
    Ok(pace)
}

/// The number of a key; times its factor it must be in the range. A figure with a speed of 0 stands until the first
/// change of pace.
fn within(root: &Table<'_>, key: &str, range: &Range, factor: f64) -> Result<Option<f64>, TomlError> {
    let Some(value) = root.get(key) else { return Ok(None) };
    if key == "speed" && root.get("pace_change").is_some() && value.number()? == 0.0 {
        return Ok(Some(0.0));
    }
    let number = value.above_zero()?;
    if range.contains(number * factor) { Ok(Some(number)) } else { Err(value.wrong(range.expected)) }
}

/// The duration of a cycle [s], whose cadence must be in the range.
fn cycle_s(value: &Value<'_>, cadence_scale: f64) -> Result<f64, TomlError> {
    let duration_s = value.above_zero()?;
    if CADENCE.contains(120.0 / duration_s * cadence_scale) {
        Ok(duration_s)
    } else {
        Err(value.wrong(&format!("a cycle of two steps with {}", CADENCE.expected)))
    }
}

/// The value of one of two keys; an error if both are present.
fn one_of<'t>(root: &Table<'t>, first: &str, second: &str) -> Result<Option<Value<'t>>, TomlError> {
    match (root.get(first), root.get(second)) {
        (Some(_), Some(value)) => {
            Err(value.place().error(format!("found both `{first}` and `{second}`; expected one of them")))
        }
        (found, other) => Ok(found.or(other)),
    }
}

fn refuse_contradiction(root: &Table<'_>, pace: &Pace) -> Result<(), TomlError> {
    let (Some(Speed::MetersPerSecond(speed)), Some(step), Some(frequency)) =
        (pace.speed, pace.step_length, pace.step_frequency)
    else {
        return Ok(());
    };
    let made = step * frequency;
    match root.get("speed") {
        Some(value) if (made - speed).abs() > AGREEMENT * speed => Err(value
            .wrong(&format!("the step length times the step frequency, {made:.4} m/s"))
            .hint("leave out one of speed, step length and frequency")),
        _ => Ok(()),
    }
}

fn scale_or(root: &Table<'_>, key: &str, default: f64) -> Result<f64, TomlError> {
    let Some(value) = root.get(key) else { return Ok(default) };
    let factor = value.above_zero()?;
    if FACTOR.contains(factor) { Ok(factor) } else { Err(value.wrong(FACTOR.expected)) }
}

/// Adds the changes of the file to the changes of the base.
fn read_changes(root: &Table<'_>, gait: &mut Gait, laws: &Laws) -> Result<(), GaitError> {
    let tables = root.tables("change")?;
    let mut last = [None; 3];
    for table in &tables {
        let (change, index) = read_change(table, gait, laws)?;
        gait.changes.push(change);
        last[index] = Some(table);
    }
    for (joint, table) in LegJoint::ALL.into_iter().zip(last) {
        let Some(table) = table else { continue };
        let curve = changed(curve_of(gait, laws, joint), joint, &gait.changes)?;
        check(&curve, joint, &checked_speeds(&laws.range)).map_err(|fault| {
            let knot = &curve.knots()[fault.knot].name;
            table.wrong(format!("with all changes, at knot `{knot}`: {}", fault.message))
        })?;
    }
    Ok(())
}

/// The changes of a `[[joint]]`: one for each side unless the name states one.
fn read_joint(table: &Table<'_>) -> Result<Vec<JointChange>, TomlError> {
    table.only(&[&["joint", "scale", "angle_deg"]])?;
    let value = table.need("joint", "the joint that changes")?;
    let name = value.filled_text()?;
    let parts = WalkPart::of_name(&name);
    if parts.is_empty() {
        let both = ["hip", "knee", "ankle", "shoulder", "elbow"];
        let names = || both.into_iter().chain(WalkPart::ALL.iter().map(|part| part.name()));
        let error = value
            .wrong(&format!("one of {}", names().map(|name| format!("\"{name}\"")).collect::<Vec<_>>().join(", ")));
        return Err(match nearest(&name, names()) {
            Some(near) => error.hint(&format!("did you mean \"{near}\"?")),
            None => error,
        });
    }
    let bounded = |key: &str, default: f64, [low, high]: [f64; 2]| match table.get(key) {
        Some(value) => match value.number()? {
            number if (low..=high).contains(&number) => Ok(number),
            _ => Err(value.wrong(&format!("a number from {low} to {high}"))),
        },
        None => Ok(default),
    };
    let (scale, angle) = (bounded("scale", 1.0, [-10.0, 10.0])?, bounded("angle_deg", 0.0, [-180.0, 180.0])? * DEGREE);
    Ok(parts.into_iter().map(|part| JointChange { part, scale, angle }).collect())
}

fn curve_of<'a>(gait: &'a Gait, laws: &'a Laws, joint: LegJoint) -> &'a super::CyclicCurve {
    gait.curves[joint as usize].as_ref().unwrap_or_else(|| laws.legs.of(joint))
}

/// A change and the number of its joint.
fn read_change(table: &Table<'_>, gait: &Gait, laws: &Laws) -> Result<(KnotChange, usize), TomlError> {
    table.only(&[&["joint", "knot", "scale", "angle_deg", "slope_deg", "curvature_deg", "time_percent"]])?;
    let words = LegJoint::ALL.map(|joint| (joint.name(), joint));
    let joint = table.need("joint", "the joint that changes")?.choice(&words)?;
    let value = table.need("knot", "the knot that changes")?;
    let knot = value.text()?;
    let known = || curve_of(gait, laws, joint).knots().iter().map(|knot| knot.name.as_str());
    if !known().any(|name| name == knot) {
        let quoted: Vec<String> = known().map(|name| format!("\"{name}\"")).collect();
        let error = value.wrong(&format!("one of the {}'s knots {}", joint.name(), quoted.join(", ")));
        return Err(match nearest(knot, known()) {
            Some(near) => error.hint(&format!("did you mean \"{near}\"?")),
            None => error,
        });
    }
    if gait.style == Style::Paper1997
        && let Some(value) = table.get("slope_deg").or(table.get("curvature_deg"))
    {
        let message = "found a change of slope or curvature in style \"1997\"; expected none, because both are zero at \
            every bound in this style";
        return Err(value.place().error(message));
    }
    let number = |key: &str, unit: f64| Ok::<f64, TomlError>(table.number_or(key, 0.0)? * unit);
    let change = KnotChange {
        scale: table.number_or("scale", 1.0)?,
        angle: number("angle_deg", DEGREE)?,
        slope: number("slope_deg", DEGREE)?,
        curvature: number("curvature_deg", DEGREE)?,
        phase: number("time_percent", 0.01)?,
        ..KnotChange::of(joint, knot)
    };
    Ok((change, joint as usize))
}
