//! Facts that are not judged.

use crate::page::contract::Judged;

/// A number without a limit.
pub(in crate::page::session) fn plain(label: &str, value: String) -> Judged {
    Judged { label: label.to_owned(), value, allowed: None, good: None }
}
