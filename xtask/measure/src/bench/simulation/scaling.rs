//! Time per step over the number of bodies.

use super::run::{Run, Simulation, run};
use super::worlds;
use ambulo::simulation::{StepSettings, World};
use std::fs;
use std::hint::black_box;

/// Bodies of each size.
const SIZES: [usize; 4] = [10, 100, 1000, 10_000];
/// The slope is fitted from this size on; below, the fixed cost of a step dominates.
const SLOPE_FROM: usize = 100;

/// A family of worlds, and how they are stepped.
pub(super) struct Family {
    pub(super) name: &'static str,
    pub(super) projection: bool,
    pub(super) sizes: Vec<(usize, Run)>,
}

/// All families.
pub(super) struct Scaling {
    pub(super) families: Vec<Family>,
    /// World, state and scratch of the largest chain [bytes a body]; only where Linux's `/proc` tells.
    pub(super) bytes_a_body: Option<f64>,
}

impl Family {
    /// Slope of the logarithms from 100 bodies on.
    pub(super) fn slope(&self) -> f64 {
        let large = self.sizes.iter().filter(|(size, _)| *size >= SLOPE_FROM);
        slope(&large.map(|(size, run)| (*size as f64, run.step_us.median)).collect::<Vec<_>>())
    }

    pub(super) fn run(&self, size: usize) -> Option<&Run> {
        self.sizes.iter().find(|(s, _)| *s == size).map(|(_, run)| run)
    }
}

impl Scaling {
    pub(super) fn family(&self, name: &str, projection: bool) -> Option<&Family> {
        self.families.iter().find(|f| f.name == name && f.projection == projection)
    }
}

/// Chains and trees, with and without projection.
pub(super) fn measure() -> Result<Scaling, String> {
    // First, before freed memory could be reused.
    let bytes_a_body = memory(&worlds::chain)?;
    let mut families = Vec::new();
    for (name, build) in [("chain", worlds::chain as fn(usize) -> World), ("random tree", worlds::random_tree)] {
        for projection in [true, false] {
            let settings = StepSettings { projection, ..StepSettings::default() };
            let sized = |size: usize| Ok((size, run(&build(size), settings)?));
            families.push(Family {
                name,
                projection,
                sizes: SIZES.into_iter().map(sized).collect::<Result<_, String>>()?,
            });
        }
    }
    Ok(Scaling { families, bytes_a_body })
}

/// Least squares through the logarithms.
pub(super) fn slope(points: &[(f64, f64)]) -> f64 {
    let logs: Vec<(f64, f64)> = points.iter().map(|(x, y)| (x.ln(), y.ln())).collect();
    let count = logs.len() as f64;
    let (x, y) = (logs.iter().map(|p| p.0).sum::<f64>() / count, logs.iter().map(|p| p.1).sum::<f64>() / count);
    let (mut above, mut below) = (0.0, 0.0);
    for (a, b) in logs {
        above += (a - x) * (b - y);
        below += (a - x) * (a - x);
    }
    above / below
}

/// Growth of resident memory [bytes a body] by the largest world, its state and one step.
fn memory(build: &dyn Fn(usize) -> World) -> Result<Option<f64>, String> {
    let size = SIZES[SIZES.len() - 1];
    let before = resident_bytes();
    let world = build(size);
    let mut simulation = Simulation::new(&world, StepSettings::default());
    simulation.step()?;
    let after = resident_bytes();
    black_box(&simulation);
    Ok(before.zip(after).map(|(before, after)| (after - before) / size as f64))
}

fn resident_bytes() -> Option<f64> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:"))?;
    let kb: f64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(kb * 1024.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_slope_of_a_power_is_its_exponent() {
        let points: Vec<(f64, f64)> = [100.0_f64, 1e3, 1e4].map(|x| (x, 0.7 * x.powf(1.5))).into();
        assert!((slope(&points) - 1.5).abs() < 1e-12);
    }
}
