//! Shares of a recording that were not judged, in words.

use ambulo_report::internals::percent;

#[test]
fn less_than_all_is_never_rounded_to_it() {
    assert_eq!([0.001, 0.444, 0.999, 1.0].map(percent), ["1 %", "44 %", "99 %", "100 %"]);
}
