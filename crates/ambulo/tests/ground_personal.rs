//! Calibration of the estimate for one person by trials on force plates, for the person's other trials.

use ambulo::ground::predict::{PersonalErrors, REPEATS, StanceErrors, trusted};
use ambulo::model::{BySide, Side};

fn person() -> PersonalErrors {
    let mut errors = StanceErrors::default();
    errors.force[1].0[5] = 0.05;
    errors.center[0].0[3] = -0.004;
    errors.force[2].0[7] = 0.01;
    PersonalErrors {
        mass_kg: 70.5,
        stature_m: 1.75,
        leg_length_m: 0.91,
        stances: BySide { right: 2, left: 0 },
        errors: BySide { right: errors, left: StanceErrors::default() },
        estimator: 0x00ab_cdef_0123_4567,
        subject: Some(0x0123_4567_89ab_cdef),
        excess: 1.25,
    }
}

#[test]
fn a_file_gives_the_person_back() {
    let person = person();
    assert_eq!(PersonalErrors::from_toml(&person.to_toml()), Ok(person));
}

#[test]
fn a_damaged_file_is_refused_with_its_place() {
    let text = person().to_toml();
    for (from, to, expected) in [
        ("mass_kg = 70.5", "mass_kg = -1", "mass_kg"),
        ("stances = [2, 0]", "stances = [0, 0]", "stances"),
        ("stances = [2, 0]", "stances = [1.5, 0]", "stances"),
        ("up = [0.000000, ", "up = [", "15"),
        ("[left]", "[middle]", "middle"),
        ("outwards = ", "sideways = ", "sideways"),
        ("estimator = \"00ab", "estimator = \"none", "hexadecimal"),
    ] {
        let error = PersonalErrors::from_toml(&text.replacen(from, to, 1)).unwrap_err().to_string();
        assert!(error.contains(expected), "{expected}: {error}");
    }
}

#[test]
fn a_foot_without_stances_gets_the_mirror_image_of_the_other() {
    let person = person();
    let (right, left) = (person.force(Side::Right, 0.4), person.force(Side::Left, 0.4));
    assert!((right[2] + left[2]).abs() < 1e-15 && right[2] > 0.0);
    assert!((right[2] - trusted(2) * 0.01).abs() < 1e-12);
    assert!((person.remaining(Side::Left) - (1.0 - REPEATS * trusted(2))).abs() < 1e-12);
}
