//! Right and left, as the page has them.

use crate::page::contract::PageSide;
use ambulo::model::Side;

/// The page's word for a side.
pub(super) fn page(side: Side) -> PageSide {
    match side {
        Side::Right => PageSide::R,
        Side::Left => PageSide::L,
    }
}

/// The side that a file names by its letter.
pub(super) fn of_letter(letter: Option<&str>) -> Option<PageSide> {
    let letter = letter?;
    Side::BOTH.into_iter().find(|side| side.letter() == letter).map(page)
}
