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
