//! Converts sides to sides of the page's contract.

use crate::page::contract::PageSide;
use ambulo::model::Side;

/// A side in the page's contract.
pub(super) fn page(side: Side) -> PageSide {
    match side {
        Side::Right => PageSide::R,
        Side::Left => PageSide::L,
    }
}
