//! Marked cells of the tables of a page.

use ambulo_report::internals::number;

#[test]
fn displayed_digits_decide_whether_a_number_is_marked() {
    let outside = |x: f64| number(Some(x), 4, Some([0.0052, 0.0064])).outside;
    assert!(!outside(0.005_16) && !outside(0.006_44), "shown as 0.0052 and 0.0064");
    assert!(outside(0.005_14) && outside(0.006_46));
    let at_most = |x: f64| number(Some(x), 1, Some([f64::NEG_INFINITY, 40.0])).outside;
    assert!(!at_most(40.04) && at_most(40.06) && !at_most(-1e6));
}
