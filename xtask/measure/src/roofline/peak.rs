//! What one core of this processor reaches at most, in loops that do nothing else.

use crate::bench::timing::cpu_us;
use pulp::{Arch, Simd, WithSimd};
use std::hint::black_box;

/// Independent sums, so that no addition waits for the one before it.
const SUMS: usize = 12;
/// Rounds of a measurement.
const ROUNDS: usize = 20_000;
/// Doubles that are read again and again: 16 kB, half of the first cache of small processors.
const DOUBLES: usize = 2048;

/// Times that they are read in a measurement.
const READINGS: usize = 500;

/// Largest rates of one core.
pub(super) struct Peaks {
    /// Fused additions and multiplications in the widest vectors that the engine uses here [Gflop/s].
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
        let data = vec![1.0; DOUBLES];
        let gb_s = (8 * DOUBLES * READINGS) as f64 / (1e3 * least_us(|| arch.dispatch(Reading(&data))));
        Peaks { vector_gflops, gb_s, lanes }
    }

    /// Operations on single numbers [Gflop/s]: an instruction on one takes as long as on a vector.
    fn scalar_gflops(&self) -> f64 {
        self.vector_gflops / self.lanes as f64
    }

    /// The largest rate of a mix of which a share of the operations is in vectors: the times of both parts add up.
    pub(super) fn gflops(&self, vector_share: f64) -> f64 {
        1.0 / (vector_share / self.vector_gflops + (1.0 - vector_share) / self.scalar_gflops())
    }

    pub(super) fn description(&self) -> String {
        format!(
            "One core: {:.1} Gflop/s with fused operations on vectors of {}, {:.1} with single numbers, {:.0} GB/s from the first cache.\n",
            self.vector_gflops,
            self.lanes,
            self.scalar_gflops(),
            self.gb_s
        )
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

/// Sums the numbers.
struct Reading<'a>(&'a [f64]);

impl WithSimd for Reading<'_> {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> f64 {
        let mut sums = [simd.splat_f64s(0.0); 8];
        for _ in 0..READINGS {
            let (vectors, _) = S::as_simd_f64s(black_box(self.0));
            let (eights, _) = vectors.as_chunks::<8>();
            for eight in eights {
                sums = std::array::from_fn(|k| simd.add_f64s(sums[k], eight[k]));
            }
        }
        sums.into_iter().map(|sum| simd.reduce_sum_f64s(sum)).sum()
    }
}
