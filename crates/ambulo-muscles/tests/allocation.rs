//! Nothing is allocated per frame after the first frames: counted by an allocator of this process.
#![allow(clippy::disallowed_methods, reason = "expected values of tests may have the bits of the platform")]
#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a test fails by panicking, in its helpers too, and says why it skips"
)]
#![allow(dead_code, reason = "a part of the helpers is used")]
#![expect(unsafe_code, reason = "an allocator is unsafe by its trait; this one counts and forwards")]

mod muscle_models;
mod shared_data;
mod walks;

use ambulo_muscles::path::PathWorkspace;
use ambulo_muscles::settings::MuscleSettings;
use ambulo_muscles::solver::MuscleSolver;
use ambulo_muscles::wrap::WrapRule;
use muscle_models::{MODELS, MuscleModel, State, load, postures};
use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use std::hint::black_box;
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

/// Allocations of this thread while `work` runs.
fn allocations(work: impl FnOnce()) -> usize {
    let before = ALLOCATIONS.get();
    work();
    ALLOCATIONS.get() - before
}

#[test]
fn paths_allocate_nothing_per_frame() {
    for (name, _) in MODELS {
        for (_, rule) in WrapRule::ALL {
            let Some(MuscleModel { model, set, .. }) = load(name) else { return };
            let states = postures(name, &model).unwrap();
            let mut paths = PathWorkspace::new(&model, &set, rule);
            let tensions = vec![1.0; set.muscles.len()];
            let mut loads = Vec::new();
            let mut run = || {
                for (_, state) in &states {
                    paths.update(state.posture());
                    paths.loads(&tensions, &mut loads);
                    black_box(paths.lengths());
                }
            };
            assert!(allocations(&mut run) > 0, "the first frames make room");
            assert_eq!(allocations(&mut run), 0, "{name} {rule:?}");
        }
    }
}

#[test]
fn muscle_forces_allocate_nothing_per_frame() {
    for (name, _) in MODELS {
        for (_, wraps) in WrapRule::ALL {
            let Some(walk) = Walk::load(name) else { return };
            let settings = MuscleSettings { wraps, ..MuscleSettings::default() };
            let mut solver = MuscleSolver::new(&walk.muscles.model, &walk.muscles.set, &settings).unwrap();
            let mut frames = Vec::new();
            walk.trajectory.for_each_posture(|frame, posture| {
                let forces: Vec<f64> = walk.generalized.iter().map(|column| column[frame]).collect();
                frames.push((State::new(posture.q.to_vec(), posture.qd.to_vec()), forces));
            });
            let mut run = || {
                for (state, forces) in &frames {
                    black_box(solver.frame(state.posture(), forces));
                }
            };
            assert!(allocations(&mut run) > 0, "the first frames make room");
            assert_eq!(allocations(&mut run), 0, "{name} {wraps:?}");
        }
    }
}
