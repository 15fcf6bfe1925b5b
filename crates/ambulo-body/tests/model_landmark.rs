//! Anatomical landmarks of markers.

use ambulo_body::model::marker_set::Landmark;

#[test]
fn the_table_is_in_the_order_of_the_landmarks() {
    for (i, landmark) in Landmark::all().enumerate() {
        assert_eq!(landmark as usize, i, "{}", landmark.word());
    }
}
