//! Facts that are numbers alone, and counts that should be zero.

use crate::page::contract::Judged;

/// A number without a limit.
pub(in crate::page::session) fn plain(label: &str, value: String) -> Judged {
    Judged { label: label.to_owned(), value, allowed: None, good: None }
}

/// A count that must be zero.
pub(in crate::page::session) fn none_allowed(label: &str, count: usize) -> Judged {
    Judged { allowed: Some("none".to_owned()), good: Some(count == 0), ..plain(label, count.to_string()) }
}
