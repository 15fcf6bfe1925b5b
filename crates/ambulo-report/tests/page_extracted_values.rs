//! Values that a page reads off the curve of a cycle.

use ambulo_report::internals::Part::{EarlyStance, LateStance, MiddleOfStance, Stance, Swing};
use ambulo_report::internals::Read::{self, AtStrike, Largest, Range, Smallest};

#[test]
fn values_are_read_off_their_part_of_the_cycle() {
    let curve: Vec<f64> = (0..101).map(f64::from).collect();
    let parts =
        [Largest(Stance), Smallest(Swing), Largest(EarlyStance), Smallest(LateStance), Smallest(MiddleOfStance)];
    let read = |read: Read| read.off(&curve, Some(60.0)).unwrap();
    for (part, expected) in parts.into_iter().chain([Range, AtStrike]).zip([60.0, 60.0, 30.0, 30.0, 15.0, 100.0, 0.0]) {
        assert!((read(part) - expected).abs() < 1e-12, "{} instead of {expected}", read(part));
    }
    assert_eq!(Largest(Stance).off(&curve, None), None, "no foot off, no stance");
}
