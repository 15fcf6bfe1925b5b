//! Names of quantities as a page shows them.

use ambulo_report::internals::{ClinicalNames, clinical_quantities, in_words};

#[test]
fn names_of_files_become_words() {
    let quantities = clinical_quantities(&ClinicalNames::usual(), |_| true);
    for (name, words) in [
        ("knee_angle_l_moment", "left knee flexion moment"),
        ("hip_flexion_r", "right hip flexion"),
        ("ankle_angle_r_power", "right ankle power"),
        ("center_of_pressure_l", "left center of pressure"),
        ("support", "support"),
        ("lumbar_bending_moment", "lumbar bending moment"),
    ] {
        assert_eq!(in_words(name, &quantities), words);
    }
}
