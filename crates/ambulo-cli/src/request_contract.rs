//! The JSON schema of requests.

use crate::request::Verb;
use serde_json::Value;

/// JSON schema of a request: every field with its type and meaning.
#[must_use]
pub fn request_schema() -> Value {
    let generator = schemars::generate::SchemaSettings::default().for_deserialize().into_generator();
    let mut schema = generator.into_root_schema_for::<Verb>();
    schema.insert("title".to_owned(), "A request of `ambulo run`".into());
    schema.to_value()
}
