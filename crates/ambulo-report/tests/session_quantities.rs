//! The quantities of a session.

use ambulo::study::session::PROFILE;
use ambulo_report::internals::{SESSION_ANGLES, session_quantities};

#[test]
fn every_quantity_has_its_words_and_the_profile_comes_first() {
    for quantity in session_quantities() {
        assert!(!quantity.label().is_empty(), "{}", quantity.id);
        assert!(quantity.scale[0] < quantity.scale[1], "{}", quantity.id);
    }
    let first: Vec<&str> = SESSION_ANGLES[..PROFILE.len()].iter().map(|quantity| quantity.id).collect();
    assert_eq!(first, PROFILE);
}
