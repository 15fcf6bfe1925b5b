//! Values of a job in JSON that a person writes as text: `"1=r"` is a plate and its foot, `12.5` and `"off"` are
//! cut-offs.
//!
//! The functions are for serde's attribute `deserialize_with`. They read a string or a number with [`FromStr`], so that
//! JSON and the command line have the same forms, ranges and messages.

use serde::de::{Deserialize, Deserializer, Error, Unexpected, Visitor};
use std::fmt::{Display, Formatter, Result as FmtResult};
use std::marker::PhantomData;
use std::str::FromStr;

/// A value that is written as text.
struct Text<T>(T);

struct TextVisitor<T>(PhantomData<T>);

/// Reads a value.
///
/// # Errors
/// Another type than a string or a number; text that is no such value.
pub fn text<'de, D: Deserializer<'de>, T: FromStr<Err: Display>>(from: D) -> Result<T, D::Error> {
    Text::deserialize(from).map(|Text(value)| value)
}

/// Reads a value that may be left out.
///
/// # Errors
/// As [`text`].
pub fn optional<'de, D: Deserializer<'de>, T: FromStr<Err: Display>>(from: D) -> Result<Option<T>, D::Error> {
    Ok(Option::<Text<T>>::deserialize(from)?.map(|Text(value)| value))
}

/// Reads a list of values.
///
/// # Errors
/// As [`text`], and another type than a list.
pub fn each<'de, D: Deserializer<'de>, T: FromStr<Err: Display>>(from: D) -> Result<Vec<T>, D::Error> {
    Ok(Vec::<Text<T>>::deserialize(from)?.into_iter().map(|Text(value)| value).collect())
}

impl<'de, T: FromStr<Err: Display>> Deserialize<'de> for Text<T> {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Text<T>, D::Error> {
        from.deserialize_any(TextVisitor(PhantomData)).map(Text)
    }
}

impl<T: FromStr<Err: Display>> Visitor<'_> for TextVisitor<T> {
    type Value = T;

    fn expecting(&self, f: &mut Formatter<'_>) -> FmtResult {
        f.write_str("text or a number")
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<T, E> {
        text.parse().map_err(|error| E::custom(format!("found `{text}`; {error}")))
    }

    fn visit_f64<E: Error>(self, number: f64) -> Result<T, E> {
        match number.is_finite() {
            true => self.visit_str(&number.to_string()),
            false => Err(E::invalid_value(Unexpected::Float(number), &self)),
        }
    }

    fn visit_i64<E: Error>(self, number: i64) -> Result<T, E> {
        self.visit_str(&number.to_string())
    }

    fn visit_u64<E: Error>(self, number: u64) -> Result<T, E> {
        self.visit_str(&number.to_string())
    }
}

/// The type of a value that is text or a number, for schemas.
#[cfg(feature = "schema")]
#[derive(schemars::JsonSchema)]
#[schemars(untagged, inline)]
#[doc(hidden)]
pub enum TextOrNumber {
    /// A number.
    Number(f64),
    /// Text.
    Text(String),
}
