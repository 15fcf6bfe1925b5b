//! Closed loops: ladders whose rungs are all closed, and one ladder with a growing number of closed rungs.

use super::run::{Run, run};
use super::scaling::slope;
use super::{NamedSolver, worlds};
use ambulo::simulation::StepSettings;

/// Loops of each ladder.
const SIZES: [usize; 3] = [10, 100, 1000];
/// The size of the ladder with a growing number of closed rungs, and these numbers.
pub(super) const RUNGS: usize = 1000;
const CLOSED: [usize; 5] = [0, 1, 10, 100, 1000];

/// Ladders stepped with one method.
pub(super) struct OfMethod {
    pub(super) name: &'static str,
    /// Closed loops, as many as rungs.
    pub(super) whole: Vec<(usize, Run)>,
    /// Closed loops among 1,000 rungs.
    pub(super) closing: Vec<(usize, Run)>,
}

/// One entry a method; the first is the default.
pub(super) type Ladders = Vec<OfMethod>;

impl OfMethod {
    pub(super) fn run(&self, loops: usize) -> Option<&Run> {
        self.whole.iter().find(|(l, _)| *l == loops).map(|(_, run)| run)
    }

    /// Slope of the logarithms of time over loops.
    pub(super) fn slope(&self) -> f64 {
        slope(&self.whole.iter().map(|(loops, run)| (*loops as f64, run.step_us.median)).collect::<Vec<_>>())
    }

    /// How much longer a step takes with all loops closed than with one tenth of them.
    pub(super) fn last_tenfold(&self) -> Option<f64> {
        let [.., (_, tenth), (_, all)] = self.closing.as_slice() else { return None };
        Some(all.step_us.median / tenth.step_us.median)
    }
}

/// All ladders with all methods.
pub(super) fn measure(methods: &[NamedSolver]) -> Result<Ladders, String> {
    let of_method = |method: &NamedSolver| {
        let settings = StepSettings { solver: method.solver, ..StepSettings::default() };
        let sized = |rungs: usize, loops: usize| Ok((loops, run(&worlds::ladder(rungs, loops), settings)?));
        Ok(OfMethod {
            name: method.name,
            whole: SIZES.into_iter().map(|loops| sized(loops, loops)).collect::<Result<_, String>>()?,
            closing: CLOSED.into_iter().map(|loops| sized(RUNGS, loops)).collect::<Result<_, String>>()?,
        })
    };
    methods.iter().map(of_method).collect()
}
