//! Where a page is.

use super::say;
use crate::args::Voice;
use anyhow::Result;
use serde_json::json;
use std::path::Path;

/// The outcome of `report`.
pub(crate) fn report(page: &Path, voice: Voice) -> Result<()> {
    match voice {
        Voice { quiet: true, .. } => Ok(()),
        Voice { json: true, .. } => say(&json!({ "page": page }).to_string()),
        _ => say(&format!("  written   {}", page.display())),
    }
}

/// The outcome of `view`.
pub(crate) fn view(page: &Path, opened: bool, voice: Voice) -> Result<()> {
    match voice {
        Voice { quiet: true, .. } => Ok(()),
        Voice { json: true, .. } => say(&json!({ "page": page, "opened": opened }).to_string()),
        _ if opened => say(&format!("  opened    {}", page.display())),
        _ => say(&format!("  no browser was found; open this file in one: {}", page.display())),
    }
}
