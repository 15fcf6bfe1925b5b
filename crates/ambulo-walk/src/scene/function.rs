//! Functions of time in a scene file, for drives, motors and moving obstacles.

use super::{Place, SceneError};
use crate::toml_reader::{Table, Value};

/// A function of the scene's time [s]; values in rad or m, depending on its use.
#[derive(Debug, Clone, PartialEq)]
pub enum TimeFunction {
    /// A constant.
    Constant(f64),
    /// offset + amplitude sin(2π frequency t + phase).
    Sine {
        /// Half the distance between the extremes.
        amplitude: f64,
        /// Frequency [Hz], above zero.
        frequency_hz: f64,
        /// Phase at time zero [rad].
        phase: f64,
        /// Mean value.
        offset: f64,
    },
    /// Stops at these times, at least one, with increasing times: (time [s], value). Between them quintics with zero
    /// velocity and acceleration at their ends; constant before the first and after the last.
    Stops(Vec<(f64, f64)>),
    /// The natural cubic spline through at least two points with increasing times, which cover the whole scene: (time
    /// [s], value).
    Points(Vec<(f64, f64)>),
    /// A column of a recording, in the unit stated in the file.
    Motion {
        /// Place of the path in the scene file.
        place: Place,
        /// Path, relative to the scene.
        file: String,
        /// Name of the column.
        column: String,
        /// Time of the recording at which the scene begins [s]; `None`: its first sample.
        from_s: Option<f64>,
    },
}

/// The use of a function.
#[derive(Clone, Copy)]
pub(super) struct Purpose {
    /// Duration that it must cover [s].
    pub(super) duration_s: f64,
    /// Whether it is an angle; recordings state whether their angles are in degrees.
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
        return Err(value.wrong(&format!("`{key}` in metres")).hint("this coordinate is a translation"));
    }
    table.get(key).map(|value| read((value, 1.0))).transpose()
}

impl TimeFunction {
    /// Reads a function; `unit` is the unit of its values in radians or metres.
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
        frequency_hz: table.need("frequency_hz", "the frequency [Hz]")?.above_zero()?,
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
        let expected = format!("points that cover 0 s to {duration_s} s (`duration`)");
        let error = value.wrong(&format!("{expected}; these cover {first} s to {last} s"));
        return Err(error.hint("`stops` is constant before its first and after its last time"));
    }
    Ok(TimeFunction::Points(points))
}

/// Reads at least `least` pairs [time, value] with increasing times.
fn pairs(value: &Value<'_>, unit: f64, least: usize) -> Result<Vec<(f64, f64)>, SceneError> {
    let expected = format!("a list of at least {least} [time, value] with increasing times");
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
        return Err(error.hint("the file states whether its angles are in degrees"));
    }
    Ok(TimeFunction::Motion {
        place: value.place(),
        file: value.filled_text()?,
        column: table.need("column", "the name of a column of that file")?.filled_text()?,
        from_s: table.get("from").map(|value| value.number()).transpose()?,
    })
}
