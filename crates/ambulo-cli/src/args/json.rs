//! Fields of requests in JSON whose values have a parser of the command line: both have the same ranges and messages.

use super::batch::tables as names_of_tables;
use super::values::{self, above_zero, from_one, names_of_run, weakness};
use ambulo::job::json as text;
use ambulo::optimal::Load;
use ambulo_results::Keep;
use serde::de::{Deserialize, Deserializer, Error};
use serde_json::Number;
use std::path::PathBuf;

/// A parser of the command line.
type Parser<T> = fn(&str) -> Result<T, String>;

fn parsed<T, E: Error>(text: &str, parser: Parser<T>) -> Result<T, E> {
    parser(text).map_err(|error| E::custom(format!("found `{text}`; {error}")))
}

fn number<'de, D: Deserializer<'de>, T>(from: D, parser: Parser<T>) -> Result<Option<T>, D::Error> {
    let found = Option::<Number>::deserialize(from)?;
    found.map(|number| parsed(&number.to_string(), parser)).transpose()
}

pub(super) fn jobs<'de, D: Deserializer<'de>>(from: D) -> Result<Option<u32>, D::Error> {
    number(from, values::jobs)
}

pub(super) fn day<'de, D: Deserializer<'de>>(from: D) -> Result<Option<String>, D::Error> {
    let found: Option<String> = text::optional(from)?;
    found.map(|day| parsed(&day, values::day)).transpose()
}

pub(super) fn part<'de, D: Deserializer<'de>>(from: D) -> Result<u32, D::Error> {
    parsed(&Number::deserialize(from)?.to_string(), values::part)
}

pub(super) fn limit<'de, D: Deserializer<'de>>(from: D) -> Result<Option<u32>, D::Error> {
    number(from, from_one)
}

pub(super) fn duration_s<'de, D: Deserializer<'de>>(from: D) -> Result<Option<f64>, D::Error> {
    number(from, above_zero)
}

pub(super) fn megabytes<'de, D: Deserializer<'de>>(from: D) -> Result<Option<f64>, D::Error> {
    number(from, values::megabytes)
}

pub(super) fn load<'de, D: Deserializer<'de>>(from: D) -> Result<Option<Load>, D::Error> {
    let found: Option<String> = text::optional(from)?;
    found.map(|load| parsed(&load, values::load)).transpose()
}

pub(super) fn weaknesses<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<(String, f64)>, D::Error> {
    let found = Vec::<String>::deserialize(from)?;
    found.iter().map(|text| parsed(text, weakness)).collect()
}

/// At least one file or folder.
pub(crate) fn sources<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<PathBuf>, D::Error> {
    let found = Vec::deserialize(from)?;
    if found.is_empty() { Err(D::Error::custom("found an empty list; expected a file or a folder")) } else { Ok(found) }
}

/// Names of outputs.
fn names<'de, D: Deserializer<'de>>(
    from: D,
    known: impl Iterator<Item = &'static str>,
) -> Result<Vec<String>, D::Error> {
    let found = Vec::<String>::deserialize(from)?;
    let known: Vec<&str> = known.collect();
    match found.iter().find(|name| !known.contains(&name.as_str())) {
        Some(name) => Err(D::Error::custom(format!("found `{name}`; expected some of {}", known.join(", ")))),
        None => Ok(found),
    }
}

pub(crate) fn outputs_of_run<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<String>, D::Error> {
    names(from, names_of_run())
}

pub(super) fn outputs_of_demo<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<String>, D::Error> {
    names(from, Keep::OF_RUNS.into_iter())
}

pub(super) fn outputs_of_scene<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<String>, D::Error> {
    names(from, Keep::OF_SCENES.into_iter())
}

pub(super) fn outputs_of_sweep<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<String>, D::Error> {
    names(from, Keep::OF_SWEEPS.into_iter())
}

pub(super) fn tables<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<String>, D::Error> {
    names(from, names_of_tables())
}
