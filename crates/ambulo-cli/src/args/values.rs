//! Parsers of option values.

use ambulo::job::Job;
use ambulo::model::anthropometry::{SegmentTable, UnknownTable};
use ambulo::motion::filter::MAX_ORDER;
use ambulo::optimal::{Load, LoadPlace};
use ambulo_results::Keep;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use serde::Deserialize;
use std::fmt;
use std::net::{Ipv4Addr, SocketAddr};
use std::ops::RangeInclusive;
use std::str::FromStr;

/// Names of the outputs of a recording or a synthetic walk; all but `recording` unless it is the demo.
pub(super) fn names_of_run() -> impl Iterator<Item = &'static str> {
    Keep::OF_RUNS.into_iter().filter(|name| *name != "recording")
}

/// One of [`names_of_run`].
pub(super) fn outputs_of_run() -> PossibleValuesParser {
    PossibleValuesParser::new(names_of_run())
}

/// Names of the outputs of the demo.
pub(super) fn outputs_of_demo() -> PossibleValuesParser {
    PossibleValuesParser::new(Keep::OF_RUNS)
}

/// Names of the outputs of a scene.
pub(super) fn outputs_of_scene() -> PossibleValuesParser {
    PossibleValuesParser::new(Keep::OF_SCENES)
}

/// Names of the outputs of a sweep.
pub(super) fn outputs_of_sweep() -> PossibleValuesParser {
    PossibleValuesParser::new(Keep::OF_SWEEPS)
}

/// Names of the outputs of the 1997 paper.
pub(super) fn outputs_of_paper() -> PossibleValuesParser {
    PossibleValuesParser::new(Keep::OF_THE_PAPER)
}

/// One of the words for values.
pub(super) fn one_of<T: Copy + Send + Sync + 'static>(
    words: &'static [(&'static str, T)],
) -> impl TypedValueParser<Value = T> {
    let value = |text: String| words.iter().find(|(word, _)| *word == text).map(|(_, value)| *value);
    PossibleValuesParser::new(words.iter().map(|(word, _)| *word))
        .try_map(move |text| value(text).ok_or("expected one of the words above"))
}

/// A day, as YYYY-MM-DD.
pub(super) fn day(text: &str) -> Result<String, String> {
    ambulo::study::day(text).map_err(|expected| format!("expected {expected}"))
}

/// A table of segment masses.
pub(super) fn segments() -> impl TypedValueParser<Value = SegmentTable> {
    PossibleValuesParser::new(SegmentTable::ALL.map(SegmentTable::name)).try_map(|name| name.parse::<SegmentTable>())
}

/// A table of segment masses. The ids of runs are made from its name.
#[derive(Clone, Copy)]
pub(crate) struct Figure(pub(crate) SegmentTable);

impl Default for Figure {
    fn default() -> Figure {
        Figure(Job::SEGMENTS)
    }
}

impl FromStr for Figure {
    type Err = UnknownTable;
    fn from_str(name: &str) -> Result<Figure, UnknownTable> {
        name.parse().map(Figure)
    }
}

impl fmt::Debug for Figure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.name().fmt(f)
    }
}

/// Any number; the library checks its range.
pub(super) fn number(text: &str) -> Result<f64, String> {
    text.trim().parse().map_err(|_| "expected a number, such as 1.2".into())
}

/// A number that its unit may follow: `8` or `8%`; the library checks its range.
pub(super) fn percent(text: &str) -> Result<f64, String> {
    let number = text.trim().trim_end_matches('%').trim_end();
    number.parse().map_err(|_| "expected a number of percent, such as 8 or 8%".into())
}

/// A body mass: `75` or `75kg`; the library checks its range.
pub(super) fn kilograms(text: &str) -> Result<f64, String> {
    let number = text.trim().trim_end_matches("kg").trim_end();
    number.parse().map_err(|_| "expected a number of kilograms, such as 75 or 75kg".into())
}

/// A stature: `1.75`, `1.75m` or `175cm`; the library checks its range.
pub(super) fn metres(text: &str) -> Result<f64, String> {
    let text = text.trim();
    let (number, size) = match text.strip_suffix("cm") {
        Some(number) => (number, 0.01),
        None => (text.trim_end_matches('m'), 1.0),
    };
    let metres = number.trim_end().parse::<f64>().map(|number| number * size);
    metres.map_err(|_| "expected a number of metres, such as 1.75, 1.75m or 175cm".into())
}

/// Any whole number; the library checks its range.
pub(super) fn whole_number(text: &str) -> Result<usize, String> {
    text.trim().parse().map_err(|_| "expected a whole number, such as 3".into())
}

/// Trials or candidates that are computed at the same time.
pub(super) fn jobs(text: &str) -> Result<u32, String> {
    count(text, 1..=1024)
}

/// Trials in one file of a batch.
pub(super) fn part(text: &str) -> Result<u32, String> {
    count(text, 1..=100_000)
}

/// A number of trials.
pub(super) fn from_one(text: &str) -> Result<u32, String> {
    count(text, 1..=u32::MAX)
}

fn count(text: &str, range: RangeInclusive<u32>) -> Result<u32, String> {
    let expected = || format!("expected a whole number from {} to {}", range.start(), range.end());
    text.trim().parse().ok().filter(|count| range.contains(count)).ok_or_else(expected)
}

pub(super) fn order(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(order) if (1..=MAX_ORDER).contains(&order) => Ok(order),
        _ => Err(format!("expected a whole number from 1 to {MAX_ORDER}, because higher orders ring")),
    }
}

pub(super) fn seconds(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(seconds) if seconds.is_finite() => Ok(seconds),
        _ => Err("expected a number of seconds".into()),
    }
}

pub(super) fn zero_or_more_seconds(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(seconds) if seconds.is_finite() && seconds >= 0.0 => Ok(seconds),
        _ => Err("expected a number of seconds, zero or more".into()),
    }
}

pub(super) fn above_zero(text: &str) -> Result<f64, String> {
    more_than_zero(text).ok_or_else(|| "expected a number of seconds above 0".into())
}

pub(super) fn megabytes(text: &str) -> Result<f64, String> {
    more_than_zero(text).ok_or_else(|| "expected a number of megabytes above 0".into())
}

fn more_than_zero(text: &str) -> Option<f64> {
    text.parse().ok().filter(|value: &f64| value.is_finite() && *value > 0.0)
}

/// The force of a push [N]; larger ones are typing errors.
pub(super) fn force(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(force) if (1.0..=10_000.0).contains(&force) => Ok(force),
        _ => Err("expected a force from 1 to 10000 N".into()),
    }
}

pub(super) fn limit(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(limit) if limit.is_finite() && limit >= 0.0 => Ok(limit),
        _ => Err("expected a number, zero or more".into()),
    }
}

/// A value that is reached by a change that begins at a time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct TimedValue {
    /// Start of the change [s].
    pub(crate) time_s: f64,
    /// The value after the change.
    pub(crate) value: f64,
    /// Duration of the change [s]; `None` for the default.
    pub(crate) duration_s: Option<f64>,
}

/// TIME:VALUE or TIME:VALUE:DURATION; the library checks the ranges.
impl FromStr for TimedValue {
    type Err = String;
    fn from_str(text: &str) -> Result<TimedValue, String> {
        let parts: Result<Vec<f64>, _> = text.split(':').map(|part| part.trim().parse()).collect();
        match parts.as_deref() {
            Ok([time_s, value]) => Ok(TimedValue { time_s: *time_s, value: *value, duration_s: None }),
            Ok([time_s, value, duration_s]) => {
                Ok(TimedValue { time_s: *time_s, value: *value, duration_s: Some(*duration_s) })
            }
            _ => {
                Err("expected TIME:VALUE or TIME:VALUE:DURATION with times in seconds, such as 3:1.6 or 3:1.6:2".into())
            }
        }
    }
}

impl fmt::Display for TimedValue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}", self.time_s, self.value)?;
        self.duration_s.map_or(Ok(()), |duration_s| write!(f, ":{duration_s}"))
    }
}

/// A load: KG, KGkg, and optionally where it is carried; the library checks the mass.
pub(super) fn load(text: &str) -> Result<Load, String> {
    let expected = || "expected a mass and optionally back, hands or pelvis, such as 12, 12kg or 12kg:hands".to_owned();
    let (mass, place) = text.split_once(':').unwrap_or((text, LoadPlace::ALL[0].0));
    let place = LoadPlace::ALL.into_iter().find(|(name, _)| *name == place.trim()).ok_or_else(expected)?.1;
    let mass = mass.trim().trim_end_matches("kg").trim().parse().map_err(|_| expected())?;
    Ok(Load { mass, place })
}

/// Values of a sweep in JSON.
#[derive(Deserialize)]
#[serde(untagged, expecting = "expected a number, a list of numbers or text, such as \"0.6:2.0:0.2\"")]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub(super) enum Written {
    Number(f64),
    Numbers(Vec<f64>),
    Text(String),
}

impl Written {
    /// As in the command line.
    fn text(&self) -> String {
        match self {
            Written::Number(number) => number.to_string(),
            Written::Numbers(numbers) => numbers.iter().map(f64::to_string).collect::<Vec<_>>().join(","),
            Written::Text(text) => text.clone(),
        }
    }

    fn parsed<T: FromStr<Err = String>>(&self) -> Result<T, String> {
        let text = self.text();
        text.parse().map_err(|error| format!("found `{text}`; {error}"))
    }
}

impl TryFrom<Written> for Values {
    type Error = String;
    fn try_from(written: Written) -> Result<Values, String> {
        written.parsed()
    }
}

impl TryFrom<Written> for Loads {
    type Error = String;
    fn try_from(written: Written) -> Result<Loads, String> {
        written.parsed()
    }
}

/// Values of a sweep.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(try_from = "Written")]
pub(crate) struct Values(pub(crate) Vec<f64>);

/// A longer list is a mistake.
const MOST_VALUES: f64 = 500.0;

impl FromStr for Values {
    type Err = String;
    fn from_str(text: &str) -> Result<Values, String> {
        let expected = || {
            "expected numbers separated by commas, such as 60,80,100, or FROM:TO:STEP, such as 0.6:2.0:0.2".to_owned()
        };
        let numbers = |separator: char| {
            let plain = |part: &str| part.trim().trim_end_matches('%').trim_end_matches("kg").trim_end().to_owned();
            let number = move |part: &str| plain(part).parse().ok();
            text.split(separator).map(move |part| number(part).filter(|x: &f64| x.is_finite()))
        };
        if !text.contains(':') {
            return numbers(',').collect::<Option<Vec<f64>>>().map(Values).ok_or_else(expected);
        }
        let [from, to, step] =
            numbers(':').collect::<Option<Vec<f64>>>().and_then(|range| range.try_into().ok()).ok_or_else(expected)?;
        let steps = ((to - from) / step + 1e-9).floor();
        if !(step > 0.0 && to >= from && steps < MOST_VALUES) {
            return Err(format!(
                "found {text}; expected a range that rises by a step above 0, with at most {MOST_VALUES} values"
            ));
        }
        // Decimal fractions stay short: 0.6 + 2 x 0.2 is 1.
        let rounded = |value: f64| (value * 1e9).round() / 1e9;
        Ok(Values((0..=steps as usize).map(|i| rounded(from + i as f64 * step)).collect()))
    }
}

/// Loads of a sweep, and where they are carried.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(try_from = "Written")]
pub(crate) struct Loads {
    pub(crate) masses: Values,
    pub(crate) place: LoadPlace,
}

impl FromStr for Loads {
    type Err = String;
    fn from_str(text: &str) -> Result<Loads, String> {
        let named = text.rsplit_once(':').and_then(|(masses, place)| {
            let (_, place) = LoadPlace::ALL.into_iter().find(|(name, _)| *name == place.trim())?;
            Some((masses, place))
        });
        let (masses, place) = named.unwrap_or((text, LoadPlace::ALL[0].1));
        Ok(Loads { masses: masses.parse()?, place })
    }
}

/// JOINT=SHARE; the library checks both.
pub(super) fn weakness(text: &str) -> Result<(String, f64), String> {
    let expected = || "expected JOINT=SHARE, such as ankle_r=0.6".to_owned();
    let (joint, share) = text.split_once('=').ok_or_else(expected)?;
    Ok((joint.trim().to_owned(), share.trim().parse().map_err(|_| expected())?))
}

/// Where frames of a stream come from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Endpoint {
    Stdin,
    Tcp(SocketAddr),
    Udp(SocketAddr),
}

/// `stdin`, `tcp:PORT`, `udp:PORT`, or with an address of this computer before the port.
pub(super) fn endpoint(text: &str) -> Result<Endpoint, String> {
    const EXPECTED: &str =
        "expected stdin, tcp:PORT, udp:PORT, or with an address of this computer, such as tcp:0.0.0.0:5005 for all";
    if text == "stdin" {
        return Ok(Endpoint::Stdin);
    }
    let (kind, place) = text.split_once(':').ok_or(EXPECTED)?;
    let address = local_address(place).map_err(|_| EXPECTED)?;
    match kind {
        "tcp" => Ok(Endpoint::Tcp(address)),
        "udp" => Ok(Endpoint::Udp(address)),
        _ => Err(EXPECTED.into()),
    }
}

/// A port of this computer, or an address with a port.
pub(super) fn local_address(text: &str) -> Result<SocketAddr, String> {
    let local = |port: u16| SocketAddr::from((Ipv4Addr::LOCALHOST, port));
    let address = text.parse().map(local).or_else(|_| text.parse());
    address
        .map_err(|_| "expected a port, or an address of this computer with a port, such as 0.0.0.0:8080 for all".into())
}

/// A time in milliseconds; the library checks its range.
pub(super) fn milliseconds(text: &str) -> Result<f64, String> {
    text.trim().parse().map_err(|_| "expected a number of milliseconds, such as 70".into())
}
