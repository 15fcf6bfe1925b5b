//! Reads and writes `summary.json` of any run with the same types.

use crate::json_place::json_place;
use crate::scene_summary::SceneSummary;
use crate::sound::{EXPECTED, unsound};
use crate::summary::Summary;
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

const AGAIN: &str = "hint: run the command that wrote this folder again, with this version of Ambulo";

/// The summary of a run.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(untagged)]
pub enum RunSummary {
    /// Summary of a simulated scene.
    Scene(Box<SceneSummary>),
    /// Summary of a recording or a synthetic walk.
    Motion(Box<Summary>),
}

impl RunSummary {
    /// Reads `summary.json`.
    ///
    /// # Errors
    /// A message with what was found, what was expected and what to do, for text that is not JSON, keys that are
    /// missing or of the wrong type, and numbers that are not valid results.
    pub fn from_json(text: &str) -> Result<RunSummary, String> {
        let value: Value = serde_json::from_str(text).map_err(|error| {
            format!("{error}. hint: the file is truncated or not JSON; run the command that wrote it again")
        })?;
        if !value.is_object() {
            return Err(format!("found {value}; expected an object with the keys of docs/OUTPUTS.md. {AGAIN}"));
        }
        if let Some((path, number)) = unsound(&value, "") {
            return Err(format!("`{path}` is {number:?}; expected {EXPECTED}"));
        }
        match value.get("world") {
            Some(Value::Object(_)) => Ok(RunSummary::Scene(Box::new(read(text)?))),
            _ => Ok(RunSummary::Motion(Box::new(read(text)?))),
        }
    }

    /// Stature [m], if it was given.
    #[must_use]
    pub fn height_m(&self) -> Option<f64> {
        match self {
            RunSummary::Scene(_) => None,
            RunSummary::Motion(summary) => summary.height_m,
        }
    }
}

fn read<T: DeserializeOwned>(text: &str) -> Result<T, String> {
    // Requests are bytes, and one reader for both takes less time to compile than two.
    let read = |text: &[u8]| serde_json::from_slice::<T>(text);
    read(text.as_bytes()).map_err(|error| {
        let place = json_place(text.as_bytes(), &|text| read(text).err());
        format!("{place}{error}; see docs/OUTPUTS.md. {AGAIN}")
    })
}

/// JSON schema of `summary.json`: every key with its meaning and unit.
///
/// # Errors
/// None for the types of this crate.
#[cfg(feature = "schema")]
pub fn summary_schema() -> Result<Vec<u8>, serde_json::Error> {
    let settings = schemars::generate::SchemaSettings::default().for_serialize();
    summary_json(&settings.into_generator().into_root_schema_for::<RunSummary>())
}

/// A summary as the content of `summary.json`.
///
/// # Errors
/// None for summaries of this crate, because JSON can store all their values.
pub fn summary_json(summary: &impl Serialize) -> Result<Vec<u8>, serde_json::Error> {
    let mut json = serde_json::to_vec_pretty(summary)?;
    json.push(b'\n');
    Ok(json)
}
