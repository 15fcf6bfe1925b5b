//! Claims about other bodies and figures.

use ambulo_paper::Numbers;
use ambulo_paper::internals::{GRASP_CLAIM, HAND_IN_HAND, LOOPS, OBSTACLE, Statement};

#[test]
fn each_criterion_can_fail() {
    let holds = |statement: &Statement, list: &[(&str, f64)]| {
        let numbers: Numbers = list.iter().map(|(name, value)| ((*name).to_owned(), *value)).collect();
        (statement.judge)(&numbers, None).0
    };
    let loops = |none, all| holds(&LOOPS, &[("exponent_without_loops", none), ("exponent_with_all_loops", all)]);
    assert!(loops(1.0, 1.6) && !loops(1.0, 2.1) && !loops(1.2, 1.6) && !loops(f64::NAN, 1.0));
    let swept = |path, deep| holds(&OBSTACLE, &[("swept_m", path), ("largest_overlap_m", deep)]);
    assert!(swept(0.2, 0.0) && !swept(0.05, 0.0) && !swept(0.2, 0.01) && !holds(&OBSTACLE, &[]));
    let grasped = |lift, slip| holds(&GRASP_CLAIM, &[("lifted_m", lift), ("slip_m", slip)]);
    assert!(grasped(0.3, 0.0) && !grasped(0.1, 0.0) && !grasped(0.3, 0.01) && !holds(&GRASP_CLAIM, &[]));
    let hands = |gap, apart| holds(&HAND_IN_HAND, &[("largest_gap_m", gap), ("apart_m", apart)]);
    assert!(hands(0.0, 0.1) && !hands(0.01, 0.1) && !hands(0.0, 0.5) && !holds(&HAND_IN_HAND, &[]));
}
