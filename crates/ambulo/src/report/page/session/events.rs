//! Foot strikes and toe-offs, from `events.csv`.

use crate::report::page::contract::{PageEvent, PageSide};
use crate::report::page::folder::{Folder, PageError};

const FILE: &str = "events.csv";

pub(super) fn events(folder: &Folder<'_>) -> Result<Vec<PageEvent>, PageError> {
    let text = folder.text(FILE)?.unwrap_or_default();
    text.lines().enumerate().skip(1).map(|(i, line)| event(folder, i + 1, line)).collect()
}

fn event(folder: &Folder<'_>, number: usize, line: &str) -> Result<PageEvent, PageError> {
    let cells: Vec<&str> = line.split(',').collect();
    let read = || {
        let [side, kind, time] = cells[..] else { return None };
        let side = match side {
            "r" => PageSide::R,
            "l" => PageSide::L,
            _ => return None,
        };
        Some(PageEvent { side, strike: kind == "strike", time_s: time.parse().ok()? })
    };
    let refused = || format!("line {number}: found `{line}`; expected side (r, l), event and time");
    read().ok_or_else(|| folder.unreadable(FILE, refused()))
}
