//! Traits of a stance on which the mean errors of predictions depend.

use ambulo::internals::traits;

#[test]
fn traits_are_zero_in_a_usual_stance_of_an_adult_and_stay_within_what_was_measured() {
    let near = |found: [f64; 3], expected: [f64; 3]| found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-9);
    assert!(near(traits(0.0, 0.4, 0.85), [0.0; 3]), "{:?}", traits(0.0, 0.4, 0.85));
    assert!(near(traits(0.3, 0.55, 0.75), [0.3, 1.0, -1.0]), "{:?}", traits(0.3, 0.55, 0.75));
    assert!(near(traits(-0.1, 1.2, 0.2), [-0.1, 2.0, -2.5]), "{:?}", traits(-0.1, 1.2, 0.2));
}
