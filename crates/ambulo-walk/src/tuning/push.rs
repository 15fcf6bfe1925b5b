//! Pushes at the trunk, drawn from a seed.

use crate::numerics::Random;
use crate::numerics::elementary::sin_cos;
use crate::spatial::Vec3;
use serde::{Deserialize, Serialize};
use std::f64::consts::{PI, TAU};

/// Body mass for which forces are given [kg]; they grow with the mass of the figure.
pub(super) const PUSHED_KG: f64 = 75.0;
/// Duration of a push [s].
pub(super) const PUSH_S: f64 = 0.2;
/// Steps of directions and of forces, as shares of their ranges, so that any number of pushes fills phases, directions
/// and forces evenly together: 1/g and 1/g² with g³ = g + 1, the plastic ratio (Roberts 2018, The unreasonable
/// effectiveness of quasirandom sequences; unverified).
const STEPS: [f64; 2] = [0.754_877_666_246_693, 0.569_840_290_998_053];
/// The smallest force of a set, as a share of the largest. With the largest alone, gains were found that lose the
/// smaller ones.
const SMALLEST: f64 = 0.4;

/// A push at the mass centre of the trunk for 0.2 s.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Push {
    /// Phase of the cycle at which it begins, 0 to 1.
    pub phase: f64,
    /// Direction about the vertical [rad]: 0 is forward, positive to the right.
    pub direction: f64,
    /// Force for a figure of 75 kg [N].
    pub force_n: f64,
}

impl Push {
    /// The force on a figure [N]; x is forward, z to the right.
    #[doc(hidden)] // for tests
    pub fn force(&self, mass: f64) -> Vec3 {
        let (sin, cos) = sin_cos(self.direction);
        Vec3::new(cos, 0.0, sin) * (self.force_n * mass / PUSHED_KG)
    }
}

/// How pushes are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct PushSettings {
    /// Equal seeds give equal pushes.
    pub seed: u64,
    /// Largest force for a figure of 75 kg [N].
    pub force_n: f64,
    /// Number of pushes of a candidate; choice and report have three times as many.
    pub count: usize,
    /// Whether directions are all around; otherwise they are forward and backward.
    pub all_around: bool,
}

/// Purpose of pushes: each has its own random numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PushUse {
    /// Compares the candidates of a generation.
    Search {
        /// The generation.
        generation: u64,
    },
    /// Chooses among the means of all generations.
    Choice,
    /// Judges what was chosen.
    Report,
}

impl PushUse {
    /// Number of the sequence of random numbers; 0 belongs to the optimiser.
    fn sequence(self) -> u64 {
        match self {
            PushUse::Choice => 1,
            PushUse::Report => 2,
            PushUse::Search { generation } => 3 + generation,
        }
    }

    /// Pushes per push of a candidate: the choice and the report use more, because they determine the result.
    #[doc(hidden)] // for tests
    pub fn times(self) -> usize {
        match self {
            PushUse::Search { .. } => 1,
            PushUse::Choice | PushUse::Report => 3,
        }
    }
}

impl PushSettings {
    /// Pushes in the order of their phases: one in each of equal parts of the cycle, at a random phase of it. Forces
    /// are from 0.4 times the largest one to it. In the plane every second push is backward; in three dimensions
    /// directions fill the circle.
    #[must_use]
    pub fn pushes(&self, of: PushUse) -> Vec<Push> {
        let mut random = Random::new(self.seed, of.sequence());
        let first = [random.share(), random.share()];
        let count = self.count * of.times();
        let push = |i: usize| {
            let [turn, strength] = [0, 1].map(|k| (first[k] + i as f64 * STEPS[k]).fract());
            let backward = (i % 2 == 1) != (first[0] < 0.5);
            let direction = if self.all_around { TAU * turn } else { f64::from(u8::from(backward)) * PI };
            let phase = (i as f64 + random.share()) / count as f64;
            Push { phase, direction, force_n: self.force_n * (SMALLEST + (1.0 - SMALLEST) * strength) }
        };
        (0..count).map(push).collect()
    }
}
