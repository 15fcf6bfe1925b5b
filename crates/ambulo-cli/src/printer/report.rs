//! Prints the path of a page.

use super::print_line;
use crate::args::PrintArgs;
use anyhow::Result;
use serde_json::json;
use std::path::Path;

/// The outcome of `report`.
pub(crate) fn report(page: &Path, print: PrintArgs) -> Result<()> {
    match print {
        PrintArgs { quiet: true, .. } => Ok(()),
        PrintArgs { json: true, .. } => print_line(&json!({ "page": page }).to_string()),
        _ => print_line(&format!("  written   {}", page.display())),
    }
}

/// The outcome of `view`.
pub(crate) fn view(page: &Path, opened: bool, print: PrintArgs) -> Result<()> {
    match print {
        PrintArgs { quiet: true, .. } => Ok(()),
        PrintArgs { json: true, .. } => print_line(&json!({ "page": page, "opened": opened }).to_string()),
        _ if opened => print_line(&format!("  opened    {}", page.display())),
        _ => print_line(&format!("  no browser was found; open this file in one: {}", page.display())),
    }
}
