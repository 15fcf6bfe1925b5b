//! Slip of the feet during stance.

use ambulo_walk::internals::stances;

#[test]
fn slip_adds_up_over_whole_stances_alone() {
    let swing = [(0.0, 9.0); 200];
    // One millimetre forwards, half of it back; the short unloading in the middle is not a swing.
    let stance = [vec![(700.0, 0.1); 10], vec![(5.0, 9.0); 30], vec![(700.0, -0.05); 10]].concat();
    let rows = [&stance[..], &swing, &stance, &swing, &stance].concat();
    let found = stances(rows.into_iter(), 1e-3);
    assert_eq!(found.len(), 1, "the first and the last are cut");
    assert!((found[0].excursion - 1e-3).abs() < 1e-12 && (found[0].path - 1.5e-3).abs() < 1e-12, "{found:?}");
}
