//! Muscle forces allocate nothing per frame after the first frames: counted by an allocator of this process.
#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a test fails by panicking, in its helpers too, and says why it skips"
)]
#![allow(clippy::disallowed_methods, reason = "expected values of tests may have the bits of the platform")]
#![allow(dead_code, reason = "this program uses a part of the helpers")]
#![expect(unsafe_code, reason = "an allocator is unsafe by its trait; this one counts and forwards")]

mod muscle_models;
mod shared_data;
mod walks;

use ambulo_muscles::settings::MuscleSettings;
use ambulo_muscles::solver::MuscleSolver;
use ambulo_muscles::wrap::WrapRule;
use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use walks::Walk;

struct Counting;

thread_local! {
    /// Per thread, so that the test harness on its own threads does not disturb the count.
    static ALLOCATIONS: Cell<usize> = const { Cell::new(0) };
}

// SAFETY: every call is forwarded unchanged to the system's allocator; the counter is a constant-initialised cell
// without a destructor, so counting allocates nothing.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ALLOCATIONS.set(ALLOCATIONS.get() + 1);
        // SAFETY: the caller's promise about `layout` is passed on.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        // SAFETY: `pointer` came from `System` with this layout.
        unsafe { System.dealloc(pointer, layout) }
    }

    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        ALLOCATIONS.set(ALLOCATIONS.get() + 1);
        // SAFETY: `pointer` came from `System` with this layout.
        unsafe { System.realloc(pointer, layout, size) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

#[test]
fn a_second_pass_over_a_walk_allocates_nothing() {
    for (name, wraps) in
        [("gait2392", WrapRule::Exact), ("rajagopal", WrapRule::Exact), ("rajagopal", WrapRule::OpenSim)]
    {
        let Some(walk) = Walk::load(name) else { return };
        let settings = MuscleSettings { wraps, ..MuscleSettings::default() };
        let mut solver = MuscleSolver::new(&walk.muscles.model, &walk.muscles.set, &settings).unwrap();
        let mut generalized = vec![0.0; walk.generalized.len()];
        let mut pass = || {
            let mut count = 0;
            walk.trajectory.for_each_posture(|frame, posture| {
                for (own, column) in generalized.iter_mut().zip(&walk.generalized) {
                    *own = column[frame];
                }
                let before = ALLOCATIONS.get();
                solver.frame(posture, &generalized);
                count += ALLOCATIONS.get() - before;
            });
            count
        };
        let first = pass();
        let second = pass();
        println!("{name} {wraps:?}: {first} allocations in the first pass, {second} in the second");
        assert!(first > 0, "{name}: the counter does not count");
        assert_eq!(second, 0, "{name} {wraps:?}");
    }
}
