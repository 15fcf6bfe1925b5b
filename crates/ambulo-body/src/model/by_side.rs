//! A pair of values, one for each side of the body.

use super::Side;
use std::ops::{Index, IndexMut};

/// One value for the right side and one for the left.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct BySide<T> {
    /// On the right.
    pub right: T,
    /// On the left.
    pub left: T,
}

impl<T> BySide<T> {
    /// Computes the value of each side, the right one first.
    pub fn from_fn(mut value: impl FnMut(Side) -> T) -> BySide<T> {
        let right = value(Side::Right);
        BySide { right, left: value(Side::Left) }
    }

    /// Applies a function to both values, the right one first.
    pub fn map<U>(self, mut f: impl FnMut(T) -> U) -> BySide<U> {
        let right = f(self.right);
        BySide { right, left: f(self.left) }
    }

    /// References to both values.
    pub fn as_ref(&self) -> BySide<&T> {
        BySide { right: &self.right, left: &self.left }
    }

    /// Both values with their sides, the right one first.
    pub fn iter(&self) -> impl DoubleEndedIterator<Item = (Side, &T)> {
        [(Side::Right, &self.right), (Side::Left, &self.left)].into_iter()
    }

    /// Both values, the right one first.
    pub fn values(&self) -> impl DoubleEndedIterator<Item = &T> {
        [&self.right, &self.left].into_iter()
    }
}

impl<T> BySide<Option<T>> {
    /// Both values, or `None` if one of them is missing.
    pub fn both(self) -> Option<BySide<T>> {
        Some(BySide { right: self.right?, left: self.left? })
    }
}

impl<T> From<[T; 2]> for BySide<T> {
    /// The right one first.
    fn from([right, left]: [T; 2]) -> BySide<T> {
        BySide { right, left }
    }
}

impl<T> Index<Side> for BySide<T> {
    type Output = T;
    fn index(&self, side: Side) -> &T {
        match side {
            Side::Right => &self.right,
            Side::Left => &self.left,
        }
    }
}

impl<T> IndexMut<Side> for BySide<T> {
    fn index_mut(&mut self, side: Side) -> &mut T {
        match side {
            Side::Right => &mut self.right,
            Side::Left => &mut self.left,
        }
    }
}
