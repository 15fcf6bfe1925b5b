//! TOML values with their place in the file, so that every error states line and key.

use super::error::{Place, TomlError};
use super::words::{listed, nearest};
use crate::spatial::{Mat3, Pose, Vec3, rotation_about};
use nalgebra::{Quaternion, UnitQuaternion};
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// Larger numbers are mistakes, and their fifth powers would exceed the range of f64.
const LARGEST: f64 = 1e15;
/// A vector shorter than this gives no direction.
const SHORTEST_DIRECTION: f64 = 1e-9;
/// Characters of the file that a message quotes.
const SHOWN: usize = 40;

/// The text of a file, and the starts of its lines.
pub struct Source<'t> {
    text: &'t str,
    /// The document that describes such files.
    document: &'static str,
    starts: Vec<usize>,
}

impl<'t> Source<'t> {
    /// A document with its name for messages.
    pub fn new(text: &'t str, document: &'static str) -> Source<'t> {
        let ends = text.bytes().enumerate().filter(|(_, byte)| *byte == b'\n');
        Source { text, document, starts: std::iter::once(0).chain(ends.map(|(at, _)| at + 1)).collect() }
    }

    /// Parses the text to a table.
    pub fn parse(&self) -> Result<DeTable<'t>, TomlError> {
        DeTable::parse(self.text).map(Spanned::into_inner).map_err(|error| {
            let at = error.span().map_or(self.text.len(), |span| span.start);
            TomlError::new(self.line(at), "", format!("this is not TOML: {}", error.message().trim()))
                .hint(&format!("write texts in quotes, lists in [ ], inline tables in {{ }}; see {}", self.document))
        })
    }

    /// Line of a byte, counted from 1.
    fn line(&self, at: usize) -> usize {
        self.starts.partition_point(|start| *start <= at)
    }

    fn shown(&self, span: Range<usize>) -> String {
        let text = self.text.get(span).unwrap_or_default().trim();
        let mut shown: String = text.chars().take(SHOWN).map(|c| if c.is_control() { ' ' } else { c }).collect();
        if text.chars().count() > SHOWN {
            shown.push('…');
        }
        if shown.is_empty() { "nothing".into() } else { shown }
    }
}

/// One value of the file.
#[derive(Clone)]
pub struct Value<'t> {
    source: &'t Source<'t>,
    path: String,
    raw: &'t Spanned<DeValue<'t>>,
}

impl<'t> Value<'t> {
    /// Line of the value.
    pub fn line(&self) -> usize {
        self.source.line(self.raw.span().start)
    }

    /// Its place in the file.
    pub fn place(&self) -> Place {
        Place { line: self.line(), key: self.path.clone() }
    }

    /// The error that this value is not what was expected.
    pub fn wrong(&self, expected: &str) -> TomlError {
        let found = self.source.shown(self.raw.span());
        TomlError::new(self.line(), self.path.clone(), format!("found {found}; expected {expected}"))
    }

    /// A finite number.
    pub fn number(&self) -> Result<f64, TomlError> {
        self.finite("a number")
    }

    /// A finite number above zero.
    pub fn above_zero(&self) -> Result<f64, TomlError> {
        const EXPECTED: &str = "a number above zero";
        let number = self.finite(EXPECTED)?;
        if number > 0.0 { Ok(number) } else { Err(self.wrong(EXPECTED)) }
    }

    /// A finite number of at least zero.
    pub fn zero_or_more(&self) -> Result<f64, TomlError> {
        const EXPECTED: &str = "a number, zero or more";
        let number = self.finite(EXPECTED)?;
        if number >= 0.0 { Ok(number) } else { Err(self.wrong(EXPECTED)) }
    }

    /// A finite number; `expected` describes everything that is allowed here.
    pub fn finite(&self, expected: &str) -> Result<f64, TomlError> {
        let number = match self.raw.get_ref() {
            DeValue::Integer(integer) if integer.radix() == 10 => integer.as_str().parse().ok(),
            DeValue::Integer(integer) => i64::from_str_radix(integer.as_str(), integer.radix()).ok().map(|i| i as f64),
            DeValue::Float(float) => float.as_str().parse().ok(),
            DeValue::String(text) if text.trim().parse::<f64>().is_ok() => {
                return Err(self.wrong(expected).hint("write numbers without quotes"));
            }
            _ => None,
        };
        match number {
            Some(number) if f64::abs(number) <= LARGEST => Ok(number),
            Some(_) => Err(self.wrong(expected).hint("numbers are finite and at most 1e15 in size")),
            None => Err(self.wrong(expected)),
        }
    }

    /// A whole number of at least one.
    pub fn count(&self) -> Result<usize, TomlError> {
        let whole = self.raw.get_ref().as_integer().and_then(|integer| integer.as_str().parse().ok());
        whole.filter(|count| *count > 0).ok_or_else(|| self.wrong("a whole number, one or more"))
    }

    pub(crate) fn truth(&self) -> Result<bool, TomlError> {
        self.raw.get_ref().as_bool().ok_or_else(|| self.wrong("true or false"))
    }

    /// A text.
    pub fn text(&self) -> Result<&'t str, TomlError> {
        self.raw.get_ref().as_str().ok_or_else(|| self.wrong("a text in quotes"))
    }

    /// A text that names a file or something in a file.
    pub fn filled_text(&self) -> Result<String, TomlError> {
        let text = self.text()?;
        if text.trim().is_empty() { Err(self.wrong("a text that is not empty")) } else { Ok(text.to_owned()) }
    }

    /// One of some words.
    pub fn choice<T: Copy>(&self, words: &[(&str, T)]) -> Result<T, TomlError> {
        let found = self.raw.get_ref().as_str();
        if let Some((_, value)) = words.iter().find(|(word, _)| Some(*word) == found) {
            return Ok(*value);
        }
        let quoted: Vec<String> = words.iter().map(|(word, _)| format!("\"{word}\"")).collect();
        let error = self.wrong(&format!("one of {}", quoted.join(", ")));
        Err(match found.and_then(|found| nearest(found, words.iter().map(|(word, _)| *word))) {
            Some(near) => error.hint(&format!("did you mean \"{near}\"?")),
            None => error,
        })
    }

    /// The values of a list.
    pub fn list(&self, expected: &str) -> Result<Vec<Value<'t>>, TomlError> {
        let Some(array) = self.raw.get_ref().as_array() else { return Err(self.wrong(expected)) };
        let entry = |(i, raw)| Value { source: self.source, path: format!("{}[{}]", self.path, i + 1), raw };
        Ok(array.iter().enumerate().map(entry).collect())
    }

    /// A list of `N` finite numbers.
    pub fn numbers<const N: usize>(&self, expected: &str) -> Result<[f64; N], TomlError> {
        let numbers: Result<Vec<f64>, TomlError> = self.list(expected)?.iter().map(Value::number).collect();
        numbers?.try_into().map_err(|_| self.wrong(expected))
    }

    /// A list of three finite numbers.
    pub fn vector(&self) -> Result<Vec3, TomlError> {
        self.numbers("three numbers [x, y, z]").map(Vec3::from)
    }

    /// A unit vector.
    pub fn direction(&self) -> Result<Vec3, TomlError> {
        const EXPECTED: &str = "a direction [x, y, z] longer than zero";
        let vector = Vec3::from(self.numbers(EXPECTED)?);
        vector.try_normalize(SHORTEST_DIRECTION).ok_or_else(|| self.wrong(EXPECTED))
    }

    /// Whether this is a table; functions are numbers or tables.
    pub fn is_table(&self) -> bool {
        self.raw.get_ref().is_table()
    }

    /// A table.
    pub fn table(&self, expected: &str) -> Result<Table<'t>, TomlError> {
        let Some(raw) = self.raw.get_ref().as_table() else { return Err(self.wrong(expected)) };
        Ok(Table { source: self.source, path: self.path.clone(), line: self.line(), raw })
    }

    /// The rotation `outer_from_inner`, from axis and angle or from a quaternion.
    fn rotation(&self) -> Result<Mat3, TomlError> {
        let table = self.table("{ axis = [x, y, z], angle_deg = 30 } or { quaternion = [w, x, y, z] }")?;
        let Some(value) = table.get("quaternion") else {
            table.only(&[&["axis", "angle_deg", "angle", "quaternion"]])?;
            let axis = table.need("axis", "the direction to turn about")?.direction()?;
            let angle = table.angle("angle")?.ok_or_else(|| table.missing("angle_deg", "the angle to turn by"))?;
            return Ok(rotation_about(axis, angle));
        };
        table.only(&[&["quaternion"]])?;
        const EXPECTED: &str = "a quaternion [w, x, y, z] longer than zero";
        let [w, x, y, z] = value.numbers(EXPECTED)?;
        let turn = UnitQuaternion::try_new(Quaternion::new(w, x, y, z), SHORTEST_DIRECTION);
        Ok(turn.ok_or_else(|| value.wrong(EXPECTED))?.to_rotation_matrix().into_inner())
    }
}

/// A table of the file.
pub struct Table<'t> {
    source: &'t Source<'t>,
    path: String,
    /// Line of its header or brace, counted from 1.
    pub line: usize,
    raw: &'t DeTable<'t>,
}

impl<'t> Table<'t> {
    /// The whole file.
    pub fn root(source: &'t Source<'t>, raw: &'t DeTable<'t>) -> Table<'t> {
        Table { source, path: String::new(), line: 1, raw }
    }

    /// Its place in the file.
    pub fn place(&self) -> Place {
        Place { line: self.line, key: self.path.clone() }
    }

    fn path_of(&self, key: &str) -> String {
        if self.path.is_empty() { key.to_owned() } else { format!("{}.{key}", self.path) }
    }

    /// Rejects every key that is not in the lists.
    pub fn only(&self, allowed: &[&[&str]]) -> Result<(), TomlError> {
        let keys = || allowed.iter().flat_map(|list| list.iter().copied());
        let unknown = self.raw.keys().filter(|key| !keys().any(|known| known == key.get_ref().as_ref()));
        let Some(first) = unknown.min_by_key(|key| key.span().start) else { return Ok(()) };
        let name = first.get_ref().as_ref();
        let message = format!("unknown key; expected {}", listed(keys()));
        let shown_name = self.source.shown(first.span());
        let error = TomlError::new(self.source.line(first.span().start), self.path_of(&shown_name), message);
        Err(match nearest(name, keys()) {
            Some(near) => error.hint(&format!("did you mean `{near}`?")),
            None => error,
        })
    }

    /// The value of a key, if the table has it.
    pub fn get(&self, key: &str) -> Option<Value<'t>> {
        self.raw.get(key).map(|raw| Value { source: self.source, path: self.path_of(key), raw })
    }

    /// A required value; `meaning` describes it in the error if it is missing.
    pub fn need(&self, key: &str, meaning: &str) -> Result<Value<'t>, TomlError> {
        self.get(key).ok_or_else(|| self.missing(key, meaning))
    }

    /// The error that a key is missing.
    pub fn missing(&self, key: &str, meaning: &str) -> TomlError {
        let error = TomlError::new(self.line, self.path_of(key), format!("found no `{key}`; expected {meaning}"));
        match nearest(key, self.raw.keys().map(|key| key.get_ref().as_ref())) {
            Some(near) => error.hint(&format!("is `{near}` meant to be `{key}`?")),
            None => error,
        }
    }

    /// The error that this table as a whole is not what was expected.
    pub fn wrong(&self, message: impl Into<String>) -> TomlError {
        TomlError::new(self.line, self.path.clone(), message)
    }

    /// The number of a key, or a default.
    pub fn number_or(&self, key: &str, default: f64) -> Result<f64, TomlError> {
        self.get(key).map_or(Ok(default), |value| value.number())
    }

    /// The number of at least zero of a key, or a default.
    pub fn zero_or_more_or(&self, key: &str, default: f64) -> Result<f64, TomlError> {
        self.get(key).map_or(Ok(default), |value| value.zero_or_more())
    }

    /// The number above zero of a key, or a default.
    pub fn above_zero_or(&self, key: &str, default: f64) -> Result<f64, TomlError> {
        self.get(key).map_or(Ok(default), |value| value.above_zero())
    }

    /// The truth value of a key, or a default.
    pub fn truth_or(&self, key: &str, default: bool) -> Result<bool, TomlError> {
        self.get(key).map_or(Ok(default), |value| value.truth())
    }

    /// The vector of a key, or zero.
    pub fn vector_or_zero(&self, key: &str) -> Result<Vec3, TomlError> {
        self.get(key).map_or(Ok(Vec3::zeros()), |value| value.vector())
    }

    /// The value under `key` or `key_deg`, and the factor to SI; both together are an error.
    pub fn either_unit(&self, key: &str) -> Result<Option<(Value<'t>, f64)>, TomlError> {
        match (self.get(key), self.get(&format!("{key}_deg"))) {
            (Some(_), Some(degrees)) => {
                let message = format!("found both `{key}_deg` and `{key}`; expected one of them");
                Err(TomlError::new(degrees.line(), degrees.path, message).hint("`_deg` is in degrees"))
            }
            (Some(value), None) => Ok(Some((value, 1.0))),
            (None, Some(value)) => Ok(Some((value, 1_f64.to_radians()))),
            (None, None) => Ok(None),
        }
    }

    /// An angle [rad] from `key` or `key_deg`.
    pub fn angle(&self, key: &str) -> Result<Option<f64>, TomlError> {
        self.either_unit(key)?.map(|(value, unit)| value.number().map(|number| number * unit)).transpose()
    }

    /// The pose of a frame: the vector under `at` (`position` for bodies) and `rotation`; both are optional.
    pub fn pose(&self, at: &str) -> Result<Pose, TomlError> {
        let rotation = self.get("rotation").map_or(Ok(Mat3::identity()), |value| value.rotation())?;
        Ok(Pose { rotation, translation: self.vector_or_zero(at)? })
    }

    /// The tables of `[[key]]`; a single one may also be written `[key]`.
    pub fn tables(&self, key: &str) -> Result<Vec<Table<'t>>, TomlError> {
        let Some(value) = self.get(key) else { return Ok(Vec::new()) };
        let expected = format!("tables, each under the header [[{}]]", self.header(key));
        if value.is_table() {
            return Ok(vec![value.table(&expected)?]);
        }
        value.list(&expected)?.iter().map(|entry| entry.table(&expected)).collect()
    }

    /// `body.shape` for the `shape` of `body[3]`.
    fn header(&self, key: &str) -> String {
        let parts = self.path.split('.').filter(|part| !part.is_empty());
        let names = parts.map(|part| part.split('[').next().unwrap_or(part));
        names.chain([key]).collect::<Vec<_>>().join(".")
    }

    /// The tables of `[key.NAME]`, with their names, in the order of the file.
    pub fn named_tables(&self, key: &str) -> Result<Vec<(String, Table<'t>)>, TomlError> {
        let Some(value) = self.get(key) else { return Ok(Vec::new()) };
        let expected = format!("tables, each under a header [{key}.NAME]");
        let outer = value.table(&expected)?;
        let mut names: Vec<_> = outer.raw.keys().collect();
        names.sort_by_key(|name| name.span().start);
        let named = |name: &Spanned<_>| {
            let name: &std::borrow::Cow<'_, str> = name.get_ref();
            Ok((name.to_string(), outer.need(name, &expected)?.table(&expected)?))
        };
        names.into_iter().map(named).collect()
    }
}
