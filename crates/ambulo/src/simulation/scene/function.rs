//! Functions of time: what drives, motors and moving obstacles follow.

use super::{Place, SceneError};
use crate::toml_reader::{Table, Value};

/// A function of the scene's time [s]; values in rad or m, as what it is for says.
#[derive(Debug, Clone, PartialEq)]
pub enum TimeFunction {
    /// Always the same.
    Constant(f64),
    /// offset + amplitude sin(2π frequency t + phase).
    Sine {
        /// Half the distance between the extremes.
        amplitude: f64,
        /// Cycles a second [Hz], above zero.
        frequency_hz: f64,
        /// At time zero [rad].
        phase: f64,
        /// The middle.
        offset: f64,
    },
    /// At rest at each of these instants, at least one, times rising: (time [s], value). Quintics between, without
    /// velocity and acceleration at their ends; constant before the first and after the last.
    Stops(Vec<(f64, f64)>),
    /// The natural cubic spline through these, at least two, times rising from zero or before to the end of the scene or
    /// after: (time [s], value).
    Points(Vec<(f64, f64)>),
    /// A column of a recording, in the unit that the file states.
    Motion {
        /// Where the path stands.
        place: Place,
        /// Path as it stands in the scene, relative to the scene.
        file: String,
        /// Name of the column.
        column: String,
        /// Time of the recording [s] at which the scene begins; `None` is its first instant.
        from_s: Option<f64>,
    },
}

/// What a function is for.
#[derive(Clone, Copy)]
pub(super) struct Purpose {
    /// How long it must last [s].
    pub(super) duration_s: f64,
    /// Whether it is an angle: recordings say themselves whether theirs are degrees.
    pub(super) angle: bool,
}

const KEYS: &[&str] = &["sine", "ramp", "stops", "points", "motion", "column", "from"];
const EXPECTED: &str = "a number, or one of { sine = … }, { ramp = … }, { stops = … }, { points = … }, { motion = … }";

/// The function under `key` or `key_deg` of a table.
pub(super) fn either_unit(table: &Table<'_>, key: &str, purpose: Purpose) -> Result<Option<TimeFunction>, SceneError> {
    let read = |(value, unit): (Value<'_>, f64)| TimeFunction::read(&value, unit, purpose);
    if purpose.angle {
        return table.either_unit(key)?.map(read).transpose();
    }
    if let Some(value) = table.get(&format!("{key}_deg")) {
        return Err(value.wrong(&format!("`{key}` in metres")).hint("this coordinate slides, it does not turn"));
    }
    table.get(key).map(|value| read((value, 1.0))).transpose()
}

impl TimeFunction {
    /// Reads a function whose values stand in a unit of so many radians or metres.
    pub(super) fn read(value: &Value<'_>, unit: f64, purpose: Purpose) -> Result<TimeFunction, SceneError> {
        if !value.is_table() {
            return value.finite(EXPECTED).map(|number| TimeFunction::Constant(number * unit));
        }
        let table = value.table(EXPECTED)?;
        table.only(&[KEYS])?;
        let kinds = ["sine", "ramp", "stops", "points", "motion"];
        let mut present = kinds.iter().filter_map(|kind| Some((*kind, table.get(kind)?)));
        let (Some((kind, body)), None) = (present.next(), present.next()) else { return Err(value.wrong(EXPECTED)) };
        if kind == "motion" {
            return motion(&table, &body, unit);
        }
        table.only(&[&[kind]])?;
        match kind {
            "sine" => sine(&body, unit),
            "ramp" => ramp(&body, unit),
            "stops" => pairs(&body, unit, 1).map(TimeFunction::Stops),
            _ => points(&body, unit, purpose.duration_s),
        }
    }
}

fn sine(value: &Value<'_>, unit: f64) -> Result<TimeFunction, SceneError> {
    let table = value.table("{ amplitude = …, frequency_hz = …, phase_deg = 0, offset = 0 }")?;
    table.only(&[&["amplitude", "frequency_hz", "phase_deg", "phase", "offset"]])?;
    Ok(TimeFunction::Sine {
        amplitude: table.need("amplitude", "half the distance between the extremes")?.number()? * unit,
        frequency_hz: table.need("frequency_hz", "the cycles a second")?.above_zero()?,
        phase: table.angle("phase")?.unwrap_or(0.0),
        offset: table.number_or("offset", 0.0)? * unit,
    })
}

fn ramp(value: &Value<'_>, unit: f64) -> Result<TimeFunction, SceneError> {
    let table = value.table("{ from = …, to = …, start = …, end = … }")?;
    table.only(&[&["from", "to", "start", "end"]])?;
    let from = table.need("from", "the value before")?.number()? * unit;
    let to = table.need("to", "the value after")?.number()? * unit;
    let start = table.need("start", "the instant [s] at which it begins")?.number()?;
    let last = table.need("end", "the instant [s] at which it ends")?;
    let end = last.number()?;
    if end <= start {
        return Err(last.wrong(&format!("an instant after `start`, {start} s")));
    }
    Ok(TimeFunction::Stops(vec![(start, from), (end, to)]))
}

fn points(value: &Value<'_>, unit: f64, duration_s: f64) -> Result<TimeFunction, SceneError> {
    let points = pairs(value, unit, 2)?;
    let (first, last) = (points[0].0, points[points.len() - 1].0);
    if first > 0.0 || last < duration_s {
        let expected = format!("points from 0 s or before to {duration_s} s (`duration`) or after");
        let error = value.wrong(&format!("{expected}; these go from {first} s to {last} s"));
        return Err(error.hint("`stops` rests before its first and after its last instant"));
    }
    Ok(TimeFunction::Points(points))
}

/// At least so many pairs [time, value], times rising.
fn pairs(value: &Value<'_>, unit: f64, least: usize) -> Result<Vec<(f64, f64)>, SceneError> {
    let expected = format!("a list of at least {least} [time, value], times rising");
    let mut pairs: Vec<(f64, f64)> = Vec::new();
    for entry in value.list(&expected)? {
        let [time, number] = entry.numbers("[time, value]")?;
        if let Some((before, _)) = pairs.last().filter(|(before, _)| *before >= time) {
            return Err(entry.wrong(&format!("a time after {before} s")));
        }
        pairs.push((time, number * unit));
    }
    if pairs.len() < least { Err(value.wrong(&expected)) } else { Ok(pairs) }
}

fn motion(table: &Table<'_>, value: &Value<'_>, unit: f64) -> Result<TimeFunction, SceneError> {
    table.only(&[&["motion", "column", "from"]])?;
    if unit < 1.0 {
        let error = value.wrong("a recording under the key without `_deg`");
        return Err(error.hint("the file itself says whether its angles are degrees"));
    }
    Ok(TimeFunction::Motion {
        place: value.place(),
        file: value.filled_text()?,
        column: table.need("column", "the name of a column of that file")?.filled_text()?,
        from_s: table.get("from").map(|value| value.number()).transpose()?,
    })
}
