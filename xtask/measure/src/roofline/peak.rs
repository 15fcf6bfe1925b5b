//! What one core of this processor reaches at most, in loops that do nothing else.

use crate::bench::timing::cpu_us;
use pulp::{Arch, Simd, WithSimd};
use std::fmt::Write as _;
use std::hint::black_box;

/// Independent sums, so that no addition waits for the one before it.
const SUMS: usize = 12;
/// Rounds of a measurement.
const ROUNDS: usize = 20_000;
/// Doubles that are read again and again: 16 kB, half of the first cache of small processors.
const DOUBLES: usize = 2048;

/// Largest rates of one core.
pub(super) struct Peaks {
    /// Additions and multiplications of single numbers [Gflop/s]. Without fused instructions, which not every x86-64 processor has.
    scalar_gflops: f64,
    /// The same in the widest vectors that the engine uses here, fused.
    vector_gflops: f64,
    /// From the first cache [GB/s].
    pub(super) gb_s: f64,
    lanes: usize,
}

impl Peaks {
    pub(super) fn measure() -> Peaks {
        let arch = Arch::new();
        let lanes = arch.dispatch(Lanes);
        // Fused multiplication and addition of each lane.
        let flops = (2 * SUMS * lanes * ROUNDS) as f64;
        let vector_gflops = flops / (1e3 * least_us(|| arch.dispatch(Fused)));
        let scalar_gflops = (2 * SUMS * ROUNDS) as f64 / (1e3 * least_us(scalar));
        let data = vec![1.0; DOUBLES];
        let gb_s = (8 * DOUBLES) as f64 / (1e3 * least_us(|| arch.dispatch(Reading(&data))));
        Peaks { scalar_gflops, vector_gflops, gb_s, lanes }
    }

    /// The largest rate of a mix of which a share of the operations is in vectors: the times of both parts add up.
    pub(super) fn gflops(&self, vector_share: f64) -> f64 {
        1.0 / (vector_share / self.vector_gflops + (1.0 - vector_share) / self.scalar_gflops)
    }

    pub(super) fn description(&self) -> String {
        let mut text = String::new();
        let _ = writeln!(
            text,
            "One core: {:.1} Gflop/s with single numbers, {:.1} with fused operations on vectors of {}, {:.0} GB/s from the first cache.",
            self.scalar_gflops, self.vector_gflops, self.lanes, self.gb_s
        );
        text
    }
}

fn least_us(mut work: impl FnMut() -> f64) -> f64 {
    cpu_us(1, || {
        black_box(work());
    })
    .fastest()
}

struct Lanes;

impl WithSimd for Lanes {
    type Output = usize;

    fn with_simd<S: Simd>(self, _: S) -> usize {
        S::F64_LANES
    }
}

struct Fused;

impl WithSimd for Fused {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> f64 {
        let (factor, term) = (simd.splat_f64s(black_box(0.5)), simd.splat_f64s(black_box(1.0)));
        let mut sums = [simd.splat_f64s(0.0); SUMS];
        for _ in 0..ROUNDS {
            for sum in &mut sums {
                *sum = simd.mul_add_f64s(*sum, factor, term);
            }
        }
        sums.into_iter().map(|sum| simd.reduce_sum_f64s(sum)).sum()
    }
}

fn scalar() -> f64 {
    let (factor, term) = (black_box(0.5), black_box(1.0));
    let mut sums = [0.0; SUMS];
    for _ in 0..ROUNDS {
        for sum in &mut sums {
            // Not a vector: the compiler must not join two sums.
            *sum = black_box(*sum) * factor + term;
        }
    }
    sums.iter().sum()
}

/// Sums the numbers.
struct Reading<'a>(&'a [f64]);

impl WithSimd for Reading<'_> {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> f64 {
        let (vectors, _) = S::as_simd_f64s(black_box(self.0));
        let mut sums = [simd.splat_f64s(0.0); 8];
        for eight in vectors.chunks_exact(8) {
            for (sum, value) in sums.iter_mut().zip(eight) {
                *sum = simd.add_f64s(*sum, *value);
            }
        }
        sums.into_iter().map(|sum| simd.reduce_sum_f64s(sum)).sum()
    }
}
