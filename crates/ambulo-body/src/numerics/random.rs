//! Random numbers that are the same for the same seed.

use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

use crate::numerics::elementary::{cos, ln};

/// Splitmix64 (Steele, Lea, Flood 2014; unverified). Its state is one number, so that a computation can be stopped and
/// resumed.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Random(u64);

impl Random {
    /// The sequence of a seed.
    #[must_use]
    pub fn seeded(seed: u64) -> Random {
        Random(seed)
    }

    /// One of many sequences of a seed.
    #[must_use]
    pub fn new(seed: u64, number: u64) -> Random {
        Random::seeded(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ number.wrapping_mul(0xd1b5_4a32_d192_ed03))
    }

    /// A number from 0 to below 1.
    #[inline]
    pub fn share(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// A whole number from 0 to below `count`.
    pub fn below(&mut self, count: usize) -> usize {
        ((self.share() * count as f64) as usize).min(count.saturating_sub(1))
    }

    /// Normally distributed, with mean 0 and standard deviation 1 (Box and Muller 1958; unverified).
    #[inline]
    pub fn normal(&mut self) -> f64 {
        let radius = (-2.0 * ln(1.0 - self.share())).sqrt();
        radius * cos(TAU * self.share())
    }
}
