//! Foot strikes and toe-offs, from `events.csv`.

use super::sides;
use crate::page::contract::PageEvent;
use ambulo::model::Side;
use ambulo_results::is_sound;
use ambulo_results::{Folder, ResultsError};

const FILE: &str = "events.csv";

/// All events in the file's order; none without the file.
pub(super) fn events(folder: &Folder<'_>) -> Result<Vec<PageEvent>, ResultsError> {
    let text = folder.text(FILE)?.unwrap_or_default();
    text.lines().enumerate().skip(1).map(|(i, line)| event(folder, i + 1, line)).collect()
}

fn event(folder: &Folder<'_>, number: usize, line: &str) -> Result<PageEvent, ResultsError> {
    let cells: Vec<&str> = line.split(',').collect();
    let read = || {
        let [letter, kind, time] = cells[..] else { return None };
        let side = Side::BOTH.into_iter().find(|side| side.letter() == letter)?;
        let strike = match kind {
            "strike" => true,
            "off" => false,
            _ => return None,
        };
        let time_s: f64 = time.parse().ok()?;
        is_sound(time_s).then_some(PageEvent { side: sides::page(side), strike, time_s })
    };
    let refused = || format!("line {number}: found `{line}`; expected side (r, l), event (strike, off) and time");
    read().ok_or_else(|| folder.unreadable(FILE, refused()))
}
