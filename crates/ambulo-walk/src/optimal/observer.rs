//! How a caller follows a solver and stops it.

use std::fmt;
use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

type Told = dyn Fn(usize) -> ControlFlow<()> + Send + Sync;

/// Follows the steps of all solvers that share it, and stops them. The default follows nothing. Results do not depend
/// on it.
#[derive(Clone, Default)]
pub struct Observer(Option<Arc<(AtomicUsize, Box<Told>)>>);

impl Observer {
    /// Calls `told` before each step with the number of steps so far; [`ControlFlow::Break`] stops the solver there.
    pub fn new(told: impl Fn(usize) -> ControlFlow<()> + Send + Sync + 'static) -> Observer {
        Observer(Some(Arc::new((AtomicUsize::new(0), Box::new(told)))))
    }

    /// Reports that a step begins; the error is the number of steps before a stop.
    pub(super) fn step(&self) -> Result<(), usize> {
        let Some((count, told)) = self.0.as_deref() else { return Ok(()) };
        let steps = count.fetch_add(1, Ordering::Relaxed);
        match told(steps) {
            ControlFlow::Continue(()) => Ok(()),
            ControlFlow::Break(()) => Err(steps),
        }
    }
}

impl fmt::Debug for Observer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(if self.0.is_some() { "Observer" } else { "no observer" })
    }
}
