//! Functions of time in scene files: what drives, motors and moving obstacles follow.

use crate::numerics::{Smoothing, SplineDegree, SplineFitter};
use crate::simulation::Signal;
use crate::simulation::scene::SceneError;
use crate::toml_reader::{Place, Table, Value};

/// A function of the scene's time [s]; values in rad or m.
#[derive(Debug, Clone)]
pub enum TimeFunction {
    /// A function given in the scene file.
    Given(Signal),
    /// A column of a recording, in the unit that the recording states; it is read when the scene is built.
    Recorded {
        /// Position of the path in the scene file.
        place: Place,
        /// Path as in the scene file, relative to the scene.
        file: String,
        /// Name of the column.
        column: String,
        /// Time of the recording [s] at which the scene begins; `None` is its first instant.
        from_s: Option<f64>,
    },
}

/// The use of a function.
#[derive(Clone, Copy)]
pub(super) struct Purpose {
    /// How long the function must last [s].
    pub(super) duration_s: f64,
    /// Whether it is an angle; recordings state themselves whether theirs are in degrees.
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
        return Err(value.wrong(&format!("`{key}` in metres")).hint("this coordinate is a distance, not an angle"));
    }
    table.get(key).map(|value| read((value, 1.0))).transpose()
}

impl TimeFunction {
    /// A constant function.
    pub(super) fn constant(value: f64) -> TimeFunction {
        TimeFunction::Given(Signal::Constant(value))
    }

    /// Reads a function whose values are in a unit of so many radians or metres.
    pub(super) fn read(value: &Value<'_>, unit: f64, purpose: Purpose) -> Result<TimeFunction, SceneError> {
        if !value.is_table() {
            return value.finite(EXPECTED).map(|number| TimeFunction::constant(number * unit));
        }
        let table = value.table(EXPECTED)?;
        table.only(&[KEYS])?;
        let kinds = ["sine", "ramp", "stops", "points", "motion"];
        let mut present = kinds.iter().filter_map(|kind| Some((*kind, table.get(kind)?)));
        let (Some((kind, body)), None) = (present.next(), present.next()) else { return Err(value.wrong(EXPECTED)) };
        if kind == "motion" {
            return recorded(&table, &body, unit);
        }
        table.only(&[&[kind]])?;
        let signal = match kind {
            "sine" => sine(&body, unit),
            "ramp" => ramp(&body, unit),
            "stops" => pairs(&body, unit, 1).map(Signal::Stops),
            _ => points(&body, unit, purpose.duration_s),
        };
        signal.map(TimeFunction::Given)
    }
}

fn sine(value: &Value<'_>, unit: f64) -> Result<Signal, SceneError> {
    let table = value.table("{ amplitude = …, frequency_hz = …, phase_deg = 0, offset = 0 }")?;
    table.only(&[&["amplitude", "frequency_hz", "phase_deg", "phase", "offset"]])?;
    Ok(Signal::Sine {
        amplitude: table.need("amplitude", "half the distance between the extremes")?.number()? * unit,
        frequency_hz: table.need("frequency_hz", "the frequency in cycles per second")?.above_zero()?,
        phase: table.angle("phase")?.unwrap_or(0.0),
        offset: table.number_or("offset", 0.0)? * unit,
    })
}

fn ramp(value: &Value<'_>, unit: f64) -> Result<Signal, SceneError> {
    let table = value.table("{ from = …, to = …, start = …, end = … }")?;
    table.only(&[&["from", "to", "start", "end"]])?;
    let from = table.need("from", "the value before the ramp")?.number()? * unit;
    let to = table.need("to", "the value after the ramp")?.number()? * unit;
    let start = table.need("start", "the instant [s] at which the ramp begins")?.number()?;
    let last = table.need("end", "the instant [s] at which the ramp ends")?;
    let end = last.number()?;
    if end <= start {
        return Err(last.wrong(&format!("an instant after `start`, {start} s")));
    }
    Ok(Signal::Stops(vec![(start, from), (end, to)]))
}

fn points(value: &Value<'_>, unit: f64, duration_s: f64) -> Result<Signal, SceneError> {
    let points = pairs(value, unit, 2)?;
    let (first, last) = (points[0].0, points[points.len() - 1].0);
    if first > 0.0 || last < duration_s {
        let expected = format!("points from 0 s or before to {duration_s} s (`duration`) or after");
        let error = value.wrong(&format!("{expected}; these go from {first} s to {last} s"));
        return Err(error.hint("`stops` rests before its first and after its last instant"));
    }
    let (times, values): (Vec<f64>, Vec<f64>) = four_or_more(&points).into_iter().unzip();
    let fitter = SplineFitter::new(SplineDegree::Cubic, &times);
    let spline = fitter.and_then(|fitter| fitter.fit(&values, Smoothing::Interpolate));
    Ok(Signal::Spline(spline.map_err(|e| value.place().error(e.to_string()))?, 0.0))
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

/// The same natural cubic spline through at least four points, as its fit needs: further points are placed on the curve.
fn four_or_more(points: &[(f64, f64)]) -> Vec<(f64, f64)> {
    match *points {
        // A straight line.
        [(t0, y0), (t1, y1)] => {
            [0.0, 1.0, 2.0, 3.0].map(|k| (t0 + (t1 - t0) * k / 3.0, y0 + (y1 - y0) * k / 3.0)).to_vec()
        }
        // 2 (h₁ + h₂) y₁'' = 6 ((y₂ - y₁)/h₂ - (y₁ - y₀)/h₁); in the middle of the first piece (y₀ + y₁)/2 - y₁'' h₁²/16.
        [first @ (t0, y0), second @ (t1, y1), third @ (t2, y2)] => {
            let (h1, h2) = (t1 - t0, t2 - t1);
            let bend = 3.0 * ((y2 - y1) / h2 - (y1 - y0) / h1) / (h1 + h2);
            vec![first, (t0 + 0.5 * h1, 0.5 * (y0 + y1) - bend * h1 * h1 / 16.0), second, third]
        }
        _ => points.to_vec(),
    }
}

fn recorded(table: &Table<'_>, value: &Value<'_>, unit: f64) -> Result<TimeFunction, SceneError> {
    table.only(&[&["motion", "column", "from"]])?;
    if unit < 1.0 {
        let error = value.wrong("a recording under the key without `_deg`");
        return Err(error.hint("the file itself says whether its angles are in degrees"));
    }
    Ok(TimeFunction::Recorded {
        place: value.place(),
        file: value.filled_text()?,
        column: table.need("column", "the name of a column of that file")?.filled_text()?,
        from_s: table.get("from").map(|value| value.number()).transpose()?,
    })
}
