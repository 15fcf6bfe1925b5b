//! Predicted walks.

use ambulo_walk::internals::flatter_slopes;

#[test]
fn steep_slopes_are_reached_in_equal_steps() {
    let slopes = |slope| flatter_slopes(slope).collect::<Vec<_>>();
    assert!(slopes(0.0).is_empty());
    assert!(slopes(0.08).is_empty());
    assert!(slopes(-0.15).iter().all(|slope| (slope + 0.075).abs() < 1e-12) && slopes(-0.15).len() == 1);
    let up = slopes(0.2);
    assert!(up.len() == 2 && (up[0] - 0.2 / 3.0).abs() < 1e-12 && (up[1] - 0.4 / 3.0).abs() < 1e-12, "{up:?}");
}
