//! Synthetic walks that several tests need, each made once in a process.

use crate::memo::Memo;
use ambulo::findings::Findings;
use ambulo::gait::Gait;
use ambulo::model::anthropometry::{Build, SegmentTable};
use ambulo::simulation::synthetic::{SyntheticMode, SyntheticWalk, SyntheticWalkSettings, synthesise};

/// A man with toe joints.
pub(crate) const MAN: Build = Build { table: SegmentTable::DeLevaMale, mass: 75.0, height: 1.75, toe_joint: true };
/// The same with feet of one part.
pub(crate) const WITHOUT_TOES: Build = Build { toe_joint: false, ..MAN };

/// A walk and what was found while it was made.
pub(crate) type Made = (SyntheticWalk, Findings);

/// A walk in a built-in gait at 100 Hz.
pub(crate) fn made(gait: &str, build: Build, mode: SyntheticMode, cycles: usize) -> &'static Made {
    static ALL: Memo<Made> = Memo::new();
    ALL.get(format!("{gait} {build:?} {mode:?} {cycles}"), || {
        let (gait, mut findings) = (Gait::named(gait).unwrap(), Findings::default());
        let settings = SyntheticWalkSettings { gait: &gait, build, mode, cycles, rate_hz: 100.0 };
        (synthesise(&settings, &mut findings).unwrap(), findings)
    })
}

/// Free walking, corrected.
pub(crate) fn corrected(build: Build, cycles: usize) -> &'static SyntheticWalk {
    &made("free", build, SyntheticMode::Corrected, cycles).0
}

/// Free walking, optimal.
pub(crate) fn optimal(build: Build, cycles: usize) -> &'static SyntheticWalk {
    &made("free", build, SyntheticMode::Optimal, cycles).0
}
