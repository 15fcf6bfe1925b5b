//! Counts and angles in messages: singular and plural.

use ambulo_body::numerics::{counted, degrees};

#[test]
fn one_is_singular_and_all_other_counts_are_plural() {
    assert_eq!([0, 1, 2].map(|count| counted(count, "frame")), ["0 frames", "1 frame", "2 frames"]);
    let angles = [0.4, -0.2, 0.6, 1.4, -1.0, 20.7].map(degrees);
    assert_eq!(angles, ["0 degrees", "0 degrees", "1 degree", "1 degree", "-1 degree", "21 degrees"]);
}
